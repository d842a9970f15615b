//! The requests about a structure of one mode with one absorber.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::{Value, json};
use vinesink::answer::{Answer, Asked};
use vinesink::band::Worst;
use vinesink::case::{Case, Objective, RewriteError, Rounding};
use vinesink::excitation::Scene;
use vinesink::executor::Serial;
use vinesink::linear::bare_amplitude;
use vinesink::method::Method;
use vinesink::optimize::{self, JudgedDesign, Optimization, Task};
use vinesink::quantity::Dimension;
use vinesink::quantity::catalogue::{CLEARANCE, LARGEST_PEAK, WORK};
use vinesink::quantity::numbers::significant;
use vinesink::report::criteria;
use vinesink::report::document::{self, Source};
use vinesink::report::figure::{self, Figure, PlacedPanel};
use vinesink::report::html::unbroken;
use vinesink::report::{figures, template};
use vinesink::study::CaseStudy;
use vinesink::study::plots::{BoundaryMap, Plot};
use vinesink::system::{Parameter, State, System};

use crate::controls;
use crate::plain;
use crate::running::{self, From};
use crate::told::{problems, words};

/// A request about the case that `text` describes.
#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case")]
pub enum Request {
    /// The sliders of a case.
    Open { text: String },
    /// The case with other values, in SI; then what a frame of a moving picture has time for.
    Change {
        text: String,
        values: BTreeMap<String, f64>,
        #[serde(flatten)]
        look: Look,
    },
    /// The map of the areas, without the mark of the case.
    Map {
        text: String,
        #[serde(flatten)]
        look: Look,
    },
    /// The report as data, its first screen, and its figures.
    Study {
        text: String,
        #[serde(flatten)]
        look: Look,
    },
    /// The running simulation is of this case now: what its lengths are in, and the structure without an absorber.
    Run { text: String, from: From },
    /// The criteria of a case, over its band where it has one, in Markdown.
    Judge { text: String },
    /// The best of a few absorbers: what may be said while [`Request::Optimize`] is waited for.
    OptimizeFew { text: String },
    /// The absorber that serves a case best, as the program chooses it.
    Optimize { text: String },
}

/// How figures are drawn: as in a report, where nothing is said.
#[derive(Deserialize, Default, Clone, Copy)]
#[serde(default)]
pub struct Look {
    /// For a phone.
    narrow: bool,
    /// In words that need no theory.
    plain: bool,
}

/// The answer to a request.
pub fn answer(request: Request) -> Result<Value, Value> {
    match request {
        Request::Open { text } => Ok(opened(&parsed(&text)?, &text)),
        Request::Change { text, values, look } => change(&text, &values, look),
        Request::Map { text, look } => map(&read(&text)?, look),
        Request::Study { text, look } => study(&read(&text)?, look),
        Request::Run { text, from } => {
            let case = read(&text)?;
            let (system, clearance) = (case.system(), case.units().clearance);
            running::one(&system, clearance, from).map_err(words)?;
            let unit = case.units().unit(Dimension::Length, clearance);
            let scale = clearance / unit.size;
            Ok(json!({
                "unit": unit.symbol, "scale": scale, "clearances": [scale], "places": [""],
                "bare": bare(&system).map(|motion| [motion.map(|x| scale * x)]),
                "carried": carried(&case)?,
            }))
        }
        Request::Judge { text } => judged(&parsed(&text)?),
        Request::OptimizeFew { text } => best_of_few(&parsed(&text)?, &text),
        Request::Optimize { text } => best(&parsed(&text)?, &text),
    }
}

/// The structure without an absorber in its steady motion: displacement over the clearance at phase 0, and a quarter of a
/// period later; none where nothing limits it.
fn bare(system: &System) -> Option<[f64; 2]> {
    let State { x, x_velocity, .. } = system.linear_response()?.state(system);
    Some([x, x_velocity / system.frequency_ratio()])
}

/// How the ball is held, which the picture does not show; nothing where the case does not say.
fn carried(case: &Case) -> Result<String, Value> {
    let Some(support) = document::support(case) else { return Ok(String::new()) };
    let facts = json!({ "support": support });
    template::render("carried.md", &case.units(), &facts).map_err(words)
}

/// What `vinesink check --criteria-only` says of a case.
fn judged(case: &Case) -> Result<Value, Value> {
    let answer = Answer::steady(case, Asked::Criteria, None, case.effort(), &Serial);
    let answer = answer.map_err(words)?;
    let table = criteria::table("Criteria", case, &answer.judged).map_err(words)?;
    Ok(json!({ "markdown": unbroken(&table) }))
}

/// What is said of the best of a few absorbers, each judged over the band as `check` judges it; nothing of a case without
/// one, whose search takes no longer.
fn best_of_few(case: &Case, text: &str) -> Result<Value, Value> {
    if case.band.is_none() {
        return Ok(json!({ "said": null }));
    }
    let task = Task::of(case, None).map_err(words)?;
    let found = optimize::best_of_few(&task, text, &Serial).map_err(words)?;
    let units = case.units();
    let clearance = units.text(&CLEARANCE, found.choice.clearance());
    let about = match task.objective {
        Objective::WorstAmplitude => {
            format!(", with a peak of {} at most", units.text(&LARGEST_PEAK, found.value))
        }
        _ => String::new(),
    };
    let holds = match found.is_feasible() {
        true => "",
        false => "; it does not meet what the case asks for",
    };
    Ok(
        json!({ "said": format!("Best so far: a clearance of {clearance}{about}{holds}. The search goes on.") }),
    )
}

