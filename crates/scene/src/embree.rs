//! Embree 4, loaded at run time: the few functions needed, declared by hand (rtcore.h of Embree 4.4).

use libloading::Library;
use std::ffi::{CStr, CString, c_char, c_int, c_uint, c_void};
use std::path::Path;
use std::sync::OnceLock;
use thiserror::Error;

/// Why there are no ray queries.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum EmbreeError {
    /// [`load`] has not been called.
    #[error(
        "the Embree library has not been loaded; install the Python package embreex, or set ILLUMINANT_EMBREE"
    )]
    NotLoaded,
    /// The file cannot be opened as a library.
    #[error(
        "Embree cannot be loaded from {path}: {reason}; install the Python package embreex, or set ILLUMINANT_EMBREE to the path of libembree4"
    )]
    Load {
        /// The path that was tried.
        path: String,
        /// What the loader said.
        reason: String,
    },
    /// The library is not Embree 4.4 or newer within 4.
    #[error("{path} is Embree {version}; 4.4 or a later 4.x is needed: install the Python package embreex")]
    Version {
        /// The path.
        path: String,
        /// What it says it is.
        version: String,
    },
    /// Embree refused a call.
    #[error("Embree: {0}")]
    Device(String),
}

/// A ray as Embree lays it out.
#[repr(C, align(16))]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RtcRay {
    pub org: [f32; 3],
    pub tnear: f32,
    pub dir: [f32; 3],
    pub time: f32,
    pub tfar: f32,
    pub mask: u32,
    pub id: u32,
    pub flags: u32,
}

/// A hit as Embree lays it out; `inst_prim_id` exists since 4.4, and the record is padded to 48 bytes.
#[repr(C, align(16))]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RtcHit {
    pub ng: [f32; 3],
    pub u: f32,
    pub v: f32,
    pub prim_id: u32,
    pub geom_id: u32,
    pub inst_id: u32,
    pub inst_prim_id: u32,
}

#[repr(C, align(16))]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RtcRayHit {
    pub ray: RtcRay,
    pub hit: RtcHit,
}

#[repr(C)]
pub(crate) struct RtcRayQueryContext {
    pub inst_id: u32,
    pub inst_prim_id: u32,
}

#[repr(C)]
pub(crate) struct RtcFilterArguments {
    pub valid: *mut c_int,
    pub geometry_user_ptr: *mut c_void,
    pub context: *mut RtcRayQueryContext,
    pub ray: *mut RtcRay,
    pub hit: *mut RtcHit,
    pub n: c_uint,
}

pub(crate) type RtcFilter = unsafe extern "C" fn(*const RtcFilterArguments);

/// `RTCIntersectArguments` and `RTCOccludedArguments`, which have one layout.
#[repr(C)]
pub(crate) struct RtcArguments {
    pub flags: c_uint,
    pub feature_mask: c_uint,
    pub context: *mut RtcRayQueryContext,
    pub filter: Option<RtcFilter>,
    pub callback: *mut c_void,
    pub min_width_distance_factor: f32,
}

pub(crate) const INVALID: u32 = u32::MAX;
pub(crate) const TRIANGLE: c_int = 0;
pub(crate) const SPHERE_POINT: c_int = 50;
pub(crate) const INSTANCE: c_int = 121;
pub(crate) const BUFFER_INDEX: c_int = 0;
pub(crate) const BUFFER_VERTEX: c_int = 1;
pub(crate) const UINT3: c_int = 0x5003;
pub(crate) const FLOAT3: c_int = 0x9003;
pub(crate) const FLOAT4: c_int = 0x9004;
pub(crate) const FLOAT3X4_ROW_MAJOR: c_int = 0x9134;
pub(crate) const SCENE_ROBUST: c_int = 1 << 2;
pub(crate) const SCENE_FILTER_IN_ARGUMENTS: c_int = 1 << 3;
pub(crate) const QUERY_INVOKE_FILTER: c_uint = 1 << 1;
pub(crate) const FEATURES_ALL: c_uint = u32::MAX;
pub(crate) const QUALITY_HIGH: c_int = 2;

type Handle = *mut c_void;

macro_rules! functions {
    ($($field:ident $symbol:literal : fn($($arg:ty),*) $(-> $ret:ty)?;)*) => {
        /// The functions of the loaded library.
        pub(crate) struct Api {
            $(pub $field: unsafe extern "C" fn($($arg),*) $(-> $ret)?,)*
            /// Kept so that the functions stay mapped.
            _library: Library,
        }

        impl Api {
            fn from(library: Library) -> Result<Self, libloading::Error> {
                Ok(Self {
                    // SAFETY: the signatures are those of rtcore.h.
                    $($field: unsafe { *library.get($symbol.as_bytes())? },)*
                    _library: library,
                })
            }
        }
    };
}

