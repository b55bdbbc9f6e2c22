//! What a controller keeps, in the words of those who watch it.

use crate::controller::errors::ErrorBounds;
use crate::equations::link::LinkShape;

/// What a controller keeps among references: where velocities have taken each robot ([`ErrorBounds`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kept {
    /// The shape of their links.
    pub link: LinkShape,
    /// How near two of them may come, m.
    pub distance_min_m: f64,
    /// The greatest fall of the weight of a link, 1/m; 0 where no weight is kept.
    pub fall_max: f64,
    /// The fraction of h that a tick may take; 1 where nothing bounds it.
    pub gamma: f64,
    /// The fraction of D − Δ_d² that a tick may take; 1 where nothing bounds it.
    pub gamma_c: f64,
    /// How far they are from the robots.
    pub errors: ErrorBounds,
}

impl Kept {
    /// What a controller keeps that reckons with no errors: links of this shape, and Δ_d = `distance_min_m`.
    #[must_use]
    pub fn plain(link: &LinkShape, distance_min_m: f64) -> Self {
        let (gamma, gamma_c, errors) = (1.0, 1.0, ErrorBounds::NONE);
        Self { link: *link, distance_min_m, fall_max: 0.0, gamma, gamma_c, errors }
    }
}
