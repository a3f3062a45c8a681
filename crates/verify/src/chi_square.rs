//! Pearson's chi-square test of drawn directions against their density.
//!
//! The sphere is divided into cells; with N draws and E_i = N ∫_i pdf dω expected in cell i, O_i observed,
//!
//! X² = Σ (O_i − E_i)² / E_i
//!
//! follows the chi-square law with (cells − 1) degrees of freedom if the directions have that density; the
//! p-value is the chance of an X² at least as large. Draws that give no direction (the path ends, a discrete
//! lobe) make one more cell, with N (1 − ∫ pdf) expected: so the share of the continuous part is tested too.
//! Cells are split until none holds more than [`ChiSquare::finest`] of the draws (by expectation, never by what
//! was observed), so that a narrow highlight is resolved as well as a diffuse one; cells with less than
//! [`ChiSquare::least_expected`] are pooled, smallest first.
//!
//! Many tests at significance α fail by chance; [`sidak`] gives the significance of each of m tests so that all
//! together fail with α. The power: with c cells a relative error δ of the density is seen when N δ² is well
//! above √(2c), 4 % for the defaults; a lobe that is missing or sits elsewhere is always seen.
//!
//! Sources: Pearson 1900; Cochran, "The χ² test of goodness of fit", Annals of Mathematical Statistics 23
//! (1952), for the least expectation; Šidák, JASA 62 (1967); as a test of BRDF sampling, Subr and Arvo,
//! "Statistical hypothesis testing for assessing Monte Carlo estimators: applications to image synthesis",
//! Pacific Graphics 2007.
//!
//! ```
//! use illuminant_optics::hemisphere::cosine;
//! use illuminant_verify::chi_square::ChiSquare;
//! use std::f64::consts::{FRAC_1_PI, TAU};
//! let test = ChiSquare { samples: 20_000, ..ChiSquare::default() };
//! assert!(test.run(|u| Some(cosine(u)), |d| d[2].max(0.0) * FRAC_1_PI).passes(0.01));
//! // The same directions are not uniform over the hemisphere.
//! let uniform = |d: [f64; 3]| if d[2] > 0.0 { 1.0 / TAU } else { 0.0 };
//! assert!(!test.run(|u| Some(cosine(u)), uniform).passes(0.01));
//! ```

use crate::integrate::{Cell, Quadrature};
use crate::random::Random;
use crate::site::{Site, double, single};
use illuminant_illumination::IlluminationModel;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// The share of draws that may fall where the density is zero, by rounding at the rim of its support.
const STRAY: f64 = 1e-4;
/// What quadrature may add to a density that integrates to 1.
const EXCESS: f64 = 1e-3;

/// How to test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChiSquare {
    /// How many directions to draw, N.
    pub samples: u64,
    /// Key of the random numbers.
    pub seed: u64,
    /// The coarse cells, and how the density is integrated over each.
    pub quadrature: Quadrature,
    /// The largest share of the draws that a cell may expect before it is split.
    pub finest: f64,
    /// The least expected count of a cell; those with fewer are pooled.
    pub least_expected: f64,
}

impl Default for ChiSquare {
    /// 100,000 draws; coarse cells 16 × 16, split above 1/300 of the draws; at least 5 expected.
    fn default() -> Self {
        let quadrature = Quadrature { rows: 16, columns: 16, tolerance: 1e-3, ..Quadrature::default() };
        Self { samples: 100_000, seed: 0, quadrature, finest: 1.0 / 300.0, least_expected: 5.0 }
    }
}

/// What a test found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// X².
    pub statistic: f64,
    /// Cells after pooling, less one.
    pub degrees_of_freedom: usize,
    /// The chance of so large an X² if the density is right; 0 when a direction was no unit vector, when the
    /// density was no number, or when more than 10⁻⁴ of the draws fell where it is zero.
    pub p_value: f64,
    /// ∫ pdf dω, the probability of the continuous part: at most 1.
    pub probability: f64,
    /// How many draws gave a direction.
    pub directions: u64,
    /// How many of them fell where the density is zero.
    pub stray: u64,
    /// How many were no unit vectors.
    pub invalid: u64,
}

