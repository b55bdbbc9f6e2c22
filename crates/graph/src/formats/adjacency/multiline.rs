//! Adjacency lists of many lines: `networkx.write_multiline_adjlist`.
//!
//! ```text
//! # comment
//! a 2        a node and how many lines of neighbours follow
//! b {}       a neighbour and what is known of the link, which is passed over
//! c {}
//! ```

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use crate::formats::Options;
use crate::formats::builder::Draft;
use crate::formats::error::{FormatError, Problem};
use crate::formats::text::{Said, refuse_strange};
use crate::formats::words::{Line, Word, all_lines, lines, words};

/// A node with its neighbours.
type Block<'a> = (Word<'a>, Vec<Word<'a>>);

/// Whether it reads as one, every node begins one block, and it has a mark of networkx: braces or a date.
pub(in crate::formats) fn looks_like(text: &str) -> bool {
    let Ok(blocks) = blocks(text) else {
        return false;
    };
    let heads: BTreeSet<&str> = blocks.iter().map(|(head, _)| head.text).collect();
    let mut neighbours = blocks.iter().flat_map(|(_, neighbours)| neighbours);
    let complete = heads.len() == blocks.len() && neighbours.all(|word| heads.contains(word.text));
    let data = all_lines(text).any(|line| line.text.ends_with('}'));
    !blocks.is_empty() && complete && (data || super::is_of_networkx(text))
}

fn blocks(text: &str) -> Result<Vec<Block<'_>>, FormatError> {
    const ALLOWED: &str = "a node and its number of neighbours";
    let mut blocks = Vec::new();
    let mut rest = lines(text);
    while let Some(line) = rest.next() {
        let (head, count) = match words(line).as_slice() {
            [head, count] => (*head, count.count(ALLOWED)?),
            _ => return Err(FormatError::unexpected(line.number, line.text, ALLOWED)),
        };
        let mut neighbours = Vec::new();
        for found in 0..count {
            let Some(line) = rest.next() else {
                let problem = Problem::Count { what: "neighbours", promised: count, found };
                return Err(FormatError::new(line.number, problem));
            };
            neighbours.push(neighbour(line)?);
        }
        blocks.push((head, neighbours));
    }
    Ok(blocks)
}

fn neighbour(line: Line<'_>) -> Result<Word<'_>, FormatError> {
    match words(line).as_slice() {
        [name] => Ok(*name),
        [name, data] if data.text.starts_with('{') => Ok(*name),
        [_, more, ..] => Err(more.unexpected("a neighbour, and perhaps {…} behind it")),
        [] => Err(FormatError::missing(line.number, "a neighbour")),
    }
}

pub(in crate::formats) fn read(text: &str, options: &Options<'_>) -> Result<Draft, FormatError> {
    let said = Said::of(text, options.directed)?;
    let mut builder = Said::builder(said, options.directed).told_from_both_ends();
    let mut last = 1;
    for (head, neighbours) in blocks(text)? {
        refuse_strange(&head)?;
        let from = builder.node(head.text, head.line)?;
        last = head.line;
        for word in neighbours {
            refuse_strange(&word)?;
            last = word.line;
            let to = builder.node(word.text, last)?;
            builder.edge(from, to, last);
        }
    }
    builder.finish_by_number(last)
}
