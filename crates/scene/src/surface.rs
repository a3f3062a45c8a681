//! Rays, where they meet surfaces, and how exactly the point is known.

use crate::shape::Mesh;
use glam::{Affine3A, Mat3, Vec2, Vec3};

/// A ray: a half-line at a moment.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it starts.
    pub origin: Vec3,
    /// Unit direction.
    pub direction: Vec3,
    /// When, from 0 to 1 over the shutter.
    pub time: f32,
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray.
    pub distance: f32,
    /// Which object.
    pub object: u32,
    /// Which triangle of it.
    pub primitive: u32,
    /// Barycentric coordinates of the second and third corner.
    pub barycentric: [f32; 2],
    /// The normal of the triangle in its own coordinates, of any length.
    pub normal: Vec3,
}

/// The surface at a hit.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// Position in the world.
    pub position: Vec3,
    /// A bound of its rounding error along the normal, and of that of a ray query that starts there.
    pub error: f32,
    /// Unit geometric normal, to the outside.
    pub geometric_normal: Vec3,
    /// Unit normal for shading, on the same side.
    pub normal: Vec3,
    /// Texture coordinates; barycentric ones where the mesh has none.
    pub uv: Vec2,
}

impl SurfacePoint {
    /// A point off the surface, on the side to which `direction` leads, from which a ray cannot hit the surface that
    /// it leaves: displaced along the normal by the error bound (Wächter and Binder 2019; pbrt-v4, 6.8.6).
    #[inline(always)]
    #[must_use]
    pub fn offset(&self, direction: Vec3) -> Vec3 {
        // The bound is many times the rounding of the sum, so the displacement is never lost in it.
        let side = self.error.copysign(self.geometric_normal.dot(direction));
        self.position + self.geometric_normal * side
    }
}

/// How the position grows with the texture coordinates over a triangle, of its corners and theirs; zero where the coordinates do not
/// span it.
#[must_use]
pub fn along_texture([a, b, c]: [Vec3; 3], [s, t, r]: [Vec2; 3]) -> [Vec3; 2] {
    let (d1, d2) = (t - s, r - s);
    let determinant = d1.perp_dot(d2);
    if determinant == 0.0 {
        return [Vec3::ZERO; 2];
    }
    let (e1, e2) = (b - a, c - a);
    [(e1 * d2.y - e2 * d1.y) / determinant, (e2 * d1.x - e1 * d2.x) / determinant]
}

/// γ_n, the bound of n roundings (Higham 2002).
const fn gamma(n: u32) -> f32 {
    let ne = n as f32 * (f32::EPSILON * 0.5);
    ne / (1.0 - ne)
}

#[inline(always)]
pub(crate) fn mesh_point(mesh: &Mesh, reach: f32, hit: &Hit) -> SurfacePoint {
    let corners = mesh.indices[hit.primitive as usize].map(|i| i as usize);
    let [a, b, c] = corners.map(|i| mesh.positions[i]);
    let [v, w] = hit.barycentric;
    let u = 1.0 - v - w;
    let position = a * u + b * v + c * w;
    let geometric_normal = hit.normal.normalize();
    // The position errs with the size of its terms; a query from there errs with the distances to the corners, along
    // every axis, also along one on which all corners have the coordinate 0.
    let error = reach * gamma(12);
    let normal = mesh.normals.as_ref().map_or(geometric_normal, |normals| {
        let [na, nb, nc] = corners.map(|i| normals[i]);
        let n = (na * u + nb * v + nc * w).normalize_or(geometric_normal);
        if n.dot(geometric_normal) < 0.0 { -n } else { n }
    });
    let uv = mesh.uvs.as_ref().map_or(Vec2::new(v, w), |uvs| {
        let [ta, tb, tc] = corners.map(|i| uvs[i]);
        ta * u + tb * v + tc * w
    });
    SurfacePoint { position, error, geometric_normal, normal, uv }
}

pub(crate) fn sphere_point(center: Vec3, radius: f32, turn: Mat3, near: Vec3) -> SurfacePoint {
    let normal = (near - center).normalize_or(Vec3::Z);
    let own = turn.transpose() * normal;
    let position = center + normal * radius;
    let error = (center.abs().max_element() + radius) * gamma(24);
    let uv = Vec2::new(
        (own.y.atan2(own.x) * std::f32::consts::FRAC_1_PI * 0.5).rem_euclid(1.0),
        own.z.clamp(-1.0, 1.0).acos() * std::f32::consts::FRAC_1_PI,
    );
    SurfacePoint { position, error, geometric_normal: normal, normal, uv }
}

pub(crate) fn instance_point(local: &SurfacePoint, to_world: &Affine3A) -> SurfacePoint {
    let m = glam::Mat3::from(to_world.matrix3);
    let normals = m.inverse().transpose();
    let position = to_world.transform_point3(local.position);
    // The transform magnifies the error in its own space and adds roundings of its terms.
    let magnified = m.x_axis.length().max(m.y_axis.length()).max(m.z_axis.length());
    let terms = magnified * local.position.abs().max_element() + to_world.translation.abs().max_element();
    let error = magnified * 1.8 * local.error + terms * gamma(32);
    SurfacePoint {
        position,
        error,
        geometric_normal: (normals * local.geometric_normal).normalize(),
        normal: (normals * local.normal).normalize(),
        uv: local.uv,
    }
}
