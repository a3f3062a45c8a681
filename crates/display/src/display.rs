//! A display: what light it sends for its code values.
//!
//! XYZ = (peak − black) M R(v) + black W: R is the response of each channel, M the matrix of primaries and white (book
//! eq 3.2), W the XYZ of the white with Y = 1, and black the light that leaves the screen at code 0. For hybrid
//! log-gamma the three channels meet in the OOTF of BT.2100, light_c = Y^(γ−1) E_c with Y the luminance of the scene's
//! light E and γ = 1.2 + 0.42 log₁₀(peak / 1000) from 400 to 2000 cd/m²; outside, γ = 1.2 × 1.111^log₂(peak / 1000) (BT.2390).

use crate::Response;
use crate::response::{LARGEST, between};
use illuminant_color::{RgbSystem, Triple};
use thiserror::Error;

/// A display, by measurement or by a standard.
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    system: RgbSystem,
    responses: [Response; 3],
    peak: f64,
    black: f64,
    luminance: Triple,
}

/// Why numbers make no display.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum DisplayError {
    /// White not above black, or not finite.
    #[error(
        "a display's white is brighter than its black, and its black is not below 0: {peak} and {black} cd/m²"
    )]
    Range {
        /// Luminance of white.
        peak: f64,
        /// Luminance of black.
        black: f64,
    },
    /// A response that is none.
    #[error(
        "the response of the {0} channel does not rise from 0 at black to 1 at white, within what it can hold"
    )]
    Response(&'static str),
    /// Hybrid log-gamma in one channel and another response in the next.
    #[error("hybrid log-gamma is the response of all three channels, or of none")]
    Mixed,
    /// A black level beside code values that are absolute.
    #[error("PQ and HLG state light from zero: their display has a black of 0 here, not of {0} cd/m²")]
    Black(f64),
}

const CHANNELS: [&str; 3] = ["red", "green", "blue"];

impl Display {
    /// A display from its primaries and white, the response of each channel, and the luminances of white and black.
    ///
    /// # Errors
    /// [`DisplayError`]: white is not above black, a response does not rise, hybrid log-gamma is mixed with others, or a
    /// display of PQ or HLG has a black level.
    pub fn new(
        system: RgbSystem,
        responses: [Response; 3],
        peak: f64,
        black: f64,
    ) -> Result<Self, DisplayError> {
        if !(peak > black && black >= 0.0 && peak.is_finite()) {
            return Err(DisplayError::Range { peak, black });
        }
        if let Some(channel) = responses.iter().position(|response| !response.is_sound()) {
            return Err(DisplayError::Response(CHANNELS[channel]));
        }
        let hybrid = responses.iter().filter(|response| **response == Response::Hlg).count();
        if hybrid != 0 && hybrid != 3 {
            return Err(DisplayError::Mixed);
        }
        let absolute =
            hybrid == 3 || responses.iter().any(|response| matches!(response, Response::Pq { .. }));
        if absolute && black > 0.0 {
            return Err(DisplayError::Black(black));
        }
        let luminance = system.to_xyz_rows()[1];
        Ok(Self { system, responses, peak, black, luminance })
    }

    /// Primaries, white and the matrices.
    #[must_use]
    pub fn system(&self) -> &RgbSystem {
        &self.system
    }

    /// The response of each channel.
    #[must_use]
    pub fn responses(&self) -> &[Response; 3] {
        &self.responses
    }

    /// Luminance of white, cd/m².
    #[must_use]
    pub fn peak(&self) -> f64 {
        self.peak
    }

    /// Luminance of black, cd/m².
    #[must_use]
    pub fn black(&self) -> f64 {
        self.black
    }

    /// Luminance of linear RGB, where white has 1.
    #[must_use]
    pub fn luminance(&self, rgb: Triple) -> f64 {
        self.luminance[0] * rgb[0] + self.luminance[1] * rgb[1] + self.luminance[2] * rgb[2]
    }

    /// The exponent of the OOTF, when the channels are hybrid log-gamma.
    #[must_use]
    pub fn ootf_gamma(&self) -> Option<f64> {
        let extended = |peak: f64| 1.2 * 1.111f64.powf((peak / 1000.0).log2());
        let of_bt2100 = |peak: f64| 1.2 + 0.42 * (peak / 1000.0).log10();
        let within = (400.0..=2000.0).contains(&self.peak);
        (self.responses[0] == Response::Hlg)
            .then(|| if within { of_bt2100(self.peak) } else { extended(self.peak) })
    }

    /// The light of each channel, 0 to 1, of three code values; that of PQ passes 1 where a code asks for more than the peak.
    #[must_use]
    pub fn decode(&self, code: Triple) -> Triple {
        let light: Triple = std::array::from_fn(|c| self.responses[c].decode(code[c]));
        match self.ootf_gamma() {
            Some(gamma) => {
                let scene = self.luminance(light);
                light.map(|v| if scene > 0.0 { v * scene.powf(gamma - 1.0) } else { 0.0 })
            }
            None => light,
        }
    }

    /// The code values of the light of each channel: the inverse of [`Self::decode`].
    #[must_use]
    pub fn encode(&self, light: Triple) -> Triple {
        let light = self.before_ootf(light);
        std::array::from_fn(|c| self.responses[c].encode(light[c]))
    }

