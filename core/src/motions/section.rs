//! What a second look at motions tells: where they stand at the ends of excitation periods, and how fast neighbours part.

use super::Motion;
use crate::regimes::Lyapunov;
use crate::simulation::{Detail, Observer, Simulation, StartError, batch};
use crate::system::{State, System};

/// Impacts per period at which a look is given up.
const MOST_IMPACTS: u64 = 1000;

/// A stroboscopic section of a motion and its exponent.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Section {
    /// Displacements of the oscillator over the clearance at the ends of successive excitation periods.
    pub displacements: Vec<f64>,
    /// Largest Lyapunov exponent per excitation period over so many periods as were asked for; none where nobody asked, or it
    /// cannot be told.
    pub exponent: Option<f64>,
}

impl Observer for Section {
    fn detail(&self) -> Detail {
        Detail::Events
    }
    fn period(&mut self, state: &State) {
        self.displacements.push(state.x);
    }
}

/// Sections of `length` periods of motions, side by side, and their exponents over `periods` after that.
///
/// # Errors
/// [`StartError`] where a state is not finite.
pub fn sections(
    motions: &[(System, &Motion)],
    length: u64,
    periods: Option<u64>,
) -> Result<Vec<Section>, StartError> {
    let begin = |(system, motion): &(System, &Motion)| Simulation::new(system, motion.state, 0.0);
    let mut simulations: Vec<Simulation> = motions.iter().map(begin).collect::<Result<_, _>>()?;
    let mut sections = vec![Section::default(); motions.len()];
    batch::run(&mut simulations, length, length * MOST_IMPACTS, &mut sections);
    if let Some(periods) = periods {
        let mut exponents: Vec<Lyapunov> =
            simulations.iter().map(|one| Lyapunov::begin(one.system())).collect();
        batch::run(&mut simulations, periods, periods * MOST_IMPACTS, &mut exponents);
        for (one, exponent) in sections.iter_mut().zip(exponents) {
            one.exponent = exponent.exponent().map(|found| found.per_period);
        }
    }
    Ok(sections)
}
