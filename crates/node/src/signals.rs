//! SIGINT and SIGTERM.

use core::sync::atomic::{AtomicBool, Ordering};
use std::sync::Arc;

/// Lets `stop` become true when the user or the system asks the process to stop. Until this is called, they end it at once.
pub fn stop_on_signals(stop: &Arc<AtomicBool>) -> Result<(), ctrlc::Error> {
    let flag = Arc::clone(stop);
    ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed))
}
