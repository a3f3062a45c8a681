//! Scanline rendering with incremental shading (Bouknight 1970, Gouraud 1971, Phong 1975; book 4.2).
//!
//! Triangles are transformed to the screen ([`projection`]); an edge table gives the spans of each scanline ([`edges`]); the
//! nearest of them are found pixel by pixel, which leaves visible runs; and along each run colours or normals are updated by increments.
//! Transparent surfaces lie before the nearest opaque one in the order of their depth (Newell, Newell and Sancha 1972).

pub mod edges;
mod lighting;
mod projection;
mod surfaces;

use crate::film::{TOO_LARGE, TileFilm};
use crate::lanes::Pass;
use crate::passes::{Job, TileCounts, TileRenderer, auxiliary_layers};
use crate::path::Primary;
use crate::sequence::Sequence;
use crate::settings::{Interpolation, Layer, Settings, Technique};
use edges::{Corner, EdgeTable, Span};
use glam::{Vec2, Vec3};
use illuminant_illumination::{IlluminationModel, Prepare};
use illuminant_sampling::Lanes;
use illuminant_scene::{Camera, Scene, TexturePoint, along_texture};
use lighting::{Lighting, PARTS, Place, ambient};
use projection::{Polygon, Projection};
use rayon::prelude::*;
use std::ops::Range;
use surfaces::Surfaces;

/// Rows of a band of scanlines, which one thread takes at a time.
pub(crate) const BAND: u32 = 16;

/// A pass with what has been shaded ahead of scanning.
struct ShadedPass<const N: usize, M> {
    pass: Pass<N, M>,
    ambient: Vec<Lanes<N>>,
    /// What the model gave for each polygon (`constant`), or for each vertex as it is seen from the front and from the back
    /// (`gouraud`); empty where nothing is seen.
    values: Vec<Vec<f32>>,
}

/// The scanline renderer.
pub(crate) struct Scanline<const N: usize, M> {
    technique: Technique,
    interpolation: Interpolation,
    surfaces: Surfaces,
    projection: Projection,
    /// For each band of [`BAND`] rows of the image the polygons that samples in it may meet.
    bands: Vec<Vec<u32>>,
    /// For each object whether anything is seen through it.
    transparent: Vec<bool>,
    passes: Vec<ShadedPass<N, M>>,
    /// The parts of radiance that are kept: all where they are wanted by themselves, else their sum.
    parts: usize,
    /// The group of each lamp, and how many groups there are.
    group_of: Vec<usize>,
    groups: usize,
    shadows: bool,
    /// For each object whether images say something of its material.
    textured: Vec<bool>,
    /// The angle across a pixel.
    pixel_angle: f32,
}

/// Appends the values that are interpolated: parts of radiance or their sum, and what is seen through.
fn store<const N: usize>(
    values: &mut Vec<f32>,
    parts: &[Lanes<N>],
    through: Option<&Lanes<N>>,
    count: usize,
) {
    if count == 1 {
        let groups = parts.len() / PARTS;
        for group in 0..groups {
            let of_group = parts[group..].iter().step_by(groups);
            values.extend(of_group.fold(Lanes::default(), |sum: Lanes<N>, part| sum + *part).0);
        }
    } else {
        parts.iter().for_each(|part| values.extend(part.0));
    }
    if let Some(through) = through {
        values.extend(through.0);
    }
}

/// Sorts polygons into bands of rows from the top of the crop; samples lie up to `margin` from the middle of their pixel.
fn bands(projection: &Projection, camera: &Camera, margin: f32) -> Vec<Vec<u32>> {
    let [_, top, _, bottom] = camera.crop;
    let mut bands = vec![Vec::new(); (bottom - top).div_ceil(BAND) as usize];
    let margin = f64::from(margin) + 1.0;
    let band = |y: f64| (y - f64::from(top)) / f64::from(BAND);
    for (number, polygon) in projection.polygons.iter().enumerate() {
        let first = band(polygon.top - margin).max(0.0) as usize;
        let end = (band(polygon.bottom + margin) + 1.0).clamp(0.0, bands.len() as f64) as usize;
        for polygons in bands.iter_mut().take(end).skip(first) {
            polygons.push(number as u32);
        }
    }
    bands
}

