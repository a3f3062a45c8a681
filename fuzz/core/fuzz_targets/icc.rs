//! ICC profiles: what is read is finite, and can be written and read again.
#![no_main]

use illuminant_icc::{decode, encode};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Ok(found) = decode(data) else { return };
    assert!(found.primaries.iter().flatten().chain(&found.white).all(|v| v.is_finite()));
    if let Ok(bytes) = encode(&found) {
        decode(&bytes).expect("what was written is read");
    }
});
