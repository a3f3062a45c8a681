//! The media that a path is in.

/// The dielectric bodies around a point of a path: numbers of materials with their priorities, in the order in which they were entered.
///
/// Bodies may overlap, so that what touches needs no common boundary: of several at one place that of the highest priority is there, of
/// equal ones the last entered, and boundaries of lower ones are not seen (Schmidt and Budge 2002).
#[derive(Clone, Copy, Debug, Default)]
pub struct Media {
    stack: [(u16, u8); Self::DEPTH],
    len: u8,
}

impl Media {
    /// Bodies that may lie inside each other; deeper ones are taken for the deepest.
    const DEPTH: usize = 8;

    /// The body that is there; `None` in the open.
    #[inline(always)]
    #[must_use]
    pub fn innermost(&self) -> Option<usize> {
        self.highest().map(|(material, _)| usize::from(material))
    }

    #[inline(always)]
    fn highest(&self) -> Option<(u16, u8)> {
        self.stack[..usize::from(self.len)].iter().copied().reduce(|a, b| if b.1 >= a.1 { b } else { a })
    }

    /// Whether the boundary of a body is not seen, because another one that is there counts more.
    #[inline(always)]
    #[must_use]
    pub fn hides(&self, material: usize, priority: u8) -> bool {
        self.highest().is_some_and(|(other, higher)| higher > priority && usize::from(other) != material)
    }

    /// The media after a path has entered a body.
    #[inline(always)]
    #[must_use]
    pub fn entered(mut self, material: usize, priority: u8) -> Self {
        let top = usize::from(self.len).min(Self::DEPTH - 1);
        self.stack[top] = (material as u16, priority);
        self.len = top as u8 + 1;
        self
    }

    /// The media after a path has left a body: the innermost of that material is taken off.
    #[inline(always)]
    #[must_use]
    pub fn left(mut self, material: usize) -> Self {
        let len = usize::from(self.len);
        if let Some(i) = self.stack[..len].iter().rposition(|&(m, _)| usize::from(m) == material) {
            self.stack.copy_within(i + 1..len, i);
            self.len -= 1;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::Media;

    #[test]
    fn bodies_nest_and_may_be_left_in_any_order() {
        let media = Media::default().entered(3, 0).entered(5, 0);
        assert_eq!(media.innermost(), Some(5));
        assert_eq!(media.left(3).innermost(), Some(5));
        assert_eq!(media.left(5).innermost(), Some(3));
        assert_eq!(media.left(3).left(5).innermost(), None);
        assert_eq!(Media::default().left(1).innermost(), None);
    }

    #[test]
    fn the_body_of_the_highest_priority_is_there() {
        // A glass (3) of priority 2, and water (5) of 1 that overlaps its wall.
        let glass = Media::default().entered(3, 2);
        assert!(glass.hides(5, 1) && !glass.hides(3, 2) && !glass.hides(6, 2));
        let both = glass.entered(5, 1);
        assert_eq!(both.innermost(), Some(3));
        assert!(both.hides(5, 1));
        assert_eq!(both.left(3).innermost(), Some(5));
        assert!(!both.left(3).hides(5, 1) && !both.left(3).hides(3, 2));
    }
}
