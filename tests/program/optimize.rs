//! Optimisation: the optimum against brute force, its expectation against Monte Carlo, the written case,
//! bounds, and what is refused.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};
use vinesink::band::{Survey, theory};
use vinesink::case::{Case, Design, Distribution, Objective, Uncertainty};
use vinesink::criteria;
use vinesink::executor::{Executor, Serial};
use vinesink::measure::Measure;
use vinesink::optimize::claim::OptimumClaim;
use vinesink::optimize::{Optimization, Task};
use vinesink::orbits::symmetric_orbits;
use vinesink::report::figure::Layer;
use vinesink::report::optimize::summary;
use vinesink::system::Parameter;

fn band_text(more: &str) -> String {
    let text = fs::read_to_string("cases/li2016-band.toml").expect("a case");
    // Without what it asks of an optimisation itself, which comes last.
    let (design, _) = text.split_once("[optimize]").expect("its tables are in this order");
    format!("{design}\n{more}")
}

/// The same without criteria: no candidate is simulated along the band.
fn band_without_criteria(more: &str) -> String {
    let text = band_text("");
    let (before, rest) = text.split_once("[criteria]").expect("criteria");
    let after = rest.split_once("\n[").map_or(String::new(), |(_, after)| format!("[{after}"));
    // Of theory, as the case asks it.
    let objective = "[optimize]\nobjective = \"z3-share\"\n";
    match more.split_once("[optimize]\n") {
        Some((_, more)) => format!("{before}{after}\n{objective}{more}"),
        None => format!("{before}{after}\n{objective}{more}"),
    }
}

fn case(text: &str) -> Case {
    Case::parse("a case", text).unwrap_or_else(|error| panic!("{error:?}"))
}

fn optimized(text: &str, objective: Option<Objective>) -> Optimization {
    let case = case(text);
    let task = Task::of(&case, objective).expect("a task");
    Optimization::of(&task, text, &Serial).expect("an optimum")
}

fn reduced(r: f64, eps: f64, lambda: f64, forcing: f64, band: [f64; 2], more: &str) -> String {
    let [from, to] = band;
    format!(
        "title = \"t\"\nsource = \"s\"\n[reduced]\nmass_ratio = {eps}\ndamping = {lambda}\nrestitution = {r}\n\
         clearance = 1.0\nforcing = {forcing}\nfrequency_ratio = 1.0\n[band]\nfrom = {from}\nto = {to}\n{more}"
    )
}

/// The best of a fine grid over the bounds.
fn brute_force(task: &Task, points: u32) -> f64 {
    let scores = (0..=points).filter_map(|k| {
        let choice = task.choice(&[f64::from(k) / f64::from(points)]);
        task.score(&choice, &Serial)
    });
    scores.fold(f64::NEG_INFINITY, f64::max)
}

#[test]
#[ignore = "deep"]
fn the_optimum_of_an_exact_objective_is_that_of_brute_force() {
    use Objective::{Margin, StableShare, Z3Share};
    let cases = [
        (reduced(0.6, 0.0077, 1.8, 4.3, [0.94, 1.06], ""), Z3Share, 3000),
        (reduced(0.3, 0.03, 1.0, 2.0, [0.85, 1.2], ""), Z3Share, 3000),
        (reduced(0.8, 0.01, 0.6, 1.0, [0.98, 1.01], ""), StableShare, 900),
        (reduced(0.65, 0.02, 1.2, 3.0, [0.99, 1.01], ""), Margin, 900),
    ];
    for (text, objective, points) in cases {
        let found = optimized(&text, Some(objective));
        let brute = brute_force(&found.task, points);
        let best = found.best.value;
        println!("{objective:?}: {best} against {brute}, at {:?}", found.best.choice);
        let scale = brute.abs();
        // Four written digits move a clearance by up to 5e-4, and a score by a few times that; between
        // two points of the grid, 1e-3 apart, lies a top that is higher by a slope of ten.
        assert!(best >= brute - 2e-3 * scale, "{objective:?}: {best} below {brute}");
        assert!(best <= brute + 2e-2 * scale, "{objective:?}: {best} above {brute}");
        assert!(found.improves(), "{objective:?}");
        assert_eq!(found.task.score(&found.best.choice, &Serial), Some(best));
        assert_eq!(found.checked, (best, 0.0));
    }
}

