//! Texts that say they are certificates.

use closeranks_graph::definition::is_robust;
use closeranks_graph::evidence::{Claim, Evidence};
use closeranks_graph::graph::Graph;
use closeranks_graph::graph::set::NodeSet;

/// Nodes of networks in which what passes is compared with the definition of robustness.
const DEFINED: usize = 6;
/// Nodes of networks in which all roles are tried.
const TRIED: usize = 4;
/// Nodes of networks whose bounds of eigenvalues are checked: that takes the cube of it.
const SMALL: usize = 64;

/// Any text is a certificate that reads back as what it was, or an error with its line. It proves something or is refused with a reason,
/// and what it proves of a small network is true.
pub fn certificate(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    match Evidence::from_text(&text) {
        Ok(evidence) => is_judged(&evidence),
        Err(error) => {
            assert!(!error.allowed.is_empty(), "{error}");
            // One line more than there are: where the text ends too soon.
            assert!((1..=text.lines().count() + 1).contains(&error.line), "{error}");
        }
    }
}

fn is_judged(evidence: &Evidence) {
    assert_eq!(Evidence::from_text(&evidence.text()).as_ref(), Ok(evidence));
    let nodes = evidence.network.node_count();
    if nodes > SMALL {
        return;
    }
    match evidence.check() {
        Ok(()) if nodes <= DEFINED => is_true(evidence),
        Ok(()) => {}
        Err(refused) => assert!(!refused.to_string().is_empty()),
    }
}

/// The definition, word for word.
fn is_true(evidence: &Evidence) {
    let graph = evidence.network.graph().expect("a small network");
    let nodes = graph.node_count();
    let holds = match &evidence.claim {
        Claim::NotRobust { r, s, .. } => !is_robust(&graph, *r, *s),
        Claim::Degrees { r } => is_robust(&graph, *r, nodes),
        Claim::Search { r, s, .. } | Claim::Eigenvalues { r, s, .. } => is_robust(&graph, *r, *s),
        Claim::Ranks(order) | Claim::SearchedRanks { order, .. } => {
            nodes > TRIED || !is_split(&graph, order.f)
        }
    };
    assert!(holds, "{}", evidence.text());
}

/// Whether liars of whom no honest node hears more than `f` can keep two sets of honest nodes apart: each member of a set hears at most
/// `f` honest or lying nodes that are not of its own set or liars on its side.
fn is_split(graph: &Graph, f: usize) -> bool {
    let nodes = graph.node_count();
    (0..5_usize.pow(u32::try_from(nodes).expect("few nodes"))).any(|code| splits(graph, f, code))
}

/// The roles of all nodes as digits to base 5: honest in the first set, in the second, in neither, a liar with the first, with the second.
fn splits(graph: &Graph, f: usize, code: usize) -> bool {
    let all = || 0..graph.node_count();
    let role = |node: usize| code / 5_usize.pow(u32::try_from(node).expect("few nodes")) % 5;
    let with = |roles: &[usize]| all().filter(|node| roles.contains(&role(*node))).collect::<NodeSet>();
    let (honest, liars) = (with(&[0, 1, 2]), with(&[3, 4]));
    let sides = [with(&[0, 3]), with(&[1, 4])];
    let few_liars = honest.iter().all(|node| graph.in_neighbors(node).intersection(liars).len() <= f);
    let deaf = |node: usize| graph.in_neighbors(node).difference(sides[role(node)]).len() <= f;
    let both = [0, 1].iter().all(|own| all().any(|node| role(node) == *own));
    few_liars && both && honest.iter().filter(|node| role(*node) < 2).all(deaf)
}
