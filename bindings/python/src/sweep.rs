//! A sweep: blocks of rows as bytes, and the folder that they go to.

use core::sync::atomic::{AtomicBool, Ordering};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use annotate_snippets::Renderer;
use closeranks_report::problems;
use closeranks_sim::parse::{Files, Problem};
use closeranks_sim::sweep::Plan;
use closeranks_sweep::array::auto;
use closeranks_sweep::block::{Job, Stopped, Undrawable};
use closeranks_sweep::manifest::{Manifest, RUNS};
use closeranks_sweep::outcome::{Outcome, laws};
use closeranks_sweep::shard::Shard;
use closeranks_sweep::store::Store;
use closeranks_sweep::work;
use pyo3::exceptions::{PyKeyboardInterrupt, PyOSError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::{errors, values};

/// Runs that can be done, and what their rows are.
#[pyclass(frozen, module = "closeranks._native")]
pub(crate) struct Sweep {
    job: Job,
    stopped: AtomicBool,
}

/// The folder of a sweep, locked for as long as this is open.
#[pyclass(frozen, module = "closeranks._native")]
pub(crate) struct SweepFolder {
    sweep: Py<Sweep>,
    store: Mutex<Option<Arc<Store>>>,
}

fn shard(text: &str) -> PyResult<Shard> {
    let shard = if text == "auto" { auto(&|name| std::env::var(name).ok()) } else { text.parse() };
    shard.map_err(|wrong| errors::refused(format!("`shard` is \"{text}\": {wrong}")))
}

fn refused(name: &str, text: &str, wrong: &[Problem]) -> PyErr {
    errors::scenario(problems::picture(&Renderer::plain(), name, text, wrong).trim_end())
}

impl Sweep {
    fn undrawable(&self, Undrawable { run, problems }: &Undrawable) -> PyErr {
        let Manifest { file, text, .. } = &self.job.manifest;
        let picture = problems::picture(&Renderer::plain(), file, text, problems);
        errors::scenario(format!("{picture}note: this is what the last draw of run {run} was refused for"))
    }

    /// An error of a block or a folder, in the words of the command line.
    fn error(&self, error: &anyhow::Error) -> PyErr {
        if let Some(wrong) = error.downcast_ref::<Undrawable>() {
            self.undrawable(wrong)
        } else if error.is::<Stopped>() {
            PyKeyboardInterrupt::new_err(error.to_string())
        } else if error.downcast_ref::<std::io::Error>().is_some() {
            PyOSError::new_err(format!("{error:#}"))
        } else {
            errors::refused(format!("{error:#}"))
        }
    }

    fn go_on(&self) -> bool {
        !self.stopped.load(Ordering::Relaxed)
    }
}

#[pymethods]
impl Sweep {
    /// A sweep of `runs` runs of `text`, which messages call `name`; `files` has the texts of files beside it.
    #[new]
    fn new(
        text: &str,
        name: &str,
        files: Vec<(String, Option<String>, String)>,
        runs: u64,
        seed: u64,
        shard: &str,
    ) -> PyResult<Self> {
        if !RUNS.contains(&runs) {
            let (least, most) = (RUNS.start(), RUNS.end());
            return Err(errors::refused(format!("`runs` is {runs}, allowed is {least} to {most}")));
        }
        let shard = self::shard(shard)?;
        let file = |(name, text, why): (String, Option<String>, String)| (name, text.ok_or(why));
        let files: Files = files.into_iter().map(file).collect();
        let plan = Plan::read_with(text, &files).map_err(|wrong| refused(name, text, &wrong))?;
        let text = text.to_owned() + &files.comments();
        let manifest = Manifest { file: name.to_owned(), text, seed, runs, shard };
        let sweep = Self { job: Job { plan, manifest }, stopped: AtomicBool::new(false) };
        // What cannot be run at all is refused before anything is written.
        let run = shard.index - 1;
        let first = sweep.job.plan.draw(seed, run);
        first.map_err(|problems| sweep.undrawable(&Undrawable { run, problems }))?;
        Ok(sweep)
    }

    /// How many runs are ours.
    fn runs(&self) -> u64 {
        self.job.manifest.shard.runs(self.job.manifest.runs)
    }

    /// I/M.
    fn shard(&self) -> String {
        self.job.manifest.shard.to_string()
    }

    /// How many runs a block has.
    fn runs_of(&self, block: u64) -> u64 {
        self.job.runs_of(block)
    }

    /// The rows of a block as a Parquet file.
    fn block<'py>(&self, py: Python<'py>, block: u64) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = py.detach(|| {
            let rows = self.job.rows(block, &|| self.go_on())?;
            self.job.write(Vec::new(), core::iter::once(Ok(rows)))
        });
        Ok(PyBytes::new(py, &bytes.map_err(|error| self.error(&error))?))
    }

    /// Ends blocks that are being run, after their next run.
    fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
    }

    /// Makes the folder, or goes on in it.
    fn open(slf: &Bound<'_, Self>, folder: PathBuf) -> PyResult<SweepFolder> {
        let sweep = slf.get();
        let store =
            Store::open(Path::new(&folder), &sweep.job.manifest).map_err(|error| sweep.error(&error))?;
        Ok(SweepFolder { sweep: slf.clone().unbind(), store: Mutex::new(Some(Arc::new(store))) })
    }
}

