//! How long work takes, about, before it is begun: what is flown, and seconds for each of it.

use std::fmt;
use std::time::Instant;

use vinesink::answer::Asked;
use vinesink::answer::trajectory::flown_while;
use vinesink::case::{Case, Objective};
use vinesink::excitation::Scene;
use vinesink::flights::{seconds_of, with_closer};
use vinesink::motions::{Effort, SettlingTime, longest_window};
use vinesink::optimize::Task;
use vinesink::study::deviations::{self, Deviation};
use vinesink::study::fidelity;
use vinesink::sweep::{GridPoint, Plan};
use vinesink::system::{State, System};
use vinesink::transient::{DecayStudy, RELEASES, RecordStudy, SweepStudy, looked_at};

/// Seconds of which it does not matter how many more they are.
const HOPELESS: f64 = 1e6;
/// Seconds for one excitation period, or for one oscillation of the structure where the period has several, of
/// a trajectory alone: 1.3 us at frequency ratios of 0.001 to 0.1 and 1.6 us at 1 with four impacts a period,
/// measured with `simulate --initial --periods` in the release profile on one core of an ARM server.
const ALONE: f64 = 1.5e-6;
/// The same side by side: 138 s for `check` of a band of 47 places, 8 starts and 400 periods of 1000 oscillations;
/// near resonance it is a third.
const SIDE_BY_SIDE: f64 = 0.9e-6;

/// Places of a band that are simulated, about: even ones, and closer ones around the worst.
const PLACES: u32 = 80;
/// Designs that `optimize` holds against the whole band, about: at most 24, and screening takes as long as some more.
const DESIGNS: u64 = 40;
/// What trajectories are counted by.
const PERIODS: &str = "periods";

/// Seconds for the exact 1:1 orbits of a system, of an ideal cavity and of one that is not: measured on one core of an x86
/// server with `optimize` of `cases/li2016-band.toml` for the stable share, as it is and with tilt and friction.
const SOLVED: [f64; 2] = [5e-6, 30e-6];
/// Places of a band at which orbits are solved to find where one attracts, about.
const SOLVED_PLACES: f64 = 190.0;
/// Designs whose bands are looked at thus, about: as written, and for each combination of deviations.
const LOOKED_AT: [u64; 2] = [700, 130];
/// Windows in which starts that never repeat are measured together, and their motion in full, each doubled four times
/// while it is open what they are.
const MEASURED: u64 = 62;
/// Windows that they fly before, by the number of starts, at least: a chaotic transient may end.
const PATIENCE: [u64; 2] = [20, 32];
/// Periods in which a regime is recognised, at least once for each start.
const RECOGNITION: u64 = 200;
/// Periods of an analysis: 350 tell area Z1 from Z2 where closed form cannot, and the exact orbits with their
/// boundaries take as long as 450, 7 s at a frequency ratio of 1e-4.
const ANALYSIS: u64 = 800;
/// Trajectories and periods of a figure that the case asks for: a diagram has 120 values, up and down.
const FIGURE: [u64; 2] = [240, 350];
/// Periods of the best answer of a trade-off.
pub const BEST_ANSWER: u64 = 100_000;
/// Points of a sweep that may take as long as other commands: how many there are is what the case asks for, and
/// what `--dry-run` says.
const POINTS: u64 = 60;

