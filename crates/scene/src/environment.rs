//! Light from all around, as a latitude–longitude image.

use glam::{Mat3, Vec2, Vec3};
use illuminant_color::{RgbSystem, SigmoidTable, Upsampler};
use illuminant_sampling::Lanes;
use illuminant_spectrum::{Curve, SpectralRange};
use rayon::prelude::*;
use std::f32::consts::{PI, TAU};
use std::sync::{Arc, Mutex, PoisonError};

/// A texel as a spectrum: `scale` · s(λ; c₀, c₁, c₂) · white(λ).
#[derive(Clone, Copy, Debug, Default)]
struct Texel {
    scale: f32,
    c: [f32; 3],
}

/// The image at a smaller size.
#[derive(Clone, Debug)]
struct Blurred {
    width: usize,
    height: usize,
    texels: Vec<Texel>,
}

/// An image of the surroundings. The top row is the zenith; the middle column looks along −z in a y-up world, along +y
/// in a z-up one, and columns to its right towards +x.
#[derive(Debug)]
pub struct EnvironmentImage {
    width: usize,
    height: usize,
    texels: Vec<Texel>,
    /// The image at half the size, and so on to one row: for what is seen blurred.
    smaller: Vec<Blurred>,
    /// From world to a y-up frame whose −z is the middle of the image.
    to_image: Mat3,
    /// The spectrum of RGB (1, 1, 1), absolute radiance.
    white: Curve,
    /// Running sums over rows, and over the columns of each row.
    rows: Vec<f32>,
    columns: Vec<f32>,
    /// ∫ L dω of the luminance of RGB relative to white, sr.
    integral: f64,
    background_mean: f64,
}

/// An image of RGB at half the size: each pixel is the mean of those that it covers, weighted by their solid angles.
fn halved((width, height): (usize, usize), rgb: &[f32]) -> ((usize, usize), Vec<f32>) {
    let (w, h) = ((width / 2).max(1), (height / 2).max(1));
    let mut out = Vec::with_capacity(3 * w * h);
    for row in 0..h {
        for column in 0..w {
            let (mut sum, mut weights) = ([0.0f64; 3], 0.0);
            for y in row * height / h..(row + 1) * height / h {
                let weight = ((y as f64 + 0.5) / height as f64 * std::f64::consts::PI).sin();
                for x in column * width / w..(column + 1) * width / w {
                    let pixel = &rgb[3 * (y * width + x)..][..3];
                    sum.iter_mut().zip(pixel).for_each(|(sum, v)| *sum += weight * f64::from(*v));
                    weights += weight;
                }
            }
            out.extend(sum.map(|v| (v / weights) as f32));
        }
    }
    ((w, h), out)
}

