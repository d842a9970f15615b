//! Largest values of smooth functions of time: at an end, or where the slope has a root. None is a sample.

use super::bracket::brent;

/// Width of a bracket of a slope's root, where the value is as flat as rounding.
const WIDTH: f64 = 1e-12;

/// The largest absolute value in `[0, duration]` of a function that is given with its slope, whose slope has at most one
/// root in a panel.
pub fn largest(duration: f64, panel: f64, at: impl Fn(f64) -> [f64; 2]) -> f64 {
    largest_each(duration, panel, at)[0]
}

/// The same of a function and its slopes, each but the last.
pub fn largest_each<const N: usize>(
    duration: f64,
    panel: f64,
    at: impl Fn(f64) -> [f64; N],
) -> [f64; N] {
    let panels = (duration / panel).ceil().max(1.0);
    let step = duration / panels;
    let mut before = at(0.0);
    let mut found = before.map(f64::abs);
    for k in 0..panels as u64 {
        let from = k as f64 * step;
        let after = at(from + step);
        for of in 0..N - 1 {
            found[of] = found[of].max(after[of].abs());
            if (before[of + 1] > 0.0) != (after[of + 1] > 0.0)
                && let Ok(root) = brent(from, from + step, WIDTH, |s| at(s)[of + 1])
            {
                found[of] = found[of].max(at(root.at)[of].abs());
            }
        }
        before = after;
    }
    found
}

/// The cubic with the values and slopes of a motion at two times. Of a motion whose fourth derivative is at most `D` it
/// is off by `D h^4/384` at the most.
pub struct Cubic {
    duration: f64,
    ends: [[f64; 2]; 2],
}

impl Cubic {
    /// Value and slope at the beginning, and a time later.
    pub fn of(duration: f64, ends: [[f64; 2]; 2]) -> Self {
        Self { duration, ends }
    }

    /// Its largest absolute value, in its own unit.
    pub fn largest(&self) -> f64 {
        let h = self.duration;
        let [[x0, v0], [x1, v1]] = self.ends;
        let at_ends = x0.abs().max(x1.abs());
        if v0 * v1 >= 0.0 {
            return at_ends;
        }
        // x = x0 + h v0 p + c p^2 + d p^3; its slope is 0 once between ends of opposite slope.
        let d = h * (v0 + v1) - 2.0 * (x1 - x0);
        let c = 3.0 * (x1 - x0) - h * (2.0 * v0 + v1);
        let root = (c * c - 3.0 * d * h * v0).max(0.0).sqrt();
        let p = -h * v0 / (c + root.copysign(-v0));
        let p = if p.is_finite() { p.clamp(0.0, 1.0) } else { 0.0 };
        at_ends.max((x0 + p * (h * v0 + p * (c + p * d))).abs())
    }

    /// The same, or what is known where it stays within that: between its ends it goes beyond the larger of these by at most 4/27 of
    /// its length times both slopes (Hermite's basis), so that most cubics are not looked at.
    pub fn largest_beyond(&self, known: f64) -> f64 {
        let [[x0, v0], [x1, v1]] = self.ends;
        let most = x0.abs().max(x1.abs()) + 4.0 / 27.0 * self.duration * (v0.abs() + v1.abs());
        if most <= known { known } else { known.max(self.largest()) }
    }

    /// When it first goes beyond a size outwards, in the unit of its time; none where it stays within.
    pub fn leaves(&self, size: f64) -> Option<f64> {
        const PARTS: u32 = 16;
        let h = self.duration;
        let [[x0, v0], [x1, v1]] = self.ends;
        let (d, c) = (h * (v0 + v1) - 2.0 * (x1 - x0), 3.0 * (x1 - x0) - h * (2.0 * v0 + v1));
        let at = |p: f64| x0 + p * (h * v0 + p * (c + p * d));
        // At a stop it may be beyond by rounding, and comes back.
        let is_out =
            |p: f64| at(p).abs() > size && at(p) * (h * v0 + p * (2.0 * c + 3.0 * p * d)) > 0.0;
        let part = |k: u32| f64::from(k) / f64::from(PARTS);
        let out = (0..=PARTS).find(|k| is_out(part(*k)))?;
        let (mut inside, mut outside) = (part(out.saturating_sub(1)), part(out));
        while outside - inside > WIDTH {
            let middle = 0.5 * (inside + outside);
            if is_out(middle) { outside = middle } else { inside = middle }
        }
        Some(h * outside)
    }

