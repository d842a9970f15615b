//! The motion itself over time, sampled for a figure, with every impact.

use std::f64::consts::TAU;

use super::motion::View;
use super::{All, MOST, ModalImpact, ModalObserver, ModalSegment};
use crate::simulation::Detail;
use crate::system::ModalSystem;

/// Samples a motion evenly in time, and at both ends of every stretch without events, so that corners at impacts are kept.
#[derive(Debug, Clone)]
pub struct ModalTrace {
    samples_per_period: f64,
    /// How each place sees the motion, over no length.
    views: Vec<View<MOST>>,
    /// Times of the samples in excitation periods since the start of the run, ascending; the same twice at an impact.
    pub periods: Vec<f64>,
    /// Displacement of each place at these times, in lengths of the structure.
    pub places: Vec<Vec<f64>>,
    /// Relative displacement `X_j - y_j` of each absorber at these times, in lengths of the structure: at most its clearance.
    pub gaps: Vec<Vec<f64>>,
    /// Every impact, in order of time.
    pub impacts: Vec<ModalImpact>,
}

impl ModalTrace {
    /// An empty trace of a structure and of places with these shapes, the value of each mode there, with so many samples in an excitation
    /// period: none, and impacts alone, of 0.
    pub fn new(system: &ModalSystem, shapes: &[Vec<f64>], samples_per_period: f64) -> Self {
        let all = All::of(system);
        Self {
            samples_per_period,
            views: shapes.iter().map(|shape| all.view(shape, 0, 1.0)).collect(),
            periods: Vec::new(),
            places: vec![Vec::new(); shapes.len()],
            gaps: vec![Vec::new(); all.absorbers],
            impacts: Vec::new(),
        }
    }
}

impl ModalObserver for ModalTrace {
    fn detail(&self) -> Detail {
        if self.samples_per_period > 0.0 { Detail::Flights } else { Detail::Events }
    }

    fn segment(&mut self, segment: &ModalSegment<'_>) {
        let begin = segment.turns as f64 + segment.phase / TAU;
        let length = segment.duration * segment.all.constants.frequency / TAU;
        let pieces = (length * self.samples_per_period).ceil().max(1.0);
        for k in 0..=pieces as u64 {
            let part = k as f64 / pieces;
            let s = part * segment.duration;
            self.periods.push(begin + part * length);
            for (view, place) in self.views.iter().zip(&mut self.places) {
                place.push(segment.place(view, s)[0]);
            }
            for (j, gaps) in self.gaps.iter_mut().enumerate() {
                gaps.push(segment.gap(j, s));
            }
        }
    }

    fn impact(&mut self, impact: &ModalImpact) {
        self.impacts.push(*impact);
    }
}
