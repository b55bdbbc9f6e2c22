//! What a run leaves behind: every tick in columns, whole or part by part, and one row of a table.

pub mod parts;
pub mod record;
pub mod summary;
