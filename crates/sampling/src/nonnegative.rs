//! Least squares with non-negative unknowns.

use nalgebra::{Cholesky, DMatrix, DVector};

/// The x ≥ 0 that minimises xᵀAx − 2bᵀx for a positive definite A, and bᵀx, by which that beats x = 0.
///
/// Block principal pivoting (Portugal, Júdice and Vicente 1994; Kim and Park 2011): unknowns that came out negative, or
/// whose slope pulls them up, change sides together; if that fails to make progress, only the last of them.
pub(crate) fn least_squares(mut a: DMatrix<f64>, b: &DVector<f64>) -> (DVector<f64>, f64) {
    let n = b.len();
    // Two wavelengths that say the same make the matrix singular to rounding: a trace of regularisation parts them.
    let mut trace = 1e-12 * a.trace() / n.max(1) as f64;
    while trace.is_finite() && trace > 0.0 && Cholesky::new(a.clone()).is_none() {
        (0..n).for_each(|i| a[(i, i)] += trace);
        trace *= 10.0;
    }
    let a = &a;
    let mut free = vec![true; n];
    let mut fewest = n + 1;
    let mut patience = 3;
    for _ in 0..5 * n + 20 {
        let indices: Vec<usize> = (0..n).filter(|&i| free[i]).collect();
        let x = solve(a, b, &indices);
        let slope = a * &x - b;
        let scale = 1e-12 * b.amax();
        let wrong: Vec<usize> =
            (0..n).filter(|&i| if free[i] { x[i] < 0.0 } else { slope[i] < -scale }).collect();
        if wrong.is_empty() {
            let gain = b.dot(&x);
            return (x, gain);
        }
        if wrong.len() < fewest {
            (fewest, patience) = (wrong.len(), 3);
        } else {
            patience -= 1;
        }
        if patience >= 0 {
            wrong.iter().for_each(|&i| free[i] = !free[i]);
        } else {
            let last = wrong[wrong.len() - 1];
            free[last] = !free[last];
        }
    }
    // Rounding keeps a pair of unknowns changing sides: what is negative is negligible.
    let indices: Vec<usize> = (0..n).filter(|&i| free[i]).collect();
    let x = solve(a, b, &indices).map(|v| v.max(0.0));
    let gain = 2.0 * b.dot(&x) - x.dot(&(a * &x));
    (x, gain)
}

/// The unknowns `indices` that solve their part of Ax = b, the others zero.
fn solve(a: &DMatrix<f64>, b: &DVector<f64>, indices: &[usize]) -> DVector<f64> {
    let part = DMatrix::from_fn(indices.len(), indices.len(), |i, j| a[(indices[i], indices[j])]);
    let right = DVector::from_fn(indices.len(), |i, _| b[indices[i]]);
    let mut x = DVector::zeros(b.len());
    if let Some(cholesky) = Cholesky::new(part) {
        for (&i, v) in indices.iter().zip(cholesky.solve(&right).iter()) {
            x[i] = *v;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_conditions_of_karush_kuhn_and_tucker_hold(entries in prop::collection::vec(-1.0..1.0f64, 8 * 12 + 12)) {
            let m = DMatrix::from_row_slice(12, 8, &entries[..96]);
            let y = DVector::from_row_slice(&entries[96..]);
            let a = m.transpose() * &m + DMatrix::identity(8, 8) * 1e-9;
            let b = m.transpose() * y;
            let (x, gain) = least_squares(a.clone(), &b);
            let slope = &a * &x - &b;
            for i in 0..8 {
                prop_assert!(x[i] >= 0.0 && slope[i] > -1e-9 && (x[i] * slope[i]).abs() < 1e-9);
            }
            prop_assert!((gain - (2.0 * b.dot(&x) - x.dot(&(&a * &x)))).abs() < 1e-9);
        }
    }
}
