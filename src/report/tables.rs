//! Tables of a report, formatted: every number with its unit and no more digits than it deserves.

use serde::Serialize;

use super::notes::finding;
use super::numbers::{
    LengthFormat, capitalised, decibels, fixed, percent, signed, signed_percent, significant,
};
use super::units::Units;
use crate::band::rivals::Damped;
use crate::band::{Band, Rivals};
use crate::case::{Case, Input};
use crate::study::CaseStudy;
use crate::validation::{Claim, Finding, Measure};

/// A table of text.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Table {
    /// Column heads; at most seven.
    pub columns: Vec<Column>,
    /// Rows, as long as the columns.
    pub rows: Vec<Vec<String>>,
}

/// A column head.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Column {
    /// Its text.
    pub title: &'static str,
    /// Whether its cells are numbers, to be aligned on the right.
    pub numeric: bool,
}

/// A row of the table on the first screen.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct KeyRow {
    /// What.
    pub quantity: String,
    /// How much, with its unit.
    pub value: String,
    /// The layer that gave it.
    pub from: &'static str,
    /// Anchor of the section that says more.
    pub anchor: &'static str,
}

pub(super) fn table<const N: usize>(
    columns: [(&'static str, bool); N],
    rows: Vec<[String; N]>,
) -> Table {
    Table {
        columns: columns.into_iter().map(|(title, numeric)| Column { title, numeric }).collect(),
        rows: rows.into_iter().map(Vec::from).collect(),
    }
}

fn row(quantity: &str, value: String, from: &'static str, anchor: &'static str) -> KeyRow {
    KeyRow { quantity: quantity.to_owned(), value, from, anchor }
}

/// Names of the inputs that the first screen shows.
const KEY_INPUTS: [(&str, &str, &str); 5] = [
    ("clearance", "absorber", "Clearance b"),
    ("restitution", "absorber", "Restitution r"),
    ("mass", "absorber", "Absorber mass m₂"),
    ("amplitude", "excitation", "Excitation amplitude"),
    ("frequency", "excitation", "Excitation frequency"),
];

/// Inputs and key results.
pub fn key_rows(case: &Case, study: &CaseStudy) -> Vec<KeyRow> {
    let scales = case.scales();
    let lengths = LengthFormat::of(&scales);
    let length = |over_clearance: f64| lengths.text(scales.length(over_clearance));
    let mut rows = key_inputs(case);
    let system = &study.analysis.system;
    let mass_ratio = format!("{} %", significant(100.0 * system.mass_ratio(), 3));
    rows.push(row("Mass ratio ε", mass_ratio, "case file", "inputs"));
    let bare = system.linear_response().map(|bare| bare.amplitude());
    if let Some(bare) = bare {
        rows.push(row(
            "Vibration of the bare oscillator",
            length(bare),
            "closed form, (1)",
            "inputs",
        ));
    }
    rows.extend(rivals(case, study));
    if let Some(main) = study.main_attractor() {
        let simulation = "simulation";
        let attractor = &main.attractor;
        rows.push(row(
            "Vibration with the absorber, peak",
            length(attractor.peak),
            simulation,
            "motions",
        ));
        if let Some(bare) = bare.filter(|bare| *bare > 0.0) {
            rows.push(row(
                "Change of the peak",
                decibels(attractor.peak / bare),
                simulation,
                "motions",
            ));
        }
        let z = attractor.classification.evidence.impacts_per_period;
        let digits = if attractor.repeats() { 4 } else { 2 };
        rows.push(row("Impacts per period z", significant(z, digits), simulation, "motions"));
    }
    if let Some(orbit) = study.exact.attracting() {
        let radius = orbit.orbit.multipliers.spectral_radius();
        rows.push(row(
            "Peak of the exact symmetric orbit",
            length(orbit.peaks.displacement),
            "exact orbit",
            "orbits",
        ));
        rows.push(row(
            "Its largest multiplier, per half period",
            significant(radius, 3),
            "exact orbit",
            "orbits",
        ));
    }
    if let Some(point) = study.analysis.stable_points().last() {
        rows.push(row(
            "Amplitude C of the stable fixed point",
            length(point.oscillator_amplitude),
            "slow flow, (18)",
            "theory",
        ));
    }
    let area = match study.analysis.zone.strip {
        Some(strip) => format!("{:?}, strip {strip:?}", study.area.area),
        None => format!("{:?}", study.area.area),
    };
    rows.push(row("Area of the case", area, study.area.by.words(), "theory"));
    rows
}

/// Along a band its worst motion, the bare oscillator and the tuned mass damper; at a single excitation the
/// damper, beside what stands there already.
fn rivals(case: &Case, study: &CaseStudy) -> Vec<KeyRow> {
    let units = Units::of(case);
    let length = |over_clearance: f64| units.length_text(over_clearance);
    let damper = |rivals: &Rivals| {
        let Damped { amplitude, stroke, .. } = rivals.damped;
        format!("{}, stroke {}", length(amplitude), length(stroke))
    };
    let with_damper = "Vibration with a tuned mass damper";
    let Some(survey) = &study.band else {
        let here = Rivals::along(&Band::point(&study.analysis.system));
        let from = "closed form, Den Hartog";
        return vec![row(with_damper, damper(&here), from, "inputs")];
    };
    let over = |name: &str| format!("{name}, worst of the band");
    let mut rows = Vec::new();
    if let Some(worst) = survey.motions.worst() {
        let at = units.band_text(survey.band().over, worst.at);
        let words = format!("{} at {at}", units.length_with_error(worst.peak, worst.error));
        rows.push(row(&over("Vibration with the absorber"), words, "all layers", "band"));
    }
    let bare = length(survey.rivals.bare.1);
    rows.push(row(&over("Vibration of the bare oscillator"), bare, "closed form", "band"));
    rows.push(row(&over(with_damper), damper(&survey.rivals), "closed form", "band"));
    rows
}

fn key_inputs(case: &Case) -> Vec<KeyRow> {
    let inputs = case.inputs();
    let shown =
        |input: &&Input, name: &str, table: &str| input.name == name && input.table == table;
    let mut rows: Vec<KeyRow> = KEY_INPUTS
        .iter()
        .filter_map(|(name, table, words)| {
            let input = inputs.iter().find(|input| shown(input, name, table))?;
            Some(row(words, input.as_written.clone(), "case file", "inputs"))
        })
        .collect();
    if rows.is_empty() {
        rows = inputs
            .iter()
            .map(|input| KeyRow {
                quantity: words(input.name),
                value: input.as_written.clone(),
                from: "case file",
                anchor: "inputs",
            })
            .collect();
    }
    rows
}

fn words(name: &str) -> String {
    capitalised(&name.replace('_', " "))
}

/// Every number of the case.
pub fn inputs(case: &Case) -> Table {
    let given = case.inputs().iter().map(|input| {
        [
            words(&format!("{} {}", input.table, input.name)),
            format!("${}$", input.symbol),
            input.as_written.clone(),
            input.table.to_owned(),
        ]
    });
    let lengths = LengthFormat::of(&case.scales());
    let derived = case.derived();
    let derived = derived.iter().map(|input| {
        let value = match input.unit {
            "1" => significant(input.value, 4),
            "m" => lengths.with_digits(input.value, 4),
            unit => format!("{} {unit}", significant(input.value, 4)),
        };
        [words(input.name), format!("${}$", input.symbol), value, "derived".to_owned()]
    });
    table(
        [("Quantity", false), ("Symbol", false), ("Value", true), ("From", false)],
        given.chain(derived).collect(),
    )
}

/// Fixed points of the slow flow.
pub fn fixed_points(case: &Case, study: &CaseStudy) -> Table {
    let scales = case.scales();
    let lengths = LengthFormat::of(&scales);
    let rows = study.analysis.fixed_points.iter().map(|point| {
        [
            lengths.with_digits(scales.length(point.oscillator_amplitude), 4),
            lengths.with_digits(scales.length(point.absorber_amplitude), 4),
            format!("{} rad", fixed(point.eta, 3)),
            point.branch.words().to_owned(),
            format!(
                "{}, trace {}, det {}",
                point.kind.words(),
                significant(point.trace, 3),
                significant(point.determinant, 3)
            ),
            if point.stable { "stable" } else { "unstable" }.to_owned(),
            point.above_collision.map_or_else(|| "–".to_owned(), percent),
        ]
    });
    let columns = [
        ("C", true),
        ("B", true),
        ("η", true),
        ("Branch", false),
        ("Slow flow", false),
        ("Motion", false),
        ("γ above the collision", true),
    ];
    table(columns, rows.collect())
}

/// The layers against one another.
pub fn claims(case: &Case, study: &CaseStudy) -> Table {
    let reasons = reasons(study);
    let rows = study.claims.iter().map(|claim| {
        [
            claim.verdict.words().to_owned(),
            claim.statement.clone(),
            claim.source.to_owned(),
            claim.checked_by.words().to_owned(),
            finding(case, &claim.predicted),
            finding(case, &claim.observed),
            difference(claim, &reasons),
        ]
    });
    table(
        [
            ("Verdict", false),
            ("Claim", false),
            ("Claimed by", false),
            ("Checked by", false),
            ("Predicted", false),
            ("Observed", false),
            ("Error, allowed", true),
        ],
        rows.collect(),
    )
}

/// The distinct reasons for the tolerances of a study's claims, in order of appearance; the table
/// refers to them by letter.
fn reasons(study: &CaseStudy) -> Vec<String> {
    let mut reasons: Vec<String> = Vec::new();
    for claim in &study.claims {
        if !reasons.contains(&claim.tolerance.reason) {
            reasons.push(claim.tolerance.reason.clone());
        }
    }
    reasons
}

/// The same with their letters.
pub fn lettered_reasons(study: &CaseStudy) -> Vec<String> {
    let reasons = reasons(study).into_iter().enumerate();
    reasons.map(|(index, reason)| format!("({}) {reason}", letter(index))).collect()
}

fn letter(index: usize) -> char {
    char::from(b'a' + (index % 26) as u8)
}

/// The error, what was allowed, and the letter of the reason.
fn difference(claim: &Claim, reasons: &[String]) -> String {
    let index = reasons.iter().position(|reason| *reason == claim.tolerance.reason).unwrap_or(0);
    let letter = letter(index);
    let allowed = claim.tolerance.value;
    match (claim.difference, &claim.predicted) {
        (Some(value), Finding::Number(_, Measure::Angle)) => {
            format!("{} rad of {} rad ({letter})", signed(value, 4), significant(allowed, 2))
        }
        (Some(value), _) if allowed < FINE => {
            format!("{} of {} ({letter})", significant(value, 1), significant(allowed, 1))
        }
        (Some(value), _) => {
            format!("{} of {} ({letter})", signed_percent(value), percent(allowed))
        }
        (None, _) => format!("({letter})"),
    }
}

/// Relative tolerances below this are shown as plain numbers: nobody says 1e-7 %.
const FINE: f64 = 1e-6;

/// Quality of the numerics, per motion.
pub fn numerics(study: &CaseStudy) -> Table {
    let rows = study.attractors.iter().map(|found| {
        let attractor = &found.attractor;
        let contact = attractor.sustained_contact;
        [
            found.regime().words().to_owned(),
            attractor.periods.to_string(),
            significant(attractor.energy.relative_residual, 1),
            format!("{} b", significant(attractor.penetration, 1)),
            contact.intervals.to_string(),
            if attractor.classification.evidence.settled { "yes" } else { "no" }.to_owned(),
            attractor.stop.words().to_owned(),
        ]
    });
    table(
        [
            ("Motion", false),
            ("Periods", true),
            ("Energy residual", true),
            ("Penetration", true),
            ("Sustained contacts", true),
            ("Settled", false),
            ("Run ended by", false),
        ],
        rows.collect(),
    )
}
