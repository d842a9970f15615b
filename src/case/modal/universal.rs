//! Modes from a Universal File: its data sets 55 and 2414, a shape each, and 164, the units. After the description of these data
//! sets by the Structural Dynamics Research Laboratory of the University of Cincinnati.

use std::collections::BTreeSet;

use super::StructuralMode;
use super::table::{FileMode, ModesFile};
use crate::case::error::{CaseError, Problem};
use crate::case::record::problem;

/// A line around each data set: -1 in columns 5 and 6, and nothing else.
const DELIMITER: &str = "    -1";
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
/// A data set of a measured function in binary form.
const BINARY: &[u8] = b"58b";

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
    pub modes: Vec<FileMode>,
    /// Its nodes.
    pub nodes: Vec<u64>,
    /// Its unit of mass in kg; without data set 164 it is taken to be in SI.
    pub unit_of_mass: f64,
    /// Its data sets in their order, and what each was read as.
    pub sets: Vec<(String, ReadAs)>,
    /// Lines of modes that are complex, and are not read.
    pub complex: Vec<usize>,
}

/// What a data set is read as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ReadAs {
    Mode,
    Units,
    Nothing,
}

impl Universal {
    /// How many data sets there are, and what they were read as.
    pub fn counted(&self) -> String {
        let of = |read_as: ReadAs| {
            let of = self.sets.iter().filter(|one| one.1 == read_as).map(|one| one.0.as_str());
            let count = of.clone().count();
            let kinds = of.collect::<BTreeSet<_>>().into_iter().collect::<Vec<_>>().join(", ");
            (count, kinds)
        };
        let each = [
            ("of modes", ReadAs::Mode),
            ("of units", ReadAs::Units),
            ("not used", ReadAs::Nothing),
        ];
        let each = each.map(|(words, read_as)| (words, of(read_as)));
        let told = each.iter().filter(|(_, (count, _))| *count > 0);
        let told: Vec<String> =
            told.map(|(words, (count, kinds))| format!("{count} {words} ({kinds})")).collect();
        let all = self.sets.len();
        format!("{all} data set{}: {}", if all == 1 { "" } else { "s" }, told.join(", "))
    }
}

/// Whether a text is meant to be a Universal File.
pub(super) fn is_universal(text: &str) -> bool {
    text.lines().map(str::trim).find(|line| !line.is_empty()) == Some(DELIMITER.trim())
}

fn is_delimiter(line: &str) -> bool {
    line.trim_end() == DELIMITER
}

/// The bytes of a file without what its binary data sets hold: their length stands in the line that begins each.
pub(super) fn without_binary(bytes: &[u8]) -> Vec<u8> {
    let mut kept = Vec::with_capacity(bytes.len());
    let (mut rest, mut within, mut begins) = (bytes, false, false);
    while !rest.is_empty() {
        let end = rest.iter().position(|byte| *byte == b'\n').map_or(rest.len(), |at| at + 1);
        let (line, behind) = rest.split_at(end);
        kept.extend_from_slice(line);
        rest = behind;
        let delimits = line.trim_ascii_end() == DELIMITER.as_bytes();
        let is_binary = begins && line.trim_ascii_start().starts_with(BINARY);
        begins = delimits && !within;
        within ^= delimits;
        if !is_binary {
            continue;
        }
        // Byte order and format of numbers, lines of text, bytes behind them.
        let numbers = line.trim_ascii_start()[BINARY.len()..].split(u8::is_ascii_whitespace);
        let mut numbers = numbers
            .filter(|word| !word.is_empty())
            .skip(2)
            .map(|word| str::from_utf8(word).ok().and_then(|word| word.parse::<usize>().ok()));
        let (Some(Some(lines)), Some(Some(length))) = (numbers.next(), numbers.next()) else {
            continue;
        };
        for _ in 0..lines {
            let end = rest.iter().position(|byte| *byte == b'\n').map_or(rest.len(), |at| at + 1);
            rest = &rest[end..];
        }
        rest = &rest[length.min(rest.len())..];
        // The line of the delimiter begins behind the last byte, or on the next line.
        rest = rest.strip_prefix(b"\r\n").or_else(|| rest.strip_prefix(b"\n")).unwrap_or(rest);
    }
    kept
}

