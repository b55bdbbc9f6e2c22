//! Adjacency lists: a node and its neighbours a line, as `networkx.write_adjlist` has them.

use alloc::vec::Vec;

use crate::formats::Options;
use crate::formats::builder::Draft;
use crate::formats::error::FormatError;
use crate::formats::index::Index;
use crate::formats::text::{Said, refuse_strange};
use crate::formats::words::{Line, Separator, Word, lines};

/// Whether every node begins exactly one line, and somebody has two neighbours or networkx says that it wrote it. Lines of two
/// names and of one are not enough: they may be an edge list that was cut off.
pub(in crate::formats) fn looks_like(text: &str) -> bool {
    let mut heads = Index::default();
    // Most texts that are none of this name a node twice within a few lines.
    if !rows(text).all(|row| row.first().is_none_or(|first| heads.insert(head(first), 0))) {
        return false;
    }
    let mut neighbours = rows(text).flat_map(|row| row.into_iter().skip(1));
    let complete = neighbours.all(|word| heads.get(word.text).is_some());
    let shape = rows(text).any(|row| row.len() > 2) || super::is_of_networkx(text);
    let title = |row: &Vec<Word<'_>>| row.len() == 1 && super::lgl::COMMENTS.contains(&head(&row[0]));
    complete && shape && !rows(text).any(|row| title(&row)) && read(text, &Options::default()).is_ok()
}

/// The head of a line may end with a colon.
fn head<'a>(word: &Word<'a>) -> &'a str {
    word.text.strip_suffix(':').unwrap_or(word.text)
}

fn rows(text: &str) -> impl Iterator<Item = Vec<Word<'_>>> {
    let said: Vec<Line<'_>> = lines(text).collect();
    let separator = Separator::of(&said);
    said.into_iter().map(move |line| separator.words(line))
}

pub(in crate::formats) fn read(text: &str, options: &Options<'_>) -> Result<Draft, FormatError> {
    let said = Said::of(text, options.directed)?;
    let mut builder = Said::builder(said, options.directed).told_from_both_ends();
    let mut last = 1;
    for row in rows(text) {
        let Some((first, neighbours)) = row.split_first() else {
            continue;
        };
        last = first.line;
        let first = Word { text: head(first), ..*first };
        refuse_strange(&first)?;
        let from = builder.node(first.text, last)?;
        for word in neighbours {
            refuse_strange(word)?;
            let to = builder.node(word.text, last).map_err(|error| error.at(word.at))?;
            builder.edge(from, to, last);
        }
    }
    builder.refuse_same_numbers(last)?;
    builder.finish_by_number(last)
}
