//! A conductor: mirror, facets of its relief, and light that meets several of them.

use crate::coherence::{Closed, Closure, Coherent, Ends, metal_closure, reflection};
use crate::model::{DiscreteLobe, Incidence, Scattered};
use crate::relief::{MetalRelief, metal_relief};
use crate::{Finish, Spectral};
use glam::Vec3;
use illuminant_optics::fresnel::{conductor, interpolated as cook_interpolated};
use illuminant_optics::multiple_scattering::Sides;
use illuminant_optics::vectors::reflect;
use illuminant_sampling::Lanes;
use std::sync::Arc;

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
    /// All light at every angle.
    Perfect,
}

/// Gauss's points and weights of ∫₀¹ 2 c f(c) dc for the mean over facets (Abramowitz and Stegun, table 25.8).
const MEAN: [(f32, f32); 4] = [
    (0.139_759_86, 2.0 * 0.031_180_97),
    (0.416_409_57, 2.0 * 0.129_847_55),
    (0.723_157, 2.0 * 0.203_464_57),
    (0.942_895_8, 2.0 * 0.135_506_92),
];

impl<const N: usize> Metal<N> {
    /// The reflectance in every lane at an angle; of an index, in a medium of index `near`.
    #[inline(always)]
    pub(crate) fn reflectance(&self, cos: f32, near: &Lanes<N>) -> Lanes<N> {
        match self {
            Self::Index { n, k } => {
                Lanes::from_fn(|i| conductor(cos, n.0[i] / near.0[i], k.0[i] / near.0[i]))
            }
            Self::Colour { normal, k } => {
                let (average, at_normal) = (conductor(cos, 1.0, *k), conductor(1.0, 1.0, *k));
                normal.map(|f| cook_interpolated(f, average, at_normal))
            }
            Self::Perfect => Lanes::splat(1.0),
        }
    }

    /// The mean of the reflectance over a cosine-weighted hemisphere: that of a facet met on the way.
    #[inline]
    pub(crate) fn mean(&self, near: &Lanes<N>) -> Lanes<N> {
        MEAN.iter().fold(Lanes::default(), |sum, &(cos, weight)| sum + self.reflectance(cos, near) * weight)
    }
}

/// Where a relief is not much higher than a wavelength: the balance in lanes, and at both ends of the spectrum.
#[derive(Debug)]
struct Coherence<const N: usize> {
    /// 2πσ/λ in vacuum.
    phase: Lanes<N>,
    /// The same at both ends of the range.
    ends: [f32; 2],
    closed: Closed<N>,
    closure: Arc<Closure>,
}

/// A view of rough metal, from above after flipping.
struct Seen<'a, const N: usize> {
    relief: &'a MetalRelief,
    v: Vec3,
    coherent: Option<(&'a Coherence<N>, Coherent<N>)>,
    /// The chance of the mirror direction.
    mirror: f32,
    /// Of the others, the chances of multiple scattering and of the rest.
    several: f32,
    rest: f32,
}

/// A conductor in the lanes of one pass.
#[derive(Clone, Debug)]
pub struct Conductor<const N: usize> {
    fresnel: Metal<N>,
    /// The mean reflectance of facets in vacuum.
    mean: Lanes<N>,
    /// Reflectance at normal incidence as one number.
    brightness: f32,
    /// The half-width of its highlight, radians.
    gloss: f32,
    relief: Option<Arc<MetalRelief>>,
    coherence: Option<Arc<Coherence<N>>>,
}

impl<const N: usize> Conductor<N> {
    /// A conductor with a finish; `brightness` is its reflectance as one number.
    #[must_use]
    pub fn new(fresnel: Metal<N>, brightness: f32, finish: &Finish, spectral: &Spectral<N>) -> Self {
        let relief = (!finish.is_smooth()).then(|| metal_relief(finish));
        let coherence = relief.as_deref().zip(finish.sigma_nm).map(|(relief, sigma)| {
            let closure = metal_closure(finish, relief, sigma, spectral.ends_nm);
            let (phase, ends) = (spectral.phase(sigma), spectral.end_phases(sigma));
            let slope = relief.steepest();
            Arc::new(Coherence { phase, ends, closed: Closed::new(&closure, phase, slope), closure })
        });
        let mean = fresnel.mean(&Lanes::splat(1.0));
        Self { fresnel, mean, brightness, gloss: finish.gloss() as f32, relief, coherence }
    }

