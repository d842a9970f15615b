//! The table `[sweep]` of a structure of several modes: what its absorbers, or an excitation, are varied in.

use schemars::{JsonSchema, Schema};
use serde::Deserialize;
use serde_json::Value;

use super::load::{LoadKind, LoadTable};
use super::mode::ModeTable;
use super::number::is_of_absorber;
use super::read::ModalAbsorberTable;
use super::{ActsOn, Load, ModalCase};
use crate::case::number::Form;
use crate::case::reader::{Reader, Table};
use crate::case::schema::of_table;
use crate::case::sweep::{SweepSettings, axes_among, with_axes_of};
use crate::quantity::Kind;
use crate::system::Parameter;

/// What the case says about its sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalSweep {
    /// Axes in the order of the file, of which the last varies fastest; starts and periods at each frequency.
    pub settings: SweepSettings,
    /// The excitation that alone acts; none: each of the case's.
    pub load: Option<usize>,
    /// The absorber that the axes are of; none: all.
    pub absorber: Option<usize>,
}

/// What may be an axis.
const AXES: [Parameter; 5] = [
    Parameter::Frequency,
    Parameter::Amplitude,
    Parameter::Clearance,
    Parameter::Restitution,
    Parameter::AbsorberMass,
];

/// Which numbers `vinesink sweep` varies; each point has what the case has at it: with a frequency as an axis its motions there, else
/// the worst over the ranges of its excitations. Whatever is not an axis keeps the case's own number.
#[derive(Deserialize, JsonSchema)]
#[schemars(extend("additionalProperties" = false), transform = with_axes)]
pub(super) struct ModalSweepTable {
    /// The excitation that alone acts, from 1, in the order of the file. Each of them, one at a time, unless given.
    #[schemars(range(min = 1, max = 8), example = 1)]
    excitation: Option<u64>,
    /// The absorber that `clearance`, `restitution` and `absorber_mass` are of, from 1. All of them unless given.
    #[schemars(range(min = 1, max = 8), example = 1)]
    absorber: Option<u64>,
    /// Starts at each frequency, that from rest among them; as many as for the case itself unless given.
    #[schemars(range(min = 1, max = 1000), extend("x-symbol" = "N"), example = 4)]
    starts: Option<u32>,
    /// Excitation periods that a motion which does not repeat is measured for at least; as for the case itself unless given.
    #[schemars(range(min = 1, max = 100_000_000), extend("x-symbol" = "n"), example = 250)]
    periods: Option<u64>,
}

fn with_axes(schema: &mut Schema) {
    with_axes_of(schema, &AXES);
}

/// How the values of an axis, or errors, are written: as the case's own numbers are, an amplitude as that of such a load.
pub(in crate::case) fn form(parameter: Parameter, moves_base: bool) -> Option<Form> {
    let absorber = |key: &str| Some(&of_table::<ModalAbsorberTable>()["properties"][key]);
    let mode = |key: &str| Some(&of_table::<ModeTable>()["properties"][key]);
    let load = of_table::<LoadTable>();
    let kind = if moves_base { LoadKind::BaseDisplacement } else { LoadKind::Force };
    let schema: Option<&'static Value> = match parameter {
        Parameter::Frequency => Some(&load["properties"]["frequency"]),
        Parameter::Amplitude => {
            let mut kinds = load["oneOf"].as_array()?.iter().map(|one| &one["properties"]);
            kinds.find(|one| one["kind"]["const"] == kind.name()).map(|one| &one["amplitude"])
        }
        Parameter::AbsorberMass => absorber("mass"),
        Parameter::Mass => mode("mass"),
        Parameter::NaturalFrequency => mode("frequency"),
        Parameter::DampingRatio => mode("damping_ratio"),
        other => absorber(other.key()),
    };
    Form::of(schema?)
}

