//! Absorbers that rest on walls.

use vinesink_core::simulation::{
    AbsorberMotion, ModalObserver, ModalSegment, ModalSimulation, Observer, Segment, Simulation,
    Stop,
};
use vinesink_core::system::{ModalState, State};

use super::cases::{mode, one_by_one, system};
use super::simulation::{Balance, Noise};

/// Stretches on a wall, from the beginning of the first to that of the next flight: times since phase 0 of the first period.
#[derive(Default)]
struct Rests(Vec<[f64; 2]>, f64);

impl Rests {
    fn add(&mut self, begin: f64, duration: f64, rests: bool) {
        if !rests {
            return;
        }
        match self.0.last_mut() {
            Some(last) if (last[1] - begin).abs() < 1e-9 => last[1] = begin + duration,
            _ => self.0.push([begin, begin + duration]),
        }
    }
    fn begin(turns: u64, phase: f64, omega: f64) -> f64 {
        (turns as f64 * std::f64::consts::TAU + phase) / omega
    }
}

impl Observer for Rests {
    fn segment(&mut self, segment: &Segment) {
        let rests = matches!(segment.absorber, AbsorberMotion::Carried(_));
        self.add(Self::begin(segment.turns, segment.phase, self.1), segment.duration, rests);
    }
}

impl ModalObserver for Rests {
    fn segment(&mut self, segment: &ModalSegment<'_>) {
        let rests = segment.rests(0).is_some();
        self.add(Self::begin(segment.turns, segment.phase, self.1), segment.duration, rests);
    }
}

/// From the end of a chattering sequence, or without one, to the release, as in the engine for one mode.
#[test]
fn one_mode_carries_its_absorber_as_in_the_engine_for_one() {
    let mut compared = 0;
    for k in 0..40 {
        let omega = [0.6, 0.97, 1.3][k % 3];
        let parameters = [[0.01, 0.3][k % 2], 1.0, [0.0, 0.5][k / 2 % 2], omega, 3.0];
        let clearance = 0.7;
        let (one, several) = one_by_one(parameters, clearance);
        let phase = 0.15 * k as f64;
        let (x, v) = (2.0 * libm::sin(2.9 * k as f64), libm::cos(1.7 * k as f64));
        // It stands on a wall, and moves with it.
        let sign = if k % 4 < 2 { 1.0 } else { -1.0 };
        let from = State { x, x_velocity: v, y: x - sign, y_velocity: v };
        let mut state = ModalState::AT_REST;
        state.modes[0] = [x * clearance, v * clearance];
        state.absorbers[0] = [(x - sign) * clearance, v * clearance];
        let mut a = Simulation::new(&one, from, phase).expect("on a wall");
        let mut b = ModalSimulation::new(&several, &state, phase).expect("on a wall");
        let (mut rests_a, mut rests_b) = (Rests(Vec::new(), omega), Rests(Vec::new(), omega));
        a.run(2, 1, &mut rests_a);
        b.run(2, 1, &mut rests_b);
        assert_eq!(rests_a.0.len(), rests_b.0.len(), "{k}: {:?} {:?}", rests_a.0, rests_b.0);
        for (one, other) in rests_a.0.iter().zip(&rests_b.0) {
            assert!(
                (one[0] - other[0]).abs() + (one[1] - other[1]).abs() < 1e-9,
                "{one:?} {other:?}"
            );
            compared += 1;
        }
        let (a, b) = (a.state(), b.state());
        assert!((a.x - b.modes[0][0] / clearance).abs() < 1e-9);
        assert!((a.y_velocity - b.absorbers[0][1] / clearance).abs() < 1e-9);
    }
    assert!(compared > 12, "{compared}");
}

