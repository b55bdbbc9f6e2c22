//! What a controller adds to [`Control`] so that a whole team can be computed at once, with the bits of its robots one by one.
//!
//! A pair of robots is made once for both ends of a link, sums are added up along the list of all links, and every robot decides
//! by the function that it decides by on its own. A controller that does without pairs, sums or knowledge takes `()` for their types
//! and leaves their methods as they are.

use crate::controller::{Control, Decision};
use crate::equations::link::Link;
use crate::id::Member;
use crate::num::{Vector, subtract};
use crate::robot::scratch::Scratch;

/// A robot itself, as its neighbours do not know it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Own {
    /// Its number and its rank.
    pub member: Member,
    /// c_i, or what the controller has in its place.
    pub level: f64,
    /// The level that it tells. By Assumption 1 a liar's own row uses its lie.
    pub told_level: f64,
    /// How many neighbours may count: those in sight.
    pub degree: u16,
}

/// A neighbour as a controller needs it.
#[derive(Clone, Copy, Debug)]
pub struct Neighbor<'a, const D: usize, Pair, Known> {
    /// Its number and its rank.
    pub member: Member,
    /// x_i − x_j, m.
    pub offset_m: Vector<D>,
    /// What both ends share; `None` where the pair bounds the move of neither.
    pub pair: Option<&'a Pair>,
    /// What the robot knows of it.
    pub known: Known,
}

/// Links whose pairs are made together.
#[derive(Debug)]
pub struct Batch<'a, const D: usize> {
    /// Where all robots are, m.
    pub positions_m: &'a [Vector<D>],
    /// Index of the first and of the second end of each.
    pub ends: &'a [[u16; 2]],
    /// Squared distance of each, m². A controller may overwrite it.
    pub distances_m2: &'a mut [f64],
    /// `a_ij` of each.
    pub weights: &'a [f64],
    /// `2 ∂a/∂Δ²` of each, 1/m².
    pub slopes: &'a [f64],
}

impl<const D: usize> Batch<'_, D> {
    /// Position of the first less that of the second end of a link, m.
    #[inline]
    #[must_use]
    pub fn offset_m(&self, index: usize) -> Vector<D> {
        let [first, second] = self.ends[index].map(usize::from);
        subtract(&self.positions_m[first], &self.positions_m[second])
    }
}

/// What can be said of a neighbour j as robot i sees it, in a world in which all sense exactly and hear the same.
#[derive(Clone, Copy, Debug)]
pub struct Glimpse {
    /// j.
    pub member: Member,
    /// The weight of the link of i and j, if i counts for j, or else 0. Only ranks ask for it.
    pub weight: f64,
    /// The level that j told.
    pub told_level: f64,
    /// The true level of j.
    pub level: f64,
    /// How many neighbours j has that count for it.
    pub degree: u16,
    /// How many robots that may count for j i does not see.
    pub unseen: usize,
    /// How many of these are neighbours of j.
    pub unseen_near: usize,
    /// The sum of the weights of j with i and with whomever i sees, in order of numbers, where i does not see everybody.
    pub low: f64,
}

/// Where a robot is, where it wants to go, and where it went before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<const D: usize> {
    /// x_i, m.
    pub position_m: Vector<D>,
    /// u_{i,des}, m/s.
    pub desired_m_s: Vector<D>,
    /// u_i of the tick before, m/s.
    pub before_m_s: Vector<D>,
}

/// A controller whose robots can be computed all at once where nothing goes wrong.
pub trait AtOnce<const D: usize>: Control<D> + Send + Sync {
    /// What both ends of a link share. Two robots of which [`pair`](Self::pair) makes nothing do not bound each other.
    type Pair: Copy + core::fmt::Debug + Send + Sync + 'static;
    /// What others make of a level that a robot told.
    type Told: Copy + core::fmt::Debug + Default + Send + Sync + 'static;
    /// What a robot adds up over its neighbours.
    type Sums: Copy + core::fmt::Debug + Default + Send + Sync + 'static;
    /// What a robot knows of a neighbour when it decides.
    type Known: Copy + core::fmt::Debug + Default + Send + Sync + 'static;

    /// True if it adds up anything over neighbours.
    const ADDS: bool = false;
    /// True if it looks at every neighbour one by one; false if it does so only where sums fail.
    const LOOKS: bool = false;
    /// True if φ_i is part of its decision.
    const USES_PHI: bool = false;

    /// What both ends of a pair at `offset_m` (m) share, whose link is `link`.
    fn pair(&self, _offset_m: &Vector<D>, _link: &Link<f64>) -> Option<Self::Pair> {
        None
    }

    /// [`pair`](Self::pair) of many links, with the bits of each. `make` is called for every link in order.
    fn pairs(&self, links: &mut Batch<'_, D>, mut make: impl FnMut(usize, Option<Self::Pair>)) {
        for index in 0..links.ends.len() {
            let link = Link { weight: links.weights[index], slope: links.slopes[index] };
            make(index, self.pair(&links.offset_m(index), &link));
        }
    }

    /// What others make of a level that a robot told, or of none.
    fn told(&self, _level: Option<f64>) -> Self::Told {
        Self::Told::default()
    }

    /// Sums of a robot without neighbours.
    fn sums(&self, _own: &Self::Told) -> Self::Sums {
        Self::Sums::default()
    }

    /// Adds what a neighbour told. To be called for every neighbour, in order of their numbers.
    fn hear(&self, _sums: &mut Self::Sums, _told: &Self::Told) {}

    /// Adds a pair to the sums of one end, from which the other end is at −`offset_m`, with what this end and the other told.
    /// To be called for every neighbour with a pair, in order of their numbers.
    fn add(
        &self,
        _sums: &mut Self::Sums,
        _offset_m: &Vector<D>,
        _pair: &Self::Pair,
        _told: [&Self::Told; 2],
    ) {
    }

    /// Adds a pair to the sums of both ends; `offset_m` is that of the first.
    fn add_both(
        &self,
        sums: [&mut Self::Sums; 2],
        offset_m: &Vector<D>,
        pair: &Self::Pair,
        told: [&Self::Told; 2],
    ) {
        let ([first, second], [one, other]) = (sums, told);
        self.add(first, offset_m, pair, [one, other]);
        self.add(second, &offset_m.map(|component| -component), pair, [other, one]);
    }

    /// What a robot knows of a neighbour, as whoever computes a whole team at once finds it.
    fn know(&self, _glimpse: &Glimpse) -> Self::Known {
        Self::Known::default()
    }

    /// The velocity closest to the desired one that the controller allows. `neighbors` come in order of their numbers.
    fn decide<'a>(
        &self,
        own: &Own,
        sums: &Self::Sums,
        neighbors: impl Iterator<Item = Neighbor<'a, D, Self::Pair, Self::Known>> + Clone,
        motion: &Motion<D>,
        scratch: &mut Scratch<'_, D>,
    ) -> Decision<D>;
}
