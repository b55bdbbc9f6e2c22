//! The theorem of `links`: a link that is counted on is never longer than R, whatever is lost or late, and whoever begins anew.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

mod seeded;

use core::time::Duration;

use closeranks_core::controller::links::wire::bytes_max;
use closeranks_core::num::{Vector, add_scaled, dot, subtract};
use closeranks_core::{
    Clock, Controller, Instant, LinksSettings, Mode, Params, RobotId, Settings, SizedRobot, Team,
};
use seeded::Seeded;

const ROBOTS: usize = 6;
const TICK_MS: u64 = 50;

/// Robots that go where they like through a network that loses half of all messages and delivers the others late.
struct World<const D: usize> {
    robots: [SizedRobot<D, 5, 24>; ROBOTS],
    positions_m: [Vector<D>; ROBOTS],
    wishes_m_s: [Vector<D>; ROBOTS],
    late: Vec<(u64, usize, usize, Vec<u8>)>,
    /// When each began anew.
    born: [u64; ROBOTS],
    random: Seeded,
}

fn id(index: usize) -> RobotId {
    RobotId(u16::try_from(index + 1).unwrap())
}

impl<const D: usize> World<D> {
    fn new(seed: u64) -> Self {
        let period = Duration::from_millis(TICK_MS);
        let settings = Settings {
            team: Team { robots: 6, faults: 1 },
            clock: Clock { level_period: period, value_period: period, ..Clock::default() },
            controller: Controller::Links(LinksSettings { gamma: Some(1.0), ..LinksSettings::default() }),
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
            self.robots[me].sense(now, self.positions_m[me]).unwrap();
            for other in (0..ROBOTS).filter(|other| *other != me) {
                if self.square_m2(me, other) <= 9.0 {
                    self.robots[me].observe(id(other), self.positions_m[other]).unwrap();
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
            assert!(output.report.mode != Mode::Guaranteed || others.len() >= 4, "{others:?}");
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

fn run<const D: usize>(seed: u64) {
    let mut world = World::<D>::new(seed);
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
        run::<2>(seed);
        run::<3>(seed);
    }
}
