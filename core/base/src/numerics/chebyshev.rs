//! A function of one variable on a piece, as the polynomial through its values at Chebyshev nodes: where it surely has no
//! root, and where it surely is monotone.

use std::f64::consts::FRAC_PI_2;
use std::sync::LazyLock;

/// Nodes of an interpolation.
pub const NODES: usize = 32;
const FEW: usize = 9;
/// What an interpolation may miss, over the most that it misses at the places between its nodes.
const MISSED: f64 = 2.0;
/// What is missed is a polynomial of the next degree, all but; its slope over it by Markov's inequality.
const STEEPEST: f64 = (NODES * NODES) as f64;

/// What the slope of a coefficient that is left out may be, over what is missed of the slope.
const LEFT_OUT: f64 = 1e-3;

type MatrixRow = [f64; NODES];

/// Cosines and matrices that are the same for every function.
struct CosineTables {
    /// The nodes, descending, and the places between them and at the ends.
    nodes: MatrixRow,
    between: [f64; NODES + 1],
    /// Coefficients by the value at each node.
    by_value: [MatrixRow; NODES],
    /// Chebyshev polynomials at the places between.
    at_between: [MatrixRow; NODES + 1],
    /// Coefficients on the lower and the upper half of the piece, by each on the whole.
    halves: [[MatrixRow; NODES]; 2],
}

static TABLES: LazyLock<CosineTables> = LazyLock::new(|| {
    // cos(k pi/(2 NODES)), reduced to one turn first.
    let cosine = |k: usize| libm::cos(FRAC_PI_2 * (k % (4 * NODES)) as f64 / NODES as f64);
    let weight = |j: usize| if j == 0 { 1.0 } else { 2.0 } / NODES as f64;
    let nodes = std::array::from_fn(|k| cosine(2 * k + 1));
    let by_value =
        std::array::from_fn(|k| std::array::from_fn(|j| weight(j) * cosine(j * (2 * k + 1))));
    let on_half = |side: f64| {
        let value = |j: usize, z: f64| libm::cos(j as f64 * libm::acos(0.5 * (z + side)));
        std::array::from_fn(|j| combined(&by_value, &nodes.map(|z| value(j, z))))
    };
    CosineTables {
        nodes,
        between: std::array::from_fn(|k| cosine(2 * k)),
        by_value,
        at_between: std::array::from_fn(|k| std::array::from_fn(|j| cosine(2 * j * k))),
        halves: [-1.0, 1.0].map(on_half),
    }
});

/// The sum of rows with these factors.
fn combined(rows: &[MatrixRow], factors: &MatrixRow) -> MatrixRow {
    let mut sum = [0.0; NODES];
    for (row, factor) in rows.iter().zip(factors) {
        sum.iter_mut().zip(row).for_each(|(sum, one)| *sum += factor * one);
    }
    sum
}

/// The polynomial through the values of a function at Chebyshev nodes of a piece, on the piece or on a part of it.
#[derive(Debug, Clone)]
pub struct Interpolant {
    /// Coefficients of the Chebyshev polynomials of the part, none of which exceeds 1 there.
    coefficients: MatrixRow,
    /// How many of them are not left out.
    count: usize,
    /// Most that the polynomial misses, and the same of its slope.
    missed: [f64; 2],
}

impl Interpolant {
    /// That of a function of -1 to 1, in the function's unit, held against its values at the places between the nodes.
    pub fn of(f: impl Fn(f64) -> f64) -> Self {
        let CosineTables { nodes, between, by_value, at_between, .. } = &*TABLES;
        let coefficients = combined(by_value, &nodes.map(&f));
        let missed = between.iter().zip(at_between).map(|(z, row)| {
            let value: f64 = row.iter().zip(&coefficients).map(|(t, c)| t * c).sum();
            (f(*z) - value).abs()
        });
        let missed = MISSED * missed.fold(0.0, f64::max);
        Self { coefficients, count: NODES, missed: [missed, STEEPEST * missed] }
    }

