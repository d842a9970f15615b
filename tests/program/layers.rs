//! Who may use whom: the independence that makes agreement between layers evidence.
//!
//! The truth is the list of rooms below and what each may import. The source is read as text, with
//! comments left out; every path that leads from one room into another is judged. The judge itself
//! is tested on made-up sources, which it must refuse.

use std::fs;
use std::path::{Path, PathBuf};

use regex::Regex;

/// Every room of the library and the rooms that it may use besides itself. Analysis, orbits and
/// simulation are three independent answers to one question and never meet below `validation`. What shows
/// that the product can be trusted, the crate of `evidence`, is used by no room; in it the reference shares
/// nothing with what it judges.
const ROOMS: &[(&str, &[&str])] = &[
    ("bifurcation", &[]),
    ("method", &[]),
    ("names", &[]),
    ("operation_count", &[]),
    ("digest", &[]),
    ("executor", &[]),
    ("figure", &[]),
    ("quantity", &["method", "system"]),
    ("symbolic", &["operation_count"]),
    ("numerics", &["operation_count"]),
    ("system", &["names"]),
    ("equations", &["symbolic", "system"]),
    ("analysis", &["bifurcation", "cavity", "equations", "numerics", "system", "operation_count"]),
    ("cavity", &["equations", "numerics", "system", "operation_count"]),
    ("orbits", &["bifurcation", "executor", "numerics", "symbolic", "system", "operation_count"]),
    ("simulation", &["numerics", "system", "operation_count"]),
    ("evidence/reference", &["system"]),
    // What a structure is subjected to, what it does without the absorber, and flights with it: no case in them.
    ("excitation", &["names", "numerics", "system"]),
    ("linear", &["excitation", "numerics", "operation_count", "system"]),
    (
        "flights",
        &[
            "analysis",
            "dissipation",
            "excitation",
            "executor",
            "linear",
            "method",
            "numerics",
            "operation_count",
            "simulation",
            "system",
        ],
    ),
    // What may be asked, one list for criteria, sweeps, pages and optima.
    ("measure", &["excitation", "linear", "motions", "quantity", "simulation", "system"]),
    // One search, one rule of identity: every command reads what this room has found.
    (
        "motions",
        &[
            "executor",
            "linear",
            "numerics",
            "operation_count",
            "orbits",
            "regimes",
            "simulation",
            "system",
        ],
    ),
    // What the time that an impact takes does to a motion.
    ("contact", &["motions", "numerics", "simulation", "system"]),
    // The same of structures of several modes with several absorbers.
    (
        "modal",
        &[
            "alternatives",
            "analysis",
            "case",
            "contact",
            "criteria",
            "dampers",
            "executor",
            "linear",
            "measure",
            "method",
            "motions",
            "numerics",
            "operating_range",
            "optimize",
            "orbits",
            "quantity",
            "simulation",
            "system",
            "validation",
        ],
    ),
    // What all commands know of a case: the only way from them to a trajectory or a branch of orbits of their own.
    (
        "alternatives",
        &[
            "band",
            "case",
            "criteria",
            "dampers",
            "excitation",
            "executor",
            "flights",
            "linear",
            "measure",
            "motions",
            "system",
            "transient",
        ],
    ),
    ("dampers", &["excitation", "linear", "measure", "system"]),
    (
        "operating_range",
        &[
            "band",
            "case",
            "criteria",
            "excitation",
            "executor",
            "flights",
            "measure",
            "motions",
            "system",
            "transient",
        ],
    ),
    (
        "answer",
        &[
            "alternatives",
            "operating_range",
            "analysis",
            "band",
            "case",
            "criteria",
            "excitation",
            "executor",
            "modal",
            "motions",
            "orbits",
            "simulation",
            "study",
            "system",
            "transient",
        ],
    ),
    (
        "criteria",
        &[
            "band",
            "case",
            "contact",
            "dampers",
            "linear",
            "measure",
            "method",
            "motions",
            "names",
            "quantity",
            "system",
            "transient",
            "validation",
        ],
    ),
    (
        "evidence",
        &[
            "analysis",
            "band",
            "bifurcation",
            "case",
            "evidence/reference",
            "excitation",
            "executor",
            "flights",
            "linear",
            "motions",
            "operation_count",
            "orbits",
            "quantity",
            "regimes",
            "report",
            "simulation",
            "study",
            "system",
            "validation",
        ],
    ),
    (
        "tradeoff",
        &[
            "analysis",
            "case",
            "executor",
            "method",
            "motions",
            "operation_count",
            "orbits",
            "quantity",
            "regimes",
            "report",
            "simulation",
            "study",
            "system",
        ],
    ),
    // What programs share on a command line.
    ("program", &["case", "case_input", "executor", "report", "store"]),
    ("case_input", &["case", "store"]),
    (
        "case_optimum",
        &[
            "answer",
            "case",
            "case_report",
            "criteria",
            "excitation",
            "executor",
            "flights",
            "measure",
            "operating_range",
            "optimize",
            "report",
            "transient",
        ],
    ),
    ("case_report", &["answer", "case", "executor", "report", "study"]),
    ("regimes", &["numerics", "orbits", "simulation", "system", "operation_count"]),
    (
        "dissipation",
        &[
            "analysis",
            "equations",
            "numerics",
            "operation_count",
            "regimes",
            "simulation",
            "system",
        ],
    ),
    (
        "validation",
        &[
            "analysis",
            "band",
            "bifurcation",
            "cavity",
            "dissipation",
            "equations",
            "method",
            "motions",
            "numerics",
            "orbits",
            "regimes",
            "simulation",
            "system",
        ],
    ),
    (
        "study",
        &[
            "analysis",
            "band",
            "bifurcation",
            "case",
            "cavity",
            "dissipation",
            "equations",
            "excitation",
            "executor",
            "flights",
            "linear",
            "method",
            "motions",
            "numerics",
            "operation_count",
            "orbits",
            "regimes",
            "simulation",
            "system",
            "validation",
        ],
    ),
    (
        "case",
        // What a structure alone does says which numbers of a case are slips; what acts like impacts that take time is a case.
        &[
            "contact",
            "digest",
            "excitation",
            "linear",
            "measure",
            "motions",
            "names",
            "numerics",
            "quantity",
            "system",
        ],
    ),
    (
        "transient",
        &[
            "case",
            "excitation",
            "executor",
            "flights",
            "linear",
            "measure",
            "method",
            "motions",
            "numerics",
            "orbits",
            "quantity",
            "simulation",
            "system",
            "dampers",
        ],
    ),
    (
        "optimize",
        &[
            "analysis",
            "band",
            "case",
            "criteria",
            "executor",
            "flights",
            "measure",
            "motions",
            "numerics",
            "operating_range",
            "orbits",
            "quantity",
            "simulation",
            "system",
        ],
    ),
    (
        "band",
        &[
            "analysis",
            "bifurcation",
            "cavity",
            "executor",
            "linear",
            "motions",
            "numerics",
            "orbits",
            "regimes",
            "simulation",
            "system",
            "dampers",
        ],
    ),
    (
        "report",
        &[
            "analysis",
            "answer",
            "band",
            "bifurcation",
            "case",
            "cavity",
            "criteria",
            "dissipation",
            "equations",
            "excitation",
            "executor",
            "figure",
            "flights",
            "linear",
            "measure",
            "method",
            "modal",
            "motions",
            "numerics",
            "optimize",
            "orbits",
            "proposal",
            "quantity",
            "regimes",
            "simulation",
            "study",
            "sweep",
            "symbolic",
            "system",
            "transient",
            "validation",
            "alternatives",
            "operating_range",
        ],
    ),
    (
        "proposal",
        &[
            "analysis",
            "answer",
            "case",
            "criteria",
            "executor",
            "flights",
            "measure",
            "operating_range",
            "optimize",
            "quantity",
            "study",
            "system",
            "transient",
        ],
    ),
    ("diff", &["motions", "quantity", "regimes", "report"]),
    ("store", &["digest"]),
    (
        "sweep",
        &[
            "analysis",
            "band",
            "case",
            "criteria",
            "digest",
            "excitation",
            "executor",
            "flights",
            "linear",
            "measure",
            "modal",
            "motions",
            "orbits",
            "quantity",
            "regimes",
            "simulation",
            "system",
            "transient",
            "validation",
        ],
    ),
];

