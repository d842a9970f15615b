//! What the absorber takes in every regime over the oscillator's amplitude, and the response that follows.

use std::collections::BTreeMap;

use crate::dissipation::{AveragedFlow, PairBranch, PairPoint};
use crate::regimes::Regime;
use crate::study::{Averages, CaseStudy};

use super::{Line, window};

/// How what is drawn is known, and whether it is stable where that depends on the forcing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Look {
    /// The place of the regime in [`Regime::ALL`].
    regime: usize,
    /// How it is known.
    pub known: AverageSource,
    /// Whether the slow flow returns to it.
    pub stable: bool,
}

/// How an average is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum AverageSource {
    /// In closed form.
    ClosedForm,
    /// Of a motion that repeats.
    Repeating,
    /// Of one that does not: points, between which nothing is known.
    Scattered,
}

impl Look {
    /// The regime.
    pub fn regime(self) -> Regime {
        Regime::ALL[self.regime]
    }
}

/// Lines with gaps, of scattered averages points.
pub type Looks = BTreeMap<Look, Line>;

/// The dissipation curve and the frequency response of a case.
#[derive(Debug, Clone)]
pub struct Dissipation {
    /// The curve with the steady amplitudes.
    pub averages: Averages,
    /// `[C/b, S]` and `[C/b, K]`.
    pub forces: [Looks; 2],
    /// `[C/b, value - error]`, `[C/b, value + error]` of both, with gaps.
    pub errors: [Line; 2],
    /// `[frequency ratio, C/b]`.
    pub response: Looks,
    /// First and last frequency ratio.
    pub window: [f64; 2],
}

impl Dissipation {
    /// Of a case that asked for averages.
    pub(super) fn of(study: &CaseStudy) -> Option<Self> {
        let averages = study.averages.clone()?;
        let (mut forces, mut errors) = ([Looks::new(), Looks::new()], [Line::new(), Line::new()]);
        let mut response = Looks::new();
        let system = &study.analysis.system;
        let flow = AveragedFlow::of(system, &averages.curve);
        for branch in &averages.curve.branches {
            for k in 0..2 {
                let place = |point: &PairPoint| Some(([point.amplitude, point.forces()[k]], true));
                draw(branch, &place, &mut forces[k]);
                let scattered = branch.points.iter().filter(|point| point.repeats_after.is_none());
                errors[k].extend(scattered.flat_map(|point| {
                    let (c, value, error) = (point.amplitude, point.forces()[k], point.errors[k]);
                    [[c, value - error], [c, value + error], [f64::NAN; 2]]
                }));
                let ratio = |sigma: f64| 1.0 + system.mass_ratio() * sigma;
                let place = |point: &PairPoint| {
                    let (sigma, stable) = flow.stability(branch, point)?[k];
                    Some(([ratio(sigma), point.amplitude], stable))
                };
                draw(branch, &place, &mut response);
            }
        }
        Some(Self { averages, forces, errors, response, window: window(system) })
    }
}

/// Where a point lies, and whether it is stable there.
type CurvePlace<'a> = &'a dyn Fn(&PairPoint) -> Option<([f64; 2], bool)>;

/// What is drawn of a branch.
fn draw(branch: &PairBranch, place: CurvePlace, drawn: &mut Looks) {
    let known = |point: &PairPoint| match (branch.closed_form, point.repeats_after) {
        (true, _) => AverageSource::ClosedForm,
        (false, Some(_)) => AverageSource::Repeating,
        (false, None) => AverageSource::Scattered,
    };
    let mut before: Option<(Look, [f64; 2])> = None;
    for point in &branch.points {
        let at = place(point).map(|(at, stable)| {
            (Look { regime: point.regime.index(), known: known(point), stable }, at)
        });
        if let Some((look, at)) = at {
            let line = drawn.entry(look).or_default();
            match before.filter(|_| look.known != AverageSource::Scattered) {
                // A piece of which one end is unstable is drawn as the second.
                Some((last, from)) if last.known == look.known => {
                    if last.stable != look.stable || line.last() != Some(&from) {
                        line.extend([[f64::NAN; 2], from]);
                    }
                }
                _ => line.push([f64::NAN; 2]),
            }
            line.push(at);
        }
        before = at;
    }
}
