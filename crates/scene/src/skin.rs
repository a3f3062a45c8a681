//! What images say of a material: its colour, how rough it is, and how its normal is perturbed.

use crate::ImageData;
use crate::description::{ImageMapData, MapData, ReliefTextureData, SkinData};
use crate::pattern::Pattern;
use crate::texture::{Footprint, Texture, slopes_of_heights};
use glam::{Vec2, Vec3};
use illuminant_illumination::{REPRESENTATIVE_NM, Surface};
use illuminant_spectrum::Curve;
use std::collections::HashMap;
use std::sync::Arc;

/// Where on a surface, as textures need it.
#[derive(Clone, Copy, Debug)]
pub struct TexturePoint {
    /// Texture coordinates.
    pub uv: Vec2,
    /// How the position grows with them, in the world: ∂p/∂u and ∂p/∂v.
    pub along: [Vec3; 2],
    /// The part of the texture that is seen.
    pub footprint: Footprint,
    /// Where it lies in space: of what moves, where it was as its motion began.
    pub solid: Vec3,
    /// The half axes of what is seen there, in the world.
    pub axes: [Vec3; 2],
}

impl TexturePoint {
    /// The point with what a cone of light sees of the texture: `width` is its diameter there, `direction` its axis, and
    /// `normal` the unit normal of the surface.
    #[must_use]
    pub fn new(uv: Vec2, along: [Vec3; 2], solid: Vec3, width: f32, direction: Vec3, normal: Vec3) -> Self {
        let cos = direction.dot(normal);
        // The ellipse in which the cone cuts the plane: as wide as the cone, and longer the flatter it comes.
        let across =
            direction.cross(normal).try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
        let length = 0.5 * width / cos.abs().max(1e-3);
        let axes = [across * (0.5 * width), across.cross(normal) * length];
        // Inverse of the metric of the surface in texture coordinates.
        let [pu, pv] = along;
        let (uu, vv, mixed) = (pu.length_squared(), pv.length_squared(), pu.dot(pv));
        let determinant = uu * vv - mixed * mixed;
        let in_texture = |axis: Vec3| {
            let (a, b) = (axis.dot(pu), axis.dot(pv));
            Vec2::new(vv * a - mixed * b, uu * b - mixed * a) / determinant
        };
        let sound = determinant > 0.0 && determinant.is_finite();
        let footprint = if sound { Footprint { axes: axes.map(in_texture) } } else { Footprint::default() };
        Self { uv, along, footprint, solid, axes }
    }
}

/// Where a texture's values come from.
#[derive(Clone, Debug)]
pub enum Map {
    /// An image on the surface.
    Image(Arc<Texture>),
    /// A function of space or of texture coordinates.
    Pattern(Pattern),
}

impl Map {
    /// The mean over what is seen about a point: three channels, of a pattern of value x these are 1 − x, x and 0.
    #[must_use]
    pub fn at(&self, point: &TexturePoint) -> [f32; 3] {
        match self {
            Self::Image(texture) => texture.lookup(point.uv, &point.footprint),
            Self::Pattern(pattern) => {
                let (place, axes) = place(pattern, point);
                let x = pattern.value(place, &axes);
                [1.0 - x, x, 0.0]
            }
        }
    }

    /// The smallest and the largest value of a channel.
    #[must_use]
    pub fn extent(&self, channel: usize) -> [f32; 2] {
        match self {
            Self::Image(texture) => texture.extent(channel),
            Self::Pattern(_) => [0.0, 1.0],
        }
    }
}

/// A point and what is seen there, as a pattern measures.
fn place(pattern: &Pattern, point: &TexturePoint) -> (Vec3, [Vec3; 2]) {
    if pattern.on_surface {
        (point.uv.extend(0.0), point.footprint.axes.map(|axis| axis.extend(0.0)))
    } else {
        (point.solid, point.axes)
    }
}

/// An image of colours: each is what three curves add up to, in the parts that the channels say.
///
/// Being linear, a filtered colour has the spectrum of the filtered surface.
#[derive(Clone, Debug)]
pub struct ColourTexture {
    /// The image.
    pub texture: Map,
    /// What one unit of each channel is: a fraction of light at each wavelength.
    pub basis: [Curve; 3],
    /// Where it shows finished paint: the index of the vehicle whose surface is seen with the pigment (Saunderson 1942).
    pub finished: Option<f64>,
}

