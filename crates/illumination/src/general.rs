//! `general`: reflection and transmission in energy equilibrium (book eq 2.49).
//!
//! What reaches a surface is reflected, transmitted or absorbed, at every roughness, wavelength and angle: coherently by
//! smooth boundaries and by reliefs not much higher than a wavelength, incoherently by facets, once or several times, and
//! by what lies under a boundary. A material becomes lanes directly: reflectance, n and k at the wavelength of each
//! lane.

use crate::coated::{Body, Coated, MetalUnder, Vehicle};
use crate::conductor::{Conductor, Metal};
use crate::dielectric::Dielectric;
use crate::model::{Claims, Components, DiscreteLobe, IlluminationModel, Incidence, Prepare, Scattered};
use crate::translucent::Translucent;
use crate::{Finish, Flakes, Illumination, Material, REPRESENTATIVE_NM, Spectral, Surface};
use glam::Vec3;
use illuminant_optics::fresnel::conductor;
use illuminant_optics::hemisphere;
use illuminant_sampling::{Basis, Lanes, Role};
use illuminant_spectrum::{Curve, Outside, SpectralRange};
use std::f32::consts::{FRAC_1_PI, PI};
use std::ops::Range;

/// A material as the model `general` sees it, in the lanes of one pass.
#[derive(Clone, Debug)]
pub enum General<const N: usize> {
    /// An ideal diffuser.
    Diffuse {
        /// Reflectance over π, 1/sr.
        brdf: Lanes<N>,
        /// The reflectance as one number.
        brightness: f32,
    },
    /// A thin filter: what it lets through goes straight on.
    Filter {
        /// Transmittance.
        transmittance: Lanes<N>,
        /// The same as one number.
        brightness: f32,
    },
    /// A sheet that scatters light on both sides.
    Translucent(Translucent<N>),
    /// A conductor.
    Conductor(Conductor<N>),
    /// A dielectric boundary.
    Dielectric(Dielectric<N>),
    /// A vehicle over a pigment or metal.
    Coated(Coated<N>),
}

/// The samples of a basis that are the lanes of a pass.
struct Pass<'a> {
    basis: &'a dyn Basis,
    samples: Range<usize>,
    range: SpectralRange,
}

impl Pass<'_> {
    fn lanes<const N: usize>(&self, curve: &Curve, role: Role) -> Lanes<N> {
        Lanes::from_slice(&self.basis.reduce(curve, role)[self.samples.clone()])
    }

    fn metal<const N: usize>(&self, n: &Curve, k: &Curve) -> Metal<N> {
        if self.basis.is_spectral() {
            let (mut n, k) = (self.lanes(n, Role::Constant), self.lanes(k, Role::Constant));
            // A padded lane is never looked at, but must not be no number.
            n.0[self.samples.len()..].fill(1.0);
            return Metal::Index { n, k };
        }
        let values = self.range.wavelengths().map(|w| conductor(1.0, n.at(w), k.at(w))).collect();
        let reflectance = Curve::tabulated(self.range, values, Outside::Hold);
        let mean = reflectance.area(self.range) / self.range.width_nm();
        // k = 2 √(F / (1 − F)) for n = 1 (book III.19).
        let k = 2.0 * (mean / (1.0 - mean)).sqrt();
        Metal::Colour { normal: self.lanes(&reflectance, Role::Fraction), k: k as f32 }
    }

    fn metal_under<const N: usize>(&self, flakes: &Flakes, spectral: &Spectral<N>) -> MetalUnder<N> {
        let finish = Finish::rough(flakes.slope);
        let metal = self.metal(&flakes.n, &flakes.k);
        let largest = |w: f64| conductor(1.0, flakes.n.at(w), flakes.k.at(w));
        let brightness = self.range.wavelengths().map(largest).fold(0.0, f64::max) as f32;
        MetalUnder {
            mean: metal.mean(&Lanes::splat(1.0)),
            metal: Conductor::new(metal, brightness, &finish, spectral),
            slope: flakes.slope,
            coverage: flakes.coverage as f32,
            brightness,
        }
    }
}

