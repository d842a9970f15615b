//! The schema that editors use and the parser agree about what a case may hold.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use regex::Regex;
use serde_json::{Value, json};
use vinesink::case::Case;
use vinesink::quantity::Dimension;

fn shipped(folder: &str) -> Vec<(PathBuf, String)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries = fs::read_dir(folder).expect("the folder of cases");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut cases: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    cases.sort();
    cases.into_iter().map(|path| (path.clone(), fs::read_to_string(path).expect("text"))).collect()
}

/// The schema of every case.
fn schema() -> Value {
    vinesink::case::schema()
}

/// Its part that is of one mode and one absorber.
fn of_one() -> Value {
    schema()["$defs"]["one"].clone()
}

fn toml(text: &str) -> Value {
    let table: toml::Table = text.parse().expect("TOML");
    serde_json::to_value(table).expect("JSON")
}

/// The part of JSON Schema that the case's schema uses; panics on a keyword it does not know, so
/// that the schema cannot outgrow it unnoticed.
fn valid(root: &Value, value: &Value) -> bool {
    fits(root, root, value)
}

fn fits(root: &Value, schema: &Value, value: &Value) -> bool {
    // `true` is the schema that anything fits.
    if let Some(fits) = schema.as_bool() {
        return fits;
    }
    let object = schema.as_object().expect("a schema is an object");
    object.iter().all(|(keyword, expected)| holds(root, keyword, expected, schema, value))
}

fn holds(root: &Value, keyword: &str, expected: &Value, schema: &Value, value: &Value) -> bool {
    let valid = |schema: &Value, value: &Value| fits(root, schema, value);
    let list = || expected.as_array().expect("a list");
    let limit = |keeps: fn(f64, f64) -> bool| {
        let limit = expected.as_f64().expect("a number");
        value.as_f64().is_none_or(|number| keeps(number, limit))
    };
    match keyword {
        "$schema" | "$defs" | "title" | "description" | "examples" | "format" | "default" => true,
        "$ref" => {
            let path = expected.as_str().and_then(|path| path.strip_prefix('#'));
            let named = path.and_then(|path| root.pointer(path));
            valid(named.expect("a part of the schema"), value)
        }
        "if" => {
            let part = if valid(expected, value) { "then" } else { "else" };
            valid(&schema[part], value)
        }
        "then" | "else" => true,
        "type" => match expected.as_str().expect("one type") {
            "object" => value.is_object(),
            "string" => value.is_string(),
            "number" => value.is_number(),
            "integer" => value.is_i64() || value.is_u64(),
            "array" => value.is_array(),
            "boolean" => value.is_boolean(),
            other => panic!("unknown type {other}"),
        },
        "const" => value == expected,
        "dependentRequired" => {
            let has = |key: &str| value.get(key).is_some();
            let all = |keys: &Value| {
                keys.as_array().expect("a list").iter().all(|key| has(key.as_str().expect("a key")))
            };
            let mut each = expected.as_object().expect("an object").iter();
            each.all(|(key, needed)| !has(key) || all(needed))
        }
        "enum" => list().contains(value),
        "pattern" => {
            let pattern = Regex::new(expected.as_str().expect("text")).expect("a pattern");
            value.as_str().is_none_or(|text| pattern.is_match(text))
        }
        "minimum" => limit(|number, limit| number >= limit),
        "maximum" => limit(|number, limit| number <= limit),
        "exclusiveMinimum" => limit(|number, limit| number > limit),
        "required" => value.as_object().is_none_or(|object| {
            list().iter().all(|key| object.contains_key(key.as_str().expect("a key")))
        }),
        "properties" => expected
            .as_object()
            .expect("properties")
            .iter()
            .all(|(key, inner)| value.get(key).is_none_or(|value| valid(inner, value))),
        "additionalProperties" => {
            let known = |key: &str| schema["properties"].get(key).is_some();
            let mut others = value.as_object().into_iter().flatten();
            others.all(|(key, value)| known(key) || valid(expected, value))
        }
        "items" => {
            value.as_array().is_none_or(|items| items.iter().all(|item| valid(expected, item)))
        }
        "prefixItems" => value
            .as_array()
            .is_none_or(|items| items.iter().zip(list()).all(|(item, schema)| valid(schema, item))),
        "minItems" => {
            value.as_array().is_none_or(|i| i.len() as u64 >= expected.as_u64().expect(""))
        }
        "maxItems" => {
            value.as_array().is_none_or(|i| i.len() as u64 <= expected.as_u64().expect(""))
        }
        "uniqueItems" => value.as_array().is_none_or(|items| {
            let texts: BTreeSet<String> = items.iter().map(Value::to_string).collect();
            texts.len() == items.len()
        }),
        "oneOf" => list().iter().filter(|inner| valid(inner, value)).count() == 1,
        "allOf" => list().iter().all(|inner| valid(inner, value)),
        "anyOf" => list().iter().any(|inner| valid(inner, value)),
        "not" => !valid(expected, value),
        other => panic!("the schema uses {other}, which this test does not check"),
    }
}

