//! The table `[modes]`: modes in a file, which of them count, and what replaces its numbers.

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Value, json};

use super::StructuralMode;
use super::alike::alike;
use super::table::{self, Columns, FileMode, Modes, ModesFile};
use super::universal::{self, Direction};
use crate::case::error::CaseError;
use crate::case::reader::{Reader, Table};
use crate::system::{LARGEST_DAMPING_RATIO, MOST_MODES};

/// The modes of the structure in a file, instead of `[[mode]]`.
#[derive(Deserialize, JsonSchema)]
#[schemars(extend("additionalProperties" = false))]
pub(super) struct ModesTable {
    /// A file beside the case, or below its folder: a Universal File with data sets 55 or 2414, or columns of frequency, damping_ratio, mass,
    /// participation where the base moves, and one for each place, with units in brackets; a line for each mode.
    #[schemars(example = &"mast.csv")]
    #[expect(dead_code, reason = "read before the case is")]
    file: String,
    /// Places, each by a name: of a Universal File a node and the direction in which it moves, of a file of columns the column with the
    /// shape there, where not every further column is a place.
    #[schemars(with = "Value", extend("type" = "object", "additionalProperties" = { "type": "string" }))]
    #[schemars(example = json!({ "tip": "12 z" }))]
    #[expect(dead_code, reason = "read by its own names")]
    #[serde(default)]
    places: (),
    /// Which of the file's modes, from 1; all of them unless given.
    #[schemars(example = vec![1, 2, 3])]
    numbers: Option<Vec<u64>>,
    /// M, the modal mass of each mode instead of the file's, above 0: 1 kg where shapes are normalised to it.
    #[schemars(extend("x-measurand" = "a mass", "exclusiveMinimum" = 0), example = "1 kg")]
    mass: Option<f64>,
    /// zeta, the damping ratio of each mode instead of the file's, from 0 to 0.85.
    #[schemars(extend("x-measurand" = "a share", "minimum" = 0, "maximum" = LARGEST_DAMPING_RATIO), example = 0.005, example = "0.5 %")]
    damping_ratio: Option<f64>,
}

