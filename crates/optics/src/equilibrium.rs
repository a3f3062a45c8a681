//! Energy equilibrium of a rough surface (book 2.3.4, eq 2.50): nothing lost, nothing gained, at any angle.
//!
//! Let ρ(a, b) be the share of the power from direction a that facets send to b. Single scattering is exact; what it
//! leaves, 1 − Σ_b ρ₁(a, b), is what multiple scattering has to bring. The table of [`crate::multiple_scattering`] brings it to
//! about a percent, and a factor c for each direction, ρ(a, b) = ρ₁(a, b) + c(a) c(b) ρ₂(a, b), does the rest.
//!
//! A relief that is not much higher than a wavelength scatters only a fraction s(a, b) between two directions; the rest stays
//! coherent (book eq 2.37), and goes to mirror directions. What ought to be scattered in all, A(a), is what is not
//! coherent; but s belongs to pairs of directions that are no mirror images, so the sum over b is not A(a). Theory that
//! ends there needs a diffuse term of either sign (book figure 2.22). Here the balance is closed by factors
//! u(a) = min(1, A(a)/Σ_b s ρ), which leave a rest e(a) = A(a) − u(a) Σ_b s ρ u(b) that is never negative, and is
//! scattered as e(a) e(b)/Σ e.
//!
//! What is scattered is not negative, reciprocal where s and ρ are, and in equilibrium.

use crate::Vector;
use crate::facets::Facets;
use crate::fresnel::dielectric;
use crate::grazing_warp::GrazingWarp;
use crate::multiple_scattering::{self, MultipleScattering, Sides};
use crate::vectors::{dot, reflect, refract};
use std::f64::consts::{FRAC_PI_2, PI};

/// The nodes of the cosine: four steps between those of the table of multiple scattering, which is linear between its own.
const COSINES: usize = 4 * multiple_scattering::COSINES + 1;
/// Where there is a critical angle: the node at half its cosine, and that at its cosine.
const GRAZING: usize = 28;
const CRITICAL: usize = 44;
/// The nodes of the azimuth from along to across the grain, where there is one.
const AZIMUTHS: usize = 7;
/// The rows and columns of visible normals over which single scattering is integrated.
const NORMALS: usize = 48;

/// A share of power that is no longer scaled.
const NEXT_TO_NOTHING: f64 = 3e-4;
/// The steps of scaling multiple scattering.
const MULTIPLE_STEPS: usize = 100;

/// Directions above one side of a surface at which something is known: steps of the cosine that are finer near grazing and
/// near the critical angle, and of the azimuth if there is a grain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    warp: GrazingWarp<f32>,
    /// The cosine of the critical angle, at which a node lies; 0 where there is none.
    critical: f32,
    azimuths: usize,
}

impl Grid {
    /// `eta` is the index of the other side relative to this one.
    fn new(facets: &Facets<f64>, eta: Option<f64>) -> Self {
        let [mx, my] = facets.slope;
        let critical = eta.filter(|&eta| eta < 1.0).map_or(0.0, |eta| (1.0 - eta * eta).sqrt());
        Self {
            warp: GrazingWarp { kappa: multiple_scattering::kappa(mx.max(my)) as f32 },
            critical: critical as f32,
            azimuths: if mx == my { 1 } else { AZIMUTHS },
        }
    }

    /// The nodes of the cosine.
    pub const COSINES: usize = COSINES;

    /// How many nodes there are.
    #[must_use]
    pub fn nodes(&self) -> usize {
        COSINES * self.azimuths
    }

    /// Where a cosine lies, in nodes.
    #[inline(always)]
    #[must_use]
    pub fn position(&self, cos: f32) -> f32 {
        if self.critical == 0.0 {
            return self.warp.of(cos) * (COSINES - 1) as f32;
        }
        let x = 2.0 * cos / self.critical;
        if x < 1.0 {
            self.warp.of(x) * GRAZING as f32
        } else if x < 2.0 {
            CRITICAL as f32 - self.warp.of(2.0 - x) * (CRITICAL - GRAZING) as f32
        } else {
            // Next to the critical angle reflectance goes as the root.
            let root = ((cos - self.critical) / (1.0 - self.critical)).sqrt();
            CRITICAL as f32 + root * (COSINES - 1 - CRITICAL) as f32
        }
    }

