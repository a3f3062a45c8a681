//! Illumination models: what a surface does with light.
//!
//! A [`Material`] is a physical description (curves on wavelength, roughness). An illumination model derives from it
//! what it needs, in lanes, and answers one trait, [`IlluminationModel`]; every technique asks through that trait.
//! A new model is one file that implements it and one line in [`Illumination`].

mod atmosphere;
mod blinn;
mod bouknight;
mod coated;
mod coefficient_curves;
mod coherence;
mod conductor;
mod cook_torrance;
mod dielectric;
mod finish;
mod general;
mod hall;
mod highlight;
mod historic;
mod historical;
mod material;
mod model;
mod phong;
mod relief;
mod rough_boundary;
mod samples;
mod shading;
mod spectral;
mod translucent;
mod whitted;

pub use atmosphere::{Atmosphere, filter_attenuation};
pub use blinn::Blinn;
pub use bouknight::Bouknight;
pub use coated::{Body, Coated, MetalUnder, Vehicle};
pub use coefficient_curves::{
    COPPER_SPHERES, CoefficientCurves, Overrides, SHARPEST_BETA, specular_and_diffuse_energy,
};
pub use conductor::{Conductor, Metal};
pub use cook_torrance::CookTorrance;
pub use dielectric::Dielectric;
pub use finish::Finish;
pub use general::General;
pub use hall::Hall;
pub use highlight::{Highlight, Masking};
pub use historic::Historic;
pub use historical::{Asked, AskedPair, Coefficients, Historical, Side, Terms};
pub use material::{Film, Flakes, Material, REPRESENTATIVE_NM, Surface};
pub use model::{
    Blurred, Claims, Components, CosineModel, DiscreteLobe, Hero, IlluminationModel, Incidence, Index,
    LobeAxis, Prepare, Scattered,
};
pub use phong::Phong;
pub use samples::{Samples, Weighed};
pub use shading::{Light, Shaded, shade};
pub use spectral::Spectral;
pub use translucent::Translucent;
pub use whitted::Whitted;

use std::fmt;
use std::str::FromStr;

/// The illumination models by name: the registry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Illumination {
    /// Ambient and diffuse light (1970).
    Bouknight,
    /// A highlight about the mirror direction (1975).
    Phong,
    /// Facets with Fresnel's reflectance (1977).
    Blinn,
    /// Rays for mirrors and glass (1980).
    Whitted,
    /// Fresnel's reflectance for rays and highlights, highlights through glass (1983).
    Hall,
    /// A model of energy (1982).
    CookTorrance,
    /// Energy equilibrium at every surface (book eq 2.49).
    #[default]
    General,
}

impl Illumination {
    /// All models.
    pub const ALL: &'static [Self] = &[
        Self::Bouknight,
        Self::Phong,
        Self::Blinn,
        Self::Whitted,
        Self::Hall,
        Self::CookTorrance,
        Self::General,
    ];
}

impl fmt::Display for Illumination {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Bouknight => "bouknight",
            Self::Phong => "phong",
            Self::Blinn => "blinn",
            Self::Whitted => "whitted",
            Self::Hall => "hall",
            Self::CookTorrance => "cook-torrance",
            Self::General => "general",
        })
    }
}

impl FromStr for Illumination {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let found = Self::ALL.iter().find(|model| model.to_string() == name);
        found.copied().ok_or_else(|| {
            let known: Vec<_> = Self::ALL.iter().map(ToString::to_string).collect();
            format!("no illumination model {name:?}; known are {}", known.join(", "))
        })
    }
}