/// Places and modes of the file that `[modes]` names, and what was found in it.
///
/// # Errors
/// What is wrong with that file.
pub(super) fn modes_of_file(
    reader: &mut Reader,
    root: &Table,
    file: Option<&ModesFile>,
) -> Result<(Modes, String), CaseError> {
    if root.has("mode") {
        let message = "[modes] and [[mode]] both say which modes there are";
        let help = "remove [modes], or every [[mode]]";
        reader.report(root.span_of("modes"), message, "expected one of them", help);
        return Ok(Default::default());
    }
    if root.value("modes").is_some_and(|value| value.get_ref().is_array()) {
        let message = "[modes] names a file of modes, and is written as a list";
        let help = "write [[mode]] above each mode, or one table [modes] with the key `file`";
        reader.report(root.span_of("modes"), message, "expected [[mode]] or [modes]", help);
        return Ok(Default::default());
    }
    let Some((table, read)) = reader.optional::<ModesTable>(root, "modes") else {
        return Ok(Default::default());
    };
    let Some(file) = file else {
        let message = "the file of the modes was not read";
        let help = "write the modes as [[mode]] where a case is a text without a folder";
        reader.report(root.span_of("modes"), message, "expected a case in a file", help);
        return Ok(Default::default());
    };
    let before = reader.problems.len();
    let FileModes { places, modes: mut all, unit_of_mass, complex, read_as } =
        match universal::is_universal(file.text()) {
            true => universal_modes(reader, &table, file)?,
            false => columns_of(reader, &table, file)?,
        };
    if reader.problems.len() > before {
        return Ok(Default::default());
    }
    if !complex.is_empty() {
        let lines: Vec<String> = complex.iter().map(usize::to_string).collect();
        let message = match lines.as_slice() {
            [line] => format!("1 mode of the file is complex and is not read: line {line}"),
            all => format!(
                "{} modes of the file are complex and are not read: lines {}",
                all.len(),
                all.join(", ")
            ),
        };
        let (label, help) = (
            "a mode that is left out takes no part",
            "export real normal modes, or say which of the others count: numbers = [1, 2]",
        );
        if read.numbers.is_none() {
            reader.report(table.span_of("file"), message, label, help);
            return Ok(Default::default());
        }
        reader.warn(table.span_of("file"), message, label, help);
    }
    let in_file = all.len();
    if let Some(numbers) = &read.numbers {
        let span = table.span_of_value("numbers");
        let known = |number: &u64| (1..=all.len() as u64).contains(number);
        let twice = |(k, number): (usize, &u64)| numbers[..k].contains(number);
        if numbers.is_empty() || !numbers.iter().all(known) || numbers.iter().enumerate().any(twice)
        {
            let message = format!("the file has {} modes", all.len());
            let expected = format!("expected numbers from 1 to {}, each once", all.len());
            reader.report(span, message, expected, "write numbers = [1, 2, 3]");
            return Ok(Default::default());
        }
        all = numbers.iter().map(|number| all[*number as usize - 1].clone()).collect();
    }
    if all.len() > MOST_MODES {
        let message = format!("the file has {} modes", all.len());
        let expected = format!("expected 1 to {MOST_MODES}");
        let help = "choose those that matter most: numbers = [1, 2, 3]";
        reader.report(table.span_of("file"), message, expected, help);
        return Ok(Default::default());
    }
    let number = |k: usize| read.numbers.as_ref().map_or(k as u64 + 1, |numbers| numbers[k]);
    for (k, FileMode { mode, .. }) in all.iter_mut().enumerate() {
        mode.damping_ratio = read.damping_ratio.unwrap_or(mode.damping_ratio);
        mode.mass_kg = read.mass.unwrap_or(mode.mass_kg);
        let number = number(k);
        // A file of columns is judged line by line.
        if let Some((wrong, expected)) = impossible(mode) {
            let message = format!("mode {number} of the file {wrong}");
            let unit = match unit_of_mass {
                1000.0 => "1 t".to_owned(),
                kg => format!("{kg} kg"),
            };
            let help = format!(
                "choose others with `numbers`; where shapes are normalised to the file's unit of mass write mass = \"{unit}\""
            );
            reader.report(table.span_of("file"), message, expected, help);
            break;
        }
    }
    let shapes: Vec<(f64, &[f64])> =
        all.iter().map(|one| (one.mode.frequency_hz, one.whole.as_slice())).collect();
    for pair in alike(&shapes) {
        let [first, second] = [pair.first, pair.second];
        let told = [first, second].map(|k| {
            format!("mode {} of line {} at {} Hz", number(k), all[k].line, all[k].mode.frequency_hz)
        });
        let help =
            "keep one of them with `numbers`, where they are one mode that was written twice";
        let message =
            format!("{} and {} have {} frequency and one shape", told[0], told[1], pair.words());
        let (span, twice) = (table.span_of("file"), "each of them takes its part of a load");
        match pair.equal {
            true => reader.report(span, message, "expected each mode once", help),
            false => reader.warn(span, message, twice, help),
        }
    }
    let path = table.value("file").and_then(|value| value.get_ref().as_str()).unwrap_or_default();
    let some = format!("{} of {in_file} modes", all.len());
    let told = format!("{some} from {path}, {read_as}");
    Ok(((places, all.into_iter().map(|one| one.mode).collect()), told))
}

/// What a mode cannot be, and what was expected.
pub(super) fn impossible(mode: &StructuralMode) -> Option<(String, &'static str)> {
    let StructuralMode { frequency_hz, mass_kg, damping_ratio, shape, .. } = mode;
    if *frequency_hz <= 0.0 || *mass_kg <= 0.0 {
        let wrong = format!("has {frequency_hz} Hz and a modal mass of {mass_kg} kg");
        return Some((wrong, "expected both above 0"));
    }
    if !(0.0..=LARGEST_DAMPING_RATIO).contains(damping_ratio) {
        let wrong = format!("has a damping ratio of {damping_ratio}");
        return Some((wrong, "expected a damping ratio from 0 to 0.85"));
    }
    let still = shape.iter().all(|value| *value == 0.0);
    still.then(|| ("moves at none of the places".to_owned(), "expected a place at which it moves"))
}

