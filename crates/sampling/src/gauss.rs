//! Gauss quadrature along the axes AC₁C₂, and `meyer`, the four samples that come of it (Meyer 1988; book 3.5.2, III.8).

use crate::{Basis, Role, ToXyz};
use illuminant_color::XYZ_TO_AC1C2;
use illuminant_spectrum::{Curve, LUMINOUS_EFFICACY, Observer, SpectralRange};
use nalgebra::{DMatrix, DVector, Matrix3};

/// Points nearer than this, nm, are taken together when the axes share points.
const SHARED_NM: f64 = 10.0;

/// Point samples with weights to XYZ.
///
/// The integral of a curve against the weight function of an axis, a(λ) = M (x̄, ȳ, z̄), is exact for polynomials of
/// degree 2n − 1 with n Gauss points. An axis on which colours vary more gets more points: with 3, 2 and 1 points on A,
/// C₁ and C₂ six wavelengths arise (483.1, 557.8 and 632.3; 490.9 and 631.4; 456.4 nm); where two lie close together the
/// one of the axis with fewer points serves both, which leaves Meyer's four.
#[derive(Clone, Debug)]
pub struct Gauss {
    range: SpectralRange,
    wavelengths_nm: Vec<f64>,
    map: ToXyz,
}

impl Gauss {
    /// The Gauss points of the orders `n` on A, C₁ and C₂; a sentence where an axis has no such rule (the weight
    /// functions change sign, so that points may be complex or lie outside the range).
    ///
    /// # Errors
    /// The sentence.
    pub fn new(orders: [usize; 3], range: SpectralRange) -> Result<Self, String> {
        let axes = axis_functions(range);
        let mut points: Vec<Vec<f64>> = Vec::new();
        for ((axis, &n), name) in axes.iter().zip(&orders).zip(["A", "C1", "C2"]) {
            points.push(gauss_points(axis, n, range).ok_or_else(|| {
                format!(
                    "there is no Gauss rule of {n} points for {name} over {}–{} nm",
                    range.min_nm, range.max_nm
                )
            })?);
        }
        // The axis with the fewest points keeps them; the others take over what is near.
        let mut order = [0, 1, 2];
        order.sort_by_key(|&axis| orders[axis]);
        let mut fixed: Vec<f64> = Vec::new();
        for axis in order {
            for point in &mut points[axis] {
                match fixed.iter().find(|f| (**f - *point).abs() <= SHARED_NM) {
                    Some(shared) => *point = *shared,
                    None => fixed.push(*point),
                }
            }
            points[axis].dedup();
        }
        fixed.sort_by(f64::total_cmp);
        let mut rows: [Vec<f64>; 3] = std::array::from_fn(|_| vec![0.0; fixed.len()]);
        for axis in 0..3 {
            let weights = interpolatory_weights(&axes[axis], &points[axis], range);
            for (point, weight) in points[axis].iter().zip(weights) {
                let at = fixed.iter().position(|f| f == point).unwrap_or(0);
                rows[axis][at] += LUMINOUS_EFFICACY * weight;
            }
        }
        Ok(Self { range, wavelengths_nm: fixed, map: to_xyz(&rows) })
    }

    /// The four samples, with the weights of the book's III.8 (in units of the sum of ȳ).
    ///
    /// As printed there, the row of C₁ has its first weight at 557.7 nm. The Gauss rule of C₁ has it at 490.9 nm, and so
    /// has this; [`Gauss::meyer_as_printed`] is the book's.
    #[must_use]
    pub fn meyer(range: SpectralRange) -> Self {
        Self::of_book([0.0, 0.31824, 0.0, -0.46008], range)
    }

    /// The four samples with the weights as the book prints them.
    #[must_use]
    pub fn meyer_as_printed(range: SpectralRange) -> Self {
        Self::of_book([0.0, 0.0, 0.31824, -0.46008], range)
    }

    fn of_book(c1: [f64; 4], range: SpectralRange) -> Self {
        let area = Observer::cie_1931_2deg().matching[1].area(SpectralRange::default());
        let scale = LUMINOUS_EFFICACY * area / 1.057_863;
        let rows = [[0.0, 0.18892, 0.67493, 0.19253], c1, [0.54640, 0.0, 0.0, 0.0]];
        let rows = rows.map(|row| row.iter().map(|v| v * scale).collect());
        Self { range, wavelengths_nm: vec![456.4, 490.9, 557.7, 631.4], map: to_xyz(&rows) }
    }
}

/// Rows of weights on AC₁C₂ as rows of weights on XYZ.
fn to_xyz(rows: &[Vec<f64>; 3]) -> ToXyz {
    let inverse =
        Matrix3::from_fn(|i, j| XYZ_TO_AC1C2.0[i][j]).try_inverse().unwrap_or_else(Matrix3::identity);
    std::array::from_fn(|i| {
        (0..rows[0].len()).map(|s| (0..3).map(|j| inverse[(i, j)] * rows[j][s]).sum()).collect()
    })
}

/// The weight functions of the three axes at each nm (figure 3.14).
fn axis_functions(range: SpectralRange) -> [Vec<f64>; 3] {
    let observer = Observer::cie_1931_2deg();
    XYZ_TO_AC1C2.0.map(|row| {
        let at = |w| row.iter().zip(&observer.matching).map(|(c, m)| c * m.at(w)).sum();
        range.wavelengths().map(at).collect()
    })
}

/// Wavelength as a number between −1 and 1, in which moments are well conditioned.
fn unit(range: SpectralRange, wavelength_nm: f64) -> f64 {
    let half = 0.5 * (range.width_nm() - 1.0);
    (wavelength_nm - f64::from(range.min_nm)) / half - 1.0
}

