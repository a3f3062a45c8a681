//! What part of the light a relief leaves coherent that is not much higher than a wavelength, and the balance with the rest.
//!
//! Of the field, the amplitude α = exp(−g/2) stays coherent, so of the power r_σ = α² = exp(−g) (book eqs 2.36 and 2.37). The
//! path through the boundary gives the same argument for what goes through, t_σ, which the book leaves open.
//! Between two directions whose own amplitudes are α(a) and α(b), a fraction s = 1 − α(a) α(b) is scattered: for a direction and
//! its mirror image that is all that is not coherent.

use crate::Finish;
use crate::relief::{DielectricRelief, Kept, MetalRelief, bits, slopes};
use glam::Vec3;
use illuminant_optics::equilibrium::{Balance, Grid};
use illuminant_optics::facets::Shape;
use illuminant_optics::fresnel::dielectric;
use illuminant_sampling::Lanes;
use std::f64::consts::TAU;
use std::sync::{Arc, OnceLock};

/// Phases between which what depends on wavelength is interpolated.
const PHASES: usize = 12;

/// The amplitude that stays coherent on reflection, exp(−g/2) with g = (2 p cos θ)², of the phase p = 2πσn/λ of the relief.
#[inline(always)]
pub(crate) fn reflection(phase: f32, cos: f32) -> f32 {
    let p = phase * cos;
    (-2.0 * p * p).exp()
}

/// The amplitude that stays coherent on transmission, exp(−g/2) with g = (p_i cos θ_i − p_t cos θ_t)²: the path through the
/// boundary changes by n_i cos θ_i − n_t cos θ_t for every unit of height. Beyond the critical angle, where facets may still
/// pass light, it is that of grazing refraction.
#[inline(always)]
pub(crate) fn transmission(phase: f32, cos: f32, eta: f32) -> f32 {
    let sin2 = (1.0 - cos * cos) / (eta * eta);
    let p = phase * (cos - eta * (1.0 - sin2).max(0.0).sqrt());
    (-0.5 * p * p).exp()
}

/// A direction on one side: what is scattered of its light is fixed by its cosine.
#[derive(Clone, Copy, Debug)]
struct View {
    /// Reflectance of the boundary.
    fresnel: f32,
    /// The amplitude that is reflected.
    back: f32,
    /// The amplitude that goes through.
    through: f32,
    /// Roughly the share of reflected light that is scattered.
    loose: f32,
    /// Roughly the share that facets scatter.
    expected: f32,
}

impl View {
    /// `eta` is the index of the other side relative to this one; `None` where everything is reflected.
    #[inline(always)]
    fn new(phase: f32, cos: f32, eta: Option<f32>, slope: f32) -> Self {
        let fresnel = eta.map_or(1.0, |eta| dielectric(cos, eta));
        let back = reflection(phase, cos);
        let through = eta.map_or(0.0, |eta| transmission(phase, cos, eta));
        // Lobes lie beside a grazing mirror direction.
        let beside = reflection(phase, (cos + 0.7 * slope).min(1.0));
        let loose = 1.0 - back * beside;
        let expected = fresnel * loose + (1.0 - fresnel) * (1.0 - through * through);
        Self { fresnel, back, through, loose, expected }
    }

    /// All that is to be scattered.
    #[inline(always)]
    fn scattered(&self) -> f32 {
        1.0 - self.fresnel * self.back * self.back - (1.0 - self.fresnel) * self.through * self.through
    }

    /// The factor u where facets scatter `relative` times what is expected.
    #[inline(always)]
    fn factor(&self, relative: f32) -> f32 {
        let (sum, all) = (relative * self.expected, self.scattered());
        if sum > all { (all / sum).max(0.0) } else { 1.0 }
    }
}

/// At nodes of direction, what depends on wavelength through the phase of the relief.
#[derive(Debug)]
struct ByPhase {
    /// The phases 2πσ/λ in vacuum.
    phases: Vec<f64>,
    /// [phase][node]
    values: Vec<Vec<f32>>,
}

