//! What drives a structure as a record says, or as noise of a given spectrum does: linear between samples, cut into
//! pieces in which it is linear in dimensionless form.

use std::f64::consts::{PI, TAU};

use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};

use crate::names;
use crate::system::Scales;

names! { name:
    /// What a record, or a spectrum, is of.
    #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
    pub enum RecordQuantity {
        /// The acceleration of the base.
        BaseAcceleration = "base-acceleration",
        /// The displacement of the base.
        BaseDisplacement = "base-displacement",
        /// The force on the oscillator's mass.
        Force = "force",
    }
}

/// Values over time, linear between samples; at least two, times ascend. SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// What it is of.
    pub quantity: RecordQuantity,
    /// Time and value.
    pub samples: Vec<[f64; 2]>,
    /// Velocity of the base at the first sample of its acceleration; 0 where it was at rest. Noise that has no beginning has
    /// the one with which the base goes nowhere.
    pub base_velocity: f64,
}

/// A stretch of time in which the excitation is linear, in fast time and over the clearance. Seen from the base the
/// structure obeys `x'' + eps lambda x' + x = f`, and where the base shakes a free absorber obeys `y'' = f`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// How long it is.
    pub duration: f64,
    /// By how much the velocities of all masses against the base change at its beginning.
    pub jump: f64,
    /// `f` at its beginning, and its slope.
    pub force: [f64; 2],
    /// Whether `f` is the inertia of everything on a base that shakes, not a force on the structure alone.
    pub shakes: bool,
    /// Velocity of the base at its beginning; 0 under a force.
    pub base: f64,
    /// 0 while the record lasts. Behind its end nothing drives any more, and the structure rings on in pieces like this one
    /// until nothing that is measured of it can become larger, for so long at the most.
    pub rings: f64,
}

impl Piece {
    /// Whether nothing drives any more.
    pub const fn is_rest(&self) -> bool {
        self.rings > 0.0
    }
}

impl Record {
    /// The longest piece: the motion is measured at the ends of pieces, by cubics in between. A piece of `h` leaves
    /// the peak an error of `h^4/384` of itself, and the motion that of [`Piece`]'s flight.
    pub const LONGEST: f64 = 0.2;

    /// Oscillations after the end for which a motion is followed at the most: one that nothing damps goes on for ever.
    pub const MOST_RINGING: f64 = 1000.0;

    /// The record in pieces of at most so long a fast time, each within two samples.
    ///
    /// Relative to the base the motion follows from the base's acceleration alone. A record of the acceleration is
    /// therefore used as it is: a constant velocity of the base, into which an offset or a missing start of the
    /// record integrates, changes nothing, and nothing is removed. The base of a record of its displacement moves at
    /// a constant velocity between samples, so that all there is to its acceleration are the jumps of that velocity.
    pub fn pieces(&self, scales: &Scales, longest: f64) -> Vec<Piece> {
        let mut pieces = Vec::new();
        let mut velocity = 0.0;
        let shakes = self.quantity != RecordQuantity::Force;
        let begins = if shakes { self.base_velocity } else { 0.0 };
        let mut base = begins / scales.velocity(1.0);
        for two in self.samples.windows(2) {
            let duration = (two[1][0] - two[0][0]) / scales.time(1.0);
            let [from, to] = [two[0][1], two[1][1]].map(|value| self.reduced(scales, value));
            let count = libm::ceil(duration / longest).max(1.0);
            let step = duration / count;
            let displaced = self.quantity == RecordQuantity::BaseDisplacement;
            let slope = (to - from) / duration;
            for k in 0..count as u64 {
                let force = match displaced {
                    true => [0.0; 2],
                    false => [from + slope * step * k as f64, slope],
                };
                let jump = if displaced && k == 0 { velocity - slope } else { 0.0 };
                if displaced {
                    base = slope;
                }
                pieces.push(Piece { duration: step, jump, force, shakes, base, rings: 0.0 });
                if shakes && !displaced {
                    base -= step * (force[0] + 0.5 * slope * step);
                }
            }
            velocity = slope;
        }
        pieces
    }

    /// The same, and behind them the piece in which the structure rings on: no force acts, and the base moves evenly as its
    /// last acceleration left it, or stays where the record of its displacement ends.
    pub fn pieces_to_rest(&self, scales: &Scales, longest: f64) -> Vec<Piece> {
        let mut pieces = self.pieces(scales, longest);
        let displaced = self.quantity == RecordQuantity::BaseDisplacement;
        let after = pieces.last().map(|last| {
            let [force, slope] = last.force;
            let gained = if last.shakes {
                last.duration * (force + 0.5 * slope * last.duration)
            } else {
                0.0
            };
            let base = if displaced { 0.0 } else { last.base - gained };
            let jump = if displaced { last.base } else { 0.0 };
            Piece {
                duration: longest,
                jump,
                force: [0.0; 2],
                shakes: last.shakes,
                base,
                rings: TAU * Self::MOST_RINGING,
            }
        });
        pieces.extend(after);
        pieces
    }

