//! Robots with frames of their own: nothing that they tell has a direction, so origins and axes need not agree.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use core::time::Duration;

use closeranks_core::{
    BudgetSettings, Clock, ComposedSettings, Controller, Errors, Instant, Message, Mode, Params, Reason,
    RobotId, Settings, SizedRobot, Team, Vector,
};

const ROBOTS: usize = 5;
const TICK: Duration = Duration::from_millis(20);

/// A frame that stands still: where its origin is in the world, and the cosine and sine of its angle.
#[derive(Clone, Copy)]
struct Frame {
    origin_m: Vector<2>,
    cos: f64,
    sin: f64,
}

const WORLD: Frame = Frame { origin_m: [0.0, 0.0], cos: 1.0, sin: 0.0 };

impl Frame {
    fn turn(&self, v: Vector<2>) -> Vector<2> {
        [self.cos * v[0] + self.sin * v[1], self.cos * v[1] - self.sin * v[0]]
    }

    fn turn_back(&self, v: Vector<2>) -> Vector<2> {
        [self.cos * v[0] - self.sin * v[1], self.cos * v[1] + self.sin * v[0]]
    }

    /// A position of the world in this frame.
    fn see(&self, x: Vector<2>) -> Vector<2> {
        self.turn([x[0] - self.origin_m[0], x[1] - self.origin_m[1]])
    }
}

struct Team5 {
    robots: [SizedRobot<2, 4>; ROBOTS],
    frames: [Frame; ROBOTS],
    positions_m: [Vector<2>; ROBOTS],
}

fn id(index: usize) -> RobotId {
    RobotId(u16::try_from(index + 1).unwrap())
}

fn direction(index: usize) -> Vector<2> {
    [[1.0, 0.2], [0.4, 1.0], [-0.8, 0.7], [-0.7, -0.9], [0.5, -1.0]][index]
}

impl Team5 {
    fn new(controller: Controller, frames: [Frame; ROBOTS]) -> Self {
        Self::with_errors(controller, frames, Errors::default())
    }

    fn with_errors(controller: Controller, frames: [Frame; ROBOTS], errors: Errors) -> Self {
        let params = Params::new(Settings {
            team: Team { robots: 5, faults: 1 },
            controller,
            clock: Clock { level_period: TICK, ..Clock::default() },
            errors,
            ..Settings::default()
        })
        .unwrap();
        let robots = core::array::from_fn(|index| SizedRobot::new(params, id(index), 1.0).unwrap());
        let positions_m = core::array::from_fn(|index| direction(index).map(|component| 0.6 * component));
        Self { robots, frames, positions_m }
    }

    /// One tick; gives the modes and moves everybody.
    fn tick(&mut self, tick: u32) -> [Mode; ROBOTS] {
        let mut told = [None; ROBOTS];
        for me in 0..ROBOTS {
            let (robot, frame) = (&mut self.robots[me], self.frames[me]);
            let now = Instant::START.after(TICK * tick);
            robot.sense(now, frame.see(self.positions_m[me])).unwrap();
            for other in (0..ROBOTS).filter(|&other| other != me) {
                robot.observe(id(other), frame.see(self.positions_m[other])).unwrap();
            }
            told[me] = robot.share().map(|message| message.encode());
        }
        core::array::from_fn(|me| {
            let (robot, frame) = (&mut self.robots[me], self.frames[me]);
            for other in 0..ROBOTS {
                let Some(bytes) = told[other].filter(|_| other != me) else { continue };
                let _ = robot.receive(id(other), &Message::parse(&bytes).unwrap());
            }
            let output = robot.tick(frame.turn(direction(me)));
            let velocity_m_s = frame.turn_back(output.velocity_m_s);
            let time_s = TICK.as_secs_f64();
            self.positions_m[me] = [0, 1].map(|d| self.positions_m[me][d] + time_s * velocity_m_s[d]);
            output.report.mode
        })
    }
}

/// Frames with the origin anywhere, turned by whole right angles, so that the box of velocities is the same in each.
fn right_angles() -> [Frame; ROBOTS] {
    let turns = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 1.0)];
    let origins_m = [[0.0, 7.0], [-30.0, 4.5], [12.0, -80.0], [3.25, 3.5], [100.0, 200.0]];
    core::array::from_fn(|index| {
        let (cos, sin) = turns[index];
        Frame { origin_m: origins_m[index], cos, sin }
    })
}

fn budget() -> Controller {
    Controller::Budget(BudgetSettings::default())
}

#[test]
fn a_team_whose_robots_have_their_own_frames_goes_where_one_with_a_common_frame_goes() {
    for controller in [budget(), Controller::Composed(ComposedSettings::default())] {
        let (mut common, mut own) =
            (Team5::new(controller, [WORLD; ROBOTS]), Team5::new(controller, right_angles()));
        for tick in 0..300 {
            assert_eq!(common.tick(tick), own.tick(tick));
            for (one, other) in common.positions_m.iter().zip(&own.positions_m) {
                let apart_m = (one[0] - other[0]).hypot(one[1] - other[1]);
                assert!(apart_m < 1e-6, "{apart_m} m in tick {tick}");
            }
        }
    }
}

/// A box that is turned is another box, so the team goes elsewhere; the guarantee is the same.
#[test]
fn frames_at_any_angle_keep_the_guarantee() {
    let frames = core::array::from_fn(|index| {
        let angle = [0.0, 0.3, 1.0, 2.5, 4.0][index];
        Frame { cos: libm::cos(angle), sin: libm::sin(angle), ..right_angles()[index] }
    });
    let mut team = Team5::new(budget(), frames);
    for tick in 0..300 {
        assert_eq!(team.tick(tick), [Mode::Guaranteed; ROBOTS], "in tick {tick}");
        let degrees = team.robots.each_ref().map(|robot| robot.neighbors().len());
        assert!(degrees.iter().all(|&degree| degree >= 3), "F' is 3: {degrees:?}");
    }
}

/// An origin that moves by a millimetre moves no neighbour, but then the robot is not where it should be.
#[test]
fn a_frame_that_drifts_is_noticed_unless_it_is_stated() {
    let stated = Errors { position_m: 0.001, tracking_m: 0.0 };
    for (errors, first) in [(Errors::default(), Mode::Degraded(Reason::Moved)), (stated, Mode::Guaranteed)] {
        let mut team = Team5::with_errors(budget(), [WORLD; ROBOTS], errors);
        team.tick(0);
        team.frames[0].origin_m[0] += 0.001;
        let modes = team.tick(1);
        assert_eq!((modes[0], &modes[1..]), (first, [Mode::Guaranteed; 4].as_slice()));
    }
}
