//! Who computes a tick: this crate has no threads, but whoever runs a world may lend it some.

/// A piece of a tick. Pieces that are run together do not depend on each other.
pub type Piece<'a> = Box<dyn FnOnce() + Send + 'a>;

/// Runs pieces of a tick, some at a time or one after another. No bit of a run depends on it.
pub trait Workers: core::fmt::Debug + Send + Sync {
    /// How many pieces it runs at a time, at least 1: a large team is cut into so many.
    fn count(&self) -> usize;

    /// Runs every piece once, and returns when all are done.
    fn run(&self, pieces: Vec<Piece<'_>>);
}

/// Runs all pieces where it is called.
#[derive(Clone, Copy, Debug, Default)]
pub struct Alone;

impl Workers for Alone {
    fn count(&self) -> usize {
        1
    }

    fn run(&self, pieces: Vec<Piece<'_>>) {
        for piece in pieces {
            piece();
        }
    }
}

/// Teams below this are computed in one piece: to hand over pieces would cost more.
pub(crate) const LARGE: usize = 500;

/// How many robots each piece of a team of so many has.
pub(crate) fn share(robots: usize, workers: &dyn Workers) -> usize {
    if robots < LARGE { robots.max(1) } else { robots.div_ceil(workers.count().max(1)) }
}
