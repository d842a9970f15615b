//! Systems that more than one test asks for.

use vinesink_core::system::{
    Cavity, Excitation, ModalAbsorber, ModalParameters, ModalSystem, Mode, Parameters, System,
};

/// A mode with its values at the absorbers.
pub fn mode(numbers: [f64; 4], shape: &[f64]) -> Mode {
    let [frequency, damping_ratio, mass, forcing] = numbers;
    Mode { frequency, damping_ratio, mass, forcing, participation: 0.0, shape: shape.to_vec() }
}

pub fn system(omega: f64, modes: Vec<Mode>, absorbers: &[[f64; 3]]) -> ModalSystem {
    let absorbers = absorbers.iter().map(|[mass, clearance, restitution]| ModalAbsorber {
        mass: *mass,
        clearance: *clearance,
        restitution: *restitution,
    });
    ModalSystem::new(ModalParameters {
        modes,
        absorbers: absorbers.collect(),
        frequency_ratio: omega,
        base_amplitude: 0.0,
    })
    .expect("valid")
}

pub const EPS: f64 = 0.007_677_543_186_180_422;
pub const OMEGA: f64 = 1.018_077_736_369_945_6;
pub const ZETA: f64 = 0.006_906_076_474_386_85;

/// Table 1 of Li, Seguy, Berlioz (2016) at 8.5 Hz with further modes, forced alike: absorbers as mass, clearance, restitution.
pub fn table1(further: &[([f64; 2], f64)], absorbers: &[[f64; 3]]) -> ModalSystem {
    let count = absorbers.len();
    let mut modes = vec![mode([1.0, ZETA, 1.0, 0.25], &vec![1.0; count])];
    for ([frequency, damping], phi) in further {
        modes.push(mode([*frequency, *damping, 1.0, 0.25], &vec![*phi; count]));
    }
    system(OMEGA, modes, absorbers)
}

/// Two modes and two absorbers: `A`, `B` and `D` with mass and damping of the first mode such that the mass ratios are `scale`
/// times as large at the same detuning, damping and forcing of the slow flow.
pub fn two_by_two(name: char) -> ModalSystem {
    match name {
        'A' => system(
            OMEGA,
            vec![
                mode([1.0, ZETA, 1.0, 0.25], &[1.0, 0.7]),
                mode([6.267, 0.01, 1.0, 0.25], &[-1.0, 0.5]),
            ],
            &[[0.003_838_771_593_090_211, 20.0, 0.6], [0.003_838_771_593_090_211, 10.0, 0.6]],
        ),
        'B' => {
            let force = 0.176_242_546_853_176_92;
            system(
                1.00924,
                vec![
                    mode([1.0, 0.005_544, 1.0, force], &[1.0, 0.9]),
                    mode([2.8, 0.006, 1.5, 0.5 * force], &[0.4, -1.0]),
                ],
                &[[0.006, 9.0, 0.7], [0.004, 7.0, 0.5]],
            )
        }
        _ => {
            let force = 0.086_190_644_694_686_08;
            system(
                1.005_304,
                vec![
                    mode([1.0, 0.008_84, 2.0, force], &[1.0, 0.8]),
                    mode([1.6, 0.012, 1.0, -force], &[0.5, -1.0]),
                ],
                &[[0.01, 5.0, 0.55], [0.012, 4.0, 0.7]],
            )
        }
    }
}

/// One mode and one absorber, both ways: lengths of the second are `clearance` times as large.
pub fn one_by_one(parameters: [f64; 5], clearance: f64) -> (System, ModalSystem) {
    let [eps, lambda, restitution, omega, gamma] = parameters;
    let one = System::new(Parameters {
        mass_ratio: eps,
        damping: lambda,
        restitution,
        frequency_ratio: omega,
        forcing_per_clearance: gamma,
        excitation: Excitation::Force,
        cavity: Cavity::IDEAL,
    });
    let modes = vec![mode([1.0, 0.5 * eps * lambda, 1.0, eps * gamma * clearance], &[1.0])];
    (one.expect("valid"), system(omega, modes, &[[eps, clearance, restitution]]))
}

/// SplitMix64.
pub struct Draw(pub u64);

impl Draw {
    pub fn within(&mut self, from: f64, to: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        from + (to - from) * ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// One to three modes with one to three absorbers, driven near the first.
    pub fn structure(&mut self) -> ModalSystem {
        let (modes, absorbers) = (self.within(1.0, 3.99) as usize, self.within(1.0, 3.99) as usize);
        let force = self.within(0.05, 0.4);
        let each = (0..modes).map(|k| {
            let frequency = if k == 0 { 1.0 } else { self.within(1.5, 9.0) };
            let shape: Vec<f64> = (0..absorbers).map(|_| self.within(-1.0, 1.0)).collect();
            mode([frequency, self.within(0.005, 0.03), self.within(0.5, 2.0), force], &shape)
        });
        let each: Vec<_> = each.collect();
        let carried: Vec<[f64; 3]> = (0..absorbers)
            .map(|_| [self.within(0.005, 0.05), self.within(0.5, 8.0), self.within(0.2, 0.8)])
            .collect();
        system(self.within(0.9, 1.1), each, &carried)
    }
}
