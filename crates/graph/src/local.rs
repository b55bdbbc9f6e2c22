//! Adversaries that are few in every neighbourhood (F-local) instead of few in all (F-total).

use crate::bounds::f_by_degree;
use crate::decide::Robustness;
use crate::definition::Witness;
use crate::effort::{Meter, Stopped};
use crate::graph::Graph;
use crate::graph::set::NodeSet;
use crate::network::Network;
use crate::ranks::{self, Order};
use crate::roles::{self, Liars, Question, Split};
use crate::verdict::{Interval, Verdict};

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

/// A witness against resilience to F-local malicious nodes, or `None` if there is none, by a search over the roles of all nodes.
///
/// One place of the search counts as one node of `meter`. `None` is implied by (2F+1)-robustness and implies (F+1,F+1)-robustness,
/// since F-total sets are F-local.
//= theory sec:local
pub fn witness(graph: &Graph, f: usize, meter: &mut Meter<'_>) -> Result<Option<LocalWitness>, Stopped> {
    let question = Question { r: f.saturating_add(1), liars: Liars::Local };
    let found = roles::split(graph, question, meter)?;
    Ok(found.map(|Split { liars, first, second }| {
        let witness = LocalWitness { f, malicious: liars, first, second };
        debug_assert!(witness.holds(graph), "{witness:?}");
        witness
    }))
}

/// How it is known that W-MSR(F) withstands every F-local set of malicious nodes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Withstands {
    /// Every node hears F + floor(n/2) others.
    //= theory thm:contraction
    Degrees,
    /// It is (2F+1)-robust.
    Robustness,
    /// An order of its nodes, [`ranks`].
    //= theory thm:ranks-exact
    Ranks(Order),
    /// No roles of the nodes are a split.
    Search,
}

/// Nodes of the search that each relative of the question may take before the question itself is asked.
const SHORT: u64 = 1 << 13;

/// Whether W-MSR(F) withstands every F-local set of malicious nodes, or a witness that it does not.
///
/// Degrees, (2F+1)-robustness and ranks are enough, (F+1,F+1)-robustness is necessary; the robustness is asked for a short while. What is
/// left is [`witness`].
//= theory sec:local
pub fn decide(
    robustness: &mut Robustness<'_>,
    f: usize,
    meter: &mut Meter<'_>,
) -> Result<Result<Withstands, LocalWitness>, Stopped> {
    let graph = robustness.graph();
    if f_by_degree(graph, graph.nodes()).is_some_and(|most| f <= most) {
        return Ok(Ok(Withstands::Degrees));
    }
    let (enough, least) = (f.saturating_mul(2).saturating_add(1), f.saturating_add(1));
    let short = meter.within(SHORT, |meter| Ok(robustness.decide(enough, 1, meter)))?;
    if let Some(Verdict::Robust(_)) = short {
        return Ok(Ok(Withstands::Robustness));
    }
    let short = meter.within(SHORT, |meter| Ok(robustness.decide(least, least, meter)))?;
    if let Some(Verdict::NotRobust(Witness { exempt, first, second, .. })) = short {
        return Ok(Err(LocalWitness { f, malicious: exempt, first, second }));
    }
    if let Some(order) = ranks::order(&Network::from(graph), f) {
        return Ok(Ok(Withstands::Ranks(order)));
    }
    Ok(witness(graph, f, meter)?.map_or(Ok(Withstands::Search), Err))
}

/// Largest F such that W-MSR(F) withstands every F-local set of malicious nodes, −1 if it fails without any, and a witness against the next F
/// if one was found.
///
/// It is at least floor((r_max − 1)/2) and what degrees prove, and at most F_max. What `robustness` knows of these is not asked again;
/// an interval if the effort ends before.
//= theory sec:local
pub fn f_max(robustness: &mut Robustness<'_>, meter: &mut Meter<'_>) -> (Interval, Option<LocalWitness>) {
    let graph = robustness.graph();
    let by_degrees = f_by_degree(graph, graph.nodes()).and_then(|f| i32::try_from(f).ok());
    let by_robustness = (robustness.r_known().least - 1).div_euclid(2);
    let most = robustness.f_known().most;
    let mut known = Interval { least: by_degrees.unwrap_or(-1).max(by_robustness).min(most), most };
    while known.exactly().is_none() {
        let asked = usize::try_from(known.least + 1).unwrap_or(0);
        match decide(robustness, asked, meter) {
            Ok(Ok(_)) => known.least += 1,
            Ok(Err(found)) => return (Interval { most: known.least, ..known }, Some(found)),
            Err(Stopped) => break,
        }
        known.most = known.most.min(robustness.f_known().most);
    }
    (known, None)
}
