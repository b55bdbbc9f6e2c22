//! What a robot with held links tells: whom it lists, what it has received, what it wishes. Bounded, and parsed or refused.
//!
//! ```text
//! byte   0    2        3      4          5  6      8       16     24     32           32 + 8 D
//!        "CR" version  flags  dimension  0  count  number  value  price  wish, 8 D    count entries      all little-endian
//! entry  0   2      3
//!        id  flags  acknowledged                                                      11 bytes
//! ```
//!
//! Entries come in rising order of ids, and each says something. So one message has one form, and a message of a robot with
//! N neighbours has `32 + 8 D + 11 N` bytes, at most [`bytes_max`].

use crate::controller::links::protocol::{Entry, Number, Word};
use crate::id::RobotId;
use crate::message::{MessageError, VALUE_MAX};
use crate::num::{Vector, is_finite};
use crate::settings::range::{MAGNITUDE_MAX, ROBOTS_MAX};

const MAGIC: [u8; 2] = *b"CR";
/// The version of these messages; others have another one.
pub const VERSION: u8 = 3;
const HAS_VALUE: u8 = 1;
const HEAD_BYTES: usize = 32;
const ENTRY_BYTES: usize = 11;
const LISTED: u8 = 1;
const PROMISED: u8 = 2;

/// The part of a message that is the same for all who receive it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Head<const D: usize> {
    /// Number of the message among those of its sender. It is the time on the sender's clock, ns, or more.
    pub number: Number,
    /// Told value `y_i`, at most [`VALUE_MAX`] in magnitude, in a consensus round.
    pub value: Option<f64>,
    /// How far apart two robots must end for the sender to promise them a release, m, at least 0; it may be infinite.
    pub price_m: f64,
    /// Where the sender wants to go, m/s, each component at most [`MAGNITUDE_MAX`] in magnitude.
    pub wish_m_s: Vector<D>,
}

/// What a message says of one robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Item {
    /// Of whom.
    pub id: RobotId,
    /// Whether it is listed, and what was received of it.
    pub entry: Entry,
    /// Whether it is promised a release.
    pub promised: bool,
}

/// What a message says to one robot that receives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Notice<const D: usize> {
    /// What it says to all.
    pub head: Head<D>,
    /// What it says of the receiver.
    pub word: Word,
    /// Whether it promises the receiver a release.
    pub promised: bool,
}

/// A message that was parsed: everything in it is finite and in range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkMessage<'a, const D: usize> {
    head: Head<D>,
    entries: &'a [u8],
}

/// The length of the longest message of a team of so many robots in so many dimensions, bytes.
#[must_use]
pub const fn bytes_max(robots: u16, dimension: usize) -> usize {
    HEAD_BYTES + 8 * dimension + ENTRY_BYTES * (robots as usize).saturating_sub(1)
}

impl<'a, const D: usize> LinkMessage<'a, D> {
    /// Reads what came from the network; anything but the exact form is refused.
    pub fn parse(bytes: &'a [u8]) -> Result<Self, MessageError> {
        let (fixed, rest) =
            bytes.split_first_chunk::<HEAD_BYTES>().ok_or(MessageError::Length(bytes.len()))?;
        let [m0, m1, version, flags, dimension, zero, c0, c1, numbers @ ..] = *fixed;
        if [m0, m1] != MAGIC {
            return Err(MessageError::Magic);
        }
        if version != VERSION {
            return Err(MessageError::Version(version));
        }
        if usize::from(dimension) != D || zero != 0 {
            return Err(MessageError::Dimension(dimension));
        }
        let count = usize::from(u16::from_le_bytes([c0, c1]));
        if count >= usize::from(ROBOTS_MAX) || rest.len() != 8 * D + ENTRY_BYTES * count {
            return Err(MessageError::Length(bytes.len()));
        }
        let (number, value, price) = (word(&numbers, 0), word(&numbers, 8), word(&numbers, 16));
        if flags > HAS_VALUE || (flags == 0 && value != 0) {
            return Err(MessageError::Flags(flags));
        }
        let head = Head {
            number: Number(number),
            value: (flags == HAS_VALUE).then_some(f64::from_bits(value)),
            price_m: f64::from_bits(price),
            wish_m_s: core::array::from_fn(|d| f64::from_bits(word(rest, 8 * d))),
        };
        let message = Self { head: head.checked()?, entries: rest.get(8 * D..).unwrap_or(&[]) };
        if message.is_in_order() { Ok(message) } else { Err(MessageError::Entries) }
    }

