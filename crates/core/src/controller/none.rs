//! No controller: the desired velocity, cut to the input box. No program is solved and nothing is promised.

use crate::controller::{AtOnce, Control, Decision, Motion, Neighbor, Own, Standing, View};
use crate::need::Need;
use crate::num::Vector;
use crate::program::{InputBox, Outcome};
use crate::robot::report::{Mode, Reason};
use crate::robot::scratch::Scratch;
use crate::settings::Settings;

/// Lets every desired velocity through that is in the box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unfiltered<const D: usize> {
    need: Need,
    input: InputBox<D>,
}

impl<const D: usize> Unfiltered<D> {
    pub(crate) fn new(settings: &Settings<D>) -> Self {
        Self { need: settings.need_of_neighbors(), input: settings.limits.input }
    }

    fn cut(&self, desired: &Vector<D>) -> Decision<D> {
        let velocity_m_s = self.input.clip(desired);
        Decision { velocity_m_s, outcome: Outcome::Free, phi: None, doubt: None }
    }
}

impl<const D: usize> Control<D> for Unfiltered<D> {
    fn need(&self) -> &Need {
        &self.need
    }

    fn can_be_computed_at_once(&self) -> bool {
        true
    }

    fn alone(&self, _view: &View<'_, D>, desired: &Vector<D>, _scratch: &mut Scratch<'_, D>) -> Decision<D> {
        self.cut(desired)
    }

    fn mode(&self, standing: &Standing) -> Mode {
        let degree_low = standing.degree < standing.need;
        Mode::Degraded(if degree_low { Reason::Degree } else { Reason::Unfiltered })
    }
}

impl<const D: usize> AtOnce<D> for Unfiltered<D> {
    type Pair = ();
    type Told = ();
    type Sums = ();
    type Known = ();

    fn decide<'a>(
        &self,
        _own: &Own,
        (): &(),
        _neighbors: impl Iterator<Item = Neighbor<'a, D, (), ()>> + Clone,
        motion: &Motion<D>,
        _scratch: &mut Scratch<'_, D>,
    ) -> Decision<D> {
        self.cut(&motion.desired_m_s)
    }
}
