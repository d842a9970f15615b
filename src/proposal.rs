//! A first guess of an absorber for a structure, by closed forms: mass ratio, clearance, restitution. Each guess is judged as
//! `check` judges the case that is written, and corrected by a search around it.
//!
//! For the program itself: this module may change at any time.

use crate::answer::{Answer, Asked, Decided};
use crate::case::{Case, CaseError, Objective, Problem, Rounding, StartingLine};
use crate::criteria::{Judged, all_hold};
use crate::executor::Executor;
use crate::flights::DrivenError;
use crate::measure::Measure;
use crate::operating_range::{Edge, edges};
use crate::optimize::design::missed_by;
use crate::optimize::guess::{self, MISSES};
use crate::optimize::{self, OptimizeError, Task};
use crate::quantity::numbers::rounded_to;
use crate::study::StudyError;
use crate::system::Parameter;
use crate::transient::best_clearance;

/// How the structure is set in motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drive {
    /// A harmonic force on it.
    Force,
    /// A harmonic motion of its base.
    Base,
    /// It is let go from a displacement.
    Release,
}

impl Drive {
    /// The kind of excitation of the case.
    pub const fn kind(self) -> &'static str {
        match self {
            Self::Force => "force",
            Self::Base => "base-displacement",
            Self::Release => "free",
        }
    }
}

/// What an engineer says of a structure and of the absorber, each as a case file has it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wish {
    /// Mass of the structure.
    Mass,
    /// Its natural frequency.
    Frequency,
    /// Its damping ratio.
    Damping,
    /// Amplitude of the force or of the base, or the displacement from which it is let go.
    Excitation,
    /// The largest displacement that is allowed, or the longest time to come to rest.
    Limit,
    /// The excitation frequencies that occur: from, to.
    Band,
    /// Mass of the absorber over that of the structure.
    MassRatio,
    /// Restitution of its walls.
    Restitution,
}

impl Wish {
    /// The lines of a case that say it.
    fn lines(self, drive: Drive, given: &[String]) -> Vec<StartingLine> {
        let (table, keys): (_, &[&'static str]) = match (self, drive) {
            (Self::Mass, _) => ("oscillator", &["mass"]),
            (Self::Frequency, _) => ("oscillator", &["frequency"]),
            (Self::Damping, _) => ("oscillator", &["damping_ratio"]),
            (Self::Excitation, Drive::Release) => ("excitation", &["displacement"]),
            (Self::Excitation, _) => ("excitation", &["amplitude"]),
            (Self::Limit, Drive::Release) => ("criteria", &["decay_time"]),
            (Self::Limit, _) => ("criteria", &["peak_displacement"]),
            (Self::Band, _) => ("band", &["from", "to"]),
            (Self::MassRatio, _) => ("absorber", &["mass_ratio"]),
            (Self::Restitution, _) => ("absorber", &["restitution"]),
        };
        let line = |(key, written): (&&'static str, &String)| match self {
            Self::Limit => StartingLine::new(table, key, &format!("<= {}", written.trim())),
            _ => StartingLine::new(table, key, written),
        };
        keys.iter().zip(given).map(line).collect()
    }

    /// What a case file with it would be refused for; none of what it may be. A share without a per cent sign that a case would be
    /// warned of is one, for nobody reads the warnings of what is written.
    pub fn refused(self, drive: Drive, given: &[String]) -> Option<Problem> {
        let text = Case::starting_text_with("t", drive.kind(), &self.lines(drive, given));
        let is_share = matches!(self, Self::Damping | Self::MassRatio);
        match Case::parse("t", &text) {
            Err(error) => error.problems().next().cloned(),
            Ok(case) if is_share && !given.iter().any(|one| one.contains('%')) => {
                let own = |one: &&Problem| {
                    given.iter().any(|given| one.underlined.contains(given.trim()))
                };
                case.warnings().iter().find(own).cloned()
            }
            Ok(_) => None,
        }
    }
}

/// All that was said.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Wishes {
    /// How the structure is set in motion.
    pub drive: Drive,
    /// What was said, once each.
    pub given: Vec<(Wish, Vec<String>)>,
}

