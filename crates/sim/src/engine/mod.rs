//! What computes the robots of a tick: one by one, or all at once with the same bits.

mod consensus;
pub mod fleet;
mod links;
pub mod memory;
mod near;
mod sees;
pub mod team;
