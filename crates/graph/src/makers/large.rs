//! Networks of any size, by name.

use alloc::vec::Vec;

use super::{MakerError, require};
use crate::generator::Generator;
use crate::network::{NETWORK_LIMIT, Network};

/// A network with an order in which each node hears 2F + 1 earlier ones, drawn at random; the first 2F + 1 all hear each other. So it
/// survives F liars around each node ([`ranks`](crate::ranks)), and none of its edges can be left out of that order.
pub fn ranked(node_count: usize, f: usize, seed: u64) -> Result<Network, MakerError> {
    let core = 2 * f + 1;
    require((core..=NETWORK_LIMIT).contains(&node_count), "nodes", "2F + 1 or more, up to 4194304")?;
    let (mut generator, mut pairs) = (Generator::new(seed), Vec::new());
    for node in 1..node_count {
        if node < core {
            pairs.extend((0..node).map(|earlier| (small(earlier), small(node))));
            continue;
        }
        let mut drawn: Vec<usize> = Vec::with_capacity(core);
        while drawn.len() < core {
            let earlier = generator.below(node);
            if !drawn.contains(&earlier) {
                drawn.push(earlier);
            }
        }
        pairs.extend(drawn.into_iter().map(|earlier| (small(earlier), small(node))));
    }
    Ok(Network::new(node_count, false, &pairs))
}

/// A triangular lattice of rows and columns: inside each node hears six others.
pub fn triangular(rows: usize, columns: usize) -> Result<Network, MakerError> {
    let count = rows.saturating_mul(columns);
    require((1..=NETWORK_LIMIT).contains(&count), "rows times columns", "1 to 4194304")?;
    let at = |row: usize, column: usize| small(row * columns + column);
    let mut pairs = Vec::new();
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        // Every other row is half a step to the right.
        let right = column + row % 2;
        let above =
            [right.checked_sub(1), Some(right)].into_iter().flatten().filter(|other| *other < columns);
        pairs.extend((column + 1 < columns).then(|| (at(row, column), at(row, column + 1))));
        if row + 1 < rows {
            pairs.extend(above.map(|other| (at(row, column), at(row + 1, other))));
        }
    }
    Ok(Network::new(count, false, &pairs))
}

fn small(node: usize) -> u32 {
    u32::try_from(node).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use core::ops::ControlFlow;

    use super::*;
    use crate::decide::Robustness;
    use crate::effort::{Effort, Meter};
    use crate::ranks::order;

    #[test]
    fn ranked_networks_survive_and_have_no_edge_too_many() {
        for (f, seed) in [(0, 1), (1, 2), (1, 3), (2, 4)] {
            let network = ranked(11, f, seed).unwrap();
            let core = 2 * f + 1;
            assert_eq!(network.edge_count(), core * (core - 1) / 2 + (11 - core) * core);
            order(&network, f).expect("it is built that way").check(&network).unwrap();
            let mut go_on = |_: &_| ControlFlow::Continue(());
            let mut meter = Meter::new(u64::MAX, &mut go_on);
            let graph = network.graph().unwrap();
            let f_max = Robustness::new(&graph, &Effort::UNLIMITED).f_max(&mut meter);
            assert!(f_max.exactly().unwrap() >= i32::try_from(f).unwrap(), "the exact search says so too");
        }
        assert!(ranked(4, 2, 1).is_err() && ranked(NETWORK_LIMIT + 1, 0, 1).is_err());
    }

    #[test]
    fn triangles_fill_the_lattice() {
        let network = triangular(5, 7).unwrap();
        assert_eq!(network.degrees().max(), Some(6));
        assert_eq!(network.degrees().filter(|degree| *degree == 6).count(), 3 * 5);
        assert_eq!(network.edge_count(), 5 * 6 + 4 * 13);
        assert!(triangular(0, 5).is_err() && triangular(usize::MAX, 2).is_err());
        // Three around each triangle hear each other, and each further node two of those before it: one liar is one too many.
        assert!(order(&network, 0).is_some() && order(&network, 1).is_none());
    }
}
