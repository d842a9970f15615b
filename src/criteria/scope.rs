//! What a survey says of each criterion.

use super::{Judged, Outcome, ROUNDING, method, of_stability};
use crate::band::{Survey, theory};
use crate::case::Criterion;
use crate::measure::{Device, Measure};
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
            Measure::NoCoexistence => self.one_motion(criterion),
            _ => self.worst(criterion),
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

    /// 1 where every place has one motion, 0 where one has several.
    fn one_motion(&self, criterion: &Criterion) -> Judged {
        let count_rest = self.survey.count_rest;
        let places = self.survey.motions.places();
        let several = |settled: bool| {
            places.iter().find(|(_, here)| {
                let counting = here.counting(count_rest);
                counting.filter(|(_, one)| one.settled() || !settled).count() > 1
            })
        };
        let (certain, any) = (several(true), several(false));
        let Some((at, here)) = certain.or(any) else {
            return criterion.judged(Some(1.0), 0.0, Method::Simulation);
        };
        let open = here.iter().filter(|one| !one.settled()).map(|one| one.reached().followed).max();
        let rest = here.counting(count_rest).find_map(|(_, one)| Some(one.rest()?.share));
        let judged = criterion.judged(Some(0.0), 0.0, Method::Simulation);
        let undecided = open.filter(|_| certain.is_none());
        Judged { at: self.place(*at), inactive: rest, ..judged }.or_undecided(undecided)
    }

    /// The worst value of a criterion about motions, of equal ones that which is known best; its error covers all others with theirs.
    fn worst(&self, criterion: &Criterion) -> Judged {
        let counting = self.survey.motions.counting(self.survey.count_rest);
        let all: Vec<(Judged, &Motion)> =
            counting.filter_map(|one| self.of(criterion, one)).collect();
        let room = |one: &Judged| one.margin.unwrap_or(f64::INFINITY);
        let nearest = |settled: bool| {
            let of = all.iter().filter(|(_, motion)| motion.settled() || !settled);
            of.min_by(|a, b| {
                let [a, b] =
                    [&a.0, &b.0].map(|one| (room(one), one.decided_by == Method::Simulation));
                let alike = (a.0 - b.0).abs() <= ROUNDING * criterion.limit.abs();
                if alike { a.1.cmp(&b.1) } else { a.0.total_cmp(&b.0) }
            })
        };
        let Some((worst, _)) = nearest(false) else {
            return criterion.judged(None, 0.0, Method::Simulation);
        };
        let least = all.iter().map(|(one, _)| room(one) - one.error).fold(f64::INFINITY, f64::min);
        let Judged { at, motion, inactive, .. } = *worst;
        let judged = criterion.judged(worst.found, room(worst) - least, worst.decided_by);
        // What has settled may fail it, whatever else there is; what lies elsewhere, or between places, can only be worse.
        let fails = nearest(true).is_some_and(|(one, _)| room(one) < 0.0);
        let misses = |(one, motion): &(Judged, &Motion)| {
            let own = self.own(criterion, motion).map_or(one.error, |own| own[1]);
            motion.settled() && room(one) < 0.0 && !criterion.is_open(room(one), own, 0)
        };
        let near_limit = judged.near_limit && !all.iter().any(misses);
        let but_at_rest = judged.holds.filter(|holds| *holds).and_then(|_| self.too_few(criterion));
        let open = all.iter().filter(|(_, motion)| !motion.settled());
        let undecided = open.map(|(_, motion)| motion.reached().followed).max().filter(|_| !fails);
        Judged { at, motion, inactive, but_at_rest, near_limit, ..judged }.or_undecided(undecided)
    }

    /// The largest share of resting places of an absorber at rest with which a criterion would not hold, of those that are too
    /// few to count.
    fn too_few(&self, criterion: &Criterion) -> Option<f64> {
        let places = self.survey.motions.places().iter();
        let each = places.flat_map(|(at, here)| here.iter().map(move |one| (*at, 0, one)));
        let few = each
            .filter(|one| one.2.why_not(self.survey.count_rest) == Some(WhyNot::BelowThreshold));
        let fails = few.filter(|one| {
            self.of(criterion, *one).is_some_and(|judged| judged.0.holds == Some(false))
        });
        fails.filter_map(|one| Some(one.2.rest()?.share)).max_by(f64::total_cmp)
    }

    /// Places with a motion that only a window shows and which does not hold with its error or still settles, by the room
    /// that it leaves.
    pub(super) fn open(&self, criterion: &Criterion) -> Vec<f64> {
        let counting = self.survey.motions.counting(self.survey.count_rest);
        let open = counting.filter(|one| is_open(one.2)).filter_map(|one| {
            let judged = self.of(criterion, one).map(|of| of.0);
            let room = judged.as_ref().and_then(|of| of.margin);
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
        match criterion.measure.against() {
            Some(Device::Without) => self.survey.bare().1,
            Some(Device::Damper) => self.survey.rivals().damped.amplitude,
            _ => f64::NAN,
        }
    }

    fn of<'m>(
        &self,
        criterion: &Criterion,
        (at, index, motion): (f64, usize, &'m Motion),
    ) -> Option<(Judged, &'m Motion)> {
        let number = |fact| self.survey.motions.value_of(motion, fact);
        let against = self.against(criterion);
        let [found, error] = criterion.measure.of_motion(motion, &number, against, &self.units)?;
        let judged = criterion.judged(Some(found), error, method(motion));
        let inactive = motion.rest().map(|rest| rest.share);
        Some((Judged { at: self.place(at), motion: Some(index), inactive, ..judged }, motion))
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
