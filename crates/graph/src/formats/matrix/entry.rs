//! Entries of matrices, however numpy, R and spreadsheets write them.

use alloc::vec::Vec;

/// An entry: a number that is not infinite, or a truth value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Entry(f64);

impl Entry {
    /// `0`, `1.000e+00`, `True`, `FALSE`, or another number.
    pub(super) fn of(word: &str) -> Option<Self> {
        if word.eq_ignore_ascii_case("true") {
            return Some(Self(1.0));
        }
        if word.eq_ignore_ascii_case("false") {
            return Some(Self(0.0));
        }
        word.parse::<f64>().ok().filter(|value| value.is_finite()).map(Self)
    }

    /// Whether it is 0 or 1.
    pub(super) fn is_bit(self) -> bool {
        self.0 == 0.0 || self.0 == 1.0
    }

    /// Whether it is not 0.
    pub(super) fn is_link(self) -> bool {
        self.0 != 0.0
    }
}

/// Whether all entries are 0 or 1.
pub(super) fn are_bits(entries: &[Vec<Entry>]) -> bool {
    entries.iter().flatten().all(|entry| entry.is_bit())
}

/// Whether a square of other numbers may be an adjacency matrix: it has a diagonal of zeros, or is symmetric, or would tell a
/// link twice or a loop as edges with weights.
pub(super) fn is_likely(entries: &[Vec<Entry>]) -> bool {
    let diagonal = (0..entries.len()).all(|node| !entries[node][node].is_link());
    let mut below = (0..entries.len()).flat_map(|row| (0..row).map(move |column| (row, column)));
    diagonal
        || below.all(|(row, column)| entries[row][column] == entries[column][row])
        || tells_twice(entries)
}

/// Whether the first two entries of a row are one number, or those of another row in some order.
fn tells_twice(entries: &[Vec<Entry>]) -> bool {
    let ends = |row: usize| Some((*entries[row].first()?, *entries[row].get(1)?));
    (0..entries.len()).any(|row| {
        let Some((from, to)) = ends(row) else {
            return false;
        };
        from == to || (0..row).any(|other| [Some((from, to)), Some((to, from))].contains(&ends(other)))
    })
}

/// Whether two rows have zeros in the diagonal and one number beside them: a link, and how often or how strong.
pub(super) fn are_counts_of_two(entries: &[Vec<Entry>]) -> bool {
    matches!(entries, [first, second] if !first[0].is_link() && !second[1].is_link() && first[1] == second[0])
}