    /// The cosine at a position between the first node, 0, and the last.
    #[must_use]
    pub fn cosine(&self, position: f64) -> f64 {
        let [grazing, middle, last] = [GRAZING, CRITICAL, COSINES - 1].map(|i| i as f64);
        let warp = GrazingWarp { kappa: f64::from(self.warp.kappa) };
        let critical = f64::from(self.critical);
        if critical == 0.0 {
            warp.cosine(position / last)
        } else if position < grazing {
            0.5 * critical * warp.cosine(position / grazing)
        } else if position < middle {
            critical * (1.0 - 0.5 * warp.cosine((middle - position) / (middle - grazing)))
        } else {
            let root = (position - middle) / (last - middle);
            critical + (1.0 - critical) * root * root
        }
    }

    /// Interpolates between nodes at a direction: calls `add` with the nodes around it and their weights.
    #[inline(always)]
    pub fn interpolate(&self, v: Vector<f32>, mut add: impl FnMut(usize, f32)) {
        let w = self.position(v[2].abs().min(1.0));
        let i = (w as usize).min(COSINES - 2);
        let p = (w - i as f32).clamp(0.0, 1.0);
        if self.azimuths == 1 {
            add(i, 1.0 - p);
            add(i + 1, p);
            return;
        }
        let angle = v[1].abs().atan2(v[0].abs()) / std::f32::consts::FRAC_PI_2 * (AZIMUTHS - 1) as f32;
        let j = (angle as usize).min(AZIMUTHS - 2);
        let q = (angle - j as f32).clamp(0.0, 1.0);
        for (i, p) in [(i, 1.0 - p), (i + 1, p)] {
            add(i * AZIMUTHS + j, p * (1.0 - q));
            add(i * AZIMUTHS + j + 1, p * q);
        }
    }

    /// ∫ g cos θ dω over the hemisphere of a function that is known at the nodes.
    #[must_use]
    pub fn projected_integral(&self, values: &[f64]) -> f64 {
        const PARTS: usize = 8;
        let mut sum = 0.0;
        for i in 0..PARTS * (COSINES - 1) {
            let [low, high] = [i, i + 1].map(|i| self.cosine(i as f64 / PARTS as f64));
            let w = (i as f64 + 0.5) / PARTS as f64;
            let (row, p) = (w as usize, w.fract());
            // Over the azimuths of a quadrant by the trapezoidal rule.
            for j in 0..self.azimuths {
                let ends = j == 0 || j == self.azimuths - 1;
                let weight = match self.azimuths {
                    1 => 1.0,
                    n => (if ends { 0.5 } else { 1.0 }) / (n - 1) as f64,
                };
                let at = |row: usize| values[row * self.azimuths + j];
                sum += weight * ((1.0 - p) * at(row) + p * at(row + 1)) * PI * (high * high - low * low);
            }
        }
        sum
    }

    /// The direction of a node.
    #[must_use]
    pub fn direction(&self, node: usize) -> Vector<f64> {
        let (i, j) = (node / self.azimuths, node % self.azimuths);
        // A direction in the surface itself sees no facets.
        let z = self.cosine((i as f64).max(0.1)).min(1.0);
        let r = (1.0 - z * z).sqrt();
        let (sin, cos) = (FRAC_PI_2 * j as f64 / (self.azimuths - 1).max(1) as f64).sin_cos();
        [r * cos, r * sin, z]
    }
}

/// The shares of power that go between the nodes of a surface's sides.
#[derive(Clone, Debug)]
struct Shares {
    /// For each side: [from][to] on the same side.
    reflected: Vec<Vec<f64>>,
    /// For each side: [from][to] through the surface.
    transmitted: Vec<Vec<f64>>,
}

