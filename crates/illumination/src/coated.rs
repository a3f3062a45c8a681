//! A dielectric vehicle over a pigment or metal: paint, plastic, glaze, varnish, metal flake (book 2.1, II.1.3, II.1.5).
//!
//! Of the light that comes from a direction, the outer boundary reflects E; the rest, T = 1 − E, is refracted into
//! the vehicle. Flakes, which cover a part of the area, reflect it in their facets, and what leaves through the boundary again without another
//! reflection makes their lobe, e in all if they absorb nothing. All other light, D = 1 − E − e, is scattered by the pigment until it
//! leaves or is absorbed:
//!
//! f(v, l) = f_boundary + f_flakes + D(v) D(l) / (π D̄) · C,  D̄ = 2 ∫ D cos θ d(cos θ),
//! C = R (1 − r) / (1 − R r),  r = 1 − D̄/n²
//!
//! with the reflectance R of what lies in the vehicle and that of the boundary from inside, r, for diffuse light (Saunderson 1942;
//! in this reciprocal form Kelemen and Szirmay-Kalos 2001). If nothing is absorbed R = 1, so C = 1, and all light
//! comes back. A tinted vehicle of optical depth τ takes exp(−τ/cos θ') on every way through it.

use crate::conductor::{Conductor, Metal};
use crate::dielectric::Dielectric;
use crate::model::{DiscreteLobe, Incidence, Index, Scattered};
use crate::relief::{Kept, bits};
use crate::rough_boundary::ByEta;
use crate::{Finish, Spectral};
use glam::Vec3;
use illuminant_optics::fresnel::dielectric;
use illuminant_optics::hemisphere;
use illuminant_optics::vectors::reflect;
use illuminant_sampling::Lanes;
use std::f32::consts::FRAC_1_PI;
use std::sync::{Arc, OnceLock};

/// Steps of the cosine in tables.
const STEPS: usize = 32;
/// Rows and columns over which the lobe of flakes is integrated.
const DRAWS: usize = 64;

/// An index of refraction in lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vehicle<const N: usize> {
    /// At the representative wavelength.
    pub mean: f32,
    /// In every lane.
    pub lanes: Lanes<N>,
}

impl<const N: usize> Vehicle<N> {
    #[inline(always)]
    fn index(&self) -> Index<'_, N> {
        Index { mean: self.mean, least: self.mean, lanes: &self.lanes }
    }
}

/// Metal in the vehicle or under it.
#[derive(Clone, Debug)]
pub struct MetalUnder<const N: usize> {
    /// The metal.
    pub metal: Conductor<N>,
    /// The slope of its facets.
    pub slope: f64,
    /// The part of the area that it covers.
    pub coverage: f32,
    /// Mean reflectance of its facets, in lanes and as one number.
    pub mean: Lanes<N>,
    /// As one number.
    pub brightness: f32,
}

/// What the vehicle holds.
#[derive(Clone, Debug)]
pub struct Body<const N: usize> {
    /// Reflectance of the pigment for diffuse light, in lanes.
    pub pigment: Lanes<N>,
    /// As one number.
    pub brightness: f32,
    /// Optical depth τ of the vehicle.
    pub depth: Lanes<N>,
    /// Metal, if there is any.
    pub metal: Option<MetalUnder<N>>,
}

/// A vehicle over a body, in the lanes of one pass.
#[derive(Clone, Debug)]
pub struct Coated<const N: usize> {
    layers: Arc<Layers<N>>,
    /// The pigment where an image gives it, in lanes and as one number.
    pigment: Option<(Lanes<N>, f32)>,
}

#[derive(Debug)]
struct Layers<const N: usize> {
    vehicle: Vehicle<N>,
    outer: Dielectric<N>,
    body: Body<N>,
    tables: ByEta<Tables<N>>,
}

/// What depends on the medium outside.
#[derive(Debug)]
struct Tables<const N: usize> {
    /// The lobe e of flakes that absorb nothing, at even steps of the root of the cosine.
    flakes: [Lanes<N>; STEPS + 1],
    /// The same as one number.
    chances: [f32; STEPS + 1],
    /// C / D̄ in lanes.
    colour: Lanes<N>,
    /// D̄ in lanes.
    mean: Lanes<N>,
    /// What is left of diffuse light on its way through the vehicle and back.
    kept: Lanes<N>,
    /// The largest C, as one number.
    brightness: f32,
}

