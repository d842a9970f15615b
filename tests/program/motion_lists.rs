//! The list of motions is the same for every structure: that of a structure of one mode beside that of the same one with a second mode that
//! takes no part, which another engine flies and another search finds.

use std::fs;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::tempdir;

/// A structure at 10 Hz with an absorber that is this heavy over it, with this restitution and clearance in mm, at 1 mm of motion
/// without it; `further` are other modes.
fn case(design: [f64; 4], shape: &str, further: &str) -> String {
    let [heavy, restitution, clearance, over] = design;
    let omega = std::f64::consts::TAU * 10.0;
    // The force that makes the structure move by 1 mm.
    let stiffness = 10.0 * omega * omega;
    let force = 1e-3 * stiffness * libm::hypot(1.0 - over * over, 0.02 * over);
    format!(
        "title = \"t\"\nsource = \"s\"\n[[mode]]\nfrequency = \"10 Hz\"\ndamping_ratio = 0.01\nmass = \"10 kg\"\nshape = {shape}\n{further}\
         [[absorber]]\nplace = \"tip\"\nmass = \"{} kg\"\nclearance = \"{clearance} mm\"\nrestitution = {restitution}\n\
         [excitation]\nkind = \"force\"\nplace = \"tip\"\namplitude = \"{force} N\"\nfrequency = \"{} Hz\"\n",
        10.0 * heavy,
        10.0 * over
    )
}

const IDLE: &str = "[[mode]]\nfrequency = \"33.7 Hz\"\ndamping_ratio = 0.02\nmass = \"10 kg\"\nshape = { tip = 0, other = 1 }\n";

fn motions(text: &str) -> Vec<Value> {
    told(text, &["simulate"])["motions"].as_array().expect("a list").clone()
}

/// What a command says of a case, as JSON.
fn told(text: &str, arguments: &[&str]) -> Value {
    let folder = tempdir().expect("a folder");
    let path = folder.path().join("case.toml");
    fs::write(&path, text).expect("written");
    let mut command = Command::cargo_bin("vinesink").expect("built");
    let path = path.to_str().expect("UTF-8");
    let all = [&[arguments[0], path, "--format", "json"], &arguments[1..]].concat();
    let output = command.args(&all).output().expect("it runs");
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{all:?}: {error}"))
}

/// What is said of an excitation stands at the top of a document, and of a list of them under each, numbered from 1.
#[test]
fn a_list_of_loads_has_lists_of_motions() {
    let limits = "[criteria]\npeak_displacement = \"<= 9 mm\"\n";
    let one = case([0.02, 0.6, 3.0, 1.0], "{ tip = 1, other = 0.2 }", IDLE) + limits;
    let load = "[[excitation]]\nkind = \"force\"\nplace = \"other\"\namplitude = \"9 N\"\nfrequency = \"33 Hz\"\n";
    let two = one
        .replace("[excitation]", "[[excitation]]")
        .replace("[criteria]", &format!("{load}[criteria]"));
    let checked = |text: &str| told(text, &["check", "--criteria-only"])["cases"][0].clone();
    let rows = |of: &Value| of.as_array().map_or(0, Vec::len);
    for told_of in [told(&one, &["simulate"]), checked(&one)] {
        assert!(rows(&told_of["motions"]) > 0 && told_of["places"].is_null(), "{told_of}");
        assert!(told_of["loads"][0].get("motions").is_none(), "{told_of}");
    }
    for told_of in [told(&two, &["simulate"]), checked(&two)] {
        assert!(told_of.get("motions").is_none(), "{told_of}");
        for (k, load) in told_of["loads"].as_array().expect("a list").iter().enumerate() {
            assert!(load["load"] == k + 1 && rows(&load["motions"]) > 0, "{load}");
            assert_eq!(load["motions"], load["at_worst"], "{load}");
        }
    }
    // The motion that decides is one of the list of its load.
    let of_two = checked(&two);
    let decides = &of_two["criteria"][0];
    let load = &of_two["loads"][decides["load"].as_u64().expect("a number") as usize - 1];
    let motions = load["motions"].as_array().expect("a list");
    let motion = motions.iter().find(|one| one["id"] == decides["motion"]).expect("it is listed");
    assert_eq!(motion["peak"]["value"], decides["found"], "{motion} {decides}");
    // Over a range the list is that of the range.
    let range = one.replace(
        "frequency = \"10 Hz\"\n[criteria]",
        "from = \"9.9 Hz\"\nto = \"10.1 Hz\"\n[criteria]",
    );
    let over = checked(&range);
    assert!(over["motions"].is_null() && rows(&over["places"]) > 2, "{over}");
    let orbits = told(&one, &["analyze"]);
    assert!(orbits["orbits"].is_array() && orbits["loads"][0].get("orbits").is_none(), "{orbits}");
}

