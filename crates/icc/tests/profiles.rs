//! Profiles written and read: by ourselves, and by another library that shares no code with this one.

use illuminant_icc::{Curve, D50, IccError, ProfileDescription, Version, decode, encode};
use moxcms::{ColorProfile, ProfileText, ToneReprCurve};
use proptest::prelude::*;

const SRGB: [[f64; 2]; 3] = [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06]];
const D65: [f64; 2] = [0.3127, 0.329];

fn display() -> ProfileDescription {
    ProfileDescription {
        description: "A monitor – für Büros".into(),
        copyright: "No copyright, use freely".into(),
        version: Version::Four,
        primaries: SRGB,
        white: D65,
        curves: [Curve::srgb(), Curve::srgb(), Curve::srgb()],
        luminance: Some(103.0),
        cicp: None,
    }
}

/// Displays that differ in everything a profile can hold.
fn displays() -> Vec<ProfileDescription> {
    let cube = Curve::Table((0..1024).map(|i| (f64::from(i) / 1023.0).powi(3)).collect());
    let ntsc = [[0.67, 0.33], [0.21, 0.71], [0.14, 0.08]];
    let rec2020 = [[0.708, 0.292], [0.17, 0.797], [0.131, 0.046]];
    let mut found = Vec::new();
    for version in [Version::Two, Version::Four] {
        found.push(ProfileDescription { version, ..display() });
        found.push(ProfileDescription {
            version,
            description: "NTSC".into(),
            primaries: ntsc,
            white: [0.3101, 0.3162],
            curves: [Curve::Gamma(2.2), Curve::Gamma(2.5), cube.clone()],
            luminance: None,
            ..display()
        });
        found.push(ProfileDescription {
            version,
            description: "wide".into(),
            primaries: rec2020,
            curves: [Curve::Gamma(1.0), Curve::rec709(), Curve::rec709()],
            luminance: Some(1000.0),
            cicp: (version == Version::Four).then_some([9, 16, 0, 1]),
            ..display()
        });
    }
    found
}

fn assert_near(a: &[f64], b: &[f64], tolerance: f64) {
    assert_eq!(a.len(), b.len());
    assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance), "{a:?} {b:?}");
}

#[test]
fn a_display_comes_back_from_its_profile() {
    for written in displays() {
        let read = decode(&encode(&written).unwrap()).unwrap();
        assert_near(read.primaries.as_flattened(), written.primaries.as_flattened(), 1e-4);
        assert_near(&read.white, &written.white, 5e-5);
        for (a, b) in read.curves.iter().zip(&written.curves) {
            assert_near(&a.samples(1000), &b.samples(1000), 1e-4);
        }
        assert_eq!(read.description, written.description);
        assert_eq!(read.copyright, written.copyright);
        assert_eq!((read.version, read.cicp), (written.version, written.cicp));
        assert_eq!(read.luminance, written.luminance);
    }
}

#[test]
fn a_second_reading_changes_nothing() {
    for written in displays() {
        let once = decode(&encode(&written).unwrap()).unwrap();
        let twice = decode(&encode(&once).unwrap()).unwrap();
        assert_near(twice.primaries.as_flattened(), once.primaries.as_flattened(), 1e-4);
        assert_eq!(twice.description, once.description);
    }
}

#[test]
fn the_same_display_gives_the_same_bytes_with_an_identity_of_its_own() {
    let one = encode(&display()).unwrap();
    assert_eq!(one, encode(&display()).unwrap());
    let other = encode(&ProfileDescription { luminance: Some(104.0), ..display() }).unwrap();
    assert_ne!(one[84..100], [0; 16]);
    assert_ne!(one[84..100], other[84..100]);
    let old = encode(&ProfileDescription { version: Version::Two, ..display() }).unwrap();
    assert_eq!(old[84..100], [0; 16]);
    assert_eq!(one[24..36], old[24..36]);
}

#[test]
fn the_frame_keeps_to_the_standard() {
    for written in displays() {
        let bytes = encode(&written).unwrap();
        let word = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((word(0), word(0) % 4), (bytes.len(), 0));
        assert_eq!(&bytes[36..40], b"acsp");
        let mut names = Vec::new();
        for tag in 0..word(128) {
            let entry = 132 + 12 * tag;
            names.push(bytes[entry..entry + 4].to_vec());
            let (start, size) = (word(entry + 4), word(entry + 8));
            assert_eq!(start % 4, 0);
            assert!(start >= 132 + 12 * word(128) && start + size <= bytes.len());
            let kind = &bytes[start..start + 4];
            let old: &[&[u8]] = &[b"desc", b"text", b"XYZ ", b"sf32", b"curv"];
            assert!(written.version == Version::Four || old.contains(&kind), "{}", kind.escape_ascii());
        }
        let sorted: std::collections::BTreeSet<_> = names.iter().collect();
        assert_eq!(sorted.len(), names.len());
    }
}

