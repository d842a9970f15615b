//! Work far beyond what is ordinary: said before it begins, and done only if it is asked for.

mod work;

use std::path::Path;

use clap::Args;
use miette::{Result, miette};
use vinesink::answer::Decided;
use vinesink::answer::several::{LeftOut, ORDINARY, ORDINARY_PROBABILITY};
use vinesink::case::{Case, Problem};
use vinesink::excitation::Scene;
use vinesink::operating_range::Reliability;
use vinesink::program::output;
use vinesink::program::progress::{Progress, duration};

use work::slowness;
pub use work::{BEST_ANSWER, Work};

/// Cases beside a case: where its frequency is another, and where one of its numbers is.
const DRIFTS: u64 = 8;
const VARIANTS: u64 = 20;
/// Designs with another amplitude and another natural frequency, with windows as long as those of `check`.
const COMBINED: u64 = 2 * 16;
/// Seconds of a whole sweep that are ordinary, on all processors of this machine: the largest that is shipped takes a
/// minute and a half on two.
const ORDINARY_SWEEP: f64 = 3600.0;

/// What is left out, where it is.
const ALTERNATIVES: &str = "the tuned mass dampers beside the absorber are";
const RANGES: &str = "the ranges over which the criteria hold are";
const COMBINATIONS: &str = "the combinations of amplitude and frequency are";
const PROBABILITY: &str = "the probability that the criteria hold is";

/// Whether more than the ordinary is asked for.
#[derive(Debug, Clone, Copy, Args)]
pub struct Long {
    /// Begin even where the work is far beyond what is ordinary
    #[arg(long)]
    long: bool,
}

impl Long {
    /// Lets ordinary work pass, and any that is asked for.
    pub fn allows(self, path: &Path, case: &Case, work: &[Work]) -> Result<()> {
        let seconds = seconds(work);
        if self.long || seconds <= ORDINARY {
            return Ok(());
        }
        let longest = work.iter().max_by(|a, b| a.seconds().total_cmp(&b.seconds()));
        let what = longest.map(Work::to_string).unwrap_or_default();
        refused(path, &slips(case.warnings()), seconds, &what)
    }

    /// What of that which is asked is looked at beside so much work; what takes too long is left out, and said.
    pub fn decides(self, path: &Path, case: &Case, work: &[Work], asked: Decided) -> Decided {
        let own = seconds(work);
        let allowed_in = |ordinary: f64, what: &str, variants: u64| {
            let seconds = seconds(&Work::variants(case, variants));
            self.affords(path, own + seconds <= ordinary, seconds, what)
        };
        let allowed = |what: &str, variants: u64| allowed_in(ORDINARY, what, variants);
        Decided {
            alternatives: asked.alternatives && allowed(ALTERNATIVES, DRIFTS),
            ranges: match variants(case, asked) {
                0 => &[],
                some if allowed(RANGES, some) => asked.ranges,
                _ => &[],
            },
            until: asked.until,
            combined: asked.combined
                && !case.criteria.is_empty()
                && allowed(COMBINATIONS, COMBINED),
            reliability: asked.reliability
                && drawn(case) > 0
                && allowed_in(ORDINARY_PROBABILITY, PROBABILITY, drawn(case)),
        }
    }

    /// Whether something that takes so many seconds is looked for beside other work; it is left out, and that is said, where it is too
    /// long.
    pub fn affords_beside(
        self,
        path: &Path,
        what: LeftOut,
        seconds: f64,
        is_ordinary: bool,
    ) -> bool {
        let what = match what {
            LeftOut::Alternatives => ALTERNATIVES,
            LeftOut::Ranges => RANGES,
            LeftOut::Combinations => COMBINATIONS,
            LeftOut::Probability => PROBABILITY,
        };
        self.affords(path, is_ordinary, seconds, what)
    }

    fn affords(self, path: &Path, is_ordinary: bool, seconds: f64, what: &str) -> bool {
        let affords = self.long || is_ordinary;
        if !affords {
            output::complain(&format!(
                "{}: {what} left out, which would take about {}; add --long for them",
                path.display(),
                duration(seconds)
            ));
        }
        affords
    }

    /// The same of a whole sweep, so many seconds on all processors, which was measured or is `what`.
    pub fn allows_sweep(
        self,
        path: &Path,
        warnings: &[Problem],
        seconds: f64,
        what: &str,
    ) -> Result<()> {
        if self.long || seconds <= ORDINARY_SWEEP {
            return Ok(());
        }
        refused(path, &slips(warnings), seconds, what)
    }

    /// The same of other work, so many seconds.
    pub fn allows_seconds(self, path: &Path, seconds: f64, what: &str) -> Result<()> {
        if self.long || seconds <= ORDINARY {
            return Ok(());
        }
        refused(path, "", seconds, what)
    }
}

/// What may be wrong with a case, before what can be done.
fn slips(warnings: &[Problem]) -> String {
    let told = |one: &Problem| Some(format!("line {}: {}; ", one.line, one.help.as_ref()?));
    warnings.iter().filter_map(told).collect()
}

/// That work would take too long, behind what may be wrong with the case.
fn refused(path: &Path, slips: &str, seconds: f64, what: &str) -> Result<()> {
    Err(miette!(
        help = format!("{slips}to do it all the same, add --long"),
        "{} would take about {}: {}",
        path.display(),
        duration(seconds),
        what
    ))
}

/// Designs that are looked at for the ranges of a case.
fn variants(case: &Case, asked: Decided) -> u64 {
    // At a single excitation there are more, each as thorough as the case itself.
    let is_point = case.design.scene() == Scene::Steady && case.range().is_point();
    let each = if is_point { 8 * VARIANTS } else { VARIANTS };
    if case.criteria.is_empty() { 0 } else { each * asked.ranges.len() as u64 }
}

/// Designs that are looked at for the probability that criteria hold, each as `check` does, over those that are looked at less
/// thoroughly; a release has no such look, and its causes are looked for as well.
fn drawn(case: &Case) -> u64 {
    let each = match case.design.scene() {
        Scene::Steady => 4,
        Scene::Release => 2,
        Scene::Sweep | Scene::Record => 6,
    };
    each * u64::from(Reliability::samples(case))
}

/// About how many seconds work takes.
pub fn seconds(work: &[Work]) -> f64 {
    work.iter().map(Work::seconds).sum()
}

/// Seconds for what is looked at beside a case.
pub fn of_decision(case: &Case, decides: Decided) -> f64 {
    let alternatives = if decides.alternatives { DRIFTS } else { 0 };
    let combined = if decides.combined { COMBINED } else { 0 };
    let reliability = if decides.reliability { drawn(case) } else { 0 };
    let variants = variants(case, decides) + alternatives + combined + reliability;
    if variants == 0 { 0.0 } else { seconds(&Work::variants(case, variants)) }
}

/// Progress of work on a case that cannot be counted, with so many seconds besides; flights that are not steady can. How long it will be is estimated when it
/// is told: the constants above are of ordinary motions, and chattering, or a transient that is stiff, takes ten times as
/// long.
pub fn progress(name: &str, case: &Case, work: &[Work], besides: f64) -> Option<Progress> {
    let (expected, system) = (seconds(work), case.system());
    let steady = case.design.scene() == Scene::Steady;
    steady.then(|| Progress::estimated(name, move || besides + expected * slowness(&system)))
}
