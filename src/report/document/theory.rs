//! What theory and exact orbits say: fixed points, orbits, boundaries, and how far they are from the case.

use serde::Serialize;

use super::scale::Scale;
use crate::analysis::{Analysis, Area, Branch, FixedPoint, Kind as PointKind, Strip};
use crate::method::Method::{self, ExactOrbit, Simulation, Theory};
use crate::orbits::{Bifurcation, FullSystem, Leading, StableStretch, SymmetricOrbit};
use crate::quantity::catalogue as of;
use crate::quantity::{Dimension, Quantity};
use crate::regimes::Regime;
use crate::regimes::share::wilson;
use crate::study::confirmations::{Probe, SimulatedLimit};
use crate::study::margins::{ExactMargin, ExactMargins};
use crate::study::{CaseStudy, SettledArea};
use crate::validation::AsymptoticError;
use crate::validation::asymptotic_error::asymptotic_errors;

/// A fixed point of the slow flow.
#[derive(Debug, Clone, Serialize)]
pub struct PointFacts {
    oscillator_amplitude: Quantity,
    absorber_amplitude: Quantity,
    over_clearance: Quantity,
    eta: Quantity,
    theta: Quantity,
    branch: Branch,
    kind: PointKind,
    trace: Quantity,
    determinant: Quantity,
    /// Whether it stands for a stable motion.
    stable: bool,
    /// Whether the absorber stays between the walls.
    admissible: bool,
    /// Largest relative displacement between impacts, over the clearance.
    reach: f64,
    above_collision: Option<Quantity>,
}

/// An exact symmetric orbit.
#[derive(Debug, Clone, Serialize)]
pub struct OrbitFacts {
    impact_displacement: Quantity,
    peak: Quantity,
    impact_speed: Quantity,
    phase: Quantity,
    /// Largest multiplier of half a period.
    multiplier: Quantity,
    leading: Leading,
    admissible: bool,
    /// Whether the absorber would stay on the wall after an impact.
    sticks: bool,
    stable: bool,
    residual: f64,
}

/// A boundary in clearance, by theory and exactly.
#[derive(Debug, Clone, Serialize)]
pub struct BoundaryFacts {
    kind: Bifurcation,
    /// For one of the theory: the branch on which two fixed points meet.
    branch: Option<Branch>,
    /// Of the motion with two asymmetric impacts.
    of_asymmetric: bool,
    theory: Option<Quantity>,
    exact: Option<Quantity>,
    theory_error: Option<Quantity>,
    /// Change of the clearance until it.
    change: Quantity,
    bounds_stability: bool,
    #[serde(skip)]
    place: f64,
}

/// Limits of the motion that the case has, in each parameter.
#[derive(Debug, Clone, Serialize)]
pub struct LimitFacts {
    /// Below and above.
    clearance: [Option<EndFacts>; 2],
    forcing: [Option<EndFacts>; 2],
    frequency: [Option<EndFacts>; 2],
}

/// An end of a range.
#[derive(Debug, Clone, Serialize)]
pub struct EndFacts {
    kind: Option<Bifurcation>,
    at: Quantity,
    change: Quantity,
    /// Where theory has the same end, and by how much it is off.
    theory: Option<Quantity>,
    theory_error: Option<Quantity>,
}

/// What several starts do at another clearance.
#[derive(Debug, Clone, Serialize)]
pub struct ProbeFacts {
    clearance: Quantity,
    change: Quantity,
    starts: u32,
    /// How many end in steady 1:1 resonance.
    steady: u32,
    /// Their share, with the reach of its 95 % interval.
    steady_share: Quantity,
    other: Option<Regime>,
    other_peak: Quantity,
}

