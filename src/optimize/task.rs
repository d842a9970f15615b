//! What is optimised: an objective as a function of the absorber, with or without deviations of what is
//! built from what is written.

use serde::Serialize;

use super::OptimizeError;
use crate::band::exact::stability;
use crate::band::simulated::Sampling;
use crate::band::{Band, Motions, SurveySettings, margin, theory};
use crate::case::{AbsorberDesign, BandOver, BandSettings, Case, Design, Objective, Uncertainty};
use crate::criteria;
use crate::executor::Executor;
use crate::system::{Parameter, System};

/// Clearances looked at where the case gives no bounds, over its own.
const CLEARANCES: [f64; 2] = [0.2, 5.0];

/// What is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Variable {
    /// The clearance.
    Clearance,
    /// The restitution.
    Restitution,
    /// The absorber's mass.
    Mass,
}

/// A variable and the bounds it stays in, in the units of a [`AbsorberDesign`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bounds {
    /// What is chosen.
    pub variable: Variable,
    /// From here.
    pub from: f64,
    /// To here.
    pub to: f64,
}

impl Bounds {
    /// The value at a part of the way, from 0 to 1: even in the logarithm but for the restitution.
    pub fn at(&self, part: f64) -> f64 {
        let part = part.clamp(0.0, 1.0);
        let value = match self.variable {
            Variable::Restitution => self.from * (1.0 - part) + self.to * part,
            _ => self.from * libm::pow(self.to / self.from, part),
        };
        value.clamp(self.from, self.to)
    }

    /// The part of the way at which a value lies; the inverse of [`Bounds::at`].
    pub fn part(&self, value: f64) -> f64 {
        let part = match self.variable {
            Variable::Restitution => (value - self.from) / (self.to - self.from),
            _ => libm::log(value / self.from) / libm::log(self.to / self.from),
        };
        part.clamp(0.0, 1.0)
    }
}

/// How far something built is from what is written.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Deviation {
    /// Of the clearance, in the units of a [`AbsorberDesign`].
    pub clearance: f64,
    /// Of the restitution.
    pub restitution: f64,
    /// Of the frequency ratio; a band of frequencies is shifted as a whole.
    pub frequency_ratio: f64,
    /// Of the amplitude over the case's own; that of a whole band in proportion.
    pub amplitude: f64,
}

/// What is optimised.
#[derive(Debug, Clone, PartialEq)]
pub struct Task {
    /// The case's design.
    pub design: Design,
    /// Its band; its own excitation alone where there is none.
    pub band: Option<BandSettings>,
    /// What is looked for.
    pub objective: Objective,
    /// What is chosen, the clearance first.
    pub bounds: Vec<Bounds>,
    /// What is uncertain.
    pub uncertainty: Uncertainty,
    /// How thoroughly a band is simulated where that decides.
    pub sampling: Sampling,
    /// Whether an absorber that never wakes counts.
    pub count_inactive: bool,
}

impl Task {
    /// That of a case; `objective` overrides the case's own.
    ///
    /// # Errors
    /// [`OptimizeError::NotDriven`] where every absorber is as good as any other.
    pub fn of(case: &Case, objective: Option<Objective>) -> Result<Self, OptimizeError> {
        let settings = &case.optimize;
        let own = AbsorberDesign::of(&case.design);
        if case.system().forcing_per_clearance() == 0.0 {
            return Err(OptimizeError::NotDriven);
        }
        let usual = CLEARANCES.map(|factor| factor * own.clearance);
        let given = [
            (Variable::Clearance, Some(settings.clearance.unwrap_or(usual))),
            (Variable::Restitution, settings.restitution),
            (Variable::Mass, settings.mass),
        ];
        let bounds = given.into_iter().filter_map(|(variable, bounds)| {
            bounds.map(|[from, to]| Bounds { variable, from, to })
        });
        Ok(Self {
            design: case.design,
            band: case.band.clone(),
            objective: objective.or(settings.objective).unwrap_or_default(),
            bounds: bounds.collect(),
            uncertainty: case.uncertainty,
            sampling: criteria::sampling(case),
            count_inactive: case.count_inactive,
        })
    }

