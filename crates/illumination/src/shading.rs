//! Local shading with a historical model: over lights, and through what it asks of directions (book III.6).

use crate::{Coefficients, Illumination, Samples, Side};
use illuminant_optics::Vector;

/// The parts of the radiance that a surface sends to the viewer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shaded<S> {
    /// Of light that comes evenly from everywhere.
    pub ambient: S,
    /// Of lights, from under the surface.
    pub diffuse: S,
    /// Of lights and from the mirror direction.
    pub specular: S,
    /// Through the surface.
    pub transmitted: S,
}

impl<S: Samples> Shaded<S> {
    /// All parts together.
    #[must_use]
    pub fn sum(&self) -> S {
        self.ambient + self.diffuse + self.specular + self.transmitted
    }
}

/// A light as a historical model has it.
#[derive(Clone, Copy, Debug)]
pub struct Light<S> {
    /// Unit vector to it, local.
    pub direction: Vector<f64>,
    /// Its intensity: irradiance at normal incidence over π.
    pub intensity: S,
}

/// The radiance that a surface sends along `v`. `ask` gives the radiance from a local direction, or nothing where there is none.
///
/// ```
/// use illuminant_illumination::{CoefficientCurves, Illumination, Light, Material, Side, Surface, shade};
/// use illuminant_spectrum::{Curve, SpectralRange};
/// let paint = Material::new("grey", Surface::Diffuse { reflectance: Curve::constant(0.4) });
/// let surface = CoefficientCurves::new(&paint, Illumination::Bouknight, SpectralRange::default()).reduce(|c| c.at(550.0));
/// let side = Side { outside: 1.0, inside: 1.0, outside_is_air: true };
/// let light = Light { direction: [0.0, 0.6, 0.8], intensity: 10.0 };
/// let shaded = shade(Illumination::Bouknight, &surface, &side, [0.0, 0.0, 1.0], 1.0, &[light], |_| None);
/// assert!((shaded.sum() - (0.4 * 1.0 + 0.4 * 0.8 * 10.0)).abs() < 1e-12); // book eq 4.9
/// ```
pub fn shade<S: Samples>(
    model: Illumination,
    surface: &Coefficients<S>,
    side: &Side,
    v: Vector<f64>,
    ambient: S,
    lights: &[Light<S>],
    mut ask: impl FnMut(Vector<f64>) -> Option<S>,
) -> Shaded<S> {
    let mut shaded = Shaded::default();
    if v[2] > 0.0 && side.outside_is_air {
        shaded.ambient = surface.ambient * ambient;
    }
    for light in lights {
        let terms = model.terms(surface, side, v, light.direction);
        shaded.diffuse += terms.diffuse * light.intensity;
        shaded.specular += terms.specular * light.intensity;
        shaded.transmitted += terms.transmitted * light.intensity;
    }
    let [mirror, through] = model.asked(surface, side, v);
    if let Some((ray, radiance)) = mirror.and_then(|ray| Some((ray, ask(ray.direction)?))) {
        shaded.specular += ray.weight * radiance;
    }
    if let Some((ray, radiance)) = through.and_then(|ray| Some((ray, ask(ray.direction)?))) {
        shaded.transmitted += ray.weight * radiance;
    }
    shaded
}
