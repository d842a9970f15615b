//! Multipliers of an orbit: the eigenvalues of its map's Jacobian, with the checks that make them
//! evidence, and what they say of stability.

use nalgebra::allocator::Allocator;
use nalgebra::linalg::Schur;
use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{DMatrix, DefaultAllocator, Dim, DimDiff, DimSub, Matrix4, OMatrix, SMatrix, U1};
use serde::Serialize;

use crate::operation_count;

/// Sweeps that the eigenvalue iteration may take; three or four per eigenvalue are usual.
pub(super) const LARGEST_SWEEPS: usize = 300;
/// Shifts of the spectrum, over the matrix's size, that are tried in turn. The unshifted iteration
/// stalls on spectra symmetric about 0 (a biquadratic characteristic polynomial), which any shift
/// makes unsymmetric.
const SHIFTS: [f64; 3] = [0.0, 0.37, -0.61];

/// Largest entry of a matrix up to which nothing is lost.
const UNBALANCED: f64 = 16.0;

/// Operations of a Schur decomposition, `25 n^3` (Golub and Van Loan, Matrix Computations, 7.5.6).
const SCHUR: u64 = 25 * 4 * 4 * 4;

/// Distance from the unit circle within which a complex pair lies on it: at a root of
/// [`unit_product`] that is one it is there to rounding, 1e-14, and at one that is a pair of real
/// reciprocals any complex pair is somewhere else.
const ON_CIRCLE: f64 = 1e-6;

/// The four multipliers of a map, largest modulus first, conjugates next to one another.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Multipliers {
    /// `[re, im]`, dimensionless.
    pub values: [[f64; 2]; 4],
}

impl Multipliers {
    /// Eigenvalues of `jacobian`; `None` where it is not finite or the iteration does not converge.
    pub fn of(jacobian: &Matrix4<f64>) -> Option<Self> {
        operation_count::note(SCHUR);
        let values = eigenvalues(jacobian)?;
        Some(Self { values: [0, 1, 2, 3].map(|k| values[k]) })
    }

    /// Largest modulus, a ratio over the period.
    pub fn spectral_radius(&self) -> f64 {
        let [re, im] = self.values[0];
        libm::hypot(re, im)
    }

    /// Whether every multiplier lies inside the unit circle.
    pub fn stable(&self) -> bool {
        self.spectral_radius() < 1.0
    }

    /// Whether a complex pair lies on the unit circle: a root of [`unit_product`] that is a
    /// Neimark-Sacker bifurcation.
    pub(super) fn has_pair_on_circle(&self) -> bool {
        has_pair_on_circle(&self.values)
    }

    /// What kind of multiplier is the largest.
    pub fn leading(&self) -> Leading {
        match self.values[0] {
            [_, im] if im != 0.0 => Leading::ComplexPair,
            [re, _] if re < 0.0 => Leading::Negative,
            _ => Leading::Positive,
        }
    }
}

/// The kind of the largest multiplier: through which it is that stability is, or would be, lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Leading {
    /// Real and positive: towards +1, a saddle-node.
    Positive,
    /// Real and negative: towards -1, a symmetry breaking or a period doubling.
    Negative,
    /// A complex pair: towards a Neimark-Sacker bifurcation, the Hopf of the slow flow.
    ComplexPair,
}

/// Largest modulus of the eigenvalues of a square matrix, in its unit; `None` where it is not finite or the iteration does not
/// converge.
pub fn spectral_radius(matrix: &DMatrix<f64>) -> Option<f64> {
    let [re, im] = *eigenvalues(matrix)?.first()?;
    Some(libm::hypot(re, im))
}

/// Eigenvalues `[re, im]` of a matrix of any size, largest modulus first, conjugates next to one another; `None` where it is
/// not finite or the iteration does not converge.
pub(super) fn eigenvalues<D>(matrix: &OMatrix<f64, D, D>) -> Option<Vec<[f64; 2]>>
where
    D: Dim + DimSub<U1>,
    DefaultAllocator:
        Allocator<D, D> + Allocator<D> + Allocator<DimDiff<D, U1>> + Allocator<D, DimDiff<D, U1>>,
{
    let size = matrix.amax();
    if !size.is_finite() {
        return None;
    }
    let mut values = SHIFTS.iter().find_map(|shift| shifted_eigenvalues(matrix, shift * size))?;
    values.sort_by(|a, b| {
        let key = |[re, im]: &[f64; 2]| libm::hypot(*re, *im);
        // Conjugates have equal moduli to the last bit; the positive imaginary part comes first.
        key(b).total_cmp(&key(a)).then(b[0].total_cmp(&a[0])).then(b[1].total_cmp(&a[1]))
    });
    Some(values)
}

