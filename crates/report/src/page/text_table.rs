//! Tables for a terminal: never wider than 80 columns if words can be broken so.

use core::ops::Range;

use super::content::Table;

/// What every terminal, mail and README has room for.
const WIDTH: usize = 80;
/// Words longer than this go on in the next line where a table is too wide.
const CELL: usize = 22;
/// Space between columns.
const GAP: usize = 2;

/// The table as text for a terminal: columns aligned, the first to the left, others to the right; the last to the left if it
/// has words only. A table that is too wide is cut into blocks, each with the names of the rows.
#[must_use]
pub fn text(table: &Table) -> String {
    let names = if table.rows.iter().any(|row| row.first().is_some_and(String::is_empty)) { 2 } else { 1 };
    let mut lines = Lines::of(table, usize::MAX);
    if lines.width(0..table.heads.len()) > WIDTH {
        lines = Lines::of(table, CELL);
    }
    let blocks = lines.blocks(names);
    let blocks = blocks.into_iter().map(|columns| lines.block((0..names).chain(columns)));
    blocks.collect::<Vec<_>>().join("\n")
}

/// Cells of a table line by line, heads first.
struct Lines {
    heads: usize,
    cells: Vec<Vec<String>>,
    widths: Vec<usize>,
    /// Columns that hold no number.
    words: Vec<bool>,
}

impl Lines {
    /// With cells folded at blanks to at most `most` characters.
    fn of(table: &Table, most: usize) -> Self {
        let columns = table.heads.len();
        let heads: Vec<Vec<String>> =
            table.heads.iter().map(|head| head.split('\n').map(str::to_owned).collect()).collect();
        let heads = across(&heads, columns);
        let body = table
            .rows
            .iter()
            .flat_map(|row| across(&row.iter().map(|cell| folded(cell, most)).collect::<Vec<_>>(), columns));
        let body: Vec<Vec<String>> = body.collect();
        let words = (0..columns).map(|column| !body.iter().any(|line| is_number(&line[column]))).collect();
        let count = heads.len();
        let lines: Vec<Vec<String>> = heads.into_iter().chain(body).collect();
        let longest =
            |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0);
        Self { heads: count, widths: (0..columns).map(longest).collect(), words, cells: lines }
    }

    /// Width of some columns side by side.
    fn width(&self, columns: Range<usize>) -> usize {
        self.widths[columns.clone()].iter().sum::<usize>() + GAP * columns.len().saturating_sub(1)
    }

    /// Columns after the first `names` in blocks, each with as many as there is room for beside the names.
    fn blocks(&self, names: usize) -> Vec<Range<usize>> {
        let all = self.widths.len();
        let names = names.min(all);
        let room = WIDTH.saturating_sub(self.width(0..names) + GAP);
        let mut blocks = Vec::new();
        let mut start = names;
        loop {
            let fits =
                (start + 1..=all).rev().find(|end| self.width(start..*end) <= room).unwrap_or(start + 1);
            blocks.push(start..fits.min(all));
            start = fits;
            if start >= all {
                return blocks;
            }
        }
    }

    /// Some columns as text, with a rule below the heads.
    fn block(&self, columns: impl Iterator<Item = usize>) -> String {
        let columns: Vec<usize> = columns.filter(|column| *column < self.widths.len()).collect();
        let mut out = String::new();
        for (index, line) in self.cells.iter().enumerate() {
            let told = self.line(line, &columns);
            // Heads of one line have an empty second one where another block has units.
            if index >= self.heads || !told.trim_end().is_empty() {
                out.push_str(told.trim_end());
                out.push('\n');
            }
            if index + 1 == self.heads {
                let gaps = GAP * columns.len().saturating_sub(1);
                let width = columns.iter().map(|column| self.widths[*column]).sum::<usize>() + gaps;
                out.push_str(&"-".repeat(width));
                out.push('\n');
            }
        }
        out
    }

    fn line(&self, cells: &[String], columns: &[usize]) -> String {
        let aligned = columns.iter().map(|column| {
            let (cell, width) = (&cells[*column], self.widths[*column]);
            let is_last = *column > 0 && column + 1 == self.widths.len();
            let left = *column == 0 || (is_last && self.words[*column]);
            if left { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
        });
        aligned.collect::<Vec<_>>().join(&" ".repeat(GAP))
    }
}

