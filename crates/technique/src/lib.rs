//! How an image is made: techniques, and what they share (random numbers, reconstruction filter, film, render loop).

mod film;
mod filter;
mod lanes;
mod media;
mod path;
mod render;
mod sequence;
mod settings;

pub use film::{Film, LayerPlan, TOO_LARGE, TileFilm, fixed};
pub use filter::{Filter, FilterSampler};
pub use path::{Counts, PathTracer, Probe, Query, Recorder, Vertex};
pub use render::{Dropped, Progress, Render, RenderError, Replay, Statistics};
pub use sequence::Sequence;
pub use settings::{Layer, Settings, Technique};
