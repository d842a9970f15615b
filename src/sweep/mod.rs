//! Many systems at once: a grid over clearance, frequency, amplitude and restitution, cut into chunks with
//! fixed numbers, so that any of them can be worked out anywhere and at any time, with the same bytes.

pub mod columns;
pub mod parquet;
pub mod row;

use std::ops::Range;

use serde::Serialize;
use sha2::{Digest, Sha256};

use crate::case::{Case, Scales, SweepAxis, SweepSettings};
use crate::system::{InvalidParameter, Parameter, System};

/// Points of a chunk: about a second's work, so that little is lost with one, and a file of some hundred
/// kilobytes, so that there are not too many of them.
pub const POINTS_PER_CHUNK: u64 = 1024;

/// What is worked out at every point, and how it is cut into chunks.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The case's own system.
    pub base: System,
    /// What turns its numbers into the case's units.
    pub scales: Scales,
    /// Axes, starts and periods.
    pub settings: SweepSettings,
    /// Names the results: of the case's text, the program and its version, and the size of a chunk.
    pub identity: String,
}

/// Where a point lies on an axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Coordinate {
    /// The axis.
    #[serde(skip)]
    pub parameter: Parameter,
    /// Its value, as in [`SweepAxis`].
    pub value: f64,
}

impl Plan {
    /// That of a case; `None` where it has no table `[sweep]`.
    pub fn of(case: &Case) -> Option<Self> {
        let settings = case.sweep.clone()?;
        let named = format!(
            "{} {} {POINTS_PER_CHUNK} {}",
            env!("CARGO_PKG_NAME"),
            env!("CARGO_PKG_VERSION"),
            case.text_hash
        );
        let digest = Sha256::digest(named.as_bytes());
        let identity = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        Some(Self { base: case.system(), scales: case.scales(), settings, identity })
    }

    /// Number of points: every combination of the axes' values.
    pub fn points(&self) -> u64 {
        self.settings.axes.iter().map(|axis| axis.values.len() as u64).product()
    }

    /// Number of chunks.
    pub fn chunks(&self) -> u64 {
        self.points().div_ceil(POINTS_PER_CHUNK)
    }

    /// The points of a chunk; empty beyond the last.
    pub fn chunk(&self, number: u64) -> Range<u64> {
        let begin = number.saturating_mul(POINTS_PER_CHUNK).min(self.points());
        begin..begin.saturating_add(POINTS_PER_CHUNK).min(self.points())
    }

    /// Where a point lies; the last axis varies fastest.
    pub fn coordinates(&self, point: u64) -> Vec<Coordinate> {
        let mut rest = point;
        let mut found: Vec<Coordinate> = self
            .settings
            .axes
            .iter()
            .rev()
            .map(|SweepAxis { parameter, values }| {
                let count = values.len() as u64;
                let value = values[(rest % count) as usize];
                rest /= count;
                Coordinate { parameter: *parameter, value }
            })
            .collect();
        found.reverse();
        found
    }

    /// The system of a point, and its clearance over the case's own.
    ///
    /// # Errors
    /// [`InvalidParameter`] where the values together leave no system.
    pub fn system(&self, point: u64) -> Result<(System, f64), InvalidParameter> {
        let (mut system, mut clearance) = (self.base, 1.0);
        for Coordinate { parameter, value } in self.coordinates(point) {
            system = parameter.applied(&system, value)?;
            if parameter == Parameter::Clearance {
                clearance = value;
            }
        }
        Ok((system, clearance))
    }
}
