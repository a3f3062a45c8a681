//! Chromatic adaptation: what looks under one white as a colour does under another (von Kries 1902).
//!
//! XYZ becomes responses of cones, each is scaled by the ratio of the two whites' responses, and back:
//! M⁻¹ diag(M XYZ_to / M XYZ_from) M. The methods differ in M.
//!
//! | name | M |
//! | --- | --- |
//! | `von Kries` | cones of Hunt, Pointer and Estévez, normalised to D65 (Fairchild 2013) |
//! | `Bradford` | Lam 1985, without its nonlinear blue (ICC.1:2010) |
//! | `CAT16` | Li et al. 2017, complete adaptation |

use crate::{Matrix, Triple};

/// A linear method of chromatic adaptation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Adaptation {
    /// The cones of Hunt, Pointer and Estévez.
    VonKries,
    /// The linear Bradford transform.
    Bradford,
    /// The transform of CIECAM16.
    Cat16,
}

impl Adaptation {
    /// All methods.
    pub const ALL: [Self; 3] = [Self::VonKries, Self::Bradford, Self::Cat16];

    /// The method's name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::VonKries => "von Kries",
            Self::Bradford => "Bradford",
            Self::Cat16 => "CAT16",
        }
    }

    /// The method of a name, whatever its case.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.name().eq_ignore_ascii_case(name))
    }

    /// The matrix from XYZ to the responses of cones.
    #[must_use]
    pub fn cones(self) -> Matrix {
        Matrix(match self {
            Self::VonKries => {
                [[0.400_24, 0.7076, -0.080_81], [-0.2263, 1.165_32, 0.0457], [0.0, 0.0, 0.918_22]]
            }
            Self::Bradford => {
                [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
            }
            Self::Cat16 => [
                [0.401_288, 0.650_173, -0.051_461],
                [-0.250_268, 1.204_414, 0.045_854],
                [-0.002_079, 0.048_952, 0.953_127],
            ],
        })
    }

    /// The matrix that takes XYZ seen under the white `from` to XYZ that looks the same under the white `to`.
    ///
    /// `None` when a white has no response in one of the cones.
    ///
    /// ```
    /// use illuminant_color::Adaptation;
    /// let (d65, d50) = ([0.9505, 1.0, 1.0891], [0.9642, 1.0, 0.8249]);
    /// let white = Adaptation::Bradford.matrix(d65, d50).unwrap().apply(d65);
    /// assert!(white.iter().zip(d50).all(|(a, b)| (a - b).abs() < 1e-14));
    /// ```
    #[must_use]
    pub fn matrix(self, from: Triple, to: Triple) -> Option<Matrix> {
        let cones = self.cones();
        let (from, to) = (cones.apply(from), cones.apply(to));
        let ratio = [0, 1, 2].map(|i| to[i] / from[i]);
        let usable = ratio.iter().all(|v| v.is_finite() && *v > 0.0);
        usable.then(|| Some(cones.inverse().ok()?.after(&Matrix::diagonal(ratio)).after(&cones)))?
    }
}
