//! How an image is made: techniques, and what they share (random numbers, reconstruction filter, film, render loop).

mod carried;
mod cone_tracing;
mod direct_light;
mod film;
mod filter;
mod frustum;
mod haze;
mod interaction;
mod lanes;
mod light_tracing;
mod media;
pub mod pairs;
mod part;
mod participating;
mod passes;
mod path;
mod radiosity;
mod ray_tree;
mod render;
mod sampler;
mod scanline;
mod scene_products;
mod sequence;
mod settings;
mod skins;
mod warnings;
mod wavelength;

pub use film::{Film, LayerPlan, TOO_LARGE, TileFilm, fixed};
pub use filter::{Filter, FilterSampler};
pub use part::{Part, PartError};
pub use passes::Replay;
pub use path::{Counts, PathTracer, Probe, Query, Recorder, Vertex};
pub use radiosity::{
    Gather, Given, Mechanisms, RadiosityParts, RadiosityReport, RadiositySettings, RadiositySolution,
    RowFinder,
};
pub use render::{Dropped, Progress, Render, RenderError, Share, Statistics, pool};
pub use sampler::Sampler;
pub use scanline::edges;
pub use scene_products::{basis, reflectances, spectral_error};
pub use sequence::Sequence;
pub use settings::{
    Antialiasing, Infinite, Interpolation, Layer, LightCentres, Settings, Shading, Shadows, Technique,
};
