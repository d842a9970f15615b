//! A sweep as tables.

use serde::Serialize;

use super::facts::{Facts, Group};
use super::grid::{Grid, SweepDirection};
use super::words::{from_to, signed};
use crate::regimes::Regime;
use crate::report::numbers::{percent_sharply, significant};
use crate::report::tables::{Column, Table, table};

/// Regimes that have a column of their own; with where, how many and the rest these are seven columns.
const MOST_REGIMES: usize = 4;
/// Stretches of one axis that are listed.
const MOST_STRETCHES: usize = 24;

/// A table under a heading.
#[derive(Debug, Clone, Serialize)]
pub struct TitledTable {
    /// The heading.
    pub title: String,
    /// What it says, in a sentence or two.
    pub words: String,
    /// The table.
    pub table: Table,
    /// Whether it is long enough to be folded.
    pub folded: bool,
}

pub(super) fn tables(grid: &Grid, facts: &[Facts]) -> Vec<TitledTable> {
    let mut all = Vec::new();
    for facts in facts {
        let titled = |title: &str, words: &str, table: Table| TitledTable {
            title: match facts.pass {
                SweepDirection::Single => title.to_owned(),
                pass => format!("{title}, {}", pass.words()),
            },
            words: words.to_owned(),
            folded: table.rows.len() > 12,
            table,
        };
        if !facts.regimes.is_empty() {
            let words = "Share of the points by their main motion, and what it is like there.";
            all.push(titled("Regimes", words, regimes(grid, facts)));
        }
        if grid.swept.axes.len() == 1 && grid.regimes(facts.pass).is_some() {
            let words = "Stretches in which neighbours have the same regime.";
            all.push(titled("Along the axis", words, stretches(grid, facts.pass)));
        }
        let groups: Vec<&Group> = facts.areas.iter().chain(&facts.orbits).collect();
        if !groups.is_empty() && !grid.is_basin() {
            let words = "Of the points in each area of the theory, and where an exact orbit attracts or none does: the share whose \
                         main motion, as simulated, is of each regime.";
            all.push(titled("Theory and simulation", words, contingency(facts, &groups)));
        }
    }
    all
}

fn regimes(grid: &Grid, facts: &Facts) -> Table {
    let lengths = &grid.lengths;
    let dash = || "–".to_owned();
    let rows = facts.regimes.iter().map(|one| {
        let peak = one.peak.map(|ends| {
            let [low, high] = ends.map(|peak| significant(lengths.number(peak), 3));
            from_to(low, high, lengths.unit)
        });
        let reduction = one.reduction_db.map(|ends| {
            let [low, high] = ends.map(signed);
            from_to(low, high, "dB")
        });
        let rate = one.impacts_per_period.map(|ends| {
            let [low, high] = ends.map(|rate| significant(rate, 3));
            from_to(low, high, "")
        });
        [
            one.regime.words().to_owned(),
            percent_sharply(one.share),
            rate.unwrap_or_else(dash),
            peak.unwrap_or_else(dash),
            reduction.unwrap_or_else(dash),
        ]
    });
    let table = table(
        [
            ("Main motion", false),
            ("Share", true),
            ("Impacts per period", true),
            ("Peak", true),
            ("Reduction", true),
        ],
        rows.collect(),
    );
    without_empty(table)
}

/// A table without the columns in which nothing stands.
fn without_empty(mut table: Table) -> Table {
    for column in (0..table.columns.len()).rev() {
        if table.rows.iter().all(|row| row[column] == "–") {
            table.columns.remove(column);
            table.rows.iter_mut().for_each(|row| drop(row.remove(column)));
        }
    }
    table
}

fn stretches(grid: &Grid, pass: SweepDirection) -> Table {
    let axis = &grid.swept.axes[0];
    let regimes = grid.regimes(pass).unwrap_or_default();
    let rate = grid.number("impacts_per_period", pass);
    let peak = grid.number("peak", pass);
    let dash = || "–".to_owned();
    let (mut begin, mut rows) = (0, Vec::new());
    for run in regimes.chunk_by(|a, b| a == b) {
        let within = begin..begin + run.len();
        let range = |values: &Option<Vec<Option<f64>>>, shown: &dyn Fn(f64) -> f64, unit: &str| {
            let values = values.as_ref()?;
            let here: Vec<f64> = values[within.clone()].iter().flatten().copied().collect();
            let low = here.iter().copied().min_by(f64::total_cmp)?;
            let high = here.iter().copied().max_by(f64::total_cmp)?;
            let [low, high] = [low, high].map(|value| significant(shown(value), 3));
            Some(from_to(low, high, unit))
        };
        rows.push([
            axis.number(begin),
            axis.number(begin + run.len() - 1),
            run.len().to_string(),
            run[0].map_or("not worked out", Regime::words).to_owned(),
            range(&rate, &|rate| rate, "").unwrap_or_else(dash),
            range(&peak, &|peak| grid.lengths.number(peak), grid.lengths.unit).unwrap_or_else(dash),
        ]);
        begin += run.len();
    }
    let left = rows.len().saturating_sub(MOST_STRETCHES);
    rows.truncate(MOST_STRETCHES);
    if left > 0 {
        let more = format!("and {left} more stretches");
        rows.push([dash(), dash(), dash(), more, dash(), dash()]);
    }
    let table = table(
        [
            ("From", true),
            ("To", true),
            ("Points", true),
            ("Main motion", false),
            ("Impacts per period", true),
            ("Peak", true),
        ],
        rows,
    );
    without_empty(table)
}

fn contingency(facts: &Facts, groups: &[&Group]) -> Table {
    let mut shown: Vec<&super::facts::RegimeFacts> = facts.regimes.iter().collect();
    shown.sort_by_key(|one| std::cmp::Reverse(one.points));
    // One more instead of "other", where it is the only other.
    let own = if shown.len() == MOST_REGIMES + 1 { shown.len() } else { MOST_REGIMES };
    let more = shown.len() > own;
    shown.truncate(own);
    let mut shown: Vec<Regime> = shown.into_iter().map(|one| one.regime).collect();
    shown.sort_by_key(|regime| regime.index());
    let mut columns =
        vec![Column { title: "Where", numeric: false }, Column { title: "Points", numeric: true }];
    columns.extend(shown.iter().map(|regime| Column { title: regime.short(), numeric: true }));
    columns.extend(more.then_some(Column { title: "other", numeric: true }));
    let rows = groups.iter().map(|group| {
        let name = match group.name {
            area if area.starts_with('Z') => format!("area {}", super::kinds::area_words(area)),
            other => other.to_owned(),
        };
        let mut row = vec![name, group.points.to_string()];
        row.extend(shown.iter().map(|regime| percent_sharply(group.share(*regime))));
        if more {
            let rest = Regime::ALL.into_iter().filter(|regime| !shown.contains(regime));
            let rest: f64 = rest.map(|regime| group.share(regime)).sum();
            row.push(percent_sharply(rest));
        }
        row
    });
    Table { rows: rows.collect(), columns }
}
