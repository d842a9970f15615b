//! What friction adds to a trajectory: the absorber slides one way until it stops, is held, and gets away.

use super::flight::Hold;
use super::oscillator::{LEVELS, TimePoint};
use super::real::Decimal;
use super::search::{descended, polished, scan};
use super::{EXCURSION, Event, ROOM, Reference, ReferenceMode};

impl Reference {
    /// What the oscillator without absorber would have beyond gravity's acceleration of the absorber.
    pub(super) fn drive(&self) -> Decimal {
        &self.alone.rate(&self.z)[1] - &self.gravity
    }

    /// The difference of accelerations at which friction gives way.
    pub(super) fn grip(&self) -> Decimal {
        &(&Decimal::of(1.0) + &self.eps) * &self.friction
    }

    /// How fast an opening gap to a wall stops opening: the wall's push and friction.
    pub(super) fn stopping(&self, side: f64) -> Decimal {
        &(&Decimal::of(side) * &self.drive()) + &self.grip()
    }

    /// What an absorber does that does not move relative to the oscillator, there or at a wall.
    pub(super) fn settled(&self, wall: Option<f64>) -> ReferenceMode {
        let held = match wall {
            Some(side) => self.stopping(side).is_positive(),
            None => self.friction.is_positive() && !self.grip().is_below(&self.drive().abs()),
        };
        match held {
            true => ReferenceMode::Rests {
                wall,
                gap: wall.map_or_else(|| &self.z[0] - &self.y, Decimal::of),
            },
            false => self.moving(&self.drive()),
        }
    }

    /// Motion with the sign of a relative velocity.
    pub(super) fn moving(&self, velocity: &Decimal) -> ReferenceMode {
        match self.friction.is_positive() {
            true => ReferenceMode::Slides(sign(velocity)),
            false => ReferenceMode::Flies,
        }
    }

    /// Up to the wall ahead or to where the absorber stops, whichever is first.
    pub(super) fn slide(&mut self, direction: f64, latest: f64) -> Option<Event> {
        let (alone, way, one) = (&self.alone, Decimal::of(direction), Decimal::of(1.0));
        let flight = self.flight(direction);
        let excess = |point: &TimePoint| {
            let [gap, rate] = flight.gap(point).map(|part| &way * &part);
            [&gap - &one, rate]
        };
        let stopped = |point: &TimePoint| {
            [flight.gap(point)[1].clone(), flight.bend(alone, point)].map(|part| -&(&way * &part))
        };
        let either = |point: &TimePoint| {
            let wall = excess(point);
            if wall[0].is_positive() { wall } else { stopped(point) }
        };
        let span = latest - self.time.to_f64();
        let before = scan(alone, flight.start(), span, &either)?;
        let after = alone.step(&before, LEVELS);
        let stop = stopped(&after)[0]
            .is_positive()
            .then(|| polished(alone, before.clone(), &stopped))
            .map(|at| (excess(&at)[0].clone(), at))
            // Beyond the wall it does not stop but strikes.
            .filter(|(beyond, _)| !Decimal::of(EXCURSION).is_below(beyond));
        let (at, touches) = match stop {
            Some((beyond, at)) => (at, Some(!beyond.is_below(&Decimal::of(-EXCURSION)))),
            None if excess(&before)[1].is_zero() => {
                (descended(alone, &flight.start(), after, &excess), None)
            }
            None => (polished(alone, before, &excess), None),
        };
        if at.s.to_f64() > span {
            return None;
        }
        self.arrive(&flight, &at);
        Some(match touches {
            Some(touches) => self.stopped(touches.then_some(direction)),
            None => self.struck(direction),
        })
    }

    /// The relative velocity has vanished, in the cavity or at a wall.
    fn stopped(&mut self, wall: Option<f64>) -> Event {
        self.y_velocity = self.z[1].clone();
        let gap = (&self.z[0] - &self.y).abs();
        let near = &gap + &Decimal::of(ROOM * self.rounding);
        if self.is_disturbed() && near.is_below(&Decimal::of(1.0)) {
            self.y = &self.y + &Decimal::of(self.rounding);
        }
        self.mode = self.settled(wall);
        let (tau, x) = (self.time.to_f64(), self.z[0].to_f64());
        match self.mode {
            ReferenceMode::Rests { .. } => Event::Stick { tau, x, wall },
            _ => Event::Reversal { tau, x },
        }
    }

    /// The end of rest: friction, and a wall that only pushes, hold no longer.
    pub(super) fn release(
        &mut self,
        wall: Option<f64>,
        gap: &Decimal,
        latest: f64,
    ) -> Option<Event> {
        let (carrying, friction) = (&self.carrying, &self.friction);
        let hold = Hold::new(&self.gravity, &self.eps);
        let excess = |point: &TimePoint| {
            let [by, rate] = hold.held_by(carrying, point);
            match wall {
                Some(side) => {
                    let away = Decimal::of(-side);
                    [&(&away * &by) - friction, &away * &rate]
                }
                None => [&(&by * &by) - &(friction * friction), &(&Decimal::of(2.0) * &by) * &rate],
            }
        };
        let span = latest - self.time.to_f64();
        let before = scan(carrying, hold.start(&self.z), span, &excess)?;
        let at = polished(carrying, before, &excess);
        if at.s.to_f64() > span {
            return None;
        }
        let by = hold.held_by(carrying, &at)[0].clone();
        self.time = &self.time + &at.s;
        self.z = hold.z(&at);
        if self.friction.is_positive() && self.is_disturbed() {
            self.z[0] = &self.z[0] + &Decimal::of(self.rounding);
        }
        self.y = &self.z[0] - gap;
        self.y_velocity = self.z[1].clone();
        self.mode = self.moving(&wall.map_or(by, |side| Decimal::of(-side)));
        Some(Event::Release { tau: self.time.to_f64(), x: self.z[0].to_f64() })
    }
}

fn sign(number: &Decimal) -> f64 {
    if number.is_negative() { -1.0 } else { 1.0 }
}
