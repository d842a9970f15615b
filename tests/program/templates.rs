//! Every template over what a study may come to: each verdict, regime and kind of dynamics, one and several, with
//! and without each part. The facts are those of a shipped report, changed.

use std::fs;

use serde_json::{Value, json};
use vinesink::quantity::Units;
use vinesink::report::html;
use vinesink::report::template::render;

const REGIMES: [&str; 6] =
    ["at-rest", "two-symmetric", "two-asymmetric", "above-two", "below-two", "strongly-modulated"];
const WORDS: [&str; 8] = [
    "holds",
    "works",
    "too-close-to-call",
    "mixed",
    "does-nothing",
    "makes-it-worse",
    "no-answer",
    "fails",
];
const HEADLINES: [&str; 9] = [
    "no-motion",
    "nothing-drives",
    "unlimited-without",
    "at-rest",
    "higher-peaks",
    "less-on-average",
    "worse",
    "little",
    "less",
];

fn shipped(name: &str) -> Value {
    let text = fs::read_to_string(format!("reports/{name}/report.json")).expect("a report");
    serde_json::from_str(&text).expect("JSON")
}

fn units() -> Units {
    Units::physical(7.5e-3)
}

/// The page, which must read as sentences: no number that is none, no gap, no doubled sign or end.
fn page(name: &str, facts: &Value) -> String {
    let text = render(name, &units(), facts).unwrap_or_else(|error| panic!("{name}: {error}"));
    for wrong in [
        "NaN",
        "undefined",
        "null",
        "inf ",
        "..",
        " ,",
        " .",
        "( ",
        "  |  |",
        "1 starts",
        "1 notes",
    ] {
        let line = text.lines().find(|line| {
            // Cells and alternative texts may have signs of their own.
            !line.contains("$") && line.contains(wrong) && !line.starts_with("<img")
        });
        assert!(line.is_none(), "{name}: {wrong:?} in {line:?}");
    }
    text
}

#[test]
fn every_support_is_a_sentence() {
    let mut facts = shipped("footbridge-jump");
    let length = facts["support"]["length"].clone();
    for (orientation, support, long, sentence) in [
        (json!("horizontal"), "sliding", false, "Cavity: horizontal; the absorber slides in it.\n"),
        (
            json!("vertical"),
            "spring",
            true,
            "vertical, held by a soft spring of 0.4 Hz that is stretched by 1.6 m.",
        ),
        (json!("horizontal"), "spring", false, "horizontal, held by a soft spring of 0.4 Hz. The"),
        (
            json!("horizontal"),
            "pendulum",
            true,
            "the absorber on a pendulum of 0.4 Hz that is 1.6 m long. The",
        ),
        (json!(null), "spring", true, "Cavity: inclined by 90 deg, held by"),
    ] {
        facts["support"]["orientation"] = orientation;
        facts["support"]["support"] = json!(support);
        facts["support"]["length"] = if long { length.clone() } else { json!(null) };
        let page = page("release.md", &facts);
        assert!(page.contains(sentence), "{sentence}: {page}");
    }
    // No tilt and no friction acts on it, whatever its walls are.
    let support = facts["support"].take();
    let mut facts = shipped("li2016-8hz-b7p5mm");
    facts["support"] = support;
    let alike = page("steady.md", &facts);
    assert!(alike.contains("Neither gravity nor friction acts along the cavity.\n"), "{alike}");
    for end in ["restitution_at_plus_b", "restitution_at_minus_b"] {
        facts["quantities"][end] = facts["quantities"]["restitution"].clone();
    }
    let unequal = page("steady.md", &facts);
    assert!(
        unequal.contains("acts along the cavity; restitution is 0.6 at x − y = +b"),
        "{unequal}"
    );
}

#[test]
fn every_verdict_is_a_sentence() {
    for case in ["li2016-8hz-b7p5mm", "li2016-band", "reduced-unit-clearance"] {
        let mut facts = shipped(case);
        for word in WORDS {
            for headline in HEADLINES {
                facts["verdict"]["word"] = json!(word);
                facts["verdict"]["headline"] = json!(headline);
                for reason in
                    [json!(null), json!("lowers-resonance"), json!("grows-between-captures")]
                {
                    facts["verdict"]["reason"] = reason;
                    let text = page("steady.md", &facts);
                    assert!(text.lines().nth(2).is_some_and(|line| line.ends_with('.')), "{text}");
                }
            }
        }
    }
}

