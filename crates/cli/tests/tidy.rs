//! House rules that no linter knows: heads, lengths, words, and labels of the paper that are known and tested.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

const FILE_LINES: usize = 400;
const FUNCTION_LINES: usize = 60;

/// Words that have another word here, and where they may stand (quotations of the paper, graphs).
const WORDS: [(&str, &str, &[&str]); 3] =
    [("agent", "robot", &["claims.rs"]), ("vehicle", "robot", &[]), ("utilize", "use", &[])];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn rust_files(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for path in entries.map(|entry| entry.unwrap().path()) {
        if path.is_dir() {
            rust_files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Every Rust file of ours with its text.
fn sources() -> Vec<(PathBuf, String)> {
    let mut paths = Vec::new();
    for part in ["src", "tests", "benches", "examples"] {
        for entry in fs::read_dir(root().join("crates")).unwrap() {
            rust_files(&entry.unwrap().path().join(part), &mut paths);
        }
    }
    paths.sort();
    assert!(paths.len() > 50, "the tree is where it should be");
    paths.into_iter().map(|path| (path.clone(), fs::read_to_string(path).unwrap())).collect()
}

fn check(rule: &str, broken: &[String]) {
    assert!(broken.is_empty(), "{rule}:\n{}", broken.join("\n"));
}

#[test]
fn every_file_begins_by_saying_what_it_is() {
    let silent = sources().into_iter().filter(|(_, text)| !text.starts_with("//! "));
    check(
        "files without a `//!` head",
        &silent.map(|(path, _)| path.display().to_string()).collect::<Vec<_>>(),
    );
}

#[test]
fn files_and_functions_stay_small() {
    let mut long = Vec::new();
    for (path, text) in sources() {
        let lines: Vec<&str> = text.lines().collect();
        if lines.len() > FILE_LINES {
            long.push(format!("{}: {} lines", path.display(), lines.len()));
        }
        for (start, length) in functions(&lines) {
            if length > FUNCTION_LINES {
                long.push(format!("{}:{}: a function of {length} lines", path.display(), start + 1));
            }
        }
    }
    check("too long", &long);
}

/// First line and length of each function: rustfmt closes it at the indentation it began with.
fn functions(lines: &[&str]) -> Vec<(usize, usize)> {
    let begins = |line: &str| {
        let words = line.trim_start();
        let words = words.strip_prefix("pub(crate) ").or(words.strip_prefix("pub(super) ")).unwrap_or(words);
        let words = words.strip_prefix("pub ").unwrap_or(words);
        words.strip_prefix("const ").unwrap_or(words).starts_with("fn ")
    };
    let mut found = Vec::new();
    for (start, line) in lines.iter().enumerate().filter(|(_, line)| begins(line)) {
        let closing = format!("{}}}", &line[..line.len() - line.trim_start().len()]);
        let length = lines[start..].iter().position(|line| *line == closing || line.ends_with(';'));
        let whole = lines[start..].iter().position(|line| *line == closing).map_or(1, |end| end + 1);
        found.push((start, if length == Some(0) { 1 } else { whole }));
    }
    found
}

#[test]
fn one_word_per_idea() {
    let mut found = Vec::new();
    for (path, text) in sources() {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default().to_owned();
        for (word, instead, allowed) in WORDS {
            let here =
                name != "tidy.rs" && !allowed.contains(&name.as_str()) && text.to_lowercase().contains(word);
            if here {
                found.push(format!("{}: `{word}`, say `{instead}`", path.display()));
            }
        }
    }
    check("words", &found);
}

/// Labels cited after `//= paper `, by whether the citation is a test's.
fn cited(test: bool) -> BTreeSet<String> {
    let mut labels = BTreeSet::new();
    for (_, text) in sources() {
        for line in text.lines().filter_map(|line| line.trim_start().strip_prefix("//= paper ")) {
            let (label, rest) = line.split_once(' ').unwrap_or((line, ""));
            if (rest == "type=test") == test {
                labels.insert(label.to_owned());
            }
        }
    }
    labels
}

#[test]
fn labels_are_known_and_tested() {
    let notation = fs::read_to_string(root().join("NOTATION.md")).unwrap();
    let (code, tests) = (cited(false), cited(true));
    let unknown = code.union(&tests).filter(|label| !notation.contains(label.as_str()));
    check("labels that NOTATION.md does not have", &unknown.cloned().collect::<Vec<_>>());
    check("labels without a test", &code.difference(&tests).cloned().collect::<Vec<_>>());
}

#[test]
fn the_paper_has_the_labels() {
    let Ok(paper) = fs::read_to_string(root().join("../shared/paper/paper.tex")) else { return };
    let missing = cited(false).union(&cited(true)).cloned().collect::<Vec<_>>();
    let missing = missing.into_iter().filter(|label| !paper.contains(&format!("\\label{{{label}}}")));
    check("labels that the paper does not have", &missing.collect::<Vec<_>>());
}
