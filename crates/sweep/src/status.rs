//! What is done and what is open of a sweep, by its folders.

use core::fmt::Write as _;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::path::Path;

use anyhow::{Context as _, Result, bail};
use closeranks_report::sweep::file::metadata;

use crate::manifest::Manifest;
use crate::shard::Shard;
use crate::store::{self, SWEEP, block, names};

/// What a folder says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Status {
    /// Which sweep, and which shard of it.
    pub manifest: Manifest,
    /// How many blocks are there.
    pub done: u64,
    /// Of how many.
    pub blocks: u64,
    /// True if all rows are in one file that says it is this shard's.
    pub finished: bool,
    /// True if a program is at work in the folder.
    pub at_work: bool,
}

/// Looks into a folder, and changes nothing there. Blocks are counted by their names, not read.
pub fn of(folder: &Path) -> Result<Status> {
    let shown = folder.display();
    let text = fs::read_to_string(folder.join(SWEEP));
    let text = text.with_context(|| format!("`{shown}` holds no sweep: cannot read its {SWEEP}"))?;
    let Some(manifest) = Manifest::read(&text) else {
        bail!("`{shown}` holds no sweep: its {SWEEP} cannot be understood");
    };
    let blocks = manifest.shard.blocks(manifest.runs);
    let here = names(folder)?.iter().filter_map(|name| block(name)).filter(|block| *block < blocks).count();
    let finished = is_finished(folder, &text, manifest.shard);
    let done = if finished { blocks } else { here as u64 };
    Ok(Status { manifest, done, blocks, finished, at_work: store::is_locked(folder) })
}

/// True if the file with all rows says about itself what the folder says.
fn is_finished(folder: &Path, manifest: &str, shard: Shard) -> bool {
    let Ok(file) = File::open(folder.join(store::rows(shard))) else { return false };
    let Ok(there) = metadata(file) else { return false };
    let of = |key: &str| there.iter().find(|(known, _)| known == key).map(|(_, value)| value.as_str());
    ["seed", "runs", "shard", "version", "commit", "sweep"].iter().all(|key| {
        let pairs: Option<serde_json::Value> = serde_json::from_str(manifest).ok();
        pairs.is_some_and(|pairs| pairs[key].as_str() == of(key))
    })
}

/// Folders of one sweep, together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Whole {
    /// How many shards the sweep has.
    pub count: u64,
    /// Shards that are finished.
    pub finished: BTreeSet<u64>,
    /// Shards that are not finished, and on which nobody is at work: those to be run again, or at all.
    pub open: BTreeSet<u64>,
    /// Shards that are being worked on.
    pub at_work: BTreeSet<u64>,
}

/// Puts what folders say together; refuses folders of two sweeps, and two folders of one shard.
pub fn together(all: &[(String, Status)]) -> Result<Whole> {
    let Some((first, one)) = all.first() else { bail!("no folder was given") };
    let count = one.manifest.shard.count;
    let mut seen: BTreeMap<u64, &str> = BTreeMap::new();
    for (folder, status) in all {
        let shard = status.manifest.shard;
        let as_first =
            status.manifest.of_shard(Shard { index: one.manifest.shard.index, count: shard.count });
        if let Some(difference) = one.manifest.difference(&as_first.to_json()) {
            bail!("`{folder}` and `{first}` are of two sweeps: {difference}");
        }
        if let Some(other) = seen.insert(shard.index, folder) {
            bail!("`{other}` and `{folder}` are both shard {shard}");
        }
    }
    let those = |keep: &dyn Fn(&Status) -> bool| -> BTreeSet<u64> {
        let kept = all.iter().filter(|(_, status)| keep(status));
        kept.map(|(_, status)| status.manifest.shard.index).collect()
    };
    let finished = those(&|status| status.finished);
    let at_work = those(&|status| !status.finished && status.at_work);
    let open = (1..=count).filter(|index| !finished.contains(index) && !at_work.contains(index)).collect();
    Ok(Whole { count, finished, open, at_work })
}

/// Numbers as schedulers read them: `3,7-9`.
#[must_use]
pub fn ranges(numbers: &BTreeSet<u64>) -> String {
    let mut text = String::new();
    let mut left = numbers.iter().copied().peekable();
    while let Some(first) = left.next() {
        let mut last = first;
        while let Some(next) = left.next_if(|next| *next == last + 1) {
            last = next;
        }
        let comma = if text.is_empty() { "" } else { "," };
        let _ = match last - first {
            0 => write!(text, "{comma}{first}"),
            _ => write!(text, "{comma}{first}-{last}"),
        };
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn status(index: u64, finished: bool, at_work: bool) -> (String, Status) {
        let shard = Shard { index, count: 9 };
        let manifest =
            Manifest { file: "a.toml".to_owned(), text: "seed = 1\n".to_owned(), seed: 7, runs: 100, shard };
        (format!("out/{index}"), Status { manifest, done: 3, blocks: 12, finished, at_work })
    }

    #[test]
    fn what_is_open_is_what_nobody_finished_or_works_on() {
        let all =
            [status(1, true, false), status(2, false, false), status(4, false, true), status(5, true, true)];
        let whole = together(&all).unwrap();
        assert_eq!(ranges(&whole.finished), "1,5");
        assert_eq!(ranges(&whole.at_work), "4");
        assert_eq!(ranges(&whole.open), "2-3,6-9", "3 and 6 to 9 have no folder");
        assert_eq!(ranges(&BTreeSet::new()), "");
    }

    #[test]
    fn folders_of_two_sweeps_or_of_one_shard_are_refused() {
        let says = |all: &[(String, Status)]| together(all).unwrap_err().to_string();
        assert_eq!(says(&[]), "no folder was given");
        assert_eq!(
            says(&[status(1, true, false), status(1, false, false)]),
            "`out/1` and `out/1` are both shard 1/9"
        );
        let mut other = status(2, true, false);
        other.1.manifest.seed = 8;
        assert_eq!(
            says(&[status(1, true, false), other]),
            "`out/2` and `out/1` are of two sweeps: its `seed` is 8, not 7"
        );
        let mut other = status(2, true, false);
        other.1.manifest.shard.count = 3;
        assert!(says(&[status(1, true, false), other]).contains("its `shard` is 1/3, not 1/9"));
    }
}
