//! The messages of ROS 2 about one tick, as bytes.

use closeranks_sim::output::record::outcome_name;
use closeranks_sim::output::snapshot::Snapshot;

use crate::cdr::Writer;

/// The frame of all positions.
pub(crate) const MAP: &str = "map";
/// No rotation: robots are points.
const NO_ROTATION: [f64; 4] = [0.0, 0.0, 0.0, 1.0];
/// The numbers of a covariance, all 0: nothing is claimed.
const COVARIANCE: [f64; 36] = [0.0; 36];

/// The frame and the beginning of the topics of robot `index`.
pub(crate) fn name(index: usize) -> String {
    format!("robot_{}", index + 1)
}

/// A message that begins with the header of the map.
fn headed(time_ns: u64) -> Writer {
    let mut writer = Writer::default();
    writer.header(time_ns, MAP);
    writer
}

/// `geometry_msgs/Pose` without rotation.
pub(crate) fn pose(writer: &mut Writer, position_m: &[f64; 3]) {
    writer.doubles(position_m);
    writer.doubles(&NO_ROTATION);
}

fn twist(writer: &mut Writer, velocity_m_s: &[f64; 3]) {
    writer.doubles(velocity_m_s);
    writer.doubles(&[0.0; 3]);
}

/// `tf2_msgs/TFMessage`: where all robots are.
pub(crate) fn transforms(now: &Snapshot<'_>, time_ns: u64) -> Vec<u8> {
    let mut writer = Writer::default();
    writer.count(now.robots());
    for index in 0..now.robots() {
        writer.header(time_ns, MAP);
        writer.text(&name(index));
        pose(&mut writer, &now.vector(now.positions_m, index));
    }
    writer.end()
}

/// `geometry_msgs/PoseStamped`.
pub(crate) fn pose_stamped(now: &Snapshot<'_>, time_ns: u64, index: usize) -> Vec<u8> {
    let mut writer = headed(time_ns);
    pose(&mut writer, &now.vector(now.positions_m, index));
    writer.end()
}

/// `nav_msgs/Odometry`. Robots do not turn, so the axes of the body are those of the map.
pub(crate) fn odometry(now: &Snapshot<'_>, time_ns: u64, index: usize) -> Vec<u8> {
    let mut writer = headed(time_ns);
    writer.text(&name(index));
    pose(&mut writer, &now.vector(now.positions_m, index));
    writer.doubles(&COVARIANCE);
    twist(&mut writer, &now.vector(now.inputs_m_s, index));
    writer.doubles(&COVARIANCE);
    writer.end()
}

/// `geometry_msgs/TwistStamped` of one of the flat velocities of a tick.
pub(crate) fn twist_stamped(now: &Snapshot<'_>, time_ns: u64, flat: &[f64], index: usize) -> Vec<u8> {
    let mut writer = headed(time_ns);
    twist(&mut writer, &now.vector(flat, index));
    writer.end()
}

/// `closeranks_msgs/RobotState`.
pub(crate) fn state(now: &Snapshot<'_>, time_ns: u64, index: usize, malicious: bool) -> Vec<u8> {
    let mut writer = headed(time_ns);
    writer.word(now.tick);
    writer.short(u16::try_from(index + 1).unwrap_or(u16::MAX));
    writer.byte(u8::from(malicious));
    writer.byte(u8::from(now.down[index]));
    writer.short(now.degree[index]);
    writer.short(now.required_degree);
    writer.doubles(&[now.level[index], now.told(index), now.h(index), now.phi[index], now.value[index]]);
    writer.doubles(&[now.value_told(index), now.degree_sensed(index), now.level_sensed(index)]);
    writer.text(outcome_name(now.outcome[index]));
    writer.text(now.modes[index].name());
    writer.end()
}