impl SweepFolder {
    fn store(&self) -> PyResult<Arc<Store>> {
        let store = self.store.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        store.clone().ok_or_else(|| errors::refused("the folder of the sweep was closed"))
    }

    /// Does something with the sweep and its folder while Python goes on.
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&Sweep, &Store) -> anyhow::Result<T> + Send,
    ) -> PyResult<T> {
        let (store, sweep) = (self.store()?, self.sweep.get());
        py.detach(|| work(sweep, &store)).map_err(|error| sweep.error(&error))
    }
}

#[pymethods]
impl SweepFolder {
    /// Blocks that are to be run, and how many runs are done; damaged blocks are removed.
    fn left(&self, py: Python<'_>) -> PyResult<(Vec<u64>, u64)> {
        let left = self.with(py, |sweep, store| work::left(&sweep.job, store))?;
        Ok((left.missing, left.done))
    }

    /// Runs a block and writes it.
    fn run(&self, py: Python<'_>, block: u64) -> PyResult<()> {
        self.with(py, |sweep, store| work::run(&sweep.job, store, &[block], &|| sweep.go_on()))
    }

    /// Writes a block that another process made, if it is that block of this sweep.
    fn put(&self, py: Python<'_>, block: u64, bytes: Vec<u8>) -> PyResult<()> {
        self.with(py, |sweep, store| work::put(&sweep.job, store, block, bytes))
    }

    /// True if all rows are in one file.
    fn is_finished(&self) -> PyResult<bool> {
        Ok(self.store()?.is_finished())
    }

    /// Puts all blocks into one file.
    fn join(&self, py: Python<'_>) -> PyResult<()> {
        self.with(py, |sweep, store| work::join(&sweep.job, store))
    }

    /// Path of the file with all rows.
    fn rows(&self) -> PyResult<PathBuf> {
        let store = self.store()?;
        Ok(store.path(store.rows()))
    }

    /// What the sweep came to: for people, and for machines. Blocks are removed: the rows are all in one file.
    fn outcome<'py>(&self, py: Python<'py>) -> PyResult<(String, Bound<'py, PyAny>)> {
        let (text, json) = self.with(py, |sweep, store| {
            let (tally, _) = work::count(&sweep.job, store)?;
            store.remove_parts()?;
            let laws = laws(&tally);
            let outcome = Outcome { manifest: &sweep.job.manifest, tally: &tally, laws: &laws };
            Ok((outcome.text(), outcome.json()))
        })?;
        Ok((text, values::from_json(py, &json)?))
    }

    /// Lets go of the folder.
    fn close(&self) {
        *self.store.lock().unwrap_or_else(std::sync::PoisonError::into_inner) = None;
    }
}
