//! A band of scanlines: what is visible in each, and its radiance.

use super::ahead::{ShadedPass, add_to_channels, store};
use super::edges::{Corner, EdgeTable, Quad, grown};
use super::lighting::Lighting;
use super::{BAND, Scanline, side};
use crate::passes::Job;
use crate::path::Primary;
use crate::settings::{Interpolation, Technique};
use glam::{Vec3, Vec4};
use illuminant_illumination::IlluminationModel;
use illuminant_sampling::Lanes;
use std::cmp::Ordering;

/// Where a band lies, and where its pixels are sampled.
#[derive(Clone, Copy)]
pub(super) struct Sampled {
    /// x₀, y₀, x₁, y₁ in pixels of the whole image.
    pub area: [u32; 4],
    /// From the middle of each pixel.
    pub offset: [f32; 2],
}

impl Sampled {
    fn width(&self) -> usize {
        (self.area[2] - self.area[0]) as usize
    }

    fn columns(&self) -> [i32; 2] {
        [self.area[0] as i32, self.area[2] as i32]
    }

    /// The direction in which the camera sees a sample.
    fn direction(&self, job: &Job, column: usize, y: i32) -> Vec3 {
        let x = (self.area[0] as usize + column) as f32 + 0.5 + self.offset[0];
        job.scene.camera.ray(x, y as f32 + 0.5 + self.offset[1], 0.0).direction
    }
}

/// The buffers of one band of scanlines.
pub(super) struct Band<const N: usize> {
    table: EdgeTable,
    /// The polygons that begin at each row.
    entering: Vec<Vec<u32>>,
    /// For each pixel of the scanline the largest 1/W, and the span that has it.
    nearest: Vec<f32>,
    owner: Vec<u32>,
    /// What lies before that, column by column, farthest first.
    veils: Vec<Veil>,
    /// The parts of the radiance of a pixel; the same of a veil, with what is seen through it.
    pixel: Vec<f32>,
    veil: Vec<f32>,
    parts: Vec<Lanes<N>>,
    values: Vec<Quad>,
    /// How many spans there were.
    pub spans: u64,
}

impl<const N: usize> Band<N> {
    pub fn new(quads: usize) -> Self {
        Self {
            table: EdgeTable::new(quads),
            entering: vec![Vec::new(); BAND as usize],
            nearest: Vec::new(),
            owner: Vec::new(),
            veils: Vec::new(),
            pixel: Vec::new(),
            veil: Vec::new(),
            parts: Vec::new(),
            values: Vec::new(),
            spans: 0,
        }
    }
}

/// A pixel of a transparent span.
#[derive(Clone, Copy)]
struct Veil {
    column: usize,
    /// 1/W.
    q: f32,
    polygon: u32,
    span: u32,
}

const NOBODY: u32 = u32::MAX;

/// The film of one sample of a band.
pub(super) struct Exposed<'a> {
    /// The channels of each pixel.
    pub channels: &'a mut [f32],
    /// What is seen first, if it is asked for.
    pub seen: &'a mut [Primary],
}

impl<const N: usize, M: IlluminationModel<N>> Scanline<N, M> {
    /// Enters a polygon into the edge table.
    fn enter(&self, ahead: &[Quad], table: &mut EdgeTable, number: u32, y: i32, offset: [f64; 2]) {
        let polygon = &self.projection.polygons[number as usize];
        let corners = self.projection.corners_of(polygon).iter().map(|&corner| {
            let at = &self.projection.screen[corner as usize];
            let place =
                if self.technique == Technique::Gouraud { side(corner, polygon) } else { corner as usize };
            let values = &ahead[place * self.quads..][..self.quads];
            Corner { x: at.x, y: at.y, values }
        });
        table.enter(number, y, corners, offset);
    }

    /// Whether anything is seen through a polygon.
    fn is_veil(&self, polygon: u32) -> bool {
        let face = self.projection.polygons[polygon as usize].face;
        self.transparent[self.surfaces.faces[face as usize].object as usize]
    }