/// Reads the table of a case that is read but for it, which may be missing.
pub(super) fn read_sweep(
    reader: &mut Reader,
    root: &Table,
    case: &ModalCase,
) -> Option<ModalSweep> {
    let (table, read) = reader.optional::<ModalSweepTable>(root, "sweep")?;
    let mut numbered = |key: &'static str, number: Option<u64>, count: usize| {
        let Some(number) = number else { return Some(None) };
        if number as usize <= count {
            return Some(Some(number as usize - 1));
        }
        let message = format!("`{key}` is {number}, and there are {count}");
        let expected = format!("expected one of [[{key}]], from 1");
        reader.report(table.span_of_value(key), message, expected, "name another one");
        None
    };
    let load = numbered("excitation", read.excitation, case.loads.len());
    let absorber = numbered("absorber", read.absorber, case.absorbers.len());
    let (load, absorber) = (load?, absorber?);
    let of_load = AXES.into_iter().find(|one| !is_of_absorber(*one) && table.has(one.key()));
    if let (Some(axis), None, [_, _, ..]) = (of_load, load, &case.loads[..]) {
        let message = format!("`{}` is of one excitation, and there are several", axis.key());
        let help = "write excitation = 1 for the first one; it then acts alone";
        reader.report(table.span_of(axis.key()), message, "expected `excitation` beside it", help);
        return None;
    }
    let of_absorber = AXES.into_iter().any(|one| is_of_absorber(one) && table.has(one.key()));
    if absorber.is_some() && !of_absorber {
        let message = "`absorber` has no meaning where no number of an absorber varies";
        let expected = "expected `clearance`, `restitution` or `absorber_mass` beside it";
        reader.report(table.span_of("absorber"), message, expected, "remove the line `absorber`");
        return None;
    }
    let moves_base = |one: &Load| one.on == ActsOn::Base;
    reader.of_several = case.loads.get(load.unwrap_or(0)).map(moves_base);
    let axes = axes_among(reader, &table, &AXES)?;
    let starts = read.starts.unwrap_or(case.starts);
    let periods = read.periods.unwrap_or(case.periods);
    let settings = SweepSettings { axes, starts, periods, follow: false, record: Vec::new() };
    Some(ModalSweep { settings, load, absorber })
}

impl ModalCase {
    /// What an axis of its sweep is.
    pub fn kind(&self, parameter: Parameter) -> &'static Kind {
        self.kind_of(parameter, self.swept_load())
    }

    /// The load that alone acts in its sweep.
    fn swept_load(&self) -> Option<usize> {
        self.sweep.as_ref()?.load
    }

    /// The parts whose number an axis of its sweep is.
    fn swept(&self, parameter: Parameter) -> Vec<Option<usize>> {
        let absorber = self.sweep.as_ref().and_then(|sweep| sweep.absorber);
        let one = if is_of_absorber(parameter) { absorber } else { self.swept_load() };
        one.map_or_else(|| self.parts_of(parameter), |one| vec![Some(one)])
    }

    /// The case at a point of its sweep, by its place on each axis in SI units: with the load alone that the sweep names. The case
    /// itself without a sweep.
    pub fn at_point(&self, coordinates: &[f64]) -> Self {
        let Some(sweep) = &self.sweep else { return self.clone() };
        let SweepSettings { axes, starts, periods, .. } = &sweep.settings;
        let mut case =
            Self { starts: *starts, starts_at_one: *starts, periods: *periods, ..self.clone() };
        for (axis, value) in axes.iter().zip(coordinates) {
            for of in self.swept(axis.parameter) {
                case.set(axis.parameter, of, *value);
            }
        }
        if let Some(load) = sweep.load {
            case.loads = vec![case.loads[load]];
        }
        case
    }

    /// The case's own value of what an axis varies, where all that it varies have the same.
    pub fn own_value(&self, parameter: Parameter) -> Option<f64> {
        let all = self.swept(parameter);
        let mut all = all.into_iter().filter_map(|of| self.number(parameter, of));
        let first = all.next()?;
        all.all(|one| one == first).then_some(first)
    }
}