/// A surface whose scattered light is balanced.
#[derive(Clone, Debug)]
pub struct Balance {
    /// Where factors are known, on each side.
    pub grids: [Grid; 2],
    /// The factors c of multiple scattering at the nodes of each side.
    pub multiple: Vec<Vec<f64>>,
    /// The share of power that multiple scattering brings back to each side.
    pub multiple_reflected: Vec<Vec<f64>>,
    /// The share that it brings through.
    pub multiple_transmitted: Vec<Vec<f64>>,
    /// The mean cosine of incidence, from the nodes of the first side, at facets whose reflection meets another facet.
    pub first_cosines: Vec<f64>,
    facets: Facets<f64>,
    eta: Option<f64>,
    /// Single scattering, and what multiple scattering adds.
    single: Shares,
    more: Shares,
}

impl Balance {
    /// The balance of facets that reflect everything (`eta` is `None`), or of a dielectric boundary with the index `eta` of its
    /// second side relative to the first. `multiple` is the table of multiple scattering.
    #[must_use]
    pub fn new<const G: usize>(
        facets: &Facets<f64>,
        eta: Option<f64>,
        multiple: &MultipleScattering<G>,
    ) -> Self {
        let grids = [eta, eta.map(f64::recip)].map(|eta| Grid::new(facets, eta));
        let n = grids[0].nodes();
        let mut single = Shares::none(n, eta.is_some());
        let mut more = single.clone();
        for side in 0..single.reflected.len() {
            let eta = eta.map(|eta| if side == 0 { eta } else { eta.recip() });
            for node in 0..n {
                single.add_single(&grids, facets, eta, side, node);
                more.add_multiple(&grids, multiple, eta, side, node);
            }
        }
        let multiple = single.complete(&mut more, n);
        let rows = |tables: &[Vec<f64>]| {
            let sums = |table: &Vec<f64>| table.chunks(n).map(|row| row.iter().sum()).collect();
            tables.iter().map(sums).collect()
        };
        let first_cosines = (0..n).map(|node| first_cosine(facets, grids[0].direction(node))).collect();
        Self {
            first_cosines,
            multiple,
            multiple_reflected: rows(&more.reflected),
            multiple_transmitted: rows(&more.transmitted),
            grids,
            facets: *facets,
            eta,
            single,
            more,
        }
    }

    /// How many nodes each side has.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.grids[0].nodes()
    }

    /// The cosine at every node of a side.
    #[must_use]
    pub fn cosines(&self, side: usize) -> Vec<f64> {
        (0..self.nodes()).map(|node| self.grids[side].direction(node)[2]).collect()
    }

    /// The number of sides on which light can be: 2 if it goes through.
    #[must_use]
    pub fn sides(&self) -> usize {
        self.single.reflected.len()
    }

    /// The share of power from each node of a side that comes back to it.
    #[must_use]
    pub fn reflectance(&self, side: usize) -> Vec<f64> {
        let n = self.nodes();
        let rows = self.single.reflected[side].chunks(n).zip(self.more.reflected[side].chunks(n));
        rows.map(|(single, more)| single.iter().sum::<f64>() + more.iter().sum::<f64>()).collect()
    }

    /// Calls `add` for light from a node of a side with whether it goes through, a direction (above the side to which it goes) and a
    /// share; the sum of all shares is 1.
    pub fn for_each(&self, side: usize, node: usize, mut add: impl FnMut(bool, Vector<f64>, f64)) {
        let n = self.nodes();
        let eta = self.eta.map(|eta| if side == 0 { eta } else { eta.recip() });
        single_scattering(&self.facets, eta, self.grids[side].direction(node), &mut add);
        for (through, table) in [(false, &self.more.reflected[side]), (true, &self.more.transmitted[side])] {
            let target = if through { 1 - side } else { side };
            for to in 0..n {
                let share = table[node * n + to];
                if share > 0.0 {
                    add(through, self.grids[target].direction(to), share);
                }
            }
        }
    }
}

