//! `cook-torrance`: a model of energy (Cook and Torrance 1982; book eqs 4.22–4.25).

use crate::historical::{Coefficients, Historical, Side, Terms};
use crate::{Blinn, Claims, Samples};
use illuminant_optics::Vector;
use std::f64::consts::PI;

/// I = K_a I_a + Σ (K_d M/π + K_s D G F/((N·L)(N·V))) (N·L) I dω, with K_d + K_s = 1 and Beckmann's D (book eq 4.24).
///
/// The lamp's I dω is its irradiance E, π times the intensity of the empirical models.
#[derive(Clone, Copy, Debug)]
pub struct CookTorrance;

impl CookTorrance {
    /// Reciprocal, but towards grazing light and rough surfaces more is returned than comes (book figure 4.21).
    pub const CLAIMS: Claims = Claims {
        reciprocal: true,
        energy_conserving: false,
        equilibrium: false,
        source: "Cook and Torrance 1982; Hall 1989, eq 4.23",
    };
}

impl<S: Samples> Historical<S> for CookTorrance {
    #[inline]
    fn lit(&self, surface: &Coefficients<S>, side: &Side, v: Vector<f64>, l: Vector<f64>) -> Terms<S> {
        let mut terms = Terms { diffuse: surface.lambert(l), ..Terms::default() };
        if v[2] > Blinn::GRAZING {
            terms.specular = surface.facets(side, v, l).times(PI / v[2]);
        }
        terms
    }
}
