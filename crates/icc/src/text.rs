//! Texts of a profile: `mluc` of version 4, `desc` and `text` of version 2 (ICC.1:2022, 10.15; ICC.1:2001-04, 6.5.17).

use crate::Version;

/// How many UTF-16 units or bytes of a text are kept.
const LONGEST: usize = 4096;

/// Which text a tag holds; version 2 has a type of its own for descriptions.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Role {
    Description,
    Copyright,
}

/// A text as the content of a tag.
pub(crate) fn tag(text: &str, role: Role, version: Version) -> Vec<u8> {
    match (version, role) {
        (Version::Four, _) => {
            let utf16: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
            let mut tag = b"mluc\0\0\0\0\0\0\0\x01\0\0\0\x0cenUS".to_vec();
            tag.extend((utf16.len() as u32).to_be_bytes());
            tag.extend(28_u32.to_be_bytes());
            tag.extend(utf16);
            tag
        }
        (Version::Two, Role::Copyright) => {
            let mut tag = b"text\0\0\0\0".to_vec();
            tag.extend(ascii(text));
            tag
        }
        (Version::Two, Role::Description) => {
            let ascii = ascii(text);
            let mut tag = b"desc\0\0\0\0".to_vec();
            tag.extend((ascii.len() as u32).to_be_bytes());
            tag.extend(ascii);
            let units: Vec<u16> = text.encode_utf16().chain([0]).collect();
            tag.extend([0; 4]);
            tag.extend((units.len() as u32).to_be_bytes());
            tag.extend(units.into_iter().flat_map(u16::to_be_bytes));
            // A Macintosh script code, the length of its text, and the text: none.
            tag.extend([0; 2 + 1 + 67]);
            tag
        }
    }
}

/// With its closing zero; what ASCII does not have becomes a question mark.
fn ascii(text: &str) -> Vec<u8> {
    text.chars().map(|c| if c.is_ascii() { c as u8 } else { b'?' }).chain([0]).collect()
}

/// The text of a tag: the English one where there are several, or the first. `None` when the tag is damaged.
pub(crate) fn of_tag(tag: &[u8]) -> Option<String> {
    match tag.get(..4)? {
        b"text" => Some(of_ascii(tag.get(8..)?)),
        b"desc" => of_description(tag),
        b"mluc" => of_localised(tag),
        _ => None,
    }
}

fn of_ascii(bytes: &[u8]) -> String {
    let end = bytes.iter().position(|b| *b == 0).unwrap_or(bytes.len()).min(LONGEST);
    String::from_utf8_lossy(&bytes[..end]).into_owned()
}

fn of_utf16(bytes: &[u8]) -> String {
    let units = bytes.chunks_exact(2).map(|unit| u16::from_be_bytes([unit[0], unit[1]]));
    let units: Vec<u16> = units.take(LONGEST).take_while(|unit| *unit != 0).collect();
    String::from_utf16_lossy(&units)
}

fn word(tag: &[u8], at: usize) -> Option<usize> {
    Some(u32::from_be_bytes(*tag.get(at..)?.first_chunk()?) as usize)
}

fn part(tag: &[u8], start: usize, length: usize) -> Option<&[u8]> {
    tag.get(start..start.checked_add(length)?)
}

fn of_description(tag: &[u8]) -> Option<String> {
    let length = word(tag, 8)?;
    let ascii = of_ascii(part(tag, 12, length)?);
    let at = 12 + length;
    // Many old profiles end here, or have a Unicode part that is empty.
    let unicode = word(tag, at + 4).and_then(|units| part(tag, at + 8, units.checked_mul(2)?)).map(of_utf16);
    Some(unicode.filter(|text| !text.is_empty()).unwrap_or(ascii))
}

fn of_localised(tag: &[u8]) -> Option<String> {
    let (count, size) = (word(tag, 8)?, word(tag, 12)?.max(12));
    let records = tag.get(16..)?.chunks_exact(size).take(count);
    let chosen =
        records.clone().find(|record| record.starts_with(b"en")).or_else(|| records.clone().next())?;
    let (length, start) = (word(chosen, 4)?, word(chosen, 8)?);
    part(tag, start, length).map(of_utf16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_comes_back_in_both_versions() {
        for text in ["Sony's monitor", "Bildschirm für Büro – 色", ""] {
            assert_eq!(of_tag(&tag(text, Role::Description, Version::Four)).unwrap(), text);
            assert_eq!(of_tag(&tag(text, Role::Description, Version::Two)).unwrap(), text);
        }
        assert_eq!(of_tag(&tag("© me", Role::Copyright, Version::Two)).unwrap(), "? me");
    }

    #[test]
    fn english_is_chosen_among_languages() {
        let mut several = b"mluc\0\0\0\0\0\0\0\x02\0\0\0\x0c".to_vec();
        several.extend(b"deDE\0\0\0\x02\0\0\0\x28enGB\0\0\0\x02\0\0\0\x2a\0D\0E");
        assert_eq!(of_tag(&several).unwrap(), "E");
        several[28..30].copy_from_slice(b"fr");
        assert_eq!(of_tag(&several).unwrap(), "D");
    }

    #[test]
    fn a_damaged_text_is_none() {
        let whole = tag("text", Role::Description, Version::Four);
        assert!((0..whole.len()).all(|end| of_tag(&whole[..end]).is_none()));
        assert_eq!(of_tag(b"desc\0\0\0\0\xff\xff\xff\xff"), None);
        assert_eq!(of_tag(b"desc\0\0\0\0\0\0\0\x02a\0").unwrap(), "a");
        assert_eq!(of_tag(b"mluc\0\0\0\0\xff\xff\xff\xff\xff\xff\xff\xff"), None);
    }
}
