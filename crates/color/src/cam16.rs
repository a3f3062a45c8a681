//! CAM16 and its uniform space CAM16-UCS (Li et al. 2017), for colours of a display seen by an adapted eye.
//!
//! The conditions are those of a display in a dim office: L_A = 20 cd/m², Y_b = 20, average surround (c = 0.69, N_c = 1,
//! F = 1), and full adaptation to the white (D = 1), so that the neutral axis of the display is neutral here too.
//! XYZ is relative, with Y = 1 for the white.
//!
//! J' = 1.7 J / (1 + 0.007 J), M' = ln(1 + 0.0228 M) / 0.0228, a' = M' cos h, b' = M' sin h.
//!
//! Reference: C. Li et al., "Comprehensive color solutions: CAM16, CAT16, and CAM16-UCS", Color Research and
//! Application 42(6), 2017.

use crate::{Matrix, Triple};

const CAT16: Matrix = Matrix([
    [0.401_288, 0.650_173, -0.051_461],
    [-0.250_268, 1.204_414, 0.045_854],
    [-0.002_079, 0.048_952, 0.953_127],
]);

const C: f64 = 0.69;
const N: f64 = 0.2;
const CHROMATIC: f64 = 50_000.0 / 13.0;

/// CAM16-UCS beside a white.
///
/// ```
/// use illuminant_color::Cam16;
/// let cam = Cam16::new([0.95047, 1.0, 1.08883]).unwrap();
/// let [j, a, b] = cam.from_xyz([0.95047, 1.0, 1.08883]);
/// assert!((j - 100.0).abs() < 1e-9 && a.abs() < 1e-3 && b.abs() < 1e-3);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Cam16 {
    to_cones: Matrix,
    from_cones: Matrix,
    luminance_level: f64,
    background: f64,
    z: f64,
    white: f64,
}

impl Cam16 {
    /// CAM16 beside the white of this XYZ; `None` when it has a cone response of zero.
    #[must_use]
    pub fn new(white: Triple) -> Option<Self> {
        const ADAPTING: f64 = 20.0;
        let cones = CAT16.apply(white);
        let to_cones = Matrix::diagonal(cones.map(|v| 100.0 / v)).after(&CAT16);
        let k = 1.0 / (5.0 * ADAPTING + 1.0);
        let k4 = k * k * k * k;
        let luminance_level = k4 * ADAPTING + 0.1 * (1.0 - k4) * (1.0 - k4) * (5.0 * ADAPTING).cbrt();
        let background = 0.725 / N.powf(0.2);
        let mut cam = Self {
            from_cones: to_cones.inverse().ok()?,
            to_cones,
            luminance_level,
            background,
            z: 1.48 + N.sqrt(),
            white: 1.0,
        };
        cam.white = cam.achromatic(to_cones.apply(white).map(|v| cam.compress(v)));
        Some(cam)
    }

    fn compress(&self, cone: f64) -> f64 {
        let x = (self.luminance_level * cone.abs() / 100.0).powf(0.42);
        (400.0 * x / (x + 27.13)).copysign(cone)
    }

    fn expand(&self, response: f64) -> f64 {
        // The response of a cone never reaches 400; a NaN passes.
        let r = if response.abs() > 399.9 { 399.9 } else { response.abs() };
        (100.0 / self.luminance_level * (27.13 * r / (400.0 - r)).powf(1.0 / 0.42)).copysign(response)
    }

    /// A, the response from which J comes.
    fn achromatic(&self, [r, g, b]: Triple) -> f64 {
        (2.0 * r + g + b / 20.0) * self.background
    }

