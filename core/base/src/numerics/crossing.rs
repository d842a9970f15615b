//! First time at which a smooth curve leaves a band, without stepping over it.
//!
//! From a point with value `f`, slope `v` and a bound `M` on the curve's second derivative, the
//! curve stays below `f + v s + M s^2 / 2`. The largest `s` at which that parabola is still inside
//! the band is therefore a step in which *nothing can have been missed*; the mirrored parabola
//! guards the other side. Repeating the step converges quadratically to a transversal crossing from
//! inside, because the parabola's linear part is Newton's. A tangency is passed, or met, in steps
//! that shrink and grow geometrically. No sampling density enters anywhere.

/// Value and slope of a curve at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// The curve's value.
    pub value: f64,
    /// Its derivative.
    pub slope: f64,
    /// A bound on the absolute second derivative from this time on, for at least
    /// [`Curve::horizon`].
    pub curvature_bound: f64,
}

/// A twice differentiable function of time with a known bound on its second derivative.
pub trait Curve {
    /// The curve at time `s`.
    fn sample(&self, s: f64) -> Sample;
    /// How far ahead of `s` the sample's curvature bound holds.
    fn horizon(&self) -> f64;
}

/// The band that a curve is watched in, and how closely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossingBand {
    /// Lower edge (may be minus infinity).
    pub lower: f64,
    /// Upper edge (may be infinity).
    pub upper: f64,
    /// Distance past an edge that counts as touching, in units of the curve: a few units in the
    /// last place of the values that the curve is computed from. Nothing smaller can be resolved.
    pub touch: f64,
}

/// Which edge of a band was crossed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Edge {
    /// The curve fell through the lower edge.
    Lower,
    /// The curve rose through the upper edge.
    Upper,
}

/// A certified first crossing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// When.
    pub time: f64,
    /// Which edge.
    pub edge: Edge,
    /// How often the curve was evaluated to find it.
    pub evaluations: u32,
}

/// What a search came to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Search {
    /// The first crossing.
    Crossed(Crossing),
    /// Proven: the curve stays inside the band up to the given end (to within `touch`).
    Clear {
        /// How often the curve was evaluated to prove it.
        evaluations: u32,
    },
    /// The curve stopped being a number at the given time.
    NotFinite(f64),
}

/// Finds the first time in `(from, until]` at which `curve` leaves `band`.
///
/// The curve may start on an edge: it has left only when it moves outwards there. Steps are never
/// shorter than the one in which the curve can pass the edge by `touch`, so the search ends.
pub fn first_crossing(curve: &impl Curve, from: f64, until: f64, band: CrossingBand) -> Search {
    first_of(|s| [curve.sample(s)], curve.horizon(), [from], until, [band]).0
}

/// The first of several curves to leave its band, the foremost where more do at once, and which; each is watched from
/// its own time on.
pub fn first_of<const N: usize>(
    curves: impl Fn(f64) -> [Sample; N],
    horizon: f64,
    from: [f64; N],
    until: f64,
    bands: [CrossingBand; N],
) -> (Search, usize) {
    let mut s = from.into_iter().fold(f64::INFINITY, f64::min);
    let mut evaluations = 0;
    loop {
        let samples = curves(s);
        evaluations += 1;
        let mut step = horizon;
        for (k, (sample, band)) in samples.iter().zip(&bands).enumerate() {
            if s < from[k] {
                step = step.min(from[k] - s);
                continue;
            }
            // Where the parabola's own numbers overflow no step is long enough to end the search.
            let discriminant = sample.slope * sample.slope + sample.curvature_bound * band.touch;
            if !(sample.value.is_finite() && discriminant.is_finite()) {
                return (Search::NotFinite(s), k);
            }
            if let Some(edge) = left_through(sample, band) {
                let time = corrected(s, sample, band, edge).max(from[k]);
                return (Search::Crossed(Crossing { time, edge, evaluations }), k);
            }
            step = step.min(safe_step(sample, band));
        }
        if s >= until {
            return (Search::Clear { evaluations }, 0);
        }
        let next = s + step;
        s = if next > s { next.min(until) } else { until.min(s.next_up()) };
    }
}

fn left_through(sample: &Sample, band: &CrossingBand) -> Option<Edge> {
    if sample.value >= band.upper && sample.slope > 0.0 {
        Some(Edge::Upper)
    } else if sample.value <= band.lower && sample.slope < 0.0 {
        Some(Edge::Lower)
    } else {
        None
    }
}