#[test]
fn shipped_cases_parse_and_fit_the_schema() {
    let schema = schema();
    let cases = shipped("cases");
    assert!(cases.len() >= 14, "{} cases", cases.len());
    for (path, text) in cases {
        let name = path.display().to_string();
        let case = Case::parse(&name, &text).unwrap_or_else(|error| panic!("{error:?}"));
        assert!(valid(&schema, &toml(&text)), "{name}");
        assert!(text.starts_with("#:schema vinesink.schema.json\n"), "{name}");
        assert!(!case.title.is_empty() && !case.source.is_empty(), "{name}");
    }
    assert!(valid(&schema, &toml(&Case::starting_text("a title"))));
}

/// Cases of several modes or absorbers fit the same schema, by the part that is theirs; slips in them do not.
#[test]
fn shipped_cases_of_several_modes_fit_the_schema() {
    let (schema, of_one) = (schema(), of_one());
    let cases = shipped("cases/several");
    assert!(cases.len() >= 4, "{} cases", cases.len());
    for (path, text) in cases {
        let name = path.display().to_string();
        let case = toml(&text);
        assert!(valid(&schema, &case) && !valid(&of_one, &case), "{name}");
        assert!(text.starts_with("#:schema ../vinesink.schema.json\n"), "{name}");
        for (from, to) in [
            ("restitution = ", "restitution = 1"),
            ("clearance = \"", "clearance = \"-"),
            ("[[absorber]]", "[[absorber]]\nfriction = 0.1"),
            ("kind = \"force\"", "kind = \"acceleration\""),
            ("amplitude = ", "level = "),
        ] {
            if text.contains(from) {
                assert!(!valid(&schema, &toml(&text.replacen(from, to, 1))), "{name}: {to}");
            }
        }
    }
    let mast = toml(&fs::read_to_string("cases/several/mast.toml").expect("text"));
    for (key, value) in [("oscillator", json!({})), ("modes", json!({ "file": "mast.csv" }))] {
        let mut both = mast.clone();
        both[key] = value;
        assert!(!valid(&schema, &both), "{key}");
    }
    let mut shape = mast.clone();
    shape["mode"][0]["shape"]["tip"] = json!("1.0");
    assert!(!valid(&schema, &shape));
    let mut alone = mast;
    alone["absorber"] = alone["absorber"][0].clone();
    assert!(valid(&schema, &alone), "a single table is no list");
}

#[test]
fn the_shipped_schema_is_current() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("cases/vinesink.schema.json");
    let shipped: Value =
        serde_json::from_str(&fs::read_to_string(path).expect("the file")).expect("JSON");
    assert_eq!(shipped, schema(), "run: vinesink schema > cases/vinesink.schema.json");
}

#[test]
fn schema_names_its_draft_and_describes_every_key() {
    let schema = schema();
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    let each = ["one", "several"].map(|part| &schema["$defs"][part]["properties"]);
    let mut keys = 0;
    for (name, table) in each.into_iter().flat_map(|one| one.as_object().expect("properties")) {
        assert!(table["description"].is_string(), "{name} is not described");
        for (key, inner) in table["properties"].as_object().into_iter().flatten() {
            assert!(inner["description"].is_string(), "{name}.{key} is not described");
            keys += 1;
        }
    }
    assert!(keys >= 20, "{keys} keys");
}

