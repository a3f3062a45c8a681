//! The colour fidelity index of a lamp, CIE 224:2017.
//!
//! Ninety-nine reflectances are seen by the 10° observer under the lamp and under a reference of the same correlated
//! colour temperature T (of the 2° observer): a blackbody below 4,000 K, daylight above 5,000 K, between them both in
//! the proportion (5000 − T)/1000 of equal luminance. Colours are compared in CAM02-UCS (Luo, Cui and Li 2006; CIE
//! 159:2004) with L_A = 100 cd/m², Y_b = 20, average surround and full adaptation:
//!
//! R_f = 10 ln(exp((100 − 6.73 ΔE)/10) + 1), with ΔE the mean over the samples, and the same for each sample alone.
//!
//! The samples are given by the caller; this program ships none. Sums run over 380–780 nm in steps of which the caller
//! says the size.

use crate::{ColorTemperature, TemperatureError, Triple, correlated_color_temperature};
use illuminant_spectrum::{Curve, Observer, SpectralRange, daylight, planck};
use nalgebra::{Matrix3, Vector3};
use thiserror::Error;

const RANGE: SpectralRange = SpectralRange { min_nm: 380, max_nm: 780 };

/// How faithfully a lamp renders colours.
#[derive(Clone, Debug, PartialEq)]
pub struct FidelityIndex {
    /// The general index R_f.
    pub general: f64,
    /// The index of each sample.
    pub special: Vec<f64>,
    /// Correlated colour temperature of the lamp, K, and its Duv.
    pub temperature: ColorTemperature,
}

/// Why a lamp has no colour fidelity index.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum FidelityError {
    /// No samples.
    #[error("the colour fidelity index needs at least one sample; CIE 224:2017 has ninety-nine")]
    NoSamples,
    /// A step that is no step.
    #[error("sums for the colour fidelity index run in steps of 1 to 5 nm, not of {0} nm")]
    Step(u32),
    /// No light between 380 and 780 nm.
    #[error("the lamp gives no light that the eye sees")]
    Dark,
    /// No colour temperature, so no reference.
    #[error("the lamp has no reference: {0}")]
    Temperature(#[from] TemperatureError),
    /// Bluer than any daylight.
    #[error("the lamp has a colour temperature of {0:.0} K, and daylight is defined up to 25,000 K")]
    NoDaylight(f64),
}

/// The colour fidelity index of a lamp over given samples, with sums in steps of `step_nm`.
///
/// ```
/// use illuminant_spectrum::{Curve, daylight};
/// let found = illuminant_color::fidelity_index(&daylight(6504.0).unwrap(), &[Curve::constant(0.3)], 1).unwrap();
/// assert!(found.general > 99.9);
/// ```
///
/// # Errors
/// [`FidelityError`]: no samples, a step other than 1 to 5 nm, no light, no correlated colour temperature, or one above
/// 25,000 K.
pub fn fidelity_index(lamp: &Curve, samples: &[Curve], step_nm: u32) -> Result<FidelityIndex, FidelityError> {
    if samples.is_empty() {
        return Err(FidelityError::NoSamples);
    }
    if !(1..=5).contains(&step_nm) {
        return Err(FidelityError::Step(step_nm));
    }
    let grid: Vec<f64> = RANGE.wavelengths().step_by(step_nm as usize).collect();
    let light: Vec<f64> = grid.iter().map(|w| lamp.at(*w)).collect();
    let seen = Sums::new(Observer::cie_1931_2deg(), &grid);
    let white = seen.xyz(&light, None);
    let total: f64 = white.iter().sum();
    if !(white[1] > 0.0) {
        return Err(FidelityError::Dark);
    }
    let temperature =
        correlated_color_temperature([white[0] / total, white[1] / total], Observer::cie_1931_2deg())?;
    let sums = Sums::new(Observer::cie_1964_10deg(), &grid);
    let reference = reference(temperature.cct_k, &grid, &sums)?;
    let [under_lamp, under_reference] = [light, reference].map(|light| {
        let white = sums.xyz(&light, None);
        let scale = 100.0 / white[1];
        let view = View::new(white.map(|v| v * scale));
        samples
            .iter()
            .map(|sample| view.ucs(sums.xyz(&light, Some(sample)).map(|v| v * scale)))
            .collect::<Vec<Triple>>()
    });
    let differences: Vec<f64> = under_lamp
        .iter()
        .zip(&under_reference)
        .map(|(a, b)| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt())
        .collect();
    let index = |difference: f64| 10.0 * ((100.0 - 6.73 * difference) / 10.0).exp().ln_1p();
    let mean = differences.iter().sum::<f64>() / differences.len() as f64;
    Ok(FidelityIndex {
        general: index(mean),
        special: differences.into_iter().map(index).collect(),
        temperature,
    })
}

