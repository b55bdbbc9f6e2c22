//! Pairs of robots within a radius, found once for both ends.

use closeranks_core::num::Vector;

use crate::geometry::crowd::Crowd;
use crate::geometry::squared_distance;

/// Finds, robot by robot, those of lower numbers that are near.
#[derive(Clone, Debug, Default)]
pub(crate) struct Near {
    crowd: Crowd,
    /// Who was near each robot when it was looked at last: mostly they still are.
    known: Vec<Vec<u16>>,
    found: Found,
}

/// Robots that are near, and their squared distances, m².
#[derive(Clone, Debug, Default)]
struct Found {
    firsts: Vec<u16>,
    distances_m2: Vec<f64>,
}

impl Near {
    /// Gets ready for robots at `positions_m`; true if a grid of cells is in use.
    pub(crate) fn look<const D: usize>(&mut self, positions_m: &[Vector<D>], radius_m: f64) -> bool {
        let sparse = self.crowd.split(positions_m, radius_m);
        if sparse {
            self.crowd.count(positions_m);
            self.known.resize(positions_m.len(), Vec::new());
        }
        sparse
    }

    /// Robots before `second` within the radius, in order, and their squared distances, m².
    #[inline]
    pub(crate) fn before<const D: usize>(
        &mut self,
        second: usize,
        positions_m: &[Vector<D>],
        radius_m: f64,
    ) -> (&[u16], &[f64]) {
        let own = &positions_m[second];
        if !self.crowd.is_sparse() {
            let kept = self.found.take(second, positions_m, own, radius_m);
            return self.found.first(kept);
        }
        let Self { crowd, known, found } = self;
        let known = &mut known[second];
        let many = usize::from(crowd.counts()[second]);
        if known.len() != many || !found.measure(known, positions_m, own, radius_m) {
            crowd.around(second, positions_m, known);
            found.measure(known, positions_m, own, radius_m);
        }
        let lower = known.partition_point(|other| usize::from(*other) < second);
        (&known[..lower], &found.distances_m2[..lower])
    }
}

impl Found {
    /// Keeps of the first `count` robots those within the radius of `own`, and says how many they are.
    #[inline]
    fn take<const D: usize>(
        &mut self,
        count: usize,
        positions_m: &[Vector<D>],
        own: &Vector<D>,
        radius_m: f64,
    ) -> usize {
        if self.firsts.len() < count {
            self.firsts.resize(count, 0);
            self.distances_m2.resize(count, 0.0);
        }
        let (firsts, distances_m2) = (&mut self.firsts[..count], &mut self.distances_m2[..count]);
        let (mut kept, radius_m2) = (0, radius_m * radius_m);
        for (first, position_m) in (0..).zip(&positions_m[..count]) {
            let distance_m2 = squared_distance(position_m, own);
            (firsts[kept], distances_m2[kept]) = (first, distance_m2);
            // Where a robot is out of range, the next one takes its place.
            kept += usize::from(radius_m2 - distance_m2 >= 0.0);
        }
        kept
    }

    /// Measures how far those that are `known` are from `own`. True if all are within the radius.
    #[inline]
    fn measure<const D: usize>(
        &mut self,
        known: &[u16],
        positions_m: &[Vector<D>],
        own: &Vector<D>,
        radius_m: f64,
    ) -> bool {
        if self.distances_m2.len() < known.len() {
            self.distances_m2.resize(known.len(), 0.0);
        }
        let (mut all, radius_m2) = (true, radius_m * radius_m);
        for (distance_m2, other) in self.distances_m2.iter_mut().zip(known) {
            *distance_m2 = squared_distance(&positions_m[usize::from(*other)], own);
            all &= radius_m2 - *distance_m2 >= 0.0;
        }
        all
    }

    /// The first so many.
    fn first(&self, kept: usize) -> (&[u16], &[f64]) {
        (&self.firsts[..kept], &self.distances_m2[..kept])
    }
}

pub(crate) fn small(index: usize) -> u16 {
    u16::try_from(index).unwrap_or(u16::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Random, Stream};

    fn check<const D: usize>(seed: u64, robots: usize, half_side_m: f64) -> bool {
        let mut random = Random::new(seed, Stream::Start);
        let mut place = || core::array::from_fn(|_| random.uniform(-half_side_m, half_side_m));
        let positions_m: Vec<Vector<D>> = (0..robots).map(|_| place()).collect();
        let mut near = Near::default();
        let sparse = near.look(&positions_m, 1.0);
        for second in 0..robots {
            let (firsts, distances_m2) = near.before(second, &positions_m, 1.0);
            let firsts = firsts.iter().map(|first| usize::from(*first));
            let found: Vec<_> = firsts.zip(distances_m2.iter().copied()).collect();
            let all = positions_m[..second].iter().map(|other| squared_distance(other, &positions_m[second]));
            let within: Vec<_> = all.enumerate().filter(|(_, distance_m2)| *distance_m2 <= 1.0).collect();
            assert_eq!(found, within, "robot {second} of {robots}, seed {seed}");
        }
        sparse
    }

    #[test]
    fn cells_find_what_looking_at_every_pair_finds() {
        let mut sparse = 0;
        for seed in 0..6 {
            for half_side_m in [0.5, 1.9, 3.0, 20.0, 300.0] {
                sparse += usize::from(check::<2>(seed, 200, half_side_m));
                sparse += usize::from(check::<3>(seed, 200, half_side_m));
                assert!(!check::<2>(seed, 40, half_side_m));
            }
        }
        assert!(sparse >= 36, "{sparse}");
    }

    /// Robots that were known are looked for again where some came or left.
    #[test]
    fn robots_that_move_are_found_as_if_nobody_had_been_known() {
        let mut random = Random::new(7, Stream::Start);
        let mut draw = |by_m: f64| core::array::from_fn(|_| random.uniform(-by_m, by_m));
        let mut positions_m: Vec<Vector<2>> = (0..300).map(|_| draw(8.0)).collect();
        let (mut near, mut changed) = (Near::default(), 0);
        for _ in 0..30 {
            let mut fresh = Near::default();
            assert!(near.look(&positions_m, 1.0) && fresh.look(&positions_m, 1.0));
            for second in 0..300 {
                let before = near.known[second].clone();
                let found = near.before(second, &positions_m, 1.0);
                assert_eq!(found, fresh.before(second, &positions_m, 1.0));
                changed += usize::from(near.known[second] != before);
            }
            for position_m in &mut positions_m {
                let step_m: Vector<2> = draw(0.05);
                *position_m = [position_m[0] + step_m[0], position_m[1] + step_m[1]];
            }
        }
        assert!((600..6_000).contains(&changed), "{changed}");
    }
}
