//! `general`: reflection and transmission in energy equilibrium (book eq 2.49).
//!
//! Today: ideal diffuse reflection; thin filters; smooth boundaries with Fresnel's equations (coherent part); rough boundaries with
//! GGX facets, single scattering (Walter et al. 2007; Heitz 2018), whose loss at high roughness the multiple
//! scattering of the optics room will return. A material becomes lanes directly: reflectance, n and k at the
//! wavelength of each lane.

use crate::model::{Claims, DiscreteLobe, IlluminationModel, Incidence, Prepare, Scattered};
use crate::{Material, Surface};
use glam::Vec3;
use illuminant_optics::fresnel::{conductor, dielectric, interpolated};
use illuminant_optics::ggx::Ggx;
use illuminant_optics::hemisphere;
use illuminant_optics::vectors::{dot, reflect, refract};
use illuminant_sampling::{Basis, Lanes, Role};
use illuminant_spectrum::SpectralRange;
use std::f32::consts::{FRAC_1_PI, PI};
use std::ops::Range;

/// Below this slope parameter a surface is taken as smooth: f32 cannot resolve its highlight.
const SMOOTH: f64 = 1e-3;

/// The reflectance of a conductor.
#[derive(Clone, Copy, Debug)]
pub enum Metal<const N: usize> {
    /// Fresnel's, from the complex index n + ik in every lane.
    Index {
        /// Real part.
        n: Lanes<N>,
        /// Imaginary part.
        k: Lanes<N>,
    },
    /// Where lanes are no wavelengths: the colour at normal incidence, and between there and grazing Cook's interpolation
    /// by an average conductor with n = 1 (book III.19, III.20).
    Colour {
        /// At normal incidence.
        normal: Lanes<N>,
        /// The average conductor's k.
        k: f32,
    },
}

impl<const N: usize> Metal<N> {
    /// The reflectance in every lane at an angle; of an index, in a medium of index `near`.
    #[inline(always)]
    fn reflectance(&self, cos: f32, near: &Lanes<N>) -> Lanes<N> {
        match self {
            Self::Index { n, k } => {
                Lanes(std::array::from_fn(|i| conductor(cos, n.0[i] / near.0[i], k.0[i] / near.0[i])))
            }
            Self::Colour { normal, k } => {
                let (average, at_normal) = (conductor(cos, 1.0, *k), conductor(1.0, 1.0, *k));
                normal.map(|f| interpolated(f, average, at_normal))
            }
        }
    }
}

/// A material as the model `general` sees it, in the lanes of one pass.
#[derive(Clone, Copy, Debug)]
pub enum General<const N: usize> {
    /// An ideal diffuser.
    Diffuse {
        /// Reflectance over π, 1/sr.
        brdf: Lanes<N>,
        /// The reflectance as one number.
        brightness: f32,
    },
    /// A conductor.
    Conductor {
        /// Its reflectance at every angle.
        fresnel: Metal<N>,
        /// Reflectance at normal incidence as one number.
        brightness: f32,
        /// The facets; `None` for a mirror.
        facets: Option<Ggx<f32>>,
    },
    /// A thin filter: what it lets through goes straight on.
    Filter {
        /// Transmittance.
        transmittance: Lanes<N>,
        /// The same as one number.
        brightness: f32,
    },
    /// A dielectric boundary.
    Dielectric {
        /// Whether lanes part ways when refracted.
        dispersive: bool,
        /// The facets; `None` for a smooth boundary.
        facets: Option<Ggx<f32>>,
    },
}

impl<const N: usize> Prepare for General<N> {
    fn prepare(
        material: &Material,
        brightness: f32,
        basis: &dyn Basis,
        samples: Range<usize>,
        range: SpectralRange,
    ) -> Self {
        let lanes = |curve, role| Lanes::from_slice(&basis.reduce(curve, role)[samples.clone()]);
        let facets = |roughness: f64| (roughness >= SMOOTH).then_some(Ggx { alpha: roughness as f32 });
        match &material.surface {
            Surface::Diffuse { reflectance } => {
                Self::Diffuse { brdf: lanes(reflectance, Role::Fraction) * FRAC_1_PI, brightness }
            }
            Surface::Conductor { n, k, roughness } => Self::Conductor {
                fresnel: if basis.is_spectral() {
                    Metal::Index { n: lanes(n, Role::Constant), k: lanes(k, Role::Constant) }
                } else {
                    let reflectance = material.representative_reflectance(range);
                    let mean = reflectance.area(range) / range.width_nm();
                    // k = 2 √(F / (1 − F)) for n = 1 (book III.19).
                    let k = 2.0 * (mean / (1.0 - mean)).sqrt();
                    Metal::Colour { normal: lanes(&reflectance, Role::Fraction), k: k as f32 }
                },
                brightness,
                facets: facets(*roughness),
            },
            Surface::Filter { transmittance } => {
                Self::Filter { transmittance: lanes(transmittance, Role::Fraction), brightness }
            }
            Surface::Dielectric { roughness, .. } => {
                let dispersive = basis.is_spectral() && material.disperses(range);
                Self::Dielectric { dispersive, facets: facets(*roughness) }
            }
        }
    }
}

