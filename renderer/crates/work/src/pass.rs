//! Passes: which pixels are rendered in one go.

/// Which pixels are rendered in one go: those whose column and row are multiples of `step`, but for those that are
/// multiples of twice that, if there was a pass before.
#[derive(Clone, Copy)]
pub(crate) struct Pass {
    pub step: usize,
    pub first: bool,
}

impl Pass {
    pub fn has(self, column: usize, row: usize) -> bool {
        let all = |step: usize| column.is_multiple_of(step) && row.is_multiple_of(step);
        all(self.step) && (self.first || !all(2 * self.step))
    }
}
