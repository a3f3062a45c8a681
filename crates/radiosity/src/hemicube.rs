//! The hemi-cube and its delta form factors (Cohen and Greenberg 1985; book 4.4.2 and appendix IV.2).

use glam::Vec3;
use std::f64::consts::PI;

/// Half a cube about a small area: a top face of n × n cells and four sides of n × n/2.
///
/// A cell's delta form factor is the part of what the area receives that comes through it, ΔF = ΔA/(π (x² + y² + 1)²) on top (book eq
/// IV.4) and z ΔA/(π (y² + z² + 1)²) on a side (eq IV.7); the book leaves out the π. By symmetry an eighth of the top and half of a
/// side are kept.
///
/// ```
/// use illuminant_radiosity::Hemicube;
/// let sum: f64 = Hemicube::new(64).cells().map(|(_, delta)| f64::from(delta)).sum();
/// assert!((sum - 1.0).abs() < 1e-3);
/// ```
#[derive(Clone, Debug)]
pub struct Hemicube {
    resolution: u32,
    /// Rows of the cells 0 ≤ j ≤ i of a quarter of the top.
    top: Vec<f32>,
    /// Rows from the foot up of the cells of half a side.
    side: Vec<f32>,
}

impl Hemicube {
    /// The least and the most cells along an edge.
    pub const RESOLUTIONS: [u32; 2] = [2, 2048];

    /// A hemi-cube of so many cells along an edge, which must be even.
    #[must_use]
    pub fn new(resolution: u32) -> Self {
        let half = resolution / 2;
        let step = 2.0 / f64::from(resolution);
        let at = |i: u32| (f64::from(i) + 0.5) * step;
        let delta = |rise: f64, x: f64, y: f64| {
            (rise * step * step / (PI * (1.0 + x * x + y * y) * (1.0 + x * x + y * y))) as f32
        };
        let top = (0..half).flat_map(|i| (0..=i).map(move |j| (i, j))).map(|(i, j)| delta(1.0, at(i), at(j)));
        let side =
            (0..half).flat_map(|z| (0..half).map(move |y| (z, y))).map(|(z, y)| delta(at(z), at(y), at(z)));
        Self { resolution, top: top.collect(), side: side.collect() }
    }

    /// Cells along an edge.
    #[must_use]
    pub fn resolution(&self) -> u32 {
        self.resolution
    }

    /// How far from the middle a cell lies, counted in cells.
    fn off_middle(&self, i: u32) -> u32 {
        let half = self.resolution / 2;
        if i >= half { i - half } else { half - 1 - i }
    }

    /// The delta form factor of a cell of the top.
    #[inline]
    #[must_use]
    pub fn top(&self, i: u32, j: u32) -> f32 {
        let (a, b) = (self.off_middle(i), self.off_middle(j));
        let (a, b) = (a.max(b), a.min(b));
        self.top[(a * (a + 1) / 2 + b) as usize]
    }

    /// The delta form factor of a cell of a side, `j` from the foot up.
    #[inline]
    #[must_use]
    pub fn side(&self, i: u32, j: u32) -> f32 {
        self.side[(j * (self.resolution / 2) + self.off_middle(i)) as usize]
    }

    /// The middle of all cells, about the z axis and of no particular length, with their delta form factors.
    pub fn cells(&self) -> impl Iterator<Item = (Vec3, f32)> + '_ {
        (0..5).flat_map(move |face| {
            (0..self.rows(face)).flat_map(move |j| {
                (0..self.resolution).map(move |i| (self.middle(face, i, j), self.delta(face, i, j)))
            })
        })
    }

    /// How many rows of cells a face has: 0 is the top.
    #[must_use]
    pub fn rows(&self, face: u32) -> u32 {
        if face == 0 { self.resolution } else { self.resolution / 2 }
    }

    /// The delta form factor of a cell of a face.
    #[inline]
    #[must_use]
    pub fn delta(&self, face: u32, i: u32, j: u32) -> f32 {
        if face == 0 { self.top(i, j) } else { self.side(i, j) }
    }

    /// The middle of a cell: face 0 is the top, 1 to 4 the sides towards x, y, −x and −y.
    #[inline]
    #[must_use]
    pub fn middle(&self, face: u32, i: u32, j: u32) -> Vec3 {
        let step = 2.0 / self.resolution as f32;
        let u = (i as f32 + 0.5) * step - 1.0;
        if face == 0 {
            return Vec3::new(u, (j as f32 + 0.5) * step - 1.0, 1.0);
        }
        let z = (j as f32 + 0.5) * step;
        match face {
            1 => Vec3::new(1.0, u, z),
            2 => Vec3::new(-u, 1.0, z),
            3 => Vec3::new(-1.0, -u, z),
            _ => Vec3::new(u, -1.0, z),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_sum_to_their_parts_of_the_hemisphere() {
        // π times the sums: 1.7409 on top and 0.3502 on each side (book appendix IV.2).
        let cube = Hemicube::new(256);
        let n = cube.resolution();
        let top: f64 = (0..n * n).map(|k| f64::from(cube.top(k % n, k / n))).sum();
        let side: f64 = (0..n * n / 2).map(|k| f64::from(cube.side(k % n, k / n))).sum();
        assert!((top * PI - 1.7409).abs() < 1e-3, "{}", top * PI);
        assert!((side * PI - 0.3502).abs() < 1e-3, "{}", side * PI);
        assert!((top + 4.0 * side - 1.0).abs() < 1e-4);
    }

    #[test]
    fn what_symmetry_leaves_out_is_found() {
        let cube = Hemicube::new(12);
        let delta = |p: Vec3, rise: f32| rise / (std::f32::consts::PI * p.length_squared().powi(2)) / 36.0;
        for (p, found) in cube.cells() {
            let rise = if p.z == 1.0 && p.x.abs() < 1.0 && p.y.abs() < 1.0 { 1.0 } else { p.z };
            assert!((found - delta(p, rise)).abs() < 1e-6 * found, "{p}");
        }
    }
}
