//! Exact symmetric orbits of the full system against PHYSICS-level check values, simulation and
//! properties.
use vinesink::orbits::*;
use vinesink::system::*;

fn table1(f: f64, b_mm: f64) -> System {
    let (m1, k1, c1, m2): (f64, f64, f64, f64) = (4.168, 11.47e3, 3.02, 0.032);
    let omega0 = (k1 / m1).sqrt();
    let eps = m2 / m1;
    System::new(Parameters {
        mass_ratio: eps,
        damping: c1 / (m2 * omega0),
        restitution: 0.6,
        frequency_ratio: std::f64::consts::TAU * f / omega0,
        forcing_per_clearance: 0.25 / eps / b_mm,
        excitation: Excitation::BaseDisplacement,
    })
    .unwrap()
}

#[test]
fn probe() {
    for (f, b) in [(8.0, 7.5), (8.0, 15.0), (8.5, 20.0)] {
        let s = table1(f, b);
        for o in symmetric_orbits(&s).unwrap() {
            println!("{f} {b}: x0 {} peak {} rho {} {:?} adm {:?} res {:e} dim {:e}", o.impact_displacement * b, o.peaks.displacement * b,
                o.orbit.multipliers.spectral_radius(), o.orbit.multipliers.leading(), o.orbit.admissibility, o.orbit.convergence.residual, o.orbit.multipliers.trace_residual);
        }
        let fam = SymmetricFamily::of(&s).unwrap();
        for l in &fam.limits { println!("   {:?} beta {} b {} stab {} test {:e}", l.kind, l.absorber, l.clearance * b, l.bounds_stability, l.test); }
        for l in &fam.stable { println!("   stable {:?} {:?}", l.clearance.map(|c| c * b), l.ends); }
    }
}
