//! The clear sky and the sun as lamps: [`HosekWilkie`] about a scene.

use crate::environment::pick;
use glam::{Mat3, Vec3};
use illuminant_optics::frame::Frame;
use illuminant_optics::hosek_wilkie::{FIRST_NM, HosekWilkie, STEP_NM, SUN_RADIUS, WAVELENGTHS, at};
use illuminant_sampling::Lanes;
use illuminant_spectrum::{Curve, Outside, SpectralRange};
use std::f32::consts::{FRAC_PI_2, TAU};

type Radiances = [f64; WAVELENGTHS];

/// Spectra of the dataset relative to one, between whose wavelengths both are linear.
#[derive(Clone, Debug)]
struct Relative {
    to: Radiances,
    /// Where the spectral range begins among the wavelengths of the dataset, and how many of their steps it is wide.
    first: f32,
    steps: f32,
}

impl Relative {
    fn new(to: Radiances, range: SpectralRange) -> Self {
        let first = (f64::from(range.min_nm) - FIRST_NM) / STEP_NM;
        Self { to, first: first as f32, steps: ((range.width_nm() - 1.0) / STEP_NM) as f32 }
    }

    /// The absolute spectrum of what others are relative to.
    fn spectrum(&self, range: SpectralRange) -> Curve {
        let values = range.wavelengths().map(|nm| at(&self.to, nm)).collect();
        Curve::tabulated(range, values, Outside::Hold)
    }

    /// `light`, the lanes of what spectra are relative to, made those of `values`; `t` is where lanes lie in the range, 0 to 1.
    #[inline]
    fn lanes<const N: usize>(&self, values: &Radiances, t: &Lanes<N>, light: &Lanes<N>) -> Lanes<N> {
        let last = (WAVELENGTHS - 1) as f32;
        let ratio = t.map(|t| {
            let place = self.steps.mul_add(t, self.first).clamp(0.0, last);
            let low = (place as usize).min(WAVELENGTHS - 2);
            let part = place - low as f32;
            let of = |v: &Radiances| (1.0 - part) * v[low] as f32 + part * v[low + 1] as f32;
            let below = of(&self.to);
            if below > 0.0 { of(values) / below } else { 0.0 }
        });
        ratio * *light
    }
}

/// Where the sun stands.
#[derive(Clone, Copy, Debug)]
pub struct SunPosition {
    /// Above the horizon, radians.
    pub elevation: f64,
    /// From the middle of an environment image to the right, radians.
    pub azimuth: f64,
    /// From the world to a y-up frame.
    pub to_y_up: Mat3,
}

impl SunPosition {
    /// Unit vector to the sun, and that to the zenith.
    fn directions(&self) -> (Vec3, Vec3) {
        let (sin, cos) = self.elevation.sin_cos();
        let (right, ahead) = self.azimuth.sin_cos();
        let y_up = Vec3::new((cos * right) as f32, sin as f32, (-cos * ahead) as f32);
        let back = self.to_y_up.transpose();
        (back * y_up, back * Vec3::Y)
    }
}

/// The sky without the sun: radiance from every direction above the horizon.
#[derive(Debug)]
pub struct Sky {
    model: HosekWilkie,
    relative: Relative,
    sun: Vec3,
    /// From the world to a frame with the zenith along z.
    frame: Frame,
    /// Running sums of importance over rows of equal height in angle from the zenith, and over the columns of each row.
    rows: Vec<f32>,
    columns: Vec<f32>,
}

/// Rows of the table of importance, and columns.
const ROWS: usize = 64;
const COLUMNS: usize = 256;

/// The angle between two unit vectors, exact also where it is small.
fn angle(a: Vec3, b: Vec3) -> f64 {
    f64::from(2.0 * (a - b).length().atan2((a + b).length()))
}

impl Sky {
    /// The sky of a model about a sun.
    #[must_use]
    pub fn new(model: HosekWilkie, position: &SunPosition, range: SpectralRange) -> (Self, Curve) {
        let (sun, zenith) = position.directions();
        let frame = Frame::from_normal(zenith);
        let (mut rows, mut columns) = (Vec::with_capacity(ROWS), Vec::with_capacity(ROWS * COLUMNS));
        let mut mean = [0.0; WAVELENGTHS];
        let (mut sum, mut weights) = (0.0f64, 0.0f64);
        for row in 0..ROWS {
            let theta = (row as f64 + 0.5) / ROWS as f64 * f64::from(FRAC_PI_2);
            let (sin, cos) = theta.sin_cos();
            let mut of_row = 0.0;
            for column in 0..COLUMNS {
                let (y, x) = ((column as f64 + 0.5) / COLUMNS as f64 * f64::from(TAU)).sin_cos();
                let local = Vec3::new((sin * x) as f32, (sin * y) as f32, cos as f32);
                let values = model.radiances(cos, angle(frame.to_world(local), sun));
                mean.iter_mut().zip(values).for_each(|(mean, v)| *mean += sin * v);
                weights += sin;
                // Where luminance comes from; a little everywhere, for what lies between the middles of cells.
                of_row += sin * (at(&values, 560.0) + 0.02 * at(&values, 480.0));
                columns.push(of_row as f32);
            }
            sum += of_row;
            rows.push(sum as f32);
        }
        let relative = Relative::new(mean.map(|v| v / weights), range);
        let spectrum = relative.spectrum(range);
        (Self { model, relative, sun, frame, rows, columns }, spectrum)
    }

