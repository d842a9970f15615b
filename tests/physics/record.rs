//! A structure that a record drives, against closed form, the engine's own harmonic drive, energy and an integration
//! that shares nothing with it.

use std::f64::consts::{PI, TAU};

use vinesink::excitation::{Piece, Record, RecordQuantity, Spectrum};
use vinesink::executor::Serial;
use vinesink::flights::{Places, Response, follow, worst_of_places};
use vinesink::linear::{TunedMassDamper, driven};
use vinesink::measure::{Device, Measure};
use vinesink::simulation::Simulation;
use vinesink::system::{Cavity, Excitation, Parameters, Scales, State, System};
use vinesink::transient::{RecordStudy, Study};

use crate::common::unforced as system;

/// A unit of everything: SI is dimensionless.
const UNITS: Scales =
    Scales { physical: true, clearance: 1.0, natural_frequency: 1.0, oscillator_mass: 1.0 };

/// Values at even times.
fn record(quantity: RecordQuantity, step: f64, count: u32, value: impl Fn(f64) -> f64) -> Record {
    let at = |k: u32| f64::from(k) * step;
    let samples = (0..=count).map(|k| [at(k), value(at(k))]).collect();
    Record { quantity, samples, base_velocity: 0.0 }
}

/// A few swings of several frequencies, which grow and fade.
fn quake(tau: f64) -> f64 {
    let swings = [(0.31, 0.2), (0.83, 1.1), (1.02, 0.4), (1.9, 2.0), (3.3, 0.9)];
    let sum: f64 = swings.iter().map(|(rate, phase)| libm::sin(rate * tau + phase)).sum();
    sum * 0.25 * tau * libm::exp(-tau / 12.0)
}

const WALLS: System3 = System3 { eps: 0.05, lambda: 0.4, r: 0.6 };

#[derive(Clone, Copy)]
struct System3 {
    eps: f64,
    lambda: f64,
    r: f64,
}

impl System3 {
    fn system(self) -> System {
        system(self.eps, self.lambda, self.r)
    }
}

/// What happened: the end, largest displacement, impacts, time in contact.
struct Integrated {
    end: [f64; 4],
    peak: f64,
    impacts: u64,
    contact: f64,
}

fn runge_kutta(
    state: [f64; 4],
    t: f64,
    h: f64,
    rate: &dyn Fn([f64; 4], f64) -> [f64; 4],
) -> [f64; 4] {
    let add = |slope: [f64; 4], h: f64| std::array::from_fn(|k| state[k] + h * slope[k]);
    let a = rate(state, t);
    let b = rate(add(a, 0.5 * h), t + 0.5 * h);
    let c = rate(add(b, 0.5 * h), t + 0.5 * h);
    let d = rate(add(c, h), t + h);
    std::array::from_fn(|k| state[k] + h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]))
}

/// Time between samples of records that are integrated.
const SAMPLE: f64 = 0.35;

