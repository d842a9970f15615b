//! The curve of a restitution: closed form on the manifold's stable branch, elsewhere motions of the impact pair
//! that are followed up and down in amplitude.

use std::collections::BTreeSet;

use serde::Serialize;

use super::branch::PairBranch;
use super::pair::{PairPoint, scouted};
use crate::analysis::Manifold;
use crate::equations::dissipation::{REACTANCE, RESISTANCE};
use crate::regimes::Regime;

/// Distance of amplitudes at which motions are followed, over the clearance.
const STEP: f64 = 0.02;
/// Steps between places at which starts are followed to what they lead to, whatever that is.
const SEED_STEPS: usize = 8;
/// Starts at every step that are followed where they soon repeat and are on no motion that is known: a branch as wide as four
/// steps that one start in twelve leads to is then missed with a probability of a twentieth.
const SCOUTS: u32 = 8;
/// Fastest of them, over the amplitude.
const FASTEST: f64 = 3.0;
/// Such starts: relative displacement, and velocity over the amplitude.
const SEEDS: [[f64; 2]; 3] = [[0.3, 1.4], [-0.8, -0.6], [0.7, 2.5]];
/// Largest change of `S` or `K` per amplitude of one motion; above, two points belong to two.
const STEEPEST: f64 = 4.0;
/// Points of the closed form, closer towards the fold, where it is steep.
const CLOSED_POINTS: u32 = 128;
/// Halvings of a step in which the end of a branch is located.
const HALVINGS: u32 = 4;
/// Largest restitution of which motions are followed: up to it less than a hundredth of a start is left, `r^n`, after
/// the thousand impacts over which a motion is averaged at least.
pub(super) const MOST_ELASTIC: f64 = 0.995;

/// `S` and `K` over the amplitude for one restitution.
///
/// ```
/// use vinesink_core::dissipation::DissipationCurve;
///
/// let curve = DissipationCurve::of(0.6, [0.15, 1.2]);
/// // On the manifold's stable branch in closed form.
/// let stable = curve.branches.iter().find(|branch| branch.closed_form).expect("one");
/// let ([resistance, reactance], _) = stable.forces(0.5).expect("between fold and symmetry breaking");
/// assert!((resistance - 0.538).abs() < 1e-3 && (reactance + 1.040).abs() < 1e-3);
/// // What a designer remembers: the absorber takes half a clearance off the reduced forcing at any amplitude.
/// let [least, most] = curve.resistance_range([0.4, 1.2]).expect("motions of two impacts or more");
/// assert!(least > 0.49 && most < 0.60);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct DissipationCurve {
    /// `r`.
    pub restitution: f64,
    /// By ascending smallest amplitude; the absorber at rest, `S = K = 0` up to one clearance, is the first.
    pub branches: Vec<PairBranch>,
    /// Whether impacts are so elastic, `r` above 0.995, that averages depend on the start for longer than one is
    /// followed. Beside the closed form there is no curve then; elastic impacts, `r = 1`, forget nothing, and take
    /// nothing: whatever the motion, its `S` is 0 in the mean.
    pub depends_on_start: bool,
}

impl DissipationCurve {
    /// The curve of a restitution for amplitudes `C/b` in a range, the smallest above 0; the closed form and the
    /// absorber at rest are there in full.
    pub fn of(restitution: f64, [from, to]: [f64; 2]) -> Self {
        let closed = closed_form(restitution);
        let depends_on_start = restitution > MOST_ELASTIC;
        if depends_on_start {
            return Self { restitution, branches: vec![at_rest(), closed], depends_on_start };
        }
        let steps = ((to - from) / STEP).ceil() as usize;
        let mut search = CurveSearch {
            restitution,
            amplitudes: (0..=steps).map(|k| from + STEP * k as f64).collect(),
            known: vec![Vec::new(); steps + 1],
            seen: vec![Vec::new(); steps + 1],
        };
        search.follow(0, true, [0.5, from], false);
        search.follow(steps, false, [0.5, to], false);
        for at in (0..=steps).step_by(SEED_STEPS) {
            for [w, speed] in SEEDS {
                let start = [w, speed * search.amplitudes[at]];
                search.begin(at, start);
            }
        }
        for at in 0..=steps {
            search.scout(at);
        }
        // The closed form is the better answer where it holds.
        let better = |point: &PairPoint| {
            point.regime == Regime::TwoSymmetric && closed.covers(point.amplitude)
        };
        search.known.iter_mut().for_each(|known| known.retain(|point| !better(point)));
        let chains = search.chains().into_iter();
        let mut branches: Vec<PairBranch> =
            chains.map(|chain| search.branch(chain, |point| !better(point))).collect();
        branches.retain(|branch| branch.points.len() > 1);
        branches.extend([closed, at_rest()]);
        branches.sort_by(|a, b| a.range()[0].total_cmp(&b.range()[0]));
        Self { restitution, branches, depends_on_start }
    }

