//! What a run leaves behind: every tick in columns, and one row of a table.

pub mod record;
pub mod summary;