/// The keys that the parser names when it refuses one it does not know.
fn accepted_by_parser(table: &str) -> BTreeSet<String> {
    let text = match table {
        "" => "zzzzzzzzzz = 1\n".to_owned(),
        table => format!("[{table}]\nzzzzzzzzzz = 1\n"),
    };
    let design = ["oscillator", "absorber", "excitation"];
    let start = if design.contains(&table) || table == "reduced" { "" } else { "reduced = {}\n" };
    let error = Case::parse("", &(start.to_owned() + &text)).expect_err("an unknown key");
    let problem = error.problems().find(|problem| problem.message.contains("zzzzzzzzzz"));
    let expected = &problem.expect("the key is refused").expected;
    let list = expected.strip_prefix("expected one of ").expect("the keys");
    list.split(", ").map(str::to_owned).collect()
}

#[test]
fn parser_and_schema_accept_the_same_keys() {
    let schema = of_one();
    let keys = |schema: &Value| -> BTreeSet<String> {
        schema["properties"].as_object().expect("properties").keys().cloned().collect()
    };
    assert_eq!(accepted_by_parser(""), keys(&schema));
    for (table, inner) in schema["properties"].as_object().expect("properties") {
        if inner["type"] == "object" {
            assert_eq!(accepted_by_parser(table), keys(inner), "[{table}]");
        }
    }
}

/// A sweep in place of a frequency ratio.
const SWEPT: &str = "kind = \"sine-sweep\"\nof = \"force\"\nfrom = 0.9\nto = 1.1\nrate = 0.0002\n#";

