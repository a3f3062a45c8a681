//! The walk over facets that fills the table of multiple scattering, solved without chance.

use super::{AZIMUTHS, COSINES, Directions, HALF, HEIGHTS, MultipleScattering, Reflected, Refracted, Sides};
use crate::facets::Facets;
use crate::fresnel::dielectric;
use crate::vectors::{reflect, refract};
use std::f64::consts::{PI, TAU};

/// Where orders of scattering end.
const REST: f64 = 1e-5;
/// The most orders that are followed.
const ORDERS: usize = 60;

impl Reflected {
    /// Facets that reflect everything: the share of light of each order. `facets` must be isotropic with a slope of 0.05 or more.
    #[must_use]
    pub fn solve(facets: &Facets<f64>) -> Self {
        let walk = Walk::new(*facets, None);
        let leaving = walk.follow(|order| match order {
            2 => 0,
            3 => 1,
            _ => 2,
        });
        walk.table(&leaving)
    }
}

impl Refracted {
    /// Dielectric facets with the index `eta` of the second side relative to the first.
    #[must_use]
    pub fn solve(facets: &Facets<f64>, eta: f64) -> Self {
        let walk = Walk::new(*facets, Some(eta));
        let leaving = walk.follow(|_| 0);
        walk.table(&leaving)
    }
}

/// The share that goes from each cell of direction to each other, for one term of the cosine series.
type Matrix = Vec<f32>;

struct Walk {
    nodes: Directions,
    eta: Option<f64>,
    /// Sides of the surface on which light travels.
    worlds: usize,
    /// [term][from][to]
    scattering: Vec<Matrix>,
    /// For each of down, up: [cosine][from height][to height], heights counted from the bottom of the own side.
    passage: [Vec<[[f32; HEIGHTS]; HEIGHTS]>; 2],
    /// [cosine][height]: the share of what goes up that leaves.
    escape: Vec<[f32; HEIGHTS]>,
    /// [cosine][height]: where light from outside is scattered first.
    first: Vec<[f32; HEIGHTS]>,
}

/// The number of a cell of direction.
const fn cell(world: usize, up: bool, cosine: usize) -> usize {
    (world * 2 + up as usize) * COSINES + cosine
}

/// The edge of cells of height, closer together at both ends.
fn edge(i: usize) -> f64 {
    let s = (PI * i as f64 / (2 * HEIGHTS) as f64).sin();
    s * s
}

impl Walk {
    fn new(facets: Facets<f64>, eta: Option<f64>) -> Self {
        let nodes = Directions::new(facets.slope[0]);
        let lambda: [f64; COSINES] = std::array::from_fn(|i| {
            let z = nodes.node(i);
            facets.lambda([(1.0 - z * z).sqrt(), 0.0, z])
        });
        let passage = [
            lambda.iter().map(|l| downwards(1.0 + l)).collect(),
            lambda.iter().map(|&l| upwards(l)).collect(),
        ];
        let escape = lambda.iter().map(|&l| std::array::from_fn(|c| mean_power(c, l) as f32)).collect();
        let first = lambda
            .iter()
            .map(|l| std::array::from_fn(|c| (edge(c + 1).powf(1.0 + l) - edge(c).powf(1.0 + l)) as f32));
        let worlds = if eta.is_some() { 2 } else { 1 };
        let mut walk =
            Self { nodes, eta, worlds, scattering: Vec::new(), passage, escape, first: first.collect() };
        walk.scattering = walk.scatter(&facets);
        walk
    }

    fn directions(&self) -> usize {
        self.worlds * 2 * COSINES
    }

