//! Dot diffusion (Knuth 1987): error diffusion in an order that is the same in every small cell.
//!
//! A matrix of classes is laid over the image. Classes are taken in order; the pixels of a class get the code
//! nearest to d = v(2ᵇ − 1) + what they have been given, and divide their error e = d − code among the neighbours
//! of higher class: two parts to each of the four beside it, one to each of the four at its corners, across the
//! borders of cells. A pixel without such neighbours (a *baron*) keeps its error, and so does what would be given
//! over the edge of the image: both are lost. So an error never travels far, and there are no ghosts of it
//! elsewhere; at one bit the codes grow as dots around the barons.
//!
//! In f32, where the bits are defined: q = e · (1/parts), each pixel computes d = v(2ᵇ − 1) + (2s + c), with s the
//! sum of q over the neighbours of lower class above, left, right and below, in this order, and c over those above
//! left, above right, below left and below right; code = ⌊d + ½⌋, clamped to 0 … 2ᵇ − 1.
//!
//! Order of work: since errors travel no farther than five pixels in these two matrices, an image is cut into
//! tiles, each computed with a border of cells that are thrown away. In a tile, the pixels of one class in all
//! cells lie side by side, so that a vector holds eight cells, and a neighbour is the same place in another class's
//! plane, or one beside it.

use super::{Code, DitherError, one_by_one, to_code, top, unit};
use rayon::prelude::*;

/// Which pixels of a cell come first.
#[derive(Clone, Debug, PartialEq)]
pub struct ClassMatrix {
    size: usize,
    classes: Vec<usize>,
}

/// Beside a pixel, in the order in which errors are added.
const BESIDE: [(isize, isize); 4] = [(0, -1), (-1, 0), (1, 0), (0, 1)];
/// At its corners.
const CORNERS: [(isize, isize); 4] = [(-1, -1), (1, -1), (-1, 1), (1, 1)];
/// Cells that go through the arithmetic together.
const RUN: usize = 16;
/// Pixels of a tile, whose planes for three channels stay in a second-level cache.
const TILE: (usize, usize) = (240, 64);

impl ClassMatrix {
    /// Knuth's matrix of 8 × 8, with two barons.
    #[must_use]
    pub fn knuth() -> Self {
        #[rustfmt::skip]
        let classes = vec![
            34, 48, 40, 32, 29, 15, 23, 31,
            42, 58, 56, 53, 21,  5,  7, 10,
            50, 62, 61, 45, 13,  1,  2, 18,
            38, 46, 54, 37, 25, 17,  9, 26,
            28, 14, 22, 30, 35, 49, 41, 33,
            20,  4,  6, 11, 43, 59, 57, 52,
            12,  0,  3, 19, 51, 63, 60, 44,
            24, 16,  8, 27, 39, 47, 55, 36,
        ];
        Self { size: 8, classes }
    }

    /// A cell of 4 × 4, as in the book's figure 5.12. The book prints no matrix; this one is built as Knuth's is:
    /// classes half a cell apart in a row add up to the highest, so that dark and light dots mirror each other. Its
    /// two barons lose up to half a code each: a field may be wrong by a sixteenth of a code, and at one bit the
    /// darkest and lightest greys are lost.
    #[must_use]
    pub fn four() -> Self {
        #[rustfmt::skip]
        let classes = vec![
            14, 13,  1,  2,
             4,  6, 11,  9,
             0,  3, 15, 12,
            10,  8,  5,  7,
        ];
        Self { size: 4, classes }
    }

    /// A matrix of one's own: `size` × `size` classes in rows from the top.
    ///
    /// # Errors
    /// Not every class 0 … `size`² − 1 is there once, or the size is not in 1 … 16.
    pub fn new(size: usize, classes: Vec<usize>) -> Result<Self, DitherError> {
        let mut sorted = classes.clone();
        sorted.sort_unstable();
        if !(1..=16).contains(&size) || !sorted.into_iter().eq(0..size * size) {
            let message =
                format!("a class matrix has a size of 1 to 16 and each class once, not {classes:?}");
            return Err(DitherError::Tile(message));
        }
        Ok(Self { size, classes })
    }

