//! Arithmetic on curves: sum, difference, product, scale to a point, and a part of the axis.
//!
//! The book's code adds, multiplies and scales arrays at 1 nm (III.7.2). Here the result has the points of both
//! curves, so that a sum is exact at every wavelength; where a product bends between its points (both factors slope)
//! it gets one at every whole nm, so that its 1 nm sums are those of the two factors multiplied wavelength by
//! wavelength. Where a curve stops and is zero beyond, the step is kept: it lies between two neighbouring floating
//! point numbers. So a lamp has the same Y by whichever route it is computed.
//!
//! | outside | sum, difference | product |
//! | --- | --- | --- |
//! | both zero | the union of the ranges, zero outside | what the ranges have in common, zero outside |
//! | one zero, one hold | both ranges, hold outside | the range of the one that is zero outside, zero outside |
//! | both hold | both ranges, hold outside | both ranges, hold outside |

use crate::{Curve, CurveError, Outside};

/// Beyond so many points a product is no longer refined.
const MOST_POINTS: usize = 2_000_000;

impl Curve {
    /// The curve plus another.
    ///
    /// ```
    /// use illuminant_spectrum::{Curve, Outside};
    /// let a = Curve::new(vec![400.0, 500.0], vec![1.0, 1.0], Outside::Zero).unwrap();
    /// let b = Curve::new(vec![450.0, 600.0], vec![2.0, 2.0], Outside::Zero).unwrap();
    /// let sum = a.sum(&b).unwrap();
    /// assert_eq!((sum.at(420.0), sum.at(500.0), sum.at(501.0), sum.at(601.0)), (1.0, 3.0, 2.0, 0.0));
    /// ```
    ///
    /// # Errors
    /// [`CurveError::NotFinite`] when a value overflows.
    pub fn sum(&self, other: &Self) -> Result<Self, CurveError> {
        self.combined(other, |a, b| a + b)
    }

    /// The curve minus another, which may be negative.
    ///
    /// # Errors
    /// As for [`Self::sum`].
    pub fn difference(&self, other: &Self) -> Result<Self, CurveError> {
        self.combined(other, |a, b| a - b)
    }

    /// The curve times another.
    ///
    /// ```
    /// use illuminant_spectrum::{Curve, Outside};
    /// let lamp = Curve::new(vec![400.0, 700.0], vec![1.0, 4.0], Outside::Zero).unwrap();
    /// let paint = Curve::new(vec![450.0, 600.0], vec![0.2, 0.8], Outside::Hold).unwrap();
    /// let light = lamp.product(&paint).unwrap();
    /// assert!((light.at(500.0) - 2.0 * 0.4).abs() < 1e-12);
    /// assert_eq!((light.outside(), light.at(701.0)), (Outside::Zero, 0.0));
    /// ```
    ///
    /// # Errors
    /// [`CurveError::Disjoint`] when both are zero outside their ranges and these share less than two points;
    /// [`CurveError::NotFinite`] when a value overflows.
    pub fn product(&self, other: &Self) -> Result<Self, CurveError> {
        let (mut first, mut last) = (0.0, f64::INFINITY);
        for curve in [self, other].into_iter().filter(|curve| curve.outside() == Outside::Zero) {
            first = f64::max(first, curve.range_nm().0);
            last = f64::min(last, curve.range_nm().1);
        }
        if !(first < last) {
            return Err(CurveError::Disjoint);
        }
        let outside = if last.is_finite() { Outside::Zero } else { Outside::Hold };
        let mut points: Vec<f64> = [self, other].iter().flat_map(|c| c.wavelengths_nm()).copied().collect();
        points.extend([first, last].into_iter().filter(|w| *w > 0.0 && w.is_finite()));
        points.retain(|w| (first..=last).contains(w));
        points.sort_by(f64::total_cmp);
        points.dedup();
        let slopes = |curve: &Self, a: f64, b: f64| curve.at(a) != curve.at(b);
        let mut whole = Vec::new();
        for pair in points.windows(2) {
            if slopes(self, pair[0], pair[1]) && slopes(other, pair[0], pair[1]) {
                let (low, high) = (pair[0].floor() + 1.0, pair[1].ceil() - 1.0);
                if (high - low).max(0.0) + (whole.len() as f64) < MOST_POINTS as f64 {
                    whole.extend((0..).map(|i| low + f64::from(i)).take_while(|w| *w <= high));
                }
            }
        }
        points.extend(whole);
        points.sort_by(f64::total_cmp);
        let values = points.iter().map(|w| self.at(*w) * other.at(*w)).collect();
        Self::new(points, values, outside)
    }

