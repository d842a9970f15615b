//! Figs. 8, 9 and 12: modulation on the manifold, restitution, transfer.

use serde_json::{Value, json};

use super::{CaseReport, CaseSet, HYSTERESIS, PaperError, PaperFigure, TRANSFER};
use vinesink::analysis::Manifold;
use vinesink::regimes::Regime;
use vinesink::study::plots::restitutions::Strongest;
use vinesink::study::plots::traces::Part;
use vinesink::study::plots::{Modulation, Restitutions, Transfer};

/// While captured the motion may be this far from the stable branch, relative in `C`: steps between
/// impacts of a few percent are what the paper's enlargement shows.
const CLOSE: f64 = 0.1;

pub(super) fn figure_8(cases: &CaseSet) -> Result<PaperFigure, PaperError> {
    let member = cases.case(TRANSFER)?;
    let away = Modulation::of(&member.study)?.and_then(|found| found.away);
    let away = member.needs(away, "capture on the stable branch")?;
    Ok(PaperFigure::new(
        [
            ("modulated", member.regime() == Some(Regime::StronglyModulated)),
            ("follows", away < CLOSE),
        ],
        json!({ "clearance": member.length(1.0), "away": away }),
    ))
}

pub(super) fn figure_9(cases: &CaseSet) -> Result<PaperFigure, PaperError> {
    let of = |name: &'static str| -> Result<Strongest, PaperError> {
        let member = cases.case(name)?;
        let found = Restitutions::of(&member.study).map(|found| found.strongest);
        member.needs(found, "point of the manifold")
    };
    let (high, low) = (of("li2016-8hz-b4mm")?, of(HYSTERESIS)?);
    let fold = |r| Manifold::of(r).fold.oscillator_amplitude;
    let elastic = Manifold::of(1.0).symmetry_breaking.oscillator_amplitude;
    let dull = fold(0.2);
    let intermediate = |pair: [f64; 2]| pair.into_iter().all(|r| r > 0.0 && r < 1.0);
    let (harmonic, damping) = ([high.harmonic, low.harmonic], [high.damping, low.damping]);
    Ok(PaperFigure::new(
        [
            ("lifts_the_fold", dull > fold(0.6)),
            ("harmonic", intermediate(harmonic)),
            ("damping", intermediate(damping)),
            ("one_amplitude", elastic < dull),
        ],
        json!({ "harmonic": harmonic, "damping": damping, "elastic": elastic, "dull": dull }),
    ))
}

pub(super) fn figure_12(cases: &CaseSet) -> Result<PaperFigure, PaperError> {
    transfer(cases.case(TRANSFER)?, cases.case(HYSTERESIS)?)
}

/// Fig. 12 as a case shows it, beside what one with the paper's own frequency and clearance is.
pub(super) fn transfer(
    member: &CaseReport,
    measured: &CaseReport,
) -> Result<PaperFigure, PaperError> {
    let transfer = member.needs(Transfer::of(&member.case, &member.study)?, "stretches")?;
    let ([weak, falls, sparse], searched) = (transfer.parts, Transfer::PERIODS);
    let units = member.case.units();
    let millinewton_seconds = |impulse: f64| 1e3 * units.oscillator_mass * units.velocity(impulse);
    let (_, main) = member.main()?;
    let evidence = &main.classification.evidence;
    let correlation = evidence.absorber_amplitude.correlation_with_growth.unwrap_or(0.0);
    let told = |at: Option<Part>| -> Option<Value> {
        let at = at?;
        Some(json!({
            "change": at.change.abs(), "periods": at.stretch.periods, "impacts": at.impacts, "impulse": millinewton_seconds(at.impulse),
        }))
    };
    let stronger = falls.zip(sparse).is_some_and(|(falls, sparse)| falls.impulse > sparse.impulse);
    Ok(PaperFigure::new(
        [
            ("papers_own", measured.regime() == Some(Regime::StronglyModulated)),
            ("captures", main.regime() == Regime::StronglyModulated),
            ("falls", falls.is_some()),
            ("sparse", sparse.is_some_and(|at| at.impacts < 2 * at.stretch.periods)),
            ("correlation", correlation < 0.0),
            ("weak", weak.is_some()),
            ("stronger", stronger),
        ],
        json!({
            "papers_own": measured.length(1.0),
            "papers_regime": measured.regime().map(Regime::key),
            "clearance": member.length(1.0),
            "captured": evidence.captures.share,
            "longest": evidence.captures.longest,
            "falls": told(falls),
            "sparse": told(sparse),
            "correlation": correlation,
            "searched": searched,
        }),
    ))
}