/// Rooms in which there is physics and nothing else: no files, no clock, no printing, no threads, no
/// randomness.
const PURE: [&str; 30] = [
    "analysis",
    "answer",
    "band",
    "bifurcation",
    "criteria",
    "diff",
    "digest",
    "dissipation",
    "equations",
    "evidence",
    "evidence/reference",
    "excitation",
    "figure",
    "flights",
    "linear",
    "method",
    "motions",
    "numerics",
    "optimize",
    "orbits",
    "quantity",
    "regimes",
    "simulation",
    "study",
    "symbolic",
    "system",
    "operation_count",
    "tradeoff",
    "transient",
    "validation",
];

/// Paths that reach outside of the program.
const OUTSIDE: [&str; 9] = [
    "std::env",
    "std::fs",
    "std::io",
    "std::net",
    "std::process",
    "std::thread",
    "std::time",
    "rand",
    "rayon",
];

/// A room within another one, for which stricter rules hold.
const INNER: [&str; 1] = ["evidence/reference"];

/// The room of a file of `src/`, and how many modules deep its items lie below the crate.
fn place(path: &str) -> (&str, usize) {
    let parts: Vec<&str> = path.trim_end_matches(".rs").split('/').collect();
    let depth = parts.len() - usize::from(parts.last() == Some(&"mod"));
    let inner = INNER.iter().find(|room| path.starts_with(&format!("{room}/")));
    (inner.copied().unwrap_or(parts[0]), depth)
}

