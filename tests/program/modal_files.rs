//! Modes on their way in from files: nothing that decides is lost, counted twice or taken for something else.

use std::fs;
use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;
use vinesink::case::{ModalCase, StartingModes};
use vinesink::case_input::{AnyCase, CaseInputError, read_any};
use vinesink::store::Reach;

/// The case `modes` with a file of modes beside it: its natural frequencies and what it is warned of, or what is refused, a line each.
fn read(modes: &str, file: &[u8]) -> Result<(ModalCase, Vec<String>), String> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("case.toml");
    let rest = "[[absorber]]\nplace = 'tip'\nmass = '0.9 kg'\nclearance = '2.7 mm'\nrestitution = 0.3\n\
                [[excitation]]\nkind = 'force'\nmode = 1\namplitude = '0.3583 N'\nfrequency = '1.1 Hz'\n";
    fs::write(&path, format!("title = 't'\nsource = 's'\n{modes}\n{rest}")).expect("written");
    fs::write(folder.path().join("modes"), file).expect("written");
    match read_any(&path, Reach::Folder) {
        Ok((AnyCase::Several(case), _)) => {
            let warnings = case.warnings.iter().map(|one| one.message.clone()).collect();
            Ok((*case, warnings))
        }
        Ok(_) => panic!("one mode"),
        Err(CaseInputError::Case(error)) => {
            let told = error.problems().map(|one| {
                format!("{}: {}; {}", one.line, one.message, one.help.as_deref().unwrap_or(""))
            });
            Err(told.collect::<Vec<_>>().join("\n"))
        }
        Err(other) => Err(other.to_string()),
    }
}

const UNIVERSAL: &str = "[modes]\nfile = 'modes'\nplaces = { tip = '12 z', middle = '7 z' }\n";
const COLUMNS: &str = "[modes]\nfile = 'modes'\n";
const MAST: [[f64; 3]; 3] = [[1.1, 0.34, 1.0], [6.894, -0.714, 1.0], [19.31, 0.02, 1.0]];

fn hertz(modes: &str, file: &[u8]) -> Result<Vec<f64>, String> {
    let (case, _) = read(modes, file)?;
    Ok(case.modes.iter().map(|mode| mode.frequency_hz).collect())
}

/// A data set 55 of a mode.
fn set_55([hz, middle, tip]: [f64; 3]) -> String {
    let node = |number: u32, z: f64| format!("{number:10}\n{:13.5E}{:13.5E}{z:13.5E}\n", 0.0, 0.0);
    format!(
        "    -1\n    55\nmode\nNONE\nNONE\nNONE\nNONE\n{:10}{:10}{:10}{:10}{:10}{:10}\n{:10}{:10}{:10}{:10}\n\
         {hz:13.5E}{:13.5E}{:13.5E}{:13.5E}\n{}{}    -1\n",
        1,
        2,
        2,
        8,
        2,
        3,
        2,
        4,
        0,
        1,
        30.0,
        0.005,
        0.0,
        node(7, middle),
        node(12, tip)
    )
}

/// The mast with what stands before each of its modes.
fn mast(before: [&str; 3]) -> String {
    before.into_iter().zip(MAST).map(|(before, mode)| before.to_owned() + &set_55(mode)).collect()
}

