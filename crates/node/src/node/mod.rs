//! One robot: its state machine, its loop, its voice and its wish, put together from a configuration.

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
use std::sync::mpsc::{SyncSender, sync_channel};

use closeranks_core::{Params, ParamsError, RobotError, RobotId};
use closeranks_sim::scenario::Scenario;

use crate::bytes::hex;
use crate::clock::Clock;
use crate::config::{Config, ConfigError, Desired, Hear, Plant};
use crate::identity::epoch::{self, EpochError};
use crate::identity::keys::{self, KeyError};
use crate::identity::roster::{Roster, RosterError};
use crate::node::pilot::{Identity, Pilot};
use crate::node::ros::Planner;
use crate::node::run::{Event, Node, QUEUE, Voice, Wish};
use crate::node::voice::{Lying, Plain};
use crate::node::wish::{Hold, Key, Listed};
use crate::plant::PlantPort;
use crate::plant::replay::{REPLAY_MAX, Replay, ReplayError};
use crate::plant::ros::Own;
use crate::plant::simulated::Simulated;
use crate::scenarios::{self, ScenarioError};
use crate::session::{Ear, Net, SessionError, Token, number};
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
        "only `distrust` and the roster are read anew while a robot runs; anything else needs another start"
    )]
    Restart,
    #[error("the roster differs and the simulated plant has read the old one: start it and all robots anew")]
    PlantsRoster,
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
    let recorded = recorded(config, &params, id, clock)?;
    let listed = listed(config, id)?;
    let identity = identity(config, Arc::clone(roster))?;
    let mut pilot = Pilot::new(identity, params, config.value)?;
    for name in &config.distrust {
        pilot.trust(named(roster, "distrust", name)?, false);
    }
    let net = Net::open(&config.network, &config.network.mode)?;
    let period = params.settings().clock.level_period;
    let mut tokens = Vec::new();
    let mut own = Own::default();
    let port: Box<dyn PlantPort<D>> = match (&config.plant, recorded) {
        (_, Some(replay)) => Box::new(replay),
        (Plant::Ros2(topics), _) => {
            let (port, shown) =
                ros::plant((topics, config.timeout(topics.source_timeout)), roster, id, period, &net)?;
            own = port.own();
            tokens = shown;
            Box::new(port)
        }
        _ if roster.plant().is_none() => return Err(NodeError::NoPlant),
        _ => Box::new(Simulated::new(Arc::clone(roster), id, &params)),
    };
    let wish: Box<dyn Wish<D>> = match (&config.desired, &config.plant, listed) {
        (_, _, Some(listed)) => Box::new(listed),
        (Desired::Key { timeout_s }, _, _) => Box::new(Key::new(config.timeout(*timeout_s))),
        (Desired::Ros2 { timeout_s, .. }, Plant::Ros2(topics), _) => {
            Box::new(Planner::new(own, topics, config.timeout(*timeout_s)))
        }
        _ => Box::new(Hold),
    };
    let (voice, shown) = voice(config, &net, id, params.settings().team.robots, lies)?;
    tokens.extend(shown);
    // Until here nothing moves, so signals may end the process at once.
    stop_on_signals(stop)?;
    let (queue, events) = sync_channel(QUEUE);
    let ears = ears(&net, config, roster, id, &queue)?;
    if let Some(file) = &config.file {
        reload::watch(file.clone(), config.clone(), Arc::clone(roster), queue.clone(), Arc::clone(stop));
    }
    drop(queue);
    Node::new(pilot, port, voice, wish, clock, period).run(&events, stop);
    drop((ears, tokens));
    net.close();
    Ok(())
}

/// How the robot speaks, and what makes its topics visible.
fn voice<const D: usize>(
    config: &Config,
    net: &Net,
    id: RobotId,
    robots: u16,
    lies: Option<&Scenario>,
) -> Result<(Box<dyn Voice<D>>, Vec<Token>), NodeError> {
    let (mut viewer, mut tokens) = (None, Vec::new());
    if let Plant::Ros2(topics) = &config.plant {
        let (show, shown) = ros_view::viewer(topics, &config.robot, net)?;
        (viewer, tokens) = (Some(show), shown);
    }
    let plain = Plain::new(net, id, robots, config.proofs.clone())?.seen_by(viewer);
    let voice: Box<dyn Voice<D>> = match lies {
        Some(scenario) => Box::new(Lying::new(plain, net, id, scenario)?),
        None => Box::new(plain),
    };
    Ok((voice, tokens))
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

/// Everything that a robot listens to.
fn ears(
    net: &Net,
    config: &Config,
    roster: &Roster,
    id: RobotId,
    queue: &SyncSender<Event>,
) -> Result<Vec<Ear>, SessionError> {
    let said = match config.network.hear {
        Hear::Direct => vec!["say/*".to_owned(), format!("aside/*/{}", id.0)],
        Hear::Relayed => vec![format!("to/{}/*", id.0)],
    };
    let mut ears = Vec::new();
    for key in said {
        // A session hears itself too.
        let own = id.0;
        let other = move |key: &str| !(key.starts_with("say/") && number(key) == Some(own));
        ears.push(
            net.listen(&key, queue.clone(), move |key, bytes| other(key).then_some(Event::Said(bytes)))?,
        );
    }
    ears.push(net.listen("evidence/*", queue.clone(), |_, bytes| Some(Event::Evidence(bytes)))?);
    ears.push(net.listen("proof/*", queue.clone(), |_, bytes| Some(Event::Proof(bytes)))?);
    if config.plant == Plant::Simulated {
        let key = format!("sensed/{}", id.0);
        ears.push(net.listen(&key, queue.clone(), move |_, bytes| Some(Event::Sensed(id, bytes)))?);
    }
    if matches!(config.desired, Desired::Key { .. }) {
        let key = format!("want/{}", id.0);
        ears.push(net.listen(&key, queue.clone(), |_, bytes| Some(Event::Want(bytes)))?);
    }
    if config.trust_key {
        let key = format!("trust/{}", id.0);
        ears.push(net.listen(&key, queue.clone(), |_, bytes| Some(Event::Trust(bytes)))?);
    }
    if let Plant::Ros2(topics) = &config.plant {
        ears.extend(ros::poses(topics, roster, net, queue)?);
        if let Desired::Ros2 { cmd_vel_in_topic, .. } = &config.desired {
            ears.push(ros::wanted(topics, cmd_vel_in_topic, roster, id, net, queue)?);
        }
    }
    Ok(ears)
}
