//! The largest displacement of places of the structure, and its mean square: not sampled; and the same of their velocities and
//! accelerations, whose phasors are those of the displacement times `p_k`, once or twice.
//!
//! See [`super::peaks`] of the former. The square of flights is integrated in closed form, see [`super::products`]; where absorbers
//! rest on walls, by the rule of Gauss and Legendre with [`NODES`] nodes, whose error in panels of 0.5 rad is below `1e-15` of the
//! squared amplitude.

use super::contact::HeldPanel;
use super::motion::{Gap, View};
use super::peaks::{FindPeaks, Reader, finder, highest};
use super::products::Products;
use super::{All, Course, MOST, ModalImpact, ModalObserver, ModalSegment, STILL};
use crate::numerics::gauss;
use crate::simulation::phasor::Slack;
use crate::system::ModalSystem;

const NODES: usize = 7;

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
pub struct ModalMeter {
    /// Which of those that differ each sensor is.
    each: Vec<usize>,
    /// What each reads in flights, as the order of a derivative, and how it sees the motion.
    views: Vec<(Option<usize>, View<MOST>)>,
    /// What each reads of the velocity that an impact gives an absorber; nothing of impacts of others.
    jumps: Vec<Option<(usize, f64)>>,
    rule: Vec<(f64, f64)>,
    peaks: Vec<f64>,
    finder: Box<dyn FindPeaks>,
    /// Of flights, and of each sensor where absorbers rest on walls.
    products: Products,
    squares: Vec<f64>,
    time: f64,
}

impl ModalMeter {
    /// Of a structure, for these sensors.
    pub fn new(system: &ModalSystem, sensors: &[Sensor]) -> Self {
        let all = All::of(system);
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
            let order = reads.in_flight();
            (order, all.view(shape, order.unwrap_or(0), 1.0 / scale))
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
        let views: Vec<(Option<usize>, View<MOST>)> = views.collect();
        let readers = views
            .iter()
            .enumerate()
            .filter_map(|(index, (order, view))| Some(Reader { order: (*order)?, view, index }));
        let finder = finder(&all.constants, all.modes, &readers.collect::<Vec<_>>());
        Self {
            each,
            finder,
            views,
            jumps: sensors.iter().copied().map(jump).collect(),
            rule: gauss::uniform(NODES),
            peaks: vec![0.0; sensors.len()],
            products: Products::of(&all.constants, all.modes),
            squares: vec![0.0; sensors.len()],
            time: 0.0,
        }
    }

    /// What each has read since the meter was made.
    pub fn records(&self) -> Vec<SensorRecord> {
        let squares = self.views.iter().zip(&self.squares).map(|((order, view), held)| {
            let order = (*order)?;
            Some(self.products.square(&view.shape, view.steady, order) + held)
        });
        let squares: Vec<f64> = squares.map(Option::unwrap_or_default).collect();
        let of = |n: &usize| SensorRecord {
            peak: self.peaks[*n],
            mean_square: if self.time > 0.0 { squares[*n] / self.time } else { 0.0 },
        };
        self.each.iter().map(of).collect()
    }

    /// The same, after which it begins anew.
    pub fn taken(&mut self) -> Vec<SensorRecord> {
        let records = self.records();
        self.peaks.fill(0.0);
        self.products.clear();
        self.squares.fill(0.0);
        self.time = 0.0;
        records
    }
}

impl std::fmt::Debug for ModalMeter {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("ModalMeter").field("peaks", &self.peaks).finish_non_exhaustive()
    }
}

impl ModalObserver for ModalMeter {
    fn segment(&mut self, segment: &ModalSegment<'_>) {
        let whole = segment.duration;
        self.time += whole;
        match &segment.course {
            Course::Free { begin, end } => {
                self.products.add(begin, end, whole);
                self.finder.find(begin, end, whole, &mut self.peaks);
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
