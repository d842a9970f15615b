//! `vinesink sweep`: points and columns, the same bytes whatever happens on the way.

use crate::common;
use std::fs;
use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::Duration;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, Row};
use tempfile::TempDir;

use vinesink::analysis::Analysis;
use vinesink::case::{Case, Recorded};
use vinesink::excitation::Scene;
use vinesink::executor::Serial;
use vinesink::motions::{Effort, Motion, Motions, Place};
use vinesink::operation_count;
use vinesink::orbits::{Measures, Orbit, steady_orbit, two_impact_orbits};
use vinesink::simulation::Simulation;
use vinesink::sweep::{Plan, work};
use vinesink::system::{Parameter, System};

fn motions(place: &Place, periods: u64) -> Motions {
    let places = std::slice::from_ref(place);
    let found = vinesink::motions::motions(places, &Effort::over(periods), &Serial);
    found.expect("finite").remove(0)
}

/// Table 1 of Li, Seguy, Berlioz (2016), hardly simulated, over two chunks and a bit.
fn text(clearances: u32, frequencies: u32) -> String {
    format!(
        "{}[sweep]\nstarts = 1\nperiods = 48\n\
         clearance = {{ from = \"5 mm\", to = \"40 mm\", count = {clearances}, scale = \"logarithmic\" }}\n\
         frequency = {{ from = \"8 Hz\", to = \"8.7 Hz\", count = {frequencies} }}\n",
        common::table_1_case()
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
    assert_eq!(plan.settings.axes[0].parameter, Parameter::Clearance);
    assert_eq!((plan.chunk(0), plan.chunk(1)), (0..15, 15..15));
    let chunks = self::plan(&text(40, 64));
    assert_eq!([0, 1, 2].map(|k| chunks.chunk(k)), [0..1024, 1024..2048, 2048..2560]);
    // Axes are in the order of the file.
    let turned = "frequency = { values = [\"8 Hz\"] }\nclearance = { values = [\"9 mm\"] }\n";
    let turned = self::plan(&sweeping(turned));
    assert_eq!(turned.settings.axes[0].parameter, Parameter::Frequency);
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
        let orbit = steady_orbit(&system).map(|orbit| length(orbit.peaks.displacement));
        orbits += u32::from(orbit.is_some());
        same("orbit_peak", orbit);
        let bare = system.linear_response().expect("damped").amplitude();
        same("bare_amplitude", Some(length(bare)));
        let alone = motions(&Place::new(&system, 1), 48);
        let facts = alone.main().expect("one").facts();
        same("motions", Some(alone.counting(true).count() as f64));
        same("peak", Some(length(facts.peak.value)));
        same("rms", Some(length(facts.rms.value)));
        same("efficiency", facts.efficiency.map(|share| share.value));
    }
    assert!(orbits > 2, "{orbits}");
}

