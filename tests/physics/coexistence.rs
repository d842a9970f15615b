//! Long-term motions are told apart by what they are: two simulated motions that Newton's method
//! takes to one orbit are one, and two orbits with the same impacts are two.

use crate::common::table_1;
use std::f64::consts::PI;

use vinesink::executor::Serial;
use vinesink::motions::{
    BandEffort, Effort, Measured, Motion, Motions, Place, Window, along, motions,
};
use vinesink::orbits::{Closure, Orbit, two_impact_orbits};
use vinesink::regimes::Regime;
use vinesink::simulation::{Impact, Simulation};
use vinesink::system::{Band, BandOver, Cavity, Excitation, Parameters, State, System};

/// The transients of both motions here are over after some hundred periods.
const WINDOW: Window = Window { discard: 2000, periods: 200, impact_limit: u64::MAX };

fn found(place: Place) -> Motions {
    motions(&[place], &Effort::default(), &Serial).expect("inside the cavity").remove(0)
}

/// What starts lead to, by the walls that it meets.
fn reached(motions: &Motions) -> Vec<(String, u32)> {
    let moving = motions.iter().filter(|motion| motion.reached().starts > 0);
    let walls =
        |motion: &Motion| motion.orbit().map_or_else(String::new, |one| one.cycle.sequence());
    moving.map(|motion| (walls(motion), motion.reached().starts)).collect()
}

/// A state at phase 0 on the mirror image of a motion.
fn mirrored(system: &System, state: State) -> State {
    let State { x, x_velocity, y, y_velocity } = state;
    let image = State { x: -x, x_velocity: -x_velocity, y: -y, y_velocity: -y_velocity };
    // The excitation changes its sign after half a period.
    let mut half = Simulation::new(system, image, PI).expect("inside the cavity");
    half.run(1, u64::MAX, &mut ());
    half.state()
}

/// Two asymmetric impacts per period exist twice, each the mirror image of the other, with the weaker
/// impact on either wall. One orbit stands for both.
#[test]
fn a_motion_and_its_mirror_image_are_one() {
    let system = table_1(8.5, 6.0);
    let start = State { x: 0.0, x_velocity: 0.0, y: 0.0, y_velocity: 1.0 };
    let one = Measured::reach(&system, start, &WINDOW).expect("inside the cavity");
    assert_eq!(one.regime(), Regime::TwoAsymmetric);
    let image = mirrored(&system, one.state);
    let other = Measured::reach(&system, image, &WINDOW).expect("inside the cavity");
    let fastest = |motion: &Measured| {
        let speed = |impact: &Impact| impact.y_velocity_after.abs();
        let all = motion.impacts.iter();
        all.max_by(|a, b| speed(a).total_cmp(&speed(b))).expect("impacts").side
    };
    assert_ne!(fastest(&one), fastest(&other), "not the mirror image");
    let found = found(Place::with(&system, vec![one.state, image, other.state]));
    assert_eq!(reached(&found), [("+-".to_owned(), 3)]);
    // The same of a motion with more impacts, which is not solved for before.
    let system = table_1(8.3, 10.0);
    let one = Measured::reach(&system, start, &WINDOW).expect("inside the cavity");
    let found = self::found(Place::with(&system, vec![one.state, mirrored(&system, one.state)]));
    assert_eq!(reached(&found), [("++-++-+-".to_owned(), 2)]);
}

/// Between 5.069 mm, where the asymmetric orbit doubles its period at 8.5 Hz, and 5.107 mm, where the
/// one with three impacts ends in a Neimark-Sacker bifurcation, both attract; evenly spread starts miss
/// the second. Neither is taken for the other.
#[test]
fn asymmetric_and_three_impacts_coexist() {
    let start = State { x: 0.0, x_velocity: 0.0, y: 0.0, y_velocity: 1.0 };
    let there = |clearance: f64, start: State| {
        let system = table_1(8.5, clearance);
        Measured::reach(&system, start, &WINDOW).expect("inside the cavity").state
    };
    let asymmetric = there(5.09, start);
    // Lengths are over the clearance, which hardly changes.
    let three = [4.9, 5.0, 5.05, 5.09]
        .iter()
        .fold(there(4.8, start), |state, clearance| there(*clearance, state));
    let found = found(Place::with(&table_1(8.5, 5.09), vec![asymmetric, three]));
    let mut walls: Vec<String> = reached(&found).into_iter().map(|one| one.0).collect();
    walls.sort();
    assert_eq!(walls, ["++-", "+-"]);
}

