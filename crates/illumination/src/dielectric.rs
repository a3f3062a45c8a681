//! A dielectric boundary: smooth, or with facets that reflect and refract.

use crate::coherence::{Closed, Coherent};
use crate::model::{DiscreteLobe, Incidence, Scattered};
use crate::rough_boundary::{Pair, RoughBoundary};
use crate::{Finish, Spectral};
use glam::Vec3;
use illuminant_optics::fresnel::dielectric;
use illuminant_optics::multiple_scattering::Sides;
use illuminant_optics::vectors::{dot, reflect, refract};
use illuminant_sampling::Lanes;
use std::sync::Arc;

/// dω_h / dω_l of a refraction at a facet (Walter et al. 2007, eq 17); `cos_l` is negative.
#[inline(always)]
fn transmission_jacobian(cos_v: f32, cos_l: f32, eta: f32) -> f32 {
    let denominator = cos_v + eta * cos_l;
    eta * eta * -cos_l / (denominator * denominator)
}

/// Whether two media have one index, to the rounding of f32: then their boundary is none.
#[inline(always)]
fn is_matched(eta: f32) -> bool {
    (eta - 1.0).abs() < 1e-6
}

/// The boundary between two dielectrics as a path sees it that may carry one lane only.
struct Boundary<const N: usize> {
    /// n_far / n_near by which directions are bent.
    eta: f32,
    /// Reflectance by which the choice between the two sides is made, at the representative wavelength.
    choice: f32,
    /// Relative index of every lane.
    relative: Lanes<N>,
    /// Whether the transmitted direction belongs to one lane only.
    disperses: bool,
}

impl<const N: usize> Boundary<N> {
    /// `cos` is the angle at the boundary (of the surface, or of a facet).
    #[inline(always)]
    fn new(at: &Incidence<'_, N>, dispersive: bool, hero: Option<usize>, cos: f32) -> Self {
        let relative = *at.far.lanes / *at.near.lanes;
        if let Some(lane) = at.hero_lane {
            let eta = relative.0[lane];
            return Self { eta, choice: dielectric(cos, eta), relative, disperses: false };
        }
        let mean = at.far.mean / at.near.mean;
        let choice = dielectric(cos, mean);
        if !dispersive {
            return Self { eta: mean, choice, relative: Lanes::splat(mean), disperses: false };
        }
        // Near the critical angle some wavelengths pass where the representative one does not; as long as any
        // might, the choice leaves a chance.
        let passes = [at.far.least / at.near.mean, at.far.mean / at.near.least]
            .iter()
            .any(|&eta| dielectric(cos, eta) < 1.0);
        let choice = if passes { choice.min(0.9) } else { choice };
        let eta = hero.map_or(mean, |lane| relative.0[lane]);
        Self { eta, choice, relative, disperses: true }
    }

    #[inline(always)]
    fn reflectance(&self, cos: f32) -> Lanes<N> {
        self.relative.map(|eta| dielectric(cos, eta))
    }

    /// What passes between two cosines of refraction, found on the side of the smaller index, where it has all its digits.
    #[inline(always)]
    fn transmittance(&self, cos_near: f32, cos_far: f32) -> Lanes<N> {
        let pass = |eta: f32| {
            let (cos, eta) = if eta < 1.0 { (cos_far, eta.recip()) } else { (cos_near, eta) };
            1.0 - dielectric(cos, eta)
        };
        self.relative.map(pass)
    }
}

/// A dielectric boundary in the lanes of one pass.
#[derive(Clone, Debug)]
pub struct Dielectric<const N: usize> {
    /// Whether lanes part ways when refracted.
    dispersive: bool,
    rough: Option<Arc<RoughBoundary<N>>>,
}

/// A view of a rough boundary, from above after flipping.
struct Seen<'a, const N: usize> {
    pair: &'a Pair<N>,
    /// 0 where the viewer is on the side of the normal.
    side: usize,
    /// Index of the other side relative to the viewer's.
    eta: f32,
    v: Vec3,
    /// What stays coherent of the view in lanes, and at both ends of the spectrum.
    coherent: Option<(Coherent<N>, Coherent<2>)>,
    /// The chances of multiple scattering above and below.
    several: [f32; 2],
    /// Those of the rest above and below.
    rest: [f32; 2],
    /// What stays coherent of the light that is reflected and of that which goes through, as one number each.
    kept: [f32; 2],
    /// What facets scatter of either.
    loose: [f32; 2],
}

