//! The sentences of the page.

use super::{asked, error_text, operations};
use crate::case::Case;
use crate::report::numbers::{LengthFormat, fixed, percent, significant, with_error};
use crate::simulation::ContactTolerance;
use crate::study::tradeoff::by_hand::{Flights, Locate};
use crate::study::tradeoff::{ErrorOf, Layer, Method, Search, Tradeoff, Transient, Trial};

/// A method in a few words.
pub fn method(method: Method) -> String {
    match method {
        Method::FixedPoints => "manifold and fixed points".into(),
        Method::SlowFlow { periods } => format!("slow flow, {periods} periods"),
        Method::SymmetricOrbit => "symmetric orbit, closed form".into(),
        Method::OrbitFromSimulation { periods } => {
            format!("orbit by Newton's method, after {periods} periods")
        }
        Method::Simulation { periods, search, excursion } => {
            let slow = if search == Search::StepByStep { ", slow search" } else { "" };
            let usual = excursion == ContactTolerance::default().excursion;
            let contact = if usual {
                String::new()
            } else {
                format!(", chatter ended at {} b", significant(excursion, 1))
            };
            format!("simulation, {periods} periods{slow}{contact}")
        }
        Method::FixedStep { periods, steps, locate } => {
            let how = match locate {
                Locate::Bisection => "bisection",
                Locate::Interpolation => "interpolation",
            };
            format!("Runge–Kutta, T/{steps}, {how}, {periods} periods")
        }
    }
}

/// The layers that compete for the headline; the baseline is spoken of afterwards.
const COMPETING: [Layer; 4] =
    [Layer::ClosedForm, Layer::SlowFlow, Layer::ExactOrbit, Layer::Simulation];

pub(super) fn winner(tradeoff: &Tradeoff, allowed: f64) -> Option<&Trial> {
    let found = COMPETING.iter().filter_map(|layer| tradeoff.cheapest(*layer, allowed));
    found.min_by_key(|trial| trial.operations)
}

/// What is enough, and what it costs.
pub fn headline(tradeoff: &Tradeoff, allowed: f64) -> String {
    let wanted = asked(allowed);
    match winner(tradeoff, allowed) {
        Some(trial) => format!(
            "For {wanted} in amplitude the {} is enough: {}, {} operations, error {}.",
            trial.method.layer().words(),
            method(trial.method),
            operations(trial.operations),
            trial.rms_error.map_or_else(String::new, error_text)
        ),
        None => format!(
            "None of the runs in the table gives {wanted} in amplitude; {}the best answer is {}known to {}.",
            extrapolated(tradeoff, allowed).map_or_else(String::new, |words| words + "; "),
            if tradeoff.best.in_transient { "in its transient, too, and " } else { "" },
            error_text(ErrorOf { value: tradeoff.best.rms_error, below: false })
        ),
    }
}

/// The length that a simulation of a motion without repetition would take: its scatter falls with
/// the root of the length. Of a transient that is not over no length can be told.
fn extrapolated(tradeoff: &Tradeoff, allowed: f64) -> Option<String> {
    let simulations = tradeoff.trials.iter().filter_map(|trial| match trial.method {
        Method::Simulation { periods, search: Search::Panels, .. } => Some((periods, trial)),
        _ => None,
    });
    let (periods, longest) = simulations
        .filter(|(_, trial)| trial.answer.scatter.is_some_and(f64::is_finite))
        .max_by_key(|(periods, _)| *periods)?;
    if tradeoff.transient(longest).is_some() {
        return Some("the longest simulation is still in its transient".into());
    }
    let factor = longest.answer.scatter? / allowed;
    if tradeoff.best.layer != Layer::Simulation || factor <= 1.0 {
        return None;
    }
    let (periods, cost) =
        (periods as f64 * factor * factor, longest.operations as f64 * factor * factor);
    Some(format!(
        "the scatter of a simulation falls with the root of its length, so some {} periods and {} operations would",
        thousands(periods),
        operations(cost as u64)
    ))
}

