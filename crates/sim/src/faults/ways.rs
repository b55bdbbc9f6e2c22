//! Ways from one robot to another that carry nothing, for good or for a while.

use std::collections::BTreeMap;

use crate::random::Random;

/// In teams of up to so many robots there is a table of all ways; in larger ones a way is drawn when it is first used.
const TABLE_MAX: usize = 128;

/// Which ways carry nothing just now.
#[derive(Clone, Debug)]
pub(super) struct Ways {
    robots: usize,
    deaf: f64,
    begin: f64,
    end: f64,
    state: State,
}

/// What is known of ways: sender times n plus receiver.
#[derive(Clone, Debug)]
enum State {
    /// Of all that are deaf or lose everything just now; empty where that never happens.
    All { deaf: Vec<bool>, burst: Vec<bool> },
    /// Of those that were used.
    Used(BTreeMap<usize, Way>),
}

/// A way as it was when it was used last.
#[derive(Clone, Copy, Debug)]
struct Way {
    deaf: bool,
    burst: bool,
    tick: u32,
}

impl Ways {
    /// Ways among so many robots: a share that is `deaf` for good, and in each tick the probabilities that one begins or stops to lose
    /// everything.
    pub(super) fn new(robots: usize, deaf: f64, [begin, end]: [f64; 2], random: &mut Random) -> Self {
        let count = |probability: f64| if probability > 0.0 { robots * robots } else { 0 };
        let state = if robots <= TABLE_MAX {
            let deaf = (0..count(deaf)).map(|_| random.chance(deaf)).collect();
            State::All { deaf, burst: vec![false; count(begin)] }
        } else {
            State::Used(BTreeMap::new())
        };
        Self { robots, deaf, begin, end, state }
    }

    /// Begins a tick, in which ways may begin or stop to lose everything.
    pub(super) fn begin_tick(&mut self, random: &mut Random) {
        if let State::All { burst, .. } = &mut self.state {
            for burst in burst {
                *burst ^= random.chance(if *burst { self.end } else { self.begin });
            }
        }
    }

    /// Whether the way carries nothing in this tick.
    pub(super) fn blocked(&mut self, sender: usize, receiver: usize, tick: u32, random: &mut Random) -> bool {
        let link = sender * self.robots + receiver;
        match &mut self.state {
            State::All { deaf, burst } => deaf.get(link) == Some(&true) || burst.get(link) == Some(&true),
            State::Used(_) if self.deaf <= 0.0 && self.begin <= 0.0 => false,
            State::Used(used) => {
                let deaf = self.deaf;
                let new = || Way { deaf: deaf > 0.0 && random.chance(deaf), burst: false, tick: 0 };
                let first = !used.contains_key(&link);
                let way = used.entry(link).or_insert_with(new);
                let ticks = if first { tick.saturating_add(1) } else { tick - way.tick };
                if self.begin > 0.0 && ticks > 0 {
                    way.burst = random.chance(later(way.burst, [self.begin, self.end], ticks));
                }
                way.tick = tick;
                way.deaf || way.burst
            }
        }
    }
}

/// The probability that a way loses everything so many ticks later.
fn later(burst: bool, [begin, end]: [f64; 2], ticks: u32) -> f64 {
    let share = begin / (begin + end);
    let now = f64::from(u8::from(burst));
    share + (now - share) * power(1.0 - begin - end, ticks)
}

/// By multiplications alone, so that it is the same everywhere.
fn power(base: f64, mut exponent: u32) -> f64 {
    let (mut result, mut square) = (1.0, base);
    while exponent > 0 {
        if exponent % 2 == 1 {
            result *= square;
        }
        square *= square;
        exponent /= 2;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Stream;

    #[test]
    fn a_chance_after_many_ticks_is_that_of_tick_after_tick() {
        for (begin, end) in [(0.02, 0.1), (0.5, 0.5), (1.0, 0.3), (0.9, 0.8)] {
            for burst in [false, true] {
                let mut slow = f64::from(u8::from(burst));
                for ticks in 1..60 {
                    slow = slow * (1.0 - end) + (1.0 - slow) * begin;
                    assert!(
                        (later(burst, [begin, end], ticks) - slow).abs() < 1e-12,
                        "{begin} {end} {ticks}"
                    );
                }
            }
        }
    }

    /// A large team has as many deaf ways and as long bursts as a small one.
    #[test]
    fn ways_that_are_drawn_when_used_are_like_those_of_a_table() {
        for robots in [100, 1_000] {
            let mut random = Random::new(3, Stream::Network);
            let mut ways = Ways::new(robots, 0.2, [0.05, 0.15], &mut random);
            let (mut blocked, mut changes) = (0, 0);
            let mut before = [true; 99];
            for tick in 0..400 {
                ways.begin_tick(&mut random);
                for receiver in 1..100 {
                    let now = ways.blocked(0, receiver, tick, &mut random);
                    blocked += u32::from(now);
                    changes += u32::from(now != core::mem::replace(&mut before[receiver - 1], now));
                }
            }
            // 1 - 0.8 * 0.75 of 39,600, and 0.8 * 2 * 0.25 * 0.15 changes of as many.
            assert!((14_000..18_000).contains(&blocked), "{robots}: {blocked}");
            assert!((1_900..2_900).contains(&changes), "{robots}: {changes}");
        }
    }
}
