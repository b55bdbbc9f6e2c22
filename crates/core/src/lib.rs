//! One robot.
#![no_std]
