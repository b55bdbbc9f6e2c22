//! Lies about the value y_i: what they are, how a scenario writes them, and how they are told.
//!
//! A new lie is a variant of [`ValueAttack`], its row in `KINDS`, and its arms. The compiler asks for those in `has_one_voice`,
//! `shows_its_own`, `ValueLiar::chosen` (what all are told) and `ValueLiar::to_one` (what each neighbour is told).

use closeranks_core::message::VALUE_MAX;

use crate::attack::swing::swing;
use crate::parse::common::{ANY, Kind, PERIOD, VALUE, interval, one_kind};
use crate::parse::reader::{Reader, Section};
use crate::random::{Random, Stream};

/// The interval from which the paper draws values, initial ones and lies.
pub(crate) const PAPER: [f64; 2] = [-500.0, 500.0];

/// A lie about the value y_i.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ValueAttack {
    /// The truth: the robot follows W-MSR.
    None,
    /// A number drawn evenly from the interval in every round and told to every neighbour: the paper's.
    Random {
        /// Least.
        min: f64,
        /// Greatest.
        max: f64,
    },
    /// Always the same number.
    Constant {
        /// The number that is told.
        value: f64,
    },
    /// `start + rate · t`.
    Ramp {
        /// What is told at first.
        start: f64,
        /// How fast it grows, 1/s.
        rate_per_s: f64,
    },
    /// `amplitude · sin(2π t/period)`.
    Sine {
        /// The greatest value told.
        amplitude: f64,
        /// How long one swing takes, s.
        period_s: f64,
    },
    /// The largest and the least value that a message can hold, ±10³⁰⁰, by turns.
    Extreme,
    /// A number drawn for every neighbour on its own. thm:rs_robust does not cover this, because it needs one voice;
    /// thm:two-faced does.
    Faces {
        /// Least.
        min: f64,
        /// Greatest.
        max: f64,
    },
    /// Colluding with one voice: every other liar tells the greatest value of normal robots, the rest the least, so that no
    /// lie is discarded where it helps.
    Sway,
    /// Colluding with two faces, the strongest attack that we know: a robot in the upper half hears the greatest value of
    /// normal robots, the others hear the least.
    Split,
    /// No value.
    Silent,
}

/// Every kind by its name in scenario files, with its fields; the first is the default.
const KINDS: [Kind<ValueAttack>; 10] = [
    ("random", |reader, section| {
        let [min, max] = interval(reader, section, PAPER);
        ValueAttack::Random { min, max }
    }),
    ("none", |_, _| ValueAttack::None),
    ("constant", |reader, section| ValueAttack::Constant {
        value: reader.number_or(section, "value", VALUE, 500.0),
    }),
    ("ramp", |reader, section| ValueAttack::Ramp {
        start: reader.number_or(section, "start", ANY, 0.0),
        rate_per_s: reader.number_or(section, "rate_per_s", ANY, 100.0),
    }),
    ("sine", |reader, section| ValueAttack::Sine {
        amplitude: reader.number_or(section, "amplitude", ANY, 500.0),
        period_s: reader.number_or(section, "period_s", PERIOD, 1.0),
    }),
    ("extreme", |_, _| ValueAttack::Extreme),
    ("faces", |reader, section| {
        let [min, max] = interval(reader, section, PAPER);
        ValueAttack::Faces { min, max }
    }),
    ("sway", |_, _| ValueAttack::Sway),
    ("split", |_, _| ValueAttack::Split),
    ("silent", |_, _| ValueAttack::Silent),
];

impl Default for ValueAttack {
    fn default() -> Self {
        let [min, max] = PAPER;
        Self::Random { min, max }
    }
}

