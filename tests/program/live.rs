//! The live page in Chromium: `web/build` makes it, into `target/web/live.html` (or a file named in `VINESINK_LIVE`).
//! Where page or browser are missing the tests fail: `.ci/deep browser` makes both and runs them.

mod several;

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use serde_json::{Value, json};
use vinesink::case::Case;
use vinesink::case_optimum::Optimum;
use vinesink::executor::Serial;
use vinesink::simulation::{Simulation, Trace};
use vinesink::system::State;

use crate::browser::browser;
use crate::browser_support::checks::{self, DESKTOP, PHONE};
use crate::browser_support::chromium::{Browser, Page, View};

/// Shipped cases that the page begins with: those of the paper, without a band or criteria.
const PRESETS: [&str; 5] = [
    "li2016-8p5hz-fig4a",
    "li2016-8p5hz-fig4b",
    "li2016-8p5hz-fig4c",
    "li2016-8p5hz-fig4d",
    "li2016-8p5hz-fig4e",
];

const LIVE: &str = "document.querySelector('[data-live]').live";

fn file() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let given = env::var_os("VINESINK_LIVE").map(PathBuf::from);
    let file = given.unwrap_or_else(|| root.join("target/web/live.html"));
    assert!(file.is_file(), "there is no live page: run web/build");
    file
}

/// The page in a browser, with everything on it computed.
fn opened<'a>(browser: &'a mut Browser, file: &Path, view: View) -> Page<'a> {
    let mut page = browser.page(view);
    page.open(file);
    settle(&mut page);
    page
}

fn settle(page: &mut Page) {
    let ready = format!(
        "(async () => {{
            while (!{LIVE} || !document.querySelector('[data-live] figure svg'))
                await new Promise((done) => setTimeout(done, 5));
            await {LIVE}.settled();
        }})()"
    );
    page.evaluate(&ready);
}

/// Chooses the case to begin with that has these words in its name.
fn choose(page: &mut Page, words: &str) {
    page.evaluate(&format!(
        "(() => {{
            const choose = document.querySelector('.live-bar select');
            const of = [...choose.options].find((one) => one.textContent.includes('{words}'));
            choose.value = of.value;
            choose.dispatchEvent(new Event('change'));
        }})()"
    ));
    settle(page);
}

/// Chooses the paper's case with two symmetric impacts per period.
fn choose_the_paper(page: &mut Page) {
    choose(page, "two symmetric");
}

/// Pastes a case file.
fn paste(page: &mut Page, text: &str) {
    page.evaluate(&format!(
        "(() => {{
            document.querySelector('.live-file').open = true;
            document.querySelector('.live-file textarea').value = {};
            document.querySelector('.live-file button').click();
        }})()",
        json!(text)
    ));
}

/// Sets a slider as a person would leave it, with events.
fn slide(page: &mut Page, key: &str, position: u32) {
    page.evaluate(&format!(
        "(() => {{
            const slider = document.querySelector('#live-{key}');
            slider.value = {position};
            slider.dispatchEvent(new Event('input'));
            slider.dispatchEvent(new Event('change'));
        }})()"
    ));
}

fn text(page: &mut Page) -> String {
    page.evaluate(&format!("{LIVE}.text")).as_str().expect("a text").to_owned()
}

fn study(page: &mut Page, text: &str) -> Value {
    let request = json!({ "ask": "study", "text": text });
    page.evaluate(&format!("{LIVE}.ask({request})"))
}

fn shipped(name: &str) -> String {
    let file = format!("{}/cases/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    fs::read_to_string(file).expect("a case")
}

/// The program's report of a case.
struct Native {
    folder: tempfile::TempDir,
    document: Value,
}

impl Native {
    fn of(text: &str) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let case = folder.path().join("live.toml");
        fs::write(&case, text).expect("writable");
        let mut report = Command::cargo_bin("vinesink").expect("built");
        report.arg("report").arg(&case).args(["--criteria-only", "--out"]).arg(folder.path());
        report.assert().success();
        let native = Self { folder, document: Value::Null };
        let document = serde_json::from_str(&native.read("report.json")).expect("JSON");
        Self { document, ..native }
    }

    fn read(&self, file: &str) -> String {
        fs::read_to_string(self.folder.path().join("live").join(file)).expect("a report")
    }
}

