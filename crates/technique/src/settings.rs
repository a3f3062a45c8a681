//! What a render is told beside its scene.

use crate::radiosity::RadiositySettings;
use crate::{Filter, Sampler};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// How light is followed: the registry of techniques.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Technique {
    /// Scanline, the model evaluated once a polygon (Bouknight 1970).
    Constant,
    /// Scanline, the model evaluated at corners and its light interpolated (Gouraud 1971).
    Gouraud,
    /// Scanline, normals interpolated and the model evaluated at every pixel (Phong 1975).
    Phong,
    /// Recursive ray tracing (Whitted 1980), without chance.
    Raytrace,
    /// Distributed ray tracing (Cook, Porter and Carpenter 1984).
    Distributed,
    /// Path tracing (Kajiya 1986).
    #[default]
    Path,
    /// Light between diffuse surfaces, solved for once (Goral et al. 1984).
    Radiosity,
    /// The same with what every patch sends into every direction (Immel et al. 1986).
    SpecularRadiosity,
    /// The same by way of mirrors and glass too, and rays for what these show (Wallace et al. 1987).
    Hybrid,
}

impl Technique {
    /// All techniques.
    pub const ALL: &'static [Self] = &[
        Self::Constant,
        Self::Gouraud,
        Self::Phong,
        Self::Raytrace,
        Self::Distributed,
        Self::Path,
        Self::Radiosity,
        Self::SpecularRadiosity,
        Self::Hybrid,
    ];

    /// Whether the light between surfaces is solved for before an image is made.
    #[must_use]
    pub fn is_solved(self) -> bool {
        matches!(self, Self::Radiosity | Self::SpecularRadiosity | Self::Hybrid)
    }

    /// Whether images are made scanline by scanline, of light straight from lamps alone.
    #[must_use]
    pub fn is_scanline(self) -> bool {
        matches!(self, Self::Constant | Self::Gouraud | Self::Phong)
    }
}

impl fmt::Display for Technique {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Constant => "constant",
            Self::Gouraud => "gouraud",
            Self::Phong => "phong",
            Self::Raytrace => "raytrace",
            Self::Distributed => "distributed",
            Self::Path => "path",
            Self::Radiosity => "radiosity",
            Self::SpecularRadiosity => "specular-radiosity",
            Self::Hybrid => "hybrid",
        })
    }
}

impl FromStr for Technique {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        Self::ALL.iter().find(|t| t.to_string() == name).copied().ok_or_else(|| {
            let known: Vec<_> = Self::ALL.iter().map(ToString::to_string).collect();
            format!("no technique {name:?}; known are {}", known.join(", "))
        })
    }
}

/// In which space a scanline technique interpolates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Interpolation {
    /// In the world, as perspective demands.
    #[default]
    Object,
    /// On the screen, as it was done first, with its anomalies (book figures 4.9 to 4.12).
    Screen,
}

/// How `phong` finds the illumination at a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shading {
    /// By the model itself.
    #[default]
    Full,
    /// By forward differences of numerator and denominator (Duff 1979), eye and lamps of each polygon at infinity.
    Duff,
    /// By a Taylor polynomial of second degree over each polygon (Bishop and Weimer 1986).
    BishopWeimer,
}

impl fmt::Display for Shading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Full => "full",
            Self::Duff => "duff",
            Self::BishopWeimer => "bishop-weimer",
        })
    }
}

/// How scanline techniques find what stands between a surface and a lamp.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Shadows {
    /// Not at all.
    #[default]
    None,
    /// With a ray to each place on a lamp.
    Rays,
    /// In images of the depth that lamps see (Williams 1978), so many texels wide.
    Maps(u32),
}

/// How scanline techniques smooth edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Antialiasing {
    /// Every sample finds what it sees and shades it.
    #[default]
    Supersampling,
    /// 32 places a sample find how much of a pixel each polygon covers, which is shaded once (Carpenter 1984).
    Coverage,
}

