//! Tables of a page: in rows where there is room, one card a row on a phone.

use super::content::Table;
use crate::svg::escape;

/// A phone has room for so many columns.
const FEW: usize = 5;

/// A table that scrolls sideways where it is too wide, also by keyboard. The first column names the rows.
pub(super) fn table(caption: &str, table: &Table) -> String {
    let heads: String = (0..table.heads.len()).map(|column| head(column, table)).collect();
    let mut name = "";
    let mut rows = String::new();
    for cells in &table.rows {
        let first = cells.first().map_or("", String::as_str);
        name = if first.is_empty() { name } else { first };
        rows += &row(cells, &table.heads, name);
    }
    let label = escape(caption);
    let class = if table.heads.len() > FEW { " class=\"many\"" } else { "" };
    format!(
        "<div class=\"scroll\" role=\"region\" aria-label=\"{label}\" tabindex=\"0\">\n<table{class}>\n\
         <caption>{label}</caption>\n<thead>\n<tr>{heads}</tr>\n</thead>\n<tbody>\n{rows}</tbody>\n</table>\n</div>\n"
    )
}

/// The head of a column, aligned as what is below it.
fn head(column: usize, table: &Table) -> String {
    let mut cells = table.rows.iter().filter_map(|row| row.get(column)).filter(|text| !text.is_empty());
    let class = if column > 0 && cells.all(|text| is_number(text)) { " class=\"number\"" } else { "" };
    format!("<th scope=\"col\"{class}>{}</th>", escape(&one_line(&table.heads[column])))
}

/// A head in one line: a word that was divided is whole again.
fn one_line(head: &str) -> String {
    head.replace("-\n", "").replace('\n', " ")
}

/// A row; short ones are filled up. A row without a name is one more of those above that have `name`.
fn row(cells: &[String], heads: &[String], name: &str) -> String {
    let blank = String::new();
    let width = heads.len().max(cells.len());
    let filled = cells.iter().chain(core::iter::repeat(&blank)).take(width).enumerate().skip(1);
    let label = |column: usize| heads.get(column).map_or_else(String::new, |head| one_line(head));
    let rest: String = filled.map(|(column, text)| cell(&label(column), text)).collect();
    let again = if cells.first().is_none_or(String::is_empty) { " class=\"again\"" } else { "" };
    format!("<tr><th scope=\"row\"{again}>{}</th>{rest}</tr>\n", escape(name))
}

/// A cell; its head goes with it, for screens that have no room for heads above.
fn cell(label: &str, text: &str) -> String {
    let class = if is_number(text) { " class=\"number\"" } else { "" };
    format!("<td{class} data-label=\"{}\">{}</td>", escape(label), escape(text))
}

/// Numbers are aligned to the right, and a dash where there is none.
fn is_number(text: &str) -> bool {
    text == "-"
        || text.trim_start_matches(['-', '\u{2212}', '+']).starts_with(|first: char| first.is_ascii_digit())
}
