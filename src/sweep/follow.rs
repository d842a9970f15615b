//! Where motions start that are not looked for from several starts: as axes say, or where the motion at
//! the point before has ended.

use super::facts::PointMotions;
use super::{GridPoint, Plan};
use crate::motions::starts::FROM_REST;
use crate::motions::{Effort, Motions, carried_over, follow};
use crate::quantity::Units;
use crate::simulation::StartError;
use crate::system::{Parameter, State};

/// The start that axes say, over the clearance; none where they say nothing. What no axis says is at
/// rest, the absorber halfway between the middle of its cavity and a wall.
pub(super) fn start(axes: impl Iterator<Item = (Parameter, f64)>, units: &Units) -> Option<State> {
    let speed = units.natural_frequency;
    let length = |value: f64| units.over_clearance(value);
    let velocity = |value: f64| units.over_clearance(value) / speed;
    let (mut start, mut absorber, mut said) = (State::AT_REST, None, false);
    for (parameter, value) in axes.filter(|(parameter, _)| parameter.is_initial()) {
        said = true;
        match parameter {
            Parameter::InitialDisplacement => start.x = length(value),
            Parameter::InitialVelocity => start.x_velocity = velocity(value),
            Parameter::InitialAbsorberVelocity => start.y_velocity = velocity(value),
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
pub(super) fn along(
    plan: &Plan,
    points: &[GridPoint],
) -> Result<Vec<Vec<PointMotions>>, StartError> {
    let length = plan.settings.axes.last().map_or(1, |axis| axis.values.len());
    let shaking = plan.asks_for_shaking();
    let effort = Effort { shaking, ..Effort::over(plan.settings.periods) };
    let mut found: Vec<Vec<PointMotions>> = points.iter().map(|_| Vec::with_capacity(2)).collect();
    // Where the motion of each line stands, and at which point.
    let mut stands: Vec<Option<(State, &Units)>> = vec![None; points.len().div_ceil(length)];
    for k in (0..length).chain((0..length).rev()) {
        // All lines side by side.
        let here = || points[k..].iter().step_by(length);
        let starts = here().zip(&stands).filter_map(|(point, stand)| {
            let carried = |(state, from)| carried(state, from, &point.units);
            Some((point.system?, stand.map_or(FROM_REST, carried)))
        });
        let mut motions = follow(&starts.collect::<Vec<_>>(), &effort)?.into_iter();
        for (line, point) in here().enumerate() {
            let motion = point.system.and_then(|_| motions.next().flatten());
            stands[line] = motion.as_ref().map(|motion| (motion.state(), &point.units));
            let motions = motion.map(Motions::of_one).unwrap_or_default();
            found[line * length + k].push(PointMotions { motions, ..PointMotions::default() });
        }
    }
    Ok(found)
}

/// The same physical state at another point.
fn carried(state: State, from: &Units, to: &Units) -> State {
    let frequency = from.natural_frequency / to.natural_frequency;
    carried_over(state, from.clearance / to.clearance, frequency)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::Scales;

    fn units(clearance: f64) -> Units {
        Scales { physical: true, clearance, natural_frequency: 50.0, oscillator_mass: 1.0 }.into()
    }

    /// By hand: 2 mm and 5 mm/s are 0.1 and 0.005 of a clearance of 20 mm at 50 rad/s.
    #[test]
    fn axes_set_the_start_and_the_rest_is_at_rest() {
        let axes = [(Parameter::InitialDisplacement, 2e-3), (Parameter::Clearance, 0.02)];
        let found = start(axes.into_iter(), &units(0.02)).expect("an axis says");
        assert!((found.x - 0.1).abs() < 1e-15 && found.x_velocity == 0.0);
        assert!((found.relative_displacement() + FROM_REST.y).abs() < 1e-15, "{found:?}");
        let axes = [
            (Parameter::InitialVelocity, 5e-3),
            (Parameter::InitialAbsorberDisplacement, -4e-3),
            (Parameter::InitialAbsorberVelocity, 10e-3),
        ];
        let found = start(axes.into_iter(), &units(0.02)).expect("an axis says");
        let wanted = State { x: 0.0, x_velocity: 0.005, y: -0.2, y_velocity: 0.01 };
        assert!(found.distance(&wanted) < 1e-15, "{found:?}");
        assert_eq!(start([(Parameter::Clearance, 1.0)].into_iter(), &units(1.0)), None);
    }

    #[test]
    fn a_motion_goes_on_from_the_same_place_over_another_clearance() {
        let state = State { x: 0.5, x_velocity: -1.0, y: -0.3, y_velocity: 2.0 };
        let wider = carried(state, &units(0.02), &units(0.04));
        let wanted = State { x: 0.25, x_velocity: -0.5, y: 0.25 - 0.4, y_velocity: 1.0 };
        assert!(wider.distance(&wanted) < 1e-15, "{wider:?}");
        // Half as many radians a second as before: twice as far in one of them.
        let softer = Scales { natural_frequency: 25.0, ..*units(0.02) }.into();
        let softer = carried(state, &units(0.02), &softer);
        let wanted = State { x_velocity: -2.0, y_velocity: 4.0, ..state };
        assert!(softer.distance(&wanted) < 1e-15, "{softer:?}");
    }
}
