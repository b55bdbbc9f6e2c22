//! Threads for a large team: the simulator has none of its own.

use std::thread;

use closeranks_sim::engine::workers::{Piece, Workers};

/// Runs each piece on a thread of its own, but for the last.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Threads {
    count: usize,
}

impl Threads {
    /// As many as there are processors.
    pub(crate) fn all() -> Self {
        Self { count: thread::available_parallelism().map_or(1, usize::from) }
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
