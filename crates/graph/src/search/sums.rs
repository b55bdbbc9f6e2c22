//! What the nodes that a set may still take can do for all of its content members together.

use super::peel::Needs;
use super::side::Side;
use crate::graph::set::NODE_LIMIT;
use crate::graph::word::Word;

/// The most that a number of nodes can give.
struct Best {
    sum: i32,
    /// What the last of them gives, and what the best one gives that is none of them; 0 if there is none.
    last: i32,
    next: i32,
}

impl Best {
    /// Of nodes that give so much each, the best `places`.
    fn new(gifts: impl Iterator<Item = i32>, places: i32) -> Self {
        let mut counts = [0_i32; NODE_LIMIT + 1];
        for gift in gifts {
            counts[usize::try_from(gift).unwrap_or(0)] += 1;
        }
        let (mut best, mut places) = (Self { sum: 0, last: 0, next: 0 }, places.max(0));
        for (gift, count) in counts.into_iter().enumerate().rev().filter(|(_, count)| *count > 0) {
            let gift = super::count(gift);
            let taken = count.min(places);
            places -= taken;
            best.sum += taken * gift;
            if places == 0 && taken > 0 {
                best.last = gift;
            }
            if taken < count {
                best.next = gift;
                break;
            }
        }
        best
    }
}

impl<W: Word> Side<W> {
    /// All content members lack a number of members together, and every node that is still taken is heard by some of them. With room for
    /// few more, those who are heard by too few cannot be taken, and those without whom the rest would not do must be. `None` if even the
    /// best do not do. Only searches that are long ask this.
    //= theory sec:search
    pub(super) fn bound_by_sum(&mut self, needs: &Needs<W>, size: i32) -> Option<()> {
        let lack = |node: usize| (needs.need[node] - needs.heard_in(node, self.members)).max(0);
        let lacking = self
            .content
            .nodes()
            .filter(|node| lack(*node) > 0)
            .map(W::one)
            .fold(W::NONE, |all, one| all | one);
        if lacking.is_none() || needs.told.is_empty() {
            return Some(());
        }
        let open = self.allowed.without(self.members);
        let gift = |node: usize| (needs.told[node] & lacking).count();
        let best = Best::new(open.nodes().map(gift), size - self.members.count());
        let spare = best.sum - lacking.nodes().map(lack).sum::<i32>();
        if spare < 0 {
            return None;
        }
        for node in open.nodes() {
            let one = W::one(node);
            if best.last - gift(node) > spare {
                (self.allowed, self.able) = (self.allowed.without(one), self.able.without(one));
            } else if gift(node) - best.next > spare {
                self.members = self.members | one;
            }
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Graph;
    use crate::makers::random;

    #[test]
    fn the_best_are_counted() {
        let best = |places| {
            let best = Best::new([3, 0, 5, 3, 1].into_iter(), places);
            [best.sum, best.last, best.next]
        };
        assert_eq!([1, 2, 3].map(best), [[5, 5, 3], [8, 3, 3], [11, 3, 1]]);
        assert_eq!([5, 6, 0, -1].map(best), [[12, 0, 0], [12, 0, 0], [0, 0, 5], [0, 0, 5]]);
    }

    const NODES: usize = 8;

    /// The members of a set that are content.
    fn content(needs: &Needs<u64>, set: u64) -> u64 {
        let is_content = |node: &usize| needs.heard_in(*node, set) >= needs.need[*node];
        set.nodes().filter(is_content).map(u64::one).fold(0, |all, one| all | one)
    }

    /// What is known of `set` where `seen` are the nodes of which it is known whether they are members; and how much more is concluded.
    fn keeps(needs: &Needs<u64>, set: u64, seen: u64) -> usize {
        let allowed = ((1 << NODES) - 1) & (set | !seen);
        let members = set & seen;
        let before = Side { members, content: content(needs, set) & members, allowed, able: allowed };
        let mut side = before;
        assert!(side.bound_by_sum(needs, set.count()).is_some(), "{set:b} {seen:b}");
        assert!(side.members.is_within(set) && set.is_within(side.allowed), "{set:b} {seen:b}");
        usize::from(side != before)
    }

    fn concluded(graph: &Graph, r: usize) -> usize {
        let needs = Needs::<u64>::thorough(graph, r);
        let mut count = 0;
        for set in 1..1_u64 << NODES {
            let content = content(&needs, set);
            let exempt = set.without(content).count();
            if content != 0 {
                assert!(needs.least_size(content, exempt) <= set.count(), "{set:b}");
                count += (0..1_u64 << NODES).step_by(7).map(|seen| keeps(&needs, set, seen)).sum::<usize>();
            }
        }
        count
    }

    //= theory sec:search type=test
    #[test]
    fn no_set_is_lost() {
        let graphs = (0..6).map(|seed| random::erdos_renyi(NODES, 0.7, seed % 2 == 0, seed).unwrap());
        let count: usize = graphs.flat_map(|graph| (1..4).map(move |r| concluded(&graph, r))).sum();
        assert!(count > 1000, "{count} conclusions are too few to say anything");
    }
}
