//! What a run leaves behind: one row a tick and robot, in columns.

use closeranks_core::program::Outcome;

use crate::output::snapshot::Snapshot;
use crate::scenario::Scenario;

/// Rows (ticks × robots) of a part of a long run at most, unless a single tick has more.
pub const PART_ROWS: usize = 1 << 18;

/// Columns of a run, or of a part of one. Row `place·n + index` belongs to robot `index + 1` at the tick `ticks[place]`. In the
/// record of a whole run ticks go from 0 to the last, both included, and each is its own place.
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
    /// The tick of every place, ascending.
    pub ticks: Vec<u32>,
    /// One column a dimension, m.
    pub positions_m: Vec<Vec<f64>>,
    /// One column a dimension, m/s: the input held from this tick on. Rows of the last tick hold what would come next.
    pub inputs_m_s: Vec<Vec<f64>>,
    /// δ_i as it is.
    pub degree: Vec<u16>,
    /// c_i as it is.
    pub level: Vec<f64>,
    /// c_i as told; NaN of a robot that is down, and of one that does not tell all the same.
    pub told: Vec<f64>,
    /// h_i as it is: the level less F′.
    pub h: Vec<f64>,
    /// φ_i; NaN of a robot that is down.
    pub phi: Vec<f64>,
    /// y_i as the robot holds it.
    pub value: Vec<f64>,
    /// y_i as told; NaN as for `told`.
    pub value_told: Vec<f64>,
    /// Further numbers of values of several, one column a number: as in `value`.
    pub more_values: Vec<Vec<f64>>,
    /// As in `value_told`.
    pub more_values_told: Vec<Vec<f64>>,
    /// δ_i and c_i as the robot senses them; NaN of a robot that is down.
    pub degree_sensed: Vec<f64>,
    /// See `degree_sensed`.
    pub level_sensed: Vec<f64>,
    /// What the program found.
    pub outcome: Vec<Outcome>,
}

impl Record {
    /// An empty record with room for the whole run, or for a part of it if the run is long.
    #[must_use]
    pub fn new(scenario: &Scenario, required_degree: u16) -> Self {
        let rows = (scenario.ticks() as usize + 1) * usize::from(scenario.team.robots);
        let rows = rows.min(PART_ROWS);
        let column = || Vec::with_capacity(rows);
        Self {
            robots: scenario.team.robots,
            required_degree,
            dimension: scenario.dimension,
            tick_s: scenario.tick_s(),
            malicious: scenario.malicious_mask(),
            ticks: Vec::new(),
            positions_m: vec![column(); scenario.dimension],
            inputs_m_s: vec![column(); scenario.dimension],
            degree: Vec::with_capacity(rows),
            level: column(),
            told: column(),
            h: column(),
            phi: column(),
            value: column(),
            value_told: column(),
            more_values: vec![column(); scenario.consensus.dimension.saturating_sub(1)],
            more_values_told: vec![column(); scenario.consensus.dimension.saturating_sub(1)],
            degree_sensed: column(),
            level_sensed: column(),
            outcome: Vec::with_capacity(rows),
        }
    }

    /// Adds a tick.
    pub(crate) fn push(&mut self, now: &Snapshot<'_>) {
        self.ticks.push(now.tick);
        for d in 0..now.dimension {
            self.positions_m[d].extend(now.axis(now.positions_m, d));
            self.inputs_m_s[d].extend(now.axis(now.inputs_m_s, d));
        }
        self.degree.extend(now.degree);
        self.level.extend(now.level);
        self.phi.extend(now.phi);
        self.value.extend(now.value);
        for index in 0..now.robots() {
            self.h.push(now.h(index));
            self.told.push(now.told(index));
            self.value_told.push(now.value_told(index));
            self.degree_sensed.push(now.degree_sensed(index));
            self.level_sensed.push(now.level_sensed(index));
        }
        self.outcome.extend(now.outcome);
        for (place, column) in self.more_values.iter_mut().enumerate() {
            column.extend(&now.more_values[place]);
        }
        for (place, column) in self.more_values_told.iter_mut().enumerate() {
            column.extend((0..now.robots()).map(|index| now.more_value_told(place, index)));
        }
    }

    /// Adds what `other`, a record of the same team, has at `place`.
    pub fn copy(&mut self, other: &Self, place: usize) {
        let rows = other.row(place, 0)..other.row(place + 1, 0);
        self.ticks.push(other.ticks[place]);
        for (column, from) in self.numbers_mut().into_iter().zip(other.numbers()) {
            column.extend_from_slice(&from[rows.clone()]);
        }
        self.degree.extend_from_slice(&other.degree[rows.clone()]);
        self.outcome.extend_from_slice(&other.outcome[rows]);
    }

    /// Forgets all ticks and keeps the room for others.
    pub fn clear(&mut self) {
        self.ticks.clear();
        self.numbers_mut().into_iter().for_each(Vec::clear);
        self.degree.clear();
        self.outcome.clear();
    }

    /// Every column of numbers: positions, inputs, and then those that each robot has one of.
    #[must_use]
    pub fn numbers(&self) -> Vec<&Vec<f64>> {
        let told = [&self.told, &self.value_told];
        let single = [&self.level, &self.h, &self.phi, &self.value, &self.degree_sensed, &self.level_sensed];
        let more = self.more_values.iter().chain(&self.more_values_told);
        self.positions_m.iter().chain(&self.inputs_m_s).chain(single).chain(told).chain(more).collect()
    }

    /// Every column of numbers, in the order of [`Record::numbers`].
    pub fn numbers_mut(&mut self) -> Vec<&mut Vec<f64>> {
        let told = [&mut self.told, &mut self.value_told];
        let single = [&mut self.level, &mut self.h, &mut self.phi, &mut self.value];
        let sensed = [&mut self.degree_sensed, &mut self.level_sensed];
        let vectors = self.positions_m.iter_mut().chain(&mut self.inputs_m_s);
        let more = self.more_values.iter_mut().chain(&mut self.more_values_told);
        vectors.chain(single).chain(sensed).chain(told).chain(more).collect()
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.degree.len()
    }

    /// The place of the last tick; in the record of a whole run that tick itself.
    #[must_use]
    pub fn last_tick(&self) -> usize {
        (self.rows() / usize::from(self.robots).max(1)).saturating_sub(1)
    }

    /// Row of robot `index` at `place`.
    #[must_use]
    pub fn row(&self, place: usize, index: usize) -> usize {
        place * usize::from(self.robots) + index
    }

    /// Time of the tick at `place`, s; 0 where there is none.
    #[must_use]
    pub fn time_s(&self, place: usize) -> f64 {
        self.ticks.get(place).map_or(0.0, |tick| f64::from(*tick) * self.tick_s)
    }

    /// Position of robot `index` at `place` in the plane of the first two axes, m.
    #[must_use]
    pub fn point(&self, place: usize, index: usize) -> [f64; 2] {
        let row = self.row(place, index);
        core::array::from_fn(|d| self.positions_m[d][row])
    }

    /// A digest of every bit of the state and of what was told (FNV-1a, 64 bits): equal digests mean equal runs.
    #[must_use]
    pub fn digest(&self) -> u64 {
        let vectors = self.positions_m.iter().chain(&self.inputs_m_s);
        let single = [&self.level, &self.told, &self.h, &self.phi, &self.value_told];
        let bits =
            vectors.chain(single).chain(&self.more_values_told).flatten().map(|number| number.to_bits());
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
