//! The case file as a JSON Schema (draft 2020-12), so that editors complete and check a case.
//!
//! The structs below are never built: they describe to editors what `physical.rs`, `reduced.rs`
//! and the optional tables read. A test keeps the two in agreement.
#![expect(dead_code, reason = "the fields exist for the schema derived from them")]

use std::borrow::Cow;

use schemars::generate::SchemaSettings;
use schemars::transform::{Transform, transform_subschemas};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Value, json};

use super::accuracy::AccuracyTable;
use super::band::BandTable;
use super::criteria::CriteriaTable;
use super::optimize::OptimizeTable;
use super::quantity::{
    Damping, Dimension, Force, Frequency, Length, Mass, Quantity, Share, Stiffness,
};
use super::report::ReportTable;
use super::simulation::SimulationTable;
use super::sweep::SweepTable;
use super::uncertainty::UncertaintyTable;

/// The name under which a case's first line refers to its schema.
pub const FILE_NAME: &str = "vinesink.schema.json";

/// The JSON Schema of a case file.
pub fn schema() -> Value {
    let settings = SchemaSettings::draft2020_12()
        .with(|settings| settings.inline_subschemas = true)
        .with_transform(WithoutNull);
    settings.into_generator().into_root_schema_for::<CaseFile>().to_value()
}

/// A design of a vibro-impact nonlinear energy sink: either the tables oscillator, absorber and
/// excitation, or the table reduced.
#[derive(JsonSchema)]
#[schemars(title = "vinesink case", deny_unknown_fields, extend("oneOf" = one_design()))]
struct CaseFile {
    /// What this case is, in a line.
    #[schemars(pattern(r"\S"), example = "Li 2016, 8 Hz, b = 7.5 mm")]
    title: String,
    /// Where the numbers come from: a publication, a measurement, a guess.
    #[schemars(pattern(r"\S"), example = "Li, Seguy, Berlioz 2016, Table 1")]
    source: String,
    oscillator: Option<OscillatorTable>,
    absorber: Option<AbsorberTable>,
    excitation: Option<ExcitationTable>,
    reduced: Option<ReducedTable>,
    simulation: Option<SimulationTable>,
    report: Option<ReportTable>,
    accuracy: Option<AccuracyTable>,
    band: Option<BandTable>,
    criteria: Option<CriteriaTable>,
    optimize: Option<OptimizeTable>,
    uncertainty: Option<UncertaintyTable>,
    sweep: Option<SweepTable>,
}

/// The linear oscillator whose vibration is to be reduced.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields, extend("allOf" = stiffness_and_damping()))]
struct OscillatorTable {
    /// m1, the oscillator's mass, above 0.
    mass: Quantity<Mass>,
    /// k1, the stiffness between base and oscillator, above 0; or give frequency.
    stiffness: Option<Quantity<Stiffness>>,
    /// f0 = sqrt(k1 / m1) / (2 pi), the natural frequency, above 0; or give stiffness.
    #[schemars(extend("examples" = ["8.35 Hz"]))]
    frequency: Option<Quantity<Frequency>>,
    /// c1, the viscous damping between base and oscillator, 0 or more; or give damping_ratio.
    damping: Option<Quantity<Damping>>,
    /// c1 / (2 sqrt(k1 m1)), 0 or more; or give damping.
    #[schemars(extend("anyOf" = ratio(json!({ "minimum": 0.0 }))), example = 0.0069, example = "0.69 %")]
    damping_ratio: Option<Value>,
}

/// The small mass that moves freely between two walls of the oscillator.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = one_of("mass", "mass_ratio")))]
struct AbsorberTable {
    /// m2, the absorber's mass, above 0; or give mass_ratio.
    mass: Option<Quantity<Mass>>,
    /// m2 / m1, above 0; or give mass.
    #[schemars(extend("anyOf" = ratio(json!({ "exclusiveMinimum": 0 }))), example = 0.0077, example = "0.77 %")]
    mass_ratio: Option<Value>,
    /// b, the free distance from the middle to either wall, above 0.
    clearance: Quantity<Length>,
    /// r, the coefficient of restitution: 1 loses no energy at an impact, 0 does not rebound.
    #[schemars(range(min = 0.0, max = 1.0), example = 0.6)]
    restitution: f64,
}

/// What drives the oscillator harmonically.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = amplitude_by_kind()))]
struct ExcitationTable {
    kind: Kind,
    /// F, the displacement amplitude of the base, or P, the amplitude of the force; 0 or more.
    amplitude: String,
    /// f, the excitation frequency, above 0.
    frequency: Quantity<Frequency>,
}

/// base-displacement: the base moves; force: a force acts on the oscillator's mass.
#[derive(JsonSchema)]
#[schemars(rename_all = "kebab-case")]
enum Kind {
    BaseDisplacement,
    Force,
}

