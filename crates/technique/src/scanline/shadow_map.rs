//! Shadow maps (Williams 1978, “Casting curved shadows on curved surfaces”).
//!
//! Polygons are scanned as each lamp sees them, and the depth of the nearest is kept: one image along parallel light or inside a spot's cone, the
//! six faces of a cube around a point. A place is in shadow where something is nearer to the lamp on the same line. Edges are those of
//! four comparisons, weighted bilinearly (percentage-closer filtering; Reeves, Salesin and Cook 1987).
//!
//! A texel holds the depth at its centre, so a tilted surface would shade itself. A place is therefore moved along its normal by the farthest
//! that one of the four centres can be from it, √2 texels: from there no plane hides itself, however it is tilted. What is thinner
//! than that casts no shadow where it touches.

use super::edges::{Corner, EdgeTable};
use super::lighting::Place;
use super::surfaces::Surfaces;
use crate::direct_light::{Arriving, ON_LAMP, places_on};
use glam::{DMat4, DVec3, DVec4, Vec3};
use illuminant_scene::{Camera, LampForm, Scene};
use rayon::prelude::*;

/// Nothing nearer to a lamp than this part of the distance to the farthest corner casts a shadow.
const NEAR: f64 = 1e-5;

/// How far a place is moved along its normal, in texels: √2, and what those of the coarsest map of a wide spot grow on the way.
const OFFSET: f32 = 1.55;

/// A spot wider than this half-angle takes a cube, in degrees.
const WIDEST: f64 = 60.0;

/// One image of what a lamp sees.
struct View {
    /// From the world to X, Y, Z and W: texels X/W and Y/W from the upper left, and nearness Z/W, which is linear on the image.
    matrix: DMat4,
    /// Width of a texel at W = 1.
    texel: f32,
    size: usize,
    /// The largest nearness at the centre of each texel, 0 where nothing is; empty where nothing is anywhere.
    nearest: Vec<f32>,
}

/// What is seen from a place on a lamp.
struct ShadowMap {
    /// Where it is, unless its light is parallel.
    position: Option<Vec3>,
    /// One view, or the six sides of a cube: +x, −x, +y, −y, +z, −z.
    views: Vec<View>,
}

/// The shadow maps of a scene.
pub(crate) struct ShadowMaps {
    /// For each lamp those of its places.
    of_lamps: Vec<Vec<ShadowMap>>,
}

impl View {
    /// A square image by perspective.
    fn perspective(eye: DVec3, axis: DVec3, half_angle_deg: f64, size: u32) -> Option<Self> {
        let up = if axis.y.abs() > 0.9 { DVec3::X } else { DVec3::Y };
        let camera =
            Camera::new(eye, eye + axis, up, 2.0 * half_angle_deg, [size; 2], None, [0.0; 2]).ok()?;
        // Z = 1, so that nearness is 1/W.
        let mut rows = camera.matrix().transpose();
        rows.z_axis = DVec4::W;
        let texel = camera.pixel_angle();
        Some(Self { matrix: rows.transpose(), texel, size: size as usize, nearest: Vec::new() })
    }

    /// A square image of all surfaces along parallel light.
    fn parallel(direction: DVec3, surfaces: &Surfaces, size: u32) -> Self {
        let (right, down) = direction.any_orthonormal_pair();
        let axes = [right, down, direction];
        let (mut low, mut high) = ([f64::MAX; 3], [f64::MIN; 3]);
        for vertex in &surfaces.vertices {
            for (i, axis) in axes.iter().enumerate() {
                let at = axis.dot(vertex.position.as_dvec3());
                (low[i], high[i]) = (low[i].min(at), high[i].max(at));
            }
        }
        let width = (high[0] - low[0]).max(high[1] - low[1]).max(f64::MIN_POSITIVE);
        // A border, so that what lies on the edge of all is not beyond it.
        let scale = (f64::from(size) - 4.0) / width;
        let depth = (high[2] - low[2]).max(width);
        let row = |axis: DVec3, scale: f64, shift: f64| (axis * scale).extend(shift);
        let rows = DMat4::from_cols(
            row(axes[0], scale, 2.0 - low[0] * scale),
            row(axes[1], scale, 2.0 - low[1] * scale),
            // From 1 at the far end to 2 or less at the near one, so that rounding is relative to the depth of the scene.
            row(axes[2], -depth.recip(), 1.0 + high[2] / depth),
            DVec4::W,
        );
        let texel = scale.recip() as f32;
        Self { matrix: rows.transpose(), texel, size: size as usize, nearest: Vec::new() }
    }

