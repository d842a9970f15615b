//! What theory and exact orbits say: fixed points, orbits, boundaries, and how far they are from the case.

use serde_json::{Value, json};

use super::NOTICEABLE;
use super::cavity::cavity;
use super::scale::{ROOT_OF_ROUNDING, Scale, rounded};
use crate::analysis::{Analysis, FixedPoint};
use crate::method::Method::{ExactOrbit, Simulation, Theory};
use crate::motions::wilson;
use crate::orbits::{Bifurcation, FullSystem, StableStretch, SymmetricOrbit};
use crate::quantity::catalogue as of;
use crate::quantity::{Dimension, Quantity};
use crate::study::CaseStudy;
use crate::study::confirmations::{Probe, SimulatedLimit};
use crate::study::margins::{CavityLimit, ExactMargin, ExactMargins};
use crate::validation::AsymptoticError;
use crate::validation::asymptotic_error::asymptotic_errors;

/// Share of a clearance within which the end of steady resonance is too near for a design.
const TOO_NEAR: f64 = 0.1;

/// A limit that some starts find and some do not is no sharper than two of its brackets.
const BRACKETS: f64 = 2.0;

/// Where theory and orbits place a system, without margins.
pub fn theory(scale: &Scale, analysis: &Analysis, exact: &FullSystem) -> Value {
    let errors = &asymptotic_errors(analysis, exact);
    let facts = TheoryFacts { scale, analysis, exact, errors };
    let stretches = exact.stable_stretches();
    let mut told = json!({
        "area": analysis.zone.area,
        "strip": analysis.zone.strip,
        "fixed_points": analysis.fixed_points.iter().map(|one| facts.point(one)).collect::<Vec<_>>(),
        "orbits": exact.orbits.iter().map(|one| facts.orbit(one)).collect::<Vec<_>>(),
        // Number of the orbit that attracts, from 0.
        "attracting": exact.orbits.iter().position(|orbit| orbit.orbit.attracts()),
        "boundaries": facts.boundaries(),
        // All clearances with an attracting symmetric orbit, and whether the case's is one of them.
        "stretches": stretches.iter().map(|one| facts.stretch(one)).collect::<Vec<_>>(),
        "stable_here": exact.stretch().is_some(),
        "limits": null,
        "kept": null,
        "lost": null,
        "best": null,
        "amplitude_error": null,
    });
    // Areas, fixed points and boundaries above are then those of an ideal cavity with the mean restitution.
    if let Some(cavity) = cavity(scale, analysis.cavity.as_ref(), exact) {
        told["cavity"] = cavity;
    }
    told
}

/// The same of a study, with margins.
pub fn with_margins(scale: &Scale, study: &CaseStudy) -> Value {
    let (analysis, exact) = (&study.analysis, &study.exact);
    let facts = TheoryFacts { scale, analysis, exact, errors: &study.asymptotic_errors };
    // Of the amplitude of the stable fixed point.
    let mut told = theory(scale, analysis, exact);
    let points = told.get("cavity").unwrap_or(&told)["fixed_points"].as_array();
    let error = points.and_then(|points| {
        let index = points.iter().rposition(|point| point["stable"] == true)?;
        let id = format!("fixed-point-{}-C", index + 1);
        study.claims.iter().find(|claim| claim.id == id)?.difference
    });
    told["limits"] = json!(study.margins.exact.map(|margins| facts.limits(&margins)));
    if let Some(limit) = &study.confirmations.upper_limit {
        // The largest clearance at which every simulated start keeps 1:1 resonance, and the first at which
        // some do not.
        let kept = facts.clearance(limit.kept);
        told["kept"] = json!({
            "at": bracketed(kept, limit), "change": bracketed(change(limit.kept), limit),
        });
        told["lost"] = facts.probe(&limit.lost);
        let lost = Quantity { method: Simulation, ..facts.clearance(limit.lost.factor) };
        told["lost"]["clearance"] = json!(bracketed(lost, limit));
        told["lost"]["change"] = json!(bracketed(change(limit.lost.factor), limit));
    }
    told["best"] = json!(facts.best(study));
    told["amplitude_error"] = json!(error.map(theory_error));
    told
}

struct TheoryFacts<'a> {
    scale: &'a Scale,
    analysis: &'a Analysis,
    exact: &'a FullSystem,
    errors: &'a [AsymptoticError],
}

