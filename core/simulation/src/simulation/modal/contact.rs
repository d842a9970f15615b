//! Absorbers that rest on a wall: the end of a chattering sequence, and the coupled modes until the contact force changes its sign.
//!
//! With the set `C` of those that rest the modes have the mass matrix `M + sum_C m_j phi_j phi_j^T`, and damping is no longer
//! modal. In a panel of half a radian of the fastest mode the motion is its series to rounding: every coefficient follows from
//! the two before by the equation of motion. The `n`-th derivative `u` of the motion is a motion under the `n`-th derivative of
//! the force, whose energy grows by no more than that does work: `sqrt(u'^T M u' + u^T K u)` by at most `h Omega^n F`,
//! `F^2 = f^T M^-1 f`. So `abs(phi^T u')` is bounded by that root times `sqrt(phi^T M^-1 phi)`, and the certified search needs
//! no more. The masses only lower the frequencies.

use std::f64::consts::FRAC_PI_2;

use super::flight::{LARGEST_TOUCH, clear_of_wall};
use super::motion::{Gap, View, sine_and_cosine};
use super::{All, Course, Detail, MOST, ModalObserver, ModalSegment, ModalSimulation, STILL, Told};
use crate::numerics::crossing::{CrossingBand, Edge, Sample, Search, first_of};
use crate::simulation::Stop;
use crate::simulation::contact::{AtWall, ContactTolerance};
use crate::simulation::path::{Path, StraightLine};
use crate::system::ModalState;

/// Angle of the fastest mode in a panel.
const ANGLE: f64 = 0.5;
/// Last power of the series: the next is below `0.5^18/18! = 6e-22`, and so is what a fourth derivative leaves out, `1e-17`.
const LAST: usize = 17;

/// `1`, `1/2`, ...
const INVERSES: [f64; LAST + 1] = {
    let mut inverses = [1.0; LAST + 1];
    let mut n = 0;
    while n <= LAST {
        inverses[n] = 1.0 / (n + 1) as f64;
        n += 1;
    }
    inverses
};

/// Acceleration by a wall, over the largest that there is, that is none.
const NO_FORCE: f64 = 1e-12;
/// Most steps of a relaxation.
const RELAXATIONS: usize = 2000;

type Vector = [f64; MOST];

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The inverse of the mass matrix with the masses of those that rest.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Inverse {
    modes: usize,
    rows: [Vector; MOST],
    stuck: Vector,
}

impl Inverse {
    /// By a change of rank one for each of them (Sherman and Morrison).
    pub(super) fn of(all: &All, stuck: &Vector) -> Self {
        let mut rows = [[0.0; MOST]; MOST];
        for (k, row) in rows.iter_mut().enumerate() {
            row[k] = 1.0 / all.masses[k];
        }
        let mut inverse = Self { modes: all.modes, rows, stuck: *stuck };
        for j in (0..all.absorbers).filter(|j| stuck[*j] != 0.0) {
            let shape = all.shape(j);
            let moved = inverse.times(&shape);
            let share =
                all.absorber_masses[j] / (1.0 + all.absorber_masses[j] * dot(&shape, &moved));
            for (row, by) in inverse.rows.iter_mut().zip(&moved) {
                row.iter_mut().zip(&moved).for_each(|(entry, other)| *entry -= share * by * other);
            }
        }
        inverse
    }

    fn times(&self, vector: &Vector) -> Vector {
        let mut product = [0.0; MOST];
        let rows = product.iter_mut().zip(&self.rows).take(self.modes);
        rows.for_each(|(one, row)| *one = dot(&row[..self.modes], vector));
        product
    }
}

impl All {
    /// The modes' values at an absorber.
    pub(super) fn shape(&self, j: usize) -> Vector {
        self.constants.views[j].shape.map(|value| value * self.clearances[j])
    }
}