/// The number of a vertex as it is seen from the side of a polygon.
fn side(vertex: u32, polygon: &Polygon) -> usize {
    2 * vertex as usize + usize::from(!polygon.front)
}

impl<const N: usize, M: IlluminationModel<N> + Prepare> Scanline<N, M> {
    pub fn new(
        scene: &Scene,
        settings: &Settings,
        technique: Technique,
        group_of: &[usize],
        passes: Vec<Pass<N, M>>,
    ) -> Self {
        let surfaces = Surfaces::gather(scene, scene.camera.shutter[0]);
        let projection = Projection::new(&surfaces, &scene.camera);
        let seen_through = |object: &illuminant_scene::Object| {
            use illuminant_illumination::Surface;
            let surface = &scene.materials[object.material].surface;
            matches!(surface, Surface::Filter { .. } | Surface::Dielectric { .. })
        };
        let mut all = Self {
            technique,
            interpolation: settings.interpolation,
            transparent: scene.objects.iter().map(seen_through).collect(),
            bands: bands(&projection, &scene.camera, settings.filter.radius()),
            parts: if settings.layers.contains(&Layer::Terms) { PARTS } else { 1 },
            group_of: group_of.to_vec(),
            groups: group_of.iter().max().map_or(0, |last| last + 1),
            shadows: settings.shadows,
            textured: scene.objects.iter().map(|object| !scene.skins[object.material].is_bare()).collect(),
            pixel_angle: scene.camera.pixel_angle(),
            surfaces,
            projection,
            passes: Vec::new(),
        };
        let shaded = passes.into_iter().map(|pass| all.shade_ahead(scene, pass, settings.ambient as f32));
        all.passes = shaded.collect();
        all
    }

