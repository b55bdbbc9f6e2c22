//! What a sweep came to, as tables.

use std::collections::BTreeSet;

use super::confidence::upper_95;
use super::tally::{Share, Tally, promises};
use crate::page::content::Table;
use crate::page::table::number;

/// One line a controller: runs, violating runs, their share with its upper bound at 95 %, runs in which each of `laws` was
/// violated, mean radius of gyration.
#[must_use]
pub fn controllers(tally: &Tally, laws: &[&str]) -> Table {
    let mut heads =
        ["controller", "runs", "with\nviolations", "share", "at most\n(95 %)"].map(str::to_owned).to_vec();
    heads.extend(laws.iter().map(|law| format!("{law}\nruns")));
    heads.push("gyration\nmean, m".to_owned());
    let rows = tally.controllers.iter().map(|(name, share)| row(name, share, laws));
    Table { heads, rows: rows.collect() }
}

fn row(name: &str, share: &Share, laws: &[&str]) -> Vec<String> {
    #[expect(clippy::cast_precision_loss, reason = "sweeps are far below 2^53 runs")]
    let part = share.violating as f64 / share.runs.max(1) as f64;
    let mut row = vec![
        name.to_owned(),
        share.runs.to_string(),
        share.violating.to_string(),
        percent(part),
        percent(upper_95(share.violating, share.runs)),
    ];
    let runs = |law: &str| share.laws.get(law).copied().unwrap_or(0).to_string();
    row.extend(laws.iter().map(|law| if promises(name, law) { runs(law) } else { "-".to_owned() }));
    row.push(share.gyration_mean_m().map_or("-".to_owned(), |mean| number(mean, 3)));
    row
}

/// A share in percent with two telling digits.
#[must_use]
pub fn percent(share: f64) -> String {
    let percent = share * 100.0;
    let digits = match percent {
        0.0 => 0,
        _ if percent >= 9.95 => 1,
        _ if percent >= 0.1 => 2,
        _ if percent >= 0.001 => 4,
        _ => 6,
    };
    format!("{percent:.digits$} %")
}

/// Violating runs of all runs for every value of every drawn field with few values: one line a value. Of chosen tables, which
/// was chosen; JSON has their fields too.
#[must_use]
pub fn values(tally: &Tally) -> Table {
    let names: BTreeSet<&str> = tally.controllers.keys().map(String::as_str).collect();
    let mut heads = vec!["drawn".to_owned(), "value".to_owned()];
    heads.extend(names.iter().map(|name| format!("{name}\nviolating\nof runs")));
    let mut rows = Vec::new();
    for (path, values) in tally.fields.iter().filter(|(path, _)| !is_part(tally, path)) {
        let mut values: Vec<_> = values.iter().flatten().collect();
        values.sort_by(|(a, _), (b, _)| order(a, b));
        rows.extend(values.into_iter().enumerate().map(|(index, (value, counts))| {
            let path = if index == 0 { path.clone() } else { String::new() };
            let cells = names.iter().map(|name| {
                counts.get(*name).map_or("-".to_owned(), |[runs, violating]| format!("{violating} of {runs}"))
            });
            [path, value.clone()].into_iter().chain(cells).collect()
        }));
    }
    Table { heads, rows }
}

/// True for a field of a chosen table that has a name of its own, or a `kind`: which one was chosen says it already.
fn is_part(tally: &Tally, path: &str) -> bool {
    let ends = path.match_indices('.').map(|(end, _)| &path[..end]);
    let mut parents = ends.filter(|parent| {
        let kind = format!("{parent}.kind");
        kind != path && (tally.fields.contains_key(*parent) || tally.fields.contains_key(&kind))
    });
    parents.next().is_some()
}

/// Numbers by size, words by the alphabet.
fn order(a: &str, b: &str) -> core::cmp::Ordering {
    match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => a.total_cmp(&b),
        _ => a.cmp(b),
    }
}