impl EnvironmentImage {
    /// An image from linear RGB, `white` being the absolute radiance of (1, 1, 1). Negative and non-finite values are
    /// refused.
    ///
    /// # Errors
    /// A sentence that names the first bad pixel.
    pub fn new(
        (width, height): (usize, usize),
        rgb: &[f32],
        system: &RgbSystem,
        white: Curve,
        to_image: Mat3,
        range: SpectralRange,
    ) -> Result<Self, String> {
        if width == 0 || height == 0 || rgb.len() != 3 * width * height {
            return Err(format!("the environment image of {width} × {height} pixels has no pixels"));
        }
        if let Some(i) = rgb.iter().position(|v| !(v.is_finite() && *v >= 0.0)) {
            let (x, y) = (i / 3 % width, i / 3 / width);
            return Err(format!(
                "pixel ({x}, {y}) of the environment image is {}; it must be 0 or more",
                rgb[i]
            ));
        }
        let table = sigmoid_table(system, range);
        let texel = |p: &[f32]| {
            let rgb = [p[0], p[1], p[2]].map(f64::from);
            let largest = rgb.iter().copied().fold(0.0, f64::max);
            if largest == 0.0 {
                return Texel::default();
            }
            let scale = 2.0 * largest;
            let sigmoid = table.sigmoid(rgb.map(|v| v / scale));
            Texel { scale: scale as f32, c: sigmoid.coefficients.map(|c| c as f32) }
        };
        let texels: Vec<Texel> = rgb.par_chunks_exact(3).map(texel).collect();
        let mut smaller = Vec::new();
        let (mut size, mut colours) = ((width, height), rgb.to_vec());
        while size.1 > 1 {
            (size, colours) = halved(size, &colours);
            let texels = colours.par_chunks_exact(3).map(texel).collect();
            smaller.push(Blurred { width: size.0, height: size.1, texels });
        }
        let mut columns = vec![0.0f32; width * height];
        let mut rows = vec![0.0f32; height];
        let mut total = 0.0f64;
        let mut plain = 0.0f64;
        let luminance: Vec<f64> = rgb
            .par_chunks_exact(3)
            .map(|p| system.to_xyz([p[0], p[1], p[2]].map(f64::from))[1].max(0.0))
            .collect();
        // Radiance is bilinear between texels, so a texel's share of it reaches into its neighbours: the mean of the
        // bilinear function over a texel is this blur of the texels' values.
        let blurred = |x: usize, y: usize| {
            let mut sum = 0.0;
            for (row, wy) in [(y.saturating_sub(1), 0.125), (y, 0.75), ((y + 1).min(height - 1), 0.125)] {
                for (column, wx) in [((x + width - 1) % width, 0.125), (x, 0.75), ((x + 1) % width, 0.125)] {
                    sum += wx * wy * luminance[row * width + column];
                }
            }
            sum
        };
        for y in 0..height {
            let sin = ((y as f64 + 0.5) / height as f64 * std::f64::consts::PI).sin();
            let mut sum = 0.0f64;
            for x in 0..width {
                let luminance = blurred(x, y);
                sum += luminance;
                plain += luminance;
                columns[y * width + x] = sum as f32;
            }
            total += sum * sin;
            rows[y] = total as f32;
            for column in &mut columns[y * width..(y + 1) * width] {
                *column = if sum > 0.0 { *column / sum as f32 } else { 0.0 };
            }
        }
        let cell = std::f64::consts::PI / height as f64 * std::f64::consts::TAU / width as f64;
        for row in &mut rows {
            *row = if total > 0.0 { *row / total as f32 } else { 0.0 };
        }
        let background_mean = plain / (width * height) as f64;
        let integral = total * cell;
        Ok(Self { width, height, texels, smaller, to_image, white, rows, columns, integral, background_mean })
    }

    /// The absolute radiance of RGB (1, 1, 1).
    #[must_use]
    pub fn white(&self) -> &Curve {
        &self.white
    }

    /// ∫ Y dω of the image with Y = 1 for white, sr: what its importance is judged by.
    #[must_use]
    pub fn integral(&self) -> f64 {
        self.integral
    }

