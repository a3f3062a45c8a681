//! What is left of the radiance of a surface on its way to the eye (book 4.2.2).

use crate::Samples;

/// How radiance falls with the distance to the eye.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Atmosphere {
    /// Not at all.
    #[default]
    Clear,
    /// (u/d)^x, with the distance u at which nothing is lost or gained: x = 1 is Warnock's (1969); Romney (1969) found x = 2 by theory and
    /// preferred 4.
    InversePower {
        /// x.
        power: f64,
        /// u.
        unit: f64,
    },
    /// From the surface's own radiance at `start` to that of the fog at `end` and beyond (book eq 4.10).
    Fog {
        /// Where fading begins.
        start: f64,
        /// Where nothing else is seen.
        end: f64,
    },
}

impl Atmosphere {
    /// The radiance after a distance; `fog` is that of the fog.
    ///
    /// ```
    /// use illuminant_illumination::Atmosphere;
    /// let fog = Atmosphere::Fog { start: 2.0, end: 6.0 };
    /// assert_eq!([1.0, 4.0, 9.0].map(|d| fog.apply(10.0, 2.0, d)), [10.0, 6.0, 2.0]);
    /// let romney = Atmosphere::InversePower { power: 4.0, unit: 1.0 };
    /// assert_eq!(romney.apply(16.0, 0.0, 2.0), 1.0);
    /// ```
    #[must_use]
    pub fn apply<S: Samples>(&self, radiance: S, fog: S, distance: f64) -> S {
        match *self {
            Self::Clear => radiance,
            Self::InversePower { power, unit } => radiance.times((unit / distance).powf(power)),
            Self::Fog { start, end } => {
                let faded = ((distance - start) / (end - start)).clamp(0.0, 1.0);
                radiance.times(1.0 - faded) + fog.times(faded)
            }
        }
    }
}

/// What a medium that lets the fraction `per_unit` through a unit of length leaves after a distance, A^d (Kay and Greenberg 1979;
/// book 4.3.1).
///
/// ```
/// assert!((illuminant_illumination::filter_attenuation(0.6, 2.0) - 0.36).abs() < 1e-12);
/// ```
#[must_use]
pub fn filter_attenuation(per_unit: f64, distance: f64) -> f64 {
    per_unit.powf(distance)
}
