//! House rules that no linter knows: heads and lengths, words, seams, imports, and what is cited: labels, pages and paths.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

#[path = "tidy/imports.rs"]
mod imports;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

const FILE_LINES: usize = 400;
const FUNCTION_LINES: usize = 60;
/// Rust files side by side in one folder of a `src`.
const FOLDER_FILES: usize = 14;

/// Words that have another word here, and where they may stand (quotations of the paper).
const WORDS: [(&str, &str, &[&str]); 3] =
    [("agent", "robot", &["claims.rs"]), ("vehicle", "robot", &[]), ("utilize", "use", &[])];

/// Names that were replaced and must not come back, the name of today, and files in which the old one is another idea.
const NAMES: [(&str, &str, &[&str]); 14] = [
    ("allies", "team", &[]),
    ("Allies", "Team", &[]),
    ("allowance", "control", &[]),
    ("Honesty", "ModeWatch", &[]),
    ("honesty", "mode", &[]),
    ("high_at_least", "high_lower_bound", &[]),
    ("Margin", "ErrorBounds", &[]),
    ("Promise", "Carry", &[]),
    ("refusal", "error", &[]),
    ("spares", "h", &[]),
    ("Tie", "Pair", &[]),
    ("ties", "pairs", &[]),
    ("Voices", "Heard", &[]),
    ("worth", "discounted_claim", &["additions.rs", "grow.rs"]),
];

/// Working papers of the project, which a reader of the repository does not have: as words, and as parts of names.
const PAGES: [&str; 5] = ["METHOD", "THEORY", "PEERS", "RANKS", "WISHES"];
const PAGE_FILES: [&str; 7] =
    ["DESIGN.md", "ROBUSTNESS.md", "LINKS.md", "STYLE.md", "DEPENDENCIES.md", "DEPLOYMENT.md", "shared/"];
/// The paper, read by tests where it is there.
const PAPER: &str = "shared/paper/paper.tex";

/// Where a controller may be told by its kind or name: the seam itself, and tests.
const SEAM: [&str; 4] = [
    "crates/checks/",
    "crates/core/src/controller/",
    "crates/core/src/settings/",
    "crates/sim/src/controllers/",
];

/// Lines that look like such a choice and are none, by file and a part of the line. Each needs a reason.
const NO_CHOICE: [(&str, &str); 2] = [
    // The runs of one sweep are told apart, whatever their controllers are.
    ("crates/sim/src/sweep/mod.rs", ".controller == controller"),
    ("crates/report/src/sweep/tally.rs", ".controller == controller"),
];

/// Folders with files that we did not write.
const FOREIGN: [&str; 3] = ["target", "corpus", "node_modules"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// Files below `folder` with one of the endings; nothing hidden and nothing built.
fn files(folder: &Path, endings: &[&str], found: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for path in entries.map(|entry| entry.unwrap().path()) {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        if path.is_dir() && !name.starts_with('.') && !FOREIGN.contains(&name) {
            files(&path, endings, found);
        } else if path.extension().is_some_and(|found| endings.iter().any(|ending| found == *ending)) {
            found.push(path);
        }
    }
}

/// Every file of ours with one of the endings: its path from the root, and its text.
fn texts(endings: &[&str]) -> Vec<(String, String)> {
    let (root, mut paths) = (root(), Vec::new());
    files(&root, endings, &mut paths);
    paths.sort();
    let text = |path: &PathBuf| {
        let name = path.strip_prefix(&root).unwrap().to_str().unwrap().replace('\\', "/");
        (name, fs::read_to_string(path).unwrap())
    };
    paths.iter().map(text).collect()
}

/// Every Rust file of ours with its text.
fn sources() -> Vec<(String, String)> {
    let sources = texts(&["rs"]);
    assert!(sources.len() > 50, "the tree is where it should be");
    sources
}

fn is_rust(path: &str) -> bool {
    Path::new(path).extension().is_some_and(|ending| ending == "rs")
}

fn file_name(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path)
}

/// The lines that are code, with their numbers and without comments.
fn code(text: &str) -> impl Iterator<Item = (usize, &str)> {
    (1..).zip(text.lines().map(|line| line.split_once("//").map_or(line, |(code, _)| code)))
}

/// The runs of letters, digits and `also` in `text`.
fn words<'a>(text: &'a str, also: &'static str) -> impl Iterator<Item = &'a str> {
    text.split(move |c: char| !c.is_alphanumeric() && !also.contains(c)).filter(|word| !word.is_empty())
}

fn check(rule: &str, broken: &[String]) {
    assert!(broken.is_empty(), "{rule}:\n{}", broken.join("\n"));
}

#[test]
fn every_file_begins_by_saying_what_it_is() {
    let silent = sources().into_iter().filter(|(_, text)| !text.starts_with("//! "));
    check("files without a `//!` head", &silent.map(|(path, _)| path).collect::<Vec<_>>());
}

