//! Edge and span tables with incremental updates (book 4.2.4, figure 4.8).
//!
//! A polygon is entered at its first scanline. Along its left and right edges x and all values grow by a constant from one scanline to the
//! next, along the span between them from one pixel to the next.

/// A corner of a convex polygon: its place, and the values that are interpolated.
#[derive(Clone, Copy, Debug)]
pub struct Corner<'a> {
    /// Pixels from the left; the centre of the first pixel is ½.
    pub x: f64,
    /// Pixels from the top.
    pub y: f64,
    /// The values.
    pub values: &'a [f32],
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
    /// Where its values at the first pixel lie in [`EdgeTable::values`]; their growth from pixel to pixel follows them.
    pub values: usize,
}

/// An edge that a scanline crosses.
#[derive(Clone, Copy, Debug, Default)]
struct Edge {
    x: f64,
    dx: f64,
    /// The last scanline that it crosses.
    last: i32,
    /// The corner at which it ends.
    to: usize,
}

/// A polygon that the scanline crosses.
#[derive(Clone, Debug)]
struct Active {
    polygon: u32,
    /// One beyond its last scanline.
    end: i32,
    corners: Vec<(f64, f64)>,
    /// The values of all corners, then those of both edges, then their growths.
    values: Vec<f32>,
    edges: [Edge; 2],
}

/// The polygons that a scanline crosses.
#[derive(Clone, Debug, Default)]
pub struct EdgeTable {
    active: Vec<Active>,
    spare: Vec<Active>,
    /// Values of the spans of the current scanline.
    pub values: Vec<f32>,
    /// The spans of the current scanline.
    pub spans: Vec<Span>,
}

/// The first sample at or beyond a coordinate.
fn sample(coordinate: f64) -> i32 {
    coordinate.ceil().clamp(-1e9, 1e9) as i32
}

impl Active {
    /// The number of values.
    fn width(&self) -> usize {
        self.values.len() / (self.corners.len() + 4)
    }

    /// Walks an edge from its corner on until one crosses the scanline.
    fn advance(&mut self, side: usize, y: i32) {
        let (count, width) = (self.corners.len(), self.width());
        let step = if side == 0 { count - 1 } else { 1 };
        for _ in 0..count {
            let from = self.edges[side].to;
            let to = (from + step) % count;
            let ((x0, y0), (x1, y1)) = (self.corners[from], self.corners[to]);
            self.edges[side].to = to;
            self.edges[side].last = sample(y1) - 1;
            if y1 > y0 && self.edges[side].last >= y {
                let inverse = 1.0 / (y1 - y0);
                let (dx, t) = ((x1 - x0) * inverse, f64::from(y) - y0);
                self.edges[side].x = x0 + dx * t;
                self.edges[side].dx = dx;
                for v in 0..width {
                    let (a, b) = (self.values[from * width + v], self.values[to * width + v]);
                    let growth = (b - a) * inverse as f32;
                    self.values[(count + side) * width + v] = a + growth * t as f32;
                    self.values[(count + 2 + side) * width + v] = growth;
                }
                return;
            }
        }
    }
}

impl EdgeTable {
    /// Enters a convex polygon of which `y` is the first scanline to be drawn.
    pub fn enter<'a>(
        &mut self,
        polygon: u32,
        y: i32,
        corners: impl Iterator<Item = Corner<'a>>,
        offset: [f64; 2],
    ) {
        let mut active = self.spare.pop().unwrap_or_else(|| Active {
            polygon,
            end: 0,
            corners: Vec::new(),
            values: Vec::new(),
            edges: [Edge::default(); 2],
        });
        active.polygon = polygon;
        active.corners.clear();
        active.values.clear();
        let mut width = 0;
        for corner in corners {
            active.corners.push((corner.x - offset[0], corner.y - offset[1]));
            active.values.extend_from_slice(corner.values);
            width = corner.values.len();
        }
        let count = active.corners.len();
        active.values.resize((count + 4) * width, 0.0);
        let row = |i: &usize| active.corners[*i].1;
        let Some(top) = (0..count).min_by(|a, b| row(a).total_cmp(&row(b))) else { return };
        active.end = sample((0..count).map(|i| row(&i)).fold(f64::MIN, f64::max));
        active.edges = [Edge { to: top, last: i32::MIN, ..Edge::default() }; 2];
        for side in 0..2 {
            active.advance(side, y);
        }
        if y < active.end {
            self.active.push(active);
        } else {
            self.spare.push(active);
        }
    }

    /// The first scanline of a polygon whose highest corner has this y, with the offset of samples.
    #[must_use]
    pub fn first_row(top: f64, offset: f64) -> i32 {
        sample(top - offset)
    }

    /// Finds the spans of scanline `y` between two columns, and moves all edges on to the next one.
    pub fn scan(&mut self, y: i32, columns: [i32; 2]) {
        self.values.clear();
        self.spans.clear();
        let mut i = 0;
        while i < self.active.len() {
            let active = &mut self.active[i];
            let width = active.width();
            let count = active.corners.len();
            for side in 0..2 {
                if active.edges[side].last < y {
                    active.advance(side, y);
                }
            }
            let swapped = usize::from(active.edges[0].x > active.edges[1].x);
            let [left, right] = [active.edges[swapped], active.edges[1 - swapped]];
            let (start, end) = (sample(left.x).max(columns[0]), sample(right.x).min(columns[1]));
            if start < end {
                let inverse = (1.0 / (right.x - left.x)) as f32;
                let skipped = (f64::from(start) - left.x) as f32;
                let first = self.values.len();
                self.values.resize(first + 2 * width, 0.0);
                let (values, growths) = self.values[first..].split_at_mut(width);
                let (l, r) = ((count + swapped) * width, (count + 1 - swapped) * width);
                for v in 0..width {
                    let (a, b) = (active.values[l + v], active.values[r + v]);
                    growths[v] = (b - a) * inverse;
                    values[v] = a + growths[v] * skipped;
                }
                self.spans.push(Span { polygon: active.polygon, start, end, values: first });
            }
            for side in 0..2 {
                active.edges[side].x += active.edges[side].dx;
                let (value, growth) = ((count + side) * width, (count + 2 + side) * width);
                for v in 0..width {
                    active.values[value + v] += active.values[growth + v];
                }
            }
            if y + 1 >= active.end {
                let done = self.active.swap_remove(i);
                self.spare.push(done);
            } else {
                i += 1;
            }
        }
        // The order in which polygons end must not decide between two at one depth.
        self.spans.sort_unstable_by_key(|span| span.polygon);
    }

    /// Forgets all polygons.
    pub fn clear(&mut self) {
        self.spare.append(&mut self.active);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values at every pixel of a polygon.
    fn fill(corners: &[([f64; 2], f32)], size: i32) -> Vec<Option<f32>> {
        let mut table = EdgeTable::default();
        let mut image = vec![None; (size * size) as usize];
        let top = corners.iter().map(|c| c.0[1]).fold(f64::MAX, f64::min);
        let first = EdgeTable::first_row(top, 0.5).max(0);
        for y in 0..size {
            if y == first {
                let corners =
                    corners.iter().map(|(p, v)| Corner { x: p[0], y: p[1], values: std::slice::from_ref(v) });
                table.enter(0, y, corners, [0.5, 0.5]);
            }
            table.scan(y, [0, size]);
            for span in &table.spans {
                let (mut value, growth) = (table.values[span.values], table.values[span.values + 1]);
                for x in span.start..span.end {
                    assert!(image[(y * size + x) as usize].replace(value).is_none());
                    value += growth;
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
