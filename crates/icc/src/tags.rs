//! The frame of a profile: its header of 128 bytes, the table of tags, and their contents (ICC.1:2022, 7).

use crate::{D50, IccError, Version};

const HEADER: usize = 128;
const ENTRY: usize = 12;

/// A profile of a display is far smaller, and a tag of a larger file would only cost memory.
const LARGEST: usize = 64 << 20;

/// Numbers of 16 bits before and 16 behind the point.
pub(crate) mod fixed {
    /// The number nearest to a value.
    pub(crate) fn of(value: f64) -> i32 {
        (value * 65536.0).round() as i32
    }

    /// The value of a number.
    pub(crate) fn value(number: i32) -> f64 {
        f64::from(number) / 65536.0
    }
}

/// A profile that is read: its tags by name.
pub(crate) struct Tags<'a> {
    bytes: &'a [u8],
    table: Vec<([u8; 4], usize, usize)>,
    /// Edition of the standard; 3 was never published, and counts as 2.
    pub(crate) version: Version,
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_be_bytes(*bytes.get(at..)?.first_chunk()?))
}

fn name(bytes: &[u8], at: usize) -> [u8; 4] {
    bytes.get(at..).and_then(|rest| rest.first_chunk()).copied().unwrap_or_default()
}

/// A signature as a person reads it.
pub(crate) fn shown(signature: &[u8]) -> String {
    signature.escape_ascii().to_string().trim().to_string()
}

impl<'a> Tags<'a> {
    /// Reads header and table of a profile of an RGB display.
    pub(crate) fn of(bytes: &'a [u8]) -> Result<Self, IccError> {
        let stranger = |why: String| Err(IccError::NotAProfile(why));
        if bytes.len() < HEADER + 4 {
            return stranger(format!("it has {} bytes, and a header alone has {HEADER}", bytes.len()));
        }
        if name(bytes, 36) != *b"acsp" {
            return stranger("the signature acsp is not in its header".into());
        }
        if bytes.len() > LARGEST {
            return Err(IccError::Unsuitable(format!("it has more than {} MiB", LARGEST >> 20)));
        }
        let size = word(bytes, 0).unwrap_or(0) as usize;
        if size > bytes.len() {
            return Err(IccError::Damaged(format!("it ends after {} of {size} bytes", bytes.len())));
        }
        let version = match bytes[8] {
            2 | 3 => Version::Two,
            4 => Version::Four,
            other => {
                return Err(IccError::Unsuitable(format!("it is of version {other}, and 2 and 4 are read")));
            }
        };
        let (class, space, connection) = (name(bytes, 12), name(bytes, 16), name(bytes, 20));
        if space != *b"RGB " {
            return Err(IccError::Unsuitable(format!("it is for {} colours, not RGB", shown(&space))));
        }
        if ![*b"mntr", *b"spac", *b"scnr"].contains(&class) {
            return Err(IccError::Unsuitable(format!("it is of the class {}, not mntr", shown(&class))));
        }
        let count = word(bytes, HEADER).unwrap_or(0) as usize;
        let entries = bytes.get(HEADER + 4..).unwrap_or_default();
        if count > entries.len() / ENTRY {
            return Err(IccError::Damaged(format!("its table of {count} tags goes beyond its end")));
        }
        let entries = entries.chunks_exact(ENTRY).take(count);
        let place = |entry: &[u8], at| word(entry, at).unwrap_or(0) as usize;
        let table = entries.map(|entry| (name(entry, 0), place(entry, 4), place(entry, 8))).collect();
        let tags = Self { bytes, table, version };
        if connection != *b"XYZ " && tags.has(b"rXYZ") {
            return Err(IccError::Damaged("it has primaries, and its connection space is not XYZ".into()));
        }
        Ok(tags)
    }

    /// Whether the table has a tag of this name.
    pub(crate) fn has(&self, name: &[u8; 4]) -> bool {
        self.table.iter().any(|entry| entry.0 == *name)
    }