/// A multiplier near -1 makes a motion come to its orbit from alternate sides: it repeats every two
/// periods long before it repeats every period, and looks like another motion. The orbit tells.
#[test]
fn a_motion_that_alternates_is_not_a_doubled_one() {
    let found = found(Place::new(&table_1(8.5, 5.08), 32));
    let moving: Vec<&Motion> = found.iter().filter(|one| one.rest().is_none()).collect();
    let [only] = moving.as_slice() else { panic!("{moving:?}") };
    let orbit = only.orbit().expect("proven");
    assert_eq!((only.repeats_after(), only.reached().starts), (Some(1), 32));
    let leading = orbit.multipliers.values[0];
    assert!(leading[0] < -0.95 && leading[1] == 0.0, "no alternation: {leading:?}");
}

/// An orbit that attracts is one of the list, also where no start leads to it: Table 1 at 8 Hz and 16.6 mm, just below the
/// clearance at which it ends.
#[test]
fn an_orbit_that_no_start_leads_to_is_listed() {
    let system = table_1(8.0, 16.6);
    let none = found(Place::with(&system, Vec::new()));
    let solved = none.iter().find(|one| one.is_one_to_one()).expect("it attracts");
    assert_eq!((solved.reached().starts, none.of_starts(), none.share(solved)), (0, 0, 0.0));
    let some = found(Place::new(&system, 8));
    let orbit = some.iter().find(|one| one.is_one_to_one()).expect("it attracts");
    assert_eq!(orbit.facts(), solved.facts());
    assert_eq!(some.led().len(), 8);
    assert!(some.iter().map(|one| one.reached().starts).sum::<u32>() <= 8);
}

/// Design 14 of seed 103 of the agreement test, driven at 125.6508 Hz. The slip reverses for a moment in the motion that
/// attracts, and within a thousandth of it there is an orbit without a reversal that does not: the motion is not that orbit,
/// and no start is pushed off it.
#[test]
fn a_motion_whose_slip_reverses_is_not_the_unstable_orbit_beside_it() {
    let friction_acceleration = 0.0982;
    let system = System::new(Parameters {
        mass_ratio: 0.010077,
        damping: 2.938,
        restitution: 0.3001,
        frequency_ratio: 125.6508 / 124.563355,
        forcing_per_clearance: 6.3144,
        excitation: Excitation::Force,
        cavity: Cavity { friction_acceleration, ..Cavity::IDEAL },
    })
    .expect("valid");
    let orbits = two_impact_orbits(&system).expect("damped").orbits;
    let symmetric = |orbit: &&Orbit| matches!(orbit.cycle.closure, Closure::Mirrors { .. });
    let beside = orbits.iter().find(symmetric).expect("an orbit");
    assert!(beside.admissibility.admissible && beside.multipliers.spectral_radius() > 1.2);
    let found = found(Place::new(&system, 8));
    let all: Vec<&Motion> = found.iter().collect();
    let [motion] = all[..] else { panic!("{found:?}") };
    assert!(motion.settled() && motion.orbit().is_none(), "{motion:?}");
    assert_eq!((motion.repeats_after(), motion.reached().starts), (Some(1), 8));
    let multiplier = motion.largest_multiplier().expect("known");
    assert!((0.85..0.95).contains(&multiplier), "{multiplier}");
    // As it goes by itself: after 3000 periods its states repeat to rounding.
    let mut simulation = Simulation::new(&system, State::AT_REST, 0.0).expect("inside the cavity");
    simulation.run(3000, u64::MAX, &mut ());
    let state = simulation.state();
    simulation.run(1, u64::MAX, &mut ());
    assert!(simulation.state().distance(&state) < 1e-12);
}