    /// Pixels on a side.
    #[must_use]
    pub fn size(&self) -> usize {
        self.size
    }

    /// The class at a pixel of an image.
    #[must_use]
    pub fn class(&self, x: usize, y: usize) -> usize {
        self.classes[y % self.size * self.size + x % self.size]
    }

    /// The neighbour's place in the cell and the cell's place beside ours.
    fn neighbour(&self, place: usize, (dx, dy): (isize, isize)) -> (usize, (isize, isize)) {
        let size = self.size as isize;
        let (x, y) = ((place % self.size) as isize + dx, (place / self.size) as isize + dy);
        let cell = (x.div_euclid(size), y.div_euclid(size));
        ((y.rem_euclid(size) * size + x.rem_euclid(size)) as usize, cell)
    }

    /// The number of parts into which a pixel divides its error.
    fn parts(&self, place: usize) -> usize {
        let higher = |offset| self.classes[self.neighbour(place, offset).0] > self.classes[place];
        2 * BESIDE.into_iter().filter(|&o| higher(o)).count()
            + CORNERS.into_iter().filter(|&o| higher(o)).count()
    }

    /// Places of the cell by class.
    fn order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.classes.len()).collect();
        order.sort_by_key(|&place| self.classes[place]);
        order
    }

    /// The number of pixels, in any direction, beyond which nothing has a part in a pixel's code.
    fn reach(&self) -> usize {
        let mut reach = vec![[0usize; 4]; self.classes.len()];
        for place in self.order() {
            for offset in BESIDE.into_iter().chain(CORNERS) {
                let from = self.neighbour(place, offset).0;
                if self.classes[from] < self.classes[place] {
                    let steps = [-offset.0, offset.0, -offset.1, offset.1];
                    for (side, step) in steps.into_iter().enumerate() {
                        let through = reach[from][side].saturating_add_signed(step);
                        reach[place][side] = reach[place][side].max(through);
                    }
                }
            }
        }
        reach.into_iter().flatten().max().unwrap_or(0)
    }
}

/// How one class of the cell is worked out: everything as offsets into the planes of a tile.
struct Class {
    place: usize,
    own: usize,
    beside: Vec<usize>,
    corners: Vec<usize>,
    share: f32,
}

/// Planes of a tile: for each place of the cell and each channel, the cells in rows. A cell more on every side
/// keeps neighbours within the plane; what it holds has no part in codes that are kept.
struct Layout {
    size: usize,
    channels: usize,
    columns: usize,
    rows: usize,
    /// Cells of the border.
    border: usize,
    stride: usize,
    plane: usize,
}

impl Layout {
    fn new(classes: &ClassMatrix, channels: usize) -> Self {
        let size = classes.size;
        let border = classes.reach().div_ceil(size);
        let columns = TILE.0 / size + 2 * border;
        let rows = TILE.1 / size + 2 * border;
        let stride = columns + 2;
        // A cell before the first row, and what the last run touches behind the last.
        let plane = (1 + (rows + 2) * stride + RUN).next_multiple_of(RUN);
        Self { size, channels, columns, rows, border, stride, plane }
    }

    /// Where the first cell of a plane lies.
    fn first(&self, place: usize, channel: usize) -> usize {
        (place * self.channels + channel) * self.plane + 1 + self.stride + 1
    }
}