/// Cells of several lines each as lines of cells; short ones are filled up.
fn across(cells: &[Vec<String>], columns: usize) -> Vec<Vec<String>> {
    let height = cells.iter().map(Vec::len).max().unwrap_or(0);
    let cell = |line: usize, column: usize| {
        cells.get(column).and_then(|cell| cell.get(line)).cloned().unwrap_or_default()
    };
    (0..height).map(|line| (0..columns).map(|column| cell(line, column)).collect()).collect()
}

/// Words in lines of at most `most` characters; a longer word has a line of its own.
fn folded(text: &str, most: usize) -> Vec<String> {
    if text.chars().count() <= most {
        return vec![text.to_owned()];
    }
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

fn is_number(cell: &str) -> bool {
    cell.starts_with(|first: char| first.is_ascii_digit() || "+-".contains(first))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(heads: &[&str], rows: &[&[&str]]) -> Table {
        let owned = |cells: &[&str]| cells.iter().map(|cell| (*cell).to_owned()).collect();
        Table { heads: owned(heads), rows: rows.iter().map(|row| owned(row)).collect() }
    }

    #[test]
    fn columns_line_up() {
        assert_eq!(
            text(&table(&["name", "degree\nleast"], &[&["nominal", "7"], &["x", "10"]])),
            "name     degree\n          least\n---------------\nnominal       7\nx            10\n"
        );
        assert_eq!(text(&table(&[], &[])), "");
        let wide = ["degree\nleast", "words"].map(|head| format!("{head}{}", " ".repeat(60)));
        let told = text(&table(&["name", &wide[0], &wide[1]], &[&["x", "10", "senses"]]));
        assert!(
            told.ends_with("senses\n") && told.lines().all(|line| line.is_empty() == line.trim().is_empty())
        );
        assert!(!told.contains("\n\n-"), "{told}");
        assert_eq!(text(&table(&["alone"], &[&["x"]])), "alone\n-----\nx\n");
    }

    /// The table of runs used to be 130 columns wide and broke in every terminal.
    #[test]
    fn wide_tables_are_cut_into_blocks_that_fit() {
        let heads: Vec<String> = (0..14).map(|column| format!("column {column}")).collect();
        let row: Vec<String> = (0..14).map(|column| column.to_string()).collect();
        let told = text(&Table { heads, rows: vec![row] });
        assert!(told.lines().all(|line| line.chars().count() <= WIDTH), "{told}");
        assert_eq!(told.split("\n\n").count(), 2);
        assert!(told.split("\n\n").all(|block| block.starts_with("column 0  ")), "{told}");
        assert!((0..14).all(|column| told.contains(&format!("column {column}"))));
    }

    #[test]
    fn long_words_go_on_below_and_groups_keep_both_names() {
        let long = "error_s + hold_max_s + tau_1_s + tau_2_s + told_max_s";
        let runs = "12345678901234567890";
        let told = text(&table(
            &["drawn", "value", "budget\nruns", "composed\nruns", "none\nruns"],
            &[&["clock", long, runs, runs, runs], &["", "drift_max", "-", "-", "-"]],
        ));
        assert!(told.lines().all(|line| line.chars().count() <= WIDTH), "{told}");
        let blocks = told.split("\n\n").count();
        assert!(blocks > 1);
        for word in ["clock ", "error_s + hold_max_s +", " told_max_s", "drift_max"] {
            assert_eq!(told.matches(word).count(), blocks, "{word}\n{told}");
        }
    }
}
