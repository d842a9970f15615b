//! What is measured of a long-term motion: visits to walls, energy, captures, the order of impacts;
//! and what is made of many of them: basins and diagrams.

use crate::common;
use std::f64::consts::PI;

use vinesink::regimes::basins::{Basins, Cell};
use vinesink::regimes::diagram::{SweepDirection, sweep};
use vinesink::regimes::search::{self, SearchEffort};
use vinesink::regimes::{
    Amplitudes, Attractor, DynamicsKind, Effort, Regime, Window, long_term, share, starts,
};
use vinesink::simulation::{Impact, Measurement, Observer, Side, Simulation, Stop};
use vinesink::system::{Parameter, State, System};

const START: State = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };
const WINDOW: Window = Window { discard: 800, periods: 200, impact_limit: 200_000 };
const EFFORT: Effort = Effort::over(200);

fn reached(system: &System, start: State) -> Attractor {
    Attractor::reach(system, start, &WINDOW).expect("inside the cavity")
}

/// The walls in the order in which they are hit, and where the absorber stuck.
#[derive(Default)]
struct Diary(Vec<Option<Side>>);

impl Observer for Diary {
    fn impact(&mut self, impact: &Impact) {
        self.0.push(Some(impact.side));
    }
    fn sticks(&mut self, _loss: f64) {
        self.0.push(None);
    }
}

impl Diary {
    /// Visits, counted backwards: before a sticking all impacts on its wall belong to one visit.
    fn visits(&self) -> u64 {
        let mut visits = 0;
        let mut sequence = None;
        let mut sticking = false;
        for entry in self.0.iter().rev() {
            match entry {
                None => (sticking, sequence) = (true, None),
                Some(side) if sticking && sequence == Some(*side) => {}
                Some(side) => {
                    sticking &= sequence.is_none();
                    sequence = Some(*side);
                    visits += 1;
                }
            }
        }
        visits
    }
}

#[test]
fn a_chattering_sequence_is_one_visit() {
    for (frequency, clearance) in [(8.0, 0.3), (8.01, 20.0), (8.0, 20.0), (8.5, 27.0), (8.0, 7.5)] {
        let system = common::table_1(frequency, clearance);
        let mut simulation = Simulation::new(&system, START, 0.0).expect("inside the cavity");
        let mut measurement = Measurement::begin(&system, START);
        let mut diary = Diary::default();
        simulation.run(300, 1_000_000, &mut (&mut measurement, &mut diary));
        let statistics = measurement.statistics();
        let expected = diary.visits();
        let counted = statistics.visits_per_period() * statistics.periods() as f64;
        let records = statistics.records();
        let sum: u32 = records.iter().map(|record| record.visits.iter().sum::<u32>()).sum();
        assert!((counted - expected as f64).abs() < 1e-6, "{counted} {expected} at {clearance}");
        assert_eq!(u64::from(sum), expected);
        let fewer =
            records.iter().all(|r| r.visits[0] <= r.impacts[0] && r.visits[1] <= r.impacts[1]);
        assert!(fewer && (frequency == 8.0 && clearance == 7.5 || expected < statistics.impacts()));
    }
}

/// Few visits of dozens of impacts each: the weak-forcing side. Two visits a period of dozens of
/// impacts: the strong-forcing side, where the paper has z > 2.
#[test]
fn chattering_now_and_then_is_not_more_than_two_impacts_per_period() {
    let weak = reached(&common::table_1(8.01, 20.0), START).classification;
    assert_eq!(weak.regime, Regime::BelowTwo);
    assert!(weak.evidence.impacts_per_period > 2.0 && weak.evidence.visits_per_period < 1.0);
    let strong = reached(&common::table_1(8.0, 0.3), START).classification;
    assert_eq!(strong.regime, Regime::AboveTwo);
    assert!(strong.evidence.impacts_per_period > 20.0, "{strong:?}");
    assert!((strong.evidence.visits_per_period - 2.0).abs() < 0.01, "{strong:?}");
}