    /// Its integral, in its own unit times that of its time.
    pub fn integral(&self) -> f64 {
        let h = self.duration;
        let [[x0, v0], [x1, v1]] = self.ends;
        0.5 * h * (x0 + x1) + h * h / 12.0 * (v0 - v1)
    }

    /// Integral of its square: the mass matrix of a beam.
    pub fn square(&self) -> f64 {
        let h = self.duration;
        let [[x0, v0], [x1, v1]] = self.ends;
        let [v0, v1] = [h * v0, h * v1];
        let own = 156.0 * (x0 * x0 + x1 * x1) + 4.0 * (v0 * v0 + v1 * v1);
        let mixed = 44.0 * (x0 * v0 - x1 * v1) + 26.0 * (x1 * v0 - x0 * v1);
        h / 420.0 * (own + mixed + 108.0 * x0 * x1 - 6.0 * v0 * v1)
    }

    /// Integral of the square of its slope: the matrix of a beam under tension.
    pub fn square_of_slope(&self) -> f64 {
        let h = self.duration;
        let [[x0, v0], [x1, v1]] = self.ends;
        let (rise, [v0, v1]) = (x1 - x0, [h * v0, h * v1]);
        let of_rise = 36.0 * rise * rise - 6.0 * rise * (v0 + v1);
        (of_rise + 4.0 * (v0 * v0 + v1 * v1) - 2.0 * v0 * v1) / (30.0 * h)
    }
}

/// Of two functions of time, a velocity and its rate: the largest sizes, the integrals of the squares, and the time that they
/// are over.
#[derive(Debug, Clone, Copy, Default)]
#[doc(hidden)]
pub struct RateSums {
    pub peaks: [f64; 2],
    pub squares: [f64; 2],
    pub time: f64,
}

impl RateSums {
    /// Adds a stretch so short that both are cubics in it, by both and the rate of the second at its ends: off by `h^4/384`.
    pub fn add_short(&mut self, duration: f64, ends: [[f64; 3]; 2]) {
        self.time += duration;
        for k in 0..2 {
            let cubic = Cubic::of(duration, ends.map(|at| [at[k], at[k + 1]]));
            self.peaks[k] = self.peaks[k].max(cubic.largest());
            self.squares[k] += cubic.square();
        }
    }

    /// Both together.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        Self {
            peaks: [0, 1].map(|k| self.peaks[k].max(other.peaks[k])),
            squares: [0, 1].map(|k| self.squares[k] + other.squares[k]),
            time: self.time + other.time,
        }
    }

    /// Mean square velocity and acceleration; 0 where no time has passed.
    pub fn mean_squares(&self) -> [f64; 2] {
        self.squares.map(|one| if self.time > 0.0 { one / self.time } else { 0.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::{Cubic, largest};

    /// `exp(-z t) sin t` is largest at `atan(1/z)`.
    #[test]
    fn the_largest_value_is_where_the_slope_is_zero() {
        let z = 0.1_f64;
        let at = |t: f64| {
            let (decay, (sine, cosine)) = (libm::exp(-z * t), libm::sincos(t));
            [decay * sine, decay * (cosine - z * sine)]
        };
        let exact = at(libm::atan2(1.0, z))[0];
        assert!((largest(20.0, 0.7, at) / exact - 1.0).abs() < 1e-15);
        // A cubic between values half a radian apart: h^4/384 = 1.6e-4.
        let cubic = Cubic::of(0.5, [1.2, 1.7].map(at));
        assert!((cubic.largest() / exact - 1.0).abs() < 1.6e-4);
    }
}