    /// The same through [`FEW`] nodes, for a short piece, where what is missed is rounding and more nodes tell no more.
    pub fn of_few(f: impl Fn(f64) -> f64) -> Self {
        let cosine = |k: usize| libm::cos(FRAC_PI_2 * (k % (4 * FEW)) as f64 / FEW as f64);
        let values: [f64; FEW] = std::array::from_fn(|k| f(cosine(2 * k + 1)));
        let mut coefficients = [0.0; NODES];
        for (j, c) in coefficients[..FEW].iter_mut().enumerate() {
            let terms = values.iter().enumerate().map(|(k, v)| v * cosine(j * (2 * k + 1)));
            *c = terms.sum::<f64>() * if j == 0 { 1.0 } else { 2.0 } / FEW as f64;
        }
        let missed = (0..=FEW).map(|k| {
            let terms = coefficients[..FEW].iter().enumerate();
            let value: f64 = terms.map(|(j, c)| c * cosine(2 * j * k)).sum();
            (f(cosine(2 * k)) - value).abs()
        });
        let missed = MISSED * missed.fold(0.0, f64::max);
        Self { coefficients, count: FEW, missed: [missed, (FEW * FEW) as f64 * missed] }
    }

    /// On the lower and the upper half of the part.
    pub fn halves(&self) -> [Self; 2] {
        let missed = [self.missed[0], 0.5 * self.missed[1]];
        TABLES.halves.each_ref().map(|by_whole| {
            let coefficients = combined(&by_whole[..self.count], &self.coefficients);
            Self { coefficients, missed, ..*self }.shortened()
        })
    }

    /// Without the last coefficients, where they are much less than what is missed anyway.
    fn shortened(mut self) -> Self {
        while self.count > 2 {
            let left_out = self.coefficients[self.count - 1].abs();
            let slope = ((self.count - 1) * (self.count - 1)) as f64 * left_out;
            if slope > LEFT_OUT * self.missed[1] {
                break;
            }
            self.missed = [self.missed[0] + left_out, self.missed[1] + slope];
            self.count -= 1;
        }
        self
    }

    /// Whether what is missed is too much to tell more on halves.
    pub fn is_exhausted(&self) -> bool {
        self.variation() <= self.missed[1].max((FEW * FEW) as f64 * self.missed[0])
    }

    /// Whether the function has no root on the part.
    pub fn has_no_root(&self) -> bool {
        self.coefficients[0].abs() > self.variation() + self.missed[0]
    }

    /// Whether the function is monotone on the part.
    pub fn is_monotone(&self) -> bool {
        // `d_(j - 1) = d_(j + 1) + 2 j c_j`, and half of that for the first.
        let mut slope = [0.0; NODES + 1];
        for j in (1..self.count).rev() {
            slope[j - 1] = slope[j + 1] + 2.0 * j as f64 * self.coefficients[j];
        }
        let others: f64 = slope[1..self.count].iter().map(|d| d.abs()).sum();
        0.5 * slope[0].abs() > others + self.missed[1]
    }

    /// A bound on how far the polynomial is from its constant.
    fn variation(&self) -> f64 {
        self.coefficients[1..self.count].iter().map(|c| c.abs()).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::Interpolant;

    /// Pieces with one root each, found on halves; `None` where some part stays undecided.
    fn roots(near: &Interpolant, [low, high]: [f64; 2], f: &dyn Fn(f64) -> f64) -> Option<usize> {
        if near.has_no_root() {
            return Some(0);
        }
        if near.is_monotone() {
            return Some(usize::from((f(low) > 0.0) != (f(high) > 0.0)));
        }
        if near.is_exhausted() {
            return None;
        }
        let middle = 0.5 * (low + high);
        let [lower, upper] = near.halves();
        Some(roots(&lower, [low, middle], f)? + roots(&upper, [middle, high], f)?)
    }

    /// By hand: `cos(12 z + 0.5)` vanishes at `z = ((k + 1/2) pi - 0.5)/12`, from k = -4 to 3; a wave of 1e-4 beside a
    /// parabola that comes to 1e-3 of 0 leaves it without roots.
    #[test]
    fn roots_are_counted_on_halves_of_one_interpolation() {
        let wave = |z: f64| libm::cos(12.0 * z + 0.5);
        assert_eq!(roots(&Interpolant::of(wave), [-1.0, 1.0], &wave), Some(8));
        let dip = |z: f64| (z - 0.37) * (z - 0.37) + 1e-3 + 1e-4 * libm::sin(9.0 * z);
        assert_eq!(roots(&Interpolant::of(dip), [-1.0, 1.0], &dip), Some(0));
    }

    #[test]
    fn nothing_is_said_where_the_function_is_no_polynomial() {
        let corner = |z: f64| (z - 0.37).abs() - 0.01;
        assert_eq!(roots(&Interpolant::of(corner), [-1.0, 1.0], &corner), None);
    }
}
