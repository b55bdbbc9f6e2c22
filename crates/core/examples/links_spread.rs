//! How far the paper's team gets under `links`, by time, tick, loss and lies: the table in docs/links.md.
//!
//! `cargo run --release -p closeranks-core --example links_spread -- 36`
//!
//! Eleven robots from the hexagonal patch `inside`, the paper's desired motion; mean radius of gyration over so many random
//! assignments of robots to places (24 if no number is given). In each run degrees and distances of normal robots are asserted at
//! every tick. The last column is the number of changes of lists a second in the last two seconds of a run.

use core::error::Error;
use core::time::Duration;

use closeranks_core::controller::links::protocol::Entry;
use closeranks_core::controller::links::wire::{Head, Item, LinkMessage, bytes_max};
use closeranks_core::num::{Vector, add_scaled, dot, length, subtract};
use closeranks_core::{Clock, Controller, Instant, LinksSettings, Params, RobotId, Settings, SizedRobot};

const ROBOTS: usize = 11;
const BYTES: usize = bytes_max(11, 2);
/// When the radius is looked at, s.
const TIMES_S: [f64; 4] = [1.0, 2.0, 4.0, 10.0];
/// Column in half spacings and row of each place.
const PLACES: [[f64; 2]; ROBOTS] = [
    [-3.0, -1.0],
    [2.0, 0.0],
    [0.0, 0.0],
    [-1.0, -1.0],
    [1.0, 1.0],
    [3.0, 1.0],
    [-1.0, 1.0],
    [-2.0, 0.0],
    [3.0, -1.0],
    [1.0, -1.0],
    [-3.0, 1.0],
];

/// What the first two robots tell.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Liars {
    None,
    Never,
    Always,
    Random,
    Siren,
    Deserter,
}

/// What is measured.
#[derive(Clone, Copy)]
struct Case {
    name: &'static str,
    tick_ms: u64,
    loss: f64,
    liars: Liars,
    settings: LinksSettings,
}

#[expect(clippy::print_stdout, reason = "a report")]
fn main() -> Result<(), Box<dyn Error>> {
    let assignments: u64 = std::env::args().nth(1).map_or(Ok(24), |count| count.parse())?;
    let from: u64 = std::env::args().nth(2).map_or(Ok(0), |count| count.parse())?;
    println!("{:24}{}   least  changes", "gyration, m, after", TIMES_S.map(|s| format!("{s:>6} s")).concat());
    for case in cases() {
        let mut sums = [0.0; TIMES_S.len()];
        let (mut least, mut changes) = (f64::INFINITY, 0.0);
        for assignment in from..from + assignments {
            let (radii, late) = run(&case, assignment)?;
            sums.iter_mut().zip(radii).for_each(|(sum, radius)| *sum += radius);
            least = least.min(radii[TIMES_S.len() - 1]);
            changes += late;
        }
        #[expect(clippy::cast_precision_loss, reason = "few")]
        let count = assignments as f64;
        let cells = sums.map(|sum| format!("{:8.3}", sum / count)).concat();
        println!("{:24}{cells}{least:8.3}{:8.2}", case.name, changes / count);
    }
    Ok(())
}

fn cases() -> Vec<Case> {
    let settings = LinksSettings::default();
    let plain = Case { name: "20 ms", tick_ms: 20, loss: 0.0, liars: Liars::None, settings };
    let pass = LinksSettings { pass_right: true, ..settings };
    let lies = |name, liars| Case { name, liars, ..plain };
    vec![
        plain,
        Case { name: "20 ms, pass right", settings: pass, ..plain },
        Case { name: "100 ms", tick_ms: 100, ..plain },
        Case { name: "200 ms", tick_ms: 200, ..plain },
        Case { name: "5 ms", tick_ms: 5, ..plain },
        Case { name: "50 % loss", loss: 0.5, ..plain },
        Case { name: "90 % loss", loss: 0.9, ..plain },
        lies("liars: never", Liars::Never),
        lies("liars: always", Liars::Always),
        lies("liars: random", Liars::Random),
        lies("liars: siren", Liars::Siren),
        lies("liars: deserter", Liars::Deserter),
    ]
}

struct Team {
    robots: [SizedRobot<2, 10>; ROBOTS],
    positions_m: [Vector<2>; ROBOTS],
    case: Case,
    draw: u64,
}

/// Radii of gyration at the times, m, and changes of lists a second at the end.
fn run(case: &Case, assignment: u64) -> Result<([f64; TIMES_S.len()], f64), Box<dyn Error>> {
    let period = Duration::from_millis(case.tick_ms);
    let clock = Clock { level_period: period, value_period: period, ..Clock::default() };
    let settings = Settings { clock, controller: Controller::Links(case.settings), ..Settings::default() };
    let params = Params::new(settings)?;
    let mut robots = Vec::new();
    for index in 0..ROBOTS {
        robots.push(SizedRobot::new(params, id(index), 0.0)?);
    }
    let robots = robots.try_into().map_err(|_| "eleven")?;
    let mut team = Team { robots, positions_m: start(assignment), case: *case, draw: assignment };
    let (ticks, last) = (10_000 / case.tick_ms, 8_000 / case.tick_ms);
    let (mut radii, mut changes) = ([0.0; TIMES_S.len()], 0);
    let mut lists = team.lists();
    for tick in 0..=ticks {
        #[expect(clippy::cast_precision_loss, reason = "few")]
        let time_s = (tick * case.tick_ms) as f64 / 1e3;
        if let Some(place) = TIMES_S.iter().position(|time| (time - time_s).abs() < 1e-9) {
            radii[place] = gyration(&team.positions_m);
        }
        team.tick(tick)?;
        let before = core::mem::replace(&mut lists, team.lists());
        if tick >= last {
            changes += before.iter().zip(&lists).map(|(one, two)| (one ^ two).count_ones()).sum::<u32>();
        }
    }
    Ok((radii, f64::from(changes) / 2.0))
}

