//! DIMACS and PACE: `c` comments, `p problem n m`, then `e u v`, `a u v` (directed) or `u v` a line.

use alloc::vec::Vec;

use crate::formats::Options;
use crate::formats::builder::{Builder, Draft};
use crate::formats::error::{FormatError, Problem};
use crate::formats::words::{Line, Word, all_lines, words};

/// Problems whose files are graphs. Those of PACE have lines `u v`.
const PROBLEMS: [&str; 14] =
    ["edge", "edges", "col", "sp", "max", "min", "tw", "td", "ds", "vc", "cep", "fvs", "hs", "mat"];

/// Whether the first line that is no comment is a line `p`.
pub(in crate::formats) fn looks_like(text: &str) -> bool {
    let is_comment =
        |line: &Line<'_>| line.text.is_empty() || line.text == "c" || line.text.starts_with("c ");
    let first = all_lines(text).find(|line| !is_comment(line));
    first.is_some_and(|line| line.text.starts_with("p ") && words(line).len() >= 4)
}

/// Problems whose edges have a direction: shortest paths and flows.
const DIRECTED: [&str; 3] = ["sp", "max", "min"];

/// Nodes and links as promised, and the line that does it.
struct Head {
    line: usize,
    directed: bool,
    nodes: usize,
    links: usize,
}

impl Head {
    fn of(said: &[Word<'_>]) -> Result<Self, FormatError> {
        const ALLOWED: &str = "`p edge n m` or another problem of DIMACS or PACE that is a graph";
        match said {
            [p, problem, nodes, links, ..] if p.text == "p" => {
                if !PROBLEMS.contains(&problem.text) {
                    return Err(problem.unexpected(ALLOWED));
                }
                let directed = DIRECTED.contains(&problem.text);
                Ok(Self {
                    line: p.line,
                    directed,
                    nodes: nodes.count(ALLOWED)?,
                    links: links.count(ALLOWED)?,
                })
            }
            [word, ..] => Err(word.unexpected(ALLOWED)),
            [] => Err(FormatError::missing(1, ALLOWED)),
        }
    }
}

pub(in crate::formats) fn read(text: &str, _: &Options<'_>) -> Result<Draft, FormatError> {
    let mut said = all_lines(text).filter(|line| !line.text.is_empty() && !is_comment(line)).map(words);
    let head = Head::of(&said.next().unwrap_or_default())?;
    let mut builder = Builder::new(head.directed);
    builder.declare_numbers(1, head.nodes, head.line)?;
    let mut found = 0;
    let mut last = head.line;
    for row in said {
        last = row.first().map_or(last, |word| word.line);
        found += usize::from(read_row(&mut builder, &row)?);
    }
    let draft = builder.finish(last)?;
    let expected = [head.links, head.links.saturating_mul(2)];
    if expected.contains(&found) || draft.network.edge_count() == head.links {
        return Ok(draft);
    }
    let problem = Problem::Count { what: "links", promised: head.links, found };
    Err(FormatError::new(head.line, problem))
}

fn is_comment(line: &Line<'_>) -> bool {
    line.text == "c" || line.text.starts_with("c ")
}

/// Whether the line is an edge. Lines `n` of nodes and `d`, `v`, `x` of their data are passed over.
fn read_row(builder: &mut Builder, row: &[Word<'_>]) -> Result<bool, FormatError> {
    let (both, ends) = match row {
        [kind, ..] if matches!(kind.text, "n" | "d" | "v" | "x") => return Ok(false),
        [kind, ends @ ..] if kind.text == "e" => (true, ends),
        [kind, ends @ ..] if kind.text == "a" => (false, ends),
        ends => (true, ends),
    };
    let ends: Vec<Word<'_>> = match ends {
        [from, to] => [*from, *to].into(),
        [from, to, weight] | [from, to, weight, _] if weight.number().is_some() => [*from, *to].into(),
        _ => {
            let word = row.first().map_or("", |word| word.text);
            let line = row.first().map_or(1, |word| word.line);
            return Err(FormatError::unexpected(line, word, "`e u v`, `a u v weight` or `u v`"));
        }
    };
    let line = ends[0].line;
    let known = |word: &Word<'_>| {
        builder
            .known(word.text, line)
            .map_err(|_| word.unexpected("a node from 1 to the number in the line p"))
    };
    let (from, to) = (known(&ends[0])?, known(&ends[1])?);
    builder.link(from, to, both, line);
    Ok(true)
}
