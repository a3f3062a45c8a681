//! Discrete lobes: mirror direction and smooth refraction, each drawn as often as it should be.
//!
//! A lobe of weight w that is drawn with probability p must come with the weight w / p; so the model's own
//! numbers say p = w / (w / p), and the draws are counted against it.

use crate::chi_square::{pearson, survival};
use crate::random::Random;
use crate::site::{Site, double};
use illuminant_illumination::IlluminationModel;

/// A discrete lobe as it was drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobe {
    /// Its direction.
    pub direction: [f64; 3],
    /// Whether it lies on the other side.
    pub transmitted: bool,
    /// How often it was drawn.
    pub observed: u64,
    /// The mean, over the draws, of its weight over the weight of the draw: its probability.
    pub probability: f64,
}

/// What the draws were.
#[derive(Clone, Debug, PartialEq)]
pub struct Lobes {
    /// Every lobe of the model.
    pub lobes: Vec<Lobe>,
    /// Draws without a direction.
    pub ended: u64,
    /// Draws of a discrete direction that is no lobe of the model (further than 10⁻⁴ from each).
    pub unknown: u64,
    /// The chance of counts so far from the probabilities (chi-square); 0 when a draw was unknown.
    pub p_value: f64,
}

/// Counts the discrete lobes that a model draws. Lobes whose weight is zero in the first lane carried are not
/// expected.
///
/// ```
/// use illuminant_illumination::{Dielectric, Finish, General, Spectral};
/// use illuminant_verify::{discrete::frequencies, site::Site};
/// let smooth = Dielectric::new(false, &Finish::MIRROR, &Spectral::monochromatic(550.0));
/// let glass = General::<4>::Dielectric(smooth);
/// let found = frequencies(&glass, &Site::new(1.0, 1.5), [0.0, 0.0, 1.0], 10_000, 0);
/// assert!((found.lobes[0].probability - 0.04).abs() < 1e-6 && found.p_value > 0.01);
/// ```
#[must_use]
pub fn frequencies<const N: usize>(
    model: &impl IlluminationModel<N>,
    site: &Site<N>,
    to_viewer: [f64; 3],
    samples: u64,
    seed: u64,
) -> Lobes {
    let at = site.incidence(to_viewer);
    let lane = site.lanes().next().unwrap_or(0);
    let known = model.discrete_lobes(&at);
    let mut lobes: Vec<Lobe> = known
        .iter()
        .map(|lobe| Lobe {
            direction: double(lobe.direction),
            transmitted: lobe.transmitted,
            observed: 0,
            probability: 0.0,
        })
        .collect();
    let (mut ended, mut unknown) = (0, 0);
    let mut random = Random::new(seed);
    for _ in 0..samples {
        let Some(drawn) = model.sample(&at, random.singles(), Some(lane)) else {
            ended += 1;
            continue;
        };
        if drawn.pdf.is_some() {
            continue;
        }
        let same = |i: &usize| {
            known[*i].transmitted == drawn.transmitted
                && (known[*i].direction - drawn.direction).length() < 1e-4
        };
        match (0..known.len()).find(same) {
            Some(i) => {
                lobes[i].observed += 1;
                lobes[i].probability += f64::from(known[i].weight[lane]) / f64::from(drawn.weight[lane]);
            }
            None => unknown += 1,
        }
    }
    for lobe in &mut lobes {
        lobe.probability /= lobe.observed.max(1) as f64;
    }
    let n = samples as f64;
    let mut cells: Vec<(f64, f64)> =
        lobes.iter().map(|lobe| (lobe.probability * n, lobe.observed as f64)).collect();
    let rest = 1.0 - lobes.iter().map(|lobe| lobe.probability).sum::<f64>();
    let drawn: u64 = lobes.iter().map(|lobe| lobe.observed).sum();
    cells.push((rest.max(0.0) * n, (samples - drawn) as f64));
    let (statistic, freedom) = pearson(cells, 5.0);
    let p_value = if unknown > 0 || !statistic.is_finite() { 0.0 } else { survival(statistic, freedom) };
    Lobes { lobes, ended, unknown, p_value }
}
