//! Cavities with tilt, friction and unequal ends, against an impact pair stepped by hand, against the theory without
//! these, and against closed forms derived by hand.

use std::f64::consts::{PI, TAU};

use vinesink::analysis::{Analysis, Manifold};
use vinesink::cavity::{Cavity, FixedPoint, Forcing, Motion};
use vinesink::equations::cavity as formulas;
use vinesink::system::{Excitation, Parameters, System};

fn cavity(a: f64, f: f64, restitutions: [f64; 2]) -> Cavity {
    Cavity::new(a, f, restitutions).expect("valid")
}

/// An absorber in a cavity that moves by `C sin(t)`: `y'' = a + s f`, `s` the sign of `w'`, 0 while it sticks.
#[derive(Clone, Copy)]
struct Pair {
    cavity: Cavity,
    c: f64,
    t: f64,
    y: f64,
    v: f64,
    s: f64,
}

/// What a period brought.
#[derive(Default)]
struct Period {
    /// Phase, wall and velocity of the absorber after it, of each impact.
    impacts: Vec<[f64; 3]>,
    /// Times at which the relative velocity changed its sign in flight, or became 0.
    turns: usize,
    /// `S` and `K`.
    forces: [f64; 2],
}

impl Pair {
    /// Right after an impact at `w = 1` with the absorber's velocity `v`.
    fn after_first_impact(cavity: &Cavity, c: f64, t: f64, v: f64) -> Self {
        Self { cavity: *cavity, c, t, y: c * libm::sin(t) - 1.0, v, s: -1.0 }
    }

    fn x(&self, t: f64) -> [f64; 2] {
        [self.c * libm::sin(t), self.c * libm::cos(t)]
    }

    /// Displacement and velocity of the absorber at `t`, in this flight.
    fn at(&self, t: f64) -> [f64; 2] {
        let (d, [x0, _], [x, v]) = (t - self.t, self.x(self.t), self.x(t));
        if self.s == 0.0 {
            return [self.y + x - x0, v];
        }
        let acceleration = self.cavity.acceleration() + self.s * self.cavity.friction();
        [self.y + self.v * d + 0.5 * acceleration * d * d, self.v + acceleration * d]
    }

    /// What friction would have to give for the absorber to stick.
    fn needed(&self, t: f64) -> f64 {
        -self.c * libm::sin(t) - self.cavity.acceleration()
    }

    /// Whether the flight is over at `t`: at a wall, by a turn, or by a release.
    fn ends(&self, t: f64) -> [bool; 2] {
        let ([x, u], [y, v]) = (self.x(t), self.at(t));
        let friction = self.cavity.friction();
        let turned = if self.s == 0.0 {
            self.needed(t).abs() > friction
        } else {
            friction > 0.0 && (u - v) * self.s < -1e-13
        };
        [(x - y).abs() > 1.0 + 4e-15, turned]
    }

    /// To `t`, which nothing happens before.
    fn fly(&mut self, t: f64, period: &mut Period) {
        let middle = 0.5 * (self.t + t);
        for (at, weight) in [(self.t, 1.0), (middle, 4.0), (t, 1.0)] {
            let by = weight * (t - self.t) / 6.0 * self.at(at)[0] / PI;
            period.forces[0] -= by * libm::cos(at);
            period.forces[1] -= by * libm::sin(at);
        }
        [self.y, self.v] = self.at(t);
        self.t = t;
    }

    fn happen(&mut self, at_wall: bool, period: &mut Period) {
        let ([x, u], friction) = (self.x(self.t), self.cavity.friction());
        if at_wall {
            let wall = (x - self.y).signum();
            let r = self.cavity.restitutions()[usize::from(wall < 0.0)];
            self.v = (1.0 + r) * u - r * self.v;
            (self.y, self.s) = (x - wall, -wall);
            period.impacts.push([self.t, wall, self.v]);
            return;
        }
        period.turns += 1;
        let needed = self.needed(self.t);
        let sticks = self.s != 0.0 && needed.abs() <= friction;
        (self.v, self.s) = (u, if sticks { 0.0 } else { needed.signum() });
    }

