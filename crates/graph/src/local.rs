//! Adversaries that are few in every neighbourhood (F-local) instead of few in all (F-total).

use crate::effort::{Meter, Stopped};
use crate::graph::Graph;
use crate::graph::set::NodeSet;
use crate::search::peel::Needs;

/// Whether `malicious` is an F-total set: at most F nodes.
//= paper ftotal
#[must_use]
pub fn is_total(malicious: NodeSet, f: usize) -> bool {
    malicious.len() <= f
}

/// Whether `malicious` is an F-local set: every other node hears at most F of them.
#[must_use]
pub fn is_local(graph: &Graph, malicious: NodeSet, f: usize) -> bool {
    local_least(graph, malicious) <= f
}

/// Least F for which `malicious` is F-local: the most malicious nodes that a normal node hears.
#[must_use]
pub fn local_least(graph: &Graph, malicious: NodeSet) -> usize {
    let normal = graph.nodes().difference(malicious);
    normal.iter().map(|node| graph.in_neighbors(node).intersection(malicious).len()).max().unwrap_or(0)
}

/// Two sets that never agree under an F-local attack.
///
/// Every normal member of either set hears at most F nodes outside of its own set, and both have a normal member:
/// W-MSR(F) removes all that it hears from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LocalWitness {
    /// F.
    pub f: usize,
    /// The malicious nodes D, an F-local set. Those in S₁ or S₂ keep that set's value.
    pub malicious: NodeSet,
    /// S₁.
    pub first: NodeSet,
    /// S₂.
    pub second: NodeSet,
}

impl LocalWitness {
    /// Whether the claim is true of `graph`, word for word.
    #[must_use]
    pub fn holds(&self, graph: &Graph) -> bool {
        let stays = |set: NodeSet| {
            let normal = set.difference(self.malicious);
            let heard = |node: usize| graph.in_neighbors(node).difference(set).len();
            !normal.is_empty() && normal.iter().all(|node| heard(node) <= self.f)
        };
        let inside = self.first.union(self.second).union(self.malicious).is_subset(graph.nodes());
        let sets = inside && self.first.is_disjoint(self.second) && stays(self.first) && stays(self.second);
        sets && is_local(graph, self.malicious, self.f)
    }
}

/// A witness against resilience to F-local malicious nodes, or `None` if there is none, by trying all sets.
///
/// Every F-local set times every bipartition, up to 4ⁿ/2 in all: for n up to 12 or so. One set counts as one node of `meter`.
/// `None` is implied by (2F+1)-robustness and implies (F+1,F+1)-robustness, since F-total sets are F-local.
pub fn witness(graph: &Graph, f: usize, meter: &mut Meter<'_>) -> Result<Option<LocalWitness>, Stopped> {
    let all = graph.nodes().bits();
    let needs = Needs::<u128>::new(graph, f + 1);
    let mut malicious = all;
    loop {
        meter.spend(1)?;
        if is_local(graph, NodeSet::from_bits(malicious), f)
            && let Some((first, second)) = sides(&needs, all, malicious, meter)?
        {
            let (first, second) = (NodeSet::from_bits(first), NodeSet::from_bits(second));
            let found = LocalWitness { f, malicious: NodeSet::from_bits(malicious), first, second };
            debug_assert!(found.holds(graph), "{found:?}");
            return Ok(Some(found));
        }
        if malicious == 0 {
            return Ok(None);
        }
        malicious = (malicious - 1) & all;
    }
}

fn sides(
    needs: &Needs<u128>,
    all: u128,
    malicious: u128,
    meter: &mut Meter<'_>,
) -> Result<Option<(u128, u128)>, Stopped> {
    // The last node is on the second side: the sides may trade places.
    let field = all >> 1;
    let side = |half: u128| {
        let helpers = half & malicious;
        let normal = needs.peel(half, half & !malicious, helpers, 0);
        (normal != 0).then_some(normal | helpers)
    };
    let mut half = field;
    while half != 0 {
        meter.spend(1)?;
        if let Some(first) = side(half)
            && let Some(second) = side(all & !half)
        {
            return Ok(Some((first, second)));
        }
        half = (half - 1) & field;
    }
    Ok(None)
}

/// Largest F such that W-MSR(F) withstands every F-local set of malicious nodes, −1 if it fails without any.
///
/// Exact, by [`witness`] for F = 0, 1, …: at least floor((r_max − 1)/2) and at most F_max.
pub fn f_max(graph: &Graph, meter: &mut Meter<'_>) -> Result<i32, Stopped> {
    let mut f = -1;
    for asked in 0..graph.node_count().div_ceil(2) {
        if witness(graph, asked, meter)?.is_some() {
            break;
        }
        f += 1;
    }
    Ok(f)
}
