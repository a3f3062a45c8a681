//! Correlated colour temperature.
//!
//! The temperature of the blackbody whose chromaticity lies nearest to that of a light in the CIE 1960 diagram,
//! u = 4X/(X + 15Y + 3Z), v = 6Y/(X + 15Y + 3Z) (CIE 15:2018, 9.5), and how far away it lies: Duv, positive above the
//! locus, on the green side (ANSI C78.377; Ohno 2013). Tables of the locus (Robertson 1968) and fits to it are not
//! used: the nearest point is found on Planck's law itself, summed at 1 nm, where the line to the light stands upright
//! on the locus. So the error is that of rounding.

use illuminant_spectrum::{Observer, SECOND_RADIATION_CONSTANT, planck};
use thiserror::Error;

/// A correlated colour temperature and the distance from the locus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorTemperature {
    /// Temperature of the nearest blackbody, K.
    pub cct_k: f64,
    /// Distance from the locus of blackbodies in (u, v) of 1960, positive above it.
    pub duv: f64,
}

/// Why a chromaticity has no correlated colour temperature.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum TemperatureError {
    /// No chromaticity of light.
    #[error("a chromaticity has y above 0 and finite x and y, and ({0}, {1}) has not")]
    NoChromaticity(f64, f64),
    /// The nearest point lies at an end of the range.
    #[error("the light is redder than a blackbody of 500 K or bluer than one of 100,000 K")]
    OutOfRange,
    /// Too far from the locus.
    #[error(
        "the light is too far from any blackbody to have a colour temperature: Duv is {0:.4}, and the CIE draws the \
         line at 0.05"
    )]
    TooFar(f64),
}

/// Reciprocal temperatures between which the locus is searched, 1/MK.
const MIRED: [f64; 2] = [10.0, 2000.0];
const STEPS: usize = 200;

/// The correlated colour temperature of a chromaticity (x, y), between 500 and 100,000 K.
///
/// ```
/// use illuminant_color::correlated_color_temperature;
/// use illuminant_spectrum::Observer;
/// let d65 = correlated_color_temperature([0.31272, 0.32903], Observer::cie_1931_2deg()).unwrap();
/// assert!((d65.cct_k - 6503.0).abs() < 2.0 && (d65.duv - 0.0032).abs() < 1e-4);
/// ```
///
/// # Errors
/// [`TemperatureError`]: no chromaticity, out of range, or |Duv| above 0.05 (CIE 15:2018, 9.5).
pub fn correlated_color_temperature(
    xy: [f64; 2],
    observer: &Observer,
) -> Result<ColorTemperature, TemperatureError> {
    let [x, y] = xy;
    if !(y > 0.0 && y.is_finite() && x.is_finite()) {
        return Err(TemperatureError::NoChromaticity(x, y));
    }
    let light = uv_1960([x, y, 1.0 - x - y]);
    let locus = Locus::new(observer);
    let mired = |i: usize| MIRED[0] + (MIRED[1] - MIRED[0]) * i as f64 / STEPS as f64;
    let distance = |uv: [f64; 2]| (uv[0] - light[0]).hypot(uv[1] - light[1]);
    let distances: Vec<f64> = (0..=STEPS).map(|i| distance(locus.at(1e6 / mired(i)).0)).collect();
    let nearest = (0..=STEPS).min_by(|a, b| distances[*a].total_cmp(&distances[*b])).unwrap_or(0);
    // At the nearest point the locus runs at right angles to the line that leads to the light.
    let along = |mired: f64| {
        let (uv, slope) = locus.at(1e6 / mired);
        (light[0] - uv[0]) * slope[0] + (light[1] - uv[1]) * slope[1]
    };
    let (mut low, mut high) = (mired(nearest.saturating_sub(1)), mired((nearest + 1).min(STEPS)));
    // A larger reciprocal temperature is a lower temperature, hence the signs.
    if !(along(low) <= 0.0 && along(high) >= 0.0) {
        return Err(TemperatureError::OutOfRange);
    }
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if along(middle) <= 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let cct_k = 1e6 / f64::midpoint(low, high);
    let (uv, _) = locus.at(cct_k);
    let duv = distance(uv).copysign(light[1] - uv[1]);
    if duv.abs() > 0.05 {
        return Err(TemperatureError::TooFar(duv));
    }
    Ok(ColorTemperature { cct_k, duv })
}

