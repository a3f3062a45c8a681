//! Light that is scattered under a boundary: the vehicle of a paint (Saunderson 1942; book 2.1, II.1.3).
//!
//! A boundary with the index n reflects a share K₁ of the light that comes from outside and K₂ of the diffuse light inside. A
//! pigment of reflectance R under it then gives the paint the reflectance
//! K₁ + (1 − K₁)(1 − K₂) R / (1 − K₂ R).

use crate::Real;
use crate::fresnel::dielectric;

/// The reflectance of a boundary for diffuse light from outside, ∫ 2 F cos θ d(cos θ); `eta` > 0 is the relative index.
///
/// ```
/// use illuminant_optics::saunderson::{diffuse_reflectance, internal_reflectance};
/// // Walsh's values for glass: 9.2 % from outside, 59.6 % from inside.
/// assert!((diffuse_reflectance(1.5f64) - 0.0918).abs() < 1e-4);
/// assert!((internal_reflectance(1.5f64) - 0.5963).abs() < 1e-4);
/// // The closed integral from inside agrees.
/// assert!((diffuse_reflectance(1.0 / 1.5) - internal_reflectance(1.5f64)).abs() < 1e-4);
/// ```
#[must_use]
pub fn diffuse_reflectance<R: Real>(eta: R) -> R {
    const STEPS: usize = 2000;
    let one = R::one();
    // Total reflection in closed form, and steps of the root beyond it, in which reflectance is smooth.
    let critical = if eta < one { (one - eta * eta).sqrt() } else { R::zero() };
    let mut sum = critical * critical;
    let width = (one - critical).sqrt() / R::of(STEPS as f64);
    for i in 0..STEPS {
        let t = (R::of(i as f64) + R::of(0.5)) * width;
        let cos = critical + t * t;
        sum = sum + R::of(4.0) * t * cos * dielectric(cos, eta) * width;
    }
    sum
}

/// The reflectance K₂ of a boundary for diffuse light from inside: 1 − (1 − K)/n², with K of [`diffuse_reflectance`], because what
/// goes through is the same both ways but for n² of the solid angle.
#[must_use]
pub fn internal_reflectance<R: Real>(n: R) -> R {
    R::one() - (R::one() - diffuse_reflectance(n)) / (n * n)
}

/// The reflectance of paint near normal incidence, of its pigment's reflectance in [0, 1]; n ≥ 1 is that of the vehicle.
///
/// ```
/// use illuminant_optics::saunderson::{paint, pigment};
/// assert!((paint(1.0f64, 1.5) - 1.0).abs() < 1e-12); // what absorbs nothing returns everything
/// assert!((paint(0.0f64, 1.5) - 0.04).abs() < 1e-12); // black paint still shines
/// assert!((pigment(paint(0.3f64, 1.5), 1.5) - 0.3).abs() < 1e-12);
/// ```
#[must_use]
pub fn paint<R: Real>(pigment: R, n: R) -> R {
    let (one, outer, inner) = (R::one(), dielectric(R::one(), n), internal_reflectance(n));
    outer + (one - outer) * (one - inner) * pigment / (one - inner * pigment)
}

/// The reflectance of the pigment in a paint of which the total reflectance near normal incidence is known: the inverse of [`paint`].
/// Below the reflectance of the boundary alone it is 0.
#[must_use]
pub fn pigment<R: Real>(paint: R, n: R) -> R {
    let (one, outer, inner) = (R::one(), dielectric(R::one(), n), internal_reflectance(n));
    let body = (paint - outer).max(R::zero());
    (body / ((one - outer) * (one - inner) + inner * body)).min(one)
}