impl ByPhase {
    /// In lanes, by linear interpolation between phases.
    fn lanes<const N: usize>(&self, phase: &Lanes<N>) -> Vec<Lanes<N>> {
        let (first, step) =
            (self.phases[0], (self.phases[PHASES - 1] - self.phases[0]) / (PHASES - 1) as f64);
        let places: [(usize, f32); N] = std::array::from_fn(|lane| {
            let at = ((f64::from(phase.0[lane]) - first) / step.max(1e-30)).clamp(0.0, (PHASES - 1) as f64);
            let i = (at as usize).min(PHASES - 2);
            (i, (at - i as f64) as f32)
        });
        let at = |node: usize| {
            let value =
                |(i, w): (usize, f32)| (1.0 - w) * self.values[i][node] + w * self.values[i + 1][node];
            Lanes::from_fn(|lane| value(places[lane]))
        };
        (0..self.values[0].len()).map(at).collect()
    }
}

/// What closes the balance, by phase. Quantities are relative to what they are expected to be, which leaves little to interpolate.
#[derive(Debug)]
pub(crate) struct Closure {
    /// On each side, what facets scatter relative to what is expected.
    relative: Vec<ByPhase>,
    /// On each side, the rest e relative to all that is to be scattered.
    rests: Vec<ByPhase>,
    /// What is scattered back from the first side relative to what is expected to be scattered at all.
    reflected: ByPhase,
    /// Σ e = Σ n² ∫ e cos θ dω over the sides, with n relative to the first.
    sum: ByPhase,
    /// The same at both ends of the spectrum.
    ends: OnceLock<Ends>,
}

/// Amplitudes and factors at many cosines on a side, because they are asked for millions of times: [cosine][phase][reflected, transmitted, u].
struct Fine(Vec<[[f32; 3]; PHASES]>);

impl Fine {
    /// Steps between two nodes.
    const STEPS: usize = 16;
    const LAST: usize = Self::STEPS * (Grid::COSINES - 1);

    fn cosine(grid: &Grid, i: usize) -> f64 {
        grid.cosine(i as f64 / Self::STEPS as f64)
    }

    fn new(grid: &Grid, view: impl Fn(usize, f64) -> View) -> Self {
        let at = |i: usize| {
            let cos = Self::cosine(grid, i);
            std::array::from_fn(|p| {
                let view = view(p, cos);
                [view.back, view.through, 1.0]
            })
        };
        Self((0..=Self::LAST).map(at).collect())
    }

    /// Sets the factors; `factor` gets a phase, a cosine and its position.
    fn cut(&mut self, grid: &Grid, factor: impl Fn(usize, f64, f32) -> f32) {
        for (i, entries) in self.0.iter_mut().enumerate() {
            let (cos, position) = (Self::cosine(grid, i), i as f32 / Self::STEPS as f32);
            for (p, entry) in entries.iter_mut().enumerate() {
                entry[2] = factor(p, cos, position);
            }
        }
    }

    #[inline(always)]
    fn at(&self, grid: &Grid, cos: f32) -> [[f32; 3]; PHASES] {
        let x = grid.position(cos) * Self::STEPS as f32;
        let i = (x as usize).min(Self::LAST - 1);
        let w = x - i as f32;
        let (low, high) = (&self.0[i], &self.0[i + 1]);
        std::array::from_fn(|p| std::array::from_fn(|k| (1.0 - w) * low[p][k] + w * high[p][k]))
    }
}

