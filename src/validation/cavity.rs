//! Claims of a cavity that is not ideal: the fixed points of its theory against the exact orbits, and the absorber at rest
//! against simulation.

use std::f64::consts::FRAC_2_PI;

use super::motions::ROUNDING;
use super::tolerance::{SAYS_NOTHING, asymptotic_error};
use super::{Claim, Finding, Reason, Statement, Verdict};
use crate::analysis::motion::{read_off, wrapped};
use crate::cavity::{CavityAnalysis, CavityFixedPoint, CavityTheory, Forcing};
use crate::motions::{Measured, Motion, RestKind, SettlingTime, Window};
use crate::orbits::{FullSystem, Measures, Orbit};
use crate::regimes::Regime;
use crate::simulation::StartError;
use crate::system::System;

/// What the theory and an orbit both have; lengths over the clearance.
struct SharedNumbers {
    oscillator_amplitude: f64,
    absorber_amplitude: f64,
    eta: f64,
    /// Phase from the impact on the `+b` wall to the other one.
    between: f64,
}

impl SharedNumbers {
    fn of_point(point: &CavityFixedPoint) -> Self {
        Self {
            oscillator_amplitude: point.motion.oscillator_amplitude,
            absorber_amplitude: point.motion.absorber_amplitude,
            eta: point.eta,
            between: point.motion.times[0],
        }
    }

    /// Of an orbit: the amplitude of `v = x + eps y`, half of the way that `(1 + eps) y` goes between impacts.
    fn of_orbit(system: &System, orbit: &Orbit) -> Option<Self> {
        let cycle = orbit.cycle.unfolded();
        let measures = Measures::of(system, &orbit.cycle).ok()?;
        let seen = read_off(system, measures.oscillator_harmonic, measures.absorber_harmonic);
        let [first, second] = [0, 1].map(|k| cycle.impacts[k].state().y);
        Some(Self {
            oscillator_amplitude: seen.oscillator_amplitude,
            absorber_amplitude: 0.5 * (1.0 + system.mass_ratio()) * (second - first).abs(),
            eta: seen.eta,
            between: system.frequency_ratio() * cycle.durations[0],
        })
    }

    /// The larger of the relative distance in `B` and that in phase.
    fn distance(&self, other: &Self) -> f64 {
        let apart = (self.absorber_amplitude / other.absorber_amplitude - 1.0).abs();
        apart.max((self.between - other.between).abs())
    }
}

/// For each fixed point that is a motion: stable or not, and if an exact orbit is near it: amplitudes, phase, and the
/// phase between its impacts.
pub fn fixed_points(cavity: &CavityAnalysis, exact: &FullSystem) -> Vec<Claim> {
    let system = &exact.system;
    let Some(found) = &exact.two_impact else { return Vec::new() };
    let (theory, points, forcing) = (cavity.theory, &cavity.fixed_points, Forcing::of(system));
    let numbers: Vec<SharedNumbers> = points.iter().map(SharedNumbers::of_point).collect();
    // One whose flights cross a wall or slide back is no motion.
    let orbits = found.orbits.iter().filter(|orbit| orbit.admissibility.admissible);
    let orbits: Vec<(&Orbit, SharedNumbers)> =
        orbits.filter_map(|one| Some((one, SharedNumbers::of_orbit(system, one)?))).collect();
    let error = asymptotic_error(system);
    let mut claims = Vec::new();
    for (index, point) in points.iter().enumerate().filter(|(_, point)| point.motion.admissible) {
        let own = &numbers[index];
        // As of an ideal cavity: the nearest one, if no other point is nearer to it.
        let nearest = orbits.iter().min_by(|a, b| a.1.distance(own).total_cmp(&b.1.distance(own)));
        let nearest = nearest.filter(|(_, orbit)| {
            let mine = orbit.distance(own);
            mine < (2.0 * error).max(error.sqrt())
                && numbers.iter().all(|other| orbit.distance(other) >= mine)
        });
        let observed = nearest.map_or(Finding::NoOrbit, |(orbit, _)| Finding::Stability {
            stable: orbit.attracts(),
            multiplier: Some(orbit.radius_per_period()),
        });
        let agrees = nearest.is_some_and(|(orbit, _)| orbit.attracts() == point.stable);
        let (absorber_amplitude, stable) = (own.absorber_amplitude, point.stable);
        claims.push(Claim::of_outcome(
            Statement::Stability {
                point: index + 1,
                absorber_amplitude: Some(absorber_amplitude),
                stable,
            },
            [Finding::Stability { stable, multiplier: None }, observed],
            Reason::NearestOrbit,
            Verdict::of(agrees),
        ));
        if let Some((_, orbit)) = nearest {
            let errors = [error, error + moved(&theory, &forcing, own, error)];
            claims.extend(numbers_claims(index + 1, [own, orbit], errors));
        }
    }
    claims
}

