//! What a case file means, and what is said about one that is wrong.

use vinesink::case::{
    BandOver, Case, CaseError, Design, ExtraFigure, Objective, Physical, Rounding, StartingLine,
    excitation_kinds,
};
use vinesink::quantity::catalogue::{
    ABSORBER_MASS, DAMPING, EXCITATION_FREQUENCY, IMPACT_SPEED, PEAK, STIFFNESS,
};
use vinesink::quantity::{Dimension, Units};
use vinesink::system::{Excitation, Parameter};

const PHYSICAL: &str = r#"title = "Li 2016, 8 Hz, b = 7.5 mm"
source = "Li, Seguy, Berlioz 2016, Table 1"

[oscillator]
mass = "4.168 kg"
stiffness = "11.47 kN/m"
damping = "3.02 N s/m"

[absorber]
mass = "32 g"
clearance = "7.5 mm"
restitution = 0.6

[excitation]
kind = "base-displacement"
amplitude = "0.25 mm"
frequency = "8 Hz"
"#;

const REDUCED: &str = r#"title = "reduced"
source = "made up"

[reduced]
mass_ratio = 0.0076775
damping = 1.799
restitution = 0.6
clearance = 1.0
forcing = 4.342
frequency_ratio = 0.95818
"#;

fn with(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "the test replaces {from:?}, which is not there");
    text.replacen(from, to, 1)
}

fn parsed(text: &str) -> Case {
    Case::parse("case.toml", text).unwrap_or_else(|error| panic!("{}", rendered(&error)))
}

fn physical(text: &str) -> Physical {
    match parsed(text).design {
        Design::Physical(physical) => physical,
        Design::Reduced(_) => panic!("a physical design"),
    }
}

fn refused(text: &str) -> CaseError {
    Case::parse("case.toml", text).expect_err("should be refused")
}

/// What a person sees, without colours, however wide.
fn rendered(error: &CaseError) -> String {
    let theme = miette::GraphicalTheme::unicode_nocolor();
    let handler = miette::GraphicalReportHandler::new_themed(theme).with_width(400);
    let mut shown = String::new();
    handler.render_report(&mut shown, error).expect("writing to a string");
    shown
}

/// The text is refused for one reason: this message about this underlined text at this line.
#[track_caller]
fn refused_with(text: &str, line: usize, underlined: &str, message: &str) -> CaseError {
    let error = refused(text);
    let problems: Vec<_> = error.problems().collect();
    assert_eq!(problems.len(), 1, "{}", rendered(&error));
    assert_eq!(problems[0].message, message);
    assert_eq!((problems[0].line, problems[0].underlined.as_str()), (line, underlined));
    assert_eq!(&text.trim_start_matches('\u{feff}')[problems[0].span.clone()], underlined);
    let shown = rendered(&error);
    assert!(shown.contains(&format!("case.toml:{line}:{}", problems[0].column)), "{shown}");
    assert!(problems[0].help.is_some(), "nothing says what to do: {shown}");
    error
}

#[track_caller]
fn says(error: &CaseError, words: &str) {
    let shown = rendered(error);
    assert!(shown.contains(words), "{words:?} is not in\n{shown}");
}

#[test]
fn physical_case_gives_the_system_of_table_1() {
    let case = parsed(PHYSICAL);
    let system = case.system();
    let close =
        |value: f64, expected: f64| assert!((value / expected - 1.0).abs() < 5e-5, "{value}");
    close(system.mass_ratio(), 0.0076775);
    close(system.damping(), 1.7990);
    close(system.frequency_ratio(), 8.0 / 8.3491);
    close(system.forcing_per_clearance(), 0.25 / 0.0076775 / 7.5);
    assert_eq!(system.restitution(), 0.6);
    let units = case.units();
    close(units.frequency(1.0), 8.3491);
    close(case.design.forcing(), 0.25e-3 / 0.0076775);
    assert_eq!((units.clearance, units.length_unit()), (0.0075, "m"));
    assert_eq!(units.oscillator_mass, 4.168);
}

#[test]
fn scales_have_the_dimensions_they_claim() {
    let case = parsed(PHYSICAL);
    let units = case.units();
    let omega0 = (11470.0_f64 / 4.168).sqrt();
    let close = |value: f64, expected: f64| {
        assert!((value / expected - 1.0).abs() < 1e-14, "{value} {expected}");
    };
    close(units.time(3.0), 3.0 / omega0);
    close(units.velocity(3.0), 3.0 * 0.0075 * omega0);
    close(units.acceleration(3.0), 3.0 * 0.0075 * omega0 * omega0);
    // Half the spring's energy unit: k1 b^2 is m1 omega0^2 b^2.
    close(units.energy(0.5), 0.5 * 11470.0 * 0.0075 * 0.0075);
    close(units.frequency_ratio(8.0), case.system().frequency_ratio());
    close(units.over_clearance(units.length(2.5)), 2.5);
}

#[test]
fn reduced_case_keeps_its_numbers_and_its_own_unit() {
    let case = parsed(REDUCED);
    let system = case.system();
    assert_eq!(system.frequency_ratio(), 0.95818);
    assert_eq!(system.forcing_per_clearance(), 4.342);
    assert_eq!(system.excitation(), Excitation::BaseDisplacement);
    // As an oscillator with m1 = k1 = 1: nothing but lengths has a scale of its own.
    let units = case.units();
    assert_eq!((units.length_unit(), units.physical), ("1", false));
    assert_eq!(
        [units.frequency(0.9), units.frequency_ratio(0.9), units.time(3.0)],
        [0.9, 0.9, 3.0]
    );
    assert_eq!([units.velocity(3.0), units.acceleration(3.0), units.energy(3.0)], [3.0; 3]);
    let force = parsed(&(REDUCED.to_owned() + "kind = \"force\"\n"));
    assert_eq!(force.system().excitation(), Excitation::Force);
}

