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
//! | where robots start and want to go | [`start`], [`motion`] |
//! | what malicious robots tell | [`attack`], [`liars`] |
//! | what goes wrong with messages, clocks, sensors and bodies | [`faults`] |
//! | all robots of a tick, one by one or as a team | [`robots`], [`team`], [`allies`] |
//! | the theorems as code, and exact robustness round by round | [`law`], [`monitor`], [`robustness`] |
//! | the run, its record and its table row | [`world`], [`record`], [`summary`] |

pub mod allies;
pub mod attack;
mod consensus;
pub mod faults;
pub mod frame;
mod honesty;
pub mod law;
pub mod liars;
pub mod memory;
pub mod monitor;
pub mod motion;
mod pairs;
pub mod parse;
mod promise;
pub mod random;
pub mod record;
pub mod robots;
pub mod robustness;
mod scatter;
pub mod scenario;
pub mod start;
pub mod summary;
pub mod sweep;
pub mod team;
mod ties;
mod truth;
mod voices;
pub mod world;