impl Outcome {
    /// Whether the density is believed at this significance (the chance of a false alarm), and integrates to at
    /// most 1.001.
    #[must_use]
    pub fn passes(&self, significance: f64) -> bool {
        self.p_value >= significance && self.probability <= 1.0 + EXCESS
    }
}

/// The significance of each of several independent tests so that the chance that any fails without reason is
/// that given: 1 − (1 − α)^(1/m) (Šidák 1967).
///
/// ```
/// # use illuminant_verify::chi_square::sidak;
/// assert!((sidak(0.01, 1) - 0.01).abs() < 1e-15);
/// assert!((1.0 - (1.0 - sidak(0.01, 70)).powi(70) - 0.01).abs() < 1e-12);
/// ```
#[must_use]
pub fn sidak(significance: f64, tests: usize) -> f64 {
    // In terms of logarithms: the power of a number close to 1 would lose its digits.
    -((-significance).ln_1p() / tests.max(1) as f64).exp_m1()
}

/// A cell, or the four it was split into.
enum Bin {
    Whole(usize),
    Split([f64; 2], Box<[Bin; 4]>),
}

/// The cells with the probability of each.
struct Bins {
    coarse: Vec<Bin>,
    cells: Vec<Cell>,
    probability: Vec<f64>,
}

impl Bins {
    fn new(test: &ChiSquare, pdf: &impl Fn([f64; 3]) -> f64) -> Self {
        let mut bins = Self { coarse: Vec::new(), cells: Vec::new(), probability: Vec::new() };
        let quadrature = &test.quadrature;
        let f = |d| [pdf(d)];
        for cell in Cell::SPHERE.divided(quadrature.rows, quadrature.columns) {
            let bin = bins.split(test, &f, &cell, quadrature.depth);
            bins.coarse.push(bin);
        }
        bins
    }

    fn split(&mut self, test: &ChiSquare, f: &impl Fn([f64; 3]) -> [f64; 1], cell: &Cell, depth: u32) -> Bin {
        // One application of the rule tells whether to split; only what stays whole is worth an exact integral.
        let [about] = Quadrature { depth: 0, ..test.quadrature }.cell(f, cell, 1.0);
        if depth == 0 || about.is_nan() || about <= test.finest {
            self.probability.push(test.quadrature.cell(f, cell, 1.0)[0]);
            self.cells.push(*cell);
            return Bin::Whole(self.cells.len() - 1);
        }
        let parts = cell.quarters().map(|quarter| self.split(test, f, &quarter, depth - 1));
        Bin::Split(cell.middle(), Box::new(parts))
    }

    fn find(&self, quadrature: &Quadrature, direction: [f64; 3]) -> usize {
        let angles = Cell::angles(direction);
        let place = |i: usize, n: usize| {
            let whole = if i == 0 { Cell::SPHERE.theta[1] } else { Cell::SPHERE.phi[1] };
            ((angles[i] / whole * n as f64) as usize).min(n - 1)
        };
        let row = place(0, quadrature.rows);
        let mut bin = &self.coarse[row * quadrature.columns + place(1, quadrature.columns)];
        loop {
            match bin {
                Bin::Whole(cell) => return *cell,
                Bin::Split(middle, parts) => {
                    let part = 2 * usize::from(angles[0] >= middle[0]) + usize::from(angles[1] >= middle[1]);
                    bin = &parts[part];
                }
            }
        }
    }
}

impl ChiSquare {
    /// Tests a pair of closures: `sample` draws a direction from D numbers in [0, 1) (`None`: this draw has none),
    /// `pdf` is the density of the directions, 1/sr, over the whole sphere.
    pub fn run<const D: usize>(
        &self,
        mut sample: impl FnMut([f64; D]) -> Option<[f64; 3]>,
        pdf: impl Fn([f64; 3]) -> f64,
    ) -> Outcome {
        let mut random = Random::new(self.seed);
        self.test(|| sample(random.units()), pdf)
    }

