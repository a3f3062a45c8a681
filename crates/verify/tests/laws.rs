//! Every illumination model of the registry against the laws that it declares: each claim is checked, and for each law that it does not
//! claim a counter-example must be found.
//!
//! A new model enters by its line in the registry; its materials are the same for all.

use illuminant_illumination::{Film, Finish, Flakes, Illumination, Material, Surface};
use illuminant_optics::facets::Shape;
use illuminant_spectrum::{Curve, Outside};
use illuminant_verify::audit::{Audit, Question, audit};
use proptest::prelude::*;

fn ramp(low: f64, high: f64) -> Curve {
    Curve::new(vec![380.0, 780.0], vec![low, high], Outside::Hold).unwrap()
}

fn material(surface: Surface) -> Material {
    Material::new("one", surface)
}

/// Materials of all kinds.
fn materials() -> Vec<Material> {
    let metal = |finish: Finish| Surface::Conductor { n: ramp(1.2, 0.2), k: ramp(2.3, 4.0), finish };
    let glass = |finish: Finish| Surface::Dielectric {
        n: Curve::constant(1.5),
        finish,
        absorption: None,
        dispersion: false,
    };
    let coated = |finish: Finish, flakes: Option<Flakes>| Surface::Coated {
        n: Curve::constant(1.5),
        finish,
        film: Some(Film { absorption: ramp(10.0, 900.0), thickness: 1e-3 }),
        pigment: ramp(0.1, 0.8),
        flakes,
    };
    let flakes = Flakes { n: ramp(1.2, 0.2), k: ramp(2.3, 4.0), slope: 0.2, coverage: 0.4 };
    let low = Finish { sigma_nm: Some(60.0), ..Finish::rough(0.3) };
    [
        Surface::Diffuse { reflectance: ramp(0.2, 0.9) },
        Surface::Filter { transmittance: ramp(0.1, 0.9) },
        Surface::Translucent { reflectance: ramp(0.2, 0.7), transmittance: ramp(0.6, 0.3) },
        metal(Finish::MIRROR),
        metal(Finish::rough(0.1)),
        metal(Finish::rough(0.7)),
        metal(low),
        metal(Finish { shape: Shape::Ggx, ..Finish::rough(0.5) }),
        glass(Finish::MIRROR),
        glass(Finish::rough(0.3)),
        coated(Finish::MIRROR, None),
        coated(Finish::rough(0.2), Some(flakes)),
    ]
    .map(material)
    .into()
}

