//! Areas Z1 to Z4 and the strips A1 and A2 (sections 3.2 and 3.3, Figs. 5 and 6c).

use serde::Serialize;

use super::boundaries::Boundaries;
use super::fixed_points::FixedPoint;
use super::manifold::Branch;
use crate::system::System;

/// The areas of Fig. 5a.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Area {
    /// More than two impacts per period.
    Z1,
    /// Two asymmetric impacts per period.
    Z2,
    /// Steady 1:1 resonance, or one of the strips beside it.
    Z3,
    /// No 1:1 resonance.
    Z4,
}

/// The transition strips of Fig. 6c.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Strip {
    /// Hysteresis: steady 1:1 resonance beside a modulated response.
    A1,
    /// Beat motion: strongly modulated response.
    A2,
}

/// Where closed form puts a system. The line between Z2 and Z1 is a grazing of the absorber, which
/// has no closed form in this theory: `area` is `None` right of symmetry breaking, to be settled by
/// a layer that can.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Zone {
    /// Z3 or Z4; `None` for Z1 or Z2.
    pub area: Option<Area>,
    /// The strip next to Z3, if in one.
    pub strip: Option<Strip>,
}

impl Zone {
    /// Places a system by its fixed points and the Hopf boundary.
    pub fn of(system: &System, fixed_points: &[FixedPoint], boundaries: &Boundaries) -> Self {
        let on = |branch| fixed_points.iter().any(|point| point.branch == branch);
        let below_hopf = system.forcing_per_clearance() < boundaries.hopf;
        let (area, strip) = if on(Branch::Stable) {
            (Some(Area::Z3), below_hopf.then_some(Strip::A1))
        } else if on(Branch::Right) {
            (None, None)
        } else if on(Branch::Left) && below_hopf {
            (Some(Area::Z3), Some(Strip::A2))
        } else {
            (Some(Area::Z4), None)
        };
        Self { area, strip }
    }

    /// Whether it is in Z3, strips included: where the paper wants as much of a band as possible.
    pub fn is_z3(&self) -> bool {
        self.area == Some(Area::Z3)
    }

    /// What a table calls it.
    pub fn words(&self) -> &'static str {
        match (self.area, self.strip) {
            (_, Some(Strip::A1)) => "strip A1",
            (_, Some(Strip::A2)) => "strip A2",
            (Some(Area::Z3), None) => "Z3",
            (Some(Area::Z4), None) => "Z4",
            _ => "Z1 or Z2",
        }
    }
}
