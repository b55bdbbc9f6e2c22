//! What recordings of all formats say about themselves.

/// What a file says about itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Metadata<'a> {
    /// The scenario in TOML.
    pub scenario: &'a str,
    /// Its seed.
    pub seed: u64,
    /// Version of the program.
    pub version: &'a str,
    /// Commit of the program.
    pub commit: &'a str,
    /// q₁ and q₂ (1/m⁴) of the weight of a link, as the controller has it.
    pub weight: [f64; 2],
}
