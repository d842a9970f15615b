//! What commands do with a case of several modes or absorbers.

use std::path::Path;

use miette::{IntoDiagnostic, Result, miette};
use serde_json::{Value, json};
use vinesink::analysis::Grading;
use vinesink::case::ModalCase;
use vinesink::modal::{self, ModalAnswer, choices, modes_alone};
use vinesink::orbits::antiperiodic_orbits;
use vinesink::program::case_file::name;
use vinesink::program::parallel::Parallel;
use vinesink::report::modal::{Beside, analysis_text, document, files, text};
use vinesink::report::render::Files;

use super::budget::Long;
use super::one_case::OneCase;

/// What is known of it, unless that takes too long.
pub fn answered(path: &Path, case: &ModalCase, long: Long) -> Result<ModalAnswer> {
    long.allows_seconds(path, modal::seconds(case), "motions at each frequency of each load")?;
    ModalAnswer::of(case, &Parallel).into_diagnostic()
}

/// The files of its report.
pub fn report(path: &Path, name: &str, case: &ModalCase, long: Long) -> Result<Files> {
    let answer = answered(path, case, long)?;
    let alone = modes_alone(case, &Parallel).into_diagnostic()?;
    let dampers = choices(case);
    files(name, case, &answer, &Beside { dampers: &dampers, alone: &alone }).into_diagnostic()
}

/// Prints what it does under its loads.
pub fn simulate(one: &OneCase, case: &ModalCase) -> Result<bool> {
    let answer = answered(&one.path, case, one.long)?;
    let nothing = Beside { dampers: &[], alone: &[] };
    let stem = name(&one.path)?;
    let told = || {
        let mut told = document(&stem, case, &answer, &nothing);
        told["asked"] = json!("simulation");
        told
    };
    one.print(|| text(&stem, case, &answer, &nothing), told)?;
    Ok(true)
}

/// Prints its exact orbits under each load, at the frequency of the load or that of the mode in its range.
pub fn analyze(one: &OneCase, case: &ModalCase) -> Result<bool> {
    let mut loads = Vec::new();
    for load in &case.loads {
        let at = load.centre(case);
        let system = case.system(load, at).map_err(|error| {
            miette!(help = "check the values and their units", "{}: {error}", one.path.display())
        })?;
        let orbits = antiperiodic_orbits(&system).into_iter().map(|orbit| {
            let mut told = json!(orbit);
            let radius = orbit.spectral_radius();
            told["spectral_radius"] = json!(radius);
            // Of a whole period.
            told["multiplier"] = json!(radius * radius);
            told["stable"] = json!(orbit.stable());
            told
        });
        let orbits: Vec<Value> = orbits.collect();
        loads.push(json!({ "at": at, "unit": "Hz", "orbits": orbits }));
    }
    let grading: Vec<Grading> =
        case.absorbers.iter().map(|one| Grading::of(one.restitution)).collect();
    let document = json!({
        "format": "vinesink/answer@1",
        "asked": "analysis",
        "title": case.title,
        "source": case.source,
        "units": "si",
        "loads": loads,
        "grading": grading,
    });
    one.print(|| analysis_text(case, &document), || document.clone())?;
    Ok(true)
}
