//! Which sides of objects light reaches at all: the inside of a closed body is not worth solving for, that of a room is.

use crate::cancel::{Cancel, Cancelled};
use crate::elements::{Elements, Part};
use crate::form_factors::Looking;
use crate::rays;
use illuminant_scene::Geometry;
use rayon::prelude::*;

/// Rays by which each side of a coarse element looks around.
const RAYS: u32 = 64;

/// Of each object whether light reaches its outside and its inside: sides that lamps light (`lit`), all that see such a side, or see one
/// that does, and both sides of a sheet that lets light through (`sheets`, one for each object). `elements` are coarse, with both
/// sides of everything that takes part.
///
/// # Errors
/// [`Cancelled`].
pub fn reached(
    geometry: &Geometry,
    elements: &Elements,
    sheets: &[bool],
    lit: &(dyn Fn(u32) -> bool + Sync),
    cancel: &Cancel,
) -> Result<Vec<[bool; 2]>, Cancelled> {
    let objects = geometry.objects();
    let number = |side: u32| {
        2 * elements.element_of(side).object as usize + usize::from(elements.sides[side as usize].back)
    };
    let looking = Looking::Cosine(RAYS);
    let found: Vec<(usize, bool, Vec<usize>)> = (0..elements.sides.len() as u32)
        .into_par_iter()
        .map(|side| {
            cancel.check()?;
            let mut seen = Vec::new();
            let mut other = false;
            rays::directions(geometry, elements, side, &looking, &mut |direction| {
                let Some((ray, hit)) = elements.meet(geometry, direction.ray) else { return };
                // Mirrors and glass may bring light from anywhere.
                other |= elements.part(hit.object) == Part::Apart;
                seen.extend(elements.side_at(&ray, &hit).map(number));
            });
            seen.sort_unstable();
            seen.dedup();
            Ok((number(side), other || lit(side), seen))
        })
        .collect::<Result<_, Cancelled>>()?;
    let mut sees = vec![Vec::new(); 2 * objects];
    let mut reached = vec![false; 2 * objects];
    for (side, lit, seen) in found {
        reached[side] |= lit;
        sees[side].extend(seen);
    }
    // Light goes from what is reached to what sees it, until nothing new is.
    loop {
        let new: Vec<usize> = (0..2 * objects)
            .filter(|&side| {
                let through = sheets[side / 2] && reached[side ^ 1];
                !reached[side] && (through || sees[side].iter().any(|&other| reached[other]))
            })
            .collect();
        if new.is_empty() {
            break;
        }
        new.into_iter().for_each(|side| reached[side] = true);
    }
    Ok(reached.chunks(2).map(|sides| [sides[0], sides[1]]).collect())
}
