//! Threads for a large team and for a long search: the simulator and the graphs have none of their own.

use core::time::Duration;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;

use closeranks_graph::workers as graph;
use closeranks_sim::engine::workers::{Piece, Workers};

/// Runs each piece on a thread of its own, but for the last.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Threads {
    count: usize,
}

impl Threads {
    /// As many as there are processors.
    pub(crate) fn all() -> Self {
        Self::of(thread::available_parallelism().map_or(1, usize::from))
    }

    /// So many, 1 or more.
    pub(crate) fn of(count: usize) -> Self {
        Self { count: count.max(1) }
    }

    /// How many.
    pub(crate) fn count(self) -> usize {
        self.count
    }
}

impl Workers for Threads {
    fn count(&self) -> usize {
        self.count
    }

    fn run(&self, mut pieces: Vec<Piece<'_>>) {
        let last = pieces.pop();
        thread::scope(|scope| {
            for piece in pieces {
                scope.spawn(piece);
            }
            if let Some(piece) = last {
                piece();
            }
        });
    }
}

/// How often whoever waits for a search is asked whether to go on.
const LOOK_EVERY: Duration = Duration::from_millis(20);

impl graph::Workers for Threads {
    fn count(&self) -> usize {
        self.count
    }

    fn run(&self, pieces: Vec<graph::Piece<'_>>, look: &mut dyn FnMut()) {
        let (sender, receiver) = mpsc::channel::<()>();
        thread::scope(|scope| {
            for piece in pieces {
                let running = sender.clone();
                scope.spawn(move || {
                    piece();
                    drop(running);
                });
            }
            drop(sender);
            // Nothing is ever sent: the channel closes when the last piece has ended.
            while receiver.recv_timeout(LOOK_EVERY) == Err(RecvTimeoutError::Timeout) {
                look();
            }
        });
    }
}
