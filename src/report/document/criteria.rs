//! Judged criteria as data, for `check`, the report, the index and an optimisation.

use serde_json::{Value, json};

use super::scale::Scale;
use super::word::Word;
use crate::case::{Case, Criterion, Relation};
use crate::criteria::{Found, Judged, Outcome, Worst, together};
use crate::measure::{Device, Measure};
use crate::method::Method;
use crate::motions::Motions;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::transient::Sample;

/// From which places of the absorber numbers are known: even ones, all, and the share of places that are worse than the
/// worst of them, at most, at odds of 19 to 1.
pub fn sample(of: Sample) -> Value {
    json!({ "even": of.even, "all": of.all, "share_above": of.share_above() })
}

/// What all criteria together came to; none where the case asks for nothing.
pub fn badge(judged: &[Judged]) -> Option<Word> {
    together(judged).map(|worst| match worst {
        Outcome::Fails | Outcome::NotMeasured => Word::Fails,
        Outcome::NotDecided => Word::NotDecided,
        Outcome::TooCloseToCall => Word::TooCloseToCall,
        Outcome::Holds => Word::Holds,
    })
}

/// All criteria of a case, one for each line of `[criteria]`; none where the case asks for nothing.
pub fn criteria(case: &Case, judged: &[Judged]) -> Option<Value> {
    let rows = judged.iter().map(|one| criterion(case, one)).collect();
    counted(judged, rows).map(|mut counted| {
        counted["count_inactive"] = json!(case.count_inactive);
        let time = case.contact_time();
        counted["contact_time"] =
            json!(time.map(|time| Quantity::new(&of::CONTACT_TIME, time, Method::Given)));
        counted
    })
}

/// Criteria with their rows; none where there are none.
pub fn counted(judged: &[Judged], rows: Vec<Value>) -> Option<Value> {
    let count = |of: Outcome| judged.iter().filter(|one| one.outcome() == of).count();
    badge(judged).map(|badge| {
        json!({
            "badge": badge,
            "count": judged.len(),
            "holding": judged.iter().filter(|one| one.holds == Some(true)).count(),
            "failing": count(Outcome::Fails) + count(Outcome::NotMeasured),
            "undecided": count(Outcome::NotDecided),
            // Those that hold, and those that an error alone keeps from it.
            "too_close": count(Outcome::TooCloseToCall),
            "count_inactive": true,
            "contact_time": null,
            // Where absorbers differ in it.
            "longest_contact_time": null,
            "all": rows,
        })
    })
}

/// Where along the band a criterion is worst, if that says anything.
pub fn place(case: &Case, judged: &Judged) -> Option<Quantity> {
    let (at, band) = judged.at.zip(case.band.as_ref())?;
    Some(Scale::of(case).place(band.over, at))
}

/// A judged criterion.
pub fn criterion(case: &Case, judged: &Judged) -> Value {
    row(judged, place(case, judged))
}

