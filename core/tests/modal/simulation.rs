//! The engine for several modes and absorbers.

use vinesink_core::simulation::{
    Detail, Impact, ModalImpact, ModalMeter, ModalObserver, ModalSegment, ModalSimulation,
    Observer, Reading, Sensor, Simulation, Stop,
};
use vinesink_core::system::{ModalAbsorber, ModalParameters, ModalState, ModalSystem, Mode, State};

use super::cases::{EPS, mode, one_by_one, system, table1, two_by_two};

/// A number from 0 to 1 that looks random.
pub struct Noise(pub u64);

impl Noise {
    pub fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
    pub fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }
}

/// A structure of modes and absorbers that meet their walls often.
pub fn random(noise: &mut Noise, modes: usize, absorbers: usize) -> ModalSystem {
    let mut frequency = 1.0;
    let spread = if modes > 3 { 1.6 } else { 4.0 };
    let modes = (0..modes).map(|k| {
        let shape: Vec<f64> = (0..absorbers).map(|_| noise.between(-1.0, 1.0)).collect();
        let forcing =
            noise.between(0.05, 0.3) * if k == 0 { 1.0 } else { noise.between(-1.0, 1.0) };
        let numbers = [frequency, noise.between(0.002, 0.03), noise.between(0.5, 2.0), forcing];
        frequency *= noise.between(1.3, spread);
        mode(numbers, &shape)
    });
    let modes: Vec<Mode> = modes.collect();
    let absorbers: Vec<[f64; 3]> = (0..absorbers)
        .map(|_| [noise.between(0.002, 0.1), noise.between(0.3, 3.0), noise.between(0.3, 0.95)])
        .collect();
    system(noise.between(0.9, 1.1), modes, &absorbers)
}

fn start(noise: &mut Noise, system: &ModalSystem) -> ModalState {
    let mut state = ModalState::AT_REST;
    for (k, _) in system.modes().iter().enumerate() {
        state.modes[k] = [noise.between(-1.0, 1.0), noise.between(-1.0, 1.0)];
    }
    for (j, absorber) in system.absorbers().iter().enumerate() {
        let modes = system.modes().iter().zip(&state.modes);
        let x: f64 = modes.map(|(mode, [q, _])| mode.shape[j] * q).sum();
        let gap = noise.between(-0.9, 0.9) * absorber.clearance;
        state.absorbers[j] = [x - gap, noise.between(-1.0, 1.0)];
    }
    state
}

/// Impacts, and how often a chattering sequence ended.
#[derive(Default)]
struct Log(Vec<ModalImpact>, u64);

impl ModalObserver for Log {
    fn detail(&self) -> Detail {
        Detail::Events
    }
    fn impact(&mut self, impact: &ModalImpact) {
        self.0.push(*impact);
    }
    fn sticks(&mut self, _: usize, _: f64) {
        self.1 += 1;
    }
}

#[derive(Default)]
struct One(Vec<Impact>);

impl Observer for One {
    fn impact(&mut self, impact: &Impact) {
        self.0.push(*impact);
    }
}

