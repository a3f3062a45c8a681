//! A point of a surface: the media above and below it.
//!
//! An [`Incidence`] belongs to one direction of view; reciprocity and energy look from both sides. A [`Site`]
//! holds what both views share and makes the incidence of either.

use glam::Vec3;
use illuminant_illumination::{IlluminationModel, Incidence, Index};
use illuminant_sampling::Lanes;

/// A medium at one side of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Medium<const N: usize> {
    /// Index of refraction at the representative wavelength.
    pub mean: f32,
    /// The smallest over the range.
    pub least: f32,
    /// Index in every lane.
    pub lanes: Lanes<N>,
}

impl<const N: usize> Medium<N> {
    /// A medium with one index n > 0 at all wavelengths.
    #[must_use]
    pub fn uniform(n: f32) -> Self {
        Self { mean: n, least: n, lanes: Lanes::splat(n) }
    }

    /// A medium whose index goes evenly from one end of the lanes to the other.
    #[must_use]
    pub fn graded(first: f32, last: f32) -> Self {
        let step = (last - first) / (N.max(2) - 1) as f32;
        let lanes = Lanes(std::array::from_fn(|i| first + step * i as f32));
        Self { mean: 0.5 * (first + last), least: first.min(last), lanes }
    }

    fn index(&self) -> Index<'_, N> {
        Index { mean: self.mean, least: self.least, lanes: &self.lanes }
    }
}

/// The two media at a point of a surface, and the lane that a path still carries there.
///
/// ```
/// use illuminant_verify::site::Site;
/// let glass = Site::<8>::new(1.0, 1.5);
/// assert_eq!(glass.incidence([0.0, 0.0, 1.0]).far.mean, 1.5);
/// assert_eq!(glass.incidence([0.0, 0.0, -1.0]).far.mean, 1.0);
/// assert_eq!(glass.squeeze([0.0, 0.0, 1.0])[0], 2.25);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Site<const N: usize> {
    /// Where z > 0.
    pub above: Medium<N>,
    /// Where z < 0.
    pub below: Medium<N>,
    /// The one lane still carried by a path that has been dispersed before; the testers then look at no other.
    pub hero_lane: Option<usize>,
}

impl<const N: usize> Site<N> {
    /// Between two media without dispersion.
    #[must_use]
    pub fn new(above: f32, below: f32) -> Self {
        Self { above: Medium::uniform(above), below: Medium::uniform(below), hero_lane: None }
    }

    /// The same turned upside down.
    #[must_use]
    pub fn flipped(self) -> Self {
        Self { above: self.below, below: self.above, ..self }
    }

    /// The medium on the side of a direction.
    #[must_use]
    pub fn side(&self, direction: [f64; 3]) -> &Medium<N> {
        if direction[2] > 0.0 { &self.above } else { &self.below }
    }

    /// What a model is told when it is looked at from this direction.
    #[must_use]
    pub fn incidence(&self, to_viewer: [f64; 3]) -> Incidence<'_, N> {
        let (near, far) =
            if to_viewer[2] > 0.0 { (&self.above, &self.below) } else { (&self.below, &self.above) };
        Incidence {
            to_viewer: single(to_viewer),
            near: near.index(),
            far: far.index(),
            hero_lane: self.hero_lane,
        }
    }

    /// (n_far / n_near)² in every lane: what turns a transmitted share of radiance into one of power.
    #[must_use]
    pub fn squeeze(&self, to_viewer: [f64; 3]) -> [f64; N] {
        let at = self.incidence(to_viewer);
        std::array::from_fn(|i| (f64::from(at.far.lanes[i]) / f64::from(at.near.lanes[i])).powi(2))
    }

    /// The lanes that mean something here: all, or the one still carried.
    pub fn lanes(&self) -> impl Iterator<Item = usize> + Clone + use<N> {
        match self.hero_lane {
            Some(lane) => lane..lane + 1,
            None => 0..N,
        }
    }

    /// f(v, l) of a model, 1/sr, in f64.
    #[must_use]
    pub fn eval(&self, model: &impl IlluminationModel<N>, v: [f64; 3], l: [f64; 3]) -> [f64; N] {
        model.eval(&self.incidence(v), single(l)).0.map(f64::from)
    }
}

/// The direction as a model takes it.
#[must_use]
pub fn single(direction: [f64; 3]) -> Vec3 {
    Vec3::from(direction.map(|x| x as f32))
}

/// The direction as the testers take it.
#[must_use]
pub fn double(direction: Vec3) -> [f64; 3] {
    direction.to_array().map(f64::from)
}
