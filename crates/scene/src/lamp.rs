//! Lamps: where light comes from, how a point asks for it, and with what density it is asked.

use crate::environment::EnvironmentImage;
use crate::geometry::Geometry;
use crate::light_tree::Extent;
use crate::sky::{Sky, Sun};
use crate::surface::{Hit, SurfacePoint};
use crate::surface_lamp::SurfaceLamp;
use glam::Vec3;
use illuminant_optics::goniometry::Distribution;
use illuminant_optics::photometric_web::PhotometricWeb;
use illuminant_spectrum::Curve;
use std::f32::consts::PI;

/// A lamp: a name, its absolute spectrum, and its form.
#[derive(Debug)]
pub struct Lamp {
    /// The name that messages and layers use.
    pub name: String,
    /// Absolute spectrum: radiance of surfaces and environments, intensity of points and spots (on the axis),
    /// irradiance on a facing surface of parallel light. For an image it is the radiance of RGB (1, 1, 1).
    pub spectrum: Curve,
    /// Where the light leaves from.
    pub form: LampForm,
}

/// The form of a lamp.
#[derive(Debug)]
pub enum LampForm {
    /// An object whose surface emits.
    Surface(SurfaceLamp),
    /// A point.
    Point {
        /// Where it is.
        position: Vec3,
    },
    /// A point that shines as a distribution about an axis says; its value along the axis (or its largest) is 1.
    Luminaire {
        /// Where it is.
        position: Vec3,
        /// Unit vector along its axis.
        axis: Vec3,
        /// How intensity depends on the angle from the axis.
        distribution: Distribution,
    },
    /// A point that shines as a photometric web says, whose largest value is 1.
    Photometric {
        /// Where it is.
        position: Vec3,
        /// Unit vectors towards C = 0 and C = 90°, and along γ = 0.
        frame: [Vec3; 3],
        /// How intensity depends on direction.
        web: Box<PhotometricWeb>,
    },
    /// A point that shines into a cone.
    Spot {
        /// Where it is.
        position: Vec3,
        /// Unit vector along its axis.
        axis: Vec3,
        /// Cosines of the angles from the axis where light begins to fade, and where it ends.
        cos_full: f32,
        /// See `cos_full`.
        cos_end: f32,
    },
    /// Parallel light that travels along this unit vector.
    Parallel {
        /// The direction of travel.
        direction: Vec3,
    },
    /// The same radiance from everywhere.
    Uniform,
    /// An image of the surroundings.
    Image(Box<EnvironmentImage>),
    /// The clear sky, without the sun.
    Sky(Box<Sky>),
    /// The disc of the sun.
    Sun(Box<Sun>),
}

impl LampForm {
    /// Whether it is seen where nothing else is.
    #[must_use]
    pub fn surrounds(&self) -> bool {
        self.is_background() || matches!(self, Self::Sun(_))
    }

    /// Whether it surrounds the scene without a place of its own, so that techniques that ask every lamp take it for ambient light.
    #[must_use]
    pub fn is_background(&self) -> bool {
        matches!(self, Self::Uniform | Self::Image(_) | Self::Sky(_))
    }
}

