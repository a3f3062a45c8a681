//! The spectral samplings by name.

use crate::{Basis, Fitted, Gauss, Hall, Normalisation, OneNanometre, Products, Tristimulus, Uniform};
use illuminant_color::RgbSystem;
use illuminant_spectrum::SpectralRange;
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// Where the boxes of `hall` end.
#[derive(Clone, Debug, PartialEq)]
pub enum Boxes {
    /// All of one width.
    Even(usize),
    /// Found by the book's local search on the scene's products.
    Local(usize),
    /// Found by searches from several starts.
    Global(usize),
    /// Given, nm.
    At(Vec<f64>),
}

/// A spectral sampling by name, before it knows its range and scene.
///
/// ```
/// use illuminant_sampling::SpectralSampling;
/// let sampling: SpectralSampling = "fitted:8".parse().unwrap();
/// assert_eq!(sampling.to_string(), "fitted:8");
/// assert!("uniform:99".parse::<SpectralSampling>().is_err());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum SpectralSampling {
    /// N wavelengths and weights chosen for the scene.
    Fitted(usize),
    /// N wavelengths, evenly spaced.
    Uniform(usize),
    /// Boxes.
    Hall(Boxes),
    /// Meyer's four samples.
    Meyer,
    /// The same with the weights as the book prints them.
    MeyerAsPrinted,
    /// Gauss quadrature along A, C₁ and C₂ with so many points.
    Gauss([usize; 3]),
    /// Computation in linear RGB of sRGB's primaries.
    Rgb(Normalisation),
    /// Computation in XYZ.
    Xyz,
    /// Every nm of the range: the reference.
    OneNanometre,
}

/// The largest bundle of lanes.
const MOST: usize = 32;

/// Every form of name, with what it means, for help and messages.
pub const SAMPLING_NAMES: &[(&str, &str)] = &[
    ("fitted:N", "N wavelengths and weights fitted to the scene's lamps and materials"),
    ("uniform:N", "N wavelengths, evenly spaced"),
    ("hall:N", "N boxes, their bounds found on the scene by the book's search (hall:N:even, hall:N:global)"),
    ("hall:A,B,C", "boxes between the given bounds in nm"),
    ("meyer", "Meyer's four samples (meyer:printed with the book's weights)"),
    ("gauss:A,B,C", "Gauss quadrature with A, B and C points on the axes A, C1 and C2"),
    ("rgb", "colours multiplied as RGB (rgb:white, rgb:area: a mirror made neutral)"),
    ("xyz", "colours multiplied as XYZ"),
    ("1nm", "every nm: the reference"),
];

/// Why a name is no spectral sampling, or not over this range.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum SamplingError {
    /// The name is unknown.
    #[error("no spectral sampling {0:?}; known are {known}", known = known())]
    Unknown(String),
    /// The count is out of range.
    #[error("{name}:N takes a whole number N from 1 to {MOST}, not {found:?}")]
    Count {
        /// The sampling.
        name: String,
        /// What stands for N.
        found: String,
    },
    /// Something else about it.
    #[error("{0}")]
    Unfit(String),
}

fn known() -> String {
    let forms: Vec<_> = SAMPLING_NAMES.iter().map(|(form, _)| *form).collect();
    forms.join(", ")
}

fn count(name: &str, text: &str) -> Result<usize, SamplingError> {
    match text.parse() {
        Ok(n) if (1..=MOST).contains(&n) => Ok(n),
        _ => Err(SamplingError::Count { name: name.into(), found: text.into() }),
    }
}

