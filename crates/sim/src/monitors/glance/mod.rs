//! What a tick came to for the whole team: the numbers from which monitors see that nothing is near to being broken, so that they need not
//! look at robots and pairs one by one.
//!
//! [`Glances`] takes them of many worlds side by side. Every function of it has one loop over the lanes, without branches. None is inlined,
//! so that the compiler knows that no arguments overlap, and vectorises. Least and greatest numbers are those that one world alone has.

pub(crate) mod held;

use closeranks_core::num::lane::{LANES, Lane, at};
use closeranks_core::num::{dot, larger, subtract};
use closeranks_core::program::InputBox;

use crate::monitors::glance::held::Lists;

/// The numbers of one world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Glance<'a> {
    /// Least squared distance of two robots, m².
    pub(crate) least_m2: f64,
    /// Greatest coordinate, m.
    pub(crate) span_m: f64,
    /// Greatest squared move since the tick before, m².
    pub(crate) moved_m2: f64,
    /// Least c_i of anybody, and of normal robots.
    pub(crate) level_min: f64,
    pub(crate) normal_level_min: f64,
    /// Least degree of normal and of malicious robots; infinite if there are none.
    pub(crate) degree_min: f64,
    pub(crate) malicious_degree_min: f64,
    /// Least φ_i.
    pub(crate) phi_min: f64,
    /// The sum of the E_k of all robots.
    pub(crate) terms: f64,
    /// True if every velocity lies in the box, and every program had an answer.
    pub(crate) boxed: bool,
    /// c_i of everybody as they are; none where robots know them themselves.
    pub(crate) levels: Option<Levels<'a>>,
    /// More of a team that holds links.
    pub(crate) lists: Option<Lists>,
}

/// Levels of one world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Levels<'a> {
    all: &'a [Lane],
    lane: usize,
}

impl Levels<'_> {
    /// Robot after robot.
    pub(crate) fn iter(&self) -> impl Iterator<Item = f64> {
        self.all.iter().map(|levels| levels[self.lane])
    }
}

/// The numbers of many worlds, robot after robot.
#[derive(Clone, Debug)]
pub(crate) struct Glances<const D: usize> {
    malicious: Vec<bool>,
    input: InputBox<D>,
    least_m2: Lane,
    span_m: Lane,
    moved_m2: Lane,
    levels: Least,
    degrees: Least,
    phi_min: Lane,
    terms: Lane,
    /// How far velocities are beyond the box, m/s; not positive inside.
    beyond_m_s: Lane,
    /// No number in worlds with a coordinate that is not finite.
    finite: Lane,
    /// Worlds of which nothing unusual is known.
    usual: [bool; LANES],
}

/// Least numbers of normal and of malicious robots.
#[derive(Clone, Copy, Debug)]
struct Least {
    normal: Lane,
    malicious: Lane,
}

impl Least {
    const NONE: Self = Self { normal: [f64::INFINITY; LANES], malicious: [f64::INFINITY; LANES] };

    fn take(&mut self, malicious: bool, numbers: &Lane) {
        lower(if malicious { &mut self.malicious } else { &mut self.normal }, numbers);
    }
}

impl<const D: usize> Glances<D> {
    /// For teams of which these are `malicious` and all are given velocities in the box of `input`.
    pub(crate) fn new(malicious: Vec<bool>, input: InputBox<D>) -> Self {
        Self {
            malicious,
            input,
            least_m2: [f64::INFINITY; LANES],
            span_m: [0.0; LANES],
            moved_m2: [0.0; LANES],
            levels: Least::NONE,
            degrees: Least::NONE,
            phi_min: [f64::INFINITY; LANES],
            terms: [0.0; LANES],
            beyond_m_s: [f64::NEG_INFINITY; LANES],
            finite: [0.0; LANES],
            usual: [true; LANES],
        }
    }

    /// True if robot `index` is malicious.
    pub(crate) fn is_malicious(&self, index: usize) -> bool {
        self.malicious[index]
    }

