//! A bad network between processes: what robots say goes through the faults of a scenario before others hear it.
//!
//! The faults are those of the simulator, played by the same code.

use closeranks_sim::faults::network::{FaultyNetwork, Network};
use closeranks_sim::transport::memory::InMemory;
use closeranks_sim::transport::{Bytes, Parcel, Transport as _};

/// Most envelopes that arrive at once; more are lost. How many may be late at once is bounded by [`FaultyNetwork`].
const ARRIVE_MAX: usize = 100_000;
/// How often the faults of a link may change, s.
pub const TICK_S: f64 = 0.005;

/// What carries envelopes from robot to robot.
pub struct Relay {
    network: FaultyNetwork<InMemory>,
    robots: u16,
    tick: u32,
}

impl Relay {
    /// A relay between so many robots with the faults of `network`.
    #[must_use]
    pub fn new(network: Network, seed: u64, robots: u16) -> Self {
        let network = FaultyNetwork::new(InMemory::new(ARRIVE_MAX), network, seed, robots, TICK_S);
        Self { network, robots, tick: 0 }
    }

    /// Begins tick number `tick` of [`TICK_S`].
    pub fn begin_tick(&mut self, tick: u32) {
        self.tick = self.tick.max(tick);
        self.network.begin_tick(self.tick);
    }

    /// Takes what `sender` says to everybody, or to one robot alone. Robots that are not in the team say and hear nothing.
    pub fn take(&mut self, sender: u16, to: Option<u16>, bytes: &[u8]) {
        let team = 1..=self.robots;
        if !team.contains(&sender) || to.is_some_and(|to| !team.contains(&to)) {
            return;
        }
        let bytes = Bytes::from(bytes);
        let index = |robot: u16| usize::from(robot) - 1;
        for receiver in team.filter(|receiver| to.is_none_or(|to| to == *receiver) && *receiver != sender) {
            let (sender, receiver) = (index(sender), index(receiver));
            // What there is no room for is lost.
            let _ = self.network.send(Parcel { sender, receiver, bytes: bytes.clone() });
        }
    }

    /// The next that arrives: from whom, at whom, and the bytes.
    pub fn poll(&mut self) -> Option<(u16, u16, Vec<u8>)> {
        let parcel = self.network.poll()?;
        let robot = |index: usize| u16::try_from(index + 1).unwrap_or(u16::MAX);
        Some((robot(parcel.sender), robot(parcel.receiver), parcel.bytes.to_vec()))
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
        relay.take(1, None, &[1; 500]);
        relay.take(1, Some(3), &[2]);
        relay.take(9, None, &[3]);
        relay.take(1, Some(0), &[4]);
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
                relay.take(1, None, &tick.to_le_bytes());
            }
            arrived.extend(all(&mut relay));
        }
        let share = f64::from(u32::try_from(arrived.len()).unwrap()) / 900.0;
        assert!((0.95..1.15).contains(&share), "0.7 of 1.5 copies arrive: {share}");
        assert!(!arrived.is_sorted_by_key(|(_, _, bytes)| bytes.clone()), "later ones overtake");
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