pub(super) fn quantise<T: Code>(
    values: &[f32],
    width: usize,
    channels: usize,
    bits: u32,
    matrix: &ClassMatrix,
    codes: &mut [T],
) {
    if channels > 4 {
        // The planes of a tile would outgrow the cache.
        return one_by_one(values, channels, codes, |values, codes| {
            quantise(values, width, 1, bits, matrix, codes);
        });
    }
    let layout = Layout::new(matrix, channels);
    let classes: Vec<Class> = matrix
        .order()
        .into_iter()
        .map(|place| {
            let lower = |offsets: [(isize, isize); 4]| -> Vec<usize> {
                let lower = offsets.into_iter().map(|offset| matrix.neighbour(place, offset));
                lower
                    .filter(|&(from, _)| matrix.classes[from] < matrix.classes[place])
                    .map(|(from, (x, y))| {
                        // From the first cell of the run, which lies a column before the first cell of the tile.
                        (layout.first(from, 0) - 1).wrapping_add_signed(y * layout.stride as isize + x)
                    })
                    .collect()
            };
            let parts = matrix.parts(place);
            Class {
                place,
                own: layout.first(place, 0) - 1,
                beside: lower(BESIDE),
                corners: lower(CORNERS),
                share: if parts == 0 { 0.0 } else { 1.0 / parts as f32 },
            }
        })
        .collect();
    let planes = matrix.classes.len() * channels * layout.plane;
    let band = TILE.1 / layout.size * layout.size;
    let row = width * channels;
    codes.par_chunks_mut(row * band).enumerate().for_each_init(
        || (vec![0.0; planes], vec![T::default(); planes]),
        |(sums, shown), (index, codes)| {
            for left in (0..width).step_by(TILE.0 / layout.size * layout.size) {
                let corner = (
                    left as isize - (layout.border * layout.size) as isize,
                    (index * band) as isize - (layout.border * layout.size) as isize,
                );
                load(&layout, values, width, top(bits), corner, sums);
                let outside = Outside::new(&layout, corner, width, values.len() / row);
                for class in &classes {
                    for channel in 0..channels {
                        diffuse(&layout, class, channel * layout.plane, top(bits), sums, shown);
                        outside.clear(&layout, class.place, channel, sums);
                    }
                }
                unload(&layout, shown, left, width, codes);
            }
        },
    );
}

/// Values into the planes, times the highest code.
fn load(
    layout: &Layout,
    values: &[f32],
    width: usize,
    top: f32,
    (left, above): (isize, isize),
    sums: &mut [f32],
) {
    let channels = layout.channels;
    let cell = layout.size * channels;
    let height = values.len() / (width * channels);
    let mut line = vec![0.0; layout.columns * cell];
    // The part of the line that lies in the image.
    let from = (-left).max(0) as usize;
    let to = (layout.columns * layout.size).min((width as isize - left).max(0) as usize);
    for line_y in 0..layout.rows * layout.size {
        let y = above + line_y as isize;
        if (0..height as isize).contains(&y) && from < to {
            let start = (y as usize * width + left.saturating_add_unsigned(from) as usize) * channels;
            let values = &values[start..start + (to - from) * channels];
            for (to, &value) in line[from * channels..to * channels].iter_mut().zip(values) {
                *to = unit(value) * top;
            }
        } else {
            line.fill(0.0);
        }
        let (row, place) = (line_y / layout.size, line_y % layout.size * layout.size);
        for part in 0..cell {
            let start = layout.first(place, 0) + part * layout.plane + row * layout.stride;
            let plane = &mut sums[start - 1..start + layout.columns + 1];
            plane[0] = 0.0;
            plane[layout.columns + 1] = 0.0;
            for (to, from) in plane[1..].iter_mut().zip(line.iter().skip(part).step_by(cell)) {
                *to = *from;
            }
        }
    }
}

