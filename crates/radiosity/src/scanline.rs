//! What a hemi-cube sees, found scanline by scanline with a buffer of depth (Cohen and Greenberg 1985).

use crate::elements::Elements;
use crate::hemicube::Hemicube;
use crate::rays::turned;
use glam::Vec3;
use illuminant_scene::Geometry;

const NOTHING: u32 = u32::MAX;

/// The buffers of one hemi-cube, for use again.
pub(crate) struct ItemBuffer {
    items: Vec<u32>,
    /// The reciprocal of depth.
    nearness: Vec<f32>,
    /// All corners of the scene about the side that looks.
    local: Vec<Vec3>,
    polygon: Vec<Vec3>,
    clipped: Vec<Vec3>,
}

impl ItemBuffer {
    pub fn new(cube: &Hemicube, elements: &Elements) -> Self {
        let cells = (cube.resolution() * cube.resolution()) as usize;
        Self {
            items: vec![NOTHING; cells],
            nearness: vec![0.0; cells],
            local: vec![Vec3::ZERO; elements.subdivision.count_of_corners()],
            polygon: Vec::new(),
            clipped: Vec::new(),
        }
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
            let rows = if face == 0 { n } else { n / 2 };
            self.items.fill(NOTHING);
            self.nearness.fill(0.0);
            for (number, element) in elements.all.iter().enumerate() {
                let corners = elements.subdivision.corners(element.node).map(|i| self.local[i as usize]);
                if number as u32 == own || corners.iter().all(|p| p.z <= near * 1e-2) {
                    continue;
                }
                self.draw(cube, face, corners, near, number as u32);
            }
            for j in 0..rows {
                for i in 0..n {
                    let item = self.items[(j * n + i) as usize];
                    if item == NOTHING {
                        continue;
                    }
                    let direction = frame.to_world(cube.middle(face, i, j));
                    let back = elements.all[item as usize].normal.dot(direction) > 0.0;
                    let delta = if face == 0 { cube.top(i, j) } else { cube.side(i, j) };
                    each(item, back, delta);
                }
            }
        }
    }

    /// Draws a triangle into a face.
    fn draw(&mut self, cube: &Hemicube, face: u32, corners: [Vec3; 3], near: f32, item: u32) {
        // Across, up, and away from the middle of the face.
        let onto = |p: Vec3| match face {
            0 => p,
            1 => Vec3::new(p.y, p.z, p.x),
            2 => Vec3::new(-p.x, p.z, p.y),
            3 => Vec3::new(-p.y, p.z, -p.x),
            _ => Vec3::new(p.x, p.z, -p.y),
        };
        self.polygon.clear();
        self.polygon.extend(corners.map(onto));
        let floor = if face == 0 { -1.0 } else { 0.0 };
        // Outside of one of the planes it is not seen; only the nearest is cut off, the rest lies beyond the buffer.
        let outside = |f: &dyn Fn(&Vec3) -> bool| self.polygon.iter().all(f);
        if outside(&|p| p.z <= near)
            || outside(&|p| p.x > p.z)
            || outside(&|p| -p.x > p.z)
            || outside(&|p| p.y > p.z)
            || outside(&|p| p.y < floor * p.z)
        {
            return;
        }
        let [a, b, c] = [self.polygon[0], self.polygon[1], self.polygon[2]];
        let normal = (b - a).cross(c - a);
        let distance = normal.dot(a);
        if distance == 0.0 {
            return;
        }
        let plane = normal / distance;
        self.clipped.clear();
        for i in 0..3 {
            let (p, q) = (self.polygon[i], self.polygon[(i + 1) % 3]);
            if p.z > near {
                self.clipped.push(p);
            }
            if (p.z > near) != (q.z > near) {
                self.clipped.push(p + (q - p) * ((near - p.z) / (q.z - p.z)));
            }
        }
        let n = cube.resolution();
        let rows = if face == 0 { n } else { n / 2 };
        let half = 0.5 * n as f32;
        // In cells, whose middles are whole.
        for p in &mut self.clipped {
            let (x, y) = (p.x / p.z, p.y / p.z);
            *p = Vec3::new((x + 1.0) * half - 0.5, (y - floor) * half - 0.5, 0.0);
        }
        let low = self.clipped.iter().fold(f32::INFINITY, |m, p| m.min(p.y));
        let high = self.clipped.iter().fold(f32::NEG_INFINITY, |m, p| m.max(p.y));
        let last = rows as f32 - 1.0;
        let (first, last) = (low.ceil().max(0.0), high.floor().min(last));
        let mut j = first;
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
            let (from, to) = (left.ceil().max(0.0), (right.ceil() - 1.0).min(n as f32 - 1.0));
            let mut i = from;
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