/// On the exact 1:1 motion the absorber's path is a triangle of height u T / 4, whose first harmonic
/// is 8/pi^2 of it, and both impacts lose `eps (1 - r^2) w'^2 / (2 (1 + eps))`.
#[test]
fn the_symmetric_motion_has_the_harmonic_and_the_losses_of_its_impacts() {
    for (frequency, clearance) in [(8.0, 7.5), (8.0, 15.0), (8.5, 20.0)] {
        let system = common::table_1(frequency, clearance);
        let found = reached(&system, START);
        let (repetition, impacts) = found.last_repetition().expect("it repeats");
        assert_eq!((repetition.impacts, repetition.periods, impacts.len()), (2, 1, 2));
        let impact = impacts[0];
        let e = 8.0 / (PI * PI) * impact.y_velocity_after.abs() * system.period() / 4.0;
        let amplitude = found.classification.evidence.absorber_amplitude;
        assert!((amplitude.smallest - e).abs() < 1e-6 && (amplitude.largest - e).abs() < 1e-6);
        assert!((amplitude.in_captures.expect("all of it") - e).abs() < 1e-6);
        assert_eq!(amplitude.between, None);
        let approach = impact.x_velocity_before - impact.y_velocity_before;
        let eps = system.mass_ratio();
        let loss = eps * (1.0 - 0.36) * approach * approach / (2.0 * (1.0 + eps));
        let energetics = found.energetics;
        let near = |a: f64, b: f64| (a - b).abs() < 1e-6 * b;
        assert!(near(energetics.loss_per_impact.expect("impacts"), loss), "{energetics:?} {loss}");
        assert!(near(energetics.loss_per_period, 2.0 * loss));
        assert!(near(energetics.impact_power, 2.0 * loss / system.period()));
        // Nothing is stored on average: what comes in goes out.
        let out = energetics.impact_power + energetics.damper_power;
        assert!(near(out, energetics.input_power), "{energetics:?}");
        let efficiency = energetics.transfer_efficiency.expect("driven");
        assert!(near(efficiency, energetics.impact_power / energetics.input_power));
    }
}

/// 3.587 mm instead of 6.40 mm at 8.5 Hz, 3.562 mm instead of 3.01 mm at 8 Hz.
#[test]
fn reductions_are_against_the_bare_oscillator() {
    for (frequency, clearance, ratio) in [(8.5, 20.0, 3.587 / 6.395), (8.0, 7.5, 3.562 / 3.015)] {
        let found = reached(&common::table_1(frequency, clearance), START).energetics;
        let expected = 20.0 * libm::log10(ratio);
        assert!((found.peak_change_db.expect("driven") - expected).abs() < 0.01, "{found:?}");
        // Nearly a sine.
        assert!((found.rms_change_db.expect("driven") - expected).abs() < 0.1, "{found:?}");
    }
}

/// Without impacts the oscillator is alone: all work goes into the damper, `d a^2 Omega^2` of it per
/// unit of time with `2 d = eps lambda`.
#[test]
fn a_resting_absorber_changes_nothing() {
    let system = common::table_1(7.0, 30.0);
    let linear = system.linear_response().expect("damped");
    let found = reached(&system, linear.state(&system));
    let energetics = found.energetics;
    let swing = linear.amplitude() * system.frequency_ratio();
    let power = 0.5 * system.mass_ratio() * system.damping() * swing * swing;
    assert!((energetics.damper_power / power - 1.0).abs() < 1e-9, "{energetics:?} {power}");
    assert!((energetics.input_power / power - 1.0).abs() < 1e-9, "{energetics:?}");
    assert_eq!((energetics.impact_power, energetics.loss_per_impact), (0.0, None));
    assert_eq!(energetics.transfer_efficiency, Some(0.0));
    assert!(energetics.peak_change_db.expect("driven").abs() < 1e-6);
    assert!(energetics.rms_change_db.expect("driven").abs() < 1e-6);
}

#[test]
fn without_excitation_there_is_no_efficiency() {
    let system = common::table_1(8.0, 1.0).with_clearance_scaled(1e12).expect("valid");
    let parameters =
        vinesink::system::Parameters { forcing_per_clearance: 0.0, ..system.parameters() };
    let system = System::new(parameters).expect("valid");
    let mut simulation = Simulation::new(&system, START, 0.0).expect("inside the cavity");
    let effort = Window { discard: 0, periods: 5, ..WINDOW };
    let found = Attractor::measure(&mut simulation, &effort).energetics;
    assert!(found.impact_power > 0.0);
    assert_eq!((found.transfer_efficiency, found.peak_change_db), (None, None));
}