/// The power of the reference at each wavelength of a grid.
fn reference(cct_k: f64, grid: &[f64], sums: &Sums) -> Result<Vec<f64>, FidelityError> {
    let black: Vec<f64> = grid.iter().map(|w| planck(*w, cct_k)).collect();
    if cct_k <= 4000.0 {
        return Ok(black);
    }
    let day = daylight(cct_k).ok_or(FidelityError::NoDaylight(cct_k))?;
    let day: Vec<f64> = grid.iter().map(|w| day.at(*w)).collect();
    if cct_k >= 5000.0 {
        return Ok(day);
    }
    let share = (5000.0 - cct_k) / 1000.0;
    let (a, b) = (share / sums.xyz(&black, None)[1], (1.0 - share) / sums.xyz(&day, None)[1]);
    Ok(black.iter().zip(&day).map(|(p, d)| a * p + b * d).collect())
}

/// An observer at the wavelengths of a grid.
struct Sums {
    grid: Vec<f64>,
    matching: Vec<Triple>,
}

impl Sums {
    fn new(observer: &Observer, grid: &[f64]) -> Self {
        let at = |w: &f64| [0, 1, 2].map(|i| observer.matching[i].at(*w));
        Self { grid: grid.to_vec(), matching: grid.iter().map(at).collect() }
    }

    fn xyz(&self, light: &[f64], sample: Option<&Curve>) -> Triple {
        let mut xyz = [0.0; 3];
        for ((w, matching), light) in self.grid.iter().zip(&self.matching).zip(light) {
            let value = light * sample.map_or(1.0, |sample| sample.at(*w));
            for (total, m) in xyz.iter_mut().zip(matching) {
                *total += value * m;
            }
        }
        xyz
    }
}

/// CIECAM02 under the conditions of CIE 224 (F = 1, c = 0.69, N_c = 1, D = 1), beside a white of Y = 100.
struct View {
    adapt: Matrix3<f64>,
    luminance_level: f64,
    induction: f64,
    base_exponent: f64,
    n: f64,
    white_response: f64,
}

impl View {
    fn new(white: Triple) -> Self {
        let cat = Matrix3::new(0.7328, 0.4296, -0.1624, -0.7036, 1.6975, 0.0061, 0.0030, 0.0136, 0.9834);
        let cones = Matrix3::new(0.38971, 0.68898, -0.07868, -0.22981, 1.18340, 0.04641, 0.0, 0.0, 1.0);
        let gains = (cat * Vector3::from(white)).map(|v| 100.0 / v);
        // The published matrix of CAT02 has an inverse; the identity keeps the type honest.
        let back = cat.try_inverse().unwrap_or_else(Matrix3::identity);
        let (l_a, y_b) = (100.0, 20.0);
        let k4 = (1.0f64 / (5.0 * l_a + 1.0)).powi(4);
        let n: f64 = y_b / 100.0;
        let mut view = Self {
            adapt: cones * back * Matrix3::from_diagonal(&gains) * cat,
            luminance_level: 0.2 * k4 * 5.0 * l_a + 0.1 * (1.0 - k4).powi(2) * (5.0f64 * l_a).cbrt(),
            induction: 0.725 * n.powf(-0.2),
            base_exponent: 1.48 + n.sqrt(),
            n,
            white_response: 1.0,
        };
        view.white_response = view.achromatic(view.responses(white));
        view
    }

