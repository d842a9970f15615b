//! Reports and their index as a person meets them: in Chromium, without a window.
//!
//! Needs Debian's package `chromium` (or a program named in `CHROMIUM`), and for the accessibility
//! check axe-core's script, which `.ci/deep` fetches into `target/axe` (or a file named in `AXE`).
//! Where one is missing the tests fail: `.ci/deep browser` runs them, `cargo test` counts them as ignored.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use crate::browser_support::checks::{self, DESKTOP, PHONE};
use crate::browser_support::chromium::{self, Browser, Page, View};
use assert_cmd::Command;
use serde_json::json;

/// Reports that differ: with notes and coexisting motions; answered without simulation; in a case's
/// own unit.
const CASES: [&str; 3] = ["li2016-8hz-b15mm", "li2016-8p5hz-1percent", "reduced-unit-clearance"];

/// One with a band and criteria, which is in no index here.
const FURTHER: &str = "li2016-band";

/// The folder with their reports and the index, written once by the program.
static REPORTS: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("browser reports");
    let _ = fs::remove_dir_all(&folder);
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let mut report = Command::cargo_bin("vinesink").expect("built");
    report.arg("report").args(CASES.map(|name| cases.join(format!("{name}.toml"))));
    report.arg("--out").arg(&folder).assert().success();
    let mut index = Command::cargo_bin("vinesink").expect("built");
    index.arg("index").arg(&folder).assert().success();
    let mut report = Command::cargo_bin("vinesink").expect("built");
    report.arg("report").arg(cases.join(format!("{FURTHER}.toml")));
    report.arg("--out").arg(folder.join("further")).assert().success();
    folder.canonicalize().expect("a path")
});

/// Chromium, with which these tests fail where it is missing.
pub fn browser() -> Browser {
    let program = chromium::program().expect(
        "there is no chromium: install Debian's package `chromium`, or name it in CHROMIUM",
    );
    Browser::start(&program)
}

fn pages() -> Vec<PathBuf> {
    let mut pages = vec![REPORTS.join("index.html")];
    pages.extend(CASES.map(|name| REPORTS.join(name).join("report.html")));
    pages.push(REPORTS.join("further").join(FURTHER).join("report.html"));
    pages
}

fn name(file: &Path) -> String {
    file.strip_prefix(&*REPORTS).unwrap_or(file).display().to_string()
}

