//! Bands: shares against dense scans, response against published and closed-form limits.

use crate::common;
use std::f64::consts::TAU;

use vinesink::analysis::Analysis;
use vinesink::band::{Band, margin, theory};
use vinesink::case::BandOver;
use vinesink::executor::Serial;
use vinesink::motions::{Effort, Extreme, Fact, Motion, Place, along, motions, stability};
use vinesink::orbits::{symmetric_orbits, two_impact_orbits};
use vinesink::system::{Cavity, Excitation, Parameters, System};

/// Table 1 of Li, Seguy, Berlioz (2016) at resonance, at a clearance in millimetres.
fn li(clearance_mm: f64) -> System {
    common::table_1(common::natural_frequency() / TAU, clearance_mm)
}

fn frequencies(base: System, range: [f64; 2]) -> Band {
    Band { base, over: BandOver::Frequency, range, spectrum: Vec::new() }
}

/// Bands with different mass ratios, restitutions and excitations, one of amplitudes, one with a
/// spectrum.
fn bands() -> Vec<Band> {
    let other = |mass_ratio, damping, restitution, gamma, excitation| {
        System::new(Parameters {
            mass_ratio,
            damping,
            restitution,
            frequency_ratio: 1.0,
            forcing_per_clearance: gamma,
            excitation,
            cavity: Cavity::IDEAL,
        })
        .expect("valid")
    };
    let weak = other(0.03, 1.0 / 3.0, 0.6, 0.5, Excitation::BaseDisplacement);
    let spectrum = vec![[0.97, 0.7], [1.01, 1.3], [1.05, 0.9]];
    vec![
        frequencies(li(20.0), [0.94, 1.08]),
        frequencies(li(7.5), [0.9, 1.1]),
        Band { spectrum, ..frequencies(li(15.0), [0.95, 1.07]) },
        Band { over: BandOver::Amplitude, range: [0.2, 4.0], ..frequencies(li(20.0), [0.0; 2]) },
        frequencies(other(0.05, 1.0, 0.3, 2.0, Excitation::Force), [0.8, 1.3]),
        frequencies(other(0.002, 2.5, 0.9, 1.2, Excitation::BaseDisplacement), [0.99, 1.01]),
        // A circuit board, over whose band asymmetric orbits double their period.
        frequencies(
            other(1.0 / 60.0, 0.96, 0.55, 4.5, Excitation::BaseDisplacement),
            [0.966, 1.034],
        ),
        // The fixed point of the left branch is lost where its absorber amplitude vanishes.
        frequencies(weak, [0.975, 1.05]),
        Band { over: BandOver::Amplitude, range: [0.3, 4.0], ..frequencies(weak, [0.0; 2]) },
        Band { spectrum: vec![[0.97, 0.7], [1.05, 1.3]], ..frequencies(weak, [0.975, 1.05]) },
    ]
}

/// A share by brute force: what `holds` says at many places, the changes between neighbours bisected.
fn scanned(band: &Band, holds: impl Fn(f64) -> bool) -> f64 {
    const PLACES: u32 = 1500;
    let places: Vec<f64> = band.places(PLACES).collect();
    let mut sum = 0.0;
    for pair in places.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        sum += match (holds(from), holds(to)) {
            (true, true) => to - from,
            (false, false) => 0.0,
            (first, _) => {
                let (mut low, mut high) = (from, to);
                for _ in 0..50 {
                    let middle = 0.5 * (low + high);
                    if holds(middle) == first { low = middle } else { high = middle }
                }
                if first { low - from } else { to - low }
            }
        };
    }
    sum / band.width()
}

#[test]
fn shares_are_those_of_a_dense_scan() {
    let mut partial = 0;
    for (index, band) in bands().iter().enumerate() {
        let z3 = |at: f64| {
            Analysis::of(&band.system(at).expect("valid")).is_ok_and(|there| there.zone.is_z3())
        };
        let share = band.share(&theory::zones(band), |zone| zone.is_z3());
        assert!((share - theory::z3_share(band)).abs() <= 1e-12, "{index}: Z3 {share}");
        let scan = scanned(band, z3);
        assert!((share - scan).abs() <= 1e-9, "{index}: Z3 {share} {scan}");
        // Symmetric or not.
        let attracts = |at: f64| {
            two_impact_orbits(&band.system(at).expect("valid"))
                .is_ok_and(|found| found.orbits.iter().any(|orbit| orbit.attracts()))
        };
        let stable = band.share(&stability(band), |stable| *stable);
        let scan = scanned(band, attracts);
        assert!((stable - scan).abs() <= 1e-9, "{index}: stable {stable} {scan}");
        partial += u32::from(0.01 < share && share < 0.99);
        partial += u32::from(0.01 < stable && stable < 0.99);
    }
    assert!(partial >= 8, "only {partial} shares are neither all nor nothing");
}

