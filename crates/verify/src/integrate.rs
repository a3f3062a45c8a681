//! Integrals over directions by adaptive quadrature.
//!
//! ∫ f(ω) dω = ∫∫ f(θ, φ) sin θ dθ dφ over cells of polar angle θ and azimuth φ, each by the product of two
//! Gauss-Legendre rules of five points (Abramowitz and Stegun 1964, table 25.4). A cell whose quarters disagree
//! with it is split, so a narrow highlight, a kink at the critical angle and the steep end near grazing get the
//! points that they need. The polar angle rather than its cosine is the variable, because smooth functions of
//! direction are smooth in it up to the pole, and because the rows then crowd at grazing, where microfacet
//! models are steep. The horizon is a border of cells: functions may jump there.
//!
//! Valid for functions without discrete lobes whose features are at least about as wide as half a cell of the
//! coarse grid (what falls between all coarse points is never seen, which a finer grid mends). A function in
//! f32 cannot be integrated to a relative error below about 10⁻⁶; its noise ends the splitting at
//! [`Quadrature::tolerance`] of each cell.
//!
//! ```
//! use illuminant_verify::integrate::Quadrature;
//! use std::f64::consts::PI;
//! // ∫ cos θ dω = π over the hemisphere.
//! let cosine = Quadrature::default().above(&|d| [d[2]]);
//! assert!((cosine[0] - PI).abs() < 1e-9);
//! ```

use std::f64::consts::{PI, TAU};

/// Abscissae of the Gauss-Legendre rule of five points on [−1, 1].
const NODES: [f64; 5] =
    [-0.906_179_845_938_664, -0.538_469_310_105_683, 0.0, 0.538_469_310_105_683, 0.906_179_845_938_664];
/// Its weights.
const WEIGHTS: [f64; 5] = [
    0.236_926_885_056_189,
    0.478_628_670_499_366,
    0.568_888_888_888_889,
    0.478_628_670_499_366,
    0.236_926_885_056_189,
];

/// A patch of the sphere between two polar angles and two azimuths, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// From the normal (0) to its opposite (π).
    pub theta: [f64; 2],
    /// From the x axis towards y, 0 to 2π.
    pub phi: [f64; 2],
}

impl Cell {
    /// The whole sphere.
    pub const SPHERE: Self = Self { theta: [0.0, PI], phi: [0.0, TAU] };

    /// The polar angle and azimuth of a direction.
    ///
    /// ```
    /// # use illuminant_verify::integrate::Cell;
    /// assert_eq!(Cell::angles([0.0, 1.0, 0.0]), [90f64.to_radians(); 2]);
    /// ```
    #[must_use]
    pub fn angles(d: [f64; 3]) -> [f64; 2] {
        // atan2 keeps the digits that acos of z loses near the pole.
        let phi = d[1].atan2(d[0]);
        [d[0].hypot(d[1]).atan2(d[2]), if phi < 0.0 { phi + TAU } else { phi }]
    }

    /// The direction with these angles.
    #[must_use]
    pub fn direction([theta, phi]: [f64; 2]) -> [f64; 3] {
        let ((sin, cos), (sin_phi, cos_phi)) = (theta.sin_cos(), phi.sin_cos());
        [sin * cos_phi, sin * sin_phi, cos]
    }

    /// Parts of equal angle: `rows` in θ, each of `columns` in φ.
    #[must_use]
    pub fn divided(&self, rows: usize, columns: usize) -> Vec<Self> {
        let part = |[a, b]: [f64; 2], i: usize, n: usize| {
            let at = |i: usize| if i == n { b } else { a + (b - a) * i as f64 / n as f64 };
            [at(i), at(i + 1)]
        };
        (0..rows * columns)
            .map(|i| Self {
                theta: part(self.theta, i / columns, rows),
                phi: part(self.phi, i % columns, columns),
            })
            .collect()
    }

    /// Its four quarters: both columns of the upper row, then of the lower.
    #[must_use]
    pub fn quarters(&self) -> [Self; 4] {
        let middle = self.middle();
        std::array::from_fn(|i| Self {
            theta: if i < 2 { [self.theta[0], middle[0]] } else { [middle[0], self.theta[1]] },
            phi: if i % 2 == 0 { [self.phi[0], middle[1]] } else { [middle[1], self.phi[1]] },
        })
    }