/// Calls `visit` for visible normals that are spread evenly, with a weight; the weights have the sum 1.
fn for_visible(facets: &Facets<f64>, v: Vector<f64>, mut visit: impl FnMut(Vector<f64>, f64)) {
    // Closer steps at both ends, where the steepest facets are.
    let steps = if v[2] < 0.1 { 2 * NORMALS } else { NORMALS };
    let step = |i: usize| {
        let t = (i as f64 + 0.5) / steps as f64;
        (t * t * t.mul_add(-2.0, 3.0), 6.0 * t * (1.0 - t) / steps as f64)
    };
    let total: f64 = (0..steps).map(|i| step(i).1).sum();
    for i in 0..steps {
        for j in 0..steps {
            let ((a, width), (b, height)) = (step(i), step(j));
            visit(facets.sample_visible(v, [a, b]), width * height / (total * total));
        }
    }
}

/// The mean cosine of incidence at facets whose reflection does not leave.
fn first_cosine(facets: &Facets<f64>, v: Vector<f64>) -> f64 {
    let seen = facets.masking(v);
    let (mut sum, mut all) = (0.0, 0.0);
    for_visible(facets, v, |h, each| {
        let (cos, l) = (dot(v, h).max(0.0), reflect(v, h));
        let stays = if l[2] > 0.0 { 1.0 - facets.masking_shadowing(v, l) / seen } else { 1.0 };
        // Where next to nothing stays, any cosine does.
        let weight = each * (stays.max(0.0) + 1e-9);
        sum += weight * cos;
        all += weight;
    });
    sum / all
}

/// Calls `add` for the directions to which visible facets reflect and refract, both with z > 0, and shares.
fn single_scattering(
    facets: &Facets<f64>,
    eta: Option<f64>,
    v: Vector<f64>,
    mut add: impl FnMut(bool, Vector<f64>, f64),
) {
    let seen = facets.masking(v);
    for_visible(facets, v, |h, each| {
        let cos = dot(v, h);
        if cos <= 0.0 {
            return;
        }
        let fresnel = eta.map_or(1.0, |eta| dielectric(cos, eta));
        let l = reflect(v, h);
        if l[2] > 0.0 {
            add(false, l, fresnel * facets.masking_shadowing(v, l) / seen * each);
        }
        let Some((t, _)) = eta.and_then(|eta| refract(v, h, eta)) else { return };
        if t[2] < 0.0 {
            let share = (1.0 - fresnel) * facets.masking_shadowing(v, t) / seen * each;
            add(true, [t[0], t[1], -t[2]], share);
        }
    });
}

impl Shares {
    fn none(n: usize, two_sides: bool) -> Self {
        let none = vec![vec![0.0; n * n]; if two_sides { 2 } else { 1 }];
        Self { reflected: none.clone(), transmitted: none }
    }

    /// Adds to the nodes around a direction.
    fn add(
        &mut self,
        grids: &[Grid; 2],
        side: usize,
        through: bool,
        from: usize,
        to: Vector<f64>,
        share: f64,
    ) {
        let n = grids[0].nodes();
        let (table, target) =
            if through { (&mut self.transmitted[side], 1 - side) } else { (&mut self.reflected[side], side) };
        grids[target].interpolate(to.map(|x| x as f32), |node, weight| {
            table[from * n + node] += f64::from(weight) * share;
        });
    }

    fn add_single(
        &mut self,
        grids: &[Grid; 2],
        facets: &Facets<f64>,
        eta: Option<f64>,
        side: usize,
        node: usize,
    ) {
        let v = grids[side].direction(node);
        single_scattering(facets, eta, v, |through, to, share| {
            self.add(grids, side, through, node, to, share);
        });
    }

