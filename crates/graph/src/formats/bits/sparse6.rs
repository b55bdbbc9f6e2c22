//! sparse6: links one after the other, for undirected graphs with few of them.
//!
//! Behind `:` and n come groups of a bit b and k bits x, k the length of n − 1 in binary. A node v starts at 0. If b is 1,
//! v grows by one. If x is above v, v becomes x, else x — v is a link. Ones fill the last byte.

use super::{are_printable, bit, size};
use crate::formats::builder::{Builder, Draft};
use crate::formats::error::FormatError;
use crate::formats::words::Line;

const ALLOWED: &str = "one line of sparse6: a colon, then bytes '?' to '~'";

/// Whether these bytes, behind the colon, are a number of nodes and six bits each.
pub(super) fn fits(bytes: &[u8]) -> bool {
    are_printable(bytes) && size(bytes).is_some()
}

pub(super) fn read(line: Line<'_>, bytes: &[u8]) -> Result<Draft, FormatError> {
    let number = line.number;
    let wrong = || FormatError::unexpected(number, line.text, ALLOWED).at(line.start);
    let (count, bytes) = size(bytes).filter(|_| fits(bytes)).ok_or_else(wrong)?;
    let mut builder = Builder::new(false);
    builder.declare_numbers(0, count, number)?;
    let width = usize::BITS - count.saturating_sub(1).leading_zeros();
    let mut node = 0;
    let mut index = 0;
    while let Some((grows, other)) = group(bytes, &mut index, width) {
        node += usize::from(grows);
        if other >= count || node >= count {
            break;
        }
        if other > node {
            node = other;
        } else {
            builder.edge(other, node, number);
        }
    }
    builder.finish(number)
}

/// The next bit b and number x, which has a bit or more.
fn group(bytes: &[u8], index: &mut usize, width: u32) -> Option<(bool, usize)> {
    let mut next = || {
        let bit = bit(bytes, *index);
        *index += 1;
        bit
    };
    let grows = next().filter(|_| width > 0)?;
    let mut other = 0;
    for _ in 0..width {
        other = other << 1 | usize::from(next()?);
    }
    Some((grows, other))
}
