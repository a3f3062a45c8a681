//! `optics`: the closed forms of a surface, over arrays.

use illuminant_optics::distribution::{Distribution, ggx_alpha};
use illuminant_optics::facets::{Facets, Shape};
use illuminant_optics::hosek_wilkie::{self, HosekWilkie};
use illuminant_optics::{
    dispersion, fresnel, masking, roughness, saunderson, solid_angle, vectors, wave_optics,
};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

type Function = fn(&[f64]) -> f64;

/// The Λ of Smith for slopes m and a cosine.
fn lambda(shape: Shape, cos: f64, m: f64) -> f64 {
    Facets::isotropic(shape, m).lambda([vectors::sine(cos), 0.0, cos])
}

/// The density of facets at the cosine of H and the slopes along and across, with the azimuth of H.
fn facets(shape: Shape, x: &[f64]) -> f64 {
    let (sin, cos) = x[1].sin_cos();
    let r = vectors::sine(x[0]);
    Facets { shape, slope: [x[2], x[3]] }.distribution([r * cos, r * sin, x[0]])
}

/// A distribution in terms of N·H (for Phong, R·L).
fn scaled(distribution: Distribution, x: &[f64]) -> f64 {
    let (normal, up) = ([0.0, 0.0, 1.0], x[0].clamp(-1.0, 1.0));
    let h = [vectors::sine(up), 0.0, up];
    if distribution == Distribution::Phong {
        return distribution.value(normal, [-h[0], 0.0, h[2]], normal, x[1]);
    }
    distribution.value(normal, h, h, x[1])
}

/// The functions of numbers, with how many they take.
fn function(name: &str) -> Option<(usize, Function)> {
    Some(match name {
        "dielectric" => (2, |x| fresnel::dielectric(x[0], x[1])),
        "dielectric_parallel" => (2, |x| fresnel::dielectric_polarised(x[0], x[1])[0]),
        "dielectric_perpendicular" => (2, |x| fresnel::dielectric_polarised(x[0], x[1])[1]),
        "conductor" => (3, |x| fresnel::conductor(x[0], x[1], x[2])),
        "conductor_parallel" => {
            (3, |x| fresnel::amplitudes(x[0], num_complex::Complex::new(x[1], x[2])).r_parallel.norm_sqr())
        }
        "conductor_perpendicular" => (3, |x| {
            fresnel::amplitudes(x[0], num_complex::Complex::new(x[1], x[2])).r_perpendicular.norm_sqr()
        }),
        "conductor_approximated" => (3, |x| {
            let [a, b] = fresnel::conductor_approximated(x[0], x[1], x[2]);
            0.5 * (a + b)
        }),
        "interpolated" => (3, |x| fresnel::interpolated(x[0], x[1], x[2])),
        "normal_reflectance" => (2, |x| fresnel::normal_reflectance(x[0], x[1])),
        "index_of_reflectance" => (1, |x| fresnel::index_of_reflectance(x[0])),
        "extinction_of_reflectance" => (1, |x| fresnel::extinction_of_reflectance(x[0])),
        "pseudo_material" => (2, |x| fresnel::pseudo_material(x[0], x[1])),
        "sky" => (6, |x| {
            HosekWilkie::new(x[0], x[1], x[2]).map_or(f64::NAN, |sky| sky.radiance(x[3].cos(), x[4], x[5]))
        }),
        "sun" => (4, |x| {
            HosekWilkie::new(x[0], 0.0, 0.0)
                .map_or(f64::NAN, |sky| hosek_wilkie::at(&sky.sun_radiances(x[1], x[2]), x[3]))
        }),
        "disc" => (2, |x| solid_angle::disc(x[0], x[1])),
        "disc_error" => (1, |x| solid_angle::disc_error(x[0])),
        "irradiance" => (3, |x| solid_angle::irradiance(x[0], x[1], x[2])),
        "slope" => (2, |x| roughness::slope(x[0], x[1])),
        "correlation_distance" => (2, |x| roughness::correlation_distance(x[0], x[1])),
        "apparent_roughness" => (4, |x| roughness::apparent_roughness(x[0], x[1], x[2], x[3])),
        "apparent_roughness_transmitted" => {
            (6, |x| roughness::apparent_roughness_transmitted(x[0], x[1], [x[2], x[3]], [x[4], x[5]]))
        }
        "torrance_sparrow" => (3, |x| {
            // Light and view elevations in radians, and the azimuth between them.
            let at = |theta: f64, phi: f64| [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()];
            masking::torrance_sparrow([0.0, 0.0, 1.0], at(x[0], 0.0), at(x[1], x[2]))
        }),
        "sancer" => (3, |x| {
            let m2 = x[2] * x[2];
            if x[0] <= 0.0 || x[1] <= 0.0 {
                return 0.0;
            }
            1.0 / (1.0 + masking::sancer_term(x[0], m2) + masking::sancer_term(x[1], m2))
        }),
        "smith_lambda_beckmann" => (2, |x| lambda(Shape::Beckmann, x[0], x[1])),
        "smith_lambda_ggx" => (2, |x| lambda(Shape::Ggx, x[0], x[1])),
        "beckmann" => (4, |x| facets(Shape::Beckmann, x)),
        "ggx" => (4, |x| facets(Shape::Ggx, x)),
        "phong_distribution" => (2, |x| scaled(Distribution::Phong, x)),
        "blinn_distribution" => (2, |x| scaled(Distribution::Blinn, x)),
        "gaussian_distribution" => (2, |x| scaled(Distribution::Gaussian, x)),
        "trowbridge_reitz_distribution" => (2, |x| scaled(Distribution::TrowbridgeReitz, x)),
        "cook_distribution" => (2, |x| scaled(Distribution::Cook, x)),
        "phong_coefficient" => (1, |x| Distribution::Phong.coefficient(x[0])),
        "blinn_coefficient" => (1, |x| Distribution::Blinn.coefficient(x[0])),
        "gaussian_coefficient" => (1, |x| Distribution::Gaussian.coefficient(x[0])),
        "trowbridge_reitz_coefficient" => (1, |x| Distribution::TrowbridgeReitz.coefficient(x[0])),
        "cook_coefficient" => (1, |x| Distribution::Cook.coefficient(x[0])),
        "phong_half_angle" => (1, |x| Distribution::Phong.half_angle(x[0])),
        "blinn_half_angle" => (1, |x| Distribution::Blinn.half_angle(x[0])),
        "gaussian_half_angle" => (1, |x| Distribution::Gaussian.half_angle(x[0])),
        "trowbridge_reitz_half_angle" => (1, |x| Distribution::TrowbridgeReitz.half_angle(x[0])),
        "cook_half_angle" => (1, |x| Distribution::Cook.half_angle(x[0])),
        "specular_energy" => (1, |x| illuminant_illumination::specular_and_diffuse_energy(x[0])[0]),
        "ggx_alpha" => (1, |x| ggx_alpha(x[0])),
        "wave_series" => (3, |x| wave_optics::series(x[0], x[1], x[2])),
        "wave_blended" => (3, |x| {
            let phase = x[2] * (1.0 - x[0] * x[0]) / (x[0] * x[0] * x[1] * x[1]);
            wave_optics::blended(x[0], x[1], x[2], phase)
        }),
        "abbe_number" => (3, |x| dispersion::abbe_number(x[0], x[1], x[2])),
        "diffuse_reflectance" => (1, |x| saunderson::diffuse_reflectance(x[0])),
        "internal_reflectance" => (1, |x| saunderson::internal_reflectance(x[0])),
        "paint" => (2, |x| saunderson::paint(x[0], x[1])),
        "pigment" => (2, |x| saunderson::pigment(x[0], x[1])),
        _ => return None,
    })
}