/// By how much the phase between the impacts moves when the forcing is off by an error: next to symmetry breaking it goes
/// with the root of the distance.
fn moved(theory: &CavityTheory, forcing: &Forcing, own: &SharedNumbers, error: f64) -> f64 {
    let there = [1.0 - error, 1.0 + error].map(|factor| {
        let forcing_per_clearance = factor * forcing.forcing_per_clearance;
        let points = theory.fixed_points(&Forcing { forcing_per_clearance, ..*forcing });
        let all = points.iter().map(SharedNumbers::of_point);
        let nearest = all.min_by(|a, b| a.distance(own).total_cmp(&b.distance(own)));
        nearest.map_or(0.0, |one| (one.between - own.between).abs())
    });
    there[0].max(there[1])
}

/// `errors` of amplitudes and phase, and of the phase between the impacts.
fn numbers_claims(
    point: usize,
    [theory, orbit]: [&SharedNumbers; 2],
    errors: [f64; 2],
) -> [Claim; 4] {
    [
        ("C", [theory.oscillator_amplitude, orbit.oscillator_amplitude]),
        ("B", [theory.absorber_amplitude, orbit.absorber_amplitude]),
        ("eta", [theory.eta, orbit.eta].map(wrapped)),
        ("t_1", [theory.between, orbit.between]),
    ]
    .map(|(symbol, values)| {
        let between = symbol == "t_1";
        let error = errors[usize::from(between)];
        let says_nothing = error > SAYS_NOTHING;
        let reason = match between {
            true => Reason::ForcingOff { says_nothing },
            false => Reason::NeglectedTerms { says_nothing },
        };
        Claim::of_number(Statement::FixedPoint { point, symbol }, values, error, reason)
    })
}

/// The absorber that rests, where it may: the structure's peak in closed form, gravity included, against simulation.
pub fn at_rest(
    system: &System,
    known: Option<&Motion>,
    window: &Window,
) -> Result<Option<Claim>, StartError> {
    let resting = known.and_then(|motion| Some((motion, motion.rest()?)));
    let Some((motion, rest)) = resting.filter(|(_, rest)| rest.amplitude > 0.0) else {
        return Ok(None);
    };
    let cavity = system.cavity();
    let omega = system.frequency_ratio();
    // The absorber's amplitude over the structure's.
    let slides = 2.0 * FRAC_2_PI * cavity.friction_acceleration / (omega * omega * rest.amplitude);
    let (peak, tolerance, reason) = match rest.rest {
        RestKind::Held | RestKind::Floating => {
            (motion.facts().peak.value, ROUNDING, Reason::Rounding)
        }
        RestKind::Sliding => {
            let tolerance = slides * slides;
            let reason = Reason::DryFriction { says_nothing: tolerance > SAYS_NOTHING };
            (rest.amplitude, tolerance, reason)
        }
    };
    // What slides was simulated from rest: of the transient the square is left, 4e-11.
    let discard = window.discard.max(SettlingTime::of(system).periods);
    let window = Window { discard, ..*window };
    let reached = Measured::reach(system, motion.state(), &window)?;
    let peaks = [peak, reached.facts.peak.value];
    let statement = Statement::Inactive { absorber: rest.rest };
    let claim = Claim::of_number(statement, peaks, tolerance, reason);
    let rests = reached.regime() == Regime::AtRest;
    Ok(Some(if rests { claim } else { Claim { verdict: Verdict::Refuted, ..claim } }))
}
