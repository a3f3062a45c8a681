//! Tables that are compiled in.

use crate::{Curve, Outside};

/// The columns of a table as curves: lines of `wavelength_nm,value,…`; all that do not begin with a digit are
/// comments.
///
/// For the tables that ship, which are included when a crate is compiled and covered by its tests: what is no number
/// there is a broken build and not broken input, and makes curves of NaN. Users' files are read in Python.
///
/// ```
/// use illuminant_spectrum::{Outside, curves_from_csv};
/// let curves = curves_from_csv("# two lamps\nwavelength_nm,a,b\n400,1,2\n500,3,4\n", Outside::Zero);
/// assert_eq!((curves.len(), curves[1].at(450.0)), (2, 3.0));
/// ```
#[must_use]
pub fn curves_from_csv(text: &str, outside: Outside) -> Vec<Curve> {
    let rows: Vec<Vec<f64>> = text
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
        .map(|line| line.split(',').map(|field| field.trim().parse().unwrap_or(f64::NAN)).collect())
        .collect();
    let column =
        |i: usize| rows.iter().map(|row| row.get(i).copied().unwrap_or(f64::NAN)).collect::<Vec<f64>>();
    (1..rows.first().map_or(0, Vec::len))
        .map(|i| Curve::new(column(0), column(i), outside).unwrap_or_else(|_| Curve::constant(f64::NAN)))
        .collect()
}