/// Where theory and orbits place the case.
#[derive(Debug, Clone, Serialize)]
pub struct TheoryFacts {
    area: Area,
    area_by: Method,
    strip: Option<Strip>,
    fixed_points: Vec<PointFacts>,
    orbits: Vec<OrbitFacts>,
    /// Number of the orbit that attracts, from 0.
    attracting: Option<usize>,
    boundaries: Vec<BoundaryFacts>,
    /// Of the attracting orbit.
    limits: Option<LimitFacts>,
    /// All clearances with an attracting symmetric orbit.
    stretches: Vec<[EndFacts; 2]>,
    /// Whether the case's clearance lies in one of them.
    stable_here: bool,
    /// Largest clearance at which every simulated start keeps 1:1 resonance, and the first at which some do not.
    kept: Option<EndFacts>,
    lost: Option<ProbeFacts>,
    best: Option<BestFacts>,
    /// Error of the amplitude of the stable fixed point.
    amplitude_error: Option<Quantity>,
}

/// The clearance at which the attracting orbit vibrates least.
#[derive(Debug, Clone, Serialize)]
struct BestFacts {
    clearance: Quantity,
    peak: Quantity,
    change: Option<Quantity>,
    /// Whether that is worth calling a reduction.
    reduces: bool,
    /// Distance to the end of the stable motion, where it is too small for a design.
    too_near: Option<Quantity>,
    found: Option<ProbeFacts>,
}

/// Share of a clearance within which the end of steady resonance is too near for a design.
const TOO_NEAR: f64 = 0.1;

/// Relative error of the place of a minimum, where the slope vanishes, and of multipliers where two of them
/// meet: the root of that of rounding.
pub(super) const ROOT_OF_ROUNDING: f64 = 1e-6;
/// A limit that some starts find and some do not is no sharper than two of its brackets.
const BRACKETS: f64 = 2.0;

impl TheoryFacts {
    /// Without margins.
    pub fn of(scale: &Scale, analysis: &Analysis, exact: &FullSystem, area: SettledArea) -> Self {
        let errors = asymptotic_errors(analysis, exact);
        let facts = Facts { scale, analysis, exact, errors: &errors };
        Self {
            area: area.area,
            area_by: area.by,
            strip: analysis.zone.strip,
            fixed_points: analysis.fixed_points.iter().map(|point| facts.point(point)).collect(),
            orbits: exact.orbits.iter().map(|orbit| facts.orbit(orbit)).collect(),
            attracting: exact.orbits.iter().position(|orbit| orbit.orbit.attracts()),
            boundaries: facts.boundaries(),
            stretches: exact.stable_stretches().iter().map(|one| facts.stretch(one)).collect(),
            stable_here: exact.stretch().is_some(),
            limits: None,
            kept: None,
            lost: None,
            best: None,
            amplitude_error: None,
        }
    }

    /// Those of a study, with margins.
    pub fn with_margins(scale: &Scale, study: &CaseStudy) -> Self {
        let (analysis, exact) = (&study.analysis, &study.exact);
        let facts = Facts { scale, analysis, exact, errors: &study.asymptotic_errors };
        let points = &analysis.fixed_points;
        let error = points.iter().rposition(|point| point.stable).and_then(|index| {
            let id = format!("fixed-point-{}-C", index + 1);
            study.claims.iter().find(|claim| claim.id == id)?.difference
        });
        let limit = study.confirmations.upper_limit.as_ref();
        Self {
            limits: study.margins.exact.map(|margins| facts.limits(&margins)),
            kept: limit.map(|limit| {
                let end = facts.end(None, limit.kept);
                let [at, change] = [end.at, end.change].map(|one| bracketed(one, limit));
                EndFacts { at, change, ..end }
            }),
            lost: limit.map(|limit| {
                let lost = facts.probe(&limit.lost);
                let [clearance, change] =
                    [lost.clearance, lost.change].map(|one| bracketed(one, limit));
                ProbeFacts { clearance, change, ..lost }
            }),
            best: facts.best(study),
            amplitude_error: error.map(|error| Quantity::new(&of::THEORY_ERROR, error, Theory)),
            ..Self::of(scale, analysis, exact, study.area)
        }
    }
}

struct Facts<'a> {
    scale: &'a Scale,
    analysis: &'a Analysis,
    exact: &'a FullSystem,
    errors: &'a [AsymptoticError],
}