/// Calls `check` with every page in some views, and fails with all that it finds.
fn everywhere(views: &[View], check: impl Fn(&mut Page) -> Vec<String>) {
    let mut browser = browser();
    let mut wrong: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for file in pages() {
        let mut page = browser.page(DESKTOP);
        page.open(&file);
        checks::unfold(&mut page);
        for view in views {
            page.look(*view);
            let found = check(&mut page);
            if !found.is_empty() {
                let place = format!("{} at {} px, dark: {}", name(&file), view.width, view.dark);
                wrong.insert(place, found);
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
#[ignore = "deep"]
fn pages_load_without_errors_and_without_the_network() {
    let mut browser = browser();
    for file in pages() {
        for view in [DESKTOP, PHONE] {
            let mut page = browser.page(view);
            page.open(&file);
            checks::unfold(&mut page);
            let noise = checks::noise(&mut page, &REPORTS);
            assert!(noise.is_empty(), "{}: {noise:#?}", name(&file));
        }
    }
}

#[test]
#[ignore = "deep"]
fn equations_and_figures_are_seen_on_phone_and_desktop() {
    everywhere(&[DESKTOP, PHONE], checks::layout);
}

#[test]
#[ignore = "deep"]
fn pages_are_accessible() {
    let script = checks::axe()
        .expect("there is no axe-core: run `npm pack axe-core` and unpack it in target/axe, or name its axe.min.js in AXE");
    let script = fs::read_to_string(script).expect("readable");
    // What is hidden on a phone may be pale in the dark only.
    let views = [DESKTOP, PHONE].map(|view| [view, View { dark: true, ..view }]);
    everywhere(views.as_flattened(), |page| checks::accessibility(page, &script));
}

#[test]
#[ignore = "deep"]
fn colours_of_pages_and_figures_follow_the_readers_preference() {
    let mut browser = browser();
    for file in pages() {
        let mut page = browser.page(DESKTOP);
        page.open(&file);
        let mut paper = |dark| {
            page.look(View { dark, ..DESKTOP });
            let colour = "getComputedStyle(document.body).backgroundColor";
            let drawing = "document.querySelector('figure .drawing svg, figure img')";
            let turned = format!("getComputedStyle({drawing}).filter !== 'none'");
            [page.evaluate(colour), page.evaluate(&turned)]
        };
        let told = |colour: &str, turned: bool| [json!(colour), json!(turned)];
        assert_eq!(paper(false), told("rgb(255, 255, 255)", false), "{}", name(&file));
        assert_eq!(paper(true), told("rgb(22, 25, 29)", true), "{}", name(&file));
    }
}

#[test]
#[ignore = "deep"]
fn marked_points_have_tooltips() {
    let mut browser = browser();
    for case in CASES {
        let mut page = browser.page(DESKTOP);
        page.open(&REPORTS.join(case).join("report.html"));
        let found = checks::tooltips(&mut page).unwrap_or_else(|why| panic!("{case}: {why}"));
        assert!(found > 5, "{case}: {found} tooltips");
    }
}

#[test]
#[ignore = "deep"]
fn pages_are_printed_on_several_sheets() {
    let mut browser = browser();
    for file in pages() {
        let mut page = browser.page(DESKTOP);
        page.open(&file);
        let pdf = page.print();
        assert!(pdf.len() > 20_000, "{}: {} bytes", name(&file), pdf.len());
        let sheets = checks::pages(&pdf);
        let expected = if file.ends_with("index.html") { 1..4 } else { 3..40 };
        assert!(expected.contains(&sheets), "{}: {sheets} sheets", name(&file));
    }
}

/// Texts of the column of a head, from the first row to the last.
fn column(page: &mut Page, head: usize) -> Vec<String> {
    let script = format!(
        "[...document.querySelectorAll('#cases tbody tr')].map((row) => row.cells[{head}].textContent)"
    );
    let texts = page.evaluate(&script);
    let texts = texts.as_array().expect("a list");
    texts.iter().map(|text| text.as_str().expect("a text").to_owned()).collect()
}

const CLEARANCE: usize = 3;

#[test]
#[ignore = "deep"]
fn the_index_is_sorted_by_keyboard() {
    let mut browser = browser();
    let mut page = browser.page(DESKTOP);
    page.open(&REPORTS.join("index.html"));
    let by_name = column(&mut page, CLEARANCE);
    assert_eq!(by_name, ["15 mm", "15 mm", "1 units"]);
    // Tab goes from the head of the cases to that of the verdicts, and Enter sorts.
    page.evaluate("document.querySelector('#cases thead button').focus()");
    page.press("Tab", 9, "");
    page.press("Enter", 13, "\r");
    let sorted = "document.querySelector('#cases [aria-sort]').textContent
        + ' ' + document.querySelector('#cases [aria-sort]').getAttribute('aria-sort')";
    assert_eq!(page.evaluate(sorted), "Verdict ascending");
    let tones = |page: &mut Page| -> Vec<String> {
        let words = column(page, 2);
        let before =
            |text: &String| text.split(|c: char| c.is_ascii_digit()).next().map(str::to_owned);
        words.iter().filter_map(before).map(|word| word.trim().to_owned()).collect()
    };
    assert_eq!(tones(&mut page), ["Mixed", "Makes it worse", "Makes it worse"]);
    page.press("Enter", 13, "\r");
    assert_eq!(page.evaluate(sorted), "Verdict descending");
    assert_eq!(tones(&mut page), ["Makes it worse", "Makes it worse", "Mixed"]);
    // What cannot be compared comes last, up and down.
    let click = format!(
        "document.querySelector('#cases thead').rows[0].cells[{CLEARANCE}].querySelector('button').click()"
    );
    for direction in ["ascending", "descending"] {
        page.evaluate(&click);
        assert_eq!(page.evaluate(sorted), format!("Clearance b {direction}"));
        assert_eq!(column(&mut page, CLEARANCE), by_name, "{direction}");
    }
}

#[test]
#[ignore = "deep"]
fn chosen_cases_stand_side_by_side() {
    let mut browser = browser();
    let mut page = browser.page(DESKTOP);
    page.open(&REPORTS.join("index.html"));
    let shown = "[...document.querySelectorAll('#numbers tr')]
        .map((row) => [...row.cells].filter((cell) => cell.checkVisibility())
            .map((cell) => cell.textContent.trim()).join(' | ')).filter((row) => row)";
    assert_eq!(page.evaluate(shown), json!([]));
    let choose = |page: &mut Page, place: usize| {
        let at = format!("document.querySelectorAll('#cases input')[{place}].focus()");
        page.evaluate(&at);
        page.press(" ", 32, " ");
    };
    choose(&mut page, 0);
    assert_eq!(page.evaluate(shown), json!([]), "one case is no comparison");
    choose(&mut page, 2);
    let rows = page.evaluate(shown);
    let rows: Vec<&str> =
        rows.as_array().expect("rows").iter().filter_map(|row| row.as_str()).collect();
    assert_eq!(rows[0], "Quantity | li2016-8hz-b15mm | reduced-unit-clearance");
    for row in ["Clearance b | 15 mm | 1 units", "Restitution r | 0.6 | 0.6"] {
        assert!(rows.contains(&row), "{row}: {rows:#?}");
    }
    let differs =
        "[...document.querySelectorAll('#numbers tr.differs th')].map((th) => th.textContent)";
    let differs = page.evaluate(differs).to_string();
    assert!(differs.contains("Clearance b") && !differs.contains("Restitution r"), "{differs}");
    assert!(checks::layout(&mut page).is_empty());
    choose(&mut page, 0);
    choose(&mut page, 1);
    let rows = page.evaluate(shown).to_string();
    assert!(rows.contains("Reduced forcing G | –") && !rows.contains("– | –"), "{rows}");
    page.evaluate("document.querySelector('#clear').click()");
    assert_eq!(page.evaluate(shown), json!([]));
}

#[test]
#[ignore = "deep"]
fn the_index_does_without_scripts() {
    let mut browser = browser();
    let mut page = browser.page(DESKTOP);
    page.without_scripts();
    page.open(&REPORTS.join("index.html"));
    assert_eq!(column(&mut page, CLEARANCE), ["15 mm", "15 mm", "1 units"]);
    let dead = "[...document.querySelectorAll('button, input, #comparison, .scripted')]
        .filter((part) => part.checkVisibility()).length";
    assert_eq!(page.evaluate(dead), 0, "controls that do nothing");
}

/// Where no pointer rests, the keyboard and a finger tell what a marked point is.
#[test]
#[ignore = "deep"]
fn a_marked_point_is_told_by_the_arrow_keys_and_under_a_finger() {
    let mut browser = browser();
    for view in [DESKTOP, PHONE] {
        let mut page = browser.page(view);
        page.open(&REPORTS.join("further").join(FURTHER).join("report.html"));
        let titles = "drawing = document.querySelector('.drawing:has(+ .told)'),
            svg = [...drawing.querySelectorAll('svg')].find((one) => one.checkVisibility()),
            titles = [...svg.querySelectorAll('svg * > title')].map((title) => title.textContent),
            told = () => drawing.nextElementSibling.textContent, titles";
        let titles = page.evaluate(titles);
        let titles: Vec<&str> =
            titles.as_array().expect("texts").iter().filter_map(|text| text.as_str()).collect();
        assert!(titles.len() > 2 && titles[0].contains(": "), "{titles:?}");
        page.evaluate("drawing.focus({ preventScroll: true })");
        let mut press = |key: &str, code| {
            page.press(key, code, "");
            page.evaluate("told()")
        };
        assert_eq!(press("ArrowRight", 39), titles[0]);
        assert_eq!(press("ArrowRight", 39), titles[1]);
        assert_eq!(press("ArrowLeft", 37), titles[0]);
        assert_eq!(press("ArrowLeft", 37), titles[titles.len() - 1]);
        assert_eq!(press("Escape", 27), "");
        // A click is a finger's touch: near a point, where no other is, and far from all.
        page.evaluate(
            "new Promise((done) => { drawing.scrollIntoView({ block: 'center', behavior: 'instant' });
                requestAnimationFrame(() => requestAnimationFrame(done)); })",
        );
        let lonely = "(() => {
            const at = [...svg.querySelectorAll('svg * > title')].map((title) => title.parentNode.getBoundingClientRect());
            const room = at.map((a, k) => Math.min(...at.filter((_, j) => j !== k).map((b) => Math.hypot(a.x - b.x, a.y - b.y))));
            const k = room.indexOf(Math.max(...room));
            return [at[k].x, at[k].y, k]; })()";
        let point = page.evaluate(lonely);
        let [x, y, k] = [0, 1, 2].map(|k| point[k].as_f64().expect("a number"));
        page.drag([x, y], [x, y], 1);
        assert_eq!(page.evaluate("told()"), titles[k as usize]);
        let corner = "((box) => [box.x + 3, box.y + 3])(drawing.getBoundingClientRect())";
        let corner = page.evaluate(corner);
        let corner = [0, 1].map(|k| corner[k].as_f64().expect("a number"));
        page.drag(corner, corner, 1);
        assert_eq!(page.evaluate("told()"), "");
    }
}

