//! Four robots drive apart, one of them lies, and their ticks are late: with the filter they stay together and agree.
//!
//! `cargo run -p closeranks-core --example four_robots`
//!
//! It shows all that the owner of a robot does: settings that cover late ticks, the five calls of a tick, and messages as
//! bytes over a transport that knows who sent them. Robot 4 lies about its value, to everybody in another way,
//! but it moves as its own filter says (Assumption 1). `cargo test` checks what is promised here (tests/four_robots.rs).

use core::error::Error;
use core::time::Duration;

use closeranks_core::consensus::Rule;
use closeranks_core::{
    BudgetSettings, Clock, Controller, Errors, InputBox, Instant, Limits, LinkSettings, MESSAGE_BYTES,
    Message, Mode, Output, Params, RobotId, Settings, SizedRobot, Team, Vector,
};

const ROBOTS: usize = 4;
const LIAR: RobotId = RobotId(4);
const RADIUS_M: f64 = 3.0;
const SPEED_M_S: f64 = 0.5;
/// A tick is due every 20 ms and comes up to 4 ms late, so 24 ms may lie between two ticks of a robot.
pub(crate) const PERIOD: Duration = Duration::from_millis(20);
const LATE_MAX: Duration = Duration::from_millis(4);
pub(crate) const HOLD_MAX: Duration = Duration::from_millis(25);
/// Consensus is slow here, so that the table shows what becomes of it when the team falls apart.
const ROUND: Duration = Duration::from_secs(2);
const PERIODS_A_SECOND: u64 = 50;

/// Room for three neighbours. With stated errors each of them needs eleven rows; `SizedRobot::new` would say if it were fewer.
type FourthOfTeam = SizedRobot<2, 3, 11>;

/// What a robot was sent: by whom, and the bytes. A real transport must know the first for sure, for example from a signature.
type Letter = (RobotId, [u8; MESSAGE_BYTES]);

/// A robot with its body in the world.
struct Body {
    robot: FourthOfTeam,
    position_m: Vector<2>,
    /// Where it wants to go, for ever.
    desired_m_s: Vector<2>,
    inbox: Vec<Letter>,
    /// What its filter last said; it goes on with that velocity until the next tick.
    last: Option<Output<2>>,
}

/// All that there is. A robot sees of it only what its five calls are given.
struct World {
    now: Instant,
    bodies: [Body; ROBOTS],
    random: u64,
}

/// The team after a while: one line of the table.
pub(crate) struct Line {
    time_s: u64,
    /// Distance of the two robots farthest apart, m.
    pub(crate) farthest_m: f64,
    /// Least number of neighbours and least h of an honest robot.
    pub(crate) degree_min: u16,
    pub(crate) h_min: f64,
    /// y_1, y_2 and y_3.
    pub(crate) values: [f64; 3],
    /// What the answers of robots 1, 2 and 3 are worth.
    pub(crate) modes: [Mode; 3],
}

/// Prints three tables and what to see in them.
#[expect(clippy::print_stdout, reason = "a report")]
pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    println!("Four robots want to drive apart, to the left, to the right, up and down, at {SPEED_M_S} m/s.");
    println!("Robot 4 tells each robot another value. A link reaches {RADIUS_M} m. With n = 4 and F = 1");
    println!("every robot must keep F' = 3 neighbours: all the others. Values meet every two seconds.");
    let budget = Controller::Budget(BudgetSettings::default());
    for (what, controller, hold_max) in [
        ("With the filter (`budget`) they stop in time, and the honest values meet:", budget, HOLD_MAX),
        ("Without it (`none`) they part for ever, and so do their values:", Controller::None, HOLD_MAX),
        (
            "The first again, but told that no tick is ever late. They notice that it is not so:",
            budget,
            PERIOD,
        ),
    ] {
        println!("\n{what}\n");
        println!(
            "  time  farthest pair  least neighbours  least h  values of robots 1, 2, 3  mode of robot 1"
        );
        for line in run(controller, hold_max)?.iter().step_by(2) {
            println!("{}", text(line));
        }
    }
    Ok(())
}

fn text(line: &Line) -> String {
    let Line { time_s, farthest_m, degree_min, h_min, values: [one, two, three], modes } = line;
    let values = format!("{one:6.2}  {two:6.2}  {three:6.2}");
    format!("{time_s:4} s {farthest_m:12.2} m {degree_min:17} {h_min:8.3}    {values}  {:?}", modes[0])
}

/// Ten seconds, a line a second, of robots that are told that a velocity is held for at most `hold_max`.
pub(crate) fn run(controller: Controller, hold_max: Duration) -> Result<Vec<Line>, Box<dyn Error>> {
    let mut world = World::new(controller, hold_max)?;
    let mut lines = Vec::new();
    for period in 0..=10 * PERIODS_A_SECOND {
        world.period(period)?;
        if period % PERIODS_A_SECOND == 0 {
            lines.push(world.line(period / PERIODS_A_SECOND));
        }
    }
    Ok(lines)
}

/// The settings of the team: every robot has the same, as it must be.
fn settings(controller: Controller, hold_max: Duration) -> Settings<2> {
    let input = InputBox::of([-SPEED_M_S; 2], [SPEED_M_S; 2]);
    // Robots tick at different moments of a period. Another one is where it was at its own tick, or one longest move away.
    let longest_m = 2.0_f64.sqrt() * SPEED_M_S * hold_max.as_secs_f64();
    Settings {
        team: Team { robots: 4, faults: 1 },
        link: LinkSettings { radius_m: RADIUS_M, ..LinkSettings::default() },
        limits: Limits { distance_min_m: 0.3, input, ..Limits::default() },
        controller,
        clock: Clock {
            level_period: PERIOD,
            value_period: ROUND,
            hold_max: Some(hold_max),
            ..Clock::default()
        },
        errors: Errors { position_m: 0.0, tracking_m: 1.001 * longest_m },
        ranks: None,
        consensus: Rule::WMsr,
    }
}

