//! Numbers for samplers out of bytes: plain ones, and those at which formulas fail.

use glam::Vec3;

/// Bytes that are used up one after the other; zeros when there are none left.
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    /// The next byte.
    pub fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        *first
    }

    /// Whether there are any left.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    fn word(&mut self) -> u32 {
        u32::from_le_bytes([self.byte(), self.byte(), self.byte(), self.byte()])
    }

    /// A number from 0 up to but not including 1, the ends more often than by chance.
    pub fn unit(&mut self) -> f32 {
        match self.byte() {
            0 => 0.0,
            1 => 1.0 - f32::EPSILON / 2.0,
            2 => f32::MIN_POSITIVE,
            3 => 0.5,
            _ => (self.word() >> 8) as f32 * (1.0 / 16_777_216.0),
        }
    }

    /// Two such.
    pub fn pair(&mut self) -> [f32; 2] {
        [self.unit(), self.unit()]
    }

    /// Any number from 0 up that is finite: also tiny and huge ones.
    pub fn positive(&mut self) -> f32 {
        match self.byte() % 16 {
            0 => 0.0,
            1 => 1e-45,
            2 => f32::MIN_POSITIVE,
            3 => 1e-20,
            4 => 1e-6,
            5 => 1.0,
            6 => 1e6,
            7 => 1e20,
            8 => f32::MAX,
            9 => f32::from_bits(self.word() & 0x7F7F_FFFF),
            _ => self.unit() * 4.0,
        }
    }

    /// Any finite number.
    pub fn number(&mut self) -> f32 {
        let value = self.positive();
        if self.byte() & 1 == 1 { -value } else { value }
    }

    /// A number between two others.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.unit())
    }

    /// A unit vector, along an axis more often than by chance.
    pub fn direction(&mut self) -> Vec3 {
        match self.byte() % 8 {
            0 => Vec3::Z,
            1 => -Vec3::Z,
            2 => Vec3::X,
            3 => Vec3::new(1.0, 0.0, 1e-7).normalize(),
            4 => Vec3::new(0.0, 1.0, -1e-4).normalize(),
            _ => {
                let [z, phi] = self.pair();
                let z = 2.0 * z - 1.0;
                let r = (1.0 - z * z).max(0.0).sqrt();
                let (s, c) = (std::f32::consts::TAU * phi).sin_cos();
                Vec3::new(r * c, r * s, z).normalize()
            }
        }
    }

    /// A unit vector on the side of z > 0.
    pub fn above(&mut self) -> Vec3 {
        let v = self.direction();
        let v = Vec3::new(v.x, v.y, v.z.abs().max(1e-6));
        v.normalize()
    }

    /// A point whose coordinates are any finite numbers.
    pub fn point(&mut self) -> Vec3 {
        Vec3::new(self.number(), self.number(), self.number())
    }
}

/// Fails unless a vector has the length 1.
#[track_caller]
pub fn unit(direction: Vec3) {
    assert!((direction.length() - 1.0).abs() < 1e-2, "not of unit length: {direction}");
}

/// Fails unless a density is a number from 0 up.
#[track_caller]
pub fn density(value: f32) {
    assert!(value >= 0.0, "a density of {value}");
}
