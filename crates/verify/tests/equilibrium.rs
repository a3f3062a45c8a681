//! The promise of book eq 2.50: what reaches a surface is reflected, transmitted or absorbed, at every slope, height,
//! wavelength, index and angle.

use illuminant_illumination::{
    Body, Coated, Conductor, Dielectric, Finish, General, IlluminationModel, Metal, MetalUnder, Spectral,
    Vehicle,
};
use illuminant_optics::facets::Shape;
use illuminant_sampling::Lanes;
use illuminant_verify::energy::by_drawing;
use illuminant_verify::integrate::Cell;
use illuminant_verify::random::Random;
use illuminant_verify::reciprocity::Reciprocity;
use illuminant_verify::site::Site;

const SLOPES: [f64; 6] = [0.02, 0.05, 0.1, 0.3, 0.6, 1.0];
const HEIGHTS_NM: [Option<f64>; 5] = [None, Some(5.0), Some(50.0), Some(200.0), Some(1000.0)];
const ABOVE: [f64; 7] = [0.0, 30.0, 60.0, 75.0, 85.0, 88.0, 89.0];
const BELOW: [f64; 7] = [180.0, 150.0, 140.0, 135.0, 120.0, 100.0, 91.0];

fn spectral() -> Spectral<4> {
    Spectral { wavelength_nm: Lanes([380.0, 480.0, 600.0, 780.0]), ends_nm: [380.0, 780.0] }
}

fn finish(m: f64, sigma_nm: Option<f64>) -> Finish {
    Finish { sigma_nm, ..Finish::rough(m) }
}

fn perfect(finish: &Finish) -> General<4> {
    General::Conductor(Conductor::new(Metal::Perfect, 1.0, finish, &spectral()))
}

fn glass(finish: &Finish) -> General<4> {
    General::Dielectric(Dielectric::new(false, finish, &spectral()))
}

/// White paint, or metal that reflects everything, under a vehicle.
fn coated(finish: &Finish, coverage: f64, slope: f64) -> General<4> {
    let under = Conductor::new(Metal::Perfect, 1.0, &Finish::rough(slope), &spectral());
    let metal = (coverage > 0.0).then(|| MetalUnder {
        metal: under,
        slope,
        coverage: coverage as f32,
        mean: Lanes::splat(1.0),
        brightness: 1.0,
    });
    let body = Body { pigment: Lanes::splat(1.0), brightness: 1.0, depth: Lanes::default(), metal };
    let vehicle = Vehicle { mean: 1.5, lanes: Lanes::splat(1.5) };
    General::Coated(Coated::new(vehicle, Dielectric::new(false, finish, &spectral()), body))
}

/// The largest deviation from 1 of the share of power that leaves, and where; and the largest weight, without n².
fn worst(model: &General<4>, site: &Site<4>, angles: &[f64], draws: u64) -> (f64, f64, f64) {
    let (mut deviation, mut at, mut weight) = (0f64, 0.0, 0f64);
    for &theta in angles {
        let v = Cell::direction([theta.to_radians(), 0.7]);
        for total in by_drawing(model, site, v, draws, 1).albedo.total() {
            if (total - 1.0).abs() > deviation {
                (deviation, at) = ((total - 1.0).abs(), theta);
            }
        }
        let (incidence, squeeze) = (site.incidence(v), site.squeeze(v));
        let mut random = Random::new(3);
        for _ in 0..3_000 {
            let Some(drawn) = model.sample(&incidence, random.singles(), None) else { continue };
            for (value, squeeze) in drawn.weight.0.iter().zip(squeeze) {
                let n2 = if drawn.transmitted { squeeze } else { 1.0 };
                weight = weight.max(f64::from(*value) * n2);
            }
        }
    }
    (deviation, at, weight)
}

#[test]
fn metal_that_absorbs_nothing_returns_everything() {
    for m in SLOPES {
        for sigma in HEIGHTS_NM {
            let found = worst(&perfect(&finish(m, sigma)), &Site::new(1.0, 1.0), &ABOVE, 100_000);
            // Between 50 and 200 nm a relief of slope 0.3 returns 0.3 % too little at 75 degrees.
            let allowed = if sigma.is_none() { (2e-3, 2.0) } else { (3e-3, 8.0) };
            assert!(found.0 < allowed.0 && found.2 < allowed.1, "m {m}, sigma {sigma:?}: {found:?}");
        }
    }
}

#[test]
fn glass_reflects_and_transmits_everything() {
    for m in SLOPES {
        for sigma in HEIGHTS_NM {
            for n in [1.1, 1.5, 2.5] {
                let angles: Vec<f64> = ABOVE.into_iter().chain(BELOW).collect();
                let found = worst(&glass(&finish(m, sigma)), &Site::new(1.0, n), &angles, 20_000);
                // Boundaries that scatter a part only, from beyond the critical angle, are the least exact.
                let allowed = if sigma.is_none() { (4e-3, 10.0) } else { (1e-2, 20.0) };
                assert!(
                    found.0 < allowed.0 && found.2 < allowed.1,
                    "m {m}, sigma {sigma:?}, n {n}: {found:?}"
                );
            }
        }
    }
}

#[test]
fn white_paint_and_perfect_flakes_return_everything() {
    for (m, sigma) in [(0.0, Some(0.0)), (0.1, None), (0.4, None), (0.2, Some(100.0))] {
        for (coverage, slope) in [(0.0, 0.1), (0.3, 0.1), (1.0, 0.0), (1.0, 0.3)] {
            let model = coated(&finish(m, sigma), coverage, slope);
            let found = worst(&model, &Site::new(1.0, 1.0), &ABOVE, 20_000);
            assert!(found.0 < 7e-3, "m {m}, sigma {sigma:?}, coverage {coverage}, {slope}: {found:?}");
            let reciprocity = Reciprocity { pairs: 3_000, ..Reciprocity::default() };
            let found = reciprocity.largest_of_model(&model, &Site::new(1.0, 1.0));
            assert!(found.relative < 1e-4, "m {m}, sigma {sigma:?}, coverage {coverage}, {slope}: {found:?}");
        }
    }
}

#[test]
fn a_grain_and_long_tails_keep_the_balance() {
    for shape in [Shape::Beckmann, Shape::Ggx] {
        for (slope, sigma_nm) in
            [([0.1, 0.4], None), ([0.5, 0.2], Some(200.0)), ([0.3, 0.3], None), ([1.0, 1.0], None)]
        {
            {
                let finish = Finish { slope, sigma_nm, shape };
                let metal = worst(&perfect(&finish), &Site::new(1.0, 1.0), &ABOVE, 20_000);
                let glass = worst(&glass(&finish), &Site::new(1.0, 1.5), &ABOVE, 20_000);
                // One table of multiple scattering serves all directions of a grain.
                let allowed = if slope[0] == slope[1] { 3e-3 } else { 8e-3 };
                assert!(metal.0 < allowed && glass.0 < allowed, "{finish:?}: {metal:?} {glass:?}");
            }
        }
    }
}