impl World {
    fn new(controller: Controller, hold_max: Duration) -> Result<Self, Box<dyn Error>> {
        let params = Params::new(settings(controller, hold_max))?;
        let body = |number: u16, way: Vector<2>| -> Result<Body, Box<dyn Error>> {
            let value = 10.0 * f64::from(number);
            Ok(Body {
                robot: FourthOfTeam::new(params, RobotId(number), value)?,
                position_m: way.map(|component| 0.5 * component),
                desired_m_s: way.map(|component| SPEED_M_S * component),
                inbox: Vec::new(),
                last: None,
            })
        };
        let bodies =
            [body(1, [-1.0, 0.0])?, body(2, [1.0, 0.0])?, body(3, [0.0, 1.0])?, body(4, [0.0, -1.0])?];
        Ok(Self { now: Instant::START, bodies, random: 1 })
    }

    /// Every robot ticks once, at its own moment: when the period begins or up to [`LATE_MAX`] later.
    fn period(&mut self, period: u64) -> Result<(), Box<dyn Error>> {
        let begin = nanos(PERIOD) * period;
        let mut moments = [(0, 0); ROBOTS];
        for (index, moment) in moments.iter_mut().enumerate() {
            *moment = (begin + self.draw(nanos(LATE_MAX)), index);
        }
        moments.sort_unstable();
        for (moment, index) in moments {
            self.advance(Instant::from_nanos(moment));
            self.tick(index)?;
        }
        Ok(())
    }

    /// All bodies go on with their velocities until `now`.
    fn advance(&mut self, now: Instant) {
        let elapsed_s = now.since(self.now).as_secs_f64();
        for Body { position_m, last, .. } in &mut self.bodies {
            let velocity_m_s = last.map_or([0.0; 2], |output| output.velocity_m_s);
            *position_m = [0, 1].map(|d| position_m[d] + elapsed_s * velocity_m_s[d]);
        }
        self.now = now;
    }

    /// The five calls of one robot, in the order that it asks for.
    fn tick(&mut self, me: usize) -> Result<(), Box<dyn Error>> {
        let positions_m = self.positions_m();
        let Body { robot, inbox, last, desired_m_s, .. } = &mut self.bodies[me];
        robot.sense(self.now, positions_m[me])?;
        for other in (0..ROBOTS).filter(|&other| other != me) {
            robot.observe(id(other), positions_m[other])?;
        }
        let told = robot.share();
        for (sender, bytes) in inbox.drain(..) {
            // Whatever a liar sends is a message or it is not. Neither may end the program.
            if let Ok(message) = Message::parse(&bytes) {
                let _ = robot.receive(sender, &message);
            }
        }
        *last = Some(robot.tick(*desired_m_s));
        if let Some(message) = told {
            self.post(me, &message)?;
        }
        Ok(())
    }

    /// Delivers a message to all others. It is there when they tick next.
    fn post(&mut self, sender: usize, message: &Message) -> Result<(), Box<dyn Error>> {
        for other in (0..ROBOTS).filter(|&other| other != sender) {
            let bytes = if id(sender) == LIAR { lie(message, other)? } else { message.encode() };
            self.bodies[other].inbox.push((id(sender), bytes));
        }
        Ok(())
    }

    /// A number from 0 to `most`, the same in every run.
    fn draw(&mut self, most: u64) -> u64 {
        self.random =
            self.random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.random >> 33) % (most + 1)
    }

    fn positions_m(&self) -> [Vector<2>; ROBOTS] {
        [0, 1, 2, 3].map(|index: usize| self.bodies[index].position_m)
    }

    fn line(&self, time_s: u64) -> Line {
        let honest = [0, 1, 2].map(|index: usize| &self.bodies[index]);
        let reports = || honest.iter().filter_map(|body| body.last.map(|output| output.report));
        let mode = |body: &Body| body.last.map_or(Mode::Stopped, |output| output.report.mode);
        Line {
            time_s,
            farthest_m: farthest_m(&self.positions_m()),
            degree_min: reports().map(|report| report.degree).min().unwrap_or(0),
            h_min: reports().map(|report| report.h).fold(f64::INFINITY, f64::min),
            values: honest.map(|body| body.robot.value()),
            modes: honest.map(mode),
        }
    }
}

/// What the liar tells robot `other` in place of its message: a value far above or below all others,
/// and to one of them bytes that are no message at all.
fn lie(message: &Message, other: usize) -> Result<[u8; MESSAGE_BYTES], Box<dyn Error>> {
    let value = [1000.0, -1000.0, 0.0][other % 3];
    let lie = Message::new(message.sequence(), message.stamp(), message.level(), Some(value))?;
    Ok(if other % 3 == 2 { [0xff; MESSAGE_BYTES] } else { lie.encode() })
}

fn farthest_m(positions_m: &[Vector<2>; ROBOTS]) -> f64 {
    let pairs = positions_m.iter().flat_map(|one| positions_m.iter().map(move |other| (one, other)));
    pairs.map(|(one, other)| (one[0] - other[0]).hypot(one[1] - other[1])).fold(0.0, f64::max)
}

fn id(index: usize) -> RobotId {
    RobotId(u16::try_from(index + 1).unwrap_or(u16::MAX))
}

fn nanos(duration: Duration) -> u64 {
    u64::try_from(duration.as_nanos()).unwrap_or(u64::MAX)
}
