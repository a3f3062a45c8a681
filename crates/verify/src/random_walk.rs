//! A random walk on a microsurface: what light does that meets facet after facet, without any table.
//!
//! The walk of Heitz, Hanika, d'Eon and Dachsbacher 2016 ("Multiple-scattering microfacet BSDFs with the Smith
//! model"): heights and slopes are independent, so a ray at a height below which the fraction x of the facets lies meets the next one
//! at x' with (x'/x)^(1+Λ) on the way down, and reaches x' without meeting any with (x/x')^Λ on the way up. Facets
//! are drawn with the density of visible normals by rejection, and reflect or refract; a refracted ray goes on below the surface with
//! 1 − x for x.
//!
//! It shares no code with `illuminant_optics::facets` and what is built on it, and is their oracle.
//!
//! ```
//! use illuminant_verify::random::Random;
//! use illuminant_verify::random_walk::{RandomWalk, Slopes};
//! let walk = RandomWalk { slopes: Slopes::Gaussian, m: [0.5, 0.5] };
//! let mut random = Random::new(0);
//! // Facets that reflect everything lose nothing: every walk ends above the surface.
//! let path = walk.reflect([0.6, 0.0, 0.8], &mut random, |_| [1.0]).unwrap();
//! assert!(path.direction[2] > 0.0 && path.weight == [1.0] && path.orders >= 1);
//! ```

use crate::random::Random;
use illuminant_optics::fresnel::dielectric;
use statrs::function::erf::erf;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The distribution of slopes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slopes {
    /// exp(−s²) (Beckmann).
    Gaussian,
    /// (1 + s²)⁻² (Trowbridge–Reitz, GGX).
    StudentT,
}

/// A microsurface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RandomWalk {
    /// How slopes are distributed.
    pub slopes: Slopes,
    /// Their parameters along x and y.
    pub m: [f64; 2],
}

/// How a walk ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path<const K: usize> {
    /// Where the light went, local, unit.
    pub direction: [f64; 3],
    /// How many facets it met.
    pub orders: usize,
    /// The product of what they reflected.
    pub weight: [f64; K],
}

/// A walk that met more facets than this is given up; none is at slopes up to 1.
const LONGEST: usize = 1000;

impl RandomWalk {
    /// Λ of a direction above the surface, in closed form.
    #[must_use]
    pub fn lambda(&self, v: [f64; 3]) -> f64 {
        let a = v[2] / (v[0] * self.m[0]).hypot(v[1] * self.m[1]);
        match self.slopes {
            Slopes::Gaussian if a < 10.0 => 0.5 * ((-a * a).exp() / (a * PI.sqrt()) - (1.0 - erf(a))),
            Slopes::StudentT if a < 1e8 => 0.5 * ((1.0 + (a * a).recip()).sqrt() - 1.0),
            _ => 0.0,
        }
    }

    /// Follows light that comes from a direction above over facets whose reflectance in K lanes `fresnel` gives for the
    /// cosine of the angle of incidence.
    #[must_use]
    pub fn reflect<const K: usize>(
        &self,
        from: [f64; 3],
        random: &mut Random,
        fresnel: impl Fn(f64) -> [f64; K],
    ) -> Option<Path<K>> {
        let mut path = Path { direction: from.map(|c| -c), orders: 0, weight: [1.0; K] };
        let mut x = 1.0;
        while path.orders < LONGEST {
            x = self.next(path.direction, x, random);
            if x >= 1.0 {
                return Some(path);
            }
            let v = path.direction.map(|c| -c);
            let (h, cos) = self.visible(v, random)?;
            path.direction = [0, 1, 2].map(|i| 2.0 * cos * h[i] - v[i]);
            path.orders += 1;
            for (weight, f) in path.weight.iter_mut().zip(fresnel(cos)) {
                *weight *= f;
            }
        }
        None
    }

    /// Follows light that comes from a direction, above or below, over facets between two dielectrics; `eta` is the index below
    /// relative to that above.
    #[must_use]
    pub fn refract(&self, from: [f64; 3], eta: f64, random: &mut Random) -> Option<Path<0>> {
        // Below, all is turned upside down.
        let mut above = from[2] > 0.0;
        let turn = |v: [f64; 3], above: bool| if above { v } else { [v[0], v[1], -v[2]] };
        let mut direction = turn(from, above).map(|c| -c);
        let mut x = 1.0;
        for orders in 0..LONGEST {
            x = self.next(direction, x, random);
            if x >= 1.0 {
                return Some(Path { direction: turn(direction, above), orders, weight: [] });
            }
            let v = direction.map(|c| -c);
            let (h, cos) = self.visible(v, random)?;
            let eta = if above { eta } else { eta.recip() };
            if random.unit() < dielectric(cos, eta) {
                direction = [0, 1, 2].map(|i| 2.0 * cos * h[i] - v[i]);
            } else {
                let below = (1.0 - (1.0 - cos * cos) / (eta * eta)).max(0.0).sqrt();
                let t = [0, 1, 2].map(|i| (cos / eta - below) * h[i] - v[i] / eta);
                direction = [t[0], t[1], -t[2]];
                above = !above;
                x = 1.0 - x;
            }
        }
        None
    }

