//! What is optimised: an objective as a function of the design, as it is written or as it is built.

use super::OptimizeError;
use crate::band::exact::stability;
use crate::band::simulated::Sampling;
use crate::band::{Band, Motions, SurveySettings, margin, theory};
use crate::case::{BandOver, Case, Design, Objective};
use crate::criteria;
use crate::executor::Executor;
use crate::system::Parameter;

/// Clearances looked at where the case gives no bounds, over its own.
const CLEARANCES: [f64; 2] = [0.2, 5.0];

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
    /// How thoroughly a band is simulated where that decides.
    pub sampling: Sampling,
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
        let usual = if ideal { Objective::Z3Share } else { Objective::StableShare };
        let objective = objective.or(settings.objective).unwrap_or(usual);
        if !ideal && objective == Objective::Z3Share {
            return Err(OptimizeError::RealCavity);
        }
        let usual = CLEARANCES.map(|factor| factor * case.design.clearance());
        let given = [
            (Parameter::Clearance, Some(settings.clearance.unwrap_or(usual))),
            (Parameter::Restitution, settings.restitution),
            (Parameter::AbsorberMass, settings.mass),
        ];
        let bounds = given.into_iter().filter_map(|(parameter, bounds)| {
            bounds.map(|[from, to]| Bounds { parameter, from, to })
        });
        Ok(Self {
            case: case.clone(),
            objective,
            bounds: bounds.collect(),
            sampling: criteria::sampling(case),
        })
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

    /// The band of a design; one of frequencies is shifted by as much as the design's own frequency is off the
    /// case's. `None` where no system has such values.
    pub fn band_of(&self, design: &Design) -> Option<Band> {
        let base = design.system().ok()?;
        let Some(settings) = &self.case.band else { return Some(Band::point(&base)) };
        let mut band = Band::of(&base, settings);
        if band.over == BandOver::Frequency {
            let shift = base.frequency_ratio() - self.case.design.system().ok()?.frequency_ratio();
            band.range = band.range.map(|end| end + shift);
            band.spectrum.iter_mut().for_each(|corner| corner[0] += shift);
        }
        Some(band)
    }

    /// An exact objective of a band, the more the better: a share, or a relative distance. `None` for an
    /// amplitude.
    pub fn exact_score(&self, band: &Band) -> Option<f64> {
        match self.objective {
            Objective::Z3Share => Some(band.share(&theory::zones(band), |zone| zone.is_z3())),
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
        let settings = SurveySettings {
            sampling: Some(self.sampling),
            count_inactive: self.case.count_inactive,
        };
        let worst = Motions::of(&band, &settings, executor).ok()?.worst()?;
        Some(-design.clearance() * (worst.peak + worst.error))
    }

    /// The value of the objective as it is spoken of: an amplitude is not negative.
    pub fn value(&self, score: f64) -> f64 {
        if self.objective == Objective::WorstAmplitude { -score } else { score }
    }
}
