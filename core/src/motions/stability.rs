//! Where along a band a 1:1 motion attracts, as roots, and where its numbers are extreme there.

use std::cell::RefCell;
use std::collections::BTreeMap;

use super::{Effort, Facts, Motion, Value, one_to_one};
use crate::numerics::scan::{largest, sign_changes};
use crate::orbits::{Orbit, symmetric_orbits, two_impact_orbits};
use crate::system::{Band, Shaking, Stretch};

/// Pieces of a band in which beginnings and ends of stability are looked for. What decides it,
/// multipliers and room between impacts, is smooth along an orbit; pairs of changes within a piece
/// are found by the dip between them.
const PIECES: u32 = 96;
/// Pieces in which a largest value is looked for before it is narrowed down.
const VALUES: u32 = 48;
/// Which of the numbers of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fact {
    /// The peak displacement.
    Peak,
    /// The root mean square displacement.
    Rms,
    /// The impact speed.
    ImpactSpeed,
    /// Impacts per excitation period.
    ImpactsPerPeriod,
    /// The peak velocity.
    PeakVelocity,
    /// The root mean square velocity.
    RmsVelocity,
    /// The peak acceleration between impacts.
    PeakAcceleration,
    /// The root mean square acceleration between impacts.
    RmsAcceleration,
}

impl Fact {
    /// Its value in a motion; none of velocity or acceleration where they were not asked for.
    pub fn of(self, motion: &Motion) -> Option<Value> {
        self.of_facts(motion.facts())
    }

    fn of_facts(self, facts: &Facts) -> Option<Value> {
        Some(match self {
            Self::Peak => facts.peak,
            Self::Rms => facts.rms,
            Self::ImpactSpeed => facts.impact_speed,
            Self::ImpactsPerPeriod => facts.impacts_per_period,
            _ => return self.of_shaking(facts.shaking.as_ref()?),
        })
    }

    /// Its value in what was measured of velocity and acceleration; none of a fact that is neither.
    pub const fn of_shaking<T: Copy>(self, of: &Shaking<T>) -> Option<T> {
        match self {
            Self::PeakVelocity => Some(of.peak_velocity),
            Self::RmsVelocity => Some(of.rms_velocity),
            Self::PeakAcceleration => Some(of.peak_acceleration),
            Self::RmsAcceleration => Some(of.rms_acceleration),
            Self::Peak | Self::Rms | Self::ImpactSpeed | Self::ImpactsPerPeriod => None,
        }
    }

    /// By which power of its frequency a sine's number grows at one amplitude.
    pub(super) const fn power_of_frequency(self) -> i32 {
        match self {
            Self::Peak | Self::Rms | Self::ImpactSpeed | Self::ImpactsPerPeriod => 0,
            Self::PeakVelocity | Self::RmsVelocity => 1,
            Self::PeakAcceleration | Self::RmsAcceleration => 2,
        }
    }

    /// Whether it is one of [`Effort::shaking`].
    pub const fn is_of_shaking(self) -> bool {
        self.power_of_frequency() > 0
    }
}

/// Where along a band a number of the attracting 1:1 motions is largest, or smallest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Extreme {
    /// The number.
    pub of: Fact,
    /// Whether the smallest is meant.
    pub least: bool,
}

impl Extreme {
    /// The largest displacement.
    pub(super) const PEAK: Self = Self { of: Fact::Peak, least: false };

    /// -1 where the smallest is meant.
    pub(super) const fn sign(self) -> f64 {
        if self.least { -1.0 } else { 1.0 }
    }
}

/// Width, over the band, of what lies between two orbits where one takes over the other's stability: there both have a
/// multiplier of 1, to rounding.
const EXCHANGE: f64 = 1e-6;

/// The band, cut where an attracting 1:1 motion begins or ends.
pub fn stability(band: &Band) -> Vec<Stretch<bool>> {
    let mut places: Vec<f64> = band.corners().collect();
    if !band.is_point() {
        places.extend(sign_changes(band.range, PIECES, |at| strength(band, at)));
    }
    let mut found: Vec<Stretch<bool>> = Vec::new();
    for stretch in band.cut(places, |at| strength(band, at) > 0.0) {
        let narrow = stretch.to - stretch.from < EXCHANGE * band.width();
        match found.last_mut() {
            // Nothing is lost where one orbit hands its stability over to another.
            Some(last) if last.of == stretch.of || narrow && last.of => last.to = stretch.to,
            _ => found.push(stretch),
        }
    }
    found
}

