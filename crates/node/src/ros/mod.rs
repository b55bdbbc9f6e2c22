//! The wire form of ROS 2 over Zenoh, as rmw_zenoh has it, without ROS: keys, attachment, tokens and the messages that a robot needs. Messages are
//! written and read with [`closeranks_mcap::cdr`].

pub mod frame;
pub mod keys;
pub mod messages;
pub mod seen;
