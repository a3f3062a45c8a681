//! The trait behind which every illumination model stands.

use crate::{Illumination, Material};
use glam::Vec3;
use illuminant_sampling::{Basis, Lanes};
use illuminant_spectrum::SpectralRange;
use std::ops::Range;

/// The laws a model claims; the tests check each claim, and that what is not claimed really fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Claims {
    /// f(v, l) = f(l, v), up to the n² of the two sides.
    pub reciprocal: bool,
    /// No direction receives back more than came.
    pub energy_conserving: bool,
    /// Nothing is lost either, but to absorption.
    pub equilibrium: bool,
    /// Where the model comes from.
    pub source: &'static str,
}

/// The one sample that a path still carries after a dispersive refraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hero {
    /// Its number among all samples of the basis.
    pub sample: usize,
}

/// The index of refraction on one side of a boundary.
#[derive(Clone, Copy, Debug)]
pub struct Index<'a, const N: usize> {
    /// At the representative wavelength.
    pub mean: f32,
    /// The smallest over the range.
    pub least: f32,
    /// In every lane.
    pub lanes: &'a Lanes<N>,
}

/// What a model knows of the place and the view: local vectors have z along the normal.
#[derive(Clone, Copy, Debug)]
pub struct Incidence<'a, const N: usize> {
    /// Unit vector to the viewer.
    pub to_viewer: Vec3,
    /// The index on the viewer's side.
    pub near: Index<'a, N>,
    /// The index on the other side.
    pub far: Index<'a, N>,
    /// The one lane still carried, if the path has been dispersed and that lane is of this pass.
    pub hero_lane: Option<usize>,
}

/// A direction drawn by a model.
#[derive(Clone, Copy, Debug)]
pub struct Scattered<const N: usize> {
    /// Unit vector, local, from which light is asked for.
    pub direction: Vec3,
    /// f |cos| / pdf in every lane (for a discrete lobe: its weight over its probability).
    pub weight: Lanes<N>,
    /// The same for the whole spectrum as one number, without the n² of radiance: what decides a path's length.
    pub brightness: f32,
    /// Density of the direction, 1/sr; `None` where `eval` and `pdf` do not know it: for a discrete lobe, and for a
    /// direction that dispersion gives to one lane alone.
    pub pdf: Option<f32>,
    /// Whether the direction lies on the other side.
    pub transmitted: bool,
    /// Whether only one lane can follow this direction: it has been bent by that lane's own index.
    pub disperses: bool,
}

/// A direction out of a model's discrete part.
#[derive(Clone, Copy, Debug)]
pub struct DiscreteLobe<const N: usize> {
    /// Unit vector, local.
    pub direction: Vec3,
    /// What the radiance from there is multiplied by.
    pub weight: Lanes<N>,
    /// The same for the whole spectrum as one number, without the n² of radiance: what decides whether it is followed.
    pub brightness: f32,
    /// Whether it lies on the other side.
    pub transmitted: bool,
}

/// A direction of a discrete lobe of a surface that may be rough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Blurred {
    /// The lobe's own.
    Sharp,
    /// That of a facet; unit, local.
    To(Vec3),
    /// The facet is turned away, or sends light back into the surface: nothing comes from it.
    Lost,
}

/// The parts of a bidirectional function, 1/sr.
#[derive(Clone, Copy, Debug, Default)]
pub struct Components<const N: usize> {
    /// From under the surface.
    pub diffuse: Lanes<N>,
    /// From the surface itself, and through it.
    pub specular: Lanes<N>,
}

/// About which direction the highlight of a [`CosineModel`] lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LobeAxis {
    /// R·L, of the mirror direction of the view.
    Mirror,
    /// N·H.
    Half,
}

/// A model that is K_a I_a + K_d (N·L) I + K_s cosⁿ I and nothing else, I being irradiance over π: two cosines, which incremental
/// techniques can follow without the model.
#[derive(Clone, Copy, Debug)]
pub struct CosineModel<const N: usize> {
    /// K_a.
    pub ambient: Lanes<N>,
    /// K_d.
    pub diffuse: Lanes<N>,
    /// K_s; 0 where there is no highlight.
    pub specular: Lanes<N>,
    /// n.
    pub exponent: f32,
    /// Which cosine.
    pub axis: LobeAxis,
}

