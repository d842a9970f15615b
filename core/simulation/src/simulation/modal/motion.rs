//! The free motion of every mode as a rotating phasor, and the excitation as one more, for all of them.
//!
//! `q_k = Re z_k + steady`, `z_k -> z_k e^{p_k s}`, `p_k = -zeta_k w_k + i w_dk`; an impact is a jump of the phasors'
//! imaginary parts. What an absorber sees, `X_j/b_j`, is a sum over modes and one steady motion, so that every derivative is
//! at most `sum_k abs(phi_kj/b_j) abs(p_k)^n abs(z_k) + Omega^n abs(steady)`: with the second and the sixth the proof is that
//! of [`super::super::certificate`].

use crate::numerics::crossing::Sample;
use crate::simulation::certificate::Jet;
use crate::simulation::path::StraightLine;
use crate::simulation::phasor::{Slack, multiply};
use crate::simulation::small::{LARGEST_ANGLE, small_angle, small_exponential};
use crate::system::{LinearResponse, MOST_MODES, ModalSystem};

/// Least share of an excursion that an impact is taken to lose: nearly elastic impacts would else all be looked at.
const LEAST_LOSS: f64 = 1e-6;
/// Least restitution by which what is left of an impact's speed is divided.
const SMALLEST_RESTITUTION: f64 = 1e-3;
/// Rounding of a place over the sum of the sizes that it is made of.
const TOUCH: f64 = 16.0 * f64::EPSILON;

/// Lengths of panels, each twice the one before: as far as the certificate allows, slow motions are not flown in steps of the
/// fastest mode.
const LENGTHS: usize = 6;
/// What a panel's quintic may be off, `S/7200` over the clearance: so much is lost of the way to a wall.
const MOST_SLACK: f64 = 0.02;

/// By how much a panel is longer than the shortest.
pub(super) fn longer(length: usize) -> f64 {
    (1_u32 << length) as f64
}

/// The longest panels whose quintics say enough, from what those of the shortest may be off.
pub(super) fn longest(slack: impl Iterator<Item = f64>) -> usize {
    let (mut length, mut slack) = (0, 64.0 * slack.fold(0.0, f64::max));
    while length + 1 < LENGTHS && slack <= MOST_SLACK {
        (length, slack) = (length + 1, 64.0 * slack);
    }
    length
}

/// A mode's own rates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ModeRates {
    pub decay: f64,
    pub ringing: f64,
    pub inverse_ringing: f64,
    pub stiffness: f64,
    /// `e^{p h}` of a panel of each length.
    turns: [[f64; 2]; LENGTHS],
}

/// What moves at one place, over a length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct View<const N: usize> {
    pub shape: [f64; N],
    /// The base's part.
    pub base: f64,
    /// The steady motion: `sin` and `cos` of the phase.
    pub steady: [f64; 2],
    pub steady_size: f64,
    /// What each free phasor and the steady motion contribute to `S/7200`, and to the bound of the acceleration.
    sixth: [f64; N],
    sixth_steady: f64,
    second: [f64; N],
    second_steady: f64,
}

/// What an impact of an absorber does, for each unit of the relative velocity over the clearance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Kick<const N: usize> {
    /// Added to the phasors' imaginary parts.
    turn: [f64; N],
    /// Added to the absorber's velocity over the clearance.
    push: f64,
    /// Energy lost, by the square.
    loss: f64,
    /// What the jump adds to the bound of the acceleration, by the speed at which the gap opens.
    pub bend: f64,
    pub restitution: f64,
    /// `1/(1 - r^2)`: an impact takes the share `1 - r^2` of an excursion's energy.
    pub inverse_loss: f64,
}

/// The constants of `N` modes and `M` absorbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Constants<const N: usize, const M: usize> {
    /// The fastest of modes and excitation.
    pub fastest: f64,
    /// Length of the shortest panel.
    pub step: f64,
    pub frequency: f64,
    inverse_frequency: f64,
    /// `sin` and `cos` of `Omega h` of a panel of each length.
    swings: [[f64; 2]; LENGTHS],
    pub modes: [ModeRates; N],
    pub views: [View<N>; M],
    pub kicks: [Kick<N>; M],
}

