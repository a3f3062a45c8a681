//! Form factors of all sides (book eqs 4.29 and 4.32): what part of what a side receives comes from each patch.

use crate::area;
use crate::cancel::{Cancel, Cancelled};
use crate::elements::Elements;
use crate::hemicube::Hemicube;
use crate::rays;
use crate::scanline::ItemBuffer;
use crate::sparse::Sparse;
use glam::Vec3;
use illuminant_scene::{Geometry, Ray};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

/// How form factors are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// So many rays with the density of the cosine, from all over a side.
    Rays(u32),
    /// A hemi-cube of so many cells along an edge on the middle of a side, a ray through each.
    Hemicube(u32),
    /// The same, with what is seen found scanline by scanline.
    Scanline(u32),
    /// Lambert's formula at so many places of a side, and a ray to find what stands between.
    Area(u32),
}

impl Default for Method {
    fn default() -> Self {
        Self::Rays(1024)
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rays(count) => write!(f, "rays:{count}"),
            Self::Hemicube(n) => write!(f, "hemicube:{n}"),
            Self::Scanline(n) => write!(f, "scanline:{n}"),
            Self::Area(count) => write!(f, "area:{count}"),
        }
    }
}

impl FromStr for Method {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, number) = text.split_once(':').map_or((text, None), |(name, n)| (name, Some(n)));
        let number =
            |default: u32, least: u32, most: u32| match number {
                None => Ok(default),
                Some(n) => n.parse().ok().filter(|n| (least..=most).contains(n)).ok_or_else(|| {
                    format!("{text}: the number of {name} must be whole, from {least} to {most}")
                }),
            };
        let [least, most] = Hemicube::RESOLUTIONS;
        let even = |n: u32| {
            if n % 2 == 0 {
                Ok(n)
            } else {
                Err(format!("{text}: a hemi-cube has an even number of cells along an edge"))
            }
        };
        match name {
            "rays" => Ok(Self::Rays(number(1024, 1, 1 << 20)?)),
            "hemicube" => Ok(Self::Hemicube(even(number(64, least, most)?)?)),
            "scanline" => Ok(Self::Scanline(even(number(64, least, most)?)?)),
            "area" => Ok(Self::Area(number(16, 1, 1 << 16)?)),
            _ => Err(format!("no form factors {text:?}; known are rays:N, hemicube:N, scanline:N, area:N")),
        }
    }
}

/// A method that follows rays, made ready.
#[derive(Clone, Debug)]
pub enum Looking {
    /// So many rays with the density of the cosine.
    Cosine(u32),
    /// Through the cells of a hemi-cube.
    Hemicube(Hemicube),
}

impl Looking {
    /// The rays of a method; `None` for one that has no rays that could go on.
    #[must_use]
    pub fn new(method: Method) -> Option<Self> {
        match method {
            Method::Rays(count) => Some(Self::Cosine(count)),
            Method::Hemicube(n) => Some(Self::Hemicube(Hemicube::new(n))),
            Method::Scanline(_) | Method::Area(_) => None,
        }
    }
}

/// Entries of a row under way: a sum for each column, and which of them are not 0.
#[derive(Clone, Debug)]
pub struct Row {
    sums: Vec<f32>,
    touched: Vec<u32>,
}

impl Row {
    /// An empty row.
    #[must_use]
    pub fn new(width: usize) -> Self {
        Self { sums: vec![0.0; width], touched: Vec::new() }
    }

    /// Adds to an entry.
    #[inline]
    pub fn add(&mut self, column: u32, value: f32) {
        let sum = &mut self.sums[column as usize];
        if *sum == 0.0 {
            self.touched.push(column);
        }
        *sum += value;
    }

    /// The entries in order; the row is empty afterwards.
    pub fn take(&mut self) -> Vec<(u32, f32)> {
        self.touched.sort_unstable();
        self.touched.dedup();
        let sums = &mut self.sums;
        self.touched.drain(..).map(|c| (c, std::mem::take(&mut sums[c as usize]))).collect()
    }
}

