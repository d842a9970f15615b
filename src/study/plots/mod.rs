//! What the figures of a case show beyond the study itself: curves, simulated points, traces.
//!
//! Plain data: lengths over the case's clearance, frequencies as ratios, times in excitation periods.

pub mod amplitude;
pub mod areas;
pub mod borders;
pub mod ranges;
pub mod responses;
pub mod restitutions;
pub mod traces;

use crate::analysis::Branch;
use crate::band::Band;
use crate::band::rivals::bare_amplitude;
use crate::case::{Case, ExtraFigure};
use crate::orbits::boundaries::over_frequency;
use crate::orbits::{Boundaries, SymmetricOrbit, symmetric_orbits};
use crate::regimes::basins::Basins;
use crate::regimes::starts::StartBox;
use crate::regimes::{Effort, Exponent, FoundAttractor, Regime, Transient};
use crate::simulation::Stop;
use crate::system::{Parameter, State, System};
use crate::validation::AsymptoticError;
use crate::validation::asymptotic_error::errors_over_frequency;
use crate::validation::tolerance::has_resonance;

use super::diagrams::Diagram;
use super::scenes::{WalkPoint, exponents, walk};
use super::{CaseStudy, StudyError};

pub use amplitude::Amplitude;
pub use areas::{Areas, Levels};
pub use borders::{Bifurcations, Borders};
pub use ranges::Ranges;
pub use responses::Responses;
pub use restitutions::Restitutions;
pub use traces::{Modulation, Motion, Transfer};

/// So many motions are drawn.
const MOTIONS: usize = 3;

/// A line; a point that is not finite interrupts it.
pub type Line = Vec<[f64; 2]>;

/// What there is without forcing has no boundaries, and nothing to sweep.
const NEED_FORCING: [ExtraFigure; 7] = [
    ExtraFigure::Areas,
    ExtraFigure::Bifurcations,
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
    Map(Map),
    /// The same in detuning and forcing per clearance.
    Plane(Borders),
    /// The slow invariant manifold with what was found on it.
    Manifold,
    /// Frequency responses of several clearances beside the manifold.
    Responses(Responses),
    /// Peaks over frequency.
    Amplitude(Amplitude),
    /// A motion over time, and the times between its impacts.
    Motion(Motion),
    /// The areas along the manifold.
    Areas(Areas),
    /// The conditions of saddle-node and Hopf boundary.
    Bifurcations(Bifurcations),
    /// A modulated motion on the manifold.
    Modulation(Modulation),
    /// The manifold at several restitutions.
    Restitutions(Restitutions),
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
    pub fn all(case: &Case, study: &CaseStudy) -> Result<Vec<Self>, StudyError> {
        // Without forcing every boundary is at no clearance at all, and everything comes to rest.
        let forced = study.analysis.system.forcing_per_clearance() != 0.0;
        let mut plots = Vec::new();
        plots.extend(BandCurves::of(study).map(Self::Band));
        if forced && study.band.is_none() {
            plots.push(Self::Ranges(Ranges::of(study)));
        }
        if forced {
            plots.push(Self::Map(Map::of(study)?));
        }
        plots.extend([Self::Plane(Borders::around(study)), Self::Manifold]);
        plots.extend(Responses::around(study).filter(|_| forced).map(Self::Responses));
        if !study.simulated {
            return Ok(plots);
        }
        if forced {
            plots.push(Self::Amplitude(Amplitude::of(study)?));
        }
        for index in 0..study.attractors.len().min(MOTIONS) {
            plots.extend(Motion::of(study, index)?.map(Self::Motion));
        }
        let shown = |wanted: &&ExtraFigure| forced || !NEED_FORCING.contains(*wanted);
        for wanted in case.report.figures.iter().filter(shown) {
            plots.extend(Self::extra(case, study, *wanted)?);
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
            ExtraFigure::Basins => Some(Self::Basins(StartPlane::of(study)?)),
            ExtraFigure::Captures => Some(Self::Captures),
            ExtraFigure::Exponents => Some(Self::Exponents(MotionExponents::of(study)?)),
            ExtraFigure::Clearances => clearances(study)?.map(Self::Clearances),
            ExtraFigure::Transfer => Transfer::of(case, study)?.map(Self::Transfer),
            ExtraFigure::TransferStretches => {
                Transfer::of(case, study)?.map(Self::TransferStretches)
            }
            ExtraFigure::DiagramClearance => diagram(study, Parameter::Clearance)?,
            ExtraFigure::DiagramFrequency => diagram(study, Parameter::FrequencyRatio)?,
            ExtraFigure::DiagramForcing => diagram(study, Parameter::Forcing)?,
        })
    }
}

