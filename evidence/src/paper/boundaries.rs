//! Figs. 3 and 5 to 7: the manifold, its areas, the boundaries, and the responses; and the limits of steady
//! 1:1 resonance, layer by layer.

use serde_json::{Value, json};

use super::{CaseReport, CaseSet, HYSTERESIS, PaperError, PaperFigure, STEADY, TRANSFER};
use vinesink::analysis::{ManifoldBranch, motion};
use vinesink::motions::Motion;
use vinesink::orbits::Bifurcation;
use vinesink::regimes::Regime;
use vinesink::study::plots::responses::shares;
use vinesink::study::scenes::{WalkPoint, walk};
use vinesink::validation::tolerance::asymptotic_error;

/// Clearances at which the end of steady 1:1 is compared with what lies before it, over that of the
/// Hopf boundary.
const BEFORE_HOPF: [f64; 12] = [0.4, 0.5, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.925, 0.95, 0.975];

pub(super) fn figure_3(cases: &CaseSet) -> Result<PaperFigure, PaperError> {
    let member = cases.case(STEADY[1])?;
    let analysis = &member.study.analysis;
    let (fold, breaking) = (analysis.manifold.fold, analysis.manifold.symmetry_breaking);
    let predicted = member.needs(analysis.stable_points().last(), "stable fixed point")?;
    let (_, measured) = member.main()?;
    let (oscillator, absorber) = (measured.oscillator_harmonic, measured.absorber_harmonic);
    let seen = motion::read_off(&analysis.system, oscillator, absorber);
    let on = analysis.manifold.point(seen.absorber_amplitude - 1.0).oscillator_amplitude;
    let away = (seen.oscillator_amplitude - on).abs() / on;
    let allowed = asymptotic_error(&analysis.system);
    let between = fold.absorber_amplitude..=breaking.absorber_amplitude;
    let point = |b: f64, c: f64| json!({ "B": b, "C": c });
    Ok(PaperFigure::new(
        [
            (
                "one_stable_branch",
                predicted.branch == ManifoldBranch::Stable && !between.is_empty(),
            ),
            ("on_the_branch", between.contains(&seen.absorber_amplitude) && away < allowed),
        ],
        json!({
            "fold": point(fold.absorber_amplitude, fold.oscillator_amplitude),
            "breaking": point(breaking.absorber_amplitude, breaking.oscillator_amplitude),
            "away": away,
            "allowed": allowed,
        }),
    ))
}

/// A case in the middle of Z3: what it gains, and the limits of steady 1:1 resonance by each layer.
pub(super) fn steady(cases: &CaseSet, name: &'static str) -> Result<Value, PaperError> {
    let member = cases.case(name)?;
    let bare = member.study.analysis.system.linear_response();
    let bare = member.needs(bare, "linear response")?.amplitude();
    let peak = member.main()?.0.facts().peak.value;
    let simulated = member.study.confirmations.upper_limit;
    let exact = member.study.exact.stretch();
    Ok(json!({
        "clearance": member.length(1.0),
        "peak": member.length(peak),
        "bare": member.length(bare),
        "change_db": 20.0 * libm::log10(peak / bare),
        "breaking": member.boundary(Bifurcation::SymmetryBreaking)?,
        "hopf": member.boundary(Bifurcation::NeimarkSacker)?,
        "collision": member.boundary(Bifurcation::SaddleNode)?,
        "ends_by_collision": member.collides_on(ManifoldBranch::Stable),
        "exact": exact.map(|stretch| stretch.clearance.map(|end| member.length(end))),
        "exact_end": exact.and_then(|stretch| stretch.ends[1]).map(Bifurcation::words),
        "simulated": simulated.map(|limit| [limit.kept, limit.lost.factor].map(|at| member.length(at))),
    }))
}

