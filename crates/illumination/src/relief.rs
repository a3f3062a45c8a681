//! What a rough surface needs beside its material: facets, tables of multiple scattering, and the balance of energy.
//!
//! It depends on slopes and indices alone, not on lanes, takes some hundredths of a second, and is kept for every surface with the same.

use crate::Finish;
use glam::Vec3;
use illuminant_optics::equilibrium::Balance;
use illuminant_optics::facets::{Facets, Shape};
use illuminant_optics::multiple_scattering::{Between, MultipleScattering, Reflected, Refracted, Sides};
use std::collections::HashMap;
use std::hash::Hash;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// How many things of a kind are kept.
const KEPT: usize = 64;

/// Results by key: each is found once, whoever asks.
pub(crate) struct Kept<K, V>(Mutex<HashMap<K, Arc<OnceLock<Arc<V>>>>>);

impl<K, V> Default for Kept<K, V> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<K: Copy + Eq + Hash, V> Kept<K, V> {
    pub(crate) fn get(&self, key: K, find: impl FnOnce() -> V) -> Arc<V> {
        let slot = {
            let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            if known.len() >= KEPT && !known.contains_key(&key) {
                known.clear();
            }
            Arc::clone(known.entry(key).or_default())
        };
        Arc::clone(slot.get_or_init(|| Arc::new(find())))
    }
}

/// Numbers as a key.
pub(crate) fn bits<const K: usize>(numbers: [f64; K]) -> [u64; K] {
    numbers.map(f64::to_bits)
}

/// Facets, their multiple scattering, and what it is multiplied by.
#[derive(Debug)]
pub struct Relief<const G: usize> {
    /// The facets.
    pub facets: Facets<f32>,
    /// The balance of energy.
    pub balance: Balance,
    /// Two scatterings and more.
    table: MultipleScattering<G>,
    /// The factors of multiple scattering, at the nodes of each side.
    factors: Vec<Vec<f32>>,
    /// The shares of power that multiple scattering sends back and through, at the nodes of each side.
    shares: Vec<Vec<[f32; 2]>>,
    /// The mean cosine of incidence at the first of several facets.
    first_cosines: Vec<f32>,
}

/// The relief of a conductor.
pub type MetalRelief = Relief<3>;

/// The relief between two dielectrics.
pub type DielectricRelief = Relief<1>;

impl<const G: usize> Relief<G> {
    fn new(facets: Facets<f64>, eta: Option<f64>, table: MultipleScattering<G>) -> Self {
        let balance = Balance::new(&facets, eta, &table);
        let single = |values: &[f64]| values.iter().map(|&v| v as f32).collect::<Vec<_>>();
        let factors = balance.multiple.iter().map(|v| single(v)).collect();
        let pairs = balance.multiple_reflected.iter().zip(&balance.multiple_transmitted);
        let shares = pairs.map(|(r, t)| r.iter().zip(t).map(|(&r, &t)| [r as f32, t as f32]).collect());
        Self {
            facets: Facets { shape: facets.shape, slope: facets.slope.map(|m| m as f32) },
            shares: shares.collect(),
            first_cosines: single(&balance.first_cosines),
            balance,
            table,
            factors,
        }
    }

    /// The slope of its steepest direction.
    pub fn steepest(&self) -> f32 {
        self.facets.slope[0].max(self.facets.slope[1])
    }

    /// The factor of multiple scattering of a direction on a side.
    #[inline(always)]
    pub fn factor(&self, side: usize, v: Vec3) -> f32 {
        let mut factor = 0.0;
        self.balance.grids[side].interpolate(v.to_array(), |i, w| factor += w * self.factors[side][i]);
        factor
    }

    /// The shares of power that multiple scattering sends back and through.
    #[inline(always)]
    pub fn shares(&self, side: usize, v: Vec3) -> [f32; 2] {
        let mut shares = [0.0; 2];
        self.balance.grids[side].interpolate(v.to_array(), |i, w| {
            shares[0] += w * self.shares[side][i][0];
            shares[1] += w * self.shares[side][i][1];
        });
        shares
    }

