//! `closeranks check --certificate`: what proves the answer, as a file that others can check (docs/proofs.md).

use core::fmt::Write as _;
use std::fs::OpenOptions;
use std::io::Write as _;
use std::path::Path;

use anyhow::{Context as _, Result, bail};
use closeranks_graph::effort::{Meter, Progress, Stopped};
use closeranks_graph::evidence::{self, CHOICES_MAX, Claim, Evidence};
use closeranks_graph::network::Network;
use closeranks_graph::ranks::Order;

use super::Check;

/// What proves an answer.
#[derive(Debug, Default, Clone)]
pub(super) enum Proof {
    /// Nothing that is written.
    #[default]
    Nothing,
    /// A claim that others can check as it is.
    Claim(Claim),
    /// A search for two sets that ends without any; it is made again, to write its choices down.
    Robust {
        /// The r of (r,s).
        r: usize,
        /// The s of (r,s).
        s: usize,
    },
    /// An order; if counting does not prove its core, a search is made again.
    Order(Order),
}

impl Proof {
    /// The claim, after a search within `meter` if there must be one.
    fn claim(self, network: &Network, meter: &mut Meter<'_>) -> Result<Claim> {
        let found = match self {
            Self::Claim(claim) => return Ok(claim),
            Self::Nothing => bail!(
                "nothing that is proved here can be written down; allowed are questions with --F, or --r and --s, whose answer is yes or \
                 no, and refuted ones without"
            ),
            Self::Robust { r, s } => match evidence::of_eigenvalues(network, r, s) {
                Some(claim) => return Ok(claim),
                None => evidence::of_robust(network, r, s, meter),
            },
            Self::Order(order) => evidence::of_order(network, order, meter),
        };
        match found {
            Ok(Some(claim)) => Ok(claim),
            Ok(None) => bail!(
                "the search for a certificate found that the answer is wrong, which is a bug of this program"
            ),
            Err(Stopped) => bail!(
                "the search was not written down in time, or has more than {CHOICES_MAX} choices; --time-limit gives more time, and a \
                 network of fewer robots has fewer choices"
            ),
        }
    }
}

/// Writes what proves the answer to a new file; an error if that cannot be written down within the limits of `arguments`. `name` is
/// what the file of the graph calls a robot.
pub(super) fn save(
    arguments: &Check,
    target: &Path,
    network: Network,
    proof: Proof,
    name: &dyn Fn(usize) -> String,
) -> Result<()> {
    let mut watch = arguments.watch();
    let mut look = |progress: &Progress| watch.look(progress);
    let claim = proof.claim(&network, &mut Meter::new(arguments.sets(), &mut look));
    watch.finish();
    let claim = claim.with_context(|| format!("no certificate was written to `{}`", target.display()))?;
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
