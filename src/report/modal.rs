//! The report of a structure of several modes with several absorbers, as data, a drawing and files. The sentences are in
//! `templates/modal*.tera`.

use serde_json::{Value, json};

use super::chart::AxisOf;
use super::document::FORMAT;
use super::document::Word;
use super::error::RenderError;
use super::figure::{Color, Dash, Figure, Layer, Layout, Marker, Panel, Role, Shape, Style};
use super::render::{Files, in_lines, page_files};
use super::template::{render, worded};
use super::transient::DAMPER;
use crate::case::{ActsOn, Load, ModalCase};
use crate::method::Method;
use crate::modal::{DamperChoice, JudgedPlace, ModalAnswer, WorstOfPlace};
use crate::motions::ModalMotion;
use crate::quantity::catalogue as of;
use crate::quantity::{Kind, Quantity, Units};
use crate::system::Scales;

/// Several tuned mass dampers.
const DAMPERS: Style = Style::new(Color::SkyBlue, 1.1, Dash::Solid);
/// What is asked.
const LIMIT: Style = Style::new(Color::Vermillion, 1.3, Dash::Dashed);
/// What is known along a band.
pub struct Beside<'a> {
    /// Tuned mass dampers.
    pub dampers: &'a [DamperChoice],
    /// For each load what a model of the driven mode alone would say; none where there is none.
    pub alone: &'a [Option<WorstOfPlace>],
}

/// Units of the pages of a case: lengths in that of the smallest clearance.
fn units(case: &ModalCase) -> Units {
    let least = case.absorbers.iter().map(|one| one.clearance_m).fold(f64::INFINITY, f64::min);
    Units::from(Scales {
        physical: true,
        clearance: least,
        natural_frequency: case.omega(),
        oscillator_mass: case.modes[0].mass_kg,
    })
}

fn given(kind: &'static Kind, value: f64) -> Quantity {
    Quantity::new(kind, value, Method::Given)
}

fn simulated(kind: &'static Kind, value: f64) -> Quantity {
    Quantity::new(kind, value, Method::Simulation)
}

fn closed(kind: &'static Kind, value: f64) -> Quantity {
    Quantity::new(kind, value, Method::ClosedForm)
}

/// The word of what all criteria come to; of a case without them whether it moves less than without absorbers.
fn word(answer: &ModalAnswer) -> Word {
    let judged = &answer.judged;
    let any = |of: fn(&JudgedPlace) -> bool| judged.iter().any(of);
    match answer.worst(None, None) {
        _ if any(|one| one.holds == Some(false)) => Word::Fails,
        _ if any(|one| one.holds.is_none() && !one.worst.settled) => Word::NotDecided,
        _ if any(|one| one.holds.is_none()) => Word::TooCloseToCall,
        _ if !judged.is_empty() => Word::Holds,
        Some(worst) if worst.peak + worst.error < bare(answer) => Word::Works,
        Some(worst) if worst.peak > bare(answer) => Word::MakesItWorse,
        Some(_) => Word::DoesNothing,
        None => Word::NoAnswer,
    }
}

/// The largest displacement of any place under any load without absorbers.
fn bare(answer: &ModalAnswer) -> f64 {
    let all = answer.along.iter().flat_map(|along| &along.bare);
    all.map(|[most, _]| *most).fold(0.0, f64::max)
}

fn outcome(judged: &JudgedPlace) -> &'static str {
    match judged.holds {
        Some(true) => "holds",
        Some(false) => "fails",
        None if judged.worst.settled => "too-close-to-call",
        None => "not-decided",
    }
}

