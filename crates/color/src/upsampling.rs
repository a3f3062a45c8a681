//! From RGB back to a smooth spectrum: the sigmoid of Jakob and Hanika (2019).
//!
//! s(λ) = ½ + x / (2√(1 + x²)), x = c₀t² + c₁t + c₂, with t running from 0 to 1 over the spectral range. The
//! coefficients are found by Gauss–Newton on the residual in L\*a\*b\* under the system's white. RGB never enters
//! without its role: [`Upsampler::albedo`] gives a reflectance in [0, 1], [`Upsampler::emission`] a multiple of the
//! white. Grey stays exactly grey.

use crate::{Lab, RgbSystem, Triple, delta_e_2000};
use illuminant_spectrum::{Curve, Observer, Outside, SpectralRange};
use nalgebra::{Matrix3, Vector3};

/// The three coefficients of a sigmoid reflectance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sigmoid {
    /// c₀, c₁, c₂ of the polynomial in t.
    pub coefficients: Triple,
}

impl Sigmoid {
    /// The flat reflectance `value`, which may be 0 or 1.
    #[must_use]
    pub fn grey(value: f64) -> Self {
        // The inverse of the sigmoid, kept finite: 1e-9 from 0 or 1 no eye and no float tells apart.
        let v = value.clamp(1e-9, 1.0 - 1e-9);
        Self { coefficients: [0.0, 0.0, (v - 0.5) / (v * (1.0 - v)).sqrt()] }
    }

    /// The reflectance at t, the fraction of the way through the spectral range.
    #[must_use]
    pub fn at(&self, t: f64) -> f64 {
        let [c0, c1, c2] = self.coefficients;
        let x = (c0 * t + c1) * t + c2;
        0.5 + 0.5 * x / (1.0 + x * x).sqrt()
    }
}

/// Turns RGB of one system into spectra over one range.
#[derive(Clone, Debug)]
pub struct Upsampler {
    range: SpectralRange,
    system: RgbSystem,
    white_curve: Curve,
    white: Triple,
    /// t and the weights to XYZ of the white's light, at every 5 nm.
    samples: Vec<(f64, Triple)>,
}

impl Upsampler {
    /// An upsampler for an RGB system; the white's spectrum is [`RgbSystem::white_curve`].
    #[must_use]
    pub fn new(system: &RgbSystem, range: SpectralRange) -> Self {
        let observer = Observer::cie_1931_2deg();
        let curve = system.white_curve();
        let luminance = observer.luminance(&curve, range);
        let white_curve = curve.scaled(1.0 / luminance);
        let white = observer.xyz(&white_curve, range);
        const STEP: usize = 5;
        let wavelengths: Vec<f64> = range.wavelengths().collect();
        let mut samples: Vec<(f64, Triple)> = Vec::with_capacity(wavelengths.len() / STEP + 1);
        for cell in wavelengths.chunks(STEP) {
            let centre = (cell[0] + cell[cell.len() - 1]) / 2.0;
            let mut weight = [0.0; 3];
            for &w in cell {
                for (total, matching) in weight.iter_mut().zip(&observer.matching) {
                    *total += illuminant_spectrum::LUMINOUS_EFFICACY * matching.at(w) * white_curve.at(w);
                }
            }
            samples.push((position(range, centre), weight));
        }
        Self { range, system: system.clone(), white_curve, white, samples }
    }

    /// The reflectance whose colour under the system's white is `rgb`, each in [0, 1], and the ΔE00 of its round
    /// trip. `None` when a value lies outside [0, 1].
    #[must_use]
    pub fn albedo(&self, rgb: Triple) -> Option<(Curve, f64)> {
        if !rgb.iter().all(|v| (0.0..=1.0).contains(v)) {
            return None;
        }
        let sigmoid = self.fit(rgb);
        let values = self.range.wavelengths().map(|w| sigmoid.at(position(self.range, w))).collect();
        let curve = Curve::tabulated(self.range, values, Outside::Hold);
        let error = self.round_trip(rgb, |w| curve.at(w));
        Some((curve, error))
    }

    /// The emission of colour `rgb` ≥ 0, of any size, as a multiple of the system's white (the curve of RGB
    /// (1, 1, 1) has Y = 1 with K_m included), and the ΔE00 of its round trip. `None` when a value is negative.
    #[must_use]
    pub fn emission(&self, rgb: Triple) -> Option<(Curve, f64)> {
        if !rgb.iter().all(|v| *v >= 0.0 && v.is_finite()) {
            return None;
        }
        let (scale, sigmoid) = self.fit_unbounded(rgb);
        let shape = |w: f64| scale * sigmoid.at(position(self.range, w));
        let values = self.range.wavelengths().map(|w| shape(w) * self.white_curve.at(w)).collect();
        let error =
            if scale > 0.0 { self.round_trip(rgb.map(|v| v / scale), |w| shape(w) / scale) } else { 0.0 };
        Some((Curve::tabulated(self.range, values, Outside::Zero), error))
    }