/// On a phone the evidence begins folded; a link to it, a search or its heading shows it, and paper has it all.
#[test]
#[ignore = "deep"]
fn the_evidence_is_folded_on_a_phone() {
    let mut browser = browser();
    let report = REPORTS.join("further").join(FURTHER).join("report.html");
    const FOLDED: &str = "[...document.querySelectorAll('h2 + [hidden]')].map((one) => one.previousElementSibling.id)";
    let mut page = browser.page(DESKTOP);
    page.open(&report);
    assert_eq!(page.evaluate(FOLDED), json!([]));
    page.evaluate("document.querySelector('#band button').click()");
    assert_eq!(page.evaluate(FOLDED), json!(["band"]));
    drop(page);
    let mut page = browser.page(PHONE);
    page.open(&report);
    let folded = page.evaluate(FOLDED).to_string();
    assert!(folded.contains("motions") && folded.contains("validation"), "{folded}");
    assert!(!folded.contains("criteria") && !folded.contains("alternatives"), "{folded}");
    // The tile leads to the list of motions.
    let shown = "(async () => { location.hash = '#motions'; await new Promise((done) => setTimeout(done, 200));
        return [...document.querySelectorAll('#motions + div table')].every((one) => one.checkVisibility({ contentVisibilityAuto: true })); })()";
    assert_eq!(page.evaluate(shown), json!(true));
    assert!(!page.evaluate(FOLDED).to_string().contains("motions"));
    let short = page.print().len();
    checks::unfold(&mut page);
    assert_eq!(page.evaluate(FOLDED), json!([]));
    let whole = page.print().len();
    assert!(short.abs_diff(whole) < whole / 50, "{short} of {whole} bytes are printed");
}