/// The criteria in the form of those of one mode.
fn criteria(case: &ModalCase, answer: &ModalAnswer) -> Value {
    if answer.judged.is_empty() {
        return Value::Null;
    }
    let count = |of: &str| answer.judged.iter().filter(|one| outcome(one) == of).count();
    let rows = answer.judged.iter().map(|one| {
        let (worst, limit) = (&one.worst, one.criterion.limit);
        json!({
            "name": "peak_displacement",
            "place": one.criterion.place.map(|place| &case.places[place]),
            "worst_place": case.places[worst.place],
            "asked": one.criterion.as_written,
            "relation": "at-most",
            "limit": given(&of::PEAK, limit),
            "found": simulated(&of::PEAK, worst.peak).with_error(worst.error),
            "found_flag": null,
            "margin": simulated(&of::PEAK, limit - worst.peak),
            "outcome": outcome(one),
            "holds": one.holds == Some(true),
            "at": given(&of::EXCITATION_FREQUENCY, worst.at),
            "inactive_share": null,
            "motion": null,
            "undecided_after": null,
            "decided_by": if worst.rests { Method::ClosedForm } else { Method::Simulation },
        })
    });
    json!({
        // No optimum is looked for.
        "several": true,
        "badge": word(answer),
        "count": answer.judged.len(),
        "holding": count("holds"),
        "failing": count("fails"),
        "undecided": count("not-decided"),
        "too_close": count("too-close-to-call"),
        "count_inactive": true,
        "contact_time": null,
        "all": rows.collect::<Vec<_>>(),
    })
}

fn load_row(case: &ModalCase, load: &Load) -> Value {
    let kind = if load.on == ActsOn::Base { &of::BASE_AMPLITUDE } else { &of::FORCE_AMPLITUDE };
    let (place, mode) = match load.on {
        ActsOn::Place(place) => (Some(&case.places[place]), None),
        ActsOn::Mode(mode) => (None, Some(mode + 1)),
        ActsOn::Base => (None, None),
    };
    let [from, to] = load.range_hz.map(|at| given(&of::EXCITATION_FREQUENCY, at));
    json!({ "amplitude": given(kind, load.amplitude), "place": place, "mode": mode, "from": from, "to": to })
}

fn motion_row(motion: &ModalMotion) -> Value {
    let places = motion.places.iter().map(|one| {
        json!({
            "peak": simulated(&of::PEAK, one.peak).with_error(one.error),
            "rms": simulated(&of::RMS, one.rms[0]).with_error(one.rms[1]),
        })
    });
    json!({
        "starts": motion.starts,
        "repeats_after": motion.repeats_after,
        "settled": motion.settled,
        // Whether every absorber rests where no wall reaches it.
        "rests": motion.rests(),
        "impacts_per_period": motion.impacts_per_period.iter().map(|[count, _]| count).collect::<Vec<_>>(),
        "largest_multiplier": motion.largest_multiplier,
        "places": places.collect::<Vec<_>>(),
    })
}

fn worst_row(case: &ModalCase, worst: &WorstOfPlace) -> Value {
    json!({
        "load": worst.load,
        "place": case.places[worst.place],
        "at": given(&of::EXCITATION_FREQUENCY, worst.at),
        "peak": simulated(&of::PEAK, worst.peak).with_error(worst.error),
        "most": simulated(&of::PEAK, worst.peak + worst.error),
        "settled": worst.settled,
        "rests": worst.rests,
    })
}

/// What is known along each load.
fn along(case: &ModalCase, answer: &ModalAnswer, beside: &Beside) -> Vec<Value> {
    let rows = answer.along.iter().enumerate().map(|(k, along)| {
        let largest = along.bare.iter().max_by(|a, b| a[0].total_cmp(&b[0]));
        let worst = answer.worst(None, Some(k));
        let here = worst.and_then(|worst| along.places.iter().find(|one| one.at == worst.at));
        json!({
            "load": load_row(case, &along.load),
            "bare": largest.map(|[most, at]| json!({
                "peak": closed(&of::BARE_PEAK, *most), "at": given(&of::EXCITATION_FREQUENCY, *at),
            })),
            "worst": worst.map(|worst| worst_row(case, &worst)),
            // Starts at that frequency.
            "searched": here.map(|one| one.motions.iter().map(|motion| motion.starts).sum::<u32>()),
            "motions": here.map(|one| one.motions.iter().map(motion_row).collect::<Vec<_>>()),
            "alone": beside.alone.get(k).and_then(|one| one.as_ref()).map(|one| {
                simulated(&of::PEAK, one.peak).with_error(one.error)
            }),
            "dampers": beside.dampers.iter().map(|one| closed(&of::DAMPER_PEAK, one.worst[k])).collect::<Vec<_>>(),
            "places": along.places.iter().map(|one| json!({
                "at": one.at, "unit": "Hz", "motions": one.motions.iter().map(motion_row).collect::<Vec<_>>(),
            })).collect::<Vec<_>>(),
        })
    });
    rows.collect()
}

