//! Dominant and complementary wavelength, and purity.
//!
//! A line from the white through a colour meets the locus of monochromatic light at the dominant wavelength λ_d; where
//! it meets the line of purples instead, the line drawn the other way gives the complementary wavelength λ_c. The
//! excitation purity is p_e = |xy − w| / |b − w|, with b the point of the boundary on the side of the colour: 0 for the
//! white, 1 on the boundary (CIE 15:2018, 9.3; Wyszecki and Stiles 1982, 3.3.6).
//!
//! Between its points the locus runs as the matching functions do, in straight lines. Its ends are the outermost
//! wavelengths with x̄ + ȳ + z̄ ≥ 0.005: beyond, tables of four decimals have no chromaticity left, and in the CIE's
//! the locus stands still.

use illuminant_spectrum::Observer;
use thiserror::Error;

/// Where a line through a colour meets the boundary of all colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dominant {
    /// Dominant wavelength, nm; the complementary one for a purple.
    pub wavelength_nm: f64,
    /// Whether it is the complementary wavelength.
    pub complementary: bool,
    /// Excitation purity; above 1 for a chromaticity that no light has.
    pub purity: f64,
    /// (x, y) of the boundary on the side of the colour.
    pub boundary: [f64; 2],
}

/// Why a chromaticity has no dominant wavelength.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum DominantError {
    /// No direction.
    #[error("the colour is the white itself, so it has no dominant wavelength; its purity is 0")]
    White,
    /// A value that is no number.
    #[error("a chromaticity has finite x and y")]
    NoChromaticity,
    /// No boundary in that direction.
    #[error(
        "the white lies outside the chromaticities of light, so no line from it meets the boundary on both sides"
    )]
    WhiteOutside,
}

/// Below this x̄ + ȳ + z̄ a wavelength has no place on the boundary.
const FAINTEST: f64 = 0.005;