    /// The fraction of facets that lie lower than the next one on the way; 1 or more when there is none.
    fn next(&self, direction: [f64; 3], x: f64, random: &mut Random) -> f64 {
        let u = random.unit().max(1e-300);
        let lambda = self.lambda([direction[0], direction[1], direction[2].abs().max(1e-12)]);
        if direction[2] < 0.0 {
            x * u.powf((1.0 + lambda).recip())
        } else if lambda > 0.0 {
            x * u.powf(-lambda.recip())
        } else {
            1.0
        }
    }

    /// A facet normal that is seen from a direction (from below too), and the cosine between both.
    fn visible(&self, v: [f64; 3], random: &mut Random) -> Option<([f64; 3], f64)> {
        let stretched = [v[0] * self.m[0], v[1] * self.m[1]];
        let side = stretched[0].hypot(stretched[1]);
        let (cos_phi, sin_phi) =
            if side > 0.0 { (stretched[0] / side, stretched[1] / side) } else { (1.0, 0.0) };
        let top = v[2].max(0.0);
        for _ in 0..1_000_000 {
            // Of max(0, side s + v_z) p(s), below side |s| p(s) + max(0, v_z) p(s).
            let (tilted, flat) = match self.slopes {
                Slopes::Gaussian => (side, top * PI.sqrt()),
                Slopes::StudentT => (2.0 * side, 2.0 * top),
            };
            let sign = if random.unit() < 0.5 { -1.0 } else { 1.0 };
            let u = random.unit();
            let s = if random.unit() * (tilted + flat) < tilted {
                sign * match self.slopes {
                    Slopes::Gaussian => (-(1.0 - u).ln()).sqrt(),
                    Slopes::StudentT => ((1.0 - u).powi(-2) - 1.0).max(0.0).sqrt(),
                }
            } else {
                match self.slopes {
                    Slopes::Gaussian => normal(random),
                    Slopes::StudentT => {
                        let t = sign * u;
                        t / (1.0 - t * t).sqrt()
                    }
                }
            };
            let seen = (side * s + v[2]).max(0.0);
            if random.unit() * (side * s.abs() + top) >= seen {
                continue;
            }
            let t = match self.slopes {
                Slopes::Gaussian => normal(random),
                Slopes::StudentT => loop {
                    let angle = (random.unit() - 0.5) * PI;
                    if random.unit() < angle.cos().powi(2) && angle.abs() < FRAC_PI_2 {
                        break (1.0 + s * s).sqrt() * angle.tan();
                    }
                },
            };
            let h = [self.m[0] * (s * cos_phi - t * sin_phi), self.m[1] * (s * sin_phi + t * cos_phi), 1.0];
            let length = (h[0] * h[0] + h[1] * h[1] + 1.0).sqrt();
            let h = h.map(|c| c / length);
            let cos = v[0] * h[0] + v[1] * h[1] + v[2] * h[2];
            return Some((h, cos.clamp(0.0, 1.0)));
        }
        None
    }
}

/// A number with the density exp(−s²)/√π.
fn normal(random: &mut Random) -> f64 {
    let r = (-(1.0 - random.unit()).ln()).sqrt();
    r * (TAU * random.unit()).cos()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_lost_and_first_reflections_are_those_of_smith() {
        for (slopes, m) in
            [(Slopes::Gaussian, [0.6, 0.6]), (Slopes::StudentT, [0.5, 0.5]), (Slopes::Gaussian, [0.2, 0.7])]
        {
            let walk = RandomWalk { slopes, m };
            let mut random = Random::new(1);
            let v = [0.48f64, 0.64, 0.6];
            let n = 50_000;
            let (mut once, mut smith) = (0.0, 0.0);
            for _ in 0..n {
                let path = walk.reflect(v, &mut random, |_| [1.0]).unwrap();
                if path.orders == 1 {
                    once += 1.0;
                }
                // The closed form: the mean of G₂/G₁ over visible normals.
                let (h, cos) = walk.visible(v, &mut random).unwrap();
                let l = [0, 1, 2].map(|i| 2.0 * cos * h[i] - v[i]);
                if l[2] > 0.0 {
                    smith += (1.0 + walk.lambda(v)) / (1.0 + walk.lambda(v) + walk.lambda(l));
                }
            }
            assert!((once - smith).abs() / f64::from(n) < 0.01, "{walk:?}: {once} {smith}");
        }
    }

    #[test]
    fn as_much_light_goes_through_either_way() {
        // Étendue: light that is the same from everywhere carries n² more inside, and what goes in comes out.
        let walk = RandomWalk { slopes: Slopes::Gaussian, m: [0.7, 0.7] };
        let mut random = Random::new(2);
        let n = 60_000;
        let mut through = [0.0; 2];
        for (side, sign) in [(0, 1.0), (1, -1.0)] {
            for _ in 0..n {
                let z = random.unit().sqrt().max(1e-3);
                let azimuth = TAU * random.unit();
                let r = (1.0 - z * z).sqrt();
                let from = [r * azimuth.cos(), r * azimuth.sin(), sign * z];
                if walk.refract(from, 1.5, &mut random).unwrap().direction[2] * sign < 0.0 {
                    through[side] += 1.0 / f64::from(n);
                }
            }
        }
        assert!((through[0] - 1.5f64.powi(2) * through[1]).abs() < 0.01, "{through:?}");
    }
}
