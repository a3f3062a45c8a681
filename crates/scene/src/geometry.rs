//! The ray structure: shapes where they stand, and ray queries on them.
//!
//! The ray structure depends on shapes and placements only, so camera, lamps and materials change without building it
//! again. A shape that is placed once and at rest is baked into the world (one level of tree, the fastest); one that
//! is shared or moves becomes an instance.

use crate::Motion;
use crate::embree::{self, Device, EmbreeError, RtcArguments, RtcRay, RtcRayHit};
use crate::shape::{FACET_DEPTH, Mesh, Placement, Shape, bake, check_shape, facets_of_sphere, reach};
use crate::surface::{Hit, Ray, SurfacePoint, along_texture, instance_point, mesh_point, sphere_point};
use crate::ties::{TieContext, break_ties};
use glam::{Affine3A, Vec2, Vec3};
use std::f32::consts::{PI, TAU};
use std::ffi::c_void;
use std::ptr;
use thiserror::Error;

/// Why shapes and placements are no geometry.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum GeometryError {
    /// Something is wrong with one shape.
    #[error("shape {shape}: {problem}")]
    Shape {
        /// Which.
        shape: usize,
        /// What.
        problem: String,
    },
    /// Something is wrong with one object's placement.
    #[error("object {object}: {problem}")]
    Placement {
        /// Which.
        object: usize,
        /// What.
        problem: String,
    },
    /// The ray library failed.
    #[error(transparent)]
    Embree(#[from] EmbreeError),
}

/// A placed shape: baked into the world, or shared.
enum Placed {
    /// In world coordinates, of its own.
    Baked(Shape),
    /// An index into the shared shapes, with its motion.
    Instance { shape: usize, motion: Motion },
}

struct SceneHandle {
    handle: *mut c_void,
    api: &'static embree::Api,
}

impl Drop for SceneHandle {
    fn drop(&mut self) {
        // SAFETY: made by rtcNewScene, released once.
        unsafe { (self.api.release_scene)(self.handle) }
    }
}

// SAFETY: committed scenes may be queried from any thread.
unsafe impl Send for SceneHandle {}
// SAFETY: as above.
unsafe impl Sync for SceneHandle {}

/// The ray structure of a scene.
pub struct Geometry {
    // Declared in the order of release: scenes before the device, and all before the buffers that they share.
    top: SceneHandle,
    #[allow(dead_code)] // kept alive for the instances of `top`
    bottoms: Vec<Option<SceneHandle>>,
    #[allow(dead_code)]
    device: Device,
    shapes: Vec<Shape>,
    objects: Vec<Placed>,
    #[allow(dead_code)] // buffers that Embree shares
    sphere_buffers: Vec<[f32; 4]>,
    /// For each object, how far the coordinates of its shape and the edges between them reach.
    reaches: Vec<f32>,
    bounds: (Vec3, Vec3),
    triangles: usize,
}

impl Geometry {
    /// Builds the ray structure with so many threads (0: one for each core). Object i is placement i.
    ///
    /// # Errors
    /// [`GeometryError`] that names the shape or object, or says what Embree refused.
    pub fn new(
        mut shapes: Vec<Shape>,
        placements: Vec<Placement>,
        threads: usize,
    ) -> Result<Self, GeometryError> {
        for (shape, content) in shapes.iter().enumerate() {
            check_shape(content).map_err(|problem| GeometryError::Shape { shape, problem })?;
        }
        let mut uses = vec![0usize; shapes.len()];
        for (object, placement) in placements.iter().enumerate() {
            let count = uses.get_mut(placement.shape).ok_or_else(|| GeometryError::Placement {
                object,
                problem: format!("there is no shape {}", placement.shape),
            })?;
            *count += 1;
        }
        let mut objects = Vec::with_capacity(placements.len());
        for (object, Placement { shape, motion }) in placements.into_iter().enumerate() {
            let sphere = matches!(shapes[shape], Shape::Sphere { .. });
            if motion.is_static() && (uses[shape] == 1 || sphere) {
                let baked = bake(&shapes[shape], &motion.keys()[0])
                    .map_err(|problem| GeometryError::Placement { object, problem })?;
                if !sphere {
                    shapes[shape] = Shape::Mesh(Mesh::default()); // its only user has it now
                }
                objects.push(Placed::Baked(baked));
            } else {
                objects.push(Placed::Instance { shape, motion });
            }
        }
        // Embree reads 16 bytes at each corner: one more keeps the last read inside.
        let pad = |shape: &mut Shape| {
            if let Shape::Mesh(mesh) = shape {
                mesh.positions.push(Vec3::ZERO);
            }
        };
        shapes.iter_mut().for_each(pad);
        for object in &mut objects {
            if let Placed::Baked(shape) = object {
                pad(shape);
            }
        }
        Self::build(shapes, objects, threads)
    }