/// Free phasors, and `sin` and `cos` of the phase, at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Phasors<const N: usize> {
    pub z: [[f64; 2]; N],
    pub rotor: [f64; 2],
}

/// The free motion of each mode and its first two derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct Free<const N: usize>([[f64; N]; 3]);

/// A gap over the clearance, its slope and its second derivative.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gap {
    pub gap: f64,
    pub slope: f64,
    pub a: f64,
}

impl Jet<f64> for Gap {
    #[inline(always)]
    fn jet(&self) -> [f64; 3] {
        [self.gap, self.slope, self.a]
    }
}

impl Gap {
    /// Seen from a line.
    #[inline(always)]
    pub fn of([x, v, a]: [f64; 3], line: StraightLine<f64>) -> Self {
        Self { gap: x - line.y, slope: v - line.velocity, a }
    }

    pub fn sample(self, curvature_bound: f64) -> Sample {
        Sample { value: self.gap, slope: self.slope, curvature_bound }
    }
}

impl Constants<MOST_MODES, MOST_MODES> {
    pub(super) fn of(system: &ModalSystem) -> Self {
        let frequency = system.frequency_ratio();
        let modes = system.modes();
        // Also of modes that no absorber sees: all are turned by the same series.
        let fastest = modes.iter().map(|mode| mode.frequency).fold(frequency, f64::max);
        let step = LARGEST_ANGLE / fastest;
        let still = ModeRates {
            decay: 0.0,
            ringing: 1.0,
            inverse_ringing: 0.0,
            stiffness: 0.0,
            turns: [[1.0, 0.0]; LENGTHS],
        };
        let mut constants = Self {
            fastest,
            step,
            frequency,
            inverse_frequency: 1.0 / frequency,
            swings: std::array::from_fn(|n| sine_and_cosine(frequency * step * longer(n))),
            modes: [still; MOST_MODES],
            views: [View::NONE; MOST_MODES],
            kicks: [Kick::NONE; MOST_MODES],
        };
        for (rates, mode) in constants.modes.iter_mut().zip(modes) {
            let decay = mode.damping_ratio * mode.frequency;
            let squared = (1.0 - mode.damping_ratio) * (1.0 + mode.damping_ratio);
            let ringing = mode.frequency * squared.sqrt();
            let turns = std::array::from_fn(|n| {
                let length = step * longer(n);
                let ([sin, cos], envelope) =
                    (sine_and_cosine(ringing * length), libm::exp(-decay * length));
                [envelope * cos, envelope * sin]
            });
            *rates = ModeRates {
                decay,
                ringing,
                inverse_ringing: 1.0 / ringing,
                stiffness: mode.frequency * mode.frequency,
                turns,
            };
        }
        for (j, absorber) in system.absorbers().iter().enumerate() {
            let shape: Vec<f64> = modes.iter().map(|mode| mode.shape[j]).collect();
            let steady = system.steady_motion_at(j);
            let view = constants.view(&shape, system.base_amplitude(), steady, absorber.clearance);
            let (r, b) = (absorber.restitution, absorber.clearance);
            let seen = absorber.mass / (1.0 + system.mass_ratio(j));
            let mut kick = Kick {
                push: (1.0 + r) * seen / absorber.mass,
                loss: 0.5 * seen * (1.0 - r) * (1.0 + r) * b * b,
                restitution: r,
                inverse_loss: 1.0 / ((1.0 - r) * (1.0 + r)).max(LEAST_LOSS),
                ..Kick::NONE
            };
            for (k, mode) in modes.iter().enumerate() {
                let impulse = (1.0 + r) * b * seen * mode.shape[j] / mode.mass;
                kick.turn[k] = impulse * constants.modes[k].inverse_ringing;
                kick.bend += view.second[k] * kick.turn[k].abs();
            }
            kick.bend /= r.max(SMALLEST_RESTITUTION);
            (constants.views[j], constants.kicks[j]) = (view, kick);
        }
        constants
    }

