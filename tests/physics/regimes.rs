//! What is measured of a long-term motion: visits to walls, energy, captures, the order of impacts;
//! and what is made of many of them: planes of starts and diagrams.

use crate::common;
use std::f64::consts::PI;

use vinesink::executor::Serial;
use vinesink::motions::{
    Effort, Measured, Motion, Place, SweepDirection, Window, follow, motions, starts, sweep,
};
use vinesink::regimes::Regime;
use vinesink::simulation::{Impact, Measurement, Observer, Side, Simulation, Stop};
use vinesink::system::{Parameter, State, System};

const START: State = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };
const WINDOW: Window = Window { discard: 800, periods: 200, impact_limit: 200_000 };

fn reached(system: &System, start: State) -> Measured {
    Measured::reach(system, start, &WINDOW).expect("inside the cavity")
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
        // In most but not all stretches of 300 periods some absorber chatters now and then.
        simulation.run(3000, 1_000_000, &mut (&mut measurement, &mut diary));
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
        let efficiency = found.facts.efficiency.expect("driven").value;
        assert!(near(efficiency, energetics.impact_power / energetics.input_power));
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
    assert_eq!(found.facts.efficiency.map(|share| share.value), Some(0.0));
    assert!((found.facts.peak.value / linear.amplitude() - 1.0).abs() < 1e-7);
    assert!(
        (found.facts.rms.value * std::f64::consts::SQRT_2 / linear.amplitude() - 1.0).abs() < 1e-7
    );
}

#[test]
fn without_excitation_there_is_no_efficiency() {
    let system = common::table_1(8.0, 1.0).with_clearance_scaled(1e12).expect("valid");
    let parameters =
        vinesink::system::Parameters { forcing_per_clearance: 0.0, ..system.parameters() };
    let system = System::new(parameters).expect("valid");
    let mut simulation = Simulation::new(&system, START, 0.0).expect("inside the cavity");
    let effort = Window { discard: 0, periods: 5, ..WINDOW };
    let found = Measured::of(&mut simulation, &effort, &mut Measured::log());
    assert!(found.energetics.impact_power > 0.0);
    assert_eq!(found.facts.efficiency, None);
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
    assert_eq!(highest, found.facts.peak.value);
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

/// In short windows the averages of one strongly modulated motion scatter, and some windows show no capture: it stays one
/// motion all the same.
#[test]
fn a_modulated_motion_stays_one_in_short_windows() {
    let system = common::table_1(8.5, 28.0);
    for starts in [8, 32, 64] {
        let effort = Effort { discard: Some(300), ..Effort::over(100) };
        let found = motions(&[Place::new(&system, starts)], &effort, &Serial).expect("finite");
        let moving: Vec<&Motion> = found[0].iter().filter(|one| one.rest().is_none()).collect();
        let [only] = moving.as_slice() else { panic!("{moving:?}") };
        assert_eq!((only.reached().starts, only.regime()), (starts, Regime::StronglyModulated));
    }
}

/// Both answers from starts of a plane, each of which leads where it leads alone.
#[test]
fn a_plane_of_starts_holds_both_answers_at_8_hz_and_16_4_mm() {
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
    let search = |place: Place| motions(&[place], &effort, &Serial);
    let found = search(Place::with(&system, starts.clone())).expect("finite").remove(0);
    let regimes: Vec<Regime> = found.iter().map(Motion::regime).collect();
    assert!(regimes.contains(&Regime::TwoSymmetric) && regimes.contains(&Regime::BelowTwo));
    assert_eq!(found.led().len(), 16);
    for (start, led) in starts.iter().zip(found.led()) {
        let motion = found.get(led.expect("it leads somewhere")).expect("of the list");
        if motion.reached().late > 0 {
            continue;
        }
        let again = follow(&[(system, *start)], &effort).expect("inside").remove(0);
        assert_eq!(again.expect("followed").regime(), motion.regime(), "{start:?}");
    }
    // What is known keeps its name, and nothing new is found.
    let known: Vec<Motion> = found.iter().cloned().collect();
    let again = search(Place { known, ..Place::with(&system, starts) }).expect("finite").remove(0);
    assert_eq!((again.len(), again.led()), (found.len(), found.led()));
    // Outside the cavity there is no start.
    let outside = State { y: 1.5, ..State::AT_REST };
    assert!(search(Place::with(&system, vec![outside])).is_err());
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
        let kept = kept.filter(|point| point.motion.regime() == Regime::TwoSymmetric);
        kept.map(|point| 10.0 * point.value).fold(0.0, f64::max)
    };
    let (up, down) = (last_kept(SweepDirection::Up), last_kept(SweepDirection::Down));
    assert!((16.2..16.695).contains(&up), "kept up to {up} mm");
    assert!(down > 0.0 && down < up - 1.0, "back at {down} mm");
    for point in &points {
        assert!(
            point.motion.stop() == Stop::EndTime && point.period_peaks.len() == 40,
            "{point:?}"
        );
        let highest = point.period_peaks.iter().copied().fold(0.0, f64::max);
        assert!(highest <= point.peak * (1.0 + 1e-12));
        if point.motion.regime() == Regime::TwoSymmetric {
            assert!((point.peak - highest).abs() < 1e-4 * highest);
            assert!(point.intervals.iter().all(|dt| (dt - 0.5).abs() < 1e-4), "{point:?}");
        }
    }
    // The peak at b = 15 mm is the exact orbit's, in the base's clearances of 10 mm.
    let fine = sweep(&base, Parameter::Clearance, &[1.5], START, &Effort::over(200), &mut |_| ())
        .expect("systems");
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
        let points = sweep(&base, parameter, &[value], START, &Effort::over(200), &mut |_| ())
            .expect("systems");
        assert_eq!(points.len(), 2);
        let near = |peak: f64| (clearance_mm * peak - peak_mm).abs() < 1e-3;
        assert!(points.iter().all(|point| near(point.peak)), "{parameter:?} {points:?}");
        assert!(sweep(&base, parameter, &[-1.0], START, &Effort::over(200), &mut |_| ()).is_err());
    }
}

