//! What absorbers of several modes are looked for by: shares and margins of exact orbits as with one mode, and the best on average.

use std::f64::consts::TAU;
use std::fs;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::tempdir;

/// What a command says of a case, as JSON.
fn told(text: &str, arguments: &[&str]) -> Value {
    let folder = tempdir().expect("a folder");
    let path = folder.path().join("case.toml");
    fs::write(&path, text).expect("written");
    let path = path.to_str().expect("UTF-8");
    let all = [&[arguments[0], path, "--format", "json"], &arguments[1..]].concat();
    let mut command = Command::cargo_bin("vinesink").expect("built");
    let output = command.args(&all).output().expect("it runs");
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{all:?}: {error}"))
}

const IDLE: &str = "[[mode]]\nfrequency = \"33.7 Hz\"\ndamping_ratio = 0.02\nmass = \"10 kg\"\nshape = { tip = 0, other = 1 }\n";

/// A structure at 10 Hz that moves by 1 mm without its absorber of so many per cent, over a range of frequencies.
fn case(heavy: f64, range: [f64; 2], idle: bool, more: &str) -> String {
    let stiffness = 10.0 * TAU * TAU * 100.0;
    let (shape, further) = if idle { ("tip = 1, other = 0", IDLE) } else { ("tip = 1", "") };
    let [from, to] = range;
    let at = match from == to {
        true => format!("frequency = \"{from} Hz\"\n"),
        false => format!("from = \"{from} Hz\"\nto = \"{to} Hz\"\n"),
    };
    format!(
        "title = \"t\"\nsource = \"s\"\n[[mode]]\nfrequency = \"10 Hz\"\ndamping_ratio = 0.01\nmass = \"10 kg\"\nshape = {{ {shape} }}\n{further}\
         [[absorber]]\nplace = \"tip\"\nmass = \"{} g\"\nclearance = \"2 mm\"\nrestitution = 0.6\n\
         [excitation]\nkind = \"force\"\nplace = \"tip\"\namplitude = \"{} N\"\n{at}{more}",
        1e2 * heavy,
        1e-3 * stiffness * 0.02
    )
}

/// A mode that takes no part leaves the objectives what they are with one mode, whose orbits are a closed form and whose search is another.
#[test]
fn objectives_are_those_of_one_mode() {
    for (objective, range, error) in
        // Shares have kinks between the candidates; a margin is the least along a range.
        [("stable-share", [9.7, 10.3], 0.02), ("margin", [9.95, 10.05], 0.02)]
    {
        let more = format!(
            "[optimize]\nobjective = \"{objective}\"\nclearance = [\"0.3 mm\", \"4 mm\"]\n"
        );
        let [one, two] =
            [false, true].map(|idle| told(&case(2.0, range, idle, &more), &["optimize"]));
        for key in ["format", "objective", "reached", "feasible", "improves"] {
            assert_eq!(one[key], two[key], "{objective}");
        }
        let value = |of: &Value| of["checked"]["value"].as_f64().expect("a value");
        assert!(value(&one) > 0.05, "{one}");
        // The search of several modes looks at fewer candidates.
        assert!(
            value(&two) > value(&one) - error && value(&two) < value(&one) + 1e-3,
            "{one} {two}"
        );
        let clearance = |of: &Value| of["optimum"]["clearance"].as_f64().expect("a length");
        println!(
            "{objective}: {} {}, {} {}",
            value(&one),
            value(&two),
            clearance(&one),
            clearance(&two)
        );
        assert_eq!(two["optimum"]["absorbers"][0]["clearance"], two["optimum"]["clearance"]);
    }
    // At the ends nothing is stable: an honest nothing.
    let more = "[optimize]\nobjective = \"margin\"\n[uncertainty]\nrestitution = \"± 0.05\"\n";
    let nothing = told(&case(2.0, [8.0, 12.0], true, more), &["optimize"]);
    assert_eq!(nothing["answer"], "not-reached", "{nothing}");
    assert!(nothing["optimum"].is_null() && nothing["robust"].is_null(), "{nothing}");
}

