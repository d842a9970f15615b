//! A contact time is an error of every number of a motion: what is found with the clearance and restitution that act like it.
//!
//! The truth: two programs with a wall of springs and dampers, a matrix exponential with Newton's method and a Runge-Kutta method with
//! located events; and one of them for the structure of 3 Hz.

use std::fs;

use assert_cmd::Command;
use serde_json::Value;

/// The design of Li, Seguy and Berlioz 2016, Table 1, at 8.5 Hz, where only the 1:1 motion counts.
const TABLE_1: &str = "title = 't'\nsource = 's'\n[oscillator]\nmass = '4.168 kg'\nstiffness = '11.47 kN/m'\n\
                       damping = '3.02 N s/m'\n[absorber]\nmass = '32 g'\nclearance = '16 mm'\nrestitution = 0.6\nTIME\n\
                       [excitation]\nkind = 'base-displacement'\namplitude = '0.25 mm'\nfrequency = '8.5 Hz'\n\
                       [criteria]\nrms_displacement = '<= LIMIT mm'\npeak_displacement = '<= 4 mm'\ncount_inactive = false\n";

const THREE_HERTZ: &str = "title = 't'\nsource = 's'\nSTRUCTURE\n[EXCITATION]\nkind = 'force'\nON\namplitude = '20 N'\n\
                           frequency = '3 Hz'\n[criteria]\npeak_displacement = '<= LIMIT mm'\n";

fn check(text: &str) -> Value {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("case.toml");
    fs::write(&path, text).expect("written");
    let mut command = Command::cargo_bin("vinesink").expect("built");
    let arguments = ["check", path.to_str().expect("UTF-8"), "--criteria-only", "--format", "json"];
    let output = command.args(arguments).output().expect("it runs");
    let document: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    document["cases"][0]["criteria"].clone()
}

fn number(of: &Value) -> f64 {
    of.as_f64().unwrap_or_else(|| panic!("{of}"))
}

/// Contact times of 0.005, 0.01 and 0.02 of a period: the difference is that of hard walls to springs, whose error is of second order.
#[test]
fn the_difference_is_what_a_wall_of_springs_makes() {
    const HARD: [f64; 2] = [2.581_330, 3.662_595];
    for (share, rms, peak) in
        [(0.005, 2.571_470, 3.648_740), (0.01, 2.562_015, 3.635_444), (0.02, 2.544_484, 3.610_751)]
    {
        let time = format!("contact_time = '{} s'", share / 8.5);
        let found = check(&TABLE_1.replace("TIME", &time).replace("LIMIT", "2.6"));
        let of = |name: &str| {
            let all = found.as_array().expect("rows");
            all.iter().find(|one| one["name"] == name).expect("a row")
        };
        let rows = [("rms_displacement", HARD[0], rms), ("peak_displacement", HARD[1], peak)];
        for (of, hard, truth) in rows.map(|(name, hard, truth)| (of(name), hard, truth)) {
            let told = 1000.0 * number(&of["contact"]["found"]);
            assert!((1000.0 * number(&of["found"]) - hard).abs() < 1e-6, "{of}");
            // 3 % of the shift, as much as the formula leaves at the longest.
            assert!((told - truth).abs() < 0.03 * (hard - truth), "{share} {told} {truth}");
            assert_eq!(of["holds"], true);
        }
    }
    let none = check(&TABLE_1.replace("TIME", "").replace("LIMIT", "2.6"));
    assert!(none[0].get("contact").is_none());
}

