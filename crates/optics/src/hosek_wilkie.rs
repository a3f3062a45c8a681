//! The clear sky and the sun in it (Hošek and Wilkie 2012, "An analytic model for full spectral sky-dome radiance"; 2013, "Adding a solar
//! radiance function to the Hošek skylight model").
//!
//! The radiance of the sky is a shape F(θ, γ) of the angles from the zenith and from the sun, times a mean, each fitted to path tracing in
//! an atmosphere at eleven wavelengths. The sun's is a function of its elevation, less limb darkening.

use std::f64::consts::{FRAC_PI_2, PI};

/// The dataset; its README says how it is laid out.
static DATA: &[u8] = include_bytes!("../data/hosek_wilkie/spectral.f64");

/// How many wavelengths there are.
pub const WAVELENGTHS: usize = 11;
/// The first of them, and how far the next one is, nm.
pub const FIRST_NM: f64 = 320.0;
/// See [`FIRST_NM`].
pub const STEP_NM: f64 = 40.0;

/// Half the angle across the sun, radians: 0.255°, that of the dataset.
pub const SUN_RADIUS: f64 = 0.51 / 2.0 * PI / 180.0;

/// The largest turbidity.
const TURBIDITIES: usize = 10;
const SHAPE: usize = 9;
const POINTS: usize = 6;
const PARTS: usize = 45;
const MEANS_AT: usize = TURBIDITIES * 2 * POINTS * WAVELENGTHS * SHAPE;
const SUN_AT: usize = MEANS_AT + TURBIDITIES * 2 * POINTS * WAVELENGTHS;
const LIMB_AT: usize = SUN_AT + TURBIDITIES * PARTS * WAVELENGTHS * 4;

fn datum(index: usize) -> f64 {
    let bytes: [u8; 8] = std::array::from_fn(|i| DATA[8 * index + i]);
    f64::from_le_bytes(bytes)
}

/// A sky: one turbidity, albedo of the ground, and elevation of the sun.
#[derive(Clone, Debug)]
pub struct HosekWilkie {
    /// A to I of each wavelength, H last.
    shape: [[f64; SHAPE]; WAVELENGTHS],
    mean: [f64; WAVELENGTHS],
    /// The sun's cubics at this turbidity: part by part.
    sun: Vec<[[f64; 4]; WAVELENGTHS]>,
    limb: [[f64; 6]; WAVELENGTHS],
}

impl HosekWilkie {
    /// The sky at a turbidity (1 is pure air, 3 a clear day, 10 haze), a ground albedo (0 to 1) and an elevation of the sun (0 to π/2).
    ///
    /// # Errors
    /// A sentence, for a number out of range.
    ///
    /// ```
    /// use illuminant_optics::hosek_wilkie::HosekWilkie;
    /// let sky = HosekWilkie::new(3.0, 0.2, 0.8).unwrap();
    /// let [blue, red] = [440.0, 680.0].map(|nm| sky.radiance(1.0, 1.0, nm));
    /// assert!(blue > 2.0 * red);
    /// ```
    pub fn new(turbidity: f64, albedo: f64, elevation: f64) -> Result<Self, String> {
        if !(1.0..=10.0).contains(&turbidity) {
            return Err(format!("turbidity must lie between 1 and 10, not {turbidity}"));
        }
        if !(0.0..=1.0).contains(&albedo) {
            return Err(format!("ground_albedo must lie between 0 and 1, not {albedo}"));
        }
        if !(0.0..=FRAC_PI_2 + 1e-9).contains(&elevation) {
            return Err(format!(
                "the sun must stand between 0 and 90 degrees above the horizon, not at {:.4}",
                elevation.to_degrees()
            ));
        }
        let low = (turbidity as usize).clamp(1, TURBIDITIES - 1);
        let part = turbidity - low as f64;
        // Of 6 control points over the cube root of elevation a Bézier curve of degree 5.
        let x = (elevation / FRAC_PI_2).clamp(0.0, 1.0).cbrt();
        let bernstein: [f64; POINTS] = std::array::from_fn(|i| {
            [1.0, 5.0, 10.0, 10.0, 5.0, 1.0][i] * x.powi(i as i32) * (1.0 - x).powi(5 - i as i32)
        });
        // `first` is where a table begins, `stride` how much it holds for each control point, `index` which of that is wanted.
        let blend = |first: usize, stride: usize, index: usize| {
            let mut sum = 0.0;
            for (t, of_turbidity) in [(low - 1, 1.0 - part), (low, part)] {
                for (a, of_albedo) in [(0, 1.0 - albedo), (1, albedo)] {
                    for (point, of_point) in bernstein.iter().enumerate() {
                        let row = (t * 2 + a) * POINTS + point;
                        sum += of_turbidity * of_albedo * of_point * datum(first + row * stride + index);
                    }
                }
            }
            sum
        };
        let shape =
            std::array::from_fn(|w| std::array::from_fn(|i| blend(0, WAVELENGTHS * SHAPE, w * SHAPE + i)));
        let mean = std::array::from_fn(|w| blend(MEANS_AT, WAVELENGTHS, w));
        let sun = (0..PARTS).map(|p| {
            std::array::from_fn(|w| {
                std::array::from_fn(|i| {
                    let at = |t: usize| datum(SUN_AT + ((t * PARTS + p) * WAVELENGTHS + w) * 4 + i);
                    (1.0 - part) * at(low - 1) + part * at(low)
                })
            })
        });
        let limb = std::array::from_fn(|w| std::array::from_fn(|i| datum(LIMB_AT + w * 6 + i)));
        Ok(Self { shape, mean, sun: sun.collect(), limb })
    }

