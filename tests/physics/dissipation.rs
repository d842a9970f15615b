//! The dissipation curve: against closed form, an impact pair stepped by hand, known values; and the slow flow on
//! it against the theory of two impacts, its own Jacobian, and simulation of the full system.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::LazyLock;

use vinesink::analysis::{Analysis, Area, Manifold};
use vinesink::dissipation::{
    AveragedFlow, DissipationCurve, ModulatedCycle, PairBranch, PairPoint, Recapture, SteadyState,
};
use vinesink::equations::dissipation as formulas;
use vinesink::executor::Serial;
use vinesink::motions::{Effort, Measured, Motion, Motions, Place, Window};
use vinesink::regimes::{Regime, classify};
use vinesink::simulation::{ImpactLog, Measurement, Simulation};
use vinesink::study::CaseStudy;
use vinesink::system::{Cavity, Excitation, Parameters, State, System};
use vinesink::validation::{Claim, Finding, Verdict, motions as motions_claims};

use crate::common::{MASS_RATIO, periods_to, slow_amplitudes, table_1};

/// `lambda` of Table 1, rounded.
const DAMPING: f64 = 1.799;

/// That of Table 1, which several tests ask.
static CURVE: LazyLock<DissipationCurve> = LazyLock::new(|| DissipationCurve::of(0.6, [0.1, 3.2]));

/// The long-term motions from so many starts.
fn motions(system: &System, starts: u32, effort: &Effort) -> Motions {
    let place = Place::new(system, starts);
    vinesink::motions::motions(&[place], effort, &Serial).expect("inside").remove(0)
}

fn system(mass_ratio: f64, damping: f64, restitution: f64, sigma: f64, gamma: f64) -> System {
    System::new(Parameters {
        mass_ratio,
        damping,
        restitution,
        frequency_ratio: 1.0,
        forcing_per_clearance: gamma,
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    })
    .and_then(|system| system.with_detuning(sigma))
    .expect("valid")
}

/// The branches with impacts at an amplitude.
fn at(curve: &DissipationCurve, amplitude: f64) -> Vec<&PairBranch> {
    let moving = |branch: &&PairBranch| branch.points[0].regime != Regime::AtRest;
    curve.branches.iter().filter(|branch| branch.covers(amplitude)).filter(moving).collect()
}

fn nearest(branch: &PairBranch, amplitude: f64) -> &PairPoint {
    let apart = |point: &&PairPoint| (point.amplitude - amplitude).abs();
    branch.points.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).expect("points")
}

/// `S` and `K` by (14), (15) and the sawtooth's first harmonic, and the pair's state where `x` is lowest.
fn by_hand(restitution: f64, c: f64) -> ([f64; 2], [f64; 2]) {
    let rho = (1.0 - restitution) / (1.0 + restitution);
    let curvature = 4.0 * rho * rho / (PI * PI);
    let b = (1.0 + ((1.0 + curvature) * c * c - curvature).max(0.0).sqrt()) / (1.0 + curvature);
    let (sine, cosine) = (2.0 / PI * rho * b / c, (1.0 - b) / c);
    let e = 8.0 * b / (PI * PI);
    let turned = libm::atan2(sine, cosine) - FRAC_PI_2;
    let w = -c + 2.0 / PI * b * libm::asin(libm::sin(turned));
    ([e * sine, e * cosine], [w, -2.0 / PI * b * libm::cos(turned).signum()])
}

/// The pair's averages by steps of a thousandth of a radian and bisection, from impulses instead of displacements:
/// the first harmonic of `y` is that of `-y''`. Of 300 periods after as many.
fn stepped(restitution: f64, c: f64, [w, velocity]: [f64; 2]) -> [f64; 2] {
    const PERIODS: f64 = 300.0;
    let x = |t: f64| -c * libm::cos(t);
    let (mut from, mut y, mut v) = (0.0, x(0.0) - w, velocity);
    let (mut sums, mut t) = ([0.0; 2], 0.0);
    while t < 2.0 * PERIODS * TAU {
        let out = |s: f64| (x(s) - (y + v * (s - from))).abs() - 1.0 > 1e-14;
        if !out(t + 1e-3) {
            t += 1e-3;
            continue;
        }
        let (mut low, mut high) = (t, t + 1e-3);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if out(middle) { high = middle } else { low = middle }
        }
        let wall = (x(high) - (y + v * (high - from))).signum();
        let after = (1.0 + restitution) * c * libm::sin(high) - restitution * v;
        if high > PERIODS * TAU {
            // psi = t - pi/2.
            sums[0] += (after - v) * libm::sin(high) / (PI * PERIODS);
            sums[1] -= (after - v) * libm::cos(high) / (PI * PERIODS);
        }
        (y, v, from, t) = (x(high) - wall, after, high, high);
    }
    sums
}