/// Trajectories of one kind that a command simulates, as far as they are known before.
#[derive(Debug)]
pub struct Work {
    /// How many, as factors with their names.
    trajectories: Vec<(u64, &'static str)>,
    /// Excitation periods of each, or what is done of another kind.
    periods: f64,
    of: &'static str,
    /// Oscillations of the structure in a period, or 1.
    oscillations: f64,
    /// Seconds for each of them.
    each: f64,
}

impl Work {
    /// All that is done to answer for a case, by the layers that a plan needs, or all of them.
    pub fn of(case: &Case, asked: Asked, plan: Option<&fidelity::LayerPlan>) -> Vec<Self> {
        let simulates = plan.is_none_or(fidelity::LayerPlan::needs_simulation);
        if case.design.scene() != Scene::Steady {
            let flown = Self::transient(case).filter(|_| asked != Asked::Analysis);
            return flown.into_iter().collect();
        }
        let mut work = Vec::new();
        if asked == Asked::Analysis {
            work.push(Self::trajectory(case, ANALYSIS));
        }
        if simulates {
            work.extend(Self::motions(case, &case.effort()));
        }
        if simulates && asked == Asked::Report {
            work.push(Self::figures(case));
            work.extend(case.report.deviations.then(|| Self::deviations(case)));
        }
        let along = match asked {
            Asked::Criteria => !case.criteria.is_empty(),
            Asked::Decision => !case.criteria.is_empty() || case.band.is_some(),
            Asked::Report => !case.criteria.is_empty() || (simulates && case.band.is_some()),
            _ => false,
        };
        if along {
            work.extend(Self::criteria(case));
        }
        work
    }

    /// Looking for all that a case can do.
    pub fn search(case: &Case, effort: &Effort) -> Vec<Self> {
        match Self::transient(case) {
            Some(flown) => vec![flown],
            None => Self::motions(case, effort).into(),
        }
    }

    /// Looking for all long-term motions of a case.
    pub fn motions(case: &Case, effort: &Effort) -> [Self; 2] {
        let each_start = effort.left_out(&case.system()) + effort.periods.min(RECOGNITION);
        let (starts, [least, most]) = (u64::from(effort.starts), PATIENCE);
        let windows = (starts * starts.min(most) / 10).max(least) + MEASURED;
        let longest = effort.periods.saturating_mul(windows);
        [
            Self::alone(case, vec![(effort.starts.into(), "starts")], each_start),
            Self::alone(case, vec![(1, "motion that may not repeat")], longest),
        ]
    }

    /// One trajectory.
    pub fn trajectory(case: &Case, periods: u64) -> Self {
        Self::alone(case, vec![(1, "trajectory")], periods)
    }

    /// What a case needs that is not driven steadily; none for another. A sweep is flown the other way as well, and at a
    /// quarter to four times the rate, eight times as long as one; some records for other structures.
    pub fn transient(case: &Case) -> Option<Self> {
        let Flown { records, periods } = Flown::of(case)?;
        let even = case.absorber_places()?;
        let flights = match case.design.scene() {
            Scene::Sweep => with_closer(even) + 8 * even.min(SweepStudy::STARTS_BESIDE.into()),
            Scene::Record if records == 1 => with_closer(even) + RecordStudy::FLIGHTS_OF_SPECTRUM,
            Scene::Record => even + RecordStudy::FLIGHTS_OF_SPECTRUM / records as u64,
            _ => with_closer(even),
        };
        Some(Self::flights(case, vec![(flights, "flights")], periods))
    }

    /// The search for the best clearance of such a case, and the study of the one that is found.
    pub fn clearances(case: &Case) -> Vec<Self> {
        let Some(Flown { records, periods }) = Flown::of(case) else { return Vec::new() };
        let releases = case.optimize.releases.map_or(1, |_| RELEASES.into());
        let each = looked_at(records).map(|[clearances, starts]| {
            let factors = vec![
                (clearances.into(), "clearances"),
                (starts.into(), "starts"),
                (releases, "releases"),
            ];
            Self::flights(case, factors, periods)
        });
        each.into_iter().chain(Self::transient(case)).collect()
    }

    /// A case's criteria, over its band if it has one.
    pub fn criteria(case: &Case) -> [Self; 2] {
        [Self::band(case, Vec::new()), Self::slowest(case)]
    }

    /// Cases beside a case, looked at less thoroughly. A release is followed to its level alone, an eighth of what the
    /// structure takes without an absorber; under a record dampers are designed as well.
    pub fn variants(case: &Case, variants: u64) -> Vec<Self> {
        let Some(Flown { records, periods }) = Flown::of(case) else {
            return vec![Self::band(case, vec![(variants / 4, "variants")])];
        };
        let places = case.absorber_places().unwrap_or_default();
        let (variants, places) = match case.design.scene() {
            Scene::Release => (variants / 8, with_closer(places)),
            Scene::Record => (4 * variants, places.min(16)),
            _ => (variants, places.min(16)),
        };
        let factors = vec![(variants, "variants"), (places * records as u64, "flights")];
        vec![Self::flights(case, factors, periods)]
    }

