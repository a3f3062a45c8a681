//! The camera: perspective projection and its rays (book 1.2).

use crate::Ray;
use glam::{DMat4, DVec3, Vec3};
use thiserror::Error;

/// Why numbers are no camera.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CameraError {
    /// Eye and target coincide.
    #[error("camera: eye and target are the same point, so it looks nowhere")]
    NoDirection,
    /// Up is along the view.
    #[error("camera: up is parallel to the direction of view; choose another up")]
    Up,
    /// The field of view is out of range.
    #[error("camera: field_of_view must lie between 0.001 and 180 degrees, and {0} does not")]
    FieldOfView(f64),
    /// The image or the crop has no pixels or too many.
    #[error("camera: {0}")]
    Size(String),
    /// Something is not finite.
    #[error("camera: eye, target and up must be finite")]
    NotFinite,
}

/// A pinhole camera that looks from `eye` to `target`.
#[derive(Clone, Debug)]
pub struct Camera {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    half_width: f64,
    /// Width and height of the whole image, pixels.
    pub size: [u32; 2],
    /// The part that is rendered: x₀, y₀, x₁, y₁ in pixels from the upper left, ends excluded.
    pub crop: [u32; 4],
    /// When the shutter opens and closes, as fractions of the motion.
    pub shutter: [f32; 2],
    /// The lens; without one all is sharp.
    pub lens: Option<Lens>,
    rays: RayBasis,
    /// How much of what a ray needs changes over the whole motion.
    moves: Option<RayBasis>,
}

/// A thin lens (Cook, Porter and Carpenter 1984; book figure 4.19): of what lies in the focal plane all points of the lens see the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// The radius of the aperture: focal length over twice the f-number.
    pub radius: f32,
    /// Distance of the focal plane along the direction of view.
    pub focus: f32,
    /// The blades of the aperture: a regular polygon in its circle; 0 for the circle.
    pub blades: u32,
    /// How far the blades are turned, radians.
    pub turn: f32,
}

impl Lens {
    /// A point of the aperture, uniform over its area, from two numbers in [0, 1); a mapping that keeps near what is near (Shirley and Chiu
    /// 1997).
    ///
    /// ```
    /// use illuminant_scene::Lens;
    /// let lens = Lens { radius: 0.01, focus: 2.0, blades: 6, turn: 0.0 };
    /// let [x, y] = lens.point([0.3, 0.9]);
    /// assert!(x.hypot(y) <= 0.01);
    /// ```
    #[must_use]
    pub fn point(&self, u: [f32; 2]) -> [f32; 2] {
        use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};
        if self.blades >= 3 {
            // One of the triangles about the middle, then a place in it.
            let place = u[0] * self.blades as f32;
            let blade = (place as u32).min(self.blades - 1);
            let (s, t) = ((place - blade as f32).sqrt(), u[1]);
            let corner = |i: u32| {
                let (sin, cos) = (self.turn + 2.0 * PI * i as f32 / self.blades as f32).sin_cos();
                [cos, sin].map(|v| v * self.radius)
            };
            let (a, b) = (corner(blade), corner(blade + 1));
            return std::array::from_fn(|i| s * (a[i] * (1.0 - t) + b[i] * t));
        }
        let [x, y] = u.map(|v| 2.0 * v - 1.0);
        if x == 0.0 && y == 0.0 {
            return [0.0; 2];
        }
        let (r, angle) =
            if x.abs() > y.abs() { (x, FRAC_PI_4 * (y / x)) } else { (y, FRAC_PI_2 - FRAC_PI_4 * (x / y)) };
        let (sin, cos) = angle.sin_cos();
        [cos, sin].map(|v| v * r * self.radius)
    }
}

/// A point of the world as a camera sees it.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// The point of the lens.
    pub origin: Vec3,
    /// Where in the image, pixels from the upper left.
    pub pixel: [f32; 2],
    /// How many pixels a unit of solid angle takes there, 1/sr.
    pub pixels: f32,
}

