//! One robot: its state machine, its loop, its voice and its wish, put together from a configuration.

mod connect;
mod figures;
pub mod pilot;
mod reload;
mod ros;
mod ros_view;
pub mod run;
pub mod status;
pub mod voice;
pub mod wish;

use core::sync::atomic::AtomicBool;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::sync_channel;

use closeranks_core::{Params, ParamsError, RobotError, RobotId};
use closeranks_sim::scenario::Scenario;

use crate::bytes::hex;
use crate::clock::Clock;
use crate::config::{Config, ConfigError, Desired, Plant};
use crate::identity::epoch::{self, EpochError};
use crate::identity::keys::{self, KeyError};
use crate::identity::roster::{Roster, RosterError};
use crate::node::connect::{Link, Wires, reconnect};
use crate::node::pilot::{Identity, Pilot};
use crate::node::run::{Node, QUEUE, Wish};
use crate::node::voice::Silent;
use crate::node::wish::{Hold, Key, Listed};
use crate::plant::replay::{REPLAY_MAX, Replay, ReplayError};
use crate::plant::simulated::Simulated;
use crate::plant::{Nowhere, PlantPort};
use crate::scenarios::{self, ScenarioError};
use crate::session::{Net, SessionError};
use crate::signals::stop_on_signals;

/// Why a robot does not start.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each says what it is about itself")]
pub enum NodeError {
    #[error(transparent)]
    Config(#[from] ConfigError),
    #[error(transparent)]
    Roster(#[from] RosterError),
    #[error(transparent)]
    Key(#[from] KeyError),
    #[error(transparent)]
    Epoch(#[from] EpochError),
    #[error(transparent)]
    Session(#[from] SessionError),
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    #[error(transparent)]
    Params(#[from] ParamsError),
    #[error(transparent)]
    Robot(#[from] RobotError),
    #[error(
        "`operator` must be a public key of 64 hexadecimal digits: it is printed by `closeranks-node roster show`"
    )]
    Operator,
    #[error("`{field}` is `{found}`: no robot of the roster is called that; there are {names}")]
    Name { field: &'static str, found: String, names: String },
    #[error("the key in {path} is not that of {robot} in the roster ({found}, must be {expected})")]
    WrongKey { path: PathBuf, robot: String, found: String, expected: String },
    #[error("{path}: {error}")]
    ReplayFile { path: PathBuf, error: std::io::Error },
    #[error("{path}: {error}")]
    Replay { path: PathBuf, error: ReplayError },
    #[error(
        "the roster has no key of a plant: use `plant.kind = \"replay\"`, or add one with `closeranks-node roster add DIR plant`"
    )]
    NoPlant,
    #[error(
        "only `distrust`, `network` and the roster are read anew while a robot runs; anything else needs another start"
    )]
    Restart,
    #[error("the roster differs and the simulated plant has read the old one: start it and all robots anew")]
    PlantsRoster,
    #[error(
        "{topic} is there with the type {found}, and this robot has {expected}: they would not hear each other. Set `plant.ros_distro`, or \
         the definitions differ"
    )]
    Hash { topic: String, found: String, expected: String },
    #[error("signals cannot be handled: {0}")]
    Signals(#[from] ctrlc::Error),
}

/// Runs the robot of `config` until `stop`. With the scenario of an experiment it is one of its liars.
pub fn run(config: &Config, lies: Option<&Scenario>, stop: &Arc<AtomicBool>) -> Result<(), NodeError> {
    let roster = load_roster(config)?;
    if roster.scenario().dimension == 3 {
        run_in::<3>(config, &roster, lies, stop)
    } else {
        run_in::<2>(config, &roster, lies, stop)
    }
}

/// The roster of a configuration, if its operator signed it.
pub fn load_roster(config: &Config) -> Result<Arc<Roster>, NodeError> {
    let operator = keys::public(&config.operator).ok_or(NodeError::Operator)?;
    Ok(Arc::new(Roster::load(&config.roster, Some(&operator))?))
}

fn named(roster: &Roster, field: &'static str, name: &str) -> Result<RobotId, NodeError> {
    roster.find(name).ok_or_else(|| {
        let names: Vec<&str> = roster.robots().iter().map(|entry| entry.name.as_str()).collect();
        NodeError::Name { field, found: name.into(), names: names.join(", ") }
    })
}

/// Who the robot of a configuration is. Its number of starts is counted up.
fn identity(config: &Config, roster: Arc<Roster>) -> Result<Identity, NodeError> {
    let id = named(&roster, "robot", &config.robot)?;
    let key = keys::load(&config.key)?;
    let (found, expected) = (key.verifying_key(), roster.key(id).copied());
    if Some(found) != expected {
        return Err(NodeError::WrongKey {
            path: config.key.clone(),
            robot: config.robot.clone(),
            found: hex(found.as_bytes()),
            expected: expected.map(|key| hex(key.as_bytes())).unwrap_or_default(),
        });
    }
    let epoch = epoch::next(&config.epoch)?;
    Ok(Identity { roster, id, key, epoch })
}

fn run_in<const D: usize>(
    config: &Config,
    roster: &Arc<Roster>,
    lies: Option<&Scenario>,
    stop: &Arc<AtomicBool>,
) -> Result<(), NodeError> {
    let params: Params<D> = roster.scenario().params()?;
    let clock = Clock::start(config.clock);
    let id = named(roster, "robot", &config.robot)?;
    // What a file may have wrong is found before anything is opened or counted.
    let port = port(config, roster, &params, id, clock)?;
    let wish = wish(config, id)?;
    let identity = identity(config, Arc::clone(roster))?;
    let mut pilot = Pilot::new(identity, params, config.value)?;
    for name in &config.distrust {
        pilot.trust(named(roster, "distrust", name)?, false);
    }
    let period = params.settings().clock.level_period;
    let (queue, events) = sync_channel(QUEUE);
    let link = Link { config, roster, id, period, lies, queue };
    let mut net = Net::open(&config.network, &config.network.mode)?;
    let mut wires: Wires<D> = link.wires(&config.network, &net)?;
    // Until here nothing moves, so signals may end the process at once.
    stop_on_signals(stop)?;
    if let Some(file) = &config.file {
        let queue = link.queue.clone();
        reload::watch(file.clone(), config.clone(), Arc::clone(roster), queue, Arc::clone(stop));
    }
    let (port, wish) = (port.unwrap_or_else(|| Box::new(Nowhere)), wish.unwrap_or_else(|| Box::new(Hold)));
    let mut node = Node::new(pilot, port, Box::new(Silent), wish, clock, period);
    let mut network = config.network.clone();
    loop {
        let kept = wires.into(&mut node);
        let Some(new) = node.run(&events, stop) else { break };
        drop(kept);
        node.voice = Box::new(Silent);
        (net, network) = reconnect(net, network, *new)?;
        wires = link.wires(&network, &net)?;
    }
    // One write, so that the lines of processes that share a log do not mix.
    let figures = node.end(net.traffic()).to_string();
    eprintln!("{figures}");
    net.close();
    Ok(())
}

/// Where the robot is, unless topics say it, which need a session.
fn port<const D: usize>(
    config: &Config,
    roster: &Arc<Roster>,
    params: &Params<D>,
    id: RobotId,
    clock: Clock,
) -> Result<Option<Box<dyn PlantPort<D>>>, NodeError> {
    Ok(match (&config.plant, recorded(config, params, id, clock)?) {
        (_, Some(replay)) => Some(Box::new(replay)),
        (Plant::Ros2(_), _) => None,
        _ if roster.plant().is_none() => return Err(NodeError::NoPlant),
        _ => Some(Box::new(Simulated::new(Arc::clone(roster), id, params))),
    })
}

/// Where the robot wants to go, unless a topic says it.
fn wish<const D: usize>(config: &Config, id: RobotId) -> Result<Option<Box<dyn Wish<D>>>, NodeError> {
    Ok(match (&config.desired, listed(config, id)?) {
        (_, Some(listed)) => Some(Box::new(listed)),
        (Desired::Key { timeout_s }, _) => Some(Box::new(Key::new(config.timeout(*timeout_s)))),
        (Desired::Ros2 { .. }, _) => None,
        _ => Some(Box::new(Hold)),
    })
}

/// The recording that a configuration names, if it does.
fn recorded<const D: usize>(
    config: &Config,
    params: &Params<D>,
    id: RobotId,
    clock: Clock,
) -> Result<Option<Replay<D>>, NodeError> {
    let Plant::Replay { file } = &config.plant else { return Ok(None) };
    let text = read(file, REPLAY_MAX)?;
    let period = params.settings().clock.level_period;
    let start = crate::clock::tick(clock.now().after(period), period);
    let replay = Replay::read(&text, id, params, start);
    Ok(Some(replay.map_err(|error| NodeError::Replay { path: file.clone(), error })?))
}

fn read(path: &Path, most: u64) -> Result<String, NodeError> {
    let file = |error| NodeError::ReplayFile { path: path.to_owned(), error };
    if fs::metadata(path).map_err(file)?.len() > most {
        return Err(file(std::io::Error::other(format!("has more than {most} bytes"))));
    }
    fs::read_to_string(path).map_err(file)
}

/// The motion of the scenario that a configuration names, if it does.
fn listed<const D: usize>(config: &Config, id: RobotId) -> Result<Option<Listed<D>>, NodeError> {
    let Desired::Scenario { file } = &config.desired else { return Ok(None) };
    Ok(Some(Listed::new(scenarios::load(file)?.scenario, id.0)))
}
