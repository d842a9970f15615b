//! The results of a sweep, a file for each chunk, each with its checksum beside it: what was worked out is
//! told from what was not, and from what is damaged or belongs to something else.

use std::io;
use std::path::{Path, PathBuf};

use super::reading::{self, FileKind};
use super::{Growing, StoreError, TEMPORARY, folder_below, refused};
use crate::digest::sha256;

/// The folder of a sweep's chunks.
#[derive(Debug, Clone)]
pub struct Shards {
    folder: PathBuf,
    /// Names the sweep that the chunks belong to.
    identity: String,
}

impl Shards {
    /// Those of a sweep in the folder `inside` of another one, both made where there are none.
    ///
    /// # Errors
    /// [`StoreError`] where it cannot be made.
    pub fn open(root: &Path, inside: &Path, identity: &str) -> Result<Self, StoreError> {
        Ok(Self { folder: folder_below(root, inside)?, identity: identity.to_owned() })
    }

    /// The file of a chunk.
    pub fn path(&self, chunk: u64) -> PathBuf {
        self.folder.join(format!("{chunk:09}.parquet"))
    }

    fn seal_path(&self, chunk: u64) -> PathBuf {
        self.path(chunk).with_extension("seal")
    }

    /// What the seal of a chunk must say.
    fn seal(&self, chunk: u64, bytes: &[u8]) -> String {
        format!("sweep {}\nchunk {chunk}\nsha256 {}\n", self.identity, sha256(bytes))
    }

    /// Keeps the results of a chunk: first the file, then its seal, each whole or not at all.
    ///
    /// # Errors
    /// [`StoreError`]; what was there before still is.
    pub fn keep(&self, chunk: u64, bytes: &[u8]) -> Result<(), StoreError> {
        Growing::of(&self.path(chunk), bytes)?.finish_soon()?;
        Growing::of(&self.seal_path(chunk), self.seal(chunk, bytes).as_bytes())?.finish_soon()
    }

    /// Whether the results of a chunk are there, undamaged, and of this sweep.
    ///
    /// # Errors
    /// [`StoreError`] where a file is there and cannot be read.
    pub fn holds(&self, chunk: u64) -> Result<bool, StoreError> {
        let read = |path: &Path| match reading::read(path, FileKind::Results) {
            Err(error) if error.refusal == Some(io::ErrorKind::NotFound) => Ok(None),
            read => read.map(Some),
        };
        let (Some(seal), Some(bytes)) = (read(&self.seal_path(chunk))?, read(&self.path(chunk))?)
        else {
            return Ok(false);
        };
        Ok(seal == self.seal(chunk, &bytes).as_bytes())
    }

    /// Removes what processes that were killed have left half written. Called when every chunk is there:
    /// whoever still writes one then writes it for the second time, and does not need it.
    ///
    /// # Errors
    /// [`StoreError`] where a file cannot be removed.
    pub fn sweep_up(&self) -> Result<(), StoreError> {
        // That of the merged results is beside the folder of the chunks.
        for folder in [Some(self.folder.as_path()), self.folder.parent()].into_iter().flatten() {
            let cannot = |cause| refused("tidy", folder, cause);
            for entry in std::fs::read_dir(folder).map_err(cannot)? {
                let entry = entry.map_err(cannot)?;
                if entry.file_name().to_string_lossy().starts_with(TEMPORARY) {
                    remove(&entry.path())?;
                }
            }
        }
        Ok(())
    }
}

/// Removes a file, which another process may have removed before.
fn remove(path: &Path) -> Result<(), StoreError> {
    match std::fs::remove_file(path) {
        Err(cause) if cause.kind() != io::ErrorKind::NotFound => {
            Err(refused("remove", path, cause))
        }
        _ => Ok(()),
    }
}