    /// The mean of Y over the pixels.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.background_mean
    }

    /// The point of the image, in [0, 1]², at which a direction looks.
    #[inline(always)]
    #[must_use]
    pub fn uv(&self, direction: Vec3) -> Vec2 {
        let d = self.to_image * direction;
        let u = 0.5 + d.x.atan2(-d.z) / TAU;
        Vec2::new(u, d.y.clamp(-1.0, 1.0).acos() / PI)
    }

    /// The direction at which a point of the image looks.
    #[inline(always)]
    #[must_use]
    pub fn direction(&self, uv: Vec2) -> Vec3 {
        let (sin_theta, cos_theta) = (uv.y * PI).sin_cos();
        let (sin_phi, cos_phi) = ((uv.x - 0.5) * TAU).sin_cos();
        self.to_image.transpose() * Vec3::new(sin_theta * sin_phi, cos_theta, -sin_theta * cos_phi)
    }

    /// The radiance at a point of the image, bilinear between texels: `t` is where each lane lies in the spectral range
    /// and `white` the white in each lane.
    #[inline]
    #[must_use]
    pub fn radiance<const N: usize>(&self, uv: Vec2, t: &Lanes<N>, white: &Lanes<N>) -> Lanes<N> {
        Self::bilinear((self.width, self.height), &self.texels, uv, t, white)
    }

    /// The mean radiance of a cone about a point of the image, of which `radius` is the half-angle in radians: between the two sizes of
    /// the image whose texels are as wide (book 4.1, reflection mapping with the roughness of the surface).
    #[must_use]
    pub fn radiance_of_cone<const N: usize>(
        &self,
        uv: Vec2,
        radius: f32,
        t: &Lanes<N>,
        white: &Lanes<N>,
    ) -> Lanes<N> {
        let level = (2.0 * radius * self.height as f32 / PI).max(1.0).log2().min(self.smaller.len() as f32);
        let of = |level: usize| match level.checked_sub(1).map(|i| &self.smaller[i]) {
            None => self.radiance(uv, t, white),
            Some(level) => Self::bilinear((level.width, level.height), &level.texels, uv, t, white),
        };
        let (below, rest) = (level as usize, level.fract());
        if rest == 0.0 {
            return of(below);
        }
        of(below) * (1.0 - rest) + of(below + 1) * rest
    }

    #[inline]
    fn bilinear<const N: usize>(
        (width, height): (usize, usize),
        texels: &[Texel],
        uv: Vec2,
        t: &Lanes<N>,
        white: &Lanes<N>,
    ) -> Lanes<N> {
        let x = uv.x * width as f32 - 0.5;
        let y = (uv.y * height as f32 - 0.5).clamp(0.0, (height - 1) as f32);
        let (x0, y0) = (x.floor(), y.floor());
        let (fx, fy) = (x - x0, y - y0);
        let column = |i: f32| (i as i64).rem_euclid(width as i64) as usize;
        let row = |i: f32| (i as usize).min(height - 1);
        let mut sum = Lanes::<N>::default();
        for (xi, wx) in [(x0, 1.0 - fx), (x0 + 1.0, fx)] {
            for (yi, wy) in [(y0, 1.0 - fy), (y0 + 1.0, fy)] {
                let texel = &texels[row(yi) * width + column(xi)];
                let weight = wx * wy * texel.scale;
                if weight > 0.0 {
                    let [c0, c1, c2] = texel.c;
                    let s = t.map(|t| {
                        let x = c0.mul_add(t, c1).mul_add(t, c2);
                        0.5f32.mul_add(x / (1.0 + x * x).sqrt(), 0.5)
                    });
                    sum += s * weight;
                }
            }
        }
        sum * *white
    }

    /// A point of the image drawn by luminance, from two numbers in [0, 1), and its density, 1/sr.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: [f32; 2]) -> Option<(Vec2, f32)> {
        let (y, ty) = pick(&self.rows, u[0])?;
        let (x, tx) = pick(&self.columns[y * self.width..(y + 1) * self.width], u[1])?;
        let uv = Vec2::new((x as f32 + tx) / self.width as f32, (y as f32 + ty) / self.height as f32);
        let pdf = self.pdf(uv);
        (pdf > 0.0).then_some((uv, pdf))
    }

    /// The density of [`Self::sample`], 1/sr.
    #[inline]
    #[must_use]
    pub fn pdf(&self, uv: Vec2) -> f32 {
        let x = ((uv.x * self.width as f32) as usize).min(self.width - 1);
        let y = ((uv.y * self.height as f32) as usize).min(self.height - 1);
        let step = |sums: &[f32], i: usize| sums[i] - if i == 0 { 0.0 } else { sums[i - 1] };
        let columns = &self.columns[y * self.width..(y + 1) * self.width];
        let probability = step(&self.rows, y) * step(columns, x);
        let sin = (uv.y * PI).sin();
        if sin <= 0.0 {
            return 0.0;
        }
        probability * (self.width * self.height) as f32 / (2.0 * PI * PI * sin)
    }
}

/// The table of an RGB system over a range, made once: it takes a second.
fn sigmoid_table(system: &RgbSystem, range: SpectralRange) -> Arc<SigmoidTable> {
    type Tables = Vec<(RgbSystem, SpectralRange, Arc<SigmoidTable>)>;
    static TABLES: Mutex<Tables> = Mutex::new(Vec::new());
    let mut tables = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((.., table)) = tables.iter().find(|(s, r, _)| s == system && *r == range) {
        return Arc::clone(table);
    }
    let upsampler = Upsampler::new(system, range);
    let spread =
        |rows, row: &(dyn Fn(usize) -> Vec<[f32; 3]> + Sync)| (0..rows).into_par_iter().map(row).collect();
    let table = Arc::new(SigmoidTable::new(&upsampler, 32, spread));
    tables.push((system.clone(), range, Arc::clone(&table)));
    table
}

