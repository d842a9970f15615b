//! Figs. 11 and 12 with the drive nearer resonance than Table 1 puts it: sets of parameters, what each gives panel
//! by panel, and two ratios of clearances, in closed form, that no forcing amplitude changes.

use serde_json::{Value, json};

use super::map::{self, HoldsMap};
use super::regimes::FIGURE_11;
use super::{CaseReport, CaseSet, HYSTERESIS, PaperError, PaperFigure, dynamics};
use vinesink::analysis::Analysis;
use vinesink::case::Case;
use vinesink::executor::{self, Executor, Serial};
use vinesink::motions::{Measured, Motions, Place, measured, motions};
use vinesink::regimes::Regime;
use vinesink::report::figure::Figure;
use vinesink::study::StudyError;
use vinesink::system::{Parameters, System};

/// The cases with sets A and B, at the clearance of Fig. 12: a natural frequency and an `F` that give the regimes of
/// the experiment, and a restitution too that gives what else the paper says of panels (a) and (b).
pub const SETS: [&str; 2] = ["li2016-8hz-set-a", "li2016-8hz-set-b"];

/// The panels of Fig. 11 and Fig. 12: letter, case with Table 1 at the clearance, regime of the experiment.
pub(super) fn panels() -> impl Iterator<Item = (&'static str, &'static str, Regime)> {
    FIGURE_11.into_iter().chain([("12", HYSTERESIS, Regime::StronglyModulated)])
}

/// What the paper leaves out, or what is taken as uncertain here.
#[derive(Debug, Clone, Copy)]
pub(super) struct Set {
    /// `f0` in Hz, by another stiffness.
    pub natural_frequency: f64,
    /// `r`.
    pub restitution: f64,
    /// `F` in metres.
    pub amplitude: f64,
}

impl Set {
    pub(super) fn of(case: &Case) -> Self {
        let (units, system) = (case.units(), case.system());
        Self {
            natural_frequency: units.frequency(1.0),
            restitution: system.restitution(),
            amplitude: case.design.forcing() * system.mass_ratio(),
        }
    }

    /// A case's masses, damper and drive with these parameters, at a clearance in metres.
    pub(super) fn system(&self, case: &Case, clearance: f64) -> Result<System, PaperError> {
        let (own, parameters) = (Self::of(case), case.system().parameters());
        let softer = own.natural_frequency / self.natural_frequency;
        let narrower = case.units().length(1.0) / clearance;
        let forcing = self.amplitude / own.amplitude * narrower;
        let system = System::new(Parameters {
            damping: parameters.damping * softer,
            restitution: self.restitution,
            frequency_ratio: parameters.frequency_ratio * softer,
            forcing_per_clearance: parameters.forcing_per_clearance * forcing,
            cavity: parameters.cavity.with_clearance_scaled(1.0 / (narrower * softer * softer)),
            ..parameters
        });
        system.map_err(|error| PaperError::Missing(error.to_string()))
    }

    /// Clearances of boundaries at leading order, in metres, each proportional to `F`: of symmetry breaking; where
    /// steady 1:1 resonance ends, as two fixed points collide on the stable branch or one reaches the fold; and above
    /// which the oscillator alone does not reach the fold.
    pub(super) fn limits(&self, case: &Case) -> Result<[f64; 3], PaperError> {
        let clearance = case.units().length(1.0);
        let system = self.system(case, clearance)?;
        let analysis = Analysis::of(&system).map_err(StudyError::from)?;
        let (found, forcing) = (&analysis.boundaries, system.forcing_per_clearance());
        let end = found.end_of_steady();
        let bare = system.linear_response().map_or(f64::INFINITY, |linear| linear.amplitude());
        let fold = analysis.manifold.fold.oscillator_amplitude;
        Ok([forcing / found.symmetry_breaking, forcing / end, bare / fold].map(|at| at * clearance))
    }

    fn limits_told(&self, case: &Case) -> Result<Value, PaperError> {
        let [breaking, end, fold] = self.limits(case)?;
        Ok(json!({
            "restitution": self.restitution, "breaking": breaking, "end": end, "fold": fold,
            "ratios": [end / breaking, fold / end],
        }))
    }
}