/// Where two documents differ; a number by its bits, whether it is written as 1 or 1.0.
fn differences(page: &Value, native: &Value, at: &str, found: &mut Vec<String>) {
    match (page, native) {
        (Value::Object(a), Value::Object(b)) => {
            let keys = a.keys().chain(b.keys().filter(|key| !a.contains_key(*key)));
            for key in keys {
                let one = |of: &serde_json::Map<String, Value>| {
                    of.get(key).cloned().unwrap_or("missing".into())
                };
                differences(&one(a), &one(b), &format!("{at}/{key}"), found);
            }
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            for (k, (one, other)) in a.iter().zip(b).enumerate() {
                differences(one, other, &format!("{at}/{k}"), found);
            }
        }
        (Value::Number(a), Value::Number(b)) if a.as_f64() == b.as_f64() => {}
        (a, b) if a == b => {}
        (a, b) => found.push(format!("{at}: {a} in the page, {b} in the program")),
    }
}

/// The document of the page against `report.json`; the page has a name of its own, no criteria, and leaves out what
/// would spoil the design.
fn confront(page: &Value, native: &Value, what: &str) {
    let (mut page, mut native) = (page.clone(), native.clone());
    for document in [&mut page, &mut native] {
        for key in ["name", "deviations"] {
            document.as_object_mut().expect("a document").remove(key);
        }
    }
    let mut found = Vec::new();
    differences(&page, &native, what, &mut found);
    assert!(found.is_empty(), "{found:#?}");
}

/// Every number, sentence and drawing of the page is that of the program, to the last bit: the libraries of
/// mathematical functions are the same on both.
#[test]
#[ignore = "deep"]
fn the_page_says_what_the_program_says() {
    let (file, mut browser) = (file(), browser());
    let mut page = opened(&mut browser, &file, DESKTOP);
    for name in PRESETS {
        // Figures that a case asks for are left to the program.
        let text = shipped(name).split("\n[report]\n").next().unwrap_or_default().to_owned();
        let native = Native::of(&text);
        let answer = study(&mut page, &text);
        confront(&answer["document"], &native.document, name);
        let figures = answer["figures"].as_array().expect("figures");
        assert!(figures.len() >= 5, "{name}: {} figures", figures.len());
        for figure in figures {
            let file = format!("figures/{}.svg", figure["name"].as_str().expect("a name"));
            assert!(figure["svg"] == native.read(&file), "{name}: {file} is another drawing");
        }
    }
}

/// After some sliders were moved the case is another one, and the program says the same of it.
#[test]
#[ignore = "deep"]
fn sliders_move_everything() {
    let (file, mut browser) = (file(), browser());
    let mut page = opened(&mut browser, &file, DESKTOP);
    choose_the_paper(&mut page);
    let before = text(&mut page);
    let drawing = |page: &mut Page, name: &str| {
        page.evaluate(&format!("document.querySelector('[data-name={name}] svg').outerHTML"))
    };
    let drawn = ["map", "sim", "ranges"].map(|name| drawing(&mut page, name));
    for (key, position) in [("clearance", 430), ("restitution", 550), ("mass_ratio", 610)] {
        slide(&mut page, key, position);
    }
    for (key, position) in [("damping_ratio", 450), ("frequency", 520), ("amplitude", 530)] {
        slide(&mut page, key, position);
    }
    // The manifold follows in the same frame; what takes longer looks old until it comes.
    let busy = "new Promise((done) => requestAnimationFrame(() => setTimeout(() => done(
        [...document.querySelectorAll('[aria-busy=true]')].map((one) => one.dataset.name ?? one.className)))))";
    let busy = page.evaluate(busy).to_string();
    assert!(busy.contains("live-verdict") && busy.contains("ranges"), "{busy}");
    assert!(!busy.contains("\"sim\""), "{busy}");
    assert_ne!(drawing(&mut page, "sim"), drawn[1]);
    settle(&mut page);
    let after = text(&mut page);
    let changed = before.lines().zip(after.lines()).filter(|(a, b)| a != b).count();
    assert_eq!(changed, 6, "{after}");
    assert_eq!(
        Case::parse("live.toml", &after).expect("valid").title,
        "Li 2016, 8.5 Hz, regime of Fig. 4c, b = 20 mm"
    );
    for (name, before) in ["map", "sim", "ranges"].iter().zip(drawn) {
        assert_ne!(drawing(&mut page, name), before, "{name}");
    }
    let native = Native::of(&after).document;
    confront(&study(&mut page, &after)["document"], &native, "moved");
    // What stands on the page is that study.
    let verdict = page.evaluate("document.querySelector('.live-headline').textContent");
    let peak = native["motions"][0]["peak"]["value"].as_f64().expect("a peak") * 1e3;
    assert!(
        verdict.as_str().expect("words").contains(&format!("{peak:.2}")),
        "{peak} mm: {verdict}"
    );
}

