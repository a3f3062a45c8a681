//! The normal equations of a fit: how well weights on a few wavelengths reproduce the colours of products.

use crate::nonnegative::least_squares;
use crate::{Part, Products, ToXyz, xyz_by};
use illuminant_color::{Triple, delta_e_2000_metric};
use nalgebra::{Cholesky, DMatrix, DVector, Matrix3, Vector3};
use rayon::prelude::*;

/// How strongly the colour of a bare lamp is held, beside all products together: it comes out exact.
const HOLD_WHITE: f64 = 1e6;

/// Products darker than this fraction of the white are lit no further when they are lit to half of it.
const DARKEST: f64 = 1e-4;

/// A symmetric 3 × 3 matrix: xx, xy, xz, yy, yz, zz.
type Symmetric = [f64; 6];

/// Where in a [`Symmetric`] the element (a, b) stands.
const AT: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];

/// What a fit knows of the lamps that share a map: one row for each product that their light makes, and for each lamp one
/// row that holds its white.
pub(crate) struct Side {
    /// Numbers of the lamps: all of one relative spectrum, or all that there are.
    pub lamps: Vec<usize>,
    /// For each nm, the light that weights meet there in each row: what is left of a unit of luminance, or of the lamp.
    features: Vec<Vec<f64>>,
    /// XYZ of each row, integrated at 1 nm.
    targets: Vec<Triple>,
    /// The metric of colour difference of each row.
    metrics: Vec<Symmetric>,
    /// The product that each row belongs to; none for a white.
    pub items: Vec<Option<usize>>,
}

/// The metric in which a product is fitted: as it is exposed, and as if it were lit to half the white, so that dark
/// products count too.
fn metric(xyz: Triple, white: Triple) -> Symmetric {
    let exposed = delta_e_2000_metric(xyz, white);
    let scale = 0.5 * white[1] / xyz[1].max(DARKEST * white[1]);
    let lit = delta_e_2000_metric(xyz.map(|v| v * scale), white);
    let mut sum = [0.0; 6];
    for a in 0..3 {
        for b in a..3 {
            sum[AT[a][b]] = exposed[a][b] + scale * scale * lit[a][b];
        }
    }
    sum
}

/// δᵀ G δ.
pub(crate) fn quadratic(g: &Symmetric, d: Triple) -> f64 {
    (0..3).map(|a| (0..3).map(|b| d[a] * g[AT[a][b]] * d[b]).sum::<f64>()).sum()
}

impl Side {
    /// The sides of all products: lamps of one relative spectrum share one, or all do.
    pub fn all(products: &Products) -> Vec<Self> {
        let luminance: Vec<f64> = (0..products.lamps.len()).map(|l| products.xyz_of_lamp(l)[1]).collect();
        let tables: Vec<Vec<f64>> = products.lamps.iter().map(|lamp| lamp.tabulate(products.range)).collect();
        let mut sides: Vec<Self> = Vec::new();
        let mut side_of = vec![None; products.lamps.len()];
        for lamp in 0..products.lamps.len() {
            let Some(kind) = products.kind(lamp) else { continue };
            // The lamps that share one map are the first, so theirs is the first side.
            let found =
                if products.shares_map(lamp) { (!sides.is_empty()).then_some(0) } else { side_of[kind] };
            let side = found.unwrap_or_else(|| {
                sides.push(Self::empty(products.range.len()));
                sides.len() - 1
            });
            sides[side].lamps.push(lamp);
            side_of[lamp] = Some(side);
        }
        // Where lamps share a map their own spectra are part of what it meets; else the map contains the spectrum.
        let feature = |lamp: usize, filter: &[f64]| -> Vec<f64> {
            if products.shares_map(lamp) {
                tables[lamp].iter().zip(filter).map(|(l, f)| l * f).collect()
            } else {
                filter.iter().map(|f| luminance[lamp] * f).collect()
            }
        };
        for lamp in products.representatives() {
            if let Some(side) = side_of[lamp] {
                let xyz = products.xyz_of_lamp(lamp);
                let mut metric = [0.0; 6];
                (0..3).for_each(|a| metric[AT[a][a]] = 1.0 / xyz[a].max(xyz[1]).powi(2));
                let bare = feature(lamp, &vec![1.0; products.range.len()]);
                sides[side].push(None, &bare, xyz, metric);
            }
        }
        let weights: Vec<ToXyz> =
            (0..products.lamps.len()).map(|lamp| products.weights_of_lamp(lamp)).collect();
        for (item, product) in products.items.iter().enumerate() {
            let xyz = |part: &Part| xyz_by(&weights[part.lamp], &part.filter);
            let found: Vec<Triple> = product.parts.iter().map(xyz).collect();
            let total = std::array::from_fn(|a| found.iter().map(|xyz: &Triple| xyz[a]).sum());
            let metric = metric(total, product.white);
            for (part, xyz) in product.parts.iter().zip(found) {
                if let Some(side) = side_of[part.lamp] {
                    sides[side].push(Some(item), &feature(part.lamp, &part.filter), xyz, metric);
                }
            }
        }
        sides
    }

