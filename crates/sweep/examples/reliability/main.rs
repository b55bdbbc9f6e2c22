//! The counts and tables of docs/reliability.md out of the folders of sweeps: `reliability DOCS FOLDER...`.
//!
//! Of a sweep that is not finished it counts the blocks that are.
//! Writes `runs.csv`, `laws.csv` and `values.csv` of `DOCS/reliability` and the tables in `DOCS/reliability.md`. Lines of
//! `runs.csv` about other seeds or commits stay; laws and values are those of the folders alone.

#[expect(dead_code, reason = "the test of docs uses all of it")]
mod tables;

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context as _, Result, anyhow};
use closeranks_report::sweep::file::{metadata, read};
use closeranks_report::sweep::rows::Rows;
use closeranks_report::sweep::tally::{Tally, promises};
use closeranks_sim::law::Law;
use closeranks_sim::sweep::Plan;
use tables::{CONTROLLERS, Count, LAWS, Shard, VALUES, page, read_runs, tables, write_counts, write_runs};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [docs, folders @ ..] = arguments.as_slice() else { return usage() };
    if folders.is_empty() {
        return usage();
    }
    match write(Path::new(docs), folders) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error:#}");
            ExitCode::FAILURE
        }
    }
}

fn usage() -> ExitCode {
    eprintln!("usage: reliability DOCS FOLDER...");
    ExitCode::from(2)
}

fn write(docs: &Path, folders: &[String]) -> Result<()> {
    let (mut tally, mut new) = (None, Vec::new());
    for folder in folders {
        new.extend(shard(&files(Path::new(folder))?, &mut tally)?);
    }
    let here = docs.join("reliability");
    let text = fs::read_to_string(here.join("runs.csv")).unwrap_or_else(|_| format!("{}\n", tables::RUNS));
    let mut shards = read_runs(&text).map_err(|error| anyhow!("runs.csv: {error}"))?;
    shards.retain(|old| !new.iter().any(|one: &Shard| (one.seed, &one.commit) == (old.seed, &old.commit)));
    shards.extend(new);
    shards.sort_by_key(|one| (one.seed, one.commit.clone(), one.controller.clone()));
    let tally = tally.context("no rows")?;
    let (laws, values) = (laws(&tally), values(&tally));
    fs::create_dir_all(&here)?;
    fs::write(here.join("runs.csv"), write_runs(&shards))?;
    fs::write(here.join("laws.csv"), write_counts(&laws, LAWS))?;
    fs::write(here.join("values.csv"), write_counts(&values, VALUES))?;
    let file = docs.join("reliability.md");
    let text = fs::read_to_string(&file).with_context(|| file.display().to_string())?;
    let text = page(&text, &tables(&shards, &laws, &values)).map_err(|error| anyhow!(error))?;
    Ok(fs::write(file, text)?)
}

/// The files with the rows of a sweep: one if it is finished, else one a block.
fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let whole = folder.join("runs.parquet");
    if whole.exists() {
        return Ok(vec![whole]);
    }
    let entries = fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    let mut parts = Vec::new();
    for entry in entries {
        let path = entry?.path();
        let is_part = path.extension().is_some_and(|kind| kind == "parquet")
            && path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("part-"));
        parts.extend(is_part.then_some(path));
    }
    parts.sort();
    Ok(parts)
}

/// The lines of one sweep, whose rows go into `tally` too.
fn shard(files: &[PathBuf], tally: &mut Option<Tally>) -> Result<Vec<Shard>> {
    let file = files.first().context("a folder without rows")?;
    let open = |file: &Path| File::open(file).with_context(|| file.display().to_string());
    let pairs = metadata(open(file)?)?;
    let said = |name: &str| {
        let pair = pairs.iter().find(|(key, _)| key == name);
        pair.map(|(_, value)| value.as_str()).with_context(|| format!("{}: no `{name}`", file.display()))
    };
    let (seed, commit) = (said("seed")?.parse()?, said("commit")?.to_owned());
    let new = || {
        let plan = Plan::read(said("sweep")?).map_err(|problems| anyhow!("{problems:?}"))?;
        Ok::<_, anyhow::Error>(Tally::new(plan.fields()))
    };
    let all = match tally {
        Some(tally) => tally,
        None => tally.insert(new()?),
    };
    let of = |name: &str| Shard {
        seed,
        commit: commit.clone(),
        controller: name.to_owned(),
        runs: 0,
        promised: 0,
        throughout: 0,
        violating: 0,
    };
    let mut shards = CONTROLLERS.map(of);
    for file in files {
        read(open(file)?, &[], &mut |rows| {
            all.add(&rows);
            for shard in &mut shards {
                add(shard, &rows);
            }
        })?;
    }
    Ok(shards.into_iter().filter(|shard| shard.runs > 0).collect())
}

fn add(shard: &mut Shard, rows: &Rows) {
    let (controllers, violated) = (rows.text("controller"), rows.text("violated"));
    let covered = rows.number("covered_share");
    for row in 0..rows.count() {
        if controllers[row].as_deref() == Some(&shard.controller) {
            let covered = covered[row].unwrap_or(0.0);
            shard.runs += 1;
            shard.promised += u64::from(covered > 0.0);
            shard.throughout += u64::from(covered >= 1.0);
            shard.violating += u64::from(violated[row].is_some());
        }
    }
}

/// Of every law that some controller promises: runs that violated it, and that broke it at all.
fn laws(tally: &Tally) -> Vec<Count> {
    let mut counts = Vec::new();
    for law in Law::ALL.map(Law::name) {
        for name in CONTROLLERS.iter().filter(|_| CONTROLLERS.iter().any(|name| promises(name, law))) {
            let Some(share) = tally.controllers.get(*name) else { continue };
            let Some(broken) = share.broken.get(law) else { continue };
            let violated = share.laws.get(law).copied().unwrap_or(0);
            let value = if promises(name, law) { "promised" } else { "not promised" };
            let (of, controller) = (law.to_owned(), (*name).to_owned());
            counts.push(Count { of, value: value.to_owned(), controller, numbers: [violated, *broken] });
        }
    }
    counts
}

/// Of every drawn value: runs, and those that are violating.
fn values(tally: &Tally) -> Vec<Count> {
    let mut counts = Vec::new();
    for (path, values) in &tally.fields {
        for (value, by_controller) in values.iter().flatten() {
            for (name, numbers) in by_controller {
                // A list as TOML has commas.
                let value = value.replace(',', ";");
                counts.push(Count { of: path.clone(), value, controller: name.clone(), numbers: *numbers });
            }
        }
    }
    counts
}
