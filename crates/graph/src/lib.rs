//! Exact (r,s)-robustness of graphs, with witnesses.
//!
//! A network of robots survives F liars under W-MSR if it is (F+1,F+1)-robust. This crate says whether it is, exactly,
//! and shows two sets of nodes that would never agree if it is not. It knows graphs only: no robots, no files, no clock.
//!
//! ```text
//! X^r_S = { i ∈ S : |N_i \ S| ≥ r }                                                  paper reachability
//! (r,s)-robust: for all disjoint nonempty S₁, S₂:                                    paper def:robustness
//!     X^r_S₁ = S₁   or   X^r_S₂ = S₂   or   |X^r_S₁| + |X^r_S₂| ≥ s
//! r_max    = largest r with (r,1)-robustness         0 ..= ceil(n/2)
//! F_max    = largest F with (F+1,F+1)-robustness     −1 ..= ceil(n/2) − 1
//! s_max(r) = largest s with (r,s)-robustness         0 ..= n
//! ```
//!
//! | question | module |
//! | --- | --- |
//! | everything about one graph, within an effort | [`analysis`] |
//! | one (r, s), with a witness or a certificate | [`decide`], [`verdict`] |
//! | the definitions word for word | [`definition`] |
//! | what degrees and pairs of nodes say | [`bounds`] |
//! | branch and bound (algorithm B) | [`search`] |
//! | the table of all subsets (algorithm A) | [`table`] |
//! | which nodes look alike | [`search::symmetry`] |
//! | what eigenvalues say, of one set and of both | [`spectrum`] |
//! | what a question may cost; threads that a caller lends | [`effort`], [`workers`] |
//! | leaders, and adversaries few in every neighbourhood | [`leaders`], [`local`] |
//! | whether liars can split it, with a proof that others can check | [`roles`] |
//! | what several hops survive | [`hops`] |
//! | which edges to add | [`additions`] |
//! | who still agrees where it is not robust | [`agreement`] |
//! | a claim with what proves it, for others to check | [`evidence`] |
//! | networks of any size; a proof by ranks in linear time | [`network`], [`ranks`] |
//! | graphs by name, graphs as text | [`makers`], [`formats`] |
//!
//! ```
//! use closeranks_graph::analysis::{analyze, largest};
//! use closeranks_graph::effort::Effort;
//! use closeranks_graph::makers::fixed::wheel;
//! use core::ops::ControlFlow;
//!
//! let wheel = wheel(9)?;
//! let (r_max, f_max) = largest(&wheel);
//! assert_eq!((r_max.exactly(), f_max.exactly()), (Some(2), Some(1)));
//!
//! let analysis = analyze(&wheel, &Effort::UNLIMITED, &mut |_| ControlFlow::Continue(()));
//! let witness = analysis.witness_r.expect("no graph of nine nodes is 6-robust");
//! assert!(witness.holds(&wheel) && witness.r == 3);
//! # Ok::<(), closeranks_graph::makers::MakerError>(())
//! ```
#![no_std]

extern crate alloc;

pub mod additions;
pub mod agreement;
pub mod analysis;
pub mod bounds;
pub mod connectivity;
pub mod decide;
pub mod definition;
pub mod effort;
pub mod evidence;
pub mod formats;
pub(crate) mod generator;
pub mod graph;
pub mod hops;
mod joint;
pub mod leaders;
pub mod local;
pub mod makers;
pub mod network;
pub mod ranks;
pub mod roles;
pub mod search;
pub mod spectrum;
pub mod table;
pub mod verdict;

pub use effort::workers;
