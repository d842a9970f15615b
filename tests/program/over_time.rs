//! Motions of several modes and absorbers over time, and their impacts in a file.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use vinesink::case::{ModalCase, PlacedAbsorber};
use vinesink::executor::Serial;
use vinesink::modal::{Beside, ModalAnswer, OverTime};
use vinesink::motions::ModalMotion;
use vinesink::report::modal::files;
use vinesink::simulation::{ModalTrace, Reading};
use vinesink::system::ModalSystem;

use super::run::{message, vinesink};

const FLOOR: &str = "cases/several/floor.toml";
const HEAD: &str = "title = 't'\nsource = 's'\n";

/// Two absorbers of a structure of two modes that both impact, at one frequency.
fn two_absorbers() -> String {
    format!(
        "{HEAD}[[mode]]\nfrequency = '2 Hz'\ndamping_ratio = 0.01\nmass = '20 t'\nshape = {{ middle = 1.0, quarter = 0.707 }}\n\
         [[mode]]\nfrequency = '7.7 Hz'\ndamping_ratio = 0.01\nmass = '20 t'\nshape = {{ middle = 0.0, quarter = 1.0 }}\n\
         [[absorber]]\nplace = 'middle'\nmass = '300 kg'\nclearance = '9 mm'\nrestitution = 0.6\n\
         [[absorber]]\nplace = 'quarter'\nmass = '200 kg'\nclearance = '4 mm'\nrestitution = 0.5\n\
         [[excitation]]\nkind = 'force'\nplace = 'middle'\namplitude = '900 N'\nfrequency = '2 Hz'\n\
         [criteria]\npeak_displacement = '<= 20 mm'\n"
    )
}

/// One of a structure of one mode with a place beside it, whose absorber has so much room.
fn one_absorber(clearance: &str) -> String {
    format!(
        "{HEAD}[[mode]]\nfrequency = '8.35 Hz'\ndamping_ratio = '0.69 %'\nmass = '4.168 kg'\n\
         shape = {{ a = 1.0, b = 0.5 }}\n[[absorber]]\nplace = 'a'\nmass = '32 g'\nclearance = '{clearance} mm'\n\
         restitution = 0.6\n[[excitation]]\nkind = 'force'\nplace = 'a'\namplitude = '2.867 N'\nfrequency = '8.5 Hz'\n\
         [criteria]\npeak_displacement = '<= 5.5 mm'\n"
    )
}

fn answered(text: &str) -> (ModalCase, ModalAnswer) {
    let case = ModalCase::parse("case.toml", text).expect("a case");
    let answer = ModalAnswer::of(&case, &Serial).expect("flown");
    (case, answer)
}

/// The lines of a file of impacts behind its head, as numbers; ids of motions without their letter.
fn lines(text: &str) -> Vec<Vec<f64>> {
    let number = |word: &str| word.trim_start_matches('m').parse().expect("a number");
    text.lines().skip(1).map(|line| line.split(',').map(number).collect()).collect()
}

/// The impacts of a case as the program writes them.
fn written(text: &str, further: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let [case, out] = ["case.toml", "impacts.csv"].map(|name| folder.path().join(name));
    fs::write(&case, text).expect("written");
    let [case, out] = [&case, &out].map(|path| path.display().to_string());
    let mut all = vec!["simulate", &case, "--impacts", &out];
    all.extend(further);
    let output = vinesink(&all);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    fs::read_to_string(&out).expect("impacts")
}