/// A law: its name, whether a model claims it, and by how much it is broken, relative to what is allowed.
fn laws(found: &Audit) -> [(&'static str, bool, f64); 4] {
    [
        ("reciprocity", found.claims.reciprocal, found.reciprocity / 1e-4),
        ("conservation", found.claims.energy_conserving, found.gain.largest / 6e-3),
        ("equilibrium", found.claims.equilibrium, found.equilibrium.largest / 6e-3),
        // Every density integrates to the chance of what it describes.
        ("normalisation", true, found.normalisation / 0.02),
    ]
}

#[test]
#[allow(clippy::print_stdout)] // the counter-examples are kept in the test's output
fn every_model_keeps_what_it_claims_and_breaks_what_it_does_not() {
    let question = Question {
        wavelengths_nm: vec![420.0, 550.0, 680.0],
        angles_deg: vec![0.0, 50.0, 80.0, 130.0, 170.0],
        draws: 10_000,
    };
    for &model in Illumination::ALL {
        let audits: Vec<(Material, Audit)> =
            materials().into_iter().map(|m| (m.clone(), audit(&m, model, &question))).collect();
        for law in 0..4 {
            let mut claimed_by_all = true;
            let mut worst = (0.0, String::new());
            for (material, found) in &audits {
                let (name, claimed, broken) = laws(found)[law];
                let told = format!("{model} {name}: {:?} {found:?}", material.surface);
                assert!(!claimed || broken <= 1.0, "{told}");
                claimed_by_all &= claimed;
                if !claimed && broken > worst.0 {
                    worst = (broken, told);
                }
            }
            // Who does not claim a law must break it somewhere, or should claim it.
            assert!(claimed_by_all || worst.0 > 1.0, "{model} could claim {}", laws(&audits[0].1)[law].0);
            if worst.0 > 1.0 {
                println!("counter-example: {}", worst.1);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// No material in range gives what is no number, and none makes light.
    #[test]
    fn random_materials_are_finite_and_make_no_light(
        kind in 0..3usize,
        along in 0.0..1.0f64,
        across in 0.0..1.0f64,
        sigma in prop_oneof![Just(None), (0.0..2000.0f64).prop_map(Some)],
        ggx in any::<bool>(),
        n in 1.05..2.5f64,
        k in 0.0..6.0f64,
        white in 0.0..1.0f64,
        angle in prop_oneof![Just(0.0), 0.0..89.0f64],
    ) {
        let finish = Finish {
            // A grain costs seconds of tables; the walk over finishes is of one slope.
            slope: if across < 0.1 { [along, across] } else { [along, along] },
            sigma_nm: sigma,
            shape: if ggx { Shape::Ggx } else { Shape::Beckmann },
        };
        let constant = Curve::constant;
        let surface = match kind {
            0 => Surface::Conductor { n: constant(n - 1.0), k: constant(k), finish },
            1 => Surface::Dielectric { n: constant(n), finish, absorption: None, dispersion: false },
            _ => Surface::Coated { n: constant(n), finish, film: None, pigment: constant(white), flakes: None },
        };
        let question = Question { wavelengths_nm: vec![550.0], angles_deg: vec![angle, 180.0 - angle], draws: 2000 };
        let found = audit(&material(surface), Illumination::General, &question);
        for shares in [&found.coherent_reflection, &found.scattered_reflection, &found.coherent_transmission, &found.scattered_transmission] {
            prop_assert!(shares.iter().flatten().all(|share| share.is_finite() && *share >= 0.0), "{found:?}");
        }
        prop_assert!(found.gain.largest < 0.03, "{found:?}");
        prop_assert!(found.weight.is_finite(), "{found:?}");
    }
}

/// The density of directions over the grid with a million draws each: `make test-slow`.
#[test]
#[ignore = "long: make test-slow"]
fn a_million_directions_have_their_density() {
    use illuminant_illumination::{Conductor, Dielectric, General, Metal, Spectral};
    use illuminant_verify::chi_square::{ChiSquare, sidak};
    use illuminant_verify::integrate::Cell;
    use illuminant_verify::site::Site;
    let spectral = Spectral::<4>::monochromatic(550.0);
    let slopes = [0.05, 0.2, 0.5, 1.0];
    let heights = [None, Some(80.0)];
    let angles = [0.0f64, 40.0, 75.0, 120.0, 150.0];
    let significance = sidak(0.01, slopes.len() * heights.len() * (3 + angles.len()));
    for m in slopes {
        for sigma_nm in heights {
            let finish = Finish { sigma_nm, ..Finish::rough(m) };
            let metal = General::Conductor(Conductor::new(Metal::Perfect, 1.0, &finish, &spectral));
            let glass = General::Dielectric(Dielectric::new(false, &finish, &spectral));
            for (model, site, angles) in
                [(&metal, Site::new(1.0, 1.0), &angles[..3]), (&glass, Site::new(1.0, 1.5), &angles[..])]
            {
                for &theta in angles {
                    let test = ChiSquare { samples: 1_000_000, seed: 5, ..ChiSquare::default() };
                    let outcome = test.run_model(model, &site, Cell::direction([theta.to_radians(), 0.7]));
                    assert!(
                        outcome.passes(significance),
                        "m {m} sigma {sigma_nm:?} theta {theta}: {outcome:?}"
                    );
                }
            }
        }
    }
}