/// What is claimed is what a check of the written case says, and nothing that was judged is preferred to
/// the winner, the case's own absorber included.
#[test]
fn the_winner_is_what_check_says_of_it() {
    let more = "[optimize]\nclearance = [\"10 mm\", \"30 mm\"]\n";
    let text = band_text(more)
        .replace("peak_displacement = \"<= 16 mm\"", "peak_displacement = \"<= 1 m\"");
    let found = optimized(&text, Some(Objective::WorstAmplitude));
    let best = &found.best;
    let written = case(&best.written.text);
    let survey = Survey::of(&written.range(), &criteria::settings(&written), None, &Serial);
    let judged = criteria::judge(&written, &survey.expect("finite"));
    let peak = judged.iter().find(|one| one.criterion.measure == Measure::Peak);
    let peak = peak.expect("it is asked");
    assert_eq!((peak.found, peak.error), (Some(best.value), best.error));
    assert_eq!(found.checked, (best.value, best.error));
    assert!(!best.is_worse_than(&found.own, Objective::WorstAmplitude));
    let preferred = |one: &vinesink::optimize::JudgedDesign| {
        (one.is_feasible(), -(one.value + one.error))
            > (best.is_feasible(), -(best.value + best.error))
    };
    assert!(!found.judged.iter().any(preferred), "{:?}", found.judged);
    // Looked at are places all over the bounds, and judged those close around the best.
    let [from, to] = [0, found.landscape.len() - 1].map(|k| found.landscape[k].0);
    assert!(from < 0.0101 && to > 0.0299, "{from} {to}");
    let clearances: Vec<f64> = found.judged.iter().map(|one| one.choice.clearance()).collect();
    let close = clearances.iter().filter(|one| (*one / best.choice.clearance() - 1.0).abs() < 0.01);
    assert!(close.count() >= 2, "{:?} {clearances:?}", best.choice);
}

/// Criteria exclude what the objective alone would choose, and where none can be met that is said.
#[test]
#[ignore = "deep"]
fn the_best_of_those_that_meet_the_criteria_wins() {
    let bounds = "[optimize]\nclearance = [\"5 mm\", \"40 mm\"]\n";
    let text = band_text(bounds);
    let (without, _) = text.split_once("[criteria]").expect("criteria");
    let free = optimized(&format!("{without}{bounds}"), Some(Objective::Z3Share));
    let bound = optimized(&text, Some(Objective::Z3Share));
    println!("{:?} and {:?}", free.best.choice, bound.best.choice);
    assert!(bound.succeeds() && bound.closest.is_none(), "{:?}", bound.best.criteria);
    // The free optimum has an absorber that may never wake at resonance, and then a larger peak.
    assert!(free.best.value > bound.best.value + 0.01, "{} {}", free.best.value, bound.best.value);
    let preferred = |one: &&vinesink::optimize::JudgedDesign| one.value > bound.best.value;
    let preferred: Vec<_> = bound.judged.iter().filter(preferred).collect();
    assert!(
        !preferred.is_empty() && preferred.iter().all(|one| !one.is_feasible()),
        "{preferred:?}"
    );
    // Close to where the criteria end: the next one that was judged misses them, less than 1 % away.
    let best = bound.best.choice.clearance();
    let next =
        bound.judged.iter().find(|one| one.choice.clearance() > best).expect("judged all over");
    assert!(
        !next.is_feasible() && next.choice.clearance() < 1.01 * best,
        "{:?} beside {best}",
        next.choice
    );
    let text = text.replace("peak_displacement = \"<= 16 mm\"", "peak_displacement = \"<= 1 mm\"");
    let none = optimized(&text, Some(Objective::Z3Share));
    assert!(!none.best.is_feasible() && !none.succeeds());
    let closest = none.closest.as_ref().expect("one misses least");
    assert!(closest.violation() <= none.best.violation());
    let told = summary(&case(&text), &none).expect("a text");
    let answer = told.lines().nth(2).expect("it follows the title");
    let lead = "No absorber between the bounds meets all criteria. Closest to them is clearance ";
    assert!(answer.starts_with(lead) && answer.contains("asked ≤ 1 mm"), "{told}");
    assert!(told.contains("\nA tuned mass damper of the same mass"), "{told}");
    assert!(told.contains("\nbest by the objective  "), "{told}");
    // A mass that would: at resonance damping and absorber carry the force, x_st = 1 mm (2 zeta + 0.55 eps).
    let needed = none.needed_mass_ratio.expect("none has enough");
    let damped = {
        let system = case(&text).system();
        system.mass_ratio() * system.damping()
    };
    let still = case(&text).design.value(Parameter::Amplitude).expect("it is driven");
    let still = still * libm::hypot(1.0, damped);
    let right = (damped + 0.55 * needed) * 1e-3;
    assert!((still / right - 1.0).abs() < 1e-9, "{needed}: {still} {right}");
    assert!(told.contains("the limit asks for an absorber of"), "{told}");
    assert!(bound.needed_mass_ratio.is_none());
}

/// Standard normal numbers with a fixed beginning, by Box and Muller.
struct Normal(Xoshiro256PlusPlus);

