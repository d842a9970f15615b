//! Frequency responses of the 1:1 motion at several clearances (Fig. 7).

use crate::analysis::frequency_response::{ResponsePoint, response};
use crate::analysis::{FixedPointCurve, Manifold};
use crate::study::CaseStudy;
use crate::system::{Parameters, System};

use super::{Levels, Line, branches, even, on_stable_branch, window};

/// Half the band around the natural frequency that the absorber should serve, in detuning: where the bare
/// oscillator of Table 1 is amplified more than tenfold.
pub const BAND: f64 = 6.0;
/// Detunings at which a boundary's smallest forcing is sought.
const SAMPLES: u32 = 4000;
/// The responses show so many symmetry-breaking amplitudes, unless the case lies above.
const ABOVE_BREAKING: f64 = 1.6;
/// Beyond this many symmetry-breaking amplitudes a linear axis would hide the stable branch.
const FAR: f64 = 5.0;
/// Responses other than the case's are drawn up to this `B/b`.
const OTHERS: f64 = 15.0;
/// Forcings closer than this to the case's, in their logarithm, would be drawn over it.
const DISTINCT: f64 = 0.18;

/// Responses of several clearances.
#[derive(Debug, Clone)]
pub struct Responses {
    /// The clearances, from the smallest; for `Self::around` the case's own last.
    pub members: Vec<ClearanceResponse>,
    /// Whether the case's is the last.
    pub own: bool,
    /// First and last frequency ratio.
    pub window: [f64; 2],
    /// Smallest and largest `C/b` that is shown; the smallest is above 0 on a logarithmic axis.
    pub heights: [f64; 2],
    /// Where the areas end.
    pub levels: Levels,
}

/// The response of one clearance.
#[derive(Debug, Clone)]
pub struct ClearanceResponse {
    /// The clearance over the case's.
    pub clearance: f64,
    /// `[frequency ratio, C/b]`: the stable part, and the others.
    pub lines: [Line; 2],
    /// Share of the band `abs(sigma) < BAND` in area Z3, without its strips.
    pub share: f64,
}

impl Responses {
    /// The case's and three others that show the areas.
    pub(super) fn around(study: &CaseStudy) -> Option<Self> {
        let analysis = &study.analysis;
        let (system, manifold) = (&analysis.system, &analysis.manifold);
        let gamma = system.forcing_per_clearance();
        let boundaries = &analysis.boundaries;
        let others = others(gamma, boundaries.symmetry_breaking, boundaries.hopf);
        if others.is_empty() {
            return None;
        }
        let amplitudes = analysis.fixed_points.iter().map(|point| point.oscillator_amplitude);
        let breaking = manifold.symmetry_breaking.oscillator_amplitude;
        let top = (1.15 * amplitudes.fold(0.0, f64::max)).max(ABOVE_BREAKING * breaking);
        let low = (0.7 * manifold.fold.oscillator_amplitude).max(1e-5 * top);
        let bottom = if top > FAR * breaking { low } else { 0.0 };
        // On the right branch C exceeds B - b, whatever the restitution. The samples are spread evenly: a
        // curve that matters only below must not be coarse there.
        let others = others.into_iter().map(|at| (at, (top + 1.0).min(OTHERS)));
        let members = others.chain([(gamma, top + 1.0)]);
        let members =
            members.filter_map(|(at, largest)| ClearanceResponse::of(system, at, largest));
        Some(Self {
            members: members.collect(),
            own: true,
            window: window(system),
            heights: [bottom, top],
            levels: Levels::of(manifold),
        })
    }

    /// Four across the areas, wherever the case lies.
    pub(super) fn across(study: &CaseStudy) -> Option<Self> {
        let (system, manifold) = (&study.analysis.system, &study.analysis.manifold);
        if manifold.fold.oscillator_amplitude <= 0.0 {
            return None;
        }
        let top = 2.2 * manifold.symmetry_breaking.oscillator_amplitude;
        let members = family(system).into_iter();
        let half = BAND * system.mass_ratio();
        Some(Self {
            members: members
                .filter_map(|at| ClearanceResponse::of(system, at, top + 1.0))
                .collect(),
            own: false,
            window: [(1.0 - half).max(0.05), 1.0 + half],
            heights: [0.0, top],
            levels: Levels::of(manifold),
        })
    }
}