/// Seen from the base, by small steps; events bisected. An impact after which the absorber is slower than 1e-6 begins
/// sustained contact, where the wall then pushes.
fn integrated(
    of: System3,
    w: f64,
    [end, step]: [f64; 2],
    shakes: bool,
    force: &dyn Fn(f64) -> f64,
) -> Integrated {
    let System3 { eps, lambda, r } = of;
    let alone = |x: f64, v: f64, t: f64| force(t) - eps * lambda * v - x;
    let base = |t: f64| if shakes { force(t) } else { 0.0 };
    let flight = |s: [f64; 4], t: f64| [s[1], alone(s[0], s[1], t), s[3], base(t)];
    let carried = |s: [f64; 4], t: f64| {
        let pull = (alone(s[0], s[1], t) + eps * base(t)) / (1.0 + eps);
        [s[1], pull, s[1], pull]
    };
    // What pushes the wall against the absorber.
    let push = |side: f64, s: [f64; 4], t: f64| side * (alone(s[0], s[1], t) - base(t));
    let (mut s, mut t, mut side) = ([0.0, 0.0, -w, 0.0], 0.0, None::<f64>);
    let mut found = Integrated { end: s, peak: 0.0, impacts: 0, contact: 0.0 };
    while t < end {
        // No step across a sample, where the slope changes.
        let next = SAMPLE * (t / SAMPLE + 1e-9).floor() + SAMPLE;
        let h = step.min(end - t).min(next - t);
        let rate: &dyn Fn([f64; 4], f64) -> [f64; 4] =
            if side.is_some() { &carried } else { &flight };
        let over = |s: [f64; 4], t: f64| match side {
            Some(side) => push(side, s, t) < 0.0,
            None => (s[0] - s[2]).abs() > 1.0,
        };
        let mut part = h;
        let happens = over(runge_kutta(s, t, h, rate), t + h);
        if happens {
            let mut low = 0.0;
            for _ in 0..60 {
                let middle = 0.5 * (low + part);
                if over(runge_kutta(s, t, middle, rate), t + middle) {
                    part = middle
                } else {
                    low = middle
                }
            }
        }
        s = runge_kutta(s, t, part, rate);
        t += part;
        found.peak = found.peak.max(s[0].abs());
        found.contact += if side.is_some() { part } else { 0.0 };
        match (happens, side) {
            (false, _) => {}
            (true, Some(_)) => side = None,
            (true, None) => {
                let relative = s[1] - s[3];
                s[1] -= eps / (1.0 + eps) * (1.0 + r) * relative;
                s[3] += 1.0 / (1.0 + eps) * (1.0 + r) * relative;
                found.impacts += 1;
                let wall = (s[0] - s[2]).signum();
                // Off the wall by what rounding could take for another impact.
                s[2] = s[0] - wall * (1.0 - 1e-13);
                if r * relative.abs() < 1e-6 && push(wall, s, t) > 0.0 {
                    side = Some(wall);
                    let common = (s[1] + eps * s[3]) / (1.0 + eps);
                    (s[1], s[3]) = (common, common);
                }
            }
        }
    }
    found.end = s;
    found
}

/// The value between samples.
fn between(record: &Record, t: f64) -> f64 {
    let after = record.samples.partition_point(|sample| sample[0] <= t);
    let after = after.clamp(1, record.samples.len() - 1);
    let [[from, first], [to, second]] = [record.samples[after - 1], record.samples[after]];
    first + (second - first) * (t - from) / (to - from)
}

fn last(found: &Response) -> f64 {
    found.trace.last().expect("a trace")[1]
}

/// Force and shaken base, with impacts that rebound and with sustained contact. The integration has steps of 1e-3, so
/// an error of 1e-12 that impacts multiply. A force is exact in pieces of any length; under a base that shakes the
/// times of impacts are off by the fourth power of the length, 1e-8.
#[test]
fn a_flight_in_a_moving_frame_is_the_flight() {
    for quantity in [RecordQuantity::Force, RecordQuantity::BaseAcceleration] {
        let shakes = quantity == RecordQuantity::BaseAcceleration;
        let record = record(quantity, SAMPLE, 100, quake);
        let sign = if shakes { -1.0 } else { 1.0 };
        let force = |t: f64| sign * between(&record, t);
        for (r, w) in [(0.6, 0.3), (0.6, -0.7), (0.0, 0.3), (0.0, -0.9)] {
            let of = System3 { r, ..WALLS };
            let exact = integrated(of, w, [35.0, 1e-3], shakes, &force);
            let longest = if shakes { 0.01 } else { Record::LONGEST };
            let found = follow(&of.system(), &record.pieces(&UNITS, longest), w).expect("followed");
            // Where chattering ends in contact is a matter of tolerance; without rebound there is none.
            assert!(r > 0.0 || found.impacts == exact.impacts, "{quantity:?} {r} {w}");
            assert!(exact.impacts > 10 && exact.contact > 0.05, "{}", exact.contact);
            let error = (last(&found) - exact.end[0]).abs();
            let most = if shakes { 1e-8 } else { 1e-10 };
            assert!(error < most, "{quantity:?} {r} {w}: {error:e}");
        }
    }
}

