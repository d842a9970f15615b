//! A released structure with everything that is known of it: from all places of the absorber, beside its
//! alternatives and theory.

use super::runs::shaken;
use super::{Run, Runs, WithError};
use std::sync::OnceLock;

use crate::case::Case;
use crate::dampers;
use crate::excitation::{Release, amplitude};
use crate::executor::{Executor, Serial};
use crate::flights::{Inactive, Places, Predicted, Ringdown, inactive, survey, worst_of_places};
use crate::linear::{Linear, STEPS, TunedMassDamper, bare_decay, released};
use crate::measure::Measure;
use crate::quantity::Units;
use crate::simulation::{Impact, StartError};
use crate::system::{Shaking, State, System};

/// How fast a structure comes to a level from one place of the absorber.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decay {
    /// Oscillations of the structure; infinite where it did not get there.
    pub oscillations: f64,
    /// Impacts until then.
    pub impacts: u64,
    /// Largest relative speed of one of them, over the clearance in fast time.
    pub impact_speed: f64,
    /// Share of the energy that they took.
    pub impact_share: f64,
    /// Largest displacement of the structure.
    pub peak: f64,
    /// Largest velocity and acceleration of the structure; none where they were not asked for.
    pub shaking: Option<Shaking>,
    /// Whether there was any impact, then or later.
    pub wakes: bool,
}

/// A structure that was released.
#[derive(Debug, Clone)]
pub struct DecayStudy {
    /// The system; its excitation does not matter.
    pub system: System,
    /// Amplitude at the start and the level that is asked for, over the clearance.
    pub from: f64,
    /// See [`Self::from`].
    pub level: f64,
    /// Every start; of a measure those count that wake the absorber.
    pub starts: Runs<Decay>,
    /// What happened from the slowest of them.
    pub slowest_start: Option<Ringdown>,
    /// The structure alone: decay in closed form.
    pub bare: f64,
    /// The absorber's resting places at which no wall ever reaches it, so that the structure is as good as alone.
    pub inactive: Inactive,
    /// Whether such a start counts.
    pub count_inactive: bool,
    /// Where it begins, the absorber in the middle.
    start: State,
    /// The structure with the tuned mass damper, once somebody asks.
    damped: OnceLock<(TunedMassDamper, Linear)>,
    /// Theory.
    pub predicted: Predicted,
}

/// Oscillations after which a decay is given up whose structure has hardly any damping of its own.
const LONGEST: f64 = 20_000.0;

impl DecayStudy {
    /// Studies a release down to a share of its amplitude, from places of the absorber in its cavity.
    ///
    /// # Errors
    /// [`StartError`] where the motion is so large that rounding hides the walls.
    pub fn of(
        system: &System,
        units: &Units,
        release: &Release,
        share: f64,
        places: Places<'_>,
    ) -> Result<Self, StartError> {
        let study = Self::without_theory(system, units, release, share, places)?;
        Ok(Self { predicted: Predicted::of(system, study.from, study.level), ..study })
    }

    /// The same without what theory predicts, which may take longer than all starts.
    pub(crate) fn without_theory(
        system: &System,
        units: &Units,
        release: &Release,
        share: f64,
        places: Places<'_>,
    ) -> Result<Self, StartError> {
        let middle = release.state(units, 0.0);
        let from = amplitude(&middle);
        let level = share * from;
        let bare = bare_decay(system, share);
        let inactive = inactive(system, &middle);
        let starts = Self::starts(system, units, release, share, places)?;
        let follow = |(w, _): &(f64, Decay)| {
            Ringdown::follow(system, release.state(units, *w), level, longest(bare))
        };
        Ok(Self {
            system: *system,
            from,
            level,
            slowest_start: starts.worst(Measure::DecayTime).map(follow).transpose()?,
            starts,
            bare,
            inactive,
            count_inactive: true,
            start: middle,
            damped: OnceLock::new(),
            predicted: Predicted::none(system),
        })
    }

    /// The same where an absorber that no wall reaches counts or not, with what theory predicts.
    pub(super) fn counting(self, count_inactive: bool, predicted: Predicted) -> Self {
        Self { count_inactive, predicted, ..self }
    }

    /// The tuned mass damper of the absorber's mass that comes down to the level fastest, and the structure with it.
    pub fn damped(&self) -> &(TunedMassDamper, Linear) {
        self.damped.get_or_init(|| {
            let (system, longest) = (&self.system, longest(self.bare));
            let damper = dampers::for_release(system, self.start, self.level / self.from, longest);
            (damper, released(system, Some(&damper), self.start, self.level, longest))
        })
    }

    /// The same for a case that is released; none for another.
    ///
    /// # Errors
    /// As [`Self::of`].
    pub fn of_case(case: &Case, executor: &dyn Executor) -> Option<Result<Self, StartError>> {
        let places = u32::try_from(case.absorber_places()?).unwrap_or(u32::MAX);
        Self::of_case_from(case, places, executor)
    }

    /// About how many oscillations a start of a case is followed for; none for a case that is not released.
    pub fn oscillations(case: &Case) -> Option<u64> {
        case.design.release()?;
        Some(libm::ceil(followed(bare_decay(&case.system(), case.decay_level))) as u64)
    }

    /// The same by theory alone: nothing is simulated.
    pub fn by_theory(case: &Case) -> Option<Self> {
        Self::of_case_from(case, 0, &Serial)?.ok()
    }

