//! Colour and shape of multiple scattering: the model `general` against random walks on the microsurface.

use illuminant_illumination::{Conductor, Dielectric, Finish, General, IlluminationModel, Metal, Spectral};
use illuminant_optics::facets::Shape;
use illuminant_optics::fresnel::conductor;
use illuminant_sampling::Lanes;
use illuminant_verify::integrate::Cell;
use illuminant_verify::random::{EvenPoints, Random, single};
use illuminant_verify::random_walk::{RandomWalk, Slopes};
use illuminant_verify::site::Site;

const WALKS: u32 = 200_000;
/// Cells of the cosine and of the azimuth from that of the view, on both sides.
const CELLS: usize = 2 * 5 * 4;

/// n and k of copper and gold at 450, 530, 580 and 650 nm (Johnson and Christy 1972, rounded).
const COPPER: ([f32; 4], [f32; 4]) = ([1.18, 1.13, 0.60, 0.21], [2.44, 2.57, 2.70, 3.58]);
const GOLD: ([f32; 4], [f32; 4]) = ([1.50, 0.58, 0.28, 0.17], [1.88, 2.15, 2.80, 3.45]);

fn cell(d: [f64; 3], v: [f64; 3]) -> usize {
    let cosine = ((d[2].abs() * 5.0) as usize).min(4);
    let along = (d[0] * v[0] + d[1] * v[1]) / (d[0].hypot(d[1]) * v[0].hypot(v[1])).max(1e-12);
    let azimuth = ((along.clamp(-1.0, 1.0).acos() / std::f64::consts::PI * 4.0) as usize).min(3);
    let side = usize::from(d[2] < 0.0);
    (side * 5 + cosine) * 4 + azimuth
}

/// Power to each cell by the model.
fn by_model(model: &General<4>, site: &Site<4>, v: [f64; 3]) -> [[f64; CELLS]; 4] {
    let (at, squeeze) = (site.incidence(v), site.squeeze(v));
    let mut points = EvenPoints::<3>::new(7);
    let mut cells = [[0.0; CELLS]; 4];
    for _ in 0..WALKS {
        let Some(drawn) = model.sample(&at, points.next_point().map(single), None) else { continue };
        let i = cell(drawn.direction.to_array().map(f64::from), v);
        for lane in 0..4 {
            let n2 = if drawn.transmitted { squeeze[lane] } else { 1.0 };
            cells[lane][i] += f64::from(drawn.weight[lane]) * n2 / f64::from(WALKS);
        }
    }
    cells
}

/// The relative difference of the sums, and half the sum of differences relative to the sum.
fn compare(a: &[f64; CELLS], b: &[f64; CELLS]) -> (f64, f64) {
    let (sum, other): (f64, f64) = (a.iter().sum(), b.iter().sum());
    let apart: f64 = a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum();
    ((other / sum - 1.0).abs(), 0.5 * apart / sum)
}

#[test]
fn metals_have_the_albedo_and_the_lobe_of_the_walk() {
    let spectral = Spectral::monochromatic(550.0);
    for (name, (n, k)) in [("copper", COPPER), ("gold", GOLD)] {
        for m in [0.1, 0.3, 0.6, 1.0] {
            let fresnel = Metal::Index { n: Lanes(n), k: Lanes(k) };
            let model = General::Conductor(Conductor::new(fresnel, 0.9, &Finish::rough(m), &spectral));
            let walk = RandomWalk { slopes: Slopes::Gaussian, m: [m, m] };
            for theta in [10.0f64, 45.0, 70.0, 85.0] {
                let v = Cell::direction([theta.to_radians(), 0.0]);
                let mut cells = [[0.0; CELLS]; 4];
                let mut random = Random::new(11);
                for _ in 0..WALKS {
                    let f = |c: f64| [0, 1, 2, 3].map(|i| conductor(c, f64::from(n[i]), f64::from(k[i])));
                    let path = walk.reflect(v, &mut random, f).unwrap();
                    let i = cell(path.direction, v);
                    for (cells, weight) in cells.iter_mut().zip(path.weight) {
                        cells[i] += weight / f64::from(WALKS);
                    }
                }
                let found = by_model(&model, &Site::new(1.0, 1.0), v);
                for (lane, (cells, found)) in cells.iter().zip(&found).enumerate() {
                    let (albedo, lobe) = compare(cells, found);
                    assert!(
                        albedo < 0.02 && lobe < 0.02,
                        "{name} m {m} theta {theta} lane {lane}: {albedo} {lobe}"
                    );
                }
            }
        }
    }
}

#[test]
fn rough_glass_has_the_albedo_and_the_lobe_of_the_walk() {
    let spectral = Spectral::monochromatic(550.0);
    for n in [1.2f32, 1.5, 2.0] {
        for m in [0.1, 0.4, 1.0] {
            let model = General::Dielectric(Dielectric::new(false, &Finish::rough(m), &spectral));
            let walk = RandomWalk { slopes: Slopes::Gaussian, m: [m, m] };
            for theta in [10.0f64, 60.0, 80.0, 170.0, 140.0, 120.0, 100.0] {
                let v = Cell::direction([theta.to_radians(), 0.0]);
                let mut cells = [0.0; CELLS];
                let mut random = Random::new(13);
                for _ in 0..WALKS {
                    let path = walk.refract(v, f64::from(n), &mut random).unwrap();
                    cells[cell(path.direction, v)] += f64::from(WALKS).recip();
                }
                let found = by_model(&model, &Site::new(1.0, n), v)[0];
                let side = |cells: &[f64; CELLS]| -> f64 { cells[..CELLS / 2].iter().sum() };
                let (_, lobe) = compare(&cells, &found);
                let split = (side(&cells) - side(&found)).abs();
                assert!(split < 0.02 && lobe < 0.02, "glass {n} m {m} theta {theta}: {split} {lobe}");
            }
        }
    }
}

#[test]
fn long_tails_have_the_albedo_of_the_walk() {
    let spectral = Spectral::monochromatic(550.0);
    for m in [0.2, 0.5, 1.0] {
        let finish = Finish { shape: Shape::Ggx, ..Finish::rough(m) };
        let fresnel = Metal::Index { n: Lanes(COPPER.0), k: Lanes(COPPER.1) };
        let model = General::Conductor(Conductor::new(fresnel, 0.9, &finish, &spectral));
        let walk = RandomWalk { slopes: Slopes::StudentT, m: [m, m] };
        let v = Cell::direction([1.0, 0.0]);
        let mut random = Random::new(17);
        let mut albedo = 0.0;
        for _ in 0..WALKS {
            let f = |c: f64| [conductor(c, f64::from(COPPER.0[0]), f64::from(COPPER.1[0]))];
            albedo += walk.reflect(v, &mut random, f).unwrap().weight[0] / f64::from(WALKS);
        }
        let found: f64 = by_model(&model, &Site::new(1.0, 1.0), v)[0].iter().sum();
        assert!((found / albedo - 1.0).abs() < 0.02, "m {m}: {found} {albedo}");
    }
}
