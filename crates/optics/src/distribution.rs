//! The microfacet distributions of the literature (book 2.3.2.2, 4.2.4, III.3), in the terms in which they were published.
//!
//! All take N, L and V and one coefficient, so that any can stand in any illumination model. Phong, Blinn, Gaussian and
//! Trowbridge–Reitz are scaled to 1 at their peak; [`Distribution::Cook`] is Beckmann's, divided by 4 as in book eq 4.24, so that
//! ∫ 4 D cos α dω = 1. Normalised distributions with visible normals are [`crate::facets`].

use crate::Vector;
use crate::vectors::{dot, half, reflect};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, LN_2, PI};

/// A distribution by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distribution {
    /// (R·L)^N_s (Phong 1975; book eq 4.13).
    Phong,
    /// (N·H)^N_s (Blinn 1977; book eq 4.16).
    Blinn,
    /// exp(−(C₁ α)²) (Torrance and Sparrow 1967; book eq 4.17).
    Gaussian,
    /// (C₂² / (cos² α (C₂² − 1) + 1))² (Trowbridge and Reitz 1975; book eq 4.18); the coefficient is C₂².
    TrowbridgeReitz,
    /// exp(−tan² α/m²) / (4π m² cos⁴ α) (Beckmann 1963 by Cook and Torrance 1982; book eq 4.24); the coefficient is m².
    Cook,
}

impl Distribution {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Phong, Self::Blinn, Self::Gaussian, Self::TrowbridgeReitz, Self::Cook];

    /// The coefficient for which the function falls to half its peak when H is `beta` radians from N (book eqs 4.19, 4.25): N_s, C₁,
    /// C₂² or m². Infinite or 0 where the lobe would be a line or the whole hemisphere.
    ///
    /// ```
    /// use illuminant_optics::distribution::Distribution;
    /// let beta = 0.2f64;
    /// assert!((Distribution::Blinn.coefficient(beta) - 0.5f64.ln() / beta.cos().ln()).abs() < 1e-9);
    /// for d in Distribution::ALL {
    ///     assert!((d.half_angle(d.coefficient(beta)) - beta).abs() < 1e-6, "{d:?}");
    /// }
    /// ```
    #[must_use]
    pub fn coefficient(self, beta: f64) -> f64 {
        match self {
            Self::Phong if beta <= 0.0 => f64::INFINITY,
            Self::Phong if beta >= FRAC_PI_4 => 0.0,
            Self::Phong => -LN_2 / (2.0 * beta).cos().ln(),
            Self::Blinn if beta <= 0.0 => f64::INFINITY,
            Self::Blinn if beta >= FRAC_PI_2 => 0.0,
            Self::Blinn => -LN_2 / beta.cos().ln(),
            Self::Gaussian if beta <= 0.0 => f64::INFINITY,
            Self::Gaussian => LN_2.sqrt() / beta,
            Self::TrowbridgeReitz if beta <= 0.0 => 0.0,
            Self::TrowbridgeReitz => {
                let cos2 = beta.cos().powi(2);
                (cos2 - 1.0) / (cos2 - std::f64::consts::SQRT_2)
            }
            Self::Cook if beta <= 0.0 => 0.0,
            Self::Cook if beta >= FRAC_PI_2 => f64::INFINITY,
            Self::Cook => {
                let (cos2, tan2) = (beta.cos().powi(2), beta.tan().powi(2));
                -tan2 / (cos2 * cos2 / 2.0).ln()
            }
        }
    }

    /// The angle β, radians, at which the function of a coefficient has fallen to half: the inverse of [`Self::coefficient`], for coefficients
    /// above 0 by bisection; the widest lobe gives the end of the range.
    #[must_use]
    pub fn half_angle(self, coefficient: f64) -> f64 {
        // N_s and C₁ fall with β, C₂² and m² grow.
        let falls = matches!(self, Self::Phong | Self::Blinn | Self::Gaussian);
        let end = if self == Self::Phong { FRAC_PI_4 } else { FRAC_PI_2 };
        let (mut low, mut high) = (0.0, end);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if (self.coefficient(middle) > coefficient) == falls {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }

    /// The value for a normal, light and view; 0 where H does not exist or lies below the surface.
    #[must_use]
    pub fn value(self, n: Vector<f64>, l: Vector<f64>, v: Vector<f64>, coefficient: f64) -> f64 {
        if self == Self::Phong {
            let cos = dot(reflect(v, n), l);
            return if cos < 0.0 { 0.0 } else { cos.powf(coefficient) };
        }
        let Some(h) = half(l, v) else { return 0.0 };
        let cos = dot(n, h).min(1.0);
        if cos < 0.0 {
            return 0.0;
        }
        let cos2 = cos * cos;
        match self {
            Self::Phong | Self::Blinn => cos.powf(coefficient),
            Self::Gaussian => (-(coefficient * cos.acos()).powi(2)).exp(),
            Self::TrowbridgeReitz => (coefficient / (cos2 * (coefficient - 1.0) + 1.0)).powi(2),
            Self::Cook if cos2 == 0.0 => 0.0,
            Self::Cook => {
                let exponent = (cos2 - 1.0) / (cos2 * coefficient);
                exponent.exp() / (4.0 * PI * coefficient * cos2 * cos2)
            }
        }
    }
}

/// GGX's α of which the lobe falls to half at `beta` (figure 4.14's others in today's terms): the distribution is Trowbridge–Reitz's
/// with α² = C₂².
#[must_use]
pub fn ggx_alpha(beta: f64) -> f64 {
    Distribution::TrowbridgeReitz.coefficient(beta).sqrt()
}
