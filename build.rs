//! Names the sources that a program is built from, so that it can tell its results from those of another
//! build: a SHA-256 over every file of the folders `src/` of the physics and the program, and the locked versions of its dependencies. Lists the templates.

#[path = "src/digest.rs"]
#[expect(dead_code, reason = "line ends are the program's own matter")]
mod digest;

use std::error::Error;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    sources()?;
    templates()
}

fn sources() -> Result<(), Box<dyn Error>> {
    let mut list = String::new();
    for file in files(&[
        "core/src",
        "core/base/src",
        "core/orbits/src",
        "core/simulation/src",
        "src",
        "Cargo.lock",
    ])? {
        let named = digest::sha256(&std::fs::read(&file)?);
        list += &format!("{named} {}\n", file.display());
    }
    println!("cargo::rustc-env=VINESINK_SOURCES={}", digest::sha256(list.as_bytes()));
    Ok(())
}

/// Pages that a browser does not make, as they are of folders, files and long work: beginnings of their names.
const NOT_IN_A_BROWSER: [&str; 31] = [
    "analyze",
    "check.github",
    "check.txt",
    "check.xml",
    "clearance",
    "diff",
    "equations",
    "evidence",
    "extremes",
    "flight",
    "index",
    "jobs",
    "live",
    "loads-analysis",
    "loads-optimum",
    "loads.md",
    "loads.txt",
    "optimize",
    "page",
    "paper",
    "proposal",
    "record",
    "release",
    "report.css",
    "report.js",
    "simulate",
    "sine-sweep",
    "sort",
    "sweep",
    "tradeoff",
    "validation",
];
/// Captions of the figures that it draws, in `templates/captions/`.
const CAPTIONS_OF_A_BROWSER: [&str; 10] = [
    "amplitude",
    "loads",
    "map",
    "map-plain",
    "motion",
    "plane",
    "ranges",
    "response",
    "return-map",
    "sim",
];

/// Writes a list of every file of `templates/`: its path there without `.tera`, and its text. Those of the crate
/// `evidence` are among them: they are filled in with the filters and components of the others.
fn templates() -> Result<(), Box<dyn Error>> {
    let browser = std::env::var("CARGO_CFG_TARGET_ARCH")? == "wasm32";
    let mut list = String::from("&[\n");
    for file in files(&["templates"])? {
        let name = file.strip_prefix("templates")?.display().to_string();
        let name = name.trim_end_matches(".tera");
        let needed = match name.strip_prefix("captions/") {
            Some(caption) => CAPTIONS_OF_A_BROWSER.contains(&caption),
            None => !NOT_IN_A_BROWSER.iter().any(|begin| name.starts_with(begin)),
        };
        if browser && !needed {
            continue;
        }
        let path = std::path::absolute(&file)?;
        list += &format!("({:?}, include_str!({path:?})),\n", name);
    }
    let folder = std::env::var("OUT_DIR")?;
    Ok(std::fs::write(Path::new(&folder).join("templates.rs"), list + "]\n")?)
}

/// All files of some places, sorted; the build follows their changes.
fn files(places: &[&str]) -> std::io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for place in places {
        println!("cargo::rerun-if-changed={place}");
        add(Path::new(place), &mut files)?;
    }
    files.sort();
    Ok(files)
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
