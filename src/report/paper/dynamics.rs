//! Figs. 8, 9 and 12: modulation on the manifold, restitution, transfer.

use super::{CaseSet, Draft, PaperError, TRANSFER, check};
use crate::analysis::Manifold;
use crate::regimes::Regime;
use crate::report::numbers::{percent, significant};
use crate::study::plots::restitutions::Strongest;
use crate::study::plots::{Modulation, Restitutions, Transfer};

/// While captured the motion may be this far from the stable branch, relative in `C`: steps between
/// impacts of a few percent are what the paper's enlargement shows.
const CLOSE: f64 = 0.1;

pub(super) fn figure_8(shelf: &CaseSet) -> Result<Draft, PaperError> {
    let member = shelf.case(TRANSFER)?;
    let away = Modulation::of(&member.study)?
        .and_then(|found| found.away)
        .ok_or(PaperError::NoResult { case: TRANSFER, what: "capture on the stable branch" })?;
    Ok(Draft {
        number: "8",
        title: "Strongly modulated response on the manifold",
        paper: "The modulated motion projected on the manifold (a), its way into 1:1 resonance (b), and its slide along the stable branch (c).",
        images: vec![shelf.image(TRANSFER, "modulation", 860)?],
        checks: vec![
            check(
                member.regime() == Some(Regime::StronglyModulated),
                format!("The motion at 8.5 Hz, b = {} is strongly modulated.", member.length(1.0)),
            ),
            check(
                away < CLOSE,
                format!("While captured it follows the stable branch: within {} of $C$ (rms).", percent(away)),
            ),
        ],
        remarks: vec![
            "The steps are those of the paper's enlargements: an impact changes $B$ at constant $C$; between impacts $C$ changes at constant $B$.".into(),
            "The motion does not jump off at the fold: it slides past it and stays near 1:1 for some impacts more.".into(),
        ],
        missing: "Clearance, $F$ and initial condition of the motion.",
    })
}

pub(super) fn figure_9(shelf: &CaseSet) -> Result<Draft, PaperError> {
    let (high, low) = ("li2016-8hz-b4mm", "li2016-8hz-b15mm");
    let of = |name: &'static str| -> Result<Strongest, PaperError> {
        Restitutions::of(&shelf.case(name)?.study)?
            .map(|found| found.strongest)
            .ok_or(PaperError::NoResult { case: name, what: "point of the manifold" })
    };
    let (at_high, at_low) = (of(high)?, of(low)?);
    let elastic = Manifold::of(1.0).symmetry_breaking.oscillator_amplitude;
    let dull = Manifold::of(0.2).fold.oscillator_amplitude;
    let between = |r: f64| r > 0.0 && r < 1.0;
    Ok(Draft {
        number: "9",
        title: "Influence of the restitution",
        paper: "Manifolds for $r = 1, 0.8, 0.6, 0.4, 0.2$ beside a fixed amplitude of the oscillator: with $r = 1$ it lies in Z1, with $r = 0.2$ there are few impacts, and an intermediate $r$ is said to maximise $E$.",
        images: vec![shelf.image(high, "restitutions", 860)?, shelf.image(low, "restitutions", 860)?],
        checks: vec![
            check(
                Manifold::of(0.2).fold.oscillator_amplitude > Manifold::of(0.6).fold.oscillator_amplitude,
                "A smaller $r$ lifts the fold, so that 1:1 resonance needs a larger amplitude.",
            ),
            check(
                between(at_low.harmonic) && between(at_high.harmonic),
                format!(
                    "As far as 1:1 resonance is steady, $E$ has its maximum at an intermediate $r$: it is at $r = {}$ and $r = {}$ for the two amplitudes.",
                    significant(at_high.harmonic, 2),
                    significant(at_low.harmonic, 2)
                ),
            ),
            check(
                between(at_low.damping) && between(at_high.damping),
                format!(
                    "$E\\sin\\Theta$, which is what damps the oscillator in (18), has one: at $r = {}$ and $r = {}$.",
                    significant(at_high.damping, 2),
                    significant(at_low.damping, 2)
                ),
            ),
            check(
                elastic < dull,
                format!(
                    "One amplitude puts $r = 1$ beyond Z3 and $r = 0.2$ below it: the first needs $C/b > {}$, the second $C/b < {}$.",
                    significant(elastic, 3),
                    significant(dull, 3)
                ),
            ),
        ],
        remarks: vec![
            "$E = 8B/\\pi^2$ grows with $r$ at a given $C$, as long as 1:1 resonance is steady: at the larger amplitude symmetry breaking ends it below $r = 1$, at the smaller one nothing does.".into(),
            "What dissipation needs besides is the phase of $E$, and that is lost as impacts become elastic: $E\\sin\\Theta$ has its maximum at an intermediate $r$ at both amplitudes. Two are shown, since no single one shows both ends.".into(),
        ],
        missing: "The amplitude of the oscillator that is drawn.",
    })
}

