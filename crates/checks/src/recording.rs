//! Parquet files that say they are recorded runs.

use closeranks_graph::graph::set::NODE_LIMIT;
use closeranks_report::recording::read;

/// Any bytes are a recording of whole ticks, or an error that says why not.
pub fn recording(bytes: &[u8]) {
    match read(bytes.to_vec()) {
        Ok(run) => {
            assert!((1..=NODE_LIMIT).contains(&run.robots) && run.ticks() >= 1);
            assert_eq!(run.positions_m.len(), run.ticks() * run.robots);
            assert!((0..run.ticks()).all(|tick| run.at(tick).len() == run.robots));
            assert!(run.at(run.ticks()).is_empty());
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
