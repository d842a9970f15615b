//! Closed-form limits: elastic and plastic impacts, no damping, no forcing, no absorber motion.
//!
//! The truth is the formula that is left when a parameter goes to its end, written out by hand from
//! (14) to (18), and conservation of energy, which no formula of the program enters.

use crate::common;
use std::f64::consts::PI;

use vinesink::analysis::{Analysis, Manifold};
use vinesink::simulation::AbsorberMotion;
use vinesink::simulation::{
    Impact, ImpactLog, Measurement, Observer, Segment, Simulation, Statistics, Stop, Trace,
    TracePoint,
};
use vinesink::system::{Cavity, Excitation, Parameters, State, System};

/// Some dozen operations on numbers of order one.
const ROUNDING: f64 = 1e-14;
/// Clearances in mm that pass through every regime of Fig. 11 at 8 Hz.
const CLEARANCES: [f64; 7] = [0.3, 2.5, 4.0, 7.5, 11.5, 15.0, 20.0];

const TABLE: Parameters = Parameters {
    mass_ratio: 0.01,
    damping: 1.8,
    restitution: 0.6,
    frequency_ratio: 0.99,
    forcing_per_clearance: 1.5,
    excitation: Excitation::BaseDisplacement,
    cavity: Cavity::IDEAL,
};

fn system(parameters: Parameters) -> System {
    System::new(parameters).expect("valid")
}

fn manifold(restitution: f64) -> Manifold {
    Manifold::of(restitution)
}

fn near(found: f64, expected: f64, relative: f64) -> bool {
    (found - expected).abs() <= relative * expected.abs()
}

/// Runs `periods` and measures all of them.
fn measured(system: &System, start: State, periods: u64) -> Statistics {
    let mut simulation = Simulation::new(system, start, 0.0).expect("inside the cavity");
    let mut measurement = Measurement::begin(system, start);
    assert_eq!(simulation.run(periods, 10_000_000, &mut measurement), Stop::EndTime);
    measurement.statistics().clone()
}

#[test]
fn elastic_impacts_fold_where_the_oscillator_stands_still() {
    let elastic = manifold(1.0);
    assert_eq!((elastic.fold.absorber_amplitude, elastic.fold.oscillator_amplitude), (1.0, 0.0));
    assert_eq!((elastic.restitution_ratio, elastic.curvature), (0.0, 0.0));
}

/// B = b/(1+R) rounds to b here; its distance from b and C keep all their digits.
#[test]
fn nearly_elastic_impacts_keep_the_relative_accuracy_of_the_fold() {
    for distance in [1e-3, 1e-6, 1e-9, 1e-12] {
        let restitution = 1.0 - distance;
        // The subtraction is exact, so this is the rho of the number that was passed.
        let rho = (1.0 - restitution) / (1.0 + restitution);
        let curvature = 4.0 * rho * rho / (PI * PI);
        let near_elastic = manifold(restitution);
        let shift = -curvature / (1.0 + curvature);
        assert!(near(near_elastic.fold_shift, shift, ROUNDING), "{near_elastic:?}");
        let oscillator = (curvature / (1.0 + curvature)).sqrt();
        assert!(
            near(near_elastic.fold.oscillator_amplitude, oscillator, ROUNDING),
            "{near_elastic:?}"
        );
    }
}

/// With rho -> 0, gamma_H^2 = k^2/R + 2 lambda k + ... -> 64/pi^4, whatever lambda and sigma.
#[test]
fn the_hopf_forcing_of_elastic_impacts_is_eight_over_pi_squared() {
    for damping in [0.0, 1.8, 20.0] {
        for frequency_ratio in [0.97, 1.0, 1.02] {
            for distance in [1e-3, 1e-6, 1e-9] {
                let restitution = 1.0 - distance;
                let at = system(Parameters { damping, frequency_ratio, restitution, ..TABLE });
                let hopf = Analysis::of(&at).expect("analysable").boundaries.hopf;
                // The next terms are rho (lambda pi + 2 sigma) and smaller; rho is distance / 2.
                let next = distance * (1.0 + 2.0 * damping + at.detuning().abs());
                assert!((hopf - 8.0 / (PI * PI)).abs() < 2.0 * next, "{hopf} at {distance}");
            }
        }
    }
}

