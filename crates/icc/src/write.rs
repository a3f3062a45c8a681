//! Writing a profile.

use crate::tags::{assemble, fixed, number_tag};
use crate::text::{self, Role};
use crate::{D50, IccError, ProfileDescription, Version};
use illuminant_color::{Adaptation, Matrix, RgbSystem, Transfer};

/// Encodes a display as an ICC profile; the same description gives the same bytes.
///
/// # Errors
/// [`IccError::Description`] when the primaries lie on one line, the white cannot be adapted to D50, a curve does not
/// rise from [0, 1] to 1, a number does not fit, or a text is empty or too long.
pub fn encode(display: &ProfileDescription) -> Result<Vec<u8>, IccError> {
    let refuse = |why: String| Err(IccError::Description(why));
    for (what, text) in [("description", &display.description), ("copyright", &display.copyright)] {
        if text.trim().is_empty() || text.len() > 1000 || text.contains('\0') {
            return refuse(format!("the {what} should be a text of up to 1000 bytes"));
        }
    }
    for (curve, channel) in display.curves.iter().zip(["red", "green", "blue"]) {
        curve.check(channel)?;
    }
    if let Some(luminance) = display.luminance.filter(|v| !(*v > 0.0 && *v < 32768.0)) {
        return refuse(format!("a luminance of white of {luminance} cd/m² is not between 0 and 32768"));
    }
    let (adaptation, colorants) = under_d50(display)?;
    let mut tags: Vec<([u8; 4], Vec<u8>)> = vec![
        (*b"desc", text::tag(&display.description, Role::Description, display.version)),
        (*b"cprt", text::tag(&display.copyright, Role::Copyright, display.version)),
        (*b"wtpt", number_tag(b"XYZ ", D50.map(fixed::of))),
        (*b"chad", number_tag(b"sf32", adaptation.0.into_iter().flatten().map(fixed::of))),
    ];
    tags.extend(
        [*b"rXYZ", *b"gXYZ", *b"bXYZ"].into_iter().zip(colorants.map(|xyz| number_tag(b"XYZ ", xyz))),
    );
    for (name, curve) in [*b"rTRC", *b"gTRC", *b"bTRC"].into_iter().zip(&display.curves) {
        tags.push((name, curve.tag(display.version)));
    }
    if let Some(luminance) = display.luminance {
        tags.push((*b"lumi", number_tag(b"XYZ ", [0, fixed::of(luminance), 0])));
    }
    if let (Some(code_points), Version::Four) = (display.cicp, display.version) {
        tags.push((*b"cicp", [b"cicp\0\0\0\0".as_slice(), &code_points].concat()));
    }
    Ok(assemble(display.version, &tags))
}

/// The adaptation to D50, and XYZ of each primary under D50 as numbers of a profile.
fn under_d50(display: &ProfileDescription) -> Result<(Matrix, [[i32; 3]; 3]), IccError> {
    let impossible = |why: &str| IccError::Description(why.into());
    let [x, y] = display.white;
    let coordinates = display.primaries.iter().flatten().chain(&display.white);
    if !coordinates.clone().all(|v| v.abs() <= 10.0) || !(y > 0.0) {
        return Err(impossible("a chromaticity is not finite, is larger than 10, or white has none"));
    }
    let system = RgbSystem::new("display", display.primaries, display.white, Transfer::Linear)
        .ok_or_else(|| impossible("the primaries lie on one line"))?;
    let native = [x / y, 1.0, (1.0 - x - y) / y];
    let adaptation = Adaptation::Bradford
        .matrix(native, D50)
        .ok_or_else(|| impossible("the white is no white: it cannot be adapted to D50"))?;
    let mut colorants = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        .map(|primary| adaptation.apply(system.to_xyz(primary)).map(fixed::of));
    if colorants.iter().flatten().any(|v| v.unsigned_abs() > 100 << 16) {
        return Err(impossible("the primaries lie nearly on one line"));
    }
    // Rounding leaves the sum a bit or two away from D50; the largest share takes what is missing.
    for (axis, white) in D50.map(fixed::of).into_iter().enumerate() {
        let missing = white - colorants.iter().map(|xyz| xyz[axis]).sum::<i32>();
        if let Some(largest) = colorants.iter_mut().max_by_key(|xyz| xyz[axis]) {
            largest[axis] += missing;
        }
    }
    Ok((adaptation, colorants))
}