fn moment(function: &[f64], power: usize, range: SpectralRange) -> f64 {
    range.wavelengths().zip(function).map(|(w, f)| f * unit(range, w).powi(power as i32)).sum()
}

/// The n Gauss points of a weight function: the roots of its orthogonal polynomial of degree n, as eigenvalues of the
/// companion matrix. `None` when they are not n different points within the range.
fn gauss_points(function: &[f64], n: usize, range: SpectralRange) -> Option<Vec<f64>> {
    let moments: Vec<f64> = (0..2 * n).map(|k| moment(function, k, range)).collect();
    let hankel = DMatrix::from_fn(n, n, |i, j| moments[i + j]);
    let right = DVector::from_fn(n, |i, _| -moments[n + i]);
    let coefficients = hankel.lu().solve(&right)?;
    let companion =
        DMatrix::from_fn(
            n,
            n,
            |i, j| {
                if j == n - 1 { -coefficients[i] } else { f64::from(u8::from(i == j + 1)) }
            },
        );
    let roots = companion.complex_eigenvalues();
    let half = 0.5 * (range.width_nm() - 1.0);
    let mut points: Vec<f64> = Vec::with_capacity(n);
    for root in roots.iter() {
        if root.im.abs() > 1e-9 || root.re.abs() > 1.0 {
            return None;
        }
        points.push(f64::from(range.min_nm) + (root.re + 1.0) * half);
    }
    points.sort_by(f64::total_cmp);
    points.windows(2).all(|pair| pair[1] - pair[0] > 1e-3).then_some(points)
}

/// The weights on given points that are exact for polynomials of a degree below their number.
fn interpolatory_weights(function: &[f64], points: &[f64], range: SpectralRange) -> Vec<f64> {
    let n = points.len();
    let vandermonde = DMatrix::from_fn(n, n, |i, j| unit(range, points[j]).powi(i as i32));
    let moments = DVector::from_fn(n, |i, _| moment(function, i, range));
    vandermonde.lu().solve(&moments).map_or_else(|| vec![0.0; n], |w| w.iter().copied().collect())
}

impl Basis for Gauss {
    fn len(&self) -> usize {
        self.wavelengths_nm.len()
    }

    fn wavelength_nm(&self, sample: usize) -> f64 {
        self.wavelengths_nm[sample]
    }

    fn reduce(&self, curve: &Curve, _role: Role) -> Vec<f64> {
        // Nothing is carried beyond the range.
        let (first, last) = (f64::from(self.range.min_nm), f64::from(self.range.max_nm));
        let at = |&w: &f64| if (first..=last).contains(&w) { curve.at(w) } else { 0.0 };
        self.wavelengths_nm.iter().map(at).collect()
    }

    fn to_xyz(&self, _lamp: usize) -> ToXyz {
        self.map.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map_times(basis: &Gauss, curve: &Curve) -> [f64; 3] {
        let values = basis.reduce(curve, Role::Fraction);
        basis.to_xyz(0).map(|row| row.iter().zip(&values).map(|(w, v)| w * v).sum())
    }

    #[test]
    fn four_points_of_meyer_arise_from_orders_3_2_and_1() {
        let range = SpectralRange::default();
        let gauss = Gauss::new([3, 2, 1], range).unwrap();
        let meyer = Gauss::meyer(range);
        assert_eq!(gauss.len(), 4);
        for (found, known) in gauss.wavelengths_nm.iter().zip(&meyer.wavelengths_nm) {
            assert!((found - known).abs() < 0.1, "{found} against {known}");
        }
        let largest = meyer.map.iter().flatten().copied().fold(0.0, f64::max);
        for (found, known) in gauss.map.iter().flatten().zip(meyer.map.iter().flatten()) {
            assert!((found - known).abs() < 0.006 * largest, "{found} against {known}");
        }
        // As printed, C1 alone disagrees with the rule, and by far.
        let printed = Gauss::meyer_as_printed(range);
        let off = gauss.map.iter().flatten().zip(printed.map.iter().flatten());
        assert!(off.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) > 0.1 * largest);
    }

    #[test]
    fn polynomials_up_to_degree_2n_minus_1_are_exact_on_an_axis_of_its_own_points() {
        let range = SpectralRange::default();
        let [a, ..] = axis_functions(range);
        for n in 1..=4 {
            let points = gauss_points(&a, n, range).unwrap();
            let weights = interpolatory_weights(&a, &points, range);
            for power in 0..2 * n {
                let sum: f64 =
                    points.iter().zip(&weights).map(|(p, w)| w * unit(range, *p).powi(power as i32)).sum();
                let exact = moment(&a, power, range);
                assert!((sum - exact).abs() < 1e-8 * moment(&a, 0, range), "{n} points, degree {power}");
            }
        }
    }

    #[test]
    fn a_flat_curve_has_the_colour_of_equal_energy() {
        let range = SpectralRange::default();
        let flat = Curve::constant(1.0);
        let exact = Observer::cie_1931_2deg().xyz(&flat, range);
        let rules =
            [[2, 2, 1], [3, 2, 1], [4, 2, 2]].map(|orders| (Gauss::new(orders, range).unwrap(), 1e-9));
        for (basis, tolerance) in [(Gauss::meyer(range), 3e-4)].into_iter().chain(rules) {
            for (found, exact) in map_times(&basis, &flat).iter().zip(exact) {
                assert!((found / exact - 1.0).abs() < tolerance, "{found} against {exact}");
            }
        }
        assert!(Gauss::new([3, 3, 1], range).unwrap_err().contains("C1"));
    }
}