#[test]
#[ignore = "deep"]
fn the_mark_is_dragged_over_the_map_and_taken_back() {
    let (file, mut browser) = (file(), browser());
    let mut page = opened(&mut browser, &file, DESKTOP);
    choose_the_paper(&mut page);
    let begin = text(&mut page);
    let place = |page: &mut Page| -> [f64; 2] {
        let at = page.evaluate(
            "(() => { const at = document.querySelector('.live-mark').getBoundingClientRect();
                return [at.left + at.width / 2, at.top + at.height / 2]; })()",
        );
        [0, 1].map(|k| at[k].as_f64().expect("a place"))
    };
    page.evaluate("document.querySelector('.live-mark').scrollIntoView({ block: 'center', behavior: 'instant' })");
    let from = place(&mut page);
    // Where the map has the case, on linear axes.
    let request = json!({ "ask": "map", "text": begin, "plain": true });
    let map = page.evaluate(&format!("{LIVE}.engine().ask({request})"))["panel"].clone();
    let sheet = page.evaluate(
        "(() => { const at = document.querySelector('.live-sheet svg').getBoundingClientRect();
            return [at.left, at.top, at.width, at.height]; })()",
    );
    let number = |value: &Value| value.as_f64().expect("a number");
    let expected = [0, 1].map(|k| {
        let [first, last] = [0, 1].map(|end| number(&map["axes"][k][end]));
        let share = (number(&map["at"][k]) - first) / (last - first);
        // Rooms are left, top, right, bottom; the second axis goes up.
        let [low, high] = [[0, 2], [3, 1]][k].map(|side| number(&map["room"][side]));
        number(&sheet[k]) + (low + share * (high - low)) * number(&sheet[k + 2])
    });
    assert!((0..2).all(|k| (from[k] - expected[k]).abs() < 1.0), "{from:?} {expected:?}");
    let to = [from[0] - 60.0, from[1] + 40.0];
    page.drag(from, to, 12);
    settle(&mut page);
    let dragged = text(&mut page);
    let case = |text: &str| Case::parse("live.toml", text).expect("valid");
    let [first, last] = [case(&begin), case(&dragged)];
    let frequency = |case: &Case| case.system().frequency_ratio();
    assert!(
        frequency(&last) < frequency(&first) && last.units().clearance < first.units().clearance,
        "{dragged}"
    );
    // The mark is where the pointer left it, as near as four digits of the case file tell.
    let there = place(&mut page);
    assert!((0..2).all(|k| (there[k] - to[k]).abs() < 2.0), "{there:?} {to:?}");
    // The arrow keys do the same.
    page.evaluate("document.querySelector('.live-mark').focus()");
    page.press("ArrowUp", 38, "");
    settle(&mut page);
    let pushed = text(&mut page);
    assert!(case(&pushed).units().clearance > last.units().clearance);
    let caption = "document.querySelector('[data-name=map] figcaption').textContent";
    let written = format!("{:.1} mm", 1e3 * case(&pushed).units().clearance);
    assert!(page.evaluate(caption).as_str().expect("words").contains(&written), "{written}");
    // The map was drawn anew and the mark still has the focus; presses in quick succession would be one step back.
    page.evaluate("new Promise((done) => setTimeout(done, 800))");
    page.press("ArrowUp", 38, "");
    settle(&mut page);
    assert!(case(&text(&mut page)).units().clearance > case(&pushed).units().clearance);
    // One step back for a movement, however many events it had.
    let press = |page: &mut Page, words: &str| {
        page.evaluate(&format!("[...document.querySelectorAll('button')].find((one) => one.title === '{words}').click()"));
        settle(page);
        text(page)
    };
    assert_eq!(press(&mut page, "Undo"), pushed);
    assert_eq!(press(&mut page, "Undo"), dragged);
    assert_eq!(press(&mut page, "Undo"), begin);
    assert_eq!(press(&mut page, "Redo"), dragged);
}

