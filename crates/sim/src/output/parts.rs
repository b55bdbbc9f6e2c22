//! Long runs, recorded part by part: what is held in memory does not grow with the length of the run.

use crate::monitors::robustness::Round;
use crate::output::record::{PART_ROWS, Record};
use crate::output::snapshot::Snapshot;
use crate::scenario::Scenario;
use crate::world::any::AnyWorld;
use crate::world::{Options, Run, RunError};

/// Ticks of a full part of a team of so many robots.
#[must_use]
pub fn part_ticks(robots: u16) -> usize {
    (PART_ROWS / usize::from(robots).max(1)).max(1)
}

/// Takes a part of a run: every tick since the part before, and every consensus round if they were asked for.
pub type TakePart<'a, E> = dyn FnMut(&Record, &[Round]) -> Result<(), E> + 'a;

/// Looks at every tick after it was computed.
pub type Watch<'a, E> = dyn FnMut(&Snapshot<'_>) -> Result<(), E> + 'a;

/// Runs `scenario` from the first tick to the last and hands every full part of the record to `part`, which may end the run
/// with an error. What remains, at least the last tick, is in the run that comes back.
pub fn run<E: From<RunError>>(
    scenario: &Scenario,
    options: Options,
    progress: &mut dyn FnMut(u32),
    part: &mut TakePart<'_, E>,
) -> Result<Run, E> {
    watched(scenario, options, progress, part, &mut |_| Ok(()))
}

/// As [`run`], and `watch` sees every tick; it may end the run with an error too.
pub fn watched<E: From<RunError>>(
    scenario: &Scenario,
    options: Options,
    progress: &mut dyn FnMut(u32),
    part: &mut TakePart<'_, E>,
    watch: &mut Watch<'_, E>,
) -> Result<Run, E> {
    let full = part_ticks(scenario.team.robots);
    let mut world = AnyWorld::new(scenario, options)?;
    while !world.is_over() {
        progress(world.ticks_done());
        let many = world.has_many_rounds();
        if world.record_mut().is_some_and(|record| record.ticks.len() >= full || many) {
            let rounds = world.take_rounds();
            if let Some(record) = world.record_mut() {
                part(record, &rounds)?;
                record.clear();
            }
        }
        world.step();
        if let Some(now) = world.snapshot() {
            watch(&now)?;
        }
    }
    Ok(world.finish())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::World;

    #[test]
    fn parts_are_the_record_of_the_whole_run() {
        let scenario = Scenario { duration_s: 0.03, ..Scenario::default() };
        let options = Options { record: true, ..Options::default() };
        let whole = crate::world::run(&scenario, options, &mut |_| ()).unwrap();
        let mut world = World::<2>::new(&scenario, options).unwrap();
        let mut pieces = Record::new(&scenario, 7);
        while !world.is_over() {
            if let Some(record) = world.record_mut().filter(|record| record.ticks.len() >= 3) {
                (0..3).for_each(|place| pieces.copy(record, place));
                record.clear();
            }
            world.step();
        }
        let rest = world.finish().record.unwrap();
        (0..rest.ticks.len()).for_each(|place| pieces.copy(&rest, place));
        assert_eq!(pieces.ticks, (0..=6).collect::<Vec<u32>>());
        assert_eq!(pieces, Record { ..whole.record.clone().unwrap() });
        let parts =
            run::<RunError>(&scenario, options, &mut |_| (), &mut |_, _| panic!("the run is one part"));
        assert_eq!(parts, Ok(whole));
    }

    #[test]
    fn a_part_that_cannot_be_taken_ends_the_run() {
        let scenario = Scenario { duration_s: 200.0, ..Scenario::default() };
        let options = Options { record: true, ..Options::default() };
        let mut ticks = 0;
        let full = RunError::Dimension(0);
        let run = run(&scenario, options, &mut |tick| ticks = tick, &mut |_, _| Err(full.clone()));
        assert_eq!((run, ticks as usize), (Err(full), part_ticks(11)));
    }

    #[test]
    fn every_round_is_in_one_part() {
        let tick_s = Scenario::default().tick_s();
        let scenario = Scenario { duration_s: 25_000.0 * tick_s, ..Scenario::default() };
        let scenario = scenario.under(crate::scenario::Controller::None);
        let options = Options { record: true, robustness: true, ..Options::default() };
        let (mut parts, mut ticks) = (0, Vec::new());
        let mut part = |_: &Record, rounds: &[Round]| {
            parts += 1;
            ticks.extend(rounds.iter().map(|round| round.tick));
            Ok(())
        };
        let rest = run::<RunError>(&scenario, options, &mut |_| (), &mut part).unwrap();
        ticks.extend(rest.rounds.iter().map(|round| round.tick));
        assert_eq!(parts, 1);
        let every = scenario.ticks_per_round() as usize;
        assert_eq!(ticks, (0..=25_000).step_by(every).collect::<Vec<u32>>());
    }
}
