//! Images wrapped over surfaces, looked up with a filter (Catmull 1974, Blinn and Newell 1976; book 4.2.6).
//!
//! A texture holds numbers and knows nothing of what they mean: [`crate::skin`] does. A lookup takes the mean over the part of the
//! image that is seen, an ellipse in texture coordinates: from a pyramid of ever smaller images (Williams 1983), between two of
//! which and between whose texels it is linear, at several places along the longer axis (as Feline does, McCormack et al. 1999).

use crate::summed_area::SummedArea;
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// The most places of one lookup.
const MOST_PROBES: f32 = 16.0;

/// What lies beyond the unit square.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Wrap {
    /// The image again.
    #[default]
    Repeat,
    /// Its border.
    Clamp,
    /// Its mirror image.
    Mirror,
}

/// How a lookup finds the mean of what it sees.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Filtering {
    /// In a pyramid of ever smaller images, at places along the ellipse.
    #[default]
    Pyramid,
    /// Over the box about the ellipse, from a summed-area table (Crow 1984).
    SummedArea,
}

/// The part of a texture that one lookup sees: the half axes of an ellipse in texture coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Footprint {
    /// The axes, in any order.
    pub axes: [Vec2; 2],
}

/// One image of the pyramid.
#[derive(Clone, Debug)]
struct Level {
    width: usize,
    height: usize,
    /// Rows from the top.
    texels: Vec<[f32; 3]>,
}

/// An image of three channels over the unit square: u to the right, v up, both from the lower left corner.
#[derive(Clone, Debug)]
pub struct Texture {
    levels: Vec<Level>,
    /// Sums over boxes, where they are wanted instead of the pyramid.
    sums: Option<SummedArea>,
    wrap: Wrap,
    /// How often the image stands along each axis of the unit square, and where its lower left corner lies.
    repeat: Vec2,
    offset: Vec2,
}

/// Half the size, so that the mean stays: each texel takes what it covers of those before it.
fn halved(
    values: &[[f32; 3]],
    size: usize,
    line: impl Fn(usize, usize) -> usize,
    lines: usize,
) -> Vec<[f32; 3]> {
    let half = (size / 2).max(1);
    let ratio = size as f64 / half as f64;
    let mut out = Vec::with_capacity(half * lines);
    for l in 0..lines {
        for i in 0..half {
            let (low, high) = (i as f64 * ratio, (i + 1) as f64 * ratio);
            let mut sum = [0.0f64; 3];
            for k in (low as usize)..(high.ceil() as usize).min(size) {
                let covered = (high.min(k as f64 + 1.0) - low.max(k as f64)).max(0.0);
                let texel = values[line(l, k)];
                sum.iter_mut().zip(texel).for_each(|(sum, v)| *sum += covered * f64::from(v));
            }
            out.push(sum.map(|v| (v / ratio) as f32));
        }
    }
    out
}

impl Level {
    fn smaller(&self) -> Self {
        let (w, h) = (self.width, self.height);
        let narrow = halved(&self.texels, w, |row, k| row * w + k, h);
        let half = (w / 2).max(1);
        // The columns of the narrow image, one after the other.
        let columns = halved(&narrow, h, |column, k| k * half + column, half);
        let height = (h / 2).max(1);
        let texels = (0..half * height).map(|i| columns[(i % half) * height + i / half]).collect();
        Self { width: half, height, texels }
    }

    /// Linear between the centres of texels.
    fn bilinear(&self, uv: Vec2, wrap: Wrap) -> [f32; 3] {
        let x = uv.x * self.width as f32 - 0.5;
        let y = (1.0 - uv.y) * self.height as f32 - 0.5;
        let (x0, y0) = (x.floor(), y.floor());
        let (fx, fy) = (x - x0, y - y0);
        let [xs, ys] =
            [(x0, self.width), (y0, self.height)].map(|(i, n)| [i, i + 1.0].map(|i| wrapped(i, n, wrap)));
        let mut sum = [0.0; 3];
        for (row, wy) in ys.into_iter().zip([1.0 - fy, fy]) {
            for (column, wx) in xs.into_iter().zip([1.0 - fx, fx]) {
                let texel = &self.texels[row * self.width + column];
                for (sum, v) in sum.iter_mut().zip(texel) {
                    *sum += wx * wy * v;
                }
            }
        }
        sum
    }
}