#[test]
#[ignore = "deep"]
fn a_link_holds_the_case_and_a_case_file_is_pasted() {
    let (file, mut browser) = (file(), browser());
    let mut page = opened(&mut browser, &file, DESKTOP);
    let other = shipped("force-on-mass");
    paste(&mut page, &other);
    settle(&mut page);
    assert_eq!(text(&mut page), other);
    let title = page.evaluate("document.querySelector('.live-sliders h3').textContent");
    assert_eq!(title, Case::parse("other.toml", &other).expect("valid").title);
    // What is wrong is said with its line, and the case on the page stays.
    paste(&mut page, &other.replacen("restitution = ", "restitution = 1", 1));
    let problem = page.evaluate("document.querySelector('.live-problem').textContent");
    let line = 1 + other.lines().position(|line| line.starts_with("restitution")).expect("a line");
    let problem = problem.as_str().expect("words").to_owned();
    assert!(
        problem.starts_with(&format!("Line {line}: ")) && problem.contains("expected"),
        "{problem}"
    );
    assert_eq!(text(&mut page), other);
    paste(&mut page, &shipped("sweep-fast"));
    let problem = page.evaluate("document.querySelector('.live-problem').textContent");
    assert!(problem.as_str().expect("words").contains("steady vibration"), "{problem}");
    // No verdict stands beside a case that was refused.
    let verdict = page.evaluate("document.querySelector('.live-verdict').textContent");
    assert!(verdict.as_str().expect("words").contains("was refused"), "{verdict}");
    // A field that makes no sense changes nothing.
    for nonsense in ["", "-1", "1e9"] {
        page.evaluate(&format!(
            "(() => {{
                const field = document.querySelector('.live-field input');
                field.value = '{nonsense}';
                field.dispatchEvent(new Event('change'));
            }})()"
        ));
        let problem = page.evaluate("document.querySelector('.live-problem').textContent");
        assert!(problem.as_str().expect("words").contains("goes from"), "{nonsense}: {problem}");
        let field = page.evaluate("document.querySelector('.live-field input').value");
        assert_ne!(field, nonsense);
    }
    settle(&mut page);
    assert_eq!(text(&mut page), other);
    let link = page.evaluate(&format!("{LIVE}.link()"));
    // A reload finds the same.
    page.evaluate("new Promise((done) => setTimeout(done, 100))");
    assert_eq!(page.evaluate("location.href"), link);
    let code = link.as_str().and_then(|link| link.split_once('#')).expect("a link").1.to_owned();
    // A link that is pasted into the open page, and the way back.
    choose_the_paper(&mut page);
    assert_ne!(text(&mut page), other);
    page.evaluate(&format!("location.hash = {}", json!(code)));
    let arrived = format!(
        "(async () => {{ while ({LIVE}.text !== {}) await new Promise((done) => setTimeout(done, 10)); }})()",
        json!(other)
    );
    page.evaluate(&arrived);
    drop(page);
    let linked = PathBuf::from(format!("{}#{code}", file.display()));
    let mut page = opened(&mut browser, &linked, PHONE);
    assert_eq!(text(&mut page), other);
    drop(page);
    let mut page =
        opened(&mut browser, &PathBuf::from(format!("{}#case=!!", file.display())), PHONE);
    let problem = page.evaluate("document.querySelector('.live-problem').textContent");
    assert!(problem.as_str().expect("words").contains("damaged"), "{problem}");
}

