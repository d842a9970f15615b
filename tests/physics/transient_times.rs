//! Released, swept and driven structures against the reference of 77 decimal digits.

use std::f64::consts::TAU;

use crate::common::{table_1, unforced};
use crate::reference::{Decimal, Moment, Reference};
use vinesink::excitation::{Record, RecordQuantity, SineSweep, SweepRate};
use vinesink::flights::{Ringdown, STEPS, follow};
use vinesink::simulation::{ImpactLog, Measurement, Simulation};
use vinesink::system::{Scales, State};

/// Steps in which the reference looks for impacts.
const STEP: f64 = 0.06;

/// SI is dimensionless.
const UNIT: Scales =
    Scales { physical: true, clearance: 1.0, natural_frequency: 1.0, oscillator_mass: 1.0 };

fn first(start: State) -> Moment {
    Moment::start([start.x, start.x_velocity, start.y, start.y_velocity])
}

/// Amplitude, energy taken and number of impacts in steps of a sixteenth of an oscillation, through symmetric 1:1 motion
/// down to the fold.
#[test]
fn a_ringdown_is_the_references() {
    let system = unforced(0.0077, 1.8, 0.6);
    let start = State { x: 0.7, x_velocity: 0.1, y: 0.2, y_velocity: -0.2 };
    let found = Ringdown::follow(&system, start, 0.2, 40).expect("inside");
    let reference = Reference::new(&system);
    let (mut moment, mut impacts) = (first(start), 0);
    for (k, amplitude) in found.amplitudes.iter().enumerate().skip(1) {
        let end = TAU / f64::from(STEPS) * k as f64;
        let (more, then) = reference.until(moment, end, STEP);
        impacts += more.len() as u64;
        let [x, v] = [0, 1].map(|k| then.state[k].to_f64());
        // Rounding of some ten impacts, which a stable motion forgets, and of the end's own time.
        assert!((amplitude - libm::hypot(x, v)).abs() < 1e-12, "{k}: {amplitude}");
        assert_eq!(impacts, found.impacts[k], "{k}");
        moment = then;
    }
    assert!(impacts > 20, "{impacts}");
    // Damper and impacts take all that is no longer there.
    let mut simulation = Simulation::new(&system, start, 0.0).expect("inside");
    let mut measured = Measurement::begin(&system, start);
    simulation.run(40, 10_000, &mut measured);
    let residual = measured.statistics().energy().relative_residual;
    assert!(residual < 1e-9, "{residual:e}");
}

/// Fifty periods of a fast sweep through the resonance, each at one frequency: every impact's time in its period. Symmetric motion turns chaotic
/// on the way, which multiplies rounding: as much as a displacement that is ten thousand times as large, in every period.
#[test]
fn a_sweep_has_the_references_impact_times() {
    const DISPLACED: f64 = 1e-12;
    let system = table_1(8.0, 7.5);
    let units = Scales { natural_frequency: TAU * 8.349, ..UNIT };
    let sweep = SineSweep { from: 8.0, to: 8.7, rate: SweepRate::Linear(0.1), turn: 1.0 };
    let mut state = State { x: 0.25, x_velocity: 0.3, y: -0.4, y_velocity: 0.6 };
    let mut moments = [first(state), first(state)];
    let (mut impacts, mut worst, mut displaced) = (0, 0.0_f64, 0.0_f64);
    for n in 0..50 {
        let [begin, end] = [n, n + 1].map(|n| sweep.time(f64::from(n)));
        let ratio = units.frequency_ratio(1.0 / (end - begin));
        let piece = system.with_frequency_ratio(ratio).expect("valid");
        let mut simulation = Simulation::new(&piece, state, 0.0).expect("inside");
        let mut log = ImpactLog::default();
        simulation.run(1, 100, &mut log);
        state = simulation.state();
        let reference = Reference::new(&piece);
        let [_, moved] = &mut moments;
        moved.state[0] = &moved.state[0] + &Decimal::of(DISPLACED);
        let [(there, then), (near, later)] =
            moments.map(|moment| reference.until(moment, TAU / ratio, STEP));
        assert!(log.impacts.len() == there.len() && near.len() == there.len());
        for ((impact, there), near) in log.impacts.iter().zip(&there).zip(&near) {
            let apart = |time: f64| (time - there.time.to_f64()).abs();
            worst = worst.max(apart(impact.tau));
            displaced = displaced.max(apart(near.time.to_f64()));
            assert!(worst < 1e-13 + 0.01 * displaced, "{worst:e} {displaced:e}");
        }
        impacts += there.len();
        moments = [then, later].map(|then| Moment { time: first(state).time, ..then });
    }
    assert!(impacts > 90 && worst < 1e-7, "{impacts} {worst:e}");
}

/// A force in straight lines: the displacement at the end of every line.
#[test]
fn a_record_has_the_references_displacements() {
    let system = unforced(0.05, 0.4, 0.6);
    let value = |t: f64| 0.4 * libm::sin(1.02 * t) + 0.3 * libm::sin(0.37 * t + 1.0);
    let samples = (0..=80_u32).map(|k| 0.5 * f64::from(k)).map(|t| [t, value(t)]).collect();
    let record = Record { quantity: RecordQuantity::Force, samples, base_velocity: 0.0 };
    let pieces = record.pieces(&UNIT, Record::LONGEST);
    let found = follow(&system, &pieces, 0.3).expect("followed");
    let mut moment = first(State { x: 0.0, x_velocity: 0.0, y: -0.3, y_velocity: 0.0 });
    let (start, mut impacts) = (moment.time.clone(), 0);
    assert_eq!(found.trace.len(), pieces.len() + 1);
    for (piece, [time, x]) in pieces.iter().zip(&found.trace[1..]) {
        let reference = Reference::pushed(&system, piece.force);
        let (there, then) = reference.until(moment, piece.duration, STEP);
        impacts += there.len() as u64;
        let apart = x - then.state[0].to_f64();
        assert!(apart.abs() < 1e-10, "{time}: {apart:e}");
        moment = Moment { time: start.clone(), ..then };
    }
    assert_eq!(impacts, found.impacts);
    assert!(impacts > 10, "{impacts}");
}