/// r = 1 and lambda = 0 leave abs(m beta - 2 sigma (1 - beta)) = gamma.
#[test]
fn fixed_points_of_an_undamped_elastic_absorber_are_two_straight_lines() {
    let m = 8.0 / (PI * PI);
    for (detuning, gamma) in [(0.0, 0.5), (0.0, 1.5), (0.3, 0.4), (2.0, 1.0), (-3.0, 5.0)] {
        let parameters =
            Parameters { damping: 0.0, restitution: 1.0, forcing_per_clearance: gamma, ..TABLE };
        let at = system(parameters).with_detuning(detuning).expect("a positive frequency");
        let slope = m + 2.0 * detuning;
        let mut expected = [(2.0 * detuning + gamma) / slope, (2.0 * detuning - gamma) / slope];
        expected.sort_by(f64::total_cmp);
        let expected: Vec<f64> = expected.into_iter().filter(|beta| *beta > 0.0).collect();
        let found = Analysis::of(&at).expect("analysable").fixed_points;
        assert_eq!(found.len(), expected.len(), "sigma {detuning}, gamma {gamma}: {found:?}");
        for (point, beta) in found.iter().zip(expected) {
            assert!(
                near(point.absorber_amplitude, beta, 100.0 * ROUNDING),
                "{point:?}, not {beta}"
            );
            assert!(
                near(point.oscillator_amplitude, (1.0 - beta).abs(), 100.0 * ROUNDING),
                "{point:?}"
            );
        }
    }
}

#[test]
fn plastic_impacts_have_rho_one() {
    let plastic = manifold(0.0);
    assert_eq!(plastic.restitution_ratio, 1.0);
    assert!(near(plastic.curvature, 4.0 / (PI * PI), ROUNDING));
    assert!(near(plastic.fold.absorber_amplitude, PI * PI / (PI * PI + 4.0), ROUNDING));
}

/// Compares what follows each impact with the wall's acceleration, by equation (1).
struct Sticking {
    system: System,
    impacts: u64,
    stuck: u64,
    /// Whether the wall pushes after the impact that has just happened.
    pushes: Option<bool>,
}

impl Observer for Sticking {
    fn segment(&mut self, segment: &Segment) {
        let Some(pushes) = self.pushes.take() else { return };
        let carried = matches!(segment.absorber, AbsorberMotion::Carried(_));
        assert_eq!(carried, pushes, "{segment:?}");
        self.stuck += u64::from(carried);
    }
    fn impact(&mut self, impact: &Impact) {
        self.impacts += 1;
        let separation = impact.x_velocity_after - impact.y_velocity_after;
        // The exchanged momentum is rounded once and subtracted twice.
        let rounding = 4.0 * f64::EPSILON * impact.y_velocity_before.abs().max(1.0);
        assert!(separation.abs() < rounding, "plastic, yet {impact:?}");
        let Parameters { mass_ratio: eps, damping, frequency_ratio, .. } = self.system.parameters();
        let force = eps * self.system.forcing_per_clearance();
        let loss = eps * damping;
        let (sin, cos) = libm::sincos(impact.phase);
        let acceleration = force * (sin + loss * frequency_ratio * cos)
            - loss * impact.x_velocity_after
            - impact.x;
        self.pushes = Some(impact.side.sign() * acceleration > 0.0);
    }
}