/// Chunk by chunk in any order, on one processor or on two, killed on the way or not: the same bytes.
/// `VINESINK_KILLS` says at how many random moments, 6 unless set.
#[test]
fn a_killed_run_ends_in_the_same_bytes() {
    let unbroken = folder(40);
    done(unbroken.path(), &["map.toml"]);
    let expected = fs::read(merged(unbroken.path())).expect("merged");
    let chunks = plan(&text(40, 64)).chunks();
    assert_eq!(chunks, 3);
    let kills = std::env::var("VINESINK_KILLS").map_or(6, |kills| kills.parse().expect("a number"));
    let mut random = 1_u64;
    let mut cut_short = 0;
    for kill in 0..kills {
        // Anywhere in the run, by Knuth's generator (MMIX), so that a failure comes again.
        random =
            random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let part = (random >> 33) as f64 / (1_u64 << 31) as f64;
        let broken = folder(40);
        let mut running = command(broken.path(), &["map.toml"]).spawn().expect("it starts");
        // When so many files of its six are there, and a little later.
        let chunks = broken.path().join("sweeps/map/chunks");
        let there = || fs::read_dir(&chunks).map_or(0, Iterator::count);
        while there() < (6.0 * part) as usize && running.try_wait().expect("asked").is_none() {
            std::thread::sleep(Duration::from_micros(200));
        }
        std::thread::sleep(Duration::from_micros((50_000.0 * part * part) as u64));
        running.kill().expect("killed, or done before");
        running.wait().expect("ended");
        cut_short += u32::from(!merged(broken.path()).exists());
        if kill == 0 {
            // As a process that is killed while it writes leaves it.
            let half = broken.path().join("sweeps/map/chunks/.vinesink-half");
            fs::create_dir_all(half.parent().expect("a folder")).expect("made");
            fs::write(half, "PAR1").expect("written");
        }
        done(broken.path(), &["map.toml"]);
        assert!(fs::read(merged(broken.path())).expect("merged") == expected, "{kill}");
        let left = |folder: &Path| {
            let names =
                fs::read_dir(folder).expect("there").map(|one| one.expect("read").file_name());
            names.filter(|name| name.to_string_lossy().starts_with('.')).count()
        };
        let folder = broken.path().join("sweeps/map");
        assert_eq!((left(&folder), left(&folder.join("chunks"))), (0, 0), "{kill}");
    }
    assert!(cut_short > 0, "every run was done before it was killed");
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
        ("starts = 1", "follow = \"damping\"", "`follow` is \"damping\""),
        ("starts = 1", "starts = 1\nfollow = \"clearance\"", "`starts` has no meaning"),
        ("starts = 1", "record = [\"peek\"]", "a value of `record` is \"peek\""),
        ("starts = 1", "record = []", "`record` is empty"),
        (
            "starts = 1",
            "follow = \"clearance\"\nrecord = [\"motions\"]",
            "`motions` has no meaning where a motion is followed",
        ),
        ("starts = 1", "starts = 1\ndetuning = { values = [1.0] }", "no `detuning` to vary"),
        (
            "starts = 1",
            "starts = 1\nmass_ratio = { values = [0.1] }\nabsorber_mass = { values = [\"1 g\"] }",
            "say the same thing twice",
        ),
        ("count = 3, ", "count = 3, values = [], ", "both say what the axis holds"),
        (
            "{ from = \"8 Hz\", to = \"8.7 Hz\", count = 3 }",
            "{ values = [\"8.7 Hz\", \"8 Hz\"] }",
            "do not rise",
        ),
        (
            "{ from = \"8 Hz\", to = \"8.7 Hz\", count = 3 }",
            "{ values = [\"8 mm\"] }",
            "a value of `values` is a frequency, but `mm` is the unit of a length",
        ),
    ] {
        let text = whole.replace(from, to);
        assert_ne!(text, whole, "{from}");
        let error = Case::parse("map.toml", &text).expect_err(to);
        let said: Vec<String> = error.problems().map(|one| one.message.clone()).collect();
        assert!(said.iter().any(|one| one.contains(message)), "{to}: {said:?}");
    }
    let head = common::table_1_case();
    let error = Case::parse("map.toml", &format!("{head}[sweep]\n")).expect_err("nothing varies");
    assert!(error.problems().any(|one| one.message.contains("varies nothing")), "{error:?}");
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("map.toml"), head).expect("written");
    let output = run(folder.path(), &["map.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("[sweep]"), "{output:?}");
}

/// A sweep in a folder of its own, and its results as CSV, by column.
fn swept(text: &str) -> Vec<(String, Vec<String>)> {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("map.toml"), text).expect("written");
    done(folder.path(), &["map.toml", "--csv"]);
    let csv = fs::read_to_string(folder.path().join("sweeps/map/sweep.csv")).expect("written");
    let mut lines = csv.lines().map(|line| line.split(','));
    let names = lines.next().expect("a header");
    let mut columns: Vec<(String, Vec<String>)> = names.map(|n| (n.to_owned(), vec![])).collect();
    for line in lines {
        for (column, field) in columns.iter_mut().zip(line) {
            column.1.push(field.to_owned());
        }
    }
    columns
}

fn column<'a>(columns: &'a [(String, Vec<String>)], name: &str) -> &'a [String] {
    let found = columns.iter().find(|(known, _)| known == name);
    let names = || columns.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", ");
    &found.unwrap_or_else(|| panic!("{name} is none of {}", names())).1
}

fn numbers(columns: &[(String, Vec<String>)], name: &str) -> Vec<f64> {
    column(columns, name).iter().map(|field| field.parse().unwrap_or(f64::NAN)).collect()
}

/// The design of [`text`] with another table `[sweep]`.
fn sweeping(table: &str) -> String {
    format!("{}[sweep]\n{table}", common::table_1_case())
}

