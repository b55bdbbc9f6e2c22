//! Edge lists whose first line has the numbers of nodes and of links.

use alloc::vec::Vec;

use super::Said;
use super::rows::{Rules, read_lines};
use crate::formats::Options;
use crate::formats::builder::{Builder, Draft};
use crate::formats::error::{FormatError, Problem};
use crate::formats::words::{Line, Word, lines, words};

/// Whether the counts in the first line are right.
pub(in crate::formats) fn looks_like(text: &str) -> bool {
    let said: Vec<Line<'_>> = lines(text).collect();
    Head::of(&said).is_ok_and(|head| head.links > 0) && read(text, &Options::default()).is_ok()
}

/// Whether this can be nothing else: as a plain edge list its first line would be a loop, or name a node that no other
/// line has and leave a gap in the numbers, which have none without it.
pub(in crate::formats) fn surely(text: &str) -> bool {
    let said: Vec<Line<'_>> = lines(text).collect();
    let Ok(head) = Head::of(&said) else {
        return false;
    };
    if said.len() != head.links.saturating_add(1) {
        return false;
    }
    let inner = numbers(said.get(1..).unwrap_or(&[]));
    let all = numbers(&said);
    let strange_first = head.nodes == head.links || (!inner.contains(&head.links) && !is_gapless(&all));
    strange_first && inner.len() == head.nodes && is_gapless(&inner) && looks_like(text)
}

/// The names in the first two columns that are numbers, each once, in order.
fn numbers(said: &[Line<'_>]) -> Vec<usize> {
    let words = said.iter().flat_map(ends);
    let mut numbers: Vec<usize> = words.filter_map(|word| word.text.parse().ok()).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// The first two words of a line.
fn ends<'a>(line: &Line<'a>) -> Vec<Word<'a>> {
    words(*line).into_iter().take(2).collect()
}

fn is_gapless(numbers: &[usize]) -> bool {
    numbers.windows(2).all(|pair| pair[1] - pair[0] == 1)
}

struct Head {
    nodes: usize,
    links: usize,
}

impl Head {
    fn of(said: &[Line<'_>]) -> Result<Self, FormatError> {
        const ALLOWED: &str = "a first line with the numbers of nodes and of links";
        let Some(&line) = said.first() else {
            return Err(FormatError::missing(1, ALLOWED));
        };
        match words(line).as_slice() {
            [nodes, links] => Ok(Self { nodes: nodes.count(ALLOWED)?, links: links.count(ALLOWED)? }),
            [.., last] => Err(last.unexpected(ALLOWED)),
            [] => Err(FormatError::missing(line.number, ALLOWED)),
        }
    }
}

pub(in crate::formats) fn read(text: &str, options: &Options<'_>) -> Result<Draft, FormatError> {
    let said: Vec<Line<'_>> = lines(text).collect();
    let head = Head::of(&said)?;
    let edges = said.get(1..).unwrap_or(&[]);
    let first = said.first().map_or(1, |line| line.number);
    if edges.len() != head.links {
        let problem = Problem::Count { what: "links", promised: head.links, found: edges.len() };
        return Err(FormatError::new(first, problem));
    }
    let start = numbered_from(edges, head.nodes)?;
    let mut builder: Builder = Said::builder(Said::of(text, options.directed)?, options.directed);
    builder.declare_numbers(start, head.nodes, first)?;
    read_lines(builder, edges, &Rules { asked: options.directed, single_names: false, header: false })
}

/// Nodes are numbered from 0, or from 1 if `nodes` itself is named and 0 is not.
fn numbered_from(edges: &[Line<'_>], nodes: usize) -> Result<usize, FormatError> {
    let ends: Vec<Word<'_>> = edges.iter().flat_map(ends).collect();
    let mut has_zero = false;
    let mut has_last = None;
    for word in &ends {
        let number = word.count("the number of a node, as the first line is a line of counts")?;
        if number > nodes {
            return Err(word.unexpected("a number up to that of the nodes in the first line"));
        }
        has_zero |= number == 0;
        has_last = has_last.or((number == nodes).then_some(*word));
    }
    match has_last {
        Some(word) if has_zero => {
            Err(word.unexpected("a number below that of the nodes, as there is a node 0"))
        }
        None if has_zero => Ok(0),
        _ => Ok(1),
    }
}
