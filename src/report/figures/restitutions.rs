//! The manifold, and what it takes from the oscillator, for five restitutions (Fig. 9).

use crate::analysis::{Branch, Manifold};
use crate::equations::stated::FIRST_HARMONIC;
use crate::orbits::symmetric_orbits;
use crate::report::figure::{
    Axis, Color, Dash, Figure, Label, Layer, Layout, MarkedPoint, Marker, Panel, Role, Rule, Shape,
    Style,
};
use crate::report::numbers::significant;
use crate::study::StudyError;
use crate::system::{Parameters, System};

use super::Scene;
use super::manifold::observed;

/// The restitutions of Fig. 9.
const SHOWN: [(f64, Color, Dash); 5] = [
    (1.0, Color::Vermillion, Dash::LongDashed),
    (0.8, Color::Orange, Dash::Dashed),
    (0.6, Color::BluishGreen, Dash::Solid),
    (0.4, Color::Blue, Dash::DashDot),
    (0.2, Color::Black, Dash::Dotted),
];
/// Restitutions among which the smallest vibration is looked for, to a hundredth.
const RESTITUTIONS: u32 = 100;
/// Steps in restitution of everything over `r`.
const STEPS: u32 = 200;
/// Samples of a branch of the manifold.
const SAMPLES: u32 = 160;

/// What the manifold gives at one restitution for the oscillator's amplitude.
#[derive(Debug, Clone, Copy)]
struct Taken {
    restitution: f64,
    absorber: f64,
    /// `E/b = 8 B/(pi^2 b)`.
    harmonic: f64,
    /// `E sin(Theta)/b`, the part that enters the first equation of (18).
    damping: f64,
    branch: Branch,
}

pub(super) fn figure(scene: &Scene) -> Result<Option<Figure>, StudyError> {
    let Some(level) = level(scene) else { return Ok(None) };
    let all = over_all(level)?;
    let Some(strongest) = strongest(&all) else { return Ok(None) };
    let first = manifolds(level)?;
    let second = over_restitution(&all);
    let (caption, alt) = words(scene, level, &strongest);
    Ok(Some(
        Figure::new("restitutions", "The manifold and what it takes, for five restitutions")
            .with_size(860, 450)
            .with_layout(Layout::columns(&[1.0, 1.0]))
            .with_panel(first)
            .with_panel(second)
            .with_words(caption, alt),
    ))
}

/// Which restitutions matter at an oscillator amplitude.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Strongest {
    /// Where `E` is largest, among those with a steady 1:1 motion.
    pub harmonic: f64,
    /// Where `E sin(Theta)` is, among the same.
    pub damping: f64,
    /// The smallest and the largest with a steady 1:1 motion.
    pub stable: (f64, f64),
}

/// The same for a case, by its own oscillator amplitude.
///
/// # Errors
/// As the manifold.
pub(crate) fn strongest_of(scene: &Scene) -> Result<Option<Strongest>, StudyError> {
    let Some(level) = level(scene) else { return Ok(None) };
    Ok(strongest(&over_all(level)?))
}

fn strongest(all: &[Taken]) -> Option<Strongest> {
    // Where 1:1 resonance is not steady the manifold takes nothing.
    let stable = || all.iter().filter(|at| at.branch == Branch::Stable);
    let largest = |value: fn(&Taken) -> f64| {
        let at = stable().max_by(|a, b| value(a).total_cmp(&value(b)))?;
        Some(at.restitution)
    };
    Some(Strongest {
        harmonic: largest(|at| at.harmonic)?,
        damping: largest(|at| at.damping)?,
        stable: (stable().next()?.restitution, stable().next_back()?.restitution),
    })
}

fn over_all(level: f64) -> Result<Vec<Taken>, StudyError> {
    let mut all = Vec::new();
    for k in 0..=STEPS {
        all.extend(taken(f64::from(k) / f64::from(STEPS), level)?);
    }
    Ok(all)
}

/// The oscillator's amplitude `C/b`: the stable fixed point's, else the observed one.
fn level(scene: &Scene) -> Option<f64> {
    let stable =
        scene.study.analysis.stable_points().last().map(|point| point.oscillator_amplitude);
    stable.or_else(|| Some(observed(scene, scene.first_drawn()?)?[1]))
}

/// The right one of the two points of the manifold at a given `C/b`, from (16) as a quadratic in
/// `B/b`; none below the fold.
fn taken(restitution: f64, level: f64) -> Result<Option<Taken>, StudyError> {
    let manifold = manifold(restitution)?;
    let Some(absorber) = manifold.stable_absorber(level) else { return Ok(None) };
    let harmonic = FIRST_HARMONIC.at([absorber]);
    let sine = libm::sin(manifold.absorber_phase(absorber, absorber - 1.0));
    let branch = manifold.branch(absorber - 1.0);
    Ok(Some(Taken { restitution, absorber, harmonic, damping: harmonic * sine, branch }))
}

fn manifold(restitution: f64) -> Result<Manifold, StudyError> {
    Ok(Manifold::of(restitution))
}