    fn of_case_from(
        case: &Case,
        starts: u32,
        executor: &dyn Executor,
    ) -> Option<Result<Self, StartError>> {
        let release = case.design.release()?;
        let (system, units) = (case.system(), case.units());
        let (even, shaking) = (starts.into(), case.asks_for_shaking());
        let places = Places { even, closer: true, shaking, executor };
        let study = Self::of(&system, &units, &release, case.decay_level, places);
        Some(study.map(|study| Self { count_inactive: case.count_inactive, ..study }))
    }

    /// Every start by itself.
    pub(super) fn starts(
        system: &System,
        units: &Units,
        release: &Release,
        share: f64,
        places: Places<'_>,
    ) -> Result<Runs<Decay>, StartError> {
        let level = share * amplitude(&release.state(units, 0.0));
        let longest = longest(bare_decay(system, share));
        let awake = |of: fn(&Decay) -> f64| {
            move |start: &Decay| if start.wakes { of(start) } else { f64::NAN }
        };
        let times = awake(|start| start.oscillations);
        let speeds = awake(|start| start.impact_speed);
        let all = survey(places, &[&times, &speeds], |w| {
            let start = release.state(units, w);
            let frame = places.shaking.then(|| release.frame_velocity(units));
            let told = &mut |_: &Impact| {};
            let found = Ringdown::follow_telling(system, start, level, longest, frame, told)?;
            Ok(Decay::of(&found))
        })?;
        Ok(Runs { all, even: places.even, count_inactive: false })
    }

    /// The start that takes longest among those that wake the absorber, any where none does; none where nothing was
    /// simulated.
    pub fn worst(&self) -> Option<&(f64, Decay)> {
        self.starts.worst(Measure::DecayTime)
    }

    /// The time to come to rest that counts, in oscillations, and what it is of.
    pub fn decay(&self) -> DecayTime {
        DecayTime::of(&self.starts, self.bare, self.count_inactive, &self.inactive)
    }
}

/// The time to come to rest that counts, in oscillations: of the slowest start, or that of the structure alone where it is
/// slower and an absorber that no wall reaches counts, or none is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DecayTime {
    /// Oscillations, and by how much those of other places may exceed them.
    pub oscillations: WithError,
    /// Whether it is that of an absorber that no wall reaches, and so of the structure alone.
    pub inactive: bool,
}

impl DecayTime {
    pub(super) fn of(
        starts: &Runs<Decay>,
        alone: f64,
        count_inactive: bool,
        inactive: &Inactive,
    ) -> Self {
        let awake = starts.all.iter().filter(|(_, start)| start.wakes);
        let times: Vec<f64> = awake.map(|(_, start)| start.oscillations).collect();
        let [slowest, error] = worst_of_places(&times);
        let alone_counts = count_inactive && inactive.share > 0.0 || times.is_empty();
        match alone_counts && alone > slowest {
            true => Self { oscillations: [alone, 0.0], inactive: true },
            false => Self { oscillations: [slowest, error], inactive: false },
        }
    }
}

impl Decay {
    fn of(found: &Ringdown) -> Self {
        let last = found.impacts.len() - 1;
        // As usize an infinite time is past the end.
        let at = (libm::ceil(found.settles * f64::from(STEPS)) as usize).min(last);
        Self {
            oscillations: found.settles,
            impacts: found.impacts[at],
            impact_speed: found.impact_speeds[at],
            impact_share: found.taken[at],
            peak: found.peak,
            shaking: found.shaking,
            wakes: found.impacts[last] > 0,
        }
    }
}

impl Run for Decay {
    fn get(&self, of: Measure) -> Option<f64> {
        Some(match of {
            Measure::DecayTime => self.oscillations,
            Measure::Peak => self.peak,
            Measure::ImpactSpeed => self.impact_speed,
            Measure::Impacts => self.impacts as f64,
            Measure::ImpactEnergyShare => self.impact_share,
            _ => return shaken(self.shaking.as_ref(), of),
        })
    }

    fn wakes(&self) -> bool {
        self.wakes
    }
}

/// About how many oscillations a decay is followed for, by those of the structure alone.
pub(crate) fn followed(bare: f64) -> f64 {
    bare.min(longest(bare) as f64)
}

/// Oscillations that a decay is followed for at the most.
pub(crate) fn longest(bare: f64) -> u64 {
    libm::ceil((1.5 * bare).min(LONGEST)) as u64 + 20
}

#[cfg(test)]
mod tests {
    use super::{Decay, DecayTime, Inactive, Runs};

    fn start(oscillations: f64, wakes: bool) -> (f64, Decay) {
        let (impacts, impact_speed, impact_share, peak) = (1, 1.0, 0.5, 1.0);
        let decay =
            Decay { oscillations, impacts, impact_speed, impact_share, peak, shaking: None, wakes };
        (0.0, decay)
    }

    /// An absorber may also hold a structure up: then its slowest start counts, not the structure alone.
    #[test]
    fn the_structure_alone_counts_where_it_is_slower() {
        let starts = [start(8.0, true), start(12.0, true), start(99.0, false)];
        let some = Inactive { share: 0.1, places: None };
        let of = |starts: &[(f64, Decay)], alone, counts| {
            let starts = Runs { all: starts.to_vec(), even: 3, count_inactive: false };
            DecayTime::of(&starts, alone, counts, &some)
        };
        assert_eq!(
            (of(&starts, 10.0, true).oscillations[0], of(&starts, 10.0, true).inactive),
            (12.0, false)
        );
        assert_eq!(
            of(&starts, 20.0, true),
            DecayTime { oscillations: [20.0, 0.0], inactive: true }
        );
        assert_eq!(of(&starts, 20.0, false).oscillations[0], 12.0);
        assert!(of(&starts[2..], 20.0, false).inactive);
    }
}
