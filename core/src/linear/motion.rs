//! What does not rattle: the structure alone, and with a tuned mass damper of the absorber's mass, released, swept or
//! driven as the structure with the absorber is. A step of time is a matrix exponential, so there is no error of
//! integration.

use std::collections::HashMap;
use std::f64::consts::TAU;

use nalgebra::{SMatrix, SVector};

use super::{Meter, Passage, Response, STEPS, Settling, StillToCome, TunedMassDamper};
use crate::excitation::{Piece, SineSweep, amplitude};
use crate::numerics::extremes::{Cubic, RateSums};
use crate::system::{Scales, Shaking, State, System};

/// A linear structure on its way to rest, per step as [`Ringdown`](crate::flights::Ringdown).
#[derive(Debug, Clone, PartialEq)]
pub struct Linear {
    /// Amplitude of the structure.
    pub amplitudes: Vec<f64>,
    /// Largest displacement of the structure.
    pub peak: f64,
    /// Largest displacement of the damper's mass against the structure.
    pub stroke: f64,
    /// Oscillations after which the amplitude stays at the level or below it; infinite where that was not seen.
    pub settles: f64,
}

/// The structure with a damper, or alone, from a state, over so many oscillations or until its amplitude has
/// stayed below a level for twenty. The damper's mass begins in the middle of its travel.
pub fn released(
    system: &System,
    damper: Option<&TunedMassDamper>,
    start: State,
    level: f64,
    oscillations: u64,
) -> Linear {
    released_between(system, damper, None, start, level, oscillations)
}

/// The same where the damper's mass has no more room than so much to either side, over the clearance: it hits stops with
/// the restitution of the system. Impacts within a step are where a cubic between its ends meets the stop, `h^4/384`.
pub fn released_between(
    system: &System,
    damper: Option<&TunedMassDamper>,
    room: Option<f64>,
    start: State,
    level: f64,
    oscillations: u64,
) -> Linear {
    let duration = TAU / f64::from(STEPS_OF_PERIOD);
    let rates: Free = matrix(system, damper).fixed_view::<4, 4>(0, 0).into_owned();
    let step = exponential(rates * duration);
    let mut state = Moving::from([start.x, start.x_velocity, start.x, start.y_velocity]);
    let (amplitudes, settles) = (vec![amplitude(&start)], f64::INFINITY);
    let mut found = Linear { amplitudes, peak: 0.0, stroke: 0.0, settles };
    let mut settling = Settling::to(level);
    settling.see(0.0, amplitude(&start));
    let last = oscillations.saturating_mul(STEPS_OF_PERIOD.into());
    for k in 1..=last {
        let mut after = step * state;
        let [peak, stroke] = largest(duration, [&state, &after], [found.peak, found.stroke]);
        match room.filter(|room| stroke > *room) {
            Some(room) => {
                after = stopped(system, &rates, duration, state, room);
                let ends = state[0].abs().max(after[0].abs());
                (found.peak, found.stroke) = (found.peak.max(ends), room);
            }
            None => (found.peak, found.stroke) = (peak, stroke),
        }
        state = after;
        let time = k as f64 / f64::from(STEPS_OF_PERIOD);
        let now = amplitude(&State { x: state[0], x_velocity: state[1], ..start });
        settling.see(time, now);
        if k % u64::from(STEPS_OF_PERIOD / STEPS) == 0 {
            found.amplitudes.push(now);
        }
        if time > settling.time + f64::from(BEAT) {
            break;
        }
    }
    found.settles = settling.time;
    found
}

/// Impacts in a step after which the mass of a damper is taken to move with its stop.
const MOST_IMPACTS: u32 = 64;

