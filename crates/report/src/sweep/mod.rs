//! Sweeps: one row a run and controller, what they come to, and its figures.
//!
//! | what | where |
//! | --- | --- |
//! | which columns there are, and a run as a row | [`entry`] |
//! | rows in memory, and as Parquet | [`rows`], [`mod@file`] |
//! | counts over all rows, and the distribution of radii | [`tally`], [`spread`] |
//! | what a share of runs proves | [`confidence`] |
//! | tables and figures | [`tables`], [`figure`] |

pub mod broken;
pub mod confidence;
pub mod entry;
pub mod figure;
pub mod file;
pub mod rows;
pub mod spread;
mod style;
pub mod tables;
pub mod tally;
