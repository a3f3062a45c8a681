//! What becomes of the light that reaches a material, and by how much it breaks the laws that its model claims.
//!
//! For each angle and wavelength the power that arrives is divided into coherent and scattered reflection, coherent and
//! scattered transmission, and absorption. Equilibrium (book eq 2.50) is judged on the material's lossless twin
//! ([`Material::lossless`]), in which nothing may be absorbed.
//!
//! ```
//! use illuminant_illumination::{Illumination, Material, Surface};
//! use illuminant_spectrum::Curve;
//! use illuminant_verify::audit::{Question, audit};
//! let paint = Material::new("grey", Surface::Diffuse { reflectance: Curve::constant(0.4) });
//! let question = Question { wavelengths_nm: vec![550.0], angles_deg: vec![0.0, 60.0], draws: 2000 };
//! let found = audit(&paint, Illumination::General, &question);
//! assert!((found.scattered_reflection[1][0] - 0.4).abs() < 1e-3);
//! assert!(found.equilibrium.largest < 1e-3 && found.reciprocity < 1e-4 && found.normalisation < 0.01);
//! ```

use crate::chi_square::ChiSquare;
use crate::energy::by_drawing;
use crate::reciprocity::Reciprocity;
use crate::sample_weight::largest_disagreement;
use crate::site::{Medium, Site};
use illuminant_illumination::{
    Claims, General, Historic, Illumination, IlluminationModel, Material, Prepare, REPRESENTATIVE_NM, Surface,
};
use illuminant_sampling::{Basis, Lanes, Role, ToXyz};
use illuminant_spectrum::{Curve, SpectralRange};

/// Lanes that are audited side by side.
const LANES: usize = 8;

/// What to look at.
#[derive(Clone, Debug)]
pub struct Question {
    /// Wavelengths, nm.
    pub wavelengths_nm: Vec<f64>,
    /// Angles of incidence from the normal, degrees: above 90 from inside, which opaque materials skip.
    pub angles_deg: Vec<f64>,
    /// Directions to draw for each.
    pub draws: u64,
}

/// The largest violation of a law, and where it is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Largest {
    /// By how much.
    pub largest: f64,
    /// At this angle, degrees.
    pub angle_deg: f64,
    /// At this wavelength, nm.
    pub wavelength_nm: f64,
}

/// What was found. Shares of power are [angle][wavelength].
#[derive(Clone, Debug)]
pub struct Audit {
    /// The angles that were looked at, degrees.
    pub angles_deg: Vec<f64>,
    /// Reflected in the mirror direction.
    pub coherent_reflection: Vec<Vec<f64>>,
    /// Reflected elsewhere.
    pub scattered_reflection: Vec<Vec<f64>>,
    /// Refracted as by a smooth boundary.
    pub coherent_transmission: Vec<Vec<f64>>,
    /// Transmitted elsewhere.
    pub scattered_transmission: Vec<Vec<f64>>,
    /// How much more leaves than came.
    pub gain: Largest,
    /// How far the lossless twin is from returning all.
    pub equilibrium: Largest,
    /// The largest relative difference of f(v, l)/n² with v and l exchanged.
    pub reciprocity: f64,
    /// The largest difference between ∫ pdf and the share of draws that it should have.
    pub normalisation: f64,
    /// The smallest p-value of the chi-square tests, one for each angle.
    pub p_value: f64,
    /// The largest weight of a drawn direction.
    pub weight: f64,
    /// The laws that the model claims.
    pub claims: Claims,
}

/// Some wavelengths as the samples of a basis.
#[derive(Debug)]
struct Wavelengths<'a>(&'a [f64]);

impl Basis for Wavelengths<'_> {
    fn len(&self) -> usize {
        self.0.len()
    }

    fn wavelength_nm(&self, sample: usize) -> f64 {
        self.0[sample]
    }

    fn reduce(&self, curve: &Curve, _role: Role) -> Vec<f64> {
        self.0.iter().map(|&nm| curve.at(nm)).collect()
    }

    fn to_xyz(&self, _lamp: usize) -> ToXyz {
        std::array::from_fn(|_| vec![0.0; self.0.len()])
    }
}

/// The media above and below a material.
fn site(material: &Material, wavelengths: &[f64], range: SpectralRange) -> Site<LANES> {
    let mut site = Site::new(1.0, 1.0);
    if let Surface::Dielectric { n, dispersion, .. } = &material.surface {
        let mean = n.at(REPRESENTATIVE_NM) as f32;
        let mut lanes = Lanes::splat(mean);
        let mut least = mean;
        if *dispersion {
            for (lane, &nm) in wavelengths.iter().enumerate() {
                lanes[lane] = n.at(nm) as f32;
            }
            least = n.extent(range).0 as f32;
        }
        site.below = Medium { mean, least, lanes };
    }
    site
}

/// Looks at a material by a model.
#[must_use]
pub fn audit(material: &Material, illumination: Illumination, question: &Question) -> Audit {
    match illumination {
        Illumination::General => audit_model::<General<LANES>>(material, illumination, question),
        _ => audit_model::<Historic<LANES>>(material, illumination, question),
    }
}