/// What a technique asks of a surface. All vectors are local, unit, and point away from the surface.
///
/// Decisions may look at brightness, never at lanes, so that every spectral sampling follows the same paths.
pub trait IlluminationModel<const N: usize>: Send + Sync {
    /// The bidirectional reflectance or transmittance f(v, l), 1/sr, of the continuous part: without cosine.
    fn eval(&self, at: &Incidence<'_, N>, to_light: Vec3) -> Lanes<N>;

    /// The same, with what comes from under the surface by itself.
    fn components(&self, at: &Incidence<'_, N>, to_light: Vec3) -> Components<N> {
        Components { diffuse: Lanes::default(), specular: self.eval(at, to_light) }
    }

    /// The density, 1/sr, with which [`Self::sample`] draws a direction of the continuous part.
    fn pdf(&self, at: &Incidence<'_, N>, to_light: Vec3) -> f32;

    /// Draws a direction from three numbers in [0, 1); `hero` is the lane that a dispersive refraction would keep
    /// (`None` when it is not of this pass: the lanes then come back zero). `None` when the path ends here.
    fn sample(&self, at: &Incidence<'_, N>, u: [f32; 3], hero: Option<usize>) -> Option<Scattered<N>>;

    /// The discrete lobes: mirror direction and smooth refraction. Empty for rough surfaces.
    fn discrete_lobes(&self, at: &Incidence<'_, N>) -> Vec<DiscreteLobe<N>>;

    /// The direction of a discrete lobe where a rough surface blurs it (Cook, Porter and Carpenter 1984): mirrored or bent by a facet that is
    /// drawn as the highlight's distribution says, from two numbers in [0, 1).
    fn blurred(&self, _at: &Incidence<'_, N>, _lobe: &DiscreteLobe<N>, _u: [f32; 2]) -> Blurred {
        Blurred::Sharp
    }

    /// Whether what the surface itself reflects of other surfaces is the model's own continuous part, which [`Self::gloss_ray`] follows:
    /// older models know lamps alone.
    fn follows_gloss(&self) -> bool {
        false
    }

    /// A direction in which the continuous part of what the surface itself reflects or lets through is followed, f_s |cos|/pdf, from
    /// three numbers in [0, 1); the density is that of [`Self::pdf`].
    fn gloss_ray(&self, _at: &Incidence<'_, N>, _u: [f32; 3]) -> Option<Scattered<N>> {
        None
    }

    /// Whether the model has a continuous part at all, so that asking lamps is worth it.
    fn is_continuous(&self) -> bool;

    /// Whether the surface is the border of two media: light that passes through it is then in the other.
    fn bounds_media(&self) -> bool;

    /// What the continuous part returns of light that comes evenly from everywhere, for techniques that do not follow it.
    /// What is reflected by the surface itself comes from about the mirror direction.
    fn ambient(&self, at: &Incidence<'_, N>) -> Components<N>;

    /// The half-angle, radians, of the cone about the mirror direction in which a reflection map is seen: where the highlight has half its
    /// strength.
    fn gloss(&self) -> f32 {
        0.0
    }

    /// What the surface lets through, for techniques that look straight through it (Newell, Newell and Sancha 1972): the radiance behind
    /// it is multiplied by this, and n² is left out, which two boundaries cancel.
    fn see_through(&self, at: &Incidence<'_, N>) -> Lanes<N> {
        let through = self.discrete_lobes(at).into_iter().filter(|lobe| lobe.transmitted);
        through.fold(Lanes::default(), |sum, lobe| sum + lobe.weight)
    }

    /// The same surface where an image gives the colour of what lies under it or in it: the reflectance of a diffuser, a
    /// translucent sheet or a pigment, the transmittance of a filter, in lanes and as one number. Other surfaces have no such colour, and stay as they are.
    #[must_use]
    fn coloured(&self, colour: &Lanes<N>, brightness: f32) -> Self
    where
        Self: Sized;

    /// Where between the same surface in black and in white it lies with a colour: all that it does with light is linear in this.
    #[must_use]
    fn share_of_white(&self, _at: &Incidence<'_, N>, colour: &Lanes<N>) -> Lanes<N> {
        *colour
    }

    /// The model as two cosines, if it is no more.
    fn cosines(&self) -> Option<CosineModel<N>> {
        None
    }

    /// The laws it claims.
    fn claims(&self) -> Claims;
}

/// How a model is made from a material: the documented rule of each model.
pub trait Prepare: Sized + Clone + Send + Sync {
    /// Derives the coefficients of a model in the lanes of one pass (`samples` of `basis`). `brightness` is that of
    /// [`Material::brightness`], which is the same for all passes.
    fn prepare(
        material: &Material,
        model: Illumination,
        brightness: f32,
        basis: &dyn Basis,
        samples: Range<usize>,
        range: SpectralRange,
    ) -> Self;
}
