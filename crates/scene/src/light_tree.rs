//! A tree over many lamps, from which a point chooses one (Conty Estevez and Kulla 2018, “Importance sampling of many lights with adaptive
//! tree splitting”; Walter et al. 2005).
//!
//! Each node knows a box around its lamps, a cone around the directions into which they face, and their strength. From a point, a node counts
//! its strength times the largest cosine that any of its lamps can have, over the square of the distance: what it can be expected to bring.
//! One number in [0, 1) walks from the root to a lamp, at each node in proportion to what its parts count; so the time is that of the depth
//! of the tree, and halves of halves are put together to eight parts, which are weighed at once. The cosine at the point is left out: what lies there may let light through. Bounds may say of a node that it brings
//! something when none of its parts does: then no lamp is chosen, and the point takes nothing for this time, which is what it is.

use crate::lamp::Lamp;
use crate::lamp_chooser::LampChooser;
use glam::Vec3;
use std::f32::consts::{FRAC_PI_2, PI};

/// Into how many parts a box is cut to look for the best split.
const BINS: usize = 12;

/// The least and the most part of the choices that go to lamps with a place, where there are others too.
const SHARE: [f32; 2] = [0.1, 0.9];

/// How many parts a node has at most: as many as are weighed at once.
const PARTS: usize = 8;

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

/// Extents as they are asked from points, so many at once; the rest count nothing.
#[derive(Clone, Copy, Debug, Default)]
struct Bounds {
    x: [f32; PARTS],
    y: [f32; PARTS],
    z: [f32; PARTS],
    /// The square of half the diagonal of the box.
    radius2: [f32; PARTS],
    /// The axis.
    along: [[f32; PARTS]; 3],
    cos_facing: [f32; PARTS],
    sin_facing: [f32; PARTS],
    cos_spread: [f32; PARTS],
    /// 1 where both sides shine.
    two_sided: [f32; PARTS],
    strength: [f32; PARTS],
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
    fn set(&mut self, i: usize, extent: &Extent) {
        let (sin_facing, cos_facing) = extent.facing.sin_cos();
        [self.x[i], self.y[i], self.z[i]] = extent.middle().to_array();
        self.radius2[i] = 0.25 * (extent.high - extent.low).length_squared();
        for (slot, v) in self.along.iter_mut().zip(extent.axis.to_array()) {
            slot[i] = v;
        }
        self.cos_facing[i] = cos_facing;
        self.sin_facing[i] = sin_facing.max(0.0);
        self.cos_spread[i] = extent.spread.cos();
        self.two_sided[i] = f32::from(u8::from(extent.two_sided));
        self.strength[i] = extent.strength;
    }

    /// What the lamps of each part can be expected to bring to a point. No branch, so that all parts go through at once.
    #[inline(always)]
    fn importance(&self, point: Vec3) -> [f32; PARTS] {
        let mut all = [0.0; PARTS];
        // A plain loop, which the compiler turns into one pass over all lanes.
        for (i, value) in all.iter_mut().enumerate() {
            let (dx, dy, dz) = (point.x - self.x[i], point.y - self.y[i], point.z - self.z[i]);
            let d2 = dx * dx + dy * dy + dz * dz;
            let radius2 = self.radius2[i];
            let near = d2.max(radius2).max(1e-12);
            let dot = dx * self.along[0][i] + dy * self.along[1][i] + dz * self.along[2][i];
            let cos = dot / d2.max(1e-24).sqrt();
            let cos_w = if self.two_sided[i] > 0.0 { cos.abs() } else { cos };
            let sin_w = (1.0 - cos_w * cos_w).max(0.0).sqrt();
            let sin_b2 = (radius2 / d2.max(1e-24)).min(1.0);
            let (sin_b, cos_b) = (sin_b2.sqrt(), (1.0 - sin_b2).sqrt());
            let cos_x = cos_less(sin_w, cos_w, self.sin_facing[i], self.cos_facing[i]);
            let sin_x = sin_less(sin_w, cos_w, self.sin_facing[i], self.cos_facing[i]);
            let cos = cos_less(sin_x, cos_x, sin_b, cos_b);
            // A lamp on its very edge may round to nothing that it is not.
            let faces = if cos <= self.cos_spread[i] - 1e-5 { 0.0 } else { cos.max(1e-3) };
            // Inside: any of them may face the point.
            let faces = if d2 <= radius2 { 1.0 } else { faces };
            *value = self.strength[i] * faces / near;
        }
        all
    }
}