/// A line -1 of the data ends no data set, and where one seems to be lost the file is refused.
#[test]
fn a_separator_is_minus_one_in_columns_5_and_6() {
    let all = Ok(MAST.map(|mode| mode[0]).to_vec());
    for loose in ["-1", " -1", "        -1", "\t-1"] {
        let other = format!("    -1\n  2412\n         1\n{loose}\npart\n    -1\n");
        let behind = mast(["", &other, ""]);
        assert_eq!(hertz(UNIVERSAL, behind.as_bytes()), all, "{loose:?}");
        assert_eq!(hertz(UNIVERSAL, mast([&other; 3]).replace('\n', "\r\n").as_bytes()), all);
    }
    let (case, _) =
        read(UNIVERSAL, mast(["    -1\n  2400\n    -1\n", "", ""]).as_bytes()).expect("read");
    let told = "3 of 3 modes from modes, a Universal File of 4 data sets: 3 of modes (55), 1 not used (2400)";
    assert_eq!(case.modes_from.as_deref(), Some(told));
    // Written otherwise they hide what is between them: each of these lost a mode in silence, or could.
    let file = mast([""; 3]);
    let second = file.match_indices("    -1\n").nth(2).expect("a second mode").0;
    for (text, words) in [
        (file.replacen("    -1\n", "-1\n", 1), "1: a line -1 is not in columns 5 and 6"),
        (file.replace("    -1\n", "  -1\n"), "1: a line -1 is not in columns 5 and 6"),
        (format!("{}{}", &file[..second - 7], &file[second..]), "16: the line is in no data set"),
        (format!("{file}mode 4 behind the last one\n"), "the line is in no data set"),
        (
            format!("    -1\n  2412\n{}", mast([""; 3]).replace("    -1\n", "  -1\n")) + "    -1\n",
            "",
        ),
        (
            format!("    -1\n  2412\n  -1\n{}    -1\n", file.replace("    -1\n", "  -1\n")),
            "4: within data set 2412 another one seems to begin",
        ),
        (file.replacen("    55\n", "  none\n", 1), "2: the number of a data set cannot be read"),
    ] {
        let told = hertz(UNIVERSAL, text.as_bytes()).expect_err("refused");
        assert!(told.contains(words), "{words}: {told}");
    }
}

/// Binary data sets, text in Latin-1 and a byte order mark beside the modes do not matter.
#[test]
fn a_universal_file_is_read_as_bytes() {
    let all = Ok(MAST.map(|mode| mode[0]).to_vec());
    let binary = |inside: &[u8]| {
        let head = format!("    -1\n    58b{:6}{:6}{:12}{:12}{:6}\n", 1, 2, 11, inside.len(), 0);
        let text = "response at a point\n".repeat(11);
        [head.as_bytes(), text.as_bytes(), inside, b"\n    -1\n"].concat()
    };
    for inside in [&b"\xff\x00\xe9"[..], b"\n    -1\n    -1\n    55\n", b"    -1\n"] {
        let file = [binary(inside), mast([""; 3]).into_bytes(), binary(inside)].concat();
        assert_eq!(hertz(UNIVERSAL, &file), all, "{inside:?}");
    }
    let latin: Vec<u8> = mast([""; 3])
        .replace("mode\n", "m?de\n")
        .bytes()
        .map(|b| if b == b'?' { 0xf6 } else { b })
        .collect();
    assert_eq!(hertz(UNIVERSAL, &latin), all);
    assert_eq!(hertz(UNIVERSAL, format!("\u{feff}{}", mast([""; 3])).as_bytes()), all);
    let columns = b"# gr\xfc\xdfe\nfrequency (Hz),damping_ratio (%),mass (kg),tip\n1.1,0.5,30,1\n";
    assert_eq!(hertz(COLUMNS, columns), Ok(vec![1.1]));
}

