//! All links of a team in a tick, in one sorted list, each found and weighed once for both ends.

use closeranks_core::controller::{Batch, Control};
use closeranks_core::num::{Vector, subtract};
use closeranks_core::settings::params::Params;

use crate::engine::near::Near;
use crate::frame::Frame;

/// So many links are weighed at a time.
const BATCH: usize = 256;

/// The links of a team. A link is that of `second` with a `first` of a lower number; they come in order of the second, then of
/// the first end. So whoever adds to both ends along the list adds in order of numbers.
#[derive(Clone, Debug)]
pub(crate) struct Links<const D: usize, Pair> {
    /// First ends, second end after second end, and where those of each second end stop.
    firsts: Vec<u16>,
    stops: Vec<usize>,
    /// Links of which the controller made a pair.
    pairs: Vec<Linked<D, Pair>>,
    near: Near,
    batch: Waiting<D>,
}

/// Two linked robots that bound each other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Linked<const D: usize, Pair> {
    /// The lower number first.
    pub(crate) ends: [u16; 2],
    /// Position of the first less that of the second end, m.
    pub(crate) offset_m: Vector<D>,
    /// `a_ij`.
    pub(crate) weight: f64,
    /// What holds for both.
    pub(crate) pair: Pair,
}

/// Links that were found and not weighed yet.
#[derive(Clone, Debug)]
struct Waiting<const D: usize> {
    ends: Vec<[u16; 2]>,
    offsets_m: Vec<Vector<D>>,
    distances_m2: Vec<f64>,
    /// Per link: first the squared distance, m², then overwritten by the weight.
    weights: Vec<f64>,
    slopes: Vec<f64>,
}

impl<const D: usize, Pair: Copy> Links<D, Pair> {
    /// Of a team in which nobody has a link.
    pub(crate) fn new() -> Self {
        let batch = Waiting {
            ends: Vec::with_capacity(BATCH),
            offsets_m: Vec::with_capacity(BATCH),
            distances_m2: Vec::with_capacity(BATCH),
            weights: Vec::with_capacity(BATCH),
            slopes: Vec::with_capacity(BATCH),
        };
        Self { firsts: Vec::new(), stops: Vec::new(), pairs: Vec::new(), near: Near::default(), batch }
    }

    /// Finds the links of `frame`, and fills its levels, degrees and number of links.
    //= paper eq:connectivity
    pub(crate) fn find<C: Control<D, Pair = Pair>>(
        &mut self,
        params: &Params<D>,
        controller: &C,
        frame: &mut Frame<D>,
    ) {
        self.firsts.clear();
        self.stops.clear();
        self.pairs.clear();
        frame.levels.fill(0.0);
        frame.degrees.fill(0);
        let radius_m = params.link().radius_m;
        self.near.look(&frame.positions_m, radius_m);
        for second in 0..frame.positions_m.len() {
            let own = frame.positions_m[second];
            self.near.before(second, &frame.positions_m, radius_m, |first, distance_m2| {
                let ends = [small(first), small(second)];
                self.firsts.push(ends[0]);
                self.batch.push(ends, subtract(&frame.positions_m[first], &own), distance_m2);
            });
            self.stops.push(self.firsts.len());
            if self.batch.ends.len() >= BATCH {
                self.weigh(params, controller, frame);
            }
        }
        self.weigh(params, controller, frame);
        frame.links = u32::try_from(self.firsts.len()).unwrap_or(u32::MAX);
    }

    /// Weighs the links that wait, adds them to levels and degrees of both ends, and makes pairs of them.
    fn weigh<C: Control<D, Pair = Pair>>(
        &mut self,
        params: &Params<D>,
        controller: &C,
        frame: &mut Frame<D>,
    ) {
        let Self { pairs, batch, .. } = self;
        batch.slopes.resize(batch.ends.len(), 0.0);
        params.link().links_at(&mut batch.weights, &mut batch.slopes);
        for (ends, weight) in batch.ends.iter().zip(&batch.weights) {
            for end in ends.map(usize::from) {
                frame.levels[end] += weight;
                frame.degrees[end] += 1;
            }
        }
        let Waiting { ends, offsets_m, distances_m2, weights, slopes } = batch;
        let mut links = Batch { offsets_m, distances_m2, weights, slopes };
        controller.pairs(&mut links, |index, pair| {
            if let Some(pair) = pair {
                let (ends, offset_m, weight) = (ends[index], offsets_m[index], weights[index]);
                pairs.push(Linked { ends, offset_m, weight, pair });
            }
        });
        batch.clear();
    }

    /// Every robot with the numbers of its neighbours before it.
    pub(crate) fn by_second(&self) -> impl Iterator<Item = (usize, &[u16])> {
        let from = core::iter::once(&0).chain(&self.stops);
        from.zip(&self.stops).map(|(from, to)| &self.firsts[*from..*to]).enumerate()
    }

    /// The pairs in order.
    pub(crate) fn pairs(&self) -> &[Linked<D, Pair>] {
        &self.pairs
    }
}

impl<const D: usize> Waiting<D> {
    #[inline]
    fn push(&mut self, ends: [u16; 2], offset_m: Vector<D>, distance_m2: f64) {
        self.ends.push(ends);
        self.offsets_m.push(offset_m);
        self.distances_m2.push(distance_m2);
        self.weights.push(distance_m2);
    }

    fn clear(&mut self) {
        self.ends.clear();
        self.offsets_m.clear();
        self.distances_m2.clear();
        self.weights.clear();
    }
}

pub(crate) fn small(index: usize) -> u16 {
    u16::try_from(index).unwrap_or(u16::MAX)
}
