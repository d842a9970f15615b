//! Simulations that exist for a figure: the motion itself, and its neighbourhood in frequency and
//! clearance.

use std::f64::consts::FRAC_PI_2;

use serde::Serialize;

use crate::analysis::Analysis;
use crate::analysis::motion::{read_off, state_of};
use crate::motions::{Effort, Measured, Motion, Window, follow};
use crate::regimes::{Exponent, Lyapunov, Regime};
use crate::simulation::{Impact, Simulation, StartError, Stop, Trace};
use crate::system::{InvalidParameter, State, System};

use super::StudyError;
use super::diagrams::START;

/// Effort of one point of a map: enough to recognise a regime. More than ten thousand impacts in a
/// few hundred periods are recognised as more than two per period without going on.
const POINT: u64 = 100;
const MOST_IMPACTS_OF_POINT: u64 = 25;
/// Impacts after which an exponent is given up: some hundred per period, far above any settled motion
/// that a design would want.
const MOST_IMPACTS: u64 = 200_000;
/// What is measured of it in full.
const MEASURED: Window = Window { discard: 0, periods: 100, impact_limit: 10_000 };

/// The motion on an attractor, from its state at phase 0.
///
/// # Errors
/// [`StartError`] if that state is not finite.
pub fn trace(
    system: &System,
    state: State,
    periods: u64,
    samples_per_period: f64,
) -> Result<Trace, StartError> {
    let mut simulation = Simulation::new(system, state, 0.0)?;
    let mut trace = Trace::new(samples_per_period);
    simulation.run(periods, u64::MAX, &mut trace);
    Ok(trace)
}

/// The largest Lyapunov exponent of the motion from a state at phase 0, after each of the ascending
/// numbers of `periods`; none where the motion was lost, or for windows that are too short.
///
/// # Errors
/// [`StartError`] if that state is not finite.
pub fn exponents(
    system: &System,
    state: State,
    periods: &[u64],
) -> Result<Vec<Exponent>, StartError> {
    let mut simulation = Simulation::new(system, state, 0.0)?;
    let mut lyapunov = Lyapunov::begin(system);
    let mut found = Vec::new();
    let mut done = 0;
    for &all in periods {
        if simulation.run(all - done, MOST_IMPACTS, &mut lyapunov) != Stop::EndTime {
            break;
        }
        done = all;
        found.extend(lyapunov.exponent());
    }
    Ok(found)
}

/// `[B/b, C/b]` of a state, in the plane of the manifold: `B` from the absorber's speed, which is
/// constant between impacts and is `(2/pi) B Omega/(1 + eps)` in the sawtooth of (12); `C` from
/// displacement and velocity of the centre of mass, `v` of (3).
#[must_use]
pub fn projected(system: &System, state: &State) -> [f64; 2] {
    let (eps, omega) = (system.mass_ratio(), system.frequency_ratio());
    let v = state.x + eps * state.y;
    let velocity = state.x_velocity + eps * state.y_velocity;
    [FRAC_PI_2 * (1.0 + eps) * state.y_velocity.abs() / omega, libm::hypot(v, velocity / omega)]
}

/// The same right after an impact.
#[must_use]
pub fn projected_after(system: &System, impact: &Impact) -> [f64; 2] {
    let y = impact.x - impact.side.sign();
    let (x_velocity, y_velocity) = (impact.x_velocity_after, impact.y_velocity_after);
    projected(system, &State { x: impact.x, x_velocity, y, y_velocity })
}

/// What simulation finds at one clearance, everything else being the case's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct WalkPoint {
    /// Clearance over the case's.
    pub clearance: f64,
    /// Largest displacement of the oscillator over the case's clearance.
    pub peak: f64,
    /// Its regime.
    pub regime: Regime,
    /// `B/b` and `C/b`, over the clearance there: by the first harmonics; for a modulated motion, or
    /// one with few impacts, by the mean over all impacts, since harmonics average away where phases
    /// wander.
    pub amplitudes: [f64; 2],
}

/// What simulation finds at the given clearances (over the case's), each from the motion that the
/// theory predicts there, or from a moving absorber where it predicts none. Clearances at which the
/// absorber hits its walls too often to be followed are left out.
///
/// # Errors
/// [`StudyError`] where theory or simulation cannot be carried out.
pub fn walk(system: &System, clearances: &[f64]) -> Result<Vec<WalkPoint>, StudyError> {
    let found = visited(clearances, |factor| system.with_clearance_scaled(factor))?;
    let point = |(clearance, there, motion): (f64, System, Motion)| {
        Ok(WalkPoint {
            clearance,
            peak: clearance * motion.facts().peak.value,
            regime: motion.regime(),
            amplitudes: amplitudes(&there, &Measured::reach(&there, motion.state(), &MEASURED)?),
        })
    };
    found.into_iter().map(point).collect()
}

/// What simulation finds in a system at each of some values: from the motion that the theory predicts there, or
/// from a moving absorber where it predicts none. What there is not, or could not be followed, is left out.
///
/// # Errors
/// [`StudyError`] where theory or simulation cannot be carried out.
pub fn visited(
    values: &[f64],
    system: impl Fn(f64) -> Result<System, InvalidParameter>,
) -> Result<Vec<(f64, System, Motion)>, StudyError> {
    let there = values.iter().filter_map(|value| Some((*value, system(*value).ok()?)));
    let there: Vec<(f64, System)> = there.collect();
    let start = |(_, there): &(f64, System)| Ok((*there, moving_start(&Analysis::of(there)?)));
    let starts: Vec<(System, State)> =
        there.iter().map(start).collect::<Result<_, StudyError>>()?;
    let effort = Effort { most_impacts: MOST_IMPACTS_OF_POINT, ..Effort::over(POINT) };
    let ended = there.into_iter().zip(follow(&starts, &effort)?);
    let followed = ended.filter_map(|((value, there), motion)| Some((value, there, motion?)));
    Ok(followed.filter(|(_, _, motion)| motion.stop() == Stop::EndTime).collect())
}

fn amplitudes(system: &System, reached: &Measured) -> [f64; 2] {
    let wanders = matches!(reached.regime(), Regime::StronglyModulated | Regime::BelowTwo);
    if !wanders || reached.impacts.is_empty() {
        let seen = read_off(system, reached.oscillator_harmonic, reached.absorber_harmonic);
        return [seen.absorber_amplitude, seen.oscillator_amplitude];
    }
    let mut mean = [0.0; 2];
    for impact in &reached.impacts {
        let [absorber, oscillator] = projected_after(system, impact);
        mean[0] += absorber / reached.impacts.len() as f64;
        mean[1] += oscillator / reached.impacts.len() as f64;
    }
    mean
}

/// On the largest motion that the theory predicts; else an absorber that crosses its cavity.
fn moving_start(analysis: &Analysis) -> State {
    let best = analysis.stable_points().last().or_else(|| analysis.fixed_points.last());
    best.map_or(START, |point| state_of(point, &analysis.system))
}