/// A pulse that ends long before the structure has moved far.
struct Pulse {
    quantity: RecordQuantity,
    step: f64,
    count: u32,
    value: fn(f64) -> f64,
}

const PULSES: [Pulse; 3] = [
    // Half a sine, a whole swing to one side, and a force that stops suddenly.
    Pulse {
        quantity: RecordQuantity::Force,
        step: 0.05,
        count: 5,
        value: |t| 40.0 * libm::sin(PI * t / 0.25),
    },
    Pulse {
        quantity: RecordQuantity::BaseAcceleration,
        step: 0.07,
        count: 10,
        value: |t| 6.0 * (1.0 - libm::cos(TAU * t / 0.7)),
    },
    Pulse { quantity: RecordQuantity::Force, step: 0.35, count: 2, value: |t| 9.0 * t },
];

impl Pulse {
    fn record(&self) -> Record {
        record(self.quantity, self.step, self.count, self.value)
    }
}

/// The largest displacement comes after the record's end: by an integration that goes on with nothing acting. A root mean
/// square is that over the record; what is found later cannot be told from a record that goes on with zeros.
#[test]
fn what_comes_after_a_records_end_counts() {
    for pulse in &PULSES {
        let record = pulse.record();
        let end = record.samples.last().expect("samples")[0];
        let shakes = pulse.quantity != RecordQuantity::Force;
        let sign = if shakes { -1.0 } else { 1.0 };
        // Half of it at the end itself, which is the last stage of one step and the first of the next.
        let force = |t: f64| match t - end {
            late if late > 1e-9 => 0.0,
            early if early < -1e-9 => sign * between(&record, t),
            _ => 0.5 * sign * between(&record, end),
        };
        for (r, w) in [(0.6, 0.3), (0.2, -0.9), (0.6, 0.95)] {
            let of = System3 { r, ..WALLS };
            let exact = integrated(of, w, [3.0 * TAU, 2e-4], shakes, &force);
            let driven_alone = follow(&of.system(), &record.pieces(&UNITS, Record::LONGEST), w);
            let driven_alone = driven_alone.expect("followed");
            let found = follow(&of.system(), &record.pieces_to_rest(&UNITS, Record::LONGEST), w);
            let found = found.expect("followed");
            // Larger steps miss impacts of a chattering absorber. Cubics over 0.2 leave 5e-6 of the peak, the shaken frame 2e-5 of the motion.
            assert!((found.peak / exact.peak - 1.0).abs() < 3e-5, "{} {}", found.peak, exact.peak);
            assert!(driven_alone.peak < 0.9 * found.peak, "{} {}", driven_alone.peak, found.peak);
            assert_eq!((found.rms, found.open), (driven_alone.rms, 0.0));
            assert!((found.duration - end - found.rang).abs() < 1e-9);
            // For as long with zeros, at least.
            let mut zeros = record.clone();
            let from = if force(end).abs() < 1e-6 { end } else { end + 1e-9 };
            let count = (1.1 * found.rang / 0.2) as u32;
            zeros
                .samples
                .extend((u32::from(from == end)..=count).map(|k| [from + 0.2 * f64::from(k), 0.0]));
            let long =
                follow(&of.system(), &zeros.pieces(&UNITS, Record::LONGEST), w).expect("followed");
            assert!((found.peak / long.peak - 1.0).abs() < 1e-5, "{} {}", found.peak, long.peak);
            assert!((found.impact_speed / long.impact_speed - 1.0).abs() < 1e-6);
            let [share, all] = [&found, &long].map(|one| one.impact_loss / one.work);
            assert!(all - share < 1e-3 && share > 0.01, "{share} {all}");
        }
    }
}

