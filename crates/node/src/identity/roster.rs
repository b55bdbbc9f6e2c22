//! The roster: who is in the team, with which keys and which settings, signed by the operator.
//!
//! It is a TOML file. Everything before the line `[signature]` is what is signed; after it stand the operator's public key and
//! the signature, and nothing else. n is the number of robots in the roster, so nobody can invent another one.

use std::path::{Path, PathBuf};
use std::{fs, io};

use closeranks_core::RobotId;
use closeranks_core::robot::neighbor::Member;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::scenario::ranks::How;
use ed25519_dalek::{Signature, Signer as _, SigningKey, VerifyingKey};
use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use crate::bytes::{hex, unhex};
use crate::identity::keys;
use crate::identity::parameters::{self, ParametersError};

/// Longest roster, bytes.
pub const ROSTER_MAX: u64 = 1 << 20;
/// The line that ends what is signed.
const SIGNATURE_LINE: &str = "[signature]";
/// Stands before what an operator signs, so that the signature is good for nothing else.
const DOMAIN: &[u8] = b"closeranks roster 1\n";
/// Longest name of a robot.
const NAME_MAX: usize = 64;

/// What an operator writes down, before anybody checks it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Draft {
    /// Name of the team, for people.
    pub name: String,
    /// The settings, as text.
    pub parameters: String,
    /// Public key of a simulated plant, if the robots are to believe one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plant: Option<String>,
    /// The robots.
    #[serde(default, rename = "robot")]
    pub robots: Vec<Entry>,
}

/// A robot of the team.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// Its number, from 1.
    pub id: u16,
    /// Its name, which is its namespace in ROS 2 as well.
    pub name: String,
    /// Its public key.
    pub key: String,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Signed {
    operator: String,
    ed25519: String,
}

/// A roster that was checked, whole, with its signature.
#[derive(Clone, Debug)]
pub struct Roster {
    draft: Draft,
    scenario: Scenario,
    keys: Vec<VerifyingKey>,
    plant: Option<VerifyingKey>,
    operator: VerifyingKey,
    hash: [u8; 32],
}

/// Why a roster is not used.
#[derive(Debug, thiserror::Error)]
pub enum RosterError {
    /// The file cannot be read or written.
    #[error("{path}: {error}")]
    File {
        /// Which file.
        path: PathBuf,
        /// Why not.
        error: io::Error,
    },
    /// The file is longer than a roster.
    #[error("{0} has more than {ROSTER_MAX} bytes")]
    Long(PathBuf),
    /// It is not TOML, or has other fields.
    #[error("the roster is not what `closeranks-node roster` writes: {0}")]
    Toml(String),
    /// The settings are wrong.
    #[error(transparent)]
    Parameters(#[from] ParametersError),
    /// Robots are missing or too many.
    #[error("the roster has {found} robots, `team.robots` says {robots}")]
    Count {
        /// How many there are.
        found: usize,
        /// n.
        robots: u16,
    },
    /// An entry is wrong.
    #[error("robot {id} of the roster: {problem}")]
    Entry {
        /// Its number, as it is written.
        id: u16,
        /// What is wrong.
        problem: String,
    },
    /// The key of the plant is wrong.
    #[error("`plant` must be a public key of 64 hexadecimal digits")]
    Plant,
    /// There is no signature.
    #[error("the roster is not signed: closeranks-node roster sign DIR")]
    Unsigned,
    /// The signature does not fit.
    #[error("the signature of the roster does not fit: it was changed after it was signed")]
    Signature,
    /// Somebody else signed it.
    #[error("the roster is signed by {found}, this robot obeys {expected}")]
    Operator {
        /// Whose signature it is.
        found: String,
        /// Whose it must be.
        expected: String,
    },
}

impl Draft {
    /// Reads a draft with or without a signature; the signature is not looked at.
    pub fn read(text: &str) -> Result<Self, RosterError> {
        let (signed, _) = split(text);
        toml::from_str(signed).map_err(|error| RosterError::Toml(error.to_string()))
    }

    /// The text of a draft, without a signature.
    pub fn write(&self) -> Result<String, RosterError> {
        toml::to_string(self).map_err(|error| RosterError::Toml(error.to_string()))
    }