impl<const N: usize> Prepare for General<N> {
    fn prepare(
        material: &Material,
        _model: Illumination,
        brightness: f32,
        basis: &dyn Basis,
        samples: Range<usize>,
        range: SpectralRange,
    ) -> Self {
        let spectral = Spectral::new(basis, samples.clone(), range);
        let pass = Pass { basis, samples, range };
        match &material.surface {
            Surface::Diffuse { reflectance } => {
                Self::Diffuse { brdf: pass.lanes(reflectance, Role::Fraction) * FRAC_1_PI, brightness }
            }
            Surface::Filter { transmittance } => {
                Self::Filter { transmittance: pass.lanes(transmittance, Role::Fraction), brightness }
            }
            Surface::Translucent { reflectance, transmittance } => {
                let curves = [reflectance, transmittance];
                Self::Translucent(Translucent::new(
                    curves.map(|curve| pass.lanes(curve, Role::Fraction)),
                    curves.map(|curve| curve.extent(range).1 as f32),
                ))
            }
            Surface::Conductor { n, k, finish } => {
                Self::Conductor(Conductor::new(pass.metal(n, k), brightness, finish, &spectral))
            }
            Surface::Dielectric { finish, .. } => {
                let dispersive = basis.is_spectral() && material.disperses(range);
                Self::Dielectric(Dielectric::new(dispersive, finish, &spectral))
            }
            Surface::Coated { n, finish, film, pigment, flakes } => {
                let mean = n.at(REPRESENTATIVE_NM) as f32;
                let mut lanes =
                    if basis.is_spectral() { pass.lanes(n, Role::Constant) } else { Lanes::splat(mean) };
                lanes.0[pass.samples.len()..].fill(mean);
                let depth = film.as_ref().map_or_else(Lanes::default, |film| {
                    pass.lanes::<N>(&film.absorption, Role::Constant) * film.thickness as f32
                });
                let body = Body {
                    pigment: pass.lanes(pigment, Role::Fraction),
                    brightness: pigment.extent(range).1 as f32,
                    depth,
                    metal: flakes.as_ref().map(|flakes| pass.metal_under(flakes, &spectral)),
                };
                let outer = Dielectric::new(false, finish, &spectral);
                Self::Coated(Coated::new(Vehicle { mean, lanes }, outer, body))
            }
        }
    }
}

impl<const N: usize> IlluminationModel<N> for General<N> {
    #[inline(always)]
    fn eval(&self, at: &Incidence<'_, N>, to_light: Vec3) -> Lanes<N> {
        match self {
            Self::Diffuse { brdf, .. } => {
                if at.to_viewer.z * to_light.z > 0.0 {
                    *brdf
                } else {
                    Lanes::default()
                }
            }
            Self::Filter { .. } => Lanes::default(),
            Self::Translucent(sheet) => sheet.eval(at, to_light),
            Self::Conductor(conductor) => conductor.eval(at, to_light),
            Self::Dielectric(dielectric) => dielectric.eval(at, to_light),
            Self::Coated(coated) => coated.eval(at, to_light),
        }
    }

    fn components(&self, at: &Incidence<'_, N>, to_light: Vec3) -> Components<N> {
        let all = self.eval(at, to_light);
        match self {
            Self::Diffuse { .. } | Self::Translucent(_) => {
                Components { diffuse: all, specular: Lanes::default() }
            }
            Self::Coated(coated) => {
                let diffuse = coated.body(at, to_light);
                // The rest may round to less than nothing.
                Components { diffuse, specular: (all - diffuse).map(|f| f.max(0.0)) }
            }
            _ => Components { diffuse: Lanes::default(), specular: all },
        }
    }

    #[inline(always)]
    fn pdf(&self, at: &Incidence<'_, N>, to_light: Vec3) -> f32 {
        match self {
            Self::Diffuse { .. } => {
                if at.to_viewer.z * to_light.z > 0.0 {
                    to_light.z.abs() * FRAC_1_PI
                } else {
                    0.0
                }
            }
            Self::Filter { .. } => 0.0,
            Self::Translucent(sheet) => sheet.pdf(at, to_light),
            Self::Conductor(conductor) => conductor.pdf(at, to_light),
            Self::Dielectric(dielectric) => dielectric.pdf(at, to_light),
            Self::Coated(coated) => coated.pdf(at, to_light),
        }
    }

    #[inline(always)]
    fn sample(&self, at: &Incidence<'_, N>, u: [f32; 3], hero: Option<usize>) -> Option<Scattered<N>> {
        match self {
            Self::Diffuse { brdf, brightness } => {
                let flip = 1f32.copysign(at.to_viewer.z);
                let direction = Vec3::from(hemisphere::cosine([u[0], u[1]])) * flip;
                Some(Scattered {
                    direction,
                    weight: *brdf * PI,
                    brightness: *brightness,
                    pdf: Some(direction.z.abs() * FRAC_1_PI),
                    transmitted: false,
                    disperses: false,
                })
            }
            Self::Filter { transmittance, brightness } => Some(Scattered {
                direction: -at.to_viewer,
                weight: *transmittance,
                brightness: *brightness,
                pdf: None,
                transmitted: true,
                disperses: false,
            }),
            Self::Translucent(sheet) => Some(sheet.sample(at, u)),
            Self::Conductor(conductor) => conductor.sample(at, u),
            Self::Dielectric(dielectric) => dielectric.sample(at, u, hero),
            Self::Coated(coated) => coated.sample(at, u),
        }
    }

