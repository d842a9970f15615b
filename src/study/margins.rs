//! How far the case is from the boundaries of its regime: by theory in clearance, and exactly in clearance,
//! forcing and frequency.

use crate::analysis::Analysis;
use crate::orbits::{BestClearance, Bifurcation, FullSystem};
use crate::validation::boundaries::{BoundaryAt, clearances};

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

/// How far the attracting symmetric orbit of the case persists, exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExactMargins {
    /// Below and above in clearance; in forcing they are the reciprocals, the other way round.
    pub clearance: [Option<ExactMargin>; 2],
    /// Below and above in frequency, by continuation.
    pub frequency: [Option<ExactMargin>; 2],
}

impl ExactMargins {
    fn of(exact: &FullSystem) -> Option<Self> {
        let stretch = exact.stretch()?;
        let at = |k: usize| {
            stretch.ends[k].map(|kind| ExactMargin { kind, factor: stretch.clearance[k] })
        };
        let own = exact.system.frequency_ratio();
        let frequency = exact.frequency_limits().map(|limit| {
            limit.map(|special| ExactMargin { kind: special.kind, factor: special.value / own })
        });
        Some(Self { clearance: [at(0), at(1)], frequency })
    }

    /// Below and above in forcing: `gamma = G / b`, so a limit at `k` times the clearance is met at
    /// `1/k` times the forcing.
    pub fn forcing(&self) -> [Option<ExactMargin>; 2] {
        let inverse = |margin: ExactMargin| ExactMargin { factor: 1.0 / margin.factor, ..margin };
        let [below, above] = self.clearance;
        [above.map(inverse), below.map(inverse)]
    }
}