/// The texel that stands for one with any number.
pub(crate) fn wrapped(i: f32, count: usize, wrap: Wrap) -> usize {
    let (i, n) = (i as i64, count as i64);
    (match wrap {
        Wrap::Repeat => i.rem_euclid(n),
        Wrap::Clamp => i.clamp(0, n - 1),
        Wrap::Mirror => {
            let j = i.rem_euclid(2 * n);
            j.min(2 * n - 1 - j)
        }
    }) as usize
}

impl Texture {
    /// A texture of an image in rows from the top.
    ///
    /// # Errors
    /// A sentence where the image has no pixels or a value is not finite.
    ///
    /// ```
    /// use glam::Vec2;
    /// use illuminant_scene::{Footprint, Texture, Wrap};
    /// let board: Vec<[f32; 3]> = (0..16).map(|i| [((i + i / 4) % 2) as f32; 3]).collect();
    /// let texture = Texture::new((4, 4), board, Wrap::Repeat, Vec2::ONE, Vec2::ZERO)?;
    /// // Near by a lookup sees the field on which it lies, far off the mean of all.
    /// let near = texture.lookup(Vec2::new(0.375, 0.875), &Footprint::default());
    /// let far = Footprint { axes: [Vec2::new(2.0, 0.0), Vec2::new(0.0, 2.0)] };
    /// assert_eq!((near[0], texture.lookup(Vec2::ZERO, &far)[0]), (1.0, 0.5));
    /// # Ok::<(), String>(())
    /// ```
    pub fn new(
        (width, height): (usize, usize),
        texels: Vec<[f32; 3]>,
        wrap: Wrap,
        repeat: Vec2,
        offset: Vec2,
    ) -> Result<Self, String> {
        if width == 0 || height == 0 || texels.len() != width * height {
            return Err(format!("the image of {width} × {height} pixels has no pixels"));
        }
        if let Some(i) = texels.iter().position(|p| !p.iter().all(|v| v.is_finite())) {
            return Err(format!("pixel ({}, {}) of the image is no finite number", i % width, i / width));
        }
        if !(repeat.is_finite() && offset.is_finite()) {
            return Err("repeat and offset of an image must be finite".into());
        }
        let mut levels = vec![Level { width, height, texels }];
        while let Some(last) = levels.last().filter(|l| l.width * l.height > 1) {
            levels.push(last.smaller());
        }
        Ok(Self { levels, sums: None, wrap, repeat, offset })
    }

    /// The same texture with another way to find means.
    #[must_use]
    pub fn filtered(mut self, filtering: Filtering) -> Self {
        let Level { width, height, texels } = &self.levels[0];
        self.sums = (filtering == Filtering::SummedArea)
            .then(|| SummedArea::new((*width, *height), texels, self.wrap));
        self
    }

    /// The mean of the image over a footprint about a point.
    #[must_use]
    pub fn lookup(&self, uv: Vec2, footprint: &Footprint) -> [f32; 3] {
        let size = Vec2::new(self.levels[0].width as f32, self.levels[0].height as f32);
        let place = uv * self.repeat - self.offset;
        // In texels of the largest image.
        let axes = footprint.axes.map(|axis| axis * self.repeat * size);
        if let Some(sums) = &self.sums {
            let middle = Vec2::new(place.x, 1.0 - place.y) * size;
            // A texel at least, as between the centres of texels.
            let half =
                Vec2::new(axes[0].x.hypot(axes[1].x), axes[0].y.hypot(axes[1].y)).max(Vec2::splat(0.5));
            return sums.mean(middle - half, middle + half);
        }
        let lengths = axes.map(|axis| axis.length());
        let longer = usize::from(lengths[1] > lengths[0]);
        let (major, minor) = (lengths[longer], lengths[1 - longer].max(lengths[longer] / MOST_PROBES));
        let probes = (major / minor.max(0.5)).ceil().clamp(1.0, MOST_PROBES);
        // A texel of level λ is 2^λ wide, and the ellipse twice its half axis.
        let level = (2.0 * minor.max(1e-6)).log2().clamp(0.0, (self.levels.len() - 1) as f32);
        let step = axes[longer] / size * (2.0 / probes);
        let mut sum = [0.0; 3];
        for i in 0..probes as u32 {
            let at = place + step * (i as f32 + 0.5 - probes * 0.5);
            let found = self.trilinear(at, level);
            sum.iter_mut().zip(found).for_each(|(sum, v)| *sum += v / probes);
        }
        sum
    }

