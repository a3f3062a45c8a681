//! Less chroma at constant hue, in a uniform space: Oklab or CAM16-UCS.
//!
//! A line leads from a grey, which is inside, to the colour, which is outside; where it leaves the gamut is the answer.
//! In Oklab each channel is a cubic of the place on that line, since cone responses are cubes of what is linear there,
//! so that a place costs three cubics; in CAM16-UCS each costs the inverse of the model. The place is found by
//! bisection to 2⁻²⁴ (2⁻¹⁶ in CAM16-UCS) of the line.
//!
//! The grey of `oklab-adaptive` has the lightness L₀ = ½ (1 + sgn(D) (e − √(e² − 2 |D|))) with D = L − ½ and
//! e = ½ + |D| + α C (Ottosson, "Gamut clipping", 2021), α = 0.05: the farther a colour lies outside, the more it is drawn to
//! the middle, and a bright one keeps some of its chroma.

use illuminant_color::{Cam16, Matrix, Oklab, RgbSystem, Triple};

/// Ottosson's α.
pub(super) const ADAPTIVE: f64 = 0.05;

/// What a line is drawn in.
#[derive(Clone, Debug)]
pub(super) enum Uniform {
    Oklab { to_lms: Matrix, from_lms: Matrix, adaptive: Option<f64> },
    Cam16 { to_xyz: Matrix, from_xyz: Matrix, space: Cam16 },
}

impl Uniform {
    pub(super) fn oklab(system: &RgbSystem, adaptive: Option<f64>) -> Option<Self> {
        let space = Oklab::new(system.to_xyz([1.0; 3]))?;
        let to_lms = space.to_lms().after(&Matrix(system.to_xyz_rows()));
        Some(Self::Oklab { from_lms: to_lms.inverse().ok()?, to_lms, adaptive })
    }

    pub(super) fn cam16(system: &RgbSystem) -> Option<Self> {
        let space = Cam16::new(system.to_xyz([1.0; 3]))?;
        Some(Self::Cam16 {
            to_xyz: Matrix(system.to_xyz_rows()),
            from_xyz: Matrix(system.from_xyz_rows()),
            space,
        })
    }

    /// The colour with the most chroma, at its hue, that lies inside.
    pub(super) fn reduce_chroma(&self, rgb: Triple) -> Triple {
        match self {
            Self::Oklab { to_lms, from_lms, adaptive } => {
                let roots = to_lms.apply(rgb).map(f64::cbrt);
                let [l, a, b] = Oklab::of_roots(roots);
                let grey = adaptive.map_or(l, |alpha| middle(l, a.hypot(b), alpha));
                if grey >= 1.0 {
                    return [1.0; 3];
                }
                if grey <= 0.0 {
                    return [0.0; 3];
                }
                // The roots of cone responses are linear along the line, and equal for a grey.
                let cubics = Cubics::new(from_lms, [grey; 3], roots);
                cubics.at(farthest(24, |part| is_inside(cubics.at(part))))
            }
            Self::Cam16 { to_xyz, from_xyz, space } => {
                let [j, a, b] = space.from_xyz(to_xyz.apply(rgb));
                if j >= 100.0 {
                    return [1.0; 3];
                }
                if j <= 0.0 {
                    return [0.0; 3];
                }
                let at = |part: f64| from_xyz.apply(space.to_xyz([j, a * part, b * part]));
                at(farthest(16, |part| is_inside(at(part))))
            }
        }
    }
}

fn is_inside(rgb: Triple) -> bool {
    rgb.iter().all(|v| (0.0..=1.0).contains(v))
}

/// The largest part of a line, to 2^−`steps`, at which the condition holds; it holds near 0.
fn farthest(steps: u32, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..steps {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    low
}

/// The lightness of the grey towards which a colour goes.
fn middle(lightness: f64, chroma: f64, alpha: f64) -> f64 {
    let d = lightness - 0.5;
    let e = 0.5 + d.abs() + alpha * chroma;
    0.5 * (1.0 + d.signum() * (e - (e * e - 2.0 * d.abs()).max(0.0).sqrt()))
}

/// Each channel as a cubic of the place on a line between two sets of cube roots.
struct Cubics([[f64; 4]; 3]);

impl Cubics {
    fn new(from_lms: &Matrix, start: Triple, end: Triple) -> Self {
        let step: Triple = std::array::from_fn(|i| end[i] - start[i]);
        let powers: [Triple; 4] = [
            start.map(|s| s * s * s),
            std::array::from_fn(|i| 3.0 * start[i] * start[i] * step[i]),
            std::array::from_fn(|i| 3.0 * start[i] * step[i] * step[i]),
            step.map(|d| d * d * d),
        ];
        let of_power = powers.map(|power| from_lms.apply(power));
        Self(std::array::from_fn(|channel| std::array::from_fn(|power| of_power[power][channel])))
    }

    fn at(&self, part: f64) -> Triple {
        self.0.map(|[a, b, c, d]| d.mul_add(part, c).mul_add(part, b).mul_add(part, a))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hue_and_lightness_stay() {
        let system = RgbSystem::named("sRGB").unwrap();
        let space = Oklab::new(system.to_xyz([1.0; 3])).unwrap();
        let map = Uniform::oklab(&system, None).unwrap();
        for rgb in [[1.2, 0.1, 0.0], [-0.2, 0.5, 0.3], [0.1, 0.2, 1.4]] {
            let [l, a, b] = space.from_xyz(system.to_xyz(rgb));
            let [m, c, d] = space.from_xyz(system.to_xyz(map.reduce_chroma(rgb)));
            // The published matrices have ten digits.
            assert!((l - m).abs() < 1e-7, "{rgb:?}");
            assert!((b.atan2(a) - d.atan2(c)).abs() < 1e-6 && c.hypot(d) < a.hypot(b), "{rgb:?}");
        }
    }

    #[test]
    fn the_answer_lies_on_the_edge() {
        let system = RgbSystem::named("sRGB").unwrap();
        let spaces =
            [Uniform::oklab(&system, None), Uniform::oklab(&system, Some(ADAPTIVE)), Uniform::cam16(&system)];
        for map in spaces.into_iter().flatten() {
            let found = map.reduce_chroma([0.6, -0.3, 0.2]);
            let edge = found.iter().map(|v| v.min(1.0 - v)).fold(1.0, f64::min);
            assert!((-1e-12..1e-4).contains(&edge), "{map:?}: {found:?}");
        }
    }
}
