//! What a run leaves behind: every tick in columns, whole or part by part, a digest of it, and one row of a
//! table.

pub mod attendance;
pub mod conduct;
pub mod digest;
pub mod parts;
pub mod record;
pub mod snapshot;
pub mod summary;
