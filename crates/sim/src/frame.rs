//! One tick of all robots, as it is watched and recorded.

use std::sync::Arc;

use closeranks_core::num::Vector;
use closeranks_core::obstacle::Obstacle;
use closeranks_core::program::Outcome;
use closeranks_core::robot::report::{Mode, Reason};

use crate::transport::Bytes;

/// State of every robot in one tick; index 0 is robot 1.
///
/// A robot that is down in this tick (crashed, or missing it: `down`) has stopped, has no φ_i and is free; its degree, levels, h, value
/// and what it heard are those of the last tick in which it ran.
#[derive(Clone, Debug)]
pub struct Frame<const D: usize> {
    /// x_i, m.
    pub positions_m: Vec<Vector<D>>,
    /// u_{i,des}, m/s.
    pub desired_m_s: Vec<Vector<D>>,
    /// What robots are asked for, m/s: the desired velocity, or what a controller with global state makes of it.
    pub asked_m_s: Vec<Vector<D>>,
    /// u_i, m/s, held from this tick on.
    pub velocities_m_s: Vec<Vector<D>>,
    /// δ_i as sensed.
    pub degrees: Vec<u16>,
    /// c_i as sensed.
    pub levels: Vec<f64>,
    /// c_i as told.
    pub told: Vec<f64>,
    /// h_i as the robot's controller has it: c_i − F′, or T_i − θ under `budget` with free liars.
    pub h: Vec<f64>,
    /// Under `links`: whom each robot counts on, by number.
    pub counted: Vec<Vec<u16>>,
    /// Under `links`: for whom each robot keeps its row, by number.
    pub rows: Vec<Vec<u16>>,
    /// φ_i; NaN where nobody wants to know it, and of a robot that is down.
    pub phis: Vec<f64>,
    /// The sum of E^c over all links, if whoever computed the tick has it anyway.
    pub collisions: Option<f64>,
    /// Whether somebody wants to know φ and φ_i, which not every controller uses.
    pub wants_phi: bool,
    /// y_i; for malicious robots what they tell, if they tell all the same.
    pub values: Vec<f64>,
    /// y_i as each robot holds it, malicious or not.
    pub held: Vec<f64>,
    /// Further numbers of values of several, one list a number: as in `values`.
    pub more_values: Vec<Vec<f64>>,
    /// As in `held`.
    pub more_held: Vec<Vec<f64>>,
    /// Robots that told everybody the same level, and the same value, when they last told.
    pub one_level: Vec<bool>,
    /// See `one_level`.
    pub one_value: Vec<bool>,
    /// What the program found.
    pub outcomes: Vec<Outcome>,
    /// Robots that reckon with one that they do not sense although, by what they sensed before, it cannot have left.
    pub missing: Vec<bool>,
    /// What each robot says its answer is worth.
    pub modes: Vec<Mode>,
    /// Values of robots that count for it that each robot used in the last round, and how many of them were those of normal
    /// robots. Without ranks everybody counts.
    pub heard: Vec<[u16; 2]>,
    /// Values that each robot used in the last round, whether or not their robots count, and how many of these robots were
    /// malicious. Only engines that know of ranks fill it.
    pub listened: Vec<[u16; 2]>,
    /// Robots that do not run in this tick, those that are absent among them.
    pub down: Vec<bool>,
    /// Who is in the plane. The world fills it before the robots tick.
    pub presence: Presence,
    /// Robots of other teams. The world fills it before the robots tick.
    pub strangers: Strangers<D>,
    /// The obstacles that cut links. The world fills it before the first tick.
    pub cutting: Arc<[Obstacle<D>]>,
    /// What the theorem is about, m: where velocities have taken each robot if a tracking error is stated, else its position.
    pub references_m: Vec<Vector<D>>,
    /// What the theorem rests on, and whether it holds.
    pub assumptions: Assumptions,
    /// Number of links, each counted once.
    pub links: u32,
}

/// Who of the roster is in the plane in a tick, and who came and went. Index 0 is robot 1.
///
/// An absent robot has no body: its position, its reference, its φ_i, its h, its levels and its values are NaN, it has no neighbours and
/// it does not move. NaN is within no radius of anything.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Presence {
    /// Robots that are not there.
    pub absent: Vec<bool>,
    /// Robots that left silently: others may reckon with them where they are not, also after they came again.
    pub unannounced: Vec<bool>,
    /// Robots that came in this tick, and begin anew.
    pub arrived: Vec<bool>,
    /// Robots of which all others are told in this tick that they have left.
    pub dismissed: Vec<bool>,
    /// Robots that had somebody within range who left in this tick: h, degree and held links of before are theirs no more.
    pub bereft: Vec<bool>,
    /// True if anybody came or left in this tick.
    pub changed: bool,
}