/// Two engines, that of one mode and that of several, give the same impacts of an orbit that attracts. What is left of a start of the one
/// after 3,000 periods, and the errors of either event search over a period, are below 1e-9 of each number's size.
#[test]
fn one_mode_has_the_same_impacts_however_it_is_written() {
    let [mass, hertz, clearance, at] = [2e4, 2.1, 4.563e-3, 2.12];
    let structure = |mass: f64| {
        format!("mass = '{mass} kg'\nfrequency = '{hertz} Hz'\ndamping_ratio = 0.004\n")
    };
    let absorber = format!("mass = '400 kg'\nclearance = '{clearance:?} m'\nrestitution = 0.413\n");
    let driven =
        |newton: f64| format!("kind = 'force'\namplitude = '{newton} N'\nfrequency = '{at} Hz'\n");
    let one = format!(
        "{HEAD}[oscillator]\n{}[absorber]\n{absorber}[excitation]\n{}",
        structure(mass),
        driven(280.0)
    );
    // A force in a mode is one of several modes: here with the displacement at the place twice that of the mode.
    let several = format!(
        "{HEAD}[[mode]]\n{}shape = {{ a = 2.0 }}\n[[absorber]]\n{absorber}[[excitation]]\nmode = 1\n{}",
        structure(4.0 * mass),
        driven(560.0)
    );
    let periods = ["--periods", "20"];
    let one = written(&one, &[&periods[..], &["--discard", "3000"]].concat());
    let several = written(&several, &periods);
    let (one, several) = (lines(&one), lines(&several));
    assert_eq!([one.len(), several.len()], [40, 40]);
    let omega = TAU * hertz;
    let period = 1.0 / at;
    // Each as time in its period, side, displacement and velocities, in SI.
    let of_one = one.iter().map(|line| {
        let speeds = line[3..7].iter().map(|one| one * clearance * omega);
        let head = [(line[0] / omega) % period, line[1], line[2] * clearance];
        head.into_iter().chain(speeds).collect::<Vec<_>>()
    });
    let of_several = several.iter().map(|line| {
        assert_eq!((line[2], line[8], line[9], line[10]), (1.0, 1.0, at, 1.0));
        let speeds = line[4..8].iter().map(|one| one * clearance * omega);
        let head = [(line[0] / omega) % period, line[1], line[3] * clearance];
        head.into_iter().chain(speeds).collect::<Vec<_>>()
    });
    // The orbit has one impact on each wall in a period, half a period apart.
    let sorted = |mut all: Vec<Vec<f64>>| {
        all.sort_by(|a, b| a[1].total_cmp(&b[1]));
        all
    };
    let sizes = [period, 1.0, clearance, clearance * omega];
    let pairs = sorted(of_one.collect()).into_iter().zip(sorted(of_several.collect()));
    for (a, b) in pairs {
        for (k, (a, b)) in a.iter().zip(&b).enumerate() {
            assert!((a - b).abs() < 1e-9 * sizes[k.min(3)], "{k}: {a} {b}");
        }
    }
}

/// Between impacts every absorber stays between its walls; at an impact it stands on one, the relative velocity turns with the restitution,
/// and what the absorber gains in momentum the modes lose.
fn obeys_the_laws_of_impact(
    system: &ModalSystem,
    absorbers: &[PlacedAbsorber],
    trace: &ModalTrace,
) {
    for (j, gaps) in trace.gaps.iter().enumerate() {
        let most = gaps.iter().fold(0.0, |most: f64, gap| most.max(gap.abs()));
        // Rounding of a place at an impact.
        assert!(most <= absorbers[j].clearance_m * (1.0 + 1e-9), "{j}: {most}");
    }
    assert!(trace.periods.windows(2).all(|pair| pair[0] <= pair[1] + 1e-9));
    for one in &trace.impacts {
        let at = one.tau / system.period();
        let near = trace.periods.partition_point(|time| *time < at - 1e-9);
        let (j, of) = (one.absorber, &absorbers[one.absorber]);
        // That before and that behind it.
        for k in [near, near + 1] {
            assert!((trace.periods[k] - at).abs() < 1e-9, "{} {at}", trace.periods[k]);
            let gap = trace.gaps[j][k] * one.side.sign();
            assert!((gap / of.clearance_m - 1.0).abs() < 1e-9, "{gap} {}", of.clearance_m);
        }
        let [before, after] = [0, 1].map(|k| one.x_velocity[k] - one.y_velocity[k]);
        assert!(before * one.side.sign() > 0.0, "it comes from within: {before}");
        assert!((after + of.restitution * before).abs() < 1e-12 * before.abs().max(1e-3));
        let gained = of.mass_kg * (one.y_velocity[1] - one.y_velocity[0]);
        let yields = system.modes().iter().map(|mode| mode.shape[j] * mode.shape[j] / mode.mass);
        let lost = (one.x_velocity[1] - one.x_velocity[0]) / yields.sum::<f64>();
        assert!((gained + lost).abs() < 1e-9 * gained.abs(), "{gained} {lost}");
    }
}

