//! The state of a team as only the world knows it: what the theorems are about.

use closeranks_core::budget::knowledge::{Assume, Sighting};
use closeranks_core::link::{Link, LinkShape};
use closeranks_core::math::{Vector, subtract};
use closeranks_core::params::{Controller, Params};

use crate::frame::Frame;
use crate::promise::required;
use crate::start::squared_distance;

/// True levels, degrees and distances of one tick.
#[derive(Clone, Debug, Default)]
pub(crate) struct Truth {
    /// c_i within R.
    pub(crate) levels: Vec<f64>,
    /// Neighbours that count: all, or with free liars the normal ones.
    pub(crate) degrees: Vec<u16>,
    /// What is kept at 0 or above: h_i of references; with free liars the sum over normal neighbours, less θ.
    pub(crate) spares: Vec<f64>,
    /// h_i as a robot has it that senses exactly: with free liars of the trimmed sum.
    pub(crate) own: Vec<f64>,
    /// Squared distances of references, m², pair (first, second) at `second (second − 1)/2 + first`.
    pub(crate) pairs_m2: Vec<f64>,
}

impl Truth {
    /// The truth of `frame`. A team of `composed` in a perfect world knows it itself: then nothing is computed twice.
    pub(crate) fn look<const D: usize>(
        &mut self,
        params: &Params<D>,
        malicious: &[bool],
        frame: &Frame<D>,
        plain: bool,
    ) {
        self.pairs(&frame.references_m);
        if plain {
            let required = f64::from(required(params));
            self.levels.clone_from(&frame.levels);
            self.degrees.clone_from(&frame.degrees);
            self.spares.clear();
            self.spares.extend(frame.levels.iter().map(|level| level - required));
            self.own.clone_from(&self.spares);
            return;
        }
        let free =
            params.settings().controller == Controller::Budget && params.settings().assume == Assume::Free;
        let shape = params.budget().curvature.link();
        let margin = params.budget().margin.away_m > 0.0;
        let required = f64::from(required(params));
        let count = frame.positions_m.len();
        self.resize(count);
        for robot in 0..count {
            let counts = |other: usize| !(free && malicious[other]);
            let actual = weigh(params.link(), &frame.positions_m, robot, |_| true);
            self.levels[robot] = actual.0;
            self.degrees[robot] =
                if free { weigh(params.link(), &frame.positions_m, robot, counts).1 } else { actual.1 };
            let kept =
                if free || margin { weigh(shape, &frame.references_m, robot, counts).0 } else { actual.0 };
            self.spares[robot] = kept - required;
            self.own[robot] =
                if free { trimmed(params, frame, robot) - required } else { self.spares[robot] };
        }
    }

    fn resize(&mut self, count: usize) {
        for column in [&mut self.levels, &mut self.spares, &mut self.own] {
            column.resize(count, 0.0);
        }
        self.degrees.resize(count, 0);
    }

    fn pairs<const D: usize>(&mut self, references_m: &[Vector<D>]) {
        self.pairs_m2.clear();
        for (second, x) in references_m.iter().enumerate() {
            self.pairs_m2.extend(references_m[..second].iter().map(|y| squared_distance(x, y)));
        }
    }

    /// Squared distance of two different robots, m².
    #[must_use]
    pub(crate) fn pair_m2(&self, one: usize, other: usize) -> f64 {
        let (first, second) = if one < other { (one, other) } else { (other, one) };
        self.pairs_m2[second * (second - 1) / 2 + first]
    }
}

/// Sum and number of the links of `robot` with the others that count, in order of their numbers.
fn weigh<const D: usize>(
    shape: &LinkShape,
    positions_m: &[Vector<D>],
    robot: usize,
    counts: impl Fn(usize) -> bool,
) -> (f64, u16) {
    let own = &positions_m[robot];
    let others = positions_m.iter().enumerate().filter(|(other, _)| *other != robot && counts(*other));
    let links = others.filter_map(|(_, position)| {
        let link: Option<Link<f64>> = shape.link(&subtract(own, position));
        link
    });
    links.fold((0.0, 0), |(sum, count), link| (sum + link.weight, count + 1))
}

fn trimmed<const D: usize>(params: &Params<D>, frame: &Frame<D>, robot: usize) -> f64 {
    let own = frame.positions_m[robot];
    let others = frame.positions_m.iter().enumerate().filter(|(other, _)| *other != robot);
    let sightings: Vec<Sighting<D>> = others.map(|(_, x)| Sighting::new(subtract(&own, x), None)).collect();
    params.budget().level(&sightings, &mut vec![0.0; sightings.len()])
}
