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
use closeranks_core::settings::params::Params;

use crate::source::Source;
use calls::Play;

/// The robot's own number, in the middle of the others.
const ME: RobotId = RobotId(5);

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

/// Lends 0 to 12 slots and, once in a while, too little of the rest; then plays the calls to the end of the bytes.
fn play<const D: usize>(params: Params<D>, source: &mut Source<'_>) {
    let slots = source.below(13);
    let short = |source: &mut Source<'_>, enough: usize| match source.byte() {
        0..=15 => enough.saturating_sub(1),
        16..=31 => source.below(enough + 1),
        _ => enough,
    };
    let wide = if source.byte() & 1 == 0 { 3 * slots } else { slots * slots.max(3) };
    let numbers = short(source, wide);
    let mut memory = (vec![Slot::default(); slots], vec![0.0; numbers]);
    let mut sightings = vec![Sighting::NOBODY; short(source, slots)];
    let mut rows = vec![Row::default(); short(source, 2 * D + (1 << D) * (2 * slots + 1))];
    let value = if source.byte() < 240 { source.near() } else { source.number() };
    match Robot::new(params, ME, value, &mut memory.0, &mut memory.1) {
        Ok(robot) => {
            assert!(numbers >= slots && value.abs() <= VALUE_MAX);
            let robot = robot.with_budget_memory(&mut sightings, &mut rows);
            Play::new(params, robot, slots, value).all(source);
        }
        Err(RobotError::Memory) => assert!(numbers < slots),
        Err(_) => assert!(value.is_nan() || value.abs() > VALUE_MAX),
    }
}
