//! A map of regimes over frequency and clearance, simulated on all processors.
//!
//! `cargo run --release --example regime_map`

use rayon::iter::{IntoParallelIterator as _, ParallelIterator as _};
use vinesink::executor::Serial;
use vinesink::motions::{Effort, Motion, Place, motions};
use vinesink::regimes::Regime;
use vinesink::system::{Cavity, Excitation, Parameters, System};

/// The regime that most of eight starts lead to, at a frequency in Hz and a clearance in mm.
fn regime(frequency: f64, clearance: f64) -> Option<Regime> {
    // 32 g in 4.168 kg, natural frequency 8.349 Hz, base moved by 0.25 mm.
    let system = System::new(Parameters {
        mass_ratio: 0.032 / 4.168,
        damping: 1.799,
        restitution: 0.6,
        frequency_ratio: frequency / 8.349,
        forcing_per_clearance: 0.25 * 4.168 / 0.032 / clearance,
        excitation: Excitation::BaseDisplacement,
        cavity: Cavity::IDEAL,
    })
    .ok()?;
    let found = motions(&[Place::new(&system, 8)], &Effort::over(100), &Serial).ok()?;
    found[0].main().map(Motion::regime)
}

fn main() {
    let frequencies: Vec<f64> = (0..25).map(|k| 7.9 + 0.05 * f64::from(k)).collect();
    for row in (0..12).rev() {
        let clearance = 2.5 + 2.5 * f64::from(row);
        let cell = |frequency: &f64| match regime(*frequency, clearance) {
            Some(Regime::TwoSymmetric) => '=',
            Some(Regime::TwoAsymmetric) => '~',
            Some(Regime::StronglyModulated) => 'M',
            Some(Regime::AboveTwo) => '+',
            Some(Regime::BelowTwo) => '-',
            Some(Regime::AtRest) => '.',
            _ => '?',
        };
        let line: Vec<char> = (&frequencies).into_par_iter().map(cell).collect();
        println!("{clearance:5.1} mm  {}", line.into_iter().collect::<String>());
    }
    println!("          7.9 Hz, in steps of 0.05 Hz, to 9.1 Hz");
    println!(
        "= {}, ~ asymmetric, M {}",
        Regime::TwoSymmetric.words(),
        Regime::StronglyModulated.words()
    );
    println!("+ more than two impacts per period, - fewer, . absorber at rest");
}
