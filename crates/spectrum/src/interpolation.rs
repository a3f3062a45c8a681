//! Between points and beyond them: a curve on other wavelengths.
//!
//! | interpolation | needs | what it is |
//! | --- | --- | --- |
//! | linear (default) | – | straight lines; the book's rule (III.7.1), and that of [`Curve::at`] |
//! | pchip | – | cubic pieces that rise and fall only where the points do (Fritsch and Carlson 1980, slopes of Fritsch and Butland 1984) |
//! | cubic | – | natural cubic spline |
//! | sprague | 6 points at equal steps | fifth degree with continuous second derivative; recommended by the CIE for equal steps (CIE 167:2005; Westland, Ripamonti and Cheung 2012, 4.3) |
//!
//! Linear and pchip stay between their neighbours. The other two can swing below zero beside a narrow peak; a curve
//! without negative points that would do so is refused, with the wavelength, and never clamped. The same holds for
//! linear extrapolation.

use crate::{Curve, CurveError, Outside};
use std::str::FromStr;

/// How a curve runs between its points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// Straight lines.
    #[default]
    Linear,
    /// Cubic pieces without overshoot.
    Pchip,
    /// Natural cubic spline.
    Cubic,
    /// Sprague's fifth-degree pieces, for equal steps.
    Sprague,
}

/// How a curve runs beyond its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extrapolation {
    /// Zero.
    Zero,
    /// The value of the nearest end.
    Hold,
    /// The straight line through the two points nearest to the end.
    Linear,
    /// An error.
    Error,
}

impl From<Outside> for Extrapolation {
    fn from(outside: Outside) -> Self {
        match outside {
            Outside::Zero => Self::Zero,
            Outside::Hold => Self::Hold,
        }
    }
}

impl FromStr for Interpolation {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        match name {
            "linear" => Ok(Self::Linear),
            "pchip" => Ok(Self::Pchip),
            "cubic" => Ok(Self::Cubic),
            "sprague" => Ok(Self::Sprague),
            _ => Err(format!(
                "an interpolation is 'linear', 'pchip', 'cubic' or 'sprague', and {name:?} is none"
            )),
        }
    }
}

impl FromStr for Extrapolation {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        match name {
            "zero" => Ok(Self::Zero),
            "hold" => Ok(Self::Hold),
            "linear" => Ok(Self::Linear),
            "error" => Ok(Self::Error),
            _ => {
                Err(format!("an extrapolation is 'zero', 'hold', 'linear' or 'error', and {name:?} is none"))
            }
        }
    }
}

impl Curve {
    /// The curve through its values at other wavelengths (nm, increasing), with the same rule outside.
    ///
    /// ```
    /// use illuminant_spectrum::{Curve, Extrapolation, Interpolation, Outside};
    /// let curve = Curve::new(vec![400.0, 500.0, 600.0], vec![0.0, 1.0, 0.0], Outside::Hold).unwrap();
    /// let fine = curve.resampled(&[450.0, 500.0], Interpolation::Linear, Extrapolation::Error).unwrap();
    /// assert_eq!(fine.values(), [0.5, 1.0]);
    /// let smooth = curve.resampled(&[450.0, 500.0], Interpolation::Cubic, Extrapolation::Error).unwrap();
    /// assert_eq!(smooth.values(), [0.6875, 1.0]);
    /// ```
    ///
    /// # Errors
    /// [`CurveError::Unknown`] beyond the points with [`Extrapolation::Error`]; [`CurveError::Undershoot`] when no
    /// point is negative and a result would be; [`CurveError::Uneven`] for Sprague on fewer than six points or
    /// unequal steps; and whatever [`Curve::new`] refuses.
    pub fn resampled(
        &self,
        wavelengths_nm: &[f64],
        interpolation: Interpolation,
        extrapolation: Extrapolation,
    ) -> Result<Self, CurveError> {
        let pieces = Pieces::new(self, interpolation)?;
        let (first_nm, last_nm) = self.range_nm();
        let (x, y) = (self.wavelengths_nm(), self.values());
        let n = x.len();
        let positive = y.iter().all(|v| *v >= 0.0);
        let mut values = Vec::with_capacity(wavelengths_nm.len());
        for &wavelength_nm in wavelengths_nm {
            let value = if wavelength_nm >= first_nm && wavelength_nm <= last_nm {
                pieces.at(self, wavelength_nm)
            } else {
                let below = wavelength_nm < first_nm;
                let (end, next) = if below { (0, 1) } else { (n - 1, n - 2) };
                match extrapolation {
                    Extrapolation::Zero => 0.0,
                    Extrapolation::Hold => y[end],
                    Extrapolation::Linear => {
                        y[end] + (y[next] - y[end]) / (x[next] - x[end]) * (wavelength_nm - x[end])
                    }
                    Extrapolation::Error => {
                        return Err(CurveError::Unknown { wavelength_nm, first_nm, last_nm });
                    }
                }
            };
            if positive && value < 0.0 {
                return Err(CurveError::Undershoot { wavelength_nm, value });
            }
            values.push(value);
        }
        Self::new(wavelengths_nm.to_vec(), values, self.outside())
    }
}

