//! Names the sources that a program is built from, so that it can tell its results from those of another
//! build: a SHA-256 over every file of `src/` and the locked versions of its dependencies.

#[path = "src/digest.rs"]
mod digest;

use std::error::Error;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let mut files = Vec::new();
    for place in ["src", "Cargo.lock"] {
        println!("cargo::rerun-if-changed={place}");
        add(Path::new(place), &mut files)?;
    }
    files.sort();
    let mut list = String::new();
    for file in files {
        let named = digest::sha256(&std::fs::read(&file)?);
        list += &format!("{named} {}\n", file.display());
    }
    println!("cargo::rustc-env=VINESINK_SOURCES={}", digest::sha256(list.as_bytes()));
    Ok(())
}

/// Adds a file, or all that are in a folder.
fn add(place: &Path, files: &mut Vec<PathBuf>) -> std::io::Result<()> {
    if place.is_dir() {
        for entry in std::fs::read_dir(place)? {
            add(&entry?.path(), files)?;
        }
    } else if place.exists() {
        files.push(place.to_owned());
    }
    Ok(())
}
