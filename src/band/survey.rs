//! All that is known along a band, found once: areas, stability, rivals, the smallest gap, the motions that
//! simulation finds, and the worst of them all. `check`, `optimize`, the report and the index take their
//! values from here, so that no two of them can differ.

use super::exact::{self, Extreme};
use super::rivals::{DETUNED, Rivals};
use super::simulated::{self, Place, Sampling};
use super::{Band, Inactive, Stretch, inactive, margin, theory};
use crate::analysis::{Strip, Zone};
use crate::executor::Executor;
use crate::regimes::Motion;
use crate::simulation::StartError;

/// What a survey looks at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurveySettings {
    /// Whether, and how thoroughly, the band is simulated.
    pub sampling: Option<Sampling>,
    /// Whether an absorber at rest that never wakes is one of the motions.
    pub count_inactive: bool,
}

/// What is known along a band. Lengths over the clearance; places are `Omega`, or the amplitude over the
/// base system's.
#[derive(Debug, Clone, PartialEq)]
pub struct Survey {
    /// The motions that can happen.
    pub motions: Motions,
    /// The theory's areas and strips.
    pub zones: Vec<Stretch<Zone>>,
    /// The bare oscillator and the tuned mass damper of the absorber's mass.
    pub rivals: Rivals,
    /// Where the clearance may be off least before the stable 1:1 motion is lost, and by which share; 0
    /// where there is none.
    pub smallest_gap: (f64, f64),
    /// The worst motion where the structure's natural frequency is off by [`super::rivals::DETUNED`]; empty
    /// where that was not asked for.
    pub detuned: Vec<Option<Worst>>,
}

/// The motions that can happen along a band.
#[derive(Debug, Clone, PartialEq)]
pub struct Motions {
    /// The band.
    pub band: Band,
    /// Where a symmetric 1:1 orbit attracts.
    pub stability: Vec<Stretch<bool>>,
    /// Its peak displacement; none where it attracts nowhere.
    pub orbit: Option<Extreme>,
    /// What simulation finds; empty where nothing was simulated.
    pub places: Vec<Place>,
    /// By how much the largest peak between places may exceed that at them.
    pub unresolved: f64,
    /// Where the structure with an absorber that never wakes vibrates most, and that motion.
    pub inactive: Option<(f64, Inactive)>,
    /// Whether that motion counts.
    pub count_inactive: bool,
}

/// The motion that is worst along a band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// The exact symmetric 1:1 orbit.
    Orbit,
    /// A motion that was simulated.
    Simulated(Motion),
    /// That of an absorber which stays at rest.
    Inactive(Inactive),
}

/// The largest displacement along a band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worst {
    /// Where.
    pub at: f64,
    /// Peak displacement over the clearance.
    pub peak: f64,
    /// How much larger it may be: the error of a chaotic peak, or what lies between places.
    pub error: f64,
    /// Of which motion.
    pub of: Source,
}

impl Survey {
    /// Looks along a band.
    ///
    /// # Errors
    /// [`StartError`] where a start of a simulation is not finite.
    pub fn of(
        band: &Band,
        settings: &SurveySettings,
        executor: &dyn Executor,
    ) -> Result<Self, StartError> {
        Ok(Self {
            motions: Motions::of(band, settings, executor)?,
            zones: theory::zones(band),
            rivals: Rivals::along(band),
            smallest_gap: margin::smallest(band),
            detuned: Vec::new(),
        })
    }

    /// The same with what happens where the structure's natural frequency is off.
    ///
    /// # Errors
    /// As [`Survey::of`].
    pub fn with_detuned(
        mut self,
        settings: &SurveySettings,
        executor: &dyn Executor,
    ) -> Result<Self, StartError> {
        for factor in DETUNED {
            let band = self.band().with_structure_detuned(factor);
            let motions = band.map(|band| Motions::of(&band, settings, executor)).transpose()?;
            self.detuned.push(motions.and_then(|motions| motions.worst()));
        }
        Ok(self)
    }

    /// The band.
    pub fn band(&self) -> &Band {
        &self.motions.band
    }

    /// Share in area Z3 of the theory, strips included.
    pub fn z3_share(&self) -> f64 {
        self.band().share(&self.zones, |zone| zone.is_z3())
    }

    /// Share in a strip of it.
    pub fn strip_share(&self, strip: Strip) -> f64 {
        self.band().share(&self.zones, |zone| zone.strip == Some(strip))
    }
}

impl Motions {
    /// Looks for the motions along a band.
    ///
    /// # Errors
    /// [`StartError`] where a start of a simulation is not finite.
    pub fn of(
        band: &Band,
        settings: &SurveySettings,
        executor: &dyn Executor,
    ) -> Result<Self, StartError> {
        let stability = exact::stability(band);
        let sampled = settings
            .sampling
            .map(|sampling| simulated::along(band, &stability, &sampling, executor))
            .transpose()?;
        let (places, unresolved) = sampled.unwrap_or_default();
        Ok(Self {
            orbit: exact::extreme(band, &stability, |_, orbit| orbit.peaks.displacement),
            places,
            unresolved,
            inactive: inactive::worst(band),
            count_inactive: settings.count_inactive,
            stability,
            band: band.clone(),
        })
    }

    /// The largest peak displacement of every motion that can happen; its error covers the peaks of all
    /// others with theirs. `None` where none is known.
    pub fn worst(&self) -> Option<Worst> {
        let orbit = self.orbit.map(|orbit| Worst {
            at: orbit.at,
            peak: orbit.largest,
            error: 0.0,
            of: Source::Orbit,
        });
        let simulated = self.places.iter().flat_map(|place| {
            place.beside_orbit().map(|motion| Worst {
                at: place.at,
                peak: motion.peak,
                error: motion.peak_error.max(self.unresolved),
                of: Source::Simulated(*motion),
            })
        });
        let all: Vec<Worst> = simulated.chain(orbit).chain(self.worst_inactive()).collect();
        let worst = *all.iter().max_by(|a, b| a.peak.total_cmp(&b.peak))?;
        let reach = all.iter().map(|one| one.peak + one.error).fold(0.0, f64::max);
        Some(Worst { error: reach - worst.peak, ..worst })
    }

    /// That of an inactive absorber, where it counts.
    pub fn worst_inactive(&self) -> Option<Worst> {
        let (at, inactive) = self.inactive.filter(|_| self.count_inactive)?;
        Some(Worst { at, peak: inactive.peak, error: 0.0, of: Source::Inactive(inactive) })
    }

    /// Share with an attracting symmetric 1:1 orbit.
    pub fn stable_share(&self) -> f64 {
        self.band.share(&self.stability, |stable| *stable)
    }
}
