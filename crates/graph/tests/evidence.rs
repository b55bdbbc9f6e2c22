//! Certificates that are right are accepted, wrong ones are refused, and what is accepted is true by the definition.
//!
//! With `CLOSERANKS_CERTIFICATES` set to the name of a file, all of them are written there with the verdicts, for the checker that is
//! extracted from the proofs (`proofs/check.sh`).

use core::fmt::Write as _;
use core::ops::ControlFlow;
use std::{env, fs};

use closeranks_graph::definition::{counterexample, is_robust};
use closeranks_graph::effort::{Meter, Stopped};
use closeranks_graph::evidence::{self, Claim, Evidence};
use closeranks_graph::graph::Graph;
use closeranks_graph::graph::set::NodeSet;
use closeranks_graph::local;
use closeranks_graph::makers::random::erdos_renyi;
use closeranks_graph::network::Network;
use closeranks_graph::ranks::{self, Order};
use closeranks_graph::roles::{self, Liars, Question};
use seeded::Seeded;

#[path = "../../core/tests/seeded/mod.rs"]
mod seeded;

/// How many graphs are drawn; each has some right certificates and a dozen changed ones.
const GRAPHS: u64 = 240;
const NODES: usize = 6;

#[test]
fn what_is_accepted_is_true() {
    let mut random = Seeded(18);
    let (mut stream, mut counts) = (String::new(), [0; 2]);
    for seed in 0..GRAPHS {
        let graph = erdos_renyi(NODES, random.between(0.3, 1.0), seed % 3 == 0, seed).unwrap();
        for evidence in right(&graph) {
            evidence.check().expect("a right certificate");
            for change in 0..8 {
                let text = if change == 0 { evidence.text() } else { changed(&evidence, &mut random) };
                let verdict = judge(&text);
                counts[usize::from(verdict)] += 1;
                let _ = writeln!(stream, "{text}verdict {}", if verdict { "yes" } else { "no" });
            }
        }
    }
    assert!(counts[0] > 1000 && counts[1] > 1000, "refused and accepted: {counts:?}");
    if let Ok(file) = env::var("CLOSERANKS_CERTIFICATES") {
        fs::write(file, stream).expect("the file can be written");
    }
}

/// What can be proved of a graph: witnesses, degrees, ranks.
fn right(graph: &Graph) -> Vec<Evidence> {
    let network = Network::from(graph);
    let mut claims = Vec::new();
    for (r, s) in [(1, 1), (2, 1), (2, 2), (3, 3)] {
        if let Some(witness) = counterexample(graph, r, s) {
            claims.push(Claim::NotRobust { r, s, sets: [witness.first, witness.second].map(nodes) });
        }
    }
    let least = network.degrees().min().unwrap_or(0);
    claims.extend((least + 1).checked_sub(NODES / 2).filter(|r| *r > 0).map(|r| Claim::Degrees { r }));
    let counted = |order: &ranks::Order| order.counts(&network).is_ok();
    claims.extend((0..3).filter_map(|f| ranks::order(&network, f)).filter(counted).map(Claim::Ranks));
    for (r, s) in [(1, 1), (1, 3), (2, 1), (2, 2), (3, 1)] {
        claims.extend(with_meter(|meter| evidence::of_robust(&network, r, s, meter)));
    }
    claims.extend((0..3).filter_map(|f| searched(&network, f)));
    let asked = [(1, 1), (1, 3), (2, 1), (2, 2), (3, 1)];
    claims.extend(asked.into_iter().filter_map(|(r, s)| evidence::of_eigenvalues(&network, r, s)));
    claims.into_iter().map(|claim| Evidence { network: network.clone(), claim }).collect()
}

/// The core that is found, or else all nodes, with the choices of a search, though counting might do.
fn searched(network: &Network, f: usize) -> Option<Claim> {
    let all: Vec<u32> = (0..6).collect();
    let found = ranks::order(network, f).unwrap_or(Order { f, core: all, rest: Vec::new() });
    let graph = found.core_graph(network)?;
    let question = Question { r: f + 1, liars: Liars::Local };
    let refutation = with_meter(|meter| roles::refutation(&graph, question, 1 << 16, meter))?;
    Some(Claim::SearchedRanks { order: found, refutation })
}

fn with_meter<T>(work: impl FnOnce(&mut Meter<'_>) -> Result<T, Stopped>) -> T {
    let mut go_on = |_: &_| ControlFlow::Continue(());
    work(&mut Meter::new(u64::MAX, &mut go_on)).expect("no limit")
}

fn nodes(set: NodeSet) -> Vec<u32> {
    set.iter().map(|node| u32::try_from(node).expect("a small number")).collect()
}

/// A certificate with one digit changed, left out or put in, or one line twice or gone.
fn changed(evidence: &Evidence, random: &mut Seeded) -> String {
    let mut lines: Vec<String> = evidence.text().lines().map(str::to_owned).collect();
    // Half of the changes are in the claim.
    let claim = NODES + 2;
    let place = if random.below(2) == 0 {
        random.below(lines.len())
    } else {
        claim + random.below(lines.len() - claim)
    };
    let mut words: Vec<String> = lines[place].split(' ').map(str::to_owned).collect();
    let word = 1 + random.below(words.len());
    match random.below(8) {
        0 => drop(lines.remove(place)),
        1 => lines.insert(place, lines[place].clone()),
        2 | 3 if word < words.len() => drop(words.remove(word)),
        4 | 5 => words.insert(word, random.below(NODES + 1).to_string()),
        _ if word < words.len() => words[word] = random.below(NODES + 1).to_string(),
        _ => words.push(String::new()),
    }
    if place < lines.len() && words.len() > 1 {
        lines[place] = words.join(" ");
    }
    lines.join("\n") + "\n"
}

fn survives(graph: &Graph, f: usize) -> bool {
    with_meter(|meter| local::witness(graph, f, meter)).is_none()
}

/// The verdict, after the claim was compared with the definition if it is accepted.
fn judge(text: &str) -> bool {
    let Ok(evidence) = Evidence::from_text(text) else { return false };
    let is_proved = evidence.check().is_ok();
    if is_proved {
        let graph = evidence.network.graph().expect("a small network");
        let is_true = match &evidence.claim {
            Claim::NotRobust { r, s, .. } => !is_robust(&graph, *r, *s),
            Claim::Degrees { r } => (1..=NODES).all(|s| is_robust(&graph, *r, s)),
            Claim::Ranks(order) | Claim::SearchedRanks { order, .. } => survives(&graph, order.f),
            Claim::Search { r, s, .. } | Claim::Eigenvalues { r, s, .. } => is_robust(&graph, *r, *s),
        };
        assert!(is_true, "accepted and false:\n{text}");
    }
    is_proved
}