/// Section 4.2: during captures E is large, and the vibration decreases; between them it grows.
#[test]
fn a_strongly_modulated_vibration_falls_while_e_is_large() {
    let found = reached(&common::table_1(8.5, 27.0), START);
    let evidence = &found.classification.evidence;
    assert_eq!(found.classification.regime, Regime::StronglyModulated);
    let amplitude = evidence.absorber_amplitude;
    let (inside, between) =
        (amplitude.in_captures.expect("some"), amplitude.between.expect("some"));
    assert!(inside > 1.5 * between, "{amplitude:?}");
    assert!(amplitude.smallest < between && amplitude.largest > inside);
    assert!(amplitude.correlation_with_growth.expect("both vary") < -0.5, "{amplitude:?}");
    let captured = found.amplitudes.iter().filter(|one| one.captured).count();
    assert_eq!(found.amplitudes.len() as u64, found.periods);
    let captures = evidence.captures;
    assert!((captures.mean * captures.count as f64 - captured as f64).abs() < 1e-9);
    let highest = found.amplitudes.iter().map(|one| one.peak).fold(0.0, f64::max);
    assert_eq!(highest, found.peak);
}

/// The equations are odd: the mirror image of a start half a period later leads to the mirror image.
#[test]
fn a_motion_and_its_mirror_image_are_one() {
    let system = common::table_1(8.0, 4.0);
    let one = reached(&system, START);
    let mut half = Simulation::new(&system, one.state, PI).expect("inside the cavity");
    half.run(1, 1000, &mut ());
    // One half-period further on, at phase 0 after pi .. 2 pi, the state's negative is a start.
    let State { x, x_velocity, y, y_velocity } = half.state();
    let mirrored = State { x: -x, x_velocity: -x_velocity, y: -y, y_velocity: -y_velocity };
    let other = reached(&system, mirrored);
    assert!(one.is_same(&other), "{:?} {:?}", one.classification, other.classification);
    let sequence = one.classification.evidence.sequence.expect("it repeats");
    assert_eq!(sequence.to_string(), "+-");
    // Another motion with another order of impacts is another one.
    let third = reached(&common::table_1(8.3, 10.0), START);
    assert_eq!(third.classification.evidence.sequence.expect("repeats").to_string(), "++-++-+-");
    assert!(!one.is_same(&third));
}

/// One thing at a time is changed of a motion, and it is another one.
#[test]
fn motions_differ_by_what_they_are() {
    let found = reached(&common::table_1(8.0, 7.5), START);
    let changed = |change: fn(&mut Attractor)| {
        let mut other = found.clone();
        change(&mut other);
        let same = found.is_same(&other);
        assert_eq!(same, other.is_same(&found), "not symmetric");
        same
    };
    assert!(changed(|_| ()));
    // Two that repeat are compared by their last repetition, here one period.
    fn last(other: &mut Attractor) -> &mut Amplitudes {
        other.amplitudes.last_mut().expect("a period")
    }
    assert!(!changed(|other| last(other).oscillator_amplitude *= 1.002));
    assert!(!changed(|other| last(other).absorber_amplitude *= 1.002));
    assert!(!changed(|other| last(other).peak *= 1.002));
    assert!(changed(|other| last(other).peak *= 1.0005));
    // What the window held before that does not matter: it may be the end of a transient.
    assert!(changed(|other| other.rms *= 1.1) && changed(|other| other.peak *= 1.1));
    assert!(!changed(|other| other.classification.evidence.sequence = None));
    assert!(!changed(|other| other.classification.regime = Regime::TwoAsymmetric));
    fn open(other: &mut Attractor, dynamics: DynamicsKind) {
        other.classification.evidence.periodicity = None;
        other.classification.evidence.sequence = None;
        other.classification.dynamics = dynamics;
    }
    // Still on its way to the motion that repeats; its intervals may still be unequal.
    assert!(changed(|other| {
        open(other, DynamicsKind::TransientNotOver);
        other.classification.regime = Regime::TwoAsymmetric;
        other.peak *= 1.01;
    }));
    assert!(!changed(|other| {
        open(other, DynamicsKind::TransientNotOver);
        other.peak *= 1.03;
    }));
    assert!(!changed(|other| {
        open(other, DynamicsKind::TransientNotOver);
        other.classification.evidence.visits_per_period = 2.5;
    }));
    assert!(!changed(|other| open(other, DynamicsKind::Chaotic)));
    let mut chaotic = reached(&common::table_1(8.0, 20.0), START);
    chaotic.classification.dynamics = DynamicsKind::Chaotic;
    let mut other = chaotic.clone();
    other.rms *= 1.1;
    assert!(chaotic.is_same(&other), "averages of some hundred periods scatter");
    other.classification.dynamics = DynamicsKind::Undecided;
    assert!(chaotic.is_same(&other));
    other.classification.dynamics = DynamicsKind::QuasiPeriodic;
    assert!(!chaotic.is_same(&other));
}

