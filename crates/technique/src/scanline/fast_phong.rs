//! Two faster forms of Phong's shading, for models of N·L and a power of a cosine, with the eye and lamps of each polygon at infinity.
//!
//! Phong's normals N(x, y) = c + a x + b y are linear on the screen; |N| is not 1, and a pixel needs n = N/|N|.
//!
//! - **Duff** 1979 (“Smoothly shaded renderings of polyhedral objects on raster displays”, SIGGRAPH '79): for a direction L that does not change
//!   over the polygon, n·L = (N·L)/√(N·N) = (a x + b y + c)/√(d x² + e x y + f y² + g x + h y + i). Along a row the numerator grows by one
//!   addition, the denominator's square by two. It is exact for such normals.
//! - **Bishop and Weimer** 1986 (“Fast Phong shading”, SIGGRAPH '86): the Taylor polynomial of second degree of n·L about the middle of the
//!   polygon, T₅x² + T₄xy + T₃y² + T₂x + T₁y + T₀: two additions a pixel and no root. Its error falls as the cube of the polygon's size.
//!
//! The highlight's cosine is n·H, or Phong's R·L = 2 (n·V)(n·L) − V·L, of which the polynomial is the product of two, cut off at the second
//! degree. What the cosines are multiplied by are channels of the film, all passes together, so lanes cost nothing here either.

use super::Scanline;
use super::ahead::add_to_channels;
use super::edges::Span;
use super::projection::Polygon;
use crate::film::LayerPlan;
use crate::lanes::Pass;
use crate::settings::Shading;
use glam::{DVec2, DVec3, Vec2, Vec3};
use illuminant_illumination::{CosineModel, IlluminationModel, LobeAxis, Prepare};
use illuminant_sampling::Lanes;
use illuminant_scene::Scene;

/// k₀ + k₁x + k₂y + k₃x² + k₄xy + k₅y².
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Quadratic([f64; 6]);

impl Quadratic {
    /// Its value.
    fn at(&self, x: f64, y: f64) -> f64 {
        let [k0, k1, k2, k3, k4, k5] = self.0;
        k0 + (k1 + k3 * x + k4 * y) * x + (k2 + k5 * y) * y
    }

    /// Its values at x, x + 1, x + 2 … of a row.
    #[inline(always)]
    fn along(&self, x: f64, y: f64) -> Differences {
        let [_, k1, _, k3, k4, _] = self.0;
        Differences { value: self.at(x, y), first: k1 + k4 * y + k3 * (2.0 * x + 1.0), second: 2.0 * k3 }
    }

    /// The product up to the second degree.
    fn times(&self, other: &Self) -> Self {
        let (a, b) = (&self.0, &other.0);
        Self([
            a[0] * b[0],
            a[0] * b[1] + a[1] * b[0],
            a[0] * b[2] + a[2] * b[0],
            a[0] * b[3] + a[1] * b[1] + a[3] * b[0],
            a[0] * b[4] + a[1] * b[2] + a[2] * b[1] + a[4] * b[0],
            a[0] * b[5] + a[2] * b[2] + a[5] * b[0],
        ])
    }
}

/// Forward differences: a quadratic along a row, two additions from pixel to pixel.
#[derive(Clone, Copy, Debug)]
struct Differences {
    value: f64,
    first: f64,
    second: f64,
}

impl Differences {
    #[inline(always)]
    fn step(&mut self) {
        self.value += self.first;
        self.first += self.second;
    }
}

/// Normals that are linear on the screen, about the middle of a polygon: N = middle + x right + y down.
#[derive(Clone, Copy, Debug)]
struct Normals {
    middle: DVec3,
    right: DVec3,
    down: DVec3,
}

