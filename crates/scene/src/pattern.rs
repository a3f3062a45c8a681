//! Patterns that a function makes instead of an image: noise in space, and what is built on it (Perlin 1985; book 4.2.6).
//!
//! A pattern is a number from 0 to 1 at every point of space (a block out of which the object is carved) or of the texture coordinates. What
//! is finer than a pixel is taken by its mean before it is asked for: each frequency fades as the pixel grows to its wavelength (clamping,
//! Norton, Rockwood and Skolmoski 1982), and edges of squares and stripes are integrated over the pixel in closed form.

use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::f32::consts::TAU;

/// Which function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PatternKind {
    /// Sums of noise of octaves, each half as strong as the one before it.
    Noise,
    /// The same of its absolute value.
    Turbulence,
    /// Waves along the axis, shifted by turbulence.
    Marble,
    /// Waves away from the axis, shifted by noise.
    Wood,
    /// Cubes (squares of texture coordinates) in turn.
    Checker,
    /// Layers along the axis in turn.
    Stripes,
}

/// A pattern.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pattern {
    /// Which function.
    pub kind: PatternKind,
    /// Whether it depends on texture coordinates, not on the place in space.
    #[serde(default)]
    pub on_surface: bool,
    /// The size of its unit: m in space, texture coordinates on the surface.
    pub scale: f32,
    /// Where its origin lies.
    #[serde(default)]
    pub origin: [f32; 3],
    /// Unit vector along which it is layered.
    pub axis: [f32; 3],
    /// Of noise, 1 to 16.
    pub octaves: u32,
    /// How far noise shifts waves, in units.
    #[serde(default)]
    pub amplitude: f32,
}

/// The mean of |noise|, which stands for an octave too fine to be seen.
const MEAN_SIZE: f32 = 0.22;
/// The factor that brings most of noise into [−1, 1]: its standard deviation is then near a third.
const GAIN: f32 = 1.25;

/// A hash of the corners of a lattice.
#[inline(always)]
fn hash(x: i32, y: i32, z: i32) -> u32 {
    let mut h = (x as u32).wrapping_mul(0x8da6_b343)
        ^ (y as u32).wrapping_mul(0xd816_3841)
        ^ (z as u32).wrapping_mul(0xcb1a_b31f);
    h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
    h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    h ^ (h >> 16)
}

/// The gradient at a corner against a vector: one of the twelve to the edges of a cube (Perlin 2002).
#[inline(always)]
fn gradient(hash: u32, d: Vec3) -> f32 {
    let (a, b) = match hash % 12 {
        0..=3 => (d.x, d.y),
        4..=7 => (d.x, d.z),
        _ => (d.y, d.z),
    };
    (if hash & 1 == 0 { a } else { -a }) + if hash & 2 == 0 { b } else { -b }
}

/// Gradient noise of wavelength about 1, from −1 to 1, 0 at the corners of the lattice (Perlin 1985; interpolated by his quintic of
/// 2002, which has no creases).
///
/// ```
/// use illuminant_scene::noise;
/// assert_eq!(noise(glam::Vec3::new(3.0, -2.0, 7.0)), 0.0);
/// assert!(noise(glam::Vec3::new(0.3, 0.6, 0.1)).abs() <= 1.0);
/// ```
#[must_use]
pub fn noise(p: Vec3) -> f32 {
    let base = p.floor();
    let f = p - base;
    let [x, y, z] = base.to_array().map(|v| v as i32);
    let s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let at = |i: i32, j: i32, k: i32| {
        let corner = Vec3::new(i as f32, j as f32, k as f32);
        gradient(hash(x.wrapping_add(i), y.wrapping_add(j), z.wrapping_add(k)), f - corner)
    };
    let mix = |a: f32, b: f32, t: f32| a + t * (b - a);
    let plane = |k: i32| mix(mix(at(0, 0, k), at(1, 0, k), s.x), mix(at(0, 1, k), at(1, 1, k), s.x), s.y);
    mix(plane(0), plane(1), s.z)
}

/// What is left of a wave, of a frequency, over a width: all up to half a wavelength, nothing from one.
#[inline(always)]
fn left(frequency: f32, width: f32) -> f32 {
    (2.0 - 2.0 * frequency * width).clamp(0.0, 1.0)
}

