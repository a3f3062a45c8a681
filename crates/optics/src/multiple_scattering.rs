//! Light that meets more than one facet before it leaves a rough surface.
//!
//! In Smith's model heights and slopes of facets are independent, and a ray at a height where a fraction x of the facets lies
//! lower meets the next facet as in a one-dimensional medium (Heitz et al. 2016): going up with direction u it reaches
//! x' ≥ x with probability (x/x')^Λ(u), going down with d it reaches x' ≤ x with (x'/x)^(1+Λ(d)), whatever the
//! distribution of heights. What it meets has the visible normals of its direction, and is reflected or
//! refracted there by a smooth facet. A refracted ray goes on below the surface, where the same holds with 1 − x for x.
//!
//! That walk is solved here without chance, for light from every direction at once: x, the cosine to the normal and the
//! azimuth are divided into cells, the passage from cell to cell is integrated in closed form (so no light is lost),
//! azimuths are taken to their cosine series, in which every term scatters by itself, and orders of scattering are
//! followed until less than 10⁻⁵ of the light is left. The first order, which has a closed form
//! ([`crate::facets::Facets`]), is left out.

mod walk;

use crate::grazing_warp::GrazingWarp;
use std::f64::consts::PI;

/// Cells of height.
const HEIGHTS: usize = 16;
/// Nodes of the cosine, for each side of the horizon.
pub(crate) const COSINES: usize = 20;
/// Nodes of the azimuth, around the circle or a part of it.
const AZIMUTHS: usize = 24;
/// Nodes from forward to the farthest azimuth.
const HALF: usize = AZIMUTHS / 2 + 1;
/// The farthest azimuth in units of the slope: beyond, flat facets send next to nothing where several are met.
const FARTHEST: f64 = 14.0;

/// How far from grazing steps of the cosine are finer, by [`GrazingWarp`].
pub(crate) fn kappa(slope: f64) -> f64 {
    0.01 + 0.45 * slope
}

/// The directions at the nodes.
#[derive(Clone, Copy, Debug)]
struct Directions {
    warp: GrazingWarp<f64>,
    /// The farthest azimuth from forward, radians.
    farthest: f64,
}

impl Directions {
    fn new(slope: f64) -> Self {
        let farthest = (FARTHEST * slope).min(PI);
        Self { warp: GrazingWarp { kappa: kappa(slope) }, farthest }
    }

    /// Where a cosine lies, in nodes: 0 is the first, [`COSINES`] − 1 the last.
    fn position(self, cos: f64) -> f64 {
        (self.warp.of(cos) * COSINES as f64 - 0.5).clamp(0.0, (COSINES - 1) as f64)
    }

    fn node(self, i: usize) -> f64 {
        self.warp.cosine((i as f64 + 0.5) / COSINES as f64)
    }

    /// ∫ μ dω over the cell of a node and one step of azimuth.
    fn measure(self, i: usize) -> f64 {
        let [low, high] = [i, i + 1].map(|i| self.warp.cosine(i as f64 / COSINES as f64));
        0.5 * (high * high - low * low) * 2.0 * self.farthest / AZIMUTHS as f64
    }
}

/// What leaves a surface after two scatterings or more: a table of the bidirectional scattering function.
///
/// `G` groups of orders are kept apart; light from the first or second side goes to either.
#[derive(Clone, Debug)]
pub struct MultipleScattering<const G: usize> {
    nodes: Directions,
    /// ∫ μ dμ over the cell of each node.
    measures: [f32; COSINES],
    /// For every [`Sides`], at the nodes from which light comes: the sum of the table times measures over all nodes and azimuths.
    norms: [[f32; COSINES]; 4],
    /// For first to first, second to second, first to second: [cosine][cosine][azimuth, then the mean over all].
    blocks: Vec<Vec<[f32; G]>>,
}

/// Three groups for conductors: two scatterings, three, and all others.
pub type Reflected = MultipleScattering<3>;

