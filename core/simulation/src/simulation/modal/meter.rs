//! The largest displacement of places of the structure, and its mean square: not sampled; and the same of their velocities and
//! accelerations, whose phasors are those of the displacement times `p_k`, once or twice.
//!
//! In each panel what is read lies between the coefficients of its quintic in Bernstein's form, with the remainder that is
//! proven: only where these exceed what is known is a panel divided, where its quintic is level, until nothing is left but a
//! part of [`PEAK_ERROR`]. The square of a flight is integrated in closed form; where absorbers rest on walls, by the rule of
//! Gauss and Legendre with [`NODES`] nodes, whose error in panels of 0.5 rad is below `1e-15` of the squared amplitude.

use super::contact::HeldPanel;
use super::motion::{Constants, Gap, Phasors, View, longer, longest};
use super::{All, Course, MOST, ModalImpact, ModalObserver, ModalSegment, STILL};
use crate::numerics::gauss;
use crate::simulation::certificate::{Hull, Quintic};
use crate::simulation::flow::{Phasor, mean_to};
use crate::simulation::phasor::Slack;
use crate::system::{LinearResponse, ModalSystem};

/// Share of a peak by which it may be too small.
pub const PEAK_ERROR: f64 = 1e-13;
const NODES: usize = 7;
/// Most divisions of a panel, of what is level to rounding, and most parts that wait.
const MOST_PARTS: usize = 200;
const MOST_OPEN: usize = 64;

/// What is read of the motion of a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reading {
    /// Its displacement.
    Displacement,
    /// Its velocity: of an impact that before and behind it.
    Velocity,
    /// Its acceleration between impacts.
    Acceleration,
    /// The jump of its velocity in impacts of one absorber, 0 of one that there is not. It has no mean.
    Jump {
        /// Which absorber, from 0.
        absorber: usize,
    },
}

impl Reading {
    /// The order of the derivative that it is in a flight; none of what there is in impacts alone.
    fn in_flight(self) -> Option<usize> {
        (!matches!(self, Self::Jump { .. })).then(|| self.rates())
    }

    /// How often a time unit divides it.
    pub const fn rates(self) -> usize {
        match self {
            Self::Displacement => 0,
            Self::Velocity | Self::Jump { .. } => 1,
            Self::Acceleration => 2,
        }
    }
}

/// Reads `scale` times the displacement `z + sum_k phi_k q_k` of a place, a derivative of it by the fast time, or its jumps.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// Value of each mode's shape; what a place has none of is 0.
    pub shape: Vec<f64>,
    /// What is read.
    pub reads: Reading,
    /// What it is times: 1, or what makes SI units of it.
    pub scale: f64,
}

impl Sensor {
    /// Of the displacement, as it is.
    pub const fn displacement(shape: Vec<f64>) -> Self {
        Self { shape, reads: Reading::Displacement, scale: 1.0 }
    }

    /// What it reads at most of a sine of this amplitude and frequency, in the units of the structure times its own factor.
    pub fn of_sine(&self, amplitude: f64, frequency: f64) -> f64 {
        let Some(order) = self.reads.in_flight() else { return 0.0 };
        (0..order).fold(self.scale * amplitude, |value, _| value * frequency)
    }
}

/// What a sensor has read.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SensorRecord {
    /// The largest without its sign.
    pub peak: f64,
    /// Mean of the square over the time measured.
    pub mean_square: f64,
}

/// Reads sensors; those that are alike once.
#[derive(Debug, Clone)]
pub struct ModalMeter {
    /// Which of those that differ each sensor is.
    each: Vec<usize>,
    /// What each reads in flights, as the order of a derivative, and how it sees the motion.
    views: Vec<(Option<usize>, View<MOST>)>,
    /// What each reads of the velocity that an impact gives an absorber; nothing of impacts of others.
    jumps: Vec<Option<(usize, f64)>>,
    rule: Vec<(f64, f64)>,
    peaks: Vec<f64>,
    squares: Vec<f64>,
    time: f64,
}

/// The largest order of a derivative.
const MOST_ORDER: usize = 2;

