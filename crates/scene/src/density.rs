//! A density over a box, and how much of it a ray passes.

use glam::Vec3;

/// A density over the unit cube: linear between the centres of cells, that of the border beyond them.
#[derive(Clone, Debug)]
pub struct Density {
    size: [usize; 3],
    /// x fastest, then y, then z.
    values: Vec<f32>,
    most: f32,
}

/// The density that a ray passes: its integral over distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// The integral, up to what was asked for.
    pub amount: f32,
    /// The distance at which it reached that, if it did.
    pub reached: Option<f32>,
}

impl Density {
    /// A density from the values of its cells, x fastest; `None` when their number does not fit, or one is negative or not finite, or none is
    /// above 0.
    #[must_use]
    pub fn new(size: [usize; 3], values: Vec<f32>) -> Option<Self> {
        let most = values.iter().copied().fold(0.0f32, f32::max);
        let sound = values.iter().all(|v| *v >= 0.0 && v.is_finite());
        let fits = size.iter().try_fold(1usize, |n, s| n.checked_mul(*s)) == Some(values.len());
        (sound && fits && most > 0.0).then_some(Self { size, values, most })
    }

    /// The value at a place in the unit cube.
    #[must_use]
    pub fn at(&self, place: Vec3) -> f32 {
        let mut low = [0usize; 3];
        let mut part = [0.0f32; 3];
        for axis in 0..3 {
            let last = self.size[axis] - 1;
            let x = (place[axis] * self.size[axis] as f32 - 0.5).clamp(0.0, last as f32);
            low[axis] = (x as usize).min(last);
            part[axis] = x - low[axis] as f32;
        }
        let mut sum = 0.0;
        for corner in 0..8usize {
            let (mut weight, mut index, mut stride) = (1.0, 0, 1);
            for axis in 0..3 {
                let next = corner >> axis & 1;
                weight *= if next == 1 { part[axis] } else { 1.0 - part[axis] };
                index += (low[axis] + next).min(self.size[axis] - 1) * stride;
                stride *= self.size[axis];
            }
            if weight > 0.0 {
                sum += weight * self.values[index];
            }
        }
        sum
    }

    /// The largest value.
    #[must_use]
    pub fn most(&self) -> f32 {
        self.most
    }

    /// How many planes through the centres of cells a way through the unit cube crosses at most.
    #[must_use]
    pub fn crossings(&self, way: Vec3) -> f32 {
        (0..3).map(|axis| (way[axis].abs() * self.size[axis] as f32).ceil()).sum()
    }

    /// The density that a ray in the unit cube passes between two distances, or until that is `enough`.
    ///
    /// Between two planes through the centres of cells the density is a cubic polynomial of distance, which two points of Gauss
    /// integrate exactly.
    ///
    /// ```
    /// use glam::Vec3;
    /// use illuminant_scene::Density;
    /// let ramp = Density::new([2, 1, 1], vec![0.0, 1.0]).unwrap();
    /// let (whole, half) = ([0.0, 1.0], [0.0, 0.5]);
    /// let column = |span, enough| ramp.column(Vec3::ZERO, Vec3::X, span, enough);
    /// assert!((column(whole, f32::INFINITY).amount - 0.5).abs() < 1e-6);
    /// // From 1/4 to 1/2 the density rises from 0 to 1/2.
    /// assert!((column(half, f32::INFINITY).amount - 0.0625).abs() < 1e-6);
    /// assert!((column(whole, 0.0625).reached.unwrap() - 0.5).abs() < 1e-6);
    /// ```
    #[must_use]
    pub fn column(&self, origin: Vec3, direction: Vec3, [near, far]: [f32; 2], enough: f32) -> Column {
        let at = |t: f32| self.at(origin + direction * t);
        let between = |a: f32, b: f32| {
            let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
            let off = half * (1.0f32 / 3.0).sqrt();
            half * (at(middle - off) + at(middle + off))
        };
        let mut planes = [0, 1, 2].map(|axis| {
            let size = self.size[axis] as f32;
            Planes::new(origin[axis] * size - 0.5, direction[axis] * size, size - 1.0, near)
        });
        // Summed in double precision: a ray may pass thousands of cells.
        let (mut amount, mut t) = (0.0f64, near);
        loop {
            let mut next = far;
            for plane in &planes {
                next = next.min(plane.distance());
            }
            if next > t {
                let part = f64::from(between(t, next));
                if amount + part > f64::from(enough) {
                    let missing = (f64::from(enough) - amount) as f32;
                    let reached = root(|s| between(t, s) - missing, at, [t, next], missing / part as f32);
                    return Column { amount: enough, reached: Some(reached) };
                }
                amount += part;
                t = next;
            }
            if !(next < far) {
                return Column { amount: amount as f32, reached: None };
            }
            planes.iter_mut().filter(|plane| plane.distance() <= next).for_each(Planes::pass);
        }
    }
}