#[test]
fn a_settled_measurement_replaces_one_that_was_not() {
    let system = common::table_1(8.5, 20.0);
    let short = Window { discard: 80, periods: 90, impact_limit: 100_000 };
    let early = Attractor::reach(&system, START, &short).expect("inside the cavity");
    let late = reached(&system, START);
    let mut kept = early.clone();
    kept.replace_if_settled(late.clone());
    assert!(kept.repeats() && kept.followed == late.followed);
    kept.replace_if_settled(early);
    assert!(kept.repeats());
}

#[test]
fn a_search_gives_every_share_with_its_interval() {
    let system = common::table_1(8.0, 16.4);
    let effort = SearchEffort { starts: 12, discard: Some(600), periods: 400 };
    let found = search::find(&system, &[], &effort, &mut |_| ()).expect("inside the cavity");
    assert!(found.len() > 1, "two motions coexist");
    assert_eq!(found.iter().map(|one| one.starts).sum::<u32>(), 12);
    for one in &found {
        assert!((one.share - f64::from(one.starts) / 12.0).abs() < 1e-15);
        assert_eq!(one.share_interval, share::wilson(one.starts, 12));
        assert!(one.share_interval[0] <= one.share && one.share <= one.share_interval[1]);
    }
}

/// Each impact of the last repetition is a complete state: from it the motion goes on as it did.
#[test]
fn an_impact_of_the_last_repetition_restarts_the_motion() {
    let system = common::table_1(8.3, 10.0);
    let found = reached(&system, START);
    let (repetition, impacts) = found.last_repetition().expect("it repeats");
    assert_eq!(impacts.len(), repetition.impacts as usize);
    for impact in impacts {
        let state = State {
            x: impact.x,
            x_velocity: impact.x_velocity_after,
            y: impact.x - impact.side.sign(),
            y_velocity: impact.y_velocity_after,
        };
        let mut again = Simulation::new(&system, state, impact.phase).expect("on the wall");
        let mut log = vinesink::simulation::ImpactLog::default();
        again.run(u64::from(repetition.periods) + 1, 1000, &mut log);
        let next = log.impacts[repetition.impacts as usize - 1];
        assert_eq!(next.side, impact.side);
        assert!((next.x - impact.x).abs() < 1e-5 && (next.phase - impact.phase).abs() < 1e-5);
    }
}

/// In the short windows of a basin the averages of one strongly modulated motion scatter, and some
/// windows show no capture: it stays one motion all the same.
#[test]
fn a_modulated_motion_stays_one_in_short_windows() {
    let system = common::table_1(8.5, 28.0);
    let long = Window { discard: 400, periods: 2000, impact_limit: 1_000_000 };
    let known = Attractor::reach(&system, START, &long).expect("inside the cavity");
    assert!(!known.repeats());
    let middle = |cell: u32| 2.4 * (f64::from(cell) + 0.5) / 8.0 - 1.2;
    let start = |k: u32| State {
        x: middle(k % 8),
        x_velocity: middle(k / 8),
        y: middle(k % 8),
        y_velocity: 1.0,
    };
    let starts: Vec<State> = (0..64).map(start).collect();
    let short = Effort { discard: Some(300), ..Effort::over(25) };
    let basins =
        Basins::of(&system, &starts, vec![known.motion], &short, &mut |_| ()).expect("finite");
    let regimes: Vec<Regime> = basins.motions.iter().map(|found| found.regime).collect();
    let moving = regimes.iter().filter(|regime| **regime != Regime::AtRest).count();
    assert_eq!(moving, 1, "{regimes:?}");
    assert!(basins.counts()[0] > 32, "{:?}", basins.counts());
}

