//! Exact (r,s)-robustness of graphs, with witnesses.
#![no_std]

extern crate alloc;

pub mod additions;
pub mod analysis;
pub mod bounds;
pub mod budget;
pub mod connectivity;
pub mod decide;
pub mod definition;
pub mod formats;
pub mod graph;
pub mod leaders;
mod ledger;
pub mod local;
pub mod makers;
mod rows;
pub mod search;
pub mod set;
pub mod table;
pub mod verdict;
mod word;
