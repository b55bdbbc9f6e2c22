//! Who is who: keys, the roster that an operator signs, and the number that grows with every start of a robot.

pub mod epoch;
pub mod keys;
pub mod parameters;
pub mod roster;
