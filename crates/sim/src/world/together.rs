//! Runs of many scenarios, those of them side by side that are alike in all that lanes share.

use closeranks_core::settings::params::Params;

use crate::engine::dense::DENSE_MAX;
use crate::engine::lanes::Lanes;
use crate::scenario::Scenario;
use crate::world::block::Block;
use crate::world::{Options, Run};

/// The runs of those `scenarios` that go side by side, each with the bits that it has alone; `None` for all others, which whoever asks may
/// run one by one. Scenarios may differ in seed, start, wishes, values, lies and bodies, not in team, parameters and ticks.
#[must_use]
pub fn together(scenarios: &[&Scenario], options: Options) -> Vec<Option<Run>> {
    let mut runs: Vec<Option<Run>> = scenarios.iter().map(|_| None).collect();
    if options.record || options.robustness {
        return runs;
    }
    for places in alike(scenarios) {
        for places in places.chunks(Block::MOST) {
            let group: Vec<&Scenario> = places.iter().map(|place| scenarios[*place]).collect();
            for (place, run) in places.iter().zip(side_by_side(&group, options).unwrap_or_default()) {
                runs[*place] = Some(run);
            }
        }
    }
    runs
}

/// `None` if they do not go side by side, or one of them cannot be run.
fn side_by_side(scenarios: &[&Scenario], options: Options) -> Option<Vec<Run>> {
    if scenarios.len() < Block::WORTH_IT {
        return None;
    }
    let block = Block::of_runs(scenarios, options).ok()?;
    block.is_in_lanes().then(|| block.run())
}

/// What all worlds of a block have in common.
#[derive(PartialEq)]
enum Shape {
    Plane(Params<2>),
    Space(Params<3>),
}

impl Shape {
    /// Of a world of `scenario`; `None` if it is plain from the scenario that it goes alone.
    fn of(scenario: &Scenario) -> Option<Self> {
        if usize::from(scenario.team.robots) > DENSE_MAX || !scenario.teams.is_empty() {
            return None;
        }
        match scenario.dimension {
            2 => in_lanes(scenario).map(Self::Plane),
            3 => in_lanes(scenario).map(Self::Space),
            _ => None,
        }
    }
}

/// The parameters of a team whose controller can be computed so.
fn in_lanes<const D: usize>(scenario: &Scenario) -> Option<Params<D>> {
    scenario.params().ok().filter(|params: &Params<D>| Lanes::are_for(params))
}

/// Places of scenarios that may share a block.
fn alike(scenarios: &[&Scenario]) -> Vec<Vec<usize>> {
    let mut groups: Vec<(Shape, Vec<usize>)> = Vec::new();
    for (place, scenario) in scenarios.iter().enumerate() {
        let Some(shape) = Shape::of(scenario) else { continue };
        let same = |(other, places): &&mut (Shape, Vec<usize>)| {
            let first = scenarios[places[0]];
            let same = first.malicious == scenario.malicious && first.ticks() == scenario.ticks();
            // Robots may not use the paper's composition, and it is looked at all the same.
            *other == shape && same && first.composition() == scenario.composition()
        };
        match groups.iter_mut().find(same) {
            Some((_, places)) => places.push(place),
            None => groups.push((shape, vec![place])),
        }
    }
    groups.into_iter().map(|(_, places)| places).collect()
}
