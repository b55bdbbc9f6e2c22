//! The controllers: what stands between the desired and the safe velocity.

pub mod budget;