/// The button chooses what `vinesink optimize --write` writes.
#[test]
#[ignore = "deep"]
fn the_best_clearance_is_the_programs() {
    let (file, mut browser) = (file(), browser());
    let mut page = opened(&mut browser, &file, DESKTOP);
    let begin = text(&mut page);
    let case = Case::parse("case.toml", &begin).expect("valid");
    let best = Optimum::of("case.toml", &case, &begin, None, &Serial).expect("found");
    let best = best.better.expect("a better one").text;
    page.evaluate("[...document.querySelectorAll('button')].find((one) => one.textContent === 'Best clearance').click()");
    page.evaluate(&format!(
        "(async () => {{ while ({LIVE}.text === {}) await new Promise((done) => setTimeout(done, 20)); }})()",
        json!(begin)
    ));
    assert_eq!(text(&mut page), best);
}

/// What takes long can be stopped, and the case is as it was.
#[test]
#[ignore = "deep"]
fn the_search_can_be_stopped() {
    let (file, mut browser) = (file(), browser());
    let mut page = opened(&mut browser, &file, DESKTOP);
    let begin = text(&mut page);
    let stopped = "(async () => {
        const best = [...document.querySelectorAll('button')].find((one) => one.textContent === 'Best clearance');
        best.click();
        const looks = best.textContent;
        best.click();
        await new Promise((done) => setTimeout(done, 50));
        return [looks, best.textContent, document.querySelector('.live-advice').textContent];
    })()";
    assert_eq!(
        page.evaluate(stopped),
        json!(["Stop looking (0 s)", "Best clearance", "Stopped: the clearance is as it was."])
    );
    assert_eq!(text(&mut page), begin);
}

/// The first figures name what the ball does; who asks for the theory's limits gets them.
#[test]
#[ignore = "deep"]
fn the_first_figures_need_no_theory() {
    let (file, mut browser) = (file(), browser());
    let mut page = opened(&mut browser, &file, DESKTOP);
    let theirs = ["Z3", "Hopf", "saddle-node", "1:1", "exact"];
    for detailed in [false, true] {
        for name in ["map", "amplitude"] {
            let words = format!(
                "[...document.querySelectorAll('[data-name={name}] svg text, [data-name={name}] figcaption')].map((one) => one.textContent).join('; ')"
            );
            let said = page.evaluate(&words).to_string();
            let theory = theirs.iter().any(|one| said.contains(one));
            assert_eq!(theory, detailed, "{name}: {said}");
            assert_eq!(said.contains("two symmetric impacts"), !detailed, "{name}: {said}");
        }
        page.evaluate("document.querySelector('.live-detail input').click()");
        settle(&mut page);
    }
}

/// A frame of the book is as high as what it shows: nothing in it scrolls, and no room is left.
#[test]
#[ignore = "deep"]
fn a_frame_is_as_high_as_its_content() {
    let (file, mut browser) = (file(), browser());
    let folder = tempfile::tempdir().expect("a folder");
    let script = fs::read_to_string("docs/book.js").expect("the book's script");
    let address = format!("file://{}?show=sim&sliders=restitution", file.display());
    let book = folder.path().join("page.html");
    let frame =
        format!("<iframe class=live src='{address}' style='width:{}px;border:0'>", DESKTOP.width);
    let html =
        format!("<!DOCTYPE html><body style='margin:0'><script>{script}</script>{frame}</iframe>");
    fs::write(&book, html).expect("written");
    let mut page = browser.page(DESKTOP);
    page.open(&book);
    let height = "(async () => {
        const frame = document.querySelector('iframe');
        for (let left = 400; left > 0 && !frame.style.height; left -= 1)
            await new Promise((done) => setTimeout(done, 50));
        // Until it stays.
        for (let before = ''; before !== frame.style.height; await new Promise((done) => setTimeout(done, 1500)))
            before = frame.style.height;
        return parseFloat(frame.style.height);
    })()";
    let told = page.evaluate(height).as_f64().expect("a height");
    drop(page);
    let mut alone = browser.page(DESKTOP);
    alone.open_address(&address);
    settle(&mut alone);
    let needed = alone.evaluate("document.querySelector('main').getBoundingClientRect().height");
    let needed = needed.as_f64().expect("a height");
    assert!(needed > 300.0 && (told - needed).abs() < 20.0, "{told} px for {needed} px");
}

/// A frame of the book begins with the case that its page is about.
#[test]
#[ignore = "deep"]
fn a_frame_begins_with_its_case() {
    let (file, mut browser) = (file(), browser());
    let mut page = browser.page(DESKTOP);
    let asks = "show=map&sliders=restitution&begin=two%20symmetric";
    page.open_address(&format!("file://{}?{asks}", file.display()));
    settle(&mut page);
    assert_eq!(text(&mut page), shipped("li2016-8p5hz-fig4c"));
}

