//! Which file of a crate imports from which, and that no files import from each other in a circle.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use super::{check, code, sources};

/// A module by its path in its crate: `[]` is the root, `["num", "scaled"]` is `num/scaled.rs`.
type Module = Vec<String>;

/// Which files import from which, each by its place in the list of files.
type Imports = BTreeMap<usize, BTreeSet<usize>>;

/// Two files that need each other can be read only together. What both need belongs in a file below them.
///
/// The head of a folder, `mod.rs`, may use the files of the folder and hand them on, and each of these may use what the head says
/// for all of them: such pairs are no circle. Tests at the end of a file may import what they like.
#[test]
fn no_files_import_each_other_in_a_circle() {
    let mut crates: BTreeMap<String, Vec<(String, String)>> = BTreeMap::new();
    for (path, text) in sources() {
        if let Some((folder, file)) = path.split_once("/src/") {
            crates.entry(folder.to_owned()).or_default().push((file.to_owned(), text));
        }
    }
    let mut found = Vec::new();
    for (folder, files) in crates {
        found.extend(circles(&files).iter().map(|circle| format!("{folder}/src: {}", circle.join(" -> "))));
    }
    check(
        "files that import from each other in a circle (move what they share to a file below them)",
        &found,
    );
}

/// For each set of files that reach each other by imports a shortest circle; its last file is its first.
fn circles(files: &[(String, String)]) -> Vec<Vec<&str>> {
    let imports = imports(files);
    let (mut done, mut found) = (BTreeSet::new(), Vec::new());
    for start in 0..files.len() {
        if done.contains(&start) {
            continue;
        }
        if let Some(circle) = circle(&imports, start) {
            let reached = reached(&imports, start);
            done.extend(reached.into_iter().filter(|place| self::reached(&imports, *place).contains(&start)));
            found.push(circle.iter().map(|place| files[*place].0.as_str()).collect());
        }
    }
    found
}

/// The files that a file imports from, and those that these import from, and so on.
fn reached(imports: &Imports, start: usize) -> BTreeSet<usize> {
    let (mut reached, mut next) = (BTreeSet::new(), vec![start]);
    while let Some(place) = next.pop() {
        next.extend(imports[&place].iter().filter(|place| reached.insert(**place)));
    }
    reached
}

/// A shortest way along imports from a file back to it.
fn circle(imports: &Imports, start: usize) -> Option<Vec<usize>> {
    let (mut ways, mut seen) = (VecDeque::from([vec![start]]), BTreeSet::new());
    while let Some(way) = ways.pop_front() {
        for place in &imports[way.last()?] {
            let longer = [way.as_slice(), &[*place]].concat();
            if *place == start {
                return Some(longer);
            }
            if seen.insert(*place) {
                ways.push_back(longer);
            }
        }
    }
    None
}

fn imports(files: &[(String, String)]) -> Imports {
    let modules: Vec<Module> = files.iter().map(|(file, _)| module(file)).collect();
    let places: BTreeMap<&[String], usize> = modules.iter().map(Vec::as_slice).zip(0..).collect();
    let of = |place: usize| {
        let own = &modules[place];
        let whole = paths(&files[place].1).into_iter().filter_map(|path| from_root(own, &path, &places));
        // The longest beginning of a path that is a file; what follows is a name in it.
        let file = |path: Module| (0..=path.len()).rev().find_map(|end| places.get(&path[..end]).copied());
        let is_head = |other: &usize| own.starts_with(&modules[*other]);
        whole.filter_map(file).filter(|other| !is_head(other)).collect()
    };
    (0..files.len()).map(|place| (place, of(place))).collect()
}

/// The module that a file of `src` is.
fn module(file: &str) -> Module {
    let mut names: Module = file.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
    if names.last().is_some_and(|name| ["mod", "lib", "main"].contains(&name.as_str())) {
        names.pop();
    }
    names
}

