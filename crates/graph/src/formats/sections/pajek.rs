//! Pajek: `*Vertices n`, their labels, then `*Edges`, `*Arcs` or lists of both.

use crate::formats::Options;
use crate::formats::builder::{Builder, Draft};
use crate::formats::error::FormatError;
use crate::formats::words::{Line, Word, all_lines, words};

const NODE: &str = "a vertex from 1 to the number in the line *Vertices";

/// Whether the first line that is no comment starts with a star and a word that Pajek knows.
pub(in crate::formats) fn looks_like(text: &str) -> bool {
    said(text).next().is_some_and(|line| {
        let word = line.text.split_whitespace().next().unwrap_or("").to_ascii_lowercase();
        matches!(
            word.as_str(),
            "*vertices" | "*network" | "*edges" | "*arcs" | "*edgeslist" | "*arcslist" | "*matrix"
        )
    })
}

fn said(text: &str) -> impl Iterator<Item = Line<'_>> {
    all_lines(text).filter(|line| !line.text.is_empty() && !line.text.starts_with(['%', '#']))
}

/// What the lines of a section are.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    Before,
    Vertices,
    /// `u v weight`, or a node and its neighbours if `list`; heard at both ends if `both`.
    Links {
        both: bool,
        list: bool,
    },
}

struct Reader {
    builder: Builder,
    section: Section,
    nodes: usize,
    arcs: bool,
    edges: usize,
}

pub(in crate::formats) fn read(text: &str, _: &Options<'_>) -> Result<Draft, FormatError> {
    let mut reader =
        Reader { builder: Builder::new(false), section: Section::Before, nodes: 0, arcs: false, edges: 0 };
    let mut last = 1;
    for line in said(text) {
        last = line.number;
        if line.text.starts_with('*') {
            reader.head(line)?;
        } else {
            reader.line(line)?;
        }
    }
    reader.builder.set_directed(reader.arcs && reader.edges == 0);
    reader.builder.finish_labelled(last)
}

impl Reader {
    fn head(&mut self, line: Line<'_>) -> Result<(), FormatError> {
        let said = words(line);
        let name = said.first().map_or("", |word| word.text).to_ascii_lowercase();
        self.section = match name.as_str() {
            "*network" if self.nodes == 0 => Section::Before,
            "*vertices" if self.nodes == 0 => {
                let count =
                    said.get(1).ok_or_else(|| FormatError::missing(line.number, "the number of vertices"))?;
                self.nodes = count.count("the number of vertices")?;
                self.builder.declare_numbers(1, self.nodes, line.number)?;
                Section::Vertices
            }
            "*edges" => Section::Links { both: true, list: false },
            "*edgeslist" => Section::Links { both: true, list: true },
            "*arcs" => Section::Links { both: false, list: false },
            "*arcslist" => Section::Links { both: false, list: true },
            _ => {
                let allowed = "one graph of *Vertices, *Edges, *Arcs, *Edgeslist and *Arcslist";
                return Err(FormatError::unexpected(line.number, line.text, allowed));
            }
        };
        self.arcs |= matches!(self.section, Section::Links { both: false, .. });
        Ok(())
    }

    fn line(&mut self, line: Line<'_>) -> Result<(), FormatError> {
        let said = words(line);
        match (self.section, said.as_slice()) {
            (Section::Before, [word, ..]) => Err(word.unexpected("*Vertices and their number")),
            (Section::Vertices, [number, label @ ..]) => {
                let node = self.node(number)?;
                label.first().into_iter().for_each(|label| self.builder.label(node, label.text));
                Ok(())
            }
            (Section::Links { both, list: false }, [from, to] | [from, to, _, ..]) => {
                let (start, end) = (self.node(from)?, self.node(to)?);
                self.link(start, end, both, line.number);
                Ok(())
            }
            (Section::Links { both, list: true }, [from, rest @ ..]) => {
                let start = self.node(from)?;
                rest.iter().try_for_each(|to| {
                    let end = self.node(to)?;
                    self.link(start, end, both, line.number);
                    Ok(())
                })
            }
            (_, _) => Err(FormatError::unexpected(line.number, line.text, "the numbers of two vertices")),
        }
    }

    fn link(&mut self, from: usize, to: usize, both: bool, line: usize) {
        self.edges += usize::from(both);
        self.builder.link(from, to, both, line);
    }

    fn node(&self, word: &Word<'_>) -> Result<usize, FormatError> {
        let number = word.count(NODE)?;
        if (1..=self.nodes).contains(&number) { Ok(number - 1) } else { Err(word.unexpected(NODE)) }
    }
}