#[test]
fn detuning_is_exact_however_small_the_mass_ratio() {
    for mass_ratio in ["0.0076775", "1e-9", "1e-15", "1e-40"] {
        let text = with(REDUCED, "frequency_ratio = 0.95818", "detuning = -0.3");
        let case = parsed(&with(&text, "0.0076775", mass_ratio));
        assert_eq!(case.system().detuning(), -0.3, "mass ratio {mass_ratio}");
        let doubled = case.system().with_clearance_scaled(2.0).expect("a valid clearance");
        assert_eq!(doubled.detuning(), -0.3, "mass ratio {mass_ratio}");
        let Design::Reduced(reduced) = case.design else { panic!("a reduced design") };
        assert_eq!((reduced.frequency_ratio, reduced.detuning), (None, Some(-0.3)));
    }
}

#[test]
fn force_of_stiffness_times_displacement_reduces_to_the_same_forcing() {
    let base = parsed(&with(PHYSICAL, "0.25 mm", "1 mm")).system();
    let text = with(PHYSICAL, "base-displacement", "force");
    let force = parsed(&with(&text, "0.25 mm", "11.47 N")).system();
    let ratio = force.forcing_per_clearance() / base.forcing_per_clearance();
    assert!((ratio - 1.0).abs() < 1e-15);
    assert_eq!(force.excitation(), Excitation::Force);
}

#[test]
fn ratios_may_replace_mass_and_damping() {
    let text = with(PHYSICAL, "mass = \"32 g\"", "mass_ratio = 0.5");
    let half = physical(&with(&text, "damping = \"3.02 N s/m\"", "damping_ratio = 0.01"));
    assert_eq!(half.absorber_mass_kg, 2.084);
    let critical = 2.0 * (11470.0_f64 * 4.168).sqrt();
    assert!((half.damping_n_s_per_m / critical - 0.01).abs() < 1e-16);
}

#[test]
fn ratios_may_be_shares() {
    let text = with(PHYSICAL, "mass = \"32 g\"", "mass_ratio = \"3 %\"");
    let text = with(&text, "damping = \"3.02 N s/m\"", "damping_ratio = \"0.5 %\"");
    let plain = with(&with(&text, "\"3 %\"", "0.03"), "\"0.5 %\"", "0.005");
    assert_eq!(physical(&text), physical(&plain));
    let case = parsed(&text);
    let input = case.inputs().iter().find(|input| input.name == "mass_ratio").expect("an input");
    assert_eq!((input.value, input.unit, input.as_written.as_str()), (0.03, "1", "3 %"));
    // Written again it stays a share.
    let choice = case.design.with(Parameter::AbsorberMass, 0.2);
    let again = case.rewritten("again", &text, &choice, Rounding::Exact).expect("a case");
    let line = again.text.lines().find(|line| line.starts_with("mass_ratio")).expect("a line");
    let share = line.strip_prefix("mass_ratio = \"").and_then(|rest| rest.strip_suffix(" %\""));
    let share: f64 = share.expect(line).parse().expect("a number");
    assert!((share - 100.0 * 0.2 / 4.168).abs() < 1e-12, "{line}");
    assert!((physical(&again.text).absorber_mass_kg - 0.2).abs() < 1e-15);

    let of = |value: &str| {
        with(PHYSICAL, "damping = \"3.02 N s/m\"", &format!("damping_ratio = {value}"))
    };
    refused_with(&of("\"-1 %\""), 7, "\"-1 %\"", "`damping_ratio` is -1 %");
    let message = "`damping_ratio` is a share, but `mm` is the unit of a length";
    refused_with(&of("\"1 mm\""), 7, "mm", message);
    let message = "`damping_ratio` is a number in quotes without %";
    let error = refused_with(&of("\"0.005\""), 7, "\"0.005\"", message);
    says(&error, "if per cent is meant, damping_ratio = \"0.005 %\"");
    let error = refused_with(&of("true"), 7, "true", "`damping_ratio` is true or false");
    says(&error, "expected a number 0 or more without quotes, or a share such as \"0.69 %\"");
}

#[test]
fn a_natural_frequency_may_replace_the_stiffness() {
    let of = |lines: &str| with(PHYSICAL, "stiffness = \"11.47 kN/m\"", lines);
    let text = of("frequency = \"8 Hz\"");
    let omega0 = 8.0 * std::f64::consts::TAU;
    let found = physical(&text);
    assert!((found.stiffness_n_per_m / (4.168 * omega0 * omega0) - 1.0).abs() < 1e-15);
    assert!((found.natural_frequency_rad_per_s() / omega0 - 1.0).abs() < 1e-15);
    assert!((parsed(&text).system().frequency_ratio() - 1.0).abs() < 1e-15, "driven at it");
    let per_second = physical(&of("frequency = \"50 rad/s\"")).natural_frequency_rad_per_s();
    assert!((per_second / 50.0 - 1.0).abs() < 1e-15);
    // A damping ratio is one of the stiffness that follows.
    let text = with(&text, "damping = \"3.02 N s/m\"", "damping_ratio = 0.01");
    let critical = 2.0 * 4.168 * omega0;
    assert!((physical(&text).damping_n_s_per_m / critical - 0.01).abs() < 1e-16);

    let both = of("frequency = \"8 Hz\"\nstiffness = \"11.47 kN/m\"");
    let message = "`stiffness` and `frequency` say the same thing twice";
    refused_with(&both, 7, "stiffness", message);
    let message = "`stiffness` or `frequency` is missing in [oscillator]";
    let error = refused_with(&of("# neither"), 4, "oscillator", message);
    says(&error, "add the line stiffness = \"11.47 kN/m\"  or  frequency = \"8.35 Hz\"");
    refused_with(&of("frequency = \"0 Hz\""), 6, "\"0 Hz\"", "`frequency` is 0 Hz");
    refused_with(&of("frequency = 8"), 6, "8", "`frequency` has no unit");
    let message = "a natural frequency with this mass gives a stiffness of inf N/m";
    refused_with(&of("frequency = \"1e200 Hz\""), 6, "\"1e200 Hz\"", message);
}

