//! Why something could not be done with a file, a folder or a revision, and what to do about it.

use std::io::{self, ErrorKind};
use std::path::Path;

/// What could not be done with a file, a folder or a revision, why, and what to do about it.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("{message}")]
pub struct StoreError {
    pub(super) message: String,
    #[help]
    pub(super) advice: Option<&'static str>,
    /// The reason of the operating system, where it refused.
    pub(super) refusal: Option<ErrorKind>,
}

impl StoreError {
    pub(super) fn new(message: String, advice: Option<&'static str>) -> Self {
        Self { message, advice, refusal: None }
    }
}

/// A link where a folder of a result would be.
pub(super) fn linked(path: &Path) -> StoreError {
    let message = format!("{} is a link, through which nothing is written", path.display());
    StoreError::new(message, Some("remove it, or name the folder that it leads to"))
}

/// What the operating system refused, such as to "read", with advice where the disk is at fault.
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
    let message = format!("cannot {action} {}: {cause}", path.display());
    StoreError { message, advice, refusal: Some(cause.kind()) }
}
