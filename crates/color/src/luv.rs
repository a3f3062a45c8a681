//! CIE 1976 L\*u\*v\*, in the form of the CIE and in that of the book (eq 3.5).
//!
//! u′ = 4X/(X + 15Y + 3Z), v′ = 9Y/(X + 15Y + 3Z); u\* = 13 L\* (u′ − u′_w), v\* = 13 L\* (v′ − v′_w). L\* is that of
//! [`crate::Lightness`]. Black has no chromaticity and takes that of the white, so its u\* and v\* are 0; back from
//! L\* = 0 the chromaticity is the white's.

use crate::lab::{BOOK_SCALE, curve, curve_inverse};
use crate::{Lightness, Real};

/// A white, prepared: Y_w, u′_w, v′_w.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LuvWhite {
    y: f64,
    u: f64,
    v: f64,
}

impl LuvWhite {
    /// The white with these tristimulus values.
    ///
    /// ```
    /// use illuminant_color::{Lightness, LuvWhite};
    /// let white = [0.95, 1.0, 1.09];
    /// let [l, u, v] = LuvWhite::new(white).luv(white, Lightness::Cie);
    /// assert!((l - 100.0).abs() < 1e-12 && u.abs() < 1e-12 && v.abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn new([x, y, z]: [f64; 3]) -> Self {
        let sum = x + 15.0 * y + 3.0 * z;
        Self { y, u: 4.0 * x / sum, v: 9.0 * y / sum }
    }

    /// L\*u\*v\* of XYZ in the unit of the white.
    #[must_use]
    #[inline(always)]
    pub fn luv<T: Real>(&self, [x, y, z]: [T; 3], form: Lightness) -> [T; 3] {
        let relative = y * T::of(1.0 / self.y);
        let l = match form {
            Lightness::Cie => curve(relative).mul_add(T::of(116.0), T::of(-16.0)),
            Lightness::Book => relative.cbrt().mul_add(T::of(BOOK_SCALE), T::of(-16.0)),
        };
        let sum = z.mul_add(T::of(3.0), y.mul_add(T::of(15.0), x));
        let inverse = T::of(1.0) / sum;
        let black = sum == T::of(0.0);
        let (u, v) = (
            (x * inverse).mul_add(T::of(4.0), T::of(-self.u)),
            (y * inverse).mul_add(T::of(9.0), T::of(-self.v)),
        );
        let u = T::select(black, T::of(0.0), u);
        let v = T::select(black, T::of(0.0), v);
        let scale = l * T::of(13.0);
        [l, scale * u, scale * v]
    }

    /// XYZ of L\*u\*v\*, in the unit of the white.
    #[must_use]
    #[inline(always)]
    pub fn xyz<T: Real>(&self, [l, u, v]: [T; 3], form: Lightness) -> [T; 3] {
        let relative = match form {
            Lightness::Cie => curve_inverse((l + T::of(16.0)) * T::of(1.0 / 116.0)),
            Lightness::Book => {
                let root = (l + T::of(16.0)) * T::of(1.0 / BOOK_SCALE);
                root * root * root
            }
        };
        let y = relative * T::of(self.y);
        let inverse = T::of(1.0 / 13.0) / l;
        let without = l == T::of(0.0);
        let u = T::select(without, T::of(self.u), u.mul_add(inverse, T::of(self.u)));
        let v = T::select(without, T::of(self.v), v.mul_add(inverse, T::of(self.v)));
        // X = Y 9u′/4v′ and Z = Y (12 − 3u′ − 20v′)/4v′.
        let share = y * T::of(0.25) / v;
        let z = v.mul_add(T::of(-20.0), u.mul_add(T::of(-3.0), T::of(12.0)));
        [share * u * T::of(9.0), y, share * z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_invert_and_black_is_black() {
        let white = LuvWhite::new([0.9504, 1.0, 1.0889]);
        for form in [Lightness::Cie, Lightness::Book] {
            for xyz in [[0.2, 0.1, 0.3], [0.001, 0.002, 0.0005], [3.0, 2.0, 0.1], [0.0, 0.0, 0.0]] {
                let back = white.xyz(white.luv(xyz, form), form);
                for (a, b) in back.iter().zip(xyz) {
                    assert!((a - b).abs() < 1e-13, "{form:?} {xyz:?} {back:?}");
                }
            }
            assert!(white.luv([f64::NAN, 0.5, 0.5], form)[1].is_nan());
        }
        assert_eq!(white.luv([0.0f64; 3], Lightness::Book), [-16.0, 0.0, 0.0]);
    }
}