#[test]
fn basins_hold_both_answers_at_8_hz_and_16_4_mm() {
    let system = common::table_1(8.0, 16.4);
    // Relative displacements of -0.75 to 0.75, velocities of the absorber of -0.45 to 0.45.
    let place = |k: u32, step: f64, count: u32| step * (f64::from(k) - 0.5 * f64::from(count - 1));
    let start = |k: u32| State {
        x: 0.2,
        x_velocity: 0.1,
        y: 0.2 - place(k % 4, 0.5, 4),
        y_velocity: place(k / 4, 0.3, 4),
    };
    let starts: Vec<State> = (0..16).map(start).collect();
    let effort = Effort { discard: Some(600), ..Effort::over(200) };
    let mut told = 0;
    let basins =
        Basins::of(&system, &starts, Vec::new(), &effort, &mut |n| told += n).expect("finite");
    assert_eq!((told, basins.cells.len()), (16, 16));
    let regimes: Vec<Regime> = basins.motions.iter().map(|found| found.regime).collect();
    assert!(regimes.contains(&Regime::TwoSymmetric) && regimes.contains(&Regime::BelowTwo));
    assert_eq!(regimes.len(), 2, "{regimes:?}");
    for (start, cell) in starts.iter().zip(&basins.cells) {
        if let Cell::Leads(index) = cell {
            let again = long_term(&[(system, *start)], &effort).expect("inside")[0];
            assert_eq!(again.expect("followed").regime, regimes[*index]);
        }
    }
    let settled = basins.counts().iter().sum::<usize>();
    assert!(settled >= 12 && basins.counts().iter().all(|count| *count > 0), "{settled}");
    // What is known keeps its place.
    let known = basins.motions.clone();
    let again = Basins::of(&system, &starts, known, &effort, &mut |_| ()).expect("finite");
    assert_eq!((again.cells, again.motions.len()), (basins.cells, 2));
    // Outside the cavity there is no start.
    let outside = State { y: 1.5, ..State::AT_REST };
    assert!(Basins::of(&system, &[outside], Vec::new(), &effort, &mut |_| ()).is_err());
}

/// 1:1 resonance is kept upwards to the exact saddle-node at b = 16.695 mm, and comes back downwards
/// only where the modulated response no longer lasts.
#[test]
fn resonance_is_lost_later_upwards_than_it_returns_downwards() {
    let base = common::table_1(8.0, 10.0);
    let values: Vec<f64> = (0..=8).map(|k| 1.375 + 0.05 * f64::from(k)).collect();
    let effort = Effort { discard: Some(300), ..Effort::over(200) };
    let mut told = 0;
    let points = sweep(&base, Parameter::Clearance, &values, START, &effort, &mut |n| told += n)
        .expect("systems");
    assert_eq!((points.len(), told), (18, 18));
    let last_kept = |way| {
        let kept = points.iter().filter(|point| point.way == way);
        let kept = kept.filter(|point| point.motion.regime == Regime::TwoSymmetric);
        kept.map(|point| 10.0 * point.value).fold(0.0, f64::max)
    };
    let (up, down) = (last_kept(SweepDirection::Up), last_kept(SweepDirection::Down));
    assert!((16.2..16.695).contains(&up), "kept up to {up} mm");
    assert!(down > 0.0 && down < up - 1.0, "back at {down} mm");
    for point in &points {
        assert!(point.motion.stop == Stop::EndTime && point.period_peaks.len() == 40, "{point:?}");
        let highest = point.period_peaks.iter().copied().fold(0.0, f64::max);
        assert!(highest <= point.peak * (1.0 + 1e-12));
        if point.motion.regime == Regime::TwoSymmetric {
            assert!((point.peak - highest).abs() < 1e-4 * highest);
            assert!(point.intervals.iter().all(|dt| (dt - 0.5).abs() < 1e-4), "{point:?}");
        }
    }
    // The peak at b = 15 mm is the exact orbit's, in the base's clearances of 10 mm.
    let fine =
        sweep(&base, Parameter::Clearance, &[1.5], START, &EFFORT, &mut |_| ()).expect("systems");
    assert!(fine.iter().any(|point| (10.0 * point.peak - 3.364).abs() < 5e-4), "{fine:?}");
}

