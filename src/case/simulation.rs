//! The optional table `[simulation]`: how long, and from how many starts, a case is simulated.

use std::ops::RangeInclusive;

use super::reader::{Bound, Field, Reader};
use super::table::Table;

/// What the case says about its simulation; `None` where it leaves the choice to the program.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct SimulationSettings {
    /// Excitation periods that are measured, from 1 to 100 million.
    pub periods: Option<u64>,
    /// Excitation periods simulated before the measurement begins, up to 100 million.
    pub discard: Option<u64>,
    /// Number of initial conditions, from 1 to 10 000.
    pub starts: Option<u64>,
}

pub(super) const TABLE: &str = "simulation";
pub(super) const KEYS: &[&str] = &["periods", "discard", "starts"];

const MOST_PERIODS: u64 = 100_000_000;
const PERIODS: RangeInclusive<u64> = 1..=MOST_PERIODS;
const DISCARD: RangeInclusive<u64> = 0..=MOST_PERIODS;
const STARTS: RangeInclusive<u64> = 1..=10_000;

/// Reads the table, which may be missing.
pub(super) fn read(reader: &mut Reader, root: &Table) -> SimulationSettings {
    let Some(table) = reader.table(root, TABLE) else { return SimulationSettings::default() };
    let mut whole = |key, symbol, example, range| {
        table.whole_number(reader, Field::new(key, symbol, Bound::Any, example), range)
    };
    SimulationSettings {
        periods: whole("periods", "N", "2000", PERIODS),
        discard: whole("discard", r"N_\mathrm{discard}", "500", DISCARD),
        starts: whole("starts", r"N_\mathrm{starts}", "64", STARTS),
    }
}

/// How the case is simulated. Each key may be left out.
#[derive(schemars::JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "describes the table to editors; read() is what reads it")]
pub(super) struct SimulationTable {
    /// Excitation periods that are measured.
    #[schemars(range(min = 1, max = 100_000_000), example = 2000)]
    periods: Option<u64>,
    /// Excitation periods simulated first, so that transients die out, and not measured.
    #[schemars(range(min = 0, max = 100_000_000), example = 500)]
    discard: Option<u64>,
    /// Number of initial conditions tried: one start can miss a coexisting motion.
    #[schemars(range(min = 1, max = 10_000), example = 64)]
    starts: Option<u64>,
}
