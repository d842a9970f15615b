//! All that is known along a band, found once: areas, stability, rivals, the smallest gap, the motions that can happen, and
//! the worst of them all. Every command takes its values from here, so that no two of them can differ.

use std::sync::OnceLock;

use super::rivals::Rivals;
use super::{Band, Stretch, margin, theory};
use crate::analysis::{Strip, Zone};
use crate::dampers::SineLimits;
use crate::executor::Executor;
use crate::linear::bare_along;
use crate::motions::{Along, Effort, Extreme, Misses, Motion, Motions, Value, along, along_until};
use crate::simulation::StartError;

/// What a survey looks at.
#[derive(Debug, Clone, PartialEq)]
pub struct SurveySettings {
    /// Whether, and how thoroughly, motions are simulated.
    pub effort: Option<Effort>,
    /// Where else motions are looked for: where these are extreme.
    pub extremes: Vec<Extreme>,
    /// Whether an absorber that stays at rest is one of the motions.
    pub count_rest: bool,
    /// What the tuned mass damper beside the absorber is designed for.
    pub asked: SineLimits,
}

/// What is known along a band. Lengths over the clearance; places are `Omega`, or the amplitude over the
/// base system's.
#[derive(Debug, Clone, PartialEq)]
pub struct Survey {
    /// The motions that can happen.
    pub motions: Along,
    /// Whether an absorber that stays at rest counts.
    pub count_rest: bool,
    /// What the tuned mass damper beside the absorber is designed for.
    asked: SineLimits,
    /// What else is known, worked out where somebody asks.
    zones: OnceLock<Vec<Stretch<Zone>>>,
    bare: OnceLock<(f64, f64)>,
    rivals: OnceLock<Rivals>,
    least_moved: OnceLock<f64>,
    smallest_gap: OnceLock<(f64, f64)>,
}

/// The motion with the largest displacement along a band.
#[derive(Debug, Clone, PartialEq)]
pub struct Worst {
    /// Where.
    pub at: f64,
    /// The motion.
    pub motion: Motion,
    /// Its place in the list there.
    pub index: usize,
    /// Its peak displacement over the clearance; the error covers the peaks of all others with theirs, and what lies
    /// between places.
    pub peak: Value,
}

impl Survey {
    /// Looks along a band, `own` being the motions at its own excitation where they are known.
    ///
    /// # Errors
    /// [`StartError`] where a start of a simulation is not finite.
    pub fn of(
        band: &Band,
        settings: &SurveySettings,
        own: Option<&Motions>,
        executor: &dyn Executor,
    ) -> Result<Self, StartError> {
        let SurveySettings { effort, extremes, .. } = settings;
        Ok(Self::with(settings, along(band, extremes, own, effort.as_ref(), executor)?))
    }

    /// The same that ends with the first place at which something is missed, if one is given that says so.
    ///
    /// # Errors
    /// As [`Survey::of`].
    pub fn until(
        band: &Band,
        settings: &SurveySettings,
        misses: Option<&Misses<'_, Motions>>,
        executor: &dyn Executor,
    ) -> Result<Self, StartError> {
        let SurveySettings { effort, extremes, .. } = settings;
        let motions = along_until(band, extremes, None, effort.as_ref(), misses, executor)?;
        Ok(Self::with(settings, motions))
    }

    fn with(SurveySettings { count_rest, asked, .. }: &SurveySettings, motions: Along) -> Self {
        Self {
            motions,
            count_rest: *count_rest,
            asked: asked.clone(),
            zones: OnceLock::new(),
            bare: OnceLock::new(),
            rivals: OnceLock::new(),
            least_moved: OnceLock::new(),
            smallest_gap: OnceLock::new(),
        }
    }

    /// The band.
    pub fn band(&self) -> &Band {
        self.motions.band()
    }

    /// The theory's areas and strips.
    pub fn zones(&self) -> &[Stretch<Zone>] {
        self.zones.get_or_init(|| theory::zones(self.band()))
    }

    /// Share in area Z3 of the theory, strips included.
    pub fn z3_share(&self) -> f64 {
        self.band().share(self.zones(), |zone| zone.is_z3())
    }

    /// Share in a strip of it.
    pub fn strip_share(&self, strip: Strip) -> f64 {
        self.band().share(self.zones(), |zone| zone.strip == Some(strip))
    }

    /// Where the structure alone moves farthest, and how far; infinite where nothing limits it.
    pub fn bare(&self) -> (f64, f64) {
        *self.bare.get_or_init(|| bare_along(self.band()))
    }

    /// The structure alone, and the tuned mass damper of the absorber's mass that is best for what is asked.
    pub fn rivals(&self) -> &Rivals {
        self.rivals.get_or_init(|| Rivals::along(self.band(), &self.asked))
    }

    /// The largest amplitude with the damper that lets the structure move least, whatever is asked.
    pub fn least_moved(&self) -> f64 {
        let by_any = || Rivals::of_displacement(self.band()).damped.amplitude;
        match self.asked.is_of_displacement() {
            true => self.rivals().damped.amplitude,
            false => *self.least_moved.get_or_init(by_any),
        }
    }

    /// Where the clearance may be off least before the stable 1:1 motion is lost, and by which share; 0
    /// where there is none.
    pub fn smallest_gap(&self) -> (f64, f64) {
        *self.smallest_gap.get_or_init(|| margin::smallest(self.band()))
    }

    /// The worst of the motions that count.
    pub fn worst(&self) -> Option<Worst> {
        Worst::of(&self.motions, self.count_rest)
    }
}

impl Worst {
    /// That of the motions along a band which count; `None` where none is known.
    pub fn of(motions: &Along, count_rest: bool) -> Option<Self> {
        let all = || motions.counting(count_rest).map(|one| (one, motions.peak_of(one.2)));
        let ((at, index, motion), Value { value, .. }) =
            all().max_by(|a, b| a.1.value.total_cmp(&b.1.value))?;
        let reach = all().map(|(_, peak)| peak.value + peak.error).fold(0.0, f64::max);
        let peak = Value { value, error: reach - value };
        Some(Self { at, index, motion: motion.clone(), peak })
    }
}
