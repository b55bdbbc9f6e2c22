//! Formats with a head or a list of nodes before the edges.

pub(super) mod dimacs;
pub(super) mod leda;
pub(super) mod pajek;
pub(super) mod tgf;
