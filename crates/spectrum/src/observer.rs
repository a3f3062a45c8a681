//! The standard observer.

use crate::{Curve, Outside, SpectralRange};
use std::sync::LazyLock;

/// The maximum luminous efficacy K_m, lm/W.
pub const LUMINOUS_EFFICACY: f64 = 683.0;

/// The three matching functions of an observer.
#[derive(Clone, Debug)]
pub struct Observer {
    /// x̄, ȳ and z̄ as curves on wavelength, zero outside their table.
    pub matching: [Curve; 3],
}

impl Observer {
    /// The CIE 1931 standard observer (2°), 1 nm, 360–830 nm (CIE 018; ISO/CIE 11664-1).
    #[must_use]
    pub fn cie_1931_2deg() -> &'static Self {
        static OBSERVER: LazyLock<Observer> = LazyLock::new(|| {
            Observer::from_csv(include_str!("../../../python/illuminant/data/observers/cie_1931_2deg.csv"))
        });
        &OBSERVER
    }

    /// Reads `wavelength,x,y,z` lines; lines that do not begin with a digit are comments.
    fn from_csv(text: &str) -> Self {
        let rows: Vec<[f64; 4]> = text
            .lines()
            .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
            .map(|line| {
                let mut row = [0.0; 4];
                for (slot, field) in row.iter_mut().zip(line.split(',')) {
                    *slot = field.trim().parse().unwrap_or(f64::NAN);
                }
                row
            })
            .collect();
        let wavelengths: Vec<f64> = rows.iter().map(|row| row[0]).collect();
        let matching = [1, 2, 3].map(|column| {
            let values = rows.iter().map(|row| row[column]).collect();
            // The table is compiled in and tested: a failure here is a broken build, not broken input.
            Curve::new(wavelengths.clone(), values, Outside::Zero)
                .unwrap_or_else(|_| Curve::constant(f64::NAN))
        });
        Self { matching }
    }

    /// Absolute tristimulus values of a spectral radiance, K_m Σ L(λ) x̄(λ) Δλ with Δλ = 1 nm over `range`.
    ///
    /// For a radiance in W·sr⁻¹·m⁻²·nm⁻¹ the result is in cd/m²; for an irradiance it is in lx.
    #[must_use]
    pub fn xyz(&self, curve: &Curve, range: SpectralRange) -> [f64; 3] {
        self.xyz_of(range, |w| curve.at(w))
    }

    /// [`Self::xyz`] of a function of wavelength.
    pub fn xyz_of(&self, range: SpectralRange, radiance: impl Fn(f64) -> f64) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for w in range.wavelengths() {
            let value = radiance(w);
            for (total, matching) in sum.iter_mut().zip(&self.matching) {
                *total += LUMINOUS_EFFICACY * value * matching.at(w);
            }
        }
        sum
    }

    /// Luminance (cd/m²) of a spectral radiance, or illuminance (lx) of a spectral irradiance.
    #[must_use]
    pub fn luminance(&self, curve: &Curve, range: SpectralRange) -> f64 {
        self.xyz(curve, range)[1]
    }

    /// Tristimulus values of a reflectance or transmittance under a lamp, with Y = 1 for a perfect diffuser.
    #[must_use]
    pub fn relative_xyz(&self, reflectance: &Curve, lamp: &Curve, range: SpectralRange) -> [f64; 3] {
        let white = self.luminance(lamp, range);
        self.xyz_of(range, |w| reflectance.at(w) * lamp.at(w)).map(|v| v / white)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_energy_is_white_and_the_peak_is_one() {
        let observer = Observer::cie_1931_2deg();
        let [x, y, z] = observer.xyz(&Curve::constant(1.0), SpectralRange { min_nm: 360, max_nm: 830 });
        assert!((x / y - 1.0).abs() < 5e-4 && (z / y - 1.0).abs() < 5e-4, "{x} {y} {z}");
        assert!((observer.matching[1].at(555.0) - 1.0).abs() < 1e-9);
        assert!((y / LUMINOUS_EFFICACY - 106.857).abs() < 0.01);
    }
}
