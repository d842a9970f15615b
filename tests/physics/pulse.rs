//! The pulse of an impact, where a case says how long it takes.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use vinesink::answer::{Answer, Asked};
use vinesink::case::Case;
use vinesink::criteria::Judged;
use vinesink::executor::Serial;

/// Both criteria of a case: acceleration, then impact speed.
fn judged(text: &str) -> [Judged; 2] {
    let case = Case::parse("pulse", text).expect("valid");
    let answer = Answer::of(&case, Asked::Criteria, None, &Serial).expect("answered");
    answer.judged.try_into().expect("two criteria")
}

/// Steady motion: the integral of a half-sine of the contact's length is the change of the velocity, by hand; the walls
/// differ, and the livelier one is meant. Without a contact time the number is that of the flights, and the error of the
/// pulse.
#[test]
fn the_pulse_of_a_steady_motion_has_the_integral_of_the_jump() {
    let text = |contact: &str| {
        format!(
            "title = 't'\nsource = 's'\n[oscillator]\nmass = '4 kg'\nfrequency = '23 Hz'\ndamping_ratio = '0.9 %'\n\
             [absorber]\nmass = '0.1 kg'\nclearance = '0.8 mm'\nrestitution = [0.65, 0.55]\n{contact}\
             [excitation]\nkind = 'force'\namplitude = '5 N'\nfrequency = '22.9 Hz'\n\
             [criteria]\nacceleration = '<= 1e6 m/s2'\nimpact_velocity = '<= 1e6 m/s'\n"
        )
    };
    let [flights, speed] = judged(&text(""));
    let [pulse, same] = judged(&text("contact_time = '0.05 ms'\n"));
    assert_eq!(speed.found, same.found);
    let errors = [flights.error, speed.error];
    let (flights, speed) = (flights.found.expect("a number"), speed.found.expect("a number"));
    let mu = 0.1 / 4.0;
    let rate = FRAC_PI_2 * mu / (1.0 + mu) * (1.0 + 0.65) / 0.05e-3;
    let by_hand = rate * speed;
    let (least, error) = (pulse.found.expect("a number"), pulse.error);
    assert!(by_hand > 3.0 * flights, "{by_hand} {flights}");
    // The pulse rides on an acceleration of the flights of either sign.
    let rides = flights + errors[0];
    assert!((least / (by_hand - rides) - 1.0).abs() < 1e-9, "{least} {by_hand}");
    let most = by_hand + rate * errors[1] + rides;
    assert!(((least + error) / most - 1.0).abs() < 1e-9, "{error} {most}");
}

/// Displacement and velocity of structure and absorber, with walls that are springs without loss: every contact is a
/// half-sine, and nothing of the program is used. Gives the largest acceleration of the structure.
fn with_elastic_walls(place: f64, contact_time: f64, duration: f64) -> f64 {
    let (mass, omega, zeta, small, clearance) = (10.0, TAU * 5.0, 0.02, 0.5, 2e-3);
    let reduced = mass * small / (mass + small);
    let wall = reduced * (PI / contact_time) * (PI / contact_time);
    let rates = |[x, v, y, u]: [f64; 4]| {
        let beyond = (x - y).abs() - clearance;
        let force = if beyond > 0.0 { wall * beyond * (x - y).signum() } else { 0.0 };
        [v, -omega * omega * x - 2.0 * zeta * omega * v - force / mass, u, force / small]
    };
    let h = contact_time / 60.0;
    let (mut at, mut largest) = ([0.0, 0.5, place * clearance, 0.0], 0.0_f64);
    for _ in 0..(duration / h) as u64 {
        let plus = |one: [f64; 4], part: f64| std::array::from_fn(|k| at[k] + part * h * one[k]);
        let a = rates(at);
        let b = rates(plus(a, 0.5));
        let c = rates(plus(b, 0.5));
        let d = rates(plus(c, 1.0));
        at = std::array::from_fn(|k| at[k] + h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]));
        largest = largest.max(rates(at)[1].abs());
    }
    largest
}

