//! Recorded runs as Parquet files, written and read back, and as MCAP files for robotics tools.
//!
//! | what | where |
//! | --- | --- |
//! | a record, one row a tick and robot | [`mod@write`] |
//! | exact robustness, one row a consensus round | [`rounds`] |
//! | the messages that robots would give to ROS 2, as MCAP | [`mcap`] |
//! | what a run looked like, read back from either | [`history`] |
//! | positions, read back | [`mod@read`] |
//! | positions that others recorded | [`elsewhere`] |

pub mod elsewhere;
pub mod positions;
pub mod read;
pub mod rounds;
pub mod write;

mod columns;

pub use closeranks_mcap::{self as mcap, history};

pub use self::positions::{ReadError, Recording};
pub use self::read::read;
