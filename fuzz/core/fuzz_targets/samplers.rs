//! Samplers of the scene: phase functions, environment images, the light tree, textures, densities, the camera's lens.
#![no_main]

use glam::{DVec3, Mat3, Vec2, Vec3};
use illuminant_color::RgbSystem;
use illuminant_fuzz::{Bytes, density, unit};
use illuminant_scene::LampChooser;
use illuminant_scene::{
    Camera, Density, EnvironmentImage, Extent, Filtering, Footprint, Lens, LightTree, Phase, Texture, Wrap,
    on_triangle,
};
use illuminant_spectrum::{Curve, SpectralRange};
use libfuzzer_sys::fuzz_target;

fn environment(b: &mut Bytes<'_>) {
    let (width, height) = (1 + usize::from(b.byte() % 6), 1 + usize::from(b.byte() % 4));
    let rgb: Vec<f32> = (0..3 * width * height).map(|_| b.positive()).collect();
    let white = Curve::constant(1.0);
    let system = RgbSystem::named("sRGB").expect("sRGB");
    let range = SpectralRange::default();
    let Ok(image) = EnvironmentImage::new((width, height), &rgb, &system, white, Mat3::IDENTITY, range)
    else {
        return;
    };
    for _ in 0..4 {
        if let Some((uv, pdf)) = image.sample(b.pair()) {
            assert!(uv.is_finite(), "a place of {uv}");
            density(pdf);
            density(image.pdf(uv));
            unit(image.direction(uv));
        }
        assert!(image.uv(b.direction()).is_finite());
    }
}

fn light_tree(b: &mut Bytes<'_>) {
    let count = 1 + usize::from(b.byte() % 40);
    let extents: Vec<Option<Extent>> = (0..count)
        .map(|_| {
            let far = Vec3::splat(1e12);
            let (p, q) = (b.point().clamp(-far, far), b.point().clamp(-far, far));
            (b.byte() & 3 != 0).then(|| Extent {
                low: p.min(q),
                high: p.max(q),
                axis: b.direction(),
                facing: b.unit() * std::f32::consts::PI,
                spread: b.unit() * std::f32::consts::PI,
                two_sided: b.byte() & 1 == 1,
                strength: b.positive(),
            })
        })
        .collect();
    let afar: Vec<f32> =
        (0..count).map(|i| if extents[i].is_none() { b.positive() } else { 0.0 }).collect();
    let tree = LightTree::new(&extents, &afar);
    for _ in 0..4 {
        let (point, normal) = (b.point(), b.direction());
        if let Some((lamp, probability)) = tree.choose(&[], point, normal, b.unit()) {
            assert!(lamp < count, "lamp {lamp} of {count}");
            assert!((0.0..=1.001).contains(&probability), "a probability of {probability}");
            let again = tree.probability(&[], point, normal, lamp);
            assert!((0.0..=1.001).contains(&again), "asked again, a probability of {again}");
        }
    }
}

fn texture(b: &mut Bytes<'_>) {
    let (width, height) = (1 + usize::from(b.byte() % 5), 1 + usize::from(b.byte() % 5));
    let texels = (0..width * height).map(|_| [b.unit(), b.unit(), b.unit()]).collect();
    let wrap = [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror][usize::from(b.byte() % 3)];
    let repeat = Vec2::new(b.number(), b.number());
    let offset = Vec2::new(b.number(), b.number());
    let Ok(texture) = Texture::new((width, height), texels, wrap, repeat, offset) else { return };
    let texture = if b.byte() & 1 == 1 { texture.filtered(Filtering::SummedArea) } else { texture };
    for _ in 0..4 {
        let place = Vec2::new(b.number(), b.number());
        let footprint =
            Footprint { axes: [Vec2::new(b.number(), b.number()), Vec2::new(b.number(), b.number())] };
        texture.lookup(place, &footprint);
    }
}

fn camera(b: &mut Bytes<'_>) {
    let double = |b: &mut Bytes<'_>| {
        let p = b.point();
        DVec3::new(p.x.into(), p.y.into(), p.z.into())
    };
    let (eye, target, up) = (double(b), double(b), double(b));
    let size = [1 + u32::from(b.byte()), 1 + u32::from(b.byte())];
    let Ok(mut camera) = Camera::new(eye, target, up, b.between(0.0, 180.0), size, None, [0.0, 1.0]) else {
        return;
    };
    if b.byte() & 1 == 1 {
        camera.lens = Some(Lens {
            radius: b.positive(),
            focus: b.positive(),
            blades: u32::from(b.byte()),
            turn: b.number(),
        });
    }
    camera.ray_through_lens(b.unit() * size[0] as f32, b.unit() * size[1] as f32, b.unit(), b.pair());
    camera.see(b.point(), b.unit(), b.pair());
    camera.project(eye);
}

fuzz_target!(|data: &[u8]| {
    let mut b = Bytes(data);
    match b.byte() % 6 {
        0 => environment(&mut b),
        1 => light_tree(&mut b),
        2 => texture(&mut b),
        3 => camera(&mut b),
        4 => {
            let g = b.between(-1.0, 1.0) as f32;
            for phase in [Phase::HenyeyGreenberg(g), Phase::Rayleigh] {
                let along = b.direction();
                let drawn = phase.sample(along, b.pair());
                unit(drawn);
                density(phase.value(along.dot(drawn)));
            }
        }
        _ => {
            let size =
                [1 + usize::from(b.byte() % 4), 1 + usize::from(b.byte() % 4), 1 + usize::from(b.byte() % 4)];
            let values: Vec<f32> = (0..size.iter().product()).map(|_| b.positive()).collect();
            if let Some(found) = Density::new(size, values) {
                density(found.at(b.point()));
                density(found.most());
            }
            let corners = [b.point(), b.point(), b.point()];
            on_triangle(corners, b.pair());
        }
    }
});