/// A path in the module `own`, from the root of the crate on; `None` if it is one of another crate or of a name.
fn from_root(own: &[String], path: &[&str], places: &BTreeMap<&[String], usize>) -> Option<Module> {
    let ups = path.iter().take_while(|name| **name == "super").count();
    let below = |start: &[String], rest: &[&str]| {
        start.iter().cloned().chain(rest.iter().map(|name| (*name).to_owned())).collect::<Module>()
    };
    match path[0] {
        "crate" => Some(below(&[], &path[1..])),
        "super" => Some(below(own.get(..own.len().checked_sub(ups)?)?, &path[ups..])),
        "self" => Some(below(own, &path[1..])),
        child => Some(below(own, path)).filter(|_| places.contains_key(below(own, &[child]).as_slice())),
    }
}

/// Every path of two names or more in the code of `text`: `use a::{b, c::d}` has `a::b` and `a::c::d`.
fn paths(text: &str) -> Vec<Vec<&str>> {
    let tests = text.find("#[cfg(test)]\nmod tests").unwrap_or(text.len());
    let (mut found, mut before): (Vec<Vec<&str>>, Vec<Vec<&str>>) = (Vec::new(), Vec::new());
    // What stands in quotes is text for people.
    let parts = code(&text[..tests]).flat_map(|(_, line)| line.split('"').step_by(2));
    let is_name = |c: char| c.is_alphanumeric() || "_:".contains(c);
    for part in parts.flat_map(|part| part.split_inclusive(|c| !is_name(c))) {
        let word = part.trim_end_matches(|c| !is_name(c));
        let mut path = before.last().cloned().unwrap_or_default();
        path.extend(word.split("::").filter(|name| !name.is_empty()));
        if part.ends_with('{') {
            before.push(if word.ends_with("::") { path.clone() } else { Vec::new() });
        }
        if !word.is_empty() && !word.ends_with("::") && path.len() > 1 {
            found.push(path);
        }
        if part.ends_with('}') {
            before.pop();
        }
    }
    found
}

fn circles_of(files: &[(&str, &str)]) -> Vec<String> {
    let files: Vec<(String, String)> =
        files.iter().map(|(file, text)| ((*file).to_owned(), (*text).to_owned())).collect();
    circles(&files).iter().map(|circle| circle.join(" -> ")).collect()
}

#[test]
fn a_circle_is_found_however_it_is_written() {
    let lib = ("lib.rs", "pub mod a;\npub mod b;\nmod c;\npub use a::x;\n");
    let written = [
        "use crate::a::x;",
        "use crate::{b::y, a::{x, z}};",
        "fn y() { super::super::a::x() }",
        "use super::super::a;",
        "fn y() { crate::a::X { y: 1 } }",
    ];
    for c in written {
        let files = [
            lib,
            ("a.rs", "use crate::b::y;\n"),
            ("b/mod.rs", "mod c;\nfn y() { c::y(\"a\") }\n"),
            ("b/c.rs", c),
        ];
        assert_eq!(circles_of(&files), ["a.rs -> b/mod.rs -> b/c.rs -> a.rs"], "{c}");
    }
}

#[test]
fn what_is_no_circle_is_not_called_one() {
    let lib = ("lib.rs", "pub mod a;\npub mod b;\npub use a::x;\n");
    let tests = "use crate::num;\n#[cfg(test)]\nmod tests {\n    use crate::a::x;\n}\n";
    let quoted = "fn y() { print(\"crate::a::x\") } // crate::a::x\nuse other::a::x;\n";
    for b in [tests, quoted, "use crate::Root;\n"] {
        assert_eq!(circles_of(&[lib, ("a.rs", "use crate::b::y;\n"), ("b.rs", b)]), [""; 0], "{b}");
    }
    let two =
        [("a.rs", "use crate::b::y;\n"), ("b.rs", "use crate::a::x;\n"), ("c.rs", "use crate::d::{x};\n")];
    let more = [two.as_slice(), &[("d.rs", "use super::c::x;\n")]].concat();
    assert_eq!(circles_of(&more), ["a.rs -> b.rs -> a.rs", "c.rs -> d.rs -> c.rs"]);
}
