//! Lies about the connectivity level c_i, for controllers that tell levels: what they are, how a scenario writes them, and how they are told.
//!
//! A new lie is a variant of [`LevelAttack`], its row in `KINDS`, and its arms. The compiler asks for those in `telling`,
//! `LevelLiar::begin_tick` (a bias) and `LevelLiar::to_one` (what each neighbour gets). Another number in place of the level is
//! `LevelLiar::level`'s.

use closeranks_core::message::{MESSAGE_BYTES, Message, VALUE_MAX};
use closeranks_core::time::Instant;

use crate::attack::swing::swing;
use crate::parse::common::{ANY, Kind, NOT_NEGATIVE, PERIOD, interval, one_kind};
use crate::parse::reader::{Reader, Section};
use crate::random::{Random, Stream};

/// A lie about the connectivity level c_i.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum LevelAttack {
    /// The truth: the paper's nominal updating.
    #[default]
    None,
    /// A constant bias ε_i (thm:cbf-qp). The paper understates by −2.5 and overstates by +3.5.
    Bias(f64),
    /// The truth at first, then a bias: outside thm:cbf-qp (docs/theory, sec:wide-attacks).
    Step {
        /// What is added from then on.
        bias: f64,
        /// When the lie begins, s.
        from_s: f64,
    },
    /// A bias that grows, `rate · t`.
    Ramp {
        /// How fast the bias grows, 1/s.
        rate_per_s: f64,
    },
    /// A bias that swings, `amplitude · sin(2π t/period)`: outside thm:cbf-qp.
    Sine {
        /// Greatest bias.
        amplitude: f64,
        /// How long one swing takes, s.
        period_s: f64,
    },
    /// In place of the level, a number drawn evenly from the interval in every tick.
    Random {
        /// Least.
        min: f64,
        /// Greatest.
        max: f64,
    },
    /// In place of the level, a number drawn evenly from the interval for every neighbour on its own.
    Faces {
        /// Least.
        min: f64,
        /// Greatest.
        max: f64,
    },
    /// The level of some time ago, told as if it were of now.
    Replay {
        /// How long ago, s.
        age_s: f64,
    },
    /// Bytes that hold NaN, infinities, huge numbers or stamps from the future, or are no message at all.
    Garbage,
    /// No message at all.
    Silent,
}

/// Every kind by its name in scenario files, with its fields; the first is the default.
const KINDS: [Kind<LevelAttack>; 10] = [
    ("none", |_, _| LevelAttack::None),
    ("bias", |reader, section| LevelAttack::Bias(reader.number_or(section, "bias", ANY, 0.0))),
    ("step", |reader, section| LevelAttack::Step {
        bias: reader.number_or(section, "bias", ANY, 0.0),
        from_s: reader.number_or(section, "from_s", NOT_NEGATIVE, 0.0),
    }),
    ("ramp", |reader, section| LevelAttack::Ramp {
        rate_per_s: reader.number_or(section, "rate_per_s", ANY, 1.0),
    }),
    ("sine", |reader, section| LevelAttack::Sine {
        amplitude: reader.number_or(section, "amplitude", ANY, 0.0),
        period_s: reader.number_or(section, "period_s", PERIOD, 1.0),
    }),
    ("random", |reader, section| {
        let [min, max] = interval(reader, section, [-20.0, 20.0]);
        LevelAttack::Random { min, max }
    }),
    ("faces", |reader, section| {
        let [min, max] = interval(reader, section, [-20.0, 20.0]);
        LevelAttack::Faces { min, max }
    }),
    ("replay", |reader, section| LevelAttack::Replay {
        age_s: reader.number_or(section, "age_s", NOT_NEGATIVE, 1.0),
    }),
    ("garbage", |_, _| LevelAttack::Garbage),
    ("silent", |_, _| LevelAttack::Silent),
];

impl LevelAttack {
    /// Reads the table `attack.level` of a scenario text.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>) -> Self {
        one_kind(reader, section, &KINDS)
    }

    /// True when every neighbour gets one and the same well-formed message.
    #[must_use]
    pub fn is_alike_for_all(self) -> bool {
        self.telling() == Telling::AllAlike
    }

    /// True when every neighbour gets a well-formed message.
    pub(crate) fn is_message(self) -> bool {
        self.telling() != Telling::Broken
    }

    fn telling(self) -> Telling {
        match self {
            Self::Faces { .. } => Telling::EachItsOwn,
            Self::Garbage | Self::Silent => Telling::Broken,
            Self::None
            | Self::Bias(_)
            | Self::Step { .. }
            | Self::Ramp { .. }
            | Self::Sine { .. }
            | Self::Random { .. }
            | Self::Replay { .. } => Telling::AllAlike,
        }
    }
}

/// What the neighbours of a liar get.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Telling {
    /// One and the same message.
    AllAlike,
    /// Messages with different levels.
    EachItsOwn,
    /// No message, or bytes that may be none.
    Broken,
}

