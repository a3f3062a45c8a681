//! What a description says of the coefficients of historical models, checked.

use crate::description::{CoefficientsData, LobeData, MaskingData};
use crate::scene::{SceneError, error, fraction};
use illuminant_illumination::{Illumination, Masking, Overrides};
use illuminant_optics::distribution::Distribution;
use illuminant_spectrum::{Curve, SpectralRange};

/// The largest multiplier of a coefficient.
const MOST_MULTIPLIER: f64 = 100.0;
/// The largest N_s.
const MOST_EXPONENT: f64 = 1e6;

/// What a historical model is told, checked.
pub(crate) fn overrides(
    data: &CoefficientsData,
    place: &str,
    curves: &[Curve],
    range: SpectralRange,
) -> Result<Overrides, SceneError> {
    let place = format!("{place}.coefficients.{}", data.model.as_deref().unwrap_or("all"));
    let model = data.model.as_ref().map(|name| name.parse::<Illumination>()).transpose();
    let model = model.map_err(|problem| error(&place, problem))?;
    if model == Some(Illumination::General) {
        return Err(error(place, "general has no coefficients: it follows the physics of the surface"));
    }
    let within = |what: &str, value: Option<f64>, good: fn(f64) -> bool, words: &str| match value {
        Some(value) if !good(value) => Err(error(&place, format!("{what} must lie {words}, not {value}"))),
        _ => Ok(value),
    };
    let multiplier =
        |what, value| within(what, value, |v| (0.0..=MOST_MULTIPLIER).contains(&v), "between 0 and 100");
    let curve = |what, index: Option<usize>| {
        index.map(|index| fraction(curves, &place, what, index, range)).transpose()
    };
    if data.half_angle_deg.is_some() && data.exponent.is_some() {
        return Err(error(place, "half_angle_deg and exponent say the same; give one of them"));
    }
    let beta = within(
        "half_angle_deg",
        data.half_angle_deg,
        |v| v > 0.0 && v < 90.0,
        "above 0 and below 90 degrees",
    )?;
    Ok(Overrides {
        model,
        ambient: multiplier("ambient", data.ambient)?,
        diffuse: multiplier("diffuse", data.diffuse)?,
        specular: multiplier("specular", data.specular)?,
        transmitted: multiplier("transmitted", data.transmitted)?,
        diffuse_curve: curve("diffuse_curve", data.diffuse_curve)?,
        specular_curve: curve("specular_curve", data.specular_curve)?,
        transmitted_curve: curve("transmitted_curve", data.transmitted_curve)?,
        beta: beta.map(f64::to_radians),
        coefficient: within(
            "exponent",
            data.exponent,
            |v| v > 0.0 && v <= MOST_EXPONENT,
            "above 0 and up to 1,000,000",
        )?,
        distribution: data.distribution.map(|lobe| match lobe {
            LobeData::Phong => Distribution::Phong,
            LobeData::Blinn => Distribution::Blinn,
            LobeData::Gaussian => Distribution::Gaussian,
            LobeData::TrowbridgeReitz => Distribution::TrowbridgeReitz,
            LobeData::Cook => Distribution::Cook,
        }),
        masking: data.masking.map(|masking| match masking {
            MaskingData::None => Masking::None,
            MaskingData::TorranceSparrow => Masking::TorranceSparrow,
            // The model sets its m² by the highlight.
            MaskingData::Sancer => Masking::Sancer(0.0),
        }),
        terminator: within("terminator", data.terminator, |v| (1.0..=5.0).contains(&v), "between 1 and 5")?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(json: &str) -> Result<Overrides, String> {
        let data: CoefficientsData = serde_json::from_str(json).map_err(|e| e.to_string())?;
        let curves = [Curve::constant(0.25), Curve::constant(1.5)];
        overrides(&data, "materials.m", &curves, SpectralRange::default()).map_err(|e| e.to_string())
    }

    #[test]
    fn what_is_absent_follows_the_rule() {
        assert_eq!(read("{}").unwrap(), Overrides::default());
        let found = read(
            r#"{"model": "cook-torrance", "specular": 0.8, "specular_curve": 0, "half_angle_deg": 90e-1,
                "distribution": "trowbridge-reitz", "masking": "sancer", "terminator": 2.0}"#,
        );
        let expected = Overrides {
            model: Some(Illumination::CookTorrance),
            specular: Some(0.8),
            specular_curve: Some(Curve::constant(0.25)),
            beta: Some(9f64.to_radians()),
            distribution: Some(Distribution::TrowbridgeReitz),
            masking: Some(Masking::Sancer(0.0)),
            terminator: Some(2.0),
            ..Overrides::default()
        };
        assert_eq!(found.unwrap(), expected);
    }

    #[test]
    fn a_mistake_says_where_it_stands() {
        for (json, message) in [
            (r#"{"model": "fong"}"#, "materials.m.coefficients.fong: no illumination model"),
            (r#"{"model": "general"}"#, "materials.m.coefficients.general: general has no coefficients"),
            (r#"{"ambient": -0.1}"#, "materials.m.coefficients.all: ambient must lie between 0 and 100"),
            (r#"{"half_angle_deg": 90.0}"#, "above 0 and below 90 degrees, not 90"),
            (r#"{"half_angle_deg": 5.0, "exponent": 80.0}"#, "say the same"),
            (r#"{"exponent": 0.0}"#, "exponent must lie above 0"),
            (r#"{"terminator": 0.5}"#, "between 1 and 5"),
            (r#"{"diffuse_curve": 1}"#, "diffuse_curve must not exceed 1"),
            (r#"{"diffuse_curve": 2}"#, "there is no curve 2"),
            (r#"{"shine": 1.0}"#, "unknown field"),
        ] {
            let found = read(json).unwrap_err();
            assert!(found.contains(message), "{found}");
        }
    }
}