/// The end of a step in which the mass of a damper meets its stops.
fn stopped(system: &System, rates: &Free, duration: f64, mut state: Moving, room: f64) -> Moving {
    let (mu, mut left) = (system.mass_ratio(), duration);
    for k in 0..=MOST_IMPACTS {
        let after = exponential(rates * left) * state;
        let ends = [&state, &after].map(|at| [at[0] - at[2], at[1] - at[3]]);
        let Some(time) = Cubic::of(left, ends).leaves(room) else { return after };
        state = exponential(rates * time) * state;
        left -= time;
        // Momentum stays, and the relative velocity turns.
        let restitution = if k < MOST_IMPACTS { system.restitution() } else { 0.0 };
        let impulse = (1.0 + restitution) * (state[1] - state[3]) / (1.0 + mu);
        state[1] -= mu * impulse;
        state[3] += impulse;
    }
    exponential(rates * left) * state
}

/// The structure with a damper, or alone, at rest until it is driven. A straight line of the excitation is a state
/// of its own, with which a step is a matrix exponential. Velocity and acceleration are measured where they are asked for.
/// Where the pieces end with one of rest it rings on until none of it can become larger.
pub fn driven(
    system: &System,
    damper: Option<&TunedMassDamper>,
    pieces: &[Piece],
    shaking: bool,
) -> Response {
    let mut motion = Driven::of(system, damper, pieces, shaking);
    for piece in pieces {
        let mut next = *piece;
        motion.meter.jump(&next, &mut motion.state);
        next.jump = 0.0;
        if !next.is_rest() {
            motion.pass(&next);
            continue;
        }
        motion.mean_squares = motion.shakes.map(|sums| sums.mean_squares());
        loop {
            let bounds = still_to_come(system, damper, &motion.state, next.base);
            let rates = motion.shakes.map(|sums| sums.peaks);
            if bounds.is_nothing(&motion.meter.found, rates)
                || motion.meter.gives_up(&next, bounds.displacement)
            {
                break;
            }
            motion.pass(&next);
        }
    }
    let Driven { meter, shakes, mean_squares, .. } = motion;
    let shaken = |sums: RateSums| {
        Shaking::of(sums.peaks, mean_squares.unwrap_or_else(|| sums.mean_squares()))
    };
    Response { shaking: shakes.map(shaken), ..meter.finished() }
}

/// What a linear structure can still reach that nothing drives any more, by the energy of it and its damper:
/// `E = (x'^2 + x^2 + mu y'^2 + mu f^2 (x - y)^2)/2` falls, and each of its parts is at most all of it.
fn still_to_come(
    system: &System,
    damper: Option<&TunedMassDamper>,
    state: &State,
    base: f64,
) -> StillToCome {
    let mu = damper.map_or(0.0, |_| system.mass_ratio());
    let [tuning, damping_ratio] =
        damper.map_or([0.0; 2], |damper| [damper.tuning, damper.damping_ratio]);
    let stretched = tuning * state.relative_displacement();
    let most = (2.0 * state.energy(mu) + mu * stretched * stretched).sqrt();
    // x'' = -x - eps lambda x' - mu f^2 (x - y) - 2 mu zeta f (x' - y').
    let pull = tuning * mu.sqrt() + 2.0 * damping_ratio * tuning * (mu * (1.0 + mu)).sqrt();
    let acceleration = libm::hypot(1.0, system.mass_ratio() * system.damping()) + pull;
    StillToCome {
        displacement: most,
        stroke: if mu > 0.0 { most / (tuning * mu.sqrt()) } else { 0.0 },
        rates: [base.abs() + most, acceleration * most],
    }
}

/// A linear structure under way.
struct Driven {
    meter: Meter,
    state: State,
    rates: Square,
    /// Even times of a record are rounded, so that its pieces have a few durations.
    steps: HashMap<u64, Step>,
    /// That of the latest piece, with its duration.
    latest: (f64, Step),
    shakes: Option<RateSums>,
    /// Mean square velocity and acceleration until nothing drove any more.
    mean_squares: Option<[f64; 2]>,
}

