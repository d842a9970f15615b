//! What is optimised: an objective as a function of the design, as it is written or as it is built.

use super::OptimizeError;
use crate::analysis::{Boundaries, Manifold};
use crate::band::{Band, Worst, margin, theory};
use crate::case::{Case, Design, Objective};
use crate::executor::Executor;
use crate::motions::{Effort, along, stability};
use crate::quantity::numbers::rounded_to;
use crate::system::Parameter;

/// Clearances looked at where the case gives no bounds, over the largest at which 1:1 resonance ends by theory along the
/// range: far below, an absorber with many impacts per period is hardly one, and above, none is captured for long.
const CLEARANCES: [f64; 2] = [0.025, 1.5];
/// The same over the case's own where the theory has no such clearance.
const BESIDE_OWN: [f64; 2] = [0.2, 5.0];
/// Places of the range at which the theory is asked.
const PLACES: u32 = 25;
/// Digits of bounds that nobody has written.
const DIGITS: usize = 3;

/// A parameter that is chosen and the bounds it stays in, in the units of its design.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// What is chosen.
    pub parameter: Parameter,
    /// From here.
    pub from: f64,
    /// To here.
    pub to: f64,
}

impl Bounds {
    /// The value at a part of the way, from 0 to 1: even in the logarithm but for the restitution.
    pub fn at(&self, part: f64) -> f64 {
        let value = self.parameter.between([self.from, self.to], part.clamp(0.0, 1.0));
        value.clamp(self.from, self.to)
    }

    /// The part of the way at which a design lies; the inverse of [`Bounds::at`].
    pub fn part(&self, design: &Design) -> f64 {
        self.parameter.part([self.from, self.to], self.value(design)).clamp(0.0, 1.0)
    }

    /// What a design has; 0 for a mass that there is not.
    pub fn value(&self, design: &Design) -> f64 {
        design.value(self.parameter).unwrap_or(0.0)
    }
}

/// What is optimised.
#[derive(Debug, Clone, PartialEq)]
pub struct Task {
    /// The case as it stands; its own excitation alone is looked at where it has no band.
    pub case: Case,
    /// What is looked for.
    pub objective: Objective,
    /// What is chosen, the clearance first.
    pub bounds: Vec<Bounds>,
    /// How thoroughly motions are looked for where they decide.
    pub effort: Effort,
}

/// Bounds of the clearance that no case says, which do not depend on what is chosen: a search from its own result looks
/// between the same.
fn usual_clearances(case: &Case) -> [f64; 2] {
    let settings = &case.optimize;
    let ends = |parameter, bounds: Option<[f64; 2]>| {
        bounds.map_or_else(Vec::new, |bounds| bounds.map(|end| (parameter, end)).into())
    };
    let mut designs = vec![case.design];
    for chosen in [
        ends(Parameter::Restitution, settings.restitution),
        ends(Parameter::AbsorberMass, settings.mass),
    ] {
        if !chosen.is_empty() {
            let with = |design: &Design| -> Vec<Design> {
                chosen.iter().map(|(parameter, end)| design.with(*parameter, *end)).collect()
            };
            designs = designs.iter().flat_map(with).collect();
        }
    }
    let of_design = |design: &Design| {
        let base = design.system().ok()?;
        let band = case.band.as_ref().map_or_else(|| Band::point(&base), |band| band.around(&base));
        let manifold = Manifold::of(base.restitution());
        let systems = band.places(PLACES).filter_map(|at| band.system(at).ok());
        let ends = systems.map(|system| {
            system.forcing_per_clearance() / Boundaries::of(&system, &manifold).end_of_steady()
        });
        let largest = ends.filter(|end| end.is_finite()).fold(0.0, f64::max);
        (largest > 0.0).then(|| design.clearance() * largest)
    };
    let largest = designs.iter().filter_map(of_design).fold(0.0, f64::max);
    match largest > 0.0 {
        true => CLEARANCES.map(|factor| rounded_to(factor * largest, DIGITS)),
        false => BESIDE_OWN.map(|factor| factor * case.design.clearance()),
    }
}