/// They are those that a criterion has, whether a motion is found from starts or followed; a sweep that does not name them
/// has none.
#[test]
fn velocities_are_recorded_where_they_are_named() {
    let names = ["peak_velocity", "rms_velocity", "acceleration", "rms_acceleration"];
    let axis = format!("clearance = {{ values = [\"4 mm\", \"5 mm\"] }}\nrecord = {names:?}\n");
    let found = swept(&sweeping(&axis));
    let followed = swept(&sweeping(&format!("follow = \"clearance\"\n{axis}")));
    let limits = "[criteria]\npeak_velocity = \"<= 1 m/s\"\nrms_velocity = \"<= 1 m/s\"\n\
        acceleration = \"<= 9 g\"\nrms_acceleration = \"<= 9 g\"\n";
    let text = format!("{}{limits}", common::table_1_case());
    for (row, clearance) in ["4 mm", "5 mm"].into_iter().enumerate() {
        let own = text.lines().find(|line| line.starts_with("clearance =")).expect("its own");
        let text = text.replace(own, &format!("clearance = \"{clearance}\""));
        let case = Case::parse("one.toml", &text).expect("valid");
        let settings = vinesink::criteria::settings(&case);
        let survey = vinesink::band::Survey::of(&case.range(), &settings, None, &Serial);
        let judged = vinesink::criteria::judge(&case, &survey.expect("finite"));
        for (name, judged) in names.iter().zip(judged) {
            let unit = if name.contains("velocity") { "m/s" } else { "m/s²" };
            let told = judged.found.expect("measured");
            let one = numbers(&found, &format!("{name} [{unit}]"))[row];
            assert!((one / told - 1.0).abs() < 1e-9, "{clearance} {name}: {one} {told}");
            // What is followed is seen and not proven.
            for way in ["up", "down"] {
                let one = numbers(&followed, &format!("{name}_{way} [{unit}]"))[row];
                assert!((one / told - 1.0).abs() < 1e-4, "{clearance} {name} {way}: {one} {told}");
            }
        }
    }
    let usual = swept(&sweeping("clearance = { values = [\"7.5 mm\", \"8 mm\"] }\n"));
    assert!(usual.iter().all(|(name, _)| !name.contains("velocity")), "{usual:?}");
}

#[test]
fn a_plan_says_how_motions_are_looked_for() {
    let axes = "clearance = { values = [\"10 mm\", \"20 mm\"] }\n\
                frequency = { from = \"8 Hz\", to = \"8.7 Hz\", count = 1024 }\n";
    for (settings, wanted) in [
        ("starts = 3\n", "2 x 1024 = 2048 points, 3 starts each, in 2 chunks (0 to 1)\n"),
        ("starts = 1\n", "2 x 1024 = 2048 points, 1 start each, in 2 chunks (0 to 1)\n"),
        (
            "follow = \"clearance\"\n",
            "1024 x 2 = 2048 points, motions followed along clearance up and down, in 2 chunks (0 to 1)\n",
        ),
        (
            "follow = \"frequency\"\n",
            "2 x 1024 = 2048 points, motions followed along frequency up and down, in 1 chunk (0)\n",
        ),
    ] {
        let folder = TempDir::new().expect("a folder");
        fs::write(folder.path().join("map.toml"), sweeping(&format!("{settings}{axes}")))
            .expect("written");
        let output = run(folder.path(), &["plan", "map.toml"]);
        assert_eq!(String::from_utf8_lossy(&output.stdout), wanted, "{output:?}");
    }
}

/// Every number of the design can be an axis, and is then what the case would say in its place.
#[test]
fn every_parameter_can_be_an_axis() {
    let design = text(3, 3);
    for (axis, value, line, instead) in [
        ("clearance", "\"11 mm\"", "clearance = \"20 mm\"", "clearance = \"11 mm\""),
        ("frequency", "\"8.1 Hz\"", "frequency = \"8.35 Hz\"", "frequency = \"8.1 Hz\""),
        ("amplitude", "\"0.2 mm\"", "amplitude = \"0.25 mm\"", "amplitude = \"0.2 mm\""),
        ("restitution", "0.7", "restitution = 0.6", "restitution = 0.7"),
        ("restitution", "0.7", "restitution = 0.6", "restitution = [0.7, 0.7]"),
        ("inclination", "\"-1 deg\"", "[absorber]", "[absorber]\ninclination = \"-1 deg\""),
        ("friction", "\"0.3 %\"", "[absorber]", "[absorber]\nfriction = 0.003"),
        ("absorber_mass", "\"40 g\"", "mass = \"32 g\"", "mass = \"40 g\""),
        ("mass_ratio", "0.01", "mass = \"32 g\"", "mass_ratio = 0.01"),
        ("mass", "\"4 kg\"", "mass = \"4.168 kg\"", "mass = \"4 kg\""),
        ("stiffness", "\"11 kN/m\"", "\"11.47 kN/m\"", "\"11 kN/m\""),
        ("damping", "\"2 N s/m\"", "\"3.02 N s/m\"", "\"2 N s/m\""),
        ("damping_ratio", "0.01", "damping = \"3.02 N s/m\"", "damping_ratio = 0.01"),
    ] {
        let swept = plan(&sweeping(&format!("{axis} = {{ values = [{value}] }}\n")));
        let written = design.replacen(line, instead, 1);
        assert_ne!(written, design, "{axis}");
        let wanted = Case::parse("map.toml", &written).expect("valid");
        let point = swept.point(0);
        assert_eq!(point.system, Some(wanted.system()), "{axis}");
        assert_eq!(point.units, wanted.units(), "{axis}");
    }
}