/// One class in one channel: values to codes and to parts of errors, where the values were.
fn diffuse<T: Code>(
    layout: &Layout,
    class: &Class,
    channel: usize,
    top: f32,
    sums: &mut [f32],
    shown: &mut [T],
) {
    for start in (0..layout.rows * layout.stride).step_by(RUN) {
        let start = start + channel;
        let add = |offsets: &[usize]| {
            let mut sum = [0.0; RUN];
            for offset in offsets {
                for (sum, part) in sum.iter_mut().zip(&sums[offset + start..][..RUN]) {
                    *sum += part;
                }
            }
            sum
        };
        let (beside, corners) = (add(&class.beside), add(&class.corners));
        let own = &mut sums[class.own + start..][..RUN];
        let shown = &mut shown[class.own + start..][..RUN];
        for i in 0..RUN {
            let desired = own[i] + (2.0 * beside[i] + corners[i]);
            let nearest = (desired + 0.5).floor();
            let nearest = if nearest > 0.0 { nearest } else { 0.0 };
            let nearest = if nearest < top { nearest } else { top };
            own[i] = (desired - nearest) * class.share;
            shown[i] = to_code(nearest);
        }
    }
}

/// What of a tile lies outside the image, where no error may come from.
struct Outside {
    left: isize,
    above: isize,
    width: isize,
    height: isize,
    any: bool,
}

impl Outside {
    fn new(layout: &Layout, (left, above): (isize, isize), width: usize, height: usize) -> Self {
        let (right, below) = (layout.columns * layout.size, layout.rows * layout.size);
        let (width, height) = (width as isize, height as isize);
        let any = left < 0 || above < 0 || left + right as isize > width || above + below as isize > height;
        Self { left, above, width, height, any }
    }

    fn clear(&self, layout: &Layout, place: usize, channel: usize, sums: &mut [f32]) {
        if !self.any {
            return;
        }
        let (x, y) = ((place % layout.size) as isize, (place / layout.size) as isize);
        let size = layout.size as isize;
        // Cells whose pixel at this place lies in the image.
        let count = |start: isize, end: isize, cells: usize| {
            let up = |pixels: isize| ((pixels.max(0) + size - 1) / size) as usize;
            (up(-start).min(cells), up(end - start).min(cells))
        };
        let (first, last) = count(self.left + x, self.width, layout.columns);
        let (first_row, last_row) = count(self.above + y, self.height, layout.rows);
        for row in 0..layout.rows {
            let start = layout.first(place, channel) + row * layout.stride;
            let cells = &mut sums[start..start + layout.columns];
            if row < first_row || row >= last_row {
                cells.fill(0.0);
            } else {
                cells[..first.min(last)].fill(0.0);
                cells[last..].fill(0.0);
            }
        }
    }
}

/// Codes from the planes, without the border.
fn unload<T: Code>(layout: &Layout, shown: &[T], left: usize, width: usize, codes: &mut [T]) {
    let channels = layout.channels;
    let cell = layout.size * channels;
    let tile = (TILE.0 / layout.size * layout.size).min(width - left);
    for (y, codes) in codes.chunks_mut(width * channels).enumerate() {
        let codes = &mut codes[left * channels..(left + tile) * channels];
        let (row, place) = (y / layout.size + layout.border, y % layout.size * layout.size);
        let start = layout.first(place, 0) + row * layout.stride + layout.border;
        for (column, codes) in codes.chunks_mut(cell).enumerate() {
            for (code, from) in codes.iter_mut().zip((start + column..).step_by(layout.plane)) {
                *code = shown[from];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn barons_are_few_and_errors_stay_near() {
        for (matrix, barons) in [(ClassMatrix::knuth(), 2), (ClassMatrix::four(), 2)] {
            let found = (0..matrix.classes.len()).filter(|&place| matrix.parts(place) == 0).count();
            assert_eq!(found, barons);
            assert_eq!(matrix.reach(), 5);
        }
    }

    #[test]
    fn a_matrix_holds_each_class_once() {
        assert!(ClassMatrix::new(2, vec![0, 1, 2, 2]).is_err());
        assert!(ClassMatrix::new(0, vec![]).is_err());
        assert!(ClassMatrix::new(usize::MAX, vec![0]).is_err());
        assert!(ClassMatrix::new(2, vec![3, 1, 0, 2]).is_ok());
    }
}
