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
                    let text = page("report.md", &facts);
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
                let text = page("report.md", &facts);
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
        page("report.md", &facts);
        page("validation.md", &facts);
    }
    let mut facts = shipped("li2016-8hz-b7p5mm");
    for part in ["fixed_points", "orbits", "boundaries", "stretches"] {
        facts["theory"][part] = json!([]);
    }
    for part in ["limits", "kept", "lost", "best", "attracting", "amplitude_error"] {
        facts["theory"][part] = json!(null);
    }
    page("report.md", &facts);
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
        {"kind": "not-stationary", "motion": 0},
        {"kind": "doubtful", "motion": 0},
        {"kind": "limit", "limit": "elastic"},
        {"kind": "limit", "limit": "mass-ratio", "value": share(0.2)},
        {"kind": "limit", "limit": "offset", "value": share(0.3)},
        {"kind": "limit", "limit": "damping", "value": share(0.4)},
        {"kind": "not-admissible", "point": 0},
    ]);
    let text = page("report.md", &facts);
    let notes = text.lines().filter(|line| line.starts_with("- **")).count();
    assert_eq!(notes, 10, "{text}");
}

/// Every kind of claim with every kind of outcome and reason.
#[test]
fn every_claim_is_told() {
    let number = |value: f64| {
        json!({"number": {"id": "theory_error", "value": value, "error": 0.0, "method": "theory"},
               "outcome": null})
    };
    let outcome = |is: Value| json!({"number": null, "outcome": is});
    let reached = |repeats_after: Option<u32>, rests: bool| json!({"regime": "two-symmetric", "repeats_after": repeats_after, "rests": rests});
    let left = json!({"regime": "below-two", "repeats_after": null, "rests": false});
    let stable = |stable: bool, multiplier: Option<f64>| {
        outcome(json!({"is": "stability", "stable": stable, "multiplier": multiplier}))
    };
    let steady = |rests: bool| {
        outcome(json!({"is": "steady", "below": true, "above": false, "rests": rests}))
    };
    let near = json!({"bifurcation": "neimark-sacker", "distance": 0.02, "error": 0.03});
    let point =
        json!({"about": "stability", "point": 1, "absorber_amplitude": 1.234, "stable": true});
    let part = |symbol: &str| json!({"about": "fixed-point", "point": 2, "symbol": symbol});
    let boundary = |of: &str| json!({"about": "boundary", "bifurcation": of});
    let area = |strip: Option<&str>| json!({"about": "area", "area": "Z3", "strip": strip});
    let orbit = json!({"about": "repeats", "orbit": 1});
    let disturbed =
        |multiplier: f64| json!({"about": "disturbance", "orbit": 2, "multiplier": multiplier});
    let limit = |of: &str| json!({"about": "limit", "bifurcation": of});
    let starts =
        |near: &Value, chance: bool| json!({"is": "starts", "near": near, "by_chance": chance});
    let plain = |is: &str| outcome(json!({"is": is}));
    let because = |is: &str| json!({"is": is});
    let says_nothing = |is: &str, nothing: bool| json!({"is": is, "says_nothing": nothing});
    let regimes =
        outcome(json!({"is": "regimes", "shares": [["two-symmetric", 0.75], ["at-rest", 0.25]]}));
    let told = [
        (
            point.clone(),
            stable(true, None),
            stable(false, Some(1.258)),
            because("nearest-orbit"),
            [
                "fixed point 1 (B/b = 1.23) is stable",
                "manifold and slow flow (18)",
                "| stable | unstable, largest multiplier 1.26 |",
                "- multipliers of the exact orbit",
            ],
        ),
        (
            point.clone(),
            stable(false, None),
            plain("no-orbit"),
            because("nearest-orbit"),
            ["", "", "| unstable | no orbit near it |", ""],
        ),
        (
            point,
            stable(true, None),
            plain("unsolved"),
            because("nearest-orbit"),
            ["", "", "an undamped resonance has no exact orbit to compare", ""],
        ),
        (
            part("C"),
            number(0.1),
            number(0.2),
            says_nothing("neglected-terms", false),
            [
                "| amplitude C at fixed point 2 | slow flow (18) |",
                "",
                "",
                "- terms neglected by the expansion",
            ],
        ),
        (
            part("Theta"),
            number(0.1),
            number(0.2),
            says_nothing("neglected-terms", true),
            [
                "| phase Θ at fixed point 2 | manifold (14), (15) |",
                "",
                "",
                "λ); so wide that the theory says nothing",
            ],
        ),
        (
            boundary("neimark-sacker"),
            number(0.1),
            number(0.2),
            says_nothing("two-conditions", false),
            [
                "clearance of the Hopf (Neimark–Sacker) boundary",
                "boundaries of the slow flow",
                "",
                "- twice ε",
            ],
        ),
        (
            json!({"about": "rest"}),
            number(0.1),
            number(0.1),
            because("rounding"),
            ["absorber at rest", "equation of motion (1)", "", "rounding only"],
        ),
        (
            area(None),
            plain("only-steady"),
            regimes.clone(),
            starts(&near, false),
            [
                "the case lies in area Z3 |",
                "fixed points and boundaries",
                "steady 1:1 resonance only | symmetric 1:1 75 %, rest 25 %",
                "the Hopf boundary is 2.0 % away, within the theory's error of 3.0 %",
            ],
        ),
        (
            area(Some("A1")),
            plain("steady-beside-modulated"),
            regimes.clone(),
            starts(&json!(null), true),
            [
                "area Z3, strip A1",
                "",
                "steady 1:1 beside a modulated response",
                "depends on rounding",
            ],
        ),
        (
            area(Some("A2")),
            plain("strongly-modulated"),
            regimes.clone(),
            starts(&json!(null), false),
            ["strip A2", "", "strongly modulated response", "- share of all starts"],
        ),
        (
            area(None),
            plain("not-steady"),
            regimes,
            starts(&json!(null), false),
            ["", "", "no steady 1:1 resonance", ""],
        ),
        (
            orbit,
            plain("repeats"),
            outcome(json!({"is": "misses", "by": 9.2e-16})),
            because("growth"),
            [
                "exact orbit 1 repeats after one period",
                "| exact orbit |",
                "| repeats | misses itself by 9",
                "times the growth",
            ],
        ),
        (
            disturbed(0.9),
            outcome(json!({"is": "disturbance", "dies_out": true})),
            outcome(json!({"is": "left", "share": 0.0123, "periods": 50})),
            because("followed"),
            [
                "exact orbit 2 dies out (multiplier 0.9",
                "",
                "| dies out | 0.012 of it after 50 periods |",
                "hundredfold",
            ],
        ),
        (
            disturbed(1.2),
            outcome(json!({"is": "disturbance", "dies_out": false})),
            outcome(json!({"is": "left", "share": 99.0, "periods": 1})),
            because("followed"),
            ["exact orbit 2 grows (multiplier 1.2", "", "| grows | 99 of it after 1 period |", ""],
        ),
        (
            limit("neimark-sacker"),
            steady(false),
            outcome(
                json!({"is": "reached", "below": reached(Some(1), false), "above": reached(None, false)}),
            ),
            because("either-side"),
            [
                "Neimark–Sacker: what the motion becomes on either side",
                "| exact limit |",
                "| steady 1:1 below, not steady 1:1 above | symmetric 1:1 below, modulated symmetric 1:1 above |",
                "disturbed by 1e−3",
            ],
        ),
        (
            limit("sticking"),
            steady(true),
            outcome(json!({"is": "reached", "below": reached(Some(3), true), "above": left})),
            because("either-side"),
            [
                "sticking: what",
                "",
                "steady 1:1 below, rests on a wall above",
                "symmetric 1:1 with rests that repeats in 3 periods below, z < 2 above",
            ],
        ),
    ];
    for (statement, predicted, observed, reason, parts) in told {
        let mut facts = shipped("li2016-8hz-b7p5mm");
        let tolerance = json!({"id": "tolerance", "value": 0.1, "error": 0.0, "method": "theory"});
        facts["claims"] = json!([{
            "id": "claim", "statement": statement, "predicted": predicted, "observed": observed,
            "checked_by": "simulation", "difference": null, "tolerance": tolerance, "reason": reason,
            "verdict": "refuted",
        }]);
        facts["notes"] = json!([{"kind": "refuted", "claim": 0}]);
        let text = page("validation.md", &facts);
        for part in parts {
            assert!(text.contains(part), "{part} in\n{text}");
        }
        let note = page("report.md", &facts);
        assert!(note.contains("- **Refuted**: ") && note.contains(". Judged by: "), "{note}");
    }
}

#[test]
fn markdown_becomes_a_page() {
    let facts = shipped("li2016-band");
    let markdown = page("report.md", &facts);
    let drawings = std::collections::BTreeMap::new();
    let made = html::Page { title: "T", tone: "bad", markdown: &markdown, drawings: &drawings };
    let html = html::page(&made).expect("a page");
    assert!(html.contains("<section class=\"verdict bad\">") && html.contains("<table>"));
    assert_eq!(html.matches("<div class=\"table tiles\"").count(), 1);
}
