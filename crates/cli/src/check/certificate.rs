//! `closeranks check --certificate`: what proves the answer, as a file that others can check (docs/proofs.md).

use core::fmt::Write as _;
use std::fs::OpenOptions;
use std::io::Write as _;
use std::path::Path;

use anyhow::{Context as _, Result, bail};
use closeranks_graph::evidence::{Claim, Evidence};
use closeranks_graph::network::Network;

/// Writes what proves the answer to a new file; an error if there is nothing that can be checked without a search. `name` is what
/// the file of the graph calls a robot.
pub(super) fn save(
    target: &Path,
    network: Network,
    claim: Option<Claim>,
    name: &dyn Fn(usize) -> String,
) -> Result<()> {
    let Some(claim) = claim else {
        bail!(
            "no certificate was written to `{}`, because nothing but a search proves this answer; allowed are answers that two sets \
             of robots, degrees or ranks prove (--local and graphs of more than 128 robots have ranks)",
            target.display()
        );
    };
    let evidence = Evidence { network, claim };
    if let Err(wrong) = evidence.check() {
        bail!("the certificate does not pass its own check, which is a bug of this program: {wrong}");
    }
    let text = format!("{}{}", evidence.text(), remarks(evidence.network.node_count(), name));
    let file = OpenOptions::new().write(true).create_new(true).open(target);
    let written = file.and_then(|mut file| file.write_all(text.as_bytes()));
    written.with_context(|| format!("cannot write the certificate to `{}`", target.display()))
}

/// Which robot each node is, where names are not the numbers of the nodes.
fn remarks(count: usize, name: &dyn Fn(usize) -> String) -> String {
    let mut text = String::new();
    for (node, name) in (0..count).map(|node| (node, name(node))) {
        if name != node.to_string() {
            let _ = writeln!(text, "# node {node} is {name:?}");
        }
    }
    text
}

/// The claim that two sets refute.
pub(super) fn refuted(witness: &closeranks_graph::definition::Witness) -> Claim {
    let nodes = |set: closeranks_graph::graph::set::NodeSet| {
        set.iter().filter_map(|node| u32::try_from(node).ok()).collect()
    };
    Claim::NotRobust { r: witness.r, s: witness.s, sets: [witness.first, witness.second].map(nodes) }
}
