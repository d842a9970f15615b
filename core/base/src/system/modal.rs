//! A linear structure of several modes with several absorbers, each in a cavity of its own.
//!
//! Lengths are in one unit of the caller's choice, time is `tau = omega_1 t` with one frequency of reference, masses are in
//! one unit. Mode `k` has the modal mass `M_k`, the frequency `w_k` and the damping ratio `zeta_k`; at the place of absorber
//! `j` its shape is `phi_kj`. Between impacts
//!
//! `q_k'' + 2 zeta_k w_k q_k' + w_k^2 q_k = F_k sin(Omega tau) - Gamma_k z''`, `X_j = z + sum_k phi_kj q_k`, `y_j'' = 0`,
//!
//! with a base that moves by `z = Z sin(Omega tau)`. Where `abs(X_j - y_j) = b_j` with the relative velocity `w'` the impulse
//! `J = (1 + r_j) w'/(1/m_j + sum_k phi_kj^2/M_k)` takes `phi_kj J/M_k` off `q_k'` and adds `J/m_j` to `y_j'`.

use serde::Serialize;

use super::LinearResponse;

/// Most modes, and most absorbers, of a [`ModalSystem`].
pub const MOST_MODES: usize = 8;
/// Largest damping ratio of a mode: one that hardly rings, or not at all, is not flown by phasors.
pub const LARGEST_DAMPING_RATIO: f64 = 0.85;

/// A mode of the structure.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Mode {
    /// `w_k`, over the frequency of reference, above 0.
    pub frequency: f64,
    /// `zeta_k`, from 0 to [`LARGEST_DAMPING_RATIO`].
    pub damping_ratio: f64,
    /// `M_k`, above 0.
    pub mass: f64,
    /// `F_k`, the force in the mode over its modal mass.
    pub forcing: f64,
    /// `Gamma_k`, its participation in the motion of the base; of no effect where that is at rest.
    pub participation: f64,
    /// `phi_kj`, its shape at the place of each absorber.
    pub shape: Vec<f64>,
}

/// An absorber and its cavity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ModalAbsorber {
    /// `m_j`, above 0.
    pub mass: f64,
    /// `b_j`, from the middle to either wall, above 0.
    pub clearance: f64,
    /// `r_j`, from 0 to 1.
    pub restitution: f64,
}

/// The numbers of a [`ModalSystem`] before they are proven valid.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct ModalParameters {
    /// 1 to [`MOST_MODES`].
    pub modes: Vec<Mode>,
    /// 1 to [`MOST_MODES`].
    pub absorbers: Vec<ModalAbsorber>,
    /// `Omega`, the excitation's frequency over that of reference, above 0.
    pub frequency_ratio: f64,
    /// `Z`, by which the base moves.
    pub base_amplitude: f64,
}

/// What no structure with absorbers can have.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidModalSystem {
    /// Too few or too many.
    #[error("there are {count} {what}, expected 1 to {MOST_MODES}")]
    Count {
        /// Modes or absorbers.
        what: &'static str,
        /// How many.
        count: usize,
    },
    /// A mode without its shape at the place of each absorber.
    #[error(
        "mode {mode} has {found} values of its shape, expected one for each of {expected} absorbers"
    )]
    Shape {
        /// Which, from 1.
        mode: usize,
        /// How many values it has.
        found: usize,
        /// How many absorbers there are.
        expected: usize,
    },
    /// A number that is not finite or out of its range.
    #[error("{name} of {of} is {value}, expected {expected}")]
    Number {
        /// The number's name as in [`Mode`], [`ModalAbsorber`] or [`ModalParameters`].
        name: &'static str,
        /// Of what, counted from 1.
        of: String,
        /// The offending value.
        value: f64,
        /// What would have been accepted.
        expected: &'static str,
    },
    /// A mode without damping, driven at its own frequency: it has no steady motion.
    #[error(
        "mode {mode} has no damping and is driven at its own frequency: it has no steady motion"
    )]
    NoSteadyMotion {
        /// Which, from 1.
        mode: usize,
    },
}

