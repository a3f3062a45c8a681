//! Y_t I Q of NTSC video (book eqs 5.2, 5.3 and 5.5), with the rounded matrices of the standard.
//!
//! Eq 5.2 is corrected: 0.114 for the printed 0.144, and −0.523 for −0.528 (ERRATA 13, 14), so that white has Y_t = 1
//! and neutral colours have I = Q = 0. Since both matrices are rounded, there and back is good to 3 × 10⁻⁴ only.

use crate::Matrix;

/// From RGB of the NTSC primaries to Y_t, I, Q (eq 5.2, corrected).
pub const RGB_TO_YIQ: Matrix =
    Matrix([[0.299, 0.587, 0.114], [0.596, -0.275, -0.321], [0.212, -0.523, 0.311]]);

/// From Y_t, I, Q to RGB of the NTSC primaries (eq 5.3).
pub const YIQ_TO_RGB: Matrix =
    Matrix([[1.0, 0.9557, 0.6199], [1.0, -0.2716, -0.6469], [1.0, -1.1082, 1.7051]]);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neutral_colours_have_no_colour_signal() {
        for (found, wanted) in RGB_TO_YIQ.apply([1.0; 3]).into_iter().zip([1.0, 0.0, 0.0f64]) {
            assert!((found - wanted).abs() < 1e-15);
        }
    }

    #[test]
    fn the_two_rounded_matrices_are_each_others_inverse_to_their_digits() {
        let product = YIQ_TO_RGB.after(&RGB_TO_YIQ);
        for (found, wanted) in product.0.iter().flatten().zip(Matrix::IDENTITY.0.iter().flatten()) {
            assert!((found - wanted).abs() < 3e-4, "{product:?}");
        }
    }
}
