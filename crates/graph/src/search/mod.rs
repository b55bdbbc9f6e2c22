//! Algorithm B: branch and bound over the smaller of the two sets.
//!
//! A member v of a set S is *content* if it hears at least need(v) = d(v) − r + 1 members; the others are exempt.
//! A graph is not (r,s)-robust iff two disjoint sets with at least one content member each have at most s − 1 exempt
//! members together. The search grows S₁, the set with no more exempt members than the other, and keeps for it what is certainly
//! in, what may still be in, and what may still be content (`side.rs`). Every conclusion drawn is monotone: it only
//! removes choices that no pair of sets makes, so an exhausted tree is a proof (docs/theory, `sec:cohesive`, `sec:bounds`,
//! `sec:search`). Beyond the usual branch and bound there are:
//!
//! * **Half the effort**: S₁ has at most (s − 1)/2 exempt members, S₂ then what is left. With s = 1 it has at most n/2
//!   members instead.
//! * **Size**: S₁ has at most n − |S₂| members, so a node that would be content only in a larger set is
//!   exempt, and a content node without room for a miss takes all further members from its neighbours.
//! * **One effort**: the least number of exempt members that the other set needs in what is left to it is not there
//!   for this one, and the other way round.
//! * **Symmetry**: if no pair of sets has a node taken at a place of the tree, none has one taken there to which an automorphism takes the
//!   node that keeps all that is known at this place (`board.rs`). Nodes with the same neighbours are seen at once, others after long
//!   searches.
//! * **Eigenvalues**: in long searches of undirected graphs both sets have as many members as their exempt ones ask for (`spectrum`).
//! * **Sizes of both sets together**: searches that are longer still are begun again over both sets at once, for the numbers of members that
//!   no numbers of links forbid (`joint`, `both`).
//! * **Pieces**: what is long is cut into pieces, which threads that a caller lends may take at once (`pieces.rs`). The answer is that of
//!   the first piece that has one.
//! * **Sums**: in long searches what all content members lack together must be had from the nodes that are still taken (`sums.rs`), and a set
//!   of m members has enough nodes that can be content among m (`peel.rs`).
//! * **Guesses**: a search that is long stops now and then to guess at a witness (`guess.rs`).
//! * **Late exemption**: a member is branched on as content or exempt only when nothing else is open.

mod board;
mod both;
mod grow;
mod guess;
pub(crate) mod ledger;
pub(crate) mod peel;
mod pieces;
mod side;
mod sums;
pub mod symmetry;

use crate::definition::Witness;
use crate::effort::{Meter, Stopped};
use crate::graph::Graph;
use crate::graph::set::NodeSet;
use crate::graph::word::Word;
use crate::joint::{self, Quadruple};
use crate::spectrum::Spectrum;
use board::Board;
use both::Both;
use grow::{Room, Search};
use pieces::Below;

/// A witness that `graph` is not (r,s)-robust, or `None` if it is, by exhaustive search and by nothing else.
///
/// [`crate::decide::Robustness`] asks the bounds first and uses the table too. r = 0, s = 0 and single nodes: `None`.
//= paper def:robustness
pub fn witness(graph: &Graph, r: usize, s: usize, meter: &mut Meter<'_>) -> Result<Option<Witness>, Stopped> {
    match meter.within(PLAIN, |meter| plain(graph, r, s, meter))? {
        Some(found) => Ok(found),
        None => long(graph, r, s, Spectrum::new(graph), ALIKE, meter),
    }
}

/// How long a search is before it is begun again with all that helps long ones. Nodes of the tree.
pub(crate) const PLAIN: u64 = 2000;

/// How long a search of one set after the other is before both are sought at once. Nodes of the tree.
const INFORMED: u64 = 1 << 14;

/// How long the search of one node is before its like are looked for. Nodes of the tree.
pub(crate) const ALIKE: u64 = 2000;

/// How much work may go into ruling out sizes before all further ones are left to the search. Nodes of the tree.
const JOINT_NODES: u64 = 1 << 16;

/// How a question is searched.
enum Way<'q> {
    /// As it is for short questions.
    Plain,
    /// In pieces, with symmetry once the search of a node was longer than `alike`, and with what the spectrum says of sizes.
    Informed { spectrum: Option<Spectrum>, alike: u64 },
    /// Over both sets at once, for sizes that are left to them.
    Both { quadruples: &'q [Quadruple], alike: u64 },
}