    /// The angles of its middle, where its quarters meet.
    #[must_use]
    pub fn middle(&self) -> [f64; 2] {
        [0.5 * (self.theta[0] + self.theta[1]), 0.5 * (self.phi[0] + self.phi[1])]
    }

    /// One application of the product rule.
    fn gauss<const K: usize>(&self, f: &impl Fn([f64; 3]) -> [f64; K]) -> [f64; K] {
        let half = [0.5 * (self.theta[1] - self.theta[0]), 0.5 * (self.phi[1] - self.phi[0])];
        let middle = self.middle();
        let mut sum = [0.0; K];
        for (x, wx) in NODES.iter().zip(WEIGHTS) {
            let theta = middle[0] + half[0] * x;
            let ring = wx * theta.sin() * half[0] * half[1];
            for (y, wy) in NODES.iter().zip(WEIGHTS) {
                let values = f(Self::direction([theta, middle[1] + half[1] * y]));
                for (sum, value) in sum.iter_mut().zip(values) {
                    *sum += ring * wy * value;
                }
            }
        }
        sum
    }
}

/// How finely to integrate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadrature {
    /// Coarse cells from pole to pole; even, so that the horizon is a border.
    pub rows: usize,
    /// Coarse cells around.
    pub columns: usize,
    /// The error aimed at, as a fraction of the integral; each cell stops at its share of it, or at a tenth of it
    /// relative to the cell.
    pub tolerance: f64,
    /// How often a coarse cell may be split.
    pub depth: u32,
}

impl Default for Quadrature {
    /// 32 × 32 coarse cells, 10⁻⁴, eight splits.
    fn default() -> Self {
        Self { rows: 32, columns: 32, tolerance: 1e-4, depth: 8 }
    }
}

impl Quadrature {
    /// The integral over one cell, as a part of a whole that is about `scale`.
    #[must_use]
    pub fn cell<const K: usize>(
        &self,
        f: &impl Fn([f64; 3]) -> [f64; K],
        cell: &Cell,
        scale: f64,
    ) -> [f64; K] {
        let share = self.tolerance * scale / (self.rows * self.columns) as f64;
        self.refined(f, cell, cell.gauss(f), share, self.depth)
    }

    /// The integral over a cell in which the function is zero nearly everywhere: divided 16 × 16 first, so that
    /// a corner that the coarse points miss is found.
    #[must_use]
    pub fn searched<const K: usize>(&self, f: &impl Fn([f64; 3]) -> [f64; K], cell: &Cell) -> [f64; K] {
        let mut sum = [0.0; K];
        for part in cell.divided(16, 16) {
            add(&mut sum, part.gauss(f));
        }
        sum
    }

    /// The integral over the whole sphere.
    ///
    /// ```
    /// # use illuminant_verify::integrate::Quadrature;
    /// let [one, z2] = Quadrature::default().sphere(&|d| [1.0, d[2] * d[2]]);
    /// assert!((z2 / one - 1.0 / 3.0).abs() < 1e-9);
    /// ```
    #[must_use]
    pub fn sphere<const K: usize>(&self, f: &impl Fn([f64; 3]) -> [f64; K]) -> [f64; K] {
        self.sum(f, &Cell::SPHERE, self.rows)
    }

    /// The integral over the hemisphere around the normal, z > 0.
    #[must_use]
    pub fn above<const K: usize>(&self, f: &impl Fn([f64; 3]) -> [f64; K]) -> [f64; K] {
        self.sum(f, &Cell { theta: [0.0, 0.5 * PI], ..Cell::SPHERE }, self.rows / 2)
    }

    /// The integral over the other hemisphere, z < 0.
    #[must_use]
    pub fn below<const K: usize>(&self, f: &impl Fn([f64; 3]) -> [f64; K]) -> [f64; K] {
        self.sum(f, &Cell { theta: [0.5 * PI, PI], ..Cell::SPHERE }, self.rows / 2)
    }

    fn sum<const K: usize>(&self, f: &impl Fn([f64; 3]) -> [f64; K], whole: &Cell, rows: usize) -> [f64; K] {
        let cells = whole.divided(rows.max(1), self.columns.max(1));
        let coarse: Vec<[f64; K]> = cells.iter().map(|cell| cell.gauss(f)).collect();
        let mut scale = [0.0; K];
        for values in &coarse {
            for (scale, value) in scale.iter_mut().zip(values) {
                *scale += value.abs();
            }
        }
        let scale = scale.into_iter().fold(0.0, f64::max);
        let share = self.tolerance * scale / cells.len() as f64;
        let mut sum = [0.0; K];
        for (cell, coarse) in cells.iter().zip(coarse) {
            add(&mut sum, self.refined(f, cell, coarse, share, self.depth));
        }
        sum
    }