/// Regular motions, 1:1 and others, in units of another length.
#[test]
fn one_mode_and_one_absorber_move_as_in_the_engine_for_these() {
    for (parameters, periods) in [
        ([EPS, 1.799, 0.6, 1.0181, 1.6], 400),
        ([EPS, 1.799, 0.6, 0.958, 4.34], 400),
        ([0.05, 1.0, 0.5, 1.01, 1.5], 200),
        ([EPS, 1.799, 0.6, 0.958, 5.5], 60),
        ([EPS, 1.799, 0.6, 0.958, 8.14], 60),
    ] {
        let clearance = 3.7;
        let (one, several) = one_by_one(parameters, clearance);
        let from = State { x: 0.3, x_velocity: -0.2, y: 0.1, y_velocity: 0.9 };
        let mut settled = Simulation::new(&one, from, 0.0).expect("inside");
        settled.run(6000, u64::MAX, &mut ());
        let from = settled.state();
        let mut simulation = Simulation::new(&one, from, 0.0).expect("inside");
        let mut state = ModalState::AT_REST;
        state.modes[0] = [from.x, from.x_velocity].map(|value| value * clearance);
        state.absorbers[0] = [from.y, from.y_velocity].map(|value| value * clearance);
        let mut modal = ModalSimulation::new(&several, &state, 0.0).expect("inside");
        let (mut seen, mut log) = (One::default(), Log::default());
        simulation.run(periods, u64::MAX, &mut seen);
        modal.run(periods, u64::MAX, &mut log);
        assert_eq!(simulation.impacts(), modal.impacts(), "{parameters:?}");
        assert!(simulation.impacts() > periods / 2, "{parameters:?}");
        let (a, b) = (simulation.state(), modal.state());
        let off = (a.x - b.modes[0][0] / clearance).abs()
            + (a.x_velocity - b.modes[0][1] / clearance).abs()
            + (a.y - b.absorbers[0][0] / clearance).abs()
            + (a.y_velocity - b.absorbers[0][1] / clearance).abs();
        assert!(off < 1e-9, "{parameters:?}: {off:e}");
        for (one, other) in seen.0.iter().zip(&log.0) {
            assert!((one.tau - other.tau).abs() < 1e-9, "{one:?} {other:?}");
            let scale = clearance * clearance;
            assert!((one.loss - other.loss / scale).abs() < 1e-9 && one.side == other.side);
            assert!((one.x_velocity_after - other.x_velocity[1] / clearance).abs() < 1e-9);
            assert!((one.y_velocity_before - other.y_velocity[0] / clearance).abs() < 1e-9);
        }
    }
}

/// Work of the forces, loss of the dampers, and losses of impacts and of what comes to rest on walls.
pub struct Balance {
    system: ModalSystem,
    rule: Vec<(f64, f64)>,
    pub added: f64,
    pub turned_over: f64,
    resting: f64,
    /// How far beyond a wall, over the clearance.
    pub beyond: f64,
    pub sticks: u64,
}

impl Balance {
    pub fn of(system: &ModalSystem) -> Self {
        let rule = vinesink_core::numerics::gauss::uniform(10);
        let [added, turned_over, resting, beyond] = [0.0; 4];
        Self { system: system.clone(), rule, added, turned_over, resting, beyond, sticks: 0 }
    }
}

impl ModalObserver for Balance {
    fn segment(&mut self, segment: &ModalSegment<'_>) {
        let frequencies = self.system.modes().iter().map(|mode| mode.frequency);
        let fastest = frequencies.fold(self.system.frequency_ratio().max(1.0), f64::max);
        let pieces = (segment.duration * 1.5 * fastest).ceil();
        let h = segment.duration / pieces;
        for piece in 0..pieces as u32 {
            for (node, weight) in &self.rule {
                let s = h * (f64::from(piece) + 0.5 * (1.0 + node));
                let state = segment.at(s);
                for (j, absorber) in self.system.absorbers().iter().enumerate() {
                    let modes = self.system.modes().iter().zip(&state.modes);
                    let x: f64 = modes.map(|(mode, [q, _])| mode.shape[j] * q).sum();
                    let gap = (x - state.absorbers[j][0]).abs() / absorber.clearance;
                    self.beyond = self.beyond.max(gap - 1.0);
                }
                let force = libm::sin(segment.phase + self.system.frequency_ratio() * s);
                for (mode, [_, v]) in self.system.modes().iter().zip(&state.modes) {
                    let damping = 2.0 * mode.damping_ratio * mode.frequency * v * v;
                    let power = mode.mass * (mode.forcing * force * v - damping);
                    self.added += h * weight * power;
                    self.turned_over += h * weight * power.abs();
                }
            }
        }
        let rests = (0..self.system.absorbers().len()).any(|j| segment.rests(j).is_some());
        self.resting += if rests { segment.duration } else { 0.0 };
    }
    fn impact(&mut self, impact: &ModalImpact) {
        self.added -= impact.loss;
        self.turned_over += impact.loss;
    }
    fn sticks(&mut self, _: usize, loss: f64) {
        self.sticks += 1;
        self.added -= loss;
        self.turned_over += loss;
    }
}

