//! The AC₁C₂ space of Meyer: axes along which tristimulus values vary most (book eq 3.6).

use crate::Matrix;

/// From XYZ to A, C₁, C₂ (eq 3.6).
///
/// ```
/// use illuminant_color::XYZ_TO_AC1C2;
/// let [a, c1, c2] = XYZ_TO_AC1C2.apply([1.0f64, 1.0, 1.0]);
/// assert!((a - 0.9986).abs() < 1e-12 && (c1 + 0.1340).abs() < 1e-12 && (c2 - 0.5165).abs() < 1e-12);
/// ```
pub const XYZ_TO_AC1C2: Matrix =
    Matrix([[-0.0177, 1.0090, 0.0073], [-1.5370, 1.0821, 0.3209], [0.1946, -0.2045, 0.5264]]);
