//! What is known along a case's band, and of a tuned mass damper.

use serde_json::{Value, json};

use super::criteria::{WorstPlaces, criterion};
use super::motions::listed;
use super::scale::{ROOT_OF_ROUNDING, Scale};
use crate::analysis::Strip;
use crate::band::{Band, Rivals, Survey, Worst};
use crate::case::{BandOver, Case};
use crate::criteria::{Judged, each, method, of_stability};
use crate::linear::{bare_amplitude, level_error};
use crate::method::Method::{self, ClosedForm, ExactOrbit, Theory};
use crate::motions::{Motion, Motions, RestKind};
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;

/// A motion in which the absorber stays at rest; `within` is half the width in which it rests. None where only other starts
/// than those from rest lead to it.
pub fn inactive(
    scale: &Scale,
    motion: &Motion,
    at: Option<Quantity>,
    counts: bool,
) -> Option<Value> {
    let rest = motion.rest().filter(|rest| rest.share > 0.0)?;
    let peak = motion.facts().peak;
    let of = method(motion);
    let mut told = json!({
        "peak": scale.units.quantity_with(&of::INACTIVE_PEAK, [peak.value, peak.error], of),
        "at": at,
        "share": Quantity::new(&of::INACTIVE_SHARE, rest.share, of),
        "within": scale.units.quantity(&of::CLEARANCE, rest.share, of),
        // Those from which it does so when the excitation begins at once.
        "share_sudden": Quantity::new(&of::SUDDEN_SHARE, rest.sudden, of),
        "within_sudden": scale.units.quantity(&of::CLEARANCE, rest.sudden, of),
        "why_not": motion.why_not(counts),
    });
    // Held or sliding; else it floats in the middle of its cavity.
    if rest.rest != RestKind::Floating {
        told["rest"] = json!(rest.rest);
    }
    Some(told)
}

/// What a tuned mass damper is held against along a band.
pub(in crate::report) struct AbsorberAlong<'a> {
    pub over: BandOver,
    /// The absorber's worst motion, where anything was simulated.
    pub worst: Option<&'a Worst>,
}

/// A tuned mass damper of the absorber's mass: at a single excitation, or along a band.
pub(in crate::report) fn damper(
    scale: &Scale,
    rivals: &Rivals,
    along: Option<&AbsorberAlong>,
) -> Value {
    let length = |kind, value| scale.units.quantity(kind, value, ClosedForm);
    let Rivals { damper, damped, .. } = rivals;
    let reach = |worst: &Worst| worst.peak.value + worst.peak.error;
    let worst = along.and_then(|one| one.worst);
    json!({
        "frequency": scale.damper_frequency(damper.tuning),
        "damping_ratio": Quantity::new(&of::DAMPER_DAMPING_RATIO, damper.damping_ratio, ClosedForm),
        // What it is where the search for it ended at a bound.
        "at_bound": rivals.at_bound(),
        "peak": length(&of::DAMPER_PEAK, damped.amplitude),
        "at": along.map(|one| scale.place(one.over, damped.at)),
        "stroke": length(&of::DAMPER_STROKE, damped.stroke),
        "needs_more_room": damped.stroke > 1.0,
        // By the absorber's worst motion, where anything was simulated.
        "absorber_is_better": worst.map(|worst| reach(worst) < damped.amplitude),
    })
}

/// The case's own excitation where it is none of its band, and whether only its amplitude is another than the band has there.
pub fn outside(scale: &Scale, band: &Band) -> Value {
    let own = band.own();
    let in_range = (band.range[0]..=band.range[1]).contains(&own);
    json!({ "at": scale.place(band.over, own), "in_range": in_range })
}