#[test]
fn the_primaries_add_to_d50_to_the_last_bit() {
    for written in displays() {
        let profile = ColorProfile::new_from_slice(&encode(&written).unwrap()).unwrap();
        let [red, green, blue] = [profile.red_colorant, profile.green_colorant, profile.blue_colorant];
        let sum = [red.x + green.x + blue.x, red.y + green.y + blue.y, red.z + green.z + blue.z];
        assert_eq!(sum, D50);
    }
}

#[test]
fn another_library_reads_what_was_written() {
    let profile = ColorProfile::new_from_slice(&encode(&display()).unwrap()).unwrap();
    // Colorants of sRGB as IEC 61966-2-1 Amd 1 and every sRGB profile have them.
    let expected = [[0.4361, 0.2225, 0.0139], [0.3851, 0.7169, 0.0971], [0.1431, 0.0606, 0.7141]];
    let found = [profile.red_colorant, profile.green_colorant, profile.blue_colorant];
    for (xyz, expected) in found.iter().zip(expected) {
        assert_near(&[xyz.x, xyz.y, xyz.z], &expected, 2e-4);
    }
    let Some(ProfileText::Localizable(texts)) = &profile.description else { panic!("no description") };
    assert_eq!(texts[0].value, "A monitor – für Büros");
    assert_eq!(profile.luminance.unwrap().y, 103.0);
    assert_eq!(profile.media_white_point.map(|w| [w.x, w.y, w.z]), Some(D50));
    let adaptation = profile.chromatic_adaptation.unwrap().v;
    assert_near(adaptation.as_flattened()[..3].as_ref(), &[1.047_886, 0.022_919, -0.050_216], 2e-4);
    assert!(
        matches!(profile.red_trc, Some(ToneReprCurve::Parametric(ref p)) if p.len() == 5 && (p[0] - 2.4).abs() < 1e-5)
    );
    let wide = ColorProfile::new_from_slice(&encode(&displays()[5]).unwrap()).unwrap();
    let code_points = wide.cicp.unwrap();
    assert_eq!((code_points.color_primaries as u8, code_points.transfer_characteristics as u8), (9, 16));
}

#[test]
fn profiles_of_another_library_are_read() {
    let cases = [
        (ColorProfile::new_display_p3(), [[0.68, 0.32], [0.265, 0.69], [0.15, 0.06]]),
        (ColorProfile::new_adobe_rgb(), [[0.64, 0.33], [0.21, 0.71], [0.15, 0.06]]),
    ];
    for (mut profile, primaries) in cases {
        // That library writes the cone matrix into `chad`, where the adaptation belongs; without it, `wtpt` counts.
        profile.chromatic_adaptation = None;
        profile.media_white_point = Some(moxcms::Xyzd::new(0.950_456, 1.0, 1.089_058));
        let read = decode(&profile.encode().unwrap()).unwrap();
        assert_near(read.primaries.as_flattened(), primaries.as_flattened(), 1e-3);
        assert_near(&read.white, &D65, 1e-3);
    }
}

#[test]
fn without_an_adaptation_white_is_d50() {
    let mut profile = ColorProfile::new_pro_photo_rgb();
    profile.chromatic_adaptation = None;
    profile.media_white_point = None;
    let read = decode(&profile.encode().unwrap()).unwrap();
    assert_near(&read.white, &[0.3457, 0.3585], 2e-4);
    assert_near(&read.primaries[0], &[0.7347, 0.2653], 1e-3);
}

#[test]
fn what_is_no_display_is_refused_with_its_reason() {
    let good = encode(&display()).unwrap();
    let changed = |at: usize, with: &[u8]| {
        let mut bytes = good.clone();
        bytes[at..at + with.len()].copy_from_slice(with);
        decode(&bytes).unwrap_err()
    };
    assert!(matches!(decode(b""), Err(IccError::NotAProfile(_))));
    assert!(matches!(decode(&[0; 4000]), Err(IccError::NotAProfile(_))));
    assert!(decode(&good[..500]).unwrap_err().to_string().contains("ends after 500 of"));
    assert!(changed(16, b"CMYK").to_string().contains("for CMYK colours"));
    assert!(changed(16, b"GRAY").to_string().contains("for GRAY colours"));
    assert!(changed(12, b"link").to_string().contains("class link"));
    assert!(changed(8, &[5]).to_string().contains("version 5"));
    assert!(changed(128, &[0xff; 4]).to_string().contains("4294967295 tags"));
    let entry =
        |name: &[u8]| 132 + 12 * (0..20).position(|i| &good[132 + 12 * i..136 + 12 * i] == name).unwrap();
    assert!(changed(entry(b"gXYZ") + 4, &[0xff; 8]).to_string().contains("tag gXYZ goes beyond its end"));
    assert!(changed(entry(b"bTRC"), b"what").to_string().contains("no tag bTRC"));
    assert!(changed(entry(b"rXYZ"), b"A2B0").to_string().contains("only a lookup table"));
    let place =
        |name: &[u8]| u32::from_be_bytes(good[entry(name) + 4..entry(name) + 8].try_into().unwrap()) as usize;
    assert!(changed(place(b"chad") + 8, &[0; 36]).to_string().contains("chad cannot be undone"));
    assert!(changed(place(b"rXYZ") + 8, &[0; 12]).to_string().contains("make no white, or lie on one line"));
    assert!(changed(place(b"rTRC"), b"blob").to_string().contains("neither of the type curv nor"));
}

