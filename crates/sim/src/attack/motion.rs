//! Robots that go where they like: how a scenario writes it, and where they go.

use closeranks_core::num::{Vector, length, subtract};
use closeranks_core::program::InputBox;

use crate::parse::reader::{Reader, Section};
use crate::random::{Random, Stream};

/// Ticks for which a wandering robot keeps its way.
const WANDER_TICKS: u32 = 20;

/// Where malicious robots go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MotionAttack {
    /// Where their controller lets them (Assumption 1).
    #[default]
    Obedient,
    /// Away from the others as fast as they can.
    Flee,
    /// Somewhere else every 20 ticks, as fast as they can.
    Wander,
}

/// Every kind by its name in scenario files.
const KINDS: [(&str, MotionAttack); 3] =
    [("obedient", MotionAttack::Obedient), ("flee", MotionAttack::Flee), ("wander", MotionAttack::Wander)];

impl MotionAttack {
    /// Reads the field `attack.motion` of a scenario text.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>) -> Self {
        reader.word(section, "motion", &KINDS).unwrap_or_default()
    }
}

/// Moves the malicious robots of a run.
#[derive(Clone, Debug)]
pub(crate) struct MotionLiar {
    attack: MotionAttack,
    random: Random,
    /// Where each wandering robot goes, of length 1 at most.
    ways: Vec<Vec<f64>>,
}

impl MotionLiar {
    /// The malicious robots of a team of so many robots.
    pub(crate) fn new(attack: MotionAttack, seed: u64, robots: usize) -> Self {
        Self { attack, random: Random::new(seed, Stream::Motion), ways: vec![Vec::new(); robots] }
    }

    /// Where the malicious robot `index` goes in `tick`, m/s; `None` if it obeys its controller.
    pub(crate) fn velocity<const D: usize>(
        &mut self,
        index: usize,
        tick: u32,
        positions_m: &[Vector<D>],
        input: &InputBox<D>,
    ) -> Option<Vector<D>> {
        let way = match self.attack {
            MotionAttack::Obedient => return None,
            MotionAttack::Flee => away(index, positions_m),
            MotionAttack::Wander => self.wander(index, tick),
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
    let offsets = positions_m.iter().map(|other| subtract(&positions_m[index], other));
    let sum = offsets.fold([0.0; D], |sum, offset| core::array::from_fn(|d| sum[d] + offset[d]));
    let size = length(&sum);
    if size > 0.0 { sum.map(|component| component / size) } else { [0.0; D] }
}