/// The share of a design is that of the frequencies at which `analyze` finds a stable orbit.
#[test]
fn a_share_is_that_of_single_frequencies() {
    let range = [9.7, 10.3];
    let more = "[optimize]\nobjective = \"stable-share\"\nclearance = [\"0.3 mm\", \"4 mm\"]\n";
    let found = told(&case(2.0, range, true, more), &["optimize"]);
    let share = found["checked"]["value"].as_f64().expect("a share");
    let clearance = found["optimum"]["clearance"].as_f64().expect("a length");
    let steps = 40;
    let stable = (0..steps).filter(|k| {
        let at = range[0] + (range[1] - range[0]) * (f64::from(*k) + 0.5) / f64::from(steps);
        let text = case(2.0, [at, at], true, "");
        let text = text.replace("2 mm", &format!("{} mm", 1e3 * clearance));
        let orbits = &told(&text, &["analyze"])["orbits"];
        orbits.as_array().expect("a list").iter().any(|one| one["stable"] == true)
    });
    let counted = stable.count() as f64 / f64::from(steps);
    // Each end of a stretch lies within a step.
    assert!((counted - share).abs() < 2.0 / f64::from(steps), "{counted} {share}");
}

/// The average of absorbers is that of `check` of cases whose clearance is off, by the nodes and weights of Gauss.
#[test]
fn an_average_is_that_of_cases_that_are_off() {
    const NODES: [[f64; 2]; 5] = [
        [-0.906_179_845_938_664, 0.118_463_442_528_094_54],
        [-0.538_469_310_105_683, 0.239_314_335_249_683_23],
        [0.0, 0.284_444_444_444_444_44],
        [0.538_469_310_105_683, 0.239_314_335_249_683_23],
        [0.906_179_845_938_664, 0.118_463_442_528_094_54],
    ];
    let point = |clearance: f64, more: &str| {
        case(3.0, [10.0, 10.0], true, more).replace("\"2 mm\"", &format!("\"{clearance} mm\""))
    };
    let more = "[uncertainty]\nclearance = \"± 0.1 mm\"\n[optimize]\nclearance = [\"0.5 mm\", \"1.2 mm\"]\n";
    let found = told(&point(4.0, more), &["optimize"]);
    let robust = &found["robust"];
    let number = |of: &Value| of["value"].as_f64().expect("a number");
    assert_eq!(robust["combinations"], 5, "{robust}");
    assert!(number(&robust["expected"]) <= number(&robust["optimum_expected"]), "{robust}");
    let clearance = 1e3 * robust["optimum"]["clearance"].as_f64().expect("a length");
    let worst_of = |off: f64| {
        let text = point(clearance + off, "[criteria]\npeak_displacement = \"<= 1 m\"\n");
        let checked = told(&text, &["check", "--criteria-only"]);
        let one = &checked["cases"][0]["criteria"][0];
        one["found"].as_f64().expect("a number")
    };
    let sum: f64 = NODES.iter().map(|[node, weight]| weight * worst_of(0.1 * node)).sum();
    let expected = number(&robust["expected"]);
    // Where motions wander at some nodes, runs of other lengths have largest values that differ by a tenth.
    assert!((expected - sum).abs() < 0.05 * sum, "{expected} {sum} {robust}");
    let corner = [-0.1, 0.1].map(worst_of).into_iter().fold(0.0, f64::max);
    let worst = number(&robust["worst_corner"]);
    assert!((worst - corner).abs() < 0.1 * corner, "{worst} {corner}");
    // It is another design than the best as written, which is near an end of what is stable.
    assert!(robust["is_optimum"] == false, "{robust}");
    assert!(expected < 0.9 * number(&robust["optimum_expected"]), "{robust}");
}

