//! Worlds that are stepped together, side by side in lanes where the engine of their controller can, with the bits of each alone.

use closeranks_core::num::lane::LANES;

use crate::engine::lanes::Lanes;
use crate::monitors::glance::Glance;
use crate::scenario::Scenario;
use crate::world::any::{AnyGiven, AnyWorld};
use crate::world::given::GivenError;
use crate::world::{Options, Run, RunError, World};

/// Up to [`Block::MOST`] worlds of one scenario that differ in their seeds. They keep no record, and a summary only where whole runs are
/// asked for, else what a tick came to and what became of the laws.
pub struct Block {
    worlds: Vec<AnyWorld>,
    summaries: bool,
    lanes: Option<AnyLanes>,
}

/// Lanes of whichever dimension.
enum AnyLanes {
    Plane(Lanes<2>),
    Space(Lanes<3>),
}

impl AnyLanes {
    fn glance(&self, lane: usize) -> Option<Glance<'_>> {
        match self {
            Self::Plane(lanes) => lanes.glance(lane),
            Self::Space(lanes) => lanes.glance(lane),
        }
    }

    fn knows_phi(&self, lane: usize) -> bool {
        match self {
            Self::Plane(lanes) => lanes.knows_phi(lane),
            Self::Space(lanes) => lanes.knows_phi(lane),
        }
    }
}

impl Block {
    /// How many worlds a block has at most.
    pub const MOST: usize = LANES;

    /// So many worlds at least are worth the lanes of those that are not there.
    pub(crate) const WORTH_IT: usize = 6;

    /// The worlds of `scenario` with these seeds before their first tick; of more than [`MOST`](Self::MOST) seeds the rest is left out.
    pub fn new(scenario: &Scenario, seeds: &[u64], options: Options) -> Result<Self, RunError> {
        if !scenario.teams.is_empty() {
            return Err(RunError::Teams);
        }
        let of = |seed: &u64| AnyWorld::new(&Scenario { seed: *seed, ..scenario.clone() }, options);
        let worlds: Result<Vec<AnyWorld>, RunError> = seeds.iter().take(Self::MOST).map(of).collect();
        Ok(Self::of_worlds(worlds?, false))
    }

    /// Whole runs of up to [`MOST`](Self::MOST) scenarios that are alike in all that lanes share.
    pub(super) fn of_runs(scenarios: &[&Scenario], options: Options) -> Result<Self, RunError> {
        let worlds = scenarios.iter().map(|scenario| AnyWorld::new(scenario, options));
        let worlds: Result<Vec<AnyWorld>, RunError> = worlds.collect();
        Ok(Self::of_worlds(worlds?, true))
    }

    fn of_worlds(mut worlds: Vec<AnyWorld>, summaries: bool) -> Self {
        let all = worlds.len() >= Self::WORTH_IT && worlds.iter_mut().all(AnyWorld::goes_in_lanes);
        let lanes = worlds.first().filter(|_| all).and_then(|world| match world {
            AnyWorld::Plane(world) => world.lanes().map(AnyLanes::Plane),
            AnyWorld::Space(world) => world.lanes().map(AnyLanes::Space),
            AnyWorld::PlaneTeams(_) | AnyWorld::SpaceTeams(_) => None,
        });
        Self { worlds, summaries, lanes }
    }

    /// A world for each of any number of seeds: in blocks where they are computed side by side, else each on its own, so that they can be
    /// spread over cores.
    pub fn of_all(scenario: &Scenario, seeds: &[u64], options: Options) -> Result<Vec<Self>, RunError> {
        let mut blocks = Vec::new();
        for seeds in seeds.chunks(Self::MOST) {
            let block = Self::new(scenario, seeds, options)?;
            if block.is_in_lanes() {
                blocks.push(block);
            } else {
                blocks.extend(block.worlds.into_iter().map(|world| Self::of_worlds(vec![world], false)));
            }
        }
        Ok(blocks)
    }

    /// The worlds in order of their seeds.
    #[must_use]
    pub fn worlds(&self) -> &[AnyWorld] {
        &self.worlds
    }

    /// True if they are computed side by side.
    #[must_use]
    pub fn is_in_lanes(&self) -> bool {
        self.lanes.is_some()
    }

    /// Moves robots to where the next tick finds them, as [`World::prepare`] does.
    pub fn prepare(&mut self) {
        self.worlds.iter_mut().for_each(AnyWorld::prepare);
    }

    /// Computes the next tick of every world with what is `given` to each; refused as [`World::step_with`] does, before any world is
    /// stepped. To be called with as many as there are worlds.
    pub fn step_with(&mut self, given: &[AnyGiven<'_>]) -> Result<(), GivenError> {
        for (world, given) in self.worlds.iter().zip(given) {
            world.check(given)?;
        }
        for (world, given) in self.worlds.iter_mut().zip(given) {
            world.begin_with(given)?;
        }
        self.compute();
        Ok(())
    }

    /// Computes a tick that has begun.
    fn compute(&mut self) {
        match &mut self.lanes {
            Some(AnyLanes::Plane(lanes)) => step(lanes, self.worlds.iter_mut().filter_map(AnyWorld::plane)),
            Some(AnyLanes::Space(lanes)) => step(lanes, self.worlds.iter_mut().filter_map(AnyWorld::space)),
            None => self.worlds.iter_mut().for_each(AnyWorld::compute),
        }
        for (lane, world) in self.worlds.iter_mut().enumerate() {
            let glance = self.lanes.as_ref().and_then(|lanes| lanes.glance(lane));
            let knows_phi = self.lanes.as_ref().is_some_and(|lanes| lanes.knows_phi(lane));
            world.settle(knows_phi, glance.as_ref());
            if self.summaries {
                world.collect();
            }
        }
    }

    /// Runs all to the end. All have the same number of ticks.
    pub(super) fn run(mut self) -> Vec<Run> {
        while !self.worlds.iter().any(AnyWorld::is_over) {
            self.worlds.iter_mut().for_each(AnyWorld::begin);
            self.compute();
        }
        self.worlds.into_iter().map(AnyWorld::finish).collect()
    }

    /// Computes so many ticks, all with what is `given` but none after the last one, and leaves robots where the next tick finds them.
    pub fn advance(&mut self, given: &[AnyGiven<'_>], ticks: u32) -> Result<(), GivenError> {
        for _ in 0..ticks {
            if self.worlds.iter().any(AnyWorld::is_over) {
                break;
            }
            self.step_with(given)?;
        }
        if !self.worlds.iter().any(AnyWorld::is_over) {
            self.prepare();
        }
        Ok(())
    }
}

fn step<'a, const D: usize>(lanes: &mut Lanes<D>, worlds: impl Iterator<Item = &'a mut World<D>>) {
    match lanes {
        Lanes::Composed(lanes) => lanes.step(&mut worlds.filter_map(World::in_lane).collect::<Vec<_>>()),
        Lanes::Held(lanes) => lanes.step(&mut worlds.filter_map(World::held_in_lane).collect::<Vec<_>>()),
    }
}
