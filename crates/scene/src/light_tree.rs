//! A tree over many lamps, from which a point chooses one (Conty Estevez and Kulla 2018, “Importance sampling of many lights with adaptive
//! tree splitting”; Walter et al. 2005).
//!
//! Each node knows a box around its lamps, a cone around the directions into which they face, and their strength. From a point, a node counts
//! its strength times the largest cosine that any of its lamps can have, over the square of the distance: what it can be expected to bring.
//! One number in [0, 1) walks from the root to a lamp, at each node in proportion to what its halves count; so the time is that of the depth
//! of the tree. The cosine at the point is left out: what lies there may let light through. Bounds may say of a node that it brings
//! something when neither half does: then no lamp is chosen, and the point takes nothing for this time, which is what it is.

use crate::lamp::Lamp;
use crate::lamp_chooser::LampChooser;
use glam::Vec3;
use std::f32::consts::{FRAC_PI_2, PI};

/// Into how many parts a box is cut to look for the best split.
const BINS: usize = 12;

/// The least and the most part of the choices that go to lamps with a place, where there are others too.
const SHARE: [f32; 2] = [0.1, 0.9];

/// The least chance of one of two halves that both bring something.
const LEAST: f32 = 1e-6;

/// Where lamps are, into which directions they shine, and how strongly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Corners of a box around them.
    pub low: Vec3,
    /// See `low`.
    pub high: Vec3,
    /// Unit axis of the cone of directions into which they face.
    pub axis: Vec3,
    /// Half-angle of this cone, radians.
    pub facing: f32,
    /// How far from where it faces each shines, radians: π/2 for a surface.
    pub spread: f32,
    /// Whether they shine from both sides.
    pub two_sided: bool,
    /// What they bring at a distance of 1 that faces them: intensity, or radiance times area.
    pub strength: f32,
}

impl Extent {
    /// Both together.
    fn union(&self, other: &Self) -> Self {
        let (a, b) = if self.facing >= other.facing { (self, other) } else { (other, self) };
        // Not by the cosine, which says little of small angles.
        let between = a.axis.cross(b.axis).length().atan2(a.axis.dot(b.axis));
        let (axis, facing) = if (between + b.facing).min(PI) <= a.facing {
            (a.axis, a.facing)
        } else {
            let facing = 0.5 * (a.facing + between + b.facing);
            let across = (b.axis - a.axis * a.axis.dot(b.axis)).try_normalize();
            match across {
                _ if facing >= PI => (a.axis, PI),
                // Turned from one axis towards the other.
                Some(across) => {
                    let (sin, cos) = (facing - a.facing).sin_cos();
                    ((a.axis * cos + across * sin).normalize(), facing)
                }
                // They look opposite ways.
                None => (a.axis, PI),
            }
        };
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            axis,
            facing,
            spread: self.spread.max(other.spread),
            two_sided: self.two_sided || other.two_sided,
            strength: self.strength + other.strength,
        }
    }

    fn middle(&self) -> Vec3 {
        (self.low + self.high) * 0.5
    }

    /// What a half of a node costs: strength times the area of its box and the solid angle into which it shines, longer for a box that is
    /// cut across a short side.
    fn cost(&self, stretch: f32) -> f32 {
        let size = self.high - self.low;
        let area = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
        let (o, w) = (self.facing, (self.facing + self.spread).min(PI));
        let (sin, cos) = o.sin_cos();
        let solid =
            2.0 * PI * (1.0 - cos) + FRAC_PI_2 * (2.0 * w * sin - (o - 2.0 * w).cos() - 2.0 * o * sin + cos);
        // Points have no area, but a place.
        let least = 1e-6 * size.length_squared();
        self.strength * solid * (area + least) * stretch
    }
}

/// An extent as it is asked from points.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    middle: Vec3,
    /// The square of half the diagonal of the box.
    radius2: f32,
    axis: Vec3,
    cos_facing: f32,
    sin_facing: f32,
    cos_spread: f32,
    two_sided: bool,
    strength: f32,
}

/// cos max(a − b, 0), from sines and cosines.
#[inline(always)]
fn cos_less(sin_a: f32, cos_a: f32, sin_b: f32, cos_b: f32) -> f32 {
    if cos_a > cos_b { 1.0 } else { cos_a * cos_b + sin_a * sin_b }
}

/// sin max(a − b, 0).
#[inline(always)]
fn sin_less(sin_a: f32, cos_a: f32, sin_b: f32, cos_b: f32) -> f32 {
    if cos_a > cos_b { 0.0 } else { sin_a * cos_b - cos_a * sin_b }
}

