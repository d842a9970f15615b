//! Is an orbit a motion? Only if the absorber stays inside its cavity between impacts and meets
//! each wall from inside.
//!
//! Without restitution an impact leaves no relative velocity, and the absorber separates only where
//! the wall's acceleration leaves it behind; where it does not, the absorber stays on the wall.
//!
//! Where it rubs it also has to slide one way from wall to wall: friction would change its sign with the relative
//! velocity, and the flight is one of the map's only while that keeps its own.
//!
//! Whether it does is proven by a search that cannot step over a contact
//! ([`crate::numerics::crossing`]); its smallest distance to a wall is measured at the turning points of the
//! relative displacement.

use serde::Serialize;

use super::cycle::Cycle;
use super::flight::{Derivatives, OrbitFlight};
use super::impact_map::{ImpactMap, Leg, Wall};
use crate::numerics::bracket::brent;
use crate::numerics::crossing::{CrossingBand, Curve, Edge, Sample, Search, first_crossing};

/// Units in the last place of the largest length involved that count as touching a wall.
const TOUCH_ULPS: f64 = 64.0;
/// Share of a flight by which its end may be met early: rounding of a transversal impact.
const EARLY: f64 = 1e-7;
/// Fast time for which one bound on the curvature is used.
const HORIZON: f64 = 1.0;
/// Width of the cavity over the clearance: more than any turning point inside leaves.
const FULL_WIDTH: f64 = 2.0;
/// Pieces per radian of the fastest oscillation in which sign changes are looked for: too short for
/// an acceleration to change its sign twice in one, unless it hardly differs from 0 there.
const PIECES_PER_RADIAN: f64 = 8.0;
/// Fewest and most pieces of a flight: a short one still may turn twice, and one of 10^4 radians has
/// turned often enough to have shown its extremes.
const PIECES: [f64; 2] = [4.0, 1e5];
/// Width, over the flight, to which a turning point is located: rounding of the motion there.
const TURNED: f64 = 1e-13;

/// The evidence.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Admissibility {
    /// Proven: no contact between the impacts, and each wall met from inside.
    pub admissible: bool,
    /// Smallest distance to a wall at a turning point between impacts, over the clearance; negative
    /// where a wall is penetrated, 2 where there is no turning point.
    pub min_wall_distance: f64,
    /// The flight, counted from 0, in which that distance is smallest, and how far into it, 0 to 1.
    pub narrowest: Option<Narrowest>,
    /// Smallest speed at which a wall is met, over the clearance, in fast time; negative where an
    /// impact would come from outside.
    pub slowest_impact: f64,
    /// Smallest acceleration, over the clearance, with which a wall leaves behind an absorber that
    /// does not rebound; negative where the absorber stays on the wall. `None` where every impact
    /// rebounds.
    pub slowest_departure: Option<f64>,
    /// Smallest relative speed between impacts, over the clearance, in fast time, of an absorber that rubs;
    /// not above 0 where its slip reverses. `None` without friction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slowest_slip: Option<f64>,
}

/// Where an orbit comes closest to an impact that it does not have.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Narrowest {
    /// Which flight, counted from 0.
    pub flight: usize,
    /// How far into it, 0 to 1.
    pub fraction: f64,
    /// The wall that is close.
    pub wall: Wall,
}

impl Admissibility {
    /// Whether the absorber stays on a wall after an impact, instead of separating from it.
    pub fn sticks(&self) -> bool {
        self.slowest_departure.is_some_and(|departure| departure <= 0.0)
    }

    /// Whether the slip of an absorber that rubs reverses between two impacts, so that the cycle is no motion.
    pub fn reverses(&self) -> bool {
        self.slowest_slip.is_some_and(|slip| slip <= 0.0)
    }

    /// Of the flights of a cycle.
    pub fn of(map: &ImpactMap, cycle: &Cycle) -> Self {
        Distances::of(map, cycle).proven(map, cycle)
    }
}

/// How close a cycle comes to the walls and how slowly to impacts, as in [`Admissibility`], without the proof that it is a
/// motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Distances {
    pub min_wall_distance: f64,
    pub narrowest: Option<Narrowest>,
    pub slowest_impact: f64,
    pub slowest_departure: Option<f64>,
    pub slowest_slip: Option<f64>,
}

impl Distances {
    /// With the proof for the cycle that was measured, if there is one.
    pub fn proven(self, map: &ImpactMap, cycle: &Cycle) -> Admissibility {
        self.with(is_motion(map, cycle))
    }

    /// With what was proven.
    pub fn with(self, admissible: bool) -> Admissibility {
        let Self { min_wall_distance, narrowest, slowest_impact, slowest_departure, slowest_slip } =
            self;
        Admissibility {
            admissible,
            min_wall_distance,
            narrowest,
            slowest_impact,
            slowest_departure,
            slowest_slip,
        }
    }