/// The dominant wavelength and purity of a chromaticity (x, y) beside a white.
///
/// ```
/// use illuminant_color::dominant_wavelength;
/// use illuminant_spectrum::Observer;
/// // The red of sRGB.
/// let red = dominant_wavelength([0.64, 0.33], [0.3127, 0.3290], Observer::cie_1931_2deg()).unwrap();
/// assert!((red.wavelength_nm - 611.4).abs() < 0.2 && !red.complementary);
/// ```
///
/// # Errors
/// [`DominantError`]: the colour is the white, a value is not finite, or the white is not that of a light.
pub fn dominant_wavelength(
    xy: [f64; 2],
    white: [f64; 2],
    observer: &Observer,
) -> Result<Dominant, DominantError> {
    if ![xy, white].iter().flatten().all(|v| v.is_finite()) {
        return Err(DominantError::NoChromaticity);
    }
    let toward = [xy[0] - white[0], xy[1] - white[1]];
    let length = toward[0].hypot(toward[1]);
    if length < 1e-12 {
        return Err(DominantError::White);
    }
    let locus = locus(observer);
    let direction = toward.map(|v| v / length);
    let away = direction.map(|v| -v);
    if let Some((wavelength_nm, boundary)) = meet(&locus, white, direction) {
        let purity = length / distance(white, boundary);
        return Ok(Dominant { wavelength_nm, complementary: false, purity, boundary });
    }
    let (wavelength_nm, _) = meet(&locus, white, away).ok_or(DominantError::WhiteOutside)?;
    let purples = [locus[0], locus[locus.len() - 1]].map(|(_, xyz)| chromaticity(xyz));
    let boundary = crossing(white, direction, purples).ok_or(DominantError::WhiteOutside)?;
    let purity = length / distance(white, boundary);
    Ok(Dominant { wavelength_nm, complementary: true, purity, boundary })
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

fn chromaticity([x, y, z]: [f64; 3]) -> [f64; 2] {
    let sum = x + y + z;
    [x / sum, y / sum]
}

/// The matching functions along the boundary.
fn locus(observer: &Observer) -> Vec<(f64, [f64; 3])> {
    let points = observer.matching[1].wavelengths_nm().iter();
    points
        .map(|&w| (w, [0, 1, 2].map(|i| observer.matching[i].at(w))))
        .skip_while(|(_, xyz)| xyz.iter().sum::<f64>() < FAINTEST)
        .take_while(|(_, xyz)| xyz.iter().sum::<f64>() >= FAINTEST)
        .collect()
}

/// The outermost point where a ray from the white meets the locus, with its wavelength.
fn meet(locus: &[(f64, [f64; 3])], white: [f64; 2], direction: [f64; 2]) -> Option<(f64, [f64; 2])> {
    // (x − w_x) d_y − (y − w_y) d_x, times X + Y + Z: linear in the matching functions, zero on the line.
    let beside = |[x, y, z]: [f64; 3]| {
        let sum = x + y + z;
        (x - white[0] * sum) * direction[1] - (y - white[1] * sum) * direction[0]
    };
    let mut found: Option<(f64, [f64; 2])> = None;
    let mut reach = 0.0;
    for pair in locus.windows(2) {
        let [(wa, a), (wb, b)] = [pair[0], pair[1]];
        let (fa, fb) = (beside(a), beside(b));
        if (fa > 0.0) == (fb > 0.0) {
            continue;
        }
        let t = fa / (fa - fb);
        let point = chromaticity([0, 1, 2].map(|i| a[i] + t * (b[i] - a[i])));
        let ahead = (point[0] - white[0]) * direction[0] + (point[1] - white[1]) * direction[1];
        if ahead > reach {
            reach = ahead;
            found = Some((wa + t * (wb - wa), point));
        }
    }
    found
}

/// Where a ray meets a piece of a straight line.
fn crossing(from: [f64; 2], direction: [f64; 2], [a, b]: [[f64; 2]; 2]) -> Option<[f64; 2]> {
    let beside = |p: [f64; 2]| (p[0] - from[0]) * direction[1] - (p[1] - from[1]) * direction[0];
    let t = beside(a) / (beside(a) - beside(b));
    let point = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
    let ahead = (point[0] - from[0]) * direction[0] + (point[1] - from[1]) * direction[1];
    ((0.0..=1.0).contains(&t) && ahead > 0.0).then_some(point)
}

#[cfg(test)]
mod tests {
    use super::*;

    const E: [f64; 2] = [1.0 / 3.0, 1.0 / 3.0];

    fn light(observer: &Observer, w: f64) -> [f64; 2] {
        chromaticity([0, 1, 2].map(|i| observer.matching[i].at(w)))
    }

    #[test]
    fn mixtures_of_white_and_one_wavelength() {
        for observer in [Observer::cie_1931_2deg(), Observer::cie_1964_10deg(), Observer::book()] {
            for w in [450.0, 480.5, 500.0, 555.2, 600.0, 640.0] {
                let pure = light(observer, w);
                for purity in [0.1, 0.6, 1.0] {
                    let xy = [0, 1].map(|i| E[i] + purity * (pure[i] - E[i]));
                    let found = dominant_wavelength(xy, E, observer).unwrap();
                    assert!((found.wavelength_nm - w).abs() < 1e-6, "{found:?} for {w}");
                    assert!((found.purity - purity).abs() < 1e-9 && !found.complementary);
                }
            }
        }
    }

    #[test]
    fn purples_have_a_complementary_wavelength() {
        let observer = Observer::cie_1931_2deg();
        let green = light(observer, 530.0);
        let xy = [0, 1].map(|i| E[i] - 0.1 * (green[i] - E[i]));
        let found = dominant_wavelength(xy, E, observer).unwrap();
        assert!(found.complementary && (found.wavelength_nm - 530.0).abs() < 1e-6);
        let whole = dominant_wavelength(found.boundary, E, observer).unwrap();
        assert!((whole.purity - 1.0).abs() < 1e-9 && found.purity < 0.5);
    }

    #[test]
    fn what_has_none() {
        let observer = Observer::cie_1931_2deg();
        assert_eq!(dominant_wavelength(E, E, observer), Err(DominantError::White));
        assert_eq!(dominant_wavelength([f64::NAN, 0.3], E, observer), Err(DominantError::NoChromaticity));
        assert_eq!(dominant_wavelength([0.9, 0.95], [0.9, 0.9], observer), Err(DominantError::WhiteOutside));
    }
}