impl Normal {
    /// From 0 to 1.
    fn uniform(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn next(&mut self) -> f64 {
        let (a, b) = (1.0 - self.uniform(), self.uniform());
        (-2.0 * libm::log(a)).sqrt() * libm::cos(std::f64::consts::TAU * b)
    }
}

/// Four errors, and two larger ones, as standard deviations and as ranges.
const UNCERTAIN: [[&str; 2]; 2] = [
    [
        "[uncertainty]\nclearance = \"0.6 mm\"\nrestitution = 0.05\nfrequency = \"0.05 Hz\"\namplitude = \"0.02 mm\"\n",
        "[uncertainty]\nclearance = \"1.5 mm\"\nfrequency = \"0.03 Hz\"\n",
    ],
    [
        "[uncertainty]\nclearance = \"± 1 mm\"\nrestitution = \"± 0.08\"\nfrequency = \"± 0.08 Hz\"\namplitude = \"± 0.03 mm\"\n",
        "[uncertainty]\nclearance = \"± 2.5 mm\"\nrestitution = \"± 0.1\"\n",
    ],
];

/// An error as it is drawn.
fn drawn(distribution: Distribution, normal: &mut Normal) -> f64 {
    match distribution {
        Distribution::Normal(deviation) => deviation * normal.next(),
        Distribution::Uniform(largest) => largest * (2.0 * normal.uniform() - 1.0),
    }
}

/// Average and standard error over deviations, the same for every absorber.
fn monte_carlo(task: &Task, choice: &Design, samples: u32) -> (f64, f64) {
    let mut normal = Normal(Xoshiro256PlusPlus::seed_from_u64(1));
    let (mut sum, mut squares) = (0.0, 0.0);
    for _ in 0..samples {
        let errors = task.case.uncertainty.parameters();
        let off: Vec<_> = errors.map(|(one, errors)| (one, drawn(errors, &mut normal))).collect();
        let score = task.score(&choice.deviating(&off), &Serial).expect("a score");
        sum += score;
        squares += score * score;
    }
    let count = f64::from(samples);
    let mean = sum / count;
    (mean, ((squares / count - mean * mean) / (count - 1.0)).sqrt())
}

#[test]
fn the_expectation_and_its_optimum_are_those_of_monte_carlo() {
    for [four, two] in UNCERTAIN {
        // All deviate to absorbers that there are.
        let bounds = "[optimize]\nclearance = [\"2.3 mm\", \"57.5 mm\"]\n";
        let [four, two] = [four, two].map(|one| format!("{one}{bounds}"));
        let task = Task::of(&case(&band_text(&four)), None).expect("a task");
        for part in [0.45, 0.6, 0.68] {
            let choice = task.choice(&[part]);
            let expected = task.expected(&choice, &task.deviations(), &Serial).expect("a score");
            let (mean, error) = monte_carlo(&task, &choice, 4000);
            println!("{part}: {expected} against {mean} with a standard error of {error}");
            // Four standard errors are exceeded by chance once in 16,000 times.
            assert!((expected - mean).abs() < 4.0 * error, "{expected}, {mean}, {error}");
        }
        // Whether the best is within the other limits is a matter of a thousandth of a motion that does not repeat.
        let limits = ["stable_share", "peak_displacement", "reduction_db", "impact_velocity"];
        let text = band_text(&two);
        let asked = text.lines().filter(|line| !limits.iter().any(|key| line.starts_with(key)));
        let found = optimized(&asked.collect::<Vec<_>>().join("\n"), None);
        let robust = found.robust.as_ref().expect("something is uncertain");
        let (reached, error) = monte_carlo(&found.task, &robust.design.choice, 2000);
        let places = (0..13).map(|k| found.task.choice(&[0.4 + 0.04 * f64::from(k)]));
        for choice in places.chain([found.best.choice]) {
            let (other, _) = monte_carlo(&found.task, &choice, 2000);
            // The same errors befall both, so that their difference scatters less than either.
            assert!(reached > other - error, "{choice:?}: {other} above {reached}");
        }
        let [of_robust, of_best] = robust.under;
        assert!(of_robust.expected >= of_best.expected, "{robust:?}");
        assert!(of_robust.worst_corner <= of_robust.expected, "{robust:?}");
        assert!(robust.design.value <= found.best.value + 1e-9, "{robust:?}");
    }
}

#[test]
fn a_written_case_differs_in_its_values_only() {
    let text = band_without_criteria(
        "[optimize]\nrestitution = [0.55, 0.75]\nmass = [\"25 g\", \"40 g\"]\n",
    )
    .replace("clearance = \"11.5 mm\"", "clearance = \"1.15 cm\"   # a guess");
    let found = optimized(&text, None);
    let changed: Vec<(&str, &str)> = text
        .lines()
        .zip(found.best.written.text.lines())
        .filter(|(before, after)| before != after)
        .collect();
    assert_eq!(text.lines().count(), found.best.written.text.lines().count());
    assert_eq!(changed.len(), 3, "{changed:?}");
    let clearance = changed.iter().find(|(_, after)| after.starts_with("clearance = \""));
    let (_, clearance) = clearance.expect("the clearance");
    assert!(clearance.ends_with(" cm\"   # a guess"), "{clearance}");
    let digits = clearance.chars().take_while(|c| *c != '#').filter(char::is_ascii_digit).count();
    assert!(digits <= 5, "{clearance}");
    // What is shown is what is written.
    let again = case(&found.best.written.text);
    assert_eq!(again.design, found.best.choice);
    let task = Task::of(&again, None).expect("a task");
    let score = task.score(&found.best.choice, &Serial).expect("a score");
    assert!((score - found.best.value).abs() < 1e-9, "{score}");
    // Three variables do better than one.
    let one = optimized(&band_without_criteria(""), None);
    assert!(found.best.value >= one.best.value - 1e-3, "{:?}", found.best.choice);
}

#[test]
fn bounds_are_kept() {
    let tables = [
        "[optimize]\nclearance = [\"14 mm\", \"14.001 mm\"]\n",
        "[optimize]\nclearance = [\"3 mm\", \"5 mm\"]\nrestitution = [0.7123456, 0.7123458]\n",
        "[optimize]\nclearance = [\"9.1234567 mm\", \"9.1234569 mm\"]\nmass = [\"31 g\", \"33 g\"]\n",
    ];
    for table in tables {
        let found = optimized(&band_without_criteria(table), None);
        // The case's own absorber, out of bounds, may be better than all between them.
        let kept = found.task.allows(&found.best.choice) || !found.improves();
        assert!(kept, "{table}: {:?}", found.best.choice);
        let [from, to] = [found.task.bounds[0].from, found.task.bounds[0].to];
        let inside = |one: f64| from * (1.0 - 1e-9) <= one && one <= to * (1.0 + 1e-9);
        assert!(
            found.judged.iter().all(|one| inside(one.choice.clearance())),
            "{table}: {:?}",
            found.judged
        );
    }
}

#[test]
fn of_a_plateau_the_middle_is_chosen() {
    let text = reduced(0.6, 0.0077, 1.8, 4.3, [0.97, 1.03], "").replace("[band]", "#");
    let text: String =
        text.lines().take_while(|line| *line != "#").map(|l| l.to_owned() + "\n").collect();
    for objective in [Objective::Z3Share, Objective::StableShare] {
        let found = optimized(&text, Some(objective));
        assert_eq!(found.best.value, 1.0, "{objective:?}");
        let [low, high] = found.plateau;
        let middle = (low * high).sqrt();
        assert!((found.best.choice.clearance() / middle - 1.0).abs() < 1e-3, "{middle}");
        for (at, inside) in
            [(low * 1.001, 1.0), (high * 0.999, 1.0), (low * 0.999, 0.0), (high * 1.001, 0.0)]
        {
            let choice = found.best.choice.with(Parameter::Clearance, at);
            assert_eq!(found.task.score(&choice, &Serial), Some(inside), "{objective:?} {at}");
        }
    }
}

/// Evaluates from the last to the first.
struct Backwards;

impl Executor for Backwards {
    fn each(&self, _: &str, count: usize, f: &(dyn Fn(usize) + Sync)) {
        (0..count).rev().for_each(f);
    }
}

#[test]
#[ignore = "deep"]
fn the_order_of_evaluations_changes_nothing() {
    let text =
        reduced(0.6, 0.0077, 1.8, 4.3, [0.97, 1.03], "[optimize]\nrestitution = [0.5, 0.7]\n");
    let case = case(&text);
    let task = Task::of(&case, None).expect("a task");
    let backwards = Optimization::of(&task, &text, &Backwards).expect("an optimum");
    let forwards = Optimization::of(&task, &text, &Serial).expect("an optimum");
    assert_eq!(backwards.best, forwards.best);
    assert_eq!(backwards.landscape, forwards.landscape);
}

/// Best amplitude and end of the 1:1 motion by a dense scan of the clearance.
#[test]
fn the_claim_is_measured_where_a_scan_finds_it() {
    for name in ["li2016-8p5hz-fig4a", "li2016-8hz-b7p5mm", "force-on-mass"] {
        let text = fs::read_to_string(format!("cases/{name}.toml")).expect("a case");
        let system = case(&text).system();
        let claim = OptimumClaim::of(&system).expect("a stable orbit somewhere");
        let amplitude = |factor: f64| {
            let there = system.with_clearance_scaled(factor).expect("valid");
            let orbits = symmetric_orbits(&there).expect("steady");
            let stable = orbits.iter().find(|orbit| orbit.orbit.attracts())?;
            Some(stable.peaks.displacement * factor)
        };
        println!("{name}: {claim:?}, distance {}, excess {}", claim.distance, claim.excess);
        assert!(amplitude(claim.end_clearance * 0.9999).is_some(), "{name}");
        assert!(amplitude(claim.end_clearance * 1.0001).is_none(), "{name}");
        let scanned = (0..3000)
            .filter_map(|k| amplitude(claim.end_clearance * (0.02 + 0.001 * f64::from(k))));
        let least = scanned.fold(f64::INFINITY, f64::min);
        assert!((claim.best_amplitude / least - 1.0).abs() < 0.02, "{name}: {claim:?}, {least}");
    }
}

#[test]
fn an_error_is_a_standard_deviation_or_a_range() {
    use Distribution::{Normal, Uniform};
    let of = |text: &str| case(text).uncertainty;
    let physical = of(&band_text(
        "[uncertainty]\nclearance = \"± 0.2 mm\"\nrestitution = \"+- 0.05\"\nfrequency = \" +/-0.1 Hz\"\namplitude = \"0.05 mm\"\n",
    ));
    let expected = Uncertainty {
        clearance: Some(Uniform(0.0002)),
        restitution: Some(Uniform(0.05)),
        frequency: Some(Uniform(0.1)),
        amplitude: Some(Normal(0.05e-3)),
        ..Uncertainty::default()
    };
    assert_eq!(physical, expected);
    let plain = |table: &str| of(&reduced(0.6, 0.0077, 1.8, 4.3, [0.97, 1.03], table));
    let found =
        plain("[uncertainty]\nclearance = \"± 0.02\"\nfrequency = 0.001\namplitude = \"± 0.43\"\n");
    let expected = Uncertainty {
        clearance: Some(Uniform(0.02)),
        restitution: None,
        frequency: Some(Normal(0.001)),
        amplitude: Some(Uniform(0.43)),
        ..Uncertainty::default()
    };
    assert_eq!(found, expected);
    assert!(!plain("[uncertainty]\nclearance = \"± 0\"\nrestitution = 0\n").is_any());
    // A comma is corrected behind its sign.
    let text = band_text("[uncertainty]\nclearance = \"± 0,2 mm\"\n");
    let error = Case::parse("a case", &text).expect_err("a comma");
    let help = error.problems().next().and_then(|problem| problem.help.clone());
    assert_eq!(help.as_deref(), Some("write \"± 0.2 mm\""));
}

#[test]
fn bad_input_is_refused_where_it_stands() {
    let physical = |table: &str| band_text(table);
    let plain = |table: &str| reduced(0.6, 0.0077, 1.8, 4.3, [0.97, 1.03], table);
    let wrong = [
        (
            physical("[optimize]\nclearance = [\"40 mm\", \"5 mm\"]"),
            "the values of `clearance` do not rise",
            "[\"40 mm\", \"5 mm\"]",
        ),
        (physical("[optimize]\nclearance = [5, 40]"), "a value of `clearance` has no unit", "5"),
        (physical("[optimize]\nclearance = \"5 mm\""), "`clearance` is not a pair", "\"5 mm\""),
        (
            physical("[optimize]\nmass = [\"20 mm\", \"50 g\"]"),
            "a value of `mass` is a mass, but `mm` is the unit of a length",
            "mm",
        ),
        (
            physical("[optimize]\nrestitution = [0.4, 1.2]"),
            "a value of `restitution` is 1.2",
            "1.2",
        ),
        (
            physical("[optimize]\nobjective = \"z3share\""),
            "`objective` is \"z3share\"",
            "\"z3share\"",
        ),
        (physical("[uncertainty]\nclearance = \"-1 mm\""), "`clearance` is -1 mm", "\"-1 mm\""),
        (
            physical("[uncertainty]\nclearance = \"± -1 mm\""),
            "`clearance` is ± -1 mm",
            "\"± -1 mm\"",
        ),
        (physical("[uncertainty]\nclearance = \"± 0.2 kg\""), "`clearance` is a length", "kg"),
        (physical("[uncertainty]\nfrequency = \"± 0,2 Hz\""), "`frequency` has a comma", " 0,2 Hz"),
        (
            physical("[uncertainty]\nrestitution = \"± 5 %\""),
            "`restitution` is \"± 5 %\", which is no number behind its sign",
            "\"± 5 %\"",
        ),
        (physical("[uncertainty]\nrestitution = \"0.05\""), "`restitution` is text", "\"0.05\""),
        (
            plain("[uncertainty]\nclearance = \"± 0.2 mm\""),
            "`clearance` is \"± 0.2 mm\", which is no number behind its sign",
            "\"± 0.2 mm\"",
        ),
        (
            plain("[optimize]\nmass = [\"20 g\", \"50 g\"]"),
            "a reduced case has no mass to choose",
            "mass",
        ),
        (plain("spectrum = [[0.97, -4.0], [1.03, 5.0]]"), "a value of `spectrum` is -4.0", "-4.0"),
        (
            plain("spectrum = [[\"8 Hz\", 4.0], [1.03, 5.0]]"),
            "a value of `spectrum` is text, where a plain number belongs",
            "\"8 Hz\"",
        ),
        (
            plain("[optimize]\nclearance = [\"1 mm\", \"2 mm\"]"),
            "a value of `clearance` is text",
            "\"1 mm\"",
        ),
    ];
    for (text, message, underlined) in wrong {
        let error = Case::parse("a case", &text).expect_err(message);
        let problem = error.problems().next().expect("one problem");
        assert!(problem.message.starts_with(message), "{problem:?}");
        assert_eq!(problem.underlined, underlined, "{problem:?}");
        assert!(problem.help.is_some(), "{problem:?}");
    }
    let still = reduced(0.6, 0.0077, 1.8, 0.0, [0.97, 1.03], "")
        .replace("[band]\nfrom = 0.97\nto = 1.03", "");
    assert!(Task::of(&case(&still), None).is_err());
}

#[test]
fn the_command_writes_a_page_and_a_case() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |more: &[&str]| {
        let mut command = Command::cargo_bin("vinesink").expect("the program");
        command.args(["optimize", "cases/li2016-8p5hz-fig4a.toml"]).args(more);
        command.env("RAYON_NUM_THREADS", if more.len() > 2 { "3" } else { "1" });
        command.output().expect("it runs")
    };
    let out = folder.path().join("out");
    let new = folder.path().join("new.toml");
    let [out_text, new_text] = [&out, &new].map(|path| path.to_str().expect("UTF-8").to_owned());
    let first = run(&["--format", "json", "--out", &out_text, "--write", &new_text]);
    assert_eq!(first.status.code(), Some(0), "{first:?}");
    let second = run(&["--format", "json"]);
    assert_eq!(first.stdout, second.stdout, "the same bytes, whatever the number of threads");
    let document: serde_json::Value = serde_json::from_slice(&first.stdout).expect("JSON");
    assert_eq!(document["format"], "vinesink/optimization@4");
    assert_eq!(document["reached"], true);
    let page = out.join("li2016-8p5hz-fig4a");
    for file in [
        "optimize.md",
        "optimize.html",
        "figures/optimize-landscape.svg",
        "figures/optimize-chart.svg",
    ] {
        assert!(page.join(file).is_file(), "{file}");
    }
    case(&fs::read_to_string(&new).expect("the new case"));
    // An existing file stays, and nothing uncertain has no robust optimum.
    assert_eq!(run(&["--write", &new_text]).status.code(), Some(2));
    let other = folder.path().join("other.toml");
    let robust = run(&["--robust", "--write", other.to_str().expect("UTF-8")]);
    assert_eq!(robust.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&robust.stderr).contains("[uncertainty]"));
}