/// (u, v) of the CIE 1960 diagram.
pub(crate) fn uv_1960([x, y, z]: [f64; 3]) -> [f64; 2] {
    let sum = x + 15.0 * y + 3.0 * z;
    [4.0 * x / sum, 6.0 * y / sum]
}

/// The chromaticities of blackbodies: the matching functions at each nm of their table.
struct Locus(Vec<(f64, [f64; 3])>);

impl Locus {
    fn new(observer: &Observer) -> Self {
        let (first, last) = observer.matching[1].range_nm();
        let nm = (first.ceil() as u32)..=(last.floor() as u32);
        Self(nm.map(f64::from).map(|w| (w, [0, 1, 2].map(|i| observer.matching[i].at(w)))).collect())
    }

    /// (u, v) at a temperature, and its derivative with respect to it.
    fn at(&self, temperature_k: f64) -> ([f64; 2], [f64; 2]) {
        let (mut xyz, mut slope) = ([0.0; 3], [0.0; 3]);
        for (w, matching) in &self.0 {
            let radiance = planck(*w, temperature_k);
            // dL/dT = L · (x/T) · eˣ/(eˣ − 1) with x = c₂/λT.
            let x = SECOND_RADIATION_CONSTANT / (w * temperature_k);
            let change = radiance * x / temperature_k / -(-x).exp_m1();
            for i in 0..3 {
                xyz[i] += radiance * matching[i];
                slope[i] += change * matching[i];
            }
        }
        let weigh = |[x, y, z]: [f64; 3]| x + 15.0 * y + 3.0 * z;
        let (sum, growth) = (weigh(xyz), weigh(slope));
        let uv = uv_1960(xyz);
        let derivative = [(4.0 * slope[0] - uv[0] * growth) / sum, (6.0 * slope[1] - uv[1] * growth) / sum];
        (uv, derivative)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use illuminant_spectrum::SpectralRange;

    fn blackbody(temperature_k: f64, observer: &Observer) -> [f64; 2] {
        let xyz = observer.xyz_of(SpectralRange { min_nm: 360, max_nm: 830 }, |w| planck(w, temperature_k));
        let sum: f64 = xyz.iter().sum();
        [xyz[0] / sum, xyz[1] / sum]
    }

    #[test]
    fn blackbodies_have_their_own_temperature() {
        for observer in [Observer::cie_1931_2deg(), Observer::cie_1964_10deg()] {
            for t in [600.0, 1000.0, 1800.0, 2856.0, 4000.0, 6500.0, 10_000.0, 25_000.0, 80_000.0] {
                let found = correlated_color_temperature(blackbody(t, observer), observer).unwrap();
                assert!((found.cct_k / t - 1.0).abs() < 1e-6 && found.duv.abs() < 1e-9, "{t}: {found:?}");
            }
        }
    }

    #[test]
    fn beside_the_locus_the_foot_of_the_perpendicular_counts() {
        let observer = Observer::cie_1931_2deg();
        let locus = Locus::new(observer);
        for t in [1500.0, 3000.0, 6000.0, 20_000.0] {
            for duv in [-0.03, -0.005, 0.005, 0.03] {
                let (uv, slope) = locus.at(t);
                let length = slope[0].hypot(slope[1]);
                let normal = [slope[1] / length, -slope[0] / length];
                let side = if normal[1] > 0.0 { duv } else { -duv };
                let [u, v] = [uv[0] + side * normal[0], uv[1] + side * normal[1]];
                let d = 2.0 * u - 8.0 * v + 4.0;
                let found = correlated_color_temperature([3.0 * u / d, 2.0 * v / d], observer).unwrap();
                assert!(
                    (found.cct_k - t).abs() < 1e-3 && (found.duv - duv).abs() < 1e-9,
                    "{t} {duv}: {found:?}"
                );
            }
        }
    }

    #[test]
    fn what_has_none() {
        let of = |xy| correlated_color_temperature(xy, Observer::cie_1931_2deg());
        assert!(matches!(of([0.2, 0.7]), Err(TemperatureError::TooFar(_))));
        assert_eq!(of([0.1, 0.1]), Err(TemperatureError::OutOfRange));
        assert!(matches!(of([0.3, 0.0]), Err(TemperatureError::NoChromaticity(..))));
    }
}
