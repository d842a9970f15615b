//! Systems that several tests need.
#![allow(dead_code)]

pub mod random;

use vinesink::report::figure::{Figure, PlacedText, Rect};
use vinesink::simulation::{Measurement, PeriodRecord, Simulation};
use vinesink::system::{Cavity, Excitation, Parameters, State, System};

/// Table 1 of Li, Seguy, Berlioz (2016): `eps = m2 / m1`.
pub const MASS_RATIO: f64 = 0.032 / 4.168;

/// `omega0` of Table 1 in rad/s.
pub fn natural_frequency() -> f64 {
    (11.47e3_f64 / 4.168).sqrt()
}

/// `lambda` of Table 1.
pub fn damping() -> f64 {
    3.02 / (0.032 * natural_frequency())
}

/// `G` in mm with F = 0.25 mm, which is inferred, not published.
pub fn forcing_mm() -> f64 {
    0.25 / MASS_RATIO
}

/// The text of a shipped case, Table 1 at 8.35 Hz and 20 mm, up to its table `[sweep]`.
pub fn table_1_case() -> &'static str {
    let text = include_str!("../../cases/li2016-map.toml");
    let before = text.find("\n[sweep]\n").expect("cases/li2016-map.toml has no line [sweep]");
    &text[..=before]
}

/// Table 1 at a frequency in Hz and a clearance in mm.
pub fn table_1(frequency_hz: f64, clearance_mm: f64) -> System {
    System::new(Parameters {
        mass_ratio: MASS_RATIO,
        damping: damping(),
        restitution: 0.6,
        frequency_ratio: frequency_hz * std::f64::consts::TAU / natural_frequency(),
        forcing_per_clearance: forcing_mm() / clearance_mm,
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    })
    .expect("Table 1 is a valid system")
}

/// A system that nothing drives.
pub fn unforced(mass_ratio: f64, damping: f64, restitution: f64) -> System {
    System::new(Parameters {
        mass_ratio,
        damping,
        restitution,
        frequency_ratio: 1.0,
        forcing_per_clearance: 0.0,
        excitation: Excitation::Force,
        cavity: Cavity::IDEAL,
    })
    .expect("valid")
}

/// Amplitude of `v = x + eps y`, the slow amplitude `C`, in each of so many periods: that of its first harmonic.
pub fn slow_amplitudes(system: &System, start: State, periods: u64) -> Vec<f64> {
    let mut simulation = Simulation::new(system, start, 0.0).expect("inside");
    let mut measured = Measurement::begin(system, start);
    simulation.run(periods, u64::MAX, &mut measured);
    let amplitude = |one: &PeriodRecord| {
        let part =
            |k: usize| one.oscillator_harmonic[k] + system.mass_ratio() * one.absorber_harmonic[k];
        (part(0) * part(0) + part(1) * part(1)).sqrt()
    };
    measured.statistics().records().iter().map(amplitude).collect()
}

/// Periods after which falling amplitudes, each given to the middle of its period, reach a level.
pub fn periods_to(amplitudes: &[f64], level: f64) -> f64 {
    let after = amplitudes.iter().position(|amplitude| *amplitude < level).expect("it decays");
    let part = (amplitudes[after - 1] - level) / (amplitudes[after - 1] - amplitudes[after]);
    after as f64 - 0.5 + part
}

/// The words of a figure neither touch nor are cut.
pub fn words_are_apart(figure: &Figure, texts: &[PlacedText]) {
    let (right, bottom) = (f64::from(figure.size.0), f64::from(figure.size.1));
    let page = Rect { left: 0.0, top: 0.0, right, bottom };
    for (i, a) in texts.iter().enumerate() {
        assert!(page.contains(&a.room), "{}: {a:?} is cut", figure.name);
        for b in &texts[i + 1..] {
            assert!(!a.room.overlaps(&b.room), "{}: {a:?} touches {b:?}", figure.name);
        }
    }
}

/// A caption says what to see in at most two sentences, and not what the alternative text says.
pub fn caption_is_short(figure: &Figure) {
    let caption = figure.caption.replace("Fig. ", "").replace("Figs. ", "");
    let sentences = caption.split_inclusive(". ").count();
    assert!((1..=2).contains(&sentences), "{}: {sentences} sentences: {caption}", figure.name);
    assert!(caption.ends_with('.'), "{}: {caption}", figure.name);
    assert!(figure.alt.len() > 30 && figure.alt != figure.caption, "{}", figure.name);
}

/// A footbridge whose mode lies in the middle of its band.
pub const BRIDGE: &str = r#"title = "Footbridge mode 1, 2.1 Hz"
source = "made up for this test"

[oscillator]
mass = "1200 kg"
frequency = "2.1 Hz"
damping_ratio = "0.4 %"

[absorber]
mass_ratio = "1.5 %"
clearance = "50 mm"
restitution = 0.6

[excitation]
kind = "force"
amplitude = "250 N"
frequency = "2.1 Hz"
"#;
/// A band around it.
pub const BAND: &str = "\n[band]\nfrom = \"1.9 Hz\"\nto = \"2.3 Hz\"\n";