#[test]
fn extremes_with_a_physical_meaning_are_accepted() {
    for (from, to) in [
        ("restitution = 0.6", "restitution = 0"),
        ("restitution = 0.6", "restitution = 1"),
        ("restitution = 0.6", "restitution = 1.0"),
        ("7.5 mm", "1 um"),
        ("7.5 mm", "1 µm"),
        ("3.02 N s/m", "0 N s/m"),
        ("damping = \"3.02 N s/m\"", "damping_ratio = 0"),
        ("mass = \"32 g\"", "mass_ratio = 0.5"),
        ("0.25 mm", "0 mm"),
        ("0.25 mm", "-0 mm"),
    ] {
        let system = parsed(&with(PHYSICAL, from, to)).system();
        assert!(system.forcing_per_clearance().is_sign_positive(), "{to}");
    }
}

#[track_caller]
fn reads(dimension: Dimension, text: &str, si: f64) {
    assert_eq!(dimension.parse(text), Ok(si), "{text}");
}

#[test]
fn units_are_converted_with_a_single_rounding() {
    reads(Dimension::Length, "7.5 mm", 0.0075);
    reads(Dimension::Length, "7.5mm", 0.0075);
    reads(Dimension::Length, "  +.3 mm ", 0.0003);
    reads(Dimension::Length, "5. cm", 0.05);
    reads(Dimension::Length, "1e3 um", 0.001);
    reads(Dimension::Length, "1 \u{b5}m", 1e-6);
    reads(Dimension::Length, "1 \u{3bc}m", 1e-6);
    // 0.001 * 2.1 is an ulp away from 0.0021; moving the decimal point is not.
    assert_ne!(2.1 * 1e-3, 0.0021);
    reads(Dimension::Length, "2.1 mm", 0.0021);
}

#[test]
fn every_dimension_reads_its_units() {
    reads(Dimension::Mass, "32 g", 0.032);
    reads(Dimension::Mass, "4.168 kg", 4.168);
    reads(Dimension::Mass, "250 mg", 0.00025);
    reads(Dimension::Stiffness, "11.47 kN/m", 11470.0);
    reads(Dimension::Stiffness, "11.47 N/mm", 11470.0);
    reads(Dimension::Stiffness, "2 MN / m", 2e6);
    for unit in ["N s/m", "N*s/m", "N·s/m", "N⋅s/m", "Ns/m", "N  s / m", "N * s/m", "kg/s"] {
        reads(Dimension::Damping, &format!("3.02 {unit}"), 3.02);
    }
    reads(Dimension::Damping, "3.02 N s/mm", 3020.0);
    reads(Dimension::Frequency, "8 Hz", 8.0);
    reads(Dimension::Frequency, "0.008 kHz", 8.0);
    reads(Dimension::Frequency, "2 rad/s", 2.0 / std::f64::consts::TAU);
    reads(Dimension::Force, "2.9 N", 2.9);
    reads(Dimension::Force, "2900 mN", 2.9);
}

/// By their definitions: the yard and pound agreement of 1959, standard gravity of 1901.
#[test]
fn units_of_inch_and_pound_are_what_they_are_defined_as() {
    reads(Dimension::Length, "1 in", 0.0254);
    reads(Dimension::Length, "0.3 in", 0.00762);
    reads(Dimension::Mass, "1 lb", 0.453_592_37);
    reads(Dimension::Mass, "16 oz", 0.453_592_37);
    reads(Dimension::Mass, "1 oz", 0.028_349_523_125);
    reads(Dimension::Force, "1 lbf", 4.448_221_615_260_5);
    // 0.453 592 37 * 9.806 65 is 4.448 221 615 260 5 in whole numbers as well.
    assert_eq!(45_359_237_u64 * 980_665, 44_482_216_152_605);
    reads(Dimension::Stiffness, "254 lbf/in", 44_482.216_152_605);
    reads(Dimension::Damping, "254 lbf s/in", 44_482.216_152_605);
    reads(Dimension::Impulse, "1 lbf s", 4.448_221_615_260_5);
    reads(Dimension::Frequency, "1800 rpm", 30.0);
    reads(Dimension::Frequency, "90 cpm", 1.5);
    reads(Dimension::Velocity, "10 in/s", 0.254);
    reads(Dimension::Acceleration, "100 in/s²", 2.54);
    reads(Dimension::AccelerationDensity, "0.5 g2/Hz", 0.5 * 96.170_384_222_5);
    for one in ["(m/s²)²/Hz", "(m/s2)2/Hz", "m2/s3", "m²/s³"] {
        reads(Dimension::AccelerationDensity, &format!("0.02 {one}"), 0.02);
    }
}

/// `g` is what its key asks for.
#[test]
fn a_gram_is_no_gravity() {
    reads(Dimension::Mass, "2 g", 0.002);
    reads(Dimension::Acceleration, "2 g", 19.6133);
    let text = with(PHYSICAL, "clearance = \"7.5 mm\"", "clearance = \"7.5 lb\"");
    refused_with(&text, 11, "lb", "`clearance` is a length, but `lb` is the unit of a mass");
}

