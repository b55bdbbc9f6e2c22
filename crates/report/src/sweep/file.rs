//! Rows as a Parquet file, written and read back in groups of bounded size.

use std::io::Write;
use std::sync::Arc;

use ::parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use ::parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use ::parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::WriterProperties;
pub use ::parquet::file::reader::ChunkReader as Source;
use ::parquet::file::reader::{ChunkReader, FileReader, RowGroupReader, SerializedFileReader};
use ::parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use ::parquet::schema::types::{ColumnDescriptor, Type, TypePtr};

use super::rows::{Head, Kind, Rows, Values};
use crate::decoding::decoded;
use crate::recording::write::WriteError;

/// A group is written as soon as so many rows wait, so it may have a block of rows more. Writers and readers hold one group.
const GROUP_ROWS: usize = 1 << 15;

/// A Parquet file that is being written.
pub struct Writer<W: Write + Send> {
    file: SerializedFileWriter<W>,
    waiting: Rows,
}

impl<W: Write + Send> Writer<W> {
    /// An empty file with columns `heads`; `metadata` are pairs of key and value that the file says about itself.
    pub fn new(sink: W, heads: &[Head], metadata: &[(&str, String)]) -> Result<Self, WriteError> {
        let pairs = metadata.iter().map(|(key, value)| KeyValue::new((*key).to_owned(), value.clone()));
        let properties = WriterProperties::builder()
            .set_compression(Compression::SNAPPY)
            .set_max_row_group_row_count(Some(GROUP_ROWS))
            .set_key_value_metadata(Some(pairs.collect()));
        let file = SerializedFileWriter::new(sink, schema(heads)?, Arc::new(properties.build()))?;
        Ok(Self { file, waiting: Rows::empty(heads) })
    }

    /// Adds rows; fails if their columns are not those of the file.
    pub fn add(&mut self, rows: Rows) -> Result<(), WriteError> {
        if !self.waiting.append(rows) {
            return Err(WriteError::Ragged);
        }
        if self.waiting.count() >= GROUP_ROWS { self.write() } else { Ok(()) }
    }

    /// Ends the file and gives the sink back.
    pub fn finish(mut self) -> Result<W, WriteError> {
        self.write()?;
        Ok(self.file.into_inner()?)
    }

    fn write(&mut self) -> Result<(), WriteError> {
        let heads = self.waiting.heads().to_vec();
        let rows = core::mem::replace(&mut self.waiting, Rows::empty(&heads));
        if rows.count() == 0 {
            return Ok(());
        }
        let mut group = self.file.next_row_group()?;
        for column in rows.columns() {
            let Some(target) = group.next_column()? else { return Err(WriteError::Ragged) };
            write_column(column, target)?;
        }
        group.close()?;
        Ok(())
    }
}

fn schema(heads: &[Head]) -> Result<TypePtr, ParquetError> {
    let fields = heads.iter().map(|head| {
        let (physical, logical) = match head.kind {
            Kind::Whole => (Physical::INT64, None),
            Kind::Number => (Physical::DOUBLE, None),
            Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let field = Type::primitive_type_builder(&head.name, physical).with_repetition(Repetition::OPTIONAL);
        Ok(Arc::new(field.with_logical_type(logical).build()?))
    });
    let fields = fields.collect::<Result<Vec<_>, ParquetError>>()?;
    Ok(Arc::new(Type::group_type_builder("closeranks").with_fields(fields).build()?))
}

fn write_column(column: &Values, mut target: SerializedColumnWriter<'_>) -> Result<(), ParquetError> {
    match column {
        Values::Whole(cells) => put::<Int64Type>(&mut target, cells)?,
        Values::Number(cells) => put::<DoubleType>(&mut target, cells)?,
        Values::Text(cells) => {
            let cells = cells.iter().map(|cell| cell.as_deref().map(ByteArray::from));
            put::<ByteArrayType>(&mut target, &cells.collect::<Vec<_>>())?;
        }
    }
    target.close()
}

fn put<T: DataType>(
    target: &mut SerializedColumnWriter<'_>,
    cells: &[Option<T::T>],
) -> Result<(), ParquetError> {
    let levels: Vec<i16> = cells.iter().map(|cell| i16::from(cell.is_some())).collect();
    let known: Vec<T::T> = cells.iter().flatten().cloned().collect();
    target.typed::<T>().write_batch(&known, Some(&levels), None)?;
    Ok(())
}

/// What a file says about itself: the pairs of [`Writer::new`].
///
/// Panics of the library are errors, as in [`read`].
pub fn metadata<R: ChunkReader + 'static>(source: R) -> Result<Vec<(String, String)>, ParquetError> {
    let pairs = || {
        let reader = SerializedFileReader::new(source)?;
        let pairs = reader.metadata().file_metadata().key_value_metadata().into_iter().flatten();
        Ok(pairs.map(|pair| (pair.key.clone(), pair.value.clone().unwrap_or_default())).collect())
    };
    decoded(pairs).unwrap_or_else(broken)
}

