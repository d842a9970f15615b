//! Motions over time, simulated once more from their state at phase 0 (Figs. 4, 8 and 12).

use serde::Serialize;

use crate::analysis::ManifoldBranch;
use crate::case::Case;
use crate::motions::Measured;
use crate::regimes::Regime;
use crate::simulation::Trace;
use crate::study::scenes::{projected, projected_after, trace};
use crate::study::stretches::{Periods, SHORTEST_CAPTURE, TraceStretch, impulse};
use crate::study::{CaseStudy, StudyError};
use crate::system::System;

use super::{Line, drawn, first_drawn};

/// A motion in the plane of the manifold, `[B/b, C/b]`.
#[derive(Debug, Clone)]
pub struct Projection {
    /// Time in periods and place of every sample.
    pub path: Vec<(f64, [f64; 2])>,
    /// The same right after every impact.
    pub landed: Vec<(f64, [f64; 2])>,
}

impl Projection {
    fn of(system: &System, trace: &Trace) -> Self {
        let points = trace.points.iter();
        let impacts = trace.impacts.iter();
        Self {
            path: points.map(|at| (at.periods, projected(system, &at.state))).collect(),
            landed: impacts.map(|(at, impact)| (*at, projected_after(system, impact))).collect(),
        }
    }

    /// The path within a stretch, or all of it.
    pub fn line(&self, stretch: Option<TraceStretch>) -> Line {
        let inside = |at: f64| stretch.is_none_or(|stretch| stretch.holds(at));
        self.path.iter().filter(|(at, _)| inside(*at)).map(|(_, place)| *place).collect()
    }
}

/// Periods shown of a motion that repeats, at least.
const FEW: u64 = 6;
/// Periods shown of a motion that neither repeats nor is modulated much.
const SOME: u64 = 12;
/// The same for one with fewer than two impacts per period, which come irregularly.
const RARE: u64 = 30;
/// Periods shown of a modulated motion: several modulations.
const MANY: u64 = 70;
/// Modulation below this is not what there is to see.
const MODULATED: f64 = 0.1;
/// About so many impacts can be told apart.
const IMPACTS: f64 = 400.0;

/// Some periods of a motion.
#[derive(Debug, Clone)]
pub struct MotionTrace {
    /// Which one.
    pub index: usize,
    /// Excitation periods.
    pub periods: u64,
    /// Over time.
    pub trace: Trace,
    /// On the manifold.
    pub projection: Projection,
}

impl MotionTrace {
    pub(super) fn of(study: &CaseStudy, index: usize) -> Result<Option<Self>, StudyError> {
        let Some((motion, measured)) = drawn(study, index) else { return Ok(None) };
        let system = &study.analysis.system;
        let periods = shown_periods(measured);
        let density = if periods > RARE { 24.0 } else { 60.0 };
        let trace = trace(system, motion.state(), periods, density)?;
        let projection = Projection::of(system, &trace);
        Ok(Some(Self { index, periods, trace, projection }))
    }
}

/// So many that the pattern is seen, and no more impacts than can be told apart.
fn shown_periods(measured: &Measured) -> u64 {
    let evidence = &measured.classification.evidence;
    let wanted = match evidence.periodicity {
        Some(repetition) => FEW.max(2 * u64::from(repetition.periods)).min(MANY),
        None if evidence.modulation_depth > MODULATED => MANY,
        None if measured.regime() == Regime::BelowTwo => RARE,
        None => SOME,
    };
    let most = (IMPACTS / evidence.impacts_per_period.max(0.1)).max(1.0);
    wanted.min(most as u64)
}

/// A motion that is captured in 1:1 resonance and escapes, on the manifold.
#[derive(Debug, Clone)]
pub struct Modulation {
    /// The whole motion.
    pub projection: Projection,
    /// Its captures.
    pub captures: Vec<TraceStretch>,
    /// How far from the stable branch it is while captured, relative in `C` (rms); the first periods of each
    /// capture are left out.
    pub away: Option<f64>,
    /// The way into the longest capture, and the stay in it.
    pub enlarged: [TraceStretch; 2],
}

impl Modulation {
    /// Periods followed: a dozen captures of a strongly modulated response.
    pub const PERIODS: u64 = 150;
    /// Periods at the beginning of a capture that belong to the transition.
    pub const TRANSITION: usize = 3;

