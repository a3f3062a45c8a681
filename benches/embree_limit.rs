//! The limit of a renderer that lives on single rays: Embree alone, on the rays of a path tracer, nothing shaded.
//!
//! `embree_limit record LIBRARY SCENE RAYS` follows diffuse paths through a scene and writes every query that a path
//! tracer asks, in its order (pixel by pixel, sample by sample: closest hit, then the shadow ray of that vertex, then
//! the next closest hit).  `embree_limit trace LIBRARY SCENE RAYS THREADS ROBUST RUNS` asks Embree those queries again
//! and prints, for each run and for all queries, camera rays, bounces and shadow rays, how many and the seconds.
//!
//! Paths: box filter, cosine-distributed bounces, one shadow ray a vertex to a point that is uniform on the lamps, end
//! at the depth asked for or by Russian roulette on the reflectance after the fifth edge.  The files are written and
//! the table is printed by `embree_limit.py`, which also compiles this file: rustc alone, no crate.
//!
//! SCENE (little-endian): u32 width, height, samples, depth; f32 eye[3], corner[3], right[3], down[3] (the image plane:
//! direction = corner + x right + y down, x and y in pixels); u32 objects; then for each u32 vertices, faces; f32
//! reflectance; u32 emits; f32 positions; u32 indices.  RAYS: records of [`Query`].

use std::ffi::{CString, c_char, c_void};
use std::fs;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

#[repr(C, align(16))]
#[derive(Clone, Copy)]
struct Ray {
    origin: [f32; 3],
    near: f32,
    direction: [f32; 3],
    time: f32,
    far: f32,
    mask: u32,
    id: u32,
    flags: u32,
}

#[repr(C, align(16))]
struct RayHit {
    ray: Ray,
    normal: [f32; 3],
    u: f32,
    v: f32,
    primitive: u32,
    geometry: u32,
    instance: [u32; 2],
}

/// What one query asks: 0 camera ray, 1 bounce (both closest hit), 2 shadow ray (any hit before `far`).
#[repr(C)]
#[derive(Clone, Copy)]
struct Query {
    origin: [f32; 3],
    direction: [f32; 3],
    far: f32,
    kind: u32,
}

type Handle = *mut c_void;

unsafe extern "C" {
    fn dlopen(file: *const c_char, flags: i32) -> Handle;
    fn dlsym(library: Handle, name: *const c_char) -> Handle;
}

/// The functions of Embree that are needed here, found at run time.
struct Embree {
    intersect: unsafe extern "C" fn(Handle, *mut RayHit, *const c_void),
    occluded: unsafe extern "C" fn(Handle, *mut Ray, *const c_void),
    library: Handle,
}

impl Embree {
    fn open(path: &str) -> Self {
        let path = CString::new(path).expect("a path has no zero byte");
        // SAFETY: a path ending in zero; 2 is RTLD_NOW.
        let library = unsafe { dlopen(path.as_ptr(), 2) };
        assert!(!library.is_null(), "cannot load {path:?}");
        // SAFETY: signatures as in embree4/rtcore_scene.h.
        unsafe {
            Self {
                intersect: std::mem::transmute::<Handle, _>(symbol(library, "rtcIntersect1")),
                occluded: std::mem::transmute::<Handle, _>(symbol(library, "rtcOccluded1")),
                library,
            }
        }
    }

