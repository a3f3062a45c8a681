//! A quantity as a function of wavelength: points joined by straight lines.

use crate::SpectralRange;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// What a curve is worth outside its own points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Outside {
    /// Zero: right for lamps, whose tables end where nothing is emitted.
    #[default]
    Zero,
    /// The value of the nearest end: right for reflectances and for n and k.
    Hold,
}

/// Why a list of points is no curve.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CurveError {
    /// The two lists differ in length.
    #[error("{wavelengths} wavelengths but {values} values; there must be as many of one as of the other")]
    Lengths {
        /// How many wavelengths.
        wavelengths: usize,
        /// How many values.
        values: usize,
    },
    /// A curve needs two points.
    #[error("a spectrum needs at least two points, and this one has {0}")]
    TooShort(usize),
    /// Wavelengths must increase.
    #[error("wavelengths must increase, and at point {index} {wavelength_nm} nm follows {previous_nm} nm")]
    Order {
        /// Index of the first offending point.
        index: usize,
        /// The wavelength there, nm.
        wavelength_nm: f64,
        /// The wavelength before it, nm.
        previous_nm: f64,
    },
    /// A wavelength or value is NaN, infinite, or the wavelength is not positive.
    #[error("point {index} ({wavelength_nm} nm, {value}) is not a positive wavelength with a finite value")]
    NotFinite {
        /// Index of the first offending point.
        index: usize,
        /// The wavelength there, nm.
        wavelength_nm: f64,
        /// The value there.
        value: f64,
    },
    /// Two ranges that share nothing, of curves that are zero outside or of such a curve and a part asked for.
    #[error("the two ranges do not overlap, so the result would be zero everywhere")]
    Disjoint,
    /// A curve cannot be brought to a value where it is zero.
    #[error("the spectrum is zero at {wavelength_nm} nm; choose a wavelength where it is not")]
    ZeroAt {
        /// The wavelength, nm.
        wavelength_nm: f64,
    },
    /// A wavelength beyond the points, where that is an error.
    #[error("{wavelength_nm} nm lies outside {first_nm} to {last_nm} nm, where the spectrum is known")]
    Unknown {
        /// The wavelength asked for, nm.
        wavelength_nm: f64,
        /// The first known, nm.
        first_nm: f64,
        /// The last known, nm.
        last_nm: f64,
    },
    /// An interpolated or extrapolated value below zero where no point is.
    #[error(
        "between or beyond its points the spectrum would become {value} at {wavelength_nm} nm; choose linear or pchip \
         interpolation and no linear extrapolation, which keep it from turning negative"
    )]
    Undershoot {
        /// The wavelength, nm.
        wavelength_nm: f64,
        /// The value there.
        value: f64,
    },
    /// Sprague's interpolation of unequal steps.
    #[error("sprague interpolation needs at least six points at equal steps; choose linear, pchip or cubic")]
    Uneven,
    /// A pair of wavelengths that is no band.
    #[error(
        "a band runs from one positive wavelength to a larger one, and {first_nm} to {last_nm} nm does not"
    )]
    Band {
        /// The first, nm.
        first_nm: f64,
        /// The last, nm.
        last_nm: f64,
    },
}

/// A curve on wavelength, linear between its points.
///
/// ```
/// use illuminant_spectrum::{Curve, Outside};
/// let curve = Curve::new(vec![400.0, 500.0], vec![0.0, 1.0], Outside::Hold).unwrap();
/// assert_eq!(curve.at(450.0), 0.5);
/// assert_eq!(curve.at(600.0), 1.0); // the last value is held
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    wavelengths_nm: Vec<f64>,
    values: Vec<f64>,
    outside: Outside,
}

impl Curve {
    /// A curve through the points (`wavelengths_nm`, `values`).
    ///
    /// # Errors
    /// [`CurveError`] when the points are fewer than two, not finite, or not in increasing order of wavelength.
    pub fn new(wavelengths_nm: Vec<f64>, values: Vec<f64>, outside: Outside) -> Result<Self, CurveError> {
        if wavelengths_nm.len() != values.len() {
            return Err(CurveError::Lengths { wavelengths: wavelengths_nm.len(), values: values.len() });
        }
        if wavelengths_nm.len() < 2 {
            return Err(CurveError::TooShort(wavelengths_nm.len()));
        }
        for (index, (&wavelength_nm, &value)) in wavelengths_nm.iter().zip(&values).enumerate() {
            if !(wavelength_nm.is_finite() && value.is_finite() && wavelength_nm > 0.0) {
                return Err(CurveError::NotFinite { index, wavelength_nm, value });
            }
            if index > 0 && wavelength_nm <= wavelengths_nm[index - 1] {
                let previous_nm = wavelengths_nm[index - 1];
                return Err(CurveError::Order { index, wavelength_nm, previous_nm });
            }
        }
        Ok(Self { wavelengths_nm, values, outside })
    }

