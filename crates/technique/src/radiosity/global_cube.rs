//! The globally oriented cube (Immel, Cohen and Greenberg 1986; book figure 4.26): directions as cells that are the same about every patch.

use glam::Vec3;

/// A cube of six faces of n × n cells, whose edges lie along the axes of the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct GlobalCube {
    edge: u32,
}

impl GlobalCube {
    pub fn new(edge: u32) -> Self {
        Self { edge }
    }

    /// How many cells there are.
    pub fn len(self) -> usize {
        6 * (self.edge * self.edge) as usize
    }

    /// Face, and where on it in cells.
    fn place(self, direction: Vec3) -> (u32, f32, f32) {
        let size = direction.abs();
        let axis = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let half = 0.5 * self.edge as f32;
        let at = |v: f32| (v / size[axis] + 1.0) * half;
        let face = 2 * axis as u32 + u32::from(direction[axis] < 0.0);
        (face, at(direction[a]), at(direction[b]))
    }

    fn index(self, face: u32, i: u32, j: u32) -> usize {
        ((face * self.edge + j) * self.edge + i) as usize
    }

    /// The cell of a direction.
    #[inline]
    pub fn cell(self, direction: Vec3) -> usize {
        let (face, x, y) = self.place(direction);
        let last = self.edge - 1;
        self.index(face, (x as u32).min(last), (y as u32).min(last))
    }

    /// The four cells about a direction, all of one face, and how much each counts there.
    #[inline]
    pub fn about(self, direction: Vec3) -> [(usize, f32); 4] {
        let (face, x, y) = self.place(direction);
        let most = (self.edge - 1) as f32;
        let (x, y) = ((x - 0.5).clamp(0.0, most), (y - 0.5).clamp(0.0, most));
        let (i, j) = (x as u32, y as u32);
        let (p, q) = (x - i as f32, y - j as f32);
        let next = |i: u32| (i + 1).min(self.edge - 1);
        [
            (self.index(face, i, j), (1.0 - p) * (1.0 - q)),
            (self.index(face, next(i), j), p * (1.0 - q)),
            (self.index(face, i, next(j)), (1.0 - p) * q),
            (self.index(face, next(i), next(j)), p * q),
        ]
    }

    /// The cell of the opposite direction: that in which what is seen through a cell sends its light.
    #[inline]
    pub fn inverse(self, cell: usize) -> usize {
        let (face, i, j) = self.split(cell);
        let last = self.edge - 1;
        self.index(face ^ 1, last - i, last - j)
    }

    fn split(self, cell: usize) -> (u32, u32, u32) {
        let (cell, n) = (cell as u32, self.edge);
        (cell / (n * n), cell % n, cell / n % n)
    }

    /// The direction of a place in a cell, from two numbers in [0, 1); (1/2, 1/2) is its middle.
    pub fn direction(self, cell: usize, u: [f32; 2]) -> Vec3 {
        let (face, i, j) = self.split(cell);
        let axis = (face / 2) as usize;
        let step = 2.0 / self.edge as f32;
        let mut direction = Vec3::ZERO;
        direction[axis] = if face % 2 == 0 { 1.0 } else { -1.0 };
        direction[(axis + 1) % 3] = (i as f32 + u[0]) * step - 1.0;
        direction[(axis + 2) % 3] = (j as f32 + u[1]) * step - 1.0;
        direction.normalize()
    }

    /// The solid angle of a cell, sr.
    pub fn solid_angle(self, cell: usize) -> f32 {
        let (_, i, j) = self.split(cell);
        let step = 2.0 / f64::from(self.edge);
        let at = |i: u32| f64::from(i) * step - 1.0;
        let corner = |x: f64, y: f64| (x * y).atan2((x * x + y * y + 1.0).sqrt());
        let (x0, x1, y0, y1) = (at(i), at(i + 1), at(j), at(j + 1));
        (corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0)) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_tile_the_sphere_and_know_their_opposites() {
        let cube = GlobalCube::new(7);
        let total: f32 = (0..cube.len()).map(|cell| cube.solid_angle(cell)).sum();
        assert!((total / (4.0 * std::f32::consts::PI) - 1.0).abs() < 1e-5);
        for cell in 0..cube.len() {
            let direction = cube.direction(cell, [0.5; 2]);
            assert_eq!(cube.cell(direction), cell);
            assert_eq!(cube.cell(-direction), cube.inverse(cell));
            let about = cube.about(direction);
            let here: f32 = about.iter().filter(|(c, _)| *c == cell).map(|(_, w)| w).sum();
            assert!((here - 1.0).abs() < 1e-4, "{cell} {about:?}");
        }
    }
}