/// The criteria, over the band: what `vinesink check` says.
#[test]
#[ignore = "deep"]
fn criteria_are_judged_as_check_judges_them() {
    let (file, mut browser) = (file(), browser());
    let mut page = opened(&mut browser, &file, DESKTOP);
    choose(&mut page, "machine foot");
    let folder = tempfile::tempdir().expect("a folder");
    for slides in [None, Some(700)] {
        if let Some(position) = slides {
            slide(&mut page, "clearance", position);
            settle(&mut page);
        }
        let shown = page.evaluate(
            "[...document.querySelectorAll('.live-decision :is(tr, p)')].map((one) =>
                one.cells ? [...one.cells].map((cell) => cell.textContent).join(' | ') : one.textContent)",
        );
        let case = folder.path().join("Criteria.toml");
        fs::write(&case, text(&mut page)).expect("written");
        let mut check = Command::cargo_bin("vinesink").expect("built");
        let output = check
            .args(["check", "--criteria-only", "--format", "markdown"])
            .arg(&case)
            .output()
            .expect("run");
        let said = String::from_utf8(output.stdout).expect("text").replace("**", "");
        let lines = said.lines().map(|line| line.trim_matches(['|', ' ']).to_owned());
        let lines: Vec<String> =
            lines.filter(|line| !line.is_empty() && !line.starts_with("---")).collect();
        let shown = shown.as_array().expect("lines").iter().filter_map(|one| one.as_str());
        // Numbers stay beside their units on the page.
        let shown: Vec<String> = shown.map(|line| line.replace('\u{a0}', " ")).collect();
        let request = json!({ "ask": "judge", "text": text(&mut page) });
        assert!(shown.len() > 2, "{shown:?} {}", page.evaluate(&format!("{LIVE}.ask({request})")));
        assert_eq!(shown, lines);
    }
}

/// What one sees first: a scale that stays while the motion goes on, and a title that says whose numbers these are; a finger
/// beside the star scrolls, and nothing jumps while the page fills.
#[test]
#[ignore = "deep"]
fn the_first_screen_holds_still() {
    let (file, mut browser) = (file(), browser());
    for view in [DESKTOP, PHONE] {
        let mut page = opened(&mut browser, &file, view);
        let shift = page.evaluate(
            "new Promise((done) => { let sum = 0; new PerformanceObserver((list) => {
                for (const one of list.getEntries()) sum += one.hadRecentInput ? 0 : one.value;
            }).observe({ type: 'layout-shift', buffered: true }); setTimeout(() => done(sum), 300); })",
        );
        assert!(shift.as_f64().expect("a number") < 0.1, "{} px: {shift}", view.width);
        let reach = format!(
            "(async () => {{ const seen = []; for (let k = 0; k < 15; k += 1) {{
                await new Promise((done) => setTimeout(done, 100)); seen.push({LIVE}.running().reach);
            }} return seen; }})()"
        );
        let seen: Vec<f64> = serde_json::from_value(page.evaluate(&reach)).expect("numbers");
        assert!(seen.windows(2).all(|pair| pair[0] <= pair[1]), "{seen:?}");
        assert_eq!(seen[10..].iter().filter(|one| **one != seen[14]).count(), 0, "{seen:?}");
        let begin = text(&mut page);
        // An event that no finger made has no pointer to capture.
        let touched = "(() => { const sheet = document.querySelector('.live-sheet'), at = sheet.getBoundingClientRect();
            sheet.setPointerCapture = () => {};
            const where = { clientX: at.left + 0.3 * at.width, clientY: at.top + 0.3 * at.height };
            sheet.dispatchEvent(new PointerEvent('pointerdown', { pointerType: 'touch', bubbles: true, ...where }));
            return getComputedStyle(sheet).touchAction; })()";
        assert_eq!(page.evaluate(touched), "auto");
        settle(&mut page);
        assert_eq!(text(&mut page), begin);
        let said = "[document.querySelector('.live-sliders h3').textContent, document.querySelector('.live-bar select').value]";
        assert_eq!(page.evaluate(said)[1], "0");
        slide(&mut page, "clearance", 300);
        settle(&mut page);
        let said = page.evaluate(said);
        assert!(said[0].as_str().expect("a title").ends_with(", changed"), "{said}");
        assert_eq!(said[1], "");
        // The menu says what was changed, and a case can be chosen anew.
        let menu = page
            .evaluate("document.querySelector('.live-bar select').selectedOptions[0].textContent");
        assert_eq!(menu, "a footbridge at 2 Hz, changed");
    }
}

