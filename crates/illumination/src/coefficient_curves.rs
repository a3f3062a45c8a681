//! How a material becomes the coefficients of a historical model: one rule for all (book II.1.4, II.1.5), which a scene may override.
//!
//! | material | ambient and diffuse | specular | transmitted |
//! | --- | --- | --- | --- |
//! | diffuser | its reflectance | none | none |
//! | metal | C_Kd F₀ | F₀ times C_Ks | none |
//! | filter | none | none | its transmittance, without bending |
//! | glass | none | F₀ of its index | 1 − F₀ |
//! | vehicle over pigment | what leaves the body (Saunderson), film included | F₀ of the vehicle, and of flakes through it | none |
//!
//! The angle β of the highlight is that of Beckmann's distribution with the material's slope, but not below
//! [`SHARPEST_BETA`]. A metal's multipliers are those of the copper spheres of book figure II.5 for that width: the upper rows for
//! models that ask lamps alone, the lower ones (made with a reflection map) for those that follow rays; `cook-torrance` takes the
//! division of energy of figure II.3. As their authors had it, K_s of `phong` and `whitted` has no colour.

use crate::{Coefficients, Highlight, Illumination, Masking, Material, REPRESENTATIVE_NM, Samples, Surface};
use illuminant_optics::distribution::Distribution;
use illuminant_optics::fresnel::{conductor, dielectric, normal_reflectance};
use illuminant_optics::masking::torrance_sparrow;
use illuminant_optics::saunderson;
use illuminant_spectrum::{Curve, Outside, SpectralRange};
use std::f64::consts::{FRAC_PI_2, PI};

/// β of the sharpest sphere of book figure II.5, N_s = 330, radians.
pub const SHARPEST_BETA: f64 = 0.064_8;

/// N_s of book figure II.5, sharpest first, and C_Kd and C_Ks without and with a reflection map.
pub const COPPER_SPHERES: [(f64, [f64; 2], [f64; 2]); 10] = [
    (330.0, [0.35, 0.95], [0.025, 0.95]),
    (215.0, [0.35, 0.85], [0.05, 0.90]),
    (135.0, [0.35, 0.75], [0.075, 0.80]),
    (80.0, [0.36, 0.65], [0.1, 0.70]),
    (45.0, [0.37, 0.55], [0.125, 0.65]),
    (25.0, [0.385, 0.45], [0.15, 0.60]),
    (15.0, [0.40, 0.35], [0.175, 0.55]),
    (10.0, [0.43, 0.25], [0.2, 0.50]),
    (7.0, [0.46, 0.15], [0.225, 0.45]),
    (5.0, [0.50, 0.05], [0.25, 0.40]),
];

/// What a scene says of a material for one historical model or for all, in place of the rule.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overrides {
    /// The model; `None` for all.
    pub model: Option<Illumination>,
    /// C_Ka.
    pub ambient: Option<f64>,
    /// C_Kd.
    pub diffuse: Option<f64>,
    /// C_Ks.
    pub specular: Option<f64>,
    /// C_Kt.
    pub transmitted: Option<f64>,
    /// K_a and K_d.
    pub diffuse_curve: Option<Curve>,
    /// K_s.
    pub specular_curve: Option<Curve>,
    /// K_t.
    pub transmitted_curve: Option<Curve>,
    /// Half-width β of the highlight, radians.
    pub beta: Option<f64>,
    /// N_s, C₁, C₂² or m² of the distribution, instead of β.
    pub coefficient: Option<f64>,
    /// The distribution of facets.
    pub distribution: Option<Distribution>,
    /// Their masking; of [`Masking::Sancer`] the m² is that of β.
    pub masking: Option<Masking>,
    /// p of (N·L)^p.
    pub terminator: Option<f64>,
}

/// The coefficients of a material for one model, as curves with their multipliers.
#[derive(Clone, Debug)]
pub struct CoefficientCurves {
    /// C_Ka.
    pub ambient_scale: f64,
    /// C_Kd.
    pub diffuse_scale: f64,
    /// K_a and K_d.
    pub diffuse: Curve,
    /// C_Ks.
    pub specular_scale: f64,
    /// K_s.
    pub specular: Curve,
    /// C_Kt.
    pub transmitted_scale: f64,
    /// K_t.
    pub transmitted: Curve,
    /// The highlight.
    pub highlight: Highlight,
    /// n and k of a conductor, means over wavelength.
    pub conductor: Option<[f64; 2]>,
    /// Index of a dielectric, and of a vehicle.
    pub index: f64,
    /// Whether light passes.
    pub transparent: bool,
    /// p of (N·L)^p.
    pub terminator: f64,
}

