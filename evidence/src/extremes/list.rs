//! What is simulated: Table 1 of Li, Seguy and Berlioz at 8 Hz and b = 7.5 mm with one number moved
//! to the end of its range, long runs, chattering, and some corners where several are there at once.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use vinesink::system::{Cavity, Excitation, InvalidParameter, Parameters, State, System};

/// Excitation periods of a run, unless it says otherwise.
const PERIODS: u64 = 200;
/// Fewest fast time of a run: at a high frequency the absorber crosses its cavity in many periods.
const SHORTEST: f64 = 20.0;
/// Most fast time of a run: at a low frequency a period is long.
const LONGEST: f64 = 40_000.0;
/// Impacts after which a run is given up, or ten a period where that is more.
pub const IMPACT_LIMIT: u64 = 100_000;

/// A number of Table 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Varied {
    /// Restitution `r`.
    Restitution,
    /// Mass ratio `epsilon`.
    MassRatio,
    /// Damping `lambda`.
    Damping,
    /// Forcing per clearance `gamma`.
    Forcing,
    /// Frequency ratio `Omega`.
    Frequency,
    /// Clearance in mm, to which the forcing per clearance is inversely proportional.
    Clearance,
    /// Gravity along the cavity over `b omega0^2`.
    GravityAlong,
    /// Friction over `b omega0^2`.
    Friction,
}

/// Where a run starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Start {
    /// Fast through the middle of the cavity, so that it meets the walls whatever drives it.
    Middle,
    /// On the wall, moving out.
    MovingOut,
    /// On the wall, at rest against it, pushed.
    Pushed,
    /// Outside by a part in 1e9.
    Outside,
}

impl Start {
    /// The state, over the clearance.
    pub fn state(self) -> State {
        let middle = State { x: 0.25, x_velocity: 0.3, y: -0.4, y_velocity: 0.6 };
        match self {
            Self::Middle => middle,
            Self::MovingOut => State { x: 0.6, x_velocity: 0.3, y: -0.4, y_velocity: 0.1 },
            Self::Pushed => State { x: -0.5, x_velocity: 0.1, y: -1.5, y_velocity: 0.1 },
            Self::Outside => State { x: 1.0 + 1e-9, y: 0.0, ..middle },
        }
    }
}

/// A run, and what is extreme about it.
#[derive(Debug, Clone, Serialize)]
pub struct Entry {
    /// Numbers that are not those of Table 1.
    pub varied: Vec<(Varied, f64)>,
    /// Where it starts.
    pub start: Start,
    /// The system.
    #[serde(skip)]
    pub system: System,
    /// Excitation periods.
    pub periods: u64,
    /// Impacts after which it is given up.
    #[serde(skip)]
    pub impact_limit: u64,
}

const ONE: [(Varied, &[f64]); 7] = [
    (Varied::Restitution, &[0.0, 1e-9, 0.05, 0.999_999, 1.0]),
    (Varied::MassRatio, &[1e-9, 1e-6, 1e-3, 0.1, 0.9]),
    (Varied::Damping, &[0.0, 1e-3, 10.0, 100.0, 1e3]),
    (Varied::Forcing, &[1e-8, 1e-4, 1.0, 1e2, 1e4, 1e6, 1e8]),
    (Varied::Frequency, &[1e-3, 0.1, 1.0, 10.0, 1e3]),
    // From a degree of Table 1 to more than its walls can throw the absorber against.
    (Varied::GravityAlong, &[1e-9, 0.01, 0.5, 10.0]),
    // Friction beyond that holds the absorber for good: nothing is left to compare.
    (Varied::Friction, &[1e-9, 0.01, 0.3]),
];
/// Excitation periods of long runs.
const LONG: [u64; 2] = [10_000, 1_000_000];
/// In mm: small enough for chattering and sustained contact.
const SMALL: f64 = 0.3;
const CHATTERING: [f64; 6] = [0.0, 0.6, 0.95, 0.99, 0.999_999, 1.0];
const SEVERAL: [&[(Varied, f64)]; 10] = [
    // Both are powers of two: exactly critical damping.
    &[(Varied::Damping, 256.0), (Varied::MassRatio, 1.0 / 128.0)],
    &[(Varied::Frequency, 1.0), (Varied::Damping, 0.0)],
    &[(Varied::MassRatio, 0.9), (Varied::Damping, 1e3)],
    &[(Varied::MassRatio, 0.9), (Varied::Damping, 1e3), (Varied::Frequency, 1e3)],
    &[
        (Varied::MassRatio, 0.9),
        (Varied::Damping, 1e3),
        (Varied::Frequency, 1e-3),
        (Varied::Forcing, 1e8),
    ],
    &[(Varied::MassRatio, 1e-9), (Varied::Forcing, 1e8)],
    &[(Varied::Restitution, 0.999_999), (Varied::Forcing, 1e8)],
    &[(Varied::Forcing, 1e307), (Varied::MassRatio, 0.9)],
    &[(Varied::Restitution, 0.0), (Varied::GravityAlong, 0.2), (Varied::Friction, 0.1)],
    &[(Varied::Clearance, 0.3), (Varied::GravityAlong, 0.2), (Varied::Friction, 0.1)],
];
const STARTS: [Start; 3] = [Start::MovingOut, Start::Pushed, Start::Outside];

