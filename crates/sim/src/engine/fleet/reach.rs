//! Whom a robot can meet at all in a tick: in a small team everybody is asked, in a large one those who are near.

use closeranks_core::num::Vector;
use closeranks_core::settings::params::Params;

use crate::geometry::around::Around;
use crate::scenario::Scenario;

/// In teams of up to so many robots messages go to everybody, and who is out of range refuses them. In larger ones that would be
/// most of the work, so they go only to those who may be in range when they arrive.
const ALL_MAX: usize = 128;

/// Whom messages can reach, and whom robots can sense.
#[derive(Clone, Debug)]
pub(super) struct Reach {
    /// Farther than this nobody can be in range when a message arrives, m; `None` where everybody is asked.
    message_m: Option<f64>,
    messages: Around,
    sight: Around,
}

impl Reach {
    /// For the robots of `scenario`, whose radius is R.
    pub(super) fn new<const D: usize>(scenario: &Scenario, params: &Params<D>) -> Self {
        let delay_s = scenario.faults.network.delay_max_s;
        // Both ends may go on until it arrives, and for the tick in which they meet.
        let ticks = (delay_s / scenario.tick_s()).ceil() + 2.0;
        let message_m = params.link().radius_m + 2.0 * ticks * params.reach().longest_m();
        let is_large = usize::from(scenario.team.robots) > ALL_MAX;
        Self {
            message_m: is_large.then_some(message_m),
            messages: Around::default(),
            sight: Around::default(),
        }
    }

    /// True if only those are asked who are near.
    pub(super) fn is_near(&self) -> bool {
        self.message_m.is_some()
    }

    /// Looks where everybody is before messages are sent.
    pub(super) fn look<const D: usize>(&mut self, positions_m: &[Vector<D>]) {
        if let Some(message_m) = self.message_m {
            self.messages.look(positions_m, message_m);
        }
    }

    /// Looks who is within R of whom.
    pub(super) fn look_around<const D: usize>(&mut self, positions_m: &[Vector<D>], radius_m: f64) {
        self.sight.look(positions_m, radius_m);
    }

    /// Those within R of a robot, in order.
    pub(super) fn around(&self, robot: usize) -> &[u16] {
        self.sight.of(robot)
    }

    /// Those whom a message of `sender` can reach, in order, of so many robots.
    pub(super) fn receivers(&self, sender: usize, robots: usize, receivers: &mut Vec<usize>) {
        receivers.clear();
        if self.is_near() {
            receivers.extend(self.messages.of(sender).iter().map(|index| usize::from(*index)));
        } else {
            receivers.extend((0..robots).filter(|index| *index != sender));
        }
    }

    /// Those whom `observer` may sense, or has sensed and may miss (`known`, in order), in order, of so many robots.
    pub(super) fn seen(
        &self,
        observer: usize,
        robots: usize,
        known: impl Iterator<Item = u16>,
        seen: &mut Vec<usize>,
    ) {
        seen.clear();
        if self.is_near() {
            seen.extend(self.around(observer).iter().copied().chain(known).map(usize::from));
            seen.sort_unstable();
            seen.dedup();
        } else {
            seen.extend((0..robots).filter(|index| *index != observer));
        }
    }
}

#[cfg(test)]
mod tests {
    use closeranks_core::robot::neighbor::Slot;

    use crate::attack::liars::Liars;
    use crate::engine::fleet::Fleet;
    use crate::faults::dropouts::Dropouts;
    use crate::faults::network::Network;
    use crate::faults::spell::Spell;
    use crate::faults::{Faults, Sensing};
    use crate::frame::Frame;
    use crate::plant::Bodies;
    use crate::scenario::start::Start;
    use crate::scenario::{Controller, Scenario};
    use crate::world::{initial_values, want};

    /// A team several times as wide as what anybody hears, where messages are late and one robot is not seen.
    fn scenario() -> Scenario {
        let network = Network { delay_min_s: 0.01, delay_max_s: 0.01, ..Network::default() };
        let unseen = Some(Spell { robot: 40, from_s: 0.02, to_s: 0.09 });
        let sensing = Sensing { dropouts: Dropouts { unseen, ..Dropouts::default() }, ..Sensing::default() };
        let mut scenario = Scenario {
            controller: Controller::Links,
            start: Start::Hexagon { spacing_m: 0.8 },
            faults: Faults { network, sensing, ..Faults::default() },
            ..Scenario::default()
        };
        scenario.team.robots = 150;
        scenario.team.faults = 0;
        scenario.malicious.clear();
        scenario
    }

    fn frames(everybody: bool) -> Vec<String> {
        let scenario = scenario();
        let params = scenario.params::<2>().unwrap();
        let values = initial_values(&scenario).unwrap();
        let mut frame = Frame::new(scenario.positions::<2>().unwrap(), values.clone());
        let mut fleet = Fleet::new(&scenario, params, &values).unwrap();
        assert!(fleet.reach.is_near());
        // Slots for all, so that both ways have as many.
        for robot in &mut fleet.robots {
            robot.change_slots(|slots| slots.resize(149, Slot::default()));
        }
        fleet.memory.fit(149);
        if everybody {
            fleet.reach.message_m = None;
        }
        let mut liars = Liars::new(&scenario);
        let mut bodies = Bodies::new(scenario.plant, scenario.tick_s(), &frame.positions_m);
        (0..24)
            .map(|tick| {
                want(&scenario, tick, &mut frame);
                fleet.step(&mut frame, &mut liars);
                bodies.integrate(&mut frame.positions_m, &frame.velocities_m_s);
                format!("{frame:?}")
            })
            .collect()
    }

    /// Delays that are alike for all and one robot unseen need no draws that depend on how many are asked.
    #[test]
    fn who_is_not_asked_would_not_have_been_met() {
        assert!(frames(false) == frames(true), "frames differ");
    }
}
