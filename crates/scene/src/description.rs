//! A resolved scene as plain data: what is written, sent, hashed, and made into a [`crate::Scene`].

use crate::pattern::Pattern;
use crate::photometry::Quantity;
use crate::texture::{Filtering, Wrap};
use illuminant_spectrum::{Outside, SpectralRange};
use serde::{Deserialize, Serialize};

/// Everything but shapes, placements and images.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Description {
    /// The wavelengths over which light is followed, nm.
    #[serde(default)]
    pub range: SpectralRange,
    /// All curves; the rest refers to them by index.
    pub curves: Vec<CurveData>,
    /// All materials.
    pub materials: Vec<MaterialData>,
    /// What images say of each material, in the same order; empty where they say nothing at all.
    #[serde(default)]
    pub skins: Vec<SkinData>,
    /// One for each placement, in the same order.
    pub objects: Vec<ObjectData>,
    /// Lamps that are no objects.
    #[serde(default)]
    pub lights: Vec<LightData>,
    /// The camera.
    pub camera: CameraData,
    /// What is in the air.
    #[serde(default)]
    pub medium: Option<MediumData>,
    /// What becomes of light on its way to the eye.
    #[serde(default)]
    pub atmosphere: Option<AtmosphereData>,
}

/// A curve on wavelength.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CurveData {
    /// The name that messages use.
    #[serde(default)]
    pub name: String,
    /// nm, increasing.
    pub wavelengths: Vec<f64>,
    /// One for each wavelength.
    pub values: Vec<f64>,
    /// The rule outside.
    pub outside: Outside,
}

/// A material.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialData {
    /// The name that messages use.
    pub name: String,
    /// What it is made of.
    pub surface: SurfaceData,
    /// What the historical models are told instead of what they would derive.
    #[serde(default)]
    pub coefficients: Vec<CoefficientsData>,
    /// Where bodies overlap, that of the highest priority is there.
    #[serde(default)]
    pub priority: u8,
}

/// What one historical model, or all, take instead of the rule by which coefficients follow from a surface; what is absent follows
/// the rule. Curves are indices.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CoefficientsData {
    /// The name of the model; absent for all.
    pub model: Option<String>,
    /// C_Ka, 0 or above.
    pub ambient: Option<f64>,
    /// C_Kd, 0 or above.
    pub diffuse: Option<f64>,
    /// C_Ks, 0 or above.
    pub specular: Option<f64>,
    /// C_Kt, 0 or above.
    pub transmitted: Option<f64>,
    /// K_a and K_d, in [0, 1].
    pub diffuse_curve: Option<usize>,
    /// K_s, in [0, 1].
    pub specular_curve: Option<usize>,
    /// K_t, in [0, 1].
    pub transmitted_curve: Option<usize>,
    /// β between N and H where the highlight has half its strength, degrees, above 0 and below 90.
    pub half_angle_deg: Option<f64>,
    /// N_s, C₁, C₂² or m² of the distribution, above 0, instead of β.
    pub exponent: Option<f64>,
    /// How facets lie.
    pub distribution: Option<LobeData>,
    /// What hides them.
    pub masking: Option<MaskingData>,
    /// p of (N·L)^p, 1 to 5.
    pub terminator: Option<f64>,
}

/// A distribution of facets of the literature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LobeData {
    /// (R·L)^N_s.
    Phong,
    /// (N·H)^N_s.
    Blinn,
    /// Of C₁.
    Gaussian,
    /// Of C₂².
    TrowbridgeReitz,
    /// Beckmann's, of m².
    Cook,
}

/// A masking of facets of the literature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MaskingData {
    /// Nothing hides.
    None,
    /// V-grooves.
    TorranceSparrow,
    /// A Gaussian surface of the highlight's β.
    Sancer,
}