    /// The smallest and the largest `S` over a range of amplitudes, of all motions with two impacts per period or
    /// more: what the absorber takes off the reduced forcing, over the clearance. None where there are no such motions.
    pub fn resistance_range(&self, [from, to]: [f64; 2]) -> Option<[f64; 2]> {
        let captured = [Regime::TwoSymmetric, Regime::TwoAsymmetric, Regime::AboveTwo];
        let moving = self.branches.iter().flat_map(|branch| &branch.points).filter(|point| {
            captured.contains(&point.regime) && (from..=to).contains(&point.amplitude)
        });
        moving.map(|point| point.resistance).fold(None, |range: Option<[f64; 2]>, value| {
            let [least, most] = range.unwrap_or([value; 2]);
            Some([least.min(value), most.max(value)])
        })
    }
}

/// The absorber at rest in the middle, which no wall reaches.
fn at_rest() -> PairBranch {
    let count = (1.0 / STEP).round() as u32;
    let points = (0..=count).map(|k| PairPoint::still(f64::from(k) / f64::from(count)));
    PairBranch { points: points.collect(), closed_form: false }
}

/// The manifold's stable branch, as far as its points are motions.
fn closed_form(restitution: f64) -> PairBranch {
    let manifold = Manifold::of(restitution);
    let fold = manifold.fold;
    let [from, to] = [fold.oscillator_amplitude, manifold.largest_stable_motion()];
    let point = |k: u32| {
        let part = f64::from(k) / f64::from(CLOSED_POINTS);
        let amplitude = if k == CLOSED_POINTS { to } else { from + (to - from) * part * part };
        let ratio = manifold.stable_absorber(amplitude).filter(|_| k > 0);
        let shift = ratio.map_or(manifold.fold_shift, |ratio| ratio - 1.0);
        let ratio = ratio.unwrap_or(fold.absorber_amplitude);
        PairPoint::symmetric(amplitude, symmetric_forces(&manifold, amplitude, ratio, shift))
    };
    // For elastic impacts the fold is at 0, where no phase is.
    let points = (0..=CLOSED_POINTS).map(point).filter(|point| point.amplitude > 0.0);
    PairBranch { points: points.collect(), closed_form: true }
}

/// `S` and `K` of the symmetric motion with two impacts per period, whose absorber has the amplitude `1 + shift`.
pub(super) fn symmetric_forces(
    manifold: &Manifold,
    amplitude: f64,
    ratio: f64,
    shift: f64,
) -> [f64; 2] {
    let resistance = RESISTANCE.at([manifold.restitution_ratio, ratio, amplitude]);
    [resistance, REACTANCE.at([ratio, shift, amplitude])]
}

/// Motions at even amplitudes.
struct CurveSearch {
    restitution: f64,
    amplitudes: Vec<f64>,
    known: Vec<Vec<PairPoint>>,
    /// States that led to motions which were known by then, of mirror images for instance.
    seen: Vec<Vec<[f64; 2]>>,
}

impl CurveSearch {
    /// The motion that a state leads to at an amplitude: what is carried on, and whether it is a new one. None
    /// where the absorber comes to rest.
    fn visit(&mut self, at: usize, state: [f64; 2]) -> Option<([f64; 2], bool)> {
        let point = PairPoint::measured(self.restitution, *self.amplitudes.get(at)?, state)?;
        if point.regime == Regime::AtRest {
            return None;
        }
        let known = &mut self.known[at];
        let new = !known.iter().any(|other| other.is_same(&point));
        if new {
            known.push(point);
        } else {
            self.seen[at].push(point.state);
        }
        Some((point.state, new))
    }

    /// Follows what a start leads to both ways, if that is new.
    fn begin(&mut self, at: usize, start: [f64; 2]) {
        if let Some((state, true)) = self.visit(at, start) {
            self.follow(at + 1, true, state, true);
            self.follow(at.wrapping_sub(1), false, state, true);
        }
    }

