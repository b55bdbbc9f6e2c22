//! Large Graph Layout: `# node`, then its neighbours, one a line, perhaps with a weight. Always undirected.

use crate::formats::Options;
use crate::formats::builder::{Builder, Draft};
use crate::formats::error::FormatError;
use crate::formats::text::{refuse_no_weight, refuse_strange};
use crate::formats::words::{Line, Word, all_lines, words};

/// Single words that say what a file is, and are no node.
pub(super) const COMMENTS: [&str; 12] = [
    "edges",
    "edgelist",
    "edge",
    "links",
    "graph",
    "network",
    "nodes",
    "directed",
    "undirected",
    "adjacency",
    "data",
    "weighted",
];

/// Whether the first line is `# node` and all comments are of that kind; with weights, no link may be told twice, as it would
/// be if the first comment of an edge list were taken for a node.
pub(in crate::formats) fn looks_like(text: &str) -> bool {
    let mut said = all_lines(text).filter(|line| !line.text.is_empty());
    let is_comment = |line: Line<'_>| head(line).is_some_and(|word| COMMENTS.contains(&word.text));
    let starts = said.next().is_some_and(|line| head(line).is_some() && !is_comment(line));
    let weights = all_lines(text).any(|line| !line.text.starts_with('#') && words(line).len() > 1);
    let reads = || read(text, &Options::default()).is_ok_and(|draft| !weights || draft.repeat.is_none());
    starts && said.all(|line| !line.text.starts_with('#') || head(line).is_some()) && reads()
}

/// The node of a line `# node`.
fn head(line: Line<'_>) -> Option<Word<'_>> {
    let text = line.text.strip_prefix("# ")?;
    match words(Line { text, start: line.start + 2, ..line }).as_slice() {
        [word] => Some(*word),
        _ => None,
    }
}

pub(in crate::formats) fn read(text: &str, _: &Options<'_>) -> Result<Draft, FormatError> {
    let mut builder = Builder::new(false);
    let mut from = None;
    let mut last = 1;
    for line in all_lines(text).filter(|line| !line.text.is_empty()) {
        last = line.number;
        if let Some(word) = head(line) {
            refuse_strange(&word)?;
            from = Some(builder.node(word.text, last)?);
            continue;
        }
        let said = words(line);
        let (Some(word), Some(from), true) = (said.first(), from, said.len() <= 2) else {
            return Err(FormatError::unexpected(last, line.text, "`# node`, then a neighbour of it a line"));
        };
        said.get(1).map_or(Ok(()), refuse_no_weight)?;
        refuse_strange(word)?;
        let to = builder.node(word.text, last)?;
        builder.edge(from, to, last);
    }
    builder.refuse_same_numbers(last)?;
    builder.finish_by_number(last)
}
