//! Rows of a sweep in memory, column by column; every cell may be missing.

use core::ops::Range;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Whole numbers.
    Whole,
    /// Numbers.
    Number,
    /// Texts.
    Text,
}

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Of a column of whole numbers.
    Whole(i64),
    /// Of a column of numbers; what is not finite is missing.
    Number(f64),
    /// Of a column of texts.
    Text(String),
}

/// Name and kind of a column; the unit is the end of the name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Head {
    /// Name.
    pub name: String,
    /// What it holds.
    pub kind: Kind,
}

/// A column.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Whole numbers.
    Whole(Vec<Option<i64>>),
    /// Numbers.
    Number(Vec<Option<f64>>),
    /// Texts.
    Text(Vec<Option<String>>),
}

/// Some rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    heads: Vec<Head>,
    columns: Vec<Values>,
    count: usize,
}

impl Head {
    /// A head.
    #[must_use]
    pub fn new(name: impl Into<String>, kind: Kind) -> Self {
        Self { name: name.into(), kind }
    }
}

impl Values {
    /// A column without rows.
    #[must_use]
    pub(crate) fn empty(kind: Kind) -> Self {
        match kind {
            Kind::Whole => Self::Whole(Vec::new()),
            Kind::Number => Self::Number(Vec::new()),
            Kind::Text => Self::Text(Vec::new()),
        }
    }

    /// A cell of another kind is missing, but numbers can be texts.
    fn push(&mut self, cell: Option<Cell>) {
        match (self, cell) {
            (Self::Whole(column), Some(Cell::Whole(whole))) => column.push(Some(whole)),
            (Self::Whole(column), _) => column.push(None),
            (Self::Number(column), Some(Cell::Number(number))) => {
                column.push(Some(number).filter(|number| number.is_finite()));
            }
            (Self::Number(column), _) => column.push(None),
            (Self::Text(column), Some(Cell::Text(text))) => column.push(Some(text)),
            (Self::Text(column), Some(Cell::Number(number))) => column.push(Some(number.to_string())),
            (Self::Text(column), _) => column.push(None),
        }
    }

    fn append(&mut self, other: Self) {
        match (self, other) {
            (Self::Whole(column), Self::Whole(more)) => column.extend(more),
            (Self::Number(column), Self::Number(more)) => column.extend(more),
            (Self::Text(column), Self::Text(more)) => column.extend(more),
            _ => {}
        }
    }

    fn range(&self, rows: Range<usize>) -> Self {
        match self {
            Self::Whole(column) => Self::Whole(column.get(rows).unwrap_or_default().to_vec()),
            Self::Number(column) => Self::Number(column.get(rows).unwrap_or_default().to_vec()),
            Self::Text(column) => Self::Text(column.get(rows).unwrap_or_default().to_vec()),
        }
    }

    fn len(&self) -> usize {
        match self {
            Self::Whole(column) => column.len(),
            Self::Number(column) => column.len(),
            Self::Text(column) => column.len(),
        }
    }
}

impl Rows {
    /// No rows.
    #[must_use]
    pub fn empty(heads: &[Head]) -> Self {
        let columns = heads.iter().map(|head| Values::empty(head.kind)).collect();
        Self { heads: heads.to_vec(), columns, count: 0 }
    }

    /// Rows from whole columns of one length; none if they differ.
    #[must_use]
    pub(crate) fn of(heads: Vec<Head>, columns: Vec<Values>) -> Option<Self> {
        let count = columns.first().map_or(0, Values::len);
        let even = heads.len() == columns.len() && columns.iter().all(|column| column.len() == count);
        even.then_some(Self { heads, columns, count })
    }

    /// Adds a row: a cell a column, missing ones at the end.
    pub fn push(&mut self, cells: Vec<Option<Cell>>) {
        let cells = cells.into_iter().chain(core::iter::repeat(None));
        self.columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        self.count += 1;
    }

    /// Adds all rows of `other`; false, and nothing is added, if its columns are others.
    #[must_use]
    pub fn append(&mut self, other: Self) -> bool {
        let same = self.heads == other.heads;
        if same {
            self.count += other.count;
            self.columns.iter_mut().zip(other.columns).for_each(|(column, more)| column.append(more));
        }
        same
    }

    /// Some of the rows; empty if they are not all there.
    #[must_use]
    pub fn range(&self, rows: Range<usize>) -> Self {
        let columns: Vec<Values> = self.columns.iter().map(|column| column.range(rows.clone())).collect();
        let count = columns.first().map_or(0, Values::len);
        Self { heads: self.heads.clone(), columns, count }
    }

    /// How many rows.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Names and kinds.
    #[must_use]
    pub fn heads(&self) -> &[Head] {
        &self.heads
    }

    /// All columns.
    #[must_use]
    pub(crate) fn columns(&self) -> &[Values] {
        &self.columns
    }

    fn column(&self, name: &str) -> Option<&Values> {
        let place = self.heads.iter().position(|head| head.name == name)?;
        self.columns.get(place)
    }

    /// A column of whole numbers; empty if there is no such column.
    #[must_use]
    pub fn whole(&self, name: &str) -> &[Option<i64>] {
        if let Some(Values::Whole(column)) = self.column(name) { column } else { &[] }
    }

    /// A column of numbers; empty if there is no such column.
    #[must_use]
    pub fn number(&self, name: &str) -> &[Option<f64>] {
        if let Some(Values::Number(column)) = self.column(name) { column } else { &[] }
    }

    /// A column of texts; empty if there is no such column.
    #[must_use]
    pub fn text(&self, name: &str) -> &[Option<String>] {
        if let Some(Values::Text(column)) = self.column(name) { column } else { &[] }
    }
}