/// The normal modes of a file, with their shapes in some directions.
pub(super) fn read(file: &ModesFile, at: &[Direction]) -> Result<Universal, CaseError> {
    let text = file.text();
    let refused = |problem: Box<Problem>| CaseError::new(&file.name, text, vec![*problem], 0);
    let (mut sets, mut shapes, mut complex) = (Vec::new(), Vec::new(), Vec::new());
    let mut kg = 1.0;
    for DataSet { number, lines } in data_sets(text).map_err(refused)? {
        let read_as = match number {
            "164" => {
                kg = unit_of_mass(text, &lines).map_err(refused)?;
                ReadAs::Units
            }
            "55" | "2414" => {
                let set = if number == "55" { SET_55 } else { SET_2414 };
                match shape(text, &lines, &set).map_err(refused)? {
                    Shape::Mode(mode) => {
                        shapes.push(mode);
                        ReadAs::Mode
                    }
                    Shape::Complex => {
                        complex.push(line_of(text, number));
                        ReadAs::Nothing
                    }
                    Shape::Other => ReadAs::Nothing,
                }
            }
            _ => ReadAs::Nothing,
        };
        sets.push((number.to_owned(), read_as));
    }
    if shapes.is_empty() {
        let message = match complex.is_empty() {
            false => "the modes of the file are complex".to_owned(),
            true => "the file has no normal mode".to_owned(),
        };
        let expected = "expected data sets 55 or 2414 of normal modes, real displacements";
        let help = "export normal modes with their modal masses, or write [[mode]]";
        return Err(refused(problem(text, first_line(text), message, expected, help)));
    }
    let nodes: BTreeSet<u64> =
        shapes.iter().flat_map(|one| one.nodes.iter().map(|node| node.number)).collect();
    let nodes: Vec<u64> = nodes.into_iter().collect();
    let modes = shapes.into_iter().map(|one| one.mode(at, &nodes, kg)).collect();
    Ok(Universal { modes, nodes, unit_of_mass: kg, sets, complex })
}

/// A data set: its number, and the lines up to its end.
struct DataSet<'t> {
    number: &'t str,
    lines: Vec<&'t str>,
}

/// The data sets of a text; what stands outside of them, or is not closed, is refused: something in it may have been lost.
fn data_sets(text: &str) -> Result<Vec<DataSet<'_>>, Box<Problem>> {
    const AGAIN: &str = "export the file anew";
    let mut sets = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.find(|line| !line.trim().is_empty()) {
        if !is_delimiter(line) {
            let (message, help) = match line.trim() == DELIMITER.trim() {
                true => ("a line -1 is not in columns 5 and 6", "write it behind four blanks"),
                false => (
                    "the line is in no data set",
                    "remove it, or export the file anew: a line -1 may be missing above",
                ),
            };
            let expected = "expected a line `    -1` before a data set";
            return Err(problem(text, line, message.to_owned(), expected, help));
        }
        let first = lines.next().unwrap_or(line);
        let number = first.split_whitespace().next().unwrap_or("");
        let digits = number.trim_end_matches(char::is_alphabetic);
        if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
            let message = "the number of a data set cannot be read".to_owned();
            return Err(problem(text, first, message, "expected a number, such as 55", AGAIN));
        }
        let mut is_closed = false;
        let within = |line: &&str| {
            is_closed = is_delimiter(line);
            !is_closed
        };
        let lines: Vec<&str> = lines.by_ref().take_while(within).collect();
        if !is_closed {
            let message = format!("the file ends within data set {number}");
            let expected = "expected a line `    -1` behind it";
            let last = lines.last().copied().unwrap_or(first_line(text));
            let help = "export the file anew: it may be truncated";
            return Err(problem(text, last, message, expected, help));
        }
        // What a delimiter in other columns would end and begin, unseen in a data set that is not used.
        let loose = |line: &str| line.trim() == DELIMITER.trim();
        let known = |line: &str| ["55", "2414", "164"].contains(&line.trim());
        let hidden = lines.windows(3).find(|of| loose(of[0]) && loose(of[1]) && known(of[2]));
        if let Some(hidden) = hidden {
            let message = format!("within data set {number} another one seems to begin");
            let expected = "expected a line -1 between data sets in columns 5 and 6";
            return Err(problem(text, hidden[1], message, expected, AGAIN));
        }
        sets.push(DataSet { number, lines });
    }
    Ok(sets)
}