/// dω_h / dω_l of a refraction at a facet (Walter et al. 2007, eq 17); `cos_l` is negative.
#[inline(always)]
fn transmission_jacobian(cos_v: f32, cos_l: f32, eta: f32) -> f32 {
    let denominator = cos_v + eta * cos_l;
    eta * eta * -cos_l / (denominator * denominator)
}

/// Whether two media have one index, to the rounding of f32: then their boundary is none.
#[inline(always)]
fn is_matched(eta: f32) -> bool {
    (eta - 1.0).abs() < 1e-6
}

/// The boundary between two dielectrics as a path sees it that may carry one lane only.
struct Boundary<const N: usize> {
    /// n_far / n_near by which directions are bent.
    eta: f32,
    /// Reflectance by which the choice between the two sides is made, at the representative wavelength.
    choice: f32,
    /// Relative index of every lane.
    relative: Lanes<N>,
    /// Whether the transmitted direction belongs to one lane only.
    disperses: bool,
}

impl<const N: usize> Boundary<N> {
    /// `cos` is the angle at the boundary (of the surface, or of a facet).
    #[inline(always)]
    fn new(at: &Incidence<'_, N>, dispersive: bool, hero: Option<usize>, cos: f32) -> Self {
        let relative = *at.far.lanes / *at.near.lanes;
        if let Some(lane) = at.hero_lane {
            let eta = relative.0[lane];
            return Self { eta, choice: dielectric(cos, eta), relative, disperses: false };
        }
        let mean = at.far.mean / at.near.mean;
        let choice = dielectric(cos, mean);
        if !dispersive {
            return Self { eta: mean, choice, relative: Lanes::splat(mean), disperses: false };
        }
        // Near the critical angle some wavelengths pass where the representative one does not; as long as any
        // might, the choice leaves a chance.
        let passes = [at.far.least / at.near.mean, at.far.mean / at.near.least]
            .iter()
            .any(|&eta| dielectric(cos, eta) < 1.0);
        let choice = if passes { choice.min(0.9) } else { choice };
        let eta = hero.map_or(mean, |lane| relative.0[lane]);
        Self { eta, choice, relative, disperses: true }
    }

    #[inline(always)]
    fn reflectance(&self, cos: f32) -> Lanes<N> {
        self.relative.map(|eta| dielectric(cos, eta))
    }
}

impl<const N: usize> General<N> {
    #[inline(always)]
    fn same_side(at: &Incidence<'_, N>, to_light: Vec3) -> bool {
        at.to_viewer.z * to_light.z > 0.0
    }

    /// f |cos θ_l| and pdf of a rough dielectric (Walter et al. 2007, eqs 20, 21; 14 and 17 for the densities),
    /// with both vectors flipped so that the viewer is above.
    fn rough_dielectric(
        at: &Incidence<'_, N>,
        dispersive: bool,
        ggx: &Ggx<f32>,
        to_light: Vec3,
    ) -> (Lanes<N>, f32) {
        let flip = 1f32.copysign(at.to_viewer.z);
        let (v, l) = ((at.to_viewer * flip).to_array(), (to_light * flip).to_array());
        // The half vector depends on the index, so beyond the first dispersive boundary it is the hero's.
        let boundary = Boundary::new(at, dispersive, at.hero_lane, 1.0);
        if l[2] > 0.0 {
            let h = Vec3::from(v) + Vec3::from(l);
            let h = h.normalize_or_zero().to_array();
            let cos = dot(v, h);
            if h[2] <= 0.0 || cos <= 0.0 {
                return (Lanes::default(), 0.0);
            }
            let boundary = Boundary::new(at, dispersive, at.hero_lane, cos);
            let d = ggx.distribution(h);
            let shape = d * ggx.masking_shadowing(v, l) / (4.0 * v[2]);
            let pdf = boundary.choice * ggx.pdf_visible(v, h) / (4.0 * cos);
            (boundary.reflectance(cos) * shape, pdf)
        } else {
            if boundary.disperses {
                // Undispersed paths meet dispersive rough glass only by sampling: each lane has its own direction.
                return (Lanes::default(), 0.0);
            }
            let eta = boundary.eta;
            if is_matched(eta) {
                return (Lanes::default(), 0.0);
            }
            let h = -(Vec3::from(v) + Vec3::from(l) * eta);
            let h = h.normalize_or_zero();
            let h = if h.z < 0.0 { -h } else { h }.to_array();
            let (cos_v, cos_l) = (dot(v, h), dot(l, h));
            if cos_v <= 0.0 || cos_l >= 0.0 {
                return (Lanes::default(), 0.0);
            }
            let boundary = Boundary::new(at, dispersive, at.hero_lane, cos_v);
            let d = ggx.distribution(h);
            let jacobian = transmission_jacobian(cos_v, cos_l, eta);
            let g = ggx.masking_shadowing(v, l);
            // Radiance is squeezed by n²: 1/η² beside the jacobian of flux.
            let shape = d * g * cos_v * jacobian / (v[2] * eta * eta);
            let pdf = (1.0 - boundary.choice) * ggx.pdf_visible(v, h) * jacobian;
            (boundary.reflectance(cos_v).map(|r| 1.0 - r) * shape, pdf)
        }
    }