/// By how much the most attracting 1:1 motion attracts: above 0 where one does, continuous where orbits
/// change their stability, touch a wall or meet one another.
fn strength(band: &Band, at: f64) -> f64 {
    let Ok(system) = band.system(at) else { return f64::NAN };
    let of = |orbit: &Orbit| {
        let inside = 1.0 - orbit.multipliers.spectral_radius();
        let room = orbit.admissibility.min_wall_distance;
        let slip = orbit.admissibility.slowest_slip.unwrap_or(f64::INFINITY);
        let least = inside.min(room).min(slip);
        // The sign is that of the proof, whatever rounding says of the numbers.
        if orbit.attracts() { least.max(f64::MIN_POSITIVE) } else { least.min(-f64::MIN_POSITIVE) }
    };
    let most = |orbits: &[Orbit]| orbits.iter().map(of).max_by(f64::total_cmp);
    if system.cavity().is_ideal() {
        // Where a symmetric one attracts nobody asks for the others.
        let symmetric = symmetric_orbits(&system).unwrap_or_default();
        let symmetric: Vec<Orbit> = symmetric.into_iter().map(|one| one.orbit).collect();
        if let Some(inside) = most(&symmetric).filter(|strength| *strength > 0.0) {
            return inside;
        }
    }
    let Ok(all) = two_impact_orbits(&system) else { return f64::NAN };
    let reverses = |orbit: &Orbit| orbit.admissibility.reverses();
    // Where orbits meet and vanish a multiplier has come to 1.
    let exact = most(&all.orbits).unwrap_or(-f64::MIN_POSITIVE);
    if exact > 0.0 || !all.orbits.iter().any(reverses) {
        return exact;
    }
    let inside = |motion: &Motion| 1.0 - motion.largest_multiplier().unwrap_or_default();
    one_to_one(&system).iter().map(inside).max_by(f64::total_cmp).unwrap_or(exact)
}

/// The attracting 1:1 motions along a band, each place solved for once: several numbers are looked at in the same places.
pub(super) struct OneToOne<'b> {
    band: &'b Band,
    effort: Effort,
    known: RefCell<BTreeMap<u64, Vec<Facts>>>,
}

impl<'b> OneToOne<'b> {
    pub fn along(band: &'b Band, shaking: bool) -> Self {
        let effort = Effort { shaking, ..Effort::default() };
        Self { band, effort, known: RefCell::new(BTreeMap::new()) }
    }

    fn at<T>(&self, at: f64, read: impl Fn(&[Facts]) -> Option<T>) -> Option<T> {
        if let Some(known) = self.known.borrow().get(&at.to_bits()) {
            return read(known);
        }
        let system = self.band.system(at).ok()?;
        let motions = one_to_one(&system).into_iter();
        let facts = motions.map(|one| one.shaken(&system, &self.effort).facts);
        let facts: Vec<Facts> = facts.collect();
        let found = read(&facts);
        self.known.borrow_mut().insert(at.to_bits(), facts);
        found
    }
}

/// Where along a band a number of the attracting 1:1 motions is extreme; none where none attracts.
pub(super) fn extreme_at(
    motions: &OneToOne,
    stability: &[Stretch<bool>],
    wanted: Extreme,
) -> Option<f64> {
    let band = motions.band;
    let signed = |facts: &Facts| Some(wanted.sign() * wanted.of.of_facts(facts)?.value);
    let largest_of = |all: &[Facts]| all.iter().filter_map(signed).max_by(f64::total_cmp);
    let of = |at: f64| motions.at(at, largest_of);
    let stretches = stability.iter().filter(|stretch| stretch.of);
    let each = stretches.filter_map(|stretch| {
        let share = (stretch.to - stretch.from) / band.width();
        let pieces = (share * f64::from(VALUES)).ceil().max(4.0) as u32;
        // At the very ends rounding decides whether there is an orbit.
        largest([stretch.from, stretch.to], if band.is_point() { 1 } else { pieces }, of)
    });
    each.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(at, _)| at)
}