/// One group for dielectrics, which absorb nothing.
pub type Refracted = MultipleScattering<1>;

/// The sides between which light goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sides {
    /// From the first (that of the normal) to the first.
    First,
    /// From the second to the second.
    Second,
    /// From the first to the second.
    Through,
    /// From the second to the first.
    Back,
}

impl Sides {
    /// The block of the table, and whether its rows are the directions to which light goes.
    #[inline(always)]
    fn block(self) -> (usize, bool) {
        match self {
            Self::First => (0, false),
            Self::Second => (1, false),
            Self::Through => (2, false),
            Self::Back => (2, true),
        }
    }
}

/// Where a cosine lies between nodes.
#[derive(Clone, Copy)]
struct Place {
    node: usize,
    part: f32,
    /// Towards the normal, beyond the last node, azimuths lose their meaning: from 1 to 0.
    turns: f32,
}

/// The table between two directions.
#[derive(Clone, Copy, Debug)]
pub struct Between<const G: usize> {
    /// On one side the bidirectional function f, 1/sr; through the surface ρ / (μ n²), where ρ is the share of power per solid angle
    /// that goes to the cosine μ in the index n, relative to that of the first side. In groups of orders.
    pub values: [f32; G],
    /// The density, 1/sr, of [`MultipleScattering::sample`].
    pub density: f32,
}

impl<const G: usize> MultipleScattering<G> {
    #[inline(always)]
    fn warp(&self) -> GrazingWarp<f32> {
        GrazingWarp { kappa: self.nodes.warp.kappa as f32 }
    }

    #[inline(always)]
    fn place(&self, cos: f32) -> Place {
        let x = self.warp().of(cos) * COSINES as f32 - 0.5;
        let node = (x.max(0.0) as usize).min(COSINES - 2);
        let turns = (2.0 * ((COSINES - 1) as f32 - x) + 1.0).clamp(0.0, 1.0);
        Place { node, part: (x - node as f32).clamp(0.0, 1.0), turns }
    }

    /// The entries of a pair of nodes: azimuths, then the mean over all.
    #[inline(always)]
    fn entries(&self, (block, turned): (usize, bool), from: usize, to: usize) -> &[[f32; G]] {
        let (row, column) = if turned { (to, from) } else { (from, to) };
        let at = (row * COSINES + column) * (HALF + 1);
        &self.blocks[block][at..at + HALF + 1]
    }

    /// The table between the cosines (positive) from which and to which light goes, and the cosine of the azimuth from forward, where 1 is the
    /// azimuth of the mirrored or refracted direction.
    #[inline]
    #[must_use]
    pub fn at(&self, sides: Sides, from: f32, to: f32, cos_azimuth: f32) -> Between<G> {
        use crate::Real;
        let block = sides.block();
        let angle = cos_azimuth.clamp(-1.0, 1.0).arc_cos();
        let x = angle * ((HALF - 1) as f32 / self.nodes.farthest as f32);
        let k = (x as usize).min(HALF - 2);
        let r = x - k as f32;
        // Nothing beyond the farthest azimuth, if that is not the whole circle.
        let inside = if r <= 1.0 || self.nodes.farthest >= PI { 1.0 } else { 0.0 };
        let r = r.min(1.0);
        let (a, b) = (self.place(from), self.place(to));
        let turns = a.turns * b.turns;
        let mut values = [0.0; G];
        let (mut density, mut norm) = (0.0, 0.0);
        for (row, wi) in [(a.node, 1.0 - a.part), (a.node + 1, a.part)] {
            norm += wi * self.norms[sides as usize][row];
            for (column, wj) in [(b.node, 1.0 - b.part), (b.node + 1, b.part)] {
                let entries = self.entries(block, row, column);
                let w = wi * wj;
                let mut sum = 0.0;
                for (g, value) in values.iter_mut().enumerate() {
                    let here = inside * ((1.0 - r) * entries[k][g] + r * entries[k + 1][g]);
                    let here = w * (turns * here + (1.0 - turns) * entries[HALF][g]);
                    *value += here;
                    sum += here;
                }
                density += self.measures[column] * sum;
            }
        }
        // At the normal itself steps of the cosine vanish, and the density grows without bound.
        let step = (self.warp().slope(to) / COSINES as f32).max(1e-6);
        let density = if norm > 0.0 { density / (norm * step) } else { 0.0 };
        Between { values, density }
    }

