//! Figs. 3 and 5 to 7: the manifold, its areas, the boundaries, and the responses.

use super::{CaseReport, CaseSet, Check, Draft, PaperError, TRANSFER, check};
use crate::analysis::Branch;
use crate::regimes::Regime;
use crate::report::numbers::{MINUS, percent, significant};
use crate::study::StudyError;
use crate::study::plots::responses::shares;
use crate::study::scenes::{WalkPoint, walk};
use crate::validation::tolerance::asymptotic_error;

/// Clearances at which the end of steady 1:1 is compared with what lies before it, over that of the
/// Hopf boundary.
const BEFORE_HOPF: [f64; 12] = [0.4, 0.5, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.925, 0.95, 0.975];

pub(super) fn figure_3(shelf: &CaseSet) -> Result<Draft, PaperError> {
    let name = "li2016-8p5hz-fig4c";
    let member = shelf.case(name)?;
    let analysis = &member.study.analysis;
    let (fold, breaking) = (analysis.manifold.fold, analysis.manifold.symmetry_breaking);
    let found = member.main().ok_or(PaperError::NoResult { case: name, what: "motion" })?;
    let predicted = analysis.stable_points().last();
    let predicted =
        predicted.ok_or(PaperError::NoResult { case: name, what: "stable fixed point" })?;
    let system = &analysis.system;
    let attractor = &found.attractor;
    let harmonics = (attractor.oscillator_harmonic, attractor.absorber_harmonic);
    let seen = crate::analysis::motion::read_off(system, harmonics.0, harmonics.1);
    let on = analysis.manifold.point(seen.absorber_amplitude - 1.0).oscillator_amplitude;
    let away = (seen.oscillator_amplitude - on).abs() / on;
    let allowed = asymptotic_error(system);
    let inside =
        (fold.absorber_amplitude..=breaking.absorber_amplitude).contains(&seen.absorber_amplitude);
    Ok(Draft {
        number: "3",
        title: "Slow invariant manifold with its stability",
        paper: "The manifold (16) for $r = 0.6$ and $b = 1$: a stable branch between two unstable ones.",
        images: vec![shelf.image(name, "sim", 720)?],
        checks: vec![
            check(
                predicted.branch == Branch::Stable && fold.absorber_amplitude < breaking.absorber_amplitude,
                format!(
                    "One stable branch between two unstable ones: from the fold, $B/b = {}$, $C/b = {}$, to symmetry breaking, $B/b = {}$, $C/b = {}$.",
                    significant(fold.absorber_amplitude, 4),
                    significant(fold.oscillator_amplitude, 4),
                    significant(breaking.absorber_amplitude, 4),
                    significant(breaking.oscillator_amplitude, 4)
                ),
            ),
            check(
                inside && away < allowed,
                format!(
                    "The simulated steady motion lies on the stable branch, within {} of $C$ (expected error of the theory: {}).",
                    percent(away),
                    percent(allowed)
                ),
            ),
        ],
        remarks: vec![
            "The paper finds the ends of the stable branch numerically; here they are closed form: $B = b/(1+R)$ and $B = b\\pi^2/(\\pi^2-4)$, the second for every $r$ and every damping.".into(),
        ],
        missing: "The coordinates of the two ends, and the matrix whose eigenvalues were used.",
    })
}

/// Clearances over the case's: symmetry breaking, Hopf, collision with its branch.
pub(super) fn route(
    member: &CaseReport,
    name: &'static str,
) -> Result<(f64, f64, f64, Branch), PaperError> {
    let boundaries = &member.study.analysis.boundaries;
    let gamma = member.study.analysis.system.forcing_per_clearance();
    let node = boundaries
        .saddle_node
        .ok_or(PaperError::NoResult { case: name, what: "collision of fixed points" })?;
    Ok((
        gamma / boundaries.symmetry_breaking,
        gamma / boundaries.hopf,
        gamma / node.forcing_over_clearance,
        node.branch,
    ))
}