/// After a plastic impact the wall carries the absorber from the first moment on, or recedes from
/// it. Nothing rattles, so that a period never takes more than a few impacts.
#[test]
fn a_plastic_absorber_sticks_at_once_where_the_wall_pushes() {
    let mut stuck = 0;
    for clearance in CLEARANCES {
        let parameters =
            Parameters { restitution: 0.0, ..common::table_1(8.0, clearance).parameters() };
        let start = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };
        let system = system(parameters);
        let mut simulation = Simulation::new(&system, start, 0.0).expect("inside the cavity");
        let mut seen = Sticking { system, impacts: 0, stuck: 0, pushes: None };
        assert_eq!(simulation.run(300, 100_000, &mut seen), Stop::EndTime);
        assert!(seen.impacts > 30, "{} impacts at {clearance} mm", seen.impacts);
        assert!(seen.impacts <= 4 * 300, "{} impacts at {clearance} mm", seen.impacts);
        stuck += seen.stuck;
    }
    assert!(stuck > 1000, "{stuck} contacts are too few to prove anything");
}

/// Nothing divides by lambda, and lambda = 0 is what small lambda tends to.
#[test]
fn vanishing_damping_is_the_limit_of_small_damping() {
    let small = 1e-10;
    for (detuning, gamma) in [(0.5, 1.5), (-2.0, 6.0), (0.0, 1.0)] {
        let with = |damping| {
            let at = system(Parameters { damping, forcing_per_clearance: gamma, ..TABLE });
            let at = at.with_detuning(detuning).expect("a positive frequency");
            Analysis::of(&at).expect("analysable")
        };
        let (undamped, damped) = (with(0.0), with(small));
        assert!(!undamped.fixed_points.is_empty());
        assert_eq!(undamped.fixed_points.len(), damped.fixed_points.len());
        for (a, b) in undamped.fixed_points.iter().zip(&damped.fixed_points) {
            // Amplitudes are of order one; ten times the change of lambda.
            assert!(
                (a.absorber_amplitude - b.absorber_amplitude).abs() < 10.0 * small,
                "{a:?} {b:?}"
            );
            assert!((a.eta - b.eta).abs() < 10.0 * small, "{a:?} {b:?}");
        }
        let trace = |at: &Analysis| at.fixed_points[0].trace;
        assert!((trace(&undamped) - trace(&damped)).abs() < 100.0 * small);
    }
    let undamped = system(Parameters { damping: 0.0, ..TABLE });
    let bare = undamped.linear_response().expect("off resonance");
    let expected = 0.01 * 1.5 / (1.0 - 0.99 * 0.99);
    // 1 - 0.99^2 is a difference with a relative rounding of 1e-14.
    assert!(near(bare.amplitude(), expected, 1e-13), "{bare:?}");
}

#[test]
fn nothing_moves_without_forcing() {
    for (restitution, damping) in [(0.0, 0.0), (0.6, 0.0), (0.6, 1.8), (1.0, 0.0), (1.0, 5.0)] {
        let parameters = Parameters { forcing_per_clearance: 0.0, restitution, damping, ..TABLE };
        let at = system(parameters);
        assert_eq!(Analysis::of(&at).expect("analysable").fixed_points, []);
        assert_eq!(at.linear_response().expect("off resonance").amplitude(), 0.0);
        let rest = State { x: 0.0, x_velocity: 0.0, y: 0.0, y_velocity: 0.0 };
        let still = measured(&at, rest, 10);
        assert_eq!((still.impacts(), still.peak(), still.rms()), (0, 0.0, 0.0));
    }
}

/// At resonance without damping (8/pi^2)^2 (1 + ...) beta^2 = gamma^2 is left.
#[test]
fn tiny_forcing_leaves_a_tiny_absorber_motion_or_none() {
    for gamma in [1e-3, 1e-6, 1e-9, 1e-12, 1e-20] {
        let parameters = Parameters { damping: 0.0, forcing_per_clearance: gamma, ..TABLE };
        let at = system(parameters).with_detuning(0.0).expect("a positive frequency");
        let found = Analysis::of(&at).expect("analysable").fixed_points;
        let lowest = found.first().expect("a fixed point however small the forcing");
        // The next term is a multiple of gamma.
        let tolerance = 5.0 * gamma + ROUNDING;
        assert!(near(lowest.absorber_amplitude, PI * PI * gamma / 8.0, tolerance), "{lowest:?}");
        assert!(lowest.residual < 1e-12, "{lowest:?}");
        assert!((lowest.oscillator_amplitude - 1.0).abs() < 5.0 * gamma, "{lowest:?}");
        // Damping cannot be overcome by a forcing below lambda.
        let damped = system(Parameters { damping: 1.8, ..parameters });
        assert_eq!(Analysis::of(&damped).expect("analysable").fixed_points, []);
    }
}

