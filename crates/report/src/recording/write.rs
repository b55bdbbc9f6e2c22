//! A record as a Parquet file: one row a tick and robot, units in the names of the columns.
//!
//! ```text
//! tick u32 | time_s f64 | robot u16 from 1 | malicious bool | x_m, y_m[, z_m] f64
//! ux_m_s, uy_m_s[, uz_m_s] f64, the input held from this tick on, null at the last tick
//! degree u16, δ_i | level f64, c_i | told f64, c_i as told | h f64, level − F′ | phi_i f64 | value f64, y_i as held
//! value_told f64, y_i as told | degree_sensed f64 | level_sensed f64 | value_2, value_told_2[, value_3, value_told_3] f64 of values of
//! several numbers | outcome string: free, active or infeasible
//! ```
//!
//! `degree`, `level` and `h` are what is so, computed from the positions; what the robot senses itself, with whatever is wrong
//! with its sensors, are the columns that say so. Those and what was told are null for a robot that is down, and what was told
//! also where a liar does not tell all the same.
//!
//! Ticks run from 0 to the last, both included. The file's key-value metadata are `scenario` (TOML), `seed`, `version`, `commit`,
//! and `q1` and `q2` of the weight that the controller gives to links: `level`, `told` and `h` are about that one, `phi_i` about
//! the paper's, which is that of the scenario. The same record and metadata give the same bytes.

use core::ops::Range;
use std::io::Write;
use std::sync::Arc;

use ::parquet::basic::Compression;
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::{WriterProperties, WriterPropertiesPtr};
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::schema::types::{Type, TypePtr};
pub use closeranks_mcap::Metadata;
use closeranks_sim::output::parts::part_ticks;
use closeranks_sim::output::record::{PART_ROWS, Record};

use crate::recording::columns::{AXES, Column, columns};

/// Why there is no file.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The columns of the record differ in length, or do not end with a whole tick.
    #[error("the columns of the record differ in length")]
    Ragged,
    /// Writing failed.
    #[error("the record cannot be written as Parquet")]
    Parquet(#[from] ParquetError),
}

/// Writes a record part by part, each as a row group of its own.
pub struct PartWriter<W: Write + Send> {
    writer: SerializedFileWriter<W>,
}

impl<W: Write + Send> PartWriter<W> {
    /// Begins a file for records like `record`, which may be empty.
    pub fn new(record: &Record, metadata: &Metadata<'_>, sink: W) -> Result<Self, WriteError> {
        let schema = schema(&columns(record))?;
        Ok(Self { writer: SerializedFileWriter::new(sink, schema, properties(metadata))? })
    }

    /// Writes a part that others follow.
    pub fn write(&mut self, part: &Record) -> Result<(), WriteError> {
        check(part)?;
        self.group(part, 0..part.rows(), part.rows())
    }

    /// Writes the last part and ends the file; the sink is flushed but not closed.
    pub fn finish(self, part: &Record) -> Result<(), WriteError> {
        self.finish_in(part, part_ticks(part.robots))
    }

    /// The last part in row groups of so many ticks.
    fn finish_in(mut self, part: &Record, group_ticks: usize) -> Result<(), WriteError> {
        check(part)?;
        let end = part.row(part.last_tick(), 0);
        let group_rows = part.row(group_ticks, 0).max(1);
        for start in (0..part.rows()).step_by(group_rows) {
            self.group(part, start..part.rows().min(start + group_rows), end)?;
        }
        self.writer.close()?;
        Ok(())
    }

    fn group(&mut self, record: &Record, rows: Range<usize>, end: usize) -> Result<(), WriteError> {
        let mut group = self.writer.next_row_group()?;
        for column in &columns(record) {
            let Some(target) = group.next_column()? else { return Err(WriteError::Ragged) };
            column.data.write(record, rows.clone(), end, target)?;
        }
        group.close()?;
        Ok(())
    }
}

/// Writes a whole `record`, as a [`PartWriter`] does part by part; `sink` is flushed but not closed. Fails if the sink does, or if the
/// record is ragged.
pub fn write<W: Write + Send>(record: &Record, metadata: &Metadata<'_>, sink: W) -> Result<(), WriteError> {
    PartWriter::new(record, metadata, sink)?.finish(record)
}