/// The same, worst at a place.
pub fn row(judged: &Judged, at: Option<Quantity>) -> Value {
    let Criterion { key, measure, relation, limit, as_written, .. } = &judged.criterion;
    let kind = measure.kind(Device::Absorber);
    let quantity = |value: f64| kind.map(|kind| Quantity::new(kind, value, judged.decided_by));
    // The errors of shares and margins are rounding, or theory's own.
    let error = if measure.is_of_motions() { judged.error } else { 0.0 };
    let counted = *measure == Measure::ImpactsPerPeriod;
    let share = |share| Quantity::new(&of::INACTIVE_SHARE, share, Method::ClosedForm);
    json!({
        "name": key,
        "asked": as_written,
        "relation": match (kind, relation) {
            (None, _) => "yes",
            (_, Relation::AtLeast) => "at-least",
            (_, Relation::AtMost) => "at-most",
            (_, Relation::Equal) => "equal",
        },
        "limit": kind.map(|kind| Quantity::new(kind, *limit, Method::Given)),
        "found": judged.found.zip(measure.kind_under(judged.records)).map(|(value, kind)| {
            Quantity::new(kind, value, judged.decided_by).with_error(error)
        }),
        // For one without a number.
        "found_flag": judged.found.filter(|_| kind.is_none()).map(|found| found > 0.5),
        // Room that is left; negative where it does not hold.
        "margin": judged.margin.filter(|_| !counted).and_then(quantity),
        "outcome": judged.outcome().name(),
        "holds": judged.holds,
        "at": at,
        // From which places of the absorber it is known where it is not driven steadily, and under how many records.
        "sample": judged.sample.map(sample),
        "records": judged.records,
        // Share of the resting places from which the absorber stays inactive, where that motion decides.
        "inactive_share": judged.inactive.map(share),
        // That of an absorber at rest with which it would not hold, where it is too small to count.
        "but_at_rest": judged.but_at_rest.map(share),
        // The motion that decides, in the list of its place.
        "motion": judged.motion.map(Motions::id),
        // Excitation periods after which a motion that could decide otherwise was still settling.
        "undecided_after": judged.undecided,
        // What is found where impacts take the time that the case says; whether another kind of motion decides there.
        "contact": judged.contact.map(|contact| {
            json!({ "found": contact.found.and_then(quantity), "crosses": contact.crosses })
        }),
        "decided_by": judged.decided_by,
    })
}

/// Where along a range criteria are worst, as a page tells it.
pub struct WorstPlaces<'a> {
    /// The criteria of the range.
    pub judged: Vec<&'a Judged>,
    /// A place of it with a list of its own.
    pub told: Option<f64>,
    /// What each motion along it has of a criterion.
    pub each: &'a dyn Fn(&Criterion) -> Vec<Found>,
    /// The motions at a place, as a list has them; none of what is no place.
    pub motions: &'a dyn Fn(f64) -> Option<Vec<Value>>,
    /// What a place is.
    pub at: &'a dyn Fn(f64) -> Quantity,
    /// The row about a criterion.
    pub row: &'a dyn Fn(&Judged) -> Value,
}

impl WorstPlaces<'_> {
    /// The motions at each of them, with what each has of the criteria that are worst there; one that has a list of its own is left
    /// out.
    pub fn rows(&self) -> Vec<Value> {
        let own = || self.judged.iter().copied().filter(|one| one.motion.is_some());
        let mut places: Vec<f64> = own().filter_map(|one| one.at).collect();
        places.retain(|at| Some(*at) != self.told);
        places.sort_by(f64::total_cmp);
        places.dedup();
        places.into_iter().filter_map(|at| self.there(at, own())).collect()
    }

    fn there<'a>(&self, at: f64, own: impl Iterator<Item = &'a Judged>) -> Option<Value> {
        let mut motions = (self.motions)(at)?;
        let judged: Vec<&Judged> = own.filter(|one| one.at == Some(at)).collect();
        let found = judged.iter().map(|one| {
            let mut all = (self.each)(&one.criterion);
            all.retain(|found| found.load == one.load && found.at == Some(at));
            (&one.criterion, all)
        });
        let found: Vec<(&Criterion, Vec<Found>)> = found.collect();
        for (number, row) in motions.iter_mut().enumerate() {
            let has = |(asked, all): &(&Criterion, Vec<Found>)| {
                let own = all.iter().filter(|one| one.motion == number).copied();
                let worst = Worst::of(&own.collect::<Vec<_>>(), asked)?.found;
                let kind = asked.measure.kind(Device::Absorber)?;
                Some(Quantity::new(kind, worst.value, worst.known_by).with_error(worst.own))
            };
            row["has"] = json!(found.iter().map(has).collect::<Vec<_>>());
        }
        let criteria: Vec<Value> = judged.into_iter().map(self.row).collect();
        Some(json!({ "at": (self.at)(at), "criteria": criteria, "motions": motions }))
    }
}
