//! Tristimulus values of many spectra at once: the sum over wavelengths as one matrix, n bands to three values.
//!
//! A spectrum known at n wavelengths ("bands") is a curve of straight lines, so its 1 nm sums with the matching
//! functions are linear in its n values: XYZ_c = k Σ_nm S(λ) c̄(λ) Σ_i h_i(λ) v_i, where h_i is the hat of band i and
//! S the illuminant (1 without). The weights k Σ_nm S c̄ h_i are found once and serve every pixel. For the same
//! numbers they give the same result as the sum over a [`Curve`] (book 3.3; the house's rule of 1 nm), to rounding.

use crate::Real;
use illuminant_spectrum::{Curve, CurveError, LUMINOUS_EFFICACY, Outside, SpectralRange};
use thiserror::Error;

/// How a spectrum runs between its bands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// In straight lines, summed at every nm of the range.
    Linear,
    /// Not at all: each band stands for its own width, half the distance to its neighbours on either side, and the
    /// matching functions are read at the bands. For equal steps this is the sum Σ S c̄ v Δλ of CIE 15.
    Bands,
}

/// The factor k.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// A spectrum of 1 at every wavelength has Y = 1: a perfect diffuser under the illuminant.
    Relative,
    /// 683 lm/W: a radiance gives cd/m².
    Absolute,
}

/// Why there are no weights.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum WeightsError {
    /// The bands are not wavelengths in increasing order.
    #[error(transparent)]
    Bands(#[from] CurveError),
    /// Illuminant and ȳ have no wavelength in common within the range.
    #[error("the illuminant has no luminance within the range, so there is no white to relate to")]
    Dark,
}

/// Weights from the bands of a spectrum to X, Y and Z.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectralWeights {
    rows: [Vec<f64>; 3],
    /// The same weights in the order in which the sums need them: of X, Y and Z for each group of bands.
    groups: Vec<[[[f64; LANES]; 3]; 2]>,
}

/// Bands in a vector. A group is two of them, each with its own sums, which keeps a processor's multipliers busy.
const LANES: usize = 4;
const GROUP: usize = 2 * LANES;

impl SpectralWeights {
    /// Weights for spectra known at `bands_nm`.
    ///
    /// `outside` is what a spectrum is worth beyond its bands. It has no meaning for [`Interpolation::Bands`], nor has
    /// `range`, but that bands outside of it count nothing.
    ///
    /// # Errors
    /// [`WeightsError`] when the bands are fewer than two or do not increase, or nothing of the illuminant is seen.
    ///
    /// ```
    /// use illuminant_color::{Interpolation, Scale, SpectralWeights};
    /// use illuminant_spectrum::{Observer, Outside, SpectralRange};
    /// let matching = &Observer::cie_1931_2deg().matching;
    /// let (range, outside) = (SpectralRange::default(), Outside::Hold);
    /// let weights = SpectralWeights::new(
    ///     &[400.0, 700.0], matching, None, range, outside, Interpolation::Linear, Scale::Relative,
    /// ).unwrap();
    /// let mut xyz = [0.0f64; 3];
    /// weights.xyz(&[1.0, 1.0], &mut xyz);
    /// assert!((xyz[1] - 1.0).abs() < 1e-12);
    /// ```
    pub fn new(
        bands_nm: &[f64],
        matching: &[Curve; 3],
        illuminant: Option<&Curve>,
        range: SpectralRange,
        outside: Outside,
        interpolation: Interpolation,
        scale: Scale,
    ) -> Result<Self, WeightsError> {
        // The checks of a curve are those of the bands.
        Curve::new(bands_nm.to_vec(), vec![0.0; bands_nm.len()], outside)?;
        let power = |w: f64| illuminant.map_or(1.0, |curve| curve.at(w));
        let mut rows = [0, 1, 2].map(|_| vec![0.0; bands_nm.len()]);
        let mut luminance = 0.0;
        let mut add = |wavelength: f64, share: f64, hats: &[(usize, f64)]| {
            let product = [0, 1, 2].map(|c| matching[c].at(wavelength) * power(wavelength) * share);
            luminance += product[1];
            for (row, value) in rows.iter_mut().zip(product) {
                for &(band, hat) in hats {
                    row[band] += value * hat;
                }
            }
        };
        let last = bands_nm.len() - 1;
        match interpolation {
            Interpolation::Linear => {
                for w in range.wavelengths() {
                    if w < bands_nm[0] || w > bands_nm[last] {
                        let end = if w < bands_nm[0] { 0 } else { last };
                        add(w, 1.0, &[(end, f64::from(u8::from(outside == Outside::Hold)))]);
                    } else {
                        let upper = bands_nm.partition_point(|&band| band <= w).clamp(1, last);
                        let t = (w - bands_nm[upper - 1]) / (bands_nm[upper] - bands_nm[upper - 1]);
                        add(w, 1.0, &[(upper - 1, 1.0 - t), (upper, t)]);
                    }
                }
            }
            Interpolation::Bands => {
                for (band, &w) in bands_nm.iter().enumerate() {
                    let before = if band > 0 { w - bands_nm[band - 1] } else { bands_nm[1] - w };
                    let after = if band < last { bands_nm[band + 1] - w } else { before };
                    if (f64::from(range.min_nm)..=f64::from(range.max_nm)).contains(&w) {
                        add(w, f64::midpoint(before, after), &[(band, 1.0)]);
                    }
                }
            }
        }
        let factor = match scale {
            Scale::Absolute => LUMINOUS_EFFICACY,
            Scale::Relative if luminance > 0.0 => 1.0 / luminance,
            Scale::Relative => return Err(WeightsError::Dark),
        };
        for weight in rows.iter_mut().flatten() {
            *weight *= factor;
        }
        let vector = |c: usize, from: usize| std::array::from_fn(|lane| rows[c][from + lane]);
        let group = |g: usize| [0, 1].map(|half| [0, 1, 2].map(|c| vector(c, g * GROUP + half * LANES)));
        let groups = (0..bands_nm.len() / GROUP).map(group).collect();
        Ok(Self { rows, groups })
    }