    fn build(shapes: Vec<Shape>, objects: Vec<Placed>, threads: usize) -> Result<Self, GeometryError> {
        let device = Device::new(threads)?;
        let api = device.api;
        // Room for all from the start: Embree keeps pointers into it.
        let mut sphere_buffers: Vec<[f32; 4]> = Vec::with_capacity(shapes.len() + objects.len());
        let new_scene = || {
            // SAFETY: the device is alive.
            let handle = unsafe { (api.new_scene)(device.handle) };
            // SAFETY: the scene is alive and not yet committed.
            unsafe {
                (api.set_scene_flags)(handle, embree::SCENE_ROBUST | embree::SCENE_FILTER_IN_ARGUMENTS);
                (api.set_scene_quality)(handle, embree::QUALITY_HIGH);
            }
            SceneHandle { handle, api }
        };
        let mut attach_shape = |scene: &SceneHandle, shape: &Shape, id: u32| {
            // SAFETY: the buffers belong to `shapes`, `objects` and `sphere_buffers`, which live as long as the scenes
            // and are never changed or moved (their heap blocks stay where they are).
            unsafe {
                let geometry = match shape {
                    Shape::Mesh(mesh) => {
                        let geometry = (api.new_geometry)(device.handle, embree::TRIANGLE);
                        let (p, i) = (mesh.positions.as_ptr().cast(), mesh.indices.as_ptr().cast());
                        let corners = mesh.positions.len() - 1;
                        (api.set_buffer)(
                            geometry,
                            embree::BUFFER_VERTEX,
                            0,
                            embree::FLOAT3,
                            p,
                            0,
                            12,
                            corners,
                        );
                        (api.set_buffer)(
                            geometry,
                            embree::BUFFER_INDEX,
                            0,
                            embree::UINT3,
                            i,
                            0,
                            12,
                            mesh.indices.len(),
                        );
                        geometry
                    }
                    Shape::Sphere { center, radius, .. } => {
                        sphere_buffers.push([center.x, center.y, center.z, *radius]);
                        let buffer: *const f32 = sphere_buffers[sphere_buffers.len() - 1].as_ptr();
                        let geometry = (api.new_geometry)(device.handle, embree::SPHERE_POINT);
                        (api.set_buffer)(
                            geometry,
                            embree::BUFFER_VERTEX,
                            0,
                            embree::FLOAT4,
                            buffer.cast(),
                            0,
                            16,
                            1,
                        );
                        geometry
                    }
                };
                (api.commit_geometry)(geometry);
                (api.attach)(scene.handle, geometry, id);
                (api.release_geometry)(geometry);
            }
        };
        let shared = |shape: usize| {
            objects.iter().any(|o| matches!(o, Placed::Instance { shape: s, .. } if *s == shape))
        };
        let bottoms: Vec<Option<SceneHandle>> = shapes
            .iter()
            .enumerate()
            .map(|(i, shape)| {
                shared(i).then(|| {
                    let scene = new_scene();
                    attach_shape(&scene, shape, 0);
                    // SAFETY: the scene is complete.
                    unsafe { (api.commit_scene)(scene.handle) };
                    scene
                })
            })
            .collect();
        let top = new_scene();
        for (id, object) in objects.iter().enumerate() {
            match object {
                Placed::Baked(shape) => attach_shape(&top, shape, id as u32),
                Placed::Instance { shape, motion } => {
                    let Some(bottom) = &bottoms[*shape] else { continue };
                    // SAFETY: the scene of the shape is committed, and each matrix lives through its call.
                    unsafe {
                        let geometry = (api.new_geometry)(device.handle, embree::INSTANCE);
                        (api.set_instanced)(geometry, bottom.handle);
                        (api.set_time_steps)(geometry, motion.keys().len() as u32);
                        for (step, key) in motion.keys().iter().enumerate() {
                            let m = glam::Mat4::from(*key).transpose().to_cols_array();
                            (api.set_transform)(
                                geometry,
                                step as u32,
                                embree::FLOAT3X4_ROW_MAJOR,
                                m.as_ptr().cast(),
                            );
                        }
                        (api.commit_geometry)(geometry);
                        (api.attach)(top.handle, geometry, id as u32);
                        (api.release_geometry)(geometry);
                    }
                }
            }
        }
        // SAFETY: the scene is complete.
        unsafe { (api.commit_scene)(top.handle) };
        device.check()?;
        let mut geometry = Self {
            top,
            bottoms,
            device,
            shapes,
            objects,
            sphere_buffers,
            bounds: (Vec3::ZERO, Vec3::ZERO),
            reaches: Vec::new(),
            triangles: 0,
        };
        geometry.measure();
        Ok(geometry)
    }

