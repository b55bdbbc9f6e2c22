//! What is left of a fleet, and seen of it elsewhere while it runs: an MCAP file, and moments as lines of JSON.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use closeranks_mcap::{Metadata, ROBOTS_MAX, RunWriter, history};
use closeranks_sim::output::snapshot::Snapshot;
use closeranks_sim::scenario::Scenario;

/// How many moments a second are written as lines at most.
const MOMENTS_HZ: f64 = 30.0;
/// The dimension that the page shows.
const PLANE: usize = 2;

/// Where what happens goes.
#[derive(Default)]
pub struct Sinks {
    /// A new file for the recording.
    pub record: Option<PathBuf>,
    /// Where lines of JSON go.
    pub moments: Option<Box<dyn Write>>,
}

impl Sinks {
    /// Refuses what cannot be written, before anything is started.
    pub fn check(&self, scenario: &Scenario) -> Result<(), TapeError> {
        let is_name = |path: &&PathBuf| path.extension().is_some_and(|end| end == "mcap") && !path.exists();
        if let Some(path) = self.record.as_ref().filter(|path| !is_name(path)) {
            return Err(TapeError::Name(path.clone()));
        }
        if self.record.is_some() && scenario.team.robots > ROBOTS_MAX {
            return Err(TapeError::Robots(scenario.team.robots));
        }
        if self.moments.is_some() && scenario.dimension != PLANE {
            return Err(TapeError::Dimension(scenario.dimension));
        }
        Ok(())
    }
}

/// Why a fleet is not recorded.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each says what it is about itself")]
pub enum TapeError {
    #[error("--record is {0}, allowed is a new file that ends in .mcap")]
    Name(PathBuf),
    #[error("--record can hold {ROBOTS_MAX} robots, the team has {0}")]
    Robots(u16),
    #[error("--moments is for the page, which shows the plane, and the scenario has {0} dimensions")]
    Dimension(usize),
    #[error("{path}: {error}")]
    File { path: PathBuf, error: io::Error },
}

/// A recording that grows.
pub struct Tape {
    record: Option<(PathBuf, RunWriter<File>)>,
    moments: Option<Box<dyn Write>>,
    every: u32,
    failed: Option<TapeError>,
}

impl Tape {
    /// Begins to record a fleet of `scenario`, whose text is `text`.
    pub fn new(sinks: Sinks, scenario: &Scenario, text: &str) -> Result<Self, TapeError> {
        let record = sinks.record.map(|path| begin(path, scenario, text)).transpose()?;
        let mut moments = sinks.moments;
        say(&mut moments, &history::opening(text));
        let every = (1.0 / (MOMENTS_HZ * scenario.tick_s())).ceil().max(1.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates; at least 1")]
        let every = every as u32;
        Ok(Self { record, moments, every, failed: None })
    }

    /// Adds a tick. What cannot be written is said at the end, and the fleet goes on.
    pub fn tick(&mut self, now: &Snapshot<'_>) {
        if let Some((path, writer)) = &mut self.record
            && let Err(error) = writer.tick(now)
        {
            self.failed = Some(TapeError::File { path: path.clone(), error });
            self.record = None;
        }
        if now.tick.is_multiple_of(self.every) {
            say(&mut self.moments, &history::moment(now));
        }
    }

    /// Writes what is not yet written; an error if something was not.
    pub fn finish(self) -> Result<(), TapeError> {
        if let Some(failed) = self.failed {
            return Err(failed);
        }
        let Some((path, writer)) = self.record else { return Ok(()) };
        writer.finish().map_err(|error| TapeError::File { path, error })
    }
}

fn begin(path: PathBuf, scenario: &Scenario, text: &str) -> Result<(PathBuf, RunWriter<File>), TapeError> {
    let failed = |path: &Path| {
        let path = path.to_owned();
        move |error| TapeError::File { path, error }
    };
    let file = File::create_new(&path).map_err(failed(&path))?;
    let version = env!("CARGO_PKG_VERSION");
    let weight = scenario.link_shape().map_or([f64::NAN; 2], |link| [link.q1, link.q2]);
    let metadata = Metadata { scenario: text, seed: scenario.seed, version, commit: "", weight };
    let command = format!("closeranks-node fleet ({})", scenario.name);
    let writer = RunWriter::new(scenario, &metadata, &command, file).map_err(failed(&path))?;
    Ok((path, writer))
}

/// Writes lines; whoever does not read them any more gets none.
fn say(moments: &mut Option<Box<dyn Write>>, lines: &str) {
    let gone = moments.as_mut().is_some_and(|out| {
        let written = out.write_all(lines.as_bytes()).and_then(|()| out.flush());
        written.is_err()
    });
    if gone {
        *moments = None;
    }
}