#[test]
fn energy_is_kept_whatever_rests_on_walls() {
    let mut noise = Noise(3);
    let mut resting = 0;
    for (modes, absorbers) in [(1, 1), (1, 3), (2, 2), (3, 1), (2, 4), (5, 2), (8, 8)] {
        for _ in 0..6 {
            let mut parameters = random(&mut noise, modes, absorbers).parameters().clone();
            // Small motions between walls far apart end in chattering and rest.
            parameters.modes.iter_mut().for_each(|mode| mode.forcing *= noise.between(0.1, 2.0));
            parameters.absorbers.iter_mut().for_each(|one| one.restitution *= noise.next());
            let system = ModalSystem::new(parameters).expect("valid");
            let from = start(&mut noise, &system);
            let mut simulation = ModalSimulation::new(&system, &from, 1.0).expect("inside");
            let begin = simulation.energy();
            let mut balance = Balance::of(&system);
            let stop = simulation.run(12, 20_000, &mut balance);
            assert_eq!(stop, Stop::EndTime);
            let off = (simulation.energy() - begin - balance.added).abs();
            let scale = begin + balance.turned_over;
            assert!(off < 1e-11 * scale, "{modes} {absorbers}: {off:e} of {scale}");
            resting += usize::from(balance.resting > 0.1);
        }
    }
    assert!(resting > 8, "{resting}");
}

/// Against the search that goes step by step, flight by flight from the same state: the same absorber, the same wall, the same
/// instant. `VINESINK_FLIGHTS=1000000` compares as many of each size.
#[test]
fn no_impact_is_missed() {
    let wanted = std::env::var("VINESINK_FLIGHTS").ok().and_then(|text| text.parse().ok());
    let wanted = wanted.unwrap_or(100_000);
    let mut noise = Noise(11);
    for (modes, absorbers) in [(2, 2), (3, 1), (1, 3)] {
        let (mut compared, mut resting, mut ties, mut worst) = (0, 0, 0, 0.0_f64);
        while compared < wanted {
            let system = random(&mut noise, modes, absorbers);
            let from = start(&mut noise, &system);
            let mut fast = ModalSimulation::new(&system, &from, 0.3).expect("inside");
            for _ in 0..60 {
                let mut slow = fast.clone().step_by_step();
                let (mut a, mut b) = (Log::default(), Log::default());
                fast.run(1, 1, &mut a);
                slow.run(1, 1, &mut b);
                if a.1 + b.1 > 0 {
                    // Where a chattering sequence is cut off rounding decides.
                    resting += 1;
                    continue;
                }
                assert_eq!(a.0.len(), b.0.len(), "{system:?}");
                for (one, other) in a.0.iter().zip(&b.0) {
                    let apart = (one.tau - other.tau).abs();
                    if (one.absorber, one.side) != (other.absorber, other.side) {
                        // Two at one instant, of which rounding decides which is first.
                        assert!(apart < 1e-13, "{one:?} {other:?}");
                        ties += 1;
                        continue;
                    }
                    // What is left of the gap is rounding of the lengths, here up to some tens.
                    let speed = (one.x_velocity[0] - one.y_velocity[0]).abs();
                    worst = worst.max(apart * speed);
                    assert!(apart * speed < 1e-12, "{one:?} {other:?}");
                }
                compared += a.0.len();
            }
        }
        println!(
            "{modes} {absorbers}: {compared} impacts, {resting} sequences, {ties} ties, gap {worst:.1e}"
        );
        assert!(ties * 10_000 <= compared && 5 * resting < compared);
    }
}