/// The physics of a surface; curves are indices.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum SurfaceData {
    /// An ideal diffuser.
    Diffuse {
        /// Reflectance, in [0, 1].
        reflectance: usize,
    },
    /// A conductor.
    Conductor {
        /// Real part of the index.
        n: usize,
        /// Imaginary part.
        k: usize,
        /// Its relief.
        #[serde(default)]
        finish: FinishData,
    },
    /// A thin filter.
    Filter {
        /// Fraction of light let through.
        transmittance: usize,
    },
    /// A thin sheet that scatters light on both sides.
    Translucent {
        /// Reflectance, in [0, 1].
        reflectance: usize,
        /// Transmittance, in [0, 1]; with the reflectance at most 1.
        transmittance: usize,
    },
    /// A dielectric body.
    Dielectric {
        /// Index of refraction.
        n: usize,
        /// Its relief.
        #[serde(default)]
        finish: FinishData,
        /// Absorption coefficient, 1/m.
        #[serde(default)]
        absorption: Option<usize>,
        /// Whether the index follows the curve.
        #[serde(default = "yes")]
        dispersion: bool,
    },
    /// A vehicle over a pigment or metal.
    Coated {
        /// Index of refraction of the vehicle.
        n: usize,
        /// The relief of its outer surface.
        #[serde(default)]
        finish: FinishData,
        /// What the vehicle absorbs.
        #[serde(default)]
        film: Option<FilmData>,
        /// Reflectance of the pigment for diffuse light inside the vehicle, in [0, 1].
        pigment: usize,
        /// Metal in the vehicle or under it.
        #[serde(default)]
        flakes: Option<FlakesData>,
    },
}

/// The relief of a surface.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FinishData {
    /// The slope m along the grain and across it, 0 to 1; 0 is smooth.
    pub slope: [f64; 2],
    /// The rms height σ, nm; absent where it is much greater than a wavelength.
    #[serde(default)]
    pub sigma_nm: Option<f64>,
    /// How slopes are distributed.
    #[serde(default)]
    pub shape: ShapeData,
    /// A direction in the world along which the grain runs.
    #[serde(default)]
    pub grain: Option<[f32; 3]>,
}

/// A distribution of slopes.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ShapeData {
    /// Gaussian.
    #[default]
    Beckmann,
    /// With long tails.
    Ggx,
}

/// What images say of a material.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SkinData {
    /// Reflectance of a diffuser, a translucent sheet or a pigment, transmittance of a filter.
    pub colour: Option<ColourTextureData>,
    /// The slope of the relief.
    pub slope: Option<SlopeTextureData>,
    /// How the normal is perturbed.
    pub relief: Option<ReliefTextureData>,
}

/// What a texture's values come from.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(untagged)]
pub enum MapData {
    /// An image on the surface.
    Image(ImageMapData),
    /// A function; its value x is the channels 1 − x, x and 0.
    Pattern(Pattern),
}

/// An image and how it lies on a surface.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImageMapData {
    /// Key of the image.
    pub image: String,
    /// What lies beyond its border.
    #[serde(default)]
    pub wrap: Wrap,
    /// How it is filtered.
    #[serde(default)]
    pub filtering: Filtering,
    /// How often it stands along u and v.
    #[serde(default = "once")]
    pub repeat: [f32; 2],
    /// Where its lower left corner lies, in images.
    #[serde(default)]
    pub offset: [f32; 2],
}

fn once() -> [f32; 2] {
    [1.0, 1.0]
}

/// An image of colours.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ColourTextureData {
    /// The image.
    pub map: MapData,
    /// Indices of the curves that one unit of each channel is.
    pub basis: [usize; 3],
    /// Whether it shows finished paint, of which the pigment is wanted.
    #[serde(default)]
    pub finished: bool,
}

/// An image of slopes.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SlopeTextureData {
    /// The image.
    pub map: MapData,
    /// Which channel.
    #[serde(default)]
    pub channel: usize,
    /// The slopes of 0 and 1.
    pub slopes: [f64; 2],
}

