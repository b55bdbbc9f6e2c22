//! Which format a text is of: asked for, told by a sign of its own, or the only shape that fits.

use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use super::builder::Draft;
use super::error::{FormatError, Problem};
use super::format::Format;
use super::table::{ROWS, Row, Sign, row};
use super::{Options, ToldBy, matrix};

/// The row to read `text` with. Who asks for weights has a matrix. Where several shapes fit and read different graphs, the ending of the name decides if it
/// settles; else the text is refused with the names of all that fit.
pub(super) fn choose(text: &str, options: &Options<'_>) -> Result<(&'static Row, ToldBy), FormatError> {
    if let Some(format) = options.format {
        return Ok((row(format), ToldBy::Request));
    }
    let own = ROWS.iter().find(|row| matches!(row.sign, Sign::Own(looks_like) if looks_like(text)));
    if let Some(own) = own {
        return Ok((own, ToldBy::Content));
    }
    if options.weights {
        return Ok((row(Format::Matrix), ToldBy::Content));
    }
    let fits = |row: &&Row| matches!(row.sign, Sign::Shape { looks_like, .. } if looks_like(text));
    let fitting: Vec<&'static Row> = ROWS.iter().filter(fits).collect();
    match fitting.as_slice() {
        [] => complaint(text, options),
        [one] => Ok((one, ToldBy::Content)),
        [first, ..] if all_the_same(text, options, &fitting) => Ok((first, ToldBy::Content)),
        _ => by_ending(options, &fitting).map(|row| (row, ToldBy::Ending)),
    }
}

/// Where nothing fits: the row whose reader says best what is wrong. If that one would read the text after all, although it
/// does not look like its format, that is no more than a guess, and refused.
fn complaint(text: &str, options: &Options<'_>) -> Result<(&'static Row, ToldBy), FormatError> {
    let row = closest(text, options);
    match (row.read)(text, options) {
        Err(_) => Ok((row, ToldBy::Content)),
        Ok(_) => Err(FormatError::new(1, Problem::Doubtful { format: row.format })),
    }
}

/// The format of the ending, if it is one without a sign of its own, else the edge list. Endings of matrices are used for
/// other tables too: then the text must be as square as one.
fn closest(text: &str, options: &Options<'_>) -> &'static Row {
    let helps = |row: &&Row| match (row.format, row.sign) {
        (Format::Matrix, _) => matrix::is_square(text),
        (_, sign) => matches!(sign, Sign::Shape { .. }),
    };
    let of_ending = ROWS.iter().filter(|row| has_ending(row, options)).find(helps);
    of_ending.unwrap_or_else(|| row(Format::EdgeList))
}

fn has_ending(row: &Row, options: &Options<'_>) -> bool {
    let ending = options.ending.unwrap_or("");
    row.endings.iter().any(|known| known.eq_ignore_ascii_case(ending))
}

fn by_ending(options: &Options<'_>, fitting: &[&'static Row]) -> Result<&'static Row, FormatError> {
    let settles =
        |row: &&&Row| matches!(row.sign, Sign::Shape { settles: true, .. }) && has_ending(row, options);
    let formats = || fitting.iter().map(|row| row.format).collect();
    let found = fitting.iter().find(settles).copied();
    found.ok_or_else(|| FormatError::new(1, Problem::Ambiguous { formats: formats() }))
}

/// Whether all of them read one and the same graph, so that it does not matter which is right.
fn all_the_same(text: &str, options: &Options<'_>, fitting: &[&'static Row]) -> bool {
    let mut graphs = fitting.iter().map(|row| (row.read)(text, options).map(|draft| by_name(&draft)));
    let Some(Ok(first)) = graphs.next() else {
        return false;
    };
    graphs.all(|graph| graph.as_ref() == Ok(&first))
}

/// Direction, names in order, and edges between places in that order.
type ByName = (bool, Vec<String>, Vec<(u32, u32)>);

/// What a draft says, whatever the order of its nodes.
fn by_name(draft: &Draft) -> ByName {
    let mut order: Vec<usize> = (0..draft.names.len()).collect();
    order.sort_unstable_by_key(|node| &draft.names[*node]);
    let mut place = vec![0; order.len()];
    for (index, node) in (0_u32..).zip(&order) {
        place[*node] = index;
    }
    let directed = draft.network.is_directed();
    let ends = |(from, to): (u32, u32)| {
        let (from, to) = (place[from as usize], place[to as usize]);
        if directed || from < to { (from, to) } else { (to, from) }
    };
    let mut edges: Vec<(u32, u32)> = draft.network.edges().map(ends).collect();
    edges.sort_unstable();
    (directed, order.iter().map(|node| draft.names[*node].clone()).collect(), edges)
}