/// A ratio is of the mass that another axis sets, whatever their order.
#[test]
fn a_ratio_is_of_what_other_axes_say() {
    for table in [
        "mass = { values = [\"2 kg\"] }\nmass_ratio = { values = [0.01] }\n",
        "mass_ratio = { values = [0.01] }\nmass = { values = [\"2 kg\"] }\n",
    ] {
        let system = plan(&sweeping(table)).point(0).system.expect("valid");
        assert!((system.mass_ratio() - 0.01).abs() < 1e-17, "{table}");
    }
    for table in [
        "stiffness = { values = [\"20 kN/m\"] }\ndamping_ratio = { values = [0.01] }\n",
        "damping_ratio = { values = [0.01] }\nstiffness = { values = [\"20 kN/m\"] }\n",
    ] {
        let system = plan(&sweeping(table)).point(0).system.expect("valid");
        // c1/(2 sqrt(k1 m1)) is half of the mass ratio times lambda.
        let found = 0.5 * system.mass_ratio() * system.damping();
        assert!((found - 0.01).abs() < 1e-16, "{table}: {found}");
    }
}

/// What nothing is recorded of is not computed, and closed form is what the analysis says.
#[test]
fn closed_form_alone_is_recorded_without_simulation() {
    let columns = swept(&sweeping(
        "record = [\"area\", \"theory_peak\", \"boundary_distance\", \"orbit_multiplier\"]\n\
         amplitude = { from = \"0.05 mm\", to = \"0.6 mm\", count = 41 }\n",
    ));
    let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
    let wanted = ["point", "amplitude [m]", "area", "strip", "theory_peak [m]"];
    assert_eq!(names[..5], wanted);
    assert_eq!(names[5..], ["boundary_distance", "orbit_multiplier"]);
    // Where the change that leads to the nearest boundary is applied, the area changes.
    let (areas, distances) = (column(&columns, "area"), numbers(&columns, "boundary_distance"));
    let amplitudes = numbers(&columns, "amplitude [m]");
    for (k, distance) in distances.iter().enumerate() {
        let area = |factor: f64| {
            let amplitude = amplitudes[k] * factor * 1e3;
            let one = sweeping(&format!(
                "record = [\"area\"]\namplitude = {{ values = [\"{amplitude} mm\"] }}\n"
            ));
            let there = swept(&one);
            (column(&there, "area")[0].clone(), column(&there, "strip")[0].clone())
        };
        if k % 8 == 0 {
            let near = (1.0 + distance - 1e-6, 1.0 + distance + 1e-6);
            assert_ne!(area(near.0), area(near.1), "{} {distance}", areas[k]);
        }
        // Nothing changes before that, nor as far in the other direction, by the factor.
        let own = plan(&sweeping(&format!(
            "amplitude = {{ values = [\"{} mm\"] }}\n",
            amplitudes[k] * 1e3
        )));
        let zone = |factor: f64| {
            let mut parameters = own.point(0).system.expect("valid").parameters();
            parameters.forcing_per_clearance *= factor;
            Analysis::of(&System::new(parameters).expect("valid")).expect("solved").zone
        };
        let reach = libm::log1p(*distance).abs();
        for step in -40..=40 {
            let factor = libm::exp(0.999 * reach * f64::from(step) / 40.0);
            assert_eq!(zone(factor), zone(1.0), "{k}: {factor} {distance}");
        }
    }
}

/// A layer that nothing is recorded of is not asked: no orbit's operations are noted but those by which a
/// transient is left out, and no start is looked at, not even one that is impossible.
#[test]
fn a_layer_that_nothing_is_recorded_of_is_not_asked() {
    let worked_out = |record: &str, axis: &str| {
        let plan = plan(&sweeping(&format!("periods = 48\nrecord = [\"{record}\"]\n{axis}\n")));
        let (columns, operations) = operation_count::counted(|| work::points(&plan, 0..1));
        columns.map(|_| operations)
    };
    let cost = |record| worked_out(record, "clearance = { values = [\"20 mm\"] }").expect("finite");
    let [formula, orbit, reached] = ["bare_amplitude", "orbit_peak", "orbit_reached"].map(cost);
    // The operations of a formula are few, those of an orbit are many.
    assert!(orbit > 100 * formula && reached > 100 * formula, "{formula} {orbit} {reached}");
    let axis = "clearance = { values = [\"20 mm\"] }";
    let system = plan(&sweeping(axis)).point(0).system.expect("valid");
    let starts = plan(&sweeping(axis)).settings.starts;
    let (_, operations) = operation_count::counted(|| motions(&Place::new(&system, starts), 48));
    assert_eq!(cost("peak"), formula + operations);
    // Over the clearance this is no number.
    let no_start = "initial_velocity = { values = [\"1.7e308 m/s\"] }";
    assert!(worked_out("peak", no_start).is_err());
    assert!(worked_out("bare_amplitude", no_start).is_ok());
}

