//! The historical models in the place of any other: what techniques ask of them.

use crate::historical::{Asked, AskedPair, Coefficients, Historical, Side, Terms};
use crate::model::{
    Blurred, Claims, Components, CosineModel, DiscreteLobe, IlluminationModel, Incidence, LobeAxis, Prepare,
    Scattered,
};
use crate::{
    Blinn, Bouknight, CoefficientCurves, CookTorrance, Hall, Illumination, Material, Phong, Samples, Surface,
    Weighed, Whitted,
};
use glam::Vec3;
use illuminant_optics::Vector;
use illuminant_optics::distribution::{Distribution, ggx_alpha};
use illuminant_optics::frame::Frame;
use illuminant_optics::hemisphere;
use illuminant_optics::saunderson::internal_reflectance;
use illuminant_optics::vectors::{dot, half, half_refracted, reflect, refract, refract_either};
use illuminant_sampling::{Basis, Lanes, Role};
use illuminant_spectrum::{Curve, SpectralRange};
use std::f64::consts::{FRAC_1_PI, PI};
use std::ops::Range;

impl Illumination {
    /// Whether the model asks for radiance from the mirror direction and the refracted one.
    #[must_use]
    pub fn follows_rays(self) -> bool {
        matches!(self, Self::Whitted | Self::Hall | Self::General)
    }

    /// What a historical model makes of a light; nothing for `general`, which is no sum of such terms.
    #[inline]
    #[must_use]
    pub fn terms<S: Samples>(
        self,
        surface: &Coefficients<S>,
        side: &Side,
        v: Vector<f64>,
        l: Vector<f64>,
    ) -> Terms<S> {
        match self {
            Self::Bouknight => Bouknight.terms(surface, side, v, l),
            Self::Phong => Phong.terms(surface, side, v, l),
            Self::Blinn => Blinn.terms(surface, side, v, l),
            Self::Whitted => Whitted.terms(surface, side, v, l),
            Self::Hall => Hall.terms(surface, side, v, l),
            Self::CookTorrance => CookTorrance.terms(surface, side, v, l),
            Self::General => Terms::default(),
        }
    }

    /// The directions from which a historical model asks for radiance.
    #[inline]
    #[must_use]
    pub fn asked<S: Samples>(self, surface: &Coefficients<S>, side: &Side, v: Vector<f64>) -> AskedPair<S> {
        match self {
            Self::Whitted => Whitted.asked(surface, side, v),
            Self::Hall => Hall.asked(surface, side, v),
            Self::General => [None, None],
            // The models of incremental shading look straight through (Newell et al. 1972).
            _ => Historical::<S>::asked(&Bouknight, surface, side, v),
        }
    }

    fn historical_claims(self) -> Claims {
        match self {
            Self::Bouknight => Bouknight::CLAIMS,
            Self::Phong => Phong::CLAIMS,
            Self::Blinn => Blinn::CLAIMS,
            Self::Whitted => Whitted::CLAIMS,
            Self::Hall => Hall::CLAIMS,
            Self::CookTorrance | Self::General => CookTorrance::CLAIMS,
        }
    }
}

/// A material as one of the historical models sees it, in the lanes of one pass.
#[derive(Clone, Debug)]
pub struct Historic<const N: usize> {
    model: Illumination,
    surface: Coefficients<Weighed<N>>,
    /// The index inside.
    index: f64,
    /// Whether the surface is the border of a body into which rays are bent.
    body: bool,
    /// Whether the surface blurs what it mirrors: its material is rough, or the scene states how wide the highlight is.
    rough: bool,
    /// How directions are drawn for the highlight.
    drawn: DrawnLobe,
    /// The brightness of the diffuse term and of the highlight, for the choice between them.
    bright: [f64; 2],
    /// The half-width of the highlight about the mirror direction, radians.
    gloss: f32,
    /// What becomes of a colour that an image gives.
    coloured: Coloured<N>,
}

/// What of a pigment of reflectance `p` leaves a body, as a part of what leaves of a white one (Saunderson 1942).
#[inline]
fn leaves(p: f32, inner: f32) -> f32 {
    p * (1.0 - inner) / (1.0 - inner * p)
}

/// By which rule a colour of an image becomes a coefficient: that of [`CoefficientCurves`], in lanes.
#[derive(Clone, Copy, Debug)]
enum Coloured<const N: usize> {
    /// Not at all: there is no such colour, or the scene states the coefficient.
    Not,
    /// A diffuser: times C_Ka and C_Kd.
    Diffuser([f64; 2]),
    /// A pigment: what of it leaves the body (Saunderson 1942), by the reflectance of the boundary for diffuse light from inside;
    /// `most` is what leaves of a perfect one.
    Pigment { scales: [f64; 2], inner: f32, most: Lanes<N>, brightest: f32 },
    /// A filter: times C_Kt.
    Filter(f64),
}