    /// The curve times the factor that makes it `value` at a wavelength in nm: the book's lamps are 1 at 560 nm.
    ///
    /// ```
    /// let d65 = illuminant_spectrum::daylight(6504.0).unwrap();
    /// assert_eq!(d65.normalised(560.0, 100.0).unwrap().at(560.0), 100.0);
    /// ```
    ///
    /// # Errors
    /// [`CurveError::ZeroAt`] when the curve is zero there, or so small that the result is not finite.
    pub fn normalised(&self, wavelength_nm: f64, value: f64) -> Result<Self, CurveError> {
        let factor = value / self.at(wavelength_nm);
        if !factor.is_finite() {
            return Err(CurveError::ZeroAt { wavelength_nm });
        }
        Self::new(
            self.wavelengths_nm().to_vec(),
            self.values().iter().map(|v| v * factor).collect(),
            self.outside(),
        )
    }

    /// The part from one wavelength to another (nm); the rule outside stays. A curve that holds its ends has points at
    /// both; one that is zero outside stays within its own range, so that no ramp leads down from its end.
    ///
    /// # Errors
    /// [`CurveError::Disjoint`] when nothing of a curve that is zero outside is left; [`CurveError`] when the
    /// wavelengths do not increase or are not positive.
    pub fn between(&self, first_nm: f64, last_nm: f64) -> Result<Self, CurveError> {
        if !(first_nm > 0.0 && first_nm < last_nm && last_nm.is_finite()) {
            return Err(CurveError::Band { first_nm, last_nm });
        }
        let (mut first, mut last) = (first_nm, last_nm);
        if self.outside() == Outside::Zero {
            first = first.max(self.range_nm().0);
            last = last.min(self.range_nm().1);
            if !(first < last) {
                return Err(CurveError::Disjoint);
            }
        }
        let inside = self.wavelengths_nm().iter().copied().filter(|w| *w > first && *w < last);
        let points: Vec<f64> = std::iter::once(first).chain(inside).chain([last]).collect();
        let values = points.iter().map(|w| self.at(*w)).collect();
        Self::new(points, values, self.outside())
    }

    /// First and last wavelength of its points, nm.
    #[must_use]
    pub fn range_nm(&self) -> (f64, f64) {
        let points = self.wavelengths_nm();
        (points[0], points[points.len() - 1])
    }