/// The sentences of the page, each in its line.
fn sentences(text: &str, objective: Option<Objective>) -> Vec<String> {
    let told = summary(&case(text), &optimized(text, objective)).expect("a text");
    told.lines().map(str::to_owned).collect()
}

/// Between two simulated absorbers nothing is known, so no line joins them; an exact objective is a curve.
#[test]
#[ignore = "deep"]
fn the_landscape_draws_points_where_it_scatters() {
    let text = band_without_criteria("[optimize]\nclearance = [\"10 mm\", \"20 mm\"]\n");
    for (objective, scatters) in [(Objective::WorstAmplitude, true), (Objective::Z3Share, false)] {
        let found = optimized(&text, Some(objective));
        let figures = vinesink::report::optimize::figures(&case(&text), &found);
        let landscape = &figures[0].panels[0].layers;
        let curves = landscape.iter().filter(|layer| matches!(layer, Layer::Curve { .. })).count();
        let most = landscape.iter().map(|layer| match layer {
            Layer::Points { points, .. } => points.len(),
            _ => 0,
        });
        assert_eq!(curves, usize::from(!scatters), "{objective:?}");
        assert_eq!(most.max() >= Some(found.landscape.len()), scatters, "{objective:?}");
    }
}

/// 12 kg at 8 Hz with 3 % of mass: at 20 mm 74 % of the band lie in Z3, all of it in strip A2.
#[test]
#[ignore = "deep"]
fn shares_in_strips_and_winners_on_bounds_are_told() {
    let frame = |bounds: &str| {
        format!(
            "title = \"t\"\nsource = \"s\"\n[oscillator]\nmass = \"12 kg\"\nstiffness = \"30.32 kN/m\"\n\
             damping_ratio = 0.005\n[absorber]\nmass_ratio = 0.03\nclearance = \"20 mm\"\nrestitution = 0.6\n\
             [excitation]\nkind = \"base-displacement\"\namplitude = \"0.3 mm\"\nfrequency = \"8 Hz\"\n\
             [band]\nfrom = \"7.8 Hz\"\nto = \"8.4 Hz\"\n[optimize]\nobjective = \"z3-share\"\n{bounds}"
        )
    };
    let has = |sentences: &[String], words: &str| {
        sentences.iter().any(|sentence| sentence.contains(words))
    };
    let told = sentences(&frame("clearance = [\"19.9 mm\", \"20 mm\"]\n"), None);
    let sentence = "Of the band, the optimum has 74.1 % in strip A2 (beats: no steady 1:1 motion).";
    assert!(has(&told, sentence), "{told:?}");
    // The share grows with the clearance.
    let sentence =
        "The optimum lies on a bound: clearance 20.00 mm; wider bounds may hold a better one.";
    assert!(has(&told, sentence), "{told:?}");
    let told =
        sentences(&band_without_criteria("[optimize]\nclearance = [\"5 mm\", \"40 mm\"]\n"), None);
    assert!(!has(&told, "bound"), "{told:?}");
    let strips = strips_of("[optimize]\nclearance = [\"5 mm\", \"40 mm\"]\n");
    assert_eq!(has(&told, "in strip"), strips > 0.01, "{strips} {told:?}");
    // The best clearance, 17.9 mm, is out of bounds.
    let told =
        sentences(&band_without_criteria("[optimize]\nclearance = [\"12 mm\", \"14 mm\"]\n"), None);
    let sentence =
        "The optimum lies on a bound: clearance 14.00 mm; wider bounds may hold a better one.";
    assert!(has(&told, sentence), "{told:?}");
    let more = "clearance = [\"12 mm\", \"14 mm\"]\nmass = [\"30 g\", \"32.01 g\"]\n";
    let text = band_without_criteria(&format!("[optimize]\n{more}"));
    let (told, all) = (sentences(&text, None), optimized(&text, None));
    let found = all.best.choice;
    let page = vinesink::report::optimize::document(&case(&text), &all);
    let mass = found.value(Parameter::AbsorberMass).expect("a physical case");
    for (name, value, ends) in
        [("clearance", found.clearance(), [0.012, 0.014]), ("mass", mass, [0.03, 0.03201])]
    {
        let on_end = ends.iter().any(|end| (value / end - 1.0).abs() < 1e-3);
        let told = told.iter().any(|one| one.contains("on a bound") && one.contains(name));
        assert_eq!(told, on_end, "{name} {value}");
        let rows = page["on_bounds"].as_array().expect("rows");
        assert_eq!(rows.iter().any(|row| row["variable"] == name), on_end, "{rows:?}");
    }
}

