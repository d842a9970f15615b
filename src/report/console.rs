//! What `analyze` and `simulate` print: templates over the same facts as a report, and the documents that other
//! programs read.
//!
//! Both documents have the format of `report.json` and say what was asked; they have what scripts rely on under its own
//! name, and beside it the quantities of `report.json`. Lengths named `_over_clearance`, and `B` and `C`, are over the clearance;
//! other lengths are in metres for a physical case and in the case's own unit for a reduced one. Energies are in
//! joules, or per `m1 omega0^2` in the case's own unit of length squared. Angles are in radians.
//!
//! For the program itself: this module may change at any time.

use serde_json::{Value, json};

use super::document::place::FilePlace;
use super::document::{Content, Scale, answer, motions, theory, theory_limits};
use super::error::RenderError;
use super::template;
use crate::analysis::ManifoldPoint;
use crate::answer::{self, Answer};
use crate::case::Case;
use crate::method::Method::{ExactOrbit, Simulation, Theory};
use crate::motions::{Measured, Motion, Motions};
use crate::orbits::SymmetricOrbit;
use crate::quantity::catalogue as of;
use crate::study::fidelity::Answers;

/// Theory and exact orbits of a case.
#[derive(Debug, Clone, Copy)]
pub struct Analysed<'a> {
    /// The case.
    pub case: &'a Case,
    /// Its theory and exact orbits.
    pub theory: &'a answer::Theory,
    /// Its long-term motions; none where nothing was simulated.
    pub motions: Option<&'a Motions>,
    /// Answers to what the case asks for, if anything was.
    pub answers: Option<&'a Answers>,
}

impl<'a> Analysed<'a> {
    /// That of an answer; none where no analysis was asked for.
    pub fn of(case: &'a Case, answer: &'a Answer) -> Option<Self> {
        let Answer { theory, motions, answers, .. } = answer;
        let (motions, answers) = (motions.as_ref(), answers.as_ref());
        Some(Self { case, theory: theory.as_ref()?, motions, answers })
    }
}

impl Analysed<'_> {
    fn theory(&self) -> Value {
        theory::theory(&Scale::of(self.case), &self.theory.analysis, &self.theory.exact)
    }

    fn motions(&self) -> Option<Vec<Value>> {
        let listed =
            |found| motions::listed(&Scale::of(self.case), found, self.case.count_inactive);
        self.motions.map(listed)
    }

    /// For a person.
    ///
    /// # Errors
    /// [`RenderError::Template`] if the template does not fit.
    pub fn text(&self) -> Result<String, RenderError> {
        let Self { case, theory: answer::Theory { analysis, .. }, answers, .. } = self;
        let scale = Scale::of(case);
        let point = |point: &ManifoldPoint| {
            [
                scale.units.quantity(&of::ABSORBER_AMPLITUDE, point.absorber_amplitude, Theory),
                scale.units.quantity(&of::OSCILLATOR_AMPLITUDE, point.oscillator_amplitude, Theory),
            ]
        };
        // Where saddle-node and Hopf meet.
        let p1 = analysis.boundaries.codimension_two;
        let frequency_ratio = 1.0 + analysis.system.mass_ratio() * p1.detuning;
        let page = json!({
            "title": case.title,
            "limits": theory_limits(&analysis.system),
            "theory": self.theory(),
            "fold": point(&analysis.manifold.fold),
            "symmetry_breaking": point(&analysis.manifold.symmetry_breaking),
            "p1": {
                "detuning": p1.detuning,
                "forcing": p1.forcing_over_clearance,
                "frequency": scale.frequency(frequency_ratio, Theory),
            },
            "motions": self.motions(),
            "answers": answers,
        });
        template::render("analyze.txt", &scale.units, &page)
    }

    /// For programs. `theory` is that of `report.json`; `exact` is all that the exact
    /// layer found, over the clearance and with its evidence.
    pub fn document(&self) -> Value {
        let Self { case, theory: answer::Theory { analysis, exact }, .. } = self;
        let (scale, system) = (Scale::of(case), &analysis.system);
        let forcing = case.design.forcing();
        let boundaries = &analysis.boundaries;
        let nodes = boundaries.saddle_node.iter().map(|node| {
            json!({
                "clearance": forcing / node.forcing_over_clearance,
                "B": node.absorber_amplitude,
                "branch": node.branch,
            })
        });
        let mut document = json!({
            "reduced": {
                "mass_ratio": system.mass_ratio(),
                "damping": system.damping(),
                "restitution": system.restitution(),
                "frequency_ratio": system.frequency_ratio(),
                "detuning": system.detuning(),
                "forcing_over_clearance": system.forcing_per_clearance(),
                "excitation": system.excitation(),
            },
            "manifold": {
                "fold": analysis.manifold.fold,
                "symmetry_breaking": analysis.manifold.symmetry_breaking,
            },
            "fixed_points": analysis.fixed_points,
            "boundaries": {
                "symmetry_breaking_clearance": forcing / boundaries.symmetry_breaking,
                "hopf_clearance": forcing / boundaries.hopf,
                "saddle_node": nodes.collect::<Vec<_>>(),
                "codimension_two": boundaries.codimension_two,
            },
            "area": analysis.zone.area,
            "strip": analysis.zone.strip,
            "orbits": exact.orbits.iter().map(|one| orbit(&scale, one)).collect::<Vec<_>>(),
            "motions": self.motions(),
            "theory": self.theory(),
            "exact": exact,
        });
        if !system.cavity().is_ideal() {
            document["cavity"] = json!(analysis.cavity);
            for (key, value) in json!(system.cavity()).as_object().into_iter().flatten() {
                document["reduced"][key] = value.clone();
            }
        }
        if let Some(answers) = self.answers {
            document["answers"] = json!(answers);
        }
        warned(answer(case, Content::Analysis, document), case)
    }
}