#[test]
fn prefixes_are_the_powers_of_ten_they_stand_for() {
    for (unit, si) in
        [("km", 1e3), ("m", 1.0), ("cm", 1e-2), ("mm", 1e-3), ("um", 1e-6), ("nm", 1e-9)]
    {
        reads(Dimension::Length, &format!("1 {unit}"), si);
    }
    for (unit, si) in
        [("t", 1e3), ("kg", 1.0), ("g", 1e-3), ("mg", 1e-6), ("ug", 1e-9), ("µg", 1e-9)]
    {
        reads(Dimension::Mass, &format!("1 {unit}"), si);
    }
    for (unit, si) in [
        ("N/m", 1.0),
        ("kN/m", 1e3),
        ("MN/m", 1e6),
        ("mN/m", 1e-3),
        ("N/mm", 1e3),
        ("kN/mm", 1e6),
        ("N/cm", 1e2),
        ("N/um", 1e6),
        ("N/µm", 1e6),
    ] {
        reads(Dimension::Stiffness, &format!("1 {unit}"), si);
    }
    for (unit, si) in [
        ("kN s/m", 1e3),
        ("kNs/m", 1e3),
        ("mN s/m", 1e-3),
        ("mNs/m", 1e-3),
        ("Ns/mm", 1e3),
        ("g/s", 1e-3),
    ] {
        reads(Dimension::Damping, &format!("1 {unit}"), si);
    }
    for (unit, si) in [("km/s", 1e3), ("m/s", 1.0), ("cm/s", 1e-2), ("mm/s", 1e-3), ("um/s", 1e-6)]
    {
        reads(Dimension::Velocity, &format!("1 {unit}"), si);
    }
    for (unit, si) in [("Hz", 1.0), ("mHz", 1e-3), ("kHz", 1e3), ("MHz", 1e6)] {
        reads(Dimension::Frequency, &format!("1 {unit}"), si);
    }
    for (unit, si) in
        [("N", 1.0), ("mN", 1e-3), ("kN", 1e3), ("MN", 1e6), ("uN", 1e-6), ("nN", 1e-9)]
    {
        reads(Dimension::Force, &format!("1 {unit}"), si);
    }
}

/// What a page shows can be written in a case.
#[test]
fn units_that_are_shown_are_read() {
    let units = Units::physical(0.01);
    for kind in [&PEAK, &ABSORBER_MASS, &STIFFNESS, &DAMPING, &EXCITATION_FREQUENCY, &IMPACT_SPEED]
    {
        for power in -10..12 {
            let si = libm::pow(10.0, f64::from(power)) * 2.0;
            let unit = units.unit(kind.dimension, si);
            reads(kind.dimension, &format!("1 {}", unit.symbol), unit.size);
        }
    }
    let structure = with(PHYSICAL, "4.168 kg", "4.168 t");
    assert_eq!(physical(&structure).mass_kg, 4168.0);
}

#[test]
fn quantities_of_one_dimension_divide_to_a_number() {
    let length = |text| Dimension::Length.parse(text).expect("a length");
    assert_eq!(length("7.5 mm") / length("0.25 mm"), 30.0);
}

#[test]
fn empty_files_are_told_how_to_begin() {
    for text in ["", "\u{feff}", "# nothing yet\n", "\r\n\r\n"] {
        let error = refused_with(text, 1, "", "the file describes no case");
        says(&error, "vinesink new NAME");
    }
}

#[test]
fn restitution_beyond_1() {
    let text = with(PHYSICAL, "restitution = 0.6", "restitution = 1.2");
    let error = refused_with(&text, 12, "1.2", "`restitution` is 1.2");
    says(&error, "expected a value from 0 to 1");
    says(&error, "restitution = 1.2");
}

#[test]
fn values_out_of_their_range() {
    for (from, to, line, underlined, message, expected) in [
        ("\"4.168 kg\"", "\"0 kg\"", 5, "\"0 kg\"", "`mass` is 0 kg", "above 0"),
        ("11.47 kN/m", "-1 N/m", 6, "\"-1 N/m\"", "`stiffness` is -1 N/m", "above 0"),
        ("3.02 N s/m", "-1 kg/s", 7, "\"-1 kg/s\"", "`damping` is -1 kg/s", "0 or more"),
        ("7.5 mm", "0 mm", 11, "\"0 mm\"", "`clearance` is 0 mm", "above 0"),
        ("0.6", "-0.1", 12, "-0.1", "`restitution` is -0.1", "from 0 to 1"),
        ("0.25 mm", "-1 mm", 16, "\"-1 mm\"", "`amplitude` is -1 mm", "0 or more"),
        ("8 Hz\"\n", "0 Hz\"\n", 17, "\"0 Hz\"", "`frequency` is 0 Hz", "above 0"),
    ] {
        // The title mentions 8 Hz and 7.5 mm too: replace behind it only.
        let (head, body) = PHYSICAL.split_at(PHYSICAL.find("[oscillator]").expect("there"));
        let error =
            refused_with(&(head.to_owned() + &with(body, from, to)), line, underlined, message);
        says(&error, &format!("expected a value {expected}"));
    }
}

#[test]
fn numbers_that_are_not_finite() {
    let error = refused_with(
        &with(PHYSICAL, "restitution = 0.6", "restitution = nan"),
        12,
        "nan",
        "`restitution` is nan",
    );
    says(&error, "expected a finite value from 0 to 1");
    let text = with(PHYSICAL, "mass = \"32 g\"", "mass_ratio = inf");
    refused_with(&text, 10, "inf", "`mass_ratio` is inf");
    let text = with(REDUCED, "frequency_ratio = 0.95818", "detuning = -inf");
    refused_with(&text, 10, "-inf", "`detuning` is -inf");
    for (written, message) in [
        ("inf mm", "`clearance` is \"inf mm\", which is not a finite number"),
        ("NaN mm", "`clearance` is \"NaN mm\", which is not a finite number"),
        ("1e999 mm", "`clearance` is 1e999 mm, too large"),
        ("1e-999 mm", "`clearance` is 1e-999 mm, too small to be told from 0"),
    ] {
        let text = with(PHYSICAL, "clearance = \"7.5 mm\"", &format!("clearance = \"{written}\""));
        let error = refused(&text);
        assert_eq!(error.to_string(), message);
        says(&error, "expected a length such as \"7.5 mm\"");
    }
}

#[test]
fn a_unit_of_another_dimension() {
    let text = with(PHYSICAL, "clearance = \"7.5 mm\"", "clearance = \"7.5 kg\"");
    let message = "`clearance` is a length, but `kg` is the unit of a mass";
    let error = refused_with(&text, 11, "kg", message);
    says(&error, "a length is accepted in km, m, mm, um, nm, cm, in");
}