impl<const N: usize> Coloured<N> {
    fn new(
        material: &Material,
        model: Illumination,
        curves: &CoefficientCurves,
        range: SpectralRange,
        reduce: impl Fn(&Curve) -> Lanes<N>,
    ) -> Self {
        let scales = [curves.ambient_scale, curves.diffuse_scale];
        let mut stated = material.overrides.iter().filter(|over| over.model.is_none_or(|m| m == model));
        match &material.surface {
            Surface::Filter { .. } if stated.all(|over| over.transmitted_curve.is_none()) => {
                Self::Filter(curves.transmitted_scale)
            }
            Surface::Diffuse { .. } | Surface::Translucent { .. }
                if stated.all(|over| over.diffuse_curve.is_none()) =>
            {
                Self::Diffuser(scales)
            }
            Surface::Coated { n, finish, film, flakes, .. }
                if stated.all(|over| over.diffuse_curve.is_none()) =>
            {
                let pigment = Curve::constant(1.0);
                let (n, film, flakes) = (n.clone(), film.clone(), flakes.clone());
                let surface = Surface::Coated { n, finish: *finish, film, pigment, flakes };
                let white = CoefficientCurves::new(&Material { surface, ..material.clone() }, model, range);
                Self::Pigment {
                    scales,
                    inner: internal_reflectance(curves.index) as f32,
                    most: reduce(&white.diffuse),
                    brightest: white.diffuse.extent(range).1 as f32,
                }
            }
            _ => Self::Not,
        }
    }
}

/// From which lobe directions are drawn for a highlight.
#[derive(Clone, Copy, Debug)]
enum DrawnLobe {
    /// (R·L)^n about the mirror direction.
    Mirror(f64),
    /// H by (N·H)^n.
    Power(f64),
    /// H by Trowbridge and Reitz, of this α².
    TrowbridgeReitz(f64),
}

impl DrawnLobe {
    fn of(distribution: Distribution, coefficient: f64) -> Self {
        let beta = distribution.half_angle(coefficient);
        match distribution {
            Distribution::Phong => Self::Mirror(coefficient.clamp(0.0, 1e6)),
            Distribution::TrowbridgeReitz => Self::TrowbridgeReitz(ggx_alpha(beta).powi(2).clamp(1e-8, 1.0)),
            _ => Self::Power(Distribution::Blinn.coefficient(beta).clamp(0.0, 1e6)),
        }
    }

    /// The vector that is drawn: the light about R, or H.
    fn draw(self, u: [f64; 2]) -> Vector<f64> {
        let cos2 = match self {
            Self::Mirror(n) | Self::Power(n) => (1.0 - u[0]).powf(2.0 / (n + 1.0)),
            Self::TrowbridgeReitz(a2) => (1.0 - u[0]) / (1.0 + (a2 - 1.0) * u[0]),
        };
        let sin = (1.0 - cos2).max(0.0).sqrt();
        let (s, c) = (2.0 * PI * u[1]).sin_cos();
        [sin * c, sin * s, cos2.sqrt()]
    }

    /// Its density, 1/sr.
    fn density(self, cos: f64) -> f64 {
        if cos <= 0.0 {
            return 0.0;
        }
        match self {
            Self::Mirror(n) | Self::Power(n) => (n + 1.0) / (2.0 * PI) * cos.powf(n),
            Self::TrowbridgeReitz(a2) => {
                let d = cos * cos * (a2 - 1.0) + 1.0;
                a2 * cos / (PI * d * d)
            }
        }
    }
}

/// A place as the formulas see it: the view, with the normal on the viewer's side unless the surface bounds a body.
struct Seen<const N: usize> {
    side: Side,
    v: Vector<f64>,
    flip: f32,
    asked: AskedPair<Weighed<N>>,
    /// The chances of diffuse light, highlight, mirror and refraction; their sum is 1, or 0 where nothing is reflected.
    chances: [f64; 4],
}

fn vector(v: Vec3) -> Vector<f64> {
    [f64::from(v.x), f64::from(v.y), f64::from(v.z)]
}

fn vec3(v: Vector<f64>) -> Vec3 {
    Vec3::from(v.map(|c| c as f32))
}

