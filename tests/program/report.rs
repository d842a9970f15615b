//! The report's files as their readers need them, and snapshots of two of them.

use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use serde_json::json;
use tempfile::TempDir;

fn case(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(format!("{name}.toml"))
}

fn report(name: &str, out: &Path) -> PathBuf {
    let mut command = Command::cargo_bin("vinesink").expect("built");
    command.arg("report").arg(case(name)).arg("--out").arg(out);
    command.env("VINESINK_PROGRESS_SECONDS", "1000000");
    let output = command.assert().success().get_output().clone();
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    out.join(name)
}

fn files(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            found.push((path.clone(), fs::read(&path).expect("readable")));
        }
    }
    found.sort();
    found
}

fn text(folder: &Path, file: &str) -> String {
    fs::read_to_string(folder.join(file)).expect("readable")
}

/// A change of wording or layout shows here, to be looked at; correctness is tested elsewhere.
#[test]
fn golden_markdown() {
    let out = TempDir::new().expect("a folder");
    insta::with_settings!({ snapshot_path => "../golden", prepend_module_to_snapshot => false }, {
        for name in ["li2016-8p5hz-fig4c", "li2016-8p5hz-fig4d"] {
            insta::assert_snapshot!(name, text(&report(name, out.path()), "report.md"));
        }
    });
}

/// A case in inches and pounds with `units = "us"`: no page, figure or text has a unit of SI that has another. JSON is in SI.
#[test]
fn a_page_in_inches_and_pounds_has_no_other_units() {
    no_other_units(
        "title = \"a mast\"\nsource = \"a test\"\n\
        [oscillator]\nmass = \"9.19 lb\"\nfrequency = \"500 cpm\"\ndamping_ratio = \"0.7 %\"\n\
        [absorber]\nmass = \"1.13 oz\"\nclearance = \"0.3 in\"\nrestitution = 0.6\n\
        [excitation]\nkind = \"force\"\namplitude = \"0.65 lbf\"\nfrequency = \"480 rpm\"\n\
        [criteria]\nrms_velocity = \"<= 9 in/s\"\nacceleration = \"<= 1.2 g\"\n",
    );
}

/// The same of two modes with two absorbers.
#[test]
fn pages_of_several_modes_in_inches_and_pounds_have_no_other_units() {
    no_other_units(
        "title = \"a mast\"\nsource = \"a test\"\n\
        [[mode]]\nmass = \"9.19 lb\"\nfrequency = \"500 cpm\"\ndamping_ratio = \"0.7 %\"\nshape = { tip = 1.0, low = 0.4 }\n\
        [[mode]]\nmass = \"9.19 lb\"\nfrequency = \"2100 cpm\"\ndamping_ratio = \"1 %\"\nshape = { tip = 1.0, low = -0.8 }\n\
        [[absorber]]\nplace = \"tip\"\nmass = \"1.13 oz\"\nclearance = \"0.3 in\"\nrestitution = 0.6\n\
        [[absorber]]\nplace = \"low\"\nmass = \"2 oz\"\nclearance = \"0.1 in\"\nrestitution = 0.4\n\
        [[excitation]]\nkind = \"force\"\nplace = \"tip\"\namplitude = \"0.65 lbf\"\nfrequency = \"480 rpm\"\n\
        [criteria]\nrms_velocity = \"<= 9 in/s\"\nacceleration = \"<= 1.2 g\"\n",
    );
}

