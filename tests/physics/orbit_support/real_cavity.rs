//! Systems with a real cavity, and their equation of motion as a Taylor series that shares nothing with the program.

use crate::common::table_1;
use vinesink::orbits::{AfterImpact, Cycle, Orbit, Wall, two_impact_orbits};
use vinesink::system::{Cavity, Excitation, Parameters, System};

/// `g/(b omega0^2)` of Table 1 at 7.5 mm.
const GRAVITY: f64 = 0.4753;

pub fn with(
    system: &System,
    gravity_along: f64,
    friction_acceleration: f64,
    difference: f64,
) -> System {
    let cavity =
        Cavity { gravity_along, friction_acceleration, restitution_difference: difference };
    System::new(Parameters { cavity, ..system.parameters() }).expect("valid")
}

/// Tilts up to 3 degrees, friction up to 0.1, ends up to 0.1 from their mean: each alone, and all together.
pub fn cavities() -> [[f64; 3]; 6] {
    let (a, f) = (0.0175 * GRAVITY, 0.05 * GRAVITY);
    [
        [a, 0.0, 0.0],
        [0.0, f, 0.0],
        [0.0, 0.0, 0.2],
        [a, f, -0.1],
        [-3.0 * a, 0.2 * f, 0.1],
        [a, 2.0 * f, 0.2],
    ]
}

pub fn systems() -> Vec<System> {
    let heavy = System::new(Parameters {
        mass_ratio: 0.15,
        damping: 0.8,
        restitution: 0.7,
        frequency_ratio: 0.9,
        forcing_per_clearance: 3.0,
        excitation: Excitation::Force,
        cavity: Cavity::IDEAL,
    });
    let ideal = [table_1(8.0, 7.5), table_1(8.0, 4.2), table_1(8.5, 20.0), heavy.expect("valid")];
    let of = |system: &System| cavities().map(|[a, f, d]| with(system, a, f, d));
    ideal.iter().flat_map(of).collect()
}

/// `x, x', y, y'`.
pub type Motion = [f64; 4];

/// Equation (1) and the absorber's, written out from the parameters, over a step from `phase`: Taylor series of 30
/// terms, whose remainder over a quarter of a radian is below `0.25^30/30!`.
pub fn step(system: &System, slip: f64, phase: f64, [x, v, y, u]: Motion, h: f64) -> Motion {
    let Parameters { mass_ratio: eps, damping, frequency_ratio: omega, .. } = system.parameters();
    let Cavity { gravity_along, friction_acceleration, .. } = system.cavity();
    let sine = eps * system.forcing_per_clearance();
    let cosine = match system.excitation() {
        Excitation::BaseDisplacement => eps * damping * omega * sine,
        Excitation::Force => 0.0,
    };
    let mut terms = vec![x, v];
    let mut scale = 1.0;
    for n in 0..28_u32 {
        // n-th derivative of the excitation over n!.
        let turned = phase + f64::from(n) * std::f64::consts::FRAC_PI_2;
        let force = (sine * libm::sin(turned) + cosine * libm::cos(turned)) * scale;
        let push = if n == 0 { eps * slip * friction_acceleration } else { 0.0 };
        let (here, next) = (terms[n as usize], terms[n as usize + 1]);
        let k = f64::from(n + 1);
        terms.push((force - push - eps * damping * k * next - here) / (k * (k + 1.0)));
        scale *= omega / k;
    }
    let x = terms.iter().rev().fold(0.0, |sum, c| sum * h + c);
    let rates = terms.iter().enumerate().skip(1).rev();
    let v = rates.fold(0.0, |sum, (k, c)| sum * h + k as f64 * c);
    let acceleration = gravity_along + slip * friction_acceleration;
    [x, v, y + u * h + 0.5 * acceleration * h * h, u + acceleration * h]
}

/// A flight by many steps: the end, and whether the absorber slides one way between the walls all along.
pub fn fly(system: &System, after: &AfterImpact, duration: f64) -> (Motion, bool) {
    let side = after.wall.sign();
    let slip = -side;
    let mut motion = [after.x, after.x_velocity, after.x - side, after.y_velocity];
    let steps = 400;
    let h = duration / f64::from(steps);
    let mut clean = true;
    for k in 0..steps {
        let phase = after.phase + system.frequency_ratio() * h * f64::from(k);
        motion = step(system, slip, phase, motion, h);
        let [x, v, y, u] = motion;
        let rubs = system.cavity().friction_acceleration > 0.0;
        clean &= (x - y).abs() < 1.0 + 1e-9 && (!rubs || slip * (v - u) > 0.0);
    }
    (motion, clean)
}

/// Largest defect of an orbit, round once by Taylor series and the impact's own two equations; whether all its flights
/// are clean and its impacts from inside.
pub fn defect(system: &System, cycle: &Cycle) -> (f64, bool) {
    let whole = cycle.unfolded();
    let eps = system.mass_ratio();
    let (mut largest, mut motion) = (0.0_f64, true);
    for (k, after) in whole.impacts.iter().enumerate() {
        let ([x, v, y, u], clean) = fly(system, after, whole.durations[k]);
        let next = whole.impacts[(k + 1) % whole.impacts.len()];
        let r = system.restitutions()[usize::from(next.wall == Wall::Minus)];
        // Momentum, and the relative velocity turned round.
        let momentum = v + eps * u;
        let parting = -r * (v - u);
        let u_after = (momentum - parting) / (1.0 + eps);
        let turns = (after.phase + system.frequency_ratio() * whole.durations[k] - next.phase)
            / std::f64::consts::TAU;
        let defects = [
            x - y - next.wall.sign(),
            x - next.x,
            u_after + parting - next.x_velocity,
            u_after - next.y_velocity,
            turns - turns.round(),
        ];
        largest = defects.iter().fold(largest, |most, one| most.max(one.abs()));
        motion &= clean && next.wall.sign() * (v - u) > 0.0;
    }
    (largest, motion)
}

/// Largest difference of two cycles, whose phases may be whole turns apart.
pub fn apart(a: &Cycle, b: &Cycle) -> f64 {
    let pairs = a.impacts.iter().zip(&b.impacts);
    let differences = pairs.map(|(a, b)| {
        let mut difference = a.vector() - b.vector();
        difference[0] = libm::sin(0.5 * difference[0]);
        difference.amax()
    });
    differences.fold(0.0, f64::max)
}

pub fn orbits(system: &System) -> Vec<Orbit> {
    let found = two_impact_orbits(system).expect("steady");
    assert!(found.undecided.is_empty(), "{:?}", found.undecided);
    found.orbits
}
