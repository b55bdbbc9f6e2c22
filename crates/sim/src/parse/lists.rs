//! Fields that are lists: each item has its own place and its own complaint.

use toml::Spanned;
use toml::de::DeValue;

use super::column::{Column, names};
use super::reader::Reader;
use super::section::Section;
use super::value::number;

impl Reader {
    /// A list, each item read by `item`; a bad item is named with its place in the list.
    pub(crate) fn list<T>(
        &mut self,
        section: &mut Section<'_>,
        key: &'static str,
        allowed: &str,
        item: impl Fn(&DeValue<'_>) -> Option<T>,
    ) -> Option<Vec<T>> {
        let (field, value) = self.take(section, key)?;
        let Some(items) = value.get_ref().as_array() else {
            self.wrong(field, value, format!("a list, each item {allowed}"));
            return None;
        };
        let mut read = Vec::with_capacity(items.len());
        for (index, value) in items.iter().enumerate() {
            let name = format!("{field}[{index}]");
            match item(value.get_ref()) {
                Some(good) => read.push(good),
                None => self.wrong(name.clone(), value, allowed),
            }
            self.items.extend(number(value.get_ref()).map(|number| (name.clone(), number)));
            self.places.insert(name, value.span());
        }
        (read.len() == items.len()).then_some(read)
    }

    /// A list of lists with a number for each of `columns`; a bad number is named with its place in both.
    pub(crate) fn rows(
        &mut self,
        section: &mut Section<'_>,
        key: &'static str,
        columns: &[Column],
    ) -> Option<Vec<Vec<f64>>> {
        let allowed = format!("a list of {} numbers, {}", columns.len(), names(columns));
        let (field, value) = self.take(section, key)?;
        let Some(items) = value.get_ref().as_array() else {
            self.wrong(field, value, format!("a list, each item {allowed}"));
            return None;
        };
        let mut rows = Vec::with_capacity(items.len());
        for (index, value) in items.iter().enumerate() {
            let field = format!("{field}[{index}]");
            self.places.insert(field.clone(), value.span());
            match value.get_ref().as_array().filter(|numbers| numbers.len() == columns.len()) {
                Some(numbers) => rows.extend(self.row(&field, numbers.iter(), columns)),
                None => self.wrong(field, value, allowed.as_str()),
            }
        }
        (rows.len() == items.len()).then_some(rows)
    }

    fn row<'text>(
        &mut self,
        field: &str,
        values: impl Iterator<Item = &'text Spanned<DeValue<'text>>>,
        columns: &[Column],
    ) -> Option<Vec<f64>> {
        let mut row = Vec::with_capacity(columns.len());
        for (index, (value, column)) in values.zip(columns).enumerate() {
            match number(value.get_ref()).filter(|number| column.holds(*number)) {
                Some(number) => row.push(number),
                None => self.wrong(format!("{field}[{index}]"), value, column.to_string()),
            }
        }
        (row.len() == columns.len()).then_some(row)
    }

    /// A list of tables, at most `most`, each read by `read`; fields that it did not ask for are noted.
    pub(crate) fn tables<T>(
        &mut self,
        section: &mut Section<'_>,
        key: &'static str,
        most: usize,
        mut read: impl FnMut(&mut Self, &mut Section<'_>) -> T,
    ) -> Vec<T> {
        let Some((field, value)) = self.take(section, key) else { return Vec::new() };
        let tables = value.get_ref().as_array();
        let Some(tables) = tables.filter(|tables| tables.len() <= most) else {
            self.wrong(field, value, format!("a list of at most {most} tables"));
            return Vec::new();
        };
        let mut all = Vec::with_capacity(tables.len());
        for (index, value) in tables.iter().enumerate() {
            let path = format!("{field}[{index}]");
            self.places.insert(path.clone(), value.span());
            let Some(entries) = value.get_ref().as_table() else {
                self.wrong(path, value, "a table");
                continue;
            };
            let mut item = Section::item(path, value.span(), entries);
            all.push(read(self, &mut item));
            self.close(&item);
        }
        all
    }

    /// The name of the second item of a list that is `number`, or of the list itself if nobody knows where that stands.
    pub(crate) fn second(&self, list: &str, number: f64) -> String {
        let is_it = |place: &usize| self.items.get(&format!("{list}[{place}]")) == Some(&number);
        let place = (0..self.items.len()).filter(is_it).nth(1);
        place.map_or(list.to_owned(), |place| format!("{list}[{place}]"))
    }
}
