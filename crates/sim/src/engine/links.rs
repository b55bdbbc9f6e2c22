//! All links of a team in a tick, in one sorted list, each found and weighed once for both ends.

use closeranks_core::controller::{AtOnce, Batch};
use closeranks_core::settings::params::Params;

use crate::engine::roster::Roster;
use crate::frame::Frame;
use crate::geometry::near::{Near, small};

/// So many links are weighed at a time: what they need stays close to the processor.
const BATCH: usize = 256;

/// The links of a team. A link is that of `second` with a `first` of a lower number; they come in order of the second, then of
/// the first end. So whoever adds to both ends along the list adds in order of numbers.
#[derive(Clone, Debug)]
pub(crate) struct Links<Pair> {
    /// First ends, second end after second end, and where those of each second end stop.
    firsts: Vec<u16>,
    stops: Vec<usize>,
    near: Near,
    /// How many neighbours count for each robot.
    counted: Vec<u16>,
    scales: Scales<Pair>,
}

/// Two linked robots that bound each other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Linked<Pair> {
    /// The lower number first.
    pub(crate) ends: [u16; 2],
    /// What holds for both.
    pub(crate) pair: Pair,
}

/// Weighs links that were found, a batch at a time.
#[derive(Clone, Debug)]
struct Scales<Pair> {
    /// Links of which the controller made a pair, and their weights where neighbours are looked at one by one.
    pairs: Vec<Linked<Pair>>,
    pair_weights: Vec<f64>,
    ends: Vec<[u16; 2]>,
    distances_m2: Vec<f64>,
    /// Per link that waits: first the squared distance, m², then overwritten by the weight.
    weights: Vec<f64>,
    slopes: Vec<f64>,
}

impl<Pair: Copy> Links<Pair> {
    /// Of a team in which nobody has a link.
    pub(crate) fn new() -> Self {
        let scales = Scales {
            pairs: Vec::new(),
            pair_weights: Vec::new(),
            ends: Vec::with_capacity(BATCH),
            distances_m2: Vec::with_capacity(BATCH),
            weights: Vec::with_capacity(BATCH),
            slopes: Vec::with_capacity(BATCH),
        };
        Self { firsts: Vec::new(), stops: Vec::new(), near: Near::default(), counted: Vec::new(), scales }
    }

    /// Finds the links of `frame`, and fills its levels, degrees and number of links.
    //= paper eq:connectivity
    pub(crate) fn find<const D: usize, C: AtOnce<D, Pair = Pair>>(
        &mut self,
        params: &Params<D>,
        controller: &C,
        roster: &Roster,
        frame: &mut Frame<D>,
    ) {
        self.firsts.clear();
        self.stops.clear();
        self.scales.pairs.clear();
        self.scales.pair_weights.clear();
        frame.levels.fill(0.0);
        frame.degrees.fill(0);
        self.counted.clear();
        self.counted.resize(frame.positions_m.len(), 0);
        let radius_m = params.link().radius_m;
        self.near.look(&frame.positions_m, radius_m);
        for second in 0..frame.positions_m.len() {
            let (firsts, distances_m2) = self.near.before(second, &frame.positions_m, radius_m);
            self.firsts.extend_from_slice(firsts);
            self.stops.push(self.firsts.len());
            for (firsts, distances_m2) in firsts.chunks(BATCH / 2).zip(distances_m2.chunks(BATCH / 2)) {
                self.scales.take(second, firsts, distances_m2);
                if self.scales.ends.len() >= BATCH / 2 {
                    self.scales.weigh(params, controller, (roster, &mut self.counted), frame);
                }
            }
        }
        self.scales.weigh(params, controller, (roster, &mut self.counted), frame);
        if !roster.is_ranked() {
            self.counted.copy_from_slice(&frame.degrees);
        }
        frame.links = u32::try_from(self.firsts.len()).unwrap_or(u32::MAX);
    }

    /// Every robot with the numbers of its neighbours before it.
    pub(crate) fn by_second(&self) -> impl Iterator<Item = (usize, &[u16])> {
        let from = core::iter::once(&0).chain(&self.stops);
        from.zip(&self.stops).map(|(from, to)| &self.firsts[*from..*to]).enumerate()
    }