    fn empty(wavelengths: usize) -> Self {
        Self {
            lamps: Vec::new(),
            features: vec![Vec::new(); wavelengths],
            targets: Vec::new(),
            metrics: Vec::new(),
            items: Vec::new(),
        }
    }

    fn push(&mut self, item: Option<usize>, feature: &[f64], xyz: Triple, metric: Symmetric) {
        for (column, f) in self.features.iter_mut().zip(feature) {
            column.push(*f);
        }
        self.targets.push(xyz);
        self.metrics.push(metric);
        self.items.push(item);
    }

    /// What the weights miss in each row: sampled minus exact XYZ.
    pub fn residuals(&self, wavelengths: &[usize], weights: &ToXyz) -> Vec<Triple> {
        let mut found: Vec<Triple> = self.targets.iter().map(|t| t.map(|v| -v)).collect();
        for (i, &w) in wavelengths.iter().enumerate() {
            for (xyz, f) in found.iter_mut().zip(&self.features[w]) {
                for (sum, row) in xyz.iter_mut().zip(weights) {
                    *sum += row[i] * f;
                }
            }
        }
        found
    }

    /// The metric of a row.
    pub fn metric(&self, row: usize) -> &Symmetric {
        &self.metrics[row]
    }
}

/// The normal equations over a list of candidate wavelengths, in blocks of 3 × 3 (X, Y, Z).
pub(crate) struct Normal {
    /// The block of each pair of candidates, whole matrix.
    pairs: Vec<Symmetric>,
    right: Vec<Triple>,
    candidates: usize,
}

impl Normal {
    /// The equations of one side, each product counted `importance` times.
    pub fn new(side: &Side, importance: &[f64], candidates: &[usize]) -> Self {
        let rows = side.targets.len();
        let total: f64 = side.items.iter().flatten().map(|&item| importance[item]).sum();
        let of_row = |row: usize| side.items[row].map_or(HOLD_WHITE * total, |item| importance[item]);
        // ω G, by element, so that the sums below run over memory in order.
        let weighted: Vec<Vec<f64>> =
            (0..6).map(|e| (0..rows).map(|r| of_row(r) * side.metrics[r][e]).collect()).collect();
        let n = candidates.len();
        let lines: Vec<Vec<Symmetric>> = (0..n)
            .into_par_iter()
            .map(|i| {
                let left = &side.features[candidates[i]];
                (i..n).map(|j| block(left, &side.features[candidates[j]], &weighted)).collect()
            })
            .collect();
        let mut pairs = vec![[0.0; 6]; n * n];
        for (i, line) in lines.iter().enumerate() {
            for (j, block) in (i..n).zip(line) {
                pairs[i * n + j] = *block;
                pairs[j * n + i] = *block;
            }
        }
        let pulled: Vec<Triple> = (0..rows)
            .map(|r| {
                let t = side.targets[r];
                std::array::from_fn(|a| (0..3).map(|b| weighted[AT[a][b]][r] * t[b]).sum())
            })
            .collect();
        let right = candidates
            .iter()
            .map(|&w| {
                let mut sum = [0.0; 3];
                for (f, pull) in side.features[w].iter().zip(&pulled) {
                    for (s, p) in sum.iter_mut().zip(pull) {
                        *s += f * p;
                    }
                }
                sum
            })
            .collect();
        Self { pairs, right, candidates: n }
    }