    /// Of a case's first motion; none where no capture has a transition before it.
    ///
    /// # Errors
    /// As the simulation.
    pub fn of(study: &CaseStudy) -> Result<Option<Self>, StudyError> {
        let Some((motion, _)) = first_drawn(study) else { return Ok(None) };
        let system = &study.analysis.system;
        // Between impacts only C changes, and slowly.
        let trace = trace(system, motion.state(), Self::PERIODS, 4.0)?;
        let captures = Periods::of(&trace).captures();
        let before = Self::TRANSITION;
        let arrival = |capture: &&TraceStretch| capture.first >= before;
        let longest = captures.iter().filter(arrival).max_by_key(|capture| capture.periods);
        let Some(&TraceStretch { first, periods }) = longest else { return Ok(None) };
        let skipped = before.min(periods - 1);
        let enlarged = [
            TraceStretch { first: first - before, periods: 2 * before.min(periods) },
            TraceStretch { first: first + skipped, periods: periods - skipped },
        ];
        let projection = Projection::of(system, &trace);
        let away = away(study, &projection, &captures);
        Ok(Some(Self { projection, captures, away, enlarged }))
    }
}

fn away(study: &CaseStudy, projection: &Projection, captures: &[TraceStretch]) -> Option<f64> {
    let manifold = &study.analysis.manifold;
    let settled = |at: f64| {
        captures.iter().any(|capture| {
            (capture.first + Modulation::TRANSITION) as f64 <= at && at <= capture.end() as f64
        })
    };
    let on_branch = |absorber: f64, at: f64| {
        settled(at) && manifold.branch(absorber - 1.0) == ManifoldBranch::Stable
    };
    let squares: Vec<f64> = projection
        .landed
        .iter()
        .filter(|(at, [absorber, _])| on_branch(*absorber, *at))
        .map(|(_, [absorber, oscillator])| {
            let relative = oscillator / manifold.point(absorber - 1.0).oscillator_amplitude - 1.0;
            relative * relative
        })
        .collect();
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    (!squares.is_empty()).then(|| mean.sqrt())
}

/// A long motion, and the window of it that is shown.
#[derive(Debug, Clone)]
pub struct Transfer {
    /// All that was searched.
    pub trace: Trace,
    /// What its periods look like.
    pub periods: Periods,
    /// What is shown.
    pub window: TraceStretch,
    /// (d) captured, and yet the amplitude grows; (e) captured, and it falls most; (f) fewest impacts, and it
    /// grows.
    pub parts: [Option<Part>; 3],
}

/// A short stretch and what it shows.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Part {
    /// Where it is.
    #[serde(flatten)]
    pub stretch: TraceStretch,
    /// Last peak over the first one, less 1.
    pub change: f64,
    /// Impacts in it.
    pub impacts: usize,
    /// Their mean impulse over `m1 omega0 b`; 0 without impacts.
    pub impulse: f64,
}

impl Transfer {
    /// Periods that are searched.
    pub const PERIODS: u64 = 400;
    /// Periods of a short stretch.
    pub const SHORT: usize = 5;
    /// Seconds shown, as in the paper; a reduced case shows so many periods.
    const SECONDS: f64 = 5.0;
    const REDUCED: usize = 42;

    /// Of a case's first motion; none where nobody could tell its impacts apart.
    ///
    /// # Errors
    /// As the simulation.
    pub fn of(case: &Case, study: &CaseStudy) -> Result<Option<Self>, StudyError> {
        let Some((motion, _)) = first_drawn(study) else { return Ok(None) };
        let system = &study.analysis.system;
        let trace = trace(system, motion.state(), Self::PERIODS, 24.0)?;
        if trace.impacts.len() as u64 > 8 * Self::PERIODS {
            return Ok(None);
        }
        let periods = Periods::of(&trace);
        let units = case.units();
        let length = match units.physical {
            true => ((Self::SECONDS / units.time(system.period())) as usize).clamp(1, 200),
            false => Self::REDUCED,
        };
        let window = periods.typical(length);
        let mut transfer = Self { trace, periods, window, parts: [None; 3] };
        transfer.parts = transfer.parts(system.mass_ratio());
        Ok(Some(transfer))
    }

    /// In the window that is shown as a whole, or else in the whole motion that was searched.
    fn parts(&self, mass_ratio: f64) -> [Option<Part>; 3] {
        let all = TraceStretch { first: 0, periods: self.periods.count() };
        let periods = &self.periods;
        let weak = |outer| {
            (SHORTEST_CAPTURE..=Self::SHORT).rev().find_map(|length| periods.weak(outer, length))
        };
        let pick = |choose: &dyn Fn(TraceStretch) -> Option<TraceStretch>| {
            let stretch = choose(self.window).or_else(|| choose(all))?;
            let inside = self.trace.impacts.iter().filter(|(at, _)| stretch.holds(*at));
            let strengths: Vec<f64> =
                inside.map(|(_, impact)| impulse(mass_ratio, impact)).collect();
            Some(Part {
                stretch,
                change: periods.growth(stretch) - 1.0,
                impacts: strengths.len(),
                impulse: strengths.iter().sum::<f64>() / strengths.len().max(1) as f64,
            })
        };
        [
            pick(&weak),
            pick(&|outer| periods.decrease(outer, Self::SHORT)),
            pick(&|outer| periods.sparse(outer, Self::SHORT)),
        ]
    }
}