#[test]
fn an_amplitude_that_suits_the_other_kind() {
    let text = with(PHYSICAL, "0.25 mm", "2.9 N");
    let message = "`amplitude` is a length, but `N` is the unit of a force";
    says(&refused_with(&text, 16, "N", message), "if a force is meant, write kind = \"force\"");
    let text = with(PHYSICAL, "base-displacement", "force");
    let message = "`amplitude` is a force, but `mm` is the unit of a length";
    says(&refused_with(&text, 16, "mm", message), "write kind = \"base-displacement\"");
}

#[test]
fn a_missing_unit() {
    let text = with(PHYSICAL, "clearance = \"7.5 mm\"", "clearance = 7.5");
    let error = refused_with(&text, 11, "7.5", "`clearance` has no unit");
    says(&error, "clearance = \"7.5 mm\"");
    let text = with(PHYSICAL, "clearance = \"7.5 mm\"", "clearance = \"7.5\"");
    let error = refused_with(&text, 11, "\"7.5\"", "`clearance` has no unit");
    says(&error, "expected a length such as \"7.5 mm\"");
}

#[test]
fn a_misspelled_unit() {
    let text = with(PHYSICAL, "\"8 Hz\"\n", "\"8 hz\"\n");
    says(
        &refused_with(&text, 17, "hz", "`frequency` has the unknown unit `hz`"),
        "did you mean `Hz`?",
    );
    let text = with(PHYSICAL, "\"32 g\"", "\"32 gr\"");
    refused_with(&text, 10, "gr", "`mass` has the unknown unit `gr`");
    let text = with(PHYSICAL, "clearance = \"7.5 mm\"", "clearance = \"0.3 ft\"");
    refused_with(&text, 11, "ft", "`clearance` has the unknown unit `ft`");
}

#[test]
fn texts_that_are_no_quantity() {
    for (written, message) in [
        ("7,5 mm", "`clearance` has a comma where a decimal point belongs"),
        ("mm", "`clearance` is \"mm\", a unit without a number"),
        ("wide", "`clearance` is \"wide\", which does not begin with a number"),
        ("", "`clearance` is empty"),
        (".", "`clearance` is \".\", which does not begin with a number"),
        ("7.5 m m", "`clearance` has the unknown unit `m m`"),
        ("1e99999999999 m", "`clearance` has an absurd exponent in 1e99999999999"),
    ] {
        let text = with(PHYSICAL, "clearance = \"7.5 mm\"", &format!("clearance = \"{written}\""));
        assert_eq!(refused(&text).to_string(), message);
    }
}

#[test]
fn a_quantity_where_a_plain_number_belongs_and_the_reverse() {
    let text = with(REDUCED, "damping = 1.799", "damping = \"3.02 N s/m\"");
    let message = "`damping` is text, where a plain number belongs";
    refused_with(&text, 6, "\"3.02 N s/m\"", message);
    let text = with(PHYSICAL, "clearance = \"7.5 mm\"", "clearance = true");
    refused_with(&text, 11, "true", "`clearance` is true or false");
}

#[test]
fn a_misspelled_key_is_one_error_not_two() {
    let text = with(PHYSICAL, "clearance =", "clearence =");
    let error = refused_with(&text, 11, "clearence", "unknown key `clearence` in [absorber]");
    says(&error, "did you mean `clearance`?");
    says(&error, "expected one of mass, mass_ratio, clearance, restitution");
}

#[test]
fn keys_and_tables_nobody_knows() {
    let text = PHYSICAL.to_owned() + "\n[colour]\nred = 1\n";
    let error = refused_with(&text, 19, "colour", "unknown table `colour`");
    says(&error, "oscillator, absorber, excitation, reduced, simulation");
    let text = with(PHYSICAL, "[excitation]", "[exitation]");
    let error = refused_with(&text, 14, "exitation", "unknown table `exitation`");
    says(&error, "did you mean `excitation`?");
    let text = with(PHYSICAL, "restitution = 0.6", "restitution = 0.6\nstiffness = \"1 N/m\"");
    let error = refused_with(&text, 13, "stiffness", "unknown key `stiffness` in [absorber]");
    says(&error, "`stiffness` belongs in [oscillator]");
}

#[test]
fn missing_keys_and_tables_point_at_their_table() {
    let text = with(PHYSICAL, "clearance = \"7.5 mm\"\n", "");
    let error = refused_with(&text, 9, "absorber", "`clearance` is missing in [absorber]");
    says(&error, "add the line clearance = \"7.5 mm\"");
    let text = with(PHYSICAL, "damping = \"3.02 N s/m\"\n", "");
    let message = "`damping` or `damping_ratio` is missing in [oscillator]";
    refused_with(&text, 4, "oscillator", message);
    let absorber = &PHYSICAL
        [PHYSICAL.find("[absorber]").expect("there")..PHYSICAL.find("[exc").expect("there")];
    let error = refused_with(
        &with(PHYSICAL, absorber, ""),
        4,
        "oscillator",
        "the table [absorber] is missing",
    );
    says(&error, "add a line [absorber]");
    let text = with(PHYSICAL, "source = \"Li, Seguy, Berlioz 2016, Table 1\"\n", "");
    let first = "title = \"Li 2016, 8 Hz, b = 7.5 mm\"";
    says(&refused_with(&text, 1, first, "`source` is missing"), "where the numbers come from");
    refused_with(
        "title = \"a\"\nsource = \"b\"\n",
        1,
        "title = \"a\"",
        "the file describes no design",
    );
}

#[test]
fn alternatives_exclude_each_other() {
    let text = with(PHYSICAL, "mass = \"32 g\"", "mass_ratio = 0.01\nmass = \"32 g\"");
    let message = "`mass` and `mass_ratio` say the same thing twice";
    refused_with(&text, 11, "mass", message);
    let text = REDUCED.to_owned() + "detuning = -5\n";
    let message = "`frequency_ratio` and `detuning` say the same thing twice";
    refused_with(&text, 11, "detuning", message);
    let both = PHYSICAL.to_owned() + &REDUCED[REDUCED.find("[reduced]").expect("there")..];
    let message = "[reduced] and [oscillator] both describe the design";
    refused_with(&both, 18, "reduced", message);
}

