//! Weights and ties of all pairs of a tick, each computed once for both ends, and what a robot sees of them.

use closeranks_core::controller::budget::inequality::Pair;
use closeranks_core::controller::budget::knowledge::Seen;
use closeranks_core::equations::link::Link;
use closeranks_core::num::{add_scaled, sqrt, subtract};
use closeranks_core::settings::params::Params;

use crate::engine::fleet::id;
use crate::frame::Frame;
use crate::monitors::truth::fill_pairs;

/// Weights that are summed at a time.
const LANES: usize = 4;

/// All pairs of a team.
#[derive(Clone, Debug)]
pub(crate) struct Ties {
    robots: usize,
    /// Weight of every robot with every other, in lines of whole blocks, and how long a line is.
    weights: Vec<f64>,
    line: usize,
    /// Tie of every robot with every other.
    all: Vec<Pair>,
    /// Of pairs in the order of [`crate::monitors::truth::Truth::pairs_m2`] weights, before that squared distances, m², slopes and κ.
    pair_weights: Vec<f64>,
    slopes: Vec<f64>,
    bends: Vec<f64>,
    /// Whom the robot that looked around sees, itself among them, whom not, and what it sees of the level of each.
    seen: Vec<usize>,
    unseen: Vec<usize>,
    lows: Vec<f64>,
}

impl Ties {
    /// Of a team in which nobody has a link.
    pub(crate) fn new(robots: usize) -> Self {
        let line = robots.next_multiple_of(LANES);
        Self {
            robots,
            weights: vec![Link::NONE.weight; robots * line],
            line,
            all: vec![Pair::NONE; robots * robots],
            pair_weights: Vec::new(),
            slopes: Vec::new(),
            bends: Vec::new(),
            seen: Vec::new(),
            unseen: Vec::new(),
            lows: vec![0.0; line],
        }
    }

    /// Fills the ties, and of `frame` levels, degrees and the number of links.
    //= paper eq:connectivity
    pub(crate) fn find<const D: usize>(&mut self, params: &Params<D>, frame: &mut Frame<D>) {
        fill_pairs(&frame.positions_m, &mut self.pair_weights);
        self.bends.clear();
        self.bends.extend(self.pair_weights.iter().map(|pair_m2| sqrt(*pair_m2)));
        params.budget().bends_max(&mut self.bends);
        self.slopes.resize(self.pair_weights.len(), 0.0);
        params.link().links_at(&mut self.pair_weights, &mut self.slopes);
        frame.links = 0;
        let mut pair = 0;
        for second in 0..self.robots {
            self.find_links(second, pair, params, frame);
            pair += second;
        }
    }

    /// Links of `second` to robots of lower numbers, the first of which is that `pair`. So levels are sums in order of
    /// numbers.
    fn find_links<const D: usize>(
        &mut self,
        second: usize,
        pair: usize,
        params: &Params<D>,
        frame: &mut Frame<D>,
    ) {
        let (robots, line) = (self.robots, self.line);
        let (weights, ties) = (&mut self.weights[..robots * line], &mut self.all[..robots * robots]);
        let [pair_weights, slopes, bends] =
            [&self.pair_weights, &self.slopes, &self.bends].map(|of| &of[pair..pair + second]);
        let Frame { positions_m, levels, degrees, .. } = frame;
        let (positions_m, position) = (&positions_m[..second], positions_m[second]);
        let (levels, own_level) = levels[..=second].split_at_mut(second);
        let (degrees, own_degree) = degrees[..=second].split_at_mut(second);
        let (mut level, mut degree) = (0.0, 0);
        for first in 0..second {
            let weight = pair_weights[first];
            weights[first * line + second] = weight;
            weights[second * line + first] = weight;
            if !is_link(weight) {
                continue;
            }
            let offset_m = subtract(&positions_m[first], &position);
            let tie = params.budget().pair_with(&offset_m, slopes[first], bends[first], params.reach());
            ties[first * robots + second] = tie;
            ties[second * robots + first] = tie;
            level += weight;
            levels[first] += weight;
            degree += 1;
            degrees[first] += 1;
        }
        frame.links += u32::from(degree);
        (own_level[0], own_degree[0]) = (level, degree);
    }

    #[inline]
    pub(crate) fn linked(&self, robot: usize, other: usize) -> bool {
        is_link(self.weights[robot * self.line + other])
    }

    #[inline]
    pub(crate) fn of(&self, robot: usize, other: usize) -> &Pair {
        &self.all[robot * self.robots + other]
    }

    /// The others that `robot` has a link with, in order of their numbers.
    #[inline]
    pub(crate) fn neighbors(&self, robot: usize) -> impl Iterator<Item = (usize, &Pair)> {
        let weights = &self.weights[robot * self.line..][..self.robots];
        let others = weights.iter().zip(&self.all[robot * self.robots..]).enumerate();
        others.filter(|(_, (weight, _))| is_link(**weight)).map(|(other, (_, tie))| (other, tie))
    }

    /// Whom `robot` does not see, and what it sees of the level of each: sums over the robots that it sees, in order of their
    /// numbers.
    pub(crate) fn look_around(&mut self, robot: usize) {
        let line = self.line;
        let weights = &self.weights[robot * line..][..self.robots];
        self.unseen.clear();
        let sees = |other: usize| other == robot || is_link(weights[other]);
        self.unseen.extend((0..weights.len()).filter(|other| !sees(*other)));
        if self.unseen.is_empty() {
            return;
        }
        self.seen.clear();
        self.seen.extend((0..weights.len()).filter(|other| sees(*other)));
        for (block, lows) in self.lows.as_chunks_mut().0.iter_mut().enumerate() {
            let weights = |other: &usize| self.weights[other * line + block * LANES..].first_chunk();
            let weights = self.seen.iter().filter_map(weights);
            *lows = weights.fold([0.0; LANES], |sums, weights| add_scaled(&sums, 1.0, weights));
        }
    }

    /// What the robot that looked around sees of `other`, which has so many neighbours and whose claim still says so much; `None`
    /// if it sees everybody.
    #[inline]
    pub(crate) fn seen(&self, other: usize, degree: u16, discounted_claim: f64) -> Option<Seen<'_>> {
        if self.unseen.is_empty() {
            return None;
        }
        let weights = &self.weights[other * self.line..];
        let beyond: u16 = self.unseen.iter().map(|unseen| u16::from(!is_link(weights[*unseen]))).sum();
        let degree = f64::from(degree) + f64::from(beyond);
        let (robot, low, unseen) = (id(other), self.lows[other], self.unseen.len());
        Some(Seen { robot, low, degree, unseen, discounted_claim, weights: &[] })
    }
}

fn is_link(weight: f64) -> bool {
    Link::is_link(weight)
}
