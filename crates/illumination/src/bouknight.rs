//! `bouknight`: ambient and diffuse light (Bouknight 1970; book eqs 4.7–4.9).

use crate::historical::{Coefficients, Historical, Side, Terms};
use crate::{Claims, Samples};
use illuminant_optics::Vector;

/// I = K_a I_a + K_d Σ (N·L) I. The original is grey, with one light at infinity behind the eye: then N·L is N_k.
///
/// The exponent of figure 4.7 is [`Coefficients::terminator`].
#[derive(Clone, Copy, Debug)]
pub struct Bouknight;

impl Bouknight {
    /// A diffuser keeps every law but one: a metal or glass gives less back than came.
    pub const CLAIMS: Claims = Claims {
        reciprocal: true,
        energy_conserving: true,
        equilibrium: false,
        source: "Bouknight 1970; Hall 1989, eq 4.9",
    };
}

impl<S: Samples> Historical<S> for Bouknight {
    #[inline]
    fn lit(&self, surface: &Coefficients<S>, _side: &Side, _v: Vector<f64>, l: Vector<f64>) -> Terms<S> {
        Terms { diffuse: surface.lambert(l), ..Terms::default() }
    }
}
