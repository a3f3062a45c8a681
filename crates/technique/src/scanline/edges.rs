//! Edge and span tables with incremental updates (book 4.2.4, figure 4.8).
//!
//! A polygon is entered at its first scanline. Along its left and right edges x and all values grow by a constant from one scanline to the
//! next, along the span between them from one pixel to the next. Values travel in fours, one register each.

use glam::Vec4;

/// Four values that are interpolated together.
pub type Quad = [f32; 4];

/// The most corners that a polygon may have: a triangle cut by one plane.
pub const MOST_CORNERS: usize = 4;

/// a + b t.
#[inline(always)]
#[must_use]
pub fn grown(a: Quad, b: Quad, t: f32) -> Quad {
    (Vec4::from(a) + Vec4::from(b) * t).to_array()
}

/// A corner of a convex polygon: its place, and the values that are interpolated.
#[derive(Clone, Copy, Debug)]
pub struct Corner<'a> {
    /// Pixels from the left; the centre of the first pixel is ½.
    pub x: f64,
    /// Pixels from the top.
    pub y: f64,
    /// The values, as many as the table has.
    pub values: &'a [Quad],
}

/// The pixels of a polygon in one scanline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Whatever names the polygon.
    pub polygon: u32,
    /// The first pixel.
    pub start: i32,
    /// One beyond the last.
    pub end: i32,
}

/// An edge that a scanline crosses.
#[derive(Clone, Copy, Debug, Default)]
struct Edge {
    x: f64,
    dx: f64,
    /// The last scanline that it crosses.
    last: i32,
    /// The corner at which it ends.
    to: u32,
}

/// A polygon that the scanline crosses.
#[derive(Clone, Copy, Debug)]
struct Active {
    polygon: u32,
    /// One beyond its last scanline.
    end: i32,
    count: u32,
    edges: [Edge; 2],
    corners: [[f64; 2]; MOST_CORNERS],
}

/// The polygons that a scanline crosses.
#[derive(Clone, Debug)]
pub struct EdgeTable {
    /// How many fours of values each corner has.
    quads: usize,
    active: Vec<Active>,
    /// For each active polygon the values of both edges, their growths, and the values of its corners.
    held: Vec<Quad>,
    /// For each span its values at the first pixel, then their growths from pixel to pixel.
    values: Vec<Quad>,
    /// The spans of the current scanline, in no order.
    pub spans: Vec<Span>,
}

/// Where the growths of edges begin in what an active polygon holds, and where its corners, in units of a corner.
const GROWTHS: usize = 2;
const CORNERS: usize = 4;

/// The first sample at or beyond a coordinate.
#[inline(always)]
fn sample(coordinate: f64) -> i32 {
    coordinate.ceil().clamp(-1e9, 1e9) as i32
}

impl Active {
    /// Walks an edge from its corner on until one crosses the scanline.
    fn advance(&mut self, held: &mut [Quad], quads: usize, side: usize, y: i32) {
        let count = self.count as usize;
        let step = if side == 0 { count - 1 } else { 1 };
        let edge = &mut self.edges[side];
        for _ in 0..count {
            let from = edge.to as usize;
            let to = (from + step) % count;
            let ([x0, y0], [x1, y1]) = (self.corners[from], self.corners[to]);
            edge.to = to as u32;
            edge.last = sample(y1) - 1;
            if y1 > y0 && edge.last >= y {
                let inverse = 1.0 / (y1 - y0);
                let t = f64::from(y) - y0;
                edge.dx = (x1 - x0) * inverse;
                edge.x = x0 + edge.dx * t;
                for v in 0..quads {
                    let a = held[(CORNERS + from) * quads + v];
                    let b = held[(CORNERS + to) * quads + v];
                    let growth = ((Vec4::from(b) - Vec4::from(a)) * inverse as f32).to_array();
                    held[side * quads + v] = grown(a, growth, t as f32);
                    held[(GROWTHS + side) * quads + v] = growth;
                }
                return;
            }
        }
    }
}

impl EdgeTable {
    /// An empty table for corners with so many fours of values.
    #[must_use]
    pub fn new(quads: usize) -> Self {
        Self { quads, active: Vec::new(), held: Vec::new(), values: Vec::new(), spans: Vec::new() }
    }

    /// How much a polygon holds, in fours of values.
    fn block(quads: usize) -> usize {
        (CORNERS + MOST_CORNERS) * quads
    }

