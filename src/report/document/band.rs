//! What is known along a case's band.

use serde::Serialize;

use super::scale::{Scale, level_error};
use super::theory::ROOT_OF_ROUNDING;
use crate::analysis::{Area, Strip};
use crate::band::rivals::{DETUNED, Damped};
use crate::band::simulated::Place;
use crate::band::{Inactive, Rivals, Source, Survey, Worst};
use crate::method::Method::{self, ClosedForm, ExactOrbit, Simulation, Theory};
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;

/// The band.
#[derive(Debug, Clone, Serialize)]
pub struct BandFacts {
    from: Quantity,
    to: Quantity,
    own: Quantity,
    worst: Option<PlacedPeak>,
    orbit: Option<PlacedPeak>,
    inactive: Option<InactiveFacts>,
    bare: PlacedPeak,
    damper: DamperFacts,
    stable_share: Quantity,
    z3_share: Quantity,
    a1_share: Quantity,
    a2_share: Quantity,
    gap: Quantity,
    gap_at: Quantity,
    areas: Vec<AreaFacts>,
    /// Ends of the stretches in which a symmetric 1:1 orbit attracts.
    stable: Vec<[Quantity; 2]>,
    places: Vec<PlaceFacts>,
    /// Places at which several motions with impacts coexist.
    several: Option<Several>,
}

/// A peak and where it is.
#[derive(Debug, Clone, Serialize)]
pub struct PlacedPeak {
    peak: Quantity,
    at: Option<Quantity>,
    change: Option<Quantity>,
}

/// An absorber that stays at rest.
#[derive(Debug, Clone, Serialize)]
pub struct InactiveFacts {
    peak: Quantity,
    at: Option<Quantity>,
    share: Quantity,
    /// Half the width in which it rests.
    within: Quantity,
    counted: bool,
}

/// A tuned mass damper of the absorber's mass.
#[derive(Debug, Clone, Serialize)]
pub struct DamperFacts {
    frequency: Quantity,
    damping_ratio: Quantity,
    peak: Quantity,
    at: Option<Quantity>,
    stroke: Quantity,
    /// Whether its stroke exceeds the absorber's clearance.
    needs_more_room: bool,
    /// Whether the absorber's worst motion is smaller; none where nothing was simulated.
    absorber_is_better: Option<bool>,
    /// The same with the structure's frequency off, at the worse end.
    absorber_is_better_detuned: Option<bool>,
    /// Both devices with the structure's frequency off; none for a single excitation.
    detuned: Vec<DetunedFacts>,
}

/// Both devices on a structure whose frequency is off.
#[derive(Debug, Clone, Serialize)]
struct DetunedFacts {
    change: Quantity,
    absorber: Option<Quantity>,
    peak: Quantity,
    stroke: Quantity,
}

/// A stretch of one area; none where closed form cannot tell Z1 from Z2.
#[derive(Debug, Clone, Serialize)]
struct AreaFacts {
    from: Quantity,
    to: Quantity,
    area: Option<Area>,
    strip: Option<Strip>,
}

/// A place that was simulated.
#[derive(Debug, Clone, Serialize)]
struct PlaceFacts {
    at: f64,
    motions: usize,
    inactive_share: f64,
    largest_peak: Option<Quantity>,
    smallest_peak: Option<Quantity>,
}

#[derive(Debug, Clone, Serialize)]
struct Several {
    count: usize,
    of: usize,
    first: Option<Quantity>,
    last: Option<Quantity>,
}

impl InactiveFacts {
    /// Of a motion at some place of a band.
    pub fn of(scale: &Scale, inactive: &Inactive, at: Option<Quantity>, counted: bool) -> Self {
        Self {
            peak: scale.length(&of::INACTIVE_PEAK, inactive.amplitude, ClosedForm),
            at,
            share: Quantity::new(&of::INACTIVE_SHARE, inactive.share, ClosedForm),
            within: scale.length(&of::CLEARANCE, inactive.share, ClosedForm),
            counted,
        }
    }
}

impl DamperFacts {
    /// The damper of a single excitation.
    pub fn at_point(scale: &Scale, rivals: &Rivals) -> Self {
        Self::new(scale, rivals, None)
    }

