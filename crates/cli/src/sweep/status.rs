//! `closeranks sweep --status DIR...`: what is done, what is open, and what to submit again.

use std::collections::BTreeSet;
use std::path::PathBuf;

use anyhow::Result;
use closeranks_report::content::Table;
use closeranks_report::table::text;
use closeranks_sweep::status::{Status, Whole, of, ranges, together};
use serde_json::json;

use crate::{Speech, json, output};

/// Says it; true if every shard is finished.
pub(super) fn status(folders: &[PathBuf], speech: Speech) -> Result<bool> {
    let look = |folder: &PathBuf| Ok((folder.display().to_string(), of(folder)?));
    let all = folders.iter().map(look).collect::<Result<Vec<(String, Status)>>>()?;
    let whole = together(&all)?;
    if speech.json {
        output::say(&json::text(&as_json(&all, &whole)));
    } else if !speech.quiet {
        output::say(&format!("{}\n{}", text(&table(&all)), sentence(&whole)));
    }
    Ok(whole.finished.len() as u64 == whole.count)
}

fn table(all: &[(String, Status)]) -> Table {
    let row = |(folder, status): &(String, Status)| {
        let Status { manifest, done, blocks, .. } = status;
        let runs = manifest.shard.runs(manifest.runs);
        vec![
            folder.clone(),
            manifest.shard.to_string(),
            runs.to_string(),
            format!("{done} of {blocks}"),
            state(status).to_owned(),
        ]
    };
    let heads = ["folder", "shard", "runs", "blocks", "is"].map(str::to_owned).to_vec();
    Table { heads, rows: all.iter().map(row).collect() }
}

fn state(status: &Status) -> &'static str {
    match status {
        Status { finished: true, .. } => "finished",
        Status { at_work: true, .. } => "at work",
        _ => "open",
    }
}

fn sentence(whole: &Whole) -> String {
    let Whole { count, finished, open, at_work } = whole;
    let line = |what: &str, shards: &BTreeSet<u64>| {
        if shards.is_empty() { String::new() } else { format!("{what}: {}\n", ranges(shards)) }
    };
    let head = format!("{} of {count} shards are finished\n", finished.len());
    head + &line("at work", at_work) + &line("open", open)
}

fn as_json(all: &[(String, Status)], whole: &Whole) -> serde_json::Value {
    let folder = |(folder, status): &(String, Status)| {
        let Status { manifest, done, blocks, .. } = status;
        let runs = manifest.shard.runs(manifest.runs);
        let shard = manifest.shard.to_string();
        json!({ "folder": folder, "shard": shard, "runs": runs, "blocks_done": done, "blocks": blocks, "is": state(status) })
    };
    let Whole { count, finished, open, at_work } = whole;
    json!({
        "folders": all.iter().map(folder).collect::<Vec<_>>(),
        "shards": count, "finished": finished, "open": open, "at_work": at_work,
    })
}
