//! Adjacency matrices: as text, with or without names, and as MatrixMarket.

mod entry;
mod layout;
pub(super) mod market;

use alloc::string::String;
use alloc::vec::Vec;

use super::builder::{Builder, Draft};
use super::error::{FormatError, Problem};
use super::text::{Said, refuse_strange};
use super::words::{Line, Separator, Word, lines};
use super::{Named, Options};
use crate::graph::set::NODE_LIMIT;
use entry::Entry;
use layout::Layout;

/// The direction that a first line of its own says, and the rows.
fn rows(text: &str) -> (Option<bool>, Vec<Vec<Word<'_>>>) {
    // One more row than a header and the largest graph have shows that there are too many.
    let mut said: Vec<Line<'_>> = lines(text).take(NODE_LIMIT + 3).collect();
    let declared = match said.first().map(|line| line.text) {
        Some("directed") => Some(true),
        Some("undirected") => Some(false),
        _ => None,
    };
    said.drain(..usize::from(declared.is_some()));
    let separator = Separator::of(&said);
    (declared, said.into_iter().map(|line| separator.words(line)).collect())
}

/// Whether it is a square of zeros and ones or truth values, perhaps with names around; or one of other numbers without
/// names, with a diagonal of zeros or symmetric (of two rows both, as two rows are edges more often). Names on one side only need three nodes, as two
/// rows would be edges.
pub(super) fn looks_like(text: &str) -> bool {
    let (_, rows) = rows(text);
    let Some(layout) = Layout::of(&rows) else {
        return false;
    };
    let entries = layout.entries(&rows);
    let parsed: Option<Vec<Vec<Entry>>> =
        entries.iter().map(|row| row.iter().map(|word| Entry::of(word.text)).collect()).collect();
    parsed.is_some_and(|entries| match layout.sides_named() {
        0 if layout.nodes == 2 => entry::are_bits(&entries) || entry::are_counts_of_two(&entries),
        0 => layout.nodes > 2 && (entry::are_bits(&entries) || entry::is_likely(&entries)),
        1 => layout.nodes > 2 && entry::are_bits(&entries),
        _ => layout.nodes > 1 && entry::are_bits(&entries),
    })
}

/// Whether the widths of its rows make a square, and more than half of what is in it are numbers or truth values.
pub(super) fn is_square(text: &str) -> bool {
    let (_, rows) = rows(text);
    Layout::of(&rows).is_some_and(|layout| {
        let words: Vec<&Word<'_>> = layout.entries(&rows).into_iter().flatten().collect();
        words.iter().filter(|word| Entry::of(word.text).is_some()).count() * 2 > words.len()
    })
}

/// Whether it is a square of zeros and ones of three rows or more, perhaps with names above.
pub(super) fn is_square_of_bits(text: &str) -> bool {
    let (_, rows) = rows(text);
    let is_bit = |word: &Word<'_>| Entry::of(word.text).is_some_and(Entry::is_bit);
    let start = usize::from(rows.first().is_some_and(|first| !first.iter().all(is_bit)));
    let square = rows.get(start..).unwrap_or(&[]);
    square.len() > 2 && square.iter().all(|row| row.len() == square.len() && row.iter().all(is_bit))
}

pub(super) fn read(text: &str, options: &Options<'_>) -> Result<Draft, FormatError> {
    let (declared, rows) = rows(text);
    let asked = options.directed.or(declared);
    let mut builder = Said::builder(Said::of(text, asked)?, asked);
    let first = rows.first().and_then(|row| row.first()).map_or(1, |word| word.line);
    if rows.is_empty() {
        return Err(FormatError::new(first, Problem::NoNodes));
    }
    let layout = Layout::of(&rows).ok_or_else(|| layout::complaint(&rows))?;
    declare(&mut builder, &layout, &rows)?;
    let entries = layout.entries(&rows);
    let links: Vec<Vec<bool>> =
        entries.iter().map(|row| links(row, options.weights)).collect::<Result<_, _>>()?;
    for (from, row) in links.iter().enumerate() {
        let line = entries[from].first().map_or(first, |word| word.line);
        read_row(&mut builder, &links, (from, row), line)?;
    }
    let last = entries.last().and_then(|row| row.first()).map_or(first, |word| word.line);
    builder.finish(last)
}

fn declare(builder: &mut Builder, layout: &Layout, rows: &[Vec<Word<'_>>]) -> Result<(), FormatError> {
    for (node, row) in rows.iter().skip(layout.head).enumerate() {
        let line = row.first().map_or(1, |word| word.line);
        match layout.name(rows, node)? {
            Some(name) => {
                refuse_strange(&name)?;
                builder.declare(name.text, line)?;
            }
            None => builder.declare_numbers(node, 1, line)?,
        }
    }
    Ok(())
}

fn links(row: &[Word<'_>], weights: bool) -> Result<Vec<bool>, FormatError> {
    let link = |word: &Word<'_>| match Entry::of(word.text) {
        Some(entry) if weights || entry.is_bit() => Ok(entry.is_link()),
        Some(_) => {
            Err(word.unexpected("0 or 1, or that weights are asked for: then any number but 0 is a link"))
        }
        None => Err(word.unexpected("0 or 1")),
    };
    row.iter().map(link).collect()
}

fn read_row(
    builder: &mut Builder,
    links: &[Vec<bool>],
    (from, row): (usize, &[bool]),
    line: usize,
) -> Result<(), FormatError> {
    for (to, _) in row.iter().enumerate().filter(|(_, link)| **link) {
        if !builder.is_directed() && !links[to][from] {
            return Err(FormatError::new(line, Problem::OneSided { row: from, column: to }));
        }
        if builder.is_directed() || from <= to {
            builder.edge(from, to, line);
        }
    }
    Ok(())
}

pub(super) fn write(named: &Named) -> String {
    let graph = &named.graph;
    let mut text = String::from(if graph.is_directed() { "directed\n" } else { "" });
    for from in 0..graph.node_count() {
        for to in 0..graph.node_count() {
            text.push_str(if to > 0 { "," } else { "" });
            text.push(if graph.has_edge(from, to) { '1' } else { '0' });
        }
        text.push('\n');
    }
    text
}
