//! Figs. 4 and 11: which regime comes at which clearance.

use super::{CaseSet, Check, Draft, Image, PaperError, TRANSFER, check};
use crate::orbits::Bifurcation;
use crate::regimes::Regime;
use crate::report::numbers::{percent, significant};
use crate::study::exact_branches::ExactBranches;
use crate::system::{Parameter, System};

/// The cases of Fig. 4 with the regime that the paper shows.
const FIGURE_4: [(&str, &str, Regime); 5] = [
    ("a", "li2016-8p5hz-fig4a", Regime::AboveTwo),
    ("b", "li2016-8p5hz-fig4b", Regime::TwoAsymmetric),
    ("c", "li2016-8p5hz-fig4c", Regime::TwoSymmetric),
    ("d", "li2016-8p5hz-fig4d", Regime::StronglyModulated),
    ("e", "li2016-8p5hz-fig4e", Regime::BelowTwo),
];

/// The cases of Fig. 11 with the regime that the experiment shows.
const FIGURE_11: [(&str, &str, Regime); 6] = [
    ("a", "li2016-8hz-b0p3mm", Regime::AboveTwo),
    ("b", "li2016-8hz-b2p5mm", Regime::AboveTwo),
    ("c", "li2016-8hz-b4mm", Regime::TwoAsymmetric),
    ("d", "li2016-8hz-b7p5mm", Regime::TwoSymmetric),
    ("e", "li2016-8hz-b11p5mm", Regime::StronglyModulated),
    ("f", "li2016-8hz-b20mm", Regime::BelowTwo),
];

fn compared(
    shelf: &CaseSet,
    cases: &[(&'static str, &'static str, Regime)],
) -> Result<Vec<Check>, PaperError> {
    let mut checks = Vec::new();
    for (letter, name, expected) in cases {
        let member = shelf.case(name)?;
        let main = member.main().ok_or(PaperError::NoResult { case: name, what: "motion" })?;
        let z = main.attractor.classification.evidence.impacts_per_period;
        checks.push(check(
            main.regime() == *expected,
            format!(
                "({letter}) {} in the paper; found at b = {}: {}, $z = {}$.",
                expected.words(),
                member.length(1.0),
                main.regime().words(),
                significant(z, 3)
            ),
        ));
    }
    Ok(checks)
}

pub(super) fn figure_4(shelf: &CaseSet) -> Result<Draft, PaperError> {
    let mut checks = compared(shelf, &FIGURE_4)?;
    let (mut impacts, mut levels, mut words) = (Vec::new(), Vec::new(), Vec::new());
    let mut images: Vec<Image> = Vec::new();
    for (_, name, _) in FIGURE_4 {
        let member = shelf.case(name)?;
        let main = member.main().ok_or(PaperError::NoResult { case: name, what: "motion" })?;
        impacts.push(main.attractor.classification.evidence.impacts_per_period);
        let scales = member.case.scales();
        levels.push(scales.length(main.attractor.rms));
        words.push(member.length(main.attractor.rms));
        images.push(shelf.image(name, "motion-1", 720)?);
    }
    checks.push(check(
        impacts.windows(2).all(|pair| pair[1] <= pair[0] + 1e-9),
        "The average of $z$ falls from (a) to (e).",
    ));
    let lowest = (0..levels.len()).min_by(|a, b| levels[*a].total_cmp(&levels[*b])).unwrap_or(0);
    let valley = levels[..=lowest].windows(2).all(|pair| pair[1] < pair[0])
        && levels[lowest..].windows(2).all(|pair| pair[1] > pair[0]);
    checks.push(check(
        valley && (1..levels.len() - 1).contains(&lowest),
        format!("The average amplitude first falls, then rises: rms {}.", words.join(", ")),
    ));
    images.push(shelf.image(TRANSFER, "diagram-clearance", 860)?);
    let member = shelf.case(TRANSFER)?;
    let exact = member.study.exact.boundaries.as_ref();
    let (breaking, doubling, grazing) = exact
        .and_then(|exact| exact.asymmetric.as_ref())
        .and_then(|found| Some((found.symmetry_breaking, found.period_doubling?, found.grazing?)))
        .ok_or(PaperError::NoResult { case: TRANSFER, what: "asymmetric orbits" })?;
    Ok(Draft {
        number: "4",
        title: "Five response regimes at 8.5 Hz",
        paper: "Displacement, relative displacement and projection on the manifold for five clearances: $z > 2$, two asymmetric impacts, two symmetric ones, strongly modulated, $z < 2$.",
        images,
        checks,
        remarks: vec![
            "The clearances were chosen so that simulation shows the regimes in the paper's order; that they exist, and in this order, is what is reproduced.".into(),
            "In the right panels an impact moves the point sideways, since it changes the absorber's speed; between impacts forcing and damping move it up and down.".into(),
            format!(
                "The last figure, which the paper has no counterpart of, shows what lies between the five: exact orbits over simulation swept up and down. Below {} the two impacts turn asymmetric; this motion doubles its period at {}, before the wall that it would graze at {} adds a third impact; the orbit with three impacts exists before, so that both coexist.",
                member.length(breaking),
                member.length(doubling),
                member.length(grazing)
            ),
        ],
        missing: "The five clearances, $F$, and the initial conditions.",
    })
}

