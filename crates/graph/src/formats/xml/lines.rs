//! Line numbers of places in a text, by bisection: asking a parser for each would read the text again and again.

use alloc::vec::Vec;

/// Where the lines of a text end.
pub(super) struct Lines {
    ends: Vec<usize>,
    start: usize,
}

impl Lines {
    /// Lines of the whole `text`, for places that are counted from byte `start`.
    pub(super) fn of(text: &str, start: usize) -> Self {
        Self { ends: text.match_indices('\n').map(|(end, _)| end).collect(), start }
    }

    /// The line of a place, from 1.
    pub(super) fn line(&self, place: usize) -> usize {
        1 + self.ends.partition_point(|&end| end < place + self.start)
    }

    /// The number of the last line.
    pub(super) fn last(&self) -> usize {
        1 + self.ends.len()
    }
}