    /// What facets make of light from every cell of direction.
    fn scatter(&self, facets: &Facets<f64>) -> Vec<Matrix> {
        let count = self.directions();
        let mut terms = vec![vec![0f32; count * count]; HALF];
        let mut row = vec![0f64; count * AZIMUTHS];
        for world in 0..self.worlds {
            for up in [false, true] {
                for cosine in 0..COSINES {
                    row.fill(0.0);
                    for part in [0.25, 0.75] {
                        let z = self.nodes.warp.cosine((cosine as f64 + part) / COSINES as f64);
                        self.scatter_from(facets, world, if up { -z } else { z }, &mut row);
                    }
                    let total: f64 = row.iter().sum();
                    if !(total > 0.0) {
                        continue;
                    }
                    let from = cell(world, up, cosine);
                    for to in 0..count {
                        let around = &row[to * AZIMUTHS..(to + 1) * AZIMUTHS];
                        for (term, matrix) in terms.iter_mut().enumerate() {
                            let sum: f64 =
                                around.iter().enumerate().map(|(k, m)| m * cosine_of(term * k)).sum();
                            matrix[from * count + to] = (sum / total) as f32;
                        }
                    }
                }
            }
        }
        terms
    }

    /// Adds what visible facets make of light that is seen from a view with this cosine, negative when the light travels up.
    fn scatter_from(&self, facets: &Facets<f64>, world: usize, z: f64, row: &mut [f64]) {
        const RADII: usize = 32;
        const ANGLES: usize = 48;
        let eta = self.eta.map(|eta| if world == 0 { eta } else { eta.recip() });
        let v = [(1.0 - z * z).max(0.0).sqrt(), 0.0, z];
        let m = facets.slope[0];
        for i in 0..RADII {
            let r = m * facets.shape.slope_radius((i as f64 + 0.5) / RADII as f64);
            for j in 0..ANGLES {
                let (sin, cos) = (PI * (f64::from(j as u32) + 0.5) / ANGLES as f64).sin_cos();
                let (x, y) = (r * cos, r * sin);
                let seen = v[0] * x + z;
                if seen <= 0.0 {
                    continue;
                }
                let length = (x * x + y * y + 1.0).sqrt();
                let h = [x / length, y / length, 1.0 / length];
                let fresnel = eta.map_or(1.0, |eta| dielectric(seen / length, eta));
                self.add(world, reflect(v, h), seen * fresnel, row);
                if let Some((t, _)) = eta.and_then(|eta| refract(v, h, eta)) {
                    self.add(1 - world, [t[0], t[1], -t[2]], seen * (1.0 - fresnel), row);
                }
            }
        }
    }

    /// Divides light between the nodes around its direction, whose azimuth counts from that in which it came.
    fn add(&self, world: usize, direction: [f64; 3], mass: f64, row: &mut [f64]) {
        let position = self.nodes.position(direction[2].abs());
        let (i, p) = (position as usize, position.fract());
        let azimuth = direction[1].abs().atan2(-direction[0]);
        let steps = azimuth / self.nodes.farthest * (HALF - 1) as f64;
        let (k, q) = (steps as usize, steps.fract());
        for (i, p) in [(i, 1.0 - p), ((i + 1).min(COSINES - 1), p)] {
            let around = &mut row[cell(world, direction[2] > 0.0, i) * AZIMUTHS..][..AZIMUTHS];
            for (k, q) in [(k, 1.0 - q), (k + 1, q)] {
                // The mirror image has the same share.
                let k = k % AZIMUTHS;
                around[k] += 0.5 * mass * p * q;
                around[(AZIMUTHS - k) % AZIMUTHS] += 0.5 * mass * p * q;
            }
        }
    }

