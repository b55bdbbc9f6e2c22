//! What a folder says of the sweep in it: a command goes on only with its own.

use serde_json::{Value, json};

use super::shard::Shard;

/// All that decides the rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Manifest<'a> {
    /// The file with draws.
    pub(crate) text: &'a str,
    /// Seed of the sweep.
    pub(crate) seed: u64,
    /// Runs of all shards.
    pub(crate) runs: u64,
    /// Our part.
    pub(crate) shard: Shard,
}

impl Manifest<'_> {
    /// As pairs of key and text; the sweep file last.
    pub(crate) fn pairs(&self) -> [(&'static str, String); 6] {
        [
            ("seed", self.seed.to_string()),
            ("runs", self.runs.to_string()),
            ("shard", self.shard.to_string()),
            ("version", env!("CARGO_PKG_VERSION").to_owned()),
            ("commit", env!("CLOSERANKS_COMMIT").to_owned()),
            ("sweep", self.text.to_owned()),
        ]
    }

    /// True if `pairs`, of a file of rows, are those of this sweep.
    pub(crate) fn is_of(&self, pairs: &[(String, String)]) -> bool {
        let mine = self.pairs();
        mine.len() == pairs.len()
            && mine.iter().all(|(key, text)| pairs.contains(&((*key).to_owned(), text.clone())))
    }

    /// As a file.
    pub(crate) fn to_json(&self) -> String {
        let pairs = self.pairs().map(|(key, value)| (key.to_owned(), json!(value)));
        format!("{:#}\n", Value::Object(pairs.into_iter().collect()))
    }

    /// What `file` says otherwise, in words; none if it is of this sweep.
    pub(crate) fn difference(&self, file: &str) -> Option<String> {
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

    #[test]
    fn a_manifest_knows_its_own_and_names_what_differs() {
        let shard = Shard { index: 1, count: 2 };
        let mine = Manifest { text: "seed = 1\nname = \"a\"\n", seed: 7, runs: 10, shard };
        let file = mine.to_json();
        assert_eq!(mine.difference(&file), None);
        let says = |other: Manifest<'_>| other.difference(&file).unwrap();
        assert_eq!(says(Manifest { seed: 8, ..mine.clone() }), "its `seed` is 7, not 8");
        assert_eq!(says(Manifest { runs: 11, ..mine.clone() }), "its `runs` is 10, not 11");
        assert_eq!(
            says(Manifest { shard: Shard { index: 2, count: 2 }, ..mine.clone() }),
            "its `shard` is 1/2, not 2/2"
        );
        let other = Manifest { text: "seed = 1\nname = \"b\"\n", ..mine.clone() };
        assert_eq!(says(other), "line 2 of its file is `name = \"a\"`, not `name = \"b\"`");
        assert!(mine.difference("").is_some() && mine.difference("{}").is_some());
    }
}