/// Alone, with a damper and without any damping: a blow `J` of the shortest kind swings an undamped structure to `J`, and
/// the damper's stroke is that of a record that goes on.
#[test]
fn a_linear_structure_rings_to_its_largest_displacement() {
    for (eps, lambda) in [(0.05, 0.0), (0.05, 0.4), (0.01, 40.0)] {
        let of = system(eps, lambda, 0.6);
        for pulse in &PULSES {
            let record = pulse.record();
            let pieces = record.pieces_to_rest(&UNITS, Record::LONGEST);
            let mut long = record.pieces(&UNITS, Record::LONGEST);
            let rest = Piece { rings: 0.0, ..*pieces.last().expect("pieces") };
            long.extend(std::iter::repeat_n(rest, 2000));
            for damper in [None, Some(TunedMassDamper::den_hartog(eps))] {
                let [found, long] =
                    [&pieces, &long].map(|pieces| driven(&of, damper.as_ref(), pieces, true));
                let told = [&found, &long].map(|one| one.shaking.expect("asked for"));
                for (name, a, b) in [
                    ("peak", found.peak, long.peak),
                    (
                        "stroke",
                        found.stroke,
                        if damper.is_some() { long.stroke } else { found.stroke },
                    ),
                    ("velocity", told[0].peak_velocity, told[1].peak_velocity),
                    ("acceleration", told[0].peak_acceleration, told[1].peak_acceleration),
                ] {
                    assert!((a / b - 1.0).abs() < 1e-5, "{lambda} {name}: {a} {b}");
                }
                assert!(found.rang < long.rang.max(400.0) && found.open == 0.0, "{}", found.rang);
            }
        }
    }
    let blow =
        record(RecordQuantity::Force, 0.001, 2, |t| 1000.0 * (1.0 - (1000.0 * t - 1.0).abs()));
    let found =
        driven(&system(0.05, 0.0, 0.6), None, &blow.pieces_to_rest(&UNITS, Record::LONGEST), false);
    // Cubics, and a blow of 0.002.
    assert!((found.peak - 1.0).abs() < 1e-5, "{}", found.peak);
}

/// The base of a record of its displacement stays where that ends.
#[test]
fn a_displaced_base_stays_where_its_record_ends() {
    let (step, count, height) = (0.05, 14, 2.0);
    let record = record(RecordQuantity::BaseDisplacement, step, count, |t| height * libm::sin(t));
    let end = step * f64::from(count);
    let damping = 0.02;
    let base = |t: f64| match t < end {
        true => [between(&record, t), (between(&record, t + 1e-7) - between(&record, t)) / 1e-7],
        false => [record.samples[count as usize][1], 0.0],
    };
    let (mut s, mut peak) = ([0.0; 4], 0.0_f64);
    for k in 0..20_000 {
        // In the middle of a step, on one side of every kink.
        let t = f64::from(k) * 1e-3;
        let [z, u] = base(t + 0.5e-3);
        let fixed = |s: [f64; 4], at: f64| {
            let z = z + u * (at - t - 0.5e-3);
            [s[1], -(s[0] - z) - damping * (s[1] - u), 0.0, 0.0]
        };
        s = runge_kutta(s, t, 1e-3, &fixed);
        peak = peak.max((s[0] - base(t + 1e-3)[0]).abs());
    }
    let found = driven(
        &system(0.05, damping / 0.05, 0.6),
        None,
        &record.pieces_to_rest(&UNITS, Record::LONGEST),
        false,
    );
    assert!((found.peak / peak - 1.0).abs() < 1e-5, "{} {peak}", found.peak);
}