    /// The light that leaves after two scatterings or more, in groups of orders:
    /// [term][group][from node of the cosine][to node], nodes of all sides in a row.
    fn follow<const G: usize>(&self, group: impl Fn(usize) -> usize) -> Vec<Vec<[f64; G]>> {
        let count = self.directions();
        let sides = self.worlds * COSINES;
        let columns = sides * HEIGHTS;
        let mut leaving = vec![vec![[0.0; G]; sides * sides]; HALF];
        for (term, leaving) in leaving.iter_mut().enumerate() {
            let matrix = &self.scattering[term];
            // Light that has been scattered: [direction][from][height].
            let mut light = vec![0f32; count * columns];
            for from in 0..sides {
                let (world, cosine) = (from / COSINES, from % COSINES);
                for to in 0..count {
                    let share = matrix[cell(world, false, cosine) * count + to];
                    for height in 0..HEIGHTS {
                        light[to * columns + from * HEIGHTS + self.height(world, height)] =
                            share * self.first[cosine][height];
                    }
                }
            }
            let mut collided = vec![0f32; count * columns];
            for order in 1..ORDERS {
                if order > 1 {
                    self.leave(&light, |from, to, share| leaving[from * sides + to][group(order)] += share);
                }
                self.pass(&light, &mut collided);
                let left: f32 = collided.iter().map(|v| v.abs()).sum();
                if f64::from(left) < REST * sides as f64 {
                    break;
                }
                light.fill(0.0);
                for from in 0..count {
                    let source = &collided[from * columns..(from + 1) * columns];
                    for to in 0..count {
                        let share = matrix[from * count + to];
                        if share != 0.0 {
                            let target = &mut light[to * columns..(to + 1) * columns];
                            for (t, s) in target.iter_mut().zip(source) {
                                *t += share * s;
                            }
                        }
                    }
                }
            }
        }
        leaving
    }

    /// Heights are counted from the bottom of the first side; from the other side they run the other way.
    fn height(&self, world: usize, own: usize) -> usize {
        if world == 0 { own } else { HEIGHTS - 1 - own }
    }

    fn leave(&self, light: &[f32], mut add: impl FnMut(usize, usize, f64)) {
        let sides = self.worlds * COSINES;
        for to in 0..sides {
            let (world, cosine) = (to / COSINES, to % COSINES);
            let row = &light[cell(world, true, cosine) * sides * HEIGHTS..][..sides * HEIGHTS];
            for from in 0..sides {
                let share: f32 = (0..HEIGHTS)
                    .map(|own| row[from * HEIGHTS + self.height(world, own)] * self.escape[cosine][own])
                    .sum();
                add(from, to, f64::from(share));
            }
        }
    }

    /// Where light that has been scattered meets the next facet.
    fn pass(&self, light: &[f32], collided: &mut [f32]) {
        let sides = self.worlds * COSINES;
        for world in 0..self.worlds {
            for up in [false, true] {
                for cosine in 0..COSINES {
                    let direction = cell(world, up, cosine);
                    let shares = &self.passage[usize::from(up)][cosine];
                    for from in 0..sides {
                        let at = (direction * sides + from) * HEIGHTS;
                        let mut own = [0f32; HEIGHTS];
                        for (height, own) in own.iter_mut().enumerate() {
                            *own = light[at + self.height(world, height)];
                        }
                        let mut met = [0f32; HEIGHTS];
                        for (share, row) in own.iter().zip(shares) {
                            for (met, s) in met.iter_mut().zip(row) {
                                *met += share * s;
                            }
                        }
                        for (height, met) in met.into_iter().enumerate() {
                            collided[at + self.height(world, height)] = met;
                        }
                    }
                }
            }
        }
    }

