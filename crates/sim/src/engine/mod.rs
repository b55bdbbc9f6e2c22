//! What computes the robots of a tick: one by one, or all at once with the same bits.

pub mod allies;
mod consensus;
pub mod fleet;
pub mod memory;
pub mod team;
mod ties;
