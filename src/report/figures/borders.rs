//! Lines and areas of the theory's boundaries.

use crate::analysis::Strip;
use crate::report::figure::{Color, Fill, Hatch, Layer, MarkedPoint, Role};
pub(in crate::report) use crate::study::plots::Borders;
use crate::study::plots::borders::Border;

use super::parts;

/// Puts `(sigma, gamma)` on the axes.
type OnAxes<'a> = &'a dyn Fn(f64, f64) -> [f64; 2];

impl Borders {
    /// Areas and lines, from the back to the front. `outer` and `inner` are ordinates beyond Z4 and beyond Z1.
    pub(super) fn layers(&self, place: OnAxes, [outer, inner]: [f64; 2]) -> Vec<Layer> {
        let line = |value: fn(&Border) -> f64| finite(self.line(place, value));
        let to = |line: &[[f64; 2]], y: f64| line.iter().map(|at| [at[0], y]).collect::<Vec<_>>();
        let area =
            |name, a: &[[f64; 2]], b: &[[f64; 2]], fill| Layer::between(a, b, fill).labelled(name);
        let (hopf, last) = (line(|at| at.hopf), line(|at| at.last));
        // With little damping symmetry breaks before the fold is reached: no room for Z3 there.
        let top = line(|at| at.breaking.max(at.hopf));
        // With little damping, near resonance, the asymmetric motion grazes as soon as it begins.
        let third = line(|at| at.grazing.max(at.breaking).max(at.hopf));
        let mut layers = vec![
            area("Z4: no 1:1", &last, &to(&last, outer), parts::Z4),
            area("Z3: steady 1:1", &top, &hopf, parts::Z3),
        ];
        if self.samples.iter().any(|at| at.grazing > at.breaking) {
            layers.push(area("Z2: asymmetric", &top, &third, parts::Z2));
        }
        layers.push(area("Z1: more impacts", &third, &to(&third, inner), parts::Z1));
        layers.extend(self.strip(Strip::A1, place));
        layers.extend(self.strip(Strip::A2, place));
        layers.extend(self.lines(place));
        layers.extend(self.meeting_point(place));
        layers
    }

    fn line(&self, place: OnAxes, value: fn(&Border) -> f64) -> Vec<[f64; 2]> {
        self.samples.iter().map(|at| place(at.detuning, value(at))).collect()
    }

    /// The lines alone.
    pub(in crate::report) fn lines(&self, place: OnAxes) -> [Layer; 3] {
        let line = |role: Role, name: &str, value: fn(&Border) -> f64| {
            Layer::curve(role, self.line(place, value)).labelled(name)
        };
        [
            line(Role::SymmetryBreaking, "symmetry breaking", |at| at.breaking),
            line(Role::Hopf, "Hopf", |at| at.hopf),
            line(Role::SaddleNode, "saddle-node", |at| at.saddle),
        ]
    }

    /// P1, if it is in the window.
    pub(in crate::report) fn meeting_point(&self, place: OnAxes) -> Option<Layer> {
        let [detuning, gamma] = self.meeting?;
        let [x, y] = place(detuning, gamma);
        let tooltip = "P1: saddle-node and Hopf boundaries meet; A1 on one side, A2 on the other";
        let p1 = MarkedPoint::new(x, y).with_label("P1").with_tooltip(tooltip);
        Some(Layer::marked(Role::Guide.marker(), Color::Black, [p1]))
    }

    /// The longest run of one strip.
    fn strip(&self, strip: Strip, place: OnAxes) -> Option<Layer> {
        let runs = self.samples.chunk_by(|a, b| a.strip == b.strip);
        let runs = runs.filter(|run| run[0].strip == Some(strip));
        let run = runs.max_by_key(|run| run.len())?;
        let line = |value: fn(&Border) -> f64| {
            run.iter().map(move |at| place(at.detuning, value(at))).collect::<Vec<_>>()
        };
        let (mut lower, upper) = (line(|at| at.hopf), line(|at| at.last));
        let tip = self.meeting.map(|[detuning, gamma]| place(detuning, gamma));
        let (end, color, hatch) = match strip {
            Strip::A1 => (lower.len(), Color::Orange, Hatch::Rising),
            Strip::A2 => (0, Color::SkyBlue, Hatch::Falling),
        };
        lower.splice(end..end, tip);
        let fill = Fill { opacity: 0.24, ..Fill::hatched(color, hatch) };
        Some(Layer::between(&lower, &upper, fill).labelled(strip.key()))
    }
}

fn finite(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.retain(|point| point.iter().all(|value| value.is_finite()));
    points
}