/// What a ray needs, in f32: origin, the direction to the upper left corner, and the steps of a pixel.
#[derive(Clone, Copy, Debug, Default)]
struct RayBasis {
    origin: Vec3,
    corner: Vec3,
    dx: Vec3,
    dy: Vec3,
}

impl RayBasis {
    fn plus(self, other: &Self, factor: f32) -> Self {
        Self {
            origin: self.origin + other.origin * factor,
            corner: self.corner + other.corner * factor,
            dx: self.dx + other.dx * factor,
            dy: self.dy + other.dy * factor,
        }
    }
}

impl Camera {
    /// A camera with a field of view in degrees across the width of the image; pixels are square.
    ///
    /// # Errors
    /// [`CameraError`] when the numbers describe no camera.
    pub fn new(
        eye: DVec3,
        target: DVec3,
        up: DVec3,
        field_of_view_deg: f64,
        size: [u32; 2],
        crop: Option<[u32; 4]>,
        shutter: [f32; 2],
    ) -> Result<Self, CameraError> {
        if !(eye.is_finite() && target.is_finite() && up.is_finite()) {
            return Err(CameraError::NotFinite);
        }
        // Narrower, and single precision has too few directions for its rays.
        if !(1e-3..180.0).contains(&field_of_view_deg) {
            return Err(CameraError::FieldOfView(field_of_view_deg));
        }
        let forward = (target - eye).try_normalize().ok_or(CameraError::NoDirection)?;
        let right = forward.cross(up);
        if right.length() < 1e-9 * up.length().max(f64::MIN_POSITIVE) {
            return Err(CameraError::Up);
        }
        let right = right.normalize();
        let [w, h] = size;
        if w == 0 || h == 0 || u64::from(w) * u64::from(h) > 1 << 28 {
            return Err(CameraError::Size(format!(
                "an image of {w} × {h} pixels; it must have from 1 to 2^28 pixels"
            )));
        }
        let crop = crop.unwrap_or([0, 0, w, h]);
        let [x0, y0, x1, y1] = crop;
        if !(x0 < x1 && x1 <= w && y0 < y1 && y1 <= h) {
            return Err(CameraError::Size(format!(
                "crop {crop:?} must be x0 < x1 <= {w} and y0 < y1 <= {h}, in pixels from the upper left"
            )));
        }
        let up = right.cross(forward);
        let half_width = (field_of_view_deg.to_radians() / 2.0).tan();
        let mut camera = Self {
            eye,
            right,
            up,
            forward,
            half_width,
            size,
            crop,
            shutter,
            lens: None,
            rays: RayBasis::default(),
            moves: None,
        };
        let pixel = 2.0 * half_width / f64::from(w);
        let corner = forward - right * half_width + camera.up * (pixel * f64::from(h) / 2.0);
        camera.rays = RayBasis {
            origin: eye.as_vec3(),
            corner: corner.as_vec3(),
            dx: (right * pixel).as_vec3(),
            dy: (camera.up * -pixel).as_vec3(),
        };
        Ok(camera)
    }

    /// The ray through a point of the image (pixels from the upper left; the centre of the first is ½, ½), at a
    /// fraction of the time that the shutter is open.
    #[inline(always)]
    #[must_use]
    pub fn ray(&self, x: f32, y: f32, u_time: f32) -> Ray {
        let [open, close] = self.shutter;
        let time = open + (close - open) * u_time;
        let RayBasis { origin, corner, dx, dy } = match &self.moves {
            None => self.rays,
            Some(moves) => self.rays.plus(moves, time),
        };
        Ray { origin, direction: (corner + dx * x + dy * y).normalize(), time }
    }