/// What one neighbour gets from a liar.
pub(crate) enum LevelFace {
    /// No message arrives.
    Silence,
    /// These bytes arrive.
    Bytes([u8; MESSAGE_BYTES]),
    /// A message with this level arrives, if levels are told.
    Level(Option<f64>),
}

/// Tells the lies of a run.
#[derive(Clone, Debug)]
pub(crate) struct LevelLiar {
    attack: LevelAttack,
    tick_s: f64,
    random: Random,
    /// What is added to the level in this tick.
    bias: f64,
    /// What each robot tells in place of its level in this tick, if anything.
    instead: Vec<Option<f64>>,
    /// The true levels of each robot in all ticks. Only liars that replay keep them.
    past: Vec<Vec<f64>>,
}

impl LevelLiar {
    /// The liars of a team of so many robots.
    pub(crate) fn new(attack: LevelAttack, seed: u64, robots: usize, tick_s: f64) -> Self {
        Self {
            attack,
            tick_s,
            random: Random::new(seed, Stream::Levels),
            bias: 0.0,
            instead: vec![None; robots],
            past: vec![Vec::new(); robots],
        }
    }

    /// Decides what is told at `time_s`; random levels are drawn in order of robot numbers.
    pub(crate) fn begin_tick(&mut self, time_s: f64, malicious: &[bool]) {
        self.bias = match self.attack {
            LevelAttack::Bias(bias) => bias,
            LevelAttack::Step { bias, from_s } => {
                if time_s >= from_s {
                    bias
                } else {
                    0.0
                }
            }
            LevelAttack::Ramp { rate_per_s } => rate_per_s * time_s,
            LevelAttack::Sine { amplitude, period_s } => swing(amplitude, period_s, time_s),
            LevelAttack::None
            | LevelAttack::Random { .. }
            | LevelAttack::Faces { .. }
            | LevelAttack::Replay { .. }
            | LevelAttack::Garbage
            | LevelAttack::Silent => 0.0,
        };
        let LevelAttack::Random { min, max } = self.attack else { return };
        for (instead, _) in self.instead.iter_mut().zip(malicious).filter(|(_, malicious)| **malicious) {
            *instead = Some(self.random.uniform(min, max));
        }
    }

    /// The level that the liar `index` holds and tells in this tick when its true one is `level`. A liar that tells each
    /// neighbour something else holds the true one.
    pub(crate) fn level(&mut self, index: usize, level: f64) -> f64 {
        if let LevelAttack::Replay { age_s } = self.attack {
            return self.replayed(index, level, age_s);
        }
        match self.instead[index] {
            Some(instead) => instead,
            None if self.bias != 0.0 => level + self.bias,
            None => level,
        }
    }

    fn replayed(&mut self, index: usize, level: f64, age_s: f64) -> f64 {
        let past = &mut self.past[index];
        past.push(level);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let ticks = (age_s / self.tick_s).round() as usize;
        past[past.len().saturating_sub(ticks.saturating_add(1))]
    }

    /// What one neighbour gets in place of `message`.
    pub(crate) fn to_one(&self, message: &Message, random: &mut Random) -> LevelFace {
        match self.attack {
            LevelAttack::Silent => LevelFace::Silence,
            LevelAttack::Garbage => LevelFace::Bytes(garbage(message, random)),
            LevelAttack::Faces { min, max } => {
                LevelFace::Level(message.level().map(|_| random.uniform(min, max)))
            }
            LevelAttack::None
            | LevelAttack::Bias(_)
            | LevelAttack::Step { .. }
            | LevelAttack::Ramp { .. }
            | LevelAttack::Sine { .. }
            | LevelAttack::Random { .. }
            | LevelAttack::Replay { .. } => LevelFace::Level(message.level()),
        }
    }
}

/// A message in which one number is no number or much too large, or in which one byte is wrong.
fn garbage(message: &Message, random: &mut Random) -> [u8; MESSAGE_BYTES] {
    let far = Instant::from_nanos(u64::MAX);
    let (level, value) = (message.level().map(|_| f64::MAX), message.value().map(|_| -VALUE_MAX));
    let huge = Message::new(u32::MAX, far, level, value);
    let mut bytes = huge.map_or_else(|_| message.encode(), |huge| huge.encode());
    let numbers = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -f64::MAX, 1e18, 0.0];
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 32")]
    let mut below = |most: f64| random.uniform(0.0, most) as usize;
    match below(4.0) {
        0 => bytes[16..24].copy_from_slice(&numbers[below(6.0)].to_le_bytes()),
        1 => bytes[24..].copy_from_slice(&numbers[below(6.0)].to_le_bytes()),
        2 => bytes[below(32.0)] ^= 1 << below(8.0),
        _ => {}
    }
    bytes
}