    fn lighting<'a>(
        &'a self,
        scene: &'a Scene,
        pass: &'a Pass<N, M>,
        ambient: &'a [Lanes<N>],
    ) -> Lighting<'a, N, M> {
        Lighting { scene, pass, group_of: &self.group_of, ambient, shadows: self.shadows }
    }

    /// A point of a polygon as it is shaded.
    fn place(&self, polygon: &Polygon, position: Vec3, normal: Vec3, uv: Vec2) -> Place {
        let face = &self.surfaces.faces[polygon.face as usize];
        let object = face.object as usize;
        let texture = self.textured[object].then(|| {
            let corners = face.corners.map(|i| &self.surfaces.vertices[i as usize]);
            let along = along_texture(corners.map(|c| c.position), corners.map(|c| c.uv));
            let from_eye = position - self.projection.eye;
            let width = self.pixel_angle * from_eye.length();
            TexturePoint::new(uv, along, width, from_eye.normalize_or(-face.normal), face.normal)
        });
        Place {
            texture,
            position,
            normal,
            object: face.object as usize,
            to_viewer: (self.projection.eye - position).normalize_or(face.normal),
            front: polygon.front,
            geometric: face.normal,
        }
    }

    /// Evaluates the model where the technique does it before scanning: once a polygon, or at its corners.
    fn shade_ahead(&self, scene: &Scene, pass: Pass<N, M>, fraction: f32) -> ShadedPass<N, M> {
        let ambient = ambient(scene, &pass, &self.group_of, fraction);
        let lighting = self.lighting(scene, &pass, &ambient);
        let shade = |place: &Place| {
            let (mut parts, mut values) = (Vec::new(), Vec::new());
            let through = lighting.shade(place, &mut parts);
            let through = self.transparent[place.object].then_some(&through);
            store(&mut values, &parts, through, self.parts);
            values
        };
        let (projection, faces) = (&self.projection, &self.surfaces.faces);
        let place = |polygon: &Polygon, position, normal, uv| self.place(polygon, position, normal, uv);
        let values = match self.technique {
            Technique::Constant => projection
                .polygons
                .par_iter()
                .map(|polygon| {
                    let corners = projection.corners_of(polygon);
                    let sum: Vec3 = corners.iter().map(|&i| projection.vertices[i as usize].position).sum();
                    let uv: Vec2 = corners.iter().map(|&i| projection.vertices[i as usize].uv).sum();
                    let normal = faces[polygon.face as usize].normal;
                    let count = corners.len() as f32;
                    shade(&place(polygon, sum / count, normal, uv / count))
                })
                .collect(),
            Technique::Gouraud => {
                // Each vertex once for each of its sides that is seen, by a polygon that it belongs to.
                let mut wanted = vec![u32::MAX; 2 * projection.vertices.len()];
                for (number, polygon) in projection.polygons.iter().enumerate() {
                    for &corner in projection.corners_of(polygon) {
                        wanted[side(corner, polygon)] = number as u32;
                    }
                }
                wanted
                    .par_iter()
                    .enumerate()
                    .with_min_len(256)
                    .map(|(i, &number)| {
                        let vertex = &projection.vertices[i / 2];
                        projection.polygons.get(number as usize).map_or_else(Vec::new, |polygon| {
                            shade(&place(polygon, vertex.position, vertex.normal, vertex.uv))
                        })
                    })
                    .collect()
            }
            _ => Vec::new(),
        };
        ShadedPass { ambient, values, pass }
    }

    /// How many values a polygon interpolates after 1/W.
    fn width(&self, polygon: &Polygon) -> usize {
        match self.technique {
            Technique::Constant => 0,
            Technique::Gouraud => {
                let object = self.surfaces.faces[polygon.face as usize].object as usize;
                N * (self.parts * self.groups + usize::from(self.transparent[object]))
            }
            _ if self.textured[self.surfaces.faces[polygon.face as usize].object as usize] => 8,
            _ => 6,
        }
    }

    /// The values of a span at its first pixel, 1/W first, and their growths.
    fn interpolated<'a>(&self, table: &'a EdgeTable, span: &Span) -> (&'a [f32], &'a [f32]) {
        let width = self.width(&self.projection.polygons[span.polygon as usize]) + 1;
        table.values[span.values..span.values + 2 * width].split_at(width)
    }

    /// Enters a polygon into the edge table.
    fn enter(
        &self,
        shaded: &ShadedPass<N, M>,
        table: &mut EdgeTable,
        number: u32,
        y: i32,
        offset: [f64; 2],
        scratch: &mut Vec<f32>,
    ) {
        let polygon = &self.projection.polygons[number as usize];
        let corners = self.projection.corners_of(polygon);
        let width = self.width(polygon);
        scratch.clear();
        for &corner in corners {
            let q = self.projection.screen[corner as usize].q as f32;
            let factor = if self.interpolation == Interpolation::Object { q } else { 1.0 };
            scratch.push(q);
            if self.technique == Technique::Gouraud {
                scratch.extend(shaded.values[side(corner, polygon)].iter().map(|v| v * factor));
            } else if width > 0 {
                let vertex = &self.projection.vertices[corner as usize];
                scratch.extend((vertex.normal * factor).to_array());
                scratch.extend((vertex.position * factor).to_array());
                if width == 8 {
                    scratch.extend((vertex.uv * factor).to_array());
                }
            }
        }
        let places = corners.iter().zip(scratch.chunks(width + 1)).map(|(&corner, values)| {
            let at = &self.projection.screen[corner as usize];
            Corner { x: at.x, y: at.y, values }
        });
        table.enter(number, y, places, offset);
    }

    /// The parts of the radiance at a pixel of a span, and what is seen through it.
    #[inline]
    fn resolve(
        &self,
        lighting: &Lighting<'_, N, M>,
        shaded: &ShadedPass<N, M>,
        number: u32,
        values: &[f32],
        to: &mut [f32],
        scratch: &mut (Vec<Lanes<N>>, Vec<f32>),
    ) {
        let polygon = &self.projection.polygons[number as usize];
        let factor = if self.interpolation == Interpolation::Object { values[0].recip() } else { 1.0 };
        match self.technique {
            Technique::Constant => {
                to.copy_from_slice(&shaded.values[number as usize][..to.len()]);
            }
            Technique::Gouraud => {
                for (slot, value) in to.iter_mut().zip(&values[1..]) {
                    *slot = value * factor;
                }
            }
            _ => {
                let vector = |i: usize| Vec3::new(values[i], values[i + 1], values[i + 2]) * factor;
                let face = &self.surfaces.faces[polygon.face as usize];
                let uv = match values {
                    [.., u, v] if values.len() == 9 => Vec2::new(*u, *v) * factor,
                    _ => Vec2::ZERO,
                };
                let place = self.place(polygon, vector(4), vector(1).normalize_or(face.normal), uv);
                let (parts, kept) = scratch;
                let through = lighting.shade(&place, parts);
                kept.clear();
                store(kept, parts, Some(&through), self.parts);
                to.copy_from_slice(&kept[..to.len()]);
            }
        }
    }
}

