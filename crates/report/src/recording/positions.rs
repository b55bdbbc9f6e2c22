//! Positions of a recorded run, and why a file has none.

use closeranks_graph::graph::set::NODE_LIMIT;
use parquet::errors::ParquetError;

/// How many rows (ticks × robots) are read at most.
pub const ROWS_MAX: u64 = 20_000_000;

/// What all columns of a recording of others are called.
pub const COLUMNS: &str = "time_s or tick, robot, x_m, y_m and perhaps z_m";

/// What is needed to know who heard whom.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recording {
    /// The scenario, TOML, as the metadata of our own files have it.
    pub scenario: Option<String>,
    /// Number of robots n, `1 ..= 128`.
    pub robots: usize,
    /// Position of robot `index` at `tick` in place `tick·n + index`, m; the third is 0 in the plane.
    pub positions_m: Vec<[f64; 3]>,
    /// Of recordings of others: when, ascending.
    pub times: Vec<f64>,
    /// What the column of these times is called: `time_s` or `tick`.
    pub time_name: &'static str,
}

impl Recording {
    /// Number of ticks, both ends included.
    #[must_use]
    pub fn ticks(&self) -> usize {
        self.positions_m.len() / self.robots.max(1)
    }

    /// Where the robots are at `tick`.
    #[must_use]
    pub fn at(&self, tick: usize) -> &[[f64; 3]] {
        self.positions_m.get(tick * self.robots..(tick + 1) * self.robots).unwrap_or(&[])
    }
}

/// Why a file is no recording.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// Not Parquet, or broken.
    #[error("not a whole Parquet file")]
    Parquet(#[from] ParquetError),
    /// Parquet, but it contradicts itself.
    #[error("not a whole Parquet file: it contradicts itself")]
    Broken,
    /// There is no such column, or it is of another type.
    #[error("no column {0} as `closeranks run` writes it")]
    Column(String),
    /// There is no such column in a recording of others.
    #[error("no column `{0}`: allowed are {COLUMNS}")]
    NoColumn(String),
    /// A value of a recording of others is not allowed.
    #[error("column `{column}`, row {row} is {found}: allowed is {allowed}")]
    Value {
        /// Which column.
        column: String,
        /// Which row, from 1.
        row: usize,
        /// What is there.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// A robot has two rows at one moment.
    #[error("row {row}: robot {robot} is there twice at {at}")]
    Twice {
        /// The later row, from 1.
        row: usize,
        /// Its robot.
        robot: String,
        /// When.
        at: String,
    },
    /// A robot has no row at a moment at which others have.
    #[error("robot {robot} is missing at {at}: every robot needs a row at every moment")]
    Missing {
        /// Which robot.
        robot: String,
        /// When.
        at: String,
    },
    /// The run is one of several teams.
    #[error(
        "the run has several teams: such runs are not read back, each network by itself is not in the file"
    )]
    Teams,
    /// A robot was not in the plane.
    #[error("robot {robot} is absent at tick {tick}: runs in which robots come and go are not read back")]
    Absent {
        /// The first such robot, from 1.
        robot: usize,
        /// When.
        tick: usize,
    },
    /// Too long or empty.
    #[error("{0} rows, allowed are 1 to {ROWS_MAX}")]
    Rows(i64),
    /// More robots than graphs can have nodes.
    #[error("{0} robots, allowed are 1 to {NODE_LIMIT}")]
    Robots(usize),
    /// A row is not where it should be.
    #[error("row {row} is not of tick {tick}, robot {robot}: rows go by ticks, then robots from 1 on")]
    Order {
        /// Place, from 0.
        row: usize,
        /// What should be there.
        tick: usize,
        /// What should be there.
        robot: usize,
    },
    /// A column has fewer rows than the file says.
    #[error("its columns differ in length")]
    Ragged,
}
