//! A participating medium: air that absorbs and scatters (Blinn 1982, Max 1986, Rushmeier and Torrance 1987; book 2.1.3).

use crate::density::{Column, Density};
use glam::Vec3;
use illuminant_spectrum::Curve;
use std::f32::consts::{PI, TAU};

/// How scattered light is spread over the angle from its direction of travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Phase {
    /// (1 − g²)/(4π (1 + g² − 2 g cos θ)^(3/2)) (Henyey and Greenberg 1941): g is the mean cosine, −1 to 1.
    HenyeyGreenberg(f32),
    /// 3/(16π) (1 + cos² θ) (Rayleigh 1871): particles much smaller than a wavelength.
    Rayleigh,
}

impl Phase {
    /// Its value, 1/sr, which is its density too.
    ///
    /// ```
    /// use illuminant_scene::Phase;
    /// let even = Phase::HenyeyGreenberg(0.0).value(0.3);
    /// assert!((even - 1.0 / (4.0 * std::f32::consts::PI)).abs() < 1e-6);
    /// ```
    #[must_use]
    pub fn value(self, cos: f32) -> f32 {
        match self {
            Self::HenyeyGreenberg(g) => {
                let square = (1.0 + g * g - 2.0 * g * cos).max(1e-8);
                (1.0 - g * g) / (4.0 * PI * square * square.sqrt())
            }
            Self::Rayleigh => 3.0 / (16.0 * PI) * (1.0 + cos * cos),
        }
    }

    /// A direction for light that travels along a unit vector, from two numbers in [0, 1), drawn by its value.
    #[must_use]
    pub fn sample(self, along: Vec3, u: [f32; 2]) -> Vec3 {
        let cos = match self {
            Self::HenyeyGreenberg(g) if g.abs() < 1e-3 => 1.0 - 2.0 * u[0],
            Self::HenyeyGreenberg(g) => {
                let s = (1.0 - g * g) / (1.0 - g + 2.0 * g * u[0]);
                (1.0 + g * g - s * s) / (2.0 * g)
            }
            Self::Rayleigh => {
                // The root of cos³ + 3 cos = 4 (2u − 1).
                let z = 2.0 * (2.0 * u[0] - 1.0);
                let a = (z + (z * z + 1.0).sqrt()).cbrt();
                a - a.recip()
            }
        }
        .clamp(-1.0, 1.0);
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let (s, c) = (TAU * u[1]).sin_cos();
        let (x, y) = along.any_orthonormal_pair();
        (x * (sin * c) + y * (sin * s) + along * cos).normalize()
    }
}

/// A participating medium, in a box or everywhere; bodies of glass keep it out.
#[derive(Clone, Debug)]
pub struct Medium {
    /// Absorption coefficient, 1/m.
    pub absorption: Curve,
    /// Scattering coefficient, 1/m.
    pub scattering: Curve,
    /// How scattered light is spread.
    pub phase: Phase,
    /// Two corners of the box; none for everywhere.
    pub bounds: Option<[Vec3; 2]>,
    /// What both coefficients are multiplied by over the box, if they vary.
    pub density: Option<Density>,
}

impl Medium {
    /// The distances between which a ray of this length is in the medium, if it is.
    #[must_use]
    pub fn within(&self, origin: Vec3, direction: Vec3, length: f32) -> Option<[f32; 2]> {
        let Some([low, high]) = self.bounds else { return Some([0.0, length]) };
        let inverse = direction.recip();
        let (a, b) = ((low - origin) * inverse, (high - origin) * inverse);
        // A ray along a face has no place on its line to divide by: `min` and `max` pass over what is no number.
        let near = a.min(b).max_element().max(0.0);
        let far = a.max(b).min_element().min(length);
        (near < far).then_some([near, far])
    }

    /// The density at a place, relative to the coefficients.
    #[must_use]
    pub fn density_at(&self, position: Vec3) -> f32 {
        match (&self.density, self.bounds) {
            (Some(density), Some([low, high])) => density.at((position - low) / (high - low)),
            _ => 1.0,
        }
    }