/// Table 1 at 8 Hz with b = 7.5 mm and F = 0.25 mm, which is inferred, not published; some numbers changed.
pub fn table_1(varied: &[(Varied, f64)]) -> Parameters {
    let mass_ratio = 0.032 / 4.168;
    let natural = (11.47e3_f64 / 4.168).sqrt();
    let forcing = |clearance_mm: f64| 0.25 / mass_ratio / clearance_mm;
    let mut parameters = Parameters {
        mass_ratio,
        damping: 3.02 / (0.032 * natural),
        restitution: 0.6,
        frequency_ratio: 8.0 * TAU / natural,
        forcing_per_clearance: forcing(7.5),
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    };
    for (number, value) in varied {
        match number {
            Varied::Restitution => parameters.restitution = *value,
            Varied::MassRatio => parameters.mass_ratio = *value,
            Varied::Damping => parameters.damping = *value,
            Varied::Forcing => parameters.forcing_per_clearance = *value,
            Varied::Frequency => parameters.frequency_ratio = *value,
            Varied::GravityAlong => parameters.cavity.gravity_along = *value,
            Varied::Friction => parameters.cavity.friction_acceleration = *value,
            Varied::Clearance => parameters.forcing_per_clearance = forcing(*value),
        }
    }
    parameters
}

/// All of them, in the order of the page.
///
/// # Errors
/// [`InvalidParameter`] if the list itself were wrong.
pub fn entries() -> Result<Vec<Entry>, InvalidParameter> {
    let middle = |varied: &[(Varied, f64)]| Entry::new(varied, None, Start::Middle);
    let one = ONE.iter().flat_map(|(number, values)| values.iter().map(|value| (*number, *value)));
    let one = one.map(|change| middle(&[change]));
    let long = LONG.into_iter().map(|periods| Entry::new(&[], Some(periods), Start::Middle));
    let chattering = CHATTERING.into_iter().map(|restitution| {
        middle(&[(Varied::Clearance, SMALL), (Varied::Restitution, restitution)])
    });
    let several = SEVERAL.into_iter().map(middle);
    let starts = STARTS.into_iter().map(|start| Entry::new(&[], None, start));
    one.chain(long).chain(chattering).chain(several).chain(starts).collect()
}

impl Entry {
    fn new(
        varied: &[(Varied, f64)],
        periods: Option<u64>,
        start: Start,
    ) -> Result<Self, InvalidParameter> {
        let system = System::new(table_1(varied))?;
        let [shortest, longest] =
            [SHORTEST, LONGEST].map(|time| (time / system.period()).ceil() as u64);
        let periods = periods.unwrap_or(PERIODS.max(shortest).min(longest));
        let more = if varied.is_empty() { 10 * periods } else { 0 };
        let impact_limit = IMPACT_LIMIT.max(more);
        Ok(Self { varied: varied.to_vec(), start, system, periods, impact_limit })
    }
}
