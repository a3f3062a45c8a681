//! The share of light that a surface gives on: its directional albedo, by quadrature and by drawing.
//!
//! ρ(v) = ∫ f(v, l) |cos θ_l| dω_l + Σ discrete lobes, over the side of the viewer (reflected) and over the
//! other side (transmitted; there times (n_l / n_v)², which undoes the squeezing of radiance and leaves power).
//! By reciprocity this is the share of the power that arrives from v which leaves again: at most 1, and 1 where
//! nothing is absorbed (book eq 2.49). Drawing directions gives the same as the mean of their weights, if they
//! are f |cos| / pdf.
//!
//! ```
//! use illuminant_illumination::General;
//! use illuminant_sampling::Lanes;
//! use illuminant_verify::energy::{Albedo, by_quadrature};
//! use illuminant_verify::integrate::Quadrature;
//! use illuminant_verify::site::Site;
//! use std::f32::consts::FRAC_1_PI;
//! let grey = General::<4>::Diffuse { brdf: Lanes::splat(0.5 * FRAC_1_PI), brightness: 0.5 };
//! let Albedo { reflected, transmitted } =
//!     by_quadrature(&grey, &Site::new(1.0, 1.0), [0.6, 0.0, 0.8], &Quadrature::default());
//! assert!((reflected[2] - 0.5).abs() < 1e-6 && transmitted[2] == 0.0);
//! ```

use crate::integrate::Quadrature;
use crate::random::{EvenPoints, single};
use crate::site::Site;
use illuminant_illumination::IlluminationModel;

/// The share of light that comes back and the share that goes through, in every lane (zero in lanes that a
/// dispersed path no longer carries).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Albedo<const N: usize> {
    /// To the side of the viewer.
    pub reflected: [f64; N],
    /// To the other side, as power.
    pub transmitted: [f64; N],
}

impl<const N: usize> Albedo<N> {
    /// Both together: at most 1 if energy is conserved.
    #[must_use]
    pub fn total(&self) -> [f64; N] {
        std::array::from_fn(|i| self.reflected[i] + self.transmitted[i])
    }
}

/// The albedo and how far it may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate<const N: usize> {
    /// The mean over the draws.
    pub albedo: Albedo<N>,
    /// The standard error of its total that as many independent draws would have, in every lane: a bound.
    pub standard_error: [f64; N],
    /// The mean of what the model gives as brightness, its estimate for the whole spectrum.
    pub brightness: f64,
}

/// The albedo by integrating f |cos θ| over both sides and adding the discrete lobes.
///
/// Where a path disperses at this very surface (dispersive and no hero lane), rough transmission is no function
/// of two directions and is missing here; drawing has it.
#[must_use]
pub fn by_quadrature<const N: usize>(
    model: &impl IlluminationModel<N>,
    site: &Site<N>,
    to_viewer: [f64; 3],
    quadrature: &Quadrature,
) -> Albedo<N> {
    let carried = site.lanes();
    let f = |l: [f64; 3]| {
        let f = site.eval(model, to_viewer, l);
        let mut values = [0.0; N];
        for lane in carried.clone() {
            values[lane] = f[lane] * l[2].abs();
        }
        values
    };
    let (above, below) = if model.is_continuous() {
        (quadrature.above(&f), quadrature.below(&f))
    } else {
        ([0.0; N], [0.0; N])
    };
    let (mut reflected, mut transmitted) = if to_viewer[2] > 0.0 { (above, below) } else { (below, above) };
    for lobe in model.discrete_lobes(&site.incidence(to_viewer)) {
        let side = if lobe.transmitted { &mut transmitted } else { &mut reflected };
        for lane in carried.clone() {
            side[lane] += f64::from(lobe.weight[lane]);
        }
    }
    let squeeze = site.squeeze(to_viewer);
    for (value, squeeze) in transmitted.iter_mut().zip(squeeze) {
        *value *= squeeze;
    }
    Albedo { reflected, transmitted }
}

/// The albedo as the mean weight of directions that the model draws.
///
/// The numbers given to `sample` fill the cube evenly, so the mean is nearer than the standard error of as many
/// independent draws, which is what the estimate states. A direction that disperses counts for one lane alone,
/// drawn evenly, N times: as a path does it.
#[must_use]
pub fn by_drawing<const N: usize>(
    model: &impl IlluminationModel<N>,
    site: &Site<N>,
    to_viewer: [f64; 3],
    samples: u64,
    seed: u64,
) -> Estimate<N> {
    let at = site.incidence(to_viewer);
    let squeeze = site.squeeze(to_viewer);
    let mut points = EvenPoints::<4>::new(seed);
    let mut albedo = Albedo { reflected: [0.0; N], transmitted: [0.0; N] };
    let (mut squares, mut brightness) = ([0.0; N], 0.0);
    for _ in 0..samples {
        let [a, b, c, d] = points.next_point();
        let hero = site.hero_lane.unwrap_or((d * N as f64) as usize);
        let Some(drawn) = model.sample(&at, [a, b, c].map(single), Some(hero)) else { continue };
        brightness += f64::from(drawn.brightness);
        let (lanes, factor) = if drawn.disperses { (hero..hero + 1, N as f64) } else { (0..N, 1.0) };
        for lane in lanes.filter(|lane| site.hero_lane.is_none_or(|hero| hero == *lane)) {
            let weight = factor * f64::from(drawn.weight[lane]);
            let (side, weight) = if drawn.transmitted {
                (&mut albedo.transmitted, weight * squeeze[lane])
            } else {
                (&mut albedo.reflected, weight)
            };
            side[lane] += weight;
            squares[lane] += weight * weight;
        }
    }
    let n = samples.max(1) as f64;
    for value in albedo.reflected.iter_mut().chain(&mut albedo.transmitted) {
        *value /= n;
    }
    let total = albedo.total();
    let standard_error =
        std::array::from_fn(|i| ((squares[i] / n - total[i] * total[i]).max(0.0) / n).sqrt());
    Estimate { albedo, standard_error, brightness: brightness / n }
}