/// The smooth edge of a spot: 1 inside, 0 outside, a cubic between.
#[inline(always)]
fn spot_falloff(cos: f32, cos_full: f32, cos_end: f32) -> f32 {
    let t = ((cos - cos_end) / (cos_full - cos_end).max(1e-9)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The value of a photometric web in a direction away from its lamp.
fn web_value(web: &PhotometricWeb, frame: &[Vec3; 3], direction: Vec3) -> f32 {
    web.value(frame.map(|axis| f64::from(axis.dot(direction)))) as f32
}

/// What a point is told of a lamp.
#[derive(Clone, Copy, Debug)]
pub struct LampSample {
    /// Unit vector from the point to the light.
    pub direction: Vec3,
    /// Where the light leaves from; `None` for light from afar.
    pub target: Option<Vec3>,
    /// Density of the direction, 1/sr; `None` for points and parallel light, which no chance direction meets.
    pub pdf: Option<f32>,
    /// What the lamp's spectrum is multiplied by: falloff, 1/r².
    pub scale: f32,
    /// Whether the radiance depends on the direction.
    pub varies: bool,
}

impl Lamp {
    /// The intensity in a direction away from a lamp that is a point, relative to that of its spectrum.
    #[inline(always)]
    pub(crate) fn falloff(&self, direction: Vec3) -> f32 {
        match &self.form {
            LampForm::Luminaire { axis, distribution, .. } => {
                distribution.value(f64::from(direction.dot(*axis))) as f32
            }
            LampForm::Photometric { frame, web, .. } => web_value(web, frame, direction),
            LampForm::Spot { axis, cos_full, cos_end, .. } => {
                spot_falloff(direction.dot(*axis), *cos_full, *cos_end)
            }
            _ => 1.0,
        }
    }

    /// A direction from a point to the lamp, from two numbers in [0, 1); `None` when it sends no light there.
    #[inline]
    #[must_use]
    pub fn sample(&self, geometry: &Geometry, from: Vec3, time: f32, u: [f32; 2]) -> Option<LampSample> {
        let point = |position: Vec3| {
            let d = position - from;
            let r2 = d.length_squared();
            let falloff = self.falloff((from - position).normalize_or_zero());
            (r2 > 0.0 && falloff > 0.0).then(|| LampSample {
                direction: d / r2.sqrt(),
                target: Some(position),
                pdf: None,
                scale: falloff / r2,
                varies: false,
            })
        };
        let afar = |direction: Vec3, pdf: f32| {
            Some(LampSample { direction, target: None, pdf: Some(pdf), scale: 1.0, varies: true })
        };
        match &self.form {
            LampForm::Surface(surface) => surface.sample(geometry, from, time, u),
            LampForm::Point { position }
            | LampForm::Luminaire { position, .. }
            | LampForm::Photometric { position, .. }
            | LampForm::Spot { position, .. } => point(*position),
            LampForm::Parallel { direction } => Some(LampSample {
                direction: -*direction,
                target: None,
                pdf: None,
                scale: 1.0,
                varies: false,
            }),
            LampForm::Uniform => None, // met by chance alone: no direction is better than another
            LampForm::Image(image) => {
                let (uv, pdf) = image.sample(u)?;
                afar(image.direction(uv), pdf)
            }
            LampForm::Sky(sky) => sky.sample(u).and_then(|(direction, pdf)| afar(direction, pdf)),
            LampForm::Sun(sun) => {
                let (direction, pdf) = sun.sample(u);
                afar(direction, pdf)
            }
        }
    }

    /// The density, 1/sr, with which [`Self::sample`] draws the direction of a ray from a point that has met this
    /// surface lamp.
    #[inline]
    #[must_use]
    pub fn pdf_of_hit(
        &self,
        geometry: &Geometry,
        from: Vec3,
        time: f32,
        hit: &Hit,
        target: &SurfacePoint,
    ) -> f32 {
        match &self.form {
            LampForm::Surface(surface) => surface.pdf(geometry, from, time, hit, target),
            _ => 0.0,
        }
    }

    /// The density, 1/sr, with which [`Self::sample`] draws a direction in which a lamp that surrounds the scene is seen; `None` for one
    /// that is not asked.
    #[inline]
    #[must_use]
    pub fn pdf_of_direction(&self, direction: Vec3) -> Option<f32> {
        match &self.form {
            LampForm::Image(image) => Some(image.pdf(image.uv(direction))),
            LampForm::Sky(sky) => Some(sky.pdf(direction)),
            LampForm::Sun(sun) => Some(if sun.covers(direction) { sun.solid_angle().recip() } else { 0.0 }),
            _ => None,
        }
    }

    /// Whether a surface lamp emits from the side of its surface that a ray along `direction` meets.
    #[inline(always)]
    #[must_use]
    pub fn emits(&self, geometric_normal: Vec3, direction: Vec3) -> bool {
        match &self.form {
            LampForm::Surface(surface) => surface.emits_towards(geometric_normal, direction),
            _ => false,
        }
    }

    /// The radiance in a direction in which it has been met, relative to that of its spectrum.
    #[inline(always)]
    #[must_use]
    pub fn relative_radiance(&self, geometric_normal: Vec3, direction: Vec3) -> f32 {
        match &self.form {
            LampForm::Surface(surface) => surface.relative_radiance(geometric_normal.dot(direction)),
            _ => 1.0,
        }
    }

    /// The illuminance, lx, that the lamp can be expected to bring to a point that faces it, if nothing is in the way;
    /// `luminous` is the luminance (intensity, illuminance) of its spectrum. Zero only where it brings none.
    #[inline]
    #[must_use]
    pub fn expected_illuminance(&self, luminous: f32, from: Vec3) -> f32 {
        luminous
            * match &self.form {
                LampForm::Surface(surface) => surface.expected_solid_angle(from),
                LampForm::Point { position }
                | LampForm::Luminaire { position, .. }
                | LampForm::Photometric { position, .. }
                | LampForm::Spot { position, .. } => {
                    let d = from - *position;
                    self.falloff(d.normalize_or_zero()) / d.length_squared().max(1e-12)
                }
                LampForm::Parallel { .. } => 1.0,
                LampForm::Uniform => 0.0,
                LampForm::Image(image) => image.integral() as f32,
                LampForm::Sky(sky) => sky.integral() as f32,
                LampForm::Sun(sun) => sun.solid_angle(),
            }
    }

    /// Where the lamp is and into which directions it shines, for a lamp of this luminance or intensity; `None` for one without a place.
    #[must_use]
    pub fn extent(&self, geometry: &Geometry, luminous: f32) -> Option<Extent> {
        let at = |position: Vec3, axis: Vec3, facing: f32, spread: f32, factor: f32| Extent {
            low: position,
            high: position,
            axis,
            facing,
            spread,
            two_sided: false,
            strength: luminous * factor,
        };
        match &self.form {
            LampForm::Surface(surface) => Some(surface.extent(geometry, luminous)),
            LampForm::Point { position } => Some(at(*position, Vec3::Z, PI, PI, 1.0)),
            LampForm::Luminaire { position, axis, distribution } => {
                let mean = distribution.flux() as f32 / (4.0 * PI);
                Some(at(*position, *axis, PI, PI, mean))
            }
            LampForm::Photometric { position, web, .. } => {
                Some(at(*position, Vec3::Z, PI, PI, web.flux() as f32 / (4.0 * PI)))
            }
            LampForm::Spot { position, axis, cos_end, .. } => {
                Some(at(*position, *axis, 0.0, cos_end.clamp(-1.0, 1.0).acos(), 1.0))
            }
            LampForm::Parallel { .. }
            | LampForm::Uniform
            | LampForm::Image(_)
            | LampForm::Sky(_)
            | LampForm::Sun(_) => None,
        }
    }
}

/// ∫ falloff dω of a spot, sr.
#[must_use]
pub fn spot_solid_angle(cos_full: f64, cos_end: f64) -> f64 {
    std::f64::consts::TAU * ((1.0 - cos_full) + (cos_full - cos_end) / 2.0)
}
