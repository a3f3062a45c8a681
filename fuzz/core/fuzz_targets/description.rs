//! Descriptions of scenes (JSON): a scene that is accepted has a camera and lamps whose samples are directions.
#![no_main]

use glam::{Affine3A, Mat3, Vec2, Vec3};
use illuminant_fuzz::{density, unit};
use illuminant_scene::description::Description;
use illuminant_scene::{Geometry, ImageData, Mesh, Motion, Placement, Scene, Shape, embree};
use libfuzzer_sys::fuzz_target;
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

type World = (Arc<Geometry>, HashMap<String, ImageData>);

fn world() -> &'static World {
    static WORLD: OnceLock<World> = OnceLock::new();
    WORLD.get_or_init(|| {
        embree::load_from_environment().expect("Embree");
        let mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            indices: vec![[0, 1, 2]],
            normals: None,
            uvs: Some(vec![Vec2::ZERO, Vec2::X, Vec2::Y]),
        };
        let ball = Shape::Sphere { center: Vec3::ZERO, radius: 0.5, turn: Mat3::IDENTITY };
        let rest = || Motion::new(vec![Affine3A::from_translation(Vec3::Z)]).expect("a transform");
        let placements = vec![Placement { shape: 0, motion: rest() }, Placement { shape: 1, motion: rest() }];
        let geometry = Geometry::new(vec![Shape::Mesh(mesh), ball], placements, 1).expect("geometry");
        let image: ImageData = (2, 2, (0..12u8).map(|i| f32::from(i) / 12.0).collect());
        (Arc::new(geometry), HashMap::from([("image".to_owned(), image)]))
    })
}

fuzz_target!(|data: &[u8]| {
    let Ok(description) = serde_json::from_slice::<Description>(data) else { return };
    // What is large is refused before it comes here, by the reader of scene files.
    if u64::from(description.range.max_nm) > 2000 || description.lights.len() > 40 {
        return;
    }
    let (geometry, images) = world();
    let Ok(scene) = Scene::new(geometry.clone(), &description, images) else { return };
    let numbers = [0.0, 0.5, 1.0 - f32::EPSILON / 2.0];
    for (i, u) in numbers.into_iter().enumerate() {
        let pair = [u, numbers[(i + 1) % 3]];
        let ray = scene.camera.ray_through_lens(pair[0], pair[1], u, pair);
        assert!(ray.direction.is_finite() || ray.origin.is_finite(), "a ray of {ray:?}");
        for from in [Vec3::ZERO, Vec3::Z, Vec3::splat(1e15)] {
            if let Some((lamp, probability)) = scene.chooser.choose(&scene.lamps, from, Vec3::Z, u) {
                assert!(lamp < scene.lamps.len());
                density(probability);
            }
            for lamp in &scene.lamps {
                if let Some(sample) = lamp.sample(&scene.geometry, from, 0.0, pair) {
                    unit(sample.direction);
                    density(sample.pdf.unwrap_or(0.0));
                }
            }
        }
    }
});