/// The case with the best absorber, where that is better than its own and meets what it asks for, and what is said of it.
fn best(case: &Case, text: &str) -> Result<Value, Value> {
    let task = Task::of(case, None).map_err(words)?;
    let found = Optimization::of(&task, text, &Serial).map_err(words)?;
    if !found.succeeds() {
        let said = "No other clearance is better and meets what the case asks for.";
        return Ok(json!({ "text": null, "said": said }));
    }
    let better = found.best.written.clone().with_fitting_comments(case).map_err(words)?;
    let units = case.units();
    let clearance = units.text(&CLEARANCE, better.case.design.clearance());
    let place = if case.band.is_some() { "over the band" } else { "at this excitation" };
    let [best, own] = [&found.best, &found.own].map(|one| units.text(&LARGEST_PEAK, one.value));
    let bare = case.system().linear_response().map(|alone| units.length(alone.amplitude()));
    let helps = case.band.is_some() || bare.is_none_or(|bare| found.best.value < bare);
    // Where it is a resting absorber that was worst, a motion with impacts may pay for waking it.
    let active = |one: &JudgedDesign| {
        let worst = Worst::of(&one.survey.motions, false)?;
        let length = one.written.case.units().length(worst.peak.value);
        Some((length, units.text(&LARGEST_PEAK, length)))
    };
    let rested = found.own.worst.as_ref().is_some_and(|worst| worst.motion.rest().is_some());
    let price = match (active(&found.best), active(&found.own)) {
        (Some((best, now)), Some((own, before))) if rested && best > own => format!(
            " That was an absorber that stays inactive. Where it acts, the peak grows from {before} to {now}: the price."
        ),
        _ => String::new(),
    };
    let beside = match case.band {
        None => {
            " Beside this frequency it may be larger: a table [band] in the case file asks for a range."
        }
        Some(_) => "",
    };
    let said = match task.objective {
        Objective::WorstAmplitude if helps => format!(
            "The best clearance is {clearance}: the largest peak of any motion that can happen {place}, an absorber that \
             stays at rest included, is {best}; before it was {own}.{price}{beside}"
        ),
        Objective::WorstAmplitude => format!(
            "No clearance helps at this excitation; the least bad is {clearance}, with {best} instead of {own}."
        ),
        _ => format!("The best clearance is {clearance}."),
    };
    Ok(json!({ "text": better.text, "said": said }))
}

/// A case that the page can show.
fn parsed(text: &str) -> Result<Case, Value> {
    let case = Case::parse("case.toml", text).map_err(|error| problems(&error))?;
    if case.design.scene() != Scene::Steady {
        return Err(words(
            "this page shows steady vibration; the case is a shock, a sweep or a record, which vinesink report shows",
        ));
    }
    Ok(case)
}

/// The case at its own excitation: what it asks for along a band, and beside the usual figures, takes longer than a page can
/// wait.
fn alone(mut case: Case) -> Case {
    (case.band, case.criteria, case.accuracy) = (None, Vec::new(), None);
    (case.report.figures, case.report.deviations) = (Vec::new(), false);
    case
}

fn read(text: &str) -> Result<Case, Value> {
    parsed(text).map(alone)
}

fn opened(case: &Case, text: &str) -> Value {
    let mut notes = Vec::new();
    let judges = !case.criteria.is_empty();
    let alone = "The verdict and the figures are of the excitation of the sliders alone";
    if judges {
        notes.push(format!(
            "{alone}; the criteria below are judged over all that the case asks for."
        ));
    } else if case.band.is_some() {
        notes.push(format!("{alone}, not of the case's band, which vinesink report shows."));
    }
    if !case.system().cavity().is_ideal() {
        notes.push(
            "The case has a tilt, friction or walls that differ; they stay as they are. The restitution is the mean \
             of both walls."
                .to_owned(),
        );
    }
    let controls = controls::controls(case);
    json!({ "text": text, "title": case.title, "controls": controls, "notes": notes, "judges": judges })
}

fn change(text: &str, values: &BTreeMap<String, f64>, look: Look) -> Result<Value, Value> {
    let case = parsed(text)?;
    let mut design = case.design;
    for (key, value) in values {
        let parameter = Parameter::of_name(key).ok_or_else(|| words(format!("no slider {key}")))?;
        design = design.with(parameter, *value);
    }
    let changed = case.rewritten("case.toml", text, &design, Rounding::Nearest);
    let changed = changed.map_err(|error| match error {
        RewriteError::Invalid(error) => problems(&error),
        other => words(other),
    })?;
    let mut answer = opened(&changed.case, &changed.text);
    let case = alone(changed.case);
    let sketch = CaseStudy::sketch(&case.system()).map_err(words)?;
    let manifold = drawn(&case, &sketch, &[Plot::Manifold], look)?;
    answer["figures"] =
        manifold.into_iter().map(|figure| Ok(shown(figure)?.0)).collect::<Result<_, Value>>()?;
    Ok(answer)
}