    /// Whether it moves.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        self.moves.is_some()
    }

    /// The same camera, which moves to where another one is at the end of the motion: the eye straight on, the image plane with it. All but its
    /// rays is that of the beginning.
    #[must_use]
    pub fn moving_to(mut self, end: &Self) -> Self {
        self.moves = Some(end.rays.plus(&self.rays, -1.0));
        self
    }

    /// The ray through a point of the image and a point of the lens, which two numbers in [0, 1) say: from there to where the ray through the
    /// middle of the lens meets the focal plane.
    #[inline]
    #[must_use]
    pub fn ray_through_lens(&self, x: f32, y: f32, u_time: f32, u_lens: [f32; 2]) -> Ray {
        let ray = self.ray(x, y, u_time);
        let Some(lens) = &self.lens else { return ray };
        let [right, up] = lens.point(u_lens);
        let sharp = ray.origin + ray.direction * (lens.focus / ray.direction.dot(self.forward.as_vec3()));
        let origin = ray.origin + self.right.as_vec3() * right + self.up.as_vec3() * up;
        Ray { origin, direction: (sharp - origin).normalize(), time: ray.time }
    }

    /// Where a point of the world is seen through a point of the lens (two numbers in [0, 1)), at a moment of the motion; `None` behind the
    /// lens. What [`Self::ray_through_lens`] does, backwards.
    #[must_use]
    pub fn see(&self, point: Vec3, time: f32, u_lens: [f32; 2]) -> Option<Seen> {
        let RayBasis { origin: middle, corner, dx, dy } = match &self.moves {
            None => self.rays,
            Some(moves) => self.rays.plus(moves, time),
        };
        let across = dx.cross(dy);
        let (mut origin, mut sharp) = (middle, point);
        if let Some(lens) = &self.lens {
            let forward = self.forward.as_vec3();
            let [right, up] = lens.point(u_lens);
            origin = middle + self.right.as_vec3() * right + self.up.as_vec3() * up;
            let depth = (point - origin).dot(forward);
            sharp = origin + (point - origin) * (lens.focus / depth);
            if !(depth > 0.0) {
                return None;
            }
        }
        // corner + x dx + y dy = s · way
        let way = sharp - middle;
        let depth = way.dot(across) / corner.dot(across);
        if !(depth > 0.0) {
            return None;
        }
        let on_plane = way / depth - corner;
        let area = across.length_squared();
        let pixel = [on_plane.cross(dy).dot(across) / area, dx.cross(on_plane).dot(across) / area];
        // The solid angle of a pixel: its area on the plane at distance 1, its cosine, over the square of its distance.
        let direction = (point - origin).normalize();
        let cos = direction.dot(across).abs() / area.sqrt();
        let distance = corner.dot(across).abs() / area.sqrt() / cos;
        Some(Seen { origin, pixel, pixels: distance * distance / (area.sqrt() * cos) })
    }

    /// The angle across a pixel in the middle of the image, radians.
    #[must_use]
    pub fn pixel_angle(&self) -> f32 {
        self.rays.dx.length()
    }

    /// The point of the image, in pixels, where a point of the world appears; `None` behind the eye (R1.2).
    #[must_use]
    pub fn project(&self, point: DVec3) -> Option<[f64; 2]> {
        let p = self.matrix() * point.extend(1.0);
        (p.w > 0.0).then(|| [p.x / p.w, p.y / p.w])
    }

    /// The homogeneous matrix from the world to pixels and depth: x = X/W, y = Y/W, with W the distance along the
    /// direction of view and Z/W = 1 (a pinhole has no near or far plane of its own).
    #[must_use]
    pub fn matrix(&self) -> DMat4 {
        let [w, h] = self.size.map(f64::from);
        let view = DMat4::from_cols(
            DVec3::new(self.right.x, self.up.x, self.forward.x).extend(0.0),
            DVec3::new(self.right.y, self.up.y, self.forward.y).extend(0.0),
            DVec3::new(self.right.z, self.up.z, self.forward.z).extend(0.0),
            DVec3::new(-self.right.dot(self.eye), -self.up.dot(self.eye), -self.forward.dot(self.eye))
                .extend(1.0),
        );
        let scale = w / (2.0 * self.half_width);
        let project = DMat4::from_cols_array(&[
            scale,
            0.0,
            0.0,
            0.0, //
            0.0,
            -scale,
            0.0,
            0.0, //
            w / 2.0,
            h / 2.0,
            1.0,
            1.0, //
            0.0,
            0.0,
            0.0,
            0.0,
        ]);
        project * view
    }

    /// From how far an image of a given width must be looked at to see what the camera saw: the width of the image
    /// plane is to its distance as the width of the picture is to that of the viewer (book 1.2).
    ///
    /// With a field of view of 53.13° a picture 30 cm wide is looked at from 30 cm.
    #[must_use]
    pub fn viewing_distance(&self, picture_width: f64) -> f64 {
        picture_width / (2.0 * self.half_width)
    }

    /// The unit direction of view.
    #[must_use]
    pub fn forward(&self) -> Vec3 {
        self.forward.as_vec3()
    }

    /// Where the eye is.
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        self.eye
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    fn camera(fov: f64) -> Camera {
        Camera::new(dvec3(1.0, 2.0, 3.0), dvec3(4.0, 0.0, -2.0), DVec3::Y, fov, [320, 200], None, [0.0, 1.0])
            .unwrap()
    }

    #[test]
    fn rays_and_projection_agree() {
        let camera = camera(50.0);
        for (x, y) in [(0.5, 0.5), (160.0, 100.0), (319.0, 20.0)] {
            let ray = camera.ray(x, y, 0.0);
            let point = ray.origin.as_dvec3() + ray.direction.as_dvec3() * 7.0;
            let [px, py] = camera.project(point).unwrap();
            assert!((px - f64::from(x)).abs() < 1e-3 && (py - f64::from(y)).abs() < 1e-3, "{px} {py}");
        }
        assert!(camera.project(camera.eye() - (dvec3(4.0, 0.0, -2.0) - camera.eye())).is_none());
    }

    #[test]
    fn all_points_of_a_lens_see_the_focal_plane_at_one_place() {
        let mut camera = camera(50.0);
        for blades in [0, 5, 6] {
            let lens = Lens { radius: 0.2, focus: 4.0, blades, turn: 0.3 };
            camera.lens = Some(lens);
            let sharp = camera.ray(40.5, 70.5, 0.0);
            let forward = camera.forward();
            let at = |ray: &Ray, w: f32| {
                let from = (ray.origin - sharp.origin).dot(forward);
                ray.origin + ray.direction * ((w - from) / ray.direction.dot(forward))
            };
            let (mut sum, mut squares) = (Vec3::ZERO, 0.0);
            // As many columns a blade, so that their means are those of the polygon.
            for i in 0..3600u32 {
                let u = [(i % 60) as f32 / 60.0 + 1.0 / 120.0, (i / 60) as f32 / 60.0 + 1.0 / 120.0];
                let ray = camera.ray_through_lens(40.5, 70.5, 0.0, u);
                assert!((at(&ray, 4.0) - at(&sharp, 4.0)).length() < 1e-4);
                // The circle of confusion at twice the distance is as wide as the lens.
                assert!((at(&ray, 8.0) - at(&sharp, 8.0)).length() < 0.2 * 1.001);
                sum += ray.origin - sharp.origin;
                squares += f64::from((ray.origin - sharp.origin).length_squared());
            }
            assert!((sum / 3600.0).length() < 1e-4);
            // The mean square of the distance from the middle: r²/2 of a circle, of a polygon r²(2 + cos 2π/n)/6.
            let r2 = if blades == 0 {
                0.5
            } else {
                (2.0 + (2.0 * std::f64::consts::PI / f64::from(blades)).cos()) / 6.0
            };
            assert!((squares / 3600.0 / (0.04 * r2) - 1.0).abs() < 2e-3, "{blades}");
        }
    }

    #[test]
    fn what_a_camera_sees_is_where_its_rays_go() {
        let mut camera = camera(50.0).moving_to(&camera(40.0));
        for lens in [None, Some(Lens { radius: 0.2, focus: 4.0, blades: 0, turn: 0.0 })] {
            camera.lens = lens;
            for (x, y, u_time, t) in [(0.5, 0.5, 0.0, 3.0), (160.0, 100.0, 0.4, 9.0), (319.0, 20.0, 1.0, 0.7)]
            {
                let u_lens = [0.3, 0.8];
                let along = |x: f32, y: f32| camera.ray_through_lens(x, y, u_time, u_lens);
                let ray = along(x, y);
                let seen = camera.see(ray.origin + ray.direction * t, ray.time, u_lens).unwrap();
                assert!((seen.origin - ray.origin).length() < 1e-6);
                assert!(
                    (seen.pixel[0] - x).abs() < 2e-3 && (seen.pixel[1] - y).abs() < 2e-3,
                    "{seen:?} {x} {y}"
                );
                let (a, b) = (along(x + 1.0, y).direction, along(x, y + 1.0).direction);
                let angle = (a - ray.direction).cross(b - ray.direction).length();
                assert!((seen.pixels * angle - 1.0).abs() < 1e-2, "{} {angle}", seen.pixels);
                assert!(camera.see(ray.origin - ray.direction * t, ray.time, u_lens).is_none());
            }
        }
    }

    #[test]
    fn a_camera_that_moves_is_in_the_middle_half_way() {
        let at = |x: f64| {
            let camera = Camera::new(
                dvec3(x, 0.0, 0.0),
                dvec3(x, 0.0, -1.0),
                DVec3::Y,
                40.0,
                [8, 8],
                None,
                [0.0, 1.0],
            );
            camera.unwrap()
        };
        let moving = at(0.0).moving_to(&at(2.0));
        for (u, x) in [(0.0, 0.0), (0.5, 1.0), (1.0, 2.0)] {
            let (found, expected) = (moving.ray(3.0, 5.0, u), at(x).ray(3.0, 5.0, u));
            assert!((found.origin - expected.origin).length() < 1e-6);
            assert!((found.direction - expected.direction).length() < 1e-6);
        }
    }

    #[test]
    fn lines_stay_lines() {
        let camera = camera(70.0);
        let (a, b) = (dvec3(3.0, 0.0, -1.0), dvec3(5.0, 1.0, -4.0));
        let p: Vec<_> = [0.0, 0.3, 1.0].iter().map(|t| camera.project(a.lerp(b, *t)).unwrap()).collect();
        let cross = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
        assert!(cross.abs() < 1e-6, "{cross}");
    }

    #[test]
    fn the_viewing_distance_of_the_book() {
        assert!((camera(53.130_102_354).viewing_distance(0.30) - 0.30).abs() < 1e-9);
    }

    #[test]
    fn what_is_no_camera_is_refused() {
        let make = |eye, target, fov, size, crop| {
            Camera::new(eye, target, DVec3::Y, fov, size, crop, [0.0; 2]).err()
        };
        let (o, z) = (DVec3::ZERO, DVec3::Z);
        assert_eq!(make(o, o, 40.0, [1, 1], None), Some(CameraError::NoDirection));
        assert_eq!(make(o, DVec3::Y, 40.0, [1, 1], None), Some(CameraError::Up));
        assert_eq!(make(o, z, 180.0, [1, 1], None), Some(CameraError::FieldOfView(180.0)));
        assert!(matches!(make(o, z, 40.0, [1_000_000_000; 2], None), Some(CameraError::Size(_))));
        assert!(matches!(make(o, z, 40.0, [4, 4], Some([0, 0, 5, 4])), Some(CameraError::Size(_))));
    }
}