fn manifolds(level: f64) -> Result<Panel, StudyError> {
    let (last, top) = (2.4_f64.max(1.3 + level), 1.5_f64.max(1.3 * level));
    let x = Axis::linear("absorber amplitude B/b (1)").with_range(0.0, last);
    let y = Axis::linear("oscillator amplitude C/b (1)").with_range(0.0, top);
    let rule = Layer::rule(Rule::Horizontal(level), Role::Guide.style().colored(Color::Grey));
    let mut panel = Panel::new(x, y)
        .with_heading("manifolds: stable part thick")
        .with(rule.labelled(Label::near("this case", [0.25 * last, level])));
    let mut marks = Vec::new();
    for (restitution, color, dash) in SHOWN {
        let manifold = manifold(restitution)?;
        let breaking = manifold.symmetry_breaking.absorber_amplitude - 1.0;
        let part = |first: f64, end: f64| -> Vec<[f64; 2]> {
            (0..=SAMPLES)
                .map(|k| manifold.point(first + (end - first) * f64::from(k) / f64::from(SAMPLES)))
                .map(|point| [point.absorber_amplitude, point.oscillator_amplitude])
                .collect()
        };
        let thin = Style::new(color, 1.0, dash);
        let unstable = [part(-1.0, manifold.fold_shift), part(breaking, last - 1.0)];
        let unstable = unstable.join(&[f64::NAN; 2]);
        let stable = part(manifold.fold_shift, breaking);
        panel = panel.with(Layer::styled(thin, unstable)).with(
            Layer::styled(Style { width: 2.6, ..thin }, stable)
                .labelled(format!("r = {restitution}")),
        );
        if let Some(at) = taken(restitution, level)? {
            let shape = Shape::Circle;
            let stable = at.branch == Branch::Stable;
            let marker = if stable { Marker::filled(shape) } else { Marker::hollow(shape) };
            let words = format!("r = {restitution}: B/b = {}", significant(at.absorber, 3));
            let mark = MarkedPoint::new(at.absorber, level).with_tooltip(words);
            marks.push(Layer::marked(marker.sized(8.0), color, [mark]));
        }
    }
    panel.layers.extend(marks);
    Ok(panel)
}

/// One of the quantities over `r`.
type Value = fn(&Taken) -> f64;

fn over_restitution(all: &[Taken]) -> Panel {
    let x = Axis::linear("restitution r (1)").with_range(0.0, 1.0);
    let highest = all.iter().map(|at| at.harmonic.max(at.damping)).fold(0.0, f64::max);
    let y = Axis::linear("over the clearance (1)").with_range(0.0, 1.12 * highest);
    let mut panel = Panel::new(x, y).with_heading("at this amplitude: stable part thick");
    let values: [(&str, Color, Value); 2] = [
        ("E/b", Color::SkyBlue, |at| at.harmonic),
        ("E sin Θ/b", Color::Vermillion, |at| at.damping),
    ];
    for (name, color, value) in values {
        let line = |stable: bool| -> Vec<[f64; 2]> {
            let part = |at: &Taken| (at.branch == Branch::Stable) == stable;
            let pairs = all.windows(2).filter(|pair| part(&pair[1]));
            pairs
                .flat_map(|pair| {
                    let ends = [&pair[0], &pair[1]].map(|at| [at.restitution, value(at)]);
                    [ends[0], ends[1], [f64::NAN; 2]]
                })
                .collect()
        };
        let [thick, thin] = [true, false].map(|stable| continuous(line(stable)));
        panel = panel
            .with(Layer::styled(Style::new(color, 1.2, Dash::Dashed), thin.clone()))
            .with(Layer::styled(Style::new(color, 2.6, Dash::Solid), thick.clone()));
        let named = if thick.is_empty() { 2 } else { 1 };
        let at = panel.layers.len() - named;
        panel.layers[at] = panel.layers[at].clone().labelled(name);
    }
    panel
}

/// Pairs that follow each other as one line.
fn continuous(pairs: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let mut line: Vec<[f64; 2]> = Vec::new();
    for pair in pairs.chunks(3) {
        if line.last() != Some(&pair[0]) {
            line.extend([[f64::NAN; 2], pair[0]]);
        }
        line.push(pair[1]);
    }
    line
}

/// The restitution at which the exact symmetric orbit that attracts vibrates least at the case's
/// clearance and forcing, with its peak. At small restitutions an orbit of the theory may be none: the
/// absorber would leave its cavity.
fn best(system: &System) -> Option<(f64, f64)> {
    let restitutions = (0..=RESTITUTIONS).map(|k| f64::from(k) / f64::from(RESTITUTIONS));
    let tried = restitutions.filter_map(|restitution| {
        let there = System::new(Parameters { restitution, ..system.parameters() }).ok()?;
        let orbits = symmetric_orbits(&there).ok()?;
        let orbit = orbits.iter().find(|orbit| orbit.orbit.attracts())?;
        Some((restitution, orbit.peaks.displacement))
    });
    tried.min_by(|a, b| a.1.total_cmp(&b.1))
}

fn words(scene: &Scene, level: f64, strongest: &Strongest) -> (String, String) {
    let (first, last) = strongest.stable;
    let least = match best(&scene.study.analysis.system) {
        Some((restitution, peak)) => format!(
            " At this clearance and forcing the stable exact orbit with the smallest peak of x, {}, has r = {}.",
            scene.units.length_text(peak),
            significant(restitution, 2)
        ),
        None => {
            " At this clearance and forcing no exact symmetric orbit is stable, whatever r.".into()
        }
    };
    let caption = format!(
        "At {}, with an oscillator amplitude C of {}, the theory has steady 1:1 resonance for r from {} to {}; among these E is largest for r = {}, what damps the oscillator, E sin Θ, for r = {}.{least}",
        scene.units.place_text(&scene.study.analysis.system),
        scene.units.length_text(level),
        significant(first, 2),
        significant(last, 2),
        significant(strongest.harmonic, 2),
        significant(strongest.damping, 2)
    );
    let alt = format!(
        "Left, the manifold for five restitutions and the oscillator's amplitude; right, E and E sin Θ over the restitution at that \
         amplitude. {caption}"
    );
    (caption, alt)
}
