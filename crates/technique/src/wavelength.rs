//! The wavelength that a path carries for itself where a scene disperses light.
//!
//! Behind a prism a few fixed wavelengths would show as stripes. So each path carries one more, drawn by importance: with
//! a density p(λ) in proportion to what the lamps send and the eye sees there. Its light counts 1/p(λ). The wavelengths
//! are [`COUNT`] quantiles of p, finer than the 1 nm to which spectra are tabulated wherever the eye sees much; a pixel
//! goes through them by a stride near the golden section, so that any run of its samples is spread over the spectrum.

use illuminant_sampling::{Basis, Role, ToXyz};
use illuminant_scene::Scene;
use illuminant_spectrum::{Curve, LUMINOUS_EFFICACY, Observer, SpectralRange};

/// How many wavelengths there are to choose from.
const COUNT: usize = 1024;

/// The part of the density that is spread evenly over the range, so that no wavelength is without a chance.
const EVEN: f64 = 0.25;

/// A wavelength, and the width in nm of the spectrum that it stands for: 1/p, about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wavelength {
    pub nm: f64,
    pub width_nm: f64,
}

impl Wavelength {
    /// The map to XYZ of what it brings, as the last of `samples` + 1 samples.
    pub fn to_xyz(self, samples: usize) -> ToXyz {
        Observer::cie_1931_2deg().matching.each_ref().map(|m| {
            let mut row = vec![0.0; samples + 1];
            row[samples] = LUMINOUS_EFFICACY * m.at(self.nm) * self.width_nm;
            row
        })
    }
}

/// The wavelengths for a scene; `None` where nothing disperses, or the samples are all wavelengths already or none.
pub(crate) fn wavelengths(scene: &Scene, basis: &dyn Basis) -> Option<Vec<Wavelength>> {
    let range = scene.range;
    let disperses = scene.objects.iter().any(|object| scene.materials[object.material].disperses(range));
    (disperses && basis.is_spectral() && basis.len() < range.len()).then(|| {
        let lamps: Vec<&Curve> = scene.lamps.iter().map(|lamp| &lamp.spectrum).collect();
        quantiles(&density(&lamps, range), range)
    })
}

/// p(λ) for the cell of 1 nm around each wavelength of the range, with sum 1.
fn density(lamps: &[&Curve], range: SpectralRange) -> Vec<f64> {
    let observer = Observer::cie_1931_2deg();
    let mut density = vec![0.0; range.len()];
    for lamp in lamps {
        let luminance = observer.luminance(lamp, range);
        if luminance > 0.0 {
            for (p, w) in density.iter_mut().zip(range.wavelengths()) {
                // The mean over the cell: beside a line its flank counts.
                let light = 0.25 * (lamp.at(w - 0.5) + 2.0 * lamp.at(w) + lamp.at(w + 0.5));
                *p += light / luminance * observer.matching.iter().map(|m| m.at(w)).sum::<f64>();
            }
        }
    }
    let total: f64 = density.iter().sum();
    let even = 1.0 / density.len() as f64;
    let shares =
        density.iter().map(|p| if total > 0.0 { EVEN * even + (1.0 - EVEN) * p / total } else { even });
    shares.collect()
}

/// The middles of [`COUNT`] parts of equal probability. Each stands for the width of its part, [`COUNT`] times over, so
/// that together they integrate a flat spectrum exactly.
fn quantiles(density: &[f64], range: SpectralRange) -> Vec<Wavelength> {
    let (mut below, mut cell) = (0.0, 0);
    // Where the probability of all shorter wavelengths is u, in nm; cells reach half a nm to both sides.
    let mut place = |u: f64| {
        while cell + 1 < density.len() && below + density[cell] <= u {
            below += density[cell];
            cell += 1;
        }
        f64::from(range.min_nm) - 0.5 + cell as f64 + ((u - below) / density[cell]).clamp(0.0, 1.0)
    };
    let borders: Vec<f64> = (0..=COUNT).map(|k| place(k as f64 / COUNT as f64)).collect();
    borders
        .windows(2)
        .map(|part| Wavelength {
            nm: f64::midpoint(part[0], part[1]).clamp(range.min_nm.into(), range.max_nm.into()),
            width_nm: COUNT as f64 * (part[1] - part[0]),
        })
        .collect()
}

/// A basis, and one wavelength more as its last sample. The map to XYZ leaves that sample out: it counts only once it has
/// been dispersed, by [`Wavelength::to_xyz`].
#[derive(Debug)]
pub(crate) struct Accompanied<'a> {
    basis: &'a dyn Basis,
    wavelength: Wavelength,
}

impl<'a> Accompanied<'a> {
    pub fn new(basis: &'a dyn Basis, wavelength: Wavelength) -> Self {
        Self { basis, wavelength }
    }
}

impl Basis for Accompanied<'_> {
    fn len(&self) -> usize {
        self.basis.len() + 1
    }

    fn wavelength_nm(&self, sample: usize) -> f64 {
        if sample < self.basis.len() { self.basis.wavelength_nm(sample) } else { self.wavelength.nm }
    }

    fn reduce(&self, curve: &Curve, role: Role) -> Vec<f64> {
        let mut values = self.basis.reduce(curve, role);
        values.push(curve.at(self.wavelength.nm));
        values
    }

    fn to_xyz(&self, lamp: usize) -> ToXyz {
        let mut map = self.basis.to_xyz(lamp);
        map.iter_mut().for_each(|row| row.push(0.0));
        map
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_wavelengths_integrate_light_as_1_nm_does() {
        let range = SpectralRange::default();
        let day = illuminant_spectrum::daylight(6504.0).unwrap();
        let line = Curve::new(
            vec![500.0, 545.0, 546.0, 547.0, 600.0],
            vec![0.0, 0.1, 5.0, 0.1, 0.0],
            illuminant_spectrum::Outside::Zero,
        );
        let (line, exact_to) = (line.unwrap(), 2e-3);
        for lamps in [vec![&day], vec![&line], vec![&day, &line]] {
            let all = quantiles(&density(&lamps, range), range);
            assert_eq!(all.len(), COUNT);
            for lamp in lamps {
                let exact = Observer::cie_1931_2deg().xyz(lamp, range);
                for (i, exact) in exact.iter().enumerate() {
                    let sum: f64 = all.iter().map(|w| w.to_xyz(0)[i][0] * lamp.at(w.nm)).sum();
                    assert!((sum / COUNT as f64 / exact - 1.0).abs() < exact_to, "{sum} {exact}");
                }
            }
        }
    }
}
