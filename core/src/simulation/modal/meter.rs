//! The largest displacement of places of the structure, and its mean square: not sampled.
//!
//! In each panel the displacement lies between the coefficients of its quintic in Bernstein's form, with the remainder that is
//! proven: only where these exceed what is known is a panel divided, where its quintic is level, until nothing is left but a
//! part of [`PEAK_ERROR`]. The square of a flight is integrated in closed form; where absorbers rest on walls, by the rule of
//! Gauss and Legendre with [`NODES`] nodes, whose error in panels of 0.5 rad is below `1e-15` of the squared amplitude.

use super::motion::{Gap, Phasors, View};
use super::{All, Course, MOST, ModalObserver, ModalSegment, STILL};
use crate::numerics::gauss;
use crate::simulation::certificate::{Hull, Quintic};
use crate::simulation::flow::{Phasor, mean_of_exponential};
use crate::simulation::phasor::Slack;
use crate::system::{LinearResponse, ModalSystem};

/// Share of a peak by which it may be too small.
pub const PEAK_ERROR: f64 = 1e-13;
const NODES: usize = 7;
/// Most divisions of a panel, of what is level to rounding, and most parts that wait.
const MOST_PARTS: usize = 200;
const MOST_OPEN: usize = 64;

/// What a place has done.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlaceMotion {
    /// Largest absolute displacement.
    pub peak: f64,
    /// Mean of the squared displacement over the time measured.
    pub mean_square: f64,
}

/// Measures the displacement `z + sum_k phi_k q_k` of places.
#[derive(Debug, Clone)]
pub struct ModalMeter {
    views: Vec<View<MOST>>,
    rule: Vec<(f64, f64)>,
    peaks: Vec<f64>,
    squares: Vec<f64>,
    time: f64,
}

impl ModalMeter {
    /// For places with these values of each mode; what a place has none of is 0.
    pub fn new(system: &ModalSystem, places: &[Vec<f64>]) -> Self {
        let all = All::of(system);
        let views = places.iter().map(|shape| {
            let shape = &shape[..shape.len().min(all.modes)];
            let base = LinearResponse { sine: all.base, cosine: 0.0 };
            let steady = shape.iter().zip(&all.steady).fold(base, |sum, (phi, [s, c])| {
                LinearResponse { sine: sum.sine + phi * s, cosine: sum.cosine + phi * c }
            });
            all.constants.view(shape, all.base, steady, 1.0)
        });
        Self {
            views: views.collect(),
            rule: gauss::uniform(NODES),
            peaks: vec![0.0; places.len()],
            squares: vec![0.0; places.len()],
            time: 0.0,
        }
    }

    /// What each place has done since the meter was made.
    pub fn places(&self) -> Vec<PlaceMotion> {
        let of = |(peak, square): (&f64, &f64)| PlaceMotion {
            peak: *peak,
            mean_square: if self.time > 0.0 { square / self.time } else { 0.0 },
        };
        self.peaks.iter().zip(&self.squares).map(of).collect()
    }
}

