//! Properties of every case: text and numbers, physical and reduced, are the same thing.

use proptest::prelude::*;
use vinesink::case::{Case, Design, Physical, Reduced};
use vinesink::quantity::{Dimension, Units};
use vinesink::system::{Cavity, Excitation, System};

/// Values whose order of magnitude, not only whose size, is random.
fn scale(low: i32, high: i32) -> impl Strategy<Value = f64> {
    (1.0..10.0_f64, low..high)
        .prop_map(|(digits, power)| format!("{digits}e{power}").parse::<f64>().expect("a number"))
}

fn zero_or(values: impl Strategy<Value = f64>) -> impl Strategy<Value = f64> {
    (values, 0..8).prop_map(|(value, dice)| if dice == 0 { 0.0 } else { value })
}

prop_compose! {
    fn physical()(
        mass_kg in scale(-6, 6),
        stiffness_n_per_m in scale(-3, 9),
        damping_n_s_per_m in zero_or(scale(-6, 4)),
        absorber_mass_kg in scale(-9, 3),
        clearance_m in scale(-6, 1),
        (restitution, restitution_difference) in restitutions(),
        // Upright the sine would not tell the angle.
        inclination_rad in prop_oneof![-0.7..0.7, Just(0.0)],
        friction in zero_or(scale(-4, 1)),
        amplitude in zero_or(scale(-6, 3)),
        force in any::<bool>(),
        frequency_hz in scale(-3, 5),
    ) -> Physical {
        let excitation = if force { Excitation::Force } else { Excitation::BaseDisplacement };
        Physical {
            mass_kg, stiffness_n_per_m, damping_n_s_per_m, absorber_mass_kg, clearance_m,
            restitution, restitution_difference, inclination_rad, friction, excitation, amplitude, frequency_hz,
            contact_time_s: None,
            support: None, transient: None,
            shape: 1.0,
        }
    }
}

prop_compose! {
    fn reduced()(
        mass_ratio in scale(-12, 1),
        damping in zero_or(scale(-4, 4)),
        (restitution, restitution_difference) in restitutions(),
        gravity_along in -10.0..10.0,
        friction_acceleration in zero_or(scale(-4, 1)),
        clearance in scale(-6, 3),
        forcing in zero_or(scale(-6, 6)),
        (frequency_ratio, detuning) in prop_oneof![
            scale(-3, 2).prop_map(|ratio| (Some(ratio), None)),
            (-0.009..10.0).prop_map(|detuning| (None, Some(detuning))),
        ],
        force in any::<bool>(),
    ) -> Reduced {
        let excitation = if force { Excitation::Force } else { Excitation::BaseDisplacement };
        let cavity = Cavity { gravity_along, friction_acceleration, restitution_difference };
        Reduced { mass_ratio, damping, restitution, cavity, clearance, forcing, excitation, frequency_ratio, detuning, transient: None }
    }
}

/// Mean and difference: of one number, or of a pair that is exact in binary.
fn restitutions() -> impl Strategy<Value = (f64, f64)> {
    let end = || (0..=1024_u16).prop_map(|part| f64::from(part) / 1024.0);
    let pair = (end(), end()).prop_map(|(one, other)| (0.5 * (one + other), one - other));
    prop_oneof![(0.0..=1.0_f64).prop_map(|both| (both, 0.0)), pair]
}

/// One number, or the pair with that mean and difference.
fn restitution_text(mean: f64, difference: f64) -> String {
    let half = 0.5 * difference;
    if difference == 0.0 {
        format!("{mean:?}")
    } else {
        format!("[{:?}, {:?}]", mean + half, mean - half)
    }
}

fn quantity(of: Dimension, si: f64) -> String {
    format!("\"{si} {}\"", of.symbol(true))
}

fn physical_text(p: &Physical) -> String {
    let (kind, amplitude) = match p.excitation {
        Excitation::Force => ("force", quantity(Dimension::Force, p.amplitude)),
        Excitation::BaseDisplacement => {
            ("base-displacement", quantity(Dimension::Length, p.amplitude))
        }
    };
    format!(
        "title = 't'\nsource = 's'\n[oscillator]\nmass = {}\nstiffness = {}\ndamping = {}\n\
         [absorber]\nmass = {}\nclearance = {}\nrestitution = {}\n\
         inclination = {}\nfriction = {:?}\n[excitation]\nkind = '{kind}'\namplitude = {amplitude}\nfrequency = {}\n",
        quantity(Dimension::Mass, p.mass_kg),
        quantity(Dimension::Stiffness, p.stiffness_n_per_m),
        quantity(Dimension::Damping, p.damping_n_s_per_m),
        quantity(Dimension::Mass, p.absorber_mass_kg),
        quantity(Dimension::Length, p.clearance_m),
        restitution_text(p.restitution, p.restitution_difference),
        quantity(Dimension::Inclination, p.inclination_rad),
        p.friction,
        quantity(Dimension::Frequency, p.frequency_hz),
    )
}

fn reduced_text(r: &Reduced) -> String {
    let kind = match r.excitation {
        Excitation::Force => "force",
        Excitation::BaseDisplacement => "base-displacement",
    };
    let tuning = match (r.frequency_ratio, r.detuning) {
        (Some(ratio), _) => format!("frequency_ratio = {ratio:?}"),
        (None, detuning) => format!("detuning = {:?}", detuning.expect("one of the two")),
    };
    format!(
        "title = 't'\nsource = 's'\n[reduced]\nmass_ratio = {:?}\ndamping = {:?}\n\
         restitution = {}\nclearance = {:?}\nforcing = {:?}\nkind = '{kind}'\n{tuning}\n\
         gravity_along = {:?}\nfriction_acceleration = {:?}\n",
        r.mass_ratio,
        r.damping,
        restitution_text(r.restitution, r.cavity.restitution_difference),
        r.clearance,
        r.forcing,
        r.cavity.gravity_along,
        r.cavity.friction_acceleration,
    )
}