    /// The ends of all links, in order.
    pub(crate) fn ends(&self) -> impl Iterator<Item = [u16; 2]> + Clone {
        let from = core::iter::once(&0).chain(&self.stops);
        let rows = from.zip(&self.stops).map(|(from, to)| &self.firsts[*from..*to]).zip(0..);
        rows.flat_map(|(firsts, second)| firsts.iter().map(move |first| [*first, second]))
    }

    /// How many neighbours count for each robot.
    pub(crate) fn counted(&self) -> &[u16] {
        &self.counted
    }

    /// The pairs in order.
    pub(crate) fn pairs(&self) -> &[Linked<Pair>] {
        &self.scales.pairs
    }

    /// `a_ij` of each pair, under a controller that looks at neighbours one by one.
    pub(crate) fn pair_weights(&self) -> &[f64] {
        &self.scales.pair_weights
    }
}

impl<Pair: Copy> Scales<Pair> {
    fn take(&mut self, second: usize, firsts: &[u16], distances_m2: &[f64]) {
        self.ends.extend(firsts.iter().map(|first| [*first, small(second)]));
        self.distances_m2.extend_from_slice(distances_m2);
    }

    /// Weighs the links that wait, adds them to levels and degrees of both ends, and makes pairs of them.
    fn weigh<const D: usize, C: AtOnce<D, Pair = Pair>>(
        &mut self,
        params: &Params<D>,
        controller: &C,
        (roster, counted): (&Roster, &mut [u16]),
        frame: &mut Frame<D>,
    ) {
        let Self { pairs, pair_weights, ends, distances_m2, weights, slopes } = self;
        weights.clone_from(distances_m2);
        slopes.resize(ends.len(), 0.0);
        params.link().links_at(weights, slopes);
        let mut rest = &weights[..];
        for row in ends.chunk_by(|one, next| one[1] == next[1]) {
            let (own, later) = rest.split_at(row.len());
            if roster.is_ranked() {
                add_ranked_row(roster, row, own, &mut frame.levels, [&mut frame.degrees, counted]);
            } else {
                add_row(row, own, &mut frame.levels, &mut frame.degrees);
            }
            rest = later;
        }
        let mut links = Batch { positions_m: &frame.positions_m, ends, distances_m2, weights, slopes };
        controller.pairs(&mut links, |index, pair| {
            if let Some(pair) = pair {
                pairs.push(Linked { ends: ends[index], pair });
                if C::LOOKS {
                    pair_weights.push(weights[index]);
                }
            }
        });
        ends.clear();
        distances_m2.clear();
    }
}

/// Adds links of one second end to levels and degrees of all ends.
#[inline]
fn add_row(row: &[[u16; 2]], weights: &[f64], levels: &mut [f64], degrees: &mut [u16]) {
    let Some([_, second]) = row.first() else { return };
    let second = usize::from(*second);
    let (mut level, degree) = (levels[second], degrees[second]);
    let (levels_before, degrees_before) = (&mut levels[..second], &mut degrees[..second]);
    for ([first, _], weight) in row.iter().zip(weights) {
        level += weight;
        levels_before[usize::from(*first)] += weight;
        degrees_before[usize::from(*first)] += 1;
    }
    (levels[second], degrees[second]) = (level, degree + small(row.len()));
}

/// Adds links of one second end to levels of the ends for which the other one counts, and to degrees: of all, and of those that count.
fn add_ranked_row(
    roster: &Roster,
    row: &[[u16; 2]],
    weights: &[f64],
    levels: &mut [f64],
    [degrees, counted]: [&mut [u16]; 2],
) {
    let Some([_, second]) = row.first().map(|ends| ends.map(usize::from)) else { return };
    let own = roster.member(second);
    let (mut level, mut counting) = (levels[second], counted[second]);
    degrees[second] += small(row.len());
    for ([first, _], weight) in row.iter().zip(weights) {
        let first = usize::from(*first);
        let other = roster.member(first);
        degrees[first] += 1;
        if roster.counts_for(own, other) {
            level += weight;
            counting += 1;
        }
        if roster.counts_for(other, own) {
            levels[first] += weight;
            counted[first] += 1;
        }
    }
    (levels[second], counted[second]) = (level, counting);
}
