//! The same numbers for teams of `links`: who is linked and counts on whom, a bit each, and how pairs come closer, in many worlds at once.

use closeranks_core::controller::Kept;
use closeranks_core::controller::links::lanes::{Bits, Others};
use closeranks_core::num::lane::{LANES, Lane, at, bits_if, is_so};
use closeranks_core::num::{dot, subtract};
use closeranks_core::program::{InputBox, Outcome};
use closeranks_core::robot::report::Mode;
use closeranks_core::settings::params::Params;

use crate::frame::Frame;
use crate::geometry::nearest_m2;
use crate::monitors::glance::{Glance, Glances, Levels, between_m2, lesser};
use crate::monitors::rounding::ROUNDING;

/// Whoever moves no farther than it wishes, but for this fraction of the squares, is not towed: that is half of what is taken for rounding.
const MOVE_ROUNDING: f64 = 1e-6;

/// What else is to be said of one world.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "four facts, each from a place of its own")]
pub(crate) struct Lists {
    /// Nobody counts on anybody who is out of range or has no row for it, and all know how many are in range.
    pub(crate) sound: bool,
    /// Somebody counts on others, or has rows for others, than in the last tick that was told.
    pub(crate) relisted: bool,
    /// The least number of those on whom a normal robot counts.
    pub(crate) counted_min: f64,
    /// The least squared distance of two robots since the tick before, m².
    pub(crate) path_m2: f64,
    /// Some pair came closer faster than it may.
    pub(crate) falls: bool,
    /// All normal robots say that their answer is guaranteed, nobody stands still for want of one or misses anybody, and no normal robot
    /// moves farther than it wishes.
    pub(crate) calm: bool,
    /// The sum of the E^c of all links.
    pub(crate) collisions: f64,
}

/// The numbers of many worlds.
#[derive(Clone, Debug)]
pub(crate) struct HeldGlances<const D: usize> {
    glances: Glances<D>,
    kept: Kept,
    input: InputBox<D>,
    path_m2: Lane,
    falls: Lane,
    /// Who is within R of each.
    linked: Vec<Bits>,
    worlds: Vec<Told>,
}

/// What robots of one world told last.
#[derive(Clone, Debug)]
struct Told {
    /// Of each robot: who is within R, on whom it counts, for whom it has a row.
    others: Vec<[u64; 3]>,
    degrees: Vec<u16>,
    found: Found,
    relisted: bool,
    boxed: bool,
    calm: bool,
}

/// What follows from it.
#[derive(Clone, Copy, Debug)]
struct Found {
    sound: bool,
    counted_min: f64,
    degree_min: f64,
    malicious_degree_min: f64,
}

impl<const D: usize> HeldGlances<D> {
    /// For teams with these `params` of which these are `malicious`.
    pub(crate) fn new(params: &Params<D>, malicious: Vec<bool>) -> Self {
        let (robots, input) = (malicious.len(), params.settings().limits.input);
        let nothing = Found { sound: false, counted_min: 0.0, degree_min: 0.0, malicious_degree_min: 0.0 };
        let told = Told {
            others: vec![[0; 3]; robots],
            degrees: vec![0; robots],
            found: nothing,
            relisted: true,
            boxed: false,
            calm: false,
        };
        Self {
            glances: Glances::new(malicious, input),
            kept: *params.kept(),
            input,
            path_m2: [f64::INFINITY; LANES],
            falls: [0.0; LANES],
            linked: vec![[0; LANES]; robots],
            worlds: vec![told; LANES],
        }
    }

    /// Begins a tick with robots at `positions_m`, which were at `before_m` in the last one, and true `levels` of links.
    pub(crate) fn begin(&mut self, positions_m: &[[Lane; D]], before_m: &[[Lane; D]], levels: &[Lane]) {
        self.glances.begin(positions_m, before_m);
        for (robot, level) in levels.iter().enumerate() {
            self.glances.know(robot, level, &[0.0; LANES], &[0.0; LANES]);
        }
        (self.path_m2, self.falls) = ([f64::INFINITY; LANES], [0.0; LANES]);
        self.linked.fill([0; LANES]);
        let rule = Rule::new(&self.kept);
        for second in 0..positions_m.len() {
            let (firsts, own) = self.linked.split_at_mut(second);
            for (first, linked) in firsts.iter_mut().enumerate() {
                let [now, then] = [positions_m, before_m].map(|all_m| [&all_m[first], &all_m[second]]);
                near(&rule, now, then, &mut self.path_m2, &mut self.falls);
                link(&rule, now, (first, linked), (second, &mut own[0]));
            }
        }
    }