/// An image of slopes m.
#[derive(Clone, Debug)]
pub struct SlopeTexture {
    /// The image.
    pub texture: Map,
    /// Which channel.
    pub channel: usize,
    /// The slopes of 0 and 1.
    pub slopes: [f64; 2],
}

impl SlopeTexture {
    /// The slope at a point.
    #[must_use]
    pub fn at(&self, point: &TexturePoint) -> f64 {
        let value = f64::from(self.texture.at(point)[self.channel]).clamp(0.0, 1.0);
        self.slopes[0] + value * (self.slopes[1] - self.slopes[0])
    }

    /// The smallest and the largest slope of the image.
    #[must_use]
    pub fn extent(&self) -> [f64; 2] {
        let [low, high] = self.slopes;
        let [a, b] =
            self.texture.extent(self.channel).map(|v| low + f64::from(v).clamp(0.0, 1.0) * (high - low));
        [a.min(b), a.max(b)]
    }
}

/// An image that perturbs normals (Blinn 1978): of the slopes of a relief too small to be made of facets.
#[derive(Clone, Debug)]
pub enum ReliefTexture {
    /// ∂h/∂u and ∂h/∂v of heights in metres, by [`crate::texture::slopes_of_heights`].
    Heights(Arc<Texture>, [f32; 2]),
    /// The slopes of the relief along the surface, in the direction in which u grows and across.
    Normals(Arc<Texture>, f32),
    /// The heights of a pattern: that of the value 1, in metres.
    Pattern(Pattern, f32),
}

impl ReliefTexture {
    /// The perturbed normal, unit length and on the same side; `normal` is that without perturbation.
    ///
    /// n' = n − ∂h/∂u ∇u − ∂h/∂v ∇v, with the gradients of the texture coordinates along the surface (Blinn 1978, free of the
    /// coordinates' own lengths).
    #[must_use]
    pub fn perturbed(&self, point: &TexturePoint, normal: Vec3) -> Vec3 {
        let [pu, pv] = point.along.map(|p| p - normal * p.dot(normal));
        let volume = pu.cross(pv).dot(normal);
        let solid = matches!(self, Self::Pattern(pattern, _) if !pattern.on_surface);
        if !(solid || volume.abs() > 1e-12 * (pu.length_squared() + pv.length_squared())) {
            return normal;
        }
        let moved = match self {
            Self::Heights(texture, repeat) => {
                let [hu, hv, _] = texture.lookup(point.uv, &point.footprint);
                let (gradient_u, gradient_v) = (pv.cross(normal) / volume, normal.cross(pu) / volume);
                normal - gradient_u * (hu * repeat[0]) - gradient_v * (hv * repeat[1])
            }
            Self::Normals(texture, strength) => {
                let [x, y, _] = texture.lookup(point.uv, &point.footprint);
                let t = pu.normalize();
                let b = normal.cross(t) * volume.signum();
                normal - (t * x + b * y) * *strength
            }
            Self::Pattern(pattern, height) => {
                let (place, axes) = place(pattern, point);
                let slope = pattern.gradient(place, &axes) * *height;
                if pattern.on_surface {
                    let (gradient_u, gradient_v) = (pv.cross(normal) / volume, normal.cross(pu) / volume);
                    normal - gradient_u * slope.x - gradient_v * slope.y
                } else {
                    normal - (slope - normal * slope.dot(normal))
                }
            }
        };
        moved.normalize_or(normal)
    }
}

/// What images say of a material.
#[derive(Clone, Debug, Default)]
pub struct Skin {
    /// The reflectance of a diffuser or a pigment, the transmittance of a filter.
    pub colour: Option<ColourTexture>,
    /// The slope of its relief.
    pub slope: Option<SlopeTexture>,
    /// How its normal is perturbed.
    pub relief: Option<ReliefTexture>,
}

impl Skin {
    /// Whether no image says anything.
    #[must_use]
    pub fn is_bare(&self) -> bool {
        self.colour.is_none() && self.slope.is_none() && self.relief.is_none()
    }
}

/// A pattern, if its numbers can be.
fn sound(pattern: &Pattern) -> Result<Pattern, String> {
    let axis = Vec3::from(pattern.axis);
    if !(pattern.scale > 0.0 && pattern.scale.is_finite() && pattern.amplitude.is_finite()) {
        return Err("a pattern has a scale above 0 and a finite amplitude".into());
    }
    if !(1..=16).contains(&pattern.octaves) {
        return Err("a pattern has 1 to 16 octaves".into());
    }
    if !((axis.length() - 1.0).abs() < 1e-3 && Vec3::from(pattern.origin).is_finite()) {
        return Err("a pattern has an axis of length 1 and a finite origin".into());
    }
    Ok(*pattern)
}

