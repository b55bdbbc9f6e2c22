//! Edge lists of all kinds.

mod arrow;
pub(super) mod counted;
mod direction;
pub(super) mod edge_list;
mod header;
mod name;
mod rows;
pub(super) mod tuples;

pub(super) use direction::Said;
pub(super) use name::{plain, refuse_strange};
pub(super) use rows::refuse_no_weight;
