//! A proof that a robot is two-faced: two different envelopes that it signed with one number.
//!
//! ```text
//! "CRP1" | length of the first, u16 | first | length of the second, u16 | second
//! ```

use closeranks_core::RobotId;

use crate::bytes::Reader;
use crate::identity::roster::Roster;
use crate::wire::envelope::{ENVELOPE_MAX, Envelope};

const MAGIC: [u8; 4] = *b"CRP1";
/// Most bytes of a proof.
pub const PROOF_MAX: usize = 8 + 2 * ENVELOPE_MAX;

/// Two envelopes that no honest robot signs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proof {
    /// One face.
    pub first: Vec<u8>,
    /// The other.
    pub second: Vec<u8>,
}

/// Why a proof proves nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ProofError {
    /// The bytes are no proof.
    #[error("these bytes are not two envelopes in the form of a proof")]
    Form,
    /// Both faces are the same.
    #[error("both envelopes are the same")]
    Same,
    /// The two envelopes may well both be sent.
    #[error("the envelopes differ in sender, purpose, epoch or sequence: an honest robot may send both")]
    Numbers,
    /// The sender is not one of the robots.
    #[error("the sender {0} is not in the roster")]
    Sender(u16),
    /// The sender did not sign both.
    #[error("robot {0} did not sign both envelopes for this roster")]
    Signature(u16),
}

impl Proof {
    /// The bytes of a file.
    #[must_use]
    pub fn encode(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        for face in [&self.first, &self.second] {
            // Envelopes are shorter than 2^16 bytes.
            bytes.extend_from_slice(&u16::try_from(face.len()).unwrap_or(u16::MAX).to_le_bytes());
            bytes.extend_from_slice(face);
        }
        bytes
    }

    /// The proof in these bytes; nothing is checked but the form.
    pub fn parse(bytes: &[u8]) -> Result<Self, ProofError> {
        let parse = || {
            let mut reader = Reader::new(bytes);
            if reader.array()? != MAGIC {
                return None;
            }
            let length = reader.short()?;
            let first = reader.slice(usize::from(length))?.to_vec();
            let length = reader.short()?;
            let second = reader.slice(usize::from(length))?.to_vec();
            reader.end()?;
            Some(Self { first, second })
        };
        if bytes.len() > PROOF_MAX { Err(ProofError::Form) } else { parse().ok_or(ProofError::Form) }
    }

    /// Who is proved to be two-faced.
    pub fn verify(&self, roster: &Roster) -> Result<RobotId, ProofError> {
        let first = Envelope::parse(&self.first).ok_or(ProofError::Form)?;
        let second = Envelope::parse(&self.second).ok_or(ProofError::Form)?;
        if self.first == self.second {
            return Err(ProofError::Same);
        }
        let numbers = |it: &Envelope<'_>| (it.id, it.purpose as u8, it.epoch, it.sequence);
        if numbers(&first) != numbers(&second) {
            return Err(ProofError::Numbers);
        }
        let id = first.id;
        let key = roster.key(id).ok_or(ProofError::Sender(id.0))?;
        let signed = [first, second].iter().all(|face| face.is_signed_by(roster.hash(), key));
        if signed { Ok(id) } else { Err(ProofError::Signature(id.0)) }
    }
}
