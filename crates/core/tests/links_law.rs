//! The theorems of `links`: a link that is counted on is never longer than R, whatever is lost or late, and whoever begins anew; and who counted
//! on enough keeps enough neighbours, also if it begins anew.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

mod seeded;

use core::time::Duration;

use closeranks_core::controller::links::wire::{LinkMessage, bytes_max};
use closeranks_core::num::{Vector, add_scaled, dot, sqrt, subtract};
use closeranks_core::{
    Clock, Controller, Errors, Instant, LinksSettings, Mode, Params, RobotId, Settings, SizedRobot, Team,
};
use seeded::Seeded;

const ROBOTS: usize = 6;
const TICK_MS: u64 = 50;
/// So many neighbours a robot must count on.
const NEED: usize = 4;

/// Robots that go where they like through a network that loses half of all messages and delivers the others late.
struct World<const D: usize> {
    robots: [SizedRobot<D, 5, 24>; ROBOTS],
    positions_m: [Vector<D>; ROBOTS],
    wishes_m_s: [Vector<D>; ROBOTS],
    late: Vec<(u64, usize, usize, Vec<u8>)>,
    /// When each began anew.
    born: [u64; ROBOTS],
    /// Who counted on enough once.
    kept: [bool; ROBOTS],
    /// By how much the place of each robot is sensed wrong, m: at most `error_m` for each part of it.
    error_m: f64,
    errors_m: [Vector<D>; ROBOTS],
    random: Seeded,
}

fn id(index: usize) -> RobotId {
    RobotId(u16::try_from(index + 1).unwrap())
}

impl<const D: usize> World<D> {
    fn new(seed: u64, error_m: f64) -> Self {
        let period = Duration::from_millis(TICK_MS);
        let settings = Settings {
            team: Team { robots: 6, faults: 1 },
            clock: Clock { level_period: period, value_period: period, ..Clock::default() },
            controller: Controller::Links(LinksSettings { gamma: Some(1.0), ..LinksSettings::default() }),
            errors: Errors { position_m: error_m * sqrt(3.0), ..Errors::default() },
            ..Settings::default()
        };
        let params = Params::new(settings).unwrap();
        let place = |index: usize| {
            let mut place = [0.0; D];
            (place[0], place[1]) = (0.6 * f64::from(id(index).0 % 3), 0.6 * f64::from(id(index).0 / 3));
            place
        };
        Self {
            robots: core::array::from_fn(|index| SizedRobot::new(params, id(index), 0.0).unwrap()),
            positions_m: core::array::from_fn(place),
            wishes_m_s: [[0.0; D]; ROBOTS],
            late: Vec::new(),
            born: [0; ROBOTS],
            kept: [false; ROBOTS],
            error_m,
            errors_m: [[0.0; D]; ROBOTS],
            random: Seeded(seed),
        }
    }

    fn tick(&mut self, tick: u64) {
        for me in 0..ROBOTS {
            if self.chance(0.003) {
                self.robots[me].restart(0.0).unwrap();
                self.born[me] = tick;
            }
            if self.chance(0.1) {
                self.errors_m[me] =
                    core::array::from_fn(|_| self.random.between(-self.error_m, self.error_m));
                self.wishes_m_s[me] = core::array::from_fn(|_| self.random.between(-1.5, 1.5));
            }
        }
        self.sense(tick);
        for me in 0..ROBOTS {
            let mut bytes = [0; bytes_max(6, 3)];
            let message = self.robots[me].share().unwrap();
            let length = self.robots[me].encode(&message, &mut bytes).unwrap();
            for other in (0..ROBOTS).filter(|other| *other != me) {
                for _ in 0..2 {
                    if self.chance(0.5) {
                        let due = tick + u64::try_from(self.random.below(30)).unwrap();
                        self.late.push((due, me, other, bytes[..length].to_vec()));
                    }
                }
            }
        }
        let (due, late) = core::mem::take(&mut self.late).into_iter().partition(|(due, ..)| *due <= tick);
        self.late = late;
        for (_, sender, receiver, bytes) in due {
            let _ = self.robots[receiver].receive_bytes(id(sender), &bytes);
        }
    }

