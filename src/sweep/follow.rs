//! Where motions start that are not looked for from several starts: as axes say, or where the motion at
//! the point before has ended.

use super::facts::Found;
use super::{Plan, Point};
use crate::case::{Scales, SweepParameter};
use crate::regimes::diagram::carried_over;
use crate::regimes::starts::FROM_REST;
use crate::regimes::{Effort, long_term};
use crate::simulation::StartError;
use crate::system::{State, System};

/// The start that axes say, over the clearance; none where they say nothing. What no axis says is at
/// rest, the absorber halfway between the middle of its cavity and a wall.
pub(super) fn start(
    axes: impl Iterator<Item = (SweepParameter, f64)>,
    scales: &Scales,
) -> Option<State> {
    let speed = scales.natural_frequency;
    let length = |value: f64| scales.over_clearance(value);
    let velocity = |value: f64| scales.over_clearance(value) / speed;
    let (mut start, mut absorber, mut said) = (State::AT_REST, None, false);
    for (parameter, value) in axes.filter(|(parameter, _)| parameter.is_initial()) {
        said = true;
        match parameter {
            SweepParameter::InitialDisplacement => start.x = length(value),
            SweepParameter::InitialVelocity => start.x_velocity = velocity(value),
            SweepParameter::InitialAbsorberVelocity => start.y_velocity = velocity(value),
            _ => absorber = Some(length(value)),
        }
    }
    start.y = absorber.unwrap_or(start.x + FROM_REST.y);
    said.then_some(start)
}

/// What simulation finds at the points of whole lines, followed upwards and downwards.
///
/// # Errors
/// [`StartError`] where a start is not finite.
pub(super) fn along(plan: &Plan, points: &[Point]) -> Result<Vec<Vec<Found>>, StartError> {
    let length = plan.settings.axes.last().map_or(1, |axis| axis.values.len());
    let mut found: Vec<Vec<Found>> = points.iter().map(|_| Vec::with_capacity(2)).collect();
    let mut stands: Vec<Option<Stand>> = points.chunks(length).map(|_| None).collect();
    let up = 0..length;
    for k in up.clone().chain(up.rev()) {
        // All lines side by side.
        let places: Vec<(usize, &Point, System)> = (k..points.len())
            .step_by(length)
            .enumerate()
            .filter_map(|(line, index)| Some((line, &points[index], points[index].system?)))
            .collect();
        let start = |(line, point, system): &(usize, &Point, System)| {
            let from = stands[*line].as_ref().map(|stand| stand.at(&point.scales));
            (*system, from.unwrap_or(FROM_REST))
        };
        let starts: Vec<(System, State)> = places.iter().map(start).collect();
        let motions = long_term(&starts, &Effort::over(plan.settings.periods))?;
        for line in 0..stands.len() {
            let motion = places.iter().position(|(of, ..)| *of == line).and_then(|k| motions[k]);
            let point = &points[line * length + k];
            stands[line] = motion.map(|motion| Stand::of(motion.state, &point.scales));
            let motions = motion.into_iter().collect();
            found[line * length + k].push(Found { motions, ..Found::default() });
        }
    }
    Ok(found)
}

/// Where a motion stands, and what its lengths and velocities are over.
struct Stand {
    state: State,
    clearance: f64,
    natural_frequency: f64,
}

impl Stand {
    fn of(state: State, scales: &Scales) -> Self {
        let natural_frequency = scales.natural_frequency;
        Self { state, clearance: scales.clearance, natural_frequency }
    }

    /// The same place at another point.
    fn at(&self, scales: &Scales) -> State {
        let there = Self::of(self.state, scales);
        let clearance = self.clearance / there.clearance;
        carried_over(self.state, clearance, self.natural_frequency / there.natural_frequency)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scales(clearance: f64) -> Scales {
        Scales {
            physical: true,
            clearance,
            natural_frequency: 50.0,
            oscillator_mass: 1.0,
            forcing: 1.0,
        }
    }

    /// By hand: 2 mm and 5 mm/s are 0.1 and 0.005 of a clearance of 20 mm at 50 rad/s.
    #[test]
    fn axes_set_the_start_and_the_rest_is_at_rest() {
        let axes = [(SweepParameter::InitialDisplacement, 2e-3), (SweepParameter::Clearance, 0.02)];
        let found = start(axes.into_iter(), &scales(0.02)).expect("an axis says");
        assert!((found.x - 0.1).abs() < 1e-15 && found.x_velocity == 0.0);
        assert!((found.relative_displacement() + FROM_REST.y).abs() < 1e-15, "{found:?}");
        let axes = [
            (SweepParameter::InitialVelocity, 5e-3),
            (SweepParameter::InitialAbsorberDisplacement, -4e-3),
            (SweepParameter::InitialAbsorberVelocity, 10e-3),
        ];
        let found = start(axes.into_iter(), &scales(0.02)).expect("an axis says");
        let wanted = State { x: 0.0, x_velocity: 0.005, y: -0.2, y_velocity: 0.01 };
        assert!(found.distance(&wanted) < 1e-15, "{found:?}");
        assert_eq!(start([(SweepParameter::Clearance, 1.0)].into_iter(), &scales(1.0)), None);
    }

    #[test]
    fn a_motion_goes_on_from_the_same_place_over_another_clearance() {
        let state = State { x: 0.5, x_velocity: -1.0, y: -0.3, y_velocity: 2.0 };
        let wider = Stand::of(state, &scales(0.02)).at(&scales(0.04));
        let wanted = State { x: 0.25, x_velocity: -0.5, y: 0.25 - 0.4, y_velocity: 1.0 };
        assert!(wider.distance(&wanted) < 1e-15, "{wider:?}");
        // Half as many radians a second as before: twice as far in one of them.
        let softer = Scales { natural_frequency: 25.0, ..scales(0.02) };
        let softer = Stand::of(state, &scales(0.02)).at(&softer);
        let wanted = State { x_velocity: -2.0, y_velocity: 4.0, ..state };
        assert!(softer.distance(&wanted) < 1e-15, "{softer:?}");
    }
}
