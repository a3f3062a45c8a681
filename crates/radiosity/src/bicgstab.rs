//! The stabilised biconjugate gradient method (van der Vorst 1992) for A x = b, for many right-hand sides at once.
//!
//! The columns of b do not mix: each has scalar products and steps of its own, and only the products A p and A s, which take nearly all
//! the time, are shared. It begins at x = 0, where the residual is b without a product. Sums have an order that does not depend on
//! threads.

use crate::cancel::{Cancel, Cancelled};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use rayon::slice::{ParallelSlice, ParallelSliceMut};

/// Rows that are summed one after the other; the sums of such pieces are added in their order.
const ROWS: usize = 1024;

/// A number for each column.
type Each = Vec<f64>;

fn ratio(a: &[f64], b: &[f64]) -> Each {
    a.iter().zip(b).map(|(a, b)| if *b == 0.0 { 0.0 } else { a / b }).collect()
}

/// The total of the sums of pieces.
fn total<const K: usize>(pieces: &[[Each; K]], columns: usize) -> [Each; K] {
    let mut sums = std::array::from_fn(|_| vec![0.0; columns]);
    for piece in pieces {
        for (sums, piece) in sums.iter_mut().zip(piece) {
            sums.iter_mut().zip(piece).for_each(|(sum, v)| *sum += v);
        }
    }
    sums
}

/// Scalar products of `a` and `b`, and of `a` and itself.
fn products(a: &[f32], b: &[f32], columns: usize) -> [Each; 2] {
    let pieces: Vec<[Each; 2]> = (a.par_chunks(ROWS * columns), b.par_chunks(ROWS * columns))
        .into_par_iter()
        .map(|(a, b)| {
            let [mut ab, mut aa] = [vec![0.0; columns], vec![0.0; columns]];
            for (a, b) in a.chunks_exact(columns).zip(b.chunks_exact(columns)) {
                for (((ab, aa), a), b) in ab.iter_mut().zip(&mut aa).zip(a).zip(b) {
                    let a = f64::from(*a);
                    *ab += a * f64::from(*b);
                    *aa += a * a;
                }
            }
            [ab, aa]
        })
        .collect();
    total(&pieces, columns)
}

/// Goes from `r` by `−step` along `along`; gives the scalar products of the new `r` with `shadow` and with itself.
fn reduce(r: &mut [f32], step: &[f64], along: &[f32], shadow: &[f32], columns: usize) -> [Each; 2] {
    let step: Vec<f32> = step.iter().map(|v| *v as f32).collect();
    let width = ROWS * columns;
    let pieces: Vec<[Each; 2]> = (r.par_chunks_mut(width), along.par_chunks(width), shadow.par_chunks(width))
        .into_par_iter()
        .map(|(r, along, shadow)| {
            let [mut rs, mut rr] = [vec![0.0; columns], vec![0.0; columns]];
            let rows = r.chunks_exact_mut(columns).zip(along.chunks_exact(columns));
            for ((r, along), shadow) in rows.zip(shadow.chunks_exact(columns)) {
                let sums = rs.iter_mut().zip(&mut rr);
                for ((((r, along), shadow), step), (rs, rr)) in
                    r.iter_mut().zip(along).zip(shadow).zip(&step).zip(sums)
                {
                    *r -= step * along;
                    let r = f64::from(*r);
                    *rs += r * f64::from(*shadow);
                    *rr += r * r;
                }
            }
            [rs, rr]
        })
        .collect();
    total(&pieces, columns)
}

/// Replaces each number of `to` by what `new` makes of its column, of it, and of those of `a` and `b` beside it.
fn replace(
    to: &mut [f32],
    [a, b]: [&[f32]; 2],
    columns: usize,
    new: impl Fn(usize, f32, f32, f32) -> f32 + Sync,
) {
    let width = ROWS * columns;
    (to.par_chunks_mut(width), a.par_chunks(width), b.par_chunks(width)).into_par_iter().for_each(
        |(to, a, b)| {
            let rows = to.chunks_exact_mut(columns).zip(a.chunks_exact(columns)).zip(b.chunks_exact(columns));
            for ((to, a), b) in rows {
                for (column, ((to, a), b)) in to.iter_mut().zip(a).zip(b).enumerate() {
                    *to = new(column, *to, *a, *b);
                }
            }
        },
    );
}

