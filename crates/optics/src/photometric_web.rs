//! The photometric web of a luminaire: its intensity over all directions, as files of photometric laboratories give it (ANSI/IES LM-63,
//! EULUMDAT).
//!
//! Directions are γ from the axis (0 to 180°) and C around it (0 to 360°, CIE 121). Between the angles of the table the value is
//! linear in both.

/// Values over half-planes C and angles γ.
#[derive(Clone, Debug, PartialEq)]
pub struct PhotometricWeb {
    planes_deg: Vec<f64>,
    angles_deg: Vec<f64>,
    /// Plane by plane.
    values: Vec<f64>,
}

impl PhotometricWeb {
    /// A web from the values of each plane at each angle.
    ///
    /// # Errors
    /// A sentence, when planes do not grow within [0, 360), angles within [0, 180], when numbers do not fit, or a value is negative or not finite,
    /// or all are 0.
    ///
    /// ```
    /// use illuminant_optics::photometric_web::PhotometricWeb;
    /// let web = PhotometricWeb::new(vec![0.0], vec![0.0, 90.0, 180.0], vec![100.0, 50.0, 0.0]).unwrap();
    /// // Halfway between the axis and the horizon.
    /// let half = std::f64::consts::FRAC_1_SQRT_2;
    /// assert!((web.value([half, 0.0, half]) - 75.0).abs() < 1e-9);
    /// ```
    pub fn new(planes_deg: Vec<f64>, angles_deg: Vec<f64>, values: Vec<f64>) -> Result<Self, String> {
        let grows = |v: &[f64]| v.windows(2).all(|pair| pair[0] < pair[1]);
        if planes_deg.is_empty() || !grows(&planes_deg) || !(planes_deg[0] >= 0.0) {
            return Err("planes must grow from 0 degrees or more".into());
        }
        if !(planes_deg[planes_deg.len() - 1] < 360.0) {
            return Err("planes end before 360 degrees".into());
        }
        if angles_deg.len() < 2 || !grows(&angles_deg) || !(angles_deg[0] >= 0.0) {
            return Err("angles must be two or more, and grow from 0 degrees or more".into());
        }
        if !(angles_deg[angles_deg.len() - 1] <= 180.0) {
            return Err("angles end at 180 degrees or before".into());
        }
        if planes_deg.len() * angles_deg.len() != values.len() {
            let (planes, angles) = (planes_deg.len(), angles_deg.len());
            return Err(format!(
                "{planes} planes of {angles} angles have other than {} values",
                values.len()
            ));
        }
        if values.iter().any(|v| !(*v >= 0.0 && v.is_finite())) || values.iter().all(|v| *v == 0.0) {
            return Err("values must be finite and not negative, and not all 0".into());
        }
        Ok(Self { planes_deg, angles_deg, values })
    }

    /// The largest value.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.values.iter().copied().fold(0.0, f64::max)
    }

    /// All values divided by a number.
    #[must_use]
    pub fn over(mut self, unit: f64) -> Self {
        self.values.iter_mut().for_each(|v| *v /= unit);
        self
    }

    /// The value in a direction, a unit vector: z along the axis, x towards C = 0, y towards C = 90°. 0 beyond the angles of the table.
    #[must_use]
    pub fn value(&self, [x, y, z]: [f64; 3]) -> f64 {
        let gamma = z.clamp(-1.0, 1.0).acos().to_degrees();
        let (first, last) = (self.angles_deg[0], self.angles_deg[self.angles_deg.len() - 1]);
        if gamma < first - 1e-4 || gamma > last + 1e-4 {
            return 0.0;
        }
        let gamma = gamma.clamp(first, last);
        let row = self.angles_deg.partition_point(|a| *a <= gamma).clamp(1, self.angles_deg.len() - 1);
        let (low, high) = (self.angles_deg[row - 1], self.angles_deg[row]);
        let t = (gamma - low) / (high - low);
        let at = |plane: usize| {
            let values = &self.values[plane * self.angles_deg.len()..];
            values[row - 1] * (1.0 - t) + values[row] * t
        };
        let count = self.planes_deg.len();
        if count == 1 {
            return at(0);
        }
        let c = y.atan2(x).to_degrees().rem_euclid(360.0);
        let next = self.planes_deg.partition_point(|p| *p <= c);
        let before = (next + count - 1) % count;
        let next = next % count;
        let width = (self.planes_deg[next] - self.planes_deg[before]).rem_euclid(360.0);
        let s = (c - self.planes_deg[before]).rem_euclid(360.0) / width;
        at(before) * (1.0 - s) + at(next) * s
    }

    /// The flux, ∫ value dω, in closed form.
    ///
    /// ```
    /// use illuminant_optics::photometric_web::PhotometricWeb;
    /// let even = PhotometricWeb::new(vec![0.0, 90.0], vec![0.0, 180.0], vec![2.0; 4]).unwrap();
    /// assert!((even.flux() - 8.0 * std::f64::consts::PI).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn flux(&self) -> f64 {
        let rows = self.angles_deg.len();
        let of_plane = |plane: usize| -> f64 {
            let values = &self.values[plane * rows..][..rows];
            let pairs = self.angles_deg.windows(2).zip(values.windows(2));
            pairs
                .map(|(angles, values)| {
                    let [a, b] = [angles[0], angles[1]].map(f64::to_radians);
                    // ∫ (v̄ + Δv x / 2h) sin(m + x) dx over x from −h to h: nothing cancels, however near the angles are.
                    let (middle, h) = (0.5 * (a + b), 0.5 * (b - a));
                    let mean = 0.5 * (values[0] + values[1]);
                    2.0 * mean * middle.sin() * h.sin()
                        + (values[1] - values[0]) * middle.cos() * sinc_less_cos(h)
                })
                .sum::<f64>()
                .max(0.0)
        };
        let count = self.planes_deg.len();
        if count == 1 {
            return std::f64::consts::TAU * of_plane(0);
        }
        let width = |i: usize| (self.planes_deg[(i + 1) % count] - self.planes_deg[i]).rem_euclid(360.0);
        (0..count).map(|i| 0.5 * width(i).to_radians() * (of_plane(i) + of_plane((i + 1) % count))).sum()
    }
}

