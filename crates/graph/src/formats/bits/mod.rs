//! graph6, digraph6 and sparse6: a graph is a line of printable bytes, and a file may have many.

mod graph6;
mod sparse6;

use alloc::string::String;

use super::builder::Draft;
use super::error::{FormatError, Problem};
use super::note::Note;
use super::words::{Line, all_lines};
use super::{Named, Options};

/// Six bits to a byte: '?' is 0, '~' is 63.
const OFFSET: u8 = 63;
const LARGEST: u8 = 126;

/// Headers that may stand before the first graph, on its line or on a line of their own.
const HEADERS: [&str; 3] = [">>graph6<<", ">>digraph6<<", ">>sparse6<<"];

/// Whether every line is of these bytes and of the length that its first bytes demand, or the text begins with a header.
pub(super) fn looks_like(text: &str) -> bool {
    let headed = HEADERS.iter().any(|header| text.trim_start().starts_with(header));
    let mut graphs = graphs(text).peekable();
    headed || (graphs.peek().is_some() && graphs.all(|line| fits(line.text)))
}

fn fits(line: &str) -> bool {
    match line.as_bytes() {
        [b':', rest @ ..] => sparse6::fits(rest),
        [b'&', rest @ ..] => graph6::fits(rest, true),
        rest => graph6::fits(rest, false),
    }
}

/// The lines that are graphs, without headers.
fn graphs(text: &str) -> impl Iterator<Item = Line<'_>> {
    all_lines(text).map(without_header).filter(|line| !line.text.is_empty())
}

fn without_header(line: Line<'_>) -> Line<'_> {
    let text = HEADERS.iter().find_map(|header| line.text.strip_prefix(header)).unwrap_or(line.text);
    Line { text, start: line.start + line.text.len() - text.len(), ..line }
}

pub(super) fn read(text: &str, options: &Options<'_>) -> Result<Draft, FormatError> {
    let count = graphs(text).count();
    let chosen = options.which.unwrap_or(1);
    let second = graphs(text).nth(1).map_or(1, |line| line.number);
    if count > 1 && options.which.is_none() || count > 0 && !(1..=count).contains(&chosen) {
        let line = if count > 1 { second } else { 1 };
        return Err(FormatError::new(line, Problem::Which { graphs: count }));
    }
    let Some(line) = graphs(text).nth(chosen.saturating_sub(1)) else {
        return Err(FormatError::unexpected(1, "", graph6::ALLOWED));
    };
    let mut draft = match line.text.as_bytes() {
        [b':', rest @ ..] => sparse6::read(line, rest),
        _ => graph6::read(line),
    }?;
    draft.notes.extend((count > 1).then_some(Note::Which { graph: chosen, graphs: count }));
    Ok(draft)
}

pub(super) fn write(named: &Named) -> String {
    graph6::write(&named.graph)
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

fn are_printable(bytes: &[u8]) -> bool {
    bytes.iter().all(|byte| (OFFSET..=LARGEST).contains(byte))
}

/// A bit of the six in each byte, the highest first; nothing behind the end.
fn bit(bytes: &[u8], index: usize) -> Option<bool> {
    bytes.get(index / 6).map(|byte| byte.saturating_sub(OFFSET) >> (5 - index % 6) & 1 == 1)
}
