//! One design in clearances from a nanometre to a kilometre: the dimensionless numbers must not know
//! the unit.

use std::f64::consts::TAU;

use serde::Serialize;

use super::list::{IMPACT_LIMIT, Start};
use super::measure::FOLLOWED;
use crate::case::{Case, CaseError};
use crate::simulation::{ImpactLog, Simulation, StartError};
use crate::system::{Parameters, System};

/// Clearance and amplitude as a case says them, and the clearance in metres.
const LENGTHS: [(&str, &str, f64); 5] = [
    ("1e-6 mm", "3.33e-8 mm", 1e-9),
    ("1 um", "0.0333 um", 1e-6),
    COMMON,
    ("1 m", "0.0333 m", 1.0),
    ("1000 m", "33.3 m", 1e3),
];
/// What the others are compared with.
const COMMON: (&str, &str, f64) = ("1 mm", "0.0333 mm", 1e-3);
/// Roundings in the way from a length with its unit to a dimensionless number.
const ROUNDINGS: f64 = 8.0;

/// Why the units cannot be compared.
#[derive(Debug, thiserror::Error)]
pub enum UnitError {
    /// The case is not one.
    #[error(transparent)]
    Case(#[from] Box<CaseError>),
    /// The start is impossible.
    #[error(transparent)]
    Start(#[from] StartError),
}

/// The design in one unit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct UnitCheck {
    /// The clearance with its unit.
    pub clearance: &'static str,
    /// Largest relative difference of the dimensionless numbers from those in millimetres.
    pub difference: f64,
    /// Largest difference of impact times from those in millimetres, in fast time.
    pub times: f64,
    /// Impacts compared.
    pub impacts: usize,
    /// Peak displacement at an impact in metres, over that in millimetres and over the ratio of the
    /// units, less 1.
    pub scale: f64,
    /// Whether all of this is rounding.
    pub holds: bool,
}

/// Table 1 at 8 Hz with F = b/30, in every unit.
///
/// # Errors
/// [`UnitError`].
pub fn unit_checks() -> Result<Vec<UnitCheck>, UnitError> {
    let common = Sample::of(COMMON.0, COMMON.1)?;
    LENGTHS
        .into_iter()
        .map(|(clearance, amplitude, size)| {
            let sample = Sample::of(clearance, amplitude)?;
            let difference = numbers(&sample.system)
                .into_iter()
                .zip(numbers(&common.system))
                .map(|(a, b)| (a / b - 1.0).abs())
                .fold(0.0, f64::max);
            let pairs = sample.times.iter().zip(&common.times);
            let times = pairs.clone().map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let scale = (sample.largest / common.largest / (size / COMMON.2) - 1.0).abs();
            let rounding = ROUNDINGS * f64::EPSILON;
            // The motion is a stable one: it does not amplify what the numbers differ by, but its
            // clock rounds as well.
            let clock = rounding * common.times.last().copied().unwrap_or(0.0);
            let same = sample.times.len() == common.times.len();
            let small = difference <= rounding && scale <= rounding && times <= clock;
            Ok(UnitCheck {
                clearance,
                difference,
                times,
                impacts: pairs.len(),
                scale,
                holds: same && small,
            })
        })
        .collect()
}

fn numbers(system: &System) -> [f64; 5] {
    let Parameters {
        mass_ratio, damping, restitution, frequency_ratio, forcing_per_clearance, ..
    } = system.parameters();
    [mass_ratio, damping, restitution, frequency_ratio, forcing_per_clearance]
}

struct Sample {
    system: System,
    times: Vec<f64>,
    /// Largest displacement at an impact, in metres.
    largest: f64,
}

impl Sample {
    fn of(clearance: &str, amplitude: &str) -> Result<Self, UnitError> {
        let text = format!(
            "title = \"one design\"\nsource = \"Table 1\"\n\
             [oscillator]\nmass = \"4.168 kg\"\nstiffness = \"11.47 kN/m\"\ndamping = \"3.02 N s/m\"\n\
             [absorber]\nmass = \"32 g\"\nclearance = \"{clearance}\"\nrestitution = 0.6\n\
             [excitation]\nkind = \"base-displacement\"\namplitude = \"{amplitude}\"\n\
             frequency = \"8 Hz\"\n"
        );
        let case = Case::parse(clearance, &text).map_err(Box::new)?;
        let system = case.system();
        let mut simulation = Simulation::new(&system, Start::Middle.state(), 0.0)?;
        let mut log = ImpactLog::default();
        let periods = (FOLLOWED as f64 * TAU / system.period()).ceil() as u64;
        simulation.run(periods, IMPACT_LIMIT, &mut log);
        let largest = log.impacts.iter().map(|impact| impact.x.abs()).fold(0.0, f64::max);
        Ok(Self {
            system,
            times: log.impacts.iter().map(|impact| impact.tau).collect(),
            largest: case.scales().length(largest),
        })
    }
}
