//! Blackbody radiation.

const H: f64 = 6.626_070_15e-34;
const C: f64 = 299_792_458.0;
const K_B: f64 = 1.380_649e-23;

/// The second radiation constant c₂ = hc/k_B, nm·K, by the SI of 2019: 1.438 776 877 × 10⁷.
pub const SECOND_RADIATION_CONSTANT: f64 = H * C / K_B * 1e9;

/// Spectral radiance of a blackbody, W·sr⁻¹·m⁻²·nm⁻¹, at a wavelength in nm and a temperature in K.
///
/// L(λ, T) = c₁ λ⁻⁵ / (exp(c₂ / λT) − 1), with c₁ = 2hc² and c₂ = hc/k_B (Planck 1900), in vacuum, with the
/// constants of the SI of 2019.
///
/// ```
/// // Wien: the peak of a 5,800 K body lies near 499.6 nm.
/// let peak = (300..900).max_by(|&a, &b| {
///     let l = |w: i32| illuminant_spectrum::planck(f64::from(w), 5800.0);
///     l(a).total_cmp(&l(b))
/// });
/// assert_eq!(peak, Some(500));
/// ```
#[must_use]
pub fn planck(wavelength_nm: f64, temperature_k: f64) -> f64 {
    let wavelength_m = wavelength_nm * 1e-9;
    let exponent = H * C / (wavelength_m * K_B * temperature_k);
    2.0 * H * C * C / wavelength_m.powi(5) / exponent.exp_m1() * 1e-9
}

#[cfg(test)]
mod tests {
    use super::planck;

    #[test]
    fn total_radiance_is_that_of_stefan_and_boltzmann() {
        let temperature = 5000.0;
        let total: f64 = (0..200_000).map(|i| planck(50.0 + 0.5 * f64::from(i), temperature) * 0.5).sum();
        let expected = 5.670_374_419e-8 * f64::powi(temperature, 4) / std::f64::consts::PI;
        assert!((total / expected - 1.0).abs() < 1e-4, "{total} against {expected}");
    }
}