    fn discrete_lobes(&self, at: &Incidence<'_, N>) -> Vec<DiscreteLobe<N>> {
        match self {
            Self::Diffuse { .. } | Self::Translucent(_) => Vec::new(),
            Self::Filter { transmittance, brightness } => {
                let (weight, brightness) = (*transmittance, *brightness);
                vec![DiscreteLobe { direction: -at.to_viewer, weight, brightness, transmitted: true }]
            }
            Self::Conductor(conductor) => conductor.discrete_lobes(at),
            Self::Dielectric(dielectric) => dielectric.discrete_lobes(at),
            Self::Coated(coated) => coated.discrete_lobes(at),
        }
    }

    #[inline(always)]
    fn is_continuous(&self) -> bool {
        match self {
            Self::Diffuse { .. } | Self::Translucent(_) | Self::Coated(_) => true,
            Self::Filter { .. } => false,
            Self::Conductor(conductor) => conductor.is_rough(),
            Self::Dielectric(dielectric) => dielectric.is_rough(),
        }
    }

    #[inline(always)]
    fn bounds_media(&self) -> bool {
        matches!(self, Self::Dielectric(_))
    }

    fn ambient(&self, at: &Incidence<'_, N>) -> Components<N> {
        let mirrored = || {
            let lobes = self.discrete_lobes(at).into_iter().filter(|lobe| !lobe.transmitted);
            lobes.fold(Lanes::default(), |sum, lobe| sum + lobe.weight)
        };
        let diffuse_alone = |diffuse| Components { diffuse, specular: Lanes::default() };
        let (all, diffuse) = match self {
            Self::Diffuse { brdf, .. } => return diffuse_alone(*brdf * PI),
            Self::Filter { .. } => return Components::default(),
            Self::Translucent(sheet) => return diffuse_alone(sheet.albedo()),
            Self::Conductor(conductor) => (conductor.reflectance(at), Lanes::default()),
            Self::Dielectric(dielectric) => (dielectric.reflectance(at), Lanes::default()),
            Self::Coated(coated) => (coated.reflectance(at), coated.body_reflectance(at)),
        };
        let specular = (all + (diffuse + mirrored()) * -1.0).map(|rest| rest.max(0.0));
        Components { diffuse, specular }
    }

    fn follows_gloss(&self) -> bool {
        match self {
            Self::Diffuse { .. } | Self::Filter { .. } | Self::Translucent(_) => false,
            Self::Conductor(conductor) => conductor.is_rough(),
            Self::Dielectric(dielectric) => dielectric.is_rough(),
            Self::Coated(_) => true,
        }
    }

    fn gloss_ray(&self, at: &Incidence<'_, N>, u: [f32; 3]) -> Option<Scattered<N>> {
        // Drawn for all that is scattered, and weighed for what the surface itself does.
        let drawn = self.sample(at, u, None)?;
        // What is discrete is followed by itself.
        let pdf = drawn.pdf?;
        let found = self.components(at, drawn.direction);
        let weight = found.specular * (drawn.direction.z.abs() / pdf);
        let brightness = match self {
            Self::Coated(coated) => drawn.brightness * coated.share_of_surface(at, drawn.direction, pdf),
            _ => drawn.brightness,
        };
        (!weight.is_zero()).then_some(Scattered { weight, brightness, ..drawn })
    }

    fn gloss(&self) -> f32 {
        match self {
            Self::Conductor(conductor) => conductor.gloss(),
            Self::Dielectric(dielectric) => dielectric.gloss(),
            Self::Coated(coated) => coated.gloss(),
            Self::Diffuse { .. } | Self::Filter { .. } | Self::Translucent(_) => 0.0,
        }
    }

    fn see_through(&self, at: &Incidence<'_, N>) -> Lanes<N> {
        match self {
            Self::Filter { transmittance, .. } => *transmittance,
            Self::Dielectric(dielectric) => dielectric.reflectance(at).map(|r| 1.0 - r),
            _ => Lanes::default(),
        }
    }

    #[inline]
    fn coloured(&self, colour: &Lanes<N>, brightness: f32) -> Self {
        match self {
            Self::Diffuse { .. } => Self::Diffuse { brdf: *colour * FRAC_1_PI, brightness },
            Self::Filter { .. } => Self::Filter { transmittance: *colour, brightness },
            Self::Translucent(sheet) => Self::Translucent(sheet.with_reflectance(colour, brightness)),
            Self::Coated(coated) => Self::Coated(coated.with_pigment(colour, brightness)),
            Self::Conductor(_) | Self::Dielectric(_) => self.clone(),
        }
    }

    fn share_of_white(&self, at: &Incidence<'_, N>, colour: &Lanes<N>) -> Lanes<N> {
        match self {
            Self::Translucent(sheet) => sheet.share_of_white(colour),
            Self::Coated(coated) => coated.share_of_white(at, colour),
            _ => *colour,
        }
    }

    fn claims(&self) -> Claims {
        Claims {
            reciprocal: true,
            energy_conserving: true,
            equilibrium: true,
            source: "Hall 1989, eq 2.49; Heitz et al. 2016",
        }
    }
}