    /// Finds what is nearest in each pixel of a scanline. Of two at one depth it is the first of the scene.
    fn resolve_depth(&self, band: &mut Band<N>, [left, right]: [i32; 2]) {
        let size = (right - left) as usize;
        band.nearest.clear();
        band.nearest.resize(size, 0.0);
        band.owner.clear();
        band.owner.resize(size, NOBODY);
        band.veils.clear();
        let spans = &band.table.spans;
        for (number, span) in spans.iter().enumerate() {
            if self.anything_transparent && self.is_veil(span.polygon) {
                continue;
            }
            let (start, growth) = band.table.of_span(number);
            let (mut q, dq) = (start[0][0], growth[0][0]);
            let place = (span.start - left) as usize..(span.end - left) as usize;
            for (nearest, owner) in band.nearest[place.clone()].iter_mut().zip(&mut band.owner[place]) {
                let first = || spans[*owner as usize].polygon > span.polygon;
                if q > *nearest || (q == *nearest && *owner != NOBODY && first()) {
                    (*nearest, *owner) = (q, number as u32);
                }
                q += dq;
            }
        }
        if !self.anything_transparent {
            return;
        }
        for (number, span) in spans.iter().enumerate().filter(|(_, span)| self.is_veil(span.polygon)) {
            let (start, growth) = band.table.of_span(number);
            for x in span.start..span.end {
                let q = start[0][0] + growth[0][0] * (x - span.start) as f32;
                let column = (x - left) as usize;
                if q > band.nearest[column] {
                    band.veils.push(Veil { column, q, polygon: span.polygon, span: number as u32 });
                }
            }
        }
        band.veils.sort_unstable_by(|a, b| {
            let depth = a.q.partial_cmp(&b.q).unwrap_or(Ordering::Equal);
            a.column.cmp(&b.column).then(depth).then(a.polygon.cmp(&b.polygon))
        });
    }

    /// One sample of every pixel of a band, in these passes.
    pub(super) fn scan(
        &self,
        job: &Job,
        passes: &[ShadedPass<N, M>],
        at: &Sampled,
        band: &mut Band<N>,
        exposed: &mut Exposed<'_>,
    ) {
        let area = at.area;
        let ahead = self.ahead_of_spans(&passes[0]);
        let rows = [area[1] as i32, area[3] as i32];
        let shift = at.offset.map(|v| 0.5 + f64::from(v));
        band.entering.iter_mut().for_each(Vec::clear);
        for &number in &self.bands[((area[1] - job.scene.camera.crop[1]) / BAND) as usize] {
            let first = EdgeTable::first_row(self.projection.polygons[number as usize].top, shift[1]);
            if first < rows[1] {
                band.entering[(first.max(rows[0]) - rows[0]) as usize].push(number);
            }
        }
        band.table.clear();
        for y in rows[0]..rows[1] {
            for &number in &band.entering[(y - rows[0]) as usize] {
                self.enter(ahead, &mut band.table, number, y, shift);
            }
            band.table.scan(y, at.columns());
            band.spans += band.table.spans.len() as u64;
            self.resolve_depth(band, at.columns());
            self.expose_row(job, passes, at, y, band, exposed);
        }
    }