impl<const N: usize> Seen<'_, N> {
    /// The chance with which a facet reflects that has the reflectance `choice`: by what of either is scattered.
    #[inline(always)]
    fn choice(&self, choice: f32) -> f32 {
        let [back, through] = [choice * self.loose[0], (1.0 - choice) * self.loose[1]];
        if back + through > 0.0 { back / (back + through) } else { choice }
    }

    /// The sides between which light goes to the viewer's side, and to the other.
    #[inline(always)]
    fn sides(&self) -> [Sides; 2] {
        if self.side == 0 { [Sides::First, Sides::Through] } else { [Sides::Second, Sides::Back] }
    }
}

impl<const N: usize> Dielectric<N> {
    /// A boundary with a finish.
    #[must_use]
    pub fn new(dispersive: bool, finish: &Finish, spectral: &Spectral<N>) -> Self {
        let rough = (!finish.is_smooth()).then(|| Arc::new(RoughBoundary::new(finish, spectral)));
        Self { dispersive, rough }
    }

    pub(crate) fn gloss(&self) -> f32 {
        self.rough.as_ref().map_or(0.0, |rough| rough.gloss())
    }

    /// The relief as it is seen; `None` where there is none, or both media are one.
    #[inline(always)]
    fn seen<'a>(&'a self, at: &Incidence<'_, N>) -> Option<Seen<'a, N>> {
        let rough = self.rough.as_deref()?;
        let eta = at.far.mean / at.near.mean;
        if is_matched(eta) {
            return None;
        }
        let flip = 1f32.copysign(at.to_viewer.z);
        let v = at.to_viewer * flip;
        let side = usize::from(flip < 0.0);
        let pair = rough.pair(if side == 0 { eta } else { at.near.mean / at.far.mean });
        let grid = &pair.relief.balance.grids[side];
        let coherent = pair.coherence().map(|(lanes, ends)| {
            let mean = Lanes::splat(at.near.mean);
            (
                lanes.at(grid, side, at.near.lanes, Some(eta), v),
                ends.closed.at(grid, side, &mean, Some(eta), v),
            )
        });
        let mut several = pair.relief.shares(side, v);
        let (mut rest, mut kept, mut loose) = ([0.0; 2], [0.0; 2], [1.0; 2]);
        if let (Some((_, ends)), Some((_, closed))) = (&coherent, pair.coherence()) {
            let power = |a: &Lanes<2>| 0.5 * (a.0[0] * a.0[0] + a.0[1] * a.0[1]);
            kept = [power(&ends.back), power(&ends.through)];
            loose = [0.5 * (ends.loose.0[0] + ends.loose.0[1]), 1.0 - kept[1]];
            let scattered = |i: usize| {
                let fresnel = dielectric(v.z, eta);
                1.0 - fresnel * ends.back.0[i].powi(2) - (1.0 - fresnel) * ends.through.0[i].powi(2)
            };
            let all = (ends.rest.0[0] + ends.rest.0[1]) / (scattered(0) + scattered(1)).max(1e-6);
            let all = all.min(0.9);
            rest = [side, 1 - side].map(|side| all * closed.rest_share(side));
            several = several.map(|s| s * (1.0 - all));
        }
        Some(Seen { pair, side, eta, v, coherent, several, rest, kept, loose })
    }

