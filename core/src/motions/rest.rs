//! The absorber that stays at rest: where the structure alone does not move as far as the clearance, an
//! absorber at rest may stay so, and the structure then vibrates as if it had none.
//!
//! A motion counts if it exists. An excitation that grows slowly takes the structure along its steady motion, of an amplitude
//! `A`: an absorber that rests within `b - A` of the middle of its cavity is never touched, a share `1 - A/b` of its resting
//! places. An excitation that begins at once adds a free motion that decays, `x = Re(S e^{i Omega tau}) +
//! Re(H e^{(i omega_d - zeta) tau})`: with `X` the largest displacement on the way, `1 - X/b` of the places stay untouched then.
//!
//! In a tilted cavity, or one that rubs, an absorber at rest goes along with the structure, whose mass is then `1 + eps`,
//! while the acceleration of both asks for no more than gravity `a` and friction `f` give: up to `f - abs(a)` anywhere, up
//! to `f + abs(a)` at the wall that it slides down to, with which every resting place ends. Beyond that an absorber in a
//! tilted cavity hits that wall again and again. In a level one it slides: the structure moves as under dry friction
//! (Den Hartog, 1931, at first order in it), the absorber by `4 f/(pi Omega^2)` a quarter of a period later, and their relative
//! amplitude takes the place of `A`.

use serde::Serialize;

use super::watch::Watch;
use super::{Facts, NEGLIGIBLE};
use crate::numerics::scan::{largest_of, places};
use crate::simulation::{Simulation, Stop};
use crate::system::{Band, Cavity, LinearResponse, State, System};

/// Phases of one beat between the steady and the free motion at which its envelope is evaluated: the
/// largest of them is then below the true one by at most 1 - cos(pi/256), 1e-4 of the free part.
const PHASES: u32 = 128;
/// Pieces of a band in which the largest amplitude is looked for before it is narrowed down.
const PIECES: u32 = 512;
/// Time constants after which what is left of a transient is `e^-12`, 6e-6, and the fewest and most periods.
const TRANSIENT: f64 = 12.0;
pub(super) const PERIODS: [f64; 2] = [50.0, 5000.0];
/// First harmonic of dry friction over its size (Den Hartog, 1931).
const DRY: f64 = 4.0 / std::f64::consts::PI;
/// Resting places of an absorber that slides.
const PLACES: u32 = 8;
/// Impacts after which an absorber counts as awake, and periods without one after which it does not.
const MOST_IMPACTS: u64 = 20_000;
const LAST: u64 = 20;

/// An absorber that stays at rest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rest {
    /// How it rests.
    pub rest: RestKind,
    /// Share of its resting places from which it stays in this motion under an excitation that grows slowly: `1 - A/b`; all
    /// where friction or a wall hold it, 0 where none does and only other starts lead here.
    pub share: f64,
    /// The same under one that begins at once: `1 - X/b`, by simulation where friction or a tilt move the absorber.
    pub sudden: f64,
    /// Amplitude of the structure in closed form, over the clearance; of an absorber that slides at first order in friction.
    pub amplitude: f64,
}

/// How an absorber rests.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum RestKind {
    /// In the middle of its cavity, nothing moves it.
    Floating,
    /// It is carried along by the structure, held by friction or on the wall that gravity pulls it to.
    Held,
    /// It slides to and fro.
    Sliding,
}

impl Rest {
    /// That of a trajectory which was seen to hit no wall any more, of an amplitude: no resting place need lead to it.
    pub(super) fn seen(system: &System, amplitude: f64) -> Self {
        let cavity = system.cavity();
        let rest = match cavity.gravity_along {
            _ if !cavity.moves_absorber() => RestKind::Floating,
            0.0 => RestKind::Sliding,
            _ => RestKind::Held,
        };
        Self { rest, share: 0.0, sudden: 0.0, amplitude }
    }
}

/// The motion with an absorber at rest, solved for.
#[derive(Debug, Clone, Copy)]
pub(super) struct AtRest {
    pub rest: Rest,
    pub facts: Facts,
    /// A state on it at phase 0.
    pub state: State,
}

