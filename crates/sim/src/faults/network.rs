//! The network between robots. It may lose, delay, reorder and duplicate messages, and divide the team.

use std::collections::BTreeMap;

use closeranks_core::settings::range::Allowed;

use crate::faults::ways::Ways;
use crate::parse::common::{DELAY, FRACTION, set, small, times};
use crate::parse::reader::{Reader, Section};
use crate::random::{Random, Stream};
use crate::transport::{Full, Parcel, Transport};

/// How many messages may be late at once; more are lost. They take some 60 MB, and what lists of links need.
pub(crate) const LATE_MAX: usize = 1 << 20;

/// What the network does to every message on its way to one robot. Shares and probabilities lie in `[0, 1]`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Network {
    /// Probability that a message is lost, whatever happened to others.
    pub loss: f64,
    /// Probability a tick that a link, one way, begins to lose everything.
    pub burst_begin: f64,
    /// Probability a tick that such a link stops doing so.
    pub burst_end: f64,
    /// Least delay, s.
    pub delay_min_s: f64,
    /// Greatest delay, s; each message has its own, so that later ones overtake.
    pub delay_max_s: f64,
    /// Probability that a message comes twice, each time with its own delay.
    pub duplicate: f64,
    /// Share of links that carry nothing one way.
    pub deaf: f64,
    /// No message passes between two groups of robots for a while.
    pub partition: Option<Partition>,
}

impl Network {
    /// Reads the table `network` of a scenario text for a team of so many robots.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>, robots: u16) -> Self {
        let mut network = Self::default();
        set(&mut network.loss, reader.number(section, "loss", FRACTION));
        set(&mut network.burst_begin, reader.number(section, "burst_begin", FRACTION));
        let burst_end = if network.burst_begin > 0.0 { 0.1 } else { 0.0 };
        network.burst_end = reader.number_or(section, "burst_end", FRACTION, burst_end);
        set(&mut network.delay_min_s, reader.number(section, "delay_min_s", DELAY));
        let longest = Allowed::Closed(network.delay_min_s, 60.0);
        network.delay_max_s = reader.number_or(section, "delay_max_s", longest, network.delay_min_s);
        set(&mut network.duplicate, reader.number(section, "duplicate", FRACTION));
        set(&mut network.deaf, reader.number(section, "deaf", FRACTION));
        network.partition = section.has("partition").then(|| {
            reader.table(section, "partition", |reader, section| Partition::read(reader, section, robots))
        });
        network
    }
}

/// Two groups that do not hear each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Partition {
    /// The last robot of the first group.
    pub first: u16,
    /// From when, s.
    pub from_s: f64,
    /// Until when, s.
    pub to_s: f64,
}

impl Partition {
    fn read(reader: &mut Reader, section: &mut Section<'_>, robots: u16) -> Self {
        let first = reader.whole(section, "first", 1..u64::from(robots)).map_or(robots / 2, small);
        let [from_s, to_s] = times(reader, section);
        Self { first, from_s, to_s }
    }
}

/// A network with faults around another one. The robots do not know that it is there.
#[derive(Clone, Debug)]
pub struct FaultyNetwork<T> {
    inner: T,
    network: Network,
    tick_s: f64,
    tick: u32,
    random: Random,
    /// Links that carry nothing one way, or lose everything just now.
    ways: Ways,
    /// Parcels that are late, by the tick in which the inner network gets them.
    late: BTreeMap<u32, Vec<Parcel>>,
    /// How many of them there are.
    count: usize,
}

impl<T: Transport> FaultyNetwork<T> {
    /// Puts the faults of `network` around `inner`, which connects so many robots that tick every `tick_s`.
    #[must_use]
    pub fn new(inner: T, network: Network, seed: u64, robots: u16, tick_s: f64) -> Self {
        let mut random = Random::new(seed, Stream::Network);
        let bursts = [network.burst_begin, network.burst_end];
        let ways = Ways::new(usize::from(robots), network.deaf, bursts, &mut random);
        Self { inner, network, tick_s, tick: 0, random, ways, late: BTreeMap::new(), count: 0 }
    }

    /// Sends one copy, or loses it.
    fn send_copy(&mut self, parcel: Parcel) -> Result<(), Full> {
        let lost = self.blocked(&parcel) || self.happens(self.network.loss);
        if self.network.delay_max_s <= 0.0 {
            return if lost { Ok(()) } else { self.inner.send(parcel) };
        }
        let due = self.tick.saturating_add(self.delay_ticks());
        if lost {
            return Ok(());
        }
        if self.count >= LATE_MAX {
            return Err(Full);
        }
        self.late.entry(due).or_default().push(parcel);
        self.count += 1;
        Ok(())
    }

    /// Hands over what was late and is due, in the order of the ticks in which it is due, and then as it was sent.
    fn release(&mut self) {
        while let Some(entry) = self.late.first_entry().filter(|entry| *entry.key() <= self.tick) {
            let parcels = entry.remove();
            self.count -= parcels.len();
            for parcel in parcels {
                // A parcel for which the inner network has no room is lost.
                let _ = self.inner.send(parcel);
            }
        }
    }