/// Polynomial pieces in t = (λ − λᵢ) / (λᵢ₊₁ − λᵢ), lowest power first; none for straight lines.
struct Pieces(Vec<[f64; 6]>);

impl Pieces {
    fn new(curve: &Curve, interpolation: Interpolation) -> Result<Self, CurveError> {
        let (x, y) = (curve.wavelengths_nm(), curve.values());
        Ok(Self(match interpolation {
            Interpolation::Linear => Vec::new(),
            Interpolation::Pchip => hermite(x, y, &monotone_slopes(x, y)),
            Interpolation::Cubic => hermite(x, y, &spline_slopes(x, y)),
            Interpolation::Sprague => sprague(x, y)?,
        }))
    }

    fn at(&self, curve: &Curve, wavelength_nm: f64) -> f64 {
        if self.0.is_empty() {
            return curve.at(wavelength_nm);
        }
        let x = curve.wavelengths_nm();
        let i = x.partition_point(|w| *w <= wavelength_nm).clamp(1, x.len() - 1) - 1;
        if wavelength_nm == x[i + 1] {
            return curve.values()[i + 1];
        }
        let t = (wavelength_nm - x[i]) / (x[i + 1] - x[i]);
        self.0[i].iter().rev().fold(0.0, |sum, c| sum * t + c)
    }
}

/// Cubic pieces with given slopes at the points.
fn hermite(x: &[f64], y: &[f64], slopes: &[f64]) -> Vec<[f64; 6]> {
    (0..x.len() - 1)
        .map(|i| {
            let h = x[i + 1] - x[i];
            let (rise, a, b) = (y[i + 1] - y[i], h * slopes[i], h * slopes[i + 1]);
            [y[i], a, 3.0 * rise - 2.0 * a - b, a + b - 2.0 * rise, 0.0, 0.0]
        })
        .collect()
}

