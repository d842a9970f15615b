//! Bifurcation diagrams: a simulated sweep and the exact branches over it.
//!
//! Truth: the limits of the closed-form family and of the asymmetric orbits, known to many digits
//! (`tests/orbit_branches.rs`); two exact orbits that attract at one value are two answers, of which
//! each way must find its own.

use crate::common;
use std::fs;

use crate::common::table_1;
use vinesink::case::Case;
use vinesink::motions::SweepDirection;
use vinesink::orbits::{Bifurcation, FullSystem};
use vinesink::regimes::Regime;
use vinesink::study::diagrams::{Diagram, STEPS};
use vinesink::study::exact_branches::ExactBranches;
use vinesink::system::{Parameter, Parameters, System};

fn diagram(system: &System, parameter: Parameter) -> Diagram {
    let found = Diagram::around(&FullSystem::of(system), parameter).expect("can be swept");
    found.expect("1:1 resonance exists")
}

/// A repetition is recognised at a closure of 1e-6; an orbit whose multiplier is 0.99 is then still
/// within 1e-4 of its limit. What settles faster is closer.
const SETTLED: f64 = 1e-4;
/// One step of the sweep, as a ratio.
fn step(diagram: &Diagram) -> f64 {
    libm::pow(diagram.range[1] / diagram.range[0], 1.0 / f64::from(STEPS - 1))
}

#[test]
fn simulation_lies_on_the_exact_branches_at_8p5_hz() {
    let path = "cases/li2016-8p5hz-fig4c.toml";
    let text = fs::read_to_string(path).expect("is shipped");
    let case = Case::parse(path, &text).expect("is valid");
    let millimetres = |value: f64| 1e3 * case.units().length(value);
    let diagram = diagram(&case.system(), Parameter::Clearance);

    let agreement = diagram.agreement.expect("steady motions");
    assert!(agreement.compared > 100 && agreement.without_orbit <= 4, "{agreement:?}");
    assert!(agreement.largest < SETTLED, "{agreement:?}");

    // Symmetry breaking and Neimark-Sacker of the symmetric orbit.
    let stretches = diagram.exact.attracting_stretches();
    let [stretch] = stretches.as_slice() else { panic!("{stretches:?}") };
    let [first, last] = stretch.values.map(millimetres);
    assert!((first - 6.441).abs() < 1e-3 && (last - 25.219).abs() < 1e-3, "{first} {last}");
    let kinds = [Bifurcation::SymmetryBreaking, Bifurcation::NeimarkSacker].map(Some);
    assert_eq!(stretch.ends, kinds);
    for (kind, value) in [(Bifurcation::PeriodDoubling, 5.069), (Bifurcation::Grazing, 4.424)] {
        let near =
            diagram.exact.marks.iter().find(|mark| {
                mark.kind == kind && (millimetres(mark.at.value) - value).abs() < 1e-3
            });
        assert!(near.is_some_and(|mark| !mark.symmetric), "{kind:?} at {value}");
    }

    // The way up keeps 1:1 resonance to the last step before its end, the way down finds it later.
    let found = &diagram.hysteresis;
    let lost = found.iter().find(|one| millimetres(one.values[1]) > 20.0).expect("two answers");
    let end = millimetres(lost.values[1]);
    assert!(end <= last && end > last / step(&diagram), "kept up to {end}");
    assert_eq!(lost.regimes, [Regime::TwoSymmetric, Regime::StronglyModulated]);
    assert!(lost.values[0] < 0.95 * lost.values[1] && lost.peaks[1] > 1.5 * lost.peaks[0]);
}

