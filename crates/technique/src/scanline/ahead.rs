//! What is shaded before scanning, and the values that corners give to spans.

use super::edges::Quad;
use super::lighting::{Lighting, PARTS, Place};
use super::projection::Polygon;
use super::{OF_TEXTURE, Scanline, side};
use crate::direct_light::ambient;
use crate::film::{LayerPlan, TERMS};
use crate::lanes::Pass;
use crate::settings::{Interpolation, Layer, Technique};
use glam::{Vec2, Vec3};
use illuminant_illumination::{IlluminationModel, Prepare};
use illuminant_sampling::Lanes;
use illuminant_scene::{Scene, TexturePoint, along_texture};
use rayon::prelude::*;

/// A pass with what has been shaded ahead of scanning.
pub(super) struct ShadedPass<const N: usize, M> {
    pub pass: Pass<N, M>,
    pub ambient: Vec<Lanes<N>>,
    /// What the model gave, in lanes; empty where [`Channels`] holds it.
    pub values: Vec<Quad>,
}

/// What the model gave as channels of the film, over all passes.
///
/// XYZ, terms and samples are sums of lanes with fixed weights. So where nothing is seen through anything, they are interpolated
/// themselves: the same value, and the work between corners does not depend on the number of lanes.
pub(super) struct Channels {
    /// Which of the channels of a pixel they are.
    pub of_film: Vec<usize>,
    pub values: Vec<Quad>,
}

impl Channels {
    /// What was found for a polygon, 1/W or nothing first.
    pub fn of_polygon(&self, polygon: u32, stride: usize) -> &[f32] {
        self.values[polygon as usize * stride..][..stride].as_flattened()
    }

    /// Adds values, behind the first of them, to the channels of a pixel.
    #[inline(always)]
    pub fn add(&self, values: &[f32], factor: f32, pixel: &mut [f32]) {
        self.of_film.iter().zip(&values[1..]).for_each(|(&channel, v)| pixel[channel] += v * factor);
    }
}

/// The channels that lanes are added to.
pub(super) fn channels_of_lanes(plan: &[LayerPlan]) -> Vec<usize> {
    let of_lanes = |layer: &&LayerPlan| matches!(layer.layer, Layer::Xyz | Layer::Terms | Layer::Spectra);
    plan.iter().filter(of_lanes).flat_map(|layer| layer.channels.clone()).collect()
}

/// Adds the parts of the radiance of a pixel to its channels: for each part (or their sum) a bundle for every group of lamps.
pub(super) fn add_to_channels<const N: usize, M>(
    plan: &[LayerPlan],
    pass: &Pass<N, M>,
    pixel: &[f32],
    (parts, groups): (usize, usize),
    channels: &mut [f32],
) {
    for (i, lanes) in pixel.chunks_exact(N).enumerate() {
        let (part, rows) = (i / groups, &pass.to_xyz[i % groups]);
        let lanes = Lanes::<N>(std::array::from_fn(|i| lanes[i]));
        let xyz = rows.each_ref().map(|row| lanes.dot(row));
        channels[..3].iter_mut().zip(xyz).for_each(|(sum, v)| *sum += v);
        for layer in plan {
            match layer.layer {
                Layer::Terms if parts > 1 && layer.name == TERMS[part] => {
                    channels[layer.channels.clone()].iter_mut().zip(xyz).for_each(|(sum, v)| *sum += v);
                }
                Layer::Spectra => {
                    let slots = &mut channels[layer.channels.clone()][pass.own_samples()];
                    slots.iter_mut().zip(&lanes.0).for_each(|(sum, v)| *sum += v);
                }
                _ => {}
            }
        }
    }
}