impl Closure {
    fn new(balance: &Balance, eta: Option<f64>, slope: f32, sigma_nm: f64, ends_nm: [f64; 2]) -> Self {
        let [low, high] = [ends_nm[1], ends_nm[0]].map(|nm| TAU * sigma_nm / nm);
        let phases: Vec<f64> =
            (0..PHASES).map(|i| low + (high - low) * i as f64 / (PHASES - 1) as f64).collect();
        let (sides, n) = (balance.sides(), balance.nodes());
        let index = |side: usize| if side == 0 { 1.0 } else { eta.unwrap_or(1.0) };
        let relative_index = |side: usize| eta.map(|_| (index(1 - side) / index(side)) as f32);
        let view = |p: usize, side: usize, cos: f64| {
            View::new((phases[p] * index(side)) as f32, cos as f32, relative_index(side), slope)
        };
        let cos: Vec<Vec<f64>> = (0..sides).map(|side| balance.cosines(side)).collect();
        let mut relative = vec![vec![vec![0f32; n]; PHASES]; sides];
        let mut rests = relative.clone();
        let mut reflected = vec![vec![0f32; n]; PHASES];
        let mut fine: Vec<Fine> =
            (0..sides).map(|side| Fine::new(&balance.grids[side], |p, cos| view(p, side, cos))).collect();
        // First what facets scatter, then what is left when factors have cut it.
        for cut in [false, true] {
            for side in 0..sides {
                for node in 0..n {
                    let own: [View; PHASES] = std::array::from_fn(|p| view(p, side, cos[side][node]));
                    let mut sums = [[0f32; PHASES]; 2];
                    balance.for_each(side, node, |through, to, share| {
                        let target = if through { 1 - side } else { side };
                        let other = fine[target].at(&balance.grids[target], to[2] as f32);
                        let sums = &mut sums[usize::from(through)];
                        let share = share as f32;
                        for p in 0..PHASES {
                            let [back, passed, factor] = other[p];
                            let kept = if through { own[p].through * passed } else { own[p].back * back };
                            sums[p] += share * (1.0 - kept) * factor;
                        }
                    });
                    for p in 0..PHASES {
                        let (own, sum) = (own[p], sums[0][p] + sums[1][p]);
                        if cut {
                            let factor = own.factor(relative[side][p][node]);
                            let all = own.scattered();
                            let rest = (all - factor * sum).max(0.0);
                            rests[side][p][node] = if all > 0.0 { rest / all } else { 0.0 };
                            if side == 0 {
                                reflected[p][node] = factor * sums[0][p];
                            }
                        } else {
                            relative[side][p][node] =
                                if own.expected > 0.0 { sum / own.expected } else { 1.0 };
                        }
                    }
                }
            }
            for (side, fine) in fine.iter_mut().enumerate() {
                let azimuths = n / Grid::COSINES;
                fine.cut(&balance.grids[side], |p, cos, position| {
                    // The mean over azimuths, where there are several.
                    let i = (position as usize).min(Grid::COSINES - 2);
                    let w = position - i as f32;
                    let mean = |i: usize| {
                        relative[side][p][i * azimuths..][..azimuths].iter().sum::<f32>() / azimuths as f32
                    };
                    view(p, side, cos).factor((1.0 - w) * mean(i) + w * mean(i + 1))
                });
            }
        }
        let mut sum = Vec::with_capacity(PHASES);
        for p in 0..PHASES {
            let integral = |side: usize| {
                let e =
                    (0..n).map(|i| f64::from(rests[side][p][i] * view(p, side, cos[side][i]).scattered()));
                index(side).powi(2) * balance.grids[side].projected_integral(&e.collect::<Vec<_>>())
            };
            let parts: Vec<f64> = (0..sides).map(integral).collect();
            let total: f64 = parts.iter().sum();
            // Of the rest, the first side gets its part.
            let part = if total > 0.0 { (parts[0] / total) as f32 } else { 0.0 };
            for (node, reflected) in reflected[p].iter_mut().enumerate() {
                let own = view(p, 0, cos[0][node]);
                let back = *reflected + part * rests[0][p][node] * own.scattered();
                *reflected = if own.expected > 0.0 { back / own.expected } else { 0.0 };
            }
            sum.push(vec![total as f32]);
        }
        let by_phase = |values| ByPhase { phases: phases.clone(), values };
        Self {
            relative: relative.into_iter().map(by_phase).collect(),
            rests: rests.into_iter().map(by_phase).collect(),
            reflected: by_phase(reflected),
            sum: by_phase(sum),
            ends: OnceLock::new(),
        }
    }

    /// The balance at both ends of the spectrum.
    pub fn ends(&self, balance: &Balance, eta: Option<f32>, slope: f32) -> &Ends {
        self.ends.get_or_init(|| {
            let phases = &self.sum.phases;
            let ends = [phases[PHASES - 1] as f32, phases[0] as f32];
            Ends::new(self, balance, eta, ends, slope)
        })
    }
}

type Known = OnceLock<Kept<(Shape, [u64; 6]), Closure>>;

/// The closure of a conductor.
pub(crate) fn metal_closure(
    finish: &Finish,
    relief: &MetalRelief,
    sigma_nm: f64,
    ends_nm: [f64; 2],
) -> Arc<Closure> {
    static KNOWN: Known = OnceLock::new();
    let [mx, my] = slopes(finish);
    let key = (finish.shape, bits([mx, my, 0.0, sigma_nm, ends_nm[0], ends_nm[1]]));
    KNOWN
        .get_or_init(Kept::default)
        .get(key, || Closure::new(&relief.balance, None, mx.max(my) as f32, sigma_nm, ends_nm))
}