/// A node: up to eight parts, each a node again or a lamp.
#[derive(Clone, Copy, Debug, Default)]
struct Node {
    bounds: Bounds,
    /// For each part its node, or its lamp.
    next: [u32; PARTS],
    is_lamp: [bool; PARTS],
    /// The node of which this is a part, and which.
    parent: (u32, u8),
}

/// A part of a tree of halves, from which the tree is made.
struct Half {
    extent: Extent,
    /// The first of two halves that follow each other, or a lamp.
    next: u32,
    is_lamp: bool,
}

const NONE: u32 = u32::MAX;

/// The tree.
#[derive(Clone, Debug)]
pub struct LightTree {
    nodes: Vec<Node>,
    /// All lamps with a place together.
    whole: Bounds,
    /// The node, and its part, of each lamp that has a place.
    leaves: Vec<(u32, u8)>,
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
        // Only ratios count. Over a power of two, so that no bit changes, of the strongest: else sums leave the numbers.
        let strongest = placed.iter().map(|(_, e)| e.strength);
        let strongest = strongest
            .chain(afar.iter().copied().filter(|light| light.is_finite()))
            .fold(f32::MIN_POSITIVE, f32::max);
        let unit = f32::from_bits(strongest.to_bits() & 0x7f80_0000);
        placed.iter_mut().for_each(|(_, e)| e.strength /= unit);
        let mut tree = Self {
            nodes: Vec::new(),
            whole: Bounds::default(),
            leaves: vec![(NONE, 0); extents.len()],
            afar: Vec::new(),
        };
        if !placed.is_empty() {
            let halves = halves(&mut placed);
            tree.whole.set(0, &halves[0].extent);
            tree.gather(&halves);
        }
        let mut sum = 0.0;
        for (lamp, &light) in afar.iter().enumerate() {
            if extents[lamp].is_none() && light > 0.0 && light.is_finite() {
                sum += light / unit;
                tree.afar.push((lamp, sum));
            }
        }
        tree
    }

    /// Puts halves together to nodes: of the parts that a node has, the strongest is cut until there are eight.
    fn gather(&mut self, halves: &[Half]) {
        self.nodes.push(Node::default());
        let mut left = vec![(0usize, 0usize)];
        while let Some((node, root)) = left.pop() {
            let mut parts = vec![root];
            while parts.len() < PARTS {
                let strength = |&i: &usize| halves[parts[i]].extent.strength;
                let open = (0..parts.len()).filter(|&i| !halves[parts[i]].is_lamp);
                let Some(i) = open.max_by(|a, b| strength(a).total_cmp(&strength(b))) else { break };
                let next = halves[parts[i]].next as usize;
                parts[i] = next;
                parts.push(next + 1);
            }
            for (i, &part) in parts.iter().enumerate() {
                let half = &halves[part];
                self.nodes[node].bounds.set(i, &half.extent);
                self.nodes[node].is_lamp[i] = half.is_lamp;
                self.nodes[node].next[i] = if half.is_lamp {
                    self.leaves[half.next as usize] = (node as u32, i as u8);
                    half.next
                } else {
                    let child = self.nodes.len();
                    self.nodes.push(Node { parent: (node as u32, i as u8), ..Node::default() });
                    left.push((child, part));
                    child as u32
                };
            }
        }
    }

    /// The chance of the tree as a whole, against lamps without a place.
    #[inline]
    fn share(&self, point: Vec3) -> f32 {
        let afar = self.afar.last().map_or(0.0, |(_, sum)| *sum);
        if afar <= 0.0 {
            return f32::from(u8::from(!self.nodes.is_empty()));
        }
        let [placed, ..] = self.whole.importance(point);
        if placed > 0.0 { (placed / (placed + afar)).clamp(SHARE[0], SHARE[1]) } else { 0.0 }
    }
}