fn no_other_units(text: &str) {
    let folder = TempDir::new().expect("a folder");
    let run = |units: &str, verb: &str| {
        let path = folder.path().join("mast.toml");
        fs::write(&path, format!("{text}[report]\nunits = \"{units}\"\n")).expect("written");
        let mut command = Command::cargo_bin("vinesink").expect("built");
        command.current_dir(&folder).args([verb, "mast.toml"]);
        if verb == "report" {
            command.args(["--out", units]);
        }
        let output = command.output().expect("it runs");
        assert!(output.status.code() < Some(2), "{output:?}");
        String::from_utf8(output.stdout).expect("text")
    };
    run("us", "report");
    run("si", "report");
    let si = regex::Regex::new(r"(?:\d |\()(km|m|mm|µm|nm|t|kg|mg|[kMm]?N|[kM]?N/m|[km]?N s/m|(km|m|mm|µm)/s²?|[kmµn]?J|[kmµ]?W)[^A-Za-z/²\d ]")
        .expect("a pattern");
    let pages = |units: &str| -> Vec<(PathBuf, String)> {
        let all = files(&folder.path().join(units)).into_iter();
        let shown = |path: &Path| path.extension().is_some_and(|end| end == "md" || end == "svg");
        let text = |bytes| String::from_utf8(bytes).expect("text");
        all.filter(|(path, _)| shown(path)).map(|(path, bytes)| (path, text(bytes))).collect()
    };
    let of_si = |page: &str| -> Vec<String> {
        si.find_iter(page).map(|one| one.as_str().to_owned()).collect()
    };
    assert!(pages("si").iter().any(|(_, page)| of_si(page).len() > 20), "the pattern finds units");
    for (path, page) in pages("us") {
        assert_eq!(of_si(&page), Vec::<String>::new(), "{}", path.display());
    }
    let shown = run("us", "check");
    assert!(shown.contains(" in/s") && of_si(&shown).is_empty(), "{shown}");
    let [us, si] = ["us", "si"].map(|units| {
        let json = fs::read_to_string(folder.path().join(units).join("mast/report.json"));
        let json: serde_json::Value = serde_json::from_str(&json.expect("a report")).expect("JSON");
        json["quantities"].clone()
    });
    assert_eq!(us, si);
}

#[test]
fn the_same_case_gives_the_same_bytes() {
    let (first, second) = (TempDir::new().expect("a folder"), TempDir::new().expect("a folder"));
    let strip = |folder: PathBuf| -> Vec<(PathBuf, Vec<u8>)> {
        let relative = |path: &Path| path.strip_prefix(&folder).expect("inside").to_owned();
        files(&folder).into_iter().map(|(path, bytes)| (relative(&path), bytes)).collect()
    };
    let name = "reduced-unit-clearance";
    assert_eq!(strip(report(name, first.path())), strip(report(name, second.path())));
}

#[test]
fn the_verdict_comes_first_and_everything_is_there() {
    let out = TempDir::new().expect("a folder");
    let folder = report("li2016-8p5hz-fig4c", out.path());
    let markdown = text(&folder, "report.md");
    let mut lines = markdown.lines();
    assert_eq!(lines.next(), Some("# Li 2016, 8.5 Hz, regime of Fig. 4c, b = 20 mm"));
    assert_eq!(lines.next(), Some(""));
    let headline = lines.next().expect("a headline");
    // 3.59 mm and 6.40 mm (here 6.39: 6.3947 rounded) are the values of an independent program.
    assert_eq!(
        headline,
        "> **Mixed.** 3.59 mm instead of 6.39 mm (−5.0 dB); two symmetric impacts per period, from all 32 starts that \
         move; the absorber stays inactive from 68 % of its resting places."
    );
    let sections = [
        "Motions",
        "Margins",
        "Alternatives",
        "Theory and exact orbits",
        "Validation",
        "Figures",
        "Inputs",
    ];
    for section in sections {
        assert!(markdown.contains(&format!("\n## {section}\n")), "{section} is missing");
    }
    for line in markdown.lines().filter(|line| line.starts_with('|')) {
        let columns = line.replace("\\|", "").matches('|').count() - 1;
        assert!(columns <= 7, "{columns} columns: {line}");
    }
    for image in markdown.split("src=\"").skip(1).filter_map(|rest| rest.split('"').next()) {
        assert!(folder.join(image).is_file(), "{image} is linked and missing");
    }
    assert!(markdown.lines().count() <= 200, "a reviewer reads every changed line");
    for page in ["validation.md", "equations.md"] {
        assert!(markdown.contains(&format!("]({page})")) && folder.join(page).is_file(), "{page}");
    }
    assert!(!markdown.contains("undefined") && !markdown.contains("NaN"), "{markdown}");
}

/// Less vibration in another motion than the one that an absorber is designed for.
#[test]
fn why_an_answer_is_mixed_is_said() {
    let out = TempDir::new().expect("a folder");
    let markdown = text(&report("li2016-8p5hz-fig4a", out.path()), "report.md");
    let headline = markdown.lines().nth(2).expect("a headline");
    assert!(headline.starts_with("> **Mixed.** 5.15 mm"), "{headline}");
    assert!(headline.contains("not the steady 1:1 resonance that an absorber is designed for"));
}