/// The impacts of the running simulation are those of the library, bit by bit.
#[test]
#[ignore = "deep"]
fn the_running_simulation_is_the_programs() {
    let (file, mut browser) = (file(), browser());
    let mut page = opened(&mut browser, &file, DESKTOP);
    let shipped = shipped("li2016-8p5hz-fig4d");
    let ran = page.evaluate(&format!(
        "(() => {{
            const engine = {LIVE}.engine();
            engine.ask({{ ask: 'run', text: {}, from: 'push' }});
            const {{ points, impacts }} = engine.goOn(300, 4);
            return [[...points], [...impacts]];
        }})()",
        json!(shipped)
    ));
    let system = Case::parse("case.toml", &shipped).expect("valid").system();
    let start = State { y: 0.5, y_velocity: 1.0, ..State::AT_REST };
    let mut simulation = Simulation::new(&system, start, 0.0).expect("inside");
    let mut trace = Trace::new(4.0);
    simulation.run(300, 100_000, &mut trace);
    let points =
        trace.points.iter().flat_map(|at| [at.periods, at.state.x, at.state.x - at.state.y]);
    let impacts = trace.impacts.iter().flat_map(|(at, impact)| [*at, 0.0, impact.side.sign()]);
    assert!(trace.impacts.len() > 300, "{} impacts", trace.impacts.len());
    for (k, native) in [points.collect::<Vec<f64>>(), impacts.collect()].into_iter().enumerate() {
        let page: Vec<f64> = serde_json::from_value(ran[k].clone()).expect("numbers");
        assert!(page == native, "{k}: {} and {} numbers, or other ones", page.len(), native.len());
    }
}

/// On a desktop and a phone, light and dark, with a case of either kind: no noise, nothing overlaps, and it is no larger than it may be.
#[test]
#[ignore = "deep"]
fn the_page_is_quiet_accessible_and_fits() {
    let (file, mut browser) = (file(), browser());
    let folder = file.parent().expect("a folder").canonicalize().expect("a path");
    let script = checks::axe().map(|script| fs::read_to_string(script).expect("readable"));
    for view in [DESKTOP, PHONE] {
        for dark in [false, true] {
            let mut page = opened(&mut browser, &file, View { dark, ..view });
            for (case, slider) in [("footbridge", "clearance"), ("two places", "clearance_1")] {
                choose(&mut page, case);
                slide(&mut page, slider, 300);
                settle(&mut page);
                let noise = checks::noise(&mut page, &folder);
                assert!(noise.is_empty(), "{noise:#?}");
                let layout = checks::layout(&mut page);
                assert!(layout.is_empty(), "{case}, {} px, dark {dark}: {layout:#?}", view.width);
                if let Some(script) = &script {
                    let found = checks::accessibility(&mut page, script);
                    assert!(found.is_empty(), "{case}, {} px, dark {dark}: {found:#?}", view.width);
                }
            }
        }
    }
    assert!(script.is_some() || env::var("VINESINK_BROWSER").is_err(), "there is no axe-core");
    let size = fs::metadata(&file).expect("a file").len();
    assert!(size <= 1_800_000, "{size} bytes");
}

