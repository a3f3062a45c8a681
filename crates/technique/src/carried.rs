//! What a path carries from surface to surface, whether it began at the camera or at a lamp.

use crate::interaction::Interaction;
use crate::lanes::Pass;
use crate::media::Media;
use glam::Vec3;
use illuminant_illumination::{IlluminationModel, Prepare};
use illuminant_sampling::Lanes;
use illuminant_scene::SurfacePoint;

/// After this many segments a path may be ended by chance.
pub(crate) const ROULETTE_FROM: u32 = 5;

/// The state of a path that matters to both of its ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Carried<const N: usize> {
    /// What light is multiplied by from the other end to here, in every lane.
    pub throughput: Lanes<N>,
    /// The same for the whole spectrum as one number, which decides a path's length.
    pub brightness: f32,
    /// The bodies that it is in.
    pub media: Media,
    /// The sample that is left after a dispersive refraction.
    pub hero: Option<usize>,
    /// The first of the bundles that take the light: those of dispersed light are others.
    pub bundle: usize,
}

/// Where a path goes on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    /// Unit, in the world.
    pub direction: Vec3,
    /// Density, 1/sr; `None` for a direction that no density knows.
    pub pdf: Option<f32>,
    /// Whether it goes through the surface.
    pub transmitted: bool,
}

impl<const N: usize> Carried<N> {
    /// In the open.
    pub fn new(throughput: Lanes<N>) -> Self {
        Self { throughput, brightness: 1.0, media: Media::default(), hero: None, bundle: 0 }
    }

    /// Russian roulette by brightness: whether the path goes on, which then counts for those that do not.
    #[inline(always)]
    pub fn survives(&mut self, u: f32) -> bool {
        let survival = self.brightness.min(0.98);
        if u >= survival {
            return false;
        }
        self.throughput *= survival.recip();
        self.brightness /= survival;
        true
    }

    /// Draws the direction in which a path goes on from a surface that it reached along `along`; `None` where it ends.
    #[inline(always)]
    pub fn turn<M: IlluminationModel<N> + Prepare>(
        &mut self,
        pass: &Pass<N, M>,
        met: &Interaction<'_, N, M>,
        point: &SurfacePoint,
        along: Vec3,
        u: [f32; 3],
        u_hero: f32,
    ) -> Option<Turn> {
        let model = met.model();
        // The sample that a dispersive refraction here would keep: the path's own wavelength, or any of `1nm`.
        let (hero_sample, factor) = match pass.carried {
            Some(own) => (own, 1.0),
            None => (((u_hero * pass.total as f32) as usize).min(pass.total - 1), pass.total as f32),
        };
        let hero_lane = pass.lane(self.hero.unwrap_or(hero_sample));
        let drawn = model.sample(&met.at, u, hero_lane)?;
        let direction = met.frame.to_world(drawn.direction);
        let outward = direction.dot(point.geometric_normal);
        // Light must leave on the side on which the model says it does.
        if (outward * along.dot(point.geometric_normal) < 0.0) == drawn.transmitted {
            return None;
        }
        self.throughput *= drawn.weight;
        self.brightness *= drawn.brightness;
        if drawn.disperses {
            self.throughput = self.throughput.only(hero_lane?, factor);
            self.hero = Some(hero_sample);
            self.bundle = pass.dispersed.unwrap_or(0);
        }
        if drawn.transmitted && model.bounds_media() {
            self.media = met.beyond;
        }
        Some(Turn { direction, pdf: drawn.pdf, transmitted: drawn.transmitted })
    }
}