/// The report: `vinesink/answer@1` with the fields that an index and a comparison read, and those of several modes.
pub fn document(name: &str, case: &ModalCase, answer: &ModalAnswer, beside: &Beside) -> Value {
    let word = word(answer);
    let worst = answer.worst(None, None);
    let (bare, peak) = (bare(answer), worst.map_or(f64::NAN, |one| one.peak));
    let error = worst.map_or(0.0, |one| one.error);
    let damper = beside.dampers.first().map(|one| one.worst.iter().copied().fold(0.0, f64::max));
    let level = |peak: f64| 20.0 * libm::log10(peak / bare);
    let least = case.absorbers.iter().map(|one| one.clearance_m).fold(f64::INFINITY, f64::min);
    let mut quantities = vec![
        given(&of::CLEARANCE, least),
        closed(&of::BARE_PEAK, bare),
        simulated(&of::PEAK, peak).with_error(error),
        simulated(&of::CHANGE_DB, level(peak)).with_error(level(peak + error) - level(peak)),
    ];
    quantities.extend(damper.map(|one| closed(&of::DAMPER_PEAK, one)));
    let quantities: serde_json::Map<String, Value> =
        quantities.into_iter().map(|one| (one.kind.id.to_owned(), json!(one))).collect();
    let modes = case.modes.iter().map(|mode| {
        json!({
            "frequency": given(&of::NATURAL_FREQUENCY, mode.frequency_hz),
            "damping_ratio": given(&of::DAMPING_RATIO, mode.damping_ratio),
            "mass": given(&of::OSCILLATOR_MASS, mode.mass_kg),
            "shape": mode.shape,
        })
    });
    let absorbers = case.absorbers.iter().enumerate().map(|(j, one)| {
        let ratio = |mode: &crate::case::StructuralMode| {
            one.mass_kg * mode.shape[one.place] * mode.shape[one.place] / mode.mass_kg
        };
        json!({
            "number": j + 1,
            "place": case.places[one.place],
            "mass": given(&of::ABSORBER_MASS, one.mass_kg),
            "clearance": given(&of::CLEARANCE, one.clearance_m),
            "restitution": given(&of::RESTITUTION, one.restitution),
            // Over the mass that its impacts see.
            "mass_ratio": closed(&of::MASS_RATIO, case.modes.iter().map(ratio).sum()),
        })
    });
    let dampers = beside.dampers.iter().map(|one| {
        let each = one.dampers.iter().zip(&one.strokes).zip(&one.places);
        let each = each.map(|((damper, stroke), place)| {
            json!({
                "place": case.places[*place],
                "mass": given(&of::ABSORBER_MASS, damper.mass),
                "frequency": closed(&of::DAMPER_FREQUENCY, damper.frequency * case.modes[0].frequency_hz),
                "damping_ratio": closed(&of::DAMPER_DAMPING_RATIO, damper.damping_ratio),
                "stroke": closed(&of::DAMPER_STROKE, *stroke),
            })
        });
        json!({
            "count": one.dampers.len(),
            "worst": closed(&of::DAMPER_PEAK, one.worst.iter().copied().fold(0.0, f64::max)),
            "stroke": closed(&of::DAMPER_STROKE, one.strokes.iter().copied().fold(0.0, f64::max)),
            "each": each.collect::<Vec<_>>(),
        })
    });
    json!({
        "format": FORMAT,
        "asked": "report",
        "title": case.title,
        "source": case.source,
        "units": "si",
        "provenance": {
            "program": env!("CARGO_PKG_NAME"),
            "version": env!("CARGO_PKG_VERSION"),
            "case_sha256": case.text_hash,
        },
        "name": name,
        "verdict": { "tone": word.tone(), "word": word },
        "quantities": quantities,
        "criteria": criteria(case, answer),
        "notes": [],
        "band": null,
        "places_of_shapes": case.places,
        "modes": modes.collect::<Vec<_>>(),
        "absorbers": absorbers.collect::<Vec<_>>(),
        "worst": worst.map(|one| worst_row(case, &one)),
        "loads": along(case, answer, beside),
        "dampers": dampers.collect::<Vec<_>>(),
        "starts": case.starts,
        "figures": [],
    })
}