/// Everything that can be recorded, in the units of the case, against the layers and by hand.
#[test]
fn every_column_is_what_its_layer_says() {
    let omega0 = common::natural_frequency();
    let (mut several, mut tied, mut closest, mut reached_by_some) = (0, 0, 0, 0);
    for starts in [2_u32, 16] {
        let steady = Recorded::ALL.into_iter().filter(|one| one.is_of(Scene::Steady));
        let all = steady.map(|one| format!("\"{}\"", one.key())).collect::<Vec<_>>().join(", ");
        let text = sweeping(&format!(
            "starts = {starts}\nperiods = 100\nrecord = [{all}]\n\
             clearance = {{ values = [\"12 mm\", \"20 mm\", \"30 mm\", \"40 mm\"] }}\n\
             frequency = {{ values = [\"8.05 Hz\", \"8.35 Hz\", \"8.5 Hz\"] }}\n"
        ));
        let (columns, plan) = (swept(&text), plan(&text));
        for k in 0..12 {
            let point = plan.point(k as u64);
            let (system, b) = (point.system.expect("valid"), point.coordinates[0]);
            let same = |name: &str, wanted: Option<f64>| {
                let text = &column(&columns, name)[k];
                let found = (!text.is_empty()).then(|| text.parse::<f64>().expect(name));
                // Rounded a few times on the way to the unit; decibels are a logarithm's, rounded near 1.
                let size =
                    |of: f64| if name.ends_with("[dB]") { of.abs().max(1.0) } else { of.abs() };
                let near = found.zip(wanted).map(|(a, b)| (a - b).abs() <= 1e-12 * size(b));
                assert!(near.unwrap_or(found == wanted), "{k} {name}: {found:?} {wanted:?}");
            };
            let found = motions(&Place::new(&system, starts), 100);
            let main: &Motion = found.main().expect("one");
            let facts = main.facts();
            several += u32::from(found.len() > 1);
            let as_many = |one: &&Motion| one.reached().starts == main.reached().starts;
            tied += u32::from(found.iter().filter(as_many).count() > 1);
            let bare = system.linear_response().expect("damped").amplitude();
            same("impacts_per_period", Some(facts.impacts_per_period.value));
            same("peak [m]", Some(b * facts.peak.value));
            same("efficiency", facts.efficiency.map(|share| share.value));
            same("impact_speed [m/s]", Some(b * omega0 * facts.impact_speed.value));
            same("repeats_after", main.repeats_after().map(f64::from));
            let share = f64::from(main.reached().starts) / f64::from(starts);
            same("share_of_starts", Some(share));
            let counting = || found.counting(true).map(|(_, one)| one);
            let largest = counting().map(|one| one.facts().peak.value).fold(0.0, f64::max);
            same("largest_peak [m]", Some(b * largest));
            let ratio = bare / largest;
            same("reduction_db [dB]", Some(10.0 * libm::log10(libm::pow(ratio, 2.0))));
            same("motions", Some(counting().count() as f64));
            assert_eq!(column(&columns, "regime")[k], main.regime().key());
            let theory = Analysis::of(&system).expect("solved");
            let stable = theory.stable_points().filter(|point| point.admissible);
            let least = stable.map(|point| b * point.oscillator_amplitude).reduce(f64::min);
            same("theory_peak [m]", least);
            let all = two_impact_orbits(&system).expect("solved").orbits;
            let attracting: Vec<_> = all.iter().filter(|orbit| orbit.attracts()).collect();
            let orbit = attracting.first().copied();
            let measures = |one: &Orbit| Measures::of(&system, &one.cycle).expect("measured");
            assert!(attracting.len() < 2, "{k}");
            same("orbit_peak [m]", orbit.map(|one| b * measures(one).peaks.displacement));
            let multiplier = orbit.map(Orbit::radius_per_period);
            same("orbit_multiplier", multiplier);
            let is_orbit = |one: &Motion| {
                let exact = orbit.map_or(f64::NAN, |orbit| measures(orbit).peaks.displacement);
                let facts = one.facts();
                let two = facts.impacts_per_period.value == 2.0;
                (facts.peak.value / exact - 1.0).abs() < 1e-6 && two && one.reached().starts > 0
            };
            let reached = found.iter().filter(|one| is_orbit(one)).count();
            reached_by_some += u32::from(0 < reached && reached < found.len());
            let wanted = orbit.as_ref().map_or("", |_| if reached > 0 { "true" } else { "false" });
            assert_eq!(column(&columns, "orbit_reached")[k], wanted, "{k}");
            let mut on = Simulation::new(&system, main.state(), 0.0).expect("inside");
            for period in 1..=16 {
                on.run(1, u64::MAX, &mut ());
                same(&format!("section_{period:02} [m]"), Some(b * on.state().x));
            }
            // A deviation from the orbit shrinks by its multiplier each period.
            if let Some(multiplier) = multiplier.filter(|_| is_orbit(main)) {
                let exponent = numbers(&columns, "lyapunov")[k];
                closest += 1;
                assert!(
                    (exponent - libm::log(multiplier)).abs() < 0.02,
                    "{k}: {exponent} {multiplier}"
                );
            }
        }
    }
    assert!(
        several > 0 && tied > 0 && closest > 0 && reached_by_some > 0,
        "{several} {tied} {closest} {reached_by_some}"
    );
}

