//! CIE 1976 L\*a\*b\*.

use crate::Triple;

/// A colour in CIE L\*a\*b\* (ISO/CIE 11664-4), with the linear part near black.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lab {
    /// Lightness L\*, 100 for the white.
    pub l: f64,
    /// Red (+) against green (−).
    pub a: f64,
    /// Yellow (+) against blue (−).
    pub b: f64,
}

impl Lab {
    /// L\*a\*b\* of XYZ beside a white, in the same units.
    ///
    /// ```
    /// use illuminant_color::Lab;
    /// let white = [0.95, 1.0, 1.09];
    /// let lab = Lab::from_xyz(white, white);
    /// assert!((lab.l - 100.0).abs() < 1e-12 && lab.a.abs() < 1e-12 && lab.b.abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn from_xyz(xyz: Triple, white: Triple) -> Self {
        const DELTA: f64 = 6.0 / 29.0;
        let f = |t: f64| if t > DELTA.powi(3) { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 };
        let [fx, fy, fz] = [0, 1, 2].map(|i| f(xyz[i] / white[i]));
        Self { l: 116.0 * fy - 16.0, a: 500.0 * (fx - fy), b: 200.0 * (fy - fz) }
    }
}