    pub(crate) fn gloss(&self) -> f32 {
        self.gloss
    }

    pub(crate) fn is_rough(&self) -> bool {
        self.relief.is_some()
    }

    #[inline(always)]
    fn ends<'a>(coherence: &'a Coherence<N>, relief: &MetalRelief) -> &'a Ends {
        coherence.closure.ends(&relief.balance, None, relief.steepest())
    }

    /// The relief as it is seen; `None` where there is none.
    #[inline(always)]
    fn seen<'a>(&'a self, at: &Incidence<'_, N>) -> Option<Seen<'a, N>> {
        let relief = self.relief.as_deref()?;
        let v = at.to_viewer * 1f32.copysign(at.to_viewer.z);
        if !(v.z > 0.0) {
            return None;
        }
        let several = relief.shares(0, v)[0];
        let (mut mirror, mut rest) = (0.0, 0.0);
        let coherent = self.coherence.as_deref().map(|coherence| {
            // The mean of both ends of the spectrum: no lane weighs more than twice.
            let kept = |p: f32| reflection(p * at.near.mean, v.z).powi(2);
            mirror = 0.5 * (kept(coherence.ends[0]) + kept(coherence.ends[1]));
            let grid = &relief.balance.grids[0];
            let ends = Self::ends(coherence, relief).closed.at(grid, 0, &Lanes::splat(at.near.mean), None, v);
            rest = (0.5 * (ends.rest.0[0] + ends.rest.0[1]) / (1.0 - mirror).max(1e-6)).min(0.9);
            (coherence, coherence.closed.at(grid, 0, at.near.lanes, None, v))
        });
        Some(Seen { relief, v, coherent, mirror, several: several * (1.0 - rest), rest })
    }

    /// The mean reflectance of the first of several facets: at two angles to either side of the mean cosine, because F is convex.
    #[inline(always)]
    fn outer(&self, at: &Incidence<'_, N>, relief: &MetalRelief, v: Vec3) -> Lanes<N> {
        // The spread of that cosine, by walks over Gaussian reliefs.
        let spread = 0.2 * relief.steepest();
        let cos = relief.first_cosine(v);
        let near = at.near.lanes;
        let [low, high] = [(cos - spread).max(0.0), (cos + spread).min(1.0)];
        (self.fresnel.reflectance(low, near) + self.fresnel.reflectance(high, near)) * 0.5
    }

    /// The bidirectional reflectance of scattered light and the density of its directions, with both vectors above the surface.
    #[inline(always)]
    fn scattered(&self, at: &Incidence<'_, N>, seen: &Seen<'_, N>, l: Vec3) -> (Lanes<N>, f32) {
        let (relief, v) = (seen.relief, seen.v);
        let h = (v + l).normalize_or_zero();
        let cos = v.dot(h).clamp(0.0, 1.0);
        let (va, la, ha) = (v.to_array(), l.to_array(), h.to_array());
        let shape =
            relief.facets.distribution(ha) * relief.facets.masking_shadowing(va, la) / (4.0 * v.z * l.z);
        let visible = if cos > 0.0 { relief.facets.pdf_visible(va, ha) / (4.0 * cos) } else { 0.0 };
        let multiple = relief.multiple(Sides::First, v, l);
        let [two, three, more] = multiple.values;
        let mean = if at.near.mean == 1.0 { self.mean } else { self.fresnel.mean(at.near.lanes) };
        // The first and the last facet are met at angles of their own, those between at any.
        let outer = self.outer(at, relief, v) * self.outer(at, relief, l);
        let several = outer * mean.map(|f| two + f * (three + f * more));
        let mut f = self.fresnel.reflectance(cos, at.near.lanes) * shape + several;
        if let Some((coherence, a)) = &seen.coherent {
            let b = coherence.closed.at(&relief.balance.grids[0], 0, at.near.lanes, None, l);
            f = f * a.factor * b.factor * (a.back * b.back).map(|kept| 1.0 - kept);
            f += coherence.closed.rest(a, &b) * mean * mean;
        }
        let rest = match &seen.coherent {
            Some((coherence, _)) if seen.rest > 0.0 => {
                seen.rest * Self::ends(coherence, relief).rest_density(0, l.z)
            }
            _ => 0.0,
        };
        let single = 1.0 - seen.several - seen.rest;
        let density = single * visible + seen.several * multiple.density + rest;
        (f, (1.0 - seen.mirror) * density)
    }

    #[inline(always)]
    pub(crate) fn eval(&self, at: &Incidence<'_, N>, to_light: Vec3) -> Lanes<N> {
        let l = to_light * 1f32.copysign(at.to_viewer.z);
        match self.seen(at) {
            Some(seen) if l.z > 0.0 => self.scattered(at, &seen, l).0,
            _ => Lanes::default(),
        }
    }

    #[inline(always)]
    pub(crate) fn pdf(&self, at: &Incidence<'_, N>, to_light: Vec3) -> f32 {
        let l = to_light * 1f32.copysign(at.to_viewer.z);
        match self.seen(at) {
            Some(seen) if l.z > 0.0 => self.scattered(at, &seen, l).1,
            _ => 0.0,
        }
    }

    #[inline(always)]
    pub(crate) fn sample(&self, at: &Incidence<'_, N>, u: [f32; 3]) -> Option<Scattered<N>> {
        let flip = 1f32.copysign(at.to_viewer.z);
        let v = at.to_viewer * flip;
        let scattered = |direction: Vec3, weight: Lanes<N>, pdf: Option<f32>| Scattered {
            direction: direction * flip,
            weight,
            brightness: self.brightness,
            pdf,
            transmitted: false,
            disperses: false,
        };
        if self.relief.is_none() {
            return Some(scattered(Vec3::new(-v.x, -v.y, v.z), self.mirror_weight(at, v.z), None));
        }
        let seen = self.seen(at)?;
        if u[2] < seen.mirror {
            let weight = self.mirror_weight(at, v.z) * seen.mirror.recip();
            return Some(scattered(Vec3::new(-v.x, -v.y, v.z), weight, None));
        }
        let choice = (u[2] - seen.mirror) / (1.0 - seen.mirror);
        let l = if choice < seen.rest {
            Self::ends(seen.coherent.as_ref()?.0, seen.relief).sample_rest(0, [u[0], u[1]])
        } else if choice < seen.rest + seen.several {
            seen.relief.sample_multiple(Sides::First, v, [u[0], u[1]])?
        } else {
            let h = seen.relief.facets.sample_visible(v.to_array(), [u[0], u[1]]);
            Vec3::from(reflect(v.to_array(), h))
        };
        if !(l.z > 0.0) {
            return None;
        }
        let (f, pdf) = self.scattered(at, &seen, l);
        (pdf > 0.0).then(|| scattered(l, f * (l.z / pdf), Some(pdf)))
    }

    /// The share of light that is reflected at all, facets met once: near what it is with several.
    pub(crate) fn reflectance(&self, at: &Incidence<'_, N>) -> Lanes<N> {
        let cos = at.to_viewer.z.abs();
        let cos = self
            .relief
            .as_deref()
            .map_or(cos, |relief| relief.first_cosine(Vec3::new(at.to_viewer.x, at.to_viewer.y, cos)));
        self.fresnel.reflectance(cos, at.near.lanes)
    }

    /// The share of light that is reflected as by a mirror.
    #[inline(always)]
    pub(crate) fn mirror_weight(&self, at: &Incidence<'_, N>, cos: f32) -> Lanes<N> {
        let fresnel = self.fresnel.reflectance(cos, at.near.lanes);
        match &self.coherence {
            None => fresnel,
            Some(coherence) => {
                let kept = (coherence.phase * *at.near.lanes).map(|p| reflection(p, cos));
                fresnel * kept * kept
            }
        }
    }

    pub(crate) fn discrete_lobes(&self, at: &Incidence<'_, N>) -> Vec<DiscreteLobe<N>> {
        if self.relief.is_some() && self.coherence.is_none() {
            return Vec::new();
        }
        let v = at.to_viewer;
        let direction = Vec3::new(-v.x, -v.y, v.z);
        let weight = self.mirror_weight(at, v.z.abs());
        // All metals reflect all light at grazing incidence, and rise to that about as Schlick (1994) has it.
        let brightness = self.brightness + (1.0 - self.brightness) * (1.0 - v.z.abs()).powi(5);
        vec![DiscreteLobe { direction, weight, brightness, transmitted: false }]
    }
}