    fn trilinear(&self, uv: Vec2, level: f32) -> [f32; 3] {
        // Whole turns do not count, and would cost digits.
        let period = if self.wrap == Wrap::Mirror { 2.0 } else { 1.0 };
        let uv = if self.wrap == Wrap::Clamp {
            uv.clamp(Vec2::splat(-1.0), Vec2::splat(2.0))
        } else {
            uv % period
        };
        let below = (level as usize).min(self.levels.len() - 1);
        let rest = level - below as f32;
        let near = self.levels[below].bilinear(uv, self.wrap);
        if rest == 0.0 {
            return near;
        }
        let far = self.levels[below + 1].bilinear(uv, self.wrap);
        std::array::from_fn(|c| near[c] + rest * (far[c] - near[c]))
    }

    /// The mean of the whole image.
    #[must_use]
    pub fn mean(&self) -> [f32; 3] {
        self.levels[self.levels.len() - 1].texels[0]
    }

    /// The smallest and the largest value of a channel.
    #[must_use]
    pub fn extent(&self, channel: usize) -> [f32; 2] {
        let values = self.levels[0].texels.iter().map(|p| p[channel]);
        values.fold([f32::MAX, f32::MIN], |[low, high], v| [low.min(v), high.max(v)])
    }
}

/// The slopes of a height field: ∂h/∂u and ∂h/∂v, per unit of the image's own width and height, in place of the heights
/// in the first channel (Blinn 1978). Slopes, unlike normals, have means that mean something.
#[must_use]
pub fn slopes_of_heights((width, height): (usize, usize), heights: &[[f32; 3]], wrap: Wrap) -> Vec<[f32; 3]> {
    let at = |x: i64, y: i64| {
        let (x, y) = (wrapped(x as f32, width, wrap), wrapped(y as f32, height, wrap));
        heights[y * width + x][0]
    };
    let slope = |i: usize| {
        let (x, y) = ((i % width) as i64, (i / width) as i64);
        let du = (at(x + 1, y) - at(x - 1, y)) * 0.5 * width as f32;
        // Rows run down, v up.
        let dv = (at(x, y - 1) - at(x, y + 1)) * 0.5 * height as f32;
        [du, dv, 0.0]
    };
    (0..width * height).map(slope).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(width: usize, height: usize) -> Vec<[f32; 3]> {
        (0..width * height).map(|i| [(i % width) as f32, (i / width) as f32, 1.0]).collect()
    }

    fn texture(width: usize, height: usize, wrap: Wrap) -> Texture {
        Texture::new((width, height), ramp(width, height), wrap, Vec2::ONE, Vec2::ZERO).unwrap()
    }

    #[test]
    fn every_level_has_the_mean_of_the_image() {
        for size in [(1, 1), (5, 3), (8, 8), (13, 1), (100, 37)] {
            let texture = texture(size.0, size.1, Wrap::Repeat);
            for level in &texture.levels {
                let count = level.texels.len() as f64;
                for c in 0..3 {
                    let sum = level.texels.iter().map(|p| f64::from(p[c])).sum::<f64>();
                    let mean = [(size.0 - 1) as f64 / 2.0, (size.1 - 1) as f64 / 2.0, 1.0][c];
                    assert!((sum / count - mean).abs() < 1e-4 * mean.max(1.0), "{size:?} {c}");
                }
            }
            assert_eq!(texture.mean()[2], 1.0);
        }
    }

    #[test]
    fn texels_are_met_at_their_centres_and_lines_between() {
        let texture = texture(8, 4, Wrap::Clamp);
        let point = Footprint::default();
        for x in 0..8 {
            let uv = Vec2::new((x as f32 + 0.5) / 8.0, 1.0 - 1.5 / 4.0);
            assert_eq!(texture.lookup(uv, &point), [x as f32, 1.0, 1.0]);
        }
        let between = texture.lookup(Vec2::new(0.5, 0.5), &point);
        assert!((between[0] - 3.5).abs() < 1e-5 && (between[1] - 1.5).abs() < 1e-5);
    }

    #[test]
    fn images_go_on_beyond_their_border() {
        let point = Footprint::default();
        let at = |wrap, u: f32| texture(8, 1, wrap).lookup(Vec2::new(u, 0.5), &point)[0];
        let centre = |x: f32| (x + 0.5) / 8.0;
        assert!((at(Wrap::Repeat, centre(10.0)) - 2.0).abs() < 1e-4);
        assert!((at(Wrap::Repeat, centre(-1.0)) - 7.0).abs() < 1e-4);
        assert!((at(Wrap::Clamp, centre(10.0)) - 7.0).abs() < 1e-4);
        assert!((at(Wrap::Mirror, centre(10.0)) - 5.0).abs() < 1e-4);
        assert!((at(Wrap::Mirror, centre(-2.0)) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn summed_areas_are_the_means_of_boxes() {
        let (pyramid, sums) =
            (texture(8, 4, Wrap::Repeat), texture(8, 4, Wrap::Repeat).filtered(Filtering::SummedArea));
        // At a centre the texel itself, between two their mean, over all the mean of all.
        let near = Vec2::new(2.5 / 8.0, 1.0 - 1.5 / 4.0);
        assert_eq!(sums.lookup(near, &Footprint::default()), [2.0, 1.0, 1.0]);
        let wide = Footprint { axes: [Vec2::X * 4.0, Vec2::Y * 4.0] };
        assert!((sums.lookup(near, &wide)[0] - 3.5).abs() < 1e-4);
        assert!((pyramid.lookup(near, &wide)[0] - 3.5).abs() < 1e-4);
    }

    #[test]
    fn a_long_footprint_stays_sharp_across() {
        // Stripes of one texel along v: seen along the stripes they stay, across them they fade.
        let stripes: Vec<[f32; 3]> = (0..64 * 64).map(|i| [(i % 64 / 4 % 2) as f32; 3]).collect();
        let texture = Texture::new((64, 64), stripes, Wrap::Repeat, Vec2::ONE, Vec2::ZERO).unwrap();
        let uv = Vec2::new(6.0 / 64.0, 0.5);
        let (short, long) = (0.5 / 64.0, 7.0 / 64.0);
        let along = Footprint { axes: [Vec2::new(short, 0.0), Vec2::new(0.0, long)] };
        let across = Footprint { axes: [Vec2::new(long, 0.0), Vec2::new(0.0, short)] };
        let [sharp, faded] = [along, across].map(|f| texture.lookup(uv, &f)[0]);
        assert!(sharp > 0.95 && (faded - 0.5).abs() < 0.1, "{sharp} {faded}");
    }

    #[test]
    fn a_tilted_plane_has_one_slope() {
        let heights: Vec<[f32; 3]> = (0..12 * 6)
            .map(|i| [0.5 * (i % 12) as f32 / 12.0 - 0.25 * (i / 12) as f32 / 6.0, 0.0, 0.0])
            .collect();
        let slopes = slopes_of_heights((12, 6), &heights, Wrap::Clamp);
        let [du, dv, _] = slopes[2 * 12 + 5];
        assert!((du - 0.5).abs() < 1e-5 && (dv - 0.25).abs() < 1e-5, "{du} {dv}");
    }

    #[test]
    fn broken_images_are_refused() {
        let new = |size, texels| Texture::new(size, texels, Wrap::Repeat, Vec2::ONE, Vec2::ZERO).err();
        assert!(new((0, 3), vec![]).unwrap().contains("no pixels"));
        assert!(new((1, 2), vec![[0.0; 3], [f32::NAN; 3]]).unwrap().contains("(0, 1)"));
    }
}
