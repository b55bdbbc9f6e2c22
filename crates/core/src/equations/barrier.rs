//! The constraint functions: degree, told degree and distance. How many neighbours a robot must keep says [`crate::need`].

/// `h_i = c_i − F′` from the true level `c_i = Σ_{j∈N_i} a_ij`, and `ĥ_k = c_k − F′` from a told one.
///
/// Dimensionless. `h_i ≥ 0` only if robot i has at least F′ neighbours (lem:connectivity).
/// Its gradient is that of the level: ∂h_k/∂x_i = ∂a_ik/∂x_i for a neighbour k, and ∂h_i/∂x_i = Σ_j ∂a_ij/∂x_i.
//= paper eq:h_i
//= paper eq:shared_connectivity
#[must_use]
pub fn degree_barrier(level: f64, required: u16) -> f64 {
    level - f64::from(required)
}

/// `h^col_ij = ‖x_i − x_j‖² − Δ_d²`, m², from the squared distance.
///
/// Its gradient with respect to x_i is `2 (x_i − x_j)`, m.
//= paper eq:collision
#[must_use]
pub fn collision_barrier(distance_m2: f64, distance_min_m: f64) -> f64 {
    distance_m2 - distance_min_m * distance_min_m
}

#[cfg(test)]
mod tests {
    use super::*;

    //= paper eq:h_i type=test
    //= paper eq:shared_connectivity type=test
    #[test]
    fn the_degree_barrier_is_the_spare_level() {
        assert_eq!(degree_barrier(7.25, 7), 0.25);
        assert_eq!(degree_barrier(0.0, 7), -7.0);
    }

    //= paper eq:collision type=test
    #[test]
    fn the_collision_barrier_is_zero_at_the_least_distance() {
        assert_eq!(collision_barrier(0.3 * 0.3, 0.3), 0.0);
        assert_eq!(collision_barrier(1.25, 0.5), 1.0);
    }
}