/// The motion of the coupled modes in a short time.
#[derive(Debug)]
pub(super) struct HeldPanel {
    /// Derivatives of the modes' coordinates at its beginning.
    derivatives: [Vector; LAST + 1],
    phase: f64,
    frequency: f64,
    length: f64,
    /// `sqrt(u'^T M u' + u^T K u)` of the motion and its first seven derivatives, at most.
    energies: [f64; 8],
    inverse: Inverse,
}

impl HeldPanel {
    fn of(all: &All, state: &ModalState, phase: f64, inverse: &Inverse) -> Self {
        let constants = &all.constants;
        let (frequency, squared) = (constants.frequency, constants.frequency * constants.frequency);
        let mut force = all.forces;
        for j in (0..all.absorbers).filter(|j| inverse.stuck[*j] != 0.0) {
            // The inertia of what rests on a wall of a structure whose base moves.
            let by_base = all.absorber_masses[j] * squared * all.base;
            force.iter_mut().zip(all.shape(j)).for_each(|(one, phi)| *one += by_base * phi);
        }
        let [sin, cos] = sine_and_cosine(phase);
        // Derivatives of the sine, from two before.
        let mut swing = [sin, frequency * cos];
        let mut derivatives = [[0.0; MOST]; LAST + 1];
        derivatives[0] = state.modes.map(|[q, _]| q);
        derivatives[1] = state.modes.map(|[_, v]| v);
        for n in 0..LAST - 1 {
            let (here, next) = (derivatives[n], derivatives[n + 1]);
            let mut forces = [0.0; MOST];
            for (k, one) in forces.iter_mut().enumerate().take(all.modes) {
                let mode = &constants.modes[k];
                let own = 2.0 * mode.decay * next[k] + mode.stiffness * here[k];
                *one = force[k] * swing[n % 2] - all.masses[k] * own;
            }
            derivatives[n + 2] = inverse.times(&forces);
            swing[n % 2] *= -squared;
        }
        let length = (ANGLE / constants.fastest).min(constants.left(phase));
        let mut work = dot(&force, &inverse.times(&force)).sqrt() * length;
        let energies = std::array::from_fn(|n| {
            let (u, v) = (&derivatives[n], &derivatives[n + 1]);
            let modes: f64 = (0..all.modes)
                .map(|k| all.masses[k] * (v[k] * v[k] + constants.modes[k].stiffness * u[k] * u[k]))
                .sum();
            let held = (0..all.absorbers).filter(|j| inverse.stuck[*j] != 0.0).map(|j| {
                let speed = dot(&all.shape(j), v);
                all.absorber_masses[j] * speed * speed
            });
            let energy = (modes + held.sum::<f64>()).sqrt() + work;
            work *= frequency;
            energy
        });
        Self { derivatives, phase, frequency, length, energies, inverse: inverse.clone() }
    }

    /// A derivative of a mode's coordinate.
    fn mode(&self, k: usize, s: f64, order: usize) -> f64 {
        let mut sum = 0.0;
        for n in (order..=LAST).rev() {
            sum = self.derivatives[n][k] + sum * (s * INVERSES[n - order]);
        }
        sum
    }

    pub(super) fn state(&self, s: f64) -> ModalState {
        let mut state = ModalState::default();
        for (k, mode) in state.modes.iter_mut().enumerate().take(self.inverse.modes) {
            *mode = [self.mode(k, s, 0), self.mode(k, s, 1)];
        }
        state
    }

    /// What is seen of it.
    pub(super) fn sight(&self, view: &View<MOST>) -> Sight {
        let shape = &view.shape[..self.inverse.modes];
        Sight {
            derivatives: std::array::from_fn(|n| dot(shape, &self.derivatives[n])),
            base: view.base,
            phase: self.phase,
            frequency: self.frequency,
        }
    }

