//! Metamers: other reflectances of the same colour.
//!
//! Let A hold, for each nm, the lamp times the three matching functions. A reflectance r falls apart into its
//! fundamental R r, with R = A(AᵀA)⁻¹Aᵀ, which alone makes the colour, and a black metamer r − R r, which the eye does
//! not see under that lamp: Aᵀ(r − R r) = 0 (Cohen and Kappauf 1982). Whatever black metamer is added, the tristimulus
//! values stay. Here one is drawn at random, smooth, and kept where there is room for it: with D = diag(min(r, 1 − r))
//! it is D c, where c is orthogonal to the columns of D A, so that r + t D c lies within [0, 1] for all |t| ≤ 1/max|c|.

use illuminant_spectrum::{Curve, Observer, SpectralRange};
use thiserror::Error;

/// A reflectance that looks like another under one lamp.
#[derive(Clone, Debug, PartialEq)]
pub struct Metamer {
    /// The reflectance, at each nm of the range.
    pub reflectance: Curve,
    /// Its distance from the given one, root mean square over the range.
    pub distance: f64,
    /// The largest distance that this seed allows within [0, 1].
    pub largest: f64,
}

/// Why no metamer was made.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum MetamerError {
    /// No reflectance.
    #[error("a reflectance lies between 0 and 1, and at {wavelength_nm} nm it is {value}")]
    NoReflectance {
        /// The first offending wavelength, nm.
        wavelength_nm: f64,
        /// The value there.
        value: f64,
    },
    /// The lamp is dark or negative.
    #[error("the lamp must not be negative and must give light that the eye sees")]
    NoLight,
    /// The reflectance is 0 or 1 nearly everywhere.
    #[error("the reflectance is 0 or 1 nearly everywhere, and no other within these bounds has its colour")]
    NoRoom,
    /// More was asked than fits.
    #[error("a distance of {wanted} was asked for, and with this seed it is above 0 and at most {largest}")]
    TooFar {
        /// The distance asked for.
        wanted: f64,
        /// The largest possible.
        largest: f64,
    },
}

/// The number of waves that a random direction is made of: structure down to about a twelfth of the range.
const WAVES: u32 = 12;

/// A reflectance with the tristimulus values of another under a lamp, at each nm of a range.
///
/// `seed` chooses among them, and `distance` is the root mean square of the difference over the range; `None` takes
/// the largest that stays within [0, 1] in the direction of the seed. Outside the range the ends hold.
///
/// ```
/// use illuminant_color::metamer;
/// use illuminant_spectrum::{Curve, Observer, SpectralRange, daylight};
/// let (observer, range) = (Observer::cie_1931_2deg(), SpectralRange::default());
/// let (grey, lamp) = (Curve::constant(0.4), daylight(6504.0).unwrap());
/// let found = metamer(&grey, &lamp, observer, range, 1, None).unwrap();
/// let [x, y, z] = observer.relative_xyz(&found.reflectance, &lamp, range);
/// let [x0, y0, z0] = observer.relative_xyz(&grey, &lamp, range);
/// assert!((x - x0).abs() < 1e-12 && (y - y0).abs() < 1e-12 && (z - z0).abs() < 1e-12);
/// assert!(found.distance > 0.05);
/// ```
///
/// # Errors
/// [`MetamerError`].
pub fn metamer(
    reflectance: &Curve,
    lamp: &Curve,
    observer: &Observer,
    range: SpectralRange,
    seed: u64,
    distance: Option<f64>,
) -> Result<Metamer, MetamerError> {
    let given = reflectance.tabulate(range);
    if let Some((w, &value)) = range.wavelengths().zip(&given).find(|(_, v)| !(0.0..=1.0).contains(*v)) {
        return Err(MetamerError::NoReflectance { wavelength_nm: w, value });
    }
    let room: Vec<f64> = given.iter().map(|r| r.min(1.0 - r)).collect();
    let mut columns = weights(lamp, observer, range)?;
    for column in &mut columns {
        for (value, room) in column.iter_mut().zip(&room) {
            *value *= room;
        }
    }
    let mut direction = random_waves(range.len(), seed);
    let before = norm(&direction);
    let basis = orthonormal(columns);
    // Twice is enough (Kahan and Parlett): once leaves what rounding makes.
    for _ in 0..2 {
        remove(&mut direction, &basis);
    }
    // Where there is no room the direction moves nothing, and must not set the scale.
    for (value, room) in direction.iter_mut().zip(&room) {
        if *room == 0.0 {
            *value = 0.0;
        }
    }
    let steepest = direction.iter().fold(0.0, |top: f64, c| top.max(c.abs()));
    let black: Vec<f64> = direction.iter().zip(&room).map(|(c, room)| c * room / steepest).collect();
    let rms = norm(&black) / (range.len() as f64).sqrt();
    if !(steepest > 1e-9 * before && rms > 1e-9) {
        return Err(MetamerError::NoRoom);
    }
    // A hair less than the limit, so that rounding does not step over it.
    let largest = rms * (1.0 - 1e-12);
    let wanted = distance.unwrap_or(largest);
    if !(wanted > 0.0 && wanted <= largest) {
        return Err(MetamerError::TooFar { wanted, largest });
    }
    let values = given.iter().zip(&black).map(|(r, b)| r + b * wanted / rms).collect();
    let reflectance = Curve::tabulated(range, values, reflectance.outside());
    Ok(Metamer { reflectance, distance: wanted, largest })
}