    fn period(&mut self) -> Period {
        const STEPS: u32 = 1024;
        let (begin, mut period) = (self.t, Period::default());
        let mut forces = [0.0; 2];
        for step in 1..=STEPS + 1 {
            let mut target = begin + TAU * (f64::from(step) / f64::from(STEPS));
            if step > STEPS {
                // An impact at the end of the period comes as late as its sensitivity makes of rounding.
                (forces, target) = (period.forces, begin + TAU + 1e-5);
            }
            while self.t < target {
                if !self.ends(target).contains(&true) {
                    self.fly(target, &mut period);
                    break;
                }
                let (mut low, mut high) = (self.t, target);
                while 0.5 * (low + high) > low && 0.5 * (low + high) < high {
                    let middle = 0.5 * (low + high);
                    if self.ends(middle).contains(&true) { high = middle } else { low = middle }
                }
                let at_wall = self.ends(high)[0];
                self.fly(high, &mut period);
                self.happen(at_wall, &mut period);
                if period.impacts.len() > 50 {
                    return period;
                }
            }
        }
        Period { forces, ..period }
    }
}

/// A period of the pair from a motion's first impact.
fn one_period(cavity: &Cavity, motion: &Motion) -> Period {
    let (c, [u1, _]) = (motion.oscillator_amplitude, motion.velocities);
    Pair::after_first_impact(cavity, c, motion.impact_phase, u1).period()
}

/// By how much a period is not the motion's: phases, velocities, `S`, `K`; infinite where it has other impacts.
fn distance(motion: &Motion, period: &Period) -> f64 {
    let [second, first] = period.impacts[..] else { return f64::INFINITY };
    let [u1, u2] = motion.velocities;
    let from = motion.impact_phase;
    let found = [second, first, [period.forces[0], period.forces[1], 0.0]];
    let known = [
        [from + motion.times[0], -1.0, u2],
        [from + TAU, 1.0, u1],
        [motion.resistance, motion.reactance, 0.0],
    ];
    let apart = found.as_flattened().iter().zip(known.as_flattened()).map(|(a, b)| (a - b).abs());
    apart.fold(0.0, f64::max)
}

const TILTS: [f64; 4] = [-0.2, 0.0, 0.04, 0.3];
const FRICTIONS: [f64; 3] = [0.0, 0.05, 0.25];
const ENDS: [[f64; 2]; 4] = [[0.6, 0.6], [0.55, 0.7], [0.9, 0.8], [0.2, 0.5]];

fn cavities() -> impl Iterator<Item = Cavity> {
    TILTS.into_iter().flat_map(|a| {
        FRICTIONS.into_iter().flat_map(move |f| ENDS.into_iter().map(move |r| cavity(a, f, r)))
    })
}

/// Every motion that is called admissible is one, stable or not; every other one is none. Of cavities with ends from
/// plastic to elastic, and tilt and friction up to several times what moves the oscillator.
#[test]
fn motions_are_those_of_the_impact_pair() {
    let (mut counts, mut seed) = ([0, 0], 1_u64);
    // Knuth's linear congruence, its upper bits.
    let mut next = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let sizes = [0.0, 0.01, 0.5, 0.5, 5.0];
    for _ in 0..1500 {
        let mut size = || sizes[(5.0 * next()) as usize];
        let [tilts, frictions] = [size(), size()];
        let ends = [next(), next()].map(|r| (1.1 * r - 0.05).clamp(0.0, 1.0));
        let ends = if next() < 0.2 { [ends[0]; 2] } else { ends };
        let cavity = cavity(tilts * (2.0 * next() - 1.0), frictions * next(), ends);
        let c = 0.05 + 4.0 * next() * next();
        for motion in cavity.motions_at(c) {
            assert!((motion.oscillator_amplitude - c).abs() < 1e-12, "{cavity:?} {motion:?}");
            let period = one_period(&cavity, &motion);
            let (apart, turns) = (distance(&motion, &period), period.turns);
            // Simpson's rule with a step of 0.006 is off by some 1e-11; rounding grows as the motion's map says.
            let same = apart < 1e-9 + 1e-11 * motion.trace.abs() && turns == 0;
            assert_eq!(motion.admissible, same, "{cavity:?} {motion:?} {apart} {turns}");
            counts[usize::from(same)] += 1;
        }
    }
    assert!(counts[0] > 500 && counts[1] > 500, "{counts:?}");
}

