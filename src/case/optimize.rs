//! The optional table `[optimize]`: what `vinesink optimize` looks for, and within which bounds.

use toml::de::{DeArray, DeValue};

use super::Design;
use super::list::{Item, List};
use super::quantity::{Length, Mass, Quantity};
use super::reader::{Bound, Reader};
use super::suggest::nearest;
use super::table::Table;

/// What a design is chosen for, over the case's band if it has one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Objective {
    /// The largest share of the band in area Z3 of the theory.
    #[default]
    Z3Share,
    /// The largest share of the band with a stable symmetric 1:1 orbit.
    StableShare,
    /// The smallest worst amplitude over the band.
    WorstAmplitude,
    /// The largest smallest relative distance of the clearance from the ends of the stable 1:1 motion.
    Margin,
}

impl Objective {
    /// Every objective.
    pub const ALL: [Self; 4] =
        [Self::Z3Share, Self::StableShare, Self::WorstAmplitude, Self::Margin];

    /// The name in a case file and on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Z3Share => "z3-share",
            Self::StableShare => "stable-share",
            Self::WorstAmplitude => "worst-amplitude",
            Self::Margin => "margin",
        }
    }

    /// The objective of that name.
    pub fn of(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|one| one.name() == name)
    }
}

/// What the case says about its optimisation. Bounds ascend, in SI units or the case's own.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct OptimizeSettings {
    /// What is looked for; `None` where the case does not say.
    pub objective: Option<Objective>,
    /// Bounds of the clearance; `None` for a fifth to five times the case's.
    pub clearance: Option<[f64; 2]>,
    /// Bounds of the restitution, which is the case's where there are none.
    pub restitution: Option<[f64; 2]>,
    /// Bounds of the absorber's mass in kg, which is the case's where there are none.
    pub mass: Option<[f64; 2]>,
}

pub(super) const TABLE: &str = "optimize";
pub(super) const KEYS: &[&str] = &["objective", "clearance", "restitution", "mass"];

/// Reads the table, which may be missing.
pub(super) fn read(reader: &mut Reader, root: &Table, design: Option<&Design>) -> OptimizeSettings {
    let table = reader.table(root, TABLE);
    let (Some(table), Some(design)) = (table, design) else { return OptimizeSettings::default() };
    let physical = matches!(design, Design::Physical(_));
    let clearance = if physical {
        let field =
            List { key: "clearance", bound: Bound::Positive, example: "[\"5 mm\", \"40 mm\"]" };
        read_bounds(reader, &table, field, List::quantity::<Length>)
    } else {
        let field = List { key: "clearance", bound: Bound::Positive, example: "[0.5, 2.0]" };
        read_bounds(reader, &table, field, List::number)
    };
    let restitution = List { key: "restitution", bound: Bound::UpToOne, example: "[0.4, 0.8]" };
    let mass = List { key: "mass", bound: Bound::Positive, example: "[\"20 g\", \"50 g\"]" };
    let settings = OptimizeSettings {
        objective: read_objective(reader, &table),
        clearance,
        restitution: read_bounds(reader, &table, restitution, List::number),
        mass: if physical {
            read_bounds(reader, &table, mass, List::quantity::<Mass>)
        } else {
            None
        },
    };
    if !physical && table.has(mass.key) {
        reader.report(
            table.span_of(mass.key),
            "a reduced case has no mass to choose",
            "expected `mass` beside [oscillator], [absorber] and [excitation] only",
            "remove the line, or describe the design in physical units",
        );
    }
    settings
}

fn read_objective(reader: &mut Reader, table: &Table) -> Option<Objective> {
    table.entry("objective")?;
    let written = table.text(reader, "objective", "objective = \"z3-share\"")?;
    let found = Objective::of(written);
    if found.is_none() {
        let names = Objective::ALL.map(Objective::name);
        let help = match nearest(written, &names) {
            Some(near) => format!("did you mean \"{near}\"?"),
            None => "write for example objective = \"z3-share\"".to_owned(),
        };
        let expected = format!("expected one of {}", names.join(", "));
        let message = format!("`objective` is \"{written}\"");
        reader.report(table.span_of_value("objective"), message, expected, help);
    }
    found
}

fn read_bounds(reader: &mut Reader, table: &Table, list: List, item: Item) -> Option<[f64; 2]> {
    let key = list.key;
    let (_, value) = table.entry(key)?;
    let pair: Option<&DeArray> = match value.get_ref() {
        DeValue::Array(pair) if pair.len() == 2 => Some(pair),
        _ => None,
    };
    let Some(pair) = pair else {
        let message = format!("`{key}` is not a pair of bounds");
        reader.report(value.span(), message, "expected two values between brackets", list.help());
        return None;
    };
    let bounds = [item(&list, reader, pair.first()?)?, item(&list, reader, pair.get(1)?)?];
    if bounds[0] < bounds[1] {
        return Some(bounds);
    }
    let message = format!("the bounds of `{key}` do not rise");
    let help = "write the smaller bound first; remove the line to keep the case's own value";
    reader.report(value.span(), message, "expected the second bound above the first", help);
    None
}

/// What `vinesink optimize` looks for, and within which bounds. The table may be left out.
#[derive(schemars::JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "describes the table to editors; read() is what reads it")]
pub(super) struct OptimizeTable {
    /// What is looked for: the largest share of the band in area Z3 (unless given), the largest share
    /// with a stable 1:1 orbit, the smallest worst amplitude, or the largest margin in clearance.
    objective: Option<ObjectiveName>,
    /// Bounds of the clearance; a fifth to five times the case's own unless given. Plain numbers
    /// beside [reduced].
    #[schemars(example = ["5 mm", "40 mm"])]
    clearance: Option<Vec<serde_json::Value>>,
    /// Bounds of the restitution, from 0 to 1; the case's own value unless given.
    #[schemars(example = [0.4, 0.8])]
    restitution: Option<Vec<f64>>,
    /// Bounds of the absorber's mass; the case's own unless given. Not beside [reduced].
    #[schemars(example = ["20 g", "50 g"])]
    mass: Option<Vec<Quantity<Mass>>>,
}

#[derive(schemars::JsonSchema)]
#[schemars(rename_all = "kebab-case")]
#[expect(dead_code, reason = "describes a key to editors")]
enum ObjectiveName {
    Z3Share,
    StableShare,
    WorstAmplitude,
    Margin,
}