/// A structure of modes with absorbers whose numbers have been proven valid once, here.
///
/// ```
/// use vinesink_core::system::{ModalAbsorber, ModalParameters, ModalSystem, Mode};
///
/// let mode = Mode { frequency: 1.0, damping_ratio: 0.01, mass: 1.0, forcing: 0.1, shape: vec![1.0, 0.7], ..Mode::default() };
/// let absorber = ModalAbsorber { mass: 0.01, clearance: 3.0, restitution: 0.6 };
/// let parameters = ModalParameters {
///     modes: vec![mode],
///     absorbers: vec![absorber; 2],
///     frequency_ratio: 1.0,
///     ..ModalParameters::default()
/// };
/// let system = ModalSystem::new(parameters.clone())?;
/// // At resonance the damper alone holds the force: F/(2 zeta).
/// assert!((system.steady_motion(0).amplitude() - 5.0).abs() < 1e-12);
/// // e_j, by which an impact sees the structure's mass.
/// assert!((system.mass_ratio(1) - 0.01 * 0.49).abs() < 1e-15);
///
/// let mut wrong = parameters;
/// wrong.absorbers[1].restitution = 1.2;
/// let refused = ModalSystem::new(wrong).unwrap_err();
/// assert_eq!(refused.to_string(), "restitution of absorber 2 is 1.2, expected a number from 0 to 1");
/// # Ok::<(), vinesink_core::system::InvalidModalSystem>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct ModalSystem(ModalParameters);

impl ModalSystem {
    /// The same without some of its absorbers; none where that leaves none of them.
    #[must_use]
    pub fn without(&self, absorbers: &[usize]) -> Option<Self> {
        let stays = |(j, _): &(usize, f64)| !absorbers.contains(j);
        let kept = |shape: &[f64]| {
            shape.iter().copied().enumerate().filter(stays).map(|(_, phi)| phi).collect()
        };
        let modes =
            self.0.modes.iter().map(|mode| Mode { shape: kept(&mode.shape), ..mode.clone() });
        let others = self.0.absorbers.iter().enumerate().filter(|(j, _)| !absorbers.contains(j));
        let parameters = ModalParameters {
            modes: modes.collect(),
            absorbers: others.map(|(_, one)| *one).collect(),
            ..self.0.clone()
        };
        // Nothing else can be wrong with what was a structure.
        Self::new(parameters).ok()
    }

    /// Accepts what a structure can have.
    ///
    /// # Errors
    /// [`InvalidModalSystem`] says which number is not finite or out of its range.
    pub fn new(parameters: ModalParameters) -> Result<Self, InvalidModalSystem> {
        let ModalParameters { modes, absorbers, frequency_ratio, base_amplitude } = &parameters;
        for (what, count) in [("modes", modes.len()), ("absorbers", absorbers.len())] {
            if !(1..=MOST_MODES).contains(&count) {
                return Err(InvalidModalSystem::Count { what, count });
            }
        }
        let (above, from_0) = ("a finite number above 0", "a number from 0 to 1");
        let rings = "a number from 0 to 0.85, because a mode has to ring";
        let excitation = || "the excitation".to_owned();
        let positive = *frequency_ratio > 0.0;
        check("frequency_ratio", excitation, *frequency_ratio, positive, above)?;
        check("base_amplitude", excitation, *base_amplitude, true, "a finite number")?;
        for (k, mode) in modes.iter().enumerate() {
            let of = || format!("mode {}", k + 1);
            let damping = mode.damping_ratio;
            check("frequency", of, mode.frequency, mode.frequency > 0.0, above)?;
            let within = (0.0..=LARGEST_DAMPING_RATIO).contains(&damping);
            check("damping_ratio", of, damping, within, rings)?;
            check("mass", of, mode.mass, mode.mass > 0.0, above)?;
            check("forcing", of, mode.forcing, true, "a finite number")?;
            check("participation", of, mode.participation, true, "a finite number")?;
            if mode.shape.len() != absorbers.len() {
                let (found, expected) = (mode.shape.len(), absorbers.len());
                return Err(InvalidModalSystem::Shape { mode: k + 1, found, expected });
            }
            for value in &mode.shape {
                check("shape", of, *value, true, "finite numbers")?;
            }
            if damping == 0.0 && mode.frequency == *frequency_ratio {
                return Err(InvalidModalSystem::NoSteadyMotion { mode: k + 1 });
            }
        }
        for (j, absorber) in absorbers.iter().enumerate() {
            let of = || format!("absorber {}", j + 1);
            check("mass", of, absorber.mass, absorber.mass > 0.0, above)?;
            check("clearance", of, absorber.clearance, absorber.clearance > 0.0, above)?;
            let within = (0.0..=1.0).contains(&absorber.restitution);
            check("restitution", of, absorber.restitution, within, from_0)?;
        }
        Ok(Self(parameters))
    }