pub(super) fn figure_12(shelf: &CaseSet) -> Result<Draft, PaperError> {
    let name = "li2016-8hz-b15mm";
    let (member, measured) = (shelf.case(TRANSFER)?, shelf.case(name)?);
    let main = member.main().ok_or(PaperError::NoResult { case: TRANSFER, what: "motion" })?;
    let transfer = Transfer::of(&member.case, &member.study)?
        .ok_or(PaperError::NoResult { case: TRANSFER, what: "stretches" })?;
    let ([weak, falls, sparse], searched) = (transfer.parts, Transfer::PERIODS);
    let scales = member.case.scales();
    let millinewton_seconds = |impulse: f64| {
        let velocity = scales.velocity_m_per_s(impulse).unwrap_or(f64::NAN);
        significant(1e3 * scales.oscillator_mass_kg.unwrap_or(f64::NAN) * velocity, 3)
    };
    let captures = main.attractor.classification.evidence.captures;
    let absorber = main.attractor.classification.evidence.absorber_amplitude;
    let follows = absorber.correlation_with_growth.unwrap_or(0.0);
    let regime_there = measured.regime().map_or("nothing", Regime::words);
    Ok(Draft {
        number: "12",
        title: "Transfer of energy during strong modulation (experiment)",
        paper: "Five seconds of acceleration with its impacts (a), the return map (b), displacement of oscillator and shaker (c), and stretches in which the amplitude grows although captured (d), falls (e), and grows for want of impacts (f).",
        images: vec![
            shelf.image(TRANSFER, "transfer", 860)?,
            shelf.image(TRANSFER, "captures", 860)?,
            shelf.image(TRANSFER, "return-map-1", 360)?,
            shelf.image(TRANSFER, "transfer-stretches", 720)?,
        ],
        checks: vec![
            check(
                measured.regime() == Some(Regime::StronglyModulated),
                format!("The paper's case, 8 Hz and b = {}, is strongly modulated; found: {regime_there}.", measured.length(1.0)),
            ),
            check(
                main.regime() == Regime::StronglyModulated,
                format!(
                    "Captures come and go irregularly: here {} of the time, the longest {} periods (8.5 Hz, b = {}).",
                    percent(captures.share),
                    captures.longest,
                    member.length(1.0)
                ),
            ),
            check(
                falls.is_some(),
                falls.map_or_else(
                    || "(e) The amplitude falls while captured.".to_owned(),
                    |at| {
                        format!(
                            "(e) The amplitude falls while captured: by {} in {} periods.",
                            percent(-at.change),
                            at.stretch.periods
                        )
                    },
                ),
            ),
            check(
                sparse.is_some_and(|at| at.impacts < 2 * at.stretch.periods),
                sparse.map_or_else(
                    || "(f) It grows where impacts are missing.".to_owned(),
                    |at| {
                        format!(
                            "(f) It grows where impacts are missing: by {} in {} periods with {} impacts.",
                            percent(at.change),
                            at.stretch.periods,
                            at.impacts
                        )
                    },
                ),
            ),
            check(
                follows < 0.0,
                format!(
                    "$E$ of (17) is large where the vibration decreases: its correlation with the growth of $C$ is {}.",
                    significant(follows, 2)
                ),
            ),
            check(
                weak.is_some(),
                "(d) It grows although there are two impacts per period, when they are weak.",
            ),
            check(
                falls.zip(sparse).is_some_and(|(falls, sparse)| falls.impulse > sparse.impulse),
                falls.zip(sparse).map_or_else(
                    || "Impacts are stronger where the amplitude falls.".to_owned(),
                    |(falls, sparse)| {
                        format!(
                            "Impacts are stronger where the amplitude falls: {} mN s on average, against {} mN s where it grows.",
                            millinewton_seconds(falls.impulse),
                            millinewton_seconds(sparse.impulse)
                        )
                    },
                ),
            ),
        ],
        remarks: vec![
            "The paper's own case is steady 1:1 resonance with the inferred $F$, beside an unsteady response with few captures; see Fig. 11 for why no other $F$ mends this.".into(),
            "The case shown instead lies just beyond the Hopf boundary at 8.5 Hz, where the model is strongly modulated from all starts that move the absorber.".into(),
            format!(
                "Stretch (d) {} in {searched} periods{}.",
                if weak.is_some() { "was found" } else { "was not found" },
                if weak.is_some() {
                    ""
                } else {
                    ": in all of them two impacts per period drained the oscillator, so that in the model such a stretch is rare at best; the weak pairs of the experiment may come from friction or inclination, which section 4.2 mentions"
                }
            ),
            "A model's impact is an instant: the measured spikes of acceleration have their counterpart in the impulses of the lowest panel.".into(),
        ],
        missing: "$F$ as a number (Fig. 12c draws the shaker's displacement, from which it could be measured; that was not done here), and the accelerometer's bandwidth.",
    })
}
