//! Antialiasing by area coverage (the A-buffer; Carpenter 1984).
//!
//! Each sample of a pixel looks at 32 places what is visible there; places that see the same polygons, one behind the other, are a
//! fragment, and their number is the area that it covers. A fragment is shaded once, at the mean of its places: that lies inside its
//! polygons, for they are convex, and gives the mean radiance of the fragment where that is linear over it. So the same
//! places as for 32 samples, but one evaluation of the model instead of 32 where a pixel sees one polygon.

use super::edges::{Quad, Span, grown};
use super::row::{Band, NOBODY, Sampled, Stack};
use super::{Scanline, ShadedPass};
use crate::film::TileFilm;
use crate::passes::{Job, auxiliary_layers};
use crate::settings::{Interpolation, Technique};
use illuminant_illumination::{IlluminationModel, Prepare};
use std::ops::Range;

/// How many places make a sample: as many as the A-buffer's mask has bits.
pub(super) const PLACES: u64 = 32;

const NONE: u32 = u32::MAX;

/// Places of a pixel that see the same polygons.
#[derive(Clone, Copy, Debug)]
struct Fragment {
    /// The next fragment of the pixel.
    next: u32,
    /// Where its polygons begin in [`Fragments::polygons`], and how many they are, farthest first.
    first: u32,
    count: u32,
    places: u32,
    /// What they count together.
    weight: f32,
    /// The sum of the places, from the middle of the pixel.
    offset: [f32; 2],
}

impl Fragment {
    fn range(&self) -> Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }
}

/// The fragments of a band.
#[derive(Debug, Default)]
struct Fragments {
    /// The first fragment of each pixel.
    heads: Vec<u32>,
    all: Vec<Fragment>,
    polygons: Vec<u32>,
    /// For each polygon of a fragment the sum of its interpolated values.
    values: Vec<Quad>,
    quads: usize,
}

impl Fragments {
    /// The opaque polygon of a fragment or [`NOBODY`], then what is before it, farthest first.
    fn polygons_of(&self, fragment: &Fragment) -> &[u32] {
        &self.polygons[fragment.range()]
    }

    /// The sums of their values.
    fn values_of(&self, fragment: &Fragment) -> &[Quad] {
        let Range { start, end } = fragment.range();
        &self.values[start * self.quads..end * self.quads]
    }

    /// Adds a place where polygons are seen with these values.
    fn add(&mut self, pixel: usize, polygons: &[u32], values: &[Quad], offset: [f32; 2], weight: f32) {
        let mut number = self.heads[pixel];
        while number != NONE {
            let fragment = &mut self.all[number as usize];
            let place = fragment.range();
            if self.polygons[place.clone()] == *polygons {
                fragment.places += 1;
                fragment.weight += weight;
                fragment.offset[0] += offset[0];
                fragment.offset[1] += offset[1];
                let sums = &mut self.values[place.start * self.quads..place.end * self.quads];
                sums.iter_mut().zip(values).for_each(|(sum, v)| *sum = grown(*sum, *v, 1.0));
                return;
            }
            number = fragment.next;
        }
        let first = self.polygons.len() as u32;
        self.polygons.extend_from_slice(polygons);
        self.values.extend_from_slice(values);
        let (next, count) = (self.heads[pixel], polygons.len() as u32);
        self.heads[pixel] = self.all.len() as u32;
        self.all.push(Fragment { next, first, count, places: 1, weight, offset });
    }
}

/// A fragment of a pixel, and where it is.
struct Seen<'a> {
    sample: u64,
    at: Sampled,
    column: usize,
    y: i32,
    /// The opaque polygon or [`NOBODY`], then what is before it.
    polygons: &'a [u32],
}

impl<const N: usize, M: IlluminationModel<N> + Prepare> Scanline<N, M> {
    /// One sample of every pixel of a band by coverage: number `index` of those that are scrambled as `stream` says. The result is
    /// in `channels`.
    pub(super) fn cover(
        &self,
        job: &Job,
        tile: &TileFilm,
        (sample, index, stream): (u64, u64, u64),
        band: &mut Band<N>,
        channels: &mut [f32],
    ) {
        let (area, width) = (tile.area, tile.width() as usize);
        // The same fragments for all passes; their values are other ones where lanes themselves are interpolated.
        let own_values = self.technique == Technique::Gouraud && self.channels.is_none();
        let passes: Vec<&[ShadedPass<N, M>]> =
            self.passes.chunks(if own_values { 1 } else { self.passes.len().max(1) }).collect();
        let collect =
            |passes: &&[ShadedPass<N, M>]| self.fragments(job, area, &passes[0], (index, stream), band);
        let found: Vec<Fragments> = passes.iter().map(collect).collect();
        let Some(first) = found.first() else { return };
        let (mut one, mut values) = (vec![0.0; job.channels], Vec::new());
        for (pixel, to) in channels.chunks_exact_mut(job.channels).enumerate() {
            let mut number = first.heads[pixel];
            while number != NONE {
                let fragment = &first.all[number as usize];
                let share = 1.0 / fragment.places as f32;
                let seen = Seen {
                    sample,
                    at: Sampled { area, offset: fragment.offset.map(|v| v * share) },
                    column: pixel % width,
                    y: (pixel / width) as i32 + area[1] as i32,
                    polygons: first.polygons_of(fragment),
                };
                one.fill(0.0);
                for (found, passes) in found.iter().zip(&passes) {
                    values.clear();
                    values.extend(found.values_of(fragment).iter().map(|sum| sum.map(|v| v * share)));
                    self.expose_fragment(job, passes, &seen, &values, band, &mut one);
                }
                self.tell_of_fragment(job, &seen, &values, &mut one);
                let weight = fragment.weight / PLACES as f32;
                to.iter_mut().zip(&one).for_each(|(sum, v)| *sum += v * weight);
                number = fragment.next;
            }
        }
    }