impl AtRest {
    /// That of a system; `None` where a wall reaches every resting place.
    pub fn of(system: &System) -> Option<Self> {
        let RestCandidate { rest, amplitude, share } = RestCandidate::of(system)?;
        let told = |sudden| Rest { rest, share, sudden, amplitude };
        match rest {
            RestKind::Floating => {
                let Floating { sudden, state, .. } = Floating::of(system)?;
                Some(Self { rest: told(sudden), facts: Facts::of_sine(amplitude, 0.0), state })
            }
            RestKind::Held => {
                let held = Carried::of(system)?;
                let facts = Facts::of_sine(amplitude, static_shift(system));
                Some(Self { rest: told(held.sudden(system)), facts, state: held.state(system) })
            }
            RestKind::Sliding => {
                let stay: Vec<State> = resting(system, amplitude).collect();
                let state = sliding(system, amplitude).or(stay.first().copied())?;
                let sudden = stay.len() as f64 / f64::from(PLACES);
                Some(Self { rest: told(sudden), facts: measured(system, state)?, state })
            }
        }
    }
}

/// Where along a band the structure with an absorber at rest that counts moves farthest, or its amplitude times a power of
/// its frequency is largest; `None` where there is none.
pub(super) fn largest_along(band: &Band, power: i32) -> Option<f64> {
    let pieces = if band.is_point() { 1 } else { PIECES };
    let peak = |at: f64| {
        let system = band.system(at).ok()?;
        let amplitude = RestCandidate::counting(&system)?.amplitude;
        let factor = (0..power).fold(1.0, |product, _| product * system.frequency_ratio());
        Some(factor * amplitude + if power == 0 { static_shift(&system) } else { 0.0 })
    };
    let is_one = |at: f64| band.system(at).is_ok_and(|system| RestCandidate::is_one(&system));
    // Simulated are only those that may be the largest.
    let tried = places(band.range, pieces).filter_map(|at| Some((at, peak(at)?)));
    let mut tried: Vec<(f64, f64)> = tried.collect();
    tried.sort_by(|a, b| b.1.total_cmp(&a.1).then(b.0.total_cmp(&a.0)));
    let best = tried.into_iter().find(|(at, _)| is_one(*at));
    let found = largest_of(best, band.range, pieces, |at| peak(at).filter(|_| is_one(at)))?;
    Some(found.0)
}

/// How far the weight of the absorber along a tilted cavity shifts the structure, over the clearance: where it is measured
/// from is the place without absorber.
fn static_shift(system: &System) -> f64 {
    system.mass_ratio() * system.cavity().gravity_along.abs()
}

/// How an absorber would rest, in closed form, the share of its places, and the structure's amplitude then.
struct RestCandidate {
    rest: RestKind,
    share: f64,
    amplitude: f64,
}

impl RestCandidate {
    fn of(system: &System) -> Option<Self> {
        if !system.cavity().moves_absorber() {
            let Floating { amplitude, share, .. } = Floating::of(system)?;
            return Some(Self { rest: RestKind::Floating, share, amplitude });
        }
        let Cavity { gravity_along: a, friction_acceleration: f, .. } = system.cavity();
        let held = Carried::of(system)?;
        if held.accelerations[0] <= a.abs() + f {
            let amplitude = held.steady.amplitude();
            return Some(Self { rest: RestKind::Held, share: 1.0, amplitude });
        }
        let (amplitude, share) =
            if a == 0.0 { sliding_amplitude(system, f)? } else { return None };
        Some(Self { rest: RestKind::Sliding, share, amplitude })
    }

    /// The same where enough resting places stay for it to count.
    fn counting(system: &System) -> Option<Self> {
        Self::of(system).filter(|one| one.share >= NEGLIGIBLE)
    }

    /// Whether there is that motion, by simulation where closed form does not say.
    fn is_one(system: &System) -> bool {
        Self::counting(system).is_some_and(|one| match one.rest {
            RestKind::Floating | RestKind::Held => true,
            RestKind::Sliding => {
                sliding(system, one.amplitude).is_some()
                    || resting(system, one.amplitude).next().is_some()
            }
        })
    }
}

/// An absorber that nothing moves but the walls.
struct Floating {
    amplitude: f64,
    share: f64,
    /// See [`Rest::sudden`].
    sudden: f64,
    state: State,
}