/// The buffers of one band of scanlines.
#[derive(Default)]
struct Band {
    table: EdgeTable,
    scratch: Vec<f32>,
    /// For each pixel of the scanline the largest 1/W, and the span that has it.
    nearest: Vec<f32>,
    owner: Vec<u32>,
    /// Pixels of transparent spans that lie before: column, 1/W, span.
    veils: Vec<(i32, f32, u32)>,
    /// The parts of the radiance of a pixel, and what is seen through.
    pixel: Vec<f32>,
    values: Vec<f32>,
}

const NOBODY: u32 = u32::MAX;

impl<const N: usize, M: IlluminationModel<N> + Prepare> Scanline<N, M> {
    /// Finds what is nearest in each pixel of a scanline.
    fn resolve_depth(&self, band: &mut Band, columns: [i32; 2]) {
        let size = (columns[1] - columns[0]) as usize;
        band.nearest.clear();
        band.nearest.resize(size, 0.0);
        band.owner.clear();
        band.owner.resize(size, NOBODY);
        band.veils.clear();
        let first = |span: &Span| {
            let (values, growths) = self.interpolated(&band.table, span);
            (values[0], growths[0])
        };
        let is_veil = |span: &Span| {
            let face = self.projection.polygons[span.polygon as usize].face;
            self.transparent[self.surfaces.faces[face as usize].object as usize]
        };
        for (number, span) in band.table.spans.iter().enumerate() {
            if is_veil(span) {
                continue;
            }
            let (mut q, dq) = first(span);
            let place = (span.start - columns[0]) as usize..(span.end - columns[0]) as usize;
            for (nearest, owner) in band.nearest[place.clone()].iter_mut().zip(&mut band.owner[place]) {
                if q > *nearest {
                    (*nearest, *owner) = (q, number as u32);
                }
                q += dq;
            }
        }
        for (number, span) in band.table.spans.iter().enumerate().filter(|(_, span)| is_veil(span)) {
            let (q0, dq) = first(span);
            for x in span.start..span.end {
                let q = q0 + dq * (x - span.start) as f32;
                if q > band.nearest[(x - columns[0]) as usize] {
                    band.veils.push((x, q, number as u32));
                }
            }
        }
        // Farthest first.
        band.veils.sort_by(|a, b| (a.0, a.1).partial_cmp(&(b.0, b.1)).unwrap_or(std::cmp::Ordering::Equal));
    }

