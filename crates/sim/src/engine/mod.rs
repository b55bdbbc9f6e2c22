//! What computes the robots of a tick: one by one, or all at once with the same bits.
//!
//! | engine | computes |
//! | --- | --- |
//! | [`team`] | controllers whose decisions rest on levels and links alone |
//! | `lanes` | teams of many worlds under `composed` side by side ([`crate::world::block`]) |
//! | [`held`] | `links`, whose robots keep lists from tick to tick |
//! | [`fleet`] | everything, robot by robot; where everybody hears the same they hand over what they tell, else it goes as bytes |

mod bench;
mod consensus;
pub(crate) mod dense;
pub mod fleet;
pub mod held;
pub(crate) mod judge;
pub(crate) mod lanes;
mod links;
mod marks;
pub mod memory;
pub(crate) mod phi;
pub(crate) mod robots;
mod roster;
mod sees;
pub mod team;
pub mod workers;

use closeranks_core::controller::{AtOnce, WithAtOnce};
use closeranks_core::robot::error::RobotError;
use closeranks_core::settings::params::Params;

use crate::engine::fleet::Fleet;
use crate::engine::held::Held;
use crate::engine::robots::Robots;
use crate::engine::team::Team;
use crate::frame::Frame;
use crate::scenario::Scenario;

/// How robots are computed; both give the same bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Engine {
    /// All at once ([`team`], [`held`]). A world in which something goes wrong, free liars under `budget`, stated errors, and robots
    /// far from the origin run one by one all the same.
    #[default]
    Team,
    /// One by one, with every message as bytes ([`fleet`]).
    Robots,
}

/// What computes the robots of a run: all at once where the world is perfect and the controller can, else one by one.
pub(crate) fn robots<const D: usize>(
    scenario: &Scenario,
    params: Params<D>,
    frame: &Frame<D>,
    values: &[f64],
    engine: Engine,
) -> Result<Box<dyn Robots<D>>, RobotError> {
    let controller = *params.controller();
    let steady = !controller.promises() || is_near(scenario, &params, frame);
    let heard_alike = scenario.faults.is_none() && scenario.attack.is_alike_for_all(controller.tells_lists());
    if engine == Engine::Robots || !heard_alike || scenario.obstacles.cut_links() {
        return Ok(Box::new(Fleet::new(scenario, params, values)?));
    }
    if scenario.is_plain() && steady {
        if let Some(controller) = controller.lists().filter(|_| Held::covers(&params)) {
            return Ok(Box::new(Held::new(scenario, params, controller, values)));
        }
        if let Some(team) = controller.at_once(MakeTeam { scenario, params, values }) {
            return Ok(team);
        }
    }
    Ok(Box::new(Fleet::at_once(scenario, params, values)?))
}

/// Makes a team under whichever controller it is.
struct MakeTeam<'a, const D: usize> {
    scenario: &'a Scenario,
    params: Params<D>,
    values: &'a [f64],
}

impl<const D: usize> WithAtOnce<D> for MakeTeam<'_, D> {
    type Output = Box<dyn Robots<D>>;

    fn with<C: AtOnce<D> + Copy + Send + Sync + 'static>(self, controller: C) -> Self::Output {
        Box::new(Team::new(self.scenario, self.params, controller, self.values))
    }
}

/// Positions are rounded to far less than what a robot takes for a jump as long as they are nearer to 0 than this, m.
const NEAR_M: f64 = 1e5;

/// True if rounding never looks like a jump to a robot that watches where its moves take it.
fn is_near<const D: usize>(scenario: &Scenario, params: &Params<D>, frame: &Frame<D>) -> bool {
    let way_m = f64::from(scenario.ticks()) * params.reach().longest_m();
    frame.positions_m.iter().flatten().all(|x| x.abs() + way_m < NEAR_M)
}