impl Facts<'_> {
    fn point(&self, point: &FixedPoint) -> PointFacts {
        let number = |kind, value| Quantity::new(kind, value, Theory);
        let length = |kind, value| self.scale.length(kind, value, Theory);
        PointFacts {
            oscillator_amplitude: length(&of::OSCILLATOR_AMPLITUDE, point.oscillator_amplitude),
            absorber_amplitude: length(&of::ABSORBER_AMPLITUDE, point.absorber_amplitude),
            over_clearance: number(&of::ABSORBER_AMPLITUDE_RATIO, point.absorber_amplitude),
            eta: number(&of::ETA, point.eta),
            theta: number(&of::THETA, point.absorber_phase),
            branch: point.branch,
            kind: point.kind,
            trace: number(&of::TRACE, point.trace),
            determinant: number(&of::DETERMINANT, point.determinant),
            stable: point.stable,
            admissible: point.admissible,
            reach: point.largest_relative_displacement,
            above_collision: point.above_collision.map(|one| number(&of::ABOVE_COLLISION, one)),
        }
    }

    fn orbit(&self, orbit: &SymmetricOrbit) -> OrbitFacts {
        let found = &orbit.orbit;
        let length = |kind, value| self.scale.length(kind, value, ExactOrbit);
        let number = |kind, value| Quantity::new(kind, value, ExactOrbit);
        OrbitFacts {
            impact_displacement: length(&of::IMPACT_DISPLACEMENT, orbit.impact_displacement),
            peak: length(&of::PEAK, orbit.peaks.displacement),
            impact_speed: self.scale.velocity(
                &of::IMPACT_SPEED,
                [orbit.impact_speed, 0.0],
                ExactOrbit,
            ),
            phase: number(&of::IMPACT_PHASE, orbit.phase),
            multiplier: rounded(number(&of::SPECTRAL_RADIUS, found.multipliers.spectral_radius())),
            leading: found.multipliers.leading(),
            admissible: found.admissibility.admissible,
            sticks: found.admissibility.sticks(),
            stable: found.multipliers.stable(),
            residual: found.convergence.residual,
        }
    }

    fn boundaries(&self) -> Vec<BoundaryFacts> {
        let length = |factor, method| self.scale.length(&of::BOUNDARY, factor, method);
        let mut found: Vec<BoundaryFacts> = Vec::new();
        let node = self.analysis.boundaries.saddle_node.map(|node| node.branch);
        for one in self.errors {
            let place = one.exact.or(one.theory).unwrap_or(0.0);
            found.push(BoundaryFacts {
                kind: one.kind,
                branch: node
                    .filter(|_| one.kind == Bifurcation::SaddleNode && one.theory.is_some()),
                of_asymmetric: false,
                theory: one.theory.map(|at| length(at, Theory)),
                exact: one.exact.map(|at| length(at, ExactOrbit)),
                theory_error: one
                    .difference
                    .map(|error| Quantity::new(&of::THEORY_ERROR, error, Theory)),
                change: change(place),
                bounds_stability: one.bounds_stability,
                place,
            });
        }
        let asymmetric = self.exact.boundaries.iter().filter_map(|one| one.asymmetric.as_ref());
        for one in asymmetric {
            let more = [
                (Bifurcation::PeriodDoubling, one.period_doubling),
                (Bifurcation::Grazing, one.grazing),
            ];
            found.extend(more.into_iter().filter_map(|(kind, at)| {
                Some(BoundaryFacts {
                    kind,
                    branch: None,
                    of_asymmetric: true,
                    theory: None,
                    exact: Some(length(at?, ExactOrbit)),
                    theory_error: None,
                    change: change(at?),
                    bounds_stability: false,
                    place: at?,
                })
            }));
        }
        found.sort_by(|a, b| a.place.total_cmp(&b.place));
        found
    }

    fn limits(&self, margins: &ExactMargins) -> LimitFacts {
        let own = self.analysis.system.frequency_ratio();
        let end = |one: ExactMargin, at: Quantity| EndFacts {
            kind: Some(one.kind),
            at,
            change: change(one.factor),
            theory: None,
            theory_error: None,
        };
        let force = |one: ExactMargin| end(one, self.scale.amplitude(one.factor, ExactOrbit));
        let tune = |one: ExactMargin| end(one, self.scale.frequency(own * one.factor, ExactOrbit));
        LimitFacts {
            clearance: margins
                .clearance
                .map(|end| end.map(|one| self.end(Some(one.kind), one.factor))),
            forcing: margins.forcing().map(|end| end.map(force)),
            frequency: margins.frequency.map(|end| end.map(tune)),
        }
    }

    fn stretch(&self, stretch: &StableStretch) -> [EndFacts; 2] {
        [0, 1].map(|k| self.end(stretch.ends[k], stretch.clearance[k]))
    }

    /// An end in clearance, with theory's own.
    fn end(&self, kind: Option<Bifurcation>, factor: f64) -> EndFacts {
        let same = self.errors.iter().find(|one| one.exact == Some(factor));
        let theory = same.and_then(|one| one.theory);
        EndFacts {
            kind,
            at: self.scale.length(&of::CLEARANCE, factor, ExactOrbit),
            change: change(factor),
            theory: theory.map(|at| self.scale.length(&of::CLEARANCE, at, Theory)),
            theory_error: same
                .and_then(|one| one.difference)
                .map(|error| Quantity::new(&of::THEORY_ERROR, error, Theory)),
        }
    }

    fn probe(&self, probe: &Probe) -> ProbeFacts {
        let share = f64::from(probe.steady) / f64::from(probe.starts.max(1));
        let reach = wilson(probe.steady, probe.starts).map(|end| (end - share).abs());
        let share = Quantity::new(&of::START_SHARE, share, Simulation);
        ProbeFacts {
            clearance: self.scale.length(&of::CLEARANCE, probe.factor, Simulation),
            change: change(probe.factor),
            starts: probe.starts,
            steady: probe.steady,
            steady_share: share.with_error(reach[0].max(reach[1])),
            other: probe.other,
            // The largest of a few short runs: nothing is known of its error.
            other_peak: self.scale.length_with(&of::PEAK, [probe.other_peak, f64::NAN], Simulation),
        }
    }

    fn best(&self, study: &CaseStudy) -> Option<BestFacts> {
        let best = study.margins.best_clearance?;
        let bare = self.analysis.system.linear_response().map(|bare| bare.amplitude());
        let bare = bare.filter(|bare| *bare > 0.0)?;
        let ends = self.exact.stable_stretches().iter().flat_map(|one| one.clearance);
        let nearest = ends.map(|end| (end / best.factor - 1.0).abs()).min_by(f64::total_cmp);
        Some(BestFacts {
            clearance: rounded(self.scale.length(&of::CLEARANCE, best.factor, ExactOrbit)),
            peak: rounded(self.scale.length(&of::PEAK, best.peak, ExactOrbit)),
            change: Some(Quantity::new(
                &of::CHANGE_DB,
                20.0 * libm::log10(best.peak / bare),
                ExactOrbit,
            )),
            reduces: best.peak <= bare * (1.0 - super::NOTICEABLE),
            too_near: nearest
                .filter(|gap| *gap < TOO_NEAR)
                .map(|gap| Quantity::new(&of::GAP, gap, ExactOrbit).with_error(ROOT_OF_ROUNDING)),
            found: study.confirmations.best.as_ref().map(|probe| self.probe(probe)),
        })
    }
}

/// A number with the error of a minimum or a multiplier.
fn rounded(of: Quantity) -> Quantity {
    of.with_error(ROOT_OF_ROUNDING * of.value.abs())
}

/// A clearance, or its change, with the error of a limit that several starts find.
fn bracketed(of: Quantity, limit: &SimulatedLimit) -> Quantity {
    let width = BRACKETS * (limit.lost.factor - limit.kept).abs();
    match of.kind.dimension {
        Dimension::Length => of.with_error(width * of.value / limit.kept),
        _ => of.with_error(width),
    }
}

/// The relative change to a multiple.
fn change(factor: f64) -> Quantity {
    Quantity::new(&of::MARGIN, factor - 1.0, ExactOrbit)
}
