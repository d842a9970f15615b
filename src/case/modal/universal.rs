//! Modes from a Universal File: its data sets 55 and 2414, a shape each, and 164, the units. After the description of these data
//! sets by the Structural Dynamics Research Laboratory of the University of Cincinnati.

use std::collections::BTreeSet;

use super::StructuralMode;
use super::table::ModesFile;
use crate::case::error::{CaseError, Problem};
use crate::case::record::problem;

/// A line around each data set.
const DELIMITER: &str = "-1";
/// Columns of a real number in a shape, and in the units.
const WIDTH: usize = 13;
const WIDTH_OF_UNITS: usize = 25;
/// Where the numbers of a mode stand in a data set.
struct Set {
    /// The line that says what is at each node.
    kinds: usize,
    /// The line with the numbers of the mode, and where in it are frequency, modal mass, and viscous and hysteretic damping.
    numbers: usize,
    at: [usize; 4],
    /// Lines before the first node.
    head: usize,
}

/// Data at nodes.
const SET_55: Set = Set { kinds: 5, numbers: 7, at: [0, 1, 2, 3], head: 8 };
/// Analysis data, which may be at nodes.
const SET_2414: Set = Set { kinds: 8, numbers: 11, at: [1, 3, 4, 5], head: 13 };
/// The line of the latter that says where they are, and what it says of nodes.
const LOCATION: usize = 2;
const AT_NODES: &str = "1";
/// Kinds of analysis: normal modes, and complex ones of either order.
const NORMAL: i64 = 2;
const COMPLEX: [i64; 2] = [3, 7];
/// Kinds of data of a displacement: unknown, general, displacement; and translations, without or with rotations.
const DISPLACEMENT: [i64; 3] = [0, 1, 8];
const VECTOR: [i64; 2] = [2, 3];
/// Real and complex numbers, of single and double precision.
const REAL: [i64; 2] = [2, 4];
const PAIRS: [i64; 2] = [5, 6];
/// Largest imaginary part of a real mode that is written with complex numbers, over its largest real part.
const IMAGINARY: f64 = 1e-6;
/// Nodes that a message names.
const NAMED: usize = 5;

/// A node and the direction in which a place moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Direction {
    pub node: u64,
    /// 0 to 2: x, y, z.
    pub axis: usize,
    pub sign: f64,
}

impl Direction {
    /// From `12 z` or `12 -z`.
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        let end = text.find(|c: char| !c.is_ascii_digit())?;
        let (node, axis) = (text[..end].parse().ok()?, text[end..].trim());
        let (sign, axis) = match axis.strip_prefix('-') {
            Some(axis) => (-1.0, axis),
            None => (1.0, axis.strip_prefix('+').unwrap_or(axis)),
        };
        let axis = ["x", "y", "z"].iter().position(|name| axis.eq_ignore_ascii_case(name))?;
        Some(Self { node, axis, sign })
    }
}

/// What a file has.
#[derive(Debug)]
pub(super) struct Universal {
    /// Its normal modes in SI units, with their shapes in the directions asked for: not a number where a node is missing.
    pub modes: Vec<StructuralMode>,
    /// Its first nodes.
    pub nodes: BTreeSet<u64>,
    /// Its unit of mass in kg; without data set 164 it is taken to be in SI.
    pub unit_of_mass: f64,
}

/// Whether a text is a Universal File.
pub(super) fn is_universal(text: &str) -> bool {
    text.lines().map(str::trim).find(|line| !line.is_empty()) == Some(DELIMITER)
}

