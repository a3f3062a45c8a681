//! Summed-area tables (Crow 1984): the mean of an image over any box along its axes from four numbers.

use crate::texture::Wrap;
use glam::Vec2;

/// Sums of an image over all boxes from its upper left corner.
#[derive(Clone, Debug)]
pub(crate) struct SummedArea {
    width: usize,
    height: usize,
    /// (height + 1) rows of width + 1 sums.
    sums: Vec<[f64; 3]>,
    clamps: bool,
}

impl SummedArea {
    /// The table of an image in rows from the top. One that is mirrored beyond its border is held twice along each axis.
    pub fn new((width, height): (usize, usize), texels: &[[f32; 3]], wrap: Wrap) -> Self {
        let copies = if wrap == Wrap::Mirror { 2 } else { 1 };
        let (w, h) = (copies * width, copies * height);
        let folded = |i: usize, n: usize| if i < n { i } else { 2 * n - 1 - i };
        let mut sums = vec![[0.0; 3]; (w + 1) * (h + 1)];
        for y in 0..h {
            let mut of_row = [0.0f64; 3];
            for x in 0..w {
                let texel = texels[folded(y, height) * width + folded(x, width)];
                for (c, sum) in of_row.iter_mut().enumerate() {
                    *sum += f64::from(texel[c]);
                    sums[(y + 1) * (w + 1) + x + 1][c] = sums[y * (w + 1) + x + 1][c] + *sum;
                }
            }
        }
        Self { width: w, height: h, sums, clamps: wrap == Wrap::Clamp }
    }

    /// The mean over a box: `low` and `high` are its corners in texels of the image from its upper left corner, y down.
    pub fn mean(&self, low: Vec2, high: Vec2) -> [f32; 3] {
        let [x0, y0, x1, y1] = [low.x, low.y, high.x, high.y].map(f64::from);
        let corners =
            [self.integral(x1, y1), self.integral(x0, y1), self.integral(x1, y0), self.integral(x0, y0)];
        let area = (x1 - x0) * (y1 - y0);
        std::array::from_fn(|c| {
            ((corners[0][c] - corners[1][c] - corners[2][c] + corners[3][c]) / area) as f32
        })
    }

    /// The integral of the image, continued beyond its borders, from its corner to a point.
    fn integral(&self, x: f64, y: f64) -> [f64; 3] {
        let (w, h) = (self.width as f64, self.height as f64);
        if self.clamps {
            // Beyond the border its texels go on.
            let (xi, yi) = (x.clamp(0.0, w), y.clamp(0.0, h));
            let (dx, dy) = (x - xi, y - yi);
            let column = if dx < 0.0 { 0.0 } else { w - 1.0 };
            let row = if dy < 0.0 { 0.0 } else { h - 1.0 };
            let at = |x: f64, y: f64| self.within(x, y);
            let (inside, c0, c1) = (at(xi, yi), at(column, yi), at(column + 1.0, yi));
            let (r0, r1) = (at(xi, row), at(xi, row + 1.0));
            let corner =
                [at(column, row), at(column + 1.0, row), at(column, row + 1.0), at(column + 1.0, row + 1.0)];
            return std::array::from_fn(|c| {
                let texel = corner[3][c] - corner[2][c] - corner[1][c] + corner[0][c];
                inside[c] + dx * (c1[c] - c0[c]) + dy * (r1[c] - r0[c]) + dx * dy * texel
            });
        }
        let (nx, ny) = ((x / w).floor(), (y / h).floor());
        let (fx, fy) = (x - nx * w, y - ny * h);
        let [all, right, below, rest] =
            [self.within(w, h), self.within(w, fy), self.within(fx, h), self.within(fx, fy)];
        std::array::from_fn(|c| nx * ny * all[c] + nx * right[c] + ny * below[c] + rest[c])
    }

    /// The same inside: linear in both between the corners of texels.
    fn within(&self, x: f64, y: f64) -> [f64; 3] {
        let (column, row) = ((x as usize).min(self.width - 1), (y as usize).min(self.height - 1));
        let (fx, fy) = (x - column as f64, y - row as f64);
        let at = |x: usize, y: usize| &self.sums[y * (self.width + 1) + x];
        let [a, b] = [at(column, row), at(column + 1, row)];
        let [d, e] = [at(column, row + 1), at(column + 1, row + 1)];
        std::array::from_fn(|c| {
            (1.0 - fy) * ((1.0 - fx) * a[c] + fx * b[c]) + fy * ((1.0 - fx) * d[c] + fx * e[c])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::wrapped;

    /// The mean over a box by many points.
    fn by_points(
        size: (usize, usize),
        texels: &[[f32; 3]],
        index: impl Fn(i64, usize) -> usize,
        low: Vec2,
        high: Vec2,
    ) -> f32 {
        let n = 400;
        let mut sum = 0.0f64;
        for i in 0..n * n {
            let t = Vec2::new((i % n) as f32 + 0.5, (i / n) as f32 + 0.5) / n as f32;
            let p = low + (high - low) * t;
            let (x, y) = (index(p.x.floor() as i64, size.0), index(p.y.floor() as i64, size.1));
            sum += f64::from(texels[y * size.0 + x][0]);
        }
        (sum / f64::from(n * n)) as f32
    }

    #[test]
    fn means_are_those_of_points_however_the_image_goes_on() {
        let size = (5, 3);
        let texels: Vec<[f32; 3]> = (0..15).map(|i| [((i * 7) % 11) as f32; 3]).collect();
        let boxes = [
            ([1.2, 0.4], [3.9, 2.2]),
            ([-4.1, -2.0], [1.3, 0.7]),
            ([3.0, 1.0], [17.5, 8.5]),
            ([-30.0, -20.0], [40.0, 35.0]),
        ];
        for (low, high) in boxes {
            let (low, high) = (Vec2::from(low), Vec2::from(high));
            for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
                let index = |i: i64, n: usize| wrapped(i as f32, n, wrap);
                let found = SummedArea::new(size, &texels, wrap).mean(low, high)[0];
                let expected = by_points(size, &texels, index, low, high);
                assert!((found - expected).abs() < 0.05, "{wrap:?} {low} {high}: {found} {expected}");
            }
        }
    }
}
