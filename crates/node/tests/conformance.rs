//! The same script in two worlds: the network in memory of the simulator, and Zenoh on loopback. Given the same deliveries, all
//! decisions must be the same, to the last bit.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use core::time::Duration;
use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, sync_channel};

use closeranks_core::{Params, RobotId};
use closeranks_node::bytes::hex;
use closeranks_node::config::Network;
use closeranks_node::identity::parameters;
use closeranks_node::identity::roster::{Draft, Entry, Roster};
use closeranks_node::node::pilot::{Identity, Pilot};
use closeranks_node::plant::world::World as Plant;
use closeranks_node::session::{Ear, Net, Out, send};
use closeranks_sim::engine::fleet::Fleet;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::transport::conformance::check_transport;
use closeranks_sim::transport::{Full, Parcel, Transport};
use closeranks_sim::world::{Options, World, initial_values};
use ed25519_dalek::SigningKey;

const PATIENCE: Duration = Duration::from_secs(20);

/// Two sessions of Zenoh that are connected over TCP on loopback.
fn pair(prefix: &str) -> (Net, Net) {
    let port = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    let endpoint = vec![format!("tcp/127.0.0.1:{port}")];
    let prefix = format!("test/{prefix}");
    let listens = Network { listen: endpoint.clone(), prefix: prefix.clone(), ..Network::default() };
    let connects = Network { connect: endpoint, prefix, ..Network::default() };
    (Net::open(&listens, "peer").unwrap(), Net::open(&connects, "peer").unwrap())
}

/// Sends on `out` until something arrives: from then on the two sessions know of each other's keys.
fn settle(out: &Out, arrived: &Receiver<Vec<u8>>) {
    for _ in 0..1_000 {
        send(out, Vec::new());
        if arrived.recv_timeout(Duration::from_millis(20)).is_ok() {
            while arrived.recv_timeout(Duration::from_millis(200)).is_ok() {}
            return;
        }
    }
    panic!("two sessions on loopback do not hear each other");
}

/// A transport of the simulator whose parcels go over Zenoh.
struct OverZenoh {
    out: Out,
    arrived: Receiver<Vec<u8>>,
    here: VecDeque<Vec<u8>>,
    _ear: Ear,
    _nets: (Net, Net),
}

impl OverZenoh {
    fn new(prefix: &str) -> Self {
        let nets = pair(prefix);
        let (queue, arrived) = sync_channel(100_000);
        let ear = nets.1.listen("parcel", queue, |_, bytes| Some(bytes)).unwrap();
        let out = nets.0.out("parcel").unwrap();
        settle(&out, &arrived);
        Self { out, arrived, here: VecDeque::new(), _ear: ear, _nets: nets }
    }
}

impl Transport for OverZenoh {
    fn begin_tick(&mut self, _tick: u32) {}

    fn send(&mut self, parcel: Parcel) -> Result<(), Full> {
        let ends = [parcel.sender, parcel.receiver].map(|end| u8::try_from(end).unwrap());
        send(&self.out, [&ends[..], &parcel.bytes].concat());
        // Nodes publish to be dropped when a link is full. Here every delivery must be the same as in memory, so one goes after the other.
        self.here.push_back(self.arrived.recv_timeout(PATIENCE).expect("a parcel was lost on loopback"));
        Ok(())
    }

    fn poll(&mut self) -> Option<Parcel> {
        let bytes = self.here.pop_front()?;
        let (ends, bytes) = bytes.split_at(2);
        Some(Parcel { sender: usize::from(ends[0]), receiver: usize::from(ends[1]), bytes: bytes.into() })
    }
}

#[test]
fn zenoh_is_a_transport() {
    check_transport(&mut OverZenoh::new("transport"), &mut || std::thread::sleep(Duration::from_millis(1)));
}

/// Seven robots with this controller, and their settings as a roster has them.
fn scenario(kind: &str) -> (Scenario, String) {
    let text = format!(
        "[team]\nrobots = 7\nfaults = 1\nmalicious = []\n[controller]\nkind = '{kind}'\n[clock]\ntau_1_s = 0.05\n\
         tau_2_s = 0.2\n[start]\nkind = 'hexagon'\nspacing_m = 0.6\n[motion]\nkind = 'paper'\n"
    );
    (closeranks_sim::parse::scenario(&text).unwrap(), parameters::extract(&text).unwrap())
}

