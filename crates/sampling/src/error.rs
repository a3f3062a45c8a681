//! What a spectral sampling costs in colour, found on the scene's own lamps and materials.

use crate::{Basis, Role};
use illuminant_color::{Lab, delta_e_2000};
use illuminant_spectrum::{Curve, Observer, SpectralRange};

/// The ΔE00 of a sampling against 1 nm, over the lamps and what one or two reflections make of their light.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpectralError {
    /// Mean ΔE00.
    pub mean: f64,
    /// 95th percentile.
    pub p95: f64,
    /// Largest ΔE00.
    pub max: f64,
    /// The lamp of the largest, as an index.
    pub lamp: usize,
    /// The materials of the largest: none for the lamp itself, else one or two indices.
    pub materials: Vec<usize>,
}

/// The error of `basis` on the products lamp × up to two of `reflectances`, each seen beside a perfect diffuser
/// under the same lamp (CIEDE2000 against integration at 1 nm).
#[must_use]
pub fn spectral_error(
    basis: &dyn Basis,
    range: SpectralRange,
    lamps: &[Curve],
    reflectances: &[Curve],
) -> SpectralError {
    let observer = Observer::cie_1931_2deg();
    let fine: Vec<Vec<f64>> = reflectances.iter().map(|c| c.tabulate(range)).collect();
    let coarse: Vec<Vec<f64>> = reflectances.iter().map(|c| basis.reduce(c, Role::Fraction)).collect();
    let matching = observer.matching.each_ref().map(|m| m.tabulate(range));
    let mut found: Vec<(f64, usize, Vec<usize>)> = Vec::new();
    for (lamp, curve) in lamps.iter().enumerate() {
        let light = curve.tabulate(range);
        let lanes = basis.reduce(curve, Role::Emission);
        let map = basis.to_xyz(lamp);
        let white = observer.xyz(curve, range);
        if white[1] <= 0.0 {
            continue;
        }
        let mut compare = |materials: Vec<usize>| {
            let product =
                |tables: &[Vec<f64>], i: usize| materials.iter().map(|&m| tables[m][i]).product::<f64>();
            let mut exact = [0.0; 3];
            for (i, &l) in light.iter().enumerate() {
                let value = illuminant_spectrum::LUMINOUS_EFFICACY * l * product(&fine, i);
                for (sum, m) in exact.iter_mut().zip(&matching) {
                    *sum += value * m[i];
                }
            }
            let mut sampled = [0.0; 3];
            for (i, &l) in lanes.iter().enumerate() {
                let value = l * product(&coarse, i);
                for (sum, row) in sampled.iter_mut().zip(&map) {
                    *sum += value * row[i];
                }
            }
            let difference = delta_e_2000(Lab::from_xyz(exact, white), Lab::from_xyz(sampled, white));
            found.push((difference, lamp, materials));
        };
        compare(vec![]);
        for a in 0..reflectances.len() {
            compare(vec![a]);
            for b in a..reflectances.len() {
                compare(vec![a, b]);
            }
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let Some((max, lamp, materials)) = found.last().cloned() else { return SpectralError::default() };
    let mean = found.iter().map(|f| f.0).sum::<f64>() / found.len() as f64;
    let p95 = found[(found.len() * 95 / 100).min(found.len() - 1)].0;
    SpectralError { mean, p95, max, lamp, materials }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{OneNanometre, Uniform};
    use illuminant_spectrum::{Outside, daylight};

    #[test]
    fn the_reference_has_no_error_and_lines_are_worse_than_daylight() {
        let range = SpectralRange::default();
        let paint = Curve::new(vec![400.0, 550.0, 700.0], vec![0.1, 0.3, 0.8], Outside::Hold).unwrap();
        let day = daylight(6504.0).unwrap();
        let line = Curve::new(
            vec![543.0, 545.5, 548.0, 610.0, 611.0, 612.0],
            vec![0.0, 1.0, 0.0, 0.0, 1.0, 0.0],
            Outside::Zero,
        )
        .unwrap();
        let paints = [paint];
        let exact = spectral_error(&OneNanometre::new(range), range, std::slice::from_ref(&day), &paints);
        assert!(exact.max < 1e-9);
        let smooth = spectral_error(&Uniform::new(32, range), range, std::slice::from_ref(&day), &paints);
        let lines = spectral_error(&Uniform::new(32, range), range, &[day, line], &paints);
        assert!(smooth.max < 0.5 && lines.max > 2.0 && lines.lamp == 1, "{smooth:?} {lines:?}");
    }
}