fn mean(curve: &Curve, range: SpectralRange) -> f64 {
    curve.area(range) / range.width_nm()
}

fn tabulate(range: SpectralRange, f: impl Fn(f64) -> f64) -> Curve {
    Curve::tabulated(range, range.wavelengths().map(f).collect(), Outside::Hold)
}

/// C_Kd and C_Ks of metal between the spheres of figure II.5, by the logarithm of N_s.
fn metal_multipliers(exponent: f64, follows_rays: bool) -> [f64; 2] {
    let of = |i: usize| if follows_rays { COPPER_SPHERES[i].2 } else { COPPER_SPHERES[i].1 };
    let last = COPPER_SPHERES.len() - 1;
    let at = COPPER_SPHERES.iter().position(|sphere| exponent >= sphere.0);
    match at {
        Some(0) => of(0),
        None => of(last),
        Some(i) => {
            let [high, low] = [COPPER_SPHERES[i - 1].0, COPPER_SPHERES[i].0];
            let t = (exponent / low).ln() / (high / low).ln();
            std::array::from_fn(|c| of(i)[c] + t * (of(i - 1)[c] - of(i)[c]))
        }
    }
}

/// How the energy of a perfect reflector is divided by the angle β (book figure II.3): the hemispherical integral at normal
/// incidence of the function of Cook and Torrance with F = 1 and V-grooves, and the rest.
///
/// ```
/// use illuminant_illumination::specular_and_diffuse_energy;
/// let [sharp, wide] = [0.05, 0.8].map(specular_and_diffuse_energy);
/// assert!(sharp[0] > 0.99 && sharp[0] > wide[0] && wide[0] + wide[1] == 1.0);
/// ```
#[must_use]
pub fn specular_and_diffuse_energy(beta: f64) -> [f64; 2] {
    const STEPS: usize = 2000;
    let m2 = Distribution::Cook.coefficient(beta.clamp(1e-4, FRAC_PI_2 - 1e-6));
    let n = [0.0, 0.0, 1.0];
    let mut sum = 0.0;
    for i in 0..STEPS {
        // H at the angle a is seen at 2a; finer near the normal.
        let t = (i as f64 + 0.5) / STEPS as f64;
        let half = FRAC_PI_2 / 2.0 * t * t;
        let width = FRAC_PI_2 / STEPS as f64 * t;
        let (sin, cos) = (2.0 * half).sin_cos();
        let l = [sin, 0.0, cos];
        // ∫ D G / (cos θ_i cos θ_r) cos θ_r dω with dω = 2π sin θ dθ.
        let value = Distribution::Cook.value(n, l, n, m2) * torrance_sparrow(n, l, n);
        sum += value * 2.0 * PI * sin * 2.0 * width;
    }
    let specular = sum.clamp(0.0, 1.0);
    [specular, 1.0 - specular]
}

impl Illumination {
    /// The distribution with which the model was published.
    fn own_distribution(self) -> Distribution {
        match self {
            Self::Phong => Distribution::Phong,
            Self::Blinn => Distribution::TrowbridgeReitz,
            Self::CookTorrance => Distribution::Cook,
            _ => Distribution::Blinn,
        }
    }

    /// The masking with which it was published.
    fn own_masking(self) -> Masking {
        match self {
            Self::Blinn | Self::CookTorrance => Masking::TorranceSparrow,
            _ => Masking::None,
        }
    }
}

impl CoefficientCurves {
    /// The rule of this file, with what the material overrides.
    ///
    /// ```
    /// use illuminant_illumination::{CoefficientCurves, Illumination, Material, Surface};
    /// use illuminant_spectrum::{Curve, SpectralRange};
    /// let paint = Material::new("grey", Surface::Diffuse { reflectance: Curve::constant(0.4) });
    /// let found = CoefficientCurves::new(&paint, Illumination::Phong, SpectralRange::default());
    /// assert_eq!((found.diffuse.at(550.0), found.diffuse_scale, found.specular_scale), (0.4, 1.0, 0.0));
    /// ```
    #[must_use]
    pub fn new(material: &Material, model: Illumination, range: SpectralRange) -> Self {
        let beta = Distribution::Cook.half_angle(material.slope().powi(2)).max(SHARPEST_BETA);
        let mut found = Self::by_rule(&material.surface, model, range, beta);
        if matches!(model, Illumination::Phong | Illumination::Whitted) {
            found.specular = Curve::constant(mean(&found.specular, range));
        }
        // What is said of all models comes first, so that what is said of this one wins.
        let mut beta = beta;
        for told in [None, Some(model)] {
            for over in material.overrides.iter().filter(|over| over.model == told) {
                beta = found.take(over, beta);
            }
        }
        found
    }