    fn commit(&self, scene: &Scene, robust: bool) -> Committed {
        // SAFETY: signatures and constants as in the headers of Embree 4; buffers are as large as was asked for.
        unsafe {
            let new_device: extern "C" fn(*const c_char) -> Handle = self.function("rtcNewDevice");
            let new_scene: extern "C" fn(Handle) -> Handle = self.function("rtcNewScene");
            let set_flags: extern "C" fn(Handle, u32) = self.function("rtcSetSceneFlags");
            let set_quality: extern "C" fn(Handle, u32) = self.function("rtcSetSceneBuildQuality");
            let new_geometry: extern "C" fn(Handle, u32) -> Handle = self.function("rtcNewGeometry");
            let new_buffer: extern "C" fn(Handle, u32, u32, u32, usize, usize) -> Handle =
                self.function("rtcSetNewGeometryBuffer");
            let commit_geometry: extern "C" fn(Handle) = self.function("rtcCommitGeometry");
            let attach: extern "C" fn(Handle, Handle) -> u32 = self.function("rtcAttachGeometry");
            let commit_scene: extern "C" fn(Handle) = self.function("rtcCommitScene");

            let device = new_device(std::ptr::null());
            assert!(!device.is_null(), "Embree gives no device");
            let handle = new_scene(device);
            set_flags(handle, if robust { 4 } else { 0 });
            set_quality(handle, 2);
            for object in &scene.objects {
                let geometry = new_geometry(device, 0);
                let vertices = new_buffer(geometry, 1, 0, 0x9003, 12, object.positions.len() / 3);
                std::ptr::copy_nonoverlapping(
                    object.positions.as_ptr(),
                    vertices.cast(),
                    object.positions.len(),
                );
                let indices = new_buffer(geometry, 0, 0, 0x5003, 12, object.indices.len() / 3);
                std::ptr::copy_nonoverlapping(object.indices.as_ptr(), indices.cast(), object.indices.len());
                commit_geometry(geometry);
                attach(handle, geometry);
            }
            commit_scene(handle);
            Committed { intersect: self.intersect, occluded: self.occluded, handle }
        }
    }

    unsafe fn function<T: Copy>(&self, name: &str) -> T {
        let found = symbol(self.library, name);
        // SAFETY: the caller names the type of that very function.
        unsafe { std::mem::transmute_copy(&found) }
    }
}

fn symbol(library: Handle, name: &str) -> Handle {
    let c_name = CString::new(name).expect("a name has no zero byte");
    // SAFETY: the library is open, the name ends in zero.
    let found = unsafe { dlsym(library, c_name.as_ptr()) };
    assert!(!found.is_null(), "the library has no {name}");
    found
}

struct Committed {
    intersect: unsafe extern "C" fn(Handle, *mut RayHit, *const c_void),
    occluded: unsafe extern "C" fn(Handle, *mut Ray, *const c_void),
    handle: Handle,
}

// SAFETY: a committed Embree scene may be queried from any thread.
unsafe impl Sync for Committed {}

impl Committed {
    #[inline]
    fn closest(&self, query: &Query) -> RayHit {
        let none = u32::MAX;
        let mut hit = RayHit {
            ray: ray(query),
            normal: [0.0; 3],
            u: 0.0,
            v: 0.0,
            primitive: none,
            geometry: none,
            instance: [none; 2],
        };
        // SAFETY: the scene lives as long as the process.
        unsafe { (self.intersect)(self.handle, &mut hit, std::ptr::null()) };
        hit
    }

    #[inline]
    fn blocked(&self, query: &Query) -> bool {
        let mut ray = ray(query);
        // SAFETY: as above; Embree answers by a negative `far`.
        unsafe { (self.occluded)(self.handle, &mut ray, std::ptr::null()) };
        ray.far < 0.0
    }
}

fn ray(query: &Query) -> Ray {
    Ray {
        origin: query.origin,
        near: 0.0,
        direction: query.direction,
        time: 0.0,
        far: query.far,
        mask: u32::MAX,
        id: 0,
        flags: 0,
    }
}

struct Object {
    reflectance: f32,
    emits: bool,
    positions: Vec<f32>,
    indices: Vec<u32>,
}

impl Object {
    fn corner(&self, face: usize, corner: usize) -> [f32; 3] {
        let at = 3 * self.indices[3 * face + corner] as usize;
        [self.positions[at], self.positions[at + 1], self.positions[at + 2]]
    }
}

