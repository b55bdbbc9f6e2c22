//! One tick of a team as whoever watches a run sees it, in however many dimensions.

use closeranks_core::equations::barrier::degree_barrier;
use closeranks_core::program::Outcome;
use closeranks_core::robot::report::Mode;

use crate::frame::Frame;
use crate::monitors::truth::Truth;

/// A tick that was computed. Index 0 is robot 1; vectors are flat, one robot after another, one number a dimension.
#[derive(Clone, Copy, Debug)]
pub struct Snapshot<'a> {
    /// Which tick, from 0.
    pub tick: u32,
    /// Its time, s.
    pub time_s: f64,
    /// D.
    pub dimension: usize,
    /// F′.
    pub required_degree: u16,
    /// x_i, m.
    pub positions_m: &'a [f64],
    /// What robots are asked for, m/s.
    pub asked_m_s: &'a [f64],
    /// u_i, m/s, held from this tick on.
    pub inputs_m_s: &'a [f64],
    /// δ_i as it is.
    pub degree: &'a [u16],
    /// c_i as it is.
    pub level: &'a [f64],
    /// φ_i; NaN of a robot that is down.
    pub phi: &'a [f64],
    /// y_i as the robot holds it.
    pub value: &'a [f64],
    /// Further numbers of values of several, one list a number.
    pub more_values: &'a [Vec<f64>],
    /// What the program found.
    pub outcome: &'a [Outcome],
    /// What each robot says its answer is worth.
    pub modes: &'a [Mode],
    /// Robots that do not run in this tick.
    pub down: &'a [bool],
    told: Told<'a>,
    /// F′ of each robot where teams differ; else empty.
    required: &'a [u16],
}

/// What robots tell and sense; read through methods, because not every robot does.
#[derive(Clone, Copy, Debug)]
struct Told<'a> {
    levels: &'a [f64],
    values: &'a [f64],
    more_values: &'a [Vec<f64>],
    one_level: &'a [bool],
    one_value: &'a [bool],
    degrees_sensed: &'a [u16],
    levels_sensed: &'a [f64],
}

impl<'a> Snapshot<'a> {
    /// The tick `tick` of which `truth` is the state as it is.
    pub(crate) fn new<const D: usize>(
        tick: u32,
        tick_s: f64,
        required_degree: u16,
        frame: &'a Frame<D>,
        truth: &'a Truth,
    ) -> Self {
        Self {
            tick,
            time_s: f64::from(tick) * tick_s,
            dimension: D,
            required_degree,
            positions_m: frame.positions_m.as_flattened(),
            asked_m_s: frame.asked_m_s.as_flattened(),
            inputs_m_s: frame.velocities_m_s.as_flattened(),
            degree: &truth.neighbors,
            level: &truth.levels,
            phi: &frame.phis,
            value: &frame.held,
            more_values: &frame.more_held,
            outcome: &frame.outcomes,
            modes: &frame.modes,
            down: &frame.down,
            required: &[],
            told: Told {
                levels: &frame.told,
                values: &frame.values,
                more_values: &frame.more_values,
                one_level: &frame.one_level,
                one_value: &frame.one_value,
                degrees_sensed: &frame.degrees,
                levels_sensed: &frame.levels,
            },
        }
    }

    /// The same of several teams, where each robot has an F′ of its own.
    pub(crate) fn of_teams(self, required: &'a [u16]) -> Self {
        Self { required, ..self }
    }

    /// n.
    #[must_use]
    pub fn robots(&self) -> usize {
        self.degree.len()
    }

    /// Component `axis` of every position, or of another flat column.
    pub fn axis(&self, flat: &'a [f64], axis: usize) -> impl Iterator<Item = f64> + use<'a> {
        flat.iter().skip(axis).step_by(self.dimension.max(1)).copied()
    }

    /// A flat vector of robot `index` with three components, of which those that are not there are 0.
    #[must_use]
    pub fn vector(&self, flat: &[f64], index: usize) -> [f64; 3] {
        let start = index * self.dimension;
        core::array::from_fn(|axis| {
            if axis < self.dimension { flat.get(start + axis).copied().unwrap_or(f64::NAN) } else { 0.0 }
        })
    }

    /// h_i as it is: the level less F′.
    #[must_use]
    pub fn h(&self, index: usize) -> f64 {
        let required = self.required.get(index).copied().unwrap_or(self.required_degree);
        degree_barrier(self.level[index], required)
    }

    /// c_i as told; NaN of a robot that is down, and of one that does not tell all the same.
    #[must_use]
    pub fn told(&self, index: usize) -> f64 {
        self.known(index, self.told.levels[index], self.told.one_level[index])
    }

    /// y_i as told; NaN as for [`told`](Self::told).
    #[must_use]
    pub fn value_told(&self, index: usize) -> f64 {
        self.known(index, self.told.values[index], self.told.one_value[index])
    }

    /// Number `place` beyond the first of y_i as told; NaN as for [`told`](Self::told).
    #[must_use]
    pub fn more_value_told(&self, place: usize, index: usize) -> f64 {
        self.known(index, self.told.more_values[place][index], self.told.one_value[index])
    }

    /// δ_i as the robot senses it; NaN of a robot that is down.
    #[must_use]
    pub fn degree_sensed(&self, index: usize) -> f64 {
        self.known(index, f64::from(self.told.degrees_sensed[index]), true)
    }

    /// c_i as the robot senses it; NaN of a robot that is down.
    #[must_use]
    pub fn level_sensed(&self, index: usize) -> f64 {
        self.known(index, self.told.levels_sensed[index], true)
    }

    fn known(&self, index: usize, number: f64, known: bool) -> f64 {
        if known && !self.down[index] { number } else { f64::NAN }
    }
}
