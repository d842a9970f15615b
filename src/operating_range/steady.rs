//! Cases of one mode with one absorber as a search for ranges sees them.

use super::{Depth, Together, Uncertain, Varied, Varies};
use crate::band::{Band, Survey, SurveySettings};
use crate::case::{Case, Criterion, Uncertainty};
use crate::criteria::contact::{judge_in_contact, judge_transient_in_contact};
use crate::criteria::{self, Judged};
use crate::excitation::Transient;
use crate::executor::Serial;
use crate::flights::{DrivenError, Places};
use crate::motions::{BandEffort, Effort, Misses, Motions};
use crate::system::Parameter;
use crate::transient::Study;

/// How thoroughly a band is looked at on the way, and starts of a place.
const BAND: BandEffort =
    BandEffort { even: 9, starts: 3, starts_between: 2, most: 24, tolerance: 0.1 };
const STARTS: u32 = 8;
/// Places that are searched again at a time, the worst first.
const AT_A_TIME: usize = 8;
/// Places of the absorber in a sweep, and under a record, each of which is long.
const PLACES_OF_SWEEP: u64 = 16;
const PLACES_OF_RECORD: u64 = 4;

impl Varies for Case {
    type Effort = Effort;
    type Error = DrivenError;

    fn parameter(&self, number: Varied) -> Option<Parameter> {
        number.parameter(self)
    }

    fn parts(&self, _: Parameter) -> Vec<Option<usize>> {
        vec![None]
    }

    fn number(&self, number: Parameter, _: Option<usize>) -> Option<f64> {
        self.design.value(number)
    }

    fn with(&self, number: Parameter, _: Option<usize>, value: f64) -> Option<Self> {
        self.varied(number, value)
    }

    fn tolerance(&self, number: Varied) -> Option<(f64, f64)> {
        number.tolerance(self)
    }

    fn mirrors(&self, number: Varied) -> bool {
        number == Varied::Inclination && self.has_ideal_walls()
    }

    fn is_short(&self) -> bool {
        match self.design.transient() {
            None => self.range().is_point(),
            Some(transient) => matches!(transient, Transient::Release(_)),
        }
    }

    fn is_point(&self) -> bool {
        self.design.transient().is_none() && self.range().is_point()
    }

    fn judge(&self, effort: &Effort, how: Depth) -> Result<Vec<Judged>, DrivenError> {
        judge(self, effort, how.of(self))
    }

    fn kept_without_absorber(&self) -> bool {
        criteria::kept_without_absorber(self)
    }

    fn criteria(&self) -> &[Criterion] {
        &self.criteria
    }

    fn uncertainty(&self) -> &Uncertainty {
        &self.uncertainty
    }

    fn deviating(&self, errors: &[(Uncertain, f64)]) -> Option<Self> {
        let errors: Vec<_> = errors.iter().map(|(one, error)| (one.parameter, *error)).collect();
        Self::deviating(self, &errors)
    }

    fn fails_unflown(&self) -> Result<bool, DrivenError> {
        let mut unflown = self.clone();
        unflown.criteria.retain(|one| !one.measure.is_of_motions());
        if unflown.criteria.is_empty() || !criteria::needs_simulation(&self.criteria) {
            return Ok(false);
        }
        Ok(Together::of(&unflown.judge(&self.effort(), Depth::AsCheck)?) == Together::Fail)
    }
}

/// The criteria of a case.
fn judge(case: &Case, effort: &Effort, how: Depth) -> Result<Vec<Judged>, DrivenError> {
    let Some(transient) = case.design.transient() else {
        return judge_band(case, effort, how);
    };
    let even = case.absorber_places().unwrap_or_default();
    let in_full = how != Depth::OnTheWay;
    let most = match transient {
        _ if in_full => even,
        Transient::Release(_) => even,
        Transient::Sweep(_) => PLACES_OF_SWEEP,
        Transient::Record(_) => PLACES_OF_RECORD,
    };
    let shaking = case.asks_for_shaking();
    let places = Places { even: even.min(most), closer: in_full, shaking, executor: &Serial };
    let Some(study) = Study::brief_of_case(case, places) else { return Ok(Vec::new()) };
    let study = study?;
    let again = |case: &Case| match Study::brief_of_case(case, places) {
        Some(found) => found,
        None => Ok(study.clone()),
    };
    judge_transient_in_contact(case, &study, again)
}

/// Those of a case that is driven steadily.
fn judge_band(case: &Case, effort: &Effort, how: Depth) -> Result<Vec<Judged>, DrivenError> {
    let survey = |effort: Effort| {
        let settings = criteria::settings(case);
        let settings = SurveySettings { effort: settings.effort.map(|_| effort), ..settings };
        Survey::of(&case.range(), &settings, None, &Serial)
    };
    let again = |band: &Band, settings: &SurveySettings| Survey::of(band, settings, None, &Serial);
    let few = Effort { starts: effort.starts.min(STARTS), band: BAND, ..*effort };
    if how != Depth::OnTheWay {
        let (range, settings) = (case.range(), criteria::settings(case));
        let misses = (how == Depth::WhetherAllHold).then(|| criteria::misses(case));
        let until = misses.as_ref().map(|misses| misses as &Misses<'_, Motions>);
        let found = Survey::until(&range, &settings, until, &Serial)?;
        if found.motions.ended_early() {
            return Ok(criteria::judge(case, &found));
        }
        return Ok(judge_in_contact(case, &found, *effort, again)?);
    }
    // Most of a search goes into telling a long transient from a motion: first it counts as one, and then places that do not
    // hold by what only a window shows are searched with patience.
    let mut found = survey(few.short())?;
    let mut known: Vec<f64> = Vec::new();
    loop {
        let judged = criteria::judge(case, &found);
        let mut open = criteria::open(case, &found, &judged, &known);
        if open.is_empty() {
            return Ok(judge_in_contact(case, &found, few.short(), again)?);
        }
        open.truncate(AT_A_TIME);
        found.motions.look_again(&open, &few, &Serial)?;
        known.extend(open);
    }
}