pub(super) fn figure_5(shelf: &CaseSet) -> Result<Draft, PaperError> {
    let slow = "li2016-8hz-b15mm";
    let (beat, hysteresis) = (shelf.case(TRANSFER)?, shelf.case(slow)?);
    let (_, hopf, last, branch) = route(beat, TRANSFER)?;
    let (_, slow_hopf, slow_last, slow_branch) = route(hysteresis, slow)?;
    let regimes: Vec<Regime> =
        hysteresis.study.attractors.iter().map(crate::regimes::FoundAttractor::regime).collect();
    let steady = regimes.contains(&Regime::TwoSymmetric);
    let other = regimes.iter().any(|at| matches!(at, Regime::StronglyModulated | Regime::BelowTwo));
    Ok(Draft {
        number: "5",
        title: "Areas Z1 to Z4, and the two ways out of Z3",
        paper: "Four areas along the manifold; with growing clearance the fixed points vanish in one of two ways, at 8.5 Hz (b) and at 8 Hz (c).",
        images: vec![shelf.image(TRANSFER, "areas", 860)?, shelf.image(slow, "areas", 860)?],
        checks: vec![
            check(
                branch == Branch::Left && hopf < last,
                format!(
                    "8.5 Hz: the fixed point first leaves the stable branch (Hopf, {}), then two unstable points meet on the left branch and vanish ({}).",
                    beat.length(hopf),
                    beat.length(last)
                ),
            ),
            check(
                beat.regime() == Some(Regime::StronglyModulated),
                format!("Between the two the response is strongly modulated (simulated at {}).", beat.length(1.0)),
            ),
            check(
                slow_branch == Branch::Stable,
                format!("8 Hz: two fixed points of the stable branch collide and vanish ({}).", hysteresis.length(slow_last)),
            ),
            check(
                steady && other,
                format!(
                    "At 8 Hz steady 1:1 and a response that is not steady exist side by side: found at {}, already before the Hopf boundary at {}.",
                    hysteresis.length(1.0),
                    hysteresis.length(slow_hopf)
                ),
            ),
        ],
        remarks: vec![
            "The line between Z1 and Z2 is a grazing and has no closed form; it is taken from the exact asymmetric orbits, which double their period before they graze.".into(),
            "The unsteady response beside 1:1 at 8 Hz has hardly any captures: it is closer to Z4 than to the paper's strong modulation, and may be a very long transient.".into(),
        ],
        missing: "The clearances at which the fixed points are drawn, and the forcing amplitude $F$.",
    })
}

pub(super) fn figure_6(shelf: &CaseSet) -> Result<Draft, PaperError> {
    let slow = "li2016-8hz-b15mm";
    let (member, hysteresis) = (shelf.case(TRANSFER)?, shelf.case(slow)?);
    let (_, hopf, _, branch) = route(member, TRANSFER)?;
    let (.., slow_branch) = route(hysteresis, slow)?;
    let meeting = member.study.analysis.boundaries.codimension_two;
    let system = &member.study.analysis.system;
    let scales = member.case.scales();
    let ratio = 1.0 + system.mass_ratio() * meeting.detuning;
    let frequency = scales.frequency_hz(ratio).unwrap_or(ratio);
    let clearance = system.forcing_per_clearance() / meeting.forcing_over_clearance;
    let (optimum, remark) = optimum(member, hopf)?;
    Ok(Draft {
        number: "6",
        title: "Saddle-node and Hopf boundary, and the regions A1 and A2",
        paper: "The two conditions (a, b), the boundaries in frequency and clearance with A1 (hysteresis), A2 (beats) and the point P1 between them, and a red cross for the assumed optimum (c).",
        images: vec![
            shelf.image(TRANSFER, "bifurcations", 860)?,
            shelf.image(TRANSFER, "map", 720)?,
            shelf.image(TRANSFER, "clearances", 860)?,
        ],
        checks: vec![
            check(
                slow_branch == Branch::Stable && branch == Branch::Left,
                "Below P1 in frequency the collision is on the stable branch (A1), above it on the left one (A2).",
            ),
            check(
                meeting.forcing_over_clearance > 0.0,
                format!(
                    "There is one P1: {} Hz, $\\sigma = {}$, $\\gamma = {}$, that is b = {} with this $F$.",
                    significant(frequency, 5),
                    tex(meeting.detuning),
                    tex(meeting.forcing_over_clearance),
                    member.length(clearance)
                ),
            ),
            optimum,
        ],
        remarks: vec![
            remark,
            "Both boundaries are explicit here; P1 has a closed form that the paper does not give."
                .into(),
        ],
        missing: "$F$, hence any clearance of a boundary; the coordinates of P1.",
    })
}

