//! `hall:N`: box sampling and box reconstruction (Hall 1983; book 3.5.2 and III.8).

use crate::{Basis, Products, Role, ToXyz, xyz_by};
use illuminant_color::{Lightness, LuvWhite};
use illuminant_spectrum::{Curve, LUMINOUS_EFFICACY, Observer, SpectralRange};

/// N abutting boxes. A curve is its mean over each box (a sampling function of area 1); the reconstructed curve has
/// that value throughout the box (a function of height 1), and the first and the last box reach to the ends of the
/// range. Flat curves are exact.
///
/// ```
/// use illuminant_sampling::{Basis, Hall, Role};
/// use illuminant_spectrum::{Curve, SpectralRange};
/// let boxes = Hall::new(vec![411.0, 491.0, 571.0, 651.0], SpectralRange::default());
/// assert_eq!(boxes.reduce(&Curve::constant(0.5), Role::Fraction), [0.5; 3]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Hall {
    range: SpectralRange,
    bounds_nm: Vec<f64>,
}

impl Hall {
    /// Boxes between increasing bounds, one more than boxes: the lower bound of a box belongs to it, the upper does not.
    #[must_use]
    pub fn new(bounds_nm: Vec<f64>, range: SpectralRange) -> Self {
        Self { range, bounds_nm }
    }

    /// N boxes of one width over the range.
    #[must_use]
    pub fn even(n: usize, range: SpectralRange) -> Self {
        let first = f64::from(range.min_nm);
        let bounds = (0..=n).map(|i| (first + range.width_nm() * i as f64 / n as f64).round()).collect();
        Self::new(bounds, range)
    }

    /// The search of the book (3.5.2, footnote 6): from boxes of one width, the bounds are shifted as long as that makes
    /// the mean error in L\*u\*v\* over the products smaller, by ever shorter steps.
    #[must_use]
    pub fn local_search(n: usize, range: SpectralRange, products: &Products) -> Self {
        Self::even(n, range).descend(&Judge::new(products)).0
    }

    /// A better search: the same descent from several starts, which are the boxes of one width, boxes that hold equal
    /// shares of the sensitivity of the eye, and mixtures of the two; of all ends the best.
    #[must_use]
    pub fn global_search(n: usize, range: SpectralRange, products: &Products) -> Self {
        let even = Self::even(n, range);
        let observer = Observer::cie_1931_2deg();
        let seen = |w: f64| observer.matching.iter().map(|m| m.at(w)).sum::<f64>();
        let total: f64 = range.wavelengths().map(seen).sum();
        let mut sum = 0.0;
        let mut shares = vec![even.bounds_nm[0]];
        for w in range.wavelengths() {
            sum += seen(w);
            while shares.len() < n && sum >= total * shares.len() as f64 / n as f64 {
                shares.push(w);
            }
        }
        shares.resize(n, f64::from(range.max_nm));
        shares.push(even.bounds_nm[n]);
        let start = |mix: f64| {
            let bounds = even.bounds_nm.iter().zip(&shares).map(|(e, s)| (e + mix * (s - e)).round());
            Self::new(bounds.collect(), range)
        };
        let judge = Judge::new(products);
        let ends = [0.0, 0.35, 0.7, 1.0].map(|mix| start(mix).descend(&judge));
        let best = ends.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
        best.map_or(even, |(boxes, _)| boxes)
    }

    /// Shifts bounds while that lowers the error; the boxes and their error.
    fn descend(mut self, judge: &Judge<'_>) -> (Self, f64) {
        let mut best = judge.error(&self);
        for step in [16.0, 8.0, 4.0, 2.0, 1.0] {
            loop {
                let before = best;
                for bound in 1..self.bounds_nm.len() - 1 {
                    for shift in [-step, step] {
                        let mut trial = self.clone();
                        trial.bounds_nm[bound] += shift;
                        if trial.bounds_nm[bound] <= trial.bounds_nm[bound - 1]
                            || trial.bounds_nm[bound] >= trial.bounds_nm[bound + 1]
                        {
                            continue;
                        }
                        let error = judge.error(&trial);
                        if error < best {
                            (best, self) = (error, trial);
                        }
                    }
                }
                // Written so that an error that is no number ends the search too.
                if !(best < before) {
                    break;
                }
            }
        }
        (self, best)
    }