    /// J', a', b' of an XYZ; black for one of no achromatic response.
    #[must_use]
    pub fn from_xyz(&self, xyz: Triple) -> Triple {
        let [r, g, b] = self.to_cones.apply(xyz).map(|v| self.compress(v));
        let achromatic = self.achromatic([r, g, b]);
        if achromatic <= 0.0 {
            return [0.0; 3];
        }
        let a = r - 12.0 * g / 11.0 + b / 11.0;
        let y = (r + g - 2.0 * b) / 9.0;
        let hue = y.atan2(a);
        let j = 100.0 * (achromatic / self.white).powf(C * self.z);
        // No real colour comes near zero here; an imaginary one is as colourful as its hue can be.
        let t = self.chroma_scale(hue) * a.hypot(y) / (r + g + 1.05 * b + 0.305).max(0.05);
        let chroma = t.powf(0.9) * (j / 100.0).sqrt() * (1.64 - 0.29f64.powf(N)).powf(0.73);
        let m = (0.0228 * chroma * self.luminance_level.powf(0.25)).ln_1p() / 0.0228;
        [1.7 * j / (1.0 + 0.007 * j), m * hue.cos(), m * hue.sin()]
    }

    /// XYZ of J', a', b'.
    #[must_use]
    pub fn to_xyz(&self, [j, a, b]: Triple) -> Triple {
        if j <= 0.0 {
            return [0.0; 3];
        }
        let lightness = j / (1.7 - 0.007 * j);
        let hue = b.atan2(a);
        let chroma = (0.0228 * a.hypot(b)).exp_m1() / 0.0228 / self.luminance_level.powf(0.25);
        let t = (chroma / ((lightness / 100.0).sqrt() * (1.64 - 0.29f64.powf(N)).powf(0.73))).powf(1.0 / 0.9);
        let p = self.white * (lightness / 100.0).powf(1.0 / (C * self.z)) / self.background;
        let (sin, cos) = hue.sin_cos();
        // The two equations of hue and of t, with p = 2r + g + b/20, solved for the length along the hue.
        let gamma =
            23.0 * (p + 0.305) * t / (23.0 * self.chroma_scale(hue) + 11.0 * t * cos + 108.0 * t * sin);
        let (a, y) = (gamma * cos, gamma * sin);
        let cones = [
            (460.0 * p + 451.0 * a + 288.0 * y) / 1403.0,
            (460.0 * p - 891.0 * a - 261.0 * y) / 1403.0,
            (460.0 * p - 220.0 * a - 6300.0 * y) / 1403.0,
        ];
        self.from_cones.apply(cones.map(|v| self.expand(v)))
    }

    /// What the length of (a, b) is multiplied by in t.
    fn chroma_scale(&self, hue: f64) -> f64 {
        CHROMATIC * self.background * 0.25 * ((hue + 2.0).cos() + 3.8)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_implementation_agrees() {
        // colour-science 0.4.6: XYZ_to_CAM16 with L_A = 20, Y_b = 20, average surround, illuminant discounted.
        let found = Cam16::new([0.95047, 1.0, 1.08883]).unwrap().from_xyz([0.2, 0.1, 0.05]);
        for (a, b) in found.into_iter().zip([42.977_075_425_1, 41.864_698_946_4, 9.110_682_151_95]) {
            assert!((a - b).abs() < 1e-8, "{found:?}");
        }
    }

    #[test]
    fn colours_that_cannot_be_have_numbers_too() {
        let cam = Cam16::new([0.95047, 1.0, 1.08883]).unwrap();
        for xyz in [[0.2, 0.3, -1.9], [0.05, 0.1, -2.0], [1.0, -0.1, 0.3], [-1.0, 1.0, -1.0]] {
            let found = cam.from_xyz(xyz);
            assert!(found.iter().chain(&cam.to_xyz(found)).all(|v| v.is_finite()), "{xyz:?}: {found:?}");
        }
    }

    #[test]
    fn colours_come_back() {
        let cam = Cam16::new([0.95047, 1.0, 1.08883]).unwrap();
        for xyz in [[0.2, 0.1, 0.05], [0.4, 0.5, 0.9], [0.9, 1.0, 0.1], [0.002, 0.001, 0.003]] {
            let back = cam.to_xyz(cam.from_xyz(xyz));
            for (a, b) in back.into_iter().zip(xyz) {
                assert!((a - b).abs() < 1e-9, "{xyz:?} becomes {back:?}");
            }
        }
    }
}
