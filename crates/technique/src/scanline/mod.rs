//! Scanline rendering with incremental shading (Bouknight 1970, Gouraud 1971, Phong 1975; book 4.2).
//!
//! Triangles are transformed to the screen ([`projection`]); the model is evaluated ahead where the technique allows it ([`ahead`]); an
//! edge table gives the spans of each scanline ([`edges`]); the nearest of them are found pixel by pixel, which leaves visible runs; and
//! along each run colours or normals are updated by increments ([`row`], [`fast_phong`]). Transparent surfaces lie before the nearest opaque one in the
//! order of their depth (Newell, Newell and Sancha 1972).

mod ahead;
mod coverage;
pub mod edges;
mod fast_phong;
mod lighting;
mod projection;
mod row;
mod shadow_map;
mod shadows;
mod subdivision;
mod surfaces;

use crate::film::{Film, TOO_LARGE, TileFilm};
use crate::lanes::Pass;
use crate::passes::{Job, TileCounts, TileRenderer, auxiliary_layers};
use crate::path::Primary;
use crate::settings::{Antialiasing, Interpolation, Layer, Settings, Shading, Technique};
use ahead::{Channels, ShadedPass, channels_of_lanes};
use edges::Quad;
use fast_phong::FastPhong;
use glam::Vec3;
use illuminant_illumination::{Atmosphere, IlluminationModel, Prepare};
use illuminant_scene::{Camera, Scene};
use lighting::{Lamps, PARTS};
use projection::{Polygon, Projection};
use row::{Band, Exposed, Sampled};
use shadows::Occlusion;
use std::ops::Range;
use surfaces::Surfaces;

/// Rows of a band of scanlines, which one thread takes at a time.
pub(crate) const BAND: u32 = 16;

/// The values by which an image is looked up where a colour is interpolated: texture coordinates and position.
const OF_TEXTURE: usize = 5;

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
    anything_transparent: bool,
    /// For each object whether images say something of it, and whether they say its colour.
    textured: Vec<bool>,
    coloured: Vec<bool>,
    /// Whether any image says a colour, which is then looked up for every pixel.
    anything_coloured: bool,
    /// The angle across a pixel.
    pixel_angle: f32,
    passes: Vec<ShadedPass<N, M>>,
    /// What was shaded ahead as channels of the film, where that gives the same.
    channels: Option<Channels>,
    /// One of the fast forms of Phong's shading, if it is asked for ([`fast_phong`]).
    fast: Option<FastPhong>,
    /// What corners give to spans where nothing was shaded at them.
    corners: Vec<Quad>,
    /// How many fours of values a corner gives to spans, and how many what was shaded ahead takes.
    quads: usize,
    stride: usize,
    /// The parts of radiance that are kept: all where they are wanted by themselves, else their sum.
    parts: usize,
    /// The group of each lamp, and how many groups there are.
    group_of: Vec<usize>,
    groups: usize,
    lamps: Lamps,
    shadows: Occlusion,
    /// The direction to the eye, if it is at infinity for the model.
    distant_eye: Option<Vec3>,
    coverage: bool,
    /// Whether anything is to be told of what is seen first.
    sees: bool,
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
        let mut surfaces = Surfaces::gather(scene, scene.camera.shutter[0]);
        let shadows = Occlusion::new(scene, &surfaces, settings.shadows);
        if let Some(area) = settings.subdivide {
            surfaces.subdivide(scene, &scene.camera, settings.filter.radius(), area);
        }
        let projection = Projection::new(&surfaces, &scene.camera);
        let seen_through = |object: &illuminant_scene::Object| {
            use illuminant_illumination::Surface;
            let surface = &scene.materials[object.material].surface;
            matches!(surface, Surface::Filter { .. } | Surface::Dielectric { .. })
        };
        let transparent: Vec<bool> = scene.objects.iter().map(seen_through).collect();
        let anything_transparent = transparent.contains(&true);
        let parts = if settings.layers.contains(&Layer::Terms) { PARTS } else { 1 };
        let groups = group_of.iter().max().map_or(0, |last| last + 1);
        let (plan, _) = Film::plan(settings, &[], passes.first().map_or(0, |pass| pass.total));
        let skin = |object: &illuminant_scene::Object| &scene.skins[object.material];
        let textured: Vec<bool> = scene.objects.iter().map(|object| !skin(object).is_bare()).collect();
        let coloured: Vec<bool> = scene.objects.iter().map(|object| skin(object).colour.is_some()).collect();
        let anything_coloured = coloured.contains(&true);
        let mut channels = (technique != Technique::Phong && !anything_transparent && !anything_coloured)
            .then(|| Channels { of_film: channels_of_lanes(&plan), values: Vec::new() });
        // 1/W goes before them, and behind lanes what is seen through.
        let lanes = N * (parts * groups + 1);
        let lanes = if anything_coloured { 2 * lanes + OF_TEXTURE } else { lanes };
        let stride = (1 + channels.as_ref().map_or(lanes, |c| c.of_film.len())).div_ceil(4);
        let quads = match technique {
            Technique::Constant if anything_coloured => 2,
            Technique::Constant => 1,
            Technique::Gouraud => stride,
            Technique::Phong if settings.shading != Shading::Full => 1,
            _ if textured.contains(&true) => 3,
            _ => 2,
        };
        let emits = !scene.surroundings.is_empty() || scene.objects.iter().any(|o| o.lamp.is_some());
        let hazy = scene.atmosphere.0 != Atmosphere::Clear;
        let sees = hazy
            || settings.layers.iter().any(|layer| match layer {
                Layer::Depth | Layer::Normal | Layer::Albedo => true,
                Layer::Emission => emits,
                _ => false,
            });
        let mut all = Self {
            technique,
            interpolation: settings.interpolation,
            bands: bands(&projection, &scene.camera, settings.filter.radius()),
            transparent,
            anything_transparent,
            textured,
            coloured,
            anything_coloured,
            pixel_angle: scene.camera.pixel_angle(),
            parts,
            group_of: group_of.to_vec(),
            groups,
            lamps: Lamps::new(scene, settings.infinite.lights),
            shadows,
            distant_eye: settings.infinite.eye.then(|| -scene.camera.forward()),
            coverage: settings.antialiasing == Antialiasing::Coverage,
            surfaces,
            projection,
            passes: Vec::new(),
            channels: None,
            fast: None,
            corners: Vec::new(),
            quads,
            stride,
            sees,
        };
        let ambient = settings.ambient as f32;
        all.passes = passes
            .into_iter()
            .map(|pass| all.shade_ahead(scene, &plan, pass, ambient, channels.as_mut()))
            .collect();
        all.channels = channels;
        if technique == Technique::Phong && settings.shading != Shading::Full {
            all.fast = Some(FastPhong::new(&all, scene, &plan, channels_of_lanes(&plan), settings.shading));
        }
        all.corners = all.corner_values();
        all
    }

    /// The values that corners give to spans, corner by corner.
    fn ahead_of_spans<'a>(&'a self, pass: &'a ShadedPass<N, M>) -> &'a [Quad] {
        match (self.technique, &self.channels) {
            (Technique::Gouraud, Some(channels)) => &channels.values,
            (Technique::Gouraud, None) => &pass.values,
            _ => &self.corners,
        }
    }
}