/// A direction above the surface and below it.
#[derive(Clone, Copy, Debug)]
struct Way<const N: usize> {
    v: Vec3,
    /// Refracted, but still pointing up.
    inside: Vec3,
    /// E in lanes.
    reflected: Lanes<N>,
    /// What is left of light on one way through the vehicle.
    passed: Lanes<N>,
    /// e
    flakes: Lanes<N>,
}

/// The chances of where a direction is drawn from; their sum is 1.
#[derive(Clone, Copy, Debug)]
struct Chances {
    mirror: f32,
    facets: f32,
    metal: f32,
    body: f32,
    /// The share of light that comes back at most.
    brightness: f32,
}

impl<const N: usize> Tables<N> {
    /// e as one number, the same whatever lanes there are: decisions are made by it.
    #[inline(always)]
    fn representative_flakes(&self, cos: f32) -> f32 {
        let x = cos.clamp(0.0, 1.0).sqrt() * STEPS as f32;
        let i = (x as usize).min(STEPS - 1);
        let p = x - i as f32;
        (1.0 - p) * self.chances[i] + p * self.chances[i + 1]
    }
}

impl<const N: usize> Coated<N> {
    /// A vehicle with its outer boundary (towards the vehicle) over a body.
    #[must_use]
    pub fn new(vehicle: Vehicle<N>, outer: Dielectric<N>, body: Body<N>) -> Self {
        Self { layers: Arc::new(Layers { vehicle, outer, body, tables: ByEta::default() }), pigment: None }
    }

    /// The same with another pigment, whose brightness is its reflectance as one number.
    #[must_use]
    pub(crate) fn with_pigment(&self, pigment: &Lanes<N>, brightness: f32) -> Self {
        Self { layers: Arc::clone(&self.layers), pigment: Some((*pigment, brightness)) }
    }

    /// The place as the outer boundary sees it, with the viewer above.
    #[inline(always)]
    fn outside<'a>(&'a self, at: &Incidence<'a, N>, v: Vec3) -> Incidence<'a, N> {
        Incidence { to_viewer: v, near: at.near, far: self.layers.vehicle.index(), hero_lane: None }
    }

