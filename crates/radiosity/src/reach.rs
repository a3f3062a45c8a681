//! Which sides of objects light reaches at all: the inside of a closed body is not worth solving for, that of a room is.

use crate::elements::Elements;
use crate::form_factors::Looking;
use crate::rays;
use illuminant_scene::Geometry;
use rayon::prelude::*;

/// Rays by which each side of a coarse element looks around.
const RAYS: u32 = 64;

/// Of each object whether light reaches its outside and its inside: sides that lamps light (`lit`), and all that see such a side, or see one
/// that does. `elements` are coarse, with both sides of everything that takes part.
#[must_use]
pub fn reached(
    geometry: &Geometry,
    elements: &Elements,
    lit: &(dyn Fn(u32) -> bool + Sync),
) -> Vec<[bool; 2]> {
    let objects = geometry.objects();
    let number = |side: u32| {
        2 * elements.element_of(side).object as usize + usize::from(elements.sides[side as usize].back)
    };
    let looking = Looking::Cosine(RAYS);
    let found: Vec<(usize, bool, Vec<usize>)> = (0..elements.sides.len() as u32)
        .into_par_iter()
        .map(|side| {
            let mut seen = Vec::new();
            rays::directions(geometry, elements, side, &looking, &mut |direction| {
                let met = elements.meet(geometry, direction.ray);
                if let Some(met) = met.and_then(|(ray, hit)| elements.side_at(&ray, &hit)) {
                    seen.push(number(met));
                }
            });
            seen.sort_unstable();
            seen.dedup();
            (number(side), lit(side), seen)
        })
        .collect();
    let mut sees = vec![Vec::new(); 2 * objects];
    let mut reached = vec![false; 2 * objects];
    for (side, lit, seen) in found {
        reached[side] |= lit;
        sees[side].extend(seen);
    }
    // Light goes from what is reached to what sees it, until nothing new is.
    loop {
        let new: Vec<usize> = (0..2 * objects)
            .filter(|&side| !reached[side] && sees[side].iter().any(|&other| reached[other]))
            .collect();
        if new.is_empty() {
            break;
        }
        new.into_iter().for_each(|side| reached[side] = true);
    }
    reached.chunks(2).map(|sides| [sides[0], sides[1]]).collect()
}
