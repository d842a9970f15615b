//! How far the case is from the boundaries of its regime: by theory in clearance, and exactly in clearance,
//! forcing and frequency.

use crate::analysis::Analysis;
use crate::orbits::SpecialPoint;
use crate::orbits::{BestClearance, Bifurcation, FullSystem};
use crate::validation::clearances::{BoundaryAt, clearances};

/// The boundaries around a case.
#[derive(Debug, Clone, PartialEq)]
pub struct Margins {
    /// All of the theory, by ascending clearance.
    pub clearance: Vec<BoundaryAt>,
    /// Exactly, where an attracting symmetric orbit exists.
    pub exact: Option<ExactMargins>,
    /// Where the attracting symmetric orbit vibrates least, exactly.
    pub best_clearance: Option<BestClearance>,
}

impl Margins {
    /// Margins of an analysed system.
    pub fn of(analysis: &Analysis, exact: &FullSystem) -> Self {
        Self {
            clearance: clearances(analysis),
            exact: ExactMargins::of(exact),
            best_clearance: exact.best_clearance(),
        }
    }
}

/// A limit of the attracting exact orbit and where it is met when one parameter alone is changed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExactMargin {
    /// What happens there.
    pub kind: Bifurcation,
    /// The parameter's value there over its value in the case.
    pub factor: f64,
}

/// How far the attracting 1:1 orbit of the case persists, exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExactMargins {
    /// Below and above in clearance.
    pub clearance: [Option<ExactMargin>; 2],
    /// Below and above in forcing. As `gamma = G/b`, in an ideal cavity they are the reciprocals, the other way round;
    /// gravity and friction do not scale with the forcing, and they are found by continuation.
    pub forcing: [Option<ExactMargin>; 2],
    /// Below and above in frequency, by continuation.
    pub frequency: [Option<ExactMargin>; 2],
    /// As the cavity alone is tilted either way, by continuation.
    pub tilt: [Option<CavityLimit>; 2],
    /// As friction alone grows, by continuation.
    pub friction: Option<CavityLimit>,
}

/// A limit of the attracting exact orbit in tilt or friction of the cavity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CavityLimit {
    /// What happens there.
    pub kind: Bifurcation,
    /// Gravity along the cavity, or friction's acceleration, over `b omega0^2`.
    pub acceleration: f64,
}

impl CavityLimit {
    fn at(limit: SpecialPoint) -> Self {
        Self { kind: limit.kind, acceleration: limit.value }
    }
}

impl ExactMargins {
    fn of(exact: &FullSystem) -> Option<Self> {
        let stretch = exact.stretch()?;
        let at = |k: usize| {
            stretch.ends[k].map(|kind| ExactMargin { kind, factor: stretch.clearance[k] })
        };
        let over = |own: f64| {
            move |limit: Option<SpecialPoint>| {
                limit.map(|special| ExactMargin { kind: special.kind, factor: special.value / own })
            }
        };
        let clearance = [at(0), at(1)];
        let inverse = |margin: ExactMargin| ExactMargin { factor: 1.0 / margin.factor, ..margin };
        let forcing = if exact.system.cavity().is_ideal() {
            [clearance[1].map(inverse), clearance[0].map(inverse)]
        } else {
            exact.forcing_limits().map(over(1.0))
        };
        let frequency = exact.frequency_limits().map(over(exact.system.frequency_ratio()));
        let tilt = exact.tilt_limits().map(|end| end.map(CavityLimit::at));
        let friction = exact.friction_limit().map(CavityLimit::at);
        Some(Self { clearance, forcing, frequency, tilt, friction })
    }
}
