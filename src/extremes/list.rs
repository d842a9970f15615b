//! What is simulated: Table 1 of Li, Seguy and Berlioz at 8 Hz and b = 7.5 mm with one number moved
//! to the end of its range, long runs, chattering, and some corners where several are there at once.

use std::f64::consts::TAU;

use super::measure::Run;
use crate::simulation::ContactTolerance;
use crate::system::{Excitation, InvalidParameter, Parameters, State, System};

/// Excitation periods of a run, unless it says otherwise.
const PERIODS: u64 = 200;
/// Fewest fast time of a run: at a high frequency the absorber crosses its cavity in many periods.
const SHORTEST: f64 = 20.0;
/// Most fast time of a run: at a low frequency a period is long.
const LONGEST: f64 = 40_000.0;
/// Impacts after which a run is given up.
pub const IMPACT_LIMIT: u64 = 100_000;
/// Impacts and releases that the reference follows.
pub const FOLLOWED: usize = 30;
/// Fast through the middle of the cavity, so that it meets the walls whatever drives it.
pub const START: State = State { x: 0.25, x_velocity: 0.3, y: -0.4, y_velocity: 0.6 };

/// What is extreme about a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// The restitution.
    Restitution,
    /// The mass ratio.
    MassRatio,
    /// The damping.
    Damping,
    /// The forcing per clearance.
    Forcing,
    /// The frequency ratio.
    Frequency,
    /// The number of periods.
    Length,
    /// Chattering and sustained contact in a small clearance.
    Contact,
    /// Several at once.
    Corner,
    /// The start.
    Start,
}

impl Group {
    /// The name of what is varied, as Markdown.
    pub fn words(self) -> &'static str {
        match self {
            Self::Restitution => "restitution $r$",
            Self::MassRatio => "mass ratio $\\varepsilon$",
            Self::Damping => "damping $\\lambda$",
            Self::Forcing => "forcing per clearance $\\gamma$",
            Self::Frequency => "frequency ratio $\\Omega$",
            Self::Length => "number of periods",
            Self::Contact => "restitution at $b = 0.3\\,\\mathrm{mm}$",
            Self::Corner => "several at once",
            Self::Start => "start",
        }
    }
}

/// A run, and what is extreme about it.
#[derive(Debug, Clone)]
pub struct Entry {
    /// What is varied.
    pub group: Group,
    /// Its value, as Markdown.
    pub value: String,
    /// The run.
    pub run: Run,
}

/// Table 1 at 8 Hz with a clearance in mm and F = 0.25 mm, which is inferred, not published.
pub fn table_1(clearance_mm: f64) -> Parameters {
    let mass_ratio = 0.032 / 4.168;
    let natural = (11.47e3_f64 / 4.168).sqrt();
    Parameters {
        mass_ratio,
        damping: 3.02 / (0.032 * natural),
        restitution: 0.6,
        frequency_ratio: 8.0 * TAU / natural,
        forcing_per_clearance: 0.25 / mass_ratio / clearance_mm,
        excitation: Excitation::BaseDisplacement,
    }
}

