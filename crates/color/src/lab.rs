//! CIE 1976 L\*a\*b\*, in the form of the CIE and in that of the book.
//!
//! With t = X/X_w, Y/Y_w, Z/Z_w:
//! - CIE (ISO/CIE 11664-4): L\* = 116 f(Y/Y_w) − 16, a\* = 500 (f(X/X_w) − f(Y/Y_w)), b\* = 200 (f(Y/Y_w) − f(Z/Z_w)),
//!   f(t) = t^⅓ above (6/29)³, and t / (3 (6/29)²) + 4/29 below.
//! - book (eq 3.4, for 1 ≤ Y ≤ 100): L\* = 25 (100 Y/Y_w)^⅓ − 16, a\* and b\* with cube roots throughout. The white has
//!   L\* = 100.04 and black −16 (ERRATA 61).

use crate::{Real, Triple};

/// Which definition of lightness is meant, in L\*a\*b\* and in L\*u\*v\*.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lightness {
    /// That of the CIE of 1976: 100 for the white, 0 for black, with a straight part near black.
    #[default]
    Cie,
    /// That of the book: a cube root down to black, which has −16.
    Book,
}

impl Lightness {
    /// The form of a name, `CIE` or `book`, whatever its case.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        [("cie", Self::Cie), ("book", Self::Book)]
            .into_iter()
            .find_map(|(known, form)| known.eq_ignore_ascii_case(name).then_some(form))
    }
}

/// (6/29)³, below which the curve of the CIE is straight.
pub(crate) const KNEE: f64 = 216.0 / 24_389.0;
/// 1 / (3 (6/29)²), its slope there.
pub(crate) const SLOPE: f64 = 841.0 / 108.0;
/// 25 · 100^⅓, exact to f64.
pub(crate) const BOOK_SCALE: f64 = 116.039_720_840_319_47;

/// f(t) of the CIE.
#[inline(always)]
pub(crate) fn curve<T: Real>(t: T) -> T {
    let root = t.cbrt();
    let straight = t.mul_add(T::of(SLOPE), T::of(4.0 / 29.0));
    T::select(t <= T::of(KNEE), straight, root)
}

/// The t of f(t).
#[inline(always)]
pub(crate) fn curve_inverse<T: Real>(f: T) -> T {
    let straight = (f - T::of(4.0 / 29.0)) * T::of(1.0 / SLOPE);
    T::select(f <= T::of(6.0 / 29.0), straight, f * f * f)
}

/// L\*a\*b\* of XYZ divided by that of the white.
#[inline(always)]
pub(crate) fn from_relative<T: Real>([x, y, z]: [T; 3], form: Lightness) -> [T; 3] {
    let ([x, y, z], scale) = match form {
        Lightness::Cie => ([curve(x), curve(y), curve(z)], 116.0),
        Lightness::Book => ([x.cbrt(), y.cbrt(), z.cbrt()], BOOK_SCALE),
    };
    [y.mul_add(T::of(scale), T::of(-16.0)), (x - y) * T::of(500.0), (y - z) * T::of(200.0)]
}

/// XYZ, divided by that of the white, of L\*a\*b\*.
#[inline(always)]
pub(crate) fn to_relative<T: Real>([l, a, b]: [T; 3], form: Lightness) -> [T; 3] {
    let scale = match form {
        Lightness::Cie => 116.0,
        Lightness::Book => BOOK_SCALE,
    };
    let y = (l + T::of(16.0)) * T::of(1.0 / scale);
    let roots = [a.mul_add(T::of(1.0 / 500.0), y), y, b.mul_add(T::of(-1.0 / 200.0), y)];
    match form {
        Lightness::Cie => roots.map(curve_inverse),
        Lightness::Book => roots.map(|f| f * f * f),
    }
}

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
        let [l, a, b] = from_relative([0, 1, 2].map(|i| xyz[i] / white[i]), Lightness::Cie);
        Self { l, a, b }
    }

    /// XYZ beside a white: the inverse of [`Self::from_xyz`].
    #[must_use]
    pub fn to_xyz(self, white: Triple) -> Triple {
        let relative = to_relative([self.l, self.a, self.b], Lightness::Cie);
        [0, 1, 2].map(|i| relative[i] * white[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_forms_differ_where_the_book_says() {
        let [l, a, b] = from_relative([1.0; 3], Lightness::Book);
        assert!((l - (25.0 * 100f64.cbrt() - 16.0)).abs() < 1e-13 && a == 0.0 && b == 0.0);
        assert_eq!(from_relative([0.0; 3], Lightness::Book), [-16.0, 0.0, 0.0]);
        let [l, ..] = from_relative([0.0; 3], Lightness::Cie);
        assert!(l.abs() < 1e-13);
    }

    #[test]
    fn both_forms_invert_below_black_too() {
        for form in [Lightness::Cie, Lightness::Book] {
            for t in [[0.0, 0.0, 0.0], [-0.2, 0.1, 0.004], [0.5, 1.5, 20.0], [KNEE, KNEE, KNEE]] {
                let back = to_relative(from_relative(t, form), form);
                for (a, b) in back.iter().zip(t) {
                    assert!((a - b).abs() < 1e-13, "{form:?} {t:?} {back:?}");
                }
            }
        }
    }
}
