//! Arrows between two names: who hears whom.

use super::name::ends;
use crate::formats::builder::Builder;
use crate::formats::error::FormatError;
use crate::formats::words::Word;

/// Which ends hear the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Arrow {
    /// The second hears the first.
    Forward,
    /// The first hears the second.
    Back,
    /// Each hears the other.
    Both,
    /// Each hears the other, by a sign without a head.
    None,
}

/// The arrow that a word is, if it is one.
pub(super) fn arrow_of(word: &str) -> Option<Arrow> {
    match word {
        "->" | "-->" | "=>" | "→" => Some(Arrow::Forward),
        "<-" | "<--" | "<=" | "←" => Some(Arrow::Back),
        "<->" | "<-->" | "<=>" | "↔" => Some(Arrow::Both),
        "--" | "-" | "—" | "–" => Some(Arrow::None),
        _ => None,
    }
}

/// `a->b` or `a--b`: a word with one arrow inside.
pub(super) fn glued(word: &str) -> Option<(&str, &str, &str)> {
    let arrows = ["<-->", "<->", "-->", "->", "<--", "<-", "--"];
    let bare = |name: &str| !name.is_empty() && !arrows.iter().any(|arrow| name.contains(arrow));
    let (from, arrow, to) = arrows.into_iter().find_map(|arrow| {
        let (from, to) = word.split_once(arrow)?;
        Some((from, arrow, to))
    })?;
    (bare(from) && bare(to)).then_some((from, arrow, to))
}

/// Reads one link. An arrow that contradicts the direction `asked` for is refused.
pub(super) fn read_arrow(
    builder: &mut Builder,
    from: &Word<'_>,
    (sign, arrow): (&Word<'_>, Option<Arrow>),
    to: &Word<'_>,
    asked: Option<bool>,
) -> Result<(), FormatError> {
    match (asked, arrow) {
        (Some(false), Some(Arrow::Forward | Arrow::Back)) => {
            return Err(sign.unexpected("-- between two names, as they were said to be undirected"));
        }
        (Some(true), Some(Arrow::None)) => {
            return Err(sign.unexpected("-> between two names, as they were said to be directed"));
        }
        _ => {}
    }
    let ((from, line), to) = ends(builder, from, to)?;
    match arrow {
        Some(Arrow::Forward) => builder.link(from, to, false, line),
        Some(Arrow::Back) => builder.link(to, from, false, line),
        _ => builder.link(from, to, true, line),
    }
    Ok(())
}