/// An absorber that a wall does not reach keeps the structure at its own amplitude; in a device in which it cannot rest the orbit
/// is the worst. A point that is a start has the reduction of the motion that it leads to.
#[test]
fn an_absorber_at_rest_counts_in_a_sweep_unless_the_case_leaves_it_out() {
    let sweep = "starts = 4\nperiods = 100\nclearance = { values = [\"15 mm\", \"20 mm\"] }\n";
    let one = |text: &str, name: &str| numbers(&swept(text), name);
    let text = sweeping(&format!("{sweep}frequency = {{ values = [\"8.5 Hz\"] }}\n"));
    let [worst, main] = ["largest_peak [m]", "peak [m]"].map(|name| one(&text, name));
    assert!(worst.iter().zip(&main).all(|(worst, main)| *worst > 1.5 * main), "{worst:?} {main:?}");
    let awake = format!("{text}\n[criteria]\ncount_inactive = false\n");
    assert_eq!(one(&awake, "largest_peak [m]"), one(&awake, "peak [m]"));
    assert!(one(&awake, "reduction_db [dB]").iter().all(|reduction| *reduction > 4.0));
}

/// Upwards the upper branch is kept until it ends, downwards the lower: where two motions attract the
/// columns differ, elsewhere they agree; and each is a motion of its system.
#[test]
fn a_motion_is_followed_both_ways() {
    let columns = swept(&sweeping(
        "follow = \"clearance\"\nperiods = 100\nrecord = [\"regime\", \"peak\", \"repeats_after\"]\n\
         clearance = { from = \"8 mm\", to = \"60 mm\", count = 53 }\n",
    ));
    let [up, down] = ["peak_up [m]", "peak_down [m]"].map(|name| numbers(&columns, name));
    let repeats =
        |way: &str, k: usize| !column(&columns, &format!("repeats_after_{way}"))[k].is_empty();
    let apart = |k: &usize| {
        repeats("up", *k) && repeats("down", *k) && (up[*k] / down[*k] - 1.0).abs() > 0.05
    };
    let differing: Vec<usize> = (0..up.len()).filter(apart).collect();
    assert!(
        !differing.is_empty() && differing.len() < up.len() / 2,
        "{differing:?} {up:?} {down:?}"
    );
    assert_eq!(column(&columns, "regime_up").len(), 53);
    // Where they part, the way up goes on in its regime; where they meet again, the way down did in its own.
    let (first, last) = (differing[0], differing[differing.len() - 1]);
    let [regime_up, regime_down] = ["regime_up", "regime_down"].map(|name| column(&columns, name));
    assert_eq!(regime_up[first], regime_up[first - 1], "{first}");
    assert_eq!(regime_down[last], regime_down[last + 1], "{last}");
    assert_ne!(regime_up[first], regime_down[first], "{first}");
    let clearances = numbers(&columns, "clearance [m]");
    let k = differing[differing.len() / 2];
    let mut system =
        plan(&sweeping(&format!("clearance = {{ values = [\"{} mm\"] }}\n", 1e3 * clearances[k])));
    system.grid.settings.starts = 64;
    let of = system.point(0).system.expect("valid");
    let there = motions(&Place::new(&of, 64), 100);
    for peak in [up[k], down[k]] {
        let near = |motion: &&Motion| {
            (motion.facts().peak.value * clearances[k] / peak - 1.0).abs() < 0.02
        };
        assert!(there.iter().any(|motion| near(&motion)), "{peak}: {there:?}");
    }
}

