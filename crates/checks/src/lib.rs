//! What must hold for any bytes. Each function takes bytes and panics if a promise is broken.
//!
//! `cargo test` runs them on the files of `fuzz/corpus` and on mutations of those; the targets of `fuzz/` let libFuzzer
//! look for new ones. No files, clocks or random numbers here: the bytes are all the input there is.

#![allow(clippy::missing_panics_doc, reason = "to panic is how a check says no")]

mod certificate;
mod graph;
mod message;
#[cfg(feature = "recording")]
mod recording;
mod robot;
mod scenario;
mod source;

pub use certificate::certificate;
pub use graph::{graph, graph_as, graph_text};
pub use message::{link_message, message};
#[cfg(feature = "recording")]
pub use recording::recording;
pub use robot::robot;
pub use scenario::{scenario, scenario_text};