/// Nothing takes the energy of a structure without damping whose walls are elastic: what may come is told.
#[test]
fn a_motion_without_loss_is_given_up_and_says_so() {
    let blow = PULSES[0].record();
    let pieces = blow.pieces_to_rest(&UNITS, Record::LONGEST);
    let elastic = follow(&system(0.05, 0.0, 1.0), &pieces, 0.3).expect("followed");
    assert!((elastic.rang / (1000.0 * TAU) - 1.0).abs() < 1e-3, "{}", elastic.rang);
    let energy = elastic.work - elastic.impact_loss;
    let most = (2.0 * energy).sqrt();
    assert!(elastic.open >= 0.0 && (elastic.peak + elastic.open) > 0.999 * most, "{most}");
    // Where impacts take energy, an undamped structure is as good as any.
    let found = follow(&system(0.05, 0.0, 0.6), &pieces, 0.3).expect("followed");
    assert_eq!(found.open, 0.0);
}

/// Structure alone and with a damper against the same integration.
#[test]
fn what_does_not_rattle_is_integrated_without_error() {
    let (eps, lambda) = (0.05, 0.4);
    let damper = TunedMassDamper::den_hartog(eps);
    for quantity in [RecordQuantity::Force, RecordQuantity::BaseAcceleration] {
        let shakes = quantity == RecordQuantity::BaseAcceleration;
        let record = record(quantity, 0.35, 100, quake);
        let sign = if shakes { -1.0 } else { 1.0 };
        for damper in [None, Some(&damper)] {
            let [spring, dashpot] = damper
                .map_or([0.0; 2], |of| [of.tuning * of.tuning, 2.0 * of.damping_ratio * of.tuning]);
            let force = |t: f64| sign * between(&record, t);
            let rate = |s: [f64; 4], t: f64| {
                let force = force(t);
                let pull = spring * (s[0] - s[2]) + dashpot * (s[1] - s[3]);
                let own = force - s[0] - eps * lambda * s[1] - eps * pull;
                [s[1], own, s[3], pull + if shakes { force } else { 0.0 }]
            };
            let (mut s, mut peak) = ([0.0; 4], 0.0_f64);
            // Velocity of the base, largest absolute velocity and acceleration, and the integrals of their squares.
            let (mut base, mut peaks, mut squares) = (0.0, [0.0_f64; 2], [0.0; 2]);
            for k in 0..35_000 {
                let t = f64::from(k) * 1e-3;
                s = runge_kutta(s, t, 1e-3, &rate);
                peak = peak.max(s[0].abs());
                let [before, after] = [t, t + 1e-3].map(|t| if shakes { force(t) } else { 0.0 });
                base -= 0.5e-3 * (before + after);
                let absolute = [s[1] + base, rate(s, t + 1e-3)[1] - after];
                for k in 0..2 {
                    peaks[k] = peaks[k].max(absolute[k].abs());
                    squares[k] += 1e-3 * absolute[k] * absolute[k];
                }
            }
            let pieces = record.pieces(&UNITS, Record::LONGEST);
            let found = driven(&system(eps, lambda, 0.6), damper, &pieces, true);
            // Exact at ends of pieces; the peak by cubics, 0.2^4/384 of it.
            assert!((last(&found) - s[0]).abs() < 1e-10, "{quantity:?}");
            assert!((found.peak - peak).abs() < 5e-6 * peak, "{} {peak}", found.peak);
            // The integration is read at the ends of its steps: the largest between them, and the first and last of a sum.
            let told = found.shaking.expect("asked for");
            let [rms_velocity, rms_acceleration] = squares.map(|one| f64::sqrt(one / 35.0));
            for (found, exact) in [
                (told.peak_velocity, peaks[0]),
                (told.peak_acceleration, peaks[1]),
                (told.rms_velocity, rms_velocity),
                (told.rms_acceleration, rms_acceleration),
            ] {
                assert!((found / exact - 1.0).abs() < 3e-5, "{quantity:?} {found} {exact}");
            }
        }
    }
}

