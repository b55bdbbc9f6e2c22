//! What people look at: figures as SVG and PNG, tables, claims, Parquet files and one self-contained page.
//!
//! Everything is made in memory; only the caller writes files.
//!
//! | what | where |
//! | --- | --- |
//! | the paper's figures, and one for a single run | [`figure`] |
//! | a graph with its witness | [`network`] |
//! | robustness over time, and the recording it comes from | [`robustness`], [`recording`] |
//! | one self-contained page, and what is on it | [`html`], [`content`] |
//! | sweeps: rows, counts, bounds, figures | [`sweep`] |
//! | SVG to PNG | [`png`] |
//! | the table of runs, and the paper's sentences held against them | [`table`], [`claims`] |
//! | a record as a file | [`parquet`] |
//! | exact robustness over time, as figure and file | [`robustness`] |

pub mod claims;
pub mod content;
pub mod figure;
pub mod html;
pub mod network;
pub mod parquet;
pub mod png;
pub mod recording;
pub mod robustness;
pub mod sweep;
pub mod table;

mod axes;
mod columns;
mod formation;
mod layout;
mod legend;
mod links;
mod network_layout;
mod network_mark;
mod palette;
mod path;
mod series;
mod svg;
mod text;
mod ticks;
mod title;
mod trace;