/// A mode that stands twice would take a load twice: refused with both places, in files and tables, whatever its scale; what is
/// nearly one is warned of.
#[test]
fn a_mode_stands_once() {
    let [first, second, third] = MAST;
    let scaled = [second[0], -3.0 * second[1], -3.0 * second[2]];
    let file = |modes: &[[f64; 3]]| modes.iter().map(|mode| set_55(*mode)).collect::<String>();
    let twice = [[first, second, third], [first, second, third]].concat();
    for (modes, words) in [
        (&twice[..], "mode 1 of line 10 at 1.1 Hz and mode 4 of line 55 at 1.1 Hz"),
        (
            &[first, second, scaled],
            "mode 2 of line 25 at 6.894 Hz and mode 3 of line 40 at 6.894 Hz",
        ),
        (&[first, [1.1, 0.34, 1.0001]], "mode 1 of line 10"),
    ] {
        let told = hertz(UNIVERSAL, file(modes).as_bytes()).expect_err("refused");
        assert!(
            told.contains(words) && told.contains("have one frequency and one shape"),
            "{told}"
        );
    }
    let chosen = format!("{UNIVERSAL}numbers = [1, 2, 3]\n");
    assert_eq!(hertz(&chosen, file(&twice).as_bytes()), Ok(MAST.map(|mode| mode[0]).to_vec()));
    // Another shape at one frequency, as symmetric structures have, is another mode.
    assert!(
        read(UNIVERSAL, file(&[first, [1.1, 1.0, -0.34]]).as_bytes()).expect("read").1.is_empty()
    );
    let near = file(&[first, second, [6.9, -0.73, 1.0]]);
    let (_, warnings) = read(UNIVERSAL, near.as_bytes()).expect("read");
    let words = "have nearly one frequency and one shape";
    assert!(warnings.len() == 1 && warnings[0].contains(words), "{warnings:?}");

    let columns =
        |lines: &str| format!("frequency (Hz),damping_ratio (%),mass (kg),tip,middle\n{lines}");
    let lines = "1.1,0.5,30,1,0.34\n6.894,0.5,30,1,-0.714\n";
    let told = hertz(COLUMNS, columns(&format!("{lines}1.1,0.5,30,1,0.34\n")).as_bytes());
    let told = told.expect_err("refused");
    assert!(told.contains("mode 1 of line 2 at 1.1 Hz and mode 3 of line 4 at 1.1 Hz"), "{told}");

    let table = |hz: f64, tip: f64| {
        format!(
            "[[mode]]\nfrequency = '{hz} Hz'\ndamping_ratio = 0.005\nmass = '30 kg'\nshape = {{ tip = {tip} }}\n"
        )
    };
    let told = read(&[table(1.1, 1.0), table(6.9, 1.0), table(1.1, -2.0)].concat(), b"");
    let told = told.expect_err("refused");
    assert!(
        told.contains("mode 3 at 1.1 Hz has one frequency and one shape with mode 1"),
        "{told}"
    );
    assert!(told.contains("in line 7"), "{told}");
    let (_, warnings) = read(&[table(1.1, 1.0), table(1.105, 1.0)].concat(), b"").expect("read");
    assert!(warnings[0].contains("nearly one frequency"), "{warnings:?}");

    // A node that stands twice in a shape.
    let node = "        12\n  0.00000E0  0.00000E0  5.00000E-1\n    -1\n";
    let file = set_55(second)
        .replacen("    -1\n", "?", 1)
        .replacen("    -1\n", node, 1)
        .replacen('?', "    -1\n", 1);
    let told = hertz(UNIVERSAL, (set_55(first) + &file).as_bytes()).expect_err("refused");
    assert!(told.contains("node 12 stands twice in a shape, in lines 28 and 30"), "{told}");
}