    /// What it says to all.
    #[must_use]
    pub fn head(&self) -> &Head<D> {
        &self.head
    }

    /// What it says of each robot that it names, in rising order of ids.
    pub fn items(&self) -> impl Iterator<Item = Item> + Clone + use<'a, D> {
        self.entries.as_chunks::<ENTRY_BYTES>().0.iter().map(item)
    }

    /// What it says to robot `id`. Whom it does not name it does not list.
    #[must_use]
    pub fn to(&self, id: RobotId) -> Notice<D> {
        let (entries, _) = self.entries.as_chunks::<ENTRY_BYTES>();
        let found = entries.binary_search_by_key(&id, |entry| item(entry).id).ok();
        let nothing = Item { id, entry: Entry::default(), promised: false };
        let Item { entry, promised, .. } = found.map_or(nothing, |index| item(&entries[index]));
        Notice { head: self.head, word: Word { number: self.head.number, entry }, promised }
    }

    /// True if ids rise from 1, and every entry is of a known kind and says something.
    fn is_in_order(&self) -> bool {
        let (mut before, mut is_in_order) = (0, true);
        for entry in self.entries.as_chunks::<ENTRY_BYTES>().0 {
            let [i0, i1, flags, acknowledged @ ..] = *entry;
            let (id, says) =
                (u16::from_le_bytes([i0, i1]), flags != 0 || u64::from_le_bytes(acknowledged) != 0);
            is_in_order &= id > before && flags <= LISTED | PROMISED && says;
            before = id;
        }
        is_in_order && before <= ROBOTS_MAX
    }
}

impl<const D: usize> Head<D> {
    /// The head itself, if every number in it is in range.
    pub fn checked(self) -> Result<Self, MessageError> {
        if self.value.is_some_and(|value| !(-VALUE_MAX..=VALUE_MAX).contains(&value)) {
            return Err(MessageError::Value);
        }
        if !(0.0..=f64::INFINITY).contains(&self.price_m) {
            return Err(MessageError::Price);
        }
        let fits = |component: &f64| component.abs() <= MAGNITUDE_MAX;
        if !is_finite(&self.wish_m_s) || !self.wish_m_s.iter().all(fits) {
            return Err(MessageError::Wish);
        }
        Ok(self)
    }

    /// Writes the message with these `items`, in rising order of ids, and gives its length. Items that say nothing are left out.
    ///
    /// `None` if `bytes` is too short, or if there are more items than a team can have.
    pub fn encode(&self, items: impl Iterator<Item = Item>, bytes: &mut [u8]) -> Option<usize> {
        let (head, entries) = bytes.split_at_mut_checked(HEAD_BYTES + 8 * D)?;
        let mut count = 0_u16;
        let mut places = entries.chunks_exact_mut(ENTRY_BYTES);
        for item in items.filter(|item| item.promised || item.entry != Entry::default()) {
            write(&item, places.next()?);
            count = count.checked_add(1)?;
        }
        head[..2].copy_from_slice(&MAGIC);
        head[2] = VERSION;
        head[3] = if self.value.is_some() { HAS_VALUE } else { 0 };
        (head[4], head[5]) = (u8::try_from(D).ok()?, 0);
        head[6..8].copy_from_slice(&count.to_le_bytes());
        head[8..16].copy_from_slice(&self.number.0.to_le_bytes());
        head[16..24].copy_from_slice(&self.value.unwrap_or(0.0).to_le_bytes());
        head[24..32].copy_from_slice(&self.price_m.to_le_bytes());
        for (place, component) in head[HEAD_BYTES..].chunks_exact_mut(8).zip(&self.wish_m_s) {
            place.copy_from_slice(&component.to_le_bytes());
        }
        Some(HEAD_BYTES + 8 * D + ENTRY_BYTES * usize::from(count))
    }
}

/// The entry in [`ENTRY_BYTES`] bytes.
fn item(bytes: &[u8; ENTRY_BYTES]) -> Item {
    let [i0, i1, flags, acknowledged @ ..] = *bytes;
    let acknowledged = Number(u64::from_le_bytes(acknowledged));
    Item {
        id: RobotId(u16::from_le_bytes([i0, i1])),
        entry: Entry { listed: flags & LISTED != 0, acknowledged },
        promised: flags & PROMISED != 0,
    }
}