    fn add_multiple<const G: usize>(
        &mut self,
        grids: &[Grid; 2],
        table: &MultipleScattering<G>,
        eta: Option<f64>,
        side: usize,
        node: usize,
    ) {
        const TURNS: usize = 24;
        let v = grids[side].direction(node);
        let own = if side == 0 { Sides::First } else { Sides::Second };
        // The index on the other side relative to the first.
        let n2 = if side == 0 { eta.unwrap_or(1.0).powi(2) } else { 1.0 };
        let steps = 4 * (COSINES - 1);
        let warp = GrazingWarp { kappa: f64::from(grids[0].warp.kappa) };
        for i in 0..steps {
            let [low, high] = [i, i + 1].map(|i| warp.cosine(i as f64 / steps as f64));
            let z = 0.5 * (low + high);
            let measure = z * (high - low) * 2.0 * table.farthest() / TURNS as f64;
            let r = (1.0 - z * z).max(0.0).sqrt();
            for k in 0..TURNS {
                let turn = table.farthest() * (2.0 * (k as f64 + 0.5) / TURNS as f64 - 1.0);
                // Azimuths count from that of the mirrored direction, opposite to the view.
                let azimuth = v[1].atan2(v[0]) + PI + turn;
                let l = [r * azimuth.cos(), r * azimuth.sin(), z];
                let mut pass = |through: bool, sides: Sides, n2: f64| {
                    let f = table.at(sides, v[2] as f32, z as f32, turn.cos() as f32).values;
                    let share = f64::from(f.iter().sum::<f32>()) * n2 * measure;
                    self.add(grids, side, through, node, l, share);
                };
                pass(false, own, 1.0);
                if eta.is_some() {
                    pass(true, if side == 0 { Sides::Through } else { Sides::Back }, n2);
                }
            }
        }
    }

    /// Multiplies multiple scattering by factors that make every sum with it 1; they are returned.
    fn complete(&self, more: &mut Self, n: usize) -> Vec<Vec<f64>> {
        let sides = self.reflected.len();
        let all = |shares: &Self| {
            let mut matrix = vec![0.0; (sides * n).pow(2)];
            for side in 0..sides {
                for (through, table) in [(false, &shares.reflected[side]), (true, &shares.transmitted[side])]
                {
                    let target = if through { sides - 1 - side } else { side };
                    for (i, share) in table.iter().enumerate() {
                        matrix[(side * n + i / n) * sides * n + target * n + i % n] += share;
                    }
                }
            }
            matrix
        };
        let wanted: Vec<f64> = all(self).chunks(sides * n).map(|row| 1.0 - row.iter().sum::<f64>()).collect();
        let matrix = all(&*more);
        let mut factors = vec![1.0; sides * n];
        for _ in 0..MULTIPLE_STEPS {
            factors = step(&matrix, &factors, &wanted);
            factors.iter_mut().for_each(|c| *c = c.clamp(0.0, 2.0));
        }
        let factors: Vec<Vec<f64>> = factors.chunks(n).map(<[f64]>::to_vec).collect();
        for side in 0..sides {
            for i in 0..n * n {
                let from = factors[side][i / n];
                more.reflected[side][i] *= from * factors[side][i % n];
                more.transmitted[side][i] *= from * factors[sides - 1 - side][i % n];
            }
        }
        factors
    }
}

/// One step of symmetric scaling of a non-negative matrix to sums of its rows (Sinkhorn 1967): u_i √(a_i / (u_i Σ_j M_ij u_j)),
/// and no change where the sum is next to nothing.
fn step(matrix: &[f64], u: &[f64], wanted: &[f64]) -> Vec<f64> {
    let next = u.iter().zip(wanted).zip(matrix.chunks(u.len())).map(|((&c, &wanted), row)| {
        let sum: f64 = row.iter().zip(u).map(|(m, u)| m * u).sum();
        c * ((wanted.max(0.0) + NEXT_TO_NOTHING) / (c * sum + NEXT_TO_NOTHING)).sqrt()
    });
    next.collect()
}