#[test]
fn every_motion_is_named_with_its_evidence() {
    let mut facts = shipped("li2016-8hz-b15mm");
    for regime in REGIMES {
        for dynamics in [
            json!({"kind": "at-rest"}),
            json!({"kind": "periodic", "impacts": 2, "periods": 1}),
            json!({"kind": "periodic", "impacts": 7, "periods": 3}),
            json!({"kind": "quasi-periodic"}),
            json!({"kind": "chaotic"}),
            json!({"kind": "transient-not-over"}),
            json!({"kind": "undecided"}),
        ] {
            for proof in [json!(null), facts["motions"][0]["proof"].clone()] {
                let motion = &mut facts["motions"][0];
                motion["regime"] = json!(regime);
                motion["dynamics"] = dynamics.clone();
                motion["proof"] = proof;
                motion["settled"] = json!(dynamics["kind"] != "transient-not-over");
                let text = page("steady.md", &facts);
                assert!(text.contains("| two") || !regime.starts_with("two"), "{regime}: {text}");
                page("validation.md", &facts);
            }
        }
    }
}

/// A report without one of its parts is still whole.
#[test]
fn no_part_is_needed_by_another() {
    for (part, nothing) in [
        ("motions", json!([])),
        ("inactive", json!(null)),
        ("criteria", json!(null)),
        ("band", json!(null)),
        ("claims", json!([])),
        ("notes", json!([])),
        ("figures", json!([])),
    ] {
        let mut facts = shipped("li2016-band");
        facts[part] = nothing;
        if part == "motions" {
            facts["main"] = json!(null);
            facts["simulated"] = json!(false);
        }
        let text = page("steady.md", &facts) + &page("validation.md", &facts);
        // A report without claims says so, and has no table of none.
        assert_eq!(part == "claims", text.contains("claim anything about this case"), "{part}");
        assert!(
            !text.contains("0 of 0 claims")
                && (part != "claims" || !text.contains("| Verdict | Claim"))
        );
    }
    let mut facts = shipped("li2016-8hz-b7p5mm");
    for part in ["fixed_points", "orbits", "boundaries", "stretches"] {
        facts["theory"][part] = json!([]);
    }
    for part in ["limits", "kept", "lost", "best", "attracting", "amplitude_error"] {
        facts["theory"][part] = json!(null);
    }
    page("steady.md", &facts);
}

/// Numbers of the cavity that a reduced case has in units of bω₀² say so.
#[test]
fn inputs_have_their_units() {
    let input = |name: &str| json!({"table": "reduced", "name": name, "symbol": "a", "as_written": "0.004"});
    let facts = json!({ "also": [], "inputs": [input("gravity_along"), input("friction_acceleration"), input("forcing")] });
    let text = page("inputs.md", &facts);
    for row in ["gravity along, over bω₀² |", "friction acceleration, over bω₀² |", "forcing |"]
    {
        assert!(text.contains(&format!("| reduced {row}")), "{text}");
    }
}

#[test]
fn every_note_is_a_sentence() {
    let mut facts = shipped("li2016-8hz-b7p5mm");
    let share =
        |value: f64| json!({"id": "mass_ratio", "value": value, "error": 0.0, "method": "given"});
    facts["notes"] = json!([
        {"kind": "warning", "line": 7, "column": 3, "message": "did you mean 0.40 %?"},
        {"kind": "refuted", "claim": 1},
        {"kind": "stopped", "motion": 0},
        {"kind": "not-settled", "motion": 0},
        {"kind": "doubtful", "motion": 0},
        {"kind": "limit", "limit": "elastic"},
        {"kind": "limit", "limit": "mass-ratio", "value": share(0.2)},
        {"kind": "limit", "limit": "offset", "value": share(0.3)},
        {"kind": "limit", "limit": "damping", "value": share(0.4)},
        {"kind": "not-admissible", "point": 0},
    ]);
    let text = page("steady.md", &facts);
    let notes = text.lines().filter(|line| line.starts_with("- **")).count();
    // Before them that of a start from rest.
    assert_eq!(notes, 11, "{text}");
}

/// Every kind of claim, outcome and reason.
#[test]
fn every_claim_is_told() {
    let text = fs::read_to_string("tests/claims.json").expect("claims");
    let claims: Vec<Value> = serde_json::from_str(&text).expect("JSON");
    let tolerance = json!({"id": "tolerance", "value": 0.1, "error": 0.0, "method": "theory"});
    for mut claim in claims {
        let told = claim["told"].take();
        claim["id"] = json!("claim");
        claim["checked_by"] = json!("simulation");
        claim["difference"] = json!(null);
        claim["tolerance"] = tolerance.clone();
        claim["verdict"] = json!("refuted");
        let mut facts = shipped("li2016-8hz-b7p5mm");
        facts["claims"] = json!([claim]);
        facts["notes"] = json!([{"kind": "refuted", "claim": 0}]);
        facts["verdict"]["confirmed"] = json!(0);
        let text = page("validation.md", &facts);
        for part in told.as_array().expect("parts") {
            let part = part.as_str().expect("text");
            assert!(text.contains(part), "{part} in\n{text}");
        }
        // The page of the case has how many there are, and each with all of that.
        let page = page("steady.md", &facts);
        assert!(page.contains("- **Theory**: 1 claim of it is refuted"), "{page}");
        let (_, section) = page.split_once("## Validation").expect("a section");
        let (row, reason) =
            (section.contains("\n| refuted | "), section.contains("allowed:\n\n- "));
        assert!(row && reason, "{section}");
    }
}