/// At 8 Hz two impacts per period and three both attract between the doubling of the ones at
/// 3.346 mm and the saddle-node of the others at 3.506 mm.
#[test]
fn hysteresis_is_found_where_two_exact_orbits_attract() {
    let diagram = diagram(&table_1(8.0, 15.0), Parameter::Clearance);
    let coexisting = diagram.exact.attracting(3.42 / 15.0).count();
    assert_eq!(coexisting, 2);
    let between = [3.346, 3.506].map(|clearance| clearance / 15.0);
    let narrow = step(&diagram);
    let covers =
        |values: [f64; 2]| values[0] <= between[0] * narrow && values[1] >= between[1] / narrow;
    let found = diagram.hysteresis.iter().find(|one| covers(one.values)).expect("two answers");
    assert_eq!(found.regimes, [Regime::AboveTwo, Regime::TwoAsymmetric]);
    // The saddle-node at 16.695 mm ends the other one.
    let last = diagram.hysteresis.last().expect("some").values[1];
    assert!((16.695 / narrow..16.695).contains(&(15.0 * last)), "{}", 15.0 * last);
    // Where the symmetric orbit alone attracts both ways find it.
    for way in [SweepDirection::Up, SweepDirection::Down] {
        let points = diagram.way(way);
        let alone = points.iter().filter(|point| (0.4..0.9).contains(&point.value));
        assert!(alone.clone().count() > 20);
        for point in alone {
            assert_eq!(point.motion.regime(), Regime::TwoSymmetric, "{}", 15.0 * point.value);
        }
    }
}

/// Clearance and forcing are one parameter: the limits are the reciprocals, the peaks in proportion.
#[test]
fn forcing_is_the_clearance_read_backwards() {
    let system = table_1(8.0, 15.0);
    let whole = [0.2, 5.0];
    let over = |parameter| ExactBranches::over(&system, parameter, whole);
    let (clearance, forcing) = (over(Parameter::Clearance), over(Parameter::Amplitude));
    let (clearances, forcings) = (clearance.attracting_stretches(), forcing.attracting_stretches());
    assert!(clearances.len() == 1 && forcings.len() == 1, "{clearances:?} {forcings:?}");
    for k in [0, 1] {
        let product = clearances[0].values[k] * forcings[0].values[1 - k];
        assert!((product - 1.0).abs() < 1e-8, "{product}");
        assert_eq!(clearances[0].ends[k], forcings[0].ends[1 - k]);
    }
    for mark in &forcing.marks {
        let mirrored = clearance.marks.iter().find(|other| {
            other.kind == mark.kind && (other.at.value * mark.at.value - 1.0).abs() < 1e-6
        });
        let Some(other) = mirrored else { panic!("{:?} at {}", mark.kind, mark.at.value) };
        let ratio = mark.at.peak * other.at.value / other.at.peak;
        assert!((ratio - 1.0).abs() < 1e-6, "{:?}: {ratio}", mark.kind);
    }
}

/// Over the frequency the asymmetric orbits of 8 Hz and 15 mm form a bubble between two symmetry
/// breakings; it is found once, not again as its mirror image.
#[test]
fn a_bubble_is_found_once() {
    let system = table_1(8.0, 15.0);
    let diagram = diagram(&system, Parameter::Frequency);
    let hertz = |value: f64| value * common::natural_frequency() / std::f64::consts::TAU;
    let breakings: Vec<f64> = diagram
        .exact
        .marks
        .iter()
        .filter(|mark| mark.kind == Bifurcation::SymmetryBreaking)
        .map(|mark| mark.at.value)
        .collect();
    let [first, last] = breakings[..] else { panic!("{breakings:?}") };
    for share in [0.1, 0.5, 0.9] {
        let value = first + share * (last - first);
        let found: Vec<f64> = diagram.exact.attracting(value).map(|point| point.peak).collect();
        assert_eq!(found.len(), 1, "at {} Hz", hertz(value));
        let intervals = &diagram.exact.attracting(value).next().expect("one").intervals;
        assert!((intervals[0] - intervals[1]).abs() > 0.1, "{intervals:?}");
        assert!((intervals.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
    assert!(diagram.agreement.expect("steady motions").largest < SETTLED);
}

#[test]
fn without_forcing_there_is_no_diagram() {
    let free = Parameters { forcing_per_clearance: 0.0, ..table_1(8.0, 15.0).parameters() };
    let exact = FullSystem::of(&System::new(free).expect("valid"));
    for parameter in [Parameter::Clearance, Parameter::Frequency, Parameter::Amplitude] {
        assert_eq!(Diagram::around(&exact, parameter), Ok(None));
    }
}

#[test]
fn a_diagram_is_the_same_each_time() {
    let system = table_1(8.5, 20.0);
    let once = || diagram(&system, Parameter::Frequency);
    assert!(once() == once());
}