    fn sense(&mut self, tick: u64) {
        let now = Instant::from_nanos(tick * TICK_MS * 1_000_000);
        for me in 0..ROBOTS {
            let sensed_m = |robot: usize| add_scaled(&self.positions_m[robot], 1.0, &self.errors_m[robot]);
            self.robots[me].sense(now, sensed_m(me)).unwrap();
            for other in (0..ROBOTS).filter(|other| *other != me) {
                if self.square_m2(me, other) <= 9.0 {
                    self.robots[me].observe(id(other), sensed_m(other)).unwrap();
                }
            }
        }
    }

    /// All decide, and then move. Says how many links are counted on.
    fn go(&mut self, tick: u64) -> usize {
        let (mut counted, mut moves) = (0, [[0.0; D]; ROBOTS]);
        for (me, velocity_m_s) in moves.iter_mut().enumerate() {
            let output = self.robots[me].tick(self.wishes_m_s[me]);
            let others: Vec<RobotId> = self.robots[me].counted().collect();
            assert!(others.iter().all(|other| self.square_m2(me, usize::from(other.0) - 1) <= 9.0));
            assert!(output.report.mode != Mode::Guaranteed || others.len() >= NEED, "{others:?}");
            self.kept[me] |= others.len() >= NEED;
            let near = (0..ROBOTS).filter(|other| *other != me && self.square_m2(me, *other) <= 9.0).count();
            assert!(!self.kept[me] || near >= NEED, "robot {me} had enough once, and has {near} now");
            assert!(self.born[me] < tick || others.is_empty(), "a new life counts on nobody");
            counted += others.len();
            *velocity_m_s = output.velocity_m_s;
        }
        let seconds = Duration::from_millis(TICK_MS).as_secs_f64();
        for (position, velocity) in self.positions_m.iter_mut().zip(&moves) {
            *position = add_scaled(position, seconds, velocity);
        }
        counted
    }

    fn chance(&mut self, probability: f64) -> bool {
        self.random.between(0.0, 1.0) < probability
    }

    fn square_m2(&self, me: usize, other: usize) -> f64 {
        let offset = subtract(&self.positions_m[me], &self.positions_m[other]);
        dot(&offset, &offset)
    }
}

fn run<const D: usize>(seed: u64, error_m: f64) {
    let mut world = World::<D>::new(seed, error_m);
    let (mut counted, mut far) = (0, 0);
    for tick in 0..400 {
        world.tick(tick);
        counted += world.go(tick);
        let far_m2 = 2.9 * 2.9;
        far += usize::from((1..ROBOTS).any(|other| world.square_m2(0, other) > far_m2));
    }
    assert!(counted > 400 && far > 20, "links are counted on, and pulled at: {counted} {far}");
}

//= theory thm:held type=test
#[test]
fn a_link_that_is_counted_on_stays_a_link() {
    for seed in 0..40 {
        run::<2>(seed, 0.0);
        run::<3>(seed, 0.0);
    }
}

//= theory thm:anew type=test
#[test]
fn so_it_does_with_errors() {
    for seed in 0..40 {
        run::<2>(seed, 0.02);
        run::<3>(seed, 0.02);
    }
}

/// Whether a robot that remembers nothing lists somebody that it senses so far away, in its first message. Positions are wrong by up to 2 cm.
fn lists_at(distance_m: f64) -> bool {
    let mut world = World::<2>::new(1, 0.02 / sqrt(3.0));
    let (robot, mut bytes) = (&mut world.robots[0], [0; bytes_max(6, 3)]);
    robot.sense(Instant::START, [0.0; 2]).unwrap();
    robot.observe(id(1), [distance_m, 0.0]).unwrap();
    let message = robot.share().unwrap();
    let length = robot.encode(&message, &mut bytes).unwrap();
    let message = LinkMessage::<2>::parse(&bytes[..length]).unwrap();
    message.items().any(|item| item.id == id(1) && item.entry.listed)
}

//= theory thm:anew type=test
#[test]
fn who_begins_anew_lists_whoever_may_be_in_range() {
    assert!(lists_at(2.99) && lists_at(3.039));
    assert!(!lists_at(3.05));
}