    fn measure(&mut self) {
        let mut low = Vec3::INFINITY;
        let mut high = Vec3::NEG_INFINITY;
        let mut triangles = 0;
        let mut reaches = Vec::with_capacity(self.objects.len());
        for object in 0..self.objects.len() {
            let (shape, keys) = match &self.objects[object] {
                Placed::Baked(shape) => (shape, vec![Affine3A::IDENTITY]),
                Placed::Instance { shape, motion } => (&self.shapes[*shape], motion.keys().to_vec()),
            };
            for key in &keys {
                let mut include = |p: Vec3| {
                    let q = key.transform_point3(p);
                    low = low.min(q);
                    high = high.max(q);
                };
                match shape {
                    Shape::Mesh(mesh) => {
                        mesh.positions[..mesh.positions.len() - 1].iter().for_each(|p| include(*p))
                    }
                    Shape::Sphere { center, radius, .. } => {
                        for corner in 0..8u32 {
                            let sign = |bit: u32| if corner >> bit & 1 == 1 { *radius } else { -radius };
                            include(*center + Vec3::new(sign(0), sign(1), sign(2)));
                        }
                    }
                }
            }
            if let Shape::Mesh(mesh) = shape {
                triangles += mesh.indices.len();
            }
            reaches.push(reach(shape));
        }
        if low.x <= high.x {
            self.bounds = (low, high);
        }
        self.triangles = triangles;
        self.reaches = reaches;
    }

    /// The corners of the box around everything.
    #[must_use]
    pub fn bounds(&self) -> (Vec3, Vec3) {
        self.bounds
    }

    /// How many objects there are.
    #[must_use]
    pub fn objects(&self) -> usize {
        self.objects.len()
    }