/// Slopes of Fritsch and Butland: a weighted harmonic mean of the two secants, zero at a turning point.
fn monotone_slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let h: Vec<f64> = x.windows(2).map(|w| w[1] - w[0]).collect();
    let secant: Vec<f64> = y.windows(2).zip(&h).map(|(v, h)| (v[1] - v[0]) / h).collect();
    let last = secant.len() - 1;
    if last == 0 {
        return vec![secant[0]; 2];
    }
    // At an end: the parabola through three points, held back where it would turn.
    let end = |h0: f64, h1: f64, s0: f64, s1: f64| {
        let slope = ((2.0 * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
        if slope * s0 <= 0.0 {
            0.0
        } else if s0 * s1 <= 0.0 && slope.abs() > 3.0 * s0.abs() {
            3.0 * s0
        } else {
            slope
        }
    };
    let mut slopes = vec![end(h[0], h[1], secant[0], secant[1])];
    for i in 1..=last {
        let (a, b) = (secant[i - 1], secant[i]);
        let (wa, wb) = (2.0 * h[i] + h[i - 1], h[i] + 2.0 * h[i - 1]);
        slopes.push(if a * b <= 0.0 { 0.0 } else { (wa + wb) / (wa / a + wb / b) });
    }
    slopes.push(end(h[last], h[last - 1], secant[last], secant[last - 1]));
    slopes
}

/// Slopes of the natural spline: continuous second derivative, zero at both ends (Thomas's algorithm).
fn spline_slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let n = x.len();
    let h: Vec<f64> = x.windows(2).map(|w| w[1] - w[0]).collect();
    let secant: Vec<f64> = y.windows(2).zip(&h).map(|(v, h)| (v[1] - v[0]) / h).collect();
    let (mut diagonal, mut upper, mut right) = (vec![2.0; n], vec![1.0; n], vec![0.0; n]);
    right[0] = 3.0 * secant[0];
    for i in 1..n {
        let (lower, d, u, r) = if i == n - 1 {
            (1.0, 2.0, 0.0, 3.0 * secant[n - 2])
        } else {
            let (a, b) = (1.0 / h[i - 1], 1.0 / h[i]);
            (a, 2.0 * (a + b), b, 3.0 * (a * secant[i - 1] + b * secant[i]))
        };
        let m = lower / diagonal[i - 1];
        diagonal[i] = d - m * upper[i - 1];
        upper[i] = u;
        right[i] = r - m * right[i - 1];
    }
    let mut slopes = vec![0.0; n];
    slopes[n - 1] = right[n - 1] / diagonal[n - 1];
    for i in (0..n - 1).rev() {
        slopes[i] = (right[i] - upper[i] * slopes[i + 1]) / diagonal[i];
    }
    slopes
}

