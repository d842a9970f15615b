//! When an amplitude has come to rest: the last time at which it was above a level.

/// Steps in an oscillation of the structure: between two of them its amplitude moves by impacts alone.
pub const STEPS: u32 = 16;

/// The time after which an amplitude stays at a level or below it: where it jumps below, or on an exponential between two
/// times at which it is seen.
#[derive(Debug, Clone, Copy)]
pub struct Settling {
    level: f64,
    last: [f64; 2],
    /// Infinite while it is above.
    pub time: f64,
}

impl Settling {
    /// To a level.
    pub fn to(level: f64) -> Self {
        Self { level, last: [0.0, 0.0], time: 0.0 }
    }

    /// An amplitude at a time, in the order of times.
    pub fn see(&mut self, time: f64, amplitude: f64) {
        if amplitude > self.level {
            self.time = f64::INFINITY;
        } else if self.time.is_infinite() {
            let [before, above] = self.last;
            let part = libm::log(above / self.level) / libm::log(above / amplitude);
            self.time = before + (time - before) * if part.is_finite() { part } else { 1.0 };
        }
        self.last = [time, amplitude];
    }
}

#[cfg(test)]
mod tests {
    use super::Settling;

    #[test]
    fn the_last_crossing_counts() {
        let time = |level: f64| {
            let mut settling = Settling::to(level);
            for (time, power) in [0.0, 1.0, 2.0, 1.0, 3.0, 4.0].into_iter().enumerate() {
                settling.see(time as f64, libm::exp(-power));
            }
            // A jump, as an impact makes it.
            settling.see(5.0, libm::exp(-4.5));
            settling.see(5.0, libm::exp(-6.0));
            settling.time
        };
        assert!((time(libm::exp(-2.5)) - 3.75).abs() < 1e-12, "{}", time(libm::exp(-2.5)));
        assert_eq!([time(2.0), time(libm::exp(-5.0)), time(1e-3)], [0.0, 5.0, f64::INFINITY]);
    }
}
