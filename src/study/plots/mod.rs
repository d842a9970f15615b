//! What the figures of a case show beyond the study itself: curves, simulated points, traces.
//!
//! Plain data: lengths over the case's clearance, frequencies as ratios, times in excitation periods.

pub mod amplitude;
pub mod areas;
pub mod band;
pub mod borders;
pub mod dissipation;
pub mod ranges;
pub mod responses;
pub mod restitutions;
pub mod statistics;
pub mod traces;

use crate::analysis::ManifoldBranch;
use crate::case::{Case, ExtraFigure};
use crate::executor::Executor;
use crate::motions::{Measured, Motion};
use crate::orbits::boundaries::over_frequency;
use crate::orbits::{ExactBoundaries, SteadyOrbit, steady_orbits};
use crate::simulation::Stop;
use crate::system::{Parameter, System};
use crate::validation::AsymptoticError;
use crate::validation::asymptotic_error::errors_over_frequency;
use crate::validation::tolerance::has_resonance;

use super::diagrams::Diagram;
use super::scenes::{WalkPoint, walk};
use super::{CaseStudy, StudyError};

pub use amplitude::AmplitudeCurves;
pub use areas::{Areas, Levels};
pub use band::BandCurves;
pub use borders::{Bifurcations, Borders};
pub use dissipation::Dissipation;
pub use ranges::Ranges;
pub use responses::Responses;
pub use restitutions::Restitutions;
pub use statistics::{MotionExponents, StartPlane};
pub use traces::{Modulation, MotionTrace, Transfer};

/// So many motions are drawn.
const MOTIONS: usize = 3;

/// A line; a point that is not finite interrupts it.
pub type Line = Vec<[f64; 2]>;

/// What there is without forcing has no boundaries, and nothing to sweep.
const NEED_FORCING: [ExtraFigure; 8] = [
    ExtraFigure::Areas,
    ExtraFigure::Bifurcations,
    ExtraFigure::Dissipation,
    ExtraFigure::ForcingResponses,
    ExtraFigure::Clearances,
    ExtraFigure::DiagramClearance,
    ExtraFigure::DiagramFrequency,
    ExtraFigure::DiagramForcing,
];

/// The data of one figure, or of two that show the same in different ways.
#[derive(Debug, Clone)]
pub enum Plot {
    /// The response over the case's band.
    Band(BandCurves),
    /// Where steady 1:1 resonance begins and ends.
    Ranges(Vec<Ranges>),
    /// The case among its boundaries, in frequency and clearance.
    Map(BoundaryMap),
    /// The same in detuning and forcing per clearance.
    Plane(Borders),
    /// The slow invariant manifold with what was found on it.
    Manifold,
    /// Frequency responses of several clearances beside the manifold.
    Responses(Responses),
    /// Peaks over frequency.
    Amplitude(AmplitudeCurves),
    /// A motion over time, and the times between its impacts.
    Motion(MotionTrace),
    /// The areas along the manifold.
    Areas(Areas),
    /// The conditions of saddle-node and Hopf boundary.
    Bifurcations(Bifurcations),
    /// A modulated motion on the manifold.
    Modulation(Modulation),
    /// The manifold at several restitutions.
    Restitutions(Restitutions),
    /// What the absorber takes in every regime, and the response.
    Dissipation(Dissipation),
    /// Which starts lead to which motion.
    Basins(StartPlane),
    /// Captures of the first motion in 1:1 resonance.
    Captures,
    /// How Lyapunov exponents converge.
    Exponents(Vec<MotionExponents>),
    /// Simulated motions at many clearances.
    Clearances(Vec<WalkPoint>),
    /// A motion over some seconds.
    Transfer(Transfer),
    /// Short stretches of it.
    TransferStretches(Transfer),
    /// A bifurcation diagram, and the oscillator without absorber, `[parameter, amplitude]`.
    Diagram(Diagram, Line),
}

impl Plot {
    /// All that a report shows, in reading order: the band first, or how far a case at one frequency may
    /// change, then the case among its boundaries; what the case asks for last.
    ///
    /// # Errors
    /// [`StudyError`] where theory or simulation cannot be carried out.
    pub fn all(case: &Case, study: &CaseStudy, on: &dyn Executor) -> Result<Vec<Self>, StudyError> {
        let mut plots = Self::usual(study, on)?;
        let forced = study.analysis.system.forcing_per_clearance() != 0.0;
        let shown = |wanted: &&ExtraFigure| forced || !NEED_FORCING.contains(*wanted);
        let wanted: &[ExtraFigure] = if study.simulated { &case.report.figures } else { &[] };
        for wanted in wanted.iter().filter(shown) {
            plots.extend(Self::extra(case, study, *wanted)?);
        }
        Ok(plots)
    }

