//! What controllers that look at the whole team share: barriers with their gradients, the half-spaces of one robot, eigenvalues.

pub(super) mod barrier;
pub(super) mod eigen;
pub(super) mod half_spaces;
#[cfg(test)]
pub(super) mod testing;