    /// The absorber at parts of the way between the bounds; what has none is the case's.
    pub fn choice(&self, parts: &[f64]) -> AbsorberDesign {
        let mut choice = AbsorberDesign::of(&self.design);
        for (bounds, part) in self.bounds.iter().zip(parts) {
            let value = bounds.at(*part);
            match bounds.variable {
                Variable::Clearance => choice.clearance = value,
                Variable::Restitution => choice.restitution = value,
                Variable::Mass => choice.mass = Some(value),
            }
        }
        choice
    }

    /// The parts of the way at which an absorber lies; the inverse of [`Task::choice`].
    pub fn parts(&self, choice: &AbsorberDesign) -> Vec<f64> {
        self.bounds.iter().map(|bounds| bounds.part(value_of(bounds.variable, choice))).collect()
    }

    /// Whether an absorber keeps to the bounds, but for rounding.
    pub fn allows(&self, choice: &AbsorberDesign) -> bool {
        const ROUNDING: f64 = 1e-12;
        self.bounds.iter().all(|bounds| {
            let value = value_of(bounds.variable, choice);
            bounds.from * (1.0 - ROUNDING) <= value && value <= bounds.to * (1.0 + ROUNDING)
        })
    }

    /// The band of an absorber that deviates, and its clearance; a restitution stays between 0 and 1.
    /// `None` where no system has such values.
    pub fn band_of(&self, choice: &AbsorberDesign, off: &Deviation) -> Option<(Band, f64)> {
        let choice = AbsorberDesign {
            clearance: choice.clearance + off.clearance,
            restitution: (choice.restitution + off.restitution).clamp(0.0, 1.0),
            mass: choice.mass,
        };
        let mut base: System = self.design.with(&choice).system().ok()?;
        if off.amplitude != 0.0 {
            base = Parameter::Forcing.applied(&base, (1.0 + off.amplitude).max(0.0)).ok()?;
        }
        let shift = off.frequency_ratio;
        if shift != 0.0 {
            base = base.with_frequency_ratio(base.frequency_ratio() + shift).ok()?;
        }
        let mut band = match &self.band {
            Some(settings) => Band::of(&base, settings),
            None => Band::point(&base),
        };
        if self.band.is_some() && band.over == BandOver::Frequency {
            band.range = band.range.map(|end| end + shift);
            band.spectrum.iter_mut().for_each(|corner| corner[0] += shift);
        }
        Some((band, choice.clearance))
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

    /// The objective of an absorber that deviates, the more the better: an exact one, or minus the worst
    /// amplitude with its error, in the units of a [`AbsorberDesign`], by a full survey. `None` where there is no
    /// system, or nothing could be measured.
    pub fn score(
        &self,
        choice: &AbsorberDesign,
        off: &Deviation,
        executor: &dyn Executor,
    ) -> Option<f64> {
        let (band, clearance) = self.band_of(choice, off)?;
        if self.objective != Objective::WorstAmplitude {
            return self.exact_score(&band);
        }
        let settings =
            SurveySettings { sampling: Some(self.sampling), count_inactive: self.count_inactive };
        let worst = Motions::of(&band, &settings, executor).ok()?.worst()?;
        Some(-clearance * (worst.peak + worst.error))
    }

    /// The value of the objective as it is spoken of: an amplitude is not negative.
    pub fn value(&self, score: f64) -> f64 {
        if self.objective == Objective::WorstAmplitude { -score } else { score }
    }
}

/// A variable of an absorber; 0 for a mass that there is not.
pub fn value_of(variable: Variable, choice: &AbsorberDesign) -> f64 {
    match variable {
        Variable::Clearance => choice.clearance,
        Variable::Restitution => choice.restitution,
        Variable::Mass => choice.mass.unwrap_or(0.0),
    }
}