#[test]
fn the_page_needs_nothing_from_outside() {
    let out = TempDir::new().expect("a folder");
    let folder = report("li2016-8hz-b15mm", out.path());
    let html = text(&folder, "report.html");
    for outside in ["src=", "@import", "url(", "https:", "<script ", "<link rel=\"stylesheet\""] {
        assert!(!html.contains(outside), "{outside}");
    }
    for address in html.match_indices("http:").map(|(at, _)| &html[at..]) {
        // Names of XML dialects are not addresses that a browser asks.
        assert!(address.starts_with("http://www.w3.org/"), "{}", &address[..60.min(address.len())]);
    }
    let figures = files(&folder.join("figures")).len();
    // Most have a narrow drawing beside the usual one.
    let drawn = html.matches("<svg").count();
    assert!(drawn > figures + figures / 2 && drawn <= 2 * figures, "{drawn} of {figures}");
    assert!(html.matches("<math").count() > 80, "equations and symbols in MathML");
    assert!(html.contains("prefers-color-scheme: dark") && html.contains("@media print"));
}

#[test]
fn figures_are_small_and_all_numbers_are_json() {
    let out = TempDir::new().expect("a folder");
    let folder = report("li2016-8hz-b0p3mm", out.path());
    for (path, bytes) in files(&folder.join("figures")) {
        assert!(bytes.len() <= 150_000, "{}: {} bytes", path.display(), bytes.len());
    }
    let json: serde_json::Value =
        serde_json::from_str(&text(&folder, "report.json")).expect("one JSON document");
    assert_eq!(json["format"], "vinesink/answer@2");
    let clearance = json!({"id": "clearance", "value": 3e-4, "error": 0.0, "method": "given"});
    assert_eq!(json["quantities"]["clearance"], clearance);
    assert_eq!(json["motions"][0]["peak"]["id"], "peak_displacement");
}

#[test]
fn a_folder_is_replaced_whole_or_left_alone() {
    let out = TempDir::new().expect("a folder");
    let folder = report("li2016-8hz-b4mm", out.path());
    fs::write(folder.join("figures/stale.svg"), "from an older version").expect("writable");
    report("li2016-8hz-b4mm", out.path());
    assert!(!folder.join("figures/stale.svg").exists());
    let before = files(&folder);

    let broken = out.path().join("li2016-8hz-b4mm.toml");
    let wrong = fs::read_to_string(case("li2016-8hz-b4mm")).expect("readable");
    fs::write(&broken, wrong.replace("restitution = 0.6", "restitution = 1.2")).expect("writable");
    let mut command = Command::cargo_bin("vinesink").expect("built");
    let output = command.arg("report").arg(&broken).arg("--out").arg(out.path()).output();
    let output = output.expect("runs");
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(message.contains("restitution") && message.contains("1.2"), "{message}");
    assert!(output.stdout.is_empty());
    assert_eq!(files(&folder), before);
    assert!(fs::read_dir(out.path()).expect("readable").count() == 2, "nothing half-written stays");
}

#[test]
fn two_cases_of_one_name_are_refused() {
    let out = TempDir::new().expect("a folder");
    let copy = out.path().join("li2016-8hz-b4mm.toml");
    fs::copy(case("li2016-8hz-b4mm"), &copy).expect("writable");
    let mut command = Command::cargo_bin("vinesink").expect("built");
    command.arg("report").arg(case("li2016-8hz-b4mm")).arg(copy).arg("--out").arg(out.path());
    let assert = command.assert().code(2);
    let message = String::from_utf8_lossy(&assert.get_output().stderr).into_owned();
    assert!(message.contains("li2016-8hz-b4mm") && message.contains("--out"), "{message}");
}