    fn sample_dielectric(
        at: &Incidence<'_, N>,
        dispersive: bool,
        facets: Option<&Ggx<f32>>,
        u: [f32; 3],
        hero: Option<usize>,
    ) -> Option<Scattered<N>> {
        let flip = 1f32.copysign(at.to_viewer.z);
        let v = (at.to_viewer * flip).to_array();
        let h = facets.map_or([0.0, 0.0, 1.0], |ggx| ggx.sample_visible(v, [u[0], u[1]]));
        let cos = dot(v, h);
        if cos <= 0.0 {
            return None;
        }
        let boundary = Boundary::new(at, dispersive, hero, cos);
        let reflects = u[2] < boundary.choice;
        let (direction, fraction, brightness, scale) = if reflects {
            (reflect(v, h), boundary.reflectance(cos), 1.0, boundary.choice)
        } else {
            if boundary.disperses && hero.is_none() {
                // The lane that would go on belongs to another pass.
                return None;
            }
            let (direction, _) = refract(v, h, boundary.eta)?;
            let passed = boundary.reflectance(cos).map(|r| 1.0 - r);
            (direction, passed * boundary.eta.powi(-2), 1.0, 1.0 - boundary.choice)
        };
        if (direction[2] > 0.0) != reflects {
            return None;
        }
        let mut weight = fraction * scale.recip();
        let mut pdf = None;
        let mut seen = 1.0;
        // Between equal indices nothing is bent: the light goes straight on, a discrete lobe that hides no facet.
        let straight = !reflects && is_matched(boundary.eta);
        if let Some(ggx) = facets.filter(|_| !straight) {
            // VNDF: what is left of D G₂ / (pdf) is G₂/G₁.
            seen = ggx.masking_shadowing(v, direction) / ggx.masking(v);
            weight *= seen;
            let density = if reflects {
                scale * ggx.pdf_visible(v, h) / (4.0 * cos)
            } else {
                scale * ggx.pdf_visible(v, h) * transmission_jacobian(cos, dot(direction, h), boundary.eta)
            };
            // A direction that belongs to one lane is known to no density that others share.
            pdf = (reflects || !boundary.disperses).then_some(density);
        }
        Some(Scattered {
            direction: Vec3::from(direction) * flip,
            weight,
            brightness: brightness * seen,
            pdf,
            transmitted: !reflects,
            disperses: boundary.disperses && !reflects,
        })
    }
}

impl<const N: usize> IlluminationModel<N> for General<N> {
    #[inline(always)]
    fn eval(&self, at: &Incidence<'_, N>, to_light: Vec3) -> Lanes<N> {
        match self {
            Self::Diffuse { brdf, .. } => {
                if Self::same_side(at, to_light) {
                    *brdf
                } else {
                    Lanes::default()
                }
            }
            Self::Conductor { fresnel, facets: Some(ggx), .. } => {
                let flip = 1f32.copysign(at.to_viewer.z);
                let (v, l) = (at.to_viewer * flip, to_light * flip);
                let h = (v + l).normalize_or_zero();
                if l.z <= 0.0 || h.z <= 0.0 {
                    return Lanes::default();
                }
                let (v, l, h) = (v.to_array(), l.to_array(), h.to_array());
                let shape = ggx.distribution(h) * ggx.masking_shadowing(v, l) / (4.0 * v[2] * l[2]);
                fresnel.reflectance(dot(v, h).clamp(0.0, 1.0), at.near.lanes) * shape
            }
            Self::Dielectric { dispersive, facets: Some(ggx) } => {
                let (f_cos, _) = Self::rough_dielectric(at, *dispersive, ggx, to_light);
                f_cos * to_light.z.abs().max(1e-9).recip()
            }
            Self::Conductor { facets: None, .. }
            | Self::Dielectric { facets: None, .. }
            | Self::Filter { .. } => Lanes::default(),
        }
    }

