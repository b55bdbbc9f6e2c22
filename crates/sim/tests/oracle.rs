//! The oracle bites: controllers with one line broken are caught by the campaign, each by the law that is there for it.
//!
//! Every mutant is the real source with a line replaced, built beside the target folder, and let run on
//! `scenarios/campaign.toml` (`examples/hunt.rs`). A line that is no longer there fails the test, so that mutants keep up
//! with the code.
//!
//! It takes minutes, because it builds some twenty programs, each from what it shares with the one before. By itself:
//!
//! ```sh
//! cargo test -p closeranks-sim --test oracle -- --nocapture                        # says who is found when
//! MUTANT="near rows" cargo test -p closeranks-sim --test oracle -- --nocapture     # some of them
//! ```
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Runs that a mutant may survive.
const RUNS: &str = "2000";
const SEED: &str = "7";

/// A broken program: what is wrong, the law that must notice, and the lines that are other than they should be.
struct Mutant {
    name: &'static str,
    law: &'static str,
    lines: &'static [(&'static str, &'static str, &'static str)],
}

const TICK: &str = "core/src/controller/budget/mod.rs";
const CONTROL: &str = "core/src/controller/budget/control.rs";
const PROTOCOL: &str = "core/src/controller/links/protocol.rs";
const POLICY: &str = "core/src/controller/links/policy.rs";
const ROWS: &str = "core/src/controller/links/rows.rs";
const LINKS: &str = "core/src/controller/links/control.rs";
const INEQUALITY: &str = "core/src/controller/budget/inequality.rs";

