//! Tangent dynamics and the largest Lyapunov exponent.
//!
//! The truth is, in this order: the spectral radius of the half-period map of the exact orbits; the
//! volume that a motion without losses keeps and each impact shrinks by `r^2`; central differences of
//! the simulated flow.

use crate::common;
use vinesink::motions::carried_over;
use vinesink::motions::starts::StartBox;
use vinesink::regimes::lyapunov::{Exponent, Lyapunov};
use vinesink::simulation::{Measurement, Observer, Reversal, Simulation, Tangent};
use vinesink::system::{Cavity, Excitation, Parameters, State, System};

const UNIT: [[f64; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

fn state([x, x_velocity, y, y_velocity]: [f64; 4]) -> State {
    State { x, x_velocity, y, y_velocity }
}

fn numbers(state: State) -> [f64; 4] {
    [state.x, state.x_velocity, state.y, state.y_velocity]
}

/// Where a start leads after `periods`, with the impacts and the times it stuck.
fn end(system: &System, start: State, periods: u64) -> (State, u64, u64) {
    let mut simulation = Simulation::new(system, start, 0.0).expect("inside the cavity");
    let mut measurement = Measurement::begin(system, start);
    simulation.run(periods, 1_000_000, &mut measurement);
    let statistics = measurement.statistics();
    (simulation.state(), statistics.impacts(), statistics.sustained_contact().intervals)
}

/// Columns of the derivative of the flow over `periods`.
fn tangent_map(system: &System, start: State, periods: u64) -> [[f64; 4]; 4] {
    UNIT.map(|unit| {
        let mut simulation = Simulation::new(system, start, 0.0).expect("inside the cavity");
        let mut tangent = Tangent::begin(system, state(unit));
        simulation.run(periods, 1_000_000, &mut tangent);
        numbers(tangent.change).map(|c| c * libm::exp(tangent.logarithm()))
    })
}

fn by_differences(system: &System, start: State, periods: u64, h: f64) -> [[f64; 4]; 4] {
    UNIT.map(|unit| {
        let shifted = |sign: f64| {
            let base = numbers(start);
            let moved = std::array::from_fn(|k| base[k] + sign * h * unit[k]);
            numbers(end(system, state(moved), periods).0)
        };
        let (ahead, behind) = (shifted(1.0), shifted(-1.0));
        std::array::from_fn(|k| (ahead[k] - behind[k]) / (2.0 * h))
    })
}

fn determinant(columns: [[f64; 4]; 4]) -> f64 {
    let mut rows = columns;
    let mut product = 1.0;
    for k in 0..4 {
        let pivot = (k..4).max_by(|a, b| rows[*a][k].abs().total_cmp(&rows[*b][k].abs()));
        let pivot = pivot.expect("not empty");
        if pivot != k {
            rows.swap(pivot, k);
            product = -product;
        }
        product *= rows[k][k];
        for row in k + 1..4 {
            let factor = rows[row][k] / rows[k][k];
            rows[row] = std::array::from_fn(|at| rows[row][at] - factor * rows[k][at]);
        }
    }
    product
}

/// Differences of a simulated flow are good to `h^2` and to rounding over `h`; both are below 1e-6 of
/// the largest entry for these starts.
#[test]
fn the_tangent_map_is_the_derivative_of_the_simulated_flow() {
    let heavy = System::new(Parameters {
        mass_ratio: 0.3,
        damping: 1.2,
        restitution: 0.7,
        frequency_ratio: 1.1,
        forcing_per_clearance: 2.0,
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    })
    .expect("valid");
    let start = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };
    for (system, periods) in
        [(common::table_1(8.0, 7.5), 5), (common::table_1(8.5, 20.0), 5), (heavy, 3)]
    {
        let (_, impacts, _) = end(&system, start, periods);
        assert!(impacts >= 4, "{impacts} impacts are too few");
        let exact = tangent_map(&system, start, periods);
        let differences = by_differences(&system, start, periods, 1e-6);
        let size = exact.iter().flatten().fold(0.0_f64, |a, b| a.max(b.abs()));
        for (exact, difference) in exact.iter().flatten().zip(differences.iter().flatten()) {
            assert!((exact - difference).abs() < 1e-6 * size, "{exact} {difference} of {size}");
        }
    }
}

/// As above; the end of a chattering sequence is found to 1e-13, so that the step is longer.
#[test]
fn the_tangent_map_is_the_derivative_through_sticking() {
    for (eps, restitution) in [(0.0076775, 0.6), (0.3, 0.6), (0.3, 0.0)] {
        let table = common::table_1(8.0, 0.3);
        let system = System::new(Parameters {
            mass_ratio: eps,
            restitution,
            damping: 1.799,
            frequency_ratio: 0.958,
            ..table.parameters()
        })
        .expect("valid");
        let start = State { x: 0.3, x_velocity: 0.2, y: 0.1, y_velocity: 0.8 };
        for periods in [1, 3] {
            let (_, _, stuck) = end(&system, start, periods);
            assert!(stuck >= 1, "it never stuck at eps = {eps}, r = {restitution}");
            let exact = tangent_map(&system, start, periods);
            let differences = by_differences(&system, start, periods, 1e-5);
            let size = exact.iter().flatten().fold(0.0_f64, |a, b| a.max(b.abs()));
            for (exact, difference) in exact.iter().flatten().zip(differences.iter().flatten()) {
                assert!((exact - difference).abs() < 1e-6 * size, "{exact} {difference} {size}");
            }
        }
    }
}

/// Divergence of the flow is `-eps lambda`; an impact multiplies volume by `r^2`, whatever its
/// acceleration.
#[test]
fn volume_shrinks_by_damping_and_by_r_squared_at_each_impact() {
    for (eps, damping, restitution) in
        [(0.3, 0.0, 1.0), (0.01, 0.0, 1.0), (0.3, 1.0, 1.0), (0.3, 0.0, 0.8), (0.2, 0.7, 0.9)]
    {
        let system = System::new(Parameters {
            mass_ratio: eps,
            damping,
            restitution,
            frequency_ratio: 1.1,
            forcing_per_clearance: 1.0,
            excitation: Excitation::Force,
            cavity: Cavity::IDEAL,
        })
        .expect("valid");
        let start = State { x: 0.3, x_velocity: 0.9, y: 0.1, y_velocity: 0.4 };
        let (_, impacts, stuck) = end(&system, start, 3);
        assert!(impacts > 2 && stuck == 0, "{impacts} {stuck}");
        let columns = tangent_map(&system, start, 3);
        let shrunk = libm::exp(-eps * damping * 3.0 * system.period())
            * libm::pow(restitution, 2.0 * impacts as f64);
        let found = determinant(columns);
        let size = columns.iter().flatten().fold(1.0_f64, |a, b| a.max(b.abs()));
        let rounding = 1e-14 * size * size * size * size;
        assert!(
            (found - shrunk).abs() < rounding.min(1e-3 * shrunk),
            "{found} {shrunk} {rounding}"
        );
    }
}

/// The same for systems spread over the whole range of parameters, as far as rounding of the
/// determinant leaves two digits.
#[test]
fn volume_shrinks_as_it_must_in_every_system() {
    let place = |k: u32, prime: f64| (0.5 + prime.sqrt() * f64::from(k)).fract();
    let mut judged = 0;
    for k in 0..400 {
        let system = System::new(Parameters {
            mass_ratio: libm::exp(-4.0 * place(k, 2.0)) * 0.5,
            damping: 2.0 * place(k, 3.0),
            restitution: 0.5 + 0.5 * place(k, 5.0),
            frequency_ratio: 0.6 + place(k, 7.0),
            forcing_per_clearance: 4.0 * place(k, 11.0),
            excitation: Excitation::BaseDisplacement,
            cavity: Cavity::IDEAL,
        })
        .expect("valid");
        let start = StartBox::around(&system).start(k);
        let (_, impacts, stuck) = end(&system, start, 1);
        let columns = tangent_map(&system, start, 1);
        let eps = system.mass_ratio();
        let shrunk = libm::exp(-eps * system.damping() * system.period())
            * libm::pow(system.restitution(), 2.0 * impacts as f64);
        let size = columns.iter().flatten().fold(1.0_f64, |a, b| a.max(b.abs()));
        let rounding = 1e-14 * size * size * size * size;
        if stuck > 0 || impacts == 0 || rounding > 0.01 * shrunk {
            continue;
        }
        judged += 1;
        let found = determinant(columns);
        assert!(
            (found - shrunk).abs() < rounding.max(1e-9 * shrunk),
            "{found} {shrunk} {system:?}"
        );
    }
    assert!(judged > 100, "{judged} systems are too few");
}

#[test]
fn a_change_of_size_one_has_no_logarithm_yet() {
    let system = common::table_1(8.0, 7.5);
    let mut tangent = Tangent::begin(&system, state([3.0, 0.0, 4.0, 0.0]));
    tangent.period(&state([0.0; 4]));
    assert_eq!((tangent.size(), tangent.logarithm()), (5.0, 0.0));
    assert!(tangent.normalize());
    assert!((tangent.logarithm() - libm::log(5.0)).abs() < 1e-15 && tangent.size() == 1.0);
    let mut gone = Tangent::begin(&system, state([0.0; 4]));
    assert!(!gone.normalize());
}

/// The exponent of `system` over `periods`, once `discard` of them have passed.
fn exponent(system: &System, start: State, discard: u64, periods: u64) -> Exponent {
    let mut simulation = Simulation::new(system, start, 0.0).expect("inside the cavity");
    simulation.run(discard, u64::MAX, &mut ());
    let mut lyapunov = Lyapunov::begin(system);
    simulation.run(periods, u64::MAX, &mut lyapunov);
    lyapunov.exponent().expect("long enough")
}

const START: State = State { x: 0.2, x_velocity: 0.2, y: 0.0, y_velocity: 0.8 };

/// The spectral radius of the half-period map of the exact orbit, to the four digits that an
/// independent program printed; a complex pair makes the estimate swing by a bounded amount over the
/// number of periods.
#[test]
fn a_stable_motion_has_the_exponent_of_its_multipliers() {
    for (frequency, clearance, radius) in
        [(8.0, 7.5, 0.9726), (8.0, 15.0, 0.9650), (8.5, 20.0, 0.9667)]
    {
        let system = common::table_1(frequency, clearance);
        let found = exponent(&system, START, 2000, 20_000);
        let expected = 2.0 * libm::log(radius);
        assert!((found.per_period - expected).abs() < 2e-4, "{found:?}, not {expected}");
        assert!(found.converged && found.interval[1] < 0.0, "{found:?}");
        assert!(found.interval[0] <= expected + 1e-4 && expected - 1e-4 <= found.interval[1]);
    }
}

/// Where friction turns the absorber in flight the exponent is still that of the tangent, which finite differences judge: as
/// one tangent that is never made smaller grows on the same trajectory.
#[test]
fn the_exponent_knows_of_slip_reversals() {
    #[derive(Default)]
    struct Reversals(u32);
    impl Observer for Reversals {
        fn reversal(&mut self, _: &Reversal) {
            self.0 += 1;
        }
    }
    let ideal = common::table_1(8.0, 2.5);
    let cavity = Cavity { friction_acceleration: 0.1, ..Cavity::IDEAL };
    let system = System::new(Parameters { cavity, ..ideal.parameters() }).expect("valid");
    let mut simulation = Simulation::new(&system, START, 0.0).expect("inside the cavity");
    simulation.run(500, u64::MAX, &mut ());
    let mut tangent = Tangent::begin(&system, state([0.5, -0.3, 0.2, 0.7]));
    let (mut lyapunov, mut reversals) = (Lyapunov::begin(&system), Reversals::default());
    let mut logarithm = |periods| {
        let all = &mut ((&mut tangent, &mut lyapunov), &mut reversals);
        simulation.run(periods, u64::MAX, all);
        libm::log(tangent.size())
    };
    // The exponent leaves out twenty periods in which changes align, and counts by powers of two.
    let before = logarithm(20);
    let rate = (logarithm(256) - before) / 256.0;
    let found = lyapunov.exponent().expect("long enough").per_period;
    assert!(reversals.0 > 256, "{}", reversals.0);
    assert!((found - rate).abs() < 1e-9, "{found} {rate}");
}

/// Two neighbours on a chaotic motion part at the rate of the exponent: the mean logarithm of how far
/// they are apart after some periods, an estimate that knows nothing of tangents.
#[test]
fn neighbours_part_at_the_rate_of_a_positive_exponent() {
    let system = common::table_1(8.0, 20.0);
    let found = exponent(&system, START, 500, 20_000);
    assert!(found.converged && found.interval[0] > 0.0, "{found:?}");
    let mut simulation = Simulation::new(&system, START, 0.0).expect("inside the cavity");
    simulation.run(500, u64::MAX, &mut ());
    let (apart, periods, pairs) = (1e-10, 10, 1000);
    let mut sum = 0.0;
    for _ in 0..pairs {
        let here = simulation.state();
        let neighbour = State { x_velocity: here.x_velocity + apart, ..here };
        let mut other = Simulation::new(&system, neighbour, 0.0).expect("inside the cavity");
        let distance = |a: State, b: State| {
            let (a, b) = (numbers(a), numbers(b));
            libm::sqrt((0..4).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum())
        };
        // Alignment is no growth: it is over after a few periods.
        simulation.run(5, u64::MAX, &mut ());
        other.run(5, u64::MAX, &mut ());
        let aligned = distance(simulation.state(), other.state());
        simulation.run(periods, u64::MAX, &mut ());
        other.run(periods, u64::MAX, &mut ());
        let later = distance(simulation.state(), other.state());
        sum += libm::log(later / aligned) / periods as f64;
    }
    let mean = sum / f64::from(pairs);
    assert!((mean - found.per_period).abs() < 0.1 * found.per_period, "{mean} {found:?}");
}

/// The 1:1 motion at 8 Hz ends at b = 16.695 mm, where a multiplier of the exact orbit reaches +1. Near
/// a saddle-node the exponent is proportional to the root of the distance, so that its square meets
/// zero on a straight line.
#[test]
fn the_exponent_vanishes_where_the_exact_orbit_ends() {
    let settled = |clearance: f64, start: State| {
        let system = common::table_1(8.0, clearance);
        let mut simulation = Simulation::new(&system, start, 0.0).expect("inside the cavity");
        simulation.run(3000, u64::MAX, &mut ());
        simulation.state()
    };
    let mut state = settled(16.0, START);
    let mut last = 16.0;
    let squares = [16.5, 16.65, 16.68, 16.69, 16.693, 16.694].map(|clearance| {
        state = settled(clearance, carried_over(state, last / clearance, 1.0));
        last = clearance;
        let found = exponent(&common::table_1(8.0, clearance), state, 0, 2000);
        assert!(found.converged && found.is_negative(), "{clearance} mm: {found:?}");
        found.per_period * found.per_period
    });
    let slope = (squares[5] - squares[4]) / 0.001;
    let end = 16.694 - squares[5] / slope;
    assert!((end - 16.695).abs() < 5e-4, "ends at {end} mm");
}
