//! A rectangle of characters: robots as marks with numbers, links as dots. A character is twice as high as wide.

use closeranks_sim::output::snapshot::Snapshot;
use console::Style;

/// What is drawn of one tick, in the plane of the first two axes.
pub(crate) struct Picture<'a> {
    pub(crate) now: &'a Snapshot<'a>,
    pub(crate) malicious: &'a [bool],
    pub(crate) radius_m: f64,
    pub(crate) region: Region,
}

/// What part of the plane is seen, m. It grows with the team and never shrinks, so that the picture stands still.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Region {
    least_m: [f64; 2],
    most_m: [f64; 2],
}

impl Default for Region {
    fn default() -> Self {
        Self { least_m: [f64::INFINITY; 2], most_m: [f64::NEG_INFINITY; 2] }
    }
}

impl Region {
    /// With room for every robot.
    pub(crate) fn include(&mut self, now: &Snapshot<'_>) {
        for index in 0..now.robots() {
            let [x, y, _] = now.vector(now.positions_m, index);
            if x.is_finite() && y.is_finite() {
                for (axis, at) in [x, y].into_iter().enumerate() {
                    self.least_m[axis] = self.least_m[axis].min(at);
                    self.most_m[axis] = self.most_m[axis].max(at);
                }
            }
        }
    }
}

/// What stands in a place: nothing, a dot of a link, or a mark.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cell {
    letter: char,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Empty,
    Link,
    Normal,
    Malicious,
    Down,
}

/// The lines of a picture, `columns` wide each.
pub(crate) fn lines(picture: &Picture<'_>, columns: usize, rows: usize) -> Vec<String> {
    let empty = Cell { letter: ' ', kind: Kind::Empty };
    let mut cells = vec![vec![empty; columns]; rows];
    let places: Vec<Option<(usize, usize)>> =
        (0..picture.now.robots()).map(|index| picture.place(index, columns, rows)).collect();
    picture.links(&places, &mut cells);
    for (index, place) in places.iter().enumerate() {
        if let Some(place) = place {
            picture.mark(index, *place, &mut cells);
        }
    }
    cells.iter().map(|row| styled(row)).collect()
}

impl Picture<'_> {
    /// Column and row of a robot; a metre is as long across as up.
    fn place(&self, index: usize, columns: usize, rows: usize) -> Option<(usize, usize)> {
        let [x, y, _] = self.now.vector(self.now.positions_m, index);
        let Region { least_m, most_m } = self.region;
        // Room for a mark with its number at the right edge.
        let (wide, high) = (span(columns, 4), span(rows, 1));
        let scale =
            (wide / (most_m[0] - least_m[0]).max(1e-3)).min(2.0 * high / (most_m[1] - least_m[1]).max(1e-3));
        let middle = [0, 1].map(|axis| 0.5 * (least_m[axis] + most_m[axis]));
        let column = 0.5 * wide + (x - middle[0]) * scale;
        let row = 0.5 * high - (y - middle[1]) * scale * 0.5;
        Some((whole(column, columns)?, whole(row, rows)?))
    }

    fn links(&self, places: &[Option<(usize, usize)>], cells: &mut [Vec<Cell>]) {
        for (first, start) in places.iter().enumerate() {
            for (second, end) in places.iter().enumerate().skip(first + 1) {
                if let (Some(start), Some(end)) = (start, end)
                    && self.is_linked(first, second)
                {
                    dots(*start, *end, cells);
                }
            }
        }
    }

    fn is_linked(&self, first: usize, second: usize) -> bool {
        let [a, b] = [first, second].map(|index| self.now.vector(self.now.positions_m, index));
        let square: f64 = a.iter().zip(&b).map(|(a, b)| (a - b) * (a - b)).sum();
        square <= self.radius_m * self.radius_m
    }

    fn mark(&self, index: usize, (column, row): (usize, usize), cells: &mut [Vec<Cell>]) {
        let malicious = self.malicious.get(index).copied().unwrap_or(false);
        let kind = match (self.now.down[index], malicious) {
            (true, _) => Kind::Down,
            (false, true) => Kind::Malicious,
            (false, false) => Kind::Normal,
        };
        let mark = if malicious { '■' } else { '●' };
        let text = core::iter::once(mark).chain((index + 1).to_string().chars().collect::<Vec<_>>());
        for (place, letter) in cells[row].iter_mut().skip(column).zip(text) {
            *place = Cell { letter, kind };
        }
    }
}

/// Dots between two robots, every other place, so that numbers can be read among many.
fn dots(start: (usize, usize), end: (usize, usize), cells: &mut [Vec<Cell>]) {
    let steps = start.0.abs_diff(end.0).max(start.1.abs_diff(end.1));
    for step in (2..steps).step_by(3) {
        let between = |from: usize, to: usize| (from * (steps - step) + to * step) / steps;
        let cell = &mut cells[between(start.1, end.1)][between(start.0, end.0)];
        *cell = Cell { letter: '·', kind: Kind::Link };
    }
}

#[expect(clippy::cast_precision_loss, reason = "terminals have some hundred columns")]
fn span(cells: usize, less: usize) -> f64 {
    cells.saturating_sub(less) as f64
}

/// The place of a coordinate, if it is one.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked before")]
fn whole(at: f64, cells: usize) -> Option<usize> {
    let at = at.round();
    (at >= 0.0 && at < span(cells, 0)).then_some(at as usize)
}

/// A row with colours, one change a run of like places.
fn styled(row: &[Cell]) -> String {
    let mut line = String::new();
    for run in row.chunk_by(|a, b| a.kind == b.kind) {
        let text: String = run.iter().map(|cell| cell.letter).collect();
        line.push_str(&style(run[0].kind).apply_to(text).to_string());
    }
    line
}

fn style(kind: Kind) -> Style {
    match kind {
        Kind::Empty => Style::new(),
        Kind::Link => Style::new().dim(),
        Kind::Normal => Style::new().cyan().bold(),
        Kind::Malicious => Style::new().yellow().bold().reverse(),
        Kind::Down => Style::new().dim().strikethrough(),
    }
}
