//! What goes over the network: a payload that nobody here looks into, with who sent it, in which order, and a signature.
//!
//! ```text
//! byte  0     4        5         6   8       16     24        32    40       42      44
//!       "CRN1" purpose  echoes n  id  roster  epoch  sequence  sent  payload  0       payload | n echoes | signature
//!                                 u16 8 bytes u64    u64       u64   length           bytes     34 each    64 bytes
//! ```
//!
//! All numbers are little-endian. An echo is what the sender has heard of another robot: id, epoch, sequence, and the first 16
//! bytes of the SHA-256 of that envelope. What is signed is the domain, the whole hash of the roster, and every byte before the
//! signature.

use closeranks_core::{Instant, RobotId};
use ed25519_dalek::{Signature, Signer as _, SigningKey, VerifyingKey};
use sha2::{Digest as _, Sha256};

use crate::bytes::Reader;

/// Most bytes of a payload.
pub const PAYLOAD_MAX: usize = 4096;
/// Most echoes in one envelope.
pub const ECHOES_MAX: usize = 16;
/// Most bytes of an envelope.
pub const ENVELOPE_MAX: usize = HEAD_BYTES + PAYLOAD_MAX + ECHOES_MAX * ECHO_BYTES + SIGNATURE_BYTES;
/// Fewest bytes of an envelope.
pub const ENVELOPE_MIN: usize = HEAD_BYTES + SIGNATURE_BYTES;

const HEAD_BYTES: usize = 44;
const ECHO_BYTES: usize = 34;
const SIGNATURE_BYTES: usize = 64;
const MAGIC: [u8; 4] = *b"CRN1";
const DOMAIN: &[u8] = b"closeranks envelope 1\n";

/// What an envelope is for. A signature for one purpose is good for no other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// What a robot tells the others: a message of the core.
    Say = 1,
    /// What a simulated plant lets a robot see. The envelope has that robot's number and the plant's signature, so that what one
    /// robot sees cannot be shown to another.
    Sensed = 2,
    /// What a robot decided, for its plant and for whoever watches.
    Report = 3,
}

/// What its sender has heard of another robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Echo {
    /// Of whom.
    pub id: RobotId,
    /// In which start of that robot.
    pub epoch: u64,
    /// Which of its messages.
    pub sequence: u64,
    /// The first bytes of the hash of that message.
    pub hash: [u8; 16],
}

/// What is to be signed and sent.
#[derive(Clone, Copy, Debug)]
pub struct Letter<'a> {
    /// What it is for.
    pub purpose: Purpose,
    /// Who sends it; of a look, who is to see it.
    pub id: RobotId,
    /// The number of the sender's starts.
    pub epoch: u64,
    /// Number among the envelopes of this purpose and epoch, from 1.
    pub sequence: u64,
    /// When it is sent, on the sender's clock.
    pub sent: Instant,
    /// What it holds, at most [`PAYLOAD_MAX`] bytes.
    pub payload: &'a [u8],
    /// What the sender has heard, at most [`ECHOES_MAX`].
    pub echoes: &'a [Echo],
}

/// An envelope of the right form. Nothing in it is believed before [`is_signed_by`](Self::is_signed_by).
#[derive(Clone, Copy, Debug)]
pub struct Envelope<'a> {
    /// What it is for.
    pub purpose: Purpose,
    /// Who is said to send it.
    pub id: RobotId,
    /// The first bytes of the hash of the sender's roster.
    pub roster: [u8; 8],
    /// The number of the sender's starts.
    pub epoch: u64,
    /// Number among the envelopes of this purpose and epoch.
    pub sequence: u64,
    /// When it was sent, on the sender's clock.
    pub sent: Instant,
    /// What it holds.
    pub payload: &'a [u8],
    echoes: &'a [u8],
    bytes: &'a [u8],
}

impl Letter<'_> {
    /// The bytes to send; `None` if the payload or the echoes are too many.
    #[must_use]
    pub fn seal(&self, roster: &[u8; 32], key: &SigningKey) -> Option<Vec<u8>> {
        if self.payload.len() > PAYLOAD_MAX || self.echoes.len() > ECHOES_MAX {
            return None;
        }
        let mut bytes =
            Vec::with_capacity(ENVELOPE_MIN + self.payload.len() + self.echoes.len() * ECHO_BYTES);
        bytes.extend_from_slice(&MAGIC);
        bytes.extend_from_slice(&[self.purpose as u8, u8::try_from(self.echoes.len()).ok()?]);
        bytes.extend_from_slice(&self.id.0.to_le_bytes());
        bytes.extend_from_slice(&roster[..8]);
        for number in [self.epoch, self.sequence, self.sent.as_nanos()] {
            bytes.extend_from_slice(&number.to_le_bytes());
        }
        bytes.extend_from_slice(&u16::try_from(self.payload.len()).ok()?.to_le_bytes());
        bytes.extend_from_slice(&[0; 2]);
        bytes.extend_from_slice(self.payload);
        for echo in self.echoes {
            bytes.extend_from_slice(&echo.id.0.to_le_bytes());
            bytes.extend_from_slice(&echo.epoch.to_le_bytes());
            bytes.extend_from_slice(&echo.sequence.to_le_bytes());
            bytes.extend_from_slice(&echo.hash);
        }
        let signature = key.sign(&signed(roster, &bytes));
        bytes.extend_from_slice(&signature.to_bytes());
        Some(bytes)
    }
}

