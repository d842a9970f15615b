//! The boundaries of the 1:1 response as lines, and the strips between them.
//!
//! They are sampled over the detuning: at each one, the collision of fixed points that counts is
//! the one at the smallest forcing (the largest clearance), beyond which no fixed point is left.
//! Other collisions lie where other fixed points remain and bound no area.

use crate::analysis::{AnalysisError, Boundaries, Branch, Manifold, Strip};
use crate::report::figure::{Color, Fill, Hatch, Layer, MarkedPoint, Role};
use crate::system::System;

/// Detunings that resolve the resonance, where the boundaries turn quickly.
const NEAR: f64 = 10.0;
/// Samples over the whole window, and over its part near resonance.
const SAMPLES: u32 = 240;

/// The boundaries at one detuning, as values of `gamma`.
#[derive(Debug, Clone, Copy)]
pub(in crate::report) struct Border {
    pub detuning: f64,
    pub breaking: f64,
    pub hopf: f64,
    /// NaN where no collision bounds the strip beside Z3.
    pub saddle: f64,
    /// Below it there is no fixed point: the collision, or where `B` has shrunk to nothing, or the
    /// Hopf boundary itself.
    pub last: f64,
    /// The strip between Hopf and saddle-node.
    strip: Option<Strip>,
}

/// The boundaries over a window.
pub(in crate::report) struct Borders {
    /// By ascending detuning.
    pub samples: Vec<Border>,
    /// `[sigma, gamma]` of P1, if in the window.
    pub meeting: Option<[f64; 2]>,
}

impl Borders {
    /// Samples the boundaries from the detuning `first` to `last`.
    pub(in crate::report) fn over(
        system: &System,
        manifold: &Manifold,
        (first, last): (f64, f64),
    ) -> Result<Self, AnalysisError> {
        let of = |detuning: f64| -> Result<Option<Boundaries>, AnalysisError> {
            let there = system.with_detuning(detuning).ok();
            Ok(there.map(|there| Boundaries::of(&there, manifold)))
        };
        let within = |detuning: f64| (first..=last).contains(&detuning);
        let even = |a: f64, b: f64| {
            (0..=SAMPLES).map(move |k| a + (b - a) * f64::from(k) / f64::from(SAMPLES))
        };
        let meeting = of(f64::midpoint(first, last))?
            .map(|at| [at.codimension_two.detuning, at.codimension_two.forcing_over_clearance])
            .filter(|at| within(at[0]) && at[1].is_finite() && at[1] > 0.0);
        let mut detunings: Vec<f64> = even(first, last)
            .chain(even(-NEAR, NEAR).filter(|detuning| within(*detuning)))
            .chain(meeting.map(|at| at[0]))
            .collect();
        detunings.sort_by(f64::total_cmp);
        detunings.dedup();
        let mut samples = Vec::new();
        for detuning in detunings {
            samples.extend(of(detuning)?.map(|at| Border::of(system, detuning, &at)));
        }
        Ok(Self { samples, meeting })
    }

    /// Areas and lines, from the back to the front; `place` puts `(sigma, gamma)` on the axes.
    pub(super) fn layers(&self, place: &dyn Fn(f64, f64) -> [f64; 2]) -> Vec<Layer> {
        let line = |value: fn(&Border) -> f64| -> Vec<[f64; 2]> {
            self.samples.iter().map(|at| place(at.detuning, value(at))).collect()
        };
        let hopf = line(|at| at.hopf);
        // With little damping symmetry breaks before the fold is reached: no room for Z3 there.
        let top = line(|at| at.breaking.max(at.hopf));
        let aim = Fill { color: Color::BluishGreen, opacity: 0.1, hatch: Hatch::None };
        let finite = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
            points.iter().copied().filter(|p| p[0].is_finite() && p[1].is_finite()).collect()
        };
        let mut layers = vec![Layer::between(&finite(&top), &finite(&hopf), aim)];
        for (strip, fill, name) in [
            (
                Strip::A1,
                Fill { opacity: 0.25, ..Fill::hatched(Color::Orange, Hatch::Rising) },
                "A1",
            ),
            (
                Strip::A2,
                Fill { opacity: 0.22, ..Fill::hatched(Color::SkyBlue, Hatch::Falling) },
                "A2",
            ),
        ] {
            layers.extend(self.strip(strip, fill, place).map(|band| band.labelled(name)));
        }
        layers.extend(self.lines(place));
        layers.extend(self.meeting_point(place));
        layers
    }

    /// The lines alone.
    pub(in crate::report) fn lines(&self, place: &dyn Fn(f64, f64) -> [f64; 2]) -> [Layer; 3] {
        let line = |role: Role, name: &str, value: fn(&Border) -> f64| {
            let points = self.samples.iter().map(|at| place(at.detuning, value(at)));
            Layer::curve(role, points.collect()).labelled(name)
        };
        [
            line(Role::SymmetryBreaking, "symmetry breaking", |at| at.breaking),
            line(Role::Hopf, "Hopf", |at| at.hopf),
            line(Role::SaddleNode, "saddle-node", |at| at.saddle),
        ]
    }

    /// P1, if it is in the window.
    pub(in crate::report) fn meeting_point(
        &self,
        place: &dyn Fn(f64, f64) -> [f64; 2],
    ) -> Option<Layer> {
        let [detuning, gamma] = self.meeting?;
        let [x, y] = place(detuning, gamma);
        let tooltip = "P1: saddle-node and Hopf boundaries meet; A1 on one side, A2 on the other";
        let p1 = MarkedPoint::new(x, y).with_label("P1").with_tooltip(tooltip);
        Some(Layer::marked(Role::Guide.marker(), Color::Black, [p1]))
    }

    /// The longest run of one strip.
    fn strip(
        &self,
        strip: Strip,
        fill: Fill,
        place: &dyn Fn(f64, f64) -> [f64; 2],
    ) -> Option<Layer> {
        let runs = self.samples.chunk_by(|a, b| a.strip == b.strip);
        let run = runs
            .filter(|run| run.first().is_some_and(|at| at.strip == Some(strip)))
            .max_by_key(|run| run.len())?;
        let tip = self.meeting.map(|[detuning, gamma]| place(detuning, gamma));
        let line = |value: fn(&Border) -> f64| {
            run.iter().map(move |at| place(at.detuning, value(at))).collect::<Vec<_>>()
        };
        let (mut lower, upper) = (line(|at| at.hopf), line(|at| at.last));
        match (tip, strip) {
            (Some(tip), Strip::A1) => lower.push(tip),
            (Some(tip), Strip::A2) => lower.insert(0, tip),
            (None, _) => {}
        }
        Some(Layer::between(&lower, &upper, fill))
    }
}

impl Border {
    fn of(system: &System, detuning: f64, at: &Boundaries) -> Self {
        let outer = at.saddle_node;
        // Without a collision a fixed point that passes the fold lives on until B = 0, where C = b.
        let vanishing = libm::hypot(system.damping(), 2.0 * detuning);
        let (last, strip) = match outer {
            Some(node) if node.branch == Branch::Left => {
                (node.forcing_over_clearance, Some(Strip::A2))
            }
            Some(node) => (node.forcing_over_clearance, Some(Strip::A1)),
            None if vanishing < at.hopf => (vanishing, Some(Strip::A2)),
            None => (at.hopf, None),
        };
        Self {
            detuning,
            breaking: at.symmetry_breaking,
            hopf: at.hopf,
            saddle: outer.map_or(f64::NAN, |node| node.forcing_over_clearance),
            last,
            strip,
        }
    }
}