/// Where a tilt makes both sides of the equation of `c_c` vanish at one `nu` of unequal ends, a line of motions has those
/// times, as in a symmetric cavity.
#[test]
fn a_tilt_that_undoes_unequal_ends_leaves_a_line_of_motions() {
    for ends in [[0.6, 0.65], [0.9, 0.5]] {
        let [rho1, rho2] = ends.map(|r| (1.0 - r) / (1.0 + r));
        let (mean, difference) = (0.5 * (rho1 + rho2), rho1 - rho2);
        let times = |nu: f64| (PI + 2.0 * nu) * (PI - 2.0 * nu);
        let factor =
            |nu: f64| libm::sin(nu) * times(nu) - (4.0 * nu - PI * difference) * libm::cos(nu);
        let (mut low, mut high) = (-1.0, 1.0);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if factor(middle) > 0.0 { high = middle } else { low = middle }
        }
        let tilt = (PI * difference - 4.0 * high) * 2.0 / (mean * PI * times(high));
        let cavity = cavity(tilt, 0.0, ends);
        let mut found = 0;
        for c in [0.3, 0.5, 0.7] {
            for motion in cavity.motions_at(c) {
                let near = (motion.deviation - high).abs() < 1e-14;
                found += usize::from(near && motion.stable);
                let same = distance(&motion, &one_period(&cavity, &motion)) < 1e-9;
                assert_eq!(motion.admissible, same, "{cavity:?} {motion:?}");
            }
        }
        assert!(found >= 1, "{found} {cavity:?}");
    }
}

/// Wherever the pair comes to two impacts per period, that motion is one of those found, and it is called stable.
#[test]
fn the_impact_pair_comes_to_no_other_motion() {
    let mut came = 0;
    for (a, f, ends) in [
        (0.03, 0.02, [0.6, 0.6]),
        (0.0, 0.1, [0.55, 0.7]),
        (-0.1, 0.0, [0.8, 0.7]),
        (0.0, 0.0, [0.6, 0.6]),
    ] {
        let cavity = cavity(a, f, ends);
        for c in [0.25, 0.5, 0.7, 0.9, 1.0] {
            let motions = cavity.motions_at(c);
            for start in 0..4 {
                let phase = 1.6 * f64::from(start);
                let mut pair = Pair::after_first_impact(&cavity, c, phase, 1.5 * c);
                (0..150).for_each(|_| drop(pair.period()));
                // From an impact at w = 1 on, if there is any.
                let ended = pair.period();
                let Some([t, _, v]) = ended.impacts.iter().rfind(|one| one[1] > 0.0) else {
                    continue;
                };
                let mut pair = Pair::after_first_impact(&cavity, c, *t, *v);
                let period = pair.period();
                let [[_, -1.0, _], [again, 1.0, u]] = period.impacts[..] else { continue };
                let closure = (again - t - TAU).abs() + (u - v).abs();
                if period.turns > 0 || closure > 1e-10 {
                    continue;
                }
                came += 1;
                let apart = |motion: &&Motion| {
                    let phase = (motion.impact_phase - t + PI).rem_euclid(TAU) - PI;
                    phase.abs().max((motion.velocities[0] - v).abs())
                };
                let near = motions.iter().min_by(|one, other| apart(one).total_cmp(&apart(other)));
                let near = near.unwrap_or_else(|| {
                    panic!("none: {cavity:?} {c} {period:?}", period = period.impacts)
                });
                assert!(apart(&near) < 1e-7, "{cavity:?} {c} {near:?} {t} {v}");
                assert!(near.stable && near.admissible, "{cavity:?} {c} {near:?}");
                let forces =
                    [period.forces[0] - near.resistance, period.forces[1] - near.reactance];
                assert!(forces.iter().all(|one| one.abs() < 1e-7), "{forces:?}");
            }
        }
    }
    assert!(came > 30, "{came}");
}

