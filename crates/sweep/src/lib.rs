//! Sweeps: thousands of runs of one text with draws, one row each, in blocks that are there whole or not at all.
//!
//! | what | where |
//! | --- | --- |
//! | what decides the rows | [`manifest`] |
//! | which runs are a shard's, and in which blocks they are done | [`shard`], [`array`](mod@array) |
//! | the rows of a block, and blocks as files | [`block`] |
//! | the folder of a sweep: locked, resumable | [`store`] |
//! | running what is left, on all cores | [`work`] |
//! | what is open in folders | [`status`] |
//! | shards put together | [`merge`] |
//! | what a sweep came to | [`outcome`] |

pub mod array;
pub mod block;
pub mod manifest;
pub mod merge;
pub mod outcome;
pub mod shard;
pub mod status;
pub mod store;
pub mod work;

use closeranks_report::numbers::Program;

/// What made the rows. Both programs that do sweeps are built from the same sources and say the same.
pub const PROGRAM: Program<'static> =
    Program { version: env!("CARGO_PKG_VERSION"), commit: env!("CLOSERANKS_COMMIT") };

/// The same for people.
pub const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), " (", env!("CLOSERANKS_COMMIT"), ")");