    /// Tests the continuous part of an illumination model as it is seen from one direction. Discrete lobes are
    /// left out, and so are directions that disperse, which belong to one lane and which `pdf` does not cover.
    pub fn run_model<const N: usize>(
        &self,
        model: &impl IlluminationModel<N>,
        site: &Site<N>,
        to_viewer: [f64; 3],
    ) -> Outcome {
        let at = site.incidence(to_viewer);
        let mut random = Random::new(self.seed);
        let hero = site.hero_lane.or(Some(0));
        let sample = || {
            let drawn = model.sample(&at, random.singles(), hero)?;
            (drawn.pdf.is_some() && !drawn.disperses).then(|| double(drawn.direction))
        };
        self.test(sample, |direction| f64::from(model.pdf(&at, single(direction))))
    }

    fn test(&self, mut draw: impl FnMut() -> Option<[f64; 3]>, pdf: impl Fn([f64; 3]) -> f64) -> Outcome {
        let mut bins = Bins::new(self, &pdf);
        let mut observed = vec![0u64; bins.probability.len()];
        let (mut directions, mut stray, mut invalid) = (0, 0, 0u64);
        for direction in (0..self.samples).filter_map(|_| draw()) {
            directions += 1;
            let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
            if (length - 1.0).abs() >= 1e-4 || length.is_nan() {
                invalid += 1;
                continue;
            }
            let cell = bins.find(&self.quadrature, direction);
            observed[cell] += 1;
            if bins.probability[cell] > 0.0 {
                continue;
            }
            // Either the rim of the support cuts a corner that quadrature has missed, or the draw is wrong.
            if pdf(direction) > 0.0 {
                bins.probability[cell] = self.quadrature.searched(&|d| [pdf(d)], &bins.cells[cell])[0];
            } else {
                stray += 1;
            }
        }
        let n = self.samples as f64;
        let probability: f64 = bins.probability.iter().sum();
        let counts = bins.probability.iter().zip(&observed);
        let mut cells: Vec<(f64, f64)> = counts.map(|(p, count)| (p * n, *count as f64)).collect();
        cells.push(((1.0 - probability).max(0.0) * n, (self.samples - directions) as f64));
        let (statistic, degrees_of_freedom) = pearson(cells, self.least_expected);
        let broken = invalid > 0 || stray as f64 > STRAY * n || !statistic.is_finite();
        let p_value = if broken { 0.0 } else { survival(statistic, degrees_of_freedom) };
        Outcome { statistic, degrees_of_freedom, p_value, probability, directions, stray, invalid }
    }
}

/// X² of pairs (expected, observed) and its degrees of freedom. Cells are pooled, smallest first, until each
/// pool expects at least `least`.
///
/// ```
/// # use illuminant_verify::chi_square::pearson;
/// // A die thrown 60 times.
/// let thrown = [12.0, 8.0, 11.0, 9.0, 13.0, 7.0].map(|count| (10.0, count)).to_vec();
/// let (statistic, freedom) = pearson(thrown, 5.0);
/// assert!((statistic - 2.8).abs() < 1e-12 && freedom == 5);
/// ```
#[must_use]
pub fn pearson(mut cells: Vec<(f64, f64)>, least: f64) -> (f64, usize) {
    cells.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut pools: Vec<(f64, f64)> = Vec::new();
    for (expected, observed) in cells {
        match pools.last_mut() {
            Some(pool) if pool.0 < least => *pool = (pool.0 + expected, pool.1 + observed),
            _ => pools.push((expected, observed)),
        }
    }
    // Every pool but the last has enough; what is left over joins the one before.
    if pools.len() > 1 && pools[pools.len() - 1].0 < least {
        let (expected, observed) = pools.pop().unwrap_or_default();
        if let Some(pool) = pools.last_mut() {
            *pool = (pool.0 + expected, pool.1 + observed);
        }
    }
    let statistic =
        pools.iter().filter(|(e, o)| *e != 0.0 || *o != 0.0).map(|(e, o)| (o - e).powi(2) / e).sum();
    (statistic, pools.len().saturating_sub(1))
}