    /// One sample of every pixel of a tile, in one pass: adds to `sums` (channels a pixel) and notes what is seen first.
    fn scan(
        &self,
        job: &Job,
        shaded: &ShadedPass<N, M>,
        area: [u32; 4],
        offset: [f32; 2],
        band: &mut Band,
        sums: &mut [f32],
        seen: &mut [Primary],
    ) {
        let lighting = self.lighting(&job.scene, &shaded.pass, &shaded.ambient);
        let columns = [area[0] as i32, area[2] as i32];
        let rows = [area[1] as i32, area[3] as i32];
        let shift = [0.5 + f64::from(offset[0]), 0.5 + f64::from(offset[1])];
        let mut entering: Vec<(i32, u32)> = Vec::new();
        for &number in &self.bands[((area[1] - job.scene.camera.crop[1]) / BAND) as usize] {
            let first = EdgeTable::first_row(self.projection.polygons[number as usize].top, shift[1]);
            if first < rows[1] {
                entering.push((first.max(rows[0]), number));
            }
        }
        entering.sort_unstable();
        let mut next = 0;
        band.table.clear();
        for y in rows[0]..rows[1] {
            while let Some(&(_, number)) = entering.get(next).filter(|(first, _)| *first <= y) {
                let mut scratch = std::mem::take(&mut band.scratch);
                self.enter(shaded, &mut band.table, number, y, shift, &mut scratch);
                band.scratch = scratch;
                next += 1;
            }
            band.table.scan(y, columns);
            self.resolve_depth(band, columns);
            self.shade_row(job, &lighting, shaded, (y, area, offset), band, sums, seen);
        }
    }

    /// Shades what is visible of a scanline.
    fn shade_row(
        &self,
        job: &Job,
        lighting: &Lighting<'_, N, M>,
        shaded: &ShadedPass<N, M>,
        (y, area, offset): (i32, [u32; 4], [f32; 2]),
        band: &mut Band,
        sums: &mut [f32],
        seen: &mut [Primary],
    ) {
        let left = area[0] as i32;
        let row = (y as u32 - area[1]) as usize * (area[2] - area[0]) as usize;
        let (mut running, mut veil) = (NOBODY, 0);
        let mut pixel = std::mem::take(&mut band.pixel);
        let mut values = std::mem::take(&mut band.values);
        let mut scratch = (Vec::new(), Vec::new());
        let count = N * self.parts * self.groups;
        for column in 0..(area[2] - area[0]) as usize {
            let owner = band.owner[column];
            let x = left + column as i32;
            let ray = || job.scene.camera.ray(x as f32 + 0.5 + offset[0], y as f32 + 0.5 + offset[1], 0.0);
            pixel.clear();
            pixel.resize(count, 0.0);
            if owner == NOBODY {
                if !job.scene.surroundings.is_empty() {
                    scratch.0.clear();
                    scratch.0.resize(self.groups, Lanes::default());
                    lighting.add_background(ray().direction, &mut scratch.0);
                    let slots = pixel[count - N * self.groups..].chunks_exact_mut(N);
                    slots.zip(&scratch.0).for_each(|(slot, light)| slot.copy_from_slice(&light.0));
                }
                seen[row + column].emits = !job.scene.surroundings.is_empty();
            } else {
                let span = band.table.spans[owner as usize];
                let (start, growth) = self.interpolated(&band.table, &span);
                if owner == running {
                    values.iter_mut().zip(growth).for_each(|(value, growth)| *value += growth);
                } else {
                    let skipped = (x - span.start) as f32;
                    values.clear();
                    values.extend(start.iter().zip(growth).map(|(value, growth)| value + growth * skipped));
                }
                self.resolve(lighting, shaded, span.polygon, &values, &mut pixel, &mut scratch);
            }
            running = owner;
            let mut first = (owner, band.nearest[column]);
            while let Some(&(_, q, number)) = band.veils.get(veil).filter(|v| v.0 == x) {
                veil += 1;
                let span = band.table.spans[number as usize];
                let (start, growth) = self.interpolated(&band.table, &span);
                let skipped = (x - span.start) as f32;
                let at: Vec<f32> =
                    start.iter().zip(growth).map(|(value, growth)| value + growth * skipped).collect();
                let mut own = vec![0.0; count + N];
                self.resolve(lighting, shaded, span.polygon, &at, &mut own, &mut scratch);
                let (own, through) = own.split_at(count);
                for (i, (behind, own)) in pixel.iter_mut().zip(own).enumerate() {
                    *behind = *behind * through[i % N] + own;
                }
                first = (number, q);
            }
            if first.0 != NOBODY {
                let span = band.table.spans[first.0 as usize];
                let face =
                    &self.surfaces.faces[self.projection.polygons[span.polygon as usize].face as usize];
                // W is along the direction of view; distance is along the ray.
                let slant = ray().direction.dot(job.scene.camera.forward());
                seen[row + column].surface = Some((1.0 / (first.1 * slant), face.object, face.normal));
                seen[row + column].emits |=
                    pixel_emits(job, face.object as usize, face.normal, ray().direction);
            }
            self.add(job, shaded, &pixel, &mut sums[(row + column) * job.channels..][..job.channels]);
        }
        band.pixel = pixel;
        band.values = values;
    }