    /// How many bands a spectrum has.
    #[must_use]
    pub fn bands(&self) -> usize {
        self.rows[0].len()
    }

    /// The weights of X, Y and Z, each with one number for each band.
    #[must_use]
    pub fn rows(&self) -> &[Vec<f64>; 3] {
        &self.rows
    }

    /// XYZ of spectra that follow one another, n values each, spread over threads; three values each come out.
    ///
    /// Sums are in f64 and in a fixed order, whatever the width of the input and the number of threads.
    ///
    /// # Panics
    /// When the lengths do not fit: a slip of the programmer, never of the data.
    pub fn xyz<T: Real>(&self, spectra: &[T], xyz: &mut [T]) {
        let n = self.bands();
        assert!(spectra.len() % n == 0 && spectra.len() / n * 3 == xyz.len(), "n values in, three out");
        // Some hundred kilobytes of input are a piece of work.
        let pixels = (65_536 / n).max(1);
        crate::threads::each_piece(spectra, xyz, pixels * n, pixels * 3, |spectra, xyz| {
            self.run(spectra, xyz);
        });
    }

    /// One spectrum after the other: to share the reading of the weights among some would mean to read from some
    /// places at once, and the memory is several times slower at that.
    fn run<T: Real>(&self, spectra: &[T], xyz: &mut [T]) {
        let n = self.bands();
        let whole = n / GROUP * GROUP;
        let rows = self.rows.each_ref().map(|row| &row[whole..]);
        for (spectrum, xyz) in spectra.chunks_exact(n).zip(xyz.chunks_exact_mut(3)) {
            let (groups, rest) = spectrum.split_at(whole);
            let mut sums = [[[0.0; LANES]; 3]; 2];
            add(&mut sums, groups, &self.groups);
            let [first, second] = &sums;
            for c in 0..3 {
                let (a, b) = (&first[c], &second[c]);
                let mut total = ((a[0] + b[0]) + (a[2] + b[2])) + ((a[1] + b[1]) + (a[3] + b[3]));
                for (value, weight) in rest.iter().zip(rows[c]) {
                    total = value.f64().mul_add(*weight, total);
                }
                xyz[c] = T::of(total);
            }
        }
    }
}