    /// Scans all surfaces but those of an object.
    fn scan(&mut self, surfaces: &Surfaces, without: Option<u32>) {
        let seen: Vec<DVec4> =
            surfaces.vertices.iter().map(|v| self.matrix * v.position.as_dvec3().extend(1.0)).collect();
        let near = NEAR * seen.iter().fold(0.0f64, |m, p| m.max(p.w));
        let size = self.size as f64;
        let mut polygons: Vec<([[f64; 3]; 4], usize)> = Vec::new();
        for face in surfaces.faces.iter().filter(|face| Some(face.object) != without) {
            let (corners, count) = before(face.corners.map(|i| seen[i as usize]), near);
            let within = |axis: usize| {
                let all = || corners[..count].iter().map(|c| c[axis]);
                all().any(|v| v >= 0.0) && all().any(|v| v <= size)
            };
            if count >= 3 && within(0) && within(1) {
                polygons.push((corners, count));
            }
        }
        if polygons.is_empty() {
            return;
        }
        self.nearest = vec![0.0; self.size * self.size];
        let mut entering = vec![Vec::new(); self.size];
        for (number, (corners, count)) in polygons.iter().enumerate() {
            let top = corners[..*count].iter().map(|c| c[1]).fold(f64::MAX, f64::min);
            if let Some(row) = entering.get_mut(EdgeTable::first_row(top, 0.5).max(0) as usize) {
                row.push(number);
            }
        }
        let mut table = EdgeTable::new(1);
        for (y, row) in self.nearest.chunks_exact_mut(self.size).enumerate() {
            for &number in &entering[y] {
                let (corners, count) = &polygons[number];
                let values = corners.map(|c| [[c[2] as f32, 0.0, 0.0, 0.0]]);
                let corners = corners[..*count].iter().zip(&values);
                let corners = corners.map(|(c, values)| Corner { x: c[0], y: c[1], values });
                table.enter(number as u32, y as i32, corners, [0.5; 2]);
            }
            table.scan(y as i32, [0, self.size as i32]);
            for (number, span) in table.spans.iter().enumerate() {
                let (start, growth) = table.of_span(number);
                let (mut q, dq) = (start[0][0], growth[0][0]);
                for nearest in &mut row[span.start as usize..span.end as usize] {
                    *nearest = nearest.max(q);
                    q += dq;
                }
            }
        }
    }

    /// The part of a place that is seen: four comparisons.
    fn visible(&self, position: Vec3, normal: Vec3) -> f32 {
        if self.nearest.is_empty() {
            return 1.0;
        }
        let w = self.matrix.row(3).dot(position.as_dvec3().extend(1.0)) as f32;
        let moved = position + normal * (OFFSET * self.texel * w);
        let p = self.matrix * moved.as_dvec3().extend(1.0);
        let [x, y, q] = [p.x / p.w - 0.5, p.y / p.w - 0.5, p.z / p.w * (1.0 + 1e-6)].map(|v| v as f32);
        let most = self.size as f32 - 1.0;
        if !(p.w > 0.0 && x > -1.0 && y > -1.0 && x < most + 1.0 && y < most + 1.0) {
            return 1.0;
        }
        let (left, top) = (x.floor(), y.floor());
        let lit = |column: f32, row: f32| {
            let at = row.clamp(0.0, most) as usize * self.size + column.clamp(0.0, most) as usize;
            f32::from(u8::from(q >= self.nearest[at]))
        };
        let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
        let [upper, lower] = [top, top + 1.0].map(|row| mix(lit(left, row), lit(left + 1.0, row), x - left));
        mix(upper, lower, y - top)
    }
}

