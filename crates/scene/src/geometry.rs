//! Shapes, where they stand, and ray queries on them.
//!
//! The ray structure depends on shapes and placements only, so camera, lamps and materials change without building it
//! again. A shape that is placed once and at rest is baked into the world (one level of tree, the fastest); one that
//! is shared or moves becomes an instance.

use crate::Motion;
use crate::embree::{self, Device, EmbreeError, RtcArguments, RtcRay, RtcRayHit};
use glam::{Affine3A, Vec2, Vec3};
use std::ffi::c_void;
use std::ptr;
use thiserror::Error;

/// A triangle mesh.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Corners.
    pub positions: Vec<Vec3>,
    /// Three corners to a face; counter-clockwise seen from outside.
    pub indices: Vec<[u32; 3]>,
    /// A normal at each corner, for smooth shading.
    pub normals: Option<Vec<Vec3>>,
    /// Texture coordinates at each corner.
    pub uvs: Option<Vec<Vec2>>,
}

/// A shape in its own coordinates.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Triangles.
    Mesh(Mesh),
    /// A sphere.
    Sphere {
        /// Centre.
        center: Vec3,
        /// Radius.
        radius: f32,
    },
}

/// A shape somewhere in the world.
#[derive(Clone, Debug)]
pub struct Placement {
    /// Which shape.
    pub shape: usize,
    /// Where, at every moment.
    pub motion: Motion,
}

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

