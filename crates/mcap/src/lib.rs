//! A run as an MCAP file with messages of ROS 2, which Foxglove, Lichtblick, Rerun and `ros2 bag` open, and as lines of JSON for the page
//! ([`history`]). Simulated runs and fleets of processes are recorded alike. [`cdr`] is how messages of ROS 2 are written and read.
//!
//! Time is that of the run and begins at 0. Robots are numbered from 1, positions are in the frame `map`:
//!
//! ```text
//! /tf                    tf2_msgs/TFMessage                every tick   map → robot_1, robot_2, …
//! /robot_1/pose          geometry_msgs/PoseStamped         every tick
//! /robot_1/odom          nav_msgs/Odometry                 every tick   position and the velocity held from this tick on
//! /robot_1/cmd_vel_in    geometry_msgs/TwistStamped        every tick   what the robot is asked for
//! /robot_1/cmd_vel       geometry_msgs/TwistStamped        every tick   what its controller makes of it
//! /robot_1/state         closeranks_msgs/RobotState        every tick   degree, level, h, value, outcome, mode; see the schema
//! /markers               visualization_msgs/MarkerArray    30 a second  robots (liars are boxes), numbers, links, ranges
//! /diagnostics           diagnostic_msgs/DiagnosticArray   30 a second  mode, degree, h and value of every robot
//! ```
//!
//! The first and the last tick have everything. A run that is killed leaves a file that is whole up to its last chunk. The same run
//! gives the same bytes. Memory is bounded but for the index: some ten bytes for each chunk and topic.

mod bytes;
pub mod cdr;
mod container;
mod diagnostics;
pub mod history;
pub mod links;
mod look;
mod markers;
mod messages;
mod metadata;
mod read;
mod schemas;
mod writer;

pub use self::look::{ROBOTS_MAX, opened_by};
pub use self::metadata::Metadata;
pub use self::read::{McapError, read};
pub use self::writer::RunWriter;
