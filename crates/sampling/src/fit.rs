//! The choice of wavelengths and weights for a scene.
//!
//! For given wavelengths the best weights are a least-squares problem in the metric of CIEDE2000; the wavelengths are
//! found by exchange (Fedorov 1972, for designs of experiments): a greedy start and evenly spaced ones with jitter, each
//! improved by taking out one wavelength and putting in the best one, first on a coarse grid, then nm by nm with weights
//! kept from falling below zero. Then products that came out badly are given more weight and the wavelengths are moved
//! again, which brings the largest errors down.

use crate::normal_equations::{Normal, Side, quadratic};
use crate::products::splitmix;
use crate::{Products, ToXyz};
use rayon::prelude::*;

/// Spacing of the coarse grid, nm.
const COARSE: usize = 4;
/// Evenly spaced starts beside the greedy one.
const STARTS: u64 = 6;
/// Starts that are refined nm by nm.
const REFINED: usize = 3;
/// Rounds of reweighting.
const ROUNDS: usize = 5;
/// The power of the error whose mean is made small.
const POWER: i32 = 4;
/// Improvements smaller than this fraction are none: it ends the search and hides rounding.
const LEAST: f64 = 1e-9;

/// Wavelengths and the weights of each lamp.
pub(crate) struct Fit {
    /// Numbers of the wavelengths in the range of the products, increasing.
    pub wavelengths: Vec<usize>,
    /// For each lamp, the XYZ that one unit of filter (with one map for all: of light) brings at each wavelength; none for
    /// a lamp without light.
    pub weights: Vec<Option<ToXyz>>,
}

/// The best `n` wavelengths found, and their weights; `None` where there is nothing to fit.
pub(crate) fn fit(products: &Products, n: usize) -> Option<Fit> {
    let known = products.items.len();
    let products = &products.clone().with_unknown_materials();
    let sides = Side::all(products);
    let points = products.range.len();
    if sides.is_empty() || points < n {
        return None;
    }
    let base: Vec<f64> = products.items.iter().map(|item| item.weight).collect();
    // With no product known, the unknown ones are all there is.
    let known = if known == 0 { products.items.len() } else { known };
    let total: f64 = base[..known].iter().sum();
    let mut importance = base.clone();
    let mut set = Vec::new();
    let mut best: Option<(f64, Vec<usize>, Vec<ToXyz>)> = None;
    for round in 0..ROUNDS {
        let starts = if round == 0 { starts(&sides, &importance, points, n) } else { vec![set] };
        let refined = starts.into_iter().map(|start| refine(&sides, &importance, points, start));
        let (refined, weights, _) = refined.max_by(|a, b| a.2.total_cmp(&b.2))?;
        set = refined;
        let errors = errors(products, &sides, &set, &weights);
        let errors = &errors[..known];
        let mean = errors.iter().zip(&base).map(|(e, w)| e * w).sum::<f64>() / total;
        let score = mean + 0.05 * errors.iter().copied().fold(0.0, f64::max);
        if best.as_ref().is_none_or(|(least, ..)| score < *least) {
            best = Some((score, set.clone(), weights));
        }
        // What is not known keeps its weight: it is here to be served, not to rule.
        for ((new, e), b) in importance.iter_mut().zip(errors).zip(&base) {
            *new = b * (e / mean.max(1e-9) + 0.05).powi(POWER - 2);
        }
    }
    let (_, wavelengths, by_side) = best?;
    let sound = |map: &ToXyz| map.iter().flatten().all(|w| w.is_finite()) && map[1].iter().any(|w| *w > 0.0);
    if !by_side.iter().all(sound) {
        return None;
    }
    let mut weights = vec![None; products.lamps.len()];
    for (side, rows) in sides.iter().zip(by_side) {
        for &lamp in &side.lamps {
            let luminance = if products.shares_map(lamp) { 1.0 } else { products.xyz_of_lamp(lamp)[1] };
            weights[lamp] = Some(rows.clone().map(|row| row.iter().map(|v| v * luminance).collect()));
        }
    }
    Some(Fit { wavelengths, weights })
}

