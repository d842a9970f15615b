//! Why something could not be done with a file or folder, and what to do about it.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// What could not be done with a file or folder, and why.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum StoreError {
    /// The operating system refused.
    #[error("cannot {action} {}: {cause}", path.display())]
    Refused {
        /// What was tried, such as "read".
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The operating system's reason.
        cause: io::Error,
        /// What to do about it, where it is the disk's fault.
        #[help]
        advice: Option<&'static str>,
    },
    /// A file that should be new is there already.
    #[error("{} exists already and is left as it is", path.display())]
    #[diagnostic(help("choose another name, or remove the file first"))]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// A text file that is not UTF-8.
    #[error("{} is not UTF-8 text: line {line} holds the byte 0x{byte:02X} at column {column}", path.display())]
    #[diagnostic(help("save the file with the encoding UTF-8"))]
    NotUtf8 {
        /// The file.
        path: PathBuf,
        /// Line of the first byte that fits no character, from 1.
        line: usize,
        /// Its column in characters, from 1.
        column: usize,
        /// The byte.
        byte: u8,
    },
    /// A file or folder whose name is not UTF-8.
    #[error("the name of {} is not UTF-8", path.display())]
    #[diagnostic(help("rename it"))]
    Name {
        /// The file or folder.
        path: PathBuf,
    },
    /// A path that names no file, or leads out of its folder.
    #[error("{} does not name a file inside a folder", path.display())]
    Unusable {
        /// The path.
        path: PathBuf,
    },
}

/// What the operating system refused, with advice where the disk is at fault.
pub(super) fn refused(action: &'static str, path: &Path, cause: io::Error) -> StoreError {
    let advice = match cause.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => Some(
            "make room on that disk, or write to a larger one; what is there already may move along",
        ),
        ErrorKind::ReadOnlyFilesystem => Some(
            "let that disk be written to again, or write to another one; what is there already may be \
             copied along",
        ),
        _ => None,
    };
    StoreError::Refused { action, path: path.to_owned(), cause, advice }
}
