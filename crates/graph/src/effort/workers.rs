//! Threads that a caller may lend to a long search: this crate has none of its own.

use alloc::boxed::Box;
use alloc::vec::Vec;

/// A piece of work that may run on another thread.
pub type Piece<'a> = Box<dyn FnOnce() + Send + 'a>;

/// Whoever has threads lends them by this trait to a [`Meter`](crate::effort::Meter). How many there are changes how long an answer
/// takes, and nothing of the answer: neither the witness, nor the count of sets, nor where a limit on that count ends the search.
pub trait Workers {
    /// How many pieces run at once, 1 or more.
    fn count(&self) -> usize;

    /// Runs all pieces to their end, and until then calls `look` on the calling thread, some hundred times a second or less.
    fn run(&self, pieces: Vec<Piece<'_>>, look: &mut dyn FnMut());
}
