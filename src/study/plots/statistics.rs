//! Lyapunov exponents, and which starts lead to which motion.

use crate::regimes::basins::Basins;
use crate::regimes::starts::StartBox;
use crate::regimes::{Effort, Exponent, Transient};
use crate::study::scenes::exponents;
use crate::study::{CaseStudy, StudyError};
use crate::system::State;

use super::{MOTIONS, drawn, even};

/// Lyapunov exponents of a motion after longer and longer windows.
#[derive(Debug, Clone)]
pub struct MotionExponents {
    /// Which motion.
    pub index: usize,
    /// The exponents; never empty.
    pub exponents: Vec<Exponent>,
    /// Logarithm of the largest multiplier per period, where the motion is an exact orbit.
    pub exact: Option<f64>,
}

impl MotionExponents {
    /// Powers of two: from the shortest window that has an error to one in which the error of a chaotic
    /// motion has shrunk to some per cent.
    const WINDOWS: std::ops::RangeInclusive<u32> = 4..=13;

    pub(super) fn of(study: &CaseStudy) -> Result<Vec<Self>, StudyError> {
        let periods: Vec<u64> = Self::WINDOWS.map(|power| 1 << power).collect();
        let mut all = Vec::new();
        for index in 0..study.motions.attractors.len().min(MOTIONS) {
            let Some(found) = drawn(study, index) else { continue };
            let exponents = exponents(&study.analysis.system, found.attractor.state, &periods)?;
            let proof = study.motions.proofs[index].as_ref();
            let exact = proof.map(|proof| libm::log(proof.orbit.radius_per_period()));
            if !exponents.is_empty() {
                all.push(Self { index, exponents, exact });
            }
        }
        Ok(all)
    }
}

/// Enough to recognise the motion; in a shorter window a strongly modulated one may show no capture.
/// Ten impacts per period are recognised as that without going on.
const BASIN_EFFORT: Effort = Effort { discard: None, periods: 200, most_impacts: 10 };

/// Starts of the oscillator at excitation phase 0, the absorber at rest in the middle of its cavity.
#[derive(Debug, Clone)]
pub struct StartPlane {
    /// Largest displacement and velocity.
    pub reach: f64,
    /// Where they lead, row by row from the smallest velocity.
    pub basins: Basins,
    /// Excitation periods left out at least.
    pub transient: u64,
}

impl StartPlane {
    /// Starts along either axis: squares that are still seen one by one.
    const CELLS: u32 = 40;

    /// Where cells begin and end along either axis.
    pub fn edges(&self) -> impl Iterator<Item = f64> {
        even(-self.reach, self.reach, Self::CELLS)
    }

    pub(super) fn of(study: &CaseStudy) -> Result<Self, StudyError> {
        let system = &study.analysis.system;
        let reach = StartBox::around(system).reach;
        let cells = f64::from(Self::CELLS);
        let middle = |cell: u32| reach * (2.0 * (f64::from(cell) + 0.5) / cells - 1.0);
        let state = |k: u32| {
            let (x, x_velocity) = (middle(k % Self::CELLS), middle(k / Self::CELLS));
            State { x, x_velocity, y: x, y_velocity: 0.0 }
        };
        let states: Vec<State> = (0..Self::CELLS * Self::CELLS).map(state).collect();
        let known = study.motions.attractors.iter().map(|found| found.attractor.motion).collect();
        let basins = Basins::of(system, &states, known, &BASIN_EFFORT, &mut |_| {})?;
        Ok(Self { reach, basins, transient: Transient::of(system).periods })
    }
}
