//! What the comments above the first edge say about direction.

use crate::formats::builder::Builder;
use crate::formats::error::{FormatError, Problem};
use crate::formats::note::Note;
use crate::formats::words::all_lines;

/// Whether a comment says that edges have a direction, and in which line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::formats) struct Said {
    line: usize,
    directed: bool,
}

impl Said {
    /// Looks at the lines that begin with `#` or `%` above the first edge. `# Directed graph` is obeyed, as are the words
    /// `sym` and `asym` of KONECT; `# not so directed` and KONECT's `bip` are refused unless the caller has `asked`.
    pub(in crate::formats) fn of(text: &str, asked: Option<bool>) -> Result<Option<Self>, FormatError> {
        let mut said = None;
        for line in
            all_lines(text).take_while(|line| line.text.is_empty() || line.text.starts_with(['#', '%']))
        {
            match speaks(line.text) {
                Speech::Plain(directed) => said = said.or(Some(Self { line: line.number, directed })),
                Speech::Bipartite => {
                    let allowed =
                        "a graph with one numbering: in a bipartite one of KONECT each side has its own";
                    return Err(FormatError::unexpected(line.number, line.text, allowed));
                }
                Speech::Unclear if asked.is_none() => {
                    return Err(FormatError::new(line.number, Problem::DirectionUnclear));
                }
                Speech::Nothing | Speech::Unclear => {}
            }
        }
        Ok(said)
    }

    /// An empty graph with the direction that the caller asked for, or that was said, or none; and a note if the two differ.
    pub(in crate::formats) fn builder(said: Option<Self>, asked: Option<bool>) -> Builder {
        let directed = asked.or(said.map(|said| said.directed)).unwrap_or(false);
        let mut builder = Builder::new(directed);
        if let Some(Self { line, directed: other }) = said.filter(|said| said.directed != directed) {
            builder.note(Note::DirectionOverruled { line, directed: other });
        }
        builder
    }
}

enum Speech {
    Nothing,
    Plain(bool),
    Bipartite,
    Unclear,
}

/// What may stand behind the first word of `# Directed graph`.
const NOUNS: [&str; 10] =
    ["graph", "network", "multigraph", "edges", "links", "edge", "weighted", "unweighted", "simple", "yes"];

fn speaks(comment: &str) -> Speech {
    let is_konect = comment.starts_with('%');
    let mut words = comment.split_whitespace().map(bare).filter(|word| !word.is_empty());
    let direction = |word: &str| match () {
        () if word.eq_ignore_ascii_case("directed") => Some(true),
        () if word.eq_ignore_ascii_case("undirected") => Some(false),
        () => None,
    };
    match words.next() {
        Some("sym") if is_konect => Speech::Plain(false),
        Some("asym") if is_konect => Speech::Plain(true),
        Some("bip") if is_konect => Speech::Bipartite,
        Some(first) => match direction(first) {
            Some(directed) => {
                let next =
                    words.next().is_none_or(|word| NOUNS.iter().any(|noun| noun.eq_ignore_ascii_case(word)));
                let agree = words.all(|word| direction(word).is_none_or(|other| other == directed));
                if next && agree { Speech::Plain(directed) } else { Speech::Unclear }
            }
            None if words.any(|word| direction(word).is_some()) => Speech::Unclear,
            None => Speech::Nothing,
        },
        None => Speech::Nothing,
    }
}

/// Without signs around it.
fn bare(word: &str) -> &str {
    word.trim_matches(|c: char| !c.is_ascii_alphanumeric())
}