    /// What every report shows.
    ///
    /// # Errors
    /// As [`Plot::all`].
    pub fn usual(study: &CaseStudy, on: &dyn Executor) -> Result<Vec<Self>, StudyError> {
        // Without forcing every boundary is at no clearance at all, and everything comes to rest.
        let forced = study.analysis.system.forcing_per_clearance() != 0.0;
        let mut plots = Vec::new();
        plots.extend(BandCurves::of(study).map(Self::Band));
        if forced && study.band.is_none() {
            plots.push(Self::Ranges(Ranges::of(study)));
        }
        if forced {
            plots.push(Self::Map(BoundaryMap::of(study, on)));
        }
        plots.extend([Self::Plane(Borders::around(study)), Self::Manifold]);
        plots.extend(Responses::around(study).filter(|_| forced).map(Self::Responses));
        if !study.simulated {
            return Ok(plots);
        }
        if forced {
            plots.push(Self::Amplitude(AmplitudeCurves::of(study)?));
        }
        for index in 0..study.motions.len().min(MOTIONS) {
            plots.extend(MotionTrace::of(study, index)?.map(Self::Motion));
        }
        Ok(plots)
    }

    /// What only some cases ask for; none where there is nothing to show.
    fn extra(
        case: &Case,
        study: &CaseStudy,
        wanted: ExtraFigure,
    ) -> Result<Option<Self>, StudyError> {
        Ok(match wanted {
            ExtraFigure::Areas => Areas::of(study)?.map(Self::Areas),
            ExtraFigure::Bifurcations => Bifurcations::of(study).map(Self::Bifurcations),
            ExtraFigure::ForcingResponses => Responses::across(study).map(Self::Responses),
            ExtraFigure::Modulation => Modulation::of(study)?.map(Self::Modulation),
            ExtraFigure::Restitutions => Restitutions::of(study).map(Self::Restitutions),
            ExtraFigure::Dissipation => Dissipation::of(study).map(Self::Dissipation),
            ExtraFigure::Basins => Some(Self::Basins(StartPlane::of(study)?)),
            ExtraFigure::Captures => Some(Self::Captures),
            ExtraFigure::Exponents => Some(Self::Exponents(MotionExponents::of(study)?)),
            ExtraFigure::Clearances => clearances(study)?.map(Self::Clearances),
            ExtraFigure::Transfer => Transfer::of(case, study)?.map(Self::Transfer),
            ExtraFigure::TransferStretches => {
                Transfer::of(case, study)?.map(Self::TransferStretches)
            }
            ExtraFigure::DiagramClearance => diagram(study, Parameter::Clearance)?,
            ExtraFigure::DiagramFrequency => diagram(study, Parameter::Frequency)?,
            ExtraFigure::DiagramForcing => diagram(study, Parameter::Amplitude)?,
        })
    }
}

/// The motion with an index if it can be drawn: it moves, was reached and followed to the end.
pub fn drawn(study: &CaseStudy, index: usize) -> Option<(&Motion, &Measured)> {
    let (motion, measured) = study.each().nth(index)?;
    let followed = measured.stop == Stop::EndTime;
    (motion.rest().is_none() && followed).then_some((motion, measured))
}

/// The first motion that can be drawn: the one that most starts lead to.
pub fn first_drawn(study: &CaseStudy) -> Option<(&Motion, &Measured)> {
    (0..study.motions.len()).find_map(|index| drawn(study, index))
}

/// `count` + 1 numbers from `first` to `last`.
fn even(first: f64, last: f64, count: u32) -> impl Iterator<Item = f64> {
    (0..=count).map(move |k| first + (last - first) * f64::from(k) / f64::from(count))
}

/// Half the window in frequency is at least so many mass ratios ...
const MASS_RATIOS: f64 = 15.0;
/// ... but no more than this share of the natural frequency unless the case asks for it.
const HALF: f64 = 0.5;
/// The case is at least so far from the window's side, compared with its distance from resonance.
const BEYOND_CASE: f64 = 1.4;

/// The frequency ratios that the figures over frequency show.
pub fn window(system: &System) -> [f64; 2] {
    let away = (system.frequency_ratio() - 1.0).abs();
    let half = (MASS_RATIOS * system.mass_ratio()).clamp(1e-9, HALF).max(BEYOND_CASE * away);
    [(1.0 - half).max(0.05_f64.min(0.5 * system.frequency_ratio())), 1.0 + half]
}

