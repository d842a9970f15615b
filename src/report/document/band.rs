//! What is known along a case's band, and of a tuned mass damper.

use serde_json::{Value, json};

use super::scale::{Scale, level_error};
use super::theory::ROOT_OF_ROUNDING;
use crate::analysis::Strip;
use crate::band::inactive::Rest;
use crate::band::rivals::DETUNED;
use crate::band::simulated::Place;
use crate::band::{Inactive, Rivals, Source, Survey, Worst};
use crate::case::BandOver;
use crate::method::Method::{self, ClosedForm, ExactOrbit, Simulation, Theory};
use crate::quantity::catalogue as of;
use crate::quantity::{Quantity, numbers};

/// Digits of the data of a curve, as many as a drawing of any size can show.
const CURVE_DIGITS: usize = 7;

/// A motion in which the absorber stays at rest; `within` is half the width in which it rests.
pub fn inactive(scale: &Scale, of: &Inactive, at: Option<Quantity>, counted: bool) -> Value {
    let mut told = json!({
        "peak": scale.length(&of::INACTIVE_PEAK, of.peak, ClosedForm),
        "at": at,
        "share": Quantity::new(&of::INACTIVE_SHARE, of.share, ClosedForm),
        "within": scale.length(&of::CLEARANCE, of.share, ClosedForm),
        "counted": counted,
    });
    // Held or sliding; else it floats in the middle of its cavity.
    if of.rest != Rest::Floating {
        told["rest"] = json!(of.rest);
    }
    told
}

/// What a tuned mass damper is held against along a band.
pub(in crate::report) struct Absorber<'a> {
    pub over: BandOver,
    /// The absorber's worst motion, where anything was simulated.
    pub worst: Option<Worst>,
    /// The same with the structure's frequency off.
    pub detuned: &'a [Option<Worst>],
}

/// A tuned mass damper of the absorber's mass: at a single excitation, or along a band, where both devices are
/// also held against a structure whose frequency is off.
pub(in crate::report) fn damper(scale: &Scale, rivals: &Rivals, along: Option<&Absorber>) -> Value {
    let length = |kind, value| scale.length(kind, value, ClosedForm);
    let Rivals { damper, damped, detuned, .. } = rivals;
    let absorber = |k: usize| along.and_then(|one| one.detuned.get(k).copied().flatten());
    let reach = |worst: Worst| worst.peak + worst.error;
    let off = [0, 1].into_iter().filter_map(absorber).map(reach).reduce(f64::max);
    let damper_off = detuned.iter().map(|one| one.amplitude).fold(0.0, f64::max);
    let worst = along.and_then(|one| one.worst);
    let off_tune = |k: usize| {
        json!({
            "change": Quantity::new(&of::MARGIN, DETUNED[k] - 1.0, ClosedForm),
            "absorber": absorber(k).map(|worst| peak(scale, &worst)),
            "peak": length(&of::DAMPER_PEAK, detuned[k].amplitude),
            "stroke": length(&of::DAMPER_STROKE, detuned[k].stroke),
        })
    };
    let frequency = match scale.frequency(damper.tuning, ClosedForm) {
        hertz if hertz.kind == &of::EXCITATION_FREQUENCY => {
            Quantity { kind: &of::DAMPER_FREQUENCY, ..hertz }
        }
        ratio => Quantity { kind: &of::DAMPER_FREQUENCY_RATIO, ..ratio },
    };
    json!({
        "frequency": frequency,
        "damping_ratio": Quantity::new(&of::DAMPER_DAMPING_RATIO, damper.damping_ratio, ClosedForm),
        "peak": length(&of::DAMPER_PEAK, damped.amplitude),
        "at": along.map(|one| scale.place(one.over, damped.at)),
        "stroke": length(&of::DAMPER_STROKE, damped.stroke),
        "needs_more_room": damped.stroke > 1.0,
        // By the absorber's worst motion, where anything was simulated.
        "absorber_is_better": worst.map(|worst| reach(worst) < damped.amplitude),
        // The same with the structure's frequency off, at the worse end.
        "absorber_is_better_detuned": off.map(|off| off < damper_off),
        "detuned": along.map_or_else(Vec::new, |_| (0..DETUNED.len()).map(off_tune).collect()),
    })
}