/// Whether a ray meets a box.
fn is_met(ray: &Ray, (low, high): (Vec3, Vec3)) -> bool {
    let inverse = ray.direction.recip();
    let (a, b) = ((low - ray.origin) * inverse, (high - ray.origin) * inverse);
    // 0 · ∞ is no number, and min and max pass it over.
    let near = a.min(b).max_element().max(0.0);
    let far = a.max(b).min_element();
    !(near > far)
}

/// The form factors of a scene, and how good they are.
#[derive(Clone, Debug)]
pub struct FormFactors {
    /// A row for each side, a column for each patch.
    pub rows: Sparse,
    /// The part of each side's surroundings that is not in its row: open, or a side that no light reaches.
    pub open: Vec<f32>,
}

impl FormFactors {
    /// Finds the form factors of all sides.
    #[must_use]
    pub fn new(geometry: &Geometry, elements: &Elements, method: Method) -> Self {
        let sides = 0..elements.sides.len() as u32;
        Self::of(elements, &sides.collect::<Vec<_>>(), geometry, method, &Cancel::default())
    }

    /// The same, which stops between rows when it is told to.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn unless_cancelled(
        geometry: &Geometry,
        elements: &Elements,
        method: Method,
        cancel: &Cancel,
    ) -> Result<Self, Cancelled> {
        let sides = 0..elements.sides.len() as u32;
        let found = Self::of(elements, &sides.collect::<Vec<_>>(), geometry, method, cancel);
        cancel.check().map(|()| found)
    }

    /// The rows of sides. Those that are not begun when it is cancelled are empty.
    #[must_use]
    pub fn of(
        elements: &Elements,
        sides: &[u32],
        geometry: &Geometry,
        method: Method,
        cancel: &Cancel,
    ) -> Self {
        let width = elements.patches.len();
        let looking = Looking::new(method);
        let cube = match method {
            Method::Scanline(n) => Some(Hemicube::new(n)),
            _ => None,
        };
        let scratch = || {
            let buffer = cube.as_ref().map(|cube| ItemBuffer::new(cube, elements));
            (Row::new(width), buffer)
        };
        let rows: Vec<Vec<(u32, f32)>> = sides
            .par_iter()
            .map_init(scratch, |(row, buffer), &side| {
                if cancel.is_cancelled() {
                    return Vec::new();
                }
                let patch =
                    |element, back| elements.side(element, back).map(|s| elements.patch_of[s as usize]);
                match (&looking, &cube, buffer) {
                    (Some(looking), ..) => {
                        rays::directions(geometry, elements, side, looking, &mut |direction| {
                            let met = elements.meet(geometry, direction.ray);
                            let met = met.and_then(|(ray, hit)| elements.side_at(&ray, &hit));
                            if let Some(met) = met {
                                row.add(elements.patch_of[met as usize], direction.part);
                            }
                        });
                    }
                    (_, Some(cube), Some(buffer)) => {
                        buffer.look(geometry, elements, side, cube, &mut |element, back, part| {
                            if let Some(patch) = patch(element, back) {
                                row.add(patch, part);
                            }
                        });
                    }
                    _ => {
                        let Method::Area(count) = method else { return row.take() };
                        area::look(geometry, elements, side, count, &mut |element, back, part| {
                            if let Some(patch) = patch(element, back) {
                                row.add(patch, part);
                            }
                        });
                    }
                }
                row.take()
            })
            .collect();
        Self::from_rows(Sparse::from_rows(&rows, width))
    }

    /// Form factors that are known.
    #[must_use]
    pub fn from_rows(rows: Sparse) -> Self {
        let open = (0..rows.height()).map(|i| (1.0 - rows.sum(i)) as f32).collect();
        Self { rows, open }
    }

    /// The form factors after objects have moved (Baum et al. 1986), and how many rows had to be found again: those of the objects' own sides,
    /// those that saw one of them, and those of which a ray meets a box in which one was or is. All others are what they were.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn updated(
        &self,
        geometry: &Geometry,
        elements: &Elements,
        looking: &Looking,
        method: Method,
        objects: &[usize],
        boxes: &[(Vec3, Vec3)],
        cancel: &Cancel,
    ) -> Result<(Self, usize), Cancelled> {
        let moves: Vec<bool> = (0..geometry.objects()).map(|object| objects.contains(&object)).collect();
        let of = |side: u32| moves[elements.element_of(side).object as usize];
        let patch_moves: Vec<bool> = elements.patches.iter().map(|sides| of(sides[0])).collect();
        let again: Vec<u32> = (0..elements.sides.len() as u32)
            .into_par_iter()
            .filter(|&side| {
                if cancel.is_cancelled() {
                    return false;
                }
                let sees = || self.rows.row(side as usize).0.iter().any(|&patch| patch_moves[patch as usize]);
                let meets = || {
                    let mut met = false;
                    rays::directions(geometry, elements, side, looking, &mut |direction| {
                        met = met || boxes.iter().any(|&b| is_met(&direction.ray, b));
                    });
                    met
                };
                of(side) || sees() || meets()
            })
            .collect();
        let new = Self::of(elements, &again, geometry, method, cancel);
        cancel.check()?;
        let mut next = 0;
        let rows: Vec<Vec<(u32, f32)>> = (0..self.rows.height())
            .map(|side| {
                let (from, row) = if again.get(next) == Some(&(side as u32)) {
                    next += 1;
                    (&new.rows, next - 1)
                } else {
                    (&self.rows, side)
                };
                let (columns, values) = from.row(row);
                columns.iter().copied().zip(values.iter().copied()).collect()
            })
            .collect();
        Ok((Self::from_rows(Sparse::from_rows(&rows, elements.patches.len())), again.len()))
    }

    /// How far rows are from a sum of 1, in the mean and at most: the closure error of a scene that is closed, Σ F = 1.
    #[must_use]
    pub fn closure(&self) -> [f64; 2] {
        let errors = self.open.iter().map(|v| f64::from(v.abs()));
        let count = self.open.len().max(1) as f64;
        [errors.clone().sum::<f64>() / count, errors.fold(0.0, f64::max)]
    }

    /// The form factors from patch to patch: of each patch the mean of its sides' rows by area.
    #[must_use]
    pub fn between_patches(&self, elements: &Elements) -> Sparse {
        let rows: Vec<Vec<(u32, f32)>> = elements
            .patches
            .par_iter()
            .map_init(
                || Row::new(elements.patches.len()),
                |row, sides| {
                    let area: f64 = sides.iter().map(|&s| elements.area(s)).sum();
                    for &side in sides {
                        let share = (elements.area(side) / area) as f32;
                        let (columns, values) = self.rows.row(side as usize);
                        for (&column, &value) in columns.iter().zip(values) {
                            row.add(column, share * value);
                        }
                    }
                    row.take()
                },
            )
            .collect();
        Sparse::from_rows(&rows, elements.patches.len())
    }

    /// How far the form factors are from reciprocity, A_i F_ij = A_j F_ji: the part of all exchange between sides of objects in which the
    /// two directions differ. (Single form factors found by a few rays each differ by chance.)
    #[must_use]
    pub fn reciprocity(&self, elements: &Elements) -> f64 {
        let number = |side: u32| {
            2 * elements.element_of(side).object as usize + usize::from(elements.sides[side as usize].back)
        };
        let mut exchanged: BTreeMap<(usize, usize), f64> = BTreeMap::new();
        for side in 0..elements.sides.len() as u32 {
            let (own, area) = (number(side), elements.area(side));
            let (columns, values) = self.rows.row(side as usize);
            for (&patch, &value) in columns.iter().zip(values) {
                let other = number(elements.patches[patch as usize][0]);
                *exchanged.entry((own, other)).or_default() += area * f64::from(value);
            }
        }
        let of = |pair: (usize, usize)| exchanged.get(&pair).copied().unwrap_or(0.0);
        let (mut apart, mut all) = (0.0, 0.0);
        for (&(i, j), &value) in &exchanged {
            // A pair of which one direction is nothing stands here once, any other twice.
            let twice = if exchanged.contains_key(&(j, i)) { 0.5 } else { 1.0 };
            apart += twice * (value - of((j, i))).abs();
            all += value;
        }
        if all > 0.0 { apart / all } else { 0.0 }
    }
}
