//! One robot of a team that keeps agreeing while some of its members lie.
//!
//! Every robot i senses its own position and those of the robots within R of it, hears from each of them a *level*
//! c_j and a *value* y_j, and wants to move with some desired velocity. Anything it hears may be a lie. It moves with the
//! velocity closest to the desired one that satisfies one inequality (eq:split), built from what it knows alone:
//!
//! ```text
//! H_i · u_i ≥ −α φ_i,   H_i = Σ_j [ w_r (Ê_i + Ê_j) ∂a_ij/∂x_i + 2 w_c E^c_ij (x_i − x_j) ]
//! ```
//!
//! and updates its value with W-MSR. If every normal robot keeps F′ = F + ⌊n/2⌋ neighbours, up to F liars can neither
//! split the team nor drag its values outside what normal robots held at the start (thm:rs_robust).
//!
//! | paper | here |
//! | --- | --- |
//! | eq:adjacency | [`equations::link`] |
//! | eq:h_i, eq:shared_connectivity, eq:collision, F′ | [`equations::barrier`] |
//! | eq:composition, eq:phi_i, eq:split | [`equations::composition`] |
//! | seq:qp | [`program`] |
//! | eq:linear, W-MSR | [`wmsr`] |
//! | eq:connectivity and everything over time | [`robot`] |
//! | what is told | [`message`] |
//! | our controller (docs/theory) | [`controller::budget`] |
//!
//! The crate allocates nothing, reads no clock, draws no random number, does no input or output and does not panic on
//! any input. Lengths are in m, speeds in m/s, all numbers `f64`, the dimension is `const D` (2 and 3 are tested).

#![no_std]

pub mod controller;
pub mod equations;
pub mod message;
pub mod need;
pub mod num;
pub mod program;
pub mod robot;
pub mod settings;
pub mod time;
pub mod wmsr;