/// What a file has, at the places that a case names.
struct FileModes {
    places: Vec<String>,
    modes: Vec<FileMode>,
    /// In kg.
    unit_of_mass: f64,
    /// Lines of modes that are not read.
    complex: Vec<usize>,
    /// What kind of file it is.
    read_as: String,
}

/// What `places` says of each place, in the order in which they are written; none where there is no such key.
fn named<T>(
    reader: &mut Reader,
    table: &Table,
    parse: impl Fn(&str) -> Option<T>,
    [is_none, expected, help]: [&str; 3],
) -> Option<Vec<(String, T)>> {
    let entries = table.value("places")?.get_ref().as_table()?;
    let mut named = Vec::new();
    for (name, value) in entries {
        match value.get_ref().as_str().and_then(&parse) {
            Some(at) => named.push((name.get_ref().to_string(), at)),
            None => {
                let message = format!("`{}` of `places` is {is_none}", name.get_ref());
                reader.report(value.span(), message, expected, help);
            }
        }
    }
    Some(named)
}

/// That of a file of columns.
fn columns_of(
    reader: &mut Reader,
    table: &Table,
    file: &ModesFile,
) -> Result<FileModes, CaseError> {
    const WORDS: [&str; 3] = [
        "no name of a column",
        "expected a text, as in \"tip\"",
        "write places = { tip = \"tip\" }: a column of the file",
    ];
    let named = named(reader, table, |column| Some(column.to_owned()), WORDS);
    let named = named.filter(|all| !all.is_empty());
    let Columns { places, modes, .. } = table::read(file, named.as_deref())?;
    let read_as = "a file of columns".to_owned();
    Ok(FileModes { places, modes, unit_of_mass: 1.0, complex: Vec::new(), read_as })
}

/// Nodes that a message names.
const NAMED: usize = 5;

/// That of a Universal File.
fn universal_modes(
    reader: &mut Reader,
    table: &Table,
    file: &ModesFile,
) -> Result<FileModes, CaseError> {
    const HELP: &str = "write places = { tip = \"12 z\" }: a node of the file and its direction";
    const WORDS: [&str; 3] =
        ["no node with a direction", "expected a number and x, y or z, as in \"12 z\"", HELP];
    let named = named(reader, table, Direction::parse, WORDS);
    let written = table.value("places").and_then(|value| value.get_ref().as_table());
    let is_none = written.is_none_or(|all| all.is_empty());
    let (places, at): (Vec<String>, Vec<Direction>) = named.into_iter().flatten().unzip();
    let found = universal::read(file, &at)?;
    let nodes: Vec<String> = found.nodes.iter().take(NAMED).map(u64::to_string).collect();
    let nodes = format!("expected nodes of the file, which begin with {}", nodes.join(", "));
    if is_none {
        let message = "a Universal File has nodes, and the case does not name its places";
        reader.report(table.span_of("places"), message, nodes.as_str(), HELP);
    }
    for (k, at) in at.iter().enumerate() {
        let lacks = |one: &FileMode| one.mode.shape[k].is_nan();
        let Some(mode) = found.modes.iter().position(lacks) else { continue };
        let message =
            format!("\"{}\" is node {}, which mode {} does not have", places[k], at.node, mode + 1);
        let help = "name a node that every mode of the file has";
        reader.report(table.span_of_value("places"), message, nodes.as_str(), help);
    }
    let read_as = format!("a Universal File of {}", found.counted());
    let universal::Universal { modes, unit_of_mass, complex, .. } = found;
    Ok(FileModes { places, modes, unit_of_mass, complex, read_as })
}
