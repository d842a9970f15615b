//! Figs. 4 and 11: which regime comes at which clearance.

use serde_json::{Value, json};

use super::{CaseSet, PaperError, PaperFigure, TRANSFER};
use vinesink::regimes::Regime;

/// The cases of Fig. 4 with the regime that the paper shows.
const FIGURE_4: [(&str, &str, Regime); 5] = [
    ("a", "li2016-8p5hz-fig4a", Regime::AboveTwo),
    ("b", "li2016-8p5hz-fig4b", Regime::TwoAsymmetric),
    ("c", "li2016-8p5hz-fig4c", Regime::TwoSymmetric),
    ("d", "li2016-8p5hz-fig4d", Regime::StronglyModulated),
    ("e", "li2016-8p5hz-fig4e", Regime::BelowTwo),
];

/// The cases of Fig. 11 with the regime that the experiment shows.
pub(super) const FIGURE_11: [(&str, &str, Regime); 6] = [
    ("a", "li2016-8hz-b0p3mm", Regime::AboveTwo),
    ("b", "li2016-8hz-b2p5mm", Regime::AboveTwo),
    ("c", "li2016-8hz-b4mm", Regime::TwoAsymmetric),
    ("d", "li2016-8hz-b7p5mm", Regime::TwoSymmetric),
    ("e", "li2016-8hz-b11p5mm", Regime::StronglyModulated),
    ("f", "li2016-8hz-b20mm", Regime::BelowTwo),
];

/// The panels of a figure: whether each regime is the paper's, and what was found.
type RegimePanels = (Vec<(&'static str, bool)>, Vec<Value>);

fn compared(
    cases: &CaseSet,
    panels: &[(&'static str, &'static str, Regime)],
) -> Result<RegimePanels, PaperError> {
    let (mut checks, mut told) = (Vec::new(), Vec::new());
    for (letter, name, expected) in panels {
        let member = cases.case(name)?;
        let (main, _) = member.main()?;
        checks.push((*letter, main.regime() == *expected));
        told.push(json!({
            "letter": letter,
            "expected": expected.key(),
            "found": main.regime().key(),
            "clearance": member.length(1.0),
            "impacts_per_period": member.impacts_per_period()?,
            "rms": member.length(main.facts().rms.value),
        }));
    }
    Ok((checks, told))
}

pub(super) fn figure_4(cases: &CaseSet) -> Result<PaperFigure, PaperError> {
    let (mut checks, panels) = compared(cases, &FIGURE_4)?;
    let [impacts, levels] = ["impacts_per_period", "rms"]
        .map(|key| panels.iter().filter_map(|one| one[key].as_f64()).collect::<Vec<f64>>());
    let lowest = (0..levels.len()).min_by(|a, b| levels[*a].total_cmp(&levels[*b])).unwrap_or(0);
    let valley = levels[..=lowest].windows(2).all(|pair| pair[1] < pair[0])
        && levels[lowest..].windows(2).all(|pair| pair[1] > pair[0]);
    checks.push(("impacts_fall", impacts.windows(2).all(|pair| pair[1] <= pair[0] + 1e-9)));
    checks.push(("valley", valley && (1..levels.len() - 1).contains(&lowest)));
    let member = cases.case(TRANSFER)?;
    let exact = member.study.exact.boundaries.as_ref().and_then(|found| found.asymmetric.as_ref());
    let places =
        exact.and_then(|at| Some([at.symmetry_breaking, at.period_doubling?, at.grazing?]));
    let [breaking, doubling, grazing] =
        member.needs(places, "asymmetric orbits")?.map(|at| member.length(at));
    let facts = json!({
        "panels": panels, "breaking": breaking, "doubling": doubling, "grazing": grazing,
    });
    Ok(PaperFigure::new(checks, facts))
}

pub(super) fn figure_11(cases: &CaseSet) -> Result<PaperFigure, PaperError> {
    let (mut checks, panels) = compared(cases, &FIGURE_11)?;
    let (smallest, _) = cases.case("li2016-8hz-b0p3mm")?.main()?;
    let three = cases.case("li2016-8hz-b2p5mm")?.impacts_per_period()?;
    checks.push(("irregular", smallest.repeats_after().is_none()));
    checks.push(("three", (three - 3.0).abs() < 0.05));
    Ok(PaperFigure::new(checks, json!({ "panels": panels, "forcing": forcing(cases)? })))
}

/// Why no forcing amplitude makes the experiment's order of regimes: the clearance of every boundary
/// is proportional to `F`, since `F/b` alone decides at given parameters. Lengths in metres.
fn forcing(cases: &CaseSet) -> Result<Value, PaperError> {
    let clearance =
        |name: &'static str| -> Result<f64, PaperError> { Ok(cases.case(name)?.length(1.0)) };
    let asymmetric = clearance("li2016-8hz-b4mm")?;
    let modulated = clearance("li2016-8hz-b11p5mm")?;
    let member = cases.case("li2016-8hz-b7p5mm")?;
    let system = &member.study.analysis.system;
    let stretch = member.needs(member.study.exact.stretch(), "stable exact orbit")?;
    let [breaking, last] = stretch.clearance.map(|end| member.length(end));
    let lost = member.study.confirmations.upper_limit.map(|limit| member.length(limit.lost.factor));
    // F = G eps in metres, and the F that moves a boundary of this case to a given clearance.
    let amplitude = member.case.design.forcing() * system.mass_ratio();
    let moved = |boundary: f64, to: f64| amplitude * to / boundary;
    let least = moved(breaking, asymmetric);
    let beside = moved(lost.unwrap_or(last), modulated);
    Ok(json!({
        "amplitude": amplitude,
        "steady_to": last,
        "asymmetric": asymmetric,
        "modulated": modulated,
        // F for asymmetric impacts; for an unsteady response from all starts, and from some.
        "least": least,
        "alone": moved(last, modulated),
        "beside": beside,
        "missed_by": (least / beside - 1.0).abs(),
    }))
}
