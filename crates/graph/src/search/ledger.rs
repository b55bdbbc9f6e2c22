//! What is known so far about s_max(r) for every r, and what one answer says about the others.

use alloc::vec::Vec;

use crate::bounds;
use crate::definition::Witness;
use crate::graph::Graph;
use crate::graph::set::NodeSet;
use crate::verdict::{Certificate, Interval};

/// s_max at one r: (r,s)-robust for all s ≤ least, not for any s > most.
#[derive(Clone, Copy, Debug)]
struct Row {
    least: usize,
    most: usize,
    certificate: Certificate,
    /// Two sets with `most` exempt members, if `most < n`.
    sets: Option<(NodeSet, NodeSet)>,
}

/// Rows for r = 1 ..= ceil(n/2) + 1, kept consistent:
///
/// ```text
/// s_max(r + 1) ≤ s_max(r),   and s_max(r + 1) ≤ s_max(r) − 1 if 1 ≤ s_max(r) < n
/// ```
///
/// The second: take a violating pair at r with the fewest exempt members. At r + 1 each of them is exempt or not; if
/// all still are, drop one: the others lose one neighbour inside, so whoever was content at r is content at r + 1.
#[derive(Debug)]
pub(crate) struct Ledger<'g> {
    pub(crate) graph: &'g Graph,
    rows: Vec<Row>,
}

impl<'g> Ledger<'g> {
    /// What degrees and pairs say.
    pub(crate) fn new(graph: &'g Graph) -> Self {
        let count = graph.node_count();
        let row = Row { least: 0, most: count, certificate: Certificate::Nothing, sets: None };
        let mut ledger = Self { graph, rows: [row].repeat(count.div_ceil(2) + 1) };
        for r in 1..=ledger.r_count() {
            ledger.quick(r);
        }
        ledger
    }

    /// Number of rows; the last one is r = ceil(n/2) + 1, which no graph of two nodes or more satisfies.
    pub(crate) fn r_count(&self) -> usize {
        self.rows.len()
    }

    /// s_max(r) as far as it is known.
    pub(crate) fn interval(&self, r: usize) -> Interval {
        let row = self.row(r);
        Interval { least: number(row.least), most: number(row.most) }
    }

    pub(crate) fn least(&self, r: usize) -> usize {
        self.row(r).least
    }

    pub(crate) fn most(&self, r: usize) -> usize {
        self.row(r).most
    }

    pub(crate) fn certificate(&self, r: usize) -> Certificate {
        self.row(r).certificate
    }

    /// A witness against (r,s), if one is known.
    pub(crate) fn witness(&self, r: usize, s: usize) -> Option<Witness> {
        let row = self.row(r);
        let (first, second) = row.sets.filter(|_| s > row.most)?;
        let witness = Witness::new(self.graph, r, s, first, second);
        debug_assert!(witness.holds(self.graph), "{witness:?}");
        Some(witness)
    }

    /// Notes that the graph is (r,s)-robust.
    pub(crate) fn note_robust(&mut self, r: usize, s: usize, certificate: Certificate) {
        let count = self.graph.node_count();
        // From n - 1 on the third condition is never met, so that (r, n - 1) is (r, n). And (r, 0) says nothing.
        let full = |s: usize| if s > 0 && s + 1 >= count { count } else { s };
        for (steps, row) in self.rows[..r].iter_mut().rev().enumerate() {
            let least = if s == 0 { 0 } else { full(s + steps) };
            if row.least < least {
                row.least = least;
                row.certificate = certificate.shifted(steps);
            }
        }
    }

    /// Notes two sets that violate (r, x + 1)-robustness, x their number of exempt members.
    pub(crate) fn note_witness(&mut self, r: usize, first: NodeSet, second: NodeSet) {
        let (mut first, mut second) = (first, second);
        for r in r..=self.rows.len() {
            let exempt = Witness::new(self.graph, r, 1, first, second).exempt;
            let row = &mut self.rows[r - 1];
            if exempt.len() < row.most {
                row.most = exempt.len();
                row.sets = Some((first, second));
            }
            if let Some(dropped) = exempt.iter().next() {
                first.remove(dropped);
                second.remove(dropped);
            }
        }
    }

    fn row(&self, r: usize) -> &Row {
        &self.rows[r.clamp(1, self.rows.len()) - 1]
    }

    fn quick(&mut self, r: usize) {
        let (count, degree_min) = (self.graph.node_count(), self.graph.degree_min());
        if count == 1 {
            return self.note_robust(r, count, Certificate::Nothing);
        }
        if bounds::r_least(self.graph) >= r {
            return self.note_robust(r, count, Certificate::Degrees { degree_min });
        }
        let Some(pair) = bounds::content_pair(self.graph, r) else {
            return self.note_robust(r, count, Certificate::Pairs);
        };
        self.note_witness(r, pair.first, pair.second);
        if r > bounds::r_most(self.graph) {
            self.note_degree_witness(r);
        }
    }

    /// One half against the other, or a node of least degree against the rest.
    fn note_degree_witness(&mut self, r: usize) {
        let all = self.graph.nodes();
        let half = NodeSet::first(self.graph.node_count() / 2);
        if r == self.rows.len() {
            return self.note_witness(r, half, all.difference(half));
        }
        let loner = all.iter().min_by_key(|&node| self.graph.in_degree(node));
        let loner: NodeSet = loner.into_iter().collect();
        self.note_witness(r, loner, all.difference(loner));
    }
}

/// Counts of nodes are at most 128.
pub(crate) fn number(count: usize) -> i32 {
    i32::try_from(count).unwrap_or(i32::MAX)
}