    #[inline(always)]
    fn pdf(&self, at: &Incidence<'_, N>, to_light: Vec3) -> f32 {
        match self {
            Self::Diffuse { .. } => {
                if Self::same_side(at, to_light) {
                    to_light.z.abs() * FRAC_1_PI
                } else {
                    0.0
                }
            }
            Self::Conductor { facets: Some(ggx), .. } => {
                let flip = 1f32.copysign(at.to_viewer.z);
                let (v, l) = (at.to_viewer * flip, to_light * flip);
                let h = (v + l).normalize_or_zero();
                if l.z <= 0.0 || h.z <= 0.0 {
                    return 0.0;
                }
                let cos = v.dot(h);
                if cos <= 0.0 { 0.0 } else { ggx.pdf_visible(v.to_array(), h.to_array()) / (4.0 * cos) }
            }
            Self::Dielectric { dispersive, facets: Some(ggx) } => {
                Self::rough_dielectric(at, *dispersive, ggx, to_light).1
            }
            Self::Conductor { facets: None, .. }
            | Self::Dielectric { facets: None, .. }
            | Self::Filter { .. } => 0.0,
        }
    }

    #[inline(always)]
    fn sample(&self, at: &Incidence<'_, N>, u: [f32; 3], hero: Option<usize>) -> Option<Scattered<N>> {
        let flip = 1f32.copysign(at.to_viewer.z);
        match self {
            Self::Diffuse { brdf, brightness } => {
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
            Self::Conductor { fresnel, brightness, facets } => {
                let v = (at.to_viewer * flip).to_array();
                let h = facets.map_or([0.0, 0.0, 1.0], |ggx| ggx.sample_visible(v, [u[0], u[1]]));
                let cos = dot(v, h).clamp(0.0, 1.0);
                let l = reflect(v, h);
                if l[2] <= 0.0 || cos <= 0.0 {
                    return None;
                }
                let seen = facets.map_or(1.0, |ggx| ggx.masking_shadowing(v, l) / ggx.masking(v));
                Some(Scattered {
                    direction: Vec3::from(l) * flip,
                    weight: fresnel.reflectance(cos, at.near.lanes) * seen,
                    brightness: *brightness * seen,
                    pdf: facets.map(|ggx| ggx.pdf_visible(v, h) / (4.0 * cos)),
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
            Self::Dielectric { dispersive, facets } => {
                Self::sample_dielectric(at, *dispersive, facets.as_ref(), u, hero)
            }
        }
    }

    fn discrete_lobes(&self, at: &Incidence<'_, N>) -> Vec<DiscreteLobe<N>> {
        let flip = 1f32.copysign(at.to_viewer.z);
        let v = (at.to_viewer * flip).to_array();
        let normal = [0.0, 0.0, 1.0];
        let mirrored = Vec3::from(reflect(v, normal)) * flip;
        match self {
            Self::Conductor { fresnel, facets: None, .. } => vec![DiscreteLobe {
                direction: mirrored,
                weight: fresnel.reflectance(v[2], at.near.lanes),
                transmitted: false,
            }],
            Self::Filter { transmittance, .. } => {
                vec![DiscreteLobe { direction: -at.to_viewer, weight: *transmittance, transmitted: true }]
            }
            Self::Dielectric { dispersive, facets: None } => {
                let boundary = Boundary::new(at, *dispersive, at.hero_lane, v[2]);
                let reflectance = boundary.reflectance(v[2]);
                let mut lobes =
                    vec![DiscreteLobe { direction: mirrored, weight: reflectance, transmitted: false }];
                if let Some((t, _)) = refract(v, normal, boundary.eta) {
                    let weight = reflectance.map(|r| 1.0 - r) * boundary.eta.powi(-2);
                    lobes.push(DiscreteLobe { direction: Vec3::from(t) * flip, weight, transmitted: true });
                }
                lobes
            }
            _ => Vec::new(),
        }
    }

    #[inline(always)]
    fn is_continuous(&self) -> bool {
        !matches!(
            self,
            Self::Conductor { facets: None, .. }
                | Self::Dielectric { facets: None, .. }
                | Self::Filter { .. }
        )
    }

    #[inline(always)]
    fn bounds_media(&self) -> bool {
        matches!(self, Self::Dielectric { .. })
    }

    fn claims(&self) -> Claims {
        let rough = matches!(
            self,
            Self::Conductor { facets: Some(_), .. } | Self::Dielectric { facets: Some(_), .. }
        );
        Claims {
            reciprocal: true,
            energy_conserving: true,
            // Light that meets a second facet is lost until the optics room returns it.
            equilibrium: !rough,
            source: "Hall 1989, eq 2.49; facets of Walter et al. 2007",
        }
    }
}