impl Way<'_> {
    /// A witness that is found this way, or `None` if there is none.
    fn search(
        &self,
        graph: &Graph,
        r: usize,
        s: usize,
        meter: &mut Meter<'_>,
    ) -> Result<Option<Witness>, Stopped> {
        if r == 0 || s == 0 || graph.node_count() < 2 {
            return Ok(None);
        }
        meter.ask(r, s);
        let sets = if graph.node_count() <= 64 {
            self.sets::<u64>(graph, r, s, meter)?
        } else {
            self.sets::<u128>(graph, r, s, meter)?
        };
        Ok(sets.map(|sets| checked(graph, r, s, sets)))
    }

    /// The two sets of such a witness, sought in words as wide as the graph needs.
    fn sets<W: Word + Send + Sync>(
        &self,
        graph: &Graph,
        r: usize,
        s: usize,
        meter: &mut Meter<'_>,
    ) -> Result<Option<(NodeSet, NodeSet)>, Stopped> {
        let found = match *self {
            Self::Plain => Search::new(&Board::<W>::plain(graph, r), meter).roots(room(graph, s))?,
            Self::Informed { spectrum, alike } => {
                let board = Board::<W>::informed(graph, r, spectrum, alike);
                pieces::search(&Below { board: &board, room: room(graph, s) }, meter)?
            }
            //= theory sec:joint-search
            Self::Both { quadruples, alike } => {
                let board = Board::<W>::informed(graph, r, None, alike);
                pieces::search(&Both::new(&board, quadruples, count(s) - 1), meter)?
            }
        };
        Ok(found.map(as_sets))
    }
}

/// The search as it is for short questions.
pub(crate) fn plain(
    graph: &Graph,
    r: usize,
    s: usize,
    meter: &mut Meter<'_>,
) -> Result<Option<Witness>, Stopped> {
    Way::Plain.search(graph, r, s, meter)
}

/// The search for long questions: of one set after the other, and when that is long too, of both at once.
pub(crate) fn long(
    graph: &Graph,
    r: usize,
    s: usize,
    spectrum: Option<Spectrum>,
    alike: u64,
    meter: &mut Meter<'_>,
) -> Result<Option<Witness>, Stopped> {
    let Some(bounds) = spectrum.filter(|_| s > 1) else {
        return informed(graph, r, s, spectrum, alike, meter);
    };
    let short = meter.within(INFORMED, |meter| informed(graph, r, s, spectrum, alike, meter))?;
    if let Some(found) = short {
        return Ok(found);
    }
    match joint::quadruples(graph, bounds, r, count(s) - 1, JOINT_NODES, meter)? {
        Some(quadruples) => Way::Both { quadruples: &quadruples, alike }.search(graph, r, s, meter),
        None => informed(graph, r, s, spectrum, alike, meter),
    }
}

/// The search in pieces, with symmetry once the search of a node was longer than `alike`, and with what the spectrum says of sizes.
pub(crate) fn informed(
    graph: &Graph,
    r: usize,
    s: usize,
    spectrum: Option<Spectrum>,
    alike: u64,
    meter: &mut Meter<'_>,
) -> Result<Option<Witness>, Stopped> {
    Way::Informed { spectrum, alike }.search(graph, r, s, meter)
}

fn checked(graph: &Graph, r: usize, s: usize, (first, second): (NodeSet, NodeSet)) -> Witness {
    let witness = Witness::new(graph, r, s, first, second);
    debug_assert!(witness.holds(graph), "{witness:?}");
    witness
}

/// Two disjoint sets: S₁ is sought with no more exempt members than S₂, so with half of them or fewer; and if none may be exempt, with
/// no more members, so with n/2 or fewer.
fn room<W: Word>(graph: &Graph, s: usize) -> Room<W> {
    let effort = count(s) - 1;
    let field = W::from_bits(graph.nodes().bits());
    Room { effort, own: effort / 2, other: 0, field, pair: true }
}

fn as_sets<W: Word>((first, second): (W, W)) -> (NodeSet, NodeSet) {
    (NodeSet::from_bits(first.bits()), NodeSet::from_bits(second.bits()))
}