    /// How many pieces of at most [`Self::LONGEST`] the record has.
    pub fn count(&self, scales: &Scales) -> u64 {
        let longest = scales.time(Self::LONGEST);
        let pieces = |two: &[[f64; 2]]| libm::ceil((two[1][0] - two[0][0]) / longest).max(1.0);
        self.samples.windows(2).map(pieces).sum::<f64>() as u64
    }

    /// A value, dimensionless: displacement of the base, else `f` of [`Piece`].
    pub fn reduced(&self, scales: &Scales, value: f64) -> f64 {
        let acceleration = scales.acceleration(1.0);
        match self.quantity {
            RecordQuantity::BaseAcceleration => -value / acceleration,
            RecordQuantity::BaseDisplacement => scales.over_clearance(value),
            RecordQuantity::Force => value / (scales.oscillator_mass * acceleration),
        }
    }

    /// Largest absolute value, in the unit of the record.
    pub fn peak(&self) -> f64 {
        self.samples.iter().map(|sample| sample[1].abs()).fold(0.0, f64::max)
    }
}

/// Gaussian noise of a one-sided power spectral density.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// Frequency in Hz, ascending, and density in the squared unit of the quantity per Hz: straight between two of
    /// them on logarithmic scales, nothing outside.
    pub corners: Vec<[f64; 2]>,
    /// Seconds.
    pub duration: f64,
    /// What the random numbers begin with.
    pub seed: u64,
    /// How many records are made of it.
    pub realisations: u64,
}

impl Spectrum {
    /// Samples in a period of the highest frequency: straight lines between them take 0.3 % of its amplitude.
    const SAMPLES: f64 = 32.0;

    /// Lines of the spectrum that a record has, at multiples of one over its duration.
    pub fn lines(&self) -> std::ops::RangeInclusive<u64> {
        let [first, last] = [self.corners.first(), self.corners.last()]
            .map(|corner| corner.map_or(0.0, |corner| corner[0] * self.duration));
        libm::ceil(first).max(1.0) as u64..=libm::floor(last) as u64
    }

    /// Samples of a record.
    pub fn samples(&self) -> u64 {
        (libm::ceil(Self::SAMPLES * *self.lines().end() as f64) as u64).saturating_add(1)
    }

    /// The records.
    pub fn records(&self, quantity: RecordQuantity) -> impl Iterator<Item = Record> + '_ {
        let mut next = Xoshiro256PlusPlus::seed_from_u64(self.seed);
        (0..self.realisations).map(move |_| {
            let mut random = next.clone();
            next.jump();
            let (samples, offset) = self.realisation(&mut random);
            let base_velocity = match quantity {
                RecordQuantity::BaseAcceleration => offset,
                RecordQuantity::BaseDisplacement | RecordQuantity::Force => 0.0,
            };
            Record { quantity, samples, base_velocity }
        })
    }

    /// Every line has a sine and a cosine whose amplitudes are normally distributed. With the samples the value at the
    /// beginning of their integral of mean zero, that of `b sin` being `-b/omega cos`.
    fn realisation(&self, random: &mut Xoshiro256PlusPlus) -> (Vec<[f64; 2]>, f64) {
        let count = self.samples();
        let step = self.duration / (count - 1) as f64;
        let mut samples: Vec<[f64; 2]> = (0..count).map(|k| [k as f64 * step, 0.0]).collect();
        let mut offset = 0.0;
        for line in self.lines() {
            let frequency = line as f64 / self.duration;
            let deviation = (self.density(frequency) / self.duration).sqrt();
            let [mut cosine, mut sine] = normal(random).map(|one| one * deviation);
            offset -= sine / (TAU * frequency);
            let (turn_sine, turn_cosine) = libm::sincos(TAU * frequency * step);
            for sample in &mut samples {
                sample[1] += cosine;
                [cosine, sine] = [
                    cosine * turn_cosine + sine * turn_sine,
                    sine * turn_cosine - cosine * turn_sine,
                ];
            }
        }
        (samples, offset)
    }

    /// The density at a frequency between the first and the last corner, in the unit of its corners.
    pub fn density(&self, frequency: f64) -> f64 {
        let above = self.corners.partition_point(|corner| corner[0] < frequency);
        let above = above.clamp(1, self.corners.len() - 1);
        let [[from, first], [to, second]] = [self.corners[above - 1], self.corners[above]];
        let part = libm::log(frequency / from) / libm::log(to / from);
        first * libm::pow(second / first, part)
    }
}

/// Two independent numbers of a normal distribution (Box and Muller 1958).
fn normal(random: &mut Xoshiro256PlusPlus) -> [f64; 2] {
    // Above 0, at most 1.
    let mut uniform = || ((random.next_u64() >> 11) + 1) as f64 / (1_u64 << 53) as f64;
    let radius = (-2.0 * libm::log(uniform())).sqrt();
    let (sine, cosine) = libm::sincos(2.0 * PI * uniform());
    [radius * cosine, radius * sine]
}