/// The normal modes of a file, with their shapes in some directions.
pub(super) fn read(file: &ModesFile, at: &[Direction]) -> Result<Universal, CaseError> {
    let text = file.text.as_str();
    let refused = |problem: Box<Problem>| CaseError::new(&file.name, text, vec![*problem], 0);
    let mut found = Universal { modes: Vec::new(), nodes: BTreeSet::new(), unit_of_mass: 1.0 };
    let mut complex = false;
    for DataSet { number, lines, is_closed } in data_sets(text) {
        if !is_closed {
            let message = format!("the file ends within data set {number}");
            let expected = "expected a line -1 behind it";
            let last = lines.last().copied().unwrap_or(first_line(text));
            let help = "export the file anew: it may be truncated";
            return Err(refused(problem(text, last, message, expected, help)));
        }
        match number {
            "164" => found.unit_of_mass = unit_of_mass(text, &lines).map_err(refused)?,
            "55" | "2414" => {
                let set = if number == "55" { SET_55 } else { SET_2414 };
                match shape(text, &lines, &set, at, &mut found.nodes).map_err(refused)? {
                    Shape::Mode(mode) => found.modes.push(mode),
                    Shape::Complex => complex = true,
                    Shape::Other => {}
                }
            }
            _ => {}
        }
    }
    if found.modes.is_empty() {
        let message = match complex {
            true => "the modes of the file are complex".to_owned(),
            false => "the file has no normal mode".to_owned(),
        };
        let expected = "expected data sets 55 or 2414 of normal modes, real displacements";
        let help = "export normal modes with their modal masses, or write [[mode]]";
        return Err(refused(problem(text, first_line(text), message, expected, help)));
    }
    let kg = found.unit_of_mass;
    found.modes.iter_mut().for_each(|mode| mode.mass_kg *= kg);
    Ok(found)
}

/// A data set, and whether the line that ends it is there.
struct DataSet<'t> {
    number: &'t str,
    lines: Vec<&'t str>,
    is_closed: bool,
}

fn data_sets(text: &str) -> impl Iterator<Item = DataSet<'_>> {
    let mut lines = text.lines();
    std::iter::from_fn(move || {
        lines.find(|line| line.trim() == DELIMITER)?;
        let number = lines.next()?.trim();
        let mut is_closed = false;
        let within = |line: &&str| {
            is_closed = line.trim() == DELIMITER;
            !is_closed
        };
        let lines = lines.by_ref().take_while(within).collect();
        Some(DataSet { number, lines, is_closed })
    })
}

fn first_line(text: &str) -> &str {
    text.lines().next().unwrap_or(text)
}

/// Kilograms in the file's unit of mass.
fn unit_of_mass(text: &str, lines: &[&str]) -> Result<f64, Box<Problem>> {
    let line = lines.get(1).copied().unwrap_or(first_line(text));
    match reals(line, WIDTH_OF_UNITS).as_deref() {
        // Both are how many of the file's units are one of SI.
        Some([length, force, ..]) if *length > 0.0 && *force > 0.0 => Ok(length / force),
        _ => {
            let message = "the units of data set 164 cannot be read".to_owned();
            let expected = "expected the factors of length and force";
            Err(problem(text, line, message, expected, "export the file anew"))
        }
    }
}

/// What a data set is.
enum Shape {
    Mode(StructuralMode),
    Complex,
    Other,
}