pub(super) fn figure_11(shelf: &CaseSet) -> Result<Draft, PaperError> {
    let mut checks = compared(shelf, &FIGURE_11)?;
    let mut images = Vec::new();
    for (_, name, _) in FIGURE_11 {
        images.push(shelf.image(name, "return-map-1", 360)?);
    }
    images.push(shelf.image("li2016-8hz-b15mm", "clearances", 860)?);
    images.push(shelf.image("li2016-8hz-b15mm", "diagram-clearance", 860)?);
    let smallest = shelf.case("li2016-8hz-b0p3mm")?;
    let repeats = smallest.main().is_some_and(|main| main.attractor.repeats());
    checks.push(check(!repeats, "(a) The impacts at b = 0.3 mm are irregular, judged as chaos."));
    let three = shelf
        .case("li2016-8hz-b2p5mm")?
        .main()
        .map(|main| main.attractor.classification.evidence.impacts_per_period);
    checks.push(check(
        three.is_some_and(|z| (z - 3.0).abs() < 0.05),
        "(b) Three impacts in every period at b = 2.5 mm.",
    ));
    Ok(Draft {
        number: "11",
        title: "Return maps of the times between impacts at 8 Hz (experiment)",
        paper: "Six measured clearances from chaos with many impacts, over 3, 2 asymmetric and 2 symmetric impacts per period and strong modulation, to fewer than two; (g) places them on the manifold.",
        images,
        checks,
        remarks: remarks(shelf)?,
        missing: "$F$; the experiment also has friction, an inclination and unequal ends of the cavity (its section 4.2), which no equation of the paper contains.",
    })
}

/// Why no forcing amplitude makes the experiment's order of regimes: the clearance of every boundary
/// is proportional to `F`, since `F/b` alone decides at given parameters.
fn remarks(shelf: &CaseSet) -> Result<Vec<String>, PaperError> {
    let [three, asymmetric, steady, modulated] =
        ["li2016-8hz-b2p5mm", "li2016-8hz-b4mm", "li2016-8hz-b7p5mm", "li2016-8hz-b11p5mm"];
    let clearance = |name: &'static str| -> Result<f64, PaperError> {
        Ok(shelf.case(name)?.case.scales().clearance)
    };
    let member = shelf.case(steady)?;
    let system = &member.study.analysis.system;
    let stretch = member
        .study
        .exact
        .stretch()
        .ok_or(PaperError::NoResult { case: steady, what: "stable exact orbit" })?;
    let [breaking, last] = stretch.clearance;
    let here = clearance(steady)?;
    // F = G eps in metres, and the F that moves a boundary of this case to a given clearance.
    let amplitude = member.case.scales().forcing * system.mass_ratio();
    let moved = |boundary: f64, to: f64| amplitude * to / (boundary * here);
    let text = |metres: f64| format!("{} mm", significant(1e3 * metres, 3));
    let b = clearance(modulated)?;
    let least = moved(breaking, clearance(asymmetric)?);
    let alone = moved(last, b);
    let lost = member.study.confirmations.upper_limit.map_or(last, |limit| limit.lost.factor);
    let beside = moved(lost, b);
    let mut lines = vec![format!(
        "(e) differs: with $F = {}\\,\\mathrm{{mm}}$ the model is in steady 1:1 resonance at b = {}; the exact orbit is stable up to {}.",
        significant(1e3 * amplitude, 3),
        text(b),
        text(last * here)
    )];
    lines.push(format!(
        "Another $F$ {} that: asymmetric impacts at b = {} need $F$ above {} (exact symmetry breaking), an unsteady response at b = {} needs $F$ below {} (from some starts, by simulation) or {} (from all, exact orbit), because the clearance of every boundary is proportional to $F$. The two miss each other by {}.",
        if least < beside { "could mend" } else { "does not mend" },
        text(clearance(asymmetric)?),
        text(least),
        text(b),
        text(beside),
        text(alone),
        percent((least / beside - 1.0).abs())
    ));
    if let Some(birth) = birth_of_three(system) {
        let enough = moved(birth, clearance(three)?);
        lines.push(format!(
            "If the asymmetry of (c) were the apparatus's own, as section 4.2 says of other unequal intervals, (b) needs $F$ above {}, where the orbit with three impacts is born: with (e) that leaves {}.",
            text(enough),
            if enough < beside {
                format!("{} to {}, where 1:1 resonance or two impacts still are the answer of many starts, and the unsteady response has few captures (as at 8 Hz, b = 15 mm, in [Fig. 5](#fig-5))", text(enough), text(beside))
            } else {
                "nothing".to_owned()
            }
        ));
    }
    lines.extend([
        "So with the parameters of Table 1 the paper's equations do not give all six panels for any one $F$; what they leave out (friction, inclination, unequal ends) is a likely cause.".to_owned(),
        "(a) differs in regularity: the model's impacts at 0.3 mm chatter towards the wall in the same way every period.".to_owned(),
    ]);
    Ok(lines)
}

/// The largest clearance, over the system's own, with an orbit of more than two impacts that attracts
/// or turns there: where the one with three is born.
fn birth_of_three(system: &System) -> Option<f64> {
    let exact = ExactBranches::over(system, Parameter::Clearance, [0.2, 1.0]);
    let born = exact.marks.iter().filter(|mark| {
        !mark.symmetric && mark.kind == Bifurcation::SaddleNode && mark.at.cycle.impact_count() == 3
    });
    born.map(|mark| mark.at.value).reduce(f64::max)
}