/// What counts the modes is no shape.
#[test]
fn numbers_of_modes_are_no_place() {
    let file = |name: &str, numbers: [&str; 3]| {
        let rest = ["1.1,0.5,30,1", "6.894,0.5,30,0.9", "19.31,0.5,30,1"];
        let lines: String =
            numbers.iter().zip(rest).map(|(number, rest)| format!("{number},{rest}\n")).collect();
        format!("{name},frequency (Hz),damping_ratio (%),mass (kg),tip\n{lines}")
    };
    for (name, numbers) in [
        ("mode", ["1", "2", "3"]),
        ("no", ["0", "1", "2"]),
        ("n", ["7", "9", "10"]),
        ("x", ["1.0", "2.0", "3e0"]),
    ] {
        let told = hertz(COLUMNS, file(name, numbers).as_bytes()).expect_err("refused");
        let words = format!("1: the column {name} holds {}", numbers[0].trim_end_matches(".0"));
        assert!(told.contains(&words) && told.contains("places = { tip = \"tip\" }"), "{told}");
    }
    let one = "Mode,frequency (Hz),damping_ratio (%),mass (kg),tip\n1,1.1,0.5,30,1\n";
    assert!(hertz(COLUMNS, one.as_bytes()).expect_err("refused").contains("the column Mode"));
    // Who names the places says what the columns are; the others may hold anything.
    let text = file("mode", ["first", "2", "3"]);
    let (case, _) =
        read("[modes]\nfile = 'modes'\nplaces = { tip = 'tip' }\n", text.as_bytes()).expect("read");
    assert_eq!((case.places, case.modes[1].shape.clone()), (vec!["tip".to_owned()], vec![0.9]));
    let text = file("mode", ["1", "2", "3"]);
    let named = "[modes]\nfile = 'modes'\nplaces = { tip = 'mode', other = 'tip' }\n";
    let (case, _) = read(named, text.as_bytes()).expect("read");
    let tip = case.places.iter().position(|name| name == "tip").expect("tip");
    assert_eq!(case.modes.iter().map(|mode| mode.shape[tip]).collect::<Vec<_>>(), [1.0, 2.0, 3.0]);
    let told = hertz("[modes]\nfile = 'modes'\nplaces = { tip = 'top' }\n", text.as_bytes());
    assert!(told.expect_err("refused").contains("there is no column top, which `places` names"));
    // Shapes that ascend.
    let text = file("base", ["0.1", "0.2", "0.3"]);
    assert!(hertz(COLUMNS, text.as_bytes()).is_ok());
}

/// A complex mode that is left out takes no part of a load: only where the case says which count.
#[test]
fn modes_that_cannot_be_read_are_not_passed_over_in_silence() {
    let complex = set_55(MAST[1]).replacen(
        "         1         2         2",
        "         1         3         2",
        1,
    );
    let file = set_55(MAST[0]) + &complex + &set_55(MAST[2]);
    let told = hertz(UNIVERSAL, file.as_bytes()).expect_err("refused");
    assert!(told.contains("1 mode of the file is complex and is not read: line 17"), "{told}");
    let (case, warnings) =
        read(&format!("{UNIVERSAL}numbers = [1, 2]\n"), file.as_bytes()).expect("read");
    assert_eq!(case.modes.len(), 2);
    assert!(warnings[0].contains("complex"), "{warnings:?}");
}

/// `vinesink modes` says what a file has and how it is read.
#[test]
fn a_file_of_modes_is_listed() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |file: &[u8], more: &[&str]| {
        fs::write(folder.path().join("mast.unv"), file).expect("written");
        let mut command = Command::cargo_bin("vinesink").expect("built");
        let output =
            command.current_dir(folder.path()).args(["modes", "mast.unv"]).args(more).output();
        let output = output.expect("it runs");
        let told =
            String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
        (output.status.code(), told.into_owned())
    };
    let rigid = set_55([0.0, 1.0, 1.0]);
    let file = rigid + &mast([""; 3]) + &set_55(MAST[1]) + "    -1\n   151\nhead\n    -1\n";
    let (code, told) = run(file.as_bytes(), &[]);
    assert_eq!(code, Some(0), "{told}");
    for words in [
        "a Universal File of 6 data sets: 5 of modes (55), 1 not used (151)",
        "6.894 Hz",
        "modes 3 and 5 have one frequency and one shape",
        "Nodes: 7, 12",
        "[modes]\nfile = \"mast.unv\"\nplaces = { tip = \"12 z\" }\n",
    ] {
        assert!(told.contains(words), "{words}: {told}");
    }
    let (_, told) = run(file.as_bytes(), &["--format", "json"]);
    let document: serde_json::Value = serde_json::from_str(&told).expect("JSON");
    assert_eq!(
        (&document["format"], &document["modes"][1]["frequency_hz"]),
        (&"vinesink/modes@1".into(), &1.1.into())
    );
    assert_eq!(run(b"", &[]).0, Some(2));
    assert_eq!(run(b"root:x:0:0:secret", &[]).0, Some(2));
}

