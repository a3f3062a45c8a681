//! The rough boundary between two dielectrics: what of the light stays coherent, and what facets scatter.

use crate::coherence::{Closed, Closure, Ends, dielectric_closure};
use crate::relief::{DielectricRelief, dielectric_relief};
use crate::{Finish, Spectral};
use std::sync::{Arc, OnceLock};

/// Relative indices for which things are kept; further ones get what the last has.
const KEPT: usize = 8;

/// What depends on the relative index of two media, found when it is asked for first. Asking again costs a look at some numbers.
#[derive(Debug)]
pub(crate) struct ByEta<T>([OnceLock<(f32, T)>; KEPT]);

impl<T> Default for ByEta<T> {
    fn default() -> Self {
        Self(std::array::from_fn(|_| OnceLock::new()))
    }
}

impl<T> ByEta<T> {
    #[inline(always)]
    pub(crate) fn get(&self, eta: f32, find: impl Fn() -> T) -> &T {
        let [slots @ .., last] = &self.0;
        for slot in slots {
            let (known, value) = slot.get_or_init(|| (eta, find()));
            if *known == eta {
                return value;
            }
        }
        &last.get_or_init(|| (eta, find())).1
    }
}

/// A rough boundary, whatever medium lies outside.
#[derive(Debug)]
pub struct RoughBoundary<const N: usize> {
    finish: Finish,
    spectral: Spectral<N>,
    pairs: ByEta<Pair<N>>,
}

/// A rough boundary with the media on both sides of it.
#[derive(Debug)]
pub(crate) struct Pair<const N: usize> {
    pub relief: Arc<DielectricRelief>,
    /// The share of power from the nodes of the first side that comes back to it, if nothing stays coherent.
    pub reflected: Vec<f32>,
    /// Where the relief is not much higher than a wavelength: the balance in lanes, and what it comes from.
    coherence: Option<(Closed<N>, Arc<Closure>)>,
    eta: f32,
}

impl<const N: usize> Pair<N> {
    /// The balance in lanes, and at both ends of the spectrum.
    #[inline(always)]
    pub fn coherence(&self) -> Option<(&Closed<N>, &Ends)> {
        self.coherence.as_ref().map(|(closed, closure)| {
            (closed, closure.ends(&self.relief.balance, Some(self.eta), self.relief.steepest()))
        })
    }
}

impl<const N: usize> RoughBoundary<N> {
    pub fn new(finish: &Finish, spectral: &Spectral<N>) -> Self {
        Self { finish: *finish, spectral: *spectral, pairs: ByEta::default() }
    }

    pub fn gloss(&self) -> f32 {
        self.finish.gloss() as f32
    }

    /// The tables for the index of the second side, to which the normal does not point, relative to the first.
    #[inline(always)]
    pub(crate) fn pair(&self, eta: f32) -> &Pair<N> {
        self.pairs.get(eta, || self.find(eta))
    }

    #[cold]
    fn find(&self, eta: f32) -> Pair<N> {
        let relief = dielectric_relief(&self.finish, f64::from(eta));
        let coherence = self.finish.sigma_nm.map(|sigma| {
            let ends_nm = self.spectral.ends_nm;
            let closure = dielectric_closure(&self.finish, &relief, f64::from(eta), sigma, ends_nm);
            let slope = relief.steepest();
            (Closed::new(&closure, self.spectral.phase(sigma), slope), closure)
        });
        Pair { reflected: relief.reflectance(), relief, coherence, eta }
    }
}
