//! What computes the robots of a tick: one by one, or all at once with the same bits.

mod links;
mod consensus;
pub mod fleet;
pub mod memory;
pub mod team;
mod near;
mod sees;
