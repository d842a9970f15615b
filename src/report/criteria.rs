//! What `vinesink check` prints: for a terminal, a pull request, programs and build servers.

use serde_json::{Value, json};

use super::document::criteria::{criteria, place, sample};
use super::document::{self, Scale, motions, place::FilePlace};
use super::error::RenderError;
use super::template::render;
use crate::answer::Answer;
use crate::case::Case;
use crate::criteria::{Judged, all_hold};
use crate::measure::Device;
use crate::motions::Motions;
use crate::quantity::{Quantity, Units};

/// What became of one case of several.
#[derive(Debug, Clone, PartialEq)]
pub struct Checked {
    /// As `vinesink/check@3` has it: judged with `criteria`, or not checked with `error` and `problems`.
    pub document: Value,
    /// The facts of the templates.
    page: Value,
    units: Units,
}

impl Checked {
    /// A case, by its file's path and stem, whose criteria were judged.
    pub fn judged(path: &str, name: &str, case: &Case, answer: &Answer) -> Self {
        let (scale, units) = (Scale::of(case), case.units());
        let judged = answer.judged.as_slice();
        let (counts, survey) = (case.count_inactive, answer.survey.as_ref());
        let survey = survey.filter(|survey| !survey.band().is_point());
        let outside = survey.filter(|survey| !survey.band().holds_own());
        let outside = outside.map(|survey| document::outside(&scale, survey.band()));
        let warnings: Vec<FilePlace> = case.warnings().iter().map(FilePlace::from).collect();
        let mut document = json!({
            "case": name,
            "title": case.title,
            "holds": all_hold(judged),
            "count_inactive": case.count_inactive,
            "criteria": judged.iter().map(|one| row(&units, one, place(case, one))).collect::<Vec<_>>(),
            // At the case's own excitation, and at the places of its band that were looked at.
            "motions": answer.motions.as_ref().map(|found| motions::listed(&scale, found, counts)),
            "places": survey.map(|survey| motions::places(&scale, &survey.motions, counts)),
            // Whether the case's own excitation is one of its band, which criteria are about.
            "own_in_band": survey.map(|_| outside.is_none()),
        });
        if !warnings.is_empty() {
            document["warnings"] = json!(warnings);
        }
        document::decide(&mut document, case, answer);
        let choice = document.as_object_mut().and_then(|of| of.remove("choice"));
        let ranges = document.as_object_mut().and_then(|of| of.remove("ranges"));
        let page = json!({
            "path": path, "case": name, "warnings": warnings, "criteria": criteria(case, judged),
            "outside": outside, "choice": choice, "alternatives": document["alternatives"], "ranges": ranges,
            "combined": document["combined"],
            "reliability": document["reliability"],
        });
        Self { document, page, units }
    }

    /// A case that was judged, by its document, the facts of its templates and the units of its page.
    pub(super) const fn of(document: Value, page: Value, units: Units) -> Self {
        Self { document, page, units }
    }

    /// A case that could not be read, or not be judged: why in a sentence, and where its file is wrong, in the
    /// order of its lines.
    pub fn failed(path: &str, name: &str, error: &str, problems: &[FilePlace]) -> Self {
        let document = json!({ "case": name, "error": error, "problems": problems });
        let mut page = document.clone();
        page["path"] = json!(path);
        Self { document, page, units: Units::reduced() }
    }

    /// Whether all criteria hold.
    pub fn holds(&self) -> bool {
        self.document["holds"] == true
    }

    /// Tests, failures and errors as JUnit counts them.
    fn counts(&self) -> [u64; 3] {
        let count = |key: &str| self.page["criteria"][key].as_u64().unwrap_or(0);
        if self.page["error"].is_string() {
            [1, 0, 1]
        } else {
            [count("count"), count("count") - count("holding"), 0]
        }
    }

    /// A table for a terminal.
    ///
    /// # Errors
    /// [`RenderError::Template`] if the template does not fit.
    pub fn text(&self) -> Result<String, RenderError> {
        render("check.txt", &self.units, &self.page)
    }

    /// GitHub-flavoured Markdown.
    ///
    /// # Errors
    /// As [`Checked::text`].
    pub fn markdown(&self) -> Result<String, RenderError> {
        render("check.md", &self.units, &self.page)
    }

    /// Annotations of a GitHub workflow: an error for each criterion that does not hold and for each place at
    /// which the case is wrong, a warning for each criterion that is too close to its limit.
    ///
    /// # Errors
    /// As [`Checked::text`].
    pub fn annotations(&self) -> Result<String, RenderError> {
        render("check.github", &self.units, &self.page)
    }
}

/// The criteria of a case that were judged, in Markdown, under a name: nothing of what else could be done or how far they hold.
///
/// # Errors
/// As [`Checked::text`].
pub fn table(name: &str, case: &Case, judged: &[Judged]) -> Result<String, RenderError> {
    let page = json!({ "case": name, "criteria": criteria(case, judged) });
    render("check.md", &case.units(), &page)
}

/// A JUnit report: a suite for each case, a test for each criterion; one that is an error for a case that
/// could not be checked.
///
/// # Errors
/// As [`Checked::text`].
pub fn junit(cases: &[Checked]) -> Result<String, RenderError> {
    let all = cases
        .iter()
        .map(Checked::counts)
        .fold([0; 3], |[a, b, c], [d, e, f]| [a + d, b + e, c + f]);
    let attributes = |[tests, failures, errors]: [u64; 3]| {
        format!("tests=\"{tests}\" failures=\"{failures}\" errors=\"{errors}\"")
    };
    let suites = cases.iter().map(|one| {
        let mut page = one.page.clone();
        page["counts"] = json!(attributes(one.counts()));
        render("check.xml", &one.units, &page)
    });
    let suites = suites.collect::<Result<String, _>>()?;
    let counts = attributes(all);
    Ok(format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"vinesink check\" {counts}>\n{suites}</testsuites>\n"
    ))
}

/// A criterion in SI, or in the units of a reduced case: 1 and 0 for true and false, null where nothing could be
/// measured; where in the band it is worst as a text, empty where that says nothing, and as a number.
pub(super) fn row(units: &Units, judged: &Judged, at: Option<Quantity>) -> Value {
    let kind = judged.criterion.measure.kind(Device::Absorber);
    let unit = at.map(|at| at.kind.dimension.symbol(units.physical));
    let mut row = json!({
        "name": judged.criterion.key,
        "asked": judged.criterion.as_written,
        "found": judged.found,
        "unit": kind.map_or("1", |kind| kind.dimension.symbol(units.physical)),
        "error": judged.found.map(|_| judged.error),
        "margin": judged.margin,
        "holds": judged.holds,
        // Whether the error could turn that.
        "near_limit": judged.near_limit,
        "decided_by": judged.decided_by,
        "at": at.map(|at| units.text(at.kind, at.value)).unwrap_or_default(),
        "at_value": at.map(|at| at.value),
        "at_unit": unit,
        // The motion that decides, in the list of its place; none where none does.
        "motion": judged.motion.map(Motions::id),
        // False while a motion that could decide otherwise still settles.
        "decided": judged.undecided.is_none(),
    });
    if let Some(contact) = judged.contact {
        row["contact"] = json!({ "found": contact.found, "crosses": contact.crosses });
    }
    if let Some(of) = judged.sample {
        row["sample"] = sample(of);
    }
    // Share of the absorber's resting places from which a start from rest never wakes it.
    if let Some(share) = judged.inactive {
        row["inactive_share"] = json!(share);
    }
    row
}
