//! A small team with fixed keys, for tests.

use std::sync::Arc;

use closeranks_core::{Instant, RobotId};
use ed25519_dalek::SigningKey;

use crate::bytes::hex;
use crate::identity::roster::{Draft, Entry, Roster};
use crate::wire::envelope::{Echo, Letter, Purpose};

/// The key of a robot; that of number 0 is the plant's.
pub(crate) fn key(id: RobotId) -> SigningKey {
    let [low, high] = id.0.to_le_bytes();
    let mut secret = [9; 32];
    (secret[0], secret[1]) = (low, high);
    SigningKey::from_bytes(&secret)
}

/// A draft of a roster of so many robots with these other settings.
pub(crate) fn draft(robots: u16, faults: u16, settings: &str) -> Draft {
    let public = |id| hex(key(id).verifying_key().as_bytes());
    let entry = |id| Entry { id, name: format!("robot_{id}"), key: public(RobotId(id)) };
    Draft {
        name: "test".into(),
        parameters: format!("[team]\nrobots = {robots}\nfaults = {faults}\n{settings}"),
        plant: Some(public(RobotId(0))),
        robots: (1..=robots).map(entry).collect(),
    }
}

/// The text of a roster, signed by the operator of the tests.
pub(crate) fn sign(draft: &Draft) -> String {
    draft.sign(&SigningKey::from_bytes(&[200; 32])).unwrap()
}

/// A roster of so many robots with these other settings.
pub(crate) fn roster_with(robots: u16, faults: u16, settings: &str) -> Arc<Roster> {
    Arc::new(Roster::read(&sign(&draft(robots, faults, settings)), None).unwrap())
}

/// A roster of so many robots.
pub(crate) fn roster(robots: u16) -> Arc<Roster> {
    roster_with(robots, 1, "")
}

/// What a robot sends with these numbers.
pub(crate) fn say(
    roster: &Roster,
    id: u16,
    [epoch, sequence]: [u64; 2],
    sent: Instant,
    payload: &[u8],
    echoes: &[Echo],
) -> Vec<u8> {
    let id = RobotId(id);
    let letter = Letter { purpose: Purpose::Say, id, epoch, sequence, sent, payload, echoes };
    letter.seal(roster.hash(), &key(id)).unwrap()
}
