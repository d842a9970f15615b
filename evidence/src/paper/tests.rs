//! That verdicts follow from checks, and that the template fits what the figures tell.

use super::*;
use vinesink::executor::Serial;

#[test]
fn the_verdict_follows_from_the_checks() {
    let outcome = |holds: &[(&'static str, bool)]| {
        PaperFigure::new(holds.iter().copied(), Value::Null).verdict
    };
    assert_eq!(outcome(&[("a", true), ("b", true)]), FigureOutcome::Reproduced);
    assert_eq!(outcome(&[("a", true), ("b", false)]), FigureOutcome::WithDifference);
    assert_eq!(outcome(&[("a", false), ("b", false)]), FigureOutcome::Differs);
}

/// Every field that the template reads, with made-up numbers.
#[test]
fn the_template_fits_what_the_figures_tell() {
    let at = json!({ "clearance": 0.01, "peak": 0.003, "share": 0.4 });
    let stretch = json!({ "change": 0.2, "periods": 5, "impacts": 7, "impulse": 2.5 });
    let panel = json!({
        "letter": "a", "expected": "above-two", "found": "above-two", "clearance": 3e-4,
        "impacts_per_period": 3.0, "rms": 0.002,
    });
    let image = json!({
        "case": "c", "title": "t_t", "name": "n", "caption": "what", "alt": "see", "width": 720,
    });
    let mut figures = BTreeMap::new();
    let mut add = |number, names: &'static str, facts| {
        let checks = names.split(' ').map(|name| (name, name != "least_at_the_end"));
        let images = vec![image.clone()];
        figures.insert(number, PaperFigure { images, ..PaperFigure::new(checks, facts) });
    };
    let facts = json!({
        "fold": { "B": 1.05, "C": 0.2 }, "breaking": { "B": 1.6812, "C": 0.4 }, "away": 0.01,
        "allowed": 0.03,
    });
    add("3", "one_stable_branch on_the_branch", facts);
    let facts = json!({ "panels": [panel], "breaking": 0.01, "doubling": 0.008, "grazing": 0.007 });
    add("4", "a impacts_fall valley", facts);
    let facts = json!({
        "hopf": 0.0265, "collision": 0.0349, "modulated": 0.028, "slow_hopf": 0.0155,
        "slow_collision": 0.0163, "hysteresis": 0.015,
    });
    add("5", "hopf_first modulated collide side_by_side", facts);
    let facts = json!({
        "frequency": 8.3036, "detuning": -0.7096, "forcing": 1.119, "clearance": 0.02,
        "least": at, "last": at, "before": 0.2, "lower": 0.05,
    });
    add("6", "branches one_meeting least_at_the_end", facts);
    add("7", "widest none_whole", json!({ "responses": [at, at, at, at] }));
    add("8", "modulated follows", json!({ "clearance": 0.028, "away": 0.05 }));
    let facts =
        json!({ "harmonic": [0.9, 1.0], "damping": [0.4, 0.5], "elastic": 0.5, "dull": 0.4 });
    add("9", "lifts_the_fold harmonic damping one_amplitude", facts);
    let facts = json!({ "panels": [panel], "forcing": {
        "amplitude": 2.5e-4, "steady_to": 0.0158, "asymmetric": 0.004, "modulated": 0.0115,
        "least": 2.1e-4, "alone": 1.8e-4, "beside": 2e-4, "missed_by": 0.05,
    } });
    add("11", "a irregular three", facts);
    let facts = json!({
        "papers_own": 0.015, "papers_regime": null, "clearance": 0.028, "captured": 0.6,
        "longest": 40, "falls": stretch, "sparse": stretch, "correlation": -0.5, "searched": 400,
    });
    add("12", "papers_own captures falls sparse correlation weak stronger", facts);
    let steady = json!({
        "clearance": 0.0075, "peak": 0.00356, "bare": 0.00301, "change_db": 1.45,
        "breaking": 0.0051, "hopf": 0.0155, "collision": 0.0163, "ends_by_collision": true,
        "exact": [0.005, 0.0158], "exact_end": "fold", "simulated": null,
    });
    let context = json!({
        "sections": figures, "nearer": nearer(&figures, &image), "steady": [steady, steady],
        "figures": [{ "name": "map", "caption": "where", "alt": "a map", "width": 720 }],
    });
    let text = vinesink::report::template::render("paper.md", &Units::physical(0.0075), &context);
    let text = text.unwrap_or_else(|error| panic!("{error}"));
    for part in [
        "| [5](#fig-5): areas Z1 to Z4, and the two ways out of Z3 | reproduced |",
        "| [6](#fig-6): saddle-node and Hopf boundary, and the regions A1 and A2 | reproduced with a difference |",
        "3.56 mm instead of 3.01 mm (+1.4 dB)",
        "- holds: (a) more than two impacts per period in the paper; found at b = 0.300 mm:",
        "- **does not hold**: The vibration is smallest",
        "8.3036 Hz, $\\sigma = -0.7096$, $\\gamma = 1.119$",
        "[t_t](c/report.md): what\n\nChecked:\n\n- holds: One stable branch",
        "| 2.50 mm | (b) 3 in every period | **modulated, captured 30 %**, $z = 1.50$ (31 of 32) |",
        "43 with set A",
        "(Hopf, 26.5 mm), then two unstable points meet on the left branch and vanish (34.9 mm).",
    ] {
        assert!(text.contains(part), "{part} in\n{text}");
    }
}

#[test]
fn a_case_that_is_not_there_is_named() {
    let error = page(&[], &Serial).expect_err("needs cases");
    assert!(error.to_string().contains("`li2016-8p5hz-fig4c`"), "{error}");
}

/// The section on sets of parameters, with set B in all panels but one start.
fn nearer(figures: &BTreeMap<&str, PaperFigure>, image: &Value) -> Value {
    let limits = json!({ "restitution": 0.6, "breaking": 5e-3, "end": 8e-3, "fold": 0.024, "ratios": [1.6, 3.0] });
    let cell = json!({
        "found": "strongly-modulated", "impacts_per_period": 1.5, "captured": 0.3, "peak": 0.2,
        "starts": [31, 32],
    });
    let figure_11 = PaperFigure::new([("irregular", true), ("three", true)], Value::Null);
    let set = json!({
        "natural_frequency": 8.05, "amplitude": 7e-5, "bare": 4e-3, "detuning": -0.8, "limits": limits,
        "regimes": true, "cells": vec![cell; 7], "figure_11": figure_11, "figure_12": figures["12"],
    });
    let region = json!({ "points": 9, "lower": [0.03, 0.04], "amplitude": [6e-5, 8e-5] });
    json!({
        "clearances": [3e-4, 2.5e-3, 4e-3, 7.5e-3, 0.0115, 0.02, 0.015],
        "sets": [set, set, set], "others": [limits], "bounds": [2.875, 1.304],
        "maps": [{
            "restitution": 0.6, "starts": 4, "bounded": true, "all": region, "six": region,
            "seven": region,
        }],
        "image": image,
    })
}
