//! What a spectral sampling costs in colour.

use crate::{Basis, Products, Role, xyz_by};
use illuminant_color::{Lab, Triple, delta_e_2000};
use rayon::prelude::*;

/// A colour as it is and as a sampling makes it.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// XYZ integrated at 1 nm.
    pub exact: Triple,
    /// XYZ by the sampling.
    pub sampled: Triple,
    /// XYZ of the white beside which it is seen.
    pub white: Triple,
    /// How much it counts in the mean.
    pub weight: f64,
    /// The lamp that gives most of its light, as an index.
    pub lamp: usize,
    /// The materials that made it, as indices.
    pub materials: Vec<usize>,
}

impl Comparison {
    /// ΔE00 between the two.
    #[must_use]
    pub fn delta_e(&self) -> f64 {
        delta_e_2000(Lab::from_xyz(self.exact, self.white), Lab::from_xyz(self.sampled, self.white))
    }

    /// The same colour lit so that its Y is half that of the white.
    #[must_use]
    pub fn lit_to_half(mut self) -> Self {
        let scale = 0.5 * self.white[1] / self.exact[1];
        self.exact = self.exact.map(|v| v * scale);
        self.sampled = self.sampled.map(|v| v * scale);
        self
    }
}

/// The ΔE00 of a sampling against 1 nm, over many colours.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpectralError {
    /// Weighted mean.
    pub mean: f64,
    /// 95th percentile.
    pub p95: f64,
    /// Largest.
    pub max: f64,
    /// The lamp of the largest, as an index.
    pub lamp: usize,
    /// The materials of the largest, as indices.
    pub materials: Vec<usize>,
    /// How many colours were judged, black ones left out: with none the error says nothing.
    pub judged: usize,
}

impl SpectralError {
    /// The error over a list of colours; zero for none.
    #[must_use]
    pub fn over(found: &[Comparison]) -> Self {
        let mut errors: Vec<(f64, &Comparison)> = found.iter().map(|c| (c.delta_e(), c)).collect();
        errors.sort_by(|a, b| a.0.total_cmp(&b.0));
        let total: f64 = errors.iter().map(|(_, c)| c.weight).sum();
        let Some(&(max, worst)) = errors.last() else { return Self::default() };
        if !(total > 0.0) {
            return Self::default();
        }
        let mean = errors.iter().map(|(e, c)| e * c.weight).sum::<f64>() / total;
        let mut sum = 0.0;
        let p95 = errors.iter().find(|(_, c)| {
            sum += c.weight;
            sum >= 0.95 * total
        });
        let p95 = p95.map_or(max, |(e, _)| *e);
        let judged = found.iter().filter(|c| c.exact[1] > 0.0).count();
        Self { mean, p95, max, lamp: worst.lamp, materials: worst.materials.clone(), judged }
    }
}

/// The colours of products of reflectances, at 1 nm and by a sampling.
///
/// Every curve is reduced by itself and the lanes are multiplied, as a renderer does. Only products of known
/// factors are compared.
#[must_use]
pub fn compare(basis: &dyn Basis, products: &Products) -> Vec<Comparison> {
    let fractions: Vec<_> = products.reflectances.iter().map(|r| basis.reduce(r, Role::Fraction)).collect();
    // A sampling knows the lamps that are here, not those it only makes ready for.
    let lamps: Vec<_> = (0..products.together.min(products.lamps.len()))
        .map(|lamp| {
            let light = basis.reduce(&products.lamps[lamp], Role::Emission);
            (light, basis.to_xyz(lamp), products.weights_of_lamp(lamp))
        })
        .collect();
    products
        .items
        .par_iter()
        .filter_map(|item| {
            let ([part], Some(factors)) = (item.parts.as_slice(), &item.factors) else { return None };
            let (light, map, weights) = lamps.get(part.lamp)?;
            let value = |i: usize| factors.iter().fold(light[i], |v, &m| v * fractions[m][i]);
            let lanes: Vec<f64> = (0..light.len()).map(value).collect();
            Some(Comparison {
                exact: xyz_by(weights, &part.filter),
                sampled: xyz_by(map, &lanes),
                white: item.white,
                weight: item.weight,
                lamp: part.lamp,
                materials: factors.clone(),
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{OneNanometre, Uniform};
    use illuminant_spectrum::{Curve, Outside, SpectralRange, daylight};

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
        let products = |lamps: &[Curve]| {
            let mut products = Products::new(range, lamps.to_vec()).unwrap();
            products.add_reflectances(std::slice::from_ref(&paint), 2, 100, 0);
            products
        };
        let error =
            |basis: &dyn Basis, lamps: &[Curve]| SpectralError::over(&compare(basis, &products(lamps)));
        assert!(error(&OneNanometre::new(range), std::slice::from_ref(&day)).max < 1e-9);
        let smooth = error(&Uniform::new(32, range), std::slice::from_ref(&day));
        let lines = error(&Uniform::new(32, range), &[day, line]);
        assert!(smooth.max < 0.5 && lines.max > 2.0 && lines.lamp == 1, "{smooth:?} {lines:?}");
    }
}