    /// Exposes a scanline, run by run of what is visible.
    fn expose_row(
        &self,
        job: &Job,
        passes: &[ShadedPass<N, M>],
        at: &Sampled,
        y: i32,
        band: &mut Band<N>,
        exposed: &mut Exposed<'_>,
    ) {
        let width = at.width();
        let first = (y as u32 - at.area[1]) as usize * width;
        let channels = &mut exposed.channels[first * job.channels..][..width * job.channels];
        let (mut column, mut veil) = (0, 0);
        while column < width {
            let owner = band.owner[column];
            let length = band.owner[column..].iter().take_while(|o| **o == owner).count();
            let run = column..column + length;
            let to = &mut channels[column * job.channels..][..length * job.channels];
            if owner != NOBODY && self.channels.is_some() {
                self.expose_channels(job, at, &band.table, owner as usize, column, to);
            } else if let (Some(fast), true) = (&self.fast, owner != NOBODY) {
                let x = f64::from(at.area[0]) + column as f64 + 0.5 + f64::from(at.offset[0]);
                let y = f64::from(y) + 0.5 + f64::from(at.offset[1]);
                fast.expose(&band.table.spans[owner as usize], [x, y], job.channels, to);
            } else {
                let background = owner == NOBODY && job.scene.surroundings.is_empty();
                let veiled = band.veils.get(veil).is_some_and(|v| v.column < run.end);
                if !background || veiled {
                    for pass in passes {
                        let mut next = veil;
                        self.expose_lanes(job, pass, at, y, band, (owner, column), &mut next, to);
                    }
                }
            }
            if self.sees {
                for column in run.clone() {
                    let q = band.nearest[column];
                    let mut nearest = (owner, q);
                    while let Some(v) = band.veils.get(veil).filter(|v| v.column == column) {
                        nearest = (v.span, v.q);
                        veil += 1;
                    }
                    let direction = at.direction(job, column, y);
                    let background = owner == NOBODY && !job.scene.surroundings.is_empty();
                    exposed.seen[first + column] =
                        self.primary(job, &band.table, nearest, direction, background);
                }
            }
            while band.veils.get(veil).is_some_and(|v| v.column < run.end) {
                veil += 1;
            }
            column = run.end;
        }
    }

    /// What is seen first at a sample.
    fn primary(
        &self,
        job: &Job,
        table: &EdgeTable,
        (span, q): (u32, f32),
        direction: Vec3,
        background: bool,
    ) -> Primary {
        if span == NOBODY {
            return Primary { surface: None, emits: background };
        }
        let polygon = table.spans[span as usize].polygon as usize;
        let face = &self.surfaces.faces[self.projection.polygons[polygon].face as usize];
        // W is along the direction of view; distance is along the ray.
        let slant = direction.dot(job.scene.camera.forward());
        let lamp = job.scene.objects[face.object as usize].lamp;
        let lit = lamp.is_some_and(|lamp| job.scene.lamps[lamp].emits(face.normal, direction));
        Primary { surface: Some((1.0 / (q * slant), face.object, face.normal)), emits: background || lit }
    }

    /// Exposes a run of pixels to channels that were found ahead.
    #[inline]
    fn expose_channels(
        &self,
        job: &Job,
        at: &Sampled,
        table: &EdgeTable,
        number: usize,
        column: usize,
        to: &mut [f32],
    ) {
        let Some(channels) = &self.channels else { return };
        let span = &table.spans[number];
        let pixels = to.chunks_exact_mut(job.channels);
        if self.technique == Technique::Constant {
            let values = &channels.values[span.polygon as usize * self.stride..][..self.stride];
            let values = &values.as_flattened()[1..];
            for pixel in pixels {
                channels.of_film.iter().zip(values).for_each(|(&channel, v)| pixel[channel] += v);
            }
            return;
        }
        let (start, growth) = table.of_span(number);
        let skipped = (at.area[0] as i32 + column as i32 - span.start) as f32;
        let object = self.interpolation == Interpolation::Object;
        if let ([start], [growth]) = (start, growth) {
            // XYZ alone, beside 1/W.
            let mut value = Vec4::from(grown(*start, *growth, skipped));
            let growth = Vec4::from(*growth);
            for pixel in pixels {
                let xyz = if object { value * value.x.recip() } else { value };
                pixel[..3].copy_from_slice(&xyz.to_array()[1..]);
                value += growth;
            }
            return;
        }
        for (i, pixel) in pixels.enumerate() {
            let t = skipped + i as f32;
            let factor = if object { (start[0][0] + growth[0][0] * t).recip() } else { 1.0 };
            let values = start.as_flattened()[1..].iter().zip(&growth.as_flattened()[1..]);
            for (&channel, (value, growth)) in channels.of_film.iter().zip(values) {
                pixel[channel] += (value + growth * t) * factor;
            }
        }
    }

