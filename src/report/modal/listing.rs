//! The modes of a file, for people and for programs.

use serde_json::{Value, json};

use super::given;
use crate::case::ModesListing;
use crate::quantity::Units;
use crate::quantity::catalogue as of;
use crate::report::error::RenderError;
use crate::report::template::render;
use crate::system::Scales;

/// The document of `vinesink modes`: `vinesink/modes@1`, in SI units.
pub fn listing(name: &str, found: &ModesListing) -> Value {
    let mut document = json!(found);
    document["format"] = json!("vinesink/modes@1");
    document["file"] = json!(name);
    document
}

/// The same on a terminal.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn listing_text(name: &str, found: &ModesListing) -> Result<String, RenderError> {
    let rows = found.modes.iter().map(|one| {
        json!({
            "number": one.number,
            "line": one.line,
            "frequency": given(&of::NATURAL_FREQUENCY, one.frequency_hz),
            "damping_ratio": given(&of::DAMPING_RATIO, one.damping_ratio),
            "mass": given(&of::OSCILLATOR_MASS, one.mass_kg),
            "nodes": one.nodes,
        })
    });
    let mut page = listing(name, found);
    page["rows"] = rows.collect();
    page["at"] = json!(if found.of_nodes { "Nodes" } else { "Places" });
    let units = Units::from(Scales {
        physical: true,
        clearance: 1.0,
        natural_frequency: 1.0,
        oscillator_mass: 1.0,
    });
    Ok(render("modes.txt", &units, &page)? + "\n" + &found.table)
}
