//! What computes the robots of a tick: one by one, or all at once with the same bits.

mod consensus;
pub mod fleet;
pub(crate) mod judge;
mod links;
pub mod memory;
mod near;
pub(crate) mod robots;
mod sees;
pub mod team;