    /// Takes in what the robots of one world tell: what each holds `of` others, and what it says in `frame`.
    pub(crate) fn hear(&mut self, lane: usize, frame: &Frame<D>, of: impl Fn(usize) -> Others) {
        let (told, malicious) = (&mut self.worlds[lane], &self.glances.malicious);
        told.relisted = false;
        for (robot, others) in told.others.iter_mut().enumerate() {
            let Others { counted, active, .. } = of(robot);
            let now = [self.linked[robot][lane], counted, active];
            told.relisted |= *others != now;
            *others = now;
        }
        if told.relisted {
            told.find(malicious);
        }
        (told.calm, told.boxed) = (frame.degrees == told.degrees && !frame.missing.contains(&true), true);
        for (robot, (velocity_m_s, asked_m_s)) in
            frame.velocities_m_s.iter().zip(&frame.asked_m_s).enumerate()
        {
            let mode = frame.modes[robot];
            let rests = dot(velocity_m_s, velocity_m_s) <= dot(asked_m_s, asked_m_s) * (1.0 + MOVE_ROUNDING);
            told.calm &= mode != Mode::Stopped && (malicious[robot] || mode == Mode::Guaranteed && rests);
            told.boxed &= self.input.contains(velocity_m_s) && frame.outcomes[robot] != Outcome::Infeasible;
        }
    }

    /// The numbers of a world in which φ_i are `phis` and both sums of φ are `sums`; none if its robots must be looked at.
    pub(crate) fn of<'a>(
        &self,
        lane: usize,
        levels: &'a [Lane],
        phis: &[Lane],
        [terms, collisions]: [f64; 2],
    ) -> Option<Glance<'a>> {
        let told = &self.worlds[lane];
        let Found { sound, counted_min, degree_min, malicious_degree_min } = told.found;
        let lists = Lists {
            sound,
            relisted: told.relisted,
            counted_min,
            path_m2: self.path_m2[lane],
            falls: is_so(self.falls[lane]),
            calm: told.calm,
            collisions,
        };
        let phi_min = phis.iter().fold(f64::INFINITY, |least, phis| lesser(phis[lane], least));
        Some(Glance {
            degree_min,
            malicious_degree_min,
            phi_min,
            terms,
            boxed: told.boxed,
            levels: Some(Levels { all: levels, lane }),
            lists: Some(lists),
            ..self.glances.of(lane)?
        })
    }
}

impl Told {
    /// Finds what follows from who is linked with whom and counts on whom.
    fn find(&mut self, malicious: &[bool]) {
        let least = f64::INFINITY;
        let mut found =
            Found { sound: true, counted_min: least, degree_min: least, malicious_degree_min: least };
        for (robot, [linked, counted, _]) in self.others.iter().enumerate() {
            let degree = linked.count_ones();
            self.degrees[robot] = u16::try_from(degree).unwrap_or(u16::MAX);
            if malicious[robot] {
                found.malicious_degree_min = found.malicious_degree_min.min(f64::from(degree));
                continue;
            }
            found.degree_min = found.degree_min.min(f64::from(degree));
            found.counted_min = found.counted_min.min(f64::from(counted.count_ones()));
            let holds = |(other, [_, _, rows]): (usize, &[u64; 3])| {
                let counts = counted >> other & 1 == 1;
                !counts || (linked >> other & 1 == 1 && rows >> robot & 1 == 1)
            };
            found.sound &= self.others.iter().enumerate().all(holds);
        }
        self.found = found;
    }
}

/// What pairs are held against, in the units of squares.
#[derive(Clone, Copy, Debug)]
struct Rule {
    radius_m2: f64,
    least_m2: f64,
    /// How much of D − Δ_d² must be left after a tick.
    left: f64,
}

impl Rule {
    fn new(kept: &Kept) -> Self {
        Self {
            radius_m2: kept.link.radius_m * kept.link.radius_m,
            least_m2: kept.distance_min_m * kept.distance_min_m,
            left: 1.0 - kept.gamma_c,
        }
    }
}

/// How near a pair came since the tick before, and whether too fast.
#[inline(never)]
fn near<const D: usize>(
    rule: &Rule,
    [first_m, second_m]: [&[Lane; D]; 2],
    [first_then_m, second_then_m]: [&[Lane; D]; 2],
    path_m2: &mut Lane,
    falls: &mut Lane,
) {
    for k in 0..LANES {
        let end = subtract(&at(second_m, k), &at(first_m, k));
        let start = subtract(&at(second_then_m, k), &at(first_then_m, k));
        path_m2[k] = lesser(nearest_m2(&start, &end), path_m2[k]);
        let (now_m2, then_m2) = (dot(&end, &end), dot(&start, &start));
        let floor_m2 = rule.left * (then_m2 - rule.least_m2);
        let below = now_m2 - rule.least_m2 < floor_m2 - ROUNDING * now_m2;
        let was_apart = floor_m2 >= 0.0;
        let fell = was_apart & below;
        falls[k] = if fell { 1.0 } else { falls[k] };
    }
}

/// Notes two robots that are within R.
#[inline(never)]
fn link<const D: usize>(
    rule: &Rule,
    [first_m, second_m]: [&[Lane; D]; 2],
    (first, first_linked): (usize, &mut Bits),
    (second, second_linked): (usize, &mut Bits),
) {
    let (bit, other_bit) = (1_u64 << (first % 64), 1_u64 << (second % 64));
    for k in 0..LANES {
        let linked = between_m2(second_m, first_m, k) <= rule.radius_m2;
        first_linked[k] |= bits_if(linked, other_bit);
        second_linked[k] |= bits_if(linked, bit);
    }
}