/// Share of the shipped band that lies in strips with the best clearance.
fn strips_of(more: &str) -> f64 {
    let found = optimized(&band_text(more), None);
    let band = found.task.band_of(&found.best.choice).expect("a system");
    band.share(&theory::zones(&band), |zone| zone.strip.is_some())
}

/// The command's exit code, standard output and standard error.
fn optimize(path: &str, more: &[&str]) -> (Option<i32>, [String; 2]) {
    let mut command = Command::cargo_bin("vinesink").expect("the program");
    let output = command.args(["optimize", path]).args(more).output().expect("it runs");
    let texts = [&output.stdout, &output.stderr];
    (output.status.code(), texts.map(|bytes| String::from_utf8_lossy(bytes).into_owned()))
}

/// A folder, and the paths in it.
fn room() -> (tempfile::TempDir, impl Fn(&str) -> String) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().to_owned();
    (folder, move |name: &str| path.join(name).to_str().expect("UTF-8").to_owned())
}

#[test]
#[ignore = "deep"]
fn what_is_written_is_told() {
    let (_folder, at) = room();
    let uncertain = at("uncertain.toml");
    let text =
        reduced(0.6, 0.0077, 1.8, 4.3, [0.97, 1.03], "[uncertainty]\nclearance = \"± 0.05\"\n");
    fs::write(&uncertain, &text).expect("written");
    for (name, more) in [("optimum", None), ("robust optimum", Some("--robust"))] {
        let new = at(&format!("{name}.toml"));
        let arguments: Vec<&str> = ["--write", new.as_str()].into_iter().chain(more).collect();
        let (code, [stdout, _]) = optimize(&uncertain, &arguments);
        assert_eq!(code, Some(0));
        let clearance = case(&fs::read_to_string(&new).expect("a case")).design.clearance();
        let line = stdout.lines().last().expect("a line");
        let number = line.strip_prefix(&format!("{new} has the {name}, clearance "));
        let number = number.and_then(|rest| rest.strip_suffix(" units.")?.parse::<f64>().ok());
        assert_eq!(number, Some(clearance), "{line}");
    }
}

