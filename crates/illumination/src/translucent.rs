//! A thin sheet that scatters light diffusely on both sides: paper, a lampshade, opal acrylic, a blind.
//!
//! f(v, l) = R/π where viewer and light are on the same side, T/π where the sheet lies between them (Lambert on
//! either side), with R + T ≤ 1 at every wavelength; R and T are the same from both sides. A sheet bounds no medium.
//!
//! A direction is reflected with the chance R̂/(R̂ + T̂), R̂ and T̂ being the largest of R and T over the range. The mean
//! square of a path's weight changes by (R̂ + T̂)(R²/R̂ + T²/T̂) ≤ (R̂ + T̂)(R + T) with each sheet, in every lane.
//!
//! ```
//! use illuminant_illumination::Translucent;
//! use illuminant_sampling::Lanes;
//! let paper = Translucent::<4>::new([Lanes::splat(0.6), Lanes::splat(0.3)], [0.6, 0.3]);
//! assert!((paper.albedo()[0] - 0.9).abs() < 1e-6);
//! ```

use crate::model::{Incidence, Scattered};
use glam::Vec3;
use illuminant_optics::hemisphere;
use illuminant_sampling::Lanes;
use std::f32::consts::{FRAC_1_PI, PI};

/// A sheet in the lanes of one pass.
#[derive(Clone, Copy, Debug)]
pub struct Translucent<const N: usize> {
    /// R/π, 1/sr.
    reflected: Lanes<N>,
    /// T/π, 1/sr.
    transmitted: Lanes<N>,
    /// R̂ and T̂.
    brightness: [f32; 2],
}

impl<const N: usize> Translucent<N> {
    /// A sheet of reflectance and transmittance, in lanes and as one number each.
    #[must_use]
    pub fn new([reflectance, transmittance]: [Lanes<N>; 2], brightness: [f32; 2]) -> Self {
        Self { reflected: reflectance * FRAC_1_PI, transmitted: transmittance * FRAC_1_PI, brightness }
    }

    /// The same with another reflectance, of which at most what is not transmitted counts.
    #[must_use]
    pub(crate) fn with_reflectance(&self, reflectance: &Lanes<N>, brightness: f32) -> Self {
        let reflected = self.within(reflectance) * FRAC_1_PI;
        Self { reflected, brightness: [brightness, self.brightness[1]], ..*self }
    }

    /// A reflectance, at most 1 − T.
    fn within(&self, reflectance: &Lanes<N>) -> Lanes<N> {
        reflectance.zip(self.transmitted, |r, t| r.min((1.0 - t * PI).max(0.0)))
    }

    /// Where between R = 0 and R = 1 − T a reflectance lies.
    pub(crate) fn share_of_white(&self, reflectance: &Lanes<N>) -> Lanes<N> {
        let white = self.within(&Lanes::splat(1.0));
        self.within(reflectance).zip(white, |r, most| if most > 0.0 { r / most } else { 1.0 })
    }

    /// R + T: what of light from everywhere comes back to one side, and what of a beam leaves on both.
    #[must_use]
    pub fn albedo(&self) -> Lanes<N> {
        (self.reflected + self.transmitted) * PI
    }

    /// The chance of being reflected.
    #[inline(always)]
    fn reflects(&self) -> f32 {
        let [reflected, transmitted] = self.brightness;
        let sum = reflected + transmitted;
        if sum > 0.0 { reflected / sum } else { 1.0 }
    }

    /// f(v, l), 1/sr.
    #[inline(always)]
    pub(crate) fn eval(&self, at: &Incidence<'_, N>, to_light: Vec3) -> Lanes<N> {
        let sides = at.to_viewer.z * to_light.z;
        if sides > 0.0 {
            self.reflected
        } else if sides < 0.0 {
            self.transmitted
        } else {
            Lanes::default()
        }
    }

    /// The density of a direction, 1/sr.
    #[inline(always)]
    pub(crate) fn pdf(&self, at: &Incidence<'_, N>, to_light: Vec3) -> f32 {
        let reflects = self.reflects();
        let chance = if at.to_viewer.z * to_light.z > 0.0 { reflects } else { 1.0 - reflects };
        chance * to_light.z.abs() * FRAC_1_PI
    }