/// The section on both figures as data, and its figures.
pub(super) fn section(
    cases: &CaseSet,
    executor: &dyn Executor,
) -> Result<(Value, Vec<Figure>), PaperError> {
    let members: Vec<&CaseReport> =
        panels().map(|(_, name, _)| cases.case(name)).collect::<Result<_, _>>()?;
    let clearances: Vec<f64> = members.iter().map(|member| member.length(1.0)).collect();
    let published: Vec<_> = members.iter().map(|member| &member.study.motions).collect();
    let case = &cases.case(HYSTERESIS)?.case;
    let table_1 = Set::of(case);
    let mut sets = vec![told(case, &clearances, &published, &dynamics::figure_12(cases)?)?];
    let mut tried = Vec::new();
    for name in SETS {
        let member = cases.case(name)?;
        let motions = at_clearances(&member.case, &clearances, executor)?;
        let transfer = dynamics::transfer(member, member)?;
        sets.push(told(&member.case, &clearances, &motions.iter().collect::<Vec<_>>(), &transfer)?);
        tried.push(Set::of(&member.case));
    }
    let others = [0.5, 0.7].map(|restitution| Set { restitution, ..table_1 });
    let others = others.iter().map(|set| set.limits_told(case)).collect::<Result<Vec<_>, _>>()?;
    let marks = [vec![("Table 1", table_1), ("set A", tried[0])], vec![("set B", tried[1])]];
    let maps = marks.map(|marks| HoldsMap::of(case, marks, &clearances, executor));
    let maps = maps.into_iter().collect::<Result<Vec<_>, _>>()?;
    let told = json!({
        "clearances": clearances,
        "sets": sets,
        "others": others,
        "bounds": map::bounds(&clearances),
        "maps": maps.iter().map(HoldsMap::told).collect::<Vec<_>>(),
        "image": cases.case(SETS[1])?.image("transfer", 860)?,
    });
    Ok((told, vec![map::figure(&maps, case, &clearances)?]))
}

/// The long-term motions of a case at each clearance, from as many starts as a report's.
fn at_clearances(
    case: &Case,
    clearances: &[f64],
    executor: &dyn Executor,
) -> Result<Vec<Motions>, PaperError> {
    let effort = case.effort();
    let found = executor::map(executor, "", clearances.len(), |k| {
        let place = Place::new(&Set::of(case).system(case, clearances[k])?, effort.starts);
        let found = motions(&[place], &effort, &Serial).map_err(StudyError::from)?;
        Ok(found.into_iter().next().unwrap_or_default())
    });
    found.into_iter().collect()
}

/// A set: what it gives in each of [`panels`], and Fig. 12.
fn told(
    case: &Case,
    clearances: &[f64],
    motions: &[&Motions],
    transfer: &PaperFigure,
) -> Result<Value, PaperError> {
    let (mut checks, mut cells) = (Vec::new(), Vec::new());
    let effort = case.effort();
    for (((letter, _, expected), motions), clearance) in panels().zip(motions).zip(clearances) {
        let main = motions.main().ok_or(StudyError::NoMotion)?;
        let system = Set::of(case).system(case, *clearance)?;
        let seen =
            measured(&system, main, &effort, &mut Measured::log()).map_err(StudyError::from)?;
        let evidence = &seen.classification.evidence;
        let moving = || motions.iter().filter(|one| one.rest().is_none());
        let all: u32 = moving().map(|one| one.reached().starts).sum();
        let agreeing = moving().filter(|one| one.regime() == expected);
        let agreeing: u32 = agreeing.map(|one| one.reached().starts).sum();
        let per_period = main.facts().impacts_per_period.value;
        checks.push((letter, agreeing == all));
        match letter {
            "a" => checks.push(("irregular", main.repeats_after().is_none())),
            "b" => checks.push(("three", (per_period - 3.0).abs() < 0.05)),
            _ => {}
        }
        cells.push(json!({
            "found": main.regime().key(),
            "impacts_per_period": per_period,
            "captured": evidence.captures.share,
            "peak": main.facts().peak.value,
            "starts": [agreeing, all],
        }));
    }
    let modulated = checks.pop().is_some_and(|(_, holds)| holds);
    let figure_11 = PaperFigure::new(checks, Value::Null);
    let (set, bare) = (Set::of(case), case.system().linear_response());
    Ok(json!({
        "bare": bare.map_or(f64::INFINITY, |linear| case.units().length(linear.amplitude())),
        "natural_frequency": set.natural_frequency,
        "amplitude": set.amplitude,
        "detuning": case.system().detuning(),
        "limits": set.limits_told(case)?,
        "regimes": modulated && FIGURE_11.iter().all(|(letter, ..)| figure_11.checks[letter]),
        "cells": cells,
        "figure_11": figure_11,
        "figure_12": transfer,
    }))
}
