//! The topics of ROS 2 around one robot.

use core::time::Duration;

use std::sync::PoisonError;
use std::sync::mpsc::SyncSender;

use closeranks_core::{Instant, RobotId};

use crate::clock::wall_nanos;
use crate::config::{Desired, PoseType, Ros2};
use crate::identity::roster::Roster;
use crate::node::NodeError;
use crate::node::run::{Event, Wish};
use crate::plant::ros::{Own, Ros, Source};
use crate::ros::frame::Base;
use crate::ros::keys::{self, Form, Naming, Type, attachment};
use crate::ros::messages::{Twist, read_twist, twist, twist_stamped};
use crate::session::{Ear, Net, Out, SessionError, Token, send, send_with};

/// Name of the node in ROS 2, before the name of the robot.
pub(super) const NODE: &str = "closeranks";

/// How long others may take to say which topics they have.
const ASKED: Duration = Duration::from_millis(500);

/// A topic of the robot of that name.
pub(super) fn topic(pattern: &str, name: &str) -> String {
    pattern.replace("{name}", name)
}

/// How its topics become keys.
fn naming(ros: &Ros2) -> Naming {
    Naming { domain: ros.domain, distro: ros.ros_distro, form: ros.keys }
}

/// A topic that a robot publishes on, and what names its publisher.
pub(super) struct Topic {
    out: Out,
    form: Form,
    publisher: [u8; 16],
    sequence: i64,
}

impl Topic {
    /// Topic `number` of the robot of that name, and what makes it visible.
    pub(super) fn open(
        ros: &Ros2,
        (name, pattern): (&str, &str),
        number: u32,
        kind: &Type,
        net: &Net,
    ) -> Result<(Self, Vec<Token>), SessionError> {
        let (naming, to) = (naming(ros), topic(pattern, name));
        let tokens = naming.tokens(&net.name(), &format!("{NODE}_{name}"), number, (&to, kind));
        let tokens = tokens.into_iter().map(|token| net.token(token)).collect::<Result<_, _>>()?;
        // What names the publisher must differ from all others: the session's name is drawn at random.
        let publisher = crate::wire::envelope::hash(format!("{} {number}", net.name()).as_bytes());
        let out = net.out_at(naming.key(&to, kind))?;
        Ok((Self { out, form: ros.keys, publisher, sequence: 0 }, tokens))
    }

    /// Publishes a message of the time `nanos`.
    pub(super) fn send(&mut self, nanos: u64, bytes: Vec<u8>) {
        self.sequence += 1;
        match self.form {
            Form::RmwZenoh => {
                send_with(&self.out, bytes, &attachment(self.sequence, nanos, &self.publisher));
            }
            Form::Ros2dds => send(&self.out, bytes),
        }
    }
}

fn velocity_type(ros: &Ros2) -> &'static Type {
    if ros.enable_stamped_cmd_vel { &keys::TWIST_STAMPED } else { &keys::TWIST }
}

fn pose_type(ros: &Ros2) -> &'static Type {
    match ros.pose_type {
        PoseType::Odometry => &keys::ODOMETRY,
        PoseType::Pose => &keys::POSE_STAMPED,
    }
}

/// Refuses to begin where somebody who is there has one of the topics of this robot with another type, or another hash of it: the two
/// would not hear each other, and nobody would say so.
pub(super) fn agree(
    ros: &Ros2,
    desired: &Desired,
    roster: &Roster,
    id: RobotId,
    net: &Net,
) -> Result<(), NodeError> {
    let naming = naming(ros);
    let Some(all) = naming.all_tokens() else { return Ok(()) };
    let name = name_of(roster, id);
    let mut used = vec![(topic(&ros.cmd_vel_out_topic, name), velocity_type(ros))];
    used.extend(roster.robots().iter().map(|entry| (topic(&ros.pose_topic, &entry.name), pose_type(ros))));
    if let Desired::Ros2 { cmd_vel_in_topic, .. } = desired {
        used.push((topic(cmd_vel_in_topic, name), velocity_type(ros)));
    }
    for token in net.tokens(&all, ASKED)? {
        for (topic, kind) in &used {
            if let Some(found) = naming.differs(&token, topic, kind) {
                return Err(NodeError::Hash { topic: topic.clone(), found, expected: naming.kind(kind) });
            }
        }
    }
    Ok(())
}