/// A number inside a formula, where a minus is a hyphen.
fn tex(value: f64) -> String {
    significant(value, 4).replace(MINUS, "-")
}

/// Whether the oscillator vibrates least where 1:1 resonance ends.
fn optimum(member: &CaseReport, hopf: f64) -> Result<(Check, String), PaperError> {
    let clearances = BEFORE_HOPF.map(|part| part * hopf);
    let found = walk(&member.study.analysis.system, &clearances)?;
    let steady: Vec<&WalkPoint> =
        found.iter().filter(|point| point.regime == Regime::TwoSymmetric).collect();
    let least = steady.iter().min_by(|a, b| a.peak.total_cmp(&b.peak));
    let (Some(least), Some(last)) = (least, steady.last()) else {
        return Err(PaperError::NoResult { case: TRANSFER, what: "steady 1:1 before Hopf" });
    };
    let words = format!(
        "The vibration is smallest where 1:1 resonance ends: at 8.5 Hz the last steady peak is {} (b = {}), the smallest {} (b = {}).",
        member.length(last.peak),
        member.length(last.clearance),
        member.length(least.peak),
        member.length(least.clearance)
    );
    let remark = format!(
        "The minimum lies {} below the last steady clearance and is {} lower: the rule is a fair guide, not the optimum, and the clearance that it names has no margin.",
        percent(1.0 - least.clearance / last.clearance),
        percent(1.0 - least.peak / last.peak)
    );
    Ok((check(least.clearance == last.clearance, words), remark))
}

pub(super) fn figure_7(shelf: &CaseSet) -> Result<Draft, PaperError> {
    let member = shelf.case(TRANSFER)?;
    let shares = shares(&member.study.analysis.system).map_err(StudyError::from)?;
    let [far, touching, inside, below] = shares.as_slice() else {
        return Err(PaperError::NoResult { case: TRANSFER, what: "four responses" });
    };
    let say = |(clearance, share): &(f64, f64)| {
        format!("{} at b = {}", percent(*share), member.length(*clearance))
    };
    Ok(Draft {
        number: "7",
        title: "Frequency responses against the manifold",
        paper: "Four forcings per clearance move the response from Z1 to Z4; the one whose top just reaches the end of Z3 keeps the widest band around the natural frequency in Z3.",
        images: vec![shelf.image(TRANSFER, "forcing-responses", 860)?],
        checks: vec![
            check(
                touching.1 > far.1.max(inside.1).max(below.1),
                format!(
                    "The response that just reaches symmetry breaking has most of the band in Z3: {}, against {}, {} and {}.",
                    say(touching),
                    say(far),
                    say(inside),
                    say(below)
                ),
            ),
            check(
                far.1 < 1.0 && below.1 == 0.0,
                "No clearance has the whole band in Z3, and with the largest nothing of it is.",
            ),
        ],
        remarks: vec![
            "The four were chosen here: 2.5 times and once the smallest $\\gamma$ of symmetry breaking, a value inside Z3, and 0.85 of the smallest $\\gamma$ of the Hopf boundary.".into(),
            "Other than in the paper the responses are drawn with their unstable parts, isolated loops included.".into(),
            "Being in Z3 is not vibrating less: at 8 Hz the absorber increases the vibration although the case lies in Z3 (first finding above).".into(),
        ],
        missing: "The four values of $G/b$.",
    })
}