#[test]
fn texts_that_are_missing_or_blank_or_unknown() {
    let text = with(PHYSICAL, "\"Li, Seguy, Berlioz 2016, Table 1\"", "\" \"");
    says(&refused_with(&text, 2, "\" \"", "`source` is empty"), "where the numbers come from");
    let text = with(PHYSICAL, "\"Li 2016, 8 Hz, b = 7.5 mm\"", "7");
    refused_with(&text, 1, "7", "`title` is a number");
    let text = with(PHYSICAL, "\"base-displacement\"", "\"base_displacement\"");
    let error = refused_with(&text, 15, "\"base_displacement\"", "`kind` is \"base_displacement\"");
    says(&error, "did you mean \"base-displacement\"?");
}

#[test]
fn a_detuning_that_leaves_no_frequency() {
    let text = with(REDUCED, "frequency_ratio = 0.95818", "detuning = -200");
    let error = refused(&text);
    assert!(error.to_string().starts_with("`detuning` is -200, so that"), "{error}");
    says(&error, "expected a detuning that leaves the frequency ratio finite and above 0");
}

#[test]
fn values_that_only_together_cannot_be_held() {
    let text = with(PHYSICAL, "0.25 mm", "1e300 mm");
    let message = "the values together give a forcing_per_clearance of inf";
    refused_with(
        &with(&text, "clearance = \"7.5 mm\"", "clearance = \"1e-300 m\""),
        4,
        "oscillator",
        message,
    );
}

#[test]
fn toml_that_does_not_parse() {
    let text = with(PHYSICAL, "clearance = \"7.5 mm\"", "clearance = 7.5 mm # half the gap");
    let error = refused(&text);
    assert!(error.to_string().starts_with("the file is not valid TOML: "), "{error}");
    assert_eq!(error.problems().map(|problem| problem.line).collect::<Vec<_>>(), [11]);
    says(&error, "write clearance = \"7.5 mm\"");
    let text = with(PHYSICAL, "restitution = 0.6", "restitution = 0.6\nrestitution = 0.7");
    let error = refused_with(&text, 13, "restitution", "the file is not valid TOML: duplicate key");
    says(&error, "keep one of the two");
    for text in ["[oscillator", "title = \"unfinished\n", "= 1\n", "title\n", "\0", "a = \"\\q\"\n"]
    {
        let error = refused(text);
        assert!(
            error.problems().all(|problem| problem.message.contains("not valid TOML")),
            "{text:?}"
        );
        rendered(&error);
    }
}

#[test]
fn several_errors_are_shown_together_in_the_order_of_the_lines() {
    let text = with(PHYSICAL, "restitution = 0.6", "restitution = 2");
    let text = with(&text, "\"4.168 kg\"", "4.168");
    let error = refused(&with(&text, "frequency", "frequancy"));
    let lines: Vec<usize> = error.problems().map(|problem| problem.line).collect();
    assert_eq!(lines, [5, 12, 17]);
    assert_eq!(error.to_string(), "case.toml has 3 errors");
    for place in ["case.toml:5:8", "case.toml:12:15", "case.toml:17:1"] {
        says(&error, place);
    }
}

#[test]
fn line_ends_change_nothing_and_a_byte_order_mark_the_hash_alone() {
    let plain = parsed(PHYSICAL);
    for text in [PHYSICAL.replace('\n', "\r\n"), format!("\u{feff}{PHYSICAL}")] {
        let case = parsed(&text);
        assert_eq!((case.design, case.system()), (plain.design, plain.system()));
        // A checkout may change line ends, and adds no mark.
        assert_eq!(case.text_hash == plain.text_hash, !text.starts_with('\u{feff}'));
    }
    let windows = with(PHYSICAL, "= \"7.5 mm\"", "= 7.5").replace('\n', "\r\n");
    refused_with(&format!("\u{feff}{windows}"), 11, "7.5", "`clearance` has no unit");
}

#[test]
fn columns_count_characters() {
    let text = with(PHYSICAL, "clearance = \"7.5 mm\"", "clearance = \"7.5 µg\"");
    let error =
        refused_with(&text, 11, "µg", "`clearance` is a length, but `µg` is the unit of a mass");
    assert_eq!(error.problems().next().map(|problem| problem.column), Some(18));
}

#[test]
fn simulation_settings_are_whole_numbers_within_bounds() {
    let settings = |lines: &str| PHYSICAL.to_owned() + "[simulation]\n" + lines;
    let case = parsed(&settings("periods = 100_000_000\ndiscard = 0\n"));
    assert_eq!(case.simulation.periods, Some(100_000_000));
    assert_eq!((case.simulation.discard, case.simulation.starts), (Some(0), None));
    for (line, underlined, message) in [
        ("periods = 0", "0", "`periods` is 0"),
        ("periods = 100_000_001", "100_000_001", "`periods` is 100000001"),
        ("discard = -1", "-1", "`discard` is -1"),
        ("starts = 10001", "10001", "`starts` is 10001"),
        ("starts = 1.5", "1.5", "`starts` is 1.5"),
        ("starts = \"8\"", "\"8\"", "`starts` is 8"),
    ] {
        says(&refused_with(&settings(line), 19, underlined, message), "expected a whole number");
    }
}

#[test]
fn a_report_may_hold_further_figures() {
    assert!(parsed(PHYSICAL).report.figures.is_empty());
    let names = ExtraFigure::ALL.map(|figure| format!("\"{}\"", figure.name()));
    let text = format!("{PHYSICAL}\n[report]\nfigures = [{}]\n", names.join(", "));
    assert_eq!(parsed(&text).report.figures, ExtraFigure::ALL);
    assert_eq!(parsed(&text).system(), parsed(PHYSICAL).system());
    assert_eq!(parsed(&text).inputs(), parsed(PHYSICAL).inputs());
    assert!(parsed(&format!("{REDUCED}\n[report]\n")).report.figures.is_empty());
}

