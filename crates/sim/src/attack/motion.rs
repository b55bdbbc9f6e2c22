//! Robots that go where they like: how a scenario writes it, and where they go.

use closeranks_core::num::{Vector, length, subtract};
use closeranks_core::program::InputBox;

use crate::parse::reader::{Reader, Section};
use crate::random::{Random, Stream};
use crate::scenario::route::{KINDS, Route, Whose};

/// Ticks for which a wandering robot keeps its way.
const WANDER_TICKS: u32 = 20;

/// Where malicious robots go.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum MotionAttack {
    /// Where their controller lets them (Assumption 1).
    #[default]
    Obedient,
    /// Away from the others as fast as they can.
    Flee,
    /// Somewhere else every 20 ticks, as fast as they can.
    Wander,
    /// As is listed for each; one that is not listed obeys.
    Listed(Route),
}

/// A kind that is one word.
type Word = fn() -> MotionAttack;

/// Every kind by its name in scenario files; those with lists are tables.
const WORDS: [(&str, Option<Word>); 6] = [
    ("obedient", Some(|| MotionAttack::Obedient)),
    ("flee", Some(|| MotionAttack::Flee)),
    ("wander", Some(|| MotionAttack::Wander)),
    (KINDS[0].0, None),
    (KINDS[1].0, None),
    (KINDS[2].0, None),
];

impl MotionAttack {
    /// Reads the field `attack.motion` of a scenario text: a word, or a table with a list.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>, malicious: &Whose<'_>) -> Self {
        if section.has_table("motion") {
            return reader
                .table(section, "motion", |reader, section| Self::listed(reader, section, malicious));
        }
        match reader.word(section, "motion", &WORDS) {
            Some(Some(motion)) => motion(),
            Some(None) => {
                let allowed = "for lists a table, such as { kind = \"goals\", file = \"liars.csv\" }";
                reader.refuse("attack.motion", "a word without a list", allowed);
                Self::Obedient
            }
            None => Self::Obedient,
        }
    }

    fn listed(reader: &mut Reader, section: &mut Section<'_>, malicious: &Whose<'_>) -> Self {
        let Some(kind) = reader.kind(section, &KINDS) else {
            if !section.has("kind") {
                let allowed = "`goals`, `waypoints`, `velocities`";
                reader.refuse_in(section, "attack.motion.kind", "not there", allowed);
            }
            return Self::Obedient;
        };
        Self::Listed(Route::read(reader, section, kind, malicious))
    }
}

/// Moves the malicious robots of a run.
#[derive(Clone, Debug)]
pub(crate) struct MotionLiar {
    attack: MotionAttack,
    random: Random,
    tick_s: f64,
    /// Where each wandering robot goes, of length 1 at most.
    ways: Vec<Vec<f64>>,
}

impl MotionLiar {
    /// The malicious robots of a team of so many robots.
    pub(crate) fn new(attack: MotionAttack, seed: u64, robots: usize, tick_s: f64) -> Self {
        Self { attack, random: Random::new(seed, Stream::Motion), tick_s, ways: vec![Vec::new(); robots] }
    }

    /// Where the malicious robot `index` goes in `tick`, m/s; `None` if it obeys its controller.
    pub(crate) fn velocity<const D: usize>(
        &mut self,
        index: usize,
        tick: u32,
        positions_m: &[Vector<D>],
        input: &InputBox<D>,
    ) -> Option<Vector<D>> {
        let way = match &self.attack {
            MotionAttack::Obedient => return None,
            MotionAttack::Flee => away(index, positions_m),
            MotionAttack::Wander => self.wander(index, tick),
            MotionAttack::Listed(route) => {
                let time_s = f64::from(tick) * self.tick_s;
                return Some(input.clip(&route.velocity(index, time_s, self.tick_s, &positions_m[index])?));
            }
        };
        let fastest = (0..D).map(|d| input.max_m_s[d].max(-input.min_m_s[d])).fold(0.0, f64::max);
        Some(input.clip(&way.map(|component| 2.0 * fastest * component)))
    }

    fn wander<const D: usize>(&mut self, index: usize, tick: u32) -> Vector<D> {
        if self.ways[index].len() != D || tick.is_multiple_of(WANDER_TICKS) {
            self.ways[index] = self.random.in_ball::<D>().to_vec();
        }
        core::array::from_fn(|d| self.ways[index][d])
    }
}

/// The direction from the mean of the others to robot `index`, of length 1.
fn away<const D: usize>(index: usize, positions_m: &[Vector<D>]) -> Vector<D> {
    let there = positions_m.iter().filter(|other| !other[0].is_nan());
    let offsets = there.map(|other| subtract(&positions_m[index], other));
    let sum = offsets.fold([0.0; D], |sum, offset| core::array::from_fn(|d| sum[d] + offset[d]));
    let size = length(&sum);
    if size > 0.0 { sum.map(|component| component / size) } else { [0.0; D] }
}
