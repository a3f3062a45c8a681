//! A part of a render: what some of its samples have brought, to be kept in a file or sent from one machine to another.
//!
//! The film's sums are exact, so parts of the same scene with the same settings can be joined in any order: the bits are those
//! of a render that took all samples itself. A part knows which samples it holds, tile by tile, and none is joined twice. Its
//! bytes are those of the crate `postcard`: whole numbers of variable length, in which a sum takes about 9 bytes.

use crate::film::{Film, TileFilm};
use crate::render::Statistics;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use thiserror::Error;

/// The form of the bytes; another one cannot be read.
const FORM: u32 = 1;

/// Why a part cannot be joined.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum PartError {
    /// The bytes are no part, or damaged.
    #[error("the part of the render is damaged: {0}")]
    Damaged(String),
    /// The part is of another image.
    #[error("the part is of another render: {0}")]
    Other(String),
    /// Its samples are there already.
    #[error("samples {} to {} of tile {tile} are in the render already", range.start, range.end)]
    Twice {
        /// The tile.
        tile: usize,
        /// The samples of the part that overlap.
        range: Range<u64>,
    },
}

/// The sums of one tile, or of what paths from lamps brought.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct TilePart {
    seen: Vec<Range<u64>>,
    samples: Vec<u32>,
    sums: Vec<i128>,
}

/// What some samples of a render have brought.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Part {
    form: u32,
    crop: [u32; 4],
    layers: Vec<String>,
    /// The tiles that hold a sample, by number.
    tiles: Vec<(u32, TilePart)>,
    from_lamps: Option<TilePart>,
    statistics: Statistics,
}

impl TilePart {
    fn of(film: &TileFilm) -> Option<Self> {
        (!film.seen.is_empty()).then(|| Self {
            seen: film.seen.clone(),
            samples: film.samples.clone(),
            sums: film.sums.clone(),
        })
    }

    /// Whether it fits the sums of a tile and holds nothing that those hold.
    fn check(&self, film: &TileFilm, tile: usize) -> Result<(), PartError> {
        let damaged = |what: &str| Err(PartError::Damaged(format!("tile {tile} {what}")));
        if self.samples.len() != film.samples.len() || self.sums.len() != film.sums.len() {
            return damaged("has another size");
        }
        let rising = self.seen.windows(2).all(|pair| pair[0].end < pair[1].start);
        if !rising || self.seen.iter().any(|range| range.start >= range.end || range.end > 1 << 32) {
            return damaged("names its samples wrongly");
        }
        let most: u64 = self.seen.iter().map(|range| range.end - range.start).sum();
        if self.samples.iter().any(|&held| u64::from(held) > most) {
            return damaged("counts more samples than it holds");
        }
        // No sample is larger than 2⁴⁷ in units of 2⁻⁴⁸, so no sum of what has been seen is larger than this.
        let bound = i128::from(most) << 95;
        if self.sums.iter().any(|sum| !(-bound..=bound).contains(sum)) {
            return damaged("holds a sum that its samples cannot have");
        }
        for part in &self.seen {
            if let Some(there) =
                film.seen.iter().find(|there| there.start < part.end && part.start < there.end)
            {
                let range = part.start.max(there.start)..part.end.min(there.end);
                return Err(PartError::Twice { tile, range });
            }
        }
        Ok(())
    }

    fn join(self, film: &mut TileFilm) {
        for range in self.seen {
            film.claim(range);
        }
        film.samples.iter_mut().zip(self.samples).for_each(|(held, more)| *held = held.saturating_add(more));
        film.sums.iter_mut().zip(self.sums).for_each(|(sum, more)| *sum = sum.saturating_add(more));
    }
}

impl Part {
    /// All that a film holds.
    pub(crate) fn of(film: &Film, statistics: &Statistics) -> Self {
        let tiles = film.tiles.iter().enumerate();
        Self {
            form: FORM,
            crop: film.crop,
            layers: film.plan.iter().map(|plan| plan.name.clone()).collect(),
            tiles: tiles.filter_map(|(i, tile)| Some((i as u32, TilePart::of(tile)?))).collect(),
            from_lamps: film.from_lamps.as_ref().and_then(TilePart::of),
            statistics: statistics.clone(),
        }
    }

    /// The part as bytes.
    ///
    /// # Errors
    /// [`PartError::Damaged`] if it cannot be written, which no part that a render gave does.
    pub fn to_bytes(&self) -> Result<Vec<u8>, PartError> {
        postcard::to_stdvec(self).map_err(|error| PartError::Damaged(error.to_string()))
    }