/// A force that begins at once: `x = f (1 - exp(-zeta tau)(cos nu tau + zeta/nu sin nu tau))`.
#[test]
fn a_sudden_force_swings_to_twice_its_displacement() {
    let zeta: f64 = 0.01;
    let record = record(RecordQuantity::Force, 7.0, 2, |_| 0.3);
    let found = driven(
        &system(0.01, 2.0 * zeta / 0.01, 0.6),
        None,
        &record.pieces(&UNITS, Record::LONGEST),
        false,
    );
    let exact = 0.3 * (1.0 + libm::exp(-PI * zeta / (1.0 - zeta * zeta).sqrt()));
    assert!((found.peak / exact - 1.0).abs() < 5e-6, "{} {exact}", found.peak);
    // The mean square of the same over 14, from its antiderivative by Simpson's rule.
    let nu = (1.0 - zeta * zeta).sqrt();
    let x = |t: f64| {
        0.3 * (1.0 - libm::exp(-zeta * t) * (libm::cos(nu * t) + zeta / nu * libm::sin(nu * t)))
    };
    let weight = |k: u32| if k == 0 || k == 2000 { 1.0 } else { f64::from(2 + 2 * (k % 2)) };
    let squared = |t: f64| x(t) * x(t);
    let square: f64 = (0..=2000).map(|k| weight(k) * squared(0.007 * f64::from(k))).sum();
    let rms = (square * 0.007 / 3.0 / 14.0).sqrt();
    assert!((found.rms / rms - 1.0).abs() < 5e-6, "{} {rms}", found.rms);
}

/// A sine of many samples is the engine's own harmonic drive. Straight lines between `n` samples of a period have
/// `(sin(pi/n)/(pi/n))^2` of its amplitude, and else only harmonics near the `n`-th, of order `1/n^2`.
#[test]
fn a_sampled_sine_is_the_harmonic_drive() {
    let (omega, amplitude, periods, samples) = (0.97, 0.6, 6, 400);
    let period = TAU / omega;
    let part = PI / f64::from(samples);
    let kept = libm::sin(part) / part * (libm::sin(part) / part);
    let eps = 0.05;
    for excitation in [Excitation::Force, Excitation::BaseDisplacement] {
        let base = excitation == Excitation::BaseDisplacement;
        let harmonic = System::new(Parameters {
            mass_ratio: eps,
            damping: 0.4,
            restitution: 0.6,
            frequency_ratio: omega,
            forcing_per_clearance: amplitude * kept / eps,
            excitation,
            cavity: Cavity::IDEAL,
        });
        // Structure and absorber begin with the velocity of the base, which is against it none.
        let velocity = if base { amplitude * kept * omega } else { 0.0 };
        let start = State { x: 0.0, x_velocity: velocity, y: -0.2, y_velocity: velocity };
        let mut simulation =
            Simulation::new(&harmonic.expect("valid"), start, 0.0).expect("inside");
        simulation.run(periods, u64::MAX, &mut ());
        let (quantity, factor) = match base {
            true => (RecordQuantity::BaseAcceleration, -omega * omega),
            false => (RecordQuantity::Force, 1.0),
        };
        let step = period / f64::from(samples);
        let count = samples * u32::try_from(periods).expect("few");
        let record = record(quantity, step, count, |t| factor * amplitude * libm::sin(omega * t));
        let found = follow(&WALLS.system(), &record.pieces(&UNITS, Record::LONGEST), 0.2);
        let found = found.expect("followed");
        assert_eq!(found.impacts, simulation.impacts());
        // At the end of a period the base is where it began.
        let error = last(&found) - simulation.state().x;
        assert!(error.abs() < 2e-4 && found.impacts > 8, "{excitation:?} {error}");
    }
}

