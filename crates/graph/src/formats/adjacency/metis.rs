//! METIS: `n m [fmt [ncon]]`, then the neighbours of node 1, 2, … one line each; `%` begins comments.

use alloc::vec::Vec;

use crate::formats::Options;
use crate::formats::builder::{Builder, Draft};
use crate::formats::error::{FormatError, Problem};
use crate::formats::words::{Line, Word, all_lines, words};
use crate::network::NETWORK_LIMIT;

/// Whether it reads as one with a link or more. The counts and that both ends name each other make that sure enough.
pub(in crate::formats) fn looks_like(text: &str) -> bool {
    Head::of(text).is_ok_and(|(head, _)| head.links > 0) && read(text, &Options::default()).is_ok()
}

struct Head {
    line: usize,
    nodes: usize,
    links: usize,
    /// Words before the neighbours of a node: sizes and weights of the node.
    before: usize,
    /// Words to a neighbour: 2 if links have weights.
    stride: usize,
}

impl Head {
    /// The head and the lines after it, empty ones too.
    fn of(text: &str) -> Result<(Self, Vec<Line<'_>>), FormatError> {
        const ALLOWED: &str = "a first line with the numbers of nodes and of links";
        let mut rest = all_lines(text).filter(|line| !line.text.starts_with('%'));
        let first = rest.find(|line| !line.text.is_empty());
        let Some(line) = first else {
            return Err(FormatError::missing(1, ALLOWED));
        };
        let said = words(line);
        let (Some(nodes), Some(links), true) = (said.first(), said.get(1), said.len() <= 4) else {
            return Err(FormatError::unexpected(line.number, line.text, ALLOWED));
        };
        let format = said.get(2).map_or("0", |word| word.text);
        let flag = |place: usize| format.bytes().rev().nth(place) == Some(b'1');
        if format.len() > 3 || format.bytes().any(|digit| !matches!(digit, b'0' | b'1')) {
            return Err(FormatError::unexpected(
                line.number,
                format,
                "three digits 0 or 1 as the format of METIS",
            ));
        }
        let weights = said.get(3).map_or(Ok(1), |word| word.count("the number of weights of a node"))?;
        let before = usize::from(flag(2)) + if flag(1) { weights } else { 0 };
        let stride = 1 + usize::from(flag(0));
        let (nodes, links) = (nodes.count(ALLOWED)?, links.count(ALLOWED)?);
        Ok((Self { line: line.number, nodes, links, before, stride }, rest.collect()))
    }
}

pub(in crate::formats) fn read(text: &str, _: &Options<'_>) -> Result<Draft, FormatError> {
    let (head, rest) = Head::of(text)?;
    if head.nodes > NETWORK_LIMIT {
        return Err(FormatError::new(head.line, Problem::TooManyNodes));
    }
    let surplus = rest.iter().skip(head.nodes).find(|line| !line.text.is_empty());
    if let Some(line) = surplus {
        return Err(FormatError::unexpected(line.number, line.text, "as many lines as nodes"));
    }
    if rest.len() < head.nodes {
        let problem = Problem::Count { what: "nodes", promised: head.nodes, found: rest.len() };
        return Err(FormatError::new(head.line, problem));
    }
    let mut builder = Builder::new(false).told_from_both_ends();
    builder.declare_numbers(1, head.nodes, head.line)?;
    let listed = neighbours(&head, &rest)?;
    for &(from, to, word) in &listed {
        builder.edge(from, to, word.line);
    }
    let mut pairs: Vec<(usize, usize)> = listed.iter().map(|(from, to, _)| (*from, *to)).collect();
    pairs.sort_unstable();
    let is_told = |pair: (usize, usize)| pairs.binary_search(&pair).is_ok();
    if let Some((_, _, word)) = listed.iter().find(|(from, to, _)| !is_told((*to, *from))) {
        return Err(word.unexpected("a neighbour in whose line this node is too"));
    }
    if listed.len() != head.links.saturating_mul(2) {
        let problem = Problem::Count { what: "links", promised: head.links, found: listed.len() / 2 };
        return Err(FormatError::new(head.line, problem));
    }
    builder.finish(head.line)
}

/// Every neighbour named: of which node, which, and where. Nodes are counted from 0 here.
fn neighbours<'a>(head: &Head, rest: &[Line<'a>]) -> Result<Vec<(usize, usize, Word<'a>)>, FormatError> {
    const ALLOWED: &str = "the number of a node, from 1 to the number in the first line";
    let mut listed = Vec::new();
    for (from, line) in rest.iter().take(head.nodes).enumerate() {
        let said = words(*line);
        for word in said.iter().skip(head.before).step_by(head.stride) {
            let to = word.count(ALLOWED)?;
            if !(1..=head.nodes).contains(&to) {
                return Err(word.unexpected(ALLOWED));
            }
            listed.push((from, to - 1, *word));
        }
    }
    Ok(listed)
}