/// The case among its boundaries over frequency.
#[derive(Debug, Clone)]
pub struct BoundaryMap {
    /// First and last frequency ratio.
    pub window: [f64; 2],
    /// The theory's boundaries.
    pub borders: Borders,
    /// The exact ones at some frequencies; none away from resonance.
    pub exact: Vec<ExactBoundaries>,
    /// The first against the second, with the frequency ratio.
    pub errors: Vec<(f64, Vec<AsymptoticError>)>,
}

impl BoundaryMap {
    /// Frequencies, less one, at which the exact boundaries are marked.
    const EXACT: u32 = 40;

    /// Over the frequencies of [`window`].
    pub fn of(study: &CaseStudy, on: &dyn Executor) -> Self {
        let (system, manifold) = (&study.analysis.system, &study.analysis.manifold);
        let window = window(system);
        let detunings = window.map(|ratio| (ratio - 1.0) / system.mass_ratio());
        let borders = Borders::over(system, manifold, (detunings[0], detunings[1]));
        let ratios: Vec<f64> = even(window[0], window[1], Self::EXACT).collect();
        let inner = &ratios[1..Self::EXACT as usize];
        let inner = if has_resonance(system) { inner } else { &[] };
        let exact = over_frequency(system, inner, on);
        let errors = errors_over_frequency(system, manifold, &exact);
        Self { window, borders, exact, errors }
    }
}

/// Clearances evenly spread in their logarithm, from a tenth of that of symmetry breaking to beyond the last
/// boundary, and the case's own.
fn clearances(study: &CaseStudy) -> Result<Option<Vec<WalkPoint>>, StudyError> {
    let (system, boundaries) = (&study.analysis.system, &study.analysis.boundaries);
    let gamma = system.forcing_per_clearance();
    if !has_resonance(system) {
        return Ok(None);
    }
    let hopf = gamma / boundaries.hopf;
    let last = study.margins.clearance.iter().map(|at| at.clearance).fold(hopf, f64::max);
    let ends = [0.1 * gamma / boundaries.symmetry_breaking, 1.35 * last].map(libm::log);
    let mut values: Vec<f64> = even(ends[0], ends[1], 35).map(libm::exp).chain([1.0]).collect();
    values.sort_by(f64::total_cmp);
    walk(system, &values).map(Some)
}

fn diagram(study: &CaseStudy, parameter: Parameter) -> Result<Option<Plot>, StudyError> {
    let system = &study.analysis.system;
    if !has_resonance(system) {
        return Ok(None);
    }
    let Some(diagram) = Diagram::around(&study.exact, parameter)? else { return Ok(None) };
    let bare = |value: f64| {
        let there = parameter.applied(system, value).ok()?;
        Some([value, parameter.unit(value) * there.linear_response()?.amplitude()])
    };
    let [low, high] = diagram.range;
    let bare = even(low, high, 200).filter_map(bare).collect();
    Ok(Some(Plot::Diagram(diagram, bare)))
}

/// The exact 1:1 orbits of a system, if there is one.
fn steady_orbits_at(system: Option<System>) -> Vec<SteadyOrbit> {
    system.and_then(|system| steady_orbits(&system).ok()).unwrap_or_default()
}

/// Whether a fixed point where the curve of fixed points rises or falls is stable: it must lie on the stable
/// branch, and not where the curve has turned back.
fn on_stable_branch(branches: [ManifoldBranch; 2], rises: bool) -> bool {
    rises && branches == [ManifoldBranch::Stable; 2]
}

/// A curve as two lines with gaps: the stable pieces between neighbouring points, and the others.
fn branches<T>(
    points: &[T],
    stable: &dyn Fn([&T; 2]) -> bool,
    place: &dyn Fn(&T) -> [f64; 2],
) -> [Line; 2] {
    let mut lines = [Vec::new(), Vec::new()];
    let pairs: Vec<[&T; 2]> = points.windows(2).map(|pair| [&pair[0], &pair[1]]).collect();
    for run in pairs.chunk_by(|a, b| stable(*a) == stable(*b)) {
        let line = &mut lines[usize::from(!stable(run[0]))];
        line.extend(run.iter().map(|pair| place(pair[0])));
        line.extend([place(run[run.len() - 1][1]), [f64::NAN; 2]]);
    }
    lines
}
