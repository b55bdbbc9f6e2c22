//! graph6 and digraph6: six bits to a printable byte.
//!
//! Format of B. McKay's nauty: n as one byte `n + 63` up to 62, else `~` and three bytes; then the bits of the upper triangle
//! column by column (graph6), or after a leading `&` the whole matrix row by row (digraph6).

use alloc::string::String;
use alloc::vec::Vec;

use super::{LARGEST, OFFSET, are_printable, bit, size};
use crate::formats::builder::{Builder, Draft};
use crate::formats::error::FormatError;
use crate::formats::words::Line;
use crate::graph::Graph;

const SHORT_COUNT: usize = 62;
pub(super) const ALLOWED: &str = "one line of graph6 or digraph6, bytes '?' to '~'";

/// Whether these bytes, without the leading `&`, are as many as the first of them demands.
pub(super) fn fits(bytes: &[u8], directed: bool) -> bool {
    let fits = |(count, rest): (usize, &[u8])| rest.len() == pair_count(count, directed).div_ceil(6);
    are_printable(bytes) && size(bytes).is_some_and(fits)
}

pub(super) fn read(line: Line<'_>) -> Result<Draft, FormatError> {
    let number = line.number;
    let (directed, code) = match line.text.strip_prefix('&') {
        Some(code) => (true, code.as_bytes()),
        None => (false, line.text.as_bytes()),
    };
    let wrong = |allowed| FormatError::unexpected(number, line.text, allowed).at(line.start);
    let read = size(code).filter(|_| are_printable(code));
    let (count, bytes) = read.ok_or_else(|| wrong(ALLOWED))?;
    let mut builder = Builder::new(directed);
    builder.declare_numbers(0, count, number)?;
    if bytes.len() != pair_count(count, directed).div_ceil(6) {
        return Err(wrong("six bits to a byte for every pair of nodes"));
    }
    for (index, (from, to)) in pairs(count, directed).enumerate() {
        if bit(bytes, index) == Some(true) {
            builder.edge(from, to, number);
        }
    }
    builder.finish(number)
}

fn pair_count(count: usize, directed: bool) -> usize {
    count.saturating_mul(if directed { count } else { count.saturating_sub(1) })
        / if directed { 1 } else { 2 }
}

fn pairs(count: usize, directed: bool) -> impl Iterator<Item = (usize, usize)> {
    (0..count).flat_map(move |slow| {
        let fast = 0..if directed { count } else { slow };
        fast.map(move |fast| if directed { (slow, fast) } else { (fast, slow) })
    })
}

pub(super) fn write(graph: &Graph) -> String {
    let count = graph.node_count();
    let bits: Vec<bool> =
        pairs(count, graph.is_directed()).map(|(from, to)| graph.has_edge(from, to)).collect();
    let mut text = String::from(if graph.is_directed() { "&" } else { "" });
    if count > SHORT_COUNT {
        text.push(char::from(LARGEST));
        text.extend([count >> 12 & 63, count >> 6 & 63].map(letter));
    }
    text.push(letter(count & 63));
    let digit =
        |chunk: &[bool]| (0..6).fold(0, |digit, bit| digit << 1 | usize::from(chunk.get(bit) == Some(&true)));
    text.extend(bits.chunks(6).map(|chunk| letter(digit(chunk))));
    text.push('\n');
    text
}

/// `digit` is below 64.
fn letter(digit: usize) -> char {
    u8::try_from(digit).map_or('~', |digit| char::from(digit + OFFSET))
}