    /// What moves at a place with this shape and steady motion, over a length.
    pub(super) fn view(
        &self,
        shape: &[f64],
        base: f64,
        steady: LinearResponse,
        length: f64,
    ) -> View<MOST_MODES> {
        let size = steady.amplitude() / length;
        let turn = self.frequency * self.step;
        let mut view = View {
            base: base / length,
            steady: [steady.sine / length, steady.cosine / length],
            steady_size: size,
            sixth_steady: size * turn * turn * turn * turn * turn * turn / 7200.0,
            second_steady: size * self.frequency * self.frequency,
            ..View::NONE
        };
        for (k, value) in shape.iter().enumerate() {
            let (value, squared) = (value / length, self.modes[k].stiffness);
            let turned = squared * self.step * self.step;
            view.shape[k] = value;
            view.second[k] = value.abs() * squared;
            view.sixth[k] = value.abs() * turned * turned * turned / 7200.0;
        }
        view
    }

    /// The first `N` modes and `M` absorbers.
    pub(super) fn first<const N: usize, const M: usize>(&self) -> Constants<N, M> {
        Constants {
            fastest: self.fastest,
            step: self.step,
            frequency: self.frequency,
            inverse_frequency: self.inverse_frequency,
            swings: self.swings,
            modes: std::array::from_fn(|k| self.modes[k]),
            views: std::array::from_fn(|j| self.views[j].first()),
            kicks: std::array::from_fn(|j| Kick {
                turn: std::array::from_fn(|k| self.kicks[j].turn[k]),
                push: self.kicks[j].push,
                loss: self.kicks[j].loss,
                bend: self.kicks[j].bend,
                restitution: self.kicks[j].restitution,
                inverse_loss: self.kicks[j].inverse_loss,
            }),
        }
    }
}

pub(super) fn sine_and_cosine(angle: f64) -> [f64; 2] {
    libm::sincos(angle).into()
}

impl View<MOST_MODES> {
    pub(super) const NONE: Self = Self {
        shape: [0.0; MOST_MODES],
        base: 0.0,
        steady: [0.0; 2],
        steady_size: 0.0,
        sixth: [0.0; MOST_MODES],
        sixth_steady: 0.0,
        second: [0.0; MOST_MODES],
        second_steady: 0.0,
    };

    pub(super) fn first<const N: usize>(&self) -> View<N> {
        View {
            shape: std::array::from_fn(|k| self.shape[k]),
            base: self.base,
            steady: self.steady,
            steady_size: self.steady_size,
            sixth: std::array::from_fn(|k| self.sixth[k]),
            sixth_steady: self.sixth_steady,
            second: std::array::from_fn(|k| self.second[k]),
            second_steady: self.second_steady,
        }
    }
}

impl<const N: usize> View<N> {
    /// The place alone.
    #[inline(always)]
    pub(super) fn at(&self, at: &Phasors<N>) -> f64 {
        let ([sin, cos], [s, c]) = (at.rotor, self.steady);
        self.shape.iter().zip(&at.z).fold(s * sin + c * cos, |x, (phi, [re, _])| x + phi * re)
    }
}

impl Kick<MOST_MODES> {
    const NONE: Self = Self {
        turn: [0.0; MOST_MODES],
        push: 0.0,
        loss: 0.0,
        bend: 0.0,
        restitution: 1.0,
        inverse_loss: 1.0,
    };
}

impl<const N: usize> Phasors<N> {
    /// Those of as many modes as there can be.
    pub fn of_most(&self) -> Phasors<MOST_MODES> {
        let of = |k: usize| self.z.get(k).copied().unwrap_or_default();
        Phasors { z: std::array::from_fn(of), rotor: self.rotor }
    }

