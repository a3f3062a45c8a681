//! From the values of elements to values at their corners (book 4.4.2, figure 4.24), between which they are interpolated in object
//! space.

use crate::elements::Elements;
use crate::sparse::Sparse;
use glam::{DVec2, DVec3, Vec3};
use illuminant_optics::frame::Frame;
use illuminant_scene::{Geometry, Ray};
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;

/// Shading normals nearer than this (cosine) are those of one smooth surface.
const SMOOTH: f32 = 0.99;

/// The corners of elements, as many at one place as surfaces meet there, and how values of elements make theirs.
///
/// At a corner a plane is fitted to the values of the elements about it, weighed by nearness: inside a surface that is their mean, as in
/// the book; at its edge it extrapolates, where the book takes twice the mean less the value of the corner within. Both
/// reproduce a linear ramp. A fitted value may lie below 0 and must be cut off there.
#[derive(Clone, Debug)]
pub struct Points {
    /// The points of each element's corners.
    pub of_element: Vec<[u32; 3]>,
    /// Where each point is.
    pub positions: Vec<Vec3>,
    /// Unit normal of the surface there, to the outside.
    pub normals: Vec<Vec3>,
    /// A row for each point, a column for each element.
    pub weights: Sparse,
}

impl Points {
    /// The points of all elements.
    #[must_use]
    pub fn new(geometry: &Geometry, elements: &Elements) -> Self {
        let corners = elements.subdivision.count_of_corners();
        let normals: Vec<[Vec3; 3]> =
            elements.all.par_iter().map(|e| shading_normals(geometry, elements, e)).collect();
        let mut at: Vec<Vec<(u32, u8)>> = vec![Vec::new(); corners];
        for (number, element) in elements.all.iter().enumerate() {
            for (k, corner) in elements.subdivision.corners(element.node).into_iter().enumerate() {
                at[corner as usize].push((number as u32, k as u8));
            }
        }
        let mut points = Self {
            of_element: vec![[0; 3]; elements.all.len()],
            positions: Vec::new(),
            normals: Vec::new(),
            weights: Sparse::default(),
        };
        let mut about: Vec<Vec<u32>> = Vec::new();
        for (corner, here) in at.iter().enumerate() {
            let first = points.positions.len();
            for &(element, k) in here {
                let normal = normals[element as usize][k as usize];
                let known = (first..points.positions.len()).find(|&p| points.normals[p].dot(normal) > SMOOTH);
                let point = known.unwrap_or_else(|| {
                    points.positions.push(elements.subdivision.position(corner as u32));
                    points.normals.push(normal);
                    about.push(Vec::new());
                    points.positions.len() - 1
                });
                about[point].push(element);
                points.of_element[element as usize][k as usize] = point as u32;
            }
        }
        let rows: Vec<Vec<(u32, f32)>> =
            (0..about.len()).into_par_iter().map(|point| points.fitted(elements, &about, point)).collect();
        points.weights = Sparse::from_rows(&rows, elements.all.len());
        points
    }

    /// What each element near a point counts for its value.
    fn fitted(&self, elements: &Elements, about: &[Vec<u32>], point: usize) -> Vec<(u32, f32)> {
        let own = &about[point];
        let mut near = own.clone();
        // Fewer do not tell how the value changes: those about their corners help.
        if near.len() < 6 {
            let further = own.iter().flat_map(|&e| self.of_element[e as usize]);
            near.extend(further.flat_map(|p| &about[p as usize]).copied());
            near.sort_unstable();
            near.dedup();
        }
        let frame = Frame::from_normal(self.normals[point]);
        let place = |e: u32| {
            let d = frame.to_local(elements.all[e as usize].centre - self.positions[point]);
            DVec2::new(f64::from(d.x), f64::from(d.y))
        };
        let scale = near.iter().map(|&e| place(e).length_squared()).sum::<f64>() / near.len() as f64;
        if scale <= 0.0 {
            return near.iter().map(|&e| (e, (near.len() as f32).recip())).collect();
        }
        let mut normal = Matrix3::<f64>::zeros();
        let mut columns = Vec::with_capacity(near.len());
        for &e in &near {
            let d = place(e) / scale.sqrt();
            let weight = elements.all[e as usize].area / (d.length_squared() + 0.1);
            let x = Vector3::new(1.0, d.x, d.y);
            normal += x * x.transpose() * weight;
            columns.push(x * weight);
        }
        // Hardly any slope where the places do not tell it.
        let ridge = 1e-4 * normal[(0, 0)];
        normal[(1, 1)] += ridge;
        normal[(2, 2)] += ridge;
        let solved = normal.lu().solve(&Vector3::new(1.0, 0.0, 0.0)).unwrap_or_else(Vector3::zeros);
        near.iter().zip(columns).map(|(&e, column)| (e, solved.dot(&column) as f32)).collect()
    }

    /// The values at all points on one side of what `of` gives for elements, `count` for each; elements that have none on that side (where
    /// `of` gives `None`) are left out.
    #[must_use]
    pub fn values<'a>(&self, count: usize, of: &(dyn Fn(u32) -> Option<&'a [f32]> + Sync)) -> Vec<f32> {
        let mut values = vec![0f32; self.positions.len() * count];
        values.par_chunks_mut(count.max(1)).enumerate().for_each(|(point, sum)| {
            let (columns, weights) = self.weights.row(point);
            let mut all = 0.0;
            for (&element, &weight) in columns.iter().zip(weights) {
                if let Some(value) = of(element) {
                    sum.iter_mut().zip(value).for_each(|(sum, v)| *sum += weight * v);
                    all += weight;
                }
            }
            let factor = if all > 0.0 { all.recip() } else { 0.0 };
            sum.iter_mut().for_each(|v| *v = (*v * factor).max(0.0));
        });
        values
    }
}

/// The shading normals at an element's corners.
fn shading_normals(geometry: &Geometry, elements: &Elements, element: &crate::Element) -> [Vec3; 3] {
    let corners = elements.corners(element);
    corners.map(|corner| {
        // A little inside, where the primitive is known.
        let at = corner.as_dvec3().lerp(element.centre.as_dvec3(), 1e-3);
        let at: DVec3 = at;
        let ray = Ray { origin: at.as_vec3() + element.normal, direction: -element.normal, time: 0.0 };
        let hit = geometry.hit_at(&ray, element.object, element.primitive, at.as_vec3());
        geometry.surface(&ray, &hit).normal
    })
}