/// A place of a band that is looked at again over sixteen windows has the same irregular motion, whose rms is known to a quarter,
/// as errors of independent windows shrink with their root; all other places stay.
#[test]
fn a_place_that_is_looked_at_again_is_known_better() {
    let base = table_1(8.5, 28.0);
    let omega = base.frequency_ratio();
    let range = [0.995 * omega, 1.005 * omega];
    let band = Band { over: BandOver::Frequency, range, spectrum: Vec::new(), base };
    let few = BandEffort { even: 3, starts: 3, starts_between: 2, most: 8, tolerance: 0.1 };
    let short = Effort { starts: 4, patience: 0.0, band: few, ..Effort::over(300) };
    let mut found = along(&band, &[], None, Some(&short), &Serial).expect("finite");
    let before = found.clone();
    let rms = |of: &Motions| of.main().expect("one").facts().rms;
    let own = rms(before.at(omega).expect("a place"));
    assert!(own.error > 0.0, "it repeats");
    let long = Effort { patience: 0.0, ..Effort { periods: 4800, ..short } };
    found.look_again(&[omega], &long, &Serial).expect("finite");
    for ((at, then), (_, now)) in before.places().iter().zip(found.places()) {
        if *at == omega {
            let (then, now) = (rms(then), rms(now));
            assert!((now.value - then.value).abs() <= then.error + now.error, "{then:?} {now:?}");
            // Sixteen times the window, a quarter of the error; a scatter of a few parts of a window is itself known to a
            // factor of two.
            assert!(now.error < 0.5 * then.error, "{then:?} {now:?}");
        } else {
            assert_eq!(then, now, "at {at}");
        }
    }
}

/// The second mode of a mast with a tenth of its mass in a ball: below resonance motions that never repeat, beside 1:1 motions
/// that attract.
fn mast(frequency_ratio: f64) -> System {
    System::new(Parameters {
        mass_ratio: 0.1,
        damping: 0.1,
        restitution: 0.3,
        frequency_ratio,
        forcing_per_clearance: 0.926,
        excitation: Excitation::Force,
        cavity: Cavity::IDEAL,
    })
    .expect("valid")
}

/// A motion that never repeats counts as one earlier with a quarter of the patience, and that is what is left at the places of
/// a band between two that had all of it.
#[test]
fn what_was_told_from_a_transient_beside_a_place_is_waited_for_less() {
    let wanders = |motions: &Motions| {
        let wanders = |one: &&Motion| one.repeats_after().is_none() && one.rest().is_none();
        let all: Vec<u64> =
            motions.iter().filter(wanders).map(|one| one.reached().followed).collect();
        assert!(motions.iter().all(Motion::settled), "still settling");
        all.into_iter().max()
    };
    let (mut long, mut short) = (Vec::new(), Vec::new());
    for k in 0..16 {
        let place = Place::new(&mast(0.85 + 0.007 * f64::from(k)), 8);
        let hasty = Place { patience: 0.25, ..place.clone() };
        let [all, part] = [place, hasty].map(|place| wanders(&found(place)));
        long.extend(all);
        short.extend(part);
    }
    let mean = |all: &[u64]| all.iter().sum::<u64>() / all.len().max(1) as u64;
    assert!(long.len() >= 8 && short.len() >= long.len(), "{long:?} {short:?}");
    // What fades first, and a window, come to both.
    assert!(2 * mean(&long) > 3 * mean(&short), "{long:?} {short:?}");
    // Along a band the first of four places waits, and those between two of them less.
    let range = [0.85, 0.908];
    let band = Band { over: BandOver::Frequency, range, spectrum: Vec::new(), base: mast(0.88) };
    let effort = Effort { band: BandEffort { most: 0, ..BandEffort::FULL }, ..Effort::default() };
    let along = along(&band, &[], None, Some(&effort), &Serial).expect("finite");
    let waited: Vec<u64> =
        along.places().iter().filter_map(|(_, motions)| wanders(motions)).collect();
    let less = waited.iter().filter(|one| 3 * **one < 2 * waited[0]).count();
    assert!(waited.len() >= 20 && less * 2 > waited.len(), "{waited:?}");
}