/// The cell of running sums (from 0 to 1) that holds `u`, and how far into it; `None` when all are zero.
pub(crate) fn pick(sums: &[f32], u: f32) -> Option<(usize, f32)> {
    let total = *sums.last()?;
    if total <= 0.0 {
        return None;
    }
    let u = u * total;
    let i = sums.partition_point(|&s| s <= u).min(sums.len() - 1);
    let low = if i == 0 { 0.0 } else { sums[i - 1] };
    let width = sums[i] - low;
    Some((i, if width > 0.0 { ((u - low) / width).clamp(0.0, 1.0) } else { 0.5 }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image() -> EnvironmentImage {
        let (w, h) = (64, 32);
        let mut rgb = vec![0.1f32; 3 * w * h];
        for p in rgb[3 * (5 * w + 20)..][..12].iter_mut() {
            *p = 500.0;
        }
        let system = RgbSystem::named("sRGB").unwrap();
        let white = Curve::constant(1.0);
        EnvironmentImage::new((w, h), &rgb, &system, white, Mat3::IDENTITY, SpectralRange::default()).unwrap()
    }

    #[test]
    fn a_wide_cone_sees_the_mean() {
        let (width, height) = (64, 32);
        let rgb: Vec<f32> = (0..width * height).flat_map(|i| [(i % 2) as f32 * 2.0; 3]).collect();
        let white = Curve::constant(1.0);
        let system = RgbSystem::named("sRGB").unwrap();
        let range = SpectralRange::default();
        let image =
            EnvironmentImage::new((width, height), &rgb, &system, white, Mat3::IDENTITY, range).unwrap();
        let (t, one) = (Lanes::<4>([0.1, 0.3, 0.6, 0.9]), Lanes::splat(1.0));
        let at = Vec2::new(0.31, 0.47);
        for radius in [0.2, 0.7, 1.5] {
            let seen = image.radiance_of_cone(at, radius, &t, &one);
            assert!(seen.0.iter().all(|v| (v - 1.0).abs() < 0.01), "{radius} {seen:?}");
        }
        assert_eq!(image.radiance_of_cone(at, 0.0, &t, &one).0, image.radiance(at, &t, &one).0);
    }

    #[test]
    fn directions_and_points_invert() {
        let image = image();
        for uv in [Vec2::new(0.1, 0.3), Vec2::new(0.5, 0.5), Vec2::new(0.93, 0.8)] {
            assert!((image.uv(image.direction(uv)) - uv).length() < 1e-5);
        }
        assert!((image.direction(Vec2::new(0.5, 0.5)) - Vec3::NEG_Z).length() < 1e-6);
        assert!(image.direction(Vec2::new(0.6, 0.5)).x > 0.0);
    }

    #[test]
    fn the_density_integrates_to_one_and_sampling_follows_it() {
        let image = image();
        let (w, h) = (640, 320);
        let mut sum = 0.0f64;
        for y in 0..h {
            for x in 0..w {
                let uv = Vec2::new((x as f32 + 0.5) / w as f32, (y as f32 + 0.5) / h as f32);
                let cell = PI / h as f32 * TAU / w as f32 * (uv.y * PI).sin();
                sum += f64::from(image.pdf(uv) * cell);
            }
        }
        assert!((sum - 1.0).abs() < 2e-3, "{sum}");
        // ∫ dω over the whole sphere by importance sampling: 4π.
        let n = 300;
        let mut omega = 0.0f64;
        for i in 0..n {
            for j in 0..n {
                let u = [(i as f32 + 0.5) / n as f32, (j as f32 + 0.5) / n as f32];
                let (_, pdf) = image.sample(u).unwrap();
                omega += 1.0 / f64::from(pdf);
            }
        }
        omega /= f64::from(n * n);
        assert!((omega / (4.0 * std::f64::consts::PI) - 1.0).abs() < 0.03, "{omega}");
    }

    #[test]
    fn grey_stays_grey_and_bad_pixels_are_named() {
        let image = image();
        let t = Lanes::<8>(std::array::from_fn(|i| i as f32 / 7.0));
        let radiance = image.radiance(Vec2::new(0.7, 0.7), &t, &Lanes::splat(1.0));
        assert!(radiance.0.iter().all(|v| (v - 0.1).abs() < 1e-5), "{radiance:?}");
        let system = RgbSystem::named("sRGB").unwrap();
        let bad = EnvironmentImage::new(
            (1, 1),
            &[1.0, f32::NAN, 0.0],
            &system,
            Curve::constant(1.0),
            Mat3::IDENTITY,
            SpectralRange::default(),
        );
        assert!(bad.err().unwrap().contains("(0, 0)"));
    }
}
