//! The messages of ROS 2 that a robot reads and writes: where it is, and how it is to move.

use closeranks_mcap::cdr::{Reader, Writer};

/// A position, m, and an orientation as a unit quaternion (x, y, z, w), in a frame of the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// x, y, z, m.
    pub position_m: [f64; 3],
    /// x, y, z, w.
    pub orientation: [f64; 4],
}

/// A velocity along the axes of a body, and how fast the body turns about them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Twist {
    /// Forward, to the left, up, m/s.
    pub linear_m_s: [f64; 3],
    /// About the same axes, rad/s.
    pub angular_rad_s: [f64; 3],
}

fn three(reader: &mut Reader<'_>) -> Option<[f64; 3]> {
    Some([reader.finite()?, reader.finite()?, reader.finite()?])
}

fn pose(reader: &mut Reader<'_>) -> Option<Pose> {
    let position_m = three(reader)?;
    let orientation = [reader.finite()?, reader.finite()?, reader.finite()?, reader.finite()?];
    let square: f64 = orientation.iter().map(|part| part * part).sum();
    // Drivers round; anything farther from 1 is no rotation.
    ((square - 1.0).abs() < 1e-3).then_some(Pose { position_m, orientation })
}

/// The pose in a `geometry_msgs/PoseStamped`, and its frame.
#[must_use]
pub fn read_pose_stamped(bytes: &[u8]) -> Option<(&str, Pose)> {
    let mut reader = Reader::new(bytes)?;
    let frame = reader.header()?;
    let pose = pose(&mut reader)?;
    reader.end()?;
    Some((frame, pose))
}

/// The pose in a `nav_msgs/Odometry`, and its frame.
#[must_use]
pub fn read_odometry(bytes: &[u8]) -> Option<(&str, Pose)> {
    let mut reader = Reader::new(bytes)?;
    let frame = reader.header()?;
    reader.text()?;
    let pose = pose(&mut reader)?;
    // Covariance of the pose, the velocity, and its covariance.
    reader.skip_doubles(36 + 6 + 36)?;
    reader.end()?;
    Some((frame, pose))
}

fn write_twist(writer: &mut Writer, twist: &Twist) {
    writer.doubles(&twist.linear_m_s);
    writer.doubles(&twist.angular_rad_s);
}

/// The bytes of a `geometry_msgs/Twist`.
#[must_use]
pub fn twist(twist: &Twist) -> Vec<u8> {
    let mut writer = Writer::default();
    write_twist(&mut writer, twist);
    writer.end()
}

/// The bytes of a `geometry_msgs/TwistStamped` in `frame`, at `nanos` since 1970.
#[must_use]
pub fn twist_stamped(nanos: u64, frame: &str, twist: &Twist) -> Vec<u8> {
    let mut writer = Writer::default();
    writer.header(nanos, frame);
    write_twist(&mut writer, twist);
    writer.end()
}

/// The velocity in a `geometry_msgs/Twist` or, if it is `stamped`, a `TwistStamped`. NaN and infinities are refused.
#[must_use]
pub fn read_twist(bytes: &[u8], stamped: bool) -> Option<Twist> {
    let mut reader = Reader::new(bytes)?;
    if stamped {
        reader.header()?;
    }
    let (linear_m_s, angular_rad_s) = (three(&mut reader)?, three(&mut reader)?);
    reader.end()?;
    Some(Twist { linear_m_s, angular_rad_s })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn odometry(frame: &str, child: &str, pose: &Pose) -> Vec<u8> {
        let mut writer = Writer::default();
        writer.header(1_000_000_002, frame);
        writer.text(child);
        writer.doubles(&pose.position_m);
        writer.doubles(&pose.orientation);
        writer.doubles(&[0.0; 78]);
        writer.end()
    }

    const POSE: Pose = Pose { position_m: [1.0, -2.0, 0.5], orientation: [0.0, 0.0, 0.6, 0.8] };

    #[test]
    fn what_is_written_is_read() {
        for frame in ["", "map", "robot_1/odom"] {
            let bytes = odometry(frame, "base_link", &POSE);
            assert_eq!(read_odometry(&bytes), Some((frame, POSE)));
            assert_eq!(read_odometry(&bytes[..bytes.len() - 8]), None);
        }
        let moving = Twist { linear_m_s: [0.5, 0.0, 0.0], angular_rad_s: [0.0, 0.0, -1.0] };
        assert_eq!(read_twist(&twist(&moving), false), Some(moving));
        assert_eq!(read_twist(&twist_stamped(5, "base_link", &moving), true), Some(moving));
        assert_eq!(twist(&moving).len(), 52);
        let wrong = Twist { linear_m_s: [f64::NAN, 0.0, 0.0], ..moving };
        assert_eq!(read_twist(&twist(&wrong), false), None);
        let no_rotation = Pose { orientation: [0.0; 4], ..POSE };
        assert_eq!(read_odometry(&odometry("map", "b", &no_rotation)), None);
    }

    proptest! {
        #[test]
        fn any_change_gives_a_message_or_none(at in 0_usize..800, byte in any::<u8>()) {
            let mut bytes = odometry("map", "base_link", &POSE);
            let at = at % bytes.len();
            bytes[at] = byte;
            if let Some((_, pose)) = read_odometry(&bytes) {
                prop_assert!(pose.position_m.iter().chain(&pose.orientation).all(|number| number.is_finite()));
            }
            let _ = (read_pose_stamped(&bytes), read_twist(&bytes, true), read_twist(&bytes, false));
        }
    }
}
