//! `blinn`: facets with Fresnel's reflectance (Blinn 1977; book eq 4.15).

use crate::historical::{Coefficients, Historical, Side, Terms};
use crate::{Claims, Samples};
use illuminant_optics::Vector;

/// I = K_a I_a + Σ (K_d (N·L) + K_s D G F/(N·V)) I: brightest beyond the mirror direction, as seen at grazing angles.
#[derive(Clone, Copy, Debug)]
pub struct Blinn;

impl Blinn {
    /// Below this N·V the quotient is left out (book III.6).
    pub const GRAZING: f64 = 1e-4;

    /// D is 1 at its peak whatever its width: a wide lobe returns more than comes. Over the irradiance, both cosines divide.
    pub const CLAIMS: Claims = Claims {
        reciprocal: true,
        energy_conserving: false,
        equilibrium: false,
        source: "Blinn 1977; Hall 1989, eq 4.15",
    };
}

impl<S: Samples> Historical<S> for Blinn {
    #[inline]
    fn lit(&self, surface: &Coefficients<S>, side: &Side, v: Vector<f64>, l: Vector<f64>) -> Terms<S> {
        let mut terms = Terms { diffuse: surface.lambert(l), ..Terms::default() };
        if v[2] > Self::GRAZING {
            terms.specular = surface.facets(side, v, l).times(v[2].recip());
        }
        terms
    }
}