#[test]
fn one_list_of_motions() {
    let mut seen = std::collections::BTreeMap::new();
    // Symmetric 1:1, chatter on a wall, strong modulation, rest beside a motion, few impacts.
    let designs = [
        [0.02, 0.6, 3.0, 1.0],
        [0.02, 0.1, 1.0, 1.0],
        [0.05, 0.6, 0.6, 1.0],
        [0.05, 0.8, 0.3, 1.02],
        [0.01, 0.6, 1.3, 0.98],
    ];
    for design in designs {
        let one = motions(&case(design, "{ tip = 1 }", ""));
        let two = motions(&case(design, "{ tip = 1, other = 0 }", IDLE));
        for of_two in &two {
            let keys =
                |of: &Value| of.as_object().expect("a row").keys().cloned().collect::<Vec<_>>();
            let mut further = keys(of_two);
            further.retain(|key| one[0].get(key).is_none());
            assert_eq!(further, ["absorbers", "places", "resting"]);
            assert!(keys(&one[0]).iter().all(|key| of_two.get(key).is_some()), "{of_two}");
            let near = |a: &Value, b: &Value, relative: f64| {
                let [(x, of_x), (y, of_y)] = [a, b].map(|one| {
                    let number = |key: &str| one[key].as_f64().unwrap_or(f64::NAN);
                    (number("value"), number("error"))
                });
                (a.is_null() && b.is_null())
                    || (x - y).abs() <= relative * x.abs().max(y.abs()) + 2.0 * (of_x + of_y)
            };
            let same = |of_one: &&Value| {
                of_one["kind"] == of_two["kind"]
                    && of_one["repeats_after"] == of_two["repeats_after"]
                    && near(&of_one["rms"], &of_two["rms"], 1e-6)
            };
            let Some(of_one) = one.iter().find(same) else {
                *seen.entry("alone".to_owned()).or_insert(0) += 1;
                continue;
            };
            for key in ["regime", "settled", "counts", "why_not", "rest"] {
                assert_eq!(of_one[key], of_two[key], "{design:?} {key}: {of_one} {of_two}");
            }
            for key in ["peak", "rms", "impacts_per_period", "impact_speed", "efficiency"] {
                // Energies of what rests on a wall are by a search that stops chattering a little earlier.
                assert!(
                    near(&of_one[key], &of_two[key], 1e-5),
                    "{design:?} {key}: {of_one} {of_two}"
                );
            }
            let rests = of_one["kind"] == "rest";
            if rests {
                let [slowly, at_once] = ["share", "share_sudden"]
                    .map(|key| [of_one, of_two].map(|one| one[key].as_f64().expect("a share")));
                assert!((slowly[0] - slowly[1]).abs() < 1e-9, "{of_one} {of_two}");
                // With one mode at the worst phase, by the envelope.
                assert!((at_once[0] - at_once[1]).abs() < 0.01, "{of_one} {of_two}");
            }
            assert_eq!(of_two["absorbers"][0]["at_rest"], rests, "{of_two}");
            assert_eq!(of_two["absorbers"][0]["regime"], of_two["regime"], "{of_two}");
            let places = of_two["places"].as_array().expect("a list");
            let tip = places.iter().find(|one| one["place"] == "tip").expect("it moves");
            assert_eq!(tip["peak"]["value"], of_two["peak"]["value"], "{of_two}");
            *seen.entry(of_two["regime"].as_str().expect("a word").to_owned()).or_insert(0) += 1;
        }
    }
    println!("{seen:?}");
    assert!(seen.len() > 2 && seen.get("alone").is_none_or(|count| *count < 2), "{seen:?}");
}