    /// What a derivative of what is seen, of order 1 to 8, does not exceed.
    pub(super) fn bound(&self, view: &View<MOST>, order: usize) -> f64 {
        let power = (0..order).fold(1.0, |product, _| product * self.frequency);
        let seen = dot(&view.shape, &self.inverse.times(&view.shape));
        seen.max(0.0).sqrt() * self.energies[order - 1] + view.base.abs() * power
    }
}

/// What is seen of a panel: its derivatives at the beginning, and the base's part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sight {
    derivatives: [f64; LAST + 1],
    base: f64,
    phase: f64,
    frequency: f64,
}

impl Sight {
    const NOTHING: Self =
        Self { derivatives: [0.0; LAST + 1], base: 0.0, phase: 0.0, frequency: 0.0 };

    /// What a derivative of it, of a small order, looks like.
    pub(super) fn derivative(self, order: usize) -> Self {
        (0..order).fold(self, |of, _| {
            let mut derivatives = [0.0; LAST + 1];
            derivatives[..LAST].copy_from_slice(&of.derivatives[1..]);
            let base = of.base * of.frequency;
            Self { derivatives, base, phase: of.phase + FRAC_PI_2, frequency: of.frequency }
        })
    }

    /// A derivative.
    pub(super) fn at(&self, s: f64, order: usize) -> f64 {
        let mut sum = 0.0;
        for n in (order..=LAST).rev() {
            sum = self.derivatives[n] + sum * (s * INVERSES[n - order]);
        }
        if self.base == 0.0 {
            return sum;
        }
        let [sin, cos] = sine_and_cosine(self.phase + self.frequency * s);
        let power = (0..order).fold(1.0, |product, _| product * self.frequency);
        sum + self.base * power * [sin, cos, -sin, -cos][order % 4]
    }

    /// What is seen, and its first two derivatives.
    pub(super) fn moment(&self, s: f64) -> [f64; 3] {
        [0, 1, 2].map(|order| self.at(s, order))
    }
}

impl ModalSimulation {
    /// Lets each absorber that stands on its wall, and is not thrown off, rest there.
    pub(super) fn settle(&mut self, observer: &mut dyn ModalObserver) {
        // What comes to rest changes how the walls of the others accelerate.
        let mut changed = true;
        while changed {
            changed = false;
            for j in 0..self.all.absorbers {
                if self.at.walls[j] == 0.0 || self.stuck[j] != 0.0 {
                    continue;
                }
                if let Some(loss) = self.comes_to_rest(j) {
                    observer.sticks(j, loss);
                    changed = true;
                }
            }
        }
        self.solve_contacts(Some(observer));
    }