/// Finds x with the largest relative residual of all columns at most `tolerance`, as far as numbers of 32 bits carry, or until there were
/// `most` steps. With x, the residual at the beginning and after each step.
pub(crate) fn bicgstab(
    right: &[f32],
    columns: usize,
    (tolerance, most): (f64, usize),
    apply: impl Fn(&[f32]) -> Vec<f32>,
    cancel: &Cancel,
) -> Result<(Vec<f32>, Vec<f64>), Cancelled> {
    let mut x = vec![0f32; right.len()];
    if right.is_empty() {
        return Ok((x, vec![0.0]));
    }
    let [mut rho, norm] = products(right, right, columns);
    let relative =
        |squares: &[f64]| ratio(squares, &norm).iter().fold(0.0, |most: f64, v| most.max(v.sqrt()));
    let shadow = right;
    let (mut r, mut p) = (right.to_vec(), right.to_vec());
    let mut history = vec![relative(&norm)];
    while history[history.len() - 1] > tolerance && history.len() < most {
        cancel.check()?;
        let v = apply(&p);
        let [along, _] = products(shadow, &v, columns);
        let alpha = ratio(&rho, &along);
        let step: Vec<f32> = alpha.iter().map(|v| *v as f32).collect();
        // What the residual is half a step on: the method's s.
        let [_, half] = reduce(&mut r, &alpha, &v, shadow, columns);
        if relative(&half) <= tolerance {
            replace(&mut x, [&p, &p], columns, |i, x, p, _| x + step[i] * p);
            history.push(relative(&half));
            break;
        }
        cancel.check()?;
        let t = apply(&r);
        let [ts, tt] = products(&t, &r, columns);
        let omega = ratio(&ts, &tt);
        let second: Vec<f32> = omega.iter().map(|v| *v as f32).collect();
        replace(&mut x, [&p, &r], columns, |i, x, p, s| x + step[i] * p + second[i] * s);
        let [next, left] = reduce(&mut r, &omega, &t, shadow, columns);
        let beta: Vec<f32> =
            ratio(&next, &rho).iter().zip(ratio(&alpha, &omega)).map(|(a, b)| (a * b) as f32).collect();
        rho = next;
        replace(&mut p, [&r, &v], columns, |i, p, r, v| r + beta[i] * (p - second[i] * v));
        let residual = relative(&left);
        // Numbers of 32 bits carry no more: what is left is rounding.
        let stuck = history.len() > 8 && residual >= history[history.len() - 4];
        history.push(residual);
        if stuck {
            break;
        }
    }
    Ok((x, history))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A = 1 − K with K(i, j) = k_i / n in one column and its double in the other: x_i = b_i + k_i X, X = mean b / (1 − mean k).
    #[test]
    fn a_matrix_of_rank_one_beside_unity() {
        let n = 3000;
        let k = |i: usize, column: usize| 0.4 * (1.0 + (i as f32).sin()) * (1 + column) as f32 / 2.0;
        let right: Vec<f32> =
            (0..n).flat_map(|i| [1.0 + (i % 3) as f32, if i < 10 { 5.0 } else { 0.0 }, 0.0]).collect();
        let apply = |x: &[f32]| -> Vec<f32> {
            let mean: [f64; 3] =
                std::array::from_fn(|c| x.chunks(3).map(|row| f64::from(row[c])).sum::<f64>() / n as f64);
            (0..3 * n).map(|at| x[at] - k(at / 3, at % 3) * mean[at % 3] as f32).collect()
        };
        let cancel = Cancel::default();
        let (x, history) = bicgstab(&right, 3, (1e-6, 100), apply, &cancel).unwrap();
        assert!(history.len() < 6 && history[history.len() - 1] < 1e-6, "{history:?}");
        for column in 0..3 {
            let mean = |of: &dyn Fn(usize) -> f32| (0..n).map(|i| f64::from(of(i))).sum::<f64>() / n as f64;
            let all = mean(&|i| right[3 * i + column]) / (1.0 - mean(&|i| k(i, column)));
            for i in 0..n {
                let exact = f64::from(right[3 * i + column]) + f64::from(k(i, column)) * all;
                let found = f64::from(x[3 * i + column]);
                assert!((found - exact).abs() <= 1e-5 * exact, "{column} {i}: {found} {exact}");
            }
        }
        cancel.cancel();
        assert_eq!(bicgstab(&right, 3, (1e-6, 100), apply, &cancel), Err(Cancelled));
    }
}
