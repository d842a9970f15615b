//! What is read of a sweep through resonance: the largest displacement in each period of the excitation.

use crate::excitation::SweepStretch;
use crate::system::Shaking;

/// What a structure did on its way through a range of frequencies.
#[derive(Debug, Clone, PartialEq)]
pub struct Passage {
    /// Of each period of the excitation its frequency ratio and the structure's largest displacement in it.
    pub envelope: Vec<[f64; 2]>,
    /// Impacts.
    pub impacts: u64,
    /// Largest relative speed of one of them, over the clearance in fast time.
    pub impact_speed: f64,
    /// Largest part of a period's energy that its balance leaves open: rounding.
    pub residual: f64,
    /// Largest displacement of absorber or damper against the structure.
    pub stroke: f64,
    /// Velocity and acceleration of the structure over all of it; none where they were not asked for.
    pub shaking: Option<Shaking>,
}

impl Passage {
    /// Nothing yet, of so many periods.
    pub fn new(count: u64, stroke: f64) -> Self {
        let envelope = Vec::with_capacity(count as usize);
        Self { envelope, impacts: 0, impact_speed: 0.0, residual: 0.0, stroke, shaking: None }
    }

    /// Frequency ratio and size of the largest displacement.
    pub fn peak(&self) -> [f64; 2] {
        let larger = |a: [f64; 2], b: &[f64; 2]| if b[1] > a[1] { *b } else { a };
        self.envelope.iter().fold([f64::NAN, 0.0], larger)
    }

    /// The largest displacement of a stretch.
    pub fn passed(&mut self, stretch: &SweepStretch, peak: f64) {
        match self.envelope.last_mut() {
            Some(last) if !stretch.first => last[1] = last[1].max(peak),
            _ => self.envelope.push([stretch.of_period, peak]),
        }
    }
}