/// The closure of a boundary between dielectrics with the relative index `eta`.
pub(crate) fn dielectric_closure(
    finish: &Finish,
    relief: &DielectricRelief,
    eta: f64,
    sigma_nm: f64,
    ends_nm: [f64; 2],
) -> Arc<Closure> {
    static KNOWN: Known = OnceLock::new();
    let [mx, my] = slopes(finish);
    let key = (finish.shape, bits([mx, my, eta, sigma_nm, ends_nm[0], ends_nm[1]]));
    KNOWN
        .get_or_init(Kept::default)
        .get(key, || Closure::new(&relief.balance, Some(eta), mx.max(my) as f32, sigma_nm, ends_nm))
}

/// The balance of coherent and scattered light in M lanes.
#[derive(Debug)]
pub(crate) struct Closed<const M: usize> {
    /// 2πσ/λ in vacuum.
    phase: Lanes<M>,
    slope: f32,
    relative: Vec<Vec<Lanes<M>>>,
    rests: Vec<Vec<Lanes<M>>>,
    reflected: Vec<Lanes<M>>,
    /// 1 / Σ e.
    inverse_sum: Lanes<M>,
}

/// The balance at both ends of the spectrum, by which directions are drawn whatever the lanes.
#[derive(Debug)]
pub(crate) struct Ends {
    pub closed: Closed<2>,
    /// On each side, what part of the rest, as a mean of both ends, lies below a cosine.
    cells: Vec<Vec<Cell>>,
    /// The parts of the rest that go to each side.
    sides: [f32; 2],
}

/// The lower edge of a cell of cosines.
#[derive(Clone, Copy, Debug)]
struct Cell {
    cos2: f32,
    /// The part of the rest below.
    below: f32,
}

/// What coherence makes of one direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coherent<const M: usize> {
    /// The amplitude that is reflected coherently.
    pub back: Lanes<M>,
    /// The amplitude that goes through coherently.
    pub through: Lanes<M>,
    /// Roughly the share of reflected light that is scattered.
    pub loose: Lanes<M>,
    /// The factor u.
    pub factor: Lanes<M>,
    /// The rest e.
    pub rest: Lanes<M>,
}

impl<const M: usize> Closed<M> {
    pub fn new(closure: &Closure, phase: Lanes<M>, slope: f32) -> Self {
        let all = |tables: &[ByPhase]| tables.iter().map(|table| table.lanes(&phase)).collect();
        let inverse = |s: f32| if s > 0.0 { s.recip() } else { 0.0 };
        Self {
            phase,
            slope,
            relative: all(&closure.relative),
            rests: all(&closure.rests),
            reflected: closure.reflected.lanes(&phase),
            inverse_sum: closure.sum.lanes(&phase)[0].map(inverse),
        }
    }

    /// The terms of a direction `v` (z > 0) on a side whose index is `own`, with the relative index `eta` of the other; `None`
    /// where everything is reflected.
    #[inline(always)]
    pub fn at(&self, grid: &Grid, side: usize, own: &Lanes<M>, eta: Option<f32>, v: Vec3) -> Coherent<M> {
        let relative = interpolated(grid, &self.relative[side], v);
        let rests = interpolated(grid, &self.rests[side], v);
        let mut coherent = Coherent {
            back: Lanes::default(),
            through: Lanes::default(),
            loose: Lanes::default(),
            factor: Lanes::default(),
            rest: Lanes::default(),
        };
        for i in 0..M {
            let view = View::new(self.phase.0[i] * own.0[i], v.z, eta, self.slope);
            coherent.back.0[i] = view.back;
            coherent.through.0[i] = view.through;
            coherent.loose.0[i] = view.loose;
            coherent.factor.0[i] = view.factor(relative.0[i]);
            coherent.rest.0[i] = (rests.0[i] * view.scattered()).max(0.0);
        }
        coherent
    }

    /// e(v) e(l) / Σ e.
    #[inline(always)]
    pub fn rest(&self, v: &Coherent<M>, l: &Coherent<M>) -> Lanes<M> {
        v.rest * l.rest * self.inverse_sum
    }

    /// The share of power from a direction on the first side that is scattered back.
    #[inline(always)]
    pub fn reflectance(&self, grid: &Grid, own: &Lanes<M>, eta: f32, v: Vec3) -> Lanes<M> {
        let table = interpolated(grid, &self.reflected, v);
        let expected = |i: usize| View::new(self.phase.0[i] * own.0[i], v.z, Some(eta), self.slope).expected;
        Lanes::from_fn(|i| table.0[i] * expected(i))
    }
}