pub(super) fn figure_5(cases: &CaseSet) -> Result<PaperFigure, PaperError> {
    let (beats, hysteresis) = (cases.case(TRANSFER)?, cases.case(HYSTERESIS)?);
    let ways_out = |member: &CaseReport| -> Result<[f64; 2], PaperError> {
        Ok([
            member.boundary(Bifurcation::NeimarkSacker)?,
            member.boundary(Bifurcation::SaddleNode)?,
        ])
    };
    let ([hopf, collision], [slow_hopf, slow_collision]) =
        (ways_out(beats)?, ways_out(hysteresis)?);
    let regimes: Vec<Regime> = hysteresis.study.motions.iter().map(Motion::regime).collect();
    let unsteady = |at: &Regime| matches!(at, Regime::StronglyModulated | Regime::BelowTwo);
    Ok(PaperFigure::new(
        [
            ("hopf_first", beats.collides_on(ManifoldBranch::Left) && hopf < collision),
            ("modulated", beats.regime() == Some(Regime::StronglyModulated)),
            ("collide", hysteresis.collides_on(ManifoldBranch::Stable)),
            (
                "side_by_side",
                regimes.contains(&Regime::TwoSymmetric) && regimes.iter().any(unsteady),
            ),
        ],
        json!({
            "hopf": hopf,
            "collision": collision,
            "modulated": beats.length(1.0),
            "slow_hopf": slow_hopf,
            "slow_collision": slow_collision,
            "hysteresis": hysteresis.length(1.0),
        }),
    ))
}

pub(super) fn figure_6(cases: &CaseSet) -> Result<PaperFigure, PaperError> {
    let (member, hysteresis) = (cases.case(TRANSFER)?, cases.case(HYSTERESIS)?);
    let analysis = &member.study.analysis;
    let meeting = analysis.boundaries.codimension_two;
    let ratio = 1.0 + analysis.system.mass_ratio() * meeting.detuning;
    let hopf = member.boundary(Bifurcation::NeimarkSacker)? / member.length(1.0);
    let found = walk(&analysis.system, &BEFORE_HOPF.map(|part| part * hopf))?;
    let steady: Vec<&WalkPoint> =
        found.iter().filter(|point| point.regime == Regime::TwoSymmetric).collect();
    let least = steady.iter().min_by(|a, b| a.peak.total_cmp(&b.peak));
    let (least, last) = member.needs(least.zip(steady.last()), "steady 1:1 before Hopf")?;
    let place = |at: &WalkPoint| json!({ "clearance": member.length(at.clearance), "peak": member.length(at.peak) });
    let forcing = analysis.system.forcing_per_clearance();
    Ok(PaperFigure::new(
        [
            (
                "branches",
                hysteresis.collides_on(ManifoldBranch::Stable)
                    && member.collides_on(ManifoldBranch::Left),
            ),
            ("one_meeting", meeting.forcing_over_clearance > 0.0),
            ("least_at_the_end", least.clearance == last.clearance),
        ],
        json!({
            "frequency": member.case.units().frequency(ratio),
            "detuning": meeting.detuning,
            "forcing": meeting.forcing_over_clearance,
            "clearance": member.length(forcing / meeting.forcing_over_clearance),
            "least": place(least),
            "last": place(last),
            "before": 1.0 - least.clearance / last.clearance,
            "lower": 1.0 - least.peak / last.peak,
        }),
    ))
}

pub(super) fn figure_7(cases: &CaseSet) -> Result<PaperFigure, PaperError> {
    let member = cases.case(TRANSFER)?;
    let [far, touching, inside, below] = shares(&member.study.analysis.system);
    let told = [touching, far, inside, below]
        .map(|(clearance, share)| json!({ "clearance": member.length(clearance), "share": share }));
    Ok(PaperFigure::new(
        [
            ("widest", touching.1 > far.1.max(inside.1).max(below.1)),
            ("none_whole", far.1 < 1.0 && below.1 == 0.0),
        ],
        json!({ "responses": told }),
    ))
}
