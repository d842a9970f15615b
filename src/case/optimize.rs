//! The optional table `[optimize]`.

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;

use super::criteria::{AREAS_ARE_IDEAL, Criterion, EXACT_INSTEAD};
use super::reader::{Reader, Table};
use super::schema::in_design;
use crate::excitation::Scene;
use crate::measure::Measure;
use vinesink_core::names;

names! { name:
    /// What a design is chosen for, over the case's band if it has one.
    #[derive(schemars::JsonSchema)]
    pub enum Objective {
        /// The largest share of the band in area Z3 of the theory.
        Z3Share = "z3-share",
        /// The largest share of the band with a stable symmetric 1:1 orbit.
        StableShare = "stable-share",
        /// The smallest worst amplitude over the band.
        WorstAmplitude = "worst-amplitude",
        /// The largest smallest relative distance of the clearance from the ends of the stable 1:1 motion.
        Margin = "margin",
    }
}

impl Objective {
    /// What criteria ask for first; else the smallest vibration.
    pub fn asked(criteria: &[Criterion]) -> Self {
        match criteria.first().map(|one| one.measure) {
            Some(Measure::Z3Share) => Self::Z3Share,
            Some(Measure::StableShare) => Self::StableShare,
            Some(Measure::MarginClearance) => Self::Margin,
            _ => Self::WorstAmplitude,
        }
    }
}

/// What `vinesink optimize` looks for, and within which bounds, which ascend. The table may be left out.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct OptimizeSettings {
    /// What is looked for; what the first criterion asks unless given, or else the smallest worst amplitude. Not for a
    /// structure that is not driven steadily: released or struck it shall come to rest first, swept or driven by a record it shall have the
    /// smallest largest displacement.
    pub objective: Option<Objective>,
    /// Bounds of the clearance; 0.025 to 1.5 times the largest at which 1:1 resonance ends by theory along the band unless
    /// given, or a fifth to five times the case's own where the theory has none. Plain numbers beside [reduced].
    #[schemars(with = "Option<[Value; 2]>", extend("x-plain" = [[0.5, 2.0]], "x-ascending" = true))]
    #[schemars(extend("items" = in_design("clearance")), example = vec!["5 mm", "40 mm"])]
    pub clearance: Option<[f64; 2]>,
    /// Releases that the clearance must serve, over the case's own: from a weaker to a stronger one; the case's own
    /// alone unless given. For a structure that is released or struck alone.
    #[schemars(extend("items" = { "type": "number", "exclusiveMinimum": 0 }, "x-ascending" = true))]
    #[schemars(example = vec![0.5, 2.0])]
    pub releases: Option<[f64; 2]>,
    /// Bounds of the restitution, from 0 to 1; the case's own value unless given.
    #[schemars(extend("items" = { "type": "number", "minimum": 0, "maximum": 1 }, "x-ascending" = true))]
    #[schemars(example = vec![0.4, 0.8])]
    pub restitution: Option<[f64; 2]>,
    /// Bounds of the absorber's mass; the case's own unless given. Not beside [reduced].
    #[schemars(with = "Option<[Value; 2]>", extend("x-ascending" = true))]
    #[schemars(extend("items" = { "type": "number", "x-measurand": "a mass", "exclusiveMinimum": 0 }))]
    #[schemars(example = vec!["20 g", "50 g"])]
    pub mass: Option<[f64; 2]>,
}

/// Reads the table, which may be missing.
pub(super) fn read(reader: &mut Reader, root: &Table) -> OptimizeSettings {
    let read = reader.optional::<OptimizeSettings>(root, "optimize");
    let Some((table, settings)) = read else { return OptimizeSettings::default() };
    if reader.design.is_some_and(|design| !design.is_physical()) && table.has("mass") {
        reader.report(
            table.span_of("mass"),
            "a reduced case has no mass to choose",
            "expected `mass` beside [oscillator], [absorber] and [excitation] only",
            "remove the line, or describe the design in physical units",
        );
    }
    let ideal = reader.design.is_none_or(|design| design.has_ideal_cavity());
    if !ideal && settings.objective == Some(Objective::Z3Share) {
        let help = "ask for `objective = \"stable-share\"`, or leave it out";
        reader.report(table.span_of("objective"), AREAS_ARE_IDEAL, EXACT_INSTEAD, help);
    }
    let scene = reader.design.map_or(Scene::Steady, |design| design.scene());
    let other: &[&str] = match scene {
        Scene::Steady => &["releases"],
        Scene::Release => &["objective", "restitution", "mass"],
        Scene::Sweep | Scene::Record => &["objective", "restitution", "mass", "releases"],
    };
    for key in other.iter().filter(|key| table.has(key)) {
        let words = scene.words();
        let message =
            format!("`{key}` has no meaning in [optimize] for a structure that is {words}");
        let help = "where nothing drives a structure steadily the clearance alone is chosen: that with which it comes to rest first where it is released, else the one with the smallest largest displacement";
        reader.report(table.span_of(key), message, "expected other keys", help);
    }
    settings
}