/// Four ways to 8 Hz and 7.5 mm from another system: the peak there, 3.562 mm, is in the clearances
/// of the system that each began with, and twice as large where the excitation is.
#[test]
fn other_parameters_are_swept_in_their_own_units() {
    let there = common::table_1(8.0, 7.5);
    let elastic =
        vinesink::system::Parameters { restitution: 0.9, ..common::table_1(8.0, 7.5).parameters() };
    for (base, clearance_mm, parameter, value, peak_mm) in [
        (common::table_1(8.5, 7.5), 7.5, Parameter::Frequency, there.frequency_ratio(), 3.562),
        (common::table_1(8.0, 15.0), 15.0, Parameter::Amplitude, 2.0, 2.0 * 3.562),
        (System::new(elastic).expect("valid"), 7.5, Parameter::Restitution, 0.6, 3.562),
        (common::table_1(8.0, 10.0), 10.0, Parameter::Clearance, 0.75, 3.562),
    ] {
        let points =
            sweep(&base, parameter, &[value], START, &EFFORT, &mut |_| ()).expect("systems");
        assert_eq!(points.len(), 2);
        let near = |peak: f64| (clearance_mm * peak - peak_mm).abs() < 1e-3;
        assert!(points.iter().all(|point| near(point.peak)), "{parameter:?} {points:?}");
        assert!(sweep(&base, parameter, &[-1.0], START, &EFFORT, &mut |_| ()).is_err());
    }
}

/// A motion that chatters without end is told from one that settles.
#[test]
fn the_limit_on_impacts_shows_in_the_diagram() {
    let base = common::table_1(8.0, 0.3);
    let effort = Effort { most_impacts: 1, ..EFFORT };
    let points =
        sweep(&base, Parameter::Clearance, &[1.0], START, &effort, &mut |_| ()).expect("system");
    assert!(points.iter().all(|point| point.motion.stop == Stop::ImpactLimit));
}

/// Measured side by side from impacts alone, a motion that repeats has the regime, the repetition and the peak
/// that it has alone with every flight integrated.
#[test]
fn long_term_motions_are_those_of_trajectories_alone() {
    let (mut asymmetric, mut longer, mut compared) = (0, 0, 0);
    for clearance_mm in [3.0, 8.0, 12.0, 14.0, 16.0, 20.0, 40.0] {
        for frequency_hz in [8.1, 8.3, 8.5] {
            let system = common::table_1(frequency_hz, clearance_mm);
            let begun: Vec<(System, State)> =
                starts::of(&system, 4).map(|start| (system, start)).collect();
            let found = long_term(&begun, &Effort::over(96)).expect("finite");
            for ((_, start), motion) in begun.iter().zip(found) {
                let motion = motion.expect("no bad end");
                let alone = reached(&system, *start);
                let evidence = &alone.classification.evidence;
                // Alone it is followed longer, and may come to repeat only then.
                let both = evidence.periodicity.zip(motion.repeats_after);
                let Some((periodicity, repeats_after)) = both else { continue };
                compared += 1;
                let place = format!("{clearance_mm} mm, {frequency_hz} Hz, {start:?}");
                assert_eq!(motion.regime, alone.classification.regime, "{place}");
                assert_eq!(repeats_after, periodicity.periods, "{place}");
                assert_eq!(motion.impacts_per_period, evidence.impacts_per_period, "{place}");
                // Twelve e-folds leave 1e-5 of a transient.
                assert!((motion.peak / alone.peak - 1.0).abs() < 1e-4, "{place}");
                assert!((motion.rms / alone.rms - 1.0).abs() < 1e-4, "{place}");
                asymmetric += u32::from(motion.regime == Regime::TwoAsymmetric);
                longer += u32::from(periodicity.periods > 1);
            }
        }
    }
    assert!(compared > 40 && asymmetric > 4 && longer > 4, "{compared} {asymmetric} {longer}");
}