/// Sprague's pieces; two points are made up beyond each end from the six nearest (CIE 167:2005).
fn sprague(x: &[f64], y: &[f64]) -> Result<Vec<[f64; 6]>, CurveError> {
    const FIRST: [f64; 6] = [884.0, -1960.0, 3033.0, -2648.0, 1080.0, -180.0];
    const SECOND: [f64; 6] = [508.0, -540.0, 488.0, -367.0, 144.0, -24.0];
    let n = x.len();
    let step = (x[n - 1] - x[0]) / (n - 1) as f64;
    let even = x.windows(2).all(|w| (w[1] - w[0] - step).abs() <= 1e-6 * step);
    if n < 6 || !even {
        return Err(CurveError::Uneven);
    }
    let made = |weights: &[f64; 6], ends: &mut dyn Iterator<Item = &f64>| {
        weights.iter().zip(ends).map(|(w, v)| w * v).sum::<f64>() / 209.0
    };
    let mut r = vec![made(&FIRST, &mut y.iter()), made(&SECOND, &mut y.iter())];
    r.extend_from_slice(y);
    r.extend([made(&SECOND, &mut y.iter().rev()), made(&FIRST, &mut y.iter().rev())]);
    Ok((0..n - 1)
        .map(|i| {
            let [a, b, c, d, e, f] = [r[i], r[i + 1], r[i + 2], r[i + 3], r[i + 4], r[i + 5]];
            [
                c,
                (2.0 * a - 16.0 * b + 16.0 * d - 2.0 * e) / 24.0,
                (-a + 16.0 * b - 30.0 * c + 16.0 * d - e) / 24.0,
                (-9.0 * a + 39.0 * b - 70.0 * c + 66.0 * d - 33.0 * e + 7.0 * f) / 24.0,
                (13.0 * a - 64.0 * b + 126.0 * c - 124.0 * d + 61.0 * e - 12.0 * f) / 24.0,
                (-5.0 * a + 25.0 * b - 50.0 * c + 50.0 * d - 25.0 * e + 5.0 * f) / 24.0,
            ]
        })
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const ALL: [Interpolation; 4] =
        [Interpolation::Linear, Interpolation::Pchip, Interpolation::Cubic, Interpolation::Sprague];

    fn evenly(values: Vec<f64>) -> Curve {
        let wavelengths = (0..values.len()).map(|i| 400.0 + 10.0 * i as f64).collect();
        Curve::new(wavelengths, values, Outside::Zero).unwrap()
    }

    #[test]
    fn straight_lines_stay_straight_and_points_stay_where_they_are() {
        let line = evenly((0..9).map(|i| 2.0 + 0.3 * f64::from(i)).collect());
        let bent = evenly(vec![3.0, 4.0, 6.0, 5.0, 5.0, 7.0, 9.0, 8.0]);
        for interpolation in ALL {
            let fine: Vec<f64> = (0..=80).map(|i| 400.0 + f64::from(i)).collect();
            let same = line.resampled(&fine, interpolation, Extrapolation::Error).unwrap();
            assert!(fine.iter().all(|w| (same.at(*w) - line.at(*w)).abs() < 1e-12), "{interpolation:?}");
            let points = bent.resampled(bent.wavelengths_nm(), interpolation, Extrapolation::Error).unwrap();
            assert!(points.values().iter().zip(bent.values()).all(|(a, b)| (a - b).abs() < 1e-12));
        }
    }

    #[test]
    fn sprague_is_exact_for_a_quartic_inside() {
        let quartic = |w: f64| ((w - 400.0) / 50.0 - 1.0).powi(4) + 1.0;
        let curve = evenly((0..12).map(|i| quartic(400.0 + 10.0 * f64::from(i))).collect());
        for w in [425.0, 433.3, 461.0, 479.0] {
            let found = curve.resampled(&[w, w + 0.5], Interpolation::Sprague, Extrapolation::Error).unwrap();
            assert!((found.values()[0] - quartic(w)).abs() < 1e-9, "{w}");
        }
    }

    #[test]
    fn nothing_turns_negative_by_itself() {
        let line = evenly(vec![0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
        let fine: Vec<f64> = (0..=70).map(|i| 400.0 + f64::from(i)).collect();
        for interpolation in [Interpolation::Cubic, Interpolation::Sprague] {
            let refused = line.resampled(&fine, interpolation, Extrapolation::Error);
            assert!(
                matches!(refused, Err(CurveError::Undershoot { value, .. }) if value < 0.0),
                "{refused:?}"
            );
        }
        assert!(line.resampled(&fine, Interpolation::Pchip, Extrapolation::Error).is_ok());
        let falling = evenly(vec![3.0, 1.0]);
        let beyond = falling.resampled(&[400.0, 420.0], Interpolation::Linear, Extrapolation::Linear);
        assert!(matches!(beyond, Err(CurveError::Undershoot { .. })));
        let just = falling.resampled(&[412.0, 414.0], Interpolation::Linear, Extrapolation::Linear).unwrap();
        assert!((just.values()[0] - 0.6).abs() < 1e-12 && (just.values()[1] - 0.2).abs() < 1e-12);
    }

    #[test]
    fn what_is_refused() {
        let curve = evenly(vec![1.0, 2.0, 3.0]);
        let refused = |i, e| curve.resampled(&[390.0, 400.0], i, e).unwrap_err();
        assert_eq!(refused(Interpolation::Sprague, Extrapolation::Hold), CurveError::Uneven);
        assert!(matches!(
            refused(Interpolation::Linear, Extrapolation::Error),
            CurveError::Unknown { wavelength_nm: 390.0, .. }
        ));
        assert!("spline".parse::<Interpolation>().is_err() && "nearest".parse::<Extrapolation>().is_err());
    }

    proptest! {
        #[test]
        fn pchip_stays_between_its_neighbours(values in prop::collection::vec(0.0..5.0f64, 2..20), t in 0.0..1.0f64) {
            let curve = evenly(values.clone());
            let (first, last) = curve.range_nm();
            let w = first + t * (last - first);
            let i = (((w - first) / 10.0) as usize).min(values.len() - 2);
            let v = Pieces::new(&curve, Interpolation::Pchip).unwrap().at(&curve, w);
            let (low, high) = (values[i].min(values[i + 1]), values[i].max(values[i + 1]));
            prop_assert!(v >= low - 1e-12 && v <= high + 1e-12);
        }
    }
}