impl<'a> Envelope<'a> {
    /// The envelope that these bytes are; `None` for anything but the exact form.
    #[must_use]
    pub fn parse(bytes: &'a [u8]) -> Option<Self> {
        if !(ENVELOPE_MIN..=ENVELOPE_MAX).contains(&bytes.len()) {
            return None;
        }
        let mut reader = Reader::new(bytes);
        if reader.array()? != MAGIC {
            return None;
        }
        let purpose = match reader.byte()? {
            1 => Purpose::Say,
            2 => Purpose::Sensed,
            3 => Purpose::Report,
            _ => return None,
        };
        let echoes = usize::from(reader.byte()?);
        let (id, roster) = (RobotId(reader.short()?), reader.array()?);
        let (epoch, sequence, sent) = (reader.long()?, reader.long()?, Instant::from_nanos(reader.long()?));
        let length = usize::from(reader.short()?);
        if reader.short()? != 0 || length > PAYLOAD_MAX || echoes > ECHOES_MAX {
            return None;
        }
        let (payload, echoes) = (reader.slice(length)?, reader.slice(echoes * ECHO_BYTES)?);
        reader.slice(SIGNATURE_BYTES)?;
        reader.end()?;
        Some(Self { purpose, id, roster, epoch, sequence, sent, payload, echoes, bytes })
    }

    /// True if `key` signed this for the team with that hash of a roster.
    #[must_use]
    pub fn is_signed_by(&self, roster: &[u8; 32], key: &VerifyingKey) -> bool {
        let Some((body, signature)) = self.bytes.split_last_chunk::<SIGNATURE_BYTES>() else { return false };
        key.verify_strict(&signed(roster, body), &Signature::from_bytes(signature)).is_ok()
    }

    /// What the sender has heard.
    pub fn echoes(&self) -> impl Iterator<Item = Echo> + use<'a> {
        self.echoes.chunks_exact(ECHO_BYTES).filter_map(|bytes| {
            let mut reader = Reader::new(bytes);
            let (id, epoch) = (RobotId(reader.short()?), reader.long()?);
            Some(Echo { id, epoch, sequence: reader.long()?, hash: reader.array()? })
        })
    }

    /// All bytes, as they came.
    #[must_use]
    pub fn bytes(&self) -> &'a [u8] {
        self.bytes
    }
}

/// What names an envelope in echoes.
#[must_use]
pub fn hash(bytes: &[u8]) -> [u8; 16] {
    let hash = Sha256::digest(bytes);
    core::array::from_fn(|index| hash[index])
}

fn signed(roster: &[u8; 32], body: &[u8]) -> Vec<u8> {
    [DOMAIN, roster, body].concat()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const ROSTER: [u8; 32] = [5; 32];

    fn key() -> SigningKey {
        SigningKey::from_bytes(&[3; 32])
    }

    fn sealed(payload: &[u8], echoes: &[Echo]) -> Vec<u8> {
        let sent = Instant::from_nanos(9);
        let letter =
            Letter { purpose: Purpose::Say, id: RobotId(3), epoch: 2, sequence: 7, sent, payload, echoes };
        letter.seal(&ROSTER, &key()).unwrap()
    }

    proptest! {
        #[test]
        fn what_is_sealed_is_parsed(payload in prop::collection::vec(any::<u8>(), 0..300), count in 0..=ECHOES_MAX) {
            let echo = |k: u16| Echo { id: RobotId(k), epoch: 1, sequence: u64::from(k), hash: [7; 16] };
            let echoes: Vec<Echo> = (1..=u16::try_from(count).unwrap()).map(echo).collect();
            let bytes = sealed(&payload, &echoes);
            let envelope = Envelope::parse(&bytes).unwrap();
            prop_assert_eq!(envelope.payload, &payload);
            prop_assert_eq!(envelope.echoes().collect::<Vec<_>>(), echoes);
            prop_assert_eq!((envelope.id, envelope.epoch, envelope.sequence), (RobotId(3), 2, 7));
            prop_assert!(envelope.is_signed_by(&ROSTER, &key().verifying_key()));
        }

        #[test]
        fn one_changed_bit_is_noticed(at in 0_usize..1_000, bit in 0..8) {
            let mut bytes = sealed(b"hello", &[]);
            let at = at % bytes.len();
            bytes[at] ^= 1_u8 << bit;
            let good = Envelope::parse(&bytes).is_some_and(|it| it.is_signed_by(&ROSTER, &key().verifying_key()));
            prop_assert!(!good);
        }

        #[test]
        fn any_bytes_are_an_envelope_or_none(bytes in prop::collection::vec(any::<u8>(), 0..600)) {
            let _ = Envelope::parse(&bytes);
            let bytes = [&MAGIC[..], &bytes].concat();
            if let Some(envelope) = Envelope::parse(&bytes) {
                prop_assert!(!envelope.is_signed_by(&ROSTER, &key().verifying_key()));
                prop_assert!(envelope.echoes().count() <= ECHOES_MAX);
            }
        }
    }

    #[test]
    fn another_team_and_another_key_do_not_pass() {
        let bytes = sealed(b"x", &[]);
        let envelope = Envelope::parse(&bytes).unwrap();
        assert!(!envelope.is_signed_by(&[6; 32], &key().verifying_key()));
        assert!(!envelope.is_signed_by(&ROSTER, &SigningKey::from_bytes(&[4; 32]).verifying_key()));
    }

    #[test]
    fn too_much_is_not_sealed() {
        let letter = |payload| Letter {
            purpose: Purpose::Report,
            id: RobotId(1),
            epoch: 1,
            sequence: 1,
            sent: Instant::START,
            payload,
            echoes: &[],
        };
        let payload = [0; PAYLOAD_MAX + 1];
        assert!(letter(&payload).seal(&ROSTER, &key()).is_none());
        let bytes = letter(&payload[1..]).seal(&ROSTER, &key()).unwrap();
        assert!(Envelope::parse(&bytes).is_some() && Envelope::parse(&bytes[1..]).is_none());
    }
}