/// Halving the pieces changes nothing that a page shows, and the energy is all accounted for: with short pieces to
/// 1e-9 of it.
#[test]
fn shorter_pieces_change_nothing_and_no_energy_is_lost() {
    let quantities =
        [RecordQuantity::Force, RecordQuantity::BaseAcceleration, RecordQuantity::BaseDisplacement];
    for quantity in quantities {
        let record = record(quantity, 0.5, 80, quake);
        for r in [0.0, 0.6, 1.0] {
            let of = System3 { r, ..WALLS }.system();
            let flown =
                |longest: f64| follow(&of, &record.pieces(&UNITS, longest), 0.3).expect("followed");
            let [coarse, fine] = [Record::LONGEST, 0.5 * Record::LONGEST].map(flown);
            // Elastic impacts multiply every difference: no two of their flights stay together for long.
            assert!(r == 1.0 || coarse.impacts == fine.impacts, "{quantity:?} {r}");
            for (a, b) in [(coarse.peak, fine.peak), (coarse.rms, fine.rms)] {
                assert!(r == 1.0 || (a / b - 1.0).abs() < 1e-5, "{quantity:?} {r}: {a} {b}");
            }
            // Cubics leave the damper's loss an error of h^4/360.
            for (found, most) in [(coarse, 1e-5), (flown(0.01), 1e-9)] {
                let taken = found.damping_loss + found.impact_loss + found.stored;
                let error = taken / found.work - 1.0;
                assert!(error.abs() < most, "{quantity:?} {r} {most}: {error}");
                assert!((r == 1.0) == (found.impact_loss < 1e-9 * found.work));
            }
        }
    }
}

/// The same shaking as an acceleration and as a displacement. Far away from where displacements are counted, nothing
/// is lost: the absorber's place within its cavity is no difference of large numbers.
#[test]
fn acceleration_and_displacement_say_the_same() {
    let (rate, height) = (0.9, 1.5);
    let shift = |t: f64| height * (1.0 - libm::cos(rate * t));
    let push = |t: f64| height * rate * rate * libm::cos(rate * t);
    let of = WALLS.system();
    let flown = |record: Record| {
        follow(&of, &record.pieces(&UNITS, Record::LONGEST), 0.3).expect("followed")
    };
    let accelerated = flown(record(RecordQuantity::BaseAcceleration, 0.01, 2000, push));
    let displaced = |from: f64| {
        flown(record(RecordQuantity::BaseDisplacement, 0.01, 2000, |t| from + shift(t)))
    };
    let (near, far) = (displaced(0.0), displaced(1e5));
    assert_eq!((near.impacts, far.impacts), (accelerated.impacts, accelerated.impacts));
    // Steps of the velocity instead of a slope: half a step of time late, 0.005.
    assert!((near.peak / accelerated.peak - 1.0).abs() < 0.01);
    // The samples themselves lose 1e5 * 2^-53 over a step of 0.01.
    assert!((near.peak - far.peak).abs() < 1e-7, "{} {}", near.peak, far.peak);
}

const WHITE: Spectrum =
    Spectrum { corners: Vec::new(), duration: 400.0, seed: 7, realisations: 60 };

/// White noise of the base's acceleration, one-sided density `S` in Hz: `sigma^2 = S/(8 zeta omega0^3)`, from rest by
/// `1 - exp(-2 zeta tau)` of it, which over a time `T` is `1 - 1/(2 zeta T)` on average.
#[test]
fn noise_of_a_spectrum_shakes_as_it_must() {
    let zeta = 0.05;
    let spectrum = Spectrum { corners: vec![[0.01, 0.3], [1.0, 0.3]], ..WHITE };
    let of = system(0.05, 2.0 * zeta / 0.05, 0.6);
    let (mut inputs, mut squares) = (Vec::new(), Vec::new());
    for record in spectrum.records(RecordQuantity::BaseAcceleration) {
        let sum: f64 = record.samples.iter().map(|sample| sample[1] * sample[1]).sum();
        inputs.push(sum / record.samples.len() as f64);
        let found = driven(&of, None, &record.pieces(&UNITS, Record::LONGEST), false);
        squares.push(found.rms * found.rms);
    }
    let built_up = 1.0 - 1.0 / (2.0 * zeta * spectrum.duration);
    // Frequencies below 0.01 Hz and above 1 Hz are left out, straight lines take 0.6 % at the highest: within 1 %.
    for (found, exact) in [(&inputs, 0.3 * 0.99), (&squares, 0.3 / (8.0 * zeta) * built_up)] {
        let count = found.len() as f64;
        let mean = found.iter().sum::<f64>() / count;
        let scatter =
            found.iter().map(|one| (one - mean) * (one - mean)).sum::<f64>() / (count - 1.0);
        let error = 3.0 * (scatter / count).sqrt();
        assert!(error < 0.1 * exact, "{error} {exact}");
        assert!((mean - exact).abs() < error + 0.02 * exact, "{mean} {exact} {error}");
    }
}

