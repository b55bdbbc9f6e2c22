//! Small cores that the exact search proves, where counting does not.

use crate::effort::Meter;
use crate::graph::Graph;
use crate::network::Network;
use crate::roles::{self, Liars, Question};

/// Largest core that is given to the exact search.
pub(super) const CORE_MAX: usize = 16;
/// All attempts for one order together may visit so many places of the search.
pub(super) const EFFORT: u64 = 1 << 18;
/// One question about one core may visit so many.
const QUESTION: u64 = 1 << 14;

/// Whether `core` by itself survives F liars around each of its nodes: no set of liars splits it.
//= theory thm:ranks-exact
pub(super) fn survives(network: &Network, core: &[u32], f: usize, meter: &mut Meter<'_>) -> bool {
    if core.len() > CORE_MAX {
        return false;
    }
    let Some(graph) = inside(network, core) else { return false };
    let is_wide = graph.degree_min() > f;
    let question = Question { r: f + 1, liars: Liars::Local };
    is_wide && matches!(meter.within(QUESTION, |meter| roles::split(&graph, question, meter)), Ok(Some(None)))
}

/// The network among the nodes of a core; `None` if it is no graph that can be searched.
pub(super) fn inside(network: &Network, core: &[u32]) -> Option<Graph> {
    let mut graph = Graph::empty(core.len(), network.is_directed()).ok()?;
    for (to, node) in core.iter().enumerate() {
        for (from, other) in core.iter().enumerate() {
            if network.has_edge(*other, *node as usize) && (network.is_directed() || from < to) {
                graph.add_edge(from, to).ok()?;
            }
        }
    }
    Some(graph)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::makers::fixed::{bipartite, complete, petersen};
    use alloc::vec::Vec;
    use core::ops::ControlFlow;

    //= theory thm:ranks-exact type=test
    #[test]
    fn what_survives_has_no_witness_and_what_does_not_has_one() {
        let mut go_on = |_: &_| ControlFlow::Continue(());
        let mut meter = Meter::new(u64::MAX, &mut go_on);
        for graph in [bipartite(5, 5).unwrap(), petersen().unwrap(), complete(9).unwrap()] {
            let network = Network::from(&graph);
            let all: Vec<u32> = (0..u32::try_from(graph.node_count()).unwrap()).collect();
            for f in 0..3 {
                let question = Question { r: f + 1, liars: Liars::Local };
                let split = roles::split(&graph, question, &mut meter).unwrap();
                assert_eq!(survives(&network, &all, f, &mut meter), split.is_none(), "F = {f}");
            }
        }
    }

    #[test]
    fn a_core_is_asked_about_by_itself() {
        let network = Network::from(&complete(13).unwrap());
        let mut go_on = |_: &_| ControlFlow::Continue(());
        let mut meter = Meter::new(u64::MAX, &mut go_on);
        assert!(survives(&network, &[3, 7, 9, 11, 12], 1, &mut meter));
        assert!(!survives(&network, &[3, 7], 1, &mut meter));
        let network = Network::from(&complete(17).unwrap());
        let large: Vec<u32> = (0..17).collect();
        assert!(!survives(&network, &large, 1, &mut meter), "more than is searched");
    }
}