/// The fundamental of a reflectance under a lamp: the part R r that makes its colour, at each nm of a range. The rest
/// is its black metamer.
///
/// ```
/// use illuminant_spectrum::{Curve, Observer, SpectralRange, daylight};
/// let (observer, range) = (Observer::cie_1931_2deg(), SpectralRange::default());
/// let (grey, lamp) = (Curve::constant(0.4), daylight(6504.0).unwrap());
/// let seen = illuminant_color::fundamental(&grey, &lamp, observer, range).unwrap();
/// let y = observer.relative_xyz(&seen, &lamp, range)[1];
/// assert!((y - 0.4).abs() < 1e-12);
/// ```
///
/// # Errors
/// [`MetamerError::NoLight`].
pub fn fundamental(
    reflectance: &Curve,
    lamp: &Curve,
    observer: &Observer,
    range: SpectralRange,
) -> Result<Curve, MetamerError> {
    let given = reflectance.tabulate(range);
    let basis = orthonormal(weights(lamp, observer, range)?);
    let mut black = given.clone();
    for _ in 0..2 {
        remove(&mut black, &basis);
    }
    let values = given.iter().zip(&black).map(|(r, b)| r - b).collect();
    Ok(Curve::tabulated(range, values, reflectance.outside()))
}

/// The columns of A.
fn weights(lamp: &Curve, observer: &Observer, range: SpectralRange) -> Result<[Vec<f64>; 3], MetamerError> {
    let light = lamp.tabulate(range);
    let seen = observer.luminance(lamp, range);
    if !(seen > 0.0 && seen.is_finite() && light.iter().all(|v| *v >= 0.0)) {
        return Err(MetamerError::NoLight);
    }
    Ok([0, 1, 2]
        .map(|i| range.wavelengths().zip(&light).map(|(w, s)| s * observer.matching[i].at(w)).collect()))
}

/// Orthonormal columns that span the same space; fewer where a lamp of few lines leaves fewer independent ones.
fn orthonormal(columns: [Vec<f64>; 3]) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for mut column in columns {
        let before = norm(&column);
        for _ in 0..2 {
            remove(&mut column, &basis);
        }
        let after = norm(&column);
        if after > 1e-12 * before {
            column.iter_mut().for_each(|v| *v /= after);
            basis.push(column);
        }
    }
    basis
}

