//! Ranges and groups of fields that several tables of a scenario text share.

use closeranks_core::message::VALUE_MAX;
use closeranks_core::settings::range::{Allowed, MAGNITUDE_MAX};

use super::column::Column;
use super::reader::{Reader, Section};

/// Any number that fits.
pub(crate) const ANY: Allowed = Allowed::Closed(-MAGNITUDE_MAX, MAGNITUDE_MAX);
/// A positive number.
pub(crate) const POSITIVE: Allowed = Allowed::LeftOpen(0.0, MAGNITUDE_MAX);
/// A positive number or 0.
pub(crate) const NOT_NEGATIVE: Allowed = Allowed::Closed(0.0, MAGNITUDE_MAX);
/// A probability, or a part of a whole.
pub(crate) const FRACTION: Allowed = Allowed::Closed(0.0, 1.0);
/// A delay, s; a message that takes longer is lost.
pub(crate) const DELAY: Allowed = Allowed::Closed(0.0, 60.0);
/// The period of an oscillation, s.
pub(crate) const PERIOD: Allowed = Allowed::Closed(1e-3, MAGNITUDE_MAX);
/// A value y_i that a message can hold.
pub(crate) const VALUE: Allowed = Allowed::Closed(-VALUE_MAX, VALUE_MAX);

/// Columns of a position, m.
pub(crate) const POSITION: [Column; 3] =
    [Column::new("x_m", ANY), Column::new("y_m", ANY), Column::new("z_m", ANY)];

/// Columns of a value of several numbers.
pub(crate) const NUMBERS: [Column; 3] =
    [Column::new("first", ANY), Column::new("second", ANY), Column::new("third", ANY)];

/// One kind of something: the word that the field `kind` holds, and what reads the other fields of that kind.
pub(crate) type Kind<T> = (&'static str, fn(&mut Reader, &mut Section<'_>) -> T);

/// Reads the field `kind` and all fields of that kind. Where `kind` is missing or wrong, the first of `kinds` is read.
pub(crate) fn one_kind<T>(reader: &mut Reader, section: &mut Section<'_>, kinds: &[Kind<T>]) -> T {
    let read = reader.kind(section, kinds).unwrap_or(kinds[0].1);
    read(reader, section)
}

/// Sets `field` to what was read, if anything was.
pub(crate) fn set<T>(field: &mut T, read: Option<T>) {
    if let Some(value) = read {
        *field = value;
    }
}

/// A number that is known to be small.
pub(crate) fn small(whole: u64) -> u16 {
    u16::try_from(whole).unwrap_or(u16::MAX)
}

/// Fields `min` and `max` of an interval that lies in ±10⁶ and is `least` to `most` by default.
pub(crate) fn interval(reader: &mut Reader, section: &mut Section<'_>, [least, most]: [f64; 2]) -> [f64; 2] {
    let min = reader.number_or(section, "min", ANY, least);
    [min, reader.number_or(section, "max", Allowed::Closed(min, MAGNITUDE_MAX), min.max(most))]
}

/// Fields `from_s` and `to_s`, which is not before it.
pub(crate) fn times(reader: &mut Reader, section: &mut Section<'_>) -> [f64; 2] {
    let (given, from_s) = (section.has("from_s"), reader.number(section, "from_s", NOT_NEGATIVE));
    // Beside a wrong `from_s` any `to_s` may be right.
    let least = if given { from_s.unwrap_or(0.0) } else { 1.0 };
    let to_s = reader.number(section, "to_s", Allowed::Closed(least, MAGNITUDE_MAX));
    let from_s = from_s.unwrap_or(1.0);
    [from_s, to_s.unwrap_or((from_s + 1.0).min(MAGNITUDE_MAX))]
}
