//! What people look at: figures as SVG and PNG, tables, claims, Parquet files and one self-contained page.
//!
//! Everything is made in memory; only the caller writes files.
//!
//! | what | where |
//! | --- | --- |
//! | the paper's figures, and those of a single run | [`figure`] |
//! | a graph with its witness; exact robustness over time | [`network`], [`robustness`] |
//! | one self-contained page, and what is on it | [`html`], [`content`] |
//! | controllers side by side | [`comparison`] |
//! | the table of runs, and the paper's sentences held against them | [`table`], [`claims`] |
//! | what a run came to, in sentences and as numbers for machines | [`sentences`], [`numbers`] |
//! | what is wrong with a scenario, with its lines underlined | [`problems`] |
//! | a record as a file, and read back | [`recording`] |
//! | sweeps: rows, counts, bounds, figures | [`sweep`] |
//! | SVG to PNG | [`png`] |

pub mod figure;
pub mod recording;
pub mod sweep;

mod decoding;
mod page;
mod svg;

pub use figure::{network, robustness};
pub use page::{claims, comparison, content, html, numbers, problems, sentences, table};
pub use recording::write as parquet;
pub use svg::png;
