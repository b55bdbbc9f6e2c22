//! The counts of docs/reliability are whole, and its page says what they say.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

#[path = "../examples/reliability/tables.rs"]
mod tables;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;

use tables::{CONTROLLERS, Count, LAWS, Shard, VALUES, page, read_counts, read_runs, tables, total};
use tables::{write_counts, write_runs};

/// Commits of shards since the rule of `links` was mended.
const SINCE: [&str; 1] = ["14882c8fbefc"];

fn docs(name: &str) -> String {
    fs::read_to_string(PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(name)).unwrap()
}

fn shards() -> Vec<Shard> {
    read_runs(&docs("reliability/runs.csv")).unwrap()
}

fn counts(name: &str, head: &str) -> Vec<Count> {
    read_counts(&docs(&format!("reliability/{name}.csv")), head).unwrap()
}

#[test]
fn every_shard_is_there_once_with_all_its_controllers() {
    let mut seen: BTreeMap<(u64, String), Vec<Shard>> = BTreeMap::new();
    for shard in shards() {
        assert!(CONTROLLERS.contains(&shard.controller.as_str()), "{}", shard.controller);
        assert!(shard.commit.len() >= 7 && shard.commit.chars().all(|c| c.is_ascii_hexdigit()));
        assert!(shard.throughout <= shard.promised && shard.promised <= shard.runs && shard.runs > 0);
        assert!(shard.violating <= shard.runs);
        seen.entry((shard.seed, shard.commit.clone())).or_default().push(shard);
    }
    assert!(!seen.is_empty());
    let seeds: BTreeSet<u64> = seen.keys().map(|(seed, _)| *seed).collect();
    assert_eq!(seeds.len(), seen.len(), "no seed counts twice: the same seed draws the same runs");
    for (shard, of) in seen {
        let names: Vec<&str> = of.iter().map(|one| one.controller.as_str()).collect();
        assert!(
            [&["budget", "composed", "links"][..], &["budget", "links"], &["links"]].contains(&&names[..]),
            "{shard:?}"
        );
        assert!(of.iter().all(|one| one.runs == of[0].runs), "{shard:?}");
    }
}

#[test]
fn the_page_says_what_the_tables_say() {
    let (shards, laws, values) = (shards(), counts("laws", LAWS), counts("values", VALUES));
    let text = docs("reliability.md");
    assert_eq!(page(&text, &tables(&shards, &laws, &values)).unwrap(), text, "make the tables again");
    let said = |name: &str| tables::grouped(total(&shards, name, |shard| shard.runs));
    assert!(text.contains(&format!("{} scenarios", said("budget"))), "{}", said("budget"));
    for name in ["budget", "links"] {
        let violating = total(&shards, name, |shard| shard.violating);
        let sentence = format!("`{name}`: {violating} of {}", said(name));
        assert!(text.contains(&sentence), "{sentence}");
    }
    let since: Vec<Shard> =
        shards.into_iter().filter(|shard| SINCE.contains(&shard.commit.as_str())).collect();
    let (violating, runs) =
        (total(&since, "links", |shard| shard.violating), total(&since, "links", |shard| shard.runs));
    let sentence = format!("{violating} of {} since", tables::grouped(runs));
    assert!(text.contains(&sentence), "{sentence}");
}

#[test]
fn tables_that_are_written_are_read_again() {
    let (runs, laws) = (docs("reliability/runs.csv"), docs("reliability/laws.csv"));
    assert_eq!(write_runs(&read_runs(&runs).unwrap()), runs);
    assert_eq!(write_counts(&read_counts(&laws, LAWS).unwrap(), LAWS), laws);
    assert!(read_runs("seed,commit\n1,2\n").is_err());
    assert!(read_runs(&format!("{}\n1,2,3\n", tables::RUNS)).unwrap_err().contains("3 cells"));
    assert!(read_counts(&format!("{LAWS}\na,b,c,1,-1\n"), LAWS).unwrap_err().contains("`-1`"));
    assert!(page("", &[("runs", String::new())]).is_err());
}