/// Changes to a case, which parser and schema must both accept or both refuse.
#[test]
fn parser_and_schema_agree_on_changes_to_a_case() {
    let physical = Case::starting_text("physical");
    let reduced = shipped("cases")
        .into_iter()
        .find(|(path, _)| path.ends_with("reduced-unit-clearance.toml"))
        .map(|(_, text)| text)
        .expect("the reduced case");
    let (design, _) = reduced.split_once("forcing").expect("the design alone");
    let free = format!("{design}kind = \"free\"\ndisplacement = 2\n");
    let schema = schema();
    let mut accepted = 0;
    for (text, from, to) in [
        (&physical, "\"20 mm\"", "\"20 µm\""),
        (&physical, "\"20 mm\"", "\"20 kg\""),
        (&physical, "\"20 mm\"", "20"),
        (&physical, "clearance", "clearence"),
        (&physical, "restitution = 0.6", "restitution = 0"),
        (&physical, "restitution = 0.6", "restitution = 1.01"),
        (&physical, "restitution = 0.6", ""),
        (&physical, "restitution = 0.6", "restitution = \"0.6\""),
        (&physical, "restitution = 0.6", "restitution = [0.6, 0]"),
        (&physical, "restitution = 0.6", "restitution = [0.6]"),
        (&physical, "restitution = 0.6", "restitution = [0.6, 1.2]"),
        (&physical, "restitution = 0.6", "restitution = [0.6, 0.5, 0.4]"),
        (&physical, "# inclination = \"0.5 deg\"", "inclination = \"-0.5°\""),
        (&physical, "# inclination = \"0.5 deg\"", "inclination = 0.5"),
        (&physical, "# inclination = \"0.5 deg\"", "inclination = \"0.5 Hz\""),
        (&physical, "# friction = 0.003", "friction = \"0.3 %\""),
        (&physical, "# friction = 0.003", "friction = -0.003"),
        (&physical, "mass = \"32 g\"", "mass_ratio = 0.5"),
        (&physical, "mass = \"32 g\"", "mass_ratio = 0"),
        (&physical, "mass = \"32 g\"", "mass_ratio = \"3 %\""),
        (&physical, "mass = \"32 g\"", "mass_ratio = \"0.03\""),
        (&physical, "mass = \"32 g\"", "mass_ratio = \"3 g\""),
        (&physical, "mass = \"32 g\"", "mass_ratio = true"),
        (&physical, "stiffness = \"11.47 kN/m\"", "frequency = \"8.35 Hz\""),
        (&physical, "stiffness = \"11.47 kN/m\"", "frequency = \"8.35 kN/m\""),
        (&physical, "stiffness = \"11.47 kN/m\"", ""),
        (&physical, "[oscillator]", "[oscillator]\nfrequency = \"8.35 Hz\""),
        (&physical, "mass = \"32 g\"", "mass_ratio = 0.5\nmass = \"32 g\""),
        (&physical, "mass = \"32 g\"", ""),
        (&physical, "damping = \"3.02 N s/m\"", "damping_ratio = 0"),
        (&physical, "damping = \"3.02 N s/m\"", "damping_ratio = -0.1"),
        (&physical, "damping = \"3.02 N s/m\"", "damping_ratio = \"0.5 %\""),
        (&physical, "damping = \"3.02 N s/m\"", "damping_ratio = \"-0.5 %\""),
        (&physical, "damping = \"3.02 N s/m\"", ""),
        (&physical, "\"base-displacement\"", "\"force\""),
        (&physical, "\"base-displacement\"", "\"base\""),
        (&physical, "\"0.25 mm\"", "\"2.9 N\""),
        (&physical, "\"8.5 Hz\"", "\"53 rad/s\""),
        (&physical, "[excitation]", "[excitement]"),
        (&physical, "title = \"physical\"", ""),
        (&physical, "title = \"physical\"", "title = \" \""),
        (&physical, "# [simulation]", "[simulation]\nperiods = 1"),
        (&physical, "# [simulation]", "[simulation]\nperiods = 0"),
        (&physical, "# [simulation]", "[simulation]\nstarts = 10001"),
        (&physical, "# [simulation]", "[simulation]\ndiscard = 1.5"),
        (&physical, "# [simulation]", "[reduced]"),
        (&physical, "# [report]", "[report]"),
        (&physical, "# [report]", "[report]\nfigures = [\"areas\", \"transfer-stretches\"]"),
        (&physical, "# [report]", "[report]\nfigures = [\"areas\", \"areas\"]"),
        (&physical, "# [report]", "[report]\nfigures = [\"Areas\"]"),
        (&physical, "# [report]", "[report]\nfigures = [1]"),
        (&physical, "# [report]", "[report]\nfigures = \"areas\""),
        (&physical, "# [report]", "report = []"),
        (&physical, "# [report]", "[accuracy]"),
        (&physical, "# [report]", "[accuracy]\namplitude = \"2.5 %\"\ncoexistence = true"),
        (&physical, "# [report]", "[accuracy]\namplitude = 0.01"),
        (&physical, "# [report]", "[accuracy]\namplitude = \"1 mm\""),
        (&physical, "# [report]", "[accuracy]\ncoexistence = \"yes\""),
        (&physical, "# [report]", "[accuracy]\nimpacts_per_period = 0"),
        (&physical, "# [report]", "[accuracy]\nimpacts_per_period = 0.05"),
        (&physical, "# [report]", "[uncertainty]\nclearance = \"0.2 mm\"\nrestitution = 0.05"),
        (&physical, "# [report]", "[uncertainty]\nclearance = \"± 0.2 mm\""),
        (&physical, "# [report]", "[uncertainty]\nrestitution = \"± 0.05\""),
        (&physical, "# [report]", "[uncertainty]\nrestitution = \" +- .05\""),
        (&physical, "# [report]", "[uncertainty]\nrestitution = \"0.05\""),
        (&physical, "# [report]", "[uncertainty]\nrestitution = \"± 5 %\""),
        (&physical, "# [report]", "[uncertainty]\nrestitution = -0.05"),
        (&reduced, "[reduced]", "[reduced]\nkind = \"force\""),
        (&reduced, "[reduced]", "[reduced]\nkind = \"forces\""),
        (&reduced, "[reduced]", "[reduced]\ndetuning = -5.4"),
        (&reduced, "frequency_ratio = 0.95818", "detuning = -5.4"),
        (&reduced, "frequency_ratio = 0.95818", "frequency_ratio = 0"),
        (&reduced, "frequency_ratio = 0.95818", ""),
        (&reduced, "clearance = 1.0", "clearance = 1"),
        (&reduced, "clearance = 1.0", "clearance = 0"),
        (&reduced, "forcing = 4.342", "forcing = -1"),
        (&reduced, "[reduced]", "[reduced]\ngravity_along = -0.1\nfriction_acceleration = 0.1"),
        (&reduced, "[reduced]", "[reduced]\nfriction_acceleration = -0.1"),
        (&reduced, "[reduced]", "[reduced]\ninclination = \"1 deg\""),
        (&reduced, "frequency_ratio = 0.95818", SWEPT),
        (&reduced, "frequency_ratio = 0.95818", &SWEPT.replace("of = \"force\"\n", "")),
        (&reduced, "frequency_ratio = 0.95818", &SWEPT.replace("0.9\n", "\"7 Hz\"\n")),
        (&reduced, "frequency_ratio = 0.95818", &SWEPT.replace("rate = ", "rate = -")),
        (&free, "displacement = 2", "displacement = 2\nvelocity = 1"),
        (&free, "displacement = 2", "displacement = -2"),
        (&free, "displacement = 2", ""),
        (&free, "\"free\"", "\"impulse\""),
        (&free, "\"free\"\ndisplacement", "\"impulse\"\nvelocity"),
        (&free, "kind = \"free\"", ""),
    ] {
        assert!(text.contains(from), "{from:?} is not in the case");
        let changed = text.replacen(from, to, 1);
        let parses = Case::parse("changed", &changed).is_ok();
        assert_eq!(valid(&schema, &toml(&changed)), parses, "{from:?} -> {to:?}");
        accepted += usize::from(parses);
    }
    assert_eq!(accepted, 28, "of the changes above");
}

