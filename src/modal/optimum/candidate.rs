//! Absorbers between the bounds, by parts of the way.

use crate::case::{Bounds, ModalCase, PlacedAbsorber, Rounding};

/// Least share of the mass that an absorber may have, over an even one.
const LEAST_SHARE: f64 = 0.25;

/// How many numbers are chosen.
pub(super) fn numbers(case: &ModalCase) -> usize {
    let Bounds { restitution, places, split_mass, .. } = &case.bounds;
    let absorbers = case.absorbers.len();
    let splits = usize::from(*split_mass && absorbers > 1) * absorbers;
    let moves = usize::from(places.len() > 1) * absorbers;
    absorbers + usize::from(restitution.is_some()) + moves + splits
}

/// The case with other absorbers, by parts of the way between the bounds.
pub(super) fn candidate(case: &ModalCase, parts: &[f64]) -> ModalCase {
    let mut parts = parts.iter().copied();
    let mut part = || parts.next().unwrap_or(0.5);
    let Bounds { clearance_m, restitution, places, split_mass, .. } = &case.bounds;
    let mut absorbers = case.absorbers.clone();
    for one in &mut absorbers {
        let [from, to] = clearance_bounds(*clearance_m, one);
        one.clearance_m = Rounding::Nearest.of(from * libm::pow(to / from, part()));
    }
    if let Some([from, to]) = restitution {
        let restitution = libm::rint(1e3 * (from + (to - from) * part())) / 1e3;
        absorbers.iter_mut().for_each(|one| one.restitution = restitution);
    }
    if places.len() > 1 {
        for one in &mut absorbers {
            let number = (part() * places.len() as f64) as usize;
            one.place = places[number.min(places.len() - 1)];
        }
    } else if let [place] = places[..] {
        absorbers.iter_mut().for_each(|one| one.place = place);
    }
    if *split_mass && absorbers.len() > 1 {
        let together: f64 = absorbers.iter().map(|one| one.mass_kg).sum();
        let shares: Vec<f64> = absorbers.iter().map(|_| LEAST_SHARE + part()).collect();
        let sum: f64 = shares.iter().sum();
        for (one, share) in absorbers.iter_mut().zip(shares) {
            one.mass_kg = Rounding::Nearest.of(together * share / sum);
        }
    }
    if *split_mass {
        keep_places(&case.absorbers, &mut absorbers);
    }
    ModalCase { absorbers, ..case.clone() }
}

/// Gives absorbers that may share their mass otherwise, and so are alike, the numbers of those that were where they are.
fn keep_places(own: &[PlacedAbsorber], found: &mut [PlacedAbsorber]) {
    for j in 0..own.len() {
        let stays = |k: &usize| found[*k].place == own[j].place && found[*k].place != own[*k].place;
        if found[j].place != own[j].place
            && let Some(k) = (0..own.len()).find(stays)
        {
            found.swap(j, k);
        }
    }
}

/// The bounds of an absorber's clearance in m.
pub fn clearance_bounds(bounds: Option<[f64; 2]>, absorber: &PlacedAbsorber) -> [f64; 2] {
    bounds.unwrap_or([absorber.clearance_m / 3.0, absorber.clearance_m * 3.0])
}
