//! Progress on standard error, for people only, and the clock of `--time-limit`.

use core::fmt::Write;
use core::ops::ControlFlow;
use core::time::Duration;
use std::time::Instant;

use closeranks_graph::effort::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

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

/// A bar of `length` runs of which `done` are there, with the rate.
pub(crate) fn runs(length: u64, done: u64, quiet: bool) -> ProgressBar {
    let bar = bar(length, quiet);
    let style =
        ProgressStyle::with_template("{pos}/{len} runs [{bar:32}] {percent:>3} % {rate:>14} {eta:>6} left");
    let rate = |state: &ProgressState, out: &mut dyn Write| {
        let _ = write!(out, "{:.1} runs/s", state.per_sec());
    };
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar()).with_key("rate", rate);
    bar.set_style(style.progress_chars("=> "));
    bar.set_position(done);
    bar.reset_eta();
    bar
}

/// Runs `work` and says how long it took.
pub(crate) fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    #[expect(clippy::disallowed_methods, reason = "the time taken is told to people and never used in a run")]
    let start = Instant::now();
    let result = work();
    (result, start.elapsed())
}

/// Processor time of this program so far, all threads together; where it cannot be asked for, the time since `start`.
///
/// A time limit decides how much is proved, never what.
fn processor_s(start: Instant) -> f64 {
    #[cfg(unix)]
    {
        let _ = start;
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
        Duration::try_from(time).unwrap_or_default().as_secs_f64()
    }
    #[cfg(not(unix))]
    {
        start.elapsed().as_secs_f64()
    }
}

/// Searches shorter than this show no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// Watches a search of unknown length: stops it at the time limit, and shows how much of the time is spent.
#[derive(Debug)]
pub(crate) struct Watch {
    start: Instant,
    processor_s: f64,
    threads: f64,
    limit_s: f64,
    quiet: bool,
    bar: Option<ProgressBar>,
}

impl Watch {
    /// Starts now and ends after `limit_s` seconds of processor time on each of `threads` threads.
    pub(crate) fn new(limit_s: f64, threads: usize, quiet: bool) -> Self {
        #[expect(clippy::disallowed_methods, reason = "it is shown to people, and decides nothing")]
        let start = Instant::now();
        let threads = f64::from(u32::try_from(threads).unwrap_or(1).max(1));
        Self { start, processor_s: processor_s(start), threads, limit_s, quiet, bar: None }
    }

    /// To be called every few milliseconds; `Break` when the time is up.
    pub(crate) fn look(&mut self, progress: &Progress) -> ControlFlow<()> {
        let spent = self.start.elapsed();
        let worked_s = (processor_s(self.start) - self.processor_s) / self.threads;
        if spent > PATIENCE && !self.quiet {
            self.show(Duration::try_from_secs_f64(worked_s).unwrap_or_default(), progress);
        }
        if worked_s >= self.limit_s { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn show(&mut self, spent: Duration, progress: &Progress) {
        let limit_ms = Duration::try_from_secs_f64(self.limit_s).unwrap_or(Duration::MAX).as_millis();
        let limit_ms = u64::try_from(limit_ms).unwrap_or(u64::MAX);
        let bar = self.bar.get_or_insert_with(|| {
            let bar = ProgressBar::with_draw_target(Some(limit_ms), ProgressDrawTarget::stderr());
            let bar = bar.with_elapsed(spent);
            let style = ProgressStyle::with_template("{msg:44} [{bar:24}] {elapsed} of the time limit");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("=> "));
            bar
        });
        bar.set_message(format!("({},{})-robust? {} sets tried", progress.r, progress.s, progress.nodes));
        bar.set_position(u64::try_from(spent.as_millis()).unwrap_or(u64::MAX).min(limit_ms));
    }

    /// Takes the bar away.
    pub(crate) fn finish(self) {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
    }
}
