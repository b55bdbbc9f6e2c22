//! Exact (r,s)-robustness of graphs, with witnesses.
#![no_std]

extern crate alloc;

pub mod budget;
pub mod decide;
pub mod definition;
pub mod graph;
mod rows;
mod search;
pub mod set;
pub mod table;
mod word;
