//! What the program does, one file a group of commands.

pub mod doctor;
pub mod identity;
pub mod robots;

/// What a command says when it could not do its work: a message for people, and exit code 2.
pub type Failure = Box<dyn core::error::Error>;