/// The images of a scene as textures, each pyramid built once.
#[derive(Default)]
pub(crate) struct Textures {
    known: HashMap<String, Arc<Texture>>,
}

impl Textures {
    /// What images say of a material, checked.
    ///
    /// # Errors
    /// A sentence on what is wrong.
    pub fn skin(
        &mut self,
        data: &SkinData,
        surface: &Surface,
        curves: &[Curve],
        images: &HashMap<String, ImageData>,
    ) -> Result<Skin, String> {
        let mut skin = Skin::default();
        if let Some(colour) = &data.colour {
            let has_colour = matches!(
                surface,
                Surface::Diffuse { .. }
                    | Surface::Filter { .. }
                    | Surface::Translucent { .. }
                    | Surface::Coated { .. }
            );
            if !has_colour {
                let those = "diffusers, filters, translucent sheets and coats";
                return Err(format!("only {those} take their colour from an image"));
            }
            let mut basis = Vec::with_capacity(3);
            for &index in &colour.basis {
                basis.push(curves.get(index).ok_or_else(|| format!("there is no curve {index}"))?.clone());
            }
            let finished = match surface {
                Surface::Coated { n, .. } if colour.finished => Some(n.at(REPRESENTATIVE_NM)),
                _ => None,
            };
            let texture = self.map(&colour.map, images)?;
            let basis = basis.try_into().map_err(|_| "a colour has three curves")?;
            skin.colour = Some(ColourTexture { texture, basis, finished });
        }
        if let Some(slope) = &data.slope {
            if matches!(
                surface,
                Surface::Diffuse { .. } | Surface::Filter { .. } | Surface::Translucent { .. }
            ) {
                return Err("a diffuser, a filter and a translucent sheet have no roughness".into());
            }
            if slope.channel > 2 || !slope.slopes.iter().all(|m| (0.0..=1.0).contains(m)) {
                return Err("an image of slopes has a channel 0, 1 or 2 and slopes between 0 and 1".into());
            }
            let texture = self.map(&slope.map, images)?;
            skin.slope = Some(SlopeTexture { texture, channel: slope.channel, slopes: slope.slopes });
        }
        skin.relief = match &data.relief {
            None => None,
            Some(ReliefTextureData::Heights { map: MapData::Pattern(pattern), height, .. }) => {
                Some(ReliefTexture::Pattern(sound(pattern)?, *height))
            }
            Some(ReliefTextureData::Heights { map: MapData::Image(map), channel, height }) => {
                if *channel > 2 || !height.is_finite() {
                    return Err("an image of heights has a channel 0, 1 or 2 and a finite height".into());
                }
                let key = format!("heights {channel} {height} {:?}", map.wrap);
                let texture = self.texture(map, &key, images, |size, image| {
                    let heights: Vec<[f32; 3]> =
                        image.iter().map(|p| [p[*channel] * height, 0.0, 0.0]).collect();
                    Ok(slopes_of_heights(size, &heights, map.wrap))
                })?;
                Some(ReliefTexture::Heights(texture, map.repeat))
            }
            Some(ReliefTextureData::Normals { map, strength }) => {
                if !strength.is_finite() {
                    return Err("the strength of a normal map must be finite".into());
                }
                let texture = self.texture(map, "normals", images, |(width, _), image| {
                    let slopes = |(i, p): (usize, &[f32; 3])| {
                        let [x, y, z] = p.map(|v| 2.0 * v - 1.0);
                        if z > 0.05 {
                            Ok([-x / z, -y / z, 0.0])
                        } else {
                            let (x, y) = (i % width, i / width);
                            Err(format!("pixel ({x}, {y}) of the normal map points into the surface"))
                        }
                    };
                    image.iter().enumerate().map(slopes).collect()
                })?;
                Some(ReliefTexture::Normals(texture, *strength))
            }
        };
        Ok(skin)
    }

    /// The values of an image or a pattern.
    fn map(&mut self, map: &MapData, images: &HashMap<String, ImageData>) -> Result<Map, String> {
        Ok(match map {
            MapData::Image(map) => Map::Image(self.texture(map, "", images, |_, image| Ok(image.to_vec()))?),
            MapData::Pattern(pattern) => Map::Pattern(sound(pattern)?),
        })
    }