/// On the stable branch, for every restitution: the engine's averages are the closed form.
#[test]
fn averages_are_the_closed_form_on_the_stable_branch() {
    for restitution in [0.0, 0.3, 0.6, 0.9] {
        let curve = DissipationCurve::of(restitution, [0.5, 0.5]);
        let closed = curve.branches.iter().find(|branch| branch.closed_form).expect("one");
        assert_eq!(closed.range()[0], Manifold::of(restitution).fold.oscillator_amplitude);
        for place in [16, 64, 112] {
            let point = &closed.points[place];
            let c = point.amplitude;
            let (forces, state) = by_hand(restitution, c);
            let found = PairPoint::measured(restitution, c, state).expect("a motion");
            let kind = (found.regime, found.repeats_after);
            assert_eq!(kind, (Regime::TwoSymmetric, Some(1)), "{restitution} {c}: {found:?}");
            let between = 0.5 * (c + closed.points[place + 1].amplitude);
            let (interpolated, errors) = closed.forces(between).expect("on it");
            for k in 0..2 {
                // Rounding of some hundred flights that a multiplier below 1 forgets.
                assert!((found.forces()[k] - forces[k]).abs() < 1e-12, "{found:?} {forces:?}");
                assert!((point.forces()[k] - forces[k]).abs() < 1e-14, "{point:?} {forces:?}");
                let apart = (interpolated[k] - by_hand(restitution, between).0[k]).abs();
                assert!(apart <= errors[k] && errors[k] < 1e-3, "{c}: {apart} {errors:?}");
            }
        }
    }
}

/// Values of the derivation, to their printed digits; those of chaos within the errors of the averages.
#[test]
fn values_are_the_known_ones() {
    let known = [
        (0.2, 0.777, -0.433, 2.0),
        (0.5, 0.538, -1.040, 2.0),
        (0.7, 0.501, -1.239, 2.0),
        (0.9, 0.538, -1.233, 2.0),
        (1.2, 0.554, -1.686, 3.0),
        (1.6, 0.552, -2.041, 2.77),
        (2.2, 0.599, -2.561, 3.05),
        (3.0, 0.676, -3.556, 4.0),
    ];
    for (c, resistance, reactance, impacts) in known {
        let matches = |branch: &&PairBranch| {
            let ([s, k], errors) = branch.forces(c).expect("covered");
            let point = nearest(branch, c);
            let repeats = point.repeats_after.is_some();
            // Half a printed digit; chaos was averaged by the other program too, for no longer.
            let error = |k: usize| 5.1e-4 + if repeats { 0.0 } else { 2.0 * errors[k] };
            let apart = (point.impacts_per_period - impacts).abs();
            (s - resistance).abs() <= error(0)
                && (k - reactance).abs() <= error(1)
                && apart <= if repeats { 0.0 } else { 0.1 }
                && error(1) < 0.02
        };
        let found = at(&CURVE, c);
        assert!(
            found.iter().any(matches),
            "{c}: {:?}",
            found.iter().map(|branch| (branch.forces(c), nearest(branch, c))).collect::<Vec<_>>()
        );
    }
}

/// Impacts of motions beyond the closed form, found and averaged in another way.
#[test]
fn averages_are_those_of_a_pair_stepped_by_hand() {
    averages_are_those_of_steps(&[(0.6, 1.2)]);
}

#[test]
#[ignore = "deep"]
fn averages_of_four_more_are_those_of_a_pair_stepped_by_hand() {
    averages_are_those_of_steps(&[(0.6, 0.9), (0.6, 3.0), (0.75, 2.6), (0.3, 1.0)]);
}

fn averages_are_those_of_steps(pairs: &[(f64, f64)]) {
    for &(restitution, c) in pairs {
        let start = [0.3, 1.4 * c];
        let found = PairPoint::measured(restitution, c, start).expect("a motion");
        assert!(found.repeats_after.is_some() && found.regime != Regime::TwoSymmetric, "{found:?}");
        let by_steps = stepped(restitution, c, start);
        for k in 0..2 {
            // 300 periods are whole repetitions, whose ends are alike; what is left of transients of two ways.
            assert!((found.forces()[k] - by_steps[k]).abs() < 1e-7, "{found:?} {by_steps:?}");
        }
    }
}

