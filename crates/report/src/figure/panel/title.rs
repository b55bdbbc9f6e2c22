//! Titles of panels: a letter, a name, a time; on one line if there is room.

use crate::svg::palette::TITLE;
use crate::svg::text::width;

/// A title before it has a letter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Title {
    /// What.
    pub(crate) name: String,
    /// When; empty if there is nothing to say.
    pub(crate) time: String,
    /// The time goes without saying where there is one line only.
    pub(crate) time_known: bool,
}

impl Title {
    /// A title without a time.
    #[must_use]
    pub(crate) fn of(name: &str) -> Self {
        Self { name: name.into(), time: String::new(), time_known: true }
    }

    fn one_line(&self, letter: &str) -> String {
        if self.time_known {
            format!("{letter} {}", self.name)
        } else {
            format!("{letter} {}, {}", self.name, self.time)
        }
    }

    fn two_lines(&self, letter: &str) -> Vec<String> {
        let lines = [format!("{letter} {}", self.name), self.time.clone()];
        lines.into_iter().filter(|line| !line.is_empty()).collect()
    }
}

/// Lines of all titles of a row, lettered from the place `first`: one each if all fit into `room`, else two.
#[must_use]
pub(crate) fn fold(titles: &[Title], first: usize, room: f64) -> Vec<Vec<String>> {
    let letters: Vec<String> = (first..first + titles.len()).map(letter).collect();
    let pairs = || titles.iter().zip(&letters);
    if pairs().all(|(title, letter)| width(&title.one_line(letter), TITLE) <= room) {
        pairs().map(|(title, letter)| vec![title.one_line(letter)]).collect()
    } else {
        pairs().map(|(title, letter)| title.two_lines(letter)).collect()
    }
}

/// `(a)`, `(b)` ... and numbers after `(z)`.
fn letter(place: usize) -> String {
    match ('a'..='z').nth(place) {
        Some(letter) => format!("({letter})"),
        None => format!("({})", place + 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_take_two_lines_only_if_they_must() {
        let end = Title { name: "nominal".into(), time: "t = 10 s".into(), time_known: false };
        let start = Title { name: "start".into(), time: "t = 0 s".into(), time_known: true };
        let titles = [start, end];
        assert_eq!(fold(&titles, 0, 300.0), [["(a) start"], ["(b) nominal, t = 10 s"]]);
        assert_eq!(fold(&titles, 3, 60.0), [["(d) start", "t = 0 s"], ["(e) nominal", "t = 10 s"]]);
        assert_eq!(fold(&[Title::of("x")], 26, 1.0), [["(27) x"]]);
    }
}
