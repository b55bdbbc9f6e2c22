//! What a simulated plant lets a robot see.

use closeranks_core::{Instant, RobotId};

use crate::bytes::{Reader, put_vector};

/// Most other robots in one look.
pub const OTHERS_MAX: usize = 150;

/// Own position and those of the robots in sight, all at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensed<const D: usize> {
    /// When it was so, on the clock of the team.
    pub at: Instant,
    /// Own position, m.
    pub own_m: [f64; D],
    /// Other robots and their positions, m.
    pub others: Vec<(RobotId, [f64; D])>,
}

impl<const D: usize> Sensed<D> {
    /// The bytes of a payload. Robots beyond [`OTHERS_MAX`] are left out.
    #[must_use]
    pub fn encode(&self) -> Vec<u8> {
        let others = &self.others[..self.others.len().min(OTHERS_MAX)];
        let mut bytes = self.at.as_nanos().to_le_bytes().to_vec();
        put_vector(&mut bytes, &self.own_m);
        bytes.extend_from_slice(&u16::try_from(others.len()).unwrap_or(0).to_le_bytes());
        for (id, position_m) in others {
            bytes.extend_from_slice(&id.0.to_le_bytes());
            put_vector(&mut bytes, position_m);
        }
        bytes
    }

    /// What a payload says; `None` for anything but the exact form and for numbers that are not finite.
    #[must_use]
    pub fn parse(bytes: &[u8]) -> Option<Self> {
        let mut reader = Reader::new(bytes);
        let (at, own_m) = (Instant::from_nanos(reader.long()?), reader.vector()?);
        let count = usize::from(reader.short()?);
        if count > OTHERS_MAX {
            return None;
        }
        let mut others = Vec::with_capacity(count);
        for _ in 0..count {
            others.push((RobotId(reader.short()?), reader.vector()?));
        }
        reader.end()?;
        Some(Self { at, own_m, others })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::wire::envelope::PAYLOAD_MAX;

    proptest! {
        #[test]
        fn any_bytes_are_one_look_or_none(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
            if let Some(sensed) = Sensed::<2>::parse(&bytes) {
                prop_assert_eq!(sensed.encode(), bytes);
            }
        }
    }

    #[test]
    fn what_is_encoded_is_parsed_and_fits_an_envelope() {
        let others = (1..=150).map(|id| (RobotId(id), [f64::from(id), 0.5, -1.0])).collect();
        let sensed = Sensed { at: Instant::from_nanos(5), own_m: [1.0, 2.0, 3.0], others };
        let bytes = sensed.encode();
        assert!(bytes.len() <= PAYLOAD_MAX);
        assert_eq!(Sensed::parse(&bytes), Some(sensed));
        assert_eq!(Sensed::<3>::parse(&bytes[1..]), None);
        assert_eq!(Sensed::<2>::parse(&bytes), None, "of another dimension");
    }
}