/// A number is one of its unit, whatever its prefix; a list of different quantities has no order.
#[test]
#[ignore = "deep"]
fn tables_sort_by_a_column() {
    let mut browser = browser();
    let mut page = browser.page(DESKTOP);
    page.open(&REPORTS.join("further").join(FURTHER).join("report.html"));
    checks::unfold(&mut page);
    let heads = "[...document.querySelectorAll('.table')].map((table) =>
        [...table.querySelectorAll('th')].map((head) => head.textContent + (head.querySelector('button') ? ' sorts' : '')))";
    let heads = page.evaluate(heads);
    let table = |first: &str| {
        let mut tables = heads.as_array().expect("tables").iter();
        tables.position(|heads| heads[0].as_str().is_some_and(|head| head.starts_with(first)))
    };
    for (first, sorts) in
        [("Device", true), ("Boundary", true), ("Criterion", false), ("Quantity", false)]
    {
        let head = &heads[table(first).expect("a table")][0];
        assert_eq!(head.as_str().expect("a text").ends_with(" sorts"), sorts, "{head}");
    }
    // By the structure's shift, one of the amplitudes in another prefix.
    let devices = table("Device").expect("a table");
    let column = format!(
        "table = document.querySelectorAll('.table')[{devices}], rows = () => [...table.querySelectorAll('tbody tr')],
        last = () => rows().map((row) => row.cells[row.cells.length - 1].textContent.split(' (')[0]),
        rows()[1].cells[rows()[1].cells.length - 1].textContent = '1020\u{a0}\u{b5}m',
        sort = () => [...table.querySelectorAll('th button')].at(-1).click(), sort(), last()"
    );
    let wanted = ["0.922 mm", "1020 \u{b5}m", "1.04 mm", "1.15 mm", "3.00 mm", "3.39 mm"]
        .map(|one| one.replace(' ', "\u{a0}"));
    assert_eq!(page.evaluate(&column), json!(wanted));
    // A change has its sign in front.
    let boundary = table("Boundary").expect("a table");
    let changes = page.evaluate(&format!(
        "table = document.querySelectorAll('.table')[{boundary}], table.querySelectorAll('th button')[4].click(),
        [...table.querySelectorAll('tbody tr')].map((row) => row.cells[4].textContent[0])"
    ));
    assert_eq!(changes, json!(["\u{2212}", "+", "+", "+", "+"]));
    let last = "[...table.querySelectorAll('tbody tr')].at(-1).cells[4].textContent";
    assert_eq!(page.evaluate(last), "+204\u{a0}%");
    page.evaluate(&format!("table = document.querySelectorAll('.table')[{devices}]"));
    // What has no number comes last, up and down.
    let stroke = |page: &mut Page| {
        page.evaluate(
            "table.querySelectorAll('th button')[1].click(), rows().at(-1).cells[1].textContent",
        )
    };
    assert_eq!([stroke(&mut page), stroke(&mut page)], ["\u{2013}", "\u{2013}"]);
}

