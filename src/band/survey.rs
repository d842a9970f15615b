//! All that is known along a band, found once: areas, stability, amplitudes against the rivals, the
//! smallest gap, and the motions that simulation finds.

use super::exact::{self, Extreme};
use super::rivals::{Rival, TunedMassDamper, bare_amplitude};
use super::simulated::{self, Place};
use super::{Band, Stretch, margin, theory};
use crate::analysis::{Strip, Zone};
use crate::regimes::long_term::Effort;
use crate::simulation::StartError;

/// What is known along a band. Lengths over the clearance; places are `Omega`, or the amplitude over the
/// base system's.
#[derive(Debug, Clone, PartialEq)]
pub struct Survey {
    /// The band.
    pub band: Band,
    /// The theory's areas and strips.
    pub zones: Vec<Stretch<Zone>>,
    /// Where a symmetric 1:1 orbit attracts.
    pub stability: Vec<Stretch<bool>>,
    /// Its peak displacement; none where it attracts nowhere.
    pub orbit: Option<Extreme>,
    /// The bare oscillator.
    pub bare: Rival,
    /// One with the best tuned mass damper of the absorber's mass.
    pub damper: Rival,
    /// Where the clearance may be off least before the stable 1:1 motion is lost, and by which share; 0
    /// where there is none.
    pub smallest_gap: (f64, f64),
    /// What simulation finds; empty where nothing was simulated.
    pub simulated: Vec<Place>,
}

impl Survey {
    /// Looks along a band, with simulation or without.
    ///
    /// # Errors
    /// [`StartError`] where a start of a simulation is not finite.
    pub fn of(band: &Band, simulates: bool) -> Result<Self, StartError> {
        let damper = TunedMassDamper::best(band.base.mass_ratio());
        let stability = exact::stability(band);
        let simulated = match simulates {
            true => simulated::along(band, &stability, &Effort::default())?,
            false => Vec::new(),
        };
        Ok(Self {
            zones: theory::zones(band),
            orbit: exact::extreme(band, &stability, |_, orbit| orbit.peaks.displacement),
            bare: Rival::along(band, bare_amplitude),
            damper: Rival::along(band, |system| damper.amplitude(system)),
            smallest_gap: margin::smallest(band),
            simulated,
            stability,
            band: band.clone(),
        })
    }

    /// The largest peak displacement of any motion that is known, and where: of the stable 1:1 orbit, and
    /// of what was simulated.
    pub fn largest(&self) -> Option<(f64, f64)> {
        let orbit = self.orbit.map(|orbit| (orbit.at, orbit.largest));
        let simulated = self.simulated.iter();
        let simulated = simulated.filter_map(|place| Some((place.at, place.largest()?.peak)));
        simulated.chain(orbit).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Share in area Z3 of the theory, strips included.
    pub fn z3_share(&self) -> f64 {
        self.band.share(&self.zones, |zone| zone.is_z3())
    }

    /// Share in a strip of it.
    pub fn strip_share(&self, strip: Strip) -> f64 {
        self.band.share(&self.zones, |zone| zone.strip == Some(strip))
    }

    /// Share with an attracting symmetric 1:1 orbit.
    pub fn stable_share(&self) -> f64 {
        self.band.share(&self.stability, |stable| *stable)
    }
}