/// A release with walls that lose nothing, against a simulation with walls that are springs: the largest acceleration of
/// the structure over the same places of the absorber is within the error that is told.
#[test]
fn the_pulse_of_a_release_is_that_of_an_elastic_wall() {
    let contact = 0.5e-3;
    let [pulse, _] = judged(
        "title = 't'\nsource = 's'\n[oscillator]\nmass = '10 kg'\nfrequency = '5 Hz'\ndamping_ratio = '2 %'\n\
         [absorber]\nmass = '0.5 kg'\nclearance = '2 mm'\nrestitution = 1\ncontact_time = '0.5 ms'\n\
         [excitation]\nkind = 'free'\nvelocity = '0.5 m/s'\n\
         [criteria]\nacceleration = '<= 1e6 m/s2'\nimpact_velocity = '<= 1e6 m/s'\n",
    );
    let (told, error) = (pulse.found.expect("a number"), pulse.error);
    let places = (0..24).map(|k| (f64::from(k) + 0.5) / 12.0 - 1.0);
    let seen = places.map(|place| with_elastic_walls(place, contact, 1.5)).fold(0.0, f64::max);
    assert!(told > 2.0 * error, "{told} (+{error})");
    assert!(told <= seen && seen <= told + error, "{seen} seen, {told} (+{error}) told");
}

/// A contact that is a part of the oscillation is refused, with what would do.
#[test]
fn a_contact_as_long_as_the_oscillation_is_refused() {
    let text = std::fs::read_to_string("cases/mast-mode-2.toml").expect("a case");
    let text = text.replacen("restitution = 0.3", "restitution = 0.3\ncontact_time = \"5 ms\"", 1);
    let error = Case::parse("pulse", &text).expect_err("refused").to_string();
    assert!(error.contains("a fiftieth of the structure's natural period"), "{error}");
    let text = text.replacen("5 ms", "2.9 ms", 1);
    assert!(Case::parse("pulse", &text).is_ok());
}

/// A sensor that reads up to a frequency shows a jump of the velocity with a peak of `2 f_c` times the jump.
#[test]
fn a_sensor_shows_an_impact_as_its_filter_does() {
    let text = |upto: &str| {
        format!(
            "title = 't'\nsource = 's'\n[oscillator]\nmass = '10 kg'\nfrequency = '5 Hz'\ndamping_ratio = '2 %'\n\
             [absorber]\nmass = '0.5 kg'\nclearance = '2 mm'\nrestitution = 0.6\n\
             [excitation]\nkind = 'free'\nvelocity = '0.5 m/s'\n\
             [criteria]\nacceleration = '<= 1e6 m/s2'\n{upto}impact_velocity = '<= 1e6 m/s'\n"
        )
    };
    let [pulse, speed] = judged(&text("acceleration_upto = '500 Hz'\n"));
    let jump = 0.5 / 10.5 * 1.6 * speed.found.expect("a speed");
    let expected = 2.0 * 500.0 * jump;
    // The pulse rides on the acceleration of the flights, of either sign; the speed is known better than that.
    let found = pulse.found.expect("a number") + 0.5 * pulse.error;
    assert!((found / expected - 1.0).abs() < 1e-3 && speed.error < 1e-3, "{found} {expected}");
    let refused = |text: String, why: &str| {
        let error = Case::parse("pulse", &text).expect_err("refused");
        let told = format!("{:?}", error.problems().next().expect("one"));
        assert!(told.contains(why), "{told}");
    };
    refused(
        text("acceleration_upto = '100 Hz'\n"),
        "reads impacts reads up to 196 Hz or more here",
    );
    refused(text("acceleration_upto = '0 Hz'\n"), "above 0");
    let whole = text("acceleration_upto = '1 kHz'\n");
    refused(
        whole.replacen("0.6", "0.6\ncontact_time = '1 ms'", 1),
        "both say how an impact is read",
    );
    refused(whole.replacen("acceleration = '<= 1e6 m/s2'", "", 1), "nothing asks for");
}