/// The chance that chi-square with these degrees of freedom is at least `statistic`; 1 without any freedom.
///
/// ```
/// # use illuminant_verify::chi_square::survival;
/// assert!((survival(3.841_459, 1) - 0.05).abs() < 1e-6);
/// assert!((survival(124.342_113, 100) - 0.05).abs() < 1e-6);
/// ```
#[must_use]
pub fn survival(statistic: f64, degrees_of_freedom: usize) -> f64 {
    if degrees_of_freedom == 0 {
        return 1.0;
    }
    ChiSquared::new(degrees_of_freedom as f64).map_or(0.0, |law| law.sf(statistic))
}

#[cfg(test)]
mod tests {
    use super::*;
    use illuminant_optics::hemisphere::{cosine, sphere};
    use std::f64::consts::{FRAC_1_PI, TAU};

    fn lambert(d: [f64; 3]) -> f64 {
        d[2].max(0.0) * FRAC_1_PI
    }

    #[test]
    fn the_p_value_is_even_under_the_hypothesis() {
        // 200 seeds: the p-values themselves are tested for being spread evenly over ten classes.
        let mut classes = [0.0; 10];
        for seed in 0..200 {
            let test = ChiSquare { samples: 5_000, seed, finest: 0.02, ..ChiSquare::default() };
            let outcome = test.run(|u| Some(cosine(u)), lambert);
            classes[((outcome.p_value * 10.0) as usize).min(9)] += 1.0;
        }
        let (statistic, freedom) = pearson(classes.map(|count| (20.0, count)).to_vec(), 5.0);
        assert!(survival(statistic, freedom) > 0.001, "{classes:?}");
    }

    #[test]
    fn mistakes_are_seen() {
        let test = ChiSquare::default();
        let wrong = [
            // Up to 10 % too much near the pole, 20 % too little at the horizon.
            test.run(
                |u: [f64; 2]| Some(cosine([u[0], u[1]])),
                |d| lambert(d) * (1.0 + 0.3 * (d[2] - 2.0 / 3.0)),
            ),
            // A tenth of the draws is lost, which the density does not say.
            test.run(|u: [f64; 3]| (u[2] > 0.1).then(|| cosine([u[0], u[1]])), lambert),
            // Directions where there is no density, and one that is none.
            test.run(|u| Some(sphere(u)), |d| if d[2] > 0.0 { 1.0 / TAU } else { 0.0 }),
            test.run(|u: [f64; 2]| Some(if u[0] < 1e-3 { [f64::NAN; 3] } else { cosine(u) }), lambert),
            test.run(|u| Some(cosine(u)), |_| f64::NAN),
            test.run(|u| Some(cosine(u)), |_| 0.0),
        ];
        for (i, outcome) in wrong.iter().enumerate() {
            assert!(!outcome.passes(1e-6), "{i}: {outcome:?}");
        }
    }

    #[test]
    fn a_share_without_direction_is_a_cell() {
        let test = ChiSquare::default();
        let outcome =
            test.run(|u: [f64; 3]| (u[2] < 0.3).then(|| cosine([u[0], u[1]])), |d| 0.3 * lambert(d));
        assert!(outcome.passes(0.001) && (outcome.probability - 0.3).abs() < 1e-4, "{outcome:?}");
        let nothing = test.run(|_: [f64; 2]| None, |_| 0.0);
        assert!(nothing.passes(0.5) && nothing.directions == 0);
    }

    #[test]
    fn few_expected_are_pooled() {
        let (_, freedom) = pearson(vec![(1.0, 0.0), (2.0, 3.0), (3.0, 2.0), (50.0, 51.0), (0.0, 0.0)], 5.0);
        assert_eq!(freedom, 1);
        assert_eq!(pearson(vec![(0.0, 0.0), (2.0, 2.0)], 5.0), (0.0, 0));
    }
}