const MUTANTS: [Mutant; 33] = [
    Mutant {
        name: "gradient with the wrong sign",
        law: "decay",
        lines: &[(
            TICK,
            "add_scaled(&own.gradient, 1.0, &gradient)",
            "add_scaled(&own.gradient, -1.0, &gradient)",
        )],
    },
    Mutant {
        name: "share doubled",
        law: "spare",
        lines: &[
            (
                INEQUALITY,
                "self.loss_max(known.budget) / (known.degree_max + 1.0)",
                "self.loss_max(known.budget) / 2.0",
            ),
            (
                INEQUALITY,
                "self.loss_max(own.h.max(0.0)) / (own.degree + 1.0)",
                "self.loss_max(own.h.max(0.0)) / 2.0",
            ),
        ],
    },
    Mutant {
        name: "|v|² left out of (far')",
        law: "decay",
        lines: &[(INEQUALITY, "-component), bend, spend)", "-component), 0.0 * bend, spend)")],
    },
    Mutant {
        name: "no row of its own",
        law: "spare",
        lines: &[(
            TICK,
            "        if self.form() == Form::Level {\n            let spend",
            "        if false {\n            let spend",
        )],
    },
    Mutant {
        name: "L at the wrong distance",
        law: "decay",
        lines: &[(
            "core/src/controller/budget/curvature.rs",
            "distance_m + (2.0 * move_max_m + error_m)",
            "0.5 * distance_m",
        )],
    },
    Mutant {
        name: "stale levels not discounted",
        law: "decay",
        lines: &[(
            "core/src/controller/budget/knowledge.rs",
            "ticks => self.decayed(larger(spare, 0.0), ticks)",
            "_ => larger(spare, 0.0)",
        )],
    },
    Mutant {
        name: "age from receipt",
        law: "decay",
        lines: &[(CONTROL, "checked_since(told.stamp)", "checked_since(told.at)")],
    },
    Mutant {
        name: "claims not cut, budgets fourfold",
        law: "spare",
        lines: &[(
            "core/src/controller/budget/knowledge.rs",
            "budget: larger(believed, 0.0),",
            "budget: 4.0 * larger(believed, 0.0) + 1.0,",
        )],
    },
    Mutant {
        name: "near rows give too much",
        law: "path",
        lines: &[(
            INEQUALITY,
            "0.5 * self.gamma_c * larger(spare_m2, 0.0)",
            "2.0 * self.gamma_c * larger(spare_m2, 0.0) + 0.05",
        )],
    },
    Mutant {
        name: "no near rows",
        law: "distance",
        lines: &[(TICK, "            self.push_near(neighbor, rows);\n", "")],
    },
    Mutant {
        name: "rows left out where robots can break them",
        law: "decay",
        lines: &[("core/src/program/balls/reach.rs", "most * SURELY", "0.2 * most")],
    },
    Mutant {
        name: "a warm start that nobody checks",
        law: "decay",
        lines: &[(
            "core/src/program/balls/warm_start.rs",
            " && self.rows().iter().all(|row| row.holds(&v))",
            "",
        )],
    },
    Mutant {
        name: "no margin for distances",
        law: "distance",
        lines: &[
            (TICK, "self.spare_m2(neighbor.pair, -error_m)", "self.spare_m2(neighbor.pair, 0.0)"),
            (INEQUALITY, "self.spare_m2(&pair, -error_m)", "self.spare_m2(&pair, 0.0)"),
        ],
    },
    Mutant {
        name: "F - 1 values trimmed",
        law: "interval",
        lines: &[(
            "core/src/wmsr.rs",
            "(smaller.min(usize::from(faults)), larger.min(usize::from(faults)))",
            "(smaller.min(usize::from(faults).saturating_sub(1)), larger.min(usize::from(faults).saturating_sub(1)))",
        )],
    },
    Mutant {
        name: "two more values trimmed",
        law: "agreement",
        lines: &[(
            "core/src/wmsr.rs",
            "(smaller.min(usize::from(faults)), larger.min(usize::from(faults)))",
            "(smaller.min(usize::from(faults) + 2), larger.min(usize::from(faults) + 2))",
        )],
    },
    Mutant {
        name: "the box forgotten",
        law: "input",
        lines: &[(
            CONTROL,
            "velocity_m_s: self.input.clip(&velocity),",
            "velocity_m_s: velocity.map(|component| 1.1 * component),",
        )],
    },
    Mutant {
        name: "always guaranteed",
        law: "mode",
        lines: &[
            (CONTROL, "Some(reason) => Mode::Degraded(reason),", "Some(_) => Mode::Guaranteed,"),
            (CONTROL, "_ if degree_low => Mode::Degraded(Reason::Degree),", ""),
            (
                CONTROL,
                "None if exact && standing.h < -H_ROUNDING => Mode::Degraded(Reason::OutsideSafeSet),",
                "",
            ),
            (
                CONTROL,
                "let exact = self.budget.is_exact() && standing.missing == 0;",
                "let _ = (degree_low, H_ROUNDING);",
            ),
        ],
    },
    Mutant {
        name: "never guaranteed again",
        law: "mode",
        lines: &[(
            "core/src/robot/assurance.rs",
            "now.since(*then) <= told_max",
            "now.since(*then) <= 2 * told_max",
        )],
    },
    Mutant {
        name: "missing neighbours forgotten",
        law: "decay",
        lines: &[(
            "core/src/robot/missing.rs",
            "let missing = self.surely_holds(&slot.offset_m, gone_m);",
            "let missing = false;",
        )],
    },
    Mutant {
        name: "missing neighbours taken for those that stand still",
        law: "decay",
        lines: &[(
            "core/src/robot/missing.rs",
            "slot.unsensed_m = if missing { gone_m } else { 0.0 };",
            "slot.unsensed_m = if missing { f64::MIN_POSITIVE } else { 0.0 };",
        )],
    },
    Mutant {
        name: "neighbours in need are followed",
        law: "untowed",
        lines: &[(
            TICK,
            "        let gradient = pair.gradient(offset_m);\n",
            "        let gradient = pair.gradient(offset_m);\n        if known.budget <= 0.0 {\n            rows.desired_m = add_scaled(&rows.desired_m, -0.001, offset_m);\n        }\n",
        )],
    },
    Mutant {
        name: "budgets below 0 taken as they are",
        law: "feasible",
        lines: &[
            (INEQUALITY, "0.5 * self.gamma_c * larger(spare_m2, 0.0)", "0.5 * self.gamma_c * spare_m2"),
            ("core/src/program/balls/row.rs", "bound: (scale * bound).max(0.0),", "bound: scale * bound,"),
        ],
    },
    Mutant {
        name: "one neighbour fewer required",
        law: "degree",
        lines: &[(
            "core/src/need.rs",
            "Self { robots, each: faults.saturating_add(half) }",
            "Self { robots, each: faults.saturating_add(half).saturating_sub(1) }",
        )],
    },
    Mutant {
        name: "links: row dropped when a release is sent",
        law: "held",
        lines: &[(PROTOCOL, "self.is_listed() || !self.is_released()", "self.is_listed()")],
    },
    Mutant {
        name: "links: an older acknowledgement counts",
        law: "held",
        lines: &[(
            PROTOCOL,
            "self.listed_after.is_some_and(|after| after < self.acknowledged)",
            "self.listed_after.is_some() && self.acknowledged > self.born",
        )],
    },
    Mutant {
        name: "links: counted on without being listed",
        law: "held",
        lines: &[
            (
                PROTOCOL,
                "self.listed_after.is_some_and(|after| after < self.acknowledged)",
                "self.acknowledged > self.born",
            ),
            (POLICY, "(peer.deal.released, peer.held) = (true, false);", "peer.deal.released = true;"),
        ],
    },
    Mutant {
        name: "links: an acknowledgement is taken back",
        law: "degree",
        lines: &[(
            PROTOCOL,
            "self.acknowledged = self.acknowledged.max(acknowledged);",
            "self.acknowledged = acknowledged;",
        )],
    },
    Mutant {
        name: "links: R without the hair",
        law: "degree",
        lines: &[("core/src/controller/links/mod.rs", "const HAIR: f64 = 1e-9;", "const HAIR: f64 = 0.0;")],
    },
    Mutant {
        name: "links: held rows give too much",
        law: "held",
        lines: &[(ROWS, "0.25 * self.gamma * (self.radius_m", "0.6 * self.gamma * (self.radius_m")],
    },
    Mutant {
        name: "links: |v|² left out of (held)",
        law: "held",
        lines: &[(ROWS, "Row::far(offset, bound_m2)", "Row::new(*offset, 0.0, bound_m2)")],
    },
    Mutant {
        name: "links: one release too many",
        law: "degree",
        lines: &[(POLICY, "(!is_counted || counted > keep)", "(!is_counted || counted >= keep)")],
    },
    Mutant {
        name: "links: free liars counted as normal",
        law: "degree",
        lines: &[(
            LINKS,
            "Assume::Free => (Keep::NormalNeighbors, settings.team.faults),",
            "Assume::Free => (Keep::NormalNeighbors, 0),",
        )],
    },
    Mutant {
        name: "links: guaranteed without links that are counted on",
        law: "mode",
        lines: &[(
            LINKS,
            ".then_some(Reason::Uncounted);",
            ".then_some(Reason::Uncounted).filter(|_| false);",
        )],
    },
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The three crates that a run needs, in a workspace of their own, untouched files untouched. Programs are to be there
/// soon, not to be fast: in many units, so that what a line does not change is not built again.
fn copy(to: &Path) {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let line = |key: &str| format!("{key} = [\"crates/core\", \"crates/graph\", \"crates/sim\"]");
    let own = |text: &str| match text.split_once(" = ") {
        Some((key @ ("members" | "default-members"), _)) => line(key),
        Some((key @ ("debug" | "lto"), _)) => format!("{key} = false"),
        Some((key @ "codegen-units", _)) => format!("{key} = 256"),
        _ => text.to_owned(),
    };
    let manifest = manifest.lines().map(own).collect::<Vec<_>>().join("\n");
    put(&to.join("Cargo.toml"), manifest.as_bytes());
    put(&to.join("Cargo.lock"), &fs::read(root().join("Cargo.lock")).unwrap());
    for name in ["core", "graph", "sim"] {
        let folder = Path::new("crates").join(name);
        let manifest = fs::read_to_string(root().join(&folder).join("Cargo.toml")).unwrap();
        put(&to.join(&folder).join("Cargo.toml"), without_tests(&manifest).as_bytes());
        for part in ["src", "examples"] {
            copy_folder(&root().join(&folder).join(part), &to.join(&folder).join(part));
        }
    }
}

/// The manifest of a crate without what only its tests and benches need.
fn without_tests(manifest: &str) -> String {
    let mut keep = true;
    let lines = manifest.lines().filter(|line| {
        if line.starts_with('[') {
            keep = !matches!(*line, "[dev-dependencies]" | "[[bench]]" | "[[test]]");
        }
        keep
    });
    lines.collect::<Vec<_>>().join("\n")
}

fn copy_folder(from: &Path, to: &Path) {
    let Ok(entries) = fs::read_dir(from) else { return };
    for entry in entries {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() { copy_folder(&path, &target) } else { put(&target, &fs::read(&path).unwrap()) }
    }
}

/// Writes what is not there yet, so that nothing is built twice.
fn put(path: &Path, bytes: &[u8]) {
    if fs::read(path).is_ok_and(|there| there == bytes) {
        return;
    }
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, bytes).unwrap();
}

