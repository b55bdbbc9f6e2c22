//! Least and greatest over a run.

/// What a run came to at its worst.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// Least degree of normal robots, if there are any.
    pub degree_min: Option<u16>,
    /// Least degree of malicious robots, if there are any.
    pub malicious_degree_min: Option<u16>,
    /// Least h_i of normal robots.
    pub h_min: f64,
    /// Least distance of two robots, m.
    pub distance_min_m: f64,
    /// Least distance of a normal robot to an obstacle, m; infinite without any.
    pub clear_min_m: f64,
    /// Least global φ.
    pub phi_global_min: f64,
    /// Least φ_i.
    pub phi_min: f64,
    /// First tick at which every φ_i ≥ 0.
    pub inside_from: Option<u32>,
    /// First tick of the last stretch in which degrees and distances hold to the end.
    pub safe_from: Option<u32>,
    /// First round after which the spread of normal values is below 1.
    pub rounds_to_agree: Option<u32>,
    /// Spread of normal values at the end, of the number in which they are farthest apart.
    pub spread: f64,
    /// The same of each number of a value; 0 of those that are not there.
    pub spreads: [f64; 3],
}

impl Extremes {
    /// Before the first tick.
    pub(super) fn new() -> Self {
        Self {
            degree_min: None,
            malicious_degree_min: None,
            h_min: f64::INFINITY,
            distance_min_m: f64::INFINITY,
            clear_min_m: f64::INFINITY,
            phi_global_min: f64::INFINITY,
            phi_min: f64::INFINITY,
            inside_from: None,
            safe_from: None,
            rounds_to_agree: None,
            spread: 0.0,
            spreads: [0.0; 3],
        }
    }
}

/// Lowers a least degree to `degree`, if that is less.
pub(super) fn lower(least: &mut Option<u16>, degree: u16) {
    *least = Some(least.map_or(degree, |least| least.min(degree)));
}
