//! What is said about an optimisation.

use crate::analysis::Strip;
use crate::band::theory;
use crate::case::{BandOver, Case, Choice, Objective, Scales};
use crate::optimize::claim::Claim;
use crate::optimize::confirm::largest;
use crate::optimize::task::value_of;
use crate::optimize::{Bounds, Deviation, Optimization, Variable};
use crate::report::numbers::{LengthFormat, fixed, percent, signed_percent, significant};
use crate::report::units::Units;

/// Digits of a clearance: as it is written.
const DIGITS: usize = 4;
/// Simulated amplitude over the promised one from which on the reader is told.
const SURPRISE: f64 = 1.02;
/// Relative distance from a bound within which a value lies on it: it may have been rounded.
const ON_BOUND: f64 = 1e-3;
/// Share of a band in strips from which on the reader is told.
const STRIPS: f64 = 0.01;

/// An optimisation with what turns its numbers into text.
pub(super) struct Words<'a> {
    pub found: &'a Optimization,
    pub scales: Scales,
    pub lengths: LengthFormat,
    units: Units,
    /// What is uncertain, as the case says it.
    pub uncertain: Vec<String>,
}

impl<'a> Words<'a> {
    pub fn new(case: &Case, found: &'a Optimization) -> Self {
        let scales = case.scales();
        Self {
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

    /// A score as the figure's ordinate.
    pub fn number(&self, score: f64) -> f64 {
        let value = self.found.task.value(score);
        match self.found.task.objective {
            Objective::WorstAmplitude => self.lengths.number(value),
            _ => 100.0 * value,
        }
    }

    /// A score with its unit.
    pub fn value(&self, score: f64) -> String {
        let value = self.found.task.value(score);
        match self.found.task.objective {
            _ if !score.is_finite() => "–".to_owned(),
            Objective::WorstAmplitude => self.lengths.text(value),
            // Robust and nominal optimum often differ by less than a per cent.
            _ => format!("{} %", fixed(100.0 * value, 1)),
        }
    }

    /// The ordinate's name.
    pub fn axis(&self) -> String {
        match self.found.task.objective {
            Objective::Z3Share => "share in area Z3 (%)".to_owned(),
            Objective::StableShare => "share with a stable 1:1 orbit (%)".to_owned(),
            Objective::WorstAmplitude => format!("worst amplitude ({})", self.lengths.unit),
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
            (Objective::WorstAmplitude, true) => "Largest amplitude over the band",
            (Objective::WorstAmplitude, false) => "Amplitude at the case's excitation",
            (Objective::Margin, true) => "Smallest margin in clearance over the band",
            (Objective::Margin, false) => "Margin in clearance at the case's excitation",
        }
    }

    /// The answer.
    pub fn headline(&self) -> String {
        let best = &self.found.nominal;
        let what = self.objective_words();
        if !self.found.reached() {
            return format!(
                "Nothing between the bounds reaches it. {what}: {}.",
                self.value(best.judged())
            );
        }
        let at = self.length(best.choice.clearance);
        format!("Best clearance {at}. {what}: {}.", self.value(best.judged()))
    }

    /// What the case's own absorber reaches.
    pub fn against_own(&self) -> String {
        let own = &self.found.own;
        let at = self.length(own.choice.clearance);
        format!("The case itself, at {at}, has {}.", self.value(own.judged()))
    }

    /// What follows from the rest, a sentence each.
    pub fn sentences(&self) -> Vec<String> {
        let best = &self.found.nominal;
        let mut sentences = vec![self.against_own()];
        if !self.found.reached() {
            return sentences;
        }
        let [low, high] = best.plateau;
        if high > low * 1.001 {
            let [low, high] = [low, high].map(|end| self.lengths.text(end));
            sentences.push(format!(
                "Clearances from {low} to {high} are as good; the middle of them is chosen."
            ));
        }
        sentences.extend(self.strips());
        sentences.extend(self.at_bounds());
        if let Some(robust) = &self.found.robust {
            let expected = |score: Option<f64>| self.value(score.unwrap_or(f64::NAN));
            sentences.push(format!(
                "Expected under what is uncertain it has {}; the robust optimum, at {}, has {}.",
                expected(best.expected),
                self.length(robust.choice.clearance),
                expected(robust.expected),
            ));
            if self.found.task.band.is_none() && self.found.task.objective != Objective::Margin {
                sentences.push(format!(
                    "At one excitation the objective jumps, which {} points for each parameter resolve coarsely.",
                    self.found.task.nodes()
                ));
            }
        }
        sentences.extend(self.dropped());
        sentences.extend(self.contradictions());
        sentences
    }

    /// A variable of an absorber, or a bound of it, with its name.
    fn variable(&self, variable: Variable, value: f64) -> String {
        match variable {
            Variable::Clearance => format!("clearance {}", self.length(value)),
            Variable::Restitution => format!("restitution {}", significant(value, 4)),
            Variable::Mass => format!("mass {} g", significant(1e3 * value, 4)),
        }
    }

    /// How much of the share in Z3 is in strips, where the motion is not, or not always, a steady 1:1 one.
    fn strips(&self) -> Option<String> {
        let task = &self.found.task;
        if task.objective != Objective::Z3Share {
            return None;
        }
        let (band, _) = task.band_of(&self.found.nominal.choice, &Deviation::default())?;
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

    /// On which bounds the winners lie, but for those that no restitution can pass.
    fn at_bounds(&self) -> Option<String> {
        let on = |choice: &Choice| -> Vec<String> {
            let ends = self.found.task.bounds.iter().filter_map(|bounds| {
                let Bounds { variable, from, to } = *bounds;
                let value = value_of(variable, choice);
                let passable =
                    |end: &f64| variable != Variable::Restitution || (*end > 0.0 && *end < 1.0);
                let near = |end: &f64| (value - end).abs() <= ON_BOUND * end;
                let end = [from, to].into_iter().filter(passable).find(near)?;
                Some(self.variable(variable, end))
            });
            ends.collect()
        };
        let best = on(&self.found.nominal.choice);
        let robust = self.found.robust.as_ref().map_or_else(Vec::new, |robust| on(&robust.choice));
        let joined = |ends: &[String]| ends.join(" and ");
        let which = match (best.is_empty(), robust.is_empty()) {
            (true, true) => return None,
            (false, false) if best == robust => {
                format!("The optimum and the robust one lie on a bound: {}", joined(&best))
            }
            (false, false) => format!(
                "The optimum lies on a bound ({}), and so does the robust one ({})",
                joined(&best),
                joined(&robust)
            ),
            (false, true) => format!("The optimum lies on a bound: {}", joined(&best)),
            (true, false) => format!("The robust optimum lies on a bound: {}", joined(&robust)),
        };
        Some(format!("{which}; wider bounds may hold a better one."))
    }

    /// An absorber, by what of it is chosen.
    pub fn absorber(&self, choice: &Choice) -> String {
        let bounds = self.found.task.bounds.iter();
        let values =
            bounds.map(|bounds| self.variable(bounds.variable, value_of(bounds.variable, choice)));
        values.collect::<Vec<_>>().join(", ")
    }

    /// Which candidate of the search was dropped, and why; `None` where none was simulated.
    fn dropped(&self) -> Option<String> {
        let candidates = &self.found.candidates;
        let first = candidates.first()?;
        let (best, count) = (&self.found.nominal, candidates.len());
        let starts = self.found.confirmed.first().map_or(0, |place| place.starts);
        if first.choice == best.choice {
            let others = if count == 1 { String::new() } else { format!(" of {count} candidates") };
            return Some(format!(
                "Best in the search, it is also the best{others} as simulated from {starts} starts at each place, where the search takes two."
            ));
        }
        Some(format!(
            "The search alone would have chosen {}, with {}; from {starts} starts at each place simulation finds {} there, so that it was dropped for the best of {count} candidates as simulated.",
            self.length(first.choice.clearance),
            self.value(first.score),
            self.value(first.simulated),
        ))
    }

    /// Where simulation contradicts the answer; empty where it does not.
    fn contradictions(&self) -> Vec<String> {
        let places = &self.found.confirmed;
        let mut sentences = Vec::new();
        let [promised, found] = [self.found.nominal.score, self.found.nominal.judged()]
            .map(|score| self.found.task.value(score));
        if found > promised * SURPRISE && !self.found.candidates.is_empty() {
            sentences.push(format!(
                "Exact orbits and two starts at each place promise {}; what counts is what more starts lead to.",
                self.lengths.text(promised)
            ));
        }
        let lost = places.iter().filter(|place| place.exact.is_some() && place.as_predicted == 0);
        let lost: Vec<String> = lost.map(|place| self.at(place.at)).collect();
        if !lost.is_empty() {
            sentences.push(format!(
                "At {} the exact orbit is stable, yet no start of the simulation led to it.",
                lost.join(", ")
            ));
        }
        sentences
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

    /// What simulation says.
    pub fn confirmed(&self) -> String {
        let places = &self.found.confirmed;
        let orbit = places.iter().filter(|place| place.exact.is_some()).count();
        let all = places.iter().filter(|place| place.is_as_predicted());
        let several = places.iter().filter(|place| place.motions > 1).count();
        let largest = largest(places).map_or_else(String::new, |largest| {
            format!(" The largest amplitude that was simulated is {}.", self.lengths.text(largest))
        });
        let (count, all) = (places.len(), all.count());
        let place = if count == 1 { "place" } else { "places" };
        let starts = places.first().map_or(0, |place| place.starts);
        let asleep = places.iter().filter(|place| place.asleep > 0).count();
        let asleep = match asleep {
            0 => String::new(),
            _ => format!(
                " From rest the absorber never wakes at {asleep} of the places, and the oscillator moves as if it were bare."
            ),
        };
        format!(
            "From {starts} starts, one of them from rest, at each of {count} {place}: an exact symmetric orbit attracts at {orbit}, and every start that wakes the absorber led to it at {all} of these; at {several} of all places there are several motions with impacts.{asleep}{largest}"
        )
    }

    /// How it was found, where that depends on the case.
    pub fn method(&self) -> Vec<String> {
        let task = &self.found.task;
        let mut sentences = Vec::new();
        if task.objective == Objective::WorstAmplitude {
            sentences.push("Where no orbit attracts the search simulates two starts, which may miss a larger motion: its best candidates all over the bounds, and more around the best of these, are therefore simulated from many starts, and the best as simulated is chosen.".to_owned());
        }
        if task.uncertainty.is_any() {
            sentences.push(format!(
                "An expectation is a Gauss quadrature with {} points for each uncertain parameter, {} evaluations of the objective: Hermite's for a standard deviation, Legendre's for an error that is evenly distributed.",
                task.nodes(),
                task.deviations().len(),
            ));
        }
        if task.uncertainty.is_any() && task.objective == Objective::WorstAmplitude {
            sentences.push("The robust optimum is the best of these candidates, an expectation counting as no better than what simulation finds as written.".to_owned());
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
