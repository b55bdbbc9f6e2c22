//! The rows of a block of runs, and blocks as files.

use core::fmt;
use std::io::Write;

use anyhow::{Context as _, Result, bail};
use closeranks_report::sweep::entry::{Entry, heads};
use closeranks_report::sweep::file::{Source, Writer, metadata, read};
use closeranks_report::sweep::rows::{Head, Rows};
use closeranks_sim::parse::Problem;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::sweep::{Plan, Run as Drawing};
use closeranks_sim::world::block::Block;
use closeranks_sim::world::together::together;
use closeranks_sim::world::{self, Options, Run};

use crate::manifest::Manifest;

/// Runs that can be done: what is drawn for them, and what decides their rows.
#[derive(Clone, Debug)]
pub struct Job {
    /// What is drawn.
    pub plan: Plan,
    /// What decides the rows.
    pub manifest: Manifest,
}

/// A run of which no draw could be run.
#[derive(Debug)]
pub struct Undrawable {
    /// Its number.
    pub run: u64,
    /// Why the last draw was refused.
    pub problems: Vec<Problem>,
}

/// Somebody asked to stop.
#[derive(Debug)]
pub struct Stopped;

impl Job {
    /// How many blocks our shard has.
    #[must_use]
    pub fn blocks(&self) -> u64 {
        self.manifest.shard.blocks(self.manifest.runs)
    }

    /// How many runs a block has.
    #[must_use]
    pub fn runs_of(&self, block: u64) -> u64 {
        self.runs(block).count() as u64
    }

    /// Columns of the rows.
    #[must_use]
    pub fn heads(&self) -> Vec<Head> {
        heads(self.plan.fields())
    }

    /// All rows of a block, by run, then controller. After each run `go_on` says whether to.
    ///
    /// Fails with [`Undrawable`] or [`Stopped`].
    pub fn rows(&self, block: u64, go_on: &(dyn Fn() -> bool + Sync)) -> Result<Rows> {
        let mut rows = Rows::empty(&self.heads());
        let runs: Vec<u64> = self.runs(block).collect();
        for runs in runs.chunks(Block::MOST) {
            self.add(runs, &mut rows, go_on)?;
        }
        Ok(rows)
    }

    /// Adds the rows of a few runs: those that are alike are computed side by side, all others when it is their turn.
    fn add(&self, runs: &[u64], rows: &mut Rows, go_on: &(dyn Fn() -> bool + Sync)) -> Result<()> {
        let drawn: Vec<_> = runs.iter().map(|run| self.plan.draw(self.manifest.seed, *run)).collect();
        let scenarios = drawn.iter().flatten().flat_map(|drawing| &drawing.scenarios);
        let scenarios: Vec<&Scenario> = scenarios.map(|(scenario, _)| scenario).collect();
        let mut finished = together(&scenarios, OPTIONS).into_iter();
        for (run, drawing) in runs.iter().zip(drawn) {
            let drawing = drawing.map_err(|problems| Undrawable { run: *run, problems })?;
            run_all(*run, &drawing, &mut finished, rows)?;
            if !go_on() {
                bail!(Stopped);
            }
        }
        Ok(())
    }

    /// Numbers of the runs of a block.
    pub(crate) fn runs(&self, block: u64) -> impl Iterator<Item = u64> {
        self.manifest.shard.block(self.manifest.runs, block)
    }

    /// Writes rows, block after block, as one file that says which sweep it is of.
    pub fn write<W: Write + Send>(&self, sink: W, all: impl Iterator<Item = Result<Rows>>) -> Result<W> {
        let mut writer = Writer::new(sink, &self.heads(), &self.manifest.pairs())?;
        for rows in all {
            writer.add(rows?)?;
        }
        Ok(writer.finish()?)
    }

    /// The rows of a block that [`Job::write`] wrote; none if they are not those that it should have.
    pub fn read<R: Source + 'static>(&self, source: R, block: u64) -> Result<Option<Rows>> {
        let mut rows = Rows::empty(&self.heads());
        let mut fits = true;
        read(source, &[], &mut |more| fits &= rows.append(more))?;
        let mut runs: Vec<Option<i64>> = rows.whole("run").to_vec();
        runs.dedup();
        let expected = self.runs(block).map(|run| i64::try_from(run).ok());
        let due = self.runs(block).count() * self.rows_per_run();
        Ok((fits && rows.count() == due && expected.eq(runs)).then_some(rows))
    }

    /// True if a file of rows says that it is of this shard of this sweep.
    pub fn is_of<R: Source + 'static>(&self, source: R) -> Result<bool> {
        Ok(self.manifest.is_of(&metadata(source)?))
    }

    /// Rows of each run: one a controller.
    #[must_use]
    pub fn rows_per_run(&self) -> usize {
        self.plan.controllers().len().max(1)
    }
}

/// What runs of a sweep are to produce besides their summaries.
const OPTIONS: Options = Options {
    record: false,
    digest: false,
    robustness: false,
    without_phi: true,
    engine: world::Engine::Team,
};

/// Adds the rows of one run; the next of `finished` are its scenarios, as far as they were run already.
fn run_all(
    run: u64,
    drawing: &Drawing,
    finished: &mut dyn Iterator<Item = Option<Run>>,
    rows: &mut Rows,
) -> Result<()> {
    for (scenario, _) in &drawing.scenarios {
        let finished = match finished.next().flatten() {
            Some(finished) => finished,
            None => world::run(scenario, OPTIONS, &mut |_| ())
                .with_context(|| format!("run {run} cannot be run"))?,
        };
        let (redraws, drawn) = (drawing.redraws, drawing.drawn.as_slice());
        rows.push(Entry { run, redraws, drawn, scenario, summary: &finished.summary }.cells());
    }
    Ok(())
}

impl fmt::Display for Undrawable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let tries = closeranks_sim::sweep::TRIES;
        write!(f, "none of {tries} draws of run {} can be run", self.run)
    }
}

impl core::error::Error for Undrawable {}

impl fmt::Display for Stopped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("stopped; the same call goes on")
    }
}

impl core::error::Error for Stopped {}
