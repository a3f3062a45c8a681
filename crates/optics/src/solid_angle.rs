//! Solid angles and what a source of small size sends (book 2.2.3, 2.2.4).

use crate::Real;

/// The solid angle of a hemisphere, 2π sr.
pub const HEMISPHERE: f64 = std::f64::consts::TAU;

/// The solid angle of a sphere, 4π sr.
pub const SPHERE: f64 = 2.0 * std::f64::consts::TAU;

/// The solid angle of a disc of radius `r` seen face-on from a distance, sr (book eq 2.2): 2π (1 − cos atan(r/d)).
///
/// ```
/// use illuminant_optics::solid_angle::{disc, disc_approximated};
/// assert!((disc(1.0f64, 1e-9) - std::f64::consts::TAU).abs() < 1e-6);
/// // Book figure 2.6: at r/d = 0.1 the approximation is 0.75 % too large, at 1 it is 70.7 %.
/// assert!((disc_approximated(0.1f64, 1.0) / disc(0.1, 1.0) - 1.0075).abs() < 1e-4);
/// assert!((disc_approximated(1.0f64, 1.0) / disc(1.0, 1.0) - 1.7071).abs() < 1e-4);
/// ```
#[must_use]
pub fn disc<R: Real>(radius: R, distance: R) -> R {
    let q2 = (radius / distance) * (radius / distance);
    // 1 − 1/√(1 + q²) without the loss of digits of a small disc.
    let root = (R::one() + q2).sqrt();
    R::TAU() * q2 / (root * (root + R::one()))
}

/// The approximation π r²/d² for small discs, sr (book eq 2.3).
#[must_use]
pub fn disc_approximated<R: Real>(radius: R, distance: R) -> R {
    R::PI() * (radius / distance) * (radius / distance)
}

/// The solid angle of a small area seen under a cosine from a distance, sr (book eq 2.4): A (N·V)/d².
#[must_use]
pub fn small_area<R: Real>(area: R, cos: R, distance: R) -> R {
    area * cos / (distance * distance)
}

/// The relative error of [`disc_approximated`] for the ratio of radius to distance (book figure 2.6).
#[must_use]
pub fn disc_error<R: Real>(ratio: R) -> R {
    disc_approximated(ratio, R::one()) / disc(ratio, R::one()) - R::one()
}

/// The radiance (the book's intensity) of a source of projected area `area` that sends `flux` watts into a solid angle, W/(m² sr) (book eq
/// 2.5).
#[must_use]
pub fn radiance<R: Real>(flux: R, area: R, solid_angle: R) -> R {
    flux / (area * solid_angle)
}

/// The radiance of a sphere of radius `r` that sends `flux` watts evenly: Φ/(4π² r²) (book eq 2.6).
#[must_use]
pub fn sphere_radiance<R: Real>(flux: R, radius: R) -> R {
    flux / (R::of(4.0) * R::PI() * R::PI() * radius * radius)
}

/// The irradiance (the book's energy density), W/m², of a point or sphere of `flux` watts at a distance, under the cosine N·L (book eqs 2.7–2.9).
///
/// ```
/// use illuminant_optics::solid_angle::{disc_approximated, irradiance, sphere_radiance};
/// // A far sphere: I (N·L) ω is the same.
/// let (flux, radius, distance, cos) = (60.0f64, 0.001, 2.0, 0.5);
/// let by_radiance = sphere_radiance(flux, radius) * cos * disc_approximated(radius, distance);
/// assert!((irradiance(flux, cos, distance) / by_radiance - 1.0).abs() < 1e-9);
/// ```
#[must_use]
pub fn irradiance<R: Real>(flux: R, cos: R, distance: R) -> R {
    flux * cos / (R::of(4.0) * R::PI() * distance * distance)
}

/// The flux, W, from a small source of radiance I and area A_s to a small receiver of area A_o (book eq 2.10):
/// I A_s A_o (N_s·R)(N_o·L)/r².
#[must_use]
pub fn exchanged_flux<R: Real>(radiance: R, areas: [R; 2], cosines: [R; 2], distance: R) -> R {
    radiance * areas[0] * areas[1] * cosines[0] * cosines[1] / (distance * distance)
}

/// dω_t/dω_i of a bundle of rays that is refracted: n_i² cos θ_i / (n_t² cos θ_t) (book eqs 2.29–2.32, with the errata); `eta` = n_t/n_i.
///
/// ```
/// use illuminant_optics::solid_angle::refracted;
/// // What goes through keeps its flux: I_t = n² I_i, so radiance times cosine times solid angle is the same.
/// let (cos_i, eta) = (0.6f64, 1.5f64);
/// let cos_t = (1.0 - (1.0 - cos_i * cos_i) / (eta * eta)).sqrt();
/// assert!((eta * eta * refracted(cos_i, cos_t, eta) * cos_t - cos_i).abs() < 1e-12);
/// ```
#[must_use]
pub fn refracted<R: Real>(cos_i: R, cos_t: R, eta: R) -> R {
    cos_i / (eta * eta * cos_t)
}
