//! The columns of the Parquet file: where each comes from and how it is written.

use core::ops::Range;
use std::sync::Arc;

use ::parquet::basic::{LogicalType, Repetition, Type as Physical};
use ::parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int32Type};
use ::parquet::errors::ParquetError;
use ::parquet::file::writer::SerializedColumnWriter;
use ::parquet::schema::types::{Type, TypePtr};
use closeranks_sim::output::record::{Record, outcome_name};

/// Names of the axes.
pub(crate) const AXES: [&str; 3] = ["x", "y", "z"];

/// A column of the file.
pub(crate) struct Column<'a> {
    pub(crate) name: String,
    pub(crate) data: Data<'a>,
}

/// Where a column comes from.
pub(crate) enum Data<'a> {
    Tick,
    Time,
    Robot,
    Malicious,
    Numbers(&'a [f64]),
    /// Null where there is no number.
    Known(&'a [f64]),
    /// Null at the last tick.
    Inputs(&'a [f64]),
    Degree,
    Outcome,
}

/// All columns in their order.
pub(crate) fn columns(record: &Record) -> Vec<Column<'_>> {
    let column = |name: &str, data| Column { name: name.into(), data };
    let mut columns = vec![
        column("tick", Data::Tick),
        column("time_s", Data::Time),
        column("robot", Data::Robot),
        column("malicious", Data::Malicious),
    ];
    let axes = || AXES.iter();
    let positions = axes().zip(&record.positions_m);
    columns.extend(positions.map(|(axis, numbers)| column(&format!("{axis}_m"), Data::Numbers(numbers))));
    let inputs = axes().zip(&record.inputs_m_s);
    columns.extend(inputs.map(|(axis, numbers)| column(&format!("u{axis}_m_s"), Data::Inputs(numbers))));
    columns.push(column("degree", Data::Degree));
    columns.extend([
        column("level", Data::Numbers(&record.level)),
        column("told", Data::Known(&record.told)),
        column("h", Data::Numbers(&record.h)),
        column("phi_i", Data::Numbers(&record.phi)),
        column("value", Data::Numbers(&record.value)),
        column("value_told", Data::Known(&record.value_told)),
        column("degree_sensed", Data::Known(&record.degree_sensed)),
        column("level_sensed", Data::Known(&record.level_sensed)),
    ]);
    for (place, (held, told)) in (2..).zip(record.more_values.iter().zip(&record.more_values_told)) {
        columns.push(column(&format!("value_{place}"), Data::Numbers(held)));
        columns.push(column(&format!("value_told_{place}"), Data::Known(told)));
    }
    columns.push(column("outcome", Data::Outcome));
    columns
}

impl Data<'_> {
    fn kind(&self) -> (Physical, Option<LogicalType>) {
        match self {
            Self::Tick => (Physical::INT32, Some(LogicalType::integer(32, false))),
            Self::Robot | Self::Degree => (Physical::INT32, Some(LogicalType::integer(16, false))),
            Self::Malicious => (Physical::BOOLEAN, None),
            Self::Time | Self::Numbers(_) | Self::Known(_) | Self::Inputs(_) => (Physical::DOUBLE, None),
            Self::Outcome => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        }
    }

    /// Its place in the schema.
    pub(crate) fn field(&self, name: &str) -> Result<TypePtr, ParquetError> {
        let (physical, logical) = self.kind();
        let optional = matches!(self, Self::Inputs(_) | Self::Known(_));
        let repetition = if optional { Repetition::OPTIONAL } else { Repetition::REQUIRED };
        let field = Type::primitive_type_builder(name, physical);
        Ok(Arc::new(field.with_repetition(repetition).with_logical_type(logical).build()?))
    }

    /// Writes `rows` of it and closes the column; there are no inputs from row `end` on.
    pub(crate) fn write(
        &self,
        record: &Record,
        rows: Range<usize>,
        end: usize,
        mut column: SerializedColumnWriter<'_>,
    ) -> Result<(), ParquetError> {
        let robots = usize::from(record.robots).max(1);
        let target = &mut column;
        match self {
            Self::Tick => put::<Int32Type>(target, rows.map(|row| record.ticks[row / robots].cast_signed()))?,
            Self::Time => put::<DoubleType>(target, rows.map(|row| record.time_s(row / robots)))?,
            Self::Robot => put::<Int32Type>(target, rows.map(|row| word(row % robots + 1)))?,
            Self::Malicious => put::<BoolType>(target, rows.map(|row| record.malicious[row % robots]))?,
            Self::Numbers(numbers) => put::<DoubleType>(target, numbers[rows].iter().copied())?,
            Self::Known(numbers) => put_known(target, &numbers[rows])?,
            Self::Inputs(numbers) => put_inputs(target, numbers, rows, end)?,
            Self::Degree => {
                put::<Int32Type>(target, record.degree[rows].iter().map(|degree| i32::from(*degree)))?;
            }
            Self::Outcome => {
                let names = record.outcome[rows].iter().map(|outcome| outcome_name(*outcome));
                put::<ByteArrayType>(target, names.map(ByteArray::from))?;
            }
        }
        column.close()
    }
}

/// Bits of an unsigned number; robots are below 2³².
fn word(number: usize) -> i32 {
    u32::try_from(number).unwrap_or(u32::MAX).cast_signed()
}

/// Writes the values of a column.
pub(crate) fn put<T: DataType>(
    column: &mut SerializedColumnWriter<'_>,
    values: impl Iterator<Item = T::T>,
) -> Result<(), ParquetError> {
    let values: Vec<T::T> = values.collect();
    column.typed::<T>().write_batch(&values, None, None)?;
    Ok(())
}

/// Numbers, or null where there is none.
fn put_known(column: &mut SerializedColumnWriter<'_>, numbers: &[f64]) -> Result<(), ParquetError> {
    let levels: Vec<i16> = numbers.iter().map(|number| i16::from(!number.is_nan())).collect();
    let known: Vec<f64> = numbers.iter().copied().filter(|number| !number.is_nan()).collect();
    column.typed::<DoubleType>().write_batch(&known, Some(&levels), None)?;
    Ok(())
}

/// Inputs of `rows`; from row `end` on they are null.
fn put_inputs(
    column: &mut SerializedColumnWriter<'_>,
    numbers: &[f64],
    rows: Range<usize>,
    end: usize,
) -> Result<(), ParquetError> {
    let levels: Vec<i16> = rows.clone().map(|row| i16::from(row < end)).collect();
    let known = &numbers[rows.start..rows.end.min(end).max(rows.start)];
    column.typed::<DoubleType>().write_batch(known, Some(&levels), None)?;
    Ok(())
}