impl Closed<2> {
    /// The cells of a side, and ∫ e cos θ dω/Σ e as a mean of both ends.
    fn cells(&self, grid: &Grid, side: usize, index: f32, other: Option<f32>) -> (Vec<Cell>, f32) {
        const STEPS: usize = 128;
        let own = Lanes::splat(index);
        // Even steps of the root are finer near grazing.
        let edge = |i: usize| (i as f32 / STEPS as f32).powi(2);
        let mut cells = vec![Cell { cos2: 0.0, below: 0.0 }];
        let mut total = 0.0;
        for i in 0..STEPS {
            let (low, high) = (edge(i), edge(i + 1));
            let z = 0.5 * (low + high);
            let at = self.at(grid, side, &own, other, Vec3::new((1.0 - z * z).sqrt(), 0.0, z));
            let e = at.rest * self.inverse_sum;
            let mean = 0.5 * (e.0[0] + e.0[1]);
            total += mean * std::f32::consts::PI * (high * high - low * low);
            cells.push(Cell { cos2: high * high, below: total });
        }
        if total > 0.0 {
            cells.iter_mut().for_each(|cell| cell.below /= total);
        } else {
            cells.iter_mut().for_each(|cell| cell.below = cell.cos2);
        }
        (cells, total)
    }
}

impl Ends {
    fn new(closure: &Closure, balance: &Balance, eta: Option<f32>, phases: [f32; 2], slope: f32) -> Self {
        let closed = Closed::new(closure, Lanes(phases), slope);
        let (mut all, mut totals) = (Vec::new(), [0.0; 2]);
        for (side, total) in totals.iter_mut().enumerate().take(balance.sides()) {
            let index = if side == 0 { 1.0 } else { eta.unwrap_or(1.0) };
            let other = eta.map(|eta| if side == 0 { eta } else { eta.recip() });
            let (cells, integral) = closed.cells(&balance.grids[side], side, index, other);
            all.push(cells);
            *total = index * index * integral;
        }
        let total = totals[0] + totals[1];
        let sides = if total > 0.0 { totals.map(|t| t / total) } else { [1.0, 0.0] };
        Self { closed, cells: all, sides }
    }

    /// Draws a direction of the rest on a side (z > 0), from two numbers in [0, 1).
    #[inline]
    pub fn sample_rest(&self, side: usize, u: [f32; 2]) -> Vec3 {
        let cells = &self.cells[side];
        let i = cells.partition_point(|cell| cell.below <= u[0]).clamp(1, cells.len() - 1) - 1;
        let (cell, next) = (&cells[i], &cells[i + 1]);
        let part = ((u[0] - cell.below) / (next.below - cell.below).max(1e-20)).clamp(0.0, 1.0);
        let z2 = cell.cos2 + part * (next.cos2 - cell.cos2);
        let (sin, cos) = (std::f32::consts::TAU * u[1]).sin_cos();
        let r = (1.0 - z2).max(0.0).sqrt();
        Vec3::new(r * cos, r * sin, z2.max(1e-12).sqrt())
    }

    /// The density of [`Self::sample_rest`], 1/sr.
    #[inline]
    pub fn rest_density(&self, side: usize, cos: f32) -> f32 {
        let (cells, cos2) = (&self.cells[side], cos * cos);
        let i = cells.partition_point(|cell| cell.cos2 <= cos2).clamp(1, cells.len() - 1) - 1;
        let (cell, next) = (&cells[i], &cells[i + 1]);
        let width = (next.cos2 - cell.cos2).max(1e-20);
        // dω = dφ d(cos²θ) / (2 cos θ).
        (next.below - cell.below) / width * cos * std::f32::consts::FRAC_1_PI
    }

    /// Of the rest, the share that goes to a side.
    pub fn rest_share(&self, side: usize) -> f32 {
        self.sides[side]
    }
}

/// A row of lanes between the nodes of a grid.
#[inline(always)]
fn interpolated<const M: usize>(grid: &Grid, table: &[Lanes<M>], v: Vec3) -> Lanes<M> {
    let mut sum = Lanes::default();
    grid.interpolate(v.to_array(), |i, w| sum += table[i] * w);
    sum
}