impl Floating {
    /// `None` where the structure alone moves farther than the clearance, or for ever farther.
    fn of(system: &System) -> Option<Self> {
        let steady = system.linear_response()?;
        let [zeta, omega] =
            [0.5 * system.mass_ratio() * system.damping(), system.frequency_ratio()];
        let state = steady.state(system);
        let forced = libm::hypot(state.x, state.x_velocity / omega);
        if forced >= 1.0 {
            return None;
        }
        // An overdamped structure has no free oscillation; its free motion is never larger than this.
        let natural = (1.0 - zeta * zeta).max(0.0).sqrt();
        let free = match natural {
            0.0 => forced,
            _ => libm::hypot(state.x, (zeta * state.x - state.x_velocity) / natural),
        };
        let largest = largest_from_rest(forced, free, zeta, (natural - omega).abs());
        // Without damping the free part stays.
        let amplitude = if zeta == 0.0 && largest < 1.0 { largest } else { steady.amplitude() };
        Some(Self { amplitude, share: 1.0 - amplitude, sudden: (1.0 - largest).max(0.0), state })
    }
}

/// What a motion without impacts is like, seen over some periods.
fn measured(system: &System, state: State) -> Option<Facts> {
    let mut simulation = Simulation::new(system, state, 0.0).ok()?;
    let mut watch = Watch::begin(&simulation);
    let stop = simulation.run(LAST, 1, &mut watch.observers);
    Some(watch.sample(&simulation, stop)?.facts)
}

/// Amplitude with an absorber that slides in a level cavity, and the share of its places in which no wall reaches it.
fn sliding_amplitude(system: &System, friction: f64) -> Option<(f64, f64)> {
    let omega = system.frequency_ratio();
    let dry = DRY * friction;
    let (sine, cosine) = system.excitation_amplitudes();
    let force = libm::hypot(sine, cosine);
    let stiffness = (1.0 - omega) * (1.0 + omega);
    let loss = system.mass_ratio() * system.damping() * omega;
    let scale = stiffness * stiffness + loss * loss;
    let drag = system.mass_ratio() * dry;
    let reaction = stiffness * drag;
    let root = (force * force * scale - reaction * reaction).max(0.0).sqrt();
    let amplitude = (root - loss * drag) / scale;
    let share = 1.0 - libm::hypot(amplitude, dry / (omega * omega));
    (amplitude > 0.0 && share > 0.0).then_some((amplitude, share))
}

/// Motions of an absorber that slides after a sudden start, one from each place where it stays. On its way from rest it drifts by
/// some amplitudes of the structure however small the friction is: which places stay is found by simulation.
fn resting(system: &System, amplitude: f64) -> impl Iterator<Item = State> {
    let places = (0..PLACES).map(|k| (2.0 * f64::from(k) + 1.0) / f64::from(PLACES) - 1.0);
    let drift = drift(system, amplitude);
    let rests = move |place: f64| State { y: -place, ..State::AT_REST };
    let stay = places.filter_map(move |place| followed(system, rests(place), 1, drift));
    stay.filter(|(impacts, _)| *impacts == [0, 0]).map(|(_, state)| state)
}

/// That of one in the middle whose structure is on its steady motion already; none where a wall reaches it.
fn sliding(system: &System, amplitude: f64) -> Option<State> {
    let steady = system.linear_response()?;
    let State { x, x_velocity, .. } = steady.state(system);
    let [x, x_velocity] = [x, x_velocity].map(|of| of * amplitude / steady.amplitude());
    // What would be left of a drift otherwise takes it off the middle.
    let omega = system.frequency_ratio();
    let swing = DRY * system.cavity().friction_acceleration / (omega * omega * amplitude);
    let (y, y_velocity) = (-swing * x_velocity / omega, swing * omega * x);
    let start = State { x, x_velocity, y, y_velocity };
    let (impacts, state) = followed(system, start, 1, drift(system, amplitude))?;
    (impacts == [0, 0]).then_some(state)
}

/// The rate at which a drift of an absorber that slides fades: a drift `u` meets the mean friction `2 f u/(pi Omega X)`.
fn drift(system: &System, amplitude: f64) -> f64 {
    let dry = DRY * system.cavity().friction_acceleration;
    0.5 * dry / (system.frequency_ratio() * amplitude)
}

