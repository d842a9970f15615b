//! What `vinesink new` says of the absorber that it proposes.

use serde_json::{Value, json};

use super::document::criteria::criteria;
use super::document::{Scale, decide, edges};
use super::render::RenderError;
use super::template::render;
use crate::method::Method;
use crate::proposal::{MASS_RATIOS, Proposal, Why};
use crate::quantity::Quantity;
use crate::quantity::catalogue as of;
use crate::system::Parameter;

/// Its sentences; `file` is the case that was written, as a command takes it.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn text(proposal: &Proposal, file: &str) -> Result<String, RenderError> {
    let Proposal {
        case, answer, why, ruled_out, given_restitution, guessed, edges: beside, ..
    } = proposal;
    let (design, scale) = (&case.design, Scale::of(case));
    let given = |kind, value| Quantity::new(kind, value, Method::Given);
    let number =
        |parameter| design.value(parameter).map(|value| given(case.design.kind(parameter), value));
    let share = |share| given(&of::MASS_RATIO, share);
    let frequency = |ratio| scale.frequency(ratio, Method::Given);
    let mut document = json!({
        "file": file,
        "why": match why {
            Why::Given => "given",
            Why::Usual => "usual",
            Why::Smallest => "smallest",
            Why::Closest => "closest",
        },
        "by_closed_form": ruled_out[0].iter().map(|one| share(*one)).collect::<Vec<_>>(),
        "by_check": ruled_out[1].iter().map(|one| share(*one)).collect::<Vec<_>>(),
        "proposed": MASS_RATIOS.map(share),
        "most": MASS_RATIOS.last().map(|most| share(*most)),
        "mass_ratio": share(case.system().mass_ratio()),
        "mass": number(Parameter::AbsorberMass),
        "restitution": number(Parameter::Restitution),
        "given_restitution": given_restitution,
        "clearance": number(Parameter::Clearance),
        "guessed": given(&of::CLEARANCE, *guessed),
        "release": design.release().is_some(),
        "share": case.decay_level,
        "band": case.band.as_ref().map(|band| band.range.map(frequency)),
        "criteria": criteria(case, &answer.judged),
        "edges": edges(case, beside),
    });
    decide(&mut document, case, answer);
    let alone = document["alternatives"].as_array().and_then(|rows| {
        rows.iter().find(|row| row["which"] == "no-absorber" && row["drift"] == 0.0).cloned()
    });
    let alone = alone.map_or(Value::Null, |row| row["worst"].clone());
    let limit = case.criteria.first().map(|one| one.limit);
    let holds = alone["value"].as_f64().zip(limit).is_some_and(|(alone, limit)| alone <= limit);
    document["alone"] = alone;
    // Whether the structure needs no absorber.
    document["alone_holds"] = json!(holds);
    render("proposal.txt", &case.units(), &document)
}
