//! The largest displacement of places of the structure, and its mean square: not sampled.
//!
//! In each panel the displacement lies between the coefficients of its quintic in Bernstein's form, with the remainder that is
//! proven: only where these exceed what is known is a panel divided, where its quintic is level, until nothing is left but a
//! part of [`PEAK_ERROR`]. Squares are integrated by the rule of Gauss and Legendre with [`NODES`] nodes, whose error in panels
//! of 0.8 rad is below `1e-13` of the squared amplitude.

use super::motion::{Gap, View};
use super::{All, Course, MOST, ModalObserver, ModalSegment};
use crate::numerics::gauss;
use crate::simulation::certificate::{Hull, Quintic};
use crate::simulation::path::StraightLine;
use crate::simulation::phasor::Slack;
use crate::system::{LinearResponse, ModalSystem};

/// Share of a peak by which it may be too small.
pub const PEAK_ERROR: f64 = 1e-13;
const NODES: usize = 7;
/// Most divisions of a panel: of what is level to rounding.
const MOST_PARTS: usize = 200;

/// What a place has done.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlaceMotion {
    /// Largest absolute displacement.
    pub peak: f64,
    /// Mean of the squared displacement over the time measured.
    pub mean_square: f64,
}

/// Measures the displacement `z + sum_k phi_k q_k` of places.
#[derive(Debug, Clone)]
pub struct ModalMeter {
    views: Vec<View<MOST>>,
    rule: Vec<(f64, f64)>,
    peaks: Vec<f64>,
    squares: Vec<f64>,
    time: f64,
}

impl ModalMeter {
    /// For places with these values of each mode; what a place has none of is 0.
    pub fn new(system: &ModalSystem, places: &[Vec<f64>]) -> Self {
        let all = All::of(system);
        let views = places.iter().map(|shape| {
            let shape = &shape[..shape.len().min(all.modes)];
            let base = LinearResponse { sine: all.base, cosine: 0.0 };
            let steady = shape.iter().zip(&all.steady).fold(base, |sum, (phi, [s, c])| {
                LinearResponse { sine: sum.sine + phi * s, cosine: sum.cosine + phi * c }
            });
            all.constants.view(shape, all.base, steady, 1.0)
        });
        Self {
            views: views.collect(),
            rule: gauss::uniform(NODES),
            peaks: vec![0.0; places.len()],
            squares: vec![0.0; places.len()],
            time: 0.0,
        }
    }

    /// What each place has done since the meter was made.
    pub fn places(&self) -> Vec<PlaceMotion> {
        let of = |(peak, square): (&f64, &f64)| PlaceMotion {
            peak: *peak,
            mean_square: if self.time > 0.0 { square / self.time } else { 0.0 },
        };
        self.peaks.iter().zip(&self.squares).map(of).collect()
    }
}

impl ModalObserver for ModalMeter {
    fn segment(&mut self, segment: &ModalSegment<'_>) {
        let panels = (segment.duration / segment.all.constants.step).ceil().max(1.0);
        let length = segment.duration / panels;
        for (at, view) in self.views.iter().enumerate() {
            let coefficient = segment.sixth(view, length);
            let mut here = segment.gap(view, 0.0);
            let mut peak = self.peaks[at].max(here.gap.abs());
            for n in 0..panels as u64 {
                let begin = n as f64 * length;
                let there = segment.gap(view, begin + length);
                let panel = (begin, here, begin + length, there);
                peak = segment.highest(view, panel, coefficient, peak);
                here = there;
                let square = |(node, weight): &(f64, f64)| {
                    let [x, ..] = segment.place(view, begin + 0.5 * length * (1.0 + node));
                    weight * x * x
                };
                self.squares[at] += length * self.rule.iter().map(square).sum::<f64>();
            }
            self.peaks[at] = peak;
        }
        self.time += segment.duration;
    }
}

impl ModalSegment<'_> {
    fn gap(&self, view: &View<MOST>, s: f64) -> Gap {
        Gap::of(self.place(view, s), StraightLine { y: 0.0, velocity: 0.0 })
    }

    /// `S/7200` of a panel.
    fn sixth(&self, view: &View<MOST>, length: f64) -> f64 {
        let cube = length * length * length;
        let bound = match &self.course {
            Course::Free(begin) => {
                let constants = &self.all.constants;
                constants.bound(view, &constants.sizes(begin), 6)
            }
            Course::Held(panel) => panel.bound(view, 6),
        };
        bound * cube * cube / 7200.0
    }

    /// The largest displacement in a panel, or the one known.
    fn highest(
        &self,
        view: &View<MOST>,
        panel: (f64, Gap, f64, Gap),
        coefficient: f64,
        mut peak: f64,
    ) -> f64 {
        let whole = panel.2 - panel.0;
        let mut open = vec![panel];
        for _ in 0..MOST_PARTS {
            let Some((begin, here, end, there)) = open.pop() else { break };
            peak = peak.max(there.gap.abs());
            let length = end - begin;
            let slack = Slack { coefficient, slope_squared: 0.0 }.part(length / whole);
            if Hull::of(&here, &there, length, &slack).highest() <= peak * (1.0 + PEAK_ERROR) {
                continue;
            }
            let turns = here.slope * there.slope < 0.0;
            let at = if turns {
                Quintic::through(&here, &there, length).turning_point().at
            } else {
                0.5
            };
            let middle = begin + at.clamp(0.01, 0.99) * length;
            let between = self.gap(view, middle);
            peak = peak.max(between.gap.abs());
            open.push((begin, here, middle, between));
            open.push((middle, between, end, there));
        }
        peak
    }
}