#[test]
fn where_nothing_is_reached_there_is_no_optimum() {
    let (_folder, at) = room();
    // No orbit is stable with a clearance as wide as this.
    let hopeless = at("hopeless.toml");
    let text = fs::read_to_string("cases/li2016-8p5hz-fig4a.toml").expect("a case");
    let more = "\n[optimize]\nobjective = \"margin\"\nclearance = [\"2 m\", \"3 m\"]\n";
    fs::write(&hopeless, text + more).expect("written");
    let (new, out) = (at("new.toml"), at("out"));
    let (code, [stdout, _]) = optimize(&hopeless, &["--write", &new, "--out", &out]);
    assert_eq!(code, Some(1), "{stdout}");
    assert!(!Path::new(&new).exists());
    assert!(stdout.contains("new.toml is not written: nothing between the bounds"), "{stdout}");
    assert!(!stdout.contains("optimum "), "{stdout}");
    let page = fs::read_to_string(format!("{out}/hopeless/optimize.md")).expect("the page");
    assert!(!page.contains("| optimum") && !page.contains("## Sensitivity"), "{page}");
    assert!(page.contains("## Is the 1:1 motion best where it disappears?"), "{page}");
    let landscape = format!("{out}/hopeless/figures/optimize-landscape.svg");
    let drawing = fs::read_to_string(landscape).expect("a figure");
    assert!(!drawing.contains("optimum"), "a dot for what does not exist");
    let (code, [stdout, stderr]) = optimize(&hopeless, &["--write", &new, "--format", "json"]);
    let document: serde_json::Value = serde_json::from_str(&stdout).expect("JSON");
    assert_eq!((code, &document["optimum"]), (Some(1), &serde_json::Value::Null));
    assert!(stderr.contains("is not written"), "{stderr}");
}

