//! What a scene's light becomes on its way: the spectra on which a sampling is fitted and judged.

use crate::ToXyz;
use illuminant_color::Triple;
use illuminant_spectrum::{Curve, LUMINOUS_EFFICACY, Observer, SpectralRange};

/// The light of one lamp after all that a path did to it.
#[derive(Clone, Debug)]
pub struct Part {
    /// Number of the lamp in [`Products::lamps`].
    pub lamp: usize,
    /// What is left of its spectrum at each nm of [`Products::range`]: the product of the reflectances that a path met,
    /// times a number, or a sum of such products.
    pub filter: Vec<f64>,
}

/// A colour that a scene can show.
#[derive(Clone, Debug)]
pub struct Product {
    /// The light that it is made of, by lamp.
    pub parts: Vec<Part>,
    /// XYZ of the white beside which it is seen, in the unit of the products.
    pub white: Triple,
    /// How much it counts in a mean.
    pub weight: f64,
    /// The numbers in [`Products::reflectances`] of those whose product its filter is; `None` for what a path gathered.
    pub factors: Option<Vec<usize>>,
}

/// Lamps, and what becomes of their light.
///
/// Only wavelengths that the observer sees matter to a colour, so the filters are known there and nowhere else. Lamps of
/// one relative spectrum are of one kind, and one of them stands for all.
///
/// ```
/// use illuminant_sampling::Products;
/// use illuminant_spectrum::{Curve, Outside, SpectralRange, daylight};
/// let day = daylight(6504.0).unwrap();
/// let paint = Curve::new(vec![400.0, 700.0], vec![0.1, 0.7], Outside::Hold).unwrap();
/// let mut products = Products::new(SpectralRange::default(), vec![day]).unwrap();
/// products.add_reflectances(&[paint], 4, 2000, 0);
/// assert_eq!(products.items.len(), 4); // one to four reflections from one paint
/// ```
#[derive(Clone, Debug)]
pub struct Products {
    /// The wavelengths of the filters: those of the run that the observer sees.
    pub range: SpectralRange,
    /// The spectra of the lamps.
    pub lamps: Vec<Curve>,
    /// The reflectances of the materials, as far as they are known as curves.
    pub reflectances: Vec<Curve>,
    /// Whether all lamps must share one map to XYZ, as they must where their light is kept together.
    pub one_map: bool,
    /// How many of the lamps that concerns, from the first; those behind them always have maps of their own.
    pub together: usize,
    /// What materials that are not known weigh beside the colours: a fit is to serve them too.
    pub unknown: f64,
    /// The colours.
    pub items: Vec<Product>,
    lamp_xyz: Vec<Triple>,
    kinds: Vec<Option<usize>>,
}

/// What unknown materials weigh by default.
const UNKNOWN: f64 = 0.25;

/// The least that X, Y or Z of a white may be beside its Y: the lightness of a colour beside deep red light, which has no Z,
/// would know no bounds.
const LEAST_OF_WHITE: f64 = 0.01;

/// The wavelengths of `range` at which the observer's functions are not zero; `None` when there are none.
#[must_use]
pub fn seen(range: SpectralRange) -> Option<SpectralRange> {
    let [x, ..] = &Observer::cie_1931_2deg().matching;
    let points = x.wavelengths_nm();
    let (first, last) = (points[0] as u32, points[points.len() - 1] as u32);
    let seen = SpectralRange { min_nm: range.min_nm.max(first), max_nm: range.max_nm.min(last) };
    (seen.min_nm < seen.max_nm).then_some(seen)
}

/// The white by which colours under a lamp are judged: the XYZ of the lamp, no component negligible.
#[must_use]
pub fn white_of(xyz: Triple) -> Triple {
    xyz.map(|v| v.max(LEAST_OF_WHITE * xyz[1]))
}

impl Products {
    /// No colour yet, of lamps over a range; `None` when the observer sees nothing of the range, or no lamp of it.
    #[must_use]
    pub fn new(range: SpectralRange, lamps: Vec<Curve>) -> Option<Self> {
        let range = seen(range)?;
        let lamp_xyz: Vec<Triple> = lamps.iter().map(|l| Observer::cie_1931_2deg().xyz(l, range)).collect();
        let kinds = kinds(&lamps, &lamp_xyz, range);
        kinds.iter().flatten().next()?;
        let together = lamps.len();
        let reflectances = Vec::new();
        let items = Vec::new();
        Some(Self {
            range,
            lamps,
            reflectances,
            one_map: false,
            together,
            unknown: UNKNOWN,
            items,
            lamp_xyz,
            kinds,
        })
    }

