//! What monitors keep of the tick before.

use closeranks_core::num::Vector;

use crate::monitors::truth::Truth;

/// The tick before this one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Before<const D: usize> {
    pub(crate) truth: Truth,
    pub(crate) positions_m: Vec<Vector<D>>,
    /// Moves obey the rows, and rows rest on what is true.
    pub(crate) moves: bool,
    /// Robots are where they think, and move as they decide: all that keeping clear of obstacles rests on.
    pub(crate) clear: bool,
    /// They do so for so long that every level in use is one that was told since.
    pub(crate) settled: bool,
}
