//! Peak displacement of the oscillator over frequency: theory, exact orbits, simulation, without absorber, and with a tuned
//! mass damper.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};

use crate::analysis::Manifold;
use crate::analysis::frequency_response::ResponsePoint;
use crate::linear::bare_amplitude;
use crate::motions::Motion;
use crate::orbits::SteadyOrbit;
use crate::simulation::Stop;
use crate::study::scenes::visited;
use crate::study::{CaseStudy, StudyError};
use crate::system::System;

use super::{Line, even, responses, steady_orbits_at, window};

/// Simulated frequencies.
const SWEEP: u32 = 17;
/// Frequencies of the exact orbits.
const EXACT: u32 = 60;
/// Samples of the bare oscillator's resonance.
const BARE: u32 = 600;
/// The resonance of the bare oscillator is cut at this many times the absorber's highest peak.
const CUT: f64 = 2.2;

/// Peaks over frequency, over the clearance.
#[derive(Debug, Clone)]
pub struct AmplitudeCurves {
    /// First and last frequency ratio.
    pub window: [f64; 2],
    /// Without absorber.
    pub bare: Line,
    /// With the tuned mass damper of its mass instead.
    pub damper: Line,
    /// The theory's 1:1 motions: the stable ones, and the others.
    pub theory: [Line; 2],
    /// Exact 1:1 orbits that are motions, with their frequency ratio.
    pub exact: Vec<(f64, SteadyOrbit)>,
    /// Simulated motions with their frequency ratio.
    pub simulated: Vec<(f64, System, Motion)>,
    /// The case's main motion, where it could be followed.
    pub here: Option<f64>,
    /// The largest that is shown.
    pub top: f64,
}

impl AmplitudeCurves {
    /// Of a simulated case.
    pub(super) fn of(study: &CaseStudy) -> Result<Self, StudyError> {
        let (system, manifold) = (&study.analysis.system, &study.analysis.manifold);
        let window = window(system);
        let over = |count| even(window[0], window[1], count);
        let mut ratios: Vec<f64> = over(BARE).chain([system.frequency_ratio(), 1.0]).collect();
        ratios.sort_by(f64::total_cmp);
        let linear = |amplitude: &dyn Fn(&System) -> f64| -> Line {
            let at = |ratio: &f64| {
                let there = system.with_frequency_ratio(*ratio);
                [*ratio, there.map_or(f64::NAN, |there| amplitude(&there))]
            };
            ratios.iter().map(at).collect()
        };
        let bare = linear(&bare_amplitude);
        // The one that the page is about.
        let rivals = study.band.as_ref().map_or(&study.rivals, |band| band.rivals());
        let damper = linear(&|there| rivals.damper.amplitude(there));
        let half = 0.5 * (window[1] - window[0]) / f64::from(SWEEP);
        let middles: Vec<f64> = even(window[0] + half, window[1] - half, SWEEP - 1).collect();
        let simulated = visited(&middles, |ratio| system.with_frequency_ratio(ratio))?;
        let known = study.main().filter(|(_, one)| one.stop == Stop::EndTime && one.periods > 0);
        let here = known.map(|(motion, _)| motion.facts().peak.value);
        let here = here.filter(|peak| peak.is_finite());
        let peaks = simulated.iter().map(|(.., at)| at.facts().peak.value).chain(here);
        let top = top(&bare, peaks, study.rivals.bare.1);
        let place = |point: &ResponsePoint| {
            let ratio = 1.0 + system.mass_ratio() * point.detuning;
            [ratio, peak(system.mass_ratio(), manifold, point)]
        };
        let theory = responses::lines(system, manifold, 2.0 + top, &place);
        let orbits = |ratio| steady_orbits_at(system.with_frequency_ratio(ratio).ok());
        let exact = over(EXACT).flat_map(|at| orbits(at).into_iter().map(move |one| (at, one)));
        let exact = exact.filter(|(_, one)| one.orbit.admissibility.admissible).collect();
        Ok(Self { window, bare, damper, theory, exact, simulated, here, top })
    }
}

/// The upper end of the axis: all that was simulated, and the bare oscillator's resonance as far as it leaves
/// the rest legible.
fn top(bare: &Line, simulated: impl Iterator<Item = f64>, alone: f64) -> f64 {
    let largest =
        |largest: f64, value: f64| if value.is_finite() { largest.max(value) } else { largest };
    let moving = simulated.fold(0.0, largest);
    let resonance = bare.iter().map(|point| point[1]).fold(0.0, largest);
    let cut = if moving > 0.0 { resonance.min(CUT * moving) } else { resonance };
    let alone = largest(0.0, alone).min(2.0 * CUT * moving.max(1e-3));
    let top = 1.08 * moving.max(cut).max(alone);
    if top > 0.0 { top } else { 1.0 }
}

/// Largest displacement over the clearance of the motion that a point of the response stands for:
/// `(1 + eps) x = (1 + eps) C sin z + eps (2/pi) B Pi(z + Theta)`, which is stationary where
/// `cos z = -/+ eps (2/pi) B/((1 + eps) C)`, or has a corner.
fn peak(mass_ratio: f64, manifold: &Manifold, point: &ResponsePoint) -> f64 {
    let (absorber, oscillator) = (point.absorber_amplitude, point.oscillator_amplitude);
    let theta = manifold.absorber_phase(absorber, absorber - 1.0);
    let share = mass_ratio / (1.0 + mass_ratio) * FRAC_2_PI * absorber;
    let displacement =
        |z: f64| oscillator * libm::sin(z) + share * libm::asin(libm::sin(z + theta));
    let turning = libm::acos((share / oscillator).clamp(-1.0, 1.0));
    let corner = FRAC_PI_2 - theta;
    [turning, -turning, PI - turning, PI + turning, corner, corner + PI]
        .into_iter()
        .map(|z| displacement(z).abs())
        .fold(0.0, f64::max)
}
