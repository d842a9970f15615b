use crate::numerics::lanes::LANES;
use crate::simulation::events::{AbsorberMotion, Observer, Segment};
use crate::simulation::integrals::{FlightEnds, Quadrature, Ringing};
use crate::simulation::{Simulation, Stop, peaks};
use crate::system::{Cavity, Excitation, Parameters, State, System};

/// Compares closed forms with quadrature and, for peaks, with samples, flight by flight.
struct Comparison {
    system: System,
    ringing: Option<Ringing>,
    quadrature: Quadrature,
    compared: u32,
}

impl Observer for Comparison {
    fn segment(&mut self, segment: &Segment) {
        let AbsorberMotion::Flying { y, y_velocity, .. } = segment.absorber else { return };
        let Some(ringing) = &self.ringing else { return };
        let (begin, end) = (segment.at(0.0), segment.at(segment.duration));
        let over = segment.phase + self.system.frequency_ratio() * segment.duration;
        // One flight; the others have no duration.
        let alone = |number| {
            let mut lanes = [0.0; LANES];
            lanes[0] = number;
            lanes
        };
        let ends = FlightEnds {
            phase: [segment.phase, over].map(alone),
            x: [begin.x, end.x].map(alone),
            v: [begin.x_velocity, end.x_velocity].map(alone),
            y: alone(y),
            y_velocity: alone(y_velocity),
            y_acceleration: alone(0.0),
            rest: alone(0.0),
        };
        let mut measured = peaks::Contribution::default();
        peaks::together(ringing, &ends, &mut measured);
        let closed = measured.integrals.at(0);
        let sampled = self.quadrature.over(segment);
        self.compared += 1;
        // Either is rounded some fifty times at the size of the motion, or of its free and steady
        // parts, squared, times the duration.
        let (free, velocity) = segment.motion.free();
        let whole = segment.at(0.0);
        let parts = [free, velocity, whole.x, whole.x_velocity, whole.y, whole.y_velocity, 1.0];
        let size = parts.iter().map(|part| part * part).sum::<f64>();
        let (sine, cosine) = self.system.excitation_amplitudes();
        let slow = 1.0 / self.system.frequency_ratio().min(1.0);
        let scale = (size + sine * sine + cosine * cosine) * (segment.duration + slow * slow);
        let pairs = [
            (closed.displacement_squared, sampled.displacement_squared),
            (closed.velocity_squared, sampled.velocity_squared),
            (closed.work, sampled.work),
            (closed.oscillator[0], sampled.oscillator[0]),
            (closed.oscillator[1], sampled.oscillator[1]),
            (closed.absorber[0], sampled.absorber[0]),
            (closed.absorber[1], sampled.absorber[1]),
        ];
        for (one, other) in pairs {
            assert!((one - other).abs() < 1e-14 * scale, "{closed:?} {sampled:?} {scale}");
        }
        let peak = measured.peaks[0];
        let mut largest = 0.0_f64;
        for k in 0..=400 {
            let at = segment.at(segment.duration * f64::from(k) / 400.0);
            largest = largest.max(at.x.abs());
        }
        // Samples miss a turning point by an eighth of the square of their distance.
        let apart = segment.duration / 400.0;
        let missed = 0.125 * apart * apart * (size.sqrt() * 30.0);
        let noise = 1e-14 * size.sqrt();
        assert!(peak >= largest - noise && peak <= largest + missed + noise, "{peak} {largest}");
    }
}

pub(super) const START: State = State { x: 0.1, x_velocity: 0.4, y: -0.3, y_velocity: 0.2 };

/// With few and many impacts, chattering, lasting contact, resonance, and hardly any damping or none.
pub(super) fn systems() -> impl Iterator<Item = System> {
    let all = [
        (0.0077, 1.8, 1.0, 0.6, 2.8),
        (0.0077, 1.8, 0.96, 0.0, 300.0),
        (0.0077, 1.8, 1.01, 0.6, 30.0),
        (0.0077, 0.03, 1.0, 0.8, 3.0),
        (0.0077, 0.0, 1.01, 1.0, 30.0),
        (0.3, 4.0, 0.2, 0.5, 10.0),
        (0.5, 3.0, 4.0, 0.3, 5.0),
        (1e-3, 900.0, 1.3, 0.8, 400.0),
    ];
    let system = |(eps, lambda, omega, r, gamma)| {
        System::new(Parameters {
            mass_ratio: eps,
            damping: lambda,
            restitution: r,
            frequency_ratio: omega,
            forcing_per_clearance: gamma,
            excitation: Excitation::BaseDisplacement,
            cavity: Cavity::IDEAL,
        })
    };
    all.map(|one| system(one).expect("valid")).into_iter()
}

#[test]
fn closed_forms_agree_with_quadrature_and_samples() {
    let mut compared = 0;
    for system in systems() {
        let mut comparison = Comparison {
            system,
            ringing: Ringing::of(&system),
            quadrature: Quadrature::of(&system),
            compared: 0,
        };
        let mut simulation = Simulation::new(&system, START, 0.0).expect("inside");
        assert_eq!(simulation.run(30, u64::MAX, &mut comparison), Stop::EndTime);
        compared += comparison.compared;
    }
    assert!(compared > 600, "{compared}");
}