    /// A time `e` on, at most `1e-4` over the fastest rate: to the fourth order, which is to rounding.
    #[inline(always)]
    fn turned(&self, modes: &[ModeRates; N], frequency: f64, e: f64) -> Self {
        let mut turned = *self;
        for (z, mode) in turned.z.iter_mut().zip(modes) {
            *z = multiply(*z, near(-mode.decay * e, mode.ringing * e));
        }
        let [sin, cos] = self.rotor;
        let [c, s] = near(0.0, frequency * e);
        turned.rotor = [sin * c + cos * s, cos * c - sin * s];
        turned
    }
}

/// `e^{x + i angle}` of numbers of at most `1e-4`, to the fourth order.
#[inline(always)]
fn near(x: f64, angle: f64) -> [f64; 2] {
    let envelope = 1.0 + x * (1.0 + x * (0.5 + x * (1.0 / 6.0 + x * (1.0 / 24.0))));
    let squared = angle * angle;
    let cos = 1.0 - squared * (0.5 - squared * (1.0 / 24.0));
    let sin = angle * (1.0 - squared * (1.0 / 6.0));
    [envelope * cos, envelope * sin]
}

impl<const N: usize, const M: usize> Constants<N, M> {
    /// A whole panel of a length on.
    #[inline(always)]
    pub fn next(&self, here: &Phasors<N>, length: usize) -> Phasors<N> {
        let mut next = *here;
        for (z, mode) in next.z.iter_mut().zip(&self.modes) {
            *z = multiply(*z, mode.turns[length]);
        }
        let ([sin, cos], [s, c]) = (here.rotor, self.swings[length]);
        next.rotor = [sin * c + cos * s, cos * c - sin * s];
        next
    }

    /// A time `s` on, at most the longest panel.
    pub fn far_after(&self, here: &Phasors<N>, mut s: f64) -> Phasors<N> {
        let mut there = *here;
        for length in (0..LENGTHS).rev() {
            let whole = self.step * longer(length);
            if whole <= s {
                (there, s) = (self.next(&there, length), s - whole);
            }
        }
        self.after(&there, s)
    }

    /// A time `s` on, at most the shortest panel.
    #[inline(always)]
    pub fn after(&self, here: &Phasors<N>, s: f64) -> Phasors<N> {
        let mut there = *here;
        for (z, mode) in there.z.iter_mut().zip(&self.modes) {
            let envelope = small_exponential(-(mode.decay * s));
            let (sin, cos) = small_angle(mode.ringing * s);
            *z = multiply(*z, [envelope * cos, envelope * sin]);
        }
        let ([sin, cos], (s, c)) = (here.rotor, small_angle(self.frequency * s));
        there.rotor = [sin * c + cos * s, cos * c - sin * s];
        there
    }

    /// The phasors of the derivative: times `p_k`.
    pub fn derivative(&self, of: &Phasors<N>) -> Phasors<N> {
        let mut derived = *of;
        for (z, mode) in derived.z.iter_mut().zip(&self.modes) {
            *z = multiply(*z, [-mode.decay, mode.ringing]);
        }
        derived
    }

    /// Next to it.
    #[inline(always)]
    pub fn nearby(&self, here: &Phasors<N>, e: f64) -> Phasors<N> {
        here.turned(&self.modes, self.frequency, e)
    }

    #[inline(always)]
    pub fn free(&self, at: &Phasors<N>) -> Free<N> {
        let mut free = [[0.0; N]; 3];
        let [xs, vs, accelerations] = &mut free;
        for (k, (mode, [re, im])) in self.modes.iter().zip(&at.z).enumerate() {
            let v = -(mode.decay * re + mode.ringing * im);
            xs[k] = *re;
            vs[k] = v;
            accelerations[k] = -(2.0 * mode.decay * v) - mode.stiffness * re;
        }
        Free(free)
    }