impl ClearanceResponse {
    fn of(system: &System, gamma: f64, largest: f64) -> Option<Self> {
        let there = Parameters { forcing_per_clearance: gamma, ..system.parameters() };
        let there = System::new(there).ok()?;
        let manifold = Manifold::of(system.restitution());
        let place = |point: &ResponsePoint| {
            [1.0 + there.mass_ratio() * point.detuning, point.oscillator_amplitude]
        };
        Some(Self {
            clearance: system.forcing_per_clearance() / gamma,
            lines: lines(&there, &manifold, largest, &place),
            share: share(system, gamma),
        })
    }
}

/// The stable part of a system's response up to `B/b = largest`, and the others, as lines with gaps.
///
/// On the stable branch a fixed point is a saddle where the curve has turned back: `gamma^2` then falls with
/// the amplitude, so that on the lower side of the resonance the frequency falls and on the upper side it
/// rises.
pub(super) fn lines(
    system: &System,
    manifold: &Manifold,
    largest: f64,
    place: &dyn Fn(&ResponsePoint) -> [f64; 2],
) -> [Line; 2] {
    let mut lines = [Vec::new(), Vec::new()];
    for (side, curves) in response(system, manifold, largest).iter().enumerate() {
        let outwards = if side == 0 { 1.0 } else { -1.0 };
        let stable = |[a, b]: [&ResponsePoint; 2]| {
            let rises = (b.detuning - a.detuning) * outwards > 0.0;
            on_stable_branch([a.branch, b.branch], rises)
        };
        for curve in curves {
            for (line, more) in lines.iter_mut().zip(branches(curve, &stable, place)) {
                line.extend(more);
            }
        }
    }
    lines
}

/// Three forcings per clearance that show the areas, apart from the case's.
fn others(case: f64, breaking: f64, hopf: f64) -> Vec<f64> {
    let apart = |gamma: f64| {
        let distance = libm::log(gamma / case);
        if distance.abs() > DISTINCT {
            gamma
        } else {
            case * libm::exp(1.5 * DISTINCT.copysign(distance))
        }
    };
    let wanted = [1.4 * breaking, (breaking * hopf).sqrt(), 0.75 * hopf];
    let usable = wanted.into_iter().filter(|gamma| gamma.is_finite() && *gamma > 0.0);
    usable.map(apart).collect()
}

/// Four forcings per clearance, from the largest: one that lifts the response far beyond symmetry breaking,
/// one with which its top just reaches it, one inside Z3, and one below the fold at every frequency.
fn family(system: &System) -> [f64; 4] {
    let least = |boundary: fn(&FixedPointCurve) -> f64| {
        curves(system).map(|curve| boundary(&curve)).fold(f64::INFINITY, f64::min)
    };
    let (hopf, breaking) =
        (least(FixedPointCurve::hopf), least(FixedPointCurve::symmetry_breaking));
    [2.5 * breaking, breaking, (hopf * breaking).sqrt(), 0.85 * hopf]
}

/// The clearances of the four over the case's, each with the share of the band that lies in Z3.
pub fn shares(system: &System) -> [(f64, f64); 4] {
    let own = system.forcing_per_clearance();
    family(system).map(|gamma| (own / gamma, share(system, gamma)))
}

/// The fixed points over the detunings of the band.
fn curves(system: &System) -> impl Iterator<Item = FixedPointCurve> {
    let manifold = Manifold::of(system.restitution());
    let detunings = even(-BAND, BAND, SAMPLES);
    detunings.map(move |at| FixedPointCurve::at_detuning(system, &manifold, at))
}

fn share(system: &System, gamma: f64) -> f64 {
    let inside =
        curves(system).filter(|curve| curve.hopf() <= gamma && gamma <= curve.symmetry_breaking());
    inside.count() as f64 / f64::from(SAMPLES + 1)
}
