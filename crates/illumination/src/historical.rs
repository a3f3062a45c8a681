//! What the models before energy equilibrium have in common.
//!
//! They speak of a light's *intensity* I where physics speaks of irradiance: a perfect diffuser that faces a lamp has
//! the radiance I = E/π, so K_d (N·L) I is the radiance of a diffuser of reflectance K_d, and all other terms are on that scale
//! (book II.1.4: M in empirical models, M/π in those of energy). Vectors are local: the normal is [0, 0, 1] and points
//! to the outside.

use crate::{Highlight, Samples};
use illuminant_optics::Vector;
use illuminant_optics::fresnel::{conductor_approximated, dielectric};
use illuminant_optics::vectors::{dot, half, refract_either, sine};

/// The coefficients of a material as the historical models have them (book III.6): spectra with their multipliers.
#[derive(Clone, Copy, Debug)]
pub struct Coefficients<S> {
    /// C_Ka K_a.
    pub ambient: S,
    /// C_Kd K_d.
    pub diffuse: S,
    /// K_s; for models with Fresnel's equations the reflectance at normal incidence.
    pub specular: S,
    /// C_Ks.
    pub specular_scale: f64,
    /// C_Kt K_t.
    pub transmitted: S,
    /// The highlight.
    pub highlight: Highlight,
    /// The mean of K_s over wavelength, from which Fresnel's rise with the angle is taken (book III.20).
    pub mean_reflectance: f64,
    /// Index of a conductor, n and k; `None` for a dielectric, whose indices are those of the [`Side`].
    pub conductor: Option<[f64; 2]>,
    /// Whether light passes.
    pub transparent: bool,
    /// p of (N·L)^p: 1 is Lambert's, a little more hides the Mach band at the terminator (book figure 4.7).
    pub terminator: f64,
}

/// Where the view is taken from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// Index of refraction outside.
    pub outside: f64,
    /// Index inside.
    pub inside: f64,
    /// Whether outside is air, from which alone light comes (book III.6).
    pub outside_is_air: bool,
}

/// What a model makes of a light, as multiples of its intensity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Terms<S> {
    /// Scattered from under the surface.
    pub diffuse: S,
    /// Reflected by the surface.
    pub specular: S,
    /// Let through.
    pub transmitted: S,
}

impl<S: Samples> Terms<S> {
    /// All of it.
    #[inline(always)]
    #[must_use]
    pub fn sum(&self) -> S {
        self.diffuse + self.specular + self.transmitted
    }
}

/// A direction from which a model asks for radiance, and what it does with it.
#[derive(Clone, Copy, Debug)]
pub struct Asked<S> {
    /// Unit vector, local.
    pub direction: Vector<f64>,
    /// What the radiance is multiplied by.
    pub weight: S,
}

/// The mirror direction and the refracted one, where a model asks for them.
pub type AskedPair<S> = [Option<Asked<S>>; 2];

impl<S: Samples> Coefficients<S> {
    /// Fresnel's reflectance by Cook's interpolation (book III.20) at a facet that light from outside meets at the cosine `cos`,
    /// or, with `inside`, light from inside; 1 beyond the critical angle.
    #[inline]
    #[must_use]
    pub fn fresnel(&self, cos: f64, side: &Side, inside: bool) -> S {
        let average = match self.conductor {
            Some([n, k]) => {
                let [parallel, perpendicular] = conductor_approximated(cos, n, k);
                f64::midpoint(parallel, perpendicular)
            }
            None => {
                let eta = side.inside / side.outside;
                let eta = if inside { eta.recip() } else { eta };
                if sine(cos) >= eta {
                    return S::splat(1.0);
                }
                dielectric(cos, eta)
            }
        };
        let rise = (average - self.mean_reflectance) / (1.0 - self.mean_reflectance);
        (self.specular.times(1.0 - rise) + S::splat(rise)).positive()
    }

    /// C_Ks D G F, for a view and a light outside; 0 where H does not exist.
    #[inline]
    #[must_use]
    pub fn facets(&self, side: &Side, v: Vector<f64>, l: Vector<f64>) -> S {
        let Some(h) = half(l, v) else { return S::default() };
        let factor = self.specular_scale * self.highlight.d(l, v) * self.highlight.g(l, v);
        self.fresnel(dot(h, l), side, false).times(factor)
    }

    /// The diffuse term: C_Kd K_d (N·L)^p.
    #[inline]
    #[must_use]
    pub fn lambert(&self, l: Vector<f64>) -> S {
        let cos = if self.terminator == 1.0 { l[2] } else { l[2].powf(self.terminator) };
        self.diffuse.times(cos)
    }
}

/// A model of the past: what it makes of lights and of what rays bring.
pub trait Historical<S: Samples> {
    /// What it makes of a light in direction `l`, seen from `v`, where both are outside in air.
    fn lit(&self, surface: &Coefficients<S>, side: &Side, v: Vector<f64>, l: Vector<f64>) -> Terms<S>;

    /// What it lets through of a light in the air outside to a view from inside.
    fn let_through(&self, _surface: &Coefficients<S>, _side: &Side, _v: Vector<f64>, _l: Vector<f64>) -> S {
        S::default()
    }

    /// What it makes of a light anywhere: only that which comes from the air counts (book III.6).
    #[inline]
    fn terms(&self, surface: &Coefficients<S>, side: &Side, v: Vector<f64>, l: Vector<f64>) -> Terms<S> {
        if !side.outside_is_air || l[2] <= 0.0 || v[2] == 0.0 {
            Terms::default()
        } else if v[2] > 0.0 {
            self.lit(surface, side, v, l)
        } else {
            Terms { transmitted: self.let_through(surface, side, v, l), ..Terms::default() }
        }
    }

    /// The directions from which it asks for radiance: by default straight through what is transparent, without bending
    /// (Newell, Newell and Sancha 1972).
    #[inline]
    fn asked(&self, surface: &Coefficients<S>, _side: &Side, v: Vector<f64>) -> AskedPair<S> {
        let straight = Asked { direction: v.map(|c| -c), weight: surface.transmitted };
        [None, surface.transparent.then_some(straight)]
    }
}

/// The mirror direction.
pub(crate) fn mirrored(v: Vector<f64>) -> Vector<f64> {
    [-v[0], -v[1], v[2]]
}

/// The refracted direction.
pub(crate) fn refracted(v: Vector<f64>, side: &Side) -> Option<Vector<f64>> {
    refract_either(v, [0.0, 0.0, 1.0], side.outside, side.inside)
}