    /// The box into which a wavelength falls when curves are built again: the first and last reach outward.
    fn box_of(&self, wavelength_nm: f64) -> usize {
        let inner = &self.bounds_nm[1..self.len()];
        inner.partition_point(|&bound| bound <= wavelength_nm)
    }

    /// The curve that samples stand for, at each nm of the range (book CLR_reconstruct).
    #[must_use]
    pub fn reconstruct(&self, samples: &[f64]) -> Vec<f64> {
        self.range.wavelengths().map(|w| samples[self.box_of(w)]).collect()
    }

    /// The map to absolute XYZ of any observer: what a curve of 1 in one box is worth (book CLR_get_sample_xyz, which
    /// divides by the sum of ȳ).
    #[must_use]
    pub fn map(&self, observer: &Observer) -> ToXyz {
        let mut map: ToXyz = std::array::from_fn(|_| vec![0.0; self.len()]);
        for w in self.range.wavelengths() {
            for (row, matching) in map.iter_mut().zip(&observer.matching) {
                row[self.box_of(w)] += LUMINOUS_EFFICACY * matching.at(w);
            }
        }
        map
    }
}

impl Basis for Hall {
    fn len(&self) -> usize {
        self.bounds_nm.len() - 1
    }

    fn wavelength_nm(&self, sample: usize) -> f64 {
        f64::midpoint(self.bounds_nm[sample], self.bounds_nm[sample + 1] - 1.0)
    }

    fn reduce(&self, curve: &Curve, _role: Role) -> Vec<f64> {
        let mut sums = vec![(0.0, 0u32); self.len()];
        for w in self.range.wavelengths() {
            let i = self.bounds_nm.partition_point(|&bound| bound <= w);
            if i >= 1 && i <= self.len() {
                sums[i - 1].0 += curve.at(w);
                sums[i - 1].1 += 1;
            }
        }
        sums.iter().map(|&(sum, count)| if count == 0 { 0.0 } else { sum / f64::from(count) }).collect()
    }

    fn to_xyz(&self, _lamp: usize) -> ToXyz {
        self.map(Observer::cie_1931_2deg())
    }
}

/// The error of boxes on products of one and two reflections.
struct Judge<'a> {
    products: &'a Products,
    /// CIE L\*u\*v\* of each product, and what turns XYZ into it.
    exact: Vec<([f64; 3], LuvWhite)>,
    chosen: Vec<(usize, Vec<usize>)>,
}

impl<'a> Judge<'a> {
    fn new(products: &'a Products) -> Self {
        let mut chosen = Vec::new();
        let mut exact = Vec::new();
        let weights: Vec<ToXyz> = (0..products.lamps.len()).map(|l| products.weights_of_lamp(l)).collect();
        for item in &products.items {
            let ([part], Some(factors)) = (item.parts.as_slice(), &item.factors) else { continue };
            if factors.len() > 2 {
                continue;
            }
            let xyz = xyz_by(&weights[part.lamp], &part.filter);
            let white = LuvWhite::new(item.white);
            exact.push((white.luv(xyz, Lightness::Cie), white));
            chosen.push((part.lamp, factors.clone()));
        }
        Self { products, exact, chosen }
    }

    fn error(&self, boxes: &Hall) -> f64 {
        let map = boxes.to_xyz(0);
        let lamps: Vec<_> = self.products.lamps.iter().map(|l| boxes.reduce(l, Role::Emission)).collect();
        let fractions: Vec<_> =
            self.products.reflectances.iter().map(|r| boxes.reduce(r, Role::Fraction)).collect();
        let total: f64 = self
            .chosen
            .iter()
            .zip(&self.exact)
            .map(|((lamp, materials), (exact, white))| {
                let value = |i: usize| materials.iter().fold(lamps[*lamp][i], |v, &m| v * fractions[m][i]);
                let samples: Vec<f64> = (0..boxes.len()).map(value).collect();
                let found: [f64; 3] = white.luv(xyz_by(&map, &samples), Lightness::Cie);
                exact.iter().zip(found).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
            })
            .sum();
        total / self.chosen.len().max(1) as f64
    }
}