    fn by_rule(surface: &Surface, model: Illumination, range: SpectralRange, beta: f64) -> Self {
        let nothing = || Curve::constant(0.0);
        let bare = Self {
            ambient_scale: 1.0,
            diffuse_scale: 1.0,
            diffuse: nothing(),
            specular_scale: 0.0,
            specular: nothing(),
            transmitted_scale: 1.0,
            transmitted: nothing(),
            highlight: Highlight::new(model.own_distribution(), beta, model.own_masking()),
            conductor: None,
            index: 1.0,
            transparent: false,
            terminator: 1.0,
        };
        match surface {
            // No historical model scatters light to the other side.
            Surface::Diffuse { reflectance } | Surface::Translucent { reflectance, .. } => {
                Self { diffuse: reflectance.clone(), ..bare }
            }
            Surface::Filter { transmittance } => {
                Self { transmitted: transmittance.clone(), transparent: true, ..bare }
            }
            Surface::Conductor { n, k, .. } => {
                let normal = tabulate(range, |w| conductor(1.0, n.at(w), k.at(w)));
                let [diffuse, specular] = if model == Illumination::CookTorrance {
                    let [specular, diffuse] = specular_and_diffuse_energy(beta);
                    [diffuse, specular]
                } else {
                    metal_multipliers(Distribution::Blinn.coefficient(beta), model.follows_rays())
                };
                // Of ambient light an energy model returns all that the metal does: K_a = M (book eq 4.22).
                let ambient = if model == Illumination::CookTorrance { 1.0 } else { diffuse };
                Self {
                    ambient_scale: ambient,
                    diffuse_scale: diffuse,
                    diffuse: normal.clone(),
                    specular_scale: specular,
                    specular: normal,
                    conductor: Some([mean(n, range), mean(k, range)]),
                    ..bare
                }
            }
            Surface::Dielectric { n, dispersion, .. } => {
                let index = |w: f64| n.at(if *dispersion { w } else { REPRESENTATIVE_NM });
                let normal = tabulate(range, |w| normal_reflectance(index(w), 0.0));
                let through = tabulate(range, |w| 1.0 - normal_reflectance(index(w), 0.0));
                Self {
                    specular_scale: 1.0,
                    specular: normal,
                    transmitted: through,
                    index: n.at(REPRESENTATIVE_NM),
                    transparent: true,
                    ..bare
                }
            }
            Surface::Coated { n, film, pigment, flakes, .. } => {
                let eta = n.at(REPRESENTATIVE_NM);
                let surface = dielectric(1.0, eta);
                let kept =
                    |w: f64| film.as_ref().map_or(1.0, |f| (-2.0 * f.absorption.at(w) * f.thickness).exp());
                let covered = flakes.as_ref().map_or(0.0, |f| f.coverage);
                let body =
                    |w: f64| (saunderson::paint(pigment.at(w), eta) - surface) * kept(w) * (1.0 - covered);
                let metal = |w: f64| {
                    let Some(flakes) = flakes else { return 0.0 };
                    covered
                        * (1.0 - surface).powi(2)
                        * kept(w)
                        * conductor(1.0, flakes.n.at(w), flakes.k.at(w))
                };
                Self {
                    diffuse: tabulate(range, body),
                    specular_scale: 1.0,
                    specular: tabulate(range, |w| surface + metal(w)),
                    index: eta,
                    ..bare
                }
            }
        }
    }