    /// Exposes a run of pixels to what one pass gives in lanes, through the veils before it.
    fn expose_lanes(
        &self,
        job: &Job,
        shaded: &ShadedPass<N, M>,
        at: &Sampled,
        y: i32,
        band: &mut Band<N>,
        (owner, first): (u32, usize),
        veil: &mut usize,
        to: &mut [f32],
    ) {
        let lighting = self.lighting(&job.scene, &shaded.pass, &shaded.ambient);
        let Band { table, veils, pixel, veil: before, parts, values, .. } = band;
        let count = N * self.parts * self.groups;
        pixel.resize(count, 0.0);
        before.resize(count + N, 0.0);
        let place = |number: u32, column: usize| {
            let span = table.spans[number as usize];
            (span.polygon, (at.area[0] as i32 + column as i32 - span.start) as f32)
        };
        for (i, channels) in to.chunks_exact_mut(job.channels).enumerate() {
            let column = first + i;
            if owner == NOBODY {
                pixel.fill(0.0);
                if !job.scene.surroundings.is_empty() {
                    parts.clear();
                    parts.resize(self.groups, Lanes::default());
                    lighting.add_background(at.direction(job, column, y), parts);
                    let slots = pixel[count - N * self.groups..].chunks_exact_mut(N);
                    slots.zip(parts.iter()).for_each(|(slot, light)| slot.copy_from_slice(&light.0));
                }
            } else {
                let (start, growth) = table.of_span(owner as usize);
                let (polygon, skipped) = place(owner, column);
                if i == 0 {
                    values.clear();
                    values.extend(start.iter().zip(growth).map(|(v, growth)| grown(*v, *growth, skipped)));
                } else {
                    values.iter_mut().zip(growth).for_each(|(v, growth)| *v = grown(*v, *growth, 1.0));
                }
                self.resolve(&lighting, shaded, polygon, values.as_flattened(), pixel, parts);
            }
            while let Some(v) = veils.get(*veil).filter(|v| v.column == column) {
                *veil += 1;
                let (start, growth) = table.of_span(v.span as usize);
                let (polygon, skipped) = place(v.span, column);
                let at: Vec<Quad> = start.iter().zip(growth).map(|(v, g)| grown(*v, *g, skipped)).collect();
                self.resolve(&lighting, shaded, polygon, at.as_flattened(), before, parts);
                let (own, through) = before.split_at(count);
                for (i, (behind, own)) in pixel.iter_mut().zip(own).enumerate() {
                    *behind = *behind * through[i % N] + own;
                }
            }
            add_to_channels(&job.plan, &shaded.pass, pixel, (self.parts, self.groups), channels);
        }
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
        parts: &mut Vec<Lanes<N>>,
    ) {
        let polygon = &self.projection.polygons[number as usize];
        let factor = if self.interpolation == Interpolation::Object { values[0].recip() } else { 1.0 };
        match self.technique {
            Technique::Constant => {
                let values = &shaded.values[number as usize * self.stride..][..self.stride];
                to.copy_from_slice(&values.as_flattened()[1..=to.len()]);
            }
            Technique::Gouraud => {
                for (slot, value) in to.iter_mut().zip(&values[1..]) {
                    *slot = value * factor;
                }
            }
            _ => {
                let vector = |i: usize| Vec3::new(values[i], values[i + 1], values[i + 2]) * factor;
                let face = &self.surfaces.faces[polygon.face as usize];
                let place = self.place(polygon, vector(4), vector(1).normalize_or(face.normal));
                let through = lighting.shade(&place, parts);
                store(to, parts, &through, self.parts);
            }
        }
    }
}
