//! What a robot costs: CPU time, messages, and how long it takes from what it is shown to its velocity. Said in its log when it stops.

use core::fmt;
use core::time::Duration;

use closeranks_core::Instant;

use crate::clock::cpu;
use crate::session::Traffic;

/// Times of so many ticks are kept; later ones are not looked at.
const KEPT: usize = 100_000;

/// Figures of a robot since it began.
#[derive(Debug)]
pub(crate) struct Figures {
    began: Instant,
    cpu: Duration,
    ticks: u64,
    shown: Option<Instant>,
    /// From the arrival of a look to the velocity, us.
    reaction_us: Vec<u32>,
    /// Of that, what the robot worked, us: signing, deciding and checking of what is late are in it, waiting is not.
    busy_us: Vec<u32>,
}

impl Figures {
    pub(crate) fn begin(now: Instant) -> Self {
        Self { began: now, cpu: cpu(), ticks: 0, shown: None, reaction_us: Vec::new(), busy_us: Vec::new() }
    }

    /// Something was shown to the robot.
    pub(crate) fn shown(&mut self, now: Instant) {
        self.shown = Some(now);
    }

    /// It has given a velocity to its base.
    pub(crate) fn drove(&mut self, now: Instant, busy_us: u32) {
        self.ticks += 1;
        if let Some(shown) = self.shown.take().filter(|_| self.reaction_us.len() < KEPT) {
            self.reaction_us.push(u32::try_from(now.since(shown).as_micros()).unwrap_or(u32::MAX));
            self.busy_us.push(busy_us);
        }
    }

    /// All of them, at the end.
    pub(crate) fn end(mut self, now: Instant, traffic: Traffic) -> Said {
        let [reaction_us, busy_us] = [&mut self.reaction_us, &mut self.busy_us].map(|all| {
            all.sort_unstable();
            [quantile(all, 50), quantile(all, 99)]
        });
        let (seconds, cpu) = (now.since(self.began), cpu().saturating_sub(self.cpu));
        Said { seconds, cpu, ticks: self.ticks, traffic, reaction_us, busy_us }
    }
}

/// The number below which so many of 100 of the sorted ones are; 0 of none.
fn quantile(sorted: &[u32], percent: usize) -> u32 {
    sorted.get(sorted.len().saturating_sub(1) * percent / 100).copied().unwrap_or(0)
}

/// Figures of a whole run.
pub(crate) struct Said {
    seconds: Duration,
    cpu: Duration,
    ticks: u64,
    traffic: Traffic,
    reaction_us: [u32; 2],
    busy_us: [u32; 2],
}

impl fmt::Display for Said {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { traffic: Traffic { sent, heard }, .. } = self;
        write!(
            f,
            "figures: {:.1} s, {} ticks, CPU {:.3} s; sent {} messages, {} bytes; heard {} messages, {} bytes; from a look to the velocity {} us \
             (99 of 100: {} us), of that work {} us ({} us)",
            self.seconds.as_secs_f64(),
            self.ticks,
            self.cpu.as_secs_f64(),
            sent[0],
            sent[1],
            heard[0],
            heard[1],
            self.reaction_us[0],
            self.reaction_us[1],
            self.busy_us[0],
            self.busy_us[1],
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_members_of_the_list() {
        let all: Vec<u32> = (0..=100).collect();
        assert_eq!(
            (quantile(&all, 50), quantile(&all, 99), quantile(&[7], 99), quantile(&[], 50)),
            (50, 99, 7, 0)
        );
    }

    #[test]
    fn a_tick_without_a_look_has_no_reaction() {
        let at = |ms: u64| Instant::from_nanos(ms * 1_000_000);
        let mut figures = Figures::begin(at(0));
        figures.drove(at(1), 5);
        figures.shown(at(2));
        figures.drove(at(5), 7);
        let said = figures.end(at(10), Traffic::default());
        assert_eq!((said.ticks, said.reaction_us, said.busy_us), (2, [3_000; 2], [7; 2]));
    }
}