#[test]
fn a_seed_names_its_records() {
    let short = Spectrum { corners: vec![[0.1, 0.3], [1.0, 0.03]], duration: 50.0, ..WHITE };
    let first = |spectrum: &Spectrum| {
        spectrum.records(RecordQuantity::Force).take(2).collect::<Vec<Record>>()
    };
    assert_eq!(first(&short), first(&short));
    assert_ne!(first(&short), first(&Spectrum { seed: 8, ..short.clone() }));
    assert_ne!(first(&short)[0], first(&short)[1]);
    // Straight on logarithmic scales: 1/10 over a decade.
    assert!((short.density(0.1_f64.sqrt()) / 0.3 - 0.1_f64.sqrt()).abs() < 1e-12);
}

/// The study's numbers are those of its parts, and the structure of the case is one of its response spectrum.
#[test]
fn the_worst_place_counts() {
    let record = record(RecordQuantity::BaseAcceleration, 0.25, 160, quake);
    let of = WALLS.system();
    let places = Places { even: 8, closer: true, shaking: false, executor: &Serial };
    let records = std::slice::from_ref(&record);
    let study = RecordStudy::of(&of, &UNITS.into(), records, places, true);
    let study = study.expect("studied");
    let pieces = record.pieces_to_rest(&UNITS, Record::LONGEST);
    let from = |w: f64| follow(&of, &pieces, w).expect("followed").peak;
    let flown: Vec<(f64, f64)> =
        study.realisations[0].places.all.iter().map(|(w, found)| (*w, found.peak)).collect();
    // Even places, then closer ones; none is a number of another place.
    assert_eq!((study.realisations[0].places.even, flown.len()), (8, 12));
    for (k, (w, peak)) in flown.iter().enumerate() {
        assert_eq!(*peak, from(*w));
        assert!(k >= 8 || *w == (2 * k + 1) as f64 / 8.0 - 1.0, "{w}");
    }
    let worst = worst_of_places(&flown.iter().map(|one| one.1).collect::<Vec<f64>>());
    let all = Study::Record(Box::new(study.clone()));
    let ask = |of| all.ask(of, Device::Absorber).expect("flown").value;
    assert_eq!(ask(Measure::Peak), worst);
    assert_eq!(worst[0], flown.iter().map(|one| one.1).fold(0.0, f64::max));
    let even = flown[..8].iter().map(|one| one.1).fold(0.0, f64::max);
    let bare = driven(&of, None, &pieces, false).peak;
    let own = study.spectrum.iter().find(|point| point.ratio == 1.0).expect("its own frequency");
    assert_eq!((own.bare, own.absorber), (bare, even));
    let [reduction, _] = ask(Measure::ReductionDb);
    assert!((reduction - 20.0 * libm::log10(bare / worst[0])).abs() < 1e-12);
    // Twice as stiff a structure in the same units of SI: time runs sqrt(2) times as fast.
    let stiff = Scales { natural_frequency: study.spectrum[20].ratio, ..UNITS };
    let stiff = driven(&of, None, &record.pieces_to_rest(&stiff, Record::LONGEST), false).peak;
    assert_eq!(study.spectrum[20].bare, stiff);
}
