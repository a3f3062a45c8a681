//! Radiosity solvers: E = H + F P ρ E, the irradiance of sides under direct light H with form factors F (book eqs 4.27 and 4.31).
//!
//! P takes from sides to the patches that they make, by area. All lamps and spectral samples are columns of one right-hand side.

use crate::bicgstab::bicgstab;
use crate::cancel::{Cancel, Cancelled};
use crate::elements::Elements;
use crate::form_factors::FormFactors;
use crate::sparse::SpectralRows;
use nalgebra::DMatrix;
use rayon::prelude::*;
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// How the equations are solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solver {
    /// Elimination with partial pivoting (Goral et al. 1984).
    Gauss,
    /// Gauss and Seidel's iteration, each patch from the newest values of the others (Cohen and Greenberg 1985).
    GaussSeidel,
    /// Shooting from the patch that has most to send (Cohen et al. 1988), with the stored form factors.
    Progressive,
    /// The stabilised biconjugate gradient method (van der Vorst 1992).
    #[default]
    BiCgStab,
}

impl Solver {
    /// All solvers.
    pub const ALL: [Self; 4] = [Self::Gauss, Self::GaussSeidel, Self::Progressive, Self::BiCgStab];
    /// The most patches that elimination is used for.
    pub const MOST_ELIMINATED: usize = 4000;
}

impl fmt::Display for Solver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Gauss => "gauss",
            Self::GaussSeidel => "gauss-seidel",
            Self::Progressive => "progressive",
            Self::BiCgStab => "bicgstab",
        })
    }
}

impl FromStr for Solver {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|solver| solver.to_string() == name).ok_or_else(|| {
            format!("no solver {name:?}; known are {}", Self::ALL.map(|s| s.to_string()).join(", "))
        })
    }
}

/// Why equations are not solved.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SolveError {
    /// Elimination takes n³ steps.
    #[error(
        "elimination of {patches} patches would take too long: it is for {} at most; use bicgstab",
        Solver::MOST_ELIMINATED
    )]
    TooLarge {
        /// How many there are.
        patches: usize,
    },
    /// Light would grow from reflection to reflection.
    #[error(
        "a surface would return more light than it receives: the reflectance of side {side} is {reflectance}"
    )]
    Creates {
        /// The side.
        side: usize,
        /// Its reflectance.
        reflectance: f32,
    },
    /// The iteration came to no end.
    #[error("{solver} did not converge: after {steps} steps the residual was {residual:.1e}")]
    Diverged {
        /// Which.
        solver: Solver,
        /// Its steps.
        steps: usize,
        /// What was left.
        residual: f64,
    },
    /// Nobody waits for it any more.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// What is to be solved.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a> {
    /// The sides and patches.
    pub elements: &'a Elements,
    /// How they see each other.
    pub factors: &'a FormFactors,
    /// What sides receive from patches by way of mirrors and glass, where that is followed.
    pub specular: Option<&'a SpectralRows>,
    /// Of each side the reflectance in every sample, rows that follow each other.
    pub reflectance: &'a [f32],
    /// Of each side what it lets through of diffuse light, as diffuse light on its other side; nothing where no surface does.
    pub transmittance: &'a [f32],
    /// Of each side the irradiance straight from each lamp in every sample: rows of `lamps × samples`.
    pub direct: &'a [f32],
    /// Spectral samples.
    pub samples: usize,
    /// The relative residual at which iterations end.
    pub tolerance: f64,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Solution {
    /// Of each side the irradiance of each lamp in every sample, direct light included.
    pub irradiance: Vec<f32>,
    /// The relative residual, or for shooting the part of all light that is still to be sent, after each step.
    pub history: Vec<f64>,
}