impl ValueAttack {
    /// Reads the table `attack.value` of a scenario text.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>) -> Self {
        one_kind(reader, section, &KINDS)
    }

    /// True when no two neighbours are told different values, as the paper's definition wants it (misbeh).
    #[must_use]
    pub fn has_one_voice(self) -> bool {
        match self {
            Self::Faces { .. } | Self::Split => false,
            Self::None
            | Self::Random { .. }
            | Self::Constant { .. }
            | Self::Ramp { .. }
            | Self::Sine { .. }
            | Self::Extreme
            | Self::Sway
            | Self::Silent => true,
        }
    }

    /// True when every neighbour is told one and the same value.
    #[must_use]
    pub fn is_alike_for_all(self) -> bool {
        self.has_one_voice() && self != Self::Silent
    }

    /// True when the value that everybody sees of a liar is the one that it holds.
    fn shows_its_own(self) -> bool {
        match self {
            Self::None | Self::Faces { .. } | Self::Split | Self::Silent => true,
            Self::Random { .. }
            | Self::Constant { .. }
            | Self::Ramp { .. }
            | Self::Sine { .. }
            | Self::Extreme
            | Self::Sway => false,
        }
    }
}

/// Tells the lies of a run.
#[derive(Clone, Debug)]
pub(crate) struct ValueLiar {
    attack: ValueAttack,
    random: Random,
    /// What each liar tells everybody in this round.
    told: Vec<f64>,
    /// Least and greatest value of normal robots in this round; 0 if there are none.
    normal: [f64; 2],
}

impl ValueLiar {
    /// The liars of a team of so many robots.
    pub(crate) fn new(attack: ValueAttack, seed: u64, robots: usize) -> Self {
        Self { attack, random: Random::new(seed, Stream::Attack), told: vec![0.0; robots], normal: [0.0; 2] }
    }

    /// Decides what is told in the round that begins with `tick`, in order of robot numbers; all robots hold `values`.
    pub(crate) fn begin_round(
        &mut self,
        tick: u32,
        time_s: f64,
        values: impl Iterator<Item = f64>,
        malicious: &[bool],
    ) {
        let normal = values.zip(malicious).filter(|(_, malicious)| !**malicious);
        self.normal = normal.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], (value, _)| {
            [low.min(value), high.max(value)]
        });
        if !malicious.contains(&false) {
            self.normal = [0.0; 2];
        }
        for (index, _) in malicious.iter().enumerate().filter(|(_, malicious)| **malicious) {
            self.told[index] = self.chosen(index, tick, time_s);
        }
    }

    /// What the liar `index` chooses to tell everybody.
    fn chosen(&mut self, index: usize, tick: u32, time_s: f64) -> f64 {
        let [low, high] = self.normal;
        let even = index.is_multiple_of(2);
        match self.attack {
            ValueAttack::Random { min, max } => self.random.uniform(min, max),
            ValueAttack::Constant { value } => value,
            ValueAttack::Ramp { start, rate_per_s } => start + rate_per_s * time_s,
            ValueAttack::Sine { amplitude, period_s } => swing(amplitude, period_s, time_s),
            ValueAttack::Extreme if even == tick.is_multiple_of(2) => VALUE_MAX,
            ValueAttack::Extreme => -VALUE_MAX,
            ValueAttack::Sway if even => high,
            ValueAttack::Sway => low,
            ValueAttack::None | ValueAttack::Faces { .. } | ValueAttack::Split | ValueAttack::Silent => 0.0,
        }
    }

    /// The value that the liar `index`, which holds `value`, tells everybody.
    pub(crate) fn value(&self, index: usize, value: f64) -> f64 {
        if self.attack.shows_its_own() { value } else { self.told[index] }
    }

    /// What one neighbour that holds `hearer` is told in place of `told`.
    pub(crate) fn to_one(&self, told: f64, hearer: f64, random: &mut Random) -> Option<f64> {
        let [low, high] = self.normal;
        match self.attack {
            ValueAttack::Silent => None,
            ValueAttack::Faces { min, max } => Some(random.uniform(min, max)),
            ValueAttack::Split => Some(if hearer > 0.5 * (low + high) { high } else { low }),
            ValueAttack::None
            | ValueAttack::Random { .. }
            | ValueAttack::Constant { .. }
            | ValueAttack::Ramp { .. }
            | ValueAttack::Sine { .. }
            | ValueAttack::Extreme
            | ValueAttack::Sway => Some(told),
        }
    }
}