    /// Of several absorbers that stand on their walls and move with them, lets those rest which a wall pushes, and the others
    /// leave: no wall pulls, and none runs into what it does not push. The forces are the one solution of a complementarity
    /// problem with a positive matrix, by projected relaxation (Gauss and Seidel).
    /// Where somebody is there to be told of the loss, also those whose gaps open by no more than chattering may leave.
    fn solve_contacts(&mut self, observer: Option<&mut dyn ModalObserver>) {
        let (all, constants) = (&self.all, &self.all.constants);
        let sizes = constants.sizes(&self.at.phasors);
        let (mut walls, mut opens) = (self.stuck, [false; MOST]);
        for j in (0..all.absorbers).filter(|j| self.stuck[*j] == 0.0) {
            let (view, line, wall) = (&constants.views[j], self.at.lines[j], self.at.walls[j]);
            let touch = constants.touch(view, &sizes, line);
            let opening = -wall * constants.gap(j, &self.at.phasors, line).slope;
            opens[j] = opening.abs() > touch * self.roughness();
            let excursion = ContactTolerance::default().excursion.max(touch);
            let little = opening * opening <= 2.0 * excursion * constants.slack(view, &sizes).1;
            if !opens[j] || (observer.is_some() && opening > 0.0 && little) {
                walls[j] = wall;
            }
        }
        let on = |j: &usize| walls[*j] != 0.0;
        if (0..MOST).filter(on).count() < 2 {
            return;
        }
        let free = Inverse::of(all, &[0.0; MOST]);
        let panel = HeldPanel::of(all, &self.state(), self.at.phase, &free);
        let (mut closing, mut forces, mut largest) = ([0.0; MOST], [0.0_f64; MOST], 0.0_f64);
        for j in (0..MOST).filter(on) {
            let view = &constants.views[j];
            closing[j] = walls[j] * panel.sight(view).at(0.0, 2) * all.clearances[j];
            largest = largest.max(panel.bound(view, 2) * all.clearances[j]);
        }
        let yields = |i: usize, j: usize| {
            let own = if i == j { 1.0 / all.absorber_masses[j] } else { 0.0 };
            own + walls[i] * walls[j] * dot(&all.shape(i), &free.times(&all.shape(j)))
        };
        let matrix: [Vector; MOST] = std::array::from_fn(|i| {
            std::array::from_fn(|j| if on(&i) && on(&j) { yields(i, j) } else { 0.0 })
        });
        for _ in 0..RELAXATIONS {
            let mut changed = 0.0_f64;
            for j in (0..MOST).filter(on) {
                let left = closing[j] - dot(&matrix[j], &forces);
                let force = (forces[j] + left / matrix[j][j]).max(0.0);
                changed = changed.max((force - forces[j]).abs() * matrix[j][j]);
                forces[j] = force;
            }
            if changed <= f64::EPSILON * largest {
                break;
            }
        }
        let mut pushed = [false; MOST];
        for j in (0..MOST).filter(on) {
            pushed[j] = forces[j] * matrix[j][j] > NO_FORCE * largest;
            if opens[j] {
                continue;
            }
            self.stuck[j] = if pushed[j] { walls[j] } else { 0.0 };
            self.at.walls[j] = if pushed[j] { 0.0 } else { walls[j] };
            let Gap { gap, slope, .. } = self.all.constants.gap(j, &self.at.phasors, STILL);
            self.at.lines[j] = StraightLine { y: gap - walls[j], velocity: slope };
        }
        self.inverse = Inverse::of(&self.all, &self.stuck);
        if let Some(observer) = observer {
            for j in (0..MOST).filter(|j| opens[*j] && pushed[*j]) {
                let loss = self.stick(j, walls[j]);
                observer.sticks(j, loss);
            }
        }
    }

    /// By how much more velocities are rounded than places.
    fn roughness(&self) -> f64 {
        1.0 + self.all.constants.fastest
    }

    /// Whether an absorber on its wall rests there from now on, and the energy that it loses then.
    fn comes_to_rest(&mut self, j: usize) -> Option<f64> {
        let (all, wall) = (&self.all, self.at.walls[j]);
        let (constants, view) = (&all.constants, &all.constants.views[j]);
        let sizes = constants.sizes(&self.at.phasors);
        let touch = constants.touch(view, &sizes, self.at.lines[j]);
        let (_, bend) = constants.slack(view, &sizes);
        let Gap { slope, .. } = constants.gap(j, &self.at.phasors, self.at.lines[j]);
        let (opening, r) = (-slope * wall, constants.kicks[j].restitution);
        let inelastic = ((1.0 - r) * (1.0 + r)).max(f64::MIN_POSITIVE);
        let excursion = ContactTolerance::default().excursion.max(touch / inelastic);
        // What still comes has its impact first.
        let opening = if opening.abs() <= touch * self.roughness() { 0.0 } else { opening };
        if opening < 0.0 || opening * opening > 2.0 * excursion * bend.max(f64::MIN_POSITIVE) {
            return None;
        }
        let panel = HeldPanel::of(all, &self.state(), self.at.phase, &self.inverse);
        // By how much what an absorber takes along turns the phasors, and these the jerk.
        let kicked = (0..all.modes).map(|k| {
            let (mode, phi) = (&constants.modes[k], view.shape[k] * all.clearances[j]);
            let size = all.absorber_masses[j] * phi.abs() / all.masses[k] * mode.inverse_ringing;
            phi.abs() * size * mode.stiffness * mode.stiffness.sqrt()
        });
        let at_wall = AtWall {
            separation_speed: opening,
            closing_acceleration: wall * panel.sight(view).at(0.0, 2),
            speed: 0.0,
            force_rate: panel.bound(view, 3),
            damping: kicked.sum(),
            stiffness: 0.0,
        };
        let closing = at_wall.closing_acceleration;
        let unresolved = closing > 0.0 && opening * opening <= 2.0 * closing * touch;
        let tolerance = ContactTolerance { excursion, ..ContactTolerance::default() };
        if !(unresolved || tolerance.sticks(r, &at_wall)) {
            return None;
        }
        Some(self.stick(j, wall))
    }

