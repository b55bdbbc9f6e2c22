//! Which numbers of members two disjoint sets can have together.
//!
//! Of two sets that refute (r,s)-robustness let the content members and the exempt ones be counted, of each set by itself. For most such
//! four numbers there are no numbers of links between the five parts of the graph (two kinds of members of each set, and the rest) that meet
//! what degrees, the definition and eigenvalues ask for (docs/theory, `sec:joint-sizes`). A linear program in doubles proposes which
//! of these conditions contradict each other, and whole numbers decide whether they do.

mod degrees;
mod parts;
mod proof;
mod rules;
mod simplex;
mod sizes;
mod strong;
#[cfg(test)]
mod tests;
mod vectors;
mod whole;

use alloc::vec::Vec;

pub(crate) use parts::Quadruple;

use crate::effort::{Meter, Stopped};
use crate::graph::Graph;
use crate::spectrum::{Sizes, Spectrum};
use rules::Facts;
use sizes::Sieve;

/// More quadruples than this are not asked about.
const QUADRUPLES_MOST: usize = 1 << 18;

/// The numbers of members that some two sets with at most `exempt` exempt members together may have if any two refute (r, exempt + 1)-robustness,
/// for sets that cannot be made larger. S₁ has fewer exempt members than S₂, or as many and no more content ones.
///
/// What is not asked after `nodes` nodes of work is not ruled out. `None` if there are too many to ask about.
//= theory sec:joint-sizes
pub(crate) fn quadruples(
    graph: &Graph,
    spectrum: Spectrum,
    r: usize,
    exempt: i32,
    nodes: u64,
    meter: &mut Meter<'_>,
) -> Result<Option<Vec<Quadruple>>, Stopped> {
    let sizes = Sizes::new(graph, spectrum, r);
    if all(graph, &sizes, exempt).nth(QUADRUPLES_MOST).is_some() {
        return Ok(None);
    }
    let mut sieve = Sieve::new(Facts::new(graph, spectrum, r));
    let mut left = Vec::new();
    for quadruple in all(graph, &sizes, exempt) {
        let before = sieve.nodes;
        if before >= nodes || !sieve.rules_out(&quadruple) {
            left.push(quadruple);
        }
        for _ in before..sieve.nodes {
            meter.spend(1)?;
        }
    }
    Ok(Some(left))
}

/// All quadruples of which each set by itself is large enough.
fn all<'s>(graph: &Graph, sizes: &'s Sizes, exempt: i32) -> impl Iterator<Item = Quadruple> + 's {
    let nodes = i32::try_from(graph.node_count()).unwrap_or(i32::MAX);
    let least = |exempt: i32| {
        let size = usize::try_from(exempt).map_or(usize::MAX, |exempt| sizes.least(exempt));
        i32::try_from(size).unwrap_or(i32::MAX)
    };
    let exempt = exempt.min(nodes);
    let pairs =
        (0..=exempt / 2).flat_map(move |first| (first..=exempt - first).map(move |second| [first, second]));
    pairs.flat_map(move |exempt| {
        let [first, second] = exempt.map(least);
        let firsts = first..=nodes.saturating_sub(second);
        firsts.flat_map(move |one| (second..=nodes - one).map(move |other| [one, other])).filter_map(
            move |size| {
                let content = [size[0] - exempt[0], size[1] - exempt[1]];
                (exempt[0] < exempt[1] || content[0] <= content[1]).then_some(Quadruple { content, exempt })
            },
        )
    })
}
