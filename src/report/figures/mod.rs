//! The figures of a report, made from what is known about a case.
//!
//! Each file makes one kind of figure as plain data for [`super::figure`]. A figure that has
//! nothing to say for a case is left out.

mod amplitude;
mod areas;
mod asymptotic_error;
mod band;
mod basins;
mod bifurcations;
pub(super) mod borders;
mod branches;
mod canvas;
mod captures;
mod clearances;
mod diagram;
mod diagram_lines;
mod diagram_words;
mod exponents;
pub(crate) mod forcing_responses;
mod levels;
mod manifold;
mod map;
pub(crate) mod modulation;
mod motion;
mod plane;
mod response;
pub(crate) mod restitutions;
mod return_map;
mod transfer;
pub(crate) mod transfer_stretches;

use crate::case::{Case, ExtraFigure, Subject};
use crate::regimes::{FoundAttractor, Regime};
use crate::simulation::Stop;
use crate::study::{CaseStudy, StudyError};
use crate::system::Parameter;

use super::figure::Figure;
use super::units::Units;

/// So many attractors are drawn.
const ATTRACTORS: usize = 3;

/// What every figure is made from.
pub(crate) struct Scene<'a> {
    study: &'a CaseStudy,
    units: Units,
    /// The largest displacement that the case allows, over the clearance.
    limit: Option<f64>,
}

impl<'a> Scene<'a> {
    pub(crate) fn new(case: &Case, study: &'a CaseStudy) -> Self {
        let mut limits = case.criteria.iter();
        let asked = limits.find(|one| one.subject == Subject::PeakDisplacement);
        let limit = asked.map(|one| one.limit / case.scales().length(1.0));
        Self { study, units: Units::of(case), limit }
    }

    /// An attractor that moves and was followed to the end. One that was measured while it turned
    /// into another (its average is not that of the repetition it ends with) is none.
    fn drawn(&self, index: usize) -> Option<&'a FoundAttractor> {
        let found = self.study.attractors.get(index)?;
        let evidence = &found.attractor.classification.evidence;
        let lasts = evidence.periodicity.is_none_or(|repetition| {
            let repeated = f64::from(repetition.impacts) / f64::from(repetition.periods);
            let least = 0.05 * repeated.max(1.0);
            (evidence.impacts_per_period - repeated).abs() < least
        });
        let followed = found.attractor.stop == Stop::EndTime;
        (found.regime() != Regime::AtRest && followed && lasts).then_some(found)
    }

    /// The first attractor that can be drawn: the one that most starts lead to.
    fn first_drawn(&self) -> Option<&'a FoundAttractor> {
        (0..self.study.attractors.len()).find_map(|index| self.drawn(index))
    }
}

/// All figures in reading order: the response over the case's band first, if it has one, then the case
/// among its boundaries; those that the case asks for last.
///
/// # Errors
/// [`StudyError`] where theory or simulation cannot be carried out.
pub fn all(case: &Case, study: &CaseStudy) -> Result<Vec<Figure>, StudyError> {
    let scene = Scene::new(case, study);
    let mut figures = Vec::new();
    figures.extend(band::figure(&scene));
    figures.extend(map::figure(&scene)?);
    figures.push(plane::figure(&scene)?);
    figures.push(manifold::figure(&scene));
    figures.extend(response::figure(&scene)?);
    if !study.simulated {
        // All others simulate.
        return Ok(figures);
    }
    figures.extend(amplitude::figure(&scene)?);
    for index in 0..study.attractors.len().min(ATTRACTORS) {
        figures.extend(motion::figure(&scene, index)?);
        figures.extend(return_map::figure(&scene, index));
    }
    for wanted in &case.report.figures {
        figures.extend(further(&scene, *wanted)?);
    }
    Ok(figures)
}

/// A figure that is made only where a case asks for it.
fn further(scene: &Scene, wanted: ExtraFigure) -> Result<Option<Figure>, StudyError> {
    match wanted {
        ExtraFigure::Areas => areas::figure(scene),
        ExtraFigure::Bifurcations => bifurcations::figure(scene),
        ExtraFigure::ForcingResponses => forcing_responses::figure(scene),
        ExtraFigure::Modulation => modulation::figure(scene),
        ExtraFigure::Restitutions => restitutions::figure(scene),
        ExtraFigure::Basins => basins::figure(scene),
        ExtraFigure::Captures => Ok(captures::figure(scene)),
        ExtraFigure::Exponents => exponents::figure(scene),
        ExtraFigure::Clearances => clearances::figure(scene),
        ExtraFigure::Transfer => transfer::figure(scene),
        ExtraFigure::TransferStretches => transfer_stretches::figure(scene),
        ExtraFigure::DiagramClearance => {
            diagram::figure(scene, wanted.name(), Parameter::Clearance)
        }
        ExtraFigure::DiagramFrequency => {
            diagram::figure(scene, wanted.name(), Parameter::FrequencyRatio)
        }
        ExtraFigure::DiagramForcing => diagram::figure(scene, wanted.name(), Parameter::Forcing),
    }
}