fn first_line(text: &str) -> &str {
    text.lines().next().unwrap_or(text)
}

/// The number, from 1, of the line that a part of a text is in.
pub(super) fn line_of(text: &str, part: &str) -> usize {
    let start = part.as_ptr() as usize - text.as_ptr() as usize;
    1 + text.as_bytes()[..start].iter().filter(|byte| **byte == b'\n').count()
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
    Mode(NodalMode),
    Complex,
    Other,
}

/// The displacement of a node.
struct Node {
    number: u64,
    displacement: [f64; 3],
}

/// A mode with its nodes, ascending.
struct NodalMode {
    frequency_hz: f64,
    damping_ratio: f64,
    /// In the file's unit.
    mass: f64,
    nodes: Vec<Node>,
    line: usize,
}

impl NodalMode {
    fn at(&self, node: u64) -> Option<[f64; 3]> {
        let found = self.nodes.binary_search_by_key(&node, |one| one.number).ok()?;
        Some(self.nodes[found].displacement)
    }

    /// The mode in SI units with its shape in some directions, and all of it at all nodes of the file, 0 where it has none.
    fn mode(&self, at: &[Direction], nodes: &[u64], kg: f64) -> FileMode {
        let value = |one: &Direction| {
            self.at(one.node).map_or(f64::NAN, |moves| one.sign * moves[one.axis])
        };
        FileMode {
            mode: StructuralMode {
                frequency_hz: self.frequency_hz,
                damping_ratio: self.damping_ratio,
                mass_kg: self.mass * kg,
                shape: at.iter().map(value).collect(),
                participation: f64::NAN,
                forcing: 0.0,
            },
            whole: nodes.iter().flat_map(|node| self.at(*node).unwrap_or_default()).collect(),
            nodes: self.nodes.len(),
            line: self.line,
        }
    }
}

fn shape(text: &str, lines: &[&str], set: &Set) -> Result<Shape, Box<Problem>> {
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
    let [Some(frequency_hz), Some(mass), Some(viscous), hysteretic] =
        set.at.map(|k| numbers.get(k).copied())
    else {
        let expected = "expected frequency, modal mass and damping ratio";
        return Err(wrong(lines[set.numbers], "the numbers of a mode cannot be read", expected));
    };
    // At resonance a loss factor is twice a damping ratio.
    let damping_ratio = if viscous > 0.0 { viscous } else { 0.5 * hysteretic.unwrap_or(0.0) };
    let (mut nodes, mut most) = (Vec::new(), [0.0_f64; 2]);
    let each = if pairs { 2 } else { 1 };
    for record in lines[set.head..].chunks(1 + (each * *count as usize).div_ceil(6)) {
        let node = integers(record[0]).and_then(|all| u64::try_from(*all.first()?).ok());
        let values = record.get(1).and_then(|line| reals(line, WIDTH));
        let (Some(number), Some(values)) = (node, values.filter(|all| all.len() >= 3 * each))
        else {
            let expected = "expected its number, and its displacements in the next line";
            return Err(wrong(record[0], "a node of a shape cannot be read", expected));
        };
        for (k, value) in values[..3 * each].iter().enumerate() {
            most[k % each] = most[k % each].max(value.abs());
        }
        let displacement = [0, 1, 2].map(|axis| values[each * axis]);
        nodes.push((Node { number, displacement }, record[0]));
    }
    nodes.sort_by_key(|(node, _)| node.number);
    if let Some(two) = nodes.windows(2).find(|two| two[0].0.number == two[1].0.number) {
        let ([first, second], node) =
            ([two[0].1, two[1].1].map(|at| line_of(text, at)), two[0].0.number);
        let message = format!("node {node} stands twice in a shape, in lines {first} and {second}");
        return Err(wrong(two[1].1, &message, "expected each node once"));
    }
    if pairs && most[1] > IMAGINARY * most[0] {
        return Ok(Shape::Complex);
    }
    let nodes = nodes.into_iter().map(|(node, _)| node).collect();
    let line = line_of(text, lines[set.numbers]);
    Ok(Shape::Mode(NodalMode { frequency_hz, damping_ratio, mass, nodes, line }))
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