impl Task {
    /// That of a case; `objective` overrides the case's own.
    ///
    /// # Errors
    /// [`OptimizeError::NotDriven`] where every absorber is as good as any other, [`OptimizeError::RealCavity`] where
    /// the objective is that of another cavity.
    pub fn of(case: &Case, objective: Option<Objective>) -> Result<Self, OptimizeError> {
        let settings = &case.optimize;
        if case.system().forcing_per_clearance() == 0.0 {
            return Err(OptimizeError::NotDriven);
        }
        let ideal = case.design.has_ideal_cavity();
        let objective =
            objective.or(settings.objective).unwrap_or_else(|| Objective::asked(&case.criteria));
        if !ideal && objective == Objective::Z3Share {
            return Err(OptimizeError::RealCavity);
        }
        let usual = || usual_clearances(case);
        let given = [
            (Parameter::Clearance, Some(settings.clearance.unwrap_or_else(usual))),
            (Parameter::Restitution, settings.restitution),
            (Parameter::AbsorberMass, settings.mass),
        ];
        let bounds = given.into_iter().filter_map(|(parameter, bounds)| {
            bounds.map(|[from, to]| Bounds { parameter, from, to })
        });
        Ok(Self { case: case.clone(), objective, bounds: bounds.collect(), effort: case.effort() })
    }

    /// The design at parts of the way between the bounds; what has none is the case's.
    pub fn choice(&self, parts: &[f64]) -> Design {
        let chosen = self.bounds.iter().zip(parts);
        chosen.fold(self.case.design, |design, (bounds, part)| {
            design.with(bounds.parameter, bounds.at(*part))
        })
    }

    /// The parts of the way at which a design lies; the inverse of [`Task::choice`].
    pub fn parts(&self, choice: &Design) -> Vec<f64> {
        self.bounds.iter().map(|bounds| bounds.part(choice)).collect()
    }

    /// Whether a design keeps to the bounds, but for rounding.
    pub fn allows(&self, choice: &Design) -> bool {
        const ROUNDING: f64 = 1e-12;
        self.bounds.iter().all(|bounds| {
            let value = bounds.value(choice);
            bounds.from * (1.0 - ROUNDING) <= value && value <= bounds.to * (1.0 + ROUNDING)
        })
    }

    /// The band of a design, as the case's own is beside it. `None` where no system has such values.
    pub fn band_of(&self, design: &Design) -> Option<Band> {
        let base = design.system().ok()?;
        let Some(settings) = &self.case.band else { return Some(Band::point(&base)) };
        Some(settings.beside(&self.case.design, design).around(&base))
    }

    /// An exact objective of a band, the more the better: a share, or a relative distance. `None` for an
    /// amplitude.
    pub fn exact_score(&self, band: &Band) -> Option<f64> {
        match self.objective {
            Objective::Z3Share => Some(theory::z3_share(band)),
            Objective::StableShare => Some(band.share(&stability(band), |stable| *stable)),
            Objective::Margin => Some(margin::smallest(band).1),
            Objective::WorstAmplitude => None,
        }
    }

    /// The objective of a design, the more the better: an exact one, or minus the worst amplitude with its error,
    /// in the units of the design, by a full survey. `None` where there is no system, or nothing could be measured.
    pub fn score(&self, design: &Design, executor: &dyn Executor) -> Option<f64> {
        let band = self.band_of(design)?;
        if self.objective != Objective::WorstAmplitude {
            return self.exact_score(&band);
        }
        let found = along(&band, &[], None, Some(&self.effort), executor).ok()?;
        let worst = Worst::of(&found, self.case.count_inactive)?;
        Some(-design.clearance() * (worst.peak.value + worst.peak.error))
    }

    /// The value of the objective as it is spoken of: an amplitude is not negative.
    pub fn value(&self, score: f64) -> f64 {
        if self.objective == Objective::WorstAmplitude { -score } else { score }
    }
}
