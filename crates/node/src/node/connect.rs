//! How a robot is connected: its voice, its ears and its topics, which end with a session and begin anew with the next one.

use core::time::Duration;
use std::sync::Arc;
use std::sync::mpsc::SyncSender;

use closeranks_core::RobotId;
use closeranks_sim::scenario::Scenario;

use crate::config::{Config, Desired, Hear, Network, Plant};
use crate::identity::roster::Roster;
use crate::node::NodeError;
use crate::node::ros::{self, Planner};
use crate::node::ros_view;
use crate::node::run::{Event, Node, Voice, Wish};
use crate::node::voice::{Lying, Plain};
use crate::plant::PlantPort;
use crate::session::{Ear, Net, SessionError, Token, number};

/// What a robot needs to be connected, once or again.
pub(super) struct Link<'a> {
    pub(super) config: &'a Config,
    pub(super) roster: &'a Arc<Roster>,
    pub(super) id: RobotId,
    pub(super) period: Duration,
    pub(super) lies: Option<&'a Scenario>,
    pub(super) queue: SyncSender<Event>,
}

/// Where a robot among topics is, and where it wants to go if a topic says that too.
struct Topics<const D: usize> {
    port: Box<dyn PlantPort<D>>,
    wish: Option<Box<dyn Wish<D>>>,
}

/// What connects a robot: it ends with its session.
pub(super) struct Wires<const D: usize> {
    voice: Box<dyn Voice<D>>,
    /// Port and wish of a robot among topics.
    topics: Option<Topics<D>>,
    ears: Vec<Ear>,
    tokens: Vec<Token>,
}

impl<const D: usize> Wires<D> {
    /// Connects `node`; it is connected as long as what comes back is there.
    pub(super) fn into(self, node: &mut Node<'_, D>) -> (Vec<Ear>, Vec<Token>) {
        node.voice = self.voice;
        if let Some(Topics { port, wish }) = self.topics {
            node.port = port;
            if let Some(wish) = wish {
                node.wish = wish;
            }
        }
        (self.ears, self.tokens)
    }
}

impl Link<'_> {
    pub(super) fn wires<const D: usize>(&self, network: &Network, net: &Net) -> Result<Wires<D>, NodeError> {
        let Self { config, roster, id, .. } = self;
        let robots = u16::try_from(roster.robots().len()).unwrap_or(u16::MAX);
        let (voice, mut tokens) = voice(config, net, *id, robots, self.lies)?;
        let mut topics = None;
        if let Plant::Ros2(of) = &config.plant {
            ros::agree(of, &config.desired, roster, *id, net)?;
            let timeout = config.timeout(of.source_timeout);
            let (port, shown) = ros::plant((of, timeout), roster, *id, self.period, net)?;
            tokens.extend(shown);
            let own = port.own();
            let planner = |timeout_s| -> Box<dyn Wish<D>> {
                Box::new(Planner::new(own, of, config.timeout(timeout_s)))
            };
            let wish = match &config.desired {
                Desired::Ros2 { timeout_s, .. } => Some(planner(*timeout_s)),
                _ => None,
            };
            topics = Some(Topics { port: Box::new(port), wish });
        }
        let ears = ears(net, network, config, roster, *id, &self.queue)?;
        Ok(Wires { voice, topics, ears, tokens })
    }
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

/// Ends a session and opens one with other endpoints, or the old one again if that cannot be.
pub(super) fn reconnect(net: Net, old: Network, new: Network) -> Result<(Net, Network), SessionError> {
    if let Err(error) = Net::check(&new, &new.mode) {
        eprintln!("the new endpoints are not used: {error}");
        return Ok((net, old));
    }
    net.close();
    match Net::open(&new, &new.mode) {
        Ok(net) => {
            eprintln!("connected anew: listen {:?}, connect {:?}", new.listen, new.connect);
            Ok((net, new))
        }
        Err(error) => {
            eprintln!("the new endpoints are not used: {error}");
            Ok((Net::open(&old, &old.mode)?, old))
        }
    }
}

/// Everything that a robot listens to.
fn ears(
    net: &Net,
    network: &Network,
    config: &Config,
    roster: &Roster,
    id: RobotId,
    queue: &SyncSender<Event>,
) -> Result<Vec<Ear>, SessionError> {
    let said = match network.hear {
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
