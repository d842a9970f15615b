//! Theory of the mode that a load drives, of structures of several modes and absorbers, against their exact orbits.

use vinesink::analysis::AbsorberGroup;
use vinesink::case::ModalCase;
use vinesink::modal::{ExactAmplitude, at_resonances};

use super::common::random::Random;

/// A structure of two to four modes under a force in the first at its frequency, with one or two absorbers at a place.
pub fn case(drawn: &mut Random) -> ModalCase {
    let count = 2 + (drawn.within(0.0, 3.0) as usize);
    let mut text = "title = 't'\nsource = 's'\n".to_owned();
    let (mut frequency, ratio) = (2.0, drawn.ratio(0.003, 0.06));
    for k in 0..count {
        let damping = drawn.ratio(0.003, 0.3);
        let damping = if k == 0 { drawn.ratio(0.003, 0.01) } else { damping };
        let shape = if k == 0 { 1.0 } else { drawn.within(-1.5, 1.5) };
        text += &format!(
            "[[mode]]\nfrequency = '{frequency} Hz'\ndamping_ratio = {damping}\nmass = '100 kg'\nshape = {{ a = {shape}, b = 0.5 }}\n"
        );
        frequency *= drawn.ratio(1.7, 4.0);
    }
    for _ in 0..1 + (drawn.within(0.0, 2.0) as usize) {
        let (clearance, restitution) = (drawn.ratio(3.0, 6.0), drawn.within(0.2, 0.8));
        text += &format!(
            "[[absorber]]\nplace = 'a'\nmass = '{} kg'\nclearance = '{clearance} mm'\nrestitution = {restitution}\n",
            100.0 * ratio
        );
    }
    // As large that the absorbers hold the mode at a few times the lower end of 1:1 resonance.
    let amplitude = drawn.ratio(2.0, 9.0) * ratio * 100.0;
    text += &format!(
        "[[excitation]]\nkind = 'force'\nmode = 1\namplitude = '{amplitude} N'\nfrequency = '2 Hz'\n"
    );
    ModalCase::parse("case.toml", &text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Each fixed point that an exact orbit belongs to has its amplitude within what leading order neglects. Where other modes change the
/// restitution by something, with that of a drop test amplitudes would be farther off.
#[test]
fn amplitudes_are_those_of_exact_orbits_within_their_error() {
    let (mut drawn, mut attracting, mut absorbers) = (Random(3), 0, 0);
    let mut all: Vec<(f64, [f64; 2])> = Vec::new();
    for number in 0..1000 {
        let case = case(&mut drawn);
        let found = at_resonances(&case).expect("a steady motion");
        let Some(theory) = &found[0].theory else { continue };
        let Some(group) = theory.group.as_ref().filter(|one| !one.points.is_empty()) else {
            continue;
        };
        let Some(system) = case.system(&case.loads[0], 2.0).ok() else { continue };
        let alone = AbsorberGroup::of(&system, 0).expect("no node").fixed_points();
        let off = |exact: f64, amplitudes: &mut dyn Iterator<Item = f64>| {
            amplitudes.map(|one| (one / exact - 1.0).abs()).fold(f64::INFINITY, f64::min)
        };
        // Of several orbits one belongs to a fixed point, which has no other.
        let points = || group.points.iter().map(|one| one.0);
        let by_distance = |a: &&ExactAmplitude, b: &&ExactAmplitude| {
            off(a.amplitude, &mut points()).total_cmp(&off(b.amplitude, &mut points()))
        };
        let Some(orbit) = theory.exact.iter().min_by(by_distance) else { continue };
        let (exact, attracts) = (orbit.amplitude, orbit.attracts);
        let nearest = off(exact, &mut points());
        assert!(nearest <= group.error, "{number}: {nearest} {}", group.error);
        // Each absorber's lines between its walls are those of its manifold.
        for one in &group.manifolds {
            let Some(there) = one.absorber_at(exact) else { continue };
            let off = (there / orbit.absorbers[one.absorber] - 1.0).abs();
            // What leading order neglects; a third of it is seen.
            assert!(off <= group.error, "{number}: {off} {}", group.error);
            absorbers += 1;
        }
        let drop_test = off(exact, &mut alone.iter().map(|one| one.amplitude));
        let given = case.absorbers.iter().zip(&theory.restitutions);
        let changed = given.map(|(one, seen)| (one.restitution - seen).abs()).fold(0.0, f64::max);
        all.push((changed, [nearest, drop_test]));
        attracting += u32::from(attracts);
    }
    assert!(all.len() > 80 && attracting > 15, "{} {attracting}", all.len());
    assert!(absorbers > 200, "{absorbers}");
    // Where other modes change the restitution by something.
    let changed: Vec<[f64; 2]> =
        all.iter().filter(|one| one.0 > 0.02 && one.1[1] < 1.0).map(|one| one.1).collect();
    let [own, drop_test] =
        [0, 1].map(|k| changed.iter().map(|one| one[k] * one[k]).sum::<f64>().sqrt());
    assert!(changed.len() > 15 && own < 0.8 * drop_test, "{} {own} {drop_test}", changed.len());
}
