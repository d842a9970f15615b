//! What theory says of the mode that a load drives, beside the exact orbit of all modes there.
//!
//! Symmetric 1:1 resonance of one mode at leading order in its mass ratio; the other modes enter by the restitution that impacts seem
//! to have ([`effective_restitutions`]). An absorber at a node of the mode has no part in it.

use super::driven_mode;
use crate::analysis::{
    AbsorberGroup, GroupFixedPoint, Manifold, UnforcedMode, effective_restitutions,
    neglected_at_leading_order, scattered,
};
use crate::case::{Load, ModalCase};
use crate::orbits::ModalOrbit;

/// The theory of a mode under a load, at one frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadTheory {
    /// Which load.
    pub load: usize,
    /// Its frequency in Hz.
    pub at: f64,
    /// The mode, from 0.
    pub mode: usize,
    /// The place at which it moves farthest, and its shape there without sign: amplitudes are those of this place, in m.
    pub place: usize,
    /// For each absorber the restitution that its impacts seem to have.
    pub restitutions: Vec<f64>,
    /// For each other mode, from 0, the energy that impacts of a symmetric 1:1 motion give it over what they would at random.
    pub scattered: Vec<(usize, f64)>,
    /// The absorbers at leading order; none where one's restitution then is below 0, or all sit at nodes.
    pub group: Option<GroupTheory>,
    /// The exact orbits there, by ascending amplitude.
    pub exact: Vec<ExactAmplitude>,
}

/// An exact orbit as theory sees one.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactAmplitude {
    /// Amplitude of its first harmonic in m.
    pub amplitude: f64,
    /// For each absorber of the case that of its straight lines between the walls, in m.
    pub absorbers: Vec<f64>,
    /// Whether it attracts.
    pub attracts: bool,
}

/// The manifold of an absorber in the mode that a load drives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AbsorberManifold {
    /// The absorber, by its number in the case from 0.
    pub absorber: usize,
    /// Its clearance in m, over which its own amplitude is.
    pub clearance: f64,
    /// That of the place that moves farthest, in m, over which the structure's amplitude is: larger where the absorber's place moves less.
    pub seen: f64,
    /// The manifold, with the restitution that its impacts seem to have.
    pub manifold: Manifold,
}

impl AbsorberManifold {
    /// The absorber's amplitude, and that of the structure, at a point of the manifold over the clearance; in m.
    pub fn at(&self, [absorber, structure]: [f64; 2]) -> [f64; 2] {
        [absorber * self.clearance, structure * self.seen]
    }

    /// Its amplitude in m on the stable branch, or beyond it, where the structure has one in m; none below the fold.
    pub fn absorber_at(&self, amplitude: f64) -> Option<f64> {
        Some(self.clearance * self.manifold.stable_absorber(amplitude / self.seen)?)
    }
}

/// Absorbers on a mode at leading order.
#[derive(Debug, Clone, PartialEq)]
pub struct GroupTheory {
    /// Sum of the mass ratios.
    pub mass_ratio: f64,
    /// Expected relative error of amplitudes, by what leading order neglects.
    pub error: f64,
    /// Amplitudes between which every absorber is in symmetric 1:1 resonance, in m.
    pub range: Option<[f64; 2]>,
    /// Amplitudes of the fixed points of the slow flow in m, ascending, and whether each is stable.
    pub points: Vec<(f64, bool)>,
    /// Amplitudes of the load at which two fixed points collide, in its unit, ascending.
    pub collisions: Vec<f64>,
    /// The manifolds of the absorbers that the mode moves, in the order of the case.
    pub manifolds: Vec<AbsorberManifold>,
}

impl LoadTheory {
    /// Amplitude of the first harmonic of an orbit in the mode that is driven, at the place where that moves farthest, in m.
    pub(super) fn amplitude(&self, case: &ModalCase, orbit: &ModalOrbit) -> f64 {
        case.modes[self.mode].shape[self.place].abs() * orbit.harmonics[self.mode]
    }

    /// That of a load and a frequency in Hz whose exact orbits are known.
    pub(super) fn of(
        case: &ModalCase,
        (number, at): (usize, f64),
        orbits: &[ModalOrbit],
    ) -> Option<Self> {
        let load = &case.loads[number];
        let system = case.system(load, at).ok()?;
        let mode = driven_mode(case, &Load { range_hz: [at; 2], ..*load });
        let shape = &case.modes[mode].shape;
        let place = (0..shape.len()).max_by(|a, b| shape[*a].abs().total_cmp(&shape[*b].abs()))?;
        let farthest = shape[place].abs();
        // What other modes move where impacts are, of the order of their mass ratios, with the same factor.
        let own = &system.modes()[mode];
        let of_others = |j: usize| system.mass_ratio(j) - system.modal_mass_ratio(own, j);
        let of_others: f64 = (0..system.absorbers().len()).map(of_others).sum();
        let beside = neglected_at_leading_order(of_others, 0.0, 0.0);
        let others = (0..system.modes().len()).filter(|k| *k != mode);
        let group = AbsorberGroup::beside_others(&system, mode).map(|group| {
            let point = |one: &GroupFixedPoint| (farthest * one.amplitude, one.stable);
            let times = load.amplitude / group.forcing;
            let collisions = group.saddle_nodes();
            let moved = (0..case.absorbers.len())
                .filter(|j| case.modes[mode].shape[case.absorbers[*j].place] != 0.0);
            let manifolds = moved.zip(&group.members).map(|(absorber, member)| AbsorberManifold {
                absorber,
                clearance: case.absorbers[absorber].clearance_m,
                seen: farthest * member.clearance,
                manifold: member.manifold,
            });
            GroupTheory {
                manifolds: manifolds.collect(),
                mass_ratio: group.mass_ratio,
                error: neglected_at_leading_order(group.mass_ratio, group.detuning, group.damping)
                    + beside,
                range: group.range().map(|range| range.map(|end| farthest * end)),
                points: group.fixed_points().iter().map(point).collect(),
                collisions: collisions.iter().map(|[_, forcing]| forcing * times).collect(),
            }
        });
        let of_mode = |k: usize| (k, scattered(UnforcedMode::of(&system, k)));
        let mut theory = Self {
            load: number,
            at,
            mode,
            place,
            restitutions: effective_restitutions(&system, mode)?,
            scattered: others.map(of_mode).collect(),
            group,
            exact: Vec::new(),
        };
        let admissible = orbits.iter().filter(|orbit| orbit.admissible);
        let quarter = 0.25 * system.period();
        let exact = admissible.map(|orbit| ExactAmplitude {
            amplitude: theory.amplitude(case, orbit),
            absorbers: orbit.impact_speeds.iter().map(|speed| quarter * speed).collect(),
            attracts: orbit.stable(),
        });
        theory.exact = exact.collect();
        theory.exact.sort_by(|a, b| a.amplitude.total_cmp(&b.amplitude));
        Some(theory)
    }
}