/// Ended in the middle it leaves nothing behind. By SIGTERM: a shell that starts the tests in the background
/// has them ignore SIGINT.
#[cfg(unix)]
#[test]
fn an_interrupted_command_leaves_nothing_half_written() {
    use std::os::unix::process::ExitStatusExt as _;
    use std::time::Duration;

    const SIGTERM: i32 = 15;
    let folder = tempfile::tempdir().expect("a folder");
    let (out, new) = (folder.path().join("out"), folder.path().join("new.toml"));
    let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin("vinesink"));
    // The margin along a band takes seconds.
    command.args(["optimize", "cases/li2016-band.toml", "--objective", "margin", "--out"]);
    let mut running = command.arg(&out).arg("--write").arg(&new).spawn().expect("it runs");
    std::thread::sleep(Duration::from_millis(400));
    assert!(running.try_wait().expect("a status").is_none(), "it has ended before");
    let kill =
        std::process::Command::new("kill").args(["-TERM", &running.id().to_string()]).status();
    assert!(kill.expect("kill runs").success());
    let status = running.wait().expect("a status");
    assert_eq!((status.code(), status.signal()), (None, Some(SIGTERM)));
    let left = fs::read_dir(folder.path()).expect("the folder").count();
    assert_eq!(left, 0, "files after an interrupt");
}

