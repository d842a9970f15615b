//! `vinesink sweep` over structures that are not driven steadily: each number is the one that `simulate` has for the
//! case of the point.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;
use vinesink::case::Case;
use vinesink::sweep::Plan;
use vinesink::sweep::columns::Cell;
use vinesink::sweep::work;

use super::run::{refused, vinesink};

const JUMP: &str = "cases/footbridge-jump.toml";
const SWEEP: &str = "cases/sweep-fast.toml";
const TOWER: &str = "cases/tower-record.toml";
const SPECTRUM: &str =
    "spectrum = [[0.2, 0.02], [1.0, 0.02]]\nduration = \"20 s\"\nseed = 3\nrealisations = 3\n";
const FILE: &str = "file = \"tower-record.csv\"     # beside this file: time and acceleration\n";
/// The first 5 s of the record.
const LINES: usize = 204;

/// A case without what comes behind its criteria.
fn text(path: &str) -> String {
    let text = fs::read_to_string(path).expect("the case");
    text.split("\n[optimize]").next().unwrap_or_default().to_owned()
}

/// A folder with a record of two swings.
fn folder() -> TempDir {
    let folder = TempDir::new().expect("a folder");
    let record = fs::read_to_string("cases/tower-record.csv").expect("the record");
    let lines: Vec<&str> = record.lines().take(LINES).collect();
    fs::write(folder.path().join("tower-record.csv"), lines.join("\n")).expect("written");
    folder
}

fn written(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    fs::write(&path, text).expect("written");
    path.to_str().expect("UTF-8").to_owned()
}

