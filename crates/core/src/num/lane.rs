//! A lane is the same number of many worlds, side by side. What is computed for all of them in one loop without branches is vectorised.

/// How many worlds lie side by side. With 8 the compiler unrolls loops before it looks for what it can vectorise.
pub const LANES: usize = 16;

/// A number of each world.
pub type Lane = [f64; LANES];