/// An image that perturbs normals.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum ReliefTextureData {
    /// Heights.
    Heights {
        /// The image.
        map: MapData,
        /// Which channel.
        #[serde(default)]
        channel: usize,
        /// The height of 1, m.
        height: f32,
    },
    /// Normals, each component n stored as (n + 1)/2: along u, along v, away from the surface.
    Normals {
        /// The image.
        map: ImageMapData,
        /// A factor on the slopes.
        strength: f32,
    },
}

/// A layer that absorbs.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FilmData {
    /// Absorption coefficient, 1/m.
    pub absorption: usize,
    /// Thickness, m.
    pub thickness: f64,
}

/// Metal in a vehicle or under it.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FlakesData {
    /// Real part of its index.
    pub n: usize,
    /// Imaginary part.
    pub k: usize,
    /// Slope m of the metal and of how flakes lie, 0 to 1.
    pub slope: f64,
    /// The fraction of the area covered, 0 to 1.
    pub coverage: f64,
}

fn yes() -> bool {
    true
}

/// What an object is made of, and what it emits.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObjectData {
    /// The name that messages use.
    pub name: String,
    /// Index of its material.
    pub material: usize,
    /// Its emission, if it is a lamp.
    #[serde(default)]
    pub emission: Option<EmissionData>,
}

/// The emission of a surface.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EmissionData {
    /// Index of the curve.
    pub spectrum: usize,
    /// How bright.
    pub quantity: Quantity,
    /// Which sides emit.
    #[serde(default)]
    pub sides: Sides,
    /// How intensity depends on the angle from the normal; absent for Lambert's law.
    #[serde(default)]
    pub distribution: Option<DistributionData>,
}

/// How intensity depends on the angle from an axis.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DistributionData {
    /// cosᵖ.
    CosinePower(f64),
    /// Pairs of an angle in degrees and a value.
    Table(Vec<[f64; 2]>),
}

/// The sides of a surface that emit; the front is where its corners run counter-clockwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Sides {
    /// The front only.
    #[default]
    Front,
    /// Both.
    Both,
}

/// A lamp that is no object.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum LightData {
    /// A point that shines as a photometric web says.
    Luminaire {
        /// The name that messages use.
        name: String,
        /// Where.
        position: [f32; 3],
        /// Along γ = 0.
        axis: [f32; 3],
        /// Towards C = 0, at right angles to the axis as far as it is not.
        across: [f32; 3],
        /// The angles C, degrees.
        planes_deg: Vec<f64>,
        /// The angles γ, degrees.
        angles_deg: Vec<f64>,
        /// The values, plane by plane, to any scale.
        values: Vec<f64>,
        /// Index of the curve.
        spectrum: usize,
        /// How bright: an intensity is the largest.
        quantity: Quantity,
    },
    /// A point.
    Point {
        /// The name that messages use.
        name: String,
        /// Where.
        position: [f32; 3],
        /// Along the axis of its distribution.
        #[serde(default)]
        axis: Option<[f32; 3]>,
        /// How intensity depends on the angle from the axis; absent for the same everywhere.
        #[serde(default)]
        distribution: Option<DistributionData>,
        /// Index of the curve.
        spectrum: usize,
        /// How bright: an intensity is that along the axis.
        quantity: Quantity,
    },
    /// A point that shines into a cone.
    Spot {
        /// The name that messages use.
        name: String,
        /// Where.
        position: [f32; 3],
        /// Along its axis.
        direction: [f32; 3],
        /// From the axis to the end of the light, degrees.
        half_angle_deg: f64,
        /// Over which it fades, inside the half-angle, degrees.
        #[serde(default)]
        penumbra_deg: f64,
        /// Index of the curve.
        spectrum: usize,
        /// How bright.
        quantity: Quantity,
    },
    /// Parallel light.
    Directional {
        /// The name that messages use.
        name: String,
        /// The direction in which it travels.
        direction: [f32; 3],
        /// Index of the curve.
        spectrum: usize,
        /// How bright.
        quantity: Quantity,
    },
    /// The clear sky, and the sun in it.
    Sky {
        /// The name that messages use.
        name: String,
        /// Whether the disc of the sun is in it, as another lamp.
        sun: bool,
        /// How hazy the air is, 1 to 10.
        turbidity: f64,
        /// What the ground reflects, 0 to 1.
        ground_albedo: f64,
        /// How high the sun stands, degrees.
        elevation_deg: f64,
        /// Where it stands, degrees from the middle of an environment image to the right.
        azimuth_deg: f64,
        /// The axis that points to the zenith.
        #[serde(default)]
        up: UpAxis,
    },
    /// Light from all around.
    Environment {
        /// The name that messages use.
        name: String,
        /// Index of the curve; with an image it may be left out, for the white of its RGB system.
        #[serde(default)]
        spectrum: Option<usize>,
        /// How bright: with an image, RGB (1, 1, 1).
        quantity: Quantity,
        /// Key of the image.
        #[serde(default)]
        image: Option<String>,
        /// What RGB means.
        #[serde(default = "srgb")]
        rgb_system: String,
        /// The axis that points to the zenith.
        #[serde(default)]
        up: UpAxis,
        /// Turn about that axis, degrees, counter-clockwise seen from the zenith.
        #[serde(default)]
        rotation_deg: f64,
    },
}

