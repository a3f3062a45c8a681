//! Transforms as functions of time.

use glam::{Affine3A, Mat3A, Vec3A};

/// A transform from object to world at every moment of the shutter: keys evenly spread over time 0 to 1, their
/// matrices joined by straight lines (as Embree does). One key is a thing at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    keys: Vec<Affine3A>,
}

impl Default for Motion {
    fn default() -> Self {
        Self { keys: vec![Affine3A::IDENTITY] }
    }
}

impl Motion {
    /// A motion through keys; `None` when there is no key, or one is singular or not finite.
    #[must_use]
    pub fn new(keys: Vec<Affine3A>) -> Option<Self> {
        let sound = |key: &Affine3A| key.is_finite() && key.matrix3.determinant().abs() > 1e-30;
        (!keys.is_empty() && keys.iter().all(sound)).then_some(Self { keys })
    }

    /// The keys.
    #[must_use]
    pub fn keys(&self) -> &[Affine3A] {
        &self.keys
    }

    /// Whether the thing is at rest.
    #[must_use]
    pub fn is_static(&self) -> bool {
        self.keys.iter().all(|key| *key == self.keys[0])
    }

    /// The transform at a time from 0 to 1.
    #[must_use]
    pub fn at(&self, time: f32) -> Affine3A {
        let last = self.keys.len() - 1;
        if last == 0 {
            return self.keys[0];
        }
        let position = time.clamp(0.0, 1.0) * last as f32;
        let i = (position as usize).min(last - 1);
        let t = position - i as f32;
        let (a, b) = (self.keys[i], self.keys[i + 1]);
        let mix = |a: Vec3A, b: Vec3A| a + (b - a) * t;
        Affine3A {
            matrix3: Mat3A::from_cols(
                mix(a.matrix3.x_axis, b.matrix3.x_axis),
                mix(a.matrix3.y_axis, b.matrix3.y_axis),
                mix(a.matrix3.z_axis, b.matrix3.z_axis),
            ),
            translation: mix(a.translation, b.translation),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn half_way_is_half_way() {
        let keys = [0.0, 2.0].map(|x| Affine3A::from_translation(Vec3::new(x, 0.0, 0.0)));
        let motion = Motion::new(keys.to_vec()).unwrap();
        assert_eq!(motion.at(0.5).translation.x, 1.0);
        assert!(!motion.is_static() && Motion::default().is_static());
        assert!(Motion::new(vec![Affine3A::from_scale(Vec3::ZERO)]).is_none());
    }
}
