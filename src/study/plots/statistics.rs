//! Lyapunov exponents, and which starts lead to which motion.

use crate::executor::Serial;
use crate::motions::starts::StartBox;
use crate::motions::{Effort, Motions, Place, SettlingTime, motions};
use crate::regimes::Exponent;
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
        for index in 0..study.motions.len().min(MOTIONS) {
            let Some((motion, _)) = drawn(study, index) else { continue };
            let exponents = exponents(&study.analysis.system, motion.state(), &periods)?;
            let exact = motion.largest_multiplier().map(libm::log);
            if !exponents.is_empty() {
                all.push(Self { index, exponents, exact });
            }
        }
        Ok(all)
    }
}

/// Enough to recognise the motion; in a shorter window a strongly modulated one may show no capture.
const PERIODS: u64 = 200;
/// Impacts per period that are recognised as many without going on.
const MOST_IMPACTS: u64 = 10;

/// Starts of the oscillator at excitation phase 0, the absorber at rest in the middle of its cavity.
#[derive(Debug, Clone)]
pub struct StartPlane {
    /// Largest displacement and velocity.
    pub reach: f64,
    /// Where they lead, row by row from the smallest velocity; those of the study among the motions.
    pub motions: Motions,
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
        let known = study.motions.iter().cloned().collect();
        let place = Place { known, ..Place::with(system, states) };
        let effort = Effort { most_impacts: MOST_IMPACTS, ..Effort::over(PERIODS) };
        let motions = motions(&[place], &effort, &Serial)?.pop().unwrap_or_default();
        Ok(Self { reach, motions, transient: SettlingTime::of(system).periods })
    }
}