/// Branches end and begin where the closed form says.
#[test]
fn fold_and_symmetry_breaking_are_where_the_closed_form_has_them() {
    for restitution in [0.3, 0.6, 0.8] {
        let manifold = Manifold::of(restitution);
        let [fold, end] =
            [manifold.fold, manifold.symmetry_breaking].map(|at| at.oscillator_amplitude);
        let from = |c: f64, of: f64| {
            PairPoint::measured(restitution, c, by_hand(restitution, of).1).expect("a motion")
        };
        assert_eq!(from(1.02 * fold, 1.02 * fold).regime, Regime::TwoSymmetric);
        assert_ne!(from(0.98 * fold, 1.001 * fold).regime, Regime::TwoSymmetric);
        assert_eq!(from(0.98 * end, 0.98 * end).regime, Regime::TwoSymmetric);
        let beyond = from(1.02 * end, 0.98 * end);
        assert_eq!((beyond.regime, beyond.impacts_per_period), (Regime::TwoAsymmetric, 2.0));
    }
    let closed = CURVE.branches.iter().find(|branch| branch.closed_form).expect("one");
    let manifold = Manifold::of(0.6);
    let ends = [manifold.fold, manifold.symmetry_breaking].map(|at| at.oscillator_amplitude);
    assert_eq!(closed.range(), ends);
    let asymmetric = at(&CURVE, 0.9);
    assert_eq!(asymmetric.len(), 1);
    // Ends are located within a sixteenth of a step of 0.02.
    let gap = asymmetric[0].range()[0] - ends[1];
    assert!((0.0..0.02 / 16.0).contains(&gap), "{gap}");
}

#[test]
fn motions_of_two_and_three_impacts_coexist() {
    for c in [1.02, 1.04, 1.06] {
        let found = at(&CURVE, c);
        let impacts: Vec<f64> =
            found.iter().map(|branch| nearest(branch, c).impacts_per_period).collect();
        assert!(impacts.iter().any(|z| (z - 2.0).abs() < 0.1), "{c}: {impacts:?}");
        assert!(impacts.contains(&3.0), "{c}: {impacts:?}");
    }
    assert!(at(&CURVE, 0.9).len() == 1 && at(&CURVE, 1.15).len() == 1);
}

/// Every motion that twelve starts find by brute force, stepped and bisected (`peers/brute/pair.c`, restitutions of 0.65 to 0.95,
/// amplitudes of 0.2 to 1.2 in steps of 0.02), where several repeat at one amplitude and are there for four steps at least.
#[test]
fn no_motion_that_brute_force_finds_is_missed() {
    let rows: Vec<Vec<f64>> = include_str!("impact_pair.csv")
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect())
        .collect();
    let mut curve = DissipationCurve::of(rows[0][0], [0.1, 1.5]);
    let mut missed = Vec::new();
    for row in &rows {
        if row[0] != curve.restitution {
            curve = DissipationCurve::of(row[0], [0.1, 1.5]);
        }
        let (c, forces) = (row[1], [row[3], row[4]]);
        let close = |branch: &PairBranch| {
            let (own, errors) = branch.forces(c).expect("covered");
            // A part of what a branch changes by in a step, near an end that is steep, and of what tells motions apart.
            (0..2).all(|k| (own[k] - forces[k]).abs() < 0.01 + errors[k])
        };
        if !at(&curve, c).into_iter().any(close) {
            missed.push(row);
        }
    }
    assert!(
        rows.len() > 150 && missed.is_empty(),
        "{} of {}: {missed:?}",
        missed.len(),
        rows.len()
    );
}

/// Elastic impacts forget nothing and take nothing: averages depend on the start, and there is no curve beyond the
/// closed form. At the largest restitution of which motions are followed, what does not repeat is one motion.
#[test]
fn elastic_impacts_have_no_curve_because_averages_depend_on_the_start() {
    const C: f64 = 2.2;
    let starts = [[0.3, 1.4], [-0.8, -0.6], [0.1, 0.5], [-0.3, -2.0], [0.0, 3.2], [-0.6, 4.0]];
    // The largest difference of K, over what both averages are known to.
    let apart = |restitution: f64| {
        let found: Vec<PairPoint> = starts
            .iter()
            .filter_map(|[w, speed]| PairPoint::measured(restitution, C, [*w, speed * C]))
            .filter(|point| point.repeats_after.is_none())
            .collect();
        assert!(found.len() > 3, "{found:?}");
        if restitution == 1.0 {
            // Energy that is not lost is not taken; what an average of some thousand impacts leaves of that.
            assert!(found.iter().all(|point| point.resistance.abs() < 5e-3), "{found:?}");
        }
        let pairs = found.iter().flat_map(|a| found.iter().map(move |b| (a, b)));
        let pairs =
            pairs.map(|(a, b)| (a.reactance - b.reactance).abs() / (a.errors[1] + b.errors[1]));
        pairs.fold(0.0, f64::max)
    };
    let [elastic, almost] = [1.0, 0.995].map(apart);
    assert!(elastic > 3.0 && almost < 1.5, "{elastic} {almost}");
    for restitution in [1.0, 0.999] {
        let curve = DissipationCurve::of(restitution, [0.1, 3.2]);
        assert!(curve.depends_on_start && curve.branches.len() == 2, "{}", curve.branches.len());
        assert!(curve.branches[0].points.iter().all(|point| point.regime == Regime::AtRest));
        assert!(curve.branches[1].closed_form);
    }
    assert!(!CURVE.depends_on_start);
    let curve = DissipationCurve::of(1.0, [0.1, 3.2]);
    assert!(curve.branches[1].points.iter().all(|point| point.resistance == 0.0));
}