/// An exact symmetric orbit.
fn orbit(scale: &Scale, orbit: &SymmetricOrbit) -> Value {
    let length = |value: f64| scale.units.quantity(&of::PEAK, value, ExactOrbit).value;
    let found = &orbit.orbit;
    json!({
        "impact_displacement": length(orbit.impact_displacement),
        "peak_displacement": length(orbit.peaks.displacement),
        "phase": orbit.phase,
        "multipliers": found.multipliers.values,
        "spectral_radius": found.multipliers.spectral_radius(),
        "admissible": found.admissibility.admissible,
        "stable": found.attracts(),
        "residual": found.convergence.residual,
    })
}

/// A motion of a case, and those that it was chosen from where no initial state was given.
#[derive(Debug, Clone, Copy)]
pub struct Simulated<'a> {
    /// The case.
    pub case: &'a Case,
    /// The motion.
    pub measured: &'a Measured,
    /// Every long-term motion, of which it is the main one.
    pub found: Option<&'a Motions>,
}

impl Simulated<'_> {
    /// The motion as in `report.json`.
    fn motion(&self) -> Value {
        let (scale, system) = (Scale::of(self.case), self.case.system());
        let (measured, counts) = (self.measured, self.case.count_inactive);
        let main = self.found.and_then(|found| Some((found, found.main_index()?)));
        let told = main.and_then(|(found, index)| {
            motions::in_full(&scale, &system, found, (index, measured), counts)
        });
        told.unwrap_or_else(|| motions::measured(&scale, &system, measured))
    }

    fn motions(&self) -> Option<Vec<Value>> {
        let listed =
            |found| motions::listed(&Scale::of(self.case), found, self.case.count_inactive);
        self.found.map(listed)
    }

    /// For a person.
    ///
    /// # Errors
    /// [`RenderError::Template`] if the template does not fit.
    pub fn text(&self) -> Result<String, RenderError> {
        let (motion, motions) = (self.motion(), self.motions());
        let page = json!({ "title": self.case.title, "motion": motion, "motions": motions });
        template::render("simulate.txt", &self.case.units(), &page)
    }

    /// For programs. `motion` is that of `report.json`, and `motions` the list of all;
    /// `classification`, `energetics` and `orbit` are the evidence: per m1, lengths over the clearance, fast time.
    pub fn document(&self) -> Value {
        let scale = Scale::of(self.case);
        let energy = |value: f64| scale.units.quantity(&of::WORK, value, Simulation).value;
        let (measured, told) = (self.measured, self.motion());
        let balance = &measured.energy;
        let mut document = json!({
            "periods": measured.periods,
            "impacts": measured.impact_count,
            "impacts_per_period": told["impacts_per_period"]["value"],
            "regime": measured.classification.regime,
            "displacement": { "peak": told["peak"]["value"], "rms": told["rms"]["value"] },
            "impact_speed": told["impact_speed"]["value"],
            "settled": measured.settled,
            "energy": {
                "input": energy(balance.input),
                "damper": energy(balance.damper),
                "impact": energy(balance.impact),
                "stored": energy(balance.stored),
                "relative_residual": balance.relative_residual,
            },
            "sustained_contact": measured.sustained_contact,
            "stop": measured.stop,
            "trusted": measured.doubts().is_empty(),
            "doubts": told["doubts"],
            "classification": measured.classification,
            "energetics": measured.energetics,
            "motion": told,
            "motions": self.motions(),
        });
        if let Some(orbit) = self.found.and_then(Motions::main).and_then(Motion::orbit) {
            document["orbit"] = json!(orbit);
        }
        warned(answer(self.case, Content::Simulation, document), self.case)
    }
}

/// A document with what is probably a slip in the case; left out where nothing is.
fn warned(mut document: Value, case: &Case) -> Value {
    let warnings: Vec<FilePlace> = case.warnings().iter().map(FilePlace::from).collect();
    if !warnings.is_empty() {
        document["warnings"] = json!(warnings);
    }
    document
}