    /// Of the flights of a cycle.
    pub fn of(map: &ImpactMap, cycle: &Cycle) -> Self {
        let mut found = Self {
            min_wall_distance: FULL_WIDTH,
            narrowest: None,
            slowest_impact: f64::INFINITY,
            slowest_departure: None,
            slowest_slip: None,
        };
        for (flight, leg) in cycle.flights(map).iter().enumerate() {
            let approach = approach(leg);
            let departure = Departure::of(leg);
            if departure.is_still() {
                let slowest = found.slowest_departure.unwrap_or(f64::INFINITY);
                found.slowest_departure = Some(slowest.min(departure.acceleration));
            }
            found.slowest_impact = found.slowest_impact.min(approach);
            if map.cavity().friction_acceleration > 0.0 {
                let slowest = found.slowest_slip.unwrap_or(f64::INFINITY);
                found.slowest_slip = Some(slowest.min(slip(map, leg)));
            }
            for at in turning_points(map, leg, &departure) {
                let value = leg.relative(at).x;
                let wall = if value > 0.0 { Wall::Plus } else { Wall::Minus };
                if 1.0 - value.abs() < found.min_wall_distance {
                    found.min_wall_distance = 1.0 - value.abs();
                    let fraction = at / leg.duration;
                    found.narrowest = Some(Narrowest { flight, fraction, wall });
                }
            }
        }
        found
    }
}

/// Whether a cycle is proven to be a motion. One that is none is told by its first contact, long before its distances are
/// known.
pub(super) fn is_motion(map: &ImpactMap, cycle: &Cycle) -> bool {
    let rubs = map.cavity().friction_acceleration > 0.0;
    cycle.flights(map).iter().all(|leg| {
        let departure = Departure::of(leg);
        approach(leg) > 0.0
            && free_of_contact(map, leg, &departure)
            && (!rubs || free_of_reversal(map, leg, &departure))
    })
}

/// Speed at which a flight meets its wall.
fn approach(leg: &Leg) -> f64 {
    leg.to.sign() * leg.relative(leg.duration).v
}

/// Smallest relative speed of a flight away from the wall where it begins: at its end, or where it turns.
fn slip(map: &ImpactMap, leg: &Leg) -> f64 {
    let turns = zeros(leg, map.flight.frequency(), |_, at| [at.a - leg.acceleration, at.jerk]);
    let speed = |s: f64| -leg.start.wall.sign() * leg.relative(s).v;
    turns.into_iter().map(speed).fold(speed(leg.duration), f64::min)
}

/// How the absorber and a wall part after an impact; lengths over the clearance, fast time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Departure {
    /// Relative velocity away from the wall.
    speed: f64,
    /// Relative acceleration away from the wall.
    pub acceleration: f64,
    /// Distance, and speed, that counts as none.
    touch: f64,
}

impl Departure {
    /// At the beginning of a flight.
    pub fn of(leg: &Leg) -> Self {
        let (inwards, at) = (-leg.start.wall.sign(), leg.oscillator(0.0));
        let relative = leg.relative_of(at, 0.0);
        let scale = 1.0 + at.x.abs() + at.v.abs() + leg.start.y_velocity.abs();
        Self {
            speed: inwards * (leg.start.x_velocity - leg.start.y_velocity),
            acceleration: inwards * relative.a,
            touch: TOUCH_ULPS * f64::EPSILON * scale,
        }
    }

    /// Whether the impact left no relative velocity: nothing but the acceleration parts the two.
    pub fn is_still(&self) -> bool {
        self.speed <= self.touch
    }

    /// When a search in the flight begins: at once, or where the two have parted.
    fn begin(&self, duration: f64) -> f64 {
        if self.is_still() {
            (self.touch / self.acceleration).sqrt().min(EARLY * duration)
        } else {
            0.0
        }
    }
}

struct GapOverFlight<'a> {
    leg: &'a Leg,
    flight: &'a OrbitFlight,
}

impl GapOverFlight<'_> {
    /// The oscillator about the place of its rest, and the most of `hypot(x, v)` within the horizon: it grows no faster
    /// than the largest force.
    fn size(&self, oscillator: Derivatives) -> f64 {
        libm::hypot(oscillator.x - self.leg.push(), oscillator.v) + self.flight.force() * HORIZON
    }
}

/// The relative velocity of a flight, away from the wall where it begins.
struct Slip<'a>(GapOverFlight<'a>);

