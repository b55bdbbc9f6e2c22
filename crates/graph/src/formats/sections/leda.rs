//! LEDA's native format: `LEDA.GRAPH`, two types, −1 or −2 (directed or not), nodes with labels, edges.

use crate::formats::Options;
use crate::formats::builder::{Builder, Draft};
use crate::formats::error::FormatError;
use crate::formats::words::{Line, Word, all_lines, words};

const EDGE: &str = "an edge: its two nodes, the number of its reversal, a label |{…}|";

/// Whether the first line says so.
pub(in crate::formats) fn looks_like(text: &str) -> bool {
    said(text).next().is_some_and(|line| line.text == "LEDA.GRAPH")
}

fn said(text: &str) -> impl Iterator<Item = Line<'_>> {
    all_lines(text).filter(|line| !line.text.is_empty() && !line.text.starts_with('#'))
}

pub(in crate::formats) fn read(text: &str, _: &Options<'_>) -> Result<Draft, FormatError> {
    let mut rest = said(text);
    let mut last = 1;
    let mut next = |allowed: &'static str| {
        let line = rest.next().ok_or_else(|| FormatError::unexpected(last, "", allowed))?;
        last = line.number;
        Ok::<_, FormatError>(line)
    };
    let sign = next("LEDA.GRAPH")?;
    if sign.text != "LEDA.GRAPH" {
        return Err(FormatError::unexpected(sign.number, sign.text, "LEDA.GRAPH"));
    }
    next("the type of labels of nodes")?;
    next("the type of labels of edges")?;
    let mut line = next("-1 (directed) or -2 (undirected)")?;
    let directed = match line.text {
        "-1" => true,
        "-2" => false,
        _ => return Err(FormatError::unexpected(line.number, line.text, "-1 (directed) or -2 (undirected)")),
    };
    line = next("the number of nodes")?;
    let count = number(line, "the number of nodes")?;
    let mut builder = Builder::new(directed);
    builder.declare_numbers(1, count, line.number)?;
    for node in 0..count {
        let line = next("a label |{…}| of every node")?;
        let label = line.text.strip_prefix("|{").and_then(|label| label.strip_suffix("}|"));
        let label = label
            .ok_or_else(|| FormatError::unexpected(line.number, line.text, "the label |{…}| of a node"))?;
        builder.label(node, label.trim());
    }
    let line = next("the number of edges")?;
    for _ in 0..number(line, "the number of edges")? {
        read_edge(&mut builder, next(EDGE)?)?;
    }
    // What LEDA appends for its own windows is passed over.
    builder.finish_labelled(line.number)
}

fn number(line: Line<'_>, allowed: &'static str) -> Result<usize, FormatError> {
    line.text.parse().map_err(|_| FormatError::unexpected(line.number, line.text, allowed))
}

fn read_edge(builder: &mut Builder, line: Line<'_>) -> Result<(), FormatError> {
    let said = words(line);
    let [from, to, ..] = said.as_slice() else {
        return Err(FormatError::unexpected(line.number, line.text, EDGE));
    };
    let known = |word: &Word<'_>| {
        builder.known(word.text, line.number).map_err(|_| word.unexpected("a node from 1 to their number"))
    };
    let (from, to) = (known(from)?, known(to)?);
    builder.edge(from, to, line.number);
    Ok(())
}