/// Reads the columns `names`, or all if there are none of these, group by group.
///
/// The library that decodes Parquet panics on some broken files; such a panic is an error here.
pub fn read<R: ChunkReader + 'static>(
    source: R,
    names: &[&str],
    each: &mut dyn FnMut(Rows),
) -> Result<(), ParquetError> {
    Groups::of(source)?.wanting(names).try_for_each(|rows| {
        each(rows?);
        Ok(())
    })
}

/// Instead of a panic.
fn broken<T>() -> Result<T, ParquetError> {
    Err(ParquetError::General("it contradicts itself".to_owned()))
}

/// The rows of a file, a group at a time: what [`read`] gives to its function, to be asked for. Panics of the library are errors, too.
pub struct Groups<R: ChunkReader + 'static> {
    reader: SerializedFileReader<R>,
    /// The columns that are read, or none of them for all.
    names: Vec<String>,
    next: usize,
}

impl<R: ChunkReader + 'static> Groups<R> {
    /// Those of a file.
    pub fn of(source: R) -> Result<Self, ParquetError> {
        let reader = decoded(|| SerializedFileReader::new(source)).unwrap_or_else(broken)?;
        Ok(Self { reader, names: Vec::new(), next: 0 })
    }

    /// With the columns `names` only, or with all if there are none of these.
    fn wanting(self, names: &[&str]) -> Self {
        Self { names: names.iter().map(|name| (*name).to_owned()).collect(), ..self }
    }
}

impl<R: ChunkReader + 'static> Iterator for Groups<R> {
    type Item = Result<Rows, ParquetError>;

    fn next(&mut self) -> Option<Self::Item> {
        let group = self.next;
        self.next += 1;
        let decode = || rows_of(&self.reader, group, &self.names);
        (group < self.reader.num_row_groups()).then(|| decoded(decode).unwrap_or_else(broken))
    }
}

/// A group of rows, with the columns `names`, or all if there are none of these.
fn rows_of<R: ChunkReader + 'static>(
    reader: &SerializedFileReader<R>,
    group: usize,
    names: &[String],
) -> Result<Rows, ParquetError> {
    let schema = reader.metadata().file_metadata().schema_descr_ptr();
    let wanted =
        |column: &ColumnDescriptor| names.is_empty() || names.iter().any(|name| name == column.name());
    let places = schema.columns().iter().enumerate().filter(|(_, column)| wanted(column));
    let places: Vec<(usize, Head)> =
        places.map(|(place, column)| (place, Head::new(column.name(), kind(column)))).collect();
    let group = reader.get_row_group(group)?;
    let columns = places.iter().map(|(place, _)| column(group.as_ref(), *place));
    let columns = columns.collect::<Result<Vec<Values>, ParquetError>>()?;
    let heads = places.iter().map(|(_, head)| head.clone()).collect();
    let ragged = || ParquetError::General("its columns differ in length".to_owned());
    Rows::of(heads, columns).ok_or_else(ragged)
}

fn kind(column: &ColumnDescriptor) -> Kind {
    match column.physical_type() {
        Physical::INT64 => Kind::Whole,
        Physical::DOUBLE => Kind::Number,
        _ => Kind::Text,
    }
}

fn column(group: &dyn RowGroupReader, place: usize) -> Result<Values, ParquetError> {
    let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
    match group.get_column_reader(place)? {
        ColumnReader::Int64ColumnReader(reader) => Ok(Values::Whole(take(reader, rows)?)),
        ColumnReader::DoubleColumnReader(reader) => Ok(Values::Number(take(reader, rows)?)),
        ColumnReader::ByteArrayColumnReader(reader) => {
            let text = |bytes: ByteArray| Ok(bytes.as_utf8()?.to_owned());
            let cells = take(reader, rows)?.into_iter().map(|cell| cell.map(text).transpose());
            Ok(Values::Text(cells.collect::<Result<_, ParquetError>>()?))
        }
        _ => Err(ParquetError::General("a column is of a type that no sweep has".to_owned())),
    }
}

/// The cells of a column; null where it says so.
fn take<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    rows: usize,
) -> Result<Vec<Option<T::T>>, ParquetError> {
    let (mut levels, mut known) = (Vec::new(), Vec::new());
    while levels.len() < rows {
        let (read, ..) = reader.read_records(rows - levels.len(), Some(&mut levels), None, &mut known)?;
        if read == 0 {
            break;
        }
    }
    let mut known = known.into_iter();
    Ok(levels.into_iter().map(|level| if level > 0 { known.next() } else { None }).collect())
}
