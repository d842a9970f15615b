//! Where symmetric 1:1 orbits begin and end: the stability limits of the full system at one
//! frequency, over all clearances and forcings at once.
//!
//! Those of an ideal cavity: with friction the forcing of an orbit is no multiple of what it is over another clearance,
//! and a cavity that is inclined or whose ends differ has no symmetric orbits. There [`follow`](super::branch::follow)
//! leads to the limits.
//!
//! Each value of `beta` belongs to one forcing per clearance (`symmetric.rs`), so that the whole
//! family is a curve over `beta`. Its bifurcations need no scan:
//!
//! * The saddle-node is explicit, and so is the place from which the absorber stays on the wall.
//! * The Jacobian of the half-period map is `J = M(beta) - u(beta) v(beta)^T / a(beta)`. Of `M` one column
//!   and of the other three every component is linear in `beta`, and the approach `a` is proportional to it;
//!   so a coefficient of the characteristic polynomial is a quadratic over `beta`. A large motion does not feel
//!   the clearance: as `beta` grows, `J` tends to a limit, and that quadratic has no square. So `beta det(J + I)`
//!   is linear in `beta`, for the symmetry breaking; and as the last coefficient is constant,
//!   `beta^2 det(J^(2) - I)` is a quadratic, for the Neimark-Sacker bifurcation.
//! * The relative displacement between two impacts is linear in `beta`, `w = cos(Omega s) + beta k(s)`
//!   ([`SymmetricCurve::sway`]). So the orbit is a motion up to one `beta`, and the grazing there is where
//!   the larger of `k/(1 - cos(Omega s))` and `-k/(1 + cos(Omega s))` has its largest value, `1/beta`.

use serde::Serialize;

use super::admissibility::{Admissibility, Departure};
use super::cycle::Cycle;
use super::impact_map::ImpactMap;
use super::multipliers::{Multipliers, minus_one, unit_product};

use super::symmetric::SymmetricCurve;
use super::{MOST_HIDDEN, OrbitError};
use crate::bifurcation::Bifurcation;
use crate::numerics::bracket::brent;
use crate::numerics::polynomial::{real_roots, through};
use crate::system::{Parameters, System};

/// Amplitudes of the absorber that are looked at, over the clearance: up to far beyond symmetry
/// breaking, which the leading-order theory puts at 1.68.
const RANGE: [f64; 2] = [0.01, 5.0];
/// Width to which a root in `beta` is bracketed: its rounding.
const WIDTH: f64 = 1e-14;
/// Distances from a polynomial's root, over the root, at which the test function itself is asked for a
/// change of sign: from its rounding to that of the lightest absorbers, whose multipliers are close to 1.
const NEARBY: [f64; 6] = [1e-13, 1e-11, 1e-9, 1e-7, 1e-5, 1e-3];

/// A limit of the family.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Limit {
    /// What happens there.
    pub kind: Bifurcation,
    /// `beta` there.
    pub absorber_amplitude: f64,
    /// `gamma` there.
    pub forcing_over_clearance: f64,
    /// Clearance over the system's own at its own forcing.
    pub clearance: f64,
    /// Clearances between which it was bracketed, over the system's own.
    pub bracket: [f64; 2],
    /// The test function's value there.
    pub test: f64,
    /// Whether an attracting orbit exists on one side of it and not on the other.
    pub bounds_stability: bool,
}

/// A stretch of clearances with an attracting symmetric 1:1 orbit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StableStretch {
    /// Clearances over the system's own, ascending.
    pub clearance: [f64; 2],
    /// What ends it at either; `None` at the edge of the range that was looked at.
    pub ends: [Option<Bifurcation>; 2],
}

/// All symmetric 1:1 orbits at one frequency.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SymmetricFamily {
    /// Limits in order of `beta`.
    pub limits: Vec<Limit>,
    /// Clearances with an attracting orbit.
    pub stable: Vec<StableStretch>,
}

fn looked_at(beta: f64) -> bool {
    RANGE[0] < beta && beta < RANGE[1]
}

/// The family while it is looked at: a unit of forcing, scaled to each `beta`.
#[derive(Debug)]
struct Family {
    map: ImpactMap,
    curve: SymmetricCurve,
    forcing: f64,
    /// Neither damper nor impacts take energy.
    lossless: bool,
}

impl Family {
    fn of(system: &System) -> Result<Self, OrbitError> {
        if !system.cavity().is_ideal() {
            return Err(OrbitError::RealCavity);
        }
        let unit = Parameters { forcing_per_clearance: 1.0, ..system.parameters() };
        // Every other parameter has been proven valid.
        let unit = System::new(unit).map_err(|_| OrbitError::NoSteadyMotion)?;
        let map = ImpactMap::of(&unit)?;
        let curve = SymmetricCurve::with(&unit, &map.flight);
        let times = libm::hypot(curve.displacement, curve.velocity);
        if times > MOST_HIDDEN {
            return Err(OrbitError::Hidden { times });
        }
        let lossless = system.damping() == 0.0 && system.restitution() == 1.0;
        Ok(Self { map, curve, forcing: system.forcing_per_clearance(), lossless })
    }

