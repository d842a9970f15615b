//! Prints the record of `cases/tower-record.csv`, like an earthquake and none: Gaussian noise of a spectrum that is
//! strongest about 1 Hz, under an envelope that rises within 4 s and decays.
//!
//! `cargo run --example synthetic_quake > cases/tower-record.csv`

use vinesink::excitation::{RecordQuantity, Spectrum};

/// Seconds until the envelope is highest.
const RISE: f64 = 4.0;
/// Samples of the noise, 160 a second, of which one is written.
const EVERY: usize = 4;

fn main() {
    let spectrum = Spectrum {
        corners: vec![[0.1, 0.02], [0.5, 0.3], [1.5, 0.3], [5.0, 0.01]],
        duration: 40.0,
        seed: 1,
        realisations: 1,
    };
    println!("# made by examples/synthetic_quake.rs: no earthquake was measured");
    println!("time (s),acceleration (m/s²)");
    for record in spectrum.records(RecordQuantity::BaseAcceleration) {
        for [time, value] in record.samples.into_iter().step_by(EVERY) {
            let envelope = time / RISE * libm::exp(1.0 - time / RISE);
            println!("{time:.3},{:.4}", envelope * value);
        }
    }
}