/// Extremes that are physically meaningful, and where the theory has little or nothing to say.
#[test]
fn extremes_get_a_report() {
    let out = TempDir::new().expect("a folder");
    let base = fs::read_to_string(case("li2016-8hz-b7p5mm")).expect("readable");
    let edits: [(&str, &str, &str); 8] = [
        ("sticky", "restitution = 0.6", "restitution = 0"),
        ("elastic", "restitution = 0.6", "restitution = 1"),
        ("micrometre", "clearance = \"7.5 mm\"", "clearance = \"1 um\""),
        ("heavy", "mass = \"32 g\"", "mass_ratio = 0.5"),
        ("undamped", "damping = \"3.02 N s/m\"", "damping = \"0 N s/m\""),
        ("still", "amplitude = \"0.25 mm\"", "amplitude = \"0 mm\""),
        ("far", "frequency = \"8 Hz\"", "frequency = \"80 Hz\""),
        ("overdamped", "damping = \"3.02 N s/m\"", "damping = \"3 kN s/m\""),
    ];
    for (name, old, new) in edits {
        assert!(base.contains(old), "{old}");
        let path = out.path().join(format!("{name}.toml"));
        let short = "\n[simulation]\nstarts = 4\nperiods = 100\ndiscard = 50\n";
        fs::write(&path, base.replace(old, new) + short).expect("writable");
        let mut command = Command::cargo_bin("vinesink").expect("built");
        command.arg("report").arg(&path).arg("--out").arg(out.path());
        let assert = command.assert().success();
        let markdown = text(&out.path().join(name), "report.md");
        assert!(!markdown.contains("NaN") && !markdown.contains("infinite"), "{name}: {markdown}");
        drop(assert);
    }
}

/// A bad case among others is named, the others are written, and the exit code says that not all
/// could be done.
#[test]
fn a_bad_case_does_not_keep_the_others_from_being_written() {
    let out = TempDir::new().expect("a folder");
    let missing = out.path().join("missing.toml");
    let mut command = Command::cargo_bin("vinesink").expect("built");
    command.arg("report").arg(&missing).arg(case("li2016-8hz-b4mm")).arg("--out").arg(out.path());
    let assert = command.assert().code(2);
    let message = String::from_utf8_lossy(&assert.get_output().stderr).into_owned();
    assert!(message.contains("missing.toml"), "{message}");
    assert!(out.path().join("li2016-8hz-b4mm/report.md").is_file());
    assert!(!out.path().join("missing").exists());
}

/// What GitHub shows of a drawing in a repository: no style sheet, no script, nothing from elsewhere.
#[test]
fn committed_figures_render_on_github() {
    let reports = Path::new(env!("CARGO_MANIFEST_DIR")).join("reports");
    let figures: Vec<_> = files(&reports)
        .into_iter()
        .filter(|(path, _)| path.extension().is_some_and(|extension| extension == "svg"))
        .collect();
    assert!(figures.len() > 100, "{} are not all figures", figures.len());
    let forbidden = regex::Regex::new(
        r#"<(?:style|script|foreignObject|image|use|!DOCTYPE|!ENTITY|a)\b|\s(?:style|class|id|href|xlink:href|on\w+)\s*=|<\?xml-stylesheet|url\("#,
    )
    .expect("a pattern");
    let image = regex::Regex::new(
        r#"^<image( (x|y|width|height|preserveAspectRatio|image-rendering)="[\w-]+")+ href="data:image/png;base64,[\w+/=]+"/>$"#,
    )
    .expect("a pattern");
    for (path, bytes) in figures {
        let drawing = String::from_utf8(bytes).expect("UTF-8");
        // Titles and descriptions are text for those who cannot see.
        let markup =
            drawing.lines().filter(|line| line.starts_with('<') && !line.contains("<desc>"));
        for line in markup {
            // A map's colours, which lie within the file and above blocks of the same colours.
            if image.is_match(line) {
                continue;
            }
            let found = forbidden.find(line).map(|found| found.as_str());
            assert_eq!(found, None, "{}: {line}", path.display());
        }
        let attribute = |name: &str| drawing.split(&format!(" {name}=\"")).nth(1).unwrap_or("");
        let size = attribute("viewBox").split('"').next().unwrap_or("").to_owned();
        let [width, height] = [2, 3].map(|index| size.split(' ').nth(index).unwrap_or("none"));
        let page =
            format!("<rect x=\"0\" y=\"0\" width=\"{width}\" height=\"{height}\" fill=\"#FFFFFF\"");
        let first = drawing.lines().find(|line| line.starts_with("<rect")).unwrap_or("");
        assert!(first.starts_with(&page), "{} has no white page: {first}", path.display());
    }
}