impl ModalMeter {
    /// Of a structure, for these sensors.
    pub fn new(system: &ModalSystem, sensors: &[Sensor]) -> Self {
        let all = All::of(system);
        let frequency = all.constants.frequency;
        let mut differ: Vec<&Sensor> = Vec::new();
        let number = |sensor| {
            differ.iter().position(|one| *one == sensor).unwrap_or_else(|| {
                differ.push(sensor);
                differ.len() - 1
            })
        };
        let each = sensors.iter().map(number).collect();
        let sensors = differ;
        let views = sensors.iter().map(|Sensor { shape, reads, scale }| {
            let shape = &shape[..shape.len().min(all.modes)];
            let base = LinearResponse { sine: all.base, cosine: 0.0 };
            let steady = shape.iter().zip(&all.steady).fold(base, |sum, (phi, [s, c])| {
                LinearResponse { sine: sum.sine + phi * s, cosine: sum.cosine + phi * c }
            });
            let order = reads.in_flight();
            let steady = (0..order.unwrap_or(0)).fold(steady, |of, _| LinearResponse {
                sine: -frequency * of.cosine,
                cosine: frequency * of.sine,
            });
            (order, all.constants.view(shape, all.base, steady, 1.0 / scale))
        });
        let jump = |Sensor { shape, reads, scale }: &Sensor| {
            let Reading::Jump { absorber } = *reads else { return None };
            if absorber >= all.absorbers {
                return None;
            }
            let there = all.shape(absorber);
            let each = shape.iter().zip(&there).zip(&all.masses).take(all.modes);
            let yields: f64 = each.map(|((here, there), mass)| here * there / mass).sum();
            Some((absorber, scale * yields * all.absorber_masses[absorber]))
        };
        Self {
            each,
            views: views.collect(),
            jumps: sensors.iter().copied().map(jump).collect(),
            rule: gauss::uniform(NODES),
            peaks: vec![0.0; sensors.len()],
            squares: vec![0.0; sensors.len()],
            time: 0.0,
        }
    }

    /// What each has read since the meter was made.
    pub fn records(&self) -> Vec<SensorRecord> {
        let of = |n: &usize| SensorRecord {
            peak: self.peaks[*n],
            mean_square: if self.time > 0.0 { self.squares[*n] / self.time } else { 0.0 },
        };
        self.each.iter().map(of).collect()
    }

    /// The same, after which it begins anew.
    pub fn taken(&mut self) -> Vec<SensorRecord> {
        let records = self.records();
        self.peaks.fill(0.0);
        self.squares.fill(0.0);
        self.time = 0.0;
        records
    }
}

impl ModalObserver for ModalMeter {
    fn segment(&mut self, segment: &ModalSegment<'_>) {
        let (all, whole) = (segment.all, segment.duration);
        self.time += whole;
        match &segment.course {
            Course::Free(begin) => {
                self.add_squares(all, begin, whole);
                let mut derived = *begin;
                for order in 0..=MOST_ORDER {
                    if self.views.iter().any(|one| one.0 == Some(order)) {
                        match all.modes {
                            1 => self.find_peaks::<1>(all, order, &derived, whole),
                            2 => self.find_peaks::<2>(all, order, &derived, whole),
                            3 => self.find_peaks::<3>(all, order, &derived, whole),
                            4 => self.find_peaks::<4>(all, order, &derived, whole),
                            _ => self.find_peaks::<MOST>(all, order, &derived, whole),
                        }
                    }
                    derived = all.constants.derivative(&derived);
                }
            }
            Course::Held(panel) => self.add_held(panel, whole),
        }
    }

    fn impact(&mut self, impact: &ModalImpact) {
        let [before, after] = impact.y_velocity;
        for (peak, jump) in self.peaks.iter_mut().zip(&self.jumps) {
            let of = jump.filter(|(absorber, _)| *absorber == impact.absorber);
            *peak = of.map_or(*peak, |(_, by)| peak.max((by * (after - before)).abs()));
        }
    }
}

impl ModalMeter {
    /// The peaks of sensors that read a derivative, whose phasors begin here.
    /// Where a flight cannot go beyond what is known, by the sizes of its phasors or by the ends of a panel and a bound on the
    /// acceleration between, nothing is looked at.
    fn find_peaks<const N: usize>(
        &mut self,
        all: &All,
        order: usize,
        begin: &Phasors<MOST>,
        whole: f64,
    ) {
        let all_sizes = all.constants.sizes(begin);
        let beyond = |view: &View<MOST>, peak: f64| {
            let free = view.shape.iter().zip(&all_sizes).map(|(phi, size)| phi.abs() * size);
            free.sum::<f64>() + view.steady_size > peak
        };
        let watched =
            self.views.iter().zip(&mut self.peaks).filter(|(one, _)| one.0 == Some(order));
        let watched = watched.map(|((_, view), peak)| (view, peak));
        let mut watched: Vec<_> = watched.filter(|(view, peak)| beyond(view, **peak)).collect();
        if watched.is_empty() {
            return;
        }
        let constants: Constants<N, 0> = all.constants.first();
        let sizes = std::array::from_fn(|k| all_sizes[k]);
        let mut watched: Vec<_> = watched
            .iter_mut()
            .map(|(view, peak)| {
                let view: View<N> = view.first();
                (view, constants.slack(&view, &sizes), &mut **peak)
            })
            .collect();
        let first = Phasors { z: std::array::from_fn(|k| begin.z[k]), rotor: begin.rotor };
        let of = |view: &View<N>, at: &Phasors<N>| {
            Gap::of(constants.seen(view, &constants.free(at), at.rotor), STILL)
        };
        // Of what is known, as the certificate of flights is of a clearance.
        let slack = |(_, (slack, _), peak): &(View<N>, (Slack<f64>, f64), &mut f64)| {
            slack.coefficient / **peak
        };
        let most = longest(watched.iter().map(slack));
        let (mut here, mut left, mut times) = (first, whole, most);
        while left > 0.0 {
            let length = constants.step * longer(times);
            if times > 0 {
                let there = constants.next(&here, times);
                let clear = length <= left
                    && watched.iter().all(|(view, (slack, _), peak)| {
                        let slack = slack.part(longer(times));
                        let (here, there) = (of(view, &here), of(view, &there));
                        Hull::of(&here, &there, length, &slack).highest() <= **peak
                    });
                if clear {
                    (here, left) = (there, left - length);
                } else {
                    times -= 1;
                }
                continue;
            }
            let length = length.min(left);
            let there = if length < constants.step {
                constants.after(&here, length)
            } else {
                constants.next(&here, 0)
            };
            for (view, (slack, bend), peak) in &mut watched {
                let ends = view.at(&here).abs().max(view.at(&there).abs());
                if ends + 0.125 * *bend * length * length <= **peak {
                    continue;
                }
                let moment = |s: f64| of(view, &constants.after(&here, s));
                let slack = slack.part(length / constants.step);
                let ends = [of(view, &here), of(view, &there)];
                **peak = highest(moment, ends, length, slack, **peak);
                times = most;
            }
            (here, left) = (there, left - length);
        }
    }