impl<const N: usize, M: IlluminationModel<N> + Prepare> Scanline<N, M> {
    /// One sample of every pixel of a band, number `index` of those that are scrambled as `stream` says. All pixels are sampled at the
    /// same place, so that edges move by whole images; this place is returned.
    fn expose_sample(
        &self,
        job: &Job,
        area: [u32; 4],
        (index, stream): (u64, u64),
        band: &mut Band<N>,
        channels: &mut [f32],
        seen: &mut [Primary],
    ) -> [f32; 2] {
        let at = Sampled { area, offset: job.shared_offset(index, stream) };
        // Channels hold all passes.
        let at_once = if self.channels.is_some() || self.fast.is_some() { self.passes.len() } else { 1 };
        for passes in self.passes.chunks(at_once.max(1)) {
            self.expose(job, passes, &at, band, &mut Exposed { channels, seen });
        }
        at.offset
    }
}

impl<const N: usize, M: IlluminationModel<N> + Prepare> TileRenderer for Scanline<N, M> {
    fn tile(&self, job: &Job, tile: &mut TileFilm, samples: Range<u64>) -> TileCounts {
        let mut result = TileCounts::default();
        let mut band = Band::new(self.quads);
        let pixels = tile.samples.len();
        let mut channels = vec![0.0f32; pixels * job.channels];
        let mut seen = vec![Primary::default(); if self.sees { pixels } else { 0 }];
        let nothing = Primary::default();
        let replicates = u64::from(job.settings.replicates.max(1));
        for sample in tile.claim(samples).into_iter().flatten() {
            channels.fill(0.0);
            let (index, stream) = (sample / replicates, sample % replicates);
            let weight = if self.coverage {
                self.cover(job, tile, (sample, index, stream), &mut band, &mut channels);
                1.0
            } else {
                let place = (index, stream);
                job.filter.weight(self.expose_sample(
                    job,
                    tile.area,
                    place,
                    &mut band,
                    &mut channels,
                    &mut seen,
                ))
            };
            // All at once, which takes no branch.
            let tells = (self.sees || replicates > 1) && !self.coverage;
            let sound = !tells && channels.iter().fold(true, |sound, v| sound & (v.abs() < TOO_LARGE));
            for (i, values) in channels.chunks_exact_mut(job.channels).enumerate() {
                if tells {
                    let seen = seen.get(i).unwrap_or(&nothing);
                    if let Some(haze) = &job.haze {
                        haze.apply(seen, values);
                    }
                    auxiliary_layers(job, seen, sample, values);
                }
                if weight != 1.0 {
                    values.iter_mut().for_each(|v| *v *= weight);
                }
                if sound || values.iter().all(|v| v.abs() < TOO_LARGE) {
                    tile.add(i, values);
                } else {
                    let x = tile.area[0] + i as u32 % tile.width();
                    let y = tile.area[1] + i as u32 / tile.width();
                    result.dropped.push(([x, y], sample));
                }
            }
            result.samples += pixels as u64;
        }
        result.spans = band.spans;
        result
    }
}
