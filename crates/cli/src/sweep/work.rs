//! Runs a sweep, or what is left of it, and says what it came to.

use std::path::Path;

use anyhow::Result;
use closeranks_sweep::block::{Job, Undrawable};
use closeranks_sweep::manifest::Manifest;
use closeranks_sweep::outcome::{Outcome, laws};
use closeranks_sweep::store::Store;
use closeranks_sweep::work::{count, join, left, run};

use super::What;
use super::save::{self, PAGES};
use crate::folder::exists;
use crate::{Speech, json, output, progress, source};

/// Runs `file` into `folder`; false when a law was broken that should hold.
pub(super) fn work(what: &What, file: &Path, folder: &Path) -> Result<bool> {
    let (plan, text) = source::plan(file)?;
    let What { seed, runs, shard, jobs, speech, .. } = *what;
    // What cannot be run at all is refused before anything is written.
    source::draw(file, &text, &plan, seed, shard.index - 1)?;
    exists(folder)?;
    let manifest = Manifest { file: file.display().to_string(), text, seed, runs, shard };
    let job = Job { plan, manifest };
    let store = Store::open(folder, &job.manifest)?;
    let finished = store.is_finished();
    if !finished {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(jobs.unwrap_or(0).into()).build()?;
        pool.install(|| finish(&job, &store, speech.quiet)).map_err(|error| drawn(error, file, &job))?;
    }
    tell(&job, &store, folder, speech, if finished { "this sweep was finished before in" } else { "" })
}

/// Runs the blocks that are not there and puts all of them together.
fn finish(job: &Job, store: &Store, quiet: bool) -> Result<()> {
    let left = left(job, store)?;
    for block in left.damaged.iter().filter(|_| !quiet) {
        let path = store.path(&Store::part(*block));
        output::note(&format!("`{}` was damaged; its runs are run again", path.display()));
    }
    let bar = progress::runs(job.manifest.shard.runs(job.manifest.runs), left.done, quiet);
    run(job, store, &left.missing, &|| {
        bar.inc(1);
        true
    })?;
    bar.finish_and_clear();
    join(job, store)
}

/// A run that cannot be drawn, with its place in the file.
fn drawn(error: anyhow::Error, file: &Path, job: &Job) -> anyhow::Error {
    match error.downcast::<Undrawable>() {
        Ok(Undrawable { run, problems }) => source::undrawable(file, &job.manifest.text, run, &problems),
        Err(error) => error,
    }
}

/// Counts the rows, writes the pages, and says what it came to; `before` begins what is said about the folder.
pub(super) fn tell(job: &Job, store: &Store, folder: &Path, speech: Speech, before: &str) -> Result<bool> {
    let (tally, spread) = count(job, store)?;
    let laws = laws(&tally);
    let outcome = Outcome { manifest: &job.manifest, tally: &tally, laws: &laws };
    save::save(store, &outcome, &spread)?;
    store.remove_parts()?;
    let folder = folder.display();
    if speech.json {
        output::say(&json::text(&outcome.json()));
    } else if !speech.quiet {
        let before = if before.is_empty() { String::new() } else { format!("{before} {folder}\n") };
        let (text, rows, pages) = (outcome.text(), store.rows(), PAGES.join(", "));
        output::say(&format!("{before}{text}\nin {folder}: {rows}, {pages}\n"));
    }
    Ok(outcome.is_good())
}