    /// Enters a convex polygon of at most [`MOST_CORNERS`] of which `y` is the first scanline to be drawn.
    pub fn enter<'a>(
        &mut self,
        polygon: u32,
        y: i32,
        corners: impl Iterator<Item = Corner<'a>>,
        offset: [f64; 2],
    ) {
        let quads = self.quads;
        let first = self.held.len();
        let mut active = Active {
            polygon,
            end: 0,
            count: 0,
            edges: [Edge::default(); 2],
            corners: [[0.0; 2]; MOST_CORNERS],
        };
        let (mut top, mut lowest) = (0, f64::MIN);
        self.held.resize(first + Self::block(quads), [0.0; 4]);
        let held = &mut self.held[first..];
        for (i, corner) in corners.enumerate() {
            let place = [corner.x - offset[0], corner.y - offset[1]];
            active.corners[i] = place;
            active.count += 1;
            held[(CORNERS + i) * quads..][..quads].copy_from_slice(corner.values);
            lowest = lowest.max(place[1]);
            if place[1] < active.corners[top][1] {
                top = i;
            }
        }
        active.end = sample(lowest);
        if y >= active.end {
            self.held.truncate(first);
            return;
        }
        active.edges = [Edge { to: top as u32, last: i32::MIN, ..Edge::default() }; 2];
        for side in 0..2 {
            active.advance(held, quads, side, y);
        }
        self.active.push(active);
    }

    /// The first scanline of a polygon whose highest corner has this y, with the offset of samples.
    #[must_use]
    pub fn first_row(top: f64, offset: f64) -> i32 {
        sample(top - offset)
    }

    /// Finds the spans of scanline `y` between two columns, and moves all edges on to the next one.
    pub fn scan(&mut self, y: i32, columns: [i32; 2]) {
        // The usual widths by themselves, so that their loops are unrolled.
        match self.quads {
            1 => self.scan_wide(y, columns, 1),
            2 => self.scan_wide(y, columns, 2),
            quads => self.scan_wide(y, columns, quads),
        }
    }

    #[inline(always)]
    fn scan_wide(&mut self, y: i32, columns: [i32; 2], quads: usize) {
        self.values.clear();
        self.spans.clear();
        let block = Self::block(quads);
        let mut i = 0;
        while i < self.active.len() {
            let active = &mut self.active[i];
            let held = &mut self.held[i * block..][..block];
            for side in 0..2 {
                if active.edges[side].last < y {
                    active.advance(held, quads, side, y);
                }
            }
            let swapped = usize::from(active.edges[0].x > active.edges[1].x);
            let (left, right) = (active.edges[swapped].x, active.edges[1 - swapped].x);
            let (start, end) = (sample(left).max(columns[0]), sample(right).min(columns[1]));
            if start < end {
                let inverse = ((right - left) as f32).recip();
                let skipped = (f64::from(start) - left) as f32;
                let first = self.values.len();
                self.values.resize(first + 2 * quads, [0.0; 4]);
                let (values, growths) = self.values[first..].split_at_mut(quads);
                for v in 0..quads {
                    let a = held[swapped * quads + v];
                    let b = held[(1 - swapped) * quads + v];
                    growths[v] = ((Vec4::from(b) - Vec4::from(a)) * inverse).to_array();
                    values[v] = grown(a, growths[v], skipped);
                }
                self.spans.push(Span { polygon: active.polygon, start, end });
            }
            if y + 1 >= active.end {
                self.active.swap_remove(i);
                let last = self.active.len() * block;
                self.held.copy_within(last..last + block, i * block);
                self.held.truncate(last);
                continue;
            }
            for side in 0..2 {
                active.edges[side].x += active.edges[side].dx;
            }
            let (values, growths) = held[..CORNERS * quads].split_at_mut(GROWTHS * quads);
            for (value, growth) in values.iter_mut().zip(growths) {
                *value = grown(*value, *growth, 1.0);
            }
            i += 1;
        }
    }

    /// The values of a span, by its number, at its first pixel, and their growths from pixel to pixel.
    #[inline(always)]
    #[must_use]
    pub fn of_span(&self, number: usize) -> (&[Quad], &[Quad]) {
        self.values[2 * self.quads * number..][..2 * self.quads].split_at(self.quads)
    }

    /// Forgets all polygons.
    pub fn clear(&mut self) {
        self.active.clear();
        self.held.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values at every pixel of a polygon.
    fn fill(corners: &[([f64; 2], f32)], size: i32) -> Vec<Option<f32>> {
        let mut table = EdgeTable::new(1);
        let mut image = vec![None; (size * size) as usize];
        let top = corners.iter().map(|c| c.0[1]).fold(f64::MAX, f64::min);
        let first = EdgeTable::first_row(top, 0.5).max(0);
        for y in 0..size {
            if y == first {
                let quads: Vec<Quad> = corners.iter().map(|(_, v)| [*v; 4]).collect();
                let places = corners.iter().zip(&quads);
                let places =
                    places.map(|((p, _), v)| Corner { x: p[0], y: p[1], values: std::slice::from_ref(v) });
                table.enter(0, y, places, [0.5, 0.5]);
            }
            table.scan(y, [0, size]);
            for (number, span) in table.spans.iter().enumerate() {
                let (start, growth) = table.of_span(number);
                for x in span.start..span.end {
                    let [value, _, _, same] = grown(start[0], growth[0], (x - span.start) as f32);
                    assert_eq!(value, same);
                    assert!(image[(y * size + x) as usize].replace(value).is_none());
                }
            }
        }
        image
    }

    #[test]
    fn increments_give_the_bilinear_value_at_each_pixel() {
        // A linear function over a triangle is the same however it is interpolated.
        let f = |x: f64, y: f64| (0.3 * x - 0.7 * y + 5.0) as f32;
        let corners = [[3.2, 1.7], [28.4, 9.1], [10.9, 29.6]].map(|[x, y]| ([x, y], f(x, y)));
        let image = fill(&corners, 32);
        let mut count = 0;
        for (i, value) in image.iter().enumerate() {
            let (x, y) = ((i % 32) as f64 + 0.5, (i / 32) as f64 + 0.5);
            if let Some(value) = value {
                count += 1;
                assert!((value - f(x, y)).abs() < 1e-4, "{x} {y}: {value}");
            }
        }
        // The area of the triangle, to the pixels of its outline.
        let area = 0.5 * ((25.2f64 * 27.9) - (7.7 * 7.4));
        assert!((f64::from(count) - area).abs() < 12.0, "{count} {area}");
    }

    #[test]
    fn neighbours_share_every_pixel_out() {
        let [a, b, c, d] = [[1.3, 2.1], [30.2, 4.4], [27.7, 30.9], [2.2, 26.5]];
        let whole = fill(&[(a, 0.0), (b, 0.0), (c, 0.0), (d, 0.0)], 32);
        let halves = [fill(&[(a, 0.0), (b, 0.0), (c, 0.0)], 32), fill(&[(c, 0.0), (d, 0.0), (a, 0.0)], 32)];
        for (i, pixel) in whole.iter().enumerate() {
            let shares = halves.iter().filter(|half| half[i].is_some()).count();
            assert_eq!(shares, usize::from(pixel.is_some()), "pixel {i}");
        }
    }

    #[test]
    fn a_square_turned_is_shaded_otherwise_but_a_triangle_is_not() {
        // Book figure 4.10 (Duff 1979): values from edge to edge along scanlines depend on how the polygon lies.
        let turned = |points: &[[f64; 2]], values: &[f32], angle: f64| -> f32 {
            let (s, c) = angle.to_radians().sin_cos();
            let turn = |[x, y]: [f64; 2]| {
                [16.0 + c * (x - 16.0) - s * (y - 16.0), 16.0 + s * (x - 16.0) + c * (y - 16.0)]
            };
            let corners: Vec<_> = points.iter().zip(values).map(|(p, v)| (turn(*p), *v)).collect();
            let [x, y] = turn([12.0, 16.0]);
            fill(&corners, 32)[(y as i32 * 32 + x as i32) as usize].unwrap()
        };
        let square = [[4.0, 4.0], [28.0, 4.0], [28.0, 28.0], [4.0, 28.0]];
        let bright = [1.0, 0.0, 0.0, 0.0];
        let difference = (turned(&square, &bright, 0.1) - turned(&square, &bright, 45.0)).abs();
        assert!(difference > 0.1, "{difference}");
        let triangle = [[4.0, 4.0], [28.0, 10.0], [6.0, 28.0]];
        let values = [1.0, 0.0, 0.5];
        let still = (turned(&triangle, &values, 0.0) - turned(&triangle, &values, 45.0)).abs();
        // One pixel to either side lies between the two places.
        assert!(still < 0.06, "{still}");
    }
}