fn check(record: &Record) -> Result<(), WriteError> {
    let (rows, dimension) = (record.rows(), record.dimension);
    let numbers = record.numbers();
    let full = numbers.iter().all(|column| column.len() == rows) && record.outcome.len() == rows;
    let full = full && record.ticks.len() * usize::from(record.robots) == rows;
    let whole =
        record.malicious.len() == usize::from(record.robots) && rows % record.malicious.len().max(1) == 0;
    let wide = [&record.positions_m, &record.inputs_m_s].iter().all(|columns| columns.len() == dimension);
    if full && whole && wide && dimension <= AXES.len() { Ok(()) } else { Err(WriteError::Ragged) }
}

fn schema(columns: &[Column<'_>]) -> Result<TypePtr, ParquetError> {
    let fields = columns.iter().map(|column| column.data.field(&column.name)).collect::<Result<_, _>>()?;
    Ok(Arc::new(Type::group_type_builder("closeranks").with_fields(fields).build()?))
}

/// Snappy everywhere; dictionaries only where values repeat.
pub(crate) fn properties(metadata: &Metadata<'_>) -> WriterPropertiesPtr {
    let seed = metadata.seed.to_string();
    let [q1, q2] = metadata.weight.map(|number| number.to_string());
    let pairs = [
        ("scenario", metadata.scenario),
        ("seed", &seed),
        ("version", metadata.version),
        ("commit", metadata.commit),
        ("q1", &q1),
        ("q2", &q2),
    ];
    let pairs = pairs.map(|(key, value)| KeyValue::new(key.to_owned(), value.to_owned()));
    let mut properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_max_row_group_row_count(Some(PART_ROWS))
        .set_dictionary_enabled(false)
        .set_key_value_metadata(Some(pairs.into()));
    for name in ["tick", "time_s", "robot", "degree", "value", "value_told", "degree_sensed", "outcome"] {
        properties = properties.set_column_dictionary_enabled(name.into(), true);
    }
    Arc::new(properties.build())
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::parquet::file::metadata::RowGroupMetaData;
    use ::parquet::file::reader::{FileReader, SerializedFileReader};
    use closeranks_sim::scenario::Scenario;
    use closeranks_sim::world::{Options, run};

    fn short_run() -> Record {
        let scenario = Scenario { duration_s: 0.01, ..Scenario::default() };
        run(&scenario, Options { record: true, ..Options::default() }, &mut |_| ()).unwrap().record.unwrap()
    }

    #[test]
    fn row_groups_are_bounded_and_lose_nothing() {
        let (record, mut file) = (short_run(), Vec::new());
        let writer = PartWriter::new(&record, &Metadata::default(), &mut file).unwrap();
        writer.finish_in(&record, 2).unwrap();
        let reader = SerializedFileReader::new(bytes::Bytes::from(file)).unwrap();
        let groups = reader.metadata().row_groups().iter().map(RowGroupMetaData::num_rows);
        assert_eq!(groups.collect::<Vec<_>>(), [22, 11]);
        let inputs =
            |row: ::parquet::record::Row| row.get_column_iter().nth(6).map(|(_, field)| field.to_string());
        let inputs: Vec<_> =
            reader.get_row_iter(None).unwrap().map(|row| inputs(row.unwrap()).unwrap()).collect();
        assert_eq!(inputs.iter().filter(|input| *input == "null").count(), 11);
        assert!(inputs[22..].iter().all(|input| input == "null"), "{inputs:?}");
    }

    /// A long run is written while it goes on; whoever reads it sees no difference.
    #[test]
    fn parts_and_the_whole_are_the_same_file() {
        let (record, [mut whole, mut parts]) = (short_run(), [Vec::new(), Vec::new()]);
        let writer = PartWriter::new(&record, &Metadata::default(), &mut whole).unwrap();
        writer.finish_in(&record, 2).unwrap();
        let mut part = Record { ..record.clone() };
        part.clear();
        let mut writer = PartWriter::new(&part, &Metadata::default(), &mut parts).unwrap();
        (0..2).for_each(|place| part.copy(&record, place));
        writer.write(&part).unwrap();
        part.clear();
        part.copy(&record, 2);
        writer.finish(&part).unwrap();
        assert!(whole == parts);
    }

    #[test]
    fn ragged_records_are_refused() {
        let mut record = short_run();
        record.phi.pop();
        let error = write(&record, &Metadata::default(), Vec::new()).unwrap_err();
        assert!(matches!(error, WriteError::Ragged));
    }

    #[test]
    fn a_full_disk_is_an_error() {
        let mut room = [0_u8; 100];
        let result = write(&short_run(), &Metadata::default(), room.as_mut_slice());
        assert!(matches!(result, Err(WriteError::Parquet(_))));
    }
}
