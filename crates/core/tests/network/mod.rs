//! Networks of robots that agree by W-MSR, some of which lie, and thm:contraction for one round of one.

use closeranks_core::need::{Keep, Need};
use closeranks_core::robot::neighbor::RobotId;
use closeranks_core::wmsr::update;

pub(crate) const ROBOTS_MAX: usize = 30;

pub(crate) type Values = [f64; ROBOTS_MAX];

/// Who hears whom, as sets of bits, and who lies.
pub(crate) struct Network {
    pub(crate) links: Vec<u32>,
    pub(crate) normal: usize,
    pub(crate) faults: u16,
}

impl Network {
    pub(crate) fn required(&self) -> usize {
        let robots = u16::try_from(self.links.len()).unwrap_or(u16::MAX);
        Need::new(robots, self.faults, Keep::Neighbors).need(RobotId(1)).into()
    }

    pub(crate) fn normal_degree(&self) -> usize {
        let degrees = self.links[..self.normal].iter().map(|links| links.count_ones() as usize);
        degrees.min().unwrap_or(0)
    }

    /// One round in which `told(sender, receiver)` is what arrives; malicious robots keep their value.
    pub(crate) fn step(&self, values: &Values, told: impl Fn(usize, usize) -> f64) -> Values {
        let mut next = *values;
        for receiver in 0..self.normal {
            let (mut heard, mut count) = ([0.0; ROBOTS_MAX], 0);
            for sender in (0..self.links.len()).filter(|sender| self.links[receiver] >> sender & 1 == 1) {
                heard[count] = told(sender, receiver);
                count += 1;
            }
            next[receiver] = update(values[receiver], &mut heard[..count], self.faults).value;
        }
        next
    }

    pub(crate) fn hull(&self, values: &Values) -> (f64, f64) {
        let normal = &values[..self.normal];
        (normal.iter().copied().fold(f64::MAX, f64::min), normal.iter().copied().fold(f64::MIN, f64::max))
    }

    pub(crate) fn spread(&self, values: &Values) -> f64 {
        let (low, high) = self.hull(values);
        high - low
    }

    /// Each malicious robot in turn tells whatever makes the next spread widest: a value of somebody, or one far out.
    pub(crate) fn lie_greedily(&self, values: &mut Values) {
        let mut lies = values[..self.normal].to_vec();
        lies.extend([-1e9, 1e9]);
        for liar in self.normal..self.links.len() {
            let mut widest = -1.0;
            let mut best = 0.0;
            for &lie in &lies {
                values[liar] = lie;
                let spread = self.spread(&self.step(values, |sender, _| values[sender]));
                if spread > widest {
                    (widest, best) = (spread, lie);
                }
            }
            values[liar] = best;
        }
    }
}

pub(crate) fn join(links: &mut [u32], a: usize, b: usize) {
    links[a] |= 1 << b;
    links[b] |= 1 << a;
}

/// The graph whose links, in the order (0,1), (0,2), (1,2), (0,3) …, are the bits of `graph`.
pub(crate) fn graph_of(robots: usize, graph: u32) -> Vec<u32> {
    let mut links = vec![0; robots];
    let pairs = (1..robots).flat_map(|b| (0..b).map(move |a| (a, b)));
    for (bit, (a, b)) in pairs.enumerate() {
        if graph >> bit & 1 == 1 {
            join(&mut links, a, b);
        }
    }
    links
}

pub(crate) fn join_all(links: &mut [u32], robots: core::ops::Range<usize>) {
    for a in robots.clone() {
        for b in a + 1..robots.end {
            join(links, a, b);
        }
    }
}

/// Cliques of ⌊n/2⌋ and ⌈n/2⌉ robots; each of the first is linked to `across` of the second, spread cyclically.
pub(crate) fn two_cliques(robots: usize, across: usize, faults: u16) -> Network {
    let (mut links, half) = (vec![0; robots], robots / 2);
    join_all(&mut links, 0..half);
    join_all(&mut links, half..robots);
    for link in 0..half * across {
        join(&mut links, link / across, half + link % (robots - half));
    }
    Network { links, normal: robots, faults }
}

/// Holds one round against thm:contraction; returns by how much the spread shrank.
pub(crate) fn check_round(network: &Network, values: &Values) -> f64 {
    let next = network.step(values, |sender, _| values[sender]);
    let (low, high) = network.hull(values);
    let (next_low, next_high) = network.hull(&next);
    assert!(
        low <= next_low && next_high <= high,
        "{next:?} leaves the hull of {values:?}, {:?}",
        network.links
    );
    let beta = 1.0 / f64::from(u32::try_from(network.links.len()).unwrap_or(u32::MAX));
    // a mean of up to n values rounds n times
    let rounding = 30.0 * f64::EPSILON * low.abs().max(high.abs());
    let (before, after) = (high - low, next_high - next_low);
    assert!(
        after <= (1.0 - 0.5 * beta) * before + rounding,
        "{before} to {after} with {values:?}, {:?}",
        network.links
    );
    if before > 1e6 * rounding { after / before } else { 0.0 }
}