    /// What lies a fiftieth beside a design: at most two steps of two numbers and six of the natural frequency, and what fails
    /// once more in full.
    pub fn edges(case: &Case) -> Vec<Self> {
        Self::variants(case, 16)
    }

    /// The motions that may not repeat where the excitation of the band is slowest.
    fn slowest(case: &Case) -> Self {
        let (band, effort) = (case.range(), case.effort());
        let system = band.places(2).find_map(|at| band.system(at).ok()).unwrap_or(case.system());
        let periods = longest_window(&system, effort.periods);
        let factors = vec![(PATIENCE[0] + MEASURED, "windows"), (1, "place")];
        let oscillations = oscillations(&system);
        Self {
            trajectories: factors,
            periods: periods as f64,
            of: PERIODS,
            oscillations,
            each: ALONE,
        }
    }

    /// The search for the best design.
    pub fn designs(task: &Task) -> Vec<Self> {
        let mut work = vec![Self::band(&task.case, vec![(DESIGNS, "designs")])];
        if matches!(task.objective, Objective::StableShare | Objective::Margin) {
            let deviations = match task.case.uncertainty.is_any() {
                true => task.deviations().len() as u64,
                false => 0,
            };
            let count = LOOKED_AT[0] + LOOKED_AT[1] * deviations;
            work.push(Self {
                trajectories: vec![(count, "designs")],
                periods: SOLVED_PLACES,
                of: "exact solutions",
                oscillations: 1.0,
                each: SOLVED[usize::from(!task.case.design.has_ideal_cavity())],
            });
        }
        work
    }

    /// The same motions in rigs that deviate.
    pub fn deviations(case: &Case) -> Self {
        let rigs = (Deviation::ALL.len() as u64, "rigs that deviate");
        let starts = (u64::from(deviations::STARTS) + 1, "starts");
        Self::side_by_side(&[case.system()], vec![rigs, starts], case.effort().periods)
    }

    /// The figures that a case asks for.
    pub fn figures(case: &Case) -> Self {
        let [trajectories, periods] = FIGURE;
        let figures = case.report.figures.len() as u64;
        Self::alone(case, vec![(figures, "figures"), (trajectories, "values")], periods)
    }

    /// Some points of a sweep.
    pub fn points(plan: &Plan) -> Self {
        let count = POINTS.min(plan.points());
        let points = (0..count).map(|k| plan.point(plan.points() / count * k));
        let starts = plan.settings.starts;
        let counts = vec![(count, "points (of each sixty)"), (starts.into(), "starts")];
        let points: Vec<GridPoint> = points.collect();
        let seconds = points.iter().map(|point| plan.seconds(point)).sum::<Option<f64>>();
        if let Some(seconds) = seconds {
            // What takes longer than a flight, or is done but once, is told as flights.
            let periods = seconds / (count * u64::from(starts)) as f64 / ALONE;
            let of = PERIODS;
            return Self { trajectories: counts, periods, of, oscillations: 1.0, each: ALONE };
        }
        let systems: Vec<System> = points.iter().filter_map(|point| point.system).collect();
        Self::side_by_side(&systems, counts, plan.settings.periods)
    }