#[test]
fn files_functions_and_folders_stay_small() {
    let mut long = Vec::new();
    let mut folders: BTreeMap<String, usize> = BTreeMap::new();
    for (path, text) in sources() {
        let lines: Vec<&str> = text.lines().collect();
        if lines.len() > FILE_LINES {
            long.push(format!("{path}: {} lines", lines.len()));
        }
        for (start, length) in functions(&lines) {
            if length > FUNCTION_LINES {
                long.push(format!("{path}:{}: a function of {length} lines", start + 1));
            }
        }
        if let Some((folder, _)) = path.rsplit_once('/').filter(|(folder, _)| folder.contains("/src")) {
            *folders.entry(folder.to_owned()).or_default() += 1;
        }
    }
    let full = folders.iter().filter(|(_, count)| **count > FOLDER_FILES);
    long.extend(full.map(|(folder, count)| format!("{folder}: {count} files side by side")));
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
    for (path, text) in sources().iter().filter(|(path, _)| file_name(path) != "tidy.rs") {
        let name = file_name(path);
        for (word, instead, allowed) in WORDS {
            if !allowed.contains(&name) && text.to_lowercase().contains(word) {
                found.push(format!("{path}: `{word}`, say `{instead}`"));
            }
        }
        for (number, line) in code(text) {
            // What stands in quotes is text for people.
            let names: BTreeSet<&str> =
                line.split('"').step_by(2).flat_map(|code| words(code, "_")).collect();
            for (old, instead, _) in
                NAMES.iter().filter(|(old, _, allowed)| names.contains(old) && !allowed.contains(&name))
            {
                found.push(format!("{path}:{number}: `{old}`, say `{instead}`"));
            }
        }
    }
    check("words", &found);
}

/// A controller differs from others by its row in `sim/src/controllers` and by its methods, never by `if` and `match` elsewhere.
#[test]
fn nobody_asks_which_controller_it_is() {
    let (mut found, mut excused) = (Vec::new(), BTreeSet::new());
    for (path, text) in sources() {
        if !path.contains("/src/") || SEAM.iter().any(|seam| path.starts_with(seam)) {
            continue;
        }
        let tests = text.find("#[cfg(test)]").unwrap_or(text.len());
        for (number, line) in code(&text[..tests]).filter(|(_, line)| chooses(line)) {
            match NO_CHOICE.iter().find(|(file, part)| path == *file && line.contains(part)) {
                Some(excuse) => _ = excused.insert(excuse),
                None => found.push(format!("{path}:{number}: {}", line.trim())),
            }
        }
    }
    check(
        "a choice by the kind or name of a controller (add a column to sim/src/controllers instead)",
        &found,
    );
    assert_eq!(excused.len(), NO_CHOICE.len(), "excuses that are needed: {excused:?}");
}

/// True if the line compares or matches the kind or the name of a controller.
fn chooses(line: &str) -> bool {
    // What follows `.controller.` is asked of its row.
    let field = |part: &str| part.split(".controller").skip(1).any(|rest| rest.starts_with([' ', ')', ',']));
    let kind = |part: &str| part.contains("Controller::") || field(part);
    let name = |part: &str| ["\"budget\"", "\"composed\""].iter().any(|name| part.contains(name));
    let none = |part: &str| part.contains("\"none\"");
    let compares = line.contains("==") || line.contains("!=") || line.contains("matches!");
    let pattern = line.split_once("=>").map_or("", |(pattern, _)| pattern);
    let lets = line.contains("if let ") || line.contains("let Some") || line.contains(" else {");
    line.contains("AnyController::")
        || (compares && (kind(line) || name(line) || none(line)))
        || pattern.contains("Controller::")
        || name(pattern)
        || (line.contains("match ") && line.contains(".controller {"))
        || (lets && line.contains("Controller::"))
        || ["get(\"budget\")", "get(\"composed\")"].iter().any(|look_up| line.contains(look_up))
}

/// Citations `//= paper LABEL` and `//= theory LABEL`, without and with `type=test`. Each is a kind and a label.
fn cited() -> [BTreeSet<(String, String)>; 2] {
    let mut found = [BTreeSet::new(), BTreeSet::new()];
    for (_, text) in sources() {
        for line in text.lines().filter_map(|line| line.trim_start().strip_prefix("//= ")) {
            let mut parts = line.split(' ');
            let [kind, label] = [(); 2].map(|()| parts.next().unwrap_or_default().to_owned());
            found[usize::from(parts.next() == Some("type=test"))].insert((kind, label));
        }
    }
    found
}