    fn refined<const K: usize>(
        &self,
        f: &impl Fn([f64; 3]) -> [f64; K],
        cell: &Cell,
        coarse: [f64; K],
        share: f64,
        depth: u32,
    ) -> [f64; K] {
        let quarters = cell.quarters();
        let parts = quarters.map(|quarter| quarter.gauss(f));
        let mut fine = [0.0; K];
        for part in parts {
            add(&mut fine, part);
        }
        let agree = coarse
            .iter()
            .zip(&fine)
            .all(|(coarse, fine)| (coarse - fine).abs() <= share + 0.1 * self.tolerance * fine.abs());
        // A value that is no number stays one however often it is split.
        if agree || depth == 0 || fine.iter().any(|v| !v.is_finite()) {
            return fine;
        }
        let mut sum = [0.0; K];
        for (quarter, part) in quarters.iter().zip(parts) {
            add(&mut sum, self.refined(f, quarter, part, 0.5 * share, depth - 1));
        }
        sum
    }
}

fn add<const K: usize>(sum: &mut [f64; K], values: [f64; K]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += value;
    }
}

/// The directions of the book's hemispherical integrator (III.2) with the solid angle of each: `increments` steps of elevation and four
/// times as many of azimuth, taken at their middles.
///
/// ∫ f cos θ dω is then the sum of f cos θ times the solid angles, to first order; [`Quadrature`] is the better way.
///
/// ```
/// use illuminant_verify::integrate::book_hemisphere;
/// let mut sum = 0.0;
/// book_hemisphere(32, |direction, solid_angle| sum += direction[2] * solid_angle);
/// assert!((sum - 3.142539).abs() < 1e-6); // the book's value
/// ```
pub fn book_hemisphere(increments: usize, mut visit: impl FnMut([f64; 3], f64)) {
    let step = PI / (2.0 * increments as f64);
    for i in 0..increments {
        let low = i as f64 * step;
        let solid_angle = step * (low.cos() - (low + step).cos());
        let (sin, cos) = (low + 0.5 * step).sin_cos();
        for j in 0..4 * increments {
            let (y, x) = ((j as f64 + 0.5) * step).sin_cos();
            visit([sin * y, sin * x, cos], solid_angle);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_the_cosine() {
        // ∫ cosⁿ θ dω = 2π / (n + 1).
        for n in [0, 1, 7, 200, 2000] {
            let [value] = Quadrature::default().above(&|d| [d[2].powi(n)]);
            let exact = TAU / f64::from(n + 1);
            assert!((value / exact - 1.0).abs() < 2e-4, "{n}: {value} {exact}");
        }
    }

    #[test]
    fn a_cap_off_the_axis_with_a_sharp_rim() {
        let axis = Cell::direction([1.1, 2.0]);
        let cos_rim = 0.2f64.cos();
        let inside = |d: [f64; 3]| axis.iter().zip(d).map(|(a, b)| a * b).sum::<f64>() > cos_rim;
        let [value] = Quadrature::default().sphere(&|d| [f64::from(u8::from(inside(d)))]);
        let exact = TAU * (1.0 - cos_rim);
        assert!((value / exact - 1.0).abs() < 3e-3, "{value} {exact}");
    }

    #[test]
    fn hemispheres_add_up_and_angles_come_back() {
        let f = |d: [f64; 3]| [(d[0] + 2.0 * d[1] - d[2]).exp()];
        let q = Quadrature::default();
        assert!((q.above(&f)[0] + q.below(&f)[0] - q.sphere(&f)[0]).abs() < 1e-9);
        for angles in [[0.3, 0.1], [3.0, 6.2], [1.5, 3.2]] {
            let back = Cell::angles(Cell::direction(angles));
            assert!(back.iter().zip(angles).all(|(a, b)| (a - b).abs() < 1e-12), "{angles:?} {back:?}");
        }
    }

    #[test]
    fn no_number_ends_the_splitting() {
        assert!(Quadrature::default().above(&|_| [f64::NAN])[0].is_nan());
    }
}
