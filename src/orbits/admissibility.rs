//! Is an orbit a motion? Only if the absorber stays inside its cavity between impacts and meets
//! each wall from inside.
//!
//! Without restitution an impact leaves no relative velocity, and the absorber separates only where
//! the wall's acceleration leaves it behind; where it does not, the absorber stays on the wall.
//!
//! Whether it does is proven by a search that cannot step over a contact
//! ([`crate::numerics::crossing`]); its smallest distance to a wall is measured at the turning points of the
//! relative displacement.

use serde::Serialize;

use super::flight::Kinematics;
use super::impact_map::{AfterImpact, ImpactMap, Wall};
use crate::numerics::bracket::brent;
use crate::numerics::crossing::{Band, Curve, Edge, Sample, Search, first_crossing};

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

    /// Of a sequence of flights: state after the impact, wall left, wall met, duration.
    pub fn of(map: &ImpactMap, flights: &[(AfterImpact, Wall, Wall, f64)]) -> Self {
        let mut found = Self {
            admissible: true,
            min_wall_distance: FULL_WIDTH,
            narrowest: None,
            slowest_impact: f64::INFINITY,
            slowest_departure: None,
        };
        for (index, (start, from, to, duration)) in flights.iter().enumerate() {
            let approach = to.sign() * map.gap_at(start, *from, *duration).v;
            let departure = Departure::of(map, start, *from);
            if departure.is_still() {
                let slowest = found.slowest_departure.unwrap_or(f64::INFINITY);
                found.slowest_departure = Some(slowest.min(departure.acceleration));
            }
            found.slowest_impact = found.slowest_impact.min(approach);
            found.admissible &=
                approach > 0.0 && free_of_contact(map, start, *from, *to, *duration);
            for (at, value) in turning_points(map, start, *from, *duration, &departure) {
                let wall = if value > 0.0 { Wall::Plus } else { Wall::Minus };
                if 1.0 - value.abs() < found.min_wall_distance {
                    found.min_wall_distance = 1.0 - value.abs();
                    let fraction = at / duration;
                    found.narrowest = Some(Narrowest { flight: index, fraction, wall });
                }
            }
        }
        found
    }
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
    /// Of the flight that begins with `start` on the wall `from`.
    pub fn of(map: &ImpactMap, start: &AfterImpact, from: Wall) -> Self {
        let at = Kinematics { x: start.x, v: start.x_velocity };
        let scale = 1.0 + at.x.abs() + at.v.abs() + start.y_velocity.abs();
        Self {
            speed: -from.sign() * (start.x_velocity - start.y_velocity),
            acceleration: -from.sign() * map.flight.acceleration(start.phase, at),
            touch: TOUCH_ULPS * f64::EPSILON * scale,
        }
    }

    /// Whether the impact left no relative velocity: nothing but the acceleration parts the two.
    pub fn is_still(&self) -> bool {
        self.speed <= self.touch
    }
}

struct Gap<'a> {
    map: &'a ImpactMap,
    start: &'a AfterImpact,
    from: Wall,
}

impl Curve for Gap<'_> {
    fn sample(&self, s: f64) -> Sample {
        let oscillator = self.map.oscillator_at(self.start, s);
        let Kinematics { x, v } = self.map.gap_at(self.start, self.from, s);
        let curvature_bound = self.map.flight.acceleration_bound(oscillator, HORIZON);
        Sample { value: x, slope: v, curvature_bound }
    }
    fn horizon(&self) -> f64 {
        HORIZON
    }
}

/// Whether the flight's first contact is its end, on the wall where it is said to end.
fn free_of_contact(
    map: &ImpactMap,
    start: &AfterImpact,
    from: Wall,
    to: Wall,
    duration: f64,
) -> bool {
    let positive = duration.is_finite() && duration > 0.0;
    if !positive {
        return false;
    }
    let departure = Departure::of(map, start, from);
    let touch = departure.touch;
    // An absorber that leaves without relative velocity must be left behind by the wall.
    if departure.is_still() && departure.acceleration <= 0.0 {
        return false;
    }
    let begin = if departure.is_still() {
        (touch / departure.acceleration).sqrt().min(EARLY * duration)
    } else {
        0.0
    };
    let curve = Gap { map, start, from };
    let band = Band { lower: -1.0, upper: 1.0, touch };
    let until = duration * (1.0 + EARLY);
    match first_crossing(&curve, begin, until, band) {
        Search::Crossed(contact) => {
            let wall = if contact.edge == Edge::Upper { Wall::Plus } else { Wall::Minus };
            wall == to && contact.time >= duration * (1.0 - EARLY)
        }
        Search::Clear { .. } | Search::NotFinite(_) => false,
    }
}

/// Times and values at which the relative displacement turns within a flight.
fn turning_points(
    map: &ImpactMap,
    start: &AfterImpact,
    from: Wall,
    duration: f64,
    departure: &Departure,
) -> Vec<(f64, f64)> {
    let slope = |s: f64| {
        // Where nothing but the acceleration parts the two, the velocity at the very beginning is
        // rounding.
        if s == 0.0 && departure.is_still() {
            -from.sign() * departure.acceleration.signum() * f64::MIN_POSITIVE
        } else {
            map.gap_at(start, from, s).v
        }
    };
    let curvature = |s: f64| {
        let phase = start.phase + map.frequency() * s;
        map.flight.acceleration(phase, map.oscillator_at(start, s))
    };
    let mut found = Vec::new();
    let mut note = |at: f64| found.push((at, map.gap_at(start, from, at).x));
    let mut between = |low: f64, high: f64| {
        if let Some(root) = brent(low, high, TURNED * duration, slope)
            && root.at > 0.0
            && root.at < duration
        {
            note(root.at);
        }
    };
    let mut before = (slope(0.0), curvature(0.0));
    for [low, high] in pieces(duration, map.frequency()) {
        let after = (slope(high), curvature(high));
        if (before.0 > 0.0) != (after.0 > 0.0) {
            between(low, high);
        } else if before.0 * before.1 < 0.0
            && after.0 * after.1 > 0.0
            && let Some(flattest) = brent(low, high, TURNED * duration, curvature)
            && (slope(flattest.at) > 0.0) != (before.0 > 0.0)
        {
            // It turns and turns back within one piece, as it does after a weak rebound.
            between(low, flattest.at);
            between(flattest.at, high);
        }
        before = after;
    }
    found
}

/// The pieces of a flight in which sign changes are looked for, in order.
fn pieces(duration: f64, frequency: f64) -> impl Iterator<Item = [f64; 2]> {
    let pieces =
        (duration * frequency.max(1.0) * PIECES_PER_RADIAN).ceil().clamp(PIECES[0], PIECES[1]);
    let step = duration / pieces;
    (0..pieces as u32).map(move |k| [f64::from(k) * step, f64::from(k + 1) * step])
}

/// Calls `found` at each sign change of `function` within `(0, duration)`.
pub(super) fn sign_changes(
    duration: f64,
    frequency: f64,
    function: impl Fn(f64) -> f64,
    mut found: impl FnMut(f64),
) {
    let mut before = function(0.0);
    for [from, to] in pieces(duration, frequency) {
        let after = function(to);
        if (before > 0.0) != (after > 0.0)
            && let Some(root) = brent(from, to, TURNED * duration, &function)
            && root.at > 0.0
            && root.at < duration
        {
            found(root.at);
        }
        before = after;
    }
}