/// First harmonics of published and independent programs: see `theory.rs` and `orbits.rs` for the same systems.
#[test]
fn from_rest_the_table_one_cases_settle_on_their_amplitudes() {
    struct Harmonic(f64, f64, f64);
    impl ModalObserver for Harmonic {
        fn segment(&mut self, segment: &ModalSegment<'_>) {
            let pieces = (segment.duration * 4.0).ceil();
            let h = segment.duration / pieces;
            for piece in 0..pieces as u32 {
                for (node, weight) in vinesink_core::numerics::gauss::uniform(8) {
                    let s = h * (f64::from(piece) + 0.5 * (1.0 + node));
                    let (sin, cos) = libm::sincos(segment.phase + super::cases::OMEGA * s);
                    let [q, _] = segment.at(s).modes[0];
                    self.0 += h * weight * q * sin;
                    self.1 += h * weight * q * cos;
                }
            }
            self.2 += segment.duration;
        }
    }
    for (absorbers, expected) in [
        (vec![[EPS, 20.0, 0.6]], 3.57662),
        (vec![[0.5 * EPS, 20.0, 0.6], [0.5 * EPS, 10.0, 0.6]], 3.85679),
        (vec![[0.3 * EPS, 20.0, 0.6], [0.3 * EPS, 12.0, 0.7], [0.4 * EPS, 8.0, 0.5]], 4.00972),
    ] {
        let system = table1(&[], &absorbers);
        let mut from = ModalState::AT_REST;
        from.modes[0] = [0.0, 4.0];
        from.absorbers = [[0.0, 12.0]; 8];
        let mut simulation = ModalSimulation::new(&system, &from, 0.0).expect("inside");
        simulation.run(3000, u64::MAX, &mut ());
        let mut harmonic = Harmonic(0.0, 0.0, 0.0);
        simulation.run(200, u64::MAX, &mut harmonic);
        let amplitude = 2.0 * libm::hypot(harmonic.0, harmonic.1) / harmonic.2;
        assert!((amplitude - expected).abs() < 1e-4, "{absorbers:?}: {amplitude} {expected}");
    }
}

/// Displacement, velocity and acceleration at a place, and their largest and mean squares, from many states.
#[derive(Default)]
struct Samples {
    base: [f64; 2],
    peaks: [f64; 3],
    sums: [f64; 3],
    time: f64,
    /// How long an absorber was held.
    held: f64,
}

impl ModalObserver for Samples {
    fn segment(&mut self, segment: &ModalSegment<'_>) {
        let ([z, omega], pieces) = (self.base, (segment.duration * 400.0).ceil());
        let h = segment.duration / pieces;
        let seen = |s: f64| {
            let ([q, p, ..], phase) = (segment.at(s).modes, segment.phase + omega * s);
            let x = q[0] - 0.4 * p[0] + z * libm::sin(phase);
            [x, q[1] - 0.4 * p[1] + z * omega * libm::cos(phase)]
        };
        for piece in 0..=pieces as u32 {
            let s = h * f64::from(piece);
            // Not beyond an end, where another flight begins.
            let middle = s.clamp(1e-5_f64.min(0.5 * h), segment.duration - 1e-5_f64.min(0.5 * h));
            let e = 1e-5_f64.min(0.5 * h);
            let slope = (seen(middle + e)[1] - seen(middle - e)[1]) / (2.0 * e);
            let [x, v] = seen(s);
            let weight = if piece == 0 || f64::from(piece) == pieces { 0.5 } else { 1.0 };
            for (n, value) in [x, v, slope].into_iter().enumerate() {
                self.peaks[n] = self.peaks[n].max(value.abs());
                self.sums[n] += h * weight * value * value;
            }
        }
        self.time += segment.duration;
        self.held += if segment.rests(0).is_some() { segment.duration } else { 0.0 };
    }
}