/// A file with more columns than anybody looks at is refused at once, and one with the wrong scale of its shapes.
#[test]
fn what_cannot_be_meant_is_refused() {
    let many: String = (0..100_000).map(|k| format!(",p{k}")).collect();
    let numbers = ",0.5".repeat(100_000);
    let wide =
        format!("frequency (Hz),damping_ratio (%),mass (kg),tip{many}\n1.1,0.5,30,1{numbers}\n");
    let told = hertz(COLUMNS, wide.as_bytes()).expect_err("refused");
    assert!(
        told.contains("the file has 100001 columns of places") && told.contains("places = { tip"),
        "{told}"
    );
    let named = "[modes]\nfile = 'modes'\nplaces = { tip = 'tip' }\n";
    assert_eq!(hertz(named, wide.as_bytes()), Ok(vec![1.1]));
    for (shape, words) in [
        ("1e300", "absorber 1 has more than 1000000 times the mass that its impacts see"),
        ("1e9", "more than 1000000 times"),
        ("1e-300", "absorber 1 has less than 1e-12 times the mass that its impacts see"),
    ] {
        let file = format!("frequency (Hz),damping_ratio (%),mass (kg),tip\n1.1,0.5,30,{shape}\n");
        let told = hertz(COLUMNS, file.as_bytes()).expect_err("refused");
        assert!(told.contains(words) && !told.contains("inf"), "{told}");
    }
}

/// Semicolons, tabs, decimal commas, units in square brackets and lines above the head: one table, read in one way.
#[test]
fn a_table_of_modes_is_read_as_it_is_separated() {
    for (what, text) in [
        (
            "semicolons",
            "frequency [Hz];damping_ratio [%];mass [kg];tip;middle\n1,1;0,5;30;1;0,34\n6,894;0,5;30;1;-0,714\n",
        ),
        (
            "tabs",
            "frequency (Hz)\tdamping_ratio (%)\tmass (kg)\ttip\tmiddle\n1.1\t0.5\t30\t1\t0.34\n6.894\t0.5\t30\t1\t-0.714\n",
        ),
        (
            "lines above",
            "Modal analysis of the mast\nsecond of May\n\nfrequency (Hz), damping_ratio (%), mass (kg), tip, middle\n1.1, 0.5, 30, 1, 0.34\n6.894, 0.5, 30, 1, -0.714\n",
        ),
        (
            "UTF-8 with a mark",
            "\u{feff}frequency (Hz),damping_ratio (%),mass (kg),tip,middle\r\n1.1,0.5,30,1,0.34\r\n6.894,0.5,30,1,-0.714\r\n",
        ),
    ] {
        let (case, _) =
            read(COLUMNS, text.as_bytes()).unwrap_or_else(|told| panic!("{what}: {told}"));
        let hertz: Vec<f64> = case.modes.iter().map(|mode| mode.frequency_hz).collect();
        assert_eq!(
            (hertz, case.modes[1].shape.clone(), case.modes[0].damping_ratio),
            (vec![1.1, 6.894], vec![1.0, -0.714], 0.005),
            "{what}"
        );
    }
    let wide: Vec<u8> = "frequency (Hz),damping_ratio (%),mass (kg),tip\n1.1,0.5,30,1\n"
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    assert_eq!(hertz(COLUMNS, &[&[0xff, 0xfe], &wide[..]].concat()), Ok(vec![1.1]));
    let told = hertz(COLUMNS, b"PK\x03\x04sheet").expect_err("refused");
    assert!(told.contains("an Excel workbook") && told.contains("CSV UTF-8"), "{told}");
}

/// What the program says in a folder.
fn run_in(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::cargo_bin("vinesink").expect("built");
    command.current_dir(folder).args(arguments).output().expect("it runs")
}