    /// The content of a tag, or `None` when there is none of this name.
    pub(crate) fn optional(&self, name: &[u8; 4]) -> Result<Option<&'a [u8]>, IccError> {
        let Some((_, start, size)) = self.table.iter().find(|entry| entry.0 == *name) else {
            return Ok(None);
        };
        let content = start.checked_add(*size).and_then(|end| self.bytes.get(*start..end));
        let Some(content) = content else {
            return Err(IccError::Damaged(format!("its tag {} goes beyond its end", shown(name))));
        };
        Ok(Some(content))
    }

    /// The content of a tag without which there is no display.
    pub(crate) fn needed(&self, name: &[u8; 4]) -> Result<&'a [u8], IccError> {
        self.optional(name)?.ok_or_else(|| {
            IccError::Damaged(format!("it has no tag {}, and a display needs it", shown(name)))
        })
    }

    /// Numbers of a tag of the type `XYZ ` or `sf32`.
    pub(crate) fn numbers<const N: usize>(content: &[u8], name: &[u8; 4]) -> Result<[f64; N], IccError> {
        let kind: &[u8] = if N == 3 { b"XYZ " } else { b"sf32" };
        let numbers = content.get(8..8 + 4 * N).filter(|_| content.starts_with(kind));
        let Some(numbers) = numbers else {
            let wanted = shown(kind);
            return Err(IccError::Damaged(format!(
                "its tag {} is not {N} numbers of type {wanted}",
                shown(name)
            )));
        };
        let mut found = [0.0; N];
        for (value, number) in found.iter_mut().zip(numbers.chunks_exact(4)) {
            *value = fixed::value(i32::from_be_bytes([number[0], number[1], number[2], number[3]]));
        }
        Ok(found)
    }
}

/// The content of a tag that holds numbers.
pub(crate) fn number_tag(kind: &[u8; 4], numbers: impl IntoIterator<Item = i32>) -> Vec<u8> {
    let mut tag = kind.to_vec();
    tag.extend([0; 4]);
    tag.extend(numbers.into_iter().flat_map(i32::to_be_bytes));
    tag
}

/// A whole profile of these tags. Contents begin at multiples of four bytes, and equal ones are stored once.
pub(crate) fn assemble(version: Version, tags: &[([u8; 4], Vec<u8>)]) -> Vec<u8> {
    let mut table = (tags.len() as u32).to_be_bytes().to_vec();
    let mut contents: Vec<u8> = Vec::new();
    let first = HEADER + 4 + ENTRY * tags.len();
    let mut places: Vec<(&[u8], usize)> = Vec::new();
    for (name, content) in tags {
        let known = places.iter().find(|(other, _)| other == content).map(|(_, place)| *place);
        let place = known.unwrap_or(first + contents.len());
        if known.is_none() {
            places.push((content, place));
            contents.extend(content);
            contents.resize(contents.len().next_multiple_of(4), 0);
        }
        table.extend(name);
        table.extend((place as u32).to_be_bytes());
        table.extend((content.len() as u32).to_be_bytes());
    }
    let mut profile = header(version, first + contents.len());
    profile.extend(table);
    profile.extend(contents);
    if version == Version::Four {
        // Over the whole profile, with flags, intent and the identity itself taken as zero (7.2.18).
        let mut plain = profile.clone();
        for range in [44..48, 64..68, 84..100] {
            plain[range].fill(0);
        }
        profile[84..100].copy_from_slice(&md5::compute(&plain).0);
    }
    profile
}

fn header(version: Version, size: usize) -> Vec<u8> {
    let mut header = Vec::with_capacity(HEADER);
    header.extend((size as u32).to_be_bytes());
    header.extend([0; 4]);
    header.extend(match version {
        Version::Two => [2, 0x40, 0, 0],
        Version::Four => [4, 0x40, 0, 0],
    });
    header.extend(b"mntrRGB XYZ ");
    // A fixed date, 2000-01-01, since a profile is to depend on its display alone.
    header.extend([2000, 1, 1, 0, 0, 0].into_iter().flat_map(u16::to_be_bytes));
    header.extend(b"acsp");
    header.extend([0; 24]);
    // The intent is media-relative colorimetric: what a matrix is.
    header.extend(1_u32.to_be_bytes());
    header.extend(D50.into_iter().flat_map(|v| fixed::of(v).to_be_bytes()));
    header.resize(HEADER, 0);
    header
}