/// Motions that repeat are followed until nothing of the transient is left, also where chaos comes before.
#[test]
fn averages_of_motions_that_repeat_are_known_to_rounding() {
    let starts =
        [[0.3, 1.4], [-0.8, -0.6], [0.7, 2.5], [0.1, 0.5], [-0.3, -2.0], [0.0, 3.2], [-0.6, 4.0]];
    let mut repeat = 0;
    for [w, speed] in starts {
        for c in [0.5, 3.0] {
            let found = PairPoint::measured(0.97, c, [w, c * speed]).expect("a motion");
            if found.repeats_after.is_some() {
                repeat += 1;
                assert!(found.errors.iter().all(|error| *error < 1e-6), "{found:?}");
            }
        }
    }
    assert!(repeat > 6, "{repeat}");
}

/// Trace and determinant are those of the rates (18) differentiated numerically, and on the closed form those of
/// the theory of two impacts.
#[test]
fn the_jacobian_is_that_of_the_rates() {
    let (lambda, sigma, gamma_sine) = (0.7, -0.4, 1.3);
    let force = |c: f64| [0.5 + 0.3 * c - 0.1 * c * c, -0.2 - 1.1 * c];
    let c = 0.8;
    let [s, k] = force(c);
    assert!((0.0..gamma_sine).contains(&s));
    let sides = [lambda * c + s, k - 2.0 * sigma * c];
    let (gamma, eta) = (libm::hypot(sides[0], sides[1]), libm::atan2(sides[0], sides[1]));
    assert!((formulas::FORCING_SQUARED.at([lambda, sigma, s, k, c]).sqrt() - gamma).abs() < 1e-15);
    let rates = |c: f64, eta: f64| {
        let [s, k] = force(c);
        [
            (-lambda * c - s + gamma * libm::sin(eta)) / 2.0,
            sigma + (gamma * libm::cos(eta) - k) / (2.0 * c),
        ]
    };
    rates(c, eta).iter().for_each(|rate| assert!(rate.abs() < 1e-15, "{rate}"));
    let step = 1e-5;
    let by = |d: [f64; 2]| {
        let [plus, minus] =
            [1.0, -1.0].map(|sign| rates(c + sign * step * d[0], eta + sign * step * d[1]));
        [0, 1].map(|k| (plus[k] - minus[k]) / (2.0 * step))
    };
    let [of_c, of_eta] = [by([1.0, 0.0]), by([0.0, 1.0])];
    let [s_prime, k_prime] = [0.3 - 0.2 * c, -1.1];
    let trace = formulas::TRACE.at([lambda, s, s_prime, c]);
    let determinant = formulas::DETERMINANT.at([lambda, sigma, s, k, s_prime, k_prime, c]);
    // Central differences: step^2, and rounding over the step.
    assert!((trace - of_c[0] - of_eta[1]).abs() < 1e-9);
    assert!((determinant - (of_c[0] * of_eta[1] - of_eta[0] * of_c[1])).abs() < 1e-9);
    // The two detunings of the response hold this amplitude.
    let root = formulas::RESPONSE_ROOT.at([lambda, gamma, s, c]);
    let both =
        [formulas::LOWER_DETUNING.at([k, c, root]), formulas::UPPER_DETUNING.at([k, c, root])];
    assert!(both.iter().any(|found| (found - sigma).abs() < 1e-14), "{both:?}");
}

#[test]
fn on_the_stable_branch_it_is_the_theory_of_two_impacts() {
    let system = system(MASS_RATIO, DAMPING, 0.6, -0.2, 1.7);
    let analysis = Analysis::of(&system).expect("analysable");
    let point = analysis.stable_points().next().expect("one");
    let states = AveragedFlow::of(&system, &CURVE).steady_states().expect("analysable");
    let state = states.iter().find(|state| state.regime == Regime::TwoSymmetric).expect("one");
    assert_eq!(
        (state.amplitude, state.eta, state.stable),
        (point.oscillator_amplitude, point.eta, true)
    );
    // Trace and determinant by the general formula, with derivatives of the closed form.
    let c = state.amplitude;
    let ([s, k], _) = by_hand(0.6, c);
    let slope = |of: usize| (by_hand(0.6, c + 1e-5).0[of] - by_hand(0.6, c - 1e-5).0[of]) / 2e-5;
    let trace = formulas::TRACE.at([DAMPING, s, slope(0), c]);
    let determinant = formulas::DETERMINANT.at([DAMPING, -0.2, s, k, slope(0), slope(1), c]);
    assert!(
        (trace - point.trace).abs() < 1e-8 && (determinant - point.determinant).abs() < 1e-8,
        "{trace} {determinant} {point:?}"
    );
}