    /// The radiance of the sky, W·m⁻²·sr⁻¹·nm⁻¹, at all wavelengths of the dataset, by the cosine of the angle θ from the zenith and the
    /// angle γ from the sun, radians: eq 8 of 2012. 0 below the horizon.
    #[must_use]
    pub fn radiances(&self, cos_theta: f64, gamma: f64) -> [f64; WAVELENGTHS] {
        if cos_theta < 0.0 {
            return [0.0; WAVELENGTHS];
        }
        let cos = gamma.cos();
        let (down, root) = ((cos_theta + 0.01).recip(), cos_theta.sqrt());
        let mut all = [0.0; WAVELENGTHS];
        for (w, value) in all.iter_mut().enumerate() {
            let [a, b, c, d, e, f, g, i, h] = self.shape[w];
            let lobe = 1.0 + h * h - 2.0 * h * cos;
            let mie = (1.0 + cos * cos) / (lobe * lobe.sqrt());
            let horizon = 1.0 + a * (b * down).exp();
            let around = c + d * (e * gamma).exp() + f * cos * cos + g * mie + i * root;
            *value = (self.mean[w] * horizon * around).max(0.0);
        }
        all
    }

    /// The radiance of the sky at a wavelength, nm: between those of the dataset linear, outside that of the nearest.
    #[must_use]
    pub fn radiance(&self, cos_theta: f64, gamma: f64, nm: f64) -> f64 {
        at(&self.radiances(cos_theta, gamma), nm)
    }

    /// The radiance of the sun's disc where it is seen at an elevation, at the angle γ from its middle, radians; 0 outside.
    #[must_use]
    pub fn sun_radiances(&self, elevation: f64, gamma: f64) -> [f64; WAVELENGTHS] {
        if !(gamma <= SUN_RADIUS && elevation >= 0.0) {
            return [0.0; WAVELENGTHS];
        }
        let place = (elevation / FRAC_PI_2).clamp(0.0, 1.0).cbrt() * PARTS as f64;
        let part = (place as usize).min(PARTS - 1);
        let x = elevation - (part as f64 / PARTS as f64).powi(3) * FRAC_PI_2;
        // The cosine to the sun's own surface.
        let sine = gamma.sin() / SUN_RADIUS.sin();
        let cos = (1.0 - sine * sine).max(0.0).sqrt();
        std::array::from_fn(|w| {
            let polynomial = |c: &[f64], x: f64| c.iter().rev().fold(0.0, |sum, c| sum * x + c);
            (polynomial(&self.sun[part][w], x) * polynomial(&self.limb[w], cos)).max(0.0)
        })
    }
}

/// A spectrum of the dataset at a wavelength, nm.
#[must_use]
pub fn at(values: &[f64; WAVELENGTHS], nm: f64) -> f64 {
    let place = ((nm - FIRST_NM) / STEP_NM).clamp(0.0, (WAVELENGTHS - 1) as f64);
    let low = (place as usize).min(WAVELENGTHS - 2);
    let part = place - low as f64;
    values[low] * (1.0 - part) + values[low + 1] * part
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_dataset_is_whole() {
        assert_eq!(DATA.len(), 8 * (LIMB_AT + WAVELENGTHS * 6));
    }

    #[test]
    fn the_disc_is_darkest_at_its_limb_and_ends_there() {
        let sky = HosekWilkie::new(3.0, 0.3, 0.7).unwrap();
        let [middle, limb, outside] =
            [0.0, 0.999 * SUN_RADIUS, 1.001 * SUN_RADIUS].map(|gamma| sky.sun_radiances(0.7, gamma)[5]);
        assert!(limb < 0.5 * middle && limb > 0.0 && outside == 0.0);
        // About what reaches the ground at 520 nm on a clear day, 1.3 W·m⁻²·nm⁻¹.
        let irradiance = 0.8 * middle * PI * SUN_RADIUS * SUN_RADIUS;
        assert!((0.9..1.6).contains(&irradiance), "{irradiance}");
    }

    #[test]
    fn a_low_sun_is_red_and_the_sky_is_brightest_about_it() {
        let sky = HosekWilkie::new(4.0, 0.1, 0.05).unwrap();
        let sun = sky.sun_radiances(0.05, 0.0);
        assert!(sun[9] > 10.0 * sun[3]);
        assert!(sky.radiance(0.05, 0.02, 560.0) > 3.0 * sky.radiance(0.05, 2.0, 560.0));
        assert_eq!(sky.radiance(-0.01, 1.0, 560.0), 0.0);
    }

    #[test]
    fn what_cannot_be_is_refused() {
        for (turbidity, albedo, elevation) in
            [(0.9, 0.0, 0.5), (11.0, 0.0, 0.5), (3.0, 1.1, 0.5), (3.0, 0.0, -0.1)]
        {
            assert!(HosekWilkie::new(turbidity, albedo, elevation).is_err());
        }
        assert!(HosekWilkie::new(10.0, 1.0, FRAC_PI_2).is_ok());
    }
}