/// Impacts of a simulation until the transient is over, in which a drift of the absorber fades at a rate, and in periods after it,
/// and the state then, at phase 0; none where `most` are reached.
fn followed(system: &System, start: State, most: u64, drift: f64) -> Option<([u64; 2], State)> {
    let decay = (0.5 * system.mass_ratio() * system.damping()).min(drift) * system.period();
    let periods = (TRANSIENT / decay).clamp(PERIODS[0], PERIODS[1]) as u64;
    let mut simulation = Simulation::new(system, start, 0.0).ok()?;
    let mut impacts = [0; 2];
    for (part, periods) in impacts.iter_mut().zip([periods, LAST]) {
        let before = simulation.impacts();
        if simulation.run(periods, most, &mut ()) != Stop::EndTime {
            return None;
        }
        *part = simulation.impacts() - before;
    }
    Some((impacts, simulation.state()))
}

/// The structure with the absorber carried along, from rest. Lengths over the clearance, fast time.
struct Carried {
    /// Its steady motion, without what gravity displaces.
    steady: LinearResponse,
    /// Of the acceleration: the steady amplitude, and a bound with the transient.
    accelerations: [f64; 2],
}

impl Carried {
    /// `None` at an undamped resonance.
    fn of(system: &System) -> Option<Self> {
        let (eps, omega) = (system.mass_ratio(), system.frequency_ratio());
        let steady = system.response_carried()?;
        let (natural, decay) =
            ((1.0 / (1.0 + eps)).sqrt(), 0.5 * eps * system.damping() / (1.0 + eps));
        let ringing = (natural * natural - decay * decay).max(0.0).sqrt();
        let State { x, x_velocity: v, .. } = steady.state(system);
        let free = if ringing == 0.0 {
            steady.amplitude()
        } else {
            libm::hypot(x, (decay * x - v) / ringing)
        };
        // Gravity, too, begins to pull where the motion does.
        let free = free + eps * system.cavity().gravity_along.abs();
        let [forced, free] = [steady.amplitude() * omega * omega, free * natural * natural];
        let largest = largest_from_rest(forced, free, decay, (ringing - omega).abs());
        Some(Self { steady, accelerations: [forced, largest] })
    }

    /// See [`Rest::sudden`]: a transient may throw the absorber off the wall that it rests on, where it comes to rest again, and
    /// in a level cavity it may slide into a wall.
    fn sudden(&self, system: &System) -> f64 {
        let Cavity { gravity_along: a, friction_acceleration: f, .. } = system.cavity();
        if self.accelerations[1] <= a.abs() + f {
            return 1.0;
        }
        if a == 0.0 {
            let stay = resting(system, self.steady.amplitude()).count();
            return stay as f64 / f64::from(PLACES);
        }
        let start = State { y: a.signum(), ..State::AT_REST };
        let after = followed(system, start, MOST_IMPACTS, f64::INFINITY);
        f64::from(after.is_some_and(|(impacts, _)| impacts[1] == 0))
    }

    /// The steady motion at phase 0, the absorber on the wall that gravity pulls it to, or in the middle.
    fn state(&self, system: &System) -> State {
        let a = system.cavity().gravity_along;
        let State { x, x_velocity, .. } = self.steady.state(system);
        let x = x + system.mass_ratio() * a;
        let place = if a == 0.0 { 0.0 } else { -a.signum() };
        State { x, x_velocity, y: x - place, y_velocity: x_velocity }
    }
}

/// Largest value of the envelope `|S + H e^{(i beat - zeta) tau}|` of a motion that begins at 0, `H`
/// opposite to `S`. It differs from the largest displacement by what the fast phase leaves, which vanishes
/// near resonance.
fn largest_from_rest(forced: f64, free: f64, zeta: f64, beat: f64) -> f64 {
    let envelope = |k: u32| {
        let phase = std::f64::consts::TAU * f64::from(k) / f64::from(PHASES);
        let left = free * libm::exp(-zeta * phase / beat.max(f64::MIN_POSITIVE));
        let (sine, cosine) = libm::sincos(phase);
        libm::hypot(forced - left * cosine, left * sine)
    };
    (1..=PHASES).map(envelope).fold(forced, f64::max)
}

#[cfg(test)]
mod tests {
    use nalgebra::Complex;

    use super::*;
    use crate::simulation::{AbsorberMotion, Measurement, Observer, Segment};
    use crate::system::{Excitation, Parameters};