/// The error of every product in the metric of the fit.
fn errors(products: &Products, sides: &[Side], set: &[usize], weights: &[ToXyz]) -> Vec<f64> {
    let mut missed = vec![[0.0; 3]; products.items.len()];
    let mut metrics = vec![[0.0; 6]; products.items.len()];
    for (side, weights) in sides.iter().zip(weights) {
        for (row, residual) in side.residuals(set, weights).into_iter().enumerate() {
            let Some(item) = side.items[row] else { continue };
            metrics[item] = *side.metric(row);
            for (sum, r) in missed[item].iter_mut().zip(residual) {
                *sum += r;
            }
        }
    }
    missed.iter().zip(&metrics).map(|(d, g)| quadratic(g, *d).max(0.0).sqrt()).collect()
}

fn normals(sides: &[Side], importance: &[f64], candidates: &[usize]) -> Vec<Normal> {
    sides.iter().map(|side| Normal::new(side, importance, candidates)).collect()
}

/// The error taken away on all sides by non-negative weights.
fn gain(normals: &[Normal], set: &[usize]) -> f64 {
    normals.iter().map(|normal| normal.nonnegative(set).1).sum()
}

fn gains(normals: &[Normal], set: &[usize]) -> Vec<f64> {
    let mut sum: Vec<f64> = Vec::new();
    for normal in normals {
        let gains = normal.gains(set);
        if sum.is_empty() {
            sum = gains;
        } else {
            sum.iter_mut().zip(gains).for_each(|(s, g)| *s += g);
        }
    }
    sum
}

/// Good sets of wavelengths on the coarse grid.
fn starts(sides: &[Side], importance: &[f64], points: usize, n: usize) -> Vec<Vec<usize>> {
    // A short range may have fewer coarse points than are needed.
    let step = COARSE.min(points / n).max(1);
    let grid: Vec<usize> = (0..points).step_by(step).collect();
    let normals = normals(sides, importance, &grid);
    let mut sets = vec![greedy(&normals, n)];
    sets.extend((0..STARTS).filter_map(|seed| spread(seed, grid.len(), n)));
    let mut found: Vec<(Vec<usize>, f64)> = sets.into_par_iter().map(|set| exchange(&normals, set)).collect();
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    found.dedup_by(|a, b| a.0 == b.0);
    found.truncate(REFINED);
    let on_grid = |set: Vec<usize>| set.iter().map(|&i| grid[i]).collect();
    found
        .into_par_iter()
        .map(|(set, _)| on_grid(exchange_nonnegative(&normals, set, &|_, _| true, 4).0))
        .collect()
}

/// One wavelength after the other, each the best beside those before it.
fn greedy(normals: &[Normal], n: usize) -> Vec<usize> {
    let mut set = Vec::with_capacity(n);
    while set.len() < n {
        set.extend(largest(&gains(normals, &set), 1));
    }
    set
}

/// Evenly spaced candidates with jitter, over the middle of the range; `None` when two would coincide.
fn spread(seed: u64, candidates: usize, n: usize) -> Option<Vec<usize>> {
    let mut state = seed;
    let mut uniform =
        |low: f64, high: f64| low + (high - low) * (splitmix(&mut state) >> 11) as f64 / (1u64 << 53) as f64;
    let last = (candidates - 1) as f64;
    // Of 380–780 nm the observer sees little below 400 and above 700.
    let (first, end) = (uniform(0.01, 0.11) * last, uniform(0.67, 0.85) * last);
    let mut set: Vec<usize> = (0..n)
        .map(|i| first + (i as f64 + uniform(-0.3, 0.3)) * (end - first) / (n.max(2) - 1) as f64)
        .map(|x| x.round().clamp(0.0, last) as usize)
        .collect();
    set.sort_unstable();
    set.windows(2).all(|pair| pair[0] < pair[1]).then_some(set)
}