#[test]
fn the_simulators_fleet_over_zenoh_is_the_fleet_in_memory() {
    let (scenario, _) = scenario("budget");
    let params: Params<2> = scenario.params().unwrap();
    let values = initial_values(&scenario).unwrap();
    let mut there = Fleet::over(OverZenoh::new("fleet"), &scenario, params, &values).unwrap();
    let mut here = Fleet::new(&scenario, params, &values).unwrap();
    let mut liars = [(); 2].map(|()| closeranks_sim::attack::liars::Liars::new(&scenario));
    let start = scenario.positions().unwrap();
    let mut frames = [(); 2].map(|()| closeranks_sim::frame::Frame::new(start.clone(), values.clone()));
    for tick in 0..40 {
        let [first, second] = &mut frames;
        closeranks_sim::world::want(&scenario, tick, first);
        second.desired_m_s.clone_from(&first.desired_m_s);
        for frame in [&mut *first, &mut *second] {
            frame.asked_m_s.clone_from(&frame.desired_m_s);
        }
        here.step(first, &mut liars[0]);
        there.step(second, &mut liars[1]);
        assert_eq!(first.velocities_m_s, second.velocities_m_s, "tick {tick}");
        assert_eq!((&first.modes, &first.values, &first.told), (&second.modes, &second.values, &second.told));
        for frame in [first, second] {
            for (position, velocity) in frame.positions_m.iter_mut().zip(&frame.velocities_m_s) {
                *position = [position[0] + 0.05 * velocity[0], position[1] + 0.05 * velocity[1]];
            }
        }
    }
}

/// A roster with made-up keys for `scenario`.
fn roster(scenario: &Scenario, settings: &str) -> (Arc<Roster>, Vec<SigningKey>) {
    let key = |id: u16| SigningKey::from_bytes(&[u8::try_from(id).unwrap() + 1; 32]);
    let public = |id| hex(key(id).verifying_key().as_bytes());
    let robots = 1..=scenario.team.robots;
    let entry = |id| Entry { id, name: format!("robot_{id}"), key: public(id) };
    let draft = Draft {
        name: "test".into(),
        parameters: settings.into(),
        plant: Some(public(0)),
        robots: robots.clone().map(entry).collect(),
    };
    let text = draft.sign(&SigningKey::from_bytes(&[99; 32])).unwrap();
    (Arc::new(Roster::read(&text, None).unwrap()), robots.map(key).collect())
}

/// Nodes with signatures, gates, looks and reports over Zenoh move as the robots of the simulator do.
#[test]
fn nodes_over_zenoh_decide_as_the_simulator_does() {
    for kind in ["budget", "links", "composed", "none"] {
        decide_alike(kind);
    }
}

fn decide_alike(kind: &str) {
    let (scenario, settings) = scenario(kind);
    let (roster, keys) = roster(&scenario, &settings);
    let values = initial_values(&scenario).unwrap();
    let params: Params<2> = roster.scenario().params().unwrap();
    let pilot = |(id, key): (u16, &SigningKey)| {
        let identity = Identity { roster: Arc::clone(&roster), id: RobotId(id), key: key.clone(), epoch: 1 };
        Pilot::new(identity, params, values[usize::from(id) - 1]).unwrap()
    };
    let mut pilots: Vec<Pilot<2>> = (1..).zip(&keys).map(pilot).collect();
    let (ours, theirs) = pair(kind);
    let (queue, arrived) = sync_channel(10_000);
    let _ear = theirs.listen("wire", queue, |_, bytes| Some(bytes)).unwrap();
    let out = ours.out("wire").unwrap();
    settle(&out, &arrived);
    let carry = |bytes: Vec<u8>| {
        send(&out, bytes);
        arrived.recv_timeout(PATIENCE).expect("an envelope was lost on loopback")
    };
    let mut simulated =
        World::<2>::new(&scenario, Options { without_phi: true, ..Options::default() }).unwrap();
    let start = closeranks_core::Instant::from_nanos(0);
    let mut plant = Plant::<2>::new(&scenario, Arc::clone(&roster), start).unwrap();
    for tick in 0..60 {
        simulated.step();
        let now = plant.next_begins();
        let looks = plant.begin_tick();
        let mut said = Vec::new();
        for (pilot, look) in pilots.iter_mut().zip(&looks) {
            if let Some(message) = pilot.sense(look) {
                said.push(carry(pilot.say(now, &pilot.encode(&message).unwrap()).unwrap()));
            }
        }
        for bytes in &said {
            for pilot in &mut pilots {
                assert!(pilot.hear(now, bytes).is_empty(), "nobody is two-faced");
            }
        }
        for (index, pilot) in pilots.iter_mut().enumerate() {
            let desired = simulated.frame().desired_m_s[index];
            let report = pilot.decide(desired);
            assert_eq!(
                report.velocity_m_s,
                simulated.frame().velocities_m_s[index],
                "{kind}, robot {index}, tick {tick}"
            );
            assert_eq!(report.mode, simulated.frame().modes[index], "{kind}, robot {index}, tick {tick}");
            assert_eq!(report.value, simulated.frame().values[index], "{kind}, robot {index}, tick {tick}");
            let bytes = carry(pilot.report(now, &report).unwrap());
            plant.take(now, &bytes).unwrap();
        }
        plant.end_tick();
    }
    assert_eq!(plant.late(), 0);
    if scenario.controller.row().guarantees {
        assert_eq!(plant.finish().violations(&scenario).count(), 0, "{kind}");
    }
}
