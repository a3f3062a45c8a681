//! Helmholtz reciprocity: the same when viewer and light change places.
//!
//! f(v, l) / n_v² = f(l, v) / n_l², with the index n of the medium on the side of each direction (Veach 1997,
//! section 5.2, for radiance, which is squeezed by n² at refraction); on one side this is f(v, l) = f(l, v).
//! Only the continuous part is looked at.
//!
//! Models in f32 have rounding noise that grows towards grazing angles, where f is steep; [`Reciprocity::grazing`]
//! leaves the last directions out, and differences are taken relative to the larger of the two values or to
//! [`Reciprocity::floor`], so that two values that are both practically nothing do not decide.

use crate::random::Random;
use crate::site::Site;
use illuminant_illumination::IlluminationModel;

/// How to test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reciprocity {
    /// How many pairs of directions to draw, evenly over the sphere.
    pub pairs: u64,
    /// Key of the random numbers.
    pub seed: u64,
    /// The least |cos θ| of a direction.
    pub grazing: f64,
    /// The value of f / n², 1/sr, relative to which smaller ones are compared.
    pub floor: f64,
}

impl Default for Reciprocity {
    /// 10,000 pairs with |cos θ| ≥ 0.01, floor 10⁻³ / sr.
    fn default() -> Self {
        Self { pairs: 10_000, seed: 0, grazing: 0.01, floor: 1e-3 }
    }
}

/// The pair of directions that differ most, and how much pairs differ on average.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Violation {
    /// |a − b| / max(a, b, floor) with a = f(v, l)/n_v², b = f(l, v)/n_l²; infinite when one is no number.
    pub relative: f64,
    /// The same, averaged over all pairs and lanes.
    pub mean: f64,
    /// The first direction.
    pub v: [f64; 3],
    /// The second.
    pub l: [f64; 3],
    /// a and b.
    pub values: [f64; 2],
}

impl Reciprocity {
    /// The largest violation of a function of two directions that gives f / n² in K lanes.
    ///
    /// ```
    /// use illuminant_verify::reciprocity::Reciprocity;
    /// let test = Reciprocity::default();
    /// assert_eq!(test.largest(|_, _| [0.3]).relative, 0.0);
    /// // Phong's lobe over the cosine of the light was never reciprocal.
    /// let phong = |v: [f64; 3], l: [f64; 3]| {
    ///     let cos = v[2] * l[2] - v[0] * l[0] - v[1] * l[1];
    ///     [cos.max(0.0).powi(5) / l[2].abs()]
    /// };
    /// assert!(test.largest(phong).relative > 0.5);
    /// ```
    pub fn largest<const K: usize>(&self, f: impl Fn([f64; 3], [f64; 3]) -> [f64; K]) -> Violation {
        let mut random = Random::new(self.seed);
        let mut worst = Violation::default();
        let mut sum = 0.0;
        for _ in 0..self.pairs {
            let [v, l] = std::array::from_fn(|_| {
                loop {
                    let direction = random.direction();
                    if direction[2].abs() >= self.grazing {
                        return direction;
                    }
                }
            });
            for (a, b) in f(v, l).into_iter().zip(f(l, v)) {
                let difference = (a - b).abs() / a.max(b).max(self.floor);
                let relative = if difference.is_finite() { difference } else { f64::INFINITY };
                sum += relative;
                if relative > worst.relative {
                    worst = Violation { relative, mean: 0.0, v, l, values: [a, b] };
                }
            }
        }
        worst.mean = sum / (self.pairs * K as u64).max(1) as f64;
        worst
    }

    /// The largest violation of an illumination model between two media, looked at from both sides.
    pub fn largest_of_model<const N: usize>(
        &self,
        model: &impl IlluminationModel<N>,
        site: &Site<N>,
    ) -> Violation {
        self.largest(|v, l| {
            let (f, n) = (site.eval(model, v, l), site.side(v).lanes);
            let mut scaled = [0.0; N];
            for lane in site.lanes() {
                scaled[lane] = f[lane] / f64::from(n[lane]).powi(2);
            }
            scaled
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_number_is_the_worst() {
        let test = Reciprocity { pairs: 10, ..Reciprocity::default() };
        assert_eq!(test.largest(|_, _| [f64::NAN]).relative, f64::INFINITY);
    }

    #[test]
    fn the_grazing_directions_are_left_out() {
        let test = Reciprocity { grazing: 0.2, ..Reciprocity::default() };
        let steep = |v: [f64; 3], _| [if v[2].abs() < 0.2 { 1.0 } else { 0.0 }];
        assert_eq!(test.largest(steep).relative, 0.0);
    }
}