fn shape(
    text: &str,
    lines: &[&str],
    set: &Set,
    at: &[Direction],
    nodes: &mut BTreeSet<u64>,
) -> Result<Shape, Box<Problem>> {
    let wrong = |line: &str, message: &str, expected: &str| {
        problem(text, line, message.to_owned(), expected, "export the file anew")
    };
    let last = lines.last().copied().unwrap_or(first_line(text));
    if lines.len() < set.head {
        return Err(wrong(
            last,
            "the data set of a mode ends early",
            "expected its head and nodes",
        ));
    }
    if set.head == SET_2414.head && lines[LOCATION].trim() != AT_NODES {
        return Ok(Shape::Other);
    }
    let kinds = integers(lines[set.kinds]);
    let Some([_, analysis, vector, of, data, count]) = kinds.as_deref() else {
        let expected = "expected six numbers";
        return Err(wrong(lines[set.kinds], "the kind of data cannot be read", expected));
    };
    if COMPLEX.contains(analysis) {
        return Ok(Shape::Complex);
    }
    let moves = DISPLACEMENT.contains(of) && VECTOR.contains(vector);
    if *analysis != NORMAL || !moves || !(3..=6).contains(count) {
        return Ok(Shape::Other);
    }
    let (real, pairs) = (REAL.contains(data), PAIRS.contains(data));
    if !real && !pairs {
        return Ok(Shape::Other);
    }
    let numbers = reals(lines[set.numbers], WIDTH).unwrap_or_default();
    let [Some(frequency_hz), Some(mass_kg), Some(viscous), hysteretic] =
        set.at.map(|k| numbers.get(k).copied())
    else {
        let expected = "expected frequency, modal mass and damping ratio";
        return Err(wrong(lines[set.numbers], "the numbers of a mode cannot be read", expected));
    };
    // At resonance a loss factor is twice a damping ratio.
    let damping_ratio = if viscous > 0.0 { viscous } else { 0.5 * hysteretic.unwrap_or(0.0) };
    let (mut shape, mut most) = (vec![f64::NAN; at.len()], [0.0_f64; 2]);
    let each = if pairs { 2 } else { 1 };
    for record in lines[set.head..].chunks(1 + (each * *count as usize).div_ceil(6)) {
        let node = integers(record[0]).and_then(|all| u64::try_from(*all.first()?).ok());
        let values = record.get(1).and_then(|line| reals(line, WIDTH));
        let (Some(node), Some(values)) = (node, values.filter(|all| all.len() >= 3 * each)) else {
            let expected = "expected its number, and its displacements in the next line";
            return Err(wrong(record[0], "a node of a shape cannot be read", expected));
        };
        if nodes.len() < NAMED {
            nodes.insert(node);
        }
        for (k, value) in values[..3 * each].iter().enumerate() {
            most[k % each] = most[k % each].max(value.abs());
        }
        for (value, direction) in shape.iter_mut().zip(at).filter(|(_, one)| one.node == node) {
            *value = direction.sign * values[each * direction.axis];
        }
    }
    if pairs && most[1] > IMAGINARY * most[0] {
        return Ok(Shape::Complex);
    }
    let participation = f64::NAN;
    Ok(Shape::Mode(StructuralMode {
        frequency_hz,
        damping_ratio,
        mass_kg,
        shape,
        participation,
        forcing: 0.0,
    }))
}

fn integers(line: &str) -> Option<Vec<i64>> {
    line.split_whitespace().map(|word| word.parse().ok()).collect()
}

/// The numbers of a line: apart, or in columns of a width where they touch.
fn reals(line: &str, width: usize) -> Option<Vec<f64>> {
    let number = |word: &str| {
        let word = word.trim().replace(['D', 'd'], "E");
        word.parse().ok().filter(|number: &f64| number.is_finite())
    };
    let apart: Option<Vec<f64>> = line.split_whitespace().map(number).collect();
    let columns = || {
        let columns = line.as_bytes().chunks(width).map(|part| str::from_utf8(part).ok());
        columns.map(|part| number(part?)).collect()
    };
    apart.or_else(columns)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_nodes_with_directions() {
        let of = |text| Direction::parse(text).map(|one| (one.node, one.axis, one.sign));
        assert_eq!(of("12 z"), Some((12, 2, 1.0)));
        assert_eq!(of(" 7-Y "), Some((7, 1, -1.0)));
        assert_eq!(of("7 +x"), Some((7, 0, 1.0)));
        for text in ["", "12", "z", "12 w", "-3 x", "12 z z", "99999999999999999999 x", "1.5 x"] {
            assert_eq!(of(text), None, "{text}");
        }
    }

    #[test]
    fn numbers_that_touch_are_told_apart_by_columns() {
        let line = "-1.234560E-01 2.000000E+00-3.000000E-01";
        assert_eq!(reals(line, WIDTH), Some(vec![-0.123456, 2.0, -0.3]));
        assert_eq!(reals(" 1.0D+03  1.0D+00", WIDTH_OF_UNITS), Some(vec![1000.0, 1.0]));
        assert_eq!(reals("1.0 nan", WIDTH), None);
    }
}
