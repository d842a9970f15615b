//! What is said about an optimisation.

use crate::analysis::Strip;
use crate::band::rivals::DETUNED;
use crate::band::{Source, theory};
use crate::case::{AbsorberDesign, BandOver, Case, Objective, Scales};
use crate::criteria::Judged;
use crate::optimize::claim::Claim;
use crate::optimize::task::value_of;
use crate::optimize::{Bounds, Design, Deviation, Optimization, Variable};
use crate::report::criteria_rows::{self as criteria, CriterionRow};
use crate::report::numbers::{LengthFormat, fixed, percent, signed_percent, significant};
use crate::report::units::Units;

/// Digits of a clearance: as it is written.
const DIGITS: usize = 4;
/// Relative distance from a bound within which a value lies on it: it may have been rounded.
const ON_BOUND: f64 = 1e-3;
/// Share of a band in strips from which on the reader is told.
const STRIPS: f64 = 0.01;

/// An optimisation with what turns its numbers into text.
pub(super) struct Words<'a> {
    pub case: &'a Case,
    pub found: &'a Optimization,
    pub scales: Scales,
    pub lengths: LengthFormat,
    units: Units,
    /// What is uncertain, as the case says it.
    pub uncertain: Vec<String>,
}

impl<'a> Words<'a> {
    pub fn new(case: &'a Case, found: &'a Optimization) -> Self {
        let scales = case.scales();
        Self {
            case,
            found,
            scales,
            lengths: LengthFormat::of(&scales),
            units: Units::of(case),
            uncertain: uncertain(case),
        }
    }

    /// A length in four digits.
    pub fn length(&self, length: f64) -> String {
        self.lengths.with_digits(length, DIGITS)
    }

    /// A frequency ratio as a frequency, where there is one.
    pub fn frequency(&self, omega: f64) -> String {
        self.units.frequency_text(omega)
    }

    pub fn is_amplitude(&self) -> bool {
        self.found.task.objective == Objective::WorstAmplitude
    }

    /// A value of the objective as the figure's ordinate.
    pub fn number(&self, value: f64) -> f64 {
        if self.is_amplitude() { self.lengths.number(value) } else { 100.0 * value }
    }

    /// A value of the objective with its unit.
    pub fn value(&self, value: f64) -> String {
        match self.is_amplitude() {
            _ if !value.is_finite() => "–".to_owned(),
            true => self.lengths.text(value),
            // Robust and nominal optimum often differ by less than a per cent.
            false => format!("{} %", fixed(100.0 * value, 1)),
        }
    }

    /// The same with how much more it may be.
    pub fn value_with_error(&self, value: f64, error: f64) -> String {
        // Below a thousandth an error changes no digit that is shown.
        if !(error > 1e-3 * value.abs() && value.is_finite()) {
            return self.value(value);
        }
        format!("{} (+{})", self.value(value), self.value(error))
    }

    /// The objective of a judged absorber.
    pub fn of(&self, design: &Design) -> String {
        self.value_with_error(design.value, design.error)
    }

    /// The ordinate's name.
    pub fn axis(&self) -> String {
        match self.found.task.objective {
            Objective::Z3Share => "share in area Z3 (%)".to_owned(),
            Objective::StableShare => "share with a stable 1:1 orbit (%)".to_owned(),
            Objective::WorstAmplitude => format!("largest displacement ({})", self.lengths.unit),
            Objective::Margin => "smallest margin in clearance (%)".to_owned(),
        }
    }