    /// Of a structure that is not driven steadily.
    fn flights(case: &Case, trajectories: Vec<(u64, &'static str)>, periods: u64) -> Self {
        let each = seconds_of(case.design.scene());
        Self { trajectories, periods: periods as f64, of: PERIODS, oscillations: 1.0, each }
    }

    fn alone(case: &Case, trajectories: Vec<(u64, &'static str)>, periods: u64) -> Self {
        let oscillations = oscillations(&case.system());
        Self { trajectories, periods: periods as f64, of: PERIODS, oscillations, each: ALONE }
    }

    fn band(case: &Case, mut trajectories: Vec<(u64, &'static str)>) -> Self {
        let (band, effort) = (case.range(), case.effort());
        let places = if band.is_point() { 1 } else { PLACES };
        let systems = band.places(places).filter_map(|at| band.system(at).ok());
        let systems: Vec<System> = systems.take(places as usize).collect();
        trajectories.push((systems.len() as u64, "places"));
        trajectories.push((effort.band.starts.into(), "starts"));
        Self::side_by_side(&systems, trajectories, effort.periods.min(2 * RECOGNITION))
    }

    /// Trajectories of which as many are of each system; periods and oscillations are averages.
    fn side_by_side(
        systems: &[System],
        trajectories: Vec<(u64, &'static str)>,
        measured: u64,
    ) -> Self {
        let count = systems.len().max(1) as f64;
        let mean = |all: &mut dyn Iterator<Item = f64>| all.sum::<f64>() / count;
        let with = |periods: f64, oscillations: f64| {
            let trajectories = trajectories.clone();
            Self { trajectories, periods, of: PERIODS, oscillations, each: SIDE_BY_SIDE }
        };
        // To tell when transients fade takes long itself where the excitation is very slow.
        let least = with(measured.max(1) as f64, mean(&mut systems.iter().map(oscillations)));
        if least.seconds() > HOPELESS {
            return least;
        }
        let periods = |system: &System| SettlingTime::of(system).periods.saturating_add(measured);
        let all: Vec<f64> = systems.iter().map(|system| periods(system) as f64).collect();
        let total = mean(&mut all.iter().zip(systems).map(|(all, one)| all * oscillations(one)));
        let periods = mean(&mut all.into_iter()).max(1.0);
        with(periods, total / periods)
    }

    /// The same for one of the first of its trajectories' factors, such as a point of a sweep.
    pub fn seconds_of_each(&self) -> f64 {
        let count = self.trajectories.first().map_or(1, |(count, _)| *count);
        self.seconds() / count.max(1) as f64
    }

    /// About how many seconds it takes.
    pub fn seconds(&self) -> f64 {
        let trajectories = self.trajectories.iter().map(|(count, _)| *count as f64);
        trajectories.product::<f64>() * self.periods * self.oscillations * self.each
    }
}

/// What is flown from one place of the absorber.
struct Flown {
    /// Records that drive a case; 0 where none does.
    records: usize,
    /// Periods of a sweep, pieces of all records, oscillations on the way to rest.
    periods: u64,
}

impl Flown {
    fn of(case: &Case) -> Option<Self> {
        if let Some(periods) = DecayStudy::oscillations(case) {
            return Some(Self { records: 0, periods });
        }
        if let Some(sweep) = case.design.sine_sweep() {
            return Some(Self { records: 0, periods: sweep.count() });
        }
        let records = case.recording.as_ref()?.records();
        let periods = records.iter().map(|record| record.count(&case.units())).sum();
        Some(Self { records: records.len().max(1), periods })
    }
}

/// Oscillations of the structure in an excitation period, or 1 where it has less.
fn oscillations(system: &System) -> f64 {
    (1.0 / system.frequency_ratio()).max(1.0)
}

fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

impl fmt::Display for Work {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counts = self.trajectories.iter().map(|(count, of)| format!("{count} {of} x "));
        write!(f, "{}{:.0} {}", counts.collect::<String>(), self.periods, self.of)?;
        match self.oscillations {
            few if few < 1.5 => Ok(()),
            many => write!(f, " of about {} oscillations each", two_digits(many)),
        }
    }
}

/// Seconds in which a trajectory is flown to see how long it takes, and impacts after which it is looked at again.
const LOOK: f64 = 0.05;
const IMPACTS: u64 = 1000;
/// Where it starts: it meets both walls, whatever drives it.
const ACROSS: State = State { x: 0.0, x_velocity: 0.0, y: 0.0, y_velocity: 1.0 };

/// How much longer a period takes than [`ALONE`] says, with its measurement; 1 at least.
pub(super) fn slowness(system: &System) -> f64 {
    let begin = Instant::now();
    let seconds = || begin.elapsed().as_secs_f64();
    let periods = flown_while(system, ACROSS, IMPACTS, || seconds() < LOOK).max(1) as f64;
    (seconds() / (periods * oscillations(system) * ALONE)).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::super::{ORDINARY, seconds};
    use super::*;
    use std::fs;
    use std::path::Path;

    fn case(text: &str) -> Case {
        Case::parse("case.toml", text).expect("a case")
    }

    fn all(case: &Case) -> [f64; 4] {
        let motions = seconds(&Work::motions(case, &case.effort()));
        let report = motions + seconds(&Work::criteria(case)) + Work::figures(case).seconds();
        let task = Task::of(case, None).map_or_else(|_| Vec::new(), |task| Work::designs(&task));
        let designs = seconds(&task).max(seconds(&Work::clearances(case)));
        let tradeoff = motions + Work::trajectory(case, BEST_ANSWER).seconds();
        let sweep = Plan::of(case).map_or(0.0, |plan| Work::points(&plan).seconds());
        [report, tradeoff, designs, sweep]
    }

    /// Nothing that is shipped comes within a factor of three.
    #[test]
    fn shipped_cases_are_ordinary() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
        let mut seen = 0;
        for entry in fs::read_dir(folder).expect("the folder of cases") {
            let path = entry.expect("an entry").path();
            if path.extension().is_none_or(|extension| extension != "toml") {
                continue;
            }
            let case = case(&fs::read_to_string(&path).expect("a text"));
            let seconds = all(&case);
            assert!(seconds.iter().all(|one| *one < ORDINARY / 3.0), "{path:?}: {seconds:?}");
            seen += 1;
        }
        assert!(seen >= 14, "{seen}");
    }

    const REDUCED: &str = "title = \"t\"\nsource = \"s\"\n[reduced]\nmass_ratio = 0.015\n\
        damping = 0.5\nrestitution = 0.6\nclearance = 1.0\nforcing = 4.0\n";

    /// By hand: 8 starts of 3 periods, which are 3000 oscillations, and 200, and a motion of 20 and 62 windows of 1000;
    /// 1000 oscillations each.
    #[test]
    fn work_is_counted() {
        let settings = "frequency_ratio = 0.001\n[simulation]\nstarts = 8\n";
        let case = case(&format!("{REDUCED}{settings}"));
        let work = Work::motions(&case, &case.effort());
        let oscillations = (8.0 * 203.0 + 82_000.0) * 1000.0;
        assert!((seconds(&work) / (oscillations * ALONE) - 1.0).abs() < 1e-12);
        assert_eq!(
            work[1].to_string(),
            "1 motion that may not repeat x 82000 periods of about 1000 oscillations each"
        );
        // Above resonance it is the excitation that has to be followed.
        let fast = self::case(&format!("{REDUCED}frequency_ratio = 1000.0\n"));
        assert!(
            (Work::trajectory(&fast, ANALYSIS).seconds() / (800.0 * ALONE) - 1.0).abs() < 1e-12
        );
    }

    /// By hand: 700 designs as written and 130 under each of 15 errors of the clearance, 190 systems each, 30 us a system.
    #[test]
    fn exact_orbits_are_counted_where_designs_are_chosen_by_them() {
        let rest = "frequency_ratio = 0.99\nfriction_acceleration = 0.01\n[uncertainty]\nclearance = 0.1\n";
        let case = case(&format!("{REDUCED}{rest}"));
        let task = |objective| Task::of(&case, Some(objective)).expect("driven");
        let work = Work::designs(&task(Objective::StableShare));
        assert!((work[1].seconds() / (2650.0 * 190.0 * 30e-6) - 1.0).abs() < 1e-12);
        assert_eq!(work[1].to_string(), "2650 designs x 190 exact solutions");
        assert_eq!(Work::designs(&task(Objective::WorstAmplitude)).len(), 1);
    }
}