impl Presence {
    /// Everybody is there.
    #[must_use]
    pub fn full(robots: usize) -> Self {
        let none = vec![false; robots];
        Self {
            absent: none.clone(),
            unannounced: none.clone(),
            arrived: none.clone(),
            dismissed: none.clone(),
            bereft: none,
            changed: false,
        }
    }

    /// Begins a tick in which nobody came or left yet.
    pub(crate) fn begin_tick(&mut self) {
        if core::mem::replace(&mut self.changed, false) {
            self.arrived.fill(false);
            self.dismissed.fill(false);
            self.bereft.fill(false);
        }
    }
}

/// Robots of other teams in the same space, in an order that stays the same.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Strangers<const D: usize> {
    /// Where they are, m; NaN of those that are absent.
    pub positions_m: Vec<Vector<D>>,
    /// Where they count themselves, m, as in [`Frame::references_m`].
    pub references_m: Vec<Vector<D>>,
    /// Malicious ones that move as they like.
    pub disobedient: Vec<bool>,
    /// Those of which everybody is told in this tick that they have left.
    pub dismissed: Vec<bool>,
    /// What they told their own team in the tick before: whoever is near hears it too.
    pub told: Vec<Option<Bytes>>,
}

/// What held in a tick of the assumptions under which `budget` promises anything, as only the world can know. The world fills
/// it after the robots ticked; monitors hold a robot to its promises only where they hold.
#[derive(Clone, Debug, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "each is broken by itself")]
pub struct Assumptions {
    /// True if some assumption does not hold, whether or not a robot can know: liars disobey, a robot goes on without having
    /// looked, a robot is farther from its reference than is stated, or one of the two
    /// fields below says so.
    pub broken: bool,
    /// Robots that sensed some position with a larger error than is stated, or cannot know of some robot within R.
    pub sensed_wrong: Vec<bool>,
    /// Robots that did not sense somebody within R, whether they know of it or not: they cannot be certain of their own state.
    pub unsensed: Vec<bool>,
    /// True if some reference is not the last one plus its move: what held before says nothing about it.
    pub renewed: bool,
    /// True if some robot may not be where it counts itself within what is stated: it sensed wrong, is away from its reference, began
    /// anew, or goes on without having looked. What others do makes no difference.
    pub misplaced: bool,
    /// True if some normal robot did not run, or began anew. Rounds of consensus rest on it, safety does not.
    pub unsteady: bool,
}

impl Assumptions {
    /// The assumptions as they are in a perfect world.
    #[must_use]
    pub fn all_hold(robots: usize) -> Self {
        let none = vec![false; robots];
        Self {
            broken: false,
            sensed_wrong: none.clone(),
            unsensed: none,
            renewed: false,
            misplaced: false,
            unsteady: false,
        }
    }
}

/// The place of a robot that is not in the plane.
#[must_use]
pub fn nowhere<const D: usize>() -> Vector<D> {
    [f64::NAN; D]
}

impl<const D: usize> Frame<D> {
    /// A frame for robots at `positions_m` with initial `values`.
    #[must_use]
    pub fn new(positions_m: Vec<Vector<D>>, values: Vec<f64>) -> Self {
        let robots = positions_m.len();
        Self {
            references_m: positions_m.clone(),
            positions_m,
            desired_m_s: vec![[0.0; D]; robots],
            asked_m_s: vec![[0.0; D]; robots],
            velocities_m_s: vec![[0.0; D]; robots],
            degrees: vec![0; robots],
            levels: vec![0.0; robots],
            told: vec![0.0; robots],
            h: vec![0.0; robots],
            counted: vec![Vec::new(); robots],
            rows: vec![Vec::new(); robots],
            phis: vec![f64::NAN; robots],
            collisions: None,
            wants_phi: true,
            held: values.clone(),
            more_values: Vec::new(),
            more_held: Vec::new(),
            one_level: vec![true; robots],
            one_value: vec![true; robots],
            values,
            outcomes: vec![Outcome::Free; robots],
            missing: vec![false; robots],
            modes: vec![Mode::Degraded(Reason::ContinuousTime); robots],
            heard: vec![[0; 2]; robots],
            listened: vec![[0; 2]; robots],
            down: vec![false; robots],
            presence: Presence::full(robots),
            cutting: Arc::new([]),
            strangers: Strangers::default(),
            assumptions: Assumptions::all_hold(robots),
            links: 0,
        }
    }
}
