//! Microfacets by wave optics: the series of Beckmann, Bahar and Koestner (book 2.3.2.2, eq 2.42; III.4).
//!
//! With the apparent roughness g and v_xz² the book has D = 1/(4π m² cos⁴ α) Σ_{i ≥ 1} g^(i+1)/(i! i) exp(−(g + v² τ²/(4i))). Because
//! v² τ²/4 = g tan² α/m², its terms are Poisson's weights exp(−g) g^i/i! times Beckmann's distribution of the slope m √(i/g):
//!
//! D = ¼ Σ_{i ≥ 1} Poisson(i; g) D_Beckmann(α; m √(i/g)).
//!
//! So all terms together weigh 1 − exp(−g), which is just what the coherent part r_σ = exp(−g) leaves; the first term is the smooth
//! regime (eq 2.42a), and where g is large the weights gather around i = g, so that D becomes Beckmann's (eq 2.42c). In that form nothing
//! overflows for any g.

use std::f64::consts::PI;

/// Beckmann's distribution, normalised by ∫ D cos α dω = 1, of cos² α.
fn beckmann(cos2: f64, m2: f64) -> f64 {
    ((cos2 - 1.0) / (cos2 * m2)).exp() / (PI * m2 * cos2 * cos2)
}

/// The rough regime, g ≫ 1 (book eq 2.42c, with the errata's minus): exp(−tan² α/m²) / (4π m² cos⁴ α).
#[must_use]
pub fn rough(cos_alpha: f64, m: f64) -> f64 {
    if cos_alpha <= 0.0 { 0.0 } else { beckmann(cos_alpha * cos_alpha, m * m) / 4.0 }
}

/// The smooth regime, g ≪ 1 (book eq 2.42a): the first term of the series.
#[must_use]
pub fn smooth(cos_alpha: f64, m: f64, g: f64) -> f64 {
    if cos_alpha <= 0.0 || g <= 0.0 {
        0.0
    } else {
        g * (-g).exp() * beckmann(cos_alpha.powi(2), m * m / g) / 4.0
    }
}

/// The whole series (book eq 2.42b) for any g, from the largest weight outwards until terms no longer count; 0 for g ≤ 0 or below the surface.
///
/// ```
/// use illuminant_optics::wave_optics::{rough, series, smooth};
/// assert!((series(0.9, 0.5, 1e6) / rough(0.9, 0.5) - 1.0).abs() < 1e-4);
/// assert!((series(0.9, 0.5, 1e-6) / smooth(0.9, 0.5, 1e-6) - 1.0).abs() < 1e-5);
/// assert!(series(0.3, 0.02, 1e9).is_finite());
/// ```
#[must_use]
pub fn series(cos_alpha: f64, m: f64, g: f64) -> f64 {
    if !(g > 0.0) || cos_alpha <= 0.0 {
        return 0.0;
    }
    let (cos2, m2) = (cos_alpha * cos_alpha, m * m);
    // Far into the rough regime the weights are a normal distribution of width √g around g; its curvature is below 1/g.
    if g > 1e7 {
        return rough(cos_alpha, m);
    }
    // Where slopes are steep for m, terms above g count most: exp(−g t/i) with t = tan² α/m² moves the mode to about √… at most g (1 + √t).
    let steep = (1.0 - cos2) / (cos2 * m2);
    let log_weight = |i: f64| i * g.ln() - g - log_factorial(i);
    let term = |i: f64| (log_weight(i) - steep * g / i - i.ln()).exp() * g / (4.0 * PI * m2 * cos2 * cos2);
    // The exponent i ln g − ln i! − t g/i is greatest near the root of ln(g/i) + t g/i² = 0.
    let mut mode = g.max(1.0);
    for _ in 0..60 {
        let slope = (g / mode).ln() + steep * g / (mode * mode);
        let curvature = -mode.recip() - 2.0 * steep * g / mode.powi(3);
        mode = (mode - slope / curvature).max(mode / 2.0).max(1.0);
    }
    let start = mode.round().max(1.0);
    let mut sum = term(start);
    for direction in [1.0, -1.0] {
        let mut i = start + direction;
        while i >= 1.0 {
            let next = term(i);
            sum += next;
            if next <= 1e-17 * sum {
                break;
            }
            i += direction;
        }
    }
    sum
}

/// ln i!
fn log_factorial(i: f64) -> f64 {
    if i < 32.0 {
        return (2..=i as u32).map(|k| f64::from(k).ln()).sum();
    }
    let x = i.recip();
    let stirling = x * (1.0 / 12.0 - x * x * (1.0 / 360.0 - x * x / 1260.0));
    (i + 0.5) * i.ln() - i + 0.5 * (2.0 * PI).ln() + stirling
}

/// As the book computes it (III.4): the series up to g = 5, ended when a term is at most 10⁻⁵ and terms fall, the rough regime from g = 8 on, a mixture
/// between. `cos_alpha` is N·H, and `phase` v_xz² τ²/4.
#[must_use]
pub fn blended(cos_alpha: f64, m: f64, g: f64, phase: f64) -> f64 {
    if g <= 0.0 || cos_alpha <= 0.0 {
        return 0.0;
    }
    let denominator = 4.0 * PI * m * m * cos_alpha.powi(4);
    if g >= 8.0 {
        return rough(cos_alpha, m);
    }
    let (mut sum, mut i, mut factor, mut term, mut last) = (0.0, 1.0, g * g, f64::INFINITY, f64::INFINITY);
    // `factor` is g^(i+1)/i!.
    while i == 1.0 || term / denominator > 1e-5 || term > last {
        last = if i == 1.0 { 0.0 } else { term };
        term = factor / i * (-(g + phase / i)).exp();
        sum += term;
        i += 1.0;
        factor *= g / i;
    }
    let series = sum / denominator;
    if g < 5.0 { series } else { ((8.0 - g) * series + (g - 5.0) * rough(cos_alpha, m)) / 3.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_terms_weigh_what_coherence_leaves() {
        // ∫ 4 D cos α dω over slopes: terms of slope m √(i/g) are normalised over all slopes.
        for g in [0.3, 2.0, 30.0] {
            let m = 0.1;
            let steps = 20_000;
            let mut sum = 0.0;
            for i in 0..steps {
                // In tan² α/m², dω cos α = π m² cos⁴ α d(tan²/m²).
                let t = (f64::from(i) + 0.5) / f64::from(steps);
                let x = 400.0 * t * t;
                let cos2 = 1.0 / (1.0 + x * m * m);
                sum +=
                    4.0 * series(cos2.sqrt(), m, g) * PI * m * m * cos2 * cos2 * 800.0 * t / f64::from(steps);
            }
            assert!((sum - (1.0 - (-g).exp())).abs() < 2e-3, "{g}: {sum}");
        }
    }
}