    /// The place as the metal sees it.
    #[inline(always)]
    fn under(&self, inside: Vec3) -> Incidence<'_, N> {
        let index = self.layers.vehicle.index();
        Incidence { to_viewer: inside, near: index, far: index, hero_lane: None }
    }

    /// A direction refracted, but still pointing up.
    #[inline(always)]
    fn refracted(eta: f32, v: Vec3) -> Vec3 {
        let (x, y) = (v.x / eta, v.y / eta);
        Vec3::new(x, y, (1.0 - x * x - y * y).max(1e-6).sqrt())
    }

    /// E in lanes.
    #[inline(always)]
    fn outer_reflectance(&self, at: &Incidence<'_, N>, v: Vec3) -> Lanes<N> {
        self.layers.outer.reflectance(&self.outside(at, v))
    }

    #[inline(always)]
    fn way(&self, at: &Incidence<'_, N>, tables: Option<&Tables<N>>, v: Vec3) -> Way<N> {
        let eta = self.layers.vehicle.mean / at.near.mean;
        let inside = Self::refracted(eta, v);
        let reflected = self.outer_reflectance(at, v);
        let passed = self.layers.body.depth.map(|t| (-t / inside.z).exp());
        let flakes =
            tables.filter(|_| self.layers.body.metal.is_some()).map_or_else(Lanes::default, |tables| {
                // Even steps of the root are finer near grazing.
                let x = v.z.clamp(0.0, 1.0).sqrt() * STEPS as f32;
                let i = (x as usize).min(STEPS - 1);
                let p = x - i as f32;
                tables.flakes[i] * (1.0 - p) + tables.flakes[i + 1] * p
            });
        Way { v, inside, reflected, passed, flakes }
    }

    #[inline(always)]
    fn tables(&self, at: &Incidence<'_, N>) -> &Tables<N> {
        let eta = self.layers.vehicle.mean / at.near.mean;
        self.layers.tables.get(eta, || self.find(at, eta))
    }

    #[cold]
    fn find(&self, at: &Incidence<'_, N>, eta: f32) -> Tables<N> {
        let body = &self.layers.body;
        let (mut flakes, mut chances) = ([Lanes::default(); STEPS + 1], [0.0; STEPS + 1]);
        let up = |i: usize| {
            let z = (i as f32 / STEPS as f32).powi(2).max(1e-5);
            Vec3::new((1.0 - z * z).max(0.0).sqrt(), 0.0, z)
        };
        let way = |z: f32| self.way(at, None, Vec3::new((1.0 - z * z).max(0.0).sqrt(), 0.0, z));
        if let Some(under) = &body.metal {
            let lobes = flake_lobes(under.slope, eta);
            let through: [Lanes<N>; STEPS + 1] =
                std::array::from_fn(|i| self.outer_reflectance(at, up(i)).map(|e| 1.0 - e));
            let smooth: [f32; STEPS + 1] = std::array::from_fn(|i| 1.0 - dielectric(up(i).z, eta));
            for i in 0..=STEPS {
                let (mut sum, mut chance) = (Lanes::default(), 0.0);
                for (k, share) in lobes[i].iter().enumerate() {
                    sum += through[k] * *share;
                    chance += smooth[k] * share;
                }
                flakes[i] = through[i] * sum * under.coverage;
                chances[i] = smooth[i] * chance * under.coverage;
            }
        }
        let mut tables = Tables {
            flakes,
            chances,
            colour: Lanes::splat(1.0),
            mean: Lanes::default(),
            kept: Lanes::splat(1.0),
            brightness: 1.0,
        };
        let mut mean = Lanes::default();
        let steps = 2 * STEPS;
        for i in 0..steps {
            let z = (i as f32 + 0.5) / steps as f32;
            let way = Way { flakes: self.way(at, Some(&tables), way(z).v).flakes, ..way(z) };
            mean += Self::diffuse(&way) * (2.0 * z / steps as f32);
        }
        tables.mean = mean;
        tables.kept = body.depth.map(|depth| {
            // The mean of exp(−τ/cos) over diffuse light, there and back.
            let steps = 32;
            let part = |i: usize| {
                let c = (i as f32 + 0.5) / steps as f32;
                2.0 * c * (-depth / c).exp() / steps as f32
            };
            let passed: f32 = (0..steps).map(part).sum();
            if depth > 0.0 { passed * passed } else { 1.0 }
        });
        tables.colour = self.colour_of(&tables, eta, &body.pigment);
        tables.brightness = self.brightness_of(&tables, eta, body.brightness);
        tables
    }

    /// C of a reflectance R of the pigment, of what the boundary sends back inside, and of what is kept between.
    #[inline(always)]
    fn share(r: f32, mean: f32, kept: f32, eta: f32) -> f32 {
        let inner = (1.0 - mean / (eta * eta)).clamp(0.0, 1.0);
        let rest = 1.0 - r * inner * kept;
        if rest > 0.0 { r * (1.0 - inner) / rest } else { 1.0 }
    }

    /// C / D̄ of a pigment.
    #[inline(always)]
    fn colour_of(&self, tables: &Tables<N>, eta: f32, pigment: &Lanes<N>) -> Lanes<N> {
        let metal = self.layers.body.metal.as_ref();
        let covered = metal.map_or(0.0, |m| m.coverage);
        let metal = metal.map_or_else(Lanes::default, |m| m.mean);
        Lanes::from_fn(|i| {
            let r = (1.0 - covered) * pigment.0[i] + covered * metal.0[i];
            let mean = tables.mean.0[i];
            if mean > 0.0 { Self::share(r, mean, tables.kept.0[i], eta) / mean } else { 0.0 }
        })
    }

    /// Where between black pigment and white a pigment lies, by what leaves.
    pub(crate) fn share_of_white(&self, at: &Incidence<'_, N>, pigment: &Lanes<N>) -> Lanes<N> {
        let eta = self.layers.vehicle.mean / at.near.mean;
        let tables = self.tables(at);
        let [black, own, white] =
            [Lanes::splat(0.0), *pigment, Lanes::splat(1.0)].map(|p| self.colour_of(tables, eta, &p));
        Lanes::from_fn(|i| {
            let whole = white.0[i] - black.0[i];
            if whole > 0.0 { (own.0[i] - black.0[i]) / whole } else { 0.0 }
        })
    }

    /// The largest C of a pigment, as one number.
    #[inline(always)]
    fn brightness_of(&self, tables: &Tables<N>, eta: f32, pigment: f32) -> f32 {
        let (covered, metal) =
            self.layers.body.metal.as_ref().map_or((0.0, 0.0), |m| (m.coverage, m.brightness));
        let whitest = tables.mean.0.iter().copied().fold(0.0, f32::max);
        Self::share((1.0 - covered) * pigment + covered * metal, whitest, 1.0, eta).clamp(0.0, 1.0)
    }

    /// C / D̄ in lanes.
    #[inline(always)]
    fn colour(&self, at: &Incidence<'_, N>, tables: &Tables<N>) -> Lanes<N> {
        match &self.pigment {
            None => tables.colour,
            Some((pigment, _)) => self.colour_of(tables, self.layers.vehicle.mean / at.near.mean, pigment),
        }
    }

    /// The largest C, as one number.
    #[inline(always)]
    fn brightness(&self, at: &Incidence<'_, N>, tables: &Tables<N>) -> f32 {
        match self.pigment {
            None => tables.brightness,
            Some((_, pigment)) => {
                self.brightness_of(tables, self.layers.vehicle.mean / at.near.mean, pigment)
            }
        }
    }

    /// D in lanes.
    #[inline(always)]
    fn diffuse(way: &Way<N>) -> Lanes<N> {
        (way.reflected + way.flakes).map(|e| (1.0 - e).max(0.0))
    }

    /// The bidirectional reflectance of the continuous part, both directions above.
    #[inline(always)]
    fn function(&self, at: &Incidence<'_, N>, tables: &Tables<N>, a: &Way<N>, l: Vec3) -> Lanes<N> {
        let b = self.way(at, Some(tables), l);
        let passed = a.passed * b.passed;
        let mut f = self.layers.outer.eval(&self.outside(at, a.v), l);
        f += Self::diffuse(a) * Self::diffuse(&b) * self.colour(at, tables) * passed * FRAC_1_PI;
        if let Some(under) = &self.layers.body.metal {
            let eta = self.layers.vehicle.mean / at.near.mean;
            let facets = under.metal.eval(&self.under(a.inside), b.inside);
            let through = a.reflected.map(|e| 1.0 - e) * b.reflected.map(|e| 1.0 - e);
            f += facets * through * passed * (under.coverage / (eta * eta));
        }
        f
    }

    /// The part of [`Self::eval`] that comes from the pigment.
    pub(crate) fn body(&self, at: &Incidence<'_, N>, to_light: Vec3) -> Lanes<N> {
        let flip = 1f32.copysign(at.to_viewer.z);
        let (v, l) = (at.to_viewer * flip, to_light * flip);
        if !(l.z > 0.0 && v.z > 0.0) {
            return Lanes::default();
        }
        let tables = self.tables(at);
        let (a, b) = (self.way(at, Some(tables), v), self.way(at, Some(tables), l));
        Self::diffuse(&a) * Self::diffuse(&b) * self.colour(at, tables) * a.passed * b.passed * FRAC_1_PI
    }

    /// The share of light that comes back in all.
    pub(crate) fn reflectance(&self, at: &Incidence<'_, N>) -> Lanes<N> {
        let tables = self.tables(at);
        let a = self.way(at, Some(tables), at.to_viewer * 1f32.copysign(at.to_viewer.z));
        let metal = self.layers.body.metal.as_ref().map_or_else(Lanes::default, |m| m.mean);
        let inner = a.flakes * metal + Self::diffuse(&a) * self.colour(at, tables) * tables.mean;
        a.reflected + inner * a.passed * a.passed
    }

    /// The share that comes from under the surface.
    pub(crate) fn body_reflectance(&self, at: &Incidence<'_, N>) -> Lanes<N> {
        let tables = self.tables(at);
        let a = self.way(at, Some(tables), at.to_viewer * 1f32.copysign(at.to_viewer.z));
        Self::diffuse(&a) * self.colour(at, tables) * tables.mean * a.passed * a.passed
    }

    pub(crate) fn gloss(&self) -> f32 {
        self.layers.outer.gloss()
    }

    /// Where directions are drawn from.
    #[inline(always)]
    fn chances(&self, at: &Incidence<'_, N>, tables: &Tables<N>, a: &Way<N>) -> Chances {
        let (all, mirror, several) = self.layers.outer.representative(&self.outside(at, a.v));
        let bright = self.layers.body.metal.as_ref().map_or(0.0, |m| m.brightness);
        let flakes = tables.representative_flakes(a.v.z);
        let metal = flakes * bright;
        let body = (1.0 - all - flakes).max(0.0) * self.brightness(at, tables) + several;
        let facets = (all - mirror - several).max(0.0);
        let sum = (mirror + facets + metal + body).max(1e-6);
        Chances {
            mirror: mirror / sum,
            facets: facets / sum,
            metal: metal / sum,
            body: 1.0 - (mirror + facets + metal) / sum,
            brightness: sum.min(1.0),
        }
    }

    /// The density of directions of the continuous part.
    #[inline(always)]
    fn density(&self, at: &Incidence<'_, N>, chances: &Chances, a: &Way<N>, l: Vec3) -> f32 {
        let mut pdf = chances.body * l.z * FRAC_1_PI;
        if chances.facets > 0.0 {
            pdf += chances.facets * self.layers.outer.visible_density(&self.outside(at, a.v), l);
        }
        if let Some(under) = self.layers.body.metal.as_ref().filter(|_| chances.metal > 0.0) {
            let eta = self.layers.vehicle.mean / at.near.mean;
            let inside = Self::refracted(eta, l);
            // dω' / dω = cos θ / (n² cos θ').
            pdf +=
                chances.metal * under.metal.pdf(&self.under(a.inside), inside) * l.z / (eta * eta * inside.z);
        }
        pdf
    }

    #[inline(always)]
    pub(crate) fn eval(&self, at: &Incidence<'_, N>, to_light: Vec3) -> Lanes<N> {
        let flip = 1f32.copysign(at.to_viewer.z);
        let (v, l) = (at.to_viewer * flip, to_light * flip);
        if !(l.z > 0.0 && v.z > 0.0) {
            return Lanes::default();
        }
        let tables = self.tables(at);
        self.function(at, tables, &self.way(at, Some(tables), v), l)
    }

    #[inline(always)]
    pub(crate) fn pdf(&self, at: &Incidence<'_, N>, to_light: Vec3) -> f32 {
        let flip = 1f32.copysign(at.to_viewer.z);
        let (v, l) = (at.to_viewer * flip, to_light * flip);
        if !(l.z > 0.0 && v.z > 0.0) {
            return 0.0;
        }
        let tables = self.tables(at);
        let a = self.way(at, Some(tables), v);
        self.density(at, &self.chances(at, tables, &a), &a, l)
    }

    /// What is seen in the mirror direction: of the boundary, and of metal without facets.
    #[inline(always)]
    fn mirrors(&self, at: &Incidence<'_, N>, a: &Way<N>) -> [Lanes<N>; 2] {
        let boundary = self.layers.outer.mirror(&self.outside(at, a.v));
        let metal = self.layers.body.metal.as_ref().filter(|m| !m.metal.is_rough()).map(|under| {
            let weight = under.metal.mirror_weight(&self.under(a.inside), a.inside.z);
            let through = a.reflected.map(|e| 1.0 - e);
            weight * through * through * a.passed * a.passed * under.coverage
        });
        [boundary, metal.unwrap_or_default()]
    }

    #[inline(always)]
    pub(crate) fn sample(&self, at: &Incidence<'_, N>, u: [f32; 3]) -> Option<Scattered<N>> {
        let flip = 1f32.copysign(at.to_viewer.z);
        let v = at.to_viewer * flip;
        if !(v.z > 0.0) {
            return None;
        }
        let tables = self.tables(at);
        let a = self.way(at, Some(tables), v);
        let chances = self.chances(at, tables, &a);
        let smooth_metal = self.layers.body.metal.as_ref().is_some_and(|m| !m.metal.is_rough());
        let mirror = chances.mirror + if smooth_metal { chances.metal } else { 0.0 };
        let scattered = |direction: Vec3, weight: Lanes<N>, pdf: Option<f32>| Scattered {
            direction: direction * flip,
            weight,
            brightness: chances.brightness,
            pdf,
            transmitted: false,
            disperses: false,
        };
        if u[2] < mirror {
            // Both mirrors send light the same way.
            let [boundary, metal] = self.mirrors(at, &a);
            let weight = (boundary + metal) * mirror.recip();
            return Some(scattered(Vec3::new(-v.x, -v.y, v.z), weight, None));
        }
        let choice = u[2] - mirror;
        let l = if choice < chances.facets {
            let h = self.layers.outer.sample_visible(&self.outside(at, v), [u[0], u[1]])?;
            Vec3::from(reflect(v.to_array(), h))
        } else if choice < chances.facets + chances.metal && !smooth_metal {
            let under = self.layers.body.metal.as_ref()?;
            let lobe = ((choice - chances.facets) / chances.metal).min(1.0 - f32::EPSILON);
            let drawn = under.metal.sample(&self.under(a.inside), [u[0], u[1], lobe])?;
            let l = drawn.direction * (self.layers.vehicle.mean / at.near.mean);
            let sin2 = l.x * l.x + l.y * l.y;
            if sin2 >= 1.0 {
                return None;
            }
            Vec3::new(l.x, l.y, (1.0 - sin2).sqrt())
        } else {
            Vec3::from(hemisphere::cosine([u[0], u[1]]))
        };
        if !(l.z > 0.0) {
            return None;
        }
        let pdf = self.density(at, &chances, &a, l);
        (pdf > 0.0).then(|| scattered(l, self.function(at, tables, &a, l) * (l.z / pdf), Some(pdf)))
    }

    pub(crate) fn discrete_lobes(&self, at: &Incidence<'_, N>) -> Vec<DiscreteLobe<N>> {
        let flip = 1f32.copysign(at.to_viewer.z);
        let v = at.to_viewer * flip;
        let a = self.way(at, Some(self.tables(at)), v);
        let [boundary, metal] = self.mirrors(at, &a);
        let weight = boundary + metal;
        if weight.is_zero() {
            return Vec::new();
        }
        let chances = self.chances(at, self.tables(at), &a);
        let smooth_metal = self.layers.body.metal.as_ref().is_some_and(|m| !m.metal.is_rough());
        let mirror = chances.mirror + if smooth_metal { chances.metal } else { 0.0 };
        let direction = Vec3::new(-v.x, -v.y, v.z) * flip;
        vec![DiscreteLobe { direction, weight, brightness: mirror * chances.brightness, transmitted: false }]
    }

    /// Of what is drawn in a direction with a density the part that the surface and metal make, not the body, as one number.
    pub(crate) fn share_of_surface(&self, at: &Incidence<'_, N>, to_light: Vec3, pdf: f32) -> f32 {
        let tables = self.tables(at);
        let v = at.to_viewer * 1f32.copysign(at.to_viewer.z);
        let a = self.way(at, Some(tables), v);
        let body = self.chances(at, tables, &a).body * to_light.z.abs() * FRAC_1_PI;
        (1.0 - body / pdf).clamp(0.0, 1.0)
    }
}