impl Normals {
    /// Those of a polygon from places (about their mean) and normals of its corners: through all of a triangle, near those of what
    /// clipping left. A polygon that is seen as a line keeps one normal.
    fn new(corners: &[(DVec2, DVec3)]) -> Self {
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        let (mut middle, mut x_n, mut y_n) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
        for (place, normal) in corners {
            xx += place.x * place.x;
            xy += place.x * place.y;
            yy += place.y * place.y;
            middle += *normal;
            x_n += *normal * place.x;
            y_n += *normal * place.y;
        }
        let determinant = xx * yy - xy * xy;
        let sound = determinant > 1e-12 * (xx + yy) * (xx + yy);
        let inverse = if sound { determinant.recip() } else { 0.0 };
        Self {
            middle: middle / corners.len() as f64,
            right: (x_n * yy - y_n * xy) * inverse,
            down: (y_n * xx - x_n * xy) * inverse,
        }
    }

    /// N·N.
    fn squared(&self) -> Quadratic {
        let Self { middle: c, right: a, down: b } = *self;
        Quadratic([c.dot(c), 2.0 * c.dot(a), 2.0 * c.dot(b), a.dot(a), 2.0 * a.dot(b), b.dot(b)])
    }

    /// N·D.
    fn along(&self, d: DVec3) -> Quadratic {
        Quadratic([self.middle.dot(d), self.right.dot(d), self.down.dot(d), 0.0, 0.0, 0.0])
    }

    /// The polynomial of second degree of N·D/|N|: with N·N = s² (1 + u), that of (N·D)/s times 1 − u/2 + 3u²/8.
    fn taylor(&self, d: DVec3) -> Quadratic {
        let square = self.squared();
        let s2 = square.0[0];
        if s2 <= 0.0 {
            return Quadratic::default();
        }
        let mut u = square.0.map(|k| k / s2);
        u[0] = 0.0;
        let u = Quadratic(u);
        let u2 = u.times(&u);
        let mut root: [f64; 6] = std::array::from_fn(|i| 0.375 * u2.0[i] - 0.5 * u.0[i]);
        root[0] = 1.0;
        let s = s2.sqrt().recip();
        Quadratic(self.along(d).times(&Quadratic(root)).0.map(|k| k * s))
    }
}

/// x^n over [0, 1] by linear interpolation in a table, as Bishop and Weimer take the power of a highlight.
///
/// It begins where x^n is 10⁻⁵, below which it is 0: so its steps are fine where the power is steep, and its error is below 5 × 10⁻⁵ for
/// every n from 1.
#[derive(Clone, Debug)]
struct PowerTable {
    inverse_step: f32,
    values: Vec<f32>,
}

impl PowerTable {
    const STEPS: usize = 1024;

    fn new(exponent: f32) -> Self {
        let exponent = f64::from(exponent);
        let least = 1e-5f64.powf(exponent.recip());
        let step = (1.0 - least) / Self::STEPS as f64;
        // One more, so that 1 has a next one.
        let values = (0..=Self::STEPS + 1).map(|i| (least + step * i as f64).min(1.0).powf(exponent) as f32);
        Self { inverse_step: step.recip() as f32, values: values.collect() }
    }

    #[inline(always)]
    fn power(&self, x: f32) -> f32 {
        // From 1 down, where the difference is exact.
        let at = Self::STEPS as f32 - (1.0 - x) * self.inverse_step;
        if at < 0.0 {
            return 0.0;
        }
        let i = (at as usize).min(Self::STEPS);
        let (low, high) = (self.values[i], self.values[i + 1]);
        low + (high - low) * (at - i as f32).min(1.0)
    }
}

/// A lamp over a polygon.
#[derive(Clone, Copy, Debug)]
struct Lobe {
    /// N·L (Duff), or the polynomial of n·L.
    light: Quadratic,
    /// N·H or N·V (Duff), or the polynomial of the highlight's cosine.
    gloss: Quadratic,
    /// V·L where the highlight is about the mirror direction.
    between: Option<f64>,
    /// Irradiance at normal incidence relative to the lamp's spectrum.
    scale: f32,
    /// Which power the highlight is.
    power: u32,
    /// Where its colours begin: what n·L is multiplied by, then the highlight.
    colors: u32,
}

