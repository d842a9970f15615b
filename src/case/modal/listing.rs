//! What a file of modes has, without a case.

use serde::Serialize;

use super::alike::alike;
use super::table::{self, FileMode, ModesFile};
use super::universal::{self, Universal};
use crate::case::error::CaseError;

/// What a file of modes has, and what it is read as.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModesListing {
    /// What kind of file it is, and what was found in it, as the end of a sentence.
    pub read_as: String,
    /// Its modes, in the order of the file.
    pub modes: Vec<ListedMode>,
    /// At what its shapes are given: columns by their names, nodes by their numbers.
    pub places: Vec<String>,
    /// Whether those are nodes.
    pub of_nodes: bool,
    /// The table `[modes]` with which a case reads it, at the node and in the direction in which the first mode moves most.
    pub table: String,
    /// What is probably a slip, or is left out.
    pub warnings: Vec<String>,
}

/// A mode of a file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ListedMode {
    /// Its number in the file, from 1, as `numbers` of `[modes]` has it.
    pub number: usize,
    /// The line of its frequency, from 1.
    pub line: usize,
    /// Natural frequency in Hz; of a rigid motion 0.
    pub frequency_hz: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Modal mass in kg.
    pub mass_kg: f64,
    /// At how many nodes or places it has a shape.
    pub nodes: usize,
}

impl ModesListing {
    /// That of a file; `name` is what a case beside it would call it.
    ///
    /// # Errors
    /// [`CaseError`] with what is wrong with the file.
    pub fn of(file: &ModesFile, name: &str) -> Result<Self, CaseError> {
        let of_nodes = universal::is_universal(file.text());
        let (read_as, modes, places, at, complex) = if of_nodes {
            let found = universal::read(file, &[])?;
            let read_as = format!("a Universal File of {}", found.counted());
            let at = format!("places = {{ tip = \"{}\" }}", most(&found));
            let nodes = found.nodes.iter().map(u64::to_string).collect();
            (read_as, found.modes, nodes, at, found.complex)
        } else {
            let found = table::read(file, None)?;
            let read_as = format!("a file of columns: {}", found.read_as);
            let at = "# places: every column that is none of the numbers above".to_owned();
            (read_as, found.modes, found.places, at, Vec::new())
        };
        let shapes: Vec<(f64, &[f64])> =
            modes.iter().map(|one| (one.mode.frequency_hz, one.whole.as_slice())).collect();
        let mut warnings: Vec<String> = alike(&shapes)
            .into_iter()
            .map(|pair| {
                let words = pair.words();
                let [first, second] = [pair.first + 1, pair.second + 1];
                format!("modes {first} and {second} have {words} frequency and one shape")
            })
            .collect();
        if !complex.is_empty() {
            let lines: Vec<String> = complex.iter().map(usize::to_string).collect();
            warnings.push(format!("complex modes are not read: lines {}", lines.join(", ")));
        }
        let table = format!("[modes]\nfile = {name:?}\n{at}\n");
        let modes = modes.iter().enumerate().map(|(k, one)| ListedMode::of(k + 1, one)).collect();
        Ok(Self { read_as, modes, places, of_nodes, table, warnings })
    }
}

impl ListedMode {
    fn of(number: usize, of: &FileMode) -> Self {
        Self {
            number,
            line: of.line,
            frequency_hz: of.mode.frequency_hz,
            damping_ratio: of.mode.damping_ratio,
            mass_kg: of.mode.mass_kg,
            nodes: of.nodes,
        }
    }
}

/// The node and the direction in which the first elastic mode moves most.
pub(super) fn most(of: &Universal) -> String {
    let elastic = of.modes.iter().find(|one| one.mode.frequency_hz > 0.0);
    let whole = elastic.or(of.modes.first()).map_or(&[][..], |one| &one.whole);
    let largest = whole.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let at = largest.map_or(0, |(at, _)| at);
    format!("{} {}", of.nodes.get(at / 3).copied().unwrap_or(1), ["x", "y", "z"][at % 3])
}
