//! Positions of a recorded run, read back from the Parquet file that [`crate::recording::write`] writes.

use ::parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use ::parquet::data_type::DataType;
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::RowGroupMetaData;
use ::parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
use bytes::Bytes;
use closeranks_graph::graph::set::NODE_LIMIT;
use closeranks_sim::parse::has_teams;

use super::elsewhere::{Cells, assemble};
use super::positions::{ROWS_MAX, ReadError, Recording};
use crate::decoding::decoded;
use crate::recording::columns::AXES;
use crate::recording::history::{COLUMNS, History, stride};

/// Reads the whole file.
///
/// The library that decodes Parquet panics on some broken files; such a panic is an error here.
pub fn read(file: Vec<u8>) -> Result<Recording, ReadError> {
    decoded(|| decode(file)).unwrap_or(Err(ReadError::Broken))
}

fn decode(file: Vec<u8>) -> Result<Recording, ReadError> {
    let Opened { reader, rows, scenario } = open(file)?;
    if scenario.is_none() {
        return assemble(|name| cells(&reader, name, rows));
    }
    let ticks = column(&reader, "tick", rows, words)?;
    let robots = column(&reader, "robot", rows, words)?;
    let count = robots_of(&ticks, &robots)?;
    let axes = |axis: &str| column(&reader, &format!("{axis}_m"), rows, doubles);
    let [x, y] = [axes(AXES[0])?, axes(AXES[1])?];
    all_there(&x, count)?;
    let spatial = names(&reader).iter().any(|name| name == "z_m");
    let z = if spatial { axes(AXES[2])? } else { vec![0.0; rows] };
    let positions_m = x.into_iter().zip(y).zip(z).map(|((x, y), z)| [x, y, z]).collect();
    Ok(Recording { scenario, robots: count, positions_m, times: Vec::new(), time_name: "tick" })
}

/// What a recording of ours looked like, moment by moment; of a long one not every tick.
pub fn history(file: Vec<u8>) -> Result<History, ReadError> {
    decoded(|| moments(file)).unwrap_or(Err(ReadError::Broken))
}

fn moments(file: Vec<u8>) -> Result<History, ReadError> {
    let Opened { reader, rows, scenario } = open(file)?;
    let scenario = scenario.ok_or_else(|| ReadError::Column("scenario (in the metadata)".to_owned()))?;
    let robots = robots_of(&column(&reader, "tick", rows, words)?, &column(&reader, "robot", rows, words)?)?;
    let stride = stride(rows / robots);
    let kept = |row: usize| (row / robots).is_multiple_of(stride);
    let mut columns: [Vec<f64>; COLUMNS.len()] = Default::default();
    for (name, kept_numbers) in COLUMNS.iter().zip(&mut columns) {
        let numbers = if *name == "degree" {
            column(&reader, name, rows, words)?.into_iter().map(f64::from).collect()
        } else {
            column(&reader, name, rows, doubles)?
        };
        kept_numbers.extend((0..rows).filter(|row| kept(*row)).map(|row| numbers[row]));
    }
    all_there(&columns[0], robots)?;
    let ticks = (0..rows / robots).step_by(stride);
    let ticks = ticks.map(|tick| u32::try_from(tick).unwrap_or(u32::MAX)).collect();
    Ok(History { scenario, robots, ticks, columns })
}

/// Refuses a run in which some robot, by its coordinates, was not in the plane.
fn all_there(x_m: &[f64], robots: usize) -> Result<(), ReadError> {
    match x_m.iter().position(|x| x.is_nan()) {
        Some(row) => Err(ReadError::Absent { robot: row % robots + 1, tick: row / robots }),
        None => Ok(()),
    }
}

/// A file that can be read.
struct Opened {
    reader: SerializedFileReader<Bytes>,
    rows: usize,
    /// The scenario of a recording of ours.
    scenario: Option<String>,
}

