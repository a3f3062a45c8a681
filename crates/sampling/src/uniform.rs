//! `uniform:N`: N wavelengths, evenly spaced.

use crate::{Basis, Role, ToXyz};
use illuminant_spectrum::{Curve, LUMINOUS_EFFICACY, Observer, SpectralRange};

/// N wavelengths at the centres of N equal bands.
///
/// The map to XYZ integrates the straight lines between the samples (held beyond the first and last) against the
/// matching functions at 1 nm, so flat spectra are exact and smooth ones err with the square of the spacing.
#[derive(Clone, Debug)]
pub struct Uniform {
    range: SpectralRange,
    wavelengths_nm: Vec<f64>,
}

impl Uniform {
    /// N wavelengths over a range; N is at least 1.
    #[must_use]
    pub fn new(n: usize, range: SpectralRange) -> Self {
        let first = f64::from(range.min_nm) - 0.5;
        let spacing = range.width_nm() / n.max(1) as f64;
        let wavelengths_nm = (0..n.max(1)).map(|i| first + (i as f64 + 0.5) * spacing).collect();
        Self { range, wavelengths_nm }
    }
}

impl Basis for Uniform {
    fn len(&self) -> usize {
        self.wavelengths_nm.len()
    }

    fn wavelength_nm(&self, sample: usize) -> f64 {
        self.wavelengths_nm[sample]
    }

    fn reduce(&self, curve: &Curve, _role: Role) -> Vec<f64> {
        self.wavelengths_nm.iter().map(|&w| curve.at(w)).collect()
    }

    fn to_xyz(&self, _lamp: usize) -> ToXyz {
        let observer = Observer::cie_1931_2deg();
        let mut map: ToXyz = std::array::from_fn(|_| vec![0.0; self.len()]);
        let last = self.len() - 1;
        for w in self.range.wavelengths() {
            let upper = self.wavelengths_nm.partition_point(|&s| s <= w);
            let (low, high) = (upper.saturating_sub(1), upper.min(last));
            let t = if low == high || upper == 0 {
                0.0
            } else {
                (w - self.wavelengths_nm[low]) / (self.wavelengths_nm[high] - self.wavelengths_nm[low])
            };
            for (row, matching) in map.iter_mut().zip(&observer.matching) {
                let weight = LUMINOUS_EFFICACY * matching.at(w);
                row[low] += (1.0 - t) * weight;
                row[high] += t * weight;
            }
        }
        map
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_and_straight_spectra_are_exact_or_nearly_so() {
        let range = SpectralRange::default();
        let observer = Observer::cie_1931_2deg();
        let line =
            Curve::new(vec![300.0, 900.0], vec![0.0, 1.0], illuminant_spectrum::Outside::Hold).unwrap();
        for n in [4, 8, 13, 32] {
            let basis = Uniform::new(n, range);
            for (curve, tolerance) in [(Curve::constant(1.0), 1e-12), (line.clone(), 0.15 / (n * n) as f64)] {
                let values = basis.reduce(&curve, Role::Emission);
                let exact = observer.xyz(&curve, range);
                for (row, exact) in basis.to_xyz(0).iter().zip(exact) {
                    let sum: f64 = row.iter().zip(&values).map(|(w, v)| w * v).sum();
                    assert!((sum / exact - 1.0).abs() < tolerance, "{n}: {sum} against {exact}");
                }
            }
        }
    }
}
