//! One version for all that is published: crates, their dependencies on each other, CHANGELOG and CITATION.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::path::Path;

fn read(name: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name)).unwrap()
}

#[test]
fn every_file_names_the_same_version() {
    let version = env!("CARGO_PKG_VERSION");
    let manifest = read("Cargo.toml");
    for name in ["core", "graph", "sim", "report"] {
        let line = format!("closeranks-{name} = {{ path = \"crates/{name}\", version = \"{version}\" }}\n");
        assert!(manifest.contains(&line), "Cargo.toml must have {line}");
        assert!(read(&format!("crates/{name}/Cargo.toml")).contains("\nversion.workspace = true\n"));
    }
    assert!(read("CHANGELOG.md").contains(&format!("\n## {version}")));
    assert!(read("CITATION.cff").contains(&format!("\nversion: {version}\n")));
}