/// The plant of robot `id`: what it publishes and is shown by.
pub(super) fn plant<const D: usize>(
    (ros, timeout): (&Ros2, Duration),
    roster: &Roster,
    id: RobotId,
    period: Duration,
    net: &Net,
) -> Result<(Ros<D>, Vec<Token>), SessionError> {
    let place = (name_of(roster, id), ros.cmd_vel_out_topic.as_str());
    let (mut to, shown) = Topic::open(ros, place, 1, velocity_type(ros), net)?;
    let (stamped, frame) = (ros.enable_stamped_cmd_vel, ros.base_frame_id.clone());
    let drive = move |_: Instant, velocity: &Twist| {
        let nanos = wall_nanos();
        to.send(nanos, if stamped { twist_stamped(nanos, &frame, velocity) } else { twist(velocity) });
    };
    let base = ros.look_ahead_m.map_or(Base::Holonomic, |ahead_m| Base::Unicycle { ahead_m });
    let source =
        Source { odometry: ros.pose_type == PoseType::Odometry, frame: ros.frame.clone(), timeout, base };
    let robots = u16::try_from(roster.robots().len()).unwrap_or(u16::MAX);
    Ok((Ros::new(id, robots, source, period, Box::new(drive)), shown))
}

/// Listens to the pose of every robot.
pub(crate) fn poses(
    ros: &Ros2,
    roster: &Roster,
    net: &Net,
    queue: &SyncSender<Event>,
) -> Result<Vec<Ear>, SessionError> {
    let ears = roster.robots().iter().map(|entry| {
        let full = naming(ros).key(&topic(&ros.pose_topic, &entry.name), pose_type(ros));
        let id = RobotId(entry.id);
        net.listen_at(full, 0, queue.clone(), move |_, bytes| Some(Event::Sensed(id, bytes)))
    });
    ears.collect()
}

/// Listens to the velocity that a planner wants.
pub(crate) fn wanted(
    ros: &Ros2,
    pattern: &str,
    roster: &Roster,
    id: RobotId,
    net: &Net,
    queue: &SyncSender<Event>,
) -> Result<Ear, SessionError> {
    let full = naming(ros).key(&topic(pattern, name_of(roster, id)), velocity_type(ros));
    net.listen_at(full, 0, queue.clone(), |_, bytes| Some(Event::Want(bytes)))
}

fn name_of(roster: &Roster, id: RobotId) -> &str {
    let index = usize::from(id.0).wrapping_sub(1);
    roster.robots().get(index).map_or("", |entry| entry.name.as_str())
}

/// A robot that follows what a planner asks of its base.
pub(crate) struct Planner {
    own: Own,
    base: Base,
    stamped: bool,
    timeout: Duration,
    newest: Option<(Instant, Twist)>,
}

impl Planner {
    /// Turns velocities of the base by the pose in `own`. Nothing older than `timeout` is followed; with 0 everything is.
    pub(crate) fn new(own: Own, ros: &Ros2, timeout: Duration) -> Self {
        let base = ros.look_ahead_m.map_or(Base::Holonomic, |ahead_m| Base::Unicycle { ahead_m });
        Self { own, base, stamped: ros.enable_stamped_cmd_vel, timeout, newest: None }
    }
}

impl<const D: usize> Wish<D> for Planner {
    /// What is no velocity, or has a number that is not finite, is not taken.
    fn arrived(&mut self, now: Instant, bytes: &[u8]) {
        if let Some(twist) = read_twist(bytes, self.stamped) {
            self.newest = Some((now, twist));
        }
    }

    fn desired(&mut self, now: Instant, _own_m: &[f64; D]) -> [f64; D] {
        let pose = *self.own.lock().unwrap_or_else(PoisonError::into_inner);
        let young = |at: Instant| self.timeout.is_zero() || now.since(at) <= self.timeout;
        let wanted = self.newest.filter(|(at, _)| young(*at)).zip(pose);
        let velocity = wanted.map(|((_, twist), (_, pose))| self.base.velocity_m_s(&pose, &twist));
        core::array::from_fn(|axis| {
            velocity.map_or(f64::NAN, |velocity| velocity.get(axis).copied().unwrap_or(0.0))
        })
    }
}