/// What a survey found along the band.
pub fn band(scale: &Scale, survey: &Survey) -> Value {
    let (band, motions) = (survey.band(), &survey.motions);
    let place = |at: f64| scale.place(band.over, at);
    let (bare_at, bare) = survey.rivals.bare;
    let change = |[peak, error]: [f64; 2], method: Method| {
        let value = 20.0 * libm::log10(peak / bare);
        let change = Quantity::new(&of::CHANGE_DB, value, method);
        value.is_finite().then(|| change.with_error(level_error(peak, error)))
    };
    let own = match band.over {
        BandOver::Frequency => band.base.frequency_ratio(),
        BandOver::Amplitude => 1.0,
    };
    let worst = motions.worst().map(|worst| {
        let change = change([worst.peak, worst.error], method(&worst));
        json!({ "peak": peak(scale, &worst), "at": place(worst.at), "change": change })
    });
    let orbit = motions.orbit.map(|orbit| {
        let peak = scale.length(&of::PEAK, orbit.largest, ExactOrbit);
        json!({
            "peak": peak, "at": place(orbit.at), "change": change([orbit.largest, 0.0], ExactOrbit),
        })
    });
    let asleep = motions.inactive.as_ref();
    let (worst_motion, detuned) = (motions.worst(), survey.detuned.as_slice());
    let absorber = Absorber { over: band.over, worst: worst_motion, detuned };
    let bare_peak = scale.length(&of::BARE_PEAK, bare, ClosedForm);
    let (gap_at, gap) = survey.smallest_gap;
    let gap = Quantity::new(&of::GAP, gap, ExactOrbit).with_error(ROOT_OF_ROUNDING * gap);
    let areas = survey.zones.iter().map(|zone| {
        let (from, to) = (place(zone.from), place(zone.to));
        json!({ "from": from, "to": to, "area": zone.of.area, "strip": zone.of.strip })
    });
    let stable = motions.stability.iter().filter(|stretch| stretch.of);
    let stable = stable.map(|stretch| [place(stretch.from), place(stretch.to)]);
    json!({
        "from": place(band.range[0]),
        "to": place(band.range[1]),
        "own": place(own),
        "worst": worst,
        "orbit": orbit,
        "inactive": asleep.map(|(at, one)| inactive(scale, one, Some(place(*at)), motions.count_inactive)),
        "bare": { "peak": bare_peak, "at": place(bare_at), "change": null },
        "damper": damper(scale, &survey.rivals, Some(&absorber)),
        "stable_share": Quantity::new(&of::STABLE_SHARE, motions.stable_share(), ExactOrbit),
        "z3_share": Quantity::new(&of::Z3_SHARE, survey.z3_share(), Theory),
        "a1_share": Quantity::new(&of::A1_SHARE, survey.strip_share(Strip::A1), Theory),
        "a2_share": Quantity::new(&of::A2_SHARE, survey.strip_share(Strip::A2), Theory),
        "gap": gap,
        "gap_at": place(gap_at),
        "areas": areas.collect::<Vec<_>>(),
        // Ends of the stretches in which a symmetric 1:1 orbit attracts.
        "stable": stable.collect::<Vec<_>>(),
        "places": motions.places.iter().map(|one| place_data(scale, one)).collect::<Vec<_>>(),
        "several": several(scale, survey),
    })
}

/// The layer that a worst motion is from.
fn method(worst: &Worst) -> Method {
    match worst.of {
        Source::Orbit => ExactOrbit,
        Source::Simulated(_) => Simulation,
        Source::Inactive(_) => ClosedForm,
    }
}

fn peak(scale: &Scale, worst: &Worst) -> Quantity {
    scale.length_with(&of::PEAK, [worst.peak, worst.error], method(worst))
}

/// A place that was simulated, as data of a curve: `Omega` or the amplitude over the case's own, and lengths
/// in m or the case's own unit.
fn place_data(scale: &Scale, place: &Place) -> Value {
    let peaks = place.motions.iter().map(|motion| motion.peak);
    let short = |value: f64| numbers::rounded_to(value, CURVE_DIGITS);
    let length = |peak: f64| short(scale.length(&of::PEAK, peak, Simulation).value);
    json!({
        "at": short(place.at),
        "motions": place.motions.len(),
        "inactive_share": place.inactive.map_or(0.0, |one| short(one.share)),
        "largest_peak": place.largest().map(|one| length(one.peak)),
        "smallest_peak": peaks.min_by(f64::total_cmp).map(length),
    })
}

/// Places at which several motions with impacts coexist; none where nothing was simulated.
fn several(scale: &Scale, survey: &Survey) -> Option<Value> {
    let places = &survey.motions.places;
    let held: Vec<&Place> = places.iter().filter(|place| place.motions.len() > 1).collect();
    let at = |place: Option<&&Place>| place.map(|one| scale.place(survey.band().over, one.at));
    (!places.is_empty()).then(|| {
        json!({
            "count": held.len(), "of": places.len(), "first": at(held.first()), "last": at(held.last()),
        })
    })
}
