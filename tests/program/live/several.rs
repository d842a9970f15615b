//! The live page with structures of several modes or absorbers.

use std::f64::consts::TAU;
use std::fs;

use assert_cmd::Command;
use serde_json::{Value, json};
use vinesink::case::ModalCase;
use vinesink::executor::Serial;
use vinesink::modal::ModalAnswer;
use vinesink::report::html::unbroken;
use vinesink::report::modal::at_frequency;
use vinesink::simulation::{ModalObserver, ModalSegment, ModalSimulation};
use vinesink::system::{ModalState, ModalSystem};

use super::{LIVE, choose, file, opened, paste, settle, slide, text};
use crate::browser::browser;
use crate::browser_support::checks::{self, DESKTOP};
use crate::browser_support::chromium::{Browser, Page};

/// The page with a mast of three modes.
fn with_a_mast<'a>(browser: &'a mut Browser) -> Page<'a> {
    let mut page = opened(browser, &file(), DESKTOP);
    choose(&mut page, "ball on a mast");
    page
}

fn shipped(name: &str) -> String {
    fs::read_to_string(format!("cases/several/{name}.toml")).expect("a shipped case")
}

fn asked(page: &mut Page, request: &Value) -> Value {
    page.evaluate(&format!("{LIVE}.ask({request})"))
}

/// The case under one load at one frequency.
fn at(text: &str, load: usize, frequency: f64, amplitude: f64) -> ModalCase {
    let mut case = ModalCase::parse("case.toml", text).expect("a case");
    let mut one = case.loads[load];
    (one.amplitude, one.range_hz) = (amplitude, [frequency; 2]);
    case.loads = vec![one];
    case
}

/// Sentence and motions are those of the program.
#[test]
#[ignore = "deep"]
fn the_page_says_what_the_program_says() {
    let mut browser = browser();
    let mut page = with_a_mast(&mut browser);
    for (name, load, frequency, amplitude) in
        [("mast", 1, 6.9, 14.07), ("floor", 0, 5.1, 800.0), ("graded", 0, 2.0, 30.0)]
    {
        let text = shipped(name);
        let place = json!({ "load": load, "frequency": frequency, "amplitude": amplitude });
        let found = asked(&mut page, &json!({ "ask": "study", "text": text, "at": place }));
        let case = at(&text, load, frequency, amplitude);
        let answer = ModalAnswer::of(&case, &Serial).expect("an answer");
        answer.observe(&Serial);
        let told = at_frequency(&case, &answer).expect("words");
        assert_eq!(found["tone"], told["tone"], "{name}");
        let markdown = unbroken(told["markdown"].as_str().expect("text"));
        assert_eq!(found["markdown"], markdown, "{name}");
    }
    // What the page shows is what it was told.
    let shown = page.evaluate("document.querySelector('.live-headline').textContent");
    assert!(shown.as_str().is_some_and(|text| text.starts_with("Vibration up to")), "{shown}");
}

/// A slider changes the text of the case, what is said of it, and what runs; a load has its own sliders.
#[test]
#[ignore = "deep"]
fn sliders_move_everything() {
    let mut browser = browser();
    let mut page = with_a_mast(&mut browser);
    let said = "document.querySelector('.live-headline').textContent";
    let before = page.evaluate(said);
    let periods = page.evaluate(&format!("{LIVE}.running().clock"));
    slide(&mut page, "clearance_1", 800);
    settle(&mut page);
    let text = text(&mut page);
    let case = ModalCase::parse("case.toml", &text).expect("a case");
    // 2.7 mm, a factor of eight to either side.
    let wanted = 2.7e-3 / 8.0 * libm::pow(64.0, 0.8);
    assert!((case.absorbers[0].clearance_m / wanted - 1.0).abs() < 1e-3, "{text}");
    assert_ne!(page.evaluate(said), before);
    let later = page.evaluate(&format!("{LIVE}.running().clock"));
    assert!(later.as_f64() >= periods.as_f64(), "{periods} {later}");
    // The figure over the range belongs to the new case too.
    let figure = page.evaluate("document.querySelectorAll('.live-figures figure svg').length");
    assert_eq!(figure, 1);
    page.evaluate(
        "(() => { const of = document.querySelectorAll('.live-bar select')[1]; of.value = '2'; of.dispatchEvent(new Event('change')); })()",
    );
    settle(&mut page);
    let place = page.evaluate(&format!("{LIVE}.at"));
    assert_eq!(
        [&place["load"], &place["frequency"], &place["amplitude"]],
        [&json!(2), &json!(19.31), &json!(110.3)]
    );
    // What is wrong with a case file is said with its line, and the case of before stays.
    let wrong = text.replacen("restitution = 0.3", "restitution = 1.3", 1);
    paste(&mut page, &wrong);
    let problem = page.evaluate("document.querySelector('.live-problem').textContent");
    assert!(
        problem.as_str().is_some_and(|text| text.contains("Line ") && text.contains("from 0 to 1")),
        "{problem}"
    );
}

