//! Lists of nodes with their neighbours.

pub(super) mod lgl;
pub(super) mod metis;
pub(super) mod multiline;
pub(super) mod plain;
