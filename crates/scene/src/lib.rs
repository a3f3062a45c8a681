//! What is in front of the camera: shapes and where they stand, materials, lamps, the camera, and ray queries.

mod camera;
mod coefficients;
pub mod description;
pub mod embree;
mod environment;
mod geometry;
mod lamp;
mod lamp_chooser;
mod light_tree;
mod medium;
mod motion;
mod photometry;
mod scene;
mod shape;
pub mod skin;
mod surface;
mod surface_lamp;
pub mod texture;
mod ties;

pub use camera::{Camera, CameraError, Lens};
pub use environment::EnvironmentImage;
pub use geometry::{Geometry, GeometryError};
pub use lamp::{Lamp, LampForm, LampSample};
pub use lamp_chooser::{LampChooser, chooser};
pub use light_tree::{Extent, LightTree};
pub use medium::{Density, Medium, Phase};
pub use motion::Motion;
pub use photometry::{Quantity, Source, absolute_spectrum};
pub use scene::{ImageData, Object, Scene, SceneError};
pub use shape::{Mesh, Placement, Shape};
pub use skin::{ColourTexture, ReliefTexture, Skin, SlopeTexture, TexturePoint};
pub use surface::{Hit, Ray, SurfacePoint, along_texture};
pub use surface_lamp::SurfaceLamp;
pub use texture::{Footprint, Texture, Wrap};
