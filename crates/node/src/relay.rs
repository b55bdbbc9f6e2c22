//! A bad network between processes: what robots say goes through the faults of a scenario before others hear it.
//!
//! The faults are those of the simulator, played by the same code. Signed bytes of any length are on their way here, and the
//! simulator's parcels are short; so a parcel holds the number of the bytes, which wait in a store of bounded size.

use std::collections::BTreeMap;
use std::sync::Arc;

use closeranks_sim::faults::network::{FaultyNetwork, Network};
use closeranks_sim::transport::memory::InMemory;
use closeranks_sim::transport::{Parcel, Transport as _};

/// Most envelopes that are on their way at once; more are lost.
const UNDER_WAY_MAX: usize = 100_000;
/// How often the faults of a link may change, s.
pub const TICK_S: f64 = 0.005;
/// The longest delay of a scenario is 60 s; what is older was lost.
const KEPT_TICKS: u32 = 13_000;

/// What carries envelopes from robot to robot.
pub struct Relay {
    network: FaultyNetwork<InMemory>,
    store: BTreeMap<u64, (u32, Arc<Vec<u8>>)>,
    next: u64,
    robots: u16,
    tick: u32,
}

impl Relay {
    /// A relay between so many robots with the faults of `network`.
    #[must_use]
    pub fn new(network: Network, seed: u64, robots: u16) -> Self {
        let perfect = InMemory::new(UNDER_WAY_MAX);
        let network = FaultyNetwork::new(perfect, network, seed, robots, TICK_S);
        Self { network, store: BTreeMap::new(), next: 0, robots, tick: 0 }
    }

    /// Begins tick number `tick` of [`TICK_S`].
    pub fn begin_tick(&mut self, tick: u32) {
        self.tick = self.tick.max(tick);
        self.network.begin_tick(self.tick);
        let oldest = self.tick.saturating_sub(KEPT_TICKS);
        while self.store.first_key_value().is_some_and(|(_, (sent, _))| *sent < oldest) {
            self.store.pop_first();
        }
    }

    /// Takes what `sender` says to everybody, or to one robot alone. Robots that are not in the team say and hear nothing.
    pub fn take(&mut self, sender: u16, to: Option<u16>, bytes: Vec<u8>) {
        let team = 1..=self.robots;
        let alone = to.is_some_and(|to| !team.contains(&to));
        if !team.contains(&sender) || alone || self.store.len() >= UNDER_WAY_MAX {
            return;
        }
        self.store.insert(self.next, (self.tick, Arc::new(bytes)));
        for receiver in team.filter(|receiver| to.is_none_or(|to| to == *receiver) && *receiver != sender) {
            let mut parcel = Parcel {
                sender: usize::from(sender) - 1,
                receiver: usize::from(receiver) - 1,
                bytes: [0; closeranks_core::MESSAGE_BYTES],
            };
            parcel.bytes[..8].copy_from_slice(&self.next.to_le_bytes());
            // What there is no room for is lost.
            let _ = self.network.send(parcel);
        }
        self.next += 1;
    }

    /// The next that arrives: from whom, at whom, and the bytes.
    pub fn poll(&mut self) -> Option<(u16, u16, Vec<u8>)> {
        loop {
            let parcel = self.network.poll()?;
            let mut number = [0; 8];
            number.copy_from_slice(&parcel.bytes[..8]);
            let Some((_, bytes)) = self.store.get(&u64::from_le_bytes(number)) else { continue };
            let robot = |index: usize| u16::try_from(index + 1).unwrap_or(u16::MAX);
            return Some((robot(parcel.sender), robot(parcel.receiver), bytes.to_vec()));
        }
    }
}

/// Sender and receiver of a key on which robots speak: `say/3`, or `aside/3/7` for one robot alone.
#[must_use]
pub fn parties(key: &str) -> Option<(u16, Option<u16>)> {
    let parts: Vec<&str> = key.split('/').collect();
    match parts.as_slice() {
        ["say", sender] => Some((sender.parse().ok()?, None)),
        ["aside", sender, receiver] => Some((sender.parse().ok()?, Some(receiver.parse().ok()?))),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(relay: &mut Relay) -> Vec<(u16, u16, Vec<u8>)> {
        core::iter::from_fn(|| relay.poll()).collect()
    }

    #[test]
    fn a_perfect_relay_hands_everything_on_to_all_others_in_order() {
        let mut relay = Relay::new(Network::default(), 1, 3);
        relay.take(1, None, vec![1; 500]);
        relay.take(1, Some(3), vec![2]);
        relay.take(9, None, vec![3]);
        relay.take(1, Some(0), vec![4]);
        let arrived = all(&mut relay);
        assert_eq!(arrived, [(1, 2, vec![1; 500]), (1, 3, vec![1; 500]), (1, 3, vec![2])]);
    }

    #[test]
    fn losses_delays_and_copies_are_those_of_the_scenario() {
        let network = Network { loss: 0.3, delay_max_s: 0.2, duplicate: 0.5, ..Network::default() };
        let mut relay = Relay::new(network, 7, 2);
        let mut arrived = Vec::new();
        for tick in 0..1_000 {
            relay.begin_tick(tick);
            if tick < 900 {
                relay.take(1, None, tick.to_le_bytes().to_vec());
            }
            arrived.extend(all(&mut relay));
        }
        let share = f64::from(u32::try_from(arrived.len()).unwrap()) / 900.0;
        assert!((0.95..1.15).contains(&share), "0.7 of 1.5 copies arrive: {share}");
        assert!(!arrived.is_sorted_by_key(|(_, _, bytes)| bytes.clone()), "later ones overtake");
        relay.begin_tick(100_000);
        assert!(relay.store.is_empty(), "what was lost is forgotten");
    }

    #[test]
    fn keys_name_their_parties() {
        assert_eq!(parties("say/3"), Some((3, None)));
        assert_eq!(parties("aside/3/7"), Some((3, Some(7))));
        for wrong in ["say", "say/x", "say/3/4", "aside/3", "to/3/4", "say/70000"] {
            assert_eq!(parties(wrong), None, "{wrong}");
        }
    }
}