impl ModalObserver for ModalMeter {
    fn segment(&mut self, segment: &ModalSegment<'_>) {
        let (all, whole) = (segment.all, segment.duration);
        self.time += whole;
        match &segment.course {
            Course::Free(begin) => {
                let (constants, sizes) = (&all.constants, all.constants.sizes(begin));
                for (view, sum) in self.views.iter().zip(&mut self.squares) {
                    *sum += square(all, view, begin, whole);
                }
                let (mut here, mut left) = (*begin, whole);
                while left > 0.0 {
                    let length = constants.step.min(left);
                    let there = if length < constants.step {
                        constants.after(&here, length)
                    } else {
                        constants.next(&here)
                    };
                    let ends = [&here, &there].map(|at| (constants.free(at), at.rotor));
                    for (view, peak) in self.views.iter().zip(&mut self.peaks) {
                        let [here_at, there_at] = ends.map(|(free, rotor)| {
                            Gap::of(constants.seen(view, &free, rotor), STILL)
                        });
                        let slack = constants.slack(view, &sizes).0.part(length / constants.step);
                        let moment = |s: f64| {
                            let at = constants.after(&here, s);
                            Gap::of(constants.seen(view, &constants.free(&at), at.rotor), STILL)
                        };
                        *peak = highest(moment, [here_at, there_at], length, slack, *peak);
                    }
                    (here, left) = (there, left - length);
                }
            }
            Course::Held(panel) => {
                for (n, view) in self.views.iter().enumerate() {
                    let moment = |s: f64| Gap::of(segment.place(view, s), STILL);
                    let cube = whole * whole * whole;
                    let coefficient = panel.bound(view, 6) * cube * cube / 7200.0;
                    let slack = Slack { coefficient, slope_squared: 0.0 };
                    let ends = [moment(0.0), moment(whole)];
                    self.peaks[n] = highest(moment, ends, whole, slack, self.peaks[n]);
                    let square = |(node, weight): &(f64, f64)| {
                        let [x, ..] = segment.place(view, 0.5 * whole * (1.0 + node));
                        weight * x * x
                    };
                    self.squares[n] += whole * self.rule.iter().map(square).sum::<f64>();
                }
            }
        }
    }
}

/// The integral of the square of what is seen in a flight. It is the real part of a sum of exponentials `c_a e^{p_a s}`, and its
/// square that of `c_a c_b e^{(p_a + p_b) s}/2` and `c_a conj(c_b) e^{(p_a + conj(p_b)) s}/2`.
fn square(all: &All, view: &View<MOST>, begin: &Phasors<MOST>, duration: f64) -> f64 {
    let ([sin, cos], [s, c]) = (begin.rotor, view.steady);
    let mut terms = [[Phasor::new(0.0, 0.0); 2]; MOST + 1];
    terms[all.modes] =
        [Phasor::new(c, -s) * Phasor::new(cos, sin), Phasor::new(0.0, all.constants.frequency)];
    for (k, term) in terms.iter_mut().enumerate().take(all.modes) {
        let (mode, [re, im]) = (&all.constants.modes[k], begin.z[k]);
        let rate = Phasor::new(-mode.decay, mode.ringing);
        *term = [Phasor::new(re, im) * view.shape[k], rate];
    }
    let mut sum = 0.0;
    for (n, [c_a, p_a]) in terms[..=all.modes].iter().enumerate() {
        for (m, [c_b, p_b]) in terms[..=n].iter().enumerate() {
            let together = c_a * c_b * mean_of_exponential((p_a + p_b) * duration);
            let apart = c_a * c_b.conj() * mean_of_exponential((p_a + p_b.conj()) * duration);
            sum += (together + apart).re * if m == n { 0.5 } else { 1.0 };
        }
    }
    sum * duration
}

/// The largest displacement in a panel, or the one known.
fn highest(
    moment: impl Fn(f64) -> Gap,
    [here, there]: [Gap; 2],
    whole: f64,
    slack: Slack<f64>,
    mut peak: f64,
) -> f64 {
    peak = peak.max(here.gap.abs()).max(there.gap.abs());
    if Hull::of(&here, &there, whole, &slack).highest() <= peak {
        return peak;
    }
    let mut open = [(0.0, here, whole, there); MOST_OPEN];
    let mut count = 1;
    for _ in 0..MOST_PARTS {
        if count == 0 {
            break;
        }
        count -= 1;
        let (begin, here, end, there) = open[count];
        peak = peak.max(there.gap.abs());
        let length = end - begin;
        let slack = slack.part(length / whole);
        if Hull::of(&here, &there, length, &slack).highest() <= peak * (1.0 + PEAK_ERROR) {
            continue;
        }
        let turns = here.slope * there.slope < 0.0;
        let quintic = Quintic::through(&here, &there, length);
        let at = if turns { quintic.turning_point().at } else { 0.5 };
        let middle = begin + at.clamp(0.01, 0.99) * length;
        let between = moment(middle);
        peak = peak.max(between.gap.abs());
        if count + 2 > MOST_OPEN {
            break;
        }
        open[count] = (begin, here, middle, between);
        open[count + 1] = (middle, between, end, there);
        count += 2;
    }
    peak
}