/// A grid of starts is a map of basins: two motions attract, and each start leads to one of them.
#[test]
fn starts_can_be_axes() {
    let columns = swept(&sweeping(
        "periods = 60\nrecord = [\"regime\", \"peak\", \"motions\", \"section\", \"lyapunov\"]\n\
         initial_displacement = { from = \"-30 mm\", to = \"30 mm\", count = 9 }\n\
         initial_velocity = { from = \"-1 m/s\", to = \"1 m/s\", count = 5 }\n",
    ));
    // What the start leads to, and the absorber at rest, which no wall reaches here.
    let motions = column(&columns, "motions");
    assert!(motions.iter().all(|one| one == "2"), "{motions:?}");
    // Displacements at the end of periods are below the peak, and of a motion that repeats all alike.
    let (peaks, first) = (numbers(&columns, "peak [m]"), numbers(&columns, "section_01 [m]"));
    let (last, regimes) = (numbers(&columns, "section_16 [m]"), column(&columns, "regime"));
    for k in 0..45 {
        assert!(first[k].abs() <= peaks[k] && last[k].abs() <= peaks[k], "{k}");
        if regimes[k] == "two-symmetric" {
            assert!((first[k] - last[k]).abs() < 1e-6 * peaks[k], "{k}: {} {}", first[k], last[k]);
        }
    }
    assert!(numbers(&columns, "lyapunov").iter().any(|one| *one < 0.0));
    // A start outside of the cavity is no start.
    let columns = swept(&sweeping(
        "record = [\"peak\"]\nperiods = 48\n\
         initial_absorber_displacement = { values = [\"-25 mm\", \"0 mm\", \"19 mm\"] }\n",
    ));
    let there: Vec<bool> = column(&columns, "peak [m]").iter().map(|one| !one.is_empty()).collect();
    assert_eq!(there, [false, true, true]);
}

/// Where no impact is left the oscillator vibrates as if alone, however late the absorber came to rest.
#[test]
fn at_rest_the_oscillator_vibrates_as_if_alone() {
    let columns = swept(&sweeping(
        "periods = 100\nfrequency = { values = [\"8.05 Hz\", \"8.6 Hz\"] }\n\
         initial_velocity = { from = \"-1.5 m/s\", to = \"1.5 m/s\", count = 301 }\n",
    ));
    let reductions = numbers(&columns, "reduction_db [dB]");
    let rest =
        column(&columns, "regime").iter().zip(reductions).filter(|(one, _)| *one == "at-rest");
    let mut resting = 0;
    for (_, reduction) in rest {
        // What twelve e-folds leave of a transient ten times as large, in dB.
        assert!(reduction.abs() < 1e-3, "{reduction}");
        resting += 1;
    }
    assert!(resting > 10, "{resting}");
}

/// A value of the text is the value of the Parquet file, to the bit.
#[test]
fn csv_holds_the_same_numbers() {
    let folder = folder(2);
    done(folder.path(), &["map.toml", "--csv"]);
    let rows = rows(&merged(folder.path()));
    let csv = fs::read_to_string(folder.path().join("sweeps/map/sweep.csv")).expect("written");
    let mut lines = csv.lines();
    assert!(
        lines.next().expect("a header").starts_with("point,clearance [m],frequency [Hz],area,")
    );
    let mut compared = 0;
    for (row, line) in rows.iter().zip(lines.by_ref()) {
        for ((_, field), text) in row.get_column_iter().zip(line.split(',')) {
            match field {
                Field::Double(value) => assert_eq!(text.parse(), Ok(*value)),
                Field::Long(value) => assert_eq!(text.parse(), Ok(*value)),
                Field::Str(value) => assert_eq!(text, value),
                Field::Null => assert_eq!(text, ""),
                other => panic!("{other}"),
            }
            compared += 1;
        }
    }
    assert_eq!((compared, lines.next()), (128 * 16, None));
}

/// A file that may not grow further, as on a full disk: the error names it, and what is there is kept.
#[cfg(unix)]
#[test]
fn a_chunk_that_does_not_fit_loses_nothing() {
    let folder = folder(40);
    let limited = |blocks: u32| {
        let mut command = Command::new("sh");
        let program = env!("CARGO_BIN_EXE_vinesink");
        // Blocks of 512 bytes; without the signal writing fails as on a full disk.
        let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec {program} sweep map.toml");
        command.arg("-c").arg(script).current_dir(folder.path()).output().expect("it runs")
    };
    let output = limited(8);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    let said = String::from_utf8_lossy(&output.stderr).replace('\n', " ");
    assert!(
        said.contains("chunks/00000000") && said.contains("what was worked out is kept"),
        "{said}"
    );
    assert!(!chunk(folder.path(), 0).exists() && !merged(folder.path()).exists());
    // The chunks fit, all of them together do not.
    let output = limited(200);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert!(String::from_utf8_lossy(&output.stderr).contains("sweep.parquet"), "{output:?}");
    let whole = run(folder.path(), &["status", "map.toml"]);
    assert_eq!(whole.status.code(), Some(0), "{whole:?}");
    assert!(!merged(folder.path()).exists());
    done(folder.path(), &["map.toml"]);
    let apart = self::folder(40);
    done(apart.path(), &["map.toml"]);
    let bytes = |folder: &Path| fs::read(merged(folder)).expect("merged");
    assert!(bytes(folder.path()) == bytes(apart.path()));
}

