//! Recorded runs as Parquet files: written, and read back.
//!
//! | what | where |
//! | --- | --- |
//! | a record, one row a tick and robot | [`mod@write`] |
//! | exact robustness, one row a consensus round | [`rounds`] |
//! | positions, read back | [`mod@read`] |
//! | positions that others recorded | [`elsewhere`] |

pub mod elsewhere;
pub mod positions;
pub mod read;
pub mod rounds;
pub mod write;

mod columns;

pub use self::positions::{ReadError, Recording};
pub use self::read::read;