/// Opens a file that has rows, but not too many, and is whole.
fn open(file: Vec<u8>) -> Result<Opened, ReadError> {
    let length = file.len();
    let reader = SerializedFileReader::new(Bytes::from(file))?;
    if !is_inside(&reader, length) {
        return Err(ReadError::Broken);
    }
    let metadata = reader.metadata().file_metadata();
    let rows = usize::try_from(metadata.num_rows()).unwrap_or(0);
    if rows == 0 || rows as u64 > ROWS_MAX {
        return Err(ReadError::Rows(metadata.num_rows()));
    }
    let pairs = metadata.key_value_metadata().into_iter().flatten();
    let scenario = pairs.filter(|pair| pair.key == "scenario").find_map(|pair| pair.value.clone());
    if scenario.as_deref().is_some_and(has_teams) {
        return Err(ReadError::Teams);
    }
    Ok(Opened { reader, rows, scenario })
}

/// Whether every column lies inside of the file: the decoder takes that for granted.
fn is_inside(reader: &SerializedFileReader<Bytes>, length: usize) -> bool {
    let mut columns = reader.metadata().row_groups().iter().flat_map(RowGroupMetaData::columns);
    let most = i64::try_from(length).unwrap_or(i64::MAX);
    columns.all(|column| {
        let start = column.dictionary_page_offset().unwrap_or_else(|| column.data_page_offset());
        let size = column.compressed_size();
        start >= 0 && size >= 0 && start.checked_add(size).is_some_and(|end| end <= most)
    })
}

/// n, if every row is where it should be.
fn robots_of(ticks: &[i32], robots: &[i32]) -> Result<usize, ReadError> {
    let count = ticks.iter().take_while(|tick| **tick == 0).count();
    let wrong = |row: usize| {
        let n = count.max(1);
        ReadError::Order { row, tick: row / n, robot: row % n + 1 }
    };
    if count == 0 {
        return Err(wrong(0));
    }
    let is = |number: i32, wanted: usize| usize::try_from(number) == Ok(wanted);
    let stray =
        (0..ticks.len()).find(|&row| !(is(ticks[row], row / count) && is(robots[row], row % count + 1)));
    match stray {
        Some(row) => Err(wrong(row)),
        None if !ticks.len().is_multiple_of(count) => Err(wrong(ticks.len())),
        None if count > NODE_LIMIT => Err(ReadError::Robots(count)),
        None => Ok(count),
    }
}

fn names(reader: &SerializedFileReader<Bytes>) -> Vec<String> {
    let schema = reader.metadata().file_metadata().schema_descr_ptr();
    schema.columns().iter().map(|column| column.name().to_owned()).collect()
}

/// The column `name` of all row groups, without nulls.
fn column<T>(
    reader: &SerializedFileReader<Bytes>,
    name: &str,
    rows: usize,
    read: impl Fn(&dyn RowGroupReader, usize, &mut Vec<T>, usize) -> Result<bool, ParquetError>,
) -> Result<Vec<T>, ReadError> {
    let unknown = || ReadError::Column(name.to_owned());
    let place = names(reader).iter().position(|known| known == name).ok_or_else(unknown)?;
    if reader.metadata().file_metadata().schema_descr().column(place).max_def_level() > 0 {
        return Err(unknown());
    }
    let mut values = Vec::new();
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group)?;
        if !read(group.as_ref(), place, &mut values, rows)? {
            return Err(unknown());
        }
    }
    if values.len() == rows { Ok(values) } else { Err(ReadError::Ragged) }
}

