//! The dissipation curve: what an absorber takes off an oscillator in every regime, and the slow flow on it.
//!
//! At leading order in the mass ratio the absorber sees the oscillator as a prescribed motion `x = C sin psi`, so
//! that its long-term motion depends on `C/b` and the restitution alone, and so do the two averages
//! `S = <E sin Theta>/b` and `K = <E cos Theta>/b`, where `y = -K sin psi - S cos psi + ...` over the clearance. On
//! the manifold's stable branch they are closed forms of (14), (15); elsewhere they are averages over the motion of
//! this *impact pair*, which is simulated ([`DissipationCurve`]). With them the slow flow (18) holds in every
//! regime ([`AveragedFlow`]), as long as averages over some periods settle faster than amplitudes change. Where it leaves
//! the stable branch at the fold it is captured again at random ([`Recapture`]): a modulated cycle
//! ([`ModulatedCycle`]).
//!
//! Source: derived here beyond Li, Seguy, Berlioz (2016); see [`crate::equations::dissipation`].

mod branch;
mod curve;
mod cycle;
mod flow;
mod pair;
mod recapture;

pub use branch::PairBranch;
pub use curve::DissipationCurve;
pub use cycle::ModulatedCycle;
pub use flow::{AveragedFlow, DecayPoint, SteadyState};
pub use pair::PairPoint;
pub use recapture::Recapture;