/// The mean of a square wave of ±1 and period 2 over a width about a place.
#[inline(always)]
fn square_wave(x: f32, width: f32) -> f32 {
    if width < 1e-4 {
        return if x.rem_euclid(2.0) < 1.0 { 1.0 } else { -1.0 };
    }
    // The integral of the wave, a triangle.
    let integral = |x: f32| 1.0 - (x.rem_euclid(2.0) - 1.0).abs();
    (integral(x + 0.5 * width) - integral(x - 0.5 * width)) / width
}

impl Pattern {
    /// The value at a point, 0 to 1, of what an ellipse with these half axes sees; both as the pattern measures: in m, or in texture
    /// coordinates.
    #[must_use]
    pub fn value(&self, point: Vec3, axes: &[Vec3; 2]) -> f32 {
        let p = (point - Vec3::from(self.origin)) / self.scale;
        let axes = axes.map(|a| a / self.scale);
        let width = 2.0 * axes[0].length_squared().max(axes[1].length_squared()).sqrt();
        let along = |axis: Vec3| 2.0 * axes[0].dot(axis).hypot(axes[1].dot(axis));
        let axis = Vec3::from(self.axis);
        match self.kind {
            PatternKind::Noise => 0.5 + 0.5 * GAIN * self.sum(p, width, |n, left| n * left),
            PatternKind::Turbulence => self.turbulence(p, width),
            PatternKind::Marble => {
                let shift = self.amplitude * self.turbulence(p, width);
                0.5 + 0.5 * left(1.0, along(axis)) * (TAU * (p.dot(axis) + shift)).sin()
            }
            PatternKind::Wood => {
                let out = p - axis * p.dot(axis);
                let radius = out.length() + self.amplitude * self.sum(p, width, |n, left| n * left);
                0.5 + 0.5 * left(1.0, along(out.normalize_or(axis))) * (TAU * radius).cos()
            }
            PatternKind::Checker => {
                let mut product = 1.0;
                for (k, unit) in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().enumerate() {
                    if k < 2 || !self.on_surface {
                        product *= square_wave(p[k], along(unit));
                    }
                }
                0.5 + 0.5 * product
            }
            PatternKind::Stripes => 0.5 + 0.5 * square_wave(p.dot(axis), along(axis)),
        }
        .clamp(0.0, 1.0)
    }

    /// How the value grows with the point.
    #[must_use]
    pub fn gradient(&self, point: Vec3, axes: &[Vec3; 2]) -> Vec3 {
        // As fine as the finest octave, or as what is seen.
        let finest = self.scale / (1u32 << (self.octaves.min(16) - 1)) as f32;
        let step = (0.05 * finest).max(0.5 * axes[0].length().max(axes[1].length()));
        // But not lost in the rounding of the point.
        let step = step.max(1e-5 * point.abs().max_element());
        let along =
            |unit: Vec3| self.value(point + unit * step, axes) - self.value(point - unit * step, axes);
        Vec3::new(along(Vec3::X), along(Vec3::Y), along(Vec3::Z)) / (2.0 * step)
    }

    /// The weighted mean over octaves of what `of` makes of noise and of what is left of it.
    fn sum(&self, p: Vec3, width: f32, of: impl Fn(f32, f32) -> f32) -> f32 {
        let (mut sum, mut weights, mut frequency, mut weight) = (0.0, 0.0, 1.0f32, 1.0f32);
        for octave in 0..self.octaves {
            let left = left(frequency, width);
            // Octaves do not share the corners of their lattices, where all would be 0.
            let shift = Vec3::new(0.37, 0.71, 0.53) * octave as f32;
            let n = if left > 0.0 { noise(p * frequency + shift) } else { 0.0 };
            sum += weight * of(n, left);
            weights += weight;
            frequency *= 2.0;
            weight *= 0.5;
        }
        sum / weights
    }