    /// f |cos θ_l| of what is scattered, and its density (Walter et al. 2007, eqs 20, 21; 14 and 17 for the densities); `l` is flipped like the
    /// view.
    #[inline(always)]
    fn scattered(&self, at: &Incidence<'_, N>, seen: &Seen<'_, N>, l: Vec3) -> (Lanes<N>, f32) {
        let (relief, v) = (&*seen.pair.relief, seen.v);
        let facets = &relief.facets;
        let (va, la) = (v.to_array(), l.to_array());
        let [back, through] = seen.kept;
        let mirror = Boundary::new(at, self.dispersive, at.hero_lane, v.z).choice;
        let scatters = 1.0 - mirror * back - (1.0 - mirror) * through;
        let facet_chance = 1.0 - seen.rest[0] - seen.rest[1] - seen.several[0] - seen.several[1];
        let mut f = Lanes::default();
        let mut visible = 0.0;
        let reflects = l.z > 0.0;
        if reflects {
            // The cosine from the length of V + L, which is the same for both: near the critical angle F hangs on its last digits.
            let sum = v + l;
            let cos = 0.5 * sum.length();
            let h = sum.normalize_or_zero();
            if h.z > 0.0 && cos > 0.0 {
                let boundary = Boundary::new(at, self.dispersive, at.hero_lane, cos);
                let ha = h.to_array();
                let shape = facets.distribution(ha) * facets.masking_shadowing(va, la) / (4.0 * v.z);
                f = boundary.reflectance(cos) * shape;
                visible = seen.choice(boundary.choice) * facets.pdf_visible(va, ha) / (4.0 * cos);
            }
        } else {
            let boundary = Boundary::new(at, self.dispersive, at.hero_lane, 1.0);
            // Undispersed paths meet the facets of dispersive glass only by drawing: each lane has its own direction.
            if !boundary.disperses {
                // Written in terms that are the same when both directions change places, rounding included.
                let (near, far) = at.hero_lane.map_or((at.near.mean, at.far.mean), |lane| {
                    (at.near.lanes.0[lane], at.far.lanes.0[lane])
                });
                let h = (v * near + l * far).normalize_or_zero();
                let h = h * 1f32.copysign(h.z);
                let (cos_v, cos_l) = (v.dot(h), l.dot(h));
                if cos_v > 0.0 && cos_l < 0.0 {
                    let ha = h.to_array();
                    let denominator = near * cos_v + far * cos_l;
                    let squeezed = -cos_v * cos_l * near * near / (denominator * denominator);
                    let shape = facets.distribution(ha) * facets.masking_shadowing(va, la) * squeezed / v.z;
                    f = boundary.transmittance(cos_v, -cos_l) * shape;
                    let choice = Boundary::new(at, self.dispersive, at.hero_lane, cos_v).choice;
                    let jacobian = transmission_jacobian(cos_v, cos_l, boundary.eta);
                    visible = (1.0 - seen.choice(choice)) * facets.pdf_visible(va, ha) * jacobian;
                }
            }
        }
        let other = usize::from(!reflects);
        let multiple = relief.multiple(seen.sides()[other], v, Vec3::new(l.x, l.y, l.z.abs()));
        let n2 = if reflects { 1.0 } else { Self::squeeze(at, seen) };
        f += Lanes::splat(multiple.values[0] * n2 * l.z.abs());
        if let (Some((coherent, _)), Some((closed, _))) = (&seen.coherent, seen.pair.coherence()) {
            let to = Self::towards(closed, at, seen, l);
            let kept = if reflects { coherent.back * to.back } else { coherent.through * to.through };
            f = f * coherent.factor * to.factor * kept.map(|k| 1.0 - k);
            f += closed.rest(coherent, &to) * (Self::squeeze(at, seen) * l.z.abs());
        }
        let mut lobes = seen.several[other] * multiple.density;
        if let Some((_, ends)) = seen.pair.coherence().filter(|_| seen.rest[other] > 0.0) {
            let side = if reflects { seen.side } else { 1 - seen.side };
            lobes += seen.rest[other] * ends.rest_density(side, l.z.abs());
        }
        (f, scatters * (facet_chance * visible + lobes))
    }

    /// n² on the viewer's side, relative to the first.
    #[inline(always)]
    fn squeeze(at: &Incidence<'_, N>, seen: &Seen<'_, N>) -> f32 {
        if seen.side == 0 {
            return 1.0;
        }
        let eta = at.hero_lane.map_or(seen.eta, |lane| at.far.lanes.0[lane] / at.near.lanes.0[lane]);
        (eta * eta).recip()
    }

