//! Who still agrees with whom where a graph is not robust.

use crate::definition::Witness;
use crate::graph::Graph;
use crate::graph::set::NodeSet;
use crate::search::peel::Needs;

/// What the liars of a witness can make of a network whose members run W-MSR(r − 1): all of `first` keep one value for ever and all of
/// `second` another, from the start in which they and those `between` have these values or one in the middle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Split {
    /// The exempt members of the witness, who lie.
    pub liars: NodeSet,
    /// Honest nodes that keep one value.
    pub first: NodeSet,
    /// Honest nodes that keep another one.
    pub second: NodeSet,
    /// All other honest nodes: each hears r or more from outside of either group, so that it may move.
    pub between: NodeSet,
}

impl Split {
    /// The split of a witness that [holds](Witness::holds), with groups as large as the same liars can keep them.
    ///
    /// A node that hears fewer than r nodes outside of a group and its liars keeps that group's value with it. So the first group is all that
    /// peeling leaves of whoever is not in S₂, with the liars of S₁ as members, and the second is what is then left likewise.
    #[must_use]
    pub fn of(graph: &Graph, witness: &Witness) -> Self {
        let needs = Needs::<u128>::new(graph, witness.r);
        let group = |others: NodeSet, liars: NodeSet| {
            let field = graph.nodes().difference(others).bits();
            let able = graph.nodes().difference(others).difference(witness.exempt).bits();
            NodeSet::from_bits(needs.peel(field, able, liars.bits(), 0))
        };
        let liars_of = |set: NodeSet| set.intersection(witness.exempt);
        let first = group(witness.second, liars_of(witness.first));
        let second = group(first.union(liars_of(witness.first)), liars_of(witness.second));
        let between = graph.nodes().difference(first).difference(second).difference(witness.exempt);
        Self { liars: witness.exempt, first, second, between }
    }
}

#[cfg(test)]
mod tests {
    use core::ops::ControlFlow;

    use super::*;
    use crate::definition::{counterexample, exempt};
    use crate::effort::Meter;
    use crate::makers::fixed::{star, tight};
    use crate::makers::random::erdos_renyi;
    use crate::search;

    /// The groups are disjoint, hold the honest members of the witness, and with the liars of their side hear too little from outside.
    #[test]
    fn groups_hold_out_by_the_definition() {
        let mut larger = 0;
        for seed in 0..200 {
            let chance = 0.2 + 0.003 * f64::from(u32::try_from(seed).unwrap());
            let graph = erdos_renyi(7, chance, seed % 3 == 0, seed).unwrap();
            for f in 0..3 {
                let mut go_on = |_: &_| ControlFlow::Continue(());
                // The search stops at the smallest first set that it comes to.
                let found = search::witness(&graph, f + 1, f + 1, &mut Meter::new(u64::MAX, &mut go_on));
                let Some(witness) = found.unwrap() else { continue };
                let split = Split::of(&graph, &witness);
                let sides = [(split.first, witness.first), (split.second, witness.second)];
                for (group, side) in sides {
                    let with_liars = group.union(side.intersection(witness.exempt));
                    assert!(exempt(&graph, with_liars, f + 1).is_subset(witness.exempt), "{split:?}");
                    assert!(side.difference(witness.exempt).is_subset(group), "{split:?}, {witness:?}");
                }
                assert!(split.first.is_disjoint(split.second) && split.liars.len() <= f);
                let all = split.first.union(split.second).union(split.between).union(split.liars);
                assert_eq!(all, graph.nodes());
                larger += usize::from(
                    split.first.len() + split.second.len() > witness.first.len() + witness.second.len(),
                );
            }
        }
        assert!(larger > 0);
    }

    #[test]
    fn known_splits() {
        let of = |graph: &Graph, f: usize| Split::of(graph, &counterexample(graph, f + 1, f + 1).unwrap());
        let halves = of(&tight(10, 2).unwrap(), 2);
        assert_eq!((halves.first.len(), halves.second.len(), halves.between.len()), (5, 5, 0));
        // A star falls apart into its ends if its hub lies; two of them are the groups, and nobody else is told anything.
        let star = of(&star(5).unwrap(), 1);
        assert_eq!(star.liars.len() + star.first.len() + star.second.len() + star.between.len(), 5);
    }
}
