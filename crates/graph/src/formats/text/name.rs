//! Which words may be names in plain texts. What looks like a piece of another format is none.

use crate::formats::builder::Builder;
use crate::formats::error::FormatError;
use crate::formats::words::Word;

const ALLOWED: &str = "the name of a robot: it may not start with %, * or :, nor end with :, nor hold ; | ( ) { } or a comma, except in quotes";

/// Refuses a word that is no name: empty, or with signs that belong to another format.
pub(in crate::formats) fn refuse_strange(word: &Word<'_>) -> Result<(), FormatError> {
    let fits =
        if word.quoted { !word.text.is_empty() } else { plain(word.text) && !is_many_numbers(word.text) };
    if word.text.is_empty() {
        return Err(FormatError::missing(word.line, "a name between the separators").at(word.at));
    }
    if fits { Ok(()) } else { Err(word.unexpected(ALLOWED)) }
}

/// Whether a name may stand without quotes.
pub(in crate::formats) fn plain(name: &str) -> bool {
    let strange = |c: char| {
        // U+2500 to U+257F draw boxes, as trees printed by networkx have them.
        matches!(c, ';' | '|' | '(' | ')' | '{' | '}' | ',' | '\u{2500}'..='\u{257f}')
    };
    let signs = name.starts_with(['%', '*', ':', '"', '\'', '[']) || name.ends_with(':');
    !name.is_empty() && !signs && !name.contains(strange)
}

/// `1 2`: two columns within one, so the separator was not what it seemed.
fn is_many_numbers(name: &str) -> bool {
    name.contains(char::is_whitespace) && name.split_whitespace().all(|part| part.parse::<f64>().is_ok())
}

/// The two nodes, the first with its line.
pub(super) fn ends(
    builder: &mut Builder,
    from: &Word<'_>,
    to: &Word<'_>,
) -> Result<((usize, usize), usize), FormatError> {
    refuse_strange(from)?;
    refuse_strange(to)?;
    let start = builder.node(from.text, from.line).map_err(|error| error.at(from.at))?;
    let end = builder.node(to.text, to.line).map_err(|error| error.at(to.at))?;
    Ok(((start, from.line), end))
}