    /// The scene's light for the display's, where an OOTF lies between them; else the light as it is.
    #[must_use]
    pub(crate) fn before_ootf(&self, light: Triple) -> Triple {
        match self.ootf_gamma() {
            Some(gamma) => {
                let light = light.map(|v| between(v, LARGEST));
                let luminance = self.luminance(light);
                light.map(|v| if luminance > 0.0 { v * luminance.powf((1.0 - gamma) / gamma) } else { 0.0 })
            }
            None => light,
        }
    }

    /// XYZ in cd/m² of three code values.
    ///
    /// ```
    /// use illuminant_color::{RgbSystem, Transfer};
    /// use illuminant_display::{Display, Response};
    /// let response = || Response::Transfer(Transfer::Srgb);
    /// let system = RgbSystem::named("sRGB").unwrap();
    /// let display = Display::new(system, [response(), response(), response()], 80.0, 0.2)?;
    /// assert!((display.to_xyz([1.0; 3])[1] - 80.0).abs() < 1e-9);
    /// assert!((display.to_xyz([0.0; 3])[1] - 0.2).abs() < 1e-12);
    /// # Ok::<(), illuminant_display::DisplayError>(())
    /// ```
    #[must_use]
    pub fn to_xyz(&self, code: Triple) -> Triple {
        let white = self.system.to_xyz([1.0; 3]);
        let light = self.system.to_xyz(self.decode(code));
        std::array::from_fn(|i| (self.peak - self.black) * light[i] + self.black * white[i])
    }

    /// The light of each channel that shows an XYZ in cd/m²; outside 0 to 1 the colour is outside the gamut.
    #[must_use]
    pub fn from_xyz(&self, xyz: Triple) -> Triple {
        self.system.from_xyz(xyz).map(|v| (v - self.black) / (self.peak - self.black))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use illuminant_color::Transfer;

    fn display(name: &str, response: Response, peak: f64, black: f64) -> Display {
        let system = RgbSystem::named(name).unwrap();
        Display::new(system, [response.clone(), response.clone(), response], peak, black).unwrap()
    }

    #[test]
    fn codes_come_back_from_light() {
        for display in [
            display("sRGB", Response::Transfer(Transfer::Srgb), 80.0, 0.5),
            display("Rec.709", Response::Bt1886 { black: 1e-3 }, 100.0, 0.1),
            display("Rec.2020", Response::Pq { peak: 1000.0 }, 1000.0, 0.0),
            display("Rec.2020", Response::Hlg, 1000.0, 0.0),
        ] {
            for code in [[0.0; 3], [0.7; 3], [0.2, 0.5, 0.6], [0.0, 0.3, 0.1]] {
                let back = display.encode(display.from_xyz(display.to_xyz(code)));
                for (a, b) in back.into_iter().zip(code) {
                    assert!((a - b).abs() < 1e-6, "{display:?}: {code:?} becomes {back:?}");
                }
            }
        }
    }

    #[test]
    fn hybrid_log_gamma_has_its_reference_white() {
        // BT.2408: HLG code 0.75 is 203 cd/m² on a display of 1,000.
        let hlg = display("Rec.2020", Response::Hlg, 1000.0, 0.0);
        assert!((hlg.to_xyz([0.75; 3])[1] - 203.0).abs() < 1.0);
    }

    #[test]
    fn responses_that_share_their_channels_are_not_mixed_and_have_no_black() {
        let system = || RgbSystem::named("Rec.2020").unwrap();
        let other = Response::Transfer(Transfer::Srgb);
        let mixed = [Response::Hlg, other.clone(), other];
        assert_eq!(Display::new(system(), mixed, 1000.0, 0.0), Err(DisplayError::Mixed));
        let pq = || Response::Pq { peak: 1000.0 };
        assert_eq!(Display::new(system(), [pq(), pq(), pq()], 1000.0, 0.5), Err(DisplayError::Black(0.5)));
    }

    #[test]
    fn hybrid_log_gamma_rises_at_any_peak() {
        for peak in [1.0, 50.0, 399.0, 401.0, 4000.0] {
            let hlg = display("Rec.2020", Response::Hlg, peak, 0.0);
            let y: Vec<f64> = (0..=20).map(|i| hlg.to_xyz([f64::from(i) / 20.0; 3])[1]).collect();
            assert!(y.windows(2).all(|pair| pair[0] < pair[1]), "{peak}: {y:?}");
            assert!((y[20] - peak).abs() < 1e-3 * peak);
        }
    }

    #[test]
    fn what_is_no_display_is_refused() {
        let system = RgbSystem::named("sRGB").unwrap();
        let falling = Response::Table(vec![0.0, 0.6, 0.5, 1.0]);
        let good = Response::Transfer(Transfer::Linear);
        let channels = [good.clone(), falling, good.clone()];
        assert_eq!(Display::new(system.clone(), channels, 80.0, 0.0), Err(DisplayError::Response("green")));
        let channels = [good.clone(), good.clone(), good];
        assert!(matches!(Display::new(system, channels, 1.0, 1.0), Err(DisplayError::Range { .. })));
    }
}
