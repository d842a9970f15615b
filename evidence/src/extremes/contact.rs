//! What ending a chattering sequence early costs and spares: contact, release and losses against the
//! reference, which follows every sequence to its end.

use serde::Serialize;

use super::ExtremesError;
use super::list::{IMPACT_LIMIT, Varied, table_1};
use super::measure::{ContactEnd, LONGEST_SEQUENCE, Seen, Witness};
use crate::reference::{Event, Reference};
use vinesink::simulation::{ContactTolerance, Measurement, Simulation, StartError};
use vinesink::system::{State, System};

/// One setting of the tolerance, measured.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ContactCost {
    /// Largest excursion of a sequence that is ended, over the clearance.
    pub excursion: f64,
    /// Relative change of the contact acceleration allowed meanwhile.
    pub drift: f64,
    /// Releases compared.
    pub releases: usize,
    /// Largest error of a release's time, in fast time.
    pub time: f64,
    /// Largest error of the displacement there, over the clearance.
    pub displacement: f64,
    /// Relative error of the energy lost in impacts up to the last release.
    pub loss: f64,
    /// Root mean square displacement over the whole run, over the clearance.
    pub rms: f64,
    /// Impacts per period over the whole run.
    pub impacts_per_period: f64,
    /// Evaluations of the closed form per period.
    pub evaluations_per_period: f64,
}

/// A system in which the absorber rests on its walls, and what each tolerance does to it.
#[derive(Debug, Clone, Serialize)]
pub struct ContactTable {
    /// Numbers that are not those of Table 1.
    pub varied: Vec<(Varied, f64)>,
    /// By tolerance.
    pub costs: Vec<ContactCost>,
}

/// Periods of the whole run that a tolerance is measured over.
const PERIODS: u64 = 200;
/// Releases compared with the reference.
const RELEASES: usize = 6;
/// Where the runs start.
const START: State = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };
/// Excursion and drift: excursions at the default drift, then drifts at the default excursion and at a
/// coarse one.
const TOLERANCES: [[f64; 2]; 10] = [
    [1e-4, 0.01],
    [1e-6, 0.01],
    [1e-8, 0.01],
    [1e-10, 0.01],
    [1e-12, 0.01],
    [1e-14, 0.01],
    [1e-12, 0.1],
    [1e-12, 1e-3],
    [1e-6, 0.1],
    [1e-6, 1e-3],
];
/// Systems with complete chattering: a light absorber, a heavy one, and a slow decay.
const SYSTEMS: [&[(Varied, f64)]; 3] = [
    &[(Varied::Clearance, 0.3)],
    &[(Varied::MassRatio, 0.9)],
    &[(Varied::Restitution, 0.9), (Varied::Clearance, 0.01)],
];

/// The releases of a trajectory in multiple precision, and then what each tolerance makes of it.
///
/// # Errors
/// [`StartError`] where the system does not let the absorber start as it does.
pub fn contact_costs(system: &System, periods: u64) -> Result<Vec<ContactCost>, StartError> {
    let exact = exact_releases(Reference::new(system, START, 0.0));
    let measured = TOLERANCES.into_iter().map(|[excursion, drift]| {
        let tolerance = ContactTolerance { excursion, drift };
        let mut simulation = Simulation::new(system, START, 0.0)?.with_tolerance(tolerance);
        let mut measurement = Measurement::begin(system, START);
        let mut witness = Witness::of(usize::MAX);
        simulation.run(periods, IMPACT_LIMIT, &mut (&mut measurement, &mut witness));
        let statistics = measurement.statistics();
        let seen = witness.seen.iter().filter_map(|event| match event {
            Seen::ContactEnd(release) => Some(release),
            _ => None,
        });
        let pairs: Vec<(&ContactEnd, &ContactEnd)> = seen.zip(&exact).collect();
        let largest = |difference: fn(&ContactEnd, &ContactEnd) -> f64| {
            pairs.iter().map(|(a, b)| difference(a, b).abs()).fold(0.0, f64::max)
        };
        let done = simulation.periods().max(1) as f64;
        Ok(ContactCost {
            excursion,
            drift,
            releases: pairs.len(),
            time: largest(|a, b| a.tau - b.tau),
            displacement: largest(|a, b| a.x - b.x),
            loss: largest(|a, b| a.loss / b.loss - 1.0),
            rms: statistics.rms(),
            impacts_per_period: simulation.impacts() as f64 / done,
            evaluations_per_period: simulation.evaluations() as f64 / done,
        })
    });
    measured.collect()
}

/// The first releases by the reference.
fn exact_releases(mut reference: Reference) -> Vec<ContactEnd> {
    let (mut found, mut lost, mut time) = (Vec::new(), 0.0, 0.0);
    for _ in 0..LONGEST_SEQUENCE {
        match reference.next(time + 100.0) {
            Some(Event::Impact { tau, loss, .. }) => (lost, time) = (lost + loss, tau),
            Some(Event::Release { tau, x }) => {
                found.push(ContactEnd { tau, x, loss: lost });
                time = tau;
            }
            // Without friction there is nothing else.
            Some(Event::Reversal { .. } | Event::Stick { .. }) | None => break,
        }
        if found.len() == RELEASES {
            break;
        }
    }
    found
}

/// Every tolerance on systems with complete chattering.
///
/// # Errors
/// [`ExtremesError`] if the list itself were wrong.
pub fn tables() -> Result<Vec<ContactTable>, ExtremesError> {
    let tables = SYSTEMS.into_iter().map(|varied| {
        let costs = contact_costs(&System::new(table_1(varied))?, PERIODS)?;
        Ok(ContactTable { varied: varied.to_vec(), costs })
    });
    tables.collect()
}