/// A board that is released with a velocity: a structure that swings alone moves by `v/omega0 exp(-zeta pi/2)` to one side, and
/// by `exp(-zeta 3 pi/2)` of it to the other. Where both together are less than the cavity is long, an absorber in its middle
/// is not reached.
#[test]
fn an_optimum_says_that_it_lies_at_an_edge() {
    let text = "title = \"Board\"\nsource = \"s\"\n[oscillator]\nmass = \"0.1 kg\" # 0.1 kg on the scale\n\
                frequency = \"200 Hz\"\ndamping_ratio = \"0.8 %\"\n[absorber]\nmass = \"2 g\"\n\
                clearance = \"0.1 mm\" # a tenth of the 1 mm that there is\n  # and no more\n\
                restitution = 0.75 # measured\n[excitation]\nkind = \"free\"\nvelocity = \"300 mm/s\"\n";
    let folder = tempfile::tempdir().expect("a folder");
    let optimize = |name: &str, text: &str, more: &[&str]| {
        let path = folder.path().join(name);
        fs::write(&path, text).expect("written");
        let mut command = Command::cargo_bin("vinesink").expect("the program");
        let output = command.arg("optimize").arg(&path).args(more).output().expect("it runs");
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        String::from_utf8(output.stdout).expect("UTF-8")
    };
    let document = |text: &str| -> serde_json::Value { serde_json::from_str(text).expect("JSON") };
    let better = folder.path().join("better.toml");
    let write = better.to_str().expect("UTF-8");
    let found = document(&optimize("board.toml", text, &["--format", "json", "--write", write]));
    let clearance = found["optimum"]["clearance"].as_f64().expect("a number");
    let (zeta, omega) = (0.008_f64, std::f64::consts::TAU * 200.0);
    let turn = |quarters: f64| libm::exp(-zeta * quarters * std::f64::consts::FRAC_PI_2);
    let swing = |velocity: f64| velocity / omega * (turn(1.0) + turn(3.0));
    assert!(swing(0.3) > 2.0 * clearance && swing(0.3 / 1.02) < 2.0 * clearance, "{clearance}");
    // Then the structure comes down to a tenth as without it.
    let alone = libm::log(10.0) / (zeta * omega);
    for (parameter, at) in [("amplitude", 0.3 / 1.02), ("clearance", clearance * 1.02)] {
        let edges = found["edges"].as_array().expect("edges");
        let is_there = |one: &&serde_json::Value| {
            one["parameter"] == parameter && one["at"]["value"].as_f64() == Some(at)
        };
        let edge = edges.iter().find(is_there).unwrap_or_else(|| panic!("{parameter}: {edges:?}"));
        let [lost, instead] =
            ["found", "instead"].map(|key| edge[key]["value"].as_f64().expect("a number"));
        assert!((lost / alone - 1.0).abs() < 1e-3, "{lost} {alone}");
        assert_eq!(Some(instead), found["checked"]["value"].as_f64());
    }
    let told = optimize("board.toml", text, &[]);
    assert!(told.contains("\nAt an edge: instead of "), "{told}");
    // Further inside nothing is lost.
    let inside = format!("{text}[optimize]\nclearance = [\"0.1 mm\", \"0.12 mm\"]\n");
    let safe = document(&optimize("inside.toml", &inside, &["--format", "json"]));
    assert_eq!(safe["edges"], serde_json::json!([]));
    // What stood behind the number that changed no longer fits; all else does.
    let written = fs::read_to_string(&better).expect("written");
    let value = format!("clearance = \"{} mm\"\nrestitution = 0.75 # measured\n", 1e3 * clearance);
    assert!(written.contains(&value), "{value}{written}");
    assert!(written.contains("mass = \"0.1 kg\" # 0.1 kg on the scale\n"), "{written}");
}