/// A dimensionless design, lengths in a unit of its own.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields, extend("oneOf" = one_of("frequency_ratio", "detuning")))]
struct ReducedTable {
    /// epsilon = m2 / m1, above 0.
    #[schemars(extend("exclusiveMinimum" = 0), example = 0.0076775)]
    mass_ratio: f64,
    /// lambda = c1 / (m2 omega0), 0 or more.
    #[schemars(range(min = 0.0), example = 1.799)]
    damping: f64,
    /// r, the coefficient of restitution, from 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0), example = 0.6)]
    restitution: f64,
    /// b, the clearance, above 0.
    #[schemars(extend("exclusiveMinimum" = 0), example = 1.0)]
    clearance: f64,
    /// G = F / epsilon, the reduced forcing in the unit of the clearance, 0 or more.
    #[schemars(range(min = 0.0), example = 4.342)]
    forcing: f64,
    /// Omega = omega / omega0, above 0; or give detuning.
    #[schemars(extend("exclusiveMinimum" = 0), example = 0.95818)]
    frequency_ratio: Option<f64>,
    /// sigma, where Omega = 1 + epsilon sigma; or give frequency_ratio.
    #[schemars(example = -5.446)]
    detuning: Option<f64>,
    /// Where the excitation enters; base-displacement unless given.
    kind: Option<Kind>,
}

fn one_of(first: &str, second: &str) -> Value {
    json!([{ "required": [first] }, { "required": [second] }])
}

fn stiffness_and_damping() -> Value {
    json!([
        { "oneOf": one_of("stiffness", "frequency") },
        { "oneOf": one_of("damping", "damping_ratio") },
    ])
}

/// A plain number within `bound`, or a share.
fn ratio(bound: Value) -> Value {
    let mut number = bound;
    number["type"] = "number".into();
    json!([number, { "type": "string", "pattern": pattern::<Share>() }])
}

fn one_design() -> Value {
    let physical = ["oscillator", "absorber", "excitation"];
    let any_physical = physical.map(|table| json!({ "required": [table] }));
    json!([
        { "required": physical, "not": { "required": ["reduced"] } },
        { "required": ["reduced"], "not": { "anyOf": any_physical } },
    ])
}

fn amplitude_by_kind() -> Value {
    let case = |kind: &str, pattern: String, example: &str| {
        let amplitude = json!({ "pattern": pattern, "examples": [example] });
        json!({ "properties": { "kind": { "const": kind }, "amplitude": amplitude } })
    };
    json!([
        case("base-displacement", pattern::<Length>(), "0.25 mm"),
        case("force", pattern::<Force>(), "2.9 N"),
    ])
}

impl<D: Dimension> JsonSchema for Quantity<D> {
    fn schema_name() -> Cow<'static, str> {
        D::NAME.into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string", "pattern": pattern::<D>(), "examples": [D::EXAMPLE] })
    }
}

/// A regular expression for what [`Quantity::parse`] accepts, except that no sign is: no quantity
/// of a case may be negative.
fn pattern<D: Dimension>() -> String {
    let units: Vec<String> = D::UNITS.iter().map(|unit| unit_pattern(unit.symbol)).collect();
    let number = r"\+?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?";
    format!(r"^\s*{number}\s*({})\s*$", units.join("|"))
}

fn unit_pattern(symbol: &str) -> String {
    let product = symbol.replace(' ', r"(\s+|\s*[*·⋅]\s*)").replace('/', r"\s*/\s*");
    match product.strip_prefix('u') {
        Some(rest) => format!("[uµμ]{rest}"),
        None => product.replace("/\\s*um", r"/\s*[uµμ]m"),
    }
}

/// Removes `null` from types: TOML has none, a key that is not given is left out.
#[derive(Debug, Clone)]
struct WithoutNull;

impl Transform for WithoutNull {
    fn transform(&mut self, schema: &mut Schema) {
        if let Some(Value::Array(types)) = schema.get_mut("type") {
            types.retain(|name| name != "null");
            if let [only] = types.as_slice() {
                let only = only.clone();
                schema.insert("type".to_owned(), only);
            }
        }
        if let Some(Value::Array(values)) = schema.get_mut("enum") {
            values.retain(|value| !value.is_null());
        }
        unwrap_alternative_to_null(schema);
        transform_subschemas(self, schema);
    }
}

/// `anyOf: [X, null]` becomes `X`.
fn unwrap_alternative_to_null(schema: &mut Schema) {
    let Some(Value::Array(mut alternatives)) = schema.remove("anyOf") else { return };
    let before = alternatives.len();
    alternatives.retain(|alternative| alternative["type"] != "null");
    match alternatives.as_slice() {
        [Value::Object(only)] if before == 2 => {
            let object = schema.ensure_object();
            only.iter().for_each(|(key, value)| {
                object.entry(key.clone()).or_insert_with(|| value.clone());
            });
        }
        _ => {
            schema.insert("anyOf".to_owned(), alternatives.into());
        }
    }
}
