//! Trivial Graph Format of yEd: nodes with labels, a line `#`, edges with labels.

use crate::formats::Options;
use crate::formats::builder::Draft;
use crate::formats::error::FormatError;
use crate::formats::text::Said;
use crate::formats::words::{Line, all_lines};

/// Whether a line `#` stands alone behind lines of nodes, and all edges are between those.
pub(in crate::formats) fn looks_like(text: &str) -> bool {
    let mut said = all_lines(text).filter(|line| !line.text.is_empty());
    let starts = said.next().is_some_and(|line| !line.text.starts_with(['#', '%']));
    starts && said.any(|line| line.text == "#") && read(text, &Options::default()).is_ok()
}

/// The first word, where it begins, and the rest.
fn split(line: Line<'_>) -> (&str, &str) {
    let (first, rest) = line.text.split_once(char::is_whitespace).unwrap_or((line.text, ""));
    (first, rest.trim())
}

pub(in crate::formats) fn read(text: &str, options: &Options<'_>) -> Result<Draft, FormatError> {
    let mut builder = Said::builder(None, options.directed);
    let mut said = all_lines(text).filter(|line| !line.text.is_empty());
    let mut last = 1;
    let mut ended = false;
    for line in said.by_ref() {
        last = line.number;
        ended = line.text == "#";
        if ended {
            break;
        }
        let (id, label) = split(line);
        let node = builder.declare(id, last)?;
        builder.label(node, label);
    }
    if !ended {
        return Err(FormatError::missing(last, "a line `#` between nodes and edges"));
    }
    for line in said {
        last = line.number;
        let (from, rest) = split(line);
        let (to, _) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
        if to.is_empty() {
            return Err(FormatError::unexpected(last, line.text, "two nodes"));
        }
        let (from, to) = (builder.known(from, last)?, builder.known(to, last)?);
        builder.edge(from, to, last);
    }
    builder.finish_labelled(last)
}
