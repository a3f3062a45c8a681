//! Real quantities of lamps: from W, lm, cd, lx and cd/m² to absolute spectra.

use illuminant_spectrum::{Curve, Observer, SpectralRange};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// How bright a lamp is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", content = "value", rename_all = "snake_case")]
pub enum Quantity {
    /// Radiant power over the spectral range, W.
    PowerW(f64),
    /// Luminous flux, lm.
    FluxLm(f64),
    /// Luminous intensity (on the axis of a spot), cd.
    IntensityCd(f64),
    /// Illuminance: of a directional lamp on a surface that faces it, of an environment on the ground, lx.
    IlluminanceLx(f64),
    /// Irradiance on a surface that faces a directional lamp, W/m².
    IrradianceWM2(f64),
    /// Luminance, cd/m².
    #[serde(rename = "luminance_cd_m2")]
    LuminanceCdM2(f64),
    /// The spectrum is absolute (W·sr⁻¹·m⁻²·nm⁻¹) and is multiplied by this.
    RadianceScale(f64),
}

impl Quantity {
    /// The name scene files use.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::PowerW(_) => "power_w",
            Self::FluxLm(_) => "flux_lm",
            Self::IntensityCd(_) => "intensity_cd",
            Self::IlluminanceLx(_) => "illuminance_lx",
            Self::IrradianceWM2(_) => "irradiance_w_m2",
            Self::LuminanceCdM2(_) => "luminance_cd_m2",
            Self::RadianceScale(_) => "radiance_scale",
        }
    }

    fn value(self) -> f64 {
        match self {
            Self::PowerW(v)
            | Self::FluxLm(v)
            | Self::IntensityCd(v)
            | Self::IlluminanceLx(v)
            | Self::IrradianceWM2(v)
            | Self::LuminanceCdM2(v)
            | Self::RadianceScale(v) => v,
        }
    }
}

/// The kind of light source, with what its quantities depend on.
#[derive(Clone, Copy, Debug)]
pub enum Source {
    /// A surface with this area times the number of its luminous sides, m². The result is radiance along the normal. One that does not
    /// obey Lambert's law has the area times ∫ intensity dω/π.
    Surface {
        /// Area × sides.
        area: f64,
    },
    /// A source that is a point and fills this solid angle (weighted by its distribution), sr. The result is spectral
    /// intensity, W·sr⁻¹·nm⁻¹.
    Point {
        /// ∫ distribution dω, 4π for a bare point.
        solid_angle: f64,
    },
    /// Parallel light. The result is irradiance on a surface that faces it, W·m⁻²·nm⁻¹.
    Parallel,
    /// Light from all around, the same from everywhere. The result is radiance.
    Surround,
}

/// The absolute spectrum of a source: `spectrum` scaled so that the source has `quantity`.
///
/// Photometric quantities integrate ȳ at 1 nm with K_m = 683 lm/W over `range`, never in a spectral sampling, so the
/// same lamp gives the same luminance by every route.
///
/// # Errors
/// A sentence, when the quantity does not fit the kind of source, is negative or not finite, or the spectrum has
/// nothing to scale.
///
/// ```
/// use illuminant_scene::{Quantity, Source, absolute_spectrum};
/// use illuminant_spectrum::{Curve, Observer, SpectralRange};
/// let range = SpectralRange::default();
/// let source = Source::Surface { area: 0.5 };
/// let radiance = absolute_spectrum(&Curve::constant(1.0), Quantity::FluxLm(100.0), source, range).unwrap();
/// // A Lambertian panel of 0.5 m² that sends out 100 lm has 100 / (π · 0.5) cd/m².
/// let luminance = Observer::cie_1931_2deg().luminance(&radiance, range);
/// assert!((luminance - 100.0 / (std::f64::consts::PI * 0.5)).abs() < 1e-9);
/// ```
pub fn absolute_spectrum(
    spectrum: &Curve,
    quantity: Quantity,
    source: Source,
    range: SpectralRange,
) -> Result<Curve, String> {
    let value = quantity.value();
    if !(value >= 0.0 && value.is_finite()) {
        return Err(format!("{} must be 0 or more and finite, not {value}", quantity.key()));
    }
    let (low, _) = spectrum.extent(range);
    if low < 0.0 {
        return Err("the spectrum of a lamp must not be negative".into());
    }
    let luminous = || Observer::cie_1931_2deg().luminance(spectrum, range);
    let radiant = || spectrum.area(range);
    let unfit = |fit: &str| Err(format!("{} does not fit this kind of lamp; use {fit}", quantity.key()));
    let (wanted, given) = match (source, quantity) {
        (Source::Surface { area }, Quantity::PowerW(w)) => (w / (PI * area), radiant()),
        (Source::Surface { area }, Quantity::FluxLm(lm)) => (lm / (PI * area), luminous()),
        (Source::Surface { .. } | Source::Surround, Quantity::LuminanceCdM2(cd_m2)) => (cd_m2, luminous()),
        (Source::Surface { .. } | Source::Surround, Quantity::RadianceScale(scale)) => (scale, 1.0),
        (Source::Point { solid_angle }, Quantity::PowerW(w)) => (w / solid_angle, radiant()),
        (Source::Point { solid_angle }, Quantity::FluxLm(lm)) => (lm / solid_angle, luminous()),
        (Source::Point { .. }, Quantity::IntensityCd(cd)) => (cd, luminous()),
        (Source::Parallel, Quantity::IlluminanceLx(lx)) => (lx, luminous()),
        (Source::Parallel, Quantity::IrradianceWM2(w_m2)) => (w_m2, radiant()),
        (Source::Surround, Quantity::IlluminanceLx(lx)) => (lx / PI, luminous()),
        (Source::Surface { .. }, _) => return unfit("power_w, flux_lm, luminance_cd_m2 or radiance_scale"),
        (Source::Point { .. }, _) => return unfit("power_w, flux_lm or intensity_cd"),
        (Source::Parallel, _) => return unfit("illuminance_lx or irradiance_w_m2"),
        (Source::Surround, _) => return unfit("luminance_cd_m2, illuminance_lx or radiance_scale"),
    };
    if wanted > 0.0 && !(given > 0.0) {
        return Err(format!("the spectrum has no light over {}–{} nm to scale", range.min_nm, range.max_nm));
    }
    let factor = if wanted == 0.0 { 0.0 } else { wanted / given };
    if !factor.is_finite() {
        return Err(format!(
            "{} cannot be reached: the lamp has no area or the spectrum too little light",
            quantity.key()
        ));
    }
    Ok(spectrum.scaled(factor))
}