    /// Draws where light goes that comes from a cosine, from two numbers in [0, 1): the cosine (positive) and the azimuth from forward, radians.
    /// `None` where none goes there.
    #[must_use]
    pub fn sample(&self, sides: Sides, from: f32, u: [f32; 2]) -> Option<(f32, f32)> {
        let block = sides.block();
        let a = self.place(from);
        let rows = [(a.node, 1.0 - a.part), (a.node + 1, a.part)];
        let mix = |column: usize, k: usize| -> f32 {
            rows.iter().map(|&(row, w)| w * self.entries(block, row, column)[k].iter().sum::<f32>()).sum()
        };
        let shares: [f32; COSINES] = std::array::from_fn(|j| mix(j, HALF) * self.measures[j]);
        let (column, rest) = choose(&shares, u[0])?;
        let x = hat(column, COSINES, rest, true);
        let warp = GrazingWarp { kappa: self.nodes.warp.kappa };
        let cos = warp.cosine((f64::from(x) + 0.5) / COSINES as f64).clamp(1e-6, 1.0) as f32;
        let (side, rest) = if u[1] < 0.5 { (1.0, 2.0 * u[1]) } else { (-1.0, 2.0 * u[1] - 1.0) };
        let turns = a.turns * self.place(cos).turns;
        if rest >= turns {
            let azimuth = (rest - turns) / (1.0 - turns).max(1e-6) * std::f32::consts::PI;
            return Some((cos, side * azimuth));
        }
        let ends = |k: usize| if k == 0 || k == HALF - 1 { 0.5 } else { 1.0 };
        let shares: [f32; HALF] = std::array::from_fn(|k| ends(k) * mix(column, k));
        let (k, rest) = choose(&shares, rest / turns)?;
        let azimuth = hat(k, HALF, rest, false) * (self.nodes.farthest as f32 / (HALF - 1) as f32);
        Some((cos, side * azimuth))
    }

    /// The farthest azimuth from forward, radians, to which light goes.
    #[must_use]
    pub fn farthest(&self) -> f64 {
        self.nodes.farthest
    }
}

/// Chooses by shares with a number in [0, 1), and gives what is left of it, in [0, 1) again.
fn choose(shares: &[f32], u: f32) -> Option<(usize, f32)> {
    let total: f32 = shares.iter().sum();
    if !(total > 0.0) {
        return None;
    }
    let mut wanted = u * total;
    for (i, &share) in shares.iter().enumerate() {
        if wanted < share {
            return Some((i, wanted / share));
        }
        wanted -= share;
    }
    let last = shares.iter().rposition(|&share| share > 0.0)?;
    Some((last, 1.0 - f32::EPSILON))
}

/// A position with the density of the hat function of a node. At the ends hats go on flat for half a step (`flat`), or are cut.
fn hat(node: usize, count: usize, u: f32, flat: bool) -> f32 {
    let x = node as f32;
    let (lower, upper) = (node == 0, node == count - 1);
    // Half of the area lies on each side, but for ends that are cut.
    let half = if lower && !flat {
        0.0
    } else if upper && !flat {
        1.0
    } else {
        0.5
    };
    if u < half {
        let v = u / half;
        if lower { x - 0.5 * (1.0 - v) } else { x - (1.0 - v.sqrt()) }
    } else {
        let v = (u - half) / (1.0 - half);
        if upper { x + 0.5 * v } else { x + 1.0 - (1.0 - v).max(0.0).sqrt() }
    }
}