    /// Begins where starts repeat that are on no known motion.
    fn scout(&mut self, at: usize) {
        let amplitude = self.amplitudes[at];
        for k in 0..SCOUTS {
            // Multiples of roots of primes spread evenly, differently at each amplitude.
            let number = f64::from(SCOUTS) * at as f64 + f64::from(k) + 0.5;
            let [w, speed] =
                [2.0, 3.0].map(|prime: f64| 2.0 * (number * prime.sqrt()).fract() - 1.0);
            let start = [w, FASTEST * speed * amplitude];
            let known = self.known[at].iter().map(|point| point.state);
            let known: Vec<[f64; 2]> = known.chain(self.seen[at].iter().copied()).collect();
            if let Some(state) = scouted(self.restitution, amplitude, start, &known) {
                self.begin(at, state);
            }
        }
    }

    /// Follows a motion from step to step, to the end of the range or, if asked, to one that is known.
    fn follow(&mut self, from: usize, up: bool, start: [f64; 2], until_known: bool) {
        let (mut at, mut state) = (from, start);
        while at < self.amplitudes.len() {
            match self.visit(at, state) {
                Some((_, false)) if until_known => return,
                Some((next, _)) => state = next,
                None if until_known => return,
                None => state = start,
            }
            at = if up { at + 1 } else { at.wrapping_sub(1) };
        }
    }

    /// Whether two motions, the second at the next larger amplitude, are one that changes.
    fn connected(from: &PairPoint, to: &PairPoint) -> bool {
        let steep = STEEPEST * (to.amplitude - from.amplitude);
        !from.is_another_kind(to) && from.distance(to) <= steep
    }

    /// Motions at successive amplitudes that belong together, those most alike first.
    fn chains(&self) -> Vec<Vec<PairPoint>> {
        let mut chains: Vec<Vec<PairPoint>> = Vec::new();
        for known in &self.known {
            let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
            for (c, chain) in chains.iter().enumerate() {
                for (k, point) in known.iter().enumerate() {
                    let last = &chain[chain.len() - 1];
                    let next = point.amplitude - last.amplitude < 1.5 * STEP;
                    if next && Self::connected(last, point) {
                        pairs.push((last.distance(point), c, k));
                    }
                }
            }
            pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
            let (mut extended, mut placed) = (BTreeSet::new(), BTreeSet::new());
            for (_, c, k) in pairs {
                if !extended.contains(&c) && !placed.contains(&k) {
                    extended.insert(c);
                    placed.insert(k);
                    chains[c].push(known[k]);
                }
            }
            let rest = (0..known.len()).filter(|k| !placed.contains(k));
            chains.extend(rest.map(|k| vec![known[k]]));
        }
        chains
    }

    /// A branch of a chain, its ends located within a part of a step, or joined to a motion that is another branch's
    /// as well.
    fn branch(
        &self,
        mut points: Vec<PairPoint>,
        accepted: impl Fn(&PairPoint) -> bool,
    ) -> PairBranch {
        for up in [true, false] {
            let last = if up { points[points.len() - 1] } else { points[0] };
            let add = |points: &mut Vec<PairPoint>, point| {
                points.insert(if up { points.len() } else { 0 }, point)
            };
            let joins = |point: &PairPoint| {
                let [low, high] = if up { [&last, point] } else { [point, &last] };
                let step = high.amplitude - low.amplitude;
                step > 0.0 && step < 1.5 * STEP && Self::connected(low, high)
            };
            if let Some(next) = self.known.iter().flatten().find(|point| joins(point)) {
                add(&mut points, *next);
                continue;
            }
            self.extend(&mut points, up, &accepted);
        }
        PairBranch { points, closed_form: false }
    }

    /// Adds motions beyond an end of a chain by ever shorter steps, within the range.
    fn extend(&self, points: &mut Vec<PairPoint>, up: bool, accepted: impl Fn(&PairPoint) -> bool) {
        let [from, to] = [self.amplitudes[0], self.amplitudes[self.amplitudes.len() - 1]];
        let mut step = if up { STEP } else { -STEP };
        for _ in 0..HALVINGS {
            step *= 0.5;
            let last = if up { points[points.len() - 1] } else { points[0] };
            let amplitude = last.amplitude + step;
            let further = (from..=to).contains(&amplitude);
            let further = further
                .then(|| PairPoint::measured(self.restitution, amplitude, last.state))
                .flatten();
            let Some(further) = further.filter(|one| one.regime != Regime::AtRest && accepted(one))
            else {
                continue;
            };
            let [low, high] = if up { [&last, &further] } else { [&further, &last] };
            if Self::connected(low, high) {
                points.insert(if up { points.len() } else { 0 }, further);
            }
        }
    }
}