    /// ∫ L dω over the mean, sr: that of half the sphere.
    #[must_use]
    pub fn integral(&self) -> f64 {
        f64::from(TAU)
    }

    /// The radiance from a direction: `t` is where each lane lies in the spectral range, and `light` the lamp's spectrum in each lane.
    #[inline(never)]
    #[must_use]
    pub fn radiance<const N: usize>(&self, direction: Vec3, t: &Lanes<N>, light: &Lanes<N>) -> Lanes<N> {
        let cos = f64::from(self.frame.to_local(direction).z);
        if cos < 0.0 {
            return Lanes::default();
        }
        self.relative.lanes(&self.model.radiances(cos, angle(direction, self.sun)), t, light)
    }

    /// A direction drawn by luminance, from two numbers in [0, 1), and its density, 1/sr.
    #[must_use]
    pub fn sample(&self, u: [f32; 2]) -> Option<(Vec3, f32)> {
        let (row, down) = pick(&self.rows, u[0])?;
        let (column, along) = pick(&self.columns[row * COLUMNS..(row + 1) * COLUMNS], u[1])?;
        let theta = (row as f32 + down) / ROWS as f32 * FRAC_PI_2;
        let phi = (column as f32 + along) / COLUMNS as f32 * TAU;
        let local = Vec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
        let pdf = self.density(row, column, theta);
        (pdf > 0.0 && pdf.is_finite()).then(|| (self.frame.to_world(local), pdf))
    }

    /// The density of [`Self::sample`], 1/sr.
    #[must_use]
    pub fn pdf(&self, direction: Vec3) -> f32 {
        let local = self.frame.to_local(direction);
        if !(local.z > 0.0) {
            return 0.0;
        }
        let theta = local.truncate().length().atan2(local.z);
        let phi = local.y.atan2(local.x).rem_euclid(TAU);
        let cell = |x: f32, count: usize| ((x * count as f32) as usize).min(count - 1);
        self.density(cell(theta / FRAC_PI_2, ROWS), cell(phi / TAU, COLUMNS), theta)
    }

    fn density(&self, row: usize, column: usize, theta: f32) -> f32 {
        let step = |sums: &[f32], i: usize| sums[i] - if i == 0 { 0.0 } else { sums[i - 1] };
        let columns = &self.columns[row * COLUMNS..(row + 1) * COLUMNS];
        let probability =
            step(&self.rows, row) / self.rows[ROWS - 1] * step(columns, column) / columns[COLUMNS - 1];
        probability * (ROWS * COLUMNS) as f32 / (FRAC_PI_2 * TAU * theta.sin())
    }
}

/// The disc of the sun.
#[derive(Debug)]
pub struct Sun {
    model: HosekWilkie,
    relative: Relative,
    /// Along z.
    frame: Frame,
    zenith: Vec3,
}

impl Sun {
    /// The sun of a model.
    #[must_use]
    pub fn new(model: HosekWilkie, position: &SunPosition, range: SpectralRange) -> (Self, Curve) {
        let (to_sun, zenith) = position.directions();
        let frame = Frame::from_normal(to_sun);
        let empty = Relative::new([0.0; WAVELENGTHS], range);
        let mut sun = Self { model, relative: empty, frame, zenith };
        // The mean over the disc, by rings of equal area.
        let mut mean = [0.0; WAVELENGTHS];
        let (rings, places) = (32, 32);
        for i in 0..rings * places {
            let u = [i / places, i % places].map(|k| (k as f32 + 0.5) / 32.0);
            let values = sun.radiances(sun.sample(u).0);
            mean.iter_mut().zip(values).for_each(|(mean, v)| *mean += v / f64::from(rings * places));
        }
        sun.relative = Relative::new(mean, range);
        let spectrum = sun.relative.spectrum(range);
        (sun, spectrum)
    }

    /// Unit vector to its middle.
    #[must_use]
    pub fn direction(&self) -> Vec3 {
        self.frame.to_world(Vec3::Z)
    }

    /// What it fills of the sphere of directions, sr.
    #[must_use]
    pub fn solid_angle(&self) -> f32 {
        // 2π (1 − cos r) without cancellation.
        let half = (0.5 * SUN_RADIUS).sin();
        (4.0 * std::f64::consts::PI * half * half) as f32
    }

    fn radiances(&self, direction: Vec3) -> Radiances {
        let elevation = f64::from(direction.dot(self.zenith)).clamp(-1.0, 1.0).asin();
        self.model.sun_radiances(elevation, angle(direction, self.direction()))
    }

    /// The radiance from a direction, as of [`Sky::radiance`]; 0 outside the disc.
    #[must_use]
    pub fn radiance<const N: usize>(&self, direction: Vec3, t: &Lanes<N>, light: &Lanes<N>) -> Lanes<N> {
        if !self.covers(direction) {
            return Lanes::default();
        }
        self.relative.lanes(&self.radiances(direction), t, light)
    }

