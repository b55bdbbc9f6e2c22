//! What computes the robots of a tick: one by one, or all at once with the same bits.

pub mod allies;
mod consensus;
pub mod fleet;
pub(crate) mod judge;
pub mod memory;
pub(crate) mod robots;
pub mod team;
mod ties;
