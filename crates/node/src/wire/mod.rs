//! Bytes on the wire: envelopes, what is in those between a robot and a simulated plant, and proofs. What robots tell each other is
//! a message of the core and stands in no file here.

pub mod envelope;
pub mod mode;
pub mod proof;
pub mod report;
pub mod sensed;