/// A motion that chatters without end is told from one that settles.
#[test]
fn the_limit_on_impacts_shows_in_the_diagram() {
    let base = common::table_1(8.0, 0.3);
    let effort = Effort { most_impacts: 1, ..Effort::over(200) };
    let points =
        sweep(&base, Parameter::Clearance, &[1.0], START, &effort, &mut |_| ()).expect("system");
    assert!(points.iter().all(|point| point.motion.stop() == Stop::ImpactLimit));
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
                starts::spread(&system, 4).map(|start| (system, start)).collect();
            let found = follow(&begun, &Effort::over(96)).expect("finite");
            for ((_, start), motion) in begun.iter().zip(found) {
                let motion = motion.expect("no bad end");
                let alone = reached(&system, *start);
                let evidence = &alone.classification.evidence;
                // Alone it is followed longer, and may come to repeat only then.
                let both = evidence.periodicity.zip(motion.repeats_after());
                let Some((periodicity, repeats_after)) = both else { continue };
                compared += 1;
                let place = format!("{clearance_mm} mm, {frequency_hz} Hz, {start:?}");
                assert_eq!(motion.regime(), alone.regime(), "{place}");
                assert_eq!(repeats_after, periodicity.periods, "{place}");
                let (side, one) = (motion.facts(), &alone.facts);
                assert_eq!(side.impacts_per_period, one.impacts_per_period, "{place}");
                // Twelve e-folds leave 1e-5 of a transient.
                assert!((side.peak.value / one.peak.value - 1.0).abs() < 1e-4, "{place}");
                assert!((side.rms.value / one.rms.value - 1.0).abs() < 1e-4, "{place}");
                asymmetric += u32::from(motion.regime() == Regime::TwoAsymmetric);
                longer += u32::from(periodicity.periods > 1);
            }
        }
    }
    assert!(compared > 40 && asymmetric > 4 && longer > 4, "{compared} {asymmetric} {longer}");
}