    /// A linear function of two curves, on the points of both and on either side of each step.
    fn combined(&self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Result<Self, CurveError> {
        let both = [self, other];
        let first = both.map(|c| c.range_nm().0).into_iter().fold(f64::INFINITY, f64::min);
        let last = both.map(|c| c.range_nm().1).into_iter().fold(0.0, f64::max);
        let outside =
            if both.iter().all(|c| c.outside() == Outside::Zero) { Outside::Zero } else { Outside::Hold };
        let mut points: Vec<f64> = both.iter().flat_map(|c| c.wavelengths_nm()).copied().collect();
        for curve in both.iter().filter(|c| c.outside() == Outside::Zero) {
            let (begin, end) = curve.range_nm();
            // Wavelengths are positive, so the neighbouring numbers have neighbouring bits.
            let beside = [f64::from_bits(begin.to_bits() - 1), f64::from_bits(end.to_bits() + 1)];
            // Beyond the ends of a sum that is zero outside, the rule makes the step.
            points.extend(
                beside.into_iter().filter(|w| outside == Outside::Hold || (first..=last).contains(w)),
            );
        }
        points.sort_by(f64::total_cmp);
        points.dedup();
        let values = points.iter().map(|w| f(self.at(*w), other.at(*w))).collect();
        Self::new(points, values, outside)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Observer, SpectralRange};
    use proptest::prelude::*;

    fn curves() -> impl Strategy<Value = Curve> {
        (300.0..500.0f64, prop::collection::vec((1.0..60.0f64, 0.0..5.0f64), 2..12), prop::bool::ANY)
            .prop_map(|(start, steps, zero)| {
                let mut wavelength = start;
                let (wavelengths, values) = steps
                    .iter()
                    .map(|(step, value)| {
                        wavelength += step;
                        (wavelength, *value)
                    })
                    .unzip();
                let outside = if zero { Outside::Zero } else { Outside::Hold };
                Curve::new(wavelengths, values, outside).unwrap()
            })
    }

    proptest! {
        #[test]
        fn a_sum_is_the_sum_at_every_wavelength(a in curves(), b in curves(), w in 200.0..1400.0f64) {
            prop_assert!((a.sum(&b).unwrap().at(w) - (a.at(w) + b.at(w))).abs() < 1e-9);
            prop_assert!((a.difference(&b).unwrap().at(w) - (a.at(w) - b.at(w))).abs() < 1e-9);
        }

        #[test]
        fn a_product_is_the_product_at_every_whole_nm(a in curves(), b in curves(), w in 200..1400i32) {
            let w = f64::from(w);
            match a.product(&b) {
                Ok(product) => prop_assert!((product.at(w) - a.at(w) * b.at(w)).abs() < 1e-9),
                Err(error) => {
                    prop_assert_eq!(error, CurveError::Disjoint);
                    prop_assert!(a.at(w) * b.at(w) == 0.0);
                }
            }
        }

        #[test]
        fn a_lamp_has_one_luminance_by_every_route(lamp in curves(), paint in curves()) {
            let (observer, range) = (Observer::cie_1931_2deg(), SpectralRange::default());
            let direct = observer.xyz_of(range, |w| lamp.at(w) * paint.at(w))[1];
            if let Ok(product) = lamp.product(&paint) {
                let route = observer.luminance(&product, range);
                prop_assert!((route - direct).abs() <= 1e-9 * (1.0 + direct));
            }
            let twice = observer.luminance(&lamp.sum(&lamp).unwrap(), range);
            let once = observer.luminance(&lamp, range);
            prop_assert!((twice - 2.0 * once).abs() <= 1e-9 * (1.0 + once));
            prop_assert!((observer.luminance(&lamp.scaled(2.0), range) - twice).abs() <= 1e-9 * (1.0 + once));
        }
    }

    #[test]
    fn a_flat_factor_adds_no_points() {
        let d65 = crate::daylight(6504.0).unwrap();
        assert_eq!(d65.product(&Curve::constant(0.5)).unwrap(), d65.scaled(0.5));
    }

    #[test]
    fn what_cannot_be_said() {
        let a = Curve::new(vec![400.0, 500.0], vec![1.0, 1.0], Outside::Zero).unwrap();
        let b = Curve::new(vec![500.0, 600.0], vec![1.0, 1.0], Outside::Zero).unwrap();
        assert_eq!(a.product(&b), Err(CurveError::Disjoint));
        assert_eq!(a.normalised(560.0, 1.0), Err(CurveError::ZeroAt { wavelength_nm: 560.0 }));
        assert!(a.between(500.0, 400.0).is_err());
        assert_eq!(a.between(600.0, 700.0), Err(CurveError::Disjoint));
        let part = a.between(450.0, 700.0).unwrap();
        assert_eq!((part.range_nm(), part.at(450.0), part.at(449.0)), ((450.0, 500.0), 1.0, 0.0));
        let held = Curve::new(vec![400.0, 500.0], vec![1.0, 2.0], Outside::Hold).unwrap();
        assert_eq!(held.between(450.0, 700.0).unwrap().values(), [1.5, 2.0, 2.0]);
    }
}