/// A function of this room by name, for each row of arrays of one length.
#[pyfunction]
fn optics<'py>(
    py: Python<'py>,
    name: &str,
    arguments: Vec<PyReadonlyArray1<'py, f64>>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (count, function) = function(name)
        .ok_or_else(|| PyValueError::new_err(format!("there is no function {name:?} of optics")))?;
    let views: Vec<_> = arguments.iter().map(PyReadonlyArray1::as_array).collect();
    let length = views.first().map_or(0, |view| view.len());
    if views.len() != count || views.iter().any(|view| view.len() != length) {
        return Err(PyValueError::new_err(format!("{name} takes {count} arrays of one length")));
    }
    let mut row = vec![0.0; count];
    let result = (0..length).map(|i| {
        for (value, view) in row.iter_mut().zip(&views) {
            *value = view[i];
        }
        function(&row)
    });
    let result: Vec<f64> = result.collect();
    Ok(PyArray1::from_vec(py, result))
}

/// The heights of a rough profile.
#[pyfunction]
fn rough_profile(
    py: Python<'_>,
    count: usize,
    spacing: f64,
    sigma: f64,
    tau: f64,
    seed: u64,
) -> Bound<'_, PyArray1<f64>> {
    PyArray1::from_vec(py, roughness::profile(count, spacing, sigma, tau, seed))
}

/// The lines by which glasses are measured, in nm.
#[pyfunction]
fn fraunhofer_lines() -> Vec<(&'static str, f64)> {
    dispersion::FRAUNHOFER_NM.to_vec()
}

/// The index of Sellmeier's formula at wavelengths in nm; NaN at a resonance.
#[pyfunction]
fn sellmeier(terms: Vec<(f64, f64)>, wavelengths_nm: Vec<f64>) -> Vec<f64> {
    wavelengths_nm.into_iter().map(|nm| dispersion::sellmeier(&terms, nm).unwrap_or(f64::NAN)).collect()
}

/// The index of Cauchy's formula at wavelengths in nm.
#[pyfunction]
fn cauchy(coefficients: Vec<f64>, wavelengths_nm: Vec<f64>) -> Vec<f64> {
    wavelengths_nm.into_iter().map(|nm| dispersion::cauchy(&coefficients, nm)).collect()
}

/// N_s of the copper spheres of book figure II.5, and C_Kd and C_Ks without and with a reflection map.
#[pyfunction]
fn copper_spheres() -> Vec<(f64, [f64; 2], [f64; 2])> {
    illuminant_illumination::COPPER_SPHERES.to_vec()
}

pub(crate) fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(optics, m)?)?;
    m.add_function(wrap_pyfunction!(copper_spheres, m)?)?;
    m.add_function(wrap_pyfunction!(rough_profile, m)?)?;
    m.add_function(wrap_pyfunction!(fraunhofer_lines, m)?)?;
    m.add_function(wrap_pyfunction!(sellmeier, m)?)?;
    m.add_function(wrap_pyfunction!(cauchy, m)?)
}