    /// Adds the products of one to `depth` of the reflectances under each kind of lamp, each seen beside a perfect
    /// diffuser under that lamp. Those of one and of two reflections are all taken, as long as they fit into `most` for
    /// each lamp; of the longer ones as many as fit, drawn by `seed`.
    pub fn add_reflectances(&mut self, reflectances: &[Curve], depth: usize, most: usize, seed: u64) {
        self.reflectances = reflectances.to_vec();
        let tables: Vec<Vec<f64>> = reflectances.iter().map(|c| c.tabulate(self.range)).collect();
        for chosen in choose_multisets(tables.len(), depth, most, seed) {
            let mut filter = vec![1.0; self.range.len()];
            for &material in &chosen {
                for (product, r) in filter.iter_mut().zip(&tables[material]) {
                    *product *= r;
                }
            }
            self.add_under_each_kind(&filter, 1.0, Some(&chosen));
        }
    }

    /// The same with reflectances that are in no scene and stand for those that a fit does not know: smooth steps, up and
    /// down, at wavelengths throughout the visible. Together they weigh [`Products::unknown`] of all others.
    #[must_use]
    pub(crate) fn with_unknown_materials(mut self) -> Self {
        let total: f64 = self.items.iter().map(|item| item.weight).sum();
        let total = if total > 0.0 { total } else { 1.0 };
        let mut filters: Vec<Vec<f64>> = Vec::new();
        for centre in (400..=700).step_by(20).map(f64::from) {
            for width in [8.0, 25.0, -8.0, -25.0] {
                let step = |w: f64| 0.05 + 0.85 / (1.0 + (-(w - centre) / width).exp());
                filters.push(self.range.wavelengths().map(step).collect());
            }
        }
        let weight = self.unknown * total / (filters.len() * self.representatives().count().max(1)) as f64;
        for filter in filters {
            self.add_under_each_kind(&filter, weight, None);
        }
        self
    }

    fn add_under_each_kind(&mut self, filter: &[f64], weight: f64, factors: Option<&[usize]>) {
        for lamp in self.representatives().collect::<Vec<_>>() {
            let parts = vec![Part { lamp, filter: filter.to_vec() }];
            let white = white_of(self.lamp_xyz[lamp]);
            self.items.push(Product { parts, white, weight, factors: factors.map(<[usize]>::to_vec) });
        }
    }

    /// Whether a lamp shares its map to XYZ with others, whatever their spectra.
    #[must_use]
    pub fn shares_map(&self, lamp: usize) -> bool {
        self.one_map && lamp < self.together
    }

    /// The lamp that stands for a lamp; `None` for one without light that the observer sees.
    #[must_use]
    pub fn kind(&self, lamp: usize) -> Option<usize> {
        self.kinds[lamp]
    }

    /// The lamps that stand for the kinds.
    pub fn representatives(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.lamps.len()).filter(|&lamp| self.kinds[lamp] == Some(lamp))
    }

    /// Absolute XYZ of a lamp, integrated at 1 nm.
    #[must_use]
    pub fn xyz_of_lamp(&self, lamp: usize) -> Triple {
        self.lamp_xyz[lamp]
    }

    /// K_m x̄(λ) L(λ) and its likes for Y and Z, at each nm of the range: what turns a filter into XYZ.
    #[must_use]
    pub fn weights_of_lamp(&self, lamp: usize) -> ToXyz {
        let observer = Observer::cie_1931_2deg();
        observer.matching.each_ref().map(|m| {
            let at = |w| LUMINOUS_EFFICACY * m.at(w) * self.lamps[lamp].at(w);
            self.range.wavelengths().map(at).collect()
        })
    }
}

/// For each lamp the first one of its relative spectrum.
fn kinds(lamps: &[Curve], xyz: &[Triple], range: SpectralRange) -> Vec<Option<usize>> {
    let mut known: Vec<(usize, Vec<f64>)> = Vec::new();
    let mut kinds = Vec::with_capacity(lamps.len());
    for (lamp, curve) in lamps.iter().enumerate() {
        let luminance = xyz[lamp][1];
        if !(luminance > 0.0) {
            kinds.push(None);
            continue;
        }
        let relative: Vec<f64> = curve.tabulate(range).iter().map(|v| v / luminance).collect();
        let peak = relative.iter().copied().fold(0.0, f64::max);
        let same = |(_, other): &&(usize, Vec<f64>)| {
            other.iter().zip(&relative).all(|(a, b)| (a - b).abs() < 1e-9 * peak)
        };
        let kind = known.iter().find(same).map_or(lamp, |(kind, _)| *kind);
        if kind == lamp {
            known.push((lamp, relative));
        }
        kinds.push(Some(kind));
    }
    kinds
}