/// A polygon before scanning.
#[derive(Clone, Debug)]
struct Prepared {
    /// Its middle on the screen.
    middle: [f64; 2],
    squared: Quadratic,
    /// Its lobes.
    lobes: std::ops::Range<u32>,
    /// Where the colour of what does not change over it begins.
    constant: u32,
}

/// Adds a colour times a factor to the channels of a pixel.
#[inline(always)]
fn add(pixel: &mut [f32], of_film: &[usize], color: &[f32], factor: f32) {
    if let (&[0, 1, 2], Some(xyz), Some(color)) =
        (of_film, pixel.first_chunk_mut::<3>(), color.first_chunk::<3>())
    {
        xyz.iter_mut().zip(color).for_each(|(sum, v)| *sum += v * factor);
        return;
    }
    of_film.iter().zip(color).for_each(|(&channel, v)| pixel[channel] += v * factor);
}

/// All polygons of an image, ready for one of the fast forms.
pub(super) struct FastPhong {
    shading: Shading,
    /// The channels of the film that they give.
    of_film: Vec<usize>,
    polygons: Vec<Prepared>,
    lobes: Vec<Lobe>,
    colors: Vec<f32>,
    /// The exponents of highlights, one for each material, with their tables where the form takes them from tables.
    powers: Vec<(f32, Option<PowerTable>)>,
}

/// The colours that lamps give materials, and materials ambient light, as channels.
struct Palette {
    of_film: Vec<usize>,
    /// Channels of a pixel in all.
    count: usize,
    colors: Vec<f32>,
}

impl Palette {
    /// Adds what a bundle of one pass brings to the colour that begins at `first`.
    fn add<const N: usize, M>(
        &mut self,
        plan: &[LayerPlan],
        pass: &Pass<N, M>,
        lanes: &Lanes<N>,
        (part, group): (usize, usize),
        (parts, groups): (usize, usize),
        first: usize,
    ) {
        let mut pixel = vec![0.0; N * parts * groups];
        let bundle = if parts == 1 { group } else { part * groups + group };
        pixel[bundle * N..][..N].copy_from_slice(&lanes.0);
        let mut film = vec![0.0; self.count];
        add_to_channels(plan, pass, &pixel, (parts, groups), &mut film);
        for (slot, &channel) in self.colors[first..].iter_mut().zip(&self.of_film) {
            *slot += film[channel];
        }
    }
}

