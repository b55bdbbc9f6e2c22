//! Exact robustness over time: a figure, and a Parquet file with one row a consensus round.

use std::io::Write;
use std::sync::Arc;

use ::parquet::basic::{LogicalType, Repetition, Type as Physical};
use ::parquet::data_type::{DoubleType, Int32Type};
use ::parquet::errors::ParquetError;
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::schema::types::{Type, TypePtr};
use closeranks_sim::monitors::robustness::Round;

use crate::axes::{Axes, Decoration};
use crate::columns::put;
use crate::layout::{Grid, Row, panel_width};
use crate::legend;
use crate::palette::{INK, MALICIOUS, NORMAL};
use crate::parquet::{Metadata, WriteError, properties};
use crate::path::PathData;
use crate::series::steps;
use crate::svg::{Element, Piece, Svg};
use crate::ticks::Range;
use crate::title::{Title, fold};

/// One moment. Of numbers that are not known exactly, the proved least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// When, s.
    pub time_s: f64,
    /// Largest r.
    pub r_max: i32,
    /// Largest F, −1 if there is none.
    pub f_max: i32,
}

/// One run.
#[derive(Clone, Debug)]
pub struct Survey<'a> {
    /// Its name in titles.
    pub title: &'a str,
    /// F, which the network should survive.
    pub faults: u16,
    /// What was found, in order.
    pub points: Vec<Point>,
}

/// The points of recorded rounds, for ticks of `tick_s`.
#[must_use]
pub fn points(rounds: &[Round], tick_s: f64) -> Vec<Point> {
    let point = |round: &Round| Point {
        time_s: f64::from(round.tick) * tick_s,
        r_max: round.r_max.least,
        f_max: round.f_max.least,
    };
    rounds.iter().map(point).collect()
}

const GAP: f64 = 14.0;