/// A point of the response is a steady amplitude of the system with that detuning, as stable there as here.
#[test]
fn the_response_holds_the_steady_amplitudes_of_every_detuning() {
    let system = table_1(8.35, 11.5);
    let flow = AveragedFlow::of(&system, &CURVE);
    let (mut stable, mut unstable) = (0, 0);
    for branch in &CURVE.branches {
        for pair in branch.points.windows(2).skip(1).step_by(9) {
            let mut point = pair[0];
            if !branch.closed_form {
                // Within a piece: rounding may put a root at its end into neither of two.
                point.amplitude = 0.7 * pair[0].amplitude + 0.3 * pair[1].amplitude;
                [point.resistance, point.reactance] =
                    branch.forces(point.amplitude).expect("on it").0;
            }
            let repeats = pair.iter().all(|point| point.repeats_after.is_some());
            let repeats = repeats && point.regime != Regime::AtRest;
            let Some(both) = flow.stability(branch, &point).filter(|_| repeats) else { continue };
            for (sigma, is_stable) in both {
                let there = system.with_detuning(sigma).expect("valid");
                let states = AveragedFlow::of(&there, &CURVE).steady_states().expect("analysable");
                let apart = |state: &SteadyState| (state.amplitude - point.amplitude).abs();
                let near = states.iter().filter(|state| state.regime == point.regime);
                let near = near.min_by(|a, b| apart(a).total_cmp(&apart(b))).expect("a state");
                // Amplitude and detuning are roots of one equation; half the digits are left where two meet.
                assert!(apart(near) < 1e-7, "{sigma} {point:?} {near:?}");
                assert_eq!(near.stable, is_stable, "{sigma} {point:?} {near:?}");
                if is_stable { stable += 1 } else { unstable += 1 }
            }
        }
    }
    assert!(stable > 20 && unstable > 0, "{stable} {unstable}");
}

/// Three impacts per period in simulation are the flow's, and would not be if its amplitude were a tenth off.
#[test]
fn a_claim_of_the_averaged_flow_is_confirmed_by_simulation_and_refuted_where_it_is_wrong() {
    let system = table_1(8.35, 11.5);
    let effort = Effort { starts: 4, discard: Some(300), ..Effort::over(200) };
    let study = CaseStudy::of(&system, &motions(&system, 4, &effort), effort).expect("studied");
    assert!(study.averages.is_none());
    let study = study.with_averages().expect("analysable");
    let judged = |claims: &[Claim]| {
        let mut found = claims.iter().filter(|claim| claim.id.starts_with("averaged-motion-"));
        let claim = found.next().expect("one").clone();
        assert!(found.next().is_none());
        claim
    };
    let claim = judged(&study.claims);
    assert_eq!(claim.verdict, Verdict::Confirmed, "{claim:?}");
    assert!(claim.difference.expect("a number").abs() < 0.01, "{claim:?}");
    // Three times 0.77 % of (2 + 1.8) and the detuning.
    assert!((claim.tolerance - 0.088).abs() < 1e-3, "{claim:?}");
    let averages = study.averages.expect("asked for");
    let of = |states: &[SteadyState], range| {
        motions_claims::averaged(&system, states, None, range, &study.motions)
    };
    let mut wrong = averages.states.clone();
    wrong.iter_mut().for_each(|state| state.amplitude *= 1.1);
    assert_eq!(judged(&of(&wrong, averages.range)).verdict, Verdict::Refuted);
    let none = judged(&of(&[], averages.range));
    assert_eq!((none.verdict, none.predicted), (Verdict::Refuted, Finding::NoAmplitude));
    // What the curve does not reach it says nothing of.
    assert!(of(&averages.states, [0.1, 0.9]).is_empty());
}