#[test]
fn symmetry_breaks_at_the_same_amplitude_for_any_restitution_and_damping() {
    let expected = PI * PI / (PI * PI - 4.0);
    assert_eq!(format!("{expected:.5}"), "1.68148");
    for step in 0..=100 {
        for damping in [0.0, 1e-6, 1.8, 50.0] {
            let restitution = f64::from(step) / 100.0;
            let at = system(Parameters { restitution, damping, ..TABLE });
            let breaking = Analysis::of(&at).expect("analysable").manifold.symmetry_breaking;
            assert!(
                near(breaking.absorber_amplitude, expected, ROUNDING),
                "{restitution} {damping}"
            );
        }
    }
}

/// Free, undamped, elastic: energy is the first integral.
#[test]
fn elastic_impacts_without_damping_conserve_energy() {
    let parameters =
        Parameters { damping: 0.0, restitution: 1.0, forcing_per_clearance: 0.0, ..TABLE };
    for mass_ratio in [0.001, 0.0077, 0.3] {
        let at = system(Parameters { mass_ratio, ..parameters });
        let start = State { x: 0.7, x_velocity: 1.1, y: 0.2, y_velocity: -0.4 };
        let energy = start.energy(mass_ratio);
        let mut simulation = Simulation::new(&at, start, 0.0).expect("inside the cavity");
        let mut impacts = 0;
        for _ in 0..1000 {
            assert_eq!(simulation.run(1, 1000, &mut ()), Stop::EndTime);
            impacts = simulation.impacts();
            let now = simulation.state().energy(mass_ratio);
            // Each of the thousands of impacts rounds velocities once: some ulps apiece.
            let rounding = 4.0 * f64::EPSILON * (10.0 + impacts as f64);
            assert!(near(now, energy, rounding), "{now} is not {energy}, {impacts} impacts");
        }
        assert!(impacts > 1000, "{impacts} impacts are too few to prove anything");
    }
}

#[test]
fn the_energy_balance_of_forced_elastic_impacts_closes() {
    for damping in [0.0, 1.8] {
        let at = system(Parameters { damping, restitution: 1.0, ..TABLE });
        let start = State { x: 0.7, x_velocity: 1.1, y: 0.2, y_velocity: -0.4 };
        let statistics = measured(&at, start, 1000);
        let energy = statistics.energy();
        assert!(statistics.impacts() > 500, "{}", statistics.impacts());
        assert_eq!(energy.impact, 0.0, "elastic impacts lose nothing");
        assert!(energy.input != 0.0 && energy.relative_residual < 1e-9, "{energy:?}");
    }
}

/// Work and losses are integrated along the motion, so that closing the balance is no identity.
/// Quadrature and summation of some ten thousand terms leave far less than 1e-9.
#[test]
fn the_energy_balance_closes_in_every_regime_and_no_wall_is_passed() {
    for clearance in CLEARANCES {
        let at = common::table_1(8.0, clearance);
        let start = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };
        let statistics = measured(&at, start, 1000);
        let energy = statistics.energy();
        assert!(statistics.impacts() > 300, "{clearance} mm: {}", statistics.impacts());
        assert!(energy.relative_residual < 1e-9, "{clearance} mm: {energy:?}");
        let sum = energy.damper + energy.impact + energy.stored;
        let largest = energy.input.abs().max(energy.damper);
        assert!((energy.input - sum).abs() < 1e-9 * largest, "{clearance} mm: {energy:?}");
        // Sixteen ulps count as touching; lengths and velocities are up to tens of clearances.
        let rounding = 32.0 * f64::EPSILON * (1.0 + 4.0 * statistics.peak());
        assert!(statistics.penetration() <= rounding, "{clearance} mm: {energy:?}");
    }
}