    /// The bidirectional function at the nodes, the same when both directions change places.
    fn table<const G: usize>(&self, leaving: &[Vec<[f64; G]>]) -> MultipleScattering<G> {
        let sides = self.worlds * COSINES;
        // The share between two nodes around the circle, from its cosine series.
        let share = |from: usize, to: usize, k: usize, g: usize| {
            let series = |term: usize| leaving[term][from * sides + to][g] * cosine_of(term * k);
            let ends = series(0) + series(HALF - 1);
            let inner: f64 = (1..HALF - 1).map(series).sum();
            (ends + 2.0 * inner) / AZIMUTHS as f64
        };
        let n2 = |world: usize| if world == 0 { 1.0 } else { self.eta.unwrap_or(1.0).powi(2) };
        let function = |from: usize, to: usize, k: usize, g: usize| {
            share(from, to, k, g) / (self.nodes.measure(to % COSINES) * n2(to / COSINES))
        };
        let block = |first: usize, second: usize| {
            let mut block = Vec::with_capacity(COSINES * COSINES * (HALF + 1));
            for i in 0..COSINES {
                for j in 0..COSINES {
                    let (a, b) = (first * COSINES + i, second * COSINES + j);
                    let own = if first == second { n2(first) } else { 1.0 };
                    let mut mean = [0.0; G];
                    for k in 0..HALF {
                        let at: [f32; G] = std::array::from_fn(|g| {
                            let both = 0.5 * (function(a, b, k, g) + function(b, a, k, g));
                            (own * both).max(0.0) as f32
                        });
                        let weight = if k == 0 || k == HALF - 1 { 1.0 } else { 2.0 } / AZIMUTHS as f32;
                        for (mean, f) in mean.iter_mut().zip(at) {
                            *mean += weight * f * (self.nodes.farthest / PI) as f32;
                        }
                        block.push(at);
                    }
                    block.push(mean);
                }
            }
            block
        };
        let blocks =
            if self.worlds == 1 { vec![block(0, 0)] } else { vec![block(0, 0), block(1, 1), block(0, 1)] };
        let steps = 2.0 * self.nodes.farthest / AZIMUTHS as f64;
        let measures = std::array::from_fn(|i| (self.nodes.measure(i) / steps) as f32);
        let mut table =
            MultipleScattering { nodes: self.nodes, measures, norms: [[0.0; COSINES]; 4], blocks };
        let sides: &[Sides] = if self.worlds == 1 {
            &[Sides::First]
        } else {
            &[Sides::First, Sides::Second, Sides::Through, Sides::Back]
        };
        for &sides in sides {
            table.norms[sides as usize] = std::array::from_fn(|from| {
                let share = |to: usize| {
                    measures[to] * table.entries(sides.block(), from, to)[HALF].iter().sum::<f32>()
                };
                (0..COSINES).map(share).sum::<f32>() * std::f32::consts::TAU
            });
        }
        table
    }
}

/// cos(2π k / [`AZIMUTHS`]).
fn cosine_of(k: usize) -> f64 {
    (TAU * (k % AZIMUTHS) as f64 / AZIMUTHS as f64).cos()
}

/// The mean of y^b over a cell of height.
fn mean_power(c: usize, b: f64) -> f64 {
    let (low, high) = (edge(c), edge(c + 1));
    (high.powf(b + 1.0) - low.powf(b + 1.0)) / ((b + 1.0) * (high - low))
}

/// The shares that go down from the cells of height to others, with the exponent a = 1 + Λ ≥ 1.
fn downwards(a: f64) -> [[f32; HEIGHTS]; HEIGHTS] {
    std::array::from_fn(|from| {
        let (low, high) = (edge(from), edge(from + 1));
        // The mean over the cell of (low/y)^a: what passes its lower edge.
        let passes = if low == 0.0 {
            0.0
        } else if (a - 1.0).abs() < 1e-9 {
            low * (high / low).ln() / (high - low)
        } else {
            low * (1.0 - (low / high).powf(a - 1.0)) / ((a - 1.0) * (high - low))
        };
        std::array::from_fn(|to| {
            (match to.cmp(&from) {
                std::cmp::Ordering::Equal => 1.0 - passes,
                std::cmp::Ordering::Less => {
                    passes * ((edge(to + 1) / low).powf(a) - (edge(to) / low).powf(a))
                }
                std::cmp::Ordering::Greater => 0.0,
            }) as f32
        })
    })
}

/// The shares that go up, with the exponent b = Λ; what is missing from 1 leaves.
fn upwards(b: f64) -> [[f32; HEIGHTS]; HEIGHTS] {
    std::array::from_fn(|from| {
        let high = edge(from + 1);
        let passes = mean_power(from, b) / high.powf(b);
        std::array::from_fn(|to| {
            (match to.cmp(&from) {
                std::cmp::Ordering::Equal => 1.0 - passes,
                std::cmp::Ordering::Greater => {
                    passes * ((high / edge(to)).powf(b) - (high / edge(to + 1)).powf(b))
                }
                std::cmp::Ordering::Less => 0.0,
            }) as f32
        })
    })
}
