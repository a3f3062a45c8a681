//! Illumination models: what a surface does with light.
//!
//! A [`Material`] is a physical description (curves on wavelength, roughness). An illumination model derives from it
//! what it needs, in lanes, and answers one trait, [`IlluminationModel`]; every technique asks through that trait.
//! A new model is one file that implements it and one line in [`Illumination`].

mod coated;
mod coherence;
mod conductor;
mod dielectric;
mod finish;
mod general;
mod material;
mod model;
mod relief;
mod rough_boundary;
mod spectral;

pub use coated::{Body, Coated, MetalUnder, Vehicle};
pub use conductor::{Conductor, Metal};
pub use dielectric::Dielectric;
pub use finish::Finish;
pub use general::General;
pub use material::{Film, Flakes, Material, REPRESENTATIVE_NM, Surface};
pub use model::{Claims, DiscreteLobe, Hero, IlluminationModel, Incidence, Index, Prepare, Scattered};
pub use spectral::Spectral;

use std::fmt;
use std::str::FromStr;

/// The illumination models by name: the registry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Illumination {
    /// Energy equilibrium at every surface (book eq 2.49).
    #[default]
    General,
}

impl Illumination {
    /// All models.
    pub const ALL: &'static [Self] = &[Self::General];
}

impl fmt::Display for Illumination {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
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
            format!("no illumination model {name:?}; known is {}", known.join(", "))
        })
    }
}