/// A report with the live page is still one file, begins with its own case, and needs no network.
#[test]
#[ignore = "deep"]
fn a_report_holds_the_live_page() {
    let (file, mut browser) = (file(), browser());
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path().canonicalize().expect("a path");
    let case = folder.join("foot.toml");
    let own = shipped("li2016-8hz-b7p5mm");
    fs::write(&case, format!("# </pre></script> & <b>\n{own}")).expect("writable");
    let run = |live: &Path| {
        let mut report = Command::cargo_bin("vinesink").expect("built");
        report.arg("report").arg(&case).arg("--out").arg(&folder);
        report.arg(format!("--live={}", live.display())).assert()
    };
    run(&file).success();
    let written = folder.join("foot/report.html");
    let mut page = browser.page(DESKTOP);
    page.open(&written);
    page.evaluate("document.querySelector('#live').scrollIntoView({ behavior: 'instant' })");
    settle(&mut page);
    assert_eq!(text(&mut page), fs::read_to_string(&case).expect("a case"));
    let noise = checks::noise(&mut page, &folder);
    assert!(noise.is_empty(), "{noise:#?}");
    let layout = checks::layout(&mut page);
    assert!(layout.is_empty(), "{layout:#?}");
    drop(page);
    // Something else is no live page, and the report stays as it was.
    let before = fs::read(&written).expect("a report");
    let refused = run(&case).failure();
    let said = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(said.contains("this is not the live page"), "{said}");
    assert_eq!(fs::read(&written).expect("a report"), before);
}

/// Without a name the page is the one beside the program; a case that it cannot show is refused.
#[test]
#[ignore = "deep"]
fn the_page_beside_the_program_is_taken() {
    let file = file();
    let folder = tempfile::tempdir().expect("a folder");
    let program = folder.path().join("vinesink");
    fs::copy(assert_cmd::cargo::cargo_bin("vinesink"), &program).expect("a program");
    let run = |case: &str| {
        let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(case);
        let mut report = Command::new(&program);
        report.arg("report").arg(case).args(["--live", "--out"]).arg(folder.path());
        let ran = report.output().expect("it runs");
        (ran.status.success(), String::from_utf8_lossy(&ran.stderr).into_owned())
    };
    let (done, said) = run("li2016-8hz-b7p5mm.toml");
    assert!(!done && said.contains("--live needs the live page"), "{said}");
    assert!(!folder.path().join("li2016-8hz-b7p5mm").exists(), "nothing is half written");
    fs::copy(file, folder.path().join("vinesink-live.html")).expect("a page");
    let (done, said) = run("li2016-8hz-b7p5mm.toml");
    assert!(done, "{said}");
    let report = folder.path().join("li2016-8hz-b7p5mm/report.html");
    assert!(fs::read_to_string(report).expect("a report").contains("data-live"));
    let (done, said) = run("footbridge-jump.toml");
    assert!(!done && said.contains("shows steady vibration"), "{said}");
}

/// Why it works or not, in a line: the energy of a period beside that of an absorber at rest, which the search finds as well; a
/// verdict that is mixed says why at once; and what begins at rest begins in the middle.
#[test]
#[ignore = "deep"]
fn the_first_lines_say_why() {
    let (file, mut browser) = (file(), browser());
    let mut page = opened(&mut browser, &file, DESKTOP);
    let said = |page: &mut Page, of: &str| {
        let text = format!("document.querySelector('{of}').textContent");
        page.evaluate(&text).as_str().expect("words").replace('\u{a0}', " ")
    };
    choose(&mut page, "machine foot");
    let headline = said(&mut page, ".live-headline");
    assert!(
        headline.contains("not the steady 1:1 resonance that an absorber is designed for"),
        "{headline}"
    );
    choose_the_paper(&mut page);
    let document = Native::of(&shipped("li2016-8p5hz-fig4c")).document;
    let motions = document["motions"].as_array().expect("motions");
    let work = |regime: &str| {
        let motion = motions.iter().find(|one| one["regime"] == regime).expect(regime);
        motion["energy"]["work"]["value"].as_f64().expect("a work")
    };
    let ratio = work("two-symmetric") / work("at-rest");
    let verdict = said(&mut page, ".live-verdict");
    assert!(
        verdict.contains(&format!(" {ratio:.1} times what it puts into the structure alone")),
        "{ratio}: {verdict}"
    );
    assert!(verdict.contains("impacts take 72 %, the structure's damping the rest."), "{verdict}");
    // Before a frame moves it.
    let begins = page.evaluate(&format!(
        "[...document.querySelectorAll('.live-bar button')].find((one) => one.textContent === 'From rest').click(),
        [...{LIVE}.engine().goOn(1, 1).points].slice(0, 3)"
    ));
    assert_eq!(begins, json!([0, 0, 0]), "time, displacement and gap");
}
