//! Exact robustness of every consensus round as a Parquet file: one row a round.

use std::io::Write;
use std::sync::Arc;

use ::parquet::basic::{LogicalType, Repetition, Type as Physical};
use ::parquet::data_type::{DoubleType, Int32Type};
use ::parquet::errors::ParquetError;
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::schema::types::{Type, TypePtr};
use closeranks_sim::monitors::robustness::Round;

use super::columns::put;
use super::write::{Metadata, WriteError, properties};

/// A whole number of a round, given its place in the run.
type Whole = fn(usize, &Round) -> i32;

/// Writes rounds while a run goes on, one row a round: `round`, `tick` (u32), `time_s`, `r_max`, `r_max_most`, `f_max`, `f_max_most`
/// (i32; the two differ where the search ran out of its budget), `degree` (i32, least of normal robots), `spread` (of normal
/// values).
pub struct RoundWriter<W: Write + Send> {
    writer: SerializedFileWriter<W>,
    tick_s: f64,
    /// How many rounds were written yet.
    written: usize,
}

impl<W: Write + Send> RoundWriter<W> {
    /// Begins a file for a run with ticks of `tick_s`.
    pub fn new(tick_s: f64, metadata: &Metadata<'_>, sink: W) -> Result<Self, WriteError> {
        let writer = SerializedFileWriter::new(sink, schema()?, properties(metadata))?;
        Ok(Self { writer, tick_s, written: 0 })
    }

    /// Writes the next `rounds`.
    pub fn write(&mut self, rounds: &[Round]) -> Result<(), WriteError> {
        let (first, tick_s) = (self.written, self.tick_s);
        let mut group = self.writer.next_row_group()?;
        for number in WHOLE {
            let Some(mut column) = group.next_column()? else { return Err(WriteError::Ragged) };
            put::<Int32Type>(&mut column, (first..).zip(rounds).map(|(index, round)| number(index, round)))?;
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
        self.written += rounds.len();
        Ok(())
    }

    /// Ends the file; the sink is flushed but not closed.
    pub fn finish(self) -> Result<(), WriteError> {
        self.writer.close()?;
        Ok(())
    }
}

/// The columns of whole numbers, in order.
const WHOLE: [Whole; 7] = [
    |index, _| i32::try_from(index).unwrap_or(i32::MAX),
    |_, round| round.tick.cast_signed(),
    |_, round| round.r_max.least,
    |_, round| round.r_max.most,
    |_, round| round.f_max.least,
    |_, round| round.f_max.most,
    |_, round| i32::from(round.degree_min),
];

/// Writes all `rounds` of a run, as a [`RoundWriter`] does part by part.
pub fn write_rounds<W: Write + Send>(
    rounds: &[Round],
    tick_s: f64,
    metadata: &Metadata<'_>,
    sink: W,
) -> Result<(), WriteError> {
    let mut writer = RoundWriter::new(tick_s, metadata, sink)?;
    writer.write(rounds)?;
    writer.finish()
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

    #[test]
    fn parts_go_on_counting() {
        let (rounds, mut file) = (rounds(), Vec::new());
        let mut writer = RoundWriter::new(0.005, &Metadata::default(), &mut file).unwrap();
        writer.write(&rounds[..1]).unwrap();
        writer.write(&rounds[1..]).unwrap();
        writer.finish().unwrap();
        let mut whole = Vec::new();
        write_rounds(&rounds, 0.005, &Metadata::default(), &mut whole).unwrap();
        let rows = |file: Vec<u8>| {
            let reader = SerializedFileReader::new(bytes::Bytes::from(file)).unwrap();
            reader.get_row_iter(None).unwrap().map(|row| row.unwrap().to_string()).collect::<Vec<_>>()
        };
        assert_eq!(rows(file), rows(whole));
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
}