/// What a survey found along the band.
pub fn band(scale: &Scale, survey: &Survey) -> Value {
    let (band, motions) = (survey.band(), &survey.motions);
    let place = |at: f64| scale.place(band.over, at);
    let (bare_at, bare) = survey.bare();
    let change = |[peak, error]: [f64; 2], method: Method| {
        let value = 20.0 * libm::log10(peak / bare);
        let change = Quantity::new(&of::CHANGE_DB, value, method);
        value.is_finite().then(|| change.with_error(level_error(peak, error)))
    };
    let own = band.own();
    let worst_motion = survey.worst();
    let worst = worst_motion.as_ref().map(|worst| {
        let (peak_and_error, by) = ([worst.peak.value, worst.peak.error], method(&worst.motion));
        let change = change(peak_and_error, by);
        let most = scale.units.quantity(&of::PEAK, peak_and_error.iter().sum(), by);
        json!({
            "peak": peak(scale, worst),
            "most": most,
            "at": place(worst.at),
            "change": change,
            "motion": Motions::id(worst.index),
            "regime": worst.motion.regime(),
        })
    });
    let steady = motions.peak_at().and_then(|at| Some((at, motions.at(at)?)));
    let steady = steady.and_then(|(at, here)| Some((at, largest(here, Motion::is_one_to_one)?)));
    let orbit = steady.map(|(at, motion)| {
        let (of, errors) = (motion.facts().peak, method(motion));
        let peak = scale.units.quantity_with(&of::PEAK, [of.value, of.error], errors);
        json!({ "peak": peak, "at": place(at), "change": change([of.value, of.error], errors) })
    });
    let resting = motions.rest_at().and_then(|at| Some((at, motions.at(at)?.rest()?)));
    let resting =
        resting.and_then(|(at, one)| inactive(scale, one, Some(place(at)), survey.count_rest));
    let absorber = AbsorberAlong { over: band.over, worst: worst_motion.as_ref() };
    let bare_peak = scale.units.quantity(&of::BARE_PEAK, bare, ClosedForm);
    let (gap_at, gap) = survey.smallest_gap();
    let gap = Quantity::new(&of::GAP, gap, ExactOrbit).with_error(ROOT_OF_ROUNDING * gap);
    let areas = survey.zones().iter().map(|zone| {
        let (from, to) = (place(zone.from), place(zone.to));
        json!({ "from": from, "to": to, "area": zone.of.area, "strip": zone.of.strip })
    });
    let stable = motions.stability().iter().filter(|stretch| stretch.of);
    let stable = stable.map(|stretch| [place(stretch.from), place(stretch.to)]);
    json!({
        "from": place(band.range[0]),
        "to": place(band.range[1]),
        "own": place(own),
        // Criteria are about the band; what the page says of the case's own excitation may lie outside of it.
        "outside": (!band.holds_own()).then(|| outside(scale, band)),
        "worst": worst,
        "orbit": orbit,
        "inactive": resting,
        "bare": { "peak": bare_peak, "at": place(bare_at), "change": null },
        "damper": damper(scale, survey.rivals(), Some(&absorber)),
        "stable_share": Quantity::new(&of::STABLE_SHARE, motions.stable_share(), of_stability(motions)),
        "z3_share": Quantity::new(&of::Z3_SHARE, survey.z3_share(), Theory),
        "a1_share": Quantity::new(&of::A1_SHARE, survey.strip_share(Strip::A1), Theory),
        "a2_share": Quantity::new(&of::A2_SHARE, survey.strip_share(Strip::A2), Theory),
        "gap": gap,
        "gap_at": place(gap_at),
        "areas": areas.collect::<Vec<_>>(),
        // Ends of the stretches in which a 1:1 motion attracts.
        "stable": stable.collect::<Vec<_>>(),
        "several": several(scale, survey),
        "worse": worse(scale, survey),
    })
}

/// The motions at each place of the band where a criterion is worst, with what they have of it.
pub fn decides(case: &Case, scale: &Scale, survey: &Survey, judged: &[Judged]) -> Vec<Value> {
    WorstPlaces {
        judged: judged.iter().collect(),
        told: None,
        each: &|asked| each(case, survey, asked),
        motions: &|at| Some(listed(scale, survey.motions.at(at)?, survey.count_rest)),
        at: &|at| scale.place(survey.band().over, at),
        row: &|one| criterion(case, one),
    }
    .rows()
}

/// The motion of a kind with the largest peak.
fn largest(motions: &Motions, is_one: impl Fn(&Motion) -> bool) -> Option<&Motion> {
    let of_kind = motions.iter().filter(|motion| is_one(motion));
    of_kind.max_by(|a, b| a.facts().peak.value.total_cmp(&b.facts().peak.value))
}

fn peak(scale: &Scale, worst: &Worst) -> Quantity {
    let peak = worst.peak;
    scale.units.quantity_with(&of::PEAK, [peak.value, peak.error], method(&worst.motion))
}

/// Places at which several motions with impacts coexist; none where nothing was simulated.
fn several(scale: &Scale, survey: &Survey) -> Option<Value> {
    let moving = |motions: &Motions| motions.iter().filter(|one| one.rest().is_none()).count();
    let places = survey.motions.places();
    let held: Vec<f64> =
        places.iter().filter(|(_, here)| moving(here) > 1).map(|(at, _)| *at).collect();
    let at = |place: Option<&f64>| place.map(|at| scale.place(survey.band().over, *at));
    survey.motions.simulated().then(|| {
        json!({
            "count": held.len(), "of": places.len(), "first": at(held.first()), "last": at(held.last()),
        })
    })
}

/// Peaks over that of the structure alone that count as larger: an absorber at rest leaves it as it is.
const LARGER: f64 = 1.01;

/// Places at which a motion that counts has a larger peak than the structure alone, and the largest ratio of the two; none where
/// nothing was simulated.
fn worse(scale: &Scale, survey: &Survey) -> Option<Value> {
    let (band, motions) = (survey.band(), &survey.motions);
    let mut most: Option<(f64, f64)> = None;
    let mut count = 0;
    for (at, here) in motions.places() {
        let system = band.system(*at).ok()?;
        let peaks = here.counting(survey.count_rest).map(|(_, motion)| motion.facts().peak.value);
        let ratio = peaks.fold(0.0, f64::max) / bare_amplitude(&system);
        if ratio > LARGER {
            count += 1;
            most = most.filter(|most| most.1 >= ratio).or(Some((*at, ratio)));
        }
    }
    motions.simulated().then(|| {
        json!({
            "count": count, "of": motions.places().len(),
            "most": most.map(|(_, ratio)| ratio), "at": most.map(|(at, _)| scale.place(band.over, at)),
        })
    })
}
