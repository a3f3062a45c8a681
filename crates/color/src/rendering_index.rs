//! The colour rendering index of a lamp, CIE 13.3-1995.
//!
//! Fourteen reflectances are seen under the lamp and under a reference of the same correlated colour temperature: a
//! blackbody below 5,000 K, daylight from there on. Colours are compared in W\*U\*V\* of 1964 after a shift of the
//! lamp's chromaticity to that of the reference (CIE 13.3, 5.7):
//!
//! c = (4 − u − 10v)/v, d = (1.708v + 0.404 − 1.481u)/v,
//! u' = (10.872 + 0.404 c_r/c_k c − 4 d_r/d_k d)/(16.518 + 1.481 c_r/c_k c − d_r/d_k d), v' = 5.520/(the same),
//! W\* = 25 Y^⅓ − 17, U\* = 13 W\*(u' − u_r), V\* = 13 W\*(v' − v_r), Rᵢ = 100 − 4.6 ΔEᵢ.
//!
//! R_a is the mean of R₁ to R₈. All sums run over 360–830 nm with the 2° observer, in steps of which the caller says the
//! size: at 1 nm a lamp tabulated at 5 nm is joined by straight lines, as everywhere in this program; at 5 nm its points
//! alone count, and the numbers are those that the CIE publishes for its fluorescent lamps. The two differ by 0.2 in R_a
//! and by up to 1 in a special index.

use crate::temperature::uv_1960;
use crate::{ColorTemperature, TemperatureError, correlated_color_temperature};
use illuminant_spectrum::{Curve, Observer, Outside, SpectralRange, curves_from_csv, daylight, planck};
use std::sync::LazyLock;
use thiserror::Error;

const RANGE: SpectralRange = SpectralRange { min_nm: 360, max_nm: 830 };

/// How a lamp renders colours.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderingIndex {
    /// The general index R_a.
    pub general: f64,
    /// The special indices R₁ to R₁₄.
    pub special: [f64; 14],
    /// Correlated colour temperature of the lamp, K, and its Duv.
    pub temperature: ColorTemperature,
    /// Distance of lamp and reference in (u, v) of 1960; above 0.0054 the CIE calls the result less accurate.
    pub reference_distance: f64,
}

/// Why a lamp has no colour rendering index.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum RenderingError {
    /// A step that is no step.
    #[error("sums for the colour rendering index run in steps of 1 to 10 nm, not of {0} nm")]
    Step(u32),
    /// No light between 360 and 830 nm.
    #[error("the lamp gives no light that the eye sees")]
    Dark,
    /// No colour temperature, so no reference.
    #[error("the lamp has no reference: {0}")]
    Temperature(#[from] TemperatureError),
    /// Bluer than any daylight.
    #[error("the lamp has a colour temperature of {0:.0} K, and daylight is defined up to 25,000 K")]
    NoDaylight(f64),
}

/// The fourteen test colour samples of CIE 13.3-1995, reflectances at 5 nm, 360–830 nm.
#[must_use]
pub fn test_color_samples() -> &'static [Curve] {
    static SAMPLES: LazyLock<Vec<Curve>> = LazyLock::new(|| {
        let text = include_str!("../../../python/illuminant/data/test_color_samples/cie_1995.csv");
        curves_from_csv(text, Outside::Hold)
    });
    &SAMPLES
}

