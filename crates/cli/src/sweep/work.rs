//! Runs blocks of a sweep, and puts them together.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::Path;

use anyhow::{Context, Result, bail};
use closeranks_report::sweep::entry::{Entry, heads};
use closeranks_report::sweep::file::{Writer, metadata, read};
use closeranks_report::sweep::rows::Rows;
use closeranks_report::sweep::spread::Spread;
use closeranks_report::sweep::tally::{Tally, broken as column_of_broken};
use closeranks_sim::law::Law;
use closeranks_sim::sweep::Plan;
use closeranks_sim::world::{self, Options};
use rayon::prelude::*;

use super::manifest::Manifest;
use super::store::Store;
use crate::{output, progress, source};

/// A sweep that is to be run.
pub(crate) struct Work<'a> {
    /// Where it is written.
    pub(crate) file: &'a Path,
    /// What is drawn.
    pub(crate) plan: Plan,
    /// What decides the rows.
    pub(crate) manifest: Manifest<'a>,
    /// Threads; 0 for one a core.
    pub(crate) jobs: usize,
    /// No bar.
    pub(crate) quiet: bool,
}

impl Work<'_> {
    /// Runs every block that is not there yet and puts all of them into one file. Blocks are the same for every number of
    /// threads, and so is each row.
    pub(crate) fn finish(&self, store: &Store) -> Result<()> {
        let Manifest { runs, shard, .. } = self.manifest;
        let pool = rayon::ThreadPoolBuilder::new().num_threads(self.jobs).build()?;
        let there = pool.install(|| self.whole_parts(store))?;
        let missing: Vec<u64> = (0..shard.blocks(runs)).filter(|block| !there.contains(block)).collect();
        let left: usize = missing.iter().map(|block| shard.block(runs, *block).count()).sum();
        let all = shard.runs(runs);
        let bar = progress::runs(all, all - left as u64, self.quiet);
        pool.install(|| {
            missing.par_iter().with_max_len(1).try_for_each(|block| {
                let rows = self.block(*block, &|| bar.inc(1))?;
                store.write(&Store::part(*block), |file| self.write(file, [Ok(rows)].into_iter()))
            })
        })?;
        bar.finish_and_clear();
        self.merge(store)
    }

    /// Blocks that are there and whole; damaged ones are removed, and so run again.
    fn whole_parts(&self, store: &Store) -> Result<BTreeSet<u64>> {
        let (whole, damaged): (Vec<u64>, Vec<u64>) =
            store.parts()?.into_par_iter().partition(|block| self.part(store, *block).is_ok());
        for block in damaged {
            store.remove_part(block)?;
            if !self.quiet {
                output::note(&format!(
                    "`{}` was damaged; its runs are run again",
                    store.path(&Store::part(block)).display()
                ));
            }
        }
        Ok(whole.into_iter().collect())
    }

    /// All rows of a block, by run, then controller.
    fn block(&self, block: u64, done: &(dyn Fn() + Sync)) -> Result<Rows> {
        let mut rows = Rows::empty(&heads(self.plan.fields()));
        for run in self.manifest.shard.block(self.manifest.runs, block) {
            self.run(run, &mut rows)?;
            done();
        }
        Ok(rows)
    }

    fn run(&self, run: u64, rows: &mut Rows) -> Result<()> {
        let drawn = source::draw(self.file, self.manifest.text, &self.plan, self.manifest.seed, run)?;
        for (scenario, _) in &drawn.scenarios {
            let finished =
                world::run(scenario, Options { without_phi: true, ..Options::default() }, &mut |_| ());
            let finished = finished.with_context(|| format!("run {run} cannot be run"))?;
            let (redraws, drawn) = (drawn.redraws, drawn.drawn.as_slice());
            rows.push(Entry { run, redraws, drawn, scenario, summary: &finished.summary }.cells());
        }
        Ok(())
    }

    fn write(&self, file: &mut File, all: impl Iterator<Item = Result<Rows>>) -> Result<()> {
        let file = BufWriter::new(file); // Parquet is written in many small pieces
        let mut writer = Writer::new(file, &heads(self.plan.fields()), &self.manifest.pairs())?;
        for rows in all {
            writer.add(rows?)?;
        }
        Ok(writer.finish()?.flush()?)
    }

    /// Puts all blocks into one file.
    fn merge(&self, store: &Store) -> Result<()> {
        let blocks = 0..self.manifest.shard.blocks(self.manifest.runs);
        let parts = blocks.map(|block| self.part(store, block));
        store.write(store.rows(), |file| self.write(file, parts))
    }

    /// The rows of a block, if they are those that it should have.
    fn part(&self, store: &Store, block: u64) -> Result<Rows> {
        let path = store.path(&Store::part(block));
        let broken = || broken(&path);
        let mut rows = Rows::empty(&heads(self.plan.fields()));
        let mut fits = true;
        read(File::open(&path).with_context(broken)?, &[], &mut |more| fits &= rows.append(more))
            .with_context(broken)?;
        let mut runs: Vec<Option<i64>> = rows.whole("run").to_vec();
        runs.dedup();
        let expected =
            self.manifest.shard.block(self.manifest.runs, block).map(|run| i64::try_from(run).ok());
        let due = self.manifest.shard.block(self.manifest.runs, block).count() * self.rows_per_run();
        if !fits || rows.count() != due || !expected.eq(runs) {
            bail!(broken());
        }
        Ok(rows)
    }

    fn rows_per_run(&self) -> usize {
        self.plan.controllers().len().max(1)
    }

    /// Counts all rows.
    pub(crate) fn count(&self, store: &Store) -> Result<(Tally, Spread)> {
        let path = store.path(store.rows());
        let broken = || broken(&path);
        let open = || File::open(&path).with_context(broken);
        if !self.manifest.is_of(&metadata(open()?).with_context(broken)?) {
            bail!("`{}` is of another sweep; remove it and repeat the command", path.display());
        }
        let few = self.plan.fields().iter().filter(|field| field.few).map(|field| field.path.as_str());
        let columns = Law::ALL.map(column_of_broken);
        let laws = columns.iter().map(String::as_str);
        let names: Vec<&str> = Tally::COLUMNS.into_iter().chain(few).chain(laws).collect();
        let mut tally = Tally::new(self.plan.fields());
        read(open()?, &names, &mut |rows| tally.add(&rows)).with_context(broken)?;
        if tally.runs != self.manifest.shard.runs(self.manifest.runs) {
            bail!(broken());
        }
        let mut spread = Spread::new(&tally);
        read(open()?, &Spread::COLUMNS, &mut |rows| spread.add(&rows)).with_context(broken)?;
        Ok((tally, spread))
    }
}

fn broken(path: &Path) -> String {
    format!("`{}` is broken; remove it and repeat the command", path.display())
}