/// Counts of nodes are at most 128; larger r and s change nothing above that.
fn count(value: usize) -> i32 {
    i32::try_from(value).unwrap_or(i32::MAX / 4)
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;
    use core::ops::ControlFlow;

    use super::*;
    use crate::definition;
    use crate::effort::Progress;
    use crate::makers::{fixed, random, symmetric};

    fn agree(graph: &Graph) {
        let mut go_on = |_: &Progress| ControlFlow::Continue(());
        let mut meter = Meter::new(u64::MAX, &mut go_on);
        let spectrum = Spectrum::new(graph);
        for r in 1..=graph.node_count().div_ceil(2) + 1 {
            for s in 1..=graph.node_count() {
                let with = informed(graph, r, s, spectrum, 0, &mut meter).unwrap();
                let is_robust = definition::is_robust(graph, r, s);
                assert_eq!(with.is_none(), is_robust, "({r}, {s}), {graph:?}");
                let Some(spectrum) = spectrum else { continue };
                for nodes in [0, u64::MAX] {
                    let sizes = joint::quadruples(graph, spectrum, r, count(s) - 1, nodes, &mut meter);
                    let way = Way::Both { quadruples: &sizes.unwrap().unwrap(), alike: 0 };
                    let with = way.search(graph, r, s, &mut meter).unwrap();
                    assert_eq!(with.is_none(), is_robust, "({r}, {s}), {nodes} nodes, {graph:?}");
                }
            }
        }
    }

    fn by_both(graph: &Graph, r: usize, s: usize) -> bool {
        let mut go_on = |_: &Progress| ControlFlow::Continue(());
        let mut meter = Meter::new(u64::MAX, &mut go_on);
        let spectrum = Spectrum::new(graph).unwrap();
        let sizes = joint::quadruples(graph, spectrum, r, count(s) - 1, JOINT_NODES, &mut meter);
        let way = Way::Both { quadruples: &sizes.unwrap().unwrap(), alike: ALIKE };
        way.search(graph, r, s, &mut meter).unwrap().is_none()
    }

    //= theory sec:joint-search type=test
    #[test]
    fn both_sets_at_once_say_what_the_table_says() {
        let mut go_on = |_: &Progress| ControlFlow::Continue(());
        let mut meter = Meter::new(u64::MAX, &mut go_on);
        for seed in 0..8 {
            let degree = 4 + usize::try_from(seed).unwrap();
            let chance = 0.5 + 0.05 * f64::from(u32::try_from(seed).unwrap());
            let graphs = [
                random::regular(14, degree, seed).unwrap(),
                random::erdos_renyi(15, chance, false, seed).unwrap(),
            ];
            for (graph, r) in graphs.iter().flat_map(|graph| (1..7).map(move |r| (graph, r))) {
                let (s, _) = crate::table::s_max(graph, r, 1 << 15, &mut meter).unwrap();
                assert!((1..=s).rev().take(2).all(|s| by_both(graph, r, s)), "({r}, {s}), {graph:?}");
                let more = (s + 1..=graph.node_count()).take(2);
                assert!(more.into_iter().all(|s| !by_both(graph, r, s)), "({r}, {s}), {graph:?}");
            }
        }
    }

    #[test]
    fn both_sets_at_once_take_more_than_64_nodes() {
        let graph = symmetric::multipartite(11, 6).unwrap();
        let robust: Vec<bool> = (24..=32).map(|r| by_both(&graph, r, 2)).collect();
        let mut go_on = |_: &Progress| ControlFlow::Continue(());
        let mut meter = Meter::new(u64::MAX, &mut go_on);
        let spectrum = Spectrum::new(&graph);
        let expected =
            (24..=32).map(|r| informed(&graph, r, 2, spectrum, ALIKE, &mut meter).unwrap().is_none());
        assert_eq!(robust, expected.collect::<Vec<_>>());
        assert!(robust.contains(&true) && robust.contains(&false), "{robust:?}");
    }

    //= theory sec:symmetry type=test
    //= theory sec:joint-search type=test
    #[test]
    fn neither_symmetry_nor_eigenvalues_nor_sizes_hide_a_witness() {
        for code in 0..1_u32 << 10 {
            let pairs = (0..5).flat_map(|from| (from + 1..5).map(move |to| (from, to)));
            let chosen = pairs.enumerate().filter(|(bit, _)| code >> bit & 1 == 1).map(|(_, edge)| edge);
            agree(&Graph::undirected(5, &chosen.collect::<Vec<_>>()).unwrap());
        }
        for seed in 0..40 {
            agree(&random::erdos_renyi(4, 0.5, true, seed).unwrap());
            agree(&random::regular(8, 1 + usize::try_from(seed % 6).unwrap(), seed).unwrap());
        }
        for reach in 1..=4 {
            agree(&fixed::k_circulant(9, reach, true).unwrap());
            agree(&fixed::k_circulant(9, reach, false).unwrap());
            agree(&fixed::bipartite(reach, 8 - reach).unwrap());
            agree(&symmetric::multipartite(reach, 8 / reach).unwrap());
        }
        for graph in
            [fixed::hypercube(3), fixed::wheel(8), fixed::grid(3, 3), fixed::elemental(2), fixed::tight(8, 2)]
        {
            agree(&graph.unwrap());
        }
    }
}
