//! A band of scanlines: what is visible in each, and its radiance.

use super::ahead::{ShadedPass, add_to_channels, store};
use super::edges::{Corner, EdgeTable, Quad, grown};
use super::lighting::Lighting;
use super::projection::Polygon;
use super::{BAND, OF_TEXTURE, Scanline, side};
use crate::passes::Job;
use crate::path::Primary;
use crate::settings::{Interpolation, Technique};
use glam::{Vec2, Vec3, Vec4};
use illuminant_illumination::{IlluminationModel, Prepare};
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
    pub(super) fn direction(&self, job: &Job, column: usize, y: i32) -> Vec3 {
        let x = (self.area[0] as usize + column) as f32 + 0.5 + self.offset[0];
        job.scene.camera.ray(x, y as f32 + 0.5 + self.offset[1], 0.0).direction
    }
}

/// The buffers of one band of scanlines.
pub(super) struct Band<const N: usize> {
    pub(super) table: EdgeTable,
    /// The polygons that begin at each row.
    entering: Vec<Vec<u32>>,
    /// For each pixel of the scanline the largest 1/W, and the span that has it.
    nearest: Vec<f32>,
    pub(super) owner: Vec<u32>,
    /// What lies before that, column by column, farthest first.
    pub(super) veils: Vec<Veil>,
    values: Vec<Quad>,
    pub(super) scratch: Scratch<N>,
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
            values: Vec::new(),
            scratch: Scratch::default(),
            spans: 0,
        }
    }
}

/// The buffers of what is seen at one place.
#[derive(Default)]
pub(super) struct Scratch<const N: usize> {
    /// The parts of the radiance of a pixel; the same of a veil, with what is seen through it.
    pixel: Vec<f32>,
    veil: Vec<f32>,
    parts: Vec<Lanes<N>>,
}

/// What is seen at one place in one pass: an opaque surface or the surroundings, and what lies before it, farthest first.
pub(super) struct Stack<'a, const N: usize, M> {
    scanline: &'a Scanline<N, M>,
    job: &'a Job,
    shaded: &'a ShadedPass<N, M>,
    lighting: Lighting<'a, N, M>,
    scratch: &'a mut Scratch<N>,
}

impl<'a, const N: usize, M: IlluminationModel<N> + Prepare> Stack<'a, N, M> {
    pub fn new(
        scanline: &'a Scanline<N, M>,
        job: &'a Job,
        shaded: &'a ShadedPass<N, M>,
        scratch: &'a mut Scratch<N>,
    ) -> Self {
        let lighting = scanline.lighting(&job.scene, &shaded.pass, &shaded.ambient);
        let count = N * scanline.parts * scanline.groups;
        scratch.pixel.resize(count, 0.0);
        scratch.veil.resize(count + N, 0.0);
        Self { scanline, job, shaded, lighting, scratch }
    }

    /// Begins with the surroundings in a direction.
    pub fn begin_with_background(&mut self, direction: impl FnOnce() -> Vec3) {
        let Scratch { pixel, parts, .. } = &mut *self.scratch;
        pixel.fill(0.0);
        if !self.job.scene.surroundings.is_empty() {
            let groups = self.scanline.groups;
            parts.clear();
            parts.resize(groups, Lanes::default());
            self.lighting.add_background(direction(), parts);
            let own = pixel.len() - N * groups;
            let slots = pixel[own..].chunks_exact_mut(N);
            slots.zip(parts.iter()).for_each(|(slot, light)| slot.copy_from_slice(&light.0));
        }
    }

    /// Begins with a polygon, from its interpolated values.
    #[inline]
    pub fn begin(&mut self, polygon: u32, values: &[f32]) {
        let Scratch { pixel, parts, .. } = &mut *self.scratch;
        self.scanline.resolve(&self.lighting, self.shaded, polygon, values, pixel, parts);
    }

    /// Puts a transparent polygon before it.
    pub fn cover(&mut self, polygon: u32, values: &[f32]) {
        let Scratch { pixel, veil, parts } = &mut *self.scratch;
        self.scanline.resolve(&self.lighting, self.shaded, polygon, values, veil, parts);
        let (own, through) = veil.split_at(pixel.len());
        for (i, (behind, own)) in pixel.iter_mut().zip(own).enumerate() {
            *behind = *behind * through[i % N] + own;
        }
    }

    /// Adds all of it to the channels of a pixel.
    pub fn add_to(&self, channels: &mut [f32]) {
        let size = (self.scanline.parts, self.scanline.groups);
        add_to_channels(&self.job.plan, &self.shaded.pass, &self.scratch.pixel, size, channels);
    }
}

/// A pixel of a transparent span.
#[derive(Clone, Copy)]
pub(super) struct Veil {
    pub column: usize,
    /// 1/W.
    q: f32,
    polygon: u32,
    pub span: u32,
}

pub(super) const NOBODY: u32 = u32::MAX;

/// The film of one sample of a band.
pub(super) struct Exposed<'a> {
    /// The channels of each pixel.
    pub channels: &'a mut [f32],
    /// What is seen first, if it is asked for.
    pub seen: &'a mut [Primary],
}

impl<const N: usize, M: IlluminationModel<N> + Prepare> Scanline<N, M> {
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
    pub(super) fn expose(
        &self,
        job: &Job,
        passes: &[ShadedPass<N, M>],
        at: &Sampled,
        band: &mut Band<N>,
        exposed: &mut Exposed<'_>,
    ) {
        let mut row = |band: &mut Band<N>, y| self.expose_row(job, passes, at, y, band, exposed);
        self.scan(job, &passes[0], at, band, &mut row);
    }