impl<'a> Problem<'a> {
    /// Columns of the right-hand side.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.direct.len() / self.elements.sides.len().max(1)
    }

    /// Solves for the irradiance of all sides.
    ///
    /// # Errors
    /// [`SolveError`]: a reflectance is above 1, the patches are too many for elimination, or an iteration does not converge.
    pub fn solve(&self, solver: Solver) -> Result<Solution, SolveError> {
        self.solve_unless_cancelled(solver, &Cancel::default())
    }

    /// The same, which stops between steps when it is told to (elimination only between samples).
    ///
    /// # Errors
    /// As [`Self::solve`], and [`SolveError::Cancelled`].
    pub fn solve_unless_cancelled(&self, solver: Solver, cancel: &Cancel) -> Result<Solution, SolveError> {
        let through = |at: usize| self.transmittance.get(at).copied().unwrap_or(0.0);
        let returned = |at: usize| self.reflectance[at] + through(at);
        if let Some(at) = (0..self.reflectance.len()).find(|&at| !(0.0..=1.0 + 1e-4).contains(&returned(at)))
        {
            return Err(SolveError::Creates { side: at / self.samples, reflectance: returned(at) });
        }
        let sent = self.restricted(self.direct);
        let (radiosity, history) = match solver {
            Solver::Gauss => self.gauss(&sent, cancel)?,
            Solver::GaussSeidel => self.gauss_seidel(&sent, cancel)?,
            Solver::Progressive => self.progressive(&sent, cancel)?,
            Solver::BiCgStab => self.bicgstab(&sent, cancel)?,
        };
        Ok(Solution { irradiance: self.gathered(&radiosity), history })
    }

    /// The irradiance of all sides under the radiosity of patches and direct light.
    #[must_use]
    pub fn gathered(&self, radiosity: &[f32]) -> Vec<f32> {
        let columns = self.columns();
        let mut irradiance = self.direct.to_vec();
        irradiance
            .par_chunks_mut(columns.max(1))
            .enumerate()
            .for_each(|(side, sum)| self.receive(side, radiosity, sum));
        irradiance
    }

    /// Adds the irradiance of a side under the radiosity of patches.
    #[inline]
    fn receive(&self, side: usize, radiosity: &[f32], sum: &mut [f32]) {
        self.factors.rows.add_row(side, radiosity, sum);
        if let Some(specular) = self.specular {
            specular.add_row(side, radiosity, sum);
        }
    }

    /// The side through which light comes to another one, if anything is let through.
    #[inline]
    fn behind(&self, side: u32) -> Option<u32> {
        if self.transmittance.is_empty() { None } else { self.elements.opposite(side) }
    }

    /// Adds what a side sends of its own irradiance, or of that of the side behind it, to its patch.
    #[inline]
    fn send(&self, side: u32, of: &[f32], irradiance: &[f32], patch: &mut [f32], area: f64) {
        let share = (self.elements.area(side) / area) as f32;
        let reflectance = &of[side as usize * self.samples..][..self.samples];
        for (patch, irradiance) in patch.chunks_mut(self.samples).zip(irradiance.chunks(self.samples)) {
            for ((b, e), r) in patch.iter_mut().zip(irradiance).zip(reflectance) {
                *b += share * r * e;
            }
        }
    }

    /// The radiosity of patches that the irradiance of their sides makes.
    #[must_use]
    pub fn restricted(&self, irradiance: &[f32]) -> Vec<f32> {
        let columns = self.columns();
        let mut radiosity = vec![0f32; self.elements.patches.len() * columns];
        radiosity.par_chunks_mut(columns.max(1)).enumerate().for_each(|(patch, b)| {
            let area = self.elements.patch_area(patch as u32);
            for &side in &self.elements.patches[patch] {
                let of = |side: u32| &irradiance[side as usize * columns..][..columns];
                self.send(side, self.reflectance, of(side), b, area);
                if let Some(behind) = self.behind(side) {
                    self.send(side, self.transmittance, of(behind), b, area);
                }
            }
        });
        radiosity
    }

    /// What patches send of the light of other patches.
    fn reflected(&self, radiosity: &[f32]) -> Vec<f32> {
        let columns = self.columns();
        let mut irradiance = vec![0f32; self.elements.sides.len() * columns];
        irradiance
            .par_chunks_mut(columns.max(1))
            .enumerate()
            .for_each(|(side, sum)| self.receive(side, radiosity, sum));
        self.restricted(&irradiance)
    }

    fn residual_limit(&self, steps: usize, residual: f64, solver: Solver) -> Result<(), SolveError> {
        const MOST: usize = 2000;
        if steps >= MOST && residual > 10.0 * self.tolerance {
            return Err(SolveError::Diverged { solver, steps, residual });
        }
        Ok(())
    }

    fn gauss(&self, sent: &[f32], cancel: &Cancel) -> Result<(Vec<f32>, Vec<f64>), SolveError> {
        let patches = self.elements.patches.len();
        if patches > Solver::MOST_ELIMINATED {
            return Err(SolveError::TooLarge { patches });
        }
        let columns = self.columns();
        let lamps = columns / self.samples;
        let areas: Vec<f64> = (0..patches as u32).map(|p| self.elements.patch_area(p)).collect();
        let solved: Vec<DMatrix<f64>> = (0..self.samples)
            .into_par_iter()
            .map(|sample| {
                cancel.check()?;
                let mut matrix = DMatrix::<f64>::identity(patches, patches);
                for (side, &patch) in self.elements.patch_of.iter().enumerate() {
                    let share = self.elements.area(side as u32) / areas[patch as usize];
                    let mut add = |from: usize, of: &[f32]| {
                        let sent = share * f64::from(of[side * self.samples + sample]);
                        let (columns, values) = self.factors.rows.row(from);
                        for (&column, &value) in columns.iter().zip(values) {
                            matrix[(patch as usize, column as usize)] -= sent * f64::from(value);
                        }
                        let Some(specular) = self.specular else { return };
                        let (columns, values) = specular.row(from);
                        for (&column, values) in columns.iter().zip(values.chunks(self.samples)) {
                            matrix[(patch as usize, column as usize)] -= sent * f64::from(values[sample]);
                        }
                    };
                    add(side, self.reflectance);
                    if let Some(behind) = self.behind(side as u32) {
                        add(behind as usize, self.transmittance);
                    }
                }
                let right = DMatrix::from_fn(patches, lamps, |patch, lamp| {
                    f64::from(sent[patch * columns + lamp * self.samples + sample])
                });
                // Strictly dominant by its diagonal wherever something is absorbed (book 4.4.2), so never singular.
                Ok(matrix.lu().solve(&right).unwrap_or(right))
            })
            .collect::<Result<_, Cancelled>>()?;
        let mut radiosity = vec![0f32; patches * columns];
        for (sample, found) in solved.iter().enumerate() {
            for patch in 0..patches {
                for lamp in 0..lamps {
                    radiosity[patch * columns + lamp * self.samples + sample] = found[(patch, lamp)] as f32;
                }
            }
        }
        Ok((radiosity, vec![0.0]))
    }

    fn gauss_seidel(&self, sent: &[f32], cancel: &Cancel) -> Result<(Vec<f32>, Vec<f64>), SolveError> {
        let columns = self.columns();
        let mut radiosity = sent.to_vec();
        let mut history = Vec::new();
        let (mut irradiance, mut new) = (vec![0f32; columns], vec![0f32; columns]);
        loop {
            let (mut changed, mut all) = (0.0f64, 0.0f64);
            for (patch, sides) in self.elements.patches.iter().enumerate() {
                cancel.check()?;
                let area = self.elements.patch_area(patch as u32);
                new.fill(0.0);
                for &side in sides {
                    let mut add = |from: u32, of: &[f32]| {
                        irradiance.copy_from_slice(&self.direct[from as usize * columns..][..columns]);
                        self.receive(from as usize, &radiosity, &mut irradiance);
                        self.send(side, of, &irradiance, &mut new, area);
                    };
                    add(side, self.reflectance);
                    if let Some(behind) = self.behind(side) {
                        add(behind, self.transmittance);
                    }
                }
                for (b, n) in radiosity[patch * columns..][..columns].iter_mut().zip(&new) {
                    changed += area * f64::from((*n - *b).abs());
                    all += area * f64::from(n.abs());
                    *b = *n;
                }
            }
            let residual = if all > 0.0 { changed / all } else { 0.0 };
            history.push(residual);
            self.residual_limit(history.len(), residual, Solver::GaussSeidel)?;
            if residual <= self.tolerance || history.len() >= 2000 {
                return Ok((radiosity, history));
            }
        }
    }

    /// The patch with most unshot light sends it to all sides that see it, and what comes by way of mirrors too.
    fn progressive(&self, sent: &[f32], cancel: &Cancel) -> Result<(Vec<f32>, Vec<f64>), SolveError> {
        let (columns, patches) = (self.columns(), self.elements.patches.len());
        let seen_by = self.factors.rows.transposed();
        // Of each patch the sides that see it by way of mirrors, and where their entries stand.
        let mut mirrored: Vec<Vec<(u32, usize)>> = Vec::new();
        if let Some(specular) = self.specular {
            mirrored.resize(patches, Vec::new());
            for side in 0..self.elements.sides.len() {
                for at in specular.starts[side]..specular.starts[side + 1] {
                    mirrored[specular.columns[at] as usize].push((side as u32, at));
                }
            }
        }
        let areas: Vec<f64> = (0..patches as u32).map(|p| self.elements.patch_area(p)).collect();
        let (mut radiosity, mut unshot) = (sent.to_vec(), sent.to_vec());
        let power = |unshot: &[f32], patch: usize| {
            areas[patch] * unshot[patch * columns..][..columns].iter().map(|v| f64::from(*v)).sum::<f64>()
        };
        let mut waiting: Vec<f64> = (0..patches).map(|p| power(&unshot, p)).collect();
        let all: f64 = waiting.iter().sum();
        let mut left = all;
        let mut history = Vec::new();
        let mut returned = vec![0f32; columns];
        let most = 400 * patches.max(1);
        while left > self.tolerance * all && history.len() < most {
            cancel.check()?;
            let Some(shooter) = (0..patches).max_by(|&a, &b| waiting[a].total_cmp(&waiting[b])) else {
                break;
            };
            let shot: Vec<f32> = unshot[shooter * columns..][..columns].to_vec();
            unshot[shooter * columns..][..columns].fill(0.0);
            left -= waiting[shooter];
            waiting[shooter] = 0.0;
            let mut arrive = |side: u32, arriving: &[f32]| {
                let mut add = |sender: u32, of: &[f32]| {
                    let patch = self.elements.patch_of[sender as usize] as usize;
                    returned.fill(0.0);
                    self.send(sender, of, arriving, &mut returned, areas[patch]);
                    let before = waiting[patch];
                    for (i, r) in returned.iter().enumerate() {
                        radiosity[patch * columns + i] += r;
                        unshot[patch * columns + i] += r;
                        waiting[patch] += areas[patch] * f64::from(*r);
                    }
                    left += waiting[patch] - before;
                };
                add(side, self.reflectance);
                if let Some(behind) = self.behind(side) {
                    add(behind, self.transmittance);
                }
            };
            let (sides, factors) = seen_by.row(shooter);
            for (&side, &factor) in sides.iter().zip(factors) {
                arrive(side, &shot.iter().map(|v| v * factor).collect::<Vec<_>>());
            }
            for &(side, at) in mirrored.get(shooter).into_iter().flatten() {
                let Some(specular) = self.specular else { break };
                let values = &specular.values[at * self.samples..][..self.samples];
                let arriving: Vec<f32> =
                    shot.iter().enumerate().map(|(i, v)| v * values[i % self.samples]).collect();
                arrive(side, &arriving);
            }
            history.push(if all > 0.0 { left / all } else { 0.0 });
        }
        Ok((radiosity, history))
    }

    fn bicgstab(&self, sent: &[f32], cancel: &Cancel) -> Result<(Vec<f32>, Vec<f64>), SolveError> {
        let apply = |x: &[f32]| {
            let mut y = self.reflected(x);
            y.par_iter_mut().zip(x).with_min_len(4096).for_each(|(y, x)| *y = x - *y);
            y
        };
        let (x, history) = bicgstab(sent, self.columns(), (self.tolerance, 2000), apply, cancel)?;
        let residual = history[history.len() - 1];
        if residual > 1e3 * self.tolerance.max(1e-6) {
            return Err(SolveError::Diverged { solver: Solver::BiCgStab, steps: history.len(), residual });
        }
        Ok((x, history))
    }

    /// The part of the light, of all lamps together, that comes in and neither is absorbed nor leaves, in the sample where it is most:
    /// the energy balance of a solution.
    #[must_use]
    pub fn imbalance(&self, irradiance: &[f32]) -> f64 {
        let columns = self.columns();
        let (mut came, mut went) = (vec![0f64; self.samples], vec![0f64; self.samples]);
        let radiosity = self.restricted(irradiance);
        for side in 0..self.elements.sides.len() {
            let area = self.elements.area(side as u32);
            for column in 0..columns {
                let sample = column % self.samples;
                let at = side * columns + column;
                let returned = side * self.samples + sample;
                let through = self.transmittance.get(returned).copied().unwrap_or(0.0);
                let absorbed = 1.0 - f64::from(self.reflectance[returned] + through);
                came[sample] += area * f64::from(self.direct[at]);
                went[sample] += area * absorbed * f64::from(irradiance[at]);
            }
        }
        // What a side does not see of other surfaces, by way of mirrors too, it sends where none of them receive it.
        let mut seen = vec![0f64; self.samples];
        for side in 0..self.elements.sides.len() {
            seen.fill(1.0 - f64::from(self.factors.open[side]));
            if let Some(specular) = self.specular {
                for values in specular.row(side).1.chunks(self.samples) {
                    seen.iter_mut().zip(values).for_each(|(sum, v)| *sum += f64::from(*v));
                }
            }
            let patch = self.elements.patch_of[side] as usize;
            let area = self.elements.area(side as u32);
            for column in 0..columns {
                let sample = column % self.samples;
                let lost = area * (1.0 - seen[sample]);
                went[sample] += lost * f64::from(radiosity[patch * columns + column]);
            }
        }
        came.iter()
            .zip(&went)
            .filter(|(c, _)| **c > 0.0)
            .map(|(c, w)| (w / c - 1.0).abs())
            .fold(0.0, f64::max)
    }
}
