//! Edge lists.

use alloc::string::String;
use alloc::vec::Vec;

use super::arrow::{arrow_of, glued};
use super::rows::{Rules, read_lines};
use super::{Said, counted, plain};
use crate::formats::builder::{Builder, Draft};
use crate::formats::error::{FormatError, Problem, WriteError, shortened};
use crate::formats::words::{Line, lines};
use crate::formats::{Named, Options, adjacency, matrix};

/// Whether it reads as one, and is no square of zeros and ones of three rows or more (such an edge list would be one link
/// between the robots 0 and 1, told several times), nor dated as only adjacency lists of networkx are.
pub(in crate::formats) fn looks_like(text: &str) -> bool {
    let is_other =
        matrix::is_square_of_bits(text) || counted::surely(text) || adjacency::is_of_networkx(text);
    !is_other
        && read(text, &Options::default())
            .is_ok_and(|draft| !draft.names.iter().any(|name| is_fraction(name)))
}

pub(in crate::formats) fn read(text: &str, options: &Options<'_>) -> Result<Draft, FormatError> {
    let mut said: Vec<Line<'_>> = lines(text).collect();
    let declared = match said.first().map(|line| line.text) {
        Some("directed") => Some(true),
        Some("undirected") => Some(false),
        _ => None,
    };
    if declared.is_some() {
        said.remove(0);
        let builder = Builder::new(options.directed.or(declared).unwrap_or(false));
        return read_lines(builder, &said, &Rules { single_names: true, ..Rules::of(options) });
    }
    refuse_one_word(&said)?;
    let builder = Said::builder(Said::of(text, options.directed)?, options.directed);
    read_lines(builder, &said, &Rules::of(options))
}

/// `0.5` or `1.0e+00`: an entry of a matrix, not a robot. `1.0` may be one, as pandas writes it.
fn is_fraction(name: &str) -> bool {
    let fraction = name.split_once('.').map(|(_, fraction)| fraction.trim_end_matches('0'));
    name.parse::<f64>().is_ok() && fraction.is_some_and(|fraction| !fraction.is_empty())
}

fn refuse_one_word(said: &[Line<'_>]) -> Result<(), FormatError> {
    match said {
        [line] if !line.text.contains([' ', '\t', ',', ';']) && glued(line.text).is_none() => {
            let word = shortened(line.text);
            Err(FormatError::new(line.number, Problem::OneWord { word }))
        }
        _ => Ok(()),
    }
}

/// A first line with the direction, then every node, then every edge.
pub(in crate::formats) fn write(named: &Named) -> Result<String, WriteError> {
    let graph = &named.graph;
    let mut text = String::from(if graph.is_directed() { "directed\n" } else { "undirected\n" });
    for name in &named.names {
        let unfit = |c: char| c.is_whitespace() || matches!(c, '#' | '\u{feff}');
        if !plain(name) || name.contains(unfit) || glued(name).is_some() || arrow_of(name).is_some() {
            return Err(WriteError::Name { name: name.clone() });
        }
        text.push_str(name);
        text.push('\n');
    }
    for (from, to) in graph.edges() {
        text.extend([named.names[from].as_str(), " ", named.names[to].as_str(), "\n"]);
    }
    Ok(text)
}
