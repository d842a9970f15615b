//! The first guess of a clearance, in closed form: where a search begins.

use crate::analysis::FreeDecay;
use crate::case::Case;
use crate::system::{Excitation, Parameter};

/// Force of an absorber in phase with the velocity, over its mass times omega0^2 times the clearance: 0.78 at the fold and
/// 0.50 at symmetry breaking for r = 0.6.
const FORCE: f64 = 0.55;
/// Factor by which the closed form of the clearance may miss the best, either way; also of what it promises.
pub const MISSES: f64 = 1.7;

/// What resists a structure at resonance, over its stiffness and its displacement: its damping ratio twice, and an absorber of such a
/// mass ratio that follows with the clearance as the amplitude.
pub fn resistance([damping_ratio, mass_ratio]: [f64; 2]) -> f64 {
    2.0 * damping_ratio + FORCE * mass_ratio
}

/// The clearance of a case by closed form, and what it promises: the largest displacement, or the time to come to rest.
///
/// At resonance damper and absorber carry the force, `P = k A 2 zeta + 0.55 eps k b` with the amplitude `A`, which is about
/// the clearance where the absorber still follows in 1:1 resonance: `A = b`. Beside resonance the stiffness carries its part.
/// Released, an absorber is captured down to the fold of the slow manifold: it lies at the amplitude at which the structure
/// has come to rest; until then it acts as dry friction beside the damper.
pub fn clearance(case: &Case) -> [f64; 2] {
    let (system, design) = (case.system(), &case.design);
    let zeta = 0.5 * system.mass_ratio() * system.damping();
    let absorber = FORCE * system.mass_ratio();
    if let Some(from) = design.value(Parameter::InitialDisplacement) {
        let clearance = case.decay_level * from / FreeDecay::of(&system).residual_amplitude();
        // dA/dtau = -zeta A - 0.55 eps b/2.
        let friction = 0.5 * absorber * clearance;
        let ratio = (zeta * from + friction) / (zeta * case.decay_level * from + friction);
        return [clearance, case.units().time(libm::log(ratio) / zeta)];
    }
    let (still, at) = driven(case);
    let clearance =
        still / libm::hypot(1.0 - at * at, resistance([zeta, system.mass_ratio()]) * at);
    [clearance, clearance]
}

/// The mass ratio with which the clearance, and with it the vibration, of a structure that is driven steadily is so large by
/// the same form; none where no absorber is needed for it.
pub fn mass_ratio(case: &Case, length: f64) -> Option<f64> {
    let zeta = 0.5 * case.system().mass_ratio() * case.system().damping();
    let (still, at) = driven(case);
    let (needed, stiff) = (still / length, 1.0 - at * at);
    let resisted = (needed * needed - stiff * stiff).max(0.0).sqrt() / at;
    let ratio = (resisted - 2.0 * zeta) / FORCE;
    (ratio > 0.0).then_some(ratio)
}

/// What the excitation displaces at rest, and the frequency ratio of the range of the case that is nearest to resonance.
fn driven(case: &Case) -> (f64, f64) {
    let (system, design) = (case.system(), &case.design);
    let amplitude = design.value(Parameter::Amplitude).unwrap_or_default();
    let [from, to] = case.range().range;
    let at = 1.0_f64.clamp(from, to);
    let still = match system.excitation() {
        Excitation::Force => {
            amplitude / design.value(Parameter::Stiffness).unwrap_or(f64::INFINITY)
        }
        Excitation::BaseDisplacement => {
            amplitude * libm::hypot(1.0, system.mass_ratio() * system.damping() * at)
        }
    };
    (still, at)
}
