//! No conclusion loses two sets that cannot be made larger.

use alloc::vec::Vec;

use super::*;
use crate::definition::exempt;
use crate::graph::Graph;
use crate::graph::set::NodeSet;
use crate::makers::{fixed, random};

/// Two disjoint sets with a content member each that cannot be made larger, and their exempt members.
#[derive(Clone, Copy, Debug)]
struct Sets {
    members: [u64; 2],
    exempt: [u64; 2],
}

impl Sets {
    fn quadruple(&self) -> Quadruple {
        let [members, exempt] = [self.members, self.exempt].map(|sets| sets.map(Word::count));
        Quadruple { content: [members[0] - exempt[0], members[1] - exempt[1]], exempt }
    }

    fn fits(&self, known: &Known<u64>, field: u64) -> bool {
        let fits = |set: usize| {
            let (side, content) = (&known.sides[set], self.members[set].without(self.exempt[set]));
            side.members.is_within(self.members[set])
                && side.content.is_within(content)
                && self.members[set].is_within(side.allowed)
                && content.is_within(side.able)
                && known.exempt[set] <= self.exempt[set].count()
        };
        fits(0) && fits(1) && field.without(self.members[0] | self.members[1]).is_within(known.rest)
    }
}

fn sets(graph: &Graph, r: usize) -> Vec<Sets> {
    let count = u32::try_from(graph.node_count()).unwrap();
    let digit = |code: usize, node: usize| code / 3_usize.pow(u32::try_from(node).unwrap()) % 3;
    let of = |code: usize| {
        let set = |place: usize| -> NodeSet {
            (0..graph.node_count()).filter(|node| digit(code, *node) == place).collect()
        };
        let sets = [set(0), set(1)];
        let exempts = sets.map(|set| exempt(graph, set, r));
        let outside = |node: usize, set: NodeSet| graph.in_neighbors(node).difference(set).len();
        let is_largest = set(2).iter().all(|node| sets.iter().all(|set| outside(node, *set) >= r));
        let is_witness = is_largest && (0..2).all(|set| exempts[set].len() < sets[set].len());
        let words = |sets: [NodeSet; 2]| sets.map(|set| u64::from_bits(set.bits()));
        is_witness.then(|| Sets { members: words(sets), exempt: words(exempts) })
    };
    let ordered = |sets: &Sets| {
        let Quadruple { content, exempt } = sets.quadruple();
        (exempt[0], content[0]) <= (exempt[1], content[1])
    };
    (0..3_usize.pow(count)).filter_map(of).filter(ordered).collect()
}

/// Goes down the tree the way that the sets go, as far as it leads.
fn descend(both: &Both<'_, '_, u64>, sets: &Sets, group: usize) -> usize {
    let mut place = Place { known: Known::new(both.field), group };
    for depth in 0.. {
        assert!(sets.fits(&place.known, both.field), "{depth}, {sets:?}");
        let Some((known, most)) = both.conclude(place) else { panic!("{depth}, {sets:?}") };
        assert!(sets.fits(&known.known, both.field), "{depth}, {sets:?}");
        if both.found(&known.known).is_some() {
            return depth;
        }
        let choice = both.choice(known, &most).unwrap();
        let taken = choice.taken();
        place = if sets.fits(&taken.known, both.field) { taken } else { choice.left(both.board, 0) };
    }
    0
}

//= theory sec:joint-search type=test
#[test]
fn no_sets_are_lost_on_the_way() {
    let mut depths = 0;
    for seed in 0..6 {
        let graphs = [
            random::erdos_renyi(7, 0.7, false, seed).unwrap(),
            random::regular(8, 3 + usize::try_from(seed % 4).unwrap(), seed).unwrap(),
            fixed::hypercube(3).unwrap(),
        ];
        for (graph, r) in graphs.iter().flat_map(|graph| (1..4).map(move |r| (graph, r))) {
            let all = sets(graph, r);
            let needed = all.iter().map(|sets| sets.exempt[0].count() + sets.exempt[1].count());
            let board = Board::<u64>::plain(graph, r);
            for (sets, effort) in all.iter().zip(needed) {
                let both = Both::new(&board, &[sets.quadruple()], effort);
                depths += descend(&both, sets, 0);
            }
        }
    }
    assert!(depths > 1000, "{depths}");
}
