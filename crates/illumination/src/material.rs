//! What a material is, physically.

use illuminant_spectrum::{Curve, SpectralRange};

/// The wavelength whose index stands for a dielectric wherever one number must do: sodium d, 589.3 nm.
pub const REPRESENTATIVE_NM: f64 = 589.3;

/// A material: a name and the physics of its surface.
#[derive(Clone, Debug)]
pub struct Material {
    /// The name that messages use.
    pub name: String,
    /// What its surface is made of.
    pub surface: Surface,
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
        /// Slope parameter α of its facets; 0 is a mirror.
        roughness: f64,
    },
    /// A thin filter, such as a gel before a lamp: it absorbs, and neither reflects nor bends light.
    Filter {
        /// Fraction of light let through.
        transmittance: Curve,
    },
    /// A transparent dielectric body.
    Dielectric {
        /// Index of refraction.
        n: Curve,
        /// Slope parameter α of its facets; 0 is smooth.
        roughness: f64,
        /// Absorption coefficient in the body, 1/m.
        absorption: Option<Curve>,
        /// Whether the index follows the curve; otherwise it is that at [`REPRESENTATIVE_NM`] throughout.
        dispersion: bool,
    },
}

impl Material {
    /// A reflectance at normal incidence that stands for the material in auxiliary images and error estimates:
    /// the diffuse reflectance, a filter's transmittance, or Fresnel's of the smooth boundary (1 for a clear dielectric, which passes the rest).
    #[must_use]
    pub fn representative_reflectance(&self, range: SpectralRange) -> Curve {
        use illuminant_optics::fresnel::conductor;
        match &self.surface {
            Surface::Diffuse { reflectance } => reflectance.clone(),
            Surface::Filter { transmittance } => transmittance.clone(),
            Surface::Conductor { n, k, .. } => {
                let values = range.wavelengths().map(|w| conductor(1.0, n.at(w), k.at(w))).collect();
                Curve::tabulated(range, values, illuminant_spectrum::Outside::Hold)
            }
            Surface::Dielectric { .. } => Curve::constant(1.0),
        }
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
