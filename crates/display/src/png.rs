//! PNG files that say how their numbers are meant.

use crate::Pixels;
use std::io::Write;
use thiserror::Error;

/// Why no PNG could be made.
#[derive(Debug, Error)]
pub enum PngError {
    /// The number of code values is not three to a pixel.
    #[error("{found} code values do not fill {width} × {height} pixels of three channels")]
    Size {
        /// How many values there are.
        found: usize,
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// A number that a chunk cannot hold.
    #[error("a PNG cannot state {0}")]
    Number(String),
    /// The encoder failed.
    #[error("the PNG cannot be encoded: {0}")]
    Encoding(#[from] png::EncodingError),
}

/// What a PNG states about its numbers; each chunk is written exactly when it is given.
#[derive(Clone, Debug, Default)]
pub struct PngTags {
    /// x, y of white, red, green and blue, for cHRM.
    pub chromaticities: Option<[[f64; 2]; 4]>,
    /// The exponent γ of code = value^(1/γ), for gAMA.
    pub gamma: Option<f64>,
    /// Primaries, transfer, matrix and range of ITU-T H.273, for cICP.
    pub cicp: Option<[u8; 4]>,
    /// Whether the image is sRGB with the intent "relative colorimetric", for sRGB.
    pub srgb: bool,
    /// Name (Latin-1, up to 79 characters) and bytes of an ICC profile, for iCCP.
    pub icc: Option<(String, Vec<u8>)>,
    /// How many bits of each channel carry the image, for sBIT.
    pub significant_bits: Option<u8>,
    /// Keywords (Latin-1, up to 79 characters) and texts, for iTXt.
    pub text: Vec<(String, String)>,
}

/// Encodes code values as a PNG.
///
/// # Errors
/// [`PngError`] when the values do not fill the image, or a keyword is no keyword.
pub fn encode_png(pixels: &Pixels, width: u32, height: u32, tags: &PngTags) -> Result<Vec<u8>, PngError> {
    let found = match pixels {
        Pixels::Eight(codes) => codes.len(),
        Pixels::Sixteen(codes) => codes.len(),
    };
    if found as u64 != 3 * u64::from(width) * u64::from(height) {
        return Err(PngError::Size { found, width, height });
    }
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(match pixels {
        Pixels::Eight(_) => png::BitDepth::Eight,
        Pixels::Sixteen(_) => png::BitDepth::Sixteen,
    });
    for (keyword, text) in &tags.text {
        encoder.add_itxt_chunk(keyword.clone(), text.clone())?;
    }
    let mut writer = encoder.write_header()?;
    // The encoder would add gAMA and cHRM of its own beside sRGB; here each chunk is what was asked for.
    let scaled = |what: &str, v: f64| {
        let number = (v * 100_000.0).round();
        let fits = (0.0..=f64::from(i32::MAX)).contains(&number);
        if fits { Ok((number as u32).to_be_bytes()) } else { Err(PngError::Number(format!("{what} {v}"))) }
    };
    if let Some(cicp) = tags.cicp {
        writer.write_chunk(png::chunk::ChunkType(*b"cICP"), &cicp)?;
    }
    if let Some((name, profile)) = &tags.icc {
        writer.write_chunk(png::chunk::iCCP, &profile_chunk(name, profile)?)?;
    }
    if tags.srgb {
        writer.write_chunk(png::chunk::sRGB, &[1])?;
    }
    if let Some(gamma) = tags.gamma {
        writer.write_chunk(png::chunk::gAMA, &scaled("the exponent", 1.0 / gamma)?)?;
    }
    if let Some(chromaticities) = tags.chromaticities {
        let numbers: Vec<[u8; 4]> = chromaticities
            .iter()
            .flatten()
            .map(|&v| scaled("the chromaticity", v))
            .collect::<Result<_, _>>()?;
        writer.write_chunk(png::chunk::cHRM, &numbers.concat())?;
    }
    if let Some(bits) = tags.significant_bits {
        let depth = if matches!(pixels, Pixels::Eight(_)) { 8 } else { 16 };
        if !(1..=depth).contains(&bits) {
            return Err(PngError::Number(format!("{bits} significant bits of {depth}")));
        }
        writer.write_chunk(png::chunk::ChunkType(*b"sBIT"), &[bits; 3])?;
    }
    match pixels {
        Pixels::Eight(codes) => writer.write_image_data(codes)?,
        Pixels::Sixteen(codes) => {
            let bytes: Vec<u8> = codes.iter().flat_map(|code| code.to_be_bytes()).collect();
            writer.write_image_data(&bytes)?;
        }
    }
    writer.finish()?;
    Ok(file)
}

/// The data of an iCCP chunk: name, zero, method zero, and the profile compressed.
fn profile_chunk(name: &str, profile: &[u8]) -> Result<Vec<u8>, PngError> {
    let latin = |c: &char| matches!(c, ' '..='~' | '\u{a1}'..='\u{ff}');
    let plain: String = name.chars().filter(latin).collect();
    let words = plain.split_whitespace().collect::<Vec<_>>().join(" ");
    let keyword: Vec<u8> = words.chars().take(79).map(|c| c as u8).collect();
    let mut data = if keyword.is_empty() { b"ICC profile".to_vec() } else { keyword };
    data.extend([0, 0]);
    let mut stream = flate2::write::ZlibEncoder::new(data, flate2::Compression::default());
    stream.write_all(profile).map_err(png::EncodingError::IoError)?;
    Ok(stream.finish().map_err(png::EncodingError::IoError)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_chunks_asked_for_are_there_and_no_others() {
        let pixels = Pixels::Eight(vec![1, 2, 3, 4, 5, 6]);
        let tags = PngTags { gamma: Some(2.2), cicp: Some([1, 13, 0, 1]), ..PngTags::default() };
        let file = encode_png(&pixels, 2, 1, &tags).unwrap();
        let mut names = Vec::new();
        let mut at = 8;
        while at < file.len() {
            let length = u32::from_be_bytes(file[at..at + 4].try_into().unwrap()) as usize;
            names.push(String::from_utf8(file[at + 4..at + 8].to_vec()).unwrap());
            at += 12 + length;
        }
        assert_eq!(names, ["IHDR", "cICP", "gAMA", "IDAT", "IEND"]);
        assert!(matches!(encode_png(&pixels, 3, 1, &tags), Err(PngError::Size { .. })));
    }
}
