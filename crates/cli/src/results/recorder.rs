//! A run that is recorded while it goes on: the file of its ticks grows in the folder, and only what figures need is kept.

use std::fs::File;
use std::io::BufWriter;

use anyhow::Result;
use closeranks_graph::graph::set::NODE_LIMIT;
use closeranks_report::figure::Thinned;
use closeranks_report::numbers::Program;
use closeranks_report::parquet::{Metadata, PartWriter};
use closeranks_report::recording::rounds::RoundWriter;
use closeranks_sim::monitors::robustness::{ROUNDS_MAX, Round, thin};
use closeranks_sim::output::parts;
use closeranks_sim::output::record::Record;
use closeranks_sim::output::snapshot::Snapshot;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{Options, Run};
use closeranks_sweep::PROGRAM;

use crate::folder::Folder;

/// What looks at every tick of a run.
pub(crate) type Watch<'a> = dyn FnMut(&Snapshot<'_>) -> Result<()> + 'a;

/// What a file of ours says about itself.
pub(crate) fn metadata<'a>(text: &'a str, scenario: &Scenario) -> Metadata<'a> {
    let Program { version, commit } = PROGRAM;
    let weight = scenario.link_shape().map_or([f64::NAN; 2], |link| [link.q1, link.q2]);
    Metadata { scenario: text, seed: scenario.seed, version, commit, weight }
}

/// Writes one run.
pub(crate) struct Recorder {
    ticks: PartWriter<BufWriter<File>>,
    /// None for teams of which nobody searches the robustness.
    rounds: Option<RoundWriter<BufWriter<File>>>,
    /// There once a first part was written: before, the whole run is in memory.
    thinned: Option<Thinned>,
    /// Rounds of parts that were written, or as many of them as figures need.
    kept: Vec<Round>,
}

impl Recorder {
    /// Begins the files `ticks` and `rounds` for a run of `scenario`, whose text is `text`.
    pub(crate) fn new(
        folder: &mut Folder,
        [ticks, rounds]: [&str; 2],
        scenario: &Scenario,
        text: &str,
    ) -> Result<Self> {
        let metadata = metadata(text, scenario);
        let like = Record::new(&Scenario { duration_s: 0.0, ..scenario.clone() }, 0);
        let ticks = PartWriter::new(&like, &metadata, BufWriter::new(folder.file(ticks)?))?;
        let searched = usize::from(scenario.team.robots) <= NODE_LIMIT;
        let file = searched.then(|| folder.file(rounds).map(BufWriter::new)).transpose()?;
        let rounds = file.map(|file| RoundWriter::new(scenario.tick_s(), &metadata, file)).transpose()?;
        Ok(Self { ticks, rounds, thinned: None, kept: Vec::new() })
    }

    /// Runs `scenario` and writes every tick and round, each of which `watch` sees. What comes back is what figures need: all
    /// of a short run.
    pub(crate) fn run(
        mut self,
        scenario: &Scenario,
        progress: &mut dyn FnMut(u32),
        watch: &mut Watch<'_>,
    ) -> Result<Run> {
        let options = Options { record: true, robustness: true, digest: true, ..Options::default() };
        let mut part = |record: &Record, rounds: &[Round]| self.part(scenario, record, rounds);
        let run = parts::watched::<anyhow::Error>(scenario, options, progress, &mut part, watch)?;
        self.part_of_rounds(&run.rounds)?;
        let rounds = core::mem::take(&mut self.kept);
        let record = run.record.map(|record| self.finish(record)).transpose()?;
        Ok(Run { record, rounds, ..run })
    }

    fn part(&mut self, scenario: &Scenario, record: &Record, rounds: &[Round]) -> Result<()> {
        self.thinned.get_or_insert_with(|| Thinned::new(scenario)).add(record);
        self.part_of_rounds(rounds)?;
        Ok(self.ticks.write(record)?)
    }

    fn part_of_rounds(&mut self, rounds: &[Round]) -> Result<()> {
        self.kept.extend_from_slice(rounds);
        while self.kept.len() > ROUNDS_MAX {
            thin(&mut self.kept);
        }
        match &mut self.rounds {
            Some(writer) if !rounds.is_empty() => Ok(writer.write(rounds)?),
            _ => Ok(()),
        }
    }

    fn finish(self, record: Record) -> Result<Record> {
        self.ticks.finish(&record)?;
        self.rounds.map(RoundWriter::finish).transpose()?;
        let Some(mut thinned) = self.thinned else { return Ok(record) };
        thinned.add(&record);
        Ok(thinned.finish())
    }
}