struct Scene {
    width: usize,
    height: usize,
    samples: usize,
    depth: usize,
    plane: [[f32; 3]; 4],
    objects: Vec<Object>,
}

impl Scene {
    fn read(path: &str) -> Self {
        let bytes = fs::read(path).unwrap_or_else(|error| panic!("{path}: {error}"));
        let words: Vec<u32> = bytes
            .chunks_exact(4)
            .map(|word| u32::from_le_bytes(word.try_into().expect("four bytes")))
            .collect();
        let mut next = words.into_iter();
        let mut word = move || next.next().expect("the scene file ends early");
        let [width, height, samples, depth] = std::array::from_fn(|_| word() as usize);
        let plane = std::array::from_fn(|_| std::array::from_fn(|_| f32::from_bits(word())));
        let objects = (0..word())
            .map(|_| {
                let [vertices, faces] = std::array::from_fn(|_| word() as usize);
                let (reflectance, emits) = (f32::from_bits(word()), word() != 0);
                let positions = (0..3 * vertices).map(|_| f32::from_bits(word())).collect();
                let indices = (0..3 * faces).map(|_| word()).collect();
                Object { reflectance, emits, positions, indices }
            })
            .collect();
        Self { width, height, samples, depth, plane, objects }
    }
}

/// PCG32 of O'Neill (2014): enough for which rays are asked.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f32 {
        let old = self.0;
        self.0 = old.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let word = (((old >> 18) ^ old) >> 27) as u32;
        (word.rotate_right((old >> 59) as u32) >> 8) as f32 / 16_777_216.0
    }
}

fn add(a: [f32; 3], b: [f32; 3], scale: f32) -> [f32; 3] {
    std::array::from_fn(|i| b[i].mul_add(scale, a[i]))
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: [f32; 3]) -> [f32; 3] {
    let scale = dot(a, a).sqrt().recip();
    a.map(|x| x * scale)
}

/// All queries of all paths, in the order of a path tracer that takes one pixel after the other.
fn record(scene: &Scene, embree: &Committed) -> Vec<Query> {
    let lamps: Vec<[[f32; 3]; 3]> = scene
        .objects
        .iter()
        .filter(|object| object.emits)
        .flat_map(|object| {
            (0..object.indices.len() / 3)
                .map(|face| std::array::from_fn(|corner| object.corner(face, corner)))
        })
        .collect();
    let mut area = 0.0;
    let sums: Vec<f32> = lamps
        .iter()
        .map(|[a, b, c]| {
            let normal = cross(add(*b, *a, -1.0), add(*c, *a, -1.0));
            area += dot(normal, normal).sqrt() / 2.0;
            area
        })
        .collect();
    let mut queries = Vec::new();
    let mut random = Random(0x853c_49e6_748f_ea9b);
    let [eye, corner, right, down] = scene.plane;
    for pixel in 0..scene.width * scene.height {
        for _ in 0..scene.samples {
            let x = (pixel % scene.width) as f32 + random.next();
            let y = (pixel / scene.width) as f32 + random.next();
            let direction = unit(add(add(corner, right, x), down, y));
            let mut query = Query { origin: eye, direction, far: f32::INFINITY, kind: 0 };
            for edge in 1..=scene.depth {
                queries.push(query);
                let hit = embree.closest(&query);
                if hit.geometry == u32::MAX || edge == scene.depth {
                    break;
                }
                let mut normal = unit(hit.normal);
                if dot(normal, query.direction) > 0.0 {
                    normal = normal.map(|x| -x);
                }
                let point = add(query.origin, query.direction, hit.ray.far);
                let size = point.iter().fold(0.1_f32, |size, x| size.max(x.abs()));
                let point = add(point, normal, 1e-5 * size);

                let chosen = random.next() * area;
                let lamp = sums.partition_point(|sum| *sum <= chosen).min(lamps.len() - 1);
                let [a, b, c] = lamps[lamp];
                let (root, v) = (random.next().sqrt(), random.next());
                let target = add(add(a, add(b, a, -1.0), root * (1.0 - v)), add(c, a, -1.0), root * v);
                let toward = add(target, point, -1.0);
                let side = dot(toward, cross(add(b, a, -1.0), add(c, a, -1.0)));
                // A renderer asks only when light can arrive: in front of the surface, from the front of the lamp.
                if dot(toward, normal) > 0.0 && side < 0.0 {
                    let length = dot(toward, toward).sqrt();
                    let direction = toward.map(|x| x / length);
                    queries.push(Query { origin: point, direction, far: length * 0.9999, kind: 2 });
                }

                let reflectance = scene.objects[hit.geometry as usize].reflectance;
                if edge >= 5 && random.next() > reflectance.min(0.95) {
                    break;
                }
                // Cosine distribution: a point of the unit sphere added to the normal.
                let (z, turn) = (1.0 - 2.0 * random.next(), std::f32::consts::TAU * random.next());
                let radius = (1.0 - z * z).max(0.0).sqrt();
                let direction = unit(add(normal, [radius * turn.cos(), radius * turn.sin(), z], 0.9999));
                query = Query { origin: point, direction, far: f32::INFINITY, kind: 1 };
            }
        }
    }
    queries
}

