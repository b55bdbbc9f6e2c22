//! docs/reliability.md says how often each target was tried, as fuzz/executions.txt counts it.
//!
//! After new runs of `examples/fuzz.rs`, here or in crates/node, the table is made again by
//!
//! ```sh
//! MAKE=1 cargo test -p closeranks-checks --test executions
//! ```
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::path::{Path, PathBuf};

const BEGIN: &str = "<!-- executions -->\n";
const END: &str = "<!-- end of executions -->";

fn file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

/// What the bytes of a target stand for.
fn about(target: &str) -> &'static str {
    match target {
        "message" => "messages of 32 bytes",
        "link_message" => "messages of `links`",
        "robot" => "any calls of a robot in any order",
        "scenario" => "scenarios in TOML, with sweeps, and their runs",
        "scenario_text" => "scenarios in TOML, read once",
        "graph" => "graphs, in every format, read and written again",
        "graph_text" => "graphs, in the format that is found, read once",
        target if target.starts_with("certificate_") => "certificates of this claim",
        "recording" => "recordings in Parquet",
        "node_envelope" => "envelopes of `closeranks-node`, before the signature",
        "node_report" => "reports of `closeranks-node`",
        "node_look" => "what a plant shows a robot",
        "node_proof" => "proofs of two faces",
        "ros_pose" => "`geometry_msgs/PoseStamped`",
        "ros_odometry" => "`nav_msgs/Odometry`",
        "ros_twist" => "`geometry_msgs/Twist` and `TwistStamped`",
        _ => "graphs in one format",
    }
}

/// 1,234,567.
fn grouped(digits: &str) -> String {
    let groups: Vec<&[u8]> = digits.as_bytes().rchunks(3).rev().collect();
    groups.iter().map(|group| str::from_utf8(group).unwrap()).collect::<Vec<_>>().join(",")
}

fn table() -> String {
    let counts = fs::read_to_string(file("fuzz/executions.txt")).unwrap();
    let row = |line: &str| {
        let (target, count) = line.split_once(' ').unwrap();
        format!("| `{target}` | {} | {} |\n", about(target), grouped(count))
    };
    let rows: String = counts.lines().map(row).collect();
    format!("\n| target | what is read | executions |\n| --- | --- | ---: |\n{rows}\n")
}

#[test]
fn the_page_says_how_often_each_target_was_tried() {
    let path = file("docs/reliability.md");
    let page = fs::read_to_string(&path).unwrap();
    let (before, rest) = page.split_once(BEGIN).unwrap();
    let (said, after) = rest.split_once(END).unwrap();
    if std::env::var_os("MAKE").is_some() {
        fs::write(path, format!("{before}{BEGIN}{}{END}{after}", table())).unwrap();
    } else {
        assert_eq!(said, table(), "MAKE=1 makes it again");
    }
}

#[test]
fn numbers_are_grouped() {
    assert_eq!(["7", "123", "1234", "1234567"].map(grouped), ["7", "123", "1,234", "1,234,567"]);
}
