//! What malicious robots are assumed to do, and which neighbours a robot must therefore keep.

use crate::need::Keep;

/// What malicious robots are assumed to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Assume {
    /// They lie but move by the rows (Assumption 1): `h_k = Σ_j a_kj − F′`, `F′ = F + ⌊n/2⌋`.
    Obedient,
    /// They move as they like and tell every neighbour another value: `h_k = T_k − θ`, `θ = F + ⌊(n−F)/2⌋`, with T_k the
    /// sum of the a_kj without its F largest terms.
    Free,
}

impl Assume {
    /// Which neighbours every robot must then keep enough of.
    #[must_use]
    pub fn keep(self) -> Keep {
        match self {
            Self::Obedient => Keep::Neighbors,
            Self::Free => Keep::NormalNeighbors,
        }
    }
}