/// Where ray tracing asks lamps that have an area (book figures 4.17 and 4.18).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LightCentres {
    /// At so many fixed places: each point asks all of them (`raytrace`), or each sample one (`distributed`).
    Fixed(u32),
    /// Anywhere, each sample without regard to the others.
    Random,
    /// Anywhere, spread over the samples of a pixel. `raytrace`, which draws nothing, takes four fixed places.
    #[default]
    Jittered,
}

/// What scanline techniques hold at infinity, so that directions to it are the same at all points (book 4.2.3).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Infinite {
    /// The eye, for the model; the perspective stays.
    pub eye: bool,
    /// The lamps, whose light is everywhere as in the middle of the scene.
    pub lights: bool,
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
    /// The spectral samples of the light of each lamp by itself; there when both lamps and spectra are asked for.
    LampSpectra,
    /// Distance of what the camera sees, m.
    Depth,
    /// Its shading normal.
    Normal,
    /// Its reflectance as XYZ under equal energy, relative.
    Albedo,
    /// The fraction of the pixel that emits.
    Emission,
    /// XYZ of each term of the illumination model: ambient, diffuse, specular, transmitted, emitted. Scanline techniques only.
    Terms,
}

/// What a render is told.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// `constant`, `gouraud`, `phong`, `raytrace`, `distributed`, `path`, `radiosity`, `specular-radiosity`, `hybrid`.
    pub technique: String,
    /// `bouknight`, `phong`, … `general`.
    pub illumination: String,
    /// The spectral sampling: `fitted:8`, `1nm` …
    pub sampling: String,
    /// The longest path in segments: 1 shows lamps only, 2 direct light; none is no limit.
    pub depth: Option<u32>,
    /// Another seed is another noise.
    pub seed: u64,
    /// 0 is one for each core; at most [`illuminant_scene::embree::MOST_THREADS`].
    pub threads: usize,
    /// The reconstruction filter.
    pub filter: Filter,
    /// The layers beside XYZ.
    pub layers: Vec<Layer>,
    /// Lamps under which the image shall be seen later, which a fitted sampling is to serve too: relative spectra at each nm
    /// that the observer sees, 360 to 830.
    pub develop_for: Vec<Vec<f64>>,
    /// Width and height of a tile, pixels.
    pub tile: u32,
    /// 2 keeps two independently scrambled halves, for an estimate of the error.
    pub replicates: u32,
    /// Which random numbers.
    pub sampler: Sampler,
    /// The samples of a pixel among which the samplers that need to know it spread their numbers.
    pub strata: u32,
    /// The weight below which ray tracing follows a ray no more.
    pub threshold: f64,
    /// Whether the rays of `raytrace` are cones.
    pub cones: bool,
    /// Whether `path` finds from the lamps what mirrors and smooth glass make of their light on other surfaces.
    pub caustics: bool,
    /// Where ray tracing asks lamps that have an area.
    pub light_centres: LightCentres,
    /// The ambient light of all techniques but `path` as a fraction of what lamps would make of a white diffuser in the middle of
    /// the scene (book II.1.5: 0 to 0.3).
    pub ambient: f64,
    /// Where scanline techniques interpolate.
    pub interpolation: Interpolation,
    /// How `phong` finds the illumination at a pixel.
    pub shading: Shading,
    /// How scanline techniques look for what stands between a surface and a lamp.
    pub shadows: Shadows,
    /// How they smooth edges.
    pub antialiasing: Antialiasing,
    /// What they hold at infinity.
    pub infinite: Infinite,
    /// The area on the screen, in pixels, above which they subdivide polygons; none leaves them whole.
    pub subdivide: Option<f64>,
    /// What radiosity is told.
    pub radiosity: RadiositySettings,
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
            develop_for: Vec::new(),
            tile: 16,
            replicates: 1,
            sampler: Sampler::default(),
            strata: 16,
            threshold: 0.002,
            cones: false,
            caustics: false,
            light_centres: LightCentres::default(),
            ambient: 0.15,
            interpolation: Interpolation::default(),
            shading: Shading::default(),
            shadows: Shadows::default(),
            antialiasing: Antialiasing::default(),
            infinite: Infinite::default(),
            subdivide: None,
            radiosity: RadiositySettings::default(),
        }
    }
}