fn srgb() -> String {
    "sRGB".into()
}

/// Which axis of the world points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum UpAxis {
    /// y.
    #[default]
    Y,
    /// z.
    Z,
}

/// What becomes of light on its way to the eye.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum AtmosphereData {
    /// Fog, linearly from one distance to another.
    Fog {
        /// Where fading begins, m.
        start: f64,
        /// Where nothing else is seen, m.
        end: f64,
        /// Index of the curve of its light.
        spectrum: usize,
        /// How bright.
        quantity: Quantity,
    },
    /// A power of the distance.
    Distance {
        /// The exponent.
        power: f64,
        /// Where nothing is lost or gained, m.
        unit: f64,
    },
}

/// A participating medium. Curves are indices.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MediumData {
    /// Absorption coefficient, 1/m.
    #[serde(default)]
    pub absorption: Option<usize>,
    /// Scattering coefficient, 1/m.
    #[serde(default)]
    pub scattering: Option<usize>,
    /// How scattered light is spread.
    pub phase: PhaseData,
    /// Two corners of a box; absent for everywhere.
    #[serde(default)]
    pub bounds: Option<[[f64; 3]; 2]>,
    /// The name of the image that holds the density over the box, one channel, rows and slices one after the other; and its cells along x, y, z.
    #[serde(default)]
    pub density: Option<(String, [usize; 3])>,
}

/// How scattered light is spread.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PhaseData {
    /// The mean cosine.
    HenyeyGreenberg(f64),
    /// Of small particles.
    Rayleigh,
}

/// The camera.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraData {
    /// Where it is.
    pub eye: [f64; 3],
    /// Where it looks.
    pub target: [f64; 3],
    /// What is up in the image.
    pub up: [f64; 3],
    /// Across the width, degrees.
    pub field_of_view_deg: f64,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// x₀, y₀, x₁, y₁.
    #[serde(default)]
    pub crop: Option<[u32; 4]>,
    /// Opening and closing, as fractions of the motion.
    #[serde(default)]
    pub shutter: [f32; 2],
    /// A lens.
    #[serde(default)]
    pub lens: Option<LensData>,
    /// Where it is at the end of the motion; absent for a camera at rest.
    #[serde(default)]
    pub end: Option<ViewData>,
}

/// A place and a direction of view.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ViewData {
    /// Where the camera is.
    pub eye: [f64; 3],
    /// Where it looks.
    pub target: [f64; 3],
    /// What is up in the image.
    pub up: [f64; 3],
}

/// A thin lens.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LensData {
    /// Half the diameter of the aperture, m.
    pub radius: f64,
    /// Distance of the focal plane along the direction of view, m.
    pub focus: f64,
    /// The blades of the aperture; 0 for a circle.
    #[serde(default)]
    pub blades: u32,
    /// How far they are turned, degrees.
    #[serde(default)]
    pub turn_deg: f64,
}