    /// How many triangles are placed, instances counted each time.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.triangles
    }

    /// The nearest surface along a ray. Of two surfaces at the same distance the one with the smaller object, then
    /// triangle, is met, whatever the order in which the tree was built.
    #[inline(always)]
    #[must_use]
    pub fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        let mut query = RtcRayHit {
            ray: RtcRay {
                org: ray.origin.to_array(),
                tnear: 0.0,
                dir: ray.direction.to_array(),
                time: ray.time,
                tfar: f32::INFINITY,
                mask: u32::MAX,
                id: 0,
                flags: 0,
            },
            hit: embree::RtcHit { geom_id: embree::INVALID, inst_id: embree::INVALID, ..Default::default() },
        };
        let mut context = TieContext::new();
        let mut arguments = RtcArguments {
            flags: embree::QUERY_INVOKE_FILTER,
            feature_mask: embree::FEATURES_ALL,
            context: ptr::from_mut(&mut context).cast(),
            filter: Some(break_ties),
            callback: ptr::null_mut(),
            min_width_distance_factor: 0.0,
        };
        // SAFETY: the scene is committed; the records have Embree's layout and live through the call.
        unsafe { (self.top.api.intersect1)(self.top.handle, &raw mut query, &raw mut arguments) };
        if query.hit.geom_id == embree::INVALID {
            return None;
        }
        let object = if query.hit.inst_id == embree::INVALID { query.hit.geom_id } else { query.hit.inst_id };
        Some(Hit {
            distance: query.ray.tfar,
            object,
            primitive: query.hit.prim_id,
            barycentric: [query.hit.u, query.hit.v],
            normal: Vec3::from(query.hit.ng),
        })
    }

    /// Whether anything lies between `origin` and `origin` + `span`, the end itself left out by a hair.
    #[inline(always)]
    #[must_use]
    pub fn is_occluded(&self, origin: Vec3, span: Vec3, time: f32, tfar: f32) -> bool {
        let mut ray = RtcRay {
            org: origin.to_array(),
            tnear: 0.0,
            dir: span.to_array(),
            time,
            tfar,
            mask: u32::MAX,
            id: 0,
            flags: 0,
        };
        // SAFETY: as in `closest_hit`.
        unsafe { (self.top.api.occluded1)(self.top.handle, &raw mut ray, ptr::null_mut()) };
        ray.tfar < 0.0
    }

    /// The surface where a ray has met it.
    #[inline(always)]
    #[must_use]
    pub fn surface(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        match &self.objects[hit.object as usize] {
            Placed::Baked(Shape::Mesh(mesh)) => mesh_point(mesh, self.reaches[hit.object as usize], hit),
            Placed::Baked(Shape::Sphere { center, radius, turn }) => {
                sphere_point(*center, *radius, *turn, ray.origin + ray.direction * hit.distance)
            }
            Placed::Instance { shape, motion } => {
                let to_world = motion.at(ray.time);
                let local = match &self.shapes[*shape] {
                    Shape::Mesh(mesh) => mesh_point(mesh, self.reaches[hit.object as usize], hit),
                    Shape::Sphere { center, radius, turn } => {
                        let from_world = to_world.inverse();
                        let p = from_world.transform_point3(ray.origin + ray.direction * hit.distance);
                        sphere_point(*center, *radius, *turn, p)
                    }
                };
                instance_point(&local, &to_world)
            }
        }
    }

    /// How the position grows with the texture coordinates at a hit, in the world: ∂p/∂u and ∂p/∂v. Where a mesh has none, they
    /// are the barycentric ones.
    #[must_use]
    pub fn along(&self, ray: &Ray, hit: &Hit) -> [Vec3; 2] {
        let object = hit.object as usize;
        let to_world = match &self.objects[object] {
            Placed::Baked(_) => Affine3A::IDENTITY,
            Placed::Instance { motion, .. } => motion.at(ray.time),
        };
        let local = match self.shape(object) {
            Shape::Mesh(mesh) => {
                let face = mesh.indices[hit.primitive as usize];
                let uvs = mesh.uvs.as_ref();
                let uvs = uvs.map_or([Vec2::ZERO, Vec2::X, Vec2::Y], |uvs| face.map(|i| uvs[i as usize]));
                along_texture(face.map(|i| mesh.positions[i as usize]), uvs)
            }
            Shape::Sphere { center, turn, .. } => {
                let point = to_world.inverse().transform_point3(ray.origin + ray.direction * hit.distance);
                // Along the parallel, and down the meridian.
                let round = (*turn * Vec3::Z).cross(point - *center) * turn.determinant().signum();
                let down = round.normalize_or_zero().cross(point - *center) * turn.determinant().signum();
                [round * TAU, down * PI]
            }
        };
        local.map(|v| to_world.transform_vector3(v))
    }

    /// The hit that a ray has at a point of a primitive, as [`Self::closest_hit`] would give it.
    #[must_use]
    pub fn hit_at(&self, ray: &Ray, object: u32, primitive: u32, point: Vec3) -> Hit {
        let distance = ray.origin.distance(point);
        let Shape::Mesh(mesh) = self.shape(object as usize) else {
            return Hit { distance, object, primitive, barycentric: [0.0; 2], normal: Vec3::Z };
        };
        let local = match &self.objects[object as usize] {
            Placed::Baked(_) => point,
            Placed::Instance { motion, .. } => motion.at(ray.time).inverse().transform_point3(point),
        };
        let [a, b, c] = mesh.indices[primitive as usize].map(|i| mesh.positions[i as usize]);
        let normal = (b - a).cross(c - a);
        let part = |p: Vec3, q: Vec3| (p - local).cross(q - local).dot(normal) / normal.length_squared();
        Hit { distance, object, primitive, barycentric: [part(c, a), part(a, b)], normal }
    }

    /// Where a point of an object, met at a time, was as the object's motion began.
    #[must_use]
    pub fn at_rest(&self, object: usize, time: f32, point: Vec3) -> Vec3 {
        match &self.objects[object] {
            Placed::Instance { motion, .. } if !motion.is_static() => {
                motion.at(0.0).transform_point3(motion.at(time).inverse().transform_point3(point))
            }
            _ => point,
        }
    }

    /// The corners of a triangle of an object in the world, at a time; `None` for spheres.
    #[must_use]
    pub fn triangle(&self, object: usize, primitive: usize, time: f32) -> Option<[Vec3; 3]> {
        let Shape::Mesh(mesh) = self.shape(object) else { return None };
        let corners = mesh.indices[primitive].map(|i| mesh.positions[i as usize]);
        let Placed::Instance { motion, .. } = &self.objects[object] else { return Some(corners) };
        let to_world = motion.at(time);
        let [a, b, c] = corners.map(|p| to_world.transform_point3(p));
        Some(if to_world.matrix3.determinant() < 0.0 { [a, c, b] } else { [a, b, c] })
    }

    /// How many triangles an object has; 0 for a sphere.
    #[must_use]
    pub fn primitives(&self, object: usize) -> usize {
        match self.shape(object) {
            Shape::Mesh(mesh) => mesh.indices.len(),
            Shape::Sphere { .. } => 0,
        }
    }

    /// The centre and radius of an object that is a sphere at rest.
    #[must_use]
    pub fn sphere(&self, object: usize) -> Option<(Vec3, f32)> {
        match &self.objects[object] {
            Placed::Baked(Shape::Sphere { center, radius, .. }) => Some((*center, *radius)),
            _ => None,
        }
    }

    /// The surface of an object as triangles in the world, at a time. A sphere is cut into facets whose normals are its own.
    #[must_use]
    pub fn world_mesh(&self, object: usize, time: f32) -> Mesh {
        let mesh = match self.shape(object) {
            Shape::Mesh(mesh) => mesh.clone(),
            Shape::Sphere { center, radius, turn } => facets_of_sphere(*center, *radius, *turn),
        };
        let Placed::Instance { motion, .. } = &self.objects[object] else { return mesh };
        match bake(&Shape::Mesh(mesh), &motion.at(time)) {
            Ok(Shape::Mesh(mesh)) => mesh,
            // A mesh can always be moved, and stays one.
            _ => Mesh::default(),
        }
    }

    /// The shape of an object, in the world if it is baked, else in its own coordinates.
    /// How far below the surface of an object the triangles of [`Self::world_mesh`] lie at most: 0 but for spheres.
    #[must_use]
    pub fn facet_depth(&self, object: usize, time: f32) -> f32 {
        let Shape::Sphere { radius, .. } = self.shape(object) else { return 0.0 };
        let scale = match &self.objects[object] {
            Placed::Baked(_) => 1.0,
            Placed::Instance { motion, .. } => {
                let m = motion.at(time).matrix3;
                [m.x_axis, m.y_axis, m.z_axis].iter().map(|axis| axis.length()).fold(0.0, f32::max)
            }
        };
        radius * scale * FACET_DEPTH
    }

    fn shape(&self, object: usize) -> &Shape {
        match &self.objects[object] {
            Placed::Baked(shape) => shape,
            Placed::Instance { shape, .. } => &self.shapes[*shape],
        }
    }

    /// Whether an object is at rest.
    #[must_use]
    pub fn is_static(&self, object: usize) -> bool {
        matches!(&self.objects[object], Placed::Baked(_))
            || matches!(&self.objects[object], Placed::Instance { motion, .. } if motion.is_static())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Mat3, vec3};

    fn square(z: f32) -> Shape {
        Shape::Mesh(Mesh {
            positions: vec![vec3(-1.0, -1.0, z), vec3(1.0, -1.0, z), vec3(1.0, 1.0, z), vec3(-1.0, 1.0, z)],
            indices: vec![[0, 1, 2], [0, 2, 3]],
            ..Mesh::default()
        })
    }

    fn placed(shape: usize, x: f32) -> Placement {
        let motion = Motion::new(vec![Affine3A::from_translation(vec3(x, 0.0, 0.0))]).unwrap();
        Placement { shape, motion }
    }

    fn down(x: f32, y: f32) -> Ray {
        Ray { origin: vec3(x, y, 5.0), direction: Vec3::NEG_Z, time: 0.0 }
    }

    #[test]
    fn meshes_spheres_and_instances_are_met() {
        crate::embree::load_from_environment().unwrap();
        let shapes =
            vec![square(0.0), Shape::Sphere { center: Vec3::ZERO, radius: 2.0, turn: Mat3::IDENTITY }];
        // The square twice, so that it is an instance; the sphere far off.
        let placements = vec![placed(0, 0.0), placed(0, 3.0), placed(1, 10.0)];
        let geometry = Geometry::new(shapes, placements, 1).unwrap();
        let hit = geometry.closest_hit(&down(3.2, 0.5)).unwrap();
        assert!(hit.object == 1 && (hit.distance - 5.0).abs() < 1e-5);
        let point = geometry.surface(&down(3.2, 0.5), &hit);
        assert!((point.position - vec3(3.2, 0.5, 0.0)).length() < 1e-6 && point.geometric_normal == Vec3::Z);
        let hit = geometry.closest_hit(&down(10.0, 0.0)).unwrap();
        assert!((hit.distance - 3.0).abs() < 1e-5 && hit.object == 2);
        // From inside a sphere its far side is met.
        let inside = Ray { origin: vec3(10.0, 0.0, 0.0), direction: Vec3::X, time: 0.0 };
        assert!((geometry.closest_hit(&inside).unwrap().distance - 2.0).abs() < 1e-5);
        assert!(geometry.closest_hit(&down(6.0, 0.0)).is_none());
        assert!(geometry.is_occluded(vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, -2.0), 0.0, 1.0));
        assert!(!geometry.is_occluded(vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, -0.9), 0.0, 1.0));
    }

    #[test]
    fn positions_grow_along_the_texture() {
        crate::embree::load_from_environment().unwrap();
        let Shape::Mesh(mut mesh) = square(0.0) else { unreachable!() };
        // u grows along y, v along −x, over half the square and all of it.
        mesh.uvs = Some(mesh.positions.iter().map(|p| Vec2::new(p.y, -0.5 * p.x)).collect());
        let mirror = Affine3A::from_scale(vec3(1.0, -3.0, 1.0));
        let mirrored = Affine3A::from_translation(vec3(5.0, 0.0, 0.0)) * mirror;
        let turn = Mat3::from_rotation_y(0.4) * Mat3::from_diagonal(vec3(1.0, -1.0, 1.0));
        let ball = Shape::Sphere { center: vec3(10.0, 0.0, 0.0), radius: 2.0, turn };
        let placements = vec![
            placed(0, 0.0),
            Placement { shape: 0, motion: Motion::new(vec![mirrored]).unwrap() },
            placed(1, 0.0),
        ];
        let geometry = Geometry::new(vec![Shape::Mesh(mesh), ball], placements, 1).unwrap();
        let expected =
            [(down(0.3, 0.1), [Vec3::Y, Vec3::X * -2.0]), (down(5.2, 0.1), [Vec3::Y * -3.0, Vec3::X * -2.0])];
        for (ray, along) in expected {
            let found = geometry.along(&ray, &geometry.closest_hit(&ray).unwrap());
            assert!((found[0] - along[0]).length() + (found[1] - along[1]).length() < 1e-5, "{found:?}");
        }
        // On a sphere by differences of its own coordinates.
        let at = |x: f32, y: f32| {
            let ray = down(x, y);
            let hit = geometry.closest_hit(&ray).unwrap();
            (geometry.surface(&ray, &hit), geometry.along(&ray, &hit))
        };
        let (here, along) = at(11.0, 0.5);
        for (x, y) in [(11.002, 0.5), (11.0, 0.502)] {
            let there = at(x, y).0;
            let d = there.uv - here.uv;
            let moved = there.position - here.position;
            assert!((along[0] * d.x + along[1] * d.y - moved).length() < 0.02 * moved.length());
        }
    }

    #[test]
    fn ties_go_to_the_smaller_id() {
        crate::embree::load_from_environment().unwrap();
        for order in [[0, 1], [1, 0]] {
            // Two identical squares, and every ray meets an edge or both surfaces at once.
            let shapes = vec![square(0.0), square(0.0)];
            let placements = order.map(|s| placed(s, 0.0)).to_vec();
            for threads in [1, 2] {
                let geometry = Geometry::new(shapes.clone(), placements.clone(), threads).unwrap();
                for i in 0..200 {
                    let x = i as f32 / 100.0 - 1.0;
                    let hit = geometry.closest_hit(&down(x, x)).unwrap();
                    assert_eq!((hit.object, hit.primitive), (0, 0), "{x}");
                }
            }
        }
    }

    #[test]
    fn a_ray_that_leaves_a_surface_does_not_meet_it_again() {
        crate::embree::load_from_environment().unwrap();
        for scale in [1e-3, 1.0, 1e3] {
            for far in [0.0, 1e3] {
                // Flat on an axis first, then tilted.
                self_intersections(square(0.0), &|x, y| vec3(x, y, 5.0));
                let mut shape = square(0.0);
                if let Shape::Mesh(mesh) = &mut shape {
                    for p in &mut mesh.positions {
                        *p = vec3(
                            p.x * scale + far,
                            p.y * scale * 0.7 - far,
                            p.x * scale * 0.3 + p.y * scale * 0.2 + far,
                        );
                    }
                }
                self_intersections(shape, &|x, y| {
                    vec3(x * scale + far, y * scale * 0.7 - far, far + 5.0 * scale)
                });
            }
        }
    }

    fn self_intersections(shape: Shape, above: &dyn Fn(f32, f32) -> Vec3) {
        let geometry = Geometry::new(vec![shape], vec![placed(0, 0.0)], 1).unwrap();
        let mut met = 0;
        for i in 0..2000u32 {
            let (x, y) = ((i % 50) as f32 / 25.0 - 0.99, (i / 50) as f32 / 20.0 - 0.99);
            let ray = Ray { origin: above(x, y), direction: Vec3::NEG_Z, time: 0.0 };
            let Some(hit) = geometry.closest_hit(&ray) else { continue };
            met += 1;
            let point = geometry.surface(&ray, &hit);
            for direction in [Vec3::Z, vec3(0.95, 0.0, 0.3).normalize(), vec3(-0.5, 0.8, 0.1).normalize()] {
                if direction.dot(point.geometric_normal) > 1e-3 {
                    let origin = point.offset(direction);
                    let again = geometry.closest_hit(&Ray { origin, direction, time: 0.0 });
                    assert!(again.is_none(), "{ray:?} {direction} {again:?}");
                    assert!(!geometry.is_occluded(origin, direction, 0.0, f32::INFINITY));
                }
            }
        }
        assert!(met > 100);
    }

    #[test]
    fn broken_meshes_are_refused() {
        crate::embree::load_from_environment().unwrap();
        let with = |f: &dyn Fn(&mut Mesh)| {
            let Shape::Mesh(mut mesh) = square(0.0) else { unreachable!() };
            f(&mut mesh);
            Geometry::new(vec![Shape::Mesh(mesh)], vec![placed(0, 0.0)], 1).err().map(|e| e.to_string())
        };
        assert!(with(&|m| m.indices[1][2] = 9).unwrap().contains("beyond the 4"));
        assert!(with(&|m| m.positions[0].x = f32::NAN).unwrap().contains("not finite"));
        assert!(with(&|m| m.indices.clear()).unwrap().contains("no faces"));
        assert!(with(&|_| ()).is_none());
    }
}