    /// Finds what is visible in each row of a band.
    pub(super) fn scan(
        &self,
        job: &Job,
        pass: &ShadedPass<N, M>,
        at: &Sampled,
        band: &mut Band<N>,
        each_row: &mut impl FnMut(&mut Band<N>, i32),
    ) {
        let area = at.area;
        let ahead = self.ahead_of_spans(pass);
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
            each_row(band, y);
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
                    let spans = &band.table.spans;
                    let polygon = (nearest.0 != NOBODY).then(|| spans[nearest.0 as usize].polygon);
                    let nearest = polygon.map(|polygon| (polygon, nearest.1));
                    exposed.seen[first + column] = self.primary(job, nearest, direction, background);
                }
            }
            while band.veils.get(veil).is_some_and(|v| v.column < run.end) {
                veil += 1;
            }
            column = run.end;
        }
    }

    /// What is seen first at a sample: a polygon at 1/W, if it is one.
    pub(super) fn primary(
        &self,
        job: &Job,
        nearest: Option<(u32, f32)>,
        direction: Vec3,
        background: bool,
    ) -> Primary {
        let Some((polygon, q)) = nearest else { return Primary { surface: None, emits: background } };
        let face = &self.surfaces.faces[self.projection.polygons[polygon as usize].face as usize];
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
            for pixel in pixels {
                channels.add(channels.of_polygon(span.polygon, self.stride), 1.0, pixel);
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
        let Band { table, veils, values, scratch, .. } = band;
        let mut stack = Stack::new(self, job, shaded, scratch);
        let place = |number: u32, column: usize| {
            let span = table.spans[number as usize];
            (span.polygon, (at.area[0] as i32 + column as i32 - span.start) as f32)
        };
        for (i, channels) in to.chunks_exact_mut(job.channels).enumerate() {
            let column = first + i;
            if owner == NOBODY {
                stack.begin_with_background(|| at.direction(job, column, y));
            } else {
                let (start, growth) = table.of_span(owner as usize);
                let (polygon, skipped) = place(owner, column);
                if i == 0 {
                    values.clear();
                    values.extend(start.iter().zip(growth).map(|(v, growth)| grown(*v, *growth, skipped)));
                } else {
                    values.iter_mut().zip(growth).for_each(|(v, growth)| *v = grown(*v, *growth, 1.0));
                }
                stack.begin(polygon, values.as_flattened());
            }
            while let Some(v) = veils.get(*veil).filter(|v| v.column == column) {
                *veil += 1;
                let (start, growth) = table.of_span(v.span as usize);
                let (polygon, skipped) = place(v.span, column);
                let at: Vec<Quad> = start.iter().zip(growth).map(|(v, g)| grown(*v, *g, skipped)).collect();
                stack.cover(polygon, at.as_flattened());
            }
            stack.add_to(channels);
        }
    }

    fn is_coloured(&self, polygon: &Polygon) -> bool {
        self.anything_coloured && self.coloured[self.surfaces.faces[polygon.face as usize].object as usize]
    }

    /// What lies between the values of a white surface and those of a black one, behind the first of `values`, where an image says
    /// the colour; `texture` is where it is looked up, and where that lies in the world.
    fn tint(
        &self,
        lighting: &Lighting<'_, N, M>,
        polygon: &Polygon,
        values: &[f32],
        texture: [f32; OF_TEXTURE],
        to: &mut [f32],
    ) {
        let [u, v, x, y, z] = texture;
        let normal = self.surfaces.faces[polygon.face as usize].normal;
        let place = self.place(polygon, Vec3::new(x, y, z), normal, Vec2::new(u, v));
        let share = lighting.share_of_white(&place);
        let white = &values[1..];
        let black = &white[N * (self.parts * self.groups + 1)..];
        for (i, slot) in to.iter_mut().enumerate() {
            *slot = black[i] + share.0[i % N] * (white[i] - black[i]);
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
                let ahead = shaded.values[number as usize * self.stride..][..self.stride].as_flattened();
                match values {
                    [_, u, v, _, x, y, z, _] if self.is_coloured(polygon) => {
                        let texture = [*u, *v, *x, *y, *z].map(|v| v * factor);
                        self.tint(lighting, polygon, ahead, texture, to);
                    }
                    _ => to.copy_from_slice(&ahead[1..=to.len()]),
                }
            }
            Technique::Gouraud if self.is_coloured(polygon) => {
                let size = N * (self.parts * self.groups + 1);
                let texture = std::array::from_fn(|i| values[1 + 2 * size + i] * factor);
                self.tint(lighting, polygon, values, texture, to);
                to.iter_mut().for_each(|v| *v *= factor);
            }
            Technique::Gouraud => {
                for (slot, value) in to.iter_mut().zip(&values[1..]) {
                    *slot = value * factor;
                }
            }
            _ => {
                let vector = |i: usize| Vec3::new(values[i], values[i + 1], values[i + 2]) * factor;
                let face = &self.surfaces.faces[polygon.face as usize];
                let uv =
                    if let [.., u, v, _, _] = values[8..] { Vec2::new(u, v) * factor } else { Vec2::ZERO };
                let place = self.place(polygon, vector(4), vector(1).normalize_or(face.normal), uv);
                let through = lighting.shade(&place, parts);
                store(to, parts, &through, self.parts);
            }
        }
    }
}