/// Puts down the values that are interpolated: parts of radiance or their sum, then what is seen through, where there is room for it.
pub(super) fn store<const N: usize>(to: &mut [f32], parts: &[Lanes<N>], through: &Lanes<N>, count: usize) {
    let mut slots = to.chunks_exact_mut(N);
    let mut put = |lanes: &Lanes<N>| {
        if let Some(slot) = slots.next() {
            slot.copy_from_slice(&lanes.0);
        }
    };
    if count == 1 {
        let groups = parts.len() / PARTS;
        for group in 0..groups {
            let of_group = parts[group..].iter().step_by(groups);
            put(&of_group.fold(Lanes::default(), |sum: Lanes<N>, part| sum + *part));
        }
    } else {
        parts.iter().for_each(&mut put);
    }
    put(through);
}

impl<const N: usize, M: IlluminationModel<N> + Prepare> Scanline<N, M> {
    pub(super) fn lighting<'a>(
        &'a self,
        scene: &'a Scene,
        pass: &'a Pass<N, M>,
        ambient: &'a [Lanes<N>],
    ) -> Lighting<'a, N, M> {
        let (lamps, shadows) = (&self.lamps, &self.shadows);
        Lighting { scene, pass, group_of: &self.group_of, ambient, lamps, shadows }
    }

    /// A point of a polygon as it is shaded.
    pub(super) fn place(&self, polygon: &Polygon, position: Vec3, normal: Vec3, uv: Vec2) -> Place {
        let face = &self.surfaces.faces[polygon.face as usize];
        let texture = self.textured[face.object as usize].then(|| {
            let corners = face.corners.map(|i| &self.surfaces.vertices[i as usize]);
            let along = along_texture(corners.map(|c| c.position), corners.map(|c| c.uv));
            let from_eye = position - self.projection.eye;
            let width = self.pixel_angle * from_eye.length();
            // Nothing moves here.
            TexturePoint::new(uv, along, position, width, from_eye.normalize_or(-face.normal), face.normal)
        });
        Place {
            texture,
            colour: None,
            position,
            normal,
            object: face.object as usize,
            to_viewer: self
                .distant_eye
                .unwrap_or_else(|| (self.projection.eye - position).normalize_or(face.normal)),
            front: polygon.front,
            geometric: face.normal,
        }
    }

    /// What the values of a corner are multiplied by before they are interpolated: 1/W in the world.
    fn factor(&self, corner: usize) -> f32 {
        match self.interpolation {
            Interpolation::Object => self.projection.screen[corner].q as f32,
            Interpolation::Screen => 1.0,
        }
    }

    /// What corners give to spans where nothing has been shaded at them: 1/W, and for `phong` normal and position.
    pub(super) fn corner_values(&self) -> Vec<Quad> {
        let mut values = Vec::new();
        if self.technique == Technique::Gouraud {
            return values;
        }
        for (i, vertex) in self.projection.vertices.iter().enumerate() {
            let q = self.projection.screen[i].q as f32;
            let [n, p] = [vertex.normal, vertex.position].map(|v| v * self.factor(i));
            let uv = vertex.uv * self.factor(i);
            let quads = match self.technique {
                Technique::Constant => [[q, uv.x, uv.y, 0.0], [p.x, p.y, p.z, 0.0], [0.0; 4]],
                _ => [[q, n.x, n.y, n.z], [p.x, p.y, p.z, 0.0], [uv.x, uv.y, 0.0, 0.0]],
            };
            values.extend(&quads[..self.quads]);
        }
        values
    }

    /// Where the model is evaluated before scanning: once a polygon, or at each corner for each of its sides that is seen.
    fn places_ahead(&self) -> Vec<Option<(Place, f32, f32)>> {
        let (projection, faces) = (&self.projection, &self.surfaces.faces);
        match self.technique {
            Technique::Constant => {
                let middle = |polygon: &Polygon| {
                    let corners = projection.corners_of(polygon);
                    let sum: Vec3 = corners.iter().map(|&i| projection.vertices[i as usize].position).sum();
                    let uv: Vec2 = corners.iter().map(|&i| projection.vertices[i as usize].uv).sum();
                    let (normal, count) = (faces[polygon.face as usize].normal, corners.len() as f32);
                    Some((self.place(polygon, sum / count, normal, uv / count), 0.0, 1.0))
                };
                projection.polygons.iter().map(middle).collect()
            }
            Technique::Gouraud => {
                // Each vertex by one of the polygons that it belongs to.
                let mut places = vec![None; 2 * projection.vertices.len()];
                for polygon in &projection.polygons {
                    for &corner in projection.corners_of(polygon) {
                        let vertex = &projection.vertices[corner as usize];
                        let place = self.place(polygon, vertex.position, vertex.normal, vertex.uv);
                        let q = projection.screen[corner as usize].q as f32;
                        places[side(corner, polygon)] = Some((place, q, self.factor(corner as usize)));
                    }
                }
                places
            }
            _ => Vec::new(),
        }
    }

    /// Evaluates the model in one pass wherever the technique does it before scanning. The lanes are kept with the pass, or added to
    /// the channels.
    pub(super) fn shade_ahead(
        &self,
        scene: &Scene,
        plan: &[LayerPlan],
        pass: Pass<N, M>,
        fraction: f32,
        channels: Option<&mut Channels>,
    ) -> ShadedPass<N, M> {
        let ambient = ambient(scene, &pass, &self.group_of, fraction);
        let lighting = self.lighting(scene, &pass, &ambient);
        let places = self.places_ahead();
        let mut own = Vec::new();
        let (values, of_film): (&mut Vec<Quad>, &[usize]) = match channels {
            Some(channels) => (&mut channels.values, &channels.of_film),
            None => (&mut own, &[]),
        };
        values.resize(places.len() * self.stride, [0.0; 4]);
        let count = plan.last().map_or(0, |layer| layer.channels.end);
        let shade = |scratch: &mut (Vec<Lanes<N>>, Vec<f32>, Vec<f32>),
                     (block, place): (&mut [Quad], &Option<(Place, f32, f32)>)| {
            let Some((place, q, factor)) = place else { return };
            let (parts, pixel, film) = scratch;
            let coloured = self.coloured[place.object];
            let through = lighting.shade(&Place { colour: coloured.then_some(1.0), ..*place }, parts);
            pixel.resize(N * (self.parts * self.groups + usize::from(of_film.is_empty())), 0.0);
            store(pixel, parts, &through, self.parts);
            let block = block.as_flattened_mut();
            block[0] = *q;
            if let (Some(texture), true) = (&place.texture, coloured) {
                // Radiance is linear in the share of a colour between black and white; the image is looked up pixel by pixel.
                block[1..].iter_mut().zip(pixel.iter()).for_each(|(slot, v)| *slot = v * factor);
                let through = lighting.shade(&Place { colour: Some(0.0), ..*place }, parts);
                store(pixel, parts, &through, self.parts);
                let black = &mut block[1 + pixel.len()..];
                black.iter_mut().zip(pixel.iter()).for_each(|(slot, v)| *slot = v * factor);
                let (uv, p) = (texture.uv * *factor, place.position * *factor);
                block[1 + 2 * pixel.len()..][..OF_TEXTURE].copy_from_slice(&[uv.x, uv.y, p.x, p.y, p.z]);
                return;
            }
            if of_film.is_empty() {
                block[1..].iter_mut().zip(pixel.iter()).for_each(|(slot, v)| *slot = v * factor);
            } else {
                film.clear();
                film.resize(count, 0.0);
                add_to_channels(plan, &pass, pixel, (self.parts, self.groups), film);
                let found = of_film.iter().map(|&channel| film[channel] * factor);
                block[1..].iter_mut().zip(found).for_each(|(slot, v)| *slot += v);
            }
        };
        values
            .par_chunks_mut(self.stride.max(1))
            .zip(&places)
            .with_min_len(256)
            .for_each_init(|| (Vec::new(), Vec::new(), Vec::new()), shade);
        ShadedPass { ambient, values: own, pass }
    }
}
