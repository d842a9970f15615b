//! What `simulate` says of one flight of a structure that is not driven steadily.

use serde_json::{Value, json};

use crate::case::Case;
use crate::method::Method;
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::report::document::{Content, Scale, answer};
use crate::report::render::RenderError;
use crate::report::template::render;
use crate::transient::OneFlight;

/// What was found.
pub fn flight(case: &Case, flight: &OneFlight) -> Value {
    let scale = Scale::of(case);
    let simulated = Method::Simulation;
    let start = &flight.start;
    let place = start.relative_displacement();
    let fields = json!({
        "start": [start.x, start.x_velocity, start.y, start.y_velocity],
        "absorber": scale.units.quantity(&of::RELATIVE_DISPLACEMENT, place, Method::Given),
        "duration": scale.units.quantity(&of::TIME, flight.duration, simulated),
        "peak": scale.units.quantity(&of::PEAK, flight.peak, simulated),
        "impacts": Quantity::new(&of::IMPACT_COUNT, flight.impacts as f64, simulated),
        "impact_speed": scale.units.quantity(&of::IMPACT_SPEED, flight.impact_speed, simulated),
        "decay_time": flight.settles.map(|time| scale.units.quantity(&of::DECAY_TIME, time, simulated)),
        "share": case.decay_level,
    });
    answer(case, Content::Flight, fields)
}

/// Its sentences.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn flight_text(case: &Case, document: &Value) -> Result<String, RenderError> {
    render("flight.txt", &case.units(), document)
}