impl Team {
    fn tick(&mut self, tick: u64) -> Result<(), Box<dyn Error>> {
        let now = Instant::from_nanos(tick * self.case.tick_ms * 1_000_000);
        let mut sent: [Option<Vec<u8>>; ROBOTS] = [const { None }; ROBOTS];
        for me in 0..ROBOTS {
            self.robots[me].sense(now, self.positions_m[me])?;
            let mut degree = 0;
            for other in (0..ROBOTS).filter(|other| *other != me) {
                let offset = subtract(&self.positions_m[me], &self.positions_m[other]);
                if dot(&offset, &offset) <= 9.0 {
                    self.robots[me].observe(id(other), self.positions_m[other])?;
                    degree += 1;
                }
                assert!(dot(&offset, &offset) >= 0.09 - 1e-9, "{} {me} {other} at {now:?}", self.case.name);
            }
            let liar = me < 2 && self.case.liars != Liars::None;
            assert!(degree >= 7 || liar, "{}: robot {me} has {degree} at {now:?}", self.case.name);
            if let Some(message) = self.robots[me].share() {
                let mut bytes = [0; BYTES];
                let length = self.robots[me].encode(&message, &mut bytes).ok_or("room")?;
                sent[me] = Some(bytes[..length].to_vec());
            }
        }
        for me in 0..ROBOTS {
            for other in (0..ROBOTS).filter(|other| *other != me) {
                let Some(bytes) = &sent[other] else { continue };
                if self.chance() < self.case.loss {
                    continue;
                }
                let bytes = if other < 2 { self.lie(bytes, me)? } else { bytes.clone() };
                let _ = self.robots[me].receive_bytes(id(other), &bytes);
            }
        }
        let period_s = Duration::from_millis(self.case.tick_ms).as_secs_f64();
        for me in 0..ROBOTS {
            let output = self.robots[me].tick(desired(me, &self.positions_m[me]));
            self.positions_m[me] = add_scaled(&self.positions_m[me], period_s, &output.velocity_m_s);
        }
        Ok(())
    }

    /// What a liar tells one robot in place of `bytes`.
    fn lie(&mut self, bytes: &[u8], reader: usize) -> Result<Vec<u8>, Box<dyn Error>> {
        let liars = self.case.liars;
        if liars == Liars::None {
            return Ok(bytes.to_vec());
        }
        let message = LinkMessage::<2>::parse(bytes)?;
        let nobody = Item { id: id(reader), entry: Entry::default(), promised: false };
        let mut item = message.items().find(|item| item.id == id(reader)).unwrap_or(nobody);
        let mut head = Head { price_m: 0.0, ..*message.head() };
        item.promised = true;
        item.entry.listed = match liars {
            Liars::Never | Liars::Siren => true,
            Liars::Random => self.chance() < 0.5,
            _ => false,
        };
        if liars == Liars::Random {
            item.promised = self.chance() < 0.5;
            head.wish_m_s = core::array::from_fn(|_| 2.0 * self.chance() - 1.0);
        }
        if matches!(liars, Liars::Siren | Liars::Deserter) {
            head.wish_m_s = self.robots[reader].wish_m_s().map(|component| -10.0 * component);
        }
        let mut told = [0; BYTES];
        let length = head.encode(core::iter::once(item), &mut told).ok_or("room")?;
        Ok(told[..length].to_vec())
    }

    /// For each robot whom it lists, as bits.
    fn lists(&self) -> [u32; ROBOTS] {
        core::array::from_fn(|me| {
            let listed = self.robots[me].neighbors().iter().filter(|slot| slot.is_listed());
            listed.fold(0, |bits, slot| bits | 1 << slot.id().0)
        })
    }

    fn chance(&mut self) -> f64 {
        self.draw = self.draw.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(self.draw >> 33).unwrap_or(0)) / f64::from(1_u32 << 31)
    }
}

fn gyration(positions: &[Vector<2>; ROBOTS]) -> f64 {
    let center = positions.iter().fold([0.0; 2], |sum, x| add_scaled(&sum, 1.0 / 11.0, x));
    let square = |x: &Vector<2>| dot(&subtract(x, &center), &subtract(x, &center));
    (positions.iter().map(square).sum::<f64>() / 11.0).sqrt()
}

fn start(assignment: u64) -> [Vector<2>; ROBOTS] {
    let (mut places, mut state) = (PLACES, assignment);
    for last in (1..ROBOTS).rev() {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        places.swap(last, usize::try_from(state >> 33).unwrap_or(0) % (last + 1));
    }
    places.map(|[column, row]| [0.3 * column, 0.6 * 0.75_f64.sqrt() * row])
}

fn id(index: usize) -> RobotId {
    RobotId(u16::try_from(index + 1).unwrap_or(u16::MAX))
}

/// `v = (−1)^i · 100 e_d − x_i`, `v/‖v‖`, m/s; robots 1 to 5 along the first axis.
fn desired(index: usize, position: &Vector<2>) -> Vector<2> {
    let (number, axis) = (index + 1, usize::from(index >= 5));
    let mut toward = position.map(|component| -component);
    toward[axis] += if number.is_multiple_of(2) { 100.0 } else { -100.0 };
    let distance = length(&toward);
    toward.map(|component| component / distance)
}