/// Builds the program that stands in `workspace` and hunts for violations of `law`.
fn hunt(workspace: &Path, law: &str) -> String {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let out = Command::new(cargo)
        .args(["run", "--release", "--quiet", "--offline", "-p", "closeranks-sim", "--example", "hunt", "--"])
        .arg(root().join("scenarios/campaign.toml").canonicalize().unwrap())
        .args([RUNS, SEED])
        .args((!law.is_empty()).then_some(law))
        .env("CARGO_TARGET_DIR", workspace.join("target"))
        .env("CARGO_INCREMENTAL", "1")
        .current_dir(workspace)
        .output()
        .unwrap();
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    String::from_utf8(out.stdout).unwrap().trim().to_owned()
}

#[test]
fn every_broken_controller_is_caught_by_its_law() {
    let workspace = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("oracle");
    copy(&workspace);
    assert_eq!(hunt(&workspace, ""), format!("nothing {RUNS}"), "the controller as it is");
    let mut missed = Vec::new();
    let only = std::env::var("MUTANT").unwrap_or_default();
    let chosen: Vec<&Mutant> = MUTANTS.iter().filter(|mutant| mutant.name.contains(&only)).collect();
    assert!(!chosen.is_empty(), "no mutant's name contains MUTANT={only}");
    for Mutant { name, law, lines } in chosen {
        for (file, line, broken) in *lines {
            let path = workspace.join("crates").join(file);
            let text = fs::read_to_string(&path).unwrap();
            assert_eq!(text.matches(line).count(), 1, "{name}: `{line}` in {file}");
            put(&path, text.replace(line, broken).as_bytes());
        }
        let found = hunt(&workspace, law);
        eprintln!("{name}: {found}");
        if !found.starts_with("found") {
            missed.push(format!("{name} ({law})"));
        }
        copy(&workspace);
    }
    assert!(missed.is_empty(), "not caught: {missed:?}");
}