/// sin h / h − cos h.
fn sinc_less_cos(h: f64) -> f64 {
    let h2 = h * h;
    if h < 0.03 { h2 * (1.0 / 3.0 - h2 * (1.0 / 30.0 - h2 / 840.0)) } else { h.sin() / h - h.cos() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn direction(c: f64, gamma: f64) -> [f64; 3] {
        let ((sc, cc), (sg, cg)) = (c.to_radians().sin_cos(), gamma.to_radians().sin_cos());
        [sg * cc, sg * sc, cg]
    }

    #[test]
    fn values_stand_at_their_angles_and_are_linear_between() {
        let planes = vec![0.0, 90.0, 180.0, 270.0];
        let angles = vec![0.0, 30.0, 60.0];
        let values: Vec<f64> = (0..12).map(f64::from).collect();
        let web = PhotometricWeb::new(planes.clone(), angles.clone(), values).unwrap();
        for (i, c) in planes.iter().enumerate() {
            for (k, gamma) in angles.iter().enumerate().skip(1) {
                assert!((web.value(direction(*c, *gamma)) - (3 * i + k) as f64).abs() < 1e-9);
            }
        }
        assert!((web.value(direction(45.0, 30.0)) - 2.5).abs() < 1e-9);
        // From C270 on to C0.
        assert!((web.value(direction(315.0, 60.0)) - 6.5).abs() < 1e-9);
        assert_eq!(web.value(direction(10.0, 61.0)), 0.0);
    }

    #[test]
    fn the_flux_is_the_integral() {
        let angles: Vec<f64> = (0..=18).map(|i| 10.0 * f64::from(i)).collect();
        let planes: Vec<f64> = (0..8).map(|i| 45.0 * f64::from(i)).collect();
        let values = (0..planes.len() * angles.len()).map(|i| 1.0 + ((i * 7919) % 13) as f64).collect();
        let web = PhotometricWeb::new(planes, angles, values).unwrap();
        let (rows, columns) = (1800, 720);
        let mut sum = 0.0;
        for i in 0..rows {
            let gamma = (f64::from(i) + 0.5) * 180.0 / f64::from(rows);
            for k in 0..columns {
                let c = (f64::from(k) + 0.5) * 360.0 / f64::from(columns);
                sum += web.value(direction(c, gamma)) * gamma.to_radians().sin();
            }
        }
        let cell = std::f64::consts::PI / f64::from(rows) * std::f64::consts::TAU / f64::from(columns);
        assert!((sum * cell / web.flux() - 1.0).abs() < 1e-5);
    }

    #[test]
    fn the_flux_between_angles_that_nearly_coincide_is_that_of_a_ring() {
        for gap in [1e-12, 1e-6, 0.1, 1.0, 10.0] {
            for (low, high) in [(1.0, 1.0), (1.0, 0.0), (0.0, 1.0)] {
                let web = PhotometricWeb::new(vec![0.0], vec![30.0, 30.0 + gap], vec![low, high]).unwrap();
                // Simpson's rule is exact enough on so narrow a ring.
                let [a, m, b] = [30.0f64, 30.0 + 0.5 * gap, 30.0 + gap].map(|x| x.to_radians());
                let simpson = (low * a.sin() + 2.0 * (low + high) * m.sin() + high * b.sin()) * (b - a) / 6.0;
                let ring = std::f64::consts::TAU * simpson;
                assert!(
                    web.flux() >= 0.0 && (web.flux() - ring).abs() <= 1e-4 * ring,
                    "{gap}: {}",
                    web.flux()
                );
            }
        }
        let cone = PhotometricWeb::new(vec![0.0], vec![0.0, 1e-9], vec![1.0, 0.0]).unwrap();
        let solid_angle = std::f64::consts::PI * 1e-9f64.to_radians().powi(2);
        assert!((cone.flux() / (solid_angle / 3.0) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn what_is_no_web_is_refused() {
        let make = |planes: &[f64], angles: &[f64], values: &[f64]| {
            PhotometricWeb::new(planes.to_vec(), angles.to_vec(), values.to_vec()).unwrap_err()
        };
        assert!(make(&[0.0, 0.0], &[0.0, 90.0], &[1.0; 4]).contains("grow"));
        assert!(make(&[0.0, 360.0], &[0.0, 90.0], &[1.0; 4]).contains("before 360"));
        assert!(make(&[0.0], &[0.0], &[1.0]).contains("two or more"));
        assert!(make(&[0.0], &[0.0, 190.0], &[1.0; 2]).contains("180"));
        assert!(make(&[0.0], &[0.0, 90.0], &[1.0; 3]).contains("other than 3"));
        assert!(make(&[0.0], &[0.0, 90.0], &[0.0; 2]).contains("not all 0"));
        assert!(make(&[0.0], &[0.0, 90.0], &[-1.0, 1.0]).contains("not negative"));
    }
}
