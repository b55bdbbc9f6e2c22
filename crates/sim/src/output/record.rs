//! What a run leaves behind: one row a tick and robot, in columns.

use closeranks_core::equations::barrier::degree_barrier;
use closeranks_core::program::Outcome;

use crate::frame::Frame;
use crate::scenario::Scenario;

/// Columns of a run. Row `tick·n + index` belongs to robot `index + 1`. Ticks go from 0 to the last, both included.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// n.
    pub robots: u16,
    /// F′.
    pub required_degree: u16,
    /// D.
    pub dimension: usize,
    /// τ₁, s.
    pub tick_s: f64,
    /// Which robots are malicious, by index.
    pub malicious: Vec<bool>,
    /// One column a dimension, m.
    pub positions_m: Vec<Vec<f64>>,
    /// One column a dimension, m/s: the input held from this tick on. Rows of the last tick hold what would come next.
    pub inputs_m_s: Vec<Vec<f64>>,
    /// δ_i.
    pub degree: Vec<u16>,
    /// True c_i.
    pub level: Vec<f64>,
    /// c_i as told.
    pub told: Vec<f64>,
    /// h_i.
    pub h: Vec<f64>,
    /// φ_i; NaN of a robot that is down.
    pub phi: Vec<f64>,
    /// y_i.
    pub value: Vec<f64>,
    /// What the program found.
    pub outcome: Vec<Outcome>,
}

impl Record {
    /// An empty record with room for the whole run.
    #[must_use]
    pub fn new(scenario: &Scenario, required_degree: u16) -> Self {
        let rows = (scenario.ticks() as usize + 1) * usize::from(scenario.team.robots);
        let column = || Vec::with_capacity(rows);
        Self {
            robots: scenario.team.robots,
            required_degree,
            dimension: scenario.dimension,
            tick_s: scenario.tick_s(),
            malicious: scenario.malicious_mask(),
            positions_m: vec![column(); scenario.dimension],
            inputs_m_s: vec![column(); scenario.dimension],
            degree: Vec::with_capacity(rows),
            level: column(),
            told: column(),
            h: column(),
            phi: column(),
            value: column(),
            outcome: Vec::with_capacity(rows),
        }
    }

    /// Adds a tick.
    pub fn push<const D: usize>(&mut self, frame: &Frame<D>) {
        for d in 0..D {
            self.positions_m[d].extend(frame.positions_m.iter().map(|position| position[d]));
            self.inputs_m_s[d].extend(frame.velocities_m_s.iter().map(|velocity| velocity[d]));
        }
        self.degree.extend(&frame.degrees);
        self.level.extend(&frame.levels);
        self.told.extend(&frame.told);
        self.h.extend(frame.levels.iter().map(|level| degree_barrier(*level, self.required_degree)));
        self.phi.extend(&frame.phis);
        self.value.extend(&frame.values);
        self.outcome.extend(&frame.outcomes);
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.degree.len()
    }

    /// The last tick.
    #[must_use]
    pub fn last_tick(&self) -> usize {
        (self.rows() / usize::from(self.robots).max(1)).saturating_sub(1)
    }

    /// Row of robot `index` at `tick`.
    #[must_use]
    pub fn row(&self, tick: usize, index: usize) -> usize {
        tick * usize::from(self.robots) + index
    }

    /// Time of a tick, s.
    #[must_use]
    pub fn time_s(&self, tick: usize) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "ticks are far below 2^53")]
        let ticks = tick as f64;
        ticks * self.tick_s
    }

    /// Position of robot `index` at `tick` in the plane of the first two axes, m.
    #[must_use]
    pub fn point(&self, tick: usize, index: usize) -> [f64; 2] {
        let row = self.row(tick, index);
        core::array::from_fn(|d| self.positions_m[d][row])
    }

    /// A digest of every bit of every column (FNV-1a, 64 bits): equal digests mean equal runs.
    #[must_use]
    pub fn digest(&self) -> u64 {
        let numbers = [&self.level, &self.told, &self.h, &self.phi, &self.value];
        let columns = self.positions_m.iter().chain(&self.inputs_m_s).chain(numbers);
        let bits = columns.flatten().map(|number| number.to_bits());
        let small = self.degree.iter().map(|degree| u64::from(*degree));
        let outcomes = self.outcome.iter().map(|outcome| *outcome as u64);
        bits.chain(small).chain(outcomes).fold(0xcbf2_9ce4_8422_2325, |hash, word| {
            word.to_le_bytes()
                .iter()
                .fold(hash, |hash: u64, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3))
        })
    }
}

/// The word for an outcome in tables and files.
#[must_use]
pub fn outcome_name(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Free => "free",
        Outcome::Active => "active",
        Outcome::Infeasible => "infeasible",
        Outcome::Recovering => "recovering",
    }
}
