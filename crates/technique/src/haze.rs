//! What an atmosphere leaves of what the camera sees (Warnock 1969, Romney 1969; book 4.2.2, eq 4.10).
//!
//! It is an effect for the eye and the same at all wavelengths, so it works on the channels of the film: each is scaled by what is left
//! after the distance to what is seen first, and takes its part of the fog.

use crate::film::{LayerPlan, TERMS};
use crate::path::Primary;
use crate::settings::Layer;
use illuminant_illumination::Atmosphere;
use illuminant_sampling::{Basis, Role};
use illuminant_scene::Scene;
use illuminant_spectrum::Observer;

/// An atmosphere over the channels of a film.
#[derive(Clone, Debug)]
pub(crate) struct Haze {
    atmosphere: Atmosphere,
    /// The channels of light, and what the fog has in each.
    channels: Vec<(usize, f64)>,
}

impl Haze {
    /// The haze of a scene; `None` in clear air.
    pub fn new(scene: &Scene, plan: &[LayerPlan], basis: &dyn Basis) -> Option<Self> {
        let (atmosphere, fog) = &scene.atmosphere;
        if *atmosphere == Atmosphere::Clear {
            return None;
        }
        let xyz = Observer::cie_1931_2deg().xyz(fog, scene.range);
        let mut channels = Vec::new();
        for layer in plan {
            let own = |i: usize| match layer.layer {
                Layer::Xyz => xyz[i],
                Layer::Spectra => basis.reduce(fog, Role::Emission)[i],
                Layer::Terms if layer.name == TERMS[TERMS.len() - 1] => xyz[i],
                // Fog is the light of no lamp and of no term but what is emitted.
                _ => 0.0,
            };
            let light = matches!(layer.layer, Layer::Xyz | Layer::Terms | Layer::Lamps);
            if light || matches!(layer.layer, Layer::Spectra | Layer::LampSpectra) {
                channels.extend(layer.channels.clone().enumerate().map(|(i, channel)| (channel, own(i))));
            }
        }
        Some(Self { atmosphere: *atmosphere, channels })
    }

    /// Applies it to a sample. Surroundings have no distance: fog hides them, a power of the distance leaves them.
    pub fn apply(&self, primary: &Primary, values: &mut [f32]) {
        let distance = match (primary.surface, self.atmosphere) {
            (Some((distance, ..)), _) => f64::from(distance),
            (None, Atmosphere::Fog { end, .. }) => end,
            (None, _) => return,
        };
        for &(channel, fog) in &self.channels {
            values[channel] = self.atmosphere.apply(f64::from(values[channel]), fog, distance) as f32;
        }
    }

    /// Leaves of the light of one surface among others what the air lets pass from its distance; the fog's own light is counted once, by
    /// [`Self::apply`].
    pub fn dim(&self, distance: f32, values: &mut [f32]) {
        for &(channel, _) in &self.channels {
            values[channel] =
                self.atmosphere.apply(f64::from(values[channel]), 0.0, f64::from(distance)) as f32;
        }
    }
}
