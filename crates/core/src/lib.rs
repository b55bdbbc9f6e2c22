//! One robot of a team that keeps agreeing while some of its members lie.
//!
//! # The problem
//!
//! There are n robots, and up to F of them may be malicious: they tell others whatever they like. Every robot i senses its
//! own position and those of the robots within R of it, its neighbours. It hears from each neighbour j a *value* y_j, on which all
//! normal robots should agree, and under the paper's controller a *level* c_j, which says how well j is connected. It wants to move with some
//! desired velocity, and must find out on its own how far it may follow that wish.
//!
//! If every normal robot keeps `F′ = F + ⌊n/2⌋` neighbours, up to F liars can neither split the team nor drag its values out of
//! the interval that normal robots started from (thm:rs_robust). So each robot moves with the velocity closest to the desired
//! one that satisfies a few inequalities, built from what it knows alone. The paper has one inequality (eq:split):
//!
//! ```text
//! H_i · u_i ≥ −α φ_i,   H_i = Σ_j [ w_r (Ê_i + Ê_j) ∂a_ij/∂x_i + 2 w_c E^c_ij (x_i − x_j) ]
//! ```
//!
//! Its guarantee needs continuous time and lies that do not change. Our controllers, `budget` and `links`, have two inequalities for
//! each neighbour, and their guarantees hold in discrete time for any lie and any loss of messages.
//!
//! | equation | module |
//! | --- | --- |
//! | eq:adjacency: weight and slope of a link | [`equations::link`] |
//! | eq:h_i, eq:shared_connectivity, eq:collision | [`equations::barrier`] |
//! | F′ and θ, who counts for whom (thm:rs_robust) | [`need`] |
//! | eq:composition, eq:phi_i, eq:split | [`equations::composition`] |
//! | the paper's controller, seq:qp | [`controller::composed`], [`program::box_row`] |
//! | our controller: eq:far, eq:far-prime, eq:near (docs/theory) | [`controller::budget`], [`program::balls`] |
//! | our controller without weights: eq:held (docs/theory) | [`controller::links`] |
//! | eq:connectivity: when a level is told | [`robot`], [`controller::Control::level`] |
//! | eq:linear, W-MSR | [`wmsr`]; other rules of consensus: [`consensus`] |
//! | what is told, as bytes | [`message`] |
//! | every parameter with its range | [`settings`] |
//!
//! # How to use it
//!
//! [`SizedRobot`] holds one robot and all the memory it needs; [`Robot`] is for whoever lends the memory. The owner makes five
//! calls in every tick, in this order. Two robots that want to drive apart, and must stay neighbours:
//!
//! ```
//! use core::time::Duration;
//!
//! use closeranks_core::{
//!     BudgetSettings, Clock, Controller, Instant, Message, Mode, Params, RobotId, Settings, SizedRobot, Team,
//! };
//!
//! const TICK_S: f64 = 0.02;
//!
//! // All robots of a team have the same settings. A velocity is held for a tick, and 5 ms more if the next one is late.
//! let settings = Settings {
//!     team: Team { robots: 2, faults: 0 },
//!     controller: Controller::Budget(BudgetSettings::default()),
//!     clock: Clock {
//!         level_period: Duration::from_millis(20),
//!         hold_max: Some(Duration::from_millis(25)),
//!         ..Clock::default()
//!     },
//!     ..Settings::default()
//! };
//! let params = Params::new(settings)?;
//! let ids = [RobotId(1), RobotId(2)];
//! // In the plane, with room for one neighbour. They start with the values 10 and 20.
//! let mut robots = [SizedRobot::<2, 1>::new(params, ids[0], 10.0)?, SizedRobot::new(params, ids[1], 20.0)?];
//! let mut positions_m = [[0.0, 0.0], [1.0, 0.0]];
//! let desired_m_s = [[-1.0, 0.0], [1.0, 0.0]];
//!
//! for tick in 0..500 {
//!     let now = Instant::from_nanos(tick * 20_000_000);
//!     let mut sent = [None; 2];
//!     for (me, other) in [(0, 1), (1, 0)] {
//!         robots[me].sense(now, positions_m[me])?; // 1. the time and the own position
//!         robots[me].observe(ids[other], positions_m[other])?; // 2. the robots in sight
//!         sent[me] = robots[me].share().map(|message| message.encode()); // 3. the bytes to send, if any are due
//!     }
//!     for (me, other) in [(0, 1), (1, 0)] {
//!         if let Some(bytes) = sent[other] {
//!             let message = Message::parse(&bytes)?; // anything but a message is refused here
//!             robots[me].receive(ids[other], &message)?; // 4. what arrived, and who sent it
//!         }
//!         let output = robots[me].tick(desired_m_s[me]); // 5. the safe velocity
//!         assert_eq!(output.report.mode, Mode::Guaranteed);
//!         positions_m[me][0] += TICK_S * output.velocity_m_s[0];
//!     }
//! }
//! let distance_m = positions_m[1][0] - positions_m[0][0];
//! assert!(2.5 < distance_m && distance_m < 3.0, "as far as the link allows: R is 3 m");
//! assert_eq!(robots.map(|robot| robot.value()), [15.0, 15.0], "they agree");
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! `examples/four_robots.rs` has four of them, one of which lies, and ticks that are late. Under `links` messages are longer than a
//! [`Message`]: send what [`Robot::encode`] writes, and give what comes to [`Robot::receive_bytes`].
//!
//! # Borders
//!
//! The crate allocates nothing, reads no clock, draws no random number, does no input or output and does not panic on any
//! input. Lengths are in m, speeds in m/s, all numbers are `f64`, and the dimension is `const D` (2 and 3 are tested). Names at
//! the root are all that the owner of a robot needs; the modules are for whoever builds with the equations themselves.

#![no_std]

pub mod consensus;
pub mod controller;
pub mod equations;
pub mod id;
pub mod message;
pub mod need;
pub mod num;
pub mod obstacle;
pub mod program;
pub mod robot;
pub mod settings;
pub mod time;
pub mod wmsr;

pub use crate::controller::assume::Assume;
pub use crate::controller::links::wire::{LinkMessage, Notice};
pub use crate::equations::composition::PhiSplit;
pub use crate::message::{MESSAGE_BYTES, Message, MessageError, VALUE_MAX};
pub use crate::need::{Keep, Need};
pub use crate::num::Vector;
pub use crate::obstacle::Obstacle;
pub use crate::program::{InputBox, Outcome};
pub use crate::robot::error::{ObserveError, Observed, ReceiveError, RobotError, SenseError};
pub use crate::robot::memory::RobotMemory;
pub use crate::robot::neighbor::{RobotId, Slot};
pub use crate::robot::report::{Mode, Output, Reason, Report, RoundReport};
pub use crate::robot::scratch::{Needs, Scratch};
pub use crate::robot::sized::SizedRobot;
pub use crate::robot::{Robot, Slots};
pub use crate::settings::field::Field;
pub use crate::settings::params::{Params, ParamsError};
pub use crate::settings::range::Allowed;
pub use crate::settings::{
    BudgetSettings, Clock, ComposedSettings, Controller, Errors, Limits, LinkSettings, LinksSettings,
    Settings, Team,
};
pub use crate::time::Instant;
