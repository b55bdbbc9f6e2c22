//! What a robot tells: one fixed-size message, parsed or rejected.
//!
//! ```text
//! byte   0    2        3      4         8      16     24     32
//!        "CR" version  flags  sequence  stamp  level  value        all little-endian
//! ```
//!
//! The flags say which of the last two are there, at least one of them: 1 the value, 2 the level. One that is not there is 0.

use crate::settings::range::MAGNITUDE_MAX;
use crate::time::Instant;

/// Bytes of an encoded message.
pub const MESSAGE_BYTES: usize = 32;

const MAGIC: [u8; 2] = *b"CR";
pub(crate) const VERSION: u8 = 4;
const HAS_VALUE: u8 = 1;
const HAS_LEVEL: u8 = 2;

/// Greatest magnitude of a told value: a mean of the largest team's values cannot overflow.
pub const VALUE_MAX: f64 = 1e300;

/// A message. One that exists holds only finite numbers, so later code need not ask again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Message {
    sequence: u32,
    stamp: Instant,
    level: Option<f64>,
    value: Option<f64>,
}

/// Why bytes or numbers are not a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MessageError {
    /// There are as many bytes as this says, and neither [`MESSAGE_BYTES`] nor as many as a list of links needs.
    Length(usize),
    /// The bytes do not begin with `CR`.
    Magic,
    /// The message is of this version, which the program does not know.
    Version(u8),
    /// These flags are unknown, say that there is neither level nor value, or leave out a number that is there.
    Flags(u8),
    /// The level is NaN or infinite.
    Level,
    /// The value is NaN or beyond ±[`VALUE_MAX`].
    Value,
    /// `links`: the message is of a team in so many dimensions.
    Dimension(u8),
    /// `links`: the wish is not finite, or too fast.
    Wish,
    /// `links`: the price is NaN or negative.
    Price,
    /// `links`: entries are not in rising order of robots, say nothing, or are of an unknown kind.
    Entries,
}

impl Message {
    /// A message that is told at `stamp` on the sender's clock, with connectivity level `c_i` (finite) if the controller tells
    /// levels, and, in a consensus round, value `y_i` (at most [`VALUE_MAX`]). One of them must be there.
    pub fn new(
        sequence: u32,
        stamp: Instant,
        level: Option<f64>,
        value: Option<f64>,
    ) -> Result<Self, MessageError> {
        if level.is_none() && value.is_none() {
            return Err(MessageError::Flags(0));
        }
        if level.is_some_and(|level| !level.is_finite()) {
            return Err(MessageError::Level);
        }
        if value.is_some_and(|value| !(-VALUE_MAX..=VALUE_MAX).contains(&value)) {
            return Err(MessageError::Value);
        }
        Ok(Self { sequence, stamp, level, value })
    }

    /// Number of the message among those of its sender; strictly increasing.
    #[must_use]
    pub fn sequence(&self) -> u32 {
        self.sequence
    }

    /// When, on its sender's clock, its positions were sensed. It orders messages and says which round a value is of; it is
    /// trusted no more than the rest.
    #[must_use]
    pub fn stamp(&self) -> Instant {
        self.stamp
    }

    /// Told connectivity level `c_i`, dimensionless, finite, of any size, if the sender tells levels.
    #[must_use]
    pub fn level(&self) -> Option<f64> {
        self.level
    }

    /// Told value `y_i`, at most [`VALUE_MAX`] in magnitude, if a consensus round is on.
    #[must_use]
    pub fn value(&self) -> Option<f64> {
        self.value
    }

    /// The bytes to send.
    #[must_use]
    pub fn encode(&self) -> [u8; MESSAGE_BYTES] {
        let mut bytes = [0; MESSAGE_BYTES];
        bytes[..2].copy_from_slice(&MAGIC);
        bytes[2] = VERSION;
        bytes[3] = u8::from(self.value.is_some()) * HAS_VALUE + u8::from(self.level.is_some()) * HAS_LEVEL;
        bytes[4..8].copy_from_slice(&self.sequence.to_le_bytes());
        bytes[8..16].copy_from_slice(&self.stamp.as_nanos().to_le_bytes());
        bytes[16..24].copy_from_slice(&self.level.unwrap_or(0.0).to_le_bytes());
        bytes[24..].copy_from_slice(&self.value.unwrap_or(0.0).to_le_bytes());
        bytes
    }