    /// All numbers, to derive a neighbouring system from.
    pub fn parameters(&self) -> &ModalParameters {
        &self.0
    }

    /// The modes.
    pub fn modes(&self) -> &[Mode] {
        &self.0.modes
    }

    /// The absorbers.
    pub fn absorbers(&self) -> &[ModalAbsorber] {
        &self.0.absorbers
    }

    /// `Omega`.
    pub fn frequency_ratio(&self) -> f64 {
        self.0.frequency_ratio
    }

    /// `Z`, the amplitude of the base, in the unit of the structure's lengths.
    pub fn base_amplitude(&self) -> f64 {
        self.0.base_amplitude
    }

    /// `2 pi / Omega`, the excitation's period.
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / self.0.frequency_ratio
    }

    /// `e_j = sum_k m_j phi_kj^2/M_k`, an absorber's mass over that which its impacts see. It depends on how many modes there
    /// are, and grows with them without a bound: only those count whose frequency times the time of contact is below about 1.
    pub fn mass_ratio(&self, absorber: usize) -> f64 {
        self.modes().iter().map(|mode| self.modal_mass_ratio(mode, absorber)).sum()
    }

    /// `eps_kj = m_j phi_kj^2/M_k`, an absorber's mass over that which a mode has at its place.
    pub fn modal_mass_ratio(&self, mode: &Mode, absorber: usize) -> f64 {
        self.absorbers()[absorber].mass * mode.shape[absorber] * mode.shape[absorber] / mode.mass
    }

    /// Amplitude of `sin(Omega tau)` on the right-hand side of a mode's equation, the base's motion included.
    pub fn modal_forcing(&self, mode: usize) -> f64 {
        let (mode, omega) = (&self.modes()[mode], self.frequency_ratio());
        mode.forcing + mode.participation * omega * omega * self.base_amplitude()
    }

    /// The steady motion of `q_k` without impacts.
    pub fn steady_motion(&self, mode: usize) -> LinearResponse {
        let (forcing, omega) = (self.modal_forcing(mode), self.frequency_ratio());
        let Mode { frequency, damping_ratio, .. } = self.modes()[mode];
        let reactance = (frequency - omega) * (frequency + omega);
        let loss = 2.0 * damping_ratio * frequency * omega;
        let scale = reactance * reactance + loss * loss;
        LinearResponse { sine: forcing * reactance / scale, cosine: -forcing * loss / scale }
    }

    /// Displacement and velocity of the place of an absorber in a state at phase 0, the base's included.
    pub fn displaced(&self, absorber: usize, state: &ModalState) -> [f64; 2] {
        let base = [0.0, self.frequency_ratio() * self.base_amplitude()];
        let modes = self.modes().iter().zip(&state.modes);
        modes.fold(base, |[x, v], (mode, [q, rate])| {
            let phi = mode.shape[absorber];
            [x + phi * q, v + phi * rate]
        })
    }

    /// The steady motion `X_j` at the place of an absorber, without impacts.
    pub fn steady_motion_at(&self, absorber: usize) -> LinearResponse {
        let start = LinearResponse { sine: self.base_amplitude(), cosine: 0.0 };
        self.modes().iter().enumerate().fold(start, |sum, (k, mode)| {
            let (phi, of) = (mode.shape[absorber], self.steady_motion(k));
            LinearResponse { sine: sum.sine + phi * of.sine, cosine: sum.cosine + phi * of.cosine }
        })
    }
}