    /// What stays coherent of the direction to the light.
    #[inline(always)]
    fn towards(closed: &Closed<N>, at: &Incidence<'_, N>, seen: &Seen<'_, N>, l: Vec3) -> Coherent<N> {
        let grids = &seen.pair.relief.balance.grids;
        let up = Vec3::new(l.x, l.y, l.z.abs());
        if l.z > 0.0 {
            closed.at(&grids[seen.side], seen.side, at.near.lanes, Some(seen.eta), up)
        } else {
            closed.at(&grids[1 - seen.side], 1 - seen.side, at.far.lanes, Some(seen.eta.recip()), up)
        }
    }

    #[inline(always)]
    pub(crate) fn eval(&self, at: &Incidence<'_, N>, to_light: Vec3) -> Lanes<N> {
        let Some(seen) = self.seen(at).filter(|seen| seen.v.z > 0.0 && to_light.z != 0.0) else {
            return Lanes::default();
        };
        let l = to_light * 1f32.copysign(at.to_viewer.z);
        self.scattered(at, &seen, l).0 * to_light.z.abs().max(1e-9).recip()
    }

    #[inline(always)]
    pub(crate) fn pdf(&self, at: &Incidence<'_, N>, to_light: Vec3) -> f32 {
        let Some(seen) = self.seen(at).filter(|seen| seen.v.z > 0.0 && to_light.z != 0.0) else {
            return 0.0;
        };
        self.scattered(at, &seen, to_light * 1f32.copysign(at.to_viewer.z)).1
    }

    #[inline(always)]
    pub(crate) fn sample(
        &self,
        at: &Incidence<'_, N>,
        u: [f32; 3],
        hero: Option<usize>,
    ) -> Option<Scattered<N>> {
        let flip = 1f32.copysign(at.to_viewer.z);
        let v = at.to_viewer * flip;
        let seen = self.seen(at);
        let [back, through] = seen.as_ref().map_or([1.0; 2], |seen| seen.kept);
        let boundary = Boundary::new(at, self.dispersive, hero, v.z);
        let (mirror, straight) = (boundary.choice * back, (1.0 - boundary.choice) * through);
        let Some(seen) = seen.filter(|_| u[2] >= mirror + straight) else {
            let reflects = u[2] < mirror;
            return self.coherent(at, &boundary, reflects, [mirror, straight], flip, hero);
        };
        if !(v.z > 0.0) {
            return None;
        }
        let scatters = 1.0 - mirror - straight;
        let choice = (u[2] - mirror - straight) / scatters;
        let [up, down] = seen.rest;
        if choice < up + down {
            let (_, ends) = seen.pair.coherence()?;
            let side = if choice < up { seen.side } else { 1 - seen.side };
            let mut l = ends.sample_rest(side, [u[0], u[1]]);
            l.z = if choice < up { l.z } else { -l.z };
            return self.drawn(at, &seen, l, flip);
        }
        let [above, below] = seen.several;
        let choice = choice - up - down;
        if choice < above + below {
            let other = usize::from(choice >= above);
            let mut l = seen.pair.relief.sample_multiple(seen.sides()[other], v, [u[0], u[1]])?;
            l.z = if other == 0 { l.z } else { -l.z };
            return self.drawn(at, &seen, l, flip);
        }
        let facet_chance = 1.0 - up - down - above - below;
        let choice = (choice - above - below) / facet_chance;
        let h = seen.pair.relief.facets.sample_visible(v.to_array(), [u[0], u[1]]);
        let cos = dot(v.to_array(), h);
        if cos <= 0.0 {
            return None;
        }
        let boundary = Boundary::new(at, self.dispersive, hero, cos);
        let reflects = seen.choice(boundary.choice);
        if choice < reflects {
            let l = Vec3::from(reflect(v.to_array(), h));
            return if l.z > 0.0 { self.drawn(at, &seen, l, flip) } else { None };
        }
        let (l, _) = refract(v.to_array(), h, boundary.eta)?;
        let l = Vec3::from(l);
        if l.z >= 0.0 {
            return None;
        }
        if !boundary.disperses {
            return self.drawn(at, &seen, l, flip);
        }
        // The lane that would go on may belong to another pass.
        hero?;
        let facets = &seen.pair.relief.facets;
        let (va, la) = (v.to_array(), l.to_array());
        // Visible normals: what is left of D G₂ / pdf is G₂/G₁.
        let left = facets.masking_shadowing(va, la) / facets.masking(va);
        let chance = scatters * facet_chance * (1.0 - reflects);
        let mut weight = boundary.reflectance(cos).map(|r| 1.0 - r) * (left * boundary.eta.powi(-2) / chance);
        if let (Some((coherent, _)), Some((closed, _))) = (&seen.coherent, seen.pair.coherence()) {
            let to = Self::towards(closed, at, &seen, l);
            weight *= coherent.factor * to.factor * (coherent.through * to.through).map(|k| 1.0 - k);
        }
        // A direction that belongs to one lane is known to no density that others share.
        Some(Scattered {
            direction: l * flip,
            weight,
            brightness: 1.0,
            pdf: None,
            transmitted: true,
            disperses: true,
        })
    }