/// What a contact time may turn is not decided, or too close to call: the peak is 19.7 mm with hard walls and 22.6 mm with a contact
/// of 5 ms, of one mode as of several; a sensor's time changes nothing.
#[test]
fn what_a_contact_time_may_turn_does_not_hold() {
    let one =
        "[oscillator]\nmass = '50 kg'\nfrequency = '3 Hz'\ndamping_ratio = '1 %'\n[absorber]\n";
    let several = "[[mode]]\nmass = '50 kg'\nfrequency = '3 Hz'\ndamping_ratio = '1 %'\nshape = { top = 1 }\n[[absorber]]\n";
    let absorber = "mass = '1.5 kg'\nclearance = '20 mm'\nrestitution = 0.5\nTIME\n";
    for (structure, on, list) in
        [(one, "", "[excitation]"), (several, "mode = 1", "[[excitation]]")]
    {
        let text = THREE_HERTZ.replace("STRUCTURE", &format!("{structure}{absorber}"));
        let text = text.replace("[EXCITATION]", list).replace("ON\n", &format!("{on}\n"));
        let found = |time: &str, limit: &str| {
            check(&text.replace("TIME", time).replace("LIMIT", limit))[0].clone()
        };
        let five = found("contact_time = '5 ms'", "21");
        assert_eq!(
            (&five["holds"], &found("", "21")["holds"]),
            (&false.into(), &true.into()),
            "{five}"
        );
        // To first order in a shift of a tenth of the clearance.
        let told = 1000.0 * number(&five["contact"]["found"]);
        assert!((told - 22.6).abs() < 0.4, "{told}");
        assert!(number(&five["found"]) + number(&five["error"]) > 0.0224, "{five}");
        assert_eq!(found("contact_time = '5 ms'", "27")["holds"], true);
        assert_eq!(found("contact_time = '5 ms'", "19")["holds"], false);
        // A tenth of the time, a tenth of the shift.
        let short = found("contact_time = '0.5 ms'", "21");
        assert!(short["holds"] == true && number(&short["error"]) < 0.0005, "{short}");
        let sensor = text.replace("TIME", "").replace(
            "peak_displacement = '<= LIMIT mm'",
            "peak_displacement = '<= 21 mm'\nacceleration = '<= 100 g'\nacceleration_upto = '200 Hz'",
        );
        let sensor = check(&sensor);
        assert!(
            sensor.as_array().expect("rows").iter().all(|one| one.get("contact").is_none()),
            "{sensor}"
        );
    }
}

/// So it is for a structure that is released: the difference is in the error of its time.
#[test]
fn a_release_has_it_too() {
    let text = "title = 't'\nsource = 's'\n[oscillator]\nmass = '50 kg'\nfrequency = '3 Hz'\ndamping_ratio = '1 %'\n\
                [absorber]\nmass = '1.5 kg'\nclearance = '20 mm'\nrestitution = 0.5\ncontact_time = '5 ms'\n\
                [excitation]\nkind = 'free'\ndisplacement = '60 mm'\n[criteria]\ndecay_time = '<= 7 s'\n";
    let found = check(text)[0].clone();
    let [own, there] = [number(&found["found"]), number(&found["contact"]["found"])];
    assert!(own != there && number(&found["error"]) >= there - own, "{found}");
}

/// An absorber at rest meets its walls where they are: what is worst in it has no such error, and a motion that is worst only with the
/// contact time counts.
#[test]
fn an_absorber_at_rest_knows_no_contact_time() {
    let board = "title = 't'\nsource = 's'\n[oscillator]\nmass = '180 g'\nfrequency = '200 Hz'\ndamping_ratio = '0.9 %'\n\
                 [absorber]\nmass = '5 g'\nclearance = '0.04566 mm'\nrestitution = 0.45\ncontact_time = '0.06 ms'\n\
                 [excitation]\nkind = 'base-displacement'\namplitude = '1.5 um'\nfrequency = '200 Hz'\n\
                 [band]\nfrom = '190 Hz'\nto = '208 Hz'\n[criteria]\npeak_displacement = '<= 0.0365 mm'\n";
    let [timed, none] = [board.to_owned(), board.replace("contact_time = '0.06 ms'\n", "")]
        .map(|text| check(&text)[0].clone());
    assert!(timed["inactive_share"].is_number() && timed.get("contact").is_none(), "{timed}");
    assert_eq!(
        (&timed["holds"], &timed["found"], &timed["error"]),
        (&none["holds"], &none["found"], &none["error"])
    );
}
