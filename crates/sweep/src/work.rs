//! Runs blocks of a sweep in its folder, and puts them together.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::Path;

use anyhow::{Context, Result, bail};
use closeranks_report::sweep::entry::{broken as column_of_broken, column};
use closeranks_report::sweep::file::read;
use closeranks_report::sweep::rows::Rows;
use closeranks_report::sweep::spread::Spread;
use closeranks_report::sweep::tally::Tally;
use closeranks_sim::law::Law;
use rayon::prelude::*;

use crate::block::Job;
use crate::store::Store;

/// What is left of a sweep.
#[derive(Debug)]
pub struct Left {
    /// Blocks that are to be run.
    pub missing: Vec<u64>,
    /// Those of them that were there and damaged; they are removed.
    pub damaged: Vec<u64>,
    /// Runs of blocks that are there.
    pub done: u64,
}

/// Looks which blocks are there and whole. Call it in a pool of threads: every block is read.
pub fn left(job: &Job, store: &Store) -> Result<Left> {
    let (whole, damaged): (Vec<u64>, Vec<u64>) =
        store.parts()?.into_par_iter().partition(|block| part(job, store, *block).is_ok());
    damaged.iter().try_for_each(|block| store.remove_part(*block))?;
    let whole: BTreeSet<u64> = whole.into_iter().collect();
    let done = whole.iter().map(|block| job.runs_of(*block)).sum();
    let missing = (0..job.blocks()).filter(|block| !whole.contains(block)).collect();
    Ok(Left { missing, damaged, done })
}

/// Runs `missing` blocks, as many at once as the pool has threads; `go_on` is asked after every run. Blocks are the same for every number
/// of threads, and so is each row.
pub fn run(job: &Job, store: &Store, missing: &[u64], go_on: &(dyn Fn() -> bool + Sync)) -> Result<()> {
    missing.par_iter().with_max_len(1).try_for_each(|block| {
        let rows = job.rows(*block, go_on)?;
        store.write(&Store::part(*block), |file| write(job, file, core::iter::once(Ok(rows))))
    })
}

/// Puts all blocks into one file.
pub fn join(job: &Job, store: &Store) -> Result<()> {
    let parts = (0..job.blocks()).map(|block| part(job, store, block));
    store.write(store.rows(), |file| write(job, file, parts))
}

/// Writes a block that another process made, if it is that block of this sweep.
pub fn put(job: &Job, store: &Store, block: u64, bytes: Vec<u8>) -> Result<()> {
    let bytes = bytes::Bytes::from(bytes);
    let fits = job.is_of(bytes.clone())? && job.read(bytes.clone(), block)?.is_some();
    if !fits {
        bail!("what came as block {block} is of another sweep or another version of closeranks");
    }
    store.put(&Store::part(block), &bytes)
}

/// Parquet is written in many small pieces.
pub(crate) fn write(job: &Job, file: &mut File, all: impl Iterator<Item = Result<Rows>>) -> Result<()> {
    Ok(job.write(BufWriter::new(file), all)?.flush()?)
}

/// The rows of a block, if they are those that it should have.
fn part(job: &Job, store: &Store, block: u64) -> Result<Rows> {
    let path = store.path(&Store::part(block));
    let broken = || broken(&path);
    let rows = job.read(File::open(&path).with_context(broken)?, block).with_context(broken)?;
    rows.with_context(broken)
}

/// Counts all rows.
pub fn count(job: &Job, store: &Store) -> Result<(Tally, Spread)> {
    let path = store.path(store.rows());
    let broken = || broken(&path);
    let open = || File::open(&path).with_context(broken);
    if !job.is_of(open()?).with_context(broken)? {
        bail!("`{}` is of another sweep; remove it and repeat the command", path.display());
    }
    let fields: Vec<String> = job.plan.fields().iter().filter(|field| field.few).map(column).collect();
    let few = fields.iter().map(String::as_str);
    let columns = Law::ALL.map(column_of_broken);
    let laws = columns.iter().map(String::as_str);
    let names: Vec<&str> = Tally::COLUMNS.into_iter().chain(few).chain(laws).collect();
    let mut tally = Tally::new(job.plan.fields());
    read(open()?, &names, &mut |rows| tally.add(&rows)).with_context(broken)?;
    if tally.runs != job.manifest.shard.runs(job.manifest.runs) {
        bail!(broken());
    }
    let mut spread = Spread::new(&tally);
    read(open()?, &Spread::COLUMNS, &mut |rows| spread.add(&rows)).with_context(broken)?;
    Ok((tally, spread))
}

fn broken(path: &Path) -> String {
    format!("`{}` is broken; remove it and repeat the command", path.display())
}