    /// An impact without rebound on a wall, with what rests already: the energy lost.
    fn stick(&mut self, j: usize, wall: f64) -> f64 {
        let (all, mut state, shape) = (&self.all, self.state(), self.all.shape(j));
        let moved = self.inverse.times(&shape);
        let seen = 1.0 / all.absorber_masses[j] + dot(&shape, &moved);
        let gap = all.constants.gap(j, &self.at.phasors, self.at.lines[j]);
        let speed = gap.slope * all.clearances[j];
        let impulse = speed / seen;
        state.modes.iter_mut().zip(&moved).for_each(|(mode, by)| mode[1] -= by * impulse);
        self.at.phasors = all.phasors(&state, sine_and_cosine(self.at.phase));
        (self.stuck[j], self.at.walls[j]) = (wall, 0.0);
        self.inverse = Inverse::of(&self.all, &self.stuck);
        self.carry();
        0.5 * speed * impulse
    }

    /// Takes absorbers along to the next event, the end of the period, or for a panel.
    pub(super) fn tow(&mut self, observer: &mut dyn ModalObserver) -> Result<(), Stop> {
        let (all, at) = (&self.all, &self.at);
        let panel = HeldPanel::of(all, &self.state(), at.phase, &self.inverse);
        let mut sights = [Sight::NOTHING; MOST];
        for (sight, view) in sights.iter_mut().zip(&all.constants.views).take(all.absorbers) {
            *sight = panel.sight(view);
        }
        let sizes = all.constants.sizes(&at.phasors);
        let mut bands =
            [CrossingBand { lower: f64::NEG_INFINITY, upper: f64::INFINITY, touch: 1.0 }; MOST];
        let (mut bounds, mut from) = ([0.0; MOST], [0.0; MOST]);
        for j in 0..all.absorbers {
            let (view, wall) = (&all.constants.views[j], at.walls[j]);
            let touch = all.constants.touch(view, &sizes, at.lines[j]);
            if touch.is_nan() || touch > LARGEST_TOUCH {
                return Err(Stop::WallsUnresolved);
            }
            if self.stuck[j] != 0.0 {
                let touch = touch * (1.0 + all.constants.fastest * all.constants.fastest);
                bands[j] = CrossingBand { lower: 0.0, upper: f64::INFINITY, touch };
                bounds[j] = panel.bound(view, 4);
                // Nothing pulls at what another one's impact has set free.
                if self.stuck[j] * sights[j].at(0.0, 2) < -touch {
                    self.release(j);
                    return Ok(());
                }
            } else {
                bands[j] = CrossingBand { lower: -1.0, upper: 1.0, touch };
                bounds[j] = panel.bound(view, 2);
                let [v, a, jerk] = [1, 2, 3].map(|order| sights[j].at(0.0, order));
                let rounding = touch * self.roughness();
                if wall != 0.0 && (v - at.lines[j].velocity).abs() <= rounding {
                    let further = [3, 4].map(|order| panel.bound(view, order));
                    let clear = clear_of_wall([a * wall, jerk * wall], bounds[j], further, touch);
                    from[j] = clear.min(panel.length);
                }
            }
        }
        let samples = |s: f64| -> [Sample; MOST] {
            std::array::from_fn(|j| {
                if j >= all.absorbers {
                    return Sample { value: 0.0, slope: 0.0, curvature_bound: 0.0 };
                }
                let wall = self.stuck[j];
                if wall != 0.0 {
                    let [value, slope] = [2, 3].map(|order| wall * sights[j].at(s, order));
                    return Sample { value, slope, curvature_bound: bounds[j] };
                }
                Gap::of(sights[j].moment(s), at.lines[j].from(s)).sample(bounds[j])
            })
        };
        let (found, which) = first_of(samples, panel.length, from, panel.length, bands);
        let (time, event) = match found {
            Search::Clear { .. } => (panel.length, None),
            Search::Crossed(crossing) => (crossing.time.max(0.0), Some((which, crossing.edge))),
            Search::NotFinite(_) => return Err(Stop::NotFinite),
        };
        let detail = observer.detail();
        if detail == Detail::Flights && time > 0.0 {
            observer.segment(&ModalSegment {
                all,
                lines: at.lines,
                stuck: self.stuck,
                turns: at.turns,
                phase: at.phase,
                duration: time,
                course: Course::Held(&panel),
            });
        }
        self.move_on(
            &panel,
            time,
            event.is_none() && time == self.all.constants.left(self.at.phase),
        );
        if detail > Detail::Nothing && self.at.phase == 0.0 && event.is_none() {
            Told { all: &self.all, detail, observer: &mut *observer }.period(&self.at);
        }
        match event {
            Some((j, _)) if self.stuck[j] != 0.0 => self.release(j),
            Some((j, edge)) => {
                for j in (0..self.all.absorbers).filter(|j| self.stuck[*j] != 0.0) {
                    self.at.walls[j] = self.stuck[j];
                }
                self.stuck = [0.0; MOST];
                self.inverse = Inverse::of(&self.all, &self.stuck);
                let wall = if edge == Edge::Upper { 1.0 } else { -1.0 };
                let before = self.at;
                self.all.constants.collide(&mut self.at, j, wall);
                if detail > Detail::Nothing {
                    Told { all: &self.all, detail, observer: &mut *observer }
                        .impact(&before, &self.at, j, wall);
                }
                self.settle(observer);
            }
            None => {}
        }
        Ok(())
    }

