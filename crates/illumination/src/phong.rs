//! `phong`: a highlight about the mirror direction of the view (Phong 1975; book eqs 4.11–4.13).

use crate::historical::{Coefficients, Historical, Side, Terms};
use crate::{Claims, Samples};
use illuminant_optics::Vector;

/// I = K_a I_a + Σ (K_d (N·L) + K_s D) I, where the original D is (R_v·L)^N_s and K_s has no colour; with Blinn's D it is eq 4.13.
#[derive(Clone, Copy, Debug)]
pub struct Phong;

impl Phong {
    /// K_s D is not divided by N·L, so exchanging light and view changes it. A lobe of peak 1 returns 2 K_s/(N_s + 1) of the light at most,
    /// which with K_d is no more than came as long as multipliers follow the rule.
    pub const CLAIMS: Claims = Claims {
        reciprocal: false,
        energy_conserving: true,
        equilibrium: false,
        source: "Phong 1975; Hall 1989, eq 4.13",
    };
}

impl<S: Samples> Historical<S> for Phong {
    #[inline]
    fn lit(&self, surface: &Coefficients<S>, _side: &Side, v: Vector<f64>, l: Vector<f64>) -> Terms<S> {
        Terms {
            diffuse: surface.lambert(l),
            specular: surface.specular.times(surface.specular_scale * surface.highlight.d(l, v)),
            ..Terms::default()
        }
    }
}