impl FastPhong {
    /// Prepares all polygons.
    pub fn new<const N: usize, M: IlluminationModel<N> + Prepare>(
        all: &Scanline<N, M>,
        scene: &Scene,
        plan: &[LayerPlan],
        of_film: Vec<usize>,
        shading: Shading,
    ) -> Self {
        let (size, kinds) = ((all.parts, all.groups), of_film.len());
        let (materials, lamps) = (scene.materials.len(), scene.lamps.len());
        // For each material what it makes of ambient light; of each lamp under the surface and on it; then what objects emit.
        let ambient = |material: usize| material * kinds;
        let lit = |material: usize, lamp: usize| (materials + 2 * (material * lamps + lamp)) * kinds;
        let fixed = (materials + 2 * materials * lamps + lamps) * kinds;
        let emitted = |lamp: usize| fixed - (lamps - lamp) * kinds;
        let count = plan.last().map_or(0, |layer| layer.channels.end);
        let mut palette = Palette { of_film, count, colors: vec![0.0; fixed] };
        for shaded in &all.passes {
            let pass = &shaded.pass;
            for (material, model) in pass.materials.iter().enumerate() {
                let Some(model) = model.cosines() else { continue };
                for (group, light) in shaded.ambient.iter().enumerate() {
                    palette.add(plan, pass, &(model.ambient * *light), (0, group), size, ambient(material));
                }
                for lamp in 0..lamps {
                    let light = pass.emission[lamp] * std::f32::consts::FRAC_1_PI;
                    let (group, first) = (all.group_of[lamp], lit(material, lamp));
                    palette.add(plan, pass, &(model.diffuse * light), (1, group), size, first);
                    palette.add(plan, pass, &(model.specular * light), (2, group), size, first + kinds);
                }
            }
            for lamp in 0..lamps {
                palette.add(plan, pass, &pass.emission[lamp], (4, all.group_of[lamp]), size, emitted(lamp));
            }
        }
        let mut fast = Self {
            shading,
            of_film: palette.of_film,
            polygons: Vec::new(),
            lobes: Vec::new(),
            colors: palette.colors,
            powers: Vec::new(),
        };
        let models: Vec<Option<CosineModel<N>>> =
            all.passes[0].pass.materials.iter().map(IlluminationModel::cosines).collect();
        fast.powers.extend(models.iter().map(|model| {
            let exponent = model.as_ref().map_or(1.0, |model| model.exponent);
            let tabulated = shading == Shading::BishopWeimer && exponent >= 1.0;
            (exponent, tabulated.then(|| PowerTable::new(exponent)))
        }));
        for polygon in &all.projection.polygons {
            let object = &scene.objects[all.surfaces.faces[polygon.face as usize].object as usize];
            let first = fast.lobes.len() as u32;
            let (middle, normals, center) = all.normals_of(polygon);
            let place =
                all.place(polygon, center, normals.middle.as_vec3().normalize_or(Vec3::Z), Vec2::ZERO);
            let mut constant = ambient(object.material);
            if let Some(lamp) =
                object.lamp.filter(|&lamp| scene.lamps[lamp].emits(place.geometric, -place.to_viewer))
            {
                let relative = scene.lamps[lamp].relative_radiance(place.geometric, -place.to_viewer);
                let own = fast.colors.len();
                for i in 0..kinds {
                    fast.colors.push(fast.colors[constant + i] + fast.colors[emitted(lamp) + i] * relative);
                }
                constant = own;
            }
            if let Some(model) = &models[object.material] {
                all.lamps.arriving(scene, center, &mut |light| {
                    let (v, l) = (place.to_viewer.as_dvec3(), light.direction.as_dvec3());
                    let [cosine, gloss, between] = normals.lobe(shading, model.axis, v, l);
                    fast.lobes.push(Lobe {
                        light: cosine,
                        gloss,
                        between: (shading == Shading::Duff && model.axis == LobeAxis::Mirror)
                            .then_some(between.0[0]),
                        scale: light.scale,
                        power: object.material as u32,
                        colors: lit(object.material, light.lamp) as u32,
                    });
                });
            }
            fast.polygons.push(Prepared {
                middle,
                squared: normals.squared(),
                lobes: first..fast.lobes.len() as u32,
                constant: constant as u32,
            });
        }
        fast
    }

