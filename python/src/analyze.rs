//! What theory and exact orbits say of a case.

use pyo3::PyResult;
use serde_json::Value;
use vinesink::answer::{Answer, Asked};
use vinesink::case::Case;
use vinesink::case_input::AnyCase;
use vinesink::modal::orbits;
use vinesink::report::console::Analysed;
use vinesink::report::document::Content;
use vinesink::report::modal::analysis;
use vinesink::report::transient;
use vinesink::study::fidelity::LayerPlan;

use crate::errors::refused;
use crate::work::WorkState;

/// The document of `vinesink analyze`.
pub fn analysed(case: &AnyCase, stem: &str, work: &WorkState) -> PyResult<Value> {
    let case = match case {
        AnyCase::One(case) => case,
        AnyCase::Several(case) => {
            return Ok(analysis(case, &orbits(case, work).map_err(refused)?));
        }
    };
    let plan = LayerPlan::of_case(case, None).map_err(refused)?;
    let answer = Answer::of(case, Asked::Analysis, plan.as_ref(), work).map_err(refused)?;
    if let Some(document) = unsteady(case, stem, &answer, Content::Analysis) {
        return Ok(document);
    }
    let none = || refused("the case was not analysed");
    Ok(Analysed::of(case, &answer).ok_or_else(none)?.document())
}

/// What becomes of a structure that is not driven steadily; none of another.
pub fn unsteady(case: &Case, stem: &str, answer: &Answer, content: Content) -> Option<Value> {
    Some(transient::document(stem, case, answer.transient.as_ref()?, &[], content))
}