/// A structure of two modes that carries a mass and is driven slowly enough never to let go has the frequencies of the coupled
/// modes: here those of two masses on springs, the second of which has become heavier.
#[test]
fn a_mass_that_rests_couples_the_modes() {
    // Two masses 1 in a chain of three springs 1: modes (1, 1) and (1, -1) over 2 with w^2 = 1 and 3. The absorber of mass m is
    // on the second: then w^4 (1 + m) - w^2 (2 (1 + m) + 2) + 3 = 0, and plastic impacts leave the mass on its wall for long.
    let (m, tiny) = (0.5, 1e-3);
    let modes =
        vec![mode([1.0, 0.0, 2.0, 0.0], &[1.0]), mode([3.0_f64.sqrt(), 0.0, 2.0, 0.0], &[-1.0])];
    let several = system(0.05, modes, &[[m, 50.0, 0.0]]);
    // On the wall, at rest, the second mass pushed towards the wall: it accelerates the absorber until the springs relax.
    let mut state = ModalState::AT_REST;
    state.modes[0][0] = -tiny;
    state.modes[1][0] = tiny;
    state.absorbers[0][0] = -2.0 * tiny - 50.0;
    let mut simulation = ModalSimulation::new(&several, &state, 0.0).expect("on a wall");
    assert!(simulation.rests(0).is_some());
    struct First(Vec<[f64; 2]>);
    impl ModalObserver for First {
        fn segment(&mut self, segment: &ModalSegment<'_>) {
            if segment.rests(0).is_none() || segment.phase > 0.05 * 1.0 {
                return;
            }
            let tau = segment.phase / 0.05;
            for n in 0..5 {
                let s = segment.duration * f64::from(n) / 4.0;
                let at = segment.at(s);
                self.0.push([tau + s, at.modes[0][0] - at.modes[1][0]]);
            }
        }
    }
    let mut first = First(Vec::new());
    simulation.run(1, 1, &mut first);
    assert!(first.0.len() > 5);
    // Displacements (a, b) of the masses: a'' = b - 2 a, (1 + m) b'' = a - 2 b, from a = 0, b = -2 tiny, by their own modes.
    let (p, q) = (2.0 * (1.0 + m) + 2.0, 3.0 * (1.0 + m));
    let root = (p * p - 4.0 * q).sqrt();
    let squares = [(p - root) / (2.0 * (1.0 + m)), (p + root) / (2.0 * (1.0 + m))];
    // b = sum c_i cos(w_i t), a = sum c_i (2 - (1 + m) w_i^2) cos(w_i t).
    let shares = squares.map(|w| 2.0 - (1.0 + m) * w);
    let c0 = -2.0 * tiny * shares[1] / (shares[1] - shares[0]);
    let amplitudes = [c0, -2.0 * tiny - c0];
    for [t, b] in first.0 {
        let exact: f64 = (0..2).map(|i| amplitudes[i] * libm::cos(squares[i].sqrt() * t)).sum();
        assert!((b - exact).abs() < 1e-13 * tiny.max(1.0), "{t}: {b} {exact}");
    }
}

/// Heavy absorbers, plastic, elastic and others, up to eight on up to eight modes: whatever chatters and rests, energy is kept,
/// no wall is passed, and no sequence of touches goes on without end.
#[test]
fn walls_are_kept_and_no_sequence_is_endless() {
    let mut noise = Noise(77);
    let (mut impacts, mut sticks) = (0, 0);
    for _ in 0..200 {
        let count = |noise: &mut Noise| 1 + noise.between(0.0, 8.0) as usize;
        let (modes, absorbers) = (count(&mut noise), count(&mut noise));
        let size = libm::pow(10.0, noise.between(-3.0, 1.0));
        let mut frequency = 1.0;
        let modes = (0..modes).map(|_| {
            let numbers = [
                frequency,
                noise.between(0.0, 0.2) * noise.next(),
                noise.between(0.3, 3.0),
                size * noise.between(-1.0, 1.0),
            ];
            frequency *= noise.between(1.0, 1.7);
            let mut value = || if noise.next() < 0.15 { 0.0 } else { noise.between(-1.0, 1.0) };
            mode(numbers, &(0..absorbers).map(|_| value()).collect::<Vec<_>>())
        });
        let modes: Vec<_> = modes.collect();
        let numbers = (0..absorbers).map(|_| {
            let restitution = [0.0, 1.0, 0.3, 0.6, 0.9, 0.99][(noise.next() * 6.0) as usize];
            let mass = libm::pow(10.0, noise.between(-4.0, 0.3));
            [mass, libm::pow(10.0, noise.between(-1.0, 0.5)), restitution]
        });
        let numbers: Vec<_> = numbers.collect();
        let system = system(noise.between(0.3, 2.5), modes, &numbers);
        let mut state = ModalState::AT_REST;
        for (j, [_, clearance, _]) in numbers.iter().enumerate() {
            let y = noise.between(-0.99, 0.99) * clearance;
            state.absorbers[j] = [y, size * noise.between(-1.0, 1.0)];
        }
        let phase = noise.between(0.0, 6.0);
        let mut simulation = ModalSimulation::new(&system, &state, phase).expect("inside");
        let begin = simulation.energy();
        let mut balance = Balance::of(&system);
        let stop = simulation.run(6, 30_000, &mut balance);
        assert_eq!(stop, Stop::EndTime, "{system:?}");
        let off = (simulation.energy() - begin - balance.added).abs();
        assert!(off < 1e-10 * (begin + balance.turned_over), "{off:e} {system:?}");
        assert!(balance.beyond < 1e-10, "{:e} {system:?}", balance.beyond);
        (impacts, sticks) = (impacts + simulation.impacts(), sticks + balance.sticks);
    }
    assert!(impacts > 10_000 && sticks > 5_000, "{impacts} {sticks}");
}