    /// Takes what is overridden; the width of the highlight before and after.
    fn take(&mut self, over: &Overrides, beta: f64) -> f64 {
        let set = |slot: &mut f64, value: Option<f64>| *slot = value.unwrap_or(*slot);
        set(&mut self.ambient_scale, over.ambient);
        set(&mut self.diffuse_scale, over.diffuse);
        set(&mut self.specular_scale, over.specular);
        set(&mut self.transmitted_scale, over.transmitted);
        set(&mut self.terminator, over.terminator);
        let put = |slot: &mut Curve, curve: &Option<Curve>| {
            if let Some(curve) = curve {
                *slot = curve.clone();
            }
        };
        put(&mut self.diffuse, &over.diffuse_curve);
        put(&mut self.specular, &over.specular_curve);
        put(&mut self.transmitted, &over.transmitted_curve);
        self.transparent |= over.transmitted_curve.is_some();
        let distribution = over.distribution.unwrap_or(self.highlight.distribution);
        let mut beta = over.beta.unwrap_or(beta);
        if over.distribution.is_some() || over.beta.is_some() {
            self.highlight = Highlight::new(distribution, beta, self.highlight.masking);
        }
        if let Some(coefficient) = over.coefficient {
            self.highlight.coefficient = coefficient;
            beta = distribution.half_angle(coefficient);
        }
        // Facets of a Gaussian surface are hidden by the slope of the highlight.
        self.highlight.masking = match over.masking.unwrap_or(self.highlight.masking) {
            Masking::Sancer(_) => Masking::Sancer(Distribution::Cook.coefficient(beta)),
            masking => masking,
        };
        beta
    }

    /// The coefficients by what reduces a curve to samples.
    pub fn reduce<S: Samples>(&self, reduce: impl Fn(&Curve) -> S) -> Coefficients<S> {
        let diffuse = reduce(&self.diffuse);
        Coefficients {
            ambient: diffuse.times(self.ambient_scale),
            diffuse: diffuse.times(self.diffuse_scale),
            specular: reduce(&self.specular),
            specular_scale: self.specular_scale,
            transmitted: reduce(&self.transmitted).times(self.transmitted_scale),
            highlight: self.highlight,
            // The rise with the angle is that of the mean material, from what that itself reflects.
            mean_reflectance: self
                .conductor
                .map_or_else(|| normal_reflectance(self.index, 0.0), |[n, k]| normal_reflectance(n, k)),
            conductor: self.conductor,
            transparent: self.transparent,
            terminator: self.terminator,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn metal_takes_the_multipliers_of_the_copper_spheres() {
        assert_eq!(metal_multipliers(1000.0, false), [0.35, 0.95]);
        assert_eq!(metal_multipliers(80.0, true), [0.1, 0.70]);
        assert_eq!(metal_multipliers(1.0, true), [0.25, 0.40]);
        let [diffuse, specular] = metal_multipliers(100.0, false);
        assert!(diffuse > 0.35 && diffuse < 0.36 && specular > 0.65 && specular < 0.75);
        assert!((Distribution::Blinn.coefficient(SHARPEST_BETA) - 330.0).abs() < 0.5);
    }

    #[test]
    fn what_is_said_of_a_model_wins_over_what_is_said_of_all() {
        let surface = Surface::Diffuse { reflectance: Curve::constant(0.4) };
        let own = Overrides {
            model: Some(Illumination::Phong),
            specular: Some(0.3),
            distribution: Some(Distribution::Gaussian),
            ..Overrides::default()
        };
        let all = Overrides {
            specular: Some(0.7),
            diffuse: Some(0.5),
            coefficient: Some(80.0),
            masking: Some(Masking::Sancer(0.0)),
            ..Overrides::default()
        };
        // In any order.
        let material = Material { overrides: vec![own, all], ..Material::new("m", surface) };
        let of = |model| CoefficientCurves::new(&material, model, SpectralRange::default());
        let [phong, whitted] = [Illumination::Phong, Illumination::Whitted].map(of);
        assert_eq!((phong.specular_scale, phong.diffuse_scale), (0.3, 0.5));
        assert_eq!((whitted.specular_scale, whitted.diffuse_scale), (0.7, 0.5));
        assert_eq!(whitted.highlight.coefficient, 80.0);
        // The width that the exponent gave stays when another distribution takes its place, and gives the slope of the masking.
        let beta = Distribution::Phong.half_angle(80.0);
        assert!((Distribution::Gaussian.half_angle(phong.highlight.coefficient) - beta).abs() < 1e-9);
        assert_eq!(phong.highlight.masking, Masking::Sancer(Distribution::Cook.coefficient(beta)));
    }
}