fn audit_model<M: IlluminationModel<LANES> + Prepare>(
    material: &Material,
    illumination: Illumination,
    question: &Question,
) -> Audit {
    let range = SpectralRange::default();
    let lossless = material.lossless();
    let transparent = matches!(material.surface, Surface::Dielectric { .. });
    let angles: Vec<f64> =
        question.angles_deg.iter().copied().filter(|&angle| transparent || angle < 90.0).collect();
    let table = || vec![vec![0.0; question.wavelengths_nm.len()]; angles.len()];
    let prepared = |material: &Material, wavelengths: &[f64]| {
        M::prepare(
            material,
            illumination,
            material.brightness(range) as f32,
            &Wavelengths(wavelengths),
            0..wavelengths.len(),
            range,
        )
    };
    let mut found = Audit {
        coherent_reflection: table(),
        scattered_reflection: table(),
        coherent_transmission: table(),
        scattered_transmission: table(),
        gain: Largest::default(),
        equilibrium: Largest::default(),
        reciprocity: 0.0,
        normalisation: 0.0,
        p_value: 1.0,
        weight: 0.0,
        claims: prepared(material, &question.wavelengths_nm[..question.wavelengths_nm.len().min(LANES)])
            .claims(),
        angles_deg: angles.clone(),
    };
    for (group, wavelengths) in question.wavelengths_nm.chunks(LANES).enumerate() {
        // No lane is left empty: testers look at all.
        let filled: [f64; LANES] = std::array::from_fn(|i| wavelengths[i.min(wavelengths.len() - 1)]);
        let (model, twin) = (prepared(material, &filled), prepared(&lossless, &filled));
        let mut site = site(material, &filled, range);
        if !model.bounds_media() {
            // Who looks straight through a body enters no medium.
            site.below = site.above;
        }
        let reciprocity = Reciprocity { pairs: 2000, ..Reciprocity::default() };
        // Before it is dispersed, a path knows no function of two directions through dispersive glass.
        let mut alone = site;
        if transparent && site.below.least != site.below.mean {
            alone.hero_lane = Some(0);
        }
        found.reciprocity = found.reciprocity.max(reciprocity.largest_of_model(&model, &alone).relative);
        for (i, &angle) in angles.iter().enumerate() {
            let (sin, cos) = angle.to_radians().sin_cos();
            let v = [sin * 0.8, sin * 0.6, cos];
            let squeeze = site.squeeze(v);
            let share = |model: &M| {
                let mut all = by_drawing(model, &site, v, question.draws, i as u64).albedo;
                // Where light is dispersed, every lane is looked at by itself.
                for lane in (0..wavelengths.len()).filter(|_| alone.hero_lane.is_some()) {
                    let one = Site { hero_lane: Some(lane), ..site };
                    let found = by_drawing(model, &one, v, question.draws, i as u64).albedo;
                    all.reflected[lane] = found.reflected[lane];
                    all.transmitted[lane] = found.transmitted[lane];
                }
                all
            };
            let (all, whole) = (share(&model), share(&twin).total());
            let (mut mirror, mut straight) = ([0.0; LANES], [0.0; LANES]);
            for lane in 0..wavelengths.len() {
                // Each lane is refracted by itself.
                let mut at = site;
                at.hero_lane = Some(lane).filter(|_| transparent);
                for lobe in model.discrete_lobes(&at.incidence(v)) {
                    let weight = f64::from(lobe.weight[lane]);
                    if lobe.transmitted {
                        straight[lane] += weight * squeeze[lane];
                    } else {
                        mirror[lane] += weight;
                    }
                }
            }
            for (lane, &nm) in wavelengths.iter().enumerate() {
                let w = group * LANES + lane;
                found.coherent_reflection[i][w] = mirror[lane];
                found.coherent_transmission[i][w] = straight[lane];
                found.scattered_reflection[i][w] = (all.reflected[lane] - mirror[lane]).max(0.0);
                found.scattered_transmission[i][w] = (all.transmitted[lane] - straight[lane]).max(0.0);
                let more = all.total()[lane] - 1.0;
                for (law, by) in
                    [(&mut found.gain, more.max(0.0)), (&mut found.equilibrium, (whole[lane] - 1.0).abs())]
                {
                    if by > law.largest {
                        *law = Largest { largest: by, angle_deg: angle, wavelength_nm: nm };
                    }
                }
            }
            if group == 0 {
                if model.is_continuous() {
                    let test = ChiSquare { samples: question.draws, seed: i as u64, ..ChiSquare::default() };
                    let outcome = test.run_model(&model, &alone, v);
                    let share = outcome.directions as f64 / question.draws.max(1) as f64;
                    found.normalisation = found.normalisation.max((outcome.probability - share).abs());
                    found.p_value = found.p_value.min(outcome.p_value);
                }
                let drawn = largest_disagreement(&model, &alone, v, 0.01, question.draws.min(2000), i as u64);
                found.weight = found.weight.max(drawn.largest_weight);
            }
        }
    }
    found
}