impl Driven {
    fn of(
        system: &System,
        damper: Option<&TunedMassDamper>,
        pieces: &[Piece],
        shaking: bool,
    ) -> Self {
        let mass_ratio = damper.map_or(0.0, |_| system.mass_ratio());
        let mut rates = matrix(system, damper);
        rates.fixed_columns_mut::<2>(4).fill(0.0);
        // The force acts on the structure, that of a base which shakes on both masses; and it grows.
        rates[(1, 4)] = 1.0;
        rates[(3, 4)] = f64::from(u8::from(pieces.first().is_some_and(|piece| piece.shakes)));
        rates[(4, 5)] = 1.0;
        Self {
            meter: Meter::new(mass_ratio, system.mass_ratio() * system.damping()),
            state: State::AT_REST,
            rates,
            steps: HashMap::new(),
            latest: (0.0, Step::identity()),
            shakes: shaking.then(RateSums::default),
            mean_squares: None,
        }
    }

    /// Goes through a piece, at whose beginning nothing jumps.
    fn pass(&mut self, piece: &Piece) {
        let rates = self.rates;
        if self.latest.0 != piece.duration {
            if self.steps.len() > MOST_STEPS {
                self.steps.clear();
            }
            let step = self.steps.entry(piece.duration.to_bits());
            let step = step.or_insert_with(|| moves(&exponential(rates * piece.duration)));
            self.latest = (piece.duration, *step);
        }
        let State { x, x_velocity, y, y_velocity } = self.state;
        let [force, slope] = piece.force;
        let begin = LinearState::from([x, x_velocity, y, y_velocity, force, slope]);
        let at_end = self.latest.1 * begin;
        if let Some(sums) = &mut self.shakes {
            // The base, which moves by as much as the force is its inertia.
            let base = f64::from(u8::from(piece.shakes));
            let absolute = |at: &LinearState, s: f64| {
                let [velocity, acceleration, jerk] = shaken(&rates, at);
                let moves = piece.base - base * s * (force + 0.5 * s * slope);
                [velocity + moves, acceleration - base * at[4], jerk - base * slope]
            };
            let driven = [force + piece.duration * slope, slope];
            let ends = [absolute(&begin, 0.0), absolute(&with(&at_end, driven), piece.duration)];
            sums.add_short(piece.duration, ends);
        }
        let end =
            State { x: at_end[0], x_velocity: at_end[1], y: at_end[2], y_velocity: at_end[3] };
        self.meter.moved(piece, [0.0, piece.duration], [&self.state, &end]);
        self.meter.passed(piece, &end);
        self.state = end;
    }
}

/// Velocity, acceleration and jerk of the structure.
fn shaken(rates: &Square, state: &LinearState) -> [f64; 3] {
    let first = rates * state;
    [first[0], first[1], (rates.fixed_rows::<1>(1) * first)[0]]
}

/// Steps of a record that are kept at once.
const MOST_STEPS: usize = 256;

/// Steps in a period: cubics between two of them are off by `h^4/384`, 1.5e-8 of the motion.
const STEPS_OF_PERIOD: u32 = 128;

/// The structure with a damper, or alone, from rest through a sweep. Velocity and acceleration are measured where they are
/// asked for.
pub fn swept(
    system: &System,
    damper: Option<&TunedMassDamper>,
    scales: &Scales,
    sweep: &SineSweep,
    shaking: bool,
) -> Passage {
    let mut found = Passage::new(sweep.count(), 0.0);
    let mut shakes = shaking.then(RateSums::default);
    let mut state = LinearState::zeros();
    for stretch in sweep.stretches(scales) {
        let Ok(piece) = stretch.system(system) else { break };
        let left = TAU - stretch.begins;
        let steps = libm::ceil(left / TAU * f64::from(STEPS_OF_PERIOD)) as u32;
        let duration = stretch.duration() / f64::from(steps);
        let rates = matrix(&piece, damper);
        let step = exponential(rates * duration);
        let (step, turn) = (moves(&step), step.fixed_view::<2, 2>(4, 4).into_owned());
        let (sine, cosine) = libm::sincos(stretch.begins);
        (state[4], state[5]) = (sine, cosine);
        let mut peak = 0.0_f64;
        for _ in 0..steps {
            let after = step * state;
            let ends = [&state.fixed_rows::<4>(0).into_owned(), &after];
            [peak, found.stroke] = largest(duration, ends, [peak, found.stroke]);
            let after = with(&after, (turn * state.fixed_rows::<2>(4)).into());
            if let Some(sums) = &mut shakes {
                sums.add_short(duration, [&state, &after].map(|at| shaken(&rates, at)));
            }
            state = after;
        }
        found.passed(&stretch, peak);
    }
    found.shaking = shakes.map(|sums| Shaking::of(sums.peaks, sums.mean_squares()));
    found
}

