//! The equations of the paper, each with its value and its gradient in one function.

pub mod barrier;
pub mod composition;
pub mod lanes;
pub mod link;
mod scaling;
