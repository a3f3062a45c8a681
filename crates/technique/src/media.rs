//! The media that a path is in.

/// The dielectric bodies around a point of a path, innermost last: numbers of materials.
#[derive(Clone, Copy, Debug, Default)]
pub struct Media {
    stack: [u16; Self::DEPTH],
    len: u8,
}

impl Media {
    /// Bodies that may lie inside each other; deeper ones are taken for the deepest.
    const DEPTH: usize = 8;

    /// The innermost body; `None` in the open.
    #[inline(always)]
    #[must_use]
    pub fn innermost(&self) -> Option<usize> {
        (self.len > 0).then(|| usize::from(self.stack[usize::from(self.len) - 1]))
    }

    /// The media after a path has entered a body.
    #[inline(always)]
    #[must_use]
    pub fn entered(mut self, material: usize) -> Self {
        let top = usize::from(self.len).min(Self::DEPTH - 1);
        self.stack[top] = material as u16;
        self.len = top as u8 + 1;
        self
    }

    /// The media after a path has left a body: the innermost of that material is taken off.
    #[inline(always)]
    #[must_use]
    pub fn left(mut self, material: usize) -> Self {
        let len = usize::from(self.len);
        if let Some(i) = self.stack[..len].iter().rposition(|&m| usize::from(m) == material) {
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
        let media = Media::default().entered(3).entered(5);
        assert_eq!(media.innermost(), Some(5));
        assert_eq!(media.left(3).innermost(), Some(5));
        assert_eq!(media.left(5).innermost(), Some(3));
        assert_eq!(media.left(3).left(5).innermost(), None);
        assert_eq!(Media::default().left(1).innermost(), None);
    }
}
