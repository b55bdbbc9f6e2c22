//! Lists of nodes with their neighbours.

pub(super) mod lgl;
pub(super) mod metis;
pub(super) mod multiline;
pub(super) mod plain;

use super::words::all_lines;

/// Whether it has the date that `networkx.write_adjlist` and its relatives put above, and nothing else does.
pub(super) fn is_of_networkx(text: &str) -> bool {
    all_lines(text).take_while(|line| line.text.starts_with('#')).any(|line| line.text.starts_with("# GMT "))
}