/// A number that moves changes the lines that say it, and no other line moves with it.
#[test]
fn markdown_changes_by_the_lines_that_changed() {
    let out = TempDir::new().expect("a folder");
    let name = "li2016-8p5hz-1percent";
    let old = text(&report(name, out.path()), "report.md");
    let path = out.path().join(format!("{name}.toml"));
    let case = fs::read_to_string(case(name)).expect("readable");
    assert!(case.contains("clearance = \"15 mm\""), "{case}");
    fs::write(&path, case.replace("clearance = \"15 mm\"", "clearance = \"15.1 mm\""))
        .expect("written");
    let mut command = Command::cargo_bin("vinesink").expect("built");
    command.arg("report").arg(&path).arg("--out").arg(out.path()).assert().success();
    let new = text(&out.path().join(name), "report.md");
    assert_eq!(old.lines().count(), new.lines().count());
    let changed = old.lines().zip(new.lines()).filter(|(old, new)| old != new);
    let changed: Vec<_> = changed.collect();
    assert!(changed.len() > 10 && changed.len() < old.lines().count() / 2, "{}", changed.len());
    let words = |line: &str| line.chars().filter(|c| !c.is_ascii_digit()).collect::<String>();
    for (old, new) in changed {
        assert_ne!(words(old), old, "a line without a number changed: {old} | {new}");
    }
    for row in old.lines().filter(|line| line.starts_with("| ") && line.contains("mm |")) {
        assert!(row.ends_with('|'), "a row is a line: {row}");
    }
}

const QUICK: &str = "title = \"T\"\nsource = \"made up\"\n\n[reduced]\nmass_ratio = 0.0077\ndamping = 1.8\nrestitution = 0.6\nclearance = 1.0\nforcing = 2.0\nfrequency_ratio = 1.0\n\n[simulation]\nstarts = 2\nperiods = 50\ndiscard = 50\n";

/// Runs the program in a folder: its exit code and what it complained.
fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::cargo_bin("vinesink").expect("built");
    let output = command.current_dir(folder).args(arguments).output().expect("it runs");
    (output.status.code(), String::from_utf8(output.stderr).expect("UTF-8"))
}

/// Two names that are one on some systems: in one run, and in one index.
#[test]
fn names_that_differ_by_letter_case_are_warned_of() {
    let folder = TempDir::new().expect("a folder");
    for (one, other) in [("bridge", "Bridge"), ("ärm", "ÄRM"), ("a b", "A b")] {
        let files = [one, other].map(|name| format!("{name}.toml"));
        for file in &files {
            fs::write(folder.path().join(file), QUICK).expect("written");
        }
        let warning = format!("`{one}` and `{other}` differ by letter case alone");
        let (code, told) = run(folder.path(), &["report", "--criteria-only", &files[0], &files[1]]);
        assert!(code == Some(0) && told.contains(&warning), "{told}");
        let (code, told) = run(folder.path(), &["index"]);
        let indexed =
            told.contains(&warning) || told.contains(&format!("`{other}` and `{one}` differ"));
        assert!(code == Some(0) && indexed, "{told}");
        let (_, told) = run(folder.path(), &["report", "--criteria-only", &files[0]]);
        assert!(!told.contains(&warning), "{told}");
        fs::remove_dir_all(folder.path().join("reports")).expect("removed");
    }
}

/// Where nobody can be told, what was done is not denied.
#[cfg(target_os = "linux")]
#[test]
fn a_report_that_was_written_is_not_said_not_to_be() {
    let folder = TempDir::new().expect("a folder");
    for name in ["a", "b"] {
        fs::write(folder.path().join(format!("{name}.toml")), QUICK).expect("written");
    }
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_vinesink"));
    command.current_dir(folder.path()).args(["report", "--criteria-only", "a.toml", "b.toml"]);
    let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("a device");
    let output = command.stdout(full).output().expect("it runs");
    let told = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(output.status.code(), Some(2), "{told}");
    for name in ["a", "b"] {
        assert!(folder.path().join(format!("reports/{name}/report.json")).exists(), "{name}");
        assert!(told.contains(&format!("reports/{name}/report.md was written")), "{told}");
    }
    assert!(
        told.contains("cannot write to standard output") && !told.contains("no report"),
        "{told}"
    );
}
