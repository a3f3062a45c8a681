//! `rgb` and `xyz`: colours multiplied as colours, the wrong ways of the book's 3.5.1, kept to be compared.

use crate::{Basis, Role, ToXyz};
use illuminant_color::{RgbSystem, Transfer, Triple};
use illuminant_spectrum::{Curve, LUMINOUS_EFFICACY, Observer, SpectralRange};

/// How the colour of a reflectance is scaled (book 3.5.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normalisation {
    /// By the area of ȳ alone: Y of a mirror is 1, but its RGB is not (1, 1, 1).
    Luminance,
    /// The white of the RGB system is moved to equal energy, so that a mirror is (1, 1, 1).
    White,
    /// Each sampling function is scaled to area 1, so that a mirror is (1, 1, 1).
    Area,
}

/// Three numbers for a spectrum: its colour.
///
/// Light enters with its exact colour, so that a lamp seen directly is right; a reflectance is reduced to the colour
/// that it has under equal energy, by one of three normalisations. Values below zero, of colours outside the system, are
/// set to zero, light then scaled to the luminance it had.
#[derive(Clone, Debug)]
pub struct Tristimulus {
    range: SpectralRange,
    /// XYZ to the three numbers, and back.
    from_xyz: [Triple; 3],
    to_xyz: [Triple; 3],
    normalisation: Normalisation,
    wavelengths_nm: Triple,
}

impl Tristimulus {
    /// Computation in linear RGB with the primaries of a system.
    #[must_use]
    pub fn rgb(system: &RgbSystem, normalisation: Normalisation, range: SpectralRange) -> Self {
        let equal_energy = [1.0 / 3.0; 2];
        let moved = match normalisation {
            Normalisation::White => {
                RgbSystem::new(&system.name, system.primaries, equal_energy, Transfer::Linear)
            }
            _ => None,
        };
        let system = moved.as_ref().unwrap_or(system);
        Self::new(system.from_xyz_rows(), system.to_xyz_rows(), normalisation, range)
    }

    /// Computation in XYZ, each function scaled to area 1.
    #[must_use]
    pub fn xyz(range: SpectralRange) -> Self {
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Self::new(identity, identity, Normalisation::Area, range)
    }

    fn new(
        from_xyz: [Triple; 3],
        to_xyz: [Triple; 3],
        normalisation: Normalisation,
        range: SpectralRange,
    ) -> Self {
        let observer = Observer::cie_1931_2deg();
        // The centroid of what a function has above zero stands for its wavelength.
        let wavelengths_nm = from_xyz.map(|row| {
            let at = |w| row.iter().zip(&observer.matching).map(|(c, m)| c * m.at(w)).sum::<f64>().max(0.0);
            let (sum, moment) = range.wavelengths().fold((0.0, 0.0), |(s, m), w| (s + at(w), m + w * at(w)));
            if sum > 0.0 { moment / sum } else { f64::midpoint(range.min_nm.into(), range.max_nm.into()) }
        });
        Self { range, from_xyz, to_xyz, normalisation, wavelengths_nm }
    }

    /// The three numbers of XYZ.
    fn components(&self, xyz: Triple) -> Triple {
        self.from_xyz.map(|row| row.iter().zip(xyz).map(|(c, v)| c * v).sum())
    }

    fn sums(&self, curve: &Curve) -> Triple {
        Observer::cie_1931_2deg().xyz(curve, self.range).map(|v| v / LUMINOUS_EFFICACY)
    }
}

impl Basis for Tristimulus {
    fn len(&self) -> usize {
        3
    }

    fn wavelength_nm(&self, sample: usize) -> f64 {
        self.wavelengths_nm[sample]
    }

    fn is_spectral(&self) -> bool {
        false
    }

    fn reduce(&self, curve: &Curve, role: Role) -> Vec<f64> {
        let found = match role {
            Role::Constant => return self.wavelengths_nm.iter().map(|&w| curve.at(w)).collect(),
            Role::Emission => {
                let exact = self.components(self.sums(curve));
                let shown = exact.map(|v| v.max(0.0));
                let luminance = |c: Triple| -> f64 { self.to_xyz[1].iter().zip(c).map(|(m, v)| m * v).sum() };
                let scale = if luminance(shown) > 0.0 { luminance(exact) / luminance(shown) } else { 0.0 };
                shown.map(|v| v * scale)
            }
            Role::Fraction => {
                let mirror = self.sums(&Curve::constant(1.0));
                let colour = self.components(self.sums(curve));
                let unit = match self.normalisation {
                    Normalisation::Luminance => [mirror[1]; 3],
                    // With the white moved the three areas agree but for rounding in the tables.
                    Normalisation::White | Normalisation::Area => self.components(mirror),
                };
                std::array::from_fn(|i| (colour[i] / unit[i]).max(0.0))
            }
        };
        found.to_vec()
    }

    fn to_xyz(&self, _lamp: usize) -> ToXyz {
        self.to_xyz.map(|row| row.iter().map(|v| LUMINOUS_EFFICACY * v).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mirror_is_one_only_with_the_remedies_of_the_book() {
        let range = SpectralRange::default();
        let ntsc = RgbSystem::new(
            "NTSC",
            [[0.67, 0.33], [0.21, 0.71], [0.14, 0.08]],
            [0.313, 0.329],
            Transfer::Gamma(2.2),
        )
        .unwrap();
        let mirror = |basis: &Tristimulus| basis.reduce(&Curve::constant(1.0), Role::Fraction);
        let plain = mirror(&Tristimulus::rgb(&ntsc, Normalisation::Luminance, range));
        for (found, printed) in plain.iter().zip([1.12, 0.96, 0.92]) {
            assert!((found - printed).abs() < 6e-3, "{plain:?}");
        }
        for basis in [
            Tristimulus::rgb(&ntsc, Normalisation::White, range),
            Tristimulus::rgb(&ntsc, Normalisation::Area, range),
            Tristimulus::xyz(range),
        ] {
            assert!(mirror(&basis).iter().all(|v| (v - 1.0).abs() < 1e-12), "{:?}", mirror(&basis));
        }
    }

    #[test]
    fn light_keeps_its_colour() {
        let range = SpectralRange::default();
        let lamp = illuminant_spectrum::daylight(5000.0).unwrap();
        let system = RgbSystem::named("sRGB").unwrap();
        for normalisation in [Normalisation::Luminance, Normalisation::White, Normalisation::Area] {
            let basis = Tristimulus::rgb(&system, normalisation, range);
            let values = basis.reduce(&lamp, Role::Emission);
            let exact = Observer::cie_1931_2deg().xyz(&lamp, range);
            for (row, exact) in basis.to_xyz(0).iter().zip(exact) {
                let sum: f64 = row.iter().zip(&values).map(|(w, v)| w * v).sum();
                assert!((sum / exact - 1.0).abs() < 1e-12);
            }
        }
    }
}
