//! Claims about the motions of the case itself.

use std::f64::consts::SQRT_2;

use super::claim::NearBoundary;
use super::clearances::clearances;
use super::tolerance::{SAYS_NOTHING, asymptotic_error, averages_error};
use super::{Claim, Finding, Reason, Statement, Verdict};
use crate::analysis::motion::read_off;
use crate::analysis::{Analysis, Area, FixedPoint, Strip};
use crate::dissipation::{ModulatedCycle, SteadyState};
use crate::motions::{Measured, Motion, MotionKind, Motions, Window};
use crate::orbits::{FullSystem, Measures, SymmetricOrbit};
use crate::regimes::{DynamicsKind, Regime};
use crate::simulation::StartError;
use crate::system::System;

/// For each fixed point: stable or not, and if an exact orbit is near it: amplitudes and phases.
pub fn fixed_points(analysis: &Analysis, exact: &FullSystem) -> Vec<Claim> {
    let mut claims = Vec::new();
    // The exact orbits are written with the steady motion between impacts.
    let unsolved = analysis.system.linear_response().is_none();
    for (index, point) in analysis.fixed_points.iter().enumerate() {
        let FixedPoint { absorber_amplitude, stable, .. } = *point;
        let number = index + 1;
        let orbit = counterpart(analysis, exact, point);
        let observed = match orbit {
            Some(SymmetricOrbit { orbit, .. }) => Finding::Stability {
                stable: orbit.attracts(),
                multiplier: Some(orbit.multipliers.spectral_radius()),
            },
            None if unsolved => Finding::Unsolved,
            None => Finding::NoOrbit,
        };
        let agrees = orbit.is_some_and(|orbit| orbit.orbit.attracts() == stable);
        claims.push(Claim::of_outcome(
            Statement::Stability {
                point: number,
                absorber_amplitude: Some(absorber_amplitude),
                stable,
            },
            [Finding::Stability { stable, multiplier: None }, observed],
            Reason::NearestOrbit,
            if unsolved { Verdict::Undecided } else { Verdict::of(agrees) },
        ));
        claims
            .extend(orbit.into_iter().flat_map(|orbit| amplitudes(analysis, point, orbit, number)));
    }
    claims
}

/// The exact orbit that a fixed point stands for, by the absorber's amplitude.
fn counterpart<'a>(
    analysis: &Analysis,
    exact: &'a FullSystem,
    point: &FixedPoint,
) -> Option<&'a SymmetricOrbit> {
    let orbits: Vec<f64> = exact.orbits.iter().map(|one| one.absorber_amplitude).collect();
    let points = analysis.fixed_points.iter().map(|one| one.absorber_amplitude);
    let points: Vec<f64> = points.collect();
    let found =
        nearest(point.absorber_amplitude, &points, &orbits, asymptotic_error(&analysis.system));
    found.map(|k| &exact.orbits[k])
}

/// Of the amplitudes of orbits that which stands for a fixed point with an amplitude: the nearest, if no other fixed point is nearer
/// to it. Next to a saddle-node two points move apart with the root of the distance from it, and so does their error.
pub(crate) fn nearest(point: f64, points: &[f64], orbits: &[f64], error: f64) -> Option<usize> {
    let distance = |orbit: f64, point: f64| (orbit / point - 1.0).abs();
    let of = |k: &usize| distance(orbits[*k], point);
    let found = (0..orbits.len()).min_by(|a, b| of(a).total_cmp(&of(b)))?;
    let mine = of(&found);
    let nearer = points.iter().filter(|other| distance(orbits[found], **other) < mine).count();
    (nearer == 0 && mine < (2.0 * error).max(error.sqrt())).then_some(found)
}