/// Straight lines between the corners of a spectrum, constant outside of them.
#[test]
fn a_spectrum_is_straight_between_its_corners() {
    let base = li(15.0);
    let spectrum = vec![[0.97, 0.7], [1.01, 1.3], [1.05, 0.9]];
    let band = Band { spectrum, ..frequencies(base, [0.95, 1.07]) };
    for (at, factor) in
        [(0.95, 0.7), (0.97, 0.7), (0.98, 0.85), (1.0, 1.15), (1.01, 1.3), (1.04, 1.0), (1.06, 0.9)]
    {
        let system = band.system(at).expect("valid");
        let found = system.forcing_per_clearance() / base.forcing_per_clearance();
        assert!((found - factor).abs() < 1e-12, "{at}: {found} {factor}");
        assert_eq!(system.frequency_ratio(), at);
    }
}

#[test]
fn stretches_cover_the_band_once() {
    for band in bands() {
        let covers = |stretches: &[(f64, f64)]| {
            assert_eq!(stretches.first().map(|one| one.0), Some(band.range[0]));
            assert_eq!(stretches.last().map(|one| one.1), Some(band.range[1]));
            assert!(stretches.windows(2).all(|pair| pair[0].1 == pair[1].0));
        };
        let ends = |from: f64, to: f64| (from, to);
        covers(&theory::zones(&band).iter().map(|s| ends(s.from, s.to)).collect::<Vec<_>>());
        covers(&stability(&band).iter().map(|s| ends(s.from, s.to)).collect::<Vec<_>>());
    }
}

/// The smallest gap is that of a dense scan, and a clearance that is off by less keeps the motion: where
/// it must not shrink, and where it must not grow.
#[test]
fn the_smallest_gap_keeps_the_motion_along_the_band() {
    for (clearance_mm, towards) in [(20.0, -1.0), (27.0, 1.0)] {
        let band = frequencies(li(clearance_mm), [0.99, 1.01]);
        let (at, gap) = margin::smallest(&band);
        let scanned = band
            .places(400)
            .map(|at| margin::ClearanceMargin::of(&band, at).expect("stable throughout").smaller())
            .fold(f64::INFINITY, f64::min);
        // A dip found to a thousandth of the band is flat to a millionth.
        assert!((gap - scanned).abs() <= 1e-5 * gap, "{gap} {scanned} at {at}");
        // Of the symmetric motion: beyond its end two asymmetric ones may attract.
        let stable_at = |factor: f64| {
            let base = band.base.with_clearance_scaled(factor).expect("valid");
            let band = band.with_base(base);
            let attracts = |at: f64| {
                symmetric_orbits(&band.system(at).expect("valid"))
                    .is_ok_and(|orbits| orbits.iter().any(|orbit| orbit.orbit.attracts()))
            };
            f64::from(u8::from(band.places(801).all(attracts)))
        };
        for sign in [-1.0, 1.0] {
            assert_eq!(stable_at(1.0 + sign * 0.999 * gap), 1.0, "{clearance_mm} {sign}");
        }
        assert!(stable_at(1.0 + towards * 1.01 * gap) < 1.0, "{clearance_mm} {gap} at {at}");
    }
}

/// A search along a band has the orbit's numbers where it attracts, and every start leads somewhere.
#[test]
fn simulated_motions_are_the_exact_ones_where_those_attract() {
    let band = frequencies(li(20.0), [0.98, 1.01]);
    let systems: Vec<System> = band.places(9).map(|at| band.system(at).expect("valid")).collect();
    let places: Vec<Place> = systems.iter().map(|one| Place::new(one, 8)).collect();
    let found = motions(&places, &Effort::default(), &Serial).expect("starts are finite");
    for (system, motions) in systems.iter().zip(&found) {
        let orbits = symmetric_orbits(system).expect("damped");
        let orbit = orbits.iter().find(|one| one.orbit.attracts()).expect("stable here");
        let motion = motions.iter().find(|one| one.is_one_to_one()).expect("1:1");
        let facts = motion.facts();
        assert!((facts.peak.value / orbit.peaks.displacement - 1.0).abs() < 1e-9, "{motion:?}");
        assert!((facts.impact_speed.value / orbit.impact_speed - 1.0).abs() < 1e-9, "{motion:?}");
        assert_eq!(motions.iter().map(|one| one.reached().starts).sum::<u32>(), 8);
    }
}

/// The largest peak of the 1:1 orbits is that at the end of their stability, where their largest multiplier is 1 to
/// rounding: it is stated to better than a thousandth, and as one motion.
#[test]
fn at_the_end_of_stability_there_is_one_motion() {
    let mut ends = 0;
    for band in bands() {
        let found = along(&band, &[], None, Some(&Effort::over(100)), &Serial).expect("valid");
        let Some(at) = found.peak_at() else { continue };
        let stability = found.stability();
        ends += usize::from(stability.windows(2).any(|pair| (at - pair[0].to).abs() < 1e-9));
        let here: Vec<_> = found.at(at).expect("it is looked at").iter().collect();
        for (k, motion) in here.iter().enumerate() {
            let facts = motion.facts();
            if motion.orbit().is_some() {
                assert!(facts.peak.error < 1e-3 * facts.peak.value, "{at}: {facts:?}");
            }
            let near = |a: f64, b: f64| (a - b).abs() < 1e-4 * a.max(b);
            for other in here[..k].iter().map(|other| other.facts()) {
                let same = near(facts.peak.value, other.peak.value)
                    && near(facts.rms.value, other.rms.value);
                assert!(!same, "{at}: {facts:?}, {other:?}");
            }
        }
    }
    assert!(ends >= 2, "{ends}");
}

