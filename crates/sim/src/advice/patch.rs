//! Starts that are patches of a lattice, and the spacings at which they are inside the safe set.
//!
//! In the plane this is the start `hexagon`. In space it is a patch of the face-centred cubic lattice, the closest packing,
//! again the places nearest to the origin. h of every robot falls with the spacing, because weights fall with the distance.

use core::f64::consts::FRAC_1_SQRT_2;

use closeranks_core::num::{Vector, sqrt};
use closeranks_core::settings::params::Params;

use super::halving::last;
use super::level::Levels;
use crate::geometry::squared_distance;
use crate::scenario::start::Start;

/// The spacings of a patch, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spacings {
    /// The least at which all robots are certainly far enough apart.
    pub least_m: f64,
    /// The least h of a robot there.
    pub h_at_least: f64,
    /// The largest at which every h is certainly not negative, be it more or less than the least; `None` if no spacing does.
    pub largest_m: Option<f64>,
    /// That with most room, if there is any from the least to the largest.
    pub best: Option<Best>,
}

/// The spacing with most room on both sides. From the least to the largest spacing the share of h that is left, compared with the
/// least spacing, falls from 1 to 0, while the share of the way grows from 0 to 1; here both are the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Best {
    /// The spacing, m.
    pub spacing_m: f64,
    /// The least h of a robot there.
    pub h: f64,
    /// Both shares, rounding aside the largest that the smaller of them can be.
    pub share: f64,
}

/// The patch as a start of a scenario.
#[must_use]
pub fn start(robots: u16, spacing_m: f64, dimension: usize) -> Start {
    match dimension {
        3 => Start::Listed(packed(robots, spacing_m)),
        _ => Start::Hexagon { spacing_m },
    }
}

/// The places of the face-centred cubic lattice nearest to the origin, in order of distance.
fn packed(robots: u16, spacing_m: f64) -> Vec<Vec<f64>> {
    // A ball of radius k around a place holds more than k^3 places, for k of at least 2; a place has an even sum of coordinates.
    let reach = (2_i32..40).find(|k| k * k * k >= i32::from(robots)).unwrap_or(40);
    let axis = || -reach..=reach;
    let all = axis().flat_map(|z| axis().flat_map(move |y| axis().map(move |x| [z, y, x])));
    let even = all.filter(|place| place.iter().sum::<i32>() % 2 == 0);
    let mut places: Vec<_> = even.map(|[z, y, x]| (z * z + y * y + x * x, [z, y, x])).collect();
    places.sort_unstable();
    places.truncate(usize::from(robots));
    let edge_m = spacing_m * FRAC_1_SQRT_2;
    places.iter().map(|(_, [z, y, x])| [x, y, z].map(|k| edge_m * f64::from(*k)).to_vec()).collect()
}

/// Where the robots of a patch stand, m.
fn positions<const D: usize>(params: &Params<D>, spacing_m: f64) -> Vec<Vector<D>> {
    let robots = params.settings().team.robots;
    start(robots, spacing_m, D).positions(robots, 0).unwrap_or_default()
}

impl Spacings {
    pub(super) fn new<const D: usize>(params: &Params<D>) -> Self {
        let least_m = least_m(params);
        let Some(mut patch) = Patch::new(params) else {
            return Self { least_m, h_at_least: f64::NEG_INFINITY, largest_m: None, best: None };
        };
        let h_at_least = patch.h(least_m);
        let radius_m = params.kept().link.radius_m;
        let largest_m = patch.last(1e-6 * radius_m, radius_m, |_, h| h >= 0.0);
        let best = largest_m.filter(|largest_m| *largest_m >= least_m).and_then(|largest_m| {
            let way = |spacing_m| share(spacing_m - least_m, largest_m - least_m);
            let spacing_m =
                patch.last(least_m, largest_m, |spacing_m, h| share(h, h_at_least) >= way(spacing_m))?;
            let h = patch.h(spacing_m);
            Some(Best { spacing_m, h, share: share(h, h_at_least).min(way(spacing_m)) })
        });
        Self { least_m, h_at_least, largest_m, best }
    }

    /// True if there is a patch at all: then the tightest is one.
    pub(super) fn exist<const D: usize>(params: &Params<D>) -> bool {
        Patch::new(params).is_some_and(|mut patch| patch.holds(least_m(params)))
    }
}

/// A part of a whole; 0 of nothing.
fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

/// The least spacing at which the nearest two robots are certainly as far apart as the controller keeps them.
fn least_m<const D: usize>(params: &Params<D>) -> f64 {
    let kept = params.kept();
    let enough_m = kept.distance_min_m + kept.errors.offset_m;
    let (mut spacing_m, mut step) = (enough_m, f64::EPSILON);
    while nearest_m(&positions(params, spacing_m)) < enough_m && step < 1.0 {
        spacing_m = enough_m * (1.0 + step);
        step *= 2.0;
    }
    spacing_m
}

/// The least distance of two robots, m.
fn nearest_m<const D: usize>(positions_m: &[Vector<D>]) -> f64 {
    let mut least_m2 = f64::INFINITY;
    for (index, place) in positions_m.iter().enumerate() {
        for other in &positions_m[..index] {
            least_m2 = squared_distance(place, other).min(least_m2);
        }
    }
    sqrt(least_m2)
}

/// A patch, and those of its robots that had the least h at some spacing.
#[derive(Debug)]
struct Patch<'a, const D: usize> {
    params: &'a Params<D>,
    levels: Levels<'a, D>,
    weak: Vec<usize>,
}

impl<'a, const D: usize> Patch<'a, D> {
    fn new(params: &'a Params<D>) -> Option<Self> {
        let last = usize::from(params.settings().team.robots).saturating_sub(1);
        Some(Self { params, levels: Levels::new(params)?, weak: vec![last] })
    }

    /// The least h at this spacing.
    fn h(&mut self, spacing_m: f64) -> f64 {
        self.levels.least(&positions(self.params, spacing_m)).1
    }

    /// True if no h is negative at this spacing.
    fn holds(&mut self, spacing_m: f64) -> bool {
        let positions_m = positions(self.params, spacing_m);
        (0..positions_m.len()).rev().all(|index| self.levels.h(&positions_m, index) >= 0.0)
    }

    /// The largest spacing from `low_m` to `high_m` at which `holds` of the spacing and the least h there.
    ///
    /// That h is sought among the robots known to be weak. Where another one turns out weaker, it is known from then on and the
    /// search begins anew: few robots need be looked at often.
    fn last(&mut self, low_m: f64, high_m: f64, holds: impl Fn(f64, f64) -> bool) -> Option<f64> {
        loop {
            let found = last(low_m, high_m, |spacing_m| holds(spacing_m, self.h_of_weak(spacing_m)));
            let (weakest, _) = self.levels.least(&positions(self.params, found.unwrap_or(low_m)));
            if self.weak.contains(&weakest) {
                return found;
            }
            self.weak.push(weakest);
        }
    }

    fn h_of_weak(&mut self, spacing_m: f64) -> f64 {
        let positions_m = positions(self.params, spacing_m);
        let Self { levels, weak, .. } = self;
        weak.iter().map(|index| levels.h(&positions_m, *index)).fold(f64::INFINITY, f64::min)
    }
}