/// A number of periods, rounded up to whole thousands.
fn thousands(periods: f64) -> String {
    format!("{}", (periods / 1000.0).ceil() * 1000.0)
}

/// The other layers against the cheapest that is enough.
pub fn sentences(tradeoff: &Tradeoff, allowed: f64) -> Vec<String> {
    let best = winner(tradeoff, allowed);
    let mut said = Vec::new();
    for layer in COMPETING.into_iter().chain([Layer::FixedStep]) {
        if best.is_some_and(|best| best.method.layer() == layer) {
            continue;
        }
        said.extend(sentence(tradeoff, layer, allowed, best));
    }
    said.extend(counts(tradeoff));
    said.extend(misses(tradeoff));
    said
}

fn sentence(
    tradeoff: &Tradeoff,
    layer: Layer,
    allowed: f64,
    winner: Option<&Trial>,
) -> Option<String> {
    let name = name(layer);
    if let Some(trial) = tradeoff.cheapest(layer, allowed) {
        let error = trial.rms_error.map_or_else(String::new, error_text);
        let more = winner.map_or_else(
            || format!("takes {} operations", operations(trial.operations)),
            |winner| {
                let ratio = trial.operations as f64 / winner.operations.max(1) as f64;
                format!("costs {} times that", significant(ratio, 2))
            },
        );
        return Some(format!("{name} {more}: {}, error {error}.", method(trial.method)));
    }
    let mut trials = tradeoff.trials.iter().filter(|trial| trial.method.layer() == layer);
    let closest = trials
        .clone()
        .filter_map(|trial| Some((trial, trial.rms_error?)))
        .min_by(|a, b| a.1.value.total_cmp(&b.1.value));
    // Chance, where a motion does not repeat: nobody can know that one is closer than it scatters.
    let falls_short =
        if tradeoff.best.layer == Layer::Simulation { "is known to" } else { "misses by" };
    match closest {
        Some((trial, error)) => Some(format!(
            "{name} {falls_short} {}: {}, {} operations{}.{}",
            error_text(error),
            method(trial.method),
            operations(trial.operations),
            winner.map_or_else(String::new, |winner| cheaper(trial, winner)),
            tradeoff.transient(trial).map_or_else(String::new, |left| transient(tradeoff, left))
        )),
        None => {
            let why = trials.find_map(|trial| trial.answer.why_not)?;
            Some(format!("{name} gives no answer: {why}."))
        }
    }
}

/// How much less a method costs than the one that is enough, if that is worth saying.
fn cheaper(trial: &Trial, winner: &Trial) -> String {
    match winner.operations / trial.operations.max(1) {
        0..10 => String::new(),
        ratio => format!(", one in {} of that", significant(ratio as f64, 2)),
    }
}

/// Why the error of a simulation is none of scatter, after its sentence.
fn transient(tradeoff: &Tradeoff, transient: Transient) -> String {
    let left_out = transient.left_out;
    let shrinks = match transient.decay_periods {
        None => "the oscillator is undamped, so only impacts shrink it, and".into(),
        Some(decay) => {
            let periods = significant(decay, 3);
            if tradeoff.best.layer == Layer::ExactOrbit {
                format!("near the orbit it shrinks to 1/e in {periods} periods, and")
            } else {
                format!(
                    "by damping alone it shrinks to 1/e in {periods} periods, sooner by impacts, and"
                )
            }
        }
    };
    format!(
        " That is a transient that has not died out, not scatter: {shrinks} {left_out} periods were left out."
    )
}

/// Relative difference of a count of impacts that is worth a sentence.
const WRONG_COUNT: f64 = 0.5;