    /// The text of the draft with the signature of `operator`; refused unless everything in it is right.
    pub fn sign(&self, operator: &SigningKey) -> Result<String, RosterError> {
        self.check()?;
        let text = format!("{}\n", self.write()?.trim_end());
        let signature = operator.sign(&signed_bytes(&text));
        let signed = Signed {
            operator: hex(operator.verifying_key().as_bytes()),
            ed25519: hex(&signature.to_bytes()),
        };
        let signed = toml::to_string(&signed).map_err(|error| RosterError::Toml(error.to_string()))?;
        Ok(format!("{text}{SIGNATURE_LINE}\n{signed}"))
    }

    fn check(&self) -> Result<(Scenario, Vec<VerifyingKey>, Option<VerifyingKey>), RosterError> {
        let scenario = parameters::read(&self.parameters)?;
        let robots = scenario.team.robots;
        if self.robots.len() != usize::from(robots) {
            return Err(RosterError::Count { found: self.robots.len(), robots });
        }
        let mut found: Vec<VerifyingKey> = Vec::new();
        for (number, entry) in (1..).zip(&self.robots) {
            let wrong = |problem: String| RosterError::Entry { id: entry.id, problem };
            if entry.id != number {
                return Err(wrong(format!(
                    "must be number {number}: robots stand in the order of their numbers"
                )));
            }
            if !is_name(&entry.name) {
                return Err(wrong(format!(
                    "its name is `{}`, must be 1 to {NAME_MAX} of a-z, 0-9 and _, beginning with a letter",
                    entry.name
                )));
            }
            if self.robots[..usize::from(number) - 1].iter().any(|other| other.name == entry.name) {
                return Err(wrong(format!("another robot is called `{}` too", entry.name)));
            }
            let key = keys::public(&entry.key)
                .ok_or_else(|| wrong("its key must be a public key of 64 hexadecimal digits".into()))?;
            if found.contains(&key) {
                return Err(wrong("another robot has the same key".into()));
            }
            found.push(key);
        }
        let plant =
            self.plant.as_deref().map(|key| keys::public(key).ok_or(RosterError::Plant)).transpose()?;
        Ok((scenario, found, plant))
    }
}

impl Roster {
    /// The roster of a text, if it is right and signed by `operator` (any operator if `None`).
    pub fn read(text: &str, operator: Option<&VerifyingKey>) -> Result<Self, RosterError> {
        let (body, signature) = split(text);
        let signed: Signed = toml::from_str(signature.ok_or(RosterError::Unsigned)?)
            .map_err(|error| RosterError::Toml(error.to_string()))?;
        let found = keys::public(&signed.operator).ok_or(RosterError::Signature)?;
        if let Some(expected) = operator.filter(|expected| **expected != found) {
            return Err(RosterError::Operator { found: signed.operator, expected: hex(expected.as_bytes()) });
        }
        let bytes = unhex(&signed.ed25519).ok_or(RosterError::Signature)?;
        let signed_bytes = signed_bytes(body);
        found
            .verify_strict(&signed_bytes, &Signature::from_bytes(&bytes))
            .map_err(|_| RosterError::Signature)?;
        let draft = Draft::read(body)?;
        let (scenario, keys, plant) = draft.check()?;
        let mut hash = Sha256::new();
        hash.update(&signed_bytes);
        hash.update(found.as_bytes());
        Ok(Self { draft, scenario, keys, plant, operator: found, hash: hash.finalize().into() })
    }

    /// The roster in a file.
    pub fn load(path: &Path, operator: Option<&VerifyingKey>) -> Result<Self, RosterError> {
        Self::read(&text_of(path)?, operator)
    }

    /// Name of the team.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.draft.name
    }

    /// The settings, as text.
    #[must_use]
    pub fn parameters(&self) -> &str {
        &self.draft.parameters
    }

    /// The robots in the order of their numbers.
    #[must_use]
    pub fn robots(&self) -> &[Entry] {
        &self.draft.robots
    }

    /// The settings; what a scenario has besides is as in an empty one.
    #[must_use]
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The public key of a robot; `None` if no robot has that number.
    #[must_use]
    pub fn key(&self, id: RobotId) -> Option<&VerifyingKey> {
        self.keys.get(usize::from(id.0).checked_sub(1)?)
    }

    /// The public key of the plant, if there is one.
    #[must_use]
    pub fn plant(&self) -> Option<&VerifyingKey> {
        self.plant.as_ref()
    }

