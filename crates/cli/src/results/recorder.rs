//! A run that is recorded while it goes on: the file of its ticks grows in the folder, and only what figures need is kept.

use std::fs::File;
use std::io::BufWriter;

use anyhow::Result;
use closeranks_report::figure::Thinned;
use closeranks_report::parquet::{Metadata, PartWriter};
use closeranks_sim::output::parts;
use closeranks_sim::output::record::Record;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{Options, Run};

use crate::folder::Folder;

/// What a file of ours says about itself.
pub(crate) fn metadata<'a>(text: &'a str, scenario: &Scenario) -> Metadata<'a> {
    let (version, commit) = (env!("CARGO_PKG_VERSION"), env!("CLOSERANKS_COMMIT"));
    Metadata { scenario: text, seed: scenario.seed, version, commit }
}

/// Writes one run.
pub(crate) struct Recorder {
    writer: PartWriter<BufWriter<File>>,
    /// There once a first part was written: before, the whole run is in memory.
    thinned: Option<Thinned>,
}

impl Recorder {
    /// Begins the file `name` for a run of `scenario`, whose text is `text`.
    pub(crate) fn new(folder: &mut Folder, name: &str, scenario: &Scenario, text: &str) -> Result<Self> {
        let file = BufWriter::new(folder.file(name)?);
        let like = Record::new(&Scenario { duration_s: 0.0, ..scenario.clone() }, 0);
        let writer = PartWriter::new(&like, &metadata(text, scenario), file)?;
        Ok(Self { writer, thinned: None })
    }

    /// Runs `scenario` and writes every tick. The record that comes back is what figures need: all of a short run.
    pub(crate) fn run(mut self, scenario: &Scenario, progress: &mut dyn FnMut(u32)) -> Result<Run> {
        let options = Options { record: true, robustness: true, digest: true, ..Options::default() };
        let mut part = |record: &Record| self.part(scenario, record);
        let run = parts::run::<anyhow::Error>(scenario, options, progress, &mut part)?;
        let record = run.record.map(|record| self.finish(record)).transpose()?;
        Ok(Run { record, ..run })
    }

    fn part(&mut self, scenario: &Scenario, part: &Record) -> Result<()> {
        self.thinned.get_or_insert_with(|| Thinned::new(scenario)).add(part);
        Ok(self.writer.write(part)?)
    }

    fn finish(self, record: Record) -> Result<Record> {
        self.writer.finish(&record)?;
        let Some(mut thinned) = self.thinned else { return Ok(record) };
        thinned.add(&record);
        Ok(thinned.finish())
    }
}
