//! The results of a sweep, a file for each chunk, each with its checksum beside it: what was worked out is
//! told from what was not, and from what is damaged or belongs to something else.

use std::fs::{File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use super::folder::lockable;
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

/// How a process works on the chunks of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sharing {
    /// Beside others that do the same, as the tasks of an engine.
    WithOthers,
    /// While nobody else does.
    Alone,
}

/// Leave to work on the chunks of a sweep, until this value is gone, with its process at the latest.
#[derive(Debug)]
pub struct Turn {
    sharing: Sharing,
    _lock: Option<File>,
}

/// What is there of a chunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Found {
    /// Nothing, or what a process that was stopped has not sealed.
    Nothing,
    /// Its results, undamaged.
    Whole,
    /// What does not fit its seal: damaged, or of another sweep.
    Unfit,
}

impl Shards {
    /// Waits until this process may work on the chunks; `waits` is called before, where somebody else does. Where a file
    /// system knows no locks, nobody waits.
    pub fn take_turn(&self, sharing: Sharing, waits: impl FnOnce(&Path)) -> Turn {
        let file = lockable(&self.folder);
        let at_once = |file: &File| match sharing {
            Sharing::WithOthers => file.try_lock_shared(),
            Sharing::Alone => file.try_lock(),
        };
        let in_time = |file: &File| match sharing {
            Sharing::WithOthers => file.lock_shared(),
            Sharing::Alone => file.lock(),
        };
        let lock = file.filter(|file| match at_once(file) {
            Ok(()) => true,
            Err(TryLockError::WouldBlock) => {
                waits(&self.folder);
                in_time(file).is_ok()
            }
            Err(TryLockError::Error(_)) => false,
        });
        Turn { sharing, _lock: lock }
    }

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
        let seal = self.seal(chunk, bytes);
        let kept = Growing::of(&self.path(chunk), bytes).and_then(Growing::finish_soon);
        let kept = kept.and_then(|()| {
            Growing::of(&self.seal_path(chunk), seal.as_bytes()).and_then(Growing::finish_soon)
        });
        match kept {
            // Where a file system knows no locks somebody else may have kept it, and tidied up.
            Err(_) if self.holds(chunk)? => Ok(()),
            kept => kept,
        }
    }

    /// Whether the results of a chunk are there, undamaged, and of this sweep.
    ///
    /// # Errors
    /// [`StoreError`] where a file is there and cannot be read.
    pub fn holds(&self, chunk: u64) -> Result<bool, StoreError> {
        Ok(self.look(chunk)? == Found::Whole)
    }

    /// What is there of a chunk.
    ///
    /// # Errors
    /// As [`Self::holds`].
    pub fn look(&self, chunk: u64) -> Result<Found, StoreError> {
        let read = |path: &Path| match reading::read(path, FileKind::Results) {
            Err(error) if error.refusal == Some(io::ErrorKind::NotFound) => Ok(None),
            read => read.map(Some),
        };
        let Some(seal) = read(&self.seal_path(chunk))? else { return Ok(Found::Nothing) };
        let fits = read(&self.path(chunk))?
            .is_some_and(|bytes| seal == self.seal(chunk, &bytes).as_bytes());
        Ok(if fits { Found::Whole } else { Found::Unfit })
    }

    /// Removes what processes that were killed have left half written; nothing but where nobody else works on the chunks, who
    /// may just be writing one.
    ///
    /// # Errors
    /// [`StoreError`] where a file cannot be removed.
    pub fn sweep_up(&self, turn: &Turn) -> Result<(), StoreError> {
        if turn.sharing != Sharing::Alone {
            return Ok(());
        }
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