/// Peaks and mean squares against many samples, in flights and while an absorber rests on a wall of a structure whose base moves.
#[test]
fn the_meter_measures_what_samples_approach() {
    let (mut held, mut time) = (0.0, 0.0);
    for k in 0..8 {
        let mut noise = Noise(k);
        let (z, omega) = (if k < 6 { 0.0 } else { 0.3 }, 1.1);
        let system = match k {
            0 => two_by_two('A'),
            1 => two_by_two('B'),
            2..6 => random(&mut noise, 2, 2),
            _ => ModalSystem::new(ModalParameters {
                modes: vec![
                    Mode { participation: 1.3, ..mode([1.0, 0.01, 1.0, 0.0], &[1.0]) },
                    Mode { participation: -0.4, ..mode([2.7, 0.02, 1.0, 0.0], &[-0.8]) },
                ],
                absorbers: vec![ModalAbsorber { mass: 0.1, clearance: 0.05, restitution: 0.1 }],
                frequency_ratio: omega,
                base_amplitude: z,
            })
            .expect("valid"),
        };
        let from = start(&mut noise, &system);
        let mut simulation = ModalSimulation::new(&system, &from, 0.0).expect("inside");
        // Each as it is, and times three.
        let sensors =
            [Reading::Displacement, Reading::Velocity, Reading::Acceleration].into_iter().flat_map(
                |reads| [1.0, 3.0].map(|scale| Sensor { shape: vec![1.0, -0.4], reads, scale }),
            );
        let meter = ModalMeter::new(&system, &sensors.collect::<Vec<_>>());
        let mut both = (meter, Samples { base: [z, omega], ..Samples::default() });
        simulation.run(20, 20_000, &mut both);
        let (records, samples) = (both.0.records(), both.1);
        for (n, pair) in records.chunks(2).enumerate() {
            let (peak, mean) = (samples.peaks[n], samples.sums[n] / samples.time);
            // A sample is off by at most an eighth of the second derivative times the squared step; accelerations at ends of flights
            // are differences a little inside.
            let off = pair[0].peak / peak - 1.0;
            assert!((-1e-6..3e-4).contains(&off), "{k}, {n}: {pair:?} {peak}");
            assert!((pair[0].mean_square / mean - 1.0).abs() < 3e-4, "{k}, {n}: {pair:?} {mean}");
            assert!((pair[1].peak / pair[0].peak - 3.0).abs() < 1e-11, "{pair:?}");
            assert!((pair[1].mean_square / pair[0].mean_square - 9.0).abs() < 1e-11, "{pair:?}");
        }
        (held, time) = (held + samples.held, time + samples.time);
    }
    assert!(held > 0.02 * time, "held for {held} of {time}");
}

/// Squares of a displacement and its velocity, integrated in pieces by a rule of eight nodes, in flights.
struct Integrals {
    shape: Vec<f64>,
    sums: [f64; 2],
    time: f64,
}

impl ModalObserver for Integrals {
    fn segment(&mut self, segment: &ModalSegment<'_>) {
        // Abscissae and weights of Gauss and Legendre (Abramowitz and Stegun, table 25.4).
        const RULE: [[f64; 2]; 4] = [
            [0.183_434_642_495_649_8, 0.362_683_783_378_362],
            [0.525_532_409_916_329, 0.313_706_645_877_887_3],
            [0.796_666_477_413_626_7, 0.222_381_034_453_374_5],
            [0.960_289_856_497_536_2, 0.101_228_536_290_376_3],
        ];
        let pieces = (8.0 * segment.duration).ceil();
        let half = 0.5 * segment.duration / pieces;
        for piece in 0..pieces as u32 {
            let middle = half * f64::from(2 * piece + 1);
            for ([node, weight], side) in RULE.iter().flat_map(|one| [(one, -1.0), (one, 1.0)]) {
                let modes = segment.at(middle + side * node * half).modes;
                for (n, sum) in self.sums.iter_mut().enumerate() {
                    let each = self.shape.iter().zip(&modes);
                    let read: f64 = each.map(|(phi, mode)| phi * mode[n]).sum();
                    *sum += half * weight * read * read;
                }
            }
        }
        self.time += segment.duration;
    }
}

