//! What a model says of a direction it has drawn, against what it says of the same direction when asked.
//!
//! For the continuous part, `sample` must give pdf(v, l) and the weight f(v, l) |cos θ_l| / pdf(v, l) of [`eval`]
//! and [`pdf`]; models compute both along shorter ways (microfacet models cancel the distribution), so this is a
//! test of two independent routes to one number. A mean that is right by accident (see [`crate::energy`]) is not
//! enough: here every single direction must agree.
//!
//! [`eval`]: IlluminationModel::eval
//! [`pdf`]: IlluminationModel::pdf

use crate::random::Random;
use crate::site::Site;
use illuminant_illumination::IlluminationModel;

/// The largest differences over the directions drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Disagreement {
    /// Of the weights, relative to the larger or to 10⁻³; infinite when one is no number.
    pub weight: f64,
    /// The direction where that is.
    pub direction: [f64; 3],
    /// Of the densities, relative to the larger.
    pub pdf: f64,
    /// The largest weight of a draw, without the n² of radiance.
    pub largest_weight: f64,
    /// How many directions were compared.
    pub directions: u64,
    /// How many directions said `transmitted` and lay on the side of the viewer, or the other way round.
    pub wrong_side: u64,
    /// How many draws had a weight that was negative or no number, in whatever part.
    pub invalid: u64,
}

/// Compares the draws of a model with its answers.
///
/// Directions closer than `grazing` (|cos θ|) to the horizon are left out, where f32 has lost the half vector;
/// so are discrete lobes and directions that disperse.
///
/// ```
/// use illuminant_illumination::General;
/// use illuminant_sampling::Lanes;
/// use illuminant_verify::{sample_weight::largest_disagreement, site::Site};
/// let paint = General::<4>::Diffuse { brdf: Lanes::splat(0.2), brightness: 0.6 };
/// let found = largest_disagreement(&paint, &Site::new(1.0, 1.0), [0.6, 0.0, 0.8], 0.01, 1000, 0);
/// assert!(found.weight < 1e-5 && found.pdf < 1e-5);
/// ```
#[must_use]
pub fn largest_disagreement<const N: usize>(
    model: &impl IlluminationModel<N>,
    site: &Site<N>,
    to_viewer: [f64; 3],
    grazing: f32,
    samples: u64,
    seed: u64,
) -> Disagreement {
    let at = site.incidence(to_viewer);
    let mut random = Random::new(seed);
    let mut found = Disagreement::default();
    for _ in 0..samples {
        let hero = site.hero_lane.unwrap_or((random.unit() * N as f64) as usize);
        let Some(drawn) = model.sample(&at, random.singles(), Some(hero)) else { continue };
        if site.lanes().any(|lane| !drawn.weight[lane].is_finite() || drawn.weight[lane] < 0.0) {
            found.invalid += 1;
        }
        let squeeze = site.squeeze(to_viewer);
        for lane in site.lanes() {
            let n2 = if drawn.transmitted { squeeze[lane] } else { 1.0 };
            found.largest_weight = found.largest_weight.max(f64::from(drawn.weight[lane]) * n2);
        }
        let opposite = drawn.direction.z * at.to_viewer.z < 0.0;
        if opposite != drawn.transmitted && drawn.direction.z != 0.0 {
            found.wrong_side += 1;
        }
        let Some(density) = drawn.pdf else { continue };
        if drawn.disperses || drawn.direction.z.abs() < grazing {
            continue;
        }
        found.directions += 1;
        let asked = model.pdf(&at, drawn.direction);
        found.pdf = found.pdf.max(relative(density, asked, 0.0));
        let f = model.eval(&at, drawn.direction);
        for lane in site.lanes() {
            let weight = f[lane] * drawn.direction.z.abs() / asked;
            let difference = relative(weight, drawn.weight[lane], 1e-3);
            if difference > found.weight {
                found.weight = difference;
                found.direction = crate::site::double(drawn.direction);
            }
        }
    }
    found
}

fn relative(a: f32, b: f32, floor: f32) -> f64 {
    let difference = f64::from((a - b).abs() / a.max(b).max(floor));
    if difference.is_finite() { difference } else { f64::INFINITY }
}