#[test]
fn the_absorber_is_inside_its_cavity_at_every_sampled_time() {
    for clearance in CLEARANCES {
        let at = common::table_1(8.0, clearance);
        let start = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };
        let mut simulation = Simulation::new(&at, start, 0.0).expect("inside the cavity");
        let mut trace = Trace::new(400.0);
        assert_eq!(simulation.run(100, 1_000_000, &mut trace), Stop::EndTime);
        assert!(trace.points.len() > 40_000 && trace.impacts.len() > 20);
        let furthest =
            |far: f64, point: &TracePoint| far.max(point.state.relative_displacement().abs());
        let furthest = trace.points.iter().fold(0.0, furthest);
        let size = trace.points.iter().fold(0.0, |size: f64, at| size.max(at.state.x.abs()));
        // As above: what counts as touching.
        assert!(furthest <= 1.0 + 32.0 * f64::EPSILON * (1.0 + 4.0 * size), "{clearance} mm");
    }
}

/// With the absorber at rest in the middle nothing but equation (1) is left.
#[test]
fn the_bare_oscillator_follows_its_linear_response() {
    let excitations = [Excitation::BaseDisplacement, Excitation::Force];
    let systems = [(0.0077, 1.8, 0.958), (0.0077, 1.8, 1.018), (0.3, 0.5, 0.6), (0.01, 0.0, 0.9)];
    for (mass_ratio, damping, frequency_ratio) in systems {
        for excitation in excitations {
            let of = |forcing_per_clearance| {
                system(Parameters {
                    mass_ratio,
                    damping,
                    restitution: 0.6,
                    frequency_ratio,
                    forcing_per_clearance,
                    excitation,
                    cavity: Cavity::IDEAL,
                })
            };
            // Half the clearance, so that no wall is reached.
            let gain = of(1.0).linear_response().expect("off resonance").amplitude();
            let at = of(0.5 / gain);
            let (amplitude, phase) = response_by_hand(&at);
            assert!(near(amplitude, 0.5, 1e-12), "{amplitude}");
            let start = State {
                x: amplitude * libm::sin(phase),
                x_velocity: amplitude * frequency_ratio * libm::cos(phase),
                y: 0.0,
                y_velocity: 0.0,
            };
            let mut simulation = Simulation::new(&at, start, 0.0).expect("inside the cavity");
            let mut trace = Trace::new(50.0);
            let mut log = ImpactLog::default();
            assert_eq!(simulation.run(1000, 1, &mut (&mut trace, &mut log)), Stop::EndTime);
            assert_eq!(log.impacts.len(), 0);
            for point in &trace.points {
                let expected = amplitude * libm::sin(2.0 * PI * point.periods + phase);
                // A thousand periods are 6e3 rad, known to 1e-12.
                assert!((point.state.x - expected).abs() < 1e-9, "{point:?}, not {expected}");
                assert_eq!((point.state.y, point.state.y_velocity), (0.0, 0.0));
            }
            let statistics = measured(&at, start, 1000);
            assert!(near(statistics.peak(), amplitude, 1e-9), "{}", statistics.peak());
            assert!(near(statistics.rms(), amplitude / 2.0_f64.sqrt(), 1e-9));
        }
    }
}

/// Amplitude and phase of the steady motion by the textbook's transmissibility.
fn response_by_hand(system: &System) -> (f64, f64) {
    let omega = system.frequency_ratio();
    let force = system.mass_ratio() * system.forcing_per_clearance();
    let loss = system.mass_ratio() * system.damping() * omega;
    let stiffness = 1.0 - omega * omega;
    let transmitted = match system.excitation() {
        Excitation::BaseDisplacement => loss,
        Excitation::Force => 0.0,
    };
    let gain = ((1.0 + transmitted * transmitted) / (stiffness * stiffness + loss * loss)).sqrt();
    (force * gain, libm::atan(transmitted) - libm::atan2(loss, stiffness))
}
