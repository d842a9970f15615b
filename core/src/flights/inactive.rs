//! Where an absorber may rest without a wall ever reaching it, while the structure swings alone:
//! `x = exp(-zeta tau) (x0 cos(nu tau) + (v0 + zeta x0)/nu sin(nu tau))` with `zeta = eps lambda/2`, `nu^2 = 1 - zeta^2`,
//! whose first swing to either side is its largest.

use std::f64::consts::{PI, TAU};

use super::places::even;
use super::unforced;
use crate::simulation::{Simulation, Stop};
use crate::system::{State, System};

/// Places of a resting absorber that no wall reaches.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Inactive {
    /// Their share of all; 0 for an absorber that does not rest.
    pub share: f64,
    /// The lowest and the highest of them, relative displacements over the clearance; none where gravity or friction moves
    /// the absorber, so that they need not lie together.
    pub places: Option<[f64; 2]>,
}

/// Largest damping ratio of a structure that swings.
const SWINGS: f64 = 0.9999;
/// Swings in which an absorber that gravity or friction moves hits a wall, if it ever does: gravity of 1e-5 of the
/// structure's acceleration over a clearance takes it across.
const SWINGS_WATCHED: u64 = 100;
/// Places from which that is watched.
const PLACES_WATCHED: u64 = 32;

/// Places of a resting absorber that no wall reaches while the structure swings alone: what its first swing to either side
/// leaves. Where gravity or friction moves it, a share of the places that are watched, by simulation.
pub fn inactive(system: &System, start: &State) -> Inactive {
    if start.y_velocity != 0.0 {
        return Inactive::default();
    }
    if system.cavity().moves_absorber() {
        let stays = |w: &f64| {
            let from = State { y: start.x - w, ..*start };
            let alone = unforced(system, TAU).ok();
            let simulation = alone.and_then(|alone| Simulation::new(&alone, from, 0.0).ok());
            simulation.is_some_and(|mut at| at.run(SWINGS_WATCHED, 1, &mut ()) == Stop::EndTime)
        };
        let places = even(PLACES_WATCHED);
        let share = places.clone().filter(stays).count() as f64 / places.len() as f64;
        return Inactive { share, places: None };
    }
    // x = exp(-zeta tau) (x0 cos(nu tau) + (v0 + zeta x0)/nu sin(nu tau)) has its extremes half an oscillation apart.
    let (x, v) = (start.x, start.x_velocity);
    let zeta = (0.5 * system.mass_ratio() * system.damping()).min(SWINGS);
    let frequency = (1.0 - zeta * zeta).sqrt();
    let at = |tau: f64| {
        let (sine, cosine) = libm::sincos(frequency * tau);
        libm::exp(-zeta * tau) * (x * cosine + (v + zeta * x) / frequency * sine)
    };
    let first = libm::atan2(v * frequency, x + zeta * v).rem_euclid(PI) / frequency;
    let seen = [x, at(first), at(first + PI / frequency)];
    let [most, least] = [seen.into_iter().fold(x, f64::max), seen.into_iter().fold(x, f64::min)];
    // The structure moves by most - x to one side against an absorber that stays, by x - least to the other.
    let (lowest, highest) = (x - least - 1.0, 1.0 - (most - x));
    match highest > lowest {
        true => Inactive { share: 0.5 * (highest - lowest), places: Some([lowest, highest]) },
        false => Inactive::default(),
    }
}