/// Largest r and largest F of the network of each run over time, with the F it should survive as a dashed line.
///
/// Where the search ran out of its budget, what is proved at least. Returns a complete SVG document.
//= paper def:robustness
#[must_use]
pub fn robustness(surveys: &[Survey<'_>]) -> String {
    let titles: Vec<Title> = surveys.iter().map(|survey| Title::of(survey.title)).collect();
    let width = panel_width(surveys.len(), GAP, 420.0);
    let titles = fold(&titles, 0, width);
    let row = Row { title_lines: 1, height: 120.0, axis: true, legend: true };
    let grid = Grid { columns: surveys.len().max(1), width, gap: GAP, rows: vec![row] };
    let mut svg = grid.document("Exact robustness of the network in every consensus round");
    for (column, survey) in surveys.iter().enumerate() {
        let axes = Axes { place: grid.place(column, 0), x: times(surveys), y: heights(surveys) };
        draw(&mut svg, &axes, survey);
        let y_label: &[Piece<'_>] = if column == 0 { &[Piece::Plain("robustness")] } else { &[] };
        axes.draw(
            &mut svg,
            &Decoration {
                title: &titles[column],
                x_label: &[Piece::Plain("time (s)")],
                y_label,
                x_numbers: true,
                y_numbers: column == 0,
            },
        );
    }
    legend::draw(&mut svg, &legend::ROBUSTNESS, grid.legend(0));
    svg.finish()
}

fn times(surveys: &[Survey<'_>]) -> Range {
    let times = surveys.iter().flat_map(|survey| &survey.points).map(|point| point.time_s);
    Range::of(times.chain([0.0]))
}

fn heights(surveys: &[Survey<'_>]) -> Range {
    let points = surveys.iter().flat_map(|survey| &survey.points);
    let found = points.flat_map(|point| [point.r_max, point.f_max]).map(f64::from);
    let needed = surveys.iter().map(|survey| f64::from(survey.faults));
    Range::of(found.chain(needed).chain([0.0])).padded(0.1)
}

fn draw(svg: &mut Svg, axes: &Axes, survey: &Survey<'_>) {
    let line = |height: &dyn Fn(&Point) -> f64| {
        let points = survey.points.iter().map(|point| axes.at_cut([point.time_s, height(point)]));
        steps(&points.collect::<Vec<_>>())
    };
    let faults = f64::from(survey.faults);
    svg.add(needed(path(&line(&|_| faults))));
    svg.add(largest_r(path(&line(&|point| f64::from(point.r_max)))));
    svg.add(largest_f(path(&line(&|point| f64::from(point.f_max)))));
}

fn path(points: &[[f64; 2]]) -> Element {
    let mut path = PathData::default();
    for (place, point) in points.iter().enumerate() {
        if place == 0 { path.start(*point) } else { path.continue_to(*point) }
    }
    path.element().text("fill", "none")
}

/// Line of r_max.
pub(crate) fn largest_r(line: Element) -> Element {
    line.text("stroke", NORMAL).number("stroke-width", 1.0)
}

/// Line of F_max.
pub(crate) fn largest_f(line: Element) -> Element {
    line.text("stroke", INK).number("stroke-width", 1.8)
}

/// Line of F.
pub(crate) fn needed(line: Element) -> Element {
    line.text("stroke", MALICIOUS).number("stroke-width", 1.2).text("stroke-dasharray", "4 2")
}

/// A whole number of a round, given its place in the run.
type Whole = fn(usize, &Round) -> i32;

/// Writes one row a round, for ticks of `tick_s`: `round`, `tick` (u32), `time_s`, `r_max`, `r_max_most`, `f_max`, `f_max_most` (i32; the two
/// differ where the search ran out of its budget), `degree` (i32, least of normal robots), `spread` (of normal values).
pub fn write_rounds<W: Write + Send>(
    rounds: &[Round],
    tick_s: f64,
    metadata: &Metadata<'_>,
    sink: W,
) -> Result<(), WriteError> {
    let mut writer = SerializedFileWriter::new(sink, schema()?, properties(metadata))?;
    let mut group = writer.next_row_group()?;
    let whole: [Whole; 7] = [
        |index, _| i32::try_from(index).unwrap_or(i32::MAX),
        |_, round| round.tick.cast_signed(),
        |_, round| round.r_max.least,
        |_, round| round.r_max.most,
        |_, round| round.f_max.least,
        |_, round| round.f_max.most,
        |_, round| i32::from(round.degree_min),
    ];
    for number in whole {
        let Some(mut column) = group.next_column()? else { return Err(WriteError::Ragged) };
        put::<Int32Type>(&mut column, rounds.iter().enumerate().map(|(index, round)| number(index, round)))?;
        column.close()?;
    }
    let times = rounds.iter().map(|round| f64::from(round.tick) * tick_s).collect();
    let spreads = rounds.iter().map(|round| round.spread).collect();
    for numbers in [times, spreads] as [Vec<f64>; 2] {
        let Some(mut column) = group.next_column()? else { return Err(WriteError::Ragged) };
        put::<DoubleType>(&mut column, numbers.into_iter())?;
        column.close()?;
    }
    group.close()?;
    writer.close()?;
    Ok(())
}

fn schema() -> Result<TypePtr, ParquetError> {
    let unsigned = Some(LogicalType::integer(32, false));
    let whole =
        ["r_max", "r_max_most", "f_max", "f_max_most", "degree"].map(|name| (name, Physical::INT32, None));
    let counts = ["round", "tick"].map(|name| (name, Physical::INT32, unsigned.clone()));
    let numbers = ["time_s", "spread"].map(|name| (name, Physical::DOUBLE, None));
    let fields = counts.into_iter().chain(whole).chain(numbers).map(|(name, physical, logical)| {
        let field = Type::primitive_type_builder(name, physical).with_repetition(Repetition::REQUIRED);
        Ok(Arc::new(field.with_logical_type(logical).build()?))
    });
    let fields = fields.collect::<Result<Vec<_>, ParquetError>>()?;
    Ok(Arc::new(Type::group_type_builder("closeranks").with_fields(fields).build()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::parquet::file::reader::{FileReader, SerializedFileReader};
    use closeranks_sim::scenario::Scenario;
    use closeranks_sim::world::{Options, run};

    fn rounds() -> Vec<Round> {
        let scenario = Scenario { duration_s: 0.35, ..Scenario::default() };
        run(&scenario, Options { robustness: true, ..Options::default() }, &mut |_| ()).unwrap().rounds
    }

    //= paper def:robustness type=test
    #[test]
    fn every_round_is_a_row() {
        let (rounds, mut file) = (rounds(), Vec::new());
        write_rounds(&rounds, 0.005, &Metadata::default(), &mut file).unwrap();
        let reader = SerializedFileReader::new(bytes::Bytes::from(file)).unwrap();
        let rows: Vec<String> =
            reader.get_row_iter(None).unwrap().map(|row| row.unwrap().to_string()).collect();
        assert_eq!(rows.len(), 4);
        assert!(
            rows[3].starts_with("{round: 3, tick: 60, r_max: 6, r_max_most: 6, f_max: 5,"),
            "{}",
            rows[3]
        );
    }

    #[test]
    fn the_figure_has_a_panel_a_run_and_three_lines_each() {
        let survey = Survey { title: "one", faults: 2, points: points(&rounds(), 0.005) };
        let svg = robustness(&[survey, Survey { title: "none", faults: 0, points: Vec::new() }]);
        assert!(svg.contains("(a) one") && svg.contains("(b) none") && svg.contains("time (s)"));
        assert!(crate::png::png(&svg, 1.0).is_ok());
        assert!(crate::png::png(&robustness(&[]), 1.0).is_ok());
    }
}