/// The worst displacement of a case by its criterion, and the exit code of `check`: a decision, with an absorber that impacts.
fn decided(folder: &Path, name: &str) -> (f64, Option<i32>) {
    let simulated = run_in(folder, &["simulate", name, "--format", "json"]);
    let simulated: Value = serde_json::from_slice(&simulated.stdout).expect("JSON");
    let places = simulated["loads"][0]["places"].as_array().expect("frequencies");
    let impacts = |motion: &Value| motion["impacts_per_period"]["value"].as_f64() > Some(1.0);
    let at =
        |place: &&Value| place["motions"].as_array().is_some_and(|all| all.iter().any(impacts));
    assert!(5 * places.iter().filter(at).count() > places.len(), "{name}: {simulated}");
    let checked = run_in(folder, &["check", name, "--criteria-only", "--format", "json"]);
    let told: Value = serde_json::from_slice(&checked.stdout).expect("JSON");
    let criterion = &told["cases"][0]["criteria"][0];
    assert!(criterion["found"].as_f64().is_some_and(f64::is_finite), "{name}: {told}");
    (criterion["found"].as_f64().unwrap_or_default(), checked.status.code())
}

/// `new --modes` writes a case that can be read and decided as it is, whatever its modes come from.
#[test]
fn a_case_to_start_from_has_the_modes_that_were_asked_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let mast = "frequency (Hz), damping_ratio (%), mass (kg), middle, tip\n1.1, 0.5, 30, 0.34, 1\n6.894, 0.5, 30, -0.714, 1\n";
    fs::create_dir(folder.join("below")).expect("a folder");
    fs::write(folder.join("below/mast.csv"), mast).expect("written");
    // Undamped, with a rigid motion that no case has, and a mode that stands twice.
    let [first, second, _] = MAST;
    let free = [[0.0, 1.0, 1.0], first, first, second].map(set_55).concat();
    let free =
        free.replace("  5.00000E-3", "  0.00000E+0").replace("  5.00000E-03", "  0.00000E+00");
    fs::write(folder.join("free.unv"), free).expect("written");
    for (name, modes, count, place) in [
        ("one", "1", 1, "tip"),
        ("three", "3", 3, "tip"),
        ("eight", "8", 8, "tip"),
        ("columns", "below/mast.csv", 2, "tip"),
        ("universal", "free.unv", 2, "tip"),
    ] {
        let output = run_in(folder, &["new", name, "--modes", modes]);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let path = folder.join(format!("{name}.toml"));
        let Ok((AnyCase::Several(case), text)) = read_any(&path, Reach::Folder) else {
            panic!("{name} cannot be read");
        };
        assert_eq!(
            (case.title.as_str(), case.modes.len(), &*case.warnings),
            (name, count, &[][..])
        );
        assert_eq!(case.places[case.absorbers[0].place], place);
        assert!(case.modes.iter().all(|mode| mode.damping_ratio > 0.0), "{text}");
        let own = case.modes[0].frequency_hz;
        assert!((own - 1.1).abs() < 1e-9 && case.loads[0].range_hz[0] < own, "{text}");
        // Where an existing file is, nothing is written.
        let again = run_in(folder, &["new", name, "--modes", modes]);
        assert_eq!(again.status.code(), Some(2));
    }
    for name in ["columns", "universal"] {
        let (found, code) = decided(folder, &format!("{name}.toml"));
        assert!(found > 1e-3 && found < 1e-2, "{name}: {found}");
        assert!(matches!(code, Some(0 | 1)), "{name}: {code:?}");
    }
    let universal = fs::read_to_string(folder.join("universal.toml")).expect("read");
    assert!(universal.contains("\nnumbers = [2, 4] "), "{universal}");
    assert!(universal.contains("places = { tip = \"12 z\" }"), "{universal}");
    assert!(universal.contains("\ndamping_ratio = \"0.5 %\" "), "{universal}");
}