    /// A direction of scattered light that has been drawn.
    #[inline(always)]
    fn drawn(&self, at: &Incidence<'_, N>, seen: &Seen<'_, N>, l: Vec3, flip: f32) -> Option<Scattered<N>> {
        if l.z == 0.0 {
            return None;
        }
        let (f, pdf) = self.scattered(at, seen, l);
        (pdf > 0.0).then(|| Scattered {
            direction: l * flip,
            weight: f * pdf.recip(),
            brightness: 1.0,
            pdf: Some(pdf),
            transmitted: l.z < 0.0,
            disperses: false,
        })
    }

    /// The mirror direction or that of smooth refraction; `chances` are those of both.
    #[inline(always)]
    fn coherent(
        &self,
        at: &Incidence<'_, N>,
        boundary: &Boundary<N>,
        reflects: bool,
        chances: [f32; 2],
        flip: f32,
        hero: Option<usize>,
    ) -> Option<Scattered<N>> {
        let v = (at.to_viewer * flip).to_array();
        if boundary.disperses && hero.is_none() && !reflects {
            // The lane that would go on belongs to another pass.
            return None;
        }
        let (direction, weight) = self.lobe(at, boundary, reflects, v)?;
        Some(Scattered {
            direction: direction * flip,
            weight: weight * chances[usize::from(!reflects)].recip(),
            brightness: 1.0,
            pdf: None,
            transmitted: !reflects,
            disperses: boundary.disperses && !reflects,
        })
    }

    /// A coherent direction and what the radiance from there is multiplied by.
    #[inline(always)]
    fn lobe(
        &self,
        at: &Incidence<'_, N>,
        boundary: &Boundary<N>,
        reflects: bool,
        v: [f32; 3],
    ) -> Option<(Vec3, Lanes<N>)> {
        let fresnel = boundary.reflectance(v[2]);
        let coherent = self.seen(at).map(|seen| seen.coherent.map(|(lanes, _)| lanes));
        let power = |amplitude: fn(&Coherent<N>) -> &Lanes<N>| match &coherent {
            None => Lanes::splat(1.0),
            Some(None) => Lanes::default(),
            Some(Some(c)) => *amplitude(c) * *amplitude(c),
        };
        if reflects {
            return Some((Vec3::from(reflect(v, [0.0, 0.0, 1.0])), fresnel * power(|c| &c.back)));
        }
        let (direction, _) = refract(v, [0.0, 0.0, 1.0], boundary.eta)?;
        let passed = fresnel.map(|r| 1.0 - r) * boundary.eta.powi(-2);
        Some((Vec3::from(direction), passed * power(|c| &c.through)))
    }

    pub(crate) fn discrete_lobes(&self, at: &Incidence<'_, N>) -> Vec<DiscreteLobe<N>> {
        let seen = self.seen(at);
        if seen.as_ref().is_some_and(|seen| seen.coherent.is_none()) {
            return Vec::new();
        }
        let kept = seen.map_or([1.0; 2], |seen| seen.kept);
        let flip = 1f32.copysign(at.to_viewer.z);
        let v = (at.to_viewer * flip).to_array();
        let boundary = Boundary::new(at, self.dispersive, at.hero_lane, v[2]);
        let lobe = |reflects: bool| {
            let (direction, weight) = self.lobe(at, &boundary, reflects, v)?;
            let (direction, transmitted) = (direction * flip, !reflects);
            let brightness =
                if reflects { boundary.choice * kept[0] } else { (1.0 - boundary.choice) * kept[1] };
            Some(DiscreteLobe { direction, weight, brightness, transmitted })
        };
        [true, false].into_iter().filter_map(lobe).collect()
    }

