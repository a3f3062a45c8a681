//! `hall`: Fresnel's reflectance for rays and highlights, and highlights through transparent bodies (Hall and Greenberg 1983; book eq
//! 4.21).

use crate::historical::{
    Asked, AskedPair, Coefficients, Historical, Side, Terms, lit_from_air, mirrored, refracted,
};
use crate::{Claims, Samples};
use illuminant_optics::Vector;
use illuminant_optics::vectors::{dot, half, half_refracted, reflect};

/// I = K_a I_a + Σ (K_d (N·L) + K_s D G F) I + Σ K_s D(H′) G F_t I + K_s F I_r + K_s F_t I_t.
///
/// K_s multiplies what is transmitted too, and K_t is not used (book eq 4.21).
#[derive(Clone, Copy, Debug)]
pub struct Hall;

impl Hall {
    /// As in `whitted`, the highlights come on top of rays that keep all the energy.
    pub const CLAIMS: Claims = Claims {
        reciprocal: false,
        energy_conserving: false,
        equilibrium: false,
        source: "Hall and Greenberg 1983; Hall 1989, eq 4.21",
    };
}

impl<S: Samples> Historical<S> for Hall {
    #[inline]
    fn terms(&self, surface: &Coefficients<S>, side: &Side, v: Vector<f64>, l: Vector<f64>) -> Terms<S> {
        let highlight = surface.highlight;
        let mut terms = Terms::default();
        if lit_from_air(side, v, l) {
            terms.diffuse = surface.lambert(l);
            if let Some(h) = half(l, v) {
                let factor = surface.specular_scale * highlight.d(l, v) * highlight.g(l, v);
                terms.specular = surface.fresnel(dot(h, l), side, false).times(factor);
            }
        } else if side.outside_is_air && v[2] < 0.0 && l[2] > 0.0 && surface.conductor.is_none() {
            // Seen from inside, a facet with the normal H′ sends the light to the viewer. The distribution is asked as if the
            // light were mirrored about it.
            if let Some(h) = half_refracted(l, v, side.outside, side.inside) {
                let d = highlight.d(l, reflect(l, h));
                let g = highlight.g(l, v.map(|c| -c));
                let through = surface.fresnel(dot(h, l), side, false).complement();
                terms.transmitted = through.times(surface.specular_scale * d * g);
            }
        }
        terms
    }

    #[inline]
    fn asked(&self, surface: &Coefficients<S>, side: &Side, v: Vector<f64>) -> AskedPair<S> {
        let reflectance = surface.fresnel(v[2].abs(), side, v[2] < 0.0);
        let mirror = Asked { direction: mirrored(v), weight: reflectance.times(surface.specular_scale) };
        let through = refracted(v, side).filter(|_| surface.transparent).map(|direction| Asked {
            direction,
            weight: reflectance.complement().times(surface.specular_scale),
        });
        [Some(mirror), through]
    }
}
