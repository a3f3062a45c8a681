//! What a material is, physically.

use crate::{Finish, Overrides};
use illuminant_spectrum::{Curve, Outside, SpectralRange};

/// The wavelength whose index stands for a dielectric wherever one number must do: sodium d, 589.3 nm.
pub const REPRESENTATIVE_NM: f64 = 589.3;

/// A material: a name and the physics of its surface.
#[derive(Clone, Debug)]
pub struct Material {
    /// The name that messages use.
    pub name: String,
    /// What its surface is made of.
    pub surface: Surface,
    /// A direction in the world along which its grain runs, where it has one.
    pub grain: Option<[f32; 3]>,
    /// What the historical models are told instead of what they would derive.
    pub overrides: Vec<Overrides>,
}

/// The physics of a surface.
#[derive(Clone, Debug)]
pub enum Surface {
    /// An ideal diffuser.
    Diffuse {
        /// Hemispherical reflectance, a fraction.
        reflectance: Curve,
    },
    /// A conductor.
    Conductor {
        /// Real part of the index.
        n: Curve,
        /// Imaginary part.
        k: Curve,
        /// Its relief.
        finish: Finish,
    },
    /// A thin filter, such as a gel before a lamp: it absorbs, and neither reflects nor bends light.
    Filter {
        /// Fraction of light let through.
        transmittance: Curve,
    },
    /// A thin sheet that scatters light on both sides, such as paper; the two add up to at most 1 at every wavelength.
    Translucent {
        /// Hemispherical reflectance, on the side from which light comes, a fraction.
        reflectance: Curve,
        /// Hemispherical transmittance, on the other side, a fraction.
        transmittance: Curve,
    },
    /// A transparent dielectric body.
    Dielectric {
        /// Index of refraction.
        n: Curve,
        /// Its relief.
        finish: Finish,
        /// Absorption coefficient in the body, 1/m.
        absorption: Option<Curve>,
        /// Whether the index follows the curve; otherwise it is that at [`REPRESENTATIVE_NM`] throughout.
        dispersion: bool,
    },
    /// A dielectric vehicle over what lies in it or under it: paint, plastic, glaze, varnish, metal flake.
    Coated {
        /// The vehicle's index of refraction.
        n: Curve,
        /// The relief of its outer surface.
        finish: Finish,
        /// What the vehicle itself absorbs, if it is tinted.
        film: Option<Film>,
        /// Reflectance of the pigment for diffuse light inside the vehicle.
        pigment: Curve,
        /// Bits of metal that lie flat in the vehicle, or the metal under it.
        flakes: Option<Flakes>,
    },
}

/// A layer that absorbs.
#[derive(Clone, Debug)]
pub struct Film {
    /// Absorption coefficient, 1/m.
    pub absorption: Curve,
    /// Thickness, m.
    pub thickness: f64,
}

/// Metal that shows through a vehicle.
#[derive(Clone, Debug)]
pub struct Flakes {
    /// Real part of the metal's index.
    pub n: Curve,
    /// Imaginary part.
    pub k: Curve,
    /// Slope m of the metal's facets, and of how the flakes lie.
    pub slope: f64,
    /// The fraction of the area that they cover; 1 is a sheet of metal.
    pub coverage: f64,
}

impl Material {
    /// A material without a grain, and without overrides.
    #[must_use]
    pub fn new(name: impl Into<String>, surface: Surface) -> Self {
        Self { name: name.into(), surface, grain: None, overrides: Vec::new() }
    }

    /// The slope m of its relief, the steeper one where it has a grain; a diffuser has none.
    #[must_use]
    pub fn slope(&self) -> f64 {
        match &self.surface {
            Surface::Diffuse { .. } | Surface::Filter { .. } | Surface::Translucent { .. } => 0.0,
            Surface::Conductor { finish, .. }
            | Surface::Dielectric { finish, .. }
            | Surface::Coated { finish, .. } => finish.slope[0].max(finish.slope[1]),
        }
    }