/// The source without comments. Text in quotes is kept, so a comment sign in one hides the rest of
/// its line; no path stands there.
fn code(source: &str) -> String {
    source.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

/// `a::{b, c::{d, e}}` as `a::b`, `a::c::d`, `a::c::e`.
fn expanded(tree: &str) -> Vec<String> {
    let tree = tree.trim();
    let Some((prefix, rest)) = tree.split_once('{') else {
        return vec![tree.to_owned()];
    };
    let inside = rest.rsplit_once('}').map_or(rest, |(inside, _)| inside);
    let (mut branches, mut depth) = (vec![String::new()], 0);
    for letter in inside.chars() {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                branches.push(String::new());
                continue;
            }
            _ => {}
        }
        branches.last_mut().expect("never empty").push(letter);
    }
    let branches = branches.iter().filter(|branch| !branch.trim().is_empty());
    branches.flat_map(|branch| expanded(&format!("{prefix}{}", branch.trim()))).collect()
}

/// Every path that a source mentions and that may lead out of its module.
fn paths(source: &str) -> Vec<String> {
    let code = code(source);
    let statement = Regex::new(r"(?s)\buse\s+([^;]+);").expect("a pattern");
    let inline =
        Regex::new(r"\b(?:crate|super|vinesink\w*|std|rand)(?:::\w+)+").expect("a pattern");
    let mut found: Vec<String> =
        statement.captures_iter(&code).flat_map(|use_| expanded(&use_[1])).collect();
    let rest = statement.replace_all(&code, "");
    found.extend(inline.find_iter(&rest).map(|path| path.as_str().to_owned()));
    found
}

/// The room that a path leads to, seen from a module of a room that lies `depth` deep.
fn destination<'a>(path: &'a str, room: &'a str, depth: usize) -> Option<&'a str> {
    let mut steps = path.split("::").map(str::trim);
    let supers = path.split("::").take_while(|step| step.trim() == "super").count();
    let first = match steps.next()? {
        "crate" if room.starts_with("evidence") => "evidence",
        "vinesink_evidence" => "evidence",
        "crate"
        | "vinesink"
        | "vinesink_core"
        | "vinesink_base"
        | "vinesink_orbits"
        | "vinesink_simulation" => steps.next()?,
        "vinesink_figure" => "figure",
        "super" if supers >= depth => steps.nth(supers - 1)?,
        "super" if INNER.contains(&room) && supers + 1 == depth => room.split('/').next()?,
        _ => return None,
    };
    let second = steps.next().map(|second| format!("{first}/{second}"));
    let inner = INNER.iter().find(|room| second.as_deref() == Some(**room));
    if let Some(inner) = inner {
        return Some(inner);
    }
    ROOMS.iter().map(|(room, _)| *room).chain(["cli"]).find(|room| *room == first)
}

