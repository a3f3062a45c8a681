//! How the index of refraction changes with wavelength (book 2.2.5, III.5).
//!
//! Wavelengths are in nm; coefficients are those of catalogues, in µm.

/// The lines by which glasses are measured: name, nm (Fraunhofer's, and later ones of lamps).
pub const FRAUNHOFER_NM: [(&str, f64); 11] = [
    ("h", 404.656),
    ("g", 435.834),
    ("G'", 434.047),
    ("F'", 479.991),
    ("F", 486.134),
    ("e", 546.073),
    ("d", 587.561),
    ("D", 589.294),
    ("C'", 643.847),
    ("C", 656.281),
    ("r", 706.519),
];

/// The index of Sellmeier's formula, n² = 1 + Σ B λ²/(λ² − C), with C in µm²; `None` at a resonance or where n² would not be
/// positive.
///
/// ```
/// use illuminant_optics::dispersion::sellmeier;
/// // SCHOTT N-BK7.
/// let bk7 = [(1.039_612_12, 0.006_000_698_67), (0.231_792_344, 0.020_017_914_4), (1.010_469_45, 103.560_653)];
/// assert!((sellmeier(&bk7, 587.5618).unwrap() - 1.5168).abs() < 1e-4);
/// ```
#[must_use]
pub fn sellmeier(terms: &[(f64, f64)], nm: f64) -> Option<f64> {
    let square = (nm * 1e-3).powi(2);
    let n2 = 1.0 + terms.iter().map(|(b, c)| b * square / (square - c)).sum::<f64>();
    (n2.is_finite() && n2 > 0.0).then(|| n2.sqrt())
}

/// The index of Cauchy's formula, n = A + B/λ² + C/λ⁴ + …, with coefficients in µm².
///
/// ```
/// use illuminant_optics::dispersion::cauchy;
/// assert!((cauchy(&[1.5046, 0.0042], 589.3) - 1.51669).abs() < 1e-4);
/// ```
#[must_use]
pub fn cauchy(coefficients: &[f64], nm: f64) -> f64 {
    let x = (nm * 1e-3).powi(-2);
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Abbe's number, (n_middle − 1)/(n_blue − n_red): with d, F, C it is V_d, with e, F′, C′ V_e. Infinite without dispersion.
///
/// ```
/// use illuminant_optics::dispersion::abbe_number;
/// assert!((abbe_number(1.51680, 1.52238, 1.51432) - 64.1).abs() < 0.1); // N-BK7
/// ```
#[must_use]
pub fn abbe_number(middle: f64, blue: f64, red: f64) -> f64 {
    (middle - 1.0) / (blue - red)
}