impl<const N: usize> Historic<N> {
    /// Derives the coefficients of a model for the lanes of one pass.
    #[must_use]
    pub fn new(
        material: &Material,
        model: Illumination,
        basis: &dyn Basis,
        samples: Range<usize>,
        range: SpectralRange,
    ) -> Self {
        let curves = CoefficientCurves::new(material, model, range);
        let surface = curves.reduce(|curve: &Curve| Weighed {
            lanes: Lanes::from_slice(&basis.reduce(curve, Role::Fraction)[samples.clone()]),
            brightness: curve.extent(range).1,
        });
        let highlight = surface.highlight;
        let drawn = DrawnLobe::of(highlight.distribution, highlight.coefficient);
        // A lobe of peak 1 returns about 2/(n + 1) of what comes; that of an energy model all.
        let width = match (drawn, highlight.distribution) {
            (_, Distribution::Cook) => 1.0,
            (DrawnLobe::Mirror(n), _) => 2.0 / (n + 1.0),
            (DrawnLobe::Power(n), _) => 8.0 / (n + 8.0),
            (DrawnLobe::TrowbridgeReitz(a2), _) => 4.0 * a2 / (1.0 + 3.0 * a2),
        };
        let shines = if model == Illumination::Bouknight { 0.0 } else { surface.specular_scale };
        let bright = [surface.diffuse.brightness, shines * surface.specular.brightness.max(0.05) * width];
        let body = matches!(material.surface, Surface::Dielectric { .. }) && model.follows_rays();
        let lanes = |curve: &Curve| Lanes::from_slice(&basis.reduce(curve, Role::Fraction)[samples.clone()]);
        // H at β from the normal is seen at 2β from the mirror direction.
        let gloss = 2.0 * highlight.distribution.half_angle(highlight.coefficient) as f32;
        let coloured = Coloured::new(material, model, &curves, range, lanes);
        let mut stated = material.overrides.iter().filter(|over| over.model.is_none_or(|m| m == model));
        let rough =
            material.slope() > 0.0 || stated.any(|over| over.beta.is_some() || over.coefficient.is_some());
        Self { model, surface, index: curves.index, body, rough, drawn, bright, gloss, coloured }
    }

    /// The media and the view, flipped to the side of the normal unless the surface bounds a body, and how it was flipped.
    #[inline]
    fn place(&self, at: &Incidence<'_, N>) -> (Side, Vector<f64>, f32) {
        let flip = if self.body { 1.0 } else { 1f32.copysign(at.to_viewer.z) };
        let v = vector(at.to_viewer * flip);
        let (near, far) = (f64::from(at.near.mean), f64::from(at.far.mean));
        let (outside, inside) = match (self.body, v[2] > 0.0) {
            (false, _) => (near, self.index),
            (true, true) => (near, far),
            (true, false) => (far, near),
        };
        (Side { outside, inside, outside_is_air: outside < 1.001 }, v, flip)
    }

    #[inline]
    fn seen(&self, at: &Incidence<'_, N>) -> Seen<N> {
        let (side, v, flip) = self.place(at);
        let asked = self.model.asked(&self.surface, &side, v);
        let bright = |i: usize| asked[i].as_ref().map_or(0.0, |ray| ray.weight.brightness);
        // From inside a body only what is let through is a function of two directions.
        let highlights = self.model == Illumination::Hall || v[2] > 0.0;
        let [diffuse, gloss] = self.bright;
        let weights = [
            if v[2] > 0.0 { diffuse } else { 0.0 },
            if highlights { gloss } else { 0.0 },
            bright(0),
            bright(1),
        ];
        let sum: f64 = weights.iter().sum();
        let chances = if sum > 0.0 { weights.map(|w| w / sum) } else { [0.0; 4] };
        Seen { side, v, flip, asked, chances }
    }

    /// The density with which `l` is drawn.
    #[inline]
    fn density(&self, seen: &Seen<N>, l: Vector<f64>) -> f64 {
        let [diffuse, gloss, ..] = seen.chances;
        let v = seen.v;
        if l[2] <= 0.0 {
            return 0.0;
        }
        let mut density = if v[2] > 0.0 { diffuse * l[2] * FRAC_1_PI } else { 0.0 };
        if gloss > 0.0 {
            density += gloss * self.gloss_density(&seen.side, v, l);
        }
        density
    }

