//! First lines of edge lists that name the columns.

use alloc::string::String;
use alloc::vec::Vec;

use crate::formats::words::Word;

/// Pairs of column names that mean the two ends of an edge, in small letters without blanks, `_` and `-`.
const PAIRS: [(&str, &str); 14] = [
    ("source", "target"),
    ("from", "to"),
    ("src", "dst"),
    ("src", "dest"),
    ("source", "destination"),
    ("fromnodeid", "tonodeid"),
    ("fromnode", "tonode"),
    ("sourceid", "targetid"),
    ("node1", "node2"),
    ("nodea", "nodeb"),
    ("id1", "id2"),
    ("start", "end"),
    ("tail", "head"),
    ("sender", "receiver"),
];

/// Where the columns of an edge are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Columns {
    pub(super) from: usize,
    pub(super) to: usize,
    /// A column that says `Directed` or `Undirected`, as Gephi writes it.
    pub(super) kind: Option<usize>,
    /// A column of weights.
    pub(super) weight: Option<usize>,
}

fn folded(word: &str) -> String {
    word.chars().filter(|c| !matches!(c, '_' | '-' | ' ')).flat_map(char::to_lowercase).collect()
}

/// The columns that the first row names, if it is a header: it has a known pair of names, or two words where every
/// other line has two numbers. A word that is a robot's name in another line is none of a header.
pub(super) fn find<'a, I: Iterator<Item = Vec<Word<'a>>>>(
    first: &[Word<'a>],
    others: impl Fn() -> I,
) -> Option<Columns> {
    others().next()?;
    let columns = known(first).or_else(|| above_numbers(first, &others))?;
    let names = [first.get(columns.from)?.text, first.get(columns.to)?.text];
    let is_robot = |row: Vec<Word<'_>>| {
        [columns.from, columns.to]
            .iter()
            .any(|&at| row.get(at).is_some_and(|word| names.contains(&word.text)))
    };
    (!others().any(is_robot)).then_some(columns)
}

fn known(first: &[Word<'_>]) -> Option<Columns> {
    let place = |name: &str| first.iter().position(|word| folded(word.text) == name);
    let pair = PAIRS.iter().find_map(|(from, to)| Some((place(from)?, place(to)?)));
    let (from, to) = pair?;
    let kind = place("type").or_else(|| place("directed"));
    Some(Columns { from, to, kind, weight: place("weight").or_else(|| place("value")) })
}

fn above_numbers<'a, I: Iterator<Item = Vec<Word<'a>>>>(
    first: &[Word<'a>],
    others: impl Fn() -> I,
) -> Option<Columns> {
    let is_number = |word: &Word<'_>| word.text.parse::<f64>().is_ok();
    let ends = |row: &[Word<'_>]| row.len() >= 2 && row[..2].iter().all(is_number);
    let words = (2..=3).contains(&first.len()) && !first.iter().any(is_number);
    let header = words && first.iter().all(|word| super::plain(word.text));
    let weight = (first.len() == 3).then_some(2);
    let columns = Columns { from: 0, to: 1, kind: None, weight };
    (header && others().all(|row| ends(&row))).then_some(columns)
}