/// Largest displacement of any place over the frequency, a panel for each load.
fn figure(case: &ModalCase, answer: &ModalAnswer, beside: &Beside, facts: &Value) -> Figure {
    let units = units(case);
    let mut figure = Figure::new("loads", "");
    let mut count = 0;
    for (k, along) in answer.along.iter().enumerate() {
        let [from, to] = along.load.range_hz;
        if from == to {
            continue;
        }
        count += 1;
        let highest = along.places.iter().flat_map(|one| &one.motions).flat_map(|one| &one.places);
        let highest = highest.map(|one| one.peak).fold(0.0, f64::max);
        let limit = case.criteria.iter().map(|one| one.limit).fold(f64::INFINITY, f64::min);
        let limit = Some(limit).filter(|limit| limit.is_finite());
        let top = 1.15 * limit.map_or(highest, |limit| limit.max(highest));
        let x = AxisOf::si(units, &of::EXCITATION_FREQUENCY).axis([from, to]);
        let y = AxisOf::si(units, &of::PEAK).axis([0.0, top]);
        let curve = |of: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
            crate::modal::linear_places(along.load.range_hz, case)
                .into_iter()
                .map(|at| [at, of(at)])
                .collect()
        };
        let linear = |dampers: &[crate::linear::ModalDamper]| {
            curve(&|at| crate::modal::linear_peak(case, &along.load, at, dampers))
        };
        let mut panel = Panel::new(x, y)
            .with(Layer::curve(Role::BareOscillator, linear(&[])).labelled("without absorbers"));
        for (choice, style) in beside.dampers.iter().zip([DAMPER, DAMPERS]) {
            let name = match choice.dampers.len() {
                1 => "one tuned mass damper".to_owned(),
                many => format!("{many} tuned mass dampers"),
            };
            panel = panel.with(Layer::curve(style, linear(&choice.dampers)).labelled(name));
        }
        if let Some(limit) = limit {
            panel = panel.with(Layer::horizontal(limit, LIMIT).labelled("limit"));
        }
        // Not those in which every absorber rests, which are on the line without them.
        let seen = along.places.iter().flat_map(|one| {
            let most =
                |motion: &ModalMotion| motion.places.iter().map(|one| one.peak).fold(0.0, f64::max);
            let acts = |motion: &&ModalMotion| !motion.rests();
            one.motions.iter().filter(acts).map(move |motion| [one.at, most(motion)])
        });
        let marker = Marker::filled(Shape::Circle).sized(5.0);
        panel = panel.with(
            Layer::marked(marker, Role::Simulation.color(), seen.collect::<Vec<_>>())
                .labelled("with absorbers"),
        );
        figure = figure.with_panel(panel.with_heading(heading(case, k, &along.load)));
    }
    let layout = Layout::rows(&vec![1.0; count.max(1)]);
    let height = 90 + 250 * u32::try_from(count).unwrap_or(1);
    figure.with_layout(layout).with_size(720, height).with_facts("captions/loads", facts.clone())
}

fn heading(case: &ModalCase, number: usize, load: &Load) -> String {
    let on = match load.on {
        ActsOn::Place(place) => format!("force at {}", case.places[place]),
        ActsOn::Mode(mode) => format!("force in mode {}", mode + 1),
        ActsOn::Base => "moving base".to_owned(),
    };
    if case.loads.len() > 1 { format!("load {}: {on}", number + 1) } else { on }
}

/// The files of its report.
///
/// # Errors
/// [`RenderError`] says which part cannot be rendered.
pub fn files(
    name: &str,
    case: &ModalCase,
    answer: &ModalAnswer,
    beside: &Beside,
) -> Result<Files, RenderError> {
    let mut document = document(name, case, answer, beside);
    let figure = figure(case, answer, beside, &document);
    let drawn = if figure.panels.is_empty() { Vec::new() } else { vec![figure] };
    let figures = worded(drawn, &units(case))?;
    document["figures"] = figures.iter().map(super::document::figure_row).collect();
    let tone = document["verdict"]["tone"].as_str().unwrap_or_default().to_owned();
    let mut files =
        page_files("report", "modal.md", Some(&tone), &units(case), document.clone(), &figures)?;
    files.insert("report.json".into(), format!("{}\n", in_lines(&document, 0)).into_bytes());
    Ok(files)
}