fn drawn(case: &Case, study: &CaseStudy, plots: &[Plot], look: Look) -> Result<Vec<Figure>, Value> {
    let all = figures::all(case, study, plots).into_iter();
    let all = all.map(|one| if look.plain { plain::of(one) } else { one }).collect();
    let worded = template::worded(all, &case.units()).map_err(words)?;
    let fitted = |figure: Figure| match look.narrow {
        true => figure.narrow().unwrap_or(figure),
        false => figure,
    };
    Ok(worded.into_iter().map(fitted).collect())
}

/// A figure for the page, and where its panels are.
fn shown(figure: Figure) -> Result<(Value, Vec<PlacedPanel>), Value> {
    let drawing = figure::draw(&figure).map_err(words)?;
    let mut row = document::figure_row(&figure);
    row["svg"] = drawing.svg.into();
    Ok((row, drawing.panels))
}

/// The map, the rectangle of its data in shares of the drawing, its axes, and where the case is on them: the
/// page draws the mark, which a reader may drag.
fn map(case: &Case, look: Look) -> Result<Value, Value> {
    let sketch = CaseStudy::sketch(&case.system()).map_err(words)?;
    if case.system().forcing_per_clearance() == 0.0 {
        return Err(words("nothing drives this case: there is no map"));
    }
    let plot = Plot::Map(BoundaryMap::of(&sketch, &Serial));
    let mut figure =
        drawn(case, &sketch, &[plot], look)?.pop().ok_or_else(|| words("there is no map"))?;
    let at = figure.take_case();
    let (width, height) = figure.size;
    let (mut answer, panels) = shown(figure)?;
    if let (Some(panel), Some(at)) = (panels.first(), at) {
        let [left, right] = [panel.room.left, panel.room.right].map(|x| x / f64::from(width));
        let [top, bottom] = [panel.room.top, panel.room.bottom].map(|y| y / f64::from(height));
        let [frequency, clearance] = [Parameter::Frequency, Parameter::Clearance];
        let value = |parameter| case.design.value(parameter);
        answer["panel"] = json!({
            "room": [left, top, right, bottom], "axes": panel.axes, "at": at,
            "values": [value(frequency), value(clearance)],
        });
    }
    Ok(answer)
}

/// A study at the case's own excitation, without what would spoil it: its document, the first screen of the report,
/// and the figures.
fn study(case: &Case, look: Look) -> Result<Value, Value> {
    let answer = Answer::steady(case, Asked::Study, None, case.effort(), &Serial).map_err(words)?;
    let study = answer.studied().map_err(words)?;
    let figures = drawn(case, study, &Plot::usual(study, &Serial).map_err(words)?, look)?;
    let document = document::document(&Source {
        name: "live",
        case,
        study,
        judged: &[],
        answers: None,
        figures: &figures,
    });
    let report = template::render("steady.md", &case.units(), &document).map_err(words)?;
    let first_screen = report.split("<img ").next().unwrap_or_default();
    // The map is the page's own.
    let others = figures.into_iter().filter(|figure| figure.name != "map");
    let figures: Result<Vec<Value>, Value> = others.map(|figure| Ok(shown(figure)?.0)).collect();
    Ok(json!({
        "document": document, "first_screen": unbroken(first_screen), "balance": balance(case, &document),
        "figures": figures?,
    }))
}

/// Where the energy of a period comes from and goes in the main motion: why an absorber works, or makes things worse.
fn balance(case: &Case, document: &Value) -> Option<String> {
    let motion = &document["motions"][document["main"].as_u64()? as usize];
    let taken = 100.0 * motion["efficiency"]["value"].as_f64()?;
    let work = motion["energy"]["work"]["value"].as_f64()?;
    // What the excitation puts into the structure alone its damping takes, eps lambda x'^2.
    let system = case.system();
    let velocity = system.frequency_ratio() * bare_amplitude(&system);
    let loss = 0.5 * system.mass_ratio() * system.damping() * velocity * velocity * system.period();
    let ratio = work / case.units().quantity(&WORK, loss, Method::ClosedForm).value;
    let much = match ratio {
        less if less > 0.0 && less < 1.0 => {
            let share = significant(100.0 * less, 2);
            format!(
                " {share} % of what it puts into the structure alone, as the pushes also shift the resonance"
            )
        }
        more if more.is_finite() && more > 0.0 => {
            format!(" {} times what it puts into the structure alone", significant(more, 2))
        }
        _ => " energy".to_owned(),
    };
    let friction = motion["energy"]["friction"].is_object();
    let rest = if friction { "damping and friction" } else { "the structure's damping" };
    Some(format!(
        "Where the ball bounces the excitation puts in{much}. Of that impacts take {} %, {rest} the rest.",
        significant(taken, 2)
    ))
}