    /// Largest displacement of the structure alone from rest, by steps of Runge and Kutta: 2 pi/0.02 steps
    /// a period, an error of 1e-6.
    fn largest_by_steps(system: &System) -> f64 {
        const STEP: f64 = 0.02;
        let damping = system.mass_ratio() * system.damping();
        let (sine, cosine) = system.excitation_amplitudes();
        let rate = |time: f64, [x, v]: [f64; 2]| {
            let (s, c) = libm::sincos(system.frequency_ratio() * time);
            [v, sine * s + cosine * c - damping * v - x]
        };
        let after =
            |[x, v]: [f64; 2], [dx, dv]: [f64; 2], step: f64| [x + step * dx, v + step * dv];
        let (mut state, mut largest): ([f64; 2], f64) = ([0.0; 2], 0.0);
        for k in 0..100_000 {
            let time = STEP * f64::from(k);
            let a = rate(time, state);
            let b = rate(time + 0.5 * STEP, after(state, a, 0.5 * STEP));
            let c = rate(time + 0.5 * STEP, after(state, b, 0.5 * STEP));
            let d = rate(time + STEP, after(state, c, STEP));
            let mean = [0, 1].map(|k| (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]) / 6.0);
            state = after(state, mean, STEP);
            largest = largest.max(state[0].abs());
        }
        largest
    }

    #[test]
    fn the_share_of_resting_places_is_what_the_largest_displacement_from_rest_leaves() {
        for (zeta, omega, excitation) in [
            (0.004, 1.0, Excitation::Force),
            (0.004, 0.99, Excitation::Force),
            (0.01, 1.013, Excitation::BaseDisplacement),
            (0.02, 0.9, Excitation::BaseDisplacement),
            (0.0, 0.97, Excitation::Force),
        ] {
            let parameters = Parameters {
                mass_ratio: 0.01,
                damping: 2.0 * zeta / 0.01,
                restitution: 0.6,
                frequency_ratio: omega,
                forcing_per_clearance: 1e-3,
                excitation,
                cavity: Cavity::IDEAL,
            };
            let system = System::new(parameters).expect("valid");
            let half =
                system.with_clearance_scaled(2.0 * largest_by_steps(&system)).expect("valid");
            let found = AtRest::of(&half).expect("half of the places stay");
            // The envelope differs from the motion by what the fast phase leaves: 2 % so near resonance.
            assert!((found.rest.sudden - 0.5).abs() < 0.01, "{zeta} {omega}: {found:?}");
            let steady = half.linear_response().expect("steady").amplitude();
            let amplitude = if zeta == 0.0 { 0.5 } else { steady };
            assert!((found.rest.share - (1.0 - amplitude)).abs() < 0.01, "{found:?}");
            assert!(
                (found.facts.peak.value / amplitude - 1.0).abs() < 0.02,
                "{zeta} {omega}: {found:?}"
            );
            // Half of the clearance, and what the envelope leaves.
            let narrow = half.with_clearance_scaled(0.49).expect("valid");
            let left = AtRest::of(&narrow).map(|one| [one.rest.share, one.rest.sudden]);
            // A wall reaches every place on the way; the steady motion still fits, but next to resonance.
            let fits = (steady < 0.49).then_some([1.0 - steady / 0.49, 0.0]);
            let alike = match (left, fits) {
                (Some(left), Some(fits)) => (left[0] - fits[0]).abs() < 1e-9 && left[1] == fits[1],
                (left, fits) => left.is_none() && fits.is_none(),
            };
            assert!(alike, "{zeta} {omega}: {left:?} {fits:?}");
            let none = AtRest::of(&half.with_clearance_scaled(0.999 * steady).expect("valid"));
            assert!(none.is_none(), "{zeta} {omega}: {none:?}");
        }
    }

    /// Whether an absorber stays where it is taken along.
    #[derive(Default)]
    struct Stays {
        flights: u64,
    }

    impl Observer for Stays {
        fn segment(&mut self, segment: &Segment) {
            self.flights += u64::from(matches!(segment.absorber, AbsorberMotion::Flying { .. }));
        }
    }

    fn in_cavity(gamma: f64, gravity_along: f64, friction_acceleration: f64) -> System {
        System::new(Parameters {
            mass_ratio: 0.05,
            damping: 1.0,
            restitution: 0.6,
            frequency_ratio: 0.9,
            forcing_per_clearance: gamma,
            excitation: Excitation::Force,
            cavity: Cavity { gravity_along, friction_acceleration, restitution_difference: 0.0 },
        })
        .expect("valid")
    }

    /// From the steady motion carried along, at accelerations 0.1 % below and above what holds: at the lower wall `f + abs(a)`,
    /// elsewhere `f - abs(a)`.
    #[test]
    fn what_holds_an_absorber_is_what_simulation_says() {
        let places: [(f64, f64, f64); 4] =
            [(0.1, 0.0, -1.0), (-0.1, 0.04, 1.0), (0.03, 0.1, 0.2), (0.0, 0.1, 0.4)];
        for (a, f, gap) in places {
            let limit: f64 = if gap.abs() == 1.0 { f + a.abs() } else { f - a.abs() };
            let unit = Carried::of(&in_cavity(1.0, a, f)).expect("damped").accelerations[0];
            for (factor, stays) in [(0.999, true), (1.001, false)] {
                let system = in_cavity(factor * limit / unit, a, f);
                let (eps, omega) = (0.05, 0.9);
                let (sine, cosine) = system.excitation_amplitudes();
                let x = Complex::new(cosine, -sine)
                    / Complex::new(1.0 - (1.0 + eps) * omega * omega, eps * omega);
                let (at, v) = (x.re + eps * a, -omega * x.im);
                let start = State { x: at, x_velocity: v, y: at - gap, y_velocity: v };
                let mut simulation = Simulation::new(&system, start, 0.0).expect("inside");
                let mut seen = Stays::default();
                simulation.run(3, u64::MAX, &mut seen);
                assert_eq!(seen.flights == 0, stays, "{a} {f} {gap} {factor}");
            }
        }
    }

    /// Far below what holds every place is one of rest; above, none in a tilted cavity, and some in a level one.
    #[test]
    fn friction_and_tilt_decide_which_places_wake() {
        let of = |factor: f64, a: f64, f: f64| {
            let unit = Carried::of(&in_cavity(1.0, a, f)).expect("damped").accelerations[0];
            AtRest::of(&in_cavity(factor * (f + a.abs()) / unit, a, f))
        };
        for (a, f) in [(0.1, 0.0), (0.1, 0.04), (0.03, 0.1), (0.0, 0.1)] {
            let held = of(0.4, a, f).expect("held");
            assert_eq!([held.rest.share, held.rest.sudden], [1.0; 2]);
            assert_eq!(of(1.05, a, f).is_some(), a == 0.0, "{a} {f}");
        }
        // Sliding: what slides against 40 times the friction moves as simulation says.
        let (f, gamma) = (0.01, 0.8);
        let system = in_cavity(gamma, 0.0, f);
        let found = AtRest::of(&system).expect("slides");
        let mut simulation = Simulation::new(&system, State::AT_REST, 0.0).expect("inside");
        assert_eq!(simulation.run(300, u64::MAX, &mut ()), Stop::EndTime);
        let mut measured = Measurement::begin(&system, simulation.state());
        simulation.run(50, u64::MAX, &mut measured);
        assert_eq!(simulation.impacts(), 0);
        assert!(found.rest.sudden > 0.2 && found.rest.sudden < 0.9, "{found:?}");
        let peak = measured.statistics().peak();
        assert!((found.facts.peak.value / peak - 1.0).abs() < 1e-6, "{found:?} {peak}");
        // Second order: (4 f/(pi X))^2 is 0.4 %; without friction it would be 3 % larger.
        let (amplitude, share) = sliding_amplitude(&system, f).expect("slides");
        assert!((amplitude / peak - 1.0).abs() < 4e-3, "{amplitude} {peak}");
        // A wall begins to reach it that much off the middle, from which a transient took it by less than a tenth of that.
        assert_eq!(found.rest.share, share);
        for (factor, stays) in [(0.9, true), (1.1, false)] {
            let mut start = found.state;
            start.y += factor * share;
            let mut simulation = Simulation::new(&system, start, 0.0).expect("inside");
            simulation.run(LAST, u64::MAX, &mut ());
            assert_eq!(simulation.impacts() == 0, stays, "{factor} {found:?}");
        }
    }
}
