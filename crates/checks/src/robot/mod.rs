//! Any order of calls to a robot, with any numbers. The bytes are a small program: settings, memory, then calls.

mod answer;
mod calls;
mod settings;

use closeranks_core::controller::budget::knowledge::Sighting;
use closeranks_core::message::VALUE_MAX;
use closeranks_core::program::balls::row::Row;
use closeranks_core::robot::Robot;
use closeranks_core::robot::error::RobotError;
use closeranks_core::robot::neighbor::{RobotId, Slot};
use closeranks_core::robot::scratch::{Needs, Scratch};
use closeranks_core::settings::params::Params;

use crate::source::Source;
use calls::Play;

/// The robot's own number, in the middle of the others where there are so many.
const ME: u16 = 5;

/// Any calls with any numbers give answers that are finite and in their box, and modes that do not promise too much.
pub fn robot(bytes: &[u8]) {
    let mut source = Source(bytes);
    if source.byte() & 1 == 0 { live::<2>(&mut source) } else { live::<3>(&mut source) }
}

fn live<const D: usize>(source: &mut Source<'_>) {
    match Params::new(settings::settings::<D>(source)) {
        Ok(params) => play(params, source),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// Lends 0 to 12 slots and, once in a while, too little of the rest, which is refused; then plays the calls to the end of the
/// bytes.
fn play<const D: usize>(params: Params<D>, source: &mut Source<'_>) {
    let slots = source.below(13);
    let short = |source: &mut Source<'_>, enough: usize| match source.byte() {
        0..=15 => enough.saturating_sub(1),
        16..=31 => source.below(enough + 1),
        _ => enough,
    };
    let needs = Needs::new(&params, slots);
    let mut values = vec![0.0; short(source, needs.values)];
    let mut sightings = vec![Sighting::NOBODY; short(source, needs.sightings)];
    let mut rows = vec![Row::default(); short(source, needs.rows)];
    let given = Needs { values: values.len(), sightings: sightings.len(), rows: rows.len() };
    let value = if source.byte() < 240 { source.near() } else { source.number() };
    let own = RobotId(ME.min(params.settings().team.robots));
    let scratch = match Scratch::new(&params, slots, &mut values, &mut sightings, &mut rows) {
        Ok(scratch) => scratch,
        Err(error) => return assert!(error == RobotError::Scratch(needs) && given != needs),
    };
    let fits = value.abs() <= VALUE_MAX;
    match Robot::new(params, own, value, vec![Slot::default(); slots]) {
        Ok(robot) => {
            assert!(given == needs && fits);
            Play::new(params, robot, scratch, slots, value).all(source);
        }
        Err(error) => assert!(error == RobotError::Value && !fits),
    }
}