    /// A robot with its rank; without ranks that is 0.
    #[must_use]
    pub fn member(&self, id: RobotId) -> Member {
        let ranks = self.scenario.ranking().and_then(|ranking| match &ranking.how {
            How::Listed(ranks) => Some(ranks),
            How::Own { .. } | How::Layers { .. } => None,
        });
        let rank = ranks.and_then(|ranks| ranks.get(usize::from(id.0).wrapping_sub(1)));
        Member { id, rank: rank.copied().unwrap_or(0) }
    }

    /// Who signed.
    #[must_use]
    pub fn operator(&self) -> &VerifyingKey {
        &self.operator
    }

    /// What names this roster: SHA-256 of what was signed and of the operator's key.
    #[must_use]
    pub fn hash(&self) -> &[u8; 32] {
        &self.hash
    }

    /// The number of the robot of that name.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<RobotId> {
        self.robots().iter().find(|entry| entry.name == name).map(|entry| RobotId(entry.id))
    }
}

/// The text of a roster file.
pub fn text_of(path: &Path) -> Result<String, RosterError> {
    let file = |error| RosterError::File { path: path.to_owned(), error };
    if fs::metadata(path).map_err(file)?.len() > ROSTER_MAX {
        return Err(RosterError::Long(path.to_owned()));
    }
    fs::read_to_string(path).map_err(file)
}

/// What is signed, and what stands after the line of the signature.
fn split(text: &str) -> (&str, Option<&str>) {
    let line = format!("\n{SIGNATURE_LINE}\n");
    match text.rfind(&line) {
        Some(at) => (&text[..=at], text.get(at + line.len()..)),
        None => (text, None),
    }
}

fn signed_bytes(body: &str) -> Vec<u8> {
    [DOMAIN, body.as_bytes()].concat()
}

fn is_name(name: &str) -> bool {
    let letter = name.starts_with(|first: char| first.is_ascii_lowercase());
    let word = name.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_');
    letter && word && name.len() <= NAME_MAX
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(seed: u8) -> SigningKey {
        SigningKey::from_bytes(&[seed; 32])
    }

    fn draft(robots: u8) -> Draft {
        let entry = |id: u8| Entry {
            id: u16::from(id),
            name: format!("robot_{id}"),
            key: hex(key(id).verifying_key().as_bytes()),
        };
        Draft {
            name: "test".into(),
            parameters: "[team]\nrobots = 3\nfaults = 1\n".into(),
            plant: None,
            robots: (1..=robots).map(entry).collect(),
        }
    }

    #[test]
    fn what_is_signed_is_read_and_has_one_hash() {
        let text = draft(3).sign(&key(9)).unwrap();
        let roster = Roster::read(&text, Some(&key(9).verifying_key())).unwrap();
        assert_eq!((roster.robots().len(), roster.find("robot_2")), (3, Some(RobotId(2))));
        assert_eq!(roster.key(RobotId(3)), Some(&key(3).verifying_key()));
        assert!(roster.key(RobotId(0)).is_none() && roster.key(RobotId(4)).is_none());
        let other = draft(3).sign(&key(8)).unwrap();
        assert_ne!(Roster::read(&other, None).unwrap().hash(), roster.hash(), "another operator");
        assert!(matches!(
            Roster::read(&other, Some(&key(9).verifying_key())),
            Err(RosterError::Operator { .. })
        ));
    }

    #[test]
    fn any_changed_byte_is_noticed() {
        let text = draft(3).sign(&key(9)).unwrap();
        let end = text.rfind(SIGNATURE_LINE).unwrap();
        for at in 0..end {
            let mut changed = text.clone().into_bytes();
            changed[at] ^= 1;
            let Ok(changed) = String::from_utf8(changed) else { continue };
            assert!(Roster::read(&changed, None).is_err(), "byte {at}");
        }
    }

    #[test]
    fn a_roster_that_is_not_whole_is_not_signed() {
        let refused = |draft: &Draft| draft.sign(&key(9)).unwrap_err().to_string();
        assert_eq!(refused(&draft(2)), "the roster has 2 robots, `team.robots` says 3");
        let mut twice = draft(3);
        twice.robots[2].key = twice.robots[0].key.clone();
        assert_eq!(refused(&twice), "robot 3 of the roster: another robot has the same key");
        let mut named = draft(3);
        named.robots[1].name = "Robot 2".into();
        assert!(refused(&named).contains("its name is `Robot 2`"));
        let mut order = draft(3);
        order.robots.swap(0, 1);
        assert!(refused(&order).contains("must be number 1"));
        assert!(matches!(Roster::read(&draft(3).write().unwrap(), None), Err(RosterError::Unsigned)));
    }
}