    /// Adds the parts of a pixel to its channels.
    fn add(&self, job: &Job, shaded: &ShadedPass<N, M>, pixel: &[f32], channels: &mut [f32]) {
        for (i, lanes) in pixel.chunks_exact(N).enumerate() {
            let (part, rows) = (i / self.groups, &shaded.pass.to_xyz[i % self.groups]);
            let lanes = Lanes::<N>(std::array::from_fn(|i| lanes[i]));
            let xyz = rows.each_ref().map(|row| lanes.dot(row));
            channels[..3].iter_mut().zip(xyz).for_each(|(sum, v)| *sum += v);
            for layer in &job.plan {
                match layer.layer {
                    Layer::Terms if self.parts > 1 && layer.name == crate::film::TERMS[part] => {
                        channels[layer.channels.clone()].iter_mut().zip(xyz).for_each(|(sum, v)| *sum += v);
                    }
                    Layer::Spectra => {
                        let samples = shaded.pass.own_samples();
                        let slots = &mut channels[layer.channels.clone()][samples];
                        slots.iter_mut().zip(&lanes.0).for_each(|(sum, v)| *sum += v);
                    }
                    _ => {}
                }
            }
        }
    }
}

/// Whether an object gives light in the direction from which a ray comes.
fn pixel_emits(job: &Job, object: usize, normal: Vec3, direction: Vec3) -> bool {
    let scene = &job.scene;
    scene.objects[object].lamp.is_some_and(|lamp| scene.lamps[lamp].emits(normal, direction))
}

impl<const N: usize, M: IlluminationModel<N> + Prepare> TileRenderer for Scanline<N, M> {
    fn tile(&self, job: &Job, tile: &mut TileFilm, samples: Range<u64>) -> TileCounts {
        let mut result = TileCounts::default();
        let mut band = Band::default();
        let pixels = tile.samples.len();
        let mut sums = vec![0.0f32; pixels * job.channels];
        let mut seen = vec![Primary::default(); pixels];
        let replicates = u64::from(job.settings.replicates.max(1));
        for sample in tile.claim(samples).into_iter().flatten() {
            // All pixels are sampled at the same place, so that edges move by whole images.
            let mut sequence = Sequence::new(job.settings.seed, 0, sample / replicates, sample % replicates);
            let [u, v, ..] = sequence.next4();
            let offset = [job.filter.offset(u), job.filter.offset(v)];
            sums.fill(0.0);
            seen.fill(Primary::default());
            for shaded in &self.passes {
                self.scan(job, shaded, tile.area, offset, &mut band, &mut sums, &mut seen);
            }
            for (i, values) in sums.chunks_exact_mut(job.channels).enumerate() {
                result.samples += 1;
                if job.plan.len() > 1 {
                    auxiliary_layers(job, &seen[i], sample, values);
                }
                if values.iter().all(|v| v.abs() < TOO_LARGE) {
                    tile.add(i, values);
                } else {
                    let x = tile.area[0] + i as u32 % tile.width();
                    let y = tile.area[1] + i as u32 / tile.width();
                    result.dropped.push(([x, y], sample));
                }
            }
        }
        result
    }
}