/// The sums of the products of whole groups of bands: one for each half of a group, each of X, Y and Z, and lane.
///
/// Never inlined: beside the code that adds the lanes up, the compiler would choose vectors across them.
#[inline(never)]
fn add<T: Real>(sums: &mut [[[f64; LANES]; 3]; 2], bands: &[T], groups: &[[[[f64; LANES]; 3]; 2]]) {
    let mut partial = [[[0.0; LANES]; 3]; 2];
    for (bands, weights) in bands.chunks_exact(GROUP).zip(groups) {
        for (half, (sums, weights)) in partial.iter_mut().zip(weights).enumerate() {
            let bands = &bands[half * LANES..(half + 1) * LANES];
            let values = [bands[0].f64(), bands[1].f64(), bands[2].f64(), bands[3].f64()];
            for (sum, weight) in sums.iter_mut().zip(weights) {
                for lane in 0..LANES {
                    sum[lane] = values[lane].mul_add(weight[lane], sum[lane]);
                }
            }
        }
    }
    *sums = partial;
}

#[cfg(test)]
mod tests {
    use super::*;
    use illuminant_spectrum::Observer;

    fn weights(bands: &[f64], lamp: Option<&Curve>, outside: Outside, scale: Scale) -> SpectralWeights {
        let matching = &Observer::cie_1931_2deg().matching;
        let range = SpectralRange::default();
        SpectralWeights::new(bands, matching, lamp, range, outside, Interpolation::Linear, scale).unwrap()
    }

    #[test]
    fn weights_give_the_sums_of_the_curve() {
        let bands: Vec<f64> = (0..33).map(|i| 401.5 + 10.0 * f64::from(i)).collect();
        let values: Vec<f64> = (0..33).map(|i| 0.5 + 0.4 * f64::from(i).sin()).collect();
        let observer = Observer::cie_1931_2deg();
        let lamp = illuminant_spectrum::daylight(6504.0).unwrap();
        for outside in [Outside::Zero, Outside::Hold] {
            let curve = Curve::new(bands.clone(), values.clone(), outside).unwrap();
            let range = SpectralRange::default();
            let pairs = [
                (observer.xyz(&curve, range), weights(&bands, None, outside, Scale::Absolute)),
                (
                    observer.relative_xyz(&curve, &lamp, range),
                    weights(&bands, Some(&lamp), outside, Scale::Relative),
                ),
            ];
            for (wanted, weights) in pairs {
                let mut found = [0.0; 3];
                weights.xyz(&values, &mut found);
                for (a, b) in found.iter().zip(wanted) {
                    assert!((a / b - 1.0).abs() < 1e-12, "{found:?} {wanted:?}");
                }
            }
        }
    }

    #[test]
    fn many_spectra_are_each_summed_as_if_alone() {
        let bands: Vec<f64> = (0..81).map(|i| 380.0 + 5.0 * f64::from(i)).collect();
        let weights = weights(&bands, None, Outside::Zero, Scale::Relative);
        let spectra: Vec<f64> = (0..81 * 4001).map(|i| f64::from(i % 997) / 997.0).collect();
        let mut all = vec![0.0; 3 * 4001];
        weights.xyz(&spectra, &mut all);
        for pixel in [0, 1, 808, 809, 4000] {
            let mut alone = [0.0; 3];
            weights.xyz(&spectra[pixel * 81..(pixel + 1) * 81], &mut alone);
            assert_eq!(alone, all[3 * pixel..3 * pixel + 3]);
        }
    }

    #[test]
    fn what_has_no_weights_is_refused() {
        let matching = &Observer::cie_1931_2deg().matching;
        let new = |bands: &[f64], lamp: Option<&Curve>| {
            let range = SpectralRange::default();
            SpectralWeights::new(
                bands,
                matching,
                lamp,
                range,
                Outside::Zero,
                Interpolation::Bands,
                Scale::Relative,
            )
        };
        assert!(matches!(new(&[500.0], None), Err(WeightsError::Bands(_))));
        assert!(matches!(new(&[500.0, 400.0], None), Err(WeightsError::Bands(_))));
        assert_eq!(new(&[400.0, 500.0], Some(&Curve::constant(0.0))), Err(WeightsError::Dark));
    }
}
