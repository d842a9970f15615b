//! What a survey says of each criterion.

use super::found::{self, Findings, Found};
use super::{Judged, Outcome, ROUNDING, method, of_stability};
use crate::band::{Survey, theory};
use crate::case::{Criterion, Of};
use crate::measure::Measure;
use crate::method::Method;
use crate::motions::{Fact, Motion, MotionKind, WhyNot};
use crate::quantity::Units;
use crate::validation::tolerance::asymptotic_error;

/// Places of a band at which the theory's own error is asked for.
const PLACES: u32 = 25;

/// A survey and the units of its case.
pub(super) struct Scope<'a> {
    pub(super) survey: &'a Survey,
    pub(super) units: Units,
}

impl Scope<'_> {
    /// Judges one criterion.
    pub(super) fn judge(&self, criterion: &Criterion) -> Judged {
        let motions = &self.survey.motions;
        match criterion.measure {
            Measure::Z3Share => self.z3_share(criterion),
            Measure::StableShare => {
                // All and nothing have no end that could be off.
                let ends = motions.stability().len() > 1;
                let error = if ends { ROUNDING } else { 0.0 };
                let share = motions.stable_share();
                criterion.judged(Some(share), error, of_stability(motions))
            }
            Measure::MarginClearance => {
                let (at, found) = self.survey.smallest_gap();
                let judged = criterion.judged(Some(found), ROUNDING, Method::ExactOrbit);
                Judged { at: self.place(at), ..judged }
            }
            // Where nothing was simulated, nothing is known of motions.
            _ if !motions.simulated() => criterion.judged(None, 0.0, Method::Simulation),
            Measure::NoCoexistence => found::one_motion(self, criterion),
            _ => found::worst(self, criterion),
        }
    }

    /// A place, where the range has more than one.
    fn place(&self, at: f64) -> Option<f64> {
        (!self.survey.band().is_point()).then_some(at)
    }

    /// The share in Z3, with what the theory's own error in the boundaries makes of it.
    fn z3_share(&self, criterion: &Criterion) -> Judged {
        let band = self.survey.band();
        let share = |factor: f64| {
            let base = band.base.with_clearance_scaled(factor).unwrap_or(band.base);
            let band = band.with_base(base);
            theory::z3_share(&band)
        };
        let found = self.survey.z3_share();
        let error = band
            .places(PLACES)
            .filter_map(|at| band.system(at).ok())
            .map(|system| asymptotic_error(&system))
            .fold(0.0, f64::max);
        let shifted = [1.0 - error.min(0.9), 1.0 + error].map(share);
        let off = shifted.map(|other| (other - found).abs()).into_iter().fold(ROUNDING, f64::max);
        criterion.judged(Some(found), off, Method::Theory)
    }

    /// Places with a motion that only a window shows and which does not hold with its error or still settles, by the room
    /// that it leaves.
    pub(super) fn open(&self, criterion: &Criterion) -> Vec<f64> {
        let counting = self.survey.motions.counting(self.survey.count_rest);
        let open = counting.filter(|one| is_open(one.2)).filter_map(|one| {
            let found = self.of(criterion, one);
            let room = found.map(|found| criterion.room(found.value));
            let judged =
                found.map(|one| criterion.judged(Some(one.value), one.error, one.known_by));
            let open = !one.2.settled() || judged.is_some_and(|of| of.holds == Some(false));
            open.then_some((one.0, room.unwrap_or(f64::NEG_INFINITY)))
        });
        let mut open: Vec<(f64, f64)> = open.collect();
        open.sort_by(|a, b| a.1.total_cmp(&b.1));
        open.into_iter().map(|one| one.0).collect()
    }

    /// Whether a criterion fails for good: by what was solved for, or at one of these places, which were searched in full.
    pub(super) fn fails_for_good(&self, judged: &Judged, known: &[f64]) -> bool {
        let at = judged.at.unwrap_or_else(|| self.survey.band().own());
        let motions = self.survey.motions.at(at);
        let motion = motions.zip(judged.motion).and_then(|(here, number)| here.iter().nth(number));
        let open = motion.is_some_and(is_open) && !known.contains(&at);
        judged.outcome() == Outcome::Fails && !open
    }

    /// What a motion has of a criterion with the error that is its own, whatever lies between places.
    fn own(&self, criterion: &Criterion, motion: &Motion) -> Option<[f64; 2]> {
        let number = |fact: Fact| fact.of(motion);
        criterion.measure.of_motion(motion, &number, self.against(criterion), &self.units)
    }

    /// The amplitude that a criterion compares with.
    fn against(&self, criterion: &Criterion) -> f64 {
        let Self { survey, .. } = self;
        criterion.measure.compared_with(|| survey.bare().1, || survey.least_moved())
    }

    fn of(&self, criterion: &Criterion, (at, index, motion): Placed<'_>) -> Option<Found> {
        let number = |fact| self.survey.motions.value_of(motion, fact);
        let against = self.against(criterion);
        let [value, error] = criterion.measure.of_motion(motion, &number, against, &self.units)?;
        Some(Found {
            value,
            error,
            own: self.own(criterion, motion).map_or(error, |own| own[1]),
            load: 0,
            at: self.place(at),
            of: Of::Any,
            motion: index,
            known_by: method(motion),
            settled: motion.settled(),
            followed: motion.reached().followed,
            resting: std::array::from_fn(|j| j == 0 && motion.rest().is_some()),
            rest: motion.rest().map(|rest| rest.share),
        })
    }
}

/// A motion with its place and its number in the list there.
type Placed<'a> = (f64, usize, &'a Motion);

impl Findings for Scope<'_> {
    fn each(&self, asked: &Criterion) -> Vec<Found> {
        let counting = self.survey.motions.counting(self.survey.count_rest);
        counting.filter_map(|one| self.of(asked, one)).collect()
    }

    fn too_few(&self, asked: &Criterion) -> Vec<Found> {
        let places = self.survey.motions.places().iter();
        let each = places.flat_map(|(at, here)| here.iter().map(move |one| (*at, 0, one)));
        let why_not = |one: &Motion| one.why_not(self.survey.count_rest);
        let few = each.filter(|one| why_not(one.2) == Some(WhyNot::BelowThreshold));
        few.filter_map(|one| self.of(asked, one)).collect()
    }
}

/// Whether a motion is known by a window alone.
fn is_open(motion: &Motion) -> bool {
    !motion.settled() || matches!(motion.kind(), MotionKind::Wanders)
}

impl Judged {
    /// The same where a motion still settles after so many periods that could decide otherwise.
    pub(super) fn or_undecided(self, undecided: Option<u64>) -> Self {
        let holds = if undecided.is_some() { Some(false) } else { self.holds };
        Self { undecided, holds, near_limit: self.near_limit && undecided.is_none(), ..self }
    }
}
