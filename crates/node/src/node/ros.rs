//! The topics of ROS 2 around one robot.

use core::time::Duration;

use std::sync::PoisonError;
use std::sync::mpsc::SyncSender;

use closeranks_core::{Instant, RobotId};

use crate::clock::wall_nanos;
use crate::config::{PoseType, Ros2};
use crate::identity::roster::Roster;
use crate::node::run::{Event, Wish};
use crate::plant::ros::{Own, Ros, Source};
use crate::ros::frame::Base;
use crate::ros::keys::{self, End, attachment, key, tokens};
use crate::ros::messages::{Twist, read_twist, twist, twist_stamped};
use crate::session::{Ear, Net, SessionError, Token, send_with};

/// Name of the node in ROS 2, before the name of the robot.
pub(super) const NODE: &str = "closeranks";

/// A topic of the robot of that name.
pub(super) fn topic(pattern: &str, name: &str) -> String {
    pattern.replace("{name}", name)
}

/// The plant of robot `id`: what it publishes and is shown by.
pub(crate) fn plant<const D: usize>(
    (ros, timeout): (&Ros2, Duration),
    roster: &Roster,
    id: RobotId,
    period: Duration,
    net: &Net,
) -> Result<(Ros<D>, Vec<Token>), SessionError> {
    let name = name_of(roster, id);
    let to = topic(&ros.cmd_vel_out_topic, name);
    let kind = if ros.enable_stamped_cmd_vel { keys::TWIST_STAMPED } else { keys::TWIST };
    let full = key(ros.domain, &to, &kind, ros.ros_distro);
    let shown = tokens(ros.domain, &net.name(), &format!("{NODE}_{name}"), 1, End::Publisher, &to, &full);
    let shown = shown.into_iter().map(|token| net.token(token)).collect::<Result<_, _>>()?;
    let out = net.out_at(full)?;
    let (stamped, frame) = (ros.enable_stamped_cmd_vel, ros.base_frame_id.clone());
    // What names the publisher must differ from all others: the session's name is drawn at random.
    let publisher = crate::wire::envelope::hash(net.name().as_bytes());
    let mut sequence = 0;
    let drive = move |_: Instant, velocity: &Twist| {
        sequence += 1;
        let nanos = wall_nanos();
        let bytes = if stamped { twist_stamped(nanos, &frame, velocity) } else { twist(velocity) };
        send_with(&out, bytes, &attachment(sequence, nanos, &publisher));
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
    let kind = match ros.pose_type {
        PoseType::Odometry => keys::ODOMETRY,
        PoseType::Pose => keys::POSE_STAMPED,
    };
    let ears = roster.robots().iter().map(|entry| {
        let full = key(ros.domain, &topic(&ros.pose_topic, &entry.name), &kind, ros.ros_distro);
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
    let kind = if ros.enable_stamped_cmd_vel { keys::TWIST_STAMPED } else { keys::TWIST };
    let full = key(ros.domain, &topic(pattern, name_of(roster, id)), &kind, ros.ros_distro);
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
