//! What a render is told beside its scene.

use crate::Filter;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// How light is followed: the registry of techniques.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Technique {
    /// Path tracing (Kajiya 1986).
    #[default]
    Path,
}

impl Technique {
    /// All techniques.
    pub const ALL: &'static [Self] = &[Self::Path];
}

impl fmt::Display for Technique {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Path => "path",
        })
    }
}

impl FromStr for Technique {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        Self::ALL.iter().find(|t| t.to_string() == name).copied().ok_or_else(|| {
            let known: Vec<_> = Self::ALL.iter().map(ToString::to_string).collect();
            format!("no technique {name:?}; known is {}", known.join(", "))
        })
    }
}

/// A layer of the film.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Layer {
    /// Absolute XYZ; always there.
    Xyz,
    /// Y of the second half of the samples, and their number; there when replicates are asked for.
    Halves,
    /// XYZ of each lamp by itself.
    Lamps,
    /// The spectral samples, W·sr⁻¹·m⁻²·nm⁻¹.
    Spectra,
    /// Distance of what the camera sees, m.
    Depth,
    /// Its shading normal.
    Normal,
    /// Its reflectance as XYZ under equal energy, relative.
    Albedo,
    /// The fraction of the pixel that emits.
    Emission,
}

/// What a render is told.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// `path`.
    pub technique: String,
    /// `general`.
    pub illumination: String,
    /// The spectral sampling: `fitted:8`, `1nm` …
    pub sampling: String,
    /// The longest path in segments: 1 shows lamps only, 2 direct light; none is no limit.
    pub depth: Option<u32>,
    /// Another seed is another noise.
    pub seed: u64,
    /// 0 is one for each core.
    pub threads: usize,
    /// The reconstruction filter.
    pub filter: Filter,
    /// The layers beside XYZ.
    pub layers: Vec<Layer>,
    /// Width and height of a tile, pixels.
    pub tile: u32,
    /// 2 keeps two independently scrambled halves, for an estimate of the error.
    pub replicates: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            technique: Technique::default().to_string(),
            illumination: illuminant_illumination::Illumination::default().to_string(),
            sampling: "fitted:8".into(),
            depth: None,
            seed: 0,
            threads: 0,
            filter: Filter::default(),
            layers: Vec::new(),
            tile: 16,
            replicates: 1,
        }
    }
}