    /// Moves everything on in a panel.
    fn move_on(&mut self, panel: &HeldPanel, time: f64, period_ends: bool) {
        let all = &self.all;
        let state = panel.state(time);
        let at = &mut self.at;
        if time > 0.0 {
            at.walls = [0.0; MOST];
        }
        at.evaluations += 1;
        at.phase += all.constants.frequency * time;
        if period_ends {
            (at.phase, at.turns) = (0.0, at.turns + 1);
        }
        at.phasors = all.phasors(&state, sine_and_cosine(at.phase));
        for j in 0..all.absorbers {
            at.lines[j] = at.lines[j].from(time);
        }
        self.carry();
    }

    /// Puts what rests on a wall where that is.
    fn carry(&mut self) {
        for j in (0..self.all.absorbers).filter(|j| self.stuck[*j] != 0.0) {
            let Gap { gap, slope, .. } = self.all.constants.gap(j, &self.at.phasors, STILL);
            self.at.lines[j] = StraightLine { y: gap - self.stuck[j], velocity: slope };
        }
    }

    /// A wall lets go.
    fn release(&mut self, j: usize) {
        self.carry();
        (self.at.walls[j], self.stuck[j]) = (self.stuck[j], 0.0);
        self.inverse = Inverse::of(&self.all, &self.stuck);
        self.solve_contacts(None);
    }
}
