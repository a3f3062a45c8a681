//! Oklab: a space of lightness and two opponent axes in which hue is nearly a straight line (Ottosson 2020).
//!
//! lms = M₁ XYZ, each divided by that of the white; (L, a, b) = M₂ (l^⅓, m^⅓, s^⅓). With the division, which Ottosson's
//! form leaves out because his M₁ is made for D65, any white has L = 1 and a = b = 0; for D65 the two agree to 2 × 10⁻⁴.
//!
//! Reference: B. Ottosson, "A perceptual color space for image processing", 2020.

use crate::{Matrix, Triple};

const XYZ_TO_LMS: Matrix = Matrix([
    [0.818_933_010_1, 0.361_866_742_4, -0.128_859_713_7],
    [0.032_984_543_6, 0.929_311_871_5, 0.036_145_638_7],
    [0.048_200_301_8, 0.264_366_269_1, 0.633_851_707_0],
]);

/// From the cube roots of cone responses to L, a, b.
const ROOTS_TO_LAB: Matrix = Matrix([
    [0.210_454_255_3, 0.793_617_785_0, -0.004_072_046_8],
    [1.977_998_495_1, -2.428_592_205_0, 0.450_593_709_9],
    [0.025_904_037_1, 0.782_771_766_2, -0.808_675_766_0],
]);

/// Oklab beside a white.
///
/// ```
/// use illuminant_color::Oklab;
/// let oklab = Oklab::new([0.95047, 1.0, 1.08883]).unwrap();
/// let [l, a, b] = oklab.from_xyz([0.95047, 1.0, 1.08883]);
/// assert!((l - 1.0).abs() < 1e-6 && a.abs() < 1e-6 && b.abs() < 1e-6);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Oklab {
    to_lms: Matrix,
    from_lms: Matrix,
    to_roots: Matrix,
}

impl Oklab {
    /// Oklab beside the white of this XYZ; `None` when it has a cone response of zero.
    #[must_use]
    pub fn new(white: Triple) -> Option<Self> {
        let cones = XYZ_TO_LMS.apply(white);
        let to_lms = Matrix::diagonal(cones.map(|v| 1.0 / v)).after(&XYZ_TO_LMS);
        Some(Self { from_lms: to_lms.inverse().ok()?, to_roots: ROOTS_TO_LAB.inverse().ok()?, to_lms })
    }

    /// L, a, b of an XYZ.
    #[must_use]
    pub fn from_xyz(&self, xyz: Triple) -> Triple {
        ROOTS_TO_LAB.apply(self.to_lms.apply(xyz).map(f64::cbrt))
    }

    /// XYZ of L, a, b.
    #[must_use]
    pub fn to_xyz(&self, lab: Triple) -> Triple {
        self.from_lms.apply(self.to_roots.apply(lab).map(|v| v * v * v))
    }

    /// The matrix from XYZ to cone responses, 1 for the white.
    #[must_use]
    pub fn to_lms(&self) -> Matrix {
        self.to_lms
    }

    /// The matrix from cone responses to XYZ.
    #[must_use]
    pub fn from_lms(&self) -> Matrix {
        self.from_lms
    }

    /// L, a, b of the cube roots of cone responses.
    #[must_use]
    pub fn of_roots(roots: Triple) -> Triple {
        ROOTS_TO_LAB.apply(roots)
    }

    /// The cube roots of cone responses of L, a, b.
    #[must_use]
    pub fn roots(&self, lab: Triple) -> Triple {
        self.to_roots.apply(lab)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_examples_come_out() {
        // Ottosson 2020, the table of XYZ and Oklab; his white is D65 and his values have three digits.
        let oklab = Oklab::new([0.950, 1.000, 1.089]).unwrap();
        for (xyz, lab) in [
            ([0.950, 1.000, 1.089], [1.000, 0.000, 0.000]),
            ([1.0, 0.0, 0.0], [0.450, 1.236, -0.019]),
            ([0.0, 1.0, 0.0], [0.922, -0.671, 0.263]),
            ([0.0, 0.0, 1.0], [0.153, -1.415, -0.449]),
        ] {
            let found = oklab.from_xyz(xyz);
            for (a, b) in found.into_iter().zip(lab) {
                assert!((a - b).abs() < 1.5e-3, "{xyz:?}: {found:?}");
            }
            for (a, b) in oklab.to_xyz(found).into_iter().zip(xyz) {
                assert!((a - b).abs() < 1e-12);
            }
        }
    }
}