/// `--out` writes the page with the sentence and the table of the terminal, whose numbers are those of the JSON, and draws each load
/// that is over a range.
#[test]
fn a_page_has_what_the_terminal_says() {
    let folder = tempdir().expect("a folder");
    let folder = folder.path();
    let second = "[[excitation]]\nkind = \"force\"\nplace = \"tip\"\namplitude = \"0.3 N\"\nfrequency = \"10 Hz\"\n";
    let more = "[criteria]\npeak_displacement = \"<= 0.9 mm\"\n[optimize]\nclearance = [\"0.5 mm\", \"1.2 mm\"]\n[uncertainty]\nclearance = \"± 0.1 mm\"\n";
    let text = case(3.0, [9.8, 10.2], true, &format!("{second}{more}"));
    let text = text.replacen("[excitation]", "[[excitation]]", 1);
    fs::write(folder.join("two.toml"), text).expect("written");
    let run = |arguments: &[&str]| {
        let mut command = Command::cargo_bin("vinesink").expect("built");
        command.current_dir(folder).args(["optimize", "two.toml"]).args(arguments);
        let output = command.output().expect("it runs");
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        String::from_utf8(output.stdout).expect("UTF-8")
    };
    let terminal = run(&["--out", "reports"]);
    let told: Value =
        serde_json::from_str(&run(&["--format", "json", "--out", "other"])).expect("JSON");
    let read = |file: &str| fs::read_to_string(folder.join(file)).expect(file);
    let page = read("reports/two/optimize.md");
    for file in ["optimize.md", "optimize.html", "figures/optimize-loads.svg"] {
        assert_eq!(
            read(&format!("reports/two/{file}")),
            read(&format!("other/two/{file}")),
            "{file}"
        );
    }
    // The first sentence, the table and the rest.
    let bare = |text: &str| {
        let marks = |letter: &char| !letter.is_whitespace() && !"|-─>*`\\".contains(*letter);
        text.chars().filter(marks).collect::<String>()
    };
    let known = bare(&page);
    assert!(terminal.lines().count() > 8, "{terminal}");
    for line in terminal.lines().skip(1) {
        assert!(known.contains(&bare(line)), "{line} is not in\n{page}");
    }
    assert!(page.contains("> **These absorbers meet all criteria: "), "{page}");
    assert!(page.contains("Where numbers are off as [uncertainty] says"), "{page}");
    // Numbers of the JSON: the clearances of all rows, and displacements to the three digits that are shown.
    let rows: Vec<&Value> =
        [&told["own"]].into_iter().chain(told["best"].as_array().expect("a list")).collect();
    let table: Vec<&str> = page.lines().filter(|line| line.contains(" tip ±")).collect();
    for (row, line) in rows.iter().zip(table.iter().skip(1)) {
        let clearance = 1e3 * row["absorbers"][0]["clearance"]["value"].as_f64().expect("a length");
        let clearance = format!("±{} mm", (1e4 * clearance).round() / 1e4);
        assert!(line.contains(&clearance), "{clearance}: {line}");
        for load in row["loads"].as_array().expect("loads") {
            let peak = 1e3 * load["value"].as_f64().expect("a length");
            let shown = if peak < 1.0 { format!("{peak:.3} mm") } else { format!("{peak:.2} mm") };
            assert!(line.contains(&shown), "{shown}: {line}");
        }
    }
    assert_eq!(rows.len(), 4);
    assert_eq!(told["best"][0]["absorbers"][0]["clearance"]["value"], told["optimum"]["clearance"]);
    // One panel: the other load is of one frequency.
    let figure = read("reports/two/figures/optimize-loads.svg");
    assert!(figure.contains("load 1: force at tip") && !figure.contains("load 2"), "{figure}");
    assert!(
        figure.contains("the case's own absorbers") && figure.contains(">the best<"),
        "{figure}"
    );
    assert!(page.contains("a load of one frequency has no panel"), "{page}");
    // A report beside it leaves them.
    let of = |file: &str| vinesink::report::render::is_of_report(file.as_ref());
    assert!(!of("figures/optimize-loads.svg") && !of("optimize.md") && of("figures/loads.svg"));
    assert!(!read("reports/two/optimize.html").contains("class=\"table tiles\""));
}