    fn blocked(&mut self, parcel: &Parcel) -> bool {
        let time_s = f64::from(self.tick) * self.tick_s;
        let divided = self.network.partition.is_some_and(|partition| {
            let first = |index: usize| index < usize::from(partition.first);
            let lasts = partition.from_s <= time_s && time_s < partition.to_s;
            lasts && first(parcel.sender) != first(parcel.receiver)
        });
        divided || self.ways.blocked(parcel.sender, parcel.receiver, self.tick, &mut self.random)
    }

    /// True with `probability`. Nothing is drawn where nothing can happen.
    fn happens(&mut self, probability: f64) -> bool {
        probability > 0.0 && self.random.chance(probability)
    }

    /// The delay in whole ticks, rounded up: what comes within a tick is there at the next.
    fn delay_ticks(&mut self) -> u32 {
        let Network { delay_min_s, delay_max_s, .. } = self.network;
        let delay_s = self.random.uniform(delay_min_s, delay_max_s);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let ticks = (delay_s / self.tick_s).ceil() as u32;
        ticks
    }
}

impl<T: Transport> Transport for FaultyNetwork<T> {
    /// Begins a tick, in which links may begin or stop to lose everything.
    fn begin_tick(&mut self, tick: u32) {
        self.inner.begin_tick(tick);
        self.tick = tick;
        self.ways.begin_tick(&mut self.random);
    }

    fn send(&mut self, parcel: Parcel) -> Result<(), Full> {
        let first =
            if self.happens(self.network.duplicate) { self.send_copy(parcel.clone()) } else { Ok(()) };
        first.and(self.send_copy(parcel))
    }

    fn poll(&mut self) -> Option<Parcel> {
        if self.count > 0 {
            self.release();
        }
        self.inner.poll()
    }
}

#[cfg(test)]
mod tests {
    use closeranks_core::message::MESSAGE_BYTES;

    use super::*;
    use crate::transport::conformance::check_transport;
    use crate::transport::memory::InMemory;

    #[test]
    fn without_faults_it_is_a_transport() {
        let perfect = FaultyNetwork::new(InMemory::new(1_000), Network::default(), 1, 5, 0.005);
        check_transport(&mut { perfect }, &mut || ());
    }

    #[test]
    fn late_messages_are_bounded() {
        let network = Network { delay_min_s: 1.0, delay_max_s: 1.0, ..Network::default() };
        let mut wire = FaultyNetwork::new(InMemory::new(usize::MAX), network, 1, 2, 0.005);
        let parcel = Parcel { sender: 0, receiver: 1, bytes: [0; MESSAGE_BYTES].into() };
        wire.begin_tick(0);
        assert!((0..LATE_MAX).all(|_| wire.send(parcel.clone()) == Ok(())));
        assert_eq!((wire.send(parcel.clone()), wire.poll()), (Err(Full), None));
        wire.begin_tick(200);
        assert_eq!(core::iter::from_fn(|| wire.poll()).count(), LATE_MAX);
        assert_eq!(wire.send(parcel), Ok(()));
    }

    fn arrivals(network: Network) -> Vec<Vec<u8>> {
        let mut wire = FaultyNetwork::new(InMemory::new(1_000), network, 1, 2, 0.005);
        let at = |tick: u32| u8::try_from(tick).unwrap();
        (0..200)
            .map(|tick| {
                wire.begin_tick(tick);
                wire.send(Parcel { sender: 0, receiver: 1, bytes: [at(tick); MESSAGE_BYTES].into() })
                    .unwrap();
                core::iter::from_fn(|| wire.poll()).map(|parcel| parcel.bytes[0]).collect()
            })
            .collect()
    }

    #[test]
    fn a_perfect_network_delivers_at_once() {
        assert!((0..).zip(arrivals(Network::default())).all(|(tick, arrived)| arrived == [tick]));
    }

    #[test]
    fn messages_are_lost_one_by_one_or_in_bursts() {
        let got = |network| arrivals(network).iter().map(|arrived| !arrived.is_empty()).collect::<Vec<_>>();
        let changes = |got: &[bool]| got.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let singly = got(Network { loss: 0.5, ..Network::default() });
        let bursts = got(Network { burst_begin: 0.05, burst_end: 0.05, ..Network::default() });
        for got in [&singly, &bursts] {
            assert!((40..160).contains(&got.iter().filter(|got| **got).count()));
        }
        assert!(changes(&singly) > 60 && changes(&bursts) < 30);
        assert!(got(Network { deaf: 1.0, ..Network::default() }).iter().all(|got| !got));
    }

    #[test]
    fn delays_reorder_and_duplicates_come_twice() {
        let arrived = arrivals(Network { delay_max_s: 0.05, duplicate: 0.5, ..Network::default() }).concat();
        assert!(!arrived.is_sorted());
        let twice =
            (0..180).filter(|tick| arrived.iter().copied().filter(|at| at == tick).count() == 2).count();
        assert!((50..130).contains(&twice), "{twice}");
    }

    #[test]
    fn a_partition_heals() {
        let partition = Some(Partition { first: 1, from_s: 0.25, to_s: 0.5 });
        let got = arrivals(Network { partition, ..Network::default() });
        assert!((0..200).all(|tick| got[tick].is_empty() == (50..100).contains(&tick)));
    }
}