/// A structure with a force that alone would move it so many clearances at resonance.
fn forced(mass_ratio: f64, damping_ratio: f64, restitution: f64, alone: f64) -> System {
    System::new(Parameters {
        mass_ratio,
        damping: 2.0 * damping_ratio / mass_ratio,
        restitution,
        frequency_ratio: 1.0,
        forcing_per_clearance: alone * 2.0 * damping_ratio / mass_ratio,
        excitation: Excitation::Force,
        cavity: Cavity::IDEAL,
    })
    .expect("valid")
}

/// The structure of the case whose root mean square was said to hold at 1.170 mm, with an error of rounding, and has 1.180 mm
/// between two places; and three others.
fn between_places() -> Vec<Band> {
    vec![
        frequencies(forced(0.018_345, 0.002_418_45, 0.229, 270.0 * 0.02175), [0.98923, 1.01731]),
        frequencies(forced(0.03, 0.004, 0.4, 4.0), [0.97, 1.02]),
        frequencies(forced(0.02, 0.003, 0.3, 6.0), [0.98, 1.02]),
        frequencies(forced(0.05, 0.01, 0.2, 5.0), [0.94, 1.05]),
    ]
}

/// No motion that repeats between the places of a band is worse than the worst of them with its error, whatever is measured.
#[test]
fn every_number_of_a_band_knows_what_may_lie_between_its_places() {
    let mut finer = 0;
    for band in between_places() {
        let wanted = [Fact::Rms, Fact::ImpactSpeed, Fact::RmsVelocity, Fact::PeakAcceleration]
            .map(|of| Extreme { of, least: false });
        let effort = Effort { shaking: true, periods: 200, ..Effort::default() };
        let found = along(&band, &wanted, None, Some(&effort), &Serial).expect("valid");
        let dense: Vec<f64> = band.places(160).collect();
        let places = dense.iter().map(|at| Place::new(&band.system(*at).expect("valid"), 3));
        let few = Effort { shaking: true, ..effort.short() };
        let truth = motions(&places.collect::<Vec<_>>(), &few, &Serial).expect("finite");
        for Extreme { of, .. } in
            wanted.into_iter().chain([Extreme { of: Fact::Peak, least: false }])
        {
            let values = found.counting(true).filter_map(|one| found.value_of(one.2, of));
            let (mut worst, mut reach) = (0.0_f64, 0.0_f64);
            for value in values {
                (worst, reach) = (worst.max(value.value), reach.max(value.value + value.error));
            }
            let repeats = |one: &&Motion| one.repeats_after().is_some();
            for (at, here) in dense.iter().zip(&truth) {
                for motion in here.iter().filter(repeats) {
                    let value = of.of(motion).expect("asked for").value;
                    assert!(value <= reach * (1.0 + 1e-9), "{of:?} at {at}: {value} above {reach}");
                    finer += u32::from(value > worst * (1.0 + 1e-6));
                }
            }
        }
    }
    assert!(finer > 0, "nothing lies between the places");
}

/// What wanders and sets how far a band reaches wanders still where that place alone is searched: it is no transient that two
/// or three starts have not left yet.
#[test]
fn no_transient_sets_the_bracket_of_a_band() {
    // The mast's second mode, a bracket in a cold box, and the bridge of `tests/decisions`.
    for band in [
        frequencies(forced(0.1, 0.005, 0.3, 9.259), [0.85, 1.1]),
        frequencies(forced(0.1, 0.005, 0.3, 9.198), [0.722, 1.278]),
        frequencies(forced(0.015, 0.004, 0.6, 1.5), [0.95, 1.05]),
    ] {
        let found = along(&band, &[], None, Some(&Effort::default()), &Serial).expect("valid");
        let reach = |one: &(f64, usize, &Motion)| {
            let peak = found.peak_of(one.2);
            peak.value + peak.error
        };
        let all = found.counting(true);
        let (at, _, motion) = all.max_by(|a, b| reach(a).total_cmp(&reach(b))).expect("one");
        println!("{at}: {} {:?}", motion.kind_name(), motion.facts().peak);
        if motion.repeats_after().is_some() {
            continue;
        }
        let place = [Place::new(&band.system(at).expect("valid"), 32)];
        let alone = motions(&place, &Effort::default(), &Serial).expect("finite").remove(0);
        assert!(alone.iter().any(|one| one.repeats_after().is_none()), "{at}: {motion:?}");
    }
}