#[test]
fn a_trace_obeys_the_laws_of_impact_and_stays_below_the_peaks() {
    let (case, answer) = answered(&two_absorbers());
    let system = case.system(&case.loads[0], 2.0).expect("a structure");
    let moving: Vec<&ModalMotion> =
        answer.along[0].places[0].motions.iter().filter(|one| !one.rests()).collect();
    assert!(!moving.is_empty());
    for motion in &moving {
        let trace = motion.trace(200, 40.0).expect("flown");
        let each = [0, 1].map(|j| trace.impacts.iter().filter(|one| one.absorber == j).count());
        assert!(each.iter().all(|count| *count > 20), "{each:?}");
        obeys_the_laws_of_impact(&system, &case.absorbers, &trace);
        let long = motion.trace(10_000, 40.0).expect("flown");
        assert_eq!(long.places.len(), 2);
        for (place, told) in long.places.iter().zip(motion.read(Reading::Displacement)) {
            let most = place.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            assert!(most <= told.peak + told.error + 1e-12, "{most} {told:?}");
            assert!(most >= 0.95 * told.peak, "{most} {told:?}");
        }
        // Impacts alone are the same.
        let alone = motion.trace(200, 0.0).expect("flown");
        assert_eq!((&alone.impacts, alone.periods.len()), (&trace.impacts, 0));
    }
}

/// An absorber that rests while the other impacts stands still: its relative displacement is that of its place, and impacts are those of
/// the other, by its own number.
#[test]
fn an_absorber_that_rests_stands_still_in_a_trace() {
    let text = fs::read_to_string(FLOOR).expect("a case").replacen("0.85 mm", "1.05 mm", 1);
    let text = text.replacen("from = \"4.8 Hz\"\nto = \"5.6 Hz\"", "frequency = \"5.2 Hz\"", 1);
    let (case, answer) = answered(&text);
    let all = answer.along.iter().flat_map(|along| &along.places).flat_map(|one| &one.motions);
    let some = all.filter(|one| !one.rests() && one.state.is_none());
    let (mut seen, mut impacts) = (0, 0);
    for motion in some {
        let trace = motion.trace(50, 60.0).expect("flown");
        for (j, absorber) in case.absorbers.iter().enumerate() {
            let own = trace.impacts.iter().filter(|one| one.absorber == j).count();
            if motion.resting[j].is_none() {
                impacts += own;
                continue;
            }
            assert_eq!((own, &trace.gaps[j]), (0, &trace.places[absorber.place]));
            seen += 1;
        }
    }
    assert!(seen > 0 && impacts > 100, "none rests while another impacts: {seen} {impacts}");
}

/// What is shown is the worst motion; where that is one in which every absorber rests, one with impacts at the same frequency.
#[test]
fn the_worst_motion_with_impacts_is_shown() {
    let (case, answer) = answered(&one_absorber("6.5"));
    let worst = answer.worst(&case, Some(0)).expect("found").found;
    assert!(worst.rests());
    let shown = OverTime::of(&case, &answer, 0).expect("an orbit");
    assert!(!shown.is_worst && shown.motion != worst.motion && Some(shown.at) == worst.at);
    let (case, answer) = answered(&one_absorber("6.45"));
    let shown = OverTime::of(&case, &answer, 0).expect("an orbit");
    assert!(shown.is_worst && shown.place == 0 && shown.absorbers == [0]);
    assert_eq!((shown.periods, shown.impacts.len()), (6, 12));
    let end = shown.times_s.last().expect("samples");
    assert!((end * 8.5 - 6.0).abs() < 1e-9, "{end}");
    let motion = &answer.along[0].places[0].motions[shown.motion];
    let most = shown.displacement_m.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let peak = motion.sensors[0].peak;
    assert!(most <= peak * (1.0 + 1e-9) && most > 0.99 * peak, "{most} {peak}");
    assert_eq!([shown.displacement_m.len(), shown.gaps_m[0].len()], [shown.times_s.len(); 2]);
    // Where every motion rests there is nothing to show, and no impact.
    let (case, mut answer) = answered(&one_absorber("6.5"));
    answer.along[0].places[0].motions.retain(ModalMotion::rests);
    assert!(answer.worst(&case, Some(0)).is_some() && OverTime::all(&case, &answer).is_empty());
    assert_eq!(answer.impacts(&case, 9).expect("none"), []);
}

