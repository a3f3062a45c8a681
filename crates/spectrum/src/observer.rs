//! The standard observers.
//!
//! | name | what | table |
//! | --- | --- | --- |
//! | `CIE 1931 2°` | the default: fields of 1° to 4° | 360–830 nm, 1 nm (CIE 018:2019; ISO/CIE 11664-1) |
//! | `CIE 1964 10°` | fields of more than 4° | 360–830 nm, 1 nm (the same) |
//! | `book` | the table of the book's code (III.7.3), with its two slips put right | 380–780 nm, 5 nm, lines between |
//! | `book as printed` | x̄(380) 0.00014 for 0.0014 and z̄(480) 0.8310 for 0.8130 | the same |
//!
//! The slip at 480 nm is why the book's sums of x̄, ȳ and z̄ differ (106.85, 106.856, 106.935; put right 106.854,
//! 106.856, 106.845); its section 3.5.1 blames the interpolation.

use crate::{Curve, Outside, SpectralRange, curves_from_csv};
use std::sync::LazyLock;

/// The maximum luminous efficacy K_m, lm/W.
pub const LUMINOUS_EFFICACY: f64 = 683.0;

/// The three matching functions of an observer.
#[derive(Clone, Debug)]
pub struct Observer {
    /// x̄, ȳ and z̄ as curves on wavelength, zero outside their table.
    pub matching: [Curve; 3],
}

/// An observer that is read from its table when it is first asked for.
macro_rules! shipped {
    ($file:literal) => {{
        static OBSERVER: LazyLock<Observer> = LazyLock::new(|| {
            let text = include_str!(concat!("../../../python/illuminant/data/observers/", $file));
            let curves = curves_from_csv(text, Outside::Zero);
            Observer { matching: [0, 1, 2].map(|i| curves[i].clone()) }
        });
        &OBSERVER
    }};
}

impl Observer {
    /// The names that [`Self::named`] knows, the default first.
    pub const NAMES: [&'static str; 4] = ["CIE 1931 2°", "CIE 1964 10°", "book", "book as printed"];

    /// The CIE 1931 standard observer (2°), 1 nm, 360–830 nm (CIE 018; ISO/CIE 11664-1).
    #[must_use]
    pub fn cie_1931_2deg() -> &'static Self {
        shipped!("cie_1931_2deg.csv")
    }

    /// The CIE 1964 supplementary standard observer (10°), 1 nm, 360–830 nm (CIE 018; ISO/CIE 11664-1).
    ///
    /// With K_m = 683 its Y is no luminance: photometry is defined with the 2° observer. Ratios are not touched.
    #[must_use]
    pub fn cie_1964_10deg() -> &'static Self {
        shipped!("cie_1964_10deg.csv")
    }

    /// The 5 nm table of the book (III.7.3; Judd and Wyszecki 1975, table 2.6) with both slips of the print put
    /// right.
    #[must_use]
    pub fn book() -> &'static Self {
        shipped!("book.csv")
    }

    /// The 5 nm table of the book as it is printed.
    #[must_use]
    pub fn book_as_printed() -> &'static Self {
        shipped!("book_as_printed.csv")
    }

    /// An observer by its name, one of [`Self::NAMES`]; upper and lower case are one, and the sign for degrees may
    /// be missing.
    ///
    /// ```
    /// use illuminant_spectrum::Observer;
    /// assert!(Observer::named("cie 1964 10").is_some() && Observer::named("CIE 2006 2°").is_none());
    /// ```
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        let folded = |text: &str| text.trim().trim_end_matches('°').to_lowercase();
        let tables: [fn() -> &'static Self; 4] =
            [Self::cie_1931_2deg, Self::cie_1964_10deg, Self::book, Self::book_as_printed];
        let found = Self::NAMES.iter().position(|known| folded(known) == folded(name))?;
        Some(tables[found]())
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

    #[test]
    fn the_sums_of_the_book() {
        let sums =
            |observer: &Observer| observer.matching.clone().map(|curve| curve.area(SpectralRange::default()));
        let near = |found: [f64; 3], expected: [f64; 3], tolerance: f64| {
            assert!(
                found.iter().zip(expected).all(|(a, b)| (a - b).abs() < tolerance),
                "{found:?} against {expected:?}"
            );
        };
        near(sums(Observer::book()), [106.854, 106.856, 106.845], 6e-4);
        near(sums(Observer::book_as_printed()), [106.85, 106.856, 106.935], 6e-4);
        near(sums(Observer::cie_1964_10deg()), [116.64, 116.66, 116.67], 0.01);
    }

    #[test]
    fn each_name_has_its_own_table() {
        let at_480: Vec<f64> =
            Observer::NAMES.iter().map(|name| Observer::named(name).unwrap().matching[2].at(480.0)).collect();
        assert_eq!(at_480, [0.812_950_1, 0.772_125, 0.8130, 0.8310]);
    }
}