    /// The spectrum of RGB (1, 1, 1) as emission: the white, with Y = 1 (K_m included).
    #[must_use]
    pub fn white_curve(&self) -> &Curve {
        &self.white_curve
    }

    /// A scale and a sigmoid whose product with the white has colour `rgb`, of any size.
    ///
    /// The scale is twice the largest component, so that the sigmoid stays smooth (pbrt-v4's rule); grey is flat.
    #[must_use]
    pub fn fit_unbounded(&self, rgb: Triple) -> (f64, Sigmoid) {
        let largest = rgb.iter().copied().fold(0.0, f64::max);
        if largest <= 0.0 {
            return (0.0, Sigmoid::default());
        }
        let scale = 2.0 * largest;
        (scale, self.fit(rgb.map(|v| v / scale)))
    }

    /// The sigmoid whose colour is `rgb` in [0, 1].
    #[must_use]
    pub fn fit(&self, rgb: Triple) -> Sigmoid {
        let [r, g, b] = rgb;
        if r == g && g == b {
            return Sigmoid::grey(r);
        }
        // Colours at the corners of the cube need infinite coefficients; a hair inside they are large but tame.
        self.gauss_newton(rgb.map(|v| v.clamp(1e-4, 1.0 - 1e-4)), Sigmoid::grey((r + g + b) / 3.0))
    }

    fn gauss_newton(&self, rgb: Triple, start: Sigmoid) -> Sigmoid {
        let target = self.lab_of(self.system.to_xyz(rgb));
        let residual = |sigmoid: &Sigmoid| {
            let lab = self.lab_of(self.xyz_of(|t| sigmoid.at(t)));
            Vector3::new(target.l - lab.l, target.a - lab.a, target.b - lab.b)
        };
        let mut best = start;
        let mut error = residual(&best);
        for _ in 0..40 {
            if error.norm_squared() < 1e-12 {
                break;
            }
            let mut jacobian = Matrix3::zeros();
            for column in 0..3 {
                let step = 1e-5 * (1.0 + best.coefficients[column].abs());
                let mut nudged = best;
                nudged.coefficients[column] += step;
                jacobian.set_column(column, &((residual(&nudged) - error) / step));
            }
            let Some(inverse) = jacobian.try_inverse() else { break };
            let full = inverse * error;
            // Halve the step until it improves: far from the goal the sigmoid saturates and a full step overshoots.
            let improved = (0..12).find_map(|halvings| {
                let step = full * 0.5f64.powi(halvings);
                let mut candidate = best;
                for (c, s) in candidate.coefficients.iter_mut().zip(step.iter()) {
                    *c = (*c - s).clamp(-1e4, 1e4);
                }
                let candidate_error = residual(&candidate);
                (candidate_error.norm_squared() < error.norm_squared())
                    .then_some((candidate, candidate_error))
            });
            let Some((next, next_error)) = improved else { break };
            (best, error) = (next, next_error);
        }
        best
    }

    fn xyz_of(&self, reflectance: impl Fn(f64) -> f64) -> Triple {
        let mut xyz = [0.0; 3];
        for (t, weight) in &self.samples {
            let value = reflectance(*t);
            for (sum, w) in xyz.iter_mut().zip(weight) {
                *sum += value * w;
            }
        }
        xyz
    }

    fn lab_of(&self, xyz: Triple) -> Lab {
        Lab::from_xyz(xyz, self.white)
    }

    /// ΔE00 between `rgb` and the colour of a reflectance under the white, at 1 nm.
    fn round_trip(&self, rgb: Triple, reflectance: impl Fn(f64) -> f64) -> f64 {
        let observer = Observer::cie_1931_2deg();
        let xyz = observer.xyz_of(self.range, |w| reflectance(w) * self.white_curve.at(w));
        delta_e_2000(self.lab_of(self.system.to_xyz(rgb)), self.lab_of(xyz))
    }
}

/// The fraction of the way through the range at which a wavelength lies.
fn position(range: SpectralRange, wavelength_nm: f64) -> f64 {
    (wavelength_nm - f64::from(range.min_nm)) / f64::from((range.max_nm - range.min_nm).max(1))
}

/// Sigmoids for a whole image: coefficients on a grid over the cube, interpolated (Jakob and Hanika 2019, §5).
///
/// The cube is split by its largest component; within each third the grid runs over that component and over the
/// ratios of the other two to it. Error of interpolation below ΔE00 0.5 for colours away from the corners.
#[derive(Clone, Debug)]
pub struct SigmoidTable {
    size: usize,
    levels: Vec<f64>,
    cells: Vec<[f32; 3]>,
}

