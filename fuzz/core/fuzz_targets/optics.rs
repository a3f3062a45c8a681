//! Samplers of directions and the formulas about them.
#![no_main]

use glam::Vec3;
use illuminant_fuzz::{Bytes, density, unit};
use illuminant_optics::facets::{Facets, Shape};
use illuminant_optics::frame::Frame;
use illuminant_optics::photometric_web::PhotometricWeb;
use illuminant_optics::spherical_rectangle::SphericalRectangle;
use illuminant_optics::spherical_triangle::SphericalTriangle;
use illuminant_optics::vectors::{half, reflect, refract};
use illuminant_optics::{fresnel, hemisphere, hosek_wilkie::HosekWilkie};
use libfuzzer_sys::fuzz_target;

fn share(value: f32) {
    assert!((-1e-3..=1.001).contains(&value), "a reflectance of {value}");
}

fuzz_target!(|data: &[u8]| {
    let mut b = Bytes(data);
    let u = b.pair();
    unit(Vec3::from(hemisphere::cosine(u)));
    unit(Vec3::from(hemisphere::sphere(u)));
    let [x, y] = hemisphere::disc(u);
    assert!(x.hypot(y) <= 1.0001);
    let (v, n) = (b.above(), b.direction());
    let frame = Frame::from_normal(n);
    for axis in [frame.tangent, frame.bitangent, frame.normal] {
        unit(axis);
    }
    unit(Frame::along(n, b.direction()).tangent);
    unit(Vec3::from(reflect(v.to_array(), [0.0, 0.0, 1.0])));
    let eta = b.positive();
    if let Some((t, cos)) = refract(v.to_array(), [0.0, 0.0, 1.0], eta) {
        assert!((0.0..=1.0).contains(&cos));
        // Below, single precision knows no angle that is small enough.
        if eta >= 1e-3 {
            unit(Vec3::from(t));
        }
    }
    if let Some(h) = half(v.to_array(), b.direction().to_array()) {
        unit(Vec3::from(h));
    }
    let (cos, eta) = (b.unit(), b.positive().clamp(1e-3, 1e3));
    share(fresnel::dielectric(cos, eta));
    share(fresnel::conductor(cos, b.positive().clamp(0.0, 100.0), b.positive().clamp(0.0, 100.0)));
    // The core takes slopes below 10⁻³ as smooth.
    let shape = if b.byte() & 1 == 0 { Shape::Beckmann } else { Shape::Ggx };
    let slope = [b.positive().clamp(1e-3, 1e3), b.positive().clamp(1e-3, 1e3)];
    let facets = Facets::<f32> { shape, slope };
    let u = b.pair();
    let h = facets.sample_visible(v.to_array(), u);
    unit(Vec3::from(h));
    density(facets.distribution(h));
    density(facets.pdf_visible(v.to_array(), h));
    density(facets.lambda(v.to_array()));
    let l = b.above().to_array();
    assert!((0.0..=1.0001).contains(&facets.masking_shadowing(v.to_array(), l)));
    // From micrometres to thousands of kilometres: beyond, squares leave single precision.
    let place = |b: &mut Bytes<'_>| {
        b.point().to_array().map(|x| if x.abs() < 1e-6 { 0.0 } else { x.clamp(-1e6, 1e6) })
    };
    let corners = [place(&mut b), place(&mut b), place(&mut b)];
    let from = place(&mut b);
    let u = b.pair();
    if let Some(triangle) = SphericalTriangle::new(corners, from) {
        density(triangle.solid_angle());
        unit(Vec3::from(triangle.sample(u)));
    }
    let size = [b.positive(), b.positive()].map(|s| s.clamp(1e-3, 1e6));
    if let Some(rectangle) = SphericalRectangle::new(corners[0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], size, from)
    {
        density(rectangle.solid_angle());
        // A point of the rectangle.
        assert!(Vec3::from(rectangle.sample(u)).is_finite());
    }
    let doubles = |b: &mut Bytes<'_>, n: u8| -> Vec<f64> { (0..n).map(|_| f64::from(b.number())).collect() };
    let (planes, angles) = (b.byte() % 5, b.byte() % 5);
    let (p, a, values) = (doubles(&mut b, planes), doubles(&mut b, angles), doubles(&mut b, planes * angles));
    if let Ok(web) = PhotometricWeb::new(p, a, values) {
        assert!(web.value(n.to_array().map(f64::from)) >= 0.0);
        assert!(web.flux() >= 0.0);
    }
    if b.byte() == 0 {
        if let Ok(sky) = HosekWilkie::new(b.between(0.0, 12.0), b.between(-0.1, 1.1), b.between(-0.1, 1.6)) {
            let value = sky.radiance(b.between(-0.1, 1.0), b.between(0.0, 3.2), b.between(300.0, 900.0));
            assert!(value.is_finite(), "a sky of {value}");
        }
    }
});