/// For light from each step of the cosine, the shares that facets of a slope which absorb nothing send to the steps from which it leaves
/// the vehicle, if its boundary reflected nothing.
type FlakeLobes = [[f32; STEPS + 1]; STEPS + 1];

/// The lobes for a slope and the index of the vehicle; found once.
fn flake_lobes(slope: f64, eta: f32) -> Arc<FlakeLobes> {
    static KNOWN: OnceLock<Kept<[u64; 2], FlakeLobes>> = OnceLock::new();
    KNOWN.get_or_init(Kept::default).get(bits([slope, f64::from(eta)]), || {
        let facets =
            Conductor::<4>::new(Metal::Perfect, 1.0, &Finish::rough(slope), &Spectral::monochromatic(550.0));
        let index = Vehicle { mean: eta, lanes: Lanes::splat(eta) };
        let mut lobes = [[0.0; STEPS + 1]; STEPS + 1];
        for (i, lobe) in lobes.iter_mut().enumerate() {
            let z = (i as f32 / STEPS as f32).powi(2).max(1e-5);
            let v = Vec3::new((1.0 - z * z).max(0.0).sqrt(), 0.0, z);
            let to_viewer = Coated::<4>::refracted(eta, v);
            let at = Incidence { to_viewer, near: index.index(), far: index.index(), hero_lane: None };
            for k in 0..DRAWS * DRAWS {
                // Lobes are chosen by the golden section, so that each gets its part.
                let choice = (k as f32 * 0.618_034).fract();
                let u = [k % DRAWS, k / DRAWS].map(|i| (i as f32 + 0.5) / DRAWS as f32);
                let Some(drawn) = facets.sample(&at, [u[0], u[1], choice]) else { continue };
                let l = drawn.direction * eta;
                let sin2 = l.x * l.x + l.y * l.y;
                if sin2 < 1.0 {
                    let x = (1.0 - sin2).sqrt().sqrt() * STEPS as f32;
                    let j = (x as usize).min(STEPS - 1);
                    let p = x - j as f32;
                    let share = drawn.weight.0[0] / (DRAWS * DRAWS) as f32;
                    lobe[j] += (1.0 - p) * share;
                    lobe[j + 1] += p * share;
                }
            }
        }
        lobes
    })
}
