//! A file that is written piece by piece and appears whole or not at all.

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::{StoreError, folder_of, ordinary, refused};

/// A file that is written under another name beside its own, which it gets at the end.
pub struct Growing {
    file: BufWriter<NamedTempFile>,
    path: PathBuf,
}

impl Growing {
    /// Begins a file; its folder must exist.
    ///
    /// # Errors
    /// [`StoreError`].
    pub fn begin(path: &Path) -> Result<Self, StoreError> {
        let file = ordinary(0o666).tempfile_in(folder_of(path)?);
        let file = file.map_err(|cause| refused("write", path, cause))?;
        Ok(Self { file: BufWriter::new(file), path: path.to_owned() })
    }

    /// A file with all that it is to hold.
    pub(super) fn of(path: &Path, bytes: &[u8]) -> Result<Self, StoreError> {
        let mut file = Self::begin(path)?;
        file.write_all(bytes).map_err(|cause| refused("write", path, cause))?;
        Ok(file)
    }

    /// The file under its other name.
    fn written(self) -> Result<NamedTempFile, StoreError> {
        self.file.into_inner().map_err(|error| refused("write", &self.path, error.into_error()))
    }

    /// The same once the disk has it.
    pub(super) fn on_disk(self) -> Result<NamedTempFile, StoreError> {
        let path = self.path.clone();
        let file = self.written()?;
        file.as_file().sync_all().map_err(|cause| refused("write", &path, cause))?;
        Ok(file)
    }

    /// Ends the file and puts it in the place of an earlier one.
    ///
    /// # Errors
    /// [`StoreError`]; an earlier file is then unchanged.
    pub fn finish(self) -> Result<(), StoreError> {
        let path = self.path.clone();
        put(self.on_disk()?, &path)
    }

    /// The same without waiting for the disk, for what carries a checksum: after a power cut it is found out.
    pub(super) fn finish_soon(self) -> Result<(), StoreError> {
        let path = self.path.clone();
        put(self.written()?, &path)
    }
}

fn put(file: NamedTempFile, path: &Path) -> Result<(), StoreError> {
    file.persist(path).map(drop).map_err(|error| refused("write", path, error.error))
}

impl Write for Growing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}