    fn block(&self, i: usize, j: usize) -> Matrix3<f64> {
        let s = &self.pairs[i * self.candidates + j];
        Matrix3::from_fn(|a, b| s[AT[a][b]])
    }

    fn right(&self, i: usize) -> Vector3<f64> {
        Vector3::from(self.right[i])
    }

    /// The matrix and the right side for a set of candidates, with a trace of regularisation.
    fn system(&self, set: &[usize]) -> (DMatrix<f64>, DVector<f64>) {
        let n = 3 * set.len();
        let mut a = DMatrix::from_fn(n, n, |r, c| {
            self.pairs[set[r / 3] * self.candidates + set[c / 3]][AT[r % 3][c % 3]]
        });
        let trace = 1e-12 * a.trace() / n.max(1) as f64;
        for i in 0..n {
            a[(i, i)] += trace;
        }
        (a, DVector::from_fn(n, |r, _| self.right[set[r / 3]][r % 3]))
    }

    /// The best non-negative weights on a set, as rows X, Y, Z, and how much of the error they take away.
    pub fn nonnegative(&self, set: &[usize]) -> (ToXyz, f64) {
        let (a, b) = self.system(set);
        let (x, gain) = least_squares(a, &b);
        ([0, 1, 2].map(|row| (0..set.len()).map(|i| x[3 * i + row]).collect()), gain)
    }

    /// How much of the error is taken away by the best weights of any sign on `set` and one candidate more, for each
    /// candidate: by the Schur complement of the set.
    pub fn gains(&self, set: &[usize]) -> Vec<f64> {
        let (a, b) = self.system(set);
        let n = b.len();
        let factor = Cholesky::new(a);
        let solved = factor.as_ref().map(|f| f.l().solve_lower_triangular(&b).unwrap_or_else(|| b.clone()));
        let base = solved.as_ref().map_or(0.0, |s| s.dot(s));
        let lower = factor.as_ref().map(Cholesky::l);
        (0..self.candidates)
            .map(|candidate| {
                if set.contains(&candidate) {
                    return f64::NEG_INFINITY;
                }
                let own = self.block(candidate, candidate);
                let mut schur = own;
                let mut residual = self.right(candidate);
                if let (Some(l), Some(s)) = (&lower, &solved) {
                    let mut cross = DMatrix::zeros(n, 3);
                    for (k, &i) in set.iter().enumerate() {
                        cross.fixed_view_mut::<3, 3>(3 * k, 0).copy_from(&self.block(i, candidate));
                    }
                    if !l.solve_lower_triangular_mut(&mut cross) {
                        return f64::NEG_INFINITY;
                    }
                    schur -= Matrix3::from_iterator((cross.transpose() * &cross).iter().copied());
                    residual -= Vector3::from_iterator((cross.transpose() * s).iter().copied());
                }
                schur += Matrix3::identity() * (1e-9 * own.trace());
                let step = schur.cholesky().map_or(0.0, |c| residual.dot(&c.solve(&residual)));
                base + step
            })
            .collect()
    }
}

/// Σ ω G rᵢ rⱼ over the rows.
fn block(left: &[f64], right: &[f64], weighted: &[Vec<f64>]) -> Symmetric {
    let [g0, g1, g2, g3, g4, g5] = std::array::from_fn(|e| weighted[e].as_slice());
    let mut partial = [[0.0f64; 4]; 6];
    let rows = left.len();
    let whole = rows / 4 * 4;
    for r in (0..whole).step_by(4) {
        let t: [f64; 4] = std::array::from_fn(|k| left[r + k] * right[r + k]);
        for (sums, g) in partial.iter_mut().zip([g0, g1, g2, g3, g4, g5]) {
            for k in 0..4 {
                sums[k] = g[r + k].mul_add(t[k], sums[k]);
            }
        }
    }
    for r in whole..rows {
        let t = left[r] * right[r];
        for (sums, g) in partial.iter_mut().zip([g0, g1, g2, g3, g4, g5]) {
            sums[0] += g[r] * t;
        }
    }
    partial.map(|p| (p[0] + p[1]) + (p[2] + p[3]))
}
