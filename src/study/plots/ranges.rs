//! Where steady 1:1 resonance begins and ends when one parameter alone is changed, by every layer that knows.

use crate::analysis::boundaries::crossings;
use crate::analysis::{Analysis, Manifold};
use crate::bifurcation::Bifurcation;
use crate::method::Method;
use crate::study::CaseStudy;
use crate::study::margins::ExactMargin;
use crate::system::{Parameter, System};
use crate::validation::tolerance::LARGEST_OFFSET;

/// First and last value; none where no end was found.
pub type Range = [Option<f64>; 2];

/// The ranges of one parameter.
#[derive(Debug, Clone)]
pub struct Ranges {
    /// Which one.
    pub parameter: Parameter,
    /// What was asked, from the layer that is nearest to a machine, and its ranges; never without any.
    /// Simulation tells where every start leads to steady 1:1 resonance, and only from the case's own value on.
    pub layers: Vec<(Method, Vec<Range>)>,
}

impl Ranges {
    /// Those of clearance, frequency and forcing.
    pub(super) fn of(study: &CaseStudy) -> Vec<Self> {
        let clearance = in_clearance(study);
        // The response of an ideal cavity scales with the forcing: k times the clearance does what 1/k times the forcing
        // does. What a cavity that is not ideal does was followed.
        let inverse = |[low, high]: &Range| [high, low].map(|end| end.map(f64::recip));
        let forcing = clearance.iter();
        let real = !study.analysis.system.cavity().is_ideal();
        let followed =
            study.margins.exact.map(|own| own.forcing.map(|end| end.map(|end| end.factor)));
        let forcing = forcing.map(|(layer, ranges)| match layer {
            Method::ExactOrbit if real => (*layer, followed.into_iter().collect()),
            Method::Simulation if real => (*layer, Vec::new()),
            _ => (*layer, ranges.iter().rev().map(inverse).collect()),
        });
        let forcing = forcing.collect();
        let of = |(parameter, mut layers): (Parameter, Vec<(Method, Vec<Range>)>)| {
            layers.retain(|(_, ranges)| !ranges.is_empty());
            Self { parameter, layers }
        };
        let all = [
            (Parameter::Clearance, clearance),
            (Parameter::Frequency, in_frequency(study)),
            (Parameter::Amplitude, forcing),
        ];
        all.into_iter().map(of).collect()
    }
}

fn in_clearance(study: &CaseStudy) -> Vec<(Method, Vec<Range>)> {
    let limit = study.confirmations.upper_limit;
    let simulated = limit.iter().map(|limit| [Some(1.0), Some(limit.kept)]);
    // Of a cavity that is not ideal the case's own is known.
    let own = study.margins.exact.filter(|_| study.exact.two_impact.is_some());
    let own = own.map(|own| own.clearance.map(|end| end.map(|end| end.factor)));
    let exact = study.exact.stable_stretches().iter();
    let exact = exact.map(|one| [0, 1].map(|k| one.ends[k].map(|_| one.clearance[k]))).chain(own);
    let ends = study.margins.clearance.iter().map(|at| at.clearance).collect();
    let system = &study.analysis.system;
    let theory = steady_between(ends, |factor| system.with_clearance_scaled(factor).ok());
    vec![
        (Method::Simulation, simulated.collect()),
        (Method::ExactOrbit, exact.collect()),
        (Method::Theory, theory),
    ]
}

/// Simulation was not asked, and exact orbits only where the case's own is stable.
fn in_frequency(study: &CaseStudy) -> Vec<(Method, Vec<Range>)> {
    let system = &study.analysis.system;
    let value = |end: ExactMargin| end.factor * system.frequency_ratio();
    let exact = study.margins.exact.iter().map(|exact| exact.frequency.map(|end| end.map(value)));
    let ends = frequencies(system, &study.analysis.manifold);
    let mut theory = steady_between(ends, |ratio| system.with_frequency_ratio(ratio).ok());
    // Beside an exact range that is followed from the case, another one would look as if it were refuted.
    let own = system.frequency_ratio();
    let around = |range: &Range| {
        range[0].is_none_or(|low| low <= own) && range[1].is_none_or(|high| own <= high)
    };
    if study.margins.exact.is_some() && theory.iter().any(around) {
        theory.retain(around);
    }
    vec![(Method::ExactOrbit, exact.collect()), (Method::Theory, theory)]
}

/// Frequency ratios at which a boundary of the theory passes through the case's forcing and clearance.
fn frequencies(system: &System, manifold: &Manifold) -> Vec<f64> {
    let kinds =
        [Bifurcation::SymmetryBreaking, Bifurcation::NeimarkSacker, Bifurcation::SaddleNode];
    let detunings = kinds.iter().flat_map(|kind| crossings(*kind, system, manifold));
    let ratios = detunings.map(|detuning| 1.0 + system.mass_ratio() * detuning);
    // Far from resonance a boundary of this theory means nothing.
    ratios.filter(|ratio| (ratio - 1.0).abs() <= LARGEST_OFFSET).collect()
}

/// The stretches between boundaries in which theory has a stable 1:1 motion.
fn steady_between(mut ends: Vec<f64>, system: impl Fn(f64) -> Option<System>) -> Vec<Range> {
    ends.sort_by(f64::total_cmp);
    let steady = |value: f64| {
        let there = system(value).and_then(|there| Analysis::of(&there).ok());
        there.is_some_and(|there| there.stable_points().next().is_some())
    };
    let (Some(first), Some(last)) = (ends.first(), ends.last()) else { return Vec::new() };
    let beyond = [0.5 * first, 2.0 * last];
    let marks: Vec<f64> = [beyond[0]].into_iter().chain(ends).chain([beyond[1]]).collect();
    let pieces: Vec<&[f64]> = marks.windows(2).collect();
    let middle = |piece: &[f64]| (piece[0] * piece[1]).sqrt();
    let stretches = pieces.chunk_by(|a, b| steady(middle(a)) == steady(middle(b)));
    let found = stretches.filter(|stretch| steady(middle(stretch[0])));
    let known = |end: f64| (!beyond.contains(&end)).then_some(end);
    found.map(|all| [known(all[0][0]), known(all[all.len() - 1][1])]).collect()
}