    /// The texture that `make` makes of an image; `use_of` tells apart what is made of the same image.
    fn texture(
        &mut self,
        map: &ImageMapData,
        use_of: &str,
        images: &HashMap<String, ImageData>,
        make: impl Fn((usize, usize), &[[f32; 3]]) -> Result<Vec<[f32; 3]>, String>,
    ) -> Result<Arc<Texture>, String> {
        let (wrap, filtering) = (map.wrap, map.filtering);
        let key = format!("{} {use_of} {wrap:?} {filtering:?} {:?} {:?}", map.image, map.repeat, map.offset);
        if let Some(found) = self.known.get(&key) {
            return Ok(Arc::clone(found));
        }
        let (width, height, values) =
            images.get(&map.image).ok_or_else(|| format!("there is no image {:?}", map.image))?;
        let texels: Vec<[f32; 3]> = values.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect();
        let texels = make((*width, *height), &texels)?;
        let texture = Texture::new(
            (*width, *height),
            texels,
            map.wrap,
            Vec2::from(map.repeat),
            Vec2::from(map.offset),
        )?
        .filtered(filtering);
        Ok(Arc::clone(self.known.entry(key).or_insert(Arc::new(texture))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::Wrap;

    fn point(along: [Vec3; 2]) -> TexturePoint {
        let axes = [Vec3::ZERO; 2];
        TexturePoint { uv: Vec2::splat(0.5), along, footprint: Footprint::default(), solid: Vec3::ZERO, axes }
    }

    fn texture(size: (usize, usize), texels: Vec<[f32; 3]>) -> Arc<Texture> {
        Arc::new(Texture::new(size, texels, Wrap::Clamp, Vec2::ONE, Vec2::ZERO).unwrap())
    }

    #[test]
    fn a_ramp_of_heights_tilts_the_normal_by_its_angle() {
        // h grows by 0.2 m over the image, which lies over 0.5 m along x and, skewed, over 2 m: a slope of 0.4 along x,
        // whatever the other axis does.
        let heights: Vec<[f32; 3]> = (0..16 * 16).map(|i| [0.2 * (i % 16) as f32 / 16.0, 0.0, 0.0]).collect();
        let relief = ReliefTexture::Heights(
            texture((16, 16), slopes_of_heights((16, 16), &heights, Wrap::Clamp)),
            [1.0; 2],
        );
        let along = [Vec3::new(0.5, 0.0, 0.0), Vec3::new(0.3, 2.0, 0.0)];
        let normal = relief.perturbed(&point(along), Vec3::Z);
        // The plane through the two tangents raised by what the heights add to each.
        let [a, b] = [along[0] + Vec3::Z * 0.2, along[1]];
        assert!((normal - a.cross(b).normalize()).length() < 1e-5, "{normal}");
        assert!((normal.length() - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_normal_map_gives_the_normal_that_it_holds_on_either_winding() {
        // (0.6, 0, 0.8): slopes −x/z, −y/z.
        let relief = ReliefTexture::Normals(texture((1, 1), vec![[-0.75, 0.0, 0.0]]), 1.0);
        let plain = relief.perturbed(&point([Vec3::X * 3.0, Vec3::Y]), Vec3::Z);
        assert!((plain - Vec3::new(0.6, 0.0, 0.8)).length() < 1e-6);
        let relief = ReliefTexture::Normals(texture((1, 1), vec![[0.0, -0.75, 0.0]]), 1.0);
        let mirrored = relief.perturbed(&point([Vec3::X, -Vec3::Y]), Vec3::Z);
        assert!((mirrored - Vec3::new(0.0, -0.6, 0.8)).length() < 1e-6);
    }

    #[test]
    fn a_cone_sees_more_of_a_tilted_surface() {
        let along = [Vec3::X * 2.0, Vec3::Y * 4.0];
        let point = TexturePoint::new(Vec2::ZERO, along, Vec3::ZERO, 0.1, -Vec3::Z, Vec3::Z);
        let area = |p: &TexturePoint| p.footprint.axes[0].perp_dot(p.footprint.axes[1]).abs();
        // 0.05² of the half axes over 2 · 4.
        assert!((area(&point) - 0.05 * 0.05 / 8.0).abs() < 1e-8);
        let tilted =
            TexturePoint::new(Vec2::ZERO, along, Vec3::ZERO, 0.1, Vec3::new(0.0, 0.8, -0.6), Vec3::Z);
        assert!((area(&tilted) - 0.05 * 0.05 / 0.6 / 8.0).abs() < 1e-8);
    }
}