    #[inline]
    fn gloss_density(&self, side: &Side, v: Vector<f64>, l: Vector<f64>) -> f64 {
        if v[2] < 0.0 {
            let Some(h) = half_refracted(l, v, side.outside, side.inside) else { return 0.0 };
            let (lh, vh) = (dot(l, h), dot(v, h));
            if lh <= 0.0 || vh >= 0.0 {
                return 0.0;
            }
            let sum = side.inside * vh + side.outside * lh;
            // dω_h / dω_l (Walter et al. 2007, eq 17).
            let jacobian = side.outside * side.outside * lh / (sum * sum);
            return self.drawn.density(h[2]) * jacobian;
        }
        if let DrawnLobe::Mirror(_) = self.drawn {
            return self.drawn.density(dot([-v[0], -v[1], v[2]], l));
        }
        match half(l, v) {
            Some(h) if dot(v, h) > 0.0 => self.drawn.density(h[2]) / (4.0 * dot(v, h)),
            _ => 0.0,
        }
    }

    /// A direction of the highlight.
    #[inline]
    fn draw_gloss(&self, seen: &Seen<N>, u: [f64; 2]) -> Option<Vector<f64>> {
        let (v, drawn) = (seen.v, self.drawn.draw(u));
        if v[2] < 0.0 {
            if dot(v, drawn) >= 0.0 {
                return None;
            }
            let eta = seen.side.outside / seen.side.inside;
            return refract(v, drawn.map(|c| -c), eta).map(|(l, _)| l);
        }
        if let DrawnLobe::Mirror(_) = self.drawn {
            // The lobe about N turned to R.
            let frame = Frame::from_normal(vec3([-v[0], -v[1], v[2]]));
            return Some(vector(frame.to_world(vec3(drawn))));
        }
        (dot(v, drawn) > 0.0).then(|| reflect(v, drawn))
    }
}

impl<const N: usize> IlluminationModel<N> for Historic<N> {
    #[inline]
    fn eval(&self, at: &Incidence<'_, N>, to_light: Vec3) -> Lanes<N> {
        let parts = self.components(at, to_light);
        parts.diffuse + parts.specular
    }

    #[inline]
    fn components(&self, at: &Incidence<'_, N>, to_light: Vec3) -> Components<N> {
        let (side, v, flip) = self.place(at);
        let l = vector(to_light * flip);
        if l[2] == 0.0 {
            return Components::default();
        }
        let terms = self.model.terms(&self.surface, &side, v, l);
        let per_cosine = FRAC_1_PI / l[2].abs();
        Components {
            diffuse: Samples::times(terms.diffuse.lanes, per_cosine),
            specular: Samples::times(terms.specular.lanes + terms.transmitted.lanes, per_cosine),
        }
    }

    #[inline]
    fn pdf(&self, at: &Incidence<'_, N>, to_light: Vec3) -> f32 {
        let seen = self.seen(at);
        self.density(&seen, vector(to_light * seen.flip)) as f32
    }

    #[inline]
    fn sample(&self, at: &Incidence<'_, N>, u: [f32; 3], _hero: Option<usize>) -> Option<Scattered<N>> {
        let seen = self.seen(at);
        let [diffuse, gloss, mirror, through] = seen.chances;
        let choice = f64::from(u[2]);
        let u = [f64::from(u[0]), f64::from(u[1])];
        if choice >= diffuse + gloss {
            let i = usize::from(choice >= diffuse + gloss + mirror);
            let ray = seen.asked[i].as_ref()?;
            let chance = [mirror, through][i];
            return (chance > 0.0).then(|| Scattered {
                direction: vec3(ray.direction) * seen.flip,
                weight: Samples::times(ray.weight.lanes, chance.recip()),
                brightness: (ray.weight.brightness / chance) as f32,
                pdf: None,
                transmitted: i == 1,
                disperses: false,
            });
        }
        let l = if choice < diffuse {
            vector(Vec3::from(hemisphere::cosine([u[0] as f32, u[1] as f32])))
        } else {
            self.draw_gloss(&seen, u)?
        };
        if !(l[2] > 0.0) {
            return None;
        }
        let pdf = self.density(&seen, l);
        if !(pdf > 0.0) {
            return None;
        }
        // The terms hold the cosine already.
        let sum = self.model.terms(&self.surface, &seen.side, seen.v, l).sum().times(FRAC_1_PI / pdf);
        Some(Scattered {
            direction: vec3(l) * seen.flip,
            weight: sum.lanes,
            brightness: sum.brightness as f32,
            pdf: Some(pdf as f32),
            transmitted: seen.v[2] < 0.0,
            disperses: false,
        })
    }