fn amplitudes(
    analysis: &Analysis,
    point: &FixedPoint,
    orbit: &SymmetricOrbit,
    number: usize,
) -> Vec<Claim> {
    let Ok(measures) = Measures::of(&analysis.system, &orbit.orbit.cycle) else {
        return Vec::new();
    };
    let seen = read_off(&analysis.system, measures.oscillator_harmonic, measures.absorber_harmonic);
    let tolerance = asymptotic_error(&analysis.system);
    let reason = Reason::NeglectedTerms { says_nothing: tolerance > SAYS_NOTHING };
    [
        ("C", [point.oscillator_amplitude, seen.oscillator_amplitude]),
        ("B", [point.absorber_amplitude, seen.absorber_amplitude]),
        ("eta", [point.eta, seen.eta]),
        ("Theta", [point.absorber_phase, seen.absorber_phase]),
    ]
    .map(|(symbol, values)| {
        let statement = Statement::FixedPoint { point: number, symbol };
        Claim::of_number(statement, values, tolerance, reason)
    })
    .to_vec()
}

/// Relative error of a closed form of the full system, which only rounding separates from simulation.
pub(super) const ROUNDING: f64 = 1e-9;

/// Rest is a motion of the full system exactly where the bare oscillator's amplitude is below the
/// clearance.
pub fn rest(analysis: &Analysis, window: &Window) -> Result<Option<Claim>, StartError> {
    let system = &analysis.system;
    let Some(linear) = system.linear_response() else {
        return Ok(None);
    };
    // A larger oscillation hits an absorber that rests in the middle; without excitation there is
    // no oscillation to compare.
    if linear.amplitude() >= 1.0 || linear.amplitude() == 0.0 {
        return Ok(None);
    }
    let reached = Measured::reach(system, linear.state(system), window)?;
    let rests = reached.regime() == Regime::AtRest;
    let claim = Claim::of_number(
        Statement::Rest,
        [linear.amplitude(), reached.facts.peak.value],
        ROUNDING,
        Reason::Rounding,
    );
    let verdict = if rests { claim.verdict } else { Verdict::Refuted };
    Ok(Some(Claim { verdict, ..claim }))
}

/// What area and strip say of the motions found. Beside a motion that repeats a chaotic one may be a
/// transient, and whether a start's is over by the end of the time that it is watched is chance, which
/// the rounding of the last digit decides: what follows from such starts alone is undecided.
pub fn area(analysis: &Analysis, found: &Motions, measured: &[Measured]) -> Claim {
    type Seen<'a> = (&'a Motion, &'a Measured);
    let all: Vec<Seen> = found.iter().zip(measured).collect();
    let moving = all.iter().filter(|one| one.0.rest().is_none());
    let (steady, others): (Vec<&Seen>, Vec<&Seen>) =
        moving.partition(|one| one.0.regime() == Regime::TwoSymmetric);
    let among = |regime| others.iter().any(|one| one.0.regime() == regime);
    let modulated = among(Regime::StronglyModulated);
    let stays = |(motion, measured): &Seen| {
        let dynamics = measured.classification.dynamics;
        !matches!(motion.kind(), MotionKind::Wanders) || dynamics == DynamicsKind::QuasiPeriodic
    };
    let beside = !others.is_empty();
    let may_end = beside && !others.iter().any(|one| stays(one));
    let ended = steady.iter().any(|one| one.0.reached().late > 0);
    let steady = !steady.is_empty();
    // What holds, and whether chance could have it otherwise.
    let (area, strip) = (analysis.zone.area, analysis.zone.strip);
    let doubling = analysis.boundaries.period_doubling;
    let beyond_doubling = doubling.is_some_and(|at| analysis.system.forcing_per_clearance() > at);
    let (predicted, holds, by_chance) = match (area, strip) {
        (Area::Z3, None) => {
            (Finding::OnlySteady, steady && !beside, steady && (may_end || ended && !beside))
        }
        (Area::Z3, Some(Strip::A1)) => {
            (Finding::SteadyBesideModulated, steady && beside, ended && !beside)
        }
        (Area::Z3, Some(Strip::A2)) => (Finding::StronglyModulated, modulated && !steady, false),
        // Two asymmetric impacts that have doubled their period are unstable.
        (Area::Z2, _) if !beyond_doubling => {
            (Finding::TwoAsymmetric, among(Regime::TwoAsymmetric), false)
        }
        (Area::Z2 | Area::Z4, _) => (Finding::NotSteady, !steady && beside, false),
        (Area::Z1, _) => (Finding::AboveTwo, among(Regime::AboveTwo), false),
    };
    let led = |one: &Motion| f64::from(one.reached().starts) / f64::from(found.of_starts().max(1));
    let shares = found.iter().map(|one| (one.regime(), led(one)));
    let shares = shares.filter(|(_, share)| *share > 0.0).collect();
    let open = by_chance || !steady && !beside;
    Claim::of_outcome(
        Statement::Area { area, strip },
        [predicted, Finding::Regimes { shares }],
        Reason::Starts { near: near_boundary(analysis), by_chance },
        if open { Verdict::Undecided } else { Verdict::of(holds) },
    )
}