    /// What was looked for.
    pub fn objective_words(&self) -> &'static str {
        match (self.found.task.objective, self.found.task.band.is_some()) {
            (Objective::Z3Share, true) => "Share of the band in area Z3",
            (Objective::Z3Share, false) => "Area Z3 at the case's excitation",
            (Objective::StableShare, true) => "Share of the band with a stable 1:1 orbit",
            (Objective::StableShare, false) => "Stable 1:1 orbit at the case's excitation",
            (Objective::WorstAmplitude, true) => "Largest displacement over the band",
            (Objective::WorstAmplitude, false) => "Largest displacement at the case's excitation",
            (Objective::Margin, true) => "Smallest margin in clearance over the band",
            (Objective::Margin, false) => "Margin in clearance at the case's excitation",
        }
    }

    /// The answer.
    pub fn headline(&self) -> String {
        let (found, best, what) = (self.found, &self.found.best, self.objective_words());
        let reached = self.of(best);
        if !found.reached() {
            return format!("Nothing between the bounds reaches it. {what}: {reached}.");
        }
        let absorber = self.absorber(&best.choice);
        let answer = match found.improves() {
            true => format!("Best {absorber}. {what}: {reached}."),
            false => format!(
                "No absorber between the bounds is better than the case's own, {absorber}. {what}: {reached}."
            ),
        };
        if best.is_feasible() {
            return answer;
        }
        format!("No absorber between the bounds meets all criteria. {answer}")
    }

    /// What the case's own absorber reaches.
    pub fn against_own(&self) -> String {
        let own = &self.found.own;
        format!("The case itself, at {}, has {}.", self.length(own.choice.clearance), self.of(own))
    }

    /// What follows from the rest, a sentence each.
    pub fn sentences(&self) -> Vec<String> {
        let mut sentences = vec![self.against_own()];
        if !self.found.reached() {
            return sentences;
        }
        sentences.extend(self.failing(&self.found.best, "At the best"));
        sentences.extend(self.closest());
        sentences.extend(self.tuned_mass_damper());
        sentences.extend(self.worst_motion());
        let [low, high] = self.found.plateau;
        if high > low * 1.001 && !self.is_amplitude() {
            let [low, high] = [low, high].map(|end| self.lengths.text(end));
            sentences.push(format!(
                "Clearances from {low} to {high} are as good; the middle of them is chosen."
            ));
        }
        sentences.extend(self.strips());
        sentences.extend(self.at_bounds());
        sentences.extend(self.robust());
        sentences
    }

    fn rows(&self, judged: &[Judged]) -> Vec<CriterionRow> {
        criteria::rows(self.case, judged)
    }

    /// Which criteria an absorber misses, and by how much.
    fn failing(&self, design: &Design, lead: &str) -> Option<String> {
        let rows = self.rows(&design.criteria);
        let missed = rows.iter().filter(|row| row.holds != Some(true));
        let missed: Vec<String> = missed
            .map(|row| {
                let [asked, found, _] = &row.words;
                format!("{} is {found}, asked {asked}", criteria::subject(row.name))
            })
            .collect();
        (!missed.is_empty()).then(|| format!("{lead}: {}.", missed.join("; ")))
    }

    fn closest(&self) -> Option<String> {
        let closest = self.found.closest.as_ref()?;
        if closest.choice == self.found.best.choice {
            return Some("It is also the one that misses the criteria least.".to_owned());
        }
        let at = self.absorber(&closest.choice);
        let lead = format!("Closest to all criteria is {at}, with {}", self.of(closest));
        self.failing(closest, &lead)
    }

    /// What a tuned mass damper of the same mass does, and who wins.
    fn tuned_mass_damper(&self) -> Option<String> {
        let best = &self.found.best;
        self.found.task.band.as_ref()?;
        let clearance = best.choice.clearance;
        let length = |over: f64| self.lengths.text(over * clearance);
        let rivals = &best.rivals;
        let [low, high] = rivals.detuned.map(|off| length(off.amplitude));
        let said = format!(
            "A tuned mass damper of the same mass (tuned to {}, damping ratio {}) has at most {} over the band with a stroke of {}; with the structure's frequency off by {} either way {low} and {high}",
            self.units.frequency_text(rivals.damper.tuning),
            percent(rivals.damper.damping_ratio),
            length(rivals.damped.amplitude),
            length(rivals.damped.stroke),
            significant(100.0 * (DETUNED[1] - 1.0), 1) + " %",
        );
        let Some(worst) = best.worst else { return Some(format!("{said}.")) };
        let absorber = worst.peak + worst.error;
        let verdict = match (rivals.damped.amplitude < absorber, rivals.damped.stroke > 1.0) {
            (true, false) => "The damper is the better choice",
            (true, true) => {
                "The damper vibrates less, and needs more room than the absorber's cavity has to either side"
            }
            (false, _) => "The absorber is the better choice",
        };
        Some(format!("{said}. {verdict}."))
    }

    /// Which motion is the worst, where that is not plain.
    fn worst_motion(&self) -> Option<String> {
        let worst = self.found.best.worst.filter(|_| self.is_amplitude())?;
        let place = match self.found.task.band {
            Some(_) => format!("at {}", self.at(worst.at)),
            None => "here".to_owned(),
        };
        Some(match worst.of {
            Source::Orbit => format!("The worst motion is the stable 1:1 orbit {place}."),
            Source::Inactive(inactive) => format!(
                "The worst motion is that of an absorber that never wakes, {place}: from rest it stays so from {} of its resting places.",
                percent(inactive.share)
            ),
            Source::Simulated(motion) => format!(
                "The worst motion is {} {place}, with {} impacts per period.",
                if motion.repeats_after.is_some() { "one that repeats" } else { "irregular" },
                significant(motion.impacts_per_period, 3)
            ),
        })
    }

    fn robust(&self) -> Option<String> {
        let robust = self.found.robust.as_ref()?;
        let [of_robust, of_best] = robust.under;
        let at = self.absorber(&robust.design.choice);
        Some(format!(
            "Under what is uncertain the best has {} in expectation and {} at the worst corner; the robust optimum, {at}, has {} and {}, and {} as written.",
            self.value(of_best.expected),
            self.value(of_best.worst_corner),
            self.value(of_robust.expected),
            self.value(of_robust.worst_corner),
            self.of(&robust.design),
        ))
    }

    /// A variable of an absorber, or a bound of it, with its name.
    fn variable(&self, variable: Variable, value: f64) -> String {
        match variable {
            Variable::Clearance => format!("clearance {}", self.length(value)),
            Variable::Restitution => format!("restitution {}", significant(value, 4)),
            Variable::Mass => format!("mass {}", super::mass_text(value)),
        }
    }

    /// How much of the share in Z3 is in strips, where the motion is not, or not always, a steady 1:1 one.
    fn strips(&self) -> Option<String> {
        let task = &self.found.task;
        if task.objective != Objective::Z3Share {
            return None;
        }
        let (band, _) = task.band_of(&self.found.best.choice, &Deviation::default())?;
        let zones = theory::zones(&band);
        let share = |strip| band.share(&zones, |zone| zone.is_z3() && zone.strip == Some(strip));
        let strips = [
            ("A1 (hysteresis: the start decides which motion it is)", share(Strip::A1)),
            ("A2 (beats: no steady 1:1 motion)", share(Strip::A2)),
        ];
        if strips.iter().map(|(_, share)| share).sum::<f64>() <= STRIPS {
            return None;
        }
        let there = strips.iter().filter(|(_, share)| *share > 0.0);
        let Some(_) = &task.band else {
            let names: Vec<&str> = there.map(|(name, _)| *name).collect();
            return Some(format!(
                "With the optimum the case lies in strip {}.",
                names.join(" and ")
            ));
        };
        let there: Vec<String> =
            there.map(|(name, share)| format!("{} in strip {name}", self.value(*share))).collect();
        Some(format!("Of the band, the optimum has {}.", there.join(" and ")))
    }

    /// On which bounds the best lies, but for those that no restitution can pass.
    fn at_bounds(&self) -> Option<String> {
        let ends = self.found.task.bounds.iter().filter_map(|bounds| {
            let Bounds { variable, from, to } = *bounds;
            let value = value_of(variable, &self.found.best.choice);
            let passable =
                |end: &f64| variable != Variable::Restitution || (*end > 0.0 && *end < 1.0);
            let near = |end: &f64| (value - end).abs() <= ON_BOUND * end;
            let end = [from, to].into_iter().filter(passable).find(near)?;
            Some(self.variable(variable, end))
        });
        let ends: Vec<String> = ends.collect();
        let joined = ends.join(" and ");
        (!ends.is_empty()).then(|| {
            format!("The optimum lies on a bound: {joined}; wider bounds may hold a better one.")
        })
    }

    /// An absorber, by what of it is chosen.
    pub fn absorber(&self, choice: &AbsorberDesign) -> String {
        let bounds = self.found.task.bounds.iter();
        let values =
            bounds.map(|bounds| self.variable(bounds.variable, value_of(bounds.variable, choice)));
        values.collect::<Vec<_>>().join(", ")
    }

    /// A place of the band.
    pub fn at(&self, at: f64) -> String {
        let over = if self.over_amplitude() { BandOver::Amplitude } else { BandOver::Frequency };
        self.units.band_text(over, at)
    }

    /// Whether the band is one of amplitudes.
    pub fn over_amplitude(&self) -> bool {
        let band = self.found.task.band.as_ref();
        band.is_some_and(|band| band.over == BandOver::Amplitude)
    }

    /// How it was found, where that depends on the case.
    pub fn method(&self) -> Vec<String> {
        let found = self.found;
        let mut sentences = vec![format!(
            "Every absorber that is shown was judged as `vinesink check` judges its case: {} of them, criteria and all motions over the whole band included.",
            found.judged.len()
        )];
        sentences.push(match self.is_amplitude() {
            true => "A coarse survey of the band at 97 clearances proposes, and the neighbours of the best are judged until they are closer than 1 %.".to_owned(),
            false => "Shares and margins are roots of the theory and of exact orbits: they are looked at everywhere between the bounds and narrowed down around the best.".to_owned(),
        });
        if let Some(robust) = &found.robust {
            sentences.push(format!(
                "An expectation is a Gauss quadrature with {} points for each uncertain parameter, {} evaluations of the objective: Hermite's for a standard deviation, Legendre's for an error that is evenly distributed. A corner has every parameter at its largest error, or at two standard deviations.",
                robust.nodes, robust.combinations
            ));
        }
        sentences
    }

    /// The paper's claim on the case.
    pub fn claim(&self) -> Vec<String> {
        let Some(claim) = &self.found.claim else {
            return vec![
                "At the case's own excitation no clearance has a stable 1:1 orbit.".to_owned(),
            ];
        };
        let own = self.found.own.choice.clearance;
        let length = |over: f64| self.lengths.text(over * own);
        let (best, end) = (length(claim.best_clearance), length(claim.end_clearance));
        vec![
            "The paper (section 3.4, the red cross of Fig. 6c) expects the smallest amplitude where the 1:1 motion disappears.".to_owned(),
            format!(
                "At the case's own excitation the stable 1:1 orbit vibrates least at {best}, with {}, and disappears at {end}{}, with {}.",
                length(claim.best_amplitude),
                claim.ends_by.map_or_else(String::new, |kind| format!(" ({kind})")),
                length(claim.end_amplitude),
            ),
            verdict(claim),
        ]
    }
}

/// Each uncertain parameter with its standard deviation, or with the largest error of a uniform one.
fn uncertain(case: &Case) -> Vec<String> {
    let inputs = case.inputs().iter();
    let given = inputs.filter(|input| input.table == "uncertainty" && input.value > 0.0);
    let words = given.map(|input| match input.largest_error() {
        Some(largest) => format!("{} ± {largest}, evenly", input.name),
        None => format!("{} with σ = {}", input.name, input.as_written),
    });
    words.collect()
}

fn verdict(claim: &Claim) -> String {
    let distance = percent(claim.distance());
    let excess = signed_percent(claim.excess());
    if claim.holds() {
        format!(
            "The claim holds here: the best clearance lies {distance} below that end, and the amplitude at the end differs by {excess}."
        )
    } else {
        format!(
            "The claim fails here by {distance} of the clearance: at the end the amplitude differs by {excess} from the best."
        )
    }
}