/// The column `name` of a table of others, if there is one: numbers of any kind, or texts.
fn cells(reader: &SerializedFileReader<Bytes>, name: &str, rows: usize) -> Result<Option<Cells>, ReadError> {
    let Some(place) = names(reader).iter().position(|known| known == name) else { return Ok(None) };
    let unknown = |kind: &str| ReadError::Value {
        column: name.to_owned(),
        row: 1,
        found: kind.to_owned(),
        allowed: "numbers or texts, one a row".to_owned(),
    };
    let column = reader.metadata().file_metadata().schema_descr().column(place);
    if column.max_rep_level() > 0 || column.max_def_level() > 1 {
        return Err(unknown("in a list"));
    }
    let (mut numbers, mut texts): (Vec<f64>, Vec<String>) = Default::default();
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group)?;
        let before = numbers.len() + texts.len();
        let null = match group.get_column_reader(place)? {
            ColumnReader::Int32ColumnReader(reader) => {
                present(reader, rows, &mut numbers, |number| f64::from(*number))?
            }
            #[expect(clippy::cast_precision_loss, reason = "numbers beyond 2^53 are refused")]
            ColumnReader::Int64ColumnReader(reader) => {
                present(reader, rows, &mut numbers, |number| *number as f64)?
            }
            ColumnReader::FloatColumnReader(reader) => {
                present(reader, rows, &mut numbers, |number| f64::from(*number))?
            }
            ColumnReader::DoubleColumnReader(reader) => {
                present(reader, rows, &mut numbers, |number| *number)?
            }
            ColumnReader::ByteArrayColumnReader(reader) => {
                present(reader, rows, &mut texts, |text| String::from_utf8_lossy(text.data()).into_owned())?
            }
            _ => return Err(unknown("of another type")),
        };
        if let Some(row) = null {
            let (column, row) = (name.to_owned(), before + row + 1);
            let (found, allowed) = ("null".to_owned(), "a value in every row".to_owned());
            return Err(ReadError::Value { column, row, found, allowed });
        }
    }
    Ok(Some(if texts.is_empty() { Cells::Numbers(numbers) } else { Cells::Words(texts) }))
}

/// Reads a column that may have nulls to its end, at most `most` values and one block; the place of the first null, if there is
/// one.
fn present<T: DataType, V>(
    mut reader: ColumnReaderImpl<T>,
    most: usize,
    all: &mut Vec<V>,
    value: impl Fn(&T::T) -> V,
) -> Result<Option<usize>, ParquetError> {
    let mut done = 0;
    while all.len() <= most {
        let (mut values, mut levels) = (Vec::new(), Vec::new());
        let (records, ..) = reader.read_records(BLOCK, Some(&mut levels), None, &mut values)?;
        if values.len() < records {
            return Ok(Some(done + levels.iter().position(|level| *level == 0).unwrap_or(0)));
        }
        if records == 0 {
            break;
        }
        all.extend(values.iter().map(&value));
        done += records;
    }
    Ok(None)
}

fn words(
    group: &dyn RowGroupReader,
    place: usize,
    values: &mut Vec<i32>,
    most: usize,
) -> Result<bool, ParquetError> {
    match group.get_column_reader(place)? {
        ColumnReader::Int32ColumnReader(reader) => drain(reader, values, most).map(|()| true),
        _ => Ok(false),
    }
}

fn doubles(
    group: &dyn RowGroupReader,
    place: usize,
    values: &mut Vec<f64>,
    most: usize,
) -> Result<bool, ParquetError> {
    match group.get_column_reader(place)? {
        ColumnReader::DoubleColumnReader(reader) => drain(reader, values, most).map(|()| true),
        _ => Ok(false),
    }
}

/// Values read at once.
const BLOCK: usize = 1 << 16;

/// Reads until the end, but never more than `most` values and one block.
fn drain<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    values: &mut Vec<T::T>,
    most: usize,
) -> Result<(), ParquetError> {
    while values.len() <= most {
        let (records, ..) = reader.read_records(BLOCK, None, None, values)?;
        if records == 0 {
            break;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Row 200 used to be called "not of tick 1" where the trouble was that there were 200 robots.
    #[test]
    fn too_many_robots_are_called_so() {
        let ticks: Vec<i32> = (0..2).flat_map(|tick| [tick; 200]).collect();
        let robots: Vec<i32> = (0..2).flat_map(|_| 1..=200).collect();
        let told =
            |ticks: &[i32], robots: &[i32]| robots_of(ticks, robots).map_err(|error| error.to_string());
        assert_eq!(told(&ticks, &robots), Err("200 robots, allowed are 1 to 128".to_owned()));
        assert_eq!(told(&[0, 0, 1, 1], &[1, 2, 1, 2]), Ok(2));
        let stray = "row 3 is not of tick 1, robot 2: rows go by ticks, then robots from 1 on";
        assert_eq!(told(&[0, 0, 1, 1], &[1, 2, 1, 3]), Err(stray.to_owned()));
        assert_eq!(told(&[0, 0, 1], &[1, 2, 1]), Err(stray.to_owned()));
    }
}