/// The largest displacement of the structure, and of the damper's mass against it, in a step and before.
fn largest(duration: f64, ends: [&Moving; 2], [peak, stroke]: [f64; 2]) -> [f64; 2] {
    let x = ends.map(|at| [at[0], at[1]]);
    let against = ends.map(|at| [at[0] - at[2], at[1] - at[3]]);
    let beyond = |ends, known| Cubic::of(duration, ends).largest_beyond(known);
    [beyond(x, peak), beyond(against, stroke)]
}

/// Oscillations that a structure stays below a level before it counts as calm: a damper may give energy back.
const BEAT: u32 = 20;

/// What terms of a series that are left out come to at most.
const LEFT_OUT: f64 = 1e-18;

/// The exponential of a matrix, by its series at a fraction of it, whose norm is at most 1, and squaring (nalgebra's needs the
/// system's mathematical library).
fn exponential<const N: usize>(of: SMatrix<f64, N, N>) -> SMatrix<f64, N, N> {
    let halvings = libm::ceil(libm::log2(of.norm())).max(0.0) as u32;
    let part = of / libm::pow(2.0, f64::from(halvings));
    let (norm, mut terms, mut term) = (part.norm(), 0, 1.0);
    while term > LEFT_OUT {
        terms += 1;
        term *= norm / f64::from(terms);
    }
    // 1 + A (1 + A/2 (1 + A/3 (...))).
    let mut power = SMatrix::identity();
    for k in (1..=terms).rev() {
        power = part * power / f64::from(k);
        (0..N).for_each(|n| power[(n, n)] += 1.0);
    }
    for _ in 0..halvings {
        power = power * power;
    }
    power
}

/// Displacement and velocity of the structure, the same of the damper.
type Moving = SVector<f64, 4>;
type Free = SMatrix<f64, 4, 4>;
/// The same with what drives them: sine and cosine of the excitation's phase, or a force and its slope.
type LinearState = SVector<f64, 6>;
type Square = SMatrix<f64, 6, 6>;
/// What a step makes of that.
type Step = SMatrix<f64, 4, 6>;

fn moves(step: &Square) -> Step {
    step.fixed_rows::<4>(0).into_owned()
}

fn with(moving: &Moving, driven: [f64; 2]) -> LinearState {
    let ([x, v, y, w], [first, second]) = ((*moving).into(), driven);
    [x, v, y, w, first, second].into()
}

/// The derivative of a [`LinearState`].
fn matrix(system: &System, damper: Option<&TunedMassDamper>) -> Square {
    let mu = system.mass_ratio();
    let loss = mu * system.damping();
    let [spring, dashpot] = damper.map_or([0.0; 2], |damper| {
        [damper.tuning * damper.tuning, 2.0 * damper.damping_ratio * damper.tuning]
    });
    let [pull, drag] = [mu * spring, mu * dashpot];
    let (sine, cosine) = system.excitation_amplitudes();
    let omega = system.frequency_ratio();
    Square::from_row_slice(
        &[
            [0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
            [-1.0 - pull, -loss - drag, pull, drag, sine, cosine],
            [0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
            [spring, dashpot, -spring, -dashpot, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0, 0.0, omega],
            [0.0, 0.0, 0.0, 0.0, -omega, 0.0],
        ]
        .concat(),
    )
}
