//! Every illumination model of every kind of surface, with finishes and indices at the ends of their ranges.
#![no_main]

use illuminant_fuzz::{Bytes, density, unit};
use illuminant_illumination::{
    Film, Finish, Flakes, General, Historic, Illumination, IlluminationModel, Incidence, Index, Material,
    Prepare, Surface,
};
use illuminant_optics::facets::Shape;
use illuminant_sampling::{Lanes, Uniform};
use illuminant_spectrum::{Curve, SpectralRange};
use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};
use std::cell::RefCell;

const N: usize = 4;

fn curve(b: &mut Bytes<'_>, low: f64, high: f64) -> Curve {
    let value = match b.byte() % 4 {
        0 => low,
        1 => high,
        _ => b.between(low, high),
    };
    Curve::constant(value)
}

fn finish(b: &mut Bytes<'_>) -> Finish {
    // Scene files have no rougher ones; tables of a slope of 3 take half a minute.
    let slope = [b.positive(), b.positive()].map(|m| f64::from(m).min(1.0));
    let sigma_nm = (b.byte() & 1 == 1).then(|| f64::from(b.positive()).min(1e5));
    Finish { slope, sigma_nm, shape: if b.byte() & 1 == 1 { Shape::Ggx } else { Shape::Beckmann } }
}

fn surface(b: &mut Bytes<'_>) -> Surface {
    match b.byte() % 6 {
        0 => Surface::Diffuse { reflectance: curve(b, 0.0, 1.0) },
        1 => Surface::Conductor { n: curve(b, 0.01, 20.0), k: curve(b, 0.0, 30.0), finish: finish(b) },
        2 => Surface::Filter { transmittance: curve(b, 0.0, 1.0) },
        3 => Surface::Translucent { reflectance: curve(b, 0.0, 0.5), transmittance: curve(b, 0.0, 0.5) },
        4 => Surface::Dielectric {
            n: curve(b, 1.0, 4.0),
            finish: finish(b),
            absorption: None,
            dispersion: b.byte() & 1 == 1,
        },
        _ => Surface::Coated {
            n: curve(b, 1.0, 4.0),
            finish: finish(b),
            film: (b.byte() & 1 == 1).then(|| Film {
                absorption: curve(b, 0.0, 1e9),
                thickness: f64::from(b.positive()).min(1.0),
            }),
            pigment: curve(b, 0.0, 1.0),
            flakes: (b.byte() & 1 == 1).then(|| Flakes {
                n: curve(b, 0.01, 20.0),
                k: curve(b, 0.0, 30.0),
                slope: f64::from(b.positive()).clamp(0.0, 1.0),
                coverage: b.between(0.0, 1.0),
            }),
        },
    }
}

fn numbers(lanes: &Lanes<N>, what: &str) {
    assert!((0..N).all(|i| lanes[i].is_finite() && lanes[i] >= -1e-3), "{what}: {lanes:?}");
}

/// What asks a prepared model so many questions as the bytes hold.
type Asks = Box<dyn Fn(&mut Bytes<'_>)>;

fn prepared<M: IlluminationModel<N> + Prepare + 'static>(
    material: &Material,
    model: Illumination,
    b: &mut Bytes<'_>,
) -> Asks {
    let range = SpectralRange::default();
    let basis = Uniform::new(N, range);
    let brightness = material.brightness(range) as f32;
    let prepared = M::prepare(material, model, brightness, &basis, 0..N, range);
    let (near, far) = (b.between(1.0, 3.0) as f32, b.between(1.0, 3.0) as f32);
    Box::new(move |b| ask(&prepared, near, far, b))
}

fn ask<M: IlluminationModel<N>>(prepared: &M, near: f32, far: f32, b: &mut Bytes<'_>) {
    let lanes = [Lanes::splat(near), Lanes::splat(far)];
    let index = |mean: f32, lanes| Index { mean, least: mean, lanes };
    for _ in 0..64 {
        if b.is_empty() {
            return;
        }
        let mut to_viewer = b.above();
        if b.byte() & 1 == 1 {
            to_viewer.z = -to_viewer.z;
        }
        let hero_lane = (b.byte() & 7 == 7).then_some(1);
        let at = Incidence { to_viewer, near: index(near, &lanes[0]), far: index(far, &lanes[1]), hero_lane };
        let to_light = b.direction();
        // A highlight of a nearly smooth surface may be above what single precision holds: such samples are dropped.
        let f = prepared.eval(&at, to_light);
        assert!((0..N).all(|i| f[i] >= -1e-3), "eval of {f:?}");
        density(prepared.pdf(&at, to_light));
        numbers(&prepared.ambient(&at).diffuse, "ambient");
        let u = [b.unit(), b.unit(), b.unit()];
        for drawn in [prepared.sample(&at, u, Some(1)), prepared.gloss_ray(&at, u)].into_iter().flatten() {
            unit(drawn.direction);
            numbers(&drawn.weight, "weight");
            density(drawn.brightness);
            density(drawn.pdf.unwrap_or(0.0));
        }
        for lobe in prepared.discrete_lobes(&at) {
            unit(lobe.direction);
            numbers(&lobe.weight, "lobe");
        }
        numbers(&prepared.see_through(&at), "seen through");
    }
}

/// The bytes that make the material and its model; the others are questions.
const MATERIAL: usize = 96;

/// Models that are kept, since to prepare one takes a thousand times as long as to ask it.
const KEPT: usize = 64;

thread_local! {
    static MODELS: RefCell<Vec<(Vec<u8>, Asks)>> = const { RefCell::new(Vec::new()) };
}

fn model_of(head: &[u8]) -> Asks {
    let mut b = Bytes(head);
    let material = Material::new("m", surface(&mut b));
    let models = Illumination::ALL;
    let model = models[usize::from(b.byte()) % models.len()];
    if model == Illumination::General {
        prepared::<General<N>>(&material, model, &mut b)
    } else {
        prepared::<Historic<N>>(&material, model, &mut b)
    }
}

fuzz_target!(|data: &[u8]| {
    let (head, questions) = data.split_at(data.len().min(MATERIAL));
    MODELS.with_borrow_mut(|models| {
        let at = models.iter().position(|(of, _)| of == head).unwrap_or_else(|| {
            if models.len() == KEPT {
                models.remove(0);
            }
            models.push((head.to_vec(), model_of(head)));
            models.len() - 1
        });
        // The first is the one that was not asked for the longest time.
        let asked = models.remove(at);
        (asked.1)(&mut Bytes(questions));
        models.push(asked);
    });
});

// Sixteen times as many questions as materials.
fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    if size > MATERIAL && seed % 16 != 0 {
        MATERIAL + fuzzer_mutate(&mut data[MATERIAL..], size - MATERIAL, max_size - MATERIAL)
    } else {
        let changed = fuzzer_mutate(data, size, max_size);
        // Long enough for questions.
        let wanted = (MATERIAL + 64).min(max_size);
        data[changed.min(wanted)..wanted].fill(seed as u8);
        changed.max(wanted)
    }
});