    /// A part from its bytes, which may come from anywhere.
    ///
    /// # Errors
    /// [`PartError::Damaged`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, PartError> {
        let damaged = |what: String| PartError::Damaged(what);
        let (part, rest): (Self, _) =
            postcard::take_from_bytes(bytes).map_err(|error| damaged(error.to_string()))?;
        if !rest.is_empty() {
            return Err(damaged(format!("{} bytes follow its end", rest.len())));
        }
        if part.form != FORM {
            return Err(damaged(format!("it has form {}, and this version reads form {FORM}", part.form)));
        }
        Ok(part)
    }

    /// Joins the part to a film; all of it, or nothing.
    pub(crate) fn join(self, film: &mut Film, statistics: &mut Statistics) -> Result<(), PartError> {
        let other = |what: &str| Err(PartError::Other(format!("its {what} differ")));
        if self.crop != film.crop {
            return other("pixels");
        }
        if !self.layers.iter().eq(film.plan.iter().map(|plan| &plan.name)) {
            return other("layers");
        }
        if self.from_lamps.is_some() && film.from_lamps.is_none() {
            return other("paths from lamps");
        }
        let rising = self.tiles.windows(2).all(|pair| pair[0].0 < pair[1].0);
        if !rising || self.tiles.last().is_some_and(|(tile, _)| *tile as usize >= film.tiles.len()) {
            return Err(PartError::Damaged("its tiles are not those of the image".into()));
        }
        for (tile, part) in &self.tiles {
            part.check(&film.tiles[*tile as usize], *tile as usize)?;
        }
        if let (Some(part), Some(film)) = (&self.from_lamps, &film.from_lamps) {
            part.check(film, 0)?;
        }
        for (tile, part) in self.tiles {
            part.join(&mut film.tiles[tile as usize]);
        }
        if let (Some(part), Some(film)) = (self.from_lamps, &mut film.from_lamps) {
            part.join(film);
        }
        statistics.join(self.statistics);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::Settings;
    use proptest::prelude::*;

    fn film() -> Film {
        Film::new([0, 0, 40, 24], &Settings::default(), &[], 8)
    }

    /// A film with samples of some tiles.
    fn with(tiles: Range<usize>, samples: Range<u64>) -> Film {
        let mut film = film();
        for tile in &mut film.tiles[tiles] {
            for sample in tile.claim(samples.clone()).into_iter().flatten() {
                for pixel in 0..tile.samples.len() {
                    tile.add(pixel, &[sample as f32 + 0.3, -0.1 * pixel as f32, 1e9]);
                }
            }
        }
        film
    }

    fn bytes(film: &Film) -> Vec<u8> {
        Part::of(film, &Statistics::default()).to_bytes().expect("a part of a film can be written")
    }

    #[test]
    fn parts_join_in_any_order_to_the_bits_of_the_whole() {
        let whole = bytes(&with(0..6, 0..8));
        let parts = [with(0..2, 0..8), with(2..6, 4..8), with(2..6, 0..4)].map(|film| bytes(&film));
        for order in [[0, 1, 2], [2, 0, 1], [1, 2, 0]] {
            let (mut film, mut statistics) = (film(), Statistics::default());
            for i in order {
                let part = Part::from_bytes(&parts[i]).expect("it was just written");
                part.join(&mut film, &mut statistics).expect("the parts are disjoint");
            }
            assert_eq!(bytes(&film), whole);
        }
    }

    #[test]
    fn nothing_is_joined_twice_or_to_another_image() {
        let mut film = with(0..3, 0..8);
        let before = bytes(&film);
        let join = |film: &mut Film, part: &Film| {
            let part = Part::from_bytes(&bytes(part)).expect("it was just written");
            part.join(film, &mut Statistics::default())
        };
        // Tile 3 is new, and tile 2 is not: nothing of the part is taken.
        let twice = join(&mut film, &with(2..4, 6..10));
        assert_eq!(twice, Err(PartError::Twice { tile: 2, range: 6..8 }));
        let other = Film::new([0, 0, 40, 23], &Settings::default(), &[], 8);
        assert!(matches!(join(&mut film, &other), Err(PartError::Other(_))));
        assert_eq!(bytes(&film), before);
        assert_eq!(join(&mut film, &with(2..4, 8..10)), Ok(()));
    }

    proptest! {
        #[test]
        fn damage_is_refused_or_harmless(at in 0usize..4000, bit in 0u8..8) {
            let mut film = with(0..1, 0..2);
            let mut damaged = bytes(&with(1..3, 0..2));
            let at = at % damaged.len();
            damaged[at] ^= 1 << bit;
            if let Ok(part) = Part::from_bytes(&damaged) {
                let _ = part.join(&mut film, &mut Statistics::default());
            }
            prop_assert!(Part::from_bytes(&damaged[..at]).is_err());
        }
    }
}