#[test]
fn figures_that_do_not_exist_are_refused() {
    let list = |line: &str| format!("{PHYSICAL}\n[report]\n{line}\n");
    let unknown = list("figures = [\"areas\", \"tranfser\"]");
    let error = refused_with(&unknown, 20, "\"tranfser\"", "a value of `figures` is \"tranfser\"");
    says(&error, "did you mean \"transfer\"?");
    says(
        &error,
        "expected \"areas\", \"bifurcations\", \"forcing-responses\", \"modulation\", \"restitutions\"",
    );
    let usual = refused_with(
        &list("figures = [\"map\"]"),
        20,
        "\"map\"",
        "a value of `figures` is \"map\"",
    );
    says(&usual, "the usual figures are in every report");
    let twice = list("figures = [\"areas\",\n  \"areas\"]");
    let error = refused_with(&twice, 21, "\"areas\"", "`figures` names \"areas\" twice");
    says(&error, "expected each once");
    let number = "a value of `figures` is 7";
    refused_with(&list("figures = [7]"), 20, "7", number);
    let text = "`figures` is text, but it is a list";
    says(&refused_with(&list("figures = \"areas\""), 20, "\"areas\"", text), "between brackets");
    let key = "unknown key `figure` in [report]";
    says(
        &refused_with(&list("figure = [\"areas\"]"), 20, "figure", key),
        "did you mean `figures`?",
    );
}

#[test]
fn inputs_are_listed_as_written_and_in_si() {
    let case = parsed(PHYSICAL);
    let listed: Vec<_> =
        case.inputs().iter().map(|i| (i.name, i.value, i.unit, i.as_written.as_str())).collect();
    assert_eq!(
        listed,
        [
            ("mass", 4.168, "kg", "4.168 kg"),
            ("stiffness", 11470.0, "N/m", "11.47 kN/m"),
            ("damping", 3.02, "N s/m", "3.02 N s/m"),
            ("mass", 0.032, "kg", "32 g"),
            ("clearance", 0.0075, "m", "7.5 mm"),
            ("restitution", 0.6, "1", "0.6"),
            ("amplitude", 0.00025, "m", "0.25 mm"),
            ("frequency", 8.0, "Hz", "8 Hz"),
        ]
    );
    let derived = case.derived();
    let value =
        |name: &str| derived.iter().find(|i| i.name == name).map(|i| i.value).expect("derived");
    assert!((value("natural_frequency") - 8.3491).abs() < 5e-5);
    assert!((value("damping_ratio") - 3.02 / (2.0 * (11470.0_f64 * 4.168).sqrt())).abs() < 1e-15);
    assert_eq!(value("forcing_per_clearance"), case.system().forcing_per_clearance());
}

#[test]
fn the_text_is_identified_by_its_sha256() {
    let case = parsed(REDUCED);
    assert_eq!(case.text_hash.len(), 64);
    assert_ne!(case.text_hash, parsed(&(REDUCED.to_owned() + "\n")).text_hash);
    assert_eq!(case.text_hash, parsed(REDUCED).text_hash);
}

#[test]
fn errors_travel_as_reports() {
    fn report(text: &str) -> miette::Result<Case> {
        Ok(Case::parse("case.toml", text)?)
    }
    let error = report(&with(PHYSICAL, "0.6", "6")).expect_err("beyond 1");
    assert!(error.downcast_ref::<CaseError>().is_some());
}

#[test]
fn the_starting_case_parses_under_any_title() {
    for title in ["damper", "quote \" and back\\slash", "line\nbreak", "été"] {
        let case = parsed(&Case::starting_text(title));
        assert_eq!(case.title, title);
    }
    assert!(Case::starting_text("x").starts_with("#:schema vinesink.schema.json\n"));
}

/// A comment that holds a line of a case, without its sign.
fn uncommented(line: &str) -> Option<&str> {
    let rest = line.strip_prefix("# ")?;
    let key = rest.split_once(" = ").map_or("", |(key, _)| key);
    let is_key = !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    (rest.starts_with('[') || rest.starts_with(' ') || is_key).then_some(rest)
}

/// Every optional table and every key of it can be found in the starting case, and nothing else that is
/// there has to be changed to use one.
#[test]
fn the_starting_case_shows_every_optional_key_and_parses_without_its_comment_signs() {
    let text = Case::starting_text("x");
    let plain = parsed(&text);
    assert!(plain.band.is_none() && plain.criteria.is_empty() && !plain.uncertainty.is_any());
    // The other kinds of excitation are read by the next test.
    let (before, kinds) = text.split_once("# Or another kind").expect("kinds");
    let (kinds, after) = kinds.split_once("\n\n").expect("their end");
    let own = [before, after].concat();
    let lines: Vec<&str> = own.lines().map(|line| uncommented(line).unwrap_or(line)).collect();
    let full = lines.join("\n") + kinds;
    // Areas of the theory, and what asks for them, are those of an ideal cavity: its keys are read apart.
    let keys = ["inclination = \"0.5 deg\"", "friction = 0.003", "orientation = \"vertical\""];
    let of_cavity = |line: &&str| keys.iter().any(|key| line.starts_with(key));
    let others: Vec<&str> = lines.iter().copied().filter(|line| !of_cavity(line)).collect();
    assert_eq!(others.len() + keys.len(), lines.len());
    let with_cavity =
        keys[..2].iter().fold(text.clone(), |text, key| text.replace(&format!("# {key}"), key));
    let case = parsed(&others.join("\n"));
    // Of a structure that is driven steadily all but `decay_time`.
    assert_eq!(case.criteria.len(), 14);
    assert_eq!(case.uncertainty.parameters().count(), 10);
    let cavity = parsed(&with_cavity).system().cavity();
    assert!(cavity.gravity_along > 0.0 && cavity.friction_acceleration > 0.0, "{cavity:?}");
    let band = case.band.expect("a band");
    assert_eq!((band.over, band.spectrum.len()), (BandOver::Frequency, 2));
    let optimize = case.optimize;
    assert!(
        optimize.clearance.is_some() && optimize.restitution.is_some() && optimize.mass.is_some()
    );
    // Whatever the schema has, the text has; what excludes each other stands behind its alternative.
    let schema = &vinesink::case::schema()["$defs"]["one"];
    let tables =
        ["simulation", "report", "accuracy", "alternatives", "band", "criteria", "optimize"];
    for table in tables.into_iter().chain(["uncertainty"]) {
        let (_, own) = full.split_once(&format!("\n[{table}]\n")).expect(table);
        let own = own.split("\n[").next().unwrap_or(own);
        let keys = schema["properties"][table]["properties"].as_object().expect("keys");
        for key in keys.keys() {
            assert!(own.contains(&format!("{key} = ")), "{key} is not in [{table}]");
        }
    }
    for table in ["oscillator", "absorber", "excitation"] {
        let keys = schema["properties"][table]["properties"].as_object().expect("keys");
        for key in keys.keys() {
            assert!(full.contains(&format!("{key} = ")), "{key} of [{table}] is not shown");
        }
    }
    for objective in Objective::ALL {
        assert!(full.contains(&format!("\"{}\"", objective.name())), "{objective:?}");
    }
    assert!(full.contains("of = \"frequency\"") && full.contains("or \"amplitude\""));
}

