//! How rough a surface is (book 2.2.6, 2.3.1, III.4): heights, slopes, and what of the light stays coherent.
//!
//! σ is the root mean square height and τ the correlation distance, in the same unit as the wavelength. Two slopes are in use: m = 2σ/τ
//! (Beckmann; book eq 2.19) and the root mean square slope √2 σ/τ (Bennett and Porteus; eq 2.20), which is m/√2.

use crate::vectors::dot;
use crate::{Real, Vector};

/// The slope m = 2σ/τ (book eq 2.19).
#[must_use]
pub fn slope<R: Real>(sigma: R, tau: R) -> R {
    R::of(2.0) * sigma / tau
}

/// The height σ = m τ/2.
#[must_use]
pub fn height<R: Real>(m: R, tau: R) -> R {
    m * tau / R::of(2.0)
}

/// The correlation distance τ = 2σ/m.
///
/// ```
/// use illuminant_optics::roughness::{correlation_distance, height, slope};
/// let tau = correlation_distance(76.2f64, 0.1);
/// assert!((slope(76.2, tau) - 0.1).abs() < 1e-12 && (height(0.1, tau) - 76.2).abs() < 1e-12);
/// ```
#[must_use]
pub fn correlation_distance<R: Real>(sigma: R, m: R) -> R {
    R::of(2.0) * sigma / m
}

/// The root mean square slope m/√2 (book eq 2.20).
#[must_use]
pub fn rms_slope<R: Real>(m: R) -> R {
    m / R::SQRT_2()
}

/// The apparent roughness g = (2πσ/λ)² (cos θ_i + cos θ_r)² (book eq 2.36).
///
/// ```
/// use illuminant_optics::roughness::{apparent_roughness, coherent};
/// // Book footnote: σ = 150 nm at 580 nm and normal incidence leaves 2.6e-5.
/// let kept = coherent(apparent_roughness(150.0f64, 580.0, 1.0, 1.0));
/// assert!((kept - 2.6e-5).abs() < 1e-6 && kept < 1e-4);
/// ```
#[must_use]
pub fn apparent_roughness<R: Real>(sigma: R, wavelength: R, cos_i: R, cos_r: R) -> R {
    let phase = R::TAU() * sigma / wavelength * (cos_i + cos_r);
    phase * phase
}

/// The apparent roughness for light that goes through, (2πσ/λ)² (n_i cos θ_i − n_t cos θ_t)²: the path through the boundary
/// changes by that for every unit of height. λ is that of vacuum. The book leaves it open.
///
/// ```
/// use illuminant_optics::roughness::apparent_roughness_transmitted;
/// assert_eq!(apparent_roughness_transmitted(100.0, 550.0, [1.5, 0.8], [1.5, 0.8]), 0.0); // no boundary
/// ```
#[must_use]
pub fn apparent_roughness_transmitted<R: Real>(sigma: R, wavelength: R, near: [R; 2], far: [R; 2]) -> R {
    let phase = R::TAU() * sigma / wavelength * (near[0] * near[1] - far[0] * far[1]);
    phase * phase
}

/// What stays coherent, r_σ or t_σ = exp(−g) (book eq 2.37).
#[must_use]
pub fn coherent<R: Real>(g: R) -> R {
    (-g).exp()
}

/// v_xz², the square of the tangential part of the scattering vector: (2π/λ)² |L_∥ + V_∥|² (book eq 2.42d, with the errata); 0 in the
/// mirror direction.
#[must_use]
pub fn tangential_scattering<R: Real>(n: Vector<R>, l: Vector<R>, v: Vector<R>, wavelength: R) -> R {
    let (nl, nv) = (dot(n, l), dot(n, v));
    let sum: Vector<R> = std::array::from_fn(|i| l[i] - nl * n[i] + v[i] - nv * n[i]);
    let k = R::TAU() / wavelength;
    k * k * dot(sum, sum)
}

/// The mean square of a profile about its mean, σ² (book eq 2.18, averaged); 0 of nothing.
///
/// ```
/// use illuminant_optics::roughness::{profile, variance};
/// let heights = profile(20_000, 0.05, 100.0, 1.0, 7);
/// assert!((variance(&heights).sqrt() / 100.0 - 1.0).abs() < 0.1);
/// ```
#[must_use]
pub fn variance(heights: &[f64]) -> f64 {
    let count = heights.len().max(1) as f64;
    let mean = heights.iter().sum::<f64>() / count;
    heights.iter().map(|h| (h - mean) * (h - mean)).sum::<f64>() / count
}

/// A profile as a stylus draws it: `count` heights at a spacing, of a Gaussian surface with the height σ and the correlation ⟨ζ(0) ζ(x)⟩ =
/// σ² exp(−x²/τ²); σ in its own unit, spacing and τ in one. The same seed gives the same profile.
#[must_use]
pub fn profile(count: usize, spacing: f64, sigma: f64, tau: f64, seed: u64) -> Vec<f64> {
    let mut state = seed ^ 0x9e37_79b9_7f4a_7c15;
    let mut unit = || {
        // SplitMix64 (Steele, Lea and Flood 2014).
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    };
    // White noise through a Gaussian of width τ/√2, whose correlation with itself is of width τ.
    let reach = (3.0 * tau / spacing).ceil().clamp(1.0, 1e6) as usize;
    let noise: Vec<f64> = (0..count + 2 * reach)
        .map(|_| (-2.0 * (1.0 - unit()).ln()).sqrt() * (std::f64::consts::TAU * unit()).cos())
        .collect();
    let weights: Vec<f64> =
        (0..=2 * reach).map(|i| (-2.0 * ((i as f64 - reach as f64) * spacing / tau).powi(2)).exp()).collect();
    let norm = weights.iter().map(|w| w * w).sum::<f64>().sqrt();
    (0..count)
        .map(|i| sigma / norm * weights.iter().zip(&noise[i..]).map(|(w, n)| w * n).sum::<f64>())
        .collect()
}