/// A page draws what is shown and says which motion it is; where nothing impacts there is no figure.
#[test]
fn a_report_draws_it() {
    let page = |clearance: &str, moves: bool| {
        let (case, mut answer) = answered(&one_absorber(clearance));
        answer.along[0].places[0].motions.retain(|one| moves || one.rests());
        answer.observe(&Serial);
        let over_time = OverTime::all(&case, &answer);
        let beside = Beside { over_time, ..Beside::default() };
        let files = files("case", &case, &answer, &beside).expect("a report");
        let text = |name: &str| {
            files.get(Path::new(name)).map(|bytes| String::from_utf8_lossy(bytes).into_owned())
        };
        (text("report.md").expect("a page"), text("figures/motion.svg"))
    };
    let farther = "it moves farther where every absorber rests";
    let (told, figure) = page("6.5", true);
    let figure = figure.expect("a figure");
    assert!(told.contains("6 excitation periods of the motion with impacts"), "{told}");
    assert!(told.contains(farther) && !told.contains("does not repeat, and may"), "{told}");
    assert!(figure.contains("absorber 1") && figure.contains("walls"), "{figure}");
    // Twelve impacts, each with what is said of it.
    assert_eq!(figure.matches("impact: t = ").count(), 12, "{figure}");
    let (told, figure) = page("6.45", true);
    assert!(figure.is_some() && !told.contains(farther), "{told}");
    let (told, figure) = page("6.5", false);
    assert!(figure.is_none() && !told.contains("motion.svg"), "{told}");
}

#[test]
fn impacts_are_written_load_by_load() {
    let text = fs::read_to_string(FLOOR).expect("a case");
    let csv = written(&text, &["--periods", "9"]);
    let head =
        "tau,side,absorber,x,xdot_before,xdot_after,ydot_before,ydot_after,load,frequency,motion";
    assert_eq!(csv.lines().next(), Some(head));
    let all = lines(&csv);
    for load in [1.0, 2.0] {
        let of_load: Vec<&Vec<f64>> = all.iter().filter(|line| line[8] == load).collect();
        assert!(of_load.len() > 18, "{load}: {}", of_load.len());
        assert!(of_load.windows(2).all(|pair| pair[0][0] <= pair[1][0]), "not in order of time");
        let [last, frequency] = [0, 9].map(|column| of_load[of_load.len() - 1][column]);
        // In periods of the load: the first mode of the floor has 5.2 Hz.
        let last = last / TAU / 5.2 * frequency;
        assert!(last <= 9.0 && last > 8.0, "{last} {frequency}");
        assert!(of_load.iter().all(|line| line[9] == frequency && line[1].abs() == 1.0));
    }
    assert!(all.is_sorted_by_key(|line| line[8]));
}

#[test]
fn what_has_no_meaning_is_refused() {
    let out = tempfile::tempdir().expect("a folder");
    let file = out.path().join("impacts.csv").display().to_string();
    for (further, says) in [
        (&["--initial", "0,0,0,1"][..], "--initial has no meaning for several modes or absorbers"),
        (&["--discard", "5"], "--discard has no meaning for several modes or absorbers"),
    ] {
        let told = message(&[&["simulate", FLOOR, "--impacts", &file], further].concat());
        assert!(told.contains(says), "{told}");
    }
    let told = message(&["simulate", FLOOR, "--periods", "5"]);
    assert!(told.contains("leave out --periods") && told.contains("--impacts"), "{told}");
    let told = message(&["simulate", FLOOR, "--impacts", &file, "--periods", "1e12"]);
    assert!(told.contains("1000000000000 excitation periods"), "{told}");
    let nowhere = out.path().join("no/folder/impacts.csv").display().to_string();
    let told = message(&["simulate", FLOOR, "--impacts", &nowhere, "--periods", "2"]);
    assert!(told.contains("there is no folder") && told.contains("create the folder"), "{told}");
    assert!(fs::read_dir(out.path()).expect("a folder").next().is_none());
}