    /// Place, velocity and acceleration of what is seen.
    #[inline(always)]
    pub fn seen(&self, view: &View<N>, free: &Free<N>, rotor: [f64; 2]) -> [f64; 3] {
        let ([sin, cos], [s, c]) = (rotor, view.steady);
        let steady = s * sin + c * cos;
        let mut x = steady;
        let mut v = self.frequency * (s * cos - c * sin);
        let mut a = -(self.frequency * self.frequency * steady);
        for k in 0..N {
            x += view.shape[k] * free.0[0][k];
            v += view.shape[k] * free.0[1][k];
            a += view.shape[k] * free.0[2][k];
        }
        [x, v, a]
    }

    /// Its third and fourth derivative.
    #[inline(always)]
    pub fn further(&self, view: &View<N>, free: &Free<N>, rotor: [f64; 2]) -> [f64; 2] {
        let ([sin, cos], [s, c]) = (rotor, view.steady);
        let squared = self.frequency * self.frequency;
        let mut jerk = -(squared * self.frequency * (s * cos - c * sin));
        let mut snap = squared * squared * (s * sin + c * cos);
        for k in 0..N {
            let mode = &self.modes[k];
            let own = -(2.0 * mode.decay * free.0[2][k]) - mode.stiffness * free.0[1][k];
            jerk += view.shape[k] * own;
            snap += view.shape[k] * (-(2.0 * mode.decay * own) - mode.stiffness * free.0[2][k]);
        }
        [jerk, snap]
    }

    /// Sizes of the free phasors.
    #[inline(always)]
    pub fn sizes(&self, at: &Phasors<N>) -> [f64; N] {
        let mut sizes = [0.0; N];
        for (size, [re, im]) in sizes.iter_mut().zip(&at.z) {
            *size = (re * re + im * im).sqrt();
        }
        sizes
    }

    /// How well quintics are known from a moment on, and a bound on the acceleration.
    #[inline(always)]
    pub fn slack(&self, view: &View<N>, sizes: &[f64; N]) -> (Slack<f64>, f64) {
        let (mut coefficient, mut bend) = (view.sixth_steady, view.second_steady);
        for (k, free) in sizes.iter().enumerate() {
            coefficient += view.sixth[k] * free;
            bend += view.second[k] * free;
        }
        // 4 M S/14340 with S = 7200 times the coefficient.
        (Slack { coefficient, slope_squared: bend * coefficient * 2.01 }, bend)
    }

    /// A bound on the derivative of an order, from a moment on, in the units of the structure.
    pub fn bound(&self, view: &View<N>, sizes: &[f64; N], order: i32) -> f64 {
        let power = |rate: f64| (0..order).fold(1.0, |product, _| product * rate);
        let start = view.steady_size * power(self.frequency);
        (0..N).fold(start, |sum, k| {
            sum + view.shape[k].abs() * sizes[k] * power(self.modes[k].stiffness.sqrt())
        })
    }

    /// By how much rounding moves a wall, over the clearance.
    #[inline(always)]
    pub fn touch(&self, view: &View<N>, sizes: &[f64; N], line: StraightLine<f64>) -> f64 {
        let mut size = 1.0 + view.steady_size + line.y.abs() + line.velocity.abs();
        for (phi, free) in view.shape.iter().zip(sizes) {
            size += phi.abs() * free;
        }
        TOUCH * size
    }

    /// An impact with a relative velocity over the clearance.
    #[inline(always)]
    pub fn strike(&self, j: usize, w: f64, at: &mut Phasors<N>, velocity: &mut f64) {
        let kick = &self.kicks[j];
        for (z, turn) in at.z.iter_mut().zip(&kick.turn) {
            z[1] += turn * w;
        }
        *velocity += kick.push * w;
    }

    /// The energy that an impact with a relative velocity over the clearance loses.
    pub fn loss(&self, j: usize, w: f64) -> f64 {
        self.kicks[j].loss * w * w
    }

    /// Time until a phase's period is over.
    #[inline(always)]
    pub fn left(&self, phase: f64) -> f64 {
        (std::f64::consts::TAU - phase) * self.inverse_frequency
    }
}
