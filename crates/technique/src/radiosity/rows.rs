//! Rows of form factors found one range at a time, for work that is shared out among machines.

use super::cutting::cut;
use super::reflectance::Counted;
use super::solution::{LANES, counted, prepared, with_model};
use crate::render::pool;
use crate::scene_products::basis;
use crate::settings::Settings;
use illuminant_illumination::{General, Historic, Illumination, IlluminationModel, Prepare};
use illuminant_radiosity::{Cancel, Elements, FormFactors, Method, Sparse};
use illuminant_sampling::Basis;
use illuminant_scene::Scene;
use std::ops::Range;
use std::sync::Arc;

/// What finds rows of form factors of a scene.
pub struct RowFinder {
    scene: Arc<Scene>,
    elements: Elements,
    method: Method,
    pool: rayon::ThreadPool,
}

impl RowFinder {
    /// Cuts the surfaces of a scene as a solution does.
    ///
    /// # Errors
    /// A sentence on what cannot be: rows on their own exist for `radiosity` alone, since those of `hybrid` follow mirrors together with
    /// the light of lamps. What is cancelled has no result.
    pub fn new(scene: Arc<Scene>, settings: &Settings, cancel: &Cancel) -> Result<Self, String> {
        if settings.technique != "radiosity" {
            return Err(format!(
                "{} has no rows of form factors on their own; radiosity has",
                settings.technique
            ));
        }
        let (method, _) = settings.radiosity.checked()?;
        let pool = pool(settings.threads).map_err(|e| e.to_string())?;
        let elements = pool.install(|| {
            let basis = basis(&scene, settings, cancel).map_err(|e| e.to_string())?;
            with_model!(settings, elements(&scene, settings, &*basis, cancel))
        })?;
        Ok(Self { scene, elements, method, pool })
    }

    /// How many rows there are: one for each side that light reaches.
    #[must_use]
    pub fn sides(&self) -> usize {
        self.elements.sides.len()
    }

    /// How long rows are: the number of patches.
    #[must_use]
    pub fn width(&self) -> usize {
        self.elements.patches.len()
    }

    /// The rows of a range of sides, the very ones that a solution finds; those that are cancelled are empty.
    #[must_use]
    pub fn find(&self, sides: Range<usize>, cancel: &Cancel) -> Sparse {
        let end = sides.end.min(self.sides());
        let sides: Vec<u32> = (sides.start.min(end)..end).map(|side| side as u32).collect();
        let (elements, geometry) = (&self.elements, &self.scene.geometry);
        self.pool.install(|| FormFactors::of(elements, &sides, geometry, self.method, cancel).rows)
    }
}

fn elements<M: IlluminationModel<LANES> + Prepare>(
    illumination: Illumination,
    scene: &Scene,
    settings: &Settings,
    basis: &dyn Basis,
    cancel: &Cancel,
) -> Result<Elements, String> {
    let (passes, ..) = prepared::<M>(illumination, scene, basis);
    debug_assert!(matches!(counted(settings), Counted::All));
    cut(scene, (&settings.radiosity, counted(settings)), &passes, cancel)
}