impl SigmoidTable {
    /// Fits a table of 3 × `size`³ sigmoids, with the rows fitted by `map_rows` (so that a caller can spread them
    /// over threads).
    pub fn new(
        upsampler: &Upsampler,
        size: usize,
        map_rows: impl Fn(usize, &(dyn Fn(usize) -> Vec<[f32; 3]> + Sync)) -> Vec<Vec<[f32; 3]>>,
    ) -> Self {
        let last = (size - 1) as f64;
        let smoothstep = |x: f64| x * x * (3.0 - 2.0 * x);
        let levels: Vec<f64> = (0..size).map(|k| smoothstep(smoothstep(k as f64 / last))).collect();
        let row = |index: usize| {
            let (largest, y, x) = (index / (size * size), index / size % size, index % size);
            let mut cells = Vec::with_capacity(size);
            for &level in &levels {
                let mut rgb = [0.0; 3];
                rgb[largest] = level;
                rgb[(largest + 1) % 3] = x as f64 / last * level;
                rgb[(largest + 2) % 3] = y as f64 / last * level;
                let inside = rgb.map(|v| v.clamp(1e-4, 1.0 - 1e-4));
                let start = Sigmoid::grey(inside.iter().sum::<f64>() / 3.0);
                cells.push(upsampler.gauss_newton(inside, start).coefficients.map(|c| c as f32));
            }
            cells
        };
        let cells = map_rows(3 * size * size, &row).into_iter().flatten().collect();
        Self { size, levels, cells }
    }

    /// The sigmoid of `rgb` in [0, 1].
    #[must_use]
    pub fn sigmoid(&self, rgb: Triple) -> Sigmoid {
        let [r, g, b] = rgb;
        if r == g && g == b {
            return Sigmoid::grey(r);
        }
        let largest = if r > g {
            if r > b { 0 } else { 2 }
        } else if g > b {
            1
        } else {
            2
        };
        let z = rgb[largest];
        let last = (self.size - 1) as f64;
        let [x, y] = [1, 2].map(|i| rgb[(largest + i) % 3] / z * last);
        let cell = |v: f64| (v as usize).min(self.size - 2);
        let (xi, yi) = (cell(x), cell(y));
        let zi = self.levels.partition_point(|level| *level <= z).clamp(1, self.size - 1) - 1;
        let zt = ((z - self.levels[zi]) / (self.levels[zi + 1] - self.levels[zi])).clamp(0.0, 1.0);
        let (xt, yt) = (x - xi as f64, y - yi as f64);
        let mut coefficients = [0.0; 3];
        for (dx, wx) in [(0, 1.0 - xt), (1, xt)] {
            for (dy, wy) in [(0, 1.0 - yt), (1, yt)] {
                for (dz, wz) in [(0, 1.0 - zt), (1, zt)] {
                    let row = (largest * self.size + yi + dy) * self.size + xi + dx;
                    let found = self.cells[row * self.size + zi + dz];
                    for (c, f) in coefficients.iter_mut().zip(found) {
                        *c += wx * wy * wz * f64::from(f);
                    }
                }
            }
        }
        Sigmoid { coefficients }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn srgb() -> Upsampler {
        Upsampler::new(&RgbSystem::named("sRGB").unwrap(), SpectralRange::default())
    }

    #[test]
    fn grey_is_flat_and_exact() {
        let (curve, error) = srgb().albedo([0.5; 3]).unwrap();
        assert!(curve.values().iter().all(|v| (v - 0.5).abs() < 1e-12) && error < 0.02, "{error}");
        let (white, _) = srgb().albedo([1.0; 3]).unwrap();
        assert!(white.values().iter().all(|v| (v - 1.0).abs() < 1e-8));
    }

    #[test]
    fn colours_survive_the_round_trip() {
        let upsampler = srgb();
        for r in [0.05, 0.3, 0.9] {
            for g in [0.1, 0.5, 0.8] {
                for b in [0.02, 0.4, 0.95] {
                    let (curve, error) = upsampler.albedo([r, g, b]).unwrap();
                    assert!(error < 0.2, "{r} {g} {b}: {error}");
                    assert!(curve.values().iter().all(|v| (0.0..=1.0).contains(v)));
                }
            }
        }
    }

    #[test]
    fn emission_has_the_colour_and_size_of_its_rgb() {
        let upsampler = srgb();
        let system = RgbSystem::named("sRGB").unwrap();
        let (curve, error) = upsampler.emission([20.0, 5.0, 1.0]).unwrap();
        assert!(error < 0.2);
        let y = Observer::cie_1931_2deg().luminance(&curve, SpectralRange::default());
        assert!((y / system.to_xyz([20.0, 5.0, 1.0])[1] - 1.0).abs() < 5e-3, "{y}");
        assert!(
            upsampler.emission([-1.0, 0.0, 0.0]).is_none() && upsampler.albedo([1.1, 0.0, 0.0]).is_none()
        );
    }

    #[test]
    fn the_table_agrees_with_the_fit() {
        let upsampler = srgb();
        let table = SigmoidTable::new(&upsampler, 24, |rows, row| (0..rows).map(row).collect());
        let mut worst: f64 = 0.0;
        for r in [0.1, 0.33, 0.8] {
            for g in [0.15, 0.5, 0.7] {
                for b in [0.2, 0.45, 0.6] {
                    let sigmoid = table.sigmoid([r, g, b]);
                    let range = SpectralRange::default();
                    worst = worst.max(upsampler.round_trip([r, g, b], |w| sigmoid.at(position(range, w))));
                }
            }
        }
        assert!(worst < 0.5, "{worst}");
    }
}
