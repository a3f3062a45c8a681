//! 3×3 matrices between spaces of three values (book eqs 3.1–3.3, section III.7).
//!
//! A matrix acts on columns. Matrices are concatenated by [`Matrix::after`], and inverted by elimination with the
//! largest pivot first; a singular one is refused with what was found.

use crate::{Real, Triple};
use thiserror::Error;

/// A 3×3 matrix, as rows.
///
/// ```
/// use illuminant_color::Matrix;
/// let m = Matrix([[2.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 4.0]]);
/// assert_eq!(m.apply([1.0, 1.0, 1.0]), [2.0, 2.0, 4.0]);
/// assert_eq!(m.inverse().unwrap().after(&m), Matrix::IDENTITY);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrix(pub [Triple; 3]);

/// Why a matrix has no inverse.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Singular {
    /// A row depends on the others, as far as f64 can tell.
    #[error(
        "the matrix is singular: beside its largest value, what is left for column {column} is {pivot:.1e}, \
         so one row or column is a mixture of the others"
    )]
    Dependent {
        /// The column without pivot, from 1.
        column: usize,
        /// What was left in it, relative to the largest value of its row before.
        pivot: f64,
    },
    /// A value is NaN or infinite.
    #[error("the matrix holds a value that is not finite")]
    NotFinite,
}

impl Matrix {
    /// The matrix that changes nothing.
    pub const IDENTITY: Self = Self([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);

    /// The matrix with these columns.
    #[must_use]
    pub fn from_columns(columns: [Triple; 3]) -> Self {
        Self([0, 1, 2].map(|row| columns.map(|column| column[row])))
    }

    /// The matrix with these numbers on its diagonal.
    #[must_use]
    pub fn diagonal([a, b, c]: Triple) -> Self {
        Self([[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]])
    }

    /// The product with a column.
    #[must_use]
    #[inline(always)]
    pub fn apply<T: Real>(&self, [a, b, c]: [T; 3]) -> [T; 3] {
        self.0.map(|[x, y, z]| c.mul_add(T::of(z), b.mul_add(T::of(y), a * T::of(x))))
    }

    /// The matrix that does `first`, and then this one.
    #[must_use]
    pub fn after(&self, first: &Self) -> Self {
        let column = |j: usize| self.apply(first.0.map(|row| row[j]));
        Self::from_columns([column(0), column(1), column(2)])
    }

    /// The inverse, by Gauss–Jordan elimination with the largest pivot of the rows left, each row measured by its
    /// largest value.
    ///
    /// # Errors
    /// [`Singular`] when a value is not finite, or a pivot is below 10⁻¹² of its row: what came out would have lost
    /// its digits.
    pub fn inverse(&self) -> Result<Self, Singular> {
        const SMALLEST: f64 = 1e-12;
        if self.0.iter().flatten().any(|v| !v.is_finite()) {
            return Err(Singular::NotFinite);
        }
        let mut left = self.0;
        let mut right = Self::IDENTITY.0;
        let mut size = left.map(|row| row.iter().fold(0.0, |m: f64, v| m.max(v.abs())));
        for column in 0..3 {
            let relative = |row: usize| {
                if size[row] > 0.0 { left[row][column].abs() / size[row] } else { 0.0 }
            };
            let mut best = column;
            for row in column + 1..3 {
                if relative(row) > relative(best) {
                    best = row;
                }
            }
            let pivot = relative(best);
            if !(pivot >= SMALLEST) {
                return Err(Singular::Dependent { column: column + 1, pivot });
            }
            left.swap(column, best);
            right.swap(column, best);
            size.swap(column, best);
            let value = left[column][column];
            left[column] = left[column].map(|v| v / value);
            right[column] = right[column].map(|v| v / value);
            for row in (0..3).filter(|row| *row != column) {
                let factor = left[row][column];
                for k in 0..3 {
                    left[row][k] -= factor * left[column][k];
                    right[row][k] -= factor * right[column][k];
                }
            }
        }
        let inverse = Self(right);
        if right.iter().flatten().all(|v| v.is_finite()) { Ok(inverse) } else { Err(Singular::NotFinite) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_inverse_that_needs_exchanged_rows_is_right() {
        // Red listed with y > x, the case in which the book's code went wrong (ERRATA 11).
        let m = Matrix([[0.21, 0.67, 0.14], [0.71, 0.33, 0.08], [0.08, 0.0, 0.78]]);
        let zero_first = Matrix([[0.0, 2.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 1.0]]);
        for m in [m, zero_first] {
            let product = m.after(&m.inverse().unwrap());
            for (found, wanted) in product.0.iter().flatten().zip(Matrix::IDENTITY.0.iter().flatten()) {
                assert!((found - wanted).abs() < 1e-14, "{product:?}");
            }
        }
    }

    #[test]
    fn singular_matrices_are_refused_with_a_report() {
        let collinear = Matrix([[0.1, 0.2, 0.3], [0.1, 0.2, 0.3], [0.8, 0.6, 0.4]]);
        let error = collinear.inverse().unwrap_err();
        assert!(matches!(error, Singular::Dependent { .. }), "{error}");
        assert!(error.to_string().starts_with("the matrix is singular"));
        assert!(Matrix([[0.0; 3]; 3]).inverse().is_err());
        let broken = Matrix([[f64::NAN, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        assert_eq!(broken.inverse(), Err(Singular::NotFinite));
    }

    #[test]
    fn size_alone_makes_nothing_singular() {
        for scale in [1e-12, 1e12] {
            let m = Matrix([[1.0, 2.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 1.0]].map(|r| r.map(|v| v * scale)));
            assert!(m.inverse().is_ok());
        }
    }
}
