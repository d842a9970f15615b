//! What ending a chattering sequence early costs and spares: contact, release and losses against the
//! reference, which follows every sequence to its end.

use super::list::{IMPACT_LIMIT, table_1};
use super::measure::MeasureError;
use crate::reference::{Event, Reference};
use crate::simulation::{
    Absorber, ContactTolerance, Impact, Observer, Segment, Simulation, Statistics,
};
use crate::system::{Parameters, State, System};

/// Impacts of one chattering sequence that the reference follows at most.
const LONGEST_SEQUENCE: u32 = 5_000;

/// The end of a sustained contact, and what led to it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Release {
    tau: f64,
    x: f64,
    /// Energy lost up to there.
    loss: f64,
}

/// Keeps the first releases.
struct Releases {
    wanted: usize,
    found: Vec<Release>,
    loss: f64,
    carried: bool,
}

impl Observer for Releases {
    fn segment(&mut self, segment: &Segment) {
        let carried = matches!(segment.absorber, Absorber::Carried(_));
        if self.carried && !carried && self.found.len() < self.wanted {
            let omega = segment.motion.oscillator().frequency;
            let turns = segment.turns as f64 * std::f64::consts::TAU;
            let tau = (turns + segment.phase) / omega;
            self.found.push(Release { tau, x: segment.at(0.0).x, loss: self.loss });
        }
        self.carried = carried;
    }

    fn impact(&mut self, impact: &Impact) {
        self.loss += impact.loss;
    }

    fn sticks(&mut self, loss: f64) {
        self.loss += loss;
    }
}

/// One setting of the tolerance, measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactCost {
    /// The setting.
    pub tolerance: ContactTolerance,
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

/// The releases of a trajectory in multiple precision, and then what each tolerance makes of it.
///
/// # Errors
/// [`MeasureError`].
pub fn contact_costs(
    system: &System,
    start: State,
    releases: usize,
    periods: u64,
    impact_limit: u64,
    tolerances: &[ContactTolerance],
) -> Result<Vec<ContactCost>, MeasureError> {
    let exact = exact_releases(Reference::new(system, start, 0.0)?, releases);
    let measured = tolerances.iter().map(|&tolerance| {
        let mut simulation = Simulation::new(system, start, 0.0)?.with_tolerance(tolerance);
        let mut statistics = Statistics::begin(system, start);
        let mut seen =
            Releases { wanted: exact.len(), found: Vec::new(), loss: 0.0, carried: false };
        simulation.run(periods, impact_limit, &mut (&mut statistics, &mut seen));
        let pairs: Vec<_> = seen.found.iter().zip(&exact).collect();
        let largest = |difference: fn(&Release, &Release) -> f64| {
            pairs.iter().map(|(a, b)| difference(a, b).abs()).fold(0.0, f64::max)
        };
        let done = simulation.periods().max(1) as f64;
        Ok(ContactCost {
            tolerance,
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
fn exact_releases(mut reference: Reference, wanted: usize) -> Vec<Release> {
    let mut found = Vec::new();
    let (mut total, mut time) = (0.0, 0.0);
    for _ in 0..LONGEST_SEQUENCE {
        if found.len() == wanted {
            break;
        }
        match reference.next(time + 100.0) {
            Some(Event::Impact { tau, loss, .. }) => {
                total += loss;
                time = tau;
            }
            Some(Event::Release { tau, x }) => {
                found.push(Release { tau, x, loss: total });
                time = tau;
            }
            None => break,
        }
    }
    found
}

/// A system in which the absorber rests on its walls, and what each tolerance does to it.
#[derive(Debug, Clone)]
pub struct ContactTable {
    /// The system, as Markdown.
    pub words: &'static str,
    /// By tolerance.
    pub costs: Vec<ContactCost>,
}

/// Periods of the whole run that a tolerance is measured over.
const PERIODS: u64 = 200;
/// Releases compared with the reference.
const RELEASES: usize = 6;
/// Where the runs start.
const START: State = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };

/// The settings that are compared: the excursion at the default drift, then the drift at the default
/// excursion and at a coarse one.
pub fn tolerances() -> Vec<ContactTolerance> {
    let usual = ContactTolerance::default();
    let excursions = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14];
    let drifts = [(1e-12, 0.1), (1e-12, 1e-3), (1e-6, 0.1), (1e-6, 1e-3)];
    let by_excursion = excursions.map(|excursion| ContactTolerance { excursion, ..usual });
    let by_drift = drifts.map(|(excursion, drift)| ContactTolerance { excursion, drift });
    by_excursion.into_iter().chain(by_drift).collect()
}

/// Every tolerance on systems with complete chattering: a light absorber, a heavy one, and a slow
/// decay.
///
/// # Errors
/// [`MeasureError`].
pub fn tables() -> Result<Vec<ContactTable>, MeasureError> {
    let light = table_1(0.3);
    let heavy = Parameters { mass_ratio: 0.9, ..table_1(7.5) };
    let slow = Parameters { restitution: 0.9, ..table_1(0.01) };
    let systems = [
        ("Table 1 at $b = 0.3\\,\\mathrm{mm}$.", light),
        ("A heavy absorber: $\\varepsilon = 0.9$, $\\gamma = 4.34$.", heavy),
        ("Slow decay: $r = 0.9$ at $b = 0.01\\,\\mathrm{mm}$.", slow),
    ];
    let tables = systems.into_iter().map(|(words, parameters)| {
        let system = System::new(parameters)?;
        let costs = contact_costs(&system, START, RELEASES, PERIODS, IMPACT_LIMIT, &tolerances())?;
        Ok(ContactTable { words, costs })
    });
    tables.collect()
}
