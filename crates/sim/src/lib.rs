//! The deterministic world in which robots of [`closeranks_core`] live.
//!
//! A run is a pure function of scenario, seed and commit: the same bits on every target and for every number of
//! threads. Nothing here reads a file, a clock or a socket.
//!
//! One tick: sense → share → tick every robot → watch → record → integrate. In the perfect network what is shared in a
//! tick is used in that tick. Liars wrap the network; a robot never knows.
//!
//! | what | where |
//! | --- | --- |
//! | what to run, and the TOML it is written in | [`scenario`], [`parse`] |
//! | many scenarios out of one text with draws | [`sweep`] |
//! | where robots start and want to go | [`scenario::start`], [`scenario::desired`] |
//! | what malicious robots tell | [`attack`], [`attack::liars`] |
//! | what goes wrong with messages, clocks, sensors and the robots themselves | [`faults`] |
//! | how bodies follow velocities | [`plant`] |
//! | what carries messages | [`transport`] |
//! | what is possible for a team: starts, speeds, F | [`advice`] |
//! | how a team agrees: rules, and values of several numbers | [`consensus`] |
//! | all robots of a tick, one by one or as a team | [`engine`] |
//! | the theorems as code, and exact robustness round by round | [`law`], [`monitors`] |
//! | the run, its record and its table row | [`world`], [`output`] |

pub mod advice;
pub mod attack;
pub mod consensus;
pub mod controllers;
pub mod engine;
pub mod faults;
pub mod frame;
pub mod geometry;
pub mod law;
pub mod monitors;
pub mod output;
pub mod parse;
pub mod plant;
pub mod random;
pub mod scenario;
pub mod sweep;
pub mod transport;
pub mod world;
