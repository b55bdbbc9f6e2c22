//! MatrixMarket, as `scipy.io.mmwrite` writes it.

use alloc::vec;
use alloc::vec::Vec;

use crate::formats::Options;
use crate::formats::builder::Draft;
use crate::formats::error::{FormatError, Problem};
use crate::formats::text::Said;
use crate::formats::words::{Line, Word, all_lines, words};
use crate::network::NETWORK_LIMIT;

/// Whether it begins with the banner.
pub(in crate::formats) fn looks_like(text: &str) -> bool {
    text.trim_start().get(..14).is_some_and(|start| start.eq_ignore_ascii_case("%%MatrixMarket"))
}

/// What the banner says.
struct Banner {
    /// Entries with their places, else all of them column by column.
    coordinates: bool,
    /// Entries without values: all are 1.
    pattern: bool,
    /// Only one half is there.
    half: bool,
}

impl Banner {
    fn of(line: Line<'_>) -> Result<Self, FormatError> {
        let said = words(line);
        let is = |place: usize, word: &str| {
            said.get(place).is_some_and(|said| said.text.eq_ignore_ascii_case(word))
        };
        let wrong = |allowed| Err(FormatError::unexpected(line.number, line.text, allowed));
        if !is(1, "matrix") || !(is(2, "coordinate") || is(2, "array")) {
            return wrong("%%MatrixMarket matrix coordinate or array");
        }
        if !["real", "integer", "pattern", "double"].iter().any(|kind| is(3, kind)) {
            return wrong("real, integer or pattern");
        }
        match (is(4, "symmetric"), is(4, "general")) {
            (false, false) => wrong("general or symmetric"),
            (half, _) => Ok(Self { coordinates: is(2, "coordinate"), pattern: is(3, "pattern"), half }),
        }
    }
}

/// A square of links.
struct Square {
    nodes: usize,
    links: Vec<bool>,
}

pub(in crate::formats) fn read(text: &str, options: &Options<'_>) -> Result<Draft, FormatError> {
    let mut said = all_lines(text).filter(|line| !line.text.is_empty());
    let banner = said.next().ok_or_else(|| FormatError::missing(1, "%%MatrixMarket"))?;
    let banner = Banner::of(banner)?;
    let mut rest = said.filter(|line| !line.text.starts_with('%')).map(words);
    let size = rest.next().ok_or_else(|| FormatError::missing(1, "a line with rows, columns and entries"))?;
    let line = size.first().map_or(1, |word| word.line);
    let counts = size.iter().map(|word| word.count("whole numbers of rows, columns and entries"));
    let (nodes, promised) = match (counts.collect::<Result<Vec<usize>, _>>()?.as_slice(), banner.coordinates)
    {
        (&[rows, columns, entries], true) if rows == columns => (rows, entries),
        (&[rows, columns], false) if rows == columns => (rows, all(rows, banner.half)),
        _ => {
            return Err(FormatError::missing(
                line,
                "as many rows as columns, and for coordinates the number of entries",
            ));
        }
    };
    if nodes > NETWORK_LIMIT {
        return Err(FormatError::new(line, Problem::TooManyNodes));
    }
    let mut square = Square { nodes, links: vec![false; nodes * nodes] };
    let mut found = 0;
    for row in rest {
        if found == promised {
            return Err(too_many(&row));
        }
        square.entry(&banner, &row, found, options)?;
        found += 1;
    }
    if found != promised {
        return Err(FormatError::new(line, Problem::Count { what: "entries", promised, found }));
    }
    square.draft(text, options, line)
}

/// Entries of an array.
fn all(nodes: usize, half: bool) -> usize {
    let whole = nodes.saturating_mul(nodes);
    if half { whole.saturating_add(nodes) / 2 } else { whole }
}

fn too_many(row: &[Word<'_>]) -> FormatError {
    let allowed = "as many entries as the second line promises";
    row.first().map_or(FormatError::missing(1, allowed), |word| word.unexpected(allowed))
}

impl Square {
    fn entry(
        &mut self,
        banner: &Banner,
        row: &[Word<'_>],
        index: usize,
        options: &Options<'_>,
    ) -> Result<(), FormatError> {
        let line = row.first().map_or(1, |word| word.line);
        let (place, value) = match (row, banner.coordinates, banner.pattern) {
            ([from, to], true, true) => (self.place(from, to)?, None),
            ([from, to, value], true, false) => (self.place(from, to)?, Some(value)),
            ([value], false, _) => (nth(index, self.nodes, banner.half), Some(value)),
            _ => {
                return Err(FormatError::missing(
                    line,
                    "a row, a column and a value, as the first line says",
                ));
            }
        };
        let link = value.map_or(Ok(true), |value| match value.number() {
            Some(0.0) if !banner.coordinates => Ok(false),
            Some(0.0) => Err(value.unexpected("a value other than 0: nobody can know whether 0 is a link")),
            Some(number) if banner.coordinates || options.weights || number == 1.0 => Ok(true),
            _ => {
                Err(value
                    .unexpected("0 or 1, or that weights are asked for: then any number but 0 is a link"))
            }
        })?;
        let (from, to) = place;
        self.links[from * self.nodes + to] |= link;
        self.links[to * self.nodes + from] |= link && banner.half;
        Ok(())
    }

    fn place(&self, from: &Word<'_>, to: &Word<'_>) -> Result<(usize, usize), FormatError> {
        const ALLOWED: &str = "a row and a column from 1 to their number";
        let index = |word: &Word<'_>| match word.count(ALLOWED)? {
            index if (1..=self.nodes).contains(&index) => Ok(index - 1),
            _ => Err(word.unexpected(ALLOWED)),
        };
        Ok((index(from)?, index(to)?))
    }

    fn draft(&self, text: &str, options: &Options<'_>, line: usize) -> Result<Draft, FormatError> {
        let mut builder = Said::builder(Said::of(text, options.directed)?, options.directed);
        builder.declare_numbers(0, self.nodes, line)?;
        let link = |from: usize, to: usize| self.links[from * self.nodes + to];
        for from in 0..self.nodes {
            for to in (0..self.nodes).filter(|&to| link(from, to)) {
                if !builder.is_directed() && !link(to, from) {
                    return Err(FormatError::new(line, Problem::OneSided { row: from, column: to }));
                }
                if builder.is_directed() || from <= to {
                    builder.edge(from, to, line);
                }
            }
        }
        builder.finish(line)
    }
}

/// Row and column of an entry of an array, column by column; `half`: on and below the diagonal only.
fn nth(index: usize, nodes: usize, half: bool) -> (usize, usize) {
    if !half {
        return (index % nodes.max(1), index / nodes.max(1));
    }
    let mut rest = index;
    for column in 0..nodes {
        if rest < nodes - column {
            return (column + rest, column);
        }
        rest -= nodes - column;
    }
    (0, 0)
}