impl Bounds {
    fn new(extent: &Extent) -> Self {
        let (sin_facing, cos_facing) = extent.facing.sin_cos();
        Self {
            middle: extent.middle(),
            radius2: 0.25 * (extent.high - extent.low).length_squared(),
            axis: extent.axis,
            cos_facing,
            sin_facing: sin_facing.max(0.0),
            cos_spread: extent.spread.cos(),
            two_sided: extent.two_sided,
            strength: extent.strength,
        }
    }

    /// What the lamps can be expected to bring to a point.
    #[inline(always)]
    fn importance(&self, point: Vec3) -> f32 {
        let d = point - self.middle;
        let d2 = d.length_squared();
        let near = d2.max(self.radius2).max(1e-12);
        if d2 <= self.radius2 {
            // Inside: any of them may face the point.
            return self.strength / near;
        }
        let mut cos_w = d.dot(self.axis) / d2.sqrt();
        if self.two_sided {
            cos_w = cos_w.abs();
        }
        let sin_w = (1.0 - cos_w * cos_w).max(0.0).sqrt();
        let sin_b2 = self.radius2 / d2;
        let (sin_b, cos_b) = (sin_b2.sqrt(), (1.0 - sin_b2).max(0.0).sqrt());
        let cos_x = cos_less(sin_w, cos_w, self.sin_facing, self.cos_facing);
        let sin_x = sin_less(sin_w, cos_w, self.sin_facing, self.cos_facing);
        let cos = cos_less(sin_x, cos_x, sin_b, cos_b);
        // A lamp on its very edge may round to nothing that it is not.
        if cos <= self.cos_spread - 1e-5 { 0.0 } else { self.strength * cos.max(1e-3) / near }
    }
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    parent: u32,
    /// The first of two children that follow each other, or a lamp.
    next: u32,
    is_lamp: bool,
}

const NONE: u32 = u32::MAX;

/// The tree.
#[derive(Clone, Debug)]
pub struct LightTree {
    nodes: Vec<Node>,
    /// The leaf of each lamp that has a place.
    leaves: Vec<u32>,
    /// Lamps without a place, with running sums of what they bring anywhere.
    afar: Vec<(usize, f32)>,
}

impl LightTree {
    /// A tree over lamps whose extents are known; of the others `afar` says what they bring anywhere.
    #[must_use]
    pub fn new(extents: &[Option<Extent>], afar: &[f32]) -> Self {
        let sound = |e: &Extent| {
            e.strength > 0.0 && e.strength.is_finite() && e.low.is_finite() && e.high.is_finite()
        };
        let mut placed: Vec<(usize, Extent)> = extents
            .iter()
            .enumerate()
            .filter_map(|(i, e)| Some((i, (*e)?)))
            .filter(|(_, e)| sound(e))
            .collect();
        let mut tree = Self { nodes: Vec::new(), leaves: vec![NONE; extents.len()], afar: Vec::new() };
        if !placed.is_empty() {
            let root = Node { bounds: Bounds::new(&placed[0].1), parent: NONE, next: 0, is_lamp: true };
            tree.nodes.push(root);
            tree.build(0, &mut placed);
        }
        let mut sum = 0.0;
        for (lamp, &light) in afar.iter().enumerate() {
            if extents[lamp].is_none() && light > 0.0 && light.is_finite() {
                sum += light;
                tree.afar.push((lamp, sum));
            }
        }
        tree
    }

    fn build(&mut self, root: usize, placed: &mut [(usize, Extent)]) {
        // A stack instead of calls, for lamps that all lie in one place make a deep tree.
        let mut left = vec![(root, 0, placed.len())];
        while let Some((node, begin, end)) = left.pop() {
            let lamps = &mut placed[begin..end];
            let whole = lamps[1..].iter().fold(lamps[0].1, |sum, (_, e)| sum.union(e));
            self.nodes[node].bounds = Bounds::new(&whole);
            if let [(lamp, _)] = lamps {
                self.nodes[node].next = *lamp as u32;
                self.nodes[node].is_lamp = true;
                self.leaves[*lamp] = node as u32;
                continue;
            }
            let middle = begin + split(lamps, &whole);
            let first = self.nodes.len() as u32;
            self.nodes[node].next = first;
            self.nodes[node].is_lamp = false;
            let child = Node { bounds: self.nodes[node].bounds, parent: node as u32, next: 0, is_lamp: true };
            self.nodes.extend([child; 2]);
            left.push((first as usize, begin, middle));
            left.push((first as usize + 1, middle, end));
        }
    }

