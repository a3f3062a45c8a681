//! The shape of a highlight: any distribution of facets with any masking (book III.6).

use illuminant_optics::Vector;
use illuminant_optics::distribution::Distribution;
use illuminant_optics::masking::{sancer, torrance_sparrow};

/// A masking function by name.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Masking {
    /// Nothing hides.
    #[default]
    None,
    /// V-grooves (book eq 2.21).
    TorranceSparrow,
    /// A Gaussian surface (book eq 2.22) of this m².
    Sancer(f64),
}

impl Masking {
    /// The visible part of the facets.
    #[inline]
    #[must_use]
    pub fn value(self, n: Vector<f64>, l: Vector<f64>, v: Vector<f64>) -> f64 {
        match self {
            Self::None => 1.0,
            Self::TorranceSparrow => torrance_sparrow(n, l, v),
            Self::Sancer(m_squared) => sancer(n, l, v, m_squared),
        }
    }
}

/// A distribution with its coefficient, and a masking.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Highlight {
    /// How facets lie.
    pub distribution: Distribution,
    /// N_s, C₁, C₂² or m².
    pub coefficient: f64,
    /// What hides them.
    pub masking: Masking,
}

impl Highlight {
    /// The highlight that falls to half where H is `beta` radians from N.
    ///
    /// ```
    /// use illuminant_illumination::{Highlight, Masking};
    /// use illuminant_optics::distribution::Distribution;
    /// let lobe = Highlight::new(Distribution::Blinn, 0.2, Masking::None);
    /// assert!((lobe.coefficient - 34.4).abs() < 0.1);
    /// ```
    #[must_use]
    pub fn new(distribution: Distribution, beta: f64, masking: Masking) -> Self {
        Self { distribution, coefficient: distribution.coefficient(beta), masking }
    }

    /// D, for the normal [0, 0, 1].
    #[inline]
    #[must_use]
    pub fn d(&self, l: Vector<f64>, v: Vector<f64>) -> f64 {
        self.distribution.value([0.0, 0.0, 1.0], l, v, self.coefficient)
    }

    /// G, for the same normal.
    #[inline]
    #[must_use]
    pub fn g(&self, l: Vector<f64>, v: Vector<f64>) -> f64 {
        self.masking.value([0.0, 0.0, 1.0], l, v)
    }
}