/// Trace and determinant of the map over a period are those of the pair's own differences.
#[test]
fn the_linear_map_is_that_of_differences() {
    const STEP: f64 = 1e-5;
    let mut compared = 0;
    for cavity in cavities() {
        for c in [0.4, 0.9] {
            for motion in cavity
                .motions_at(c)
                .iter()
                .filter(|motion| motion.admissible && motion.trace.abs() < 1e3)
            {
                let state = [motion.impact_phase, motion.velocities[0]];
                let map = |k: usize, by: f64| {
                    let mut from = state;
                    from[k] += by;
                    let mut pair = Pair::after_first_impact(&cavity, c, from[0], from[1]);
                    let mut impacts = pair.period().impacts;
                    impacts.extend(pair.period().impacts);
                    impacts.into_iter().find(|one| one[1] > 0.0).expect("it comes back")
                };
                let column = |k: usize| {
                    let (after, before) = (map(k, STEP), map(k, -STEP));
                    [0, 2].map(|j| (after[j] - before[j]) / (2.0 * STEP))
                };
                let [first, second] = [column(0), column(1)];
                let trace = first[0] + second[1];
                let determinant = first[0] * second[1] - first[1] * second[0];
                // Rounding of 1e-13 over the step, and the cubic part of the map.
                let size = 1.0 + first.iter().chain(&second).map(|one| one * one).sum::<f64>();
                if size > 1e3 {
                    continue;
                }
                assert!(
                    (trace - motion.trace).abs() < 1e-7 * size,
                    "{trace} {cavity:?} {motion:?}"
                );
                assert!(
                    (determinant - motion.determinant).abs() < 1e-7 * size,
                    "{determinant} {motion:?}"
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 60, "{compared}");
}

fn system(restitution: f64, forcing: &Forcing) -> System {
    let system = System::new(Parameters {
        mass_ratio: 0.01,
        damping: forcing.damping,
        restitution,
        frequency_ratio: 1.0,
        forcing_per_clearance: forcing.forcing_per_clearance,
        excitation: Excitation::Force,
    });
    system.and_then(|system| system.with_detuning(forcing.detuning)).expect("valid")
}

const FORCINGS: [Forcing; 4] = [
    Forcing { damping: 1.799, detuning: -5.449, forcing_per_clearance: 4.3417 },
    Forcing { damping: 1.799, detuning: 2.348, forcing_per_clearance: 1.7 },
    Forcing { damping: 0.0, detuning: 0.3, forcing_per_clearance: 0.8 },
    Forcing { damping: 0.5, detuning: -0.6, forcing_per_clearance: 2.0 },
];

/// A level cavity with equal ends and no friction is (14) to (18), and so is one with next to none of all that.
#[test]
fn the_limit_is_the_theory_without_options() {
    let small = 1e-13;
    for r in [0.05, 0.3, 0.6, 0.9] {
        let manifold = Manifold::of(r);
        for [a, f, d] in
            [[0.0; 3], [small, 0.0, 0.0], [0.0, small, 0.0], [0.0, 0.0, small], [small; 3]]
        {
            let cavity = cavity(a, f, [r, r + d]);
            for c in
                [0.7, 0.9, 1.2].map(|part| part * manifold.symmetry_breaking.oscillator_amplitude)
            {
                let beta = manifold.stable_absorber(c).expect("above the fold");
                let motions = cavity.motions_at(c);
                let near =
                    |one: &&Motion| one.deviation.abs() < 1e-9 && one.absorber_amplitude > 1.0;
                let motion = motions.iter().find(near).expect("the symmetric one");
                let rho = manifold.restitution_ratio;
                let forces = [
                    16.0 * rho * beta * beta / (PI * PI * PI * c),
                    -8.0 * beta * (beta - 1.0) / (PI * PI * c),
                ];
                let apart = [
                    motion.absorber_amplitude - beta,
                    motion.resistance - forces[0],
                    motion.reactance - forces[1],
                ];
                assert!(apart.iter().all(|one| one.abs() < 1e-12), "{r} {c} {apart:?}");
                assert_eq!(motion.stable, c < manifold.symmetry_breaking.oscillator_amplitude);
            }
            for forcing in FORCINGS {
                let analysis = Analysis::of(&system(r, &forcing)).expect("in range");
                let mut found = cavity.fixed_points(&forcing);
                found.retain(|point| point.motion.deviation.abs() < 1e-9);
                assert_eq!(found.len(), analysis.fixed_points.len(), "{r} {forcing:?} {found:?}");
                for (one, known) in found.iter().zip(&analysis.fixed_points) {
                    let pairs = [
                        [one.motion.absorber_amplitude, known.absorber_amplitude],
                        [one.motion.oscillator_amplitude, known.oscillator_amplitude],
                        [one.eta, known.eta],
                    ];
                    assert!(
                        pairs.iter().all(|[a, b]| (a - b).abs() < 1e-12 * b.abs().max(1.0)),
                        "{pairs:?}"
                    );
                    // They have the distance from the fold in the denominator.
                    let far = (known.absorber_amplitude - manifold.fold.absorber_amplitude).abs();
                    let jacobian = [[one.trace, known.trace], [one.determinant, known.determinant]];
                    let close = |[a, b]: &[f64; 2]| {
                        (a - b).abs() < 1e-12 * (1.0 + b.abs()) * (1.0 + 1.0 / far)
                    };
                    assert!(jacobian.iter().all(close), "{jacobian:?}");
                    assert_eq!(one.stable, known.stable && known.admissible, "{one:?} {known:?}");
                }
            }
        }
    }
}

/// The asymmetric motion of the dissipation curve, whose averages were known from simulation only.
#[test]
fn the_asymmetric_motion_has_the_known_averages() {
    let motions = cavity(0.0, 0.0, [0.6, 0.6]).motions_at(0.9);
    let asymmetric: Vec<_> =
        motions.iter().filter(|one| one.deviation != 0.0 && one.stable && one.admissible).collect();
    let [one, other] = asymmetric[..] else { panic!("{motions:?}") };
    assert!(
        (one.resistance - 0.538).abs() < 5e-4 && (one.reactance + 1.233).abs() < 5e-4,
        "{one:?}"
    );
    assert!((one.deviation + other.deviation).abs() < 1e-12);
    assert!((one.resistance - other.resistance).abs() < 1e-12);
    assert!((one.reactance - other.reactance).abs() < 1e-12);
}

/// Fold and symmetry breaking with friction alone: a multiplier of the pair is 1 in both, and the amplitudes are as the
/// squares of `C cos Theta = b - B` and `C sin Theta = (2/pi) rho B + pi f/2` say.
#[test]
fn closed_forms_of_friction_alone_are_limits_of_stability() {
    for f in [0.0, 0.01, 0.2, 0.8] {
        for r in [0.2, 0.6, 0.95] {
            let cavity = cavity(0.0, f, [r, r]);
            let rho = (1.0 - r) / (1.0 + r);
            let (fold, breaking) =
                (cavity.fold().expect("one"), cavity.symmetry_breaking().expect("one"));
            for point in [fold, breaking] {
                let motion = cavity.symmetric_motion(point.absorber_amplitude).expect("one");
                let beta = point.absorber_amplitude;
                let square = (1.0 - beta) * (1.0 - beta)
                    + (2.0 / PI * rho * beta + PI * f / 2.0)
                        * (2.0 / PI * rho * beta + PI * f / 2.0);
                assert!((motion.oscillator_amplitude - square.sqrt()).abs() < 1e-14);
                assert!((motion.oscillator_amplitude - point.oscillator_amplitude).abs() < 1e-14);
                let at_one = 1.0 - motion.trace + motion.determinant;
                // The trace has terms of size 1/C.
                assert!(at_one.abs() < 1e-13 / (square.sqrt() * (1.0 - r)), "{f} {r} {at_one}");
                let loss = 16.0 * rho * beta * beta / (PI * PI * PI) + 4.0 / PI * f;
                assert!((motion.oscillator_amplitude * motion.resistance - loss).abs() < 1e-14);
                assert!(
                    (formulas::FRICTION_LOSS.at([f, rho, beta]) - loss).abs()
                        < 1e-15 * (1.0 + loss)
                );
            }
            let at = |beta: f64| cavity.symmetric_motion(beta).expect("one");
            let [low, high] = [fold.absorber_amplitude, breaking.absorber_amplitude];
            assert!(!at(low - 1e-6).stable && at(low + 1e-6).stable);
            assert!(at(high - 1e-6).stable && !at(high + 1e-6).stable);
            // The asymmetric motion begins there.
            let begin = cavity.motion(0.0).expect("one");
            assert!((begin.absorber_amplitude - high).abs() < 1e-14);
            let near = cavity.motion(1e-5).expect("one");
            assert!((near.absorber_amplitude - high).abs() < 1e-9);
            assert!(cavity.motions_at(fold.oscillator_amplitude - 1e-9).is_empty());
            assert!(cavity.motions_at(fold.oscillator_amplitude + 1e-9).len() >= 2);
        }
    }
    assert_eq!(cavity(0.0, 20.0, [0.6, 0.6]).fold(), None);
    assert_eq!(cavity(0.1, 0.0, [0.6, 0.6]).fold(), None);
    assert_eq!(cavity(0.0, 0.0, [0.6, 0.7]).symmetry_breaking(), None);
}

/// The first order in tilt and difference of the ends: what is left is of second order, a third of it if both are.
#[test]
fn small_deviations_are_the_first_order() {
    for (a, d) in [(1.0, 0.0), (0.0, 1.0), (1.0, -0.6)] {
        for beta in [1.1, 1.4, 2.5] {
            let left = |size: f64| {
                let cavity = cavity(a * size, 0.05, [0.6, 0.6 + d * size]);
                let deviation = cavity.small_deviation(beta);
                let motion = cavity.motion(deviation).expect("one");
                (motion.absorber_amplitude - beta).abs()
            };
            let [large, small] = [left(1e-3), left(1e-4)];
            assert!(large < 0.1 && small < 0.15 * large, "{a} {d} {beta} {large} {small}");
        }
    }
    // A tilt that undoes unequal ends.
    let [r1, r2] = [0.6, 0.62];
    let [rho1, rho2] = [r1, r2].map(|r| (1.0 - r) / (1.0 + r));
    let tilt = 2.0 * (rho1 - rho2) * 1.3 / (PI * PI * 0.5 * (rho1 + rho2));
    assert!(cavity(tilt, 0.1, [r1, r2]).small_deviation(1.3).abs() < 1e-15);
}

/// With friction alone symmetric fixed points are the roots of a quadratic in `B/b`, derived by hand from the two
/// lines above (18); the scan finds those and no more.
#[test]
fn friction_alone_leaves_the_fixed_points_a_quadratic() {
    let mut found_any = 0;
    for f in [0.0, 0.03, 0.3] {
        for r in [0.3, 0.6, 0.9] {
            for Forcing { damping: lambda, detuning: sigma, forcing_per_clearance: gamma } in
                FORCINGS
            {
                let rho = (1.0 - r) / (1.0 + r);
                let s = lambda * lambda + 4.0 * sigma * sigma;
                let p0 = s * (1.0 + PI * PI * f * f / 4.0)
                    + 16.0 * f * f / (PI * PI)
                    + 8.0 * lambda * f / PI
                    + 8.0 * sigma * f * f;
                let p1 = s * (2.0 * rho * f - 2.0) + 32.0 * sigma / (PI * PI) * (rho * f - 1.0);
                let p2 = s * (1.0 + 4.0 * rho * rho / (PI * PI))
                    + 32.0 * lambda * rho / (PI * PI * PI)
                    + 32.0 * sigma / (PI * PI)
                    + 64.0 / (PI * PI * PI * PI);
                let root = (p1 * p1 - 4.0 * p2 * (p0 - gamma * gamma)).sqrt();
                let mut known = vec![(-p1 - root) / (2.0 * p2), (-p1 + root) / (2.0 * p2)];
                known.retain(|beta| *beta > 0.0);
                let forcing =
                    Forcing { damping: lambda, detuning: sigma, forcing_per_clearance: gamma };
                let mut found = cavity(0.0, f, [r, r]).fixed_points(&forcing);
                found.retain(|point| point.motion.deviation == 0.0);
                assert_eq!(found.len(), known.len(), "{f} {r} {forcing:?} {found:?} {known:?}");
                found_any += found.len();
                for (point, beta) in found.iter().zip(known) {
                    assert!(
                        (point.motion.absorber_amplitude - beta).abs() < 1e-11,
                        "{point:?} {beta}"
                    );
                }
            }
        }
    }
    assert!(found_any > 30, "{found_any}");
}

/// Rates of `C` and `eta`, the motion being the one nearest to another.
fn rates(cavity: &Cavity, forcing: &Forcing, [c, eta]: [f64; 2], near: &Motion) -> [f64; 2] {
    let motions = cavity.motions_at(c);
    let apart = |one: &&Motion| {
        (one.absorber_amplitude - near.absorber_amplitude).abs()
            + (one.deviation - near.deviation).abs()
    };
    let motion = motions.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).expect("one");
    let gamma = forcing.forcing_per_clearance;
    [
        (-forcing.damping * c - motion.resistance + gamma * libm::sin(eta)) / 2.0,
        forcing.detuning + (gamma * libm::cos(eta) - motion.reactance) / (2.0 * c),
    ]
}

/// At a fixed point the rates vanish, and trace and determinant are those of their differences. Those found are all: a
/// walk in `nu`, and around the almost symmetric motions in their amplitude, passes no other.
#[test]
fn fixed_points_are_those_of_the_slow_flow() {
    const STEP: f64 = 1e-6;
    let mut compared = 0;
    for (a, f, ends) in [
        (0.02, 0.0, [0.6, 0.6]),
        (0.003, 0.05, [0.6, 0.65]),
        (0.0, 0.1, [0.8, 0.7]),
        (0.0, 0.0, [0.6, 0.6]),
    ] {
        let cavity = cavity(a, f, ends);
        for forcing in FORCINGS {
            let points = cavity.fixed_points(&forcing);
            for FixedPoint { motion, eta, trace, determinant, .. } in &points {
                let at = [motion.oscillator_amplitude, *eta];
                let rate =
                    |c: f64, eta: f64| rates(&cavity, &forcing, [at[0] + c, at[1] + eta], motion);
                let still = rate(0.0, 0.0);
                assert!(still.iter().all(|one| one.abs() < 1e-10), "{still:?} {motion:?}");
                let column = |c: f64, eta: f64| {
                    let (after, before) = (rate(c, eta), rate(-c, -eta));
                    [0, 1].map(|k| (after[k] - before[k]) / (2.0 * STEP))
                };
                let [by_c, by_eta] = [column(STEP, 0.0), column(0.0, STEP)];
                let found = [by_c[0] + by_eta[1], by_c[0] * by_eta[1] - by_c[1] * by_eta[0]];
                // Rounding over the step, and curvature, which grows towards the folds.
                let size = 1.0 + motion.slopes.iter().map(|one| one * one).sum::<f64>();
                let apart = [found[0] - trace, found[1] - determinant];
                assert!(apart.iter().all(|one| one.abs() < 1e-7 * size), "{apart:?} {motion:?}");
                compared += 1;
            }
            let held = |motion: &Motion| {
                let Forcing { damping, detuning, forcing_per_clearance: gamma } = forcing;
                let c = motion.oscillator_amplitude;
                let sides =
                    [damping * c + motion.resistance, 2.0 * detuning * c - motion.reactance];
                (libm::hypot(sides[0], sides[1]) > gamma, motion.absorber_amplitude)
            };
            let walk: Vec<_> = (-15_000..15_000)
                .filter_map(|k| {
                    let motion = cavity.motion((f64::from(k) + 0.5) * 1e-4)?;
                    Some((motion.deviation, held(&motion)))
                })
                .collect();
            for pair in walk.windows(2) {
                let [(from, (above, b0)), (to, (after, b1))] = [pair[0], pair[1]];
                if above == after || to - from > 1.5e-4 || (b1 - b0).abs() > 0.5 {
                    continue;
                }
                let there =
                    points.iter().any(|point| (from..=to).contains(&point.motion.deviation));
                assert!(there, "{cavity:?} {forcing:?} {from} {to} {points:?}");
            }
        }
    }
    assert!(compared > 30, "{compared}");
}

#[test]
fn what_no_cavity_can_be_is_refused() {
    let text = |a, f, r| Cavity::new(a, f, r).unwrap_err().to_string();
    assert_eq!(text(f64::NAN, 0.0, [0.6; 2]), "acceleration is NaN, expected a finite number");
    assert_eq!(text(0.0, -1.0, [0.6; 2]), "friction is -1, expected a finite number, 0 or more");
    assert_eq!(
        text(0.0, 0.0, [1.5, 0.6]),
        "first restitution is 1.5, expected a number from 0 to 1"
    );
    assert_eq!(
        text(0.0, 0.0, [0.6, -0.1]),
        "second restitution is -0.1, expected a number from 0 to 1"
    );
}