    /// Cone responses after adaptation and compression.
    fn responses(&self, xyz: Triple) -> Triple {
        let compressed = (self.adapt * Vector3::from(xyz)).map(|v| {
            let p = (self.luminance_level * v.abs() / 100.0).powf(0.42);
            (400.0 * p / (p + 27.13)).copysign(v) + 0.1
        });
        compressed.into()
    }

    fn achromatic(&self, [r, g, b]: Triple) -> f64 {
        (2.0 * r + g + b / 20.0 - 0.305) * self.induction
    }

    /// J', a', b' of CAM02-UCS.
    fn ucs(&self, xyz: Triple) -> Triple {
        let [r, g, blue] = self.responses(xyz);
        let (a, b) = (r - 12.0 * g / 11.0 + blue / 11.0, (r + g - 2.0 * blue) / 9.0);
        let hue = b.atan2(a);
        let j = 100.0
            * (self.achromatic([r, g, blue]).max(0.0) / self.white_response).powf(0.69 * self.base_exponent);
        let eccentricity = ((hue + 2.0).cos() + 3.8) / 4.0;
        let t = 50_000.0 / 13.0 * self.induction * eccentricity * a.hypot(b) / (r + g + 21.0 / 20.0 * blue);
        let chroma = t.powf(0.9) * (j / 100.0).sqrt() * (1.64 - 0.29f64.powf(self.n)).powf(0.73);
        let colorfulness = chroma * self.luminance_level.powf(0.25);
        let m = (0.0228 * colorfulness).ln_1p() / 0.0228;
        [1.7 * j / (1.0 + 0.007 * j), m * hue.cos(), m * hue.sin()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_color_samples;
    use illuminant_spectrum::Outside;

    #[test]
    fn references_are_perfect() {
        let samples = test_color_samples();
        for t in [2000.0, 3900.0] {
            let values = RANGE.wavelengths().map(|w| planck(w, t)).collect();
            let lamp = Curve::tabulated(RANGE, values, Outside::Zero);
            let found = fidelity_index(&lamp, samples, 1).unwrap();
            assert!(found.special.iter().all(|r| *r > 99.99), "{found:?}");
        }
        for t in [5500.0, 10_000.0] {
            let found = fidelity_index(&daylight(t).unwrap(), samples, 5).unwrap();
            assert!(found.special.iter().all(|r| *r > 99.9), "{found:?}");
        }
    }

    #[test]
    fn white_is_white_and_black_is_black() {
        let view = View::new([95.0, 100.0, 108.0]);
        let [j, a, b] = view.ucs([95.0, 100.0, 108.0]);
        assert!((j - 100.0).abs() < 1e-9 && a.hypot(b) < 1.0, "{j} {a} {b}");
        assert!(view.ucs([0.0; 3])[0] < 1e-12);
    }

    #[test]
    fn between_4000_and_5000_k_the_reference_is_mixed() {
        let grid: Vec<f64> = RANGE.wavelengths().collect();
        let sums = Sums::new(Observer::cie_1964_10deg(), &grid);
        let at = |t: f64| {
            let light = reference(t, &grid, &sums).unwrap();
            let y = sums.xyz(&light, None)[1];
            light.into_iter().map(|v| v / y).collect::<Vec<f64>>()
        };
        let jump =
            |t: f64| at(t - 1e-6).iter().zip(at(t + 1e-6)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(jump(4000.0) < 1e-8 && jump(5000.0) < 1e-8, "{} {}", jump(4000.0), jump(5000.0));
    }

    #[test]
    fn what_has_none() {
        let line = |a: f64| Curve::new(vec![a, a + 10.0], vec![1.0, 1.0], Outside::Zero).unwrap();
        let samples = test_color_samples();
        assert_eq!(fidelity_index(&line(900.0), samples, 1), Err(FidelityError::Dark));
        assert_eq!(fidelity_index(&line(500.0), &[], 1), Err(FidelityError::NoSamples));
        assert_eq!(fidelity_index(&line(500.0), samples, 9), Err(FidelityError::Step(9)));
        assert!(matches!(fidelity_index(&line(520.0), samples, 1), Err(FidelityError::Temperature(_))));
    }
}