    /// Draws a direction: the third number chooses the side.
    #[inline(always)]
    pub(crate) fn sample(&self, at: &Incidence<'_, N>, u: [f32; 3]) -> Scattered<N> {
        let reflects = self.reflects();
        let transmitted = u[2] >= reflects;
        let (f, chance) =
            if transmitted { (self.transmitted, 1.0 - reflects) } else { (self.reflected, reflects) };
        let side = if transmitted { -at.to_viewer.z } else { at.to_viewer.z };
        let direction = Vec3::from(hemisphere::cosine([u[0], u[1]])) * 1f32.copysign(side);
        Scattered {
            direction,
            weight: f * (PI / chance),
            brightness: (self.brightness[0] + self.brightness[1]).min(1.0),
            pdf: Some(chance * direction.z.abs() * FRAC_1_PI),
            transmitted,
            disperses: false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Index;

    const LANES: Lanes<4> = Lanes([1.0; 4]);

    fn view(to_viewer: Vec3) -> Incidence<'static, 4> {
        let index = Index { mean: 1.0, least: 1.0, lanes: &LANES };
        Incidence { to_viewer, near: index, far: index, hero_lane: None }
    }

    /// Paper that reflects more in the first lanes and transmits more in the last.
    fn paper() -> Translucent<4> {
        Translucent::new([Lanes([0.7, 0.6, 0.3, 0.2]), Lanes([0.1, 0.2, 0.5, 0.8])], [0.7, 0.8])
    }

    /// Numbers in [0, 1) that fill it evenly.
    fn numbers(i: usize) -> [f32; 3] {
        [0.819_172_5, 0.671_043_6, 0.549_700_5].map(|step: f64| ((i as f64 + 0.5) * step).fract() as f32)
    }

    const UP: Vec3 = Vec3::new(0.6, 0.0, 0.8);
    const DRAWS: usize = 20_000;

    #[test]
    fn a_furnace_shows_reflectance_plus_transmittance() {
        // ∫ f |cos| over all directions, by drawing from both sides.
        let wanted = [0.8, 0.8, 0.8, 1.0];
        for to_viewer in [UP, -UP] {
            let mut sum = Lanes::<4>::default();
            for i in 0..DRAWS {
                sum += paper().sample(&view(to_viewer), numbers(i)).weight * (DRAWS as f32).recip();
            }
            for (found, wanted) in sum.0.iter().zip(wanted) {
                assert!((found - wanted).abs() < 2e-3, "{sum:?}");
            }
        }
        assert!(paper().albedo().0.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-6));
    }

    #[test]
    fn drawn_directions_have_their_side_weight_and_density() {
        for to_viewer in [UP, -UP] {
            let (paper, at) = (paper(), view(to_viewer));
            let mut through = 0;
            for i in 0..DRAWS {
                let drawn = paper.sample(&at, numbers(i));
                assert_eq!(drawn.transmitted, drawn.direction.z * to_viewer.z < 0.0);
                let pdf = paper.pdf(&at, drawn.direction);
                assert!((drawn.pdf.unwrap() - pdf).abs() < 1e-6);
                let weight = paper.eval(&at, drawn.direction) * (drawn.direction.z.abs() / pdf);
                assert!(drawn.weight.0.iter().zip(weight.0).all(|(a, b)| (a - b).abs() < 1e-5));
                through += usize::from(drawn.transmitted);
            }
            assert!((through as f32 / DRAWS as f32 - 0.8 / 1.5).abs() < 1e-3);
        }
    }

    #[test]
    fn the_density_integrates_to_one() {
        let (paper, at) = (paper(), view(UP));
        let steps = 1000;
        let sum: f32 = (0..2 * steps)
            .map(|i| {
                let z = (i as f32 + 0.5) / steps as f32 - 1.0;
                paper.pdf(&at, Vec3::new((1.0 - z * z).sqrt(), 0.0, z)) * 2.0 * PI / steps as f32
            })
            .sum();
        assert!((sum - 1.0).abs() < 1e-4, "{sum}");
    }

    #[test]
    fn light_changes_places_with_the_viewer() {
        let paper = paper();
        for (v, l) in [(UP, Vec3::Z), (UP, -Vec3::Z), (-UP, Vec3::Z), (-UP, -Vec3::Z)] {
            assert_eq!(paper.eval(&view(v), l), paper.eval(&view(l), v));
        }
        assert_eq!(paper.eval(&view(UP), Vec3::Z)[0], 0.7 * FRAC_1_PI);
        assert_eq!(paper.eval(&view(UP), -Vec3::Z)[0], 0.1 * FRAC_1_PI);
        assert!(paper.eval(&view(UP), Vec3::X).is_zero());
    }

    #[test]
    fn a_reflectance_from_an_image_leaves_room_for_what_is_transmitted() {
        let paper = paper();
        let white = paper.with_reflectance(&Lanes::splat(1.0), 1.0);
        assert!(white.albedo().0.iter().all(|sum| (sum - 1.0).abs() < 1e-6));
        let grey = paper.with_reflectance(&Lanes::splat(0.1), 0.1);
        assert!((grey.eval(&view(UP), Vec3::Z)[3] - 0.1 * FRAC_1_PI).abs() < 1e-7);
        assert_eq!(grey.eval(&view(UP), -Vec3::Z), paper.eval(&view(UP), -Vec3::Z));
        let share = paper.share_of_white(&Lanes::splat(0.5));
        for (found, wanted) in share.0.iter().zip([0.5 / 0.9, 0.5 / 0.8, 1.0, 1.0]) {
            assert!((found - wanted).abs() < 1e-6, "{share:?}");
        }
    }

    #[test]
    fn a_side_that_shows_nothing_is_never_drawn() {
        let opaque = Translucent::<4>::new([Lanes::splat(0.5), Lanes::default()], [0.5, 0.0]);
        let clear = Translucent::<4>::new([Lanes::default(), Lanes::splat(0.5)], [0.0, 0.5]);
        let black = Translucent::<4>::new([Lanes::default(); 2], [0.0; 2]);
        for u in [0.0, 0.5, 1.0 - 0.5 * f32::EPSILON] {
            assert!(!opaque.sample(&view(UP), [0.3, 0.3, u]).transmitted);
            assert!(clear.sample(&view(UP), [0.3, 0.3, u]).transmitted);
            assert!(black.sample(&view(UP), [0.3, 0.3, u]).weight.is_zero());
        }
    }
}