/// Seconds for all queries of these kinds, on so many threads that take blocks of 4,096 in turn.
fn trace(embree: &Committed, queries: &[Query], threads: usize) -> (f64, usize) {
    let (next, hits) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let block = 4096;
    let start = Instant::now();
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                let mut found = 0;
                loop {
                    let first = next.fetch_add(block, Ordering::Relaxed);
                    if first >= queries.len() {
                        break;
                    }
                    for query in &queries[first..queries.len().min(first + block)] {
                        let hit = if query.kind == 2 {
                            embree.blocked(query)
                        } else {
                            embree.closest(query).geometry != u32::MAX
                        };
                        found += usize::from(hit);
                    }
                }
                hits.fetch_add(found, Ordering::Relaxed);
            });
        }
    });
    (start.elapsed().as_secs_f64(), hits.into_inner())
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["record", library, scene, rays] => {
            let scene = Scene::read(scene);
            let queries = record(&scene, &Embree::open(library).commit(&scene, true));
            // SAFETY: Query is plain data without padding.
            let bytes = unsafe {
                std::slice::from_raw_parts(queries.as_ptr().cast::<u8>(), std::mem::size_of_val(&queries[..]))
            };
            fs::write(rays, bytes).unwrap_or_else(|error| panic!("{rays}: {error}"));
        }
        ["trace", library, scene, rays, threads, robust, runs] => {
            let number =
                |text: &str| text.parse::<usize>().expect("THREADS, ROBUST and RUNS are whole numbers");
            let scene = Scene::read(scene);
            let embree = Embree::open(library).commit(&scene, number(robust) != 0);
            let queries: Vec<Query> = fs::read(rays)
                .unwrap_or_else(|error| panic!("{rays}: {error}"))
                .chunks_exact(size_of::<Query>())
                // SAFETY: the record is plain data of exactly this size.
                .map(|bytes| unsafe { bytes.as_ptr().cast::<Query>().read_unaligned() })
                .collect();
            let of =
                |kind: u32| queries.iter().copied().filter(|query| query.kind == kind).collect::<Vec<_>>();
            let sets = [("all", queries.clone()), ("camera", of(0)), ("bounce", of(1)), ("shadow", of(2))];
            trace(&embree, &queries, number(threads));
            for _ in 0..number(runs) {
                for (name, set) in &sets {
                    let (seconds, hits) = trace(&embree, set, number(threads));
                    println!("{name} {} {hits} {seconds}", set.len());
                }
            }
        }
        _ => panic!(
            "usage: embree_limit record LIBRARY SCENE RAYS | trace LIBRARY SCENE RAYS THREADS ROBUST RUNS"
        ),
    }
}
