//! Which lamp a point asks.

use crate::geometry::Geometry;
use crate::light_tree::LightTree;
use crate::{Lamp, LampForm};
use glam::Vec3;

/// Chooses a lamp for a point: a function of the point and its normal, so that better choices can take its place.
pub trait LampChooser: Send + Sync {
    /// A lamp and the probability with which it is chosen, from a number in [0, 1); `None` when no lamp can be asked.
    fn choose(&self, lamps: &[Lamp], point: Vec3, normal: Vec3, u: f32) -> Option<(usize, f32)>;

    /// The probability with which a lamp is chosen.
    fn probability(&self, lamps: &[Lamp], point: Vec3, normal: Vec3, lamp: usize) -> f32;
}

/// Up to so many lamps each is weighed for each point.
const WEIGHED: usize = 32;

/// The chooser for these lamps, whose spectra have these luminances (intensities, illuminances): by expected illuminance, of each where
/// they are few, of groups in a [`LightTree`] where they are many.
#[must_use]
pub fn chooser(geometry: &Geometry, lamps: &[Lamp], luminous: &[f64]) -> Box<dyn LampChooser> {
    let luminous: Vec<f32> = luminous.iter().map(|&l| l as f32).collect();
    match lamps.len() {
        1 => Box::new(TheOnly { asked: luminous[0] > 0.0 && !matches!(lamps[0].form, LampForm::Uniform) }),
        n if n <= WEIGHED => Box::new(ByIlluminance { luminous }),
        _ => {
            let of_each = || lamps.iter().zip(&luminous);
            let extents: Vec<_> = of_each().map(|(lamp, &l)| lamp.extent(geometry, l)).collect();
            let anywhere: Vec<f32> =
                of_each().map(|(lamp, &l)| lamp.expected_illuminance(l, Vec3::ZERO)).collect();
            Box::new(LightTree::new(&extents, &anywhere))
        }
    }
}

/// There is one lamp.
#[derive(Clone, Copy, Debug)]
struct TheOnly {
    asked: bool,
}

impl LampChooser for TheOnly {
    #[inline(always)]
    fn choose(&self, _lamps: &[Lamp], _point: Vec3, _normal: Vec3, _u: f32) -> Option<(usize, f32)> {
        self.asked.then_some((0, 1.0))
    }

    #[inline(always)]
    fn probability(&self, _lamps: &[Lamp], _point: Vec3, _normal: Vec3, _lamp: usize) -> f32 {
        f32::from(u8::from(self.asked))
    }
}

/// In proportion to the illuminance that each lamp can be expected to bring to the point.
#[derive(Clone, Debug)]
struct ByIlluminance {
    luminous: Vec<f32>,
}

impl ByIlluminance {
    fn weights(&self, lamps: &[Lamp], point: Vec3) -> ([f32; WEIGHED], f32) {
        let mut weights = [0.0; WEIGHED];
        let mut sum = 0.0;
        for ((weight, lamp), &luminous) in weights.iter_mut().zip(lamps).zip(&self.luminous) {
            *weight = lamp.expected_illuminance(luminous, point);
            sum += *weight;
        }
        (weights, sum)
    }
}

impl LampChooser for ByIlluminance {
    fn choose(&self, lamps: &[Lamp], point: Vec3, _normal: Vec3, u: f32) -> Option<(usize, f32)> {
        let (weights, sum) = self.weights(lamps, point);
        if !(sum > 0.0 && sum.is_finite()) {
            return None;
        }
        let mut left = u * sum;
        let mut last = None;
        for (lamp, &weight) in weights[..lamps.len()].iter().enumerate() {
            if weight > 0.0 {
                last = Some((lamp, weight / sum));
                left -= weight;
                if left < 0.0 {
                    break;
                }
            }
        }
        last
    }

    fn probability(&self, lamps: &[Lamp], point: Vec3, _normal: Vec3, lamp: usize) -> f32 {
        let (weights, sum) = self.weights(lamps, point);
        if sum > 0.0 && sum.is_finite() { weights[lamp] / sum } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Motion, Placement, Shape};
    use illuminant_spectrum::Curve;

    fn lamps(n: usize) -> Vec<Lamp> {
        let lamp = |i: usize| Lamp {
            name: i.to_string(),
            spectrum: Curve::constant(1.0),
            form: LampForm::Point { position: Vec3::new(i as f32, 0.0, 1.0) },
        };
        (0..n).map(lamp).collect()
    }

    #[test]
    fn chance_follows_probability() {
        let ball = Shape::Sphere { center: Vec3::ZERO, radius: 1.0, turn: glam::Mat3::IDENTITY };
        let still = Motion::new(vec![glam::Affine3A::IDENTITY]).unwrap();
        let placement = Placement { shape: 0, motion: still };
        let geometry = Geometry::new(vec![ball], vec![placement], 1).unwrap();
        for n in [1, 5, 40] {
            let lamps = lamps(n);
            let luminous: Vec<f64> = (0..n).map(|i| if i == 2 { 0.0 } else { 1.0 + i as f64 }).collect();
            let chooser = chooser(&geometry, &lamps, &luminous);
            let point = Vec3::new(0.5, 0.2, 0.0);
            let mut found = vec![0u32; n];
            let trials = 20_000;
            for i in 0..trials {
                let u = (i as f32 + 0.5) / trials as f32;
                let (lamp, probability) = chooser.choose(&lamps, point, Vec3::Z, u).unwrap();
                assert!((probability - chooser.probability(&lamps, point, Vec3::Z, lamp)).abs() < 1e-6);
                found[lamp] += 1;
            }
            for (lamp, &count) in found.iter().enumerate() {
                let probability = f64::from(chooser.probability(&lamps, point, Vec3::Z, lamp));
                assert!((f64::from(count) / f64::from(trials) - probability).abs() < 2e-4, "{n} {lamp}");
            }
        }
    }
}
