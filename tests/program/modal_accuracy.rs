//! `[accuracy]` beside several modes: averages, and the worst along a range, are known as well as it asks.

use vinesink::case::ModalCase;
use vinesink::executor::Serial;
use vinesink::modal::ModalAnswer;
use vinesink::motions::ModalMotion;
use vinesink::simulation::Reading;

/// Two modes with a ball at the tip, under a force in the second.
fn case(frequency: &str, further: &str) -> ModalCase {
    let text = format!(
        "title = 't'\nsource = 's'\n[[mode]]\nfrequency = '1.1 Hz'\ndamping_ratio = '0.5 %'\nmass = '30 kg'\nshape = {{ tip = 1.0 }}\n\
         [[mode]]\nfrequency = '6.894 Hz'\ndamping_ratio = '0.5 %'\nmass = '30 kg'\nshape = {{ tip = 1.0 }}\n\
         [[absorber]]\nmass = '3 kg'\nclearance = '2.7 mm'\nrestitution = 0.3\n\
         [excitation]\nkind = 'force'\nmode = 2\namplitude = '14.07 N'\n{frequency}\n\
         [simulation]\nstarts = 4\n[criteria]\npeak_displacement = '<= 9 mm'\n{further}"
    );
    ModalCase::parse("case", &text).expect("a case")
}

/// Root mean square and impacts per period of what wanders, each with its error.
fn wandering(case: &ModalCase) -> Vec<[[f64; 2]; 2]> {
    let found = ModalAnswer::of(case, &Serial).expect("it flies");
    let all = found.along[0].places[0].motions.iter().filter(|one| one.repeats_after.is_none());
    let told = |one: &ModalMotion| {
        let rms = one.read(Reading::Displacement).next().expect("a place").rms;
        [rms, one.impacts_per_period[0]]
    };
    all.map(told).collect()
}

/// A chaotic motion is measured for longer: what was found before lies within both errors.
#[test]
fn averages_are_known_as_well_as_is_asked() {
    let of = |further: &str| wandering(&case("frequency = '6 Hz'", further));
    let usual = of("");
    let asked = of("[accuracy]\namplitude = '4 %'\nimpacts_per_period = 0.06\n");
    assert_eq!([usual.len(), asked.len()], [1, 1], "{usual:?} {asked:?}");
    let ([rms, impacts], [closer, counted]) = (usual[0], asked[0]);
    assert!(rms[1] > 0.04 * rms[0] && impacts[1] > 0.06, "{usual:?}");
    assert!(closer[1] <= 0.04 * closer[0] && counted[1] <= 0.06, "{asked:?}");
    // Two standard errors are of 19 runs in 20: half as much again leaves one in 300.
    for (own, other) in [(rms, closer), (impacts, counted)] {
        assert!((own[0] - other[0]).abs() <= 1.5 * (own[1] + other[1]), "{usual:?} {asked:?}");
    }
}

/// Along a range the worst of a gymnasium's floor under its first load is known better, with more places.
#[test]
fn the_worst_along_a_range_is_known_as_well_as_is_asked() {
    let floor = std::fs::read_to_string("cases/several/floor.toml").expect("a case");
    let (head, tail) = floor.split_once("# The third.").expect("two loads");
    let (_, asked) = tail.split_once("[criteria]").expect("criteria");
    let of = |further: &str| {
        let text = format!("{head}[criteria]{asked}{further}");
        let found = ModalAnswer::of(&ModalCase::parse("case", &text).expect("a case"), &Serial);
        let found = found.expect("it flies");
        let judged = &found.judged[0];
        (judged.found.expect("found"), judged.error, found.along[0].places.len())
    };
    let (usual, asked) = (of(""), of("[accuracy]\namplitude = '1 %'\n"));
    assert!(asked.2 > usual.2, "{usual:?} {asked:?}");
    assert!(usual.1 > 0.02 * usual.0 && asked.1 <= 0.01 * asked.0, "{usual:?} {asked:?}");
    assert!((asked.0 - usual.0).abs() <= usual.1 + asked.1, "{usual:?} {asked:?}");
}

/// A key that nothing reads is refused.
#[test]
fn other_motions_are_always_looked_for() {
    let text = std::fs::read_to_string("cases/several/floor.toml").expect("a case");
    let told = |table: &str| ModalCase::parse("case", &format!("{text}\n[accuracy]\n{table}\n"));
    assert!(told("amplitude = '2 %'\nimpacts_per_period = 0.1").is_ok());
    for value in ["true", "false"] {
        let error = told(&format!("coexistence = {value}")).expect_err("a key that nothing reads");
        let message = "`coexistence` has no meaning with several modes";
        assert_eq!(error.problems().next().expect("one").message, message);
    }
}
