//! Code values of light by a table, for whole images.
//!
//! The table has 512 places in each octave from 2⁻⁴⁰ to 1, found by the bits of a 32-bit float, and is linear between
//! them; below, it is linear down to 0. For the responses of displays its largest error above 2⁻⁴⁰ is 10⁻⁶ (a
//! fifteenth of a 16-bit step), which the tests hold it to.

use crate::Response;

const OCTAVES: u32 = 40;
const PLACES_LOG2: u32 = 9;
const SHIFT: u32 = 23 - PLACES_LOG2;
const LOWEST: f32 = 1.0 / (1u64 << OCTAVES) as f32;

/// Code values of one channel of a display, for light from 0 to 1.
#[derive(Clone, Debug)]
pub struct EncodingTable {
    values: Vec<f32>,
    black: f32,
}

impl EncodingTable {
    /// The table of a response.
    #[must_use]
    pub fn new(response: &Response) -> Self {
        let places = (OCTAVES << PLACES_LOG2) + 2;
        let place = |i: u32| f32::from_bits(LOWEST.to_bits() + (i << SHIFT));
        let values = (0..places).map(|i| response.encode(f64::from(place(i)).min(1.0)) as f32).collect();
        Self { values, black: response.encode(0.0) as f32 }
    }

    /// The code value of a light from 0 to 1; what lies outside, and NaN, is taken to the nearer end, NaN to 0.
    ///
    /// ```
    /// use illuminant_color::Transfer;
    /// use illuminant_display::{EncodingTable, Response};
    /// let table = EncodingTable::new(&Response::Transfer(Transfer::Gamma(2.0)));
    /// assert!((table.encode(0.25) - 0.5).abs() < 1e-6);
    /// assert_eq!(table.encode(7.0), 1.0);
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn encode(&self, light: f32) -> f32 {
        // As comparisons, these take NaN to the lower end.
        let above = if light > LOWEST { light } else { LOWEST };
        let clamped = if above < 1.0 { above } else { 1.0 };
        let bits = clamped.to_bits() - LOWEST.to_bits();
        let place = (bits >> SHIFT) as usize;
        let part = (bits & ((1 << SHIFT) - 1)) as f32 * (1.0 / (1u32 << SHIFT) as f32);
        let [low, high] = [self.values[place], self.values[place + 1]];
        if light >= LOWEST {
            (high - low).mul_add(part, low)
        } else {
            let below = light.max(0.0) * (1.0 / LOWEST);
            (low - self.black).mul_add(below, self.black)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use illuminant_color::Transfer;

    #[test]
    fn the_table_agrees_with_the_formula() {
        let responses = [
            Response::Transfer(Transfer::Srgb),
            Response::Transfer(Transfer::Rec709),
            Response::Transfer(Transfer::Gamma(2.2)),
            Response::Bt1886 { black: 0.001 },
            Response::Pq { peak: 1000.0 },
            Response::Hlg,
        ];
        for response in responses {
            let table = EncodingTable::new(&response);
            assert_eq!(table.encode(1.0), response.encode(1.0) as f32);
            for i in 0..200_000 {
                let light = (f64::from(i) / 200_000.0).powi(3) as f32;
                let error = (f64::from(table.encode(light)) - response.encode(f64::from(light))).abs();
                let allowed = if light < LOWEST { 3e-6 } else { 1e-6 };
                assert!(error < allowed, "{response:?} at {light}: {error}");
            }
        }
        let table = EncodingTable::new(&Response::Transfer(Transfer::Srgb));
        for (odd, code) in [(f32::NAN, 0.0), (-1.0, 0.0), (f32::INFINITY, 1.0), (1e-30, 0.0)] {
            assert!((table.encode(odd) - code).abs() < 1e-20, "{odd}");
        }
    }
}
