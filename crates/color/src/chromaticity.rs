//! Chromaticity: what is left of three values when their size is taken away.
//!
//! - x = X/(X + Y + Z), y = Y/(X + Y + Z) (CIE 1931), kept with Y as xyY;
//! - u′ = 4X/(X + 15Y + 3Z), v′ = 9Y/(X + 15Y + 3Z) (CIE 1976), kept with Y as u′v′Y;
//! - the projection onto the plane of sum 1, for any three primaries (book figure 3.6).
//!
//! Black has no chromaticity: x and y, u′ and v′ are 0 for it, and back it is black again.

use crate::Real;

/// x, y and Y of XYZ.
///
/// ```
/// let [x, y, luminance] = illuminant_color::xyz_to_xyy([0.5, 1.0, 0.5]);
/// assert_eq!([x, y, luminance], [0.25, 0.5, 1.0]);
/// ```
#[must_use]
#[inline(always)]
pub fn xyz_to_xyy<T: Real>([x, y, z]: [T; 3]) -> [T; 3] {
    let inverse = inverse_or_zero(x + y + z);
    [x * inverse, y * inverse, y]
}

/// XYZ of x, y and Y; black where y is 0.
#[must_use]
#[inline(always)]
pub fn xyy_to_xyz<T: Real>([x, y, luminance]: [T; 3]) -> [T; 3] {
    let scale = luminance * inverse_or_zero(y);
    [x * scale, luminance, (T::of(1.0) - x - y) * scale]
}

/// u′, v′ and Y of XYZ.
#[must_use]
#[inline(always)]
pub fn xyz_to_uvy<T: Real>([x, y, z]: [T; 3]) -> [T; 3] {
    let inverse = inverse_or_zero(z.mul_add(T::of(3.0), y.mul_add(T::of(15.0), x)));
    [x * T::of(4.0) * inverse, y * T::of(9.0) * inverse, y]
}

/// XYZ of u′, v′ and Y; black where v′ is 0.
#[must_use]
#[inline(always)]
pub fn uvy_to_xyz<T: Real>([u, v, luminance]: [T; 3]) -> [T; 3] {
    let share = luminance * T::of(0.25) * inverse_or_zero(v);
    let z = v.mul_add(T::of(-20.0), u.mul_add(T::of(-3.0), T::of(12.0)));
    [share * u * T::of(9.0), luminance, share * z]
}

/// Three amounts divided by their sum: where the vector meets the plane L + M + H = 1 (book figure 3.6).
///
/// A sum of 0 gives infinities, or NaN for black: there is no such point.
#[must_use]
#[inline(always)]
pub fn project<T: Real>([l, m, h]: [T; 3]) -> [T; 3] {
    let sum = l + m + h;
    [l / sum, m / sum, h / sum]
}

#[inline(always)]
fn inverse_or_zero<T: Real>(value: T) -> T {
    let inverse = T::of(1.0) / value;
    T::select(value == T::of(0.0), T::of(0.0), inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_invert_and_black_stays_black() {
        for xyz in [[0.2, 0.1, 0.7], [12.0, 30.0, 1.0], [0.0, 0.0, 0.0]] {
            for back in [xyy_to_xyz(xyz_to_xyy(xyz)), uvy_to_xyz(xyz_to_uvy(xyz))] {
                for (a, b) in back.into_iter().zip(xyz) {
                    assert!((a - b).abs() <= 1e-13 * b.abs(), "{xyz:?} {back:?}");
                }
            }
        }
    }

    #[test]
    fn a_projection_sums_to_one() {
        let [l, m, h] = project([3.0, -0.5, 1.5]);
        assert!((l + m + h - 1.0f64).abs() < 1e-15 && (l - 0.75).abs() < 1e-15);
    }
}