    fn new(scale: &Scale, rivals: &Rivals, survey: Option<&Survey>) -> Self {
        let length = |kind, value| scale.length(kind, value, ClosedForm);
        let Rivals { damper, damped, detuned, .. } = rivals;
        let place = |damped: &Damped| survey.map(|one| scale.place(one.band().over, damped.at));
        let absorber = |k: usize| survey.and_then(|one| one.detuned.get(k).copied().flatten());
        let reach = |worst: Worst| worst.peak + worst.error;
        let off = [0, 1].into_iter().filter_map(absorber).map(reach).reduce(f64::max);
        let damper_off = detuned.iter().map(|one| one.amplitude).fold(0.0, f64::max);
        let worst = survey.and_then(|one| one.motions.worst());
        Self {
            frequency: match scale.frequency(damper.tuning, ClosedForm) {
                hertz if hertz.kind == &of::EXCITATION_FREQUENCY => {
                    Quantity { kind: &of::DAMPER_FREQUENCY, ..hertz }
                }
                ratio => Quantity { kind: &of::DAMPER_FREQUENCY_RATIO, ..ratio },
            },
            damping_ratio: Quantity::new(
                &of::DAMPER_DAMPING_RATIO,
                damper.damping_ratio,
                ClosedForm,
            ),
            peak: length(&of::DAMPER_PEAK, damped.amplitude),
            at: place(damped),
            stroke: length(&of::DAMPER_STROKE, damped.stroke),
            needs_more_room: damped.stroke > 1.0,
            absorber_is_better: worst.map(|worst| reach(worst) < damped.amplitude),
            absorber_is_better_detuned: off.map(|off| off < damper_off),
            detuned: match survey {
                None => Vec::new(),
                Some(_) => (0..DETUNED.len())
                    .map(|k| DetunedFacts {
                        change: Quantity::new(&of::MARGIN, DETUNED[k] - 1.0, ClosedForm),
                        absorber: absorber(k).map(|worst| peak(scale, &worst)),
                        peak: length(&of::DAMPER_PEAK, detuned[k].amplitude),
                        stroke: length(&of::DAMPER_STROKE, detuned[k].stroke),
                    })
                    .collect(),
            },
        }
    }
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

impl BandFacts {
    /// Those of a survey.
    pub fn of(scale: &Scale, survey: &Survey) -> Self {
        let (band, motions) = (survey.band(), &survey.motions);
        let place = |at: f64| scale.place(band.over, at);
        let (bare_at, bare) = survey.rivals.bare;
        let change = |[peak, error]: [f64; 2], method: Method| {
            let value = 20.0 * libm::log10(peak / bare);
            let change = Quantity::new(&of::CHANGE_DB, value, method);
            value.is_finite().then(|| change.with_error(level_error(peak, error)))
        };
        let share = |kind, value, method| Quantity::new(kind, value, method);
        let (gap_at, gap) = survey.smallest_gap;
        Self {
            from: place(band.range[0]),
            to: place(band.range[1]),
            own: match band.over {
                crate::case::BandOver::Frequency => place(band.base.frequency_ratio()),
                crate::case::BandOver::Amplitude => place(1.0),
            },
            worst: motions.worst().map(|worst| PlacedPeak {
                peak: peak(scale, &worst),
                at: Some(place(worst.at)),
                change: change([worst.peak, worst.error], method(&worst)),
            }),
            orbit: motions.orbit.map(|orbit| PlacedPeak {
                peak: scale.length(&of::PEAK, orbit.largest, ExactOrbit),
                at: Some(place(orbit.at)),
                change: change([orbit.largest, 0.0], ExactOrbit),
            }),
            inactive: motions.inactive.as_ref().map(|(at, inactive)| {
                InactiveFacts::of(scale, inactive, Some(place(*at)), motions.count_inactive)
            }),
            bare: PlacedPeak {
                peak: scale.length(&of::BARE_PEAK, bare, ClosedForm),
                at: Some(place(bare_at)),
                change: None,
            },
            damper: DamperFacts::new(scale, &survey.rivals, Some(survey)),
            stable_share: share(&of::STABLE_SHARE, motions.stable_share(), ExactOrbit),
            z3_share: share(&of::Z3_SHARE, survey.z3_share(), Theory),
            a1_share: share(&of::A1_SHARE, survey.strip_share(Strip::A1), Theory),
            a2_share: share(&of::A2_SHARE, survey.strip_share(Strip::A2), Theory),
            gap: share(&of::GAP, gap, ExactOrbit).with_error(ROOT_OF_ROUNDING * gap),
            gap_at: place(gap_at),
            areas: survey
                .zones
                .iter()
                .map(|zone| AreaFacts {
                    from: place(zone.from),
                    to: place(zone.to),
                    area: zone.of.area,
                    strip: zone.of.strip,
                })
                .collect(),
            stable: motions
                .stability
                .iter()
                .filter(|stretch| stretch.of)
                .map(|stretch| [place(stretch.from), place(stretch.to)])
                .collect(),
            places: motions.places.iter().map(|one| PlaceFacts::of(scale, one)).collect(),
            several: several(scale, survey),
        }
    }
}

impl PlaceFacts {
    fn of(scale: &Scale, place: &Place) -> Self {
        let smallest = place.motions.iter().map(|motion| motion.peak).min_by(f64::total_cmp);
        Self {
            at: place.at,
            motions: place.motions.len(),
            inactive_share: place.inactive.map_or(0.0, |one| one.share),
            largest_peak: place
                .largest()
                .map(|one| scale.length_with(&of::PEAK, [one.peak, one.peak_error], Simulation)),
            smallest_peak: smallest.map(|peak| scale.length(&of::PEAK, peak, Simulation)),
        }
    }
}

fn several(scale: &Scale, survey: &Survey) -> Option<Several> {
    let places = &survey.motions.places;
    let held: Vec<&Place> = places.iter().filter(|place| place.motions.len() > 1).collect();
    let at = |place: Option<&&Place>| place.map(|one| scale.place(survey.band().over, one.at));
    (!places.is_empty()).then(|| Several {
        count: held.len(),
        of: places.len(),
        first: at(held.first()),
        last: at(held.last()),
    })
}