/// What is said of it on a terminal.
///
/// # Errors
/// [`RenderError::Template`] if the template does not fit.
pub fn text(
    name: &str,
    case: &ModalCase,
    answer: &ModalAnswer,
    beside: &Beside,
) -> Result<String, RenderError> {
    render("modal.txt", &units(case), &document(name, case, answer, beside))
}

/// What its exact orbits are, on a terminal.
///
/// # Errors
/// As [`text`].
pub fn analysis_text(case: &ModalCase, document: &Value) -> Result<String, RenderError> {
    let mut facts = document.clone();
    for (k, load) in case.loads.iter().enumerate() {
        let at = load.centre(case);
        facts["loads"][k]["load"] = load_row(case, load);
        facts["loads"][k]["at"] = json!(given(&of::EXCITATION_FREQUENCY, at));
        let omega = case.omega();
        let orbits = facts["loads"][k]["orbits"].as_array_mut().into_iter().flatten();
        for orbit in orbits {
            let numbers = |key: &str| -> Vec<f64> {
                orbit[key].as_array().into_iter().flatten().filter_map(Value::as_f64).collect()
            };
            let speeds = numbers("impact_speeds").into_iter();
            let speeds: Vec<Quantity> = speeds
                .map(|one| Quantity::new(&of::IMPACT_SPEED, one * omega, Method::ExactOrbit))
                .collect();
            let harmonics = numbers("harmonics_at_absorbers").into_iter();
            let harmonics: Vec<Quantity> =
                harmonics.map(|one| Quantity::new(&of::PEAK, one, Method::ExactOrbit)).collect();
            (orbit["speeds"], orbit["at_absorbers"]) = (json!(speeds), json!(harmonics));
        }
    }
    let absorbers = case.absorbers.iter().zip(document["grading"].as_array().into_iter().flatten());
    let absorbers = absorbers.map(|(one, grading)| {
        let of_clearance = |key: &str| grading[key].as_f64().map(|ratio| given(&of::PEAK, ratio * one.clearance_m));
        json!({ "place": case.places[one.place], "lower": of_clearance("lower"), "upper": of_clearance("upper") })
    });
    facts["absorbers"] = absorbers.collect();
    render("modal-analysis.txt", &units(case), &facts)
}

/// The facts of a case for `check`: its document, what its templates get, and the units of its page.
pub(super) fn checked(
    path: &str,
    name: &str,
    case: &ModalCase,
    answer: &ModalAnswer,
) -> (Value, Value, Units) {
    let nothing = Beside { dampers: &[], alone: &[] };
    let whole = document(name, case, answer, &nothing);
    let rows = answer.judged.iter().map(|one| {
        let worst = &one.worst;
        json!({
            "name": "peak_displacement",
            "place": one.criterion.place.map(|place| &case.places[place]),
            "worst_place": case.places[worst.place],
            "asked": one.criterion.as_written,
            "found": worst.peak,
            "unit": "m",
            "error": worst.error,
            "margin": one.criterion.limit - worst.peak,
            "holds": one.holds == Some(true),
            "near_limit": outcome(one) == "too-close-to-call",
            "decided_by": if worst.rests { Method::ClosedForm } else { Method::Simulation },
            "at_value": worst.at,
            "at_unit": "Hz",
            "load": worst.load,
            "decided": outcome(one) != "not-decided",
        })
    });
    let document = json!({
        "case": name, "title": case.title, "holds": answer.all_hold(), "criteria": rows.collect::<Vec<_>>(),
        "loads": whole["loads"],
    });
    let page = json!({
        "path": path, "case": name, "warnings": [], "criteria": whole["criteria"], "outside": null, "choice": null,
        "alternatives": null, "ranges": null, "combined": null, "reliability": null,
    });
    (document, page, units(case))
}