/// The colour rendering index of a lamp, with sums in steps of `step_nm`.
///
/// ```
/// use illuminant_spectrum::daylight;
/// let found = illuminant_color::rendering_index(&daylight(6504.0).unwrap(), 1).unwrap();
/// assert!(found.general > 99.9);
/// ```
///
/// # Errors
/// [`RenderingError`]: a step other than 1 to 10 nm, no light, no correlated colour temperature, or one above 25,000 K.
pub fn rendering_index(lamp: &Curve, step_nm: u32) -> Result<RenderingIndex, RenderingError> {
    if !(1..=10).contains(&step_nm) {
        return Err(RenderingError::Step(step_nm));
    }
    let observer = Observer::cie_1931_2deg();
    let sums = |light: &dyn Fn(f64) -> f64| {
        let mut xyz = [0.0; 3];
        for w in RANGE.wavelengths().step_by(step_nm as usize) {
            let value = light(w);
            for (total, matching) in xyz.iter_mut().zip(&observer.matching) {
                *total += value * matching.at(w);
            }
        }
        xyz
    };
    let under =
        |sample: &Curve, light: &Curve, white: f64| sums(&|w| sample.at(w) * light.at(w)).map(|v| v / white);
    let white = sums(&|w| lamp.at(w));
    let sum: f64 = white.iter().sum();
    if !(white[1] > 0.0) {
        return Err(RenderingError::Dark);
    }
    let temperature = correlated_color_temperature([white[0] / sum, white[1] / sum], observer)?;
    let t = temperature.cct_k;
    let reference = if t < 5000.0 {
        Curve::tabulated(RANGE, RANGE.wavelengths().map(|w| planck(w, t)).collect(), Outside::Zero)
    } else {
        daylight(t).ok_or(RenderingError::NoDaylight(t))?
    };
    let uv_lamp = uv_1960(white);
    let white_reference = sums(&|w| reference.at(w));
    let uv_reference = uv_1960(white_reference);
    let mut special = [0.0; 14];
    for (index, sample) in special.iter_mut().zip(test_color_samples()) {
        let under_lamp = under(sample, lamp, white[1]);
        let under_reference = under(sample, &reference, white_reference[1]);
        let shifted = adapt(uv_1960(under_lamp), uv_lamp, uv_reference);
        let a = wuv(under_lamp[1], shifted, uv_reference);
        let b = wuv(under_reference[1], uv_1960(under_reference), uv_reference);
        let difference = ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2) + (a[2] - b[2]).powi(2)).sqrt();
        *index = 100.0 - 4.6 * difference;
    }
    Ok(RenderingIndex {
        general: special[..8].iter().sum::<f64>() / 8.0,
        special,
        temperature,
        reference_distance: (uv_lamp[0] - uv_reference[0]).hypot(uv_lamp[1] - uv_reference[1]),
    })
}

/// A chromaticity under the lamp as it would be under the reference (the von Kries shift of CIE 13.3).
fn adapt(uv: [f64; 2], lamp: [f64; 2], reference: [f64; 2]) -> [f64; 2] {
    let cd = |[u, v]: [f64; 2]| [(4.0 - u - 10.0 * v) / v, (1.708 * v + 0.404 - 1.481 * u) / v];
    let ([c, d], [ck, dk], [cr, dr]) = (cd(uv), cd(lamp), cd(reference));
    let (c, d) = (cr / ck * c, dr / dk * d);
    let denominator = 16.518 + 1.481 * c - d;
    [(10.872 + 0.404 * c - 4.0 * d) / denominator, 5.520 / denominator]
}

/// W\*, U\*, V\* of a colour whose white has Y = 1.
fn wuv(y: f64, uv: [f64; 2], white: [f64; 2]) -> [f64; 3] {
    let w = 25.0 * (100.0 * y).cbrt() - 17.0;
    [w, 13.0 * w * (uv[0] - white[0]), 13.0 * w * (uv[1] - white[1])]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_are_perfect() {
        for t in [2000.0, 2856.0, 4900.0] {
            let lamp =
                Curve::tabulated(RANGE, RANGE.wavelengths().map(|w| planck(w, t)).collect(), Outside::Zero);
            let found = rendering_index(&lamp, 1).unwrap();
            assert!(found.special.iter().all(|r| (r - 100.0).abs() < 1e-4), "{found:?}");
        }
        // Daylight of a nominal temperature has nearly, not exactly, this correlated colour temperature.
        let found = rendering_index(&daylight(7500.0).unwrap(), 5).unwrap();
        assert!(found.special.iter().all(|r| (r - 100.0).abs() < 0.05), "{found:?}");
        assert!(found.reference_distance < 1e-4);
    }

    #[test]
    fn size_does_not_matter_and_narrow_light_renders_badly() {
        let lamp = Curve::new(vec![570.0, 590.0, 610.0], vec![0.0, 1.0, 0.0], Outside::Zero).unwrap();
        let white = daylight(5500.0).unwrap();
        let mixed = white.scaled(0.2).sum(&lamp.scaled(3.0)).unwrap();
        let found = rendering_index(&mixed, 1).unwrap();
        assert!(found.general < 60.0, "{found:?}");
        let larger = rendering_index(&mixed.scaled(1e3), 1).unwrap();
        assert!((found.general - larger.general).abs() < 1e-6);
    }

    #[test]
    fn what_has_none() {
        let line = |a: f64| Curve::new(vec![a, a + 10.0], vec![1.0, 1.0], Outside::Zero).unwrap();
        assert_eq!(rendering_index(&line(900.0), 1), Err(RenderingError::Dark));
        assert!(matches!(rendering_index(&line(520.0), 1), Err(RenderingError::Temperature(_))));
        assert_eq!(rendering_index(&line(520.0), 0), Err(RenderingError::Step(0)));
    }
}