    fn discrete_lobes(&self, at: &Incidence<'_, N>) -> Vec<DiscreteLobe<N>> {
        let (side, v, flip) = self.place(at);
        let asked = self.model.asked(&self.surface, &side, v);
        let lobe = |(i, ray): (usize, Option<Asked<Weighed<N>>>)| {
            let ray = ray?;
            let direction = vec3(ray.direction) * flip;
            let Weighed { lanes: weight, brightness } = ray.weight;
            Some(DiscreteLobe { direction, weight, brightness: brightness as f32, transmitted: i == 1 })
        };
        asked.into_iter().enumerate().filter_map(lobe).collect()
    }

    fn blurred(&self, at: &Incidence<'_, N>, lobe: &DiscreteLobe<N>, u: [f32; 2]) -> Blurred {
        if !self.rough || (lobe.transmitted && !self.body) {
            return Blurred::Sharp;
        }
        let (side, v, flip) = self.place(at);
        let facets = match self.drawn {
            // The facets whose highlight is as wide.
            DrawnLobe::Mirror(n) => DrawnLobe::Power(4.0 * n),
            other => other,
        };
        let h = facets.draw(u.map(f64::from));
        if dot(v, h) * v[2] <= 0.0 {
            return Blurred::Lost;
        }
        let direction = if lobe.transmitted {
            refract_either(v, h, side.outside, side.inside)
        } else {
            Some(reflect(v, h))
        };
        match direction {
            Some(l) if (l[2] * v[2] < 0.0) == lobe.transmitted => Blurred::To(vec3(l) * flip),
            _ => Blurred::Lost,
        }
    }

    fn see_through(&self, at: &Incidence<'_, N>) -> Lanes<N> {
        let (side, v, _) = self.place(at);
        let [_, through] = self.model.asked(&self.surface, &side, v);
        through.map_or_else(Lanes::default, |ray| ray.weight.lanes)
    }

    #[inline]
    fn is_continuous(&self) -> bool {
        self.bright[0] > 0.0 || self.bright[1] > 0.0
    }

    #[inline]
    fn bounds_media(&self) -> bool {
        self.body
    }

    fn ambient(&self, _at: &Incidence<'_, N>) -> Components<N> {
        Components { diffuse: self.surface.ambient.lanes, specular: Lanes::default() }
    }

    fn gloss(&self) -> f32 {
        self.gloss
    }

    fn coloured(&self, colour: &Lanes<N>, brightness: f32) -> Self {
        let mut found = self.clone();
        let mut scatters = |scales: [f64; 2], lanes: Lanes<N>, brightness: f64| {
            let body = Weighed { lanes, brightness };
            found.surface.ambient = body.times(scales[0]);
            found.surface.diffuse = body.times(scales[1]);
            found.bright[0] = found.surface.diffuse.brightness;
        };
        match self.coloured {
            Coloured::Not => {}
            Coloured::Diffuser(scales) => scatters(scales, *colour, f64::from(brightness)),
            Coloured::Pigment { scales, inner, most, brightest } => {
                let lanes = most * colour.map(|p| leaves(p, inner));
                scatters(scales, lanes, f64::from(brightest * leaves(brightness, inner)));
            }
            Coloured::Filter(scale) => {
                let through = Weighed { lanes: *colour, brightness: f64::from(brightness) };
                found.surface.transmitted = through.times(scale);
            }
        }
        found
    }

    fn share_of_white(&self, _at: &Incidence<'_, N>, colour: &Lanes<N>) -> Lanes<N> {
        match self.coloured {
            Coloured::Pigment { inner, .. } => colour.map(|p| leaves(p, inner)),
            _ => *colour,
        }
    }

    fn cosines(&self) -> Option<CosineModel<N>> {
        let surface = &self.surface;
        let scale = match self.model {
            Illumination::Bouknight => 0.0,
            Illumination::Phong => surface.specular_scale,
            _ => return None,
        };
        let axis = match surface.highlight.distribution {
            Distribution::Phong => LobeAxis::Mirror,
            Distribution::Blinn => LobeAxis::Half,
            _ if scale == 0.0 => LobeAxis::Half,
            _ => return None,
        };
        (surface.terminator == 1.0 && !surface.transparent).then(|| CosineModel {
            ambient: surface.ambient.lanes,
            diffuse: surface.diffuse.lanes,
            specular: Samples::times(surface.specular.lanes, scale),
            exponent: surface.highlight.coefficient as f32,
            axis,
        })
    }

    fn claims(&self) -> Claims {
        self.model.historical_claims()
    }
}

impl<const N: usize> Prepare for Historic<N> {
    fn prepare(
        material: &Material,
        model: Illumination,
        _brightness: f32,
        basis: &dyn Basis,
        samples: Range<usize>,
        range: SpectralRange,
    ) -> Self {
        Self::new(material, model, basis, samples, range)
    }
}