/// The part of a triangle before the near plane: x, y and nearness of its corners, and how many they are.
fn before(corners: [DVec4; 3], near: f64) -> ([[f64; 3]; 4], usize) {
    let (mut found, mut count) = ([[0.0; 3]; 4], 0);
    let mut put = |p: DVec4| {
        found[count] = [p.x / p.w, p.y / p.w, p.z / p.w];
        count += 1;
    };
    for k in 0..3 {
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        if a.w > near {
            put(a);
        }
        if (a.w > near) != (b.w > near) {
            put(a.lerp(b, (near - a.w) / (b.w - a.w)));
        }
    }
    (found, count)
}

impl ShadowMap {
    /// The views of a place on a lamp; nothing is scanned yet.
    fn new(form: &LampForm, scene: &Scene, surfaces: &Surfaces, u: [f32; 2], size: u32) -> Self {
        let position = match form {
            LampForm::Parallel { direction } => {
                let view = View::parallel(direction.as_dvec3(), surfaces, size);
                return Self { position: None, views: vec![view] };
            }
            LampForm::Sun(sun) => {
                let view = View::parallel(-sun.direction().as_dvec3(), surfaces, size);
                return Self { position: None, views: vec![view] };
            }
            LampForm::Surface(lamp) => lamp.place(&scene.geometry, u),
            LampForm::Point { position }
            | LampForm::Luminaire { position, .. }
            | LampForm::Photometric { position, .. }
            | LampForm::Spot { position, .. } => *position,
            LampForm::Uniform | LampForm::Image(_) | LampForm::Sky(_) => {
                return Self { position: None, views: Vec::new() };
            }
        };
        let eye = position.as_dvec3();
        let views: Vec<View> = match form {
            LampForm::Spot { axis, cos_end, .. } if f64::from(*cos_end) > WIDEST.to_radians().cos() => {
                // A degree more than its cone.
                let half = f64::from(*cos_end).acos().to_degrees() + 1.0;
                View::perspective(eye, axis.as_dvec3(), half, size).into_iter().collect()
            }
            _ => {
                let axes = [DVec3::X, DVec3::Y, DVec3::Z];
                let axes = axes.iter().flat_map(|axis| [*axis, -*axis]);
                axes.filter_map(|axis| View::perspective(eye, axis, 45.0, size)).collect()
            }
        };
        Self { position: Some(position), views }
    }

    /// The view in which a place appears.
    fn view(&self, place: Vec3) -> Option<&View> {
        match self.position {
            Some(position) if self.views.len() == 6 => {
                let away = place - position;
                let axis = away.abs().max_position();
                self.views.get(2 * axis + usize::from(away[axis] < 0.0))
            }
            _ => self.views.first(),
        }
    }
}

impl ShadowMaps {
    /// Scans a scene from all lamps.
    pub fn new(scene: &Scene, surfaces: &Surfaces, size: u32) -> Self {
        let of_lamp = |lamp: &illuminant_scene::Lamp| -> Vec<ShadowMap> {
            let places = places_on(&lamp.form, &ON_LAMP).iter();
            places.map(|&u| ShadowMap::new(&lamp.form, scene, surfaces, u, size)).collect()
        };
        let mut of_lamps: Vec<Vec<ShadowMap>> = scene.lamps.iter().map(of_lamp).collect();
        let views = of_lamps.iter_mut().zip(&scene.lamps).flat_map(|(maps, lamp)| {
            let own = match &lamp.form {
                LampForm::Surface(lamp) => Some(lamp.object as u32),
                _ => None,
            };
            maps.iter_mut().flat_map(move |map| map.views.iter_mut().map(move |view| (view, own)))
        });
        let mut views: Vec<_> = views.collect();
        views.par_iter_mut().for_each(|(view, own)| view.scan(surfaces, *own));
        Self { of_lamps }
    }

    /// The part of a place on a lamp that is seen from a place.
    pub fn visible(&self, place: &Place, light: &Arriving) -> f32 {
        let map = &self.of_lamps[light.lamp][light.place];
        let side = 1.0f32.copysign(place.geometric.dot(light.direction));
        map.view(place.position).map_or(1.0, |view| view.visible(place.position, place.geometric * side))
    }
}