/// Numbers of the largest values.
fn largest(values: &[f64], count: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[b].total_cmp(&values[a]));
    order.truncate(count);
    order
}

/// Takes out one wavelength after another and puts in the best, with weights of any sign, until nothing improves.
fn exchange(normals: &[Normal], mut set: Vec<usize>) -> (Vec<usize>, f64) {
    let mut best = f64::NEG_INFINITY;
    for _ in 0..10 {
        let before = best;
        for slot in 0..set.len() {
            let mut others = set.clone();
            others.remove(slot);
            let gains = gains(normals, &others);
            let Some(&candidate) = largest(&gains, 1).first() else { continue };
            let now = gains[set[slot]];
            best = now.max(best);
            if gains[candidate] > now + LEAST * now.abs() {
                set[slot] = candidate;
                best = gains[candidate];
            }
        }
        if best <= before + LEAST * before.abs() {
            break;
        }
    }
    set.sort_unstable();
    (set, best)
}

/// The same with weights kept from falling below zero. In each slot are tried the `most` candidates that look best
/// without that constraint, and the neighbours, as far as `allowed(old, new)`.
fn exchange_nonnegative(
    normals: &[Normal],
    mut set: Vec<usize>,
    allowed: &(dyn Fn(usize, usize) -> bool + Sync),
    most: usize,
) -> (Vec<usize>, f64) {
    let mut best = gain(normals, &set);
    for _ in 0..6 {
        let before = best;
        for slot in 0..set.len() {
            let mut others = set.clone();
            let old = others.remove(slot);
            let mut gains = gains(normals, &others);
            for (candidate, gain) in gains.iter_mut().enumerate() {
                if candidate == old || !allowed(old, candidate) {
                    *gain = f64::NEG_INFINITY;
                }
            }
            let mut tried = largest(&gains, most);
            tried.retain(|&c| gains[c] > best);
            let results: Vec<(f64, usize)> = tried
                .into_par_iter()
                .map(|candidate| {
                    let mut trial = set.clone();
                    trial[slot] = candidate;
                    (gain(normals, &trial), candidate)
                })
                .collect();
            for (found, candidate) in results {
                if found > best + LEAST * best.abs() {
                    best = found;
                    set[slot] = candidate;
                }
            }
        }
        if best <= before + LEAST * before.abs() {
            break;
        }
    }
    set.sort_unstable();
    (set, best)
}

/// Moves wavelengths nm by nm; the wavelengths, the weights of each side, and how much of the error they take away.
fn refine(
    sides: &[Side],
    importance: &[f64],
    points: usize,
    mut set: Vec<usize>,
) -> (Vec<usize>, Vec<ToXyz>, f64) {
    let mut sweep = 0;
    loop {
        // Beside each wavelength its neighbours, near ones closely.
        let mut candidates: Vec<usize> = set
            .iter()
            .flat_map(|&w| [-6i64, -4, -2, -1, 0, 1, 2, 4, 6].map(|d| w as i64 + d))
            .filter(|w| (0..points as i64).contains(w))
            .map(|w| w as usize)
            .collect();
        candidates.sort_unstable();
        candidates.dedup();
        let normals = normals(sides, importance, &candidates);
        let numbers: Vec<usize> = set.iter().filter_map(|w| candidates.binary_search(w).ok()).collect();
        let near = |old: usize, new: usize| candidates[old].abs_diff(candidates[new]) <= 8;
        let (moved, _) = exchange_nonnegative(&normals, numbers, &near, 4);
        let wavelengths: Vec<usize> = moved.iter().map(|&i| candidates[i]).collect();
        if wavelengths == set || sweep == 5 {
            let (weights, gains): (_, Vec<f64>) = normals.iter().map(|n| n.nonnegative(&moved)).unzip();
            return (wavelengths, weights, gains.iter().sum());
        }
        set = wavelengths;
        sweep += 1;
    }
}
