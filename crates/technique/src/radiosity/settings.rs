//! What radiosity is told.

use illuminant_radiosity::{Method, Solver};
use serde::{Deserialize, Serialize};

/// What a pixel makes of the solution.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Gather {
    /// It is shown as it is, interpolated between the corners of elements.
    #[default]
    None,
    /// Lamps are asked at every pixel; the light of other surfaces is that of the solution.
    Direct,
    /// A path looks around at every pixel, and meets the solution at the next diffuse surface (final gather).
    Full,
}

/// The ways of light of `hybrid` (book figure 4.27), each of which can be left out to see its part: how light arrives, and how it is
/// reflected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Mechanisms {
    /// From diffuse surfaces and lamps, to diffuse light: form factors.
    pub diffuse_to_diffuse: bool,
    /// By way of mirrors and glass, to diffuse light: extended form factors.
    pub specular_to_diffuse: bool,
    /// From diffuse surfaces and lamps, mirrored or let through to the eye.
    pub diffuse_to_specular: bool,
    /// By way of mirrors and glass, mirrored or let through to the eye.
    pub specular_to_specular: bool,
}

impl Default for Mechanisms {
    fn default() -> Self {
        Self {
            diffuse_to_diffuse: true,
            specular_to_diffuse: true,
            diffuse_to_specular: true,
            specular_to_specular: true,
        }
    }
}

/// What radiosity is told.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RadiositySettings {
    /// About how many elements the surfaces are cut into.
    pub elements: u32,
    /// About how many patches they make; as many as elements unless it is said.
    pub patches: Option<u32>,
    /// Where direct light differs by more than this fraction from corner to corner of an element, elements are cut again.
    pub adaptive: Option<f64>,
    /// How form factors are found: `rays:1024`, `hemicube:64` …
    pub form_factors: String,
    /// How the equations are solved.
    pub solver: String,
    /// The relative residual at which iterations end.
    pub tolerance: f64,
    /// At how many places of a side each lamp is asked.
    pub light_samples: u32,
    /// What a pixel makes of the solution.
    pub gather: Gather,
    /// Which ways of light `hybrid` follows.
    pub mechanisms: Mechanisms,
    /// Rays along an edge of the frustum about the mirror direction, in which `hybrid` samples what rough surfaces mirror (Wallace et al.
    /// 1987); none draws one ray by chance.
    pub frustum: Option<u32>,
    /// Cells along an edge of the cubes of `specular-radiosity`.
    pub cube: u32,
}

impl Default for RadiositySettings {
    fn default() -> Self {
        Self {
            elements: 6000,
            patches: None,
            adaptive: None,
            form_factors: Method::default().to_string(),
            solver: Solver::default().to_string(),
            tolerance: 1e-5,
            light_samples: 64,
            gather: Gather::None,
            mechanisms: Mechanisms::default(),
            frustum: None,
            cube: 32,
        }
    }
}

impl RadiositySettings {
    /// The most elements.
    pub const MOST_ELEMENTS: u32 = 4_000_000;

    /// The method and the solver.
    ///
    /// # Errors
    /// A sentence on what cannot be.
    pub fn checked(&self) -> Result<(Method, Solver), String> {
        if !(1..=Self::MOST_ELEMENTS).contains(&self.elements) {
            return Err(format!("elements must be 1 to {}, not {}", Self::MOST_ELEMENTS, self.elements));
        }
        if self.patches.is_some_and(|patches| !(1..=self.elements).contains(&patches)) {
            return Err("patches must be 1 or more, and not more than elements".into());
        }
        if self.adaptive.is_some_and(|a| !(a > 0.0 && a <= 10.0)) {
            return Err("adaptive must be a fraction above 0, such as 0.2".into());
        }
        if !(self.tolerance > 0.0 && self.tolerance < 1.0) {
            return Err(format!("tolerance must lie between 0 and 1, not {}", self.tolerance));
        }
        if !(1..=65536).contains(&self.light_samples) {
            return Err(format!("light samples must be 1 to 65536, not {}", self.light_samples));
        }
        if !(4..=256).contains(&self.cube) {
            return Err(format!("a cube must have 4 to 256 cells along an edge, not {}", self.cube));
        }
        if self.frustum.is_some_and(|n| !(2..=32).contains(&n)) {
            return Err("frustum must be 2 to 32 rays along an edge".into());
        }
        Ok((self.form_factors.parse()?, self.solver.parse()?))
    }
}
