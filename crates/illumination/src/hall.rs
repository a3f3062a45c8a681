//! `hall`: Fresnel's reflectance for rays and highlights, and highlights through transparent bodies (Hall and Greenberg 1983; book eq
//! 4.21).

use crate::historical::{Asked, AskedPair, Coefficients, Historical, Side, Terms, mirrored, refracted};
use crate::{Claims, Samples};
use illuminant_optics::Vector;
use illuminant_optics::vectors::{dot, half_refracted, reflect};

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
    fn lit(&self, surface: &Coefficients<S>, side: &Side, v: Vector<f64>, l: Vector<f64>) -> Terms<S> {
        Terms { diffuse: surface.lambert(l), specular: surface.facets(side, v, l), ..Terms::default() }
    }

    #[inline]
    fn let_through(&self, surface: &Coefficients<S>, side: &Side, v: Vector<f64>, l: Vector<f64>) -> S {
        // A facet with the normal H′ sends the light to the viewer. The distribution is asked as if the light were mirrored
        // about it.
        let facet = half_refracted(l, v, side.outside, side.inside);
        let Some(h) = facet.filter(|_| surface.conductor.is_none()) else { return S::default() };
        let d = surface.highlight.d(l, reflect(l, h));
        let g = surface.highlight.g(l, v.map(|c| -c));
        let through = surface.fresnel(dot(h, l), side, false).complement();
        through.times(surface.specular_scale * d * g)
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