/// Labels of docs/theory: `**[eq:far]**` is where one stands.
fn theory() -> Vec<String> {
    let pages = texts(&["md"]).into_iter().filter(|(path, _)| path.starts_with("docs/theory/"));
    let labels = |(_, text): (String, String)| {
        let parts = text.split("**[").skip(1).filter_map(|part| part.split_once("]**"));
        parts.map(|(label, _)| label.to_owned()).collect::<Vec<_>>()
    };
    pages.flat_map(labels).collect()
}

/// Everything in `text` that has the form of a label.
fn labels(text: &str) -> impl Iterator<Item = &str> {
    let kinds = ["eq:", "seq:", "thm:", "lem:", "def:", "sec:", "fig:"];
    let words = words(text, "_:-").map(|word| word.trim_end_matches([':', '-']));
    words.filter(move |word| kinds.iter().any(|kind| word.len() > kind.len() && word.starts_with(kind)))
}

fn notation() -> String {
    fs::read_to_string(root().join("NOTATION.md")).unwrap()
}

#[test]
fn labels_are_known_and_tested() {
    let (notation, theory, [code, tests]) = (notation(), theory(), cited());
    let known = |(kind, label): &(String, String)| match kind.as_str() {
        "paper" => notation.contains(label.as_str()),
        "theory" => theory.contains(label),
        _ => false,
    };
    let said = |(kind, label): &(String, String)| format!("//= {kind} {label}");
    let unknown = code.union(&tests).filter(|citation| !known(citation));
    check(
        "labels that neither NOTATION.md (paper) nor docs/theory has",
        &unknown.map(said).collect::<Vec<_>>(),
    );
    check("labels without a test", &code.difference(&tests).map(said).collect::<Vec<_>>());
    let twice = theory.iter().filter(|label| theory.iter().filter(|other| other == label).count() > 1);
    check("labels that stand twice in docs/theory", &twice.cloned().collect::<Vec<_>>());
}

#[test]
fn labels_in_sentences_are_known() {
    let (notation, theory) = (notation(), theory());
    let known: BTreeSet<&str> = labels(&notation).chain(theory.iter().map(String::as_str)).collect();
    let mut found = Vec::new();
    for (path, text) in texts(&["rs", "md", "toml"]) {
        let unknown: BTreeSet<&str> = labels(&text).filter(|label| !known.contains(label)).collect();
        found.extend(unknown.iter().map(|label| format!("{path}: {label}")));
    }
    check("labels that neither NOTATION.md nor docs/theory has", &found);
}

#[test]
fn the_paper_has_the_labels() {
    let Ok(paper) = fs::read_to_string(root().join("..").join(PAPER)) else { return };
    let (notation, theory) = (notation(), theory());
    let ours = |label: &str| theory.iter().any(|ours| ours == label);
    let cited = cited().into_iter().flatten().filter(|(kind, _)| kind == "paper").map(|(_, label)| label);
    let listed = labels(&notation).filter(|label| !ours(label)).map(str::to_owned);
    let missing: BTreeSet<String> = cited.chain(listed).collect();
    let missing = missing.into_iter().filter(|label| !paper.contains(&format!("\\label{{{label}}}")));
    check("labels that the paper does not have", &missing.collect::<Vec<_>>());
}

/// What a comment or a page refers to must be here to be read.
#[test]
fn nothing_cites_a_page_outside_the_repository() {
    let mut found = Vec::new();
    for (path, text) in texts(&["rs", "md", "toml", "sh", "py", "css", "html"]) {
        if file_name(&path) == "tidy.rs" {
            continue;
        }
        for (number, line) in (1..).zip(text.lines()) {
            let line = line.replace(PAPER, "");
            let page = words(&line, "_").any(|word| PAGES.contains(&word));
            if page || PAGE_FILES.iter().any(|file| line.contains(file)) {
                found.push(format!("{path}:{number}: {}", line.trim()));
            }
        }
    }
    check("pages that are not in the repository (cite a label of docs/theory)", &found);
}

/// Paths in pages: `crates/...` as they are, and in NOTATION.md without `crates/` and `src/`.
#[test]
fn paths_in_pages_are_there() {
    let root = root();
    let mut found = Vec::new();
    for (page, text) in texts(&["md"]).into_iter().filter(|(page, _)| page != "CHANGELOG.md") {
        for path in words(&text, "/._-*").map(|path| path.trim_end_matches(['.', '/'])) {
            let inside = path.split_once('/').filter(|_| page == "NOTATION.md" && is_rust(path));
            let full = match inside {
                _ if path.starts_with("crates/") => path.to_owned(),
                Some((name, rest)) => format!("crates/{name}/src/{rest}"),
                None => continue,
            };
            if !full.contains('*') && !root.join(&full).exists() {
                found.push(format!("{page}: {path}"));
            }
        }
    }
    check("paths that are not there", &found);
}