/// What a file of `src/` does that its room may not do.
fn violations(path: &str, source: &str) -> Vec<String> {
    let (room, depth) = place(path);
    let mut found = Vec::new();
    let paths = paths(source);
    let allowed = ROOMS.iter().find(|(name, _)| *name == room).map(|(_, allowed)| *allowed);
    match (allowed, room) {
        (Some(allowed), _) => {
            for path in &paths {
                let Some(to) = destination(path, room, depth) else { continue };
                if to != room && !allowed.contains(&to) {
                    found.push(format!("{room} uses {to}: {path}"));
                }
            }
        }
        (None, "cli" | "main" | "lib") => {}
        (None, _) => found.push(format!("{room} is no known room: say here what it may use")),
    }
    let reaches = |path: &str, outside: &str| {
        path == outside || path.strip_prefix(outside).is_some_and(|rest| rest.starts_with("::"))
    };
    for path in &paths {
        let outside = OUTSIDE.iter().find(|outside| reaches(path, outside));
        if PURE.contains(&room) && outside.is_some() {
            found.push(format!("{room} is pure, yet has {path}"));
        }
        if !["store", "cli"].contains(&room) && reaches(path, "std::fs") && !PURE.contains(&room) {
            found.push(format!("only store and cli touch files, yet {room} has {path}"));
        }
    }
    if PURE.contains(&room) {
        let code = code(source);
        let printing = Regex::new(r"\b(?:println|eprintln|print|eprint|dbg)!").expect("a pattern");
        found.extend(printing.find_iter(&code).map(|at| format!("{room} prints: {}", at.as_str())));
    }
    found
}

fn sources() -> Vec<(String, String)> {
    fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                collect(&path, files);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    let mut found = Vec::new();
    // The crates of figures and of evidence are a room each.
    for (folder, within) in [
        ("src", ""),
        ("core/src", ""),
        ("core/base/src", ""),
        ("core/orbits/src", ""),
        ("core/simulation/src", ""),
        ("figure/src", "figure/"),
        ("evidence/src", "evidence/"),
    ] {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        let mut files = Vec::new();
        collect(&root, &mut files);
        files.sort();
        found.extend(files.iter().map(|path| {
            let inside = path.strip_prefix(&root).expect("inside the folder");
            let name = inside.to_str().expect("UTF-8").replace('\\', "/");
            let root = ["lib.rs", "main.rs"].contains(&name.as_str());
            let name = if root { name } else { format!("{within}{name}") };
            (name, fs::read_to_string(path).expect("a source"))
        }));
    }
    found
}

/// Rooms of a list that use one another in a circle, with those above that use them: what is left when every room is
/// taken away which uses none of the others.
fn in_circles<'a>(rooms: &[(&'a str, &[&str])]) -> Vec<&'a str> {
    let mut left = rooms.to_vec();
    loop {
        let names: Vec<&str> = left.iter().map(|(room, _)| *room).collect();
        left.retain(|(_, uses)| uses.iter().any(|used| names.contains(used)));
        if left.len() == names.len() {
            return left.iter().map(|(room, _)| *room).collect();
        }
    }
}

#[test]
fn no_rooms_use_one_another_in_a_circle() {
    assert_eq!(in_circles(ROOMS), [""; 0]);
    let circle: [(&str, &[&str]); 3] = [("a", &["b"]), ("b", &["c", "a"]), ("c", &[])];
    assert_eq!(in_circles(&circle), ["a", "b"]);
}

#[test]
fn every_source_keeps_to_its_room() {
    let sources = sources();
    assert!(sources.len() > 50, "{} files are not the whole program", sources.len());
    let found: Vec<String> = sources
        .iter()
        .flat_map(|(path, source)| {
            violations(path, source).into_iter().map(move |what| format!("{path}: {what}"))
        })
        .collect();
    assert_eq!(found, [""; 0]);
}

/// Rooms that fly nothing: they read what was found, or ask `answer`.
const READERS: [&str; 8] =
    ["band", "case_report.rs", "cli", "criteria", "diff", "optimize", "report", "sweep"];

/// A second way to fly a start would be a second answer.
#[test]
fn nobody_else_flies() {
    let flies =
        Regex::new(r"\b(?:Modal)?(?:Simulation::new|batch::run|Measured::of)|\bmodal_motions\(")
            .expect("a pattern");
    let mut rooms: Vec<String> = Vec::new();
    for (path, source) in sources() {
        let room = path.split('/').next().expect("a room");
        if READERS.contains(&room) {
            assert!(!flies.is_match(&code(&source)), "{path} flies by itself: ask `answer`");
            rooms.push(room.to_owned());
        }
    }
    rooms.dedup();
    assert_eq!(rooms.len(), READERS.len(), "{rooms:?}");
    assert!(flies.is_match("let mut flight = Simulation::new(&system, start, 0.0)?;"));
    assert!(flies.is_match("let mut flight = ModalSimulation::new(&system, start, 0.0)?;"));
}