#[test]
fn what_cannot_be_written_is_refused_with_its_reason() {
    let refused = |display: ProfileDescription| encode(&display).unwrap_err().to_string();
    assert!(refused(ProfileDescription { description: " ".into(), ..display() }).contains("description"));
    assert!(refused(ProfileDescription { luminance: Some(f64::NAN), ..display() }).contains("luminance"));
    assert!(refused(ProfileDescription { luminance: Some(1e6), ..display() }).contains("luminance"));
    assert!(refused(ProfileDescription { white: [0.3, 0.0], ..display() }).contains("white"));
    assert!(refused(ProfileDescription { white: [0.9, 0.05], ..display() }).contains("no white"));
    let line = [[0.1, 0.1], [0.2, 0.2], [0.3, 0.3]];
    assert!(refused(ProfileDescription { primaries: line, ..display() }).contains("one line"));
    let lost = [[f64::NAN, 0.1], [0.2, 0.2], [0.3, 0.3]];
    assert!(refused(ProfileDescription { primaries: lost, ..display() }).contains("chromaticity"));
}

#[test]
fn a_profile_cut_anywhere_is_refused() {
    for written in displays() {
        let whole = encode(&written).unwrap();
        let ends = (0..1500).chain((1500..whole.len()).step_by(97));
        for end in ends.filter(|end| *end < whole.len()) {
            assert!(decode(&whole[..end]).is_err(), "cut after {end}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn damage_never_panics(places in proptest::collection::vec((0_usize..1000, any::<u8>()), 1..12)) {
        let mut bytes = encode(&display()).unwrap();
        for (at, with) in places {
            let at = at % bytes.len();
            bytes[at] = with;
        }
        if let Ok(found) = decode(&bytes) {
            let numbers = found.primaries.iter().flatten().chain(&found.white);
            prop_assert!(numbers.clone().all(|v| v.is_finite()));
            prop_assert!(found.curves.iter().all(|c| c.samples(50).iter().all(|v| (0.0..=1.0).contains(v))));
        }
    }

    #[test]
    fn bytes_of_any_kind_never_panic(mut bytes in proptest::collection::vec(any::<u8>(), 0..600)) {
        let _ = decode(&bytes);
        if bytes.len() > 132 {
            bytes[36..40].copy_from_slice(b"acsp");
            bytes[8] = 4;
            bytes[0..4].fill(0);
            bytes[12..24].copy_from_slice(b"mntrRGB XYZ ");
            bytes[128..131].fill(0);
            let _ = decode(&bytes);
        }
    }

    #[test]
    fn any_display_comes_back(
        red in (0.55_f64..0.72, 0.28_f64..0.35),
        green in (0.15_f64..0.33, 0.55_f64..0.8),
        blue in (0.12_f64..0.17, 0.03_f64..0.1),
        white in (0.28_f64..0.45, 0.29_f64..0.41),
        gamma in 1.0_f64..3.0,
    ) {
        let written = ProfileDescription {
            primaries: [[red.0, red.1], [green.0, green.1], [blue.0, blue.1]],
            white: [white.0, white.1],
            curves: [Curve::Gamma(gamma), Curve::Gamma(gamma), Curve::Gamma(gamma)],
            ..display()
        };
        let inside = illuminant_color::RgbSystem::new("", written.primaries, written.white, illuminant_color::Transfer::Linear)
            .is_some_and(|s| s.to_xyz_rows()[1].iter().all(|y| *y > 0.03));
        prop_assume!(inside);
        let read = decode(&encode(&written).unwrap()).unwrap();
        for (a, b) in read.primaries.as_flattened().iter().zip(written.primaries.as_flattened()) {
            prop_assert!((a - b).abs() < 3e-4, "{a} {b}");
        }
        prop_assert!((read.white[0] - white.0).abs() < 1e-4 && (read.white[1] - white.1).abs() < 1e-4);
    }
}