    /// The integral of the square of what is seen in a flight. It is the real part of a sum of exponentials `c_a e^{p_a s}`,
    /// and its square that of `c_a c_b e^{(p_a + p_b) s}/2` and `c_a conj(c_b) e^{(p_a + conj(p_b)) s}/2`.
    fn add_squares(&mut self, all: &All, begin: &Phasors<MOST>, duration: f64) {
        let (constants, [sin, cos]) = (&all.constants, begin.rotor);
        let rate = |a: usize| {
            let own = || Phasor::new(-constants.modes[a].decay, constants.modes[a].ringing);
            let rate = if a < all.modes { own() } else { Phasor::new(0.0, constants.frequency) };
            rate * duration
        };
        let mut ends = [(Phasor::new(0.0, 0.0), Phasor::new(1.0, 0.0)); MOST + 1];
        for (a, (turn, end)) in ends.iter_mut().enumerate().take(all.modes + 1) {
            *turn = rate(a);
            let ((sin, cos), size) = (libm::sincos(turn.im), libm::exp(turn.re));
            *end = Phasor::new(size * cos, size * sin);
        }
        let mut means = [[[Phasor::new(0.0, 0.0); 2]; MOST + 1]; MOST + 1];
        for (n, row) in means.iter_mut().enumerate().take(all.modes + 1) {
            for (m, mean) in row.iter_mut().enumerate().take(n + 1) {
                let ((p_a, e_a), (p_b, e_b)) = (ends[n], ends[m]);
                let share = duration * if m == n { 0.5 } else { 1.0 };
                *mean = [
                    mean_to(p_a + p_b, e_a * e_b) * share,
                    mean_to(p_a + p_b.conj(), e_a * e_b.conj()) * share,
                ];
            }
        }
        let first = constants.derivative(begin);
        let derived = [*begin, first, constants.derivative(&first)];
        for ((order, view), sum) in self.views.iter().zip(&mut self.squares) {
            let Some(order) = order else { continue };
            let [s, c] = view.steady;
            let mut terms = [Phasor::new(c, -s) * Phasor::new(cos, sin); MOST + 1];
            for (k, [re, im]) in derived[*order].z.iter().enumerate().take(all.modes) {
                terms[k] = Phasor::new(*re, *im) * view.shape[k];
            }
            for (n, row) in means.iter().enumerate().take(all.modes + 1) {
                let each = row.iter().zip(&terms).take(n + 1);
                let other = each.fold(Phasor::new(0.0, 0.0), |other, ([together, apart], term)| {
                    other + term * together + term.conj() * apart
                });
                *sum += (terms[n] * other).re;
            }
        }
    }

    fn add_held(&mut self, panel: &HeldPanel, whole: f64) {
        for (n, (order, view)) in self.views.iter().enumerate() {
            let Some(order) = order else { continue };
            let sight = panel.sight(view).derivative(*order);
            let moment = |s: f64| Gap::of(sight.moment(s), STILL);
            let cube = whole * whole * whole;
            let coefficient = panel.bound(view, 6 + order) * cube * cube / 7200.0;
            let slack = Slack { coefficient, slope_squared: 0.0 };
            let ends = [moment(0.0), moment(whole)];
            self.peaks[n] = highest(moment, ends, whole, slack, self.peaks[n]);
            let square = |(node, weight): &(f64, f64)| {
                let x = sight.at(0.5 * whole * (1.0 + node), 0);
                whole * weight * x * x
            };
            self.squares[n] += self.rule.iter().map(square).sum::<f64>();
        }
    }
}

/// The largest that is read in a panel, or what is known.
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
