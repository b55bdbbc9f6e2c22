//! A world as one of many that are computed side by side.

use crate::engine::held::Held;
use crate::engine::lanes::composed::Lent;
use crate::engine::lanes::{InLane, Lanes};
use crate::world::World;

impl<const D: usize> World<D> {
    /// True if its team is computed side by side with others.
    pub(crate) fn goes_in_lanes(&mut self) -> bool {
        let lends = self.robots.lend().is_some() || self.robots.lend_held().is_some();
        lends && self.scenario.absences.is_empty()
    }

    /// Its team for an engine that computes many side by side; `None` if it is not of the kind that is computed so.
    pub(crate) fn in_lane(&mut self) -> Option<InLane<'_, D, Lent<'_>>> {
        let team = self.robots.lend()?;
        Some(InLane { frame: &mut self.frame, liars: &mut self.liars, team })
    }

    /// The same of a team of held links.
    pub(crate) fn held_in_lane(&mut self) -> Option<InLane<'_, D, &mut Held<D>>> {
        let team = self.robots.lend_held()?;
        Some(InLane { frame: &mut self.frame, liars: &mut self.liars, team })
    }

    /// That engine, for worlds like this one.
    pub(crate) fn lanes(&self) -> Option<Lanes<D>> {
        Lanes::new(&self.scenario, &self.params)
    }
}