/// Through four and three impacts per period, chaos, asymmetric and symmetric 1:1 down to the fold.
#[test]
fn free_decay_from_three_clearances_passes_all_regimes() {
    let system = system(MASS_RATIO, DAMPING, 0.6, 0.0, 0.0);
    let path = AveragedFlow::of(&system, &CURVE).decay(3.0, 0.16);
    assert!(path.windows(2).all(
        |pair| pair[1].slow_time >= pair[0].slow_time && pair[1].amplitude <= pair[0].amplitude
    ));
    let start = State { x: 0.0, x_velocity: 3.0, y: 0.3, y_velocity: 1.0 };
    let amplitudes = slow_amplitudes(&system, start, 200);
    let when = |level: f64| periods_to(&amplitudes, level);
    let theory = |level: f64| {
        let after = path.iter().position(|point| point.amplitude <= level).expect("on the path");
        path[after].slow_time / MASS_RATIO / TAU
    };
    let begin = 2.9;
    for level in [2.0, 1.5, 1.0, 0.72, 0.5, 0.3, 0.2] {
        let (found, simulated) = (theory(level) - theory(begin), when(level) - when(begin));
        // 5 to 9 % were found with another program, which began elsewhere; here it is 2 % and less.
        assert!((found / simulated - 1.0).abs() < 0.05, "{level}: {found} {simulated}");
    }
}

/// The amplitude of the simulated motion with three impacts at 8.35 Hz, 11.5 mm and a base that moves by 0.25 mm.
#[test]
fn the_forced_amplitude_of_three_impacts_is_the_simulated_one() {
    let system = table_1(8.35, 11.5);
    let states = AveragedFlow::of(&system, &CURVE).steady_states().expect("analysable");
    let found = motions(&system, 8, &Effort::over(200));
    let three = |one: &&Motion| one.facts().impacts_per_period.value == 3.0;
    let simulated = found.iter().find(three).expect("three impacts");
    let amplitude = std::f64::consts::SQRT_2 * simulated.facts().rms.value;
    let theory =
        states.iter().find(|state| state.stable && state.impacts_per_period == 3.0).expect("one");
    assert!((theory.amplitude / amplitude - 1.0).abs() < 0.01, "{theory:?} {amplitude}");
}

/// Amplitudes of asymmetric impacts and of three per period, where the forcing holds a point of the curve exactly, so that
/// no interpolation is in them: the error falls with the mass ratio, in proportion to it, and is within
/// `eps (2 + abs(sigma) + lambda)`.
#[test]
fn forced_amplitudes_are_of_first_order_in_the_mass_ratio() {
    let wanted = [(0.85, Regime::TwoAsymmetric, 4.0, 1), (1.1, Regime::AboveTwo, 3.0, 0)];
    for (amplitude, regime, gamma, side) in wanted {
        let forced = |mass_ratio, sigma| system(mass_ratio, DAMPING, 0.6, sigma, gamma);
        let branches = at(&CURVE, amplitude).into_iter();
        let near = branches.map(|branch| (branch, nearest(branch, amplitude)));
        let (branch, point) =
            near.into_iter().find(|(_, point)| point.regime == regime).expect("on a branch");
        let flow_of = forced(MASS_RATIO, 0.0);
        let both = AveragedFlow::of(&flow_of, &CURVE).stability(branch, point).expect("held");
        let (sigma, stable) = both[side];
        assert!(stable && point.repeats_after.is_some(), "{both:?} {point:?}");
        let error = |part: f64| {
            let system = forced(MASS_RATIO / part, sigma);
            let found = motions(&system, 8, &Effort::over(200));
            let one = found.iter().find(|one| one.regime() == regime).expect("simulated");
            let rms = one.facts().rms.value;
            let error = point.amplitude / (std::f64::consts::SQRT_2 * rms) - 1.0;
            assert!(error.abs() < MASS_RATIO / part * (2.0 + sigma.abs() + DAMPING), "{error}");
            error
        };
        let errors = [1.0, 4.0, 16.0].map(error);
        // A quarter, but for terms of second order and the rounding of repetitions.
        let falls = errors.windows(2).map(|pair| pair[1] / pair[0]);
        assert!(falls.into_iter().all(|fall| (0.2..0.35).contains(&fall)), "{errors:?}");
    }
}

/// Numbers from 0 to 1 that are evenly spread: multiples of roots of primes, modulo 1.
fn spread(index: u32) -> [f64; 5] {
    [2.0_f64, 3.0, 5.0, 7.0, 11.0].map(|prime| (0.5 + prime.sqrt() * f64::from(index)).fract())
}

