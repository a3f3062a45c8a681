//! How the light of a source depends on direction (book 2.3.3: the directional intensity distribution of a luminaire).
//!
//! A distribution gives the intensity at an angle γ from the axis, to any scale: only
//! ratios matter, because the flux of a lamp is stated.

/// A rotationally symmetric distribution of intensity.
#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    /// cosᵖ γ up to 90 degrees, nothing beyond; p = 1 is Lambert's surface.
    CosinePower(f64),
    /// Values at angles in degrees, linear between and nothing beyond the last.
    Table(Vec<[f64; 2]>),
}

impl Distribution {
    /// A table of pairs of an angle in degrees, 0 to 180, and a value.
    ///
    /// # Errors
    /// A sentence, when there are not two pairs, angles do not grow from 0 within 180 degrees, or a value is negative, not finite, or all are zero.
    ///
    /// ```
    /// use illuminant_optics::goniometry::Distribution;
    /// let even = Distribution::table(vec![[0.0, 5.0], [180.0, 5.0]]).unwrap();
    /// // The same everywhere: the flux is 4π times the intensity.
    /// assert!((even.flux() / 5.0 - 4.0 * std::f64::consts::PI).abs() < 1e-12);
    /// assert!(Distribution::table(vec![[0.0, 1.0], [0.0, 2.0]]).is_err());
    /// ```
    pub fn table(pairs: Vec<[f64; 2]>) -> Result<Self, String> {
        if pairs.len() < 2 {
            return Err("a distribution needs at least two pairs of angle and value".into());
        }
        if pairs[0][0] != 0.0 {
            return Err(format!("the angles of a distribution begin at 0 degrees, not at {}", pairs[0][0]));
        }
        if pairs.windows(2).any(|pair| !(pair[0][0] < pair[1][0])) || !(pairs[pairs.len() - 1][0] <= 180.0) {
            return Err("the angles of a distribution grow, and end at 180 degrees or before".into());
        }
        if pairs.iter().any(|pair| !(pair[1] >= 0.0 && pair[1].is_finite())) {
            return Err("the values of a distribution are finite and not negative".into());
        }
        if pairs.iter().all(|pair| pair[1] == 0.0) {
            return Err("a distribution has a value above 0".into());
        }
        Ok(Self::Table(pairs))
    }

    /// The value at the cosine of an angle from the axis.
    ///
    /// ```
    /// use illuminant_optics::goniometry::Distribution;
    /// assert_eq!(Distribution::CosinePower(2.0).value(0.5), 0.25);
    /// assert_eq!(Distribution::CosinePower(2.0).value(-0.5), 0.0);
    /// ```
    #[must_use]
    pub fn value(&self, cos: f64) -> f64 {
        match self {
            Self::CosinePower(p) => {
                if cos > 0.0 {
                    cos.powf(*p)
                } else {
                    0.0
                }
            }
            Self::Table(pairs) => {
                let angle = cos.clamp(-1.0, 1.0).acos().to_degrees();
                let i = pairs.partition_point(|pair| pair[0] <= angle);
                match (pairs.get(i.wrapping_sub(1)), pairs.get(i)) {
                    (Some(low), Some(high)) => {
                        low[1] + (angle - low[0]) / (high[0] - low[0]) * (high[1] - low[1])
                    }
                    (Some(last), None) if angle - last[0] < 1e-4 => last[1],
                    _ => 0.0,
                }
            }
        }
    }

    /// The flux, ∫ value dω, in closed form.
    ///
    /// ```
    /// use illuminant_optics::goniometry::Distribution;
    /// use std::f64::consts::PI;
    /// assert!((Distribution::CosinePower(1.0).flux() - PI).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn flux(&self) -> f64 {
        use std::f64::consts::TAU;
        match self {
            Self::CosinePower(p) => TAU / (p + 1.0),
            Self::Table(pairs) => pairs
                .windows(2)
                .map(|pair| {
                    let [a, b] = [pair[0][0], pair[1][0]].map(f64::to_radians);
                    let slope = (pair[1][1] - pair[0][1]) / (b - a);
                    // ∫ (v + s (γ − a)) sin γ dγ.
                    let antiderivative = |x: f64| slope * x.sin() - (pair[0][1] + slope * (x - a)) * x.cos();
                    TAU * (antiderivative(b) - antiderivative(a))
                })
                .sum(),
        }
    }

    /// The radiance of a surface with this distribution of intensity about its normal, relative to that along it: value/(value(0) cos θ).
    /// Within half a degree of grazing the cosine is taken as that of 89.5 degrees.
    #[must_use]
    pub fn radiance(&self, cos: f64) -> f64 {
        match self {
            Self::CosinePower(p) => {
                if cos > 0.0 {
                    cos.max(0.0087).powf(p - 1.0)
                } else {
                    0.0
                }
            }
            Self::Table(_) => {
                let axis = self.value(1.0);
                if cos > 0.0 && axis > 0.0 { self.value(cos) / (axis * cos.max(0.0087)) } else { 0.0 }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_flux_is_the_integral() {
        let table = Distribution::table(vec![[0.0, 3.0], [20.0, 4.0], [60.0, 1.0], [120.0, 0.0]]).unwrap();
        for d in [table, Distribution::CosinePower(0.0), Distribution::CosinePower(4.5)] {
            let n = 200_000;
            let mean: f64 =
                (0..n).map(|i| d.value(2.0 * (f64::from(i) + 0.5) / f64::from(n) - 1.0)).sum::<f64>()
                    / f64::from(n);
            assert!((4.0 * std::f64::consts::PI * mean / d.flux() - 1.0).abs() < 1e-4, "{d:?}");
        }
    }
}
