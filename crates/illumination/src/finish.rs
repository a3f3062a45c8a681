//! The finish of a surface: what its microscopic relief looks like (book 2.2.6).

use illuminant_optics::distribution::Distribution;
use illuminant_optics::facets::Shape;

/// The relief of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finish {
    /// The slope m of the relief along the grain and across it (book eq 2.19, m = 2σ/τ); [0, 0] is a mirror.
    pub slope: [f64; 2],
    /// The rms height σ, nm, by which part of the light stays coherent (book eqs 2.36, 2.37); `None` where it is much
    /// greater than a wavelength and nothing does.
    pub sigma_nm: Option<f64>,
    /// How slopes are distributed.
    pub shape: Shape,
}

impl Finish {
    /// Below this slope a surface is taken as smooth: f32 cannot resolve its highlight.
    pub const SMOOTH: f64 = 1e-3;

    /// The half-angle, radians, of the cone about the mirror direction in which its highlight has half its strength: twice β of
    /// Beckmann's distribution with the steeper slope.
    #[must_use]
    pub fn gloss(&self) -> f64 {
        if self.is_smooth() {
            return 0.0;
        }
        2.0 * Distribution::Cook.half_angle(self.slope[0].max(self.slope[1]).powi(2))
    }

    /// A mirror.
    pub const MIRROR: Self = Self { slope: [0.0, 0.0], sigma_nm: Some(0.0), shape: Shape::Beckmann };

    /// Facets of slope `m` in all directions, on a relief much higher than a wavelength.
    #[must_use]
    pub fn rough(m: f64) -> Self {
        Self { slope: [m, m], sigma_nm: None, shape: Shape::Beckmann }
    }

    /// Whether nothing is scattered.
    #[must_use]
    pub fn is_smooth(&self) -> bool {
        self.slope.iter().all(|&m| m < Self::SMOOTH) || self.sigma_nm == Some(0.0)
    }
}
