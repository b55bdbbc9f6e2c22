//! One robot of the core in a process of its own, on a network that loses things, among processes that lie.
//!
//! Nothing but [`session`] knows Zenoh, nothing but [`clock`] reads a clock, and nothing but the program prints. The rest is pure:
//! bytes and times are arguments.
//!
//! | module | is |
//! | --- | --- |
//! | [`identity`] | keys, the signed roster, the number of starts |
//! | [`wire`], [`gate`] | what is signed, every check, and who is caught with proof |
//! | [`node`] | one robot: its state machine, its loop in real time, how it speaks |
//! | [`plant`] | where a robot is and how it moves: a simulated plant, a recording |
//! | [`ros`] | the wire form of ROS 2, without ROS |
//! | [`relay`], [`fleet`] | a bad network, and a whole team on one machine |
//! | [`config`], [`scenarios`], [`commands`] | files, and what the program does |

pub mod bytes;
pub mod clock;
pub mod commands;
pub mod config;
pub mod fleet;
pub mod gate;
pub mod identity;
pub mod node;
pub mod plant;
pub mod relay;
pub mod ros;
pub mod scenarios;
pub mod session;
pub mod signals;
pub mod wire;

#[cfg(test)]
mod testing;
