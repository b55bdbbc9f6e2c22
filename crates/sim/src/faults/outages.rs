//! Robots that miss ticks, crash and return.

use closeranks_core::num::Vector;

use crate::faults::spell::Spell;
use crate::frame::Presence;
use crate::parse::common::{FRACTION, set};
use crate::parse::reader::{Reader, Section};
use crate::random::{Random, Stream};

/// When robots do not run, and what becomes of them then.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outages {
    /// Probability that a robot misses a tick.
    pub missed: f64,
    /// Whether a robot that misses a tick goes on with its last velocity instead of standing still.
    pub goes_on: bool,
    /// A robot that stands still, silent and deaf for a while.
    pub crash: Option<Spell>,
    /// Whether that robot has forgotten everything when it returns.
    pub forgets: bool,
}

impl Outages {
    /// Reads the fields of the table `plant` of a scenario text that are about outages, for a team of so many robots.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>, robots: u16) -> Self {
        let mut outages = Self::default();
        set(&mut outages.missed, reader.number(section, "missed", FRACTION));
        let held = [("stops", false), ("goes-on", true)];
        set(&mut outages.goes_on, reader.word(section, "when_missed", &held));
        outages.crash = Spell::read(reader, section, "crash", robots);
        let memory = [("keeps", false), ("forgets", true)];
        set(&mut outages.forgets, reader.word(section, "memory", &memory));
        outages
    }
}

/// Who is down in a run.
#[derive(Clone, Debug)]
pub struct Downtime {
    outages: Outages,
    random: Random,
    down: Vec<bool>,
    /// Robots that came in this tick and begin anew.
    arrived: Vec<bool>,
    /// Whether the crash lasted in the tick before, and whether it lasts in this one.
    crash: [bool; 2],
}

impl Downtime {
    /// The outages of a team of so many robots, all of which are up.
    #[must_use]
    pub fn new(outages: Outages, seed: u64, robots: u16) -> Self {
        Self {
            outages,
            random: Random::new(seed, Stream::Plant),
            down: vec![false; usize::from(robots)],
            arrived: vec![false; usize::from(robots)],
            crash: [false; 2],
        }
    }

    /// Decides who misses this tick: those who are absent in any case.
    pub fn begin_tick(&mut self, time_s: f64, presence: &Presence) {
        self.arrived.clone_from(&presence.arrived);
        self.crash = [self.crash[1], self.outages.crash.is_some_and(|spell| spell.lasts(time_s))];
        for index in 0..self.down.len() {
            self.down[index] = presence.absent[index]
                || self.crashed(index)
                || (self.outages.missed > 0.0 && self.random.chance(self.outages.missed));
        }
    }

    fn crashes(&self, index: usize) -> bool {
        self.outages.crash.is_some_and(|spell| spell.index() == index)
    }

    /// True while the crash of this robot lasts.
    fn crashed(&self, index: usize) -> bool {
        self.crash[1] && self.crashes(index)
    }

    /// True if the robot does nothing in this tick.
    #[must_use]
    pub fn down(&self, index: usize) -> bool {
        self.down[index]
    }

    /// True if the robot begins anew in this tick: it returns from a crash and has forgotten everything, or it comes.
    #[must_use]
    pub fn reborn(&self, index: usize) -> bool {
        let returns = self.outages.forgets && self.crash == [true, false] && self.crashes(index);
        returns || self.arrived[index]
    }

    /// Velocity of a robot that misses a tick, when its last one was `last`.
    #[must_use]
    pub fn without_command<const D: usize>(&self, index: usize, last: Vector<D>) -> Vector<D> {
        if self.outages.goes_on && !self.crashed(index) { last } else { [0.0; D] }
    }

    /// True when some robot goes on without having looked.
    #[must_use]
    pub fn blind(&self) -> bool {
        self.outages.goes_on && self.down.iter().any(|down| *down)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn robots_crash_and_miss_ticks() {
        let crash = Some(Spell { robot: 2, from_s: 0.1, to_s: 0.2 });
        let mut downtime = Downtime::new(Outages { crash, forgets: true, ..Outages::default() }, 1, 11);
        let seen = [0.05, 0.1, 0.195, 0.2, 0.205].map(|time_s| {
            downtime.begin_tick(time_s, &Presence::full(11));
            (downtime.down(1), downtime.reborn(1))
        });
        let (up, down) = ((false, false), (true, false));
        assert_eq!(seen, [up, down, down, (false, true), up]);
        assert!(!downtime.reborn(0));
        let mut downtime = Downtime::new(Outages { missed: 0.3, goes_on: true, ..Outages::default() }, 1, 11);
        let missed: usize = (0..100)
            .map(|_| {
                downtime.begin_tick(0.0, &Presence::full(11));
                usize::from(downtime.down(4))
            })
            .sum();
        assert!((15..45).contains(&missed));
        assert_eq!(downtime.without_command(4, [1.0, 2.0]), [1.0, 2.0]);
    }

    /// A crash may end at a time that ticks meet but for the last place: k T and (k − 1) T + T are not one number.
    #[test]
    fn a_robot_that_forgets_begins_anew_once() {
        for (tick_s, to_s) in [(0.005, 0.1), (0.01, 0.07), (0.1, 0.7), (0.007, 0.63)] {
            let crash = Some(Spell { robot: 2, from_s: 0.02, to_s });
            let mut downtime = Downtime::new(Outages { crash, forgets: true, ..Outages::default() }, 1, 11);
            let births = (0..400).filter(|tick| {
                downtime.begin_tick(f64::from(*tick) * tick_s, &Presence::full(11));
                downtime.reborn(1)
            });
            assert_eq!(births.count(), 1, "{tick_s} s, {to_s} s");
        }
    }
}