    /// The chance of the tree as a whole, against lamps without a place.
    #[inline]
    fn share(&self, point: Vec3) -> f32 {
        let placed = self.nodes.first().map_or(0.0, |root| root.bounds.importance(point));
        let afar = self.afar.last().map_or(0.0, |(_, sum)| *sum);
        match (placed > 0.0, afar > 0.0) {
            (true, true) => (placed / (placed + afar)).clamp(SHARE[0], SHARE[1]),
            (true, false) => 1.0,
            (false, _) => 0.0,
        }
    }

    /// The chance of the first child of a node; `None` where neither brings anything.
    #[inline(always)]
    fn first(&self, node: &Node, point: Vec3) -> Option<f32> {
        let next = node.next as usize;
        let [a, b] = [next, next + 1].map(|i| self.nodes[i].bounds.importance(point));
        let sum = a + b;
        // Neither of two that both bring something rounds to none.
        let [least, most] = if a > 0.0 && b > 0.0 { [LEAST, 1.0 - LEAST] } else { [0.0, 1.0] };
        (sum > 0.0 && sum.is_finite()).then(|| (a / sum).clamp(least, most))
    }
}

/// Orders lamps so that those of one half come first; how many they are.
fn split(lamps: &mut [(usize, Extent)], whole: &Extent) -> usize {
    let middles = lamps.iter().map(|(_, e)| e.middle());
    let (low, high) = middles.fold((Vec3::MAX, Vec3::MIN), |(low, high), m| (low.min(m), high.max(m)));
    let size = high - low;
    let longest = (whole.high - whole.low).max_element();
    let mut best: Option<(f32, usize, usize)> = None;
    let bin_of = |e: &Extent, axis: usize| {
        let t = (e.middle()[axis] - low[axis]) / size[axis];
        ((t * BINS as f32) as usize).min(BINS - 1)
    };
    for axis in 0..3 {
        if !(size[axis] > 0.0) {
            continue;
        }
        let mut bins: [Option<Extent>; BINS] = [None; BINS];
        for (_, e) in lamps.iter() {
            let bin = &mut bins[bin_of(e, axis)];
            *bin = Some(bin.map_or(*e, |sum| sum.union(e)));
        }
        let stretch = longest / (whole.high - whole.low)[axis].max(f32::MIN_POSITIVE);
        let join = |a: Option<Extent>, b: &Option<Extent>| match (a, b) {
            (Some(a), Some(b)) => Some(a.union(b)),
            (a, b) => a.or(*b),
        };
        for cut in 1..BINS {
            let sides = [&bins[..cut], &bins[cut..]].map(|side| side.iter().fold(None, join));
            let [Some(a), Some(b)] = sides else { continue };
            let cost = a.cost(stretch) + b.cost(stretch);
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, axis, cut));
            }
        }
    }
    let half = lamps.len() / 2;
    let Some((_, axis, cut)) = best else { return half };
    // In place: those of the first half, in any order.
    let mut count = 0;
    for i in 0..lamps.len() {
        if bin_of(&lamps[i].1, axis) < cut {
            lamps.swap(i, count);
            count += 1;
        }
    }
    if count == 0 || count == lamps.len() { half } else { count }
}

impl LampChooser for LightTree {
    fn choose(&self, _lamps: &[Lamp], point: Vec3, _normal: Vec3, u: f32) -> Option<(usize, f32)> {
        let share = self.share(point);
        if u >= share {
            let (_, total) = *self.afar.last()?;
            let wanted = (u - share) / (1.0 - share) * total;
            let i = self.afar.partition_point(|(_, sum)| *sum <= wanted).min(self.afar.len() - 1);
            let lamp = self.afar[i].0;
            return Some((lamp, self.probability(&[], point, Vec3::ZERO, lamp)));
        }
        let (mut u, mut probability) = (u / share, share);
        let mut node = self.nodes.first()?;
        while !node.is_lamp {
            let first = self.first(node, point)?;
            let second = u >= first;
            let chance = if second { 1.0 - first } else { first };
            u = ((if second { u - first } else { u }) / chance).min(1.0 - f32::EPSILON / 2.0);
            probability *= chance;
            node = &self.nodes[node.next as usize + usize::from(second)];
        }
        (probability > 0.0).then_some((node.next as usize, probability))
    }

