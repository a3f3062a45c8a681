//! Light that nobody sees, shown in colours.
//!
//! The same computation serves the infrared and the ultraviolet, and pseudocolour shows the result (book III.8). Here
//! the axis of a curve is shifted and stretched, λ' = v₀ + (λ − b₀)(v₁ − v₀)/(b₁ − b₀), so that a band [b₀, b₁] falls
//! on visible wavelengths [v₀, v₁]. Values are kept as they are: a reflectance stays the same fraction, a lamp the
//! same power per nm of its own axis. So lamp and surface shown in the same way make the picture that an eye would
//! see whose sensitivity lay in the band.

use crate::{Curve, CurveError};

/// Where a shifted curve is cut off, nm.
const SHORTEST_NM: f64 = 1.0;

impl Curve {
    /// The curve with the band `band_nm` shown at the wavelengths `visible_nm`; each is a pair of increasing nm.
    ///
    /// Points beyond the band move along by the same rule; what would fall below 1 nm is cut off there.
    ///
    /// ```
    /// use illuminant_spectrum::{Curve, Outside};
    /// let leaf = Curve::new(vec![780.0, 1100.0], vec![0.4, 0.5], Outside::Hold).unwrap();
    /// let shown = leaf.pseudo_color([780.0, 1100.0], [380.0, 780.0]).unwrap();
    /// assert_eq!(shown.range_nm(), (380.0, 780.0));
    /// assert_eq!(shown.at(580.0), 0.45);
    /// ```
    ///
    /// # Errors
    /// [`CurveError::Band`] when a pair does not increase or is not positive and finite; [`CurveError::TooShort`] when
    /// fewer than two points are left.
    pub fn pseudo_color(&self, band_nm: [f64; 2], visible_nm: [f64; 2]) -> Result<Self, CurveError> {
        for [first_nm, last_nm] in [band_nm, visible_nm] {
            if !(first_nm > 0.0 && first_nm < last_nm && last_nm.is_finite()) {
                return Err(CurveError::Band { first_nm, last_nm });
            }
        }
        let ratio = (visible_nm[1] - visible_nm[0]) / (band_nm[1] - band_nm[0]);
        let shown = |w: f64| visible_nm[0] + (w - band_nm[0]) * ratio;
        let mut points: Vec<(f64, f64)> =
            self.wavelengths_nm().iter().map(|w| shown(*w)).zip(self.values().iter().copied()).collect();
        let kept = points.partition_point(|(w, _)| *w < SHORTEST_NM);
        if kept > 0 {
            points.drain(..kept);
            if points.first().is_some_and(|(w, _)| *w > SHORTEST_NM) {
                points.insert(0, (SHORTEST_NM, self.at(band_nm[0] + (SHORTEST_NM - visible_nm[0]) / ratio)));
            }
        }
        let (wavelengths, values) = points.into_iter().unzip();
        Self::new(wavelengths, values, self.outside())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Outside;

    #[test]
    fn a_band_and_back_again() {
        let curve = Curve::new(vec![700.0, 800.0, 950.0], vec![1.0, 2.0, 3.0], Outside::Zero).unwrap();
        let there = curve.pseudo_color([780.0, 1100.0], [380.0, 780.0]).unwrap();
        let back = there.pseudo_color([380.0, 780.0], [780.0, 1100.0]).unwrap();
        assert!(back.wavelengths_nm().iter().zip(curve.wavelengths_nm()).all(|(a, b)| (a - b).abs() < 1e-9));
        assert_eq!((back.values(), back.outside()), (curve.values(), Outside::Zero));
        assert!(
            (there.at(380.0 + 1.25 * 100.0) - curve.at(880.0)).abs() < 1e-12,
            "880 nm is 100 nm into the band"
        );
    }

    #[test]
    fn what_is_refused() {
        let curve = Curve::constant(1.0);
        assert!(matches!(curve.pseudo_color([900.0, 800.0], [380.0, 780.0]), Err(CurveError::Band { .. })));
        assert!(matches!(curve.pseudo_color([800.0, 900.0], [0.0, 780.0]), Err(CurveError::Band { .. })));
        let ultraviolet = Curve::new(vec![10.0, 20.0], vec![1.0, 1.0], Outside::Zero).unwrap();
        let gone = ultraviolet.pseudo_color([300.0, 400.0], [380.0, 780.0]);
        assert_eq!(gone, Err(CurveError::TooShort(0)));
        let sun = Curve::new(vec![300.0, 2500.0], vec![1.0, 0.2], Outside::Zero).unwrap();
        let shown = sun.pseudo_color([780.0, 1100.0], [380.0, 780.0]).unwrap();
        assert_eq!(shown.range_nm().0, 1.0);
        assert!((shown.at(580.0) - sun.at(940.0)).abs() < 1e-12);
    }
}