/// A page tells what was found: what it solves itself no command has seen.
#[test]
fn pages_solve_nothing() {
    let solves = Regex::new(
        r"\b(?:Analysis|CavityAnalysis|CavityTheory|FullSystem|ImpactMap|SteadyOrbit|Survey|CaseStudy|(?:Decay|Sweep|Record)?Study|AbsorberGroup|AlongLoad|AtFrequency|Beside|LoadTheory|ModalAnswer|ModalOptimum|DriftedStructure|OverForce)::(?:of|brief|over)\b|\b(?:steady_orbit|symmetric_orbits|two_impact_orbits|antiperiodic_orbits|at_resonances|choices|designs|modal_motions|modes_alone)\(",
    );
    let solves = solves.expect("a pattern");
    let pages = sources().into_iter().filter(|(path, _)| path.starts_with("report/"));
    let solving: Vec<String> =
        pages.filter(|(_, source)| solves.is_match(&code(source))).map(|(path, _)| path).collect();
    assert_eq!(solving, [""; 0]);
    assert!(solves.is_match("let theory = CavityTheory::of(system);"));
    assert!(solves.is_match("let beside = Beside::of(case, &answer, on)?;"));
    assert!(solves.is_match("let dampers = choices(case);"));
}

/// How long to wait for a motion, which motions are one, and where to look along a range are decided once, for every structure.
#[test]
fn one_search_finds_every_motion() {
    let decided = [
        (r"\bPatience::with\(", "motions/search.rs"),
        (r"\bCluster::all\(", "motions/search.rs"),
        (r"\bworst_between\(", "motions/sampler.rs"),
    ];
    for (what, by) in decided {
        let decides = Regex::new(what).expect("a pattern");
        let all = sources().into_iter().filter(|(_, source)| decides.is_match(&code(source)));
        let mut files: Vec<String> = all.map(|(path, _)| path).collect();
        files.retain(|path| path != "motions/between.rs");
        assert_eq!(files, [by], "{what}");
    }
}

/// A criterion is judged by one rule, of whatever structure: nobody else makes a verdict.
#[test]
fn one_room_judges() {
    let judges = Regex::new(r"[^>]\s+Judged\s*\{").expect("a pattern");
    let others = sources().into_iter().filter(|(path, _)| !path.starts_with("criteria/"));
    let judging: Vec<String> =
        others.filter(|(_, source)| judges.is_match(&code(source))).map(|(path, _)| path).collect();
    assert_eq!(judging, [""; 0]);
    assert!(judges.is_match("let one = Judged { holds: Some(true), ..one };"));
    assert!(!judges.is_match("fn judge(&self) -> Judged {"));
}

/// The judge sees the program's real imports: a pattern that matches nothing would forbid nothing.
#[test]
fn the_imports_of_the_program_are_seen() {
    let of = |wanted: &str| {
        let sources = sources();
        let (_, source) = sources.iter().find(|(path, _)| path == wanted).expect("a source");
        let (room, depth) = place(wanted);
        let mut rooms: Vec<String> = paths(source)
            .iter()
            .filter_map(|path| destination(path, room, depth))
            .map(str::to_owned)
            .collect();
        rooms.sort();
        rooms.dedup();
        rooms
    };
    assert_eq!(of("simulation/steps.rs"), ["numerics", "system"]);
    assert_eq!(of("simulation/flow.rs"), ["operation_count", "system"]);
    assert_eq!(of("analysis/mod.rs"), ["cavity", "system"]);
    let contact = of("evidence/extremes/contact.rs");
    assert_eq!(contact, ["evidence/reference", "simulation", "system"]);
    let study = of("study/mod.rs");
    assert!(study.contains(&"validation".into()) && study.contains(&"case".into()), "{study:?}");
}

