//! The tables `[reduced]`, `[[reduced.mode]]` and `[[reduced.absorber]]`: lengths and masses in a unit of their own, time `omega_1 t`.

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;

use super::load::read_range;
use super::mode::{Shape, read_shape};
use super::{ActsOn, Load, StructuralMode};
use crate::case::reader::{Reader, Table};
use crate::case::schema::one_of;
use crate::system::LARGEST_DAMPING_RATIO;

/// A dimensionless design of several modes or absorbers; every force acts at once, in the modes.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = one_of("frequency_ratio", "from")))]
pub(super) struct ModalReducedTable {
    /// What drives it: forces in the modes, whose `forcing` says them. May be left out.
    #[schemars(example = &"force")]
    #[expect(dead_code, reason = "there is one")]
    kind: Option<ReducedKind>,
    /// Omega, the excitation's frequency over that of the first mode, above 0; or give a range, `from` and `to`.
    #[schemars(extend("exclusiveMinimum" = 0), example = 6.27)]
    frequency_ratio: Option<f64>,
    /// Where its range begins, above 0.
    #[schemars(extend("exclusiveMinimum" = 0), example = 5.3)]
    from: Option<f64>,
    /// Where it ends, above `from`.
    #[schemars(extend("exclusiveMinimum" = 0), example = 6.9)]
    to: Option<f64>,
    /// The modes.
    #[schemars(with = "Vec<ReducedModeTable>")]
    #[expect(dead_code, reason = "read one by one")]
    #[serde(default)]
    mode: (),
    /// The absorbers.
    #[schemars(with = "Vec<ReducedAbsorberTable>")]
    #[expect(dead_code, reason = "read one by one")]
    #[serde(default)]
    absorber: (),
}

/// What drives a reduced structure of several modes.
#[derive(Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum ReducedKind {
    /// Forces in the modes.
    Force,
}

/// A mode, over the first one.
#[derive(Deserialize, JsonSchema)]
#[schemars(extend("additionalProperties" = false))]
pub(super) struct ReducedModeTable {
    /// omega_k / omega_1, its natural frequency over that of the first mode, whose own is 1.
    #[schemars(extend("exclusiveMinimum" = 0), example = 1.0)]
    frequency_ratio: f64,
    /// zeta_k, its damping ratio, from 0 to 0.85.
    #[schemars(extend("x-measurand" = "a share", "minimum" = 0, "maximum" = LARGEST_DAMPING_RATIO), example = 0.005, example = "0.5 %")]
    damping_ratio: f64,
    /// M_k, its modal mass by the scale of the shape, above 0; all masses are in one unit.
    #[schemars(extend("exclusiveMinimum" = 0), example = 1.0)]
    mass: f64,
    /// f_k, the amplitude of the force in the mode over M_k omega_1^2, in the unit of lengths.
    #[schemars(example = 0.01)]
    forcing: f64,
    /// phi_k, its shape: the displacement at each place where the modal coordinate is 1.
    #[schemars(with = "Value", extend("type" = "object", "additionalProperties" = { "type": "number" }))]
    #[expect(dead_code, reason = "read by its own names")]
    #[serde(default)]
    shape: (),
}

/// An absorber, in plain numbers.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "read into the table with units")]
pub(super) struct ReducedAbsorberTable {
    /// Where it is: a place of the shapes. May be left out where they have one.
    #[schemars(example = &"tip")]
    place: Option<String>,
    /// m_j, its mass in the unit of the modal masses, above 0.
    #[schemars(extend("exclusiveMinimum" = 0), example = 0.05)]
    mass: f64,
    /// b_j, the clearance to either wall, above 0.
    #[schemars(extend("exclusiveMinimum" = 0), example = 1.0)]
    clearance: f64,
    /// r_j, the coefficient of restitution, from 0 to 1.
    #[schemars(range(min = 0, max = 1), example = 0.6)]
    restitution: f64,
}

/// A mode and its shape; its forcing is as it is written.
pub(super) fn read_reduced_mode(
    reader: &mut Reader,
    table: &Table,
) -> Option<(StructuralMode, Shape)> {
    let read = reader.read::<ReducedModeTable>(table);
    let shape = read_shape(reader, table)?;
    let read = read?;
    let mode = StructuralMode {
        frequency_hz: read.frequency_ratio,
        damping_ratio: read.damping_ratio,
        mass_kg: read.mass,
        shape: Vec::new(),
        participation: 0.0,
        forcing: read.forcing,
    };
    Some((mode, shape))
}

/// What drives it: its amplitude is the largest force over modal mass, and each mode then has its part of that.
pub(super) fn read_reduced_load(
    reader: &mut Reader,
    table: &Table,
    modes: &mut [StructuralMode],
) -> Option<Load> {
    let first = modes.first().map_or(1.0, |mode| mode.frequency_hz);
    if first != 1.0 {
        reader.report(
            table.span.clone(),
            format!("the first mode's `frequency_ratio` is {first}, and it is over its own"),
            "expected 1 for the first mode",
            "write frequency_ratio = 1, and those of the others over the first natural frequency",
        );
        return None;
    }
    let read = reader.read::<ModalReducedTable>(table)?;
    let range_hz =
        read_range(reader, table, "frequency_ratio", [read.frequency_ratio, read.from, read.to])?;
    let amplitude = modes.iter().map(|mode| mode.forcing.abs()).fold(0.0, f64::max);
    if amplitude == 0.0 && !modes.is_empty() {
        let message = "nothing drives the structure: every `forcing` is 0";
        let expected = "expected a `forcing` other than 0";
        reader.report(table.span.clone(), message, expected, "write forcing = 0.01 in a mode");
        return None;
    }
    modes.iter_mut().for_each(|mode| mode.forcing /= amplitude);
    Some(Load { on: ActsOn::Modes, amplitude, range_hz })
}