/// Twenty systems in the areas Z2 and Z1, beyond symmetry breaking, as a fixed sequence has them, each as four starts
/// find it: every motion with impacts is one of the flow's stable amplitudes. With curves to three clearances the
/// flow had no answer for two of them, whose amplitudes are 3.26 and 3.32; none is left without one to four.
#[test]
fn forced_amplitudes_of_twenty_systems_are_the_simulated_ones() {
    /// Restitutions, few because each has its curve.
    const RESTITUTIONS: [f64; 3] = [0.45, 0.6, 0.75];
    const LARGEST_BARE: f64 = 3.0;
    let curves = RESTITUTIONS.map(|r| DissipationCurve::of(r, [0.5, 4.0]));
    let mut judged = 0;
    for index in 1.. {
        let [a, b, c, d, e] = spread(index);
        let (mass_ratio, damping) = (0.002 * libm::pow(10.0, a), 0.3 + 2.7 * b);
        let (sigma, gamma) = (4.0 * c - 2.0, 1.0 + 8.0 * d);
        let curve = &curves[(3.0 * e) as usize];
        let system = system(mass_ratio, damping, curve.restitution, sigma, gamma);
        let analysis = Analysis::of(&system).expect("analysable");
        let asymmetric = matches!(analysis.zone.area, Area::Z1 | Area::Z2);
        let beyond = asymmetric && gamma > analysis.boundaries.symmetry_breaking;
        if !beyond || gamma > LARGEST_BARE * libm::hypot(damping, 2.0 * sigma) {
            continue;
        }
        // What the theory of first order neglects, three times.
        let tolerance = 3.0 * mass_ratio * (2.0 + sigma.abs() + damping);
        let states = AveragedFlow::of(&system, curve).steady_states().expect("analysable");
        let found = motions(&system, 4, &Effort::over(300));
        let led_to = |motion: &&Motion| motion.rest().is_none() && motion.reached().starts > 0;
        assert!(found.iter().any(|motion| led_to(&motion)), "{system:?}");
        for motion in found.iter().filter(led_to) {
            let amplitude = std::f64::consts::SQRT_2 * motion.facts().rms.value;
            let stable =
                states.iter().filter(|state| state.stable && state.regime != Regime::AtRest);
            let error = stable
                .map(|state| (state.amplitude / amplitude - 1.0).abs())
                .fold(f64::INFINITY, f64::min);
            assert!(error < tolerance, "{error} {tolerance} {motion:?} {system:?} {states:?}");
        }
        judged += 1;
        if judged == 20 {
            return;
        }
    }
}

/// What a start leads to, measured over some hundred modulations.
fn simulated(system: &System) -> Measured {
    let slow = (3.0 / system.mass_ratio()) as u64;
    // Some hundred captures: their share is then known to a few hundredths.
    let window = Window { discard: slow, periods: 32 * slow, impact_limit: u64::MAX };
    let start = State { x: 0.1, x_velocity: 0.0, y: -0.3, y_velocity: 0.1 };
    Measured::reach(system, start, &window).expect("inside")
}

/// Twenty systems whose simulated motion is strongly modulated, as a fixed sequence has them: the flow has a cycle for each,
/// as large as the simulated motion, and as long captured. A capture in simulation begins and ends some
/// periods beside the flow's: the absorber stays for them with two impacts per period after the fold.
#[test]
fn modulated_cycles_are_the_simulated_ones() {
    const RESTITUTIONS: [f64; 3] = [0.5, 0.6, 0.75];
    let recaptures = RESTITUTIONS.map(|r| Recapture::of(r).expect("forgets its start"));
    let mut judged = 0;
    for index in 1.. {
        let [a, b, c, d, e] = spread(index);
        let (mass_ratio, damping) = (0.001 * libm::pow(10.0, a), 0.3 + 2.0 * b);
        let sigma = 6.0 * c - 3.0;
        let (recapture, restitution) =
            (&recaptures[(3.0 * e) as usize], RESTITUTIONS[(3.0 * e) as usize]);
        let bare = Manifold::of(restitution).fold.oscillator_amplitude * (1.2 + 1.6 * d);
        let gamma = bare * libm::hypot(damping, 2.0 * sigma);
        let system = system(mass_ratio, damping, restitution, sigma, gamma);
        let found = simulated(&system);
        if found.classification.regime != Regime::StronglyModulated {
            continue;
        }
        let cycle = ModulatedCycle::of(&system, recapture).expect("a cycle");
        // First order in the mass ratio, three times; and a twentieth for captures whose rate depends on how the
        // absorber left, of which the flow knows the average.
        let tolerance = 0.05 + 3.0 * mass_ratio * (2.0 + sigma.abs() + damping);
        let error = cycle.rms / found.facts.rms.value - 1.0;
        assert!(error.abs() < tolerance, "{error} {tolerance} {system:?} {cycle:?}");
        let captures = found.classification.evidence.captures;
        let apart = cycle.captured_share - captures.share;
        assert!(apart.abs() < 0.2, "{apart} {system:?} {cycle:?} {captures:?}");
        judged += 1;
        if judged == 20 {
            return;
        }
    }
}

