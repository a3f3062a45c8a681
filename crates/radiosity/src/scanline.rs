//! What a hemi-cube sees, found scanline by scanline with a buffer of depth (Cohen and Greenberg 1985).

use crate::elements::Elements;
use crate::hemicube::Hemicube;
use crate::rays::turned;
use glam::Vec3;
use illuminant_scene::Geometry;

const NOTHING: u32 = u32::MAX;

/// The cells of one face of a hemi-cube: what is nearest in each.
pub(crate) struct Cells {
    items: Vec<u32>,
    /// The reciprocal of depth.
    nearness: Vec<f32>,
    clipped: Vec<Vec3>,
}

impl Cells {
    pub fn new(cube: &Hemicube) -> Self {
        let count = (cube.resolution() * cube.resolution()) as usize;
        Self { items: vec![NOTHING; count], nearness: vec![0.0; count], clipped: Vec::new() }
    }

    /// Forgets all.
    fn clear(&mut self) {
        self.items.fill(NOTHING);
        self.nearness.fill(0.0);
    }

    /// Forgets all, and takes nothing from now on but in these cells.
    pub fn open(&mut self, cells: &[u32]) {
        self.items.fill(NOTHING);
        self.nearness.fill(f32::INFINITY);
        cells.iter().for_each(|&cell| self.nearness[cell as usize] = 0.0);
    }

    /// What a cell holds.
    pub fn item(&self, cell: u32) -> Option<u32> {
        let item = self.items[cell as usize];
        (item != NOTHING).then_some(item)
    }

    /// Draws a flat convex polygon, given along the axes of the hemi-cube, into a face; nearer than `near` it is cut off. The polygon is
    /// turned over to the face.
    pub fn draw(&mut self, cube: &Hemicube, face: u32, polygon: &mut [Vec3], near: f32, item: u32) {
        if polygon.len() < 3 {
            return;
        }
        // Across, up, and away from the middle of the face.
        for p in polygon.iter_mut() {
            *p = match face {
                0 => *p,
                1 => Vec3::new(p.y, p.z, p.x),
                2 => Vec3::new(-p.x, p.z, p.y),
                3 => Vec3::new(-p.y, p.z, -p.x),
                _ => Vec3::new(p.x, p.z, -p.y),
            };
        }
        let floor = if face == 0 { -1.0 } else { 0.0 };
        // Outside of one of the planes it is not seen; only the nearest is cut off, the rest lies beyond the buffer.
        let outside = |f: &dyn Fn(&Vec3) -> bool| polygon.iter().all(f);
        if outside(&|p| p.z <= near)
            || outside(&|p| p.x > p.z)
            || outside(&|p| -p.x > p.z)
            || outside(&|p| p.y > p.z)
            || outside(&|p| p.y < floor * p.z)
        {
            return;
        }
        let normal = (polygon[1] - polygon[0]).cross(polygon[2] - polygon[0]);
        let distance = normal.dot(polygon[0]);
        if distance == 0.0 {
            return;
        }
        let plane = normal / distance;
        self.clipped.clear();
        for i in 0..polygon.len() {
            let (p, q) = (polygon[i], polygon[(i + 1) % polygon.len()]);
            if p.z > near {
                self.clipped.push(p);
            }
            if (p.z > near) != (q.z > near) {
                self.clipped.push(p + (q - p) * ((near - p.z) / (q.z - p.z)));
            }
        }
        let n = cube.resolution();
        let half = 0.5 * n as f32;
        // In cells, whose middles are whole.
        for p in &mut self.clipped {
            let (x, y) = (p.x / p.z, p.y / p.z);
            *p = Vec3::new((x + 1.0) * half - 0.5, (y - floor) * half - 0.5, 0.0);
        }
        let low = self.clipped.iter().fold(f32::INFINITY, |m, p| m.min(p.y));
        let high = self.clipped.iter().fold(f32::NEG_INFINITY, |m, p| m.max(p.y));
        let last = cube.rows(face) as f32 - 1.0;
        let (mut j, last) = (low.ceil().max(0.0), high.floor().min(last));
        while j <= last {
            let (mut left, mut right) = (f32::INFINITY, f32::NEG_INFINITY);
            for i in 0..self.clipped.len() {
                let (p, q) = (self.clipped[i], self.clipped[(i + 1) % self.clipped.len()]);
                if (p.y <= j) != (q.y <= j) {
                    let x = p.x + (q.x - p.x) * ((j - p.y) / (q.y - p.y));
                    (left, right) = (left.min(x), right.max(x));
                }
            }
            // A cell whose middle lies on an edge belongs to the polygon on its right alone.
            let (mut i, to) = (left.ceil().max(0.0), (right.ceil() - 1.0).min(n as f32 - 1.0));
            while i <= to {
                let at = (j as u32 * n + i as u32) as usize;
                let (x, y) = ((i + 0.5) / half - 1.0, (j + 0.5) / half + floor);
                let nearness = plane.dot(Vec3::new(x, y, 1.0));
                if nearness > self.nearness[at] {
                    self.nearness[at] = nearness;
                    self.items[at] = item;
                }
                i += 1.0;
            }
            j += 1.0;
        }
    }
}

/// The buffers of one hemi-cube, for use again.
pub(crate) struct ItemBuffer {
    cells: Cells,
    /// All corners of the scene about the side that looks.
    local: Vec<Vec3>,
}

impl ItemBuffer {
    pub fn new(cube: &Hemicube, elements: &Elements) -> Self {
        Self { cells: Cells::new(cube), local: vec![Vec3::ZERO; elements.subdivision.count_of_corners()] }
    }

    /// What a side sees: an element and whether it is its back, with the delta form factor of every cell.
    pub fn look(
        &mut self,
        geometry: &Geometry,
        elements: &Elements,
        side: u32,
        cube: &Hemicube,
        each: &mut impl FnMut(u32, bool, f32),
    ) {
        let place = elements.centre(geometry, side);
        let frame = turned(place.normal, side);
        // Flat elements stand for curved ones: the middle of the flat one sees what they enclose.
        let own = elements.sides[side as usize].element;
        let origin = elements.corners(elements.element_of(side)).iter().sum::<Vec3>() / 3.0;
        for (i, local) in self.local.iter_mut().enumerate() {
            *local = frame.to_local(elements.subdivision.position(i as u32) - origin);
        }
        // What lies nearer is the surface itself, or touches it.
        let near = 1e-3 * (elements.area(side).sqrt() as f32);
        let n = cube.resolution();
        for face in 0..5u32 {
            self.cells.clear();
            for (number, element) in elements.all.iter().enumerate() {
                let mut corners = elements.subdivision.corners(element.node).map(|i| self.local[i as usize]);
                if number as u32 == own || corners.iter().all(|p| p.z <= near * 1e-2) {
                    continue;
                }
                self.cells.draw(cube, face, &mut corners, near, number as u32);
            }
            for j in 0..cube.rows(face) {
                for i in 0..n {
                    let Some(item) = self.cells.item(j * n + i) else { continue };
                    let direction = frame.to_world(cube.middle(face, i, j));
                    let back = elements.all[item as usize].normal.dot(direction) > 0.0;
                    each(item, back, cube.delta(face, i, j));
                }
            }
        }
    }
}