/// A baseline whose amplitude is right and whose impacts are not.
fn counts(tradeoff: &Tradeoff) -> Option<String> {
    let exact = tradeoff.best.impacts_per_period;
    let hand = tradeoff.trials.iter().filter(|trial| trial.method.layer() == Layer::FixedStep);
    let off = |z: f64| (z - exact).abs() / exact.max(f64::MIN_POSITIVE);
    let (z, trial) = hand
        .filter_map(|trial| Some((trial.answer.impacts_per_period?, trial)))
        .max_by(|a, b| off(a.0).total_cmp(&off(b.0)))?;
    (off(z) > WRONG_COUNT).then(|| {
        let why = if tradeoff.rests {
            ": without sustained contact an absorber that rests on a wall hits it in every step, the more often the smaller the steps"
        } else {
            ""
        };
        format!(
            "Its amplitude hides its impacts: {} counts {} a period instead of {}{why}.",
            method(trial.method),
            significant(z, 3),
            significant(exact, 3)
        )
    })
}

fn name(layer: Layer) -> &'static str {
    match layer {
        Layer::ClosedForm => "The closed form",
        Layer::SlowFlow => "The slow flow in time",
        Layer::ExactOrbit => "The exact orbit",
        Layer::Simulation => "Event-driven simulation",
        Layer::FixedStep => "A fixed step by hand",
    }
}

/// What averages hide: impacts that the baseline flew past.
fn misses(tradeoff: &Tradeoff) -> Option<String> {
    let hand = tradeoff.trials.iter().filter_map(|trial| Some((trial, trial.flights?)));
    let wrong = |(_, flights): &(&Trial, Flights)| flights.missed + flights.invented > 0;
    let share = |(_, flights): &(&Trial, Flights)| {
        (flights.missed + flights.invented) as f64 / flights.compared.max(1) as f64
    };
    let worst = hand.clone().max_by(|a, b| share(a).total_cmp(&share(b)))?;
    let (all, some) = (hand.clone().count(), hand.filter(wrong).count());
    if some == 0 {
        return Some(format!(
            "Flight by flight none of its {all} variants misses an impact ({} flights and more).",
            worst.1.compared
        ));
    }
    Some(format!(
        "Flight by flight {some} of its {all} variants miss impacts or invent some, at worst {}: {} missed and {} invented of {}.",
        method(worst.0.method),
        worst.1.missed,
        worst.1.invented,
        worst.1.compared
    ))
}

/// What all is compared with.
pub fn best(case: &Case, tradeoff: &Tradeoff) -> String {
    let scales = case.scales();
    let lengths = LengthFormat::of(&scales);
    let best = &tradeoff.best;
    let rms = lengths.with_digits(scales.length(best.rms), 5);
    let share = match tradeoff.others {
        0 => "the only long-term motion found".to_owned(),
        others => format!(
            "the long-term motion that {} of the starts lead to, beside {others} other{}",
            percent(tradeoff.share),
            if others == 1 { "" } else { "s" }
        ),
    };
    let known = match (best.orbit, best.periods) {
        (Some((impacts, periods)), _) => format!(
            "an exact orbit of {impacts} impacts in {periods} period{}, stable and admissible: rms displacement {rms}, z = {}",
            if periods == 1 { "" } else { "s" },
            significant(best.impacts_per_period, 4)
        ),
        (None, Some(periods)) => format!(
            "no orbit, so the best answer is a simulation of {periods} periods: rms displacement {rms} ± {}, z = {}; the error is two standard errors between ten blocks{}",
            error_text(ErrorOf { value: best.rms_error, below: false }),
            with_error(best.impacts_per_period, best.impacts_error),
            if best.in_transient {
                ", which approach a value exponentially: a transient makes it, not scatter"
            } else {
                ""
            }
        ),
        (None, None) => rms,
    };
    let start = match tradeoff.start_number {
        Some(number) => format!("start {number} of the evenly spread ones"),
        None => "a state of the motion itself".into(),
    };
    format!(
        "The question is {} ({}): {known}. Simulations begin at {start} (x = {}, x′ = {}, y = {}, y′ = {} over the clearance) and leave their first half to the transient.",
        share,
        best.regime.words(),
        fixed(tradeoff.start.x, 3),
        fixed(tradeoff.start.x_velocity, 3),
        fixed(tradeoff.start.y, 3),
        fixed(tradeoff.start.y_velocity, 3),
    )
}