    /// The same value at every wavelength.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        Self { wavelengths_nm: vec![1.0, 1e6], values: vec![value; 2], outside: Outside::Hold }
    }

    /// The curve that takes `values` at the wavelengths of `range`, 1 nm apart.
    ///
    /// # Panics
    /// When there are not as many values as wavelengths: a slip of the programmer, never of the data.
    #[must_use]
    pub fn tabulated(range: SpectralRange, values: Vec<f64>, outside: Outside) -> Self {
        assert_eq!(range.len(), values.len(), "one value for each nm of the range");
        Self { wavelengths_nm: range.wavelengths().collect(), values, outside }
    }

    /// The value at a wavelength in nm.
    #[must_use]
    pub fn at(&self, wavelength_nm: f64) -> f64 {
        let (first, last) = (self.wavelengths_nm[0], self.wavelengths_nm[self.wavelengths_nm.len() - 1]);
        if wavelength_nm < first || wavelength_nm > last {
            return match self.outside {
                Outside::Zero => 0.0,
                Outside::Hold if wavelength_nm < first => self.values[0],
                Outside::Hold => self.values[self.values.len() - 1],
            };
        }
        let upper = self.wavelengths_nm.partition_point(|&w| w <= wavelength_nm).min(self.values.len() - 1);
        let (a, b) = (self.wavelengths_nm[upper - 1], self.wavelengths_nm[upper]);
        let t = (wavelength_nm - a) / (b - a);
        self.values[upper - 1] + t * (self.values[upper] - self.values[upper - 1])
    }

    /// The values at each nm of `range`.
    #[must_use]
    pub fn tabulate(&self, range: SpectralRange) -> Vec<f64> {
        range.wavelengths().map(|w| self.at(w)).collect()
    }

    /// The sum of the values at each nm of `range`: the area under the curve, unit × nm.
    #[must_use]
    pub fn area(&self, range: SpectralRange) -> f64 {
        range.wavelengths().map(|w| self.at(w)).sum()
    }

    /// The curve times a number.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { values: self.values.iter().map(|v| v * factor).collect(), ..self.clone() }
    }

    /// The wavelengths of its points, nm.
    #[must_use]
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// The values at its points.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The rule outside its points.
    #[must_use]
    pub fn outside(&self) -> Outside {
        self.outside
    }

    /// The largest and the smallest value over a range.
    #[must_use]
    pub fn extent(&self, range: SpectralRange) -> (f64, f64) {
        range
            .wavelengths()
            .map(|w| self.at(w))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn refuses_what_is_no_curve() {
        let curve = |w: &[f64], v: &[f64]| Curve::new(w.to_vec(), v.to_vec(), Outside::Zero);
        assert_eq!(curve(&[500.0], &[1.0]), Err(CurveError::TooShort(1)));
        assert!(matches!(curve(&[500.0, 400.0], &[1.0, 1.0]), Err(CurveError::Order { index: 1, .. })));
        assert!(matches!(curve(&[500.0, 500.0], &[1.0, 1.0]), Err(CurveError::Order { index: 1, .. })));
        assert!(matches!(
            curve(&[400.0, 500.0], &[1.0, f64::NAN]),
            Err(CurveError::NotFinite { index: 1, .. })
        ));
        assert!(matches!(curve(&[400.0, 500.0], &[1.0]), Err(CurveError::Lengths { .. })));
    }

    #[test]
    fn outside_its_points_the_stated_rule_holds() {
        let zero = Curve::new(vec![400.0, 500.0], vec![2.0, 3.0], Outside::Zero).unwrap();
        assert_eq!((zero.at(399.9), zero.at(400.0), zero.at(500.0), zero.at(500.1)), (0.0, 2.0, 3.0, 0.0));
        let hold = Curve::new(vec![400.0, 500.0], vec![2.0, 3.0], Outside::Hold).unwrap();
        assert_eq!((hold.at(300.0), hold.at(900.0)), (2.0, 3.0));
    }

    proptest! {
        #[test]
        fn interpolation_stays_between_its_neighbours(values in prop::collection::vec(-5.0..5.0f64, 2..20), t in 0.0..1.0f64) {
            let wavelengths: Vec<f64> = (0..values.len()).map(|i| 400.0 + 7.0 * i as f64).collect();
            let i = ((values.len() - 1) as f64 * t) as usize;
            let curve = Curve::new(wavelengths.clone(), values.clone(), Outside::Hold).unwrap();
            let v = curve.at(wavelengths[i] + 7.0 * t);
            let all = values.iter().fold((f64::MAX, f64::MIN), |(a, b), &x| (a.min(x), b.max(x)));
            prop_assert!(v >= all.0 - 1e-12 && v <= all.1 + 1e-12);
            prop_assert_eq!(curve.at(wavelengths[i]), values[i]);
        }
    }
}