/// The planes across one axis that a ray crosses, one after the other.
struct Planes {
    start: f32,
    slope: f32,
    /// The number of the next plane, and of the last.
    next: f32,
    last: f32,
}

impl Planes {
    /// Of a ray that begins at a place along the axis in units of cells, changes it with a slope, and is at a distance.
    fn new(start: f32, slope: f32, last: f32, distance: f32) -> Self {
        let place = start + slope * distance;
        let next = if slope > 0.0 { (place.floor() + 1.0).max(0.0) } else { (place.ceil() - 1.0).min(last) };
        Self { start, slope, next, last }
    }

    /// The distance at which the next one is crossed; infinite when there is none.
    fn distance(&self) -> f32 {
        let exists = self.slope != 0.0 && (0.0..=self.last).contains(&self.next);
        if exists { (self.next - self.start) / self.slope } else { f32::INFINITY }
    }

    fn pass(&mut self) {
        self.next += self.slope.signum();
    }
}

/// Where a function that rises from below 0 to above it is 0, by Newton's method within a bracket that shrinks; `first` is the part of the
/// bracket to begin at.
fn root(value: impl Fn(f32) -> f32, slope: impl Fn(f32) -> f32, [low, high]: [f32; 2], first: f32) -> f32 {
    /// Halving alone would need no more.
    const MOST: usize = 32;
    let (mut low, mut high) = (low, high);
    let mut at = low + (high - low) * first.clamp(0.0, 1.0);
    for _ in 0..MOST {
        let found = value(at);
        if found > 0.0 {
            high = at
        } else {
            low = at
        }
        // Where the slope is 0 this is no number, and the bracket is halved.
        let newton = at - found / slope(at);
        let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
        if (next - at).abs() <= f32::EPSILON * at.abs() {
            return next;
        }
        at = next;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers in [0, 1), the same in every run.
    fn numbers() -> impl FnMut() -> f32 {
        let mut state = 1u32;
        move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / (1 << 24) as f32
        }
    }

    /// Grids of several shapes, one of them with empty cells, and rays through them, some along an axis.
    fn rays() -> Vec<(Density, Vec3, Vec3, [f32; 2])> {
        let mut number = numbers();
        let mut found = Vec::new();
        for size in [[1, 1, 1], [2, 3, 4], [1, 7, 1], [16, 5, 9]] {
            let count = size.iter().product();
            let values = (0..count).map(|_| (2.0 * number() - 0.7).max(0.0) + 1e-6).collect();
            let density = Density::new(size, values).unwrap();
            for i in 0..60 {
                let mut place = || Vec3::new(number(), number(), number());
                let (origin, mut way) = (place(), place() - place());
                if i % 4 == 0 {
                    way[i / 4 % 3] = 0.0;
                }
                found.push((density.clone(), origin, way, [0.1 * number(), 0.2 + number()]));
            }
        }
        found
    }

    #[test]
    fn columns_are_integrals_of_the_density() {
        for (density, origin, way, [near, far]) in rays() {
            let steps = 20_000;
            let width = f64::from(far - near) / f64::from(steps);
            let at = |i: i32| f64::from(near) + (f64::from(i) + 0.5) * width;
            let sum: f64 = (0..steps).map(|i| f64::from(density.at(origin + way * at(i) as f32))).sum();
            let column = density.column(origin, way, [near, far], f32::INFINITY);
            assert!((f64::from(column.amount) - sum * width).abs() < 2e-5, "{column:?} {}", sum * width);
            assert_eq!(column.reached, None);
        }
    }

    #[test]
    fn a_column_is_reached_where_it_is_that_large() {
        for (density, origin, way, [near, far]) in rays() {
            let whole = density.column(origin, way, [near, far], f32::INFINITY).amount;
            for part in [1e-4, 0.1, 0.5, 0.9, 0.999] {
                let column = density.column(origin, way, [near, far], part * whole);
                let reached = column.reached.unwrap();
                assert!(near <= reached && reached <= far);
                let before = density.column(origin, way, [near, reached], f32::INFINITY).amount;
                assert!((before - part * whole).abs() < 2e-6, "{before} for {}", part * whole);
            }
            assert_eq!(density.column(origin, way, [near, far], whole * 1.001).reached, None);
        }
    }

    #[test]
    fn no_way_crosses_more_planes_than_are_counted() {
        for (density, origin, way, [near, far]) in rays() {
            let planes = [0, 1, 2].map(|axis| {
                let size = density.size[axis] as f32;
                let mut planes = Planes::new(origin[axis] * size - 0.5, way[axis] * size, size - 1.0, near);
                let mut count = 0.0;
                while planes.distance() < far {
                    planes.pass();
                    count += 1.0;
                }
                count
            });
            assert!(planes.iter().sum::<f32>() <= density.crossings(way * (far - near)));
        }
    }
}