/// What cannot be written is said with what to do, and nothing is left behind.
#[test]
fn a_case_to_start_from_is_refused_with_what_to_do() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    fs::write(folder.join("rigid.unv"), set_55([0.0, 1.0, 1.0])).expect("written");
    fs::write(folder.join("text.csv"), "no modes\n").expect("written");
    fs::write(folder.join("empty.csv"), "\n").expect("written");
    let note = "frequency (Hz),damping_ratio (%),mass (kg),tip,note\n1.1,0.5,30,1.0,1st\n";
    fs::write(folder.join("note.csv"), note).expect("written");
    fs::create_dir(folder.join("cases")).expect("a folder");
    for (name, modes, words) in [
        ("a", "0", "--modes 0: a case has 1 to 8 modes"),
        ("a", "9", "--modes 9: a case has 1 to 8 modes"),
        ("a", "mast.csv", "--modes mast.csv: there is no such file"),
        ("a", "text.csv", "text.csv is not a table of modes"),
        ("a", "empty.csv", "empty.csv is empty"),
        ("a", "note.csv", "places = { tip = "),
        ("a", "rigid.unv", "no case can have any of its modes: mode 1 has 0 Hz"),
        ("cases/a", "rigid.unv", "rigid.unv is not in the folder of cases/a.toml"),
    ] {
        // The first that is wrong is told.
        if name != "a" {
            fs::write(folder.join("rigid.unv"), set_55(MAST[0])).expect("written");
        }
        let output = run_in(folder, &["new", name, "--modes", modes]);
        let told = String::from_utf8_lossy(&output.stderr).replace("\n  │ ", " ");
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(words) && told.contains("help: "), "{words}: {told}");
        assert!(!folder.join(format!("{name}.toml")).exists());
    }
    for other in [["--guide", ""], ["--kind", "force"], ["--mass", "3 kg"]] {
        let other: Vec<&str> = other.into_iter().filter(|one| !one.is_empty()).collect();
        let all = [&["new", "a", "--modes", "3"], &other[..]].concat();
        let told = String::from_utf8_lossy(&run_in(folder, &all).stderr).into_owned();
        assert!(told.contains("cannot be used with"), "{told}");
    }
}

/// Every table and key that such a case may have is shown, and all can be used as they stand.
#[test]
fn a_case_to_start_from_shows_every_key() {
    let modes = StartingModes::uniform(2).expect("two");
    let text = ModalCase::starting_text("quote \" and TITLE", &modes, 0.03);
    let plain = ModalCase::parse("start.toml", &text).expect("read");
    assert_eq!(plain.title, "quote \" and TITLE");
    let uncommented = |line: &str| {
        let rest = line.strip_prefix("# ")?;
        let key = rest.split_once(" = ").map_or("", |(key, _)| key);
        let is_key =
            !key.is_empty() && key.chars().all(|one| one.is_ascii_lowercase() || one == '_');
        (rest.starts_with('[') || is_key).then(|| rest.to_owned())
    };
    let full: Vec<String> =
        text.lines().map(|line| uncommented(line).unwrap_or_else(|| line.to_owned())).collect();
    let full = full.join("\n");
    let schema = &vinesink::case::schema()["$defs"]["several"]["properties"];
    for table in
        ["mode", "absorber", "excitation", "simulation", "report", "accuracy", "alternatives"]
            .into_iter()
            .chain(["criteria", "optimize", "uncertainty", "sweep"])
    {
        let of = &schema[table];
        let of = if of["properties"].is_object() { of } else { &of["anyOf"][0] };
        let keys = of["properties"].as_object().unwrap_or_else(|| panic!("{table}: {of}"));
        let head = [format!("[[{table}]]"), format!("\n[{table}]\n")];
        let own =
            head.iter().find_map(|head| Some(full.split_once(head.as_str())?.1)).expect(table);
        let own = own.split("\n[").next().unwrap_or(own);
        // What has no meaning with several modes is not shown.
        let none = ["discard", "coexistence"];
        let axes = ["frequency", "amplitude", "absorber_mass"];
        for key in keys.keys().filter(|key| !none.contains(&key.as_str())) {
            let named = table == "sweep" && axes.contains(&key.as_str()) && text.contains(key);
            let shown = own.contains(&format!("{key} = ")) || named;
            assert!(shown, "{key} of [{table}] is not shown");
        }
    }
    let full = ModalCase::parse("start.toml", &full).expect("read with all of its lines");
    assert!(full.sweep.is_some() && full.uncertainty.is_any() && full.criteria.len() == 13);
}