/// Why there is no proposal.
#[derive(Debug, thiserror::Error)]
pub enum ProposalError {
    /// What was said makes no case.
    #[error(transparent)]
    Case(#[from] Box<CaseError>),
    /// No absorber can be judged.
    #[error(transparent)]
    Optimize(#[from] OptimizeError),
    /// The case cannot be judged.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// A motion cannot be followed.
    #[error(transparent)]
    Driven(#[from] DrivenError),
}

/// Why a mass ratio is proposed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Why {
    /// It was given.
    Given,
    /// Nothing was asked that could decide.
    Usual,
    /// The smallest of [`MASS_RATIOS`] with which the limit holds.
    Smallest,
    /// None holds it; this one comes closest.
    Closest,
}

/// A proposed design.
#[derive(Debug, Clone)]
pub struct Proposal {
    /// The text of its case.
    pub text: String,
    /// The case.
    pub case: Case,
    /// What `check` says of it.
    pub answer: Answer,
    /// Why it has its mass.
    pub why: Why,
    /// Smaller mass ratios that do not hold the limit: by closed form, and judged.
    pub ruled_out: [Vec<f64>; 2],
    /// Whether its restitution was given.
    pub given_restitution: bool,
    /// The clearance by closed form alone.
    pub guessed: f64,
    /// Numbers a fiftieth beside which it no longer does what is said.
    pub edges: Vec<Edge>,
}

/// Mass ratios that are proposed, and the one where no limit decides.
pub const MASS_RATIOS: [f64; 5] = [0.01, 0.02, 0.03, 0.05, 0.1];
const USUAL_MASS_RATIO: f64 = 0.02;
/// Restitution unless given: a wall that takes nine tenths of the energy of an impact, as rubber or wood does; about resonance
/// the vibration is smallest near it (`docs/src/choose.md`).
pub const RESTITUTION: f64 = 0.3;
/// Half of the band about the natural frequency where none is given: an absorber of 10 % of the mass, moving with the
/// structure, lowers its resonance by 5 %, and a natural frequency is hardly known to another 5 %.
pub const HALF_BAND: f64 = 0.1;
/// Factor by which the closed form of the clearance may miss the best of a release, in which the absorber passes through
/// every regime.
const MISSES_OF_RELEASE: f64 = 4.0;
/// Part of its clearance that a proposal at an edge gives up at once, and how often.
const STEP: f64 = 0.05;
const STEPS: u32 = 6;

impl Wishes {
    /// The case with the first absorber that is looked at, by closed form.
    ///
    /// # Errors
    /// [`CaseError`] where what was said makes no case.
    pub fn first(&self, title: &str) -> Result<Case, Box<CaseError>> {
        let (_, case) = self.case(title, MASS_RATIOS[0], "1 mm")?;
        Ok(self.case(title, MASS_RATIOS[0], &written(guess::clearance(&case)[0]))?.1)
    }

    /// The case with an absorber of a mass ratio; its clearance is of no meaning yet.
    fn case(
        &self,
        title: &str,
        mass_ratio: f64,
        clearance: &str,
    ) -> Result<(String, Case), Box<CaseError>> {
        let read = |lines: &[StartingLine]| {
            let text = Case::starting_text_with(title, self.drive.kind(), lines);
            Case::parse(&format!("{title}.toml"), &text).map_err(Box::new).map(|case| (text, case))
        };
        let line = |table, key, written: &str| StartingLine::new(table, key, written);
        let of = |wish| self.given.iter().find(|(one, _)| *one == wish).map(|(_, given)| given);
        let source = "first guess of `vinesink new`; say here where each number comes from";
        let mut lines = vec![line("", "source", source)];
        lines.extend(self.given.iter().flat_map(|(wish, given)| wish.lines(self.drive, given)));
        if of(Wish::MassRatio).is_none() {
            lines.push(line(
                "absorber",
                "mass_ratio",
                &format!("{} %", rounded_to(100.0 * mass_ratio, 3)),
            ));
        }
        if of(Wish::Restitution).is_none() {
            lines.push(line("absorber", "restitution", &RESTITUTION.to_string()));
        }
        lines.push(line("absorber", "clearance", clearance));
        if self.drive == Drive::Release {
            return read(&lines);
        }
        let frequency = of(Wish::Frequency).and_then(|given| given.first());
        lines.extend(frequency.map(|own| line("excitation", "frequency", own)));
        let (text, case) = read(&lines)?;
        let hertz = case.units().frequency(1.0);
        match (of(Wish::Band), &case.band) {
            (Some(ends), Some(band)) => {
                let [from, to] = band.range;
                let nearest = if to < 1.0 { ends.get(1) } else { ends.first() };
                let Some(nearest) = nearest.filter(|_| to < 1.0 || from > 1.0) else {
                    return Ok((text, case));
                };
                lines.retain(|one| (one.table, one.key) != ("excitation", "frequency"));
                lines.push(line("excitation", "frequency", nearest));
            }
            _ => {
                let ends = [("from", 1.0 - HALF_BAND), ("to", 1.0 + HALF_BAND)];
                lines.extend(ends.map(|(key, factor)| {
                    line("band", key, &format!("{} Hz", rounded_to(factor * hertz, 4)))
                }));
            }
        }
        read(&lines)
    }
}

/// A length as a person writes it.
fn written(length: f64) -> String {
    match length {
        small if small < 1e-5 => format!("{} um", rounded_to(1e6 * small, 4)),
        long => format!("{} mm", rounded_to(1e3 * long, 4)),
    }
}

/// A design that was judged.
#[derive(Clone)]
struct Candidate {
    mass_ratio: f64,
    text: String,
    case: Case,
    judged: Vec<Judged>,
    guessed: f64,
}

impl Candidate {
    /// The best clearance about the one that the closed form has.
    fn of(
        (text, case): (String, Case),
        mass_ratio: f64,
        guessed: f64,
        on: &dyn Executor,
    ) -> Result<Self, ProposalError> {
        let mut within = case.clone();
        let spread = if case.design.release().is_some() { MISSES_OF_RELEASE } else { MISSES };
        within.optimize.clearance = Some([guessed / spread, guessed * spread]);
        if case.design.release().is_some() {
            let best = best_clearance(&within, on).map_or(case.design, |best| best.design);
            let own = Self { mass_ratio, text, case, judged: Vec::new(), guessed };
            return own.with_clearance(best.clearance(), Rounding::Down, on);
        }
        let task = Task::of(&within, Some(Objective::WorstAmplitude))?;
        let best = optimize::best_of_few(&task, &text, on)?;
        let optimize::JudgedDesign { written, criteria: judged, .. } = best;
        Ok(Self { mass_ratio, text: written.text, case: written.case, judged, guessed })
    }

    fn with_clearance(
        self,
        clearance: f64,
        rounding: Rounding,
        on: &dyn Executor,
    ) -> Result<Self, ProposalError> {
        let design = self.case.design.with(Parameter::Clearance, clearance);
        let written = self.case.rewritten("the case", &self.text, &design, rounding);
        let written = written.map_err(OptimizeError::from)?;
        let judged = Answer::of(&written.case, Asked::Criteria, None, on)?.judged;
        Ok(Self { text: written.text, case: written.case, judged, ..self })
    }

    fn edges(&self, on: &dyn Executor) -> Result<Vec<Edge>, DrivenError> {
        let release = self.case.design.release().is_some();
        let watched = if release { Measure::DecayTime } else { Measure::Peak };
        edges(&self.case, Some(watched), &self.case.effort(), on)
    }
}

impl Proposal {
    /// Proposes a design under a title: the smallest mass ratio with which the limit holds, and the best clearance about the
    /// one of the closed form, moved away from an edge.
    ///
    /// # Errors
    /// [`ProposalError`] where what was said makes no case, or a case cannot be judged.
    pub fn of(title: &str, wishes: &Wishes, on: &dyn Executor) -> Result<Self, ProposalError> {
        let has = |wish| wishes.given.iter().any(|(one, _)| *one == wish);
        let ratios: &[f64] = match (has(Wish::MassRatio), has(Wish::Limit)) {
            (false, true) => &MASS_RATIOS,
            _ => &[USUAL_MASS_RATIO],
        };
        let mut best: Option<Candidate> = None;
        let mut ruled_out = [Vec::new(), Vec::new()];
        for (k, ratio) in ratios.iter().enumerate() {
            let (_, case) = wishes.case(title, *ratio, "1 mm")?;
            let [clearance, promised] = guess::clearance(&case);
            let limit = case.criteria.first().map_or(f64::INFINITY, |one| one.limit);
            // The closed form is not so far off.
            if promised > MISSES * limit && k + 1 < ratios.len() {
                ruled_out[0].push(*ratio);
                continue;
            }
            let (text, case) = wishes.case(title, *ratio, &written(clearance))?;
            let found = Candidate::of((text, case), *ratio, clearance, on)?;
            let missed = |one: &Candidate| missed_by(&one.judged);
            let holds = all_hold(&found.judged);
            if best.as_ref().is_none_or(|known| holds || missed(&found) < missed(known)) {
                best = Some(found);
            }
            if holds {
                break;
            }
            ruled_out[1].push(*ratio);
        }
        let Some(mut best) = best else { return Err(OptimizeError::Nowhere.into()) };
        let holds = all_hold(&best.judged);
        let mut beside = best.edges(on)?;
        for step in 1..=STEPS {
            if beside.is_empty() {
                break;
            }
            let clearance = (1.0 - f64::from(step) * STEP) * best.case.design.clearance();
            let further =
                best.clone().with_clearance(rounded_to(clearance, 3), Rounding::Nearest, on)?;
            let there = further.edges(on)?;
            if all_hold(&further.judged) == holds && there.is_empty() {
                (best, beside) = (further, there);
            }
        }
        let why = match (has(Wish::MassRatio), has(Wish::Limit)) {
            (true, _) => Why::Given,
            (_, false) => Why::Usual,
            _ if holds => Why::Smallest,
            _ => Why::Closest,
        };
        // Written once more, with the clearance in its place.
        let Candidate { mass_ratio, guessed, ref case, .. } = best;
        let (text, case) = wishes.case(title, mass_ratio, &written(case.design.clearance()))?;
        let answer = Answer::of(&case, Asked::Decision, None, on)?;
        let decides = Decided { alternatives: true, ..Decided::NOTHING };
        let answer = answer.decided(&case, decides, on)?;
        let given_restitution = has(Wish::Restitution);
        Ok(Self { text, case, answer, why, ruled_out, given_restitution, guessed, edges: beside })
    }
}
