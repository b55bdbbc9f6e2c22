//! Which edges to add so that a graph becomes (r,s)-robust.

use alloc::vec::Vec;

use crate::decide::Robustness;
use crate::definition::Witness;
use crate::effort::{Effort, Meter, Stopped};
use crate::graph::Graph;
use crate::graph::set::NodeSet;
use crate::verdict::Verdict;

/// Edges that make a graph (r,s)-robust.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Additions {
    /// The edges, `(from, to)`. Without any one of them the graph is not (r,s)-robust.
    pub edges: Vec<(usize, usize)>,
    /// No fewer than so many edges will do. Equal to their number if these are as few as can be.
    pub least: usize,
}

impl Additions {
    /// Whether these are as few edges as can be.
    #[must_use]
    pub fn is_smallest(&self) -> bool {
        self.least == self.edges.len()
    }
}

/// Edges to add to `graph` until it is (r,s)-robust; `None` if even the complete graph is not, r > ceil(n/2).
///
/// First greedily: a witness is broken by the edge that serves most of the witnesses met, and edges that turn out not to be
/// needed are taken back, each step with an exact check. Then, as long as `meter` allows, by trying all smaller sets in
/// order of size: each must break the witness of the graph so far. That is exact, and for small graphs it ends.
/// `Stopped` only if not even the greedy answer was reached. For F malicious nodes r = s = F + 1.
//= paper def:robustness
pub fn additions(
    graph: &Graph,
    r: usize,
    s: usize,
    effort: &Effort,
    meter: &mut Meter<'_>,
) -> Result<Option<Additions>, Stopped> {
    let count = graph.node_count();
    if s > 0 && count > 1 && r > count.div_ceil(2) {
        return Ok(None);
    }
    let question = Question { r, s, effort };
    let mut edges = question.greedy(graph, meter)?;
    let mut least = 0;
    while least < edges.len() {
        match question.deepen(&mut graph.clone(), least, &mut Vec::new(), meter) {
            Ok(Some(found)) => edges = found,
            Ok(None) => least += 1,
            Err(Stopped) => break,
        }
    }
    Ok(Some(Additions { edges, least }))
}

type Edge = (usize, usize);

struct Question<'b> {
    r: usize,
    s: usize,
    effort: &'b Effort,
}

impl Question<'_> {
    fn witness(&self, graph: &Graph, meter: &mut Meter<'_>) -> Result<Option<Witness>, Stopped> {
        match Robustness::new(graph, self.effort).decide(self.r, self.s, meter) {
            Verdict::Robust(_) => Ok(None),
            Verdict::NotRobust(witness) => Ok(Some(witness)),
            Verdict::Unknown => Err(Stopped),
        }
    }

    fn greedy(&self, graph: &Graph, meter: &mut Meter<'_>) -> Result<Vec<Edge>, Stopped> {
        let mut graph = graph.clone();
        let mut met = Vec::new();
        let mut edges = Vec::new();
        while let Some(witness) = self.witness(&graph, meter)? {
            met.push(witness);
            let worth = |edge: &Edge| met.iter().map(|old| serves(&graph, old, *edge)).sum::<usize>();
            let Some(best) = candidates(&graph, &witness).into_iter().max_by_key(worth) else {
                break;
            };
            add(&mut graph, best);
            edges.push(best);
        }
        self.take_back(&mut graph, edges, meter)
    }

    fn take_back(
        &self,
        graph: &mut Graph,
        edges: Vec<Edge>,
        meter: &mut Meter<'_>,
    ) -> Result<Vec<Edge>, Stopped> {
        let mut needed = Vec::new();
        for (from, to) in edges {
            graph.remove_edge(from, to);
            if self.witness(graph, meter)?.is_some() {
                add(graph, (from, to));
                needed.push((from, to));
            }
        }
        Ok(needed)
    }

    /// A set of at most `depth` edges that will do, none of them `refused`.
    fn deepen(
        &self,
        graph: &mut Graph,
        depth: usize,
        refused: &mut Vec<Edge>,
        meter: &mut Meter<'_>,
    ) -> Result<Option<Vec<Edge>>, Stopped> {
        meter.spend(1)?;
        let Some(witness) = self.witness(graph, meter)? else {
            return Ok(Some(Vec::new()));
        };
        if price(graph, &witness) > depth {
            return Ok(None);
        }
        let refused_before = refused.len();
        let open = candidates(graph, &witness).into_iter().filter(|edge| !refused.contains(edge));
        for (from, to) in open.collect::<Vec<Edge>>() {
            add(graph, (from, to));
            let found = self.deepen(graph, depth - 1, refused, meter)?;
            graph.remove_edge(from, to);
            if let Some(mut edges) = found {
                edges.push((from, to));
                return Ok(Some(edges));
            }
            // Whatever is tried from here on does without this edge.
            refused.push((from, to));
        }
        refused.truncate(refused_before);
        Ok(None)
    }
}

/// `edge` is a candidate, so it is not there yet and not a loop.
fn add(graph: &mut Graph, edge: Edge) {
    let added = graph.add_edge(edge.0, edge.1);
    debug_assert!(added.is_ok(), "{added:?}");
}

/// Missing edges that give a content member of either set something to hear outside of it. One of them is in every
/// set of edges that breaks the witness.
fn candidates(graph: &Graph, witness: &Witness) -> Vec<Edge> {
    let mut edges = Vec::new();
    for set in [witness.first, witness.second] {
        for to in set.difference(witness.exempt).iter() {
            for from in graph.nodes().difference(set).difference(graph.in_neighbors(to)).iter() {
                edges.push(if graph.is_directed() { (from, to) } else { (from.min(to), from.max(to)) });
            }
        }
    }
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// For how many content members of the witness `edge` is something to hear outside.
fn serves(graph: &Graph, witness: &Witness, (from, to): Edge) -> usize {
    let serves = |set: NodeSet, from: usize, to: usize| {
        usize::from(set.contains(to) && !set.contains(from) && !witness.exempt.contains(to))
    };
    let both = |set: NodeSet| {
        let back = if graph.is_directed() { 0 } else { serves(set, to, from) };
        serves(set, from, to) + back
    };
    both(witness.first) + both(witness.second)
}

/// No fewer edges break the witness: the least of filling S₁, filling S₂, and s exempt members in all.
fn price(graph: &Graph, witness: &Witness) -> usize {
    let lacks = |set: NodeSet| -> Vec<usize> {
        let content = set.difference(witness.exempt);
        let outside = |node: usize| graph.in_neighbors(node).difference(set).len();
        content.iter().map(|node| witness.r - outside(node)).collect()
    };
    let (first, second) = (lacks(witness.first), lacks(witness.second));
    let fill = first.iter().sum::<usize>().min(second.iter().sum());
    let mut all = [first, second].concat();
    all.sort_unstable();
    // Fewer members than that: more exempt ones than members cannot be.
    let missing = witness.s - witness.exempt.len();
    if missing > all.len() {
        return fill;
    }
    let ends: usize = all[..missing].iter().sum();
    // One undirected edge between the two sets serves both of its ends.
    fill.min(if graph.is_directed() { ends } else { ends.div_ceil(2) })
}