/// All of them, in the order of the page.
///
/// # Errors
/// [`InvalidParameter`] if the list itself were wrong.
pub fn entries() -> Result<Vec<Entry>, InvalidParameter> {
    let base = table_1(7.5);
    let chatter = table_1(0.3);
    let mut list = List(Vec::new());
    for restitution in [0.0, 1e-9, 0.05, 0.999_999, 1.0] {
        list.vary(Group::Restitution, restitution, Parameters { restitution, ..base })?;
    }
    for mass_ratio in [1e-9, 1e-6, 1e-3, 0.1, 0.9] {
        list.vary(Group::MassRatio, mass_ratio, Parameters { mass_ratio, ..base })?;
    }
    for damping in [0.0, 1e-3, 10.0, 100.0, 1e3] {
        list.vary(Group::Damping, damping, Parameters { damping, ..base })?;
    }
    // Both are powers of two: exactly critical.
    let critical = Parameters { mass_ratio: 1.0 / 128.0, damping: 256.0, ..base };
    list.add(Group::Damping, "256, $\\varepsilon = 1/128$: critical", critical)?;
    for forcing_per_clearance in [1e-8, 1e-4, 1.0, 1e2, 1e4, 1e6, 1e8] {
        let parameters = Parameters { forcing_per_clearance, ..base };
        list.vary(Group::Forcing, forcing_per_clearance, parameters)?;
    }
    for frequency_ratio in [1e-3, 0.1, 1.0, 10.0, 1e3] {
        list.vary(Group::Frequency, frequency_ratio, Parameters { frequency_ratio, ..base })?;
    }
    let resonance = Parameters { frequency_ratio: 1.0, damping: 0.0, ..base };
    list.add(Group::Frequency, "1, undamped", resonance)?;
    for periods in [10_000, 1_000_000] {
        list.add(Group::Length, &power(periods as f64), base)?;
        list.last(|run| run.periods = periods);
    }
    for restitution in [0.0, 0.6, 0.95, 0.99, 0.999_999, 1.0] {
        list.vary(Group::Contact, restitution, Parameters { restitution, ..chatter })?;
    }
    let heavy = Parameters { mass_ratio: 0.9, damping: 1e3, ..base };
    list.add(Group::Corner, "$\\varepsilon = 0.9$, $\\lambda = 10^{3}$", heavy)?;
    let fast = Parameters { frequency_ratio: 1e3, ..heavy };
    list.add(Group::Corner, "$\\varepsilon = 0.9$, $\\lambda = 10^{3}$, $\\Omega = 10^{3}$", fast)?;
    let slow = Parameters { frequency_ratio: 1e-3, forcing_per_clearance: 1e8, ..heavy };
    let words =
        "$\\varepsilon = 0.9$, $\\lambda = 10^{3}$, $\\Omega = 10^{-3}$, $\\gamma = 10^{8}$";
    list.add(Group::Corner, words, slow)?;
    let light = Parameters { mass_ratio: 1e-9, forcing_per_clearance: 1e8, ..base };
    list.add(Group::Corner, "$\\varepsilon = 10^{-9}$, $\\gamma = 10^{8}$", light)?;
    let elastic = Parameters { restitution: 0.999_999, forcing_per_clearance: 1e8, ..base };
    list.add(Group::Corner, "$r = 0.999999$, $\\gamma = 10^{8}$", elastic)?;
    let endless = Parameters { forcing_per_clearance: 1e307, mass_ratio: 0.9, ..base };
    list.add(Group::Corner, "$\\gamma = 10^{307}$, $\\varepsilon = 0.9$", endless)?;
    list.add(Group::Start, "on the wall, moving out", base)?;
    list.last(|run| run.start = State { x: 0.6, x_velocity: 0.3, y: -0.4, y_velocity: 0.1 });
    list.add(Group::Start, "on the wall, at rest against it, pushed", base)?;
    list.last(|run| run.start = State { x: -0.5, x_velocity: 0.1, y: -1.5, y_velocity: 0.1 });
    list.add(Group::Start, "outside by $10^{-9}\\,b$", base)?;
    list.last(|run| run.start = State { x: 1.0 + 1e-9, y: 0.0, ..START });
    Ok(list.0)
}

struct List(Vec<Entry>);

impl List {
    fn vary(
        &mut self,
        group: Group,
        value: f64,
        parameters: Parameters,
    ) -> Result<(), InvalidParameter> {
        self.add(group, &power(value), parameters)
    }

    fn add(
        &mut self,
        group: Group,
        value: &str,
        parameters: Parameters,
    ) -> Result<(), InvalidParameter> {
        let system = System::new(parameters)?;
        let shortest = (SHORTEST / system.period()).ceil();
        let longest = (LONGEST / system.period()).ceil();
        let run = Run {
            system,
            start: START,
            periods: PERIODS.max(shortest as u64).min(longest as u64),
            impact_limit: IMPACT_LIMIT,
            followed: FOLLOWED,
            tolerance: ContactTolerance::default(),
        };
        self.0.push(Entry { group, value: value.to_owned(), run });
        Ok(())
    }

    fn last(&mut self, change: impl FnOnce(&mut Run)) {
        if let Some(entry) = self.0.last_mut() {
            change(&mut entry.run);
            entry.run.impact_limit = entry.run.impact_limit.max(10 * entry.run.periods);
        }
    }
}

/// A number as Markdown: powers of ten as such where they are far from 1.
fn power(value: f64) -> String {
    let text = format!("{value:e}");
    match text.split_once('e') {
        Some((mantissa, exponent)) if !(1e-3..1e4).contains(&value) && value != 0.0 => {
            let factor =
                if mantissa == "1" { String::new() } else { format!("{mantissa} \\cdot ") };
            format!("${factor}10^{{{exponent}}}$")
        }
        _ => value.to_string(),
    }
}