/// Takes from a vector what lies along each of an orthonormal basis.
fn remove(vector: &mut [f64], basis: &[Vec<f64>]) {
    for column in basis {
        let along: f64 = vector.iter().zip(column).map(|(a, b)| a * b).sum();
        vector.iter_mut().zip(column).for_each(|(v, c)| *v -= along * c);
    }
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// A sum of cosines of random size and phase.
fn random_waves(len: usize, seed: u64) -> Vec<f64> {
    // SplitMix64 (Steele, Lea and Flood 2014): every seed, 0 too, gives a sequence of its own.
    let mut state = seed;
    let mut uniform = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    };
    let waves: Vec<(f64, f64, f64)> = (1..=WAVES)
        .map(|k| (f64::from(k) * std::f64::consts::PI, uniform() - 0.5, uniform() * std::f64::consts::TAU))
        .collect();
    let last = (len.max(2) - 1) as f64;
    (0..len)
        .map(|i| waves.iter().map(|(k, size, phase)| size * (k * i as f64 / last + phase).cos()).sum())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use illuminant_spectrum::{Outside, daylight, planck};

    const RANGE: SpectralRange = SpectralRange { min_nm: 380, max_nm: 780 };

    fn paint() -> Curve {
        Curve::new(vec![400.0, 500.0, 560.0, 700.0], vec![0.0, 0.3, 0.6, 1.0], Outside::Hold).unwrap()
    }

    #[test]
    fn it_looks_alike_under_one_lamp_and_not_under_another() {
        let d65 = daylight(6504.0).unwrap();
        let a =
            Curve::tabulated(RANGE, RANGE.wavelengths().map(|w| planck(w, 2856.0)).collect(), Outside::Zero);
        for observer in [Observer::cie_1931_2deg(), Observer::cie_1964_10deg()] {
            let mut seen = Vec::new();
            for seed in 0..5 {
                let found = metamer(&paint(), &d65, observer, RANGE, seed, None).unwrap();
                let here = observer.relative_xyz(&found.reflectance, &d65, RANGE);
                let there = observer.relative_xyz(&found.reflectance, &a, RANGE);
                let (same, other) = (
                    observer.relative_xyz(&paint(), &d65, RANGE),
                    observer.relative_xyz(&paint(), &a, RANGE),
                );
                assert!((0..3).all(|i| (here[i] - same[i]).abs() < 1e-12), "{here:?} {same:?}");
                assert!((0..3).any(|i| (there[i] - other[i]).abs() > 1e-4), "{there:?} {other:?}");
                assert!(found.reflectance.values().iter().all(|v| (0.0..=1.0).contains(v)));
                assert!(found.distance > 0.01);
                assert!(!seen.contains(&found.reflectance), "each seed its own");
                let again = metamer(&paint(), &d65, observer, RANGE, seed, None).unwrap();
                assert_eq!(again, found);
                seen.push(found.reflectance);
            }
        }
    }

    #[test]
    fn the_distance_is_what_was_asked_for() {
        let d65 = daylight(6504.0).unwrap();
        let found = metamer(&paint(), &d65, Observer::cie_1931_2deg(), RANGE, 3, Some(0.02)).unwrap();
        let square: f64 =
            RANGE.wavelengths().map(|w| (found.reflectance.at(w) - paint().at(w)).powi(2)).sum::<f64>();
        assert!(((square / 401.0).sqrt() - 0.02).abs() < 1e-12);
        let more = metamer(&paint(), &d65, Observer::cie_1931_2deg(), RANGE, 3, Some(0.7));
        assert!(matches!(more, Err(MetamerError::TooFar { .. })));
    }

    #[test]
    fn a_lamp_of_one_line_is_no_trouble() {
        let line = Curve::new(vec![549.5, 550.0, 550.5], vec![0.0, 1.0, 0.0], Outside::Zero).unwrap();
        let found = metamer(&paint(), &line, Observer::cie_1931_2deg(), RANGE, 0, None).unwrap();
        assert!((found.reflectance.at(550.0) - paint().at(550.0)).abs() < 1e-12 && found.distance > 0.05);
    }

    #[test]
    fn matrix_r_is_a_projection() {
        let d65 = daylight(6504.0).unwrap();
        let observer = Observer::cie_1931_2deg();
        let once = fundamental(&paint(), &d65, observer, RANGE).unwrap();
        let twice = fundamental(&once, &d65, observer, RANGE).unwrap();
        assert!(once.values().iter().zip(twice.values()).all(|(a, b)| (a - b).abs() < 1e-12));
        let other = metamer(&paint(), &d65, observer, RANGE, 9, None).unwrap().reflectance;
        let same = fundamental(&other, &d65, observer, RANGE).unwrap();
        assert!(once.values().iter().zip(same.values()).all(|(a, b)| (a - b).abs() < 1e-10));
    }

    #[test]
    fn what_is_refused() {
        let (observer, d65) = (Observer::cie_1931_2deg(), daylight(6504.0).unwrap());
        let of = |r: &Curve, lamp: &Curve| metamer(r, lamp, observer, RANGE, 0, None);
        assert!(matches!(of(&Curve::constant(1.1), &d65), Err(MetamerError::NoReflectance { .. })));
        assert_eq!(of(&Curve::constant(1.0), &d65), Err(MetamerError::NoRoom));
        assert_eq!(of(&Curve::constant(0.5), &Curve::constant(0.0)), Err(MetamerError::NoLight));
    }
}