impl TheoryFacts<'_> {
    /// A fixed point of the slow flow.
    fn point(&self, point: &FixedPoint) -> Value {
        let number = |kind, value| Quantity::new(kind, value, Theory);
        let length = |kind, value| self.scale.units.quantity(kind, value, Theory);
        json!({
            "oscillator_amplitude": length(&of::OSCILLATOR_AMPLITUDE, point.oscillator_amplitude),
            "absorber_amplitude": length(&of::ABSORBER_AMPLITUDE, point.absorber_amplitude),
            "over_clearance": number(&of::ABSORBER_AMPLITUDE_RATIO, point.absorber_amplitude),
            "eta": number(&of::ETA, point.eta),
            "theta": number(&of::THETA, point.absorber_phase),
            "branch": point.branch,
            "kind": point.kind,
            "trace": number(&of::TRACE, point.trace),
            "determinant": number(&of::DETERMINANT, point.determinant),
            // Whether it stands for a stable motion, and whether the absorber stays between the walls.
            "stable": point.stable,
            "admissible": point.admissible,
            // Largest relative displacement between impacts, over the clearance.
            "reach": point.largest_relative_displacement,
            "above_collision": point.above_collision.map(|one| number(&of::ABOVE_COLLISION, one)),
        })
    }

    /// An exact symmetric orbit; its largest multiplier is that of half a period.
    fn orbit(&self, orbit: &SymmetricOrbit) -> Value {
        let found = &orbit.orbit;
        let length = |kind, value| self.scale.units.quantity(kind, value, ExactOrbit);
        let number = |kind, value| Quantity::new(kind, value, ExactOrbit);
        json!({
            "impact_displacement": length(&of::IMPACT_DISPLACEMENT, orbit.impact_displacement),
            "peak": length(&of::PEAK, orbit.peaks.displacement),
            "impact_speed": self.scale.units.quantity(&of::IMPACT_SPEED, orbit.impact_speed, ExactOrbit),
            "phase": number(&of::IMPACT_PHASE, orbit.phase),
            "multiplier": rounded(number(&of::SPECTRAL_RADIUS, found.multipliers.spectral_radius())),
            "leading": found.multipliers.leading(),
            "admissible": found.admissibility.admissible,
            // Whether the absorber would stay on the wall after an impact.
            "sticks": found.admissibility.sticks(),
            "stable": found.multipliers.stable(),
            "residual": found.convergence.residual,
        })
    }

    /// Boundaries in clearance by theory and exactly, by ascending clearance.
    fn boundaries(&self) -> Vec<Value> {
        let length = |factor, method| self.scale.units.quantity(&of::BOUNDARY, factor, method);
        let node = self.analysis.boundaries.saddle_node.map(|node| node.branch);
        let told = self.errors.iter().map(|one| {
            let of_theory = one.kind == Bifurcation::SaddleNode && one.theory.is_some();
            json!({
                "kind": one.kind,
                // The branch on which two fixed points of the theory meet.
                "branch": node.filter(|_| of_theory),
                "of_asymmetric": one.of_asymmetric,
                "theory": one.theory.map(|at| length(at, Theory)),
                "exact": one.exact.map(|at| length(at, ExactOrbit)),
                "theory_error": one.difference.map(theory_error),
                "change": change(one.place()),
                "bounds_stability": one.bounds_stability,
            })
        });
        told.collect()
    }

    /// Limits of the motion that the case has, below and above, in each parameter.
    fn limits(&self, margins: &ExactMargins) -> Value {
        let own = self.analysis.system.frequency_ratio();
        let end = |one: ExactMargin, at: Quantity| json!({ "kind": one.kind, "at": at, "change": change(one.factor) });
        let force = |one: ExactMargin| end(one, self.scale.amplitude(one.factor, ExactOrbit));
        let tune = |one: ExactMargin| end(one, self.scale.frequency(own * one.factor, ExactOrbit));
        let clearance = |one: ExactMargin| self.end(Some(one.kind), one.factor);
        let along = self.analysis.system.cavity().gravity_along;
        let absolute = |kind, at: Option<Quantity>| at.map(|at| json!({ "kind": kind, "at": at }));
        let tilt =
            |one: CavityLimit| absolute(one.kind, self.scale.tilt(one.acceleration, ExactOrbit));
        let friction = |one: CavityLimit| {
            absolute(one.kind, self.scale.friction([along, one.acceleration], ExactOrbit))
        };
        json!({
            "clearance": margins.clearance.map(|end| end.map(clearance)),
            "forcing": margins.forcing.map(|end| end.map(force)),
            "frequency": margins.frequency.map(|end| end.map(tune)),
            // Of a level cavity the tilt either way is the same.
            "tilt": margins.tilt.map(|end| end.and_then(tilt)),
            "friction": margins.friction.and_then(friction),
        })
    }

    fn stretch(&self, stretch: &StableStretch) -> [Value; 2] {
        [0, 1].map(|k| self.end(stretch.ends[k], stretch.clearance[k]))
    }

    /// An end of a range of clearances, with theory's own and by how much that is off.
    fn end(&self, kind: Option<Bifurcation>, factor: f64) -> Value {
        let same = self.errors.iter().find(|one| one.exact == Some(factor));
        let theory = same.and_then(|one| one.theory);
        let error = same.and_then(|one| one.difference);
        json!({
            "kind": kind,
            "at": self.clearance(factor),
            "change": change(factor),
            "theory": theory.map(|at| self.scale.units.quantity(&of::CLEARANCE, at, Theory)),
            "theory_error": error.map(theory_error),
        })
    }

    fn clearance(&self, factor: f64) -> Quantity {
        self.scale.units.quantity(&of::CLEARANCE, factor, ExactOrbit)
    }

    /// What several starts do at another clearance: how many end in steady 1:1 resonance, their share with the
    /// reach of its 95 % interval, and what the others end in.
    fn probe(&self, probe: &Probe) -> Value {
        let share = f64::from(probe.steady) / f64::from(probe.starts.max(1));
        let reach = wilson(probe.steady, probe.starts).map(|end| (end - share).abs());
        let share = Quantity::new(&of::START_SHARE, share, Simulation);
        json!({
            "clearance": self.scale.units.quantity(&of::CLEARANCE, probe.factor, Simulation),
            "change": change(probe.factor),
            "starts": probe.starts,
            "steady": probe.steady,
            "steady_share": share.with_error(reach[0].max(reach[1])),
            "other": probe.other,
            // The largest of a few short runs: nothing is known of its error.
            "other_peak": self.scale.units.quantity_with(&of::PEAK, [probe.other_peak, f64::NAN], Simulation),
        })
    }

    /// The clearance at which the attracting orbit vibrates least.
    fn best(&self, study: &CaseStudy) -> Option<Value> {
        let best = study.margins.best_clearance?;
        let bare = self.analysis.system.linear_response().map(|bare| bare.amplitude());
        let bare = bare.filter(|bare| *bare > 0.0)?;
        let ends = self.exact.stable_stretches().iter().flat_map(|one| one.clearance);
        let nearest = ends.map(|end| (end / best.factor - 1.0).abs()).min_by(f64::total_cmp);
        let gap = |gap| Quantity::new(&of::GAP, gap, ExactOrbit).with_error(ROOT_OF_ROUNDING);
        let level = 20.0 * libm::log10(best.peak / bare);
        Some(json!({
            "clearance": rounded(self.clearance(best.factor)),
            "peak": rounded(self.scale.units.quantity(&of::PEAK, best.peak, ExactOrbit)),
            "change": Quantity::new(&of::CHANGE_DB, level, ExactOrbit),
            // Whether that is worth calling a reduction.
            "reduces": best.peak <= bare * (1.0 - NOTICEABLE),
            // Distance to the end of the stable motion, where it is too small for a design.
            "too_near": nearest.filter(|gap| *gap < TOO_NEAR).map(gap),
            "found": study.confirmations.best.as_ref().map(|probe| self.probe(probe)),
        }))
    }
}

/// A clearance, or its change, with the error of a limit that several starts find.
fn bracketed(of: Quantity, limit: &SimulatedLimit) -> Quantity {
    let width = BRACKETS * (limit.lost.factor - limit.kept).abs();
    match of.kind.dimension {
        Dimension::Length => of.with_error(width * of.value / limit.kept),
        _ => of.with_error(width),
    }
}

/// By how much theory is off.
fn theory_error(error: f64) -> Quantity {
    Quantity::new(&of::THEORY_ERROR, error, Theory)
}

/// The relative change to a multiple.
fn change(factor: f64) -> Quantity {
    Quantity::new(&of::MARGIN, factor - 1.0, ExactOrbit)
}