fn write(item: &Item, bytes: &mut [u8]) {
    bytes[..2].copy_from_slice(&item.id.0.to_le_bytes());
    bytes[2] = if item.entry.listed { LISTED } else { 0 } | if item.promised { PROMISED } else { 0 };
    bytes[3..].copy_from_slice(&item.entry.acknowledged.0.to_le_bytes());
}

/// The eight bytes from `start` on.
fn word(bytes: &[u8], start: usize) -> u64 {
    let mut word = [0; 8];
    word.copy_from_slice(&bytes[start..start + 8]);
    u64::from_le_bytes(word)
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec::Vec;

    use super::*;

    fn example() -> (Head<2>, [Item; 3]) {
        let head =
            Head { number: Number(77), value: Some(-3.5), price_m: f64::INFINITY, wish_m_s: [0.25, -1.0] };
        let entry = |listed, acknowledged| Entry { listed, acknowledged: Number(acknowledged) };
        let items = [
            Item { id: RobotId(1), entry: entry(true, 0), promised: false },
            Item { id: RobotId(4), entry: entry(false, u64::MAX), promised: false },
            Item { id: RobotId(5), entry: entry(true, 9), promised: true },
        ];
        (head, items)
    }

    fn bytes() -> Vec<u8> {
        let (head, items) = example();
        let mut bytes = [0; 81];
        assert_eq!(head.encode(items.into_iter(), &mut bytes), Some(81));
        bytes.to_vec()
    }

    #[test]
    fn what_is_encoded_is_parsed_again() {
        let (head, items) = example();
        let bytes = bytes();
        let message = LinkMessage::<2>::parse(&bytes).unwrap();
        assert_eq!((*message.head(), message.items().collect::<Vec<_>>()), (head, items.to_vec()));
        let Notice { word, promised, .. } = message.to(RobotId(5));
        assert_eq!((word, promised), (Word { number: Number(77), entry: items[2].entry }, true));
        assert_eq!(message.to(RobotId(2)).word.entry, Entry::default());
        assert_eq!(bytes_max(4, 2), bytes.len());
        assert_eq!(head.encode(items.into_iter(), &mut [0; 80]), None);
    }

    #[test]
    fn other_bytes_are_refused_with_the_reason() {
        let bytes = bytes();
        let with = |at: usize, patch: &[u8]| {
            let mut changed = bytes.clone();
            changed[at..at + patch.len()].copy_from_slice(patch);
            LinkMessage::<2>::parse(&changed).err()
        };
        assert_eq!(with(2, &[2]), Some(MessageError::Version(2)));
        assert_eq!(with(3, &[2]), Some(MessageError::Flags(2)));
        assert_eq!(with(4, &[3]), Some(MessageError::Dimension(3)));
        assert_eq!(with(16, &f64::NAN.to_le_bytes()), Some(MessageError::Value));
        assert_eq!(with(24, &(-1.0_f64).to_le_bytes()), Some(MessageError::Price));
        assert_eq!(with(32, &1e7_f64.to_le_bytes()), Some(MessageError::Wish));
        assert_eq!(with(48, &[4]), Some(MessageError::Entries), "ids rise");
        assert_eq!(with(48, &[0]), Some(MessageError::Entries), "no robot has the number 0");
        assert_eq!(with(50, &[4]), Some(MessageError::Entries), "an unknown flag");
        assert_eq!(with(50, &[0]), Some(MessageError::Entries), "it says nothing");
        for length in (0..bytes.len()).chain([90]) {
            let cut = [&bytes[..], &[0; 9]].concat();
            let error = LinkMessage::<2>::parse(&cut[..length]).err();
            assert_eq!(error, Some(MessageError::Length(length)));
        }
    }

    #[test]
    fn any_single_byte_change_gives_a_message_or_an_error() {
        let bytes = bytes();
        for at in 0..bytes.len() {
            for byte in 0..=255 {
                let mut changed = bytes.clone();
                changed[at] = byte;
                if let Ok(message) = LinkMessage::<2>::parse(&changed) {
                    let mut again = [0; 81];
                    let length = message.head().encode(message.items(), &mut again);
                    assert_eq!((length, &again[..]), (Some(81), &changed[..]), "one message has one form");
                }
            }
        }
    }
}
