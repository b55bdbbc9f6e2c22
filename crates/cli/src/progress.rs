//! Progress on standard error, for people only.

use core::time::Duration;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};

/// A bar of `length` steps; nothing is drawn when quiet or when standard error is not a terminal.
pub(crate) fn bar(length: u64, quiet: bool) -> ProgressBar {
    if quiet {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(length);
    let style = ProgressStyle::with_template("{msg:24} [{bar:32}] {percent:>3} % {eta:>6} left");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("=> "));
    bar
}

/// Runs `work` and says how long it took.
pub(crate) fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    #[expect(clippy::disallowed_methods, reason = "the time taken is told to people and never used in a run")]
    let start = Instant::now();
    let result = work();
    (result, start.elapsed())
}