    /// Adds a run of pixels of a span from the sample x, y on: `channels` a pixel.
    pub fn expose(&self, span: &Span, [x, y]: [f64; 2], channels: usize, to: &mut [f32]) {
        let polygon = &self.polygons[span.polygon as usize];
        let kinds = self.of_film.len();
        let [x, y] = [x - polygon.middle[0], y - polygon.middle[1]];
        let constant = &self.colors[polygon.constant as usize..][..kinds];
        for pixel in to.chunks_exact_mut(channels) {
            add(pixel, &self.of_film, constant, 1.0);
        }
        for lobe in &self.lobes[polygon.lobes.start as usize..polygon.lobes.end as usize] {
            let (diffuse, specular) = self.colors[lobe.colors as usize..][..2 * kinds].split_at(kinds);
            let (exponent, table) = &self.powers[lobe.power as usize];
            let shines = specular.iter().any(|v| *v != 0.0);
            let mut squared = polygon.squared.along(x, y);
            let (mut light, mut gloss) = (lobe.light.along(x, y), lobe.gloss.along(x, y));
            for pixel in to.chunks_exact_mut(channels) {
                // Over a Taylor polynomial nothing is divided.
                let inverse = if self.shading == Shading::Duff { squared.value.sqrt().recip() } else { 1.0 };
                let cos = light.value * inverse;
                if cos > 0.0 {
                    let lit = lobe.scale * cos as f32;
                    add(pixel, &self.of_film, diffuse, lit);
                    let mut shine = gloss.value * inverse;
                    if let Some(between) = lobe.between {
                        shine = 2.0 * shine * cos - between;
                    }
                    if shines && shine > 0.0 {
                        let shine = shine as f32;
                        let power = match table {
                            Some(table) => table.power(shine),
                            None => shine.powf(*exponent),
                        };
                        let lit = lobe.scale * power;
                        add(pixel, &self.of_film, specular, lit);
                    }
                }
                squared.step();
                light.step();
                gloss.step();
            }
        }
    }
}

impl Normals {
    /// What is followed along rows for a lamp and a view: the light's cosine, the highlight's, and V·L.
    fn lobe(&self, shading: Shading, axis: LobeAxis, v: DVec3, l: DVec3) -> [Quadratic; 3] {
        let between = Quadratic([v.dot(l), 0.0, 0.0, 0.0, 0.0, 0.0]);
        let second = match axis {
            LobeAxis::Mirror => v,
            LobeAxis::Half => (v + l).normalize_or_zero(),
        };
        if shading == Shading::Duff {
            return [self.along(l), self.along(second), between];
        }
        let (light, mut gloss) = (self.taylor(l), self.taylor(second));
        if axis == LobeAxis::Mirror {
            gloss = Quadratic(gloss.times(&light).0.map(|k| 2.0 * k));
            gloss.0[0] -= between.0[0];
        }
        [light, gloss, between]
    }
}

