//! Exact orbits of a case, and branches of them along a parameter.

use numpy::{Complex64, IntoPyArray, PyArray2, PyArrayMethods as _};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Value, json};
use vinesink::answer::branch::{
    Branch, BranchDirection, BranchEnd, FullSystem, ImpactMap, Orbit, Peaks, Settings, follow,
};
use vinesink::case::Case;
use vinesink::system::Parameter;

use crate::errors::refused;
use crate::work::Columns;

/// Orbits with two impacts per period, in the case's units: the fields of `orbits` in the JSON of `analyze` and more.
pub fn orbits(case: &Case) -> Vec<Value> {
    let (system, scales) = (case.system(), case.units());
    let full = FullSystem::of(&system);
    let told = |orbit: &Orbit, impact: f64, peak: f64, phase: f64| {
        json!({
            "impact_displacement": scales.length(impact),
            "peak_displacement": scales.length(peak),
            "phase": phase,
            "multipliers": orbit.multipliers.values,
            "spectral_radius": orbit.multipliers.spectral_radius(),
            "admissible": orbit.admissibility.admissible,
            "stable": orbit.attracts(),
            "residual": orbit.convergence.residual,
            "sequence": orbit.cycle.sequence(),
            "radius_per_period": orbit.radius_per_period(),
        })
    };
    if let (Some(found), Ok(map)) = (&full.two_impact, ImpactMap::of(&system)) {
        let each = found.orbits.iter().map(|orbit| {
            let first = orbit.cycle.impacts[0];
            told(orbit, first.x, Peaks::of(&map, &orbit.cycle).displacement, first.phase)
        });
        return each.collect();
    }
    let symmetric = full.orbits.iter();
    symmetric
        .map(|one| told(&one.orbit, one.impact_displacement, one.peaks.displacement, one.phase))
        .collect()
}

/// A point of a branch, in the case's units.
struct BranchRow {
    value: f64,
    peak: f64,
    orbit: Orbit,
}

/// A branch, from its lower end to its upper end.
pub struct Followed {
    points: Vec<BranchRow>,
    /// Bifurcations in the order of the points, and both ends.
    pub told: Value,
}

/// Follows the branch of an orbit, by default the one that attracts, both ways.
pub fn followed(
    case: &Case,
    parameter: &str,
    range: [f64; 2],
    orbit: Option<usize>,
    most_points: usize,
) -> PyResult<Followed> {
    let (system, scales) = (case.system(), case.units());
    let known = Parameter::OF_SYSTEM.map(Parameter::key).join(", ");
    let unknown =
        || refused(format!("no branch is followed along `{parameter}`; choose one of {known}"));
    let parameter = Parameter::of_name(parameter);
    let parameter =
        parameter.filter(|one| Parameter::OF_SYSTEM.contains(one)).ok_or_else(unknown)?;
    let amplitude = case.design.value(Parameter::Amplitude).unwrap_or(1.0);
    let unit = match parameter {
        Parameter::Clearance => scales.clearance,
        Parameter::Amplitude => amplitude,
        Parameter::Frequency => scales.frequency(1.0),
        _ => 1.0,
    };
    let own = unit * parameter.of(&system);
    let [low, high] = range;
    if !(low <= own && own <= high && high.is_finite()) {
        let key = parameter.key();
        return Err(refused(format!(
            "the case's {key} is {own}, outside of {low} to {high}; widen the range"
        )));
    }
    let full = FullSystem::of(&system);
    let orbits = full.two_impact_orbits();
    let chosen = match orbit {
        Some(index) => orbits.get(index).copied(),
        None => full.attracting_orbit(),
    };
    let chosen = chosen.ok_or_else(|| match orbit {
        Some(index) => refused(format!("there is no orbit {index}; the case has {}", orbits.len())),
        None => refused(
            "no orbit with two impacts per period attracts; choose one of orbits() with orbit=...",
        ),
    })?;
    let settings = Settings { most_points, ..Settings::within(range.map(|edge| edge / unit)) };
    let along =
        |direction| follow(&system, chosen, parameter, direction, &settings).map_err(refused);
    let down = along(BranchDirection::Down)?;
    let closed = matches!(down.end, BranchEnd::Closed { .. });
    let up = (!closed).then(|| along(BranchDirection::Up)).transpose()?;
    let told = |value: f64, orbit: &Orbit| {
        let there = parameter.applied(&system, value).map_err(refused)?;
        let map = ImpactMap::of(&there).map_err(refused)?;
        // Lengths of an orbit are over the clearance at its own value.
        let length = parameter.unit(value) * scales.clearance;
        let peak = length * Peaks::of(&map, &orbit.cycle).displacement;
        Ok::<_, PyErr>(BranchRow { value: unit * value, peak, orbit: orbit.clone() })
    };
    let (mut points, mut specials) = (Vec::new(), Vec::new());
    let parts = [Some((&down, true)), up.as_ref().map(|up| (up, false))];
    for (branch, reversed) in parts.into_iter().flatten() {
        let mut some: Vec<BranchRow> = Vec::new();
        for point in branch.points.iter().skip(usize::from(!reversed)) {
            some.push(told(point.value, &point.orbit)?);
        }
        let mut marks = Vec::new();
        for one in &branch.specials {
            let at = told(one.value, &one.orbit)?;
            marks.push(json!({
                "kind": one.kind,
                "value": at.value,
                "peak": at.peak,
                "bracket": one.bracket.map(|edge| unit * edge),
                "converged": one.converged,
                "sequence": one.orbit.cycle.sequence(),
            }));
        }
        if reversed {
            some.reverse();
            marks.reverse();
        }
        points.extend(some);
        specials.extend(marks);
    }
    let end = |branch: &Branch| {
        let mut end = json!(branch.end);
        if let Some(value) = end["value"].as_f64() {
            end["value"] = json!(unit * value);
        }
        end
    };
    let ends: Vec<Value> = [Some(&down), up.as_ref()].into_iter().flatten().map(end).collect();
    Ok(Followed { points, told: json!({ "bifurcations": specials, "ends": ends }) })
}

impl Followed {
    /// A value of each point in a column.
    pub fn columns<'py>(&self, py: Python<'py>) -> PyResult<Columns<'py>> {
        let dict = PyDict::new(py);
        let numbers = |of: fn(&BranchRow) -> f64| {
            self.points.iter().map(of).collect::<Vec<_>>().into_pyarray(py)
        };
        let flags = |of: fn(&BranchRow) -> bool| {
            self.points.iter().map(of).collect::<Vec<_>>().into_pyarray(py)
        };
        dict.set_item("value", numbers(|one| one.value))?;
        dict.set_item("peak", numbers(|one| one.peak))?;
        dict.set_item("stable", flags(|one| one.orbit.attracts()))?;
        dict.set_item("admissible", flags(|one| one.orbit.admissibility.admissible))?;
        dict.set_item("radius_per_period", numbers(|one| one.orbit.radius_per_period()))?;
        let each = self.points.iter().flat_map(|one| one.orbit.multipliers.values);
        let all: Vec<Complex64> = each.map(|[re, im]| Complex64::new(re, im)).collect();
        let table: Bound<'py, PyArray2<Complex64>> =
            all.into_pyarray(py).reshape([self.points.len(), 4])?;
        dict.set_item("multipliers", table)?;
        Ok(dict)
    }
}