/// A number of a [`ModalSystem`] that varies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum ModalParameter {
    /// All forces and the motion of the base, over what they are.
    Excitation,
    /// `Omega`.
    FrequencyRatio,
    /// `b_j` of an absorber, from 0.
    Clearance(usize),
    /// `r_j` of an absorber, from 0.
    Restitution(usize),
}

impl ModalParameter {
    /// Its value, in the units of the structure; not a number where there is no such absorber.
    pub fn of(self, system: &ModalSystem) -> f64 {
        let absorber = |j: usize| system.absorbers().get(j);
        match self {
            Self::Excitation => 1.0,
            Self::FrequencyRatio => system.frequency_ratio(),
            Self::Clearance(j) => absorber(j).map_or(f64::NAN, |one| one.clearance),
            Self::Restitution(j) => absorber(j).map_or(f64::NAN, |one| one.restitution),
        }
    }

    /// The system with another value; with none of an absorber that there is not.
    ///
    /// # Errors
    /// [`InvalidModalSystem`] where a system cannot have it.
    pub fn applied(
        self,
        system: &ModalSystem,
        value: f64,
    ) -> Result<ModalSystem, InvalidModalSystem> {
        let mut numbers = system.0.clone();
        let absorber = |of: &mut ModalParameters, j: usize, set: fn(&mut ModalAbsorber, f64)| {
            of.absorbers.get_mut(j).into_iter().for_each(|one| set(one, value));
        };
        match self {
            Self::Excitation => {
                numbers.modes.iter_mut().for_each(|mode| mode.forcing *= value);
                numbers.base_amplitude *= value;
            }
            Self::FrequencyRatio => numbers.frequency_ratio = value,
            Self::Clearance(j) => absorber(&mut numbers, j, |one, b| one.clearance = b),
            Self::Restitution(j) => absorber(&mut numbers, j, |one, r| one.restitution = r),
        }
        ModalSystem::new(numbers)
    }
}

/// Displacements and velocities of modes and absorbers; those that a system does not have are 0.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct ModalState {
    /// `[q_k, q_k']`.
    pub modes: [[f64; 2]; MOST_MODES],
    /// `[y_j, y_j']`.
    pub absorbers: [[f64; 2]; MOST_MODES],
}

impl ModalState {
    /// Nothing moves, and each absorber is in the middle of its cavity; where the base moves that is so at phase 0.
    pub const AT_REST: Self =
        Self { modes: [[0.0; 2]; MOST_MODES], absorbers: [[0.0; 2]; MOST_MODES] };

    /// The largest of its numbers, without sign.
    pub fn size(&self) -> f64 {
        self.numbers().fold(0.0, |most: f64, one| most.max(one.abs()))
    }

    /// The largest difference of its numbers to those of another.
    pub fn apart(&self, other: &Self) -> f64 {
        let pairs = self.numbers().zip(other.numbers());
        pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
    }

    /// The same over its own [`size`](Self::size).
    pub fn distance(&self, other: &Self) -> f64 {
        self.apart(other) / self.size()
    }

    fn numbers(&self) -> impl Iterator<Item = f64> {
        self.modes.iter().chain(&self.absorbers).flatten().copied()
    }
}

fn check(
    name: &'static str,
    of: impl Fn() -> String,
    value: f64,
    within: bool,
    expected: &'static str,
) -> Result<(), InvalidModalSystem> {
    if within && value.is_finite() {
        return Ok(());
    }
    Err(InvalidModalSystem::Number { name, of: of(), value, expected })
}
