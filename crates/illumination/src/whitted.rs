//! `whitted`: rays for mirrors and glass, Blinn's highlight for lamps (Whitted 1980; book eq 4.20).

use crate::historical::{Asked, AskedPair, Coefficients, Historical, Side, Terms, mirrored, refracted};
use crate::{Claims, Phong, Samples};
use illuminant_optics::Vector;

/// I = K_a I_a + Σ (K_d (N·L) + K_s (N·H)^N_s) I + K_s I_r + K_t I_t, with constant K_s and K_t.
#[derive(Clone, Copy, Debug)]
pub struct Whitted;

impl Whitted {
    /// K_s counts twice: for what a mirror shows, and for the highlight of lamps that it would show too.
    pub const CLAIMS: Claims = Claims {
        reciprocal: false,
        energy_conserving: false,
        equilibrium: false,
        source: "Whitted 1980; Hall 1989, eq 4.20",
    };
}

impl<S: Samples> Historical<S> for Whitted {
    #[inline]
    fn lit(&self, surface: &Coefficients<S>, side: &Side, v: Vector<f64>, l: Vector<f64>) -> Terms<S> {
        Phong.lit(surface, side, v, l)
    }

    #[inline]
    fn asked(&self, surface: &Coefficients<S>, side: &Side, v: Vector<f64>) -> AskedPair<S> {
        let mirror = Asked { direction: mirrored(v), weight: surface.specular.times(surface.specular_scale) };
        let through = refracted(v, side).filter(|_| surface.transparent);
        [Some(mirror), through.map(|direction| Asked { direction, weight: surface.transmitted })]
    }
}
