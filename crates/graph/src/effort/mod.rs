//! How much work a question may cost, and who may stop it.

pub mod workers;

use core::fmt;
use core::ops::ControlFlow;

use workers::Workers;

/// Nodes between two calls of the progress callback.
const REPORT_EVERY: u64 = 1 << 12;

/// How much work a question may cost. No clock: whoever has one may stop the work through the callback of [`Meter`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Nodes of the search tree that may be visited (of order one microsecond each).
    /// The table of subsets counts as one node per 256 subsets, which takes about as long.
    pub nodes: u64,
    /// Memory that the table of subsets may take, bytes; it needs 2ⁿ. Zero means branch and bound only.
    pub table_bytes: u64,
}

impl Effort {
    /// No limit on nodes, and a table of at most 64 MiB (n ≤ 26).
    pub const UNLIMITED: Self = Self { nodes: u64::MAX, table_bytes: 1 << 26 };
}

/// What the callback is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// The r of the question now asked.
    pub r: usize,
    /// The s of the question now asked.
    pub s: usize,
    /// Nodes visited so far, over all questions.
    pub nodes: u64,
}

/// The work was stopped before the answer, by the effort or by the callback.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stopped;

/// Counts the work, and asks the callback every few thousand nodes whether to go on.
pub struct Meter<'a> {
    limit: u64,
    next_report: u64,
    told_to_stop: bool,
    progress: Progress,
    report: &'a mut dyn FnMut(&Progress) -> ControlFlow<()>,
    workers: Option<&'a dyn Workers>,
}

impl fmt::Debug for Meter<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Meter({:?}, at most {})", self.progress, self.limit)
    }
}

impl<'a> Meter<'a> {
    /// A meter that allows `nodes` nodes and stops when `report` answers `Break`.
    pub fn new(nodes: u64, report: &'a mut dyn FnMut(&Progress) -> ControlFlow<()>) -> Self {
        let progress = Progress { r: 0, s: 0, nodes: 0 };
        Self { limit: nodes, next_report: REPORT_EVERY, told_to_stop: false, progress, report, workers: None }
    }

    /// Lends threads to searches that are long. Answers and counts stay what they are.
    #[must_use]
    pub fn with_workers(mut self, workers: &'a dyn Workers) -> Self {
        self.workers = Some(workers);
        self
    }

    /// The threads, if there is more than one.
    pub(crate) fn workers(&self) -> Option<&'a dyn Workers> {
        self.workers.filter(|workers| workers.count() > 1)
    }

    /// Nodes that may still be counted.
    pub(crate) fn left(&self) -> u64 {
        self.limit - self.progress.nodes
    }

    /// Asks the callback out of turn, with `more` nodes that are visited and not yet counted. True: go on.
    pub(crate) fn look(&mut self, more: u64) -> bool {
        let progress = Progress { nodes: self.progress.nodes.saturating_add(more), ..self.progress };
        self.told_to_stop |= (self.report)(&progress).is_break();
        !self.told_to_stop
    }

    /// Counts what is left, after which nothing may be spent.
    pub(crate) fn exhaust(&mut self) {
        self.progress.nodes = self.limit;
    }

    /// Nodes counted so far.
    #[must_use]
    pub fn nodes(&self) -> u64 {
        self.progress.nodes
    }

    /// Tells the callback what is asked from now on.
    pub(crate) fn ask(&mut self, r: usize, s: usize) {
        (self.progress.r, self.progress.s) = (r, s);
    }

    /// Does `work` with at most `nodes` more nodes. `Ok(None)`: they were not enough, but the effort may be.
    pub(crate) fn within<T>(
        &mut self,
        nodes: u64,
        work: impl FnOnce(&mut Self) -> Result<T, Stopped>,
    ) -> Result<Option<T>, Stopped> {
        let limit = self.limit;
        self.limit = self.progress.nodes.saturating_add(nodes).min(limit);
        let mine = self.limit < limit;
        let outcome = work(self);
        let mine = mine && !self.told_to_stop;
        self.limit = limit;
        match outcome {
            Ok(found) => Ok(Some(found)),
            Err(Stopped) if mine => Ok(None),
            Err(Stopped) => Err(Stopped),
        }
    }

    /// Counts `nodes` nodes.
    pub(crate) fn spend(&mut self, nodes: u64) -> Result<(), Stopped> {
        let spent = self.progress.nodes.saturating_add(nodes);
        if self.told_to_stop || spent > self.limit {
            return Err(Stopped);
        }
        self.progress.nodes = spent;
        if self.progress.nodes < self.next_report {
            return Ok(());
        }
        self.next_report = self.progress.nodes + REPORT_EVERY;
        match (self.report)(&self.progress) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => {
                self.told_to_stop = true;
                Err(Stopped)
            }
        }
    }
}