fn boxes(text: &str) -> Result<Boxes, SamplingError> {
    if text.contains(',') {
        let unfit = || {
            SamplingError::Unfit(format!("hall:{text}: bounds are whole, increasing nm: hall:400,500,600"))
        };
        let bounds: Vec<u32> =
            text.split(',').map(|b| b.trim().parse().map_err(|_| unfit())).collect::<Result<_, _>>()?;
        if bounds.len() > MOST + 1 || !bounds.windows(2).all(|pair| pair[0] < pair[1]) {
            return Err(unfit());
        }
        return Ok(Boxes::At(bounds.into_iter().map(f64::from).collect()));
    }
    match text.split_once(':') {
        None => Ok(Boxes::Local(count("hall", text)?)),
        Some((n, "even")) => Ok(Boxes::Even(count("hall", n)?)),
        Some((n, "local")) => Ok(Boxes::Local(count("hall", n)?)),
        Some((n, "global")) => Ok(Boxes::Global(count("hall", n)?)),
        Some((_, search)) => Err(SamplingError::Unfit(format!(
            "hall:N:{search}: the bounds of boxes are even, local or global"
        ))),
    }
}

fn orders(text: &str) -> Result<[usize; 3], SamplingError> {
    let found: Vec<usize> = text.split(',').filter_map(|n| n.trim().parse().ok()).collect();
    match found.as_slice() {
        &[a, b, c] if [a, b, c].iter().all(|n| (1..=10).contains(n)) && text.split(',').count() == 3 => {
            Ok([a, b, c])
        }
        _ => Err(SamplingError::Unfit(format!(
            "gauss:{text}: expected the number of points, 1 to 10, on A, C1 and C2, such as gauss:3,2,1"
        ))),
    }
}

impl FromStr for SpectralSampling {
    type Err = SamplingError;

    fn from_str(name: &str) -> Result<Self, SamplingError> {
        let unknown = || Err(SamplingError::Unknown(name.into()));
        match name.split_once(':') {
            Some(("fitted", n)) => Ok(Self::Fitted(count("fitted", n)?)),
            Some(("uniform", n)) => Ok(Self::Uniform(count("uniform", n)?)),
            Some(("hall", text)) => Ok(Self::Hall(boxes(text)?)),
            Some(("gauss", text)) => Ok(Self::Gauss(orders(text)?)),
            Some(("rgb", "white")) => Ok(Self::Rgb(Normalisation::White)),
            Some(("rgb", "area")) => Ok(Self::Rgb(Normalisation::Area)),
            Some(("meyer", "printed")) => Ok(Self::MeyerAsPrinted),
            Some(_) => unknown(),
            None => match name {
                "rgb" => Ok(Self::Rgb(Normalisation::Luminance)),
                "xyz" => Ok(Self::Xyz),
                "meyer" => Ok(Self::Meyer),
                "1nm" => Ok(Self::OneNanometre),
                "fitted" | "uniform" | "hall" => {
                    Err(SamplingError::Count { name: name.into(), found: String::new() })
                }
                _ => unknown(),
            },
        }
    }
}

impl fmt::Display for SpectralSampling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fitted(n) => write!(f, "fitted:{n}"),
            Self::Uniform(n) => write!(f, "uniform:{n}"),
            Self::Hall(Boxes::Even(n)) => write!(f, "hall:{n}:even"),
            Self::Hall(Boxes::Local(n)) => write!(f, "hall:{n}"),
            Self::Hall(Boxes::Global(n)) => write!(f, "hall:{n}:global"),
            Self::Hall(Boxes::At(bounds)) => {
                let bounds: Vec<_> = bounds.iter().map(ToString::to_string).collect();
                write!(f, "hall:{}", bounds.join(","))
            }
            Self::Meyer => f.write_str("meyer"),
            Self::MeyerAsPrinted => f.write_str("meyer:printed"),
            Self::Gauss([a, b, c]) => write!(f, "gauss:{a},{b},{c}"),
            Self::Rgb(Normalisation::Luminance) => f.write_str("rgb"),
            Self::Rgb(Normalisation::White) => f.write_str("rgb:white"),
            Self::Rgb(Normalisation::Area) => f.write_str("rgb:area"),
            Self::Xyz => f.write_str("xyz"),
            Self::OneNanometre => f.write_str("1nm"),
        }
    }
}