    /// The fragments of a band.
    fn fragments(
        &self,
        job: &Job,
        area: [u32; 4],
        pass: &ShadedPass<N, M>,
        (index, stream): (u64, u64),
        band: &mut Band<N>,
    ) -> Fragments {
        let [width, height] = [area[2] - area[0], area[3] - area[1]].map(|v| v as usize);
        let mut found = Fragments { quads: self.quads, ..Fragments::default() };
        found.heads = vec![NONE; width * height];
        let (mut polygons, mut values): (Vec<u32>, Vec<Quad>) = (Vec::new(), Vec::new());
        for place in 0..PLACES {
            let [u, v, ..] =
                job.numbers.sequence(job.settings.seed, 0, index * PLACES + place, stream).next4();
            let at = Sampled { area, offset: [job.filter.offset(u), job.filter.offset(v)] };
            let weight = job.filter.weight(at.offset);
            let mut row = |band: &mut Band<N>, y: i32| {
                let first = (y as u32 - area[1]) as usize * width;
                let mut veils = band.veils.iter().peekable();
                for column in 0..width {
                    polygons.clear();
                    values.clear();
                    let mut next = Some(band.owner[column]);
                    while let Some(number) = next {
                        if number == NOBODY {
                            polygons.push(NOBODY);
                            values.resize(self.quads, [0.0; 4]);
                        } else {
                            let span = &band.table.spans[number as usize];
                            let (start, growth) = band.table.of_span(number as usize);
                            let skipped = (area[0] as i32 + column as i32 - span.start) as f32;
                            polygons.push(span.polygon);
                            values.extend(start.iter().zip(growth).map(|(v, g)| grown(*v, *g, skipped)));
                        }
                        next = veils.next_if(|veil| veil.column == column).map(|veil| veil.span);
                    }
                    found.add(first + column, &polygons, &values, at.offset, weight);
                }
            };
            self.scan(job, pass, &at, band, &mut row);
        }
        found
    }

    /// The radiance of a fragment in these passes.
    fn expose_fragment(
        &self,
        job: &Job,
        passes: &[ShadedPass<N, M>],
        seen: &Seen,
        values: &[Quad],
        band: &mut Band<N>,
        to: &mut [f32],
    ) {
        let (opaque, before) = (seen.polygons[0], &seen.polygons[1..]);
        if opaque == NOBODY && before.is_empty() && job.scene.surroundings.is_empty() {
            return;
        }
        if let (Some(channels), true) = (&self.channels, opaque != NOBODY) {
            let values = match self.technique {
                Technique::Constant => channels.of_polygon(opaque, self.stride),
                _ => values.as_flattened(),
            };
            let divided = self.technique == Technique::Gouraud && self.interpolation == Interpolation::Object;
            channels.add(values, if divided { values[0].recip() } else { 1.0 }, to);
            return;
        }
        if let (Some(fast), true) = (&self.fast, opaque != NOBODY) {
            let [x, y] = [f64::from(seen.at.area[0]) + seen.column as f64, f64::from(seen.y)];
            let [right, down] = seen.at.offset.map(f64::from);
            let span = Span { polygon: opaque, start: 0, end: 1 };
            fast.expose(&span, [x + 0.5 + right, y + 0.5 + down], job.channels, to);
            return;
        }
        for shaded in passes {
            let mut stack = Stack::new(self, job, shaded, &mut band.scratch);
            let layers = seen.polygons.iter().zip(values.chunks_exact(self.quads));
            for (i, (&polygon, values)) in layers.enumerate() {
                match (i, polygon) {
                    (0, NOBODY) => {
                        stack.begin_with_background(|| seen.at.direction(job, seen.column, seen.y))
                    }
                    (0, _) => stack.begin(polygon, values.as_flattened()),
                    _ => stack.cover(polygon, values.as_flattened()),
                }
            }
            stack.add_to(to);
        }
    }

    /// Puts the haze before a fragment, and fills the layers that tell of what is seen first.
    fn tell_of_fragment(&self, job: &Job, seen: &Seen, values: &[Quad], to: &mut [f32]) {
        if !self.sees && job.settings.replicates < 2 {
            return;
        }
        let last = seen.polygons.len() - 1;
        let polygon = seen.polygons[last];
        let nearest = (polygon != NOBODY).then(|| (polygon, values[last * self.quads][0]));
        let background = seen.polygons[0] == NOBODY && !job.scene.surroundings.is_empty();
        let first = self.primary(job, nearest, seen.at.direction(job, seen.column, seen.y), background);
        if let Some(haze) = &job.haze {
            haze.apply(&first, to);
        }
        auxiliary_layers(job, &first, seen.sample, to);
    }
}
