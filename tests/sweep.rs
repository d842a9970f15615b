//! `vinesink sweep`: points and columns, the same bytes whatever happens on the way.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::Duration;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, Row};
use tempfile::TempDir;

use vinesink::band::simulated::{Effort, motions};
use vinesink::case::{Case, SweepParameter};
use vinesink::orbits::attracting_orbit;
use vinesink::sweep::Plan;

/// Table 1 of Li, Seguy, Berlioz (2016), hardly simulated, over two chunks and a bit.
fn text(clearances: u32, frequencies: u32) -> String {
    format!(
        "title = \"a map\"\nsource = \"Table 1 of Li, Seguy, Berlioz 2016\"\n\
         [oscillator]\nmass = \"4.168 kg\"\nstiffness = \"11.47 kN/m\"\ndamping = \"3.02 N s/m\"\n\
         [absorber]\nmass = \"32 g\"\nclearance = \"20 mm\"\nrestitution = 0.6\n\
         [excitation]\nkind = \"base-displacement\"\namplitude = \"0.25 mm\"\nfrequency = \"8.35 Hz\"\n\
         [sweep]\nstarts = 1\nperiods = 48\n\
         clearance = {{ from = \"5 mm\", to = \"40 mm\", count = {clearances}, scale = \"logarithmic\" }}\n\
         frequency = {{ from = \"8 Hz\", to = \"8.7 Hz\", count = {frequencies} }}\n"
    )
}

fn plan(text: &str) -> Plan {
    let case = Case::parse("map.toml", text).unwrap_or_else(|error| panic!("{error:?}"));
    Plan::of(&case).expect("a table [sweep]")
}

/// A folder with a case of `clearances` times 64 points.
fn folder(clearances: u32) -> TempDir {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("map.toml"), text(clearances, 64)).expect("written");
    folder
}

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vinesink"));
    command.current_dir(folder).arg("sweep").args(arguments);
    command.env_remove("SLURM_ARRAY_TASK_ID").env_remove("HQ_TASK_ID");
    command
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().expect("it runs")
}