/// Multisets of 1 to `depth` of `n` things: all of them while they fit into `most`, else as many, drawn by `seed`.
fn choose_multisets(n: usize, depth: usize, most: usize, seed: u64) -> Vec<Vec<usize>> {
    let mut chosen = Vec::new();
    let mut state = seed;
    for size in 1..=depth {
        let all = count_multisets(n, size);
        let room = most.saturating_sub(chosen.len());
        // The sizes that follow get as much as this one.
        let share = if size <= 2 { room } else { room.div_ceil(depth + 1 - size) };
        if all <= share {
            chosen.extend((0..all).map(|i| multiset(n, size, i)));
        } else {
            let mut numbers = std::collections::BTreeSet::new();
            while numbers.len() < share {
                numbers.insert((splitmix(&mut state) % all as u64) as usize);
            }
            chosen.extend(numbers.into_iter().map(|i| multiset(n, size, i)));
        }
    }
    chosen
}

/// How many multisets of a size there are: C(n + size − 1, size).
pub(crate) fn count_multisets(n: usize, size: usize) -> usize {
    if n == 0 {
        return 0;
    }
    (0..size).fold(1u128, |count, i| count * (n + i) as u128 / (i + 1) as u128).min(usize::MAX as u128)
        as usize
}

/// The multiset with a number, in lexicographic order.
pub(crate) fn multiset(n: usize, size: usize, mut number: usize) -> Vec<usize> {
    let mut items = Vec::with_capacity(size);
    let mut least = 0;
    for left in (0..size).rev() {
        while number >= count_multisets(n - least, left) {
            number -= count_multisets(n - least, left);
            least += 1;
        }
        items.push(least);
    }
    items
}

/// SplitMix64 (Steele, Lea and Flood 2014): a number from a counter, the same everywhere.
pub(crate) fn splitmix(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multisets_are_all_there_and_each_once() {
        for (n, size) in [(24, 2), (5, 4), (1, 3), (24, 4)] {
            let all = count_multisets(n, size);
            let mut seen: Vec<_> = (0..all).map(|i| multiset(n, size, i)).collect();
            assert!(seen.iter().all(|m| m.len() == size && m.is_sorted() && m[size - 1] < n));
            seen.dedup();
            assert_eq!(seen.len(), all);
            assert!(seen.is_sorted());
        }
        assert_eq!((1..=4).map(|size| count_multisets(24, size)).sum::<usize>(), 20_474);
    }

    #[test]
    fn the_number_of_products_is_kept() {
        let chosen = choose_multisets(24, 4, 2000, 1);
        assert_eq!(chosen.len(), 2000);
        assert_eq!(chosen.iter().filter(|m| m.len() <= 2).count(), 324);
        assert_eq!(choose_multisets(24, 4, 2000, 1), chosen);
        assert_eq!(choose_multisets(200, 4, 500, 1).len(), 500);
    }

    #[test]
    fn lamps_of_one_relative_spectrum_are_of_one_kind() {
        let day = illuminant_spectrum::daylight(6504.0).unwrap();
        let lamps = vec![day.clone(), Curve::constant(1.0), day.scaled(3.0), Curve::constant(0.0)];
        let products = Products::new(SpectralRange::default(), lamps).unwrap();
        assert_eq!([0, 1, 2, 3].map(|l| products.kind(l)), [Some(0), Some(1), Some(0), None]);
        assert_eq!(products.representatives().collect::<Vec<_>>(), [0, 1]);
    }

    #[test]
    fn what_the_observer_does_not_see_has_no_products() {
        let infrared =
            Curve::new(vec![840.0, 900.0], vec![0.0, 1.0], illuminant_spectrum::Outside::Zero).unwrap();
        assert!(Products::new(SpectralRange { min_nm: 380, max_nm: 1000 }, vec![infrared]).is_none());
        assert!(seen(SpectralRange { min_nm: 900, max_nm: 1700 }).is_none());
        assert_eq!(
            seen(SpectralRange { min_nm: 300, max_nm: 900 }),
            Some(SpectralRange { min_nm: 360, max_nm: 830 })
        );
    }
}