    fn clearance(&self, beta: f64) -> f64 {
        self.forcing / self.curve.forcing(beta)
    }

    fn orbit(&self, beta: f64) -> (ImpactMap, Cycle) {
        let map = self.map.with_forcing(self.curve.forcing(beta));
        let cycle = self.curve.cycle(&map.flight, beta);
        (map, cycle)
    }

    fn test(&self, kind: Bifurcation, beta: f64) -> f64 {
        let (map, cycle) = self.orbit(beta);
        match kind {
            Bifurcation::SymmetryBreaking => minus_one(&cycle.jacobian(&map)),
            Bifurcation::NeimarkSacker => unit_product(&cycle.jacobian(&map)),
            Bifurcation::Grazing => Admissibility::of(&map, &cycle).min_wall_distance,
            Bifurcation::Sticking => self.curve.departure(&map.flight, beta),
            _ => beta - self.curve.turning(),
        }
    }

    fn attracts(&self, beta: f64) -> bool {
        let (map, cycle) = self.orbit(beta);
        let multipliers = Multipliers::of(&cycle.jacobian(&map));
        multipliers.is_some_and(|found| found.stable())
            && Admissibility::of(&map, &cycle).admissible
    }

    /// All bifurcations, by `beta`.
    fn bifurcations(&self) -> Vec<(Bifurcation, f64)> {
        let sticking = self.sticking();
        // A motion that has ended does not graze.
        let grazing = self.curve.grazing(&self.map.flight);
        let grazing = grazing.filter(|beta| sticking.is_none_or(|end| *beta < end));
        let pair = |beta: &f64| {
            let (map, cycle) = self.orbit(*beta);
            Multipliers::of(&cycle.jacobian(&map)).is_some_and(|found| found.has_pair_on_circle())
        };
        let mut all: Vec<(Bifurcation, f64)> =
            vec![(Bifurcation::SaddleNode, self.curve.turning())];
        all.extend(sticking.map(|beta| (Bifurcation::Sticking, beta)));
        all.extend(grazing.map(|beta| (Bifurcation::Grazing, beta)));
        let breaking = self.roots(Bifurcation::SymmetryBreaking, 1);
        all.extend(breaking.into_iter().map(|beta| (Bifurcation::SymmetryBreaking, beta)));
        // Without any loss the product of all multipliers is 1, and the test function vanishes everywhere.
        if !self.lossless {
            let modulated = self.roots(Bifurcation::NeimarkSacker, 2).into_iter().filter(pair);
            all.extend(modulated.map(|beta| (Bifurcation::NeimarkSacker, beta)));
        }
        all.retain(|(_, beta)| looked_at(*beta));
        all.sort_by(|a, b| a.1.total_cmp(&b.1));
        all
    }

    /// Where the absorber begins to stay on the wall; only an impact without rebound lets it.
    fn sticking(&self) -> Option<f64> {
        let beta = self.curve.sticking(&self.map.flight)?;
        let (map, cycle) = self.orbit(beta);
        Departure::of(&cycle.flights(&map)[0]).is_still().then_some(beta)
    }

    /// A test function times a power of `beta`: a polynomial in `beta` of that degree.
    fn scaled_test(&self, kind: Bifurcation, power: u32, beta: f64) -> f64 {
        self.test(kind, beta) * libm::pow(beta, f64::from(power))
    }

    fn polynomial(&self, kind: Bifurcation, power: u32) -> Vec<f64> {
        let nodes = power + 1;
        let places = (1..=nodes).map(|k| RANGE[1] * f64::from(k) / f64::from(nodes));
        let points = places.map(|beta| (beta, self.scaled_test(kind, power, beta)));
        through(&points.collect::<Vec<_>>())
    }

    /// Roots of a test function, each proven by a change of its sign.
    fn roots(&self, kind: Bifurcation, power: u32) -> Vec<f64> {
        let test = |beta: f64| self.test(kind, beta);
        let proven = |root: &f64| {
            NEARBY.iter().find_map(|share| {
                let reach = share * root;
                Some(brent(root - reach, root + reach, WIDTH, test).ok()?.at)
            })
        };
        let roots = real_roots(&self.polynomial(kind, power));
        roots.iter().filter(|root| looked_at(**root)).filter_map(proven).collect()
    }
}

impl Limit {
    /// The orbit at the limit, as half a cycle; lengths over the clearance there.
    ///
    /// # Errors
    /// As [`SymmetricFamily::of`].
    pub fn cycle(&self, system: &System) -> Result<Cycle, OrbitError> {
        Ok(Family::of(system)?.orbit(self.absorber_amplitude).1)
    }
}