fn shifted_eigenvalues<D>(matrix: &OMatrix<f64, D, D>, shift: f64) -> Option<Vec<[f64; 2]>>
where
    D: Dim + DimSub<U1>,
    DefaultAllocator:
        Allocator<D, D> + Allocator<D> + Allocator<DimDiff<D, U1>> + Allocator<D, DimDiff<D, U1>>,
{
    let mut shifted = matrix.clone_owned();
    shifted +=
        OMatrix::<f64, D, D>::identity_generic(matrix.shape_generic().0, matrix.shape_generic().1)
            * shift;
    // A phase beside displacements of many clearances: without this the small entries are lost in the rounding of the large.
    if matrix.amax() > UNBALANCED {
        balance_parlett_reinsch(&mut shifted);
    }
    let schur = Schur::try_new(shifted, f64::EPSILON, LARGEST_SWEEPS)?;
    let found = schur.complex_eigenvalues();
    let values: Vec<[f64; 2]> = found.iter().map(|value| [value.re - shift, value.im]).collect();
    values.iter().flatten().all(|part| part.is_finite()).then_some(values)
}

/// Whether one of a complex pair lies on the unit circle.
pub(super) fn has_pair_on_circle(multipliers: &[[f64; 2]]) -> bool {
    let on_circle =
        |[re, im]: &[f64; 2]| *im != 0.0 && (libm::hypot(*re, *im) - 1.0).abs() < ON_CIRCLE;
    multipliers.iter().any(on_circle)
}

/// `det(J - I)`, a pure number without unit: 0 where a multiplier is +1.
pub fn plus_one(jacobian: &Matrix4<f64>) -> f64 {
    (jacobian - Matrix4::identity()).determinant()
}

/// `det(J + I)`, a pure number without unit: 0 where a multiplier is -1.
pub fn minus_one(jacobian: &Matrix4<f64>) -> f64 {
    (jacobian + Matrix4::identity()).determinant()
}

/// `det(J^(2) - I)` with the second compound matrix, whose eigenvalues are the products of two
/// different multipliers: 0 where a complex pair has modulus 1 (and where two real multipliers are
/// each other's reciprocals, which is no bifurcation).
pub fn unit_product(jacobian: &Matrix4<f64>) -> f64 {
    const PAIRS: [(usize, usize); 6] = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    let compound = SMatrix::<f64, 6, 6>::from_fn(|row, column| {
        let ((a, b), (c, d)) = (PAIRS[row], PAIRS[column]);
        jacobian[(a, c)] * jacobian[(b, d)] - jacobian[(a, d)] * jacobian[(b, c)]
    });
    (compound - SMatrix::<f64, 6, 6>::identity()).determinant()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn companion(roots: [f64; 4]) -> Matrix4<f64> {
        // Coefficients of the monic polynomial, ascending.
        let mut p = vec![1.0];
        for root in roots {
            let mut q = vec![0.0; p.len() + 1];
            for (k, c) in p.iter().enumerate() {
                q[k + 1] += c;
                q[k] -= root * c;
            }
            p = q;
        }
        Matrix4::from_fn(
            |row, column| {
                if column == 3 { -p[row] } else { f64::from(u8::from(row == column + 1)) }
            },
        )
    }

    #[test]
    fn known_spectra_are_found_the_symmetric_ones_included() {
        for roots in [[0.9, 0.5, -0.3, 0.1], [2.0, 1.0, -1.0, -2.0], [0.0, 0.0, 0.5, -0.5]] {
            let found = Multipliers::of(&companion(roots)).expect("finite");
            let mut found: Vec<f64> = found.values.iter().map(|value| value[0]).collect();
            let mut roots = roots.to_vec();
            found.sort_by(f64::total_cmp);
            roots.sort_by(f64::total_cmp);
            // A double root of a companion matrix is known to the root of the precision.
            assert!(found.iter().zip(&roots).all(|(a, b)| (a - b).abs() < 1e-7), "{found:?}");
        }
    }

    #[test]
    fn a_matrix_that_is_not_finite_has_no_multipliers() {
        let mut broken = Matrix4::identity();
        broken[(2, 1)] = f64::NAN;
        assert!(Multipliers::of(&broken).is_none());
    }

    #[test]
    fn test_functions_vanish_where_they_should() {
        let turn = |modulus: f64| {
            let (sin, cos) = libm::sincos(0.7);
            let mut m = Matrix4::identity() * 0.3;
            m[(0, 0)] = modulus * cos;
            m[(1, 1)] = modulus * cos;
            m[(0, 1)] = -modulus * sin;
            m[(1, 0)] = modulus * sin;
            m
        };
        assert!(unit_product(&turn(1.0)).abs() < 1e-15);
        assert!(unit_product(&turn(0.99)) * unit_product(&turn(1.01)) < 0.0);
        assert!(plus_one(&companion([1.0, 0.5, 0.2, -0.3])).abs() < 1e-15);
        assert!(minus_one(&companion([-1.0, 0.5, 0.2, -0.3])).abs() < 1e-15);
    }
}
