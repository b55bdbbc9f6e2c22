//! graph6 and digraph6: six bits to a printable byte.
//!
//! Format of B. McKay's nauty: n as one byte `n + 63` up to 62, else `~` and three bytes; then the bits of the upper triangle
//! column by column (graph6), or after a leading `&` the whole matrix row by row (digraph6).

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::Named;
use super::builder::Builder;
use super::error::FormatError;
use crate::graph::Graph;

const OFFSET: u8 = 63;
const LARGEST: u8 = 126;
const SHORT_COUNT: usize = 62;
const ALLOWED: &str = "one line of graph6 or digraph6, bytes '?' to '~'";

/// One line without blanks, of the length that its first byte demands.
pub(super) fn looks_like(text: &str) -> bool {
    let line = text.trim();
    let fits = |(count, rest): (usize, &[u8])| rest.len() == pair_count(count, false).div_ceil(6);
    line.bytes().all(|byte| (OFFSET..=LARGEST).contains(&byte)) && size(line.as_bytes()).is_some_and(fits)
}

pub(super) fn read(text: &str) -> Result<Named, FormatError> {
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let Some((index, line)) = lines.next() else {
        return Err(FormatError::unexpected(1, "", ALLOWED));
    };
    if let Some((index, second)) = lines.next() {
        return Err(FormatError::unexpected(index + 1, second, "one graph only"));
    }
    let line = line.trim();
    let line = line.strip_prefix(">>graph6<<").or(line.strip_prefix(">>digraph6<<")).unwrap_or(line);
    read_line(line, index + 1)
}

fn read_line(text: &str, line: usize) -> Result<Named, FormatError> {
    let (directed, code) = match text.strip_prefix('&') {
        Some(code) => (true, code),
        None => (false, text),
    };
    let bad = |byte: &u8| !(OFFSET..=LARGEST).contains(byte);
    if code.bytes().any(|byte| bad(&byte)) {
        return Err(FormatError::unexpected(line, text, ALLOWED));
    }
    let Some((count, bytes)) = size(code.as_bytes()) else {
        return Err(FormatError::unexpected(line, text, ALLOWED));
    };
    let mut builder = Builder::new(directed);
    for node in 0..count {
        builder.declare(&node.to_string(), line)?;
    }
    if bytes.len() != pair_count(count, directed).div_ceil(6) {
        return Err(FormatError::unexpected(line, text, "six bits to a byte for every pair of nodes"));
    }
    let bit = |index: usize| (bytes[index / 6] - OFFSET) >> (5 - index % 6) & 1 == 1;
    for (index, (from, to)) in pairs(count, directed).enumerate() {
        if bit(index) {
            builder.edge(from, to, line)?;
        }
    }
    builder.finish(line)
}

/// The number of nodes and the bytes after it. Above 258 047 nodes, with eight bytes, it is none that we could read.
fn size(bytes: &[u8]) -> Option<(usize, &[u8])> {
    match bytes {
        [LARGEST, high, middle, low, rest @ ..] if *high < LARGEST => {
            let digit = |byte: &u8| usize::from(byte.saturating_sub(OFFSET));
            Some((digit(high) << 12 | digit(middle) << 6 | digit(low), rest))
        }
        [LARGEST, ..] | [] => None,
        [count, rest @ ..] => Some((usize::from(count.saturating_sub(OFFSET)), rest)),
    }
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