/// γ_n, the bound of n roundings (Higham 2002).
const fn gamma(n: u32) -> f32 {
    let ne = n as f32 * (f32::EPSILON * 0.5);
    ne / (1.0 - ne)
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

fn check_shape(shape: &Shape) -> Result<(), String> {
    match shape {
        Shape::Sphere { center, radius } => {
            if center.is_finite() && radius.is_finite() && *radius > 0.0 {
                Ok(())
            } else {
                Err(format!("a sphere needs a finite centre and a radius above 0, not {radius}"))
            }
        }
        Shape::Mesh(mesh) => {
            let corners = mesh.positions.len();
            if mesh.indices.is_empty() {
                return Err("the mesh has no faces".into());
            }
            if let Some(i) = mesh.positions.iter().position(|p| !p.is_finite()) {
                return Err(format!("corner {i} of the mesh is not finite"));
            }
            if let Some(i) = mesh.indices.iter().position(|f| f.iter().any(|&c| c as usize >= corners)) {
                return Err(format!("face {i} names a corner beyond the {corners} that there are"));
            }
            let normals =
                mesh.normals.as_ref().is_none_or(|n| n.len() == corners && n.iter().all(|n| n.is_finite()));
            let uvs = mesh.uvs.as_ref().is_none_or(|t| t.len() == corners && t.iter().all(|t| t.is_finite()));
            if normals && uvs {
                Ok(())
            } else {
                Err(format!(
                    "normals and texture coordinates must be finite, one for each of the {corners} corners"
                ))
            }
        }
    }
}

fn bake(shape: &Shape, transform: &Affine3A) -> Result<Shape, String> {
    match shape {
        Shape::Sphere { center, radius } => {
            let m = transform.matrix3;
            let scales = [m.x_axis.length(), m.y_axis.length(), m.z_axis.length()];
            let largest = scales[0].max(scales[1]).max(scales[2]);
            let skew = m
                .x_axis
                .dot(m.y_axis)
                .abs()
                .max(m.y_axis.dot(m.z_axis).abs())
                .max(m.z_axis.dot(m.x_axis).abs());
            if scales.iter().any(|s| (s - largest).abs() > 1e-4 * largest) || skew > 1e-4 * largest * largest
            {
                return Err("a sphere cannot be scaled unevenly; use a mesh".into());
            }
            Ok(Shape::Sphere { center: transform.transform_point3(*center), radius: radius * largest })
        }
        Shape::Mesh(mesh) if *transform == Affine3A::IDENTITY => Ok(Shape::Mesh(mesh.clone())),
        Shape::Mesh(mesh) => {
            let normals = glam::Mat3::from(transform.matrix3).inverse().transpose();
            let mirrored = transform.matrix3.determinant() < 0.0;
            Ok(Shape::Mesh(Mesh {
                positions: mesh.positions.iter().map(|p| transform.transform_point3(*p)).collect(),
                // A mirrored mesh is turned inside out again.
                indices: mesh
                    .indices
                    .iter()
                    .map(|&[a, b, c]| if mirrored { [a, c, b] } else { [a, b, c] })
                    .collect(),
                normals: mesh
                    .normals
                    .as_ref()
                    .map(|all| all.iter().map(|n| (normals * *n).normalize_or_zero()).collect()),
                uvs: mesh.uvs.clone(),
            }))
        }
    }
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
                    Shape::Sphere { center, radius } => {
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
                    Shape::Sphere { center, radius } => {
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
            Placed::Baked(Shape::Sphere { center, radius }) => {
                sphere_point(*center, *radius, ray.origin + ray.direction * hit.distance)
            }
            Placed::Instance { shape, motion } => {
                let to_world = motion.at(ray.time);
                let local = match &self.shapes[*shape] {
                    Shape::Mesh(mesh) => mesh_point(mesh, self.reaches[hit.object as usize], hit),
                    Shape::Sphere { center, radius } => {
                        let from_world = to_world.inverse();
                        let p = from_world.transform_point3(ray.origin + ray.direction * hit.distance);
                        sphere_point(*center, *radius, p)
                    }
                };
                instance_point(&local, &to_world)
            }
        }
    }

    /// The corners of a triangle of an object in the world, at a time; `None` for spheres.
    #[must_use]
    pub fn triangle(&self, object: usize, primitive: usize, time: f32) -> Option<[Vec3; 3]> {
        let corners = |mesh: &Mesh| mesh.indices[primitive].map(|i| mesh.positions[i as usize]);
        match &self.objects[object] {
            Placed::Baked(Shape::Mesh(mesh)) => Some(corners(mesh)),
            Placed::Instance { shape, motion } => match &self.shapes[*shape] {
                Shape::Mesh(mesh) => {
                    let to_world = motion.at(time);
                    let [a, b, c] = corners(mesh).map(|p| to_world.transform_point3(p));
                    Some(if to_world.matrix3.determinant() < 0.0 { [a, c, b] } else { [a, b, c] })
                }
                Shape::Sphere { .. } => None,
            },
            Placed::Baked(Shape::Sphere { .. }) => None,
        }
    }

    /// How many triangles an object has; 0 for a sphere.
    #[must_use]
    pub fn primitives(&self, object: usize) -> usize {
        let shape = match &self.objects[object] {
            Placed::Baked(shape) => shape,
            Placed::Instance { shape, .. } => &self.shapes[*shape],
        };
        match shape {
            Shape::Mesh(mesh) => mesh.indices.len(),
            Shape::Sphere { .. } => 0,
        }
    }

    /// The centre and radius of an object that is a sphere at rest.
    #[must_use]
    pub fn sphere(&self, object: usize) -> Option<(Vec3, f32)> {
        match &self.objects[object] {
            Placed::Baked(Shape::Sphere { center, radius }) => Some((*center, *radius)),
            _ => None,
        }
    }

    /// Whether an object is at rest.
    #[must_use]
    pub fn is_static(&self, object: usize) -> bool {
        matches!(&self.objects[object], Placed::Baked(_))
            || matches!(&self.objects[object], Placed::Instance { motion, .. } if motion.is_static())
    }
}

/// What the tie-breaking filter remembers of the best hit so far.
#[repr(C)]
struct TieContext {
    rtc: embree::RtcRayQueryContext,
    distance: f32,
    object: u32,
    primitive: u32,
}

impl TieContext {
    #[inline(always)]
    fn new() -> Self {
        Self {
            rtc: embree::RtcRayQueryContext { inst_id: embree::INVALID, inst_prim_id: embree::INVALID },
            distance: f32::INFINITY,
            object: u32::MAX,
            primitive: u32::MAX,
        }
    }
}

/// Called by Embree for each candidate that is no farther than the best: an equal distance is won by the smaller id.
unsafe extern "C" fn break_ties(arguments: *const embree::RtcFilterArguments) {
    // SAFETY: single-ray queries pass one ray, one hit and the context given to the query.
    unsafe {
        let arguments = &*arguments;
        let best = &mut *arguments.context.cast::<TieContext>();
        let (ray, hit) = (&*arguments.ray, &*arguments.hit);
        let object = if hit.inst_id == embree::INVALID { hit.geom_id } else { hit.inst_id };
        if ray.tfar == best.distance && (object, hit.prim_id) >= (best.object, best.primitive) {
            *arguments.valid = 0;
            return;
        }
        best.distance = ray.tfar;
        best.object = object;
        best.primitive = hit.prim_id;
    }
}

/// The largest sum of coordinates and edges of any face: what the rounding of a point on it is proportional to.
fn reach(shape: &Shape) -> f32 {
    let Shape::Mesh(mesh) = shape else { return 0.0 };
    let of_face = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|i| mesh.positions[i as usize]);
        (a.abs() + b.abs() + c.abs() + (b - a).abs() + (c - a).abs()).max_element()
    };
    mesh.indices.iter().map(of_face).fold(0.0, f32::max)
}

#[inline(always)]
fn mesh_point(mesh: &Mesh, reach: f32, hit: &Hit) -> SurfacePoint {
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

fn sphere_point(center: Vec3, radius: f32, near: Vec3) -> SurfacePoint {
    let normal = (near - center).normalize_or(Vec3::Z);
    let position = center + normal * radius;
    let error = (center.abs().max_element() + radius) * gamma(24);
    let uv = Vec2::new(
        (normal.y.atan2(normal.x) * std::f32::consts::FRAC_1_PI * 0.5).rem_euclid(1.0),
        normal.z.clamp(-1.0, 1.0).acos() * std::f32::consts::FRAC_1_PI,
    );
    SurfacePoint { position, error, geometric_normal: normal, normal, uv }
}

fn instance_point(local: &SurfacePoint, to_world: &Affine3A) -> SurfacePoint {
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

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

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
        let shapes = vec![square(0.0), Shape::Sphere { center: Vec3::ZERO, radius: 2.0 }];
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