fn done(folder: &Path, arguments: &[&str]) {
    let output = run(folder, arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {output:?}");
}

fn merged(folder: &Path) -> PathBuf {
    folder.join("sweeps/map/sweep.parquet")
}

fn chunk(folder: &Path, number: u64) -> PathBuf {
    folder.join(format!("sweeps/map/chunks/{number:09}.parquet"))
}

fn rows(path: &Path) -> Vec<Row> {
    let reader = SerializedFileReader::new(fs::File::open(path).expect("there")).expect("Parquet");
    reader.get_row_iter(None).expect("rows").map(|row| row.expect("a row")).collect()
}

fn number(row: &Row, name: &str) -> Option<f64> {
    match row.get_column_iter().find(|(column, _)| *column == name).expect(name).1 {
        Field::Double(value) => Some(*value),
        Field::Long(value) => Some(*value as f64),
        Field::Null => None,
        other => panic!("{name} is {other}"),
    }
}

/// Every combination once, both ends of each axis, the last axis fastest.
#[test]
fn points_cover_the_grid_once() {
    let plan = plan(&text(5, 3));
    assert_eq!((plan.points(), plan.chunks()), (15, 1));
    let clearance = |point: u64| plan.point(point).coordinates[0];
    let frequency = |point: u64| plan.point(point).coordinates[1];
    // Five values from 5 to 40 mm, eight times as much: each 8^(1/4) times the one before.
    for point in 0..15 {
        let wanted = 0.005 * libm::pow(8.0, (point / 3) as f64 / 4.0);
        assert!((clearance(point) - wanted).abs() < 1e-14, "{point}");
    }
    assert!((frequency(1) - 8.35).abs() < 1e-14);
    assert_eq!(frequency(1), frequency(13));
    assert_eq!(plan.settings.axes[0].parameter, SweepParameter::Clearance);
    assert_eq!((plan.chunk(0), plan.chunk(1)), (0..15, 15..15));
}

/// What is written of a point is what the layers say of its system alone.
#[test]
fn a_row_is_what_the_layers_say_of_its_system() {
    let folder = folder(3);
    done(folder.path(), &["map.toml"]);
    let plan = plan(&text(3, 64));
    let rows = rows(&merged(folder.path()));
    assert_eq!(rows.len() as u64, plan.points());
    let mut orbits = 0;
    for (point, row) in rows.iter().enumerate().step_by(17) {
        let one = plan.point(point as u64);
        let (system, clearance) = (one.system.expect("valid"), one.coordinates[0]);
        let length = |over_clearance: f64| clearance * over_clearance;
        let same = |name: &str, wanted: Option<f64>| {
            let found = number(row, name);
            let near = found.zip(wanted).map(|(a, b)| (a - b).abs() <= 1e-12 * b.abs());
            assert!(near.unwrap_or(found == wanted), "{point} {name}: {found:?} {wanted:?}");
        };
        same("point", Some(point as f64));
        same("clearance", Some(clearance));
        let orbit = attracting_orbit(&system).map(|orbit| length(orbit.peaks.displacement));
        orbits += u32::from(orbit.is_some());
        same("orbit_peak", orbit);
        let bare = system.linear_response().expect("damped").amplitude();
        same("bare_amplitude", Some(length(bare)));
        let alone = motions(&[system], &Effort { starts: 1, periods: 48 }).expect("finite");
        same("motions", Some(alone[0].len() as f64));
        same("peak", Some(length(alone[0][0].peak)));
        same("rms", Some(length(alone[0][0].rms)));
        same("efficiency", alone[0][0].efficiency);
    }
    assert!(orbits > 2, "{orbits}");
}

/// Chunk by chunk in any order, on one processor or on two, killed on the way or not: the same bytes.
#[test]
fn a_killed_run_ends_in_the_same_bytes() {
    let unbroken = folder(40);
    done(unbroken.path(), &["map.toml"]);
    let expected = fs::read(merged(unbroken.path())).expect("merged");
    let chunks = plan(&text(40, 64)).chunks();
    assert_eq!(chunks, 3);
    let broken = folder(40);
    for pause in [5, 40, 90, 160] {
        let mut running = command(broken.path(), &["map.toml"]).spawn().expect("it starts");
        std::thread::sleep(Duration::from_millis(pause));
        running.kill().expect("killed, or done before");
        running.wait().expect("ended");
    }
    done(broken.path(), &["map.toml"]);
    assert!(fs::read(merged(broken.path())).expect("merged") == expected);
    // One by one, the last first, as engines number them.
    let apart = folder(40);
    for (k, number) in (0..chunks).rev().enumerate() {
        let name = ["SLURM_ARRAY_TASK_ID", "HQ_TASK_ID"][k % 2];
        let mut one = command(apart.path(), &["run", "map.toml"]);
        let output = one.env(name, number.to_string()).output().expect("it runs");
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        assert!(chunk(apart.path(), number).is_file());
        let left = run(apart.path(), &["status", "map.toml"]).status.code();
        assert_eq!(left, Some(i32::from(number > 0)));
    }
    done(apart.path(), &["merge", "map.toml"]);
    assert!(fs::read(merged(apart.path())).expect("merged") == expected);
}

/// A chunk that is damaged, cut short, or of another sweep is found and done again.
#[test]
fn damaged_and_foreign_chunks_are_done_again() {
    let folder = folder(20);
    done(folder.path(), &["map.toml"]);
    let expected = fs::read(merged(folder.path())).expect("merged");
    let path = chunk(folder.path(), 1);
    let whole = fs::read(&path).expect("a chunk");
    let mut flipped = whole.clone();
    flipped[whole.len() / 2] ^= 1;
    for damaged in [&flipped[..], &whole[..whole.len() - 7], &[]] {
        fs::write(&path, damaged).expect("written");
        assert_eq!(run(folder.path(), &["status", "map.toml"]).status.code(), Some(1));
        let output = run(folder.path(), &["merge", "map.toml"]);
        assert_eq!(output.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&output.stderr).contains("chunk 1"), "{output:?}");
        done(folder.path(), &["map.toml"]);
        assert!(fs::read(merged(folder.path())).expect("merged") == expected);
    }
    // The same name, another case: nothing of it counts.
    let other = text(20, 64).replace("0.6", "0.7");
    fs::write(folder.path().join("map.toml"), other).expect("written");
    let output = run(folder.path(), &["status", "map.toml"]);
    assert!(String::from_utf8_lossy(&output.stdout).starts_with("0 of"), "{output:?}");
    done(folder.path(), &["map.toml"]);
    assert!(fs::read(merged(folder.path())).expect("merged") != expected);
}

#[test]
fn what_cannot_be_swept_is_refused_with_what_to_write() {
    let whole = text(3, 3);
    for (from, to, message) in [
        ("from = \"5 mm\"", "from = \"50 mm\"", "not below its `to`"),
        ("count = 3, ", "", "`count` is missing"),
        ("count = 3, ", "count = 1, ", "`count` is 1"),
        ("\"logarithmic\"", "\"log\"", "`scale` is \"log\""),
        ("\"8.7 Hz\"", "\"8.7 mm\"", "unit of a length"),
        ("starts = 1", "starts = 0", "`starts` is 0"),
        ("starts = 1", "start = 1", "unknown key `start`"),
    ] {
        let text = whole.replace(from, to);
        assert_ne!(text, whole, "{from}");
        let error = Case::parse("map.toml", &text).expect_err(to);
        let said: Vec<String> = error.problems().map(|one| one.message.clone()).collect();
        assert!(said.iter().any(|one| one.contains(message)), "{to}: {said:?}");
    }
    let head = whole.split("[sweep]").next().expect("a case");
    let error = Case::parse("map.toml", &format!("{head}[sweep]\n")).expect_err("nothing varies");
    assert!(error.problems().any(|one| one.message.contains("varies nothing")), "{error:?}");
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("map.toml"), head).expect("written");
    let output = run(folder.path(), &["map.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("[sweep]"), "{output:?}");
}
