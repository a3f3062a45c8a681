//! Reading a profile.

use crate::tags::Tags;
use crate::{Curve, D50, IccError, ProfileDescription, text};
use illuminant_color::{Adaptation, Matrix};

/// Reads the display that an ICC profile of matrix and curves describes (versions 2 to 4).
///
/// White is what the three primaries make together. The adaptation to D50 is undone by the matrix of `chad`; without
/// that tag by Bradford to the white of `wtpt`, where versions 2 have the native one; and a profile that has neither is
/// taken as it is, with D50 for white. A table that falls by less than 0.01, as measured ones do, is levelled, and one
/// that does not end at 1 is stretched.
///
/// # Errors
/// [`IccError`]: the bytes are no profile, are damaged, or describe no RGB display by primaries and curves.
pub fn decode(bytes: &[u8]) -> Result<ProfileDescription, IccError> {
    let tags = Tags::of(bytes)?;
    if !tags.has(b"rXYZ") && (tags.has(b"A2B0") || tags.has(b"A2B1")) {
        return Err(IccError::Unsuitable(
            "it has only a lookup table (A2B), and no primaries and curves".into(),
        ));
    }
    let colorant = |name: &[u8; 4]| Tags::numbers::<3>(tags.needed(name)?, name);
    let mut colorants = [colorant(b"rXYZ")?, colorant(b"gXYZ")?, colorant(b"bXYZ")?];
    let curve = |name: &[u8; 4]| Curve::of_tag(tags.needed(name)?, &crate::tags::shown(name));
    let (red, green, blue) = (curve(b"rTRC")?, curve(b"gTRC")?, curve(b"bTRC")?);
    for (colorant, white) in colorants.iter_mut().zip([red.1, green.1, blue.1]) {
        *colorant = colorant.map(|v| v * white);
    }
    let native = native_from_d50(&tags)?;
    let (primaries, white) = chromaticities(colorants.map(|xyz| native.apply(xyz)))
        .ok_or_else(|| IccError::Damaged("its primaries make no white, or lie on one line".into()))?;
    let description = tags.optional(b"desc")?.and_then(text::of_tag).unwrap_or_default();
    let copyright = tags.optional(b"cprt")?.and_then(text::of_tag).unwrap_or_default();
    let luminance = match tags.optional(b"lumi")? {
        Some(tag) => Some(Tags::numbers::<3>(tag, b"lumi")?[1]).filter(|v| *v > 0.0),
        None => None,
    };
    let cicp = tags.optional(b"cicp")?.filter(|tag| tag.starts_with(b"cicp"));
    Ok(ProfileDescription {
        description,
        copyright,
        version: tags.version,
        primaries,
        white,
        curves: [red.0, green.0, blue.0],
        luminance,
        cicp: cicp.and_then(|tag| tag.get(8..)?.first_chunk().copied()),
    })
}

/// The matrix from colours under D50 to those of the display.
fn native_from_d50(tags: &Tags<'_>) -> Result<Matrix, IccError> {
    if let Some(tag) = tags.optional(b"chad")? {
        let [a, b, c, d, e, f, g, h, i] = Tags::numbers::<9>(tag, b"chad")?;
        let adaptation = Matrix([[a, b, c], [d, e, f], [g, h, i]]);
        return adaptation
            .inverse()
            .map_err(|_| IccError::Damaged("the adaptation in its tag chad cannot be undone".into()));
    }
    let Some(tag) = tags.optional(b"wtpt")? else { return Ok(Matrix::IDENTITY) };
    let [x, y, z] = Tags::numbers::<3>(tag, b"wtpt")?;
    let white = [x / y, 1.0, z / y];
    if white.iter().zip(D50).all(|(a, b)| (a - b).abs() < 1e-3) {
        return Ok(Matrix::IDENTITY);
    }
    Adaptation::Bradford
        .matrix(D50, white)
        .ok_or_else(|| IccError::Damaged("the white in its tag wtpt is no white".into()))
}

/// x and y of the primaries, and of their sum.
fn chromaticities(xyz: [[f64; 3]; 3]) -> Option<([[f64; 2]; 3], [f64; 2])> {
    Matrix::from_columns(xyz).inverse().ok()?;
    let chromaticity = |[x, y, z]: [f64; 3]| {
        let sum = x + y + z;
        let found = [x / sum, y / sum];
        found.iter().all(|v| v.abs() <= 10.0).then_some(found)
    };
    let white = [0, 1, 2].map(|axis| xyz.iter().map(|primary| primary[axis]).sum::<f64>());
    let [red, green, blue] = xyz;
    let usable = white.iter().all(|v| *v > 0.0);
    let primaries = [chromaticity(red)?, chromaticity(green)?, chromaticity(blue)?];
    usable.then_some((primaries, chromaticity(white)?))
}