/// What `simulate` says of a case: its quantities.
fn simulated(folder: &Path, text: &str) -> Value {
    let output = vinesink(&["simulate", &written(folder, "one.toml", text), "--format", "json"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    found["quantities"].clone()
}

/// A table of results: heads without units, and rows.
fn swept(folder: &Path, text: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let [case, out] = [written(folder, "map.toml", text), folder.join("out").display().to_string()];
    let output = vinesink(&["sweep", &case, "--csv", "--out", &out]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let csv = fs::read_to_string(folder.join("out/map/sweep.csv")).expect("results");
    let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<String>>();
    let names = csv.lines().next().expect("a head").split(',');
    let names = names.map(|name| name.split(" [").next().unwrap_or_default().to_owned());
    (names.collect(), csv.lines().skip(1).map(cells).collect())
}

/// Sweeps a case over its clearance with some columns, each with the identifier that `simulate` has for it, and holds
/// every cell against `simulate`, to the last bit.
fn holds(case: &str, own: &str, clearances: [&str; 2], columns: &[(&str, &str)]) {
    let folder = folder();
    let names: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
    let [one, other] = clearances;
    let axis = format!("clearance = {{ values = [\"{one}\", \"{other}\"] }}\nrecord = {names:?}\n");
    let case = format!("{case}\n[simulation]\nstarts = 3\n");
    let (heads, rows) = swept(folder.path(), &format!("{case}[sweep]\n{axis}"));
    assert_eq!(heads[..2], ["point", "clearance"]);
    assert_eq!(heads[2..], names);
    assert_ne!(rows[0][2], rows[1][2], "the clearance decides");
    for (clearance, row) in clearances.iter().zip(&rows) {
        let changed = case.replace(own, &format!("clearance = \"{clearance}\""));
        assert_ne!(changed, case);
        let wanted = simulated(folder.path(), &changed);
        for (k, (name, id)) in columns.iter().enumerate() {
            let found: f64 = row[k + 2].parse().expect("a number");
            assert_eq!(Some(found), wanted[id]["value"].as_f64(), "{clearance}: {name}");
        }
    }
}

#[test]
fn a_release_is_what_simulate_says() {
    let columns = [
        ("decay_time", "decay_time"),
        ("bare_decay_time", "bare_decay_time"),
        ("damper_decay_time", "damper_decay_time"),
        ("theory_decay_time", "theory_decay_time"),
        ("peak", "peak_displacement"),
        ("impact_speed", "impact_speed"),
        ("impacts", "impact_count"),
    ];
    holds(&text(JUMP), "clearance = \"3 mm\"", ["2 mm", "5 mm"], &columns);
    // Let go, where some places of the absorber never wake it.
    let free = text(JUMP).replace("\"impulse\"", "\"free\"");
    let free = free.replace("impulse = \"150 N s\"", "displacement = \"3 mm\"");
    let columns = [("inactive_share", "inactive_share"), ("decay_time", "decay_time")];
    holds(&free, "clearance = \"3 mm\"", ["4 mm", "6 mm"], &columns);
}

#[test]
fn a_sweep_through_resonance_is_what_simulate_says() {
    let columns = [
        ("peak", "peak_displacement"),
        ("peak_frequency", "peak_frequency"),
        ("bare_peak", "bare_peak"),
        ("damper_peak", "damper_peak"),
        ("reduction_db", "reduction_db"),
        ("reduction_db_tmd", "reduction_db_tmd"),
        ("impact_speed", "impact_speed"),
        ("impacts", "impact_count"),
    ];
    holds(&text(SWEEP), "clearance = \"7.5 mm\"", ["5 mm", "10 mm"], &columns);
}

#[test]
fn a_record_is_what_simulate_says() {
    let alike = ["bare_peak", "bare_rms", "damper_peak", "damper_rms"];
    let mut columns: Vec<(&str, &str)> = alike.map(|name| (name, name)).into();
    columns.push(("impacts", "impact_count"));
    let one = [
        ("peak", "peak_displacement"),
        ("rms", "largest_rms"),
        ("impact_speed", "impact_speed"),
        ("reduction_db", "reduction_db"),
        ("reduction_db_tmd", "reduction_db_tmd"),
    ];
    let all = [&one[..], &columns].concat();
    holds(&text(TOWER), "clearance = \"100 mm\"", ["20 mm", "60 mm"], &all);
    let several = [
        ("peak", "mean_peak"),
        ("rms", "rms_displacement"),
        ("impact_speed", "mean_impact_speed"),
        ("reduction_db", "mean_reduction_db"),
        ("reduction_db_tmd", "mean_reduction_db_tmd"),
    ];
    let noise = text(TOWER).replace(FILE, SPECTRUM);
    holds(&noise, "clearance = \"100 mm\"", ["20 mm", "60 mm"], &[&several[..], &columns].concat());
}

/// Velocities and accelerations, where a criterion asks `simulate` for them; nothing else changes by that.
#[test]
fn velocities_are_what_simulate_says() {
    let asked = |text: String| {
        let line = "[criteria]\npeak_velocity = \"<= 9 m/s\"\n";
        match text.contains("[criteria]\n") {
            true => text.replace("[criteria]\n", line),
            false => format!("{text}\n{line}"),
        }
    };
    let peaks = [("peak_velocity", "peak_velocity"), ("acceleration", "peak_acceleration")];
    let jump = [("decay_time", "decay_time"), peaks[0], peaks[1]];
    holds(&asked(text(JUMP)), "clearance = \"3 mm\"", ["2 mm", "5 mm"], &jump);
    holds(&asked(text(SWEEP)), "clearance = \"7.5 mm\"", ["5 mm", "10 mm"], &peaks);
    let one = [
        ("rms_velocity", "largest_rms_velocity"),
        ("rms_acceleration", "largest_rms_acceleration"),
        peaks[0],
        peaks[1],
    ];
    holds(&asked(text(TOWER)), "clearance = \"100 mm\"", ["20 mm", "60 mm"], &one);
    let several = [
        ("peak_velocity", "mean_peak_velocity"),
        ("acceleration", "mean_peak_acceleration"),
        ("rms_velocity", "rms_velocity"),
        ("rms_acceleration", "rms_acceleration"),
    ];
    let noise = asked(text(TOWER).replace(FILE, SPECTRUM));
    holds(&noise, "clearance = \"100 mm\"", ["20 mm", "60 mm"], &several);
    // `simulate` has them where they are asked for, and all else as it was.
    let folder = folder();
    let [plain, more] = [text(JUMP), asked(text(JUMP))].map(|one| {
        let short = format!("{one}\n[simulation]\nstarts = 3\n");
        simulated(folder.path(), &short)
    });
    let mut more = more.as_object().expect("quantities").clone();
    assert!(more.remove("peak_velocity").is_some() && more.remove("peak_acceleration").is_some());
    assert_eq!(&more, plain.as_object().expect("quantities"));
}

/// The results of all points, without the axes.
fn results(text: &str, axes: usize) -> Vec<Option<Cell>> {
    let case = Case::parse("map.toml", text).unwrap_or_else(|error| panic!("{error:?}"));
    let plan = Plan::of(&case).expect("a table [sweep]");
    let columns = work::points(&plan, 0..plan.points()).expect("worked out");
    columns[1 + axes..].iter().flat_map(|column| column.cells.clone()).collect()
}

/// Every number that fits the kind can be an axis, and is then what the case would say in its place.
#[test]
fn an_axis_is_what_the_case_would_say() {
    let jump = text(JUMP)
        .replace("frequency = \"2 Hz\"", "stiffness = \"630 kN/m\"")
        .replace("\"0.4 Hz\"", "\"0.1 Hz\"")
        .replace("support_room = \"2 m\"", "support_room = \"30 m\"");
    let jump = jump.replace("damping_ratio = \"0.5 %\"", "damping = \"500 N s/m\"");
    let shaken = jump.replace("impulse = \"150 N s\"", "velocity = \"37.5 mm/s\"");
    let free = jump.replace("\"impulse\"", "\"free\"");
    let free = free.replace("impulse = \"150 N s\"", "displacement = \"3 mm\"");
    let tower =
        text(TOWER).replace(FILE, SPECTRUM).replace("mass_ratio = \"3 %\"", "mass = \"6 t\"");
    let tower = tower.replace("frequency = \"0.5 Hz\"", "stiffness = \"2 MN/m\"");
    let tower = tower.replace("damping_ratio = \"1 %\"", "damping = \"12 kN s/m\"");
    let (sweep, octaves) = (text(SWEEP), text(SWEEP).replace("0.1 Hz/s", "0.8 oct/min"));
    for (case, axis, own, other) in [
        (&jump, "amplitude", "impulse = \"150 N s\"", "impulse = \"200 N s\""),
        (&jump, "mass", "mass = \"4 t\"", "mass = \"4.7 t\""),
        (&shaken, "amplitude", "velocity = \"37.5 mm/s\"", "velocity = \"50 mm/s\""),
        // So much softer that the natural frequency decides how a matrix exponential is rounded.
        (&shaken, "stiffness", "stiffness = \"630 kN/m\"", "stiffness = \"50 kN/m\""),
        (&free, "initial_displacement", "displacement = \"3 mm\"", "displacement = \"5 mm\""),
        (&sweep, "amplitude", "amplitude = \"0.25 mm\"", "amplitude = \"0.5 mm\""),
        (&sweep, "rate", "rate = \"0.1 Hz/s\"", "rate = \"0.15 Hz/s\""),
        (&octaves, "rate", "rate = \"0.8 oct/min\"", "rate = \"1 oct/min\""),
        (&sweep, "restitution", "restitution = 0.6", "restitution = 0.7"),
        (&tower, "mass", "mass = \"200 t\"", "mass = \"250 t\""),
    ] {
        let changed = case.replacen(own, other, 1);
        assert_ne!(&changed, case, "{own}");
        let (_, value) = other.split_once(" = ").expect("a line");
        let own_clearance = case.lines().find(|line| line.starts_with("clearance = "));
        let clearance = own_clearance.and_then(|line| line.split('"').nth(1)).expect("a clearance");
        let settings = "[sweep]\nstarts = 2\n";
        let varied = format!("{case}\n{settings}{axis} = {{ values = [{value}] }}\n");
        let wanted = format!("{changed}\n{settings}clearance = {{ values = [\"{clearance}\"] }}\n");
        let found = results(&varied, 1);
        assert!(found.iter().all(Option::is_some), "{axis}: {found:?}");
        assert_eq!(found, results(&wanted, 1), "{axis}");
        assert_ne!(found, results(&wanted.replace(other, own), 1), "{axis}");
    }
}

#[test]
fn what_has_no_meaning_is_refused() {
    let with = |case: &str, table: &str| format!("{}\n[sweep]\n{table}\n", text(case));
    let clearance = "clearance = { values = [\"3 mm\"] }";
    let jump = with(JUMP, clearance);
    refused(
        "sweep",
        &jump,
        &[
            (
                clearance,
                "frequency = { values = [\"2 Hz\"] }",
                "a structure that is released or struck has no `frequency` to vary",
            ),
            (
                clearance,
                "initial_velocity = { values = [\"2 m/s\"] }",
                "has no `initial_velocity` to vary",
            ),
            (
                clearance,
                "amplitude = { values = [\"2 mm\"] }",
                "is an impulse, but `mm` is the unit of a length",
            ),
            (
                "[sweep]",
                "[sweep]\nrecord = [\"efficiency\"]",
                "`efficiency` has no meaning for a structure that is released",
            ),
            ("[sweep]", "[sweep]\nfollow = \"clearance\"", "`follow` has no meaning"),
            ("[sweep]", "[sweep]\nperiods = 100", "`periods` has no meaning"),
        ],
    );
    let sweep = with(SWEEP, clearance);
    refused(
        "sweep",
        &sweep,
        &[
            (
                "[sweep]",
                "[sweep]\nrecord = [\"decay_time\"]",
                "`decay_time` has no meaning for a structure that is swept",
            ),
            (
                clearance,
                "rate = { values = [\"1 oct/min\"] }",
                "is in `oct/min`, and the case's own is not",
            ),
            (clearance, "frequency = { values = [\"8 Hz\"] }", "has no `frequency` to vary"),
        ],
    );
    let tower = with(TOWER, clearance).replace(FILE, SPECTRUM);
    refused(
        "sweep",
        &tower,
        &[
            (
                clearance,
                "amplitude = { values = [\"8 mm\"] }",
                "a structure that is driven by a record has no `amplitude` to vary",
            ),
            (
                "[sweep]",
                "[sweep]\nrecord = [\"peak_frequency\"]",
                "`peak_frequency` has no meaning",
            ),
        ],
    );
    let steady = text("cases/li2016-map.toml");
    refused(
        "sweep",
        &steady,
        &[("[sweep]", "[sweep]\nrate = { values = [\"1 Hz/s\"] }", "has no `rate` to vary")],
    );
}

/// A record that is another one makes other results, though the case is the same; dearer points make smaller chunks.
#[test]
fn results_belong_to_their_record_and_chunks_to_their_work() {
    let case = format!("{}\n[sweep]\nclearance = {{ values = [\"50 mm\"] }}\n", text(TOWER));
    let plan = |record: &str| {
        let case = Case::parse("map.toml", &case).expect("a case");
        let case = case.with_record("record.csv", record).expect("a record");
        Plan::of(&case).expect("a table [sweep]")
    };
    let record = fs::read_to_string("cases/tower-record.csv").expect("the record");
    let own = plan(&record);
    assert_eq!(own.identity, plan(&record).identity);
    assert_ne!(own.identity, plan(&record.replace("40.000,-0.0007", "40.000,-0.0008")).identity);
    let many = format!("{case}clearance",)
        .replace("values = [\"50 mm\"]", "from = \"1 mm\", to = \"2 mm\", count = 5000");
    let many = many.trim_end_matches("clearance").to_owned();
    let noise = |seconds: u32| {
        let text = many.replace(FILE, &SPECTRUM.replace("20 s", &format!("{seconds} s")));
        let case = Case::parse("map.toml", &text).unwrap_or_else(|error| panic!("{error:?}"));
        Plan::of(&case).expect("a table [sweep]")
    };
    let [short, long] = [20, 2000].map(noise);
    let seconds = |plan: &Plan| plan.seconds(&plan.point(0)).expect("known");
    assert!((seconds(&long) / seconds(&short) - 100.0).abs() < 1.0);
    for plan in [&short, &long] {
        let chunk = seconds(plan) * plan.points_per_chunk() as f64;
        assert!(chunk < 1.0 || plan.points_per_chunk() == 1, "{chunk}");
    }
    assert!(long.points_per_chunk() < short.points_per_chunk());
}

/// The page tells what comes to rest first and last; nothing of regimes.
#[test]
fn a_page_of_decays_has_no_regimes() {
    let folder = folder();
    let table = "[sweep]\nstarts = 2\nclearance = { values = [\"1 mm\", \"2 mm\", \"6 mm\"] }\n";
    swept(folder.path(), &format!("{}\n{table}", text(JUMP)));
    let page = fs::read_to_string(folder.path().join("out/map/sweep.md")).expect("a page");
    assert!(page.contains("The structure comes to rest first, after "), "{page}");
    assert!(page.contains("from 2 places of the absorber in its cavity"), "{page}");
    for other in ["regime", "excitation periods", "main motion"] {
        assert!(!page.contains(other), "{other}: {page}");
    }
    for name in ["sweep-decay-time", "sweep-amplitude"] {
        let drawing = folder.path().join(format!("out/map/figures/{name}.svg"));
        let there = fs::read_to_string(&drawing).is_ok_and(|text| text.contains("</svg>"));
        assert_eq!(there, name == "sweep-decay-time", "{name}");
    }
}

/// A design without units has the same axes, in its own: how far it is let go, how hard it is struck, how fast it is swept.
#[test]
fn a_reduced_case_is_swept_as_a_physical_one() {
    let case = |kind: &str| {
        format!(
            "title = \"t\"\nsource = \"s\"\n[reduced]\nmass_ratio = 0.015\ndamping = 0.67\nrestitution = 0.6\n\
             clearance = 1.0\n{kind}\n[simulation]\nstarts = 3\n"
        )
    };
    let swept_from =
        "kind = \"sine-sweep\"\nof = \"force\"\nforcing = 2.0\nfrom = 0.95\nto = 1.05\n";
    let kinds = [
        ("kind = \"free\"\n", "displacement", "initial_displacement", ["3", "5"], "decay_time"),
        ("kind = \"impulse\"\n", "impulse", "amplitude", ["3", "5"], "decay_time"),
        ("kind = \"impulse\"\n", "velocity", "amplitude", ["3", "5"], "decay_time"),
        (swept_from, "rate", "rate", ["0.0001", "0.0002"], "peak"),
    ];
    for (kind, key, axis, values, recorded) in kinds {
        let folder = folder();
        let own = |value: &str| case(&format!("{kind}{key} = {value}"));
        let [first, last] = values;
        let table = format!(
            "[sweep]\n{axis} = {{ values = [{first}, {last}] }}\nrecord = [\"{recorded}\"]\n"
        );
        let (heads, rows) = swept(folder.path(), &(own(first) + &table));
        assert_eq!(heads, ["point", axis, recorded]);
        assert_ne!(rows[0][2], rows[1][2], "{axis}");
        let id = if recorded == "peak" { "peak_displacement" } else { recorded };
        for (value, row) in values.iter().zip(&rows) {
            let found: f64 = row[2].parse().expect("a number");
            let wanted = simulated(folder.path(), &own(value));
            assert_eq!(Some(found), wanted[id]["value"].as_f64(), "{key} {value}");
        }
    }
}
