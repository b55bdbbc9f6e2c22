//! Which assumptions of the theorem hold in a tick, as only the world can know.

use closeranks_core::settings::params::Params;

use crate::attack::MotionAttack;
use crate::engine::robots::{Counted, Robots};
use crate::faults::edges::Edges;
use crate::frame::{Frame, Presence, nowhere};
use crate::geometry::squared_distance;
use crate::plant::Bodies;
use crate::scenario::Scenario;

/// The rounding of a position is smaller than this, m, and the same as a fraction of Δ_d: a millimetre may be all there is.
const STILL_M: f64 = 1e-13;
const STILL: f64 = 1e-12;
/// The rounding of a squared distance, as a fraction of it, is smaller than this.
const ROUNDING: f64 = 1e-9;

/// Fills the references and the [`Assumptions`](crate::frame::Assumptions) of every frame of a run.
#[derive(Clone, Debug)]
pub(crate) struct Judge {
    malicious: Vec<bool>,
    /// Liars move as they like although the controller assumes that they obey.
    disobeyed: bool,
    /// Stated bound of the distance between a robot and its reference, m. Only `budget` has room for one.
    away_m: f64,
    position_error_m: f64,
    /// Who is no farther from where it should be than this, m, is there.
    still_m: f64,
}

impl Judge {
    /// For the robots of `scenario`.
    pub(crate) fn new<const D: usize>(scenario: &Scenario, params: &Params<D>) -> Self {
        let obedient = params.controller().is_obeyed();
        let disobedient = scenario.attack.motion != MotionAttack::Obedient && !scenario.malicious.is_empty();
        Self {
            malicious: scenario.malicious_mask(),
            disobeyed: obedient && disobedient,
            away_m: params.kept().errors.away_m,
            position_error_m: params.settings().errors.position_m,
            still_m: STILL_M.min(STILL * params.settings().limits.distance_min_m),
        }
    }

    /// Fills references and assumptions of `frame`, whose robots ticked and did not move yet.
    pub(crate) fn judge<const D: usize>(
        &self,
        frame: &mut Frame<D>,
        robots: &dyn Robots<D>,
        bodies: &Bodies<D>,
    ) {
        self.refer(frame, robots, bodies);
        let edges = robots.edges();
        frame.assumptions.unsteady = edges.is_some_and(|edges| self.is_unsteady(edges, &frame.presence));
        let mut misplaced = edges.is_some_and(|edges| edges.downtime.blind()) || self.is_away(frame, bodies);
        let silent = Some(&frame.presence.unannounced[..]).filter(|silent| silent.contains(&true));
        for (index, wrong) in frame.assumptions.sensed_wrong.iter_mut().enumerate() {
            *wrong = edges.is_some_and(|edges| {
                let off = edges.senses.error_m(index) > self.position_error_m + self.still_m;
                misplaced |= off;
                off || edges.sight.overlooks(index)
            });
            // Nobody can know of a robot that left silently that it is not where it was.
            *wrong |= silent.is_some_and(|silent| robots.reckons_unseen(index, silent));
        }
        for (index, unsensed) in frame.assumptions.unsensed.iter_mut().enumerate() {
            *unsensed = edges.is_some_and(|edges| edges.sight.misses(index));
        }
        frame.assumptions.misplaced = misplaced || frame.assumptions.renewed;
        frame.assumptions.broken =
            self.disobeyed || frame.assumptions.misplaced || frame.assumptions.sensed_wrong.contains(&true);
    }

    /// Takes over where robots count themselves. A robot that is down stays where its velocities have taken it.
    fn refer<const D: usize>(&self, frame: &mut Frame<D>, robots: &dyn Robots<D>, bodies: &Bodies<D>) {
        frame.assumptions.renewed = false;
        if self.away_m == 0.0 {
            return frame.references_m.clone_from_slice(&frame.positions_m);
        }
        for (index, reference) in frame.references_m.iter_mut().enumerate() {
            if frame.presence.absent[index] {
                *reference = nowhere();
                continue;
            }
            let counted = robots.counted(index);
            let anew = counted.as_ref().is_none_or(|counted| counted.began_anew);
            frame.assumptions.renewed |= anew && !frame.presence.arrived[index];
            *reference = match counted {
                Some(Counted { place_m, .. }) => place_m,
                None => bodies.references_m(&frame.positions_m)[index],
            };
        }
    }

    /// True if some normal robot does not run, or begins anew.
    fn is_unsteady<const D: usize>(&self, edges: &Edges<D>, presence: &Presence) -> bool {
        let there = |index: &usize| !self.malicious[*index] && !presence.absent[*index];
        let downtime = &edges.downtime;
        (0..self.malicious.len()).filter(there).any(|index| downtime.down(index) || downtime.reborn(index))
    }

    /// True if some robot is farther from its reference than is stated.
    fn is_away<const D: usize>(&self, frame: &Frame<D>, bodies: &Bodies<D>) -> bool {
        if self.away_m == 0.0 {
            return bodies.away_m(&frame.positions_m) > self.still_m;
        }
        let away = frame.references_m.iter().zip(&frame.positions_m);
        let limit_m2 = self.away_m * self.away_m * (1.0 + ROUNDING);
        away.map(|(x, y)| squared_distance(x, y)).any(|away_m2| away_m2 > limit_m2)
    }
}