impl SpectralSampling {
    /// The basis over a range of wavelengths. `products` is asked only by samplings that look at the scene; with no
    /// products, `fitted` is `uniform` and the boxes of `hall` are even.
    ///
    /// # Errors
    /// [`SamplingError::Unfit`] when there is no such basis over the range.
    pub fn basis(
        &self,
        range: SpectralRange,
        products: &dyn Fn() -> Option<Products>,
    ) -> Result<Box<dyn Basis>, SamplingError> {
        let rgb = |normalisation| {
            let system = RgbSystem::named("sRGB").ok_or_else(|| SamplingError::Unknown("rgb".into()))?;
            Ok::<_, SamplingError>(Tristimulus::rgb(&system, normalisation, range))
        };
        let many = |n: usize| {
            if n <= range.len() {
                Ok(n)
            } else {
                let text =
                    format!("{self}: the range of {} wavelengths has no room for {n} samples", range.len());
                Err(SamplingError::Unfit(text))
            }
        };
        Ok(match self {
            Self::Fitted(n) => match products().and_then(|p| Fitted::new(*n, range, &p)) {
                Some(fitted) => Box::new(fitted),
                None => Box::new(Uniform::new(many(*n)?, range)),
            },
            Self::Uniform(n) => Box::new(Uniform::new(many(*n)?, range)),
            Self::Hall(Boxes::Even(n)) => Box::new(Hall::even(many(*n)?, range)),
            Self::Hall(Boxes::Local(n)) => match products() {
                Some(p) => Box::new(Hall::local_search(many(*n)?, range, &p)),
                None => Box::new(Hall::even(many(*n)?, range)),
            },
            Self::Hall(Boxes::Global(n)) => match products() {
                Some(p) => Box::new(Hall::global_search(many(*n)?, range, &p)),
                None => Box::new(Hall::even(many(*n)?, range)),
            },
            Self::Hall(Boxes::At(bounds)) => {
                let holds = |pair: &[f64]| range.wavelengths().any(|w| (pair[0]..pair[1]).contains(&w));
                if let Some(empty) = bounds.windows(2).find(|pair| !holds(pair)) {
                    return Err(SamplingError::Unfit(format!(
                        "{self}: the box from {} to {} nm holds nothing of the range {}–{} nm",
                        empty[0], empty[1], range.min_nm, range.max_nm
                    )));
                }
                Box::new(Hall::new(bounds.clone(), range))
            }
            Self::Meyer => Box::new(Gauss::meyer(range)),
            Self::MeyerAsPrinted => Box::new(Gauss::meyer_as_printed(range)),
            Self::Gauss(orders) => Box::new(Gauss::new(*orders, range).map_err(SamplingError::Unfit)?),
            Self::Rgb(normalisation) => Box::new(rgb(*normalisation)?),
            Self::Xyz => Box::new(Tristimulus::xyz(range)),
            Self::OneNanometre => Box::new(OneNanometre::new(range)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_are_written() {
        for name in [
            "fitted:8",
            "uniform:32",
            "hall:9",
            "hall:9:even",
            "hall:9:global",
            "hall:400,500,600",
            "meyer",
            "meyer:printed",
            "gauss:3,2,1",
            "rgb",
            "rgb:white",
            "rgb:area",
            "xyz",
            "1nm",
        ] {
            assert_eq!(name.parse::<SpectralSampling>().unwrap().to_string(), name);
        }
        for wrong in [
            "",
            "rbg",
            "fitted",
            "fitted:0",
            "fitted:33",
            "uniform:x",
            "hall:9:best",
            "hall:500,400",
            "gauss:3,2",
            "gauss:0,1,1",
            "gauss:3,x,1",
            "meyer:4",
            "1nm:2",
        ] {
            assert!(wrong.parse::<SpectralSampling>().is_err(), "{wrong}");
        }
    }
}
