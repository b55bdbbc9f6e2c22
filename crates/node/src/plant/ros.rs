//! A robot whose pose and whose velocity are topics of ROS 2.
//!
//! Poses of the robot and of the others come as they come, all in one frame of the world. At the beginning of each tick those that are
//! not too old are what the robot sees. Between their measurement and the tick bodies move on, so the errors stated in the settings
//! must cover the speed times the age.

use core::time::Duration;
use std::sync::{Arc, Mutex, PoisonError};

use closeranks_core::{Instant, RobotId};

use crate::clock::tick;
use crate::plant::PlantPort;
use crate::ros::frame::Base;
use crate::ros::messages::{Pose, Twist, read_odometry, read_pose_stamped};
use crate::wire::sensed::Sensed;

/// The robot's own pose and when it came, for whoever must turn velocities of the body.
pub type Own = Arc<Mutex<Option<(Instant, Pose)>>>;

/// Takes the velocity of a base.
pub type Drive = Box<dyn FnMut(Instant, &Twist) + Send>;

/// What is needed to make poses of bytes.
#[derive(Clone, Debug)]
pub struct Source {
    /// True for `nav_msgs/Odometry`, false for `geometry_msgs/PoseStamped`.
    pub odometry: bool,
    /// The frame that all poses must be in.
    pub frame: String,
    /// Older poses are not seen; 0 switches this off.
    pub timeout: Duration,
    /// How the base moves.
    pub base: Base,
}

/// The poses of a team, and the way to one base.
pub struct Ros<const D: usize> {
    id: RobotId,
    source: Source,
    period: Duration,
    poses: Vec<Option<(Instant, Pose)>>,
    own: Own,
    next: Instant,
    base: Drive,
    refused: u64,
}

impl<const D: usize> Ros<D> {
    /// For robot `id` of so many, which ticks every `period`. Velocities of the base are given to `base`.
    #[must_use]
    pub fn new(id: RobotId, robots: u16, source: Source, period: Duration, base: Drive) -> Self {
        let poses = vec![None; usize::from(robots)];
        Self { id, source, period, poses, own: Own::default(), next: Instant::START, base, refused: 0 }
    }

    /// Where the own pose is kept.
    #[must_use]
    pub fn own(&self) -> Own {
        Arc::clone(&self.own)
    }

    /// How many messages were no poses, or in another frame.
    #[must_use]
    pub fn refused(&self) -> u64 {
        self.refused
    }

    fn fresh(&self, now: Instant, id: RobotId) -> Option<Pose> {
        let (at, pose) = self.poses.get(usize::from(id.0).checked_sub(1)?)?.as_ref()?;
        let young = self.source.timeout.is_zero() || now.since(*at) <= self.source.timeout;
        young.then_some(*pose)
    }

    fn point(&self, pose: &Pose) -> [f64; D] {
        let point_m = self.source.base.point_m(pose);
        core::array::from_fn(|axis| point_m.get(axis).copied().unwrap_or(0.0))
    }
}

impl<const D: usize> PlantPort<D> for Ros<D> {
    fn arrived(&mut self, now: Instant, from: RobotId, bytes: &[u8]) {
        let read = if self.source.odometry { read_odometry(bytes) } else { read_pose_stamped(bytes) };
        let pose = read.filter(|(frame, _)| *frame == self.source.frame).map(|(_, pose)| (now, pose));
        let place = usize::from(from.0).checked_sub(1).and_then(|index| self.poses.get_mut(index));
        let (Some(place), Some(pose)) = (place, pose) else { return self.refused += 1 };
        *place = Some(pose);
        if from == self.id {
            *self.own.lock().unwrap_or_else(PoisonError::into_inner) = Some(pose);
        }
    }

    fn sensed(&mut self, now: Instant) -> Option<Sensed<D>> {
        if now < self.next {
            return None;
        }
        let at = tick(now, self.period);
        self.next = at.after(self.period);
        let own_m = self.point(&self.fresh(now, self.id)?);
        let ids = (1..).map(RobotId).take(self.poses.len()).filter(|id| *id != self.id);
        let others = ids.filter_map(|id| Some((id, self.point(&self.fresh(now, id)?)))).collect();
        Some(Sensed { at, own_m, others })
    }

    fn next_at(&self) -> Option<Instant> {
        Some(self.next)
    }

    /// A velocity needs the pose that it is turned by. A stop needs nothing and is always sent.
    fn drive(&mut self, now: Instant, velocity_m_s: &[f64; D]) {
        let velocity_m_s: [f64; 3] =
            core::array::from_fn(|axis| velocity_m_s.get(axis).copied().unwrap_or(0.0));
        let twist = self.fresh(now, self.id).map(|pose| self.source.base.twist(&pose, &velocity_m_s));
        (self.base)(now, &twist.unwrap_or_default());
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use super::*;
    use closeranks_mcap::cdr::Writer;

    fn pose(frame: &str, x: f64) -> Vec<u8> {
        let mut writer = Writer::default();
        writer.header(0, frame);
        writer.doubles(&[x, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        writer.end()
    }

    #[test]
    fn poses_are_seen_while_they_are_young_and_a_stop_is_always_sent() {
        let at = |ms: u64| Instant::from_nanos(ms * 1_000_000);
        let (base, timeout) = (Base::Holonomic, Duration::from_millis(200));
        let source = Source { odometry: false, frame: "map".into(), timeout, base };
        let (send, driven) = channel();
        let drive = Box::new(move |_, twist: &Twist| send.send(twist.linear_m_s[0]).unwrap());
        let mut port = Ros::<2>::new(RobotId(1), 3, source, Duration::from_millis(50), drive);
        assert!(port.sensed(at(0)).is_none(), "nobody knows where it is");
        port.arrived(at(40), RobotId(1), &pose("map", 1.0));
        port.arrived(at(40), RobotId(3), &pose("map", 2.0));
        for (from, frame) in [(2, "odom"), (0, "map"), (4, "map")] {
            port.arrived(at(40), RobotId(from), &pose(frame, 9.0));
        }
        port.arrived(at(40), RobotId(2), b"junk");
        assert_eq!(port.refused(), 4);
        let seen = port.sensed(at(55)).unwrap();
        assert_eq!((seen.at, seen.own_m, seen.others), (at(50), [1.0, 0.0], vec![(RobotId(3), [2.0, 0.0])]));
        assert!(port.sensed(at(60)).is_none(), "once a tick");
        port.drive(at(60), &[0.5, 0.0]);
        port.drive(at(300), &[0.5, 0.0]);
        assert_eq!(driven.try_iter().collect::<Vec<_>>(), [0.5, 0.0], "a base that is lost stops");
        assert!(port.sensed(at(300)).is_none());
    }
}
