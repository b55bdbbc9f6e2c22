//! Rows of edges: two names, perhaps a sign between them and a weight behind them, or columns under a header.

use alloc::vec::Vec;

use super::arrow::{arrow_of, glued, read_arrow};
use super::header::{self, Columns};
use super::name::{ends, refuse_strange};
use crate::formats::Options;
use crate::formats::builder::{Builder, Draft};
use crate::formats::error::{FormatError, Problem, shortened};
use crate::formats::note::Note;
use crate::formats::words::{Line, Separator, Word};

/// The words of a line.
type Row<'a> = Vec<Word<'a>>;

/// What is allowed beyond two names a line.
pub(super) struct Rules {
    pub(super) asked: Option<bool>,
    pub(super) single_names: bool,
    pub(super) header: bool,
}

impl Rules {
    pub(super) fn of(options: &Options<'_>) -> Self {
        Self { asked: options.directed, single_names: false, header: true }
    }
}

/// Reads the lines of edges into `builder`.
pub(super) fn read_lines(
    mut builder: Builder,
    said: &[Line<'_>],
    rules: &Rules,
) -> Result<Draft, FormatError> {
    let separator = Separator::of(said);
    let first = said.first().map(|&line| separator.words(line)).unwrap_or_default();
    let others = || said.iter().skip(1).map(move |&line| separator.words(line));
    let columns = if rules.single_names || !rules.header { None } else { header::find(&first, others) };
    if let (Some(columns), Some(line)) = (columns, said.first()) {
        builder.note(Note::Header { line: line.number, text: shortened(line.text) });
        let used = 2 + usize::from(columns.kind.is_some()) + usize::from(columns.weight.is_some());
        builder.notes_columns(first.len().saturating_sub(used));
    }
    // Rows are taken apart again in each pass: all of them at once would take ten times the memory of the text.
    let rows = || said.iter().skip(usize::from(columns.is_some())).map(move |&line| separator.words(line));
    let width = refuse_unequal(rows(), rules)?;
    if width > 2 {
        refuse_mixed_weights(rows)?;
    }
    for row in rows() {
        match columns {
            Some(columns) => read_columns(&mut builder, &row, columns)?,
            None => read_row(&mut builder, &row, rules)?,
        }
    }
    let last = said.last().map_or(1, |line| line.number);
    if !rules.single_names {
        builder.refuse_same_numbers(last)?;
    }
    builder.finish_by_number(last)
}

/// Every line has as many columns as the first one, and so many are told; a single name may stand alone where that is allowed.
fn refuse_unequal<'a>(rows: impl Iterator<Item = Row<'a>>, rules: &Rules) -> Result<usize, FormatError> {
    let mut rows = rows.filter(|row| !(rules.single_names && row.len() == 1));
    let Some(first) = rows.next() else {
        return Ok(0);
    };
    let line = |row: &Row<'_>| row.first().map_or(1, |word| word.line);
    match rows.find(|row| row.len() != first.len()) {
        Some(row) => {
            let problem = Problem::Columns { found: row.len(), first_line: line(&first), first: first.len() };
            Err(FormatError::new(line(&row), problem))
        }
        None => Ok(first.len()),
    }
}

/// Behind two names all lines have a number, or all have `{…}`.
fn refuse_mixed_weights<'a, I: Iterator<Item = Row<'a>>>(rows: impl Fn() -> I) -> Result<(), FormatError> {
    let is_data = |word: &Word<'_>| word.text.starts_with('{');
    let third = || rows().filter_map(|row| row.get(2).copied());
    match (third().any(|word| is_data(&word)), third().find(|word| !is_data(word))) {
        (true, Some(word)) => Err(word.unexpected("{…} behind the names, as in other lines")),
        _ => Ok(()),
    }
}

/// `a b`, `a b 0.5`, `a -> b`, `a -> b 0.5`, `a->b`, or `a` alone where that is allowed.
fn read_row(builder: &mut Builder, row: &[Word<'_>], rules: &Rules) -> Result<(), FormatError> {
    match row {
        [word] => match glued(word.text) {
            Some((from, arrow, to)) if !word.quoted => {
                let part = |text| Word { text, ..*word };
                read_arrow(builder, &part(from), (&part(arrow), arrow_of(arrow)), &part(to), rules.asked)
            }
            _ if rules.single_names => {
                refuse_strange(word)?;
                builder.node(word.text, word.line).map(|_| ())
            }
            _ => Err(word.unexpected(
                "two names; single ones are allowed after a first line `directed` or `undirected`",
            )),
        },
        [from, middle, to, rest @ ..] if arrow_of(middle.text).is_some() && rest.len() < 2 => {
            rest.iter().try_for_each(refuse_no_weight)?;
            read_arrow(builder, from, (middle, arrow_of(middle.text)), to, rules.asked)
        }
        [from, to] => read_edge(builder, from, to),
        [from, to, weight] => {
            refuse_no_weight(weight)?;
            read_edge(builder, from, to)
        }
        [_, _, _, more, ..] => Err(more.unexpected("two names, and at most a weight after them")),
        [] => Ok(()),
    }
}

fn read_edge(builder: &mut Builder, from: &Word<'_>, to: &Word<'_>) -> Result<(), FormatError> {
    let (from, to) = ends(builder, from, to)?;
    builder.edge(from.0, to, from.1);
    Ok(())
}

/// A number other than 0, or `{…}` as networkx writes it.
pub(in crate::formats) fn refuse_no_weight(weight: &Word<'_>) -> Result<(), FormatError> {
    if weight.text.starts_with('{') {
        return Ok(());
    }
    match weight.number() {
        Some(0.0) => Err(weight.unexpected("a weight other than 0: nobody can know whether 0 is a link")),
        Some(_) => Ok(()),
        None => Err(weight.unexpected("two names, and at most a weight after them")),
    }
}

/// A row under a header that says which columns count.
fn read_columns(builder: &mut Builder, row: &[Word<'_>], columns: Columns) -> Result<(), FormatError> {
    let (Some(from), Some(to)) = (row.get(columns.from), row.get(columns.to)) else {
        let line = row.first().map_or(1, |word| word.line);
        return Err(FormatError::missing(line, "a value in both columns of ends that the header names"));
    };
    let weight = columns.weight.and_then(|weight| row.get(weight)).filter(|weight| !weight.text.is_empty());
    weight.map_or(Ok(()), refuse_no_weight)?;
    let kind = columns.kind.and_then(|kind| row.get(kind));
    let both = match kind.map(|kind| kind.text.to_ascii_lowercase()) {
        None => !builder.is_directed(),
        Some(kind) if kind == "undirected" || kind == "false" => true,
        Some(kind) if kind == "directed" || kind == "true" => false,
        Some(_) => {
            let kind = kind.copied().unwrap_or(*from);
            return Err(kind.unexpected("Directed or Undirected in this column"));
        }
    };
    let ((from, line), to) = ends(builder, from, to)?;
    builder.link(from, to, both, line);
    Ok(())
}