#[test]
fn markdown_becomes_a_page() {
    let facts = shipped("li2016-band");
    let markdown = page("steady.md", &facts);
    let drawings = html::Drawings::new();
    let html = html::page("bad", &markdown, &drawings).expect("a page");
    assert!(html.contains("<section class=\"verdict bad\">") && html.contains("<table>"));
    assert_eq!(html.matches("<div class=\"table tiles\"").count(), 1);
}

/// A criterion that is not decided does not fail, and does not hold.
#[test]
fn criteria_are_counted_by_what_they_came_to() {
    for (failing, undecided, close, words) in [
        (0, 0, 0, "all 3 criteria hold"),
        (0, 1, 0, "1 of 3 criteria is not decided"),
        (0, 3, 0, "3 of 3 criteria are not decided"),
        (1, 2, 0, "1 of 3 criteria fails, 2 are not decided"),
        (2, 0, 0, "2 of 3 criteria fail"),
        // What an error alone could turn does not fail by what was found.
        (0, 0, 1, "1 of 3 criteria is too close to call"),
        (0, 0, 2, "2 of 3 criteria are too close to call"),
        (1, 0, 1, "1 of 3 criteria fails, 1 too close to call"),
        (0, 1, 1, "1 of 3 criteria is not decided, 1 too close to call"),
    ] {
        let criteria = json!({
            "failing": failing, "undecided": undecided, "count": 3, "too_close": close,
            "holding": 3 - failing - undecided - close, "count_inactive": true, "all": [],
        });
        let text = page("check.txt", &json!({ "case": "c", "criteria": criteria }));
        assert!(text.starts_with(&format!("c: {words}\n")), "{text}");
    }
}

/// What a search of several absorbers may come to, on its page and on a terminal: the sentence is the same.
#[test]
fn every_search_of_several_absorbers_is_told() {
    let of = |id: &str, value: f64| json!({ "id": id, "value": value, "error": 0.0, "method": "simulation" });
    let absorbers = json!([{
        "mass": of("absorber_mass", 3.0), "place": "tip", "clearance": of("clearance", 2.7e-3),
        "restitution": of("restitution", 0.3),
    }]);
    let load = json!({
        "amplitude": of("force_amplitude", 0.3), "place": "tip", "mode": null,
        "from": of("excitation_frequency", 1.0), "to": of("excitation_frequency", 1.2),
    });
    let row = |value: Value, holds: bool| {
        json!({
            "absorbers": absorbers, "value": value, "loads": [of("peak_displacement", 2.9e-3)],
            "criteria": null, "all_hold": holds,
        })
    };
    let mut sentences = std::collections::BTreeSet::new();
    for (objective, id) in [
        ("criteria", "peak_displacement"),
        ("worst-amplitude", "peak_displacement"),
        ("stable-share", "stable_share"),
        ("margin", "smallest_margin"),
    ] {
        for answer in ["found", "none", "not-reached"] {
            for (asked, holds, is_optimum) in
                [(true, true, true), (true, false, false), (false, true, false)]
            {
                let found = of(id, 0.1);
                let one = row(found.clone(), holds);
                let mut robust = one.clone();
                for key in ["expected", "worst_corner", "optimum_expected", "optimum_worst_corner"]
                {
                    robust[key] = found.clone();
                }
                (robust["combinations"], robust["is_optimum"]) = (json!(5), json!(is_optimum));
                let by_orbits = objective == "stable-share" || objective == "margin";
                let best = if answer == "none" { json!([]) } else { json!([one]) };
                let robust = if asked { robust } else { Value::Null };
                let at = json!({
                    "title": "t", "answer": answer, "objective": objective, "asked": asked,
                    "by_orbits": by_orbits,
                    "best": best,
                    "own": one, "nearest": absorbers, "at_bound": holds, "candidates": 120,
                    "bounds": {
                        "clearances": [[of("clearance", 1e-3), of("clearance", 8e-3)]], "common": true,
                        "restitution": null, "places": ["tip"], "split_mass": false,
                    },
                    "loads": [load], "robust": robust,
                    "version": "0", "case_sha256": "0",
                });
                let facts = json!({ "at": at, "figures": [] });
                let [markdown, terminal] =
                    ["loads-optimum.md", "loads-optimum.txt"].map(|name| page(name, &facts));
                let sentence = terminal.lines().nth(2).expect("a sentence").to_owned();
                assert!(!sentence.is_empty() && terminal.contains("Looked at: 120"), "{terminal}");
                let told = markdown.lines().nth(2).expect("a sentence").replace('\\', "");
                assert_eq!(told, format!("> **{sentence}**"));
                sentences.insert(sentence);
                assert_eq!(markdown.contains("[uncertainty]"), asked, "{markdown}");
            }
        }
    }
    assert!(sentences.len() > 8, "{sentences:?}");
}