impl<const N: usize, M: IlluminationModel<N> + Prepare> Scanline<N, M> {
    /// The middle of a polygon on the screen, its normals about it on the viewer's side, and its middle in the world.
    fn normals_of(&self, polygon: &Polygon) -> ([f64; 2], Normals, Vec3) {
        let corners = self.projection.corners_of(polygon);
        let count = corners.len() as f64;
        let on_screen = |i: u32| {
            let at = &self.projection.screen[i as usize];
            DVec2::new(at.x, at.y)
        };
        let middle: DVec2 = corners.iter().map(|&i| on_screen(i)).sum::<DVec2>() / count;
        let center: Vec3 = corners.iter().map(|&i| self.projection.vertices[i as usize].position).sum();
        let side = if polygon.front { 1.0 } else { -1.0 };
        let mut given = [(DVec2::ZERO, DVec3::ZERO); super::edges::MOST_CORNERS];
        for (slot, &i) in given.iter_mut().zip(corners) {
            let normal = self.projection.vertices[i as usize].normal.as_dvec3();
            *slot = (on_screen(i) - middle, normal * side);
        }
        (middle.to_array(), Normals::new(&given[..corners.len()]), center / count as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Normals of a curved triangle of a size in pixels, which turn by 0.02 a pixel.
    fn bent(size: f64) -> (Normals, [(DVec2, DVec3); 3]) {
        let corners = [[-0.6, -0.5], [0.7, -0.2], [-0.1, 0.7]].map(|[x, y]| {
            let place = DVec2::new(x, y) * size;
            (place, DVec3::new(0.02 * place.x, 0.3 - 0.015 * place.y, 1.0).normalize())
        });
        (Normals::new(&corners), corners)
    }

    const LIGHT: DVec3 = DVec3::new(0.36, 0.48, 0.8);
    const VIEW: DVec3 = DVec3::new(0.0, -0.28, 0.96);

    #[test]
    fn normals_go_through_the_corners() {
        let (normals, corners) = bent(30.0);
        for (place, normal) in corners {
            let found = normals.middle + normals.right * place.x + normals.down * place.y;
            assert!((found - normal).length() < 1e-12, "{found} {normal}");
        }
    }

    #[test]
    fn the_table_of_a_power_is_the_power() {
        for exponent in [1.0f32, 1.5, 3.0, 10.0, 56.0, 330.0, 20_000.0] {
            let table = PowerTable::new(exponent);
            for i in 0..=100_000 {
                // Evenly over the values of the power, then over those of x.
                let x = [(i as f32 * 1e-5).powf(exponent.recip()), i as f32 * 1e-5];
                for x in x {
                    let error = (table.power(x) - x.powf(exponent)).abs();
                    assert!(error < 5e-5, "{x}^{exponent}: {error}");
                }
            }
            assert_eq!(table.power(1.0), 1.0);
            assert!(table.power(1.01) <= 1.0);
        }
    }

    #[test]
    fn forward_differences_are_the_direct_evaluation() {
        // R4.24: Duff's fraction is Phong's shading to rounding, along a row of any length.
        let (normals, _) = bent(60.0);
        let [light, view, between] = normals.lobe(Shading::Duff, LobeAxis::Mirror, VIEW, LIGHT);
        for y in [-20.5, 0.25, 31.0] {
            let x0 = -40.25;
            let mut all = [light.along(x0, y), view.along(x0, y), normals.squared().along(x0, y)];
            for i in 0..80 {
                let x = x0 + f64::from(i);
                let n = (normals.middle + normals.right * x + normals.down * y).normalize();
                let root = all[2].value.sqrt();
                let (cos, seen) = (all[0].value / root, all[1].value / root);
                assert!((cos - n.dot(LIGHT)).abs() < 1e-12, "{x} {y}");
                let mirrored = n * (2.0 * n.dot(VIEW)) - VIEW;
                let gloss = 2.0 * seen * cos - between.0[0];
                assert!((gloss - mirrored.dot(LIGHT)).abs() < 1e-12, "{x} {y}");
                all.iter_mut().for_each(Differences::step);
            }
        }
    }

    #[test]
    fn the_error_of_the_polynomial_falls_as_the_cube_of_the_size() {
        // R4.25, for n·L, n·H and R·L.
        let worst = |size: f64, axis: LobeAxis| -> [f64; 2] {
            // The same normals and the same middle, over a smaller polygon.
            let (normals, corners) = bent(40.0);
            let [light, gloss, _] = normals.lobe(Shading::BishopWeimer, axis, VIEW, LIGHT);
            let mut worst = [0.0f64; 2];
            for (place, _) in corners {
                let place = place * (size / 40.0);
                let n = (normals.middle + normals.right * place.x + normals.down * place.y).normalize();
                let exact = match axis {
                    LobeAxis::Mirror => (n * (2.0 * n.dot(VIEW)) - VIEW).dot(LIGHT),
                    LobeAxis::Half => n.dot((VIEW + LIGHT).normalize()),
                };
                let errors = [light.at(place.x, place.y) - n.dot(LIGHT), gloss.at(place.x, place.y) - exact];
                worst.iter_mut().zip(errors).for_each(|(w, e)| *w = w.max(e.abs()));
            }
            worst
        };
        for axis in [LobeAxis::Mirror, LobeAxis::Half] {
            let sizes = [8.0, 4.0, 2.0].map(|size| worst(size, axis));
            for i in 0..2 {
                for pair in sizes.windows(2) {
                    let order = (pair[0][i] / pair[1][i]).log2();
                    assert!((order - 3.0).abs() < 0.25, "{axis:?} {i}: {order} {sizes:?}");
                }
            }
        }
    }
}