    /// Reads what came from the network; anything but the exact form is rejected.
    pub fn parse(bytes: &[u8]) -> Result<Self, MessageError> {
        let bytes: &[u8; MESSAGE_BYTES] = bytes.try_into().map_err(|_| MessageError::Length(bytes.len()))?;
        let [m0, m1, version, flags, rest @ ..] = *bytes;
        let [s0, s1, s2, s3, numbers @ ..] = rest;
        if [m0, m1] != MAGIC {
            return Err(MessageError::Magic);
        }
        if version != VERSION {
            return Err(MessageError::Version(version));
        }
        let number = |flag: u8, start: usize| {
            let bits = u64::from_le_bytes(part(&numbers, start));
            let there = flags & flag != 0;
            if there || bits == 0 { Ok(there.then_some(f64::from_bits(bits))) } else { Err(()) }
        };
        let (Ok(level), Ok(value), 0..=3) = (number(HAS_LEVEL, 8), number(HAS_VALUE, 16), flags) else {
            return Err(MessageError::Flags(flags));
        };
        let stamp = Instant::from_nanos(u64::from_le_bytes(part(&numbers, 0)));
        Self::new(u32::from_le_bytes([s0, s1, s2, s3]), stamp, level, value)
    }
}

fn part(numbers: &[u8; 24], start: usize) -> [u8; 8] {
    core::array::from_fn(|index| numbers[start + index])
}

impl core::fmt::Display for MessageError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Length(found) => {
                write!(f, "message of {found} bytes, must be {MESSAGE_BYTES}, or what its entries need")
            }
            Self::Magic => write!(f, "message does not begin with `CR`"),
            Self::Version(found) => write!(f, "message of version {found}, must be {VERSION}"),
            Self::Flags(found) => {
                write!(f, "message with flags {found}, must be 1 (a value), 2 (a level) or 3 (both)")
            }
            Self::Level => write!(f, "told level is not finite"),
            Self::Dimension(found) => write!(f, "told wish has {found} components, not those of the team"),
            Self::Wish => write!(f, "told wish is not a velocity of at most {MAGNITUDE_MAX:e} m/s an axis"),
            Self::Price => write!(f, "told price is not a number from 0"),
            Self::Entries => {
                write!(f, "entries are not one for each robot in rising order, each of a known kind")
            }
            Self::Value => write!(f, "told value is not a number from -{VALUE_MAX:e} to {VALUE_MAX:e}"),
        }
    }
}

impl core::error::Error for MessageError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_encoded_is_parsed_again() {
        for (level, value) in [(Some(-2.5), None), (Some(0.0), Some(-0.0)), (None, Some(499.5))] {
            let message = Message::new(7, Instant::from_nanos(u64::MAX), level, value).unwrap();
            assert_eq!(Message::parse(&message.encode()), Ok(message));
        }
        assert_eq!(Message::new(7, Instant::START, None, None), Err(MessageError::Flags(0)));
    }

    #[test]
    fn every_length_but_one_is_rejected() {
        for length in 0..64 {
            let parsed = Message::parse(&[0; 64][..length]);
            let expected =
                if length == MESSAGE_BYTES { MessageError::Magic } else { MessageError::Length(length) };
            assert_eq!(parsed, Err(expected));
        }
    }

    #[test]
    fn not_finite_wrong_version_and_stray_bytes_are_rejected() {
        let bytes = Message::new(1, Instant::START, Some(2.0), Some(3.0)).unwrap().encode();
        let with = |at: usize, patch: &[u8]| {
            let mut changed = bytes;
            changed[at..at + patch.len()].copy_from_slice(patch);
            Message::parse(&changed)
        };
        assert_eq!(with(2, &[9]), Err(MessageError::Version(9)));
        for flags in [0, 1, 2, 4, 7, 255] {
            assert_eq!(with(3, &[flags]), Err(MessageError::Flags(flags)), "or a number without its flag");
        }
        assert_eq!(with(16, &f64::NAN.to_le_bytes()), Err(MessageError::Level));
        assert_eq!(with(24, &f64::INFINITY.to_le_bytes()), Err(MessageError::Value));
    }

    #[test]
    fn any_single_byte_change_gives_a_message_or_an_error() {
        let bytes = Message::new(1, Instant::START, Some(2.0), Some(3.0)).unwrap().encode();
        for at in 0..MESSAGE_BYTES {
            for byte in 0..=255 {
                let mut changed = bytes;
                changed[at] = byte;
                if let Ok(message) = Message::parse(&changed) {
                    assert_eq!(message.encode(), changed, "one message has one form");
                }
            }
        }
    }
}