/// Mean squares against integrals of states, where products of phasors turn slowly too: of a mode without damping, and of one close to the
/// excitation; of many impacts a period; and of the same meter that began anew.
#[test]
fn mean_squares_are_integrals() {
    let slow = |damping, frequency| {
        let modes = vec![
            mode([1.0, damping, 1.0, 0.01], &[1.0, 0.4]),
            mode([2.3, 0.0, 0.8, 0.1], &[-0.7, 1.0]),
        ];
        system(frequency, modes, &[[0.05, 0.7, 0.6], [0.02, 0.4, 0.3]])
    };
    let structures = [slow(0.0, 0.9996), slow(2e-4, 1.0), slow(0.02, 2.3004), slow(1e-7, 1.1)];
    let drawn = (0..6).map(|k| random(&mut Noise(60 + k), 1 + k as usize % 4, 2));
    for (k, system) in structures.into_iter().chain(drawn).enumerate() {
        let from = start(&mut Noise(k as u64), &system);
        let mut simulation = ModalSimulation::new(&system, &from, 0.0).expect("inside");
        let shape: Vec<f64> =
            [1.0, -0.6, 0.3, 0.8].into_iter().take(system.modes().len()).collect();
        let sensors = [Reading::Displacement, Reading::Velocity]
            .map(|reads| Sensor { reads, ..Sensor::displacement(shape.clone()) });
        let mut meter = ModalMeter::new(&system, &sensors);
        simulation.run(5, 20_000, &mut meter);
        meter.taken();
        let mut both = (meter, Integrals { shape, sums: [0.0; 2], time: 0.0 });
        simulation.run(40, 40_000, &mut both);
        for (n, record) in both.0.records().iter().enumerate() {
            let mean = both.1.sums[n] / both.1.time;
            // Rounding of both. At a resonance of little damping the free and the steady motion are each up to a hundred times what is
            // left of their sum.
            let off = record.mean_square / mean - 1.0;
            assert!(off.abs() < 1e-10, "{k}, {n}: {off}");
        }
    }
}

/// A base that moves, in relative coordinates, is the base of the model with one mode but for its damper's own term.
#[test]
fn a_base_that_moves_is_a_force_in_relative_coordinates() {
    let (omega, zeta, z) = (0.97, 0.01, 0.4);
    let absorber = ModalAbsorber { mass: 0.02, clearance: 5.0, restitution: 0.6 };
    let modes = |forcing, participation| {
        vec![Mode { forcing, participation, ..mode([1.0, zeta, 1.0, 0.0], &[1.0]) }]
    };
    let with = |modes, base_amplitude| {
        let absorbers = vec![absorber];
        let parameters =
            ModalParameters { modes, absorbers, frequency_ratio: omega, base_amplitude };
        ModalSystem::new(parameters).expect("valid")
    };
    let moved = with(modes(0.0, 1.0), z);
    // x = q + z has x'' + 2 zeta x' + x = z + 2 zeta z'; without the second term the steady motions differ by little.
    let forced = with(modes(z, 0.0), 0.0);
    let (a, b) = (moved.steady_motion_at(0).amplitude(), forced.steady_motion_at(0).amplitude());
    assert!((a / b - (1.0 + 4.0 * zeta * zeta * omega * omega).sqrt()).abs() < 1e-12, "{a} {b}");
    let mut one = ModalSimulation::new(&moved, &ModalState::AT_REST, 0.0).expect("inside");
    let mut log = Log::default();
    one.run(300, u64::MAX, &mut log);
    assert!(log.0.len() > 300, "{}", log.0.len());
    for impact in &log.0 {
        // Momentum over the impact.
        let taken = impact.x_velocity[0] - impact.x_velocity[1];
        let given = impact.y_velocity[1] - impact.y_velocity[0];
        assert!((taken - 0.02 * given).abs() < 1e-12);
    }
}

/// What happens at one instant happens in the order of the absorbers.
#[test]
fn impacts_at_one_instant_are_in_the_order_of_the_absorbers() {
    let modes = vec![mode([1.0, 0.01, 1.0, 0.0], &[1.0, 1.0])];
    let system = system(0.9, modes, &[[0.3, 2.0, 0.5], [0.3, 2.0, 0.5]]);
    let mut from = ModalState::AT_REST;
    from.absorbers[0] = [0.0, 1.0];
    from.absorbers[1] = [0.0, 1.0];
    let mut simulation = ModalSimulation::new(&system, &from, 0.0).expect("inside");
    let mut log = Log::default();
    simulation.run(1, 2, &mut log);
    assert_eq!(log.0.len(), 2);
    assert_eq!([log.0[0].absorber, log.0[1].absorber], [0, 1]);
    assert_eq!(log.0[0].tau, log.0[1].tau);
    assert!((log.0[0].tau - 2.0).abs() < 1e-14);
    // The second meets a structure that the first has set in motion.
    assert!(log.0[1].x_velocity[0] == log.0[0].x_velocity[1] && log.0[1].loss < log.0[0].loss);
}