/// One page shows both kinds: controls and figures are those of the case, going back goes back over both, and a link holds the excitation
/// of the sliders too.
#[test]
#[ignore = "deep"]
fn a_case_of_the_other_kind_takes_its_place() {
    let mut browser = browser();
    let mut page = opened(&mut browser, &file(), DESKTOP);
    let shown = |page: &mut Page| {
        let shown = page.evaluate(
            "[...document.querySelectorAll('.live-slider input[type=range], [data-live] figure[data-name], .live-bar > button, .live-bar select, .live-detail')]
                .filter((one) => one.checkVisibility()).map((one) => one.id || one.dataset.name || one.textContent)",
        );
        let shown: Vec<String> = serde_json::from_value(shown).expect("names");
        shown
    };
    let of_one = shown(&mut page);
    let begin = text(&mut page);
    let has = |shown: &[String], name: &str| shown.iter().any(|one| one.contains(name));
    for name in ["live-clearance", "map", "amplitude", "Best clearance", "theory"] {
        assert!(has(&of_one, name), "{name}: {of_one:?}");
    }
    paste(&mut page, &shipped("floor"));
    settle(&mut page);
    let of_several = shown(&mut page);
    for name in ["live-frequency", "live-amplitude", "live-clearance_2", "loads"] {
        assert!(has(&of_several, name), "{name}: {of_several:?}");
    }
    for name in ["map", "Best clearance", "theory"] {
        assert!(!has(&of_several, name), "{name}: {of_several:?}");
    }
    slide(&mut page, "frequency", 250);
    settle(&mut page);
    let [at, link] = ["at", "link()"].map(|of| page.evaluate(&format!("{LIVE}.{of}")));
    assert!((at["frequency"].as_f64().expect("a frequency") - 5.0).abs() < 1e-9, "{at}");
    assert_eq!(text(&mut page), shipped("floor"), "the frequency is not of the case");
    let undo = |page: &mut Page| {
        page.evaluate(
            "[...document.querySelectorAll('button')].find((one) => one.title === 'Undo').click()",
        );
        settle(page);
    };
    undo(&mut page);
    assert_eq!(page.evaluate(&format!("{LIVE}.at.frequency")), json!(5.2));
    undo(&mut page);
    assert_eq!((text(&mut page), shown(&mut page)), (begin, of_one));
    drop(page);
    let address = link.as_str().expect("a link").to_owned();
    let mut page = browser.page(DESKTOP);
    page.open_address(&address);
    settle(&mut page);
    assert_eq!(page.evaluate(&format!("{LIVE}.at")), at);
    assert_eq!(text(&mut page), shipped("floor"));
}

/// Displacement and gap of the first absorber once a period.
struct Once<'a> {
    system: &'a ModalSystem,
    seen: Vec<[f64; 2]>,
}

impl ModalObserver for Once<'_> {
    fn segment(&mut self, _: &ModalSegment<'_>) {}

    fn period(&mut self, _: u64, state: &ModalState) {
        let modes = self.system.modes().iter().zip(&state.modes);
        let x: f64 = modes.map(|(mode, [q, _])| mode.shape[0] * q).sum();
        let absorber = &self.system.absorbers()[0];
        self.seen.push([x, (x - state.absorbers[0][0]) / absorber.clearance]);
    }
}

/// The simulation that runs is the program's: the same flights, as long as rounding allows.
#[test]
#[ignore = "deep"]
fn the_running_simulation_is_the_programs() {
    let mut browser = browser();
    let mut page = with_a_mast(&mut browser);
    let text = shipped("floor");
    let request = json!({ "ask": "run", "text": text, "from": "rest", "at": { "load": 0, "frequency": 5.1, "amplitude": 883.0 } });
    let script = format!(
        "(() => {{ const engine = {LIVE}.engine(); engine.ask({request}); return [...engine.goOn(12, 1, 5).points]; }})()"
    );
    let found: Vec<f64> = serde_json::from_value(page.evaluate(&script)).expect("numbers");
    let case = at(&text, 0, 5.1, 883.0);
    let system = case.system(&case.loads[0], 5.1).expect("a system");
    let mut simulation = ModalSimulation::new(&system, &ModalState::AT_REST, 0.0).expect("a start");
    let mut once = Once { system: &system, seen: Vec::new() };
    simulation.run(12, u64::MAX, &mut once);
    assert_eq!(found.len(), 5 * 12, "{found:?}");
    // The page's first point is the start.
    for (point, [x, gap]) in found.chunks(5).skip(1).zip(&once.seen) {
        let scale = case.absorbers[0].clearance_m;
        assert!((point[1] - x).abs() < 1e-7 * scale, "{point:?} {x}");
        assert!((point[2] - gap).abs() < 1e-7, "{point:?} {gap}");
    }
    assert!(simulation.impacts() > 0 && (simulation.phase() / TAU).fract() < 1e-9);
}

/// A report with the page is still one file and begins with its own case; modes in a file are refused.
#[test]
#[ignore = "deep"]
fn a_report_holds_the_page() {
    let (file, mut browser) = (file(), browser());
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path().canonicalize().expect("a path");
    let run = |case: &str| {
        let mut report = Command::cargo_bin("vinesink").expect("built");
        report.args(["report", case, "--out"]).arg(&folder);
        report.arg(format!("--live={}", file.display())).output().expect("it runs")
    };
    let output = run("cases/several/graded.toml");
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let mut page = browser.page(DESKTOP);
    page.open(&folder.join("graded/report.html"));
    page.evaluate("document.querySelector('#live').scrollIntoView({ behavior: 'instant' })");
    settle(&mut page);
    assert_eq!(text(&mut page), shipped("graded"));
    let noise = checks::noise(&mut page, &folder);
    assert!(noise.is_empty(), "{noise:#?}");
    let refused = run("cases/several/mast-two.toml");
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(said.contains("cannot read the file of the modes"), "{said}");
    assert!(!folder.join("mast-two").exists(), "nothing is half written");
}
