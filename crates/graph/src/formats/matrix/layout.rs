//! Where a matrix has its entries, and where names.

use alloc::vec::Vec;

use super::entry::Entry;
use crate::formats::error::FormatError;
use crate::formats::words::Word;

/// Rows and columns before the entries: 0 or 1 each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    /// Rows of names above.
    pub(super) head: usize,
    /// Columns of names at the left.
    side: usize,
    /// Words before the first name of the row above: 1 if the corner is written down.
    corner: usize,
    /// Rows of entries, at least 1.
    pub(super) nodes: usize,
}

impl Layout {
    /// The layout by the widths of the rows, if these make a square.
    pub(super) fn of(rows: &[Vec<Word<'_>>]) -> Option<Self> {
        let first = rows.first()?.len();
        let count = rows.len();
        let width = rows.get(1).map_or(first, Vec::len);
        if rows.iter().skip(1).any(|row| row.len() != width) {
            return None;
        }
        let layout = |head: usize, side: usize, corner: usize| {
            let nodes = count - head;
            (nodes > 0).then_some(Self { head, side, corner, nodes })
        };
        match (first, width) {
            _ if first == count && width == count && has_corner(rows) => layout(1, 1, 1),
            _ if first == count && width == count => layout(0, 0, 0),
            _ if first + 1 == count && width + 1 == count => layout(1, 0, 0),
            _ if first + 1 == count && width == count => layout(1, 1, 0),
            _ if first == count + 1 && width == count + 1 => layout(0, 1, 0),
            _ => None,
        }
    }

    /// On how many sides there are names, 0 to 2.
    pub(super) fn sides_named(&self) -> usize {
        self.head + self.side
    }

    /// The entries without names.
    pub(super) fn entries<'w, 'a>(&self, rows: &'w [Vec<Word<'a>>]) -> Vec<&'w [Word<'a>]> {
        rows.iter().skip(self.head).map(|row| row.get(self.side..).unwrap_or(&[])).collect()
    }

    /// The name of a node, if the matrix has names. Those above and at the left must be the same.
    pub(super) fn name<'a>(
        &self,
        rows: &[Vec<Word<'a>>],
        node: usize,
    ) -> Result<Option<Word<'a>>, FormatError> {
        let above = if self.head == 1 { rows[0].get(node + self.corner).copied() } else { None };
        let left = if self.side == 1 {
            rows.get(node + self.head).and_then(|row| row.first()).copied()
        } else {
            None
        };
        match (above, left) {
            (Some(above), Some(left)) if above.text != left.text => {
                Err(left.unexpected("the same names at the left as above, in the same order"))
            }
            (above, left) => Ok(above.or(left)),
        }
    }
}

/// Whether the word in the corner is none of the entries: it is empty or no number.
fn has_corner(rows: &[Vec<Word<'_>>]) -> bool {
    let corner = rows.first().and_then(|row| row.first());
    corner.is_some_and(|corner| Entry::of(corner.text).is_none()) && rows.len() > 1
}

/// What is wrong with rows that make no square: the first row that is not as long as it should be.
pub(super) fn complaint(rows: &[Vec<Word<'_>>]) -> FormatError {
    const ALLOWED: &str = "as many entries in every row as rows";
    let wrong = rows.iter().find(|row| row.len() != rows.len());
    match wrong.or(rows.first()).and_then(|row| row.get(rows.len()).or(row.last())) {
        Some(word) => word.unexpected(ALLOWED),
        None => FormatError::missing(1, ALLOWED),
    }
}
