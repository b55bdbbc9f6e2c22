//! Our controller `budget`: rows that no lie, no loss and no step length can break (METHOD.md section 3).
//!
//! `h_k` is the spare connectivity of robot k. In one tick, k and each of its neighbours may spend a fixed share of what
//! they *know* that k still has, so all of them together cannot overspend. Robot i moves by the v closest to the desired
//! displacement that satisfies, for every neighbour j with `r = x_i − x_j`, `D = |r|²`:
//!
//! ```text
//! (far)   r·v + |v|²       ≤ γ/(4 L_ij) min(h_i⁺/δ_i, b_ij/δ⁺_ij)         or, if all obey,
//! (far′)  −g_ik·v + κ_ik |v|² ≤ γ b_ik/(δ⁺_ik + 1)                         for each neighbour k and i itself
//! (near)  −2 r·v           ≤ (γ_c/2) (D − Δ_d²)⁺
//! (reach) v/T ∈ U_i
//!
//! h⁺ = max(h, 0),  L_ij, κ: bounds of the link weight's derivatives,  b_ij ≤ h_j⁺ known,  δ⁺ ≥ δ_j (METHOD.md: n − 1)
//! ```
//!
//! Each set is convex and contains v = 0: the program is feasible at every tick, for every lie.
//!
//! | symbol | here |
//! | --- | --- |
//! | L_ij, κ | [`curvature`] |
//! | the verified interval, δ⁺_ij | [`interval`] |
//! | b_ij | [`knowledge`] |
//! | one row, what "holds" means in floating point | [`crate::program::balls::row`] |
//! | T U_i | [`crate::program::balls::reach`] |
//! | what wrong positions and lag cost | [`margin`] |
//! | what both ends of a pair share | [`tie`] |
//! | all rows of a tick, recovery | [`rows`], `limits` |
//! | the closest point | [`crate::program::balls`] |
//! | γ, γ_c and the rest | [`settings`] |

pub mod control;
pub mod curvature;
pub mod interval;
pub mod knowledge;
mod limits;
pub mod margin;
pub mod rows;
pub mod settings;
pub mod survey;
pub mod tie;
