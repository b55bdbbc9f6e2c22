//! `run`, `liar`, `plant`, `relay` and `fleet`.

use core::sync::atomic::{AtomicBool, Ordering};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, sync_channel};

use clap::Args;
use closeranks_core::Instant;
use core::time::Duration;

use crate::clock::{Clock, Kind};
use crate::commands::Failure;
use crate::config::{Config, Network};
use crate::fleet::tape::Sinks;
use crate::fleet::{self, Options};
use crate::identity::roster::Roster;
use crate::identity::{epoch, keys};
use crate::node;
use crate::plant::pace::Pace;
use crate::plant::world::World;
use crate::relay::{Relay, TICK_S, parties};
use crate::scenarios::{self, FleetScenario};
use crate::session::{Net, send};
use crate::signals::stop_on_signals;

/// Runs a robot until it is told to stop.
pub fn run(config: &Path) -> Result<(), Failure> {
    let stop = Arc::new(AtomicBool::new(false));
    Ok(node::run(&Config::load(config)?, None, &stop)?)
}

/// Runs a robot that lies as a scenario says.
pub fn liar(config: &Path, scenario: &Path) -> Result<(), Failure> {
    let stop = Arc::new(AtomicBool::new(false));
    Ok(node::run(&Config::load(config)?, Some(&scenarios::load(scenario)?.scenario), &stop)?)
}

/// How a process of an experiment is connected.
#[derive(Debug, Args)]
pub struct Connection {
    /// Endpoint to listen at, such as tcp/127.0.0.1:7447; may be given more than once
    #[arg(long)]
    pub listen: Vec<String>,
    /// Endpoint to connect to; may be given more than once
    #[arg(long)]
    pub connect: Vec<String>,
    /// What all keys of the team begin with
    #[arg(long, default_value = "closeranks")]
    pub prefix: String,
    /// A file of Zenoh itself (JSON5), for certificates and access control
    #[arg(long)]
    pub zenoh: Option<PathBuf>,
}

impl Connection {
    fn network(&self) -> Network {
        Network {
            listen: self.listen.clone(),
            connect: self.connect.clone(),
            prefix: self.prefix.clone(),
            zenoh: self.zenoh.clone(),
            ..Network::default()
        }
    }
}

/// A router that hands on what robots say, through the bad network of a scenario.
pub fn relay(connection: &Connection, scenario: &Path) -> Result<(), Failure> {
    let scenario = scenarios::load(scenario)?.scenario;
    let robots = scenario.team.robots;
    let net = Net::open(&connection.network(), "router")?;
    let stop = Arc::new(AtomicBool::new(false));
    stop_on_signals(&stop)?;
    let (queue, arrivals) = sync_channel(crate::node::run::QUEUE);
    let mut ears = Vec::new();
    for key in ["say/*", "aside/*/*"] {
        let parcel = |key: &str, bytes: Vec<u8>| parties(key).map(|(from, to)| (from, to, bytes));
        ears.push(net.listen(key, queue.clone(), parcel)?);
    }
    let mut outs = Vec::new();
    for receiver in 1..=robots {
        let to: Result<Vec<_>, _> =
            (1..=robots).map(|sender| net.out(&format!("to/{receiver}/{sender}"))).collect();
        outs.push(to?);
    }
    let mut relay = Relay::new(scenario.faults.network, scenario.seed, robots);
    let clock = Clock::start(Kind::Machine);
    let began = clock.now();
    let (mut tick, length) = (0_u32, Duration::from_secs_f64(TICK_S));
    while !stop.load(Ordering::Relaxed) {
        let next = began.after(length * tick.saturating_add(1));
        match arrivals.recv_timeout(next.since(clock.now())) {
            Ok((from, to, bytes)) => relay.take(from, to, &bytes),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => break,
        }
        let now = ticks(clock.now(), began, length);
        while tick < now {
            tick += 1;
            relay.begin_tick(tick);
        }
        while let Some((sender, receiver, bytes)) = relay.poll() {
            send(&outs[usize::from(receiver) - 1][usize::from(sender) - 1], bytes);
        }
    }
    drop(ears);
    net.close();
    Ok(())
}

fn ticks(now: Instant, began: Instant, length: Duration) -> u32 {
    u32::try_from(now.since(began).as_nanos() / length.as_nanos()).unwrap_or(u32::MAX)
}

/// The simulated plant of a scenario for robots that are started by hand; true if nothing is held against the run.
pub fn plant(
    scenario: &Path,
    roster: &Path,
    key: &Path,
    clock: Kind,
    connection: &Connection,
) -> Result<bool, Failure> {
    let file = scenarios::load(scenario)?;
    let roster = Arc::new(Roster::load(roster, None)?);
    let key_file = key;
    let key = keys::load(key_file)?;
    if roster.plant() != Some(&key.verifying_key()) {
        return Err(format!("{} is not the key of the plant in the roster", key_file.display()).into());
    }
    let epoch = epoch::next(&key_file.with_extension("epoch"))?;
    let clock = Clock::start(clock);
    let net = Net::open(&connection.network(), "peer")?;
    let stop = Arc::new(AtomicBool::new(false));
    stop_on_signals(&stop)?;
    if file.scenario.dimension == 3 {
        plant_in::<3>(&file, roster, key, epoch, clock, &net, &stop)
    } else {
        plant_in::<2>(&file, roster, key, epoch, clock, &net, &stop)
    }
}

fn plant_in<const D: usize>(
    file: &FleetScenario,
    roster: Arc<Roster>,
    key: ed25519_dalek::SigningKey,
    epoch: u64,
    clock: Clock,
    net: &Net,
    stop: &AtomicBool,
) -> Result<bool, Failure> {
    let world = World::<D>::new(&file.scenario, Arc::clone(&roster), clock.now())?;
    let mut table = fleet::table::Table::new(true, &file.scenario);
    let mut plant = Pace::new(world, roster, key, epoch, clock, net)?;
    let mut draw = |world: &World<D>, now| table.draw(world, &[], now);
    let patience = Duration::from_hours(1);
    if !plant.gather(patience, stop, &mut draw) {
        return Err("not all robots reported".into());
    }
    plant.run(Duration::from_secs_f64(file.scenario.duration_s), stop, &mut draw);
    let summary = plant.into_world().finish();
    let violations: Vec<_> = summary.violations(&file.scenario).collect();
    for verdict in &violations {
        eprintln!("VIOLATION  {} {} times, first {:?}", verdict.law.name(), verdict.count, verdict.first);
    }
    Ok(violations.is_empty())
}

/// Runs a fleet; what is to be printed, and whether nothing is held against it.
pub fn fleet(file: &Path, options: &Options, sinks: Sinks, json: bool) -> Result<(String, bool), Failure> {
    let file = scenarios::load(file)?;
    let stop = Arc::new(AtomicBool::new(false));
    stop_on_signals(&stop)?;
    let verdict = fleet::run(&file, options, sinks, &stop)?;
    let text = if json { serde_json::to_string_pretty(&verdict)? } else { verdict.to_string() };
    Ok((text, verdict.is_good()))
}