/// The nearest boundary, where it is within the theory's error: an area is only as certain as that.
fn near_boundary(analysis: &Analysis) -> Option<NearBoundary> {
    let error = asymptotic_error(&analysis.system);
    clearances(analysis)
        .into_iter()
        .map(|at| NearBoundary {
            bifurcation: at.kind,
            distance: (at.clearance - 1.0).abs(),
            error,
        })
        .min_by(|a, b| a.distance.total_cmp(&b.distance))
        .filter(|near| near.distance < error)
}

/// Of each simulated motion with impacts that is not a fixed point's, the nearest stable amplitude of the averaged flow in
/// its regime, or its modulated cycle. The amplitude is that of a sine with the same root mean square; there is a claim
/// where it is within the amplitudes that the flow knows.
pub fn averaged(
    system: &System,
    states: &[SteadyState],
    cycle: Option<&ModulatedCycle>,
    [least, most]: [f64; 2],
    found: &Motions,
) -> Vec<Claim> {
    let has_amplitude =
        [Regime::AboveTwo, Regime::TwoAsymmetric, Regime::BelowTwo, Regime::StronglyModulated];
    let observed = |found: &Motion| SQRT_2 * found.facts().rms.value;
    let known = found.iter().enumerate().filter(|(_, found)| {
        // A cycle has its own range.
        let modulated = cycle.is_some() && found.regime() == Regime::StronglyModulated;
        let within = modulated || (least..=most).contains(&observed(found));
        has_amplitude.contains(&found.regime()) && within
    });
    known
        .map(|(index, found)| {
            let (regime, observed) = (found.regime(), observed(found));
            let statement = Statement::Averaged { motion: index + 1, regime };
            let modulated = regime == Regime::StronglyModulated;
            let stable = states.iter().filter(|state| state.stable && state.regime == regime);
            let cycle = cycle.filter(|_| modulated);
            let amplitudes = stable.map(|state| state.amplitude);
            let amplitudes = amplitudes.chain(cycle.map(|cycle| SQRT_2 * cycle.rms));
            let apart = |amplitude: f64| (amplitude / observed - 1.0).abs();
            let nearest = amplitudes.min_by(|a, b| apart(*a).total_cmp(&apart(*b)));
            let scatter = cycle.map_or(0.0, |cycle| cycle.rms_error / cycle.rms);
            let tolerance = averages_error(system, Some(regime)) + scatter;
            let reason = Reason::Averages { says_nothing: tolerance > SAYS_NOTHING, modulated };
            match nearest {
                Some(amplitude) => {
                    Claim::of_number(statement, [amplitude, observed], tolerance, reason)
                }
                None => {
                    let findings = [Finding::NoAmplitude, Finding::Length(observed)];
                    Claim::of_outcome(statement, findings, reason, Verdict::Refuted)
                }
            }
        })
        .collect()
}