/// The halves of all lamps, the halves of those, and so on; the whole is the first.
fn halves(placed: &mut [(usize, Extent)]) -> Vec<Half> {
    let whole = |lamps: &[(usize, Extent)]| lamps[1..].iter().fold(lamps[0].1, |sum, (_, e)| sum.union(e));
    let mut all = vec![Half { extent: whole(placed), next: 0, is_lamp: false }];
    // A stack instead of calls, for lamps that all lie in one place make a deep tree.
    let mut left = vec![(0, 0, placed.len())];
    while let Some((half, begin, end)) = left.pop() {
        let lamps = &mut placed[begin..end];
        if let [(lamp, _)] = lamps {
            (all[half].next, all[half].is_lamp) = (*lamp as u32, true);
            continue;
        }
        let middle = begin + split(lamps, &all[half].extent);
        let first = all.len();
        all[half].next = first as u32;
        for (i, (begin, end)) in [(begin, middle), (middle, end)].into_iter().enumerate() {
            all.push(Half { extent: whole(&placed[begin..end]), next: 0, is_lamp: false });
            left.push((first + i, begin, end));
        }
    }
    all
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
        loop {
            let weights = node.bounds.importance(point);
            let sum: f32 = weights.iter().sum();
            if !(sum > 0.0 && sum.is_finite()) {
                return None;
            }
            let mut left = u * sum;
            let mut chosen = None;
            for (i, &weight) in weights.iter().enumerate() {
                if weight > 0.0 {
                    chosen = Some((i, weight, left));
                    if left < weight {
                        break;
                    }
                }
                left -= weight;
            }
            let (i, weight, left) = chosen?;
            u = (left / weight).clamp(0.0, 1.0 - f32::EPSILON / 2.0);
            probability *= weight / sum;
            if node.is_lamp[i] {
                return (probability > 0.0).then_some((node.next[i] as usize, probability));
            }
            node = &self.nodes[node.next[i] as usize];
        }
    }

    fn probability(&self, _lamps: &[Lamp], point: Vec3, _normal: Vec3, lamp: usize) -> f32 {
        let share = self.share(point);
        if let Some(i) = self.afar.iter().position(|(own, _)| *own == lamp) {
            let total = self.afar[self.afar.len() - 1].1;
            let before = if i == 0 { 0.0 } else { self.afar[i - 1].1 };
            return (1.0 - share) * ((self.afar[i].1 - before) / total);
        }
        let (mut node, mut part) = self.leaves[lamp];
        if node == NONE {
            return 0.0;
        }
        // From the root down, so that the product is the very one of `choose`.
        let mut way = Vec::with_capacity(16);
        loop {
            way.push((node, part));
            if node == 0 {
                break;
            }
            (node, part) = self.nodes[node as usize].parent;
        }
        let mut probability = share;
        for &(node, part) in way.iter().rev() {
            let weights = self.nodes[node as usize].bounds.importance(point);
            let sum: f32 = weights.iter().sum();
            if !(sum > 0.0 && sum.is_finite()) {
                return 0.0;
            }
            probability *= weights[usize::from(part)] / sum;
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
    fn the_strongest_lamps_that_there_are_do_not_leave_the_numbers() {
        let extents: Vec<Option<Extent>> = (0..40)
            .map(|i| (i % 4 != 0).then(|| Extent { strength: f32::MAX, ..extent(i, i % 2 == 0) }))
            .collect();
        let afar: Vec<f32> = (0..40).map(|i| if i % 4 == 0 { f32::MAX } else { 0.0 }).collect();
        let tree = LightTree::new(&extents, &afar);
        let mut sum = 0.0;
        for lamp in 0..40 {
            sum += tree.probability(&[], Vec3::splat(3.0), Vec3::Z, lamp);
        }
        assert!((sum - 1.0).abs() < 1e-5, "{sum}");
        for i in 0..200 {
            let (lamp, probability) = tree.choose(&[], Vec3::splat(3.0), Vec3::Z, chance(i)).unwrap();
            assert_eq!(probability, tree.probability(&[], Vec3::splat(3.0), Vec3::Z, lamp));
        }
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
