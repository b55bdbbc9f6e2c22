//! Notes which commit is built, so that every record says where it came from. Programs take it from this crate.

use std::process::Command;

/// What the program is made of.
const SOURCES: [&str; 7] =
    ["../core/src", "../graph/src", "../sim/src", "../mcap/src", "../report/src", "../cli/src", "src"];

fn main() {
    println!("cargo:rerun-if-changed=../../.git/HEAD");
    println!("cargo:rerun-if-changed=../../.git/logs/HEAD");
    for folder in SOURCES {
        println!("cargo:rerun-if-changed={folder}");
    }
    let head = Command::new("git").args(["rev-parse", "--short=12", "HEAD"]).output();
    let commit = head.ok().filter(|output| output.status.success()).map(|output| output.stdout);
    let commit = commit.and_then(|bytes| String::from_utf8(bytes).ok()).unwrap_or_default();
    let commit = if commit.trim().is_empty() { "unknown" } else { commit.trim() };
    let changed = if is_changed() { "-changed" } else { "" };
    println!("cargo:rustc-env=CLOSERANKS_COMMIT={commit}{changed}");
}

/// True if what is built is not what was committed.
fn is_changed() -> bool {
    let mut status = Command::new("git");
    status.args(["status", "--porcelain", "--untracked-files=no", "--"]);
    let output = status.args(["../../Cargo.toml", "../../Cargo.lock"]).args(SOURCES).output();
    output.is_ok_and(|output| output.status.success() && !output.stdout.is_empty())
}
