//! What a user should know before rendering a scene with a spectral sampling.

use illuminant_color::{Lab, delta_e_2000};
use illuminant_illumination::Surface;
use illuminant_sampling::{Basis, Role, white_of, xyz_by};
use illuminant_scene::Scene;
use illuminant_spectrum::{Curve, Observer};

/// A lamp whose white is off by more than this ΔE00 is worth a word.
const VISIBLE: f64 = 1.0;

/// The sentences.
pub(crate) fn warnings(scene: &Scene, basis: &dyn Basis, sampling: &str) -> Vec<String> {
    let mut found: Vec<String> = too_fine(scene, basis, sampling).into_iter().collect();
    if !basis.is_spectral() {
        found.push(format!(
            "{sampling} multiplies colours instead of spectra, to show what that does; fitted:8 is right and as fast"
        ));
        let kinds = scene.materials.iter().map(|material| &material.surface);
        if kinds.clone().any(|s| matches!(s, Surface::Conductor { .. })) {
            found.push(format!(
                "{sampling} knows of a conductor its colour at normal incidence alone, and bends that towards white by \
                 Cook's interpolation"
            ));
        }
        if kinds.clone().any(|s| matches!(s, Surface::Dielectric { dispersion: true, .. })) {
            found.push(format!("{sampling} has no wavelengths to disperse: every prism is colourless"));
        }
    }
    if scene.lamps.iter().all(|l| Observer::cie_1931_2deg().luminance(&l.spectrum, scene.range) <= 0.0) {
        found.push(format!(
            "the observer sees nothing of the light over {}–{} nm: at 1nm the image is black, and what a coarser sampling \
             shows is its own error; the spectra alone say something",
            scene.range.min_nm, scene.range.max_nm
        ));
    }
    if !scene.sees_anything() {
        found.push("the camera sees nothing: no object lies in its view, and there is no environment".into());
    }
    found
}

/// The lamps whose white the sampling misses, in one sentence however many they are.
fn too_fine(scene: &Scene, basis: &dyn Basis, sampling: &str) -> Option<String> {
    let mut missed = Vec::new();
    let mut worst = 0.0f64;
    // Lamps of one kind often follow each other.
    let mut last: Option<(&Curve, f64)> = None;
    for (lamp, data) in scene.lamps.iter().enumerate() {
        let off = match last {
            Some((curve, off)) if *curve == data.spectrum => off,
            _ => white_off(scene, basis, lamp),
        };
        last = Some((&data.spectrum, off));
        if off > VISIBLE {
            missed.push(&data.name);
            worst = worst.max(off);
        }
    }
    let advice = "use fitted:8 or 1nm";
    match missed[..] {
        [] => None,
        [name] => Some(format!(
            "lamp {name:?} has a spectrum too fine for {sampling} (its white is off by ΔE00 {worst:.1}); {advice}"
        )),
        [first, ..] => Some(format!(
            "lamp {first:?} and {} more have spectra too fine for {sampling} (their whites are off by up to ΔE00 \
             {worst:.1}); {advice}",
            missed.len() - 1
        )),
    }
}

/// ΔE00 between the white of a lamp and what the sampling makes of it; 0 for a lamp that the observer does not see.
fn white_off(scene: &Scene, basis: &dyn Basis, lamp: usize) -> f64 {
    let spectrum = &scene.lamps[lamp].spectrum;
    let exact = Observer::cie_1931_2deg().xyz(spectrum, scene.range);
    if exact[1] <= 0.0 {
        return 0.0;
    }
    let light = basis.reduce(spectrum, Role::Emission);
    let sampled = xyz_by(&basis.to_xyz(lamp), &light);
    let white = white_of(exact);
    delta_e_2000(Lab::from_xyz(exact, white), Lab::from_xyz(sampled, white))
}