    /// Multiple scattering between a direction from which light is asked for and one to it, both with z > 0 on their own sides: its values
    /// times the factors of both, and the density with which it is drawn.
    #[inline(always)]
    pub fn multiple(&self, sides: Sides, v: Vec3, l: Vec3) -> Between<G> {
        let (from, to) = match sides {
            Sides::First => (0, 0),
            Sides::Second => (1, 1),
            Sides::Through => (0, 1),
            Sides::Back => (1, 0),
        };
        let factor = self.factor(from, v) * self.factor(to, l);
        let mut between = self.table.at(sides, v.z, l.z, cos_azimuth(v, l));
        between.values.iter_mut().for_each(|f| *f *= factor);
        between
    }

    /// Draws a direction of multiple scattering, with z > 0 on its own side.
    #[inline(always)]
    pub fn sample_multiple(&self, sides: Sides, v: Vec3, u: [f32; 2]) -> Option<Vec3> {
        let (z, azimuth) = self.table.sample(sides, v.z, u)?;
        let length = (v.x * v.x + v.y * v.y).sqrt();
        let forward = if length > 1e-10 { [-v.x / length, -v.y / length] } else { [1.0, 0.0] };
        let (sin, cos) = azimuth.sin_cos();
        let r = (1.0 - z * z).max(0.0).sqrt();
        Some(Vec3::new(
            r * (forward[0] * cos - forward[1] * sin),
            r * (forward[0] * sin + forward[1] * cos),
            z,
        ))
    }
}

impl MetalRelief {
    /// The mean cosine of incidence at the first of several facets.
    #[inline(always)]
    pub fn first_cosine(&self, v: Vec3) -> f32 {
        let mut cos = 0.0;
        self.balance.grids[0].interpolate(v.to_array(), |i, w| cos += w * self.first_cosines[i]);
        cos
    }
}

impl DielectricRelief {
    /// The share of power from the nodes of the first side that comes back to it.
    pub(crate) fn reflectance(&self) -> Vec<f32> {
        self.balance.reflectance(0).into_iter().map(|r| r as f32).collect()
    }
}

/// The cosine of the azimuth of `b` from that opposite to `a`.
#[inline(always)]
fn cos_azimuth(a: Vec3, b: Vec3) -> f32 {
    let length2 = (a.x * a.x + a.y * a.y) * (b.x * b.x + b.y * b.y);
    if length2 > 1e-20 { -(a.x * b.x + a.y * b.y) / length2.sqrt() } else { 1.0 }
}

/// Slopes for which tables of multiple scattering are made: one for all directions of an anisotropic surface, the steeper, so that
/// there is light wherever some is needed.
fn isotropic(shape: Shape, slope: [f64; 2]) -> Facets<f64> {
    Facets::isotropic(shape, slope[0].max(slope[1]))
}

/// Slopes of a finish, not below what f32 resolves.
pub(crate) fn slopes(finish: &Finish) -> [f64; 2] {
    finish.slope.map(|m| m.max(Finish::SMOOTH))
}

/// The relief of a conductor.
pub(crate) fn metal_relief(finish: &Finish) -> Arc<MetalRelief> {
    static KNOWN: OnceLock<Kept<(Shape, [u64; 2]), MetalRelief>> = OnceLock::new();
    let (shape, slope) = (finish.shape, slopes(finish));
    KNOWN.get_or_init(Kept::default).get((shape, bits(slope)), || {
        Relief::new(Facets { shape, slope }, None, Reflected::solve(&isotropic(shape, slope)))
    })
}

/// The relief between two dielectrics, with the index `eta` of the second relative to the first.
pub(crate) fn dielectric_relief(finish: &Finish, eta: f64) -> Arc<DielectricRelief> {
    static KNOWN: OnceLock<Kept<(Shape, [u64; 3]), DielectricRelief>> = OnceLock::new();
    let (shape, slope) = (finish.shape, slopes(finish));
    KNOWN.get_or_init(Kept::default).get((shape, bits([slope[0], slope[1], eta])), || {
        Relief::new(Facets { shape, slope }, Some(eta), Refracted::solve(&isotropic(shape, slope), eta))
    })
}