functions! {
    new_device "rtcNewDevice\0": fn(*const c_char) -> Handle;
    release_device "rtcReleaseDevice\0": fn(Handle);
    device_error "rtcGetDeviceError\0": fn(Handle) -> c_int;
    device_message "rtcGetDeviceLastErrorMessage\0": fn(Handle) -> *const c_char;
    device_property "rtcGetDeviceProperty\0": fn(Handle, c_int) -> isize;
    new_scene "rtcNewScene\0": fn(Handle) -> Handle;
    release_scene "rtcReleaseScene\0": fn(Handle);
    set_scene_flags "rtcSetSceneFlags\0": fn(Handle, c_int);
    set_scene_quality "rtcSetSceneBuildQuality\0": fn(Handle, c_int);
    commit_scene "rtcCommitScene\0": fn(Handle);
    new_geometry "rtcNewGeometry\0": fn(Handle, c_int) -> Handle;
    release_geometry "rtcReleaseGeometry\0": fn(Handle);
    commit_geometry "rtcCommitGeometry\0": fn(Handle);
    set_time_steps "rtcSetGeometryTimeStepCount\0": fn(Handle, c_uint);
    set_buffer "rtcSetSharedGeometryBuffer\0": fn(Handle, c_int, c_uint, c_int, *const c_void, usize, usize, usize);
    set_instanced "rtcSetGeometryInstancedScene\0": fn(Handle, Handle);
    set_transform "rtcSetGeometryTransform\0": fn(Handle, c_uint, c_int, *const c_void);
    attach "rtcAttachGeometryByID\0": fn(Handle, Handle, c_uint);
    intersect1 "rtcIntersect1\0": fn(Handle, *mut RtcRayHit, *mut RtcArguments);
    occluded1 "rtcOccluded1\0": fn(Handle, *mut RtcRay, *mut RtcArguments);
}

static API: OnceLock<Api> = OnceLock::new();

/// Loads the library at `path`, once; later calls return the version of the one already loaded.
///
/// # Errors
/// [`EmbreeError`] when the file is no Embree 4.4 or later 4.x.
pub fn load(path: &Path) -> Result<String, EmbreeError> {
    if let Some(api) = API.get() {
        return Ok(version(api));
    }
    let shown = path.display().to_string();
    let failed =
        |reason: libloading::Error| EmbreeError::Load { path: shown.clone(), reason: reason.to_string() };
    // SAFETY: Embree's initialisers have no preconditions.
    let library = unsafe { Library::new(path) }.map_err(failed)?;
    let api = Api::from(library).map_err(failed)?;
    let version = self::version(&api);
    let mut parts = version.split('.').map(|part| part.parse::<u32>().unwrap_or(0));
    if !matches!((parts.next(), parts.next()), (Some(4), Some(minor)) if minor >= 4) {
        return Err(EmbreeError::Version { path: shown, version });
    }
    let _ = API.set(api);
    Ok(version)
}

/// Loads the library that the environment variable `ILLUMINANT_EMBREE` names; for tests and benches of the core.
///
/// # Errors
/// [`EmbreeError`] when the variable is not set or its library is not the right one.
pub fn load_from_environment() -> Result<String, EmbreeError> {
    let path = std::env::var_os("ILLUMINANT_EMBREE").ok_or(EmbreeError::NotLoaded)?;
    load(Path::new(&path))
}

fn version(api: &Api) -> String {
    // SAFETY: a device with default settings, released at once; property 0 is RTC_DEVICE_PROPERTY_VERSION.
    let number = unsafe {
        let device = (api.new_device)(c"threads=1".as_ptr());
        let number = (api.device_property)(device, 0);
        (api.release_device)(device);
        number
    };
    format!("{}.{}.{}", number / 10_000, number / 100 % 100, number % 100)
}

pub(crate) fn api() -> Result<&'static Api, EmbreeError> {
    API.get().ok_or(EmbreeError::NotLoaded)
}

/// An Embree device.
pub(crate) struct Device {
    pub handle: Handle,
    pub api: &'static Api,
}

// SAFETY: Embree's devices and scenes may be used from any thread once committed (rtcore.h, thread safety).
unsafe impl Send for Device {}
// SAFETY: as above.
unsafe impl Sync for Device {}

/// The most threads that anybody may ask for: as many are started as are asked for.
pub const MOST_THREADS: usize = 4096;

/// The code that Embree takes. Left to itself it takes the newest instruction set there is, and another width of vectors is
/// another tree with other roundings; so it is held to the one that the core itself is built for.
const INSTRUCTION_SET: &str = if cfg!(target_arch = "x86_64") { ",isa=avx2" } else { "" };

impl Device {
    /// A device that builds with so many threads, [`MOST_THREADS`] at most; 0 is one for each core.
    pub fn new(threads: usize) -> Result<Self, EmbreeError> {
        let api = api()?;
        let threads = threads.min(MOST_THREADS);
        let config = CString::new(format!("threads={threads}{INSTRUCTION_SET}")).unwrap_or_default();
        // SAFETY: the string lives through the call.
        let handle = unsafe { (api.new_device)(config.as_ptr()) };
        let device = Self { handle, api };
        if handle.is_null() {
            return Err(EmbreeError::Device("no device could be made".into()));
        }
        Ok(device)
    }

    /// The error of the calls since the last look, if any.
    pub fn check(&self) -> Result<(), EmbreeError> {
        // SAFETY: the device is alive; the message is a C string owned by it.
        unsafe {
            if (self.api.device_error)(self.handle) == 0 {
                return Ok(());
            }
            let message = (self.api.device_message)(self.handle);
            let text = if message.is_null() {
                "unknown error".into()
            } else {
                CStr::from_ptr(message).to_string_lossy()
            };
            Err(EmbreeError::Device(text.into_owned()))
        }
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        // SAFETY: made by rtcNewDevice, released once.
        unsafe { (self.api.release_device)(self.handle) }
    }
}