/// The checks themselves: each must see what it is there for.
#[test]
#[ignore = "deep"]
fn faults_are_found() {
    let mut browser = browser();
    let folder = tempfile::tempdir().expect("a folder");
    let faulty = folder.path().join("faulty.html");
    let mut found = |content: &str, check: &dyn Fn(&mut Page) -> Vec<String>| {
        let head = "<!DOCTYPE html><html lang=\"en\"><head><title>T</title>
            <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">
            </head><body><main><h1>T</h1>";
        fs::write(&faulty, format!("{head}{content}</main></body></html>")).expect("writable");
        let mut page = browser.page(PHONE);
        page.open(&faulty);
        check(&mut page).join("\n")
    };
    let noise = |page: &mut Page| checks::noise(page, folder.path());
    assert_eq!(found("<p>good</p>", &noise), "");
    assert!(found("<script>console.error('broken')</script>", &noise).contains("broken"));
    assert!(found("<script>nonsense()</script>", &noise).contains("nonsense is not defined"));
    let asked = found("<img alt=\"a\" src=\"http://localhost:1/x.png\">", &noise);
    assert!(asked.contains("request: http://localhost:1/x.png"), "{asked}");
    let outside = found("<img alt=\"a\" src=\"file:///etc/x.png\">", &noise);
    assert!(outside.contains("request: file:///etc/x.png"), "{outside}");

    let wide = "<svg width=\"900\" height=\"20\"></svg>";
    let seen = found(wide, &checks::layout);
    assert!(seen.contains("outside of the window"), "{seen:?}");
    let boxed = format!("<div style=\"overflow-x: auto\">{wide}</div>");
    assert_eq!(found(&boxed, &checks::layout), "");
    assert!(found("<svg width=\"0\" height=\"0\"></svg>", &checks::layout).contains("no size"));
    assert!(found("<img alt=\"a\" src=\"none.png\">", &checks::layout).contains("no image"));

    let tooltips = |page: &mut Page| checks::tooltips(page).err().into_iter().collect();
    let covered =
        "<svg width=\"90\" height=\"90\"><g><title>t</title><circle cx=\"9\" cy=\"9\" r=\"3\"/></g>
        <rect width=\"90\" height=\"90\"/></svg>";
    assert!(found(covered, &tooltips).contains("nothing to point at"));

    let Some(script) = checks::axe() else { return };
    let script = fs::read_to_string(script).expect("readable");
    let axe = |page: &mut Page| checks::accessibility(page, &script);
    assert_eq!(found("<p>good</p>", &axe), "");
    assert!(found("<img src=\"data:,\">", &axe).contains("image-alt"));
    assert!(found("<p style=\"color: #bbbbbb\">pale</p>", &axe).contains("color-contrast"));
    assert!(
        found("<svg role=\"img\" width=\"9\" height=\"9\"></svg>", &axe).contains("svg-img-alt")
    );
}