    /// The density that a ray passes between two distances within the medium, or until that is `enough`.
    #[must_use]
    pub fn column(&self, origin: Vec3, direction: Vec3, [near, far]: [f32; 2], enough: f32) -> Column {
        if let (Some(density), Some([low, high])) = (&self.density, self.bounds) {
            let size = high - low;
            return density.column((origin - low) / size, direction / size, [near, far], enough);
        }
        let length = far - near;
        if enough < length {
            Column { amount: enough, reached: Some(near + enough) }
        } else {
            Column { amount: length, reached: None }
        }
    }

    /// How many steps [`Self::column`] takes at most along a way within the medium.
    #[must_use]
    pub fn steps(&self, way: Vec3) -> f32 {
        match (&self.density, self.bounds) {
            (Some(density), Some([low, high])) => 1.0 + density.crossings(way / (high - low)),
            _ => 1.0,
        }
    }

    /// The largest density.
    #[must_use]
    pub fn densest(&self) -> f32 {
        self.density.as_ref().map_or(1.0, Density::most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_integrate_to_one_and_are_drawn_as_they_are() {
        for phase in [
            Phase::HenyeyGreenberg(0.0),
            Phase::HenyeyGreenberg(0.7),
            Phase::HenyeyGreenberg(-0.4),
            Phase::Rayleigh,
        ] {
            let n = 20_000;
            let (mut integral, mut mean, mut square) = (0.0f64, 0.0f64, 0.0f64);
            for i in 0..n {
                let cos = 2.0 * (i as f64 + 0.5) / f64::from(n) - 1.0;
                let weight = f64::from(phase.value(cos as f32)) * std::f64::consts::TAU * 2.0 / f64::from(n);
                integral += weight;
                mean += weight * cos;
                square += weight * cos * cos;
            }
            assert!((integral - 1.0).abs() < 1e-3, "{phase:?} {integral}");
            let along = Vec3::new(0.6, 0.0, 0.8);
            let (mut drawn, mut drawn_square) = (0.0f64, 0.0f64);
            for i in 0..n {
                let direction = phase.sample(along, [(i as f32 + 0.5) / n as f32, 0.37]);
                assert!((direction.length() - 1.0).abs() < 1e-5);
                let cos = f64::from(direction.dot(along));
                drawn += cos / f64::from(n);
                drawn_square += cos * cos / f64::from(n);
            }
            assert!((drawn - mean).abs() < 2e-3 && (drawn_square - square).abs() < 2e-3, "{phase:?}");
        }
    }

    #[test]
    fn rays_are_in_a_box_between_its_faces() {
        let medium = Medium {
            absorption: Curve::constant(0.0),
            scattering: Curve::constant(1.0),
            phase: Phase::Rayleigh,
            bounds: Some([Vec3::ZERO, Vec3::new(2.0, 1.0, 1.0)]),
            density: Density::new([2, 1, 1], vec![0.0, 1.0]),
        };
        let at = |origin: [f32; 3], direction: Vec3, length| medium.within(origin.into(), direction, length);
        assert_eq!(at([-1.0, 0.5, 0.5], Vec3::X, 9.0), Some([1.0, 3.0]));
        assert_eq!(at([0.5, 0.5, 0.5], Vec3::X, 1.0), Some([0.0, 1.0]));
        assert_eq!(at([-1.0, 0.5, 0.5], Vec3::X, 0.5), None);
        assert_eq!(at([-1.0, 1.5, 0.5], Vec3::X, 9.0), None);
        assert_eq!(at([3.0, 0.5, 0.5], Vec3::X, 9.0), None);
        let density = |x: f32| medium.density_at(Vec3::new(x, 0.5, 0.5));
        assert_eq!([0.2, 1.0, 1.8].map(density), [0.0, 0.5, 1.0]);
    }
}
