//! The topics of a robot in ROS 2, as its file names them.

use serde::{Deserialize, Serialize};

use crate::ros::keys::{Distro, Form};

/// The topics of a robot in ROS 2. `{name}` stands for the name of a robot in the roster.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Ros2 {
    /// ROS_DOMAIN_ID.
    pub domain: u16,
    /// `humble`, `jazzy` or `kilted`: Humble's keys have no hashes of types.
    pub ros_distro: Distro,
    /// `rmw_zenoh`, or `ros2dds` behind a bridge to DDS, `zenoh-plugin-ros2dds`.
    pub keys: Form,
    /// Where the pose of each robot is; all in one frame.
    pub pose_topic: String,
    /// `odometry` or `pose`: the type on that topic.
    pub pose_type: PoseType,
    /// The frame of all poses.
    pub frame: String,
    /// Older poses are not seen, s; 0 switches this off. Left out: `source_timeout_s` of the robot.
    pub source_timeout: Option<f64>,
    /// Where the velocity of the base goes.
    pub cmd_vel_out_topic: String,
    /// `TwistStamped` and not `Twist`, in and out.
    pub enable_stamped_cmd_vel: bool,
    /// Where diagnoses go, for the tools of ROS 2.
    pub diagnostics_topic: String,
    /// Where links, mode and degree go to be drawn.
    pub markers_topic: String,
    /// The frame of that velocity.
    pub base_frame_id: String,
    /// For bases that drive forward and turn: how far ahead of the axle the point is that is steered, m. Left out for bases that move
    /// in every direction.
    pub look_ahead_m: Option<f64>,
}

/// A type with a pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PoseType {
    /// `nav_msgs/Odometry`.
    Odometry,
    /// `geometry_msgs/PoseStamped`.
    Pose,
}

impl Default for Ros2 {
    fn default() -> Self {
        Self {
            domain: 0,
            ros_distro: Distro::default(),
            keys: Form::default(),
            pose_topic: "{name}/odom".into(),
            pose_type: PoseType::Odometry,
            frame: "map".into(),
            source_timeout: None,
            cmd_vel_out_topic: "{name}/cmd_vel".into(),
            enable_stamped_cmd_vel: true,
            diagnostics_topic: "diagnostics".into(),
            markers_topic: "{name}/closeranks_markers".into(),
            base_frame_id: "base_link".into(),
            look_ahead_m: None,
        }
    }
}