/// The motion with an index if it can be drawn: it moves and was followed to the end. One that was measured
/// while it turned into another (its average is not that of the repetition it ends with) cannot.
pub fn drawn(study: &CaseStudy, index: usize) -> Option<&FoundAttractor> {
    let found = study.attractors.get(index)?;
    let evidence = &found.attractor.classification.evidence;
    let lasts = evidence.periodicity.is_none_or(|repetition| {
        let repeated = f64::from(repetition.impacts) / f64::from(repetition.periods);
        (evidence.impacts_per_period - repeated).abs() < 0.05 * repeated.max(1.0)
    });
    let followed = found.attractor.stop == Stop::EndTime;
    (found.regime() != Regime::AtRest && followed && lasts).then_some(found)
}

/// The first motion that can be drawn: the one that most starts lead to.
pub fn first_drawn(study: &CaseStudy) -> Option<&FoundAttractor> {
    (0..study.attractors.len()).find_map(|index| drawn(study, index))
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
pub struct Map {
    /// First and last frequency ratio.
    pub window: [f64; 2],
    /// The theory's boundaries.
    pub borders: Borders,
    /// The exact ones at some frequencies; none away from resonance.
    pub exact: Vec<Boundaries>,
    /// The first against the second, with the frequency ratio.
    pub errors: Vec<(f64, Vec<AsymptoticError>)>,
}

impl Map {
    /// Frequencies, less one, at which the exact boundaries are marked.
    const EXACT: u32 = 40;

    fn of(study: &CaseStudy) -> Result<Self, StudyError> {
        let (system, manifold) = (&study.analysis.system, &study.analysis.manifold);
        let window = window(system);
        let detunings = window.map(|ratio| (ratio - 1.0) / system.mass_ratio());
        let borders = Borders::over(system, manifold, (detunings[0], detunings[1]));
        let ratios: Vec<f64> = even(window[0], window[1], Self::EXACT).collect();
        let inner = &ratios[1..Self::EXACT as usize];
        let exact = if has_resonance(system) { over_frequency(system, inner) } else { Vec::new() };
        let errors = errors_over_frequency(system, manifold, &exact)?;
        Ok(Self { window, borders, exact, errors })
    }
}

/// Peaks over the clearance along a band, `[place, peak]`.
#[derive(Debug, Clone)]
pub struct BandCurves {
    /// Without absorber.
    pub bare: Line,
    /// With the best tuned mass damper of the same mass.
    pub damper: Line,
    /// Of the admissible symmetric orbits: those that attract, and those that do not.
    pub orbits: [Line; 2],
}

impl BandCurves {
    /// Places along the band.
    const PLACES: u32 = 301;

    fn of(study: &CaseStudy) -> Option<Self> {
        let survey = study.band.as_ref()?;
        let (band, damper) = (survey.band(), survey.rivals.damper);
        let curve = |amplitude: &dyn Fn(&System) -> f64| -> Line {
            let value = |at: f64| band.system(at).map_or(f64::NAN, |system| amplitude(&system));
            band.places(Self::PLACES).map(|at| [at, value(at)]).collect()
        };
        Some(Self {
            bare: curve(&bare_amplitude),
            damper: curve(&|system| damper.amplitudes(system)[0]),
            orbits: Self::orbits(band),
        })
    }

    fn orbits(band: &Band) -> [Line; 2] {
        let mut lines = [Vec::new(), Vec::new()];
        // Both orbits of a place in turn, from the larger absorber amplitude down, so that a line follows
        // one of them where the other begins or ends.
        for which in 0..2 {
            for at in band.places(Self::PLACES) {
                let found = symmetric_orbits_at(band.system(at).ok());
                let orbit = found.iter().rev().nth(which);
                let orbit = orbit.filter(|one| one.orbit.admissibility.admissible);
                for (line, stable) in lines.iter_mut().zip([true, false]) {
                    let shown = orbit.filter(|one| one.orbit.attracts() == stable);
                    line.push(shown.map_or([f64::NAN; 2], |one| [at, one.peaks.displacement]));
                }
            }
            lines.iter_mut().for_each(|line| line.push([f64::NAN; 2]));
        }
        lines
    }
}

/// Lyapunov exponents of a motion after longer and longer windows.
#[derive(Debug, Clone)]
pub struct MotionExponents {
    /// Which motion.
    pub index: usize,
    /// The exponents; never empty.
    pub exponents: Vec<Exponent>,
    /// Logarithm of the largest multiplier per period, where the motion is an exact orbit.
    pub exact: Option<f64>,
}

impl MotionExponents {
    /// Powers of two: from the shortest window that has an error to one in which the error of a chaotic
    /// motion has shrunk to some per cent.
    const WINDOWS: std::ops::RangeInclusive<u32> = 4..=13;

    fn of(study: &CaseStudy) -> Result<Vec<Self>, StudyError> {
        let periods: Vec<u64> = Self::WINDOWS.map(|power| 1 << power).collect();
        let mut all = Vec::new();
        for index in 0..study.attractors.len().min(MOTIONS) {
            let Some(found) = drawn(study, index) else { continue };
            let exponents = exponents(&study.analysis.system, found.attractor.state, &periods)?;
            let proof = study.proofs[index].as_ref();
            let exact = proof.map(|proof| libm::log(proof.orbit.radius_per_period()));
            if !exponents.is_empty() {
                all.push(Self { index, exponents, exact });
            }
        }
        Ok(all)
    }
}

/// Enough to recognise the motion; in a shorter window a strongly modulated one may show no capture.
/// Ten impacts per period are recognised as that without going on.
const BASIN_EFFORT: Effort = Effort { discard: None, periods: 200, most_impacts: 10 };

/// Starts of the oscillator at excitation phase 0, the absorber at rest in the middle of its cavity.
#[derive(Debug, Clone)]
pub struct StartPlane {
    /// Displacement and velocity of each.
    pub starts: Vec<[f64; 2]>,
    /// Largest displacement and velocity.
    pub reach: f64,
    /// Where they lead.
    pub basins: Basins,
    /// Excitation periods left out at least.
    pub transient: u64,
}

impl StartPlane {
    /// Starts along either axis: squares that are still seen one by one.
    const CELLS: u32 = 40;

    fn of(study: &CaseStudy) -> Result<Self, StudyError> {
        let system = &study.analysis.system;
        let reach = StartBox::around(system).reach;
        let cells = f64::from(Self::CELLS);
        let middle = |cell: u32| reach * (2.0 * (f64::from(cell) + 0.5) / cells - 1.0);
        let place = |k: u32| [middle(k % Self::CELLS), middle(k / Self::CELLS)];
        let starts: Vec<[f64; 2]> = (0..Self::CELLS * Self::CELLS).map(place).collect();
        let state = |[x, x_velocity]: &[f64; 2]| State {
            x: *x,
            x_velocity: *x_velocity,
            y: *x,
            y_velocity: 0.0,
        };
        let states: Vec<State> = starts.iter().map(state).collect();
        let known = study.attractors.iter().map(|found| found.attractor.motion).collect();
        let basins = Basins::of(system, &states, known, &BASIN_EFFORT, &mut |_| {})?;
        Ok(Self { starts, reach, basins, transient: Transient::of(system).periods })
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
    let last = study.margins.clearance.iter().map(|at| at.factor).fold(hopf, f64::max);
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

/// The exact symmetric orbits of a system, if there is one.
fn symmetric_orbits_at(system: Option<System>) -> Vec<SymmetricOrbit> {
    system.and_then(|system| symmetric_orbits(&system).ok()).unwrap_or_default()
}

/// Whether a fixed point where the curve of fixed points rises or falls is stable: it must lie on the stable
/// branch, and not where the curve has turned back.
fn on_stable_branch(branches: [Branch; 2], rises: bool) -> bool {
    rises && branches == [Branch::Stable; 2]
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