    pub(crate) fn is_rough(&self) -> bool {
        self.rough.is_some()
    }

    // --- as the outer boundary of a vehicle, with the viewer above ----------------------------------------------------

    /// The share of power that is reflected, in lanes; from below, that of a smooth boundary.
    #[inline(always)]
    pub(crate) fn reflectance(&self, at: &Incidence<'_, N>) -> Lanes<N> {
        let v = at.to_viewer;
        let smooth = (*at.far.lanes / *at.near.lanes).map(|eta| dielectric(v.z.abs(), eta));
        if v.z < 0.0 {
            return smooth;
        }
        let Some(seen) = self.seen(at) else { return smooth };
        let grid = &seen.pair.relief.balance.grids[0];
        match (&seen.coherent, seen.pair.coherence()) {
            (Some((coherent, _)), Some((closed, _))) => {
                let scattered = closed.reflectance(grid, at.near.lanes, seen.eta, v);
                (smooth * coherent.back * coherent.back + scattered).map(|e| e.min(1.0))
            }
            _ => {
                let mut sum = 0.0;
                grid.interpolate(v.to_array(), |i, w| sum += w * seen.pair.reflected[i]);
                Lanes::splat(sum)
            }
        }
    }

    /// The same as one number; the part of it in the mirror direction; and the part that goes everywhere.
    #[inline(always)]
    pub(crate) fn representative(&self, at: &Incidence<'_, N>) -> (f32, f32, f32) {
        let fresnel = dielectric(at.to_viewer.z, at.far.mean / at.near.mean);
        let Some(seen) = self.seen(at) else { return (fresnel, fresnel, 0.0) };
        let mirror = fresnel * seen.kept[0];
        let grid = &seen.pair.relief.balance.grids[0];
        let all = match seen.pair.coherence() {
            Some((_, ends)) => {
                let ends = ends.closed.reflectance(grid, &Lanes::splat(at.near.mean), seen.eta, seen.v);
                mirror + 0.5 * (ends.0[0] + ends.0[1])
            }
            None => {
                let mut sum = 0.0;
                grid.interpolate(seen.v.to_array(), |i, w| sum += w * seen.pair.reflected[i]);
                sum
            }
        };
        let all = all.clamp(mirror, 1.0);
        (all, mirror, (seen.rest[0] + seen.several[0]).min(all - mirror))
    }

    /// What is reflected in the mirror direction.
    #[inline(always)]
    pub(crate) fn mirror(&self, at: &Incidence<'_, N>) -> Lanes<N> {
        let fresnel = (*at.far.lanes / *at.near.lanes).map(|eta| dielectric(at.to_viewer.z, eta));
        match self.seen(at).map(|seen| seen.coherent) {
            None => fresnel,
            Some(None) => Lanes::default(),
            Some(Some((coherent, _))) => fresnel * coherent.back * coherent.back,
        }
    }

    /// A facet normal as it is seen; `None` where there are no facets.
    #[inline(always)]
    pub(crate) fn sample_visible(&self, at: &Incidence<'_, N>, u: [f32; 2]) -> Option<[f32; 3]> {
        let seen = self.seen(at)?;
        Some(seen.pair.relief.facets.sample_visible(seen.v.to_array(), u))
    }

    /// The density of directions that visible facets reflect.
    #[inline(always)]
    pub(crate) fn visible_density(&self, at: &Incidence<'_, N>, l: Vec3) -> f32 {
        let Some(seen) = self.seen(at) else { return 0.0 };
        let h = (seen.v + l).normalize_or_zero();
        let cos = seen.v.dot(h);
        if cos <= 0.0 {
            return 0.0;
        }
        seen.pair.relief.facets.pdf_visible(seen.v.to_array(), h.to_array()) / (4.0 * cos)
    }
}
