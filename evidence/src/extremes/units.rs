//! One design in clearances from a nanometre to a kilometre: the dimensionless numbers must not know
//! the unit.

use std::f64::consts::TAU;

use serde::Serialize;

use super::ExtremesError;
use super::list::{IMPACT_LIMIT, Start};
use super::measure::FOLLOWED;
use vinesink::case::Case;
use vinesink::simulation::{ImpactLog, Simulation};

/// Clearance and amplitude as a case says them, and the clearance in metres.
const LENGTHS: [(&str, &str, f64); 5] = [
    ("1e-6 mm", "3.33e-8 mm", 1e-9),
    ("1 um", "0.0333 um", 1e-6),
    ("1 mm", "0.0333 mm", 1e-3),
    ("1 m", "0.0333 m", 1.0),
    ("1000 m", "33.3 m", 1e3),
];
/// The place of what the others are compared with.
const COMMON: usize = 2;
/// Roundings in the way from a length with its unit to a dimensionless number.
const ROUNDINGS: f64 = 8.0;

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
/// [`ExtremesError`] if the list itself were wrong.
pub fn unit_checks() -> Result<Vec<UnitCheck>, ExtremesError> {
    let samples: Vec<UnitRun> = LENGTHS
        .iter()
        .map(|(b, amplitude, _)| UnitRun::of(b, amplitude))
        .collect::<Result<_, _>>()?;
    let common = &samples[COMMON];
    let largest = |a: &[f64], b: &[f64], difference: fn(f64, f64) -> f64| {
        a.iter().zip(b).map(|(a, b)| difference(*a, *b).abs()).fold(0.0, f64::max)
    };
    let rounding = ROUNDINGS * f64::EPSILON;
    // The motion is a stable one: it does not amplify what the numbers differ by, but its clock rounds
    // as well.
    let clock = rounding * common.times.last().copied().unwrap_or(0.0);
    let check = |((clearance, _, size), sample): (&(&'static str, _, f64), &UnitRun)| {
        let difference = largest(&sample.numbers, &common.numbers, |a, b| a / b - 1.0);
        let times = largest(&sample.times, &common.times, |a, b| a - b);
        let units = size / LENGTHS[COMMON].2;
        let scale = (sample.largest / common.largest / units - 1.0).abs();
        let small = difference <= rounding && scale <= rounding && times <= clock;
        UnitCheck {
            clearance,
            difference,
            times,
            impacts: sample.times.len().min(common.times.len()),
            scale,
            holds: small && sample.times.len() == common.times.len(),
        }
    };
    Ok(LENGTHS.iter().zip(&samples).map(check).collect())
}

/// The design in one unit, simulated.
struct UnitRun {
    /// Its dimensionless numbers.
    numbers: [f64; 5],
    /// Of impacts.
    times: Vec<f64>,
    /// Largest displacement at an impact, in metres.
    largest: f64,
}

impl UnitRun {
    fn of(clearance: &str, amplitude: &str) -> Result<Self, ExtremesError> {
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
        let p = system.parameters();
        Ok(Self {
            numbers: [
                p.mass_ratio,
                p.damping,
                p.restitution,
                p.frequency_ratio,
                p.forcing_per_clearance,
            ],
            times: log.impacts.iter().map(|impact| impact.tau).collect(),
            largest: case.units().length(largest),
        })
    }
}
