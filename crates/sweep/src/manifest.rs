//! What a folder says of the sweep in it: a command goes on only with its own.

use core::ops::RangeInclusive;

use serde_json::{Value, json};

use crate::PROGRAM;
use crate::shard::Shard;

/// How many runs a sweep may have.
pub const RUNS: RangeInclusive<u64> = 1..=10_000_000;

/// All that decides the rows, and what their file was called.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Manifest {
    /// What the file with draws was called; rows do not depend on it.
    pub file: String,
    /// The file with draws.
    pub text: String,
    /// Seed of the sweep.
    pub seed: u64,
    /// Runs of all shards.
    pub runs: u64,
    /// Our part.
    pub shard: Shard,
}

impl Manifest {
    /// As pairs of key and text; the sweep file last.
    #[must_use]
    pub fn pairs(&self) -> [(&'static str, String); 6] {
        [
            ("seed", self.seed.to_string()),
            ("runs", self.runs.to_string()),
            ("shard", self.shard.to_string()),
            ("version", PROGRAM.version.to_owned()),
            ("commit", PROGRAM.commit.to_owned()),
            ("sweep", self.text.clone()),
        ]
    }

    /// True if `pairs`, of a file of rows, are those of this sweep.
    #[must_use]
    pub fn is_of(&self, pairs: &[(String, String)]) -> bool {
        let mine = self.pairs();
        mine.len() == pairs.len()
            && mine.iter().all(|(key, text)| pairs.contains(&((*key).to_owned(), text.clone())))
    }

    /// As a file.
    #[must_use]
    pub fn to_json(&self) -> String {
        let file = ("file", self.file.clone());
        let pairs = self.pairs().into_iter().chain([file]).map(|(key, value)| (key.to_owned(), json!(value)));
        format!("{:#}\n", Value::Object(pairs.collect()))
    }

    /// What a file says, whichever version wrote it; none if it is no manifest.
    #[must_use]
    pub fn read(file: &str) -> Option<Self> {
        let there: Value = serde_json::from_str(file).ok()?;
        let of = |key: &str| there[key].as_str();
        Some(Self {
            file: of("file").unwrap_or("FILE").to_owned(),
            text: of("sweep")?.to_owned(),
            seed: of("seed")?.parse().ok()?,
            runs: of("runs")?.parse().ok().filter(|runs| RUNS.contains(runs))?,
            shard: of("shard")?.parse().ok()?,
        })
    }

    /// The manifest of another shard of this sweep.
    #[must_use]
    pub fn of_shard(&self, shard: Shard) -> Self {
        Self { shard, ..self.clone() }
    }

    /// What `file` says otherwise, in words; none if it is of this sweep.
    #[must_use]
    pub fn difference(&self, file: &str) -> Option<String> {
        let Ok(there) = serde_json::from_str::<Value>(file) else {
            return Some("it cannot be read".to_owned());
        };
        self.pairs().into_iter().find_map(|(key, here)| {
            let there = there[key].as_str().unwrap_or("missing");
            match key {
                _ if there == here => None,
                "sweep" => Some(lines(there, &here)),
                _ => Some(format!("its `{key}` is {there}, not {here}")),
            }
        })
    }
}

/// The first line in which two texts differ.
fn lines(there: &str, here: &str) -> String {
    let (mut old, mut new) = (there.lines(), here.lines());
    let mut number = 1;
    loop {
        match (old.next(), new.next()) {
            (Some(a), Some(b)) if a == b => number += 1,
            (None, None) => return "its file has other line ends".to_owned(),
            (a, b) => {
                let show = |line: Option<&str>| {
                    line.map_or("nothing".to_owned(), |line| format!("`{}`", line.trim()))
                };
                return format!("line {number} of its file is {}, not {}", show(a), show(b));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mine() -> Manifest {
        let text = "seed = 1\nname = \"a\"\n".to_owned();
        Manifest { file: "a.toml".to_owned(), text, seed: 7, runs: 10, shard: Shard { index: 1, count: 2 } }
    }

    #[test]
    fn a_manifest_knows_its_own_and_names_what_differs() {
        let (mine, file) = (mine(), mine().to_json());
        assert_eq!(mine.difference(&file), None);
        let says = |other: Manifest| other.difference(&file).unwrap();
        assert_eq!(says(Manifest { seed: 8, ..mine.clone() }), "its `seed` is 7, not 8");
        assert_eq!(says(Manifest { runs: 11, ..mine.clone() }), "its `runs` is 10, not 11");
        assert_eq!(says(mine.of_shard(Shard { index: 2, count: 2 })), "its `shard` is 1/2, not 2/2");
        let other = Manifest { text: "seed = 1\nname = \"b\"\n".to_owned(), ..mine.clone() };
        assert_eq!(says(other), "line 2 of its file is `name = \"a\"`, not `name = \"b\"`");
        assert!(mine.difference("").is_some() && mine.difference("{}").is_some());
        assert_eq!(
            Manifest { file: "b.toml".to_owned(), ..mine }.difference(&file),
            None,
            "a name decides nothing"
        );
    }

    #[test]
    fn a_manifest_is_read_back_and_nothing_else_is() {
        let file = mine().to_json();
        assert_eq!(Manifest::read(&file), Some(mine()));
        for wrong in
            ["", "{}", "[]", &file.replace("\"10\"", "\"0\""), &file.replace("1/2", "3/2"), &file[..40]]
        {
            assert_eq!(Manifest::read(wrong), None, "{wrong}");
        }
        assert_eq!(Manifest::read(&file.replace("file", "flie")).unwrap().file, "FILE");
    }
}