    /// A reflectance at normal incidence that stands for the material in auxiliary images and error estimates: the
    /// diffuse reflectance, a filter's transmittance, the sum of the two for a translucent sheet, or Fresnel's of the
    /// smooth boundary (1 for a clear dielectric, which passes the rest).
    #[must_use]
    pub fn representative_reflectance(&self, range: SpectralRange) -> Curve {
        use illuminant_optics::fresnel::conductor;
        match &self.surface {
            Surface::Diffuse { reflectance } => reflectance.clone(),
            Surface::Filter { transmittance } => transmittance.clone(),
            Surface::Translucent { reflectance, transmittance } => {
                let values = range.wavelengths().map(|w| reflectance.at(w) + transmittance.at(w)).collect();
                Curve::tabulated(range, values, Outside::Hold)
            }
            Surface::Conductor { n, k, .. } => {
                let values = range.wavelengths().map(|w| conductor(1.0, n.at(w), k.at(w))).collect();
                Curve::tabulated(range, values, Outside::Hold)
            }
            Surface::Dielectric { .. } => Curve::constant(1.0),
            Surface::Coated { pigment, .. } => pigment.clone(),
        }
    }

    /// The same surface if nothing absorbed: white paint, a metal that reflects everything, clear glass. What leaves it must be all
    /// that came.
    #[must_use]
    pub fn lossless(&self) -> Self {
        // n = 1 and k so large that 1 − F is below 10⁻⁷.
        let perfect = || (Curve::constant(1.0), Curve::constant(1e4));
        let surface = match &self.surface {
            Surface::Diffuse { .. } => Surface::Diffuse { reflectance: Curve::constant(1.0) },
            Surface::Filter { .. } => Surface::Filter { transmittance: Curve::constant(1.0) },
            Surface::Translucent { reflectance, transmittance } => {
                // What was absorbed is shared out; beyond the range the last share is held, and the sum is 1 there too.
                let range = SpectralRange::default();
                let share = |w: f64| match [reflectance.at(w), transmittance.at(w)] {
                    [r, t] if r + t > 0.0 => r / (r + t),
                    _ => 0.5,
                };
                let reflected: Vec<f64> = range.wavelengths().map(share).collect();
                let transmitted = reflected.iter().map(|r| 1.0 - r).collect();
                let curve = |values| Curve::tabulated(range, values, Outside::Hold);
                Surface::Translucent { reflectance: curve(reflected), transmittance: curve(transmitted) }
            }
            Surface::Conductor { finish, .. } => {
                let (n, k) = perfect();
                Surface::Conductor { n, k, finish: *finish }
            }
            Surface::Dielectric { n, finish, dispersion, .. } => Surface::Dielectric {
                n: n.clone(),
                finish: *finish,
                absorption: None,
                dispersion: *dispersion,
            },
            Surface::Coated { n, finish, flakes, .. } => Surface::Coated {
                n: n.clone(),
                finish: *finish,
                film: None,
                pigment: Curve::constant(1.0),
                flakes: flakes.as_ref().map(|flakes| {
                    let (n, k) = perfect();
                    Flakes { n, k, ..flakes.clone() }
                }),
            },
        };
        Self { surface, ..self.clone() }
    }

    /// Whether light of different wavelengths parts ways when it is refracted.
    #[must_use]
    pub fn disperses(&self, range: SpectralRange) -> bool {
        match &self.surface {
            Surface::Dielectric { n, dispersion: true, .. } => {
                let (low, high) = n.extent(range);
                high - low > 1e-6 * n.at(REPRESENTATIVE_NM)
            }
            _ => false,
        }
    }

    /// One number for the whole spectrum, by which paths are chosen and ended: the largest reflectance over the range.
    ///
    /// It never depends on the spectral sampling, so that all samplings follow the same paths; and since no wavelength
    /// is reflected more strongly, no lane's variance grows with the length of a path (a mean would let that of any
    /// wavelength with ρ² above it grow without bound).
    #[must_use]
    pub fn brightness(&self, range: SpectralRange) -> f64 {
        self.representative_reflectance(range).extent(range).1
    }
}