/// The largest step in which the bounding parabolas stay within `touch` of the band.
fn safe_step(sample: &Sample, band: &CrossingBand) -> f64 {
    let up = parabola_reach(band.upper - sample.value, sample.slope, sample.curvature_bound, band);
    let down =
        parabola_reach(sample.value - band.lower, -sample.slope, sample.curvature_bound, band);
    up.min(down)
}

/// Time until `slope s + bound s^2 / 2` uses up `gap + touch`, by the form of the root that does
/// not cancel.
fn parabola_reach(gap: f64, slope: f64, bound: f64, band: &CrossingBand) -> f64 {
    if gap == f64::INFINITY {
        return f64::INFINITY;
    }
    let room = (gap + band.touch).max(0.25 * band.touch);
    let root = (slope * slope + 2.0 * bound * room).sqrt();
    if slope > 0.0 { 2.0 * room / (slope + root) } else { (root - slope) / bound }
}

/// One Newton step back onto the edge, for the `touch` that the last step may have gone past it.
fn corrected(s: f64, sample: &Sample, band: &CrossingBand, edge: Edge) -> f64 {
    let excess = match edge {
        Edge::Upper => sample.value - band.upper,
        Edge::Lower => sample.value - band.lower,
    };
    let correction = excess / sample.slope;
    // Where the slope all but vanishes the quotient means nothing; the touch already bounds it.
    if correction.abs() * sample.curvature_bound < sample.slope.abs() { s - correction } else { s }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `amplitude sin(s) + drift s`.
    struct Wave {
        amplitude: f64,
        drift: f64,
    }

    impl Curve for Wave {
        fn sample(&self, s: f64) -> Sample {
            let (sin, cos) = libm::sincos(s);
            Sample {
                value: self.amplitude * sin + self.drift * s,
                slope: self.amplitude * cos + self.drift,
                curvature_bound: self.amplitude,
            }
        }
        fn horizon(&self) -> f64 {
            f64::INFINITY
        }
    }

    const BAND: CrossingBand = CrossingBand { lower: -1.0, upper: 1.0, touch: 4e-15 };

    #[test]
    fn a_transversal_crossing_is_found_to_rounding() {
        let found = first_crossing(&Wave { amplitude: 2.0, drift: 0.0 }, 0.0, 10.0, BAND);
        let Search::Crossed(crossing) = found else { panic!("{found:?}") };
        // asin(1/2): the slope is sqrt(3), so rounding of the value moves the root by 1e-16.
        assert!((crossing.time - std::f64::consts::FRAC_PI_6).abs() < 1e-15, "{crossing:?}");
        assert_eq!(crossing.edge, Edge::Upper);
        assert!(crossing.evaluations < 12, "{crossing:?}");
    }

    #[test]
    fn a_graze_below_the_edge_is_clear_and_above_it_is_found() {
        for k in 1..=13 {
            let margin = libm::pow(10.0, -f64::from(k));
            let below = Wave { amplitude: 1.0 - margin, drift: 0.0 };
            let found = first_crossing(&below, 0.0, 6.0, BAND);
            assert!(matches!(found, Search::Clear { .. }), "{margin}");
            let above = Wave { amplitude: 1.0 + margin, drift: 0.0 };
            let Search::Crossed(crossing) = first_crossing(&above, 0.0, 6.0, BAND) else {
                panic!("an excess of {margin} was stepped over")
            };
            // asin(1/(1+m)) = pi/2 - sqrt(2 m): the root is conditioned like 1/sqrt(m).
            let exact = libm::asin(1.0 / (1.0 + margin));
            assert!((crossing.time - exact).abs() < 1e-15 / margin.sqrt() + 1e-14, "{margin}");
        }
    }

    #[test]
    fn a_curve_that_starts_on_the_edge_and_turns_inwards_is_followed_to_the_other_side() {
        let wave = Wave { amplitude: 1.0, drift: -0.05 };
        let from = std::f64::consts::FRAC_PI_2;
        let band = CrossingBand { upper: wave.sample(from).value, ..BAND };
        let Search::Crossed(crossing) = first_crossing(&wave, from, 20.0, band) else { panic!() };
        assert_eq!(crossing.edge, Edge::Lower);
        assert!((wave.sample(crossing.time).value + 1.0).abs() < 1e-14);
    }

    #[test]
    fn not_a_number_ends_the_search() {
        let found = first_crossing(&Wave { amplitude: f64::NAN, drift: 0.0 }, 0.0, 1.0, BAND);
        assert_eq!(found, Search::NotFinite(0.0));
    }
}