    /// Whether a direction meets the disc.
    #[inline]
    #[must_use]
    pub fn covers(&self, direction: Vec3) -> bool {
        let middle = self.direction();
        direction.dot(middle) > 0.9 && angle(direction, middle) <= SUN_RADIUS
    }

    /// A direction to the disc, uniform over it, from two numbers in [0, 1), and its density, 1/sr.
    #[must_use]
    pub fn sample(&self, u: [f32; 2]) -> (Vec3, f32) {
        // A hair inside, so that rounding leaves it on the disc.
        let sin = (SUN_RADIUS.sin() * 0.9999) as f32 * u[0].sqrt();
        let (y, x) = (TAU * u[1]).sin_cos();
        let local = Vec3::new(sin * x, sin * y, (1.0 - sin * sin).sqrt());
        (self.frame.to_world(local), self.solid_angle().recip())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use illuminant_sampling::Lanes;

    fn position(elevation: f64) -> SunPosition {
        SunPosition { elevation, azimuth: 2.0, to_y_up: Mat3::from_rotation_x(-FRAC_PI_2) }
    }

    fn model(elevation: f64) -> HosekWilkie {
        HosekWilkie::new(3.0, 0.3, elevation).unwrap()
    }

    #[test]
    fn the_sun_stands_where_it_should() {
        // z up: azimuth is from +y towards +x.
        let at = SunPosition { elevation: 0.5, azimuth: 0.3, to_y_up: Mat3::from_rotation_x(-FRAC_PI_2) };
        let (sun, zenith) = at.directions();
        assert!((zenith - Vec3::Z).length() < 1e-6);
        let expected = Vec3::new(0.3f32.sin() * 0.5f32.cos(), 0.3f32.cos() * 0.5f32.cos(), 0.5f32.sin());
        assert!((sun - expected).length() < 1e-6, "{sun} {expected}");
    }

    #[test]
    fn densities_are_normalised_and_those_of_draws() {
        let range = SpectralRange { min_nm: 380, max_nm: 780 };
        let (sky, _) = Sky::new(model(0.6), &position(0.6), range);
        let (n, mut sum, mut error) = (1 << 16, 0.0f64, 0.0f32);
        for i in 0..n {
            let z = (i as f32 + 0.5) / n as f32;
            let phi = i as f32 * 2.399_963;
            let s = (1.0 - z * z).sqrt();
            let d = sky.frame.to_world(Vec3::new(s * phi.cos(), s * phi.sin(), z));
            sum += f64::from(sky.pdf(d));
            let u = [z, (i as f32 * 0.618_034) % 1.0];
            let (d, pdf) = sky.sample(u).unwrap();
            // At the border of cells rounding may find the other one.
            error += f32::from(u8::from((sky.pdf(d) / pdf - 1.0).abs() > 1e-3));
        }
        let integral = sum / f64::from(n) * f64::from(TAU);
        assert!((integral - 1.0).abs() < 5e-3, "{integral}");
        assert!(error / (n as f32) < 2e-3, "{error}");
    }

    #[test]
    fn the_sky_adds_up_to_its_mean() {
        let range = SpectralRange { min_nm: 380, max_nm: 780 };
        let (sky, spectrum) = Sky::new(model(0.9), &position(0.9), range);
        let nm = [400.0, 437.0, 500.0, 555.0, 600.0, 650.0, 700.0, 750.0];
        let t = Lanes::<8>(nm.map(|v| (v - 380.0) / 400.0));
        let light = Lanes::<8>(nm.map(|v| spectrum.at(f64::from(v)) as f32));
        let (n, mut sum) = (1 << 15, Lanes::<8>::default());
        for i in 0..n {
            let u = [(i as f32 + 0.5) / n as f32, (i as f32 * 0.618_034) % 1.0];
            if let Some((d, pdf)) = sky.sample(u) {
                sum += sky.radiance(d, &t, &light) * (pdf * n as f32).recip();
            }
        }
        for lane in 0..8 {
            assert!((sum.0[lane] / (TAU * light.0[lane]) - 1.0).abs() < 5e-3, "{lane}");
        }
    }

    #[test]
    fn the_sun_is_met_where_it_is_drawn() {
        let range = SpectralRange { min_nm: 380, max_nm: 780 };
        let (sun, spectrum) = Sun::new(model(0.2), &position(0.2), range);
        let t = Lanes::<8>::splat(0.45);
        let light = Lanes::<8>::splat(spectrum.at(560.0) as f32);
        let (n, mut sum) = (4096, 0.0);
        for i in 0..n {
            let (d, _) = sun.sample([(i as f32 + 0.5) / n as f32, (i as f32 * 0.618_034) % 1.0]);
            assert!(sun.covers(d));
            sum += sun.radiance(d, &t, &light).0[0] / n as f32;
        }
        assert!((sum / light.0[0] - 1.0).abs() < 1e-2);
        let beside = sun.frame.to_world(Vec3::new(0.0046, 0.0, 1.0).normalize());
        assert!(!sun.covers(beside));
    }
}
