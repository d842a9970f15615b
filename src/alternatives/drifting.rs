//! What alternatives need of a structure, of one mode or of several.

use super::{Room, larger};
use crate::dampers::{Designing, best_together, more_damped};
use crate::executor::Executor;
use crate::linear::TunedMassDamper;

/// Tuned mass dampers that are used together, or one.
pub trait Dampers: Clone + Send + Sync {
    /// Relative error of their design and of what they do.
    const DESIGN: f64;

    /// Each, over the frequency that it is for.
    fn each(&self) -> Vec<TunedMassDamper>;

    /// As many at the same places.
    fn with(&self, each: &[TunedMassDamper]) -> Self;

    /// The same with so many times their own frequencies.
    fn retuned(&self, factor: f64) -> Self {
        let changed = |one: TunedMassDamper| TunedMassDamper { tuning: factor * one.tuning, ..one };
        self.with(&self.each().into_iter().map(changed).collect::<Vec<_>>())
    }
}

/// How much more than its room a penalty takes the stroke of a damper for: an optimum at the edge stays there.
const PENALTY: f64 = 20.0;
/// Dampers from the best of which one for little room is looked for: tunings over the usual one, and so many steps of equal
/// ratio from its damping to a heavy one.
const TUNINGS: [f64; 3] = [0.95, 1.0, 1.05];
const DAMPINGS: u32 = 8;
const HEAVY: f64 = 4.0;

/// A structure whose natural frequencies may be off, which no device was told.
pub(crate) trait Drifting: Sized {
    /// Its linear devices.
    type Dampers: Dampers;
    /// Why a motion of its absorbers cannot be flown.
    type Error;

    /// The same where the natural frequencies of the case are multiplied by a factor; none where there is no such structure.
    fn drifted(&self, factor: f64) -> Option<Self>;

    /// Distance from the middle to a wall, of several absorbers the largest; in SI or the units of a reduced case.
    fn room(&self) -> f64;

    /// Whether it is driven steadily, and at one frequency alone.
    fn is_of_one_frequency(&self) -> bool;

    /// Whether dampers that hit stops are simulated.
    fn has_stops(&self) -> bool;

    /// How dampers are designed for it: what is long is evaluated less often.
    fn designing(&self) -> Designing;

    /// What is asked with dampers that were designed for the case, or without, and their largest stroke; in SI or the units of
    /// a reduced case.
    fn told(&self, dampers: Option<&Self::Dampers>, room: Room) -> [f64; 2];

    /// What a design makes small, and the largest stroke.
    fn cost(&self, dampers: &Self::Dampers) -> [f64; 2] {
        self.told(Some(dampers), Room::AsDesigned)
    }

    /// What is asked with the absorbers, and its error.
    ///
    /// # Errors
    /// Where a motion cannot be flown.
    fn absorber(&self, on: &dyn Executor) -> Result<Option<[f64; 2]>, Self::Error>;

    /// Dampers like these whose worst over this structure and others is smallest, as designed or with strokes within the room
    /// of the absorbers, of a damping ratio that may be given.
    ///
    /// For a single frequency the best would be undamped, and of no use beside it: those that are given keep their tunings, and
    /// get that damping ratio or as much more as their room asks for.
    fn designed(
        &self,
        others: &[&Self],
        from: &Self::Dampers,
        room: Room,
        damping: Option<f64>,
    ) -> Self::Dampers {
        let all: Vec<&Self> = others.iter().copied().chain([self]).collect();
        let within = match room {
            Room::AsDesigned => f64::INFINITY,
            _ => self.room(),
        };
        let worst = |each: &[TunedMassDamper]| {
            let dampers = from.with(each);
            let found = all.iter().map(|one| one.cost(&dampers));
            found.reduce(larger).unwrap_or([f64::INFINITY; 2])
        };
        let own = from.each();
        if self.is_of_one_frequency() {
            let given = damping.map(|damping_ratio| {
                own.iter().map(|one| TunedMassDamper { damping_ratio, ..*one }).collect::<Vec<_>>()
            });
            let fits = |each: &[TunedMassDamper]| {
                self.told(Some(&from.with(each)), Room::AsDesigned)[1] <= within
            };
            return from.with(&given.unwrap_or_else(|| more_damped(&own, fits)));
        }
        let how = Designing { damping, ..self.designing() };
        let cost = |each: &[TunedMassDamper]| {
            let [worst, stroke] = worst(each);
            worst * (1.0 + PENALTY * (stroke / within - 1.0).max(0.0))
        };
        if within.is_infinite() {
            return from.with(&best_together(&own, how, cost));
        }
        // What keeps a damper in little room may be far from what it does with much: from its damping up to a multiple of the
        // critical one.
        let heavier = |one: &TunedMassDamper, k: u32| {
            let ratio = HEAVY / one.damping_ratio.clamp(1e-6, 0.5 * HEAVY);
            one.damping_ratio * libm::pow(ratio, f64::from(k) / f64::from(DAMPINGS))
        };
        let first = TUNINGS.iter().flat_map(|tuning| {
            let own = &own;
            (0..=DAMPINGS).map(move |k| {
                let with = |one: &TunedMassDamper| TunedMassDamper {
                    tuning: tuning * one.tuning,
                    damping_ratio: heavier(one, k),
                };
                own.iter().map(with).collect::<Vec<_>>()
            })
        });
        let first = first.chain([own.clone()]).min_by(|a, b| cost(a).total_cmp(&cost(b)));
        let found = best_together(&first.unwrap_or(own), how, cost);
        let fits =
            |each: &[TunedMassDamper]| worst(each)[1] <= (1.0 + Self::Dampers::DESIGN) * within;
        from.with(&more_damped(&found, fits))
    }
}
