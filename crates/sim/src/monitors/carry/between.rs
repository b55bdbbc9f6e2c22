//! Distances of robots of different teams, which no team watches alone.

use closeranks_core::settings::params::Params;

use crate::frame::Frame;
use crate::law::Verdicts;
use crate::monitors::carry::before::Before;
use crate::monitors::carry::distance::Distances;
use crate::monitors::truth::Truth;
use crate::scenario::Scenario;

/// Watches the pairs of robots of different teams. The frames that it looks at have all robots, one team after another.
#[derive(Clone, Debug)]
pub(crate) struct Between<const D: usize> {
    params: Params<D>,
    distances: Distances<D>,
    before: Option<Before<D>>,
    verdicts: Verdicts,
}

impl<const D: usize> Between<D> {
    /// For all robots of `scenario`, of which each is of one of `teams`. `gamma_c` is the largest of all teams; `free` says whether
    /// malicious robots move as they like.
    //= theory sec:strangers
    pub(crate) fn new(
        scenario: &Scenario,
        params: Params<D>,
        teams: Vec<usize>,
        gamma_c: f64,
        free: bool,
    ) -> Self {
        let distances = Distances::between(scenario, params, teams, (gamma_c, free));
        Self { params, distances, before: None, verdicts: Verdicts::default() }
    }

    /// What became of the laws about distances.
    pub(crate) fn verdicts(&self) -> &Verdicts {
        &self.verdicts
    }

    /// The least squared distance yet, m².
    pub(crate) fn least_m2(&self) -> f64 {
        self.distances.least_m2()
    }

    /// Looks at one tick of all teams.
    pub(crate) fn watch(&mut self, tick: u32, frame: &Frame<D>) {
        let mut truth = Truth::default();
        truth.measure(&self.params, frame);
        let before = self.before.take();
        self.distances.find(before.as_ref(), &truth);
        let carried = before.as_ref().filter(|_| !frame.assumptions.renewed);
        self.distances.watch(tick, frame, &truth, carried, &mut self.verdicts);
        let (moved, moves) = (before.as_ref().is_some_and(|before| before.moves), !frame.assumptions.broken);
        self.distances.carry(&truth, moved, self.params.controller().promises(), moves);
        let mut now = before.unwrap_or_default();
        now.positions_m.clone_from(&frame.positions_m);
        (now.truth, now.moves) = (truth, moves);
        self.before = Some(now);
    }
}
