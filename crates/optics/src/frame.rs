//! The local frame at a surface (book 2.2.1, figure 2.2).

use glam::Vec3;

/// An orthonormal right-handed frame whose third axis is the normal.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// First axis; along the grain where a surface has one.
    pub tangent: Vec3,
    /// Second axis.
    pub bitangent: Vec3,
    /// The normal.
    pub normal: Vec3,
}

impl Frame {
    /// A frame around a unit normal (Duff et al. 2017), without a preferred tangent.
    ///
    /// ```
    /// use glam::Vec3;
    /// use illuminant_optics::frame::Frame;
    /// let frame = Frame::from_normal(Vec3::new(0.6, 0.0, -0.8));
    /// let v = Vec3::new(0.3, 0.2, 0.5);
    /// assert!((frame.to_world(frame.to_local(v)) - v).length() < 1e-6);
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn from_normal(normal: Vec3) -> Self {
        let sign = 1f32.copysign(normal.z);
        let a = -1.0 / (sign + normal.z);
        let b = normal.x * normal.y * a;
        Self {
            tangent: Vec3::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x),
            bitangent: Vec3::new(b, sign + normal.y * normal.y * a, -normal.y),
            normal,
        }
    }

    /// A frame around a unit normal whose first axis is the direction nearest to `grain` in the surface (book 2.2.1); without a preferred
    /// tangent where the grain stands on the surface.
    ///
    /// ```
    /// use glam::Vec3;
    /// use illuminant_optics::frame::Frame;
    /// let frame = Frame::along(Vec3::Z, Vec3::new(0.0, 2.0, 1.0));
    /// assert!((frame.tangent - Vec3::Y).length() < 1e-6);
    /// // A grain turned by 90 degrees swaps the axes.
    /// let turned = Frame::along(Vec3::Z, Vec3::new(-2.0, 0.0, 1.0));
    /// assert!((turned.tangent - frame.bitangent).length() < 1e-6);
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn along(normal: Vec3, grain: Vec3) -> Self {
        let tangent = grain - normal * normal.dot(grain);
        match tangent.try_normalize().filter(|_| tangent.length_squared() > 1e-8 * grain.length_squared()) {
            Some(tangent) => Self { tangent, bitangent: normal.cross(tangent), normal },
            None => Self::from_normal(normal),
        }
    }

    /// Components of a world vector along the axes.
    #[inline(always)]
    #[must_use]
    pub fn to_local(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.tangent), v.dot(self.bitangent), v.dot(self.normal))
    }

    /// The world vector with these components.
    #[inline(always)]
    #[must_use]
    pub fn to_world(&self, v: Vec3) -> Vec3 {
        self.tangent * v.x + self.bitangent * v.y + self.normal * v.z
    }
}
