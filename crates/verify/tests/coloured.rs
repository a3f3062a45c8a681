//! A material that takes its colour from an image, at one place, is the material of that colour.

use glam::Vec3;
use illuminant_illumination::{
    Film, Finish, Flakes, General, Historic, Illumination, IlluminationModel, Material, Prepare, Surface,
};
use illuminant_sampling::{Basis, Lanes, Role, SpectralSampling};
use illuminant_spectrum::{Curve, Outside, SpectralRange};
use illuminant_verify::site::Site;

const N: usize = 8;

fn ramp(low: f64, high: f64) -> Curve {
    Curve::new(vec![380.0, 780.0], vec![low, high], Outside::Hold).unwrap()
}

fn coloured_as(colour: Curve) -> Vec<Surface> {
    // Even absorption: the largest of a product is then the product of the largest, by which directions are drawn.
    let film = Film { absorption: Curve::constant(300.0), thickness: 1e-3 };
    let flakes = Flakes { n: ramp(1.2, 0.2), k: ramp(2.3, 4.0), slope: 0.2, coverage: 0.4 };
    let coat = |finish, film, flakes| Surface::Coated {
        n: Curve::constant(1.5),
        finish,
        film,
        pigment: colour.clone(),
        flakes,
    };
    vec![
        Surface::Diffuse { reflectance: colour.clone() },
        Surface::Filter { transmittance: colour.clone() },
        Surface::Translucent { reflectance: colour.clone(), transmittance: ramp(0.5, 0.2) },
        coat(Finish::MIRROR, None, None),
        coat(Finish::rough(0.3), Some(film), None),
        coat(Finish::rough(0.2), None, Some(flakes)),
    ]
}

fn same<M: IlluminationModel<N> + Prepare>(illumination: Illumination, basis: &dyn Basis) {
    let range = SpectralRange::default();
    let colour = ramp(0.1, 0.8);
    let lanes = Lanes::<N>::from_slice(&basis.reduce(&colour, Role::Fraction));
    let prepare = |surface: &Surface| {
        let material = Material::new("one", surface.clone());
        let brightness = material.brightness(range) as f32;
        M::prepare(&material, illumination, brightness, basis, 0..N, range)
    };
    for (own, other) in coloured_as(colour).iter().zip(&coloured_as(Curve::constant(0.35))) {
        let (own, taken) = (prepare(own), prepare(other).coloured(&lanes, 0.8));
        let [black, white] = [0.0, 1.0].map(|c| taken.coloured(&Lanes::splat(c), c));
        compare(illumination, [&own, &taken, &black, &white], &lanes);
    }
}

/// Each method is called through a table, so that it is compiled once and not wherever it is called.
fn compare(illumination: Illumination, models: [&dyn IlluminationModel<N>; 4], lanes: &Lanes<N>) {
    let [own, taken, black, white] = models;
    let site = Site::<N>::new(1.0, 1.0);
    let close = |a: Lanes<N>, b: Lanes<N>, what: &str| {
        for (a, b) in a.0.iter().zip(&b.0) {
            assert!((a - b).abs() <= 2e-5 * a.abs().max(0.01), "{illumination} {what}: {a} {b}");
        }
    };
    for v in [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.98, 0.0, 0.199]] {
        let at = site.incidence(v);
        let (a, b) = (own.ambient(&at), taken.ambient(&at));
        close(a.diffuse, b.diffuse, "ambient");
        close(a.specular, b.specular, "ambient of the surface");
        close(own.see_through(&at), taken.see_through(&at), "see_through");
        for l in [Vec3::Z, Vec3::new(-0.6, 0.0, 0.8), Vec3::new(0.0, 0.9, 0.435_89)] {
            close(own.eval(&at, l), taken.eval(&at, l), "eval");
            let (a, b) = (own.components(&at, l), taken.components(&at, l));
            close(a.diffuse, b.diffuse, "diffuse");
            close(a.specular, b.specular, "specular");
            assert!((own.pdf(&at, l) - taken.pdf(&at, l)).abs() < 1e-4, "{illumination} pdf");
        }
        let share = taken.share_of_white(&at, lanes);
        let l = Vec3::new(-0.6, 0.0, 0.8);
        let ends = [black.eval(&at, l), white.eval(&at, l)];
        close(own.eval(&at, l), ends[0] + share * (ends[1] + ends[0] * -1.0), "share");
        for i in 0..40 {
            let u = [0.618, 0.755, 0.857].map(|step: f32| (step * i as f32).fract());
            match (own.sample(&at, u, None), taken.sample(&at, u, None)) {
                (Some(a), Some(b)) => {
                    assert!((a.direction - b.direction).length() < 1e-3, "{illumination}");
                    close(a.weight, b.weight, "weight");
                }
                (None, None) => {}
                _ => panic!("{illumination}: one of two is no sample"),
            }
        }
    }
}

#[test]
fn a_colour_from_an_image_is_the_colour_of_the_material() {
    let sampling: SpectralSampling = "uniform:8".parse().unwrap();
    let basis = sampling.basis(SpectralRange::default(), &|| None).unwrap();
    for &illumination in Illumination::ALL {
        if illumination == Illumination::General {
            same::<General<N>>(illumination, &*basis);
        } else {
            same::<Historic<N>>(illumination, &*basis);
        }
    }
}