impl Curve for Slip<'_> {
    fn sample(&self, s: f64) -> Sample {
        let GapOverFlight { leg, flight } = self.0;
        let oscillator = leg.oscillator(s);
        let relative = leg.relative_of(oscillator, s);
        let (away, damping) = (-leg.start.wall.sign(), flight.damping());
        // The rate of the acceleration is that of the force less 2 d times the acceleration and the velocity.
        let size = self.0.size(oscillator);
        let acceleration = flight.force() + (1.0 + damping) * size;
        let curvature_bound = flight.frequency() * flight.force() + damping * acceleration + size;
        Sample { value: away * relative.v, slope: away * relative.a, curvature_bound }
    }
    fn horizon(&self) -> f64 {
        HORIZON
    }
}

impl Curve for GapOverFlight<'_> {
    fn sample(&self, s: f64) -> Sample {
        let (relative, curvature_bound) = self.leg.bounded(s);
        Sample { value: relative.x, slope: relative.v, curvature_bound }
    }
    fn horizon(&self) -> f64 {
        f64::INFINITY
    }
}

/// Whether the flight's first contact is its end, on the wall where it is said to end.
fn free_of_contact(map: &ImpactMap, leg: &Leg, departure: &Departure) -> bool {
    let Leg { to, duration, .. } = *leg;
    let positive = duration.is_finite() && duration > 0.0;
    // An absorber that leaves without relative velocity must be left behind by the wall.
    if !positive || departure.is_still() && departure.acceleration <= 0.0 {
        return false;
    }
    let band = CrossingBand { lower: -1.0, upper: 1.0, touch: departure.touch };
    let curve = GapOverFlight { leg, flight: &map.flight };
    match first_crossing(&curve, departure.begin(duration), duration * (1.0 + EARLY), band) {
        Search::Crossed(contact) => {
            let wall = if contact.edge == Edge::Upper { Wall::Plus } else { Wall::Minus };
            wall == to && contact.time >= duration * (1.0 - EARLY)
        }
        Search::Clear { .. } | Search::NotFinite(_) => false,
    }
}

/// Whether the absorber slides away from the wall where a flight begins until it ends.
fn free_of_reversal(map: &ImpactMap, leg: &Leg, departure: &Departure) -> bool {
    let curve = Slip(GapOverFlight { leg, flight: &map.flight });
    let band = CrossingBand { lower: 0.0, upper: f64::INFINITY, touch: departure.touch };
    let begin = departure.begin(leg.duration);
    matches!(first_crossing(&curve, begin, leg.duration, band), Search::Clear { .. })
}

/// Times at which the relative displacement turns within a flight.
fn turning_points(map: &ImpactMap, leg: &Leg, departure: &Departure) -> Vec<f64> {
    zeros(leg, map.flight.frequency(), |s, oscillator| {
        // Where nothing but the acceleration parts the two, the velocity at the very beginning is
        // rounding.
        if s == 0.0 && departure.is_still() {
            let rate = -leg.start.wall.sign() * departure.acceleration;
            [rate.signum() * f64::MIN_POSITIVE, rate]
        } else {
            let relative = leg.relative_of(oscillator, s);
            [relative.v, relative.a]
        }
    })
}

/// Places within a flight at which a rate of the motion vanishes, by its value and slope at a time, where
/// the oscillator's motion is given: every change of sign between neighbouring pieces, and every pair of
/// changes around a flattest place.
pub(super) fn zeros(
    leg: &Leg,
    frequency: f64,
    rate: impl Fn(f64, Derivatives) -> [f64; 2],
) -> Vec<f64> {
    let duration = leg.duration;
    let pieces =
        (duration * frequency.max(1.0) * PIECES_PER_RADIAN).ceil().clamp(PIECES[0], PIECES[1]);
    let step = duration / pieces;
    let width = TURNED * duration;
    let exact = |s: f64| rate(s, leg.oscillator(s));
    let value = |s: f64| exact(s)[0];
    let mut found = Vec::new();
    let mut between = |low: f64, high: f64| {
        // Where the exact values do not differ in sign, the zero is at an end, but for rounding.
        let nearest = || if value(low).abs() < value(high).abs() { low } else { high };
        let at = brent(low, high, width, value).map_or_else(|_| nearest(), |root| root.at);
        found.extend(Some(at).filter(|at| 0.0 < *at && *at < duration));
    };
    let mut before = exact(0.0);
    for (k, oscillator) in (0..pieces as u32).zip(leg.oscillator_at_steps(step, pieces as u32)) {
        let (low, high) = (f64::from(k) * step, f64::from(k + 1) * step);
        let after = rate(high, oscillator);
        if (before[0] > 0.0) != (after[0] > 0.0) {
            between(low, high);
        } else if before[0] * before[1] < 0.0
            && after[0] * after[1] > 0.0
            && let Ok(flattest) = brent(low, high, width, |s| exact(s)[1])
            && (value(flattest.at) > 0.0) != (before[0] > 0.0)
        {
            // It turns and turns back within one piece, as it does after a weak rebound.
            between(low, flattest.at);
            between(flattest.at, high);
        }
        before = after;
    }
    found
}