impl SymmetricFamily {
    /// The family of `system`'s frequency, mass ratio, damping and restitution.
    ///
    /// # Errors
    /// [`OrbitError::NoSteadyMotion`] for an undamped oscillator driven at its natural frequency,
    /// [`OrbitError::Hidden`] so close to that that rounding hides the orbits, [`OrbitError::RealCavity`] for a cavity that is
    /// not ideal.
    pub fn of(system: &System) -> Result<Self, OrbitError> {
        let family = Family::of(system)?;
        let found = family.bifurcations();
        let inner = found.iter().map(|(kind, beta)| (Some(*kind), *beta));
        let edges: Vec<(Option<Bifurcation>, f64)> =
            [(None, RANGE[0])].into_iter().chain(inner).chain([(None, RANGE[1])]).collect();
        // Between neighbouring limits stability is one and the same.
        let attracts: Vec<bool> =
            edges.windows(2).map(|pair| family.attracts(0.5 * (pair[0].1 + pair[1].1))).collect();
        let limits = found.iter().zip(attracts.windows(2)).map(|((kind, beta), sides)| Limit {
            bounds_stability: sides[0] != sides[1],
            ..family.limit(*kind, *beta)
        });
        let limits = limits.collect();
        let mut stable = Vec::new();
        let mut first = 0;
        for run in attracts.chunk_by(|a, b| a == b) {
            let last = first + run.len();
            if run[0] {
                stable.push(family.stretch([edges[first], edges[last]]));
            }
            first = last;
        }
        Ok(Self { limits, stable })
    }

    /// The nearest limit of stability of either kind on each side of a clearance factor, among
    /// stretches that contain it.
    pub fn stretch_around(&self, clearance: f64) -> Option<&StableStretch> {
        self.stable
            .iter()
            .find(|stretch| stretch.clearance[0] <= clearance && clearance <= stretch.clearance[1])
    }
}

impl Family {
    fn limit(&self, kind: Bifurcation, beta: f64) -> Limit {
        // The explicit ones are known to their own rounding.
        let width = match kind {
            Bifurcation::SaddleNode | Bifurcation::Sticking => WIDTH * beta,
            _ => WIDTH,
        };
        let [a, b] = [beta - width, beta + width].map(|beta| self.clearance(beta));
        Limit {
            kind,
            absorber_amplitude: beta,
            forcing_over_clearance: self.curve.forcing(beta),
            clearance: self.clearance(beta),
            bracket: [a.min(b), a.max(b)],
            test: self.test(kind, beta),
            bounds_stability: false,
        }
    }

    fn stretch(&self, mut edges: [(Option<Bifurcation>, f64); 2]) -> StableStretch {
        edges.sort_by(|a, b| self.clearance(a.1).total_cmp(&self.clearance(b.1)));
        StableStretch {
            clearance: edges.map(|(_, beta)| self.clearance(beta)),
            ends: edges.map(|(kind, _)| kind),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Cavity, Excitation};
    use proptest::prelude::*;

    fn families() -> impl Strategy<Value = Family> {
        (1e-3..0.3f64, 0.0..6.0f64, 0.0..=1.0f64, prop_oneof![0.6..0.99, 1.01..1.6]).prop_map(
            |(mass_ratio, damping, restitution, frequency_ratio)| {
                let parameters = Parameters {
                    mass_ratio,
                    damping,
                    restitution,
                    frequency_ratio,
                    forcing_per_clearance: 1.0,
                    excitation: Excitation::BaseDisplacement,
                    cavity: Cavity::IDEAL,
                };
                Family::of(&System::new(parameters).expect("valid")).expect("steady")
            },
        )
    }

    proptest! {
        /// The test functions are the polynomials that are solved, at amplitudes that were not asked for.
        #[test]
        fn test_functions_are_polynomials_over_a_power(family in families(), part in 0.05..0.95f64) {
            for (kind, power) in [(Bifurcation::SymmetryBreaking, 1), (Bifurcation::NeimarkSacker, 2)] {
                let polynomial = family.polynomial(kind, power);
                let beta = part * RANGE[1];
                let found = polynomial.iter().rev().fold(0.0, |sum, c| sum * beta + c);
                let exact = family.scaled_test(kind, power, beta);
                let size: f64 =
                    polynomial.iter().rev().fold(0.0, |sum, c| sum * RANGE[1] + c.abs());
                prop_assert!((found - exact).abs() < 1e-11 * size, "{kind:?} {found} {exact} {size}");
            }
        }

        /// The relative displacement is linear in the amplitude, and beyond the grazing a wall is passed.
        #[test]
        fn the_relative_displacement_is_linear_in_the_amplitude(
            family in families(),
            beta in 0.05..4.0f64,
            part in 0.0..1.0f64,
        ) {
            let (map, cycle) = family.orbit(beta);
            let leg = cycle.flights(&map)[0];
            let s = part * leg.duration;
            let [k, rate] = family.curve.sway(&map.flight, s);
            let angle = map.flight.frequency() * s;
            let at = leg.relative(s);
            let size = 1e-12 * (1.0 + beta * (k.abs() + rate.abs() + 10.0));
            prop_assert!((at.x - libm::cos(angle) - beta * k).abs() < size, "{at:?} {k}");
            let slope = beta * rate - map.flight.frequency() * libm::sin(angle);
            prop_assert!((at.v - slope).abs() < size, "{at:?} {rate}");
            if let Some(grazing) = family.curve.grazing(&map.flight) {
                let distance = family.test(Bifurcation::Grazing, beta);
                prop_assert!((beta > grazing) == (distance < 0.0), "{beta} {grazing} {distance}");
            }
        }
    }
}