fn patterns_agree(dimension: Dimension, schema: &Value) {
    let pattern = Regex::new(schema["pattern"].as_str().expect("a pattern")).expect("a pattern");
    let known = dimension.accepted_units().map(|unit| unit.symbol.to_owned());
    let others = [
        "", "m m", "mm m", "N s / m", "N*s/m", "N·s/m", "N⋅ s/m", "N.s/m", "KG", "μm", "µg", "µN",
        "hz", "rad / s", "rad s", "in", "lb", "lbf / in", "rpm", "ft", "N/µm", "kg / s", "sN/m",
        "km",
    ];
    for unit in known.chain(others.map(str::to_owned)) {
        for number in ["7.5 ", "7.5", "+.5e-3 ", " 5. ", "1e ", "", ". ", "1,5 ", "0x1 ", "1_0 "] {
            let text = format!("{number}{unit}");
            let parses = dimension.parse(&text).is_ok();
            assert_eq!(pattern.is_match(&text), parses, "{text:?} as {dimension:?}");
        }
    }
}

#[test]
fn patterns_match_what_the_parser_reads() {
    let schema = of_one();
    let of = |table: &str, key: &str| schema["properties"][table]["properties"][key].clone();
    patterns_agree(Dimension::Mass, &of("oscillator", "mass"));
    patterns_agree(Dimension::Stiffness, &of("oscillator", "stiffness"));
    patterns_agree(Dimension::Damping, &of("oscillator", "damping"));
    patterns_agree(Dimension::Length, &of("absorber", "clearance"));
    patterns_agree(Dimension::Inclination, &of("absorber", "inclination"));
    patterns_agree(Dimension::Share, &of("accuracy", "amplitude"));
    patterns_agree(Dimension::Frequency, &of("excitation", "frequency"));
    let kinds = &schema["properties"]["excitation"]["oneOf"];
    patterns_agree(Dimension::Length, &kinds[0]["properties"]["amplitude"]);
    patterns_agree(Dimension::Force, &kinds[1]["properties"]["amplitude"]);
}
