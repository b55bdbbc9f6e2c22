//! Adjacency matrices.

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::Named;
use super::builder::Builder;
use super::error::{FormatError, Problem};
use crate::graph::Graph;
use crate::set::NODE_LIMIT;

/// A line of the text and its number.
type Line<'a> = (usize, &'a str);

fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    let numbered = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    numbered.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
}

fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| c.is_whitespace() || matches!(c, ',' | ';')).filter(|word| !word.is_empty())
}

/// Whether this is a square of 0 and 1 of three rows or more: two rows may as well be two edges.
pub(super) fn looks_like(text: &str) -> bool {
    let rows = || lines(text).filter(|(_, line)| *line != "directed").take(NODE_LIMIT + 1);
    let count = rows().count();
    let is_row = |line: &str| words(line).count() == count && words(line).all(|word| entry(word).is_some());
    count > 2 && rows().all(|(_, line)| is_row(line))
}

pub(super) fn read(text: &str, directed: Option<bool>) -> Result<Named, FormatError> {
    let mut rows: Vec<Line<'_>> = lines(text).take(NODE_LIMIT + 2).collect();
    let mut said = None;
    if let Some((_, word @ ("directed" | "undirected"))) = rows.first() {
        said = Some(*word == "directed");
        rows.remove(0);
    }
    let last = rows.last().map_or(1, |(line, _)| *line);
    let mut builder = Builder::new(directed.or(said).unwrap_or(false));
    for (index, (line, _)) in rows.iter().enumerate() {
        builder.declare(&index.to_string(), *line)?;
    }
    let entries: Vec<Vec<bool>> =
        rows.iter().map(|row| read_row(*row, rows.len())).collect::<Result<_, _>>()?;
    for (row, &(line, _)) in rows.iter().enumerate() {
        read_edges(&mut builder, &entries, row, line)?;
    }
    builder.finish(last)
}

fn read_row((line, content): Line<'_>, count: usize) -> Result<Vec<bool>, FormatError> {
    let wrong = |found: &str| FormatError::unexpected(line, found, "as many entries in every row as rows");
    let mut row = Vec::new();
    for word in words(content) {
        if row.len() == count {
            return Err(wrong(word));
        }
        row.push(entry(word).ok_or_else(|| FormatError::unexpected(line, word, "0 or 1"))?);
    }
    if row.len() < count { Err(wrong(content)) } else { Ok(row) }
}

/// Zero or one, however numpy writes it.
fn entry(word: &str) -> Option<bool> {
    let value: f64 = word.parse().ok()?;
    if value.abs() <= 0.0 {
        return Some(false);
    }
    ((value - 1.0).abs() <= 0.0).then_some(true)
}

fn read_edges(
    builder: &mut Builder,
    entries: &[Vec<bool>],
    row: usize,
    line: usize,
) -> Result<(), FormatError> {
    let ones = entries[row].iter().enumerate().filter(|(_, one)| **one);
    for (column, _) in ones {
        if !builder.is_directed() && !entries[column][row] {
            return Err(FormatError { line, problem: Problem::OneSided { row, column } });
        }
        if builder.is_directed() || row <= column {
            builder.edge(row, column, line)?;
        }
    }
    Ok(())
}

pub(super) fn write(graph: &Graph) -> String {
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