/// Three commands on one sweep at the same time, as somebody starts who does not see that one runs: each ends well, who has to
/// wait says for whom, and the results are those of one alone.
#[test]
fn sweeps_at_the_same_time_lose_nothing() {
    for (count, verbs) in [
        (60, [&[][..], &[], &[]]),
        (40, [&["run"][..], &[], &["run"]]),
        (20, [&[][..], &["run"], &["run"]]),
    ] {
        let folder = folder(count);
        let begun = verbs.map(|verb| {
            let arguments = [verb, &["map.toml"]].concat();
            let mut command = command(folder.path(), &arguments);
            command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it runs")
        });
        for one in begun {
            let output = one.wait_with_output().expect("it ends");
            let said = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(0), "{said}");
            assert!(!said.contains("cannot write"), "{said}");
        }
        let apart = self::folder(count);
        done(apart.path(), &["map.toml"]);
        done(folder.path(), &["merge", "map.toml"]);
        let bytes = |folder: &Path| fs::read(merged(folder)).expect("merged");
        assert!(bytes(folder.path()) == bytes(apart.path()));
        let chunks = chunk(folder.path(), 0).parent().expect("a folder").to_owned();
        let left =
            fs::read_dir(chunks).expect("chunks").map(|one| one.expect("a file").file_name());
        let left: Vec<_> = left.filter(|name| !name.to_string_lossy().starts_with('0')).collect();
        assert!(left.is_empty(), "{left:?}");
    }
}

/// Who holds a sweep is said at once, and the other one waits for it.
#[cfg(unix)]
#[test]
fn a_sweep_waits_for_another_one_and_says_so() {
    let folder = folder(20);
    done(folder.path(), &["map.toml"]);
    let chunks = chunk(folder.path(), 0).parent().expect("a folder").to_owned();
    let held = fs::File::open(&chunks).expect("a folder");
    held.lock().expect("free");
    let mut command = command(folder.path(), &["map.toml"]);
    let mut waiting =
        command.stderr(Stdio::piped()).stdout(Stdio::null()).spawn().expect("it runs");
    let mut said = String::new();
    let mut lines = BufReader::new(waiting.stderr.take().expect("piped"));
    while !said.contains("waiting until it is done") {
        assert!(lines.read_line(&mut said).expect("a line") > 0, "{said}");
    }
    assert!(
        said.contains("Another process works on this sweep in") && said.contains("chunks"),
        "{said}"
    );
    assert_eq!(waiting.try_wait().expect("it runs"), None);
    held.unlock().expect("held");
    assert_eq!(waiting.wait().expect("it ends").code(), Some(0));
}

/// Chunks that are damaged, cut short or of another sweep are said before anything is worked out, and one that cannot be read
/// ends the run before that.
#[test]
fn damaged_chunks_are_found_before_work_begins() {
    let folder = folder(40);
    done(folder.path(), &["map.toml"]);
    let expected = fs::read(merged(folder.path())).expect("merged");
    let last = (0..).take_while(|k| chunk(folder.path(), *k).exists()).last().expect("chunks");
    assert!(last > 1, "{last} chunks");
    let whole = fs::read(chunk(folder.path(), 1)).expect("a chunk");
    for damaged in [&whole[..whole.len() / 2], b"another file", &[]] {
        fs::write(chunk(folder.path(), 1), damaged).expect("written");
        let output = run(folder.path(), &["map.toml"]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{said}");
        let named = format!("{:09}.parquet: damaged, or of another sweep", 1);
        assert!(said.contains(&named), "{said}");
        assert!(fs::read(merged(folder.path())).expect("merged") == expected);
    }
    // All are to be worked out again but one, which nobody can read.
    for k in 0..last {
        fs::remove_file(chunk(folder.path(), k)).expect("there");
    }
    fs::remove_file(chunk(folder.path(), last)).expect("there");
    fs::create_dir(chunk(folder.path(), last)).expect("made");
    let output = run(folder.path(), &["map.toml"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains(&format!("{last:09}.parquet")), "{said}");
    assert!((0..last).all(|k| !chunk(folder.path(), k).exists()), "nothing was worked out");
}
