//! Elementary functions that give the same bits on every machine.
//!
//! The standard library computes sin, exp, pow and their like by the C library of the machine, whose last bits differ from
//! version to version and, by way of FMA, from processor to processor. This crate defines those functions under their C
//! names, so that a program or library that is linked with it takes these and not those of the C library: no call has to
//! be written differently, and those of dependencies are served too. A crate asks for it by
//! `extern crate illuminant_elementary as _;`.
//!
//! All are correctly rounded (by the crate `pxfm`), in f64 and f32: the number nearest to the exact value is one and the same
//! wherever it is found, whether by way of FMA or not.
//!
//! Square roots, fused products, remainders and roundings to whole numbers are exact by IEEE 754 wherever they come from, and
//! stay. A shared library must be linked with `-Bsymbolic-functions`, or the program that loads it would put its own in their place.
//!
//! # Examples
//! ```
//! extern crate illuminant_elementary as _;
//! assert_eq!(1.0f64.exp().to_bits(), 0x4005_bf0a_8b14_5769); // e, to its last bit
//! ```

/// Functions of one number.
macro_rules! of_one {
    ($real:ty: $($symbol:ident = $function:path;)*) => {
        $(
            #[unsafe(no_mangle)]
            extern "C" fn $symbol(x: $real) -> $real {
                $function(x)
            }
        )*
    };
}

/// Functions of two numbers.
macro_rules! of_two {
    ($real:ty: $($symbol:ident = $function:path;)*) => {
        $(
            #[unsafe(no_mangle)]
            extern "C" fn $symbol(x: $real, y: $real) -> $real {
                $function(x, y)
            }
        )*
    };
}

of_one! { f64:
    sin = pxfm::f_sin;
    cos = pxfm::f_cos;
    tan = pxfm::f_tan;
    asin = pxfm::f_asin;
    acos = pxfm::f_acos;
    atan = pxfm::f_atan;
    sinh = pxfm::f_sinh;
    cosh = pxfm::f_cosh;
    tanh = pxfm::f_tanh;
    asinh = pxfm::f_asinh;
    acosh = pxfm::f_acosh;
    atanh = pxfm::f_atanh;
    exp = pxfm::f_exp;
    exp2 = pxfm::f_exp2;
    expm1 = pxfm::f_expm1;
    log = pxfm::f_log;
    log2 = pxfm::f_log2;
    log10 = pxfm::f_log10;
    log1p = pxfm::f_log1p;
    cbrt = pxfm::f_cbrt;
}

of_two! { f64:
    atan2 = pxfm::f_atan2;
    pow = pxfm::f_pow;
    hypot = pxfm::f_hypot;
}

of_one! { f32:
    sinf = pxfm::f_sinf;
    cosf = pxfm::f_cosf;
    tanf = pxfm::f_tanf;
    asinf = pxfm::f_asinf;
    acosf = pxfm::f_acosf;
    atanf = pxfm::f_atanf;
    sinhf = pxfm::f_sinhf;
    coshf = pxfm::f_coshf;
    tanhf = pxfm::f_tanhf;
    expf = pxfm::f_expf;
    exp2f = pxfm::f_exp2f;
    expm1f = pxfm::f_expm1f;
    logf = pxfm::f_logf;
    log2f = pxfm::f_log2f;
    log10f = pxfm::f_log10f;
    log1pf = pxfm::f_log1pf;
    cbrtf = pxfm::f_cbrtf;
}

of_two! { f32:
    atan2f = pxfm::f_atan2f;
    powf = pxfm::f_powf;
    hypotf = pxfm::f_hypotf;
}

/// Sine and cosine, which the compiler asks for together where code needs both of an angle.
///
/// # Safety
/// Both pointers must be valid for writes.
#[unsafe(no_mangle)]
unsafe extern "C" fn sincos(x: f64, sine: *mut f64, cosine: *mut f64) {
    let (s, c) = pxfm::f_sincos(x);
    // SAFETY: the caller's promise, which is that of the C library's function.
    unsafe {
        *sine = s;
        *cosine = c;
    }
}

/// As [`sincos`].
///
/// # Safety
/// Both pointers must be valid for writes.
#[unsafe(no_mangle)]
unsafe extern "C" fn sincosf(x: f32, sine: *mut f32, cosine: *mut f32) {
    let (s, c) = pxfm::f_sincosf(x);
    // SAFETY: the caller's promise, which is that of the C library's function.
    unsafe {
        *sine = s;
        *cosine = c;
    }
}