    fn probability(&self, _lamps: &[Lamp], point: Vec3, _normal: Vec3, lamp: usize) -> f32 {
        let share = self.share(point);
        if let Some(i) = self.afar.iter().position(|(own, _)| *own == lamp) {
            let total = self.afar[self.afar.len() - 1].1;
            let before = if i == 0 { 0.0 } else { self.afar[i - 1].1 };
            return (1.0 - share) * ((self.afar[i].1 - before) / total);
        }
        let leaf = self.leaves[lamp];
        if leaf == NONE {
            return 0.0;
        }
        // From the root down, so that the product is the very one of `choose`.
        let mut way = [0u32; 64];
        let (mut depth, mut at) = (0, leaf);
        let mut longer = Vec::new();
        while at != 0 {
            match way.get_mut(depth) {
                Some(slot) => *slot = at,
                None => longer.push(at),
            }
            depth += 1;
            at = self.nodes[at as usize].parent;
        }
        let mut probability = share;
        for &child in longer.iter().rev().chain(way[..depth.min(64)].iter().rev()) {
            let parent = &self.nodes[self.nodes[child as usize].parent as usize];
            let Some(first) = self.first(parent, point) else { return 0.0 };
            probability *= if child == parent.next { first } else { 1.0 - first };
        }
        probability
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers that look like chance.
    fn chance(i: u32) -> f32 {
        let mut x = i.wrapping_mul(0x9E37_79B1) ^ 0x85EB_CA77;
        x = (x ^ (x >> 15)).wrapping_mul(0x2C1B_3C6D);
        x = (x ^ (x >> 12)).wrapping_mul(0x297A_2D39);
        ((x ^ (x >> 15)) >> 8) as f32 / 16_777_216.0
    }

    fn place(i: u32, size: f32) -> Vec3 {
        Vec3::new(chance(3 * i), chance(3 * i + 1), chance(3 * i + 2)) * size
    }

    /// A point, or a small surface that faces somewhere.
    fn extent(i: u32, faces: bool) -> Extent {
        let middle = place(i, 10.0);
        let half = Vec3::splat(if faces { 0.01 } else { 0.0 });
        Extent {
            low: middle - half,
            high: middle + half,
            axis: (place(i + 50_000, 2.0) - Vec3::ONE).normalize_or(Vec3::Z),
            facing: if faces { 0.0 } else { PI },
            spread: FRAC_PI_2,
            two_sided: false,
            strength: 0.2 + chance(7 * i + 3),
        }
    }

    /// What a lamp brings to a point.
    fn light(e: &Extent, point: Vec3) -> f32 {
        let d = point - e.middle();
        let cos = if e.facing > 0.0 { 1.0 } else { d.normalize().dot(e.axis).max(0.0) };
        e.strength * cos / d.length_squared()
    }

    #[test]
    fn probabilities_are_those_of_choices() {
        for (count, faces, afar) in
            [(40u32, false, false), (40, true, false), (300, true, true), (33, false, true)]
        {
            let mut extents: Vec<Option<Extent>> = (0..count).map(|i| Some(extent(i, faces))).collect();
            let mut anywhere = vec![0.0; extents.len()];
            if afar {
                for lamp in [3, 17, 29] {
                    extents[lamp] = None;
                    anywhere[lamp] = 0.1 * lamp as f32;
                }
            }
            let tree = LightTree::new(&extents, &anywhere);
            for i in 0..20 {
                let point = place(1_000_000 + i, 12.0) - Vec3::ONE;
                let all: Vec<f32> =
                    (0..extents.len()).map(|lamp| tree.probability(&[], point, Vec3::Z, lamp)).collect();
                let sum: f64 = all.iter().map(|p| f64::from(*p)).sum();
                // Less than one only where a walk ends at lamps that all look away.
                assert!(sum < 1.0 + 1e-4 && (faces || sum > 1.0 - 1e-4), "{count} {faces}: {sum}");
                let trials = 20_000;
                let mut found = vec![0u32; extents.len()];
                for t in 0..trials {
                    let u = (t as f32 + 0.5) / trials as f32;
                    if let Some((lamp, probability)) = tree.choose(&[], point, Vec3::Z, u) {
                        assert_eq!(probability, all[lamp]);
                        found[lamp] += 1;
                    }
                }
                for (lamp, &n) in found.iter().enumerate() {
                    let expected = all[lamp] * trials as f32;
                    // Even numbers fall into intervals as long as the probabilities.
                    assert!((n as f32 - expected).abs() < 12.0, "{lamp}: {n} {expected}");
                }
            }
        }
    }

    #[test]
    fn a_lamp_that_can_light_a_point_has_a_chance() {
        let extents: Vec<Option<Extent>> = (0..500).map(|i| Some(extent(i, true))).collect();
        let tree = LightTree::new(&extents, &[0.0; 500]);
        for i in 0..50 {
            let point = place(2_000_000 + i, 10.0);
            for (lamp, e) in extents.iter().enumerate() {
                if e.is_some_and(|e| light(&e, point) > 0.0) {
                    assert!(tree.probability(&[], point, Vec3::Z, lamp) > 0.0);
                }
            }
        }
    }

    #[test]
    fn ten_thousand_lamps_are_chosen_by_what_they_bring() {
        for faces in [false, true] {
            let extents: Vec<Option<Extent>> = (0..10_000).map(|i| Some(extent(i, faces))).collect();
            let tree = LightTree::new(&extents, &vec![0.0; extents.len()]);
            let total: f64 = extents.iter().flatten().map(|e| f64::from(e.strength)).sum();
            let (mut by_tree, mut by_flux) = (0.0, 0.0);
            for i in 0..30 {
                let point = place(3_000_000 + i, 10.0);
                let each: Vec<f64> = extents.iter().flatten().map(|e| f64::from(light(e, point))).collect();
                let exact: f64 = each.iter().sum();
                let trials = 4000;
                let (mut sum, mut squares) = (0.0, 0.0);
                for t in 0..trials {
                    let chosen = tree.choose(&[], point, Vec3::Z, chance(90_000 * i + t));
                    let value = chosen.map_or(0.0, |(lamp, p)| each[lamp] / f64::from(p) / exact);
                    sum += value;
                    squares += value * value;
                }
                let mean = sum / f64::from(trials);
                let variance = squares / f64::from(trials) - mean * mean;
                // Unbiased, within five standard errors.
                assert!(
                    (mean - 1.0).abs() < 5.0 * (variance / f64::from(trials)).sqrt() + 1e-3,
                    "{mean} {variance}"
                );
                by_tree += variance;
                // By flux: Σ light² / probability, in closed form.
                let second: f64 = extents
                    .iter()
                    .flatten()
                    .zip(&each)
                    .map(|(e, light)| light * light / (f64::from(e.strength) / total))
                    .sum();
                by_flux += second / (exact * exact) - 1.0;
            }
            assert!(by_flux > 5.0 * by_tree, "{faces}: {by_flux} {by_tree}");
        }
    }

    #[test]
    fn nearly_parallel_spots_keep_their_edges() {
        // Spots with a hard edge, whose axes differ by less than the cosine can tell.
        let spot = |i: u32| {
            let middle = place(i, 0.5);
            Some(Extent {
                low: middle,
                high: middle,
                axis: (Vec3::NEG_Z + (place(i + 900, 2.0) - Vec3::ONE) * 4e-4).normalize(),
                facing: 0.0,
                spread: 0.6,
                two_sided: false,
                strength: 1.0,
            })
        };
        let extents: Vec<Option<Extent>> = (0..64).map(spot).collect();
        let tree = LightTree::new(&extents, &[0.0; 64]);
        for (lamp, e) in extents.iter().enumerate() {
            let Some(e) = e else { continue };
            let across = e.axis.any_orthonormal_vector();
            for i in 0..64 {
                let turned = glam::Quat::from_axis_angle(e.axis, i as f32 * 0.1) * across;
                let (sin, cos) = (0.6f32 - 1e-4).sin_cos();
                let point = e.middle() + (e.axis * cos + turned * sin) * 30.0;
                assert!(tree.probability(&[], point, Vec3::Z, lamp) > 0.0, "{lamp} {i}");
            }
        }
    }

    #[test]
    fn odd_lamps_are_no_trouble() {
        // All in one place, some without strength, one that is nowhere, and a point among them.
        let mut extents: Vec<Option<Extent>> = (0..40).map(|_| Some(extent(5, false))).collect();
        extents[3].as_mut().unwrap().strength = 0.0;
        extents[4].as_mut().unwrap().strength = f32::NAN;
        extents[6].as_mut().unwrap().low = Vec3::NAN;
        let tree = LightTree::new(&extents, &[0.0; 40]);
        let point = extents[0].unwrap().middle();
        for at in [point, point + Vec3::X, Vec3::NAN] {
            for u in [0.0, 0.5, 1.0 - f32::EPSILON / 2.0] {
                if let Some((lamp, p)) = tree.choose(&[], at, Vec3::Z, u) {
                    assert!(p > 0.0 && ![3, 4, 6].contains(&lamp));
                }
            }
        }
        assert!(LightTree::new(&[None; 3], &[0.0; 3]).choose(&[], point, Vec3::Z, 0.3).is_none());
        assert_eq!(tree.probability(&[], point, Vec3::Z, 4), 0.0);
    }
}