/// The largest amplitude of a cycle is one of a flow with average forces, which the irregular motion between captures scatters:
/// what 600 periods of simulation come to is within that, of all systems of a fixed sequence that stay modulated.
#[test]
fn the_largest_amplitude_of_a_cycle_is_known_to_its_scatter() {
    const RESTITUTION: f64 = 0.45;
    let recapture = Recapture::of(RESTITUTION).expect("forgets its start");
    let fold = Manifold::of(RESTITUTION).fold.oscillator_amplitude;
    let (mut judged, mut missed) = (0, Vec::new());
    for index in 1..200 {
        let [a, b, c, d, _] = spread(index);
        let (mass_ratio, damping) = (0.002 * libm::pow(10.0, a), 0.3 + 2.0 * b);
        let sigma = 6.0 * c - 3.0;
        let gamma = fold * (1.2 + 1.6 * d) * libm::hypot(damping, 2.0 * sigma);
        let system = system(mass_ratio, damping, RESTITUTION, sigma, gamma);
        let Some(cycle) = ModulatedCycle::of(&system, &recapture) else { continue };
        if cycle.lasting_share > 0.0 {
            continue;
        }
        let start = State { x: 0.1, x_velocity: 0.0, y: -0.3, y_velocity: 0.1 };
        let mut simulation = Simulation::new(&system, start, 0.0).expect("inside");
        simulation.run(600, u64::MAX, &mut ());
        let mut measured = Measurement::begin(&system, simulation.state());
        let mut log = ImpactLog::default();
        simulation.run(600, u64::MAX, &mut (&mut measured, &mut log));
        let statistics = measured.statistics();
        let named = classify(statistics, &log.impacts, None, system.period());
        if named.regime != Regime::StronglyModulated {
            continue;
        }
        let largest = statistics.records().iter().map(|record| {
            // Of v = x + eps y.
            let [x, y] = [record.oscillator_harmonic, record.absorber_harmonic];
            libm::hypot(x[0] + mass_ratio * y[0], x[1] + mass_ratio * y[1])
        });
        let largest = largest.fold(0.0, f64::max);
        // The largest of n normal numbers is about sqrt(2 ln n) standard deviations above their mean; and the theory's error is of
        // first order in the mass ratio, as everywhere.
        let cycles = (600.0 / cycle.periods).max(1.0);
        let deviations = (2.0 * libm::log(cycles)).sqrt().max(2.0);
        let allowed = 0.5 * deviations * cycle.largest_scatter
            + largest * mass_ratio * (2.0 + sigma.abs() + damping);
        let apart = largest - cycle.amplitudes[1];
        if apart.abs() > allowed {
            missed.push((apart, allowed, system, cycle));
        }
        judged += 1;
        if judged == 20 {
            break;
        }
    }
    // Two standard deviations and more: one in twenty may be beyond.
    assert!(judged == 20 && missed.len() <= 1, "{judged} {missed:#?}");
}

/// The flow's share of the time in captures approaches the simulated one as the mass ratio falls; the amplitude is within
/// what random captures leave open at any.
#[test]
fn a_modulated_cycle_is_the_limit_of_small_mass_ratios() {
    let recapture = Recapture::of(0.6).expect("forgets its start");
    let missing: Vec<f64> = [1.0, 4.0, 16.0]
        .into_iter()
        .map(|part| {
            let system = system(MASS_RATIO / part, DAMPING, 0.6, 2.36, 1.16);
            let (cycle, found) =
                (ModulatedCycle::of(&system, &recapture).expect("a cycle"), simulated(&system));
            let error = cycle.rms / found.facts.rms.value - 1.0;
            assert!(error.abs() < 0.05, "{error} {cycle:?}");
            found.classification.evidence.captures.share - cycle.captured_share
        })
        .collect();
    assert!(missing.windows(2).all(|pair| pair[1] < pair[0]), "{missing:?}");
    assert!(missing[0] < 0.15 && missing[2].abs() < 0.06, "{missing:?}");
}

/// Nothing captures an absorber below the fold; far above it the symmetric motion does within a period or two. Where the
/// forcing holds a fixed point every capture lasts, and where the oscillator stays below the fold there is none.
#[test]
fn an_absorber_is_captured_above_the_fold_alone() {
    let recapture = Recapture::of(0.6).expect("forgets its start");
    let fold = Manifold::of(0.6).fold.oscillator_amplitude;
    for part in [0.1, 0.5, 1.0] {
        assert_eq!(recapture.rate(part * fold), Some([0.0; 2]));
    }
    let [rate, error] = recapture.rate(2.8 * fold).expect("within");
    assert!(rate - error > 0.5, "{rate} {error}");
    assert_eq!(recapture.rate(1.1), None);
    assert!(Recapture::of(0.999).is_none());
    // Table 1 at 8 Hz and 7.5 mm is in area Z3; a forcing of a tenth leaves the absorber below the fold.
    assert_eq!(ModulatedCycle::of(&table_1(8.0, 7.5), &recapture), None);
    let weak = system(MASS_RATIO, DAMPING, 0.6, 2.36, 0.116);
    assert_eq!(ModulatedCycle::of(&weak, &recapture), None);
}