/// The numbers of a design in one order, and the kind of its excitation.
fn numbers(design: &Design) -> ([f64; 11], Excitation) {
    match *design {
        Design::Physical(p) => {
            let Physical {
                mass_kg, stiffness_n_per_m, damping_n_s_per_m, absorber_mass_kg, ..
            } = p;
            let rest = [p.clearance_m, p.restitution, p.amplitude, p.frequency_hz];
            let [clearance, restitution, amplitude, frequency] = rest;
            let all = [
                mass_kg,
                stiffness_n_per_m,
                damping_n_s_per_m,
                absorber_mass_kg,
                clearance,
                restitution,
                amplitude,
                frequency,
                p.restitution_difference,
                p.inclination_rad,
                p.friction,
            ];
            (all, p.excitation)
        }
        Design::Reduced(r) => {
            let detuning = match (r.frequency_ratio, r.detuning) {
                (Some(ratio), _) => (ratio - 1.0) / r.mass_ratio,
                (None, detuning) => detuning.expect("one of the two"),
            };
            let all = [r.mass_ratio, r.damping, r.restitution, r.clearance, r.forcing, detuning];
            let [mass_ratio, damping, restitution, clearance, forcing, detuning] = all;
            let of = r.cavity;
            let cavity = [of.restitution_difference, of.gravity_along, of.friction_acceleration];
            let [difference, gravity, friction] = cavity;
            let all = [
                mass_ratio,
                damping,
                restitution,
                clearance,
                forcing,
                detuning,
                difference,
                gravity,
                friction,
                0.0,
                0.0,
            ];
            (all, r.excitation)
        }
    }
}

/// The design of a system in some units: the inverse of [`Design::system`].
fn restored(units: &Units, system: &System) -> Design {
    let forcing = units.length(system.forcing_per_clearance());
    let (clearance, restitution) = (units.clearance, system.restitution());
    let (mass_ratio, excitation) = (system.mass_ratio(), system.excitation());
    if !units.physical {
        let (frequency_ratio, detuning) = (None, Some(system.detuning()));
        return Design::Reduced(Reduced {
            mass_ratio,
            damping: system.damping(),
            restitution,
            cavity: system.cavity(),
            clearance,
            forcing,
            excitation,
            frequency_ratio,
            detuning,
            transient: None,
        });
    }
    let (mass_kg, omega0) = (units.oscillator_mass, units.natural_frequency);
    let stiffness_n_per_m = mass_kg * omega0 * omega0;
    let absorber_mass_kg = mass_ratio * mass_kg;
    let displacement = forcing * mass_ratio;
    let cavity = system.cavity();
    let gravity = 9.80665 / units.acceleration(1.0);
    let inclination_rad = libm::asin(cavity.gravity_along / gravity);
    Design::Physical(Physical {
        mass_kg,
        stiffness_n_per_m,
        damping_n_s_per_m: system.damping() * absorber_mass_kg * omega0,
        absorber_mass_kg,
        clearance_m: clearance,
        restitution,
        restitution_difference: cavity.restitution_difference,
        inclination_rad,
        friction: cavity.friction_acceleration / (gravity * libm::cos(inclination_rad)),
        contact_time_s: None,
        excitation,
        amplitude: match excitation {
            Excitation::BaseDisplacement => displacement,
            Excitation::Force => displacement * stiffness_n_per_m,
        },
        frequency_hz: units.frequency(system.frequency_ratio()),
        support: None,
        transient: None,
        shape: 1.0,
    })
}

proptest! {
    #[test]
    fn text_reads_back_to_the_same_design(physical in physical(), reduced in reduced()) {
        let case = Case::parse("physical", &physical_text(&physical)).expect("a valid case");
        prop_assert_eq!(case.design, Design::Physical(physical));
        let case = Case::parse("reduced", &reduced_text(&reduced)).expect("a valid case");
        prop_assert_eq!(case.design, Design::Reduced(reduced));
    }

    #[test]
    fn restoring_a_reduced_design_gives_it_back(physical in physical(), reduced in reduced()) {
        for design in [Design::Physical(physical), Design::Reduced(reduced)] {
            let system = design.system().expect("a valid design");
            let (restored, kind) = numbers(&restored(&design.units(), &system));
            let (expected, expected_kind) = numbers(&design);
            prop_assert_eq!(kind, expected_kind);
            for (value, expected) in restored.into_iter().zip(expected) {
                // A handful of roundings, each half an ulp.
                prop_assert!((value - expected).abs() <= 16.0 * f64::EPSILON * expected.abs());
            }
        }
    }

    #[test]
    fn no_text_makes_the_parser_panic(text in "(?s).{0,200}", at in 0..400_usize, byte in any::<char>()) {
        let _ = Case::parse("any", &text);
        let mut near: Vec<char> = Case::starting_text("case").chars().collect();
        let at = at * near.len() / 400;
        near[at] = byte;
        let _ = Case::parse("nearly right", &near.into_iter().collect::<String>());
    }

    #[test]
    fn any_quantity_prints_as_it_reads(si in any::<f64>().prop_filter("finite", |si| si.is_finite())) {
        prop_assert_eq!(Dimension::Length.parse(&format!("{si} m")), Ok(si + 0.0));
    }
}