/// Each kind of excitation that a case may begin with can be read as it is.
#[test]
fn a_starting_case_of_any_kind_is_valid() {
    let mut scenes = std::collections::BTreeSet::new();
    for kind in excitation_kinds() {
        let text = Case::starting_text_of("x", kind);
        assert!(text.contains(&format!("\nkind = \"{kind}\"\n")), "{text}");
        assert_eq!(text.matches("\nkind = ").count(), 1, "{text}");
        // The others are one mark of a comment away from being valid.
        for other in excitation_kinds().filter(|other| *other != kind) {
            assert!(text.contains(&format!("\n# kind = \"{other}\"\n")), "{text}");
        }
        scenes.insert(parsed(&text).design.scene().words());
    }
    assert_eq!(scenes.len(), 4, "{scenes:?}");
    assert_eq!(Case::starting_text_of("x", "base-displacement"), Case::starting_text("x"));
}

/// Lines that are given stand where their keys are shown; all others stay.
#[test]
fn a_starting_case_has_the_lines_that_it_is_given() {
    let lines = [
        ("oscillator", "mass", "30 kg"),
        ("oscillator", "frequency", "6.9 Hz"),
        ("absorber", "mass_ratio", "2 %"),
        ("absorber", "restitution", "0.3"),
        ("excitation", "amplitude", "14 N"),
        ("criteria", "peak_displacement", "<= 4 mm"),
        ("band", "from", "6 Hz"),
        ("band", "to", "7 Hz"),
    ];
    let lines = lines.map(|(table, key, value)| StartingLine::new(table, key, value));
    let (plain, given) =
        (Case::starting_text_of("x", "force"), Case::starting_text_with("x", "force", &lines));
    let changed: Vec<(&str, &str)> =
        plain.lines().zip(given.lines()).filter(|(before, after)| before != after).collect();
    let after: Vec<&str> = changed.iter().map(|(_, after)| *after).collect();
    assert_eq!(plain.lines().count(), given.lines().count());
    let expected = [
        "mass = \"30 kg\"",
        // What says the same in another way is named without its number.
        "frequency = \"6.9 Hz\"          # or stiffness",
        "mass_ratio = \"2 %\"            # or mass",
        "restitution = 0.3             # speed after an impact over speed before: 1 elastic, 0 no rebound",
        "amplitude = \"14 N\"            # on the oscillator",
        "[band]",
        "from = \"6 Hz\"",
        "to = \"7 Hz\"",
        "[criteria]",
        "peak_displacement = \"<= 4 mm\"",
    ];
    assert_eq!(after, expected);
    let case = parsed(&given);
    assert!((case.system().mass_ratio() - 0.02).abs() < 1e-15);
    assert_eq!((case.criteria.len(), case.band.is_some()), (1, true));
    // A key that only a sentence shows follows it.
    let lines = [StartingLine::new("criteria", "decay_time", "<= 2 s")];
    let released = Case::starting_text_with("x", "free", &lines);
    assert!(released.contains("decay_level = \"10 %\".\ndecay_time = \"<= 2 s\"\n"), "{released}");
    assert_eq!(parsed(&released).criteria.len(), 1);
}

#[test]
fn accuracy_is_asked_for_in_per_cent() {
    let case = |table: &str| format!("{PHYSICAL}\n[accuracy]\n{table}\n");
    assert_eq!(parsed(PHYSICAL).accuracy, None);
    let plain = parsed(&case("")).accuracy.expect("a table without keys asks for the usual");
    assert_eq!((plain.amplitude, plain.impacts_per_period, plain.coexistence), (None, None, false));
    let asked = "amplitude = \"0.5 %\"\nimpacts_per_period = 0.02\ncoexistence = true";
    let asked = parsed(&case(asked)).accuracy.expect("a table");
    assert_eq!(asked.amplitude, Some(0.005));
    assert_eq!((asked.impacts_per_period, asked.coexistence), (Some(0.02), true));
    let error = refused_with(&case("amplitude = 0.01"), 20, "0.01", "`amplitude` has no unit");
    says(&error, "amplitude = \"0.01 %\"");
    refused_with(&case("amplitude = \"0 %\""), 20, "\"0 %\"", "`amplitude` is 0 %");
    let message = "`amplitude` is a share, but `mm` is the unit of a length";
    refused_with(&case("amplitude = \"1 mm\""), 20, "mm", message);
    let message = "`coexistence` is text, but it is true or false";
    let error = refused_with(&case("coexistence = \"yes\""), 20, "\"yes\"", message);
    says(&error, "coexistence = true");
    let message = "unknown key `amplitud` in [accuracy]";
    says(&refused_with(&case("amplitud = \"1 %\""), 20, "amplitud", message), "`amplitude`");
}