    fn turbulence(&self, p: Vec3, width: f32) -> f32 {
        2.0 * self.sum(p, width, |n, left| n.abs() * left + MEAN_SIZE * (1.0 - left))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pattern(kind: PatternKind) -> Pattern {
        Pattern {
            kind,
            on_surface: false,
            scale: 0.5,
            origin: [0.0; 3],
            axis: [0.0, 0.0, 1.0],
            octaves: 4,
            amplitude: 0.4,
        }
    }

    fn places(n: u32) -> impl Iterator<Item = Vec3> {
        (0..n).map(|i| {
            let i = i as f32;
            Vec3::new((i * 0.754_877_7) % 1.0, (i * 0.569_840_3) % 1.0, (i * 0.438_579_5) % 1.0) * 40.0 - 20.0
        })
    }

    #[test]
    fn noise_is_even_and_smooth() {
        let n = 200_000;
        let (mut sum, mut size, mut squares, mut largest) = (0.0f64, 0.0f64, 0.0f64, 0.0f32);
        for p in places(n) {
            let v = noise(p);
            sum += f64::from(v);
            size += f64::from(v.abs());
            squares += f64::from(v * v);
            largest = largest.max(v.abs());
            // No step anywhere, also across the faces of the lattice.
            assert!((noise(p + Vec3::splat(1e-3)) - v).abs() < 1e-2);
        }
        let n = f64::from(n);
        assert!((sum / n).abs() < 5e-3 && largest <= 1.0 && largest > 0.8, "{} {largest}", sum / n);
        assert!((size / n / f64::from(MEAN_SIZE) - 1.0).abs() < 2e-2, "{}", size / n);
        assert!((0.05..0.12).contains(&(squares / n)), "{}", squares / n);
        let face = Vec3::new(2.0, 0.4, 0.7);
        let slope = |side: f32| (noise(face + Vec3::X * side * 1e-3) - noise(face)) / (side * 1e-3);
        assert!((slope(1.0) - slope(-1.0)).abs() < 2e-2);
    }

    #[test]
    fn what_is_too_fine_is_its_mean() {
        for kind in [
            PatternKind::Noise,
            PatternKind::Turbulence,
            PatternKind::Marble,
            PatternKind::Wood,
            PatternKind::Checker,
            PatternKind::Stripes,
        ] {
            let pattern = pattern(kind);
            let fine = [Vec3::X * 1e-6, Vec3::Y * 1e-6];
            let wide = [Vec3::X * 30.0, (Vec3::Y + Vec3::Z) * 30.0];
            let n = 40_000;
            let mean = |axes| places(n).map(|p| pattern.value(p, axes)).sum::<f32>() / n as f32;
            let (near, far) = (mean(&fine), mean(&wide));
            assert!((near - far).abs() < 1.5e-2, "{kind:?} {near} {far}");
            let spread = places(1000).map(|p| (pattern.value(p, &wide) - far).abs()).fold(0.0, f32::max);
            assert!(spread < 0.02, "{kind:?} {spread}");
        }
    }

    #[test]
    fn a_pixel_takes_the_mean_of_squares_and_stripes_exactly() {
        let axes = [Vec3::X * 0.11, Vec3::Y * 0.07];
        for kind in [PatternKind::Checker, PatternKind::Stripes] {
            let pattern = Pattern { axis: [1.0, 0.0, 0.0], ..pattern(kind) };
            for p in places(200) {
                let found = pattern.value(p, &axes);
                let (n, mut sum) = (64, 0.0);
                for i in 0..n * n {
                    let [s, t] = [i / n, i % n].map(|k| 2.0 * (k as f32 + 0.5) / n as f32 - 1.0);
                    sum += pattern.value(p + axes[0] * s + axes[1] * t, &[Vec3::ZERO; 2]);
                }
                let mean = sum / (n * n) as f32;
                assert!((found - mean).abs() < 0.02, "{kind:?} {p} {found} {mean}");
            }
        }
    }

    #[test]
    fn the_gradient_is_that_of_the_value() {
        let none = [Vec3::ZERO; 2];
        let pattern = Pattern { octaves: 1, ..pattern(PatternKind::Noise) };
        for p in places(50) {
            let d = Vec3::new(0.6, -0.64, 0.48);
            let change = (pattern.value(p + d * 2e-3, &none) - pattern.value(p - d * 2e-3, &none)) / 4e-3;
            assert!((pattern.gradient(p, &none).dot(d) - change).abs() < 3e-2);
        }
    }
}