    /// Begins a tick with robots at `positions_m`, which were at `before_m` in the last one.
    pub(crate) fn begin(&mut self, positions_m: &[[Lane; D]], before_m: &[[Lane; D]]) {
        *self = Self::new(core::mem::take(&mut self.malicious), self.input);
        for (second, own_m) in positions_m.iter().enumerate() {
            place(own_m, &before_m[second], &mut self.span_m, &mut self.moved_m2, &mut self.finite);
            for first_m in &positions_m[..second] {
                near(first_m, own_m, &mut self.least_m2);
            }
        }
    }

    /// Takes in c_i, E_i and the degree of the next robot.
    pub(crate) fn know(&mut self, robot: usize, levels: &Lane, terms: &Lane, degrees: &Lane) {
        self.levels.take(self.malicious[robot], levels);
        self.degrees.take(self.malicious[robot], degrees);
        for k in 0..LANES {
            self.terms[k] += terms[k];
        }
    }

    /// Takes in what became of a robot.
    pub(crate) fn decided(&mut self, phis: &Lane, velocities_m_s: &[Lane; D]) {
        lower(&mut self.phi_min, phis);
        for d in 0..D {
            let (least_m_s, most_m_s) = (self.input.min_m_s[d], self.input.max_m_s[d]);
            exceed(&velocities_m_s[d], least_m_s, most_m_s, &mut self.beyond_m_s);
        }
    }

    /// Says that robots of this world must be looked at in this tick.
    pub(crate) fn is_unusual(&mut self, lane: usize) {
        self.usual[lane] = false;
    }

    /// The numbers of a world; none if its robots must be looked at.
    pub(crate) fn of<'a>(&self, lane: usize) -> Option<Glance<'a>> {
        let usual = self.usual[lane] && self.finite[lane] == 0.0;
        usual.then(|| Glance {
            least_m2: self.least_m2[lane],
            span_m: self.span_m[lane],
            moved_m2: self.moved_m2[lane],
            level_min: self.levels.normal[lane].min(self.levels.malicious[lane]),
            normal_level_min: self.levels.normal[lane],
            degree_min: self.degrees.normal[lane],
            malicious_degree_min: self.degrees.malicious[lane],
            phi_min: self.phi_min[lane],
            terms: self.terms[lane],
            boxed: self.beyond_m_s[lane] <= 0.0,
            levels: None,
            lists: None,
        })
    }
}

/// Where a robot is, and how far it went.
#[inline(never)]
fn place<const D: usize>(
    own_m: &[Lane; D],
    before_m: &[Lane; D],
    span_m: &mut Lane,
    moved_m2: &mut Lane,
    finite: &mut Lane,
) {
    for k in 0..LANES {
        moved_m2[k] = larger(between_m2(own_m, before_m, k), moved_m2[k]);
    }
    for along_m in own_m {
        for k in 0..LANES {
            span_m[k] = larger(along_m[k].abs(), span_m[k]);
            finite[k] += 0.0 * along_m[k];
        }
    }
}

/// The squared distance of two robots, if it is less.
#[inline(never)]
fn near<const D: usize>(first_m: &[Lane; D], second_m: &[Lane; D], least_m2: &mut Lane) {
    for k in 0..LANES {
        least_m2[k] = lesser(between_m2(second_m, first_m, k), least_m2[k]);
    }
}

#[inline(never)]
fn lower(least: &mut Lane, numbers: &Lane) {
    for k in 0..LANES {
        least[k] = lesser(numbers[k], least[k]);
    }
}

/// How far a component of a velocity is beyond the box, if that is more.
#[inline(never)]
fn exceed(velocities_m_s: &Lane, least_m_s: f64, most_m_s: f64, beyond_m_s: &mut Lane) {
    for k in 0..LANES {
        let above_m_s = larger(velocities_m_s[k] - most_m_s, least_m_s - velocities_m_s[k]);
        beyond_m_s[k] = larger(above_m_s, beyond_m_s[k]);
    }
}

#[inline]
fn between_m2<const D: usize>(x: &[Lane; D], y: &[Lane; D], lane: usize) -> f64 {
    let offset_m = subtract(&at(x, lane), &at(y, lane));
    dot(&offset_m, &offset_m)
}

/// The smaller of two numbers; `most` if `x` is NaN.
#[inline]
fn lesser(x: f64, most: f64) -> f64 {
    if x < most { x } else { most }
}