#[test]
fn made_up_sources_are_refused() {
    let wrong = [
        ("analysis/areas.rs", "use crate::simulation::Simulation;"),
        ("analysis/areas.rs", "use crate::{system::System, simulation::{run}};"),
        ("analysis/areas.rs", "fn f() -> crate::simulation::Stop { todo!() }"),
        ("analysis/areas.rs", "use super::super::simulation::Stop;"),
        ("analysis/mod.rs", "use super::orbits::Orbit;"),
        ("analysis/deep/er.rs", "pub(crate) use super::super::super::regimes;"),
        ("analysis.rs", "use super::simulation;"),
        ("simulation/run.rs", "use crate::analysis::Analysis;"),
        ("simulation/run.rs", "use crate::orbits::Orbit;"),
        ("simulation/run.rs", "use crate::{\n    numerics,\n    equations::equations,\n};"),
        ("orbits/mod.rs", "use crate::simulation::flow;"),
        ("orbits/mod.rs", "use crate::analysis::Manifold;"),
        ("evidence/reference/mod.rs", "use vinesink::simulation::Simulation;"),
        ("evidence/reference/mod.rs", "use crate::extremes::Run;"),
        ("evidence/reference/mod.rs", "use super::extremes::Run;"),
        ("evidence/reference/real.rs", "use super::super::extremes::Run;"),
        ("study/fidelity.rs", "use crate::tradeoff::Method;"),
        ("report/document/mod.rs", "use crate::tradeoff::ErrorOf;"),
        ("simulation/run.rs", "use vinesink_evidence::reference::Reference;"),
        ("numerics/bracket.rs", "use crate::system::System;"),
        ("symbolic/expr.rs", "use crate::numerics::bracket;"),
        ("validation/mod.rs", "use crate::study::CaseStudy;"),
        ("regimes/mod.rs", "use crate::analysis::Analysis;"),
        ("dissipation/flow.rs", "use crate::orbits::Orbit;"),
        ("analysis/mod.rs", "use crate::dissipation::DissipationCurve;"),
        ("case/mod.rs", "use crate::report::numbers;"),
        ("case/scales.rs", "use crate::transient::Study;"),
        ("case/sweep.rs", "use crate::flights::Ringdown;"),
        ("band/rivals.rs", "use crate::transient::SweepStudy;"),
        ("transient/passage.rs", "use crate::band::Rivals;"),
        ("excitation/record.rs", "use crate::case::Case;"),
        ("linear/motion.rs", "use crate::simulation::Simulation;"),
        ("flights/driven.rs", "use crate::case::Case;"),
        ("study/mod.rs", "use crate::store;"),
        ("report/mod.rs", "let x = crate::store::read_text(path);"),
        ("simulation/run.rs", "use std::time::Instant;"),
        ("simulation/run.rs", "use std::{fs, f64::consts::TAU};"),
        ("study/mod.rs", "let n = std::thread::available_parallelism();"),
        ("study/mod.rs", "let seed = rand::random();"),
        ("study/mod.rs", "use rand::Rng;"),
        ("system.rs", "fn f() { std::env::var(\"X\"); }"),
        ("validation/mod.rs", "fn f() { println!(\"{}\", 1); }"),
        ("validation/mod.rs", "fn f() { dbg!(1); }"),
        ("case/mod.rs", "let text = std::fs::read_to_string(path);"),
        ("main.rs", "use std::fs;"),
        ("report/mod.rs", "use crate::program::output;"),
        ("attic/mod.rs", "fn f() {}"),
    ];
    for (path, source) in wrong {
        assert_eq!(violations(path, source).len(), 1, "{path}: {source}");
    }
}

#[test]
fn made_up_sources_that_keep_to_their_rooms_pass() {
    let right = [
        ("analysis/areas.rs", "use super::manifold::Branch;\nuse crate::system::System;"),
        ("analysis/areas.rs", "//! See [`crate::simulation`].\n/// println!\nuse super::Analysis;"),
        ("analysis/areas.rs", "use crate::numerics::bracket::brent; // not crate::simulation"),
        ("case/mod.rs", "use simulation::SimulationSettings;\nmod simulation;"),
        ("case/table.rs", "use super::simulation::KEYS;"),
        ("study/mod.rs", "use crate::validation::{self, Claim};"),
        ("simulation/run.rs", "mod tests { use super::*; use crate::system::System; }"),
        ("numerics/bracket.rs", "use roots::find_root_brent;"),
        ("store.rs", "use std::fs;"),
        ("evidence/extremes/measure.rs", "use crate::reference::Reference;"),
        ("evidence/reference/mod.rs", "use oscillator::Motion;\nuse vinesink::system::System;"),
        ("evidence/reference/oscillator.rs", "use super::real::Real;"),
        ("program/output.rs", "use std::io; fn f() { println!(); }"),
    ];
    for (path, source) in right {
        assert_eq!(violations(path, source), [""; 0], "{path}: {source}");
    }
}
